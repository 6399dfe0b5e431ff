//! `FORCES` of TETHER: pages of the ends of elements at instants.

use super::{EVENTS, SLACK, TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_solve::tethered;

/// FORCES.
pub(super) static FORCES: TetherReport =
    TetherReport::new("FORCES", "pages of forces and stresses at both ends of the elements at instants", tables)
        .with_options(&[EVENTS, SLACK]);

fn tables(query: &TetherQuery) -> Tables {
    Ok(vec![tethered::forces(query.run, query.tether, &query.instants()?)])
}
