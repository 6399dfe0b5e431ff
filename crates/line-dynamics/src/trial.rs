//! A trial motion of a rod, and what is asked at it.

use super::contact::sticks;
use super::ends::{End, Motion};
use super::mesh::Rod;
use super::rope::Memory;
use super::spatial::{transport, turned};
use super::state::State;
use super::surroundings::{Fluid, World};
use nalgebra::{Rotation3, Vector3};

/// A trial motion of all nodes at one time, with what surrounds them.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub time: f64,
    /// From where its positions are measured (m, global).
    pub origin: Vector3<f64>,
    pub x: Vec<Vector3<f64>>,
    pub v: Vec<Vector3<f64>>,
    pub a: Vec<Vector3<f64>>,
    pub fluid: Vec<Fluid>,
    /// Where the fluid was asked.
    pub asked: Vec<Vector3<f64>>,
    /// Direction of the rod at each node at the start of the step, for friction.
    pub lay: Vec<Vector3<f64>>,
    /// Where each node sticks to the bottom at the start of the step.
    pub stuck: Vec<Vector3<f64>>,
    /// Where each node was laid on the bottom, about which friction across holds a rod at rest.
    pub laid: Vec<Vector3<f64>>,
    /// Penetration over which the bottom's stiffness grows at each node (m).
    pub soft: Vec<f64>,
    pub ends: [End; 2],
    /// Whether it is taken as a chain, without resistance to shortening and bending: on the way to a position of rest.
    pub loose: bool,
    /// The share of its axial stiffness that is there; less than one on the way to a position of rest.
    pub ease: f64,
    /// Whether the tangent of friction is the exact one, as a body needs it, or the secant that converges.
    pub exact: bool,
    /// Whether winches stand still, as they do when the rod is brought to rest.
    pub still: bool,
    /// Which node of an element is toward the end that a rod at rest has been drawn to, if it lies on a bottom with
    /// friction: see [`super::drawn`].
    pub drawn: Option<usize>,
    /// Whether such a rod has friction against sliding down a slope alone, and none against being drawn.
    pub limp: bool,
    /// Whether a rod at rest that has not been drawn to an end is held by friction where it was laid: see [`super::held`].
    pub held: bool,
    /// Directors of the elements of a rod with torsion.
    pub director: Vec<Vector3<f64>>,
    /// How each element of a rod with viscoelastic rope follows its strain.
    pub memory: Vec<Memory>,
}

impl Trial {
    /// Whether elements that bear no compression resist it all the same: see [`super::drawn`].
    pub fn stiff(&self) -> bool {
        self.drawn.is_some() && !self.limp
    }
}

/// Takes directors along from one position of the nodes to another.
pub(super) fn carry(directors: &mut [Vector3<f64>], from: &[Vector3<f64>], to: &[Vector3<f64>]) {
    for ((director, a), b) in directors.iter_mut().zip(from.windows(2)).zip(to.windows(2)) {
        *director = transport(director, &(a[1] - a[0]).normalize(), &(b[1] - b[0]).normalize());
    }
}

/// Takes directors along with a change of the unknowns that is about to be made, and turns them by it.
pub(super) fn turn(
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
        *director = turned(&transport(director, &from, &to), &to, change[stride * i + 3]);
    }
}

/// Largest change of the unknowns (m), of which there are `stride` a node: a turn of an element counts by the way of what
/// stands off it by `arm` (m). Infinite where one is no number.
pub(super) fn largest(change: &[f64], stride: usize, arm: f64) -> f64 {
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

/// How far a node may be from where the fluid was asked, as a share of the shortest element, until it is asked again.
///
/// Over a thousandth of an element the water changes by a thousandth of what it changes over the element, and an element takes it for
/// the same all along each half.
const ASIDE: f64 = 1e-3;

/// Asks the fluid again at those nodes of a trial that have left their places since, at the same time.
pub(super) fn sample_again(world: &World, trial: &mut Trial, shortest: f64) {
    if world.fluid.uniform() {
        return;
    }
    let aside = ASIDE * shortest;
    // a place that is no number is far away
    let near = |x: &Vector3<f64>, asked: &Vector3<f64>| (x - asked).norm_squared() <= aside * aside;
    let Trial { time, x, fluid, asked, .. } = trial;
    let mut begin = 0;
    while begin < x.len() {
        // those beside each other together
        let run = x[begin..].iter().zip(&asked[begin..]).take_while(|(x, asked)| !near(x, asked)).count();
        let places = begin..begin + run;
        if run > 0 {
            world.fluid.fill(&x[places.clone()], *time, &mut fluid[places.clone()]);
            asked[places.clone()].copy_from_slice(&x[places]);
        }
        begin += run + 1;
    }
}

/// Asks the fluid at the nodes of a trial.
pub(super) fn sample(world: &World, time: f64, trial: &mut Trial) {
    if world.fluid.uniform() {
        let everywhere = world.fluid.at(&trial.x[0], time);
        trial.fluid.fill(everywhere);
    } else {
        world.fluid.fill(&trial.x, time, &mut trial.fluid);
        trial.asked.copy_from_slice(&trial.x);
    }
}

/// Direction of the rod at each node, where friction needs it.
pub(super) fn lay(rod: &Rod, state: &State, world: &World, lay: &mut [Vector3<f64>]) {
    if world.bottom.is_some_and(|(_, g)| g.rough()) {
        let last = rod.elements.len();
        for (i, direction) in lay.iter_mut().enumerate() {
            let d = state.position[(i + 1).min(last)] - state.position[i.saturating_sub(1)];
            *direction = d.try_normalize(1e-12).unwrap_or_else(Vector3::zeros);
        }
    }
}

/// Where the nodes stick at the end of a step.
pub(super) fn stick(world: &World, from: &State, next: &mut State) {
    next.stuck.copy_from_slice(&next.position);
    if let Some((bottom, ground)) = world.bottom.filter(|(_, g)| g.rough()) {
        for ((stuck, x), before) in next.stuck.iter_mut().zip(&next.position).zip(&from.stuck) {
            *stuck = sticks(bottom, &ground, x, before);
        }
    }
}

/// Penetration over which the bottom's stiffness grows at each node: the bottom's own, or the mesh's where it is larger.
pub(super) fn soften(state: &State, world: &World, soft: &mut [f64]) {
    if let Some((_, ground)) = &world.bottom {
        for (soft, bedding) in soft.iter_mut().zip(&state.bedding) {
            *soft = bedding.max(ground.soft);
        }
    }
}

/// An end part of the way through a step: a cubic through position and velocity at both ends of it, its direction and
/// side turned back as the holder turns at the end of the step.
pub(super) fn interpolate(state: &State, node: usize, end: &End, whole: f64, share: f64) -> End {
    if share >= 1.0 {
        return *end;
    }
    let back = Rotation3::new(end.turning * ((share - 1.0) * whole));
    let turned = |across: Option<Vector3<f64>>| across.map(|v| back * v);
    let end = End { direction: turned(end.direction), side: turned(end.side), ..*end };
    let Some(to) = end.motion else { return end };
    let (x0, v0) = (state.position[node], state.velocity[node] * whole);
    let (x1, v1) = (to.position, to.velocity * whole);
    let (s, d) = (share, x1 - x0);
    let (b, c) = (d * 3.0 - v0 * 2.0 - v1, v0 + v1 - d * 2.0);
    let motion = Motion {
        position: x0 + v0 * s + b * (s * s) + c * (s * s * s),
        velocity: (v0 + b * (2.0 * s) + c * (3.0 * s * s)) / whole,
        acceleration: (b * 2.0 + c * (6.0 * s)) / (whole * whole),
    };
    End { motion: Some(motion), ..end }
}
