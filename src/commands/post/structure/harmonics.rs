//! `HARMONICS` of STRUCTURE: harmonics of its motion.

use super::{EVENTS, StructureQuery, StructureReport};
use crate::commands::Job;
use crate::commands::post::report::Tables;
use windlass_base::diagnostic::Diagnostic;
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
    let table = made.map_err(|e| Diagnostic::error(e.to_string(), query.args().span))?;
    Ok(vec![table])
}

/// The period of the regular wave in force.
fn period(job: &Job) -> Option<f64> {
    let sea = job.model.environment.sea.as_ref()?;
    is_regular(sea).then_some(sea.period)
}
