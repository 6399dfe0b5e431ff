//! `FATIGUE` of ROD: rainflow cycles along the line.

use super::{RodQuery, RodReport, plain};
use crate::commands::post::report::Tables;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_signal::line::fatigue::{MAX_CIRCUMFERENCE_POINTS, TubeCircumference};
use windlass_solve::results::along;

/// FATIGUE.
pub(super) static FATIGUE: RodReport = RodReport::new(
    "FATIGUE",
    "rainflow cycles: of a tube with a curve of stress, by the stress at -POINTS round it, else of tension",
    tables,
)
.with_options(&[POINTS, SCF, DFF]);

const POINTS: OptionSpec = OptionSpec::ours(
    "-POINTS",
    &[ValueSpec::new("N", Kind::Integer, "points").in_range(1.0, MAX_CIRCUMFERENCE_POINTS as f64)],
    "points round a tube at which FATIGUE looks",
)
.default("8");
const SCF: OptionSpec =
    OptionSpec::ours("-SCF", &[plain("F", "factor on stress").positive()], "stress concentration of tubes in FATIGUE")
        .default("1");
const DFF: OptionSpec = OptionSpec::ours(
    "-DFF",
    &[plain("F", "factor").in_range(1.0, 1000.0)],
    "design fatigue factor: life is divided by it",
)
.default("1");

fn tables(query: &RodQuery) -> Tables {
    let (args, events) = (query.args(), query.events_after_transient()?);
    let usual = TubeCircumference::default();
    let points = args.option_integer(&POINTS).and_then(|n| usize::try_from(n).ok());
    let round = TubeCircumference {
        points: points.unwrap_or(usual.points),
        concentration: args.option_number(&SCF).unwrap_or(usual.concentration),
    };
    let factor = args.option_number(&DFF).unwrap_or(1.0);
    query.to_tables(along::fatigue_along(&query.line, &query.job.model.fatigue, (&round, factor), &events))
}
