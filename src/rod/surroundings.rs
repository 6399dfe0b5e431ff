//! What a rod lies in: the fluid, the bottom, gravity.

use nalgebra::Vector3;

/// The fluid at a place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fluid {
    /// Velocity (m/s).
    pub velocity: Vector3<f64>,
    /// Acceleration (m/s2).
    pub acceleration: Vector3<f64>,
    /// Elevation of the free surface above this place's x and y (m, global z).
    pub surface: f64,
    /// Density (kg/m3).
    pub density: f64,
}

/// Kinematics of the fluid around a rod. It is asked at the actual positions of the nodes.
pub trait FluidField {
    /// The fluid at a position (m, global) and time (s). Above the surface the velocity is not used.
    fn at(&self, position: &Vector3<f64>, time: f64) -> Fluid;

    /// Whether the answer is the same everywhere at one time: it is then asked for one node only.
    fn uniform(&self) -> bool {
        false
    }
}

/// Water that moves at one velocity everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformFluid(pub Fluid);

impl UniformFluid {
    /// Still water with its surface at z = 0.
    pub fn still(density: f64) -> Self {
        UniformFluid(Fluid { velocity: Vector3::zeros(), acceleration: Vector3::zeros(), surface: 0.0, density })
    }

    /// The same water with a velocity (m/s).
    pub fn moving(density: f64, velocity: Vector3<f64>) -> Self {
        UniformFluid(Fluid { velocity, ..UniformFluid::still(density).0 })
    }

    /// No fluid: a rod in vacuum.
    pub fn none() -> Self {
        UniformFluid::still(0.0)
    }
}

impl FluidField for UniformFluid {
    fn at(&self, _: &Vector3<f64>, _: f64) -> Fluid {
        self.0
    }

    fn uniform(&self) -> bool {
        true
    }
}

/// The shape of the bottom.
pub trait Bottom {
    /// Height (m, global z) and its slope toward x and y at a place.
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]);
}

/// A plane bottom: height at the origin and slope toward x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneBottom {
    /// Height at x = y = 0 (m, global z).
    pub height: f64,
    /// dz/dx and dz/dy.
    pub slope: [f64; 2],
}

impl Bottom for PlaneBottom {
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        (self.height + self.slope[0] * x + self.slope[1] * y, self.slope)
    }
}

/// How the bottom answers a rod that lies on it.
///
/// Normal to it, a force per area of the rod's shadow (contact diameter times length): stiffness times penetration,
/// plus damping times the rate of penetration, never a pull. Over the first `soft` of penetration the stiffness grows
/// from zero, so that the force has no kink.
///
/// Along it Coulomb friction, regularised by speed: N mu v / sqrt(v^2 + v0^2), with its own coefficient along and
/// across the rod. A rod that is pulled by less than mu N therefore creeps, at a speed below v0.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// Normal stiffness per area (N/m3).
    pub stiffness: f64,
    /// Normal damping per area (N s/m3).
    pub damping: f64,
    /// Penetration over which the stiffness grows to its full value (m).
    pub soft: f64,
    /// Friction coefficient along the rod.
    pub friction_along: f64,
    /// Friction coefficient across the rod.
    pub friction_across: f64,
    /// Speed v0 of the regularised friction (m/s).
    pub friction_speed: f64,
}

impl Ground {
    /// A bottom without friction and damping.
    pub fn elastic(stiffness: f64) -> Self {
        Ground { stiffness, damping: 0.0, soft: 0.0, friction_along: 0.0, friction_across: 0.0, friction_speed: 0.01 }
    }
}

/// All that surrounds a rod.
#[derive(Clone, Copy)]
pub struct World<'a> {
    /// The fluid.
    pub fluid: &'a dyn FluidField,
    /// The bottom and how it answers; none for a rod that never meets it.
    pub bottom: Option<(&'a dyn Bottom, Ground)>,
    /// Acceleration of gravity (m/s2), downward.
    pub gravity: f64,
    /// Forces on nodes beside those the rod makes itself (N, global): node from end A, force.
    pub forces: &'a [(usize, Vector3<f64>)],
}
