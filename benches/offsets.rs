//! 200 offsets of a body on eight lines, held there: forces on the body and tensions of the lines. In a form that a program
//! can read: name, offsets a pass, least seconds a pass, tab between; then `row`, X (m), restoring force (N) of each.
//!
//! The mooring is that which MoorPy is timed on (benches/moorpy.py): eight chains of 900 m in 300 m of water, 0 to 40 m off.

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

#[path = "eight/mod.rs"]
mod eight;
mod measured;
#[path = "eight/report.rs"]
mod report;

use report::report;
use windlass_base::pose::Pose;
use windlass_solve::System;
use windlass_solve::offset::{BodyConnectors, ConnectorPull};

const OFFSETS: usize = 200;
const FARTHEST: f64 = 40.0;

fn main() {
    let line = |rest: &str| format!("~CHAIN B_CAT 180 EXACT -LEN 900 -DEP 300 {rest}\n");
    let model = eight::model("", &line, "");
    let system = System::new(&model, &[]).unwrap();
    let start: Vec<Pose> = system.state(&model).poses;
    let at = |n: usize| FARTHEST * n as f64 / (OFFSETS - 1) as f64;
    report("forces and tensions", OFFSETS, || {
        let mut connectors = BodyConnectors::on_body(&system, 0).unwrap();
        let (mut poses, mut pull, mut sum) = (start.clone(), ConnectorPull::default(), 0.0);
        for n in 0..OFFSETS {
            poses[0].origin.x = at(n);
            connectors.pull(&system, &poses, &mut pull).unwrap();
            sum += pull.wrench[0] + pull.tensions[0];
        }
        sum
    });
    report("forces and stiffness", OFFSETS, || {
        let mut state = system.state(&model);
        let mut sum = 0.0;
        for n in 0..OFFSETS {
            state.poses[0].origin.x = at(n);
            system.evaluate(&mut state).unwrap();
            sum += state.residual[0] + state.stiffness[(0, 0)];
        }
        sum
    });
    let (mut connectors, mut poses, mut pull) =
        (BodyConnectors::on_body(&system, 0).unwrap(), start, ConnectorPull::default());
    for n in 0..OFFSETS {
        poses[0].origin.x = at(n);
        connectors.pull(&system, &poses, &mut pull).unwrap();
        println!("row\t{}\t{}", at(n), -pull.wrench[0]);
    }
}
