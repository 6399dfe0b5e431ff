//! `HISTORY` of STRUCTURE: motion and forces over time.

use super::{StructureQuery, StructureReport};
use crate::commands::post::report::Tables;
use windlass_solve::tethered;

/// HISTORY.
pub(super) static HISTORY: StructureReport = StructureReport::new("HISTORY", "motion and forces over time", tables);

fn tables(query: &StructureQuery) -> Tables {
    Ok(vec![tethered::structure_series(query.run, query.structure)])
}
