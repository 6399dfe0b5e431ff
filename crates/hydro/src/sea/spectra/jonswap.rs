//! JONSWAP [DNV-RP-C205 3.5.5].

use super::{PeriodInput, PeriodType, ShapeParameter, WaveForm, WaveSpectrum};
use crate::sea::density::{SpectralPeak, Spectrum};
use std::f64::consts::TAU;
use windlass_base::units::Dim;

/// The peakedness. A spectrum without parameters may be given it too, as in MOSES: it is kept and shown, without effect.
pub static GAMMA: ShapeParameter = ShapeParameter {
    name: "GAMMA",
    label: "Gamma",
    dim: Dim::None,
    range: [1.0, 20.0],
    help: "peakedness; without it that of DNV-RP-C205 3.5.5.5: 5 up to Tp/sqrt(HS) = 3.6 (s, m), exp(5.75 - 1.15 Tp/sqrt(HS)) \
           up to 5, 1 beyond",
    default: Some(default_gamma),
};

/// JONSWAP.
pub(super) static JONSWAP: WaveSpectrum = WaveSpectrum {
    name: "JONSWAP",
    help: "of the North Sea, peaked by GAMMA; PERIOD is the peak period unless -SP_TYPE says otherwise",
    parameters: &[GAMMA],
    form: WaveForm::Irregular {
        period: PeriodInput::AsTyped(PeriodType::Peak),
        build: |sea| {
            let [gamma] = sea.parameters();
            let peaks = jonswap(sea.height, sea.period, sea.period_type, gamma);
            Spectrum::from_peaks(peaks, None).with_energy()
        },
    },
};

/// ISSC (gamma 1) or JONSWAP.
pub fn jonswap(height: f64, period: f64, kind: PeriodType, gamma: f64) -> Vec<SpectralPeak> {
    let unit = Spectrum::from_peaks(vec![SpectralPeak::from_energy(1.0, 1.0, 5.0, gamma)], None);
    // w = x wp: a period of the unit spectrum becomes the one asked for
    let peak = match kind {
        PeriodType::Peak => period,
        PeriodType::Mean => period * unit.moment(1),
        PeriodType::ZeroCrossing => period * unit.moment(2).sqrt(),
    };
    vec![SpectralPeak::from_energy(height * height / 16.0, TAU / peak, 5.0, gamma)]
}

/// The peakedness of JONSWAP of a significant height (m) and a period (s) where none is given: 5 up to Tp/sqrt(Hs) = 3.6, exp(5.75 - 1.15
/// Tp/sqrt(Hs)) up to 5, 1 beyond [DNV-RP-C205 3.5.5.5]; the peak period is that of the period given.
pub fn default_gamma(height: f64, period: f64, kind: PeriodType) -> f64 {
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
