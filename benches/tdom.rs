//! Runs in time: seconds of the sea a second of the machine, one thread. In a form that a program can read: name, steps a pass,
//! least seconds a pass, tab between; then `real time`, how many times quicker than real time.
//!
//! The mooring is that of the other benches: eight chains in 300 m of water, on a body of 20,000 t with a linear hydrostatic
//! stiffness, steps of 0.1 s.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[path = "eight/mod.rs"]
mod eight;

use std::time::Instant;
use windlass::model::Model;
use windlass::solve::time::{Convergence, Method, Run, Settings, Watcher};

/// Takes rows and says nothing.
struct Quiet;

impl Watcher for Quiet {
    fn row(&mut self, _row: &[f64]) -> Result<(), String> {
        Ok(())
    }
}

const STEP: f64 = 0.1;

/// The body, with these further records, and lines of this option.
fn model(flag: &str, more: &str, environment: &str) -> Model {
    let weight = 2e7 * 9.80665;
    let hull = format!(
        "*CG 0 0 0\n#WEIGHT *CG {weight} 20 20 25\n#HYDROSTATIC *CG 1.4E7 1.4E9 1.4E9 -BUOYANCY {weight}\n\
         #DAMP *CG 1E5 1E5 3E6 3E8 3E8 3E8\n#AMASS *CG 1E7 1E7 2E7 4E9 4E9 4E9\n{more}"
    );
    let line = |rest: &str| format!("~CHAIN B_CAT 180 {flag} -LEN 900 -DEP 300 {rest}\n");
    eight::model(&hull, &line, environment)
}

fn pass(name: &str, model: &Model, observed: f64) {
    let settings = Settings {
        observed,
        dt: STEP,
        method: Method::default(),
        convergence: Convergence::default(),
        store: 1,
        capsize: true,
        adaptive: None,
        keep: false,
    };
    let mut least = f64::INFINITY;
    let begin = Instant::now();
    let mut counts = None;
    while begin.elapsed().as_secs_f64() < 4.0 {
        let mut run = Run::new(model, settings.clone(), Vec::new()).unwrap();
        let start = Instant::now();
        run.go(&mut Quiet).unwrap();
        least = least.min(start.elapsed().as_secs_f64());
        counts = Some(run.counts);
    }
    let counts = counts.unwrap();
    println!("{name}\t{}\t{least:.9}", counts.steps);
    println!(
        "real time\t{:.0}\t{:.2} evaluations a step",
        observed / least,
        counts.evaluations as f64 / counts.steps as f64
    );
}

fn main() {
    let start = "&INSTATE -LOCATE SHIP 5 2 0.5 0 0 1\n";
    pass("tabulated lines, still water", &model("", "", start), 1000.0);
    pass("exact lines, still water", &model("EXACT", "", start), 1000.0);
}
