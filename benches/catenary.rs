//! The thirty-row table of the four-segment line of seed 001; the 2,000 single lines of shared/validation, cold.

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, criterion_group, criterion_main};
use std::hint::black_box;
use windlass::connector::catenary::{Bottom, Joint, Line, Segment, table};
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
    let cases: Vec<_> = csv::Reader::from_path("tests/data/catenary_2000.csv")
        .unwrap()
        .records()
        .map(|row| {
            let row = row.unwrap();
            let v = |i: usize| row[i].parse::<f64>().unwrap();
            let segment = Segment { length: v(4), ea: v(5), weight: v(6) };
            (segment, v(2), v(3), (&row[8] == "0").then(|| Bottom { friction: v(7) }))
        })
        .collect();
    c.bench_function("2,000 random single lines, cold", |b| {
        b.iter(|| cases.iter().map(|(s, x, z, bottom)| s.between(*x, *z, *bottom).unwrap().fairlead[0]).sum::<f64>())
    });
}

criterion_group!(all, benches);
criterion_main!(all);
