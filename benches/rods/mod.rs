//! Rods in the program: the driven chain, and a free vessel on eight of them.

// every bench takes what it needs
#![allow(dead_code, clippy::unwrap_used)]

use crate::{eight, measured};
use std::sync::Arc;
use std::time::Instant;
use windlass_model::{Database, Model};
use windlass_solve::time::{Method, Run, RunCounts, RunSettings, SilentWatcher, StepTolerance};

/// The records of ~CHAIN: 900 m in so many elements.
fn section(elements: usize) -> String {
    let properties = "-LEN 900 -EI 0 -EA 8.54E8 -CD 1.333 0.639 -CA 1 0.5 -AX_DAMPING 1E6 -SEABED 3E6 3E5";
    let weight = 199.0 * 9.80665;
    format!("~CHAIN ROD 180 90 -REFINE {elements} -WTPLEN {weight} {properties}\n")
}

/// The chain of tests/data/moordyn_chain900.csv with its fairlead driven.
pub fn driven(elements: usize) -> Model {
    measured::model_from_records(&format!(
        "&DIMEN -DIMEN METERS N\n&ENV DRIVEN -DEPTH 300\nMEDIT\n{}\
         &DESCRIBE BODY RIG\n*F 0 0 -10\nCONNECTOR CHAIN -ANC 180 800 ~CHAIN *F\n\
         PRESCRIBE RIG -SINUSOID X 5 10 -RAMP 20\nEND\n",
        section(elements)
    ))
}

/// The hemisphere of benches/tdom.rs, let go 10 m off, on eight such chains; with a sea of so many components.
pub fn vessel(elements: usize, components: usize) -> Model {
    let weight = 2.0 / 3.0 * std::f64::consts::PI * 27000.0 * 1025.0 * 9.80665;
    let file = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/hemisphere/wamit");
    let hull = format!(
        "*CG 0 0 -12\n#WEIGHT *CG {weight} 19 19 19\n#DAMP *CG 1E6 1E6 2E7 3E9 3E9 3E8\n\
         *O 0 0 0\n#AMASS *O 2.5E7 2.5E7 3E7 0 0 0\n\
         DATABASE SHIP -WAMIT {file} -ULEN 3 -SYMMETRIC -MEMORY 60 -HYDROSTATICS YES\n"
    );
    let waves = if components > 0 { format!("-SEA JONSWAP 180 5 11 -COMPONENTS {components}") } else { String::new() };
    let then = format!("&ENV -DEPTH 300 {waves} -RAMP 50\n&INSTATE -LOCATE SHIP 10 0 0 0 0 0\n");
    let mut model = eight::model(&hull, &|_| section(elements), &then);
    // its added mass alone, without the memory of its radiation
    let attached = model.bodies.get_mut("SHIP").unwrap().database.as_mut().unwrap();
    attached.data = Arc::new(Database { damping: Vec::new(), ..(*attached.data).clone() });
    model
}

/// How a run went.
pub struct MeasuredRun {
    /// Least seconds of the processor on one thread, and of the clock on as many as there are.
    pub seconds: [f64; 2],
    pub counts: RunCounts,
    /// Force on the first end of the first connector at each instant (N).
    pub forces: Vec<f64>,
}

/// The least of some runs over a span by a step (s), as TDOM makes them: every instant kept, with `along` every so manieth node.
/// Each is made on one thread and on all, and must come to the same.
pub fn run(model: &Model, (span, dt): (f64, f64), along: usize, passes: usize) -> MeasuredRun {
    let settings = RunSettings {
        observed: span,
        dt,
        method: Method::default(),
        convergence: StepTolerance::default(),
        store: 1,
        capsize: true,
        adaptive: None,
        keep: true,
        along,
        balance: false,
        transient: 0.0,
    };
    let once = || {
        let mut run = Run::new(model, settings.clone(), Vec::new()).unwrap();
        let (clock, start) = (Instant::now(), measured::thread_time());
        run.run(&mut SilentWatcher).unwrap();
        let wall = clock.elapsed().as_secs_f64();
        let spent = measured::thread_time().zip(start).map_or(wall, |(end, start)| end - start);
        let at = run.history.layout.wrench(0, 0).unwrap();
        let force = |row: &[f64]| row[at..at + 3].iter().map(|f| f * f).sum::<f64>().sqrt();
        MeasuredRun { seconds: [spent, wall], counts: run.counts, forces: run.history.rows().map(force).collect() }
    };
    let single = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let mut least = [f64::INFINITY; 2];
    for _ in 0..passes {
        let alone = single.install(once);
        let together = once();
        assert!(alone.forces == together.forces, "the number of threads changes the answer");
        least = [least[0].min(alone.seconds[0]), least[1].min(together.seconds[1])];
    }
    MeasuredRun { seconds: least, ..single.install(once) }
}
