//! Predictor of a step, one Newton iteration of it, and its line search.
//!
//! The iteration is its own because factors serve several iterations and the end forces with them, and because nothing is allocated.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::scheme::StepScheme;
use super::state::RodState;
use super::step::{Failure, RodSolver};
use super::trial::{largest_change, transport_directors};

/// Least share of a change, and of the way back, that is left where a change is cut short: a line of work that ends nearer to either
/// place than this says no more than that the work has a kink there.
const MIN_LINE_SEARCH_SHARE: f64 = 0.1;

/// Line search of Newton's iteration: the last change, and the residual that asked for it.
#[derive(Clone, Debug)]
pub(super) struct LineSearch {
    change: Vec<f64>,
    residual: Vec<f64>,
    /// Whether there is one.
    known: bool,
}

impl LineSearch {
    pub fn new(size: usize) -> Self {
        LineSearch { change: vec![0.0; size], residual: vec![0.0; size], known: false }
    }

    pub fn reset(&mut self) {
        self.known = false;
    }

    /// Shortens a change that takes back half or more of the one before, as happens without end between two places at which an element is
    /// slack and taut. The shortened change ends where the work of the residual (J), taken as linear between the two, is zero: the least
    /// energy.
    fn damp_reversal(&mut self, residual: &[f64], change: &mut [f64]) {
        if self.known && product(change, &self.change) < -0.5 * product(&self.change, &self.change) {
            let [before, here] = [&self.residual, residual].map(|residual| product(residual, &self.change));
            let share = here / (here - before);
            let share = if share > MIN_LINE_SEARCH_SHARE && share < 1.0 - MIN_LINE_SEARCH_SHARE { share } else { 0.5 };
            change.iter_mut().for_each(|c| *c *= share);
        }
        self.change.copy_from_slice(change);
        self.residual.copy_from_slice(residual);
        self.known = true;
    }
}

/// Scalar product of two lists, summed four at a time so that no sum waits for the one before it.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let ((fours, rest), (others, left)) = (a.as_chunks::<4>(), b.as_chunks::<4>());
    let mut sums = [0.0; 4];
    for (a, b) in fours.iter().zip(others) {
        for ((sum, a), b) in sums.iter_mut().zip(a).zip(b) {
            *sum += a * b;
        }
    }
    sums.iter().sum::<f64>() + rest.iter().zip(left).map(|(a, b)| a * b).sum::<f64>()
}

impl RodSolver {
    /// Where a step ends if its averaged accelerations stay.
    pub(super) fn predict_step(&mut self, from: &RodState, scheme: &StepScheme, time: f64, ends: &[RodEnd; 2]) {
        let next = &mut self.next;
        next.bedding.copy_from_slice(&from.bedding);
        (next.time, next.origin) = (time, from.origin);
        let last = from.position.len() - 1;
        scheme.predict(from, next);
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                next.hold(node, &motion);
            }
        }
        next.director.copy_from_slice(&from.director);
        transport_directors(&mut next.director, &from.position, &next.position);
    }

    /// One Newton iteration at the trial, with a fresh tangent or the existing factors: largest change of a coordinate
    /// (m), a turn taken on an arm of the shortest element. The forces of the ends are kept, taken on to the changed positions by their tangent.
    pub(super) fn iterate(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        known: [bool; 2],
        fresh: bool,
    ) -> Result<f64, Failure> {
        let last = rod.elements.len();
        if fresh {
            self.end_jacobian.moved = f64::INFINITY;
            self.work.assemble(rod, world, &self.trial, self.weights, 0..last);
            self.reset_end_jacobian();
        } else {
            self.work.forces(rod, world, &self.trial);
        }
        self.work.store_end_residuals();
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.drop_residual(node);
                if fresh {
                    self.work.fix(node);
                }
            }
        }
        if fresh {
            self.work.factor().map_err(|node| Failure { node, why: "its stiffness vanishes" })?;
            self.end_jacobian.moved = 0.0;
        }
        self.work.newton(&mut self.change);
        // what is still to move counts, also where less of it is made
        let size = largest_change(&self.change, self.work.stride(), rod.shortest());
        self.line_search.damp_reversal(self.work.residuals(), &mut self.change);
        self.work.update_end_residuals(&self.change);
        // without a way out of the loop it goes many at a time
        if !self.change.iter().fold(true, |finite, c| finite & c.is_finite()) {
            return Err(Failure { node: self.work.largest_residual(known).0, why: "a force is no number" });
        }
        Ok(size)
    }
}
