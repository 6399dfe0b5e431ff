//! `&STATUS SEA_SPECTRUM`: the wave components of the seas of an environment, and their spectra to plot.

use crate::commands::Job;
use crate::commands::status::kind::StatusKind;
use std::f64::consts::{PI, TAU};
use windlass_base::choice::Choice;
use windlass_base::diagnostic::Outcome;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::sea::{EnvironmentSea, Sea};
use windlass_model::EntityKind;
use windlass_model::{Division, Environment};

/// `&STATUS SEA_SPECTRUM`.
pub static SEA_SPECTRUM: StatusKind = StatusKind::new(
    "SEA_SPECTRUM",
    "the wave components of the seas of the environment in force, or of one kept under a name",
    |query, _| spectra(query.job, query.is_named().then_some(&query.fits()), query.position()),
)
.with_names(&[EntityKind::Environment])
.plotted(|query, _| densities(query.job, query.is_named().then_some(&query.fits()), query.position()))
.of_moses()
.also(&["SEA"]);

/// Points of a spectrum plotted, and the shares of the energy between which they lie.
const SPECTRUM_POINTS: usize = 241;
const ENERGY_SHARES: [f64; 2] = [1e-6, 0.997];

/// One table for each sea of the environment in force, or of those kept under a name that is chosen.
pub(crate) fn spectra(job: &Job, chosen: Option<&dyn Fn(&str) -> bool>, at: Span) -> Outcome<Vec<Table>> {
    let mut tables = Vec::new();
    for env in chosen_environments(job, chosen) {
        match sea(job, env, at)? {
            Some(sea) => tables.extend(sea.trains.iter().map(|train| components(env, &sea, train))),
            None => {
                let mut table = Table::new(title("Sea Spectrum", env, None)).fact("Components", 0usize, Dim::None);
                table.note("there are no waves: -SEA of &ENV gives them");
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
        let trains = sea(job, env, at)?.map_or(Vec::new(), |s| s.trains);
        tables.extend(trains.iter().filter_map(|t| density(env, t)));
    }
    Ok(tables)
}

/// The environment in force, or those kept under a name that is chosen.
pub(crate) fn chosen_environments<'a>(job: &'a Job, chosen: Option<&'a dyn Fn(&str) -> bool>) -> Vec<&'a Environment> {
    match chosen {
        None => vec![&job.model.environment],
        Some(fits) => job.model.environments.values().filter(|e| fits(&e.name)).collect(),
    }
}

/// The sea of an environment; `None` where it has none.
///
/// # Errors
/// A spectrum that cannot be made.
pub(crate) fn sea(job: &Job, env: &Environment, at: Span) -> Outcome<Option<Sea>> {
    Sea::new(&job.model, env).map_err(|e| e.diagnostic(at, job.units))
}

/// The title of a table of an environment.
pub(crate) fn title(what: &str, env: &Environment, train: Option<&EnvironmentSea>) -> String {
    let added = if train.is_some_and(|t| t.components.start > 0 && !t.is_given) { ", Added Sea" } else { "" };
    let name = if env.name.is_empty() { String::new() } else { format!(" of {}", env.name) };
    format!("{what}{name}{added}")
}

fn components(env: &Environment, sea: &Sea, train: &EnvironmentSea) -> Table {
    let waves = sea.components.get(train.components.clone()).unwrap_or_default();
    let variance: f64 = waves.iter().map(|c| 0.5 * c.amplitude * c.amplitude).sum();
    let mut table = Table::new(title("Sea Spectrum", env, Some(train)))
        .fact("Spectrum", train.name.as_str(), Dim::None)
        .fact("Comes From", train.direction, Dim::Angle);
    for (parameter, value) in &train.shape {
        table = table.fact(parameter.label, *value, parameter.dim);
    }
    if let Some(spectrum) = &train.spectrum {
        let [m0, m1, m2] = [0, 1, 2].map(|n| spectrum.moment(n));
        table = table
            .fact("Significant Height", 4.0 * m0.sqrt(), Dim::Length)
            .fact("Variance m0", m0, Dim::Area)
            .fact("Peak Period", TAU / spectrum.peak(), Dim::Time)
            .fact("Mean Period T1", TAU * m0 / m1, Dim::Time)
            .fact("Zero-Crossing Period Tz", TAU * (m0 / m2).sqrt(), Dim::Time)
            .fact("Significant Height of Components", 4.0 * variance.sqrt(), Dim::Length)
            .fact("Spreading Exponent", env.spreading.unwrap_or(200.0), Dim::None);
    }
    if let Some(wave) = &sea.stokes {
        let [crest, trough] = [0.0, PI].map(|angle| wave.elevation_at(angle));
        table = table
            .fact("Stokes Order", usize::from(wave.order), Dim::None)
            .fact("Height", wave.height, Dim::Length)
            .fact("Crest", crest, Dim::Length)
            .fact("Trough", trough, Dim::Length)
            .fact("Length", TAU / wave.number, Dim::Length);
    }
    let division = match env.components.map_or(Division::EqualEnergy, |c| c.division) {
        _ if train.is_given => "as given",
        _ if train.spectrum.is_none() => "regular wave",
        _ if !env.sea_periods.is_empty() => "about the periods of -S_PERIOD",
        Division::EqualEnergy => "of equal energy",
        Division::EqualFrequency => "of equal width",
    };
    let highest: f64 = waves.iter().map(|c| c.amplitude).sum();
    table = table
        .fact("Components", format!("{} {division}", waves.len()), Dim::None)
        .fact("Sum of Amplitudes", highest, Dim::Length)
        .fact("Phases", if train.is_given { "as given".into() } else { phasing(sea) }, Dim::None)
        .fact("Ramp", sea.ramp, Dim::Time)
        .fact("Above the Mean Level", stretching_name(sea), Dim::None);
    let rows: Vec<_> = waves
        .iter()
        .enumerate()
        .map(|(index, wave)| (index + 1, wave, train.bands.get(index).zip(train.spectrum.as_ref())))
        .collect();
    table
        .with_rows(&rows)
        .column("", "No.", Dim::None, Digits::Usual, |(number, ..)| *number)
        .column("", "Period", Dim::Time, Digits::Decimals(3), |(_, wave, _)| TAU / wave.frequency)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4), |(_, wave, _)| wave.frequency)
        .column("", "Amplitude", Dim::Length, Digits::Decimals(3), |(_, wave, _)| wave.amplitude)
        .column("", "From", Dim::Angle, Digits::Usual, |(_, wave, _)| {
            let [x, y] = wave.toward;
            turn((-y).atan2(-x))
        })
        .column("", "Phase", Dim::Angle, Digits::Usual, |(_, wave, _)| turn(wave.phase))
        .column("", "Density", Dim::SpectralDensity, Digits::Decimals(4), |(_, wave, band)| {
            band.map(|(_, spectrum)| spectrum.density(wave.frequency))
        })
        .column("Stands For", "From", Dim::Frequency, Digits::Decimals(4), |(.., band)| band.map(|(band, _)| band.low))
        .column("Stands For", "To", Dim::Frequency, Digits::Decimals(4), |(.., band)| {
            band.map(|(band, _)| band.high).filter(|high| high.is_finite())
        })
        .column("Stands For", "Mean Density", Dim::SpectralDensity, Digits::Decimals(4), |(.., band)| {
            band.and_then(|(band, _)| band.mean_density())
        })
        .build()
}

/// An angle from 0 to a turn; one that a rounding error keeps just below a turn is 0.
pub(crate) fn turn(angle: f64) -> f64 {
    let turned = angle.rem_euclid(TAU);
    if TAU - turned < 1e-9 { 0.0 } else { turned }
}

/// What makes the phases of a sea, in words.
pub(crate) fn phasing(sea: &Sea) -> String {
    match (sea.seed, sea.reinforcement) {
        _ if sea.phases_given => "as -PHASES gives them".into(),
        (Some(seed), _) => format!("random, seed {seed}"),
        (None, Some(time)) => format!("all in phase at X = Y = 0 at {time} s"),
        (None, None) => "crest at X = Y = 0 at 0 s".into(),
    }
}

fn stretching_name(sea: &Sea) -> &'static str {
    if sea.stokes.is_some() { "by Stokes' theory" } else { sea.stretching.word() }
}

fn density(env: &Environment, train: &EnvironmentSea) -> Option<Table> {
    let spectrum = train.spectrum.as_ref()?;
    let [low, high] = ENERGY_SHARES.map(|share| spectrum.quantile(share));
    let frequencies: Vec<f64> =
        (0..SPECTRUM_POINTS).map(|i| low + (high - low) * i as f64 / (SPECTRUM_POINTS - 1) as f64).collect();
    let table = Table::new(title("Wave Spectrum", env, Some(train)))
        .with_rows(&frequencies)
        .column("", "Frequency", Dim::Frequency, Digits::Usual, |frequency| *frequency)
        .column("", "Density", Dim::SpectralDensity, Digits::Usual, |frequency| spectrum.density(*frequency));
    Some(table.build())
}
