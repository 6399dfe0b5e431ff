//! `STATISTICS` of TETHER: statistics of the run.

use super::records::{STEPS, find_statistics};
use super::{EVENTS, NUMBER, TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_base::diagnostic::Diagnostic;

/// STATISTICS.
pub(super) static STATISTICS: TetherReport =
    TetherReport::new("STATISTICS", "1: a page for each node and end, 2: one for each parameter", tables)
        .with_options(&[EVENTS, STEPS])
        .with_data();

fn tables(query: &TetherQuery) -> Tables {
    let statistics = find_statistics(query)?;
    let made = match query.args().word(NUMBER) {
        Some("1") => statistics.type_one(query.run, query.tether),
        None | Some("2") => statistics.type_two(query.run, query.tether),
        Some(_) => return Err(Diagnostic::error("statistics are of type 1 or 2", query.args().position(NUMBER))),
    };
    query.to_outcome(made)
}
