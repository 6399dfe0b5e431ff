//! A B_CAT is the exact catenary wherever it is used. The numbers are of the elastic catenary integrated along its unstretched length
//! with scipy 1.x (`quad` of dx/ds = H/T (1 + T/EA), dz/ds = V/T (1 + T/EA), the rest on the bottom stretched by H/EA), its two end
//! forces found by `fsolve` to 1e-11 of the length; derivatives are central differences of it of fourth order.

use crate::common;

use windlass::session::Session;
use windlass_model::Model;
use windlass_solve::System;

/// What a session printed.
fn run(records: &str) -> (Session, String) {
    let (mut session, screen, folder) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS KN\n{records}\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.output.flush();
    drop(folder);
    (session, screen.text())
}

/// A chain of 700 m, 1.2 kN/m, EA 554,177 kN, in water of 100 m, 690 m beside its fairlead.
fn heaving_chain(option: &str, reach: f64, motion: &str) -> String {
    format!(
        "&ENV -DEPTH 100 -TIME 24 0.1\nMEDIT\n&DESCRIBE BODY B\n*G 0 0 0\n*F 30 0 -5\n#WEIGHT *G 10000 5 5 5\n\
         ~C B_CAT 84 {option} -LEN 700 -BUOY 0 -WTPL 1.2 -EMOD 1E5\nCONNECTOR A ~C *F -ANC 0 {reach}\n{motion}\nEND"
    )
}

/// Least and largest of the tensions that a run printed.
fn tensions(text: &str) -> [f64; 2] {
    let line = text.lines().find(|l| l.trim_start().starts_with("A Tension ")).unwrap_or_else(|| panic!("{text}"));
    let cells: Vec<f64> = line.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    [cells[2], cells[4]]
}

#[test]
fn heave_of_fairlead_in_tdom_changes_tension() {
    for flag in ["", "EXACT"] {
        let (_, text) = run(&format!("{}\nTDOM", heaving_chain(flag, 690.0, "PRESCRIBE B -SINUSOID Z 5 12")));
        // printed with six figures; the instants of the extremes are stored
        for (got, want) in tensions(&text).iter().zip([1_477.494_634_7, 1_858.983_220_8]) {
            assert!((got - want).abs() <= 0.006, "{got} is not {want}");
        }
    }
}

#[test]
fn table_follows_elevation_of_fairlead() {
    // at the lowest place the distance is that of row 13, 4000 kN (12/29)^2: there nothing is interpolated
    let records = heaving_chain("-TABLE -TAB_LIM 4000", 684.432_504_020_235_5, "PRESCRIBE B -SINUSOID Z 5 12");
    let (_, text) = run(&format!("{records}\nTDOM"));
    let [least, _] = tensions(&text);
    assert!((least - 792.755_136_3).abs() <= 0.006, "{least}");
    let note = "forces interpolated in tables of thirty points (-TABLE), not solved: A";
    assert!(text.contains(note), "{text}");
}

#[test]
fn moored_body_stiffness_includes_vertical_line_stiffness() {
    let at_rest = |option: &str| {
        let (session, _) = run(&heaving_chain(option, 690.0, ""));
        let model: &Model = &session.job.model;
        let system = System::new(model, &[]).unwrap();
        let mut state = system.state(model);
        system.evaluate(&mut state).unwrap();
        state.stiffness
    };
    let k = at_rest("");
    // kN/m, kN/m, kN/m, kN/rad, kN: of the line, and with the arms 30 and -5 m
    let want = [
        ((0, 0), 197.302_346_55),
        ((2, 2), 10.227_450_102),
        ((0, 2), -36.986_231_027),
        ((2, 0), -36.986_231_027),
        ((0, 4), 123.075_197_97),
        ((4, 0), 123.075_197_97),
    ];
    for ((i, j), want) in want {
        let got = k[(i, j)] / 1e3;
        // the differences are good to 1e-9; K(FX,RY) is a difference of numbers ten times as large
        assert!((got - want).abs() <= 2e-8 * 1e3, "{i} {j}: {got} is not {want}");
    }
    // interpolated between rows of H 428 to 5000 kN: within a few percent, and symmetric
    let table = at_rest("-TABLE");
    assert!((table[(2, 2)] - k[(2, 2)]).abs() < 0.05 * k[(2, 2)], "{} {}", table[(2, 2)], k[(2, 2)]);
    assert!((table[(0, 4)] - table[(4, 0)]).abs() <= 1e-9 * table[(0, 0)], "{table}");
}

/// A wire of 600 m in 200 m of water behind a spring of 200 kN/m at rest, or a piston that holds 500 kN.
fn device(option: &str) -> String {
    let (_, text) = run(&format!(
        "&ENV -DEPTH 200\n&DATA CONVOLUTION TIME RB 0 900 1 700 60 200\nMEDIT\n&DESCRIBE BODY B\n*C 0 0 0\n\
         ~S B_CAT 50 -LEN 600 -EMOD 200000 -WTPLEN 1.1 -BUOYDIA 0 -DEP 200 {option}\nCONNECTOR A -ANC 0 540 ~S *C\nEND\n\
         &STATUS F_CONNECTOR"
    ));
    text
}

/// FX, -FZ and tension of the first connector.
fn pull(text: &str) -> [f64; 3] {
    let line = text.lines().find(|l| l.trim_start().starts_with("A ")).unwrap();
    let cells: Vec<f64> = line.split_whitespace().skip(3).filter_map(|w| w.parse().ok()).collect();
    [cells[1], -cells[3], cells[4]]
}

#[test]
fn devices_in_series_stretch_along_tension() {
    let near = |option: &str, want: [f64; 3], share: f64| {
        let text = device(option);
        for (got, want) in pull(&text).iter().zip(want) {
            // two decimals are printed
            assert!((got - want).abs() <= 0.006 + share * want, "{option}: {got} is not {want}\n{text}");
        }
        text
    };
    let behind_spring = [414.078_070_05, 476.354_819_89, 631.169_202_77];
    near("-SEND 200", behind_spring, 0.0);
    near("-CONVOLUTION RB", behind_spring, 0.0);
    // the piston has given way by 13.465 m of 19 m
    let held = [292.228_099_53, 405.712_629_63, 500.0];
    let text = near("-PISTON MAX 20000 1000 .4 .2 500", held, 0.0);
    assert!(text.contains("14.4651"), "{text}");
    // between rows of 210 and 386 kN, of 386 and 588 kN
    for (option, want) in [("-CONVOLUTION RB", behind_spring), ("-PISTON MAX 20000 1000 .4 .2 500", held)] {
        let text = near(&format!("-TABLE {option}"), want, 0.01);
        assert!(text.contains("-TABLE), not solved: A"), "{text}");
    }
}

#[test]
fn table_pulls_anchor_on_slope_downward_too() {
    // the bottom rises toward the anchor: what lies there pulls along it, downward, with the slope times the horizontal pull
    let both = ["", "-TABLE"].map(|option| {
        let (_, text) = run(&format!(
            "&ENV -DEPTH 100\nMEDIT\n*F 0 0 -5\n~C B_CAT 84 {option} -LEN 700 -BUOY 0 -WTPL 1.2 -EMOD 1E5 -SLOPE -0.05\n\
             CONNECTOR A ~C *F -ANC 0 690\nEND\n&STATUS F_CONNECTOR"
        ));
        let line = text.lines().find(|l| l.trim_start().starts_with("A ")).unwrap();
        line.split_whitespace().skip(3).filter_map(|w| w.parse().ok()).collect::<Vec<f64>>()
    });
    for cells in both {
        let (vertical, horizontal) = (cells[7], cells[8]);
        assert!(
            horizontal > 100.0 && (vertical + 0.05 * horizontal).abs() <= 0.006 + 1e-3 * vertical.abs(),
            "{cells:?}"
        );
    }
}

#[test]
fn every_report_using_a_table_names_its_lines() {
    let records = heaving_chain(
        "-TABLE",
        690.0,
        "#DAMP *G 100 100 100 1000 1000 1000\n~S GSPR X 100 Y 100 Z 1E5 RX 1E8 RY 1E8 RZ 1E8\nCONNECTOR HOLD ~S *G",
    );
    let records =
        records.replace("*F 30", "*H 0 0 0\n*F 30").replace("CONNECTOR HOLD ~S *G", "CONNECTOR HOLD ~S *G *GROUND");
    let records = records.replace("&DESCRIBE BODY B", "*GROUND 0 0 0\n&DESCRIBE BODY B");
    let note = "-TABLE), not solved: A";
    for (report, times) in [
        ("&STATUS F_CONNECTOR", 1),
        ("&STATUS STIFFNESS", 1),
        ("&STATUS FORCE", 1),
        ("&STATUS MODES", 1),
        ("&EQUI", 1),
        ("TDOM\nPRCPOST\nCONFORCE A\nREPORT\nEND\nTRAJECTORY\nREPORT 1:2\nEND\nEND", 4),
        ("CONN_DESIGN\nMOVE B 0 -DISTANCE 2 -ROWS 3\nREPORT\nEND\nWATCH B 100 -ANGLES 0 90 90\nREPORT\nEND\nEND", 2),
    ] {
        let (_, text) = run(&format!("{records}\n{report}"));
        let found = text.matches(note).count();
        assert_eq!(found, times, "{report}\n{text}");
        let (_, exact) = run(&format!("{}\n{report}", records.replace("-TABLE", "")));
        assert!(!exact.contains(note), "{report}\n{exact}");
    }
}

/// A heavy first segment before a long light one, 1400 m or less to the anchor in 1000 m of water.
fn heavy(reach: f64, length: f64, option: &str) -> String {
    let (session, text) = run(&format!(
        "&ENV -DEPTH 1000\nMEDIT\n&DESCRIBE BODY B\n*F 0 0 -10\n~C B_CAT 84 -LEN {length} -BUOY 0 -WTPL 1.2 -EMOD 200000\n\
         ~C B_CAT 120 -LEN 1300 -BUOY 0 -WTPL .03 -EMOD 6000\n~C B_CAT 84 -LEN 300 -BUOY 0 -WTPL 1.2 -EMOD 200000\n\
         CONNECTOR A -ANC 0 {reach} ~C *F\nEND\n&CONNECTOR A {option}"
    ));
    let found = session.job.model.connectors["A"].first_length.unwrap();
    format!("{found:.6} {text}")
}

#[test]
fn length_for_tension_is_nearest_solution() {
    // scipy, as above for three segments: the tension falls from 1133 kN at 100 m to 331 at 210 m, and rises with the weight to 512 at
    // 400 m; brentq on the length to 1e-10 m
    let (tight, hung) = (149.645_705_441, 389.519_010_704);
    for (length, nearest, other) in [(160.0, tight, "389.52"), (380.0, hung, "149.65")] {
        let text = heavy(1400.0, length, "-L_TENSION 500");
        let found: f64 = text.split_whitespace().next().unwrap().parse().unwrap();
        assert!((found - nearest).abs() <= 1e-5, "{found} is not {nearest}");
        assert!(text.contains(&format!("a first segment of {other} m gives the same")), "{text}");
    }
    // nearer to the anchor no length is tight: one alone
    let text = heavy(1200.0, 150.0, "-L_TENSION 500");
    assert!(text.starts_with("399.2590"), "{text}");
    assert!(!text.contains("gives the same"), "{text}");
    // the horizontal force only falls
    let text = heavy(1400.0, 150.0, "-L_HORIZONTAL 100");
    assert!(text.starts_with("189.7557"), "{text}");
}

#[test]
fn hanging_line_reports_crossing_of_seabed_and_surface() {
    // inextensible, 1000 m between ends of one height: s = S sinh(a)/a, sag S (cosh(a) - 1)/(2 a); with a = 1 1175.201 m and 271.540 m,
    // so that its lowest point, halfway, is 71.54 m below the bottom at 190 m
    let hang = |z: f64, options: &str| {
        let (_, text) = run(&format!(
            "&ENV -DEPTH 190\nMEDIT\n&DESCRIBE BODY A\n*P 0 0 {z}\n&DESCRIBE BODY B\n*Q 1000 0 {z}\n\
             ~H H_CAT 100 EXACT -LEN 1175.2011936438 -WTPL 0.5 -EMOD 1E12 {options}\nCONNECTOR L ~H *P *Q\nEND\n&STATUS F_CONNECTOR"
        ));
        text
    };
    let text = hang(10.0, "");
    assert!(text.contains("passes up to 71.54 m below the sea bottom, 500.0"), "{text}");
    assert!(text.contains("passes up to 10.00 m above the water surface, 0.00 m beside its first end"), "{text}");
    // ends in the surface do not cross it
    let text = hang(0.0, "-FRICTION 0.5 -SLOPE 0.02 -DEPANCHOR 150");
    assert!(text.contains("passes up to 81.54 m below the sea bottom"), "{text}");
    assert!(!text.contains("above the water surface"), "{text}");
    assert!(text.contains("it has no bottom: -FRICTION and -SLOPE do nothing"), "{text}");
}

#[test]
fn hanging_line_to_anchor_reaches_depth_of_its_class() {
    // weightless and straight: 300 m beside and 400 m below, EA 0.7854E6 kN, 1 m longer than its 499 m
    let (_, text) = run(
        "&ENV -DEPTH 900\nMEDIT\n&DESCRIBE BODY A\n*P 0 0 0\n~H H_CAT 100 -LEN 499 -EMOD 1E5 -DEPANCHOR 400\nCONNECTOR L ~H *P -ANC 0 300\n\
         END\n&STATUS F_CONNECTOR",
    );
    let line = text.lines().find(|l| l.trim_start().starts_with("L ")).unwrap();
    let cells: Vec<f64> = line.split_whitespace().skip(3).filter_map(|w| w.parse().ok()).collect();
    let tension = std::f64::consts::FRAC_PI_4 * 1e6 / 499.0;
    for (got, want) in [(cells[1], 0.6 * tension), (-cells[3], 0.8 * tension), (cells[4], tension)] {
        assert!((got - want).abs() <= 0.006, "{got} is not {want}\n{text}");
    }
}
