//! Torsethaugen's spectrum of wind sea and swell, simplified [TORSETHAUGEN-HAVER-2004; DNV-RP-C205 appendix A].

use super::{PeriodInput, WaveForm, WaveSpectrum};
use crate::sea::density::{SpectralPeak, Spectrum};
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Gravity in the formulas that were fitted with it (m/s2).
const FITTED_GRAVITY: f64 = 9.81;

/// TORSETHAUGEN.
pub(super) static TORSETHAUGEN: WaveSpectrum = WaveSpectrum {
    name: "TORSETHAUGEN",
    help: "wind sea and swell of the Norwegian Sea (simplified, 2004); PERIOD is the peak period",
    parameters: &[],
    form: WaveForm::Irregular {
        period: PeriodInput::PeakOnly("the spectrum of Torsethaugen"),
        build: |sea| Spectrum::from_peaks(torsethaugen(sea.height, sea.period)?, None).with_energy(),
    },
};

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
        let values =
            [(period, Dim::Time), (height, Dim::Length), (shortest.min(fetch), Dim::Time), (longest, Dim::Time)];
        return Err(ClassError::with_values(text, &values));
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
    let mut humps = vec![SpectralPeak::from_energy(first * first / 16.0, TAU / period, 4.0, gamma.max(1.0))];
    if second > 1e-6 * height {
        humps.push(SpectralPeak::from_energy(second * second / 16.0, TAU / second_period, 4.0, 1.0));
    }
    Ok(humps)
}
