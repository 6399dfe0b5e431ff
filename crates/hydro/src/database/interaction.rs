//! Radiated waves of a body as they act on another body of the same source: `F(t) = -A(inf) a(t) - int_0^T K(s) v(t - s) ds` with the
//! motions of the other body, about the origins of both.

use super::attached::LinearMotion;
use super::memory::RetardationMemory;
use super::radiation::Radiation;
use crate::body_load::{BodyStep, DynamicLoad};
use crate::low_frequency::{LowFrequency, dividing_period};
use crate::sea::Sea;
use crate::{Category, move_stiffness};
use nalgebra::Matrix6;
use windlass_base::pose::Six;
use windlass_model::{Body, ClassError, Database, InteractingBodies, Model};

/// The interaction as the radiation of one body: about the origins of both, in the axes of each.
pub fn interaction_about_origins(pair: &InteractingBodies) -> Option<Database> {
    let own = pair.on.1.database.as_ref()?;
    let other = pair.by.1.database.as_ref()?;
    let moved = |block: &Matrix6<f64>| move_stiffness(block, own.data.reference, other.data.reference);
    Some(Database {
        source: own.data.source.clone(),
        frequencies: own.data.frequencies.clone(),
        added_mass: pair.interaction.added_mass.iter().map(moved).collect(),
        damping: pair.interaction.damping.iter().map(moved).collect(),
        infinite: pair.interaction.infinite.as_ref().map(moved),
        ..Database::default()
    })
}

/// The radiation of bodies that were solved together, which stand in the model with the databases of one source.
struct BodyGroup<'m> {
    /// Keys of the bodies.
    keys: Vec<&'m str>,
    /// Of each pair, row by row.
    pairs: Vec<Option<Radiation>>,
}

impl<'m> BodyGroup<'m> {
    /// The group of a source.
    fn new(model: &'m Model, source: &str) -> Self {
        let members: Vec<(&str, &Database)> = model
            .bodies
            .iter()
            .filter_map(|(key, body)| Some((key.as_str(), body.database.as_ref()?.data.as_ref())))
            .filter(|(_, data)| data.source == source)
            .collect();
        let interactions = model.interactions();
        let database = |row: usize, column: usize| {
            let (on, own) = members.get(row)?;
            if row == column {
                return Some(Database {
                    source: own.source.clone(),
                    reference: own.reference,
                    frequencies: own.frequencies.clone(),
                    added_mass: own.added_mass.clone(),
                    damping: own.damping.clone(),
                    infinite: own.infinite,
                    ..Database::default()
                });
            }
            let (by, _) = members.get(column)?;
            let pair = interactions.iter().find(|pair| pair.on.0 == *on && pair.by.0 == *by)?;
            interaction_about_origins(pair)
        };
        let pairs = Radiation::of_bodies(members.len(), database);
        BodyGroup { keys: members.iter().map(|(key, _)| *key).collect(), pairs }
    }

    /// The force on a body by motions of another, or by its own.
    fn pair(&self, on: &str, by: &str) -> Option<&Radiation> {
        let number = |key: &str| self.keys.iter().position(|own| *own == key);
        self.pairs.get(number(on)? * self.keys.len() + number(by)?)?.as_ref()
    }
}

/// The radiation of a body by its own motions; none where it has no database with radiation.
pub fn own_radiation(model: &Model, body: &Body) -> Option<Radiation> {
    let data = body.database.as_ref()?.data.as_ref();
    if data.interactions.is_empty() {
        return Radiation::new(data);
    }
    let key = Model::key(&body.name);
    BodyGroup::new(model, &data.source).pair(&key, &key).cloned()
}

/// The waves that a body radiates on another, as the radiation of one body.
pub struct InteractionRadiation<'m> {
    /// Both bodies.
    pub pair: InteractingBodies<'m>,
    /// Added mass and damping about the origins of both, in the axes of each.
    pub data: Database,
    /// Its kernel.
    pub radiation: Radiation,
    /// The radiation of the body that they act on, by its own motions.
    pub own: Option<Radiation>,
}

/// All interactions of a model.
pub fn interaction_radiations(model: &Model) -> Vec<InteractionRadiation<'_>> {
    let mut groups: Vec<(String, BodyGroup)> = Vec::new();
    let mut list = Vec::new();
    for pair in model.interactions() {
        let Some(data) = interaction_about_origins(&pair) else { continue };
        if !groups.iter().any(|(source, _)| *source == data.source) {
            groups.push((data.source.clone(), BodyGroup::new(model, &data.source)));
        }
        let Some((_, group)) = groups.iter().find(|(source, _)| *source == data.source) else { continue };
        if let Some(radiation) = group.pair(pair.on.0, pair.by.0).cloned() {
            let own = group.pair(pair.on.0, pair.on.0).cloned();
            list.push(InteractionRadiation { pair, data, radiation, own });
        }
    }
    list
}

/// Forces of the waves that a body radiates on another, in time.
#[derive(Clone, Debug)]
pub struct InteractionLoad {
    memory: RetardationMemory,
    /// About the origins of both bodies, in axes of their low-frequency headings (kg, kg m, kg m2).
    infinite: Matrix6<f64>,
    linear: LinearMotion,
}

/// A force on a body by motions of another, and how it changes with them; global axes.
#[derive(Clone, Copy, Debug)]
pub struct InteractionForce {
    /// Force and moment about the origin of the body that it is on, without that of accelerations.
    pub wrench: Six,
    /// -d(wrench)/d(velocity of the other body).
    pub damping: Matrix6<f64>,
    /// -d(wrench)/d(acceleration of the other body).
    pub inertia: Matrix6<f64>,
}

/// The two bodies of an interaction at the end of a step.
#[derive(Clone, Copy, Debug)]
pub struct InteractionStep<'a> {
    /// The body that the force is on.
    pub on: BodyStep<'a>,
    /// The body whose motions make it.
    pub by: BodyStep<'a>,
}

impl InteractionLoad {
    /// Number of values of its state.
    pub fn states(&self) -> usize {
        2 * LinearMotion::STATES + self.memory.states()
    }

    /// Prepares a step.
    pub fn begin(&self, ahead: &InteractionStep, state: &mut [f64]) {
        let (on, rest) = state.split_at_mut(LinearMotion::STATES);
        let (by, memory) = rest.split_at_mut(LinearMotion::STATES);
        self.linear.begin(&ahead.on, on);
        self.linear.begin(&ahead.by, by);
        self.memory.begin(ahead.by.time, ahead.by.dt, memory);
    }

    /// The step is accepted.
    pub fn commit(&self, at: &InteractionStep, state: &mut [f64]) {
        let (on, rest) = state.split_at_mut(LinearMotion::STATES);
        let (by, memory) = rest.split_at_mut(LinearMotion::STATES);
        self.memory.commit(at.by.time, at.by.dt, &LinearMotion::velocity(&at.by, by), memory);
        self.linear.commit(&at.on, on);
        self.linear.commit(&at.by, by);
    }

    /// The force at a trial of the end of a step of the other body.
    pub fn force(&self, by: &BodyStep, state: &[f64]) -> InteractionForce {
        let (on_state, rest) = state.split_at(LinearMotion::STATES);
        let (by_state, memory) = rest.split_at(LinearMotion::STATES);
        let (force, damping) = self.memory.force(&LinearMotion::velocity(by, by_state), memory);
        let DynamicLoad { load, damping } = LinearMotion::load_between(&force, &damping, on_state, by_state);
        let (axes, others) = (LinearMotion::axes(on_state), LinearMotion::axes(by_state));
        let mut inertia = Matrix6::zeros();
        for (row, column) in [(0, 0), (0, 3), (3, 0), (3, 3)] {
            let block = axes * self.infinite.fixed_view::<3, 3>(row, column) * others.transpose();
            inertia.fixed_view_mut::<3, 3>(row, column).copy_from(&block);
        }
        InteractionForce { wrench: load.wrench, damping, inertia }
    }
}

/// An interaction ready for a run or for a place at rest.
#[derive(Clone, Debug)]
pub struct GatheredInteraction {
    /// Key of the body that the force is on, and of that whose motions make it.
    pub bodies: [String; 2],
    /// Added mass at infinite frequency about the origins, in the axes of each body (kg, kg m, kg m2).
    pub infinite: Matrix6<f64>,
    /// The load in time; none at rest.
    pub load: Option<InteractionLoad>,
}

/// All interactions of a model; `under_way` with the sea there is.
///
/// # Errors
/// A run in time with databases of one frequency; a memory of more steps than are kept.
pub fn gather_interactions(
    model: &Model,
    under_way: Option<Option<&Sea>>,
) -> Result<Vec<GatheredInteraction>, ClassError> {
    let mut list = Vec::new();
    for InteractionRadiation { pair, data: _, radiation, own } in interaction_radiations(model) {
        let load = match under_way {
            None => None,
            Some(sea) => {
                let attached = pair.on.1.database.as_ref();
                let usual = own.as_ref().map_or_else(|| radiation.memory(), Radiation::memory);
                let length = attached.and_then(|attached| attached.memory).unwrap_or(usual);
                let step = super::attached::memory_step(model);
                radiation.check_memory()?;
                super::attached::check_lags(length, step)?;
                let factor = model.multipliers.factor(Category::RadiationDrag.name(), &pair.on.1.name);
                let kernel = |time: f64| radiation.tapered_retardation(time, length) * factor;
                Some(InteractionLoad {
                    memory: RetardationMemory::between_bodies(&kernel, (radiation.finest(), length), step),
                    infinite: radiation.infinite,
                    linear: LinearMotion { slow: LowFrequency::new(dividing_period(model, sea)) },
                })
            }
        };
        let bodies = [pair.on.0.to_owned(), pair.by.0.to_owned()];
        list.push(GatheredInteraction { bodies, infinite: radiation.infinite, load });
    }
    Ok(list)
}
