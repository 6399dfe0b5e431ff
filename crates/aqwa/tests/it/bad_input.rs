//! What happens to decks that are wrong in a way people and programs get them wrong: tabs, missing END, cards in another order, fields left
//! blank, signs lost or added, nodes given twice, line ends and bytes of other systems, files far too long.
//!
//! The measure is that of `columns.rs`: a deck is refused, or it amounts to the same records. What may be given, as a coordinate of another
//! sign, is another deck.

use super::columns::{deck, meaning};
use proptest::prelude::*;
use windlass_aqwa::read;
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_language::source::Sources;

/// A deck with two chains on the bottom and a spring line.
const MOORED: &str = "\
JOB MOOR  LIBR
TITLE               Lines on the bottom
OPTIONS END
    01    COOR
    01   1                 0.0       0.0       0.0
    01   2                 0.0       0.0     -10.0
    01  13                 0.0     535.0    -100.0
 END01  12               535.0       0.0    -100.0
    02    ELM1
 END02PMAS           (1) (1) (1) (1)
    02    FINI
    03    MATE
 END03             1     1.0E7
    04    GEOM
 END04PMAS         1     1.0E9       0.0       0.0     1.0E9       0.0     1.0E9
    05    GLOB
    05DPTH     100.0
    05DENS    1025.0
 END05ACCG      9.81
    06    NONE
    07    NONE
    08    NONE
    09    NONE
    10    NONE
    11    NONE
    12    NONE
    13    NONE
    14    MOOR
    14LINE    1    2    0   13   1.0E5     500.0
    14COMP   15   40         1     -20.0       0.0
    14ECAT                         150.0     0.018     6.0E8     5.0E6     570.0
    14NLIN    1    2    0   12
    14COMP                   2
    14ECAT                         220.0     0.026     8.0E8     8.0E6     450.0
    14CLMP                        5000.0     700.0
    14ECAT                         150.0     0.018     6.0E8     5.0E6     120.0
    14ECAH                           1.1                 1.2       0.3      0.04
 END14NLIN    1    2    0   13
    15    STRT
 END15POS1                 0.0       0.0       0.0       0.0       0.0       0.0
    16    NONE
    17    NONE
    18    NONE
    19    NONE
    20    NONE
";

/// The shipped decks and one of lines.
fn decks() -> [String; 3] {
    [deck("he01_phases.dat"), deck("mint.dat"), MOORED.to_string()]
}

fn messages(text: &str) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let id = sources.add("deck", text, 1);
    read(&sources, id).messages
}

/// Records in an order that does not depend on that of the cards; tubes without their names, which count them.
fn sort_records(script: &str) -> Vec<String> {
    let nameless = |line: &str| match line.strip_prefix("TUBE ") {
        Some(rest) => rest.split_once(' ').map_or_else(String::new, |(_, rest)| rest.to_string()),
        None => line.to_string(),
    };
    let mut lines: Vec<String> = script.lines().map(nameless).collect();
    lines.sort_unstable();
    lines
}

/// Lines of a deck behind the OPTIONS line.
fn cards(text: &str) -> impl Iterator<Item = (usize, &str)> {
    let start = text.lines().position(|line| line.starts_with("OPTIONS")).unwrap() + 1;
    text.lines().enumerate().skip(start)
}

fn with_line(text: &str, at: usize, line: &str) -> String {
    let lines = text.lines().enumerate().map(|(index, old)| if index == at { line } else { old });
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// What comes of decks that are each changed in one place: refused, the same, changed.
#[derive(Debug, Default)]
struct ShiftCounts {
    /// Messages of the deck itself.
    said: usize,
    tried: usize,
    refused: usize,
    changed: Vec<String>,
    /// Of the changed ones those of which nothing is said that is not said of the deck itself.
    silent: Vec<String>,
}

impl ShiftCounts {
    fn add(&mut self, was: &str, text: &str, script: &str) {
        self.tried += 1;
        match meaning(text) {
            None => {
                self.refused += 1;
                let list = messages(text);
                let errors = list.iter().filter(|m| m.severity == Severity::Error);
                assert!(errors.clone().all(|m| m.span.is_some() && m.message.starts_with("deck ")), "{was}: {list:#?}");
            }
            Some((_, made)) if sort_records(&made) == sort_records(script) => {}
            Some(_) => {
                if messages(text).len() <= self.said {
                    self.silent.push(was.to_string());
                }
                self.changed.push(was.to_string());
            }
        }
    }
}

#[test]
fn text_behind_column_10_shifted_is_refused_or_same() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        for (at, line) in text.lines().enumerate().filter(|(_, line)| line.len() > 10) {
            let (face, fields) = line.split_at(10);
            for by in [1, 2, 3, 5] {
                let with = format!("{face}{}{fields}", " ".repeat(by));
                tally.add(&with, &with_line(&text, at, &with), &script);
            }
            // to the left where nothing is pushed over the keyword
            for blanks in [" ", "  "] {
                let Some(fields) = fields.strip_prefix(blanks) else { continue };
                let with = format!("{face}{fields}");
                tally.add(&with, &with_line(&text, at, &with), &script);
            }
        }
    }
    // names of files and titles may stand anywhere, a bracket of deck 2 anywhere behind column 20
    assert!(tally.tried > 1200 && tally.changed.is_empty(), "{tally:#?}");
    assert!(tally.refused * 10 > tally.tried * 6, "{} of {} refused", tally.refused, tally.tried);
}

#[test]
fn byte_of_another_code_page_is_refused_with_its_column() {
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        for (at, line) in cards(&text).filter(|(_, line)| line.len() > 10) {
            // the last character of the card
            let mut bytes = with_line(&text, at, &format!("{}\u{1}", &line[..line.len() - 1])).into_bytes();
            bytes.iter_mut().filter(|byte| **byte == 1).for_each(|byte| *byte = 0xe4);
            let read = windlass_language::source::Text::from_bytes(bytes);
            assert!(meaning(read.as_str()).is_none(), "{line}");
            let wanted = format!("column {} holds a byte that is not UTF-8", line.len());
            let header = line[6..10].trim().is_empty() && !line[10..11].trim().is_empty();
            let list = messages(read.as_str());
            let found = list.iter().find(|m| m.message.contains(&wanted));
            assert!(found.is_some_and(|m| m.span.is_some()) || header, "{line}: {list:#?}");
        }
        let latin = text.replace("TITLE               ", "TITLE               \u{1}").into_bytes();
        let latin = latin.into_iter().map(|byte| if byte == 1 { 0xd8 } else { byte }).collect();
        let read = windlass_language::source::Text::from_bytes(latin);
        let (_, made) = meaning(read.as_str()).unwrap();
        // a remark has the title
        let without = |script: &str| script.lines().filter(|l| !l.starts_with('$') && !l.starts_with("&TITLE")).count();
        assert_eq!(without(&made), without(&script));
    }
}

#[test]
fn tab_in_card_is_refused_with_its_column() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        for (at, line) in cards(&text) {
            let blanks: Vec<usize> = line.match_indices(' ').map(|(index, _)| index).collect();
            for index in blanks {
                let with: String = line.chars().enumerate().map(|(i, c)| if i == index { '\t' } else { c }).collect();
                tally.add(&with, &with_line(&text, at, &with), &script);
            }
        }
    }
    assert!(tally.tried > 5000 && tally.refused == tally.tried, "{tally:#?}");
}

#[test]
fn missing_end_is_refused_with_its_deck() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        for (at, line) in cards(&text).filter(|(_, line)| line.starts_with(" END")) {
            let with = line.replacen(" END", "    ", 1);
            tally.add(line, &with_line(&text, at, &with), &script);
        }
        tally.add("OPTIONS", &text.replacen(" END\n    01", "\n    01", 1), &script);
    }
    assert!(tally.tried == 32 && tally.refused == tally.tried, "{tally:#?}");
}

#[test]
fn cards_in_other_order_are_refused_or_same() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        let lines: Vec<&str> = text.lines().collect();
        let first = cards(&text).next().unwrap().0;
        for at in first..lines.len() - 1 {
            let mut other = lines.clone();
            other.swap(at, at + 1);
            tally.add(lines[at], &(other.join("\n") + "\n"), &script);
        }
    }
    // an ECAH before an ECAT is of the section before, and a note says that it holds for this one too
    let other = |card: &&String| !card.starts_with("    14ECAT");
    assert!(tally.tried > 300 && tally.refused > 100 && tally.silent.is_empty(), "{tally:#?}");
    assert_eq!(tally.changed.iter().filter(other).count(), 0, "{tally:#?}");
}

#[test]
fn word_of_deck_0_split_by_a_blank_is_refused() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        // PBIS and LDRG change no result
        let text = text.replacen(" END\n", " LDRG PBIS END\n", 1);
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        for (at, line) in text.lines().enumerate().filter(|(_, line)| line.starts_with(['J', 'O'])) {
            for index in 1..line.len() {
                if line[index - 1..=index].contains(' ') {
                    continue;
                }
                let with = format!("{} {}", &line[..index], &line[index..]);
                tally.add(&with, &with_line(&text, at, &with), &script);
            }
        }
    }
    // a remark of the script has the identifier of the run, which is text
    assert!(tally.tried > 60 && tally.refused == tally.tried, "{tally:#?}");
}

#[test]
fn options_that_would_change_results_are_refused_by_name() {
    let with = |option: &str| MOORED.replacen("OPTIONS END", &format!("OPTIONS {option} END"), 1);
    for option in ["NCNV", "CRNM", "RDEP", "SUFC", "LSFT", "TRAN", "LS", "1"] {
        let list = messages(&with(option));
        let error = list.iter().find(|m| m.severity == Severity::Error).unwrap();
        assert!(error.message.starts_with("deck 0, OPTIONS") && error.message.contains(option), "{error:#?}");
    }
    let (_, script) = meaning(MOORED).unwrap();
    for option in ["PPEL", "AHD1", "PRCE", "LDRG", "prce"] {
        assert_eq!(meaning(&with(option)).map(|(_, made)| made).as_ref(), Some(&script), "{option}");
    }
}

/// The words of a card behind its keyword that are numbers, as first index and length.
fn numbers(line: &str) -> Vec<(usize, usize)> {
    let mut list = Vec::new();
    let mut at = 10.min(line.len());
    while let Some(start) = line[at..].find(|c: char| c != ' ').map(|i| at + i) {
        let end = line[start..].find(' ').map_or(line.len(), |i| start + i);
        if line[start..end].parse::<f64>().is_ok() {
            list.push((start, end - start));
        }
        at = end;
    }
    list
}

#[test]
fn blank_field_is_refused_or_reported() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        for (at, line) in cards(&text) {
            for (start, length) in numbers(line) {
                let with = format!("{}{}{}", &line[..start], " ".repeat(length), &line[start + length..]);
                tally.add(&with, &with_line(&text, at, &with), &script);
            }
        }
    }
    assert!(tally.tried > 600 && tally.refused > 290, "{tally:#?}");
    // a blank field is 0 or a default by the format: nothing is said of it where no number stands behind it on its card
    let is_last = |card: &String| card.ends_with(' ');
    assert!(tally.silent.iter().all(is_last), "{:#?}", tally.silent);
    assert!(tally.silent.len() <= tally.changed.len() / 3, "{} of {}", tally.silent.len(), tally.changed.len());
}

#[test]
fn negative_value_is_refused_or_legal() {
    let mut tally = ShiftCounts::default();
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        tally.said = messages(&text).len();
        for (at, line) in cards(&text) {
            for (start, _) in numbers(line) {
                let value = &line[start..];
                if start == 0 || !line[..start].ends_with(' ') || value.starts_with('-') {
                    continue;
                }
                let with = format!("{}-{}", &line[..start - 1], value);
                tally.add(&with, &with_line(&text, at, &with), &script);
            }
        }
    }
    // places, phases and rows of a stiffness have signs; BFEQ has a warning; springs below 0 are none [AQWA-TETHER A.2]; the displaced mass of a
    // joint may be negative [AQWA-CONN 5.8.3.2]
    let signed = |card: &&String| {
        let word = card.get(4..10).unwrap_or_default();
        word.starts_with("01") || ["13PHAS", "07LSTF", "07BFEQ", "14TSPA", "14TSPV", "15POS1", "14CLMP"].contains(&word)
    };
    let others: Vec<&String> = tally.changed.iter().filter(|card| !signed(card)).collect();
    assert!(others.is_empty(), "{others:#?}");
}

#[test]
fn node_given_twice_is_refused_with_both_places() {
    for text in decks() {
        for (at, line) in cards(&text).filter(|(_, line)| line.starts_with("    01") && !line.contains("COOR")) {
            let twice = with_line(&text, at, &format!("{line}\n{line}"));
            assert!(meaning(&twice).is_none(), "{line}");
            let list = messages(&twice);
            let error = list.iter().find(|m| m.severity == Severity::Error).unwrap();
            assert!(error.message.starts_with("deck 1") && error.span.is_some() && error.other.is_some(), "{error:#?}");
        }
    }
}

#[test]
fn line_ends_bytes_and_size_of_other_systems_are_harmless() {
    for text in decks() {
        let (_, script) = meaning(&text).unwrap();
        let script_of = |text: &str| meaning(text).map(|(_, made)| made);
        assert_eq!(script_of(&text.replace('\n', "\r\n")).as_ref(), Some(&script));
        // a comment of Latin-1, read as a session reads a file
        let mut bytes = b"* Verankerung f\xfcr \xd8st\n".to_vec();
        bytes.extend(text.bytes());
        let latin = windlass_language::source::Text::from_bytes(bytes);
        assert_eq!(script_of(latin.as_str()).as_ref(), Some(&script));
        // a megabyte of materials that nothing refers to
        let many: String = (10_000..45_000).map(|group| format!("    03         {group}       1.0\n")).collect();
        assert!(many.len() > 1_000_000);
        let large = text.replacen("    03    MATE\n", &format!("    03    MATE\n{many}"), 1);
        assert_eq!(script_of(&large).as_ref(), Some(&script));
        // a megabyte of remarks; a megabyte of what is no card is refused, with few messages
        let remarks = "* a remark of a line\n".repeat(50_000);
        assert_eq!(script_of(&format!("{remarks}{text}")).as_ref(), Some(&script));
        let noise = text.replacen(
            "    05    GLOB\n",
            &format!("    05    GLOB\n{}", "    05WXYZ       1.0\n".repeat(50_000)),
            1,
        );
        assert!(script_of(&noise).is_none() && messages(&noise).len() < 300);
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(256))]

    #[test]
    fn random_edits_never_panic(which in 0usize..3, edits in prop::collection::vec((any::<prop::sample::Index>(), any::<char>()), 1..12)) {
        let text = &decks()[which];
        let mut characters: Vec<char> = text.chars().collect();
        for (index, character) in edits {
            let at = index.index(characters.len());
            if character == 'x' { characters.remove(at); } else { characters[at] = character; }
        }
        let text: String = characters.into_iter().collect();
        let _ = meaning(&text);
    }
}
