//! `&STATUS WIND_SPECTRUM`: the components of the gusts of an environment, and their spectrum to plot.

use crate::commands::Job;
use crate::commands::status::kind::StatusKind;
use crate::commands::status::sea_table::{chosen_environments, turn};
use std::f64::consts::TAU;
use windlass_base::diagnostic::Outcome;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::gusts::{DENSITY, Gusts};
use windlass_model::EntityKind;
use windlass_model::Environment;

/// `&STATUS WIND_SPECTRUM`.
pub static WIND_SPECTRUM: StatusKind = StatusKind::new(
    "WIND_SPECTRUM",
    "the components of the gusts of an environment, and with -PLOT their spectrum",
    |query, _| spectra(query.job, query.is_named().then_some(&query.fits()), query.position()),
)
.with_names(&[EntityKind::Environment])
.plotted(|query, _| densities(query.job, query.is_named().then_some(&query.fits()), query.position()));

/// Points of a spectrum plotted, and the share of the energy up to which they lie.
const SPECTRUM_POINTS: usize = 241;
const ENERGY_SHARE: f64 = 0.8;

/// The gusts of the environment in force, or of those kept under a name that is chosen.
pub(crate) fn spectra(job: &Job, chosen: Option<&dyn Fn(&str) -> bool>, at: Span) -> Outcome<Vec<Table>> {
    let mut tables = Vec::new();
    for env in chosen_environments(job, chosen) {
        match gusts(job, env, at)? {
            Some(gusts) => tables.push(components(job, env, &gusts)),
            None => {
                let mut table = Table::new(title("Gusts", env)).fact("Components", 0usize, Dim::None);
                table.note("there are no gusts: -WIND and -W_SPECTRUM of &ENV give them");
                tables.push(table);
            }
        }
    }
    Ok(tables)
}

/// The spectra as density over frequency, a table for each plot.
pub(crate) fn densities(job: &Job, chosen: Option<&dyn Fn(&str) -> bool>, at: Span) -> Outcome<Vec<Table>> {
    let mut tables = Vec::new();
    for env in chosen_environments(job, chosen) {
        tables.extend(gusts(job, env, at)?.map(|gusts| density(env, &gusts)));
    }
    Ok(tables)
}

/// Gusts in `&STATUS ENVIRONMENT`.
pub(crate) fn facts(table: Table, gusts: &Gusts) -> Table {
    let deviation = gusts.deviation();
    table
        .fact("Gust Spectrum", gusts.name.as_str(), Dim::None)
        .fact("   standard deviation", deviation, Dim::WindSpeed)
        .fact("   turbulence intensity", deviation / gusts.mean, Dim::None)
        .fact("   components", gusts.bands.len(), Dim::None)
        .fact("   seed", gusts.seed.to_string(), Dim::None)
}

/// Those of an environment; `None` where it has none.
///
/// # Errors
/// A spectrum that cannot be made.
pub(crate) fn gusts(job: &Job, env: &Environment, at: Span) -> Outcome<Option<Gusts>> {
    Gusts::new(&job.model, env).map_err(|e| e.diagnostic(at, job.units))
}

fn title(what: &str, env: &Environment) -> String {
    if env.name.is_empty() { what.to_string() } else { format!("{what} of {}", env.name) }
}

fn components(job: &Job, env: &Environment, gusts: &Gusts) -> Table {
    let division = if env.gust_periods.is_empty() { "of equal energy" } else { "about the periods of -W_PERIOD" };
    let deviation = gusts.deviation();
    let bands: Vec<_> = gusts.bands.iter().zip(&gusts.phases).enumerate().collect();
    Table::new(title("Gusts", env))
        .fact("Spectrum", gusts.name.as_str(), Dim::None)
        .fact("Mean Speed at 10 m", gusts.mean, Dim::WindSpeed)
        .fact("Standard Deviation of Components", deviation, Dim::WindSpeed)
        .fact("Standard Deviation of All Frequencies", gusts.whole, Dim::WindSpeed)
        .fact("Turbulence Intensity", deviation / gusts.mean, Dim::None)
        .fact("Components", format!("{} {division}", gusts.bands.len()), Dim::None)
        .fact("Phases", format!("random, seed {}", gusts.seed), Dim::None)
        .fact("Ramp", env.ramp.unwrap_or(job.model.defaults.ramp), Dim::Time)
        .with_rows(&bands)
        .column("", "No.", Dim::None, Digits::Usual, |(index, _)| index + 1)
        .column("", "Period", Dim::Time, Digits::Decimals(3), |(_, (band, _))| TAU / band.frequency)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(5), |(_, (band, _))| band.frequency)
        .column("", "Amplitude", Dim::WindSpeed, Digits::Decimals(3), |(_, (band, _))| (2.0 * band.energy).sqrt())
        .column("", "Phase", Dim::Angle, Digits::Usual, |(_, (_, phase))| turn(**phase))
        .column("", "Density", DENSITY, Digits::Decimals(3), |(_, (band, _))| gusts.spectrum.density(band.frequency))
        .column("Stands For", "From", Dim::Frequency, Digits::Decimals(5), |(_, (band, _))| band.low)
        .column("Stands For", "To", Dim::Frequency, Digits::Decimals(5), |(_, (band, _))| {
            Some(band.high).filter(|high| high.is_finite())
        })
        .column("Stands For", "Mean Density", DENSITY, Digits::Decimals(3), |(_, (band, _))| band.mean_density())
        .build()
}

fn density(env: &Environment, gusts: &Gusts) -> Table {
    let high = gusts.spectrum.quantile(ENERGY_SHARE);
    let low = gusts.spectrum.range()[0].max(1e-3 * high);
    // close where it is steep
    let frequencies: Vec<f64> =
        (0..SPECTRUM_POINTS).map(|i| low * (high / low).powf(i as f64 / (SPECTRUM_POINTS - 1) as f64)).collect();
    Table::new(title("Gust Spectrum", env))
        .with_rows(&frequencies)
        .column("", "Frequency", Dim::Frequency, Digits::Usual, |frequency| *frequency)
        .column("", "Density", DENSITY, Digits::Usual, |frequency| gusts.spectrum.density(*frequency))
        .build()
}
