//! `END_OF` of TETHER: one end of an element over time.

use super::{TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_solve::tethered::{self, HistoryTarget};

/// END_OF.
pub(super) static END_OF: TetherReport =
    TetherReport::new("END_OF", "end N over time: END_OF 5 is the lower end of element 3, 6 its upper end", tables)
        .with_data();

fn tables(query: &TetherQuery) -> Tables {
    let end = query.number(2 * query.tether.line.elements().len(), "end of an element of the tether")?;
    Ok(vec![tethered::series(query.run, query.tether, HistoryTarget::End(end - 1))])
}
