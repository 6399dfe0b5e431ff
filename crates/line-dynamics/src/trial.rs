//! A trial motion of a rod, with the fluid sampled along it.

use super::contact::update_stick_point;
use super::ends::{RodEnd, RodEndMotion};
use super::environment::{FluidState, LineEnvironment};
use super::mesh::{Rod, RodElement};
use super::spatial::{rotate_director, transport_director};
use super::state::RodState;
use super::tension::TensionOptions;
use super::viscoelastic::MaxwellMemory;
use nalgebra::{Rotation3, Vector3};

/// A trial motion of all nodes at one time, with the fluid at them.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub time: f64,
    /// Origin of its positions (m, global).
    pub origin: Vector3<f64>,
    pub x: Vec<Vector3<f64>>,
    pub v: Vec<Vector3<f64>>,
    pub a: Vec<Vector3<f64>>,
    pub fluid: Vec<FluidState>,
    /// Positions at which the fluid was sampled.
    pub sampled_at: Vec<Vector3<f64>>,
    /// Direction of the rod at each node at the start of the step, for friction.
    pub friction_direction: Vec<Vector3<f64>>,
    /// Where each node sticks to the bottom at the start of the step.
    pub stuck_at: Vec<Vector3<f64>>,
    /// Where each node was laid on the bottom, about which friction across holds a rod at rest.
    pub laid_at: Vec<Vector3<f64>>,
    /// Penetration over which the bottom's stiffness grows at each node (m).
    pub seabed_penetration_scale: Vec<f64>,
    pub ends: [RodEnd; 2],
    pub softening: Softening,
    /// Whether the tangent of friction is the exact one, as a body needs it, or the secant that converges.
    pub exact_friction_tangent: bool,
    /// Whether it is in statics: winches stand still, nothing slams, and friction is that of `friction` alone.
    pub is_static: bool,
    pub friction: StaticFriction,
    /// Directors of the elements of a rod with torsion.
    pub director: Vec<Vector3<f64>>,
    /// How each element of a rod with viscoelastic rope follows its strain.
    pub memory: Vec<MaxwellMemory>,
}

/// How a rod is softened on the way to a position of rest.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Softening {
    /// Without resistance to compression and bending.
    pub tension_only: bool,
    /// Scale of the axial stiffness, up to one.
    pub axial_stiffness_scale: f64,
}

impl Softening {
    /// The rod as it is.
    pub const NONE: Softening = Softening { tension_only: false, axial_stiffness_scale: 1.0 };

    /// Whether the rod is softer than it is.
    pub fn is_soft(&self) -> bool {
        self.tension_only || self.axial_stiffness_scale < 1.0
    }
}

/// Friction of a rod in statics on a bottom that has some.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum StaticFriction {
    /// None here. In time friction is that of [`super::contact`].
    None,
    /// Of a rod with a pulled end (0 or 1): see [`super::statics_friction`].
    Pulled {
        /// The pulled end.
        end: usize,
        /// Whether it has drag friction, beside friction against sliding down a slope.
        drags: bool,
    },
    /// Of a rod without a pulled end that is held where it was laid: see [`super::stick_friction`].
    Stick,
}

impl StaticFriction {
    /// That of a rod with a pulled end, or none.
    pub fn with_pulled_end(end: Option<usize>, drags: bool) -> Self {
        end.map_or(StaticFriction::None, |end| StaticFriction::Pulled { end, drags })
    }

    /// The pulled end, where there is one.
    pub fn pulled_end(&self) -> Option<usize> {
        match self {
            StaticFriction::Pulled { end, .. } => Some(*end),
            StaticFriction::None | StaticFriction::Stick => None,
        }
    }

    /// Gives a rod with a pulled end drag friction, or takes it away.
    pub fn set_drag(&mut self, drags: bool) {
        *self = match *self {
            StaticFriction::Pulled { end, .. } => StaticFriction::Pulled { end, drags },
            other => other,
        };
    }
}

impl Trial {
    /// Whether tension-only elements resist compression all the same: see [`super::statics_friction`].
    pub fn resists_shortening(&self) -> bool {
        matches!(self.friction, StaticFriction::Pulled { drags: true, .. })
    }

    /// How an element takes its strain.
    #[inline(always)]
    pub fn tension_options(&self, element: &RodElement) -> TensionOptions {
        let Softening { tension_only, axial_stiffness_scale } = self.softening;
        let compression = (element.compression || self.resists_shortening()) && !tension_only;
        TensionOptions { compression, axial_stiffness_scale }
    }
}

/// Takes directors along from one position of the nodes to another.
pub(super) fn transport_directors(directors: &mut [Vector3<f64>], from: &[Vector3<f64>], to: &[Vector3<f64>]) {
    for ((director, a), b) in directors.iter_mut().zip(from.windows(2)).zip(to.windows(2)) {
        *director = transport_director(director, &(a[1] - a[0]).normalize(), &(b[1] - b[0]).normalize());
    }
}

/// Takes directors along with a change of the unknowns that is about to be made, and turns them by it.
pub(super) fn turn_directors(
    directors: &mut [Vector3<f64>],
    x: &[Vector3<f64>],
    change: &[f64],
    stride: usize,
    known: [bool; 2],
) {
    let last = x.len() - 1;
    let moved = |i: usize| {
        if (i == 0 && known[0]) || (i == last && known[1]) {
            return x[i];
        }
        x[i] + Vector3::new(change[stride * i], change[stride * i + 1], change[stride * i + 2])
    };
    for (i, director) in directors.iter_mut().enumerate() {
        let (from, to) = ((x[i + 1] - x[i]).normalize(), (moved(i + 1) - moved(i)).normalize());
        *director = rotate_director(&transport_director(director, &from, &to), &to, change[stride * i + 3]);
    }
}

/// Largest change of the unknowns (m), of which there are `stride` a node: a turn of an element counts by the way of what
/// stands off it by `arm` (m). Infinite where one is no number.
pub(super) fn largest_change(change: &[f64], stride: usize, arm: f64) -> f64 {
    // some nodes at once, whole ones for strides of 3 and 4: no unknown waits for the one before it
    let arms: [f64; 12] = std::array::from_fn(|i| if i % stride < 3 { 1.0 } else { arm });
    let (mut most, mut whole) = ([0.0; 12], true);
    for nodes in change.chunks(arms.len()) {
        for ((most, c), arm) in most.iter_mut().zip(nodes).zip(&arms) {
            let size = arm * c.abs();
            whole &= !size.is_nan();
            *most = if size > *most { size } else { *most };
        }
    }
    if whole { most.iter().fold(0.0, |most: f64, size| most.max(*size)) } else { f64::INFINITY }
}

/// Distance of a node from where the fluid was sampled beyond which it is sampled again, as a share of the shortest element.
///
/// Over a thousandth of an element the water changes by a thousandth of what it changes over the element, and an element takes it for
/// the same all along each half.
const FLUID_REUSE_SHARE: f64 = 1e-3;

/// Samples the fluid again at those nodes of a trial that have left the positions of the last sample, at the same time.
pub(super) fn resample_fluid(world: &LineEnvironment, trial: &mut Trial, shortest: f64) {
    if world.fluid.uniform() {
        return;
    }
    let aside = FLUID_REUSE_SHARE * shortest;
    // a place that is no number is far away
    let near = |x: &Vector3<f64>, asked: &Vector3<f64>| (x - asked).norm_squared() <= aside * aside;
    let Trial { time, x, fluid, sampled_at: asked, .. } = trial;
    let mut begin = 0;
    while begin < x.len() {
        // those beside each other together
        let run = x[begin..].iter().zip(&asked[begin..]).take_while(|(x, asked)| !near(x, asked)).count();
        let positions = begin..begin + run;
        if run > 0 {
            world.fluid.sample_into(&x[positions.clone()], *time, &mut fluid[positions.clone()]);
            asked[positions.clone()].copy_from_slice(&x[positions]);
        }
        begin += run + 1;
    }
}

/// Asks the fluid at the nodes of a trial.
pub(super) fn sample_fluid(world: &LineEnvironment, time: f64, trial: &mut Trial) {
    if world.fluid.uniform() {
        let everywhere = world.fluid.sample(&trial.x[0], time);
        trial.fluid.fill(everywhere);
    } else {
        world.fluid.sample_into(&trial.x, time, &mut trial.fluid);
        trial.sampled_at.copy_from_slice(&trial.x);
    }
}

/// Direction of the rod at each node, where friction needs it.
pub(super) fn set_friction_directions(rod: &Rod, state: &RodState, world: &LineEnvironment, lay: &mut [Vector3<f64>]) {
    if world.bottom.is_some_and(|(_, g)| g.rough()) {
        let last = rod.elements.len();
        for (i, direction) in lay.iter_mut().enumerate() {
            let d = state.position[(i + 1).min(last)] - state.position[i.saturating_sub(1)];
            *direction = d.try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
        }
    }
}

/// Where the nodes stick at the end of a step.
pub(super) fn advance_stick_points(world: &LineEnvironment, from: &RodState, next: &mut RodState) {
    next.stuck.copy_from_slice(&next.position);
    if let Some((bottom, ground)) = world.bottom.filter(|(_, g)| g.holds_at_rest()) {
        for ((stuck, x), before) in next.stuck.iter_mut().zip(&next.position).zip(&from.stuck) {
            *stuck = update_stick_point(bottom, &ground, x, before);
        }
    }
}

/// Penetration over which the bottom's stiffness grows at each node: the bottom's own, or the mesh's where it is larger.
pub(super) fn set_seabed_penetration_scales(state: &RodState, world: &LineEnvironment, soft: &mut [f64]) {
    if let Some((_, ground)) = &world.bottom {
        for (soft, bedding) in soft.iter_mut().zip(&state.bedding) {
            *soft = bedding.max(ground.penetration_scale);
        }
    }
}

/// An end part of the way through a step: a cubic through position and velocity at both ends of it, its direction and
/// side turned back as the holder turns at the end of the step.
pub(super) fn interpolate(state: &RodState, node: usize, end: &RodEnd, whole: f64, share: f64) -> RodEnd {
    if share >= 1.0 {
        return *end;
    }
    let back = Rotation3::new(end.turning * ((share - 1.0) * whole));
    let turned = |across: Option<Vector3<f64>>| across.map(|v| back * v);
    let end = RodEnd { direction: turned(end.direction), side: turned(end.side), ..*end };
    let Some(to) = end.motion else { return end };
    let (x0, v0) = (state.position[node], state.velocity[node] * whole);
    let (x1, v1) = (to.position, to.velocity * whole);
    let (s, d) = (share, x1 - x0);
    let (b, c) = (d * 3.0 - v0 * 2.0 - v1, v0 + v1 - d * 2.0);
    let motion = RodEndMotion {
        position: x0 + v0 * s + b * (s * s) + c * (s * s * s),
        velocity: (v0 + b * (2.0 * s) + c * (3.0 * s * s)) / whole,
        acceleration: (b * 2.0 + c * (6.0 * s)) / (whole * whole),
    };
    RodEnd { motion: Some(motion), ..end }
}
