//! `&STATUS F_CONNECTOR`: the forces of the connectors between their ends as they are.

use super::chosen::{WARNING, gathered};
use super::status::push;
use super::verdict::{Verdict, judged};
use windlass_base::pose::Six;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_hydro::ambient;
use windlass_model::{ClassError, Connector, End, Model, Response, Situation, Summary, add_model_column};
use windlass_solve::results::fender_table;

/// What one connector does between its ends.
struct Found {
    /// Force on the first end, and on the other (N, global).
    forces: [[f64; 3]; 2],
    /// The first of its ends that is on a body; the first where none is.
    on_body: usize,
    /// Horizontal distance between the ends (m).
    distance: f64,
    summary: Summary,
}

/// One row a connector, and a second table with the springs of those that have some. Those that are inactive or without a
/// solution have no forces. Tensions beyond a break go to `verdict`.
pub fn forces(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem, verdict: &mut Verdict) -> Vec<Table> {
    let mut table = Table::new("Connector Forces")
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "Class", Dim::None, Digits::Usual)
        .column("", "Solution", Dim::None, Digits::Usual)
        .column("Horizontal", "Distance", Dim::Length, Digits::Usual);
    for name in ["FX", "FY", "FZ"] {
        table = table.column("Force on Body", name, Dim::Force, Digits::Usual);
    }
    let mut table = table
        .column("Tension", "Ten Top", Dim::Force, Digits::Usual)
        .column("Tension", "Max T/TB", Dim::None, Digits::Decimals(3))
        .column("Tension", "Crit. Seg", Dim::None, Digits::Usual)
        .column("Anchor", "V. Pull", Dim::Force, Digits::Usual)
        .column("Anchor", "H. Pull", Dim::Force, Digits::Usual)
        .column("On Bottom", "Unstretched", Dim::Length, Digits::Usual);
    let mut notes: Vec<(String, Vec<String>)> = Vec::new();
    let mut springs = spring_table("Springs of Connectors");
    let mut fenders = Vec::new();
    for connector in model.connectors.values().filter(|c| fits(&c.name)) {
        let (solution, found) = match connector.active {
            false => ("inactive", None),
            true if model.holds_pipe(&connector.name) => ("in pipe", None),
            true => match found(model, connector) {
                Ok(mut found) => {
                    notes.push((connector.name.clone(), told(&mut found.summary, units)));
                    (found.summary.solution, Some(found))
                }
                Err(error) => {
                    table.absent += 1;
                    notes.push((connector.name.clone(), vec![format!("{WARNING}{}", error.text(units))]));
                    ("none", None)
                }
            },
        };
        if let Some(found) = &found {
            verdict.over_break.extend(judged(&connector.name, &found.summary, "&STATUS F_CONNECTOR"));
            spring_rows(&mut springs, connector, &found.summary);
            fenders.extend(found.summary.fender.map(|state| (connector.name.as_str(), state)));
        }
        let mut row: Vec<Cell> = vec![connector.name.as_str().into(), connector.class.as_str().into(), solution.into()];
        row.extend(numbers(found.as_ref()));
        push(&mut table, row);
    }
    table.notes = gathered(&notes);
    add_model_column(&mut table, |name| model.idealisation(name));
    let springs = Some(springs).filter(|s| s.rows() > 0);
    let fenders = fender_table("Fenders", fenders.iter().map(|(name, state)| (*name, state, None)));
    std::iter::once(table).chain(springs).chain(Some(fenders).filter(|f| f.rows() > 0)).collect()
}

/// The FOUNDATION check [MOSES-FLEX FOUNDATION]: every spring of every foundation against its allowable, and the largest of each.
pub fn foundations(model: &Model, fits: &dyn Fn(&str) -> bool, units: UnitSystem) -> Table {
    let mut table = spring_table("Foundation Check");
    let mut notes: Vec<(String, Vec<String>)> = Vec::new();
    let mut largest: Option<(f64, &str)> = None;
    let foundation = |c: &&Connector| {
        model.classes.get(&Model::key(&c.class)).is_some_and(|class| class.object.foundation()) && fits(&c.name)
    };
    for connector in model.connectors.values().filter(foundation).filter(|c| c.active) {
        match found(model, connector) {
            Ok(mut found) => {
                spring_rows(&mut table, connector, &found.summary);
                let ratio = found.summary.ratio.unwrap_or(0.0);
                if largest.is_none_or(|(most, _)| ratio > most) {
                    largest = Some((ratio, &connector.name));
                }
                notes.push((connector.name.clone(), told(&mut found.summary, units)));
            }
            Err(error) => {
                table.absent += 1;
                notes.push((connector.name.clone(), vec![format!("{WARNING}{}", error.text(units))]));
            }
        }
    }
    table.notes = gathered(&notes);
    if let Some((ratio, name)) = largest {
        table = table.fact("Largest Unity", ratio, Dim::None).fact("Of", name, Dim::None);
    }
    table
}

/// Takes what a user should know out of a summary, in these units.
fn told(summary: &mut Summary, units: UnitSystem) -> Vec<String> {
    std::mem::take(&mut summary.notes).iter().map(|note| note.text(units)).collect()
}

fn found(model: &Model, connector: &Connector) -> Result<Found, ClassError> {
    let mut element = model.element(connector)?;
    if element.moves() {
        // it feels current, bottom and contents all along itself
        element = model.element_in(connector, Some(&ambient(model, None)?))?;
    }
    let ends = model.end_poses(connector).map(End::still);
    let mut committed = vec![0.0; element.states()];
    element.start(&mut committed);
    let surroundings = model.surroundings();
    let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
    let (mut out, mut trial) = (Response::default(), committed.clone());
    element.evaluate(&at, &committed, &mut trial, &mut None, &mut out)?;
    // less than what a solution is exact to is no force
    let shown = |w: &Six| {
        let size = 1e-12 * w.fixed_rows::<3>(0).norm();
        [w[0], w[1], w[2]].map(|v| if v.abs() < size { 0.0 } else { v })
    };
    let force = |i: usize| out.wrench.get(i).map_or([0.0; 3], shown);
    let [first, second] = ends.map(|e| e.pose.origin);
    let distance = (second - first).xy().norm();
    let is_on_body = |name: &String| model.points.get(&Model::key(name)).is_some_and(|p| model.body_of(p).is_some());
    let on_body = connector.points.iter().take(2).position(is_on_body).unwrap_or(0);
    let mut summary = element.summary(&at, &committed)?;
    let is_line = model.classes.get(&Model::key(&connector.class)).is_some_and(|class| class.object.is_line());
    if let (1, true, Some(tension)) = (on_body, is_line, &mut summary.tension) {
        // that at the end on the body, as the force; a push is negative
        *tension = force(1).iter().fold(0.0, |size: f64, f| size.hypot(*f)).copysign(*tension);
    }
    Ok(Found { forces: [force(0), force(1)], on_body, distance, summary })
}

/// The ten numbers of a row.
fn numbers(found: Option<&Found>) -> [Cell; 10] {
    let Some(Found { forces, on_body, distance, summary }) = found else { return [const { Cell::Missing }; 10] };
    let [fx, fy, fz] = forces.get(*on_body).copied().unwrap_or_default();
    // what holds the far end of the line
    let [ax, ay, az] = forces.get(1 - on_body).copied().unwrap_or_default();
    let line = |value: f64| if summary.tension.is_some() { Cell::from(value) } else { Cell::Missing };
    [
        (*distance).into(),
        fx.into(),
        fy.into(),
        fz.into(),
        summary.tension.into(),
        summary.ratio.into(),
        summary.critical.into(),
        // no pull is zero without a sign
        line(az + 0.0),
        line(ax.hypot(ay)),
        summary.grounded.into(),
    ]
}

fn spring_table(title: &str) -> Table {
    Table::new(title)
        .column("", "Name", Dim::None, Digits::Usual)
        .column("", "DF", Dim::None, Digits::Usual)
        .column("Translation", "Deflection", Dim::Length, Digits::Decimals(4))
        .column("Translation", "Force", Dim::Force, Digits::Usual)
        .column("Translation", "Allowable", Dim::Force, Digits::Usual)
        .column("Rotation", "Angle", Dim::Angle, Digits::Decimals(4))
        .column("Rotation", "Moment", Dim::Moment, Digits::Usual)
        .column("Rotation", "Allow. Moment", Dim::Moment, Digits::Usual)
        .column("", "Unity", Dim::None, Digits::Decimals(3))
}

fn spring_rows(table: &mut Table, connector: &Connector, summary: &Summary) {
    for spring in &summary.springs {
        let own: [Cell; 3] = [spring.deflection.into(), spring.force.into(), spring.allowable.into()];
        let none = || [const { Cell::Missing }; 3];
        let unity = spring.allowable.map(|a| spring.force.abs() / a);
        let mut row: Vec<Cell> = vec![connector.name.as_str().into(), spring.dof.as_str().into()];
        let turns = spring.dof.starts_with('R');
        row.extend(if turns { none() } else { own.clone() });
        row.extend(if turns { own } else { none() });
        row.push(unity.into());
        push(table, row);
    }
}
