//! The frequency domain as tables.

use super::linear::LinearSystem;
use super::natural::{Natural, natural};
use super::operators::{Operator, Operators};
use super::quantity::{Derivative, LinearQuantity};
use super::response::{FrequencyResponse, ResponsePoint};
use super::statistics::{ExtremeKind, ResponseStatistics};
use crate::equilibrium::is_unstable;
use crate::system::{DOFS, SolveError, SystemBody};
use nalgebra::Complex;
use std::f64::consts::TAU;
use windlass_base::table::{Digits, Table, TableBuilder, TableNote};
use windlass_base::units::Dim;
use windlass_hydro::database::slow_drift::remark_on_depth;

/// A quantity with its name and what it measures.
#[derive(Clone, Debug, PartialEq)]
pub struct NamedQuantity {
    /// Its name: `X`, `L1`.
    pub name: String,
    /// Its dimension, before any derivative.
    pub dim: Dim,
    /// Itself.
    pub quantity: LinearQuantity,
}

impl NamedQuantity {
    /// A quantity to be reported.
    pub fn new(name: impl Into<String>, dim: Dim, quantity: LinearQuantity) -> Self {
        NamedQuantity { name: name.into(), dim, quantity }
    }

    /// The six degrees of freedom of a body's origin.
    pub fn dofs(linear: &LinearSystem, body: usize) -> Vec<Self> {
        let one = |(i, name): (usize, &&str)| {
            let dim = if i < 3 { Dim::Length } else { Dim::Angle };
            NamedQuantity::new(*name, dim, LinearQuantity::dof(linear, body, i))
        };
        DOFS.iter().enumerate().map(one).collect()
    }
}

/// A response with the equations it was found with.
#[derive(Clone, Copy, Debug)]
pub struct SolvedResponse<'a> {
    /// The equations.
    pub linear: &'a LinearSystem,
    /// The motions.
    pub response: &'a FrequencyResponse,
}

/// Which statistics a table has.
#[derive(Clone, Copy, Debug)]
pub struct StatisticsRequest {
    /// Of the quantities themselves, their rates or accelerations.
    pub derivative: Derivative,
    /// The amplitude that is reported as the extreme.
    pub extreme: ExtremeKind,
}

/// The dimension of a derivative.
fn derivative_dimension(dim: Dim, derivative: Derivative) -> Dim {
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
        Dim::Moment => Dim::Derived { force: 2, length: 2, seconds: 1 },
        other => other,
    }
}

/// Amplitudes and phases of quantities in waves of an amplitude (m), by heading and period.
pub fn operators(
    title: String,
    linear: &LinearSystem,
    operators: &Operators,
    list: &[NamedQuantity],
    derivative: Derivative,
    amplitude: f64,
) -> Table {
    let rows: Vec<_> = operators.operators().collect();
    let mut table = Table::new(title)
        .fact("Wave Amplitude", amplitude, Dim::Length)
        .with_rows(&rows)
        .column("", "Heading", Dim::Angle, Digits::Usual, |row| row.heading)
        .column("", "Period", Dim::Time, Digits::Usual, |row| TAU / row.frequency)
        .column("", "Frequency", Dim::Frequency, Digits::Usual, |row| row.frequency);
    if linear.sails() {
        table = table.column("", "Encounter", Dim::Time, Digits::Usual, |row| TAU / row.encounter.abs());
    }
    for NamedQuantity { name, dim, quantity } in list {
        let value = |row: &Operator| quantity.amplitude(row.motions, row.encounter, derivative) * amplitude;
        table = table
            .column(
                name,
                &format!("{name} Amp"),
                derivative_dimension(*dim, derivative),
                Digits::Scientific(5),
                |row| value(row).norm(),
            )
            .column(name, &format!("{name} Phase"), Dim::Angle, Digits::Usual, |row| {
                // where a wave is overtaken its amplitude turns the other way
                let lag = |v: Complex<f64>| if row.encounter < 0.0 { -v.arg() } else { v.arg() };
                Some(value(row)).filter(|v| v.norm() > 0.0).map(lag)
            });
    }
    let mut table = table.build();
    table.note("heading is where the waves come from; phase is the lag behind the crest at the global origin");
    if linear.sails() {
        table.note("Encounter is the period at which the bodies meet the waves: that of the motions");
    }
    linear.notes.iter().for_each(|n| table.note(n.clone()));
    table
}

/// Spectra of quantities in a sea: its own density and theirs. Bands without a width, of regular waves, have none.
pub fn spectra(
    title: String,
    SolvedResponse { linear, response }: SolvedResponse,
    list: &[NamedQuantity],
    derivative: Derivative,
) -> Table {
    let slow = response.slow.iter().map(|p| (p, false));
    let bands = slow.chain(response.waves.iter().map(|p| (p, true)));
    let rows: Vec<(&ResponsePoint, bool, f64)> =
        bands.filter_map(|(point, is_wave)| Some((point, is_wave, point.width?))).collect();
    let mut table = Table::new(title)
        .with_rows(&rows)
        .column("", "Frequency", Dim::Frequency, Digits::Usual, |(point, ..)| point.frequency)
        .column("", "Period", Dim::Time, Digits::Usual, |(point, ..)| TAU / point.frequency)
        .column("Density", "Wave", Dim::SpectralDensity, Digits::Usual, |(point, is_wave, width)| {
            is_wave.then_some(point.energy / width)
        });
    for NamedQuantity { name, dim, quantity } in list {
        let dim = density(*dim, derivative);
        table = table.column("Density", name, dim, Digits::Scientific(5), |(point, _, width)| {
            point.variance(quantity, derivative) / width
        });
    }
    let mut table = table.build();
    notes(&mut table, linear, response);
    table
}

fn notes(table: &mut Table, linear: &LinearSystem, response: &FrequencyResponse) {
    if !response.slow.is_empty() {
        table.note("slow drift by Newman's approximation stands below the frequencies of the waves");
        let number = |point: &ResponsePoint| Some((point.energy, linear.wave_number(point.frequency).ok()?));
        let remark = remark_on_depth(response.waves.iter().filter_map(number), linear.depth);
        table.add_notes(remark.map(TableNote::warning));
    }
    if linear.sails() {
        table.note("frequencies and densities are those of the waves; Tz is that of the motions, which are met at the frequency of encounter");
    }
    if response.rounds > 0 {
        table.note(format!("damping that is not linear is linearised in this sea, in {} rounds", response.rounds));
    }
    linear.notes.iter().for_each(|n| table.note(n.clone()));
}

/// The columns of statistics, with the extreme asked for as the maximum.
fn statistic_columns<'r, R>(
    table: TableBuilder<'r, R>,
    (group, prefix): (&str, &str),
    (dim, extreme): (Dim, ExtremeKind),
    made: impl Fn(&'r R) -> &'r ResponseStatistics,
) -> TableBuilder<'r, R> {
    let named = |name: &str| format!("{prefix}{name}");
    table
        .column(group, &named("Mean"), dim, Digits::Usual, |row| made(row).mean)
        .column(group, &named("RMS Wave"), dim, Digits::Usual, |row| made(row).waves)
        .column(group, &named("RMS Slow"), dim, Digits::Usual, |row| made(row).slow)
        .column(group, &named("RMS"), dim, Digits::Usual, |row| made(row).deviation)
        .column(group, &named("Signif."), dim, Digits::Usual, |row| made(row).significant())
        .column(group, &named("Maximum"), dim, Digits::Usual, |row| made(row).extreme(extreme))
        .column(group, &named("Tz"), Dim::Time, Digits::Usual, |row| made(row).period)
}

/// A table of statistics that says what its maxima are.
fn statistics_table(title: String, extreme: ExtremeKind) -> Table {
    let table = Table::new(title);
    match extreme {
        ExtremeKind::MostProbable(duration) => table.fact("Duration", duration, Dim::Time),
        ExtremeKind::Times(factor) => table.fact("Maximum over RMS", factor, Dim::None),
        ExtremeKind::Exceeded(share) => table.fact("Share above Maximum", share, Dim::None),
    }
}

/// What the maxima are, in a note.
fn describe_extreme(extreme: ExtremeKind) -> &'static str {
    match extreme {
        ExtremeKind::MostProbable(_) => "most probable maximum",
        ExtremeKind::Times(_) | ExtremeKind::Exceeded(_) => "maximum (by -PROBABILITY of the environment)",
    }
}

/// Statistics of quantities of one dimension, a row each. The maximum is the extreme asked for.
pub fn statistics(
    title: String,
    SolvedResponse { linear, response }: SolvedResponse,
    list: &[NamedQuantity],
    StatisticsRequest { derivative, extreme }: StatisticsRequest,
) -> Table {
    let dim = list.first().map_or(Dim::None, |t| derivative_dimension(t.dim, derivative));
    let rows: Vec<(&str, ResponseStatistics)> = list
        .iter()
        .map(|row| (row.name.as_str(), ResponseStatistics::new(response, &row.quantity, derivative)))
        .collect();
    let table = statistics_table(title, extreme).with_rows(&rows).text("Result", |(name, _)| *name);
    let mut table = statistic_columns(table, ("", ""), (dim, extreme), |(_, made)| made).build();
    let extreme = describe_extreme(extreme);
    table.note(format!("significant and {extreme} are amplitudes about the mean; Tz is of both, waves and slow drift"));
    notes(&mut table, linear, response);
    table
}

/// Statistics of the six degrees of freedom of a body: along each axis, and about it.
pub fn body_statistics(
    title: String,
    SolvedResponse { linear, response }: SolvedResponse,
    body: usize,
    StatisticsRequest { derivative, extreme }: StatisticsRequest,
) -> Table {
    let of_dof = |dof: usize| ResponseStatistics::new(response, &LinearQuantity::dof(linear, body, dof), derivative);
    let rows: Vec<_> =
        ["X", "Y", "Z"].into_iter().enumerate().map(|(axis, name)| (name, of_dof(axis), of_dof(axis + 3))).collect();
    let [shift, turn] = [Dim::Length, Dim::Angle].map(|dim| (derivative_dimension(dim, derivative), extreme));
    let table = statistics_table(title, extreme).with_rows(&rows).text("Axis", |(name, ..)| *name);
    let table = statistic_columns(table, ("Translation", ""), shift, |(_, made, _)| made);
    let mut table = statistic_columns(table, ("Rotation", "R "), turn, |(.., made)| made).build();
    table.note(format!("significant and {} are amplitudes about the place at rest", describe_extreme(extreme)));
    notes(&mut table, linear, response);
    table
}

/// Statistics of a force and a moment along three axes.
pub fn load_statistics(
    title: String,
    SolvedResponse { linear, response }: SolvedResponse,
    list: &[LinearQuantity; 6],
    extreme: ExtremeKind,
) -> Table {
    let made = |quantity: &LinearQuantity| ResponseStatistics::new(response, quantity, Derivative::Place);
    let axes = ["X", "Y", "Z"].into_iter().zip(list.iter().zip(list.iter().skip(3)));
    let rows: Vec<_> = axes.map(|(name, (force, moment))| (name, made(force), made(moment))).collect();
    let table = statistics_table(title, extreme).with_rows(&rows).text("Axis", |(name, ..)| *name);
    let table = statistic_columns(table, ("Force", ""), (Dim::Force, extreme), |(_, made, _)| made);
    let mut table = statistic_columns(table, ("Moment", "M "), (Dim::Moment, extreme), |(.., made)| made).build();
    table.note(format!("significant and {} are amplitudes about the mean", describe_extreme(extreme)));
    notes(&mut table, linear, response);
    table
}

/// Natural periods with damping ratios, and the shapes of the modes.
///
/// # Errors
/// As [`crate::modes()`].
pub fn modes(linear: &LinearSystem) -> Result<[Table; 2], SolveError> {
    let mut periods = Table::new("Natural Periods");
    let list = natural(linear)?;
    let largest = list.iter().map(|n| n.mode.eigenvalue.abs()).fold(0.0, f64::max);
    for (index, Natural { mode, settled, .. }) in list.iter().enumerate() {
        let (body, dof) = (mode.most.0.as_str(), mode.most.1);
        let name = format!("mode {} of {body} in {dof}", index + 1);
        if is_unstable(mode.eigenvalue, largest) {
            periods.warn(format!("not stable: {name}"));
        }
        if !settled {
            periods.warn(format!("{name} finds no period that agrees with its added mass"));
        }
    }
    periods.note("periods are undamped, with added mass at the period of each mode; the ratio is to critical damping");
    if linear.has_drift_damping() {
        periods.note("damping has the wave drift damping of the sea of the environment");
    }
    linear.notes.iter().for_each(|n| periods.note(n.clone()));
    let period = |n: &Natural| n.mode.period.filter(|_| n.damping.is_some());
    let rows: Vec<(usize, &Natural)> = list.iter().enumerate().collect();
    let periods = periods
        .with_rows(&rows)
        .column("", "Mode", Dim::None, Digits::Usual, |(index, _)| index + 1)
        .column("", "Period", Dim::Time, Digits::Usual, |(_, n)| period(n))
        .column("", "Frequency", Dim::Frequency, Digits::Usual, |(_, n)| period(n).map(|t| TAU / t))
        .column("Damping", "Ratio", Dim::None, Digits::Scientific(4), |(_, n)| n.damping)
        .column("Moves Most", "Body", Dim::None, Digits::Usual, |(_, n)| &n.mode.most.0)
        .column("Moves Most", "DOF", Dim::None, Digits::Usual, |(_, n)| n.mode.most.1)
        .build();
    let nodes = linear.system.nodes.iter().enumerate();
    let of_mode = |(index, n)| nodes.clone().map(move |(number, node)| (index, n, number, node));
    let rows: Vec<(usize, &Natural, usize, &SystemBody)> = rows.iter().copied().flat_map(of_mode).collect();
    let [x, y, z, rx, ry, rz] = DOFS;
    let moves = |n: &Natural, first: usize| [0, 1, 2].map(|i| n.mode.shape.get(first + i).copied());
    let mut shapes = Table::new("Mode Shapes")
        .with_rows(&rows)
        .column("", "Mode", Dim::None, Digits::Usual, |(index, ..)| index + 1)
        .text("Body", |(.., node)| &node.name)
        .columns("Translation", [x, y, z], Dim::None, Digits::Decimals(5), |(_, n, number, _)| moves(n, 6 * number))
        .columns("Rotation", [rx, ry, rz], Dim::None, Digits::Decimals(5), |(_, n, number, _)| moves(n, 6 * number + 3))
        .build();
    shapes.note("largest motion 1; rotations in radians a metre");
    Ok([periods, shapes])
}
