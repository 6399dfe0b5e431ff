//! The thirty-row table of the four-segment line of [MOSES-FLEX example]; the 2,000 single lines of tests/data/catenary_2000.csv, cold and
//! followed along a path.

#![allow(missing_docs, clippy::unwrap_used)]

#[path = "lines/mod.rs"]
mod lines;

use criterion::{Criterion, criterion_group, criterion_main};
use lines::{Moving, table_lines};
use std::hint::black_box;
use windlass_catenary::table;

fn benches(c: &mut Criterion) {
    for (name, line, breaks) in table_lines() {
        c.bench_function(&format!("thirty rows, four segments, {name}"), |b| {
            b.iter(|| table(black_box(&line), &breaks, breaks[0], 0.0).unwrap().0.len())
        });
    }
    let cases = Moving::all();
    c.bench_function("2,000 random single lines, cold", |b| b.iter(|| cases.iter().map(Moving::cold).sum::<f64>()));
    c.bench_function("2,000 random single lines, 100 steps each, cold", |b| {
        b.iter(|| cases.iter().map(Moving::cold_along).sum::<f64>())
    });
    c.bench_function("2,000 random single lines, 100 steps each, followed", |b| {
        b.iter(|| cases.iter().map(Moving::followed_along).sum::<f64>())
    });
}

criterion_group!(all, benches);
criterion_main!(all);
