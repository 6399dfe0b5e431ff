//! The sea of an environment: its components, with their phases and directions.

use super::components::{SpectrumBand, bands, bands_about};
use super::density::Spectrum;
use super::given::given_trains;
use super::spectra::ShapeParameter;
use super::stokes::{Stokes, breaks};
use super::{Component, Sea, Water, dispersion, phases, spreading};
use crate::spectrum;
use std::f64::consts::TAU;
use windlass_base::geometry::unit_vector;
use windlass_base::units::Dim;
use windlass_model::{self as model, ClassError, Division, Environment, Model, Phasing};

/// Components of each sea where none are asked for.
pub const USUAL_NUMBER: usize = 200;
/// What makes the phases where nothing is said: random, so that no crest is absurd, and the same in every run.
pub const USUAL_PHASING: Phasing = Phasing::Seeded(1);
/// Order of a STOKES wave where none is given.
pub const USUAL_ORDER: u8 = 5;

/// One sea of an environment, the first or the added one, with what its components came from.
#[derive(Clone, Debug)]
pub struct EnvironmentSea {
    /// Name of its spectrum, as written.
    pub name: String,
    /// Direction it comes from (rad).
    pub direction: f64,
    /// The parameters of its spectrum with their values (SI).
    pub shape: Vec<(&'static ShapeParameter, f64)>,
    /// Its spectrum; `None` for a regular wave.
    pub spectrum: Option<Spectrum>,
    /// The bands its components stand for; none for a regular wave.
    pub bands: Vec<SpectrumBand>,
    /// Whether its waves were given one by one, or as an elevation over time.
    pub is_given: bool,
    /// Its components in those of the sea.
    pub components: std::ops::Range<usize>,
}

impl Sea {
    /// The sea of an environment, a regular wave of height zero left out; `None` without waves.
    ///
    /// # Errors
    /// A sea that cannot be: no energy, a wave too steep, a spectrum without a formula, a Stokes wave beside another sea.
    pub fn new(model: &Model, env: &Environment) -> Result<Option<Self>, ClassError> {
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
            let spectrum = spectrum::build_spectrum(model, env, sea, env.components.and_then(|c| c.limits))?;
            let bands = match &spectrum {
                None => Vec::new(),
                Some(spectrum) => {
                    cut_into_bands(spectrum, env).map_err(|e| e.clone().with_span(e.span.unwrap_or(sea.position(0))))?
                }
            };
            if spectrum.is_none() {
                let (wave, nonlinear) = regular(env, sea, env.sea_phases.get(first).copied(), water)?;
                if nonlinear.is_some() && seas().count() > 1 {
                    return Err(ClassError::new("a STOKES wave cannot be added to another sea: it is not linear")
                        .with_span(sea.position(0))
                        .help("REGULAR is the linear wave"));
                }
                components.push(wave);
                stokes = nonlinear;
            }
            let directions =
                spreading::directions(bands.len(), sea.direction, env.spreading.unwrap_or(spreading::LONG_CRESTED));
            let angles = match env.sea_phases.get(first..first + bands.len()) {
                Some(given) if !given.is_empty() => given.to_vec(),
                _ => phases::phases(phasing, index, bands.iter().map(|b| b.frequency)),
            };
            for ((band, toward), phase) in bands.iter().zip(directions).zip(angles) {
                let number = dispersion::wave_number(band.frequency, water.depth, water.gravity)
                    .map_err(|e| e.with_span(sea.position(0)))?;
                let amplitude = (2.0 * band.energy).sqrt();
                components.push(Component { frequency: band.frequency, number, amplitude, toward, phase });
            }
            let shape = spectrum::shape_of(env, sea);
            let components = first..components.len();
            trains.push(EnvironmentSea {
                name: sea.spectrum.clone(),
                direction: sea.direction,
                shape,
                spectrum,
                bands,
                is_given: false,
                components,
            });
        }
        if !components.is_empty() {
            phases::one_each(env, &components)?;
        }
        for train in given_trains(model, env)? {
            if let Some(sea) = stokes.as_ref().and(env.sea.as_ref()) {
                return Err(ClassError::new("a STOKES wave cannot be added to other waves: it is not linear")
                    .with_span(sea.position(0))
                    .help("REGULAR is the linear wave"));
            }
            let first = components.len();
            for wave in &train.waves {
                let number = dispersion::wave_number(wave.frequency, water.depth, water.gravity)?;
                let (cos, sin) = unit_vector(wave.direction);
                let (frequency, amplitude, phase) = (wave.frequency, wave.amplitude, wave.phase);
                components.push(Component { frequency, number, amplitude, toward: [-cos, -sin], phase });
            }
            trains.push(EnvironmentSea {
                name: train.name,
                direction: train.direction,
                shape: Vec::new(),
                spectrum: None,
                bands: Vec::new(),
                is_given: true,
                components: first..components.len(),
            });
        }
        if components.is_empty() {
            return Ok(None);
        }
        let ramp = env.ramp.unwrap_or(model.defaults.ramp);
        let random = env.sea_phases.is_empty() && trains.iter().any(|t| t.spectrum.is_some());
        let (seed, reinforcement) = match phasing {
            Phasing::Seeded(seed) => (random.then_some(seed), None),
            Phasing::Reinforced(time) => (None, Some(time)),
        };
        let made = Sea::airy(components, water, ramp, env.stretching.unwrap_or_default());
        let phases_given = !env.sea_phases.is_empty();
        Ok(Some(Sea { ramp_start: env.run_start, seed, reinforcement, phases_given, trains, stokes, ..made }))
    }
}

/// The bands of a spectrum, as the environment says.
fn cut_into_bands(spectrum: &Spectrum, env: &Environment) -> Result<Vec<SpectrumBand>, ClassError> {
    let asked = env.components;
    if !env.sea_periods.is_empty() {
        return bands_about(spectrum, &env.sea_periods);
    }
    let number = asked.map_or(USUAL_NUMBER, |c| c.number);
    let division = asked.map_or(Division::EqualEnergy, |c| c.division);
    bands(spectrum, number, division, asked.is_some_and(|c| c.limits.is_some()))
}

/// A regular wave: its Airy component, and its Stokes wave if it is one.
fn regular(
    env: &Environment,
    sea: &model::SeaDefinition,
    given: Option<f64>,
    water: Water,
) -> Result<(Component, Option<Stokes>), ClassError> {
    if !(sea.period > 0.0 && sea.height.is_finite()) {
        return Err(ClassError::with_values(
            "there is no regular wave with a period of {}",
            &[(sea.period, Dim::Time)],
        )
        .with_span(sea.position(3)));
    }
    let frequency = TAU / sea.period;
    let (cos, sin) = unit_vector(sea.direction);
    let toward = [-cos, -sin];
    // a crest at the origin at t = 0, or at the time of reinforcement (MOSES), unless a phase is given
    let phase = match env.phasing {
        Some(Phasing::Reinforced(time)) => (frequency * time).rem_euclid(TAU),
        _ => given.unwrap_or(0.0),
    };
    let at = |error: ClassError| error.with_span(sea.position(2));
    let mut number =
        dispersion::wave_number(frequency, water.depth, water.gravity).map_err(|e| e.with_span(sea.position(3)))?;
    let mut stokes = None;
    if spectrum::is_stokes(sea) {
        let order = env.stokes.unwrap_or(USUAL_ORDER);
        let wave = Stokes::new(order, (sea.height, frequency), (toward, phase), water).map_err(at)?;
        number = wave.number;
        stokes = Some(wave);
    }
    breaks(sea.height, number, &water).map_err(at)?;
    Ok((Component { frequency, number, amplitude: 0.5 * sea.height, toward, phase }, stokes))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A model whose environment has a sea of this name, 4 m and 10 s, from 30 degrees.
    fn model(spectrum: &str) -> Model {
        let mut model = Model::default();
        let sea = |direction| model::SeaDefinition {
            spectrum: spectrum.into(),
            direction,
            height: 4.0,
            period: 10.0,
            shape: Vec::new(),
            positions: Default::default(),
        };
        model.environment = Environment { sea: Some(sea(std::f64::consts::FRAC_PI_6)), ..Environment::default() };
        model
    }

    fn build_sea(model: &Model) -> Sea {
        Sea::new(model, &model.environment).unwrap().unwrap()
    }

    #[test]
    fn all_components_are_in_phase_at_reinforcement_time() {
        let mut model = model("JONSWAP");
        model.environment.phasing = Some(Phasing::Reinforced(500.0));
        let sea = build_sea(&model);
        let highest: f64 = sea.components.iter().map(|c| c.amplitude).sum();
        assert!((sea.elevation(0.0, 0.0, 500.0) / highest - 1.0).abs() < 1e-12);
        assert_eq!((sea.reinforcement, sea.seed), (Some(500.0), None));
    }

    #[test]
    fn default_sea_is_reproducible_with_realistic_crest() {
        let model = model("ISSC");
        let (sea, again) = (build_sea(&model), build_sea(&model));
        assert_eq!((sea.components.len(), sea.seed), (USUAL_NUMBER, Some(1)));
        assert_eq!(sea.components, again.components);
        let record: Vec<f64> = (0..21_600).map(|i| sea.elevation(0.0, 0.0, 0.5 * f64::from(i))).collect();
        let deviation = (record.iter().map(|z| z * z).sum::<f64>() / 21_600.0).sqrt();
        // 3 h of a narrow sea: about 1,300 waves; the deviation is Hs/4 to some 3 %, the highest crest 3.8 of it, give or take 0.5
        assert!((deviation - 1.0).abs() < 0.03, "{deviation}");
        let crest = record.iter().copied().fold(0.0, f64::max);
        assert!((2.9..5.2).contains(&crest), "{crest}");
    }

    #[test]
    fn waves_propagate_away_from_their_source_direction() {
        let sea = build_sea(&model("REGULAR"));
        let [wave] = sea.components[..] else { panic!("one wave") };
        assert_eq!(wave.amplitude, 2.0);
        // the crest at the origin at t = 0 is after t at c t along the direction of travel, 210 degrees
        let (time, speed) = (3.0, wave.frequency / wave.number);
        let (x, y) = (-speed * time * 0.75f64.sqrt(), -speed * time * 0.5);
        assert!((sea.elevation(x, y, time) - 2.0).abs() < 1e-12);
    }

    #[test]
    fn added_sea_adds_energy_with_independent_phases() {
        let mut model = model("ISSC");
        model.environment.added_sea = model.environment.sea.clone();
        let sea = build_sea(&model);
        let energy: f64 = sea.components.iter().map(|c| 0.5 * c.amplitude * c.amplitude).sum();
        assert!((energy - 2.0).abs() < 1e-9);
        assert_ne!(sea.components[0].phase, sea.components[USUAL_NUMBER].phase);
        model.environment.added_sea.as_mut().unwrap().spectrum = "STOKES".into();
        assert!(Sea::new(&model, &model.environment).is_err());
    }

    #[test]
    fn ramped_wave_equals_wave_times_its_factor() {
        let mut model = model("STOKES");
        model.environment.ramp = Some(40.0);
        let sea = build_sea(&model);
        let stokes = sea.stokes.unwrap();
        let time = 13.0;
        assert!((sea.elevation(5.0, 1.0, time) - sea.factor(time) * stokes.elevation(5.0, 1.0, time)).abs() < 1e-12);
        let at = nalgebra::Vector3::new(5.0, 1.0, -3.0);
        let v = |t: f64| sea.kinematics(at, t).velocity;
        let rate = (v(time + 1e-4) - v(time - 1e-4)) / 2e-4;
        assert!((rate - sea.kinematics(at, time).acceleration).norm() < 1e-7);
    }
}
