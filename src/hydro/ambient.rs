//! What a line feels all along itself: waves, current, wind and the bottom.

use super::sea::Sea;
use super::steady::{Medium, Steady};
use crate::model::{Ambient, ClassError, Flow, Model};
use nalgebra::Vector3;
use std::sync::Arc;

/// Water, wind and bottom of the environment in force.
#[derive(Debug)]
struct Around {
    steady: Steady,
    sea: Option<Arc<Sea>>,
}

/// Water, wind and bottom of the environment in force, with the waves of a sea.
///
/// # Errors
/// An environment that cannot be computed.
pub fn ambient(model: &Model, sea: Option<&Arc<Sea>>) -> Result<Arc<dyn Ambient>, ClassError> {
    let env = &model.environment;
    let steady = Steady::streams(model, env)?.under_way(model, env)?;
    Ok(Arc::new(Around { steady, sea: sea.cloned() }))
}

impl Ambient for Around {
    fn flow(&self, time: f64, places: &[Vector3<f64>], out: &mut [Flow]) {
        let streams = self.steady.at(time);
        let sea = self.sea.as_ref().map(|sea| sea.at(time));
        let level = self.steady.around.tide;
        for (place, out) in places.iter().zip(out) {
            *out = Flow::still(level);
            if !self.steady.still(Medium::Water) {
                out.velocity = streams.velocity(Medium::Water, place.z).0;
            }
            if !self.steady.still(Medium::Air) {
                out.wind = streams.velocity(Medium::Air, place.z).0;
            }
            if let Some(sea) = &sea {
                let found = sea.kinematics(*place);
                out.velocity += found.velocity;
                out.acceleration += found.acceleration;
                out.surface += found.elevation;
            }
        }
    }

    fn mean(&self, places: &[Vector3<f64>], out: &mut [Flow]) {
        let streams = self.steady.mean();
        for (place, out) in places.iter().zip(out) {
            *out = Flow::still(self.steady.around.tide);
            out.velocity = streams.velocity(Medium::Water, place.z).0;
            out.wind = streams.velocity(Medium::Air, place.z).0;
        }
    }

    fn bottom(&self, _: f64, _: f64) -> Option<(f64, [f64; 2])> {
        self.steady.around.depth.map(|depth| (-depth, [0.0; 2]))
    }
}
