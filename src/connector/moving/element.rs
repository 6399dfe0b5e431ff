//! A line that moves by itself as an engine sees it.

use super::answer::{answer, holds};
use super::around::{Floor, Water, ground};
use super::describe::{Description, Part};
use super::kept::{Kept, Layout};
use super::mesh::{Cut, attachments, told, wind};
use super::start;
use super::warm::{Base, Warm, solver_of};
use crate::language::units::Dim;
use crate::model::{
    ClassError, Connection, Element, End, Flow, Guess, LineNode, LineStress, Response, Situation, Six, Summary,
    Surroundings,
};
use crate::rod::{self, EndForces, EndTangent, Ground, Motion, PlaneBottom, Rod, State, World};
use nalgebra::Vector3;
use std::cell::RefCell;
use std::sync::Arc;

/// An end may lie this much below the bottom (m).
const BELOW: f64 = 1e-3;

/// A line between two ends.
#[derive(Debug)]
pub struct MovingLine {
    base: Arc<Base>,
    layout: Layout,
    /// Length of the first part (m), and of its elements as the class has them.
    first: f64,
    nominal: f64,
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
        let holds = holds(&description, connection)?;
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
            felt: [true, !connection.to_ground],
        };
        Ok(MovingLine { base: Arc::new(base), layout, first, nominal })
    }

    fn warm<'a>(&self, guess: &'a mut Guess) -> Option<&'a mut Warm> {
        let fits = |g: &Box<dyn std::any::Any + Send>| {
            g.downcast_ref::<Warm>().is_some_and(|w| Arc::ptr_eq(&w.base, &self.base))
        };
        if !guess.as_ref().is_some_and(fits) {
            *guess = Some(Box::new(Warm::of(&self.base)));
        }
        guess.as_mut()?.downcast_mut::<Warm>()
    }

    /// The line's surroundings, at rest or under way, for what needs them; `flows` is room for what is asked of the water.
    fn within<T>(
        &self,
        (around, mean): (&Surroundings, bool),
        flows: &mut Vec<Flow>,
        act: impl FnOnce(&World) -> T,
    ) -> T {
        let ambient = self.base.ambient.as_deref();
        let water = Water { ambient, around, mean, flows: RefCell::new(std::mem::take(flows)) };
        let floor = Floor { plane: self.base.plane, ambient, flat: self.base.flat.unwrap_or(0.0) };
        let known = self.base.plane.is_some() || self.base.flat.is_some();
        let bottom: Option<(&dyn rod::Bottom, Ground)> = known.then_some((&floor, self.base.ground));
        let made = act(&World { bottom, ..World::new(&water, around.gravity) });
        *flows = water.flows.into_inner();
        made
    }

    /// What holds the ends.
    fn held(&self, ends: &[End], still: bool) -> Result<[rod::End; 2], ClassError> {
        let [first, second] = ends else { return Err(ClassError::new("a line has two ends")) };
        let made = |end: &End, hold: &Option<(Vector3<f64>, Option<f64>)>| {
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
            warm.take(self.base.rod.clone());
        }
        let places = [0, 1].map(|i| at.ends.get(i).map_or_else(Vector3::zeros, |e| e.pose.origin));
        let Warm { rod, solver, rest, flows, .. } = warm;
        self.within((at.surroundings, true), flows, |world| {
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
            let mut state = match rest.take() {
                Some(state) => state,
                None => {
                    // how softly it meets the bottom is known where it rests first
                    let mut fallen = self.fallen(places, at.surroundings)?;
                    solver.statics(rod, &mut fallen, world, ends).map_err(told)?;
                    fallen
                }
            };
            let forces = solver.statics(rod, &mut state, world, ends).map_err(told)?;
            *rest = Some(state.clone());
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

    /// The rod of a mesh other than that of `rod`.
    fn meshed(&self, kept: &Kept, rod: &Rod) -> Result<Option<Rod>, ClassError> {
        if kept.mesh().eq(rod.each_of_mesh()) {
            return Ok(None);
        }
        // what is attached stands behind the first part, whose elements alone come and go
        let mesh: Vec<_> = kept.mesh().collect();
        let before = self.base.rod.nodes() - 1;
        let shifted =
            |a: &rod::Attachment| rod::Attachment { node: (a.node + mesh.len()).saturating_sub(before), ..*a };
        let attached = self.base.attached.iter().map(shifted).collect();
        let segments = self.base.rod.segments().to_vec();
        Rod::with_mesh(self.base.rod.name(), segments, attached, &mesh).map(Some).map_err(told)
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
        if let Some(rod) = self.meshed(kept, &warm.rod)? {
            warm.take(rod);
        }
        let Warm { rod, solver, state, room, flows, .. } = warm;
        state.become_unpacked(rod, kept.motion).map_err(told)?;
        if dt > 0.0 {
            let of_first = |segment: usize| self.base.part.get(segment) == Some(&0);
            let nodes = rod.nodes();
            wind(rod, state, (self.first, self.nominal, dt), of_first)?;
            if rod.nodes() != nodes {
                *solver = solver_of(rod);
            }
            state.time = time - dt;
        } else {
            state.time = time;
        }
        let (forces, tangent) = self.within((at.surroundings, false), flows, |world| {
            if dt > 0.0 {
                let forces = solver.trial(rod, state, world, time, ends).map_err(told)?;
                solver.reached(state);
                Ok::<_, ClassError>((forces, solver.end_tangent_felt(rod, world, self.base.felt)))
            } else {
                let forces = solver.start(rod, state, world, ends).map_err(told)?;
                let mut tangent = EndTangent::default();
                for (side, mass) in solver.end_masses().iter().enumerate() {
                    tangent.acceleration.fixed_view_mut::<3, 3>(6 * side, 6 * side).copy_from(&-mass);
                }
                Ok((forces, Some(tangent)))
            }
        })?;
        self.layout.write(rod, state, room, trial)?;
        answer(out, &forces, tangent.as_ref(), true)
    }
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
        let Some(warm) = self.warm(guess) else { return Err(ClassError::new("the line has no memory")) };
        if let (Some(step), Some(kept)) = (at.step, &kept) {
            return self.step(at, (step.time, step.dt), kept, trial, warm, out);
        }
        let found = self.rest(at, warm)?;
        let Warm { rod, solver, room, flows, .. } = &mut *warm;
        let tangent = self.within((at.surroundings, true), flows, |world| solver.end_tangent(rod, world));
        answer(out, &found.forces, tangent.as_ref(), false)?;
        if let Some(step) = at.step {
            // a run begins here
            let mut state = found.state;
            state.time = step.time;
            self.layout.write(rod, &state, room, trial)?;
            let begun = trial.to_vec();
            if let Some(kept) = self.layout.read(&begun)? {
                return self.step(at, (step.time, 0.0), &kept, trial, warm, out);
            }
        }
        Ok(())
    }

    fn along(&self, at: &Situation, state: &[f64], out: &mut Vec<LineNode>) -> Result<(), ClassError> {
        let (mut other, base) = (None, &self.base.rod);
        let (state, still) = match self.layout.read(state)? {
            Some(kept) => {
                other = self.meshed(&kept, base)?;
                let state = State::unpack(other.as_ref().unwrap_or(base), kept.motion).map_err(told)?;
                (state, at.step.is_none())
            }
            None => (self.rest(at, &mut Warm::of(&self.base))?.state, true),
        };
        let rod = other.as_ref().unwrap_or(base);
        let ends = self.held(at.ends, still)?;
        out.clear();
        let found = self.within((at.surroundings, still), &mut Vec::new(), |world| rod.results(&state, world, &ends));
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
