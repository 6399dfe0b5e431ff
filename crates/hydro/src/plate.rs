//! `#PLATE`: a flat plate in wind or current, with drag along its normal alone: `1/2 rho Cd A |w.n| (w.n) n` at its centre.

use super::steady::Steady;
use super::stream::{LoadPlace, StreamLoad, StreamWrench};
use nalgebra::{Matrix6x3, Vector3};
use std::sync::Arc;
use windlass_base::pose::Six;

/// A plate at its centre.
#[derive(Debug)]
pub struct PlateLoad {
    steady: Arc<Steady>,
    position: LoadPlace,
    /// Area times drag coefficient (m2).
    area: f64,
    normal: Vector3<f64>,
}

impl PlateLoad {
    /// A plate of an area times drag coefficient (m2) and a unit normal in the body; its sense does not matter.
    pub fn new(steady: Arc<Steady>, position: LoadPlace, area: f64, normal: Vector3<f64>) -> Self {
        PlateLoad { steady, position, area, normal }
    }
}

impl StreamLoad for PlateLoad {
    fn placement(&self) -> (&LoadPlace, &Steady) {
        (&self.position, &self.steady)
    }

    fn push(&self, stream: Vector3<f64>) -> StreamWrench {
        let rho = self.steady.density(self.position.medium);
        let across = stream.dot(&self.normal);
        let force = self.normal * (0.5 * rho * self.area * across.abs() * across);
        let mut by_velocity = Matrix6x3::zeros();
        let change = self.normal * self.normal.transpose() * (rho * self.area * across.abs());
        by_velocity.fixed_rows_mut::<3>(0).copy_from(&change);
        StreamWrench { wrench: Six::new(force.x, force.y, force.z, 0.0, 0.0, 0.0), by_velocity }
    }
}
