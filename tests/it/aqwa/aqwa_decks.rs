//! Decks run as records: the two examples of [AQWA-TETHER 8] through the session, against the listing and against scripts of the same cases,
//! and how each card comes out as a record.
//!
//! Printed numbers: tests/data/{towed,installed}_tether.json; what can be met: [W-TOWED], [W-INSTALLED].

use crate::common;

use serde_json::Value;
use windlass::session::Session;
use windlass_aqwa::{self as aqwa, Records};
use windlass_base::diagnostic::Diagnostic;
use windlass_language::source::Sources;
use windlass_solve::tethered::Tethered;
use windlass_tether::installed::RigChange;

pub(super) fn file(name: &str) -> String {
    std::fs::read_to_string(format!("scripts/{name}")).unwrap()
}

pub(super) fn listing(name: &str) -> Value {
    serde_json::from_str(&std::fs::read_to_string(format!("tests/data/{name}_tether.json")).unwrap()).unwrap()
}

pub(super) fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// A job that has no error, with what it wrote as NAME.cif where it is a deck.
pub(super) fn run(name: &str, text: &str) -> (Session, Option<String>) {
    let (mut session, _, folder) = common::session();
    session.open_job(name, text);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let written = folder.path().join("job.ans").join(name).with_extension("cif");
    let kept = std::fs::read_to_string(written).ok();
    (session, kept)
}

/// The job without what prints pages, which takes most of its time in a test.
fn silent(text: &str) -> String {
    let line = |line: &&str| !line.starts_with("TETHER ") && !line.starts_with("STRUCTURE ");
    text.lines().filter(line).map(|line| format!("{line}\n")).collect()
}

pub(super) fn records(text: &str) -> Result<Records, Vec<Diagnostic>> {
    let mut sources = Sources::default();
    let id = sources.add("deck", text, 1);
    let reading = aqwa::read(&sources, id);
    assert!(!reading.failed, "{:#?}", reading.messages);
    aqwa::records(&reading.deck)
}

pub(super) fn tethered_run(session: &Session) -> &Tethered {
    session.job.tethered.as_ref().unwrap()
}

/// All numbers of a run, bit for bit.
fn bits(run: &Tethered) -> Vec<u64> {
    let mut all: Vec<f64> = run.times.clone();
    for tether in &run.tethers {
        all.extend(tether.nodes.iter().chain(&tether.ends));
    }
    all.extend(run.structure.iter().flat_map(|structure| structure.rows.iter().copied()));
    all.iter().map(|value| value.to_bits()).collect()
}

#[test]
fn installed_deck_reaches_printed_positions_and_slack_times() {
    let (session, _) = run("mint.dat", &file("mint.dat"));
    let run = tethered_run(&session);
    let structure = run.structure.as_ref().unwrap();
    for state in listing("installed")["structure_history"].as_array().unwrap() {
        let time = number(&state["time"]);
        let at = run.times.iter().position(|t| (t - time).abs() < 1e-9).unwrap();
        for axis in 0..3 {
            let off = (structure.value(at, axis).unwrap() - number(&state["POSITION"][axis])).abs();
            // required: 0.4 mm to 5 s, 6 mm to 25 s
            assert!(off < if time <= 5.0 { 4e-4 } else { 6e-3 }, "{axis} at {time} s: {off}");
        }
    }
    let slack = |e: &&windlass_solve::tethered::TetherRunEvent| e.change == RigChange::Slack;
    let (slack, struck): (Vec<_>, Vec<_>) = run.happened.iter().partition(slack);
    let named = |list: &[&windlass_solve::tethered::TetherRunEvent]| -> Vec<(String, f64)> {
        list.iter().map(|e| (e.tether.clone(), e.time)).collect()
    };
    assert_eq!(named(&slack), [("T1".to_string(), 6.5), ("T2".to_string(), 6.5)]);
    assert_eq!(named(&struck), [("T1".to_string(), 7.5), ("T2".to_string(), 7.5)]);
    for event in struck {
        let RigChange::Impact { stress, .. } = event.change else { panic!("{event:?}") };
        // printed 7.557E4 and 7.558E4 kN/m2; asked 0.1 %
        assert!((stress / 7.557e7 - 1.0).abs() < 1e-3, "{stress}");
    }
}

#[test]
fn towed_deck_with_printed_phases_reaches_printed_positions() {
    let (session, _) = run("he01_phases.dat", &file("he01_phases.dat"));
    let run = tethered_run(&session);
    let printed = listing("towed");
    let tether = &run.tethers[0];
    for time in [125.0, 250.0, 375.0] {
        let at = run.times.iter().position(|t| (t - time).abs() < 1e-9).unwrap();
        let motion = &printed["history"][time.to_string()]["motion"];
        // the second quantity of a node is its height; listed from the vessel
        let off = |node: usize| tether.node_at(at, node, 1).unwrap() - number(&motion[13 - node][3]);
        let rms = ((0..14).map(|node| off(node).powi(2)).sum::<f64>() / 14.0).sqrt();
        // required: 0.025 m of 1.9 to 3.3 m
        assert!(rms < 0.025, "{time} s: {rms}");
    }
}

#[test]
fn deck_and_script_of_a_case_match_bit_for_bit() {
    for (deck, script) in [("mint.dat", "installed_tether.cif"), ("he01_phases.dat", "towed_tether.cif")] {
        let made = records(&file(deck)).unwrap().script().text;
        let (of_deck, _) = run("deck.cif", &silent(&made));
        // the script of the example runs for a shorter time: here it runs as long as the deck
        let whole = tethered_run(&of_deck);
        let text = with_run_of(&silent(&file(script)), &made);
        let (of_script, _) = run("script.cif", &text);
        let written = tethered_run(&of_script);
        assert_eq!(whole.times, written.times);
        assert!(whole.times.len() > 100 && bits(whole) == bits(written), "{script}");
    }
}

/// A script with -TIME of &ENV and the TDOM record of another.
fn with_run_of(script: &str, other: &str) -> String {
    let of =
        |text: &str, word: &str| text.lines().find(|line| line.trim_start().starts_with(word)).unwrap().to_string();
    let mut text = script.to_string();
    for word in ["-TIME", "TDOM"] {
        text = text.replace(&of(script, word), &of(other, word));
    }
    text
}

#[test]
fn deck_leaves_records_of_an_equivalent_script() {
    let short = file("mint.dat").replace("16TIME       101", "16TIME        11");
    let (of_deck, kept) = run("mint.dat", &short);
    let kept = kept.unwrap();
    assert_eq!(kept, records(&short).unwrap().script().text);
    let (again, _) = run("again.cif", &kept);
    assert_eq!(bits(tethered_run(&of_deck)), bits(tethered_run(&again)));
    assert_eq!(of_deck.job.model.connectors.len(), 4);
}

#[test]
fn inmodel_reads_model_of_deck_and_keeps_units_and_job() {
    let (mut session, _, folder) = common::session();
    std::fs::write(folder.path().join("tlp.dat"), file("mint.dat")).unwrap();
    session.open("test.cif", "&DIMEN -DIMEN FEET KIPS\nINMODEL -AQWA tlp.dat\n&STATUS TETHERS T3\n");
    session.run();
    assert_eq!((session.errors, session.job.menus.len()), (0, 1), "{:?}", session.reports);
    assert_eq!(session.job.units.words(), ("FEET", "KIPS"));
    assert!(session.job.tethered.is_none());
    let model = &session.job.model;
    assert_eq!((model.connectors.len(), model.environment.depth), (4, Some(345.0)));
    // a file of INMODEL that is a deck is read as one
    let (mut session, _, folder) = common::session();
    std::fs::write(folder.path().join("job.dat"), file("mint.dat")).unwrap();
    session.open("test.cif", "INMODEL\n&STATUS TETHERS\n");
    session.run();
    assert_eq!((session.errors, session.job.model.connectors.len()), (0, 4), "{:?}", session.reports);
}

#[test]
fn deck_with_error_is_not_run() {
    for (from, to, said) in [
        (" END14TETH    1 1040    0 9040", " END14TETH    1 1040    0 9999", "9999"),
        (" END15VEL1               0.000", " END15VEL1               1.000", "at rest"),
    ] {
        let (mut session, _, folder) = common::session();
        session.open_job("mint.dat", file("mint.dat").replace(from, to));
        session.run();
        assert!(session.errors > 0 && session.job.model.bodies.is_empty() && session.job.tethered.is_none());
        assert!(session.reports.iter().any(|r| r.message.contains(said) && r.span.is_some()), "{:?}", session.reports);
        assert!(!folder.path().join("job.ans/mint.cif").exists());
    }
}

/// The installed example with other cards in the place of one text.
fn edit_example(from: &str, to: &str) -> String {
    let text = file("mint.dat");
    assert!(text.contains(from), "{from}");
    text.replacen(from, to, 1)
}

pub(super) fn lines(records: &Records) -> String {
    records.model.join("\n")
}

#[test]
fn records_have_the_digits_of_the_cards() {
    let model = lines(&records(&file("mint.dat")).unwrap());
    for line in [
        "&DEFAULT -WATER 1025 -GRAVITY 9.81",
        "-SEA STOKES 180 30 15",
        "*N9010 -52.63 52.63 -329.73543",
        "*S1_1010 -52.63 52.63 -50.75",
        "#WEIGHT *S1_CG 2636928 ",
        "TUBE S1_T1 *S1_11 *S1_12 31100 -CD 0.75 -CDA 0.016 -CA 1",
        "&INSTATE -LOCATE S1 -46 0 -17.4 0 0 0",
        "~T1 TETHER 1.1176 0.038 -LEN 88.4685 -DENSITY 7816.94 -EMODULUS 2.15E11 -CA 1 -CD 0.75 -LABEL 102 101 101 101",
        "-V_SPRINGS 0 5729.578 5729.578",
        "-IMPACT 300000 2.5 -LOW_STOP 100 -GROUP 4",
    ] {
        assert!(model.contains(line), "{line}\n{model}");
    }
    let towed = lines(&records(&file("he01_phases.dat")).unwrap());
    assert!(towed.contains("-LEN 27.787 ") && towed.contains("-COMPONENTS 50 EQUAL_ENERGY 0.37 2.5"), "{towed}");
    assert!(towed.contains("0.0028 47.3536") && towed.contains("-IMPACT 100 100 -LOW_STOP 100"));
    // [W-TOWED 3]: 6.302 over all frequencies
    assert!(towed.contains("-SEA JONSWAP 0 6.302"), "{towed}");
}

#[test]
fn constraint_holds_node_between_neighbouring_elements_of_its_card() {
    let between = edit_example(
        "    14TELM  103  102  101  101\n",
        "    14TELM  103  102  101  101\n    14TLAV                         0.250\n",
    );
    let made = lines(&records(&between).unwrap());
    assert!(made.contains("-CONSTRAINT LATERAL_VESSEL 3 0.25") && made.contains("assumed to hold node 102 "), "{made}");
    let behind = edit_example("    14TEGR    4\n", "    14TEGR    4\n    14TROC\n    14TLAV\n");
    let made = lines(&records(&behind).unwrap());
    assert!(made.contains("-CONSTRAINT ROTATIONAL_FIXED 2") && made.contains("-CONSTRAINT LATERAL_VESSEL 3"), "{made}");
}

#[test]
fn turning_current_profile_splits_into_x_and_y_parts() {
    let text = edit_example(
        "    11    NONE",
        "    11    ENVR\n    11CPRF    -345.0       0.5      90.0\n END11CPRF       0.0       1.5       0.0",
    );
    let made = lines(&records(&text).unwrap());
    assert!(made.contains("C_PROFILE CPRF_X 0 1.5 345 0") && made.contains("C_PROFILE CPRF_Y 0 0 345 0.5"), "{made}");
    assert!(made.contains("-CURRENT CPRF_X 180 CPRF_Y 270"), "{made}");
}

#[test]
fn spectra_become_seas_or_curves() {
    let sea = |card: &str| {
        let text = edit_example(
            "    13    WAVE\n    13WAMP               15.00\n    13PERD               15.00\n END13WVDN                0.00",
            &format!("    13    SPEC\n    13SPDN                30.0\n{card}"),
        );
        lines(&records(&text.replace("JOB MINT  NAUT", "JOB MINT  DRIF")).unwrap())
    };
    let made = sea(" END13PSMZ                 0.2       2.0       6.0       9.0");
    assert!(made.contains("-SEA ISSC 210 6 9") && made.contains("-SP_TYPE ZERO_CROSSING"), "{made}");
    let made = sea(" END13GAUS                 0.2       2.0       0.1       4.0       0.6");
    // the curve has the energy of the height to what straight lines leave of a bell
    let height: f64 =
        made.split("-SEA DECK_13 210 ").nth(1).unwrap().split_whitespace().next().unwrap().parse().unwrap();
    assert!((height / 4.0 - 1.0).abs() < 1e-4, "{height}");
    let made = sea(
        "    13UDEF                 0.4       0.0\n    13UDEF                 0.6       5.0\n END13UDEF                 0.8       0.0",
    );
    // a triangle of 0.4 by 5 has an energy of 1 m2
    assert!(made.contains("-SEA DECK_13 210 4 ") && made.contains("0.4 0  0.6 5  0.8 0"), "{made}");
}

#[test]
fn lines_become_classes_of_same_stiffness() {
    let cards = "    14LINE    1 1010    0 9010     100.0     250.0\n\
                 \x20   14COMP   15   40         1\n    14ECAT                         0.170    0.0217  700000.0               600.0\n\
                 \x20   14NLIN    1 1020    0 9020\n    14TSLK                         0.001\n";
    let text = edit_example("    14TSLK                         0.001\n", cards);
    let made = lines(&records(&text).unwrap());
    assert!(made.contains("~COMP1 CATENARY 170 0.0217 -LEN 600 -EA 700000000 -TMAX 8500000"), "{made}");
    assert!(
        made.contains("CONNECTOR L1 ~L1 *S1_1010 *N9010") && made.contains("CONNECTOR L2 ~COMP1 *S1_1020 -ANCHOR ")
    );
    // 100 kN/m beyond 250 m; such a line has no section that could break
    assert!(made.contains("~L1 NLIN 250 -POLY 100000\n"), "{made}");
    let (session, _) = run("model.cif", &format!("&DIMEN -DIMEN METERS K-NTS\n{made}\n&STATUS F_CONNECTOR\n"));
    assert_eq!(session.job.model.connectors.len(), 6);
}

#[test]
fn constant_force_line_pulls_with_its_force_towards_second_node() {
    let text = edit_example("    14TSLK                         0.001\n", "    14FORC    1 1010    0 9010     100.0\n");
    let made = lines(&records(&text).unwrap());
    assert!(made.contains("~L1 CT_LINE 100") && made.contains("CONNECTOR L1 ~L1 *S1_1010 *N9010"), "{made}");
}

#[test]
fn unsupported_deck_data_is_refused_with_card_and_alternative() {
    let refused = |from: &str, to: &str, said: &str| {
        let list = records(&edit_example(from, to)).unwrap_err();
        let found = list.iter().find(|d| d.message.contains(said));
        let found = found.unwrap_or_else(|| panic!("{said}: {list:?}"));
        assert!(found.span.is_some() && !found.help.is_empty(), "{found:?}");
    };
    let inertia = "    04PMAS         1  1.0339E9       0.0";
    refused(inertia, "    04PMAS         1  1.0339E9     1.0E6", "products of inertia");
    refused("    12    NONE", "    12    CONS\n END12DACF    1    6", "DACF");
    let first = "    14TSLK                         0.001\n";
    refused(first, "    14FORC    1 1010    0 9010    -100.0\n", "FORC");
    refused(first, "    14POLY                         100.0\n    14NLID    1 1010    0 9010\n", "NLID");
    refused("JOB MINT  NAUT", "JOB MINT  LIBR", "run in time");
}

#[test]
fn data_check_is_reported_and_not_run() {
    let made = records(&edit_example("OPTIONS END", "OPTIONS DATA END")).unwrap();
    assert!(!made.job.iter().any(|line| line.starts_with("TDOM")), "{:?}", made.job);
    assert!(
        made.job.iter().any(|line| line.starts_with("$ deck 0, OPTIONS, DATA"))
            && made.job.contains(&"&STATUS TETHERS".to_string())
    );
}

#[test]
fn number_of_phases_must_match_components() {
    let sea = "&DIMEN -DIMEN METERS K-NTS\n&ENV -SEA ISSC 180 4 8 -COMPONENTS 3";
    let (mut session, screen, _folder) = common::session();
    session.open("test", format!("{sea} -PHASES 0 90 180\n&STATUS SEA_SPECTRUM\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    assert!(screen.text().contains("as -PHASES gives them"));
    let sea_made = windlass_hydro::sea::Sea::new(&session.job.model, &session.job.model.environment).unwrap().unwrap();
    let phases: Vec<f64> = sea_made.components.iter().map(|c| c.phase.to_degrees()).collect();
    assert!(phases.iter().zip([0.0, 90.0, 180.0]).all(|(found, want)| (found - want).abs() < 1e-12), "{phases:?}");
    let (mut session, _, _folder) = common::session();
    session.open("test", format!("{sea} -PHASES 0 90\n&STATUS SEA_SPECTRUM\n{sea} -PHASES 0 1 2 -SEED 3\n"));
    session.run();
    assert!(session.errors >= 1, "{:?}", session.reports);
    let said: Vec<&str> = session.reports.iter().map(|r| r.message.as_str()).collect();
    assert!(
        said.iter().any(|m| m.contains("2 phases for 3")) && said.iter().any(|m| m.contains("not from both")),
        "{said:?}"
    );
}

/// A body in 100 m of water (kg, m, N), its fairlead at z = -10, and these cards of deck 14 and decks 5, 13, 16.
pub(super) fn moored_deck(program: &str, depth: f64, lines: &str, waves: &str) -> String {
    let none = |decks: std::ops::RangeInclusive<u8>| decks.map(|n| format!("    {n:02}    NONE\n")).collect::<String>();
    format!(
        "JOB MOOR  {program}\nTITLE               Lines on the bottom\nOPTIONS END\n\
        \x20   01    COOR\n    01   1                 0.0       0.0       0.0\n    01   2                 0.0       0.0     -10.0\n\
        \x20   01  13                 0.0     535.0     -95.0\n END01  12               535.0       0.0    -100.0\n\
        \x20   02    ELM1\n END02PMAS           (1) (1) (1) (1)\n    02    FINI\n    03    MATE\n END03             1     1.0E7\n\
        \x20   04    GEOM\n END04PMAS         1     1.0E9       0.0       0.0     1.0E9       0.0     1.0E9\n\
        \x20   05    GLOB\n    05DPTH{depth:10.1}\n    05DENS    1025.0\n END05ACCG      9.81\n{}{waves}    14    MOOR\n{lines}\
        \x20   15    STRT\n END15POS1                 0.0       0.0       0.0       0.0       0.0       0.0\n\
        \x20   16    TINT\n END16TIME       101       0.1\n{}",
        none(6..=12),
        none(17..=20)
    )
}

pub(super) const STILL: &str = "    13    NONE\n";
pub(super) const SECTION: &str = "    14ECAT                         150.0     0.018     6.0E8     5.0E6     570.0\n";

/// The force of each connector of a model on its first end, as placed (N).
pub(super) fn pulls(model: &windlass_model::Model) -> Vec<[f64; 3]> {
    let surroundings = model.surroundings();
    let pull = |connector: &windlass_model::Connector| {
        let element = model.element(connector).unwrap();
        let ends = model.end_poses(connector).map(windlass_model::End::at_rest);
        let at = windlass_model::Situation { ends: &ends, step: None, surroundings: &surroundings };
        let mut out = windlass_model::ConnectorResponse::default();
        let (committed, mut trial) = (vec![0.0; element.states()], vec![0.0; element.states()]);
        element.evaluate(&at, &committed, &mut trial, &mut windlass_model::SolverCache::new(), &mut out).unwrap();
        [0, 1, 2].map(|axis| out.wrench[0][axis])
    };
    model.connectors.values().map(pull).collect()
}

pub(super) fn run_placed_deck(deck: &str) -> (Session, String) {
    let records = records(deck).unwrap();
    let (session, _) = run("model.cif", &records.model_alone().text);
    let text = lines(&records);
    (session, text)
}

pub(super) fn assert_near(got: f64, want: f64) {
    // the digits given
    assert!((got / want - 1.0).abs() < 1e-8, "{got} is not {want}");
}

#[test]
fn deck_line_is_on_seabed_at_its_anchor() {
    // Elastic catenary with a part on the bottom without friction: x = L - V/w + H/w asinh(V/H) + H L/EA,
    // z = (sqrt(H2 + V2) - H)/w + V2/(2 w EA), w = (150 - 1025 0.018) 9.81 N/m, solved by scipy.optimize.fsolve.
    // The same in 150 m: the bottom of a line is at its anchor.
    let cards = format!("    14COMP                   1\n{SECTION} END14NLIN    1    2    0   12\n");
    for depth in [100.0, 150.0] {
        let (session, text) = run_placed_deck(&moored_deck("LIBR", depth, &cards, STILL));
        assert_eq!(text.contains("-DEPANCHOR 100"), depth > 100.0, "{text}");
        let [pull] = pulls(&session.job.model)[..] else { panic!() };
        assert_near(pull[0], 135470.09879651);
        assert_near(-pull[2], 211989.18607666);
    }
    // the anchor first and the structure second: the same line
    let swapped = cards.replace("    1    2    0   12", "    0   12    1    2");
    let (session, _) = run_placed_deck(&moored_deck("LIBR", 100.0, &swapped, STILL));
    assert_near(pulls(&session.job.model)[0][0], 135470.09879651);
}

#[test]
fn composite_lines_to_anchors_at_two_depths_each_reach_own_seabed() {
    // the second line as the first one, 85 m high and along Y
    let cards = format!(
        "    14COMP                   1\n{SECTION}    14NLIN    1    2    0   12\n END14NLIN    1    2    0   13\n"
    );
    let (session, text) = run_placed_deck(&moored_deck("LIBR", 100.0, &cards, STILL));
    assert!(text.contains("~COMP1_2 CATENARY 150 0.018 -LEN 570 -EA 600000000 -TMAX 5000000 -DEPANCHOR 95"), "{text}");
    let [first, second] = pulls(&session.job.model)[..] else { panic!() };
    assert_near(first[0], 135470.09879651);
    assert_near(second[1], 111006.07003181);
    assert_near(-second[2], 190715.33656658);
}

#[test]
fn composite_joints_weigh_mass_less_displaced_water() {
    // two sections of elastic catenary, the lower one partly on the bottom; the vertical force falls by (m - m_displaced) g at the
    // joint between them; solved by scipy.optimize.fsolve
    for (joint, horizontal, vertical) in [
        ("CLMP                        5000.0     700.0", 195661.92250174, 271338.39698688),
        ("BUOY                         900.0    4200.0", 120762.63454596, 195375.17324813),
    ] {
        let cards = format!(
            "    14COMP                   2\n    14ECAT                         220.0     0.026     8.0E8               450.0\n\
             \x20   14{joint}\n    14ECAT                         150.0     0.018     6.0E8               120.0\n\
             \x20END14NLIN    1    2    0   12\n"
        );
        let (session, _) = run_placed_deck(&moored_deck("LIBR", 100.0, &cards, STILL));
        let [pull] = pulls(&session.job.model)[..] else { panic!() };
        assert_near(pull[0], horizontal);
        assert_near(-pull[2], vertical);
    }
}

/// What reading a deck says.
pub(super) fn read_diagnostics(text: &str) -> Vec<Diagnostic> {
    let mut sources = Sources::default();
    let id = sources.add("deck", text, 1);
    aqwa::read(&sources, id).messages
}

#[test]
fn composite_table_and_anchor_off_seabed_are_reported() {
    let cards = |comp: &str| format!("    14COMP{comp}\n{SECTION} END14NLIN    1    2    0   12\n");
    let plain = "                   1";
    let remarks = |depth: f64, comp: &str| {
        let list = read_diagnostics(&moored_deck("LIBR", depth, &cards(comp), STILL));
        list.into_iter().map(|m| format!("{:?}: {}", m.severity, m.message)).collect::<Vec<_>>().join("\n")
    };
    assert_eq!(remarks(100.0, plain), "");
    for comp in ["   10              1", "        20         1", "                   1     -20.0       0.0"] {
        assert_eq!(
            remarks(100.0, comp),
            "Note: deck 14, COMP: no table is made; a line is solved exactly at each position"
        );
    }
    assert_eq!(
        remarks(150.0, plain),
        "Note: deck 14: the anchor of this line is at Z = -100, above the sea bed at -150"
    );
    assert_eq!(
        remarks(80.0, plain),
        "Warning: deck 14: the anchor of this line is at Z = -100, below the sea bed at -80"
    );
}

#[test]
fn structure_without_wave_loads_is_not_run_in_waves() {
    let cards = format!("    14COMP                   1\n{SECTION} END14NLIN    1    2    0   12\n");
    let spectrum = "    13    SPEC\n END13PSMZ                 0.2       2.0       6.0       9.0\n";
    let regular = "    13    WAVE\n    13WAMP                 3.0\n END13PERD                10.0\n";
    for (program, waves) in [("DRIF", spectrum), ("NAUT", regular)] {
        let text = moored_deck(program, 100.0, &cards, waves);
        let list = records(&text).unwrap_err();
        let [error] = list.as_slice() else { panic!("{list:?}") };
        assert_eq!(error.message, "decks 6 to 8: structure 1 has no wave coefficients, and no tubes");
        assert!(error.span.is_some() && error.help.iter().any(|help| help.contains("DATABASE")));
        assert!(records(&moored_deck(program, 100.0, &cards, STILL)).is_ok());
        // its model is read all the same
        let (mut session, _, folder) = common::session();
        std::fs::write(folder.path().join("hull.dat"), text).unwrap();
        session.open("test.cif", "INMODEL -AQWA hull.dat\n");
        session.run();
        assert_eq!((session.errors, session.job.model.connectors.len()), (0, 1), "{:?}", session.reports);
    }
}

#[test]
fn anchor_stop_keeps_deck_tether_from_hanging_free() {
    let low = "    14TLOW                         100.0\n";
    let with = |card: &str| file("mint.dat").replace(low, card).replace("16TIME       101", "16TIME        33");
    for card in ["    14TLOW                           0.0\n", "    14TLOW\n"] {
        let text = with(card);
        assert!(lines(&records(&text).unwrap()).contains("-LOW_STOP 0 -GROUP 4"));
        // tethers 1 and 2 of the listing go slack at 6.5 s
        let (session, _) = run("mint.dat", &text);
        assert!(tethered_run(&session).happened.is_empty());
    }
    let none = with("");
    assert!(!lines(&records(&none).unwrap()).contains("-LOW_STOP"));
    let notes: Vec<String> =
        read_diagnostics(&none).into_iter().map(|m| m.message).filter(|m| m.contains("TLOW")).collect();
    assert_eq!(notes, ["deck 14: no TLOW card; a slack tether hangs free and meets no lower stop"]);
    let (session, _) = run("mint.dat", &none);
    assert!(!tethered_run(&session).happened.is_empty());
}

#[test]
fn regular_wave_amplitude_period_and_direction_have_own_cards() {
    let text = file("mint.dat")
        .replace("13WAMP               15.00", "13WAMP               12.00")
        .replace("13PERD               15.00", "13PERD               16.50")
        .replace("13WVDN                0.00", "13WVDN               30.00");
    // towards 30 degrees is from 210; the height is twice the amplitude
    let made = lines(&records(&text).unwrap());
    assert!(made.contains("-SEA STOKES 210 24 16.5 "), "{made}");
}

#[test]
fn tslk_prints_tethers_from_slack_for_its_duration() {
    // the listing has TSLK 0.001 and prints all four tethers at 6.5 s, when the first two go slack, and no more of them up to the
    // impact at 7.5 s; with 0.6 s each step of 0.25 s up to 7.1 s is printed [AQWA-TETHER A.6]
    for (time, printed) in [("0.001", &["6.50"][..]), ("  0.6", &["6.50", "6.75", "7.00"])] {
        let text = file("mint.dat")
            .replace("16TIME       101", "16TIME        31")
            .replace("    14TSLK                         0.001", &format!("    14TSLK                         {time}"));
        let (mut session, screen, _folder) = common::session();
        session.open_job("mint.dat", text);
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        let text = screen.text();
        for tether in 1..=4 {
            let head = format!("S I N G L E   T E T H E R   T {tether}");
            let page = text.split(&head).nth(1).unwrap().split("******").next().unwrap();
            let rows = page.lines().map(|line| line.split_whitespace().take(3).collect::<Vec<_>>());
            let times: Vec<&str> = rows.filter(|words| words.get(2) == Some(&"4")).map(|words| words[1]).collect();
            assert_eq!(times, printed, "tether {tether}\n{page}");
        }
    }
}

/// The first error of a job that is a deck, with the line and column it points at, and the name of the file.
fn error_of(text: &str) -> (Diagnostic, String) {
    let (mut session, _, _folder) = common::session();
    session.open_job("case.dat", text);
    session.run();
    let sources = &session.interpreter.sources;
    for report in &session.reports {
        let position = report.span.map(|span| sources.location(span)).unwrap_or_default();
        assert!(position.starts_with("case.dat:"), "{position}: {report:?}");
    }
    let errors = session.reports.iter().filter(|r| r.severity == windlass_base::diagnostic::Severity::Error);
    let error = errors.clone().next().unwrap_or_else(|| panic!("no error: {:#?}", session.reports));
    (error.clone(), error.span.map(|span| sources.location(span)).unwrap())
}

#[test]
fn record_error_points_at_its_source_card() {
    let start = "    15    STRT\n    15POS1             -46.000     0.000   -17.400     0.000     0.000       0.0\n \
                 END15VEL1               0.000     0.000     0.000     0.000     0.000       0.0";
    let cases = [
        // a density of 0: the field of deck 3
        (
            "mint.dat",
            " END03           101   7.81694    2.15E8\n",
            " END03           101       0.0    2.15E8\n",
            "deck 3, columns 21-30: RHO of -DENSITY of TETHER must be greater than zero",
            "101       0.0    2.15E8",
        ),
        // blank springs are 1.0E15, too stiff for the step
        (
            "he01.dat",
            "    14TSPA    1                      0.5       0.5       0.5\n",
            "    14TSPA    1\n",
            "deck 16, TIME: the step of 0.25 s is too large for the end springs of the towed tether",
            "END16TIME",
        ),
        // a structure that starts where deck 1 has it, far above its tethers
        (
            "mint.dat",
            start,
            "    15    NONE",
            "deck 14, TETH: tether T1 is 265.4055 m long, shorter",
            "    14TETH    1 1010",
        ),
    ];
    for (name, from, to, said, at) in cases {
        let text = file(name);
        assert!(text.contains(from), "{from}");
        let text = text.replacen(from, to, 1);
        let (error, position) = error_of(&text);
        assert!(error.message.starts_with(said), "{}", error.message);
        assert!(error.help.iter().any(|help| help.starts_with("the card is read as the record `")), "{error:?}");
        let line: usize = position.split(':').nth(1).unwrap().parse().unwrap();
        assert!(text.lines().nth(line - 1).unwrap().contains(at.trim_start()), "{position}: {said}");
    }
}
