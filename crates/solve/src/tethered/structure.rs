//! Tables of the structure that tethers hold [AQWA-TETHER 8.2].

use super::Tethered;
use super::history::StructureHistory;
use super::tables::SECONDS;
use std::f64::consts::TAU;
use windlass_base::fortran::{exponent, format_fixed, without_noise};
use windlass_base::table::{Column, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
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

const DOF_NAMES: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

/// The expected error of a step among [`StructureHistory::KINDS`].
const ERROR: usize = 12;
/// Heads of the degrees of freedom in the listing.
const FREEDOM_HEADS: [&str; 6] = ["X SURGE", "Y SWAY", "Z HEAVE", "RX ROLL", "RY PITCH", "RZ YAW"];

/// The page of the structure at an instant [AQWA-TETHER 8.2]: the motion of its centre of gravity, the forces on it, the expected error of the step and the
/// places of points asked for, a row each. `omitted` kinds of [`StructureHistory::KINDS`] are left out. Lengths, angles and forces stand below each other, so
/// that values are texts in the units given.
pub fn structure(
    run: &Tethered,
    structure: &StructureHistory,
    instant: usize,
    (points, omitted): (&[usize], &[usize]),
    units: UnitSystem,
) -> Table {
    let time = run.times.get(instant).copied().unwrap_or_default();
    let cell = |kind: usize, dof: usize| {
        let of_kind = (0..6).filter_map(|f| structure.value(instant, 6 * kind + f));
        let largest = of_kind.fold(0.0, |most: f64, v| most.max(v.abs()));
        let value = without_noise(structure.value(instant, 6 * kind + dof).unwrap_or_default(), largest);
        // the listing has the errors of rotations in radians
        let dim = if kind == ERROR && dof >= 3 { Dim::None } else { six(kind)[dof / 3].0 };
        let value = dim.from_si(value, units);
        if kind < 3 { format_fixed(value, 4) } else { exponent(value, 4) }
    };
    let kinds: Vec<usize> = (0..StructureHistory::KINDS.len()).filter(|kind| !omitted.contains(kind)).collect();
    let named = |point: &usize| format!("POSITION {}", structure.points.get(*point).map_or("", String::as_str));
    let names = kinds.iter().filter_map(|kind| StructureHistory::KINDS.get(*kind)).map(|name| (*name).to_string());
    let names = names.chain(points.iter().map(named));
    let head = "POSITION, FORCES AND MOMENTS AT CENTRE OF GRAVITY";
    let mut columns = vec![Column::new("", head, Dim::None, Digits::Usual, names)];
    let behind = 6 * StructureHistory::KINDS.len();
    for (dof, name) in FREEDOM_HEADS.into_iter().enumerate() {
        let position = |point: &usize| {
            let value = (dof < 3).then(|| structure.value(instant, behind + 3 * point + dof)).flatten();
            value.map_or(String::new(), |value| format_fixed(Dim::Length.from_si(value, units), 4))
        };
        let cells = kinds.iter().map(|kind| cell(*kind, dof)).chain(points.iter().map(position));
        columns.push(Column::right_aligned("DEGREE OF FREEDOM", name, cells));
    }
    let mut table = Table::from_columns(format!("Structure {}", structure.body), columns)
        .fact_with_digits("TIME", time, Dim::Time, SECONDS)
        .fact("RECORD NO.", (time / run.settings.step).round() as usize + 1, Dim::None);
    if kinds.contains(&ERROR) {
        table.note("errors of rotations in radians");
    }
    table
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
            // heads of their own, as those of the centre of gravity are X, Y, Z
            columns.push(Column::new("", &format!("{point} {name}"), dim, digits, values));
        }
    }
    Table::from_columns(format!("Structure {} in Time", structure.body), columns)
}

/// Mean, drift and the first harmonics of the structure's motions over one cycle, a page of positions, of velocities and of accelerations [AQWA-TETHER 8.2.21]: the cycle of a regular wave's period
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
) -> Result<Vec<Table>, SeriesError> {
    let time = |position: Option<&usize>| position.and_then(|i| run.times.get(*i)).copied().unwrap_or_default();
    let (start, end) = (time(instants.first()), time(instants.last()));
    let period = period.unwrap_or(end - start);
    let mut tables = Vec::new();
    for (kind, motion) in StructureHistory::KINDS.iter().enumerate().take(3) {
        let mut cycles = Vec::new();
        for dof in 0..FREEDOM_NAMES.len() {
            let values = structure.series(6 * kind + dof);
            cycles.push(HarmonicCycle::new(&run.times, &values, (start, period), 4, AQWA_SAMPLES)?);
        }
        let largest = cycles.iter().fold(0.0, |most: f64, c| most.max(c.mean.abs()).max(c.drift.abs()));
        let rows: Vec<HarmonicRow> = FREEDOM_NAMES
            .into_iter()
            .enumerate()
            .zip(&cycles)
            .map(|((dof, freedom), found)| HarmonicRow { dof, freedom, largest, found })
            .collect();
        let four = Digits::Decimals(4);
        let mut table = Table::new(format!("Harmonic Analysis of Structure {} - {motion} of COG", structure.body))
            .fact_with_digits("WAVE FREQUENCY (RAD/SEC)", TAU / period, Dim::None, Digits::Decimals(3))
            .fact_with_digits("WAVE PERIOD", period, Dim::Time, Digits::Decimals(3))
            .with_rows(&rows)
            .column("WAVE CYCLE", "NUMB", Dim::None, Digits::Usual, |_| 1usize)
            .column("CYCLE START", "TIME", Dim::Time, SECONDS, |_| start)
            .text("FREEDOM", |row| row.freedom)
            .column("", "MEAN", Dim::None, four, |row| row.user_value(row.found.mean));
        for (order, head) in ["FUNDAMENTAL", "2ND HARMONIC", "3RD HARMONIC", "4TH HARMONIC"].into_iter().enumerate() {
            table = table.column(head, "AMP", Dim::None, four, |row| row.amplitude(order)).column(
                head,
                "PHASE",
                Dim::Angle,
                Digits::Decimals(1),
                |row| {
                    let harmonic = row.found.harmonics.get(order)?;
                    let moves = row.amplitude(order).is_some_and(|amplitude| amplitude > 0.0);
                    Some(if moves { -harmonic.phase } else { 0.0 })
                },
            );
        }
        let mut table = table.column("DRIFT", "/CYCLE", Dim::None, four, |row| row.user_value(row.found.drift)).build();
        table.note("lengths in metres, angles in degrees; x = mean + sum A cos(n w t - phase)");
        tables.push(table);
    }
    Ok(tables)
}

/// What the listing calls the degrees of freedom in the pages of harmonics.
const FREEDOM_NAMES: [&str; 6] =
    ["in X direction", "in Y direction", "in Z direction", "about X axis", "about Y axis", "about Z axis"];

/// The harmonics of one of the six of a motion.
struct HarmonicRow<'r> {
    freedom: &'static str,
    dof: usize,
    /// The largest mean or drift of the six: what is rounding beside it is nothing.
    largest: f64,
    found: &'r HarmonicCycle,
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
