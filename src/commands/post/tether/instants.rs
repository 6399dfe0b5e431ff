//! The last run of tethers, and the instants of it that a record asks for.

use crate::commands::Job;
use crate::commands::post::prcpost;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::OptionSpec;
use windlass_base::values::Args;
use windlass_language::select::Owner;
use windlass_solve::tethered::Tethered;

/// -EVENTS.
pub(crate) const EVENTS: OptionSpec = prcpost::EVENTS
    .owner(Owner::Ours)
    .default("all stored instants; STATISTICS, RANGES and FATIGUE leave out those before TTRA_SET");

/// The last run of tethers.
pub(crate) fn last_run(job: &Job, span: Span) -> Outcome<&Tethered> {
    let missing = || Diagnostic::error("there is no run of tethers yet", span).help("TDOM -TETHERS makes one");
    let run = job.tethered.as_ref().ok_or_else(missing)?;
    if !run.settings.keep {
        return Err(Diagnostic::error("the last run of tethers kept statistics alone", span)
            .help("TDOM -TETHERS without -STATISTICS keeps its instants"));
    }
    Ok(run)
}

/// The places of the stored instants that a record asks for.
pub(crate) fn instants(run: &Tethered, args: &Args) -> Outcome<Vec<usize>> {
    let slack = 1e-6 * run.settings.step;
    let (begin, end, increment) = match args.option(&EVENTS) {
        None => (f64::NEG_INFINITY, f64::INFINITY, 0.0),
        Some(given) => {
            let [begin, end, increment] = const { EVENTS.numbers(["BEG", "END", "INC"]) }.map(|key| given.number(key));
            (begin.unwrap_or(0.0), end.unwrap_or(f64::INFINITY), increment.unwrap_or(0.0))
        }
    };
    let mut next = begin;
    let mut list = Vec::new();
    for (position, time) in run.times.iter().enumerate() {
        if *time < next - slack || *time > end + slack {
            continue;
        }
        list.push(position);
        if increment > 0.0 {
            next = if next.is_finite() { next } else { *time };
            while next <= *time + slack {
                next += increment;
            }
        }
    }
    if list.is_empty() {
        let span = args.option(&EVENTS).map_or(args.span, |g| g.span);
        return Err(Diagnostic::error("no stored instant is between these times", span));
    }
    Ok(list)
}

/// The time before which statistics of a result leave the last run out (s): none where it has no transient, or -EVENTS chooses instants.
pub(crate) fn transient_of(job: &Job, args: &Args) -> Option<f64> {
    let run = job.tethered.as_ref().filter(|_| !args.has(&EVENTS));
    run.filter(|run| run.settings.transient > 0.0).map(|run| run.settings.statistics_start())
}
