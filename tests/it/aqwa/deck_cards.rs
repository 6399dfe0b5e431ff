//! Cards that act, or are refused or named with deck, card and columns: line breaks in every program, locked joints, blank fields, cards in the
//! wrong place, coefficients that a hull lacks, and what deck 18 prints of lines.
//!
//! The fairlead is at (0, 0, -10), the anchor at (535, 0, -100): sqrt(535^2 + 90^2) m apart.

use super::aqwa_decks::{SECTION, STILL, assert_near, moored_deck, read_diagnostics, records, run};
use super::deck_lines::{BUT_HEAVE, hemisphere, hold_structure, with_nodes};
use crate::common;
use windlass_solve::System;
use windlass_solve::tethered::StructureHistory;

/// Distance of fairlead and anchor (m).
const DISTANCE: f64 = 542.517_280_830_758_4;
const LINE: &str = "    14LINE    1    2    0   12     1.0E5     540.0\n";

/// Deck 7: stiffness in heave, roll and pitch about a centre of gravity in the water line, with a buoyancy that bears 1E7 kg.
fn floating(deck: &str, [heave, roll, pitch]: [&str; 3]) -> String {
    let row = |row: u8, value: &str| {
        let values: String = (1..=6).map(|dof| format!("{:>10}", if dof == row { value } else { "0.0" })).collect();
        format!("    07LSTF{row:>10}{values}\n")
    };
    let cards = format!(
        "    07    WFS1\n{}{}{}    07BFEQ              9.81E7\n END07ZCGE                 0.0\n",
        row(3, heave),
        row(4, roll),
        row(5, pitch)
    );
    deck.replace("    07    NONE\n", &cards)
}

/// Deck 18 with these cards.
fn printing(deck: &str, cards: &str) -> String {
    deck.replace("    18    NONE\n", &format!("    18    PROP\n{cards}"))
}

/// What a deck says as read and as records: messages alone.
fn messages(deck: &str) -> Vec<String> {
    let mut list: Vec<_> = read_diagnostics(deck);
    if list.iter().all(|message| message.severity != windlass_base::diagnostic::Severity::Error) {
        list.extend(match records(deck) {
            Ok(made) => made.notes,
            Err(errors) => errors,
        });
    }
    assert!(list.iter().all(|message| message.span.is_some()), "{list:?}");
    list.into_iter().map(|message| message.message).collect()
}

fn says(deck: &str, wanted: &str) {
    let list = messages(deck);
    assert!(list.iter().any(|message| message == wanted), "{wanted}: {list:#?}");
}

#[test]
fn line_broken_in_its_spectrum_is_out_of_librium_and_fer() {
    // LBRK of LIBR and FER has the spectrum in columns 11-15: the line of 2E5 N/m is out, that of 1E5 N/m stays
    let cards = |ending: &str| format!("{LINE}{} END14LBRK{ending}\n", LINE.replace("1.0E5", "2.0E5"));
    let broken = cards("    1    2");
    let (session, _) = run("broken.dat", &hold_structure(&moored_deck("LIBR", 100.0, &broken, STILL)));
    let model = &session.job.model;
    let acts: Vec<bool> = model.connectors.values().map(|connector| connector.active).collect();
    assert_eq!(acts, [true, false]);
    let system = System::new(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    let along: f64 = all.iter().map(|one| one.load.wrench[0]).sum();
    assert_near(along, 1e5 * (DISTANCE - 540.0) * 535.0 / DISTANCE);
    let pull = " END14FORC    1    2    0   12     1.0E6\n";
    let made = records(&hemisphere("FER ", &BUT_HEAVE, STILL).replace(pull, &broken)).unwrap().job.join("\n");
    assert!(made.contains("&CONNECTOR L2 -INACTIVE") && made.contains("CONFORCE L1") && !made.contains("CONFORCE L2"));
    // without its spectrum, and with what is of runs in time
    says(&moored_deck("LIBR", 100.0, &cards("         2"), STILL), "deck 14, LBRK, columns 11-15: this field is blank");
    says(
        &moored_deck("LIBR", 100.0, &cards("    1    2                 3.0"), STILL),
        "deck 14, LBRK, columns 31-60: times and tensions are of DRIF and NAUT: the line is broken from the start",
    );
    says(
        &moored_deck("NAUT", 100.0, &cards("    1    2                 3.0"), STILL),
        "deck 14, LBRK, columns 11-15: a spectrum is of LIBR and FER: the line breaks by its time and tensions alone",
    );
}

/// A line of 100 kN/m and 250 m beside the tethers of the installed example, with a card LBRK, for some steps: force under MOORING at each
/// state (N), and the force that the line has between its node and its anchor there.
fn beside_tethers(card: &str) -> Vec<[[f64; 3]; 2]> {
    let deck = std::fs::read_to_string("scripts/mint.dat").unwrap().replace("16TIME       101", "16TIME         4");
    let slack = "    14TSLK                         0.001\n";
    let with = deck.replace(slack, &format!("{slack}    14LINE    1 1010    0 9010     100.0     250.0\n{card}"));
    assert_ne!(deck, with);
    let (session, _) = run("mint.dat", &with);
    let made = session.job.tethered.as_ref().unwrap();
    let structure = made.structure.as_ref().unwrap();
    let kinds = StructureHistory::KINDS;
    let mooring = 6 * kinds.iter().position(|kind| *kind == "MOORING").unwrap();
    let point = 6 * kinds.len() + 3 * structure.points.iter().position(|name| name == "*S1_1010").unwrap();
    let three = |instant: usize, column: usize| [0, 1, 2].map(|axis| structure.value(instant, column + axis).unwrap());
    let anchor = [-52.630, 52.630, -329.735_43];
    let pull = |from: [f64; 3]| {
        let chord = [0, 1, 2].map(|axis| anchor[axis] - from[axis]);
        let length = chord.iter().map(|x| x * x).sum::<f64>().sqrt();
        chord.map(|x| 100e3 * (length - 250.0) * x / length)
    };
    (0..made.times.len()).map(|instant| [three(instant, mooring), pull(three(instant, point))]).collect()
}

#[test]
fn line_beside_tethers_breaks_at_its_time_or_tension() {
    let whole = beside_tethers("");
    // states of 0.25 s: broken at the third one, 0.5 s; the motion up to there is that of the line that holds
    let step = 0.25;
    let broken = beside_tethers(&format!("    14LBRK         1{:>20}\n", 2.0 * step));
    for (instant, (whole, broken)) in whole.iter().zip(&broken).enumerate().take(3) {
        let [force, pull] = whole;
        for axis in 0..3 {
            let gone = force[axis] - broken[0][axis];
            let want = if instant < 2 { 0.0 } else { pull[axis] };
            assert!((gone - want).abs() < 1.0, "{instant} {axis}: {gone} {want}");
        }
    }
    // by tension: at once below what the line has at the start, never above what it has at any state
    let tension = |pull: &[f64; 3]| pull.iter().map(|x| x * x).sum::<f64>().sqrt() / 1e3;
    let [_, start] = &whole[0];
    let at_once = beside_tethers(&format!("    14LBRK         1{:>30.1}\n", tension(start) - 10.0));
    assert!((whole[0][0][2] - at_once[0][0][2] - start[2]).abs() < 1.0);
    let most = whole.iter().map(|[_, pull]| tension(pull)).fold(0.0, f64::max);
    let never = beside_tethers(&format!("    14LBRK         1{:>30.1}\n", most + 10.0));
    assert_eq!(whole, never);
}

#[test]
fn actions_that_tethers_cannot_take_are_refused_by_name() {
    let refused = |action: &str, wanted: &str| {
        let (mut session, _, folder) = common::session();
        let deck = std::fs::read_to_string("scripts/mint.dat").unwrap();
        std::fs::write(folder.path().join("tlp.dat"), deck).unwrap();
        session.open("test.cif", format!("INMODEL -AQWA tlp.dat\n&ACTION A {action}\nTDOM -TETHERS\n"));
        session.run();
        let said: Vec<&str> = session.reports.iter().map(|report| report.message.as_str()).collect();
        assert!(said.iter().any(|message| message.contains(wanted)), "{wanted}: {said:?}");
    };
    refused("-AT 0.25 -STOP", "action A: a run of tethers ends with -TIME of &ENV");
    refused("-AT 0.25 -RELEASE T1", "action A: T1 is no connector that acts on S1 beside its tethers");
}

#[test]
fn locked_joint_of_floating_body_carries_whole_moment() {
    // 1 MN from (0, 0, -10) to the anchor about the joint at (3, 0, 2): F = 1E6 (535, 0, -90)/542.517, M = -12 Fx + 3 Fz about Y; the water
    // bears the weight. The stiffness in pitch of 1.5E11 N m/rad does not move the joint, which is locked
    let nodes = [(24, [3.0, 0.0, 2.0])];
    let deck = with_nodes(&moored_deck("LIBR", 100.0, " END14FORC    1    2    0   12     1.0E6\n", STILL), &nodes)
        .replace("    12    NONE\n", "    12    CONS\n END12DCON    3    1   24              0   24\n");
    for pitch in ["0.0", "1.5E11", "3.0E12"] {
        let (session, _) = run("locked.dat", &floating(&deck, ["3.0E7", "1.0E10", pitch]));
        let model = &session.job.model;
        let system = System::new(model, &[]).unwrap();
        let all = system.contributions(&system.state(model).poses).unwrap();
        let joint = all.iter().find(|one| one.connector.as_deref() == Some("J1")).unwrap();
        // about the origin of the body, 2 m below and 3 m behind the joint
        let [x, z, moment] = [0, 2, 4].map(|dof| joint.load.wrench[dof]);
        let force = [1e6 * 535.0 / DISTANCE, -1e6 * 90.0 / DISTANCE];
        assert!((x + force[0]).abs() < 1e-5 * force[0], "{pitch}: {x}");
        assert!((z + force[1]).abs() < 1e-4 * force[0], "{pitch}: {z}");
        // the force acts 10 m below that origin
        assert!((moment - 10.0 * force[0]).abs() < 1e-5 * 10.0 * force[0], "{pitch}: {moment}");
    }
}

#[test]
fn blank_field_without_a_meaning_is_refused_with_its_columns() {
    let held = |card: &str| {
        moored_deck("LIBR", 100.0, &LINE.replacen("    14", " END14", 1), STILL)
            .replace("    12    NONE\n", &format!("    12    CONS\n END12{card}\n"))
    };
    says(&held("DACF         1"), "deck 12 CONS, DACF, columns 11-15: this field is blank");
    says(&held("DACF   -1    1"), "deck 12, DACF, columns 11-15: -1 is no structure");
    says(&held("DACF    2    1"), "deck 12, DACF: structure 2 is not in deck 2");
    says(&held("FDOF             1"), "deck 12 CONS, FDOF, columns 16-20: this field is blank");
    let whole = floating(
        &moored_deck("LIBR", 100.0, &LINE.replacen("    14", " END14", 1), STILL),
        ["3.0E7", "1.0E10", "1.0E10"],
    );
    says(&whole.replace("9.81E7", "      "), "deck 7 WFS1, BFEQ, columns 21-30: this field is blank");
    says(&whole.replace("9.81E7", "   0.0"), "deck 7, BFEQ, columns 21-30: 0 does not bear a structure");
    says(
        &whole.replace("9.81E7", " 9.0E7"),
        "deck 7, BFEQ, columns 21-30: 90000000 is not the weight of structure 1, 9.81000E7",
    );
    says(
        &whole.replace("07ZCGE                 0.0", "07ZCGE                    "),
        "deck 7 WFS1, ZCGE, columns 21-30: this field is blank",
    );
    says(
        &whole.replace("     3.0E7", "    -3.0E7"),
        "deck 7, LSTF, row 3, columns 41-50: a stiffness in heave of -30000000 is below 0",
    );
    let card = |cards: &str| moored_deck("LIBR", 100.0, cards, STILL);
    says(&card(" END14LINE    1    2    0   12     1.0E5\n"), "deck 14 MOOR, LINE, columns 41-50: this field is blank");
    says(
        &card("    14POLY                         1.0E5\n END14NLIN    1    2    0   12\n"),
        "deck 14, NLIN, columns 41-50: this field is blank",
    );
    says(
        &card("    14POLY\n END14NLIN    1    2    0   12               540.0\n"),
        "deck 14, POLY, columns 31-80: all coefficients are 0",
    );
    says(&card(" END14FORC    1    2    0   12\n"), "deck 14 MOOR, FORC, columns 31-40: this field is blank");
}

#[test]
fn card_behind_the_lines_it_serves_is_refused() {
    let card = |cards: &str| moored_deck("LIBR", 100.0, cards, STILL);
    let poly = "14POLY                         1.0E5\n";
    let nlin = "14NLIN    1    2    0   12               540.0\n";
    says(&card(&format!("    {nlin} END{poly}")), "deck 14, NLIN: no property comes before this line");
    let unused = "deck 14, POLY: no NLIN, NLID or FLIN card follows that it would serve";
    says(&card(&format!("    {poly}    {nlin} END{poly}")), unused);
    says(
        &card(&format!("    {poly}    14COMP                   1\n{SECTION} END14NLIN    1    2    0   12\n")),
        unused,
    );
    says(
        &card(" END14LNDW    1    2    0   12     2.0E5     540.0     530.0     -0.05\n")
            .replace(" END14LNDW", "    14LNDW")
            .replace("     -0.05\n", "     -0.05\n END14DWT0                           4.0\n"),
        "deck 14, DWT0: no LNDW card follows that it would serve",
    );
}

/// Force of a current of 1 m/s along X on the fairlead of a dynamic line straight down from it (N), with this ECAH card.
fn drag_at_fairlead(card: &str) -> f64 {
    // neutrally buoyant, 89.9 m for 90 m: taut
    let section = "    14ECAT                         102.5       0.1     5.0E8     5.0E7      89.9\n";
    let cards = format!("    14COMP                   1\n{section}{card} END14NLID    1    2    0   14\n");
    let deck = with_nodes(&moored_deck("LIBR", 100.0, &cards, STILL), &[(14, [0.0, 0.0, -100.0])])
        .replace("    11    NONE\n", "    11    ENVR\n END11CURR       1.0       0.0\n");
    let (session, _) = run("drag.dat", &hold_structure(&deck));
    let model = &session.job.model;
    let system = System::new(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    all.iter().find(|one| one.connector.is_some()).unwrap().load.wrench[0]
}

#[test]
fn blank_coefficients_of_ecah_have_their_defaults_in_drag() {
    // half of 1/2 rho Cd De V2 L on a taut line without weight: rho = 1025, De = 0.3, L = 90, and Cd = 1.0 where it is blank or 0, as without ECAH
    let drag = |cd: f64, diameter: f64| 0.25 * 1025.0 * cd * diameter * 90.0;
    let card = |cd: &str, diameter: &str| format!("    14ECAH{:>40}{cd:>10}{diameter:>10}\n", "");
    let share = 5e-3;
    let near = |got: f64, want: f64| assert!((got / want - 1.0).abs() < share, "{got} is not {want}");
    near(drag_at_fairlead(&card("", "0.3")), drag(1.0, 0.3));
    near(drag_at_fairlead(&card("0.0", "0.3")), drag(1.0, 0.3));
    near(drag_at_fairlead(&card("1.5", "0.3")), drag(1.5, 0.3));
    // without De that of the area, 0.1 m2
    near(drag_at_fairlead(""), drag(1.0, (0.4 / std::f64::consts::PI).sqrt()));
    let deck = |card: &str| {
        let cards = format!("    14COMP                   1\n{SECTION}{card} END14NLIN    1    2    0   12\n");
        moored_deck("LIBR", 100.0, &cards, STILL)
    };
    says(&deck(&card("", "0.3")), "deck 14 MOOR, ECAH, columns 51-60: this field is blank: the default holds, 1.0");
    says(&deck(&card("", "0.3")), "deck 14 MOOR, ECAH, columns 71-80: this field is blank: the default holds, 0.025");
    says(&deck(&card("1.0", "-0.3")), "deck 14 MOOR, ECAH, columns 61-70: -0.3 is below 0");
    says(&deck("    14ECAB                          -5.0\n"), "deck 14 MOOR, ECAB, columns 31-40: -5.0 is below 0");
}

#[test]
fn hull_without_current_coefficients_is_named() {
    let deck = moored_deck("LIBR", 100.0, " END14FORC    1    2    0   12     1.0E6\n", STILL)
        .replace("    11    NONE\n", "    11    ENVR\n END11CURR       1.0      30.0\n");
    says(
        &deck,
        "deck 11, CURR: no load of the current acts on structure 1: it has no tubes, and the hull coefficients of deck 10 (CUFX) are not read; \
         INMODEL -AQWA reads the model of the deck, and #TABLE gives it coefficients",
    );
}

#[test]
fn file_without_drift_or_of_another_depth_is_named_at_its_card() {
    let sea = "    13    SPEC\n END13PSMZ                 0.3       2.0       3.0       6.0\n";
    let drift = "no wave drift acts on S1: tests/data/hemisphere/hemisphere.AH1 has no drift coefficients; -DRIFT NONE of DATABASE accepts that";
    let depth = "the coefficients of S1 are of another depth of water: tests/data/hemisphere/hemisphere.AH1 has 1000 m, the environment 100 m";
    let warnings = |deck: &str| {
        let (mut session, _, _folder) = common::session();
        session.open_job("hull.dat", deck.replace("16TIME       101", "16TIME         3"));
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        session.reports.iter().map(|report| report.message.clone()).collect::<Vec<_>>()
    };
    let card = |text: &str| format!("deck 7, FILE: {text}");
    let list = warnings(&hemisphere("DRIF", &BUT_HEAVE, sea));
    assert!(list.contains(&card(drift)) && list.contains(&card(depth)), "{list:#?}");
    // the depth of the file, and no waves
    let list = warnings(&hemisphere("NAUT", &BUT_HEAVE, STILL).replace("DPTH     100.0", "DPTH    1000.0"));
    assert!(!list.iter().any(|message| message.contains("drift") || message.contains("depth")), "{list:#?}");
}

#[test]
fn deck_18_prints_structure_nodes_and_lines_at_its_steps() {
    let lines = format!("    14COMP                   1\n{SECTION} END14NLIN    1    2    0   12\n");
    let cards = "    18PREV   10\n    18NODE    1    2\n    18NOPR    1   15\n    18TSTS    2\n END18PTEN    1\n";
    let deck = hold_structure(&printing(&moored_deck("NAUT", 100.0, &lines, STILL), cards))
        .replace("16TIME       101", "16TIME        21");
    let (mut session, screen, _folder) = common::session();
    session.open_job("print.dat", deck.clone());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let text = screen.text();
    let rows = |title: &str| {
        let page = text.split(title).nth(1).unwrap().split("+++").nth(1).unwrap();
        let row = |line: &str| line.split_whitespace().filter_map(|word| word.parse().ok()).collect::<Vec<f64>>();
        page.lines().map(row).filter(|row| row.len() > 5).collect::<Vec<_>>()
    };
    let times = |rows: &[Vec<f64>]| rows.iter().map(|row| row[0]).collect::<Vec<_>>();
    assert_eq!(times(&rows("T R A J E C T O R Y")), [0.0, 1.0, 2.0]);
    let node = rows("P O I N T S");
    assert_eq!(times(&node), [0.0, 1.0, 2.0]);
    assert_eq!(&node[2][1..4], [0.0, 0.0, -10.0]);
    // 135.470 and 211.989 kN of the catenary on the bottom, its tension sqrt of the sum of squares
    let force = rows("C O N N E C T O R");
    let of_run = force.iter().filter(|row| row[1] == 135.47).collect::<Vec<_>>();
    assert_eq!(of_run.len(), 3, "{force:?}");
    assert_eq!(&of_run[2][..5], [2.0, 135.47, 0.0, -211.99, 251.58]);
    says(&deck, "deck 18, TSTS, columns 11-15: is of tethers, and the deck has none");
    says(
        &deck,
        "deck 18, NOPR, columns 16-20: parameter 15 is a row of the pages of structures with tethers; the tables of this job have none of these rows",
    );
    let still = printing(&moored_deck("LIBR", 100.0, &lines, STILL), cards);
    says(&still, "deck 18, PREV, columns 11-15: is of runs in time, DRIF and NAUT");
    says(
        &still,
        "deck 18, NODE, columns 16-20: the node is printed where it starts; its motion is of runs in time, DRIF and NAUT",
    );
}

#[test]
fn fer_job_off_its_equilibrium_or_with_dacf_is_named() {
    let deck = hemisphere("FER ", &BUT_HEAVE, STILL);
    says(
        &deck,
        "deck 12, DACF, columns 16-20: the degree of freedom is held here; the card has no effect in AQWA-FER [AQWA-REF DACF]",
    );
    // 1 MN down the line at the place of deck 15, which is taken as given [AQWA-THEORY: imported or directly defined by the user]
    let (mut session, screen, _folder) = common::session();
    session.open_job("hull.dat", deck);
    session.run();
    assert!(screen.text().contains("S1 is not at rest where the motions are taken about: &EQUI"), "{}", screen.text());
}
