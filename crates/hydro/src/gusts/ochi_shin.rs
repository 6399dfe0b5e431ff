//! [OCHI-SHIN-1988]: `f S/u*^2` is 583 x up to x = f z/U = 0.003, `420 x^0.7 (1 + x^0.35)^-11.5` up to 0.1, then
//! `838 x (1 + x^0.35)^-11.5`.

use super::{FORMULA_HEIGHT_M, GustSpectrum, friction, reduced_frequency};

/// OCHI.
pub(super) static OCHI: GustSpectrum = GustSpectrum {
    name: "OCHI",
    help: "Ochi and Shin's of winds over the sea; drag coefficient of Wu, 0.0008 + 0.000065 U",
    density: |f, speed| {
        let x = reduced_frequency(f, speed);
        let fall = (1.0 + x.powf(0.35)).powf(-11.5);
        let per = friction(speed) * FORMULA_HEIGHT_M / speed;
        match x {
            x if x <= 0.003 => 583.0 * per,
            x if x <= 0.1 => 420.0 * x.powf(-0.3) * fall * per,
            _ => 838.0 * fall * per,
        }
    },
    // by Simpson's rule
    deviation: |speed| (10.116_441 * friction(speed)).sqrt(),
};
