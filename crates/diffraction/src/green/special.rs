//! Bessel functions of the second kind and Struve functions, as the Green function has them together.

use crate::gauss::GaussRule;
use nalgebra::Complex;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_2};
use std::sync::LazyLock;

/// Enough points for arguments up to [`MAX_STRUVE_ARGUMENT`].
static STRUVE_RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(96));
/// Above it the rule no longer resolves the integrand.
const MAX_STRUVE_ARGUMENT: f64 = 120.0;
/// Terms of a power series for arguments up to 20.
const MAX_SERIES_TERMS: usize = 80;

/// Struve's functions H0 and H1 at `x` between 0 and 120, by Gauss's rule over their integrals [ABRAMOWITZ-STEGUN 12.1.7]; not a number
/// beyond.
pub fn struve(x: f64) -> [f64; 2] {
    if !(0.0..=MAX_STRUVE_ARGUMENT).contains(&x) {
        return [f64::NAN; 2];
    }
    let (mut h0, mut h1) = (0.0, 0.0);
    for (angle, weight) in STRUVE_RULE.between(0.0, FRAC_PI_2) {
        let sine = (x * angle.cos()).sin() * weight;
        h0 += sine;
        h1 += sine * angle.sin().powi(2);
    }
    [FRAC_2_PI * h0, FRAC_2_PI * x * h1]
}

/// Step of the trapezoidal rule of [`modified_bessel`], which converges faster than any power.
const MODIFIED_STEP: f64 = 0.1;
/// Exponents below which nothing is left to add.
const MODIFIED_REACH: f64 = 38.0;

/// The modified Bessel functions K0 and K1 at `x > 0`, by the trapezoidal rule over `int exp(-x cosh t) cosh(n t) dt`
/// [ABRAMOWITZ-STEGUN 9.6.24].
pub fn modified_bessel(x: f64) -> [f64; 2] {
    let mut sum = [0.5 * (-x).exp(); 2];
    let mut step = 1.0;
    loop {
        let cosh = (MODIFIED_STEP * step).cosh();
        let value = (-x * cosh).exp();
        sum = [sum[0] + value, sum[1] + value * cosh];
        if x * (cosh - 1.0) > MODIFIED_REACH || value == 0.0 {
            return sum.map(|v| v * MODIFIED_STEP);
        }
        step += 1.0;
    }
}

/// J0 and J1 of a complex argument of size up to 20, by their power series [ABRAMOWITZ-STEGUN 9.1.10].
pub fn complex_bessel(z: Complex<f64>) -> [Complex<f64>; 2] {
    let square = -z * z * 0.25;
    let (mut term, mut next) = (Complex::new(1.0, 0.0), z * 0.5);
    let mut sums = [term, next];
    for n in 1..MAX_SERIES_TERMS {
        let n = n as f64;
        term *= square / (n * n);
        next *= square / (n * (n + 1.0));
        sums = [sums[0] + term, sums[1] + next];
        if term.norm() < 1e-18 * sums[0].norm().max(1e-3) {
            break;
        }
    }
    sums
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn struve_functions_match_printed_table() {
        // [ABRAMOWITZ-STEGUN table 12.1]
        for (x, h0, h1) in [(1.0, 0.568_656_6, 0.198_457_3), (5.0, -0.185_216_8, 0.807_811_9)] {
            let [a, b] = struve(x);
            assert!((a - h0).abs() < 6e-8 && (b - h1).abs() < 6e-8, "{x}: {a} {b}");
        }
    }

    #[test]
    fn modified_bessel_functions_match_printed_table() {
        // [ABRAMOWITZ-STEGUN table 9.8]
        for (x, k0, k1) in [
            (0.1, 2.427_069_024_7, 9.853_844_780_9),
            (1.0, 0.421_024_438_2, 0.601_907_230_2),
            (5.0, 0.003_691_098_3, 0.004_044_613_4),
        ] {
            let [a, b] = modified_bessel(x);
            assert!((a - k0).abs() < 1e-10 && (b - k1).abs() < 1e-10, "{x}: {a} {b}");
        }
    }

    #[test]
    fn complex_bessel_functions_meet_real_ones() {
        for x in [0.5, 3.0, 12.0] {
            let [j0, j1] = complex_bessel(Complex::new(x, 0.0));
            assert!((j0.re - libm::j0(x)).abs() < 1e-11 && (j1.re - libm::j1(x)).abs() < 1e-11, "{x}: {j0} {j1}");
        }
    }
}
