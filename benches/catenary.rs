//! The thirty-row table of the four-segment line of seed 001.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use windlass::connector::catenary::{Joint, Line, Segment, table};
use windlass::language::units::{FOOT, KIP};

fn benches(c: &mut Criterion) {
    let segment = |od: f64, length: f64, weight: f64, e: f64| Segment {
        length: length * FOOT,
        weight: weight * KIP / FOOT,
        ea: e * std::f64::consts::FRAC_PI_4 * od * od * KIP,
    };
    let wire = |length: f64| segment(4.625, length, 0.03751, 2900.0);
    for (name, capacity, pendant) in [("sunk buoy", 100.0, 0.0), ("held buoy", 200.0, 50.0)] {
        let joints =
            vec![Joint::SpringBuoy { capacity: capacity * KIP, depth: pendant * FOOT }, Joint::Free, Joint::Free];
        let segments = vec![wire(500.0), wire(4000.0), segment(4.375, 2000.0, 0.1582, 4350.0), wire(2000.0)];
        let line = Line::new(segments, joints, -3000.0 * FOOT, 0.0).unwrap();
        let breaks = [1008.0, 1008.0, 902.0, 1008.0].map(|b| b * KIP);
        c.bench_function(&format!("thirty rows, four segments, {name}"), |b| {
            b.iter(|| table(black_box(&line), &breaks, breaks[0], 0.0).unwrap().len())
        });
    }
}

criterion_group!(all, benches);
criterion_main!(all);
