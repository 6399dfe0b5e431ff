//! Spectra with a formula, each in one place, from heights in m and periods in s.

use super::density::{SpectralPeak, Spectrum};
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::ClassError;
pub use windlass_model::PeriodType;

/// Gravity in the formulas that were fitted with it (m/s2).
const FITTED_GRAVITY: f64 = 9.81;

/// ISSC (gamma 1) or JONSWAP.
pub fn jonswap(height: f64, period: f64, kind: PeriodType, gamma: f64) -> Vec<SpectralPeak> {
    let unit = Spectrum::of_humps(vec![SpectralPeak::of_energy(1.0, 1.0, 5.0, gamma)], None);
    // w = x wp: a period of the unit spectrum becomes the one asked for
    let peak = match kind {
        PeriodType::Peak => period,
        PeriodType::Mean => period * unit.moment(1),
        PeriodType::ZeroCrossing => period * unit.moment(2).sqrt(),
    };
    vec![SpectralPeak::of_energy(height * height / 16.0, TAU / peak, 5.0, gamma)]
}

/// The peakedness of JONSWAP where none is given: 5 up to Tp/sqrt(Hs) = 3.6, exp(5.75 - 1.15 Tp/sqrt(Hs)) up to 5, 1 beyond
/// [DNV-RP-C205 3.5.5.5]; the peak period is that of the period given.
pub fn usual_gamma(height: f64, period: f64, kind: PeriodType) -> f64 {
    let of_peak = |peak: f64| match peak / height.sqrt() {
        r if r <= 3.6 => 5.0,
        r if r < 5.0 => (5.75 - 1.15 * r).exp(),
        _ => 1.0,
    };
    if kind == PeriodType::Peak {
        return of_peak(period);
    }
    let peak = |gamma: f64| jonswap(height, period, kind, gamma).first().map_or(period, |h| TAU / h.peak);
    // each round changes the peak period a quarter as much as the one before it
    (0..40).fold(3.3, |gamma, _| of_peak(peak(gamma)))
}

/// Ochi and Hubble's six parameters: height (m), peak frequency (rad/s), shape of the lower and of the higher peak.
///
/// # Errors
/// A shape of a quarter or less: there is no mean frequency.
pub fn ochi_hubble(parts: [[f64; 3]; 2]) -> Result<Vec<SpectralPeak>, ClassError> {
    let hump = |[height, peak, shape]: [f64; 3]| {
        if shape <= 0.25 || !shape.is_finite() {
            return Err(ClassError::new(format!(
                "a spectrum of Ochi and Hubble of shape {shape} has no mean frequency"
            ))
            .help("its most probable shape is above 0.25 up to a significant height of 29 m"));
        }
        Ok(SpectralPeak::of_energy(height * height / 16.0, peak, 4.0 * shape + 1.0, 1.0))
    };
    parts.into_iter().map(hump).collect()
}

/// The most probable six parameters of a significant height (m): [OCHI-HUBBLE-1976 table 2].
/// Their heights come to 0.9986 of it.
pub fn most_probable(height: f64) -> [[f64; 3]; 2] {
    let fall = |a: f64, b: f64| a * (-b * height).exp();
    [[0.84 * height, fall(0.70, 0.046), 3.0], [0.54 * height, fall(1.15, 0.039), fall(1.54, 0.062)]]
}

/// Torsethaugen's two peaks, simplified [TORSETHAUGEN-HAVER-2004; DNV-RP-C205 appendix A]:
/// of a significant height (m) and the peak period (s), for a fetch of 370 km.
///
/// # Errors
/// A peak period beyond 25 s or so short that the sea is steeper than the model: below 2 sqrt(Hs).
pub fn torsethaugen(height: f64, period: f64) -> Result<Vec<SpectralPeak>, ClassError> {
    let fetch = 6.6 * height.cbrt();
    let (shortest, longest) = (2.0 * height.sqrt(), 25.0);
    if period < shortest.min(fetch) || period > longest || fetch >= longest {
        let text = "the spectrum of Torsethaugen has no peak period of {} with a height of {}: it knows {} to {}";
        let told = [(period, Dim::Time), (height, Dim::Length), (shortest.min(fetch), Dim::Time), (longest, Dim::Time)];
        return Err(ClassError::with_values(text, &told));
    }
    let steep = |height: f64, period: f64| 35.0 * (TAU / FITTED_GRAVITY * height / (period * period)).powf(6.0 / 7.0);
    let rest = |share: f64| height * (1.0 - share * share).max(0.0).sqrt();
    let (first, gamma, second, second_period) = if period <= fetch {
        // wind sea, with a swell at a longer period
        let near = if fetch > shortest { (fetch - period) / (fetch - shortest) } else { 0.0 };
        let share = 0.7 + 0.3 * (-(2.0 * near).powi(2)).exp();
        (share * height, steep(share * height, period), rest(share), fetch + 2.0)
    } else {
        // swell, with a wind sea fully grown at its own height
        let near = (period - fetch) / (longest - fetch);
        let share = 0.6 + 0.4 * (-(near / 0.3).powi(2)).exp();
        (share * height, steep(height, fetch) * (1.0 + 6.0 * near), rest(share), 6.6 * rest(share).cbrt())
    };
    let mut humps = vec![SpectralPeak::of_energy(first * first / 16.0, TAU / period, 4.0, gamma.max(1.0))];
    if second > 1e-6 * height {
        humps.push(SpectralPeak::of_energy(second * second / 16.0, TAU / second_period, 4.0, 1.0));
    }
    Ok(humps)
}
