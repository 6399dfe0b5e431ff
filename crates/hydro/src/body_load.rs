//! What an engine asks of a load on a body: its mean on the body at rest, and its value on the body under way.
//!
//! In a step of time an engine calls [`StatefulLoad::begin`] once, with where it expects the body at the end of the step, then
//! [`BodyLoad::dynamic_load`] for every trial of that end, and [`StatefulLoad::commit`] once the step is accepted. A step that is
//! given up is followed by another `begin` from the same state, so that `begin` may keep what it finds but nothing that has happened.
//!
//! What only some loads can do are traits of their own, which the accessors `as_..` of [`BodyLoad`] give.

use super::hull::SubmergedVolume;
use super::stability::WaterSlabs;
use super::{Category, Load};
use nalgebra::{Matrix6, Vector2};
use std::fmt::Debug;
use windlass_base::pose::{Pose, Six};
use windlass_model::ClassError;

/// A body at the end of a step of time.
#[derive(Clone, Copy, Debug)]
pub struct BodyStep<'a> {
    /// Time at the end of the step (s).
    pub time: f64,
    /// Length of the step (s); zero at the start of a run.
    pub dt: f64,
    /// Where the body is.
    pub pose: &'a Pose,
    /// Velocity of its origin (m/s) and its rotation (rad/s), global axes.
    pub velocity: &'a Six,
}

/// A force on a body under way, and how it changes with its place and velocity.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DynamicLoad {
    /// The force, and its change with the place.
    pub load: Load,
    /// -d(wrench)/d(velocity of the origin, rotation), global axes (N s/m, N s, N m s).
    pub damping: Matrix6<f64>,
}

impl Default for DynamicLoad {
    fn default() -> Self {
        Load::none().into()
    }
}

impl From<Load> for DynamicLoad {
    /// A load that no velocity changes.
    fn from(load: Load) -> Self {
        DynamicLoad { load, damping: Matrix6::zeros() }
    }
}

/// One kind of load on one body.
pub trait BodyLoad: Debug + Send + Sync {
    /// The category reports count it in.
    fn category(&self) -> Category;

    /// The load on the body at rest in a pose: of what varies in time its mean.
    ///
    /// # Errors
    /// A pose for which it has no value.
    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError>;

    /// The load at a trial of the end of the step that was begun; of a load without state the state is empty.
    ///
    /// # Errors
    /// A place for which it has no value.
    fn dynamic_load(&self, at: &BodyStep, _state: &[f64]) -> Result<DynamicLoad, ClassError> {
        self.mean_load(at.pose).map(DynamicLoad::from)
    }

    /// Adds what [`BodyLoad::dynamic_load`] gives; a load of which little is other than zero does it with less work.
    ///
    /// # Errors
    /// As [`BodyLoad::dynamic_load`].
    fn add_dynamic_load(&self, at: &BodyStep, state: &[f64], out: &mut DynamicLoad) -> Result<(), ClassError> {
        let made = self.dynamic_load(at, state)?;
        out.load.wrench += made.load.wrench;
        out.load.stiffness += made.load.stiffness;
        out.damping += made.damping;
        Ok(())
    }

    /// The load as one with a state.
    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        None
    }

    /// The load as one whose beginning of a step decides what time changes in it.
    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        None
    }

    /// The load as one that adds to the inertia of the body.
    fn as_inertial(&self) -> Option<&dyn InertialLoad> {
        None
    }

    /// The load as one of which parts are counted in other categories.
    fn as_divided(&self) -> Option<&dyn DividedLoad> {
        None
    }

    /// The load as the weight of sea water.
    fn as_immersed(&self) -> Option<&dyn Immersed> {
        None
    }
}

/// A load that is the weight of sea water: what a hull displaces, or what fills a compartment that is open to the sea.
pub trait Immersed {
    /// The lift of a volume of water (N/m3): negative of water that is taken in.
    fn lift(&self) -> f64;

    /// What of it is below the sea at rest, in a pose.
    fn wet(&self, pose: &Pose) -> SubmergedVolume;

    /// What of it is below a water surface, slab by slab.
    fn wet_slabs(&self, pose: &Pose, water: &WaterSlabs) -> Vec<SubmergedVolume>;

    /// The least and the greatest distance of its points from the origin of a pose along a horizontal direction (m).
    fn reach_along(&self, pose: &Pose, ahead: &Vector2<f64>) -> [f64; 2];
}

/// A load that keeps values from step to step.
pub trait StatefulLoad {
    /// Number of values, with room for what [`StatefulLoad::begin`] finds. All are zero before anything has happened.
    fn states(&self) -> usize;

    /// Prepares the step that ends `ahead`: what does not depend on the trial is found here once. The place and velocity are
    /// those expected, exact to the second order of the step; a load that varies little with them may take them for the step.
    ///
    /// # Errors
    /// A place for which it has no value.
    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError>;

    /// The step is accepted with its end there.
    fn commit(&self, _at: &BodyStep, _state: &mut [f64]) {}
}

/// A load whose [`StatefulLoad::begin`] decides what time changes in it: an engine predicts from it how the load goes on from the step
/// before.
pub trait PreparedLoad {
    /// The wrench as the state has it. It is linear in the axes, which may be the mean of two poses.
    fn prepared_wrench(&self, at: &BodyStep, state: &[f64]) -> Six;
}

/// A load that adds to the inertia of the body.
pub trait InertialLoad {
    /// What it adds over the step that was begun: -d(wrench)/d(acceleration of the origin, of the rotation), global axes (kg, kg m,
    /// kg m2). The wrench of [`BodyLoad::dynamic_load`] is without it: the engine has the acceleration at the end of the step, where
    /// that of the velocities of both ends would be late by half a step.
    fn inertia(&self, state: &[f64]) -> Matrix6<f64>;
}

/// A load of which parts are counted in other categories than its own.
pub trait DividedLoad {
    /// The categories besides its own. Reports have a place for each of them.
    fn other_categories(&self) -> &'static [Category];

    /// The part of the load that is counted in one of them instead of its own (N, N m; as the load itself).
    fn part(&self, category: Category, at: &BodyStep, state: &[f64]) -> Six;
}
