//! Goes through the cards of a file deck by deck: headers, `END`, `NONE`, `FINI`, and cards whose decks are missing.

use super::card::{CardLine, CardLines, Face};
use super::layout::{CardLayout, CardRecord, CardSupport};
use super::nodes;
use super::remarks::Remarks;
use super::repeats;
use windlass_base::diagnostic::{Diagnostic, did_you_mean};
use windlass_base::span::{SourceId, Span};
use windlass_language::source::Source;

/// Most cards of a file.
const MAX_CARDS: usize = 200_000;
/// Longest line that is taken for a card of 80 columns with a remark behind it (bytes).
const LONGEST_LINE: usize = 1000;

/// Header keywords of the decks 1 to 20; those of per-structure decks are followed by the number of the structure.
pub const HEADERS: &[(u8, &[&str], bool)] = &[
    (1, &["COOR"], false),
    (2, &["ELM"], true),
    (3, &["MATE"], false),
    (4, &["GEOM"], false),
    (5, &["GLOB"], false),
    (6, &["FDR"], true),
    (7, &["WFS"], true),
    (8, &["DRC"], true),
    (9, &["DRM"], true),
    (10, &["HLD"], true),
    (11, &["ENVR"], false),
    (12, &["CONS"], false),
    (13, &["SPEC", "WAVE"], false),
    (14, &["MOOR"], false),
    (15, &["STRT"], false),
    (16, &["TINT"], false),
    (17, &["HYDC"], false),
    (18, &["PROP"], false),
    (19, &[], false),
    (20, &[], false),
];

/// The header of a deck.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// Keyword without the number of the structure: `COOR`, `ELM`, `NONE`, `FINI`.
    pub keyword: String,
    /// The user's identifier, by custom the number of the deck.
    pub id: String,
    /// Number of the structure, on the headers of per-structure decks.
    pub structure: i64,
    /// The keyword.
    pub span: Span,
}

/// The cards of one deck (of one structure, for per-structure decks).
#[derive(Clone, Debug, PartialEq)]
pub struct Cards {
    /// Number of the deck.
    pub deck: u8,
    /// Its header.
    pub header: Header,
    /// Its cards; none for NONE and FINI.
    pub records: Vec<CardRecord>,
}

/// Goes through the cards of a file.
pub struct CardReader<'a> {
    lines: CardLines<'a>,
    current: Option<CardLine<'a>>,
    taken: usize,
    end: Span,
    /// Messages so far.
    pub remarks: Remarks,
}

/// The deck, and the number of the structure, that a header keyword announces; 0 for NONE and FINI.
fn parse_header(word: &str) -> Option<(u8, &'static str, i64)> {
    if word == "NONE" || word == "FINI" {
        return Some((0, if word == "NONE" { "NONE" } else { "FINI" }, 0));
    }
    HEADERS.iter().find_map(|(deck, names, numbered)| {
        let name = names.iter().find(|name| word.starts_with(**name))?;
        let rest = word.get(name.len()..)?;
        match (numbered, rest.is_empty()) {
            (false, true) => Some((*deck, *name, 1)),
            (true, false) if rest.len() <= 2 => Some((*deck, *name, rest.parse().ok().filter(|n| *n > 0)?)),
            _ => None,
        }
    })
}

impl<'a> CardReader<'a> {
    /// A reader at the first card of a source.
    pub fn new(source: &'a Source, id: SourceId) -> Self {
        let end = Span::new(id, source.text.len(), source.text.len());
        let mut reader =
            CardReader { lines: CardLines::new(source, id), current: None, taken: 0, end, remarks: Remarks::default() };
        reader.take();
        reader
    }

    /// The next line, not taken.
    pub fn peek(&self) -> Option<&CardLine<'a>> {
        self.current.as_ref()
    }

    /// Takes the next line. A line that is far longer than a card, and all that follows the last card a file may have, is
    /// answered with an error and not seen.
    pub fn take(&mut self) -> Option<CardLine<'a>> {
        let mut next = self.lines.next();
        while let Some(line) = next.take_if(|line| line.text.len() > LONGEST_LINE) {
            self.remarks.add_once("a long line", || {
                let message = format!("a line of {} characters is no card", line.text.len());
                Diagnostic::error(message, line.span(1, 80))
                    .help("a card has 80 columns; lines this long are passed over")
            });
            next = self.lines.next();
        }
        if self.taken == MAX_CARDS
            && let Some(line) = next.take()
        {
            self.remarks.add_once("many cards", || {
                Diagnostic::error(format!("a file has at most {MAX_CARDS} cards"), line.whole())
                    .label("not read from here on")
            });
        }
        self.taken += usize::from(next.is_some());
        std::mem::replace(&mut self.current, next)
    }

    /// The place of the next line, or of the end of the file.
    pub fn current_span(&self) -> Span {
        self.peek().map_or(self.end, CardLine::whole)
    }

    /// The header that a line is, if it is one: an identifier in columns 5-6 and a keyword from column 11 on.
    fn header_of(line: &CardLine<'_>) -> Option<(u8, Header)> {
        if !line.blank(1, 4) || !line.blank(7, 10) || line.blank(11, 11) || line.stray().is_some() {
            return None;
        }
        let mut words = CardLine::words(line.columns(11, 80));
        let word = words.next()?;
        let (deck, name, structure) = parse_header(&word.to_ascii_uppercase())?;
        // behind the number of a structure its name may stand
        if name != "ELM" && words.next().is_some() {
            return None;
        }
        let id = line.columns(5, 6).trim().to_string();
        Some((deck, Header { keyword: name.to_string(), id, structure, span: line.place_of(word) }))
    }

    /// The header that comes next, if the next line is one, with the number of its deck (0 for NONE and FINI).
    pub fn next_header(&self) -> Option<(u8, Header)> {
        self.peek().and_then(Self::header_of)
    }

    /// The header of a deck: its own, NONE, or FINI where a series may end. A header of another deck is left where it
    /// is and answered with an error; lines that are no header are passed over with one.
    pub fn header(&mut self, deck: u8, series: bool) -> Option<Header> {
        let names = HEADERS.iter().find(|(number, ..)| *number == deck).map_or(&[][..], |(_, names, _)| *names);
        let wanted = match names {
            [] => "NONE".to_string(),
            _ => format!("{} or NONE", names.join(", ")),
        };
        let mut complained = false;
        loop {
            let Some(line) = self.peek() else {
                if deck <= 18 {
                    let message = format!("the file ends before deck {deck} ({wanted})");
                    self.remarks.add_once("the file ends", || {
                        Diagnostic::error(message, self.end)
                            .help("a deck without data is a card with NONE in columns 11-14")
                    });
                }
                return None;
            };
            match Self::header_of(line) {
                Some((0, header)) if header.keyword == "NONE" || series => {
                    self.take();
                    if header.id.parse().is_ok_and(|id: u8| id != deck) {
                        let message = format!(
                            "this {} card has the identifier {} and is read as that of deck {deck}",
                            header.keyword, header.id
                        );
                        self.remarks.add(
                            Diagnostic::warning(message, header.span)
                                .help("the order of the decks is fixed; identifiers are the user's own"),
                        );
                    }
                    return Some(header);
                }
                Some((other, header)) if other == deck => {
                    self.take();
                    return Some(header);
                }
                Some((0, header)) => {
                    self.take();
                    self.remarks.add(
                        Diagnostic::error(format!("deck {deck}: FINI ends no series of decks here"), header.span)
                            .label(format!("{wanted} belongs here")),
                    );
                }
                Some((other, header)) if other > deck => {
                    self.remarks.add(
                        Diagnostic::error(format!("deck {deck} is missing before deck {other}"), header.span)
                            .label(format!("{wanted} belongs before this"))
                            .help("a deck without data is a card with NONE in columns 11-14"),
                    );
                    return None;
                }
                Some((other, header)) => {
                    self.take();
                    self.remarks.add(
                        Diagnostic::error(format!("deck {other} comes after deck {}", deck - 1), header.span)
                            .label(format!("deck {deck} ({wanted}) was expected"))
                            .help("the order of the decks is fixed"),
                    );
                    complained = true;
                }
                None => {
                    let word = CardLine::words(line.text).last().unwrap_or_default().to_ascii_uppercase();
                    let mut error = match line.stray() {
                        Some(column) => line.stray_error(&format!("deck {deck}"), column),
                        None => Diagnostic::error(format!("deck {deck}: this is no deck header"), line.whole())
                            .label(format!("{wanted} belongs in columns 11-14")),
                    };
                    self.take();
                    if !std::mem::replace(&mut complained, true) {
                        error.help.extend(did_you_mean(&word, names.iter().copied().chain(["NONE"])));
                        self.remarks.add(error.help("lines up to the next header are passed over"));
                    }
                }
            }
        }
    }

    /// The cards of a deck up to the one marked `END`.
    pub fn records(&mut self, deck: u8, label: &str, layouts: &'static [CardLayout]) -> Vec<CardRecord> {
        let mut list = Vec::new();
        let mut layouts = layouts;
        let keyworded = !layouts.iter().any(|layout| layout.keyword.is_empty());
        loop {
            if self.next_header().is_some() || self.peek().is_none() {
                let span = list.last().map_or(self.current_span(), |record: &CardRecord| record.span);
                let message = format!("{label} has no END");
                self.remarks.add(
                    Diagnostic::error(message, span).label("END belongs in columns 2-4 of the last card of the deck"),
                );
                break;
            }
            let Some(line) = self.take() else { break };
            let face = match Face::new(&line, label, keyworded) {
                Ok(face) => face,
                Err(error) => {
                    self.remarks.add(error);
                    if Face::closes(&line) {
                        break;
                    }
                    continue;
                }
            };
            let remarked = layouts.iter().any(|layout| layout.keyword == face.keyword && layout.ends_in_remark(&line));
            if line.overlong() && !line.is_cut() && !remarked {
                self.remarks.add_once(&format!("overlong {deck}"), || {
                    Diagnostic::warning(
                        format!("{label}: a card is longer than 80 columns; the rest is not read"),
                        line.span(81, 81),
                    )
                });
            }
            if face.last && face.keyword.is_empty() && face.rest.trim().is_empty() {
                break;
            }
            let last = face.last;
            list.extend(self.record(label, &line, &face, layouts));
            if deck == 1 && face.keyword == nodes::WIDE_NUMBERS {
                layouts = nodes::WIDE_LAYOUTS;
            }
            if last {
                break;
            }
        }
        repeats::check(label, layouts, &list, &mut self.remarks);
        list
    }

    fn record(
        &mut self,
        label: &str,
        line: &CardLine<'a>,
        face: &Face<'a>,
        layouts: &'static [CardLayout],
    ) -> Option<CardRecord> {
        let Some(layout) = layouts.iter().find(|layout| matches(layout.keyword, &face.keyword)) else {
            let known = || layouts.iter().map(|layout| layout.keyword).filter(|keyword| !keyword.is_empty());
            let word = if face.keyword.is_empty() {
                CardLine::words(face.rest).next().unwrap_or_default()
            } else {
                &face.keyword
            };
            let mut error = Diagnostic::error(format!("{label} has no card `{word}`"), face.position)
                .label("a keyword of this deck belongs in columns 7-10");
            error.help.extend(did_you_mean(word, known()));
            let list: Vec<&str> = known().collect();
            if !list.is_empty() {
                error.help.push(format!("cards of this deck: {}", list.join(" ")));
            }
            self.remarks.add(error);
            return None;
        };
        match layout.standing {
            CardSupport::Sure => {}
            CardSupport::Assumed => self.remarks.add_once(&format!("{label} {}", layout.keyword), || {
                Diagnostic::remark(
                    format!("{label}, {}: no source confirms the columns of this card", layout.keyword),
                    face.position,
                )
                .help(format!("assumed {}", layout.usage()))
            }),
            CardSupport::Refused(reason) => {
                self.remarks.add(Diagnostic::error(format!("{label}, {}: {reason}", layout.keyword), face.position));
                return None;
            }
            CardSupport::Passed(reason) => {
                self.remarks.add(Diagnostic::warning(format!("{label}, {}: {reason}", layout.keyword), face.position));
                return None;
            }
        }
        let record = self.remarks.keep(layout.read(label, line, face))?;
        for note in layout.blank_notes(label, &record) {
            self.remarks.add(note);
        }
        Some(record)
    }
}

/// Whether a keyword is that of a layout; `POSn` and the like stand for the keyword followed by a number.
pub fn matches(pattern: &str, keyword: &str) -> bool {
    let Some(stem) = pattern.strip_suffix('n') else { return pattern == keyword };
    let number = |stem: &str| keyword.strip_prefix(stem).is_some_and(|n| n.parse::<u8>().is_ok_and(|n| n > 0));
    number(stem) || (keyword.len() == 4 && stem.len() == 3 && stem.get(..2).is_some_and(number))
}
