//! Where a rigid body stands while an engine moves it: its origin and its axes, exact for any rotation.

use crate::geometry::{Place, Position};
use nalgebra::{Matrix3, Rotation3, Vector3, Vector6};

/// A force (N) and a moment (N m) about a stated point, or a translation (m) and a rotation vector (rad), global axes.
pub type Six = Vector6<f64>;

/// An origin (m, global) and axes: columns are the body axes in the global system.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// The origin (m, global).
    pub origin: Vector3<f64>,
    /// From body to global axes.
    pub axes: Matrix3<f64>,
}

impl Default for Pose {
    fn default() -> Self {
        Pose { origin: Vector3::zeros(), axes: Matrix3::identity() }
    }
}

impl Pose {
    /// The pose of a place.
    pub fn from_place(position: &Place) -> Self {
        Pose { origin: position.shift.into(), axes: *position.rotation().matrix() }
    }

    /// A pose with global axes at a position.
    pub fn from_position(position: Position) -> Self {
        Pose { origin: position.into(), axes: Matrix3::identity() }
    }

    /// Body coordinates (m) in the global system.
    pub fn point(&self, at: Vector3<f64>) -> Vector3<f64> {
        self.origin + self.axes * at
    }

    /// Global coordinates (m) in the body's system.
    pub fn local(&self, at: Vector3<f64>) -> Vector3<f64> {
        self.axes.transpose() * (at - self.origin)
    }

    /// The pose behind a small motion: a translation, and a rotation about the origin by its rotation vector, both in
    /// global axes. Exact for any size of the rotation.
    pub fn after_motion(&self, motion: &Six) -> Self {
        let turn = Rotation3::new(Vector3::new(motion[3], motion[4], motion[5]));
        let axes = Rotation3::from_matrix_unchecked(turn.matrix() * self.axes);
        // rounding of many small turns must not add up to a matrix that stretches
        let axes = orthonormal(axes.matrix());
        Pose { origin: self.origin + Vector3::new(motion[0], motion[1], motion[2]), axes }
    }

    /// The place with these axes: roll, pitch, yaw with pitch in [-90, 90] degrees and the yaw and roll nearest to those
    /// of `near`; a pose that is that of `near` gives `near` itself.
    pub fn position(&self, near: &Place) -> Place {
        if Pose::from_place(near) == *self {
            return *near;
        }
        let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(self.axes).euler_angles();
        let whole = |angle: f64, near: f64| {
            let turns = ((near - angle) / std::f64::consts::TAU).round();
            angle + turns * std::f64::consts::TAU
        };
        let [near_roll, _, near_yaw] = near.turn;
        Place { shift: self.origin.into(), turn: [whole(roll, near_roll), pitch, whole(yaw, near_yaw)] }
    }
}

/// The nearest matrix of unit columns at right angles, of one that is so but for rounding.
fn orthonormal(m: &Matrix3<f64>) -> Matrix3<f64> {
    let x = m.column(0).normalize();
    let y = (m.column(1) - x * x.dot(&m.column(1))).normalize();
    Matrix3::from_columns(&[x, y, x.cross(&y)])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn point_transforms_to_pose_and_back() {
        for step in 0..100 {
            let [roll, pitch, yaw] = [0.37, 0.011, -1.13].map(|rate| rate * f64::from(step));
            let position = Place::new([1.0, 2.0, 3.0, roll, pitch, yaw]);
            let turned = Pose::from_place(&position).after_motion(&Six::new(0.0, 0.0, 0.0, 1e-9, 0.0, 0.0));
            let back = turned.position(&position);
            for (a, b) in back.turn.iter().zip(position.turn) {
                assert!((a - b).abs() < 1e-7, "{back:?} {position:?}");
            }
            assert_eq!(Pose::from_place(&position).position(&position), position);
        }
    }

    #[test]
    fn rotation_acts_about_global_axes() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let pose = Pose::from_place(&Place::new([0.0, 0.0, 0.0, 0.0, 0.0, quarter]));
        let turned = pose.after_motion(&Six::new(0.0, 0.0, 5.0, quarter, 0.0, 0.0));
        // body x points along global y; a quarter turn about global x takes it to global z
        assert!((turned.point(Vector3::x()) - Vector3::new(0.0, 0.0, 6.0)).norm() < 1e-15);
        assert!((turned.local(Vector3::new(0.0, 0.0, 6.0)) - Vector3::x()).norm() < 1e-15);
    }
}
