//! `#TABLE`: force and moment of wind or current by the direction it comes from, over the square of its speed.
//!
//! Direction and speed are those of the stream in the x-y plane of the body: the direction it comes from is counted from
//! body x toward body y, so that 180 is a stream from ahead for a vessel with x aft.

use super::heading::ByHeading;
use super::steady::Steady;
use super::stream::{LoadPlace, StreamLoad, StreamWrench};
use nalgebra::{Matrix6x3, Vector3};
use std::sync::Arc;

/// A table at its point.
#[derive(Debug)]
pub struct CoefficientLoad {
    steady: Arc<Steady>,
    position: LoadPlace,
    table: ByHeading,
}

impl CoefficientLoad {
    /// Coefficients (N s2/m2 and N s2/m about the point, body axes) by heading, at a place.
    pub fn new(steady: Arc<Steady>, position: LoadPlace, table: ByHeading) -> Self {
        CoefficientLoad { steady, position, table }
    }
}

impl StreamLoad for CoefficientLoad {
    fn placement(&self) -> (&LoadPlace, &Steady) {
        (&self.position, &self.steady)
    }

    fn push(&self, stream: Vector3<f64>) -> StreamWrench {
        let square = stream.x * stream.x + stream.y * stream.y;
        if square == 0.0 {
            return StreamWrench::zero();
        }
        let (value, slope) = self.table.interpolate((-stream.y).atan2(-stream.x));
        // speed^2 d(heading) = x dy - y dx, so that the change has no singularity
        let turned = nalgebra::RowVector3::new(-stream.y, stream.x, 0.0);
        let grown = nalgebra::RowVector3::new(2.0 * stream.x, 2.0 * stream.y, 0.0);
        let by_velocity: Matrix6x3<f64> = slope * turned + value * grown;
        StreamWrench { wrench: value * square, by_velocity }
    }
}
