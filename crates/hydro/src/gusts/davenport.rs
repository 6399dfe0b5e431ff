//! [DAVENPORT-1961]: `f S/(k U^2) = 4 x^2 (1 + x^2)^(-4/3)`, x = 1200 f/U.

use super::{GustSpectrum, friction};

/// DAVENPORT.
pub(super) static DAVENPORT: GustSpectrum = GustSpectrum {
    name: "DAVENPORT",
    help: "Davenport's of winds over land; drag coefficient of Wu",
    density: |f, speed| {
        let length = 1200.0 / speed;
        4.0 * friction(speed) * length * length * f * (1.0 + (f * length).powi(2)).powf(-4.0 / 3.0)
    },
    deviation: |speed| (6.0 * friction(speed)).sqrt(),
};
