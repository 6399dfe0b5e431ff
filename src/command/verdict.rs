//! What a job comes to for who reads its exit code alone: results that are missing, tensions beyond a break.

use windlass_model::{Class, Model};
use windlass_solve::time::{Action, Run, What};

/// A connector whose tension exceeds a break in a state that was asked for.
#[derive(Clone, Debug, PartialEq)]
pub struct OverBreak {
    /// The connector, as written.
    pub connector: String,
    /// Its tension over the break.
    pub ratio: f64,
    /// The command that asked for the state.
    pub command: &'static str,
}

/// What a job has come to so far.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Verdict {
    /// Results that were asked for and could not be found.
    pub absent: usize,
    /// Tensions beyond a break that was given: by `-B_TENSION`, a strength, or a line type.
    pub over_break: Vec<OverBreak>,
}

/// Options of a class record that state a break; without one it is that of steel with the bare diameter.
const STATING: [&str; 5] = ["-B_TENSION", "-TENSTR", "-FYIELD", "-TYPE", "-TMAX"];

/// Whether the break of a segment (from 1) was given.
fn is_stated(class: &Class, segment: usize) -> bool {
    let record = segment.checked_sub(1).and_then(|i| class.records.get(i));
    record.is_some_and(|r| STATING.iter().any(|option| r.args.has(option)))
}

fn class_of<'a>(model: &'a Model, connector: &str) -> Option<&'a Class> {
    model.connectors.get(&Model::key(connector)).and_then(|c| model.classes.get(&Model::key(&c.class)))
}

impl Verdict {
    /// Takes the largest tension over break of a connector, and the segment (from 1) that has it.
    pub fn take(
        &mut self,
        model: &Model,
        connector: &str,
        ratio: Option<f64>,
        segment: Option<usize>,
        command: &'static str,
    ) {
        let (Some(ratio), Some(segment)) = (ratio, segment) else { return };
        if ratio > 1.0 && class_of(model, connector).is_some_and(|class| is_stated(class, segment)) {
            self.over_break.push(OverBreak { connector: connector.to_string(), ratio, command });
        }
    }

    /// Takes the largest tensions of a run at the first ends of its connectors. One that an action watches, and releases, breaks in
    /// the run itself.
    pub fn take_run(&mut self, run: &Run) {
        let releases = |action: &&Action, name: &str| {
            let same = |other: &String| other.eq_ignore_ascii_case(name);
            matches!(&action.what, What::Release(names) if names.iter().any(same))
                && action.when.connector().is_some_and(same)
        };
        for (series, running) in run.statistics.all() {
            let Some(name) = series.name.strip_suffix(" Tension") else { continue };
            if run.actions.iter().any(|action| releases(&action, name)) {
                continue;
            }
            let breaking = class_of(&run.model, name).and_then(|c| c.fatigue_segments().first().map(|s| s.breaking));
            let ratio = running.summary().zip(breaking).map(|(seen, breaking)| seen.maximum.value / breaking);
            self.take(&run.model, name, ratio, Some(1), "TDOM");
        }
    }
}
