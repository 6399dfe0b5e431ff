//! What a check of a script has found so far, shared with the watch that ends a check in the middle of a record.

use crate::report::page;
use indexmap::IndexMap;
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::time::Duration;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::{Dim, UnitSystem};

/// Records of a judgement that are listed.
const MAX_LISTED: usize = 100;

/// What a record would do in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Judgement {
    /// It is done.
    Acts,
    /// It is accepted, and the next solve that it matters to stops.
    Stops,
    /// It is accepted, and changes nothing.
    Noted,
    /// It is an error.
    Refused,
    /// It hangs on results, which a check does not have.
    NotJudged,
    /// It is refused for want of what a refused record would have made.
    Follows,
}

/// Each with its head in the table, and what stands over the list of its records.
const JUDGEMENTS: [(Judgement, &str, &str); 5] = [
    (Judgement::Acts, "Act", ""),
    (Judgement::Stops, "Stop", "These stop the next solve that they matter to, unless &PARAMETER -ACCEPT_MISSING YES:"),
    (Judgement::Noted, "Noted", "These change nothing:"),
    (Judgement::Refused, "Refused", "These are refused:"),
    (Judgement::NotJudged, "Not Judged", "These hang on results, which a check does not have:"),
];

/// A record that does not act: its judgement, its place, and what is said of it.
#[derive(Clone, Debug)]
pub struct ListedRecord {
    /// What it would do.
    pub judgement: Judgement,
    /// Where it stands.
    pub span: Span,
    position: String,
    /// What is said of it.
    pub said: String,
}

/// The counts and the records of a check.
#[derive(Debug, Default)]
pub struct CheckReport {
    /// How many records of a name are judged in each way, as [`JUDGEMENTS`] has them.
    counts: IndexMap<String, [usize; JUDGEMENTS.len()]>,
    listed: Vec<ListedRecord>,
    /// Records of menus that were refused or are not in windlass.
    pub(super) passed_over: usize,
    /// Records that are refused for want of what others, which are listed, would have made.
    pub(super) following: usize,
    /// Why it ended before the script.
    pub(super) ended: Option<String>,
    /// The place of the record at hand.
    pub(super) at: String,
    /// It has been printed: nothing more is to come.
    printed: bool,
}

impl CheckReport {
    pub(super) fn add(&mut self, judgement: Judgement, name: String, (span, position): (Span, String), said: String) {
        let counts = self.counts.entry(name).or_default();
        for (count, _) in counts.iter_mut().zip(JUDGEMENTS).filter(|(_, (listed, ..))| *listed == judgement) {
            *count += 1;
        }
        if judgement != Judgement::Acts && self.listed.len() < MAX_LISTED * JUDGEMENTS.len() {
            self.listed.push(ListedRecord { judgement, span, position, said });
        }
    }

    /// The records that do not act, in their order.
    pub fn listed(&self) -> &[ListedRecord] {
        &self.listed
    }

    /// Why the check ended before the script, where it did.
    pub fn ended(&self) -> Option<&str> {
        self.ended.as_deref()
    }

    fn totals(&self) -> [usize; JUDGEMENTS.len()] {
        let mut totals = [0; JUDGEMENTS.len()];
        for counts in self.counts.values() {
            totals.iter_mut().zip(counts).for_each(|(total, count)| *total += count);
        }
        totals
    }

    /// Whether a record was refused.
    pub fn has_refused(&self) -> bool {
        self.totals().into_iter().zip(JUDGEMENTS).any(|(count, (which, ..))| which == Judgement::Refused && count > 0)
    }

    /// The report, with the records by name if `by_name`; `None` where it has been printed already.
    pub fn take_lines(&mut self, by_name: bool) -> Option<Vec<String>> {
        if std::mem::replace(&mut self.printed, true) {
            return None;
        }
        let mut lines = Vec::new();
        if by_name {
            let rows: Vec<_> = self.counts.iter().collect();
            let count = |i: usize| move |(_, counts): &(&String, &[usize; JUDGEMENTS.len()])| counts[i];
            let mut table = Table::new("Records").with_rows(&rows).text("Record", |(name, _)| name.to_string());
            for (i, (_, head, _)) in JUDGEMENTS.into_iter().enumerate() {
                table = table.column("", head, Dim::None, Digits::Decimals(0), count(i));
            }
            lines.extend(page::grid(&table.build(), UnitSystem::default(), None));
            for (judgement, _, title) in JUDGEMENTS.into_iter().filter(|(judgement, ..)| *judgement != Judgement::Acts)
            {
                let listed: Vec<_> = self.listed.iter().filter(|record| record.judgement == judgement).collect();
                if listed.is_empty() {
                    continue;
                }
                lines.extend([String::new(), title.to_string()]);
                let line = |record: &&ListedRecord| format!("  {}  {}", record.position, record.said);
                lines.extend(listed.iter().take(MAX_LISTED).map(line));
                let more = listed.len().saturating_sub(MAX_LISTED);
                lines.extend((more > 0).then(|| format!("  and {more} more")));
            }
            lines.push(String::new());
        }
        let totals = self.totals();
        let records: usize = totals.iter().sum();
        let [acts, stops, noted, refused, unjudged] = totals;
        lines.push(format!(
            "{records} records: {acts} act, {stops} stop a solve, {noted} noted, {refused} refused, {unjudged} not judged"
        ));
        if self.passed_over > 0 {
            lines.push(format!("{} more are passed over with the menus they are in", self.passed_over));
        }
        if self.following > 0 {
            lines.push(format!(
                "{} more are not done, for want of what refused records would have made",
                self.following
            ));
        }
        lines.extend(self.ended.as_ref().map(|why| format!("{why}: what follows is not checked")));
        Some(lines)
    }
}

/// The report, also where a thread that held it has panicked.
pub(super) fn lock(report: &Mutex<CheckReport>) -> MutexGuard<'_, CheckReport> {
    report.lock().unwrap_or_else(PoisonError::into_inner)
}

/// A watch over the time of a check; it ends with this value.
#[derive(Debug)]
pub struct CheckWatch {
    _running: Sender<()>,
}

impl CheckWatch {
    /// After a time, where the check still goes on, notes why it ends and hands its report to `end`.
    pub fn start(
        report: Arc<Mutex<CheckReport>>,
        limit: Duration,
        end: impl FnOnce(&mut CheckReport) + Send + 'static,
    ) -> CheckWatch {
        let (running, stopped) = channel::<()>();
        let wait = move || {
            if stopped.recv_timeout(limit) == Err(RecvTimeoutError::Timeout) {
                let mut report = lock(&report);
                if !report.printed {
                    let at = if report.at.is_empty() { String::new() } else { format!(" at {}", report.at) };
                    report.ended = Some(format!("the check ended after {} s{at}", limit.as_secs()));
                    end(&mut report);
                }
            }
        };
        // without a thread the check still ends between records
        let _ = std::thread::Builder::new().name("check watch".into()).spawn(wait);
        CheckWatch { _running: running }
    }
}
