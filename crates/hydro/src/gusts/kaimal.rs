//! [KAIMAL-1972]: `f S/u*^2 = 105 x (1 + 33 x)^(-5/3)`, x = f z/U.

use super::{FORMULA_HEIGHT_M, GustSpectrum, friction, reduced_frequency};

/// KAIMAL.
pub(super) static KAIMAL: GustSpectrum = GustSpectrum {
    name: "KAIMAL",
    help: "Kaimal's of the surface layer; drag coefficient of Wu",
    density: |f, speed| {
        105.0 * friction(speed) * FORMULA_HEIGHT_M / speed * (1.0 + 33.0 * reduced_frequency(f, speed)).powf(-5.0 / 3.0)
    },
    deviation: |speed| (105.0 / 22.0 * friction(speed)).sqrt(),
};
