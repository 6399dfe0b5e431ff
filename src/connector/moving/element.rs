//! A line that moves by itself as an engine sees it.

use super::answer::answer;
use super::around::{Floor, Water};
use super::kept::{Kept, Layout};
use super::mesh::{told, wind};
use super::start;
use super::warm::{Base, Held, Warm, solver_of};
use crate::language::units::Dim;
use crate::model::{
    ClassError, Element, End, Flow, Guess, LineBooks, LineMode, LineNode, Response, Situation, Six, Summary,
    Surroundings,
};
use crate::rod::{self, Balance, EndForces, EndTangent, Ground, Motion, Rod, State, World};
use nalgebra::Vector3;
use std::cell::RefCell;
use std::sync::Arc;

/// An end may lie this much below the bottom (m).
const BELOW: f64 = 1e-3;

/// What is said of a line that was given memory not its own.
const NO_MEMORY: &str = "the line has no memory";

/// A line between two ends.
#[derive(Debug)]
pub struct MovingLine {
    pub(super) base: Arc<Base>,
    pub(super) layout: Layout,
    /// Length of the first part (m), and of its elements as the class has them.
    pub(super) first: f64,
    pub(super) nominal: f64,
}

/// A line at rest.
struct Rest {
    state: State,
    forces: EndForces,
}

impl MovingLine {
    pub(super) fn warm<'a>(&self, guess: &'a mut Guess) -> Option<&'a mut Warm> {
        let fits = |g: &Box<dyn std::any::Any + Send>| {
            g.downcast_ref::<Warm>().is_some_and(|w| Arc::ptr_eq(&w.base, &self.base))
        };
        if !guess.as_ref().is_some_and(fits) {
            *guess = Some(Box::new(Warm::of(&self.base)));
        }
        guess.as_mut()?.downcast_mut::<Warm>()
    }

    /// The line's surroundings, at rest or under way, for what needs them; `flows` is room for what is asked of the water.
    pub(super) fn within<T>(
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
        let made = act(&World { bottom, slam: self.base.description.slam, ..World::new(&water, around.gravity) });
        *flows = water.flows.into_inner();
        made
    }

    /// What holds the ends.
    pub(super) fn held(&self, ends: &[End], still: bool) -> Result<[rod::End; 2], ClassError> {
        let [first, second] = ends else { return Err(ClassError::new("a line has two ends")) };
        let made = |end: &End, hold: &Option<Held>| {
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
    pub(super) fn meshed(&self, kept: &Kept, rod: &Rod) -> Result<Option<Rod>, ClassError> {
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

    /// Its motion as a state has it, or where it rests if it has not begun, with its rod where that is not the one it was made with;
    /// and whether that is without the waves.
    pub(super) fn where_it_is(&self, at: &Situation, state: &[f64]) -> Result<(Option<Rod>, State, bool), ClassError> {
        let base = &self.base.rod;
        match self.layout.read(state)? {
            Some(kept) => {
                let other = self.meshed(&kept, base)?;
                let state = State::unpack(other.as_ref().unwrap_or(base), kept.motion).map_err(told)?;
                Ok((other, state, at.step.is_none()))
            }
            None => Ok((None, self.rest(at, &mut Warm::of(&self.base))?.state, true)),
        }
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
        let Warm { rod, solver, state, flows, .. } = warm;
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
                Ok::<_, ClassError>((forces, solver.end_tangent_felt(rod, world, self.base.felt)))
            } else {
                // what a broken line springs back with lasts for a wave along an element, not for a step: it goes on as it moved
                let before = self.base.freed.then(|| state.clone());
                let forces = solver.start(rod, state, world, ends).map_err(told)?;
                if let Some(before) = before {
                    state.clone_from(&before);
                }
                let mut tangent = EndTangent::default();
                for (side, mass) in solver.end_masses().iter().enumerate() {
                    tangent.acceleration.fixed_view_mut::<3, 3>(6 * side, 6 * side).copy_from(&-mass);
                }
                Ok((forces, Some(tangent)))
            }
        })?;
        let books = self.layout.has_books().then(|| {
            self.within((at.surroundings, false), flows, |world| match kept.balance {
                Some(mut balance) if dt > 0.0 => {
                    solver.reached(state);
                    balance.enter(rod, state, world, solver, &forces);
                    balance
                }
                Some(balance) => balance,
                None => Balance::open(rod, state, world, solver, &forces),
            })
        });
        let end = if dt > 0.0 { solver.end() } else { state };
        self.layout.write(rod, end, trial)?;
        if let Some(balance) = books {
            self.layout.keep_books(&balance, trial);
        }
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
        let Some(warm) = self.warm(guess) else { return Err(ClassError::new(NO_MEMORY)) };
        if let (Some(step), Some(kept)) = (at.step, &kept) {
            return self.step(at, (step.time, step.dt), kept, trial, warm, out);
        }
        let found = self.rest(at, warm)?;
        let Warm { rod, solver, flows, .. } = &mut *warm;
        let tangent = self.within((at.surroundings, true), flows, |world| solver.end_tangent(rod, world));
        answer(out, &found.forces, tangent.as_ref(), false)?;
        self.layout.write(rod, &found.state, trial)?;
        if let Some(step) = at.step {
            // a run begins here
            let mut state = found.state;
            state.time = step.time;
            self.layout.write(rod, &state, trial)?;
            let begun = trial.to_vec();
            if let Some(kept) = self.layout.read(&begun)? {
                // its books are not open yet
                let kept = kept.without_books();
                return self.step(at, (step.time, 0.0), &kept, trial, warm, out);
            }
        }
        Ok(())
    }

    fn books(&self, state: &[f64]) -> Option<LineBooks> {
        self.tell_books(state)
    }

    fn along(&self, at: &Situation, state: &[f64], out: &mut Vec<LineNode>) -> Result<(), ClassError> {
        self.tell_along(at, state, out)
    }

    fn row(&self, at: &Situation, state: &[f64], guess: &mut Guess, out: &mut Vec<LineNode>) -> Result<(), ClassError> {
        self.tell_row(at, state, guess, out)
    }

    fn swings(&self, at: &Situation, state: &[f64], number: usize) -> Result<Vec<LineMode>, ClassError> {
        self.tell_modes(at, state, number)
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<Summary, ClassError> {
        self.tell_summary(at, committed)
    }
}
