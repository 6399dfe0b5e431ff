//! What the reader of a deck has to say: errors, warnings and notes with their places, in the order met.

use std::collections::BTreeSet;
use windlass_base::diagnostic::{Diagnostic, Severity};

/// Most messages kept of one deck; a file that is no deck has one a line.
const MAX_MESSAGES: usize = 200;

/// The messages of one reading.
#[derive(Clone, Debug, Default)]
pub struct Remarks {
    list: Vec<Diagnostic>,
    said: BTreeSet<String>,
    dropped: usize,
    failed: bool,
}

impl Remarks {
    /// Adds a message; after the first 200, only their number is kept.
    #[allow(clippy::boxed_local, reason = "messages travel in a box, as the error of a result")]
    pub fn add(&mut self, message: Box<Diagnostic>) {
        self.failed |= matches!(message.severity, Severity::Error | Severity::Fatal);
        if self.list.len() < MAX_MESSAGES {
            self.list.push(*message);
        } else {
            self.dropped += 1;
        }
    }

    /// Adds a message unless one under the same key was added before.
    pub fn add_once(&mut self, key: &str, message: impl FnOnce() -> Box<Diagnostic>) {
        if self.said.insert(key.to_string()) {
            self.add(message());
        }
    }

    /// Keeps the value of a result, or adds its error.
    pub fn keep<T>(&mut self, result: Result<T, Box<Diagnostic>>) -> Option<T> {
        result.map_err(|error| self.add(error)).ok()
    }

    /// Adds all messages of another reading.
    pub fn take_over(&mut self, other: Remarks) {
        other.list.into_iter().for_each(|message| self.add(Box::new(message)));
        self.dropped += other.dropped;
    }

    /// Whether an error was added.
    pub fn has_error(&self) -> bool {
        self.failed
    }

    /// All messages; the last one says how many more there were.
    pub fn into_list(mut self) -> Vec<Diagnostic> {
        if self.dropped > 0 {
            let text = format!("{} more messages about this deck are not shown", self.dropped);
            self.list.push(Diagnostic::plain(Severity::Note, text));
        }
        self.list
    }
}
