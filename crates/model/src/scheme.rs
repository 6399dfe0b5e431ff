//! The weights of an implicit time-stepping scheme, shared by bodies and dynamic lines of one run.
//!
//! The scheme is Newmark's and the generalised-alpha family in the form of [ARNOLD-BRULS-2007 eq. 3 to 6]:
//! `(1 - am) b1 + am b0 = (1 - af) a1 + af a0`, `v1 = v0 + h ((1 - g) b0 + g b1)`, `q1 = q0 + h v0 + h2 ((1/2 - b) b0 + b b1)`,
//! in which b is the auxiliary acceleration. With am = af = 0 it is Newmark's.

/// Weights of an implicit scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SchemeWeights {
    /// Share of the old auxiliary acceleration.
    pub alpha_m: f64,
    /// Share of the old acceleration.
    pub alpha_f: f64,
    /// Newmark's beta.
    pub beta: f64,
    /// Newmark's gamma, which MOSES calls ALPHA.
    pub gamma: f64,
}

impl SchemeWeights {
    /// The generalised-alpha scheme of a spectral radius at infinite frequency, 0 to 1: second order, unconditionally stable for
    /// linear systems, least damping of low frequencies [CHUNG-HULBERT-1993 eq. 25].
    pub fn generalised_alpha(rho: f64) -> Self {
        let (alpha_m, alpha_f) = ((2.0 * rho - 1.0) / (rho + 1.0), rho / (rho + 1.0));
        let gamma = 0.5 - alpha_m + alpha_f;
        SchemeWeights { alpha_m, alpha_f, beta: 0.25 * (gamma + 0.5) * (gamma + 0.5), gamma }
    }
}
