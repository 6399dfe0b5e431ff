//! Places in a text as editors count them: lines from 0, and characters in units of UTF-16 or UTF-8.

use serde_json::{Value, json};
use std::ops::Range;
use windlass_language::source::floor_boundary;

/// What a character of a position is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Encoding {
    /// Bytes.
    Utf8,
    /// Units of UTF-16, what every client understands.
    #[default]
    Utf16,
}

impl Encoding {
    /// The length of a text.
    fn measure(self, text: &str) -> usize {
        match self {
            Encoding::Utf8 => text.len(),
            Encoding::Utf16 => text.chars().map(char::len_utf16).sum(),
        }
    }
}

/// Where the lines of a text begin.
pub struct LineIndex<'t> {
    text: &'t str,
    starts: Vec<usize>,
    encoding: Encoding,
}

impl<'t> LineIndex<'t> {
    /// That of a text.
    pub fn new(text: &'t str, encoding: Encoding) -> Self {
        let starts = std::iter::once(0).chain(text.match_indices('\n').map(|(at, _)| at + 1)).collect();
        LineIndex { text, starts, encoding }
    }

    /// The line of a byte, from 0.
    pub fn line(&self, byte: usize) -> usize {
        self.starts.partition_point(|start| *start <= byte).saturating_sub(1)
    }

    /// The position of a byte; one within a character stands for its beginning.
    pub fn position(&self, byte: usize) -> Value {
        let byte = floor_boundary(self.text, byte);
        let line = self.line(byte);
        let start = self.starts.get(line).copied().unwrap_or(0);
        let character = self.encoding.measure(self.text.get(start..byte).unwrap_or_default());
        json!({"line": line, "character": character})
    }

    /// The range of bytes.
    pub fn range(&self, bytes: Range<usize>) -> Value {
        json!({"start": self.position(bytes.start), "end": self.position(bytes.end)})
    }

    /// The byte of a position; one behind the end of a line or of the text stands for that end.
    pub fn byte(&self, line: u64, character: u64) -> usize {
        let Some(start) = usize::try_from(line).ok().and_then(|line| self.starts.get(line)).copied() else {
            return self.text.len();
        };
        let rest = self.text.get(start..).unwrap_or_default();
        let row = rest.split('\n').next().unwrap_or_default();
        let row = row.strip_suffix('\r').unwrap_or(row);
        let wanted = usize::try_from(character).unwrap_or(usize::MAX);
        let mut units = 0;
        for (at, sign) in row.char_indices() {
            units += self.encoding.measure(sign.encode_utf8(&mut [0; 4]));
            if units > wanted {
                return start + at;
            }
        }
        start + row.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_count_utf16_units_or_bytes_and_come_back() {
        // e acute: 2 bytes, 1 unit; the anchor: 4 bytes, 2 units
        let text = "a\u{e9}\u{1f6a2}b\r\nc\n";
        for (encoding, b) in [(Encoding::Utf16, 4), (Encoding::Utf8, 7)] {
            let index = LineIndex::new(text, encoding);
            assert_eq!(index.position(7), json!({"line": 0, "character": b}));
            assert_eq!(index.byte(0, b), 7);
            assert_eq!(index.position(5), index.position(3), "within a character");
            assert_eq!(index.byte(0, 99), 8, "before the carriage return");
            assert_eq!((index.byte(1, 0), index.byte(1, 1), index.byte(2, 5), index.byte(9, 9)), (10, 11, 12, 12));
            assert_eq!(index.position(99), json!({"line": 2, "character": 0}));
        }
        assert_eq!(LineIndex::new(text, Encoding::Utf16).byte(0, 3), 3, "a half character is the whole one");
    }
}
