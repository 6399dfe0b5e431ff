//! Texts the program reads, and places in them. Every token keeps its [`Span`] through continuation, substitution,
//! macros and insertions, so that a message can always show the file, line and column it speaks of.

use std::sync::Arc;

/// Identifies one text: a file, a command-line record, a line typed at the terminal.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct SourceId(u32);

/// A byte range of one source.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Default)]
pub struct Span {
    /// Which text.
    pub source: SourceId,
    /// First byte.
    pub start: u32,
    /// One past the last byte.
    pub end: u32,
}

impl Span {
    /// A span of a source; byte offsets past 4 GiB are pinned to the end.
    pub fn new(source: SourceId, start: usize, end: usize) -> Self {
        let pin = |n: usize| u32::try_from(n).unwrap_or(u32::MAX);
        Span { source, start: pin(start), end: pin(end.max(start)) }
    }

    /// The span from the start of this one to the end of `other` (same source), else this one.
    pub fn to(self, other: Span) -> Span {
        if self.source == other.source && other.end >= self.start { Span { end: other.end, ..self } } else { self }
    }
}

/// One text with its name and the number of its first line.
#[derive(Clone, Debug)]
pub struct Source {
    /// What a message calls it: a file name as the user wrote it, `terminal`, `-c`.
    pub name: String,
    /// The text.
    pub text: Arc<str>,
    /// Number of the first line (terminal lines are sources of their own, numbered on).
    pub first_line: usize,
}

/// All texts read in a run; grows only.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    list: Vec<Source>,
}

impl Sources {
    /// Registers a text.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Arc<str>>, first_line: usize) -> SourceId {
        let id = SourceId(u32::try_from(self.list.len()).unwrap_or(u32::MAX));
        self.list.push(Source { name: name.into(), text: text.into(), first_line });
        id
    }

    /// The source of an id.
    pub fn get(&self, id: SourceId) -> Option<&Source> {
        self.list.get(id.0 as usize)
    }

    /// Line (from the source's first line) and column (from 1, in characters) of the start of a span.
    pub fn position(&self, span: Span) -> Option<(usize, usize)> {
        let source = self.get(span.source)?;
        let start = floor_boundary(&source.text, span.start as usize);
        let before = source.text.get(..start)?;
        let line = source.first_line + before.bytes().filter(|b| *b == b'\n').count();
        let line_start = before.rfind('\n').map_or(0, |i| i + 1);
        let column = before.get(line_start..)?.chars().count() + 1;
        Some((line, column))
    }

    /// `file:line:column` of a span.
    pub fn place(&self, span: Span) -> String {
        match (self.get(span.source), self.position(span)) {
            (Some(source), Some((line, column))) => format!("{}:{line}:{column}", source.name),
            _ => "unknown place".to_string(),
        }
    }
}

/// The nearest character boundary at or before a byte offset.
pub fn floor_boundary(text: &str, offset: usize) -> usize {
    let mut at = offset.min(text.len());
    while at > 0 && !text.is_char_boundary(at) {
        at -= 1;
    }
    at
}
