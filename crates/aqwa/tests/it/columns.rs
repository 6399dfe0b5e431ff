//! What happens to a deck whose cards are out of their columns or given twice: it is refused, or it is the same deck.
//!
//! The measure is the deck itself: the echo of all its fields and the records it amounts to. A deck that is read and differs from
//! the one it was made from has changed in silence, whatever a warning says.

use std::collections::BTreeMap;
use windlass_aqwa::{Deck, read, records};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_language::source::Sources;

pub fn deck(name: &str) -> String {
    std::fs::read_to_string(format!("../../scripts/{name}")).unwrap()
}

/// What a deck says and amounts to; nothing where it is refused.
pub fn meaning(text: &str) -> Option<(Deck, String)> {
    let mut sources = Sources::default();
    let id = sources.add("deck", text, 1);
    let reading = read(&sources, id);
    if reading.failed {
        return None;
    }
    let made = records(&reading.deck).ok()?.script().text;
    Some((reading.deck, made))
}

/// The echo of all fields; blanks between the brackets of deck 2 mean nothing.
fn fields(deck: &Deck) -> Vec<String> {
    let brackets = |line: String| if line.contains('(') { line.replace(' ', "") } else { line };
    deck.echo().into_iter().flat_map(|echo| echo.lines).map(brackets).collect()
}

/// Runs of characters that are not blank, as first and last index.
fn runs(line: &[char]) -> Vec<(usize, usize)> {
    let mut list: Vec<(usize, usize)> = Vec::new();
    for (index, _) in line.iter().enumerate().filter(|(_, c)| **c != ' ') {
        match list.last_mut() {
            Some((_, last)) if *last + 1 == index => *last = index,
            _ => list.push((index, index)),
        }
    }
    list
}

/// The line with one run moved by some columns, alone or with all behind it; nothing where another character is in the way.
fn move_columns(line: &[char], (first, last): (usize, usize), by: isize, with_rest: bool) -> Option<String> {
    let last = if with_rest { line.len() - 1 } else { last };
    let mut made: Vec<char> = line.to_vec();
    made[first..=last].fill(' ');
    let run = line.iter().enumerate().take(last + 1).skip(first);
    for (index, character) in run.filter(|(_, character)| **character != ' ') {
        let to = usize::try_from(index as isize + by).ok()?;
        made.resize(made.len().max(to + 1), ' ');
        if made[to] != ' ' {
            return None;
        }
        made[to] = *character;
    }
    Some(made.into_iter().collect())
}

/// Lines behind the OPTIONS line, with their indices: three of each keyword with the same number of fields.
fn cards(text: &str) -> Vec<(usize, Vec<char>)> {
    let start = text.lines().position(|line| line.starts_with("OPTIONS")).unwrap() + 1;
    let mut met: BTreeMap<(String, usize), usize> = BTreeMap::new();
    let mut list = Vec::new();
    for (index, line) in text.lines().enumerate().skip(start) {
        let keyword: String = line.chars().take(10).filter(char::is_ascii_alphabetic).collect();
        let deck: String = line.chars().skip(4).take(2).collect();
        let times = met.entry((deck + &keyword, line.split_whitespace().count())).or_default();
        *times += 1;
        if *times <= 3 {
            list.push((index, line.chars().collect()));
        }
    }
    list
}

fn with_line(text: &str, at: usize, line: &str) -> String {
    let lines = text.lines().enumerate().map(|(index, old)| if index == at { line } else { old });
    lines.flat_map(|line| [line, "\n"]).collect()
}

/// Moves each field of a deck by up to five columns to each side, alone and with all behind it.
fn move_fields(name: &str) {
    let (mut tried, mut refused, mut changed) = (0, 0, Vec::new());
    let text = deck(name);
    let (whole, script) = meaning(&text).unwrap();
    let fields_of_whole = fields(&whole);
    for (at, line) in cards(&text) {
        for run in runs(&line) {
            for (by, with_rest) in (-5..=5).filter(|by| *by != 0).flat_map(|by| [(by, false), (by, true)]) {
                let Some(moved) = move_columns(&line, run, by, with_rest) else { continue };
                tried += 1;
                match meaning(&with_line(&text, at, &moved)) {
                    None => refused += 1,
                    Some((deck, made)) if fields(&deck) == fields_of_whole && made == script => {}
                    Some(_) => changed.push(moved),
                }
            }
        }
    }
    assert!(changed.is_empty(), "{} of {tried}, {refused} refused:\n{}", changed.len(), changed.join("\n"));
    // the experiment is one: most moves leave the columns
    assert!(tried > 1500 && refused > tried / 2, "{tried} tried, {refused} refused");
}

#[test]
fn towed_deck_field_shifted_up_to_five_columns_never_changes_deck() {
    move_fields("he01_phases.dat");
}

#[test]
fn installed_deck_field_shifted_up_to_five_columns_never_changes_deck() {
    move_fields("mint.dat");
}

#[test]
fn duplicate_card_never_changes_deck_silently() {
    let mut changed = Vec::new();
    for name in ["he01_phases.dat", "mint.dat"] {
        let text = deck(name);
        let (_, script) = meaning(&text).unwrap();
        for (at, line) in cards(&text) {
            let line: String = line.into_iter().collect();
            let first = line.replacen(" END", "    ", 1);
            let Some((_, made)) = meaning(&with_line(&text, at, &format!("{first}\n{line}"))) else { continue };
            if made != script {
                changed.push(format!("{name}: {line}"));
            }
        }
    }
    assert!(changed.is_empty(), "{}", changed.join("\n"));
}

fn messages(text: &str) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let id = sources.add("deck", text, 1);
    read(&sources, id).messages
}

#[test]
fn card_given_twice_is_refused_with_both_places() {
    let cases = [
        ("mint.dat", "    05DPTH    345.00", "    05DPTH    300.00", "deck 5 GLOB, DPTH: this card is given twice"),
        ("mint.dat", "    05DENS     1.025", "    05DENS     1.030", "deck 5 GLOB, DENS: this card is given twice"),
        (
            "mint.dat",
            "    13WAMP               15.00",
            "    13WAMP               12.00",
            "deck 13 WAVE, WAMP: this card is given twice",
        ),
        (
            "mint.dat",
            "    13WAMP               15.00",
            "    13HGHT               24.00",
            "deck 13 WAVE, HGHT: WAMP is given already",
        ),
        (
            "mint.dat",
            "    13PERD               15.00",
            "    13FREQ                 0.5",
            "deck 13 WAVE, FREQ: PERD is given already",
        ),
        ("he01.dat", "    13NSPL        50", "    13NSPL        40", "deck 13 SPEC, NSPL: this card is given twice"),
        (
            "he01.dat",
            "    13SPDN               180.0",
            "    13SPDN                90.0",
            "deck 13 SPEC, SPDN: this card is given twice",
        ),
        (
            "mint.dat",
            "    14TSLK                         0.001",
            "    14TSLK                           1.0",
            "deck 14 MOOR, TSLK: this card is given twice",
        ),
        ("mint.dat", "    14TEIG   16", "    14TEIG    4", "deck 14 MOOR, TEIG: this card is given twice"),
        ("mint.dat", "    14TEGR    4", "    14TEGR    3", "deck 14 MOOR, TEGR: this card is given twice"),
        (
            "mint.dat",
            "    14TCAP                           0.0       0.0",
            "    14TCAP                           0.1       0.0",
            "deck 14 MOOR, TCAP: this card is given twice",
        ),
        (
            "mint.dat",
            "    14TIMP                      300000.0       2.5",
            "    14TIMP                           0.0       2.5",
            "deck 14 MOOR, TIMP: this card is given twice",
        ),
        (
            "mint.dat",
            "    14TLOW                         100.0",
            "    14TLOW                           0.0",
            "deck 14 MOOR, TLOW: this card is given twice",
        ),
        (
            "mint.dat",
            "    14TSPV                           0.0  5729.578  5729.578",
            "    14TSPV                           1.0  5729.578  5729.578",
            "deck 14 MOOR, TSPV: this card is given twice",
        ),
        ("mint.dat", "    18TGRV    2", "    18TGRV    4", "deck 18 PROP, TGRV: this card is given twice"),
        ("he01.dat", "    18TPRV  500", "    18TPRV  100", "deck 18 PROP, TPRV: this card is given twice"),
        ("he01.dat", "    18TSTS  100", "    18TSTS  200", "deck 18 PROP, TSTS: this card is given twice"),
        ("mint.dat", "    18PREV   10", "    18PREV    5", "deck 18 PROP, PREV: this card is given twice"),
        (
            "he01.dat",
            "    07BFEQ             9.81E10",
            "    07BFEQ             9.00E10",
            "deck 7 WFS1, BFEQ: this card is given twice",
        ),
        (
            "he01.dat",
            "    07LSTF         2",
            "    07LSTF         3              1.0E10",
            "deck 7 WFS1, LSTF: this card of row 3 is given twice",
        ),
        (
            "he01.dat",
            "    16    TINT",
            "    16TIME       100      0.50",
            "deck 16 TINT, TIME: this card is given twice",
        ),
        (
            "he01.dat",
            "    17    HYDC",
            "    17SLMM    1           2.00",
            "deck 17 HYDC, SLMM: this card of structure 1 is given twice",
        ),
        (
            "mint.dat",
            "TITLE               Simple",
            "TITLE               Another",
            "deck 0, TITLE: this line is given twice",
        ),
        (
            "mint.dat",
            "    14TETH    1 1010    0 9010",
            "    14TETH    1 1010    0 9010",
            "deck 14, TETH: another tether stands between these nodes",
        ),
    ];
    for (name, card, other, said) in cases {
        let text = deck(name);
        let line = text.lines().find(|line| line.starts_with(card)).unwrap_or_else(|| panic!("{card}"));
        let text = text.replacen(line, &format!("{line}\n{other}"), 1);
        let list = messages(&text);
        let error = list.iter().find(|m| m.severity == Severity::Error).unwrap_or_else(|| panic!("{said}: {list:#?}"));
        assert_eq!(error.message, said);
        assert!(error.span.is_some() && error.other.is_some() && error.span != error.other.as_ref().map(|o| o.0));
    }
}

#[test]
fn spectrum_settings_may_repeat_for_next_spectrum_only() {
    let twice = |cards: &str| deck("he01.dat").replace(" END13JONS ", &format!("{cards}\n END13JONS "));
    let jons = "    13JONS               0.370       2.5    5.2273   0.01146    0.6411";
    let again = messages(&twice(&format!("{jons}\n    13SPDN                90.0\n    13NSPL        40")));
    assert!(again.iter().all(|m| m.severity != Severity::Error), "{again:#?}");
    let late = deck("he01.dat").replace(
        " END13JONS               0.370       2.5    5.2273   0.01146    0.6411",
        &format!("{jons}\n END13SPDN                90.0"),
    );
    let error = messages(&late).into_iter().find(|m| m.severity == Severity::Error).unwrap();
    assert_eq!(error.message, "deck 13, SPDN: no spectrum comes after this card");
    assert!(error.other.is_some());
}
