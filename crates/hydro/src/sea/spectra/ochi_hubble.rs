//! Ochi and Hubble's spectrum of two peaks, three parameters each [OCHI-HUBBLE-1976].

use super::{PeriodInput, WaveForm, WaveSpectrum};
use crate::sea::density::{SpectralPeak, Spectrum};
use std::f64::consts::TAU;
use windlass_model::ClassError;

/// OCHI: rescaled to the significant height and moved by its highest peak, as a curve of the user is; our reading.
pub(super) static OCHI: WaveSpectrum = WaveSpectrum {
    name: "OCHI",
    help: "Ochi and Hubble's most probable one of HS, its highest peak moved to PERIOD",
    parameters: &[],
    form: WaveForm::Irregular {
        period: PeriodInput::PeakOnly("the spectrum of Ochi and Hubble"),
        build: |sea| {
            let found = Spectrum::from_peaks(ochi_hubble(most_probable(sea.height))?, None).with_energy()?;
            found.with_scaled_frequencies(TAU / sea.period / found.peak(), sea.energy(), None)
        },
    },
};

/// OCHI_HUBBLE: another name of it.
pub(super) static OCHI_HUBBLE: WaveSpectrum = WaveSpectrum { name: "OCHI_HUBBLE", help: "the same as OCHI", ..OCHI };

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
        Ok(SpectralPeak::from_energy(height * height / 16.0, peak, 4.0 * shape + 1.0, 1.0))
    };
    parts.into_iter().map(hump).collect()
}

/// The most probable six parameters of a significant height (m): [OCHI-HUBBLE-1976 table 2].
/// Their heights come to 0.9986 of it.
pub fn most_probable(height: f64) -> [[f64; 3]; 2] {
    let fall = |a: f64, b: f64| a * (-b * height).exp();
    [[0.84 * height, fall(0.70, 0.046), 3.0], [0.54 * height, fall(1.15, 0.039), fall(1.54, 0.062)]]
}
