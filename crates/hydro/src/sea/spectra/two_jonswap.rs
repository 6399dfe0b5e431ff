//! 2JONSWAP: a name of [MOSES-REF env] whose formula the sources do not give. It is known so that the message names the remedy.

use super::{PeriodInput, PeriodType, WaveForm, WaveSpectrum};
use windlass_model::ClassError;

/// 2JONSWAP.
pub(super) static TWO_JONSWAP: WaveSpectrum = WaveSpectrum {
    name: "2JONSWAP",
    help: "no source gives its formula: what needs it reports an error",
    parameters: &[],
    form: WaveForm::Irregular {
        period: PeriodInput::AsTyped(PeriodType::Peak),
        build: |_| {
            Err(ClassError::new("the sources give no formula of the 2JONSWAP spectrum")
                .help("give two seas, -SEA JONSWAP .. and -A_SEA JONSWAP .., or a F_SPECTRUM curve"))
        },
    },
};
