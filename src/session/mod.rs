//! One running job: takes records from the interpreter, finds the command each means in the present menu, and keeps the
//! error policy.

mod absent_record;
mod check_report;
mod consequences;
mod deck;
mod live_page;
mod named;
mod reading;
mod script_check;
mod skipped_menu;

pub use check_report::{CheckReport, CheckWatch, Judgement, ListedRecord};
pub use consequences::defined_name;
pub use reading::{RecordReadError, UnsavedTexts, read_all, read_text};
pub use script_check::CheckedRecord;

use self::consequences::RefusedRecords;
use self::deck::DeckRecords;
use self::named::{in_menu, plain_word, unknown_name_error};
use self::script_check::ScriptCheck;
use crate::commands::absent::{self, Absent};
use crate::commands::count;
use crate::commands::journal::Executed;
use crate::commands::{
    self, Call, Command, DeckFormat, Effect, INMODEL_FILE, Job, Menu, PLAIN, SCRIPT, commands_of_menu,
};
use crate::report::output::Output;
use crate::report::page;
use crate::report::run_log::StoredRun;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::Ordering;
use windlass_aqwa as aqwa;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::span::{SourceId, Span};
use windlass_base::values::Args;
use windlass_language::args;
use windlass_language::flow::macros::{self, Macro};
use windlass_language::flow::specs::CONTROL;
use windlass_language::flow::{FlowStep, Interpreter};
use windlass_language::record::{Record, Word};
use windlass_language::render::render;
use windlass_language::select::{SearchResult, keyword};
use windlass_language::source::Text;
use windlass_language::spec::TextForm;
use windlass_language::substitution::UNKNOWN;
use windlass_language::token::TokenKind;

/// Commands whose results others report.
const SOLVES: [&str; 3] = ["TDOM", "RAO", "SRESPONSE"];

/// Commands behind which the page of a job is written anew.
const PAGE_SOLVES: [&str; 7] = ["&EQUI", "TDOM", "RAO", "SRESPONSE", "MOVE", "WATCH", "&STATUS"];

/// Why a run came back.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SessionEnd {
    /// The terminal must give a line.
    NeedLine,
    /// Everything has been read.
    Done,
    /// `&FINISH`, a fatal error, or too many errors.
    Finished,
}

/// A running job with its interpreter.
pub struct Session {
    /// What commands act on.
    pub job: Job,
    /// Where records come from.
    pub interpreter: Interpreter,
    /// Errors so far.
    pub errors: i64,
    /// Somebody is typing: errors do not end the run.
    pub interactive: bool,
    /// A run ends at its first error, for programs that call; what else was open is to be given up by the caller.
    pub stops_at_error: bool,
    /// Keep every message in [`Session::reports`], for programs that read them.
    pub keep_reports: bool,
    /// The messages kept.
    pub reports: Vec<Diagnostic>,
    /// Errors when the terminal was last asked for a line.
    errors_at_prompt: i64,
    /// Errors of records that windlass does not have: they do not count toward the limit at which a run ends.
    errors_of_absent: i64,
    /// Texts that an editor has not saved yet, read in the place of their files.
    pub unsaved: UnsavedTexts,
    /// The files that were read as records, each with the text that it became.
    pub source_files: Vec<(SourceId, PathBuf)>,
    /// Texts made of decks, with the cards or rows they are made of.
    decks: Vec<(SourceId, DeckRecords)>,
    /// The deck that is the job, until the pages before its motion are listed.
    listed: Option<Box<aqwa::Deck>>,
    /// What the record at hand was.
    executed: Executed,
    /// What a check has found, where the script is only checked.
    check: Option<ScriptCheck>,
    /// What of refused records later ones may need.
    refused: RefusedRecords,
    /// The last record of this menu was unknown: records of a disposition menu that follow were meant for what it should have opened.
    lost_opener: bool,
}

impl Session {
    /// A session writing to these channels.
    pub fn new(output: Output) -> Self {
        let interpreter = Interpreter::new(commands::internal_names());
        let mut job = Job { interrupt: Arc::clone(&interpreter.interrupt), ..Job::new(output) };
        job.model.interrupt = Arc::clone(&interpreter.interrupt);
        Session {
            job,
            interpreter,
            errors: 0,
            interactive: false,
            stops_at_error: false,
            keep_reports: false,
            reports: Vec::new(),
            errors_at_prompt: 0,
            errors_of_absent: 0,
            unsaved: UnsavedTexts::default(),
            source_files: Vec::new(),
            decks: Vec::new(),
            listed: None,
            executed: Executed::Nothing,
            check: None,
            refused: RefusedRecords::default(),
            lost_opener: false,
        }
    }

    /// Opens a text as the next thing to read.
    pub fn open(&mut self, name: &str, text: impl Into<Text>) {
        if let Err(error) = self.interpreter.open(name, text, SCRIPT, None) {
            self.report(*error);
        }
    }

    /// Makes the model of a stored run by its records and takes the run as the last one; false where the records are refused.
    pub fn open_stored(&mut self, kept: StoredRun, records: &str) -> bool {
        let model = records.trim_end();
        let (model, last) = model.rsplit_once('\n').unwrap_or(("", model));
        self.job.settings.silent = true;
        // the records that took them ask for them in this order
        self.job.offered_states = kept.taken_states.clone();
        self.open("the records of the run", format!("{model}\n"));
        self.run();
        self.job.menus.truncate(1);
        self.job.stored_run = Some(kept);
        self.open("the record of the run", format!("{last}\n"));
        self.run();
        self.job.settings.silent = false;
        self.errors == 0 && self.job.stored_run.take().is_none()
    }

    /// Opens a script file.
    ///
    /// # Errors
    /// A file that cannot be read.
    pub fn open_file(&mut self, name: &str, path: &Path) -> Result<(), RecordReadError> {
        let text = self.unsaved.read(path)?;
        self.open(name, text);
        Ok(())
    }

    /// Runs until nothing is left, a line is needed, or the job ends.
    pub fn run(&mut self) -> SessionEnd {
        loop {
            self.interpreter.passing = self.passing();
            self.interpreter.keeps_empty_lines = matches!(self.job.menu(), Menu::Building(table) if table.is_brief());
            let over = match self.interpreter.next_step(&mut self.job) {
                Ok(FlowStep::Record(record)) => self.execute(&record),
                Ok(FlowStep::Ended(commands::DECK_HEAD)) => {
                    self.list_start();
                    false
                }
                Ok(FlowStep::Ended(tag)) => {
                    while tag == INMODEL_FILE && self.passing() {
                        self.leave_menu(None);
                    }
                    if tag == INMODEL_FILE && matches!(self.job.menu(), Menu::Inmodel) {
                        self.leave_menu(None);
                        self.job.journal.keep_end(self.job.menus.len());
                    }
                    false
                }
                Ok(FlowStep::NeedLine) => {
                    self.errors_at_prompt = self.errors;
                    return SessionEnd::NeedLine;
                }
                Ok(FlowStep::Done) => {
                    self.say_open_menus();
                    return SessionEnd::Done;
                }
                Err(error) => {
                    self.judge_control_error(&error);
                    self.report(*error);
                    self.job.last_severity == Some(Severity::Fatal) && !self.interactive
                }
            };
            if over || self.too_many_errors() {
                return SessionEnd::Finished;
            }
        }
    }

    fn too_many_errors(&mut self) -> bool {
        if self.stops_at_error && self.errors > 0 {
            return true;
        }
        let settings = &self.job.settings;
        let limit = settings.error_limit;
        if self.interactive {
            if self.errors - self.errors_at_prompt >= limit && !self.interpreter.at_terminal() {
                self.interpreter.unwind();
                let text = format!("{limit} errors: what was being read is given up (&DEVICE -LIMERROR)");
                self.report(Diagnostic::plain(Severity::Note, text));
            }
            return false;
        }
        if self.errors == 0 {
            return false;
        }
        if settings.batch {
            return true;
        }
        if self.errors - self.errors_of_absent >= limit {
            let text = format!("{limit} errors: the run ends here (&DEVICE -LIMERROR)");
            self.report(Diagnostic::plain(Severity::Note, text));
            return true;
        }
        false
    }

    /// At the end of a run: what was left open.
    fn say_open_menus(&mut self) {
        if let Menu::Inmodel = self.job.menu() {
            self.leave_menu(None);
        }
        if self.job.menus.len() > 1 {
            let menu = self.job.menu();
            let text = format!("the input ends inside menu {}, which {} leaves", menu.name(), menu.end());
            self.report(Diagnostic::plain(Severity::Note, text));
        }
    }

    /// No more is typed: says which block was not closed.
    pub fn end_of_typing(&mut self) {
        if let Err(error) = self.interpreter.end_of_typing() {
            self.report(*error);
        }
    }

    /// Ends the job: files that were opened and never closed are written, and said.
    pub fn finish(&mut self) {
        for said in commands::write_open_files(&mut self.job) {
            self.report(*said);
        }
        self.job.output.flush();
        self.job.output.check_files();
        self.report_lost_output();
    }

    /// Prints a message, counts it, and remembers how serious it was.
    pub fn report(&mut self, diagnostic: Diagnostic) {
        let mut diagnostic = self.point_at_card(diagnostic);
        diagnostic.help.extend(self.interpreter.trace());
        if matches!(diagnostic.severity, Severity::Error | Severity::Fatal) {
            self.errors += 1;
        }
        self.job.last_severity = Some(diagnostic.severity);
        if self.check.is_some() && !matches!(diagnostic.severity, Severity::Error | Severity::Fatal) {
            return;
        }
        let sources = &self.interpreter.sources;
        let plain = render(&diagnostic, sources, false);
        let coloured = if self.job.output.colour { render(&diagnostic, sources, true) } else { String::new() };
        self.job.output.message(&coloured, &plain);
        if self.keep_reports {
            self.reports.push(diagnostic);
        }
    }

    /// Output that could not be written is an error: the exit code says so.
    fn report_lost_output(&mut self) {
        for trouble in self.job.output.troubles() {
            let mut error = Diagnostic::plain(Severity::Error, trouble.text);
            error.help.extend(trouble.help.map(str::to_string));
            self.report(error);
        }
    }

    /// Executes a record; true when the job is over.
    fn execute(&mut self, record: &Record) -> bool {
        let text = record.text().trim();
        self.job.output.log(&format!("> {text}"));
        if self.job.settings.echo {
            self.job.output.text(&format!("> {text}"));
        }
        self.job.output.folder.typed = self.interpreter.reads_what_is_typed();
        let interrupted = self.job.is_interrupted();
        if self.interactive && self.job.settings.pages && self.interpreter.reads_what_is_typed() {
            self.job.output.collect();
        }
        let over =
            if self.check.is_some() { self.check_record(record, text) } else { self.execute_record(record, text) };
        if self.job.output.show_collected() && !interrupted {
            // Ctrl-C within the pager is meant for the pager
            self.job.interrupt.store(false, Ordering::Relaxed);
        }
        self.job.output.folder.typed = false;
        for path in self.job.output.folder.read_outside() {
            self.job.output.log(&format!("read {}, outside of the script's folder", path.display()));
        }
        self.report_lost_output();
        if let Executed::Command(command) = self.executed
            && PAGE_SOLVES.contains(&command.spec.name)
        {
            self.write_page("the job runs");
        }
        over
    }

    /// Does what a record says; true when the job is over.
    fn execute_record(&mut self, record: &Record, text: &str) -> bool {
        let words = record.words();
        let asked = self.job.last_severity;
        self.job.last_severity = None;
        let open_menus = self.job.menus.len();
        self.executed = Executed::Nothing;
        let outcome = self.dispatch(record, &words);
        self.keep_opened_table(open_menus);
        for notice in std::mem::take(&mut self.job.notices) {
            self.report(notice);
        }
        let effect = match outcome {
            Ok(effect) => effect,
            Err(error) => {
                let fatal = error.severity == Severity::Fatal;
                self.refuse_surface(&words, &error);
                self.report_refusal(record, &words, *error);
                return fatal;
            }
        };
        self.note_body(&words);
        self.keep_in_journal(text, &words, &effect);
        self.say_opened_menu(open_menus);
        // a record that only speaks keeps the severity it may be about to ask for
        if self.job.last_severity.is_none() && text.get(..5).is_some_and(|t| t.eq_ignore_ascii_case("&TYPE")) {
            self.job.last_severity = asked;
        }
        match effect {
            Effect::Done => false,
            Effect::Finish => true,
            Effect::Budget(records) => {
                self.interpreter.budget = records;
                false
            }
            Effect::Say(text) => {
                self.job.say_fitted(|width| match width {
                    Some(_) => page::fold_text(&text, width),
                    None => text.clone(),
                });
                false
            }
            Effect::Set(name, value) => {
                if let Err(error) = self.interpreter.variables.set(&name, &value) {
                    self.report(*Diagnostic::error(error.to_string(), record.whole()));
                }
                false
            }
            Effect::Insert { name, path, tag } => {
                self.insert(&name, &path, tag, record.whole());
                false
            }
            Effect::Library { name, text } => {
                if let Err(error) = self.interpreter.open(name, text, PLAIN, Some(record.whole())) {
                    self.report(*error);
                }
                false
            }
            Effect::Deck { name, path, format } => {
                self.job.output.folder.note_reading(&path);
                match (self.unsaved.read(&path), format) {
                    (Ok(text), DeckFormat::Aqwa) => self.insert_deck(&name, &path, text, record.whole()),
                    (Ok(text), DeckFormat::MoorDyn(lines, like)) => {
                        self.insert_moordyn((&name, &path), text, (lines, like), record.whole());
                    }
                    (Ok(text), DeckFormat::OrcaFlex(lines)) => {
                        self.insert_orcaflex((&name, &path), text, lines, record.whole());
                    }
                    (Err(error), _) => self.report(*Diagnostic::error(error.to_string(), record.whole())),
                }
                false
            }
        }
    }

    /// A record of a surface that is being given was refused: the surface is not made, in a script.
    fn refuse_surface(&mut self, words: &[Word], error: &Diagnostic) {
        let is_internal = words.first().is_none_or(|first| first.kind == TokenKind::Internal);
        if self.interactive || is_internal {
            return;
        }
        if let Some(Menu::Planes(planes) | Menu::Block(planes)) = self.job.menus.last_mut() {
            planes.refuse();
            commands::keep_refused_surface(&mut self.job, "PLANE", error.span.unwrap_or_default());
        }
    }

    /// Keeps the table of a menu that has just been opened, where a program reads them.
    fn keep_opened_table(&mut self, open_menus: usize) {
        if self.job.kept_tables.is_some()
            && self.job.menus.len() > open_menus
            && let Menu::Disposition(opened) = self.job.menu()
        {
            let table = opened.table.clone();
            self.job.keep_table(&table);
        }
    }

    fn insert(&mut self, name: &str, path: &Path, tag: u32, span: Span) {
        self.job.output.folder.note_reading(path);
        let read = self
            .within_check(path, span)
            .and_then(|()| self.unsaved.read(path).map_err(|error| Diagnostic::error(error.to_string(), span)));
        if let Ok(text) = &read
            && tag == INMODEL_FILE
            && aqwa::is_deck(text.as_str())
        {
            self.job.menus.pop();
            self.insert_deck(name, path, text.clone(), span);
            return;
        }
        let opened = read.and_then(|text| self.interpreter.open(name, text, tag, Some(span)));
        match opened {
            Ok(id) => self.source_files.push((id, path.to_path_buf())),
            Err(error) => {
                if tag != PLAIN {
                    self.job.menus.pop();
                }
                self.report(*error);
            }
        }
    }

    /// A check reads below the script's folder alone, also where a link leads out of it.
    fn within_check(&self, path: &Path, span: Span) -> Outcome<()> {
        if self.check.is_none() {
            Ok(())
        } else {
            commands::within_check(&self.job, path.to_path_buf(), span).map(drop)
        }
    }

    /// Keeps a record that was executed; of one that reads a file the records of the file are kept, and its menu where it has one.
    fn keep_in_journal(&mut self, text: &str, words: &[Word], effect: &Effect) {
        if self.check.is_some() {
            return;
        }
        let open_menus = self.job.menus.len();
        let reads_menu = matches!(effect, Effect::Insert { tag: INMODEL_FILE, .. });
        let executed = match effect {
            Effect::Insert { .. } | Effect::Deck { .. } if !reads_menu => Executed::Nothing,
            _ => self.executed,
        };
        self.job.journal.keep(text, words, executed, open_menus);
    }

    /// Says what a record has opened and how to leave it: of a result always, of a menu to who types.
    fn say_opened_menu(&mut self, open: usize) {
        if self.job.menus.len() <= open || self.check.is_some() {
            return;
        }
        let typed = self.interactive && self.interpreter.reads_what_is_typed();
        let text = match self.job.menu() {
            Menu::Disposition(result) => {
                let (rows, columns) = (result.table.rows(), result.table.columns().len());
                let leave = if typed { "; &HELP lists what can be done, END returns" } else { "; END returns" };
                format!("{}: {} of {}{leave}", result.table.title, count(rows, "row"), count(columns, "column"))
            }
            Menu::Refused(_) | Menu::Checked(_) => return,
            menu if typed => {
                let (name, end) = (menu.name(), menu.end());
                let leave = if end == "END" { "END leaves it".to_string() } else { format!("END or {end} leaves it") };
                format!("menu {name} is open: {leave}, &HELP lists its records")
            }
            _ => return,
        };
        self.job.say_fitted(|width| page::fold_text(&text, width));
    }

    /// Finds what a record means and does it.
    fn dispatch(&mut self, record: &Record, words: &[Word]) -> Outcome<Effect> {
        let Some(first) = words.first() else {
            if matches!(self.job.menu(), Menu::Building(table) if table.is_brief() && table.has_rows()) {
                self.executed = Executed::Row;
                self.leave_menu(Some(record.whole()));
            }
            return Ok(Effect::Done);
        };
        let word = first.text.to_ascii_uppercase();
        if word == "END" || word.starts_with("END_") {
            return self.end(first, &word, words.get(1..).unwrap_or_default());
        }
        if self.pass_over(first, words) {
            return Ok(Effect::Done);
        }
        if matches!(self.job.menu(), Menu::Building(_)) && first.kind != TokenKind::Internal {
            self.executed = Executed::Row;
            return commands::take_row(&mut self.job, record);
        }
        if matches!(self.job.menu(), Menu::Shapes) && first.kind != TokenKind::Internal {
            self.executed = Executed::Row;
            return commands::take_shape(&mut self.job, words);
        }
        if matches!(self.job.menu(), Menu::Surface)
            && let Some(outcome) = commands::assign_block(&mut self.job, words)
        {
            return outcome;
        }
        match first.kind {
            TokenKind::Class => return self.invoke(in_menu("~CLASS", self.job.menu(), first)?, record, words),
            TokenKind::Point => return self.invoke(in_menu("*POINT", self.job.menu(), first)?, record, words),
            TokenKind::Selector => return self.invoke(in_menu(":SELECTOR", self.job.menu(), first)?, record, words),
            _ => {}
        }
        let parted = self.part_glued_option(words);
        let words = parted.as_deref().unwrap_or(words);
        let Some(first) = words.first() else { return Ok(Effect::Done) };
        let meaning = match self.resolve(first) {
            Ok(meaning) => meaning,
            Err(error) => match plain_word(&first.text) {
                Some(command) if command.spec.name != "&FINISH" || self.interactive => Meaning::Command(command),
                Some(_) => return Err(error.help("&FINISH ends a script")),
                None => return self.without_cascade((first, words), error),
            },
        };
        self.lost_opener = false;
        match meaning {
            Meaning::Command(command) => {
                if let Some(entry) = words.get(1).and_then(|second| absent::find_form(command.spec.name, &second.text))
                {
                    return self.answer_absent(entry, first);
                }
                self.invoke(command, record, words).map_err(|error| self.refuse(command, words, error))
            }
            Meaning::Macro(found) => self.interpreter.call(&found, record).map(|()| Effect::Done),
            Meaning::Absent(entry) => self.answer_absent(entry, first),
        }
    }

    /// Exact command, exact macro, abbreviated command, abbreviated macro: in this order.
    fn resolve(&self, first: &Word) -> Outcome<Meaning> {
        let menu = self.job.menu();
        let internal = first.kind == TokenKind::Internal;
        let names = commands_of_menu(menu.spec())
            .filter(move |c| c.spec.name.starts_with('&') == internal && !c.spec.name.starts_with(['~', '*', ':']))
            .map(|c| (c.spec.name, c.spec.owner, c));
        let controls = CONTROL.iter().filter(move |_| internal).map(|s| (s.name, s.owner));
        let found_macro = macros::find(&first.text, self.interpreter.macros());
        let exact = names.clone().find(|(name, _, _)| name.eq_ignore_ascii_case(&first.text));
        if let (None, Some((true, found))) = (&exact, &found_macro) {
            return Ok(Meaning::Macro(Arc::clone(found)));
        }
        let all = names.clone().map(|(n, o, c)| (n, o, Some(c))).chain(controls.map(|(n, o)| (n, o, None)));
        match keyword(&first.text, all) {
            SearchResult::One(Some(command)) => Ok(Meaning::Command(command)),
            SearchResult::Several(list) => {
                Err(Diagnostic::error(format!("ambiguous command `{}`", first.text), first.span)
                    .label(format!("could be {}", list.join(", "))))
            }
            SearchResult::One(None) | SearchResult::None => match found_macro {
                Some((_, found)) => Ok(Meaning::Macro(Arc::clone(found))),
                None => match absent::find(&first.text, menu.spec()) {
                    Some(entry) => Ok(Meaning::Absent(entry)),
                    None => Err(unknown_name_error(first, menu, names.map(|(n, _, _)| n), self.interpreter.macros())),
                },
            },
        }
    }

    fn invoke(&mut self, command: &'static Command, record: &Record, words: &[Word]) -> Outcome<Effect> {
        let span = words.first().map_or(Span::default(), |w| w.span);
        let args = match command.spec.form {
            _ if self.check.is_some() && record.text().contains(UNKNOWN) => Args::empty(span),
            TextForm::Words => args::read(command.spec, span, words.get(1..).unwrap_or_default(), self.job.units)?,
            TextForm::Text => Args::empty(span),
        };
        let call = Call { record, words, args };
        self.executed = Executed::Command(command);
        if self.check.is_some() && !self.runs_in_check(command, &call)? {
            return Ok(Effect::Done);
        }
        let open = self.job.menus.len();
        let kept = command.edits.then(|| self.job.model.clone());
        let job = &mut self.job;
        let outcome = catch_unwind(AssertUnwindSafe(|| (command.run)(job, &call))).unwrap_or_else(|_| {
            Err(Diagnostic::error(
                format!("internal error in {}; the record was not executed", command.spec.name),
                span,
            )
            .help("please report this record; the session goes on"))
        });
        if SOLVES.contains(&command.spec.name) {
            self.job.refused_solve = outcome.is_err().then_some(command.spec.name);
        }
        if outcome.is_err() {
            self.job.menus.truncate(open);
            if let Some(model) = kept {
                self.job.model = model;
            }
            if command.spec.name == "~CLASS" && !self.interactive {
                commands::keep_refused_class(&mut self.job, words);
            }
        }
        outcome
    }

    /// Leaves the innermost menu.
    fn end(&mut self, first: &Word, word: &str, rest: &[Word]) -> Outcome<Effect> {
        let menu = self.job.menu();
        if self.job.menus.len() < 2 {
            return Err(Diagnostic::error("there is no menu to leave", first.span).help("&FINISH ends the job"));
        }
        // which of these an unknown word was to open is not known for sure
        const OF_HULLS: [&str; 3] = ["END_PGEN", "END_BLOCK", "END_MESH"];
        let is_refused_hull =
            matches!(menu, Menu::Refused(_)) && OF_HULLS.contains(&word) && OF_HULLS.contains(&menu.end());
        if word != "END" && !menu.end().starts_with(word) && !is_refused_hull {
            return Err(Diagnostic::error(format!("{word} does not leave menu {}", menu.name()), first.span)
                .label(format!("expected END or {}", menu.end())));
        }
        let name = menu.name().trim_start_matches('&');
        let names_menu = |word: &Word| {
            let own = word.text.trim_start_matches('&');
            name.get(..own.len()).is_some_and(|head| head.eq_ignore_ascii_case(own))
        };
        if let Some(surplus) = rest.get(usize::from(rest.first().is_some_and(names_menu))) {
            let text = format!("{word} leaves menu {}; `{}` behind it is not read", menu.name(), surplus.text);
            self.job.warn(text, surplus.span);
        }
        self.executed = Executed::Row;
        self.leave_menu(Some(first.span));
        Ok(Effect::Done)
    }

    /// Leaves the innermost menu; `at` is the word that leaves it.
    fn leave_menu(&mut self, at: Option<Span>) {
        if self.job.menus.len() < 2 {
            return;
        }
        if let Some(menu) = self.job.menus.pop() {
            for diagnostic in commands::finish(&mut self.job, menu, at) {
                self.report_at_end(diagnostic);
            }
        }
    }
}

enum Meaning {
    Command(&'static Command),
    Macro(Arc<Macro>),
    /// What MOSES has and windlass does not.
    Absent(&'static Absent),
}
