//! Gaussian swell: `S(w) = m0 / (s sqrt(2 pi)) exp(-(w - wp)^2 / (2 s^2))`, the usual form of swell from far away, as off West
//! Africa, whose energy stays within a narrow band about the peak where JONSWAP of any peakedness has a tail.

use super::{PeriodInput, SeaState, ShapeParameter, WaveForm, WaveSpectrum};
use crate::sea::density::Spectrum;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Standard deviations to either side beyond which there is no energy: less than 2e-15 of it is left out.
const REACH: f64 = 8.0;
/// The least peak frequency in standard deviations: 3e-5 of the energy would then be below zero.
const NARROWEST: f64 = 4.0;
/// Panels of each side, a power of two, so that the peak is between two of them.
const PANELS: u32 = 32;

/// GAUSSIAN.
pub(super) static GAUSSIAN: WaveSpectrum = WaveSpectrum {
    name: "GAUSSIAN",
    help: "swell with a normal distribution of energy over frequency; PERIOD is the peak period",
    parameters: &[ShapeParameter {
        name: "SIGMA",
        label: "Sigma",
        dim: Dim::Frequency,
        range: [1e-3, 1.0],
        help: "standard deviation of the frequency, a quarter of the peak frequency at most; no default",
        default: None,
    }],
    form: WaveForm::Irregular { period: PeriodInput::PeakOnly("a Gaussian swell"), build },
};

fn build(sea: &SeaState) -> Result<Spectrum, ClassError> {
    let ([deviation], peak) = (sea.parameters(), TAU / sea.period);
    if deviation.is_nan() {
        return Err(ClassError::new("a Gaussian swell has no standard deviation").help("SIGMA after PERIOD gives it"));
    }
    if NARROWEST * deviation > peak {
        let text = "a Gaussian swell of standard deviation {} is too wide for its peak frequency of {}";
        return Err(ClassError::with_values(text, &[(deviation, Dim::Frequency), (peak, Dim::Frequency)])
            .help("SIGMA is a quarter of the peak frequency at most"));
    }
    // down to a thousandth of the peak frequency
    let half = [(REACH * deviation).min(0.999 * peak), REACH * deviation];
    let share = |i: u32| f64::from(i) / f64::from(PANELS);
    let below = (0..PANELS).map(|i| peak - half[0] * (1.0 - share(i)));
    let knots = below.chain((0..=PANELS).map(|i| peak + half[1] * share(i))).collect();
    let form = |w: f64, parameters: &[f64]| match parameters {
        [peak, deviation] => (-0.5 * ((w - peak) / deviation).powi(2)).exp(),
        _ => 0.0,
    };
    Spectrum::from_form(form, vec![peak, deviation], knots).with_scaled_frequencies(1.0, sea.energy(), None)
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_model::PeriodType;

    #[test]
    fn gaussian_swell_matches_moments_and_quantiles_of_normal_distribution() {
        let (height, period, deviation) = (3.0, 14.0, 0.04);
        let shape = vec![deviation];
        let made = build(&SeaState { height, period, period_type: PeriodType::Peak, shape }).map_err(|e| e.to_string());
        let Ok(spectrum) = made else { panic!("{made:?}") };
        let (m0, peak) = (height * height / 16.0, TAU / period);
        let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-12, "{got} {want}");
        near(spectrum.moment(0), m0);
        near(spectrum.moment(1), m0 * peak);
        near(spectrum.moment(2), m0 * (peak * peak + deviation * deviation));
        near(spectrum.density(peak), m0 / (deviation * TAU.sqrt()));
        assert!((spectrum.peak() / peak - 1.0).abs() < 1e-6);
        // the normal distribution at one and at two standard deviations (Abramowitz and Stegun 26.1)
        near(spectrum.quantile(0.841_344_746_068_542_9), peak + deviation);
        near(spectrum.quantile(0.022_750_131_948_179_2), peak - 2.0 * deviation);
    }

    #[test]
    fn swell_wider_than_its_peak_frequency_allows_is_refused() {
        let sea = SeaState { height: 2.0, period: 20.0, period_type: PeriodType::Peak, shape: vec![0.08] };
        assert!(build(&sea).is_err());
        assert!(build(&SeaState { shape: vec![0.078], ..sea.clone() }).is_ok());
        assert!(
            build(&SeaState { shape: Vec::new(), ..sea })
                .is_err_and(|e| e.to_string().contains("no standard deviation"))
        );
    }
}
