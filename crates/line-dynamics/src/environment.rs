//! Environment of a rod: fluid, bottom, gravity, supports.

use nalgebra::{Matrix3, Vector3};

/// The fluid at a place and time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FluidState {
    /// Velocity (m/s).
    pub velocity: Vector3<f64>,
    /// Acceleration (m/s2).
    pub acceleration: Vector3<f64>,
    /// Elevation of the free surface above this place's x and y (m, global z).
    pub surface: f64,
    /// What the pressure here is more than that of fluid at rest up to the surface, as a height of fluid (m): see
    /// [`FluidState::pressure`]. Zero but under waves.
    pub head: f64,
    /// Density (kg/m3).
    pub density: f64,
    /// Velocity of the air (m/s).
    pub wind: Vector3<f64>,
    /// Density of the air (kg/m3); zero where there is no wind to speak of.
    pub air_density: f64,
}

impl FluidState {
    /// Pressure (Pa, above the atmosphere's) at an elevation near the place, and its slope by the elevation (Pa/m).
    ///
    /// It is rho g (surface + head - z), and nothing from the surface on. Linear waves leave some pressure at the
    /// surface in a trough; but fluid that is not thrown up by more than gravity, as no wave does before it breaks,
    /// has no more pressure at a depth than twice that at rest, dp/dz = -rho (g + dw/dt). With this bound it goes to
    /// zero without a jump.
    #[inline(always)]
    pub fn pressure(&self, z: f64, gravity: f64) -> (f64, f64) {
        let weight = self.density * gravity;
        let depth = self.surface - z;
        let (height, share) = if self.head < depth { (depth + self.head, 1.0) } else { (2.0 * depth, 2.0) };
        if height > 0.0 { (weight * height, -weight * share) } else { (0.0, 0.0) }
    }
}

/// Kinematics of the fluid around a rod, sampled at the actual positions of the nodes.
pub trait FluidField {
    /// The fluid at a position (m, global) and time (s). Somewhat above the surface the water's motion should be that
    /// of the surface: it acts on the wet part of an element whose node is dry.
    fn sample(&self, position: &Vector3<f64>, time: f64) -> FluidState;

    /// The same at many positions at one time, into a list as long as theirs: for a sea that is prepared once for all
    /// of them.
    fn sample_into(&self, positions: &[Vector3<f64>], time: f64, out: &mut [FluidState]) {
        for (fluid, position) in out.iter_mut().zip(positions) {
            *fluid = self.sample(position, time);
        }
    }

    /// Whether the fluid is the same everywhere at one time: it is then sampled for one node only.
    fn uniform(&self) -> bool {
        false
    }

    /// Whether a search that takes long is to give up.
    fn is_interrupted(&self) -> bool {
        false
    }
}

/// Water and air that move at one velocity each everywhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct UniformFluid(pub FluidState);

impl UniformFluid {
    /// Still water of a density (kg/m3) with its surface at z = 0.
    pub fn still_water(density: f64) -> Self {
        let zero = Vector3::zeros();
        let (velocity, acceleration, wind) = (zero, zero, zero);
        UniformFluid(FluidState { velocity, acceleration, surface: 0.0, head: 0.0, density, wind, air_density: 0.0 })
    }

    /// The same water with a velocity (m/s).
    pub fn moving(density: f64, velocity: Vector3<f64>) -> Self {
        UniformFluid(FluidState { velocity, ..UniformFluid::still_water(density).0 })
    }

    /// No fluid: a rod in vacuum.
    pub fn vacuum() -> Self {
        UniformFluid::still_water(0.0)
    }
}

impl FluidField for UniformFluid {
    fn sample(&self, _: &Vector3<f64>, _: f64) -> FluidState {
        self.0
    }

    fn uniform(&self) -> bool {
        true
    }
}

/// The shape of the bottom.
pub trait SeabedShape {
    /// Height (m, global z) and its slope toward x and y at a place.
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]);

    /// Height (m, global z) of a bottom that is level everywhere; None of any other.
    fn level(&self) -> Option<f64> {
        None
    }
}

/// A plane bottom: height at the origin and slope toward x and y.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneBottom {
    /// Height at x = y = 0 (m, global z).
    pub height: f64,
    /// dz/dx and dz/dy.
    pub slope: [f64; 2],
}

impl SeabedShape for PlaneBottom {
    fn height(&self, x: f64, y: f64) -> (f64, [f64; 2]) {
        (self.height + self.slope[0] * x + self.slope[1] * y, self.slope)
    }

    fn level(&self) -> Option<f64> {
        (self.slope == [0.0; 2]).then_some(self.height)
    }
}

/// Contact law of the seabed.
///
/// Normal to it, a force per area of the rod's shadow (contact diameter times length): stiffness times penetration,
/// plus damping times the rate of penetration, never a pull. Over the first `soft` of penetration the stiffness grows
/// from zero, so that the force has no kink.
///
/// Along it Coulomb friction, with its own coefficient along and across the rod: N mu e opposite to e = d/d0 + v/v0, no
/// larger than one, where d is the way from the place at which the node sticks. That place stays where it is while the
/// way is less than d0, and is drawn along behind the node beyond. A rod that is pulled by less than mu N therefore
/// gives way by less than d0, slowly by v0, and stays there. With a friction damping C it is that of MoorDyn [MOORDYN-2]: mu C v per area,
/// no larger than N mu, and none at rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SeabedLaw {
    /// Normal stiffness per area (N/m3).
    pub stiffness: f64,
    /// Normal damping per area (N s/m3).
    pub damping: f64,
    /// Penetration over which the stiffness grows to its full value (m).
    pub penetration_scale: f64,
    /// Friction coefficient along the rod.
    pub friction_along: f64,
    /// Friction coefficient across the rod.
    pub friction_across: f64,
    /// Speed v0 at which friction is whole (m/s).
    pub friction_speed: f64,
    /// Way d0 within which it comes to be whole (m).
    pub friction_travel: f64,
    /// Friction by speed alone: what an area feels of it at a coefficient of one (N s/m3). None: by the way d0 and the speed v0.
    pub friction_damping: Option<f64>,
    /// Where it pushes.
    pub push: SeabedPush,
}

/// Direction in which the bottom pushes a rod. On a level bottom both are the same.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SeabedPush {
    /// Along its normal, by the penetration along that.
    #[default]
    Normal,
    /// Straight up, by the penetration straight down, as in MoorDyn [MOORDYN-2]: a rod on a slope then has a tension that is not its own.
    Vertical,
}

impl SeabedLaw {
    /// The same without friction.
    pub(super) fn smooth(&self) -> Self {
        SeabedLaw { friction_along: 0.0, friction_across: 0.0, ..*self }
    }

    /// Whether it has friction.
    pub fn rough(&self) -> bool {
        self.friction_along > 0.0 || self.friction_across > 0.0
    }

    /// Whether its friction holds a rod that does not move.
    pub fn holds_at_rest(&self) -> bool {
        self.rough() && self.friction_damping.is_none()
    }

    /// A bottom of a stiffness (N/m2: force per length and penetration) without friction and damping.
    pub fn elastic(stiffness: f64) -> Self {
        SeabedLaw {
            stiffness,
            damping: 0.0,
            penetration_scale: 0.0,
            friction_along: 0.0,
            friction_across: 0.0,
            friction_speed: 0.01,
            friction_travel: 0.005,
            friction_damping: None,
            push: SeabedPush::Normal,
        }
    }
}

/// Contact law of a support.
pub trait SupportLaw: std::fmt::Debug {
    /// Reaction on a rod whose point is at `at` from the place of the support (m, global) and moves at `velocity`
    /// relative to it (m/s); none where there is no contact.
    fn reaction(&self, at: &Vector3<f64>, velocity: &Vector3<f64>) -> Option<SupportReaction>;
}

/// Reaction of a support on a point of a rod.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SupportReaction {
    /// Force on the rod (N, global).
    pub force: Vector3<f64>,
    /// -d(force)/d(place of the point) (N/m).
    pub by_position: Matrix3<f64>,
    /// -d(force)/d(velocity of the point) (N s/m).
    pub by_velocity: Matrix3<f64>,
    /// The part of the force that is the slope of an energy (N), and that energy (J); zero where it keeps none: the
    /// whole force then counts as work.
    pub elastic: (Vector3<f64>, f64),
}

/// A support of a rod between its ends.
///
/// It holds a node of the rod, or it is a roller: the point of the rod that crosses its plane then, and nothing acts
/// along the rod, which rolls through it. Its force depends on where that point is as seen from the support itself, so
/// the support feels the opposite force there.
#[derive(Clone, Copy, Debug)]
pub struct Support<'a> {
    /// Its position (m, global), about which its moment is taken.
    pub position: Vector3<f64>,
    /// Velocity of that point (m/s).
    pub velocity: Vector3<f64>,
    /// What of the rod it supports.
    pub target: SupportTarget,
    /// Its contact law.
    pub law: &'a dyn SupportLaw,
}

/// Part of a rod that a support acts on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum SupportTarget {
    /// A node, from end A.
    Node(usize),
    /// What crosses the plane through the place of the support at right angles to this unit vector.
    Crossing(Vector3<f64>),
}

/// Environment of a rod: all that acts on it but its ends.
#[derive(Clone, Copy)]
pub struct LineEnvironment<'a> {
    /// The fluid.
    pub fluid: &'a dyn FluidField,
    /// The bottom and its contact law; none for a rod that never meets it.
    pub bottom: Option<(&'a dyn SeabedShape, SeabedLaw)>,
    /// Acceleration of gravity (m/s2), downward.
    pub gravity: f64,
    /// Forces on nodes beside those the rod makes itself (N, global): node from end A, force.
    pub forces: &'a [(usize, Vector3<f64>)],
    /// Supports between its ends.
    pub supports: &'a [Support<'a>],
    /// Whether an element that enters the water is slammed by it: the rate at which its added mass grows, times its
    /// velocity relative to the water. Off, the added mass comes without its momentum.
    pub slam: bool,
}

impl<'a> LineEnvironment<'a> {
    /// A fluid and gravity (m/s2), and nothing else.
    pub fn new(fluid: &'a dyn FluidField, gravity: f64) -> Self {
        LineEnvironment { fluid, bottom: None, gravity, forces: &[], supports: &[], slam: false }
    }
    /// Its supports a time (s) before they are where they are, as they move.
    pub(super) fn supports_before(&self, time: f64) -> Vec<Support<'a>> {
        let at = |s: &Support<'a>| Support { position: s.position - s.velocity * time, ..*s };
        self.supports.iter().map(at).collect()
    }
}
