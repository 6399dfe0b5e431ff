//! Rates of one segment between two ends, in a form that a program can read: name, solutions a pass, least seconds a
//! pass, tab between. The 2,000 lines of tests/data/catenary_2000.csv: cold; cold along a path; followed along it. The thirty-row tables of
//! the four-segment line; the rows of that with its buoy sunk as `row`, X (m), H (N).

#![allow(missing_docs, clippy::unwrap_used, clippy::print_stdout)]

use std::hint::black_box;
use std::time::{Duration, Instant};

#[path = "lines/mod.rs"]
mod lines;

use lines::{Moving, STEPS, table_lines};
use windlass_catenary::table;

/// Passes are repeated for so long, and the quickest counts: other work on the machine only ever adds.
const MIN_TIME: Duration = Duration::from_secs(4);

fn report(name: &str, solutions: usize, mut pass: impl FnMut() -> f64) {
    let begin = Instant::now();
    let mut least = f64::INFINITY;
    while begin.elapsed() < MIN_TIME {
        let start = Instant::now();
        black_box(pass());
        least = least.min(start.elapsed().as_secs_f64());
    }
    println!("{name}\t{solutions}\t{least:.9}");
}

fn main() {
    let cases = Moving::all();
    report("cold", cases.len(), || cases.iter().map(Moving::cold).sum());
    report("cold along the path", cases.len() * STEPS, || cases.iter().map(Moving::cold_along).sum());
    report("followed along the path", cases.len() * STEPS, || cases.iter().map(Moving::followed_along).sum());
    for (name, line, breaks) in table_lines() {
        if name == "sunk buoy" {
            for row in table(&line, &breaks, breaks[0], 0.0).unwrap().0 {
                println!("row\t{}\t{}", row.state.x, row.state.force);
            }
        }
        report(&format!("thirty rows, four segments, {name}"), 1, || {
            table(black_box(&line), &breaks, breaks[0], 0.0).unwrap().0.len() as f64
        });
    }
}
