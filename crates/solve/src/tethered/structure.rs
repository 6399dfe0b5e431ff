//! Tables of the structure that tethers hold [AQWA-TETHER 8.2].

use super::Tethered;
use super::history::StructureHistory;
use super::tables::SECONDS;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_signal::SeriesError;
use windlass_signal::cycle::{AQWA_SAMPLES, HarmonicCycle};

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

const DOF_NAMES: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// The motion of the structure's centre of gravity and the forces on it at an instant [AQWA-TETHER 8.2]: a motion or kind of force a row.
/// Two tables: one of motions with the points asked for, one of forces.
pub fn structure(run: &Tethered, structure: &StructureHistory, instant: usize, points: &[usize]) -> [Table; 2] {
    let time = run.times.get(instant).copied();
    let title = |what: &str| format!("{what} of Structure {}", structure.body);
    let at = |kind: usize, dof: usize| {
        let all = (0..6).filter_map(|f| structure.value(instant, 6 * kind + f));
        let largest = all.fold(0.0, |most: f64, v| most.max(v.abs()));
        Cell::from(structure.value(instant, 6 * kind + dof).map(|v| without_noise(v, largest)))
    };
    let named = |title: String| Table::new(title).fact("Time", time, Dim::Time);
    let kind_name = |kind: &usize| StructureHistory::KINDS.get(*kind).copied().unwrap_or("");
    let pushed: Vec<usize> = (3..12).collect();
    let mut forces = named(title("Forces")).with_rows(&pushed).text("Kind", kind_name);
    for (dof, name) in DOF_NAMES.iter().enumerate() {
        let (dim, digits) = six(3)[dof / 3];
        forces = forces.column("", name, dim, digits, |kind| at(*kind, dof));
    }
    // the six of a motion have two dimensions: metres and degrees stand in columns of their own
    let dofs: Vec<(usize, &str)> = DOF_NAMES.into_iter().enumerate().collect();
    let mut motions = named(title("Motions")).with_rows(&dofs).text("Freedom", |(_, name)| *name);
    for kind in [0, 1, 2, 12] {
        for ((dim, digits), (part, range)) in six(kind).into_iter().zip([("Linear", 0..3), ("Angular", 3..6)]) {
            motions = motions.column(kind_name(&kind), part, dim, digits, |(dof, _)| {
                if range.contains(dof) { at(kind, *dof) } else { Cell::Missing }
            });
        }
    }
    let behind = 6 * StructureHistory::KINDS.len();
    for point in points {
        let name = structure.points.get(*point).map_or("", String::as_str);
        motions = motions.column(name, "Point", Dim::Length, Digits::Decimals(3), |(dof, _)| {
            if *dof < 3 { structure.value(instant, behind + 3 * point + dof) } else { None }
        });
    }
    [motions.build(), forces.build()]
}

/// What the columns of each kind are called before their axis, in the order of [`StructureHistory::KINDS`].
const CODES: [&str; 13] = ["", "V", "A", "G", "H", "D", "FK", "WI", "DF", "GY", "M", "T", "E"];

/// Everything of the structure over time.
pub fn structure_series(run: &Tethered, structure: &StructureHistory) -> Table {
    let mut columns = vec![Column::new("", "Time", Dim::Time, SECONDS, run.times.iter().copied())];
    for ((kind, name), code) in StructureHistory::KINDS.iter().enumerate().zip(CODES) {
        for (dof, axis) in DOF_NAMES.iter().enumerate() {
            let (dim, digits) = six(kind)[dof / 3];
            let values = structure.series(6 * kind + dof);
            columns.push(Column::new(name, &format!("{code}{axis}"), dim, digits, values));
        }
    }
    for (index, point) in structure.points.iter().enumerate() {
        for (axis, name) in DOF_NAMES.iter().take(3).enumerate() {
            let values = structure.series(6 * StructureHistory::KINDS.len() + 3 * index + axis);
            let (dim, digits) = six(0)[0];
            columns.push(Column::new(point, name, dim, digits, values));
        }
    }
    Table::from_columns(format!("Structure {} in Time", structure.body), columns)
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
    let mut rows = Vec::new();
    for (kind, motion) in StructureHistory::KINDS.iter().enumerate().take(3) {
        let mut cycles = Vec::new();
        for dof in 0..DOF_NAMES.len() {
            let values = structure.series(6 * kind + dof);
            cycles.push(HarmonicCycle::new(&run.times, &values, (start, period), 4, AQWA_SAMPLES)?);
        }
        let largest = cycles.iter().fold(0.0, |most: f64, c| most.max(c.mean.abs()).max(c.drift.abs()));
        for ((dof, axis), found) in DOF_NAMES.iter().enumerate().zip(&cycles) {
            rows.push(HarmonicRow { motion, dof, axis, largest, found: found.clone() });
        }
    }
    let mut table = Table::new(format!("Harmonics of Structure {}", structure.body))
        .fact("Start", start, Dim::Time)
        .fact("Period", period, Dim::Time)
        .with_rows(&rows)
        .text("Motion", |row| row.motion)
        .text("Freedom", |row| row.axis)
        .column("", "Mean", Dim::None, Digits::Decimals(4), |row| row.user_value(row.found.mean))
        .column("", "Drift", Dim::None, Digits::Decimals(4), |row| row.user_value(row.found.drift));
    for (order, head) in ["1", "2", "3", "4"].into_iter().enumerate() {
        table = table.column(head, "Amplitude", Dim::None, Digits::Decimals(4), |row| row.amplitude(order)).column(
            head,
            "Phase",
            Dim::Angle,
            Digits::Decimals(1),
            |row| {
                row.amplitude(order).filter(|amplitude| *amplitude > 0.0)?;
                row.found.harmonics.get(order).map(|harmonic| -harmonic.phase)
            },
        );
    }
    let mut table = table.build();
    table.note("lengths in metres, angles in degrees; x = mean + sum A cos(n w t - phase)");
    Ok(table)
}

/// The harmonics of one of the six of a motion.
struct HarmonicRow<'r> {
    motion: &'r str,
    axis: &'r str,
    dof: usize,
    /// The largest mean or drift of the six: what is rounding beside it is nothing.
    largest: f64,
    found: HarmonicCycle,
}

impl HarmonicRow<'_> {
    /// A value in metres or degrees: one column holds both, as numbers without a dimension.
    fn user_value(&self, value: f64) -> f64 {
        let value = without_noise(value, self.largest);
        if self.dof < 3 { value } else { value.to_degrees() }
    }

    /// The amplitude of a harmonic, the first from 0.
    fn amplitude(&self, order: usize) -> Option<f64> {
        self.found.harmonics.get(order).map(|harmonic| self.user_value(harmonic.amplitude))
    }
}
