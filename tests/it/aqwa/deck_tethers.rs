//! The cards of an installed tether against closed forms: what each card gives is a force, a place or an instant of the run of its deck.
//!
//! One tube of 200 m, neutral in water, stands upright under a vessel that its mass and stiffness hold still. Ends are pinned. In a uniform current
//! it is a beam under tension, `EI w'''' - T w'' = q`, solved span by span: `w = -q x2/(2T) + A + B x + C cosh kx + D sinh kx`, `k2 = T/EI`.

use super::aqwa_decks::{file, listing, number, run, tethered_run};
use crate::common;
use nalgebra::{Matrix4, SMatrix, SVector};
use std::f64::consts::PI;
use windlass::session::Session;
use windlass_tether::installed::RigChange;

const OUTER: f64 = 1.1176;
const WALL: f64 = 0.038;
const MODULUS: f64 = 2.15e11;
const WATER: f64 = 1025.0;
const GRAVITY: f64 = 9.81;
const LENGTH: f64 = 200.0;
/// Columns of the force of the tethers on the structure along X and Z.
const PULL_X: usize = 60;
const PULL_Z: usize = 62;
/// Force along X at a current of 1 m/s on each metre (N/m).
const DRAG: f64 = 0.5 * WATER * 0.75 * OUTER;

/// What a deck of the tether is made of.
struct DeckCase<'a> {
    /// Cards between the TELM cards and TETH.
    cards: &'a str,
    /// A card behind the fifth TELM card: between the elements that meet in the middle.
    middle: &'a str,
    /// Height of the vessel above that at which the tether is as long as it is unstretched (m).
    raised: f64,
    /// Buoyancy of the vessel over its weight.
    afloat: f64,
    current: bool,
    steps: (usize, f64),
    /// Cards of deck 18 but PTEN.
    printing: &'a str,
}

/// Deflection and its derivatives at a place of a span: by its four constants, and what its load gives.
type SpanRows = (Matrix4<f64>, [f64; 4]);

/// A derivative at a place of a span, with its sign.
type SpanTerm<'a> = (usize, &'a SpanRows, usize, f64);

impl Default for DeckCase<'_> {
    fn default() -> Self {
        DeckCase {
            cards: "",
            middle: "",
            raised: 0.2,
            afloat: 1.0,
            current: false,
            steps: (2, 0.1),
            printing: "    18PREV 1000\n    18TPRV 1000\n",
        }
    }
}

/// The deck: kN, t, m.
fn deck(case: &DeckCase<'_>) -> String {
    let none = |decks: std::ops::RangeInclusive<u8>| decks.map(|n| format!("    {n:02}    NONE\n")).collect::<String>();
    let elements: Vec<String> =
        (101..111).map(|node| format!("    14TELM {node:4} {:4}    2    2\n", node + 1)).collect();
    let (lower, upper) = elements.split_at(5);
    // a vessel that falls has no stiffness against it
    let heave = if case.afloat == 1.0 { "    1.0E12" } else { "" };
    let current = if case.current { "    11    ENVR\n END11CURR       1.0       0.0\n" } else { "    11    NONE\n" };
    format!(
        "JOB PULL  NAUT\nTITLE               One tether\nOPTIONS LSTF END\n\
        \x20   01    COOR\n    01   1                 0.0       0.0       0.0\n    01   2                 0.0       0.0     -50.0\n\
        \x20   01   9                 0.0       0.0    -250.0\n\
        \x20END01 101   11    1       0.0       0.0    -250.0       0.0       0.0      20.0\n\
        \x20   02    ELM1\n END02PMAS           (1) (1) (1) (1)\n    02    FINI\n\
        \x20   03    MATE\n    03             1    1.0E12\n END03             2   7.81694    2.15E8\n\
        \x20   04    GEOM\n    04PMAS         1    1.0E12       0.0       0.0    1.0E12       0.0    1.0E12\n\
        \x20   04TUBE         2    1.1176   0.03800       0.0     0.000     0.000\n END04CONT                0.75       1.0\n\
        \x20   05    GLOB\n    05DPTH    345.00\n    05DENS     1.025\n END05ACCG     9.810\n    06    NONE\n\
        \x20   07    WFS1\n    07LSTF         3                    {heave}\n    07LSTF         4                                  1.0E12\n\
        \x20   07LSTF         5                                            1.0E12\n\
        \x20   07LSTF         6                                                      1.0E12\n\
        \x20   07BFEQ          {buoyancy:10.5E}\n END07ZCGE          {raised:10.4}\n{none8}{current}{none12}\
        \x20   14    MOOR\n{lower}{middle}{upper}\
        \x20   14TSPA                           0.0       0.0       0.0\n    14TSPV                           0.0       0.0       0.0\n{cards}\
        \x20END14TETH    1    2    0    9\n\
        \x20   15    STRT\n END15POS1                 0.0       0.0{raised:10.4}       0.0       0.0       0.0\n\
        \x20   16    TINT\n END16TIME     {steps:5}{dt:10.4}\n    17    NONE\n\
        \x20   18    PROP\n{printing} END18PTEN    1\n{none19}",
        buoyancy = 9.81e12 * case.afloat,
        raised = case.raised,
        none8 = none(8..=10),
        none12 = none(12..=13),
        lower = lower.concat(),
        middle = case.middle,
        upper = upper.concat(),
        cards = case.cards,
        steps = case.steps.0,
        dt = case.steps.1,
        printing = case.printing,
        none19 = none(19..=20),
    )
}

fn bore() -> f64 {
    OUTER - 2.0 * WALL
}

fn circle(diameter: f64) -> f64 {
    0.25 * PI * diameter * diameter
}

fn steel() -> f64 {
    circle(OUTER) - circle(bore())
}

/// Weight of the tether in water with what is inside it (N).
fn weight(contents: f64) -> f64 {
    (7816.94 * steel() + contents * circle(bore()) - WATER * circle(OUTER)) * GRAVITY * LENGTH
}

/// Effective tension in the middle when the vessel is raised by so much, with a pressure and density inside (N).
fn tension(raised: f64, [pressure, density]: [f64; 2]) -> f64 {
    let depth = 250.0 - 0.5 * (LENGTH + raised);
    MODULUS * steel() * raised / LENGTH + WATER * GRAVITY * depth * circle(OUTER)
        - (pressure + density * GRAVITY * depth) * circle(bore())
}

fn assert_near(got: f64, want: f64, share: f64) {
    assert!((got / want - 1.0).abs() < share, "{got} is not {want}");
}

#[test]
fn tcap_and_tifl_enter_pull_of_tether_on_vessel() {
    let cards =
        "    14TCAP                           0.3       0.4\n    14TIFL                        2000.0      0.85\n";
    let (session, _) = run("pull.dat", &deck(&DeckCase { cards, raised: 0.05, ..DeckCase::default() }));
    let made = tethered_run(&session);
    // the end at the vessel is 49.95 m deep
    let (out, inside) = (WATER * GRAVITY * 49.95, 2e6 + 850.0 * GRAVITY * 49.95);
    let upper = tension(0.05, [2e6, 850.0]) + 0.5 * weight(850.0);
    let tether = &made.tethers[0];
    // 1e15 kN/m of the springs that are not given, over EA/L
    assert_near(tether.end_at(0, 19, 0).unwrap(), upper, 1e-6);
    assert_near(tether.end_at(0, 19, 1).unwrap(), upper - out * circle(OUTER) + inside * circle(bore()), 1e-6);
    assert_near(made.structure.as_ref().unwrap().value(0, PULL_Z).unwrap(), -(upper - out * 0.4), 1e-6);
    // neither card: the pull is the effective tension
    let (session, _) = run("pull.dat", &deck(&DeckCase { raised: 0.05, ..DeckCase::default() }));
    let bare = tension(0.05, [0.0, 0.0]) + 0.5 * weight(0.0);
    assert_near(tethered_run(&session).structure.as_ref().unwrap().value(0, PULL_Z).unwrap(), -bare, 1e-6);
}

#[test]
fn tlow_stop_catches_tether_after_its_distance() {
    // the vessel is lighter by 0.02 m/s2 of its weight: after t it has fallen by 0.01 t2
    let fall = |cards: &str| {
        let case =
            DeckCase { cards, raised: 0.0, afloat: 1.0 - 0.02 / GRAVITY, steps: (201, 0.05), ..DeckCase::default() };
        run("pull.dat", &deck(&case)).0
    };
    // 150 m under water it is shorter by p A L/EA, and falls by the distance of the stop from there on
    let ea = MODULUS * steel();
    let short = WATER * GRAVITY * 150.0 * circle(OUTER) * LENGTH / ea;
    let last = |session: &Session| {
        let structure = tethered_run(session).structure.as_ref().unwrap().series(PULL_Z);
        *structure.last().unwrap()
    };
    let stopped = fall("    14TLOW                           0.5\n");
    let hit = tethered_run(&stopped).happened.iter().find(|e| matches!(e.change, RigChange::LowerStop { .. })).unwrap();
    // an instant of 0.05 s on either side
    assert!((hit.time - ((0.5 + short) / 0.01).sqrt()).abs() < 0.1, "{hit:?}");
    // at 10 s it is 1 m down, and half of it is below the stop
    assert_near(last(&stopped) / (ea / LENGTH), 0.5 - short, 2e-3);
    let free = fall("    14TLOW                           2.0\n");
    assert!(tethered_run(&free).happened.iter().all(|e| !matches!(e.change, RigChange::LowerStop { .. })));
    assert_near(last(&free), -weight(0.0), 1e-9);
}

/// What a middle support holds.
#[derive(Clone, Copy)]
enum BowSupport {
    None,
    /// The place, to this deflection.
    Place(f64),
    /// The slope.
    Slope,
}

/// Deflection at a place, slope at the top and force on the support, of a beam of a tension with a support at `first`.
struct Bowed {
    deflection: f64,
    top: f64,
    push: f64,
}

fn bow(pull: f64, [first, position, whole]: [f64; 3], support: BowSupport) -> Bowed {
    let inertia = PI / 64.0 * (OUTER.powi(4) - bore().powi(4));
    let ei = MODULUS * inertia;
    let k = (pull / ei).sqrt();
    // place, slope, second and third derivative at a distance, as a row over A, B, C, D and what the load adds
    let rows = |x: f64| {
        let (c, s) = ((k * x).cosh(), (k * x).sinh());
        let m = Matrix4::new(
            1.0,
            x,
            c,
            s, //
            0.0,
            1.0,
            k * s,
            k * c, //
            0.0,
            0.0,
            k * k * c,
            k * k * s, //
            0.0,
            0.0,
            k.powi(3) * s,
            k.powi(3) * c,
        );
        (m, [-DRAG * x * x / (2.0 * pull), -DRAG * x / pull, -DRAG / pull, 0.0])
    };
    let (start, middle, end) = (rows(0.0), rows(first), rows(whole - first));
    let mut system = SMatrix::<f64, 8, 8>::zeros();
    let mut right = SVector::<f64, 8>::zeros();
    let mut row = 0;
    // one condition: derivatives of the spans with their signs, and the value of the sum
    let mut add = |terms: &[SpanTerm], value: f64| {
        right[row] = value;
        for (span, at, derivative, sign) in terms {
            for i in 0..4 {
                system[(row, 4 * span + i)] += sign * at.0[(*derivative, i)];
            }
            right[row] -= sign * at.1[*derivative];
        }
        row += 1;
    };
    for derivative in [0, 2] {
        add(&[(0, &start, derivative, 1.0)], 0.0);
        add(&[(1, &end, derivative, 1.0)], 0.0);
    }
    let (free, held): (&[usize], Option<(usize, f64)>) = match support {
        BowSupport::None => (&[0, 1, 2, 3], None),
        BowSupport::Place(at) => (&[0, 1, 2], Some((0, at))),
        BowSupport::Slope => (&[0, 1, 3], Some((1, 0.0))),
    };
    for derivative in free {
        add(&[(0, &middle, *derivative, 1.0), (1, &start, *derivative, -1.0)], 0.0);
    }
    if let Some((derivative, value)) = held {
        add(&[(0, &middle, derivative, 1.0)], value);
    }
    let found = system.lu().solve(&right).unwrap();
    let value = |span: usize, at: &SpanRows, derivative: usize| {
        (0..4).map(|i| at.0[(derivative, i)] * found[4 * span + i]).sum::<f64>() + at.1[derivative]
    };
    let (span, behind) = if position < first { (0, position) } else { (1, position - first) };
    Bowed {
        deflection: value(span, &rows(behind), 0),
        top: value(1, &end, 1),
        push: ei * (value(0, &middle, 3) - value(1, &start, 3)),
    }
}

/// The run of a tether in a current of 1 m/s towards +X for 100 s, which the drag brings to rest.
fn in_current(cards: &str, middle: &str) -> Session {
    let case = DeckCase { cards, middle, current: true, steps: (1001, 0.1), ..DeckCase::default() };
    run("pull.dat", &deck(&case)).0
}

/// Deflection of a node, from 0 at the anchor, at the end of a run.
fn deflection(session: &Session, node: usize) -> f64 {
    *tethered_run(session).tethers[0].node(node, 0).last().unwrap()
}

/// Force along X of the tether on the structure at the end of a run.
fn push(session: &Session) -> f64 {
    *tethered_run(session).structure.as_ref().unwrap().series(PULL_X).last().unwrap()
}

/// A bow of the tether with a support at a distance, at the place of a node 20 m times its number up.
fn bow_at(distance: f64, node: u8, support: BowSupport) -> Bowed {
    let stretched = [distance, 20.0 * f64::from(node), LENGTH].map(|x| x * (LENGTH + 0.2) / LENGTH);
    bow(tension(0.2, [0.0, 0.0]), stretched, support)
}

#[test]
fn lateral_and_rotational_constraints_bow_tether_as_a_beam() {
    let pull = tension(0.2, [0.0, 0.0]);
    for (cards, middle, distance, support) in [
        ("", "", 100.0, BowSupport::None),
        // between two TELM cards: the node between them
        ("", "    14TLAC\n", 100.0, BowSupport::Place(0.0)),
        ("", "    14TLAV\n", 100.0, BowSupport::Place(0.0)),
        // behind them: the node next to the anchor, or to the vessel
        ("    14TLAC\n", "", 20.0, BowSupport::Place(0.0)),
        ("    14TLAV\n", "", 180.0, BowSupport::Place(0.0)),
        ("    14TROC\n", "", 20.0, BowSupport::Slope),
        ("    14TROV\n", "", 180.0, BowSupport::Slope),
    ] {
        let session = in_current(cards, middle);
        for node in [3, 5, 7] {
            let want = bow_at(distance, node, support).deflection;
            let got = deflection(&session, usize::from(node));
            // cubic elements of k L = 1.7, and a stretch of the bow of 1E-5 of the length
            assert!((got - want).abs() < 2e-3 * 0.0775, "{cards}{middle} {node}: {got} is not {want}");
        }
        let Bowed { top, push: support, .. } = bow_at(distance, 5, support);
        let of_vessel =
            if (cards, middle) == ("", "") || !format!("{cards}{middle}").contains("TLAV") { 0.0 } else { support };
        // the program has the slope of the tension alone on the structure; a slope of one element is off by more than a place
        assert_near(push(&session), of_vessel - top * pull, 4e-3);
    }
}

#[test]
fn held_node_off_the_axis_takes_its_tension_at_a_quarter_second() {
    // the vessel stands 20 m off, the node in the middle over the anchor: T = EA (c - L + arc)/L + p A with the arc of ten cubic elements under
    // this tension, solved together in twenty digits: an arc of 1.0214 m and 308.77 MN, the top at 0.1037 rad from the axis
    let case = DeckCase { middle: "    14TLAC\n", steps: (401, 0.25), ..DeckCase::default() };
    let text = deck(&case).replace("END15POS1                 0.0", "END15POS1                20.0");
    let (session, _) = run("pull.dat", &text);
    let structure = tethered_run(&session).structure.as_ref().unwrap();
    assert_near(*structure.series(PULL_X).last().unwrap(), -62_553_927.07, 1e-3);
    assert_near(*structure.series(PULL_Z).last().unwrap(), -304_060_064.96, 1e-3);
}

#[test]
fn installed_example_runs_with_held_nodes_at_its_own_step() {
    let text = file("mint.dat");
    let of = |card: &str, step: usize| {
        let with = text.replace("    14TEGR    4\n", &format!("    14TEGR    4\n    14{card}\n"));
        let count = 100 * step + 1;
        let with = with
            .replace("END16TIME       101     0.250", &format!("END16TIME     {count:5}{:10.3}", 0.25 / step as f64));
        let (session, _) = run("mint.dat", &with);
        let made = tethered_run(&session);
        // surge and heave after 5 s
        [0, 2].map(|dof| made.structure.as_ref().unwrap().value(20 * step, dof).unwrap())
    };
    for card in ["TLAC", "TLAV"] {
        let (whole, tenth) = (of(card, 1), of(card, 10));
        // a quarter of a second is coarse for a held node: 0.35 m of surge and 0.9 m of heave off, where half the step is off by 0.2 and 0.4 m
        let off = [0, 1].map(|dof| (whole[dof] - tenth[dof]).abs());
        assert!(off[0] < 0.4 && off[1] < 1.0, "{card}: {whole:?} {tenth:?}");
    }
}

#[test]
fn tlav_gap_lets_tether_move_and_holds_it_there() {
    let free = bow_at(100.0, 5, BowSupport::None);
    let pull = tension(0.2, [0.0, 0.0]);
    // wider than the tether bows: nothing touches
    let wide = in_current("", "    14TLAV                         0.100\n");
    assert_near(deflection(&wide, 5), free.deflection, 2e-3);
    assert_near(push(&wide), -free.top * pull, 4e-3);
    let narrow = in_current("", "    14TLAV                         0.030\n");
    // the edge is as soft as the step asks for: it gives way by 0.9 mm
    let at = deflection(&narrow, 5);
    assert!((0.03..0.031).contains(&at), "{at}");
    let want = bow_at(100.0, 5, BowSupport::Place(at));
    assert_near(push(&narrow), want.push - want.top * pull, 4e-3);
}

/// Times on the pages of what a session printed of a tether: those of the rows that begin with a step, a time and a node.
fn printed_times(text: &str, tether: &str) -> Vec<String> {
    let head = format!("T I M E   H I S T O R Y   O F   S I N G L E   T E T H E R   {tether} ");
    let mut times: Vec<String> = Vec::new();
    for page in text.split(&head).skip(1) {
        let page = page.split("+++").nth(1).unwrap();
        let rows = page.lines().map(|line| line.split_whitespace().collect::<Vec<_>>());
        for row in rows.filter(|row| row.get(2) == Some(&"1") && row[1].contains('.')) {
            times.push(row[1].to_string());
        }
    }
    times
}

fn print_deck(name: &str, text: String) -> String {
    let (mut session, screen, _folder) = common::session();
    session.open_job(name, text);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    screen.text()
}

#[test]
fn tprv_prints_tethers_at_first_step_and_every_n_after() {
    // the listing of TPRV 500 at 0.25 s
    let towed = print_deck("he01_phases.dat", file("he01_phases.dat"));
    assert_eq!(printed_times(&towed, "T 1"), ["0.00", "125.00", "250.00", "375.00"]);
    // 22 steps of 0.1 s: 1, 6, 11, 16, 21
    let case = DeckCase { steps: (22, 0.1), printing: "    18TPRV    5\n", ..DeckCase::default() };
    assert_eq!(printed_times(&print_deck("pull.dat", deck(&case)), "T 1"), ["0.00", "0.50", "1.00", "1.50", "2.00"]);
}

#[test]
fn tether_of_structure_without_pten_is_not_printed() {
    let case = DeckCase { steps: (3, 0.1), printing: "    18TPRV    1\n", ..DeckCase::default() };
    let text = deck(&case);
    assert_eq!(printed_times(&print_deck("pull.dat", text.clone()), "T 1").len(), 3);
    let silent = print_deck("pull.dat", text.replace(" END18PTEN    1\n", " END18NODE    1    2\n"));
    assert!(printed_times(&silent, "T 1").is_empty());
    let none = print_deck("pull.dat", text.replace(" END18PTEN    1\n", " END18PTEN\n"));
    // a blank structure is all of them
    assert_eq!(printed_times(&none, "T 1").len(), 3);
}

#[test]
fn node_card_prints_place_of_node_as_listing() {
    let text = print_deck("mint.dat", file("mint.dat"));
    let pages: Vec<&str> =
        text.split("S T R U C T U R E   S 1 +++").filter(|page| page.contains("RECORD NO.")).collect();
    let states = listing("installed")["structure_history"].clone();
    let states = states.as_array().unwrap();
    assert_eq!((states.len(), pages.len()), (11, 11));
    for (state, page) in states.iter().zip(pages) {
        let time = number(&state["time"]);
        assert!(page.contains(&format!("= {time:.2} s")), "{page}");
        let row = page.lines().find(|line| line.starts_with(" POSITION *S1_112")).unwrap();
        for (axis, word) in row.split_whitespace().skip(2).enumerate() {
            let found: f64 = word.parse().unwrap();
            let off = (found - number(&state["POSITION NODE 112"][axis])).abs();
            // as positions of the structure, and the third decimal printed
            assert!(off < if time <= 5.0 { 9e-4 } else { 6.5e-3 }, "{axis} at {time} s: {off}");
        }
    }
}

#[test]
fn tslk_leaves_record_of_every_step() {
    let text = file("mint.dat").replace("16TIME       101", "16TIME        31");
    for text in [text.clone(), text.replace("    14TSLK                         0.001\n", "")] {
        let (session, _) = run("mint.dat", &text);
        let made = tethered_run(&session);
        // 31 steps of 0.25 s, of which TSLK prints one
        assert_eq!((made.times.len(), made.times.last()), (31, Some(&7.5)));
        assert!(made.tethers.iter().all(|tether| tether.node(1, 0).len() == 31));
    }
}

#[test]
fn current_of_deck_10_and_deck_11_bows_tether_equally() {
    let case = DeckCase { current: true, steps: (1001, 0.1), ..DeckCase::default() };
    let text = deck(&case).replace("    11    ENVR\n END11CURR       1.0       0.0\n", "    11    NONE\n");
    let text = text.replace("    10    NONE\n", "    10    HLD1\n END10CURR       1.0       0.0\n");
    let (session, _) = run("pull.dat", &text);
    assert_near(deflection(&session, 5), bow_at(100.0, 5, BowSupport::None).deflection, 2e-3);
}

/// The last column of the fatigue page: expected peaks.
fn printed_peaks(text: &str) -> Vec<f64> {
    let page = text.split("HR PK STRESS").nth(1).unwrap();
    let rows = page.lines().skip_while(|line| !line.starts_with("----")).skip(1).take(26);
    rows.map(|line| line.split_whitespace().last().unwrap().parse().unwrap()).collect()
}

#[test]
fn tpsh_hours_enter_expected_peak() {
    // 3.7: |mean| + rms sqrt(2 ln n), n the cycles of so many hours; the listing prints mean, twice the rms and cycles of an hour
    let listing: serde_json::Value =
        serde_json::from_str(&std::fs::read_to_string("tests/data/towed_tether_fatigue.json").unwrap()).unwrap();
    let field = |end: usize, name: &str| {
        let column = listing["fatigue_cols"].as_array().unwrap().iter().position(|c| c == name).unwrap();
        number(&listing["fatigue"][end][column])
    };
    let without = file("he01_phases.dat");
    let with = without.replace("    14TEIG    6\n", "    14TEIG    6\n    14TPSH                          48.0\n");
    for (text, hours) in [(without, 3.0), (with, 48.0)] {
        let peaks = printed_peaks(&print_deck("he01.dat", text));
        assert_eq!(peaks.len(), 26);
        for (end, peak) in peaks.into_iter().enumerate().filter(|(end, _)| field(*end, "pk3h") > 1e5) {
            let n: f64 = field(end, "cychr2") * hours;
            let want = field(end, "mean").abs() + 0.5 * field(end, "sig") * (2.0 * n.ln()).sqrt();
            // peaks are printed with three figures, and the run's own are within 1 % of the listing
            assert_near(peak, want, 0.01);
        }
    }
}

#[test]
fn half_the_step_keeps_printed_moments() {
    // chapter 4: a run with half the step has about the same bending moments. The listing is of 0.25 s.
    let text = file("he01_phases.dat").replace("16TIME      1501      0.25", "16TIME      1001     0.125");
    let (session, _) = run("he01.dat", &text);
    let made = tethered_run(&session);
    assert_eq!(made.times.last(), Some(&125.0));
    let printed = listing("towed");
    let moments = printed["history"]["125"]["nodal_forces"].as_object().unwrap();
    let last = made.times.len() - 1;
    for (node, forces) in moments {
        let node: usize = node.parse().unwrap();
        // the moment at a node is at the lower end of the element above it
        let end = (2 * (node - 1)).min(25);
        let (found, want) = (made.tethers[0].end_at(last, end, 2).unwrap() / 1e3, number(&forces["MY"]));
        // the largest, 2,271 kN m at node 5, within 5 %, the others within 12 % of it
        let share = if node == 5 { 0.05 } else { 0.12 };
        assert!((found - want).abs() < share * 2271.0, "node {node}: {found} for {want}");
    }
}

/// A towed tether of 5 m that floats half submerged, in a regular wave of 3 m along its axis in 60 m of water: kN, t, m.
fn towed_in_wave(theory: &str) -> String {
    let none = |decks: std::ops::RangeInclusive<u8>| decks.map(|n| format!("    {n:02}    NONE\n")).collect::<String>();
    format!(
        "JOB RIDE  NAUT\nTITLE               A short tether\nOPTIONS LSTF END\n\
        \x20   01    COOR\n    01   1    3    1       0.0       0.0       0.0       2.5       0.0       0.0\n\
        \x20   01 100                -5.0       0.0       0.0\n END01 999\n\
        \x20   02    ELM1\n END02PMAS           (1) (2) (2) (2)\n    02    FINI\n\
        \x20   03    MATE\n    03             1    6.5361    2.15E8\n END03             2     1.0E6\n\
        \x20   04    GEOM\n    04TUBE         1       1.0      0.02       0.0       0.0       0.0\n    04CONT                0.75       1.0\n\
        \x20END04PMAS         2     1.0E6       0.0       0.0     1.0E6       0.0     1.0E6\n\
        \x20   05    GLOB\n    05DPTH      60.0\n    05DENS     1.025\n END05ACCG      9.81\n    06    NONE\n\
        \x20   07    WFS1\n    07LSTF         3                         1.0E6\n    07BFEQ            9.81E6\n END07ZCGE                 0.0\n{}\
        \x20   13    WAVE\n{theory}    13WAMP                 3.0\n    13PERD                16.0\n END13WVDN                 0.0\n\
        \x20   14    MOOR\n    14TELM    1    2    1    1\n    14TELM    2    3    1    1\n\
        \x20   14TSPV    1                0.001     0.001     0.001\n    14TSPA    1                0.001     0.001     0.001\n\
        \x20END14TETH    1  999    0  100\n    15    NONE\n\
        \x20   16    TINT\n END16TIME      2561      0.05\n    17    NONE\n\
        \x20   18    PROP\n    18TPRV 2560\n END18PTEN    1\n{}",
        none(8..=12),
        none(19..=20)
    )
}

#[test]
fn towed_tether_of_naut_deck_rides_on_stokes_wave_of_second_order() {
    // the height of the second harmonic in water of this depth, k a^2 cosh kd (2 + cosh 2kd) / (4 sinh^3 kd) [DEAN-DALRYMPLE-1991 11.2]; 0.0707 m
    // in deep water
    let (number, want) = (0.019_205_302_8, 0.183_601_095);
    let second = |theory: &str| {
        let (session, _) = run("ride.dat", &towed_in_wave(theory));
        let made = tethered_run(&session);
        let heights = made.tethers[0].node(1, 1);
        // the last two of ten periods
        let rate = 2.0 * 2.0 * PI / 16.0;
        let harmonic =
            |of: fn(f64) -> f64| (1920..2560).map(|i| heights[i] * of(rate * made.times[i]) / 320.0).sum::<f64>();
        let [cos, sin] = [harmonic(f64::cos), harmonic(f64::sin)];
        // the middle is 2.5 m behind the origin, where the crest is at the start
        let (s, c) = (2.0 * number * -2.5f64).sin_cos();
        [cos * c + sin * s, sin * c - cos * s]
    };
    let ([with, across], without) = (second(""), second("    13AIRY\n"));
    // a heave of a period of 1.8 s is not at rest on waves of 8 s
    assert!((with - want).abs() < 0.05 * want && across.abs() < 0.05 * want, "{with} {across} {want}");
    assert!(without[0].hypot(without[1]) < 0.1 * want, "{without:?}");
}

#[test]
fn tethers_from_a_start_of_one_wave_period_move_as_from_zero() {
    // the wave of the example has a period of 15 s: the same wave, so the same motions, at times 15 s later
    let example = std::fs::read_to_string("scripts/mint.dat").unwrap();
    let later = example.replace("16TIME       101     0.250     0.000", "16TIME       101     0.250    15.000");
    let quarter = example.replace("16TIME       101     0.250     0.000", "16TIME       101     0.250     3.750");
    let motions = |deck: &str| {
        let (session, _) = run("mint.dat", deck);
        let made = session.job.tethered.as_ref().unwrap();
        let structure = made.structure.as_ref().unwrap();
        (made.times.clone(), structure.rows.clone(), structure.rows.len() / made.times.len())
    };
    let [first, second, third] = [&example, &later, &quarter].map(|deck| motions(deck));
    assert_eq!((second.0[0], second.0.last().copied(), second.0.len()), (15.0, Some(40.0), 101));
    assert_eq!(first.1.len(), second.1.len());
    let width = first.2;
    for (a, b) in first.1.chunks(width).zip(second.1.chunks(width)) {
        // place, velocity and acceleration, of some metres, radians and seconds: rounding of the phase
        assert!(a.iter().zip(b).take(18).all(|(a, b)| (a - b).abs() <= 1e-9), "{a:?} {b:?}");
    }
    // a quarter of a period on is another wave
    assert_ne!(first.1[..200], third.1[..200]);
}
