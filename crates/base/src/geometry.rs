//! Positions and the placing of bodies and parts.
//!
//! Source: [MOSES-REF bod_par]: yaw about Z, then pitch about Y, then roll about X, each about the
//! axes already turned.

use nalgebra::{Matrix3, Rotation3, Vector3};
use std::f64::consts::FRAC_PI_2;

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
    /// From x, y, z (m), roll, pitch, yaw (rad).
    pub fn new(values: [f64; 6]) -> Self {
        let [x, y, z, roll, pitch, yaw] = values;
        Place { shift: [x, y, z], turn: [roll, pitch, yaw] }
    }

    /// x, y, z (m), roll, pitch, yaw (rad).
    pub fn values(&self) -> [f64; 6] {
        let ([x, y, z], [roll, pitch, yaw]) = (self.shift, self.turn);
        [x, y, z, roll, pitch, yaw]
    }

    /// The rotation from local to outer axes; exact at multiples of a quarter turn.
    pub fn rotation(&self) -> Rotation3<f64> {
        let [(cr, sr), (cp, sp), (cy, sy)] = self.turn.map(unit_vector);
        let about_x = Matrix3::new(1.0, 0.0, 0.0, 0.0, cr, -sr, 0.0, sr, cr);
        let about_y = Matrix3::new(cp, 0.0, sp, 0.0, 1.0, 0.0, -sp, 0.0, cp);
        let about_z = Matrix3::new(cy, -sy, 0.0, sy, cy, 0.0, 0.0, 0.0, 1.0);
        Rotation3::from_matrix_unchecked(about_z * about_y * about_x)
    }

    /// A local direction or offset in outer axes.
    pub fn rotate(&self, offset: Position) -> Position {
        (self.rotation() * Vector3::from(offset)).into()
    }

    /// Local coordinates expressed in the outer system.
    pub fn apply(&self, at: Position) -> Position {
        (self.rotation() * Vector3::from(at) + Vector3::from(self.shift)).into()
    }
}

/// Cosine and sine of an angle (rad); exact at multiples of a quarter turn, as near as a double comes to them.
pub fn unit_vector(angle: f64) -> (f64, f64) {
    let quarters = (angle / FRAC_PI_2).round();
    let near = (angle - quarters * FRAC_PI_2).abs() <= 4.0 * f64::EPSILON * angle.abs().max(1.0);
    if !near {
        return (angle.cos(), angle.sin());
    }
    match quarters.rem_euclid(4.0) {
        1.0 => (0.0, 1.0),
        2.0 => (-1.0, 0.0),
        3.0 => (0.0, -1.0),
        _ => (1.0, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rotation_is_yaw_then_pitch_then_roll_about_rotated_axes() {
        let quarter = std::f64::consts::FRAC_PI_2;
        // yaw by 90 takes x to y; a pitch then acts about the turned y axis, which is -x
        let position = Place { shift: [1.0, 2.0, 3.0], turn: [0.0, quarter, quarter] };
        let got = position.apply([1.0, 0.0, 0.0]);
        for (a, b) in got.iter().zip([1.0, 2.0, 2.0]) {
            assert!((a - b).abs() < 1e-12, "{got:?}");
        }
    }

    #[test]
    fn quarter_turns_are_exact() {
        for quarters in -9..=9 {
            let turn = f64::from(quarters * 90).to_radians();
            for axis in 0..3 {
                let mut position = Place::default();
                position.turn[axis] = turn;
                assert!(position.rotation().matrix().iter().all(|e| *e == e.round()), "{quarters} about {axis}");
            }
        }
        assert_eq!(Place::new([0.0, 0.0, 0.0, 0.0, 0.0, FRAC_PI_2]).apply([10.0, 0.0, 0.0]), [0.0, 10.0, 0.0]);
        assert_eq!(unit_vector(f64::from(7200 + 270).to_radians()), (0.0, -1.0));
    }

    #[test]
    fn rotations_match_euler_angles() {
        for step in 0..200 {
            let [roll, pitch, yaw] = [0.37, 0.91, -1.13].map(|rate| rate * f64::from(step));
            let position = Place::new([0.0, 0.0, 0.0, roll, pitch, yaw]);
            let difference = position.rotation().matrix() - Rotation3::from_euler_angles(roll, pitch, yaw).matrix();
            assert!(difference.amax() < 1e-14, "{difference}");
        }
    }
}
