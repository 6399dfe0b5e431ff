//! A check of a script: the records of its model and its control records are run, the words of all others are read, and each record is
//! judged by what it would do in a run. Nothing is solved, written or printed.

use super::Session;
use crate::commands::absent::Loss;
use crate::commands::check_list::{CheckedAs, check_words};
use crate::commands::{Call, Checking, Command, Menu, find_opened_menu, menu};
use crate::report::page;
use indexmap::IndexMap;
use std::time::{Duration, Instant};
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_language::record::Record;
use windlass_language::substitution::UNKNOWN;
use windlass_model::SolveKind;

/// A check ends after this time, wherever it is.
const MAX_TIME: Duration = Duration::from_secs(2);
/// And after so many records.
const MAX_RECORDS: u64 = 1_000_000;
/// Records of a judgement that are listed.
const MAX_LISTED: usize = 100;

/// What a record would do in a run.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Judgement {
    Acts,
    Stops,
    Noted,
    Refused,
    NotJudged,
}

/// Each with its head in the table, and what stands over the list of its records.
const JUDGEMENTS: [(Judgement, &str, &str); 5] = [
    (Judgement::Acts, "Act", ""),
    (Judgement::Stops, "Stop", "These stop the next solve that they matter to, unless &PARAMETER -ACCEPT_MISSING YES:"),
    (Judgement::Noted, "Noted", "These change nothing:"),
    (Judgement::Refused, "Refused", "These are refused:"),
    (Judgement::NotJudged, "Not Judged", "These hang on results, which a check does not have:"),
];

/// What a check has found.
#[derive(Debug)]
pub(super) struct ScriptCheck {
    started: Instant,
    /// How many records of a name are judged in each way, as [`JUDGEMENTS`] has them.
    counts: IndexMap<String, [usize; JUDGEMENTS.len()]>,
    listed: Vec<(Judgement, Span, String)>,
    /// What is known of the record at hand before it has ended.
    judged: Option<Judgement>,
    /// Records of menus that were refused or are not in windlass.
    passed_over: usize,
    /// Why it ended before the script.
    ended: Option<String>,
}

impl Session {
    /// Makes this a check of the script that is opened.
    pub fn start_check(&mut self) {
        self.check = Some(ScriptCheck {
            started: Instant::now(),
            counts: IndexMap::new(),
            listed: Vec::new(),
            judged: None,
            passed_over: 0,
            ended: None,
        });
        self.job.checking = Some(Checking::default());
        self.job.settings.silent = true;
        self.job.settings.error_limit = i64::MAX;
        self.interpreter.budget = MAX_RECORDS;
    }

    /// Runs a record or reads it, and judges it; true when the check is over.
    pub(super) fn check_record(&mut self, record: &Record, text: &str) -> bool {
        let Some(check) = &mut self.check else { return true };
        if check.started.elapsed() > MAX_TIME {
            check.ended = Some(format!("the check ended after {} s", MAX_TIME.as_secs()));
            return true;
        }
        check.judged = None;
        let (errors, effects) = (self.errors, self.job.model.unmodelled_effects(SolveKind::Motions).len());
        let passing = self.passing();
        let over = self.execute_record(record, text);
        let effects_now = self.job.model.unmodelled_effects(SolveKind::Motions);
        let stops = effects_now.get(effects..).unwrap_or_default().first().map(|effect| effect.sentence());
        let refused = self.errors > errors;
        let name = record.words().first().map_or(String::new(), |word| record_name(&word.text));
        let Some(check) = &mut self.check else { return true };
        let judgement = match check.judged {
            _ if refused => Judgement::Refused,
            _ if stops.is_some() => Judgement::Stops,
            Some(judged) => judged,
            // records of a menu that is passed over, and what leaves a menu
            None if passing => {
                check.passed_over += 1;
                return over;
            }
            None if name == "END" || name.starts_with("END_") => return over,
            None => Judgement::Acts,
        };
        let said = stops.unwrap_or_else(|| text.replace(UNKNOWN, "(unknown)"));
        check.add(judgement, name, record.whole(), said);
        over
    }

    /// Whether a check runs a command; else its words are read here, and the menu that it opens is entered.
    pub(super) fn runs_in_check(&mut self, command: &'static Command, call: &Call) -> Outcome<bool> {
        let how = CheckedAs::from_command(command);
        let unknown = call.record.text().contains(UNKNOWN);
        let unjudged = unknown || self.interpreter.is_unjudged();
        let opened = find_opened_menu(&self.job, command.spec, call.words);
        let rows_follow = how == CheckedAs::RunWithRows && opened == Some(&menu::BUILDG);
        if (how == CheckedAs::Run || rows_follow) && !unjudged {
            return Ok(true);
        }
        if let (CheckedAs::SetVariable, Some(variable)) = (how, call.words.get(1)) {
            let set = self.interpreter.variables.set(&variable.text, UNKNOWN);
            set.map_err(|error| Diagnostic::error(error.to_string(), variable.span))?;
        }
        if !unknown {
            check_words(command, call)?;
        }
        if let Some(checking) = &mut self.job.checking {
            checking.solved |= how == CheckedAs::Solve;
        }
        if let Some(check) = &mut self.check {
            check.judged = match how {
                _ if unjudged => Some(Judgement::NotJudged),
                CheckedAs::WithoutEffect => Some(Judgement::Noted),
                _ => None,
            };
        }
        self.job.menus.extend(opened.map(Menu::Checked));
        Ok(false)
    }

    /// Judges a record that windlass does not have; it need not be said again.
    pub(super) fn judge_absent(&mut self, loss: Loss) {
        if let Some(check) = &mut self.check {
            check.judged = Some(match loss {
                Loss::Nothing => Judgement::Noted,
                Loss::Results => Judgement::Refused,
                Loss::Solves(_) => Judgement::Stops,
            });
        }
    }

    /// A control record that is wrong.
    pub(super) fn judge_control_error(&mut self, error: &Diagnostic) {
        if let Some(check) = &mut self.check {
            let fatal = error.severity == Severity::Fatal;
            check.ended = check.ended.take().or_else(|| fatal.then(|| error.message.clone()));
            check.add(Judgement::Refused, "control".into(), error.span.unwrap_or_default(), error.message.clone());
        }
    }

    /// Prints what a check has found, with the records by name if `by_name`.
    pub fn print_check(&mut self, by_name: bool) {
        let Some(check) = self.check.take() else { return };
        let mut totals = [0; JUDGEMENTS.len()];
        for counts in check.counts.values() {
            totals.iter_mut().zip(counts).for_each(|(total, count)| *total += count);
        }
        let mut lines = Vec::new();
        if by_name {
            let rows: Vec<_> = check.counts.iter().collect();
            let count = |i: usize| move |(_, counts): &(&String, &[usize; JUDGEMENTS.len()])| counts[i];
            let mut table = Table::new("Records").with_rows(&rows).text("Record", |(name, _)| name.to_string());
            for (i, (_, head, _)) in JUDGEMENTS.into_iter().enumerate() {
                table = table.column("", head, Dim::None, Digits::Decimals(0), count(i));
            }
            lines.extend(page::grid(&table.build(), self.job.units));
            for (judgement, _, title) in JUDGEMENTS.into_iter().filter(|(judgement, ..)| *judgement != Judgement::Acts)
            {
                let listed: Vec<_> = check.listed.iter().filter(|(listed, ..)| *listed == judgement).collect();
                if listed.is_empty() {
                    continue;
                }
                lines.extend([String::new(), title.to_string()]);
                let place = |span: &Span| self.interpreter.sources.place(*span);
                lines
                    .extend(listed.iter().take(MAX_LISTED).map(|(_, span, said)| format!("  {}  {said}", place(span))));
                let more = listed.len().saturating_sub(MAX_LISTED);
                lines.extend((more > 0).then(|| format!("  and {more} more")));
            }
            lines.push(String::new());
        }
        let records: usize = totals.iter().sum();
        let [acts, stops, noted, refused, unjudged] = totals;
        lines.push(format!(
            "{records} records: {acts} act, {stops} stop a solve, {noted} noted, {refused} refused, {unjudged} not judged"
        ));
        if check.passed_over > 0 {
            lines.push(format!("{} more are passed over with the menus they are in", check.passed_over));
        }
        lines.extend(check.ended.map(|why| format!("{why}: what follows is not checked")));
        self.job.output.text(&lines.join("\n"));
    }
}

impl ScriptCheck {
    fn add(&mut self, judgement: Judgement, name: String, span: Span, said: String) {
        let counts = self.counts.entry(name).or_default();
        for (count, _) in counts.iter_mut().zip(JUDGEMENTS).filter(|(_, (listed, ..))| *listed == judgement) {
            *count += 1;
        }
        if judgement != Judgement::Acts && self.listed.len() < MAX_LISTED * JUDGEMENTS.len() {
            self.listed.push((judgement, span, said));
        }
    }
}

/// What a record is counted as: its command, or what it describes.
fn record_name(word: &str) -> String {
    match word.chars().next() {
        Some('~') => "~CLASS".into(),
        Some('*') => "*POINT".into(),
        Some(':') => ":SELECTOR".into(),
        _ => word.to_ascii_uppercase(),
    }
}
