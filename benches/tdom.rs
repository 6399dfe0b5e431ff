//! Runs in time: seconds of the sea a second of the machine, one thread. In a form that a program can read: name, steps, least
//! seconds of a run, tab between; then `real time`, how many times quicker than real time, and the evaluations a step.
//!
//! Seconds are those of the processor, where the system reports them (/proc/self/stat, in hundredths), else those of the clock.
//! The mooring is that of the other benches, eight chains in 300 m of water, on a hemisphere of 30 m radius whose excitation and
//! radiation are those of tests/data/hemisphere; an irregular sea of 200 components, steps of 0.1 s.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[path = "eight/mod.rs"]
mod eight;
mod measured;

use std::sync::Arc;
use std::time::Instant;
use windlass_model::{Database, Model};
use windlass_solve::time::{Method, Run, RunSettings, SilentWatcher, StepTolerance};

const STEP: f64 = 0.1;

/// The hemisphere on eight lines; with the memory of its radiation, or its added mass alone.
fn model(memory: bool, sea: bool) -> Model {
    let weight = 2.0 / 3.0 * std::f64::consts::PI * 27000.0 * 1025.0 * 9.80665;
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/hemisphere/wamit");
    let added = if memory { "" } else { "*O 0 0 0\n#AMASS *O 2.5E7 2.5E7 3E7 0 0 0\n" };
    let hull = format!(
        "*CG 0 0 -12\n#WEIGHT *CG {weight} 19 19 19\n#DAMP *CG 1E6 1E6 2E7 3E9 3E9 3E8\n{added}\
         DATABASE SHIP -WAMIT {file} -ULEN 3 -SYMMETRIC -MEMORY 60 -HYDROSTATICS YES\n"
    );
    let line = |rest: &str| format!("~CHAIN B_CAT 180 -LEN 900 -DEP 300 {rest}\n");
    let waves = if sea { "-SEA JONSWAP 180 5 11 -RAMP 50" } else { "" };
    let then = format!("&ENV -DEPTH 300 {waves}\n&INSTATE -LOCATE SHIP 5 2 0 0 0 1\n");
    let mut model = eight::model(&hull, &line, &then);
    let attached = model.bodies.get_mut("SHIP").unwrap().database.as_mut().unwrap();
    if !memory {
        let data = &attached.data;
        attached.data = Arc::new(Database { damping: Vec::new(), ..(**data).clone() });
    }
    model
}

fn pass(name: &str, model: &Model, keep: bool) {
    pass_of(10800.0, name, model, keep);
}

/// A run over some seconds of the sea.
fn pass_of(observed: f64, name: &str, model: &Model, keep: bool) {
    let settings = RunSettings {
        observed,
        dt: STEP,
        method: Method::default(),
        convergence: StepTolerance::default(),
        store: 1,
        capsize: true,
        adaptive: None,
        keep,
        along: 1,
        balance: false,
        transient: 0.0,
    };
    let mut least = f64::INFINITY;
    let begin = Instant::now();
    let mut counts = None;
    while begin.elapsed().as_secs_f64() < 4.0 {
        let mut run = Run::new(model, settings.clone(), Vec::new()).unwrap();
        let (start, clock) = (measured::processor(), Instant::now());
        run.run(&mut SilentWatcher).unwrap();
        let spent = measured::processor().zip(start).map(|(end, start)| end - start);
        least = least.min(spent.unwrap_or(clock.elapsed().as_secs_f64()));
        counts = Some(run.counts);
    }
    let counts = counts.unwrap();
    println!("{name}\t{}\t{least:.9}", counts.steps);
    let evaluations = counts.evaluations as f64 / counts.steps as f64;
    println!("real time\t{:.0}\t{evaluations:.2} evaluations a step", settings.observed / least);
}

fn main() {
    // words after `--` choose the vessel's runs or the semi-submersible's
    let chosen: Vec<String> = std::env::args().skip(1).filter(|word| !word.starts_with('-')).collect();
    if chosen.iter().all(|word| word != "semi") {
        hemisphere();
    }
    if chosen.is_empty() || chosen.iter().any(|word| word == "semi") {
        let semi = measured::model_from_records(include_str!("semi.cif"));
        pass_of(600.0, "semi of Froude-Krylov blocks, 200 waves, ten minutes", &semi, true);
    }
}

fn hemisphere() {
    pass("still water, added mass", &model(false, false), true);
    pass("200 waves, added mass", &model(false, true), true);
    pass("the same, statistics alone", &model(false, true), false);
    pass("200 waves, memory of 60 s", &model(true, true), true);
}
