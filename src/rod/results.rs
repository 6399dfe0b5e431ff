//! What is wanted of a rod at one time: tensions, moments, stresses along it.

use super::bend::hinge;
use super::ends::End;
use super::hinges::{HingeAt, hinge_sides};
use super::mesh::Rod;
use super::spatial::twist;
use super::state::State;
use super::surroundings::World;
use super::tension::{Stretch, Taken, tension};
use nalgebra::{Rotation3, Vector3};

/// Results at a node.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NodeResult {
    /// Unstretched distance from end A (m).
    pub arc: f64,
    /// Position (m, global).
    pub position: Vector3<f64>,
    /// Velocity (m/s).
    pub velocity: Vector3<f64>,
    /// Effective tension (N): what balances the submerged weight.
    pub effective: f64,
    /// Tension in the wall (N): effective tension less outer pressure times outer area plus inner pressure times inner area.
    pub wall: f64,
    /// Shear force (N).
    pub shear: f64,
    /// Bending moment (N m).
    pub moment: f64,
    /// Its components about two directions across the rod that are carried along it without twist (N m).
    pub bends: [f64; 2],
    /// Torsional moment (N m), where the rod has torsional stiffness.
    pub torque: f64,
    /// Curvature (1/m), from the shape free of load.
    pub curvature: f64,
    /// Height over the bottom (m); infinite without one.
    pub clearance: f64,
    /// Stresses, for a tube.
    pub stress: Option<Stress>,
}

/// Stresses of a tube at a node (Pa).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Stress {
    /// Axial, of the wall tension.
    pub axial: f64,
    /// Bending, at the outer surface.
    pub bending: f64,
    /// Hoop, at the inner surface (Lame).
    pub hoop: f64,
    /// Largest von Mises stress over the inner and outer surfaces, on both sides of the bend.
    pub von_mises: f64,
}

impl Rod {
    /// Results at every node of a state.
    ///
    /// Tension of a node is the mean of its two elements; at an end it is that of the nearest two carried on. Shear
    /// is the change of the moment over the elements beside a node.
    pub fn results(&self, state: &State, world: &World, ends: &[End; 2]) -> Vec<NodeResult> {
        let last = self.elements.len();
        let (x, v) = (&state.position, &state.velocity);
        let fluids: Vec<_> = x.iter().map(|x| world.fluid.at(x, state.time)).collect();
        let edges: Vec<(Vector3<f64>, f64)> = x
            .windows(2)
            .map(|p| (p[1] - p[0], (p[1] - p[0]).norm().max(f64::MIN_POSITIVE)))
            .map(|(d, l)| (d / l, l))
            .collect();
        let pulls: Vec<f64> = self
            .elements
            .iter()
            .enumerate()
            .map(|(i, element)| {
                let (t, length) = edges[i];
                let stretch = length / element.rest;
                let rate = (t.dot(&(v[i + 1] - v[i])) - stretch * element.rate) / element.rest;
                let stretched = Stretch { strain: stretch - 1.0, rate, height: 0.5 * (x[i].z + x[i + 1].z) };
                let taken = Taken { compression: element.compression, ease: 1.0 };
                tension(self, element, taken, &stretched, &fluids[i], world.gravity).value
            })
            .collect();
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
        let (moments, torques) = if self.twists() { self.spatial_moments(state, ends) } else { (moments, Vec::new()) };
        let across = carried(&edges);
        let shears: Vec<Vector3<f64>> =
            (0..last).map(|i| (moments[i + 1].0 - moments[i].0) / self.elements[i].rest).collect();
        let mut arc = 0.0;
        (0..=last)
            .map(|i| {
                let inner = i > 0 && i < last;
                let effective = match (inner, i) {
                    (true, _) => 0.5 * (pulls[i - 1] + pulls[i]),
                    (false, 0) => carried_on(pulls[0], pulls.get(1).copied()),
                    (false, _) => carried_on(pulls[last - 1], last.checked_sub(2).map(|j| pulls[j])),
                };
                let shear = match (inner, i) {
                    (true, _) => 0.5 * (shears[i - 1] + shears[i]).norm(),
                    (false, 0) => toward_end(&shears, 0, 1).norm(),
                    (false, _) => toward_end(&shears, last - 1, last.wrapping_sub(2)).norm(),
                };
                let (moment, _) = moments[i];
                let element = &self.elements[i.min(last - 1)];
                // the axis of a bend has the same parts on either side of its node
                let bends = across.get(i.min(last - 1)).map_or([0.0; 2], |d| d.map(|d| moment.dot(&d)));
                let moment = moment.norm();
                let mut made = NodeResult {
                    arc,
                    position: x[i],
                    velocity: v[i],
                    effective,
                    wall: effective,
                    shear,
                    moment,
                    bends,
                    torque: torques.get(i).copied().unwrap_or(0.0),
                    curvature: if element.bending > 0.0 { moment / element.bending } else { bend(&edges, &moments, i) },
                    clearance: clearance(world, &x[i]),
                    stress: None,
                };
                if let Some(tube) = &self.segments[element.segment].tube {
                    let [outside, inside] = tube.areas();
                    let outer = fluids[i].density * world.gravity * (fluids[i].surface - x[i].z).max(0.0);
                    let inner = tube.pressure + tube.contents * world.gravity * (tube.at - x[i].z);
                    made.wall = effective - outer * outside + inner * inside;
                    made.stress = Some(stress(made.wall, moment, [outer, inner], tube));
                }
                arc += if i < last { element.rest } else { 0.0 };
                made
            })
            .collect()
    }
}

impl Rod {
    /// Moment vector of each node of a rod with torsion, with the length it is spread over, and its torque.
    fn spatial_moments(&self, state: &State, ends: &[End; 2]) -> (Vec<(Vector3<f64>, f64)>, Vec<f64>) {
        let last = self.elements.len();
        (0..=last)
            .map(|i| {
                let at = if i == 0 {
                    HingeAt::A
                } else if i == last {
                    HingeAt::B
                } else {
                    HingeAt::Inner(i)
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

/// Two directions across each element, carried along the rod without twist. Those of the first element come from fixed ones by
/// the smallest turn; it is not known only where a rod begins against the fixed direction, which lies where none does but by chance.
fn carried(edges: &[(Vector3<f64>, f64)]) -> Vec<[Vector3<f64>; 2]> {
    let mut along = Vector3::new(-0.50, -0.62, -0.60).normalize();
    let mut across = Vector3::new(0.62, -0.50, 0.0).normalize();
    let step = |(t, _): &(Vector3<f64>, f64)| {
        if let Some(turn) = Rotation3::rotation_between(&along, t) {
            across = turn * across;
        }
        // what rounding adds along the rod is left out
        across = (across - t * across.dot(t)).try_normalize(1e-300).unwrap_or(across);
        along = *t;
        [across, t.cross(&across)]
    };
    edges.iter().map(step).collect()
}

/// A value at the end of a row of middles.
fn carried_on(near: f64, far: Option<f64>) -> f64 {
    far.map_or(near, |far| near + 0.5 * (near - far))
}

/// A vector at the end of a row of middles.
fn toward_end(row: &[Vector3<f64>], near: usize, far: usize) -> Vector3<f64> {
    row.get(far).map_or(row[near], |far| row[near] + (row[near] - far) * 0.5)
}

/// Curvature of a line without bending stiffness.
fn bend(edges: &[(Vector3<f64>, f64)], moments: &[(Vector3<f64>, f64)], i: usize) -> f64 {
    if i == 0 || i >= edges.len() {
        return 0.0;
    }
    let (e, f) = (edges[i - 1].0, edges[i].0);
    e.cross(&f).norm().atan2(e.dot(&f)) / moments[i].1
}

fn clearance(world: &World, x: &Vector3<f64>) -> f64 {
    world.bottom.map_or(f64::INFINITY, |(bottom, _)| x.z - bottom.height(x.x, x.y).0)
}

/// Stresses by Lame's thick cylinder and the beam's bending.
fn stress(wall: f64, moment: f64, [outer, inner]: [f64; 2], tube: &super::section::Tube) -> Stress {
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
    Stress { axial, bending, hoop: hoop_inside, von_mises: worst }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn edge(x: f64, y: f64, z: f64) -> (Vector3<f64>, f64) {
        (Vector3::new(x, y, z).normalize(), 1.0)
    }

    #[test]
    fn directions_across_a_rod_in_a_plane_keep_their_angle_to_it() {
        let turn = |i: usize| (i as f64 * 0.2).sin_cos();
        let arc: Vec<_> = (0..30).map(turn).map(|(s, c)| edge(0.6 * c, 0.8 * c, -s)).collect();
        let normal = Vector3::new(0.8, -0.6, 0.0);
        let all = carried(&arc);
        let first = all[0].map(|d| d.dot(&normal));
        assert!((first[0].hypot(first[1]) - 1.0).abs() < 1e-12);
        for ([one, other], (t, _)) in all.iter().zip(&arc) {
            assert!((one.dot(&normal) - first[0]).abs() < 1e-12 && (other.dot(&normal) - first[1]).abs() < 1e-12);
            assert!(one.dot(t).abs() < 1e-14 && (one.norm() - 1.0).abs() < 1e-14);
        }
    }

    #[test]
    fn directions_across_change_little_where_the_rod_does() {
        // straight down and up, where lines begin and end
        for z in [-1.0, 1.0] {
            let [a, b] = [[edge(1e-6, 0.0, z)], [edge(-1e-6, 1e-6, z)]].map(|e| carried(&e)[0][0]);
            assert!((a - b).norm() < 1e-5, "{a} {b}");
        }
    }
}
