//! ISSC: the spectrum of Pierson and Moskowitz with a height and a period of its own, JONSWAP of a peakedness of 1
//! [DNV-RP-C205 3.5.5].

use super::jonswap::jonswap;
use super::{PeriodInput, PeriodType, WaveForm, WaveSpectrum};
use crate::sea::density::Spectrum;

/// ISSC.
pub(super) static ISSC: WaveSpectrum = WaveSpectrum {
    name: "ISSC",
    help: "Pierson and Moskowitz's of two parameters; PERIOD is the mean period unless -SP_TYPE says otherwise",
    parameters: &[],
    form: WaveForm::Irregular {
        period: PeriodInput::AsTyped(PeriodType::Mean),
        build: |sea| Spectrum::from_peaks(jonswap(sea.height, sea.period, sea.period_type, 1.0), None).with_energy(),
    },
};
