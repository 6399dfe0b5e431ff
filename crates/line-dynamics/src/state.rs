//! Where a rod is and how it moves.

use super::ends::RodEndMotion;
use super::error::RodError;
use super::mesh::{Rod, transport_sides};
use super::spatial::transport_director;
use super::viscoelastic::yielded_strains;
use nalgebra::Vector3;

/// Motion of a rod at one time.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct RodState {
    /// Time (s).
    pub time: f64,
    /// From where positions are measured (m, global): where end A was at the last position of rest, or the first point of
    /// [`RodState::along_points`].
    pub origin: Vector3<f64>,
    /// Position of each node (m, global axes, from [`RodState::origin`]): [`RodState::node_position`] is the global one.
    pub position: Vec<Vector3<f64>>,
    /// Velocity of each node (m/s).
    pub velocity: Vec<Vector3<f64>>,
    /// Acceleration of each node (m/s2).
    pub acceleration: Vec<Vector3<f64>>,
    /// The averaged acceleration of the scheme (m/s2).
    pub(super) averaged: Vec<Vector3<f64>>,
    /// Director of each element of a rod with torsion: a unit vector across it that twists with it.
    pub(super) director: Vec<Vector3<f64>>,
    /// Least penetration over which the bottom's stiffness grows at each node (m): see
    /// [`RodSolver::statics`](super::RodSolver::statics).
    pub(super) bedding: Vec<f64>,
    /// Where each node sticks to the bottom by friction (m, from the origin): see [`SeabedLaw`](super::SeabedLaw).
    pub(super) stuck: Vec<Vector3<f64>>,
    /// Strain to which each element has yielded; empty for a rod without viscoelastic rope.
    pub(super) yielded: Vec<f64>,
}

impl RodState {
    /// At rest along a line of points, spread over it by unstretched length.
    ///
    /// # Errors
    /// Fewer than two points, points that are no numbers, or all in one place.
    pub fn along_points(rod: &Rod, points: &[Vector3<f64>]) -> Result<Self, RodError> {
        let mut along = vec![0.0];
        for pair in points.windows(2) {
            along.push(along[along.len() - 1] + (pair[1] - pair[0]).norm());
        }
        let total = along[along.len() - 1];
        if points.len() < 2 || !(total.is_finite() && total > 0.0) {
            let why = "it needs a line of two points or more, apart from each other, to start from".to_string();
            return Err(RodError::Shape { rod: rod.name.clone(), why });
        }
        let length = rod.length();
        let (mut at, origin) = (1, points[0]);
        let position = rod
            .arc()
            .iter()
            .map(|s| {
                let here = s / length * total;
                while at + 1 < points.len() && along[at] < here {
                    at += 1;
                }
                let share = (here - along[at - 1]) / (along[at] - along[at - 1]).max(f64::MIN_POSITIVE);
                (points[at - 1] - origin) + (points[at] - points[at - 1]) * share.clamp(0.0, 1.0)
            })
            .collect();
        let position: Vec<Vector3<f64>> = position;
        let director = if rod.twists() {
            let edges = position.windows(2).map(|p| (p[1] - p[0]).normalize());
            match &rod.natural {
                // untwisted against the shape free of load: from its first director on
                Some(natural) => {
                    let mut directors = vec![natural.directors[0]];
                    let mut from = None;
                    for t in edges {
                        let last = directors[directors.len() - 1];
                        directors.push(match from {
                            Some(from) => transport_director(&last, &from, &t),
                            None => (last - t * t.dot(&last)).normalize(),
                        });
                        from = Some(t);
                    }
                    directors.split_off(1)
                }
                None => transport_sides(&edges.collect::<Vec<_>>()),
            }
        } else {
            Vec::new()
        };
        let rest = vec![Vector3::zeros(); rod.nodes()];
        let yielded = yielded_strains(rod, &position);
        Ok(RodState {
            time: 0.0,
            origin,
            stuck: position.clone(),
            position,
            velocity: rest.clone(),
            acceleration: rest.clone(),
            averaged: rest,
            director,
            bedding: vec![0.0; rod.nodes()],
            yielded,
        })
    }

    /// Position of a node, from end A (m, global); none of a node that is not there.
    pub fn node_position(&self, node: usize) -> Option<Vector3<f64>> {
        self.position.get(node).map(|x| x + self.origin)
    }

    /// Position of each node from end A (m, global).
    pub fn node_positions(&self) -> Vec<Vector3<f64>> {
        self.position.iter().map(|x| x + self.origin).collect()
    }

    /// Measures positions from another origin (m, global); the nodes stay.
    pub(super) fn move_origin(&mut self, origin: Vector3<f64>) {
        let back = self.origin - origin;
        if back != Vector3::zeros() {
            self.position.iter_mut().chain(&mut self.stuck).for_each(|x| *x += back);
            self.origin = origin;
        }
    }

    /// Becomes another state, in memory that is there where it is one of as many nodes.
    pub fn copy_from(&mut self, other: &RodState) {
        self.time = other.time;
        self.origin = other.origin;
        self.position.clone_from(&other.position);
        self.velocity.clone_from(&other.velocity);
        self.acceleration.clone_from(&other.acceleration);
        self.averaged.clone_from(&other.averaged);
        self.director.clone_from(&other.director);
        self.bedding.clone_from(&other.bedding);
        self.stuck.clone_from(&other.stuck);
        self.yielded.clone_from(&other.yielded);
    }

    /// Whether it equals another state: as `==`, in loops without a way out, which go many numbers at a time.
    pub(super) fn is_same(&self, other: &RodState) -> bool {
        fn vectors(state: &RodState) -> [&[f64]; 6] {
            let RodState { position, velocity, acceleration, averaged, director, stuck, .. } = state;
            [position, velocity, acceleration, averaged, director, stuck].map(|list| bytemuck::cast_slice(list))
        }
        let same =
            |a: &[f64], b: &[f64]| a.len() == b.len() && a.iter().zip(b).fold(true, |same, (a, b)| same & (a == b));
        self.time == other.time
            && self.origin == other.origin
            && vectors(self).into_iter().zip(vectors(other)).all(|(a, b)| same(a, b))
            && same(&self.bedding, &other.bedding)
            && same(&self.yielded, &other.yielded)
    }

    /// Moves every node by its part of a change of the unknowns, of which there are `stride` a node, positions first.
    pub(super) fn move_nodes(&mut self, change: &[f64], stride: usize) {
        if stride == 3 {
            let coordinates: &mut [f64] = bytemuck::cast_slice_mut(&mut self.position);
            coordinates.iter_mut().zip(change).for_each(|(x, d)| *x += d);
        } else {
            for (x, d) in self.position.iter_mut().zip(change.chunks_exact(stride)) {
                *x += Vector3::new(d[0], d[1], d[2]);
            }
        }
    }

    /// Position, velocity, acceleration and averaged acceleration of a node.
    pub(super) fn node_motion(&self, node: usize) -> [Vector3<f64>; 4] {
        [self.position[node], self.velocity[node], self.acceleration[node], self.averaged[node]]
    }

    /// Gives a node the motion of [`RodState::node_motion`].
    pub(super) fn set_node_motion(&mut self, node: usize, motion: [Vector3<f64>; 4]) {
        [self.position[node], self.velocity[node], self.acceleration[node], self.averaged[node]] = motion;
    }

    /// Whether it is a state of a rod, by the length of all its lists.
    pub(super) fn fits(&self, rod: &Rod) -> bool {
        let (nodes, elements) = (rod.nodes(), rod.elements.len());
        let lists = [&self.position, &self.velocity, &self.acceleration, &self.averaged, &self.stuck];
        lists.iter().all(|l| l.len() == nodes)
            && self.bedding.len() == nodes
            && self.director.len() == if rod.twists() { elements } else { 0 }
            && self.yielded.len() == if rod.is_viscoelastic() { elements } else { 0 }
    }

    /// Gives a node a motion.
    pub(super) fn hold(&mut self, node: usize, motion: &RodEndMotion) {
        self.position[node] = motion.position;
        self.velocity[node] = motion.velocity;
        self.acceleration[node] = motion.acceleration;
        self.averaged[node] = motion.acceleration;
    }
}
