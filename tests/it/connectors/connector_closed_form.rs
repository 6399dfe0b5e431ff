//! `&CONNECTOR` against closed forms of catenaries and springs, and against the forces of the line it leaves.

use crate::common;

use windlass_base::units::{METRES_PER_FOOT, NEWTONS_PER_KIP};
use windlass_model::{Connector, LineLoads, Model};

/// What records leave: the model, what they print, the messages and their help.
struct Left {
    model: Model,
    text: String,
    messages: Vec<String>,
    help: Vec<String>,
}

fn run(records: &str) -> Left {
    let (mut session, screen, _folder) = common::session();
    session.job.settings.error_limit = i64::MAX;
    session.open("records", records.to_string());
    session.run();
    session.job.output.flush();
    let text = screen.text();
    // bare diameters and springs without weight are said to be so where their classes are made
    let of_a_class =
        |m: &str| ["solid steel bar", "has no weight", "is weightless"].iter().any(|note| m.contains(note));
    session.reports.retain(|r| !of_a_class(&r.message));
    let messages = session.reports.iter().map(|r| r.message.clone()).collect();
    let help = session.reports.iter().flat_map(|r| r.help.clone()).collect();
    Left { model: session.job.model.clone(), text, messages, help }
}

/// Records that must draw no message, but that a line sees neither bottom nor surface.
fn clean(records: &str) -> Left {
    let left = run(records);
    let known = |m: &String| m.ends_with("which it does not see");
    assert!(left.messages.iter().all(known), "{records}: {:?}", left.messages);
    left
}

impl Left {
    fn connector(&self, name: &str) -> &Connector {
        &self.model.connectors[name]
    }

    fn loads(&self, name: &str) -> LineLoads {
        let connector = self.connector(name);
        let class = &self.model.classes[&connector.class.to_ascii_uppercase()];
        class.line(&self.model.placement(connector), &self.model.surroundings()).unwrap().loads().unwrap()
    }

    /// Lines printed about connectors.
    fn printed_lines(&self) -> Vec<&str> {
        self.text.lines().filter(|l| l.starts_with("connector ")).collect()
    }
}

fn close(got: f64, want: f64, share: f64) {
    assert!((got - want).abs() <= share * want.abs(), "{got} is not {want}");
}

/// A barge 11 ft above the water, and lines of every class toward 30 degrees.
const LINES: &str = "MEDIT\n&DESCRIBE BODY TBRG\n*P 400 50 11\n*Q 0 -50 11\n\
    ~BOTTOM B_CAT 4.19 EXACT -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
    ~ROUGH B_CAT 4.19 EXACT -DEP 500 -LEN 1500 -BUOY 0 -WTPL .0125 -CLUMP 10 -FRICTION 0.5\n\
    ~ROUGH B_CAT 4.19 -LEN 2500 -BUOY 0 -WTPL .0350\n\
    ~SLOPED B_CAT 4.19 EXACT -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125 -SLOPE 0.02\n\
    ~BUOYED B_CAT 4.19 EXACT -DEP 500 -LEN 1200 -BUOY 0 -WTPL .0125 -CLUMP -20 40\n\
    ~BUOYED B_CAT 4.19 -LEN 2800 -BUOY 0 -WTPL .0125\n\
    ~SPRUNG B_CAT 4.19 EXACT -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125 -SEND 40 90\n\
    ~HANG H_CAT 4.19 EXACT -LEN 4000\n\
    ~CHORD H_CAT 4.19 -LEN 4000\n\
    ~PULLS SL_ELEM 4.19 TENSION -LEN 3000 -SEND 50 80\n~PULLS SL_ELEM 4 -LEN 1000\n\
    ~AQWA CATENARY 170 0.02 -LEN 1200\n\
    CONNECTOR BOTTOM -ANC 30 3950 ~BOTTOM *P\nCONNECTOR ROUGH -ANC 30 3950 ~ROUGH *P\n\
    CONNECTOR SLOPED -ANC 30 3950 ~SLOPED *P\nCONNECTOR BUOYED -ANC 30 3950 ~BUOYED *P\n\
    CONNECTOR SPRUNG -ANC 30 3950 ~SPRUNG *P\n\
    CONNECTOR HANG -ANC 30 3950 ~HANG *P\nCONNECTOR CHORD -ANC 30 3950 ~CHORD *P\n\
    CONNECTOR PULLS -ANC 30 3950 ~PULLS *P\nCONNECTOR AQWA -ANC 30 3900 ~AQWA *P\nEND\n&ENV -DEPTH 500\n";

const NAMES: [&str; 9] = ["BOTTOM", "ROUGH", "SLOPED", "BUOYED", "SPRUNG", "HANG", "CHORD", "PULLS", "AQWA"];

#[test]
fn solving_option_gives_requested_force_in_every_line_class() {
    for option in ["-L_HORIZONTAL", "-L_TENSION", "-A_HORIZONTAL", "-A_TENSION"] {
        for name in NAMES {
            let left = clean(&format!("{LINES}&CONNECTOR {name} {option} 160\n"));
            let loads = left.loads(name);
            assert!(["exact", "weightless"].contains(&loads.solution), "{}", loads.solution);
            let [x, y, _] = loads.fairlead;
            let got = if option.ends_with("TENSION") { loads.tension } else { x.hypot(y) };
            close(got / NEWTONS_PER_KIP, 160.0, 1e-8);
            // the line pulls toward 30 degrees as before
            close(y.atan2(x).to_degrees(), 30.0, 1e-9);
            let made = left.connector(name);
            assert_eq!(made.first_length.is_some(), option.starts_with("-L"), "{option} of {name}");
            let anchor = made.anchor.unwrap();
            close(anchor.direction.to_degrees(), 30.0, 1e-12);
            close(
                (anchor.at[0] - 400.0 * METRES_PER_FOOT).hypot(anchor.at[1] - 50.0 * METRES_PER_FOOT),
                anchor.distance,
                1e-12,
            );
            assert_eq!(left.printed_lines().len(), 1, "{}", left.text);
            assert!(left.text.contains("160.00 kips"), "{}", left.text);
        }
    }
}

/// A line that hardly stretches: w = 0.0125 kips/ft, 511 ft from the bottom to the fairlead.
const STIFF: &str = "MEDIT\n&DESCRIBE BODY TBRG\n*P 0 0 11\n\
    ~W B_CAT 4.19 EXACT -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125 -EMOD 1E12\nCONNECTOR A -ANC 0 3950 ~W *P\nEND\n";
const W: f64 = 0.0125;
const H: f64 = 511.0;

/// Suspended length less its horizontal reach (ft), at a horizontal force (kips): s - x of the inelastic catenary.
fn spare(force: f64) -> f64 {
    let suspended = H * (1.0 + 2.0 * force / (W * H)).sqrt();
    suspended - force / W * (1.0 + W * H / force).acosh()
}

#[test]
fn anchor_position_matches_inelastic_catenary() {
    for force in [10.0, 50.0, 150.0] {
        for (option, value) in [("-A_HORIZONTAL", force), ("-A_TENSION", force + W * H)] {
            let left = clean(&format!("{STIFF}&CONNECTOR A {option} {value}\n"));
            close(left.connector("A").anchor.unwrap().distance / METRES_PER_FOOT, 4000.0 - spare(force), 1e-9);
        }
    }
}

#[test]
fn first_segment_length_matches_inelastic_catenary() {
    for force in [10.0, 50.0, 150.0] {
        for (option, value) in [("-L_HORIZONTAL", force), ("-L_TENSION", force + W * H)] {
            let left = clean(&format!("{STIFF}&CONNECTOR A {option} {value}\n"));
            close(left.connector("A").first_length.unwrap() / METRES_PER_FOOT, 3950.0 + spare(force), 1e-9);
        }
    }
}

#[test]
fn multi_point_sample_anchors_match_elastic_catenary() {
    let script = std::fs::read_to_string("scripts/mooring.cif").unwrap();
    let (head, _) = script.split_once("&STATUS G_CONNECTOR").unwrap();
    let left = clean(head);
    assert_eq!(left.model.connectors.len(), 8);
    // kips and feet: T 40 at the fairlead 511 ft above the bottom, V = w s; the height fixes V
    let (tension, ea) = (40.0_f64, 29000.0 * std::f64::consts::PI / 4.0 * 4.19 * 4.19);
    let horizontal = |v: f64| (tension * tension - v * v).sqrt();
    let height = |v: f64| (tension - horizontal(v)) / W + v * v / (2.0 * W * ea);
    let (mut low, mut high) = (0.0, tension);
    for _ in 0..100 {
        let middle = 0.5 * (low + high);
        if height(middle) < H { low = middle } else { high = middle }
    }
    let (h, s) = (horizontal(low), low / W);
    let want = (4000.0 - s) * (1.0 + h / ea) + h / W * (low / h).asinh() + h * s / ea;
    for connector in left.model.connectors.values() {
        close(connector.anchor.unwrap().distance / METRES_PER_FOOT, want, 1e-9);
    }
}

#[test]
fn connectors_of_inmodel_are_reported_as_made_at_its_end() {
    let left =
        run("INMODEL\n*P 0 0 11\n~W B_CAT 4 -LEN 4000 -DEP 500\nCONNECTOR A -ANC 0 3950 ~W *P\n&CONNECTOR A -ACTIVE\n");
    assert_eq!(left.messages, ["unknown connector A"]);
    assert!(left.help.contains(&"the connectors of INMODEL are made at its END".to_string()), "{:?}", left.help);
}

#[test]
fn slack_or_taut_spring_gets_length_of_hookes_law() {
    // 4.19 in and 29,000 ksi over the chord of 900 ft beside and 511 ft above, first loose, then tight
    let (ea, chord) = (29000.0 * std::f64::consts::PI / 4.0 * 4.19 * 4.19, 900.0_f64.hypot(511.0));
    for length in [5000.0, 1000.0] {
        for (option, tension) in [("-L_TENSION", 200.0), ("-L_HORIZONTAL", 200.0 * chord / 900.0)] {
            let left = clean(&format!(
                "MEDIT\n&DESCRIBE BODY B\n*P 0 0 11\n~S SL_ELEM 4.19 TENSION -LEN {length}\n~S SL_ELEM 4.19 -LEN 30\n\
                 CONNECTOR A -ANC 0 900 ~S *P\nEND\n&ENV -DEPTH 500\n&CONNECTOR A {option} 200\n"
            ));
            let want = chord / (1.0 + tension / ea) - 30.0;
            close(left.connector("A").first_length.unwrap() / METRES_PER_FOOT, want, 1e-9);
        }
    }
}

#[test]
fn hanging_line_gets_nearer_length_or_reports_least_tension() {
    // no bottom: between ends of one height a catenary of span S has T = w S / 2 cosh(a) / a, s = S sinh(a) / a with
    // a = w S / 2 H; the least T is at a tanh(a) = 1, a = 1.19967864, T = w S / 2 * 1.50887956
    let (w, span) = (0.05, 1000.0);
    let hung = |length: f64, wanted: f64| {
        format!(
            "MEDIT\n&DESCRIBE BODY A\n*P 0 0 0\n&DESCRIBE BODY B\n*Q {span} 0 0\n\
             ~H H_CAT 4 EXACT -LEN {length} -WTPL {w} -EMOD 1E12\nCONNECTOR L ~H *P *Q\nEND\n\
             &CONNECTOR L -L_TENSION {wanted}\n"
        )
    };
    let tight = 0.5_f64;
    let ratio = tight.cosh() / tight;
    // the other side of the least value, by bisection
    let (mut low, mut high) = (1.2_f64, 9.0);
    for _ in 0..200 {
        let middle: f64 = 0.5 * (low + high);
        if middle.cosh() / middle < ratio { low = middle } else { high = middle }
    }
    let lengths = [tight, low].map(|a: f64| span * a.sinh() / a);
    for (present, [taken, named]) in [
        (900.0, lengths),
        (1001.0, lengths),
        (1100.0, lengths),
        (2500.0, [lengths[1], lengths[0]]),
        (9000.0, [lengths[1], lengths[0]]),
    ] {
        let left = clean(&hung(present, w * span / 2.0 * ratio));
        close(left.connector("L").first_length.unwrap() / METRES_PER_FOOT, taken, 1e-8);
        assert!(left.text.contains(&format!("a first segment of {named:.2} ft gives the same")), "{}", left.text);
    }
    let least = w * span / 2.0 * 1.508_879_561_538_3;
    let left = run(&hung(1100.0, 0.99 * least));
    let said = format!("the nearest is {:.6}", least);
    assert!(left.messages.iter().any(|m| m.contains(&said)), "{said}: {:?}", left.messages);
    clean(&hung(1100.0, 1.000_01 * least));
}

#[test]
fn lengths_are_given_or_added_and_reported_with_old_values() {
    let left = clean(&format!("{LINES}&CONNECTOR BOTTOM -LENGTH 3990 -L_DELTA 5.5 ROUGH -L_DELTA -10\n"));
    close(left.connector("BOTTOM").first_length.unwrap(), 3995.5 * METRES_PER_FOOT, 1e-12);
    close(left.connector("ROUGH").first_length.unwrap(), 1490.0 * METRES_PER_FOOT, 1e-12);
    assert_eq!(left.connector("SLOPED").first_length, None);
    let said = left.printed_lines();
    assert_eq!(said.len(), 3);
    assert!(said[0].starts_with("connector BOTTOM: first segment 3990.00 ft (was 4000.00), horizontal force "));
    assert!(said[1].starts_with("connector BOTTOM: first segment 3995.50 ft (was 3990.00), horizontal force "));
    assert!(said[2].starts_with("connector ROUGH: first segment 1490.00 ft (was 1500.00), horizontal force "));
}

#[test]
fn input_and_output_are_in_user_units() {
    let left = clean(&format!("{STIFF}&DIMEN -DIMEN METERS K-NTS\n&CONNECTOR A -L_HORIZONTAL 222.41108076\n"));
    let want = (3950.0 + spare(50.0)) * METRES_PER_FOOT;
    assert!(left.text.contains(&format!("first segment {want:.2} m (was 1219.20), horizontal force 222.41 kN")));
}

#[test]
fn own_length_is_in_status_string_function_and_table() {
    let left = clean(&format!(
        "{STIFF}&CONNECTOR A -LENGTH 3987.25 -INACTIVE\n&STATUS G_CONNECTOR\n\
         &TYPE it is &CONNECTOR(LENGTH A) and &CONNECTOR(STATUS A)\nCONN_DESIGN\nTABLE A\nREPORT\nEND\nEND\n"
    ));
    assert!(left.text.contains("A     ~W     Inactive     3987.25"), "{}", left.text);
    assert!(left.text.contains("it is 3987.25 and INACTIVE"));
    assert!(left.text.contains("Length of First Segment          = 3987.25 ft"), "{}", left.text);
}

#[test]
fn option_acts_on_preceding_names_in_order_and_once_on_each() {
    let left = clean(&format!(
        "{LINES}&SELECT :TWO -SELECT CHORD PULLS\n\
         &CONNECTOR BO@ bottom -LENGTH 3990 -INACTIVE :TWO HANG -LENGTH 3995 @ -INACTIVE :TWO -ACTIVE\n"
    ));
    let length = |name: &str| left.connector(name).first_length.map(|l| (l / METRES_PER_FOOT).round());
    assert_eq!(length("BOTTOM"), Some(3990.0));
    assert_eq!([length("CHORD"), length("PULLS"), length("HANG")], [Some(3995.0); 3]);
    assert_eq!([length("ROUGH"), length("AQWA")], [None; 2]);
    let active: Vec<&str> = NAMES.into_iter().filter(|n| left.connector(n).active).collect();
    assert_eq!(active, ["CHORD", "PULLS"]);
    assert_eq!(left.printed_lines().len(), 1 + 1 + 3 + 9 + 2);
}

#[test]
fn solving_option_skips_inactive_connector_with_a_note() {
    let left = clean(&format!("{LINES}&CONNECTOR HANG -INACTIVE BOTTOM HANG -A_TENSION 60 -L_HORIZONTAL 50\n"));
    let before = clean(LINES);
    assert_eq!(left.connector("HANG").anchor, before.connector("HANG").anchor);
    assert_eq!(left.connector("HANG").first_length, None);
    assert!(left.connector("BOTTOM").first_length.is_some());
    assert!(left.printed_lines().contains(&"connector HANG: inactive, passed over by -A_TENSION"), "{}", left.text);
}

#[test]
fn unsolvable_connector_is_named_and_voids_the_whole_record() {
    let records = format!("{LINES}CONN_DESIGN\nEND\n");
    let left = run(&format!("{records}&CONNECTOR BOTTOM -A_TENSION 60 -INACTIVE ROUGH HANG -A_TENSION 1\n"));
    assert_eq!(left.messages.len(), 1);
    assert!(left.messages[0].starts_with("connector ROUGH: no position has the tension"), "{:?}", left.messages);
    assert!(left.printed_lines().is_empty());
    assert_eq!(format!("{:?}", left.model.connectors), format!("{:?}", clean(&records).model.connectors));
}

#[test]
fn anchor_given_by_x_y_z_has_own_depth_and_moves_b_cat_seabed() {
    let put = |z: f64| format!("{LINES}&CONNECTOR BOTTOM -ANCHOR 3400 1600 {z}\n");
    let left = run(&put(-450.0));
    assert_eq!(left.messages.len(), 1);
    assert!(left.messages[0].contains("450.00 ft, not the 500.00 ft of -DEPANCHOR"), "{:?}", left.messages);
    let anchor = left.connector("BOTTOM").anchor.unwrap();
    close(anchor.distance, 3000.0_f64.hypot(1550.0) * METRES_PER_FOOT, 1e-12);
    close(anchor.direction, 1550.0_f64.atan2(3000.0), 1e-12);
    assert!(left.text.contains("anchor at 3400.00 1600.00 -450.00, "), "{}", left.text);
    // the same line with that depth in its class
    let class = LINES.replace("~BOTTOM B_CAT 4.19 EXACT -DEP 500", "~BOTTOM B_CAT 4.19 EXACT -DEP 450");
    let same = clean(&format!("{class}&CONNECTOR BOTTOM -ANCHOR 3400 1600 -450\n"));
    assert_eq!(left.loads("BOTTOM").tension.to_bits(), same.loads("BOTTOM").tension.to_bits());
    // an anchor at the depth of the class is not remarked on
    clean(&put(-500.0));
    // solving its place keeps the elevation
    let solved = run(&format!("{}&CONNECTOR BOTTOM -A_TENSION 90\n", put(-450.0)));
    close(solved.connector("BOTTOM").anchor.unwrap().elevation.unwrap(), -450.0 * METRES_PER_FOOT, 1e-12);
    close(solved.loads("BOTTOM").tension, 90.0 * NEWTONS_PER_KIP, 1e-8);
}

#[test]
fn anchor_moves_along_its_direction_after_body_has_moved() {
    let left = clean(&format!("{LINES}&INSTATE -MOVE TBRG 30 -40 0 0 0 20\n&CONNECTOR BOTTOM -A_HORIZONTAL 70\n"));
    let before = clean(&format!("{LINES}&INSTATE -MOVE TBRG 30 -40 0 0 0 20\n"));
    let (_, [ux, uy]) = before.model.placement(before.connector("BOTTOM")).span();
    let (_, [vx, vy]) = left.model.placement(left.connector("BOTTOM")).span();
    assert!((ux * vy - uy * vx).abs() < 1e-12 && ux * vx + uy * vy > 0.0);
    close(left.connector("BOTTOM").anchor.unwrap().direction, uy.atan2(ux), 1e-12);
    close(left.loads("BOTTOM").fairlead[0].hypot(left.loads("BOTTOM").fairlead[1]), 70.0 * NEWTONS_PER_KIP, 1e-8);
}

#[test]
fn anchor_below_its_fairlead_moves_in_given_direction() {
    let records = LINES.replace("-ANC 30 3950 ~BOTTOM", "-ANC 30 0 ~BOTTOM");
    let left = clean(&format!("{records}&CONNECTOR BOTTOM -A_HORIZONTAL 70\n"));
    let [x, y, _] = left.loads("BOTTOM").fairlead;
    close(y.atan2(x).to_degrees(), 30.0, 1e-9);
    close(x.hypot(y), 70.0 * NEWTONS_PER_KIP, 1e-8);
}

#[test]
fn table_missing_solved_value_is_reported() {
    let records = STIFF.replace(" EXACT", " -TABLE").replace(" -EMOD 1E12", " -TAB_LIM 3000000");
    let left = run(&format!("{records}&CONNECTOR A -A_TENSION 1500\n"));
    assert!(left.text.contains("(from its table of thirty points)"), "{}", left.text);
    assert!(
        left.messages.iter().any(|m| m.contains("its table of thirty points gives a tension of")),
        "{:?}",
        left.messages
    );
}

#[test]
fn help_explains_command_and_string_function_of_same_name() {
    let left = clean("&HELP &CONNECTOR\n");
    assert!(left.text.contains("-A_TENSION F") && left.text.contains("&CONNECTOR(ACTION NAME)"), "{}", left.text);
}
