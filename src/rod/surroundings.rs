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
    /// Velocity of the air (m/s).
    pub wind: Vector3<f64>,
    /// Density of the air (kg/m3); zero where there is no wind to speak of.
    pub air_density: f64,
}

/// Kinematics of the fluid around a rod. It is asked at the actual positions of the nodes.
pub trait FluidField {
    /// The fluid at a position (m, global) and time (s). Somewhat above the surface the water's motion should be that
    /// of the surface: it acts on the wet part of an element whose node is dry.
    fn at(&self, position: &Vector3<f64>, time: f64) -> Fluid;

    /// The same at many positions at one time, into a list as long as theirs: for a sea that is prepared once for all
    /// of them.
    fn fill(&self, positions: &[Vector3<f64>], time: f64, out: &mut [Fluid]) {
        for (fluid, position) in out.iter_mut().zip(positions) {
            *fluid = self.at(position, time);
        }
    }

    /// The same of which only surface and density are wanted; the rest may be left as it is.
    fn fill_levels(&self, positions: &[Vector3<f64>], time: f64, out: &mut [Fluid]) {
        self.fill(positions, time, out);
    }

    /// Whether the answer is the same everywhere at one time: it is then asked for one node only.
    fn uniform(&self) -> bool {
        false
    }
}

/// Water and air that move at one velocity each everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformFluid(pub Fluid);

impl UniformFluid {
    /// Still water with its surface at z = 0.
    pub fn still(density: f64) -> Self {
        let zero = Vector3::zeros();
        UniformFluid(Fluid { velocity: zero, acceleration: zero, surface: 0.0, density, wind: zero, air_density: 0.0 })
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
/// Along it Coulomb friction, with its own coefficient along and across the rod: N mu e opposite to e = d/d0 + v/v0, no
/// larger than one, where d is the way from the place at which the node sticks. That place stays where it is while the
/// way is less than d0, and is drawn along behind the node beyond. A rod that is pulled by less than mu N therefore
/// gives way by less than d0, slowly by v0, and stays there.
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
    /// Speed v0 at which friction is whole (m/s).
    pub friction_speed: f64,
    /// Way d0 within which it comes to be whole (m).
    pub friction_travel: f64,
}

impl Ground {
    /// The same without friction.
    pub(super) fn smooth(&self) -> Self {
        Ground { friction_along: 0.0, friction_across: 0.0, ..*self }
    }

    /// A bottom without friction and damping.
    pub fn elastic(stiffness: f64) -> Self {
        Ground {
            stiffness,
            damping: 0.0,
            soft: 0.0,
            friction_along: 0.0,
            friction_across: 0.0,
            friction_speed: 0.01,
            friction_travel: 0.005,
        }
    }
}

/// A cradle of rollers over which a rod is laid: a floor with a flank on each side, or two flanks alone.
///
/// Its shape is that of where the rod's axis may be, so the radius of the rod is part of `place`. Across the cradle
/// the floor reaches `half_width` to each side of the place; beyond it the flanks rise, `opening` between them: a U has
/// a floor and parallel flanks (0), a V no floor and a wide opening. Floor and flanks push the rod back into the
/// cradle by stiffness times depth, with damping, never a pull; over the first `soft` of depth the stiffness grows
/// from zero. Nothing acts along the rod, as the rollers roll.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Roller {
    /// Where the axis of a rod is that just lies in it (m, global).
    pub place: Vector3<f64>,
    /// Velocity of that place (m/s).
    pub velocity: Vector3<f64>,
    /// Directions along the rod's way, across it and up, at right angles to each other.
    pub axes: [Vector3<f64>; 3],
    /// Half the width of the floor (m): zero for a V, infinite for a plain roller without flanks.
    pub half_width: f64,
    /// Angle between the flanks (rad), from 0 for a U to less than pi.
    pub opening: f64,
    /// Stiffness of the floor and of each flank (N/m).
    pub stiffness: f64,
    /// Damping of each (N s/m).
    pub damping: f64,
    /// Depth over which the stiffness grows to its full value (m).
    pub soft: f64,
}

impl Roller {
    /// What keeps it from being a cradle, as one clause; none where it is one.
    pub fn fault(&self) -> Option<&'static str> {
        let whole = |v: &Vector3<f64>| v.iter().all(|c| c.is_finite());
        let [along, across, up] = &self.axes;
        let square = [along.dot(across), across.dot(up), up.dot(along)].iter().all(|c| c.abs() < 1e-6);
        if !whole(&self.place) || !whole(&self.velocity) {
            Some("its place and velocity must be numbers")
        } else if !(square && self.axes.iter().all(|a| (a.norm() - 1.0).abs() < 1e-6)) {
            Some("its axes must be unit vectors at right angles")
        } else if !(self.stiffness.is_finite() && self.stiffness > 0.0) {
            Some("its stiffness must be positive")
        } else if ![self.damping, self.soft].iter().all(|v| v.is_finite() && *v >= 0.0) {
            Some("its damping and soft depth must not be negative")
        } else if !(self.half_width >= 0.0 && (0.0..std::f64::consts::PI).contains(&self.opening)) {
            Some("its half width must not be negative, and its opening from 0 to less than half a turn")
        } else {
            None
        }
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
    /// Cradles it is laid over.
    pub rollers: &'a [Roller],
    /// Whether an element that enters the water is slammed by it: the rate at which its added mass grows, times its
    /// velocity relative to the water. Off, the added mass comes without its momentum.
    pub slam: bool,
}

impl<'a> World<'a> {
    /// A fluid and gravity (m/s2), and nothing else.
    pub fn new(fluid: &'a dyn FluidField, gravity: f64) -> Self {
        World { fluid, bottom: None, gravity, forces: &[], rollers: &[], slam: false }
    }
}
