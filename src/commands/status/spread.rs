//! `&STATUS SPREAD` and `&STATUS DG_CONNECTOR`: the mooring lines as a spread, and the shape of each.

use crate::commands::status::forces::{ConnectorForces, find_forces};
use crate::commands::status::kind::{Query, StatusKind};
use std::f64::consts::TAU;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_model::{Condition, Connector, EntityKind, LineSampling, Model, add_model_column};

/// `&STATUS SPREAD`.
pub static SPREAD: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new(
        "SPREAD",
        "the mooring lines as they lie: direction and distance of their anchors, and their tensions (our reading)",
        |query, _| Ok(vec![spread(query)]),
    )
    .with_names(&[EntityKind::Connector])
    .of_moses()
};

/// `&STATUS DG_CONNECTOR`.
pub static DG_CONNECTOR: StatusKind = StatusKind::new(
    "DG_CONNECTOR",
    "the shape of mooring lines between their ends as they are, as GEOMETRY of CONN_DESIGN has it (our reading)",
    |query, _| shapes(query),
)
.with_names(&[EntityKind::Connector])
.plotted(|_, tables| Ok(tables.iter().map(side_view).collect()))
.of_moses();

/// A line between its fairlead and its anchor.
struct SpreadLine<'m> {
    connector: &'m Connector,
    /// Direction of the anchor from the fairlead (rad), and its horizontal distance (m); none where it hangs straight down.
    anchor: (Option<f64>, f64),
    found: Option<ConnectorForces>,
}

/// The lines that fit: those of line classes, and dynamic lines.
fn lines<'a>(query: &Query<'a>) -> impl Iterator<Item = &'a Connector> {
    let (model, fits) = (query.model(), query.fits());
    let has_line_class =
        move |class: &str| model.classes.get(&Model::key(class)).is_some_and(|class| class.object.is_line());
    let is_line = move |c: &&Connector| has_line_class(&c.class) || model.is_dynamic_line(c);
    model.connectors.values().filter(move |c| c.active && fits(&c.name) && !model.holds_pipe(&c.name)).filter(is_line)
}

fn spread(query: &Query) -> Table {
    let (model, units) = (query.model(), query.job.units);
    let mut table = Table::new("Mooring Spread");
    let mut rows = Vec::new();
    for connector in lines(query) {
        let [fairlead, anchor] = model.end_poses(connector).map(|pose| pose.origin);
        let level = (anchor - fairlead).xy();
        let azimuth = (level.norm() > 0.0).then(|| level.y.atan2(level.x).rem_euclid(TAU));
        let found = find_forces(model, connector)
            .map_err(|error| table.note_absent(format!("{}: {}", connector.name, error.text(units))))
            .ok();
        rows.push(SpreadLine { connector, anchor: (azimuth, level.norm()), found });
    }
    let force = |line: &SpreadLine| {
        let found = line.found.as_ref();
        found.map_or([None; 2], |found| {
            let [fx, fy, _] = found.on_body();
            [found.summary.tension, Some(fx.hypot(fy))]
        })
    };
    let mut table = table
        .with_rows(&rows)
        .text("Name", |line| &line.connector.name)
        .text("Class", |line| &line.connector.class)
        .column("Anchor", "Direction", Dim::Angle, Digits::Usual, |line| line.anchor.0)
        .column("Anchor", "Distance", Dim::Length, Digits::Usual, |line| line.anchor.1)
        .column("", "First Seg.", Dim::Length, Digits::Usual, |line| model.first_length(line.connector))
        .columns("Tension", ["Ten Top", "Horizontal"], Dim::Force, Digits::Usual, force)
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3), |line| {
            line.found.as_ref().and_then(|found| found.summary.ratio)
        })
        .column("On Bottom", "Unstretched", Dim::Length, Digits::Usual, |line| {
            line.found.as_ref().and_then(|found| found.summary.grounded)
        })
        .build();
    add_model_column(&mut table, |name| model.idealisation(name));
    table.note("directions and distances from the first end to the second, from +X toward +Y");
    table
}

fn shapes(query: &Query) -> Outcome<Vec<Table>> {
    let (job, model) = (query.job, query.model());
    let mut tables = Vec::new();
    for connector in lines(query).filter(|c| model.reeving(&c.name).is_none()) {
        let Some(class) = model.classes.get(&Model::key(&connector.class)) else { continue };
        let line = class.line(&model.placement(connector), &model.surroundings());
        let made = line.and_then(|l| l.geometry(&connector.name, Condition::Placed, LineSampling::Adaptive));
        tables.push(made.map_err(|e| {
            e.diagnostic(query.position(), job.units).help(format!("while shaping connector {}", connector.name))
        })?);
    }
    if tables.is_empty() {
        return Err(Diagnostic::error("the model has no such active mooring line", query.position()));
    }
    Ok(tables)
}

/// Elevation over horizontal distance alone.
fn side_view(shape: &Table) -> Table {
    let columns = ["X", "Z", "Bottom", "Surface"].into_iter().filter_map(|name| shape.get(name).cloned());
    Table::from_columns(shape.title.clone(), columns.collect())
}
