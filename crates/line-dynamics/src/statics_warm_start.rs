//! Warm start of statics: a position of rest beside one that is known.

use super::ends::RodEnd;
use super::pseudo_transient::{PseudoTransient, StepOutcome, first_pseudo_step};
use super::state::RodState;
use super::statics_friction::has_compressed_element;
use super::trial::{largest_change, sample_fluid, turn_directors};
use nalgebra::Vector3;

/// Newton iterations after which it is looked for another way.
const MAX_NEWTON_ITERATIONS: usize = 12;
/// Largest move of a node, as a share of the shortest element, that an iteration may make.
const MAX_MOVE_SHARE: f64 = 0.5;
/// The same below which it need not be smaller than the one before.
const SMALL_MOVE_SHARE: f64 = 0.01;
/// Pseudo-step as a multiple of the first one: so long that Newton's iteration is left, and short enough to hold a node
/// that nothing else holds.
const PSEUDO_STEP_RATIO: f64 = 1e4;

/// Moves the trial, which is where the state is, to the position of rest beside it: by the linear response to the
/// move of the ends, and Newton's iteration from there. The iterations it took; none if the state did not rest, or
/// the ends have moved too far.
pub(super) fn rest_from_warm_start(
    pseudo: &mut PseudoTransient,
    state: &RodState,
    ends: &[RodEnd; 2],
) -> Option<usize> {
    let (rod, world) = (pseudo.rod, pseudo.world);
    let last = rod.elements.len();
    let step = PSEUDO_STEP_RATIO * first_pseudo_step(rod, world);
    let mut done = 0;
    if (0..2).any(|side| ends[side].motion.is_some_and(|m| m.position != state.position[side * last])) {
        done += 1;
        move_with_ends(pseudo, state, ends, step)?;
    }
    let from = pseudo.trial.x.clone();
    let mut before = f64::INFINITY;
    while done < MAX_NEWTON_ITERATIONS {
        done += 1;
        match pseudo.iterate(&from, step) {
            StepOutcome::Converged => return Some(done).filter(|_| !has_compressed_element(pseudo.trial, pseudo.rod)),
            // nodes that meet the bottom anew or leave it take some iterations before their moves shrink
            StepOutcome::Moved { share, .. }
                if share < SMALL_MOVE_SHARE || (share < MAX_MOVE_SHARE && share < 0.5 * before) =>
            {
                before = share
            }
            _ => return None,
        }
    }
    None
}

/// Moves the nodes by the linear response to the move of the ends.
fn move_with_ends(pseudo: &mut PseudoTransient, state: &RodState, ends: &[RodEnd; 2], step: f64) -> Option<()> {
    let (rod, world) = (pseudo.rod, pseudo.world);
    let (last, stride) = (rod.elements.len(), pseudo.system.work.stride());
    pseudo.trial.x.copy_from_slice(&state.position);
    sample_fluid(world, state.time, pseudo.trial);
    for fluid in &mut pseudo.trial.fluid {
        fluid.acceleration = Vector3::zeros();
    }
    pseudo.system.work.assemble(rod, world, pseudo.trial, pseudo.system.weights, 0..last);
    for (node, m) in pseudo.mass.iter().enumerate() {
        pseudo.system.work.add_node_inertia(node, m / (step * step), &Vector3::zeros());
    }
    for (side, node) in [(0, 0), (1, last)] {
        if let Some(motion) = ends[side].motion {
            pseudo.system.work.fix(node);
            pseudo.system.work.prescribe_change(node, &(motion.position - state.position[node]));
        }
    }
    if pseudo.system.work.factor().ok()? > 0 {
        return None;
    }
    pseudo.system.work.newton(&mut pseudo.system.change);
    let size = largest_change(&pseudo.system.change, stride, rod.shortest());
    if !size.is_finite() || pseudo.relative_change(size) > MAX_MOVE_SHARE {
        return None;
    }
    turn_directors(&mut pseudo.trial.director, &pseudo.trial.x, &pseudo.system.change, stride, [false; 2]);
    for (x, d) in pseudo.trial.x.iter_mut().zip(pseudo.system.change.chunks_exact(stride)) {
        *x += Vector3::new(d[0], d[1], d[2]);
    }
    for (side, node) in [(0, 0), (1, last)] {
        if let Some(motion) = ends[side].motion {
            pseudo.trial.x[node] = motion.position;
        }
    }
    Some(())
}
