//! What load groups exert over a run.
//!
//! A run stores the sum over each body alone. What a load group exerts at a stored instant follows from place, velocity and acceleration of the
//! body and the time, but for loads that remember: waves on members and hulls, slow drift, memory of radiation.

use super::super::system::SolveError;
use super::super::time::{ActionKind, Run};
use super::connectors::poses;
use super::forces::{no_wrench, wrench_columns};
use super::{EventTable, Magnitude, RunEvent, group_head};
use nalgebra::Vector3;
use windlass_base::pose::Six;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_hydro::{BodyStep, Category, Floating};
use windlass_model::{Body, ClassError, Model};

/// A load group of a model.
#[derive(Clone, Debug, PartialEq)]
pub struct GroupName {
    /// Its name.
    pub name: String,
    /// Its part.
    pub part: String,
    /// Whether it is what of the part belongs to no group of another name.
    pub of_part: bool,
}

/// The load groups of a model: those that are described, and one a part of a body.
pub fn load_groups(model: &Model) -> Vec<GroupName> {
    let described = model.load_groups.values().map(|group| GroupName {
        name: group.name.clone(),
        part: group.part.clone(),
        of_part: false,
    });
    let on_bodies = model.parts.values().filter(|part| model.bodies.contains_key(&Model::key(&part.body)));
    let of_parts = on_bodies.map(|part| GroupName { name: part.name.clone(), part: part.name.clone(), of_part: true });
    described.chain(of_parts).collect()
}

/// A model with the loads of one group alone; bodies stay.
fn group_alone(model: &Model, group: &GroupName) -> Model {
    let mut made = model.clone();
    let (part_key, name) = (Model::key(&group.part), Model::key(&group.name));
    let belongs = |part: &str, own: Option<&String>| {
        let named = own.is_some_and(|own| Model::key(own) == name);
        Model::key(part) == part_key && if group.of_part { own.is_none() } else { named }
    };
    made.loads.retain(|load| belongs(&load.part, load.group.as_ref()));
    for part in made.parts.values_mut() {
        let own = part.name.clone();
        part.weights.retain(|weight| belongs(&own, weight.group.as_ref()));
        let keeps = group.of_part && Model::key(&own) == part_key;
        part.pieces.retain(|piece| keeps && piece.compartment.is_none());
    }
    made.compartments.clear();
    for body in made.bodies.values_mut() {
        body.database = None;
        body.junction = None;
        if !(group.of_part && Model::key(&body.name) == part_key) {
            body.linear = None;
        }
    }
    made
}

/// A group that a table reports.
struct Reported {
    name: String,
    body: usize,
    floating: Floating,
}

/// The forces of load groups of a run by category and their sum, about the origins of their bodies, global axes.
///
/// # Errors
/// Another environment that came during the run; loads that make no sense.
pub fn group_forces(
    run: &Run,
    groups: &[GroupName],
    magnitude: Magnitude,
    events: &[RunEvent],
) -> Result<Table, SolveError> {
    let layout = &run.history.layout;
    let changed = run
        .actions
        .iter()
        .zip(&run.fired)
        .any(|(action, fired)| fired.is_some() && matches!(action.what, ActionKind::Environment(_)));
    if changed {
        let text = "the environment changed during the run: the loads of groups are not stored, and are those of one environment";
        return Err(SolveError::new(ClassError::new(text).help("BODY_FORCE reports what is stored")));
    }
    let (mut reported, mut remembering) = (Vec::new(), Vec::new());
    for group in groups {
        let alone = group_alone(&run.model, group);
        let body: Option<&Body> =
            alone.parts.get(&Model::key(&group.part)).and_then(|part| alone.bodies.get(&Model::key(&part.body)));
        let index = body.and_then(|body| layout.bodies.iter().position(|(_, key)| *key == Model::key(&body.name)));
        let (Some(body), Some(index)) = (body, index) else { continue };
        let made = Floating::under_way(&alone, body, run.sea.as_ref());
        let mut floating = made.map_err(SolveError::error_about(&group.name))?;
        let before = floating.loads.len();
        floating.loads.retain(|load| load.as_stateful().is_none());
        if floating.loads.len() < before {
            remembering.push(group.name.as_str());
        }
        reported.push(Reported { name: group.name.clone(), body: index, floating });
    }
    let own = |category: Category| {
        reported.iter().any(|group| {
            let f = &group.floating;
            f.loads.iter().any(|load| load.category() == category)
                || (category == Category::RadiationDrag && f.damping.amax() > 0.0)
                || (category == Category::AddedInertia && f.added_mass.amax() > 0.0)
        })
    };
    let categories: Vec<Category> = Category::ALL.into_iter().filter(|category| own(*category)).collect();
    let mut positions = Vec::new();
    let mut table = EventTable::new("Forces of Load Groups", (&run.history, events), |row| {
        poses(layout, row, &mut positions);
        let time = row.first().copied().unwrap_or(0.0);
        let mut list = Vec::new();
        for group in &reported {
            let from = layout.body(group.body);
            let six = |at: usize| Six::from_iterator(row.iter().skip(at).copied().chain([0.0; 6]).take(6));
            let (velocity, acceleration) = (six(from + 6), six(from + 12));
            let pose = positions.get(group.body).copied().unwrap_or_default();
            let at = BodyStep { time, dt: 0.0, pose: &pose, velocity: &velocity };
            let mut sums = vec![Six::zeros(); categories.len() + 1];
            let mut add = |category: Category, wrench: Six| {
                if let Some(index) = categories.iter().position(|c| *c == category) {
                    sums[index] += wrench;
                    sums[categories.len()] += wrench;
                }
            };
            for load in &group.floating.loads {
                let made = load.dynamic_load(&at, &[]).map_err(SolveError::error_about(&group.name))?;
                add(load.category(), made.load.wrench);
            }
            add(Category::RadiationDrag, -(group.floating.linear_damping(&pose) * velocity));
            add(Category::AddedInertia, -(group.floating.added_mass(&pose) * acceleration));
            list.push(sums.into_iter().map(halves).collect::<Vec<_>>());
        }
        Ok(list)
    })?
    .fact("Moments About", "the origins of the bodies", Dim::None);
    let several = reported.len() > 1;
    for (index, group) in reported.iter().enumerate() {
        if !several {
            table = table.fact("Load Group", group.name.as_str(), Dim::None);
        }
        for (which, title) in categories.iter().map(|c| c.name()).chain(["TOTAL"]).enumerate() {
            let own =
                |all: &Vec<Vec<_>>| all.get(index).and_then(|list| list.get(which)).copied().unwrap_or_else(no_wrench);
            table = wrench_columns(table, &group_head(several, &group.name, title), magnitude, own);
        }
    }
    let mut table = table.build();
    if !remembering.is_empty() {
        table.warn(format!(
            "{}: waves on members and hulls, slow drift and other loads that remember are left out: the run stores their sum over the body alone",
            remembering.join(", ")
        ));
    }
    table.note("contents of compartments, hydrodynamic databases and the inertia of weights belong to no group");
    Ok(table)
}

/// A force and a moment.
fn halves(six: Six) -> [Vector3<f64>; 2] {
    [six.fixed_rows::<3>(0).into_owned(), six.fixed_rows::<3>(3).into_owned()]
}
