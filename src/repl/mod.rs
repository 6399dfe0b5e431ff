//! The interactive editor: history, completion, hints, colour, blocks over several lines.

mod assist;

use crate::language::record::LONGEST_RECORD;
use crate::language::source::Text;
use crate::language::token;
use crate::session::{End, Session};
use assist::{Assistant, Known};
use rustyline::error::ReadlineError;
use rustyline::history::FileHistory;
use rustyline::{CompletionType, Config, Editor};
use std::io::BufRead;
use std::path::PathBuf;
use std::sync::{Arc, Mutex};

/// Records kept in the history file.
const HISTORY: usize = 5000;

/// Talks with the user until `&FINISH` or Ctrl-D.
pub fn run(session: &mut Session, terminal: bool) {
    session.take_terminal();
    session.interpreter.open_terminal();
    let known = Arc::new(Mutex::new(Known::default()));
    let config = Config::builder()
        .completion_type(CompletionType::List)
        .max_history_size(HISTORY)
        .map(|b| b.auto_add_history(true).build())
        .unwrap_or_default();
    let Ok(mut editor) = Editor::<Assistant, FileHistory>::with_config(config) else { return };
    let colour = terminal && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    editor.set_helper(Some(Assistant::new(Arc::clone(&known), colour)));
    let history = history_file();
    if let Some(path) = &history {
        // a first run has no history yet
        let _ = editor.load_history(path);
    }
    session.job.ask = Some(Box::new(|prompt: &str| {
        let mut asker = rustyline::DefaultEditor::new().ok()?;
        asker.readline(&format!("{prompt}? ")).ok()
    }));
    if terminal {
        session.job.say("windlass: &HELP lists the commands, Tab completes, Ctrl-D leaves");
    }
    let mut line_number = 1;
    while session.run() == End::NeedLine {
        session.job.output.flush();
        if let Ok(mut known) = known.lock() {
            known.update(session);
        }
        if !terminal {
            let Some(bytes) = piped() else { break };
            let lines = bytes.iter().filter(|b| **b == b'\n').count();
            session.interpreter.feed("terminal", Text::from_bytes(bytes), line_number);
            line_number += lines;
            continue;
        }
        match editor.readline(&prompt(session)) {
            Ok(line) => {
                session.interpreter.feed("terminal", line.as_str(), line_number);
                line_number += line.lines().count().max(1);
            }
            Err(ReadlineError::Interrupted) => {
                if session.interpreter.pending().is_some() {
                    session.interpreter.unwind();
                    session.job.say("the open block is given up");
                }
            }
            Err(_) => break,
        }
    }
    if let Some(path) = &history {
        let made = path.parent().map(std::fs::create_dir_all);
        if made.is_some_and(|m| m.is_ok()) {
            // losing the history is no reason to end with an error
            let _ = editor.append_history(path);
        }
    }
}

/// The next record of a standard input that is no terminal, with the lines it is continued over; `None` at the end.
fn piped() -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    loop {
        let start = bytes.len();
        let read = std::io::stdin().lock().read_until(b'\n', &mut bytes);
        let line = String::from_utf8_lossy(bytes.get(start..).unwrap_or_default());
        if !matches!(read, Ok(1..)) {
            return (!bytes.is_empty()).then_some(bytes);
        }
        if !token::goes_on(&line, start > 0) || bytes.len() > LONGEST_RECORD {
            return Some(bytes);
        }
    }
}

/// The menu, and the block being typed.
fn prompt(session: &Session) -> String {
    match session.interpreter.pending() {
        Some(block) => format!("{block} ... "),
        None => format!("{}> ", session.job.menu().name()),
    }
}

/// `$XDG_STATE_HOME/windlass/history`, or below `~/.local/state`.
fn history_file() -> Option<PathBuf> {
    let set = |name: &str| std::env::var_os(name).filter(|v| !v.is_empty()).map(PathBuf::from);
    let state = set("XDG_STATE_HOME").or_else(|| set("HOME").map(|home| home.join(".local").join("state")))?;
    Some(state.join("windlass").join("history"))
}
