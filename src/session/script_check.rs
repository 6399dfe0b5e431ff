//! A check of a script: the records of its model and its control records are run, the words of all others are read, and each record is
//! judged by what it would do in a run. Nothing is solved, written or printed.

use super::Session;
use super::check_report::{CheckReport, CheckWatch, Judgement, ListedRecord, lock};
use crate::commands::absent::Loss;
use crate::commands::check_list::{CheckedAs, check_words};
use crate::commands::journal::Executed;
use crate::commands::{Call, Checking, Command, Menu, find_opened_menu, menu};
use std::sync::{Arc, Mutex};
use std::time::{Duration, Instant};
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::span::Span;
use windlass_language::record::Record;
use windlass_language::spec::MenuSpec;
use windlass_language::substitution::UNKNOWN;
use windlass_model::SolveKind;

/// A check ends after this time, wherever it is: between records here, within one by the watch.
const MAX_TIME: Duration = Duration::from_secs(2);
/// And after so many records.
const MAX_RECORDS: u64 = 1_000_000;
/// A record that a check has met.
#[derive(Clone, Copy)]
pub struct CheckedRecord {
    /// Where it stands.
    pub span: Span,
    /// The command that it was, if it was one.
    pub command: Option<&'static Command>,
    /// How many menus were open before it, and behind it.
    pub depth: (usize, usize),
    /// The menu that is open behind it.
    pub menu: &'static MenuSpec,
}

/// A check under way.
pub(super) struct ScriptCheck {
    started: Instant,
    /// The records that were met, where they are kept.
    records: Option<Vec<CheckedRecord>>,
    report: Arc<Mutex<CheckReport>>,
    /// What is known of the record at hand before it has ended.
    pub(super) judged: Option<Judgement>,
}

impl Session {
    /// Makes this a check of the script that is opened.
    pub fn start_check(&mut self) {
        self.check = Some(ScriptCheck { started: Instant::now(), records: None, report: Arc::default(), judged: None });
        self.job.checking = Some(Checking::default());
        self.job.settings.silent = true;
        self.job.settings.error_limit = i64::MAX;
        self.interpreter.budget = MAX_RECORDS;
    }

    /// Keeps the records that a check meets, for [`Session::end_of_check`].
    pub fn keep_checked_records(&mut self) {
        if let Some(check) = &mut self.check {
            check.records = Some(Vec::new());
        }
    }

    /// Takes the records that the check has met, and those of its report that do not act, with the reason why it ended before the script.
    pub fn end_of_check(&mut self) -> (Vec<CheckedRecord>, Vec<ListedRecord>, Option<String>) {
        let Some(check) = self.check.take() else { return Default::default() };
        let report = lock(&check.report);
        (check.records.unwrap_or_default(), report.listed().to_vec(), report.ended().map(str::to_string))
    }

    /// Nothing more is checked, for this reason.
    pub(super) fn end_check(&mut self, why: &str) {
        if let Some(check) = &self.check {
            lock(&check.report).ended = Some(why.to_string());
        }
    }

    /// Where a record stands, as the card it is made of where it is one of a deck's.
    fn checked_place(&self, span: Span) -> (Span, String) {
        let span = self.card_of(span).map_or(span, |((_, place), ..)| place);
        (span, self.interpreter.sources.location(span))
    }

    /// Runs a record or reads it, and judges it; true when the check is over.
    pub(super) fn check_record(&mut self, record: &Record, text: &str) -> bool {
        let Some(check) = &mut self.check else { return true };
        if check.started.elapsed() > MAX_TIME {
            lock(&check.report).ended = Some(format!("the check ended after {} s", MAX_TIME.as_secs()));
            return true;
        }
        check.judged = None;
        let place = self.checked_place(record.whole());
        if let Some(check) = &self.check {
            lock(&check.report).at.clone_from(&place.1);
        }
        let open_menus = self.job.menus.len();
        if let Some(checking) = &mut self.job.checking {
            checking.hangs_on_result = false;
        }
        let (errors, effects) = (self.errors, self.job.model.unmodelled_effects(SolveKind::Motions).len());
        let passing = self.passing();
        let over = self.execute_record(record, text);
        let command = if let Executed::Command(command) = self.executed { Some(command) } else { None };
        let (depth, menu) = ((open_menus, self.job.menus.len()), self.job.menu().spec());
        if let Some(records) = self.check.as_mut().and_then(|check| check.records.as_mut()) {
            records.push(CheckedRecord { span: record.whole(), command, depth, menu });
        }
        let effects_now = self.job.model.unmodelled_effects(SolveKind::Motions);
        let stops = effects_now.get(effects..).unwrap_or_default().first().map(|effect| effect.sentence());
        let refused = self.errors > errors;
        let name = record.words().first().map_or(String::new(), |word| record_name(&word.text));
        let hangs_on_result = self.job.checking.is_some_and(|checking| checking.hangs_on_result);
        let Some(check) = &mut self.check else { return true };
        let judgement = match check.judged {
            Some(Judgement::Follows) => {
                lock(&check.report).following += 1;
                return over;
            }
            _ if refused => Judgement::Refused,
            _ if hangs_on_result => Judgement::NotJudged,
            _ if stops.is_some() => Judgement::Stops,
            Some(judged) => judged,
            // records of a menu that is passed over, and what leaves a menu
            None if passing => {
                lock(&check.report).passed_over += 1;
                return over;
            }
            None if name == "END" || name.starts_with("END_") => return over,
            None => Judgement::Acts,
        };
        let said =
            stops.filter(|_| judgement != Judgement::Refused).unwrap_or_else(|| text.replace(UNKNOWN, "(unknown)"));
        lock(&check.report).add(judgement, name, place, said);
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
        let place = self.checked_place(error.span.unwrap_or_default());
        if let Some(check) = &mut self.check {
            let fatal = error.severity == Severity::Fatal;
            let mut report = lock(&check.report);
            report.ended = report.ended.take().or_else(|| fatal.then(|| error.message.clone()));
            report.add(Judgement::Refused, "control".into(), place, error.message.clone());
        }
    }

    /// Watches the time of the check, also within a record or a loop: where it is over, `end` is handed what was found.
    pub fn watch_check(&self, end: impl FnOnce(&mut CheckReport) + Send + 'static) -> Option<CheckWatch> {
        self.check.as_ref().map(|check| CheckWatch::start(Arc::clone(&check.report), MAX_TIME, end))
    }

    /// Prints what a check has found, with the records by name if `by_name`.
    pub fn print_check(&mut self, by_name: bool) {
        let Some(check) = self.check.take() else { return };
        if let Some(lines) = lock(&check.report).take_lines(by_name) {
            self.job.output.text(&lines.join("\n"));
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
