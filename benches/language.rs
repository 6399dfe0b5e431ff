//! The language: 100,000 simple records (points, then class records, then a loop of assignments).

#![allow(missing_docs, clippy::unwrap_used)]

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use std::fmt::Write;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;

fn run(script: &str) -> i64 {
    let job = JobFolder::new("bench".into(), None, false);
    let mut output = Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false);
    output.keep_log = false;
    let mut session = Session::new(output);
    session.open("bench", script.to_string());
    session.run();
    session.errors
}

fn benches(c: &mut Criterion) {
    let mut points = String::from("MEDIT\n&DESCRIBE BODY B\n");
    for n in 0..100_000 {
        writeln!(points, "*P{n} {n} {}.5 -10*2", n % 7).unwrap();
    }
    let mut classes = String::from("MEDIT\n");
    for n in 0..100_000 {
        writeln!(classes, "~W{n} B_CAT 4.625 -LEN 500 -BUOY 0 -WTPL 37.51/1000 -EMOD 29000*0.1").unwrap();
    }
    let mut group = c.benchmark_group("100,000 records");
    group.sample_size(10).throughput(Throughput::Elements(100_000));
    for (name, script) in [
        ("points", points),
        ("classes", classes),
        ("loop", "&LOOP I 1 50000\n&SET A = %I*2\n&SET B = %A\n&ENDLOOP\n".to_string()),
    ] {
        assert_eq!(run(&script), 0);
        group.bench_function(name, |b| b.iter(|| run(&script)));
    }
    group.finish();
}

criterion_group!(all, benches);
criterion_main!(all);
