//! Rest of a stiff rod by continuation.
//!
//! A rod whose bending stiffness outweighs it does not fall into its shape as a chain does: let go of its stiffness it folds, and a
//! fold has no end of bending force. It is therefore followed from a shape that is known to one that is wanted: loads and places of
//! the ends go over from the one to the other by steps, each of which is Newton's iteration from the step before. A step that does
//! not converge is made shorter; where the shortest does not, as a strut buckles there, the rod falls into its next shape.

use super::ends::{RodEnd, RodEndMotion};
use super::environment::LineEnvironment;
use super::error::RodError;
use super::mesh::Rod;
use super::state::RodState;
use super::step::RodSolver;
use nalgebra::Vector3;

/// First and least step, as shares of the whole way.
const FIRST_STEP_SHARE: f64 = 0.25;
const MIN_STEP_SHARE: f64 = 1.0 / 256.0;
/// Newton iterations after which a fall into the next shape is given up.
const MAX_NEXT_SHAPE_ITERATIONS: usize = 600;
/// By how much a step grows after one that has converged.
const STEP_GROWTH: f64 = 2.0;

/// Where a continuation begins.
#[derive(Clone, Debug)]
struct ContinuationStart {
    state: RodState,
    /// Share of weight and given forces that is there already.
    loaded: f64,
}

impl Rod {
    /// Whether a rod of a weight (N) stands by its bending stiffness: EI / L^2 is above it. Every element bears compression and bends.
    pub(super) fn is_stiff(&self, weight: f64) -> bool {
        self.bending_force() > weight && self.elements.iter().all(|e| e.compression)
    }
}

impl RodSolver {
    /// Rest of a stiff rod: from the state, if that rests where its ends are, or else from the straight rod free of load. None where
    /// neither way leads there.
    pub(super) fn rest_by_continuation(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        ends: &[RodEnd; 2],
        mass: &[f64],
    ) -> Result<Option<usize>, RodError> {
        let mut done = 0;
        let near = ContinuationStart { state: state.clone(), loaded: 1.0 };
        for start in std::iter::once(near).chain(straight_start(rod, state, ends)) {
            if self.follow_path(rod, start, world, ends, mass, &mut done)? {
                return Ok(Some(done));
            }
        }
        Ok(None)
    }

    /// Whether the way from a start leads to the ends wanted: the trial is then there.
    fn follow_path(
        &mut self,
        rod: &Rod,
        mut start: ContinuationStart,
        world: &LineEnvironment,
        ends: &[RodEnd; 2],
        mass: &[f64],
        done: &mut usize,
    ) -> Result<bool, RodError> {
        let last = rod.elements.len();
        let from = [0, last].map(|node| start.state.position[node]);
        let (mut share, mut step) = (0.0, FIRST_STEP_SHARE);
        // nothing is moved at first: the start itself has to rest
        let mut to = 0.0;
        loop {
            if world.fluid.is_interrupted() {
                return Err(RodError::Interrupted { rod: rod.name.clone() });
            }
            let loaded = start.loaded + (1.0 - start.loaded) * to;
            let forces: Vec<_> = world.forces.iter().map(|(node, force)| (*node, force * loaded)).collect();
            let world = LineEnvironment { gravity: world.gravity * loaded, forces: &forces, ..*world };
            let between = [0, 1].map(|side| {
                let place = |motion: RodEndMotion| from[side] + (motion.position - from[side]) * to;
                RodEnd {
                    motion: ends[side].motion.map(|m| if to < 1.0 { RodEndMotion::at_rest(place(m)) } else { m }),
                    ..ends[side]
                }
            });
            self.set_trial_at_rest(rod, &start.state, &world, &between);
            let found = match self.rest_from_warm_start(rod, &start.state, &world, mass, &between) {
                None if to > 0.0 && step < MIN_STEP_SHARE => {
                    self.next_shape(rod, &start.state, &world, mass, &between)?
                }
                found => found,
            };
            match found {
                Some(count) => {
                    *done += count;
                    if to >= 1.0 {
                        return Ok(true);
                    }
                    start.state.position.copy_from_slice(&self.trial.x);
                    start.state.director.copy_from_slice(&self.trial.director);
                    (share, step) = (to, if to > 0.0 { STEP_GROWTH * step } else { step });
                }
                None if to == 0.0 || step < MIN_STEP_SHARE => return Ok(false),
                None => step *= 0.25,
            }
            to = (share + step).min(1.0);
        }
    }

    /// Falls from a state, moved along with its ends, into a shape beside it: the iterations it took.
    fn next_shape(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        mass: &[f64],
        ends: &[RodEnd; 2],
    ) -> Result<Option<usize>, RodError> {
        self.set_trial_at_rest(rod, state, world, ends);
        let (length, last) = (rod.length(), rod.elements.len());
        let moved = [0, last].map(|node| self.trial.x[node] - state.position[node]);
        for (x, (from, arc)) in self.trial.x.iter_mut().zip(state.position.iter().zip(rod.arc())) {
            let s = arc / length;
            *x = from + moved[0] * (1.0 - s) + moved[1] * s;
        }
        let mut done = 0;
        match self.solve_pseudo_transient(rod, world, mass, &mut done, MAX_NEXT_SHAPE_ITERATIONS) {
            Err(interrupted @ RodError::Interrupted { .. }) => Err(interrupted),
            made => Ok(made.is_ok().then_some(done)),
        }
    }
}

/// The straight rod free of load, from end A in the direction in which its ends are held, or to the other end; none of one whose shape free
/// of load is not known or not straight, or that lies on something.
fn straight_start(rod: &Rod, state: &RodState, ends: &[RodEnd; 2]) -> Option<ContinuationStart> {
    let [a, b] = ends.map(|end| end.motion.map(|motion| motion.position));
    let held = ends[0].direction.or(ends[1].direction).and_then(|d| d.try_normalize(1e-12));
    let chord = a.zip(b).and_then(|(a, b)| (b - a).try_normalize(1e-9));
    let along = held.or(chord)?;
    let arc = rod.arc();
    let root = match (a, b) {
        (Some(a), _) if ends[0].direction.is_some() || b.is_none() || held.is_none() => a,
        (_, Some(b)) => b - along * rod.length(),
        _ => return None,
    };
    if rod.twists() {
        return None;
    }
    let position: Vec<Vector3<f64>> = arc.iter().map(|s| root + along * *s).collect();
    Some(ContinuationStart { state: RodState { stuck: position.clone(), position, ..state.clone() }, loaded: 0.0 })
}
