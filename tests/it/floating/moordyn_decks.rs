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
pub fn tensions(model: &Model) -> Vec<(String, Vec<f64>)> {
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
    assert_eq!(rows.len(), 23);
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

/// The model of a file of MAP++ in water of a depth (m).
fn read_map(name: &str, depth: f64) -> Model {
    let (mut session, _screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -GRAVITY 9.80665 -DEPTH {depth}\n\
             INMODEL -MOORDYN \"{FOLDER}/{name}.map\"\n"
        ),
    );
    session.run();
    assert!(session.errors == 0, "{name}: {:?}", session.reports);
    session.job.model.clone()
}

#[test]
fn files_of_map_have_the_tensions_of_moorpy() {
    // tests/data/moordyn/moorpy_map.py
    let mut reader = csv::Reader::from_path("tests/data/moordyn/moorpy_map.csv").unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 8);
    for (deck, depth) in [("map_spread", 200.0), ("map_bridle", 150.0)] {
        let model = read_map(deck, depth);
        let found = tensions(&model);
        for row in rows.iter().filter(|row| &row[0] == deck) {
            let (_, ends) = found.iter().find(|(name, _)| name[1..] == row[1]).unwrap();
            for want in [2, 3].into_iter().skip(2 - ends.len()).map(|i| row[i].parse::<f64>().unwrap()) {
                let off = ends.iter().map(|got| (got / want - 1.0).abs()).fold(f64::INFINITY, f64::min);
                assert!(off < 1e-4, "{deck} {}: {ends:?}, MoorPy {want}", &row[1]);
            }
        }
    }
}

#[test]
fn friction_of_a_file_of_map_acts_on_its_anchors() {
    // the horizontal pull on the anchor of MoorPy's catenary with CB 0.8, in the column HA
    let (text, errors) = common::print_records(&format!(
        "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -GRAVITY 9.80665 -DEPTH 200\n\
         INMODEL -MOORDYN \"{FOLDER}/map_spread.map\"\n&STATUS F_CONNECTOR\n"
    ));
    assert_eq!(errors, 0, "{text}");
    let mut reader = csv::Reader::from_path("tests/data/moordyn/moorpy_map.csv").unwrap();
    for row in reader.records().map(Result::unwrap).filter(|row| &row[0] == "map_spread") {
        let name = format!("L{}", &row[1]);
        let line = text.lines().find(|line| line.split_whitespace().next() == Some(&name)).unwrap();
        let words: Vec<&str> = line.split_whitespace().collect();
        let (pull, want): (f64, f64) = (words[11].parse().unwrap(), row[4].parse().unwrap());
        // friction holds all of it: the anchor feels nothing
        assert!(pull == 0.0 && want == 0.0, "{line}: MoorPy {want}");
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
        ("1  coupled  2", "1  free  2", "0", "the free body 1 has no mass"),
        ("0  0  30  0  0", "0  5  30  0  0", "1", "turned about more than one axis"),
        ("100  depth", "100  dephts", "dephts", "option dephts is not known"),
        ("100  depth", "100  depth\n1  WaveKin", "1", "the waves of WaveKin 1 are those of the caller"),
        ("100  depth", "100  depth\n1  Currents", "1", "current_profile.txt"),
        ("100  depth", "100  depth\nsea.txt  SeafloorFile", "sea.txt", "there is no file"),
        ("3.0e7", "stiff.txt", "stiff.txt", "there is no file"),
        (
            "--- OPTIONS",
            "--- OPTINOS",
            "--------------------- OPTINOS -------------------------",
            "section OPTINOS is not known",
        ),
        (
            "MoorDyn v2: a bridle: two pendants and one leg meet at a free point",
            "--- LINE TYPE ---",
            "--- LINE TYPE ---",
            "section LINE TYPE is not known",
        ),
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
fn static_and_like_without_a_moordyn_deck_are_refused() {
    for (option, message) in [
        ("-STATIC", "how the lines of a MoorDyn deck are read"),
        ("-LIKE MOORDYN", "whose answers a MoorDyn deck is read for"),
    ] {
        let (mut session, _screen, _folder) = common::session();
        session.open("records", format!("INMODEL {option}\n"));
        session.run();
        assert_eq!(session.errors, 1, "{:?}", session.reports);
        assert!(session.reports[0].message.contains(message), "{:?}", session.reports);
    }
}

/// A deck whose body VESSEL is moved by `sinusoid` over a `window` of time.
struct Drive<'a> {
    deck: &'a str,
    /// Options of INMODEL.
    options: &'a str,
    sinusoid: &'a str,
    window: &'a str,
    /// What counts begins here (s).
    from: f64,
}

impl Drive<'_> {
    /// Largest and least value of columns of tables of PRCPOST, each given by its record and the first word of its head; in N, m and degrees.
    fn extremes(&self, columns: &[(&str, &str)]) -> Vec<(f64, f64)> {
        let Drive { deck, options, sinusoid, window, from } = self;
        let (mut session, _screen, folder) = common::session();
        let number = |(index, (record, _)): (usize, &(&str, &str))| format!("{record}\nSTORE table{index}.csv\nEND\n");
        let tables: String = columns.iter().enumerate().map(number).collect();
        session.open(
            "records",
            format!(
                "INMODEL -MOORDYN \"{FOLDER}/{deck}.txt\" {options}\n&DIMEN -DIMEN METERS NEWTONS\nMEDIT\n\
                 PRESCRIBE VESSEL -SINUSOID {sinusoid}\nEND\n&EQUI\n&ENV MOORDYN -TIME {window}\nTDOM -SCREEN NO\nPRCPOST\n\
                 {tables}END\n"
            ),
        );
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        let extremes = |(index, (record, head)): (usize, &(&str, &str))| {
            let mut reader = csv::Reader::from_path(folder.path().join(format!("job.ans/table{index}.csv"))).unwrap();
            let is_wanted = |own: &str| own.split_whitespace().next() == Some(head);
            let place = reader.headers().unwrap().iter().position(is_wanted);
            let place = place.unwrap_or_else(|| panic!("{record} has no {head}"));
            let rows =
                reader.records().map(|row| [0, place].map(|at| row.as_ref().unwrap()[at].parse::<f64>().unwrap()));
            let late: Vec<f64> = rows.filter(|row| row[0] > *from).map(|row| row[1]).collect();
            (late.iter().fold(f64::MIN, |a, b| a.max(*b)), late.iter().fold(f64::MAX, |a, b| a.min(*b)))
        };
        columns.iter().enumerate().map(extremes).collect()
    }
}

/// Compares what a driven deck of tests/data/moordyn/driven has with MoorDyn 2.7.2 and 40 segments a line, or those of the deck where friction
/// hangs on them: to 1 % of the range.
fn compare_with_moordyn(drive: &Drive<'_>, columns: &[(&str, (&str, &str))]) {
    // by moordyn_driven.py; with 20 segments these move by 0.6 % of the range or less
    let mut reader = csv::Reader::from_path("tests/data/moordyn/driven/moordyn_driven.csv").unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let found = drive.extremes(&columns.iter().map(|(_, column)| *column).collect::<Vec<_>>());
    for ((quantity, _), (largest, least)) in columns.iter().zip(found) {
        let is_wanted = |row: &&csv::StringRecord| {
            format!("driven/{}", &row[0]) == drive.deck && &row[1] != "20" && &row[2] == *quantity
        };
        let row = rows.iter().find(is_wanted).unwrap_or_else(|| panic!("{} {quantity}", drive.deck));
        let [want_largest, want_least] = [3, 4].map(|at| row[at].parse::<f64>().unwrap());
        let range = want_largest - want_least;
        let off = [(largest - want_largest) / range, (least - want_least) / range];
        assert!(
            off.iter().all(|off| off.abs() < 0.01),
            "{} {quantity}: {largest} {least}, MoorDyn {want_largest} {want_least}: {off:?}",
            drive.deck
        );
    }
}

#[test]
fn clump_between_driven_lines_moves_as_in_moordyn() {
    let drive = Drive {
        deck: "driven/clump",
        options: "",
        sinusoid: "X 1.5 10 -SINUSOID Z 1 10",
        window: "120 0.1",
        from: 90.0,
    };
    compare_with_moordyn(&drive, &[("force", ("CONFORCE L2", "Mag.")), ("z", ("TRAJECTORY P2", "Z"))]);
}

#[test]
fn body_on_driven_lines_pulls_as_in_moordyn() {
    let drive = Drive {
        deck: "driven/body",
        options: "",
        sinusoid: "X 1.5 10 -SINUSOID Z 1 10",
        window: "120 0.1",
        from: 90.0,
    };
    compare_with_moordyn(&drive, &BODY);
}

/// Columns of the driven body.
const BODY: [(&str, (&str, &str)); 3] =
    [("force", ("CONFORCE L4", "Mag.")), ("x", ("TRAJECTORY BODY1", "X")), ("pitch", ("TRAJECTORY BODY1", "Pitch"))];

#[test]
fn body_read_like_moordyn_has_its_buoyancy_and_drag_areas() {
    let drive = Drive {
        deck: "driven/body_like",
        options: "-LIKE MOORDYN",
        sinusoid: "X 1.5 10 -SINUSOID Z 1 10",
        window: "120 0.1",
        from: 90.0,
    };
    compare_with_moordyn(&drive, &BODY);
}

#[test]
fn buoys_in_waves_read_like_moordyn_feel_no_acceleration_of_the_water() {
    let drive = Drive {
        deck: "driven/buoys_like",
        options: "-LIKE MOORDYN",
        sinusoid: "X 0 10",
        window: "160 0.1",
        from: 120.0,
    };
    let columns = [
        ("force", ("CONFORCE L5", "Mag.")),
        ("x", ("TRAJECTORY P8", "X")),
        ("z", ("TRAJECTORY P8", "Z")),
        ("body x", ("TRAJECTORY BODY1", "X")),
        ("body z", ("TRAJECTORY BODY1", "Z")),
    ];
    compare_with_moordyn(&drive, &columns);
}

#[test]
fn chain_dragged_over_a_slope_read_like_moordyn_has_its_friction_push_and_tension() {
    let drive = Drive {
        deck: "driven/slope_like",
        options: "-LIKE MOORDYN",
        sinusoid: "X 1 10 -SINUSOID Z 0.5 10",
        window: "120 0.1",
        from: 90.0,
    };
    let columns = [("force", ("CONFORCE L1", "Mag.")), ("FairTen", ("ROD L1 NODE 1 -DISPOSE", "Tension"))];
    compare_with_moordyn(&drive, &columns);
}

#[test]
fn tension_at_the_end_of_a_hung_chain_is_that_of_its_last_segment_like_moordyn() {
    let folder = tempfile::tempdir().unwrap();
    let deck = "- LINE\n--- LINE TYPES ---\na\nb\nchain 0.08 50 3e8 -0.8 0 1.3 1.0 0.4 0.5\n--- POINTS ---\na\nb\n1 Free 0 0 -108 2000 0 5 0\n\
                2 Coupled 0 0 -8 0 0 0 0\n--- LINES ---\na\nb\n1 chain 1 2 100 4 -\n--- OPTIONS ---\n140 WtrDpth\n9.80665 g\n---\n";
    std::fs::write(folder.path().join("deck.txt"), deck).unwrap();
    // FairTen of MoorDyn 2.7.2 after 120 s at rest: 58096.37 N, and 63593.96 N on the point; 2000 kg and the chain's weight in water along 87.5
    // and 100 m
    for (options, tension) in [("", 63594), ("-LIKE MOORDYN", 58096)] {
        let (text, errors) = common::print_records(&format!(
            "INMODEL -MOORDYN \"{}/deck.txt\" {options}\n&DIMEN -DIMEN METERS NEWTONS\n&EQUI\n&STATUS FORCE\n",
            folder.path().display()
        ));
        assert_eq!(errors, 0, "{text}");
        assert!(text.contains(&format!("tension {tension} N at its first end")), "{text}");
        let force = text.lines().find(|line| line.contains("VESSEL  TOTAL")).unwrap();
        assert!(force.split_whitespace().any(|word| word == "-63594"), "{force}");
    }
}

#[test]
fn body_of_a_deck_rests_by_the_moments_of_the_place_of_its_buoyancy() {
    for options in ["", "-LIKE MOORDYN"] {
        let folder = tempfile::tempdir().unwrap();
        let deck = "- LINE\n--- LINE TYPES ---\na\nb\nrope 0.05 3 1e6 1e3 0 0 0 0 0\n--- BODIES ---\na\nb\n\
                    1 Free 0 0 -40 0 0 0 2e4 0.3|0|-1.2 9e4|9e4|6e4 10 4 0\n--- POINTS ---\na\nb\n1 Fixed 0 0 -5 0 0 0 0\n\
                    2 Body1 0 0 1 0 0 0 0\n--- LINES ---\na\nb\n1 rope 2 1 34 4 -\n--- OPTIONS ---\n100 WtrDpth\n9.80665 g\n---\n";
        std::fs::write(folder.path().join("deck.txt"), deck).unwrap();
        let (mut session, _screen, _folder) = common::session();
        let record = format!("INMODEL -MOORDYN \"{}/deck.txt\" {options}\n&EQUI\n", folder.path().display());
        session.open("records", record);
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        let [_, pitch, _] = session.job.model.bodies["BODY1"].position.turn;
        // moments about the point of the rope 1 m above: weight at (0.3, -2.2), lift at (0, -1) or there too
        let (weight, lift) = (2e4, 1025.0 * 10.0);
        let [x, z]: [f64; 2] = if options.is_empty() {
            [weight * 0.3, weight * 2.2 - lift]
        } else {
            [(weight - lift) * 0.3, (weight - lift) * 2.2]
        };
        assert!((pitch - (x / z).atan()).abs() < 1e-3_f64.to_radians(), "{options}: {}", pitch.to_degrees());
    }
}

#[test]
fn rod_between_driven_lines_moves_as_in_moordyn() {
    let drive =
        Drive { deck: "driven/rod", options: "", sinusoid: "X 1 10 -SINUSOID Z 0.8 10", window: "120 0.1", from: 90.0 };
    compare_with_moordyn(
        &drive,
        &[("force", ("CONFORCE L2", "Mag.")), ("x", ("TRAJECTORY ROD1", "X")), ("z", ("TRAJECTORY ROD1", "Z"))],
    );
}

#[test]
fn driven_line_in_a_sheared_current_pulls_as_in_moordyn() {
    let drive = Drive {
        deck: "driven/current",
        options: "",
        sinusoid: "X 0.8 10 -SINUSOID Z 0.5 10",
        window: "120 0.1",
        from: 90.0,
    };
    compare_with_moordyn(&drive, &[("force", ("CONFORCE L1", "Mag."))]);
}

#[test]
fn line_in_waves_pulls_as_in_moordyn() {
    for deck in ["driven/waves", "driven/elevation"] {
        let drive = Drive { deck, options: "", sinusoid: "X 0 10", window: "160 0.1", from: 120.0 };
        compare_with_moordyn(&drive, &[("force", ("CONFORCE L1", "Mag."))]);
    }
}

#[test]
fn driven_taut_leg_of_a_deck_has_the_forces_of_moordyn() {
    let drive =
        Drive { deck: "taut_leg", options: "", sinusoid: "X 2 12 -SINUSOID Z 1 12", window: "96 0.1", from: 60.0 };
    let (largest, least) = drive.extremes(&[("CONFORCE L1", "Mag.")])[0];
    // MoorDyn 2.7.2 by tests/data/moordyn/moordyn_taut_leg.py; with 80 and 160 segments it moves by 0.1 % of the range
    let (want_largest, want_least) = (1544574.4, 1438325.8);
    let room = 0.01 * (want_largest - want_least);
    assert!((largest - want_largest).abs() < room && (least - want_least).abs() < room, "{largest} {least}");
}

/// The model of a deck with its bodies at rest.
fn at_rest(name: &str) -> Model {
    let mut model = read(name, "");
    let system = System::new(&model, &[]).unwrap();
    let mut state = system.state(&model);
    let found = equilibrium(&system, &mut state, &EquilibriumOptions::default()).unwrap();
    assert!(found.search.residual < 1e-6, "{found:?}");
    system.position(&state, &mut model);
    model
}

#[test]
fn pinned_rod_of_a_deck_leans_in_its_current_by_the_balance_of_moments() {
    let model = at_rest("rod_pinned");
    let [_, pitch, yaw] = model.bodies["ROD1"].position.turn;
    // half the length times the drag across the rod, 1/2 rho Cd d (V cos)^2, and times the lift beyond the weight, (rho A - m) g sin
    let drag = 0.5 * 1025.0 * 1.0 * 0.6 * (0.8f64.powi(2) + 0.4f64.powi(2));
    let lift = (1025.0 * std::f64::consts::FRAC_PI_4 * 0.36 - 120.0) * 9.80665;
    let sine = ((lift * lift + 4.0 * drag * drag).sqrt() - lift) / (2.0 * drag);
    assert!((pitch - sine.asin()).abs() < 1e-4_f64.to_radians(), "{pitch}");
    assert!((yaw - 0.4f64.atan2(0.8)).abs() < 1e-4_f64.to_radians(), "{yaw}");
}

#[test]
fn chain_of_a_deck_on_its_seafloor_file_loses_its_weight_times_height() {
    // on a smooth bottom that pushes along its normal T - w z is the same all along
    let found = tensions(&read("seafloor", ""));
    let (text, errors) = common::print_records(&format!(
        "&DIMEN -DIMEN METERS NEWTONS\nINMODEL -MOORDYN \"{FOLDER}/seafloor.txt\"\n&STATUS F_CONNECTOR\n"
    ));
    assert_eq!(errors, 0, "{text}");
    let line = text.lines().find(|line| line.split_whitespace().next() == Some("L1")).unwrap();
    let words: Vec<f64> = line.split_whitespace().map(|word| word.parse().unwrap_or(f64::NAN)).collect();
    let anchor = words[10].hypot(words[11]);
    let weight = (200.0 - std::f64::consts::FRAC_PI_4 * 0.18 * 0.18 * 1025.0) * 9.80665;
    // elements of 10 m
    assert!(((found[0].1[0] - anchor) / (weight * 154.0) - 1.0).abs() < 2e-3, "{line}");
}

#[test]
fn taut_rope_of_a_deck_follows_its_table_of_stiffness() {
    let found = tensions(&read("rope_table", ""));
    // straight between 0.3 MN at 0.02 and 1.2 MN at 0.05; the rope weighs 2 N/m in water
    let strain = 300f64.hypot(240.0) / 370.0 - 1.0;
    let want = 3e5 + (strain - 0.02) / 0.03 * 9e5;
    assert!((found[0].1[0] / want - 1.0).abs() < 1e-3, "{found:?} {want}");
}

#[test]
fn rod_that_hangs_from_a_moved_body_leans_as_its_equation_of_motion() {
    let (mut session, _screen, folder) = common::session();
    session.open(
        "records",
        format!(
            "INMODEL -MOORDYN \"{FOLDER}/rod_pendulum.txt\"\n&DIMEN -DIMEN METERS NEWTONS\nMEDIT\n\
             PRESCRIBE BODY1 -SINUSOID X 2 12\nEND\n&ENV MOORDYN -TIME 96 0.05\nTDOM -SCREEN NO\nPRCPOST\n\
             TRAJECTORY ROD1\nSTORE path.csv\nEND\nEND\n"
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let mut reader = csv::Reader::from_path(folder.path().join("job.ans/path.csv")).unwrap();
    let pitch = reader.headers().unwrap().iter().position(|head| head.starts_with("Pitch")).unwrap();
    let rows: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    let number = |row: &csv::StringRecord, at: usize| row[at].parse::<f64>().unwrap();
    let late: Vec<f64> = rows.iter().filter(|row| number(row, 0) > 72.0).map(|row| number(row, pitch)).collect();
    let range = late.iter().fold(f64::MIN, |a, b| a.max(*b)) - late.iter().fold(f64::MAX, |a, b| a.min(*b));
    // its equation of motion by scipy, tests/data/moordyn/rod_pendulum.py; pinned rods of MoorDyn 2.7.2 do not feel that their pin accelerates: 7.274
    // degrees by moordyn_rod_pendulum.py, which the equation has without that
    assert!((range / (2.0 * 15.2225) - 1.0).abs() < 1e-3, "{range}");
}

#[test]
fn rod_hung_between_two_lines_bears_its_weight_at_rest() {
    let found = tensions(&read("rod_hung", ""));
    let forces = |name: &str| found.iter().find(|(line, _)| line == name).unwrap().1.clone();
    // weight in water of the rod and of both lines, less what the anchor bears, on the fairlead; what pulls aside is the same all along
    let area = |diameter: f64| std::f64::consts::FRAC_PI_4 * diameter * diameter * 1025.0;
    let rod = (500.0 - area(0.5)) * 12.0 * 9.80665;
    let line = (7.0 - area(0.08)) * 9.80665;
    let [upper, lower] = ["L2", "L1"].map(|name| forces(name)[0]);
    assert!(upper > rod + line * 40.0 && lower < 0.1 * rod, "{upper} {lower}");
}

#[test]
fn waves_of_a_deck_have_the_elevations_of_their_file() {
    let model = read("waves", "");
    let sea = windlass_hydro::sea::Sea::new(&model, &model.environment).unwrap().unwrap();
    // |a| sin(w t + arg a) at the origin, as MoorDyn documents its wave_frequencies.txt
    let waves = [(0.6283185307179586f64, 2.0f64, 0.5f64), (0.8975979010256552, -0.3, 1.0)];
    for time in [0.0, 2.5, 17.3] {
        let want: f64 = waves.iter().map(|(w, re, im)| re.hypot(*im) * (w * time + im.atan2(*re)).sin()).sum();
        assert!((sea.elevation(0.0, 0.0, time) - want).abs() < 1e-9, "{time}");
    }
    // the second travels toward 0.5 rad
    assert!((sea.components[1].toward[1] - 0.5f64.sin()).abs() < 1e-9);
}

#[test]
fn coupled_points_of_a_deck_are_on_the_vessel_of_the_model() {
    let (mut session, _screen, _folder) = common::session();
    let deck = format!("INMODEL -MOORDYN \"{FOLDER}/grounded_chain.txt\"\n");
    session.open(
        "records",
        format!("&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY VESSEL\n*CG 0 0 0\n#WEIGHT *CG 9000 10 10 10\nEND\n{deck}"),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    assert!(session.job.model.bodies["VESSEL"].prescribed.is_none());
    assert!(session.reports.iter().any(|said| said.message.contains("on the body VESSEL of the model")));
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
