//! Lines of deck 14 through their cards: forces on the structure where the deck puts it, and over time, against closed forms.
//!
//! The fairlead is at (0, 0, -10), the anchor at (535, 0, -100): sqrt(535^2 + 90^2) m apart. Numbers by numpy in double precision from the
//! formulas beside them.

use super::aqwa_decks::{
    SECTION, STILL, assert_near, lines, moored_deck, pulls, read_diagnostics, records, run, run_placed_deck,
};

use crate::common;
use windlass::session::Session;
use windlass_hydro::Category;

/// The structure is held in all degrees of freedom.
pub(super) fn hold_structure(deck: &str) -> String {
    let card = |dof: u8| format!("{:>4}12DACF    1{dof:5}\n", if dof == 6 { "END" } else { "" });
    let cards: String = (1..=6).map(card).collect();
    deck.replace("    12    NONE\n", &format!("    12    CONS\n{cards}"))
}

/// Forces of the connectors on a held structure over time: (s, N along X and Z), by its deck.
fn pulls_over_time(cards: &str) -> Vec<[f64; 3]> {
    let (session, _) = run("held.dat", &hold_structure(&moored_deck("NAUT", 100.0, cards, STILL)));
    let made = session.job.run.as_ref().unwrap();
    let history = &made.history;
    let (x, z) = match history.layout.category(0, Category::FlexConnectors) {
        Some(column) => (column, column + 2),
        None => panic!("no connectors"),
    };
    history.times().iter().zip(history.rows()).map(|(time, row)| [*time, row[x], row[z]]).collect()
}

/// Horizontal and vertical force of the one line of a deck on its structure (N), toward and down to the anchor.
fn pull(cards: &str) -> [f64; 2] {
    let (session, _) = run_placed_deck(&moored_deck("LIBR", 100.0, cards, STILL));
    let [pull] = pulls(&session.job.model)[..] else { panic!() };
    [pull[0], -pull[2]]
}

fn meets(cards: &str, horizontal: f64, vertical: f64) {
    let [h, v] = pull(cards);
    assert_near(h, horizontal);
    assert_near(v, vertical);
}

#[test]
fn polynomial_line_pulls_by_five_coefficients_beyond_its_length() {
    // e = 2.5172808 m; 1E5 e + 2E3 e2 + 5E2 e3 - 30 e4 + 4 e5
    let cards = |length: &str| {
        format!(
            "    14POLY                         1.0E5     2.0E3     5.0E2     -30.0       4.0\n END14NLIN    1    2    0   12{length:>20}\n"
        )
    };
    meets(&cards("540.0"), 267_813.76919560, 45_052.78360300);
    assert_eq!(pull(&cards("543.0")), [0.0; 2]);
}

#[test]
fn steel_wire_line_pulls_by_its_asymptotic_law() {
    // k (e - d tanh(e/d)), k = 3E5 N/m, d = 1.2 m
    meets(
        "    14SWIR                         3.0E5       1.2\n END14NLIN    1    2    0   12               540.0\n",
        400_245.30841804,
        67_330.98646285,
    );
}

#[test]
fn line_without_length_pulls_by_its_whole_distance() {
    meets(" END14LINE    1    2    0   12     500.0       0.0\n", 267_500.0, 45_000.0);
}

#[test]
fn line_over_pulley_of_structure_has_length_behind_it() {
    // from the ground to the fairlead (0, 0, -10) and 10 m on to (0, 0, 0): 1E5 N/m (542.5172808 + 10 - 550) m, less friction at rest
    let card = |ends: &str| {
        format!("    14LINE    0   12    1    2     1.0E5     550.0\n END14PULY{ends}{:>30}       1.3\n", "1.2")
    };
    let (session, text) = run_placed_deck(&moored_deck("LIBR", 100.0, &card("    1    2    1    1"), STILL));
    assert!(text.contains("-RATIO 1.2") && text.contains("CONNECTOR L1 ~L1 *N12 *S1_2"), "{text}");
    let [pull] = pulls(&session.job.model)[..] else { panic!() };
    let tension = 1e5 * (542.517_280_830_758_4 - 540.0);
    assert_near(-pull[0], tension * 535.0 / 542.517_280_830_758_4);
    assert_near(pull[2], tension * 90.0 / 542.517_280_830_758_4);
    for (ends, message) in
        [("    1    1    1    2", "the pulley is at node 1"), ("    1    2    0   12", "between two structures")]
    {
        let list = read_diagnostics(&moored_deck("LIBR", 100.0, &card(ends), STILL));
        assert!(list.iter().any(|e| e.message.contains(message) && e.span.is_some()), "{list:?}");
    }
}

#[test]
fn winch_lines_keep_tension_less_friction_winding_in() {
    // 100 kN, 0.3 winding in: 70 kN; a negative factor begins with paying out: 110 kN
    for kind in ["WNCH", "NLIN"] {
        let card = |friction: &str| {
            format!(
                "    14POLY                         1.0E5\n END14{kind}    1    2    0   12     1.0E5     540.0{friction:>10}       0.1\n"
            )
        };
        meets(&card("0.3"), 69_030.05917646, 11_612.53331940);
        meets(&card("-0.3"), 108_475.80727730, 18_248.26664478);
    }
}

#[test]
fn drum_winch_winds_in_from_its_start_at_its_speed() {
    // EA = 2E5 N/m (540 + 20) m; from 4 s on 0.05 m/s: 539.7 m at 10 s
    let cards = "    14DWT0                           4.0\n    14DWAL                          20.0\n\
                 \x20END14LNDW    1    2    0   12     2.0E5     540.0     530.0     -0.05\n";
    meets(cards, 496_480.12774578, 83_520.02148994);
    let rows = pulls_over_time(cards);
    let at = |time: f64| rows.iter().find(|row| (row[0] - time).abs() < 1e-9).unwrap();
    assert_near(at(4.0)[1], 496_480.12774578);
    assert_near(at(10.0)[1], 555_946.57842118);
    assert_near(-at(10.0)[2], 93_523.72347272);
}

#[test]
fn broken_line_acts_no_more_after_its_time_or_tension() {
    let line = "    14LINE    1    2    0   12     1.0E5     540.0\n";
    let acts = |time: &str, tension: &str| {
        let rows = pulls_over_time(&format!("{line} END14LBRK         1{time:>20}{tension:>10}\n"));
        rows.iter().rev().find(|row| row[1] != 0.0).map(|row| row[0])
    };
    // 248.2 kN along X, 251.7 kN in the line: at 3.05 s; at once beyond 250 kN; beyond 250 kN from 6 s on; never beyond 260 kN
    let last = acts("3.05", "").unwrap();
    assert!((2.9..=3.06).contains(&last), "{last}");
    assert!(acts("", "250.0E3").is_none_or(|last| last <= 0.1));
    let last = acts("6.0", "250.0E3").unwrap();
    assert!((5.9..=6.1).contains(&last), "{last}");
    assert_eq!(acts("", "260.0E3"), Some(10.0));
}

#[test]
fn composite_line_lies_on_sloping_bed_of_its_card() {
    // Elastic catenary on a plane without friction: from the anchor T falls by w sin(b) a metre down the bed; from the touchdown on
    // x = H/w (asinh(V1/H) - asinh(V0/H)) + H L/EA with V0 = H tan(b). Newton's method to 1E-9 m. 0 degrees give the numbers of the level bed.
    for (slope, horizontal, vertical) in
        [("3.0", 42_779.75566846, 119_143.65812504), ("-3.0", 252_748.87183456, 298_778.21120421)]
    {
        let cards = format!(
            "    14COMP                   1                    {slope:>10}\n{SECTION} END14NLIN    1    2    0   12\n"
        );
        meets(&cards, horizontal, vertical);
        let text = moored_deck("LIBR", 100.0, &cards, STILL);
        assert!(read_diagnostics(&text).iter().any(|note| note.message.contains("sign of the slope")));
    }
}

#[test]
fn stiffening_composite_line_pulls_by_its_polynomial_of_strain() {
    // 540 m of 15.2055 N/m in water, taut: x = int H/T (1 + e) ds and z so, T = (6E7 + 2E8 e + 3E9 e2 + 1E10 e3) e of ECAX, solved in
    // 25 digits; without ECAX T = 6E7 e. Drag and bending (ECAH, ECAB) are of cable dynamics
    let cards = |growth: &str| {
        format!(
            "    14COMP                   1\n    14ECAT                          20.0     0.018     6.0E7     5.0E6     540.0\n{growth}\
             \x20   14ECAH                           1.1                 1.2       0.3      0.04\n    14ECAB                           5.0\n\
             \x20END14NLIN    1    2    0   12\n"
        )
    };
    meets(
        &cards("    14ECAX                         2.0E8     3.0E9    1.0E10\n"),
        282_450.460_016_26,
        51_623.754_579_408,
    );
    meets(&cards(""), 277_857.602_872_07, 50_851.177_663_471);
}

#[test]
fn dynamic_line_of_deck_hangs_as_catenary_unless_switched_off() {
    let cards =
        |switch: &str| format!("    14COMP                   1\n{SECTION}{switch} END14NLID    1    2    0   12\n");
    let deck = moored_deck("LIBR", 100.0, &cards(""), STILL);
    let (session, text) = run_placed_deck(&deck);
    assert!(text.contains("&CONNECTOR L1 -DYNAMICS"), "{text}");
    let [pull] = pulls(&session.job.model)[..] else { panic!() };
    // the chords of its elements, and a bottom that gives way: 1 per cent
    assert!((pull[0] / 135_470.098_796_51 - 1.0).abs() < 0.01, "{pull:?}");
    let off = lines(&records(&moored_deck("LIBR", 100.0, &cards("    14DOFF\n"), STILL)).unwrap());
    assert!(!off.contains("&CONNECTOR"), "{off}");
}

#[test]
fn wrong_winches_and_breaks_are_refused_with_card_and_columns() {
    for (cards, message) in [
        (
            " END14LNDW    1    2    0   12     2.0E5     540.0     530.0\n",
            "deck 14 MOOR, LNDW, columns 61-70: this field is blank",
        ),
        (" END14LNDW    1    2    0   12       0.0     540.0     530.0      -1.0\n", "deck 14, LNDW, columns 31-40"),
        (" END14WNCH    1    2    0   12     1.0E5     540.0       1.5\n", "deck 14, WNCH: tension and length"),
        ("    14LINE    1    2    0   12     1.0E5     540.0\n END14LBRK         2       3.0\n", "deck 14 MOOR, LBRK"),
        (
            "    14LINE    1    2    0   12     1.0E5     540.0\n END14LBRK         2                 3.0\n",
            "deck 14, LBRK, columns 16-20: there is no line 2",
        ),
        (
            "    14LINE    1    2    0   12     1.0E5     540.0\n END14LBRK         1                -3.0\n",
            "deck 14 MOOR, LBRK, columns 31-40: -3.0 is below 0",
        ),
        (" END14SWIR                         3.0E5\n", "deck 14 MOOR, SWIR, columns 41-50: this field is blank"),
        (" END14DRUM    1    2    0   12\n", "deck 14 MOOR, DRUM: no public source"),
        (" END14FENP    1    2    0   12\n", "deck 14 MOOR, FENP: no public source"),
    ] {
        let list = read_diagnostics(&moored_deck("LIBR", 100.0, cards, STILL));
        let found = list.iter().find(|error| error.message.starts_with(message));
        assert!(found.is_some_and(|error| error.span.is_some()), "{message}: {list:?}");
    }
    // a composite has no winch, and the far end of a catenary is not watched
    let composite = format!("    14COMP                   1\n{SECTION}");
    let line = "14NLIN    1    2    0   12";
    for (cards, message) in [
        (format!("{composite} END{line}{:>10}\n", "1.0E5"), "NLIN of a COMP with columns 31-70"),
        (format!("{composite}    {line}\n END14LBRK{:>10}{:>40}\n", "1", "1.0E5"), "columns 51-60"),
    ] {
        let list = records(&moored_deck("NAUT", 100.0, &cards, STILL)).unwrap_err();
        assert!(list.iter().any(|error| error.message.contains(message) && error.span.is_some()), "{list:?}");
    }
}

#[test]
fn line_beside_tethers_pulls_platform_in_mooring_forces() {
    let deck = std::fs::read_to_string("scripts/mint.dat").unwrap().replace("16TIME       101", "16TIME         3");
    let slack = "    14TSLK                         0.001\n";
    let with = deck.replace(slack, &format!("{slack}    14LINE    1 1010    0 9010     100.0     250.0\n"));
    assert_ne!(deck, with);
    let mooring = |text: &str| {
        let (session, _) = run("mint.dat", text);
        let structure = session.job.tethered.as_ref().unwrap().structure.clone().unwrap();
        let kinds = windlass_solve::tethered::StructureHistory::KINDS;
        let column = |name: &str| 6 * kinds.iter().position(|kind| *kind == name).unwrap();
        ["MOORING", "TOTAL FORCE", "DIFFRACTION"]
            .map(|kind| [0, 1, 2].map(|axis| structure.value(0, column(kind) + axis).unwrap()))
    };
    let (own, both) = (mooring(&deck), mooring(&with));
    // 100 kN/m over 250 m, from node 1010 as POS1 puts it to the anchor
    let mut sources = windlass_language::source::Sources::default();
    let id = sources.add("deck", with.as_str(), 1);
    let read = windlass_aqwa::read(&sources, id).deck;
    let from = read.node_position(read.structure(1).unwrap(), 1010).unwrap();
    let to = [-52.630, 52.630, -329.735_43];
    let chord = [0, 1, 2].map(|axis| to[axis] - from[axis]);
    let length = chord.iter().map(|x| x * x).sum::<f64>().sqrt();
    for axis in 0..3 {
        let pull = 100e3 * (length - 250.0) * chord[axis] / length;
        assert!((both[0][axis] - own[0][axis] - pull).abs() < 1.0, "{axis}: {} {pull}", both[0][axis] - own[0][axis]);
        assert!((both[1][axis] - own[1][axis] - pull).abs() < 1.0 && both[2] == own[2]);
    }
}

/// A hemisphere of 10 m whose coefficients are in tests/data/hemisphere/hemisphere.AH1, held but for heave, with a constant force of 1 MN in
/// its line and these decks 12 and 13.
pub(super) fn hemisphere(program: &str, held: &[u8], waves: &str) -> String {
    let file = "    07    WFS1\n END07FILE              tests/data/hemisphere/hemisphere.AH1\n";
    let card =
        |(n, dof): (usize, &u8)| format!("{:>4}12DACF    1{dof:5}\n", if n + 1 == held.len() { "END" } else { "" });
    let cards: String = held.iter().enumerate().map(card).collect();
    moored_deck(program, 100.0, " END14FORC    1    2    0   12     1.0E6\n", waves)
        .replace(" END02PMAS", "    02QPPL DIFF     (1)(1)(1)(2)(2)\n END02PMAS")
        .replace("    1     1.0E7\n", "    1 2146755.0\n")
        .replace("END05ACCG      9.81", "END05ACCG   9.80665")
        .replace(
            "     1.0E9       0.0       0.0     1.0E9       0.0     1.0E9",
            "   5.367E7       0.0       0.0   5.367E7       0.0   5.367E7",
        )
        .replace("    07    NONE\n", file)
        .replace("    12    NONE\n", &format!("    12    CONS\n{cards}"))
}

pub(super) const BUT_HEAVE: [u8; 5] = [1, 2, 4, 5, 6];

#[test]
fn librium_job_of_hull_with_text_database_sinks_by_its_stiffness() {
    let (session, _) = run("hull.dat", &hemisphere("LIBR", &BUT_HEAVE, STILL));
    let body = session.job.model.bodies.values().next().unwrap();
    // 3152.8 kN/m of the file against 1 MN down the line: dz = -1E6 v / sqrt(535^2 + v^2) / 3.1528E6, v = 90 + dz
    assert!((body.position.shift[2] + 0.052_587_879).abs() < 1e-6, "{:?}", body.position);
}

#[test]
fn fer_job_has_heave_of_coefficients_of_its_file() {
    let (mut session, screen, _folder) = common::session();
    session.open_job("hull.dat", hemisphere("FER ", &BUT_HEAVE, STILL));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    // 0.95 rad/s, X / (C + T/L (1 - n2) - w2 (M + A) - i w B) with the rows of the file: 1.757507, lag 24.3267 degrees
    let text = screen.text();
    let row = text.lines().find(|line| line.starts_with("    0.00    6.61     0.9500")).unwrap();
    assert!(row.contains("1.7575E+00       24.33"), "{row}");
    // without a place in deck 15 the equilibrium is found: 0.0526 m down by 1 MN in the line over 3152.8 kN/m of the file
    let start = hemisphere("FER ", &BUT_HEAVE, STILL);
    let (from, to) = (start.find("    15    STRT").unwrap(), start.find("    16    ").unwrap());
    let (session, _) = run("hull.dat", &format!("{}    15    NONE\n{}", &start[..from], &start[to..]));
    let body = session.job.model.bodies.values().next().unwrap();
    assert!((body.position.shift[2] + 0.052_587_879).abs() < 1e-6, "{:?}", body.position);
    // a sea gives statistics
    let sea = "    13    SPEC\n END13PSMZ                 0.3       2.0       3.0       6.0\n";
    let made = records(&hemisphere("FER ", &BUT_HEAVE, sea)).unwrap().job.join("\n");
    assert!(
        made.contains("FREQ_RESPONSE\nSRESPONSE\nSTATISTICS MOTION S1\nREPORT\nEND\nSTATISTICS TENSION L1"),
        "{made}"
    );
}

#[test]
fn naut_job_of_hull_reaches_heave_of_its_coefficients() {
    // 0.1 m of 6.613879 s, 0.95 rad/s: 1.757507 times 0.1 m about where it rests, once what it began with has died away
    let wave = "    13    WAVE\n    13WAMP                 0.1\n    13PERD            6.613879\n END13AIRY\n";
    let deck = hemisphere("NAUT", &BUT_HEAVE, wave)
        .replace("16TIME       101       0.1", "16TIME       901       0.1")
        .replace(
            "       0.0       0.0       0.0       0.0       0.0       0.0\n    16",
            "       0.0       0.0 -0.052588       0.0       0.0       0.0\n    16",
        );
    let (session, _) = run("hull.dat", &deck);
    let history = &session.job.run.as_ref().unwrap().history;
    let heave = history.layout.body(0) + 2;
    let last: Vec<f64> =
        history.times().iter().zip(history.rows()).filter(|(t, _)| **t > 70.0).map(|(_, row)| row[heave]).collect();
    let (low, high) = last.iter().fold((f64::MAX, f64::MIN), |(low, high), z| (low.min(*z), high.max(*z)));
    // the step of 0.1 s and a ramp that has left under a per cent
    assert!(((high - low) / 2.0 / 0.175_750_7 - 1.0).abs() < 0.01, "{low} {high}");
}

#[test]
fn job_without_coefficients_of_its_hull_is_an_error() {
    let sea = "    13    SPEC\n END13PSMZ                 0.3       2.0       3.0       6.0\n";
    for program in ["LIBR", "FER ", "DRIF", "NAUT"] {
        let deck = moored_deck(program, 100.0, " END14FORC    1    2    0   12     1.0E6\n", sea);
        let list = records(&deck).unwrap_err();
        assert!(
            list.iter().any(|e| e.message.starts_with("decks 6 to 8: structure 1 has no wave coefficients")),
            "{list:?}"
        );
    }
    // binary files, and LINE, are refused by name
    let binary = hemisphere("DRIF", &BUT_HEAVE, sea).replace("hemisphere.AH1", "hemisphere.HYD");
    let list = read_diagnostics(&binary);
    let found = list.iter().find(|e| {
        e.message == "deck 7, FILE, columns 21-80: `tests/data/hemisphere/hemisphere.HYD` is no text database of AQWA"
    });
    assert!(found.is_some_and(|e| e.span.is_some() && e.help[0].contains("AHD1")), "{list:?}");
    let list = records(&hemisphere("LINE", &BUT_HEAVE, STILL)).unwrap_err();
    assert!(list[0].message.starts_with("deck 0: LINE is the diffraction of waves by panels"), "{list:?}");
}

/// The deck with more nodes.
pub(super) fn with_nodes(deck: &str, nodes: &[(u32, [f64; 3])]) -> String {
    let card = |(number, [x, y, z]): &(u32, [f64; 3])| format!("    01{number:4}          {x:10.3}{y:10.3}{z:10.3}\n");
    let cards: String = nodes.iter().map(card).collect();
    deck.replace(" END01  12", &format!("{cards} END01  12"))
}

/// Force and moment (N, N m) of the one connector of a model on its first end.
fn wrench(session: &Session) -> [f64; 6] {
    let model = &session.job.model;
    let surroundings = model.surroundings();
    let connector = model.connectors.values().next().unwrap();
    let element = model.element(connector).unwrap();
    let ends = model.end_poses(connector).map(windlass_model::End::at_rest);
    let at = windlass_model::Situation { ends: &ends, step: None, surroundings: &surroundings };
    let mut out = windlass_model::ConnectorResponse::default();
    let (committed, mut trial) = (vec![0.0; element.states()], vec![0.0; element.states()]);
    element.evaluate(&at, &committed, &mut trial, &mut windlass_model::SolverCache::new(), &mut out).unwrap();
    out.wrench[0].into()
}

#[test]
fn fixed_fender_pushes_by_polynomial_of_its_compression() {
    // 1 m high, its base on the structure at (0, 0, -10); the face of the ground 0.6 m in front of it along X, so 0.4 m of compression:
    // 1E5 0.4 + 2E5 0.4^2 + 3E5 0.4^3 = 91,200 N
    let nodes = [(21, [0.6, 0.0, -10.0]), (22, [1.6, 0.0, -10.0])];
    let cards = |poly: &str, damping: &str| {
        format!(
            "    14POLY{:20}{poly}\n    14FEND{:>30}{:>20}{damping:>20}\n END14FLIN    1{:>10}    2{:>15}   21   22\n",
            "", "1.0", "0.2", "1", "0"
        )
    };
    let cubic = cards("     1.0E5     2.0E5     3.0E5", "");
    for yaw in ["0.0", "30.0"] {
        let deck = with_nodes(&moored_deck("LIBR", 100.0, &cubic, STILL), &nodes)
            .replace("       0.0\n    16    TINT", &format!("{yaw:>10}\n    16    TINT"));
        let (session, _) = run_placed_deck(&deck);
        let [x, y, z, ..] = wrench(&session);
        assert!((x + 91_200.0).abs() < 1e-3 && y.abs() < 1e-3 && z.abs() < 1e-3, "{yaw}: {x} {y} {z}");
    }
    // a linear one: 4E4 N, damped by 0.1 s times 1E5 N/m
    let text =
        lines(&records(&with_nodes(&moored_deck("LIBR", 100.0, &cards("     1.0E5", "0.1"), STILL), &nodes)).unwrap());
    assert!(text.contains("-FRICTION 0.2 -X_DAMPING 10 1"), "{text}");
    // damping of a stiffness that changes, and other types, are refused
    let list = records(&with_nodes(&moored_deck("LIBR", 100.0, &cards("     1.0E5     2.0E5", "0.1"), STILL), &nodes))
        .unwrap_err();
    assert!(list[0].message.starts_with("deck 14, FEND, columns 71-80"), "{list:?}");
    let floating = cubic.replace("14FLIN    1", "14FLIN    2");
    assert!(
        read_diagnostics(&moored_deck("LIBR", 100.0, &floating, STILL))
            .iter()
            .any(|e| e.message == "deck 14, FLIN, columns 11-15: a fender of type 2 is not read")
    );
}

/// A body of 1E7 kg at (0, 0, 0) that hangs from a joint of the ground, at rest.
fn hung(joint: &str, others: &str) -> [f64; 6] {
    let nodes = [(24, [3.0, 0.0, 2.0]), (25, [4.0, 0.0, 2.0]), (26, [3.0, 0.0, 3.0]), (27, [0.0, 0.0, 5.0])];
    let deck = with_nodes(&moored_deck("LIBR", 100.0, "", STILL), &nodes)
        .replace("    14    MOOR\n", "    14    NONE\n")
        .replace("    12    NONE\n", &format!("    12    CONS\n{others} END12DCON{joint}\n"));
    let (session, _) = run("hung.dat", &deck);
    wrench(&session)
}

#[test]
fn articulation_reactions_carry_weight_and_locked_moments() {
    let weight = 1e7 * 9.81;
    let close = |got: [f64; 6], want: [f64; 6]| {
        // the joint gives by 1E-4 m and 3E-4 rad, which moves the weight's arm as much
        assert!(got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-3 * weight), "{got:?}, {want:?}");
    };
    // on the body: up, and about its Y axis 3 m times the weight where that rotation is locked
    close(hung("    0    1   27              0   27", ""), [0.0, 0.0, weight, 0.0, 0.0, 0.0]);
    close(hung("    3    1   24              0   24", ""), [0.0, 0.0, weight, 0.0, 3.0 * weight, 0.0]);
    // a hinge along X, 2 m above the centre
    close(hung("    2    1   24   25         0   24   25", ""), [0.0, 0.0, weight, 0.0, 3.0 * weight, 0.0]);
    // a universal joint that is free about X and Z, with RZ held by DACF
    close(
        hung("    1    1   24   25         0   24   26", "    12DACF    1    6\n"),
        [0.0, 0.0, weight, 0.0, 3.0 * weight, 0.0],
    );
}

/// A deck whose body heaves on a linear stiffness of 5E7 N/m without anything else, from 1 m above its equilibrium, with these further cards of deck 7.
fn heaving(cards: &str) -> Vec<[f64; 2]> {
    let stiffness = format!(
        "    07    WFS1\n    07LSTF         3                         5.0E7\n    07BFEQ             9.81E7\n{cards} END07ZCGE                 0.0\n"
    );
    let deck = moored_deck("NAUT", 100.0, " END14FORC    1    2    0   12       0.0\n", STILL)
        .replace("    07    NONE\n", &stiffness)
        .replace("16TIME       101       0.1", "16TIME       401     0.025")
        .replace("15POS1                 0.0       0.0       0.0", "15POS1                 0.0       0.0       1.0");
    let deck = {
        let cards: String = [1, 2, 4, 5, 6]
            .iter()
            .map(|dof| format!("{:>4}12DACF    1{dof:5}\n", if *dof == 6 { "END" } else { "" }))
            .collect();
        deck.replace("    12    NONE\n", &format!("    12    CONS\n{cards}"))
    };
    let (session, _) = run("heave.dat", &deck);
    let history = &session.job.run.as_ref().unwrap().history;
    let heave = history.layout.body(0) + 2;
    history.times().iter().zip(history.rows()).map(|(time, row)| [*time, row[heave]]).collect()
}

#[test]
fn constant_added_mass_and_damping_of_deck_7_act_on_body() {
    // m z'' + b z' + c z = 0 from rest at 1 m: exp(-n t) (cos w t + n/w sin w t), n = b/2m, w = sqrt(c/m - n2), m = 1E7 + 2.5E6 kg, b = 4E6 N s/m
    let cards =
        "    07FIAM         3                         2.5E6\n    07FIDP         3                         4.0E6\n";
    let (mass, damping, stiffness) = (1.25e7, 4e6, 5e7f64);
    let n = damping / 2.0 / mass;
    let w = (stiffness / mass - n * n).sqrt();
    for [time, z] in heaving(cards) {
        let want = (-n * time).exp() * ((w * time).cos() + n / w * (w * time).sin());
        // the scheme lengthens a period of 3.1 s in steps of 0.025 s by 3E-4 of itself, 20 rad into the run, and damps by 1E-4 a period
        assert!((z - want).abs() < 0.01, "{time}: {z} {want}");
    }
    // without the cards the period is shorter by sqrt(0.8)
    let alone = heaving("");
    let [time, z] = alone[80];
    assert!((z - (5f64.sqrt() * time).cos()).abs() < 0.01, "{time}: {z}");
}

#[test]
fn pretension_of_composite_line_finds_length_of_its_section() {
    // of 150 kN at the fairlead 90 m above the bottom: H = EA (sqrt((T/EA + 1)2 - 2 w z/EA) - 1), V = sqrt(T2 - H2), w = (150 - 18.45) 9.81 N/m
    let section = SECTION.replace("ECAT                         150.0", "ECAT                   1     150.0");
    let cards =
        format!("    14COMP                   1\n{section}    14DOFF\n END14NLID    1    2    0   12     2.5E5\n");
    let (ea, w, t) = (6e8f64, (150.0 - 1025.0 * 0.018) * 9.81, 2.5e5);
    let h = ea * (((t / ea + 1.0f64).powi(2) - 2.0 * w * 90.0 / ea).sqrt() - 1.0);
    let (session, text) = run_placed_deck(&moored_deck("LIBR", 100.0, &cards, STILL));
    assert!(text.contains("&CONNECTOR L1 -L_TENSION 250\n"), "{text}");
    let [pull] = pulls(&session.job.model)[..] else { panic!() };
    assert!((pull[0] / h - 1.0).abs() < 1e-6 && (-pull[2] / (t * t - h * h).sqrt() - 1.0).abs() < 1e-6, "{pull:?} {h}");
}

#[test]
fn listing_and_run_of_line_deck_name_one_scheme() {
    let (mut session, screen, _folder) = common::session();
    session.open_job(
        "held.dat",
        moored_deck("NAUT", 100.0, " END14LINE    1    2    0   12     1.0E5     540.0\n", STILL),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let text = screen.text();
    let row =
        |name: &str| text.lines().find(|line| line.trim_start().starts_with(name)).unwrap().split('=').nth(1).unwrap();
    let listed = row("INTEGRATION SCHEME").trim().to_lowercase();
    assert_eq!(listed, format!("implicit, {}", row("Scheme").trim()));
    assert!(!text.contains("PREDICTOR"), "{text}");
}

/// The errors of a job of the hemisphere that names a file of this content, with the lines of the deck they point at.
fn errors_of_hull(deck: &str, name: &str, content: &str) -> Vec<(String, String)> {
    let (mut session, _, folder) = common::session();
    std::fs::write(folder.path().join(name), content).unwrap();
    session.open_job("hull.dat", deck);
    session.run();
    let line = |span| {
        let (line, _) = session.interpreter.sources.position(span).unwrap();
        deck.lines().nth(line.saturating_sub(1)).unwrap_or_default().to_string()
    };
    let errors = session.reports.iter().filter(|r| r.severity == windlass_base::diagnostic::Severity::Error);
    errors.map(|error| (error.message.clone(), error.span.map(line).unwrap_or_default())).collect()
}

#[test]
fn hull_of_file_with_blank_in_name_and_of_several_structures() {
    let path = "tests/data/hemisphere/hemisphere.AH1";
    let one = std::fs::read_to_string(path).unwrap();
    let two = one.replacen("     1     8    25", "     2     8    25", 1);
    assert_ne!(one, two);
    let deck = hemisphere("LIBR", &BUT_HEAVE, STILL).replace(path, "my hull.AH1");
    assert_eq!(errors_of_hull(&deck, "my hull.AH1", &one), []);
    let errors = errors_of_hull(&deck, "my hull.AH1", &two);
    let (message, line) = errors.first().unwrap();
    assert!(
        message.starts_with("deck 7, FILE: ") && message.contains("it has 2 structures: -INDEX, or CSTR of a deck,"),
        "{message}"
    );
    assert!(line.contains("07FILE"), "{line}");
    let other = errors_of_hull(&deck, "other.AH1", &one);
    let (message, _) = other.first().unwrap();
    assert!(message.starts_with("deck 7, FILE: there is no file ") && message.ends_with("my hull.AH1"), "{message}");
    // CSTR takes one of them; that this file has no second structure is said of that card
    let with = deck.replace("    07    WFS1\n", "    07    WFS1\n    07CSTR    2\n");
    let errors = errors_of_hull(&with, "my hull.AH1", &one);
    assert!(errors[0].0.contains("there is no structure 2: it has 1"), "{errors:?}");
}

#[test]
fn error_of_equilibrium_points_at_job_and_not_at_time_steps() {
    let deck = moored_deck(
        "LIBR",
        100.0,
        &format!("    14COMP                   1\n{SECTION} END14NLIN    1    2    0   12\n"),
        STILL,
    );
    let errors = errors_of_hull(&deck, "unused", "");
    let (message, line) = errors.first().unwrap();
    assert!(message.starts_with("deck 0, JOB: body S1: it sinks") && line.starts_with("JOB"), "{message} {line}");
}

#[test]
fn drum_with_final_length_behind_it_is_reported_by_its_forces() {
    let drum = |last: &str| {
        let (mut session, screen, _folder) = common::session();
        let text = format!(
            "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*QUAY 0 0 8\n&DESCRIBE BODY SHIP\n*BITT 12 3 6\n~WINCH LNDW 2E5 10 {last} -0.1\n\
             CONNECTOR W1 ~WINCH *BITT *QUAY\nEND\n&STATUS F_CONNECTOR\n"
        );
        session.open("test.cif", text);
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        screen.text()
    };
    let note = "the drum never turns: its final length is not where its speed leads";
    assert!(drum("12").contains(note) && !drum("6").contains(note), "{}", drum("12"));
}

#[test]
fn start_of_time_card_is_first_instant_and_breaks_count_from_zero() {
    let line = "    14LINE    1    2    0   12     1.0E5     540.0\n";
    let last_pull = |time: &str| {
        let cards = format!("{line} END14LBRK         1{time:>20}\n");
        let deck = moored_deck("NAUT", 100.0, &cards, STILL)
            .replace("16TIME       101       0.1", "16TIME       101       0.1     100.0");
        let (session, _) = run("held.dat", &hold_structure(&deck));
        let made = session.job.run.as_ref().unwrap();
        let column = made.history.layout.category(0, Category::FlexConnectors).unwrap();
        let times = made.history.times();
        assert_eq!((times[0], times.last().copied(), times.len()), (100.0, Some(110.0), 101));
        let rows = times.iter().zip(made.history.rows());
        rows.filter(|(_, row)| row[column] != 0.0).last().map(|(time, _)| *time)
    };
    let last = last_pull("103.05").unwrap();
    assert!((102.9..=103.06).contains(&last), "{last}");
    // broken before the run begins; after it ends
    assert_eq!(last_pull("3.05"), None);
    assert_eq!(last_pull("120.0"), Some(110.0));
}
