//! `&STATUS DATABASE`: the hydrodynamic databases of bodies.

use crate::commands::status::kind::StatusKind;
use nalgebra::{Complex, Matrix6};
use std::f64::consts::TAU;
use windlass_base::table::{Cell, Digits, Table, TableBuilder};
use windlass_base::units::Dim;
use windlass_hydro::database::Amplitudes;
use windlass_hydro::database::checks::MODES;
use windlass_hydro::database::radiation::Radiation;
use windlass_hydro::database::{DatabaseLookup, mean_drift};
use windlass_model::EntityKind;
use windlass_model::{AttachedDatabase, Body, DriftMethod, Model};

/// `&STATUS DATABASE`.
pub static DATABASE: StatusKind = StatusKind::new(
    "DATABASE",
    "hydrodynamic databases of bodies: radiation, excitation, drift, memory",
    |query, _| Ok(tables(query.model(), &query.fits())),
)
.with_names(&[EntityKind::Body]);

/// What is below this share of the largest of its kind is rounding.
const ROUNDING_SHARE: f64 = 1e-9;

/// A body with its database, and the memory of its radiation where there is one.
type BodyDatabase<'m> = (&'m Body, &'m AttachedDatabase, Option<f64>);

/// One table of what the databases are, then those of each body: radiation, excitation or motions, drift.
pub(crate) fn tables(model: &Model, fits: &dyn Fn(&str) -> bool) -> Vec<Table> {
    let mut whole = Table::new("Hydrodynamic Databases");
    let mut rows: Vec<BodyDatabase> = Vec::new();
    let mut tables = Vec::new();
    for (body, attached) in model.bodies.values().filter_map(|b| b.database.as_ref().map(|d| (b, d))) {
        if !fits(&body.name) {
            continue;
        }
        let data = &attached.data;
        let radiation = Radiation::new(data);
        rows.push((body, attached, radiation.as_ref().map(|r| attached.memory.unwrap_or_else(|| r.memory()))));
        data.remarks.iter().for_each(|text| whole.note(format!("{}: {text}", body.name)));
        if let Some(radiation) = &radiation {
            whole.note(format!("{}: {}", body.name, radiation.quality.sentence(data.infinite.is_some()).0));
        }
        tables.extend(radiation.map(|r| radiation_table(body, attached, &r)));
        tables.extend(excitation(body, attached));
        tables.extend(data.motions.iter().map(|motions| {
            let title = format!("Motions of {}", body.name);
            amplitudes(title, (&data.headings, &data.frequencies), motions, [Dim::None, Dim::None])
        }));
        tables.extend(drift(body, attached));
    }
    let whole = whole
        .with_rows(&rows)
        .text("Body", |(body, ..)| &body.name)
        .text("Source", |(_, attached, _)| &attached.data.source)
        .columns("Reference", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, attached, _)| {
            <[f64; 3]>::from(attached.data.reference)
        })
        .column("", "Depth", Dim::Length, Digits::Usual, |(_, attached, _)| attached.data.depth)
        .column("Frequencies", "Number", Dim::None, Digits::Usual, |(_, attached, _)| attached.data.frequencies.len())
        .column("Frequencies", "From", Dim::Frequency, Digits::Decimals(4), |(_, attached, _)| {
            attached.data.frequencies.first().copied()
        })
        .column("Frequencies", "To", Dim::Frequency, Digits::Decimals(4), |(_, attached, _)| {
            attached.data.frequencies.last().copied()
        })
        .column("", "Headings", Dim::None, Digits::Usual, |(_, attached, _)| attached.data.headings.len())
        .column("", "Memory", Dim::Time, Digits::Usual, |(.., memory)| *memory)
        .text("Drift", |(_, attached, _)| drift_word(attached))
        .build();
    std::iter::once(whole).chain(tables).collect()
}

/// Exciting forces over wave amplitude.
pub(crate) fn excitation(body: &Body, attached: &AttachedDatabase) -> Option<Table> {
    let data = &attached.data;
    let title = format!("Excitation of {}", body.name);
    let axes = (data.headings.as_slice(), data.frequencies.as_slice());
    (!data.excitation.is_empty()).then(|| amplitudes(title, axes, &data.excitation, [Dim::ForcePerLength, Dim::Force]))
}

/// How slow drift is found.
fn drift_word(attached: &AttachedDatabase) -> &'static str {
    let data = &attached.data;
    match attached.drift {
        _ if data.drift.is_none() && data.qtf.is_none() => "none",
        DriftMethod::None => "none",
        DriftMethod::Mean => "mean",
        DriftMethod::Newman => "Newman",
        DriftMethod::Full => "QTF",
    }
}

/// Diagonals of added mass and damping by frequency, about the body's origin.
fn radiation_table(body: &Body, attached: &AttachedDatabase, radiation: &Radiation) -> Table {
    let data = &attached.data;
    let at = |w: f64| Some((Some(w), data.added_mass_at(w)?, Some(data.damping_at(w)?)));
    let zero = data.zero.and_then(|_| Some((Some(0.0), data.added_mass_at(0.0)?, None)));
    let mut rows: Vec<_> = zero.into_iter().chain(data.frequencies.iter().filter_map(|w| at(*w))).collect();
    rows.push((None, radiation.infinite, None));
    let mut table = Table::new(format!("Radiation of {}", body.name))
        .with_rows(&rows)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4), |(w, ..)| {
            w.map_or(Cell::from("infinite"), Cell::Number)
        })
        .column("", "Period", Dim::Time, Digits::Decimals(3), |(w, ..)| {
            w.map_or(Some(0.0), |w| Some(TAU / w).filter(|period| period.is_finite()))
        })
        .columns("Added Mass, SI", MODES, Dim::None, Digits::Scientific(4), |(_, added, _)| diagonal(added))
        .columns("Damping, SI", MODES, Dim::None, Digits::Scientific(4), |(.., damping)| {
            damping.as_ref().map_or([None; 6], |damping| diagonal(damping).map(Some))
        })
        .build();
    table.note("diagonals, about the body's origin; kg, kg m2, N s/m, N m s");
    table
}

/// The diagonal of a matrix, without what rounding leaves.
fn diagonal(matrix: &Matrix6<f64>) -> [f64; 6] {
    let largest = matrix.diagonal().amax();
    matrix.diagonal().map(|v| if v.abs() > ROUNDING_SHARE * largest { v } else { 0.0 }).into()
}

/// Values by heading and frequency as rows: the heading, the frequency, the values.
fn by_frequency<'d, V>(headings: &'d [f64], frequencies: &'d [f64], values: &'d [Vec<V>]) -> Vec<(f64, f64, &'d V)> {
    let by_heading = headings.iter().zip(values);
    by_heading
        .flat_map(|(heading, of_heading)| frequencies.iter().zip(of_heading).map(|(w, v)| (*heading, *w, v)))
        .collect()
}

/// The columns of heading, frequency and period.
fn wave_columns<V>(table: TableBuilder<'_, (f64, f64, V)>) -> TableBuilder<'_, (f64, f64, V)> {
    table
        .column("", "Heading", Dim::Angle, Digits::Usual, |(heading, ..)| *heading)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4), |(_, w, _)| *w)
        .column("", "Period", Dim::Time, Digits::Decimals(3), |(_, w, _)| TAU / w)
}

/// Amplitudes and phases by heading and frequency, as they were read.
fn amplitudes(
    title: String,
    (headings, frequencies): (&[f64], &[f64]),
    values: &[Vec<Amplitudes>],
    [force, moment]: [Dim; 2],
) -> Table {
    let rows = by_frequency(headings, frequencies, values);
    // what is nothing but rounding has no phase
    let sound = |six: &Amplitudes| {
        let largest = six.iter().map(|x| x.norm()).fold(0.0, f64::max);
        six.map(|x| Some(x).filter(|x| x.norm() > ROUNDING_SHARE * largest))
    };
    let size = |x: Option<Complex<f64>>| x.map_or(0.0, |x| x.norm());
    let [surge, sway, heave, roll, pitch, yaw] = MODES;
    let mut table = wave_columns(Table::new(title).with_rows(&rows))
        .columns("Amplitude", [surge, sway, heave], force, Digits::Scientific(4), |(.., six)| {
            let [x, y, z, ..] = sound(six);
            [x, y, z].map(size)
        })
        .columns("Amplitude", [roll, pitch, yaw], moment, Digits::Scientific(4), |(.., six)| {
            let [.., x, y, z] = sound(six);
            [x, y, z].map(size)
        })
        .columns("Lag behind Crest", MODES, Dim::Angle, Digits::Usual, |(.., six)| {
            sound(six).map(|x| x.map(|x| x.arg()))
        })
        .build();
    table.note("about the reference point, over wave amplitude; headings are where waves travel toward in the body");
    table
}

/// Mean drift over the square of the wave amplitude.
pub(crate) fn drift(body: &Body, attached: &AttachedDatabase) -> Option<Table> {
    let data = &attached.data;
    let drift = data.drift.clone().or_else(|| data.qtf.as_ref().map(mean_drift))?;
    let rows = by_frequency(&drift.headings, &drift.frequencies, &drift.values);
    let mut table = wave_columns(Table::new(format!("Mean Drift of {}", body.name)).with_rows(&rows))
        .columns("Over Amplitude^2, SI", MODES, Dim::None, Digits::Scientific(4), |(.., six)| **six)
        .build();
    table.note("N/m2 and N/m, about the reference point; headings are where waves travel toward in the body");
    Some(table)
}
