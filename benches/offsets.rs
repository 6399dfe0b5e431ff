//! 200 offsets of a body on eight lines, held there: forces on the body and tensions of the lines. In a form that a program
//! can read: name, offsets a pass, least seconds a pass, tab between; then `row`, X (m), restoring force (N) of each.
//!
//! The mooring is that of MoorPy and MAP++ in shared/peers/results.md, (c): eight chains of 900 m in 300 m of water, 0 to 40 m off.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use std::fmt::Write;
use std::hint::black_box;
use std::time::{Duration, Instant};
use windlass::model::{Model, Pose};
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass::solve::System;
use windlass::solve::offset::{Connectors, Pull};

const OFFSETS: usize = 200;
const FARTHEST: f64 = 40.0;
/// Passes are repeated for so long, and the quickest counts: other work on the machine only ever adds.
const ENOUGH: Duration = Duration::from_secs(4);

/// Eight chains around: anchors at 830 m, fairleads at 30 m and 10 m down, 199 kg/m of 0.18 m in sea water.
fn model() -> Model {
    let mut records = String::from("&DIMEN -DIMEN METERS N\nMEDIT\n&DESCRIBE BODY SHIP\n");
    for line in 0..8 {
        let (sin, cos) = (22.5 + 45.0 * f64::from(line)).to_radians().sin_cos();
        writeln!(records, "*F{line} {} {} -10", 30.0 * cos, 30.0 * sin).unwrap();
    }
    // E of a full section of 180 mm with EA = 8.54e8 N, in MPa as records have it
    let section = std::f64::consts::FRAC_PI_4 * 0.18 * 0.18;
    let modulus = 8.54e8 / section / 1e6;
    let weight = (199.0 - 1025.0 * section) * 9.80665;
    writeln!(records, "~CHAIN B_CAT 180 EXACT -LEN 900 -DEP 300 -BUOY 0 -WTPL {weight} -EMOD {modulus}").unwrap();
    for line in 0..8 {
        let angle = 22.5 + 45.0 * f64::from(line);
        writeln!(records, "CONNECTOR L{line} -ANC {angle} 800 ~CHAIN *F{line}").unwrap();
    }
    records.push_str("END\n");
    let job = JobFolder::new("bench".into(), None, false);
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.open("bench", records);
    session.keep_reports = true;
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session.job.model.clone()
}

fn report(name: &str, mut pass: impl FnMut() -> f64) {
    let begin = Instant::now();
    let mut least = f64::INFINITY;
    while begin.elapsed() < ENOUGH {
        let start = Instant::now();
        black_box(pass());
        least = least.min(start.elapsed().as_secs_f64());
    }
    println!("{name}\t{OFFSETS}\t{least:.9}");
}

fn main() {
    let model = model();
    let system = System::of(&model, &[]).unwrap();
    let start: Vec<Pose> = system.state(&model).poses;
    let at = |n: usize| FARTHEST * n as f64 / (OFFSETS - 1) as f64;
    report("forces and tensions", || {
        let mut connectors = Connectors::on(&system, 0).unwrap();
        let (mut poses, mut pull, mut sum) = (start.clone(), Pull::default(), 0.0);
        for n in 0..OFFSETS {
            poses[0].origin.x = at(n);
            connectors.pull(&system, &poses, &mut pull).unwrap();
            sum += pull.wrench[0] + pull.tensions[0];
        }
        sum
    });
    report("forces and stiffness", || {
        let mut state = system.state(&model);
        let mut sum = 0.0;
        for n in 0..OFFSETS {
            state.poses[0].origin.x = at(n);
            system.evaluate(&mut state).unwrap();
            sum += state.residual[0] + state.stiffness[(0, 0)];
        }
        sum
    });
    let (mut connectors, mut poses, mut pull) = (Connectors::on(&system, 0).unwrap(), start, Pull::default());
    for n in 0..OFFSETS {
        poses[0].origin.x = at(n);
        connectors.pull(&system, &poses, &mut pull).unwrap();
        println!("row\t{}\t{}", at(n), -pull.wrench[0]);
    }
}
