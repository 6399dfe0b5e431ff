//! The wave part by quadrature, to rounding: what its tables are made from and measured against.

use super::special::struve;
use super::wave_part::WavePart;
use crate::gauss::GaussRule;
use nalgebra::Complex;
use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::LazyLock;

static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(16));
/// Longest piece of the integral over the heights.
const LONGEST_PIECE: f64 = 1.0;

/// The wave part at `x` above zero and at most 120, and `y` not below zero (both without unit).
///
/// At the surface `W = -pi (H0 + Y0) + 2 pi i J0`; below it the equation `dW/dY = -(W + 2/d)` is integrated,
/// `W = exp(-Y) (W(X, 0) - 2 int_0^Y exp(t)/sqrt(X2 + t2) dt)`, with `t = X sinh v` [NEWMAN-1985].
pub fn integrate_wave_part(x: f64, y: f64) -> WavePart {
    let [h0, h1] = struve(x);
    let at_surface = -PI * (h0 + libm::y0(x));
    let slope_at_surface = -PI * (FRAC_2_PI - h1 - libm::y1(x));
    let (mut value, mut slope) = (0.0, 0.0);
    let mut low = 0.0;
    while low < y {
        let high = (low + x.max(low).min(LONGEST_PIECE)).min(y);
        for (v, weight) in RULE.between((low / x).asinh(), (high / x).asinh()) {
            let t = x * v.sinh();
            let part = (t - y).exp() * weight;
            value += part;
            slope += part / (x * v.cosh().powi(2));
        }
        low = high;
    }
    let fall = (-y).exp();
    let (re, re_by_x) = (fall * at_surface - 2.0 * value, fall * slope_at_surface + 2.0 * slope);
    let wave = 2.0 * PI * fall;
    WavePart { value: Complex::new(re, wave * libm::j0(x)), by_x: Complex::new(re_by_x, -wave * libm::j1(x)) }
}
