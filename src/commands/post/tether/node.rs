//! `NODE` of TETHER: one node over time.

use super::{TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_solve::tethered::{self, HistoryTarget};

/// NODE.
pub(super) static NODE: TetherReport = TetherReport::new("NODE", "node N over time", tables).with_data();

fn tables(query: &TetherQuery) -> Tables {
    let node = query.number(query.tether.line.nodes(), "node of the tether")?;
    Ok(vec![tethered::series(query.run, query.tether, HistoryTarget::Node(node - 1))])
}
