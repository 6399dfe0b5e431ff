//! `&STATUS F_CONNECTOR`: the forces of the connectors between their ends as they are.

use crate::commands::name_filter::merge_remarks;
use crate::commands::status::kind::StatusKind;
use crate::commands::verdict::{Verdict, check_over_break};
use windlass_base::pose::Six;
use windlass_base::table::{Digits, Table, TableNote};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::ambient;
use windlass_model::{
    ClassError, ClassRole, Connector, ConnectorResponse, ConnectorSummary, End, Model, Situation, SpringState,
    add_model_column,
};
use windlass_model::{EntityKind, SolverCache};
use windlass_solve::results::fender_table;

/// `&STATUS F_CONNECTOR`.
pub static F_CONNECTOR: StatusKind = StatusKind {
    caveats: true,
    ..StatusKind::new("F_CONNECTOR", "forces of the connectors between their ends as they are", |query, verdict| {
        Ok(forces(query.model(), &query.fits(), query.job.units, verdict))
    })
    .with_names(&[EntityKind::Connector])
    .of_moses()
};

/// `&STATUS FOUNDATION`.
pub static FOUNDATION: StatusKind =
    StatusKind::new("FOUNDATION", "the FOUNDATION check: forces of foundations over their allowables", |query, _| {
        Ok(vec![foundations(query.model(), &query.fits(), query.job.units)])
    })
    .with_names(&[EntityKind::Connector]);

/// What one connector does between its ends.
pub(crate) struct ConnectorForces {
    /// Force on the first end, and on the other (N, global).
    forces: [[f64; 3]; 2],
    /// The first of its ends that is on a body; the first where none is.
    on_body: usize,
    /// Horizontal distance between the ends (m).
    distance: f64,
    /// The rest of what it reports of itself.
    pub(crate) summary: ConnectorSummary,
}

/// One row a connector, and a second table with the springs of those that have some. Those that are inactive or without a
/// solution have no forces. Tensions beyond a break go to `verdict`.
pub fn forces(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem, verdict: &mut Verdict) -> Vec<Table> {
    let mut table = Table::new("Connector Forces");
    let mut notes: Vec<(String, Vec<TableNote>)> = Vec::new();
    let (mut rows, mut springs, mut fenders) = (Vec::new(), Vec::new(), Vec::new());
    for connector in model.connectors.values().filter(|c| fits(&c.name)) {
        let (solution, found) = match connector.active {
            false => ("inactive", None),
            true if model.holds_pipe(&connector.name) => ("in pipe", None),
            true if model.is_unreeved(&connector.name) => ("inactive", None),
            true => match find_forces(model, connector) {
                Ok(mut found) => {
                    notes.push((connector.name.clone(), take_remarks(&mut found.summary, units)));
                    (found.summary.solution, Some(found))
                }
                Err(error) => {
                    table.absent += 1;
                    notes.push((connector.name.clone(), vec![TableNote::warning(error.text(units))]));
                    ("none", None)
                }
            },
        };
        if let Some(found) = &found {
            verdict.over_break.extend(check_over_break(&connector.name, &found.summary, "&STATUS F_CONNECTOR"));
            springs.extend(spring_rows(connector, &found.summary));
            fenders.extend(found.summary.fender.map(|state| (connector.name.as_str(), state)));
        }
        rows.push((connector, solution, found));
    }
    table.notes = merge_remarks(&notes);
    let mut table = force_columns(table, &rows);
    add_model_column(&mut table, |name| model.idealisation(name));
    let springs = Some(spring_table("Springs of Connectors", &springs)).filter(|s| s.rows() > 0);
    let fenders = fender_table("Fenders", fenders.iter().map(|(name, state)| (*name, state, None)));
    std::iter::once(table).chain(springs).chain(Some(fenders).filter(|f| f.rows() > 0)).collect()
}

/// The columns of the forces: a connector, the word of its solution, what it does if it has one.
fn force_columns(table: Table, rows: &[(&Connector, &str, Option<ConnectorForces>)]) -> Table {
    table
        .with_rows(rows)
        .text("Name", |(connector, ..)| &connector.name)
        .text("Class", |(connector, ..)| &connector.class)
        .text("Solution", |(_, solution, _)| *solution)
        .column("Horizontal", "Distance", Dim::Length, Digits::Usual, |(.., f)| f.as_ref().map(|f| f.distance))
        .columns("Force on Body", ["FX", "FY", "FZ"], Dim::Force, Digits::Usual, |(.., f)| {
            f.as_ref().map_or([None; 3], |f| f.on_body().map(Some))
        })
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual, |(.., f)| f.as_ref().and_then(|f| f.summary.tension))
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3), |(.., f)| {
            f.as_ref().and_then(|f| f.summary.ratio)
        })
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual, |(.., f)| f.as_ref().and_then(|f| f.summary.critical))
        .columns("Anchor", ["V. Pull", "H. Pull"], Dim::Force, Digits::Usual, |(.., f)| {
            f.as_ref().and_then(ConnectorForces::anchor_pull).map_or([None; 2], |pull| pull.map(Some))
        })
        .column("On Bottom", "Unstretched", Dim::Length, Digits::Usual, |(.., f)| {
            f.as_ref().and_then(|f| f.summary.grounded)
        })
        .build()
}

/// The FOUNDATION check [MOSES-FLEX FOUNDATION]: every spring of every foundation against its allowable, and the largest of each.
pub fn foundations(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Table {
    let (mut springs, mut absent) = (Vec::new(), 0);
    let mut notes: Vec<(String, Vec<TableNote>)> = Vec::new();
    let mut largest: Option<(f64, &str)> = None;
    let foundation = |c: &&Connector| {
        model.classes.get(&Model::key(&c.class)).is_some_and(|class| class.object.role() == ClassRole::Foundation)
            && fits(&c.name)
    };
    for connector in model.connectors.values().filter(foundation).filter(|c| c.active) {
        match find_forces(model, connector) {
            Ok(mut found) => {
                springs.extend(spring_rows(connector, &found.summary));
                let ratio = found.summary.ratio.unwrap_or(0.0);
                if largest.is_none_or(|(most, _)| ratio > most) {
                    largest = Some((ratio, &connector.name));
                }
                notes.push((connector.name.clone(), take_remarks(&mut found.summary, units)));
            }
            Err(error) => {
                absent += 1;
                notes.push((connector.name.clone(), vec![TableNote::warning(error.text(units))]));
            }
        }
    }
    let mut table = spring_table("Foundation Check", &springs);
    table.absent = absent;
    table.add_notes(merge_remarks(&notes));
    if let Some((ratio, name)) = largest {
        table = table.fact("Largest Unity", ratio, Dim::None).fact("Of", name, Dim::None);
    }
    table
}

/// Takes what a user should know out of a summary, in these units.
fn take_remarks(summary: &mut ConnectorSummary, units: UnitSystem) -> Vec<TableNote> {
    std::mem::take(&mut summary.notes).iter().map(|note| note.for_table(units)).collect()
}

/// What a connector does between its ends as they are.
///
/// # Errors
/// It has no solution.
pub(crate) fn find_forces(model: &Model, connector: &Connector) -> Result<ConnectorForces, ClassError> {
    let mut element = model.element(connector)?;
    if element.as_dynamic().is_some() {
        // it feels current, bottom and contents all along itself
        element = model.element_in(connector, Some(&ambient(model, None)?))?;
    }
    let ends: Vec<End> = model.element_ends(connector).into_iter().map(End::at_rest).collect();
    let mut committed = vec![0.0; element.states()];
    element.start(&mut committed);
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    let (mut out, mut trial) = (ConnectorResponse::default(), committed.clone());
    element.evaluate(&at, &committed, &mut trial, &mut SolverCache::new(), &mut out)?;
    // less than what a solution is exact to is no force
    let shown = |w: &Six| {
        let size = 1e-12 * w.fixed_rows::<3>(0).norm();
        [w[0], w[1], w[2]].map(|v| if v.abs() < size { 0.0 } else { v })
    };
    let force = |i: usize| out.wrench.get(i).map_or([0.0; 3], shown);
    let [first, second] = model.end_poses(connector).map(|pose| pose.origin);
    let distance = (second - first).xy().norm();
    let is_on_body = |name: &String| model.points.get(&Model::key(name)).is_some_and(|p| model.body_of(p).is_some());
    let on_body = connector.points.iter().take(2).position(is_on_body).unwrap_or(0);
    let mut summary = element.summary(&at, &committed)?;
    let is_line =
        model.classes.get(&Model::key(&connector.class)).is_some_and(|class| class.object.as_line().is_some());
    if let (1, true, Some(tension)) = (on_body, is_line, &mut summary.tension) {
        // that at the end on the body, as the force; a push is negative
        *tension = force(1).iter().fold(0.0, |size: f64, f| size.hypot(*f)).copysign(*tension);
    }
    Ok(ConnectorForces { forces: [force(0), force(1)], on_body, distance, summary })
}

impl ConnectorForces {
    /// The force on the end that is on a body (N).
    pub(crate) fn on_body(&self) -> [f64; 3] {
        self.forces[self.on_body]
    }

    /// The force on its far end: the anchor of a line (N).
    pub(crate) fn on_far_end(&self) -> [f64; 3] {
        self.forces[1 - self.on_body]
    }

    /// Vertical and horizontal pull of a line at its far end (N).
    fn anchor_pull(&self) -> Option<[f64; 2]> {
        self.summary.tension?;
        let [x, y, z] = self.on_far_end();
        // no pull is zero without a sign
        Some([z + 0.0, x.hypot(y)])
    }
}

/// A spring of a connector, along an axis or about it.
struct SpringRow<'m> {
    connector: &'m str,
    spring: SpringState,
}

impl SpringRow<'_> {
    /// Deflection, force and allowable, for a spring that turns or for one that does not.
    fn values(&self, turns: bool) -> [Option<f64>; 3] {
        let spring = &self.spring;
        if spring.dof.starts_with('R') == turns {
            [Some(spring.deflection), Some(spring.force), spring.allowable]
        } else {
            [None; 3]
        }
    }
}

fn spring_rows<'m>(connector: &'m Connector, summary: &ConnectorSummary) -> impl Iterator<Item = SpringRow<'m>> {
    summary.springs.iter().map(|spring| SpringRow { connector: &connector.name, spring: spring.clone() })
}

fn spring_table(title: &str, rows: &[SpringRow]) -> Table {
    Table::new(title)
        .with_rows(rows)
        .text("Name", |row| row.connector)
        .text("DF", |row| &row.spring.dof)
        .column("Translation", "Deflection", Dim::Length, Digits::Decimals(4), |row| row.values(false)[0])
        .column("Translation", "Force", Dim::Force, Digits::Usual, |row| row.values(false)[1])
        .column("Translation", "Allowable", Dim::Force, Digits::Usual, |row| row.values(false)[2])
        .column("Rotation", "Angle", Dim::Angle, Digits::Decimals(4), |row| row.values(true)[0])
        .column("Rotation", "Moment", Dim::Moment, Digits::Usual, |row| row.values(true)[1])
        .column("Rotation", "Allow. Moment", Dim::Moment, Digits::Usual, |row| row.values(true)[2])
        .column("", "Unity", Dim::None, Digits::Decimals(3), |row| {
            row.spring.allowable.map(|a| row.spring.force.abs() / a)
        })
        .build()
}
