//! A card image: one line of a deck, its columns, and the values that stand in them.
//!
//! Columns are counted from 1, one a character. 1 is blank; 2-4 hold `END` on the last card of a deck; 5-6 an identifier
//! of the user's own; 7-10 the keyword; the rest are fields at fixed columns that may touch (`-52.630-329.73543`), so a
//! card is cut by columns and never at blanks. A blank field is zero.
//!
//! Source: [AQWA-TETHER Appendices A and B]; [AQWA-REF data_prep].

use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::{SourceId, Span};
use windlass_language::source::Source;

/// Last column of a card; what stands further right is not read.
pub const CARD_WIDTH: usize = 80;
/// What stands in a text for a byte that is not UTF-8 (`windlass_language::source::Text`).
const NOT_TEXT: char = '\0';
/// Largest whole number taken (nine digits; the widest field of a deck has ten columns).
const MAX_INTEGER: i64 = 999_999_999;

/// A value of a card as it was given, with its place.
#[derive(Clone, Copy, Debug, PartialEq, Default)]
pub struct Field<T> {
    /// The value; zero for a blank field.
    pub value: T,
    /// Whether anything stands in the field.
    pub given: bool,
    /// Its columns.
    pub span: Span,
}

impl<T: Copy + PartialEq + Default> Field<T> {
    /// The value, or a default where the field is blank or zero (a deck cannot tell the two apart).
    pub fn value_or(&self, default: T) -> T {
        if self.value == T::default() { default } else { self.value }
    }
}

/// One line of a deck that is neither blank nor a comment.
#[derive(Clone, Debug)]
pub struct CardLine<'a> {
    /// The line without its end.
    pub text: &'a str,
    source: SourceId,
    /// Byte offset of the line in its source.
    start: usize,
    /// Whether every character is one byte, so that columns are bytes.
    ascii: bool,
}

/// The lines of a source that say something: no blank line, no comment (first character `*`, `!` or `/`).
#[derive(Clone, Debug)]
pub struct CardLines<'a> {
    rest: &'a str,
    start: usize,
    source: SourceId,
}

impl<'a> CardLines<'a> {
    /// The lines of a source.
    pub fn new(source: &'a Source, id: SourceId) -> Self {
        CardLines { rest: &source.text, start: 0, source: id }
    }
}

impl<'a> Iterator for CardLines<'a> {
    type Item = CardLine<'a>;

    fn next(&mut self) -> Option<CardLine<'a>> {
        while !self.rest.is_empty() {
            let (whole, rest) = self.rest.split_once('\n').unwrap_or((self.rest, ""));
            let start = self.start;
            self.start += whole.len() + 1;
            self.rest = rest;
            let text = whole.trim_end();
            if !text.is_empty() && !text.trim_start().starts_with(['*', '!', '/']) {
                return Some(CardLine { text, source: self.source, start, ascii: text.is_ascii() });
            }
        }
        None
    }
}

impl<'a> CardLine<'a> {
    fn offset(&self, column: usize) -> usize {
        let index = column.saturating_sub(1);
        if self.ascii {
            index.min(self.text.len())
        } else {
            self.text.char_indices().nth(index).map_or(self.text.len(), |(at, _)| at)
        }
    }

    /// What stands in the columns `first` to `last`; shorter or empty where the line ends before.
    pub fn columns(&self, first: usize, last: usize) -> &'a str {
        self.text.get(self.offset(first)..self.offset(last + 1)).unwrap_or_default()
    }

    /// Whether the columns `first` to `last` are blank.
    pub fn blank(&self, first: usize, last: usize) -> bool {
        self.columns(first, last).trim().is_empty()
    }

    /// The place of the columns `first` to `last`; past the end of the line, the place where they would begin.
    pub fn span(&self, first: usize, last: usize) -> Span {
        self.position(self.offset(first), self.offset(last + 1))
    }

    /// The place of bytes of the line.
    pub fn position(&self, from: usize, to: usize) -> Span {
        Span::new(self.source, self.start + from, self.start + to)
    }

    /// The place of a piece of the line (a slice of its text).
    pub fn place_of(&self, piece: &str) -> Span {
        let from = (piece.as_ptr() as usize).saturating_sub(self.text.as_ptr() as usize).min(self.text.len());
        self.position(from, (from + piece.len()).min(self.text.len()))
    }

    /// The place of the line without the blanks before it.
    pub fn whole(&self) -> Span {
        self.place_of(self.text.trim_start())
    }

    /// Whether the line goes on past the last column that is read.
    pub fn overlong(&self) -> bool {
        !self.text.get(self.offset(CARD_WIDTH + 1)..).unwrap_or_default().trim().is_empty()
    }

    /// Whether what stands in the last column that is read goes on past it.
    pub fn is_cut(&self) -> bool {
        !self.blank(CARD_WIDTH, CARD_WIDTH) && !self.blank(CARD_WIDTH + 1, CARD_WIDTH + 1)
    }

    /// Column of the first tab, which belongs to no column, or of the first byte that is no UTF-8 text.
    pub fn stray(&self) -> Option<usize> {
        self.text.chars().position(|c| matches!(c, '\t' | NOT_TEXT)).map(|index| index + 1)
    }

    /// The error of a card with a tab, or a byte that is no text, in a column; `label` names the deck.
    pub fn stray_error(&self, label: &str, column: usize) -> Box<Diagnostic> {
        let span = self.span(column, column);
        if self.columns(column, column) == "\t" {
            return Diagnostic::error(format!("{label}: a tab stands in column {column}"), span)
                .label("fields are found by their columns")
                .help("write blanks in the place of tabs");
        }
        Diagnostic::error(format!("{label}: column {column} holds a byte that is not UTF-8"), span)
            .label("letters, digits, signs and points belong on a card")
            .help("a file of Latin-1 or another code page may have its letters in TITLE and in comments alone; else save it as UTF-8")
    }

    /// The words of a piece of the line: apart by blanks, tabs or commas.
    pub fn words(piece: &'a str) -> impl Iterator<Item = &'a str> {
        piece.split(|c: char| c.is_whitespace() || c == ',').filter(|word| !word.is_empty())
    }
}

/// What stands before the fields of a card.
#[derive(Clone, Debug, PartialEq)]
pub struct Face<'a> {
    /// `END` stands in columns 2-4: the last card of its deck.
    pub last: bool,
    /// The user's identifier, columns 5-6, trimmed.
    pub id: &'a str,
    /// The keyword in capitals; empty on the cards of decks that have none.
    pub keyword: String,
    /// Place of the keyword.
    pub position: Span,
    /// What follows.
    pub rest: &'a str,
}

/// Whether a piece of a line is the word `END` in any case.
fn is_end(piece: &str) -> bool {
    piece.eq_ignore_ascii_case("END")
}

/// Whether a keyword may begin with this.
fn begins_keyword(piece: &str) -> bool {
    piece.starts_with(|c: char| c.is_ascii_alphabetic())
}

impl<'a> Face<'a> {
    /// The face of a card; `keyworded` says whether the cards of its deck have a keyword (all but those of decks 1 and 3).
    ///
    /// # Errors
    /// Which of the columns 1 to 10 hold what does not belong there, or where a tab stands; `label` names the deck.
    pub fn new(line: &CardLine<'a>, label: &str, keyworded: bool) -> Result<Face<'a>, Box<Diagnostic>> {
        if let Some(column) = line.stray() {
            return Err(line.stray_error(label, column));
        }
        let wrong = |first: usize, last: usize, belongs: &str| {
            let stands = line.columns(first, last).trim();
            let columns = if first == last { format!("column {first}") } else { format!("columns {first}-{last}") };
            let (message, span) = if stands.is_empty() {
                (format!("{label}: {columns} are blank"), line.span(first, last))
            } else {
                (format!("{label}: `{stands}` stands in {columns}"), line.place_of(stands))
            };
            Diagnostic::error(message, span).label(belongs).help(
                "a card has END in columns 2-4 where it closes its deck, an identifier in 5-6, its keyword in 7-10",
            )
        };
        if !line.blank(1, 1) {
            return Err(wrong(1, 1, "column 1 is blank"));
        }
        let last = is_end(line.columns(2, 4));
        if !last && !line.blank(2, 4) {
            return Err(wrong(2, 4, "END or nothing belongs in columns 2-4"));
        }
        let id = line.columns(5, 6).trim();
        let word = line.columns(7, 10);
        let (keyword, from) = match (keyworded, begins_keyword(word)) {
            (true, true) if !word.trim_end().contains(char::is_whitespace) => (word.trim_end(), 11),
            (true, false) if line.blank(7, CARD_WIDTH) => ("", 11),
            (true, _) => return Err(wrong(7, 10, "a keyword belongs in columns 7-10")),
            (false, true) => (word.trim_end(), 11),
            (false, false) if id.bytes().all(|b| b.is_ascii_alphanumeric()) => ("", 7),
            (false, false) => return Err(wrong(5, 6, "an identifier of letters and digits belongs in columns 5-6")),
        };
        let rest = line.text.get(line.offset(from)..).unwrap_or_default();
        Ok(Face { last, id, keyword: keyword.to_ascii_uppercase(), position: line.span(7, 10), rest })
    }

    /// Whether a line whose face does not fit seems to close its deck.
    pub fn closes(line: &CardLine<'a>) -> bool {
        let text = line.text.trim_start();
        is_end(text.get(..3).unwrap_or_default()) && !begins_keyword(text.get(3..).unwrap_or_default())
    }
}

/// A whole number as a deck writes it.
pub fn integer(text: &str) -> Option<i64> {
    let digits = text.strip_prefix(['+', '-']).unwrap_or(text);
    if digits.is_empty() || !digits.bytes().all(|b| b.is_ascii_digit()) {
        return None;
    }
    text.parse().ok().filter(|value: &i64| value.abs() <= MAX_INTEGER)
}

/// A real number as a deck writes it: with or without a point, exponent with E or D.
pub fn real(text: &str) -> Option<f64> {
    let allowed = |b: u8| b.is_ascii_digit() || matches!(b, b'+' | b'-' | b'.' | b'E' | b'e' | b'D' | b'd');
    if !text.bytes().all(allowed) {
        return None;
    }
    let value: f64 = text.replace(['d', 'D'], "E").parse().ok()?;
    value.is_finite().then_some(value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_language::source::Sources;

    #[test]
    fn columns_count_characters_and_positions_count_bytes() {
        let mut sources = Sources::default();
        let id = sources.add("a", "* comment\r\n\r\n    01\u{e9}\u{e9} 7\n", 1);
        let lines: Vec<CardLine<'_>> = CardLines::new(sources.get(id).unwrap(), id).collect();
        assert_eq!(lines.len(), 1);
        assert_eq!(lines[0].columns(7, 8), "\u{e9}\u{e9}");
        assert_eq!(lines[0].columns(10, 10), "7");
        assert_eq!(sources.position(lines[0].span(10, 10)), Some((3, 10)));
        assert_eq!(lines[0].columns(60, 70), "");
    }

    #[test]
    fn numbers_are_read_like_fortran_and_finite() {
        assert_eq!(real("1.0E10"), Some(1.0e10));
        assert_eq!(real("-2.5d-3"), Some(-2.5e-3));
        assert_eq!(real("5."), Some(5.0));
        assert_eq!(real(".5"), Some(0.5));
        for bad in ["nan", "inf", "1E999", "1.0-3", "1 0", "", "E5", "0x1"] {
            assert_eq!(real(bad), None, "{bad}");
        }
        assert_eq!(integer("+12"), Some(12));
        for bad in ["1.0", "1 2", "", "-", "99999999999"] {
            assert_eq!(integer(bad), None, "{bad}");
        }
    }
}
