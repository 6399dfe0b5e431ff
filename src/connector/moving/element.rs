//! A line that moves by itself as an engine sees it.

use super::around::{Floor, Water, ground};
use super::describe::{Description, HeldDirection, Part};
use super::kept::{Kept, Layout};
use super::mesh::{Cut, attachments, told, wind};
use super::{modes, start};
use crate::language::units::Dim;
use crate::model::{
    Ambient, ClassError, Connection, Element, End, Guess, LineMode, LineNode, LineStress, Response, Situation, Six,
    Summary, Surroundings,
};
use crate::rod::{
    self, EndForces, EndTangent, Ground, Motion, PlaneBottom, Rod, Settings, Solver, State, Twelve, World,
};
use nalgebra::{Matrix6, Vector3};
use std::cell::RefCell;
use std::sync::Arc;

/// How often a rod halves a step of the run by itself, before the run halves its own.
const HALVINGS: u32 = 8;
/// An end may lie this much below the bottom (m).
const BELOW: f64 = 1e-3;

/// What is said of a line that was given memory not its own.
const NO_MEMORY: &str = "the line has no memory";

/// What does not change while it is wound.
#[derive(Debug)]
struct Base {
    description: Description,
    rod: Rod,
    attached: Vec<rod::Attachment>,
    /// Part of each segment of the rod.
    part: Vec<usize>,
    ambient: Option<Arc<dyn Ambient>>,
    plane: Option<PlaneBottom>,
    /// Elevation of a flat bottom (m), where one is known.
    flat: Option<f64>,
    ground: Ground,
    /// Direction in which each end is held, in the axes of what holds it, and the stiffness of that.
    holds: [Option<HeldDirection>; 2],
    /// Whether the first end is let go.
    freed: bool,
}

/// A line between two ends.
#[derive(Debug)]
pub struct MovingLine {
    base: Arc<Base>,
    layout: Layout,
    /// Length of the first part (m), and of its elements as the class has them.
    first: f64,
    nominal: f64,
}

/// What a solver of a line remembers.
struct Warm {
    base: Arc<Base>,
    rod: Rod,
    solver: Solver,
    /// Where it last hung at rest.
    rest: Option<State>,
}

/// A line at rest.
struct Rest {
    state: State,
    forces: EndForces,
}

impl MovingLine {
    /// The line of a class between the ends of a connector.
    ///
    /// # Errors
    /// Properties that make no rod, more elements than memory should hold, no direction for an end that is held.
    pub fn made(description: Description, connection: &Connection) -> Result<Self, ClassError> {
        let around = connection.surroundings;
        let ambient = connection.ambient.cloned();
        let ends = connection.ends.map(|p| p.origin);
        let known = |p: &Part| p.segment.length;
        let class_first = description.parts.first().map_or(0.0, known);
        let first = connection.placement.first_length.unwrap_or(class_first);
        let mut lengths: Vec<f64> = description.parts.iter().map(known).collect();
        if let Some(length) = lengths.first_mut() {
            *length = first;
        }
        let far = ends[1];
        let plane = description.seabed.slope.filter(|s| *s != 0.0).map(|slope| {
            // it rises from the second end toward the first
            let across = Vector3::new(ends[0].x - far.x, ends[0].y - far.y, 0.0);
            let toward = across.try_normalize(1e-9).unwrap_or_else(Vector3::x);
            let height = description.seabed.depth.map_or(far.z, |d| -d);
            let rise = [toward.x * slope, toward.y * slope];
            PlaneBottom { height: height - rise[0] * far.x - rise[1] * far.y, slope: rise }
        });
        let flat = description.seabed.depth.or(around.depth).map(|d| -d);
        let floor = if plane.is_some() { None } else { flat };
        let shape = match &ambient {
            Some(a) if a.growth(ends[0].z.min(ends[1].z)).0 > 0.0 || a.growth(around.tide).0 > 0.0 => {
                start::points(&description.parts, &lengths, ends, floor, around)
            }
            _ => Vec::new(),
        };
        let cut = Cut::of(&description, ambient.as_deref(), &shape);
        let mesh = cut.mesh(&description.parts, first);
        let counts: Vec<usize> = (0..description.parts.len())
            .map(|part| mesh.iter().filter(|e| cut.part.get(e.2) == Some(&part)).count())
            .collect();
        let attached = attachments(&description.parts, &counts, around.water_density);
        let nominal = description.parts.first().map_or(1.0, |p| p.segment.length / p.segment.elements.max(1) as f64);
        let rod = Rod::with_mesh(&connection.connector.name, cut.segments, attached.clone(), &mesh).map_err(told)?;
        let longer = connection.connector.longest.map_or(0.0, |l| (l - first).max(0.0) / nominal);
        let capacity = rod.nodes() - 1 + if longer > 0.0 { (longer / 0.5).ceil() as usize + 2 } else { 1 };
        if capacity > rod::MOST_ELEMENTS {
            return Err(ClassError::new(format!(
                "its winch would make more than {} elements of it",
                rod::MOST_ELEMENTS
            )));
        }
        let per_node = State::packed(&rod).div_ceil(rod.nodes()) + 1;
        let holds = description.held_directions(connection)?;
        let ground = ground(&description.seabed, rod.segments(), around);
        let layout = Layout::new(capacity, per_node * (capacity + 2));
        let base = Base {
            description,
            rod,
            attached,
            part: cut.part,
            ambient,
            plane,
            flat,
            ground,
            holds,
            freed: connection.connector.freed,
        };
        Ok(MovingLine { base: Arc::new(base), layout, first, nominal })
    }

    fn warm<'a>(&self, guess: &'a mut Guess) -> Option<&'a mut Warm> {
        let fits = |g: &Box<dyn std::any::Any + Send>| {
            g.downcast_ref::<Warm>().is_some_and(|w| Arc::ptr_eq(&w.base, &self.base))
        };
        if !guess.as_ref().is_some_and(fits) {
            let rod = self.base.rod.clone();
            let solver = Solver::new(&rod, Settings { halvings: HALVINGS, ..Settings::default() });
            *guess = Some(Box::new(Warm { base: self.base.clone(), rod, solver, rest: None }));
        }
        guess.as_mut()?.downcast_mut::<Warm>()
    }

    /// The line's surroundings, at rest or under way, for what needs them.
    fn within<T>(&self, around: &Surroundings, mean: bool, act: impl FnOnce(&World) -> T) -> T {
        let ambient = self.base.ambient.as_deref();
        let water = Water { ambient, around, mean, flows: RefCell::default() };
        let floor = Floor { plane: self.base.plane, ambient, flat: self.base.flat.unwrap_or(0.0) };
        let known = self.base.plane.is_some() || self.base.flat.is_some();
        let bottom: Option<(&dyn rod::Bottom, Ground)> = known.then_some((&floor, self.base.ground));
        act(&World { bottom, ..World::new(&water, around.gravity) })
    }

    /// What holds the ends.
    fn held(&self, ends: &[End], still: bool) -> Result<[rod::End; 2], ClassError> {
        let [first, second] = ends else { return Err(ClassError::new("a line has two ends")) };
        let made = |end: &End, hold: &Option<HeldDirection>| {
            let three = |six: &Six| Vector3::new(six[0], six[1], six[2]);
            let mut motion = Motion::still(end.pose.origin);
            if !still {
                (motion.velocity, motion.acceleration) = (three(&end.velocity), three(&end.acceleration));
            }
            let moved = rod::End::moved(motion);
            match hold {
                Some((direction, stiffness)) => {
                    rod::End { rotation: *stiffness, ..moved.clamped(end.pose.axes * direction) }
                }
                None => moved,
            }
        };
        let [a, b] = &self.base.holds;
        let first = if self.base.freed { rod::End::FREE } else { made(first, a) };
        Ok([first, made(second, b)])
    }

    /// Where it hangs at rest between ends.
    fn rest(&self, at: &Situation, warm: &mut Warm) -> Result<Rest, ClassError> {
        let ends = self.held(at.ends, true)?;
        if warm.rod != self.base.rod {
            warm.rod.clone_from(&self.base.rod);
            warm.solver = Solver::new(&warm.rod, Settings { halvings: HALVINGS, ..Settings::default() });
        }
        let places = [0, 1].map(|i| at.ends.get(i).map_or_else(Vector3::zeros, |e| e.pose.origin));
        self.within(at.surroundings, true, |world| {
            if let Some((bottom, _)) = &world.bottom {
                for (place, name) in places.iter().zip(["first", "second"]) {
                    let below = bottom.height(place.x, place.y).0 - place.z;
                    if below > BELOW {
                        let text = format!("its {name} end lies {{}} below the bottom");
                        return Err(ClassError::of(text, &[(below, Dim::Length)])
                            .help("check its points, -DEPANCHOR and -DEPTH of &ENV"));
                    }
                }
            }
            let mut state = match warm.rest.take() {
                Some(state) => state,
                None => {
                    // how softly it meets the bottom is known where it rests first
                    let mut fallen = self.fallen(places, at.surroundings)?;
                    warm.solver.statics(&warm.rod, &mut fallen, world, ends).map_err(told)?;
                    fallen
                }
            };
            let forces = warm.solver.statics(&warm.rod, &mut state, world, ends).map_err(told)?;
            warm.rest = Some(state.clone());
            Ok(Rest { state, forces })
        })
    }

    /// From where it falls.
    fn fallen(&self, places: [Vector3<f64>; 2], around: &Surroundings) -> Result<State, ClassError> {
        let parts = &self.base.description.parts;
        let mut lengths: Vec<f64> = parts.iter().map(|p| p.segment.length).collect();
        if let Some(length) = lengths.first_mut() {
            *length = self.first;
        }
        let floor = if self.base.plane.is_some() { None } else { self.base.flat };
        let points = start::points(parts, &lengths, places, floor, around);
        State::along(&self.base.rod, &points).map_err(told)
    }

    /// A state read back, with the line it is of.
    fn resumed(&self, kept: &Kept, warm: &mut Warm) -> Result<State, ClassError> {
        if warm.rod.mesh() != kept.mesh {
            // what is attached stands behind the first part, whose elements alone come and go
            let before = self.base.rod.nodes() - 1;
            let shifted =
                |a: &rod::Attachment| rod::Attachment { node: (a.node + kept.mesh.len()).saturating_sub(before), ..*a };
            let attached = self.base.attached.iter().map(shifted).collect();
            let name = self.base.rod.name().to_string();
            warm.rod = Rod::with_mesh(&name, self.base.rod.segments().to_vec(), attached, &kept.mesh).map_err(told)?;
            warm.solver = Solver::new(&warm.rod, Settings { halvings: HALVINGS, ..Settings::default() });
        }
        State::unpack(&warm.rod, &kept.motion).map_err(told)
    }

    /// Its motion as a state has it, or where it rests if it has not begun; and whether that is without the waves.
    fn where_it_is(&self, at: &Situation, state: &[f64], warm: &mut Warm) -> Result<(State, bool), ClassError> {
        Ok(match self.layout.read(state)? {
            Some(kept) => (self.resumed(&kept, warm)?, at.step.is_none()),
            None => (self.rest(at, warm)?.state, true),
        })
    }

    /// Takes it to the end of a step.
    fn step(
        &self,
        at: &Situation,
        (time, dt): (f64, f64),
        kept: &Kept,
        trial: &mut [f64],
        warm: &mut Warm,
        out: &mut Response,
    ) -> Result<(), ClassError> {
        let ends = self.held(at.ends, false)?;
        let mut state = self.resumed(kept, warm)?;
        if dt > 0.0 {
            let of_first = |segment: usize| self.base.part.get(segment) == Some(&0);
            let nodes = warm.rod.nodes();
            wind(&mut warm.rod, &mut state, (self.first, self.nominal, dt), of_first)?;
            if warm.rod.nodes() != nodes {
                warm.solver = Solver::new(&warm.rod, Settings { halvings: HALVINGS, ..Settings::default() });
            }
            state.time = time - dt;
        } else {
            state.time = time;
        }
        let Warm { rod, solver, .. } = warm;
        let (forces, tangent) = self.within(at.surroundings, false, |world| {
            if dt > 0.0 {
                let forces = solver.trial(rod, &state, world, time, ends).map_err(told)?;
                solver.reached(&mut state);
                Ok::<_, ClassError>((forces, solver.end_tangent_at_hand(rod, world)))
            } else {
                let forces = solver.start(rod, &mut state, world, ends).map_err(told)?;
                let mut tangent = EndTangent::default();
                for (side, mass) in solver.end_masses().iter().enumerate() {
                    tangent.acceleration.fixed_view_mut::<3, 3>(6 * side, 6 * side).copy_from(&-mass);
                }
                Ok((forces, Some(tangent)))
            }
        })?;
        self.layout.write(rod, &state, trial)?;
        answer(out, &forces, tangent.as_ref(), true)
    }
}

/// Wrenches and their changes.
fn answer(
    out: &mut Response,
    forces: &EndForces,
    tangent: Option<&EndTangent>,
    moving: bool,
) -> Result<(), ClassError> {
    out.clear(2);
    for (wrench, (force, moment)) in out.wrench.iter_mut().zip(forces.force.iter().zip(&forces.moment)) {
        *wrench = Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
    }
    if out.wrench.iter().any(|w| w.iter().any(|v| !v.is_finite())) {
        return Err(ClassError::new("its force is no number"));
    }
    let Some(tangent) = tangent else { return Ok(()) };
    let fill = |blocks: &mut Vec<Matrix6<f64>>, whole: &Twelve| {
        blocks.clear();
        blocks.extend((0..4).map(|index| -whole.fixed_view::<6, 6>(6 * (index / 2), 6 * (index % 2))));
    };
    fill(&mut out.stiffness, &tangent.position);
    if moving {
        fill(&mut out.damping, &tangent.velocity);
        fill(&mut out.inertia, &tangent.acceleration);
    }
    Ok(())
}

impl Element for MovingLine {
    fn states(&self) -> usize {
        self.layout.size()
    }

    fn moves(&self) -> bool {
        true
    }

    fn nodes(&self) -> usize {
        self.layout.elements + 1
    }

    fn bends(&self) -> bool {
        self.base.rod.segments().iter().any(|s| s.bending > 0.0)
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        guess: &mut Guess,
        out: &mut Response,
    ) -> Result<(), ClassError> {
        let kept = self.layout.read(committed)?;
        let Some(warm) = self.warm(guess) else { return Err(ClassError::new(NO_MEMORY)) };
        if let (Some(step), Some(kept)) = (at.step, &kept) {
            return self.step(at, (step.time, step.dt), kept, trial, warm, out);
        }
        let found = self.rest(at, warm)?;
        let Warm { rod, solver, .. } = warm;
        let tangent = self.within(at.surroundings, true, |world| solver.end_tangent(rod, world));
        answer(out, &found.forces, tangent.as_ref(), false)?;
        if let Some(step) = at.step {
            // a run begins here
            let mut state = found.state;
            state.time = step.time;
            self.layout.write(rod, &state, trial)?;
            let kept = self.layout.read(trial)?;
            if let Some(kept) = kept {
                return self.step(at, (step.time, 0.0), &kept, trial, warm, out);
            }
        }
        Ok(())
    }

    fn along(&self, at: &Situation, state: &[f64], out: &mut Vec<LineNode>) -> Result<(), ClassError> {
        let mut guess = None;
        let Some(warm) = self.warm(&mut guess) else { return Err(ClassError::new(NO_MEMORY)) };
        let (state, still) = self.where_it_is(at, state, warm)?;
        let ends = self.held(at.ends, still)?;
        out.clear();
        let found = self.within(at.surroundings, still, |world| warm.rod.results(&state, world, &ends));
        out.extend(found.iter().map(|n| LineNode {
            arc: n.arc,
            segment: self.base.part.get(n.segment).copied().unwrap_or(0),
            position: n.position,
            velocity: n.velocity,
            effective: n.effective,
            wall: n.wall,
            shear: n.shear,
            moment: n.moment,
            bends: n.bends,
            torque: n.torque,
            curvature: n.curvature,
            clearance: n.clearance,
            pressures: n.pressures,
            stress: n.stress.map(|s| LineStress {
                axial: s.axial,
                bending: s.bending,
                hoop: s.hoop,
                von_mises: s.von_mises,
            }),
        }));
        Ok(())
    }

    fn swings(&self, at: &Situation, state: &[f64], number: usize) -> Result<Vec<LineMode>, ClassError> {
        let mut guess = None;
        let Some(warm) = self.warm(&mut guess) else { return Err(ClassError::new(NO_MEMORY)) };
        let (state, _) = self.where_it_is(at, state, warm)?;
        let ends = self.held(at.ends, true)?;
        let Warm { rod, solver, .. } = warm;
        self.within(at.surroundings, true, |world| modes::of(rod, solver, &state, world, ends, number))
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<Summary, ClassError> {
        let mut nodes = Vec::new();
        self.along(at, committed, &mut nodes)?;
        let mut told = Summary { solution: "rod", notes: self.base.description.notes.clone(), ..Summary::default() };
        told.tension = nodes.first().map(|n| n.effective);
        let breaks = |n: &LineNode| self.base.description.parts.get(n.segment).map(|p| p.strength.breaking);
        let ratios = nodes.iter().filter_map(|n| breaks(n).map(|b| (n.effective / b, n.segment + 1)));
        if let Some((ratio, segment)) = ratios.max_by(|a, b| a.0.total_cmp(&b.0)) {
            (told.ratio, told.critical) = (Some(ratio), Some(segment));
            if ratio > 1.0 {
                told.notes.push("warning: the line is beyond its breaking tension".into());
            }
        }
        let lies = |pair: &[LineNode]| pair.iter().all(|n| n.clearance <= 0.0);
        told.grounded = Some(nodes.windows(2).filter(|p| lies(p)).map(|p| p[1].arc - p[0].arc).sum());
        Ok(told)
    }
}
