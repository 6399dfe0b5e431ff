//! Records: one logical line of text, joined over continuation lines, in which every byte still knows its place.

use super::token::{self, TokenKind};
use std::ops::Range;
use std::sync::Arc;
use windlass_base::span::{SourceId, Span};

/// Longest record taken (bytes), before and after substitution.
pub const LONGEST_RECORD: usize = 1 << 20;

/// A piece of a record's text and the place it came from.
#[derive(Clone, Debug, PartialEq)]
struct TextPiece {
    /// First byte in the record's text.
    at: usize,
    /// Where the piece stands in its source.
    origin: Span,
    /// True when the piece is a copy of its origin, byte for byte; false when it replaced it.
    verbatim: bool,
}

/// The text of one record with the origin of every piece.
#[derive(Clone, Debug, PartialEq, Default)]
pub struct Record {
    text: String,
    pieces: Vec<TextPiece>,
    has_comment: bool,
}

/// One word of a record, ready to be read.
#[derive(Clone, Debug, PartialEq)]
pub struct Word {
    /// What its first characters say it is.
    pub kind: TokenKind,
    /// Its text (quotes taken off).
    pub text: Arc<str>,
    /// Where it stands in the source.
    pub span: Span,
}

impl Record {
    /// A record of one stretch of a source.
    pub fn verbatim(text: &str, origin: Span) -> Self {
        let mut record = Record::default();
        record.push_verbatim(text, origin);
        record
    }

    /// Appends a copy of a stretch of source.
    pub fn push_verbatim(&mut self, text: &str, origin: Span) {
        self.push(text, origin, true);
    }

    /// Appends text that takes the place of `origin`.
    pub fn push_replaced(&mut self, text: &str, origin: Span) {
        self.push(text, origin, false);
    }

    fn push(&mut self, text: &str, origin: Span, verbatim: bool) {
        if !text.is_empty() {
            self.pieces.push(TextPiece { at: self.text.len(), origin, verbatim });
            self.text.push_str(text);
        }
    }

    /// Appends a range of another record, keeping its origins.
    pub fn push_range(&mut self, other: &Record, range: Range<usize>) {
        let Some(text) = other.text.get(range.clone()) else { return };
        let first = other.pieces.partition_point(|p| p.at <= range.start).saturating_sub(1);
        let base = self.text.len();
        for (index, piece) in other.pieces.iter().enumerate().skip(first) {
            if piece.at >= range.end {
                break;
            }
            let from = piece.at.max(range.start);
            let to = other.pieces.get(index + 1).map_or(other.text.len(), |next| next.at).min(range.end);
            if from < to {
                self.pieces.push(TextPiece { at: base + from - range.start, ..piece.clone() });
                if piece.verbatim
                    && from > piece.at
                    && let Some(last) = self.pieces.last_mut()
                {
                    last.origin.start += u32::try_from(from - piece.at).unwrap_or(0);
                }
            }
        }
        self.text.push_str(text);
    }

    /// The text.
    pub fn text(&self) -> &str {
        &self.text
    }

    /// Where a byte range of the text stands in the source. A range inside replaced text is the whole replaced place.
    pub fn span(&self, range: Range<usize>) -> Span {
        let start = self.position(range.start, false);
        let end = self.position(range.end.max(range.start + 1) - 1, true);
        start.join(end)
    }

    fn position(&self, at: usize, last: bool) -> Span {
        let index = self.pieces.partition_point(|p| p.at <= at).saturating_sub(1);
        let Some(piece) = self.pieces.get(index) else { return Span::default() };
        if !piece.verbatim {
            return piece.origin;
        }
        let start = (piece.origin.start as usize + at.saturating_sub(piece.at)).min(piece.origin.end as usize);
        Span::new(piece.origin.source, start, (start + usize::from(last)).min(piece.origin.end as usize))
    }

    /// The words of the record.
    pub fn words(&self) -> Vec<Word> {
        token::words(&self.text)
            .into_iter()
            .map(|token| Word {
                kind: token.kind,
                text: Arc::from(self.text.get(token.range.clone()).unwrap_or_default()),
                span: self.span(token.range),
            })
            .collect()
    }

    /// The first word's text, empty for a blank or comment record.
    pub fn first_word(&self) -> &str {
        let text = self.text.trim_start();
        if text.starts_with('$') {
            return "";
        }
        let end = text.find(|c: char| c.is_whitespace() || c == ',').unwrap_or(text.len());
        text.get(..end).unwrap_or_default()
    }

    /// What follows the first word, as typed, and where: blanks around it and one separating comma taken off.
    pub fn rest(&self) -> (&str, Range<usize>) {
        let lead = self.text.len() - self.text.trim_start().len();
        let from = lead + self.first_word().len();
        let rest = self.text.get(from..).unwrap_or_default();
        let trimmed = rest.trim_start();
        let trimmed = trimmed.strip_prefix(',').map_or(trimmed, str::trim_start);
        let start = self.text.len() - trimmed.len();
        let trimmed = trimmed.trim_end();
        (trimmed, start..start + trimmed.len())
    }

    /// True of a line without anything on it, not even a comment.
    pub fn is_empty_line(&self) -> bool {
        self.is_blank() && !self.has_comment
    }

    /// True when there is nothing to do: blanks or a comment.
    pub fn is_blank(&self) -> bool {
        self.first_word().is_empty() && !self.text.trim_start().starts_with(',')
    }

    /// The span of the whole record.
    pub fn whole(&self) -> Span {
        self.span(0..self.text.len())
    }
}

/// Reads the record that starts at byte `start` of a source: joins continuation lines with a blank and takes comments
/// off, also a line of comment between continued ones. Returns the record, the start of the next, and whether the text
/// ended while a continuation was open.
pub fn read(text: &str, source: SourceId, start: usize) -> (Record, usize, bool) {
    let mut record = Record::default();
    let mut at = start;
    loop {
        let rest = text.get(at..).unwrap_or_default();
        let line_length = rest.find('\n').unwrap_or(rest.len());
        let next = (at + line_length + 1).min(text.len().max(at));
        let line = rest.get(..line_length).unwrap_or_default();
        if line.len() > LONGEST_RECORD {
            record.push_verbatim(line, Span::new(source, at, at + line_length));
            return (record, next, false);
        }
        let (end, _) = token::line_end(line);
        let continued = token::is_continued(line, at != start);
        let kept = line.get(..end).unwrap_or_default();
        record.has_comment |= end < line.trim_end().len();
        if !record.text.is_empty() {
            record.push_replaced(" ", Span::new(source, at, at));
        }
        record.push_verbatim(kept, Span::new(source, at, at + end));
        let finished = at + line_length >= text.len();
        at = next;
        if !continued || finished || record.text.len() > LONGEST_RECORD {
            return (record, at, continued && finished);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn continued_lines_join_and_words_keep_their_lines() {
        let text = "~W B_CAT 4 \\\n  -LEN 500 \\ $ note\n -EMOD 3\nEND\n";
        let mut sources = super::super::source::Sources::default();
        let id = sources.add("a.cif", text, 1);
        let (record, next, open) = read(text, id, 0);
        assert!(!open);
        assert_eq!(&text[next..], "END\n");
        let words = record.words();
        assert_eq!(words.len(), 7);
        assert_eq!(sources.location(words[3].span), "a.cif:2:3");
        assert_eq!(sources.location(words[6].span), "a.cif:3:8");
    }

    #[test]
    fn comment_line_inside_continued_record_is_skipped() {
        let text = "~W B_CAT 4 -LEN 3000 \\\n$ a remark\n   $ another \\\n  -DEP 500\nEND\n";
        let mut sources = super::super::source::Sources::default();
        let id = sources.add("a.cif", text, 1);
        let (record, next, open) = read(text, id, 0);
        assert_eq!((&text[next..], open), ("END\n", false));
        let words = record.words();
        assert_eq!(words.len(), 7, "{}", record.text());
        assert_eq!(sources.location(words[6].span), "a.cif:4:8");
        // a comment that begins a record is a record of its own, and a continued record does not end in one
        assert_eq!(read("$ x \\\nEND\n", id, 0).1, 6);
        assert!(read("A \\\n$ x", id, 0).2);
    }

    #[test]
    fn copied_range_keeps_its_position() {
        let text = "ABC DEF";
        let mut sources = super::super::source::Sources::default();
        let id = sources.add("a", text, 1);
        let (record, _, _) = read(text, id, 0);
        let mut other = Record::default();
        other.push_replaced("xx ", Span::new(id, 0, 3));
        other.push_range(&record, 4..7);
        assert_eq!(other.text(), "xx DEF");
        assert_eq!(sources.location(other.span(3..6)), "a:1:5");
        assert_eq!(other.span(0..2), Span::new(id, 0, 3));
    }
}
