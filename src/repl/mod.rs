//! The interactive editor: history, completion, hints, colour, blocks over several lines.

mod assist;

use crate::assist::Known;
use crate::commands::undo::UndoStates;
use crate::report::files::Question;
use crate::report::pager::Pager;
use crate::session::{Session, SessionEnd};
use assist::Assistant;
use rustyline::config::Configurer;
use rustyline::error::ReadlineError;
use rustyline::history::FileHistory;
use rustyline::{
    Cmd, CompletionType, ConditionalEventHandler, Config, Editor, Event, EventContext, EventHandler, KeyEvent,
    RepeatCount,
};
use std::io::{BufRead, IsTerminal, Write};
use std::path::PathBuf;
use std::sync::{Arc, Mutex};
use windlass_base::printable::printable;
use windlass_language::record::LONGEST_RECORD;
use windlass_language::source::Text;
use windlass_language::token;

/// Records kept in the history file.
const HISTORY: usize = 5000;

/// The one editor of a session: what is typed ahead waits in it for the next record or question.
type SharedEditor = Editor<Assistant, FileHistory>;

/// Talks with the user until `&FINISH` or Ctrl-D.
pub fn run(session: &mut Session, terminal: bool) {
    session.take_terminal();
    session.interpreter.open_terminal();
    let known = Arc::new(Mutex::new(Known::default()));
    let colour = terminal && std::env::var_os("NO_COLOR").is_none_or(|v| v.is_empty());
    let Ok(mut line) = editor(Assistant::new(Arc::clone(&known), colour)) else { return };
    let history = history_file();
    if let Some(path) = &history {
        // a first run has no history yet
        let _ = line.load_history(path);
    }
    let line = Arc::new(Mutex::new(line));
    let asked = Arc::clone(&line);
    let question: Question = Arc::new(move |prompt: &str| answer(&asked, &printable(prompt)));
    session.job.output.folder.question = terminal.then(|| Arc::clone(&question));
    session.job.ask = Some(question);
    if terminal && std::io::stdout().is_terminal() {
        session.job.output.pager = Pager::new(std::env::var_os("PAGER"), std::env::var_os("LESS"));
    }
    if terminal {
        session
            .job
            .say("windlass: help lists the commands, help WORD looks for a word, Tab completes, quit or Ctrl-D leaves");
    }
    let mut line_number = 1;
    session.job.undo = Some(UndoStates::default());
    while session.run() == SessionEnd::NeedLine {
        UndoStates::take(&mut session.job);
        session.write_page("the terminal waits");
        session.job.output.flush();
        if let Ok(mut known) = known.lock() {
            known.update(session);
        }
        if !terminal {
            let Some(bytes) = read_piped_record() else {
                session.end_of_typing();
                break;
            };
            let lines = bytes.iter().filter(|b| **b == b'\n').count();
            session.interpreter.feed("terminal", Text::from_bytes(bytes), line_number);
            line_number += lines;
            continue;
        }
        let Ok(typed) = line.lock().map(|mut line| line.readline(&prompt(session))) else { break };
        match typed {
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
            Err(_) => {
                session.end_of_typing();
                break;
            }
        }
    }
    if let (Some(path), Ok(mut line)) = (&history, line.lock()) {
        let made = path.parent().map(std::fs::create_dir_all);
        if made.is_some_and(|m| m.is_ok()) {
            // losing the history is no reason to end with an error
            let _ = line.append_history(path);
        }
    }
}

fn editor(assistant: Assistant) -> rustyline::Result<SharedEditor> {
    let config = Config::builder()
        .completion_type(CompletionType::List)
        .completion_show_all_if_ambiguous(true)
        .max_history_size(HISTORY)?
        .auto_add_history(true)
        .build();
    let mut line = Editor::with_config(config)?;
    line.set_helper(Some(assistant));
    line.bind_sequence(KeyEvent::ctrl('C'), EventHandler::Conditional(Box::new(WipeHint)));
    Ok(line)
}

/// What the user answers to a question; `None` when the answer is refused (Ctrl-C, Ctrl-D).
fn answer(line: &Mutex<SharedEditor>, prompt: &str) -> Option<String> {
    let mut line = line.lock().ok()?;
    if let Some(assistant) = line.helper_mut() {
        assistant.asking = true;
    }
    line.set_auto_add_history(false);
    let typed = line.readline(&format!("{prompt}? "));
    line.set_auto_add_history(true);
    if let Some(assistant) = line.helper_mut() {
        assistant.asking = false;
    }
    typed.ok()
}

/// Takes the hint off the screen before Ctrl-C leaves the line as it stands; the cursor is in front of the hint.
struct WipeHint;

impl ConditionalEventHandler for WipeHint {
    fn handle(&self, _: &Event, _: RepeatCount, _: bool, context: &EventContext) -> Option<Cmd> {
        if context.has_hint() {
            let mut screen = std::io::stdout();
            // a screen that is gone has no hint to take off
            let _ = screen.write_all(b"\x1b[J").and_then(|()| screen.flush());
        }
        None
    }
}

/// The next record of a standard input that is no terminal, with the lines it is continued over; `None` at the end.
fn read_piped_record() -> Option<Vec<u8>> {
    let mut bytes = Vec::new();
    loop {
        let start = bytes.len();
        let read = std::io::stdin().lock().read_until(b'\n', &mut bytes);
        let line = String::from_utf8_lossy(bytes.get(start..).unwrap_or_default());
        if !matches!(read, Ok(1..)) {
            return (!bytes.is_empty()).then_some(bytes);
        }
        if !token::is_continued(&line, start > 0) || bytes.len() > LONGEST_RECORD {
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
