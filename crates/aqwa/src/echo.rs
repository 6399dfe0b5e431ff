//! The echo of the cards as the listing has it: every card with all fields of its deck's grid, blanks as zeros.
//!
//! Decks 1 to 4 are echoed when the option PRCE asks for it, the others always (so the listings of [AQWA-TETHER 8]).

use super::Deck;
use super::layout::CardRecord;
use super::reader::{Cards, HEADERS};
use windlass_base::fortran::exponent;

/// The echo of one deck.
#[derive(Clone, Debug, PartialEq)]
pub struct Echo {
    /// Number of the deck.
    pub deck: u8,
    /// `DECK 14`; decks of structures `DECK 7.1`; a regular wave `DECK 13N`.
    pub title: String,
    /// A line a card.
    pub lines: Vec<String>,
}

/// How the numbers of a deck are written.
#[derive(Clone, Copy)]
enum Style {
    /// Ten columns, this many decimals.
    Decimals(usize),
    /// Eleven columns, exponent, this many decimals.
    Exponent(usize),
    /// Whole numbers only, zeros left blank.
    Blank,
}

/// Columns of the whole numbers, first column and number of the reals, and their style.
fn grid(deck: u8) -> (&'static [usize], usize, usize, Style) {
    match deck {
        1 => (&[7, 11, 16], 21, 6, Style::Decimals(3)),
        3 => (&[16], 21, 3, Style::Exponent(3)),
        4 => (&[16], 21, 6, Style::Exponent(3)),
        5 | 11 => (&[], 11, 6, Style::Decimals(2)),
        6..=10 => (&[11, 16], 21, 6, Style::Exponent(2)),
        12 | 18 => (&[11, 16, 21, 26], 31, 0, Style::Blank),
        14 => (&[11, 16, 21, 26], 31, 5, Style::Exponent(3)),
        15 => (&[], 21, 6, Style::Decimals(3)),
        17 => (&[11, 16], 21, 6, Style::Decimals(2)),
        _ => (&[11, 16], 21, 6, Style::Decimals(3)),
    }
}

impl Deck {
    /// The echo of the cards, deck by deck.
    pub fn echo(&self) -> Vec<Echo> {
        self.cards
            .iter()
            .map(|cards| {
                let shown = cards.deck > 4 || self.job.option("PRCE");
                let lines = if shown {
                    cards.records.iter().map(|record| line(cards.deck, record)).collect()
                } else {
                    Vec::new()
                };
                Echo { deck: cards.deck, title: title(cards), lines }
            })
            .collect()
    }
}

fn title(cards: &Cards) -> String {
    let deck = cards.deck;
    // the listings number decks 6, 7, 8 and 10 by structure
    let series = ![2, 9].contains(&deck) && HEADERS.iter().any(|(number, _, series)| *number == deck && *series);
    match cards.header.keyword.as_str() {
        "WAVE" => format!("DECK {deck}N"),
        _ if series => format!("DECK {deck}.{}", cards.header.structure.max(1)),
        _ => format!("DECK {deck}"),
    }
}

fn line(deck: u8, record: &CardRecord) -> String {
    let end = if record.last { "END" } else { "" };
    let mut text = format!(" {end:3}{:>2}", record.id);
    let (integers, first, reals, style) = grid(deck);
    if !record.text.is_empty() {
        return format!("{text}{:4}          {}", record.keyword, record.text);
    }
    if !record.keyword.is_empty() || deck == 3 {
        text.push_str(&format!("{:4}", record.keyword));
    }
    if deck == 3 || deck == 4 {
        text.push_str("     ");
    }
    for column in integers {
        let value = record.int(*column).value;
        let width = if *column == 7 { 4 } else { 5 };
        match style {
            Style::Blank if value == 0 => text.push_str("     "),
            _ => text.push_str(&format!("{value:width$}")),
        }
    }
    if deck == 15 {
        text.push_str("          ");
    }
    for k in 0..reals {
        let value = record.real(first + 10 * k).value;
        match style {
            Style::Decimals(decimals) => text.push_str(&format!("{value:10.decimals$}")),
            Style::Exponent(decimals) => text.push_str(&format!("{:>11}", exponent(value, decimals))),
            Style::Blank => {}
        }
    }
    text.trim_end().to_string()
}
