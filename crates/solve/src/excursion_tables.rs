//! Excursions and watch circles as tables.

use super::excursion;
use super::excursion::{ExcursionEnd, ExcursionPath, ExcursionSearch, ExcursionStep, worst};
use super::system::{DOFS, SolveError, System, without_rounding};
use super::watch::{Circle, WatchedBody};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::{Digits, Table, TableBuilder, TableNote};
use windlass_base::units::{Dim, UnitSystem};

/// The system without the lines that are removed, and the one with them where some are.
#[derive(Debug)]
pub struct Systems {
    /// What is moved.
    pub system: System,
    /// The same with nothing removed.
    pub intact: Option<System>,
    /// The lines that are removed, as written.
    pub removed: Vec<String>,
}

/// What a table of excursions is made of.
#[derive(Clone, Copy, Debug)]
pub struct ExcursionTableOptions<'a> {
    /// The body as written.
    pub name: &'a str,
    /// Where it stands: its heading is reported near this one.
    pub position: &'a Place,
    /// The poses of all bodies before they are moved.
    pub start: &'a [Pose],
    /// How it is moved; the direction is that of the first of several.
    pub path: ExcursionPath,
    /// Units of the values in notes.
    pub units: UnitSystem,
}

/// What rounding leaves of a sum whose terms are as large as `scale` is nothing.
fn sum(value: f64, scale: f64) -> f64 {
    if value.abs() <= 1e-11 * scale { 0.0 } else { value }
}

/// Restoring, transverse and vertical force.
fn restoring_cells(moved: &ExcursionStep, direction: f64) -> [f64; 3] {
    let scale = moved.lines.iter().filter_map(|l| l.tension).fold(0.0, |sum, t| sum + t.abs());
    excursion::resolve_wrench(&moved.wrench, direction).map(|force| sum(force, scale))
}

/// The facts that hold for all rows.
fn build_table(title: String, asked: &ExcursionTableOptions, systems: &Systems) -> Table {
    let others = if asked.path.free { "free" } else { "held" };
    let table = Table::new(title).fact("Other DOF", others, Dim::None);
    if systems.removed.is_empty() { table } else { table.fact("Removed", systems.removed.join(" "), Dim::None) }
}

/// The columns of restoring, transverse and vertical force.
fn forces<'r, R>(table: TableBuilder<'r, R>, resolved: impl Fn(&'r R) -> [f64; 3]) -> TableBuilder<'r, R> {
    let names = ["Restoring", "Transverse", "Vertical"];
    table.columns("Force of Connectors", names, Dim::Force, Digits::Usual, resolved)
}

/// The line that is used most, and its T/break.
#[derive(Default)]
struct Critical {
    ratio: Option<f64>,
    line: Option<String>,
}

impl Critical {
    fn new(worst: Option<(f64, usize)>, names: &[String]) -> Self {
        let line = worst.and_then(|(_, line)| names.get(line)).cloned();
        Critical { ratio: worst.map(|(ratio, _)| ratio), line }
    }

    /// The columns of the critical line.
    fn columns<'r, R>(table: TableBuilder<'r, R>, critical: impl Fn(&'r R) -> &'r Critical) -> TableBuilder<'r, R> {
        table.column("Critical Line", "Max T/TB", Dim::None, Digits::Decimals(3), |row| critical(row).ratio).column(
            "Critical Line",
            "Line",
            Dim::None,
            Digits::Usual,
            |row| critical(row).line.as_deref(),
        )
    }
}

fn degrees(angle: f64) -> String {
    format!("{}", (angle.to_degrees() * 1e6).round() / 1e6)
}

/// How a path ended, as a note.
fn note(end: &ExcursionEnd, names: &[String], at: f64, units: UnitSystem) -> Option<TableNote> {
    let with_unit = |dim: Dim, value: f64| format!("{:.2} {}", dim.from_si(value, units), dim.label(units));
    match end {
        ExcursionEnd::Breaks(line) => {
            let name = names.get(*line).map_or("", String::as_str);
            Some(if at > 0.0 {
                format!("line {name} breaks at an excursion of {}", with_unit(Dim::Length, at)).into()
            } else {
                TableNote::warning(format!("line {name} is beyond its breaking tension where the body is"))
            })
        }
        ExcursionEnd::Most => None,
        ExcursionEnd::Lost(SolveError { who, error }) => {
            let who = who.as_deref().map_or(String::new(), |w| format!("{w}: "));
            let at = with_unit(Dim::Length, at);
            let text = format!("the table ends at an excursion of {at}: farther on {who}{}", error.text(units));
            Some(TableNote::warning(text))
        }
    }
}

/// One direction: a row an excursion.
///
/// # Errors
/// As [`ExcursionSearch::rows`].
pub fn table_along_direction(
    systems: &Systems,
    asked: &ExcursionTableOptions,
    rows: usize,
) -> Result<Table, SolveError> {
    let ExcursionTableOptions { path, units, start, .. } = *asked;
    let mut walk = ExcursionSearch::new(&systems.system, start, path)?;
    let names = walk.names();
    let (list, end) = walk.rows(rows)?;
    let title = format!("Excursion of {} toward {} degrees", asked.name, degrees(path.direction));
    let mut intact = systems.intact.as_ref().map(|system| ExcursionSearch::new(system, start, path)).transpose()?;
    let all = intact.as_ref().map_or(Vec::new(), ExcursionSearch::names);
    let mut rows = Vec::new();
    for moved in &list {
        let there = intact.as_mut().and_then(|walk| walk.move_to(moved.excursion).ok());
        rows.push(AlongRow {
            moved,
            position: without_rounding(moved.poses[path.body].position(asked.position)),
            critical: Critical::new(moved.worst(), &names),
            intact_force: there.as_ref().map(|there| {
                let [force, ..] = restoring_cells(there, path.direction);
                force
            }),
            intact: there.map(|there| Critical::new(there.worst(), &all)).unwrap_or_default(),
        });
    }
    let table = build_table(title, asked, systems)
        .with_rows(&rows)
        .column("", "Excursion", Dim::Length, Digits::Usual, |row| row.moved.excursion)
        .columns("Location", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |row| {
            let ([x, y, z], rest) = (row.position.shift, row.moved.excursion);
            [sum(x, rest), sum(y, rest), z]
        })
        .column("Location", "Heading", Dim::Angle, Digits::Usual, |row| row.position.turn[2]);
    let table = forces(table, |row| restoring_cells(row.moved, path.direction)).columns(
        "Moment of Connectors",
        ["MX", "MY", "MZ"],
        Dim::Moment,
        Digits::Usual,
        |row| {
            let wrench = &row.moved.wrench;
            let most = wrench.fixed_rows::<3>(3).amax();
            [wrench[3], wrench[4], wrench[5]].map(|moment| sum(moment, most))
        },
    );
    let mut table = Critical::columns(table, |row| &row.critical);
    for (index, name) in names.iter().enumerate() {
        table = table.column("Tension", &format!("Ten {name}"), Dim::Force, Digits::Usual, |row| {
            row.moved.lines.get(index).and_then(|line| line.tension)
        });
    }
    for (index, name) in names.iter().enumerate() {
        table = table.column("T/TB", &format!("T/TB {name}"), Dim::None, Digits::Decimals(3), |row| {
            row.moved.lines.get(index).and_then(|line| line.ratio)
        });
    }
    if intact.is_some() {
        table = table
            .column("Intact", "Intact Force", Dim::Force, Digits::Usual, |row| row.intact_force)
            .column("Intact", "Intact T/TB", Dim::None, Digits::Decimals(3), |row| row.intact.ratio)
            .column("Intact", "Intact Line", Dim::None, Digits::Usual, |row| row.intact.line.as_deref());
    }
    let mut table = table.build();
    table.add_notes(note(&end, &names, list.last().map_or(0.0, |m| m.excursion), units));
    table.note("the restoring force pushes back along the direction; the transverse force is toward its left");
    table.note("moments are about the body's origin, along global axes");
    Ok(table)
}

/// A place of a body that is moved in one direction.
struct AlongRow<'m> {
    moved: &'m ExcursionStep,
    position: Place,
    critical: Critical,
    /// The restoring force (N) and the critical line of the intact mooring there.
    intact_force: Option<f64>,
    intact: Critical,
}

/// Several directions: a row each, where its path ends, and at each of the excursions `at` (m) with its name in heads.
///
/// # Errors
/// As [`ExcursionSearch::end`].
pub fn table_of_directions(
    systems: &Systems,
    asked: &ExcursionTableOptions,
    directions: &[f64],
    at: &[(f64, String)],
) -> Result<Table, SolveError> {
    let title = format!("Excursions of {}", asked.name);
    let mut rows = Vec::new();
    let mut lost = None;
    for direction in directions {
        let path = ExcursionPath { direction: *direction, ..asked.path };
        let mut walk = ExcursionSearch::new(&systems.system, asked.start, path)?;
        let names = walk.names();
        let (last, end) = walk.end()?;
        let broken = matches!(end, ExcursionEnd::Breaks(_));
        let plain = matches!(end, ExcursionEnd::Most) || (broken && last.excursion > 0.0);
        if !plain && lost.is_none() {
            lost = note(&end, &names, last.excursion, asked.units)
                .map(|text| format!("{text} (toward {} degrees)", degrees(*direction)));
        }
        let mut forces_at = Vec::new();
        for (excursion, _) in at {
            walk.restore_start();
            let there = if *excursion <= last.excursion { walk.move_to(*excursion).ok() } else { None };
            forces_at.push(there.map(|there| {
                let [force, ..] = restoring_cells(&there, *direction);
                (force, there.worst().map(|(ratio, _)| ratio))
            }));
        }
        let intact = match &systems.intact {
            Some(system) => {
                let mut walk = ExcursionSearch::new(system, asked.start, path)?;
                let (last, _) = walk.end()?;
                let [force, ..] = restoring_cells(&last, *direction);
                Some((last.excursion, force, Critical::new(last.worst(), &walk.names()).line))
            }
            None => None,
        };
        rows.push(DirectionRow {
            direction: *direction,
            excursion: last.excursion,
            force: restoring_cells(&last, *direction),
            critical: Critical::new(last.worst(), &names),
            forces_at,
            intact,
        });
    }
    let table = build_table(title, asked, systems)
        .with_rows(&rows)
        .column("", "Direction", Dim::Angle, Digits::Usual, |row| row.direction)
        .column("At the End", "Excursion", Dim::Length, Digits::Usual, |row| row.excursion);
    let mut table = Critical::columns(forces(table, |row| row.force), |row| &row.critical);
    for (index, (_, name)) in at.iter().enumerate() {
        let there = |row: &DirectionRow| row.forces_at.get(index).copied().flatten();
        table = table
            .column("Restoring", &format!("Force {name}"), Dim::Force, Digits::Usual, |row| {
                there(row).map(|(force, _)| force)
            })
            .column("Max T/TB", &format!("T/TB {name}"), Dim::None, Digits::Decimals(3), |row| {
                there(row).and_then(|(_, ratio)| ratio)
            });
    }
    if systems.intact.is_some() {
        table = table
            .column("Intact", "Intact Exc.", Dim::Length, Digits::Usual, |row| row.intact.as_ref().map(|i| i.0))
            .column("Intact", "Intact Force", Dim::Force, Digits::Usual, |row| row.intact.as_ref().map(|i| i.1))
            .column("Intact", "Intact Line", Dim::None, Digits::Usual, |row| {
                row.intact.as_ref().and_then(|(.., line)| line.as_deref())
            });
    }
    let mut table = table.build();
    table.add_notes(lost);
    table.note("directions in which the body is moved, from +X toward +Y; PLOT Direction Excursion -POLAR draws them");
    if at.iter().any(|(excursion, _)| table.get("Excursion").is_some_and(|c| c.numbers().iter().any(|e| e < excursion)))
    {
        table.note("no force is given at an excursion beyond that at which the first line breaks");
    }
    Ok(table)
}

/// Where the path in one direction ends.
struct DirectionRow {
    /// From +X toward +Y (rad).
    direction: f64,
    /// How far the body has gone (m), with the force and the critical line there.
    excursion: f64,
    force: [f64; 3],
    critical: Critical,
    /// Restoring force (N) and largest T/break at each of the excursions asked for.
    forces_at: Vec<Option<(f64, Option<f64>)>>,
    /// Excursion (m), restoring force (N) and critical line of the intact mooring.
    intact: Option<(f64, f64, Option<String>)>,
}

/// The places of a watch circle, with those of the intact mooring beside them where lines are removed.
pub fn circle(
    (asked, force): (&ExcursionTableOptions, f64),
    systems: &Systems,
    found: &Circle,
    intact: Option<&Circle>,
) -> Table {
    let title = format!("Watch Circle of {}", asked.name);
    let Circle { names, positions } = found;
    let start = asked.start[asked.path.body];
    let gone = |pose: &Pose| (pose.origin.x - start.origin.x).hypot(pose.origin.y - start.origin.y);
    let at = |pose: &Pose| {
        // as far as the solution goes
        let rest = 1e2 * gone(pose);
        [sum(pose.origin.x, rest), sum(pose.origin.y, rest), gone(pose)]
    };
    let mut broken: Vec<String> = Vec::new();
    let mut rows = Vec::new();
    for (index, WatchedBody { direction, pose, lines }) in positions.iter().enumerate() {
        let most = worst(lines);
        if let Some((_, line)) = most.filter(|(ratio, _)| *ratio > 1.0)
            && let Some(name) = names.get(line).filter(|n| !broken.contains(n))
        {
            broken.push(name.clone());
        }
        rows.push(CircleRow {
            direction: *direction,
            position: at(pose),
            heading: sum(without_rounding(pose.position(asked.position)).turn[2], 1.0),
            tension: most.and_then(|(_, line)| lines.get(line)).and_then(|l| l.tension),
            critical: Critical::new(most, names),
            intact: intact.and_then(|other| other.positions.get(index)).map(|w| at(&w.pose)),
        });
    }
    let [x, y, ..] = DOFS;
    let table = build_table(title, asked, systems)
        .fact("Force", force, Dim::Force)
        .with_rows(&rows)
        .column("Force", "From", Dim::Angle, Digits::Usual, |row| row.direction)
        .columns("Location", [x, y], Dim::Length, Digits::Usual, |row| [row.position[0], row.position[1]])
        .column("", "Excursion", Dim::Length, Digits::Usual, |row| row.position[2])
        .column("", "Heading", Dim::Angle, Digits::Usual, |row| row.heading)
        .column("Critical Line", "Tension", Dim::Force, Digits::Usual, |row| row.tension);
    let mut table = Critical::columns(table, |row| &row.critical);
    if intact.is_some() {
        let names = ["Intact X", "Intact Y", "Intact Exc."];
        table = table.columns("Intact", names, Dim::Length, Digits::Usual, |row| {
            row.intact.map_or([None; 3], |position| position.map(Some))
        });
    }
    let mut table = table.build();
    for name in broken {
        table.warn(format!("line {name} is beyond its breaking tension under the force"));
    }
    table.note("the force comes from the direction, from +X toward +Y; excursions are from where the body stands");
    table
}

/// A place of a watch circle.
struct CircleRow {
    /// Where the force comes from (rad).
    direction: f64,
    /// X, Y and excursion (m).
    position: [f64; 3],
    /// (rad)
    heading: f64,
    /// Of the critical line (N).
    tension: Option<f64>,
    critical: Critical,
    /// X, Y and excursion of the intact mooring (m).
    intact: Option<[f64; 3]>,
}
