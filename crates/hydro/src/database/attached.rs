//! What the database of a body brings among its loads.

use super::excitation::Excitation;
use super::memory::{MOST_LAGS, Memory};
use super::radiation::Radiation;
use super::slow_drift::SlowDrift;
use crate::body_load::{BodyLoad, MovingLoad, Underway};
use crate::sea::Sea;
use crate::steady::Steady;
use crate::{Category, Load, transferred};
use nalgebra::Matrix6;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{
    AttachedDatabase, Body, ClassError, Database, DriftMethod, LinearHydrostatics, LoadKind, Mass, Model, PartLoad,
};

/// The step of the memory where the environment gives none (s).
const USUAL_STEP: f64 = 0.1;

/// What a database brings.
#[derive(Debug)]
pub struct Brought {
    /// Its loads.
    pub loads: Vec<Box<dyn BodyLoad>>,
    /// Added mass at infinite frequency about the body's origin.
    pub added_mass: Matrix6<f64>,
}

/// The radiated waves of a body as a load.
#[derive(Clone, Debug)]
pub struct RadiationLoad {
    memory: Memory,
}

impl RadiationLoad {
    /// The memory of a radiation over a time (s) with a step (s).
    ///
    /// # Errors
    /// More steps than are kept.
    pub fn new(radiation: &Radiation, step: f64, length: f64) -> Result<Self, ClassError> {
        let lags = length / step;
        if !(lags.is_finite() && lags >= 1.0 && lags <= MOST_LAGS as f64) {
            let text = format!("a memory of {length} s in steps of {step} s is none of 1 to {MOST_LAGS} steps");
            return Err(ClassError::new(text));
        }
        let kernel = |time: f64| radiation.faded_at(time, length);
        Ok(RadiationLoad { memory: Memory::new(&kernel, (radiation.finest(), length), step) })
    }
}

/// A velocity in the body's axes, or a force in them in global ones.
fn in_axes(six: &Six, axes: &nalgebra::Matrix3<f64>) -> Six {
    let (a, b) = (axes * six.fixed_rows::<3>(0), axes * six.fixed_rows::<3>(3));
    Six::new(a.x, a.y, a.z, b.x, b.y, b.z)
}

impl BodyLoad for RadiationLoad {
    fn category(&self) -> Category {
        Category::RadiationDrag
    }

    /// A body at rest radiates nothing.
    fn load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn states(&self) -> usize {
        self.memory.states()
    }

    fn begin(&self, ahead: &Underway, state: &mut [f64]) -> Result<(), ClassError> {
        self.memory.begin(ahead.time, ahead.dt, state);
        Ok(())
    }

    fn held(&self, at: &Underway, state: &[f64]) -> Option<Six> {
        let velocity = in_axes(at.velocity, &at.pose.axes.transpose());
        Some(in_axes(&self.memory.force(&velocity, state).0, &at.pose.axes))
    }

    fn moving(&self, at: &Underway, state: &[f64]) -> Result<MovingLoad, ClassError> {
        let velocity = in_axes(at.velocity, &at.pose.axes.transpose());
        let (force, damping) = self.memory.force(&velocity, state);
        let wrench = in_axes(&force, &at.pose.axes);
        let damping = crate::in_pose(&damping, at.pose);
        // the force turns with the axes, and so do those in which the velocity is taken
        let halves = |six: &Six| [six.fixed_rows::<3>(0).cross_matrix(), six.fixed_rows::<3>(3).cross_matrix()];
        let (turned, faster) = (halves(&wrench), halves(at.velocity));
        let mut stiffness = Matrix6::zeros();
        for (row, own) in [0, 3].into_iter().zip(turned) {
            let by_velocity =
                damping.fixed_view::<3, 3>(row, 0) * faster[0] + damping.fixed_view::<3, 3>(row, 3) * faster[1];
            stiffness.fixed_view_mut::<3, 3>(row, 3).copy_from(&(own + by_velocity));
        }
        Ok(MovingLoad { load: Load { wrench, stiffness }, damping })
    }

    fn commit(&self, at: &Underway, state: &mut [f64]) {
        let velocity = in_axes(at.velocity, &at.pose.axes.transpose());
        self.memory.commit(at.time, at.dt, &velocity, state);
    }
}

/// What the database of a body brings: at rest the mean drift, under way all of it, with the sea there is.
///
/// # Errors
/// A database that lacks what is asked of it; a body whose buoyancy would count twice.
pub fn of(model: &Model, body: &Body, under_way: Option<Option<&Arc<Sea>>>) -> Result<Option<Brought>, ClassError> {
    let Some(attached) = &body.database else { return Ok(None) };
    let data = attached.data.as_ref();
    drift_once(model, body, attached)?;
    let mut loads: Vec<Box<dyn BodyLoad>> = Vec::new();
    let mut added_mass = Matrix6::zeros();
    if let Some(radiation) = Radiation::of(data)? {
        added_mass = radiation.infinite;
        if under_way.is_some() {
            let step = model.environment.time.map_or(USUAL_STEP, |t| t.step);
            let length = attached.memory.unwrap_or_else(|| radiation.memory());
            loads.push(Box::new(RadiationLoad::new(&radiation, step, length)?));
        }
    }
    if attached.hydrostatics {
        loads.push(Box::new(hydrostatics(model, body, attached)?));
    }
    match under_way {
        Some(Some(sea)) => {
            if !data.excitation.is_empty() {
                loads.push(Box::new(Excitation::of(data, sea)?));
            }
            loads.extend(slow(attached, sea)?.map(|l| Box::new(l) as Box<dyn BodyLoad>));
        }
        Some(None) => {}
        None => loads.extend(mean(model, attached)?.map(|l| Box::new(l) as Box<dyn BodyLoad>)),
    }
    let loads = loads.into_iter().map(|load| {
        let factor = model.multipliers.of(load.category().name(), &body.name);
        if factor == 1.0 { load } else { crate::gathered::multiplied(load, factor) }
    });
    Ok(Some(Brought { loads: loads.collect(), added_mass }))
}

/// Sees that no records give the drift that the database brings.
fn drift_once(model: &Model, body: &Body, attached: &AttachedDatabase) -> Result<(), ClassError> {
    let data = attached.data.as_ref();
    if attached.drift == DriftMethod::None || data.drift.is_none() && data.qtf.is_none() {
        return Ok(());
    }
    let on_body = |l: &PartLoad| model.parts_of(body).any(|p| Model::key(&p.name) == Model::key(&l.part));
    match model.loads.iter().find(|l| matches!(l.kind, LoadKind::Drift { .. }) && on_body(l)) {
        None => Ok(()),
        Some(load) => {
            let text = format!("{} has #DRIFT besides the drift of its database ({})", body.name, data.source);
            Err(ClassError::new(text)
                .at(load.span)
                .help("the drift would count twice: leave out #DRIFT, or give DATABASE -DRIFT NONE"))
        }
    }
}

/// The mean drift by heading and frequency: as it is given, or of the pairs of equal waves.
fn drift_of(data: &Database) -> Option<windlass_model::DriftTable> {
    data.drift.clone().or_else(|| data.qtf.as_ref().map(super::slow_drift::mean_drift))
}

/// The slow drift of a sea.
fn slow(attached: &AttachedDatabase, sea: &Arc<Sea>) -> Result<Option<SlowDrift>, ClassError> {
    let data = attached.data.as_ref();
    if attached.drift == DriftMethod::Full
        && let Some(qtf) = &data.qtf
    {
        return SlowDrift::full(&Arc::new(qtf.clone()), data.reference, sea).map(Some);
    }
    let Some(table) = drift_of(data) else { return Ok(None) };
    match attached.drift {
        DriftMethod::None => Ok(None),
        DriftMethod::Mean => SlowDrift::mean(&table, data.reference, sea).map(Some),
        DriftMethod::Newman | DriftMethod::Full => SlowDrift::newman(&table, data.reference, sea).map(Some),
    }
}

/// The mean drift on the body at rest.
fn mean(model: &Model, attached: &AttachedDatabase) -> Result<Option<SlowDrift>, ClassError> {
    let data = attached.data.as_ref();
    let Some(table) = drift_of(data).filter(|_| attached.drift != DriftMethod::None) else { return Ok(None) };
    let steady = Steady::of(model)?;
    if steady.waves.is_empty() {
        return Ok(None);
    }
    let seas: Vec<(f64, &[(f64, f64)])> =
        steady.waves.iter().map(|(toward, waves)| (toward.y.atan2(toward.x), waves.energies.as_slice())).collect();
    SlowDrift::mean_of(&table, data.reference, &seas).map(Some)
}

/// The hydrostatics of the database about the centre of gravity, with a buoyancy that bears the weight.
///
/// The matrix of a source holds the moment of the weight, too; about the centre of gravity that is nothing, so that nothing counts twice.
fn hydrostatics(model: &Model, body: &Body, attached: &AttachedDatabase) -> Result<LinearHydrostatics, ClassError> {
    let data = attached.data.as_ref();
    let refuse = |text: String| ClassError::new(text).at(attached.span);
    let Some(stiffness) = data.hydrostatics else {
        return Err(refuse(format!("the database ({}) has no hydrostatics", data.source)));
    };
    if body.linear.is_some() || crate::Hull::of(model, body)?.is_some() {
        let text = format!("{} has a hull or #HYDROSTATIC besides the hydrostatics of its database", body.name);
        return Err(refuse(text).help("leave out -HYDROSTATICS YES, or give the pieces -PERMEABILITY 0"));
    }
    let gravity = model.defaults.gravity;
    let mass = Mass::of(model.parts_of(body), gravity);
    let arm = data.reference - mass.centre;
    Ok(LinearHydrostatics {
        at: mass.centre.into(),
        // the origin of the source stands on the water
        height: mass.centre.z - attached.at[2],
        buoyancy: mass.mass * gravity,
        stiffness: transferred(&stiffness, arm, arm),
        span: attached.span,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_force_of_memory_changes_with_turning_and_velocity_by_its_differences() {
        let kernel = |time: f64| {
            let pair = |i: usize, j: usize| if i == j { 3.0 } else { 0.2 * (i as f64 - 2.0 * j as f64) };
            Matrix6::from_fn(pair) / (1.0 + 2.0 * time)
        };
        let load = RadiationLoad { memory: Memory::new(&kernel, (0.1, 5.0), 0.1) };
        let mut state = vec![0.0; load.states()];
        let pose = Pose::default().moved(&Six::new(0.0, 0.0, 0.0, 0.4, -0.7, 1.1));
        let velocity = Six::new(1.0, 2.0, -1.0, 0.3, -0.5, 0.2);
        for n in 0..20 {
            let then = velocity * (0.3 * f64::from(n)).cos();
            let at = Underway { time: 0.1 * f64::from(n + 1), dt: 0.1, pose: &pose, velocity: &then };
            load.begin(&at, &mut state).unwrap();
            load.commit(&at, &mut state);
        }
        load.begin(&Underway { time: 2.1, dt: 0.1, pose: &pose, velocity: &velocity }, &mut state).unwrap();
        let at = |pose: &Pose, velocity: &Six| load.moving(&Underway { time: 2.1, dt: 0.1, pose, velocity }, &state);
        let whole = at(&pose, &velocity).unwrap();
        for n in 0..6 {
            let mut by = Six::zeros();
            by[n] = 1e-5;
            let turned = |by: Six| at(&pose.moved(&by), &velocity).unwrap().load.wrench;
            let faster = |by: Six| at(&pose, &(velocity + by)).unwrap().load.wrench;
            // forces of 100: rounded 1e-14, over 1e-5; the third derivative 100 times 1e-10
            let stiffness = (turned(-by) - turned(by)) / 2e-5 - whole.load.stiffness.column(n);
            let damping = (faster(-by) - faster(by)) / 2e-5 - whole.damping.column(n);
            assert!(stiffness.amax() < 1e-7 && damping.amax() < 1e-7, "{n}: {stiffness} {damping}");
        }
        assert!(whole.load.stiffness.amax() > 0.1 && whole.load.wrench.amax() > 0.1);
    }
}
