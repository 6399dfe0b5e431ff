//! `TOUCHDOWN` of ROD: where the line comes down, over time.

use super::{RodQuery, RodReport};
use crate::commands::post::report::Tables;
use windlass_solve::results::along;

/// TOUCHDOWN.
pub(super) static TOUCHDOWN: RodReport = RodReport::new(
    "TOUCHDOWN",
    "over time the first node on the bottom, and where between it and the one before the line comes down",
    tables,
);

fn tables(query: &RodQuery) -> Tables {
    query.to_tables(along::touchdown(&query.line, &query.events()?))
}
