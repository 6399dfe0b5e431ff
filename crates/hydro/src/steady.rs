//! What is steady around a body: water, wind, current, and the mean of the waves.

use super::current::CurrentField;
use super::sea::given::given_trains;
use super::sea::spreading;
use super::spectrum::{WaveEnergies, is_regular};
use super::variation::{StreamVariation, Variation};
use super::wind::WindField;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_model::{ClassError, Environment, Model, Surroundings};

/// Half the height over which what is decided by the height of a point passes from current to wind (m). The sources say
/// only "above" and "below"; a jump would keep an equilibrium near it from being found.
pub const SURFACE_TRANSITION_M: f64 = 0.25;

/// Directions that a short-crested sea at rest is made of.
const SPREAD_PARTS: usize = 36;

/// Air or water.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Medium {
    /// Air, with the wind.
    Air,
    /// Water, with the current.
    Water,
}

/// What surrounds bodies at rest, and how wind and current vary about it for bodies under way.
#[derive(Clone, Debug)]
pub struct Steady {
    /// Densities, depth, tide, gravity.
    pub around: Surroundings,
    /// Wind.
    pub wind: Option<WindField>,
    /// Current.
    pub current: CurrentField,
    /// The seas, each with the horizontal direction it travels toward; a short-crested one in parts.
    pub waves: Vec<(Vector3<f64>, Arc<WaveEnergies>)>,
    /// What varies in time, for bodies under way.
    pub variation: Option<Arc<Variation>>,
}

/// Wind and current at one time.
#[derive(Clone, Copy, Debug)]
pub struct Streams<'a> {
    steady: &'a Steady,
    instant: StreamVariation,
}

impl Streams<'_> {
    /// Velocity (m/s, global) of air or water at a global height (m), and its change with the height (1/s).
    ///
    /// The wind of a history has the profile of the mean; a gust is the same at all heights and places.
    pub fn velocity(&self, medium: Medium, z: f64) -> (Vector3<f64>, Vector3<f64>) {
        let (tide, now) = (self.steady.around.tide, &self.instant);
        match (medium, &self.steady.wind) {
            (Medium::Air, Some(wind)) => {
                let mut wind = *wind;
                wind.speed += now.wind;
                let (speed, change) = wind.speed(z - tide);
                (wind.toward * (speed + now.gust), wind.toward * change)
            }
            (Medium::Air, None) => (Vector3::zeros(), Vector3::zeros()),
            (Medium::Water, _) => {
                let (velocity, change) = self.steady.current.at_depth(tide - z);
                (velocity * now.current, -change * now.current)
            }
        }
    }
}

impl Steady {
    /// That of the environment in force.
    ///
    /// # Errors
    /// An environment that cannot be computed.
    pub fn new(model: &Model) -> Result<Self, ClassError> {
        Steady::from_environment(model, &model.environment)
    }

    /// That of an environment.
    ///
    /// # Errors
    /// An environment that cannot be computed: a spectrum or a wind without a formula, a curve that is not there.
    pub fn from_environment(model: &Model, env: &Environment) -> Result<Self, ClassError> {
        let around = model.surroundings_in(env);
        let bottom = around.depth.map(|d| d + around.tide);
        let mut waves = Vec::new();
        for sea in [&env.sea, &env.added_sea].into_iter().flatten().filter(|s| s.height > 0.0) {
            let whole = WaveEnergies::new(model, env, sea)?;
            // a regular wave has one direction
            let exponent = env.spreading.filter(|_| !is_regular(sea)).unwrap_or(spreading::LONG_CRESTED);
            let parts = spreading::parts(SPREAD_PARTS, sea.direction, exponent).into_iter();
            waves.extend(parts.map(|([x, y], share)| (Vector3::new(x, y, 0.0), Arc::new(whole.scaled(share)))));
        }
        for train in given_trains(model, env)? {
            for (direction, energies) in WaveEnergies::by_direction(&train.waves) {
                let (cos, sin) = windlass_base::geometry::unit_vector(direction);
                waves.push((Vector3::new(-cos, -sin, 0.0), Arc::new(energies)));
            }
        }
        Ok(Steady {
            around,
            wind: WindField::from_environment(env)?,
            current: CurrentField::new(model, env, bottom)?,
            waves,
            variation: None,
        })
    }

    /// The same without its seas: what wind and current need.
    ///
    /// # Errors
    /// As [`Steady::from_environment`], but for the seas.
    pub fn streams(model: &Model, env: &Environment) -> Result<Self, ClassError> {
        Steady::from_environment(model, &env.clone().without_sea())
    }

    /// With what varies in time: gusts, and histories of wind and current.
    ///
    /// # Errors
    /// As [`Variation::new`].
    pub fn under_way(self, model: &Model, env: &Environment) -> Result<Self, ClassError> {
        let variation = Variation::new(model, env)?.map(Arc::new);
        Ok(Steady { variation, ..self })
    }

    /// Mean velocity (m/s, global) of air or water at a global height (m), and its change with the height (1/s).
    pub fn velocity(&self, medium: Medium, z: f64) -> (Vector3<f64>, Vector3<f64>) {
        self.mean().velocity(medium, z)
    }

    /// Wind and current without what varies in time.
    pub fn mean(&self) -> Streams<'_> {
        Streams { steady: self, instant: StreamVariation::default() }
    }

    /// Wind and current at a time (s).
    pub fn streams_at_time(&self, time: f64) -> Streams<'_> {
        let instant = self.variation.as_ref().map_or_else(StreamVariation::default, |v| v.sample(time));
        Streams { steady: self, instant }
    }

    /// Density of air or water (kg/m3).
    pub fn density(&self, medium: Medium) -> f64 {
        match medium {
            Medium::Air => self.around.air_density,
            Medium::Water => self.around.water_density,
        }
    }

    /// Whether nothing moves in it.
    pub fn is_still(&self, medium: Medium) -> bool {
        match medium {
            Medium::Air => self.wind.is_none_or(|w| w.speed == 0.0),
            Medium::Water => self.current.is_none(),
        }
    }

    /// How much a point at a global height (m) is in air or in water, from 0 to 1, and the change with the height (1/m):
    /// a smooth passage of half a metre about the surface.
    pub fn share(&self, medium: Medium, z: f64) -> (f64, f64) {
        let s = ((z - self.around.tide) / SURFACE_TRANSITION_M).clamp(-1.0, 1.0);
        let (air, change) = (0.5 + 0.75 * s - 0.25 * s * s * s, 0.75 * (1.0 - s * s) / SURFACE_TRANSITION_M);
        match medium {
            Medium::Air => (air, change),
            Medium::Water => (1.0 - air, -change),
        }
    }
}
