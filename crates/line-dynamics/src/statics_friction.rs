//! Seabed friction in statics, of a rod with a pulled end.
//!
//! The friction of a line at rest depends on how the line got there. As in the exact catenary, statics assumes that a line
//! with one end on the bottom and the other above it has been pulled toward that upper end, the pulled end
//! [JONKMAN-2007 eq. 2-36 to 2-38]: friction is fully mobilised at every node on the bottom that has moved. From the
//! touchdown on the tension decreases by mu w per length, to zero or to the anchor's tension; where there is no tension the
//! line has not moved, and friction is zero.
//!
//! Beside this drag friction, grounded nodes are held on a slope and in a current by as much friction as it takes: along the line
//! before drag friction, across it about the place where they were laid. Both together are no more than mu N, as in dynamics.
//!
//! On the way to rest the line also resists compression: a node that lost its tension would lose its friction as well, and be pulled
//! away at once. At rest every element has a tension. A line too long for that, which piles up straight under its upper end, is solved
//! without drag friction and without resistance to compression. [`RodSolver::has_slid_without_friction`](super::RodSolver::has_slid_without_friction) is set where such a line has a
//! tension that friction should have taken.

use super::contact::{NormalReaction, normal_reaction};
use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::morison::{HalfNode, half_force};
use super::state::RodState;
use super::stick_friction::stick_friction;
use super::tension::{ElementStretch, tension};
use super::trial::{StaticFriction, Trial, set_friction_directions, transport_directors};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// Friction on that node of an element that is nearer the pulled end.
pub(super) struct NodeFriction {
    pub node: usize,
    /// The force on it (N).
    pub force: Vector3<f64>,
    /// The most it can be along or across the rod (N).
    pub whole: f64,
    /// The force as a share of the most it can be along the rod and across.
    pub held: Vector3<f64>,
    /// Drag friction: what it takes of the tension beyond the node, or would take where it is switched off (N).
    pub drag: f64,
    /// Normal of the bottom there, and the direction across the rod on it.
    pub normal: Vector3<f64>,
    pub aside: Vector3<f64>,
    /// Its derivative by the position of the node itself and of the other of the element (N/m).
    pub by: [Matrix3<f64>; 2],
}

/// Tension that friction leaves, as a share of what friction a node can bring up against being drawn: it holds the nodes in line that
/// nothing else holds.
pub(super) const RESIDUAL_TENSION_SHARE: f64 = 0.01;

/// Share of that friction that acts on a node by the tension beyond it, as a share of the same, and its slope. So
/// friction takes no more tension than there is.
fn mobilised_share(tension: f64) -> (f64, f64) {
    let spare = (tension - RESIDUAL_TENSION_SHARE).clamp(0.0, 1.0);
    if spare > 0.0 { (spare * (2.0 - spare), 2.0 * (1.0 - spare)) } else { (0.0, 0.0) }
}

/// Least share of its friction that a node has as drag friction, where a slope takes all of it.
const MIN_DRAG_FRICTION_SHARE: f64 = 1e-3;

/// The pulled end: the one above the bottom where the other lies on it. None without friction, or with both ends up or down.
pub(super) fn pulled_end(rod: &Rod, world: &LineEnvironment, ends: &[RodEnd; 2]) -> Option<usize> {
    let (bottom, _) = world.bottom.filter(|(_, ground)| ground.holds_at_rest())?;
    let last = rod.elements.len() - 1;
    let lies = |side: usize| {
        let x = ends[side].motion?.position;
        Some(x.z - bottom.height(x.x, x.y).0 < 0.5 * rod.elements[side * last].rest)
    };
    match [lies(0), lies(1)] {
        [Some(true), Some(false)] => Some(1),
        [Some(false), Some(true)] => Some(0),
        _ => None,
    }
}

/// What weight, water and wind do to a node of a rod at rest (N).
fn load_at_rest(rod: &Rod, world: &LineEnvironment, trial: &Trial, node: usize) -> Vector3<f64> {
    let mut sum = Vector3::zeros();
    for (i, other) in [(node.checked_sub(1), node.wrapping_sub(1)), (Some(node), node + 1)] {
        let Some((i, element)) = i.and_then(|i| Some((i, rod.elements.get(i)?))) else { continue };
        sum.z -= element.mass * world.gravity;
        let Some(t) = (trial.x[i + 1] - trial.x[i]).try_normalize(1e-9 * element.rest) else { continue };
        let at = |node: usize| HalfNode {
            position: &trial.x[node],
            velocity: &trial.v[node],
            acceleration: &trial.a[node],
            fluid: &trial.fluid[node],
        };
        sum += half_force(element, &t, world, [at(node), at(other)]);
    }
    sum
}

/// How steep the bottom is for a node: what pulls it along the bottom over what presses it on it, as a vector along the bottom against
/// that pull. In still water it is the slope.
fn effective_slope(
    rod: &Rod,
    world: &LineEnvironment,
    trial: &Trial,
    node: usize,
    normal: &Vector3<f64>,
) -> Vector3<f64> {
    let fluid = &trial.fluid[node];
    let still = fluid.velocity == Vector3::zeros() && fluid.wind == Vector3::zeros();
    let load = if still { -Vector3::z() } else { load_at_rest(rod, world, trial, node) };
    let pressed = -load.dot(normal);
    if pressed > 0.0 { -(load + normal * pressed) / pressed } else { Vector3::zeros() }
}

/// Seabed friction at element `i` of a rod at rest with a pulled end (`side`).
pub(super) fn seabed_friction(
    rod: &Rod,
    world: &LineEnvironment,
    trial: &Trial,
    i: usize,
    side: usize,
) -> Option<NodeFriction> {
    let (bottom, ground) = world.bottom?;
    let (node, other) = (i + side, i + 1 - side);
    let NormalReaction { force: n, normal, by_depth } =
        normal_reaction(bottom, &ground, trial.seabed_penetration_scale[node], rod.contact_area(node), &trial.x[node])?;
    let [mu, mu_across] = [ground.friction_along, ground.friction_across];
    let element = &rod.elements[i];
    let d = trial.x[other] - trial.x[node];
    let length = d.norm().max(1e-9 * element.rest);
    // away from the pulled end
    let t = d / length;
    let flat = Matrix3::identity() - normal * normal.transpose();
    let level = (flat * t).norm();
    if n <= 0.0 || level < 1e-3 {
        return None;
    }
    let way = flat * t / level;
    let aside = normal.cross(&way);
    // how the way turns aside with the other node
    let turns = (Matrix3::identity() - t * t.transpose()) * aside / (level * length);
    let signs = [-1.0, 1.0];
    // across it is held about where it was laid: by a share c, which leaves a share most along it
    let off = trial.x[node] - trial.laid_at[node];
    let u = if mu_across > 0.0 { off.dot(&aside) / ground.friction_travel } else { 0.0 };
    let most = 1.0 / u.hypot(1.0);
    let (c, cubed) = (-u * most, most.powi(3));
    let du = signs.map(|sign| {
        let own = if sign < 0.0 && mu_across > 0.0 { aside } else { Vector3::zeros() };
        let turned = if mu_across > 0.0 { turns * (sign * -off.dot(&way)) } else { Vector3::zeros() };
        (own + turned) / ground.friction_travel
    });
    // friction against sliding down the slope comes before drag friction
    let steep = effective_slope(rod, world, trial, node, &normal);
    let wanted = if mu > 0.0 { way.dot(&steep) / mu } else { 0.0 };
    let kept = wanted.clamp(-most, most);
    let spare = (most - kept).max(MIN_DRAG_FRICTION_SHARE);
    let taken = trial.tension_options(element);
    let height = 0.5 * (trial.x[node].z + trial.x[other].z);
    let stretch = ElementStretch { strain: length / element.rest - 1.0, rate: 0.0, height, datum: trial.origin.z };
    let fluids = [&trial.fluid[i], &trial.fluid[i + 1]];
    let pull = tension(rod, element, taken, &stretch, trial.memory.get(i), fluids, world.gravity);
    let drawn = if mu > 0.0 { pull.value / (spare * mu * n) } else { 0.0 };
    let (share, slope) = if trial.resists_shortening() { mobilised_share(drawn) } else { (0.0, 0.0) };
    let a = kept + spare * share;
    let held = way * a + aside * c;
    let force = (way * (mu * a) + aside * (mu_across * c)) * n;
    let by = [0, 1].map(|j| {
        let turned = turns * signs[j];
        let pressed = if j == 0 { normal * -by_depth } else { Vector3::zeros() };
        let by_most = du[j] * (-u * cubed);
        let by_kept =
            if kept == wanted && mu > 0.0 { turned * (aside.dot(&steep) / mu) } else { by_most * wanted.signum() };
        let by_spare = if spare > MIN_DRAG_FRICTION_SHARE { by_most - by_kept } else { Vector3::zeros() };
        let pulled = t * (signs[j] * pull.by_strain / element.rest) + Vector3::z() * (0.5 * pull.by_height);
        let by_drawn = if mu > 0.0 { pulled / (mu * n) - pressed * (drawn * spare / n) } else { Vector3::zeros() };
        let by_a = by_kept + by_spare * (share - drawn * slope) + by_drawn * slope;
        let by_c = du[j] * -cubed;
        force * pressed.transpose() / n
            + (way * by_a.transpose() + aside * turned.transpose() * a) * (mu * n)
            + (aside * by_c.transpose() - way * turned.transpose() * c) * (mu_across * n)
    });
    Some(NodeFriction {
        node,
        force,
        whole: mu.max(mu_across) * n,
        held,
        drag: spare * mu * n * mobilised_share(drawn).0,
        normal,
        aside,
        by,
    })
}

/// The largest share of friction across by which a node is taken to be held about where it was laid.
const MAX_STUCK_SHARE: f64 = 0.9999;

/// Lays nodes where they are: those on the bottom without the way along the rod that they have gone since they were laid, the others
/// as they hang.
pub(super) fn place_laid_nodes_at_trial(trial: &mut Trial, rod: &Rod, world: &LineEnvironment) {
    place_laid_nodes(trial, rod, world, |off| off);
}

/// Lays nodes where their friction across is what it was in a state with the same way from where they stuck.
pub(super) fn place_laid_nodes_from_state(trial: &mut Trial, rod: &Rod, world: &LineEnvironment) {
    let Some((_, ground)) = world.bottom else { return };
    place_laid_nodes(trial, rod, world, |off| {
        let share = (off / ground.friction_travel).clamp(-MAX_STUCK_SHARE, MAX_STUCK_SHARE);
        ground.friction_travel * share / (1.0 - share * share).sqrt()
    });
}

fn place_laid_nodes(trial: &mut Trial, rod: &Rod, world: &LineEnvironment, off: impl Fn(f64) -> f64) {
    let Some(side) = trial.friction.pulled_end() else { return };
    let mut laid = trial.x.clone();
    for i in 0..rod.elements.len() {
        if let Some(NodeFriction { node, aside, .. }) = seabed_friction(rod, world, trial, i, side) {
            laid[node] -= aside * off(aside.dot(&(trial.x[node] - trial.laid_at[node])));
        }
    }
    trial.laid_at = laid;
}

/// Takes the nodes along with an end that has moved: the line swings round about the one it is held by.
pub(super) fn swing_with_end(trial: &mut Trial, rod: &Rod, state: &RodState, world: &LineEnvironment) {
    let (Some(side), Some((bottom, _))) = (trial.friction.pulled_end(), world.bottom) else { return };
    let last = rod.elements.len();
    let (tip, root) = (side * last, (1 - side) * last);
    let (was, x) = (&state.position, &mut trial.x);
    if x[tip] == was[tip] && x[root] == was[root] {
        return;
    }
    let (from, to) = (was[tip] - was[root], x[tip] - x[root]);
    let angle = (from.x * to.y - from.y * to.x).atan2(from.x * to.x + from.y * to.y);
    let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
    let base = x[root];
    let over = |x: &Vector3<f64>| x.z - bottom.height(x.x, x.y).0;
    // from the held end on
    let at = |i: usize| if side == 1 { i } else { last - i };
    let foot = (0..=last).rev().find(|i| over(&was[at(*i)]) < 0.0).unwrap_or(0);
    let rotated = |i: usize| base + turn * (was[at(i)] - was[root]);
    for i in 1..last {
        let mut position = rotated(i);
        if i <= foot {
            position.z += over(&was[at(i)]) - over(&position);
        }
        trial.laid_at[at(i)] = position - turn * (was[at(i)] - trial.laid_at[at(i)]);
        x[at(i)] = position;
    }
    transport_directors(&mut trial.director, was, x);
}

/// Total drag friction of a rod at rest, or what it would be where it is switched off, over the most that a single node has.
pub(super) fn relative_drag(trial: &Trial, rod: &Rod, world: &LineEnvironment) -> f64 {
    let Some(side) = trial.friction.pulled_end() else { return 0.0 };
    let all = (0..rod.elements.len()).filter_map(|i| seabed_friction(rod, world, trial, i, side));
    let (sum, most) = all.fold((0.0, 0.0f64), |(sum, most), rub| (sum + rub.drag, most.max(rub.whole)));
    if most > 0.0 { sum / most } else { 0.0 }
}

/// Least strain of the elements of the trial that bear no compression.
pub(super) fn least_strain(trial: &Trial, rod: &Rod) -> f64 {
    let soft = rod.elements.iter().zip(trial.x.windows(2)).filter(|(element, _)| !element.compression);
    soft.map(|(element, x)| (x[1] - x[0]).norm() / element.rest - 1.0).fold(0.0, f64::min)
}

/// Whether a rod at rest with friction has an element in compression, which it cannot bear.
pub(super) fn has_compressed_element(trial: &Trial, rod: &Rod) -> bool {
    // what rounding and the proof of rest leave
    const ROUNDING_STRAIN: f64 = -1e-9;
    trial.resists_shortening() && least_strain(trial, rod) < ROUNDING_STRAIN
}

/// Sets the stick points of a state at rest so that dynamics begins with the friction of statics.
pub(super) fn set_stick_points(trial: &mut Trial, rod: &Rod, world: &LineEnvironment, state: &mut RodState) {
    state.stuck.copy_from_slice(&state.position);
    if let (Some(side), Some((_, ground))) = (trial.friction.pulled_end(), world.bottom) {
        for i in 0..rod.elements.len() {
            if let Some(rub) = seabed_friction(rod, world, trial, i, side) {
                state.stuck[rub.node] += rub.held * ground.friction_travel;
            }
        }
    }
    if let (StaticFriction::Stick, Some((_, ground))) = (trial.friction, world.bottom) {
        for node in 0..rod.nodes() {
            if let Some(hold) = stick_friction(rod, world, trial, node) {
                state.stuck[node] += hold.held * ground.friction_travel;
            }
        }
    }
    trial.stuck_at.copy_from_slice(&state.stuck);
    set_friction_directions(rod, state, world, &mut trial.friction_direction);
}
