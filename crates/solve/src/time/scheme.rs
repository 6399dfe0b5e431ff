//! How accelerations become velocities and places over a step.
//!
//! Implicit schemes are those of Newmark and the generalised-alpha family in the form of
//! [ARNOLD-BRULS-2007 eq. 3 to 6], which holds the balance of forces at the end of each step exactly and advances the
//! motion by an auxiliary acceleration:
//! `(1 - am) b1 + am b0 = (1 - af) a1 + af a0`, `v1 = v0 + h ((1 - g) b0 + g b1)`, `q1 = q0 + h v0 + h2 ((1/2 - b) b0 + b b1)`.
//! With am = af = 0 that is Newmark's (b = a). Rotations are advanced by the rotation vector of the step
//! [BRULS-2012], which keeps the order.

use windlass_base::pose::Six;
use windlass_model::SchemeWeights;

/// Weights of an implicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimeScheme {
    /// Share of the old auxiliary acceleration.
    pub alpha_m: f64,
    /// Share of the old acceleration.
    pub alpha_f: f64,
    /// Newmark's beta.
    pub beta: f64,
    /// Newmark's gamma, which MOSES calls ALPHA.
    pub gamma: f64,
}

/// How a run steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// An implicit scheme, each step solved by Newton's iteration.
    Implicit(TimeScheme),
    /// Predictor and corrector (`-NEWMARK NO`): Euler's step ahead, corrected by the trapezoidal rule, over and over up to the
    /// number and tolerance of `-CONVERGE`. Needs small steps.
    Corrector,
}

/// Spectral radius at infinite frequency of the default scheme.
const DEFAULT_SPECTRAL_RADIUS: f64 = 0.9;

/// That with dynamic lines: their own.
const RHO_OF_LINES: f64 = 0.2;

impl Method {
    /// The scheme of runs with dynamic lines.
    ///
    /// A stiff line that goes slack within a step leaves its last pull in the acceleration with which the next step begins. With a
    /// spectral radius near one that throws what hangs on it up, faster from bounce to bounce; damped as the line is itself it does not.
    pub fn with_moving_lines() -> Self {
        Method::Implicit(TimeScheme::generalised_alpha(RHO_OF_LINES))
    }
}

impl Default for Method {
    fn default() -> Self {
        Method::Implicit(TimeScheme::generalised_alpha(DEFAULT_SPECTRAL_RADIUS))
    }
}

impl TimeScheme {
    /// The generalised-alpha scheme of a spectral radius at infinite frequency, 0 to 1: second order, unconditionally stable for
    /// linear systems, least damping of low frequencies [CHUNG-HULBERT-1993 eq. 25].
    pub fn generalised_alpha(rho: f64) -> Self {
        let SchemeWeights { alpha_m, alpha_f, beta, gamma } = SchemeWeights::generalised_alpha(rho);
        TimeScheme { alpha_m, alpha_f, beta, gamma }
    }

    /// Newmark's scheme by its weights beta and gamma, numbers without a unit; 0.25 and 0.5 make the trapezoidal rule.
    pub fn newmark(beta: f64, gamma: f64) -> Self {
        TimeScheme { alpha_m: 0.0, alpha_f: 0.0, beta, gamma }
    }

    /// The same for what is stepped beside the bodies.
    pub fn weights(&self) -> SchemeWeights {
        let TimeScheme { alpha_m, alpha_f, beta, gamma } = *self;
        SchemeWeights { alpha_m, alpha_f, beta, gamma }
    }

    /// Whether a linear system without damping stays bounded with any step (Newmark's condition, 2 b >= g >= 1/2).
    pub fn unconditionally_stable(&self) -> bool {
        2.0 * self.beta >= self.gamma - 1e-12 && self.gamma >= 0.5 - 1e-12
    }

    /// d(auxiliary acceleration)/d(acceleration) at the end of the step.
    pub(super) fn gain(&self) -> f64 {
        (1.0 - self.alpha_f) / (1.0 - self.alpha_m)
    }

    /// The auxiliary acceleration at the end of a step from the accelerations at its ends.
    pub(super) fn auxiliary(&self, old: &Six, old_auxiliary: &Six, new: &Six) -> Six {
        (new * (1.0 - self.alpha_f) + old * self.alpha_f - old_auxiliary * self.alpha_m) / (1.0 - self.alpha_m)
    }

    /// Velocity at the end of a step of `h` (s).
    pub(super) fn velocity(&self, h: f64, velocity: &Six, old: &Six, new: &Six) -> Six {
        velocity + (old * (1.0 - self.gamma) + new * self.gamma) * h
    }

    /// Motion over a step of `h` (s): translation and rotation vector.
    pub(super) fn motion(&self, h: f64, velocity: &Six, old: &Six, new: &Six) -> Six {
        (velocity + (old * (0.5 - self.beta) + new * self.beta) * h) * h
    }
}
