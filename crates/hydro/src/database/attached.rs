//! What the database of a body brings among its loads.

use super::drift_damping::{DriftByVelocity, DriftWater};
use super::excitation::Excitation;
use super::interaction::own_radiation;
use super::memory::{MAX_LAGS, RetardationMemory};
use super::radiation::Radiation;
use super::slow_drift::{DriftCoefficients, SlowDrift};
use crate::body_load::{BodyLoad, BodyStep, DynamicLoad, InertialLoad, PreparedLoad, StatefulLoad};
use crate::low_frequency::{LowFrequency, LowFrequencyPosition, dividing_period};
use crate::sea::Sea;
use crate::steady::{Medium, Steady};
use crate::{Category, Load, heading_axes, in_pose, move_stiffness};
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{
    AttachedDatabase, Body, ClassError, Database, DriftMethod, DriftTable, LinearHydrostatics, LoadKind, Mass, Model,
    PartLoad,
};

/// The step of the memory where the environment gives none (s).
const USUAL_STEP: f64 = 0.1;

/// Frequencies from which on every second one is looked at alone.
const MIN_HALVED: usize = 5;

/// What a database brings.
#[derive(Debug)]
pub struct DatabaseLoads {
    /// Its loads.
    pub loads: Vec<Box<dyn BodyLoad>>,
    /// Added mass at infinite frequency about the body's origin, of a body at rest; under way it is among the loads.
    pub added_mass: Matrix6<f64>,
}

/// Linear motion about the low-frequency heading of a body, in a state of [`LinearMotion::STATES`] values: the heading and the small rotations of the
/// place expected at the end of a step are those of the step.
///
/// A step of time integrates the rate of rotation to the second order of its length, so that the mean of the rates of small rotations is off by as much
/// of a product of two motions. The rates of a step have that of the step before added, by which its rotation went beyond the mean of its rates:
/// their mean is that of the rotation itself.
#[derive(Clone, Copy, Debug)]
pub(super) struct LinearMotion {
    pub(super) slow: LowFrequency,
}

/// Where a state of [`LinearMotion`] has the heading, what gives rates of small rotations of that of rotation, what is added to them in the step, and
/// in the next one; and of the end of the last step whether there was one, the heading, the small rotation, its rates without what was added.
const HEADING_STATE: usize = LowFrequency::STATES;
const RATES_STATE: usize = HEADING_STATE + 1;
const ADDED_STATE: usize = RATES_STATE + 9;
const NEXT_STATE: usize = ADDED_STATE + 3;
const LAST_STATE: usize = NEXT_STATE + 3;

impl LinearMotion {
    pub(super) const STATES: usize = LAST_STATE + 8;

    pub(super) fn begin(&self, ahead: &BodyStep, state: &mut [f64]) {
        let (own, kept) = state.split_at_mut(HEADING_STATE);
        let slow = self.slow.predict(ahead, own);
        let rates = slow.rates(&ahead.pose.axes);
        kept.iter_mut()
            .zip(std::iter::once(&slow.heading).chain(rates.iter()))
            .for_each(|(kept, value)| *kept = *value);
        state.copy_within(NEXT_STATE..LAST_STATE, ADDED_STATE);
    }

    pub(super) fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        let slow = LowFrequencyPosition { heading: state[HEADING_STATE], ..LowFrequencyPosition::default() };
        let (angle, rates) = (slow.rotation(&at.pose.axes), slow.rates(&at.pose.axes) * at.velocity.fixed_rows::<3>(3));
        let last = |from: usize| {
            Vector3::new(state[LAST_STATE + from], state[LAST_STATE + from + 1], state[LAST_STATE + from + 2])
        };
        if state[LAST_STATE] > 0.0 && at.dt > 0.0 {
            let turned = angle - last(2) + Vector3::z() * (slow.heading - state[LAST_STATE + 1]);
            let added = turned / at.dt - (rates + last(5)) * 0.5;
            state[NEXT_STATE..LAST_STATE].copy_from_slice(added.as_slice());
        }
        (state[LAST_STATE], state[LAST_STATE + 1]) = (1.0, slow.heading);
        state[LAST_STATE + 2..LAST_STATE + 5].copy_from_slice(angle.as_slice());
        state[LAST_STATE + 5..LAST_STATE + 8].copy_from_slice(rates.as_slice());
        self.slow.commit(at, &mut state[..HEADING_STATE]);
    }

    /// The axes of the heading.
    pub(super) fn axes(state: &[f64]) -> Matrix3<f64> {
        LowFrequencyPosition { heading: state[HEADING_STATE], ..LowFrequencyPosition::default() }.axes()
    }

    /// From a rate of rotation (global axes) to rates of small rotations about the axes of the heading.
    fn rates(state: &[f64]) -> Matrix3<f64> {
        Matrix3::from_column_slice(&state[RATES_STATE..ADDED_STATE])
    }

    /// The rates of the place and of small rotations, in axes of the heading.
    pub(super) fn velocity(at: &BodyStep, state: &[f64]) -> Six {
        let along = LinearMotion::axes(state).transpose() * at.velocity.fixed_rows::<3>(0);
        let added = Vector3::from_iterator(state.iter().skip(ADDED_STATE).copied().chain([0.0; 3]).take(3));
        let turning = LinearMotion::rates(state) * at.velocity.fixed_rows::<3>(3) + added;
        Six::new(along.x, along.y, along.z, turning.x, turning.y, turning.z)
    }

    /// A force in axes of the heading in global ones.
    fn global(force: &Six, state: &[f64]) -> Six {
        let axes = LinearMotion::axes(state);
        let (a, b) = (axes * force.fixed_rows::<3>(0), axes * force.fixed_rows::<3>(3));
        Six::new(a.x, a.y, a.z, b.x, b.y, b.z)
    }

    /// A force, and its change with [`LinearMotion::velocity`], -dF/dv, in global axes.
    fn load(force: &Six, damping: &Matrix6<f64>, state: &[f64]) -> DynamicLoad {
        LinearMotion::load_between(force, damping, state, state)
    }

    /// The same of a force on one body that changes with the motion of another.
    pub(super) fn load_between(force: &Six, damping: &Matrix6<f64>, state: &[f64], other: &[f64]) -> DynamicLoad {
        let (axes, others, rates) = (LinearMotion::axes(state), LinearMotion::axes(other), LinearMotion::rates(other));
        let mut global = Matrix6::zeros();
        for (row, column) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
            let turned = if column == 0 { others.transpose() } else { rates };
            let block = axes * damping.fixed_view::<3, 3>(row, column) * turned;
            global.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        }
        let wrench = LinearMotion::global(force, state);
        DynamicLoad { load: Load { wrench, ..Load::none() }, damping: global }
    }
}

/// The radiated waves of a body as a load: linear in the rates of its place and small rotations in axes of its low-frequency heading, so
/// that the mean force of a motion that comes back to where it was is nothing.
#[derive(Clone, Debug)]
pub struct RadiationLoad {
    memory: RetardationMemory,
    linear: LinearMotion,
}

impl RadiationLoad {
    /// The memory of a radiation over a time (s) with a step (s), and the dividing period (s).
    ///
    /// # Errors
    /// More steps than are kept; a database of one frequency.
    pub fn new(radiation: &Radiation, (step, length): (f64, f64), dividing: f64) -> Result<Self, ClassError> {
        radiation.check_memory()?;
        check_lags(length, step)?;
        let kernel = |time: f64| radiation.tapered_retardation(time, length);
        let memory = RetardationMemory::new(&kernel, (radiation.finest(), length), step);
        Ok(RadiationLoad { memory, linear: LinearMotion { slow: LowFrequency::new(dividing) } })
    }
}

impl BodyLoad for RadiationLoad {
    fn category(&self) -> Category {
        Category::RadiationDrag
    }

    /// A body at rest radiates nothing.
    fn mean_load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let (own, memory) = state.split_at(LinearMotion::STATES);
        let (force, damping) = self.memory.force(&LinearMotion::velocity(at, own), memory);
        Ok(LinearMotion::load(&force, &damping, own))
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }

    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        Some(self)
    }
}

impl StatefulLoad for RadiationLoad {
    fn states(&self) -> usize {
        LinearMotion::STATES + self.memory.states()
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        let (own, memory) = state.split_at_mut(LinearMotion::STATES);
        self.linear.begin(ahead, own);
        self.memory.begin(ahead.time, ahead.dt, memory);
        Ok(())
    }

    fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        let (own, memory) = state.split_at_mut(LinearMotion::STATES);
        self.memory.commit(at.time, at.dt, &LinearMotion::velocity(at, own), memory);
        self.linear.commit(at, own);
    }
}

impl PreparedLoad for RadiationLoad {
    fn prepared_wrench(&self, at: &BodyStep, state: &[f64]) -> Six {
        let (own, memory) = state.split_at(LinearMotion::STATES);
        LinearMotion::global(&self.memory.force(&LinearMotion::velocity(at, own), memory).0, own)
    }
}

/// Sees that a memory (s) in steps (s) is one that is kept.
pub(super) fn check_lags(length: f64, step: f64) -> Result<(), ClassError> {
    let lags = length / step;
    if lags.is_finite() && lags >= 1.0 && lags <= MAX_LAGS as f64 {
        return Ok(());
    }
    Err(ClassError::new(format!("a memory of {length} s in steps of {step} s is none of 1 to {MAX_LAGS} steps")))
}

/// The step of the memory in a model (s).
pub(super) fn memory_step(model: &Model) -> f64 {
    model.environment.time.map_or(USUAL_STEP, |t| t.step)
}

/// Linear damping of a body with a database (`#DRAG`, `#DAMP`): as its radiation it is about the low-frequency heading.
#[derive(Clone, Debug)]
struct DampingLoad {
    /// About the origin of the body.
    damping: Matrix6<f64>,
    linear: LinearMotion,
}

impl BodyLoad for DampingLoad {
    fn category(&self) -> Category {
        Category::RadiationDrag
    }

    fn mean_load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        Ok(LinearMotion::load(&-(self.damping * LinearMotion::velocity(at, state)), &self.damping, state))
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }

    fn as_prepared(&self) -> Option<&dyn PreparedLoad> {
        Some(self)
    }
}

impl StatefulLoad for DampingLoad {
    fn states(&self) -> usize {
        LinearMotion::STATES
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        self.linear.begin(ahead, state);
        Ok(())
    }

    fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        self.linear.commit(at, state);
    }
}

impl PreparedLoad for DampingLoad {
    fn prepared_wrench(&self, at: &BodyStep, state: &[f64]) -> Six {
        LinearMotion::global(&-(self.damping * LinearMotion::velocity(at, state)), state)
    }
}

/// The added mass at infinite frequency as a load, in axes of the low-frequency heading.
#[derive(Clone, Debug)]
struct AddedMassLoad {
    /// About the origin of the body.
    infinite: Matrix6<f64>,
    linear: LinearMotion,
}

impl BodyLoad for AddedMassLoad {
    fn category(&self) -> Category {
        Category::AddedInertia
    }

    fn mean_load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }

    fn as_inertial(&self) -> Option<&dyn InertialLoad> {
        Some(self)
    }
}

impl StatefulLoad for AddedMassLoad {
    fn states(&self) -> usize {
        LinearMotion::STATES
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        self.linear.begin(ahead, state);
        Ok(())
    }

    fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        self.linear.commit(at, state);
    }
}

impl InertialLoad for AddedMassLoad {
    fn inertia(&self, state: &[f64]) -> Matrix6<f64> {
        in_pose(&self.infinite, &Pose { axes: LinearMotion::axes(state), ..Pose::default() })
    }
}

/// What the database of a body brings: at rest the mean drift, under way all of it, with the sea there is. Under way the linear damping
/// of the body becomes a load about its low-frequency heading, and is nothing in `damping` from then on.
///
/// # Errors
/// A database that lacks what is asked of it; a body whose buoyancy would count twice.
pub fn gather_database_loads(
    model: &Model,
    body: &Body,
    under_way: Option<Option<&Arc<Sea>>>,
    damping: &mut Matrix6<f64>,
) -> Result<Option<DatabaseLoads>, ClassError> {
    let Some(attached) = &body.database else { return Ok(None) };
    let data = attached.data.as_ref();
    drift_once(model, body, attached)?;
    let mut loads: Vec<Box<dyn BodyLoad>> = Vec::new();
    let mut added_mass = Matrix6::zeros();
    let mut carried: Vec<Box<dyn BodyLoad>> = Vec::new();
    let dividing = dividing_period(model, under_way.flatten().map(|sea| sea.as_ref()));
    let linear = LinearMotion { slow: LowFrequency::new(dividing) };
    if under_way.is_some() && *damping != Matrix6::zeros() {
        carried.push(Box::new(DampingLoad { damping: std::mem::take(damping), linear }));
    }
    if let Some(radiation) = own_radiation(model, body) {
        let infinite = radiation.infinite;
        if under_way.is_none() {
            // in the axes of the body as it stands
            let pose = Pose::from_place(&body.position);
            let upright = Pose { axes: pose.axes.transpose() * heading_axes(&pose), ..Pose::default() };
            added_mass = in_pose(&infinite, &upright);
        } else if infinite != Matrix6::zeros() {
            carried.push(Box::new(AddedMassLoad { infinite, linear }));
        }
        if under_way.is_some() {
            let step = memory_step(model);
            let length = attached.memory.unwrap_or_else(|| radiation.memory());
            loads.push(Box::new(RadiationLoad::new(&radiation, (step, length), dividing)?));
        }
    }
    if attached.hydrostatics {
        loads.push(Box::new(hydrostatics(model, body, attached)?));
    }
    match under_way {
        Some(Some(sea)) => {
            if !data.excitation.is_empty() {
                loads.push(Box::new(Excitation::new(data, sea)?.with_dividing_period(dividing)));
            }
            loads.extend(build_slow_drift(model, body, attached, sea)?.map(|l| Box::new(l) as Box<dyn BodyLoad>));
        }
        Some(None) => {}
        None => loads.extend(mean_slow_drift(model, body)?.map(|l| Box::new(l) as Box<dyn BodyLoad>)),
    }
    let loads = loads.into_iter().map(|load| {
        let factor = model.multipliers.factor(load.category().name(), &body.name);
        if factor == 1.0 { load } else { crate::body_loads::scale_load(load, factor) }
    });
    Ok(Some(DatabaseLoads { loads: loads.chain(carried).collect(), added_mass }))
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
                .with_span(load.span)
                .help("the drift would count twice: leave out #DRIFT, or give DATABASE -DRIFT NONE"))
        }
    }
}

/// The mean drift by heading and frequency: as it is given, or of the pairs of equal waves.
fn drift_of(data: &Database) -> Option<DriftTable> {
    data.drift.clone().or_else(|| data.qtf.as_ref().map(super::slow_drift::mean_drift))
}

/// What a velocity changes of the mean drift of a body.
#[derive(Clone, Debug)]
pub enum VelocityEffect {
    /// It acts.
    Acts(Box<DriftByVelocity>),
    /// It is left out though the body has drift, for a reason.
    LeftOut(String),
    /// -DD_MULT 0 leaves it out.
    OffByFactor,
    /// The body has no drift by its database, or leaves that out.
    None,
}

impl VelocityEffect {
    fn acting(&self) -> Option<&DriftByVelocity> {
        match self {
            VelocityEffect::Acts(made) => Some(made),
            VelocityEffect::LeftOut(_) | VelocityEffect::OffByFactor | VelocityEffect::None => None,
        }
    }
}

/// What wave drift damping and a current change of the mean drift of a body, in the environment in force.
///
/// # Errors
/// Pieces that give two factors; a current that cannot be computed.
pub fn velocity_effect(model: &Model, body: &Body) -> Result<VelocityEffect, ClassError> {
    let Some(attached) = body.database.as_ref().filter(|attached| attached.drift != DriftMethod::None) else {
        return Ok(VelocityEffect::None);
    };
    let factor = drift_damping_factor(model, body, attached)?;
    let Some(table) = table_in_use(attached) else { return Ok(VelocityEffect::None) };
    if factor == 0.0 {
        return Ok(VelocityEffect::OffByFactor);
    }
    velocity_effect_of(model, attached, &table, factor)
}

fn velocity_effect_of(
    model: &Model,
    attached: &AttachedDatabase,
    table: &DriftTable,
    factor: f64,
) -> Result<VelocityEffect, ClassError> {
    let steady = Steady::streams(model, &model.environment)?;
    let surface = steady.around.tide;
    let depths = [steady.around.depth.map(|depth| depth + surface), attached.data.depth];
    let water = DriftWater {
        gravity: attached.data.gravity,
        depth: depths.into_iter().flatten().reduce(f64::min),
        current: steady.velocity(Medium::Water, surface).0.xy(),
    };
    Ok(match DriftByVelocity::new(table, water, factor) {
        Ok(made) => VelocityEffect::Acts(Box::new(made)),
        Err(reason) => VelocityEffect::LeftOut(reason),
    })
}

/// The factor of the wave drift damping of a body: of its database, else of its pieces, else one.
fn drift_damping_factor(model: &Model, body: &Body, attached: &AttachedDatabase) -> Result<f64, ClassError> {
    if let Some(factor) = attached.drift_damping {
        return Ok(factor);
    }
    let mut given = model.parts_of(body).flat_map(|part| &part.pieces).filter_map(|p| Some((p, p.drift_damping?)));
    let Some((first, factor)) = given.next() else { return Ok(1.0) };
    match given.find(|(_, other)| *other != factor) {
        None => Ok(factor),
        Some((piece, other)) => Err(ClassError::new(format!(
            "{} has one drift, and two factors of its wave drift damping: -DD_MULT {factor} of piece {}, {other} of {}",
            body.name, first.name, piece.name
        ))
        .with_span(piece.span)
        .help("give the pieces of a body the same -DD_MULT")),
    }
}

/// The drift by heading and frequency that acts.
fn table_in_use(attached: &AttachedDatabase) -> Option<DriftTable> {
    let data = attached.data.as_ref();
    match &data.qtf {
        Some(qtf) if attached.drift == DriftMethod::Full => Some(super::slow_drift::mean_drift(qtf)),
        _ => drift_of(data),
    }
}

/// The slow drift of a sea.
fn build_slow_drift(
    model: &Model,
    body: &Body,
    attached: &AttachedDatabase,
    sea: &Arc<Sea>,
) -> Result<Option<SlowDrift>, ClassError> {
    let data = attached.data.as_ref();
    let Some(table) = table_in_use(attached).filter(|_| attached.drift != DriftMethod::None) else { return Ok(None) };
    let effect = velocity_effect(model, body)?;
    let coefficients = DriftCoefficients { table: &table, reference: data.reference, by_velocity: effect.acting() };
    let made = match (attached.drift, &data.qtf) {
        (DriftMethod::Full, Some(qtf)) => SlowDrift::full(&Arc::new(qtf.clone()), coefficients, sea)?,
        (DriftMethod::Mean, _) => SlowDrift::mean(coefficients, sea)?,
        _ => SlowDrift::newman(coefficients, sea)?,
    };
    let environment = &model.environment;
    let stream = Steady::streams(model, environment)?.under_way(model, environment)?;
    Ok(Some(match stream.variation {
        Some(_) if !stream.is_still(Medium::Water) => made.with_stream(Arc::new(stream)),
        _ => made,
    }))
}

/// The mean drift on the body at rest in the waves of the environment; none without waves or drift.
///
/// # Errors
/// As [`velocity_effect`]; waves that cannot be computed.
pub fn mean_slow_drift(model: &Model, body: &Body) -> Result<Option<SlowDrift>, ClassError> {
    let Some(attached) = &body.database else { return Ok(None) };
    let data = attached.data.as_ref();
    let Some(table) = drift_of(data).filter(|_| attached.drift != DriftMethod::None) else { return Ok(None) };
    let effect = velocity_effect(model, body)?;
    mean_of_waves(model, &table, attached, &effect)
}

/// The same of every second frequency of the mean drift, from the last on: how much they differ shows whether the frequencies stand near
/// enough to each other for the slopes that a velocity brings in. None of fewer than five frequencies.
///
/// # Errors
/// As [`mean_slow_drift`].
pub fn coarse_slow_drift(model: &Model, body: &Body) -> Result<Option<SlowDrift>, ClassError> {
    let Some(attached) = &body.database else { return Ok(None) };
    let Some(mut table) = drift_of(&attached.data).filter(|_| attached.drift != DriftMethod::None) else {
        return Ok(None);
    };
    let count = table.frequencies.len();
    if count < MIN_HALVED {
        return Ok(None);
    }
    let is_kept = |at: &usize| (count - 1 - at).is_multiple_of(2);
    let keep = |list: &[[f64; 6]]| list.iter().enumerate().filter(|(at, _)| is_kept(at)).map(|(_, six)| *six).collect();
    table.values = table.values.iter().map(|row| keep(row)).collect();
    table.frequencies = table.frequencies.iter().enumerate().filter(|(at, _)| is_kept(at)).map(|(_, w)| *w).collect();
    let factor = drift_damping_factor(model, body, attached)?;
    let effect = velocity_effect_of(model, attached, &table, factor)?;
    mean_of_waves(model, &table, attached, &effect)
}

/// The mean drift of a body without the part of its wave drift damping that comes of the change of the drift with the heading, and how far apart the headings
/// of the drift stand around the waves (rad): whether that part is sure. None where no damping acts.
///
/// # Errors
/// As [`mean_slow_drift`].
pub fn slow_drift_without_heading_slopes(model: &Model, body: &Body) -> Result<Option<(SlowDrift, f64)>, ClassError> {
    let Some(attached) = &body.database else { return Ok(None) };
    let (Some(table), VelocityEffect::Acts(made)) = (drift_of(&attached.data), velocity_effect(model, body)?) else {
        return Ok(None);
    };
    let yaw = crate::heading_of(&Pose::from_place(&body.position));
    let mut gap: f64 = 0.0;
    for (toward, _) in Steady::new(model)?.waves {
        gap = gap.max(made.heading_gap(toward.y.atan2(toward.x) - yaw)?);
    }
    let effect = VelocityEffect::Acts(Box::new(made.without_heading_slopes()));
    Ok(mean_of_waves(model, &table, attached, &effect)?.map(|drift| (drift, gap)))
}

/// The mean drift of a table in the waves of the environment; none without waves.
fn mean_of_waves(
    model: &Model,
    table: &DriftTable,
    attached: &AttachedDatabase,
    effect: &VelocityEffect,
) -> Result<Option<SlowDrift>, ClassError> {
    let steady = Steady::new(model)?;
    if steady.waves.is_empty() {
        return Ok(None);
    }
    let seas: Vec<(f64, &[(f64, f64)])> =
        steady.waves.iter().map(|(toward, waves)| (toward.y.atan2(toward.x), waves.energies.as_slice())).collect();
    let coefficients = DriftCoefficients { table, reference: attached.data.reference, by_velocity: effect.acting() };
    SlowDrift::mean_of(coefficients, &seas).map(Some)
}

/// The hydrostatics of the database of a body as a load.
///
/// # Errors
/// A database without them; a body whose buoyancy would count twice.
pub(crate) fn hydrostatics_load(
    model: &Model,
    body: &Body,
    attached: &AttachedDatabase,
) -> Result<Box<dyn BodyLoad>, ClassError> {
    Ok(Box::new(hydrostatics(model, body, attached)?))
}

/// The hydrostatics of the database about the centre of gravity, with a buoyancy that bears the weight.
///
/// The matrix of a source holds the moment of the weight, too; about the centre of gravity that is nothing, so that nothing counts twice.
fn hydrostatics(model: &Model, body: &Body, attached: &AttachedDatabase) -> Result<LinearHydrostatics, ClassError> {
    let data = attached.data.as_ref();
    let refuse = |text: String| ClassError::new(text).with_span(attached.span);
    let Some(stiffness) = data.hydrostatics else {
        return Err(refuse(format!("the database ({}) has no hydrostatics", data.source)));
    };
    if body.linear.is_some() || crate::Hull::new(model, body)?.is_some() {
        let text = format!("{} has a hull or #HYDROSTATIC besides the hydrostatics of its database", body.name);
        return Err(refuse(text).help("leave out -HYDROSTATICS YES, or give the pieces -PERMEABILITY 0"));
    }
    let gravity = model.defaults.gravity;
    let mass = Mass::from_parts(model.parts_of(body), gravity);
    let arm = data.reference - mass.centre;
    Ok(LinearHydrostatics {
        at: mass.centre.into(),
        // the origin of the source stands on the water
        height: mass.centre.z - attached.at[2],
        buoyancy: mass.mass * gravity,
        stiffness: move_stiffness(&stiffness, arm, arm),
        span: attached.span,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn radiation_force_velocity_derivative_matches_finite_difference() {
        let kernel = |time: f64| {
            let pair = |i: usize, j: usize| if i == j { 3.0 } else { 0.2 * (i as f64 - 2.0 * j as f64) };
            Matrix6::from_fn(pair) / (1.0 + 2.0 * time)
        };
        let load = RadiationLoad {
            memory: RetardationMemory::new(&kernel, (0.1, 5.0), 0.1),
            linear: LinearMotion { slow: LowFrequency::new(5.0) },
        };
        let mut state = vec![0.0; load.states()];
        let pose = Pose::default().after_motion(&Six::new(0.0, 0.0, 0.0, 0.4, -0.7, 1.1));
        let velocity = Six::new(1.0, 2.0, -1.0, 0.3, -0.5, 0.2);
        for n in 0..20 {
            let then = velocity * (0.3 * f64::from(n)).cos();
            let at = BodyStep { time: 0.1 * f64::from(n + 1), dt: 0.1, pose: &pose, velocity: &then };
            load.begin(&at, &mut state).unwrap();
            load.commit(&at, &mut state);
        }
        load.begin(&BodyStep { time: 2.1, dt: 0.1, pose: &pose, velocity: &velocity }, &mut state).unwrap();
        let at =
            |pose: &Pose, velocity: &Six| load.dynamic_load(&BodyStep { time: 2.1, dt: 0.1, pose, velocity }, &state);
        let whole = at(&pose, &velocity).unwrap();
        for n in 0..6 {
            let mut by = Six::zeros();
            by[n] = 1e-5;
            let faster = |by: Six| at(&pose, &(velocity + by)).unwrap().load.wrench;
            // forces of 100: rounded 1e-14, over 1e-5; it is linear
            let damping = (faster(-by) - faster(by)) / 2e-5 - whole.damping.column(n);
            assert!(damping.amax() < 1e-7, "{n}: {damping}");
            // a trial elsewhere changes nothing in a step
            assert_eq!(at(&pose.after_motion(&by), &velocity).unwrap(), whole);
        }
        assert!(whole.load.wrench.amax() > 0.1);
    }
}
