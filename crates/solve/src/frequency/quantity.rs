//! What is asked of motions: a number that is linear in them.

use super::linear::{LinearSystem, Motions};
use crate::link::{EndAttachment, arm, pose_of};
use crate::system::SolveError;
use nalgebra::{Complex, DVector, Vector3};
use windlass_hydro::move_stiffness;
use windlass_model::{ConnectorResponse, End, Situation, SolverCache, TimeStep};

/// Which derivative with time is meant.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Derivative {
    /// None.
    #[default]
    Place,
    /// The first.
    Velocity,
    /// The second.
    Acceleration,
}

impl Derivative {
    /// Its power of time.
    pub fn order(self) -> i32 {
        match self {
            Derivative::Place => 0,
            Derivative::Velocity => 1,
            Derivative::Acceleration => 2,
        }
    }
}

/// A number linear in the motions of all bodies, their velocities and accelerations.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearQuantity {
    /// Its value at rest.
    pub mean: f64,
    /// Its change with the motions, six a body.
    position: DVector<f64>,
    /// Its change with the velocities.
    rate: DVector<f64>,
    /// Its change with the accelerations.
    second: DVector<f64>,
}

/// The force of a connector on its first end on a body: its components in global axes, and its size, which for a line is its
/// tension; `None` where there is no force at rest.
pub type PullQuantity = ([LinearQuantity; 3], Option<LinearQuantity>);

impl LinearQuantity {
    /// A degree of freedom of the origin of a body.
    pub fn dof(linear: &LinearSystem, body: usize, dof: usize) -> Self {
        let size = 6 * linear.system.nodes.len();
        let position = DVector::from_fn(size, |i, _| if i == 6 * body + dof { 1.0 } else { 0.0 });
        LinearQuantity { mean: 0.0, position, rate: DVector::zeros(size), second: DVector::zeros(size) }
    }

    /// The three coordinates of a point of a body, given in the body (m).
    pub fn point(linear: &LinearSystem, body: usize, at: Vector3<f64>) -> [Self; 3] {
        let pose = linear.poses[body];
        let (arm, start) = (pose.axes * at, pose.point(at));
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|axis| {
            let mut made = LinearQuantity { mean: start.dot(&axis), ..LinearQuantity::dof(linear, body, 0) };
            // axis . (turn x arm) = turn . (arm x axis)
            let turn = arm.cross(&axis);
            let six = [axis.x, axis.y, axis.z, turn.x, turn.y, turn.z];
            six.into_iter().enumerate().for_each(|(i, v)| made.position[6 * body + i] = v);
            made
        })
    }

    /// What this is more than another.
    pub fn minus(self, other: &LinearQuantity) -> Self {
        LinearQuantity {
            mean: self.mean - other.mean,
            position: self.position - &other.position,
            rate: self.rate - &other.rate,
            second: self.second - &other.second,
        }
    }

    /// The force and moment that a weight (N) at a point of a body, given in the body (m), exerts on it there, along the axes of
    /// the body: by its inertia, and by gravity as the body turns. `radii` are its radii of gyration about these axes (m).
    pub fn cargo_force(
        linear: &LinearSystem,
        body: usize,
        at: Vector3<f64>,
        weight: f64,
        radii: [f64; 3],
    ) -> [Self; 6] {
        let (axes, gravity) = (linear.poses[body].axes, linear.system.gravity);
        let mass = weight / gravity;
        let point = LinearQuantity::point(linear, body, at);
        let size = 6 * linear.system.nodes.len();
        let zeros = || DVector::zeros(size);
        std::array::from_fn(|i| {
            let axis: Vector3<f64> = axes.column(i % 3).into_owned();
            let mut made = LinearQuantity { mean: 0.0, position: zeros(), rate: zeros(), second: zeros() };
            if i < 3 {
                // axis . mass (gravity - acceleration); along the axes of the body gravity changes by -(turn x gravity)
                made.mean = -weight * axis.z;
                for (component, own) in point.iter().zip(axis.iter()) {
                    made.second -= &component.position * (mass * own);
                }
                let down = Vector3::new(0.0, 0.0, -weight);
                // axis . (turn x down) = turn . (down x axis)
                let change = down.cross(&axis);
                (0..3).for_each(|k| made.position[6 * body + 3 + k] -= change[k]);
            } else {
                let inertia = mass * radii[i - 3] * radii[i - 3];
                (0..3).for_each(|k| made.second[6 * body + 3 + k] -= inertia * axis[k]);
            }
            made
        })
    }

    /// The force of a connector; `None` of a name that does not act on a body.
    ///
    /// # Errors
    /// The connector that has no answer.
    pub fn tension(linear: &LinearSystem, name: &str) -> Result<Option<PullQuantity>, SolveError> {
        let (system, poses) = (&linear.system, &linear.poses);
        let Some(link) = system.links.iter().find(|l| l.name.eq_ignore_ascii_case(name)) else { return Ok(None) };
        let Some(first) = link.acting_ends().iter().position(|e| matches!(e, EndAttachment::Body(..))) else {
            return Ok(None);
        };
        let ends: Vec<End> = link.ends.iter().map(|e| End::at_rest(pose_of(e, poses))).collect();
        let committed = &system.states[link.states.clone()];
        let mut trial = committed.to_vec();
        let (mut rest, mut under_way) = (ConnectorResponse::default(), ConnectorResponse::default());
        let step = Some(TimeStep { time: 0.0, dt: 1.0 });
        for (step, out) in [(None, &mut rest), (step, &mut under_way)] {
            let at = Situation { ends: &ends, step, surroundings: &system.surroundings };
            link.element
                .evaluate(&at, committed, &mut trial, &mut SolverCache::new(), out)
                .map_err(SolveError::error_about(&link.name))?;
        }
        let size = 6 * system.nodes.len();
        let count = link.ends.len();
        let own = arm(&link.ends[first], poses);
        let wrench = rest.wrench[first];
        let mut made = [0, 1, 2].map(|i| LinearQuantity {
            mean: wrench[i],
            position: DVector::zeros(size),
            rate: DVector::zeros(size),
            second: DVector::zeros(size),
        });
        for (j, end) in link.ends.iter().enumerate() {
            let EndAttachment::Body(body, _) = end else { continue };
            let far = arm(end, poses);
            let block =
                |all: &[nalgebra::Matrix6<f64>]| all.get(count * first + j).map(|b| move_stiffness(b, own, far));
            let (stiffness, damping) = (block(&rest.stiffness), block(&under_way.damping));
            for (i, quantity) in made.iter_mut().enumerate() {
                for k in 0..6 {
                    quantity.position[6 * body + k] -= stiffness.map_or(0.0, |b| b[(i, k)]);
                    quantity.rate[6 * body + k] -= damping.map_or(0.0, |b| b[(i, k)]);
                }
            }
        }
        let force = Vector3::new(wrench[0], wrench[1], wrench[2]);
        let tension = force.norm();
        let [x, y, z] = &made;
        let along = (tension > 0.0).then(|| {
            let unit = force / tension;
            let sum =
                |part: fn(&LinearQuantity) -> &DVector<f64>| part(x) * unit.x + part(y) * unit.y + part(z) * unit.z;
            LinearQuantity {
                mean: tension,
                position: sum(|q| &q.position),
                rate: sum(|q| &q.rate),
                second: DVector::zeros(size),
            }
        });
        Ok(Some((made, along)))
    }

    /// Its complex amplitude, or that of a derivative of it, under motions of a frequency (rad/s).
    pub fn amplitude(&self, motions: &Motions, frequency: f64, derivative: Derivative) -> Complex<f64> {
        let rate = Complex::new(0.0, -frequency);
        let part = |by: &DVector<f64>| by.iter().zip(motions.iter()).map(|(a, q)| q * *a).sum::<Complex<f64>>();
        (part(&self.position) + part(&self.rate) * rate + part(&self.second) * rate * rate)
            * rate.powi(derivative.order())
    }
}
