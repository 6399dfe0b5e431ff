//! Wind or current on areas along the axes of a body: `#AREA`.
//!
//! Our reading: each value is an area times a shape coefficient along one axis of the body, and the force along it is
//! `1/2 rho A |w| w` with w the component and |w| the whole speed in body axes, on the point given. In a stream along one axis
//! this is the drag of that area alone.

use super::steady::{Medium, Steady};
use super::stream::{Immersion, LoadPlace, StreamLoad, StreamWrench};
use nalgebra::{Matrix6x3, Vector3};
use std::sync::Arc;
use windlass_base::pose::Six;

/// Areas in a stream, at a point of a body.
#[derive(Debug)]
pub struct AreaLoad {
    steady: Arc<Steady>,
    position: LoadPlace,
    /// Columns: directions of the areas in the body; their sizes times shape coefficients (m2).
    axes: nalgebra::Matrix3<f64>,
    areas: Vector3<f64>,
}

impl AreaLoad {
    /// Wind on areas along the axes of the body (m2, shape coefficient included) at a point of it (m), whatever its height.
    pub fn wind(steady: Arc<Steady>, areas: [f64; 3], at: Vector3<f64>) -> Self {
        AreaLoad::new(steady, LoadPlace { at, medium: Medium::Air, immersion: Immersion::Whole }, areas)
    }

    /// The same for current.
    pub fn current(steady: Arc<Steady>, areas: [f64; 3], at: Vector3<f64>) -> Self {
        AreaLoad::new(steady, LoadPlace { at, medium: Medium::Water, immersion: Immersion::Whole }, areas)
    }

    /// Areas along the axes of the body (m2, shape coefficients included), at a place.
    pub fn new(steady: Arc<Steady>, position: LoadPlace, areas: [f64; 3]) -> Self {
        AreaLoad { steady, position, axes: nalgebra::Matrix3::identity(), areas: areas.into() }
    }

    /// The same areas along other axes: the columns of a matrix, in the body.
    pub fn rotated_to_axes(self, axes: nalgebra::Matrix3<f64>) -> Self {
        AreaLoad { axes, ..self }
    }
}

impl StreamLoad for AreaLoad {
    fn placement(&self) -> (&LoadPlace, &Steady) {
        (&self.position, &self.steady)
    }

    fn push(&self, stream: Vector3<f64>) -> StreamWrench {
        let speed = stream.norm();
        if speed == 0.0 {
            return StreamWrench::zero();
        }
        let half = 0.5 * self.steady.density(self.position.medium);
        let tensor = self.axes * nalgebra::Matrix3::from_diagonal(&(self.areas * half)) * self.axes.transpose();
        let force = tensor * stream * speed;
        let mut by_velocity = Matrix6x3::zeros();
        let change = tensor * speed + (tensor * stream) * stream.transpose() / speed;
        by_velocity.fixed_rows_mut::<3>(0).copy_from(&change);
        StreamWrench { wrench: Six::new(force.x, force.y, force.z, 0.0, 0.0, 0.0), by_velocity }
    }
}
