//! The sea of an environment: its components, with their phases and directions.

use super::components::{Band, bands, bands_about};
use super::density::Spectrum;
use super::stokes::{Stokes, breaks};
use super::{Component, Sea, Water, dispersion, phases, spreading};
use crate::hydro::spectrum;
use crate::language::units::Dim;
use crate::model::{self, ClassError, Division, Environment, Model, Phasing};
use std::f64::consts::TAU;

/// Components of each sea where none are asked for.
pub const USUAL_NUMBER: usize = 200;
/// What makes the phases where nothing is said: random, so that no crest is absurd, and the same in every run.
pub const USUAL_PHASING: Phasing = Phasing::Seeded(1);
/// Order of a STOKES wave where none is given.
pub const USUAL_ORDER: u8 = 5;

/// One sea of an environment, the first or the added one, with what its components came from.
#[derive(Clone, Debug, PartialEq)]
pub struct Train {
    /// Name of its spectrum, as written.
    pub name: String,
    /// Direction it comes from (rad).
    pub direction: f64,
    /// Peakedness, of spectra that have one.
    pub gamma: Option<f64>,
    /// Its spectrum; `None` for a regular wave.
    pub spectrum: Option<Spectrum>,
    /// The bands its components stand for; none for a regular wave.
    pub bands: Vec<Band>,
    /// Its components in those of the sea.
    pub components: std::ops::Range<usize>,
}

impl Sea {
    /// The sea of an environment, a regular wave of height zero left out; `None` without waves.
    ///
    /// # Errors
    /// A sea that cannot be: no energy, a wave too steep, a spectrum without a formula, a Stokes wave beside another sea.
    pub fn of(model: &Model, env: &Environment) -> Result<Option<Self>, ClassError> {
        let around = model.surroundings_in(env);
        let water = Water {
            depth: around.depth.map(|d| d + around.tide),
            level: around.tide,
            gravity: around.gravity,
            density: around.water_density,
        };
        let phasing = env.phasing.unwrap_or(USUAL_PHASING);
        let (mut components, mut trains, mut stokes) = (Vec::new(), Vec::new(), None);
        let seas =
            || [&env.sea, &env.added_sea].into_iter().flatten().filter(|s| !spectrum::is_regular(s) || s.height > 0.0);
        for (index, sea) in (0u64..).zip(seas()) {
            let first = components.len();
            let spectrum = spectrum::of(model, env, sea, env.components.and_then(|c| c.limits))?;
            let bands = match &spectrum {
                None => Vec::new(),
                Some(spectrum) => cut(spectrum, env).map_err(|e| e.clone().at(e.span.unwrap_or(sea.place(0))))?,
            };
            if spectrum.is_none() {
                let (wave, nonlinear) = regular(env, sea, water)?;
                if nonlinear.is_some() && seas().count() > 1 {
                    return Err(ClassError::new("a STOKES wave cannot be added to another sea: it is not linear")
                        .at(sea.place(0))
                        .help("REGULAR is the linear wave"));
                }
                components.push(wave);
                stokes = nonlinear;
            }
            let directions =
                spreading::directions(bands.len(), sea.direction, env.spreading.unwrap_or(spreading::LONG_CRESTED));
            let angles = phases::phases(phasing, index, bands.iter().map(|b| b.frequency));
            for ((band, toward), phase) in bands.iter().zip(directions).zip(angles) {
                let number = dispersion::wave_number(band.frequency, water.depth, water.gravity)
                    .map_err(|e| e.at(sea.place(0)))?;
                let amplitude = (2.0 * band.energy).sqrt();
                components.push(Component { frequency: band.frequency, number, amplitude, toward, phase });
            }
            let gamma = spectrum::gamma_of(env, sea);
            let components = first..components.len();
            trains.push(Train {
                name: sea.spectrum.clone(),
                direction: sea.direction,
                gamma,
                spectrum,
                bands,
                components,
            });
        }
        if components.is_empty() {
            return Ok(None);
        }
        let ramp = env.ramp.unwrap_or(model.defaults.ramp);
        let random = trains.iter().any(|t| t.spectrum.is_some());
        let (seed, reinforcement) = match phasing {
            Phasing::Seeded(seed) => (random.then_some(seed), None),
            Phasing::Reinforced(time) => (None, Some(time)),
        };
        let made = Sea::airy(components, water, ramp, env.stretching.unwrap_or_default());
        Ok(Some(Sea { seed, reinforcement, trains, stokes, ..made }))
    }
}

/// The bands of a spectrum, as the environment says.
fn cut(spectrum: &Spectrum, env: &Environment) -> Result<Vec<Band>, ClassError> {
    let asked = env.components;
    if !env.sea_periods.is_empty() {
        return bands_about(spectrum, &env.sea_periods);
    }
    let number = asked.map_or(USUAL_NUMBER, |c| c.number);
    let division = asked.map_or(Division::EqualEnergy, |c| c.division);
    bands(spectrum, number, division, asked.is_some_and(|c| c.limits.is_some()))
}

/// A regular wave: its Airy component, and its Stokes wave if it is one.
fn regular(env: &Environment, sea: &model::Sea, water: Water) -> Result<(Component, Option<Stokes>), ClassError> {
    if !(sea.period > 0.0 && sea.height.is_finite()) {
        return Err(
            ClassError::of("there is no regular wave with a period of {}", &[(sea.period, Dim::Time)]).at(sea.place(3))
        );
    }
    let frequency = TAU / sea.period;
    let (cos, sin) = model::unit_vector(sea.direction);
    let toward = [-cos, -sin];
    // a crest at the origin at t = 0, or at the time of reinforcement (MOSES)
    let phase = match env.phasing {
        Some(Phasing::Reinforced(time)) => (frequency * time).rem_euclid(TAU),
        _ => 0.0,
    };
    let at = |error: ClassError| error.at(sea.place(2));
    let mut number = dispersion::wave_number(frequency, water.depth, water.gravity).map_err(|e| e.at(sea.place(3)))?;
    let mut stokes = None;
    if sea.spectrum.eq_ignore_ascii_case("STOKES") {
        let order = env.stokes.unwrap_or(USUAL_ORDER);
        let wave = Stokes::of(order, (sea.height, frequency), (toward, phase), water).map_err(at)?;
        number = wave.number;
        stokes = Some(wave);
    }
    breaks(sea.height, number, &water).map_err(at)?;
    Ok((Component { frequency, number, amplitude: 0.5 * sea.height, toward, phase }, stokes))
}
