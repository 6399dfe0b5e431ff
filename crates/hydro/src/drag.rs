//! `#DRAG`: linear drag of the current at a point, and the sum of the matrices a body has at its origin.

use super::steady::{Medium, Steady};
use super::stream::category;
use super::stream::{Immersion, LoadPlace, StreamWrench};
use super::{BodyLoad, BodyStep, Category, DynamicLoad, Load, cross};
use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3};
use std::sync::Arc;
use windlass_base::pose::Pose;
use windlass_model::ClassError;

/// A drag matrix at its point.
#[derive(Debug)]
pub struct LinearDrag {
    steady: Arc<Steady>,
    position: LoadPlace,
    by_velocity: Matrix6x3<f64>,
}

impl LinearDrag {
    /// A matrix in body axes (N s/m, N s, N m s) at a point of the body (m). The current at the depth of the point acts
    /// through its first three columns; the water does not turn.
    pub fn new(steady: Arc<Steady>, at: Vector3<f64>, matrix: &Matrix6<f64>) -> Self {
        let position = LoadPlace { at, medium: Medium::Water, immersion: Immersion::Whole };
        LinearDrag { steady, position, by_velocity: matrix.fixed_columns::<3>(0).into_owned() }
    }

    fn push(&self, stream: Vector3<f64>) -> StreamWrench {
        StreamWrench { wrench: self.by_velocity * stream, by_velocity: self.by_velocity }
    }
}

impl BodyLoad for LinearDrag {
    fn category(&self) -> Category {
        category(Medium::Water)
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        Ok(self.position.load(&self.steady, pose, |stream| self.push(stream)))
    }

    /// In the current of the time; the body's own motion is in the damping of the body.
    fn dynamic_load(&self, at: &BodyStep, _state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let stream = self.steady.streams_at_time(at.time).velocity(Medium::Water, at.pose.point(self.position.at).z);
        let load = self.position.load_in(&self.steady, at.pose, stream, |stream| self.push(stream));
        Ok(DynamicLoad::from(load))
    }
}

/// A 6x6 matrix (force and moment over motion) in the axes of a part, seen at the origin and in the axes of its body:
/// `axes` are those of the part in the body, `at` its point in the body (m).
pub fn at_origin(matrix: &Matrix6<f64>, axes: &Matrix3<f64>, at: Vector3<f64>) -> Matrix6<f64> {
    let turned = rotate_matrix(matrix, axes);
    // the point moves by t + d x r = t - cross(r) d, and its wrench has the moment r x F about the origin
    let mut motion = Matrix6::identity();
    motion.fixed_view_mut::<3, 3>(0, 3).copy_from(&-cross(at));
    motion.transpose() * turned * motion
}

/// A 6x6 matrix in other axes, at the same point.
pub fn rotate_matrix(matrix: &Matrix6<f64>, axes: &Matrix3<f64>) -> Matrix6<f64> {
    let mut both = Matrix6::zeros();
    both.fixed_view_mut::<3, 3>(0, 0).copy_from(axes);
    both.fixed_view_mut::<3, 3>(3, 3).copy_from(axes);
    both * matrix * both.transpose()
}
