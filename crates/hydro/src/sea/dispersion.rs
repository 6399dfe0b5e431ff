//! Dispersion of linear waves: `w^2 = g k tanh(k d)`.

use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Steps of Newton's method allowed; from a start within 0.75 % of the root it takes some four, and needs no bracket.
const MAX_NEWTON_ITERATIONS: usize = 50;

/// The wave number (1/m) of a frequency (rad/s) in a depth (m; `None`: deep), to the last digit or two.
///
/// # Errors
/// A frequency, depth or gravity that is no positive finite number.
pub fn wave_number(frequency: f64, depth: Option<f64>, gravity: f64) -> Result<f64, ClassError> {
    let deep = frequency * frequency / gravity;
    let fail = || {
        ClassError::with_values("there is no wave of a frequency of {} in this water", &[(frequency, Dim::Frequency)])
    };
    let sound = |value: f64| value.is_finite() && value > 0.0;
    if !sound(frequency) || !sound(gravity) || !sound(deep) || !depth.is_none_or(sound) {
        return Err(fail());
    }
    let Some(depth) = depth else { return Ok(deep) };
    let y = deep * depth;
    // [GUO-2002]: within 0.75 % over all depths
    let mut x = y / (1.0 - (-y.powf(1.245)).exp()).powf(0.4);
    if !sound(x) {
        x = y.sqrt();
    }
    for _ in 0..MAX_NEWTON_ITERATIONS {
        let tanh = x.tanh();
        let step = (x * tanh - y) / (tanh + x * (1.0 - tanh * tanh));
        x -= step;
        if step.abs() <= 4.0 * f64::EPSILON * x {
            return if sound(x) { Ok(x / depth) } else { Err(fail()) };
        }
    }
    Err(fail())
}

/// The frequency (rad/s) of a wave number (1/m) in a depth (m; `None`: deep).
pub fn frequency(number: f64, depth: Option<f64>, gravity: f64) -> f64 {
    (gravity * number * depth.map_or(1.0, |d| (number * d).tanh())).sqrt()
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn wave_number_satisfies_dispersion_at_every_depth() {
        for exponent in -8..=8 {
            for w in [0.01, 0.2, 0.6411, 1.0, 3.0, 20.0] {
                let depth = 10f64.powf(f64::from(exponent) * 0.75);
                let k = wave_number(w, Some(depth), 9.80665).unwrap();
                // frequency goes with the square root of the wave number, so 1e-14 here is at most 2e-14 of k
                assert!((frequency(k, Some(depth), 9.80665) / w - 1.0).abs() < 1e-14, "{w} {depth}");
            }
        }
    }

    #[test]
    fn wave_speed_has_shallow_and_deep_water_limits() {
        // k d -> 0: w = k sqrt(g d) (1 - (k d)^2 / 6); k d -> inf: w^2 = g k
        let k = wave_number(1e-4, Some(10.0), 9.81).unwrap();
        let kd = 10.0 * k;
        assert!((1e-4 / (k * 98.1f64.sqrt()) - (1.0 - kd * kd / 6.0)).abs() < 1e-12);
        assert_eq!(wave_number(2.0, Some(1e6), 9.81).unwrap(), 4.0 / 9.81);
        assert_eq!(wave_number(2.0, None, 9.81).unwrap(), 4.0 / 9.81);
    }

    #[test]
    fn frequency_without_wave_is_error() {
        for (w, d) in [(0.0, None), (-1.0, None), (f64::NAN, None), (1.0, Some(0.0)), (1e-300, Some(1e-300))] {
            assert!(wave_number(w, d, 9.81).is_err(), "{w} {d:?}");
        }
    }
}
