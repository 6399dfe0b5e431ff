//! The frequency domain as tables.

use super::linear::Linear;
use super::natural::{Natural, natural};
use super::operators::Operators;
use super::quantity::{Derivative, Quantity};
use super::response::{Point, Response};
use super::statistics::{Extreme, Statistics};
use crate::equilibrium::is_unstable;
use crate::system::{DOFS, SolveError};
use std::f64::consts::TAU;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;

/// A quantity with its name and what it measures.
#[derive(Clone, Debug, PartialEq)]
pub struct Told {
    /// Its name: `X`, `L1`.
    pub name: String,
    /// Its dimension, before any derivative.
    pub dim: Dim,
    /// Itself.
    pub quantity: Quantity,
}

impl Told {
    /// A quantity to be told of.
    pub fn new(name: impl Into<String>, dim: Dim, quantity: Quantity) -> Self {
        Told { name: name.into(), dim, quantity }
    }

    /// The six degrees of freedom of a body's origin.
    pub fn dofs(linear: &Linear, body: usize) -> Vec<Self> {
        let one = |(i, name): (usize, &&str)| {
            let dim = if i < 3 { Dim::Length } else { Dim::Angle };
            Told::new(*name, dim, Quantity::dof(linear, body, i))
        };
        DOFS.iter().enumerate().map(one).collect()
    }
}

fn push(table: &mut Table, row: Vec<Cell>) {
    let fits = table.push(row);
    debug_assert!(fits.is_ok(), "a row must fit its table");
}

/// The dimension of a derivative.
fn derived(dim: Dim, derivative: Derivative) -> Dim {
    match (dim, derivative) {
        (Dim::Length, Derivative::Velocity) => Dim::Velocity,
        (Dim::Length, Derivative::Acceleration) => Dim::Acceleration,
        (Dim::Angle, Derivative::Velocity) => Dim::AngularVelocity,
        (Dim::Angle, Derivative::Acceleration) => Dim::AngularAcceleration,
        (dim, _) => dim,
    }
}

/// The dimension of its density over frequency; angles have one of their own only without a derivative.
fn density(dim: Dim, derivative: Derivative) -> Dim {
    match dim {
        Dim::Length if derivative == Derivative::Place => Dim::SpectralDensity,
        Dim::Length => {
            Dim::Derived { force: 0, length: 2, seconds: if derivative == Derivative::Velocity { -1 } else { -3 } }
        }
        Dim::Angle => Dim::AngleDensity,
        Dim::Force => Dim::Derived { force: 2, length: 0, seconds: 1 },
        other => other,
    }
}

/// Amplitudes and phases of quantities in waves of an amplitude (m), by heading and period.
pub fn operators(
    title: String,
    (linear, operators): (&Linear, &Operators),
    list: &[Told],
    (derivative, amplitude): (Derivative, f64),
) -> Table {
    let mut table = Table::new(title)
        .fact("Wave Amplitude", amplitude, Dim::Length)
        .column("", "Heading", Dim::Angle, Digits::Usual)
        .column("", "Period", Dim::Time, Digits::Usual)
        .column("", "Frequency", Dim::Frequency, Digits::Usual);
    for told in list {
        table = table
            .column(&told.name, &format!("{} Amp", told.name), derived(told.dim, derivative), Digits::Scientific(5))
            .column(&told.name, &format!("{} Phase", told.name), Dim::Angle, Digits::Usual);
    }
    for (heading, frequency, motions) in operators.each() {
        let mut row: Vec<Cell> = vec![heading.into(), (TAU / frequency).into(), frequency.into()];
        for told in list {
            let value = told.quantity.of(motions, frequency, derivative) * amplitude;
            let phase = if value.norm() > 0.0 { Cell::from(value.arg()) } else { Cell::Missing };
            row.extend([value.norm().into(), phase]);
        }
        push(&mut table, row);
    }
    table.note("heading is where the waves come from; phase is the lag behind the crest at the global origin");
    linear.notes.iter().for_each(|n| table.note(n.clone()));
    table
}

/// Spectra of quantities in a sea: its own density and theirs. Bands without a width, of regular waves, have none.
pub fn spectra(
    title: String,
    (linear, response): (&Linear, &Response),
    list: &[Told],
    derivative: Derivative,
) -> Table {
    let mut table = Table::new(title)
        .column("", "Frequency", Dim::Frequency, Digits::Usual)
        .column("", "Period", Dim::Time, Digits::Usual)
        .column("Density", "Wave", Dim::SpectralDensity, Digits::Usual);
    for told in list {
        table = table.column("Density", &told.name, density(told.dim, derivative), Digits::Scientific(5));
    }
    let slow = response.slow.iter().map(|p| (p, false));
    let bands: Vec<(&Point, bool)> = slow.chain(response.waves.iter().map(|p| (p, true))).collect();
    for (point, waves) in bands {
        let Some(width) = point.width else { continue };
        let wave = if waves { Cell::from(point.energy / width) } else { Cell::Missing };
        let mut row: Vec<Cell> = vec![point.frequency.into(), (TAU / point.frequency).into(), wave];
        row.extend(list.iter().map(|t| Cell::from(point.variance(&t.quantity, derivative) / width)));
        push(&mut table, row);
    }
    notes(&mut table, linear, response);
    table
}

fn notes(table: &mut Table, linear: &Linear, response: &Response) {
    if !response.slow.is_empty() {
        table.note("slow drift by Newman's approximation stands below the frequencies of the waves");
    }
    if response.rounds > 0 {
        table.note(format!("damping that is not linear is linearised in this sea, in {} rounds", response.rounds));
    }
    linear.notes.iter().for_each(|n| table.note(n.clone()));
}

/// The columns of statistics.
fn statistic_columns(mut table: Table, group: &str, prefix: &str, dim: Dim) -> Table {
    for (name, dim) in [
        ("Mean", dim),
        ("RMS Wave", dim),
        ("RMS Slow", dim),
        ("RMS", dim),
        ("Signif.", dim),
        ("Maximum", dim),
        ("Tz", Dim::Time),
    ] {
        table = table.column(group, &format!("{prefix}{name}"), dim, Digits::Usual);
    }
    table
}

/// A table of statistics that says what its maxima are.
fn titled(title: String, extreme: Extreme) -> Table {
    let table = Table::new(title);
    match extreme {
        Extreme::MostProbable(duration) => table.fact("Duration", duration, Dim::Time),
        Extreme::Times(factor) => table.fact("Maximum over RMS", factor, Dim::None),
        Extreme::Exceeded(share) => table.fact("Share above Maximum", share, Dim::None),
    }
}

/// What the maxima are, in a note.
fn told_of(extreme: Extreme) -> &'static str {
    match extreme {
        Extreme::MostProbable(_) => "most probable maximum",
        Extreme::Times(_) | Extreme::Exceeded(_) => "maximum (by -PROBABILITY of the environment)",
    }
}

fn statistic_cells(made: &Statistics, extreme: Extreme) -> [Cell; 7] {
    [
        made.mean.into(),
        made.waves.into(),
        made.slow.into(),
        made.deviation.into(),
        made.significant().into(),
        made.extreme(extreme).into(),
        made.period.into(),
    ]
}

/// Statistics of quantities of one dimension, a row each. The maximum is the extreme asked for.
pub fn statistics(
    title: String,
    (linear, response): (&Linear, &Response),
    list: &[Told],
    (derivative, extreme): (Derivative, Extreme),
) -> Table {
    let dim = list.first().map_or(Dim::None, |t| derived(t.dim, derivative));
    let table = titled(title, extreme).column("", "Result", Dim::None, Digits::Usual);
    let mut table = statistic_columns(table, "", "", dim);
    for told in list {
        let made = Statistics::of(response, &told.quantity, derivative);
        let mut row = vec![Cell::from(told.name.as_str())];
        row.extend(statistic_cells(&made, extreme));
        push(&mut table, row);
    }
    let told = told_of(extreme);
    table.note(format!("significant and {told} are amplitudes about the mean; Tz is of both, waves and slow drift"));
    notes(&mut table, linear, response);
    table
}

/// Statistics of the six degrees of freedom of a body: along each axis, and about it.
pub fn body_statistics(
    title: String,
    (linear, response): (&Linear, &Response),
    body: usize,
    (derivative, extreme): (Derivative, Extreme),
) -> Table {
    let table = titled(title, extreme).column("", "Axis", Dim::None, Digits::Usual);
    let table = statistic_columns(table, "Translation", "", derived(Dim::Length, derivative));
    let mut table = statistic_columns(table, "Rotation", "R ", derived(Dim::Angle, derivative));
    for (axis, name) in ["X", "Y", "Z"].into_iter().enumerate() {
        let mut row = vec![Cell::from(name)];
        for dof in [axis, axis + 3] {
            let quantity = Quantity::dof(linear, body, dof);
            row.extend(statistic_cells(&Statistics::of(response, &quantity, derivative), extreme));
        }
        push(&mut table, row);
    }
    table.note(format!("significant and {} are amplitudes about the place at rest", told_of(extreme)));
    notes(&mut table, linear, response);
    table
}

/// Natural periods with damping ratios, and the shapes of the modes.
///
/// # Errors
/// As [`crate::modes`].
pub fn modes(linear: &Linear) -> Result<[Table; 2], SolveError> {
    let mut periods = Table::new("Natural Periods")
        .column("", "Mode", Dim::None, Digits::Usual)
        .column("", "Period", Dim::Time, Digits::Usual)
        .column("", "Frequency", Dim::Frequency, Digits::Usual)
        .column("Damping", "Ratio", Dim::None, Digits::Scientific(4))
        .column("Moves Most", "Body", Dim::None, Digits::Usual)
        .column("Moves Most", "Freedom", Dim::None, Digits::Usual);
    let mut shapes = Table::new("Mode Shapes").column("", "Mode", Dim::None, Digits::Usual).column(
        "",
        "Body",
        Dim::None,
        Digits::Usual,
    );
    for (i, name) in DOFS.into_iter().enumerate() {
        let group = if i < 3 { "Translation" } else { "Rotation" };
        shapes = shapes.column(group, name, Dim::None, Digits::Decimals(5));
    }
    let list = natural(linear)?;
    let largest = list.iter().map(|n| n.mode.eigenvalue.abs()).fold(0.0, f64::max);
    for (index, Natural { mode, damping, settled }) in list.into_iter().enumerate() {
        let period = mode.period.filter(|_| damping.is_some());
        let (body, dof) = (mode.most.0.as_str(), mode.most.1);
        let told = format!("mode {} of {body} in {dof}", index + 1);
        if is_unstable(mode.eigenvalue, largest) {
            periods.note(format!("warning: not stable: {told}"));
        }
        if !settled {
            periods.note(format!("warning: {told} finds no period that agrees with its added mass"));
        }
        let frequency = period.map(|t| TAU / t);
        push(
            &mut periods,
            vec![
                (index + 1).into(),
                period.into(),
                frequency.into(),
                damping.into(),
                Cell::from(body),
                Cell::from(dof),
            ],
        );
        for (number, node) in linear.system.nodes.iter().enumerate() {
            let mut row = vec![(index + 1).into(), Cell::from(node.name.as_str())];
            row.extend((0..6).map(|i| Cell::from(mode.shape.get(6 * number + i).copied())));
            push(&mut shapes, row);
        }
    }
    periods.note("periods are undamped, with added mass at the period of each mode; the ratio is to critical damping");
    shapes.note("largest motion 1; rotations in radians a metre");
    linear.notes.iter().for_each(|n| periods.note(n.clone()));
    Ok([periods, shapes])
}
