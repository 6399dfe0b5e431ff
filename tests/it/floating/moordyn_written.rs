//! `STORE -MOORDYN`: decks that windlass writes, read back beside the numbers of MoorPy 1.3.0 [MOORPY-1] and MoorDyn 2.7.2 [MOORDYN-2]; what a deck cannot
//! hold.

use super::moordyn_decks::tensions;
use crate::common;

use windlass_model::Model;

const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/moordyn");

/// The files that records write, by name, and what was said.
fn written(records: &str) -> (Vec<(String, String)>, Vec<String>) {
    let (mut session, _screen, folder) = common::session();
    session.open("records", records.to_string());
    session.run();
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder.path().join("job.ans")).into_iter().flatten().flatten() {
        if let (Ok(text), true) = (std::fs::read_to_string(entry.path()), entry.path().is_file()) {
            files.push((entry.file_name().to_string_lossy().into_owned(), text));
        }
    }
    (files, session.reports.iter().map(|report| report.message.clone()).collect())
}

fn file<'a>(files: &'a [(String, String)], name: &str) -> &'a str {
    files.iter().find(|(other, _)| other == name).map(|(_, text)| text.as_str()).unwrap_or_default()
}

/// The model of a deck with the files beside it.
fn read(files: &[(String, String)], options: &str) -> Model {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    let (mut session, _screen, _folder) = common::session();
    session.open("records", format!("INMODEL -MOORDYN \"{}/deck.txt\" {options}\n", folder.path().display()));
    session.run();
    assert!(session.errors == 0, "{:?}\n{}", session.reports, file(files, "deck.txt"));
    session.job.model.clone()
}

/// Rows deck, line, TA, TB of a file of MoorPy's numbers.
fn moorpy(name: &str) -> Vec<(String, String, [f64; 2])> {
    let mut reader = csv::Reader::from_path(format!("{FOLDER}/{name}")).unwrap();
    let row = |row: csv::StringRecord| {
        (row[0].to_string(), format!("L{}", &row[1]), [2, 3].map(|i| row[i].parse::<f64>().unwrap()))
    };
    reader.records().map(|record| row(record.unwrap())).collect()
}

/// Compares the tensions of a model with those of MoorPy.
fn compare(deck: &str, model: &Model, rows: &[(String, String, [f64; 2])]) {
    let found = tensions(model);
    let own: Vec<_> = rows.iter().filter(|row| row.0 == deck).collect();
    assert_eq!(found.len(), own.len(), "{deck}");
    for (_, line, wanted) in own {
        let (_, ends) = found.iter().find(|(name, _)| name == line).unwrap();
        let off = |want: f64| ends.iter().map(|got| (got / want - 1.0).abs()).fold(f64::INFINITY, f64::min);
        // MoorPy stops at steps of 1e-6 m or so of a free point
        assert!(off(wanted[1]) < 1e-4, "{deck} {line}: {ends:?}, MoorPy {wanted:?}");
        assert!(ends.len() == 1 || off(wanted[0]) < 1e-4, "{deck} {line}: {ends:?}, MoorPy {wanted:?}");
    }
}

#[test]
fn friction_by_speed_of_a_deck_is_written_as_its_fricdamp() {
    // 1e4 N s/m of a node: CF of -SEABED is that over the shadow of a segment
    let records =
        format!("INMODEL -MOORDYN \"{FOLDER}/driven/slope_like.txt\" -LIKE MOORDYN\nSTORE -MOORDYN deck.txt\n");
    let (files, said) = written(&records);
    let deck = file(&files, "deck.txt");
    for row in ["10000  FricDamp", "0.6  FrictionCoefficient", "200000  kBot"] {
        assert!(deck.lines().any(|line| line == row), "{row}: {said:?}\n{deck}");
    }
}

#[test]
fn decks_written_anew_have_the_tensions_of_moorpy() {
    let rows = moorpy("moorpy.csv");
    let mut decks: Vec<&str> = rows.iter().map(|row| row.0.as_str()).collect();
    decks.dedup();
    assert!(decks.len() >= 9);
    for deck in decks {
        for options in ["-STATIC", ""] {
            let records = format!("INMODEL -MOORDYN \"{FOLDER}/{deck}.txt\" {options}\nSTORE -MOORDYN deck.txt\n");
            let (files, said) = written(&records);
            assert!(!file(&files, "deck.txt").is_empty(), "{deck}: {said:?}");
            compare(deck, &read(&files, "-STATIC"), &rows);
        }
    }
}

/// A spread of chain and rope with a clump, and a bridle that meets in a junction.
const SPREAD: &str = include_str!("../../data/moordyn/written_spread.cif");

#[test]
fn spread_written_as_a_deck_is_the_one_that_moorpy_was_given() {
    let (files, said) = written(SPREAD);
    let stored = std::fs::read_to_string(format!("{FOLDER}/written_spread.txt")).unwrap();
    assert_eq!(file(&files, "deck.txt"), stored.replace("written_spread.txt", "deck.txt"), "{said:?}");
    compare("written_spread", &read(&files, "-STATIC"), &moorpy("moorpy_written.csv"));
}

#[test]
fn water_of_a_written_deck_is_that_of_the_model() {
    let records = "&DIMEN -DIMEN METERS K-NTS\n&DATA CURVES C_PROFILE SHEAR 0 0.8 40 0.3\n\
                   &ENV STORM -DEPTH 80 -WATER 1030 -STRETCHING WHEELER -CURRENT SHEAR 210 -WAVES 9 2.5 30 200 7 1 100 170\nMEDIT\n\
                   ~ROPE ROD 80 40 -LEN 120 -WTPLEN 0.2 -REFINE 12 -STRETCH 100 0.01 400 0.03\n*A 90 0 -80\n*B 0 0 -5\n\
                   CONNECTOR L ~ROPE *B *A\nEND\nSTORE -MOORDYN deck.txt\n";
    let (files, said) = written(records);
    let model = read(&files, "");
    assert_eq!((model.defaults.depth, model.defaults.water_density), (Some(80.0), 1030.0), "{said:?}");
    let sea = windlass_hydro::sea::Sea::new(&model, &model.environment).unwrap().unwrap();
    // 2.5 cos(k x - w t + 30 deg) that comes from 200 deg, and 1 m of 7 s
    for time in [0.0f64, 3.7] {
        let want = [(2.5f64, 9.0f64, 30f64), (1.0, 7.0, 100.0)]
            .map(|(a, t, phase)| a * (phase.to_radians() - std::f64::consts::TAU / t * time).cos());
        assert!((sea.elevation(0.0, 0.0, time) - want[0] - want[1]).abs() < 1e-9, "{time}");
    }
    assert!((sea.components[0].toward[0] - 20f64.to_radians().cos()).abs() < 1e-9);
    let current = windlass_hydro::current::CurrentField::new(&model, &model.environment, None).unwrap();
    let (velocity, _) = current.at_depth(20.0);
    // half way between 0.8 and 0.3 m/s, toward 30 deg
    assert!((velocity.x - 0.55 * 30f64.to_radians().cos()).abs() < 1e-9 && (velocity.y - 0.275).abs() < 1e-9);
    // 250 kN halfway between the points of the table
    assert!(file(&files, "rope_stiffness.txt").ends_with("0.01 100000\n0.03 400000"), "{files:?}");
}

#[test]
fn drag_areas_of_a_written_body_are_those_that_moordyn_keeps() {
    // MoorDyn 2.7.2 loses the first one of six, as its run of driven/body_like.txt shows; of two it keeps both
    for (areas, want, is_lost) in [("60 60 60 -R_DRAG 900 900 900", "60|900", false), ("8 8 12", "8|8|12|0|0|0", true)]
    {
        let (files, said) = written(&format!(
            "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 80\nMEDIT\n*A 90 0 -80\n&DESCRIBE BODY B\n&INSTATE -LOCATE B 0 0 -20\n*F 0 0 0\n\
             #WEIGHT *F 100 2 2 2\n#LUMP *F 20 -DRAG {areas} -CONSTANT\n~LEG ROD 80 40 -LEN 130 -WTPLEN 1\nCONNECTOR L1 ~LEG *F *A\nEND\n\
             STORE -MOORDYN deck.txt\n"
        ));
        let text = file(&files, "deck.txt");
        let row = text.lines().find(|line| line.starts_with("1 ") && line.contains("Free")).unwrap_or_default();
        assert!(row.split_whitespace().any(|word| word == want), "{said:?}\n{text}");
        assert_eq!(said.iter().any(|said| said.contains("loses the first one of six")), is_lost, "{said:?}");
    }
}

#[test]
fn what_a_deck_cannot_hold_is_named_and_nothing_is_written() {
    let head = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 80\nMEDIT\n*A 90 0 -80\n*F 0 0 -5\n~LEG B_CAT 80 EXACT -LEN 130\nCONNECTOR L1 ~LEG *F *A\n";
    for (records, message) in [
        (
            "~S FIX X Y Z\nCONNECTOR S1 ~S *F\nEND\n",
            "a deck cannot hold S1: it is a joint of class type FIX, and what is pinned in MoorDyn 2.7.2 does not feel that its pin accelerates",
        ),
        (
            "~H H_CAT 80 -LEN 100\nCONNECTOR S1 ~H *F *A\nEND\n",
            "a deck cannot hold S1: it is a spring without weight along its chord",
        ),
        (
            "~G B_CAT 80 EXACT -LEN 130 -FRICTION 0.6\nCONNECTOR S1 ~G *F *A\nEND\n",
            "a deck cannot hold S1: its friction of the seabed is not that of L1",
        ),
        (
            "~G B_CAT 80 EXACT -LEN 130 -SEND 100\nCONNECTOR S1 ~G *F *A\nEND\n",
            "a deck cannot hold S1: it has springs, pistons or dashpots",
        ),
        ("END\n&ENV -DEPTH 80 -TIDE 1\n", "a deck has no tide"),
        (
            "~R ROD 80 40 -LEN 130 -WTPLEN 1 -EI 5 -CLAMP FIRST\nCONNECTOR S1 ~R *F *A\nEND\n",
            "a deck cannot hold S1: -CLAMP holds its ends",
        ),
    ] {
        let (files, said) = written(&format!("{head}{records}STORE -MOORDYN deck.txt\n"));
        assert!(said.iter().any(|text| text.starts_with(message)), "{records}: {said:?}");
        assert!(file(&files, "deck.txt").is_empty(), "{records}");
    }
}

#[test]
fn free_bodies_and_rods_of_a_deck_come_back_as_they_were() {
    for (deck, rows) in [("free_body", "Body1"), ("rod_hung", "R1A")] {
        let (files, said) = written(&format!("INMODEL -MOORDYN \"{FOLDER}/{deck}.txt\"\nSTORE -MOORDYN deck.txt\n"));
        let text = file(&files, "deck.txt");
        assert!(text.contains(rows), "{said:?}\n{text}");
        let source = windlass_base::span::SourceId::new(0);
        let original =
            windlass_moordyn::read(&std::fs::read_to_string(format!("{FOLDER}/{deck}.txt")).unwrap(), source).deck;
        let again = windlass_moordyn::read(text, source).deck;
        for (a, b) in original.rods.iter().zip(&again.rods) {
            assert_eq!(a.attachment.value, b.attachment.value);
            assert!(a.ends.iter().flatten().zip(b.ends.iter().flatten()).all(|(a, b)| (a - b).abs() < 1e-9));
        }
        for (a, b) in original.rod_types.iter().zip(&again.rod_types) {
            let numbers = |kind: &windlass_moordyn::tables::RodType| {
                [&kind.diameter, &kind.mass, &kind.normal[0], &kind.normal[1], &kind.end[0], &kind.end[1]]
                    .map(|given| given.value)
            };
            assert!(
                numbers(a).iter().zip(numbers(b)).all(|(a, b)| (a - b).abs() < 1e-6 * a.abs().max(1.0)),
                "{a:?} {b:?}"
            );
        }
        assert_eq!((original.rods.len(), original.bodies.len()), (again.rods.len(), again.bodies.len()));
        for (a, b) in original.bodies.iter().zip(&again.bodies) {
            assert!((a.mass.value - b.mass.value).abs() < 1e-6 * a.mass.value);
            assert!(a.inertia.value.iter().zip(&b.inertia.value).all(|(a, b)| (a - b).abs() < 1e-6 * a));
        }
    }
}
