//! `EVENTS` of TETHER: slack and impact of all tethers.

use super::{TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_solve::tethered;

/// EVENTS.
pub(super) static EVENTS: TetherReport =
    TetherReport::new("EVENTS", "tethers that went slack, that struck, whose lower end fell on its stop", tables);

fn tables(query: &TetherQuery) -> Tables {
    Ok(vec![tethered::events(query.run)])
}
