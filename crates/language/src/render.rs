//! A message as a person reads it: the record it is about, the word underlined.

use super::source::{Source, Sources, floor_boundary};
use annotate_snippets::{Annotation, AnnotationKind, Group, Level, Renderer, Snippet};
use std::ops::Range;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::printable::{is_acted_on, printable};
use windlass_base::span::Span;

/// The message as printed: headline, place, the record with the word underlined, help lines. What a terminal would act on in the text of
/// records and names is spelled; the colours are the renderer's.
pub fn render(diagnostic: &Diagnostic, sources: &Sources, colour: bool) -> String {
    let diagnostic = shorten_texts(diagnostic);
    let level = match diagnostic.severity {
        Severity::Note => Level::NOTE,
        Severity::Warning => Level::WARNING,
        Severity::Error => Level::ERROR,
        Severity::Fatal => Level::ERROR.with_name("fatal error"),
    };
    let positions = diagnostic
        .span
        .map(|span| (span, AnnotationKind::Primary, diagnostic.label.as_str()))
        .into_iter()
        .chain(diagnostic.other.as_ref().map(|(span, text)| (*span, AnnotationKind::Context, text.as_str())));
    let mut excerpts: Vec<(Excerpt<'_>, Vec<Annotation<'_>>)> = Vec::new();
    for (span, kind, text) in positions {
        let Some(source) = sources.get(span.source) else { continue };
        let excerpt = Excerpt::new(source, span, excerpts.len());
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
                .path(excerpt.mark.as_deref().unwrap_or(&excerpt.name))
                .fold(true)
                .annotations(annotations.clone()),
        );
    }
    for text in &diagnostic.help {
        group = group.element(Level::HELP.message(text.as_str()));
    }
    let renderer = if colour { Renderer::styled() } else { Renderer::plain() };
    let mut text = renderer.render(&[group]);
    for (excerpt, _) in excerpts.iter().filter(|(e, _)| e.mark.is_some()) {
        text = excerpt.with_place(&text, sources);
    }
    text
}

/// The message with every text printable and cut to a length a person reads.
fn shorten_texts(diagnostic: &Diagnostic) -> Diagnostic {
    let cut = |text: &str| match text.char_indices().nth(LONGEST_TEXT) {
        Some((at, _)) => printable(&format!("{} ..", text.get(..at).unwrap_or_default())).into_owned(),
        None => printable(text).into_owned(),
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
    span: Span,
    /// Stands for the place while the message is laid out, where the text shown does not give the column: the line is cut or has
    /// characters spelled.
    mark: Option<String>,
    name: std::borrow::Cow<'a, str>,
    text: std::borrow::Cow<'a, str>,
    line: usize,
    range: Range<usize>,
}

/// Longest text of a message (characters).
const LONGEST_TEXT: usize = 400;
/// Longest piece of a source shown around a word (bytes).
const MAX_EXCERPT_BYTES: usize = 400;

impl<'a> Excerpt<'a> {
    fn same_line(&self, other: &Self) -> bool {
        self.name == other.name && self.line == other.line && self.text == other.text
    }

    /// The message with the place instead of the mark and the numbers behind it.
    fn with_place(&self, text: &str, sources: &Sources) -> String {
        let mark = self.mark.as_deref().unwrap_or_default();
        let Some((head, tail)) = text.split_once(mark) else { return text.to_string() };
        let tail = tail.trim_start_matches(|c: char| c == ':' || c.is_ascii_digit());
        format!("{head}{}{tail}", printable(&sources.location(self.span)))
    }

    fn new(source: &'a Source, span: Span, index: usize) -> Self {
        let text: &str = &source.text;
        let start = floor_boundary(text, span.start as usize);
        let end = floor_boundary(text, span.end as usize).max(start);
        let head = text.get(..start).unwrap_or_default();
        let tail = text.get(end..).unwrap_or_default();
        let from = head.rfind('\n').map_or(0, |i| i + 1);
        let to = tail.find('\n').map_or(text.len(), |i| end + i);
        // the carriage return of a line end is no text
        let to = if text.get(start..to).is_some_and(|line| line.ends_with('\r')) { to - 1 } else { to };
        let end = end.min(to);
        let line = source.first_line + head.bytes().filter(|b| *b == b'\n').count();
        let line_start = from;
        let (from, to, end) = if to - from <= MAX_EXCERPT_BYTES {
            (from, to, end)
        } else {
            let from = floor_boundary(text, start.saturating_sub(60).max(from));
            let end = floor_boundary(text, end.min(start + 80)).max(start);
            (from, floor_boundary(text, (end + 60).min(to)).max(end), end)
        };
        let shown = text.get(from..to).unwrap_or_default();
        let range = start - from..end - from;
        let name = printable(&source.name);
        if !shown.contains(is_acted_on) {
            let mark = (from > line_start).then(|| mark(index));
            return Excerpt { span, mark, name, text: shown.into(), line, range };
        }
        // bytes that are no text stand as NUL in a source
        let legible = |text: &str| printable(&text.replace('\0', "\u{fffd}").replace("\r\n", "\n")).into_owned();
        let moved = |at: usize| legible(shown.get(..at).unwrap_or_default()).len();
        let range = moved(range.start)..moved(range.end);
        Excerpt { span, mark: Some(mark(index)), name, text: legible(shown).into(), line, range }
    }
}

/// A mark that no text has: characters for private use.
fn mark(index: usize) -> String {
    format!("\u{e000}{}\u{e001}", "\u{e002}".repeat(index))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn terminal_control_characters_are_escaped_and_word_stays_underlined() {
        let mut sources = Sources::default();
        let id = sources.add("a\u{1b}.cif", "&TYPE \u{1b}[2J x\u{9b} WRONG\r\nEND\r\n", 1);
        let start = "&TYPE \u{1b}[2J x\u{9b} ".len();
        let error = Diagnostic::error("no \u{202e}such", Span::new(id, start, start + 5)).label("here\u{7}");
        let text = render(&error, &sources, false);
        assert!(!text.chars().any(is_acted_on), "{text:?}");
        for piece in [r"no \u{202e}such", r"a\u{1b}.cif:1:15", r"&TYPE \u{1b}[2J x\u{9b} WRONG", r"^^^^^ here\u{7}"] {
            assert!(text.contains(piece), "{piece}: {text}");
        }
        let lines: Vec<&str> = text.lines().collect();
        let at = |mark: &str| lines.iter().find_map(|l| l.find(mark));
        assert_eq!(at("WRONG"), at("^^^^^"), "{text}");
        // a line that is cut gives its true column
        let long = sources.add("long.cif", format!("{} WRONG {}", "x".repeat(900), "y".repeat(900)), 7);
        let text = render(&Diagnostic::error("no", Span::new(long, 901, 906)), &sources, false);
        assert!(text.contains("long.cif:7:902\n") && text.contains("WRONG"), "{text}");
        let coloured = render(&error, &sources, true);
        assert!(coloured.contains('\u{1b}') && !coloured.contains("\u{1b}[2J"), "{coloured:?}");
    }
}
