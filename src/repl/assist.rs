//! What the terminal's editor offers while a record is being typed: completion, hints, colours, and whether it goes on. All of it from the
//! lexer and the specs; what could stand where is found in `crate::assist`, as for the editors of `windlass lsp`.

use crate::assist::{Known, candidates, hint_of};
use rustyline::completion::{Completer, FilenameCompleter, Pair};
use rustyline::highlight::{CmdKind, Highlighter};
use rustyline::hint::Hinter;
use rustyline::validate::{ValidationContext, ValidationResult, Validator};
use rustyline::{Context, Helper};
use std::borrow::Cow;
use std::sync::{Arc, Mutex};
use windlass_base::printable::is_acted_on;
use windlass_language::token::{self, TokenKind};

/// Longest line that is painted and hinted at (bytes). A painted line is printed anew with every key: time and output grow as the square of
/// its length.
const LONGEST_PAINTED: usize = 1000;

/// The editor's helper.
pub struct Assistant {
    known: Arc<Mutex<Known>>,
    files: FilenameCompleter,
    colour: bool,
    /// The user answers a question, which is no record.
    pub asking: bool,
}

impl Assistant {
    /// A helper reading these names; `colour` paints the record.
    pub fn new(known: Arc<Mutex<Known>>, colour: bool) -> Self {
        Assistant { known, files: FilenameCompleter::new(), colour, asking: false }
    }
}

impl Completer for Assistant {
    type Candidate = Pair;

    fn complete(&self, line: &str, pos: usize, context: &Context<'_>) -> rustyline::Result<(usize, Vec<Pair>)> {
        if self.asking {
            return Ok((pos, Vec::new()));
        }
        let before = line.get(..pos).unwrap_or(line);
        let Ok(known) = self.known.lock() else { return Ok((pos, Vec::new())) };
        let found = candidates(&known, known.menu(), before);
        drop(known);
        if found.is_file {
            let (start, mut files) = self.files.complete(line, pos, context)?;
            // a name that the terminal would act on cannot be typed either
            files.retain(|file| !file.replacement.contains(is_acted_on));
            return Ok((start, files));
        }
        Ok((found.start, found.words.into_iter().map(as_typed).collect()))
    }
}

/// A candidate as it is shown and as it is typed: a word that is complete is followed by a blank.
fn as_typed(text: String) -> Pair {
    let replacement = match text.as_str() {
        open if open.ends_with('(') => text.clone(),
        several if several.contains(char::is_whitespace) => format!("'{text}' "),
        _ => format!("{text} "),
    };
    Pair { display: text, replacement }
}

impl Hinter for Assistant {
    type Hint = String;

    /// The rest of the record's form, from its spec, once a blank follows what has been typed.
    fn hint(&self, line: &str, pos: usize, _: &Context<'_>) -> Option<String> {
        if self.asking
            || line.len() > LONGEST_PAINTED
            || pos < line.len()
            || !line.ends_with(' ')
            || line.contains('\n')
        {
            return None;
        }
        hint_of(self.known.lock().ok()?.menu(), line)
    }
}

impl Highlighter for Assistant {
    fn highlight<'l>(&self, line: &'l str, _: usize) -> Cow<'l, str> {
        if self.asking || !self.colour || line.len() > LONGEST_PAINTED {
            return Cow::Borrowed(line);
        }
        let mut out = String::with_capacity(line.len() + 32);
        let mut end = 0;
        for token in token::tokens(line) {
            let (Some(gap), Some(text)) = (line.get(end..token.range.start), line.get(token.range.clone())) else {
                continue;
            };
            out.push_str(gap);
            let paint = match token.kind {
                TokenKind::Internal => "\x1b[1;35m",
                TokenKind::Class | TokenKind::Point | TokenKind::Selector | TokenKind::Load => "\x1b[36m",
                TokenKind::Option => "\x1b[33m",
                TokenKind::Number => "\x1b[32m",
                TokenKind::Variable => "\x1b[35m",
                TokenKind::Comment => "\x1b[2m",
                TokenKind::Quoted => "\x1b[32m",
                TokenKind::Word if end == 0 => "\x1b[1m",
                _ => "",
            };
            if paint.is_empty() {
                out.push_str(text);
            } else {
                out.push_str(paint);
                out.push_str(text);
                out.push_str("\x1b[0m");
            }
            end = token.range.end;
        }
        out.push_str(line.get(end..).unwrap_or_default());
        Cow::Owned(out)
    }

    fn highlight_char(&self, line: &str, _: usize, _: CmdKind) -> bool {
        self.colour && line.len() <= LONGEST_PAINTED
    }

    fn highlight_hint<'h>(&self, hint: &'h str) -> Cow<'h, str> {
        if self.colour { Cow::Owned(format!("\x1b[2m{hint}\x1b[0m")) } else { Cow::Borrowed(hint) }
    }
}

impl Validator for Assistant {
    /// A record goes on while its last line, or the one before lines of comment, ends with a lone `\`.
    fn validate(&self, context: &mut ValidationContext) -> rustyline::Result<ValidationResult> {
        let open = !self.asking && context.input().lines().fold(false, |open, line| token::is_continued(line, open));
        Ok(if open { ValidationResult::Incomplete } else { ValidationResult::Valid(None) })
    }
}

impl Helper for Assistant {}
