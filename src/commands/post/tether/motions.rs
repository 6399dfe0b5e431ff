//! `MOTIONS` of TETHER: pages of the nodes at instants.

use super::{EVENTS, SLACK, TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_solve::tethered;

/// MOTIONS.
pub(super) static MOTIONS: TetherReport =
    TetherReport::new("MOTIONS", "pages of the motion of the nodes at instants", tables).with_options(&[EVENTS, SLACK]);

fn tables(query: &TetherQuery) -> Tables {
    Ok(vec![tethered::motions(query.run, query.tether, &query.instants()?)])
}
