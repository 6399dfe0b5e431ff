//! `NODE` of ROD: nodes, and places between them, over time.

use super::{RodQuery, RodReport, WHAT};
use crate::commands::post::report::Tables;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_solve::results::along::{self, LinePosition};

/// NODE.
pub(super) static NODE: RodReport =
    RodReport::new("NODE", "nodes over time; with -ARC any place", tables).with_options(&[ARC]).with_data();

/// Most places reported side by side.
const MAX_PLACES: usize = 100;

const ARC: OptionSpec = OptionSpec::new(
    "-ARC",
    &[ValueSpec::new("S", Kind::Number(Dim::Length), "unstretched distance from the first end").not_negative()],
    "places of NODE, beside its nodes",
)
.repeating(1)
.owner(Owner::Ours);

fn tables(query: &RodQuery) -> Tables {
    let events = query.events()?;
    query.to_tables(along::histories(&query.line, &positions(query)?, &events))
}

/// The places of NODE.
fn positions(query: &RodQuery) -> Outcome<Vec<LinePosition>> {
    let (args, line) = (query.args(), &query.line);
    let mut list = Vec::new();
    for given in args.data_after(WHAT) {
        let value = given.number().unwrap_or(f64::NAN);
        if !(value >= 1.0 && value <= line.nodes() as f64 && value.fract() == 0.0) {
            let text = format!("{value} is no node of {}: they are 1 to {}", line.name, line.nodes());
            return Err(Diagnostic::error(text, given.span));
        }
        list.push(LinePosition::Node(value as usize));
    }
    list.extend(args.option(&ARC).map(Given::numbers).unwrap_or_default().into_iter().map(LinePosition::Arc));
    if list.is_empty() {
        list.push(LinePosition::Node(1));
    }
    if list.len() > MAX_PLACES {
        let text = format!("{} places: {MAX_PLACES} at most stand side by side", list.len());
        return Err(Diagnostic::error(text, args.span));
    }
    Ok(list)
}
