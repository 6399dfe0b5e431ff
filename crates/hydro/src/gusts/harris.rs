//! [HARRIS-1971]: `f S/(k U^2) = 4 x (2 + x^2)^(-5/6)`, x = 1800 f/U.

use super::{GustSpectrum, friction};

/// HARRIS.
pub(super) static HARRIS: GustSpectrum = GustSpectrum {
    name: "HARRIS",
    help: "Harris's; drag coefficient of Wu",
    density: |f, speed| {
        let length = 1800.0 / speed;
        4.0 * friction(speed) * length * (2.0 + (f * length).powi(2)).powf(-5.0 / 6.0)
    },
    // 4 2^(-1/3) sqrt(pi)/2 Gamma(1/3)/Gamma(5/6)
    deviation: |speed| (6.677_476_047 * friction(speed)).sqrt(),
};
