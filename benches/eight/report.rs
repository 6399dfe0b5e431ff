//! How a pass of a bench is reported.

#![allow(clippy::print_stdout)]

use std::hint::black_box;
use std::time::{Duration, Instant};

/// Passes are repeated for so long, and the quickest counts: other work on the machine only ever adds.
const MIN_TIME: Duration = Duration::from_secs(4);

/// Prints the name, what a pass solves, and the least seconds a pass took, tab between.
pub fn report(name: &str, solutions: usize, mut pass: impl FnMut() -> f64) {
    let begin = Instant::now();
    let mut least = f64::INFINITY;
    while begin.elapsed() < MIN_TIME {
        let start = Instant::now();
        black_box(pass());
        least = least.min(start.elapsed().as_secs_f64());
    }
    println!("{name}\t{solutions}\t{least:.9}");
}
