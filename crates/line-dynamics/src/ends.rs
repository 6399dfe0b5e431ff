//! What holds the two ends of a rod.

use super::mesh::RodElement;
use nalgebra::Vector3;

/// Where an end is and how it moves, at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodEndMotion {
    /// Position (m, global).
    pub position: Vector3<f64>,
    /// Velocity (m/s).
    pub velocity: Vector3<f64>,
    /// Acceleration (m/s2).
    pub acceleration: Vector3<f64>,
}

impl RodEndMotion {
    /// At rest at a position (m, global).
    pub fn at_rest(position: Vector3<f64>) -> Self {
        RodEndMotion { position, velocity: Vector3::zeros(), acceleration: Vector3::zeros() }
    }
}

/// One end of a rod at the end of a step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodEnd {
    /// The motion it is given; none for a free end.
    pub motion: Option<RodEndMotion>,
    /// The direction, from end A toward end B, that its holder gives it; none for a pin. It acts on rods with bending
    /// stiffness.
    pub direction: Option<Vector3<f64>>,
    /// Rotational stiffness between holder and rod (N m/rad); none for a rigid clamp.
    pub rotation: Option<f64>,
    /// A direction across the rod that turns with the holder and holds the rod's twist; none leaves it free to twist.
    /// It acts on rods with torsional stiffness.
    pub side: Option<Vector3<f64>>,
    /// Rotation rate of the holder (rad/s, global), with which direction and side turn: where a step must be cut in
    /// parts they are turned back by it, and by it the energy balance knows the work of the moment.
    pub turning: Vector3<f64>,
}

impl RodEnd {
    /// A free end.
    pub const FREE: RodEnd =
        RodEnd { motion: None, direction: None, rotation: None, side: None, turning: Vector3::new(0.0, 0.0, 0.0) };

    /// Held at a position (m, global), free to turn.
    pub fn pin(position: Vector3<f64>) -> Self {
        RodEnd::from_motion(RodEndMotion::at_rest(position))
    }

    /// Moved as given, free to turn.
    pub fn from_motion(motion: RodEndMotion) -> Self {
        RodEnd { motion: Some(motion), ..RodEnd::FREE }
    }

    /// The same with its direction held: a vector from end A toward end B, of any length.
    pub fn with_clamp(self, direction: Vector3<f64>) -> Self {
        RodEnd { direction: Some(direction), ..self }
    }

    /// The same with its twist held by a vector across the rod, of any length.
    pub fn with_side(self, side: Vector3<f64>) -> Self {
        RodEnd { side: Some(side), ..self }
    }

    /// The same with a holder that turns at a rate (rad/s, global).
    pub fn with_turning(self, turning: Vector3<f64>) -> Self {
        RodEnd { turning, ..self }
    }

    /// Stiffness of the hinge (N m) between the holder and the half element beside it, and the direction held.
    #[inline]
    pub(super) fn hinge(&self, element: &RodElement) -> Option<(f64, Vector3<f64>)> {
        let direction = self.direction?.try_normalize(1e-12)?;
        let beam = 2.0 * element.bending / element.rest;
        let stiffness = self.rotation.map_or(beam, |k| if k > 0.0 { k * beam / (k + beam) } else { 0.0 });
        Some((stiffness, direction))
    }
}
