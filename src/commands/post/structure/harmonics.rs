//! `HARMONICS` of STRUCTURE: harmonics of its motion.

use super::{EVENTS, StructureQuery, StructureReport};
use crate::commands::Job;
use crate::commands::post::report::Tables;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_hydro::spectrum::is_regular;
use windlass_solve::tethered;

/// HARMONICS.
pub(super) static HARMONICS: StructureReport = StructureReport::new(
    "HARMONICS",
    "mean, drift and four harmonics of the motion over the first cycle of a regular wave, or over -EVENTS",
    tables,
)
.with_options(&[EVENTS]);

fn tables(query: &StructureQuery) -> Tables {
    let made = tethered::harmonics(query.run, query.structure, period(query.job), &query.instants()?);
    let tables = made.map_err(|e| Diagnostic::error(e.to_string(), query.args().span))?;
    Ok(tables.into_iter().map(|table| with_wave(query.job, table)).collect())
}

/// The harmonics with amplitude and direction of the regular wave in force, as the listing has them.
fn with_wave(job: &Job, table: Table) -> Table {
    let Some(sea) = job.model.environment.sea.as_ref().filter(|sea| is_regular(sea)) else { return table };
    let toward = (sea.direction.to_degrees() + 180.0).rem_euclid(360.0).to_radians();
    table.fact_with_digits("WAVE AMPLITUDE", 0.5 * sea.height, Dim::Length, Digits::Decimals(3)).fact_with_digits(
        "WAVE DIRECTION",
        toward,
        Dim::Angle,
        Digits::Decimals(3),
    )
}

/// The period of the regular wave in force.
fn period(job: &Job) -> Option<f64> {
    let sea = job.model.environment.sea.as_ref()?;
    is_regular(sea).then_some(sea.period)
}
