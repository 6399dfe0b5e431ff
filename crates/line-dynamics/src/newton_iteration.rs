//! The linear system of a rod, one Newton iteration of a step, and its line search.
//!
//! The iteration is its own because factors serve several iterations and the end forces with them, and because nothing is allocated.

use super::condense::EndCondensation;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::step::Failure;
use super::system::Weights;
use super::trial::{Trial, largest_change};
use super::workspace::Workspace;

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

/// The linear system of a rod, with what Newton's iteration keeps from one iteration to the next.
#[derive(Clone, Debug)]
pub(super) struct NewtonSystem {
    /// Residual and tangent, or the factors of the tangent.
    pub work: Workspace,
    /// Shares of position, velocity and acceleration in the tangent.
    pub weights: Weights,
    /// The last change of the unknowns.
    pub change: Vec<f64>,
    pub line_search: LineSearch,
    /// The ends in the current tangent.
    pub ends: EndCondensation,
}

impl NewtonSystem {
    /// Memory for a rod.
    pub fn new(rod: &Rod) -> Self {
        let work = Workspace::new(rod);
        let size = work.stride() * rod.nodes();
        NewtonSystem {
            weights: Weights { k: 1.0, c: 0.0, m: 0.0 },
            change: vec![0.0; size],
            line_search: LineSearch::new(size),
            ends: EndCondensation::new(&work, size),
            work,
        }
    }

    /// Factors the tangent at the trial, and keeps the rows and columns of its ends.
    pub fn factor_tangent(&mut self, rod: &Rod, world: &LineEnvironment, trial: &Trial) -> Option<()> {
        let last = rod.elements.len();
        self.ends.moved = f64::INFINITY;
        self.work.assemble(rod, world, trial, self.weights, 0..last);
        self.ends.reset(&mut self.work);
        for (side, node) in [(0, 0), (1, last)] {
            if trial.ends[side].motion.is_some() {
                self.work.fix(node);
            }
        }
        self.work.factor().ok()?;
        self.ends.moved = 0.0;
        Some(())
    }

    /// One Newton iteration at the trial, with a fresh tangent or the existing factors: largest change of a coordinate
    /// (m), a turn taken on an arm of the shortest element. The forces of the ends are kept, taken on to the changed positions by their tangent.
    pub fn iterate(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        trial: &Trial,
        known: [bool; 2],
        fresh: bool,
    ) -> Result<f64, Failure> {
        let last = rod.elements.len();
        if fresh {
            self.ends.moved = f64::INFINITY;
            self.work.assemble(rod, world, trial, self.weights, 0..last);
            self.ends.reset(&mut self.work);
        } else {
            self.work.forces(rod, world, trial);
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
            self.ends.moved = 0.0;
        }
        self.work.newton(&mut self.change);
        // what is still to move counts, also where less of it is made
        let size = largest_change(&self.change, self.work.stride(), rod.shortest());
        self.line_search.damp_reversal(self.work.residuals(), &mut self.change);
        self.work.update_end_residuals(&self.change);
        // without a way out of the loop it goes many at a time
        if !self.change.iter().fold(true, |finite, c| finite & c.is_finite()) {
            return Err(Failure { node: self.work.largest_residual(known).0, why: "a force is not finite" });
        }
        Ok(size)
    }
}
