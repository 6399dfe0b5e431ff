//! Gusts: the spectrum of the wind's speed about its mean, cut in components with a phase each.
//!
//! The spectra are those at 10 m, the height of the wind of `&ENV`; a gust is the same at all heights and places at one time: no
//! coherence in space is regarded, which is safe for large bodies. (The standard deviation of a boundary layer hardly changes with
//! height: that of API not at all up to 20 m.) The mean is over an hour, so that slower components belong to it: those taken
//! reach from a period of an hour to one of a second. All formulas are from memory of the sources named, one-sided, f in Hz; each
//! has its file.

mod api;
mod davenport;
mod froya;
mod harris;
mod kaimal;
mod ochi_shin;

use super::sea::components::{SpectrumBand, bands, bands_about};
use super::sea::density::Spectrum;
use super::sea::phases::phases;
use std::f64::consts::TAU;
use std::sync::Mutex;
use windlass_base::units::Dim;
use windlass_model::{ClassError, Curve, CurveKind, CurveReference, Division, Environment, Model, Phasing};

/// Lowest and highest frequency of gusts of a formula (Hz).
pub const FREQUENCY_RANGE_HZ: [f64; 2] = [1.0 / 3600.0, 1.0];
/// Number of components where none is given.
pub const DEFAULT_COMPONENTS: usize = 100;
/// Seed of the phases where none is given.
pub const DEFAULT_SEED: u64 = 1;
/// The numbers of a seed go to the sea, the added sea and then the gusts.
const SEED_STREAM: u64 = 2;
/// Points that stand for a formula, in equal steps of the logarithm: straight lines between them are off by 2e-5.
const SPECTRUM_POINTS: usize = 800;
/// Height of the formulas (m).
const FORMULA_HEIGHT_M: f64 = super::wind::REFERENCE_HEIGHT_M;

/// A gust spectrum as `-W_SPECTRUM` of `&ENV` takes it. One is declared in the file that has its formula, and listed in
/// [`GUST_SPECTRA`].
#[derive(Clone, Copy, Debug)]
pub struct GustSpectrum {
    /// The word that asks for it.
    pub name: &'static str,
    /// One line of help: whose it is.
    pub help: &'static str,
    /// Density (m2/s2 per Hz) at a frequency (Hz) about a mean speed at 10 m (m/s).
    pub density: fn(f: f64, speed: f64) -> f64,
    /// Standard deviation (m/s) of all frequencies about a mean speed at 10 m (m/s): the root of the integral of the density.
    pub deviation: fn(speed: f64) -> f64,
}

/// Every gust spectrum, in the order of help and messages.
pub static GUST_SPECTRA: &[&GustSpectrum] =
    &[&api::API, &froya::NPD, &froya::ISO, &ochi_shin::OCHI, &harris::HARRIS, &davenport::DAVENPORT, &kaimal::KAIMAL];

/// The names of all, for specs.
pub const NAMES: &[&str] = &names();

const fn names() -> [&'static str; GUST_SPECTRA.len()] {
    let mut names = [""; GUST_SPECTRA.len()];
    let mut i = 0;
    while i < names.len() {
        names[i] = GUST_SPECTRA[i].name;
        i += 1;
    }
    names
}

/// The gust spectrum of a name, in capitals or not.
pub fn find(name: &str) -> Option<&'static GustSpectrum> {
    GUST_SPECTRA.iter().find(|spectrum| spectrum.name.eq_ignore_ascii_case(name)).copied()
}

/// Drag coefficient of the sea's surface at 10 m under a mean speed (m/s), `(u*/U)^2` [WU-1982], the k of Harris and Davenport.
pub fn drag_coefficient(speed: f64) -> f64 {
    1e-3 * (0.8 + 0.065 * speed)
}

/// The square of the friction velocity (m2/s2) under a mean speed (m/s).
fn friction(speed: f64) -> f64 {
    drag_coefficient(speed) * speed * speed
}

/// `f z/U` of a frequency (Hz) at a mean speed (m/s).
fn reduced_frequency(f: f64, speed: f64) -> f64 {
    f * FORMULA_HEIGHT_M / speed
}

/// The gusts of an environment.
#[derive(Debug)]
pub struct Gusts {
    /// Name of the formula or the curve.
    pub name: String,
    /// Mean speed at 10 m (m/s).
    pub mean: f64,
    /// What the components stand for: density (m2/s, over rad/s).
    pub spectrum: Spectrum,
    /// Its parts, one component each, by growing frequency.
    pub bands: Vec<SpectrumBand>,
    /// Phase of each component (rad): `u = sum of a cos(w t - phase)`.
    pub phases: Vec<f64>,
    /// Seed of the phases.
    pub seed: u64,
    /// Standard deviation of all frequencies of a formula that is taken as it is (m/s).
    pub whole: Option<f64>,
    /// The last time asked for and the gust then: the loads of a step all ask for the same.
    last: Mutex<Option<(f64, f64)>>,
}

impl Gusts {
    /// Those of an environment; `None` without a spectrum, or in a calm.
    ///
    /// # Errors
    /// A spectrum without a wind, without a curve or without energy.
    pub fn new(model: &Model, env: &Environment) -> Result<Option<Self>, ClassError> {
        let Some(named) = &env.gusts else { return Ok(None) };
        let Some(wind) = env.wind else {
            let text = "gusts have no mean wind and no direction";
            return Err(ClassError::new(text).with_span(named.span).help("give -WIND SPEED DIR"));
        };
        if wind.speed == 0.0 {
            return Ok(None);
        }
        let shape = find(&named.kind);
        let points = match shape {
            Some(shape) => table(shape, wind.speed),
            None => from_curve(model, named)?,
        };
        let mut spectrum = Spectrum::from_curve(points, None).with_energy().map_err(|e| e.with_span(named.span))?;
        let parts = env.gust_parts;
        let intensity = parts.and_then(|p| p.intensity);
        if let Some(intensity) = intensity {
            let deviation = intensity * wind.speed;
            spectrum = spectrum
                .with_scaled_frequencies(1.0, deviation * deviation, None)
                .map_err(|e| e.with_span(named.span))?;
        }
        let number = parts.map_or(DEFAULT_COMPONENTS, |p| p.number);
        let bands = if env.gust_periods.is_empty() {
            bands(&spectrum, number, Division::EqualEnergy, true)
        } else {
            bands_about(&spectrum, &env.gust_periods)
        };
        let bands = bands.map_err(|e| e.with_span(named.span))?;
        // waves that are reinforced make a crest; gusts that are would make a wind of many times its deviation
        let seed = match env.phasing {
            Some(Phasing::Seeded(seed)) => seed,
            _ => DEFAULT_SEED,
        };
        let phases = phases(Phasing::Seeded(seed), SEED_STREAM, bands.iter().map(|b| b.frequency));
        let whole = shape.filter(|_| intensity.is_none()).map(|s| (s.deviation)(wind.speed));
        let name = named.kind.clone();
        Ok(Some(Gusts { name, mean: wind.speed, spectrum, bands, phases, seed, whole, last: Mutex::new(None) }))
    }

    /// Standard deviation of the components (m/s).
    pub fn deviation(&self) -> f64 {
        self.bands.iter().map(|b| b.energy).sum::<f64>().sqrt()
    }

    /// The gust at a time (s), along the mean wind (m/s).
    pub fn speed_at_time(&self, time: f64) -> f64 {
        let mut last = self.last.lock().ok();
        if let Some((_, gust)) = last.as_deref().copied().flatten().filter(|(known, _)| *known == time) {
            return gust;
        }
        let parts = self.bands.iter().zip(&self.phases);
        let gust = parts.map(|(b, phase)| (2.0 * b.energy).sqrt() * (b.frequency * time - phase).cos()).sum();
        if let Some(last) = last.as_deref_mut() {
            *last = Some((time, gust));
        }
        gust
    }
}

/// A formula as frequency (rad/s) and density (m2/s).
fn table(shape: &GustSpectrum, speed: f64) -> Vec<(f64, f64)> {
    let [low, high] = FREQUENCY_RANGE_HZ;
    let point = |i: usize| {
        let f = low * (high / low).powf(i as f64 / (SPECTRUM_POINTS - 1) as f64);
        (TAU * f, (shape.density)(f, speed) / TAU)
    };
    (0..SPECTRUM_POINTS).map(point).collect()
}

/// A curve of the user: density over frequency, in the square of the unit of length, as it is.
fn from_curve(model: &Model, named: &CurveReference) -> Result<Vec<(f64, f64)>, ClassError> {
    let points = |curve: &Curve| match curve.kind {
        CurveKind::FrequencySpectrum => Some(curve.points.clone()),
        CurveKind::PeriodSpectrum => {
            Some(curve.points.iter().rev().filter(|p| p.0 > 0.0).map(|(t, s)| (TAU / t, *s)).collect())
        }
        _ => None,
    };
    let found = model.curves.get(&Model::key(&named.kind)).and_then(points);
    found.ok_or_else(|| ClassError::new(format!("there is no gust spectrum {}", named.kind)).with_span(named.span))
}

/// The unit of the density of gusts, over rad/s.
pub const DENSITY: Dim = Dim::Derived { force: 0, length: 2, seconds: -1 };

#[cfg(test)]
mod tests {
    use super::*;

    /// The integral over frequencies from low to high (Hz), by Simpson's rule over the logarithm.
    fn integral(shape: &GustSpectrum, speed: f64, low: f64, high: f64) -> f64 {
        let parts = 40_000;
        let step = (high / low).ln() / f64::from(parts);
        let sum: f64 = (0..=parts)
            .map(|i| {
                let f = low * (step * f64::from(i)).exp();
                let weight = if i == 0 || i == parts { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
                weight * f * (shape.density)(f, speed)
            })
            .sum();
        sum * step / 3.0
    }

    #[test]
    fn wind_spectrum_integrates_to_its_variance() {
        for shape in GUST_SPECTRA {
            for speed in [8.0, 25.0, 45.0] {
                // what is left out: below 1e-9 Hz nothing, above 1e9 Hz a share of 1e-6, as all fall with the power -5/3
                let whole = integral(shape, speed, 1e-9, 1e9);
                let want = (shape.deviation)(speed).powi(2);
                assert!((whole / want - 1.0).abs() < 2e-5, "{} {speed} {whole} {want}", shape.name);
            }
        }
    }

    #[test]
    fn wind_spectra_match_published_values() {
        let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-6, "{got} {want}");
        // Froya at f = 0 and U = 20 m/s: 320 x 4
        near((froya::NPD.density)(1e-30, 20.0), 1280.0);
        // at x = 1 it is 2^(-5/1.404) of that
        near((froya::NPD.density)(2f64.powf(0.75) / 172.0, 20.0), 1280.0 * 2f64.powf(-5.0 / 1.404));
        // the branches of Ochi and Shin meet at x = 0.003 and x = 0.1 to the figures published: 420 x 0.1^-0.3 = 838.0
        for x in [0.003, 0.1] {
            let [a, b] = [x * 0.999_999, x * 1.000_001].map(|x| (ochi_shin::OCHI.density)(x * 2.0, 20.0));
            assert!((a / b - 1.0).abs() < 1e-3, "{a} {b}");
        }
        // Davenport's reduced spectrum f S has its peak at x = sqrt(3), at 12 / 4^(4/3) = 1.8899 k U^2
        let f = 3f64.sqrt() * 20.0 / 1200.0;
        near(
            f * (davenport::DAVENPORT.density)(f, 20.0),
            12.0 * 4f64.powf(-4.0 / 3.0) * drag_coefficient(20.0) * 400.0,
        );
        // [WU-1982] at 20 m/s: 2.1e-3
        near(drag_coefficient(20.0), 2.1e-3);
    }
}
