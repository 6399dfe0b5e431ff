//! `ALONG` of TETHER: one quantity along the tether.

use super::{NUMBER, TetherQuery, TetherReport};
use crate::commands::post::report::Tables;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::units::Dim;
use windlass_base::values::Given;
use windlass_language::select::{Owner, choose};
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_solve::tethered;

/// ALONG.
pub(super) static ALONG: TetherReport = TetherReport::new(
    "ALONG",
    "quantity N along the tether at instants, with the least and the largest of the run",
    tables,
)
.with_options(&[AT])
.with_data();

/// Times on one graph [AQWA-TETHER 2.2].
const MAX_CURVES: usize = 20;

const AT: OptionSpec = OptionSpec::ours(
    "-AT",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "times, twenty at most")],
    "instants of ALONG",
)
.repeating(1)
.default("the last");

fn tables(query: &TetherQuery) -> Tables {
    let (run, tether, args) = (query.run, query.tether, query.args());
    let quantities = |at_nodes: bool| if at_nodes { tether.node_quantities() } else { tether.end_quantities() };
    let codes = || [true, false].into_iter().flat_map(|n| quantities(n).iter().map(|q| (q.code, Owner::Ours, q.code)));
    let word = args.word(NUMBER).unwrap_or("Y");
    let code = choose(word, args.position(NUMBER), "quantity of the tether", codes())?;
    let found = [true, false].into_iter().find_map(|n| Some((n, quantities(n).iter().position(|q| q.code == code)?)));
    let times = args.option(&AT).map(Given::numbers).unwrap_or_default();
    if times.len() > MAX_CURVES {
        let text = format!("{} instants: {MAX_CURVES} at most on one graph", times.len());
        return Err(Diagnostic::error(text, args.option(&AT).map_or(args.span, |g| g.span)));
    }
    let far = |position: &usize, time: f64| (run.times.get(*position).copied().unwrap_or_default() - time).abs();
    let nearest = |time: &f64| (0..run.times.len()).min_by(|a, b| far(a, *time).total_cmp(&far(b, *time)));
    let mut positions: Vec<usize> = times.iter().filter_map(nearest).collect();
    if positions.is_empty() {
        positions.extend(run.times.len().checked_sub(1));
    }
    let made =
        found.and_then(|(at_nodes, index)| tethered::table_along_tether(run, tether, at_nodes, index, &positions));
    let table =
        made.ok_or_else(|| Diagnostic::error(format!("{word} is no quantity of the tether"), args.position(NUMBER)))?;
    Ok(vec![table])
}
