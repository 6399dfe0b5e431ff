//! What belongs in the columns of a card, as data: one [`Layout`] a keyword, and the [`Record`] that reading one gives.

use super::card::{Face, Field, Line, WIDTH, integer, real};
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Holds {
    /// A whole number without a point.
    Integer,
    /// A number with or without a point.
    Real,
}

/// One field of a card.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// What it is, for messages.
    pub name: &'static str,
    /// First column.
    pub column: usize,
    /// Number of columns.
    pub width: usize,
    /// What it holds.
    pub holds: Holds,
}

/// A whole number, five columns wide.
pub const fn int(name: &'static str, column: usize) -> Slot {
    Slot { name, column, width: 5, holds: Holds::Integer }
}

/// A number, ten columns wide.
pub const fn num(name: &'static str, column: usize) -> Slot {
    Slot { name, column, width: 10, holds: Holds::Real }
}

impl Slot {
    fn last(&self) -> usize {
        self.column + self.width - 1
    }

    /// `11-15 node 1`.
    fn shown(&self) -> String {
        format!("{}-{} {}", self.column, self.last(), self.name)
    }
}

/// How a card is answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Standing {
    /// Its columns are confirmed by seed 003 or by public pages.
    Sure,
    /// Its columns are from general knowledge: a note says what was assumed.
    Assumed,
    /// The card is known to exist, its columns or its meaning are not: it is refused with this reason.
    Refused(&'static str),
    /// The card is accepted and passed over with this reason.
    Passed(&'static str),
}

/// One kind of card of a deck.
#[derive(Clone, Copy, Debug)]
pub struct Layout {
    /// Keyword of columns 7-10; empty for the cards of decks 1 and 3.
    pub keyword: &'static str,
    /// Its fields, from left to right.
    pub slots: &'static [Slot],
    /// Whether the columns from 11 on are text that the deck itself takes apart (deck 2).
    pub text: bool,
    /// How it is answered.
    pub standing: Standing,
}

impl Layout {
    /// A card whose columns are sure.
    pub const fn new(keyword: &'static str, slots: &'static [Slot]) -> Self {
        Layout { keyword, slots, text: false, standing: Standing::Sure }
    }

    /// A card whose columns are assumed.
    pub const fn assumed(keyword: &'static str, slots: &'static [Slot]) -> Self {
        Layout { keyword, slots, text: false, standing: Standing::Assumed }
    }

    /// A card that is refused for a reason.
    pub const fn refused(keyword: &'static str, reason: &'static str) -> Self {
        Layout { keyword, slots: &[], text: true, standing: Standing::Refused(reason) }
    }

    /// A card that is passed over for a reason.
    pub const fn passed(keyword: &'static str, reason: &'static str) -> Self {
        Layout { keyword, slots: &[], text: true, standing: Standing::Passed(reason) }
    }

    /// A card of text.
    pub const fn text(keyword: &'static str) -> Self {
        Layout { keyword, slots: &[], text: true, standing: Standing::Sure }
    }

    /// The columns of the card in words, for help lines.
    pub fn usage(&self) -> String {
        let fields: Vec<String> = self.slots.iter().map(Slot::shown).collect();
        let fields = if fields.is_empty() { "no fields".to_string() } else { fields.join(", ") };
        format!("columns of {}: {fields}", if self.keyword.is_empty() { "this card" } else { self.keyword })
    }

    /// The fields of a card with this face, by columns or, where those hold no such fields, by blanks.
    ///
    /// # Errors
    /// A message that names the columns and what belongs there.
    pub fn read(&self, deck: &str, line: &Line<'_>, face: &Face<'_>) -> Result<(Record, How), Box<Diagnostic>> {
        let mut record = Record {
            keyword: face.keyword.clone(),
            id: face.id.to_string(),
            last: face.last,
            span: line.whole(),
            place: face.place,
            integers: Vec::new(),
            reals: Vec::new(),
            text: String::new(),
            text_place: line.place_of(face.rest.trim()),
        };
        if self.text {
            let rest = if face.fixed { line.columns(11, WIDTH) } else { face.rest };
            let rest = rest.trim().trim_start_matches(',').trim();
            record.text = rest.split_whitespace().collect::<Vec<_>>().join(" ");
            record.text_place = line.place_of(rest);
            return Ok((record, if face.fixed { How::Columns } else { How::Blanks }));
        }
        if !face.fixed {
            let (integers, reals) = self.by_blanks(line, face.rest).ok_or_else(|| self.by_blanks_error(deck, line))?;
            return Ok((Record { integers, reals, ..record }, How::Blanks));
        }
        let misfit = match self.by_columns(deck, line) {
            Ok((integers, reals)) => return Ok((Record { integers, reals, ..record }, How::Columns)),
            Err(misfit) => misfit,
        };
        // what stands past the last column is no more read by blanks than by columns
        let read = line.columns(11 - 4 * usize::from(self.keyword.is_empty()), WIDTH);
        match self.by_blanks(line, read) {
            Some((integers, reals)) => Ok((Record { integers, reals, ..record }, How::Misfit(misfit))),
            None => Err(misfit),
        }
    }

    fn by_columns(&self, deck: &str, line: &Line<'_>) -> Result<Values, Box<Diagnostic>> {
        let (mut integers, mut reals) = (Vec::new(), Vec::new());
        let mut free = if self.keyword.is_empty() { 7 } else { 11 };
        for slot in self.slots {
            self.nothing_between(deck, line, free, slot.column - 1)?;
            free = slot.last() + 1;
            let text = line.columns(slot.column, slot.last());
            let word = text.trim();
            let span = if word.is_empty() { line.span(slot.column, slot.last()) } else { line.place_of(word) };
            let given = !word.is_empty();
            let wrong = || {
                let kind = if slot.holds == Holds::Integer { "a whole number" } else { "a number" };
                Diagnostic::error(
                    format!("{}, columns {}-{}: `{word}` is not {kind}", self.named(deck), slot.column, slot.last()),
                    span,
                )
                .label(format!("{} belongs here", slot.name))
                .help(self.usage())
            };
            match slot.holds {
                Holds::Integer => {
                    let value = if given { integer(word).ok_or_else(wrong)? } else { 0 };
                    integers.push((slot.column, Field { value, given, span }));
                }
                Holds::Real => {
                    let value = if given { real(word).ok_or_else(wrong)? } else { 0.0 };
                    reals.push((slot.column, Field { value, given, span }));
                }
            }
        }
        self.nothing_between(deck, line, free, WIDTH)?;
        Ok((integers, reals))
    }

    /// A warning where what looks like one number lies across two fields, and was therefore read as two.
    pub fn straddled(&self, deck: &str, line: &Line<'_>) -> Option<Box<Diagnostic>> {
        self.slots.windows(2).find_map(|pair| {
            let [left, right] = pair else { return None };
            let touching = left.last() + 1 == right.column
                && !line.blank(left.last(), left.last())
                && !line.blank(right.column, right.column);
            if !touching {
                return None;
            }
            let before = line.columns(left.column, left.last()).split_whitespace().next_back()?;
            let after = line.columns(right.column, right.last()).split_whitespace().next()?;
            let joined = format!("{before}{after}");
            let span = line.place_of(before).to(line.place_of(after));
            (joined.contains('.') && real(&joined).is_some()).then(|| {
                let message = format!(
                    "{}: `{joined}` lies across two fields and was read as {before} and {after}",
                    self.named(deck)
                );
                Diagnostic::warning(message, span).help(self.usage())
            })
        })
    }

    fn nothing_between(&self, deck: &str, line: &Line<'_>, first: usize, last: usize) -> Result<(), Box<Diagnostic>> {
        if first > last || line.blank(first, last) {
            return Ok(());
        }
        let word = line.columns(first, last).trim();
        let message = format!("{}: `{word}` stands in columns {first}-{last}, which hold no field", self.named(deck));
        Err(Diagnostic::error(message, line.place_of(word)).label("nothing belongs here").help(self.usage()))
    }

    fn by_blanks_error(&self, deck: &str, line: &Line<'_>) -> Box<Diagnostic> {
        Diagnostic::error(format!("{}: the values do not fit the card", self.named(deck)), line.whole())
            .label("neither by columns nor apart by blanks")
            .help(self.usage())
    }

    /// The values apart by blanks or commas: whole numbers fill the whole-number fields from the left until a number
    /// with a point (or the last such field) is met, the others fill the remaining fields.
    fn by_blanks<'a>(&self, line: &Line<'a>, rest: &'a str) -> Option<Values> {
        let blank = Field { value: 0, given: false, span: line.whole() };
        let nought = Field { value: 0.0, given: false, span: line.whole() };
        let of = |holds| self.slots.iter().filter(move |slot| slot.holds == holds);
        let mut integers: Vec<_> = of(Holds::Integer).map(|slot| (slot.column, blank)).collect();
        let mut reals: Vec<_> = of(Holds::Real).map(|slot| (slot.column, nought)).collect();
        let (mut whole, mut next) = (0, 0);
        for word in Line::words(rest).flat_map(apart) {
            let span = line.place_of(word);
            match (integer(word), integers.get_mut(whole)) {
                (Some(value), Some((_, field))) if next == 0 => {
                    *field = Field { value, given: true, span };
                    whole += 1;
                }
                _ => {
                    reals.get_mut(next)?.1 = Field { value: real(word)?, given: true, span };
                    next += 1;
                }
            }
        }
        Some((integers, reals))
    }

    fn named(&self, deck: &str) -> String {
        if self.keyword.is_empty() { deck.to_string() } else { format!("{deck}, {}", self.keyword) }
    }
}

/// How the fields of a card were found.
#[derive(Clone, Debug, PartialEq)]
pub enum How {
    /// By columns.
    Columns,
    /// By blanks, on a card that keeps no columns.
    Blanks,
    /// By blanks, on a card whose face stands in its columns; with what did not fit.
    Misfit(Box<Diagnostic>),
}

/// Numbers that touch, as where a sign fills the last column of a field: `-52.630-329.73543`.
fn apart(word: &str) -> impl Iterator<Item = &str> {
    let bytes = word.as_bytes();
    let begins = move |at: usize| {
        matches!(bytes.get(at), Some(b'+' | b'-'))
            && at.checked_sub(1).and_then(|before| bytes.get(before)).is_some_and(|b| b.is_ascii_digit() || *b == b'.')
    };
    let mut from = 0;
    std::iter::from_fn(move || {
        let to = (from + 1..word.len()).find(|at| begins(*at)).unwrap_or(word.len());
        let piece = word.get(from..to).filter(|piece| !piece.is_empty());
        from = to;
        piece
    })
}

/// Fields by the column they begin in.
type Values = (Vec<(usize, Field<i64>)>, Vec<(usize, Field<f64>)>);

/// A card that was read: its fields are asked for by their first column, as the manuals number them.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Keyword in capitals; empty for the cards of decks 1 and 3.
    pub keyword: String,
    /// The user's identifier.
    pub id: String,
    /// Whether it closed its deck.
    pub last: bool,
    /// The card.
    pub span: Span,
    /// The keyword.
    pub place: Span,
    integers: Vec<(usize, Field<i64>)>,
    reals: Vec<(usize, Field<f64>)>,
    /// What follows the keyword, on cards of text, with single blanks.
    pub text: String,
    /// Its place.
    pub text_place: Span,
}

impl Record {
    /// The whole number that begins in a column; blank where the card has no such field.
    pub fn int(&self, column: usize) -> Field<i64> {
        let blank = Field { value: 0, given: false, span: self.span };
        self.integers.iter().find(|(c, _)| *c == column).map_or(blank, |(_, field)| *field)
    }

    /// The number that begins in a column; blank where the card has no such field.
    pub fn real(&self, column: usize) -> Field<f64> {
        let blank = Field { value: 0.0, given: false, span: self.span };
        self.reals.iter().find(|(c, _)| *c == column).map_or(blank, |(_, field)| *field)
    }

    /// The numbers that begin in the columns `first`, `first` + 10, ..
    pub fn reals<const N: usize>(&self, first: usize) -> [Field<f64>; N] {
        std::array::from_fn(|k| self.real(first + 10 * k))
    }
}
