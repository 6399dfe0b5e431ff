//! The records that STATISTICS, RANGES and FATIGUE of TETHER count: between steps, or between times.

use super::{EVENTS, TetherQuery};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_solve::tethered::{StatisticsSteps, TetherStatistics};

/// -STEPS.
pub(super) const STEPS: OptionSpec = OptionSpec::ours(
    "-STEPS",
    &[
        ValueSpec::new("FIRST", Kind::Integer, "step at which statistics start; the start of the run is step 1")
            .in_range(1.0, 1e9),
        ValueSpec::new("LAST", Kind::Integer, "step at which they finish").or("the last").in_range(1.0, 1e9),
        ValueSpec::new("EVERY", Kind::Integer, "steps from one record to the next")
            .or("-STORE of the run")
            .in_range(1.0, 1e9),
    ],
    "the steps of STATISTICS, RANGES and FATIGUE, as cards TSTS, TSTF and TGRV count them; the record at or before FIRST is the first",
);

/// The statistics of the records that a record of TETHER chooses.
///
/// # Errors
/// -STEPS beside -EVENTS; steps that the run has not stored.
pub(super) fn find_statistics(query: &TetherQuery) -> Outcome<TetherStatistics> {
    let (run, args) = (query.run, query.args());
    if let Some(given) = args.option(&STEPS) {
        let whole = |n: Option<i64>| n.and_then(|n| usize::try_from(n).ok());
        let keys = const { [STEPS.integer("FIRST"), STEPS.integer("LAST"), STEPS.integer("EVERY")] };
        let [first, last, every] = keys.map(|key| whole(given.integer(key)));
        let steps = StatisticsSteps {
            first: first.unwrap_or(1),
            last: last.unwrap_or(usize::MAX),
            every: every.unwrap_or(run.settings.store),
        };
        if let Some(times) = args.option(&EVENTS) {
            return Err(Diagnostic::error("-EVENTS does not go with -STEPS", times.span)
                .help("-STEPS counts steps from 1, -EVENTS has times: one of them sets the records"));
        }
        return TetherStatistics::between_steps(run, steps).map_err(|e| Diagnostic::error(e.to_string(), given.span));
    }
    let given = args.option(&EVENTS);
    let from =
        given.and_then(|given| given.number(const { EVENTS.number("BEG") })).unwrap_or(run.settings.statistics_start());
    let to = given.and_then(|given| given.number(const { EVENTS.number("END") })).unwrap_or(f64::INFINITY);
    Ok(TetherStatistics::new(run, from, to))
}
