//! Texts the program reads: where a [`Span`] finds its file, line and column.

use std::ops::Range;
use std::sync::Arc;
use windlass_base::span::{SourceId, Span};

/// A text as it was read. A byte that has no place in records (NUL, or one that is not UTF-8) stands in it as NUL, so
/// that every byte keeps its offset.
#[derive(Clone, Debug, Default)]
pub struct Text {
    text: Arc<str>,
    /// The bytes as they were, when some of them are not UTF-8.
    raw: Option<Arc<[u8]>>,
}

impl Text {
    /// Bytes as a text; a byte order mark is taken off.
    pub fn from_bytes(mut bytes: Vec<u8>) -> Self {
        if bytes.starts_with("\u{feff}".as_bytes()) {
            bytes.drain(..'\u{feff}'.len_utf8());
        }
        let bytes = match String::from_utf8(bytes) {
            Ok(text) => return Text { text: text.into(), raw: None },
            Err(error) => error.into_bytes(),
        };
        let mut text = String::with_capacity(bytes.len());
        for chunk in bytes.utf8_chunks() {
            text.push_str(chunk.valid());
            text.extend(std::iter::repeat_n('\0', chunk.invalid().len()));
        }
        Text { text: text.into(), raw: Some(bytes.into()) }
    }
}

impl Text {
    /// The text.
    pub fn as_str(&self) -> &str {
        &self.text
    }
}

impl From<String> for Text {
    fn from(text: String) -> Self {
        Text::from_bytes(text.into_bytes())
    }
}

impl From<&str> for Text {
    fn from(text: &str) -> Self {
        Text::from(text.to_string())
    }
}

/// One text with its name and the number of its first line.
#[derive(Clone, Debug)]
pub struct Source {
    /// What a message calls it: a file name as the user wrote it, `terminal`, `-c`.
    pub name: String,
    /// The text.
    pub text: Arc<str>,
    /// The bytes as they were, when some of them are not UTF-8.
    raw: Option<Arc<[u8]>>,
    /// Number of the first line (terminal lines are sources of their own, numbered on).
    pub first_line: usize,
}

impl Source {
    /// The first byte of a range that has no place in records: where it is, and what.
    pub fn bad_byte(&self, range: Range<usize>) -> Option<(usize, u8)> {
        let at = range.start + self.text.get(range)?.find('\0')?;
        Some((at, self.raw.as_ref().and_then(|raw| raw.get(at).copied()).unwrap_or(0)))
    }
}

/// Largest file or stream that is read (bytes).
pub const LARGEST_FILE: u64 = 256 << 20;

/// All texts read in a run; grows only.
#[derive(Clone, Debug, Default)]
pub struct Sources {
    list: Vec<Source>,
}

impl Sources {
    /// Registers a text.
    pub fn add(&mut self, name: impl Into<String>, text: impl Into<Text>, first_line: usize) -> SourceId {
        let id = SourceId::new(self.list.len());
        let Text { text, raw } = text.into();
        self.list.push(Source { name: name.into(), text, raw, first_line });
        id
    }

    /// The source of an id.
    pub fn get(&self, id: SourceId) -> Option<&Source> {
        self.list.get(id.index())
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
    pub fn location(&self, span: Span) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_byte_keeps_its_position_and_bad_bytes_are_found() {
        let mut sources = Sources::default();
        let id = sources.add("a", Text::from_bytes(b"\xef\xbb\xbfa\xe9b\n\0\n\xc3\xa9\xff".to_vec()), 1);
        let source = sources.get(id).unwrap();
        assert_eq!(&*source.text, "a\0b\n\0\n\u{e9}\0");
        assert_eq!(source.bad_byte(0..4), Some((1, 0xe9)));
        assert_eq!(source.bad_byte(4..6), Some((4, 0)));
        assert_eq!(source.bad_byte(6..9), Some((8, 0xff)));
        assert_eq!(source.bad_byte(6..8), None);
        assert_eq!(sources.location(Span::new(id, 8, 9)), "a:3:2");
    }
}
