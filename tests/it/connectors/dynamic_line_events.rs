//! What happens to rods during runs of the program, what makes other lines move as rods do, and that a run is always the same.

use crate::common;
use crate::common::run as runs;

use runs::{model, settings};
use std::f64::consts::TAU;
use std::fs;
use std::process::Command;
use windlass::session::Session;
use windlass_model::Model;
use windlass_solve::System;
use windlass_solve::results::along::lines_at_rest;
use windlass_solve::time::{NodeRow, Run};

const GRAVITY: f64 = 9.80665;
const WATER: f64 = 1025.0;

/// A session after records in metres and newtons, none of them refused.
fn run_records(records: &str) -> Session {
    let (mut session, _, _folder) = common::session();
    session.open("test", format!("&DIMEN -DIMEN METERS N\n{records}"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session
}

/// The nodes of the first line of a run at each stored instant, those that are there.
fn nodes(run: &Run) -> Vec<(f64, Vec<NodeRow>)> {
    let along = run.history.layout.links[0].along.clone().unwrap();
    run.history.rows().map(|row| (row[0], along.nodes(row).map(|n| n.1).collect())).collect()
}

/// Where the first node is at a time.
fn tip(rows: &[(f64, Vec<NodeRow>)], time: f64) -> [f64; 3] {
    rows.iter().find(|r| (r.0 - time).abs() < 1e-6).unwrap().1[0].position
}

/// Size of the force of the only connector on its first end, at rest (N).
fn pull(model: &Model) -> f64 {
    let system = System::new(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    all.iter().find(|c| c.connector.is_some()).unwrap().load.wrench.fixed_rows::<3>(0).norm()
}

/// A line from a body at (0, 0, -5) to an anchor at a distance.
fn moored_records(environment: &str, class: &str, reach: f64) -> String {
    format!(
        "{environment}\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n~L {class}\nCONNECTOR L -ANC 0 {reach} ~L *F\nEND\n"
    )
}

/// A line between two bodies.
fn line_between(environment: &str, class: &str, from: &str, to: &str) -> String {
    format!(
        "&ENV -DEPTH 1000 {environment}\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*A {from}\n\
         &DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*B {to}\n{class}\nCONNECTOR L ~L *A *B\nEND\n"
    )
}

#[test]
fn winch_lowers_and_hauls_load_to_target_length_and_holds_it() {
    // 5 t on 30 m of 10 kg/m in elements of 5 m, at rest at first
    let crane = "&ENV -DEPTH 500 -TIME 160 0.1\nMEDIT\n&DESCRIBE BODY CRANE -IGNORE X Y Z RX RY RZ\n*H 0 0 120\n\
         &DESCRIBE BODY LOAD -IGNORE X Y RX RY RZ\n*P 0 0 0\n#WEIGHT *P 49033.25 1 1 1\n\
         ~ROPE ROD 40 20 -LEN 30 -REFINE 6 -EI 0 -EA 5E7 -WTPLEN 100 -BUOY 0 -AX_DAMPING 1E6\nCONNECTOR ROPE ~ROPE *H *P\nEND\n\
         &INSTATE -LOCATE LOAD 0 0 89.97\n&EQUI\n";
    let lower = "&ACTION LOWER -AT 5 -WINCH ROPE 0.5 70\n";
    for (actions, rate, length, elements) in [
        (lower.to_string(), 0.5, 70.0, 10..=20),
        (format!("{lower}&ACTION HAUL -AT 90 -WINCH ROPE -1 50\n"), 0.5, 50.0, 8..=16),
        ("&ACTION HAUL -AT 5 -WINCH ROPE -0.5 12\n".to_string(), -0.5, 12.0, 2..=4),
    ] {
        let session = run_records(&format!("{crane}{actions}TDOM\n"));
        let run = session.job.run.as_ref().unwrap();
        let history = &run.history;
        let wound = history.series(history.layout.links[0].active + 1);
        let force = history.series(history.layout.wrench(0, 0).unwrap() + 2);
        let z = history.series(history.layout.body(1) + 2);
        let rows = nodes(run);
        let (last, [first, end]) = (z.len() - 1, [0, rows.len() - 1].map(|i| &rows[i].1));
        assert_eq!(wound[last], length);
        assert!(first.len() == 7 && elements.contains(&(end.len() - 1)), "{actions}: {}", end.len() - 1);
        assert!((end[end.len() - 1].arc / length - 1.0).abs() < 1e-12);
        // weight of load and rope, mean strain by the load and half the rope; what is left swings out by -AX_DAMPING
        assert!((force[last] / -(49033.25 + 100.0 * length) - 1.0).abs() < 1e-6, "{actions}: {}", force[last]);
        let below = 120.0 - length * (1.0 + (49033.25 + 50.0 * length) / 5e7);
        assert!((z[last] - below).abs() < 1e-5, "{actions}: {} {below}", z[last]);
        // from 30 s to 40 s it goes at the rate of the winch, and a thousandth more by the strain
        let speed = (z[300] - z[400]) / 10.0;
        assert!((speed / rate - 1.001).abs() < 1e-3, "{actions}: {speed}");
    }
}

#[test]
fn load_falling_into_stiff_line_never_rebounds_higher() {
    // 10 t let go where its line is slack: bounces of a tenth of a second and less, in steps that do not follow them
    for (step, start) in
        [(0.05, "0 0 110.2"), (0.1, "0 0 110.2"), (0.25, "0 0 110.2"), (0.5, "0 0 112"), (0.25, "60 0 150")]
    {
        let session = run_records(&format!(
            "&ENV -DEPTH 1000 -TIME 60 {step}\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*H 0 0 210\n\
             &DESCRIBE BODY LOAD -IGNORE Y RX RY RZ\n*P 0 0 0\n#WEIGHT *P 1E5 1 1 1\n\
             ~R ROD 60 30 -LEN 100 -REFINE 8 -EI 0\nCONNECTOR R ~R *H *P\nEND\n&INSTATE -LOCATE LOAD {start}\nTDOM\n"
        ));
        let history = &session.job.run.as_ref().unwrap().history;
        let z = history.series(history.layout.body(1) + 2);
        let highest = z.iter().fold(f64::MIN, |m, v| m.max(*v));
        // what the line weighs, 2 % of the load, falls as well
        assert!(highest <= z[0] + 0.02 * (210.0 - z[0]), "{step} {start}: {highest}");
    }
}

/// Nodes of a line of 300 m in 100 m of water that is let go at 10 s.
fn let_go(time: f64, step: f64, options: &str) -> Vec<(f64, Vec<NodeRow>)> {
    let records = moored_records(
        &format!("&ENV -DEPTH 100 -TIME {time} {step}"),
        &format!("ROD 120 60 -LEN 300 -REFINE 60 -EI 0 {options}"),
        250.0,
    );
    nodes(run_records(&format!("{records}&ACTION LET -AT 10 -RELEASE L\nTDOM\n")).job.run.as_ref().unwrap())
}

#[test]
fn released_line_end_fall_is_independent_of_step() {
    let [coarse, fine] = [0.1, 0.01].map(|step| let_go(13.0, step, ""));
    for (time, share) in [(11.0, 0.15), (12.0, 0.09), (13.0, 0.06)] {
        let fallen = [&coarse, &fine].map(|rows| -5.0 - tip(rows, time)[2]);
        // a step of 0.1 s does not see what the line springs back with, 0.2 m/s, and is late by less than itself
        assert!((fallen[0] / fallen[1] - 1.0).abs() < share, "{time}: {fallen:?}");
    }
}

#[test]
fn released_line_settles_on_seabed() {
    let rows = let_go(120.0, 0.1, "-FRICTION 0.8");
    let (last, before) = (&rows[rows.len() - 1].1, &rows[rows.len() - 101].1);
    for (node, earlier) in last.iter().zip(before) {
        // by its weight it sinks in by d = 2 % of 120 mm, and where it hung slack on a bottom that grows stiff over s = 2 % of an
        // element of 5 m, by sqrt(2 s d) = 22 mm; where it lies on itself no node holds another up
        assert!(node.clearance.abs() < 0.022, "{}", node.clearance);
        // a node sticks where friction holds it, with what tension it came there: at most 0.8 of the 3.8 kN that an element weighs
        assert!((0.0..0.8 * 3.8e3).contains(&node.effective), "{}", node.effective);
        assert!((0..3).all(|i| (node.position[i] - earlier.position[i]).abs() < 1e-3));
    }
}

#[test]
fn folded_chain_end_falls_with_gravity_and_then_faster() {
    // [TOMASZEWSKI-2006]: a chain folded tightly that keeps its energy is down in 0.847213 of
    // the time of free fall
    let length = 20.0;
    let class = format!("~L ROD 20 10 -LEN {length} -REFINE 200 -EI 0 -EA 1E7 -WTPLEN 50 -BUOY 0 -CD 0 0 0 -CA 0");
    let fold = |time: f64, step: f64| {
        let records = line_between(&format!("-TIME {time} {step}"), &class, "0 0 120", "0.2 0 120");
        nodes(run_records(&format!("{records}&ACTION LET -AT 0.5 -RELEASE L\nTDOM\n")).job.run.as_ref().unwrap())
    };
    // half the weight drew at the end: it springs back with T/(m c), c = sqrt(EA/m)
    let mass = 50.0 / GRAVITY;
    let back = 500.0 / (1e7f64 * mass).sqrt();
    let rows = fold(0.8, 0.0005);
    for t in [0.2, 0.3] {
        let fallen = 120.0 - tip(&rows, 0.5 + t)[2];
        let exact = 0.5 * GRAVITY * t * t + back * t;
        // the last half element, lighter than the others, is thrown somewhat faster
        assert!((fallen / exact - 1.0).abs() < 0.04, "{t}: {fallen} {exact}");
    }
    let rows = fold(2.5, 0.002);
    let lowest = rows
        .iter()
        .map(|r| (r.0 - 0.5, 120.0 - r.1[0].position[2]))
        .fold((0.0, 0.0), |m: (f64, f64), f| if f.1 > m.1 { f } else { m });
    // the ends are 0.2 m apart, and elements of 0.1 m turn over one by one
    let exact = 0.847_213 * (2.0 * length / GRAVITY).sqrt();
    assert!((lowest.0 / exact - 1.0).abs() < 0.025 && lowest.1 > 0.98 * length, "{lowest:?} {exact}");
}

#[test]
fn line_between_two_bodies_holds_them_at_catenary_span() {
    // each body on a spring to the ground: H by the springs, and the span is 2 H/w asinh(w L/2H) + H L/EA
    let (w, l, ea): (f64, f64, f64) = (1000.0, 400.0, 5e8);
    let records = format!(
        "&ENV -DEPTH 1000\nMEDIT\n*G -5 0 0\n*K 400 0 0\n&DESCRIBE BODY A -IGNORE Y Z RX RY RZ\n*A 0 0 0\n#WEIGHT *A 1E6 1 1 1\n\
         &DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*B 0 0 0\n#WEIGHT *B 1E6 1 1 1\n\
         ~L ROD 100 50 -LEN {l} -REFINE 80 -EI 0 -EA {ea} -WTPLEN {w} -BUOY 0\nCONNECTOR L ~L *A *B\n\
         ~S GSPR BOTH X 1E5 1E9 -LEN 0\nCONNECTOR S ~S *A *G\nCONNECTOR T ~S *B *K\nEND\n\
         &INSTATE -LOCATE A 0 0 100\n&INSTATE -LOCATE B 390 0 100\n&EQUI\n"
    );
    let session = run_records(&records);
    let [a, b] = [0, 1].map(|i| session.job.model.bodies[i].position.shift[0]);
    let h = 1e5 * (a + 5.0);
    // the springs agree to what EQUI leaves
    assert!((1e5 * (400.0 - b) / h - 1.0).abs() < 1e-3, "{a} {b}");
    let span = 2.0 * h / w * (w * l / (2.0 * h)).asinh() + h * l / ea;
    // 80 elements, of the second order
    assert!((b - a - span).abs() < 1e-5 * l, "{} {span}", b - a);
}

/// Amplitude of the force (N) over that of the motion (m) of a taut line of 100 m that is moved across itself at both ends alike in
/// 6 s, and its tension (N).
fn transfer_function(class: &str, dynamics: bool) -> (f64, f64) {
    let mut records = line_between("", class, "0 0 -10", "100 0 -10").replace(" -IGNORE X Y Z RX RY RZ", "");
    for body in ["A", "B"] {
        records.push_str(&format!("MEDIT\nPRESCRIBE {body} -SINUSOID Y 1E-3 6 -RAMP 30\nEND\n"));
    }
    let mut made = model(&records);
    made.connectors[0].dynamics = dynamics.then_some(60);
    let run = runs::run(&made, settings(90.0, 0.03), vec![]);
    let history = &run.history;
    let [a, b] = [0, 1].map(|end| history.series(history.layout.wrench(0, end).unwrap() + 1));
    let tension = history.series(history.layout.wrench(0, 0).unwrap())[0].abs();
    let late: Vec<f64> = a.iter().zip(&b).skip(2000).map(|(a, b)| a + b).collect();
    let most = late.iter().fold(f64::MIN, |m, v| m.max(*v));
    let least = late.iter().fold(f64::MAX, |m, v| m.min(*v));
    (0.5 * (most - least) / 1e-3, tension)
}

/// The same of a string of a mass per length (kg/m) under tension with a mass in its middle (kg).
fn string(mass: f64, middle: f64, tension: f64) -> f64 {
    let (w, half) = (TAU / 6.0, 50.0);
    let k = w * (mass / tension).sqrt();
    let (s, c) = (k * half).sin_cos();
    let inertia = 0.5 * middle * w * w;
    2.0 * tension * k * (tension * k * s + inertia * c) / (tension * k * c - inertia * s)
}

#[test]
fn aqwa_line_oscillates_with_added_mass_of_sections_and_joints() {
    let area = 0.02;
    // as heavy as water, so that it hangs straight; its mass is spread over 100 m, by 0.5 % longer than unstretched
    let own = WATER * area * 0.995;
    for (options, ca) in [("", 1.0), ("-CA 0", 0.0), ("-CA 2.5", 2.5)] {
        let class = format!("~L CATENARY {} {area} -LEN 99.5 -CD 0 -CX 0 {options}", WATER * area);
        let (found, tension) = transfer_function(&class, true);
        // 60 elements, and (w h)^2/12 of the step
        assert!((found / string(own * (1.0 + ca), 0.0, tension) - 1.0).abs() < 3e-3, "{options}: {found}");
    }
    for (joint, mass) in [("-CLUMP 200 0 300", 500.0), ("-CLUMP 500 0", 500.0), ("-BUOY 100 100.001 50", 150.0)] {
        let section = format!("~L CATENARY {} {area} -LEN 49.75 -CD 0 -CX 0 -CA 0", WATER * area);
        let (found, tension) = transfer_function(&format!("{section} {joint}\n{section}"), true);
        // the clump hangs down by up to a hundredth of the length
        assert!((found / string(own, mass, tension) - 1.0).abs() < 5e-3, "{joint}: {found}");
    }
}

#[test]
fn dynamic_catenary_has_no_maximum_tension() {
    let made = |most: &str| {
        model(&moored_records(
            "&ENV -DEPTH 100",
            &format!("CATENARY 170 0.0217 -LEN 300 -EA 8.5E8 -TMAX {most}"),
            283.5,
        ))
    };
    let mut limited = made("1E5");
    // the catenary itself holds the tension near -TMAX
    assert!(pull(&limited) < 1.2e5);
    limited.connectors[0].dynamics = Some(100);
    let exact = pull(&made("1E9"));
    // 100 elements
    assert!(exact > 1e6 && (pull(&limited) / exact - 1.0).abs() < 1e-4, "{} {exact}", pull(&limited));
}

#[test]
fn aqwa_section_bending_stiffness_matches_tensioned_beam() {
    // pinned under its weight: w L2/8T - w EI/T2 (1 - sech u), u = L/2 sqrt(T/EI); T is the pull across at an end
    let (mass, ei, l): (f64, f64, f64) = (100.0, 2e6, 30.0);
    let class = format!("~L CATENARY {mass} 0.001 -LEN 29.99 -EA 1E8 -EI {ei}");
    let mut made = model(&line_between("", &class, "0 0 50", "30 0 50"));
    made.connectors[0].dynamics = Some(40);
    let z = lines_at_rest(&made, &|_| true).unwrap().remove(0).get("Z").unwrap().numbers();
    let w = mass * GRAVITY;
    let t = (pull(&made).powi(2) - (0.5 * w * l).powi(2)).sqrt();
    let u = 0.5 * l * (t / ei).sqrt();
    let [cable, beam] = [0.0, w * ei / (t * t) * (1.0 - 1.0 / u.cosh())].map(|less| w * l * l / (8.0 * t) - less);
    // a slope of 8 % squared is 0.6 %, of which a sixth lengthens the line; bending takes 11 %
    assert!(((50.0 - z[20]) / beam - 1.0).abs() < 2e-3 && beam < 0.95 * cable, "{} {beam} {cable}", 50.0 - z[20]);
}

#[test]
fn line_on_sloping_bathymetry_matches_exact_catenary_on_slope() {
    let grid = "&BATHYMETRY SLOPE -DEPTHS\nX -1000 1000\nY -1000 50 150\nY 1000 50 150\nEND\n&ENV -DEPTH 100 -BATHYMETRY SLOPE";
    let exact = pull(&model(&moored_records(grid, "B_CAT 120 EXACT -LEN 300 -SLOPE 0.05 -DEPANCHOR 113", 260.0)));
    let rod = "ROD 120 60 -LEN 300 -REFINE 200 -EI 0 -SEABED 1E7";
    let on_grid = pull(&model(&moored_records(grid, rod, 260.0)));
    let own = pull(&model(&moored_records("&ENV -DEPTH 100", &format!("{rod} -SLOPE 0.05 -DEPANCHOR 113"), 260.0)));
    // 200 elements, 0.07 mm of sinking in
    assert!((on_grid / exact - 1.0).abs() < 1e-4, "{on_grid} {exact}");
    assert!((on_grid / own - 1.0).abs() < 1e-9, "{on_grid} {own}");
}

#[test]
fn line_uses_class_depth_and_current_in_connector_forces_too() {
    let class = "ROD 120 60 -LEN 300 -REFINE 100 -EI 0 -DEPANCHOR 80";
    let table = lines_at_rest(&model(&moored_records("&ENV -DEPTH 100", class, 260.0)), &|_| true).unwrap().remove(0);
    let lowest = table.get("Z").unwrap().numbers().iter().fold(0.0, |m: f64, z| m.min(*z));
    // 20 mm is what it sinks in where it comes down
    assert!((-80.02..=-80.0).contains(&lowest), "{lowest}");
}

#[test]
fn connector_forces_include_current_on_line() {
    let class = "ROD 120 60 -LEN 300 -REFINE 100 -EI 0";
    let (mut session, screen, _folder) = common::session();
    let records = moored_records("&ENV -DEPTH 100 -CURRENT 2 270", class, 260.0);
    session.open("test", format!("&DIMEN -DIMEN METERS N\n{records}&STATUS F_CONNECTOR"));
    session.run();
    let text = screen.text();
    let row: Vec<&str> = text.lines().find(|l| l.starts_with(" L ")).unwrap().split_whitespace().collect();
    let reported: Vec<f64> = row[4..7].iter().map(|v| v.parse().unwrap()).collect();
    let model = &session.job.model;
    let system = System::new(model, &[]).unwrap();
    let held = system.contributions(&system.state(model).poses).unwrap()[0].load.wrench;
    // whole newtons are printed
    assert!(held[1] > 1e3 && (0..3).all(|i| (reported[i] - held[i]).abs() < 1.0), "{reported:?} {held}");
}

/// A vessel on four rods in a sea; a winch and a line that is let go.
const SPREAD: &str = "&DEVICE -SET_DATE 2026-11-21\n&DIMEN -DIMEN METERS K-NTS\n\
     &ENV -DEPTH 100 -SEA JONSWAP 180 4 9 -CURRENT 0.5 180 -TIME 30 0.25 -RAMP 10\nMEDIT\n\
     &DESCRIBE BODY SHIP -IGNORE Z RX RY\n*CG 0 0 0\n#WEIGHT *CG 16000 15 65 65\n#DAMP *CG 100 100 0 0 0 5000\n\
     ~ROD ROD 120 60 -LEN 400 -REFINE 30 -EI 0\n~PIPE ROD 120 20 -LEN 400 -REFINE 30\n\
     *F0 20 0 -5\n*F1 0 10 -5\n*F2 -20 0 -5\n*F3 0 -10 -5\n\
     CONNECTOR R0 -ANC 0 370 ~ROD *F0\nCONNECTOR R1 -ANC 90 370 ~PIPE *F1\nCONNECTOR R2 -ANC 180 370 ~ROD *F2\n\
     CONNECTOR R3 -ANC 270 370 ~PIPE *F3\nEND\n\
     &INSTATE -LOCATE SHIP 3 2 0 0 0 1\n&ACTION PAY -AT 5 -WINCH R2 0.5 403\n&ACTION GONE -AT 20.1 -RELEASE R1\n";

#[test]
fn output_is_identical_with_one_and_two_threads() {
    let made = |threads: &str| {
        let folder = tempfile::tempdir().unwrap();
        let posts = "TDOM\nPRCPOST\nCONFORCE R@\nSTATISTIC 1 Mag@\nVIEW\nEND\nROD R1\nROD R2\nEND\n";
        fs::write(folder.path().join("job.cif"), format!("{SPREAD}{posts}")).unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_windlass"));
        let out = command.arg("job.cif").current_dir(folder.path()).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
        assert!(out.stdout.len() > 10_000);
        (out.stdout, fs::read(folder.path().join("job.ans/TDOM.run")).unwrap())
    };
    assert!(made("1") == made("2"));
}

fn values(session: &Session) -> Vec<u64> {
    session.job.run.as_ref().unwrap().history.values.iter().map(|v| v.to_bits()).collect()
}

#[test]
fn dynamic_line_run_restarts_with_digits_of_uninterrupted_run() {
    let (mut whole, _, folder) = common::session();
    whole.open("test", format!("{SPREAD}TDOM"));
    whole.run();
    assert_eq!(whole.errors, 0, "{:?}", whole.reports);
    let bytes = fs::read(folder.path().join("job.ans/TDOM.run")).unwrap();
    for share in [0.3, 0.5, 0.8, 0.99] {
        let (mut again, _, folder) = common::session();
        fs::create_dir_all(folder.path().join("job.ans")).unwrap();
        let cut = &bytes[..(bytes.len() as f64 * share) as usize];
        fs::write(folder.path().join("job.ans/TDOM.run"), cut).unwrap();
        again.open("test", format!("{SPREAD}TDOM -RESTART"));
        again.run();
        assert_eq!(again.errors, 0, "{:?}", again.reports);
        assert!(values(&again) == values(&whole), "cut at {share}");
    }
}

/// A load of 5 t on 30 m of 10 kg/m in elements of 0.5 m, from a winch at 120 m, in steps of 0.5 s.
fn fine_winch(action: &str) -> String {
    format!(
        "&ENV -DEPTH 500 -TIME 60 0.5\nMEDIT\n&DESCRIBE BODY CRANE -IGNORE X Y Z RX RY RZ\n*H 0 0 120\n\
         &DESCRIBE BODY LOAD -IGNORE X Y RX RY RZ\n*P 0 0 0\n#WEIGHT *P 49033.25 1 1 1\n\
         ~ROPE ROD 40 20 -LEN 30 -REFINE 60 -EI 0 -EA 5E7 -WTPLEN 100 -BUOY 0 -AX_DAMPING 1E6\nCONNECTOR ROPE ~ROPE *H *P\nEND\n\
         &INSTATE -LOCATE LOAD 0 0 89.97\n&EQUI\n&ACTION WIND -AT 5 -WINCH ROPE {action}\nTDOM\n"
    )
}

#[test]
fn winch_adds_and_removes_as_many_elements_as_its_rate_needs() {
    // 2 m/s: two elements of half a metre in every step
    for (action, length) in [("2 80", 80.0), ("-2 6", 6.0)] {
        let session = run_records(&fine_winch(action));
        let run = session.job.run.as_ref().unwrap();
        let history = &run.history;
        for (time, row) in nodes(run) {
            for pair in row.windows(2) {
                let element = pair[1].arc - pair[0].arc;
                // as `wind` has them: from half of an element of the class to one and a half
                assert!((0.249..=0.751).contains(&element), "{action} {time}: {element}");
            }
        }
        let force = history.series(history.layout.wrench(0, 0).unwrap() + 2);
        let z = history.series(history.layout.body(1) + 2);
        let last = z.len() - 1;
        // as where a winch winds slowly: weight of load and rope, and mean strain
        assert!((force[last] / -(49033.25 + 100.0 * length) - 1.0).abs() < 1e-5, "{action}: {}", force[last]);
        let below = 120.0 - length * (1.0 + (49033.25 + 50.0 * length) / 5e7);
        assert!((z[last] - below).abs() < 1e-4, "{action}: {} {below}", z[last]);
        // in between it goes at the rate of the winch, a thousandth more by the strain
        let speed = (z[20] - z[30]) / 5.0;
        let rate = if length > 30.0 { 2.0 } else { -2.0 };
        assert!((speed / rate - 1.001).abs() < 2e-3, "{action}: {speed}");
    }
}

#[test]
fn winch_needing_thousands_of_elements_a_step_is_reported_early() {
    let (mut session, _, _folder) = common::session();
    session.open("test", format!("&DIMEN -DIMEN METERS N\n{}", fine_winch("2000 70")));
    session.run();
    let reported = format!("{:?}", session.reports);
    assert_eq!(session.errors, 1, "{reported}");
    assert!(reported.contains("ROPE") && reported.contains("4000 parts of the step"), "{reported}");
    assert!(session.job.run.is_none());
}

#[test]
fn winch_that_cannot_reach_its_length_ends_run_at_start() {
    for (action, reported) in [("0.5 20", "30 m"), ("-0.5 40", "30 m")] {
        let (mut session, _, _folder) = common::session();
        session.open("test", format!("&DIMEN -DIMEN METERS N\n{}", fine_winch(action)));
        session.run();
        let reports = format!("{:?}", session.reports);
        assert!(session.errors == 1 && reports.contains(reported) && reports.contains("never comes to"), "{reports}");
    }
}

#[test]
fn released_line_is_wound_no_further() {
    // until the load falls freely, before the rope whips
    let records =
        fine_winch("0.5 60").replace("-TIME 60", "-TIME 18").replace("TDOM", "&ACTION OFF -AT 15 -RELEASE ROPE\nTDOM");
    let session = run_records(&records);
    for (time, row) in nodes(session.job.run.as_ref().unwrap()).iter().filter(|r| r.0 > 5.0) {
        let long = row.last().unwrap().arc;
        assert!((long - (30.0 + 0.5 * (time.min(15.0) - 5.0))).abs() < 1e-6, "{time}: {long}");
    }
}
