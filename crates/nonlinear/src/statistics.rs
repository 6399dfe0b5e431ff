//! What a Newton iteration took and what it left.

use std::ops::AddAssign;

/// Effort and result of an iteration, or of several together.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NewtonStatistics {
    /// Iterations: systems solved.
    pub iterations: usize,
    /// Iterations whose step a line search shortened.
    pub damped_steps: usize,
    /// Evaluations of the residual.
    pub evaluations: usize,
    /// Largest residual left, in the measure and unit of the solver.
    pub residual: f64,
}

impl AddAssign for NewtonStatistics {
    /// Adds the effort of an iteration that went on from there; the residual becomes the one it left.
    fn add_assign(&mut self, other: Self) {
        self.iterations += other.iterations;
        self.damped_steps += other.damped_steps;
        self.evaluations += other.evaluations;
        self.residual = other.residual;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sum_counts_all_effort_and_has_last_residual() {
        let one = NewtonStatistics { iterations: 2, damped_steps: 1, evaluations: 5, residual: 1e-9 };
        let mut sum = one;
        sum += NewtonStatistics { residual: 1e-12, ..one };
        assert_eq!(sum, NewtonStatistics { iterations: 4, damped_steps: 2, evaluations: 10, residual: 1e-12 });
    }
}
