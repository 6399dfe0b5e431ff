//! A structure and its tethers in time.
//!
//! The structure goes by two stages, `a1 = M^-1 F(t, x, v)` and `a2 = M^-1 F(t + h, x + v h + a1 h^2/2, v + a1 h)`, of which
//! `v' = v + (a1 + a2) h/2` and `x' = x + v h + (2 a1 + a2) h^2/6`, the acceleration being straight over the step. In each stage the pull of
//! the tethers, which goes by places alone, is found first, then the acceleration of the structure, then that of the tethers, which ride on
//! it. For a spring w the scheme is stable to w h = 2 (its roots: determinant `1 - (w h)^4/12`, trace `2 - (w h)^2 + (w h)^4/12`).

use super::rig::{Rig, RigChange, StepStage};
use super::tether::InstalledTether;
use crate::compatibility::{Compatibility, VesselScheme};
use crate::structure::flow::{FlowAt, WaterFlow};
use crate::structure::{Structure, StructureForces};
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::f64::consts::TAU;
use windlass_base::dense::{Cholesky, SymmetricEigen, never};
use windlass_base::message::Message;
use windlass_base::pose::{Pose, Six};
use windlass_base::units::Dim;
use windlass_hydro::{BodyStep, cross};
use windlass_model::ClassError;

/// Steps of a run at most.
pub const MAX_TIME_STEPS: usize = 100_000_000;
/// The longest step times the highest frequency of the structure on its tethers.
const MAX_STEP_TIMES_FREQUENCY: f64 = 2.0;

/// Where a run starts and how it goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstalledRunSettings {
    /// Time of the first state (s).
    pub start: f64,
    /// Step (s).
    pub step: f64,
    /// Number of states, the first one counted.
    pub states: usize,
    /// The centre of gravity of the structure and its axes at the start.
    pub pose: Pose,
    /// Velocity of the centre of gravity (m/s) and rotation (rad/s), global axes.
    pub velocity: Six,
}

/// What happened to a tether.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherEvent {
    /// When (s).
    pub time: f64,
    /// Its number, from 0.
    pub tether: usize,
    /// What.
    pub change: RigChange,
}

/// A state of the history, as an observer sees it.
#[derive(Debug)]
pub struct Moment<'a> {
    /// Number of the state, from 0.
    pub state: usize,
    /// Time (s).
    pub time: f64,
    /// Centre of gravity and axes of the structure.
    pub pose: Pose,
    /// Velocity of the centre of gravity and rotation, global axes.
    pub velocity: Six,
    /// Their change with time.
    pub acceleration: Six,
    /// What acts on the structure.
    pub forces: &'a StructureForces,
    /// Expected error of the step (m, rad): `-(a_n - 2 a_n-1 + a_n-2) h^2/24`, nothing being before the start.
    pub error: Six,
    /// The tethers.
    pub tethers: &'a [Rig],
    /// What happened to them.
    pub events: &'a [TetherEvent],
}

/// Who is shown each state of a run.
pub trait InstalledObserver {
    /// Takes a state.
    ///
    /// # Errors
    /// What ends the run.
    fn observe(&mut self, moment: &Moment) -> Result<(), ClassError>;

    /// Called before each state and at the end, where the run can be resumed: the number of the state that comes next, and what
    /// [`Installation::resume`] needs.
    ///
    /// # Errors
    /// What ends the run.
    fn checkpoint(&mut self, _next: usize, _numbers: &dyn Fn() -> Vec<f64>) -> Result<(), ClassError> {
        Ok(())
    }
}

/// What moves of the structure: place, velocity, and its accelerations at the two states before.
#[derive(Clone, Copy, Debug)]
struct StructureMotion {
    pose: Pose,
    velocity: Six,
    earlier: [Six; 2],
}

impl StructureMotion {
    const NUMBERS: usize = 30;

    fn numbers(&self) -> Vec<f64> {
        let pose = self.pose.origin.iter().chain(self.pose.axes.iter());
        pose.chain(self.velocity.iter()).chain(self.earlier.iter().flatten()).copied().collect()
    }

    fn from_numbers(numbers: &[f64]) -> Option<Self> {
        let part = |from: usize, count: usize| numbers.get(from..from + count);
        Some(StructureMotion {
            pose: Pose {
                origin: Vector3::from_column_slice(part(0, 3)?),
                axes: Matrix3::from_column_slice(part(3, 9)?),
            },
            velocity: Six::from_column_slice(part(12, 6)?),
            earlier: [Six::from_column_slice(part(18, 6)?), Six::from_column_slice(part(24, 6)?)],
        })
    }
}

/// A structure with its tethers in its water, ready to run.
#[derive(Debug)]
pub struct Installation<'a> {
    structure: &'a mut dyn Structure,
    rigs: Vec<Rig>,
    flow: &'a WaterFlow,
    compatibility: Compatibility,
}

impl<'a> Installation<'a> {
    /// A structure with its tethers.
    ///
    /// # Errors
    /// A tether that cannot be reckoned with.
    pub fn new(
        structure: &'a mut dyn Structure,
        tethers: Vec<InstalledTether>,
        flow: &'a WaterFlow,
        compatibility: Compatibility,
    ) -> Result<Self, ClassError> {
        let rigs = tethers.into_iter().map(|tether| Rig::new(tether, [flow.density, flow.gravity], &compatibility));
        Ok(Installation { structure, rigs: rigs.collect::<Result<_, _>>()?, flow, compatibility })
    }

    /// Runs, showing each state.
    ///
    /// # Errors
    /// A course that cannot be run, a step too long for the structure on its tethers, a tether too short for its span; what has no value on
    /// the way, with its time; what the observer says.
    pub fn run(
        &mut self,
        course: &InstalledRunSettings,
        observer: &mut dyn InstalledObserver,
    ) -> Result<(), ClassError> {
        let start = StructureMotion { pose: course.pose, velocity: course.velocity, earlier: [Six::zeros(); 2] };
        self.run_on(course, (0, start), observer)
    }

    /// Goes on from a checkpoint of a run of the same course: the number of the state that comes next, and the numbers of
    /// [`InstalledObserver::checkpoint`]. It comes to the numbers of the run that was not interrupted, bit for bit.
    ///
    /// # Errors
    /// Those of [`Installation::run`]; numbers of another structure or of other tethers.
    pub fn resume(
        &mut self,
        course: &InstalledRunSettings,
        (next, numbers): (usize, &[f64]),
        observer: &mut dyn InstalledObserver,
    ) -> Result<(), ClassError> {
        let other = || ClassError::new("the checkpoint is not one of this structure and its tethers");
        let start = StructureMotion::from_numbers(numbers).ok_or_else(other)?;
        let mut rest = numbers.get(StructureMotion::NUMBERS..).unwrap_or_default();
        for rig in &mut self.rigs {
            rest = rig.take_up(rest).ok_or_else(other)?;
        }
        if !self.structure.remember(rest) {
            return Err(other());
        }
        self.run_on(course, (next, start), observer)
    }

    /// What a checkpoint holds.
    fn numbers(&self, at: &StructureMotion) -> Vec<f64> {
        let mut numbers = at.numbers();
        self.rigs.iter().for_each(|rig| rig.write(&mut numbers));
        numbers.extend(self.structure.memory());
        numbers
    }

    fn run_on(
        &mut self,
        course: &InstalledRunSettings,
        (from, mut at): (usize, StructureMotion),
        observer: &mut dyn InstalledObserver,
    ) -> Result<(), ClassError> {
        course.check()?;
        for rig in &self.rigs {
            let attachment = course.pose.point(rig.attachment());
            rig.tether().spans((attachment - rig.tether().anchor).norm())?;
        }
        let dt = course.step;
        let mut water = self.flow.at_time(course.start);
        let mut forces = [StructureForces::default(), StructureForces::default()];
        let mut events = Vec::with_capacity(self.rigs.len());
        for state in from..course.states {
            observer.checkpoint(state, &|| self.numbers(&at))?;
            let StructureMotion { pose, velocity, earlier } = at;
            let time = course.start + state as f64 * dt;
            water.move_to(time);
            let led = if state == 0 { 0.0 } else { dt };
            let [first, second] = &mut forces;
            let now = BodyStep { time, dt: led, pose: &pose, velocity: &velocity };
            let a1 = self.accelerate(StepStage::First, &now, &water, first)?;
            if state == 0 {
                self.bears(course, first)?;
            }
            events.clear();
            for (tether, rig) in self.rigs.iter_mut().enumerate() {
                let change = rig.change(time, &self.compatibility);
                events.extend(change.map(|change| TetherEvent { time, tether, change }));
            }
            self.tethers(StepStage::First, (&pose, &a1), &water, (dt, time))?;
            let ahead = (pose.after_motion(&(velocity * dt + a1 * (0.5 * dt * dt))), velocity + a1 * dt);
            water.move_to(time + dt);
            let end = BodyStep { time: time + dt, dt, pose: &ahead.0, velocity: &ahead.1 };
            let a2 = self.accelerate(StepStage::Second, &end, &water, second)?;
            self.tethers(StepStage::Second, (&ahead.0, &a2), &water, (dt, time))?;
            let error = (a1 - earlier[0] * 2.0 + earlier[1]) * (-dt * dt / 24.0);
            observer.observe(&Moment {
                state,
                time,
                pose,
                velocity,
                acceleration: a1,
                forces: first,
                error,
                tethers: &self.rigs,
                events: &events,
            })?;
            let second = match self.compatibility.vessel_scheme {
                VesselScheme::StraightAcceleration => (a1 * 2.0 + a2) / 6.0,
                VesselScheme::MeanVelocity => (a1 + a2) / 4.0,
            };
            at = StructureMotion {
                pose: pose.after_motion(&(velocity * dt + second * (dt * dt))),
                velocity: velocity + (a1 + a2) * (0.5 * dt),
                earlier: [a1, earlier[0]],
            };
            self.rigs.iter_mut().for_each(|rig| rig.advance(dt));
        }
        observer.checkpoint(course.states.max(from), &|| self.numbers(&at))
    }

    /// Pull of the tethers, forces and acceleration of the structure.
    fn accelerate(
        &mut self,
        which: StepStage,
        at: &BodyStep,
        water: &FlowAt,
        forces: &mut StructureForces,
    ) -> Result<Six, ClassError> {
        forces.mooring = Six::zeros();
        for rig in &mut self.rigs {
            let pull = rig.pull(which, (at.pose, at.velocity), water, &self.compatibility);
            forces.mooring += pull.map_err(|e| with_tether_and_time(e, rig.tether(), at.time))?;
        }
        self.structure.forces(at, water, which == StepStage::First, forces)?;
        if !self.compatibility.tension_alone_on_structure {
            for rig in &self.rigs {
                forces.inertia += rig.entrained_inertia(at.pose);
            }
        }
        forces.acceleration().map_err(|mut e| {
            e.message =
                std::mem::take(&mut e.message).then(Message::with_values(" (time {})", &[(at.time, Dim::Time)]));
            e
        })
    }

    /// Accelerations of the tethers, and what their elements bear.
    fn tethers(
        &mut self,
        which: StepStage,
        structure: (&Pose, &Six),
        water: &FlowAt,
        (dt, time): (f64, f64),
    ) -> Result<(), ClassError> {
        let stage_in_tables = if self.compatibility.second_stage_tables { StepStage::Second } else { StepStage::First };
        for rig in &mut self.rigs {
            rig.solve(which, structure, water, dt).map_err(|e| with_tether_and_time(e, rig.tether(), time))?;
            if which == stage_in_tables {
                rig.bear(which, water, dt, time);
            }
        }
        Ok(())
    }

    /// Sees that the step is short enough for the structure on its tethers.
    fn bears(&self, course: &InstalledRunSettings, forces: &StructureForces) -> Result<(), ClassError> {
        let mut stiffness = Matrix6::zeros();
        for rig in &self.rigs {
            let (along, arm) = (rig.axis().along, course.pose.axes * rig.attachment());
            let turning = cross(arm) * along;
            let row = Six::new(along.x, along.y, along.z, turning.x, turning.y, turning.z);
            stiffness += row * row.transpose() * (rig.axial_stiffness() * rig.tether().group);
        }
        let Ok(factor) = Cholesky::new(forces.inertia, &never) else { return Ok(()) };
        let half = factor.lower();
        let Some(left) = half.solve_lower_triangular(&stiffness) else { return Ok(()) };
        let Some(whole) = half.solve_lower_triangular(&left.transpose()) else { return Ok(()) };
        let Ok(swings) = SymmetricEigen::new(whole, &never) else { return Ok(()) };
        let highest = swings.values.max().max(0.0).sqrt();
        if highest * course.step <= MAX_STEP_TIMES_FREQUENCY {
            return Ok(());
        }
        let text =
            "a step of {} is too long: the structure swings on its tethers in {}, for which {} at most is stable";
        let period = TAU / highest;
        Err(ClassError::with_values(
            text,
            &[(course.step, Dim::Time), (period, Dim::Time), (MAX_STEP_TIMES_FREQUENCY / highest, Dim::Time)],
        )
        .help(format!("a tenth of the period, {:.3} s, follows that motion", period / 10.0)))
    }
}

impl InstalledRunSettings {
    /// Sees that it can be run.
    fn check(&self) -> Result<(), ClassError> {
        let finite = self.start.is_finite() && self.velocity.iter().all(|v| v.is_finite());
        let position = self.pose.origin.iter().chain(self.pose.axes.iter()).all(|v| v.is_finite());
        if !(finite && position) {
            return Err(ClassError::new("the run has a start that is no finite number"));
        }
        if !(self.step.is_finite() && self.step > 0.0) {
            return Err(ClassError::with_values(
                "the step of the run is {}; it must be above zero",
                &[(self.step, Dim::Time)],
            ));
        }
        if self.states == 0 || self.states > MAX_TIME_STEPS {
            return Err(ClassError::new(format!("a run has 1 to {MAX_TIME_STEPS} steps, not {}", self.states)));
        }
        Ok(())
    }
}

/// An error of a tether with its name and the time.
fn with_tether_and_time(mut error: ClassError, tether: &InstalledTether, time: f64) -> ClassError {
    let subject =
        Message::from(format!("tether {}", tether.name)).then(Message::with_values(" at {}", &[(time, Dim::Time)]));
    error.message = error.message.with_subject(subject);
    error
}
