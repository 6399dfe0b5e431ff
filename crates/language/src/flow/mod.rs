//! The flow of records: files inserted into files, branches, loops and macros, down to one substituted record at a
//! time for the session to execute.
//!
//! Source: [MOSES-REF lang_local, lang_loop_if, lang_macros, ams_root].

mod control;
mod frames;
pub mod macros;
pub mod specs;

use super::record::{LONGEST_RECORD, Record};
use super::select::Owner;
use super::source::{Sources, Text};
use super::substitution::{FunctionHost, substitute};
use super::variables::Variables;
use frames::{Collecting, ConditionalBranch, FlowFrame};
use indexmap::IndexMap;
use macros::{Macro, control_word};
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::{SourceId, Span};

/// Deepest nesting of macro calls.
pub const DEEPEST_MACRO: usize = 64;
/// Deepest nesting of inserted files.
pub const DEEPEST_INSERTION: usize = 32;
/// Records executed in a run before it is taken for endless, unless the user says otherwise.
pub const RECORD_BUDGET: u64 = 2_000_000;

/// What the interpreter has to say next.
#[derive(Debug)]
pub enum FlowStep {
    /// A record to execute, every variable replaced.
    Record(Record),
    /// A source that was opened with this tag has been read to its end.
    Ended(u32),
    /// The terminal must give another line.
    NeedLine,
    /// Nothing is left to read.
    Done,
}

/// The interpreter of records.
pub struct Interpreter {
    /// Every text read.
    pub sources: Sources,
    /// The variables.
    pub variables: Variables,
    /// Records that may be executed in a run.
    pub budget: u64,
    /// Plain records are being passed over: one that cannot be substituted comes as it stands.
    pub passing: bool,
    /// Lines without anything on them are data, and come as records.
    pub keeps_empty_lines: bool,
    /// Set by Ctrl-C; the run stops at the next record.
    pub interrupt: Arc<AtomicBool>,
    /// Whether it has ever been set.
    pub was_interrupted: bool,
    frames: Vec<FlowFrame>,
    branches: Vec<ConditionalBranch>,
    collecting: Option<Collecting>,
    macros: IndexMap<String, Arc<Macro>>,
    spent: u64,
    internal: Vec<(&'static str, Owner)>,
}

impl Interpreter {
    /// An interpreter that knows these internal commands besides its own control records (their abbreviations share
    /// one name space).
    pub fn new(internal: impl Iterator<Item = (&'static str, Owner)>) -> Self {
        let internal = specs::CONTROL.iter().map(|s| (s.name, s.owner)).chain(internal).collect();
        Interpreter {
            sources: Sources::default(),
            variables: Variables::default(),
            budget: RECORD_BUDGET,
            passing: false,
            keeps_empty_lines: false,
            interrupt: Arc::new(AtomicBool::new(false)),
            was_interrupted: false,
            frames: Vec::new(),
            branches: Vec::new(),
            collecting: None,
            macros: IndexMap::new(),
            spent: 0,
            internal,
        }
    }

    /// Opens a text and returns its id; it is read before what is already open goes on. `tag` comes back with [`FlowStep::Ended`].
    ///
    /// # Errors
    /// Too many files open inside each other.
    pub fn open(&mut self, name: &str, text: impl Into<Text>, tag: u32, span: Option<Span>) -> Outcome<SourceId> {
        let depth = self.frames.iter().filter(|f| matches!(f, FlowFrame::Source { .. })).count();
        if depth >= DEEPEST_INSERTION {
            let text = format!("files are inserted into each other deeper than {DEEPEST_INSERTION}");
            let mut error = Box::new(Diagnostic::plain(windlass_base::diagnostic::Severity::Error, text));
            error.span = span;
            return Err(error.help("does the file insert itself?"));
        }
        let id = self.sources.add(name, text, 1);
        self.frames.push(FlowFrame::Source { id, at: 0, tag });
        Ok(id)
    }

    /// Opens the terminal as the lowest place to read from.
    pub fn open_terminal(&mut self) {
        self.frames.insert(0, FlowFrame::Terminal { typed: VecDeque::new() });
        for branch in &mut self.branches {
            branch.depth += 1;
        }
        if let Some(collecting) = &mut self.collecting {
            collecting.depth += 1;
        }
    }

    /// Feeds what was typed at the terminal (one record, continuation lines joined by newlines). A new record starts
    /// a new budget.
    pub fn feed(&mut self, name: &str, text: impl Into<Text>, first_line: usize) {
        self.spent = 0;
        let id = self.sources.add(name, text, first_line);
        if let Some(FlowFrame::Terminal { typed }) =
            self.frames.iter_mut().find(|f| matches!(f, FlowFrame::Terminal { .. }))
        {
            typed.push_back((id, 0));
        }
    }

    /// The block that is being typed and not yet closed: `loop`, `macro` or `if`.
    pub fn pending(&self) -> Option<&'static str> {
        match &self.collecting {
            Some(c) if c.macro_block => Some("macro"),
            Some(_) => Some("loop"),
            None => self.branches.last().map(|_| "if"),
        }
    }

    /// Nothing is being read but what is typed.
    pub fn at_terminal(&self) -> bool {
        matches!(self.frames.last(), Some(FlowFrame::Terminal { .. }) | None)
    }

    /// The record that came last stands in what was typed itself: in no loop, macro or file.
    pub fn reads_what_is_typed(&self) -> bool {
        matches!(self.frames.last(), Some(FlowFrame::Terminal { .. }))
    }

    /// Whether a check reads records of which it does not know whether a run would come to them.
    pub fn is_unjudged(&self) -> bool {
        self.branches.iter().any(|branch| branch.unknown)
    }

    /// Abandons everything open but the terminal: after Ctrl-C or a fatal error.
    pub fn unwind(&mut self) {
        self.collecting = None;
        self.branches.clear();
        while let Some(frame) = self.frames.pop() {
            match frame {
                FlowFrame::Macro { .. } => self.variables.leave(),
                FlowFrame::Terminal { .. } => {
                    self.frames.push(FlowFrame::Terminal { typed: VecDeque::new() });
                    return;
                }
                FlowFrame::Source { .. } | FlowFrame::Loop { .. } => {}
            }
        }
    }

    /// Ends what is typed, as the end of a file ends what is read from it.
    ///
    /// # Errors
    /// A block that is not closed; it is given up.
    pub fn end_of_typing(&mut self) -> Outcome<()> {
        self.check_closed()
    }

    /// The macros defined, by name.
    pub fn macros(&self) -> impl Iterator<Item = &Arc<Macro>> {
        self.macros.values()
    }

    /// How the current record was reached, innermost call first, for messages.
    pub fn trace(&self) -> Vec<String> {
        let calls: Vec<(&String, Span)> = self
            .frames
            .iter()
            .rev()
            .filter_map(|f| match f {
                FlowFrame::Macro { name, called, .. } => Some((name, *called)),
                _ => None,
            })
            .collect();
        let mut lines: Vec<String> = calls
            .iter()
            .take(3)
            .map(|(name, called)| format!("in macro {name}, called at {}", self.sources.location(*called)))
            .collect();
        if calls.len() > 3 {
            lines.push(format!("and {} calls further out", calls.len() - 3));
        }
        lines
    }

    /// The next thing to do. Control records are carried out here and never returned.
    ///
    /// # Errors
    /// Whatever is wrong with a control record or a substitution; the flow stays whole and goes on behind it.
    pub fn next_step(&mut self, world: &mut dyn FunctionHost) -> Outcome<FlowStep> {
        loop {
            if self.interrupt.swap(false, Ordering::Relaxed) {
                self.was_interrupted = true;
                self.unwind();
                return Err(Box::new(Diagnostic::plain(windlass_base::diagnostic::Severity::Error, "interrupted")));
            }
            let record = match self.fetch()? {
                Ok(record) => record,
                Err(step) => return Ok(step),
            };
            if record.text().len() > LONGEST_RECORD {
                let text =
                    format!("the record has {} characters; at most {LONGEST_RECORD} are taken", record.text().len());
                return Err(Diagnostic::error(text, record.span(0..40)));
            }
            let is_data = self.keeps_empty_lines && record.is_empty_line();
            if record.is_blank() && self.collecting.is_none() && !is_data {
                continue;
            }
            self.spent += 1;
            if self.spent > self.budget {
                self.unwind();
                let mut error =
                    Diagnostic::error(format!("the run has executed its {} records", self.budget), record.whole());
                error.severity = windlass_base::diagnostic::Severity::Fatal;
                return Err(error.help("an endless &LOOP? &DEVICE -RECORDS n allows more"));
            }
            let control = control_word(record.first_word(), &self.internal);
            if self.collecting.is_some() {
                self.collect(record, control)?;
            } else if self.branches.last().is_some_and(|b| !b.active) {
                self.skip(&record, control, world)?;
            } else if let Some(name) = control.filter(|n| specs::CONTROL.iter().any(|s| s.name == *n)) {
                self.control(name, &record, world)?;
            } else {
                let record = match substitute(&record, &self.variables, world) {
                    Err(_) if self.passing && !record.first_word().starts_with(['&', '%']) => record,
                    substituted => substituted?,
                };
                self.take_assignments(world, record.whole())?;
                return Ok(FlowStep::Record(record));
            }
            self.take_assignments(world, Span::default())?;
        }
    }

    /// Sets the variables that string functions (`&F_READ`) have filled.
    fn take_assignments(&mut self, world: &mut dyn FunctionHost, span: Span) -> Outcome<()> {
        for (name, value) in world.assignments() {
            self.variables.set(&name, &value).map_err(|e| Diagnostic::error(e.to_string(), span))?;
        }
        Ok(())
    }

    /// Calls a macro with the words of a record (the first is its name).
    ///
    /// # Errors
    /// Wrong arguments, or calls nested deeper than [`DEEPEST_MACRO`].
    pub fn call(&mut self, called: &Arc<Macro>, record: &Record) -> Outcome<()> {
        let depth = self.frames.iter().filter(|f| matches!(f, FlowFrame::Macro { .. })).count();
        let span = record.whole();
        if depth >= DEEPEST_MACRO {
            return Err(Diagnostic::error(format!("macros call each other deeper than {DEEPEST_MACRO}"), span));
        }
        let words = record.words();
        let locals = called.locals(
            words.first().map_or(span, |w| w.span),
            words.get(1..).unwrap_or_default(),
            record.rest().0,
        )?;
        self.variables.enter();
        for (name, value) in locals {
            if let Err(error) = self.variables.set_local(&name, &value) {
                self.variables.leave();
                return Err(Diagnostic::error(error.to_string(), span));
            }
        }
        self.frames.push(FlowFrame::Macro {
            name: called.name.clone(),
            body: called.body.clone(),
            at: 0,
            called: span,
        });
        Ok(())
    }
}

#[cfg(test)]
mod tests;
