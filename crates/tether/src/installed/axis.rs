//! The straight axis of an installed tether (TLA): from its lower end to its attachment.

use nalgebra::Vector3;
use windlass_base::pose::{Pose, Six};

/// The end at the structure: place, velocity and what turns with it.
#[derive(Clone, Copy, Debug, Default)]
pub struct AxisAttachment {
    /// Where it is (m, global).
    pub at: Vector3<f64>,
    /// Its velocity (m/s).
    pub velocity: Vector3<f64>,
    /// Its acceleration (m/s2).
    pub acceleration: Vector3<f64>,
    /// Rotation of the structure (rad/s), and how it changes (rad/s2).
    pub spin: [Vector3<f64>; 2],
    /// The axis of the structure that is vertical when it is upright.
    pub upright: Vector3<f64>,
}

impl AxisAttachment {
    /// A point of a structure, `local` from its centre of gravity (m).
    pub fn new(local: Vector3<f64>, pose: &Pose, velocity: &Six) -> Self {
        let spin = Vector3::new(velocity[3], velocity[4], velocity[5]);
        let arm = pose.axes * local;
        AxisAttachment {
            at: pose.origin + arm,
            velocity: Vector3::new(velocity[0], velocity[1], velocity[2]) + spin.cross(&arm),
            acceleration: Vector3::zeros(),
            spin: [spin, Vector3::zeros()],
            upright: pose.axes * Vector3::z(),
        }
    }

    /// The same with the acceleration of the structure; `arm` is from its centre of gravity (m, global).
    pub fn add_acceleration(&mut self, arm: Vector3<f64>, acceleration: &Six) {
        let turn = Vector3::new(acceleration[3], acceleration[4], acceleration[5]);
        let [spin, _] = self.spin;
        self.acceleration = Vector3::new(acceleration[0], acceleration[1], acceleration[2])
            + turn.cross(&arm)
            + spin.cross(&spin.cross(&arm));
        self.spin[1] = turn;
    }
}

/// The axis with its cross directions.
#[derive(Clone, Copy, Debug)]
pub struct TetherAxis {
    /// Distance from the anchor to the attachment (m).
    pub chord: f64,
    /// Unit vector from the anchor to the attachment.
    pub along: Vector3<f64>,
    /// Unit vectors across: the global X and Y turned the shortest way with the axis from the vertical.
    pub across: [Vector3<f64>; 2],
    /// Slope of the axis against the vertical in both planes (rad): the rotation that turns it there.
    pub tilt: [f64; 2],
}

impl Default for TetherAxis {
    fn default() -> Self {
        TetherAxis { chord: 1.0, along: Vector3::z(), across: [Vector3::x(), Vector3::y()], tilt: [0.0; 2] }
    }
}

impl TetherAxis {
    /// That from an anchor to an attachment (m, global); `None` where they are at one place or the attachment is straight below.
    pub fn new(anchor: Vector3<f64>, attachment: Vector3<f64>) -> Option<Self> {
        let chord = (attachment - anchor).norm();
        let along = (attachment - anchor).try_normalize(0.0)?;
        let [x, y, z] = [along.x, along.y, along.z];
        // the shortest turn of Z to the axis (Rodrigues), for X and for Y
        let share = 1.0 / (1.0 + z);
        if !share.is_finite() {
            return None;
        }
        let across = [
            Vector3::new(1.0 - x * x * share, -x * y * share, -x),
            Vector3::new(-x * y * share, 1.0 - y * y * share, -y),
        ];
        Some(TetherAxis { chord, along, across, tilt: tilt(along) })
    }

    /// Parts of a vector across the axis, in the vector's unit.
    pub fn parts(&self, v: Vector3<f64>) -> [f64; 2] {
        self.across.map(|u| u.dot(&v))
    }
}

/// Slope of a direction against the vertical in the planes of X and Y (rad).
pub fn tilt(direction: Vector3<f64>) -> [f64; 2] {
    let sin = direction.x.hypot(direction.y);
    let over = if sin > 1e-9 { sin.atan2(direction.z) / sin } else { 1.0 };
    [direction.x * over, direction.y * over]
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn transverse_directions_match_rotation() {
        for end in [Vector3::new(3.0, -4.0, 12.0), Vector3::new(0.0, 0.0, 2.0), Vector3::new(-5.0, 0.1, 0.3)] {
            let axis = TetherAxis::new(Vector3::zeros(), end).unwrap();
            let [x, y] = axis.across;
            assert!((x.cross(&y) - axis.along).norm() < 1e-15 && (x.norm() - 1.0).abs() < 1e-15);
            let [rx, ry] = [-axis.tilt[1], axis.tilt[0]];
            let turn = nalgebra::Rotation3::new(Vector3::new(rx, ry, 0.0));
            assert!((turn * Vector3::x() - x).norm() < 1e-15 && (turn * Vector3::z() - axis.along).norm() < 1e-15);
        }
        assert!(TetherAxis::new(Vector3::zeros(), -Vector3::z()).is_none());
    }
}
