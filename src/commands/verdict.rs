//! What a job comes to for who reads its exit code alone: results that are missing, tensions beyond a break.

use windlass_model::{ConnectorSummary, FatigueSegment, Model};
use windlass_solve::time::{ActionKind, Run};

/// A connector whose tension exceeds a break that was given, in a state that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct OverBreak {
    /// The connector, as written.
    pub connector: String,
    /// Its tension over the break.
    pub ratio: f64,
    /// The segment, from 1.
    pub segment: usize,
    /// By what share of its length the line is too short for its ends, where nothing gives its break.
    pub too_short: Option<f64>,
    /// The command that asked for the state.
    pub command: &'static str,
    /// When, in a run (s).
    pub time: Option<f64>,
}

impl OverBreak {
    /// One sentence without a full stop.
    pub fn text(&self) -> String {
        let time = self.time.map_or(String::new(), |t| format!(" at {t:.1} s"));
        let OverBreak { connector, ratio, segment, .. } = self;
        if let Some(share) = self.too_short {
            let percent = 100.0 * share;
            return format!(
                "{connector} is {percent:.1} per cent too short for its ends: its tension is {ratio:.3} times the break of segment {segment}{time}"
            );
        }
        format!("the tension of {connector} is {ratio:.3} times the break of its segment {segment}{time}")
    }
}

/// What a job has come to so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Results that were asked for and could not be found.
    pub absent: usize,
    /// Tensions beyond a break that was given: by `-B_TENSION`, a strength, or a line type.
    pub over_break: Vec<OverBreak>,
}

/// A connector as one over its break, where it is: of the largest tension over a break that was given, and the segment (from 1).
pub fn over_break(connector: &str, largest: Option<(f64, usize)>, command: &'static str) -> Option<OverBreak> {
    let (ratio, segment) = largest.filter(|(ratio, _)| *ratio > 1.0)?;
    Some(OverBreak { connector: connector.to_string(), ratio, segment, too_short: None, command, time: None })
}

/// The same from its summary; one that is far too short for its ends is over its break whoever gives that.
pub fn check_over_break(connector: &str, summary: &ConnectorSummary, command: &'static str) -> Option<OverBreak> {
    let over = over_break(connector, summary.over_given_break, command);
    over.or_else(|| {
        let too_short = summary.too_short?;
        let made = over_break(connector, summary.ratio.zip(summary.critical), command)?;
        Some(OverBreak { too_short: Some(too_short), ..made })
    })
}

/// The segment of a line at its first end, by the name of its connector; none of a class without segments.
pub fn segment_at_first_end(model: &Model, connector: &str) -> Option<FatigueSegment> {
    let class = &model.connectors.get(&Model::key(connector))?.class;
    model.classes.get(&Model::key(class))?.fatigue_segments().into_iter().next()
}

/// The connectors whose largest tension at the first end exceeds the break of the segment there. One that an action by its tension has
/// released, and none has put back, has broken in the run itself.
pub fn over_break_in(run: &Run) -> Vec<OverBreak> {
    let has_broken = |name: &str| {
        let same = |other: &String| other.eq_ignore_ascii_case(name);
        let happened =
            || run.actions.iter().zip(&run.fired).filter(|(_, fired)| fired.is_some()).map(|(action, _)| action);
        let released = happened().any(|action| {
            let of_it = matches!(&action.what, ActionKind::Release(names) if names.iter().any(same));
            of_it && action.when.connector().is_some_and(same)
        });
        released
            && !happened().any(|action| matches!(&action.what, ActionKind::Activate(names) if names.iter().any(same)))
    };
    let mut made = Vec::new();
    for (series, running) in run.statistics.results() {
        let Some(name) = series.name.strip_suffix(" Tension").filter(|name| !has_broken(name)) else { continue };
        let given = segment_at_first_end(&run.model, name).filter(|s| s.break_is_given);
        let segment = given.map(|s| s.breaking);
        let Some((breaking, seen)) = segment.zip(running.summary()) else { continue };
        let over = over_break(name, Some((seen.maximum.value / breaking, 1)), "TDOM");
        made.extend(over.map(|over| OverBreak { time: Some(seen.maximum.time), ..over }));
    }
    made
}
