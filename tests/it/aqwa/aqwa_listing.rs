//! The listings of the two decks as a user sees them: which pages come in which order, and the pages that are made with the model
//! [AQWA-TETHER 8.1 and 8.2].

use crate::common;

/// What a deck prints.
fn print_deck(name: &str) -> String {
    let (mut session, screen, _folder) = common::session();
    session.open_job(name, std::fs::read_to_string(format!("scripts/{name}")).unwrap());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    screen.text()
}

/// Titles without the blanks between their letters, each once.
fn titles(text: &str) -> Vec<String> {
    let mut list: Vec<String> = Vec::new();
    for line in text.lines().map(str::trim) {
        let own = |mark: &str| line.strip_prefix(mark).and_then(|rest| rest.strip_suffix(mark));
        let Some(title) = own("* * * *").or_else(|| own("+++")) else { continue };
        let words: Vec<String> = title.trim().split("   ").map(|word| word.replace(' ', "")).collect();
        let title = words.join(" ");
        if !list.contains(&title) {
            list.push(title);
        }
    }
    list
}

fn come_in_order(list: &[String], wanted: &[&str]) {
    let mut rest = list.iter();
    for title in wanted {
        assert!(rest.any(|found| found.starts_with(title)), "{title} is not behind the one before it in {list:#?}");
    }
}

#[test]
fn pages_of_installed_deck_come_in_order_of_listing() {
    let wanted = [
        "COORDINATE DATA",
        "GLOBAL PARAMETERS",
        "WAVE FREQUENCIES/PERIODS AND DIRECTIONS",
        "ENVIRONMENTAL PARAMETERS",
        "CONSTRAINTS",
        "REGULAR WAVE PARAMETERS",
        "DESCRIPTION OF TENSION LEG TETHER T1",
        "DESCRIPTION OF TENSION LEG TETHER T4",
        "EIGENSOLUTION MODE 1 - TETHER T1",
        "EIGENSOLUTION MODE 12 - TETHER T1",
        "INITIAL POSITION AND VELOCITY",
        "TIME INTEGRATION PARAMETERS",
        "PARAMETERS AFFECTING HYDRODYNAMIC MORISON ELEMENT FORCES",
        "POSITION OF USER-REQUESTED NODES",
        "STRUCTURE S1",
        "TIME HISTORY OF SINGLE TETHER T1",
        "TIME HISTORY OF FORCES AND STRESSES FOR TETHER T1",
        "HARMONIC ANALYSIS OF STRUCTURE S1 - POSITION OF COG",
        "HARMONIC ANALYSIS OF STRUCTURE S1 - VELOCITY OF COG",
        "HARMONIC ANALYSIS OF STRUCTURE S1 - ACCELERATION OF COG",
    ];
    let text = print_deck("mint.dat");
    come_in_order(&titles(&text), &wanted);
    // VESSEL ATTACHMENT: position in FRA and at the start; inline springs by default
    for line in ["- POSITION IN FRA Z              = 12.850 m", "- INITIAL POSITION Z             = -68.150 m"] {
        assert!(text.contains(line), "{line}");
    }
    assert!(text.contains("1.00E+15    5.73E+03    5.73E+03"));
    assert!(text.contains("4 MODES> 999.999 RAD/SEC (PERIOD= 0.0063 SECS) NOT PRINTED"));
}

#[test]
fn pages_of_towed_deck_come_in_order_of_listing() {
    let wanted = [
        "MASS AND INERTIA PROPERTIES",
        "HYDRODYNAMIC PARAMETERS FOR STRUCTURE 1 AT THE FREE-FLOATING EQUILIBRIUM POSITION",
        "CONSTRAINTS",
        "SPECTRAL PARAMETERS",
        "DESCRIPTION OF TENSION LEG TETHER T1",
        "EIGENSOLUTION MODE 6 - TETHER T1",
        "INITIAL POSITION AND VELOCITY",
        "PARAMETERS AFFECTING HYDRODYNAMIC MORISON ELEMENT FORCES",
        "WAVE SPECTRAL LINES",
        "STRUCTURE S1",
        "TIME HISTORY OF SINGLE TETHER T1",
        "TETHER T1 STATISTICS: NODE 1 - POSITION",
        "TETHER T1 STATISTICS: NODE 14 - ACCELERATION",
        "TETHER T1 STATISTICS: ELEMENT 13 - BENDING MOMENTS AND STRESSES",
        "TETHER T1 STATISTICS: MEAN VALUE",
        "TETHER T1 STATISTICS: MINIMUM PEAKS",
        "STRESS RANGE PROBABILITY DISTRIBUTION",
        "FATIGUE ANALYSIS AND MAXIMUM STRESS",
    ];
    let text = print_deck("he01_phases.dat");
    come_in_order(&titles(&text), &wanted);
    // the comment behind the modes has 5.5079 s for 5.5074: 1e-4
    assert!(text.contains("50 MODES> 1.141 RAD/SEC (PERIOD= 5.5074 SECS) NOT PRINTED"));
    assert!(text.contains("- STOP DIST BELOW ANCHOR         = 100.000 m"));
    assert!(text.contains("IMPACT COEFFICIENTS - HALF LIFE  = 100.000 s"));
    assert!(text.contains("Elapsed time                     = 350.250 s"));
    // the mooring on the vessel at 125 s, 1.5168E-01 printed: the spring of 0.5 kN/m by 0.303 m
    let page = text.split("RECORD NO.                       = 501").nth(1).unwrap();
    let mooring = page.lines().find(|line| line.trim_start().starts_with("MOORING")).unwrap();
    let pull: f64 = mooring.split_whitespace().nth(3).unwrap().parse().unwrap();
    // the place of that end is within 0.04 m of the listing at this time [W-TOWED 5]
    assert!((pull - 0.15168).abs() < 0.02, "{pull}");
}

#[test]
fn spectral_lines_match_listing() {
    let text = print_deck("he01_phases.dat");
    assert!(text.contains("4 TIMES SQUARE ROOT OF RASTER AREA(S.W.H.) = 6.293"));
    let page = text.split("4 TIMES SQUARE ROOT").nth(1).unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("----")).skip(1).take(50);
    let csv = std::fs::read_to_string("tests/data/aqwa_tether_spectrum.csv").unwrap();
    let printed = csv.lines().filter(|line| line.starts_with(|c: char| c.is_ascii_digit()));
    let mut count = 0;
    for (found, printed) in rows.zip(printed) {
        let found: Vec<f64> = found.split_whitespace().map(|word| word.parse().unwrap()).collect();
        let printed: Vec<f64> = printed.split(',').map(|word| word.parse().unwrap()).collect();
        assert_eq!((found[0], found[3]), (printed[0], printed[3]));
        // wave numbers of the listing are of deep water in single precision: 1.3e-4; a unit of the last digit of the frequency
        assert!((found[1] / printed[1] - 1.0).abs() < 1.6e-4, "{found:?} {printed:?}");
        assert!((found[2] - printed[2]).abs() < 1.01e-4, "{found:?} {printed:?}");
        assert!((found[4] - printed[4]).abs() < 8e-4, "{found:?} {printed:?}");
        count += 1;
    }
    assert_eq!(count, 50);
}

/// The pages of the structure: the number of their records, and the names of the rows of the first.
fn structure_pages(text: &str) -> (Vec<usize>, Vec<String>) {
    let pages: Vec<&str> = text.split("RECORD NO.                       = ").skip(1).collect();
    let records = pages.iter().map(|page| page.split_whitespace().next().unwrap().parse().unwrap()).collect();
    let rows = pages.first().map_or(Vec::new(), |page| {
        let lines = page.lines().skip_while(|line| !line.starts_with("----")).skip(1);
        // a name ends where two blanks are
        lines.take_while(|line| !line.is_empty()).map(|l| l.trim().split("  ").next().unwrap().to_string()).collect()
    });
    (records, rows)
}

/// PREV 10 and PREV 500: the records that the listings have. NOPR and PRNT: the rows that they have, but for CURRENT DRAG, which is part of MORISON DRAG here,
/// and L/WAVE DRIFT DAMPING, which no towed tether has.
#[test]
fn structure_pages_have_records_and_rows_of_listing() {
    let (records, rows) = structure_pages(&print_deck("mint.dat"));
    assert_eq!(records, [1, 11, 21, 31, 41, 51, 61, 71, 81, 91, 101]);
    let listed = [
        "POSITION",
        "VELOCITY",
        "ACCELERATION",
        "GRAVITY",
        "HYDROSTATIC",
        "MORISON DRAG",
        "FROUDE KRYLOV",
        "MOORING",
        "TOTAL FORCE",
        "ERROR PER TIMESTEP",
        "POSITION *S1_112",
    ];
    assert_eq!(rows, listed);
    let (records, rows) = structure_pages(&print_deck("he01_phases.dat"));
    assert_eq!(records, [1, 501, 1001, 1501]);
    let listed = ["POSITION", "VELOCITY", "ACCELERATION", "GRAVITY", "HYDROSTATIC", "MORISON DRAG", "FROUDE KRYLOV"];
    assert_eq!(rows[..7], listed);
    assert_eq!(rows[7..], ["DIFFRACTION", "MOORING", "TOTAL FORCE"]);
}

/// TPRV 500: the steps that the listing has. The places of node 112 are printed at eleven times.
#[test]
fn tether_pages_and_node_places_are_those_of_listing() {
    let text = print_deck("he01_phases.dat");
    let page = text.split("T I M E   H I S T O R Y   O F   S I N G L E").nth(1).unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("----")).skip(1).take_while(|line| !line.is_empty());
    let mut steps: Vec<String> = rows.map(|line| line.split_whitespace().next().unwrap().to_string()).collect();
    assert_eq!(steps.len(), 4 * 14);
    steps.dedup();
    assert_eq!(steps, ["1", "501", "1001", "1501"]);
    let text = print_deck("mint.dat");
    let listing: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string("tests/data/installed_tether.json").unwrap()).unwrap();
    let states = listing["structure_history"].as_array().unwrap();
    let lines = text.lines().filter(|line| line.trim_start().starts_with("POSITION *S1_112"));
    let mut count = 0;
    for (line, state) in lines.zip(states) {
        let found: Vec<f64> = line.split_whitespace().skip(2).map(|word| word.parse().unwrap()).collect();
        let wanted = state["POSITION NODE 112"].as_array().unwrap();
        // 6 mm of surge and heave to 25 s; the node is 52.7 m aside of a pitch that is met to 0.0016 degrees
        assert!(found.iter().zip(wanted).all(|(found, want)| (found - want.as_f64().unwrap()).abs() < 8e-3), "{line}");
        count += 1;
    }
    assert_eq!(count, 11);
}

#[test]
fn parameter_without_a_known_row_is_reported() {
    let deck = std::fs::read_to_string("scripts/mint.dat").unwrap();
    let reports = |from: &str, to: &str| {
        let (mut session, _, _folder) = common::session();
        assert!(deck.contains(from));
        session.open_job("mint.dat", deck.replace(from, to));
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        session.reports.iter().map(|report| report.message.clone()).collect::<Vec<String>>()
    };
    let said = reports("    18NOPR    1   25", "    18NOPR    1   22");
    assert!(said.iter().any(|m| m.contains("parameter 22 stands for a row that no source names")), "{said:?}");
    let said = reports(" END18PRNT    1   49", " END18PRNT    1    8");
    assert!(said.iter().any(|m| m.contains("parameter 8 is a row that windlass does not have")), "{said:?}");
    let said = reports("    18NOPR    1   25", "    18NOPR    1   26");
    assert!(!said.iter().any(|m| m.contains("parameter")), "{said:?}");
}
