//! Sections of dynamic lines: both sides of a junction, tubes that do not bend, tensions at ends, and the bottom under
//! them, against closed forms and against the same line laid the other way.

use crate::common;
use crate::common::run as runs;

use runs::{model, run, settings};
use std::f64::consts::{FRAC_PI_4, PI};
use std::sync::atomic::Ordering;
use windlass_base::table::Table;
use windlass_model::Model;
use windlass_signal::line::fatigue::TubeCircumference;
use windlass_signal::line::lrfd::LrfdFactors;
use windlass_solve::System;
use windlass_solve::results::along::{Code, LineResults, check, envelope, fatigue_along, lines_at_rest, shape};
use windlass_solve::results::events;

const RHO: f64 = 1025.0;
const G: f64 = 9.80665;

/// Forces of a line on the bodies it is fixed to, at rest (N).
fn pulls(model: &Model) -> Vec<[f64; 3]> {
    let system = System::new(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    let own = all.iter().filter(|c| c.connector.is_some());
    own.map(|c| [c.load.wrench[0], c.load.wrench[1], c.load.wrench[2]]).collect()
}

fn size(force: &[f64; 3]) -> f64 {
    force.iter().map(|v| v * v).sum::<f64>().sqrt()
}

fn at_rest(model: &Model) -> Table {
    lines_at_rest(model, &|_| true).unwrap().remove(0)
}

fn column(table: &Table, name: &str) -> Vec<f64> {
    table.get(name).unwrap_or_else(|| panic!("{name}")).numbers()
}

/// A line between two bodies that are held, of classes from the first to the second.
fn line_between(environment: &str, classes: &[&str], [from, to]: [&str; 2]) -> String {
    let records: String = classes.iter().map(|class| format!("~L {class}\n")).collect();
    format!(
        "{environment}\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*A {from}\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*B {to}\n\
         {records}CONNECTOR L ~L *A *B\nEND\n"
    )
}

/// A thin and a thick pipe in waves, the thin one at the upper end, laid from the one or the other end.
fn junction(turned: bool) -> Model {
    let (thin, thick) = (
        "ROD 300 10 -LEN 92.5 -REFINE 6 -FYIELD 450 -C_SN DNV_D_FREE",
        "ROD 300 40 -LEN 92.5 -REFINE 6 -FYIELD 350 -C_SN DNV_D_FREE",
    );
    let positions = ["0 0 -5", "150 0 -100"];
    let (classes, positions) =
        if turned { ([thick, thin], [positions[1], positions[0]]) } else { ([thin, thick], positions) };
    model(&line_between("&ENV -DEPTH 300 -SEA REGULAR 180 4 9", &classes, positions))
}

#[test]
fn junction_reports_side_of_higher_utilisation_in_either_direction() {
    let used = |table: &Table, turned: bool| {
        let mut all = column(table, "Utilisation");
        if turned {
            all.reverse();
        }
        all
    };
    let [one, other] = [false, true].map(|turned| used(&at_rest(&junction(turned)), turned));
    for (a, b) in one.iter().zip(&other) {
        // statics are solved to 1e-9 of the largest force, from two starts
        assert!((a / b - 1.0).abs() < 1e-4, "{one:?} {other:?}");
    }
    // bending and axial stress of the thin side there, without the pressure of 5 bar outside that adds the rest
    let table = at_rest(&junction(false));
    let (moment, tension, z) = (column(&table, "Moment")[6], column(&table, "Tension")[6], column(&table, "Z")[6]);
    let (b, a): (f64, f64) = (0.15, 0.14);
    let pe = -RHO * G * z;
    let wall = (tension - pe * PI * b * b) / (PI * (b * b - a * a));
    let bending = moment.abs() * b / (PI / 4.0 * (b.powi(4) - a.powi(4)));
    let hoop = -2.0 * pe * b * b / (b * b - a * a);
    // at the inner surface nothing acts radially
    let mises = |axial: f64| (axial * axial - axial * hoop + hoop * hoop).sqrt();
    let inner = mises(wall + bending * a / b).max(mises(wall - bending * a / b));
    assert!(one[6] * 450e6 >= inner && one[6] * 450e6 < 1.2 * inner, "{} {inner}", one[6] * 450e6);

    let runs = [false, true].map(|turned| run(&junction(turned), settings(18.0, 0.25), vec![]));
    let tables = runs.each_ref().map(|run| {
        let line = LineResults::find(run, "L").unwrap();
        let all = events(&run.history, None).unwrap();
        [
            envelope(&line, &all).unwrap(),
            shape(&line, &all[40]).unwrap(),
            check(&line, &Code::Lrfd(LrfdFactors::default(), 0.0), &all).unwrap(),
            fatigue_along(&line, &run.model.fatigue, (&TubeCircumference::default(), 1.0), &all).unwrap(),
        ]
    });
    let [ahead, back] = &tables;
    for ((a, b), name) in ahead.iter().zip(back).zip(["Utilisation", "Utilisation", "Utilisation", "Damage"]) {
        let (a, mut b) = (column(a, name), column(b, name));
        b.reverse();
        // runs of the same line, each solved to 1e-6 of an element; of damage the points round the tube begin elsewhere
        let share = if name == "Damage" { 0.3 } else { 0.01 };
        assert!((a[6] / b[6] - 1.0).abs() < share, "{name}: {a:?} {b:?}");
        // the junction has what the thin side has beside it, not the half of that
        assert!(a[6] > 0.7 * a[5], "{name}: {a:?}");
    }
}

#[test]
fn end_tension_matches_line_pull() {
    // a rope that bows under its weight, in few elements
    let model =
        model(&line_between("&ENV -DEPTH 1000", &["ROD 120 60 -EI 0 -LEN 200 -REFINE 8"], ["0 0 -5", "150 0 -60"]));
    let tension = column(&at_rest(&model), "Tension");
    let ends = [tension[0], tension[8]];
    // weight in water of half an element, which pulls across the line: (W / T)^2 / 2
    let half = (7850.0 - RHO) * FRAC_PI_4 * 0.0144 * G * 12.5;
    for (reported, pull) in ends.iter().zip(pulls(&model)) {
        let pull = size(&pull);
        assert!((reported / pull - 1.0).abs() < 0.5 * (half / pull).powi(2), "{reported} {pull}");
    }
}

#[test]
fn slack_rope_carries_no_compression_at_its_ends() {
    for length in [210.0, 260.0, 320.0] {
        let class = format!("ROD 300 20 -EI 0 -LEN {length} -REFINE 12");
        let model = model(&line_between("&ENV -DEPTH 60", &[&class], ["0 0 -5", "150 0 -60"]));
        let tension = column(&at_rest(&model), "Tension");
        assert!(tension.iter().all(|t| *t >= 0.0), "{tension:?}");
    }
}

#[test]
fn pipe_without_bending_keeps_contents_pressure_and_heat() {
    // 400 mm by 20 mm, upright, a thousandth longer than free between its ends: Te = E A (e - alpha dT) + (1 - 2 nu)(pe Ae - pi Ai)
    let (b, a): (f64, f64) = (0.2, 0.18);
    let (outside, inside) = (PI * b * b, PI * a * a);
    let wall = outside - inside;
    let class = "ROD 400 20 -EI 0 -LEN 20 -REFINE 20 -EMOD 210000 -POI 0.3 -ALPHA 1.2E-5";
    let (warmer, pressure, filled) = (15.0, 10.0, 800.0);
    let hot = format!(
        "T_PRESSURE HOT {warmer} {pressure} -AT -500 -DENSITY {filled}\nEND\n&ENV -DEPTH 1000 -T_PRESSURE HOT\n"
    );
    let records = line_between("&ENV -DEPTH 1000", &[class], ["0 0 -489.99", "0 0 -510.01"]);
    let [empty, full] = [records.clone(), records.replace("END\n", &hot)].map(|records| model(&records));
    let middle = |model: &Model, name: &str| column(&at_rest(model), name)[10];
    let pe = RHO * G * 500.0;
    let force = |model: &Model, heat: f64, pi: f64| {
        let effective = 2.1e11 * wall * (1e-3 - heat) + 0.4 * (pe * outside - pi * inside);
        // half the submerged weight of an element, 1e-3 of 3.5 MN
        assert!((middle(model, "Tension") / effective - 1.0).abs() < 1e-3, "{} {effective}", middle(model, "Tension"));
        let reported = middle(model, "Wall") - middle(model, "Tension");
        assert!((reported / (pi * inside - pe * outside) - 1.0).abs() < 1e-3, "{reported}");
    };
    force(&empty, 0.0, 0.0);
    force(&full, warmer * 1.2e-5, 1e6 * pressure);
    let weight = |model: &Model| pulls(model).iter().map(|f| -f[2]).sum::<f64>();
    let contents = filled * inside * G * 20.0;
    assert!(
        ((weight(&full) - weight(&empty)) / contents - 1.0).abs() < 1e-3,
        "{} {contents}",
        weight(&full) - weight(&empty)
    );
    // a chain or rope: a bar has no contents, and is reported without a wall
    let bar =
        model(&line_between("&ENV -DEPTH 1000", &["ROD 100 50 -EI 0 -LEN 20 -REFINE 4"], ["0 0 -489", "0 0 -508"]));
    assert!(at_rest(&bar).get("Shear").is_none());
}

#[test]
fn grid_seabed_supports_line_like_flat_seabed() {
    let grid = "&BATHYMETRY GRID -DEPTHS\nX -1000 1000\nY -1000 60 60\nY 1000 60 60\nEND\n";
    let rod = |environment: &str| {
        let class = "ROD 120 60 -EI 0 -LEN 185 -REFINE 20";
        model(&line_between(&format!("{grid}{environment}"), &[class], ["0 0 -5", "150 0 -60"]))
    };
    let [flat, charted] = ["&ENV -DEPTH 60", "&ENV -BATHYMETRY GRID"].map(|e| at_rest(&rod(e)));
    for name in ["Z", "Tension", "Clearance"] {
        for (a, b) in column(&flat, name).iter().zip(column(&charted, name)) {
            // of tensions of 50 kN statics leave 1e-9, from another start
            assert!((a - b).abs() < 1e-4 * (1.0 + a.abs()), "{name}: {a} {b}");
        }
    }
    assert!(column(&charted, "Clearance").iter().any(|c| *c < 0.0));
}

#[test]
fn equilibrium_search_may_be_interrupted() {
    let model =
        model(&line_between("&ENV -DEPTH 1000", &["ROD 120 60 -EI 0 -LEN 400 -REFINE 50"], ["0 0 -5", "150 0 -60"]));
    model.interrupt.store(true, Ordering::Relaxed);
    let reported = lines_at_rest(&model, &|_| true).unwrap_err();
    assert_eq!(reported.error.to_string(), "interrupted");
    assert!(reported.error.lasting);
}

#[test]
fn grounded_line_in_current_matches_line_on_bathymetry() {
    let bow = |chart: &str| {
        let environment = format!(
            "&BATHYMETRY FLAT\nX -1000 0 1000\nY -1000 -50 -50 -50\nY 0 -50 -50 -50\nY 1000 -50 -50 -50\nEND\n\
             &ENV -DEPTH 50 -CURRENT 1.0 90 {chart}"
        );
        let rope = "ROD 100 10 -LEN 100 -REFINE 20 -EI 0 -WTPLEN 100 -CD 1.2 0";
        let table = at_rest(&model(&line_between(&environment, &[rope], ["0 0 -49.9", "99 0 -49.9"])));
        column(&table, "Y")
    };
    let (flat, charted) = (bow(""), bow("-BATHYMETRY FLAT"));
    // a rope of 100 m over 99 m bows by about 0.61 of the root of its slack times its length, toward -Y
    assert!((flat[10] / -(3.0f64 / 8.0 * 99.0).sqrt() - 1.0).abs() < 0.02, "{}", flat[10]);
    for (a, b) in flat.iter().zip(&charted) {
        assert!((a - b).abs() < 1e-6, "{a} {b}");
    }
}

#[test]
fn seabed_follows_anchor_for_dynamic_and_quasi_static_lines() {
    for depth in [80.0, 120.0] {
        let at = |dynamics: &str| {
            let records = format!(
                "&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY S -IGNORE X Y Z RX RY RZ\n*F 0 0 0\n#WEIGHT *F 1E7 5 5 5\n\
                 ~C B_CAT 76 EXACT -LEN 250 -DEPANCHOR 100\nCONNECTOR A -ANC 180 210 ~C *F\n&CONNECTOR A -ANCHOR -210 0 {} {dynamics}\nEND\n",
                -depth
            );
            pulls(&model(&records)).remove(0)
        };
        let (still, moving) = (at(""), at("-DYNAMICS 200"));
        // elements of 1.25 m, and a bottom into which it presses itself
        assert!((size(&moving) / size(&still) - 1.0).abs() < 2e-3, "{depth}: {moving:?} {still:?}");
    }
}

#[test]
fn unrestrained_line_is_refused() {
    for (class, reported) in [
        ("ROD 100 10 -LEN 100 -REFINE 20 -EI 0 -CLAMP FIRST 90", "its segment does not bend"),
        ("ROD 100 10 -LEN 100 -REFINE 20 -CLUMP_DRAG 5 10", "no clump or buoy"),
        ("ROD 100 10 -LEN 100 -REFINE 20 -CLAMP FIRST 720", "straight down"),
        ("ROD 100 10 -LEN 100 -REFINE 20 -DISPLEN -5", "must be zero or more"),
    ] {
        let (mut session, _, _folder) = common::session();
        session.open("records", format!("&DIMEN -DIMEN METERS N\nMEDIT\n~L {class}\nEND\n"));
        session.run();
        let reports = format!("{:?}", session.reports);
        assert!(session.errors == 1 && reports.contains(reported), "{reports}");
    }
}

#[test]
fn node_with_clump_has_larger_adjacent_tension() {
    // 50 m of 200 N/m in water, 30 kN, and 50 m more, upright and taut
    let weight = 200.0 + RHO * G * FRAC_PI_4 * 0.05 * 0.05;
    let class = |end: &str| format!("ROD 50 25 -LEN 50 -REFINE 10 -EI 0 -WTPLEN {weight} {end}");
    let records = line_between("&ENV -DEPTH 200", &[&class("-CLUMP 30000"), &class("")], ["0 0 -20", "0 0 -120.1"]);
    let tension = column(&at_rest(&model(&records)), "Tension");
    assert!((tension[0] - 200.0 * 50.0 - tension[10]).abs() < 1.0, "{} {}", tension[0], tension[10]);
    // the mean of the two elements of 5 m below it is that of the node between
    let below = tension[11] + 200.0 * 5.0;
    assert!((tension[10] - below - 30000.0).abs() < 1.0, "{} {below}", tension[10]);
}

#[test]
fn line_without_second_end_position_is_refused() {
    let (mut session, _, _folder) = common::session();
    let records = "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY S -IGNORE X Y Z RX RY RZ\n*F 0 0 0\n#WEIGHT *F 1E7 5 5 5\n\
                   ~C ROD 100 10 -LEN 150 -REFINE 20\nCONNECTOR A ~C *F\nEND\n&STATUS ROD\n";
    session.open("records", records.to_string());
    session.run();
    let reports = format!("{:?}", session.reports);
    assert!(session.errors == 1 && reports.contains("has no place"), "{reports}");
}

#[test]
fn class_listing_has_stiffness_of_its_lines() {
    for (law, ea) in [("-EA 3E6", 3e6), ("-STRETCH 0 0 2E4 0.01 6E4 0.02", 2e6)] {
        let (mut session, screen, _folder) = common::session();
        session.open(
            "records",
            format!("&DIMEN -DIMEN METERS N\nMEDIT\n~L ROD 100 50 -LEN 100 -EI 0 {law}\nEND\n&STATUS CLASS ~L\n"),
        );
        session.run();
        let shown = format!("{ea:.4E}").replace('E', "E+0");
        assert!(session.errors == 0 && screen.text().contains(&shown), "{shown} {}", screen.text());
    }
}

#[test]
fn slack_pipe_lays_sideways_instead_of_folding() {
    for (bending, elements, length) in [(1e4, 50, 207.0), (1e5, 100, 248.0), (3.57e7, 40, 400.0)] {
        let class = format!("ROD 300 20 -LEN {length} -REFINE {elements} -EI {bending} -EA 3E8 -WTPLEN 1200");
        let table = at_rest(&model(&line_between("&ENV -DEPTH 100", &[&class], ["0 0 -5", "100 0 -100"])));
        let [x, y, z] = ["X", "Y", "Z"].map(|axis| column(&table, axis));
        let aside = y.iter().fold(0.0f64, |most, y| most.max(y.abs()));
        assert!(aside > 10.0, "{bending} {aside}");
        // as long as it is, and on the bottom but for what it presses itself in
        let along: f64 = (1..x.len())
            .map(|i| ((x[i] - x[i - 1]).powi(2) + (y[i] - y[i - 1]).powi(2) + (z[i] - z[i - 1]).powi(2)).sqrt())
            .sum();
        assert!((along / length - 1.0).abs() < 1e-3, "{bending} {along}");
        assert!(z.iter().all(|z| *z > -100.2), "{bending} {z:?}");
    }
}

#[test]
fn clump_on_seabed_sinks_no_deeper_with_finer_mesh() {
    let line = |kind: &str, refine: [usize; 2]| {
        let [first, second] = refine.map(|n| if n > 0 { format!(" -REFINE {n} -EI 0") } else { String::new() });
        format!(
            "{kind} -LEN 150 -WTPLEN 1000 -BUOY 0 -CLUMP 5E5{first}\n~L {kind} -LEN 100 -WTPLEN 1000 -BUOY 0{second}"
        )
    };
    let pulls = [line("ROD 90 45", [15, 10]), line("ROD 90 45", [150, 100]), line("B_CAT 90 EXACT", [0, 0])].map(|class| {
        let (mut session, screen, _folder) = common::session();
        let records = format!(
            "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY S -IGNORE X Y Z RX RY RZ\n*T 0 0 -5\n~L {class}\n\
             CONNECTOR A -ANC 0 200 ~L *T\nEND\n&STATUS F_CONNECTOR\n"
        );
        session.open("records", records);
        session.run();
        assert_eq!(session.errors, 0, "{:?}", session.reports);
        let text = screen.text();
        let line = text.lines().rev().find(|l| l.contains("~L ")).unwrap();
        let number = |at: usize| line.split_whitespace().nth(at).unwrap().parse::<f64>().unwrap();
        [number(7), number(8)]
    });
    println!("{pulls:?}");
    for (rod, within) in pulls[..2].iter().zip([1e-2, 5e-3]) {
        for (rod, catenary) in rod.iter().zip(&pulls[2]) {
            assert!((rod / catenary - 1.0).abs() < within, "{rod} {catenary}");
        }
    }
}
