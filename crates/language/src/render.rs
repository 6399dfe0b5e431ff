//! A message as a person reads it: the record it is about, the word underlined.

use super::source::{Source, Sources, floor_boundary};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::Span;

/// The message as printed: headline, place, the record with the word underlined, help lines.
pub fn render(diagnostic: &Diagnostic, sources: &Sources, colour: bool) -> String {
    let diagnostic = shortened(diagnostic);
    let level = match diagnostic.severity {
        Severity::Note => Level::NOTE,
        Severity::Warning => Level::WARNING,
        Severity::Error => Level::ERROR,
        Severity::Fatal => Level::ERROR.with_name("fatal error"),
    };
    let places = diagnostic
        .span
        .map(|span| (span, AnnotationKind::Primary, diagnostic.label.as_str()))
        .into_iter()
        .chain(diagnostic.other.as_ref().map(|(span, text)| (*span, AnnotationKind::Context, text.as_str())));
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
    let mut group: Group<'_> = Group::with_title(level.primary_title(diagnostic.message.as_str()));
    for (excerpt, annotations) in &excerpts {
        group = group.element(
            Snippet::source(excerpt.text.as_ref())
                .line_start(excerpt.line)
                .path(excerpt.name)
                .fold(true)
                .annotations(annotations.clone()),
        );
    }
    for text in &diagnostic.help {
        group = group.element(Level::HELP.message(text.as_str()));
    }
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    renderer.render(&[group])
}

/// The message with every text cut to a length a person reads.
fn shortened(diagnostic: &Diagnostic) -> Diagnostic {
    let cut = |text: &str| match text.char_indices().nth(LONGEST_TEXT) {
        Some((at, _)) => format!("{} ..", text.get(..at).unwrap_or_default()),
        None => text.to_string(),
    };
    Diagnostic {
        message: cut(&diagnostic.message),
        label: cut(&diagnostic.label),
        other: diagnostic.other.as_ref().map(|(span, text)| (*span, cut(text))),
        help: diagnostic.help.iter().map(|h| cut(h)).collect(),
        ..*diagnostic
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
