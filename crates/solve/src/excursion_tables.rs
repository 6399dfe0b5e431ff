//! Excursions and watch circles as tables.

use super::excursion;
use super::excursion::{End, Moved, Path, Walk, worst};
use super::system::{DOFS, SolveError, System, without_rounding};
use super::watch::{Circle, Watched};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::table::{Cell, Digits, Table};
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
pub struct Asked<'a> {
    /// The body as written.
    pub name: &'a str,
    /// Where it stands: its heading is told near this one.
    pub place: &'a Place,
    /// The poses of all bodies before they are moved.
    pub start: &'a [Pose],
    /// How it is moved; the direction is that of the first of several.
    pub path: Path,
    /// Units in which notes tell values.
    pub units: UnitSystem,
}

fn push(table: &mut Table, row: Vec<Cell>) {
    let fits = table.push(row);
    debug_assert!(fits.is_ok(), "a row must fit its table");
}

/// What rounding leaves of a sum whose terms are as large as `scale` is nothing.
fn sum(value: f64, scale: f64) -> Cell {
    Cell::Number(if value.abs() <= 1e-11 * scale { 0.0 } else { value })
}

/// Restoring, transverse and vertical force.
fn resolved(moved: &Moved, direction: f64) -> [Cell; 3] {
    let scale = moved.lines.iter().filter_map(|l| l.tension).fold(0.0, |sum, t| sum + t.abs());
    excursion::resolved(&moved.wrench, direction).map(|force| sum(force, scale))
}

/// The facts that hold for all rows.
fn headed(title: String, asked: &Asked, systems: &Systems) -> Table {
    let others = if asked.path.free { "free" } else { "held" };
    let table = Table::new(title).fact("Other Freedoms", others, Dim::None);
    if systems.removed.is_empty() { table } else { table.fact("Removed", systems.removed.join(" "), Dim::None) }
}

fn forces(table: Table) -> Table {
    table
        .column("Force of Connectors", "Restoring", Dim::Force, Digits::Usual)
        .column("Force of Connectors", "Transverse", Dim::Force, Digits::Usual)
        .column("Force of Connectors", "Vertical", Dim::Force, Digits::Usual)
}

fn critical(table: Table) -> Table {
    table.column("Critical Line", "Max T/TB", Dim::None, Digits::Decimals(3)).column(
        "Critical Line",
        "Line",
        Dim::None,
        Digits::Usual,
    )
}

/// Largest T/break and the name of the line that has it.
fn critical_cells(worst: Option<(f64, usize)>, names: &[String]) -> [Cell; 2] {
    let name = worst.and_then(|(_, line)| names.get(line)).map(String::as_str);
    [worst.map(|(ratio, _)| ratio).into(), name.into()]
}

fn degrees(angle: f64) -> String {
    format!("{}", (angle.to_degrees() * 1e6).round() / 1e6)
}

/// How a path ended, as a note.
fn note(end: &End, names: &[String], at: f64, units: UnitSystem) -> Option<String> {
    let told = |dim: Dim, value: f64| format!("{:.2} {}", dim.from_si(value, units), dim.label(units));
    match end {
        End::Breaks(line) => {
            let name = names.get(*line).map_or("", String::as_str);
            Some(if at > 0.0 {
                format!("line {name} breaks at an excursion of {}", told(Dim::Length, at))
            } else {
                format!("warning: line {name} is beyond its breaking tension where the body is")
            })
        }
        End::Most => None,
        End::Lost(SolveError { who, error }) => {
            let who = who.as_deref().map_or(String::new(), |w| format!("{w}: "));
            let at = told(Dim::Length, at);
            Some(format!("warning: the table ends at an excursion of {at}: farther on {who}{}", error.text(units)))
        }
    }
}

/// One direction: a row an excursion.
///
/// # Errors
/// As [`Walk::rows`].
pub fn along(systems: &Systems, asked: &Asked, rows: usize) -> Result<Table, SolveError> {
    let Asked { path, units, start, .. } = *asked;
    let mut walk = Walk::new(&systems.system, start, path)?;
    let names = walk.names();
    let (list, end) = walk.rows(rows)?;
    let title = format!("Excursion of {} toward {} degrees", asked.name, degrees(path.direction));
    let mut table = headed(title, asked, systems).column("", "Excursion", Dim::Length, Digits::Usual);
    for name in ["X", "Y", "Z"] {
        table = table.column("Location", name, Dim::Length, Digits::Usual);
    }
    table = forces(table.column("Location", "Heading", Dim::Angle, Digits::Usual));
    for name in ["MX", "MY", "MZ"] {
        table = table.column("Moment of Connectors", name, Dim::Moment, Digits::Usual);
    }
    table = critical(table);
    for name in &names {
        table = table.column("Tension", &format!("Ten {name}"), Dim::Force, Digits::Usual);
    }
    for name in &names {
        table = table.column("T/TB", &format!("T/TB {name}"), Dim::None, Digits::Decimals(3));
    }
    let mut intact = systems.intact.as_ref().map(|system| Walk::new(system, start, path)).transpose()?;
    if intact.is_some() {
        table = table
            .column("Intact", "Intact Force", Dim::Force, Digits::Usual)
            .column("Intact", "Intact T/TB", Dim::None, Digits::Decimals(3))
            .column("Intact", "Intact Line", Dim::None, Digits::Usual);
    }
    let all = intact.as_ref().map_or(Vec::new(), Walk::names);
    for moved in &list {
        let mut row = row(moved, &names, asked);
        if let Some(intact) = &mut intact {
            match intact.at(moved.excursion) {
                Ok(there) => {
                    let [force, ..] = resolved(&there, path.direction);
                    row.push(force);
                    row.extend(critical_cells(there.worst(), &all));
                }
                Err(_) => row.extend([const { Cell::Missing }; 3]),
            }
        }
        push(&mut table, row);
    }
    table.notes.extend(note(&end, &names, list.last().map_or(0.0, |m| m.excursion), units));
    table.note("the restoring force pushes back along the direction; the transverse force is toward its left");
    table.note("moments are about the body's origin, along global axes");
    Ok(table)
}

fn row(moved: &Moved, names: &[String], asked: &Asked) -> Vec<Cell> {
    let Moved { excursion, poses, wrench, lines } = moved;
    let place = poses.get(asked.path.body).map_or(*asked.place, |p| without_rounding(p.place(asked.place)));
    let [x, y, z, _, _, heading] = place.values();
    let mut row = vec![Cell::Number(*excursion), sum(x, *excursion), sum(y, *excursion)];
    row.extend([z, heading].map(Cell::Number));
    row.extend(resolved(moved, asked.path.direction));
    let most = wrench.fixed_rows::<3>(3).amax();
    row.extend([wrench[3], wrench[4], wrench[5]].map(|moment| sum(moment, most)));
    row.extend(critical_cells(moved.worst(), names));
    row.extend(lines.iter().map(|l| Cell::from(l.tension)));
    row.extend(lines.iter().map(|l| Cell::from(l.ratio)));
    row
}

/// Several directions: a row each, where its path ends, and at each of the excursions `at` (m) with its name in heads.
///
/// # Errors
/// As [`Walk::end`].
pub fn around(systems: &Systems, asked: &Asked, directions: &[f64], at: &[(f64, String)]) -> Result<Table, SolveError> {
    let title = format!("Excursions of {}", asked.name);
    let mut table = headed(title, asked, systems).column("", "Direction", Dim::Angle, Digits::Usual).column(
        "At the End",
        "Excursion",
        Dim::Length,
        Digits::Usual,
    );
    table = critical(forces(table));
    for (_, name) in at {
        table = table.column("Restoring", &format!("Force {name}"), Dim::Force, Digits::Usual);
        table = table.column("Max T/TB", &format!("T/TB {name}"), Dim::None, Digits::Decimals(3));
    }
    if systems.intact.is_some() {
        table = table
            .column("Intact", "Intact Exc.", Dim::Length, Digits::Usual)
            .column("Intact", "Intact Force", Dim::Force, Digits::Usual)
            .column("Intact", "Intact Line", Dim::None, Digits::Usual);
    }
    let mut lost = None;
    for direction in directions {
        let path = Path { direction: *direction, ..asked.path };
        let mut walk = Walk::new(&systems.system, asked.start, path)?;
        let names = walk.names();
        let (last, end) = walk.end()?;
        let broken = matches!(end, End::Breaks(_));
        let plain = matches!(end, End::Most) || (broken && last.excursion > 0.0);
        if !plain && lost.is_none() {
            lost = note(&end, &names, last.excursion, asked.units)
                .map(|text| format!("{text} (toward {} degrees)", degrees(*direction)));
        }
        let mut row = vec![Cell::Number(*direction), last.excursion.into()];
        row.extend(resolved(&last, *direction));
        row.extend(critical_cells(last.worst(), &names));
        for (excursion, _) in at {
            walk.back();
            match if *excursion <= last.excursion { walk.at(*excursion).ok() } else { None } {
                Some(there) => {
                    let [force, ..] = resolved(&there, *direction);
                    row.extend([force, there.worst().map(|(ratio, _)| ratio).into()]);
                }
                None => row.extend([const { Cell::Missing }; 2]),
            }
        }
        if let Some(system) = &systems.intact {
            let mut walk = Walk::new(system, asked.start, path)?;
            let (last, _) = walk.end()?;
            let [force, ..] = resolved(&last, *direction);
            let [_, line] = critical_cells(last.worst(), &walk.names());
            row.extend([last.excursion.into(), force, line]);
        }
        push(&mut table, row);
    }
    table.notes.extend(lost);
    table.note("directions in which the body is moved, from +X toward +Y; PLOT Direction Excursion -POLAR draws them");
    if at.iter().any(|(excursion, _)| table.get("Excursion").is_some_and(|c| c.numbers().iter().any(|e| e < excursion)))
    {
        table.note("no force is given at an excursion beyond that at which the first line breaks");
    }
    Ok(table)
}

/// The places of a watch circle, with those of the intact mooring beside them where lines are removed.
pub fn circle((asked, force): (&Asked, f64), systems: &Systems, found: &Circle, intact: Option<&Circle>) -> Table {
    let title = format!("Watch Circle of {}", asked.name);
    let mut table = headed(title, asked, systems).fact("Force", force, Dim::Force).column(
        "Force",
        "From",
        Dim::Angle,
        Digits::Usual,
    );
    let Circle { names, places } = found;
    let [x, y, ..] = DOFS;
    for name in [x, y] {
        table = table.column("Location", name, Dim::Length, Digits::Usual);
    }
    table = table
        .column("", "Excursion", Dim::Length, Digits::Usual)
        .column("", "Heading", Dim::Angle, Digits::Usual)
        .column("Critical Line", "Tension", Dim::Force, Digits::Usual);
    table = critical(table);
    if intact.is_some() {
        table = table
            .column("Intact", "Intact X", Dim::Length, Digits::Usual)
            .column("Intact", "Intact Y", Dim::Length, Digits::Usual)
            .column("Intact", "Intact Exc.", Dim::Length, Digits::Usual);
    }
    let start = asked.start.get(asked.path.body).copied().unwrap_or_default();
    let gone = |pose: &Pose| (pose.origin.x - start.origin.x).hypot(pose.origin.y - start.origin.y);
    let mut broken: Vec<String> = Vec::new();
    for (index, Watched { direction, pose, lines }) in places.iter().enumerate() {
        let most = worst(lines);
        if let Some((_, line)) = most.filter(|(ratio, _)| *ratio > 1.0)
            && let Some(name) = names.get(line).filter(|n| !broken.contains(n))
        {
            broken.push(name.clone());
        }
        let heading = without_rounding(pose.place(asked.place)).turn[2];
        let tension = most.and_then(|(_, line)| lines.get(line)).and_then(|l| l.tension);
        let at = |pose: &Pose| {
            // as far as the solution goes
            let rest = 1e2 * gone(pose);
            [sum(pose.origin.x, rest), sum(pose.origin.y, rest), gone(pose).into()]
        };
        let mut row = vec![Cell::Number(*direction)];
        row.extend(at(pose));
        row.extend([sum(heading, 1.0), tension.into()]);
        row.extend(critical_cells(most, names));
        if let Some(other) = intact {
            row.extend(other.places.get(index).map_or([const { Cell::Missing }; 3], |w| at(&w.pose)));
        }
        push(&mut table, row);
    }
    for name in broken {
        table.note(format!("warning: line {name} is beyond its breaking tension under the force"));
    }
    table.note("the force comes from the direction, from +X toward +Y; excursions are from where the body stands");
    table
}
