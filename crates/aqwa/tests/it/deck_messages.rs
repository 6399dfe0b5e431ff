//! What is said of cards that a user may take for acting: the exact text, the place it points at, and whether the deck is refused.

use windlass_aqwa::{read, records};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_language::source::Sources;

/// Decks of a job.
#[derive(Clone, Copy)]
struct DeckJob {
    program: &'static str,
    depth: &'static str,
    coefficients: &'static str,
    drift: &'static str,
    waves: &'static str,
    lines: &'static str,
    multipliers: &'static str,
    printing: &'static str,
}

const STILL: &str = "    13    NONE\n";
const LINE: &str = " END14LINE    1    2    0   12     1.0E5     540.0\n";
const SPECTRUM: &str = "    13    SPEC\n    13TOWS                           2.0       0.0\n END13PSMZ                 0.3       2.0       3.0       6.0\n";
/// A hull by its file.
const HULL: &str = "    07    WFS1\n END07FILE              hull.AH1\n";

/// A body in 100 m of water (kg, m, N) with its fairlead at Z = -10, run for 10 s.
const MOORED: DeckJob = DeckJob {
    program: "NAUT",
    depth: "     100.0",
    coefficients: "    07    NONE\n",
    drift: "    09    NONE\n",
    waves: STILL,
    lines: LINE,
    multipliers: "    17    NONE\n",
    printing: "    18    NONE\n",
};

impl DeckJob {
    fn text(&self) -> String {
        let DeckJob { program, depth, coefficients, drift, waves, lines, multipliers, printing } = self;
        format!(
            "JOB MOOR  {program}\nTITLE               Lines on the bottom\nOPTIONS END\n\
             \x20   01    COOR\n    01   1                 0.0       0.0       0.0\n    01   2                 0.0       0.0     -10.0\n\
             \x20END01  12               535.0       0.0    -100.0\n    02    ELM1\n END02PMAS           (1) (1) (1) (1)\n    02    FINI\n\
             \x20   03    MATE\n END03             1     1.0E7\n    04    GEOM\n\
             \x20END04PMAS         1     1.0E9       0.0       0.0     1.0E9       0.0     1.0E9\n\
             \x20   05    GLOB\n    05DPTH{depth}\n    05DENS    1025.0\n END05ACCG      9.81\n    06    NONE\n{coefficients}    08    NONE\n{drift}\
             \x20   10    NONE\n    11    NONE\n    12    NONE\n{waves}    14    MOOR\n{lines}    15    STRT\n\
             \x20END15POS1                 0.0       0.0       0.0       0.0       0.0       0.0\n    16    TINT\n END16TIME       101       0.1\n\
             {multipliers}{printing}"
        )
    }

    /// All that is said, with the line of the deck that each message points at.
    fn said(&self) -> Vec<(Diagnostic, String)> {
        let text = self.text();
        let mut sources = Sources::default();
        let id = sources.add("deck", text.as_str(), 1);
        let reading = read(&sources, id);
        let mut list = reading.messages;
        match records(&reading.deck) {
            _ if reading.failed => {}
            Ok(made) => list.extend(made.notes),
            Err(errors) => list.extend(errors),
        }
        let line = |said: &Diagnostic| {
            let (line, _) = said.span.and_then(|span| sources.position(span)).unwrap_or_default();
            text.lines().nth(line.saturating_sub(1)).unwrap_or_default().to_string()
        };
        list.into_iter().map(|said| (said.clone(), line(&said))).collect()
    }

    /// The records of a deck that is read.
    fn records(&self) -> String {
        let mut sources = Sources::default();
        let id = sources.add("deck", self.text().as_str(), 1);
        records(&read(&sources, id).deck).unwrap().script().text
    }
}

/// The message is among those of a deck, of this severity, and points at the line that begins so.
fn says(job: &DeckJob, severity: Severity, message: &str, at: &str) {
    let list = job.said();
    let found = list.iter().find(|(said, _)| said.message == message);
    let (said, line) = found.unwrap_or_else(|| panic!("{message}\n{list:#?}"));
    assert!(said.severity == severity && line.starts_with(at), "{line}\n{said:#?}");
    let failed = list.iter().any(|(said, _)| said.severity == Severity::Error);
    assert_eq!(failed, severity == Severity::Error, "{list:#?}");
}

fn silent_of(job: &DeckJob, part: &str) {
    let list = job.said();
    assert!(list.iter().all(|(said, _)| !said.message.contains(part)), "{list:#?}");
}

const BREAKS: &str = "    14LINE    1    2    0   12     1.0E5     540.0\n";

#[test]
fn break_needs_a_time_or_tension_and_comes_once_a_line() {
    let with = |cards: &'static str| DeckJob { lines: cards, ..MOORED };
    let lines = [BREAKS, " END14LBRK         1\n"].concat().leak();
    says(
        &with(lines),
        Severity::Error,
        "deck 14, LBRK: neither a time nor a breaking tension is given",
        " END14LBRK         1",
    );
    let twice = [BREAKS, "    14LBRK         1                 3.0\n END14LBRK         1                 5.0\n"]
        .concat()
        .leak();
    says(
        &with(twice),
        Severity::Error,
        "deck 14 MOOR, LBRK: this card of number of the line 1 is given twice",
        " END14LBRK         1                 5.0",
    );
    let late = [BREAKS, " END14LBRK         1                12.0\n"].concat().leak();
    says(
        &with(late),
        Severity::Warning,
        "deck 14, LBRK, columns 31-40: 12 s come after the end of the run at 10 s: the line does not break",
        " END14LBRK",
    );
    let still = DeckJob { program: "LIBR", ..with(late) };
    says(&still, Severity::Error, "deck 14, LBRK, columns 11-15: this field is blank", " END14LBRK");
}

#[test]
fn run_of_body_without_added_mass_is_reported() {
    let message = "deck 2, ELM1: structure 1 has no added mass and no radiation damping: decks 6 to 8 give none, and it has no tubes; \
                   it moves with its own mass alone";
    for program in ["NAUT", "DRIF"] {
        says(&DeckJob { program, ..MOORED }, Severity::Warning, message, "    02    ELM1");
    }
    silent_of(&DeckJob { program: "LIBR", ..MOORED }, "no added mass");
    silent_of(&DeckJob { coefficients: HULL, ..MOORED }, "no added mass");
    let added = "    07    WFS1\n    07FIAM         3                         1.0E6\n END07FIDP         3                         1.0E5\n";
    silent_of(&DeckJob { coefficients: added, ..MOORED }, "no added mass");
    // the motions in unit waves need forces of waves
    says(
        &DeckJob { program: "FER ", ..MOORED },
        Severity::Error,
        "decks 6 to 8: structure 1 has no wave coefficients, and no tubes",
        "    02    ELM1",
    );
}

#[test]
fn drum_that_never_turns_in_a_run_is_reported() {
    let drum = |end: &str, speed: &str| -> &'static str {
        format!(" END14LNDW    1    2    0   12     2.0E5     540.0{end:>10}{speed:>10}\n").leak()
    };
    for (end, speed) in [("530.0", "0.05"), ("550.0", "-0.05"), ("540.0", "0.05")] {
        let job = DeckJob { lines: drum(end, speed), ..MOORED };
        says(&job, Severity::Warning, "deck 14, LNDW: this drum never turns", " END14LNDW");
    }
    silent_of(&DeckJob { lines: drum("530.0", "-0.05"), ..MOORED }, "LNDW");
    let late: &str = ["    14DWT0                          20.0\n", drum("530.0", "-0.05")].concat().leak();
    says(
        &DeckJob { lines: late, ..MOORED },
        Severity::Warning,
        "deck 14, LNDW: its drum begins to turn at 20 s (DWT0), and the run ends at 10 s",
        " END14LNDW",
    );
}

#[test]
fn cards_of_towed_tethers_in_other_decks_are_reported() {
    let job = DeckJob { program: "DRIF", waves: SPECTRUM, coefficients: HULL, ..MOORED };
    says(
        &job,
        Severity::Warning,
        "deck 13, TOWS: a towing speed is of towed tethers, and this deck has none; it has no effect here",
        " END13PSMZ",
    );
    let slam = "    17    HYDC\n END17SLMM    1           1.0\n";
    says(
        &DeckJob { multipliers: slam, ..MOORED },
        Severity::Warning,
        "deck 17, SLMM, columns 21-30: slam is of towed tethers; it has no effect here",
        " END17SLMM",
    );
    let pages = "    18    PROP\n END18PREV   10\n";
    says(
        &DeckJob { program: "LIBR", printing: pages, ..MOORED },
        Severity::Note,
        "deck 18, PREV, columns 11-15: is of runs in time, DRIF and NAUT",
        " END18PREV",
    );
    says(
        &DeckJob { program: "LIBR", ..MOORED },
        Severity::Note,
        "deck 16, TIME: LIBR finds an equilibrium and has no time steps: the card has no effect",
        " END16TIME",
    );
}

const SECTION: &str = "    14ECAT                         150.0     0.018     6.0E8     5.0E6     570.0\n";
const NLIN: &str = " END14NLIN    1    2    0   12\n";

fn composite(comp: &str, sections: &str, line: &str) -> DeckJob {
    DeckJob { program: "LIBR", lines: format!("    14COMP{comp}\n{sections}{line}").leak(), ..MOORED }
}

#[test]
fn composite_heights_out_of_order_are_refused() {
    says(
        &composite("   15   40         1       0.0     -20.0", SECTION, NLIN),
        Severity::Error,
        "deck 14, COMP, columns 31-50: the lowest Z, 0, is above the highest, -20",
        "    14COMP",
    );
}

#[test]
fn composite_with_two_sections_states_their_order() {
    let two = [SECTION, SECTION].concat();
    says(
        &composite("                   2", &two, NLIN),
        Severity::Note,
        "deck 14, COMP: its sections are taken in their order from the anchor upwards",
        "    14ECAT",
    );
    silent_of(&composite("                   1", SECTION, NLIN), "sections");
}

#[test]
fn blank_and_zero_fields_with_defaults_name_the_default() {
    let blank = "    14ECAT                         150.0     0.018                         570.0\n";
    let job = composite("                   1", blank, NLIN);
    says(
        &job,
        Severity::Note,
        "deck 14 MOOR, ECAT, columns 51-60: this field is blank: the default holds, 5.0E6 times the mass a length",
        "    14ECAT",
    );
    says(
        &job,
        Severity::Note,
        "deck 14 MOOR, ECAT, columns 61-70: this field is blank: the default holds, 5.0E4 times the mass a length",
        "    14ECAT",
    );
    silent_of(&job, "reads as 0");
    // 5.0E6 and 5.0E4 times 150
    assert!(job.records().contains("-EA 750000000 -TMAX 7500000\n"), "{}", job.records());
    let zero = blank.replace("0.018                         570.0", "0.018       0.0               570.0");
    says(
        &composite("                   1", &zero, NLIN),
        Severity::Note,
        "deck 14 MOOR, ECAT, columns 51-60: 0 stands here: the default holds, 5.0E6 times the mass a length",
        "    14ECAT",
    );
    // the coefficients of a section: 1.0, 1.0, 0.025 [AQWA-CONN 5.8.3.1]
    let water = [SECTION, "    14ECAH                                               1.2\n"].concat();
    let job = composite("                   1", &water, NLIN);
    says(
        &job,
        Severity::Note,
        "deck 14 MOOR, ECAH, columns 61-70: this field is blank: the default holds, that of the area of the section",
        "    14ECAH",
    );
    assert!(job.records().contains("-CA 1 -CD 1.2 -CX 0.025\n"), "{}", job.records());
}

#[test]
fn joint_on_the_wrong_side_of_its_buoyancy_is_refused() {
    for (joint, message) in [
        (
            "CLMP                      -5000.0     700.0",
            "deck 14, CLMP: a mass of -5000 is not above the displaced mass of 700",
        ),
        (
            "BUOY                       4200.0     900.0",
            "deck 14, BUOY: a mass of 4200 is not below the displaced mass of 900",
        ),
    ] {
        let card = format!("    14{joint}");
        let sections = [SECTION, &card, "\n", SECTION].concat();
        says(&composite("                   2", &sections, NLIN), Severity::Error, message, &card);
    }
}

#[test]
fn section_without_own_resistance_names_whose_it_has() {
    let water = "    14ECAH                           1.1                 1.2       0.3      0.04\n";
    says(
        &composite("                   2", &[SECTION, water, SECTION].concat(), NLIN),
        Severity::Note,
        "deck 14, ECAT: this section has no ECAH of its own: that before it holds",
        "    14ECAT",
    );
    silent_of(&composite("                   2", &[SECTION, water, SECTION, water].concat(), NLIN), "of its own");
}

#[test]
fn pretension_and_its_flag_come_together_or_are_refused() {
    let flagged = SECTION.replace("ECAT                         150.0", "ECAT                   1     150.0");
    let nlid = " END14NLID    1    2    0   12     1.5E5\n";
    says(
        &composite("                   1", &flagged, NLIN),
        Severity::Error,
        "deck 14, ECAT, columns 26-30: a length is to be found for a pretension, and the line has none",
        "    14ECAT",
    );
    says(
        &composite("                   1", SECTION, nlid),
        Severity::Error,
        "deck 14, NLID, columns 31-40: no section of the composite has its length found for this pretension",
        " END14NLID",
    );
    says(
        &composite("                   2", &[flagged.as_str(), SECTION].concat(), nlid),
        Severity::Error,
        "deck 14, ECAT, columns 26-30: the length of a section below the fairlead is not found for a pretension",
        "    14ECAT                   1",
    );
}

#[test]
fn elements_of_dynamic_lines_are_those_of_ncel() {
    let nlid = " END14NLID    1    2    0   12\n";
    let with = |card: &str| composite("                   1", &[SECTION, card].concat(), nlid);
    let made = with("    14NCEL  120\n").records();
    assert!(made.contains("&CONNECTOR L1 -DYNAMICS 120\n"), "{made}");
    assert!(with("").records().contains("&CONNECTOR L1 -DYNAMICS 50\n"));
    says(
        &with("    14NCEL  120\n"),
        Severity::Note,
        "deck 14 MOOR, NCEL: no source confirms the columns of this card",
        "    14NCEL",
    );
    says(
        &with("    14NCEL    0\n"),
        Severity::Error,
        "deck 14, NCEL, columns 11-15: 0 is not a valid number of elements",
        "    14NCEL",
    );
}

#[test]
fn refused_matrices_point_at_their_own_cards() {
    let drift = "    09    DRM1\n    09FIDA         3                         1.0E6\n END09FIDD         3                         1.0E5\n";
    for (keyword, what) in [("FIDA", "an added mass"), ("FIDD", "a damping")] {
        says(
            &DeckJob { drift, ..MOORED },
            Severity::Error,
            &format!("deck 9, {keyword}: {what} of drift frequencies alone is not read into the model"),
            drift.lines().find(|line| line.contains(keyword)).unwrap(),
        );
    }
    let position = "    07    WFS1\n    07LSTF         3                         1.0E6\n    07BFEQ             9.81E7\n    07ZCGE                 0.0\n\
                 \x20END07SPOS                 1.0\n";
    says(
        &DeckJob { coefficients: position, ..MOORED },
        Severity::Error,
        "deck 7, SPOS: an X, Y or a rotation of the stiffness is not read into the model",
        " END07SPOS",
    );
}

#[test]
fn file_of_hull_may_have_blanks_and_a_structure() {
    let named = "    07    WFS1\n    07CSTR    2\n END07FILE              my hull, 2.AH1\n";
    let made = DeckJob { coefficients: named, ..MOORED }.records();
    assert!(made.contains("DATABASE S1 -AQWA \"my hull, 2.AH1\" -INDEX 2 -HYDROSTATICS YES\n"), "{made}");
    for (card, message) in [
        (
            " END07FILE   21         hull.AH1",
            "deck 7, FILE, columns 11-20: a name of a file begins in column 21 or behind it",
        ),
        (" END07FILE              h%l.AH1", "deck 7, FILE, columns 21-80: a name of a file does not hold `%` here"),
        (" END07FILE              hull.HYD", "deck 7, FILE, columns 21-80: `hull.HYD` is no text database of AQWA"),
        (" END07CSTR    0", "deck 7, CSTR, columns 11-15: no structure is named"),
    ] {
        let coefficients = format!("    07    WFS1\n{card}\n").leak();
        says(&DeckJob { coefficients, ..MOORED }, Severity::Error, message, card);
    }
}

#[test]
fn water_depth_below_zero_is_refused_with_its_sense() {
    let job = DeckJob { depth: "    -100.0", ..MOORED };
    says(&job, Severity::Error, "deck 5, DPTH, columns 11-20: -100 is not above 0", "    05DPTH    -100.0");
    let (said, _) = job.said().into_iter().find(|(said, _)| said.severity == Severity::Error).unwrap();
    assert_eq!(said.help, ["the depth is measured down from the still water level: 100.0 is 100 deep"]);
}

#[test]
fn line_deck_names_scheme_of_its_run_and_no_errors_of_another() {
    let mut sources = Sources::default();
    let id = sources.add("deck", MOORED.text().as_str(), 1);
    let pages = read(&sources, id).deck.listing_before_motion();
    let titles: Vec<&str> = pages.iter().map(|page| page.title.as_str()).collect();
    assert!(
        titles.contains(&"Time Integration Parameters") && !titles.iter().any(|t| t.contains("Expected Errors")),
        "{titles:?}"
    );
    let page = pages.iter().find(|page| page.title == "Time Integration Parameters").unwrap();
    assert!(format!("{page:?}").contains("IMPLICIT, GENERALISED-ALPHA, SPECTRAL RADIUS 0.900"), "{page:?}");
}
