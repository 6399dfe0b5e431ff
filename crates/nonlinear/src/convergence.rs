//! When an iteration has converged: its residual is within the tolerance, or near it and falls no further because rounding is all that is
//! left.

/// Tolerances within which a residual that falls no further is one of rounding.
const ROUNDING_TOLERANCES: f64 = 64.0;

/// How an iteration stands after a residual.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ConvergenceStatus {
    /// The residual is the least so far.
    Improved,
    /// A residual before was as small.
    NotImproved,
    /// The residual is the least so far and within the tolerance.
    Converged,
    /// The residual is near the tolerance and falls no further: the answer is as good as rounding allows.
    Stalled,
}

impl ConvergenceStatus {
    /// Whether the residual is the least so far.
    pub fn is_improved(self) -> bool {
        matches!(self, ConvergenceStatus::Improved | ConvergenceStatus::Converged)
    }

    /// Whether the iteration ends.
    pub fn is_final(self) -> bool {
        matches!(self, ConvergenceStatus::Converged | ConvergenceStatus::Stalled)
    }
}

/// The residuals of an iteration against their tolerance.
#[derive(Clone, Copy, Debug)]
pub struct Convergence {
    tolerance: f64,
    least: f64,
}

impl Convergence {
    /// An iteration whose residual is to fall to a tolerance: a rounding of what it is the difference of.
    pub fn new(tolerance: f64) -> Self {
        Convergence { tolerance, least: f64::INFINITY }
    }

    /// Records a residual, zero or more.
    pub fn record(&mut self, residual: f64) -> ConvergenceStatus {
        let improved = residual < self.least;
        if improved {
            self.least = residual;
        }
        match improved {
            true if residual <= self.tolerance => ConvergenceStatus::Converged,
            true => ConvergenceStatus::Improved,
            // the least one is then as near
            false if self.is_near(residual) => ConvergenceStatus::Stalled,
            false => ConvergenceStatus::NotImproved,
        }
    }

    /// Whether a residual is so near the tolerance that rounding decides how it changes.
    pub fn is_near(&self, residual: f64) -> bool {
        residual <= ROUNDING_TOLERANCES * self.tolerance
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn residual_near_tolerance_that_stays_ends_the_iteration() {
        let mut convergence = Convergence::new(1.0);
        let made = [1e3, 2e3, 40.0, 41.0].map(|residual| convergence.record(residual));
        use ConvergenceStatus::{Improved, NotImproved, Stalled};
        assert_eq!(made, [Improved, NotImproved, Improved, Stalled]);
        assert_eq!(Convergence::new(1.0).record(1.0), ConvergenceStatus::Converged);
        assert_eq!(Convergence::new(1.0).record(f64::NAN), NotImproved);
        assert!(convergence.is_near(64.0) && !convergence.is_near(65.0));
        assert!(Stalled.is_final() && !Stalled.is_improved() && Improved.is_improved() && !Improved.is_final());
    }
}
