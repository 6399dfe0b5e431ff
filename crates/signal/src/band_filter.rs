//! A series without the part of it whose periods lie in a band.
//!
//! The series is taken as one period of a periodic one: its Fourier components with periods inside of the bands are left out. A
//! sine that fits the series whole is kept or removed exactly; of another one what leaks at both ends stays. The mean has no
//! period and stays.

use super::SeriesError;
use super::sampling::uniform;
use super::spectra::usable;
use realfft::RealFftPlanner;

/// The values of a series over growing times (s) without its components with periods (s) within bands, ends included. Times that
/// are not uniform are interpolated at their mean step, and the result back at theirs; the second value says whether they were.
///
/// # Errors
/// Fewer than two values, times that do not grow, a value that is not finite.
pub fn remove_periods(times: &[f64], values: &[f64], bands: &[[f64; 2]]) -> Result<(Vec<f64>, bool), SeriesError> {
    let grid = uniform(times, values)?;
    usable(&grid.values, grid.step, 2)?;
    let (count, mut planner) = (grid.values.len(), RealFftPlanner::<f64>::new());
    let refused = |e: realfft::FftError| SeriesError::Refused(e.to_string());
    let (forward, inverse) = (planner.plan_fft_forward(count), planner.plan_fft_inverse(count));
    let (mut samples, mut found) = (grid.values.to_vec(), forward.make_output_vec());
    forward.process(&mut samples, &mut found).map_err(refused)?;
    let length = grid.step * count as f64;
    for (k, component) in found.iter_mut().enumerate().skip(1) {
        let period = length / k as f64;
        // a period on an end of a band is inside of it, whatever rounding does
        let inside = |[low, high]: &[f64; 2]| period >= low * (1.0 - EDGE) && period <= high * (1.0 + EDGE);
        if bands.iter().any(inside) {
            *component = realfft::num_complex::Complex::new(0.0, 0.0);
        }
    }
    inverse.process(&mut found, &mut samples).map_err(refused)?;
    samples.iter_mut().for_each(|v| *v /= count as f64);
    if !grid.resampled {
        return Ok((samples, false));
    }
    let back = |t: &f64| {
        let position = ((t - grid.start) / grid.step).clamp(0.0, (count - 1) as f64);
        let before = (position.floor() as usize).min(count - 2);
        // the grid has `count` samples, and `before` is one of them but the last
        let (a, b) = (samples[before], samples[before + 1]);
        a + (b - a) * (position - before as f64)
    };
    Ok((times.iter().map(back).collect(), true))
}

/// Share of a period that rounding of times and lengths makes.
const EDGE: f64 = 1e-9;

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    #[test]
    fn band_of_one_sine_leaves_the_other_and_the_mean() {
        // 200 s at 0.5 s: 20 periods of 10 s and 2 of 100 s fit whole, rounding of the transform is left
        let times: Vec<f64> = (0..400).map(|i| 0.5 * f64::from(i)).collect();
        let wave = |t: f64| 3.0 * (TAU * t / 10.0 + 0.4).sin();
        let slow = |t: f64| 7.0 * (TAU * t / 100.0 - 1.1).cos();
        let values: Vec<f64> = times.iter().map(|t| 50.0 + wave(*t) + slow(*t)).collect();
        for (band, kept) in [([30.0, 1e5], &wave as &dyn Fn(f64) -> f64), ([5.0, 10.0], &slow)] {
            let (found, resampled) = remove_periods(&times, &values, &[band]).unwrap();
            assert!(!resampled);
            for (t, v) in times.iter().zip(found) {
                assert!((v - 50.0 - kept(*t)).abs() < 1e-11, "{band:?} at {t}: {v}");
            }
        }
    }

    #[test]
    fn series_too_short_or_not_growing_is_refused() {
        assert!(remove_periods(&[0.0], &[1.0], &[]).is_err());
        assert!(remove_periods(&[0.0, 0.0, 1.0], &[1.0, 2.0, 3.0], &[]).is_err());
    }
}
