//! `-LOSE` of TDOM: mooring lines that are lost during a run, and the time that it goes on behind.

use crate::commands::Job;
use crate::commands::model::alter::select_connectors;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::tdom::FILE;
use crate::report::run_log::{self, StoredRun};
use std::fs::File;
use std::path::PathBuf;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_solve::SolveError;
use windlass_solve::line_loss::{BALANCED_SHARE, slow_period, unbalanced_share};
use windlass_solve::time::{Action, ActionKind, Run, RunSettings, Trigger};
use windlass_study::record::{LinePeaks, Peak};

/// How a run says that it began at rest.
pub(crate) const BEGAN_AT_EQUILIBRIUM: &str = "at the equilibrium with the mean forces, as &EQUI finds it";
/// Slow periods that a run goes on behind the loss.
const PERIODS_BEHIND: f64 = 5.0;
/// By how much stored times may differ, of themselves.
const SAME_TIME: f64 = 1e-9;
/// By how much the tension before the loss may differ from that of the intact run, of itself.
const SAME_TENSION: f64 = 1e-6;

/// `-LOSE`.
pub(crate) const LOSE: OptionSpec = OptionSpec::ours(
    "-LOSE",
    &[ValueSpec::new(":SEL", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector])],
    "lines that are lost during the run, all at once; what is before the loss is its transient, TTRA_SET",
)
.repeating(1);
/// `-LOSE_AT`.
pub(crate) const LOSE_AT: OptionSpec = OptionSpec::ours(
    "-LOSE_AT",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").not_negative()],
    "when the lines of -LOSE are lost",
)
.default("in a transient case of a study: at peaks of its intact case, one after the other");
/// `-INSTANTS`.
pub(crate) const INSTANTS: OptionSpec = OptionSpec::ours(
    "-INSTANTS",
    &[ValueSpec::new("N", Kind::Integer, "number").in_range(0.0, 20.0)],
    "further maxima of the tension of a lost line in the intact case, a slow period apart, at which it is lost too",
)
.default("0");
/// `-FOLLOW`.
pub(crate) const FOLLOW: OptionSpec = OptionSpec::ours(
    "-FOLLOW",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").positive()],
    "how long the run goes on behind the loss",
)
.default("five times the longest natural period without the lines");

/// What a transient case of a study takes from its intact case.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct IntactRun {
    /// Peaks of the lines.
    pub peaks: Vec<LinePeaks>,
    /// Which instant of these the case is run with, from 0.
    pub instant: usize,
    /// The folders of answers of the instants before it.
    pub earlier: Vec<PathBuf>,
}

/// When lines are lost, and why then.
#[derive(Clone, Debug, PartialEq)]
pub struct LossInstant {
    /// Its number, from 1.
    pub number: usize,
    /// Time (s).
    pub time: f64,
    /// What is there in the intact run.
    pub reason: String,
    /// How many instants there are.
    pub count: usize,
    /// The line whose tension is largest there, and its tension (N) at the stored instant before it (s).
    before: Option<(String, (f64, f64))>,
}

/// Lines that a run loses.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct LineLoss {
    lines: Vec<String>,
    /// When.
    pub instant: LossInstant,
    /// How long the run goes on (s).
    follow: f64,
    /// The same run with the loss at other instants: folders of answers, and when the lines are lost there.
    earlier: Vec<(PathBuf, f64)>,
}

impl LineLoss {
    /// The loss that a record asks for; none without `-LOSE`.
    ///
    /// # Errors
    /// No such connector, one that does not act; no instant, no natural period.
    pub fn new(job: &Job, args: &Args) -> Outcome<Option<LineLoss>> {
        let Some(given) = args.option(&LOSE) else {
            let lone = [LOSE_AT, INSTANTS, FOLLOW].into_iter().find_map(|option| args.option(&option));
            return match lone {
                Some(lone) => Err(Diagnostic::error(format!("{} goes with -LOSE", lone.name()), lone.span)),
                None => Ok(None),
            };
        };
        let mut without = job.model.clone();
        let mut lines = Vec::new();
        for key in select_connectors(&job.model, &given.values)? {
            let Some(connector) = without.connectors.get_mut(&key) else { continue };
            if !connector.active {
                let text = format!("{} does not act: it cannot be lost", connector.name);
                return Err(Diagnostic::error(text, given.span).help("a transient run begins with every line"));
            }
            connector.active = false;
            lines.push(connector.name.clone());
        }
        let period = || slow_period(&without, &job.equilibrium);
        let wrong = |error| {
            let made = to_diagnostic(error, &without, given.span, job.units);
            made.help("-FOLLOW T says how long the run goes on behind the loss")
        };
        let more = args.option(&INSTANTS).and_then(|g| g.integer(const { INSTANTS.integer("N") })).unwrap_or(0);
        let more = usize::try_from(more).unwrap_or(0);
        let own = args.option_number(&FOLLOW);
        let mut earlier = Vec::new();
        let (instant, follow) = match (args.option_number(&LOSE_AT), &job.intact_run) {
            (Some(time), _) => {
                let instant = LossInstant { number: 1, time, reason: "-LOSE_AT".into(), count: 1, before: None };
                (instant, own.map_or_else(|| period().map(|t| PERIODS_BEHIND * t), Ok).map_err(wrong)?)
            }
            (None, Some(intact)) => {
                let apart = if own.is_none() || more > 0 { period().map_err(wrong)? } else { 0.0 };
                let list =
                    instants(&intact.peaks, &lines, more, apart).map_err(|text| Diagnostic::error(text, given.span))?;
                let count = list.len();
                let times = list.iter().map(|instant| instant.time);
                earlier = intact.earlier.iter().cloned().zip(times).take(intact.instant).collect();
                let instant = list.into_iter().nth(intact.instant);
                let instant = instant.ok_or_else(|| Diagnostic::error("the intact case has no peaks", given.span))?;
                (LossInstant { count, number: intact.instant + 1, ..instant }, own.unwrap_or(PERIODS_BEHIND * apart))
            }
            (None, None) => {
                return Err(Diagnostic::error("when the lines are lost is not said", given.span).help(
                    "-LOSE_AT T says it; in a study a case whose column condition is transient takes it from its intact case",
                ));
            }
        };
        Ok(Some(LineLoss { lines, instant, follow, earlier }))
    }

    /// The settings of a run that goes on behind the loss for long enough, with what is before it as its transient.
    ///
    /// # Errors
    /// A loss before the run begins.
    pub fn settings(&self, job: &Job, settings: RunSettings, args: &Args) -> Outcome<RunSettings> {
        let before = self.instant.time - job.model.environment.run_start;
        if before < 0.0 {
            return Err(Diagnostic::error("the lines are lost before the run begins", args.span));
        }
        let steps = ((before + self.follow) / settings.dt).ceil();
        Ok(RunSettings { observed: steps * settings.dt, transient: before, ..settings })
    }

    /// The event that takes the lines away.
    pub fn action(&self) -> Action {
        self.action_at(self.instant.time)
    }

    fn action_at(&self, time: f64) -> Action {
        Action { name: "LOSE".into(), when: Trigger::At(time), what: ActionKind::Release(self.lines.clone()) }
    }

    /// What a run of another instant has kept of the part before both losses, which is the same to the last digit: the longest there is.
    /// `None` where a run keeps no snapshot so early, or was another one.
    pub fn common_part(&self, made: &Run) -> Option<StoredRun> {
        let mut found: Option<StoredRun> = None;
        let is_own = |action: &Action| *action == self.action();
        for (folder, time) in &self.earlier {
            let limit = time.min(self.instant.time) - 0.5 * made.settings.dt;
            let kept = File::open(folder.join(FILE)).ok().and_then(|mut file| run_log::read(&mut file, limit).ok());
            let Some(kept) = kept else { continue };
            let actions: Vec<Action> = made
                .actions
                .iter()
                .map(|action| if is_own(action) { self.action_at(*time) } else { action.clone() })
                .collect();
            let is_same =
                kept.fingerprint == made.fingerprint_with_actions(&actions) && kept.width == made.history.layout.width;
            let is_longer = found.as_ref().is_none_or(|known| kept.snapshot.time > known.snapshot.time);
            if is_same && is_longer {
                found = Some(kept);
            }
        }
        found
    }

    /// The options that a record lacks to make the same run without an intact case.
    pub fn missing_options(&self, args: &Args) -> String {
        let own = [(LOSE_AT, self.instant.time), (FOLLOW, self.follow)];
        let missing = own.iter().filter(|(option, _)| !args.has(option));
        missing.map(|(option, value)| format!(" {} {value}", option.name)).collect()
    }

    /// What a reader of the run is told.
    pub fn remark(&self) -> String {
        let LossInstant { time, reason, .. } = &self.instant;
        let end = time + self.follow;
        format!("{} lost at {time} s ({reason}); the run goes on to {end:.1} s", self.lines.join(", "))
    }

    /// Whether a run was that of the intact case up to the loss.
    ///
    /// # Errors
    /// What differs.
    pub fn compare(&self, run: &Run) -> Result<(), String> {
        let Some((line, (time, intact))) = &self.instant.before else { return Ok(()) };
        let layout = &run.history.layout;
        let link = layout.links.iter().position(|link| link.name.eq_ignore_ascii_case(line));
        let is_there = |row: &&[f64]| row.first().is_some_and(|t| (t - time).abs() <= SAME_TIME * time.abs().max(1.0));
        let row = run.history.rows().find(is_there);
        let tension = link.zip(row).and_then(|(link, row)| layout.tension(link, row));
        match tension {
            None => Err(format!(
                "the run keeps no tension of {line} at {time} s, as that of the intact case does: -STORE differs"
            )),
            Some(tension) if (tension - intact).abs() > SAME_TENSION * intact.abs() => Err(format!(
                "the run before the loss is not that of the intact case: at {time} s {line} pulls {tension} N, and {intact} N there"
            )),
            Some(_) => Ok(()),
        }
    }
}

/// Whether a run of a damaged mooring begins where it rests without the lines that are lost. One that does not may leave out enough of its
/// beginning as its transient: [`PERIODS_BEHIND`] slow periods.
///
/// # Errors
/// A run that shows the motion after the loss as if it were that of the damaged mooring.
pub(crate) fn check_damaged_start(job: &Job, run: &Run, lost: &[String]) -> Result<(), String> {
    if run.began == BEGAN_AT_EQUILIBRIUM {
        return Ok(());
    }
    let told = |error: SolveError| to_diagnostic(error, &run.model, Span::default(), job.units).message.clone();
    let share = unbalanced_share(&run.model, lost).map_err(told)?;
    if share <= BALANCED_SHARE {
        return Ok(());
    }
    let left_out = run.settings.transient;
    let needed = PERIODS_BEHIND * slow_period(&run.model, &job.equilibrium).map_err(told)?;
    if left_out >= needed {
        return Ok(());
    }
    Err(format!(
        "the run is without {} and does not begin where the bodies rest without: {:.0} per cent of what is lost there is unbalanced, \
         and it leaves out {left_out} s as its transient, not {needed:.0} s (five slow periods)",
        lost.join(", "),
        100.0 * share
    ))
}

/// The instants of a loss: of the largest tension of each line, of the largest offset, and of so many further maxima of tension, each at
/// least so long (s) from those before. Instants that coincide are one.
///
/// # Errors
/// A line whose peaks are not there.
fn instants(peaks: &[LinePeaks], lines: &[String], more: usize, apart: f64) -> Result<Vec<LossInstant>, String> {
    let mut made: Vec<LossInstant> = Vec::new();
    let mut further: Vec<(&str, Peak)> = Vec::new();
    let mut offset: Option<Peak> = None;
    let instant = |peak: Peak, reason: String, line: Option<&str>| LossInstant {
        number: 1,
        time: peak.time,
        reason,
        count: 1,
        before: line.map(str::to_owned).zip(peak.before),
    };
    for line in lines {
        let found = peaks.iter().find(|peaks| peaks.line.eq_ignore_ascii_case(line));
        let Some((found, largest)) = found.and_then(|found| Some((found, found.tension.first()?))) else {
            return Err(format!(
                "the intact case has kept no tension of {line}: its script runs no TDOM with this line, or the column lost does not name it"
            ));
        };
        if made.iter().all(|known| known.time != largest.time) {
            made.push(instant(*largest, format!("largest tension of {line}"), Some(line)));
        }
        further.extend(found.tension.iter().skip(1).map(|peak| (line.as_str(), *peak)));
        offset = match (offset, found.offset) {
            (Some(known), Some(new)) => Some(if new.value > known.value { new } else { known }),
            (known, new) => known.or(new),
        };
    }
    if let Some(peak) = offset.filter(|peak| made.iter().all(|known| known.time != peak.time)) {
        made.push(instant(peak, "largest offset".into(), None));
    }
    further.sort_by(|a, b| b.1.value.total_cmp(&a.1.value).then(a.1.time.total_cmp(&b.1.time)));
    let mut left = more;
    for (line, peak) in further {
        if left > 0 && made.iter().all(|known| (known.time - peak.time).abs() >= apart) {
            made.push(instant(peak, format!("tension of {line}, further maximum {}", more - left + 1), Some(line)));
            left -= 1;
        }
    }
    Ok(made)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn peaks() -> Vec<LinePeaks> {
        let peak = |(time, value): (f64, f64)| Peak { time, value, before: None };
        let line = |name: &str, tension: &[(f64, f64)], offset: (f64, f64)| LinePeaks {
            line: name.into(),
            tension: tension.iter().copied().map(peak).collect(),
            offset: Some(peak(offset)),
        };
        vec![
            line("L1", &[(500.0, 9e5), (510.0, 8e5), (700.0, 7e5), (900.0, 6e5)], (505.0, 12.0)),
            line("L2", &[(300.0, 5e5), (650.0, 4e5)], (310.0, 13.0)),
        ]
    }

    fn times(lines: &[&str], more: usize) -> Vec<f64> {
        let lines: Vec<String> = lines.iter().map(|line| (*line).to_owned()).collect();
        instants(&peaks(), &lines, more, 100.0).unwrap().iter().map(|found| found.time).collect()
    }

    #[test]
    fn further_instants_are_a_slow_period_from_those_before() {
        assert_eq!(times(&["L1"], 0), [500.0, 505.0]);
        // 510 is within 100 s of 500, 700 and 900 are not
        assert_eq!(times(&["l1"], 2), [500.0, 505.0, 700.0, 900.0]);
        assert_eq!(times(&["L1"], 9), [500.0, 505.0, 700.0, 900.0]);
        assert_eq!(times(&["L1", "L2"], 2), [500.0, 300.0, 310.0, 700.0, 900.0]);
        assert!(instants(&peaks(), &["L3".into()], 0, 1.0).unwrap_err().contains("no tension of L3"));
    }
}
