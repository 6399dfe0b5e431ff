//! Equilibria of a free body on eight lines, begun 10 m off. In a form that a program can read: name, equilibria a pass, least
//! seconds a pass, tab between.
//!
//! The mooring is that which MoorPy is timed on (benches/moorpy.py): eight chains of 900 m in 300 m of water; and the same in two
//! segments with a clump between. The body is a box whose hull is cut at the surface.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[path = "eight/mod.rs"]
mod eight;
mod measured;
#[path = "eight/report.rs"]
mod report;

use report::report;
use windlass_solve::{EquilibriumOptions, System, equilibrium};

/// A box whose hull is cut at the surface.
const HULL: &str = "*CG 0 0 -2\n#WEIGHT *CG 2E8 22 22 22\n&SURFACE\nBLOCK HULL -30 -30 -8 30 30 10\nEND_&SURFACE\n";

fn main() {
    let one = |rest: &str| format!("~CHAIN B_CAT 180 EXACT -LEN 900 -DEP 300 {rest}\n");
    let two = |rest: &str| {
        format!("~CHAIN B_CAT 180 EXACT -LEN 450 -DEP 300 -CLUMP 1E5 {rest}\n~CHAIN B_CAT 180 -LEN 450 {rest}\n")
    };
    for (name, line) in [("one segment", &one as &dyn Fn(&str) -> String), ("two segments and a clump", &two)] {
        let model = eight::model(HULL, line, "&INSTATE -MOVE SHIP 10\n");
        let options = EquilibriumOptions::default();
        let system = System::new(&model, &[]).unwrap();
        let mut state = system.state(&model);
        let found = equilibrium(&system, &mut state, &options).unwrap();
        println!(
            "# {name}: {} steps, {} evaluations, {:.1e} g left",
            found.search.iterations, found.search.evaluations, found.search.residual
        );
        report(&format!("{name}, solved"), 1, || {
            let mut state = system.state(&model);
            equilibrium(&system, &mut state, &options).unwrap().search.residual
        });
        report(&format!("{name}, made and solved"), 1, || {
            let system = System::new(&model, &[]).unwrap();
            let mut state = system.state(&model);
            equilibrium(&system, &mut state, &options).unwrap().search.residual
        });
        report(&format!("{name}, one evaluation"), 1, || {
            system.evaluate(&mut state).unwrap();
            state.residual[0]
        });
    }
}
