//! Residual and tangent of a whole rod: one pass over its elements.

use super::band::Band;
use super::bend::hinge;
use super::contact::contact;
use super::ends::End;
use super::immersed::{half_load, wet_share};
use super::spatial::{Eight, Side, spatial, transport};
use super::mesh::{Element, Rod};
use super::surroundings::{Fluid, World};
use nalgebra::{Matrix3, SMatrix, Vector3};
use std::ops::Range;

/// A trial motion of all nodes at one time, with what surrounds them.
#[derive(Clone, Debug)]
pub(super) struct Trial {
    pub time: f64,
    pub x: Vec<Vector3<f64>>,
    pub v: Vec<Vector3<f64>>,
    pub a: Vec<Vector3<f64>>,
    pub fluid: Vec<Fluid>,
    /// Direction of the rod at each node at the start of the step, for friction.
    pub lay: Vec<Vector3<f64>>,
    /// Penetration over which the bottom's stiffness grows at each node (m).
    pub soft: Vec<f64>,
    pub ends: [End; 2],
    /// Whether it is taken as a chain, without resistance to shortening and bending: on the way to a position of rest.
    pub loose: bool,
    /// Directors of the elements of a rod with torsion.
    pub director: Vec<Vector3<f64>>,
}

/// How velocity and acceleration follow the unknown positions: the tangent is k K + c C + m M.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    pub k: f64,
    pub c: f64,
    pub m: f64,
}

/// Residual (what the nodes need from outside, N) and its tangent; `W` unknowns a node.
#[derive(Clone, Debug)]
pub(super) struct System<const W: usize, const H: usize, const S: usize> {
    pub band: Band<H, S>,
    pub residual: Vec<f64>,
    /// Residual of the two end nodes.
    pub ends: [Vector3<f64>; 2],
    /// Rows of the two end nodes.
    rows: [[[f64; S]; 3]; 2],
}

impl<const W: usize, const H: usize, const S: usize> System<W, H, S> {
    pub fn new(nodes: usize) -> Self {
        System {
            band: Band::new(W * nodes),
            residual: vec![0.0; W * nodes],
            ends: [Vector3::zeros(); 2],
            rows: [[[0.0; S]; 3]; 2],
        }
    }

    pub fn clear(&mut self) {
        self.band.clear();
        self.residual.fill(0.0);
    }

    #[inline(always)]
    fn push(&mut self, node: usize, force: &Vector3<f64>) {
        let r = &mut self.residual[W * node..W * node + 3];
        r[0] += force.x;
        r[1] += force.y;
        r[2] += force.z;
    }

    #[inline(always)]
    fn block<const TANGENT: bool>(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        if TANGENT {
            self.band.add_block(W * row, W * column, block);
        }
    }

    /// Unknowns a node.
    pub fn stride(&self) -> usize {
        W
    }

    /// Adds a spatial hinge between two elements, or an element and a holder.
    fn hinge<const TANGENT: bool>(&mut self, sides: [Option<usize>; 2], k: f64, gradient: &Eight, matrix: &SMatrix<f64, 8, 8>) {
        // each of the eight unknowns by those of the nodes: an edge is its second node less its first
        let places = |local: usize| -> [Option<(usize, f64)>; 2] {
            let side = if local < 6 { local / 3 } else { local - 6 };
            match sides[side] {
                None => [None, None],
                Some(i) if local < 6 => [Some((W * (i + 1) + local % 3, 1.0)), Some((W * i + local % 3, -1.0))],
                Some(i) => [Some((W * i + 3, 1.0)), None],
            }
        };
        for a in 0..8 {
            for (row, sign) in places(a).into_iter().flatten() {
                self.residual[row] += sign * gradient[a];
                if TANGENT {
                    for b in 0..8 {
                        for (column, other) in places(b).into_iter().flatten() {
                            self.band.add(row, column, sign * other * k * matrix[(a, b)]);
                        }
                    }
                }
            }
        }
    }

    /// Keeps the rows of the end nodes.
    pub fn keep_rows(&mut self) {
        let last = self.residual.len() / W - 1;
        for (side, node) in [(0, 0), (1, last)] {
            for i in 0..3 {
                self.rows[side][i] = *self.band.row(W * node + i);
            }
        }
    }

    /// Keeps the residual of the end nodes.
    pub fn keep_ends(&mut self) {
        let last = self.residual.len() / W - 1;
        for (side, node) in [(0, 0), (1, last)] {
            self.ends[side] = self.residual_at(node);
        }
    }

    /// Product of the kept rows of an end with a change of all unknowns.
    pub fn ends_by(&self, side: usize, change: &[f64]) -> Vector3<f64> {
        let node = if side == 0 { 0 } else { self.residual.len() / W - 1 };
        Vector3::from_fn(|i, _| Band::<H, S>::product(&self.rows[side][i], W * node + i, change))
    }

    /// Takes the kept residuals on to changed unknowns.
    pub fn carry_ends(&mut self, change: &[f64]) {
        for side in [0, 1] {
            self.ends[side] += self.ends_by(side, change);
        }
    }

    /// Residual of a node as a vector.
    pub fn residual_at(&self, node: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.residual[W * node..W * node + 3])
    }

    /// The block that couples a node's residual to another's position.
    #[cfg(test)]
    pub fn block_at(&self, row: usize, column: usize) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| self.band.get(W * row + i, W * column + j))
    }
}

/// Tension of an element (N) with its derivatives by strain, by strain rate and by the height of its middle.
pub(super) struct Tension {
    pub value: f64,
    pub by_strain: f64,
    pub by_rate: f64,
    pub by_height: f64,
}

/// Effective tension: the law of the segment at the mechanical strain, internal damping, and what pressure does through Poisson's
/// ratio, (1 - 2 nu)(p_e A_e - p_i A_i) (Sparks, Fundamentals of Marine Riser Mechanics, 2007, section 2.4).
#[inline(always)]
#[expect(clippy::too_many_arguments, reason = "the tension of an element has that many causes")]
pub(super) fn tension(
    rod: &Rod,
    element: &Element,
    compression: bool,
    strain: f64,
    rate: f64,
    height: f64,
    fluid: &Fluid,
    gravity: f64,
) -> Tension {
    let segment = &rod.segments[element.segment];
    let free = segment.tube.as_ref().map_or(0.0, |t| t.expansion * t.warmer);
    let mechanical = strain - free;
    if mechanical < 0.0 && !compression {
        return Tension { value: 0.0, by_strain: 0.0, by_rate: 0.0, by_height: 0.0 };
    }
    let (value, by_strain) =
        if element.ea > 0.0 { (element.ea * mechanical, element.ea) } else { segment.axial.at(mechanical) };
    let mut made =
        Tension { value: value + element.damping * rate, by_strain, by_rate: element.damping, by_height: 0.0 };
    if let Some(tube) = &segment.tube {
        let share = 1.0 - 2.0 * tube.poisson;
        let [outside, inside] = tube.areas();
        let outer = fluid.density * gravity * (fluid.surface - height).max(0.0);
        let inner = tube.pressure + tube.contents * gravity * (tube.at - height);
        made.value += share * (outer * outside - inner * inside);
        let wet = if height < fluid.surface { fluid.density } else { 0.0 };
        made.by_height = share * gravity * (tube.contents * inside - wet * outside);
    }
    made
}

/// Adds residual and tangent of the elements of a range, and of the nodes they touch.
///
/// Without `TANGENT` the residual alone.
pub(super) fn assemble<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    rod: &Rod,
    world: &World,
    trial: &Trial,
    weights: Weights,
    range: Range<usize>,
    system: &mut System<W, H, S>,
) {
    let Weights { k, c, m } = weights;
    let last = rod.elements.len() - 1;
    let gravity = world.gravity;
    let mut before: Option<(Vector3<f64>, f64)> = None;
    for i in range.clone() {
        let element = &rod.elements[i];
        let (xa, xb) = (&trial.x[i], &trial.x[i + 1]);
        let (va, vb) = (&trial.v[i], &trial.v[i + 1]);
        let d = xb - xa;
        let length = d.norm();
        let t = d / length;
        let inverse = 1.0 / length;

        // axial
        let inverse_rest = 1.0 / element.rest;
        let stretch = length * inverse_rest;
        let dv = vb - va;
        let rate = (t.dot(&dv) - stretch * element.rate) * inverse_rest;
        let compression = element.compression && !trial.loose;
        let pull = tension(rod, element, compression, stretch - 1.0, rate, 0.5 * (xa.z + xb.z), &trial.fluid[i], gravity);
        let force = t * pull.value;
        let outer = t * t.transpose();
        let geometric = k * pull.value * inverse;
        let damped = pull.by_rate * inverse_rest;
        // by the difference of positions, and of velocities through c
        let mut stiff =
            outer * (k * (pull.by_strain - pull.by_rate * element.rate * inverse_rest) * inverse_rest - geometric + c * damped);
        for j in 0..3 {
            stiff[(j, j)] += geometric;
        }
        if damped > 0.0 {
            let across = dv - t * t.dot(&dv);
            stiff += t * (across * (k * damped * inverse)).transpose();
        }
        system.push(i, &-force);
        system.push(i + 1, &force);
        let (mut aa, mut ab, mut ba, mut bb) = (stiff, -stiff, -stiff, stiff);
        if pull.by_height != 0.0 {
            let column = t * (0.5 * k * pull.by_height);
            for (block, sign) in [(&mut aa, -1.0), (&mut ab, -1.0), (&mut ba, 1.0), (&mut bb, 1.0)] {
                let mut third = block.column_mut(2);
                third += column * sign;
            }
        }

        // weight and inertia
        let inertia = element.mass;
        let mut fa = trial.a[i] * inertia;
        let mut fb = trial.a[i + 1] * inertia;
        fa.z += inertia * gravity;
        fb.z += inertia * gravity;
        for j in 0..3 {
            aa[(j, j)] += m * inertia;
            bb[(j, j)] += m * inertia;
        }

        // the fluid on each half
        let (sa, sb) = (trial.fluid[i].surface - xa.z, trial.fluid[i + 1].surface - xb.z);
        let middle = 0.5 * (sa + sb);
        for second in [false, true] {
            let (node, s) = if second { (i + 1, sb) } else { (i, sa) };
            let fluid = &trial.fluid[node];
            let (share, by_own, by_middle) = wet_share(s, middle, element.diameter);
            if (share <= 0.0 && by_own == 0.0) || fluid.density <= 0.0 {
                continue;
            }
            let load = half_load(element, &t, fluid, &trial.v[node], &trial.a[node], gravity);
            let turned = (load.by_direction - (load.by_direction * t) * t.transpose()) * (k * share * inverse);
            let moved = load.by_velocity * (c * share) + load.by_acceleration * (m * share);
            if second {
                fb += load.force * share;
                ba -= turned;
                bb += turned + moved;
            } else {
                fa += load.force * share;
                aa += moved - turned;
                ab += turned;
            }
            if by_own != 0.0 || by_middle != 0.0 {
                // depth below the surface falls as a node rises
                let (to_own, to_other) = (-(by_own + 0.5 * by_middle), -0.5 * by_middle);
                let (by_a, by_b) = if second { (to_other, to_own) } else { (to_own, to_other) };
                let (first, other) = if second { (&mut ba, &mut bb) } else { (&mut aa, &mut ab) };
                let mut third = first.column_mut(2);
                third += load.force * (k * by_a);
                let mut third = other.column_mut(2);
                third += load.force * (k * by_b);
            }
        }
        system.push(i, &fa);
        system.push(i + 1, &fb);
        system.block::<TANGENT>(i, i, &aa);
        system.block::<TANGENT>(i, i + 1, &ab);
        system.block::<TANGENT>(i + 1, i, &ba);
        system.block::<TANGENT>(i + 1, i + 1, &bb);

        // bending
        if element.bending > 0.0 && !trial.loose {
            if W == 4 {
                for (sides, gradient, matrix) in spatial_hinges(rod, trial, i) {
                    system.hinge::<TANGENT>(sides, k, &gradient, &matrix);
                }
            } else if let Some((e, le)) = before {
                let stiffness = rod.hinge(i);
                if stiffness > 0.0 {
                    let h = hinge(stiffness, &e, le, &t, length);
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
            }
            for (side, at) in [(0, 0), (1, last)] {
                if W == 3
                    && i == at
                    && let Some((stiffness, direction)) = trial.ends[side].hinge(element)
                {
                    let h = hinge(stiffness, &direction, 1.0, &t, length);
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
        before = Some((t, length));
    }
    if W == 4 && TANGENT {
        for i in range.start..=range.end {
            // nothing else holds the turn of a rod that is free to spin: a thousand-millionth of its own stiffness does
            let held = rod.elements.get(i).map_or(1.0, |e| if e.torsion > 0.0 { 1e-9 * e.torsion / e.rest } else { 1.0 });
            system.band.add(W * i + 3, W * i + 3, held);
        }
    }
    nodes::<TANGENT, W, H, S>(rod, world, trial, weights, range, system);
}

/// One hinge: the elements on its two sides, its gradient and stiffness.
type SpatialHinge = ([Option<usize>; 2], Eight, SMatrix<f64, 8, 8>);

/// The sides of the hinge before an element of a rod with torsion, or of that at an end beside it, with its two stiffnesses.
pub(super) fn hinge_sides(rod: &Rod, x: &[Vector3<f64>], directors: &[Vector3<f64>], ends: &[End; 2], hinge: HingeAt) -> Option<(f64, f64, Side, Side)> {
    let last = rod.elements.len();
    let side = |i: usize, natural: [f64; 2]| {
        let d = x[i + 1] - x[i];
        Side { direction: d.normalize(), length: d.norm(), director: directors[i], natural }
    };
    let held = |end: &End, i: usize, natural: [f64; 2]| {
        let element = &rod.elements[i];
        let (k, direction) = end.hinge(element)?;
        let across = end.side.and_then(|s| (s - direction * direction.dot(&s)).try_normalize(1e-9));
        let near = side(i, natural);
        let director = across.unwrap_or_else(|| transport(&near.director, &near.direction, &direction));
        let kt = if across.is_some() { 2.0 * element.torsion / element.rest } else { 0.0 };
        Some((k, kt, Side { direction, length: 1.0, director, natural }))
    };
    match hinge {
        HingeAt::Inner(i) => {
            let natural = rod.bent(i);
            Some((rod.hinge(i), rod.twist_hinge(i), side(i - 1, natural[0]), side(i, natural[1])))
        }
        HingeAt::A => {
            let natural = rod.bent(0);
            let (k, kt, holder) = held(&ends[0], 0, natural[0])?;
            Some((k, kt, holder, side(0, natural[1])))
        }
        HingeAt::B => {
            let natural = rod.bent(last);
            let (k, kt, holder) = held(&ends[1], last - 1, natural[1])?;
            Some((k, kt, side(last - 1, natural[0]), holder))
        }
    }
}

/// Where a hinge is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum HingeAt {
    /// Between end A's holder and the first element.
    A,
    /// At an inner node.
    Inner(usize),
    /// Between the last element and end B's holder.
    B,
}

/// The hinges to be added with element `i`: the one before it, and those of the ends beside it.
fn spatial_hinges(rod: &Rod, trial: &Trial, i: usize) -> impl Iterator<Item = SpatialHinge> {
    let last = rod.elements.len();
    let inner = (i > 0).then_some((HingeAt::Inner(i), [Some(i.wrapping_sub(1)), Some(i)]));
    let first = (i == 0).then_some((HingeAt::A, [None, Some(0)]));
    let end = (i + 1 == last).then_some((HingeAt::B, [Some(i), None]));
    [first, inner, end].into_iter().flatten().filter_map(|(at, sides)| {
        let (k, kt, e, f) = hinge_sides(rod, &trial.x, &trial.director, &trial.ends, at)?;
        let (gradient, matrix) = spatial(k, kt, &e, &f);
        Some((sides, gradient, matrix))
    })
}

/// What acts on nodes: the bottom, attachments, given forces.
fn nodes<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    rod: &Rod,
    world: &World,
    trial: &Trial,
    Weights { k, c, m }: Weights,
    range: Range<usize>,
    system: &mut System<W, H, S>,
) {
    if let Some((bottom, ground)) = &world.bottom {
        for node in range.start..=range.end {
            let left = if node > 0 { rod.elements[node - 1].contact } else { 0.0 };
            let right = rod.elements.get(node).map_or(0.0, |e| e.contact);
            let (x, v) = (&trial.x[node], &trial.v[node]);
            if let Some(made) = contact(*bottom, ground, trial.soft[node], left + right, x, v, &trial.lay[node]) {
                system.push(node, &-(made.force[0] + made.force[1]));
                system.block::<TANGENT>(node, node, &(made.by_position * -k - made.by_velocity * c));
            }
        }
    }
    for held in rod.attachments.iter().filter(|a| (range.start..=range.end).contains(&a.node)) {
        let node = held.node;
        let fluid = &trial.fluid[node];
        let depth = fluid.surface - trial.x[node].z;
        let (share, by_own, by_same) = wet_share(depth, depth, held.height);
        let (u, q) = (trial.v[node] - fluid.velocity, trial.a[node] - fluid.acceleration);
        let speed = u.norm();
        let (drag, water) = (0.5 * fluid.density * held.drag, fluid.density * held.volume);
        let mut wet = u * (drag * speed) + q * (water * held.added) - fluid.acceleration * water;
        wet.z -= water * world.gravity;
        let mut force = trial.a[node] * held.mass + wet * share;
        force.z += held.mass * world.gravity;
        let unit = if speed > 0.0 { u / speed } else { Vector3::zeros() };
        let mut block = unit * unit.transpose() * (c * share * drag * speed);
        for j in 0..3 {
            block[(j, j)] += c * share * drag * speed + m * (held.mass + share * water * held.added);
        }
        let mut third = block.column_mut(2);
        third -= wet * (k * (by_own + by_same));
        system.push(node, &force);
        system.block::<TANGENT>(node, node, &block);
    }
    for (node, force) in world.forces.iter().filter(|f| (range.start..=range.end).contains(&f.0)) {
        system.push(*node, &-force);
    }
}
