//! What records are read from: sources, loops and macro calls inside each other, and the blocks that are open in them.

use super::macros::Macro;
use super::{FlowStep, Interpreter};
use crate::record::{self, Record};
use crate::source::Sources;
use std::collections::VecDeque;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::{SourceId, Span};

pub(super) enum FlowFrame {
    /// A text being read from byte `at`.
    Source { id: SourceId, at: usize, tag: u32 },
    /// What was typed at a terminal and is not read yet; each text from a byte.
    Terminal { typed: VecDeque<(SourceId, usize)> },
    /// A loop running over its body.
    Loop { body: Arc<[Record]>, at: usize, trips: Trips, header: Span },
    /// A macro call.
    Macro { name: String, body: Arc<[Record]>, at: usize, called: Span },
}

pub(super) enum Trips {
    Count { variable: String, next: f64, end: f64, step: f64 },
    List { variable: String, items: std::vec::IntoIter<String> },
    Endless,
}

pub(super) struct ConditionalBranch {
    pub(super) span: Span,
    /// The records of the current branch are read.
    pub(super) active: bool,
    /// A branch has been taken, or the whole block is passed over.
    pub(super) settled: bool,
    /// The phrase is not known in a check: all branches from here on are read, none is judged.
    pub(super) unknown: bool,
    /// Number of frames when it was opened.
    pub(super) depth: usize,
}

pub(super) enum Collected {
    Loop(Trips),
    Macro(Box<Macro>),
    /// The header was wrong: the block is read and thrown away.
    Nothing,
}

pub(super) struct Collecting {
    pub(super) what: Collected,
    pub(super) macro_block: bool,
    pub(super) span: Span,
    pub(super) nested: usize,
    pub(super) depth: usize,
    pub(super) body: Vec<Record>,
}

impl Interpreter {
    /// The next raw record, or what to report to the session when the innermost place is empty.
    pub(super) fn fetch(&mut self) -> Outcome<Result<Record, FlowStep>> {
        loop {
            let Some(frame) = self.frames.last_mut() else { return Ok(Err(FlowStep::Done)) };
            match frame {
                FlowFrame::Terminal { typed } => {
                    let Some((id, at)) = typed.front_mut() else { return Ok(Err(FlowStep::NeedLine)) };
                    if let Some((record, _)) = record_at(&self.sources, *id, at)? {
                        return Ok(Ok(record));
                    }
                    typed.pop_front();
                    continue;
                }
                FlowFrame::Source { id, at, tag } => {
                    let tag = *tag;
                    let Some((record, open)) = record_at(&self.sources, *id, at)? else {
                        self.close_frame()?;
                        return Ok(Err(FlowStep::Ended(tag)));
                    };
                    if open {
                        return Err(Diagnostic::error(
                            "the file ends inside a record that is continued",
                            record.whole(),
                        )
                        .label("the last line ends with `\\`"));
                    }
                    return Ok(Ok(record));
                }
                FlowFrame::Macro { body, at, .. } | FlowFrame::Loop { body, at, .. } => {
                    if let Some(record) = body.get(*at).cloned() {
                        *at += 1;
                        return Ok(Ok(record));
                    }
                }
            }
            if matches!(frame, FlowFrame::Macro { .. }) {
                self.close_frame()?;
                continue;
            }
            self.spent += 1;
            let result = self.check_closed();
            self.trip();
            result?;
            if self.spent > self.budget || self.interrupt.load(Ordering::Relaxed) {
                // a loop without records inside: let the caller count this one and stop
                let header = match self.frames.last() {
                    Some(FlowFrame::Loop { header, .. }) => *header,
                    _ => Span::default(),
                };
                return Ok(Ok(Record::verbatim("&LOOP", header)));
            }
        }
    }

    /// Ends the innermost frame; an error names the blocks it left open.
    pub(super) fn close_frame(&mut self) -> Outcome<()> {
        let result = self.check_closed();
        if let Some(FlowFrame::Macro { .. }) = self.frames.pop() {
            self.variables.leave();
        }
        result
    }

    /// Drops the blocks the innermost frame left open and says so.
    pub(super) fn check_closed(&mut self) -> Outcome<()> {
        let depth = self.frames.len();
        let branch = self.branches.iter().find(|b| b.depth >= depth).map(|b| b.span);
        self.branches.retain(|b| b.depth < depth);
        let block = self.collecting.take_if(|c| c.depth >= depth);
        match (block, branch) {
            (None, None) => Ok(()),
            (None, Some(span)) => {
                Err(Diagnostic::error("this &IF is not closed", span).label("expected &ENDIF before the end"))
            }
            (Some(open), branch) => {
                let name = if open.macro_block { "MACRO" } else { "LOOP" };
                let error = Diagnostic::error(format!("this &{name} is not closed"), open.span)
                    .label(format!("expected &END{name} before the end"));
                Err(match branch {
                    Some(span) => error.other(span, "nor is this &IF"),
                    None => error,
                })
            }
        }
    }

    /// Starts the next trip of the innermost loop, or ends it.
    pub(super) fn trip(&mut self) {
        let Some(FlowFrame::Loop { at, trips, .. }) = self.frames.last_mut() else { return };
        *at = 0;
        let assignment = match trips {
            Trips::Endless => return,
            Trips::Count { variable, next, end, step } => {
                let value = *next;
                let more = if *step > 0.0 { value <= *end } else { value >= *end };
                *next += *step;
                more.then(|| (variable.clone(), format!("{value}")))
            }
            Trips::List { variable, items } => items.next().map(|item| (variable.clone(), item)),
        };
        match assignment {
            Some((variable, value)) => {
                // the value of a loop index is short and its name exists after the first trip
                let _ = self.variables.set_local(&variable, &value);
            }
            None => {
                self.frames.pop();
            }
        }
    }
}

/// The record that stands at a byte of a source, and whether the text ends while it is continued; `at` moves behind it.
/// `None` at the end of the text.
///
/// # Errors
/// A record that holds a byte that is no text; `at` has moved on all the same.
fn record_at(sources: &Sources, id: SourceId, at: &mut usize) -> Outcome<Option<(Record, bool)>> {
    let from = *at;
    let Some(source) = sources.get(id).filter(|s| from < s.text.len()) else { return Ok(None) };
    let (record, next, open) = record::read(&source.text, id, from);
    *at = next;
    let Some((bad, byte)) = source.bad_byte(from..next) else { return Ok(Some((record, open))) };
    Err(Diagnostic::error(format!("the byte 0x{byte:02X} is not text"), Span::new(id, bad, bad + 1))
        .label("the record is passed over")
        .help("records are text in UTF-8, without NUL"))
}
