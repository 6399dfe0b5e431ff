//! Messages with a place: what is wrong, the word it is wrong with, what was expected, and the nearest known name.

use super::source::{Source, Sources, Span, floor_boundary};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;

/// How serious a message is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// Worth knowing; nothing was refused.
    Note,
    /// Accepted, but probably not what was meant.
    Warning,
    /// The record was refused and changed nothing.
    Error,
    /// The run ends.
    Fatal,
}

/// A message about a place in the input.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// How serious.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// The word it is about.
    pub span: Option<Span>,
    /// What stands under the underlined word, e.g. `expected a number`.
    pub label: String,
    /// A second place with its own text, e.g. where a name was defined first.
    pub other: Option<(Span, String)>,
    /// Further lines: what to write instead, candidates, how the place was reached.
    pub help: Vec<String>,
}

/// What almost everything in the language returns.
pub type Outcome<T> = Result<T, Box<Diagnostic>>;

impl Diagnostic {
    /// An error at a word.
    pub fn error(message: impl Into<String>, span: Span) -> Box<Self> {
        Box::new(Self::plain(Severity::Error, message).at(span))
    }

    /// A warning at a word.
    pub fn warning(message: impl Into<String>, span: Span) -> Box<Self> {
        Box::new(Self::plain(Severity::Warning, message).at(span))
    }

    /// A note at a word.
    pub fn remark(message: impl Into<String>, span: Span) -> Box<Self> {
        Box::new(Self::plain(Severity::Note, message).at(span))
    }

    /// A message without a place.
    pub fn plain(severity: Severity, message: impl Into<String>) -> Self {
        Diagnostic {
            severity,
            message: message.into(),
            span: None,
            label: String::new(),
            other: None,
            help: Vec::new(),
        }
    }

    fn at(mut self, span: Span) -> Self {
        self.span = Some(span);
        self
    }

    /// Adds the text under the underlined word.
    pub fn label(mut self: Box<Self>, text: impl Into<String>) -> Box<Self> {
        self.label = text.into();
        self
    }

    /// Adds a help line.
    pub fn help(mut self: Box<Self>, text: impl Into<String>) -> Box<Self> {
        self.help.push(text.into());
        self
    }

    /// Adds a second place.
    pub fn other(mut self: Box<Self>, span: Span, text: impl Into<String>) -> Box<Self> {
        self.other = Some((span, text.into()));
        self
    }

    /// The message with every text cut to a length a person reads.
    fn shortened(&self) -> Diagnostic {
        let cut = |text: &str| match text.char_indices().nth(LONGEST_TEXT) {
            Some((at, _)) => format!("{} ..", text.get(..at).unwrap_or_default()),
            None => text.to_string(),
        };
        Diagnostic {
            message: cut(&self.message),
            label: cut(&self.label),
            other: self.other.as_ref().map(|(span, text)| (*span, cut(text))),
            help: self.help.iter().map(|h| cut(h)).collect(),
            ..*self
        }
    }

    /// The message as printed: headline, place, the record with the word underlined, help lines.
    pub fn render(&self, sources: &Sources, colour: bool) -> String {
        self.shortened().rendered(sources, colour)
    }

    fn rendered(&self, sources: &Sources, colour: bool) -> String {
        let level = match self.severity {
            Severity::Note => Level::NOTE,
            Severity::Warning => Level::WARNING,
            Severity::Error => Level::ERROR,
            Severity::Fatal => Level::ERROR.with_name("fatal error"),
        };
        let places = self
            .span
            .map(|span| (span, AnnotationKind::Primary, self.label.as_str()))
            .into_iter()
            .chain(self.other.as_ref().map(|(span, text)| (*span, AnnotationKind::Context, text.as_str())));
        let mut excerpts: Vec<(Excerpt<'_>, Vec<Annotation<'_>>)> = Vec::new();
        for (span, kind, text) in places {
            let Some(source) = sources.get(span.source) else { continue };
            let excerpt = Excerpt::of(source, span);
            let mut annotation = kind.span(excerpt.range.clone());
            if !text.is_empty() {
                annotation = annotation.label(text);
            }
            match excerpts.iter_mut().find(|(e, _)| e.same_line(&excerpt)) {
                Some((_, annotations)) => annotations.push(annotation),
                None => excerpts.push((excerpt, vec![annotation])),
            }
        }
        let mut group: Group<'_> = Group::with_title(level.primary_title(self.message.as_str()));
        for (excerpt, annotations) in &excerpts {
            group = group.element(
                Snippet::source(excerpt.text.as_ref())
                    .line_start(excerpt.line)
                    .path(excerpt.name)
                    .fold(true)
                    .annotations(annotations.clone()),
            );
        }
        for text in &self.help {
            group = group.element(Level::HELP.message(text.as_str()));
        }
        let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
        renderer.render(&[group])
    }
}

/// The lines around a span, cut so that a huge record does not become a huge message.
struct Excerpt<'a> {
    name: &'a str,
    text: std::borrow::Cow<'a, str>,
    line: usize,
    range: Range<usize>,
}

/// Longest text of a message (characters).
const LONGEST_TEXT: usize = 400;
/// Longest piece of a source shown around a word (bytes).
const SHOWN: usize = 400;

impl<'a> Excerpt<'a> {
    fn same_line(&self, other: &Self) -> bool {
        self.name == other.name && self.line == other.line && self.text == other.text
    }

    fn of(source: &'a Source, span: Span) -> Self {
        let text: &str = &source.text;
        let start = floor_boundary(text, span.start as usize);
        let end = floor_boundary(text, span.end as usize).max(start);
        let head = text.get(..start).unwrap_or_default();
        let tail = text.get(end..).unwrap_or_default();
        let from = head.rfind('\n').map_or(0, |i| i + 1);
        let to = tail.find('\n').map_or(text.len(), |i| end + i);
        let line = source.first_line + head.bytes().filter(|b| *b == b'\n').count();
        let (from, to, end) = if to - from <= SHOWN {
            (from, to, end)
        } else {
            let from = floor_boundary(text, start.saturating_sub(60).max(from));
            let end = floor_boundary(text, end.min(start + 80)).max(start);
            (from, floor_boundary(text, (end + 60).min(to)).max(end), end)
        };
        let shown = text.get(from..to).unwrap_or_default();
        let range = start - from..end - from;
        if !shown.contains('\0') {
            return Excerpt { name: &source.name, text: shown.into(), line, range };
        }
        // bytes that are no text stand as NUL in a source
        let legible = |text: &str| text.replace('\0', "\u{fffd}");
        let moved = |at: usize| legible(shown.get(..at).unwrap_or_default()).len();
        Excerpt { name: &source.name, text: legible(shown).into(), line, range: moved(range.start)..moved(range.end) }
    }
}

/// The names nearest to a word, best first, for "did you mean"; at most three, none when nothing is near.
pub fn nearest<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Vec<&'a str> {
    let folded = word.to_ascii_uppercase();
    let mut scored: Vec<(f64, &str)> = names
        .into_iter()
        .map(|name| (strsim::jaro_winkler(&folded, &name.to_ascii_uppercase()), name))
        .filter(|(score, _)| *score > 0.8)
        .collect();
    scored.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(b.1)));
    scored.dedup_by(|a, b| a.1 == b.1);
    scored.into_iter().take(3).map(|(_, name)| name).collect()
}

/// `did you mean A, B or C?` for a help line; `None` when nothing is near.
pub fn did_you_mean<'a>(word: &str, names: impl IntoIterator<Item = &'a str>) -> Option<String> {
    let near = nearest(word, names);
    match near.as_slice() {
        [] => None,
        [one] => Some(format!("did you mean {one}?")),
        [first @ .., last] => Some(format!("did you mean {} or {last}?", first.join(", "))),
    }
}
