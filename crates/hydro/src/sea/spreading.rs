//! Directional spreading: the energy goes with cos(H - th)^EXP, within a quarter turn of the main direction H.
//!
//! Source: [MOSES-REF env]. Each component has one direction, so that the energy of each frequency is where it
//! was. Directions come from the cumulative spreading function at the points of a golden-section sequence, u_i = 1/2 + i 0.618..
//! modulo one: of low discrepancy in any run of neighbouring frequencies, the same for every seed.

use statrs::function::beta::beta_reg;
use std::f64::consts::{FRAC_PI_2, PI};
use windlass_nonlinear::bisect;

/// From this exponent on a sea is long-crested.
pub const LONG_CRESTED: f64 = 200.0;
/// A part of a sea with less of its energy is none: it needs no heading of a database.
const LEAST_SHARE: f64 = 1e-4;
/// Halvings of the half circle after which an angle is known to 1e-12.
const ANGLE_HALVINGS: usize = 42;
/// The golden section less one.
const GOLDEN: f64 = 0.618_033_988_749_894_8;

/// The share of the energy below an angle (rad) from the main direction.
pub fn share(angle: f64, exponent: f64) -> f64 {
    // with s = sin^2, the integral of cos^e is an incomplete beta function of 1/2 and (e + 1)/2
    let sin = angle.clamp(-FRAC_PI_2, FRAC_PI_2).sin();
    0.5 + 0.5 * sin.signum() * beta_reg(0.5, 0.5 * (exponent + 1.0), (sin * sin).min(1.0))
}

/// The angle (rad) below which a share of the energy is.
pub fn angle(of: f64, exponent: f64) -> f64 {
    let [low, high] = bisect([-FRAC_PI_2, FRAC_PI_2], ANGLE_HALVINGS, |angle| share(angle, exponent) < of);
    0.5 * (low + high)
}

/// Parts of a sea that comes from a direction (rad), each with its unit vector of travel and its share of the energy: directions at equal distances over the
/// half circle, whose sum converges faster than any power of their number; one of a long-crested sea.
pub fn parts(number: usize, from: f64, exponent: f64) -> Vec<([f64; 2], f64)> {
    if exponent >= LONG_CRESTED {
        return vec![(travel(from), 1.0)];
    }
    let turn = |i: usize| PI * ((i as f64 + 0.5) / number as f64 - 0.5);
    let weight = |i: usize| turn(i).cos().powf(exponent);
    let whole: f64 = (0..number).map(weight).sum();
    let kept: Vec<usize> = (0..number).filter(|i| weight(*i) > LEAST_SHARE * whole).collect();
    let rest: f64 = kept.iter().map(|i| weight(*i)).sum();
    kept.iter().map(|i| (travel(from + turn(*i)), weight(*i) / rest)).collect()
}

/// The unit vector of travel of waves that come from a direction (rad).
fn travel(from: f64) -> [f64; 2] {
    let (cos, sin) = windlass_base::geometry::unit_vector(from.rem_euclid(2.0 * PI));
    [-cos, -sin]
}

/// Unit vectors of travel of some components of a sea that comes from a direction (rad).
pub fn directions(number: usize, from: f64, exponent: f64) -> Vec<[f64; 2]> {
    let one = |i: usize| match exponent {
        e if e >= LONG_CRESTED => 0.0,
        e => angle((0.5 + i as f64 * GOLDEN).fract(), e),
    };
    (0..number).map(|i| travel(from + one(i))).collect()
}
