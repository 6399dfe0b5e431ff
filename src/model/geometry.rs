//! Positions and the placing of bodies and parts.
//!
//! Source: reference/model.md, "Bodies, parts, axes": yaw about Z, then pitch about Y, then roll about X, each about the
//! axes already turned.

use nalgebra::{Rotation3, Vector3};

/// Coordinates x, y, z (m).
pub type Position = [f64; 3];

/// A translation (m) and three rotations (rad): where a part stands in its body, or a body in the global system.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Place {
    /// Translation of the origin (m).
    pub shift: Position,
    /// Roll about X, pitch about Y, yaw about Z (rad).
    pub turn: [f64; 3],
}

impl Place {
    /// From x, y, z, roll, pitch, yaw.
    pub fn new(values: [f64; 6]) -> Self {
        let [x, y, z, roll, pitch, yaw] = values;
        Place { shift: [x, y, z], turn: [roll, pitch, yaw] }
    }

    /// x, y, z, roll, pitch, yaw.
    pub fn values(&self) -> [f64; 6] {
        let ([x, y, z], [roll, pitch, yaw]) = (self.shift, self.turn);
        [x, y, z, roll, pitch, yaw]
    }

    /// The rotation from local to outer axes.
    pub fn rotation(&self) -> Rotation3<f64> {
        let [roll, pitch, yaw] = self.turn;
        Rotation3::from_euler_angles(roll, pitch, yaw)
    }

    /// A local direction or offset in outer axes.
    pub fn turned(&self, offset: Position) -> Position {
        (self.rotation() * Vector3::from(offset)).into()
    }

    /// Local coordinates expressed in the outer system.
    pub fn apply(&self, at: Position) -> Position {
        (self.rotation() * Vector3::from(at) + Vector3::from(self.shift)).into()
    }
}

/// Cosine and sine of a heading (rad), without the dust that pi in double precision leaves at the quarters.
pub fn unit_vector(heading: f64) -> (f64, f64) {
    let clean = |value: f64| if value.abs() < 4.0 * f64::EPSILON { 0.0 } else { value };
    (clean(heading.cos()), clean(heading.sin()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn yaw_then_pitch_then_roll_about_turned_axes() {
        let quarter = std::f64::consts::FRAC_PI_2;
        // yaw by 90 takes x to y; a pitch then acts about the turned y axis, which is -x
        let place = Place { shift: [1.0, 2.0, 3.0], turn: [0.0, quarter, quarter] };
        let got = place.apply([1.0, 0.0, 0.0]);
        for (a, b) in got.iter().zip([1.0, 2.0, 2.0]) {
            assert!((a - b).abs() < 1e-12, "{got:?}");
        }
    }
}
