//! What is wanted of a rod at one time: tensions, moments, stresses along it.

use super::bend::hinge;
use super::contact::contact;
use super::ends::RodEnd;
use super::environment::{FluidState, LineEnvironment, Support, UniformFluid};
use super::hinges::{HingePlace, hinge_sides};
use super::local_environment::LocalEnvironment;
use super::mesh::Rod;
use super::morison::{HalfNode, half_force};
use super::spatial::{transport_director, twist};
use super::state::RodState;
use super::supports::{SupportForce, find_support_contact, support_load};
use super::tension::{ElementStretch, TensionOptions, tension};
use super::viscoelastic::MaxwellMemory;
use nalgebra::Vector3;
use windlass_model::{LineNode, LineSide, LineStress};

impl Rod {
    /// Results at every node of a state.
    ///
    /// Tension of a node is the mean of its two elements; where something is attached, the larger of those on its two
    /// sides; at an end it is what is left of that of the last element when the half of it beyond has been moved, borne
    /// and dragged along itself: all that the holder takes along the rod.
    /// Shear is the change of the moment over the elements beside a node.
    pub fn results(&self, state: &RodState, world: &LineEnvironment, ends: &[RodEnd; 2]) -> Vec<LineNode> {
        let near = LocalEnvironment::new(world, state.origin, Vec::new());
        let world = &near.world();
        let last = self.elements.len();
        let (x, v) = (&state.position, &state.velocity);
        let mut fluids = vec![UniformFluid::vacuum().0; x.len()];
        // tubes feel the pressure outside
        if self.segments.iter().any(|s| s.tube.is_some()) {
            world.fluid.sample_into(x, state.time, &mut fluids);
        }
        let beside = self.sample_fluid_near_ends(state, world);
        let fluid_at = |node: usize| world.fluid.sample(&x[node], state.time);
        let (edges, pulls): (Vec<(Vector3<f64>, f64)>, Vec<f64>) =
            (0..last).map(|i| self.element_force(i, state, [&fluids[i], &fluids[i + 1]], world.gravity)).unzip();
        // moment vector at each node, and the length it is spread over
        let moments: Vec<(Vector3<f64>, f64)> = (0..=last)
            .map(|i| {
                let (k, e, f, over) = if i > 0 && i < last {
                    let over = 0.5 * (self.elements[i - 1].rest + self.elements[i].rest);
                    (self.hinge(i), edges[i - 1].0, edges[i].0, over)
                } else {
                    let side = usize::from(i > 0);
                    let element = &self.elements[i.min(last - 1)];
                    match ends[side].hinge(element) {
                        Some((k, d)) if side == 0 => (k, d, edges[0].0, 0.5 * element.rest),
                        Some((k, d)) => (k, edges[last - 1].0, d, 0.5 * element.rest),
                        None => return (Vector3::zeros(), 1.0),
                    }
                };
                let axis = e.cross(&f).try_normalize(1e-300).unwrap_or_else(Vector3::zeros);
                let angle =
                    if k > 0.0 { hinge(k, &e, 1.0, &f, 1.0).angle } else { e.cross(&f).norm().atan2(e.dot(&f)) };
                (axis * (k * angle), if k > 0.0 { over } else { over.max(1e-300) })
            })
            .collect();
        let (moments, torques) =
            if self.twists() { self.spatial_moments(state, ends) } else { (moments, vec![0.0; last + 1]) };
        let across = transport_to_end(&edges, &ends[0]);
        let shears: Vec<Vector3<f64>> =
            (0..last).map(|i| (moments[i + 1].0 - moments[i].0) / self.elements[i].rest).collect();
        let mut arc = 0.0;
        (0..=last)
            .map(|i| {
                let inner = i > 0 && i < last;
                let effective = match (inner, i) {
                    (true, _) if self.is_loaded_node(i) => {
                        let near = [&fluid_at(i - 1), &fluid_at(i), &fluid_at(i + 1)];
                        self.tension_beside_node(
                            i,
                            state,
                            world,
                            near,
                            [(&edges[i - 1].0, pulls[i - 1]), (&edges[i].0, pulls[i])],
                        )
                    }
                    (true, _) => 0.5 * (pulls[i - 1] + pulls[i]),
                    (false, 0) => self.tension_at_end(0, state, world, &beside, (&edges[0].0, pulls[0])),
                    (false, _) => self.tension_at_end(1, state, world, &beside, (&edges[last - 1].0, pulls[last - 1])),
                };
                let shear = match (inner, i) {
                    (true, _) => 0.5 * (shears[i - 1] + shears[i]).norm(),
                    (false, 0) => toward_end(&shears, 0, 1).norm(),
                    (false, _) => toward_end(&shears, last - 1, last.wrapping_sub(2)).norm(),
                };
                let (bending, _) = moments[i];
                let beside = i.min(last - 1);
                let element = &self.elements[beside];
                let moment = bending.norm();
                let (director, direction) = (across[beside], edges[beside].0);
                // the softer of two segments bends more
                let softest = if inner { element.bending.min(self.elements[i - 1].bending) } else { element.bending };
                let first = if inner { self.elements[i - 1].segment } else { element.segment };
                let tube = |segment: usize| self.segments[segment].tube.as_ref();
                let pressures = tube(element.segment).or(tube(first)).map_or([0.0; 2], |tube| {
                    let (outer, _) = fluids[i].pressure(x[i].z, world.gravity);
                    [outer, tube.pressure + tube.contents * world.gravity * (tube.at - state.origin.z - x[i].z)]
                });
                let side = |segment: usize| {
                    let Some(tube) = tube(segment) else { return LineSide { segment, wall: effective, stress: None } };
                    let ([outer, inner], [outside, inside]) = (pressures, tube.areas());
                    let wall = effective - outer * outside + inner * inside;
                    LineSide { segment, wall, stress: Some(stress(wall, moment, pressures, tube)) }
                };
                let behind = side(element.segment);
                let made = LineNode {
                    arc,
                    segment: behind.segment,
                    position: x[i] + state.origin,
                    velocity: v[i],
                    effective,
                    wall: behind.wall,
                    shear,
                    moment,
                    bends: [bending.dot(&director), bending.dot(&direction.cross(&director))],
                    torque: torques[i],
                    curvature: if softest > 0.0 { moment / softest } else { curvature_at(&edges, &moments, i) },
                    clearance: clearance(world, &x[i]),
                    pressures,
                    stress: behind.stress,
                    before: (first != element.segment).then(|| side(first)),
                };
                arc += if i < last { element.rest } else { 0.0 };
                made
            })
            .collect()
    }

    /// What the rod does to each support of a world in a state.
    pub fn support_forces(&self, state: &RodState, world: &LineEnvironment) -> Vec<SupportForce> {
        let look = |support: &Support| {
            let clear = SupportForce { force: Vector3::zeros(), moment: Vector3::zeros(), arc: None };
            let Some(found) = find_support_contact(self.is_smooth(), support, &state.position) else { return clear };
            let mut node: f64 = self.elements.iter().take(found.node).map(|e| e.rest).sum();
            let mut arc = 0.0;
            for (share, element) in found.shares.iter().zip(&self.elements[found.node.min(self.elements.len())..]) {
                arc += share * node;
                node += element.rest;
            }
            let force = support_load(support, &found, &state.velocity).map_or_else(Vector3::zeros, |made| made.force);
            SupportForce { force, moment: found.at.cross(&force), arc: Some(arc) }
        };
        let near = LocalEnvironment::new(world, state.origin, Vec::new());
        near.world().supports.iter().map(look).collect()
    }
}

impl Rod {
    /// What a run keeps of the nodes of a state: [`Rod::results`], in memory that is there. Of a rod that neither bends nor has a
    /// tube velocity and curvature are left out, which takes most of the time. `sampled` is the fluid at the nodes by which a trial
    /// came to the state ([`RodSolver::fluid`]), where it did: the environment is then not asked again.
    ///
    /// [`RodSolver::fluid`]: super::RodSolver::fluid
    pub fn row(
        &self,
        state: &RodState,
        world: &LineEnvironment,
        ends: &[RodEnd; 2],
        sampled: Option<&[FluidState]>,
        out: &mut Vec<LineNode>,
    ) {
        out.clear();
        let plain = self.elements.iter().all(|e| e.bending == 0.0) && self.segments.iter().all(|s| s.tube.is_none());
        if !plain {
            out.extend(self.results(state, world, ends));
            return;
        }
        let near = LocalEnvironment::new(world, state.origin, Vec::new());
        let world = &near.world();
        let (last, fluid) = (self.elements.len(), UniformFluid::vacuum().0);
        let (mut arc, mut before) = (0.0, 0.0);
        for (i, x) in state.position.iter().enumerate() {
            let beside = i.min(last - 1);
            let element = &self.elements[beside];
            let pull = if i < last { self.element_force(i, state, [&fluid; 2], world.gravity).1 } else { before };
            let effective = if i > 0 { 0.5 * (before + pull) } else { pull };
            let position = x + state.origin;
            let mut made = LineNode { arc, segment: element.segment, position, effective, ..LineNode::default() };
            (made.wall, made.clearance) = (effective, clearance(world, x));
            out.push(made);
            (arc, before) = (arc + if i < last { element.rest } else { 0.0 }, pull);
        }
        let sampled = sampled.filter(|fluid| fluid.len() == state.position.len());
        let beside = match sampled {
            Some(fluid) => [[fluid[0], fluid[1]], [fluid[last], fluid[last - 1]]],
            None => self.sample_fluid_near_ends(state, world),
        };
        for (side, node, element) in [(0, 0, 0), (1, last, last - 1)] {
            let ((t, _), pull) = self.element_force(element, state, [&fluid; 2], world.gravity);
            let effective = self.tension_at_end(side, state, world, &beside, (&t, pull));
            (out[node].effective, out[node].wall) = (effective, effective);
        }
        for held in self.attachments.iter().filter(|a| a.node > 0 && a.node < last) {
            let i = held.node;
            let sample = |node: usize| world.fluid.sample(&state.position[node], state.time);
            let near = [i - 1, i, i + 1].map(|node| sampled.map_or_else(|| sample(node), |fluid| fluid[node]));
            let [a, b] = [i - 1, i].map(|element| self.element_force(element, state, [&fluid; 2], world.gravity));
            let effective = self.tension_beside_node(i, state, world, near.each_ref(), [(&a.0.0, a.1), (&b.0.0, b.1)]);
            (out[i].effective, out[i].wall) = (effective, effective);
        }
    }

    /// Whether something is attached at a node.
    fn is_loaded_node(&self, node: usize) -> bool {
        self.attachments.iter().any(|a| a.node == node)
    }

    /// The larger of the tensions (N) on the two sides of an inner node, by the fluid at it and the nodes beside it, and direction and
    /// tension of its elements.
    fn tension_beside_node(
        &self,
        i: usize,
        state: &RodState,
        world: &LineEnvironment,
        near: [&FluidState; 3],
        [before, behind]: [(&Vector3<f64>, f64); 2],
    ) -> f64 {
        let one = self.tension_at_node((i - 1, 1), state, world, [near[1], near[0]], before);
        let other = self.tension_at_node((i, 0), state, world, [near[1], near[2]], behind);
        one.max(other)
    }

    /// The fluid at the two nodes beside end A, and at the two beside end B: each end first.
    fn sample_fluid_near_ends(&self, state: &RodState, world: &LineEnvironment) -> [[FluidState; 2]; 2] {
        let last = self.elements.len();
        let mut found = [UniformFluid::vacuum().0; 4];
        let positions = [0, 1, last, last - 1].map(|node| state.position[node]);
        world.fluid.sample_into(&positions, state.time, &mut found);
        let [a, b, c, d] = found;
        [[a, b], [c, d]]
    }

    /// Direction and length of an element in a state, and its tension, by the fluid at its two nodes.
    #[inline]
    fn element_force(
        &self,
        i: usize,
        state: &RodState,
        beside: [&FluidState; 2],
        gravity: f64,
    ) -> ((Vector3<f64>, f64), f64) {
        let (element, x, v) = (&self.elements[i], &state.position, &state.velocity);
        let d = x[i + 1] - x[i];
        let length = d.norm().max(f64::MIN_POSITIVE);
        let t = d / length;
        let stretch = length / element.rest;
        let rate = (t.dot(&(v[i + 1] - v[i])) - stretch * element.rate) / element.rest;
        let stretched =
            ElementStretch { strain: stretch - 1.0, rate, height: 0.5 * (x[i].z + x[i + 1].z), datum: state.origin.z };
        let taken = TensionOptions { compression: element.compression, axial_stiffness_scale: 1.0 };
        let memory = state.yielded.get(i).map(|yielded| MaxwellMemory::instantaneous(*yielded));
        ((t, length), tension(self, element, taken, &stretched, memory.as_ref(), beside, gravity).value)
    }

    /// Tension (N) at end A (0) or end B (1), of whose element the direction and the tension are known, by the fluid
    /// [`Rod::sample_fluid_near_ends`].
    fn tension_at_end(
        &self,
        side: usize,
        state: &RodState,
        world: &LineEnvironment,
        beside: &[[FluidState; 2]; 2],
        (t, pull): (&Vector3<f64>, f64),
    ) -> f64 {
        let element = if side == 0 { 0 } else { self.elements.len() - 1 };
        self.tension_at_node((element, side), state, world, beside[side].each_ref(), (t, pull))
    }

    /// Tension (N) at the first (0) or second (1) node of an element, whose direction and tension are known, by the fluid at that node
    /// and at the other.
    fn tension_at_node(
        &self,
        (element, side): (usize, usize),
        state: &RodState,
        world: &LineEnvironment,
        beside: [&FluidState; 2],
        (t, pull): (&Vector3<f64>, f64),
    ) -> f64 {
        let (node, other) = (element + side, element + 1 - side);
        let element = &self.elements[element];
        let at = |node: usize, position: usize| HalfNode {
            position: &state.position[node],
            velocity: &state.velocity[node],
            acceleration: &state.acceleration[node],
            fluid: beside[position],
        };
        let weight = Vector3::z() * world.gravity;
        let moved = (state.acceleration[node] + weight) * element.mass
            - half_force(element, t, world, [at(node, 0), at(other, 1)]);
        let borne = world.bottom.and_then(|(bottom, ground)| {
            let soft = state.bedding[node].max(ground.penetration_scale);
            let (x, v) = (&state.position[node], &state.velocity[node]);
            contact(bottom, &ground, soft, element.contact, x, v, t, &state.stuck[node], true)
        });
        let along = (moved - borne.map_or_else(Vector3::zeros, |b| b.force[0] + b.force[1])).dot(t);
        let found = if side == 0 { pull - along } else { pull + along };
        // half a slack element that is carried along may push its holder, but not the rod
        if element.compression { found } else { found.max(0.0) }
    }

    /// Moment vector of each node of a rod with torsion, with the length it is spread over, and its torque.
    fn spatial_moments(&self, state: &RodState, ends: &[RodEnd; 2]) -> (Vec<(Vector3<f64>, f64)>, Vec<f64>) {
        let last = self.elements.len();
        (0..=last)
            .map(|i| {
                let at = if i == 0 {
                    HingePlace::A
                } else if i == last {
                    HingePlace::B
                } else {
                    HingePlace::Inner(i)
                };
                let Some((k, kt, e, f)) = hinge_sides(self, &state.position, &state.director, ends, at) else {
                    return ((Vector3::zeros(), 1.0), 0.0);
                };
                let across = e.direction.cross(&f.direction);
                let axis = across.try_normalize(1e-300).unwrap_or_else(Vector3::zeros);
                let bend = axis * across.norm().atan2(e.direction.dot(&f.direction));
                let moment = (bend - (e.rest() + f.rest()) * 0.5) * k;
                ((moment, 1.0), kt * twist(&e, &f))
            })
            .unzip()
    }
}

/// A direction across each element, carried along the rod without twist.
///
/// Without a holder's side it starts from a frame fixed in space by the shortest turn to the first element, which is
/// smooth as the rod moves but for one direction: this one is askew to all axes and planes a model is laid out in.
fn transport_to_end(edges: &[(Vector3<f64>, f64)], end: &RodEnd) -> Vec<Vector3<f64>> {
    let first = edges[0].0;
    let held = end.side.and_then(|side| {
        let direction = end.direction.and_then(|d| d.try_normalize(1e-12)).unwrap_or(first);
        let across = (side - direction * direction.dot(&side)).try_normalize(1e-9)?;
        Some(transport_director(&across, &direction, &first))
    });
    let (direction, across) = (Vector3::new(2.0, 3.0, 6.0) / 7.0, Vector3::new(3.0, -6.0, 2.0) / 7.0);
    let mut before = (first, held.unwrap_or_else(|| transport_director(&across, &direction, &first)));
    let on = |(direction, _): &(Vector3<f64>, f64)| {
        before = (*direction, transport_director(&before.1, &before.0, direction));
        before.1
    };
    edges.iter().map(on).collect()
}

/// A vector at the end of a row of middles.
fn toward_end(row: &[Vector3<f64>], near: usize, far: usize) -> Vector3<f64> {
    row.get(far).map_or(row[near], |far| row[near] + (row[near] - far) * 0.5)
}

/// Curvature of a line without bending stiffness.
fn curvature_at(edges: &[(Vector3<f64>, f64)], moments: &[(Vector3<f64>, f64)], i: usize) -> f64 {
    if i == 0 || i >= edges.len() {
        return 0.0;
    }
    let (e, f) = (edges[i - 1].0, edges[i].0);
    e.cross(&f).norm().atan2(e.dot(&f)) / moments[i].1
}

fn clearance(world: &LineEnvironment, x: &Vector3<f64>) -> f64 {
    world.bottom.map_or(f64::INFINITY, |(bottom, _)| x.z - bottom.height(x.x, x.y).0)
}

/// Stresses by Lame's thick cylinder and the beam's bending.
fn stress(wall: f64, moment: f64, [outer, inner]: [f64; 2], tube: &super::section::TubeSection) -> LineStress {
    let (b, a) = (0.5 * tube.outer, 0.5 * tube.inner);
    let [outside, inside] = tube.areas();
    let axial = wall / (outside - inside);
    let bending = moment * b / tube.second_moment();
    let ring = b * b - a * a;
    let mean = (inner * a * a - outer * b * b) / ring;
    // radius squared cancels at the surfaces: a^2 b^2 / r^2 is b^2 inside, a^2 outside
    let swing = |other: f64| (inner - outer) * other * other / ring;
    let mut worst: f64 = 0.0;
    let mut hoop_inside = 0.0;
    for (r, other) in [(a, b), (b, a)] {
        let (hoop, radial) = if a > 0.0 || r > 0.0 { (mean + swing(other), mean - swing(other)) } else { (mean, mean) };
        if r == a {
            hoop_inside = hoop;
        }
        for side in [-1.0, 1.0] {
            let along = axial + side * bending * r / b;
            let sum = (hoop - radial).powi(2) + (radial - along).powi(2) + (along - hoop).powi(2);
            worst = worst.max((0.5 * sum).sqrt());
        }
    }
    LineStress { axial, bending, hoop: hoop_inside, von_mises: worst }
}
