//! What belongs in the columns of a card, as data: one [`CardLayout`] a keyword, and the [`CardRecord`] that reading one gives.
//!
//! A card that does not fit its columns is an error: no value is looked for elsewhere.

use super::card::{CARD_WIDTH, CardLine, Face, Field, integer, real};
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;

/// First column of the name of a file.
const NAME_COLUMN: usize = 21;

/// What a field holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FieldType {
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
    pub holds: FieldType,
    /// Whether a value below 0 has a meaning.
    pub signed: bool,
    /// Whether it is commonly left blank before others: nothing is said of it then.
    pub often_blank: bool,
    /// What holds where it is blank or 0, in words; empty for 0 itself.
    pub default: &'static str,
    /// Whether a blank field has no meaning; one that has reads as 0.
    pub required: bool,
}

/// A whole number, five columns wide.
pub const fn int(name: &'static str, column: usize) -> Slot {
    Slot {
        name,
        column,
        width: 5,
        holds: FieldType::Integer,
        signed: true,
        often_blank: false,
        default: "",
        required: false,
    }
}

/// A number, ten columns wide.
pub const fn num(name: &'static str, column: usize) -> Slot {
    Slot {
        name,
        column,
        width: 10,
        holds: FieldType::Real,
        signed: true,
        often_blank: false,
        default: "",
        required: false,
    }
}

impl Slot {
    /// The same, refused below 0.
    pub const fn not_below_zero(self) -> Self {
        Slot { signed: false, ..self }
    }

    /// The same, of which nothing is said where it is blank.
    pub const fn often_blank(self) -> Self {
        Slot { often_blank: true, ..self }
    }

    /// The same, for which this holds where it is blank or 0.
    pub const fn or(self, default: &'static str) -> Self {
        Slot { default, ..self }
    }

    /// The same, refused where it is blank.
    pub const fn required(self) -> Self {
        Slot { required: true, ..self }
    }

    fn last_column(&self) -> usize {
        self.column + self.width - 1
    }

    /// `11-15 node 1`.
    fn slot_text(&self) -> String {
        format!("{}-{} {}", self.column, self.last_column(), self.name)
    }
}

/// How a card is answered.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CardSupport {
    /// Its columns are confirmed by [AQWA-TETHER] or by public pages of [AQWA-REF].
    Sure,
    /// Its columns are from general knowledge: a note says what was assumed.
    Assumed,
    /// The card is known to exist, its columns or its meaning are not: it is refused with this reason.
    Refused(&'static str),
    /// The card is accepted and passed over with this reason.
    Passed(&'static str),
}

/// How often a card may come.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Repeats {
    /// Any number of times: each card says something of its own.
    Freely,
    /// Once in a deck.
    Once {
        /// A name that cards giving the same quantity share; empty for the keyword alone.
        same: &'static str,
        /// First columns of the whole numbers that distinguish one such card from another (row, structure).
        by: &'static [usize],
        /// Keywords of the cards after which it may come again.
        until: &'static [&'static str],
    },
}

/// Once in a deck.
const ONCE: Repeats = Repeats::Once { same: "", by: &[], until: &[] };

/// One kind of card of a deck.
#[derive(Clone, Copy, Debug)]
pub struct CardLayout {
    /// Keyword of columns 7-10; empty for the cards of decks 1 and 3.
    pub keyword: &'static str,
    /// Its fields, from left to right.
    pub slots: &'static [Slot],
    /// Whether the columns from 11 on are text that the deck itself takes apart (deck 2).
    pub text: bool,
    /// Whether that text is groups in brackets, behind which a remark may stand and go on past the last column.
    pub has_brackets: bool,
    /// How it is answered.
    pub standing: CardSupport,
    /// How often it may come; once unless said otherwise.
    pub repeats: Repeats,
}

impl CardLayout {
    /// A card whose columns are sure.
    pub const fn new(keyword: &'static str, slots: &'static [Slot]) -> Self {
        CardLayout { keyword, slots, text: false, has_brackets: false, standing: CardSupport::Sure, repeats: ONCE }
    }

    /// A card whose columns are assumed.
    pub const fn assume(keyword: &'static str, slots: &'static [Slot]) -> Self {
        CardLayout { standing: CardSupport::Assumed, ..CardLayout::new(keyword, slots) }
    }

    /// A card that is refused for a reason.
    pub const fn refuse(keyword: &'static str, reason: &'static str) -> Self {
        CardLayout { standing: CardSupport::Refused(reason), ..CardLayout::text(keyword) }
    }

    /// A card that is passed over for a reason.
    pub const fn pass_over(keyword: &'static str, reason: &'static str) -> Self {
        CardLayout { standing: CardSupport::Passed(reason), ..CardLayout::text(keyword) }
    }

    /// A card of text.
    pub const fn text(keyword: &'static str) -> Self {
        CardLayout { text: true, ..CardLayout::new(keyword, &[]) }
    }

    /// A card of groups in brackets.
    pub const fn brackets(keyword: &'static str) -> Self {
        CardLayout { has_brackets: true, ..CardLayout::text(keyword) }
    }

    /// Whether the groups of a card end before its last column, so that what goes on past it is a remark.
    pub fn ends_in_remark(&self, line: &CardLine<'_>) -> bool {
        self.has_brackets && line.columns(NAME_COLUMN, CARD_WIDTH).contains(')') && !line.text.ends_with(')')
    }

    /// The card may come any number of times.
    pub const fn freely(self) -> Self {
        CardLayout { repeats: Repeats::Freely, ..self }
    }

    /// The card comes once for each value of the whole numbers that begin in these columns.
    pub const fn repeated_by(self, by: &'static [usize]) -> Self {
        CardLayout { repeats: Repeats::Once { same: "", by, until: &[] }, ..self }
    }

    /// The card may come again after one of these.
    pub const fn repeatable_after(self, until: &'static [&'static str]) -> Self {
        CardLayout { repeats: Repeats::Once { same: "", by: &[], until }, ..self }
    }

    /// The card comes once among those that share a name, and again after one of these.
    pub const fn one_of(self, same: &'static str, until: &'static [&'static str]) -> Self {
        CardLayout { repeats: Repeats::Once { same, by: &[], until }, ..self }
    }

    /// The name of the field that begins in a column.
    pub fn name_of(&self, column: usize) -> &'static str {
        self.slots.iter().find(|slot| slot.column == column).map_or("", |slot| slot.name)
    }

    /// The columns of the card in words, for help lines.
    pub fn usage(&self) -> String {
        let fields: Vec<String> = self.slots.iter().map(Slot::slot_text).collect();
        let fields = if fields.is_empty() { "no fields".to_string() } else { fields.join(", ") };
        format!("columns of {}: {fields}", if self.keyword.is_empty() { "this card" } else { self.keyword })
    }

    /// The fields of a card with this face.
    ///
    /// # Errors
    /// A message that names the columns and what belongs there.
    pub fn read(&self, deck: &str, line: &CardLine<'_>, face: &Face<'_>) -> Result<CardRecord, Box<Diagnostic>> {
        let mut record = CardRecord {
            keyword: face.keyword.clone(),
            id: face.id.to_string(),
            last: face.last,
            span: line.whole(),
            position: face.position,
            integers: Vec::new(),
            reals: Vec::new(),
            text: String::new(),
            text_place: line.place_of(face.rest.trim()),
            name: String::new(),
            name_place: line.span(NAME_COLUMN, CARD_WIDTH),
        };
        if line.is_cut() && !self.ends_in_remark(line) {
            let message = format!("{}: what stands in column {CARD_WIDTH} goes on past it", self.name_with_deck(deck));
            return Err(Diagnostic::error(message, line.span(CARD_WIDTH, CARD_WIDTH + 1))
                .label(format!("a card ends with column {CARD_WIDTH}"))
                .help(self.usage()));
        }
        if self.text {
            let before = line.text.chars().position(|c| c == '(').unwrap_or(CARD_WIDTH);
            if before < 20 {
                let message = format!("{}: a bracket stands before column 21", self.name_with_deck(deck));
                return Err(
                    Diagnostic::error(message, line.span(11, 20)).label("groups in brackets belong in columns 21-80")
                );
            }
            if before < CARD_WIDTH {
                self.nothing_between(deck, line, 21, before)?;
            }
            let rest = line.columns(11, CARD_WIDTH).trim();
            record.text = rest.split_whitespace().collect::<Vec<_>>().join(" ");
            record.text_place = line.place_of(rest);
            let name = line.columns(NAME_COLUMN, CARD_WIDTH).trim();
            record.name = name.to_string();
            if !name.is_empty() {
                record.name_place = line.place_of(name);
            }
            return Ok(record);
        }
        self.check_separation(deck, line)?;
        let (integers, reals) = self.by_columns(deck, line)?;
        self.in_place(deck, line)?;
        Ok(CardRecord { integers, reals, ..record })
    }

    fn by_columns(&self, deck: &str, line: &CardLine<'_>) -> Result<FieldValues, Box<Diagnostic>> {
        let (mut integers, mut reals) = (Vec::new(), Vec::new());
        let mut free = if self.keyword.is_empty() { 7 } else { 11 };
        for slot in self.slots {
            self.nothing_between(deck, line, free, slot.column - 1)?;
            free = slot.last_column() + 1;
            let text = line.columns(slot.column, slot.last_column());
            let word = text.trim();
            let span = if word.is_empty() { line.span(slot.column, slot.last_column()) } else { line.place_of(word) };
            let given = !word.is_empty();
            let wrong = || {
                let kind = if slot.holds == FieldType::Integer { "a whole number" } else { "a number" };
                Diagnostic::error(
                    format!(
                        "{}, columns {}-{}: `{word}` is not {kind}",
                        self.name_with_deck(deck),
                        slot.column,
                        slot.last_column()
                    ),
                    span,
                )
                .label(format!("{} belongs here", slot.name))
                .help(self.usage())
            };
            if slot.required && !given {
                let message = format!(
                    "{}, columns {}-{}: this field is blank",
                    self.name_with_deck(deck),
                    slot.column,
                    slot.last_column()
                );
                return Err(Diagnostic::error(message, span)
                    .label(format!("{} belongs here", slot.name))
                    .help(self.usage()));
            }
            if !slot.signed && real(word).is_some_and(|value| value < 0.0) {
                let message = format!(
                    "{}, columns {}-{}: {word} is below 0",
                    self.name_with_deck(deck),
                    slot.column,
                    slot.last_column()
                );
                return Err(Diagnostic::error(message, span)
                    .label(format!("{} is 0 or above", slot.name))
                    .help(self.usage()));
            }
            match slot.holds {
                FieldType::Integer => {
                    let value = if given { integer(word).ok_or_else(wrong)? } else { 0 };
                    integers.push((slot.column, Field { value, given, span }));
                }
                FieldType::Real => {
                    let value = if given { real(word).ok_or_else(wrong)? } else { 0.0 };
                    reals.push((slot.column, Field { value, given, span }));
                }
            }
        }
        self.nothing_between(deck, line, free, CARD_WIDTH)?;
        Ok((integers, reals))
    }

    /// Refuses neighbouring fields whose values touch so that it cannot be determined where one ends: one number may lie across both.
    ///
    /// A sign begins a number. So does the first column of a field that is filled, if it is a whole number without a zero in front
    /// (numbers of nodes have five digits) or has an exponent and one digit before the point.
    fn check_separation(&self, deck: &str, line: &CardLine<'_>) -> Result<(), Box<Diagnostic>> {
        for pair in self.slots.windows(2) {
            let [left, right] = pair else { continue };
            if left.last_column() + 1 != right.column
                || line.blank(left.last_column(), left.last_column())
                || line.blank(right.column, right.column)
            {
                continue;
            }
            let before = line.columns(left.column, left.last_column()).trim_start();
            let after = line.columns(right.column, right.last_column()).trim_end();
            if after.starts_with(['+', '-']) || (after.len() == right.width && begins_itself(after, right.holds)) {
                continue;
            }
            let message = format!(
                "{}, columns {}-{}: `{before}{after}` lies across two fields",
                self.name_with_deck(deck),
                left.column,
                right.last_column()
            );
            let span = line.place_of(before).join(line.place_of(after));
            return Err(Diagnostic::error(message, span)
                .label(format!("columns {}-{} end with column {}", left.column, left.last_column(), left.last_column()))
                .help("move the number into its columns, or leave a blank between two numbers")
                .help(self.usage()));
        }
        Ok(())
    }

    /// Refuses a value behind a blank field that does not end with its own: as a card that has slipped to the right has it.
    fn in_place(&self, deck: &str, line: &CardLine<'_>) -> Result<(), Box<Diagnostic>> {
        let blank = |slot: &Slot| line.blank(slot.column, slot.last_column());
        let slipped = self.slots.windows(2).find_map(|pair| match pair {
            [left, right] if left.last_column() + 1 == right.column && left.holds == right.holds => {
                (blank(left) && !blank(right) && line.blank(right.last_column(), right.last_column()))
                    .then_some((left, right))
            }
            _ => None,
        });
        let Some((left, right)) = slipped else { return Ok(()) };
        let word = line.columns(right.column, right.last_column()).trim();
        let message = format!(
            "{}, columns {}-{}: `{word}` follows a blank field and does not end with column {}",
            self.name_with_deck(deck),
            right.column,
            right.last_column(),
            right.last_column()
        );
        Err(Diagnostic::error(message, line.place_of(word))
            .label(format!("{} ends with column {}", right.name, right.last_column()))
            .help(format!("if this is {}, it belongs in columns {}-{}", left.name, left.column, left.last_column()))
            .help(self.usage()))
    }

    /// Notes the numbers of a card that are not those in force: fields whose default holds because they are blank or 0, and the first
    /// blank field before another number, which reads as 0. Rows of matrices are written with blanks, and a card without any number is all defaults.
    pub fn blank_notes(&self, deck: &str, record: &CardRecord) -> Vec<Box<Diagnostic>> {
        let mut notes = Vec::new();
        let Some(last) = record.reals.iter().rposition(|(_, field)| field.given) else { return notes };
        let is_row = matches!(self.repeats, Repeats::Once { by, .. } if !by.is_empty());
        let mut reads_as_zero = is_row;
        for (index, (column, field)) in record.reals.iter().enumerate() {
            let Some(slot) = self.slots.iter().find(|slot| slot.column == *column) else { continue };
            let position = format!("{}, columns {column}-{}", self.name_with_deck(deck), slot.last_column());
            let message = if !slot.default.is_empty() && field.value == 0.0 {
                let stands = if field.given { "0 stands here" } else { "this field is blank" };
                format!("{position}: {stands}: the default holds, {}", slot.default)
            } else if slot.default.is_empty() && index < last && !field.given && !slot.often_blank && !reads_as_zero {
                reads_as_zero = true;
                format!("{position}: this field is blank and reads as 0")
            } else {
                continue;
            };
            notes.push(Diagnostic::remark(message, field.span).label(format!("{} belongs here", slot.name)));
        }
        notes
    }

    fn nothing_between(
        &self,
        deck: &str,
        line: &CardLine<'_>,
        first: usize,
        last: usize,
    ) -> Result<(), Box<Diagnostic>> {
        if first > last || line.blank(first, last) {
            return Ok(());
        }
        let word = line.columns(first, last).trim();
        let message =
            format!("{}: `{word}` stands in columns {first}-{last}, which hold no field", self.name_with_deck(deck));
        Err(Diagnostic::error(message, line.place_of(word)).label("nothing belongs here").help(self.usage()))
    }

    fn name_with_deck(&self, deck: &str) -> String {
        if self.keyword.is_empty() { deck.to_string() } else { format!("{deck}, {}", self.keyword) }
    }
}

/// Whether a number that fills its field is the whole of a number, even behind another one.
fn begins_itself(filled: &str, holds: FieldType) -> bool {
    match holds {
        FieldType::Integer => !filled.starts_with('0'),
        FieldType::Real => {
            let mantissa = filled.split(['E', 'e', 'D', 'd']).next().unwrap_or_default();
            mantissa.len() < filled.len() && mantissa.find('.') == Some(1)
        }
    }
}

/// Fields by the column they begin in.
type FieldValues = (Vec<(usize, Field<i64>)>, Vec<(usize, Field<f64>)>);

/// A card that was read: its fields are asked for by their first column, as the manuals number them.
#[derive(Clone, Debug, PartialEq)]
pub struct CardRecord {
    /// Keyword in capitals; empty for the cards of decks 1 and 3.
    pub keyword: String,
    /// The user's identifier.
    pub id: String,
    /// Whether it closed its deck.
    pub last: bool,
    /// The card.
    pub span: Span,
    /// The keyword.
    pub position: Span,
    integers: Vec<(usize, Field<i64>)>,
    reals: Vec<(usize, Field<f64>)>,
    /// What follows the keyword, on cards of text, with single blanks.
    pub text: String,
    /// Its place.
    pub text_place: Span,
    /// Columns 21 to 80 of cards of text as they are: the name of a file.
    pub name: String,
    /// Its place.
    pub name_place: Span,
}

impl CardRecord {
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
