//! What an engine asks of a load on a body: its mean on the body at rest, and its value on the body under way.
//!
//! In a step of time an engine calls [`BodyLoad::begin`] once, with where it expects the body at the end of the step, then
//! [`BodyLoad::moving`] for every trial of that end, and [`BodyLoad::commit`] once the step is accepted. A step that is given up
//! is followed by another `begin` from the same state, so that `begin` may keep what it finds but nothing that has happened.

use super::{Category, Load};
use nalgebra::Matrix6;
use std::fmt::Debug;
use windlass_base::pose::{Pose, Six};
use windlass_model::ClassError;

/// A body at the end of a step of time.
#[derive(Clone, Copy, Debug)]
pub struct Underway<'a> {
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
pub struct MovingLoad {
    /// The force, and its change with the place.
    pub load: Load,
    /// -d(wrench)/d(velocity of the origin, rotation), global axes (N s/m, N s, N m s).
    pub damping: Matrix6<f64>,
}

impl Default for MovingLoad {
    fn default() -> Self {
        MovingLoad::of(Load::none())
    }
}

impl MovingLoad {
    /// A load that no velocity changes.
    pub fn of(load: Load) -> Self {
        MovingLoad { load, damping: Matrix6::zeros() }
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
    fn load(&self, pose: &Pose) -> Result<Load, ClassError>;

    /// Number of values it remembers from step to step, with room for what [`BodyLoad::begin`] finds.
    fn states(&self) -> usize {
        0
    }

    /// What it remembers before anything has happened; the engine gives zeros.
    fn start(&self, _state: &mut [f64]) {}

    /// Prepares the step that ends `ahead`: what does not depend on the trial is found here once. The place and velocity are
    /// those expected, exact to the second order of the step; a load that varies little with them may take them for the step.
    ///
    /// # Errors
    /// A place for which it has no value.
    fn begin(&self, _ahead: &Underway, _state: &mut [f64]) -> Result<(), ClassError> {
        Ok(())
    }

    /// The wrench as the state has it, of a load whose [`BodyLoad::begin`] decides what time changes in it: an engine foretells with
    /// it how the load goes on from the step before. It is linear in the axes, which may be the mean of two poses. None of others.
    fn held(&self, _at: &Underway, _state: &[f64]) -> Option<Six> {
        None
    }

    /// The load at a trial of the end of the step that was begun.
    ///
    /// # Errors
    /// A place for which it has no value.
    fn moving(&self, at: &Underway, _state: &[f64]) -> Result<MovingLoad, ClassError> {
        self.load(at.pose).map(MovingLoad::of)
    }

    /// What the load adds to the inertia of the body over the step that was begun: -d(wrench)/d(acceleration of the origin, of the
    /// rotation), global axes (kg, kg m, kg m2). The wrench of [`BodyLoad::moving`] is without it: the engine has the acceleration at
    /// the end of the step, where that of the velocities of both ends would be late by half a step. None of most loads.
    fn inertia(&self, _state: &[f64]) -> Option<Matrix6<f64>> {
        None
    }

    /// The categories besides its own in which parts of the load are counted. Reports have a place for each of them.
    fn other_categories(&self) -> &'static [Category] {
        &[]
    }

    /// The part of the load that is counted in one of [`BodyLoad::other_categories`] instead of its own (N, N m; as the load itself).
    fn part(&self, _category: Category, _at: &Underway, _state: &[f64]) -> Six {
        Six::zeros()
    }

    /// Adds what [`BodyLoad::moving`] gives; a load of which little is other than zero does it with less work.
    ///
    /// # Errors
    /// As [`BodyLoad::moving`].
    fn add(&self, at: &Underway, state: &[f64], out: &mut MovingLoad) -> Result<(), ClassError> {
        let made = self.moving(at, state)?;
        out.load.wrench += made.load.wrench;
        out.load.stiffness += made.load.stiffness;
        out.damping += made.damping;
        Ok(())
    }

    /// The step is accepted with its end there.
    fn commit(&self, _at: &Underway, _state: &mut [f64]) {}
}
