//! Carrying out control records: branches, loops, macros, variables.

use super::Interpreter;
use super::frames::{Collected, Collecting, ConditionalBranch, FlowFrame, Trips};
use super::macros::{Macro, control_word};
use super::specs::CONTROL;
use crate::record::Record;
use crate::substitution::{FunctionHost, UNKNOWN, substitute};
use crate::{logic, number};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};

impl Interpreter {
    /// Takes a record into the block being collected.
    pub(super) fn collect(&mut self, record: Record, control: Option<&'static str>) -> Outcome<()> {
        let Some(collecting) = &mut self.collecting else { return Ok(()) };
        let (open, close) = if collecting.macro_block { ("&MACRO", "&ENDMACRO") } else { ("&LOOP", "&ENDLOOP") };
        if control == Some(open) {
            collecting.nested += 1;
        } else if control == Some(close) {
            if collecting.nested == 0 {
                return self.finish_block();
            }
            collecting.nested -= 1;
        }
        // an empty line may be data where the block is executed
        if !record.is_blank() || record.is_empty_line() {
            collecting.body.push(record);
        }
        Ok(())
    }

    fn finish_block(&mut self) -> Outcome<()> {
        let Some(done) = self.collecting.take() else { return Ok(()) };
        let body: Arc<[Record]> = Arc::from(done.body);
        match done.what {
            Collected::Nothing => Ok(()),
            Collected::Loop(trips) => {
                self.frames.push(FlowFrame::Loop { body, at: 0, trips, header: done.span });
                self.trip();
                Ok(())
            }
            Collected::Macro(header) => {
                let key = header.name.to_ascii_uppercase();
                self.macros.insert(key, Arc::new(header.with_body(body)));
                Ok(())
            }
        }
    }

    /// Passes over a record of a branch not taken.
    pub(super) fn skip(
        &mut self,
        record: &Record,
        control: Option<&'static str>,
        world: &mut dyn FunctionHost,
    ) -> Outcome<()> {
        match control {
            Some("&IF") => {
                let depth = self.frames.len();
                self.branches.push(ConditionalBranch {
                    span: record.whole(),
                    active: false,
                    settled: true,
                    unknown: false,
                    depth,
                });
                Ok(())
            }
            Some(name @ ("&ELSEIF" | "&ELSE" | "&ENDIF")) => self.control(name, record, world),
            _ => Ok(()),
        }
    }

    pub(super) fn control(&mut self, name: &'static str, record: &Record, world: &mut dyn FunctionHost) -> Outcome<()> {
        match name {
            "&SET" | "&SET_VAR" | "&LOCAL" => self.assign(name, record, world),
            "&IF" => {
                let depth = self.frames.len();
                let value = self.phrase(record, world);
                let unknown = matches!(value, Ok(None));
                let active = unknown || matches!(value, Ok(Some(true)));
                let settled = (active && !unknown) || value.is_err();
                self.branches.push(ConditionalBranch { span: record.whole(), active, settled, unknown, depth });
                value.map(|_| ())
            }
            "&ELSEIF" | "&ELSE" => self.other_branch(name, record, world),
            "&ENDIF" => {
                if self.branches.last().is_none_or(|b| b.depth != self.frames.len()) {
                    return Err(Diagnostic::error("&ENDIF without an &IF", record.whole()));
                }
                self.branches.pop();
                Ok(())
            }
            "&LOOP" => {
                let trips = substitute(record, &self.variables, world).and_then(|r| read_loop(&r));
                self.begin_block(record, false, trips.map(Collected::Loop))
            }
            "&MACRO" => {
                let header = Macro::header(record).and_then(|header| self.callable(header, world));
                let (header, said) = match header {
                    Ok((header, said)) => (Ok(Collected::Macro(Box::new(header))), said),
                    Err(error) => (Err(error), Ok(())),
                };
                self.begin_block(record, true, header).and(said)
            }
            "&NEXT" | "&EXIT" => {
                let depth = self.frames.len();
                if !matches!(self.frames.last(), Some(FlowFrame::Loop { .. })) {
                    return Err(Diagnostic::error(format!("{name} outside of a &LOOP"), record.whole()));
                }
                // what is not known ends a loop: without an end of its own it would be read for ever
                if record.rest().0.is_empty() || self.phrase(record, world)?.unwrap_or(name == "&EXIT") {
                    self.branches.retain(|b| b.depth < depth);
                    if name == "&EXIT" {
                        self.frames.pop();
                    } else {
                        self.trip();
                    }
                }
                Ok(())
            }
            "&EOFILE" => {
                self.end_of_file();
                Ok(())
            }
            _ => Err(Diagnostic::error(format!("{name} without its beginning"), record.whole())),
        }
    }

    /// Jumps to the end of the innermost source, leaving the loops and macros inside it.
    fn end_of_file(&mut self) {
        while let Some(frame) = self.frames.last_mut() {
            match frame {
                FlowFrame::Source { id, at, .. } => {
                    *at = self.sources.get(*id).map_or(usize::MAX, |s| s.text.len());
                    break;
                }
                FlowFrame::Terminal { .. } => break,
                FlowFrame::Macro { .. } => self.variables.leave(),
                FlowFrame::Loop { .. } => {}
            }
            self.frames.pop();
        }
        let depth = self.frames.len();
        self.branches.retain(|b| b.depth < depth);
    }

    /// A header whose macro can be called, with a warning where a command of some menus has its name.
    fn callable(&self, header: Macro, world: &dyn FunctionHost) -> Outcome<(Macro, Outcome<()>)> {
        let taken = |command: &str, position: &str| {
            Diagnostic::error(format!("macro {} cannot be called{position}", header.name), header.span)
                .label(format!("this is the command {command}"))
        };
        if let Some(control) =
            control_word(&header.name, &self.internal).filter(|n| CONTROL.iter().any(|s| s.name == *n))
        {
            return Err(taken(control, ""));
        }
        match world.menus_of_command(&header.name) {
            None => Ok((header, Ok(()))),
            Some(menus) if menus.is_empty() => Err(taken(&header.name.to_ascii_uppercase(), "")),
            Some(menus) => {
                let mut warning = taken(&header.name.to_ascii_uppercase(), &format!(" in {}", menus.join(", ")));
                warning.severity = Severity::Warning;
                Ok((header, Err(warning)))
            }
        }
    }

    fn begin_block(&mut self, record: &Record, macro_block: bool, what: Outcome<Collected>) -> Outcome<()> {
        let (what, result) = match what {
            Ok(what) => (what, Ok(())),
            Err(error) => (Collected::Nothing, Err(error)),
        };
        let (span, depth) = (record.whole(), self.frames.len());
        self.collecting = Some(Collecting { what, macro_block, span, nested: 0, depth, body: Vec::new() });
        result
    }

    /// The value of the phrase behind a control word; a final `&THEN` is not part of it. None where a check does not know it.
    fn phrase(&self, record: &Record, world: &mut dyn FunctionHost) -> Outcome<Option<bool>> {
        let record = substitute(record, &self.variables, world)?;
        let (text, range) = record.rest();
        if world.is_checking() && text.contains(UNKNOWN) {
            return Ok(None);
        }
        let upper = text.to_ascii_uppercase();
        let text = match upper.rfind("&THEN") {
            Some(at) if at + 5 == upper.len() => text.get(..at).unwrap_or_default(),
            _ => text,
        };
        let text = text.trim_end();
        logic::evaluate(text, record.span(range.start..range.start + text.len())).map(Some)
    }

    fn other_branch(&mut self, name: &str, record: &Record, world: &mut dyn FunctionHost) -> Outcome<()> {
        let depth = self.frames.len();
        let Some(branch) = self.branches.last().filter(|b| b.depth == depth) else {
            return Err(Diagnostic::error(format!("{name} without an &IF"), record.whole()));
        };
        let conditional = name == "&ELSEIF" || !record.rest().0.is_empty();
        if branch.unknown {
            return Ok(());
        }
        let value = if branch.settled || !conditional { Ok(Some(true)) } else { self.phrase(record, world) };
        if let Some(branch) = self.branches.last_mut() {
            branch.unknown = matches!(value, Ok(None));
            branch.active = !branch.settled && matches!(value, Ok(None | Some(true)));
            branch.settled |= (branch.active && !branch.unknown) || value.is_err();
        }
        value.map(|_| ())
    }

    fn assign(&mut self, name: &str, record: &Record, world: &mut dyn FunctionHost) -> Outcome<()> {
        let record = substitute(record, &self.variables, world)?;
        let words = record.words();
        let form = || format!("form: {name} VAR = value (a blank follows the =)");
        let (Some(variable), Some(equals)) = (words.get(1), words.get(2)) else {
            return Err(Diagnostic::error(format!("{name} lacks its variable or its `=`"), record.whole()).help(form()));
        };
        let good = !variable.text.is_empty()
            && variable.text.len() <= 64
            && variable.text.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
        if !good {
            return Err(Diagnostic::error(format!("`{}` cannot name a variable", variable.text), variable.span)
                .label("letters, digits and _ only"));
        }
        let is_older_form = name == "&SET_VAR" && equals.text.as_ref() == ":=";
        if equals.text.as_ref() != "=" && !is_older_form {
            return Err(Diagnostic::error(format!("expected `=` after {}", variable.text), equals.span).help(form()));
        }
        let value = record.rest().0.split_once('=').map_or("", |(_, v)| v).trim_start();
        let value = value.strip_prefix(',').map_or(value, str::trim_start);
        let value = if self.is_unjudged() { UNKNOWN } else { value };
        let done = match name {
            "&LOCAL" => self.variables.set_local(&variable.text, value),
            _ => self.variables.set(&variable.text, value),
        };
        done.map_err(|e| Diagnostic::error(e.to_string(), record.whole()))
    }
}

/// Reads the header of a loop.
fn read_loop(record: &Record) -> Outcome<Trips> {
    let words = record.words();
    let Some(variable) = words.get(1) else { return Ok(Trips::Endless) };
    let rest = words.get(2..).unwrap_or_default();
    if rest.first().is_some_and(|w| w.text.starts_with('(')) {
        let text = record.rest().0;
        let list = text.split_once('(').map_or("", |(_, list)| list);
        let Some(list) = list.trim_end().strip_suffix(')') else {
            return Err(Diagnostic::error("the list of a &LOOP ends with `)`", record.whole()));
        };
        let items = Record::verbatim(list, record.whole()).words();
        let items: Vec<String> = items.iter().map(|w| w.text.to_string()).collect();
        return Ok(Trips::List { variable: variable.text.to_string(), items: items.into_iter() });
    }
    if rest.iter().any(|word| word.text.contains(UNKNOWN)) {
        // a check reads the body once
        let items = vec![UNKNOWN.to_string()];
        return Ok(Trips::List { variable: variable.text.to_string(), items: items.into_iter() });
    }
    let mut bounds = Vec::new();
    for word in rest {
        bounds.push(
            number::evaluate(&word.text)
                .map_err(|e| Diagnostic::error("a bound of &LOOP must be a number", word.span).label(e.to_string()))?,
        );
    }
    let (next, end, step) = match bounds.as_slice() {
        [begin, end] => (*begin, *end, 1.0),
        [begin, end, step] => (*begin, *end, *step),
        _ => {
            return Err(Diagnostic::error(
                "&LOOP takes INDEX BEG END [INCR], VAR ( list ), or nothing",
                record.whole(),
            ));
        }
    };
    for (index, (bound, word)) in bounds.iter().zip(rest).enumerate() {
        let what = if index == 2 { "the increment" } else { "a bound" };
        if bound.fract() != 0.0 {
            return Err(Diagnostic::error(format!("{what} of &LOOP must be a whole number"), word.span)
                .label(format!("this is {bound}")));
        }
        if index == 2 && *bound == 0.0 {
            return Err(Diagnostic::error("the increment of &LOOP may not be zero", word.span));
        }
    }
    Ok(Trips::Count { variable: variable.text.to_string(), next, end, step })
}
