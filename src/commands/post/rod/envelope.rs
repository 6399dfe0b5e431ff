//! `ENVELOPE` of ROD: the least, mean and most of each node, and what they come to.

use super::{EVENTS, RodQuery, RodReport};
use crate::commands::post::report::Tables;
use crate::commands::solve::summary::{SolveSummary, count, number};
use windlass_base::diagnostic::Outcome;
use windlass_base::units::{Dim, UnitSystem};
use windlass_solve::results::RunEvent;
use windlass_solve::results::along::{self, LineExtreme, RunSummary};

/// ENVELOPE.
pub(super) static ENVELOPE: RodReport = RodReport::new(
    "ENVELOPE",
    "least, mean and largest of each node; the one report of a run with -STATISTICS",
    tables,
);

fn tables(query: &RodQuery) -> Tables {
    query.to_tables(along::envelope(&query.line, &events(query)?))
}

/// The events of a record; of a run without rows, whose own envelope is reported, none.
fn events(query: &RodQuery) -> Outcome<Vec<RunEvent>> {
    let is_own = query.run.history.is_empty() && !query.args().has(&EVENTS);
    if is_own { Ok(Vec::new()) } else { query.events_after_transient() }
}

/// What the line comes to over the events of a record, where and when.
pub(super) fn summarise(query: &RodQuery) -> Outcome<SolveSummary> {
    let made = RunSummary::new(&query.line, &events(query)?);
    let units = query.job.units;
    let window = match made.window {
        Some([first, last]) => format!("{} from {first:.1} to {last:.1} s", count(made.instants, "instant")),
        None => "all steps of the run, whose instants are not kept: tensions alone".to_string(),
    };
    let valued = |found: Option<LineExtreme>, dim: Dim| {
        found.map(|at| format!("{}{}", number(at.value, dim, units), place(&at, units)))
    };
    let tension = valued(made.largest_tension, Dim::Force).map(|most| {
        let least = valued(made.least_tension, Dim::Force);
        least.map_or_else(|| most.clone(), |least| format!("{most}; least {least}"))
    });
    let plain = |found: Option<LineExtreme>, text: fn(f64) -> String| {
        found.map(|at| format!("{}{}", text(at.value), place(&at, units)))
    };
    let range = |[least, most]: [f64; 2]| {
        let [least, most] = [least, most].map(|value| number(value, Dim::Length, units));
        if least == most { least } else { format!("{least} to {most}") }
    };
    let layback = made.layback.zip(made.touchdown).map(|(layback, touchdown)| {
        format!("{} from the higher end to the touchdown point, at arc {}", range(layback), range(touchdown))
    });
    Ok(SolveSummary::new(format!("ROD {} ENVELOPE: {window}", query.line.name))
        .line_if("Tension", tension)
        .line_if("Utilisation", plain(made.utilisation, |value| format!("{value:.3}")))
        .line_if("Strain", plain(made.strain, |value| format!("{:.4} % in bending", 100.0 * value)))
        .line_if("Departure", valued(made.departure, Dim::Angle).map(|text| format!("{text}, below the horizontal")))
        .line_if("Overbend", valued(made.overbend, Dim::Moment))
        .line_if("Sagbend", valued(made.sagbend, Dim::Moment))
        .line_if("Layback", layback))
}

/// Where and when.
fn place(at: &LineExtreme, units: UnitSystem) -> String {
    format!(" at arc {}, {:.1} s", number(at.arc, Dim::Length, units), at.time)
}
