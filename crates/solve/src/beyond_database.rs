//! Waves at periods that a database does not have: what stands for them is said.

use std::f64::consts::TAU;
use windlass_hydro::steady::Steady;
use windlass_model::{Body, ClassError, Database, Model};

/// Share of the energy of a sea in waves longer than those of a database that is let pass: the forces of its longest period stand for theirs.
const LONG_SHARE: f64 = 0.01;
/// The same of shorter waves, whose forces are taken to fall with the period.
const SHORT_SHARE: f64 = 0.1;
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

/// Warnings of the sea of a model: bodies whose databases lack the periods of much of its energy.
///
/// # Errors
/// Waves that cannot be computed.
pub fn warnings_of_sea(model: &Model) -> Result<Vec<String>, ClassError> {
    let steady = Steady::new(model)?;
    let waves = || steady.waves.iter().flat_map(|(_, waves)| &waves.energies);
    let whole: f64 = waves().map(|(_, energy)| energy).sum();
    let of_body = |body: &Body| {
        let range = range(body)?;
        let share = |is_beyond: &dyn Fn(f64) -> bool| {
            waves().filter(|(frequency, _)| is_beyond(*frequency)).map(|(_, energy)| energy).sum::<f64>() / whole
        };
        let (long, short) = (share(&|w| is_longer(w, range)), share(&|w| is_shorter(w, range)));
        let percent = |share: f64| format!("{:.0} % of the energy of the sea", 100.0 * share);
        let of_long = (long > LONG_SHARE)
            .then(|| format!("{} is in longer waves, for which the forces of its longest period stand", percent(long)));
        let of_short = (short > SHORT_SHARE)
            .then(|| format!("{} is in shorter waves, whose forces are taken to fall with the period", percent(short)));
        let parts: Vec<String> = of_long.into_iter().chain(of_short).collect();
        (!parts.is_empty())
            .then(|| format!("the database of {} has periods of {}: {}", body.name, periods(range), parts.join("; ")))
    };
    Ok(model.bodies.values().filter(|_| whole > 0.0).filter_map(of_body).collect())
}

/// Warnings of frequencies that are asked for (rad/s): bodies whose databases end before them.
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
    model.bodies.values().filter_map(of_body).collect()
}
