//! `&STATUS FORCE`, `STIFFNESS` and `MODES`: what acts on the bodies where they stand, how it changes, how they swing.

use crate::commands::name_filter::NameFilter;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::status::ForceName;
use crate::commands::status::kind::StatusKind;
use crate::commands::{Call, Job};
use windlass_base::choice::Choice;
use windlass_base::diagnostic::Outcome;
use windlass_base::geometry::Position;
use windlass_base::table::{Cell, Table};
use windlass_base::units::Dim;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::EntityKind;
use windlass_model::Model;
use windlass_solve::frequency::{self, LinearSystem};
use windlass_solve::{System, tables};

/// `&STATUS FORCE`.
pub static FORCE: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new("FORCE", "what acts on the bodies where they stand, by category", |query, _| {
        forces(query.job, query.call, &query.fits())
    })
    .with_names(&[EntityKind::Body])
    .of_moses()
    .also(&["G_FORCE"])
};

/// `&STATUS STIFFNESS`.
pub static STIFFNESS: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new("STIFFNESS", "stiffness of bodies and connectors about a point", |query, _| {
        stiffness(query.job, query.call, query.names)
    })
    .with_names(&[EntityKind::Body, EntityKind::Connector])
};

/// `&STATUS MODES`.
pub static MODES: StatusKind = StatusKind::new(
    "MODES",
    "natural periods, damping and shapes of small motions about where the bodies stand",
    |query, _| modes(query.job, query.call),
);

const fn number(name: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Length), "global coordinate")
}

/// `-ABOUT X Y Z` of `&STATUS STIFFNESS`.
pub const ABOUT: OptionSpec =
    OptionSpec::new("-ABOUT", &[number("X"), number("Y"), number("Z")], "point of STIFFNESS and its moments")
        .default("the body's origin");

/// The forces on the bodies by category.
///
/// # Errors
/// A connector or body that cannot be evaluated.
pub fn forces(job: &Job, call: &Call, fits: &dyn Fn(&str) -> bool) -> Outcome<Vec<Table>> {
    let wrong = |e| to_diagnostic(e, &job.model, call.args.position(super::WHAT), job.units);
    let system = System::new(&job.model, &[]).map_err(wrong)?;
    let state = system.state(&job.model);
    let mut table = tables::by_category(&system, &state, fits).map_err(wrong)?;
    if let Some(given) = call.args.option(&super::FORCE) {
        let chosen: Vec<&str> = given.choices(const { super::FORCE.choice("NAME") }).map(ForceName::word).collect();
        let of_row: Vec<bool> = table.get("Category").map_or(Vec::new(), |column| {
            column.cells.iter().map(|cell| chosen.iter().any(|word| *cell == Cell::from(*word))).collect()
        });
        table.keep_rows(|row| of_row.get(row).copied().unwrap_or(false));
    }
    Ok(vec![table])
}

/// Natural periods, damping and shapes of the modes of small motions.
///
/// # Errors
/// A connector or body that cannot be evaluated.
pub fn modes(job: &Job, call: &Call) -> Outcome<Vec<Table>> {
    let wrong = |e| to_diagnostic(e, &job.model, call.args.position(super::WHAT), job.units);
    let linear = LinearSystem::new(&job.model).map_err(wrong)?;
    Ok(frequency::tables::modes(&linear).map_err(wrong)?.into())
}

/// The stiffness of the bodies that are named, of all where no connector is named either, and that of each connector named.
///
/// # Errors
/// A connector or body that cannot be evaluated.
pub fn stiffness(job: &Job, call: &Call, chosen: &NameFilter) -> Outcome<Vec<Table>> {
    let wrong = |e| to_diagnostic(e, &job.model, call.args.position(super::WHAT), job.units);
    let about: Option<Position> =
        call.args.option(&ABOUT).map(|given| given.numbers_or_zero(const { ABOUT.numbers(["X", "Y", "Z"]) }));
    let system = System::new(&job.model, &[]).map_err(wrong)?;
    let mut state = system.state(&job.model);
    system.evaluate(&mut state).map_err(wrong)?;
    let named = |name: &str| !chosen.chooses_all() && chosen.matches(name);
    let connectors: Vec<&str> =
        job.model.connectors.values().map(|c| c.name.as_str()).filter(|name| named(name)).collect();
    let bodies = |name: &str| chosen.matches(name);
    let model = &job.model;
    // between two bodies; one to ground or to a junction counts
    let left_out = |name: &str| {
        let Some(connector) = model.connectors.get(&Model::key(name)) else { return false };
        let points = connector.points.iter().filter_map(|p| model.points.get(&Model::key(p)));
        let bodies = points.filter_map(|p| model.body_of(p)).filter(|b| b.junction.is_none()).count();
        bodies > 1 && model.classes.get(&Model::key(&connector.class)).is_some_and(|c| c.ignored_stiffness)
    };
    let connectors = tables::ReportedConnectors { reported: &connectors, left_out: &left_out };
    tables::stiffnesses(&system, &state, about, &bodies, &connectors).map_err(wrong)
}
