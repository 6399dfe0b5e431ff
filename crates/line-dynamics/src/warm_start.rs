//! Warm start of a trial from the previous trial of the same step, as when a body iterates on its own motion.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::newton_iteration::NewtonSystem;
use super::scheme::StepScheme;
use super::state::RodState;
use super::trial::{Trial, largest_change, turn_directors};
use nalgebra::Vector3;

/// Largest move of a node, as a share of the shortest element, that is predicted from the previous trial.
const MAX_PREDICTED_MOVE: f64 = 0.1;
/// A move below this share of the tolerance is made by the linear response alone. An iteration ends with a move within the
/// tolerance, without another residual; this move is a hundred times smaller, so the residual it leaves, which goes by its
/// square, is ten thousand times smaller, however many such moves a step has.
const LINEAR_MOVE_SHARE: f64 = 1e-2;

/// What is left to do after the prediction from the previous trial.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum WarmStart {
    /// Newton iterations with the existing factors.
    Iterate,
    /// Nothing: the move was so small that the end forces are updated linearly, too.
    Converged,
}

/// The prediction of a trial from the previous one of the same step, whose tangent is at hand.
pub(super) struct TrialPrediction<'a> {
    pub rod: &'a Rod,
    pub world: &'a LineEnvironment<'a>,
    pub scheme: &'a StepScheme,
    /// Where the step begins.
    pub from: &'a RodState,
    /// The previous trial.
    pub trial: &'a Trial,
    pub system: &'a mut NewtonSystem,
    /// Where it ended, and this one begins.
    pub next: &'a mut RodState,
    /// Convergence tolerance, as a share of the shortest element.
    pub tolerance: f64,
}

impl TrialPrediction<'_> {
    /// Begins a trial where the last one of the step ended, moved by the linear response to what is new in the motion
    /// of the ends; none if the last one is too far away.
    pub fn move_with_ends(self, ends: &[RodEnd; 2], elsewhere: [bool; 2]) -> Option<WarmStart> {
        let TrialPrediction { rod, world, scheme, from, trial, system, next, tolerance } = self;
        let (stride, last) = (system.work.stride(), rod.elements.len());
        let size = system.change.len();
        let known = ends.map(|e| e.motion.is_some());
        let held = |row: usize| match row.checked_sub(stride * last) {
            Some(axis) if known[1] && axis < 3 => Some((1, axis)),
            _ => (known[0] && row < 3).then_some((0, row)),
        };
        // what the ends themselves feel of velocities and accelerations the scheme does not make
        let mut end_changes = [Vector3::zeros(); 2];
        // and the moves with which the scheme would make them
        let mut aside: f64 = 0.0;
        system.change.fill(0.0);
        for (side, node) in [(0, 0), (1, last)] {
            let (Some(old), Some(new)) = (trial.ends[side].motion, ends[side].motion) else { continue };
            if !elsewhere[side] {
                continue;
            }
            let position = stride * node;
            let moved = new.position - old.position;
            // the matrix has the columns of the ends, with velocity and acceleration as the scheme makes them follow
            let faster = new.velocity - old.velocity - moved * system.weights.c;
            let harder = new.acceleration - old.acceleration - moved * system.weights.m;
            aside = aside.max(faster.amax() / system.weights.c).max(harder.amax() / system.weights.m);
            for axis in 0..3 {
                let by = [&system.ends.columns[1][side][axis], &system.ends.columns[2][side][axis]];
                for (i, (c, m)) in by[0].iter().zip(by[1]).enumerate() {
                    let row = (position + axis + i + 1).checked_sub(by[0].len().div_ceil(2));
                    let Some(row) = row.filter(|row| *row < size) else { continue };
                    let force = c * faster[axis] + m * harder[axis];
                    match held(row) {
                        Some((side, axis)) => end_changes[side][axis] += force,
                        None => system.change[row] -= force,
                    }
                }
            }
            system.change[position..position + 3].copy_from_slice(moved.as_slice());
        }
        system.work.solve(&mut system.change);
        let most = largest_change(&system.change, stride, rod.shortest());
        let share = most / rod.shortest();
        if share > MAX_PREDICTED_MOVE {
            return None;
        }
        system.ends.moved += most;
        turn_directors(&mut next.director, &next.position, &system.change, stride, [false; 2]);
        next.move_nodes(&system.change, stride);
        scheme.set_motions(from, next);
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                next.hold(node, &motion);
            }
        }
        // what holds an end turns it otherwise
        let turned = |side: usize| {
            let (old, new) = (&trial.ends[side], &ends[side]);
            old.direction != new.direction || old.side != new.side || old.rotation != new.rotation
        };
        let all = share.max(aside / rod.shortest());
        // supports that have moved are met by an iteration
        if !world.supports.is_empty() {
            return Some(WarmStart::Iterate);
        }
        if all > LINEAR_MOVE_SHARE * tolerance || turned(0) || turned(1) {
            return Some(WarmStart::Iterate);
        }
        system.work.update_end_residuals(&system.change);
        system.work.add_to_end_residuals(&end_changes);
        Some(WarmStart::Converged)
    }
}
