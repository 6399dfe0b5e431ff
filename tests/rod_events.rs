//! What happens to rods during runs of the program, what makes other lines move as rods do, and that a run is always the same.

#![allow(clippy::unwrap_used)]

#[allow(dead_code)]
mod common;
#[allow(dead_code)]
#[path = "common/run.rs"]
mod runs;

use runs::{model, settings};
use std::f64::consts::{FRAC_PI_4, TAU};
use std::fs;
use std::process::Command;
use windlass::model::Model;
use windlass::session::Session;
use windlass::solve::System;
use windlass::solve::results::along::lines_at_rest;
use windlass::solve::time::{NodeRow, Run};

const GRAVITY: f64 = 9.80665;
const WATER: f64 = 1025.0;

/// A session after records in metres and newtons, none of them refused.
fn after(records: &str) -> Session {
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

/// Forces of the first connector on its ends, which are both bodies, at rest (N).
fn ends(model: &Model) -> [[f64; 3]; 2] {
    let system = System::of(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    let mut found = all.iter().filter(|c| c.connector.is_some()).map(|c| c.load.wrench);
    [0, 1].map(|_| found.next().map(|w| [w[0], w[1], w[2]]).unwrap())
}

/// Both together.
fn sum(model: &Model) -> [f64; 3] {
    let [a, b] = ends(model);
    [0, 1, 2].map(|i| a[i] + b[i])
}

/// A line between two bodies.
fn between(environment: &str, class: &str, from: &str, to: &str) -> String {
    let mut records = class.to_string();
    if !records.ends_with('\n') {
        records.push('\n');
    }
    format!(
        "&ENV -DEPTH 1000 {environment}\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*A {from}\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*B {to}\n\
         {records}CONNECTOR L ~L *A *B\nEND\n"
    )
}

/// A load of 5 t on a rope of 30 m in 6 elements that a winch handles.
fn crane(time: f64, step: f64, actions: &str) -> Session {
    after(&format!(
        "&ENV -DEPTH 500 -TIME {time} {step}\nMEDIT\n&DESCRIBE BODY CRANE -IGNORE X Y Z RX RY RZ\n*H 0 0 120\n\
         &DESCRIBE BODY LOAD -IGNORE X Y RX RY RZ\n*P 0 0 0\n#WEIGHT *P 49033.25 1 1 1\n\
         ~ROPE ROD 40 20 -LEN 30 -REFINE 6 -EI 0 -EA 5E7 -WTPLEN 100 -BUOY 0 -AX_DAMPING 1E6\nCONNECTOR ROPE ~ROPE *H *P\nEND\n\
         &INSTATE -LOCATE LOAD 0 0 89.97\n&EQUI\n{actions}TDOM\n"
    ))
}

#[test]
fn a_winch_lowers_a_load_to_the_length_it_is_told_and_holds_its_weight_there() {
    for (actions, length) in [
        ("&ACTION LOWER -AT 5 -WINCH ROPE 0.5 70\n", 70.0),
        ("&ACTION LOWER -AT 5 -WINCH ROPE 0.5 70\n&ACTION HAUL -AT 90 -WINCH ROPE -1 50\n", 50.0),
        ("&ACTION HAUL -AT 5 -WINCH ROPE -0.5 12\n", 12.0),
    ] {
        let session = crane(160.0, 0.1, actions);
        let run = session.job.run.as_ref().unwrap();
        let history = &run.history;
        let wound = history.series(history.layout.links[0].active + 1);
        let rows = nodes(run);
        let count = |r: usize| rows[r].1.len() - 1;
        let force = history.series(history.layout.wrench(0, 0).unwrap() + 2);
        let z = history.series(history.layout.body(1) + 2);
        let last = z.len() - 1;
        // the mean strain is that of the load and half the rope
        let below = 120.0 - length * (1.0 + (49033.25 + 50.0 * length) / 5e7);
        println!(
            "{actions} {} {} elements {} -> {} force {} z {} arc {}",
            wound[last],
            length,
            count(0),
            count(last),
            force[last] / -(49033.25 + 100.0 * length) - 1.0,
            z[last] - below,
            rows[last].1.last().unwrap().arc
        );
        let speed = (z[400] - z[300]) / 10.0;
        println!("  speed {speed}");
    }
}

/// A line of 300 m in 100 m of water that is let go at 10 s.
fn let_go(time: f64, step: f64, options: &str) -> Session {
    after(&format!(
        "&ENV -DEPTH 100 -TIME {time} {step}\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n\
         ~L ROD 120 60 -LEN 300 -REFINE 60 -EI 0 {options}\nCONNECTOR L -ANC 0 250 ~L *F\nEND\n&ACTION LET -AT 10 -RELEASE L\nTDOM\n"
    ))
}

#[test]
fn the_end_of_a_line_that_is_let_go_falls_as_it_does_with_a_finer_step() {
    for step in [0.1, 0.05, 0.02, 0.005, 0.001] {
        let session = let_go(13.0, step, "");
        let rows = nodes(session.job.run.as_ref().unwrap());
        println!("let go {step}: {:?}", [10.0, 10.5, 11.0, 12.0, 13.0].map(|t| tip(&rows, t)));
    }
}

#[test]
fn a_line_that_is_let_go_comes_to_rest_on_the_bottom() {
    let session = let_go(120.0, 0.1, "-FRICTION 0.8");
    let rows = nodes(session.job.run.as_ref().unwrap());
    let last = &rows.last().unwrap().1;
    let before = &rows[rows.len() - 101].1;
    let moved = last
        .iter()
        .zip(before)
        .map(|(a, b)| (0..3).map(|i| (a.position[i] - b.position[i]).abs()).fold(0.0, f64::max))
        .fold(0.0, f64::max);
    println!(
        "rest: clearance {:?} tension {:?} moved {moved}",
        last.iter().map(|n| n.clearance).fold(0.0, |m: f64, c| m.max(c.abs())),
        last.iter().map(|n| n.effective).fold(0.0, |m: f64, c| m.max(c.abs()))
    );
    println!("tip {:?}", last[0].position);
}

#[test]
fn the_end_of_a_folded_chain_falls_with_gravity_and_then_faster() {
    let (length, apart) = (20.0, 0.2);
    for (n, step) in [(100, 0.01), (100, 0.002), (200, 0.002)] {
        let class =
            format!("~L ROD 20 10 -LEN {length} -REFINE {n} -EI 0 -EA 1E7 -WTPLEN 50 -BUOY 0 -CD 0 0 0 -CA 0\n");
        let records = between(&format!("-TIME 2.5 {step}"), &class, "0 0 120", &format!("{apart} 0 120"));
        let session = after(&format!("{records}&ACTION LET -AT 0.5 -RELEASE L\nTDOM\n"));
        let rows = nodes(session.job.run.as_ref().unwrap());
        let fallen: Vec<(f64, f64)> = rows.iter().map(|r| (r.0 - 0.5, 120.0 - r.1[0].position[2])).collect();
        for t in [0.1, 0.2, 0.3, 0.5, 0.8] {
            let at = fallen.iter().find(|f| (f.0 - t).abs() < 1e-6).unwrap().1;
            println!("fold {n} {step} {t}: {} ", at / (0.5 * GRAVITY * t * t));
        }
        let lowest = fallen.iter().fold((0.0, 0.0), |m: (f64, f64), f| if f.1 > m.1 { *f } else { m });
        let exact = 0.847213 * (2.0 * length / GRAVITY).sqrt();
        println!("fold {n} {step}: lowest {lowest:?} {exact}");
    }
}

#[test]
fn one_line_between_two_bodies_holds_them_at_the_span_of_its_catenary() {
    // drawn apart by H: the span is 2 H/w asinh(w L/2H) + H L/EA
    let (h, w, l, ea): (f64, f64, f64, f64) = (4e5, 1000.0, 400.0, 5e8);
    for n in [20, 40, 80] {
        let records = format!(
            "&ENV -DEPTH 1000\nMEDIT\n*G -50 0 0\n&DESCRIBE BODY A -IGNORE Y Z RX RY RZ\n*A 0 0 0\n#WEIGHT *A 1E6 1 1 1\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*B 0 0 0\n#WEIGHT *B 1E6 1 1 1\n\
             ~L ROD 100 50 -LEN {l} -REFINE {n} -EI 0 -EA {ea} -WTPLEN {w} -BUOY 0\nCONNECTOR L ~L *A *B\n~S GSPR BOTH X 1E5 1E9 -LEN 0\nCONNECTOR S ~S *A *G\nEND\n\
             &INSTATE -LOCATE A 0 0 100\n&INSTATE -LOCATE B 390 0 100\n&APPLY -FORCE B {h} 0 0\n&EQUI\n"
        );
        let session = after(&records);
        let place = |i: usize| session.job.model.bodies[i].place.shift[0];
        let span = 2.0 * h / w * (w * l / (2.0 * h)).asinh() + h * l / ea;
        println!("two bodies {n}: {} {span} {}", place(1) - place(0), place(0) + 50.0);
    }
}

/// A taut line of 100 m across or along a current of 1 m/s, between two bodies 10 m under water.
fn taut(class: &str, from: f64) -> Model {
    model(&between(&format!("-CURRENT 1 {from}"), class, "0 0 -10", "100 0 -10"))
}

#[test]
fn a_catenary_with_dynamics_drags_by_the_defaults_of_aqwa() {
    let area: f64 = 0.02;
    let across = 0.5 * WATER * (area / FRAC_PI_4).sqrt() * 100.0;
    for (options, cd, cx) in [
        ("", 1.0, 0.025),
        ("-CD 2 -CX 0.1", 2.0, 0.1),
        ("-DE 0.3", 0.3 / (area / FRAC_PI_4).sqrt(), 0.025 * 0.3 / (area / FRAC_PI_4).sqrt()),
    ] {
        let class = format!("~L CATENARY {} {area} -LEN 99.5 {options}", WATER * area);
        let with = |from: f64| {
            let mut made = taut(&class, from);
            made.connectors[0].dynamics = Some(40);
            sum(&made)
        };
        println!("cd {options}: {} {}", with(270.0)[1] / (cd * across) - 1.0, with(180.0)[0] / (cx * across) - 1.0);
    }
}

#[test]
fn the_diameters_of_a_rod_act_each_on_its_own() {
    let weight = WATER * GRAVITY * FRAC_PI_4 * 0.01;
    let class = |options: &str| format!("~L ROD 100 50 -LEN 99.9 -REFINE 40 -EI 0 -WTPLEN {weight} {options}");
    let water = 0.5 * WATER * 0.1 * 100.0;
    for (options, factor) in [("", 1.0), ("-CD 1.2", 1.2), ("-DRAG 250", 2.5), ("-AMAS 500 -WIND 500 -BUOY 100", 1.0)] {
        println!("drag {options}: {}", sum(&taut(&class(options), 270.0))[1] / (factor * water) - 1.0);
    }
    for (options, factor) in [("", 1.2), ("-CD 1 0.01 0.7", 0.7), ("-WIND 250", 3.0), ("-DRAG 300", 1.2)] {
        let made = model(&between("-WIND 20 270", &class(options), "0 0 10", "100 0 10"));
        let found = sum(&made)[1];
        println!(
            "wind {options}: {found} {}",
            found / (0.5 * made.defaults.air_density * factor * 0.1 * 100.0 * 400.0)
        );
    }
}

/// Amplitude of the force that moves a taut line of 100 m across itself, both ends alike (N).
fn moved(class: &str, elements: usize) -> (f64, f64) {
    let (amplitude, period) = (1e-3, 2.0);
    let mut records = between("", class, "0 0 -10", "100 0 -10").replace(" -IGNORE X Y Z RX RY RZ", "");
    records.push_str(&format!(
        "MEDIT\nPRESCRIBE A -SINUSOID Y {amplitude} {period} -RAMP 20\nPRESCRIBE B -SINUSOID Y {amplitude} {period} -RAMP 20\nEND\n"
    ));
    let mut made = model(&records);
    if elements > 0 {
        made.connectors[0].dynamics = Some(elements);
    }
    let run = runs::run(&made, settings(60.0, 0.01), vec![]);
    let history = &run.history;
    let [a, b] = [0, 1].map(|end| history.series(history.layout.wrench(0, end).unwrap() + 1));
    let tension = history.series(history.layout.wrench(0, 0).unwrap())[0].abs();
    let late: Vec<f64> = a.iter().zip(&b).skip(5000).map(|(a, b)| a + b).collect();
    let most = late.iter().fold(f64::MIN, |m, v| m.max(*v));
    let least = late.iter().fold(f64::MAX, |m, v| m.min(*v));
    (0.5 * (most - least) / amplitude, tension)
}

/// The same of a string of a mass per length under tension with a mass in its middle.
fn string(mass: f64, middle: f64, tension: f64) -> f64 {
    let (w, half) = (TAU / 2.0, 50.0);
    let k = w * (mass / tension).sqrt();
    let (s, c) = (k * half).sin_cos();
    let inertia = 0.5 * middle * w * w;
    2.0 * tension * k * (tension * k * s + inertia * c) / (tension * k * c - inertia * s)
}

#[test]
fn added_mass_is_that_of_the_section_and_of_the_joint() {
    let area: f64 = 0.02;
    for (options, ca) in [("", 1.0), ("-CA 0", 0.0), ("-CA 2.5", 2.5)] {
        let (found, tension) =
            moved(&format!("~L CATENARY {} {area} -LEN 99.5 -CD 0 -CX 0 {options}", WATER * area), 60);
        println!("ca {options}: {}", found / string(WATER * area * (1.0 + ca), 0.0, tension) - 1.0);
    }
    for (options, ca, d) in [("", 1.0, 0.1), ("-CA 0.5", 0.5, 0.1), ("-AMAS 150", 1.0, 0.15)] {
        let weight = WATER * FRAC_PI_4 * 0.01;
        let (found, tension) = moved(
            &format!("~L ROD 100 50 -LEN 99.8 -REFINE 60 -EI 0 -WTPLEN {} -CD 0 0 0 {options}", weight * GRAVITY),
            0,
        );
        println!("rod ca {options}: {}", found / string(weight + ca * WATER * FRAC_PI_4 * d * d, 0.0, tension) - 1.0);
    }
    for joint in ["-CLUMP 200 0 300", "-CLUMP 500 0", "-BUOY 100 100.001 50"] {
        let class = format!(
            "~L CATENARY {0} {area} -LEN 49.75 -CD 0 -CX 0 -CA 0 {joint}\n~L CATENARY {0} {area} -LEN 49.75 -CD 0 -CX 0 -CA 0\n",
            WATER * area
        );
        let (found, tension) = moved(&class, 60);
        let middle = if joint.starts_with("-B") { 150.0 } else { 500.0 };
        println!("joint {joint}: {}", found / string(WATER * area, middle, tension) - 1.0);
    }
    let class = format!(
        "~L CATENARY {0} {area} -LEN 49.75 -CD 0 -CX 0 -CLUMP 200 0 0 3\n~L CATENARY {0} {area} -LEN 49.75 -CD 0 -CX 0\n",
        WATER * area
    );
    let mut made = taut(&class, 270.0);
    made.connectors[0].dynamics = Some(40);
    println!("cda {}", sum(&made)[1] / (0.5 * WATER * 3.0) - 1.0);
}

#[test]
fn a_catenary_with_dynamics_knows_no_highest_tension() {
    let section = "170 0.0217 -LEN 300 -EA 8.5E8";
    let moored = |class: &str| {
        let class = format!(
            "&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n~L {class}\nCONNECTOR L -ANC 0 283.5 ~L *F\nEND\n"
        );
        model(&class)
    };
    let pull = |made: &Model| {
        let system = System::of(made, &[]).unwrap();
        let all = system.contributions(&system.state(made).poses).unwrap();
        all.iter().find(|c| c.connector.is_some()).unwrap().load.wrench.fixed_rows::<3>(0).norm()
    };
    let mut held = moored(&format!("CATENARY {section} -TMAX 1E5"));
    let limited = pull(&held);
    held.connectors[0].dynamics = Some(100);
    let free = pull(&moored(&format!("CATENARY {section} -TMAX 1E9")));
    println!("tmax {limited} {} {free}", pull(&held));
}

#[test]
fn bending_stiffness_of_a_catenary_section_holds_it_up() {
    // the tensioned beam under its weight: w L2/8T - w EI/T2 (1 - sech u), u = L/2 sqrt(T/EI)
    let (mass, ei, l) = (100.0, 2e6, 30.0);
    for elements in [40, 80] {
        let mut made = model(&between(
            "",
            &format!("~L CATENARY {mass} 0.001 -LEN 29.99 -EA 1E8 -EI {ei}"),
            "0 0 50",
            &format!("{l} 0 50"),
        ));
        made.connectors[0].dynamics = Some(elements);
        let table = lines_at_rest(&made, &|_| true).unwrap().remove(0);
        let z = table.get("Z").unwrap().numbers();
        let (w, t) = (mass * GRAVITY, ends(&made)[0][0]);
        let u: f64 = 0.5 * l * (t / ei).sqrt();
        let sag = w * l * l / (8.0 * t) - w * ei / (t * t) * (1.0 - 1.0 / u.cosh());
        println!("ei: {t} {} {sag}", (50.0 - z[elements / 2]) / sag - 1.0);
    }
}

#[test]
fn a_line_on_a_slope_of_bathymetry_is_that_on_a_plane_of_its_own() {
    let records = |class: &str| {
        format!(
            "&BATHYMETRY SLOPE -DEPTHS\nX -1000 1000\nY -1000 50 150\nY 1000 50 150\nEND\n&ENV -DEPTH 100 -BATHYMETRY SLOPE\nMEDIT\n\
             &DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n~L {class}\nCONNECTOR L -ANC 0 260 ~L *F\nEND\n"
        )
    };
    let pull = |made: &Model| {
        let system = System::of(made, &[]).unwrap();
        let all = system.contributions(&system.state(made).poses).unwrap();
        all.iter().find(|c| c.connector.is_some()).unwrap().load.wrench.fixed_rows::<3>(0).norm()
    };
    let exact = pull(&model(&records("B_CAT 120 EXACT -LEN 300 -SLOPE 0.05 -DEPANCHOR 113")));
    for n in [50, 100, 200] {
        let rod = pull(&model(&records(&format!("ROD 120 60 -LEN 300 -REFINE {n} -EI 0 -SEABED 1E7"))));
        let own = pull(&model(&records(&format!(
            "ROD 120 60 -LEN 300 -REFINE {n} -EI 0 -SEABED 1E7 -SLOPE 0.05 -DEPANCHOR 113"
        ))));
        println!("slope {n}: {} {}", rod / exact - 1.0, own / exact - 1.0);
    }
}

#[test]
fn a_line_lies_at_the_depth_its_class_says() {
    let records = |class: &str| {
        format!(
            "&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n~L {class} -DEPANCHOR 80\nCONNECTOR L -ANC 0 260 ~L *F\nEND\n"
        )
    };
    let table = lines_at_rest(&model(&records("ROD 120 60 -LEN 300 -REFINE 100 -EI 0")), &|_| true).unwrap().remove(0);
    println!("depth {:?}", table.get("Z").unwrap().numbers().iter().fold(0.0, |m: f64, z| m.min(*z)));
    println!("{:?}", table.get("Clearance").unwrap().numbers().iter().fold(9.0, |m: f64, z| m.min(*z)));
}

/// A vessel on four rods in a sea.
const SPREAD: &str = "&DEVICE -SET_DATE 2026-11-21\n&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 -SEA JONSWAP 180 4 9 -CURRENT 0.5 180 -TIME 30 0.25 -RAMP 10\nMEDIT\n\
     &DESCRIBE BODY SHIP -IGNORE Z RX RY\n*CG 0 0 0\n#WEIGHT *CG 16000 15 65 65\n#DAMP *CG 100 100 0 0 0 5000\n\
     ~ROD ROD 120 60 -LEN 400 -REFINE 30 -EI 0\n~PIPE ROD 120 20 -LEN 400 -REFINE 30\n*F0 20 0 -5\n*F1 0 10 -5\n*F2 -20 0 -5\n*F3 0 -10 -5\n\
     CONNECTOR R0 -ANC 0 370 ~ROD *F0\nCONNECTOR R1 -ANC 90 370 ~PIPE *F1\nCONNECTOR R2 -ANC 180 370 ~ROD *F2\nCONNECTOR R3 -ANC 270 370 ~PIPE *F3\nEND\n\
     &INSTATE -LOCATE SHIP 3 2 0 0 0 1\n&ACTION PAY -AT 5 -WINCH R2 0.5 403\n&ACTION GONE -AT 20.1 -RELEASE R1\n";

#[test]
fn the_program_prints_the_same_with_one_thread_and_with_two() {
    let made = |threads: &str| {
        let folder = tempfile::tempdir().unwrap();
        fs::write(
            folder.path().join("job.cif"),
            format!("{SPREAD}TDOM\nPRCPOST\nCONFORCE R@\nSTATISTIC 1 Mag@\nVIEW\nEND\nROD R1\nROD R2\nEND\n"),
        )
        .unwrap();
        let mut command = Command::new(env!("CARGO_BIN_EXE_windlass"));
        let out = command.arg("job.cif").current_dir(folder.path()).env("RAYON_NUM_THREADS", threads).output().unwrap();
        assert!(out.status.success(), "{}", String::from_utf8_lossy(&out.stderr));
        assert!(out.stdout.len() > 20_000);
        (out.stdout, fs::read(folder.path().join("job.ans/TDOM.run")).unwrap())
    };
    assert!(made("1") == made("2"));
}

fn rows(session: &Session) -> Vec<u64> {
    session.job.run.as_ref().unwrap().history.values.iter().map(|v| v.to_bits()).collect()
}

#[test]
fn a_run_with_rods_goes_on_from_its_file_with_the_digits_of_an_unbroken_one() {
    let (mut whole, _, folder) = common::session();
    whole.open("test", format!("{SPREAD}TDOM"));
    whole.run();
    assert_eq!(whole.errors, 0, "{:?}", whole.reports);
    let bytes = fs::read(folder.path().join("job.ans/TDOM.run")).unwrap();
    let unbroken = rows(&whole);
    for share in [0.3, 0.5, 0.8, 0.99] {
        let (mut again, _, folder) = common::session();
        fs::create_dir_all(folder.path().join("job.ans")).unwrap();
        fs::write(folder.path().join("job.ans/TDOM.run"), &bytes[..(bytes.len() as f64 * share) as usize]).unwrap();
        again.open("test", format!("{SPREAD}TDOM -RESTART"));
        again.run();
        assert_eq!(again.errors, 0, "{:?}", again.reports);
        assert!(rows(&again) == unbroken, "cut at {share}");
    }
}
