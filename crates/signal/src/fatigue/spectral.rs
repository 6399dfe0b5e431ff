//! Damage of a Gaussian process from the moments of its spectrum: narrow-banded (Rayleigh ranges), and Dirlik's formula.
//!
//! Both integrate a density of ranges over every branch of a curve in closed form, by incomplete gamma functions.

use super::curve::SnCurve;
use crate::SeriesError;
use statrs::function::gamma::{checked_gamma_lr, gamma};
use std::f64::consts::TAU;

/// Moments 0, 1, 2 and 4 of a spectrum of stress (MPa) or of tension over breaking tension, over rad/s.
pub type StressMoments = [f64; 4];

fn sound(m: &StressMoments) -> Result<(), SeriesError> {
    if m.iter().all(|v| v.is_finite() && *v > 0.0) {
        return Ok(());
    }
    Err(SeriesError::Refused("the moments of the spectrum must be finite and greater than zero".into()))
}

/// Integral of z^(a - 1) e^(-z) from `low` to `high`, the upper end `None` at infinity.
fn incomplete_gamma(a: f64, low: f64, high: Option<f64>) -> Result<f64, SeriesError> {
    let share = |z: f64| {
        if z <= 0.0 {
            return Ok(0.0);
        }
        checked_gamma_lr(a, z).map_err(|e| SeriesError::Refused(format!("an incomplete gamma function: {e}")))
    };
    let upper = high.map_or(Ok(1.0), share)?;
    Ok(gamma(a) * (upper - share(low)?).max(0.0))
}

/// Sum over the branches of a curve of `integral of S^m p(S) dS / a`, the inner integral being given by slope and bounds.
fn sum_branches(
    curve: &SnCurve,
    mean: f64,
    integral: impl Fn(f64, f64, Option<f64>) -> Result<f64, SeriesError>,
) -> Result<f64, SeriesError> {
    let mut upper = None;
    let mut sum = 0.0;
    for branch in &curve.branches {
        let lower = branch.from.max(curve.limit);
        if upper.is_none_or(|u| lower < u) {
            sum += integral(branch.slope, lower, upper)? * 10f64.powf(-branch.log_a);
            upper = Some(lower);
        }
    }
    let sum = sum * 10f64.powf(-curve.mean_slope * mean);
    if sum.is_finite() { Ok(sum) } else { Err(SeriesError::Refused("the damage is not finite".into())) }
}

/// Damage in a second of a narrow-banded process: up-crossings a second times the mean of 1/N over Rayleigh ranges. On one
/// branch: `sqrt(m2/m0)/(2 pi) (2 sqrt(2 m0))^m Gamma(1 + m/2) / a` [MILES-1954; DNV-RP-C203 Closed form
/// fatigue damage].
///
/// # Errors
/// Moments that are not greater than zero.
pub fn narrow_band(m: &StressMoments, curve: &SnCurve, mean: f64) -> Result<f64, SeriesError> {
    sound(m)?;
    let rate = (m[2] / m[0]).sqrt() / TAU;
    let eight = 8.0 * m[0];
    let integral = |slope: f64, low: f64, high: Option<f64>| {
        let z = |s: f64| s * s / eight;
        Ok(eight.powf(0.5 * slope) * incomplete_gamma(1.0 + 0.5 * slope, z(low), high.map(z))?)
    };
    Ok(rate * sum_branches(curve, mean, integral)?)
}

/// Damage in a second (1/s) about a mean (Pa) by the density of rainflow ranges of [DIRLIK-1985]: an exponential and two Rayleigh
/// densities weighted by the moments.
///
/// # Errors
/// Moments that are not greater than zero, or that no process has.
pub fn dirlik(m: &StressMoments, curve: &SnCurve, mean: f64) -> Result<f64, SeriesError> {
    sound(m)?;
    let [m0, m1, m2, m4] = *m;
    let peaks = (m4 / m2).sqrt() / TAU;
    let gamma2 = m2 / (m0 * m4).sqrt();
    let x = m1 / m0 * (m2 / m4).sqrt();
    // m1^2 <= m0 m2 and m2^2 <= m0 m4 (Cauchy and Schwarz)
    if gamma2 > 1.0 + 1e-9 || x > gamma2 * (1.0 + 1e-6) {
        return Err(SeriesError::Refused("no process has these spectral moments".into()));
    }
    // of a process of one frequency the weights are 0/0; it is narrow-banded
    if 1.0 - gamma2 < 1e-6 {
        return narrow_band(m, curve, mean);
    }
    let d1 = 2.0 * (x - gamma2 * gamma2) / (1.0 + gamma2 * gamma2);
    let r = (gamma2 - x - d1 * d1) / (1.0 - gamma2 - d1 + d1 * d1);
    let d2 = (1.0 - gamma2 - d1 + d1 * d1) / (1.0 - r);
    let d3 = 1.0 - d1 - d2;
    let q = 1.25 * (gamma2 - d3 - d2 * r) / d1;
    if ![d1, d2, d3, q, r].iter().all(|v| v.is_finite()) {
        return Err(SeriesError::Refused("Dirlik's formula has no weights for these moments".into()));
    }
    let two = 2.0 * m0.sqrt();
    let integral = |slope: f64, low: f64, high: Option<f64>| {
        let exponential = |s: f64| s / two / q;
        let rayleigh = |s: f64, width: f64| (s / two / width).powi(2) / 2.0;
        let waves = |width: f64| {
            let z = |s: f64| rayleigh(s, width);
            Ok::<f64, SeriesError>(
                (2f64.sqrt() * width).powf(slope) * incomplete_gamma(1.0 + 0.5 * slope, z(low), high.map(z))?,
            )
        };
        let first = d1 * q.powf(slope) * incomplete_gamma(1.0 + slope, exponential(low), high.map(exponential))?;
        Ok(two.powf(slope) * (first + d2 * waves(r.abs())? + d3 * waves(1.0)?))
    };
    Ok(peaks * sum_branches(curve, mean, integral)?)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::fatigue::find;
    use std::f64::consts::PI;
    use windlass_model::FatigueSelection;

    fn find_curve(name: &str) -> SnCurve {
        find(name, &FatigueSelection::default()).unwrap()
    }

    /// Moments of a flat spectrum of a variance between two frequencies.
    fn flat(variance: f64, low: f64, high: f64) -> StressMoments {
        [0, 1, 2, 4].map(|n| {
            let n = n + 1;
            variance / (high - low) * (high.powi(n) - low.powi(n)) / f64::from(n)
        })
    }

    #[test]
    fn single_slope_damage_matches_narrow_band_closed_form() {
        let curve = find_curve("DNV_D_FREE");
        let m = flat(400.0, 0.6, 0.7);
        let rate = (m[2] / m[0]).sqrt() / TAU;
        // m = 3: (2 sqrt 2 sigma)^3 Gamma(5/2), Gamma(5/2) = 3 sqrt(pi) / 4
        let want = rate * (2.0 * 2f64.sqrt() * 20.0).powi(3) * 0.75 * PI.sqrt() / 10f64.powf(11.687);
        assert!((narrow_band(&m, &curve, 0.0).unwrap() / want - 1.0).abs() < 1e-12);
    }

    #[test]
    fn two_slope_damage_matches_integral_of_density() {
        let curve = find_curve("DNV_D_AIR");
        let m = flat(225.0, 0.3, 1.5);
        let (steps, top) = (200_000, 15.0 * 15.0);
        let h = top / f64::from(steps);
        let sum: f64 = (1..steps)
            .map(|i| {
                let s = h * f64::from(i);
                s / (4.0 * m[0]) * (-s * s / (8.0 * m[0])).exp() * curve.damage(s, 0.0) * h
            })
            .sum();
        let want = sum * (m[2] / m[0]).sqrt() / TAU;
        let found = narrow_band(&m, &curve, 0.0).unwrap();
        // a step of the sum lies across the jump between branches; their printed ordinates differ by 1e-3 there
        assert!((found / want - 1.0).abs() < 1e-5, "{found} {want}");
    }

    #[test]
    fn dirlik_of_impossible_moments_is_refused() {
        let curve = find_curve("DNV_D_FREE");
        // of a process m1^2 <= m0 m2: 0.9025 is more than 0.81
        assert!(dirlik(&[1.0, 0.95, 0.81, 1.0], &curve, 0.0).is_err());
        assert!(dirlik(&[1.0, 0.89, 0.81, 1.0], &curve, 0.0).is_ok());
    }

    #[test]
    fn dirlik_approaches_narrow_band_from_below() {
        let curve = find_curve("DNV_D_FREE");
        let narrow = flat(400.0, 0.99, 1.01);
        let ratio = dirlik(&narrow, &curve, 0.0).unwrap() / narrow_band(&narrow, &curve, 0.0).unwrap();
        // the weights leave a few per cent at a width of two per cent
        assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
        let wide = flat(400.0, 0.1, 2.0);
        let ratio = dirlik(&wide, &curve, 0.0).unwrap() / narrow_band(&wide, &curve, 0.0).unwrap();
        assert!((0.6..1.0).contains(&ratio), "{ratio}");
    }

    #[test]
    fn impossible_spectral_moments_are_refused() {
        let curve = find_curve("CHAIN");
        assert!(dirlik(&[1.0, 1.0, 2.0, 1.0], &curve, 0.0).is_err());
        assert!(narrow_band(&[0.0, 1.0, 1.0, 1.0], &curve, 0.0).is_err());
        assert!(narrow_band(&[f64::NAN, 1.0, 1.0, 1.0], &curve, 0.0).is_err());
    }
}
