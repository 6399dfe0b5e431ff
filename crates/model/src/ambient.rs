//! What surrounds a line that feels water, wind and bottom all along itself.

use nalgebra::Vector3;
use std::fmt::Debug;
use windlass_base::span::Span;

/// Water and air at a place and a time.
///
/// There is water where the place lies below `surface`, and air above it. Above the surface velocity and acceleration are those of the water
/// at the surface: what stands half in the water feels them, without a jump.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flow {
    /// Velocity of the water (m/s, global).
    pub velocity: Vector3<f64>,
    /// Its acceleration (m/s2, global).
    pub acceleration: Vector3<f64>,
    /// Elevation of the surface above or below the place (m, global z); the mean level where no wave comes down to the place.
    pub surface: f64,
    /// What the pressure at the place is more than that of still water up to the surface, as a height of water (m): nothing where the
    /// water is still and at the surface; less than nothing deep under a crest and more under a trough, whose weight does not reach down.
    pub head: f64,
    /// Velocity of the air (m/s, global).
    pub wind: Vector3<f64>,
}

impl Flow {
    /// Still water with its surface at an elevation (m, global z), and still air.
    pub fn still_water(surface: f64) -> Self {
        let zero = Vector3::zeros();
        Flow { velocity: zero, acceleration: zero, surface, head: 0.0, wind: zero }
    }
}

/// What a pipe holds: of `T_PRESSURE`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Contents {
    /// Temperature above the one at which the pipe was laid (K).
    pub warmer: f64,
    /// Pressure above the atmosphere's (Pa) at the elevation `at`.
    pub pressure: f64,
    /// Elevation of that pressure (m, global z).
    pub at: f64,
    /// Density (kg/m3).
    pub density: f64,
}

/// Contents kept under a name (`T_PRESSURE`).
#[derive(Clone, Debug, PartialEq)]
pub struct Filling {
    /// Its name as written.
    pub name: String,
    /// What it is.
    pub contents: Contents,
    /// Where it was defined.
    pub span: Span,
}

/// Water, wind and bottom around a line, at any place and time.
pub trait Ambient: Debug + Send + Sync {
    /// Water and air at places (m, global) at a time (s) of a run, with waves; `out` is as long as `places`.
    fn flow(&self, time: f64, positions: &[Vector3<f64>], out: &mut [Flow]);

    /// The same at rest: mean current and wind, without waves.
    fn mean(&self, positions: &[Vector3<f64>], out: &mut [Flow]);

    /// Elevation of the bottom (m, global z) and its slopes dz/dx, dz/dy at a place; none where no depth is known.
    fn bottom(&self, x: f64, y: f64) -> Option<(f64, [f64; 2])>;

    /// Whether the bottom is one over a grid. A flat one gives way to the depth that a line says of its own bottom.
    fn has_bottom_grid(&self) -> bool {
        false
    }

    /// Whether who asks is to give up.
    fn is_interrupted(&self) -> bool {
        false
    }

    /// What pipes hold, where the environment says so.
    fn contents(&self) -> Option<Contents> {
        None
    }

    /// Whether there is marine growth anywhere.
    fn grows(&self) -> bool {
        false
    }

    /// Thickness of marine growth (m) at an elevation (m, global z), and its density (kg/m3).
    fn growth(&self, _z: f64) -> (f64, f64) {
        (0.0, 0.0)
    }
}
