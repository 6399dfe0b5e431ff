//! NPD (Froya) [ANDERSEN-1992; ISO-19901-1 A.7.4]: `320 (U/10)^2 (z/10)^0.45 (1 + x^n)^(-5/(3n))`, n = 0.468,
//! x = 172 f (z/10)^(2/3) (U/10)^-0.75.

use super::GustSpectrum;

/// NPD.
pub(super) static NPD: GustSpectrum = GustSpectrum {
    name: "NPD",
    help: "the Norwegian Petroleum Directorate's of Froya, also that of later API RP 2A",
    density: |f, speed| {
        const N: f64 = 0.468;
        let x = 172.0 * f * (speed / 10.0).powf(-0.75);
        3.2 * speed * speed * (1.0 + x.powf(N)).powf(-5.0 / (3.0 * N))
    },
    deviation: |speed| {
        // B(1/n, 2/(3n))/n, with B Euler's beta function, is 0.567222
        (3.2 * speed * speed * (speed / 10.0).powf(0.75) / 172.0 * 0.567_222_117_5).sqrt()
    },
};

/// ISO: the same spectrum.
pub(super) static ISO: GustSpectrum = GustSpectrum { name: "ISO", help: "ISO 19901-1, the same as NPD", ..NPD };
