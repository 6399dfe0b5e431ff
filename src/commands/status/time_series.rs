//! `&STATUS SEA_TSERIES` and `&STATUS WIND_TSERIES`: wave elevation and wind speed over the time of `-TIME`, as TDOM has them.

use crate::commands::Job;
use crate::commands::status::kind::{Query, StatusKind};
use crate::commands::status::sea_table::{chosen_environments, phasing, sea, title};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::variation::Variation;
use windlass_hydro::wind::WindField;
use windlass_model::{EntityKind, Environment};

/// `&STATUS SEA_TSERIES`.
pub static SEA_TSERIES: StatusKind = StatusKind::new(
    "SEA_TSERIES",
    "the wave elevation at X = Y = 0 over the time of -TIME, as TDOM has it",
    |query, _| series(query, elevations),
)
.with_names(&[EntityKind::Environment])
.plotted(|_, tables| Ok(tables.to_vec()))
.of_moses();

/// `&STATUS WIND_TSERIES`.
pub static WIND_TSERIES: StatusKind = StatusKind::new(
    "WIND_TSERIES",
    "the speed of the wind 10 m above the water over the time of -TIME, as TDOM has it",
    |query, _| series(query, wind_speeds),
)
.with_names(&[EntityKind::Environment])
.plotted(|_, tables| Ok(tables.to_vec()))
.of_moses();

/// Height of the wind speed of `-WIND` (m).
const WIND_HEIGHT_M: f64 = 10.0;
/// Most rows of a table: a day in steps of a tenth of a second.
const MAX_ROWS: f64 = 864_000.0;

/// A table of the environment in force, or of each kept under a name that is chosen.
fn series(query: &Query, build: fn(&Job, &Environment, Vec<f64>, Span) -> Outcome<Table>) -> Outcome<Vec<Table>> {
    let (job, at) = (query.job, query.position());
    let fits = query.fits();
    let chosen: Option<&dyn Fn(&str) -> bool> = query.is_named().then_some(&fits);
    chosen_environments(job, chosen)
        .into_iter()
        .map(|env| times(env, at).and_then(|times| build(job, env, times, at)))
        .collect()
}

/// The times of `-TIME`, from zero.
fn times(env: &Environment, at: Span) -> Outcome<Vec<f64>> {
    let Some(window) = env.time else {
        return Err(Diagnostic::error("the environment has no time", at).help("&ENV NAME -TIME TOBSERV DELTA_TIME"));
    };
    let steps = (window.observed / window.step).round();
    if steps >= MAX_ROWS {
        let text = format!("{steps:.0} rows are more than {MAX_ROWS:.0}");
        return Err(
            Diagnostic::error(text, at).help("&ENV NAME -TIME TOBSERV DELTA_TIME: a longer step, or a shorter time")
        );
    }
    let mut list = vec![0.0];
    while list.len() as f64 <= steps {
        list.push(list.len() as f64 * window.step);
    }
    Ok(list)
}

fn elevations(job: &Job, env: &Environment, times: Vec<f64>, at: Span) -> Outcome<Table> {
    let sea = sea(job, env, at)?;
    let mut table = Table::new(title("Wave Elevation", env, None));
    match &sea {
        Some(sea) => {
            let ramp = env.ramp.unwrap_or(job.model.defaults.ramp);
            table = table.fact("Phases", phasing(sea), Dim::None).fact("Ramp", ramp, Dim::Time);
        }
        None => table.note("there are no waves: -SEA of &ENV gives them"),
    }
    Ok(table
        .with_rows(&times)
        .column("", "Time", Dim::Time, Digits::Usual, |time| *time)
        .column("", "Elevation", Dim::Length, Digits::Usual, |time| {
            let elevation = sea.as_ref().map_or(0.0, |sea| sea.elevation(0.0, 0.0, *time));
            // what rounding leaves of a wave at its mean level
            if elevation.abs() < 1e-12 { 0.0 } else { elevation }
        })
        .build())
}

fn wind_speeds(job: &Job, env: &Environment, times: Vec<f64>, at: Span) -> Outcome<Table> {
    let to_diagnostic = |e: windlass_model::ClassError| e.diagnostic(at, job.units);
    let wind = WindField::from_environment(env).map_err(to_diagnostic)?;
    let variation = Variation::new(&job.model, env).map_err(to_diagnostic)?;
    let mut table = Table::new(title("Wind Speed", env, None));
    match &wind {
        Some(wind) => {
            let ramp = env.ramp.unwrap_or(job.model.defaults.ramp);
            table = table.fact("Mean Speed at 10 m", wind.speed, Dim::WindSpeed).fact("Ramp", ramp, Dim::Time);
        }
        None => table.note("there is no wind: -WIND of &ENV gives it"),
    }
    let mean = wind.map_or(0.0, |wind| wind.speed(WIND_HEIGHT_M).0);
    let speed = |time: &f64| {
        let varied = variation.as_ref().map(|variation| variation.sample(*time));
        mean + varied.map_or(0.0, |varied| varied.wind + varied.gust)
    };
    Ok(table
        .with_rows(&times)
        .column("", "Time", Dim::Time, Digits::Usual, |time| *time)
        .column("", "Speed", Dim::WindSpeed, Digits::Usual, speed)
        .build())
}
