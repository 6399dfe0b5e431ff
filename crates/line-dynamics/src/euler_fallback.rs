//! Implicit Euler as fallback for steps that do not resolve an impact: a line that snaps taut or goes slack, a node that hits the bottom.
//!
//! The generalised-alpha scheme carries the acceleration of a step into the next ones, as an average; of a smooth motion
//! that makes it of the second order. But where a stiff line snaps taut the whole change of speed V is the acceleration
//! V/h of one step, and once the line has let go most of it acts once more out of the past: a mass that meets a stiff
//! rope with speed V leaves it with 2.9 V at a spectral radius of 0.9, and still with 1.5 V at 0.2. What is made so at
//! one bounce comes back at the next.
//!
//! Such a step is repeated by implicit Euler, whose only history is the velocity. Its step from x with speed v
//! minimises m (y - x - h v)^2 / (2 h^2) + potential(y), so with a convex potential, as tension, gravity and bottom of
//! a line that cannot push are, no step of any length makes energy; that is why it is the scheme of impacts
//! [BROGLIATO-2008 10]. It is of the first order,
//! but a motion that the step follows never comes to it, and so keeps its order.

use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::state::RodState;
use super::trial::Trial;

/// Share of the energy of motion that the energy of the changes of speed by changed accelerations has at least in a step of
/// a snap. Of an oscillation it is some (w h)^2, so that the step no longer follows one of w h > 0.3.
const MIN_JUMP_ENERGY_SHARE: f64 = 0.1;
/// Change of acceleration that a node has at least in such a step, as a share of gravity: what is less throws nothing
/// up by more than it falls in a step.
const MIN_JUMP_ACCELERATION: f64 = 1.0;

/// Whether accelerations have changed in the step that led to `next` by more than it follows.
pub(super) fn has_jump(rod: &Rod, world: &LineEnvironment, trial: &Trial, from: &RodState, next: &RodState) -> bool {
    let (last, h) = (rod.elements.len(), next.time - from.time);
    let known = trial.ends.map(|e| e.motion.is_some());
    let least = MIN_JUMP_ACCELERATION * world.gravity.abs();
    let change = |node: usize| {
        if (node == 0 && known[0]) || (node == last && known[1]) {
            return 0.0;
        }
        let a = &next.acceleration[node];
        (from.averaged[node] - a).norm_squared().max((from.acceleration[node] - a).norm_squared())
    };
    if !(0..=last).any(|node| change(node) > least * least) {
        return false;
    }
    let (mut jumped, mut moving) = (0.0, 0.0);
    let masses = (0..last).flat_map(|i| [i, i + 1].map(|node| (node, rod.elements[i].mass)));
    for (node, mass) in masses.chain(rod.attachments.iter().map(|a| (a.node, a.mass))) {
        // an oscillation has its acceleration where it has no speed
        let begun = from.velocity[node].norm_squared().max(from.acceleration[node].norm_squared() * h * h);
        jumped += mass * change(node) * h * h;
        moving += mass * begun.max(next.velocity[node].norm_squared());
    }
    jumped > MIN_JUMP_ENERGY_SHARE * moving
}
