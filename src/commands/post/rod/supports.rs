//! `SUPPORTS` of ROD: forces of a pipe on its rollers and davits.

use super::{RodQuery, RodReport};
use crate::commands::post::report::Tables;
use windlass_solve::results::{Magnitude, along};

/// SUPPORTS.
pub(super) static SUPPORTS: RodReport =
    RodReport::new("SUPPORTS", "over time the force of a pipe on each of its rollers or davits", tables);

fn tables(query: &RodQuery) -> Tables {
    query.to_tables(along::supports(&query.line, Magnitude::default(), &query.events()?))
}
