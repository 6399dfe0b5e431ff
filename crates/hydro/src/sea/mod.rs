//! The sea as wave components, and its kinematics.
//!
//! Elevation above the mean level: `zeta = ramp(t) * sum a cos(k (toward . (x, y)) - w t + phase)`; `toward` is the direction
//! of travel. Velocities and pressures follow by linear theory (Airy) from the components, or by Stokes' theory of a regular wave.

mod airy;
pub mod components;
mod deep_places;
pub mod density;
pub mod dispersion;
pub mod given;
mod grid;
pub mod phases;
pub mod simd_math;
pub mod spectra;
pub mod spreading;
pub mod stokes;
mod synthesis;

use nalgebra::Vector3;
use windlass_model::Stretching;

pub use airy::{Prepared, SeaAt};
pub use grid::{FilledGrid, PressureGrid};
pub use synthesis::EnvironmentSea;

/// One wave of the sea.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Component {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Wave number (1/m).
    pub number: f64,
    /// Amplitude (m).
    pub amplitude: f64,
    /// Unit vector of travel, global x and y.
    pub toward: [f64; 2],
    /// Phase (rad).
    pub phase: f64,
}

/// The water at a place and a time, without what it would be at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Kinematics {
    /// Velocity (m/s, global).
    pub velocity: Vector3<f64>,
    /// Its change with time at the place (m/s2, global).
    pub acceleration: Vector3<f64>,
    /// Dynamic pressure (Pa).
    pub pressure: f64,
    /// Height of the surface above the mean level (m) at this x and y.
    pub elevation: f64,
}

impl Kinematics {
    /// Nothing moves, under or above a surface of an elevation (m).
    pub fn still_water(elevation: f64) -> Self {
        Kinematics { velocity: Vector3::zeros(), acceleration: Vector3::zeros(), pressure: 0.0, elevation }
    }
}

/// The water a sea is on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Water {
    /// Depth with the tide (m); `None`: deep.
    pub depth: Option<f64>,
    /// Height of the mean surface (m, global z).
    pub level: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Density (kg/m3).
    pub density: f64,
}

/// A sea. Its components do not change: another sea is made anew.
#[derive(Clone, Debug)]
pub struct Sea {
    /// Its waves.
    pub components: Vec<Component>,
    /// Water depth with the tide (m); `None`: deep.
    pub depth: Option<f64>,
    /// Height of the mean surface (m, global z).
    pub level: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Density of the water (kg/m3).
    pub density: f64,
    /// Time over which the waves grow from nothing (s); 0: they are there at once.
    pub ramp: f64,
    /// Time at which they begin to grow (s): the first instant of a run.
    pub ramp_start: f64,
    /// What holds above the mean level; a Stokes wave goes up to its surface by itself.
    pub stretching: Stretching,
    /// Seed of the phases, where they are random.
    pub seed: Option<u64>,
    /// Time at which all components are in phase at x = y = 0 (s), where that makes the phases.
    pub reinforcement: Option<f64>,
    /// Whether its phases were given one by one.
    pub phases_given: bool,
    /// The seas it is made of, in the order of the components.
    pub trains: Vec<EnvironmentSea>,
    /// The Stokes wave it is. Its only component is then the Airy wave of the same height, frequency and wave number, for what
    /// is linear in the waves; elevation and kinematics are Stokes'.
    pub stokes: Option<stokes::Stokes>,
    lanes: airy::WaveLanes,
}

impl Sea {
    /// A sea of Airy waves, their phases taken as they are, that grows over `ramp` (s) from time 0 on; see [`Sea::new`] for that of an environment.
    pub fn airy(components: Vec<Component>, water: Water, ramp: f64, stretching: Stretching) -> Self {
        let lanes = airy::WaveLanes::new(&components, water.depth);
        let Water { depth, level, gravity, density } = water;
        Sea {
            components,
            depth,
            level,
            gravity,
            density,
            ramp,
            ramp_start: 0.0,
            stretching,
            seed: None,
            reinforcement: None,
            phases_given: false,
            trains: Vec::new(),
            stokes: None,
            lanes,
        }
    }

    /// The ramp at a time (s), from 0 to 1: `(1 - cos(pi t/T))/2` with t from the start of the ramp.
    pub fn factor(&self, time: f64) -> f64 {
        self.factor_and_rate(time).0
    }

    /// The ramp at a time (s), and its change with time (1/s).
    fn factor_and_rate(&self, time: f64) -> (f64, f64) {
        super::ramp::ramp(self.ramp, time - self.ramp_start)
    }

    /// The sea at one time (s), prepared for many places.
    pub fn at_time(&self, time: f64) -> SeaAt<'_> {
        SeaAt::new(self, time)
    }

    /// The same, in what was prepared of this sea for some time: nothing is found again where that is this one.
    pub fn reuse_at_time(&self, time: f64, prepared: Prepared) -> SeaAt<'_> {
        SeaAt::from_prepared(self, time, prepared)
    }

    /// Height of the surface above the mean level (m).
    pub fn elevation(&self, x: f64, y: f64, time: f64) -> f64 {
        self.at_time(time).elevation(x, y)
    }

    /// The water at a global place (m) and a time (s): nothing above the surface.
    pub fn kinematics(&self, at: Vector3<f64>, time: f64) -> Kinematics {
        self.at_time(time).kinematics(at)
    }
}

#[cfg(test)]
mod tests;
