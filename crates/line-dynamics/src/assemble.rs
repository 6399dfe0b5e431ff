//! Assembly of the residual of a dynamic line and its Jacobian (the tangent stiffness with damping and mass terms), element by
//! element: tension, inertia, drag, bending, seabed friction at rest; then the loads at nodes (`nodal_loads`).

use super::bend::hinge;
use super::element_batch::count_batchable;
use super::environment::LineEnvironment;
use super::hinges::spatial_hinges;
use super::mesh::{Rod, RodElement};
use super::morison::{half_load, slam_load, water_entry, wet_share, wind_load};
use super::nodal_loads::add_nodal_loads;
use super::statics_friction::{NodeFriction, seabed_friction};
use super::stick_friction::{StickFriction, stick_friction};
use super::system::{RodSystem, Weights};
use super::tension::{ElementStretch, ElementTension, tension};
use super::trial::{StaticFriction, Trial};
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// Where one element is, and which way it points.
struct ElementAxis {
    /// Its number.
    i: usize,
    /// Its direction.
    t: Vector3<f64>,
    /// Its length (m) and the inverse.
    length: f64,
    inverse: f64,
}

impl ElementAxis {
    #[inline(always)]
    fn from_trial(rod: &Rod, trial: &Trial, i: usize) -> Self {
        let d = trial.x[i + 1] - trial.x[i];
        // nodes of a slack heap may meet: their element then has no direction, and no tension to need one
        let length = d.norm().max(1e-9 * rod.elements[i].rest);
        ElementAxis { i, t: d / length, length, inverse: 1.0 / length }
    }
}

/// Residual of an element on its two nodes, and its tangent: first or second node by first or second.
struct ElementTangent {
    fa: Vector3<f64>,
    fb: Vector3<f64>,
    aa: Matrix3<f64>,
    ab: Matrix3<f64>,
    ba: Matrix3<f64>,
    bb: Matrix3<f64>,
}

/// Adds residual and tangent of the elements of a range, and of the nodes they touch.
///
/// Without `TANGENT` the residual alone.
pub(super) fn assemble<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    rod: &Rod,
    world: &LineEnvironment,
    trial: &Trial,
    weights: Weights,
    range: Range<usize>,
    system: &mut RodSystem<W, H, S>,
) {
    let gravity = world.gravity;
    let mut i = range.start;
    while i < range.end {
        let count = count_batchable(rod, trial, i..range.end);
        if count > 0 {
            system.batch.assemble_batch::<TANGENT>(rod, trial, weights, gravity, i, count);
            system.shares::<TANGENT>(i, count);
            i += count;
            continue;
        }
        let (element, edge) = (&rod.elements[i], ElementAxis::from_trial(rod, trial, i));
        let mut share = axial(rod, element, trial, weights, &edge, gravity);
        add_water_load::<TANGENT>(element, trial, weights, &edge, world, &mut share);
        system.push(i, &share.fa);
        system.push(i + 1, &share.fb);
        system.block::<TANGENT>(i, i, &share.aa);
        system.block::<TANGENT>(i, i + 1, &share.ab);
        system.block::<TANGENT>(i + 1, i, &share.ba);
        system.block::<TANGENT>(i + 1, i + 1, &share.bb);
        i += 1;
    }
    if let Some(side) = trial.friction.pulled_end() {
        for i in range.clone() {
            let Some(NodeFriction { node, force, by, .. }) = seabed_friction(rod, world, trial, i, side) else {
                continue;
            };
            let (own, other) = (node, if node == i { i + 1 } else { i });
            system.push(own, &-force);
            system.block::<TANGENT>(own, own, &(by[0] * -weights.k));
            system.block::<TANGENT>(own, other, &(by[1] * -weights.k));
        }
    }
    if trial.friction == StaticFriction::Stick {
        for node in range.start..=range.end {
            let Some(StickFriction { force, by, .. }) = stick_friction(rod, world, trial, node) else { continue };
            system.push(node, &-force);
            system.block::<TANGENT>(node, node, &(by * -weights.k));
        }
    }
    if !trial.softening.tension_only && rod.elements[range.clone()].iter().any(|e| e.bending > 0.0) {
        let mut before: Option<(Vector3<f64>, f64)> = None;
        for i in range.clone() {
            let edge = ElementAxis::from_trial(rod, trial, i);
            if rod.elements[i].bending > 0.0 {
                if W == 4 {
                    for (sides, gradient, matrix) in spatial_hinges(rod, trial, i) {
                        system.hinge::<TANGENT>(sides, weights.k, &gradient, &matrix);
                    }
                } else {
                    bending::<TANGENT, W, H, S>(rod, trial, weights.k, &edge, before, system);
                }
            }
            before = Some((edge.t, edge.length));
        }
    }
    if W == 4 && TANGENT {
        for i in range.start..=range.end {
            // nothing else holds the turn of a rod that is free to spin: a thousand-millionth of its own stiffness does; the last node
            // has no element behind it, nor a turn
            let held = match rod.elements.get(i) {
                Some(e) if e.torsion > 0.0 => 1e-9 * e.torsion / e.rest,
                _ => 1.0,
            };
            system.band.add(W * i + 3, W * i + 3, held);
        }
    }
    add_nodal_loads::<TANGENT, W, H, S>(rod, world, trial, weights, range, system);
}

/// Tension, weight and inertia.
#[inline(always)]
fn axial(
    rod: &Rod,
    element: &RodElement,
    trial: &Trial,
    Weights { k, c, m }: Weights,
    edge: &ElementAxis,
    gravity: f64,
) -> ElementTangent {
    let ElementAxis { i, t, length, inverse } = edge;
    let (xa, xb) = (&trial.x[*i], &trial.x[i + 1]);
    let inverse_rest = 1.0 / element.rest;
    let stretch = length * inverse_rest;
    let dv = trial.v[i + 1] - trial.v[*i];
    let let_out = if trial.is_static { 0.0 } else { element.rate };
    let rate = (t.dot(&dv) - stretch * let_out) * inverse_rest;
    let taken = trial.tension_options(element);
    let stretched = ElementStretch { strain: stretch - 1.0, rate, height: 0.5 * (xa.z + xb.z), datum: trial.origin.z };
    let memory = trial.memory.get(*i);
    let ElementTension { value, by_strain, by_rate, by_height } =
        tension(rod, element, taken, &stretched, memory, [*i, i + 1].map(|node| &trial.fluid[node]), gravity);
    let force = t * value;
    let geometric = k * value * inverse;
    let damped = by_rate * inverse_rest;
    // by the difference of positions, and of velocities through c
    let along = k * (by_strain - by_rate * let_out * inverse_rest) * inverse_rest - geometric + c * damped;
    let mut stiff = t * t.transpose() * along;
    for j in 0..3 {
        stiff[(j, j)] += geometric;
    }
    if damped > 0.0 {
        let across = dv - t * t.dot(&dv);
        stiff += t * (across * (k * damped * inverse)).transpose();
    }
    let mut share = ElementTangent {
        fa: trial.a[*i] * element.mass - force,
        fb: trial.a[i + 1] * element.mass + force,
        aa: stiff,
        ab: -stiff,
        ba: -stiff,
        bb: stiff,
    };
    if by_height != 0.0 {
        let column = t * (0.5 * k * by_height);
        for (block, sign) in [(&mut share.aa, -1.0), (&mut share.ab, -1.0), (&mut share.ba, 1.0), (&mut share.bb, 1.0)]
        {
            let mut third = block.column_mut(2);
            third += column * sign;
        }
    }
    share.fa.z += element.mass * gravity;
    share.fb.z += element.mass * gravity;
    for j in 0..3 {
        share.aa[(j, j)] += m * element.mass;
        share.bb[(j, j)] += m * element.mass;
    }
    share
}

/// The water and the wind on each half.
#[inline(always)]
fn add_water_load<const TANGENT: bool>(
    element: &RodElement,
    trial: &Trial,
    weights: Weights,
    edge: &ElementAxis,
    LineEnvironment { gravity, slam, .. }: &LineEnvironment,
    sum: &mut ElementTangent,
) {
    let Weights { k, c, m } = weights;
    let ElementAxis { i, t, inverse, .. } = edge;
    let depth = |node: usize| trial.fluid[node].surface - trial.x[node].z;
    let (sa, sb) = (depth(*i), depth(i + 1));
    let middle = 0.5 * (sa + sb);
    for second in [false, true] {
        let (node, own) = if second { (i + 1, sb) } else { (*i, sa) };
        let fluid = &trial.fluid[node];
        let (share, by_own, by_middle) = wet_share(own, middle, element.diameter);
        if (share > 0.0 || by_own != 0.0) && fluid.density > 0.0 {
            let load = half_load(element, t, fluid, &trial.v[node], &trial.a[node], *gravity);
            let turned = (load.by_direction - (load.by_direction * t) * t.transpose()) * (k * share * inverse);
            let moved = load.by_velocity * (c * share) + load.by_acceleration * (m * share);
            sum.add_half_load(second, &(load.force * share), &turned, &moved);
            if by_own != 0.0 || by_middle != 0.0 {
                // depth below the surface falls as a node rises
                let (to_own, to_other) = (-(by_own + 0.5 * by_middle), -0.5 * by_middle);
                sum.add_lift(second, &load.force, [k * to_own, k * to_other]);
                if *slam && !trial.is_static {
                    sum.add::<TANGENT>(&add_slam_load(element, trial, weights, edge, [own, middle], second));
                }
            }
        }
        if share < 1.0 && fluid.air_density * element.wind > 0.0 {
            sum.add::<TANGENT>(&add_wind_load(element, trial, weights, edge, (share, by_own, by_middle), second));
        }
    }
}

/// The wind on a half with that wet share, and its slopes by the depths of its own node and of the middle.
#[inline(never)]
fn add_wind_load(
    element: &RodElement,
    trial: &Trial,
    Weights { k, c, .. }: Weights,
    edge: &ElementAxis,
    (share, by_own, by_middle): (f64, f64, f64),
    second: bool,
) -> ElementTangent {
    let ElementAxis { i, t, inverse, .. } = edge;
    let mut sum = ElementTangent::zero();
    let node = if second { i + 1 } else { *i };
    let load = wind_load(element, t, &trial.fluid[node], &trial.v[node]);
    let dry = 1.0 - share;
    let turned = (load.by_direction - (load.by_direction * t) * t.transpose()) * (k * dry * inverse);
    sum.add_half_load(second, &(load.force * dry), &turned, &(load.by_velocity * (c * dry)));
    sum.add_lift(second, &load.force, [k * (by_own + 0.5 * by_middle), k * 0.5 * by_middle]);
    sum
}

/// The slam on a half whose own node and middle lie that far below the surface (m).
#[inline(never)]
fn add_slam_load(
    element: &RodElement,
    trial: &Trial,
    Weights { k, c, .. }: Weights,
    edge: &ElementAxis,
    [own, middle]: [f64; 2],
    second: bool,
) -> ElementTangent {
    let ElementAxis { i, t, inverse, .. } = edge;
    let mut sum = ElementTangent::zero();
    let (node, other) = if second { (i + 1, *i) } else { (*i, i + 1) };
    let rising = [node, other].map(|n| trial.v[n].z - trial.fluid[n].velocity.z);
    let Some(entry) = water_entry(own, middle, element.diameter, rising) else { return sum };
    let (fluid, v) = (&trial.fluid[node], &trial.v[node]);
    let load = slam_load(element, t, fluid, v, entry.rate);
    let turned = (load.by_direction - (load.by_direction * t) * t.transpose()) * (k * inverse);
    sum.add_half_load(second, &load.force, &turned, &(load.by_velocity * c));
    let by_rate = load.force / entry.rate;
    sum.add_lift(second, &by_rate, [0, 1].map(|n| k * entry.by_height[n] + c * entry.by_velocity[n]));
    sum
}

impl ElementTangent {
    fn zero() -> Self {
        let (force, block) = (Vector3::zeros(), Matrix3::zeros());
        ElementTangent { fa: force, fb: force, aa: block, ab: block, ba: block, bb: block }
    }

    /// Adds another. What is not asked for is left alone, so that it need not be known.
    #[inline(always)]
    fn add<const TANGENT: bool>(&mut self, other: &ElementTangent) {
        self.fa += other.fa;
        self.fb += other.fb;
        if TANGENT {
            self.aa += other.aa;
            self.ab += other.ab;
            self.ba += other.ba;
            self.bb += other.bb;
        }
    }

    /// Adds a load of one half, with its tangent by the direction of the element and by the motion of its node.
    #[inline(always)]
    fn add_half_load(&mut self, second: bool, force: &Vector3<f64>, turned: &Matrix3<f64>, moved: &Matrix3<f64>) {
        if second {
            self.fb += force;
            self.ba -= turned;
            self.bb += turned + moved;
        } else {
            self.fa += force;
            self.aa += moved - turned;
            self.ab += turned;
        }
    }

    /// Adds the tangent of a load of one half that grows in proportion as its own node rises, and the other.
    #[inline(always)]
    fn add_lift(&mut self, second: bool, force: &Vector3<f64>, [by_own, by_other]: [f64; 2]) {
        let (own, other) = if second { (&mut self.bb, &mut self.ba) } else { (&mut self.aa, &mut self.ab) };
        let mut third = own.column_mut(2);
        third += force * by_own;
        let mut third = other.column_mut(2);
        third += force * by_other;
    }
}

/// The hinge before an element, and those of the ends beside it.
fn bending<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    rod: &Rod,
    trial: &Trial,
    k: f64,
    edge: &ElementAxis,
    before: Option<(Vector3<f64>, f64)>,
    system: &mut RodSystem<W, H, S>,
) {
    let ElementAxis { i, t, length, .. } = edge;
    let (i, last) = (*i, rod.elements.len() - 1);
    if let Some((e, le)) = before {
        let h = hinge(rod.hinge(i), &e, le, t, *length);
        let [ee, ef, ff] = h.curvature.map(|c| c * k);
        let [de, df] = h.gradient;
        system.push(i - 1, &-de);
        system.push(i, &(de - df));
        system.push(i + 1, &df);
        let fe = ef.transpose();
        system.block::<TANGENT>(i - 1, i - 1, &ee);
        system.block::<TANGENT>(i - 1, i, &(ef - ee));
        system.block::<TANGENT>(i - 1, i + 1, &-ef);
        system.block::<TANGENT>(i, i - 1, &(fe - ee));
        system.block::<TANGENT>(i, i, &(ee + ff - ef - fe));
        system.block::<TANGENT>(i, i + 1, &(ef - ff));
        system.block::<TANGENT>(i + 1, i - 1, &-fe);
        system.block::<TANGENT>(i + 1, i, &(fe - ff));
        system.block::<TANGENT>(i + 1, i + 1, &ff);
    }
    for (side, at) in [(0, 0), (1, last)] {
        if i == at
            && let Some((stiffness, direction)) = trial.ends[side].hinge(&rod.elements[i])
        {
            let h = hinge(stiffness, &direction, 1.0, t, *length);
            let ff = h.curvature[2] * k;
            system.push(i, &-h.gradient[1]);
            system.push(i + 1, &h.gradient[1]);
            system.block::<TANGENT>(i, i, &ff);
            system.block::<TANGENT>(i, i + 1, &-ff);
            system.block::<TANGENT>(i + 1, i, &-ff);
            system.block::<TANGENT>(i + 1, i + 1, &ff);
        }
    }
}
