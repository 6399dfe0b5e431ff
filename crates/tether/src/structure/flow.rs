//! The water around structure and tethers: waves and a steady current.

use super::wave::DeepWave;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_hydro::current::CurrentField;
use windlass_hydro::sea::{Kinematics, Sea, SeaAt};
use windlass_model::ClassError;

/// The waves.
#[derive(Clone, Debug)]
pub enum FlowWaves {
    /// Still water.
    None,
    /// A regular wave in deep water.
    Deep(DeepWave),
    /// A sea: components of a spectrum, or a regular wave in any depth.
    Sea(Arc<Sea>),
}

/// Water, with what moves in it.
#[derive(Clone, Debug)]
pub struct WaterFlow {
    /// Density (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Height of the mean level, tide in it (m, global z).
    pub level: f64,
    /// The waves.
    pub waves: FlowWaves,
    /// The current.
    pub current: CurrentField,
}

impl WaterFlow {
    /// Still water of a density (kg/m3) under a gravity (m/s2), its surface at z = 0.
    ///
    /// # Errors
    /// A density or gravity that is no positive number.
    pub fn still_water(density: f64, gravity: f64) -> Result<Self, ClassError> {
        let sound = |value: f64| value.is_finite() && value > 0.0;
        if !(sound(density) && sound(gravity)) {
            return Err(ClassError::new("the water needs a density and a gravity greater than zero"));
        }
        Ok(WaterFlow { density, gravity, level: 0.0, waves: FlowWaves::None, current: CurrentField::default() })
    }

    /// The same with waves.
    pub fn with_waves(self, waves: FlowWaves) -> Self {
        WaterFlow { waves, ..self }
    }

    /// The water at a time (s), ready to be asked at many places.
    pub fn at_time(&self, time: f64) -> FlowAt<'_> {
        let sea = match &self.waves {
            FlowWaves::Sea(sea) => Some(sea.at_time(time)),
            _ => None,
        };
        FlowAt { flow: self, time, sea }
    }
}

/// The water at one time.
#[derive(Clone, Debug)]
pub struct FlowAt<'a> {
    flow: &'a WaterFlow,
    time: f64,
    sea: Option<SeaAt<'a>>,
}

impl FlowAt<'_> {
    /// Goes to another time (s), without another allocation.
    pub fn move_to(&mut self, time: f64) {
        self.time = time;
        if let Some(sea) = &mut self.sea {
            sea.move_to(time);
        }
    }

    /// The water it is.
    pub fn flow(&self) -> &WaterFlow {
        self.flow
    }

    /// The time (s).
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Height of the surface (m, global z).
    pub fn surface(&self, x: f64, y: f64) -> f64 {
        let waves = match (&self.flow.waves, &self.sea) {
            (FlowWaves::Deep(wave), _) => wave.elevation(x, y, self.time),
            (_, Some(sea)) => sea.elevation(x, y),
            _ => 0.0,
        };
        self.flow.level + waves
    }

    /// The water of the waves and of the current at a place (m, global), whether that is under the surface or not.
    pub fn kinematics(&self, at: Vector3<f64>) -> Kinematics {
        let flow = self.flow;
        let mut found = match (&flow.waves, &self.sea) {
            (FlowWaves::Deep(wave), _) => {
                wave.kinematics(at, at.z - flow.level, self.time, [flow.density, flow.gravity])
            }
            (_, Some(sea)) => sea.kinematics(at),
            _ => Kinematics::still_water(0.0),
        };
        if !flow.current.is_none() {
            found.velocity += flow.current.at_depth(flow.level - at.z).0;
        }
        found
    }

    /// Hydrostatic pressure of the water at rest at a height (m, global z); none above the mean level (Pa).
    pub fn hydrostatic(&self, z: f64) -> f64 {
        self.flow.density * self.flow.gravity * (self.flow.level - z).max(0.0)
    }
}
