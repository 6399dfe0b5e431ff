//! Batches (SIMD) of eight submerged elements of constant EA: the same residual and tangent as [`assemble`](super::assemble).
//!
//! The loops over them run in the widest vectors the machine has (multiversion); no product is contracted with its sum, so that every
//! machine comes to the same digits.

use super::element_list::ElementLanes;
use super::mesh::Rod;
use super::system::Weights;
use super::tension::TubeAreas;
use super::trial::{Softening, Trial};
use multiversion::multiversion;
use std::ops::Range;

/// Elements in a batch.
pub(super) const BATCH_SIZE: usize = 8;
/// Their nodes.
const BATCH_NODES: usize = BATCH_SIZE + 1;

/// Speed (m/s) below which flow counts as none: A is its square.
const MIN_FLOW_SPEED: f64 = 1e-12;

/// A number of each element.
type Lanes = [f64; BATCH_SIZE];
/// A vector of each node, by components.
type NodeVectors = [[f64; BATCH_NODES]; 3];

/// Input of a batch, a lane for each element or node.
#[derive(Clone, Debug, Default)]
struct BatchInput {
    elements: ElementLanes,
    x: NodeVectors,
    v: NodeVectors,
    a: NodeVectors,
    /// Velocity and acceleration of the water.
    flow: NodeVectors,
    water: NodeVectors,
    density: [f64; BATCH_NODES],
    surface: [f64; BATCH_NODES],
    head: [f64; BATCH_NODES],
    /// Strain by warmth, free of tension.
    free: Lanes,
    /// What tension has of the pressure outside (m2), and of that inside at the datum of heights (N) and by the way down (N/m): none but of tubes.
    outside: Lanes,
    inside: Lanes,
    contents: Lanes,
}

/// What is the same for all elements of a batch.
struct BatchTerms {
    weights: Weights,
    gravity: f64,
    axial_stiffness_scale: f64,
    /// Share of their own resistance to being shortened, and what all have of it.
    pushes: [f64; 2],
    /// One where elements grow at their rate, else zero.
    winding: f64,
}

/// Residual of the elements on their first and second nodes, and its tangent by rows: of a node by itself, then by the other node.
#[derive(Clone, Debug, Default)]
pub(super) struct BatchTangent {
    pub force: [[Lanes; 3]; 2],
    pub itself: [[[Lanes; 3]; 3]; 2],
    pub other: [[[Lanes; 3]; 3]; 2],
}

/// A batch of consecutive elements.
#[derive(Clone, Debug, Default)]
pub(super) struct ElementBatch {
    asked: BatchInput,
    pub shares: BatchTangent,
}

/// How many elements from the first of a range on fit a batch, [`BATCH_SIZE`] at most: of a constant EA, all under water.
pub(super) fn count_batchable(rod: &Rod, trial: &Trial, range: Range<usize>) -> usize {
    let most = range.len().min(BATCH_SIZE);
    let wet = |node: usize, diameter: f64| {
        let fluid = &trial.fluid[node];
        fluid.density > 0.0 && fluid.surface - trial.x[node].z >= 0.5 * diameter
    };
    let elements = &rod.elements[range.start..range.start + most];
    let plain = elements
        .iter()
        .zip(range.start..)
        .take_while(|(e, i)| e.plain && wet(*i, e.diameter) && wet(i + 1, e.diameter));
    plain.count()
}

impl ElementBatch {
    /// Residual of so many elements from the first on, and its tangent where it is wanted.
    ///
    /// As `assemble` and `morison` do element by element, with the tangent brought together: with t the direction, T its
    /// product with itself and A that of the velocity across, all of it is shares of t w', T, A and the unit matrix.
    pub fn assemble_batch<const TANGENT: bool>(
        &mut self,
        rod: &Rod,
        trial: &Trial,
        weights: Weights,
        gravity: f64,
        first: usize,
        count: usize,
    ) {
        self.gather_input(rod, trial, gravity, (first, count));
        let ElementBatch { asked, shares } = self;
        let Softening { tension_only, axial_stiffness_scale } = trial.softening;
        let pushes = match (tension_only, trial.resists_shortening()) {
            (true, _) => [0.0, 0.0],
            (false, true) => [0.0, 1.0],
            (false, false) => [1.0, 0.0],
        };
        let winding = if trial.is_static { 0.0 } else { 1.0 };
        let how = BatchTerms { weights, gravity, axial_stiffness_scale, pushes, winding };
        if TANGENT {
            add_forces_and_tangents(asked, &how, shares);
        } else {
            add_forces(asked, &how, shares);
        }
    }

    /// Gathers the input; lanes beyond the last element keep their old values and are not used.
    fn gather_input(&mut self, rod: &Rod, trial: &Trial, gravity: f64, (first, count): (usize, usize)) {
        let asked = &mut self.asked;
        rod.elements.copy_lanes(first, &mut asked.elements);
        for lanes in [&mut asked.free, &mut asked.outside, &mut asked.inside, &mut asked.contents] {
            *lanes = [0.0; BATCH_SIZE];
        }
        if rod.segments.iter().any(|s| s.tube.is_some()) {
            for (n, element) in rod.elements[first..first + count].iter().enumerate().take(BATCH_SIZE) {
                let tube = rod.segments[element.segment].tube.as_ref();
                let TubeAreas { free_strain: free, outside, inside, contents } =
                    tube.map_or(TubeAreas::default(), |t| TubeAreas::from_tube(t, gravity, trial.origin.z));
                (asked.free[n], asked.outside[n]) = (free, outside);
                (asked.inside[n], asked.contents[n]) = (inside, contents);
            }
        }
        let nodes = first..first + count + 1;
        let motions = trial.x[nodes.clone()].iter().zip(&trial.v[nodes.clone()]).zip(&trial.a[nodes.clone()]);
        for (n, (((x, v), a), fluid)) in motions.zip(&trial.fluid[nodes]).enumerate().take(BATCH_NODES) {
            for i in 0..3 {
                asked.x[i][n] = x[i];
                asked.v[i][n] = v[i];
                asked.a[i][n] = a[i];
                asked.flow[i][n] = fluid.velocity[i];
                asked.water[i][n] = fluid.acceleration[i];
            }
            asked.density[n] = fluid.density;
            asked.surface[n] = fluid.surface;
            asked.head[n] = fluid.head;
        }
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_forces_and_tangents(asked: &BatchInput, how: &BatchTerms, shares: &mut BatchTangent) {
    for n in 0..BATCH_SIZE {
        assemble_lane::<true>(asked, n, how, shares);
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn add_forces(asked: &BatchInput, how: &BatchTerms, shares: &mut BatchTangent) {
    for n in 0..BATCH_SIZE {
        assemble_lane::<false>(asked, n, how, shares);
    }
}

#[inline(always)]
fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
fn map_lanes(of: impl Fn(usize) -> f64) -> [f64; 3] {
    [of(0), of(1), of(2)]
}

/// The element of a number: without a branch, so that all of them go side by side.
#[inline(always)]
fn assemble_lane<const TANGENT: bool>(asked: &BatchInput, n: usize, how: &BatchTerms, shares: &mut BatchTangent) {
    let BatchTerms { weights: Weights { k, c, .. }, gravity, axial_stiffness_scale: ease, pushes: [own, all], winding } =
        *how;
    let d = map_lanes(|i| asked.x[i][n + 1] - asked.x[i][n]);
    let dv = map_lanes(|i| asked.v[i][n + 1] - asked.v[i][n]);
    let rest = asked.elements.rest[n];
    // nodes of a slack heap may meet: their element then has no direction, and no tension to need one
    let (length, least) = (dot(d, d).sqrt(), 1e-9 * rest);
    let length = if length > least { length } else { least };
    let inverse = 1.0 / length;
    let t = map_lanes(|i| d[i] * inverse);
    let inverse_rest = 1.0 / rest;
    let (stretch, let_out) = (length * inverse_rest, asked.elements.rate[n] * winding);
    let faster = dot(t, dv);
    let rate = (faster - stretch * let_out) * inverse_rest;
    let strain = stretch - 1.0 - asked.free[n];
    let height = 0.5 * (asked.x[2][n] + asked.x[2][n + 1]);
    let [first, second] = [pressure(asked, n, height, gravity), pressure(asked, n + 1, height, gravity)];
    let pressed = 0.5 * (first.0 + second.0) * asked.outside[n] - (asked.inside[n] - asked.contents[n] * height);
    let by_height = 0.5 * (first.1 + second.1) * asked.outside[n] + asked.contents[n];
    // a line that does not resist being shortened has neither stiffness nor damping while it is, and its damper does not push
    let still = asked.elements.ea[n] * ease * strain + pressed;
    let whole = still + asked.elements.damping[n] * rate;
    let there = if still < 0.0 || whole < 0.0 { asked.elements.pushes[n] * own + all } else { 1.0 };
    let (by_strain, by_rate) = (asked.elements.ea[n] * ease * there, asked.elements.damping[n] * there);
    let value = whole * there;
    let lifted = 0.5 * k * by_height * there;
    let geometric = k * value * inverse;
    let damped = by_rate * inverse_rest;
    let along = k * (by_strain - by_rate * let_out * inverse_rest) * inverse_rest - geometric + c * damped;
    let swung = k * damped * inverse;
    let stiff = map_lanes(|i| t[i] * along + (dv[i] - t[i] * faster) * swung);

    let made = AxialState { t, inverse, value, geometric, stiff, lifted };
    assemble_half::<TANGENT, 0>(asked, n, how, &made, shares);
    assemble_half::<TANGENT, 1>(asked, n, how, &made, shares);
}

/// Pressure (Pa) in the water about a node at a height, and its slope: as [`FluidState::pressure`](super::environment::FluidState::pressure).
#[inline(always)]
fn pressure(asked: &BatchInput, node: usize, height: f64, gravity: f64) -> (f64, f64) {
    let (weight, head) = (asked.density[node] * gravity, asked.head[node]);
    let depth = asked.surface[node] - height;
    let (column, share) = if head < depth { (depth + head, 1.0) } else { (2.0 * depth, 2.0) };
    if column > 0.0 { (weight * column, -weight * share) } else { (0.0, 0.0) }
}

/// Axial state of an element: direction and inverse of its length, tension, tension over length, and its stiffness by the other node
/// and by the height of one.
struct AxialState {
    t: [f64; 3],
    inverse: f64,
    value: f64,
    geometric: f64,
    stiff: [f64; 3],
    lifted: f64,
}

/// One half of it, with its inertia, weight and water. A loop over both would keep the elements from going side by side.
#[inline(always)]
fn assemble_half<const TANGENT: bool, const SECOND: usize>(
    asked: &BatchInput,
    n: usize,
    &BatchTerms { weights: Weights { k, c, m }, gravity, .. }: &BatchTerms,
    &AxialState { t, inverse, value, geometric, stiff, lifted }: &AxialState,
    shares: &mut BatchTangent,
) {
    let (node, mass, volume) = (n + SECOND, asked.elements.mass[n], asked.elements.volume[n]);
    let sign = if SECOND == 0 { 1.0 } else { -1.0 };
    let density = asked.density[node];
    let u = map_lanes(|i| asked.v[i][node] - asked.flow[i][node]);
    let q = map_lanes(|i| asked.a[i][node] - asked.water[i][node]);
    let flow = dot(u, t);
    let across = map_lanes(|i| u[i] - t[i] * flow);
    let speed = dot(across, across).sqrt();
    let per_speed = density * asked.elements.drag[0][n];
    let (normal, tangential) = (per_speed * speed, density * asked.elements.drag[1][n] * flow.abs());
    let (own, more) =
        (density * asked.elements.added[0][n], density * (asked.elements.added[1][n] - asked.elements.added[0][n]));
    let displaced = density * volume;
    let q_along = dot(q, t);
    let pulled = tangential * flow + more * q_along;
    let weight = [0.0, 0.0, (mass - displaced) * gravity];
    let by_t = pulled - sign * value;
    for i in 0..3 {
        let inert = asked.a[i][node] * mass - asked.water[i][node] * displaced;
        shares.force[SECOND][i][n] = across[i] * normal + t[i] * by_t + q[i] * own + inert + weight[i];
    }
    if TANGENT {
        let along_stiff = 2.0 * tangential - normal;
        // (I - T) |un| + A / |un|, the last of which is none at rest
        let curved = per_speed / (speed + MIN_FLOW_SPEED);
        // d(across)/dt = -(t u' + (u.t) I); d|across| = -(u.t) across.dt / |across|
        let unit = pulled - normal * flow;
        let turned = sign * k * inverse;
        let by_turn = |i: usize| across[i] * along_stiff + (q[i] - t[i] * q_along) * more - t[i] * unit;
        // of the height of either node it has as much
        let rise = sign * lifted;
        let w = map_lanes(|i| by_turn(i) * turned - stiff[i] - if i == 2 { rise } else { 0.0 });
        let (other, both) = (&mut shares.other[SECOND], &mut shares.itself[SECOND]);
        let (other_a, other_unit) = (-(curved * flow * turned), unit * turned - geometric);
        let (both_t, both_a) = (c * along_stiff + m * more, c * curved);
        let both_unit = c * normal + m * (own + mass);
        row::<0>((other, both), n, (t, w, other_a, other_unit), (across, both_t, both_a, both_unit, -2.0 * rise));
        row::<1>((other, both), n, (t, w, other_a, other_unit), (across, both_t, both_a, both_unit, -2.0 * rise));
        row::<2>((other, both), n, (t, w, other_a, other_unit), (across, both_t, both_a, both_unit, -2.0 * rise));
    }
}

/// A row of the tangent: `t w'` and shares of A and of the unit matrix by the other node; shares of T, A, the unit matrix and `t z'` by
/// both.
#[inline(always)]
fn row<const I: usize>(
    (by_other, itself): (&mut [[Lanes; 3]; 3], &mut [[Lanes; 3]; 3]),
    n: usize,
    (t, w, other_a, other_unit): ([f64; 3], [f64; 3], f64, f64),
    (across, both_t, both_a, both_unit, both_up): ([f64; 3], f64, f64, f64, f64),
) {
    let (by_t, by_across, other_across) = (t[I] * both_t, across[I] * both_a, across[I] * other_a);
    let mut other = map_lanes(|j| t[I] * w[j] + across[j] * other_across);
    let mut both = map_lanes(|j| by_t * t[j] + by_across * across[j]);
    (other[I], both[I]) = (other[I] + other_unit, both[I] + both_unit);
    both[2] += t[I] * both_up;
    by_other[I][0][n] = other[0];
    by_other[I][1][n] = other[1];
    by_other[I][2][n] = other[2];
    itself[I][0][n] = both[0] - other[0];
    itself[I][1][n] = both[1] - other[1];
    itself[I][2][n] = both[2] - other[2];
}
