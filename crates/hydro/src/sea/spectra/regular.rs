//! Regular waves: Airy's and Stokes'. Neither has a density: their one component is made in [`crate::sea`].

use super::{WaveForm, WaveSpectrum};

/// REGULAR.
pub(super) static REGULAR: WaveSpectrum = WaveSpectrum {
    name: "REGULAR",
    help: "a regular wave of linear theory (Airy) of height HS and this PERIOD",
    parameters: &[],
    form: WaveForm::Regular { stokes: false },
};

/// STOKES.
pub(super) static STOKES: WaveSpectrum = WaveSpectrum {
    name: "STOKES",
    help: "a regular wave by Stokes' theory (Fenton), of the order of -STOKES",
    form: WaveForm::Regular { stokes: true },
    ..REGULAR
};
