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
use super::pseudo_transient::PseudoTransient;
use super::state::RodState;
use super::statics_warm_start::rest_from_warm_start;
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

/// Rest of a stiff rod: from the state, if that rests where its ends are, or else from the straight rod free of load. None where
/// neither way leads there.
pub(super) fn rest_by_continuation(
    pseudo: &mut PseudoTransient,
    state: &RodState,
    ends: &[RodEnd; 2],
) -> Result<Option<usize>, RodError> {
    let mut done = 0;
    let near = ContinuationStart { state: state.clone(), loaded: 1.0 };
    for start in std::iter::once(near).chain(straight_start(pseudo.rod, state, ends)) {
        if follow_path(pseudo, start, ends, &mut done)? {
            return Ok(Some(done));
        }
    }
    Ok(None)
}

/// Whether the way from a start leads to the ends wanted: the trial is then there.
fn follow_path(
    pseudo: &mut PseudoTransient,
    mut start: ContinuationStart,
    ends: &[RodEnd; 2],
    done: &mut usize,
) -> Result<bool, RodError> {
    let (rod, outer) = (pseudo.rod, pseudo.world);
    let last = rod.elements.len();
    let from = [0, last].map(|node| start.state.position[node]);
    let (mut share, mut step) = (0.0, FIRST_STEP_SHARE);
    // nothing is moved at first: the start itself has to rest
    let mut to = 0.0;
    loop {
        if outer.fluid.is_interrupted() {
            return Err(RodError::Interrupted { rod: rod.name.clone() });
        }
        let loaded = start.loaded + (1.0 - start.loaded) * to;
        let forces: Vec<_> = outer.forces.iter().map(|(node, force)| (*node, force * loaded)).collect();
        let world = LineEnvironment { gravity: outer.gravity * loaded, forces: &forces, ..*outer };
        let mut pseudo = pseudo.in_world(&world);
        let between = [0, 1].map(|side| {
            let position = |motion: RodEndMotion| from[side] + (motion.position - from[side]) * to;
            RodEnd {
                motion: ends[side].motion.map(|m| if to < 1.0 { RodEndMotion::at_rest(position(m)) } else { m }),
                ..ends[side]
            }
        });
        pseudo.set_trial_at_rest(&start.state, &between);
        let found = match rest_from_warm_start(&mut pseudo, &start.state, &between) {
            None if to > 0.0 && step < MIN_STEP_SHARE => find_next_shape(&mut pseudo, &start.state, &between)?,
            found => found,
        };
        match found {
            Some(count) => {
                *done += count;
                if to >= 1.0 {
                    return Ok(true);
                }
                start.state.position.copy_from_slice(&pseudo.trial.x);
                start.state.director.copy_from_slice(&pseudo.trial.director);
                (share, step) = (to, if to > 0.0 { STEP_GROWTH * step } else { step });
            }
            None if to == 0.0 || step < MIN_STEP_SHARE => return Ok(false),
            None => step *= 0.25,
        }
        to = (share + step).min(1.0);
    }
}

/// Falls from a state, moved along with its ends, into a shape beside it: the iterations it took.
fn find_next_shape(
    pseudo: &mut PseudoTransient,
    state: &RodState,
    ends: &[RodEnd; 2],
) -> Result<Option<usize>, RodError> {
    pseudo.set_trial_at_rest(state, ends);
    let rod = pseudo.rod;
    let (length, last) = (rod.length(), rod.elements.len());
    let moved = [0, last].map(|node| pseudo.trial.x[node] - state.position[node]);
    for (x, (from, arc)) in pseudo.trial.x.iter_mut().zip(state.position.iter().zip(rod.arc())) {
        let s = arc / length;
        *x = from + moved[0] * (1.0 - s) + moved[1] * s;
    }
    let mut done = 0;
    match pseudo.solve(&mut done, MAX_NEXT_SHAPE_ITERATIONS) {
        Err(interrupted @ RodError::Interrupted { .. }) => Err(interrupted),
        made => Ok(made.is_ok().then_some(done)),
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
