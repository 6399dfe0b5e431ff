//! Tables of the structure that tethers hold [AQWA-TETHER 8.2].

use super::Tethered;
use super::history::{Quantity, StructureHistory};
use super::tables::{SECONDS, column, text};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_signal::SeriesError;
use windlass_signal::cycle::{AQWA_SAMPLES, Cycle};

/// Dimensions and digits of the six of a kind of [`StructureHistory`].
fn six(kind: usize) -> [(Dim, Digits); 2] {
    let three = Digits::Decimals(3);
    match kind {
        0 => [(Dim::Length, three), (Dim::Angle, three)],
        1 => [(Dim::Velocity, three), (Dim::AngularVelocity, three)],
        2 => [(Dim::Acceleration, three), (Dim::AngularAcceleration, three)],
        12 => [(Dim::Length, Digits::Scientific(3)), (Dim::Angle, Digits::Scientific(3))],
        _ => [(Dim::Force, Digits::Scientific(4)), (Dim::Moment, Digits::Scientific(4))],
    }
}

/// A value as zero when it is rounding beside the largest of its kind.
fn without_noise(value: f64, largest: f64) -> f64 {
    if value.abs() < 1e-12 * largest { 0.0 } else { value }
}

const SIX: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// The motion of the structure's centre of gravity and the forces on it at an instant [AQWA-TETHER 8.2]: a motion or kind of force a row.
/// Two tables: one of motions with the points asked for, one of forces.
pub fn structure(run: &Tethered, structure: &StructureHistory, instant: usize, points: &[usize]) -> [Table; 2] {
    let time = run.times.get(instant).copied();
    let title = |what: &str| format!("{what} of Structure {}", structure.body);
    let mut out = [title("Motions"), title("Forces")]
        .map(|t| Table::new(t).fact("Time", time, Dim::Time).column("", "Freedom", Dim::None, Digits::Usual));
    let at = |kind: usize, dof: usize| {
        let all = (0..6).filter_map(|f| structure.at(instant, 6 * kind + f));
        let largest = all.fold(0.0, |most: f64, v| most.max(v.abs()));
        Cell::from(structure.at(instant, 6 * kind + dof).map(|v| without_noise(v, largest)))
    };
    // the six of a motion have two dimensions: metres and degrees stand in columns of their own
    let [motions, forces] = &mut out;
    motions.columns.clear();
    forces.columns.clear();
    let kinds =
        |rows: &[usize]| rows.iter().map(|k| text(StructureHistory::KINDS.get(*k).copied().unwrap_or(""))).collect();
    let moved = [0, 1, 2, 12];
    let pushed: Vec<usize> = (3..12).collect();
    let head = |name: &str, dim, digits, cells| Column { name: name.into(), group: String::new(), dim, digits, cells };
    forces.columns.push(head("Kind", Dim::None, Digits::Usual, kinds(&pushed)));
    for (dof, name) in SIX.iter().enumerate() {
        let (dim, digits) = six(3)[dof / 3];
        let cells = pushed.iter().map(|k| at(*k, dof)).collect();
        forces.columns.push(head(name, dim, digits, cells));
    }
    motions.columns.push(head("Freedom", Dim::None, Digits::Usual, SIX.map(text).to_vec()));
    for kind in moved {
        let name = StructureHistory::KINDS.get(kind).copied().unwrap_or("");
        for (part, range) in [(0, 0..3), (1, 3..6)] {
            let (dim, digits) = six(kind)[part];
            let value = |f: usize| {
                if range.contains(&f) { at(kind, f) } else { Cell::Missing }
            };
            let cells = (0..6).map(value).collect();
            motions
                .columns
                .push(Column { group: name.into(), ..head(["Linear", "Angular"][part], dim, digits, cells) });
        }
    }
    let behind = 6 * StructureHistory::KINDS.len();
    for point in points {
        let name = structure.points.get(*point).map_or("", String::as_str);
        let cells =
            (0..6).map(|f| if f < 3 { structure.at(instant, behind + 3 * point + f).into() } else { Cell::Missing });
        let column = head("Point", Dim::Length, Digits::Decimals(3), cells.collect());
        motions.columns.push(Column { group: name.into(), ..column });
    }
    out
}

/// What the columns of each kind are called before their axis, in the order of [`StructureHistory::KINDS`].
const CODES: [&str; 13] = ["", "V", "A", "G", "H", "D", "FK", "WI", "DF", "GY", "M", "T", "E"];

/// Everything of the structure over time.
pub fn structure_series(run: &Tethered, structure: &StructureHistory) -> Table {
    let mut table = Table::new(format!("Structure {} in Time", structure.body));
    let head = Quantity { code: "", group: "", name: "Time", dim: Dim::Time, digits: SECONDS };
    table.columns.push(column(&head, run.times.iter().map(|t| Cell::Number(*t)).collect()));
    for ((kind, name), code) in StructureHistory::KINDS.iter().enumerate().zip(CODES) {
        for (dof, axis) in SIX.iter().enumerate() {
            let (dim, digits) = six(kind)[dof / 3];
            let cells = structure.series(6 * kind + dof).into_iter().map(Cell::Number).collect();
            table.columns.push(Column { name: format!("{code}{axis}"), group: (*name).into(), dim, digits, cells });
        }
    }
    for (index, point) in structure.points.iter().enumerate() {
        for (axis, name) in SIX.iter().take(3).enumerate() {
            let cells = structure.series(6 * StructureHistory::KINDS.len() + 3 * index + axis);
            let cells = cells.into_iter().map(Cell::Number).collect();
            let (dim, digits) = six(0)[0];
            table.columns.push(Column { name: (*name).into(), group: point.clone(), dim, digits, cells });
        }
    }
    table
}

/// Mean, drift and the first harmonics of the structure's motions over one cycle [AQWA-TETHER 8.2.21]: the cycle of a regular wave's period
/// from the first of the instants, or what lies between the first and the last of them. As the listing has it, `x = mean + sum A cos(n w t -
/// phase)` by sixteen samples of the cycle, what it drifts taken off as a straight line about its middle.
///
/// # Errors
/// Too few instants, or a cycle that they do not hold.
pub fn harmonics(
    run: &Tethered,
    structure: &StructureHistory,
    period: Option<f64>,
    instants: &[usize],
) -> Result<Table, SeriesError> {
    let time = |place: Option<&usize>| place.and_then(|i| run.times.get(*i)).copied().unwrap_or_default();
    let (start, end) = (time(instants.first()), time(instants.last()));
    let period = period.unwrap_or(end - start);
    let mut table = Table::new(format!("Harmonics of Structure {}", structure.body))
        .fact("Start", start, Dim::Time)
        .fact("Period", period, Dim::Time)
        .column("", "Motion", Dim::None, Digits::Usual)
        .column("", "Freedom", Dim::None, Digits::Usual)
        .column("", "Mean", Dim::None, Digits::Decimals(4))
        .column("", "Drift", Dim::None, Digits::Decimals(4));
    for order in ["1", "2", "3", "4"] {
        table = table.column(order, "Amplitude", Dim::None, Digits::Decimals(4)).column(
            order,
            "Phase",
            Dim::Angle,
            Digits::Decimals(1),
        );
    }
    for (kind, motion) in StructureHistory::KINDS.iter().enumerate().take(3) {
        let mut cycles = Vec::new();
        for dof in 0..SIX.len() {
            let values = structure.series(6 * kind + dof);
            cycles.push(Cycle::of(&run.times, &values, (start, period), 4, AQWA_SAMPLES)?);
        }
        let largest = cycles.iter().fold(0.0, |most: f64, c| most.max(c.mean.abs()).max(c.drift.abs()));
        for ((dof, axis), found) in SIX.iter().enumerate().zip(&cycles) {
            // one column holds metres and degrees: numbers without a dimension, in metres and degrees
            let told = |value: f64| {
                let value = without_noise(value, largest);
                if dof < 3 { value } else { value.to_degrees() }
            };
            let mut row = vec![text(motion), text(axis), told(found.mean).into(), told(found.drift).into()];
            for harmonic in &found.harmonics {
                let amplitude = told(harmonic.amplitude);
                let phase = if amplitude > 0.0 { Cell::Number(-harmonic.phase) } else { Cell::Missing };
                row.extend([amplitude.into(), phase]);
            }
            // the row has one cell a column
            let _ = table.push(row);
        }
    }
    table.note("lengths in metres, angles in degrees; x = mean + sum A cos(n w t - phase)");
    Ok(table)
}
