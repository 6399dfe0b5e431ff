//! [API-RP-2A 2.3.2], 20th edition: `s^2/fp (1 + 1.5 f/fp)^(-5/3)`, s = 0.15 (z/20)^-0.125 U, fp = 0.025 U/z. (The 21st edition
//! has that of NPD.)

use super::{FORMULA_HEIGHT_M, GustSpectrum};

/// API.
pub(super) static API: GustSpectrum = GustSpectrum {
    name: "API",
    help: "API RP 2A, 20th edition",
    density: |f, speed| {
        let (s, peak) = (deviation(speed), 0.025 * speed / FORMULA_HEIGHT_M);
        s * s / peak * (1.0 + 1.5 * f / peak).powf(-5.0 / 3.0)
    },
    deviation,
};

fn deviation(speed: f64) -> f64 {
    0.15 * (FORMULA_HEIGHT_M / 20.0).powf(-0.125) * speed
}
