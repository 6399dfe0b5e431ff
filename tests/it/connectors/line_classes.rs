//! The line classes of [MOSES-FLEX] and [AQWA-CONN] between their ends: forces, stiffness and every option that acts, against numbers not
//! made here, closed forms and differences.

use crate::common;

use windlass::session::Session;
use windlass_model::{Condition, LineLoads, LineModel, LineSampling, Placement};

/// A session in metres and newtons (sections in mm, stresses in MPa) that has read these class records.
fn session(records: &str) -> Session {
    let (mut session, screen, _folder) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS N\n&ENV -DEPTH 1000\nMEDIT\n{records}\nEND\n"));
    session.run();
    assert!(!session.job.model.classes.is_empty(), "{records}: {:?} {}", session.reports, screen.text());
    session
}

fn position(fairlead: [f64; 3], other: [f64; 3], to_ground: bool) -> Placement {
    Placement { fairlead, other: Some(other), to_ground, anchored: to_ground, ..Placement::default() }
}

fn with_line<T>(records: &str, position: Placement, ask: impl Fn(&dyn LineModel) -> T) -> T {
    let session = session(records);
    let model = &session.job.model;
    let class = model.classes.values().next_back().unwrap_or_else(|| panic!("{records}: {:?}", session.reports));
    let line = class.line(&position, &model.surroundings()).unwrap_or_else(|e| panic!("{records}: {e}"));
    ask(line.as_ref())
}

fn loads(records: &str, position: Placement) -> LineLoads {
    with_line(records, position, |line| line.loads().unwrap_or_else(|e| panic!("{records}: {e}")))
}

fn assert_near(got: f64, want: f64, share: f64) {
    assert!((got - want).abs() <= share * want.abs().max(1e-6), "{got} is not {want}");
}

/// Rows of the validation data: x, z, length, EA, w, friction, suspended, fairlead H and V, anchor H and V.
fn data() -> Vec<[f64; 11]> {
    let mut reader = csv::Reader::from_path("tests/data/catenary_2000.csv").unwrap();
    reader
        .records()
        .map(|r| {
            let r = r.unwrap();
            [2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12].map(|i| r[i].parse().unwrap())
        })
        .collect()
}

/// Young's modulus (MPa) that gives a section of 100 mm this AE (N).
fn emodulus(ea: f64) -> f64 {
    ea / (std::f64::consts::FRAC_PI_4 * 100.0 * 100.0)
}

#[test]
fn exact_b_cats_match_validation_forces() {
    let mut met = 0;
    for [x, z, l, ea, w, friction, suspended, fh, fv, ah, av] in data().into_iter().step_by(7) {
        if suspended == 1.0 || w < 0.0 || z == 0.0 {
            continue;
        }
        let depth = 500.0 + z;
        let records = format!(
            "~L B_CAT 100 EXACT -LEN {l:e} -BUOY 0 -WTPL {w:e} -EMOD {:e} -DEP {depth:e} -FRICTION {friction:e}",
            emodulus(ea)
        );
        // heading 30 degrees from +X
        let (c, s) = (30f64.to_radians().cos(), 30f64.to_radians().sin());
        let got = loads(&records, position([10.0, 20.0, -500.0], [10.0 + x * c, 20.0 + x * s, -depth], true));
        let tension = fh.hypot(fv);
        for (a, b) in got.fairlead.iter().zip([fh * c, fh * s, -fv]) {
            assert!((a - b).abs() <= 2e-8 * tension, "{records}: {got:?}");
        }
        for (a, b) in got.other.iter().zip([-ah * c, -ah * s, av]) {
            assert!((a - b).abs() <= 2e-8 * tension, "{records}: {got:?}");
        }
        met += 1;
    }
    assert!(met > 100, "{met}");
}

#[test]
fn exact_h_cats_match_validation_forces_with_weight_in_air() {
    let mut met = 0;
    for [x, z, l, ea, w, _, suspended, fh, fv, ah, av] in data() {
        if suspended == 0.0 || w < 0.0 {
            continue;
        }
        // -BUOY changes nothing: a hanging catenary does not know the water
        let records = format!("~L H_CAT 100 EXACT -LEN {l:e} -WTPL {w:e} -EMOD {:e} -BUOY 100", emodulus(ea));
        let got = loads(&records, position([0.0, 0.0, z], [0.0, x, 0.0], false));
        let tension = fh.hypot(fv).max(ah.hypot(av));
        for (a, b) in got.fairlead.iter().chain(&got.other).zip([0.0, fh, -fv, 0.0, -ah, av]) {
            assert!((a - b).abs() <= 2e-8 * tension, "{records}: {got:?} {fh} {fv}");
        }
        met += 1;
    }
    assert!(met > 100, "{met}");
}

#[test]
fn stiffness_matches_force_finite_difference_in_every_line_class() {
    let chain = "~L B_CAT 100 EXACT -LEN 700 -BUOY 0 -WTPL 900 -EMOD 50000 -DEP 200 -FRICTION 0.4 -SEND 4E5\n\
                 ~L B_CAT 80 -LEN 400 -BUOY 0 -WTPL 300 -EMOD 50000 -CLUMP 3E4\n~L B_CAT 100 -LEN 300 -BUOY 0 -WTPL 900 -EMOD 50000";
    let cases = [
        (chain, [0.0, 0.0, -5.0], [1150.0, 600.0, -200.0], true),
        ("~L H_CAT 100 EXACT -LEN 300 -WTPL 500", [3.0, 0.0, 40.0], [170.0, 200.0, 10.0], false),
        ("~L H_CAT 100 -LEN 250", [3.0, 0.0, 40.0], [170.0, 200.0, 10.0], false),
        ("~L SL_ELEM 100 -LEN 300 -X_PY 1E5 0.1 1E6 0.4", [3.0, 0.0, 40.0], [170.0, 200.0, 10.0], false),
        ("~L SL_ELEM 100 -LEN 250", [3.0, 0.0, 40.0], [170.0, 200.0, 10.0], false),
        ("~L CATENARY 170 0.02 -LEN 300 -EA 7E8 -K 1E8 2E9 1E10", [0.0, 0.0, 40.0], [170.0, 200.0, 10.0], false),
    ];
    for (records, from, to, ground) in cases {
        let middle = loads(records, position(from, to, ground));
        let scale = middle.stiffness.iter().flatten().fold(0.0, |m: f64, k| m.max(k.abs()));
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut at = from;
                at[axis] += by;
                loads(records, position(at, to, ground)).fairlead
            };
            let (plus, minus) = (moved(1e-4), moved(-1e-4));
            for row in 0..3 {
                let slope = (plus[row] - minus[row]) / 2e-4;
                let got = middle.stiffness[row][axis];
                assert!((slope - got).abs() <= 2e-5 * scale, "{records}: [{row}][{axis}] {got} is not {slope}");
            }
        }
    }
}

#[test]
fn weight_in_water_includes_every_contributing_option() {
    // a slack line hangs straight down: the fairlead carries what hangs over the depth
    let area = std::f64::consts::FRAC_PI_4 * 0.01;
    let water = 1025.0 * 9.80665 * area;
    let cases = [
        ("-BUOY 0 -WTPL 500", 500.0),
        ("-WTPL 500", 500.0 - water),
        ("-WTPL 500 -BUOY 50", 500.0 - water / 4.0),
        ("-WTPL 500 -BUOY 0 -DISPLEN 120", 380.0),
        ("-DENSITY 5000", 5000.0 * 9.80665 * area - water),
        ("-SPGRAVITY 6", 6000.0 * 9.80665 * area - water),
        ("", 7850.0 * 9.80665 * area - water),
    ];
    for (options, w) in cases {
        let records = format!("~L B_CAT 100 EXACT -LEN 500 -EMOD 1E9 -DEP 300 {options}");
        let got = loads(&records, position([0.0; 3], [20.0, 0.0, -300.0], true));
        assert_near(-got.fairlead[2], w * 300.0, 1e-6);
        assert_near(got.fairlead[0], 0.0, 1e-9);
    }
}

#[test]
fn break_comes_from_given_tension_ultimate_stress_or_yield_stress() {
    let area = std::f64::consts::FRAC_PI_4 * 100.0 * 100.0;
    let base = "~L SL_ELEM 100 -LEN 100 -EMOD 200000";
    let end = position([0.0; 3], [100.1, 0.0, 0.0], false);
    let tension = 2e5 * area * 0.001;
    for (options, limit) in [
        ("-B_TENSION 2E6", 2e6),
        ("-TENSTR 500", 500.0 * area),
        ("-FYIELD 300", 500.0 * area),
        ("", 36.0 / 0.6 * 6.894_757_293_168_36 * area),
    ] {
        let got = loads(&format!("{base} {options}"), end.clone());
        assert_near(got.tension, tension, 1e-9);
        assert_near(got.ratio, tension / limit, 1e-6);
    }
}

#[test]
fn sl_elem_acts_both_ways_along_chord_unless_tension_only() {
    let area = std::f64::consts::FRAC_PI_4 * 0.01;
    for (flag, length) in [("", 40.0), ("", 60.0), ("TENSION", 40.0), ("TENSION", 60.0)] {
        let records = format!("~L SL_ELEM 100 {flag} -LEN {length} -EMOD 200000");
        let got = loads(&records, position([0.0; 3], [30.0, 0.0, -40.0], false));
        let mut want = 2e11 * area * (50.0 - length) / length;
        if flag == "TENSION" {
            want = want.max(0.0);
        }
        assert_near(got.fairlead[0], 0.6 * want, 1e-12);
        assert_near(got.fairlead[2], -0.8 * want, 1e-12);
        assert_near(got.other[0], -0.6 * want, 1e-12);
        assert_eq!(got.tension, if want == 0.0 { 0.0 } else { got.tension });
    }
    // only the distance counts: the same line turned
    let records = "~L SL_ELEM 100 -LEN 40 -EMOD 200000";
    let (a, b) = (
        loads(records, position([0.0; 3], [30.0, 0.0, -40.0], false)),
        loads(records, position([0.0; 3], [0.0, 50.0, 0.0], false)),
    );
    assert_near(a.tension, b.tension, 1e-12);
}

#[test]
fn springs_of_send_and_x_py_are_in_series_with_line() {
    let area = std::f64::consts::FRAC_PI_4 * 0.01;
    let k = 2e11 * area / 50.0;
    let end = position([0.0; 3], [52.0, 0.0, 0.0], false);
    let one = |options: &str| loads(&format!("~L SL_ELEM 100 -LEN 50 -EMOD 200000 {options}"), end.clone()).tension;
    assert_near(one(""), 2.0 * k, 1e-12);
    assert_near(one("-SEND 1E6"), 2.0 / (1.0 / k + 1e-6), 1e-10);
    assert_near(one("-SEND 1E6 5E5"), 2.0 / (1.0 / k + 1e-6 + 2e-6), 1e-10);
    assert_near(one("-SEND , 5E5"), 2.0 / (1.0 / k + 2e-6), 1e-10);
    // the curve: 0.5 m to 4E5 N, and its last slope of 1 m per 1E6 N beyond 9E5 N
    let t = one("-X_PY 4E5 0.5 9E5 1.0");
    assert_near(t / k + 1.0 + (t - 9e5) * 1e-6, 2.0, 1e-10);
    // and in compression as in tension
    let pushed =
        loads("~L SL_ELEM 100 -LEN 50 -EMOD 200000 -X_PY 4E5 0.5 9E5 1.0", position([0.0; 3], [48.0, 0.0, 0.0], false));
    assert_near(pushed.tension, -t, 1e-9);
}

#[test]
fn weightless_h_cat_is_tension_only_sl_elem() {
    for x in [30.0, 49.0, 51.0, 52.0] {
        let end = position([0.0; 3], [x, 5.0, -3.0], false);
        let (a, b) = (loads("~L H_CAT 100 -LEN 50", end.clone()), loads("~L SL_ELEM 100 TENSION -LEN 50", end.clone()));
        assert_eq!((a.fairlead, a.stiffness), (b.fairlead, b.stiffness));
    }
}

const TABLED: &str = "~L B_CAT 100 -LEN 1500 -BUOY 0 -WTPL 900 -EMOD 50000 -DEP 300 -TABLE";

fn placement_at(x: f64) -> Placement {
    position([0.0, 0.0, -10.0], [x, 0.0, -300.0], true)
}

#[test]
fn table_matches_its_thirty_rows_and_is_monotone_between() {
    let rows = with_line(TABLED, placement_at(1300.0), |l| l.tabulate("A").unwrap().0);
    assert_eq!(rows.rows(), 30);
    let number = |row: usize, column: usize| rows.row(row)[column].number().unwrap();
    let exact = TABLED.replace(" -TABLE", "");
    for row in 1..29 {
        let got = loads(TABLED, placement_at(number(row, 0)));
        assert_eq!(got.solution, "table");
        assert_near(got.fairlead[0], number(row, 1), 1e-9);
        assert_near(got.tension, number(row, 3), 1e-9);
        assert_near(-got.stiffness[0][0], number(row, 2), 1e-6);
        assert_eq!(got.stiffness[2][1], 0.0);
        let solved = loads(&exact, placement_at(number(row, 0)));
        (0..3).for_each(|i| assert_near(got.stiffness[i][2], solved.stiffness[i][2], 1e-9));
        if row > 1 {
            let slope = (loads(TABLED, placement_at(number(row, 0) + 1e-4)).fairlead[2] - got.fairlead[2]) / 1e-4;
            assert_near(-got.stiffness[2][0], slope, 1e-2);
        }
        let middle = 0.5 * (number(row, 0) + number(row + 1, 0));
        let halfway = loads(TABLED, placement_at(middle));
        let between = halfway.fairlead[0];
        assert_eq!(-halfway.other[0], between, "no friction: the anchor is pulled with the same");
        assert!(between > number(row, 1) && between < number(row + 1, 1));
        let want = loads(&exact, placement_at(middle));
        assert_eq!(want.solution, "exact");
        assert!((between - want.fairlead[0]).abs() < 2e-3 * number(row + 1, 1), "{between} {}", want.fairlead[0]);
    }
}

#[test]
fn force_beyond_table_is_extrapolated_linearly_with_a_note() {
    let rows = with_line(TABLED, placement_at(1300.0), |l| l.tabulate("A").unwrap().0);
    let last = |column: usize| rows.row(29)[column].number().unwrap();
    let got = loads(TABLED, placement_at(last(0) + 2.0));
    assert_near(got.fairlead[0], last(1) + 2.0 * last(2), 1e-9);
    assert!(got.notes.iter().any(|n| n.without_values().contains("beyond the table")), "{:?}", got.notes);
}

#[test]
fn tabled_line_nearer_than_first_row_is_solved_exactly() {
    let exact = TABLED.replace(" -TABLE", "");
    for x in [0.0, 50.0, 900.0] {
        let (got, want) = (loads(TABLED, placement_at(x)), loads(&exact, placement_at(x)));
        assert_eq!((got.fairlead, got.grounded), (want.fairlead, want.grounded));
        assert!(got.fairlead[2] < 0.0 && got.grounded < 1500.0, "{got:?}");
        assert!(got.notes.iter().any(|n| n.without_values().contains("solved exactly")), "{:?}", got.notes);
    }
}

#[test]
fn tab_lim_is_largest_horizontal_force_of_table() {
    let limited = with_line(&format!("{TABLED} -TAB_LIM 1E6"), placement_at(1300.0), |l| l.tabulate("A").unwrap().0);
    assert_near(limited.row(29)[1].number().unwrap(), 1e6, 1e-12);
    let free = with_line(TABLED, placement_at(1300.0), |l| l.tabulate("A").unwrap().0);
    assert_near(
        free.row(29)[1].number().unwrap(),
        36.0 / 0.6 * 6.894_757_293_168_36e6 * std::f64::consts::FRAC_PI_4 * 0.01,
        1e-6,
    );
}

#[test]
fn friction_reduces_anchor_pull_only() {
    let exact = TABLED.replace(" -TABLE", "");
    let smooth = loads(&exact, placement_at(1440.0));
    let rough = loads(&format!("{exact} -FRICTION 0.2"), placement_at(1440.0));
    assert_near(-rough.other[0], rough.fairlead[0] - 0.2 * 900.0 * rough.grounded, 1e-9);
    assert_near(-smooth.other[0], smooth.fairlead[0], 1e-12);
    assert!(rough.fairlead[0] > smooth.fairlead[0] && rough.grounded > 100.0);
}

#[test]
fn positive_slope_is_deeper_at_anchor_than_below_vessel() {
    let exact = TABLED.replace(" -TABLE", "");
    for (slope, rises) in [(0.05, true), (-0.05, false)] {
        let shape = with_line(&format!("{exact} -SLOPE {slope}"), placement_at(1400.0), |l| {
            l.geometry("A", Condition::Placed, LineSampling::Adaptive).unwrap()
        });
        let fact = |name: &str| shape.facts.iter().find(|f| f.name == name).unwrap().value.number().unwrap();
        let (x, z) = (fact("Touchdown at X"), fact("Touchdown at Z"));
        assert_near(z, -300.0 + slope * (1400.0 - x), 1e-9);
        assert_eq!(z > -300.0, rises);
    }
}

#[test]
fn clumps_and_spring_buoys_act_at_segment_end_and_follow_tide() {
    let line = |clump: &str| {
        format!(
            "~L B_CAT 100 EXACT -LEN 400 -BUOY 0 -WTPL 300 -EMOD 50000 -DEP 300 {clump}\n\
             ~L B_CAT 100 -LEN 900 -BUOY 0 -WTPL 900 -EMOD 50000"
        )
    };
    let joint = |records: &str| {
        let table = with_line(records, placement_at(1250.0), |l| {
            l.geometry("A", Condition::Placed, LineSampling::Adaptive).unwrap()
        });
        let row = (0..table.rows()).map(|i| table.row(i)).find(|r| r[12].number().is_some()).unwrap();
        (row[1].number().unwrap(), table.notes.clone())
    };
    let (bare, _) = joint(&line(""));
    let (weighed, _) = joint(&line("-CLUMP 2E5"));
    assert!(weighed < bare, "{weighed} {bare}");
    let (held, notes) = joint(&line("-CLUMP -2E6 60"));
    assert_near(held, -60.0, 1e-9);
    assert!(notes.iter().any(|n| n.text.contains("held by its pendant")), "{notes:?}");
    let (tide, _) = joint(&format!("END\n&ENV -TIDE 3\nMEDIT\n{}", line("-CLUMP -2E6 60")));
    assert_near(tide, -57.0, 1e-9);
    let (sunk, notes) = joint(&line("-CLUMP -1E5 60"));
    assert!(sunk < -60.0 && notes.iter().any(|n| n.text.contains("is sunk")), "{sunk} {notes:?}");
}

#[test]
fn first_length_for_force_gives_that_force() {
    let exact = TABLED.replace(" -TABLE", "");
    for condition in [Condition::Horizontal(4e5), Condition::Tension(9e5)] {
        let length = with_line(&exact, placement_at(1400.0), |l| l.first_length(condition).unwrap().length);
        let got = loads(&exact, Placement { first_length: Some(length), ..placement_at(1400.0) });
        match condition {
            Condition::Horizontal(f) => assert_near(got.fairlead[0], f, 1e-8),
            _ => assert_near(got.tension, 9e5, 1e-8),
        }
        let x = with_line(&exact, placement_at(1400.0), |l| l.distance(condition).unwrap());
        let moved = loads(&exact, placement_at(x));
        match condition {
            Condition::Horizontal(f) => assert_near(moved.fairlead[0], f, 1e-8),
            _ => assert_near(moved.tension, 9e5, 1e-8),
        }
    }
}

#[test]
fn aqwa_section_weight_is_mass_less_displaced_water() {
    for (area, w) in [(0.0, 170.0 * 9.80665), (0.02, (170.0 - 1025.0 * 0.02) * 9.80665)] {
        let records = format!("~L CATENARY 170 {area} -LEN 500 -EA 1E14 -DEP 300");
        let got = loads(&records, position([0.0; 3], [10.0, 0.0, -300.0], true));
        assert_near(-got.fairlead[2], w * 300.0, 1e-6);
    }
}

#[test]
fn aqwa_section_stretch_follows_polynomial_up_to_largest_tension() {
    let one = |options: &str, strain: f64| {
        // as heavy as the water it displaces: straight
        let records = format!("~L CATENARY 170 {:e} -LEN 100 {options}", 170.0 / 1025.0);
        loads(&records, position([0.0; 3], [100.0 * (1.0 + strain), 0.0, 0.0], false)).tension
    };
    assert_near(one("", 0.005), 5.0e6 * 170.0 * 0.005, 1e-9);
    assert_near(one("-EA 1E7 -TMAX 1E6", 0.02), 2e5, 1e-6);
    // beyond the maximum the tension is held, and keeps a millionth of its stiffness
    assert_near(one("-EA 1E7 -TMAX 1E5", 0.05), 1e5, 1e-5);
    let k = "-EA 1E7 -K 2E7 3E8 4E9 -TMAX 1E6";
    let ea = |e: f64| 1e7 + e * (2e7 + e * (3e8 + e * 4e9));
    assert_near(one(k, 0.03), ea(0.03) * 0.03, 1e-6);
    // e at the maximum tension by bisection, straight on beyond it
    let (mut low, mut high) = (0.0, 1.0);
    for _ in 0..200 {
        let e = 0.5 * (low + high);
        if ea(e) * e < 1e6 { low = e } else { high = e }
    }
    let slope = 2e7 + low * (6e8 + low * 12e9);
    assert_near(one(k, low + 0.02), (ea(low) + slope * 0.02) * (low + 0.02), 1e-6);
}

#[test]
fn aqwa_buoys_and_clumps_have_mass_and_ignore_surface() {
    let line =
        |joint: &str| format!("~L CATENARY 100 -LEN 200 -EA 1E9 -DEP 300 {joint}\n~L CATENARY 100 -LEN 400 -EA 1E9");
    let notes =
        |joint: &str| with_line(&line(joint), position([0.0; 3], [420.0, 0.0, -300.0], true), |l| l.loads().unwrap());
    let bare = notes("");
    let clump = notes("-CLUMP 30000 5000");
    assert!(-clump.fairlead[2] > -bare.fairlead[2] + 1e4);
    // a buoy so large that it lifts its joint out of the water, which it does not know
    let buoy = notes("-BUOY 1000 300000");
    assert!(
        buoy.notes.iter().any(|n| n.without_values().contains("rises above the water surface")),
        "{:?}",
        buoy.notes
    );
}

#[test]
fn line_ignoring_seabed_and_surface_reports_crossing_them() {
    let got = loads("~L H_CAT 100 EXACT -LEN 4000 -WTPL 500", position([0.0, 0.0, 10.0], [100.0, 0.0, 5.0], false));
    for text in ["below the sea bottom", "above the water surface"] {
        assert!(got.notes.iter().any(|n| n.without_values().contains(text)), "{:?}", got.notes);
    }
}

#[test]
fn viscoelastic_spring_is_in_series_with_its_long_term_stiffness() {
    let curves = "END\n&DATA CONVOLUTION TIME CREEP 0 4E6 10 2E6 1000 1E6\n&DATA CONVOLUTION FREQ SLOW 0.01 5E5 1 2E6\nMEDIT\n\
                  &DESCRIBE BODY B\n*A 0 0 0\n*B 0 0 0\n";
    let area = std::f64::consts::FRAC_PI_4 * 0.01;
    let k = 2e11 * area / 50.0;
    for (name, spring) in [("CREEP", 1e6), ("SLOW", 5e5)] {
        let records =
            format!("{curves}*C 52 0 0\n~L SL_ELEM 100 -LEN 50 -EMOD 200000 -CONVOLUTION {name}\nCONNECTOR S ~L *A *C");
        let session = session(&records);
        let model = &session.job.model;
        let connector = model.connectors.get("S").unwrap_or_else(|| panic!("{:?}", session.reports));
        let class = &model.classes[&connector.class];
        let line = class.line(&model.placement(connector), &model.surroundings()).unwrap();
        assert_near(line.loads().unwrap().tension, 2.0 / (1.0 / k + 1.0 / spring), 1e-10);
    }
    let missing = session("END\nINMODEL\n~L SL_ELEM 100 -LEN 50 -CONVOLUTION NONE");
    let class = &missing.job.model.classes["~L"];
    let error =
        class.line(&position([0.0; 3], [52.0, 0.0, 0.0], false), &missing.job.model.surroundings()).err().unwrap();
    assert!(error.to_string().contains("no convolution curve is called NONE"), "{error}");
}

#[test]
fn aqwa_line_table_ends_at_largest_expected_tension() {
    for options in ["", "-EA 7E8 -TMAX 5E6", "-EA 7E8 -TMAX 5E6 -K 1E9 1E10"] {
        let records = format!("~L CATENARY 170 0.02 -LEN 900 -DEP 150 {options}");
        let rows = with_line(&records, position([0.0; 3], [850.0, 0.0, -150.0], true), |l| l.tabulate("A").unwrap().0);
        let limit = if options.is_empty() { 5.0e4 * 170.0 } else { 5e6 };
        assert_near(rows.row(29)[3].number().unwrap(), limit, 1e-6);
        assert!(rows.row(29)[0].number().unwrap() < 900.0 * 1.05, "{:?}", rows.row(29)[0]);
    }
}
