//! Waves as their energy over frequency: regular, ISSC, JONSWAP, and curves of the user.
//!
//! A sea is kept as many small energies `S dw` at their frequencies (half the square of an amplitude), which add up to
//! `m0 = Hs^2/16`; a regular wave is one energy `a^2/2`. Means over the sea are then plain sums.
//!
//! Sources: ISSC: the two-parameter spectrum of Bretschneider, `S = A w^-5 exp(-B w^-4)`, A = Hs^2 B / 4 (DNV-RP-C205
//! 3.5.5, with B = 1.25 wp^4); JONSWAP: DNV-RP-C205 3.5.5, width 0.07 below and 0.09 above the peak, scaled to its m0 exactly.
//! reference/model.md: the PERIOD of ISSC is the mean period 2 pi m0/m1, and the curve of a user is rescaled to m0 with its
//! peak moved to the PERIOD. Our readings: that of JONSWAP and of a curve is the peak period; `-SP_TYPE` says otherwise for
//! ISSC and JONSWAP; the curve is moved by one factor on all its frequencies; density of a P_SPECTRUM is over frequency too.

use crate::model::{ClassError, Curve, CurveKind, Environment, Model, Sea};
use std::f64::consts::TAU;

/// Parts the energy of a spectrum is cut in.
const PARTS: usize = 4000;
/// Peakedness of JONSWAP where none is given.
const GAMMA: f64 = 3.3;

/// A sea as energies.
#[derive(Clone, Debug, PartialEq)]
pub struct Waves {
    /// Frequency (rad/s), half the square of the amplitude (m2); frequencies grow.
    pub energies: Vec<(f64, f64)>,
}

impl Waves {
    /// The waves of a sea of an environment.
    ///
    /// # Errors
    /// A spectrum without a formula or a curve without energy; a type of period that does not go with it.
    pub fn of(model: &Model, env: &Environment, sea: &Sea) -> Result<Self, ClassError> {
        let sp_type = env.sea_period.as_ref();
        let kind = sp_type.map(|g| g.kind.as_str());
        let name = sea.spectrum.to_ascii_uppercase();
        let refuse = |error: ClassError| sp_type.map_or(error.clone(), |g| error.at(g.span));
        match name.as_str() {
            "REGULAR" => Ok(Waves { energies: vec![(TAU / sea.period, sea.height * sea.height / 8.0)] }),
            "ISSC" => Ok(Waves::peaked(sea.height, sea.period, kind.unwrap_or("MEAN"), 1.0)),
            "JONSWAP" => Ok(Waves::peaked(sea.height, sea.period, kind.unwrap_or("PEAK"), sea.gamma.unwrap_or(GAMMA))),
            "2JONSWAP" => Err(ClassError::new("the sources give no formula of the 2JONSWAP spectrum")
                .help("give two seas, -SEA JONSWAP .. and -A_SEA JONSWAP .., or a F_SPECTRUM curve")),
            _ => match model.curves.get(&Model::key(&name)) {
                Some(_) if kind.is_some_and(|k| k != "PEAK") => {
                    Err(refuse(ClassError::new("the period of a spectrum curve is that of its peak")))
                }
                Some(curve) => Waves::of_curve(curve, sea.height, sea.period),
                None => Err(ClassError::new(format!("there is no spectrum {}", sea.spectrum))),
            },
        }
    }

    /// JONSWAP of a significant height (m) and a period (s) of type PEAK, MEAN or ZERO_CROSSING; ISSC with gamma 1.
    pub fn peaked(height: f64, period: f64, kind: &str, gamma: f64) -> Self {
        // with u = exp(-1.25 x^-4), x = w/wp, the energy of ISSC is du; u = 1 - s^4 keeps the moments of the tail exact
        let part = |i: usize| {
            let s = (i as f64 + 0.5) / PARTS as f64;
            let x = (-0.8 * (-s.powi(4)).ln_1p()).powf(-0.25);
            let width = if x <= 1.0 { 0.07 } else { 0.09 };
            let peak = gamma.powf((-0.5 * ((x - 1.0) / width).powi(2)).exp());
            (x, 4.0 * s.powi(3) * peak)
        };
        let mut energies: Vec<(f64, f64)> = (0..PARTS).rev().map(part).collect();
        let whole: f64 = energies.iter().map(|(_, e)| e).sum();
        let unit = Waves { energies: energies.iter().map(|(x, e)| (*x, e / whole)).collect() };
        // w = x wp: a period of the unit spectrum becomes the one asked for
        let peak = match kind {
            "MEAN" => period * unit.moment(1),
            "ZERO_CROSSING" => period * unit.moment(2).sqrt(),
            _ => period,
        };
        let m0 = height * height / 16.0;
        for (energy, of_unit) in energies.iter_mut().zip(unit.energies) {
            *energy = (of_unit.0 * TAU / peak, of_unit.1 * m0);
        }
        Waves { energies }
    }

    /// A curve of a spectrum, scaled to a significant height (m) and its peak moved to a period (s).
    ///
    /// # Errors
    /// A curve that is no spectrum, or has no energy or no peak at a real frequency.
    pub fn of_curve(curve: &Curve, height: f64, period: f64) -> Result<Self, ClassError> {
        let wrong = |text: &str| Err(ClassError::new(format!("curve {} {text}", curve.name)).at(curve.span));
        let mut points: Vec<(f64, f64)> = match curve.kind {
            CurveKind::FrequencySpectrum => curve.points.clone(),
            CurveKind::PeriodSpectrum => {
                curve.points.iter().rev().filter(|p| p.0 > 0.0).map(|(t, s)| (TAU / t, *s)).collect()
            }
            _ => return wrong("is no spectrum"),
        };
        let top = points.iter().fold((0.0, 0.0), |best: (f64, f64), p| if p.1 > best.1 { *p } else { best });
        if top.0 <= 0.0 {
            return wrong("has no peak at a frequency above zero");
        }
        points.iter_mut().for_each(|p| p.0 *= TAU / period / top.0);
        let between = (PARTS / points.len().max(1)).max(8);
        let mut energies = Vec::with_capacity(between * points.len());
        for pair in points.windows(2) {
            let [(low, at_low), (high, at_high)] = pair else { continue };
            let width = (high - low) / between as f64;
            energies.extend((0..between).map(|i| {
                let t = (i as f64 + 0.5) / between as f64;
                (low + t * (high - low), (at_low + t * (at_high - at_low)) * width)
            }));
        }
        let whole: f64 = energies.iter().map(|(_, e)| e).sum();
        if whole <= 0.0 || !whole.is_finite() {
            return wrong("has no energy");
        }
        energies.iter_mut().for_each(|e| e.1 *= height * height / (16.0 * whole));
        Ok(Waves { energies })
    }

    /// The sum of energy times the frequency to a power: `m0`, `m1`, `m2` (m2 (rad/s)^n).
    pub fn moment(&self, power: i32) -> f64 {
        self.energies.iter().map(|(w, e)| e * w.powi(power)).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn periods_of_issc_are_those_of_its_closed_form() {
        // T1/Tp = (4/5)^(1/4) / Gamma(3/4), Tz/Tp = (4/(5 pi))^(1/4), Gamma(3/4) = 1.2254167024651776
        let waves = Waves::peaked(4.0, 10.0, "PEAK", 1.0);
        let (t1, tz) = (TAU * waves.moment(0) / waves.moment(1), TAU * (waves.moment(0) / waves.moment(2)).sqrt());
        assert!((waves.moment(0) - 1.0).abs() < 1e-12);
        assert!((t1 / 10.0 - 0.8f64.powf(0.25) / 1.225_416_702_465_177_6).abs() < 1e-5, "{t1}");
        assert!((tz / 10.0 - (0.8 / std::f64::consts::PI).powf(0.25)).abs() < 1e-5, "{tz}");
    }

    #[test]
    fn periods_of_jonswap_are_those_of_dnv() {
        // DNV-RP-C205 3.5.5.5: Tz/Tp = 0.6673 + 0.05037 g - 0.00623 g^2 + 0.0003341 g^3, T1/Tp = 0.7303 + 0.04936 g
        // - 0.006556 g^2 + 0.0003610 g^3: fits, good to some 0.5 %
        for gamma in [1.0, 2.0, 3.3, 5.0] {
            let waves = Waves::peaked(4.0, 10.0, "PEAK", gamma);
            let (t1, tz) = (TAU * waves.moment(0) / waves.moment(1), TAU * (waves.moment(0) / waves.moment(2)).sqrt());
            let fit = |c: [f64; 4]| 10.0 * (c[0] + gamma * (c[1] + gamma * (c[2] + gamma * c[3])));
            assert!((tz / fit([0.6673, 0.05037, -0.00623, 0.0003341]) - 1.0).abs() < 5e-3, "{gamma} {tz}");
            assert!((t1 / fit([0.7303, 0.04936, -0.006556, 0.0003610]) - 1.0).abs() < 5e-3, "{gamma} {t1}");
        }
    }

    #[test]
    fn a_period_of_another_type_comes_back() {
        for (kind, power) in [("MEAN", 1), ("ZERO_CROSSING", 2)] {
            let waves = Waves::peaked(3.0, 9.0, kind, 2.0);
            let found = TAU * (waves.moment(0) / waves.moment(power)).powf(1.0 / f64::from(power));
            assert!((found - 9.0).abs() < 1e-9, "{kind} {found}");
        }
    }
}
