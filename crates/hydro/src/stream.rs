//! A load that a stream of air or water exerts on a point of a body, and its exact tangent.

use super::steady::{Medium, Steady};
use super::{BodyLoad, BodyStep, Category, DynamicLoad, Load, cross};
use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_model::ClassError;

/// Force and moment about the point, in body axes, in a stream of a velocity in body axes; and how they change with it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StreamWrench {
    /// Force (N) and moment (N m).
    pub wrench: Six,
    /// d(wrench)/d(velocity).
    pub by_velocity: Matrix6x3<f64>,
}

impl StreamWrench {
    /// Nothing.
    pub fn zero() -> Self {
        StreamWrench { wrench: Six::zeros(), by_velocity: Matrix6x3::zeros() }
    }
}

/// What a stream pushes at one point of a body: a load.
pub trait StreamLoad: std::fmt::Debug + Send + Sync {
    /// Where it stands, and the stream.
    fn placement(&self) -> (&LoadPlace, &Steady);

    /// The push of a stream of a velocity in body axes (m/s).
    fn push(&self, stream: Vector3<f64>) -> StreamWrench;
}

impl<T: StreamLoad> BodyLoad for T {
    fn category(&self) -> Category {
        category(self.placement().0.medium)
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let (position, steady) = self.placement();
        Ok(position.load(steady, pose, |stream| self.push(stream)))
    }

    fn dynamic_load(&self, at: &BodyStep, _state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let (position, steady) = self.placement();
        Ok(position.dynamic_load(steady, at, |stream| self.push(stream)))
    }
}

/// The category of what a stream exerts.
pub(super) fn category(medium: Medium) -> Category {
    match medium {
        Medium::Air => Category::Wind,
        Medium::Water => Category::ViscousDrag,
    }
}

/// How much of a load acts, by the height of its point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Immersion {
    /// All of it, wherever the point is.
    Whole,
    /// By a smooth passage of half a metre about the surface.
    Passage,
    /// By the share of a sphere about the point that is under the mean level.
    Sphere {
        /// Its radius (m).
        half_height: f64,
    },
}

/// Where and in what a point load acts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LoadPlace {
    /// The point, in the body (m).
    pub at: Vector3<f64>,
    /// In air or water.
    pub medium: Medium,
    /// How much of it acts.
    pub immersion: Immersion,
}

impl LoadPlace {
    /// How much of the load acts with its point at a height (m, global), and the change of that with the height (1/m).
    pub fn immersed_share(&self, steady: &Steady, z: f64) -> (f64, f64) {
        match self.immersion {
            Immersion::Whole => (1.0, 0.0),
            Immersion::Passage => steady.share(self.medium, z),
            Immersion::Sphere { half_height } => {
                // the share of the volume of a sphere under a plane
                let s = ((steady.around.tide - z + half_height) / (2.0 * half_height)).clamp(0.0, 1.0);
                (s * s * (3.0 - 2.0 * s), -3.0 * s * (1.0 - s) / half_height)
            }
        }
    }

    /// The load on the body at rest that `push` makes in the mean stream at the point.
    pub fn load(&self, steady: &Steady, pose: &Pose, push: impl Fn(Vector3<f64>) -> StreamWrench) -> Load {
        let stream = steady.velocity(self.medium, pose.point(self.at).z);
        self.load_in(steady, pose, stream, push)
    }

    /// The same in a stream given: its velocity (m/s, global), and the change of that with the height (1/s).
    pub fn load_in(
        &self,
        steady: &Steady,
        pose: &Pose,
        stream: (Vector3<f64>, Vector3<f64>),
        push: impl Fn(Vector3<f64>) -> StreamWrench,
    ) -> Load {
        self.exert(steady, pose, stream, Matrix3::zeros(), push).0
    }

    /// The load on a body under way: `push` in the stream of the time as seen from the point, which moves with the body.
    pub fn dynamic_load(
        &self,
        steady: &Steady,
        at: &BodyStep,
        push: impl Fn(Vector3<f64>) -> StreamWrench,
    ) -> DynamicLoad {
        self.dynamic_load_in_waves(steady, at, Vector3::zeros(), push)
    }

    /// The same where waves add a velocity to the stream (m/s, global), which is taken as it is for the step.
    pub fn dynamic_load_in_waves(
        &self,
        steady: &Steady,
        at: &BodyStep,
        of_waves: Vector3<f64>,
        push: impl Fn(Vector3<f64>) -> StreamWrench,
    ) -> DynamicLoad {
        let arm = at.pose.axes * self.at;
        let (own, spin) = (at.velocity.fixed_rows::<3>(0), at.velocity.fixed_rows::<3>(3).into_owned());
        let (stream, slope) = steady.streams_at_time(at.time).velocity(self.medium, at.pose.origin.z + arm.z);
        let relative = stream + of_waves - own - spin.cross(&arm);
        // the arm turns by d x r, and with it its velocity by spin x (d x r)
        let carried = cross(spin) * cross(arm);
        let (load, [force, moment]) = self.exert(steady, at.pose, (relative, slope), carried, push);
        // d(relative) = -d(velocity) + r x d(spin)
        let mut damping = Matrix6::zeros();
        for (rows, change) in [(0, force), (3, moment + cross(arm) * force)] {
            damping.fixed_view_mut::<3, 3>(rows, 0).copy_from(&change);
            damping.fixed_view_mut::<3, 3>(rows, 3).copy_from(&(-change * cross(arm)));
        }
        DynamicLoad { load, damping }
    }

    /// The load in a stream, and d(force), d(moment about the point) over d(velocity of the stream), global axes.
    ///
    /// With F, M in global axes, r the arm from the origin and u(z) the stream: the body turns under the stream, so that a
    /// rotation d turns F and M and changes the velocity in body axes by that of `u x d`; the point rises with the
    /// translation and with `d x r`; `carried` is what a rotation changes of the velocity at which the point itself moves.
    fn exert(
        &self,
        steady: &Steady,
        pose: &Pose,
        (stream, slope): (Vector3<f64>, Vector3<f64>),
        carried: Matrix3<f64>,
        push: impl Fn(Vector3<f64>) -> StreamWrench,
    ) -> (Load, [Matrix3<f64>; 2]) {
        let (axes, arm) = (pose.axes, pose.axes * self.at);
        let z = pose.origin.z + arm.z;
        let (share, share_slope) = self.immersed_share(steady, z);
        let StreamWrench { wrench, by_velocity } = push(axes.transpose() * stream);
        let halves = |m: &Matrix6x3<f64>| -> [Matrix3<f64>; 2] {
            [m.fixed_rows::<3>(0).into_owned(), m.fixed_rows::<3>(3).into_owned()]
        };
        let global = |v: Vector3<f64>| axes * v;
        let (force, moment) =
            (global(wrench.fixed_rows::<3>(0).into_owned()), global(wrench.fixed_rows::<3>(3).into_owned()));
        // change with the rotation of the axes, then with the height
        let turn =
            |v: Vector3<f64>, j: Matrix3<f64>| axes * j * axes.transpose() * (cross(stream) + carried) - cross(v);
        let rise = |v: Vector3<f64>, j: Matrix3<f64>| (axes * j * (axes.transpose() * slope)) * share + v * share_slope;
        let [jf, jm] = halves(&by_velocity);
        let (force_turn, moment_turn) = (turn(force, jf) * share, turn(moment, jm) * share);
        let (force_rise, moment_rise) = (rise(force, jf), rise(moment, jm));
        let (force, moment) = (force * share, moment * share);
        let about_origin = moment + arm.cross(&force);
        // height: dz = e_z . translation + (arm x e_z) . rotation
        let lift = arm.cross(&Vector3::z());
        let force_turn = force_turn + force_rise * lift.transpose();
        let moment_turn =
            moment_turn + moment_rise * lift.transpose() + cross(arm) * force_turn + cross(force) * cross(arm);
        let moment_rise = moment_rise + arm.cross(&force_rise);
        let mut stiffness = nalgebra::Matrix6::zeros();
        stiffness.fixed_view_mut::<3, 1>(0, 2).copy_from(&-force_rise);
        stiffness.fixed_view_mut::<3, 1>(3, 2).copy_from(&-moment_rise);
        stiffness.fixed_view_mut::<3, 3>(0, 3).copy_from(&-force_turn);
        stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&-moment_turn);
        let wrench = Six::new(force.x, force.y, force.z, about_origin.x, about_origin.y, about_origin.z);
        let by_stream = [jf, jm].map(|j| axes * j * axes.transpose() * share);
        (Load { wrench, stiffness }, by_stream)
    }
}
