//! Equilibria of a free body on eight lines, begun 10 m off. In a form that a program can read: name, equilibria a pass, least
//! seconds a pass, tab between.
//!
//! The mooring is that of MoorPy in shared/peers/results.md, (c): eight chains of 900 m in 300 m of water; and the same in two
//! segments with a clump between. The body is a box whose hull is cut at the surface.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use std::fmt::Write;
use std::hint::black_box;
use std::time::{Duration, Instant};
use windlass::model::Model;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass::solve::{Options, System, equilibrium};

/// Passes are repeated for so long, and the quickest counts: other work on the machine only ever adds.
const ENOUGH: Duration = Duration::from_secs(4);

/// Eight chains around: anchors at 830 m, fairleads at 30 m and 10 m down, 199 kg/m of 0.18 m in sea water; the line as records.
fn model(line: &dyn Fn(&str) -> String) -> Model {
    let mut records = String::from(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\nMEDIT\n&DESCRIBE BODY SHIP\n*CG 0 0 -2\n#WEIGHT *CG 2E8 22 22 22\n\
         &SURFACE\nBLOCK HULL -30 -30 -8 30 30 10\nEND_&SURFACE\n",
    );
    for line in 0..8 {
        let (sin, cos) = (22.5 + 45.0 * f64::from(line)).to_radians().sin_cos();
        writeln!(records, "*F{line} {} {} -10", 30.0 * cos, 30.0 * sin).unwrap();
    }
    // E of a full section of 180 mm with EA = 8.54e8 N, in MPa as records have it
    let section = std::f64::consts::FRAC_PI_4 * 0.18 * 0.18;
    let modulus = 8.54e8 / section / 1e6;
    let weight = (199.0 - 1025.0 * section) * 9.80665;
    records.push_str(&line(&format!("-BUOY 0 -WTPL {weight} -EMOD {modulus}")));
    for line in 0..8 {
        let angle = 22.5 + 45.0 * f64::from(line);
        writeln!(records, "CONNECTOR L{line} -ANC {angle} 800 ~CHAIN *F{line}").unwrap();
    }
    records.push_str("END\n&INSTATE -MOVE SHIP 10\n");
    let job = JobFolder::new("bench".into(), None, false);
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.keep_reports = true;
    session.open("bench", records);
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
    println!("{name}\t1\t{least:.9}");
}

fn main() {
    let one = |rest: &str| format!("~CHAIN B_CAT 180 EXACT -LEN 900 -DEP 300 {rest}\n");
    let two = |rest: &str| {
        format!("~CHAIN B_CAT 180 EXACT -LEN 450 -DEP 300 -CLUMP 1E5 {rest}\n~CHAIN B_CAT 180 -LEN 450 {rest}\n")
    };
    for (name, model) in [("one segment", model(&one)), ("two segments and a clump", model(&two))] {
        let options = Options::default();
        let system = System::of(&model, &[]).unwrap();
        let mut state = system.state(&model);
        let found = equilibrium(&system, &mut state, &options).unwrap();
        println!("# {name}: {} steps, {} evaluations, {:.1e} g left", found.steps, found.evaluations, found.measure);
        report(&format!("{name}, solved"), || {
            let mut state = system.state(&model);
            equilibrium(&system, &mut state, &options).unwrap().measure
        });
        report(&format!("{name}, made and solved"), || {
            let system = System::of(&model, &[]).unwrap();
            let mut state = system.state(&model);
            equilibrium(&system, &mut state, &options).unwrap().measure
        });
        report(&format!("{name}, one evaluation"), || {
            system.evaluate(&mut state).unwrap();
            state.residual[0]
        });
    }
}
