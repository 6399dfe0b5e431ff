//! Marine growth on dynamic lines, at rest and in runs, against closed forms; and an environment that comes with it or
//! without it while a run goes on.

use crate::common;
use crate::common::assert_share;
use crate::common::run as runs;

use nalgebra::Vector3;
use runs::{model, settings};
use std::f64::consts::{FRAC_PI_4, TAU};
use std::fs;
use windlass::session::Session;
use windlass_model::Model;
use windlass_solve::System;

const RHO: f64 = 1025.0;
const G: f64 = 9.80665;
/// A line of 200 mm that is as heavy as water: it hangs straight between its ends, by whose pull it is longer by 1 %.
const EVEN: &str = "~L ROD 200 100 -EI 0 -EA 1E9 -LEN 99 -REFINE 20 -WTPLEN 315.792";
/// The curve of 50 mm of growth on all of it.
const ALL: &str = "-900 100 900 100";
/// Water of that growth, of 1400 kg/m3.
const FOUL: &str = "-M_GROWTH G 1400";
/// What growth of 50 mm on 200 mm adds to its section (m2).
const RING: f64 = FRAC_PI_4 * (0.09 - 0.04);

/// A line between two bodies that are held, with a curve of growth G that an environment may name.
fn line_between(curve: &str, environment: &str, class: &str, [from, to]: [&str; 2]) -> String {
    format!(
        "&DATA CURVES M_GROWTH G {curve}\n&ENV -DEPTH 1000 {environment}\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*A {from}\n\
         &DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*B {to}\n{class}\nCONNECTOR L ~L *A *B\nEND\n"
    )
}

/// Forces of the line on both bodies, at rest (N).
fn pulls(model: &Model) -> [Vector3<f64>; 2] {
    let system = System::new(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    [0, 1].map(|body| {
        let found = all.iter().find(|c| c.body == body && c.connector.is_some()).unwrap();
        found.load.wrench.fixed_rows::<3>(0).into_owned()
    })
}

/// The ends of a level line.
const LEVEL: [&str; 2] = ["0 0 -50", "100 0 -50"];

/// All that loads a level line 50 m deep (N).
fn load(environment: &str) -> Vector3<f64> {
    pulls(&model(&line_between(ALL, environment, EVEN, LEVEL))).iter().sum()
}

#[test]
fn growth_adds_submerged_weight_and_drag_diameter() {
    let stream = "-CURRENT 1 -90";
    let [bare, foul] = [stream.to_string(), format!("{FOUL} {stream}")].map(|e| load(&e));
    // statics leaves less than 1e-9 of a pull of 1e7 N at each of 20 nodes; the density of -M_GROWTH is that in air
    assert_share(foul.z - bare.z, -(1400.0 - RHO) * G * RING * 99.0, 1e-4);
    // the line bows by some thousandths, which changes what drags it by its square
    assert_share(foul.y / bare.y, 1.5, 1e-3);
}

#[test]
fn growth_between_two_depths_adds_weight_between_them() {
    // 20 of 100 elements of a plumb line, whose ends are bare: 1 % of its length is stretch
    let class = "~L ROD 200 100 -EI 0 -EA 1E9 -LEN 99 -REFINE 100 -WTPLEN 315.792";
    let band = "-60 0 -59.999999 100 -40.000001 100 -40 0";
    let [bare, foul] = ["", FOUL].map(|e| pulls(&model(&line_between(band, e, class, ["0 0 -2", "0 0 -102"]))));
    let more: f64 = foul.iter().zip(&bare).map(|(a, b)| a.z - b.z).sum();
    // statics leaves 1e-9 of the pull of 1e7 N at each of 100 nodes: 1 N of 2859
    assert_share(more, -(1400.0 - RHO) * G * RING * 20.0 * 0.99, 5e-4);
}

/// Amplitude of the force (N) over that of the motion (m) of the level line moved across at both ends alike in 6 s, and its tension (N).
fn transfer_function(environment: &str) -> (f64, f64) {
    let class = EVEN.replace("1E9", "1E8") + " -CD 0 0 0";
    let mut records = line_between(ALL, environment, &class, LEVEL).replace(" -IGNORE X Y Z RX RY RZ", "");
    for body in ["A", "B"] {
        records.push_str(&format!("MEDIT\nPRESCRIBE {body} -SINUSOID Y 1E-3 6 -RAMP 30\nEND\n"));
    }
    let run = runs::run(&model(&records.replace("-REFINE 20", "-REFINE 60")), settings(90.0, 0.03), vec![]);
    let history = &run.history;
    let [a, b] = [0, 1].map(|end| history.series(history.layout.wrench(0, end).unwrap() + 1));
    let tension = history.series(history.layout.wrench(0, 0).unwrap())[0].abs();
    let late: Vec<f64> = a.iter().zip(&b).skip(2000).map(|(a, b)| a + b).collect();
    let most = late.iter().fold(f64::MIN, |m, v| m.max(*v));
    let least = late.iter().fold(f64::MAX, |m, v| m.min(*v));
    (0.5 * (most - least) / 1e-3, tension)
}

#[test]
fn line_oscillates_with_mass_and_added_mass_of_its_growth() {
    // as dense as water, so that it hangs straight: a string of 100 m that is moved at both ends pulls by 2 T k tan(k L/2)
    for (environment, diameter) in [("", 0.2f64), ("-M_GROWTH G 1025", 0.3)] {
        let (found, tension) = transfer_function(environment);
        // own mass and added mass, spread over the stretched length
        let mass = 2.0 * RHO * FRAC_PI_4 * diameter * diameter * 0.99;
        let k = TAU / 6.0 * (mass / tension).sqrt();
        // 60 elements, and (w h)^2/12 of the step
        assert_share(found, 2.0 * tension * k * (50.0 * k).tan(), 3e-3);
    }
}

/// Records whose environment is at first one and from 40 s on the other, a current in both.
fn changing(first: &str, then: &str) -> String {
    let env = |name: &str| {
        let growth = if name == "FOUL" { FOUL } else { "" };
        format!("&ENV {name} -DEPTH 1000 -CURRENT 1 -90 -TIME 200 0.2 {growth}\n")
    };
    let class = "~L ROD 200 100 -EI 0 -EA 1E7 -LEN 99 -REFINE 20 -WTPLEN 500 -AX_DAMPING 1E7";
    let line = line_between(ALL, "", class, ["0 0 -50", "80 0 -70"]);
    let line = line.replace("&ENV -DEPTH 1000 \n", &(env(then) + &env(first)));
    format!("&DIMEN -DIMEN METERS N\n{line}&ACTION TURN -AT 40 -ENVIRONMENT {then}\n")
}

fn run_records(records: &str, folder: &tempfile::TempDir, mut session: Session) -> Session {
    assert!(folder.path().exists());
    session.open("test", records.to_string());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session
}

fn done(records: &str) -> Session {
    let (session, _, folder) = common::session();
    run_records(records, &folder, session)
}

/// The pull on the first body at an instant of a run (N).
fn pull_at(session: &Session, time: f64) -> Vector3<f64> {
    let history = &session.job.run.as_ref().unwrap().history;
    let at = history.layout.wrench(0, 0).unwrap();
    let row = history.rows().find(|row| (row[0] - time).abs() < 1e-6).unwrap();
    Vector3::from_column_slice(&row[at..at + 3])
}

#[test]
fn growth_changed_by_environment_matches_line_built_with_it() {
    let [clean, foul] = ["CLEAN", "FOUL"].map(|name| pull_at(&done(&(changing(name, name) + "TDOM\n")), 0.0));
    assert!((foul - clean).norm() > 0.2 * clean.norm());
    for (first, then, [before, end]) in [("CLEAN", "FOUL", [clean, foul]), ("FOUL", "CLEAN", [foul, clean])] {
        let session = done(&(changing(first, then) + "TDOM\n"));
        // at rest until it comes, and again 160 s after
        assert!((pull_at(&session, 39.8) - before).norm() < 1e-6 * before.norm());
        let left = (pull_at(&session, 200.0) - end).norm();
        assert!(left < 2e-3 * end.norm(), "{first}: {left} of {}", end.norm());
        // as many nodes before as after
        let run = session.job.run.as_ref().unwrap();
        let along = run.history.layout.links[0].along.as_ref().unwrap();
        assert!(run.history.rows().all(|row| along.nodes(row).count() == 21));
    }
}

#[test]
fn run_with_changed_growth_restarts_with_uninterrupted_digits() {
    let records = changing("CLEAN", "FOUL").replace("-TIME 200 0.2", "-TIME 120 0.2");
    let wound = format!("{records}&ACTION OUT -AT 20 -WINCH L 0.4 120\n&ACTION IN -AT 80 -WINCH L -0.6 99\n");
    let values =
        |s: &Session| -> Vec<u64> { s.job.run.as_ref().unwrap().history.values.iter().map(|v| v.to_bits()).collect() };
    let (session, _, folder) = common::session();
    let whole = run_records(&format!("{wound}TDOM\n"), &folder, session);
    let bytes = fs::read(folder.path().join("job.ans/TDOM.run")).unwrap();
    for share in [0.3, 0.9] {
        let (session, _, folder) = common::session();
        fs::create_dir_all(folder.path().join("job.ans")).unwrap();
        let cut = &bytes[..(bytes.len() as f64 * share) as usize];
        fs::write(folder.path().join("job.ans/TDOM.run"), cut).unwrap();
        let again = run_records(&format!("{wound}TDOM -RESTART\n"), &folder, session);
        assert!(values(&again) == values(&whole), "cut at {share}");
    }
}

#[test]
fn line_with_growth_is_hauled_and_paid_out_over_its_elements() {
    // plumb, 60 m of it: a load on it, and growth between 40 and 60 m deep that stays on what hangs there
    let records = "&DIMEN -DIMEN METERS N\n&DATA CURVES M_GROWTH G -900 100 900 100\n&ENV -DEPTH 500 -TIME 160 0.1 -M_GROWTH G 1400\nMEDIT\n\
         &DESCRIBE BODY CRANE -IGNORE X Y Z RX RY RZ\n*H 0 0 -20\n&DESCRIBE BODY LOAD -IGNORE X Y RX RY RZ\n*P 0 0 0\n#WEIGHT *P 49033.25 1 1 1\n\
         ~L ROD 200 100 -EI 0 -EA 5E7 -LEN 60 -REFINE 12 -WTPLEN 500 -AX_DAMPING 1E6\nCONNECTOR L ~L *H *P\nEND\n\
         &INSTATE -LOCATE LOAD 0 0 -80\n&EQUI\n";
    for (action, length) in [("-WINCH L 0.5 90", 90.0), ("-WINCH L -0.5 20", 20.0)] {
        let session = done(&format!("{records}&ACTION W -AT 5 {action}\nTDOM\n"));
        let net = 500.0 - RHO * G * FRAC_PI_4 * 0.04 + (1400.0 - RHO) * G * RING;
        let force = pull_at(&session, 160.0).z;
        assert_share(force, -(49033.25 + net * length), 1e-5);
    }
}
