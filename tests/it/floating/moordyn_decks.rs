//! MoorDyn decks of tests/data/moordyn, read as static lines, beside MoorPy 1.3.0 [MOORPY-1], an independent program:
//! tests/data/moordyn/moorpy.csv, which moorpy_decks.py beside it made. Wrong decks: the place of the word.

use crate::common;

use windlass_model::Model;
use windlass_solve::{EquilibriumOptions, System, equilibrium};

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/moordyn");

/// The model of a deck.
fn read(name: &str, options: &str) -> Model {
    let (mut session, _screen, _folder) = common::session();
    session.open("records", format!("INMODEL -MOORDYN \"{FOLDER}/{name}.txt\" {options}\n"));
    session.run();
    assert!(session.errors == 0, "{name}: {:?}", session.reports);
    session.job.model.clone()
}

/// Tensions (N) of each line at the ends that are not in the ground, the first end first.
fn tensions(model: &Model) -> Vec<(String, Vec<f64>)> {
    let system = System::new(model, &[]).unwrap();
    let mut state = system.state(model);
    let found = equilibrium(&system, &mut state, &EquilibriumOptions::default()).unwrap();
    assert!(found.search.residual < 1e-9, "{found:?}");
    let mut list: Vec<(String, Vec<f64>)> = model.connectors.values().map(|c| (c.name.clone(), Vec::new())).collect();
    for part in system.contributions(&state.poses).unwrap() {
        let own = part.connector.as_deref().and_then(|name| list.iter_mut().find(|(other, _)| other == name));
        if let Some((_, ends)) = own {
            ends.push(part.load.wrench.fixed_rows::<3>(0).norm());
        }
    }
    list
}

#[test]
fn static_lines_of_decks_have_the_tensions_of_moorpy() {
    let mut reader = csv::Reader::from_path("tests/data/moordyn/moorpy.csv").unwrap();
    let mut rows = Vec::new();
    for row in reader.records() {
        let row = row.unwrap();
        let [ta, tb] = [2, 3].map(|i| row[i].parse::<f64>().unwrap());
        rows.push((row[0].to_string(), format!("L{}", &row[1]), ta, tb));
    }
    assert_eq!(rows.len(), 16);
    let mut decks: Vec<String> = rows.iter().map(|row| row.0.clone()).collect();
    decks.dedup();
    for deck in decks {
        let found = tensions(&read(&deck, "-STATIC"));
        for (_, line, ta, tb) in rows.iter().filter(|row| row.0 == deck) {
            let (_, ends) = found.iter().find(|(name, _)| name == line).unwrap();
            let off = |want: f64| ends.iter().map(|got| (got / want - 1.0).abs()).fold(f64::INFINITY, f64::min);
            // MoorPy stops at steps of 1e-6 m or so of a free point
            assert!(off(*tb) < 1e-4, "{deck} {line}: {ends:?}, MoorPy {tb}");
            assert!(ends.len() == 1 || off(*ta) < 1e-4, "{deck} {line}: {ends:?}, MoorPy {ta}");
        }
    }
}

#[test]
fn dynamic_lines_of_decks_rest_near_their_catenaries() {
    // elements of 17 m and a bottom of 1 MPa/m against MoorPy's catenary on a rigid one
    let found = tensions(&read("grounded_chain", ""));
    assert!((found[0].1[0] / 504522.26 - 1.0).abs() < 2e-3, "{found:?}");
}

#[test]
fn deck_errors_are_at_their_words() {
    let good = std::fs::read_to_string(format!("{FOLDER}/bridle.txt")).unwrap();
    let cases = [
        ("1  coupled  2", "1  free  2", "free", "the free body 1"),
        ("0  0  30  0  0", "0  5  30  0  0", "1", "turned about more than one axis"),
        ("100  depth", "100  dephts", "dephts", "option dephts is not known"),
        ("100  depth", "100  depth\n1  WaveKin", "1", "the waves of WaveKin 1 are not read"),
        ("100  depth", "100  depth\n1  Currents", "1", "the current of Currents 1 is not read"),
        ("100  depth", "100  depth\nsea.txt  SeafloorFile", "sea.txt", "the seafloor file sea.txt is not read"),
        ("3.0e7", "stiff.txt", "stiff.txt", "the table of stiffness stiff.txt is not read"),
        ("45     6    -45   0  0  0", "45     6    -45   0  0  2", "2", "a junction has no CdA"),
        ("45     6    -45", "45     6    -45", "", ""),
    ];
    for (old, new, word, message) in cases {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("deck.txt");
        assert!(good.contains(old), "{old}");
        let deck = good.replacen(old, new, 1);
        std::fs::write(&path, &deck).unwrap();
        let (mut session, _screen, _folder) = common::session();
        session.open("records", format!("INMODEL -MOORDYN \"{}\"\n", path.display()));
        session.run();
        if message.is_empty() {
            assert_eq!(session.errors, 0, "{:?}", session.reports);
            continue;
        }
        let said = session.reports.iter().find(|r| r.message.contains(message));
        let span = said.unwrap_or_else(|| panic!("{new}: {:?}", session.reports)).span.unwrap();
        assert_eq!(&deck[span.start as usize..span.end as usize], word, "{new}");
        assert!(session.errors > 0 && session.job.model.connectors.is_empty(), "{new}: {:?}", session.reports);
    }
}

#[test]
fn drag_area_that_a_static_deck_leaves_out_is_warned_of_at_its_word() {
    let good = std::fs::read_to_string(format!("{FOLDER}/chain_polyester_clump.txt")).unwrap();
    let deck = good.replacen("8000   1.0  0  0", "8000   1.0  3  0", 1);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("deck.txt");
    std::fs::write(&path, &deck).unwrap();
    let (mut session, _screen, _folder) = common::session();
    session.open("records", format!("INMODEL -MOORDYN \"{}\" -STATIC\n", path.display()));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let said = session.reports.iter().find(|r| r.message.contains("CdA of the free point 2 is left out"));
    let span = said.unwrap_or_else(|| panic!("{:?}", session.reports)).span.unwrap();
    assert_eq!(&deck[span.start as usize..span.end as usize], "3");
}

#[test]
fn static_without_a_moordyn_deck_is_refused() {
    let (mut session, _screen, _folder) = common::session();
    session.open("records", "INMODEL -STATIC\n");
    session.run();
    assert_eq!(session.errors, 1, "{:?}", session.reports);
    assert!(session.reports[0].message.contains("how the lines of a MoorDyn deck are read"));
}

#[test]
fn driven_taut_leg_of_a_deck_has_the_forces_of_moordyn() {
    let (mut session, _screen, folder) = common::session();
    session.open(
        "records",
        format!(
            "INMODEL -MOORDYN \"{FOLDER}/taut_leg.txt\"\n&DIMEN -DIMEN METERS NEWTONS\nMEDIT\n\
             PRESCRIBE VESSEL -SINUSOID X 2 12 -SINUSOID Z 1 12\nEND\n&ENV MOORDYN -TIME 96 0.1\nTDOM -SCREEN NO\nPRCPOST\n\
             CONFORCE L1\nSTORE forces.csv\nEND\nEND\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let mut reader = csv::Reader::from_path(folder.path().join("job.ans/forces.csv")).unwrap();
    let rows: Vec<Vec<f64>> = reader
        .records()
        .map(|row| row.unwrap().iter().map(|word| word.parse().unwrap_or(f64::NAN)).collect())
        .collect();
    let late: Vec<f64> = rows.iter().filter(|row| row[0] > 60.0).map(|row| row[4]).collect();
    let largest = late.iter().fold(f64::MIN, |a, b| a.max(*b));
    let least = late.iter().fold(f64::MAX, |a, b| a.min(*b));
    // MoorDyn 2.7.2 by tests/data/moordyn/moordyn_taut_leg.py; with 80 and 160 segments it moves by 0.1 % of the range
    let (want_largest, want_least) = (1544574.4, 1438325.8);
    let room = 0.01 * (want_largest - want_least);
    assert!((largest - want_largest).abs() < room && (least - want_least).abs() < room, "{largest} {least}");
}

#[test]
fn names_of_a_deck_that_the_model_has_are_refused() {
    let (mut session, _screen, _folder) = common::session();
    let deck = format!("INMODEL -MOORDYN \"{FOLDER}/grounded_chain.txt\"\n");
    session.open("records", format!("MEDIT\n~CHAIN B_CAT 4 -LEN 100\n*P2 0 0 0\nEND\n{deck}"));
    session.run();
    assert_eq!(session.errors, 2, "{:?}", session.reports);
    let said: Vec<&str> =
        session.reports.iter().map(|r| r.message.as_str()).filter(|m| m.contains("already")).collect();
    assert_eq!(said.len(), 2, "{said:?}");
    assert!(session.job.model.connectors.is_empty() && session.job.model.points.len() == 1);
}
