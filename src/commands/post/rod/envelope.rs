//! `ENVELOPE` of ROD: the least, mean and most of each node.

use super::{EVENTS, RodQuery, RodReport};
use crate::commands::post::report::Tables;
use windlass_solve::results::along;

/// ENVELOPE.
pub(super) static ENVELOPE: RodReport = RodReport::new(
    "ENVELOPE",
    "least, mean and largest of each node; the one report of a run with -STATISTICS",
    tables,
);

fn tables(query: &RodQuery) -> Tables {
    // of a run without rows its own envelope is reported
    let is_own = query.run.history.is_empty() && !query.args().has(&EVENTS);
    let events = if is_own { Vec::new() } else { query.events_after_transient()? };
    query.to_tables(along::envelope(&query.line, &events))
}
