//! `AT` of ROD: the line at instants.

use super::{EVENTS, RodQuery, RodReport, WHAT};
use crate::commands::post::report::Tables;
use crate::commands::solve::equilibrium::to_diagnostic;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_solve::results::{self, EventWindow, RunEvent, along};

/// AT.
pub(super) static AT: RodReport = RodReport::new("AT", "the line at instants, with its forces", tables).with_data();

fn tables(query: &RodQuery) -> Tables {
    let (job, args) = (query.job, query.args());
    if let Some(given) = args.option(&EVENTS) {
        return Err(Diagnostic::error("AT names its instants itself: -EVENTS does not go with it", given.span));
    }
    let history = &query.run.history;
    let times: Vec<(f64, Span)> = args.data_after(WHAT).iter().filter_map(|v| Some((v.number()?, v.span))).collect();
    let stored = history.times();
    let one = |begin: f64, span: Span| -> Outcome<RunEvent> {
        if let (Some(first), Some(last)) = (stored.first(), stored.last())
            && !(*first - 1e-9..=last * (1.0 + 1e-9)).contains(&begin)
        {
            let text = format!("the run has no instant at {begin} s: it is from {first} s to {last} s");
            return Err(Diagnostic::error(text, span));
        }
        // an increment, so that a time between two stored ones is one, too
        let window = EventWindow { begin, end: Some(begin), increment: Some(1.0) };
        let found = results::events(history, Some(&window)).map_err(|e| e.diagnostic(span, job.units))?;
        found.first().copied().ok_or_else(|| Diagnostic::error("the run has no such instant", span))
    };
    let mut events = Vec::new();
    for (time, span) in &times {
        events.push(one(*time, *span)?);
    }
    if times.is_empty() {
        let all = results::events(history, None).map_err(|e| e.diagnostic(args.span, job.units))?;
        events.extend(all.last().copied());
    }
    let made = events.iter().map(|event| along::shape(&query.line, event));
    made.collect::<Result<_, _>>().map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))
}
