//! `&STATUS DATABASE`: the hydrodynamic databases of bodies.

use super::status::push;
use nalgebra::{Complex, Matrix6};
use std::f64::consts::TAU;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::database::Amplitudes;
use windlass_hydro::database::checks::MODES;
use windlass_hydro::database::radiation::Radiation;
use windlass_hydro::database::{DatabaseLookup, mean_drift};
use windlass_model::{AttachedDatabase, Body, DriftMethod, Model};

/// What is below this share of the largest of its kind is rounding.
const NOTHING: f64 = 1e-9;

/// One table of what the databases are, then those of each body: radiation, excitation or motions, drift.
pub(super) fn tables(model: &Model, fits: &dyn Fn(&str) -> bool) -> Vec<Table> {
    let mut whole = Table::new("Hydrodynamic Databases").column("", "Body", Dim::None, Digits::Usual).column(
        "",
        "Source",
        Dim::None,
        Digits::Usual,
    );
    for name in ["X", "Y", "Z"] {
        whole = whole.column("Reference", name, Dim::Length, Digits::Usual);
    }
    whole = whole
        .column("", "Depth", Dim::Length, Digits::Usual)
        .column("Frequencies", "Number", Dim::None, Digits::Usual)
        .column("Frequencies", "From", Dim::Frequency, Digits::Decimals(4))
        .column("Frequencies", "To", Dim::Frequency, Digits::Decimals(4))
        .column("", "Headings", Dim::None, Digits::Usual)
        .column("", "Memory", Dim::Time, Digits::Usual)
        .column("", "Drift", Dim::None, Digits::Usual);
    let mut tables = Vec::new();
    for (body, attached) in model.bodies.values().filter_map(|b| b.database.as_ref().map(|d| (b, d))) {
        if !fits(&body.name) {
            continue;
        }
        let data = &attached.data;
        let radiation = Radiation::of(data).ok().flatten();
        let memory = radiation.as_ref().map(|r| attached.memory.unwrap_or_else(|| r.memory()));
        let mut row: Vec<Cell> = vec![body.name.as_str().into(), data.source.as_str().into()];
        row.extend(data.reference.iter().map(|v| Cell::Number(*v)));
        row.extend([data.depth.into(), data.frequencies.len().into(), data.frequencies.first().copied().into()]);
        row.extend([data.frequencies.last().copied().into(), data.headings.len().into(), memory.into()]);
        row.push(drift_word(attached).into());
        push(&mut whole, row);
        data.remarks.iter().for_each(|text| whole.note(format!("{}: {text}", body.name)));
        if let Some(stray) = radiation.as_ref().and_then(|r| r.estimated) {
            let text = format!("{}: added mass at infinite frequency by Ogilvie's relation", body.name);
            whole.note(format!("{text}; frequencies stray from it by {:.1} %", 100.0 * stray));
        }
        tables.extend(radiation.map(|r| radiated(body, attached, &r)));
        let by_wave = |title: &str, table: &[Vec<Amplitudes>], dims: [Dim; 2]| {
            amplitudes(format!("{title} of {}", body.name), (&data.headings, &data.frequencies), table, dims)
        };
        if !data.excitation.is_empty() {
            tables.push(by_wave("Excitation", &data.excitation, [Dim::ForcePerLength, Dim::Force]));
        }
        tables.extend(data.motions.iter().map(|m| by_wave("Motions", m, [Dim::None, Dim::None])));
        tables.extend(drift(body, attached));
    }
    std::iter::once(whole).chain(tables).collect()
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
fn radiated(body: &Body, attached: &AttachedDatabase, radiation: &Radiation) -> Table {
    let mut table = Table::new(format!("Radiation of {}", body.name))
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4))
        .column("", "Period", Dim::Time, Digits::Decimals(3));
    for group in ["Added Mass, SI", "Damping, SI"] {
        for name in MODES {
            table = table.column(group, name, Dim::None, Digits::Scientific(4));
        }
    }
    let data = &attached.data;
    for w in &data.frequencies {
        let (Some(added), Some(damping)) = (data.added_mass_at(*w), data.damping_at(*w)) else { continue };
        let mut row: Vec<Cell> = vec![(*w).into(), (TAU / w).into()];
        row.extend(diagonal(&added).chain(diagonal(&damping)));
        push(&mut table, row);
    }
    let mut row: Vec<Cell> = vec!["infinite".into(), 0.0.into()];
    row.extend(diagonal(&radiation.infinite).chain((0..6).map(|_| Cell::Missing)));
    push(&mut table, row);
    table.note("diagonals, about the body's origin; kg, kg m2, N s/m, N m s");
    table
}

/// The diagonal of a matrix, without what rounding leaves.
fn diagonal(matrix: &Matrix6<f64>) -> impl Iterator<Item = Cell> {
    let largest = matrix.diagonal().amax();
    let values = matrix.diagonal().map(|v| if v.abs() > NOTHING * largest { v } else { 0.0 });
    (0..6).map(move |i| Cell::Number(values[i]))
}

/// Amplitudes and phases by heading and frequency, as they were read.
fn amplitudes(
    title: String,
    (headings, frequencies): (&[f64], &[f64]),
    values: &[Vec<Amplitudes>],
    [force, moment]: [Dim; 2],
) -> Table {
    let mut table = Table::new(title)
        .column("", "Heading", Dim::Angle, Digits::Usual)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4))
        .column("", "Period", Dim::Time, Digits::Decimals(3));
    for (n, name) in MODES.iter().enumerate() {
        let dim = if n < 3 { force } else { moment };
        table = table.column("Amplitude", name, dim, Digits::Scientific(4));
    }
    for name in MODES {
        table = table.column("Lag behind Crest", name, Dim::Angle, Digits::Usual);
    }
    for (heading, of_heading) in headings.iter().zip(values) {
        for (w, six) in frequencies.iter().zip(of_heading) {
            let mut row: Vec<Cell> = vec![(*heading).into(), (*w).into(), (TAU / w).into()];
            let largest = six.iter().map(|x| x.norm()).fold(0.0, f64::max);
            // what is nothing but rounding has no phase
            let sound = |x: &Complex<f64>| x.norm() > NOTHING * largest;
            row.extend(six.iter().map(|x| Cell::Number(if sound(x) { x.norm() } else { 0.0 })));
            row.extend(six.iter().map(|x| Cell::from(sound(x).then(|| x.arg()))));
            push(&mut table, row);
        }
    }
    table.note("about the reference point, over wave amplitude; headings are where waves travel toward in the body");
    table
}

/// Mean drift over the square of the wave amplitude.
fn drift(body: &Body, attached: &AttachedDatabase) -> Option<Table> {
    let data = &attached.data;
    let drift = data.drift.clone().or_else(|| data.qtf.as_ref().map(mean_drift))?;
    let mut table = Table::new(format!("Mean Drift of {}", body.name))
        .column("", "Heading", Dim::Angle, Digits::Usual)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4))
        .column("", "Period", Dim::Time, Digits::Decimals(3));
    for name in MODES {
        table = table.column("Over Amplitude^2, SI", name, Dim::None, Digits::Scientific(4));
    }
    for (heading, of_heading) in drift.headings.iter().zip(&drift.values) {
        for (w, six) in drift.frequencies.iter().zip(of_heading) {
            let mut row: Vec<Cell> = vec![(*heading).into(), (*w).into(), (TAU / w).into()];
            row.extend(six.map(Cell::Number));
            push(&mut table, row);
        }
    }
    table.note("N/m2 and N/m, about the reference point; headings are where waves travel toward in the body");
    Some(table)
}
