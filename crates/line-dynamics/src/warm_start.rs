//! Warm start of a trial from the previous trial of the same step, as when a body iterates on its own motion.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::scheme::StepScheme;
use super::state::RodState;
use super::step::{RodSolver, SolverPhase};
use super::trial::{largest_change, turn_directors};
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

impl RodSolver {
    /// Takes the end of the last trial as the trial's motion.
    pub(super) fn set_trial_from_next(&mut self) {
        self.trial.x.copy_from_slice(&self.next.position);
        self.trial.v.copy_from_slice(&self.next.velocity);
        self.trial.a.copy_from_slice(&self.next.acceleration);
        self.trial.director.copy_from_slice(&self.next.director);
    }

    /// Whether the last trial was of the same step, made in one part.
    pub(super) fn is_same_step(&self, state: &RodState, time: f64, ends: &[RodEnd; 2]) -> bool {
        let held = |ends: &[RodEnd; 2]| ends.map(|e| e.motion.is_some());
        self.phase == SolverPhase::Trial
            && self.is_single_part
            && self.next.time == time
            && held(&self.trial.ends) == held(ends)
            && self.step_start.is_same(state)
    }

    /// Begins a trial where the last one of the step ended, moved by the linear response to what is new in the motion
    /// of the ends; none if the last one is too far away.
    pub(super) fn predict_from_last_trial(
        &mut self,
        rod: &Rod,
        from: &RodState,
        world: &LineEnvironment,
        scheme: &StepScheme,
        ends: &[RodEnd; 2],
    ) -> Option<WarmStart> {
        let elsewhere = [0, 1].map(|side: usize| self.trial.ends[side].motion != ends[side].motion);
        self.linearise(rod, world, false, elsewhere)?;
        let (stride, last) = (self.work.stride(), rod.elements.len());
        let size = self.change.len();
        let known = ends.map(|e| e.motion.is_some());
        let held = |row: usize| match row.checked_sub(stride * last) {
            Some(axis) if known[1] && axis < 3 => Some((1, axis)),
            _ => (known[0] && row < 3).then_some((0, row)),
        };
        // what the ends themselves feel of velocities and accelerations the scheme does not make
        let mut end_changes = [Vector3::zeros(); 2];
        // and the moves with which the scheme would make them
        let mut aside: f64 = 0.0;
        self.change.fill(0.0);
        for (side, node) in [(0, 0), (1, last)] {
            let (Some(old), Some(new)) = (self.trial.ends[side].motion, ends[side].motion) else { continue };
            if !elsewhere[side] {
                continue;
            }
            let place = stride * node;
            let moved = new.position - old.position;
            // the matrix has the columns of the ends, with velocity and acceleration as the scheme makes them follow
            let faster = new.velocity - old.velocity - moved * self.weights.c;
            let harder = new.acceleration - old.acceleration - moved * self.weights.m;
            aside = aside.max(faster.amax() / self.weights.c).max(harder.amax() / self.weights.m);
            for axis in 0..3 {
                let by = [&self.end_jacobian.columns[1][side][axis], &self.end_jacobian.columns[2][side][axis]];
                for (i, (c, m)) in by[0].iter().zip(by[1]).enumerate() {
                    let row = (place + axis + i + 1).checked_sub(by[0].len().div_ceil(2));
                    let Some(row) = row.filter(|row| *row < size) else { continue };
                    let force = c * faster[axis] + m * harder[axis];
                    match held(row) {
                        Some((side, axis)) => end_changes[side][axis] += force,
                        None => self.change[row] -= force,
                    }
                }
            }
            self.change[place..place + 3].copy_from_slice(moved.as_slice());
        }
        self.work.solve(&mut self.change);
        let most = largest_change(&self.change, stride, rod.shortest());
        let share = most / rod.shortest();
        if share > MAX_PREDICTED_MOVE {
            return None;
        }
        self.end_jacobian.moved += most;
        let next = &mut self.next;
        turn_directors(&mut next.director, &next.position, &self.change, stride, [false; 2]);
        next.move_nodes(&self.change, stride);
        scheme.set_motions(from, next);
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                next.hold(node, &motion);
            }
        }
        // what holds an end turns it otherwise
        let turned = |side: usize| {
            let (old, new) = (&self.trial.ends[side], &ends[side]);
            old.direction != new.direction || old.side != new.side || old.rotation != new.rotation
        };
        let all = share.max(aside / rod.shortest());
        // supports that have moved are met by an iteration
        if !world.supports.is_empty() {
            return Some(WarmStart::Iterate);
        }
        if all > LINEAR_MOVE_SHARE * self.settings.tolerance || turned(0) || turned(1) {
            return Some(WarmStart::Iterate);
        }
        self.work.update_end_residuals(&self.change);
        self.work.add_to_end_residuals(&end_changes);
        Some(WarmStart::Converged)
    }
}
