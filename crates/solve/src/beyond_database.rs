//! Waves at periods that a database does not have, and bodies that float otherwise than their databases had them: what stands for them is said.

use std::f64::consts::TAU;
use windlass_hydro::steady::Steady;
use windlass_model::{Body, ClassError, Database, DriftMethod, Model};

/// Share of the energy of a sea in waves longer than those of a database that is let pass: the forces of its longest period stand for theirs.
const LONG_SHARE: f64 = 0.01;
/// The same of shorter waves, whose forces are taken to fall with the period.
const SHORT_SHARE: f64 = 0.1;
/// The same of mean drift, which is small in longer waves, and goes to a limit in shorter ones.
const DRIFT_LONG_SHARE: f64 = 0.05;
const DRIFT_SHORT_SHARE: f64 = 0.2;
/// A frequency is one of a database to this share.
const SAME_SHARE: f64 = 1e-6;

/// First and last frequency of the wave forces of a body's database (rad/s).
fn range(body: &Body) -> Option<[f64; 2]> {
    let data: &Database = body.database.as_ref()?.data.as_ref();
    let ends = [*data.frequencies.first()?, *data.frequencies.last()?];
    (!data.excitation.is_empty()).then_some(ends)
}

fn is_longer(frequency: f64, [first, _]: [f64; 2]) -> bool {
    frequency < first * (1.0 - SAME_SHARE)
}

fn is_shorter(frequency: f64, [_, last]: [f64; 2]) -> bool {
    frequency > last * (1.0 + SAME_SHARE)
}

fn periods([first, last]: [f64; 2]) -> String {
    if first == last {
        format!("{:.2} s alone", TAU / first)
    } else {
        format!("{:.2} to {:.2} s", TAU / last, TAU / first)
    }
}

/// The shares of the energy of a sea in waves longer, and in waves shorter, than those of a range.
fn shares_beyond(sea: &Steady, range: [f64; 2]) -> [f64; 2] {
    let waves = || sea.waves.iter().flat_map(|(_, waves)| &waves.energies);
    let energy = |is_counted: &dyn Fn(f64) -> bool| -> f64 {
        waves().filter(|(frequency, _)| is_counted(*frequency)).map(|(_, energy)| energy).sum()
    };
    let whole = energy(&|_| true);
    let share = |is_beyond: &dyn Fn(f64) -> bool| if whole > 0.0 { energy(is_beyond) / whole } else { 0.0 };
    [share(&|w| is_longer(w, range)), share(&|w| is_shorter(w, range))]
}

/// A share of the energy of the sea where it is more than is let pass, with what is said of it.
fn said(share: f64, let_pass: f64, what: &str) -> Option<String> {
    (share > let_pass).then(|| format!("{:.0} % of the energy of the sea is in {what}", 100.0 * share))
}

/// A sentence of what is said of a body.
fn sentence(of: &str, range: [f64; 2], parts: [Option<String>; 2]) -> Option<String> {
    let parts: Vec<String> = parts.into_iter().flatten().collect();
    (!parts.is_empty()).then(|| format!("{of} has periods of {}: {}", periods(range), parts.join("; ")))
}

/// Warnings of the sea of a model: bodies that are not those of their databases, and whose databases lack the periods of much of its energy.
///
/// # Errors
/// Waves that cannot be computed.
pub fn warnings_of_sea(model: &Model) -> Result<Vec<String>, ClassError> {
    let sea = Steady::new(model)?;
    let of_body = |body: &Body| {
        let range = range(body)?;
        let [long, short] = shares_beyond(&sea, range);
        let parts = [
            said(long, LONG_SHARE, "longer waves, for which the forces of its longest period stand"),
            said(short, SHORT_SHARE, "shorter waves, whose forces are taken to fall with the period"),
        ];
        sentence(&format!("the database of {}", body.name), range, parts)
    };
    Ok(model.stance_warnings().into_iter().chain(model.bodies.values().filter_map(of_body)).collect())
}

/// The same of the mean drift that databases give.
///
/// # Errors
/// Waves that cannot be computed.
pub fn warnings_of_mean_drift(model: &Model) -> Result<Vec<String>, ClassError> {
    let sea = Steady::new(model)?;
    let of_body = |body: &Body| {
        let attached = body.database.as_ref().filter(|attached| attached.drift != DriftMethod::None)?;
        let drift = attached.data.drift.as_ref()?;
        let range = [*drift.frequencies.first()?, *drift.frequencies.last()?];
        let [long, short] = shares_beyond(&sea, range);
        let parts = [
            said(long, DRIFT_LONG_SHARE, "longer waves, for which the drift of its longest period stands"),
            said(short, DRIFT_SHORT_SHARE, "shorter waves, for which the drift of its shortest period stands"),
        ];
        sentence(&format!("the mean drift of {} in its database", body.name), range, parts)
    };
    // in calm water no database acts
    let of_bodies = if sea.waves.is_empty() { Vec::new() } else { model.stance_warnings() };
    Ok(of_bodies.into_iter().chain(model.bodies.values().filter_map(of_body)).collect())
}

/// Warnings of frequencies that are asked for (rad/s): bodies that are not those of their databases, and whose databases end before them.
pub fn warnings_of_frequencies(model: &Model, frequencies: &[f64]) -> Vec<String> {
    let of_body = |body: &Body| {
        let range = range(body)?;
        let beyond: Vec<String> = frequencies
            .iter()
            .filter(|w| is_longer(**w, range) || is_shorter(**w, range))
            .map(|w| format!("{:.2}", TAU / w))
            .collect();
        let (first, count) = (beyond.first()?, beyond.len());
        let named =
            if count == 1 { format!("that of {first} s") } else { format!("{count} periods, the first of {first} s,") };
        let are = if count == 1 { "is" } else { "are" };
        Some(format!(
            "the database of {} has periods of {}: {named} {are} outside of it. Forces of longer waves are those of its longest period, those of shorter ones fall with the period",
            body.name,
            periods(range)
        ))
    };
    model.stance_warnings().into_iter().chain(model.bodies.values().filter_map(of_body)).collect()
}
