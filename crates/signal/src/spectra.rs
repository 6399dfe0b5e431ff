//! Spectra of uniform samples: amplitudes by one Fourier transform, densities by Welch's method.

use super::{SeriesError, finite};
use realfft::RealFftPlanner;
use std::f64::consts::TAU;

/// Longest series that is transformed: 2^26 samples.
pub const MAX_SAMPLES: usize = 1 << 26;

/// Amplitudes of the harmonics of the whole series.
#[derive(Clone, Debug, PartialEq)]
pub struct HarmonicAmplitudes {
    /// Frequencies (rad/s), from 0.
    pub frequencies: Vec<f64>,
    /// Amplitude of each: at frequency 0 the mean, with its sign; of a sine that fits the series whole, its amplitude.
    pub amplitudes: Vec<f64>,
    /// Phase of each (rad): x(t) = sum a cos(w (t - t0) + phase), t0 being the first sample.
    pub phases: Vec<f64>,
}

/// A one-sided spectral density.
#[derive(Clone, Debug, PartialEq)]
pub struct Density {
    /// Frequencies (rad/s), equally spaced from 0.
    pub frequencies: Vec<f64>,
    /// Density over rad/s: its sum times the spacing is the variance.
    pub values: Vec<f64>,
    /// Segments averaged.
    pub segments: usize,
}

fn transform(values: &mut [f64]) -> Result<Vec<(f64, f64)>, SeriesError> {
    let plan = RealFftPlanner::<f64>::new().plan_fft_forward(values.len());
    let mut out = plan.make_output_vec();
    plan.process(values, &mut out).map_err(|e| SeriesError::Refused(e.to_string()))?;
    Ok(out.into_iter().map(|z| (z.re, z.im)).collect())
}

pub(super) fn usable(values: &[f64], step: f64, least: usize) -> Result<(), SeriesError> {
    finite(values)?;
    if !(step.is_finite() && step > 0.0) {
        return Err(SeriesError::Setting { what: "the step", expected: "greater than zero", value: step });
    }
    if values.len() < least {
        return Err(SeriesError::TooFew { what: "a spectrum of samples", need: least, got: values.len() });
    }
    if values.len() > MAX_SAMPLES {
        return Err(SeriesError::Refused(format!("{} samples are too many for a spectrum", values.len())));
    }
    Ok(())
}

/// The amplitudes of a series sampled every `step` (s). No window: a frequency between two harmonics leaks to its neighbours.
///
/// # Errors
/// Fewer than two samples, a step that is not greater than zero, a value that is not finite.
pub fn amplitudes(values: &[f64], step: f64) -> Result<HarmonicAmplitudes, SeriesError> {
    usable(values, step, 2)?;
    let count = values.len();
    let found = transform(&mut values.to_vec())?;
    let spacing = TAU / (step * count as f64);
    let mut made = HarmonicAmplitudes { frequencies: Vec::new(), amplitudes: Vec::new(), phases: Vec::new() };
    for (k, (re, im)) in found.into_iter().enumerate() {
        let sides = if k == 0 || 2 * k == count { 1.0 } else { 2.0 };
        let (amplitude, phase) = if k == 0 { (re, 0.0) } else { (re.hypot(im), im.atan2(re)) };
        made.frequencies.push(spacing * k as f64);
        made.amplitudes.push(sides * amplitude / count as f64);
        made.phases.push(phase);
    }
    Ok(made)
}

/// What is laid over a segment before it is transformed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Window {
    /// The periodic Hann window.
    Hann,
    /// None: all samples weigh alike.
    Box,
}

impl Window {
    fn weight(self, i: usize, count: usize) -> f64 {
        match self {
            Window::Hann => 0.5 - 0.5 * (TAU * i as f64 / count as f64).cos(),
            Window::Box => 1.0,
        }
    }
}

/// The density by Welch's method [WELCH-1967] of values `step` (s) apart: segments of `length` samples that overlap by half, each without
/// its own mean, under a window, their squared transforms averaged; samples behind the last whole segment are left out.
///
/// # Errors
/// Segments shorter than 8 samples or longer than the series, a step that is not greater than zero, a value that is not
/// finite.
pub fn welch(values: &[f64], step: f64, length: usize, window: Window) -> Result<Density, SeriesError> {
    usable(values, step, 8)?;
    if !(8..=values.len()).contains(&length) {
        let expected = "at least 8 samples and at most the series";
        return Err(SeriesError::Setting { what: "the length of a segment", expected, value: length as f64 });
    }
    let weights: Vec<f64> = (0..length).map(|i| window.weight(i, length)).collect();
    let power: f64 = weights.iter().map(|w| w * w).sum();
    let mut sums = vec![0.0; length / 2 + 1];
    let mut segments = 0usize;
    for segment in values.windows(length).step_by(length - length / 2) {
        let mean = segment.iter().sum::<f64>() / length as f64;
        let mut weighted: Vec<f64> = segment.iter().zip(&weights).map(|(x, w)| (x - mean) * w).collect();
        for (sum, (re, im)) in sums.iter_mut().zip(transform(&mut weighted)?) {
            *sum += re * re + im * im;
        }
        segments += 1;
    }
    // one-sided, over rad/s: both sides fold onto one, but for the mean and the highest frequency of an even length
    let scale = step / (TAU * power * segments as f64);
    let spacing = TAU / (step * length as f64);
    let sides = |k: usize| if k == 0 || 2 * k == length { 1.0 } else { 2.0 };
    Ok(Density {
        frequencies: (0..sums.len()).map(|k| spacing * k as f64).collect(),
        values: sums.iter().enumerate().map(|(k, s)| sides(k) * s * scale).collect(),
        segments,
    })
}

/// Moments of a density and the periods that follow from them.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SpectralMoments {
    /// Moment n: sum of w^n S dw, for n = 0, 1, 2 and 4. The fourth depends on the highest frequency sampled.
    pub m: [f64; 4],
    /// Period of the highest ordinate (s).
    pub peak_period: f64,
    /// T1 = 2 pi m0 / m1 (s).
    pub mean_period: f64,
    /// Tz = 2 pi sqrt(m0 / m2), mean zero up-crossing period of a Gaussian process (s).
    pub zero_crossing_period: f64,
    /// Bandwidth sqrt(1 - m2^2 / (m0 m4)) [CARTWRIGHT-1956]: 0 narrow, 1 wide.
    pub bandwidth: f64,
    /// Width nu = sqrt(m0 m2 / m1^2 - 1) [LONGUET-HIGGINS-1975], free of the fourth moment.
    pub width: f64,
}

/// The moments of a density, frequency 0 left out.
///
/// # Errors
/// A density without energy.
pub fn moments(density: &Density) -> Result<SpectralMoments, SeriesError> {
    let spacing = density.frequencies.get(1).copied().unwrap_or(0.0);
    let mut m = [0.0; 4];
    let (mut peak, mut highest) = (0.0, 0.0);
    for (w, s) in density.frequencies.iter().zip(&density.values).skip(1) {
        for (sum, power) in m.iter_mut().zip([0, 1, 2, 4]) {
            *sum += w.powi(power) * s * spacing;
        }
        if *s > highest {
            (peak, highest) = (*w, *s);
        }
    }
    let [m0, m1, m2, m4] = m;
    if !(m.iter().all(|v| v.is_finite()) && m0 > 0.0 && m4 > 0.0) {
        return Err(SeriesError::Constant);
    }
    Ok(SpectralMoments {
        m,
        peak_period: TAU / peak,
        mean_period: TAU * m0 / m1,
        zero_crossing_period: TAU * (m0 / m2).sqrt(),
        bandwidth: (1.0 - m2 * m2 / (m0 * m4)).max(0.0).sqrt(),
        width: (m0 * m2 / (m1 * m1) - 1.0).max(0.0).sqrt(),
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand_pcg::{Pcg64, rand_core::Rng};

    fn noise(count: usize) -> Vec<f64> {
        let mut random = Pcg64::new(1, 1);
        (0..count).map(|_| random.next_u64() as f64 / u64::MAX as f64 - 0.5).collect()
    }

    fn variance(x: &[f64]) -> f64 {
        let mean = x.iter().sum::<f64>() / x.len() as f64;
        x.iter().map(|v| (v - mean).powi(2)).sum::<f64>() / x.len() as f64
    }

    #[test]
    fn sum_of_harmonics_gives_amplitudes_and_phases() {
        for count in [200, 201] {
            let w = |k: f64| TAU * k / (0.5 * f64::from(count));
            let x: Vec<f64> = (0..count)
                .map(|i| {
                    let t = 0.5 * f64::from(i);
                    -3.0 + 2.0 * (w(4.0) * t + 0.7).cos() + 0.5 * (w(9.0) * t - 1.2).cos()
                })
                .collect();
            let a = amplitudes(&x, 0.5).unwrap();
            for (k, want, phase) in [(0, -3.0, 0.0), (4, 2.0, 0.7), (9, 0.5, -1.2)] {
                assert!((a.amplitudes[k] - want).abs() < 1e-13 && (a.phases[k] - phase).abs() < 1e-12, "{k}");
                assert!((a.frequencies[k] - w(k as f64)).abs() < 1e-13);
            }
            assert!(a.amplitudes[5] < 1e-13);
        }
    }

    #[test]
    fn spectral_density_sums_to_variance() {
        for count in [500, 501] {
            // Parseval: exact for one whole segment without a window
            let x = noise(count);
            let d = welch(&x, 0.1, count, Window::Box).unwrap();
            let sum: f64 = d.values.iter().sum::<f64>() * d.frequencies[1];
            assert!((sum / variance(&x) - 1.0).abs() < 1e-12, "{sum}");
        }
        // with segments of Hann it holds in the mean: white noise of 2^16 samples, some 250 segments
        let x = noise(1 << 16);
        let d = welch(&x, 0.1, 512, Window::Hann).unwrap();
        let sum: f64 = d.values.iter().sum::<f64>() * d.frequencies[1];
        assert!((sum * 12.0 - 1.0).abs() < 0.02 && d.segments == 255, "{sum} {}", d.segments);
    }

    #[test]
    fn sine_spectrum_has_its_period_and_half_amplitude_squared() {
        let x: Vec<f64> = (0..4096).map(|i| 3.0 * (TAU * f64::from(i) / 64.0).sin()).collect();
        let d = welch(&x, 0.25, 1024, Window::Hann).unwrap();
        let m = moments(&d).unwrap();
        assert!((m.m[0] - 4.5).abs() < 1e-9, "{m:?}");
        assert!((m.peak_period - 16.0).abs() < 1e-12 && (m.zero_crossing_period - 16.0).abs() < 0.02, "{m:?}");
        assert!(m.width < 0.1);
    }

    #[test]
    fn series_without_energy_or_of_few_samples_is_refused() {
        let flat = welch(&[2.0; 64], 0.1, 32, Window::Hann).unwrap();
        assert_eq!(moments(&flat), Err(SeriesError::Constant));
        assert!(welch(&[1.0; 4], 0.1, 4, Window::Hann).is_err());
        assert!(welch(&noise(64), 0.1, 65, Window::Hann).is_err());
        assert!(welch(&noise(64), 0.0, 32, Window::Hann).is_err());
        assert!(amplitudes(&[1.0, f64::NAN], 1.0).is_err() && amplitudes(&[1.0], 1.0).is_err());
    }
}
