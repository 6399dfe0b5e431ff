//! `PAGES` of STRUCTURE: motion and forces at instants.

use super::{EVENTS, StructureQuery, StructureReport, WHAT};
use crate::commands::post::report::Tables;
use windlass_base::diagnostic::Diagnostic;
use windlass_solve::tethered;

/// PAGES.
pub(super) static PAGES: StructureReport = StructureReport::new(
    "PAGES",
    "at instants the motion of the centre of gravity and of points, forces by category, expected error of the step",
    tables,
)
.with_options(&[EVENTS])
.with_data();

fn tables(query: &StructureQuery) -> Tables {
    let (run, structure) = (query.run, query.structure);
    let mut points = Vec::new();
    for value in query.args().data_after(WHAT) {
        let word = value.word().unwrap_or_default();
        let Some(place) = structure.points.iter().position(|p| p.eq_ignore_ascii_case(word)) else {
            let text = format!("{word} is no point of {}", structure.body);
            return Err(Diagnostic::error(text, value.span));
        };
        points.push(place);
    }
    let instants = query.instants()?;
    Ok(instants.iter().flat_map(|instant| tethered::structure(run, structure, *instant, &points)).collect())
}
