//! Waves as their energy over frequency, and the spectrum of a sea of an environment.
//!
//! A sea is kept as many small energies `S dw` at their frequencies (half the square of an amplitude), which add up to
//! `m0 = Hs^2/16`; a regular wave is one energy `a^2/2`. Means over the sea are then plain sums. The spectra stand in
//! [`super::sea::spectra`].
//!
//! [MOSES-REF env, curv]: the PERIOD of ISSC is the mean period 2 pi m0/m1, and the curve of a user is rescaled to m0 with its
//! peak moved to the PERIOD. Our readings: that of JONSWAP, TORSETHAUGEN and of a curve is the peak period; `-SP_TYPE` says
//! otherwise for ISSC and JONSWAP; OCHI is rescaled and moved as a curve is, by its highest peak; the curve is moved by one
//! factor on all its frequencies; density of a P_SPECTRUM is over frequency too.

use super::sea::density::Spectrum;
use super::sea::spectra::{self, PeriodInput, PeriodType, SeaState, ShapeParameter, WaveForm, jonswap};
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::{ClassError, Curve, CurveKind, Environment, GivenWave, Model, SeaDefinition};

/// A sea as energies.
#[derive(Clone, Debug, PartialEq)]
pub struct WaveEnergies {
    /// Frequency (rad/s), half the square of the amplitude (m2); frequencies grow.
    pub energies: Vec<(f64, f64)>,
}

/// Whether a sea is a regular wave.
pub fn is_regular(sea: &SeaDefinition) -> bool {
    spectra::find(&sea.spectrum).is_some_and(|spectrum| spectrum.is_regular())
}

/// Whether a sea is a Stokes wave.
pub fn is_stokes(sea: &SeaDefinition) -> bool {
    spectra::find(&sea.spectrum).is_some_and(|spectrum| spectrum.is_stokes())
}

/// What `-SP_TYPE` says the period of the seas is.
fn asked_period(env: &Environment) -> Option<PeriodType> {
    env.sea_period.as_ref().map(|given| given.kind)
}

/// The parameters of the spectrum of a sea with their values (SI), given or the usual ones; none for spectra without parameters.
pub fn shape_of(env: &Environment, sea: &SeaDefinition) -> Vec<(&'static ShapeParameter, f64)> {
    let Some(spectrum) = spectra::find(&sea.spectrum) else { return Vec::new() };
    let values = spectrum.shape(sea, spectrum.period_type(asked_period(env)));
    spectrum.parameters.iter().zip(values).collect()
}

/// The spectrum of a sea of an environment, between two frequencies (rad/s) or over all; `None` for a regular wave.
///
/// # Errors
/// No energy; a spectrum without a formula or a curve without energy; a type of period that does not go with it.
pub fn build_spectrum(
    model: &Model,
    env: &Environment,
    sea: &SeaDefinition,
    limits: Option<[f64; 2]>,
) -> Result<Option<Spectrum>, ClassError> {
    if is_regular(sea) {
        return Ok(None);
    }
    for (value, dim, position, what) in
        [(sea.height, Dim::Length, 2, "a significant height"), (sea.period, Dim::Time, 3, "a period")]
    {
        if !(value > 0.0 && value.is_finite()) {
            let text = format!("a sea of {what} of {{}} has no energy");
            return Err(ClassError::with_values(text, &[(value, dim)])
                .with_span(sea.position(position))
                .help("leave out the sea for calm water"));
        }
    }
    let at_name = |error: ClassError| error.clone().with_span(error.span.unwrap_or(sea.position(0)));
    let whole = whole(model, env, sea).map_err(at_name)?;
    let m0 = whole.moment(0);
    Ok(Some(match limits {
        None => whole,
        Some(_) => whole.with_scaled_frequencies(1.0, m0, limits).map_err(at_name)?,
    }))
}

fn whole(model: &Model, env: &Environment, sea: &SeaDefinition) -> Result<Spectrum, ClassError> {
    let asked = env.sea_period.as_ref();
    let of_peak = |what: &str| match asked {
        Some(given) if given.kind != PeriodType::Peak => {
            Err(ClassError::new(format!("the period of {what} is that of its peak")).with_span(given.span))
        }
        _ => Ok(()),
    };
    let Some(spectrum) = spectra::find(&sea.spectrum) else {
        let Some(curve) = model.curves.get(&Model::key(&sea.spectrum)) else {
            return Err(ClassError::new(format!("there is no spectrum {}", sea.spectrum)));
        };
        of_peak("a spectrum curve")?;
        return from_curve(curve, sea.height, sea.period);
    };
    let WaveForm::Irregular { period, build } = spectrum.form else {
        return Err(ClassError::new(format!("{} is a regular wave, not a spectrum", sea.spectrum)));
    };
    if let PeriodInput::PeakOnly(what) = period {
        of_peak(what)?;
    }
    let period_type = spectrum.period_type(asked_period(env));
    let shape = spectrum.shape(sea, period_type);
    build(&SeaState { height: sea.height, period: sea.period, period_type, shape })
}

/// A curve of a spectrum, scaled to a significant height (m) and its peak moved to a period (s).
///
/// # Errors
/// A curve that is no spectrum, or has no energy or no peak at a real frequency.
pub fn from_curve(curve: &Curve, height: f64, period: f64) -> Result<Spectrum, ClassError> {
    let wrong = |text: &str| ClassError::new(format!("curve {} {text}", curve.name)).with_span(curve.span);
    let points: Vec<(f64, f64)> = match curve.kind {
        CurveKind::FrequencySpectrum => curve.points.clone(),
        CurveKind::PeriodSpectrum => {
            curve.points.iter().rev().filter(|p| p.0 > 0.0).map(|(t, s)| (TAU / t, *s)).collect()
        }
        _ => return Err(wrong("is no spectrum")),
    };
    let top = points.iter().fold((0.0, 0.0), |best: (f64, f64), p| if p.1 > best.1 { *p } else { best });
    if top.0 <= 0.0 {
        return Err(wrong("has no peak at a frequency above zero"));
    }
    let found = Spectrum::from_curve(points, None);
    found
        .with_scaled_frequencies(TAU / period / top.0, height * height / 16.0, None)
        .map_err(|_| wrong("has no energy"))
}

impl WaveEnergies {
    /// The waves of a sea of an environment.
    ///
    /// # Errors
    /// As [`build_spectrum`].
    pub fn new(model: &Model, env: &Environment, sea: &SeaDefinition) -> Result<Self, ClassError> {
        let regular = || vec![(TAU / sea.period, sea.height * sea.height / 8.0)];
        Ok(WaveEnergies {
            energies: build_spectrum(model, env, sea, None)?.map_or_else(regular, |spectrum| spectrum.energies()),
        })
    }

    /// The same with a share of the energy.
    pub fn scaled(&self, share: f64) -> Self {
        WaveEnergies {
            energies: self.energies.iter().map(|(frequency, energy)| (*frequency, energy * share)).collect(),
        }
    }

    /// The energies of waves given one by one, by the direction they come from (rad).
    pub fn by_direction(waves: &[GivenWave]) -> Vec<(f64, Self)> {
        let mut found: Vec<(f64, Self)> = Vec::new();
        for wave in waves {
            let energy = (wave.frequency, 0.5 * wave.amplitude * wave.amplitude);
            match found.iter_mut().find(|(direction, _)| *direction == wave.direction) {
                Some((_, own)) => own.energies.push(energy),
                None => found.push((wave.direction, WaveEnergies { energies: vec![energy] })),
            }
        }
        for (_, own) in &mut found {
            own.energies.sort_by(|a, b| a.0.total_cmp(&b.0));
        }
        found
    }

    /// JONSWAP of a significant height (m) and a period (s); ISSC with gamma 1.
    pub fn from_peak(height: f64, period: f64, kind: PeriodType, gamma: f64) -> Self {
        WaveEnergies { energies: Spectrum::from_peaks(jonswap(height, period, kind, gamma), None).energies() }
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
    fn periods_of_issc_match_closed_form() {
        // T1/Tp = (4/5)^(1/4) / Gamma(3/4), Tz/Tp = (4/(5 pi))^(1/4), Gamma(3/4) = 1.2254167024651776
        let waves = WaveEnergies::from_peak(4.0, 10.0, PeriodType::Peak, 1.0);
        let (t1, tz) = (TAU * waves.moment(0) / waves.moment(1), TAU * (waves.moment(0) / waves.moment(2)).sqrt());
        assert!((waves.moment(0) - 1.0).abs() < 1e-12);
        assert!((t1 / 10.0 - 0.8f64.powf(0.25) / 1.225_416_702_465_177_6).abs() < 1e-5, "{t1}");
        assert!((tz / 10.0 - (0.8 / std::f64::consts::PI).powf(0.25)).abs() < 1e-5, "{tz}");
    }

    #[test]
    fn periods_of_jonswap_match_dnv() {
        // [DNV-RP-C205 3.5.5.5]: Tz/Tp = 0.6673 + 0.05037 g - 0.00623 g^2 + 0.0003341 g^3, T1/Tp = 0.7303 + 0.04936 g
        // - 0.006556 g^2 + 0.0003610 g^3: fits, good to some 0.5 %
        for gamma in [1.0, 2.0, 3.3, 5.0] {
            let waves = WaveEnergies::from_peak(4.0, 10.0, PeriodType::Peak, gamma);
            let (t1, tz) = (TAU * waves.moment(0) / waves.moment(1), TAU * (waves.moment(0) / waves.moment(2)).sqrt());
            let fit = |c: [f64; 4]| 10.0 * (c[0] + gamma * (c[1] + gamma * (c[2] + gamma * c[3])));
            assert!((tz / fit([0.6673, 0.05037, -0.00623, 0.0003341]) - 1.0).abs() < 5e-3, "{gamma} {tz}");
            assert!((t1 / fit([0.7303, 0.04936, -0.006556, 0.0003610]) - 1.0).abs() < 5e-3, "{gamma} {t1}");
        }
    }

    #[test]
    fn period_converts_to_another_type_and_back() {
        for (kind, power) in [(PeriodType::Mean, 1), (PeriodType::ZeroCrossing, 2)] {
            let waves = WaveEnergies::from_peak(3.0, 9.0, kind, 2.0);
            let found = TAU * (waves.moment(0) / waves.moment(power)).powf(1.0 / f64::from(power));
            assert!((found - 9.0).abs() < 1e-9, "{kind:?} {found}");
        }
    }
}
