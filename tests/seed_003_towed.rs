//! The towed tether of seed 003: description, natural modes, and the run in an irregular sea, against the listing.
//!
//! `tests/data/towed_tether.json` holds the printed numbers (of validation/towed-tether.json). Formulation and what of the
//! listing cannot be met: validation/towed-tether.md. Units of the deck: t, kN, m, s.

#![allow(clippy::unwrap_used)]

use serde_json::Value;
use windlass::hydro::sea::Component;
use windlass::tether::towed::{Compatibility, EndSpring, History, Multipliers, Record, Steps, Towed};
use windlass::tether::{Line, TetherElement};

/// The printed numbers.
fn printed() -> Value {
    serde_json::from_str(include_str!("data/towed_tether.json")).unwrap()
}

fn number(value: &Value) -> f64 {
    value.as_f64().unwrap()
}

/// The tether of deck HE01.
fn line() -> Line {
    // outer diameter, wall, density, modulus of the geometric and material groups 1 to 5
    const GROUPS: [[f64; 4]; 5] = [
        [2.0, 0.84010, 7.850263, 2.0e5],
        [2.5822, 0.01010, 7.850263, 1.35e7],
        [1.1176, 0.03800, 7.816940, 2.15e8],
        [1.9993, 0.03890, 7.751645, 1.35e7],
        [0.670, 0.10650, 7.751645, 1.35e7],
    ];
    let mut nodes = vec![0.0, 1.053];
    nodes.extend((0..10).map(|i| 7.503 + 27.787 * f64::from(i)));
    nodes.extend([262.636, 266.486]);
    let groups = [1, 2, 3, 3, 3, 3, 3, 3, 3, 3, 3, 4, 5];
    let element = |(i, group): (usize, &i64)| {
        let [outer_diameter, wall_thickness, density, youngs_modulus] = GROUPS[*group as usize - 1];
        let label =
            windlass::tether::line::Label { nodes: [i as i64 + 1, i as i64 + 2], material: *group, geometry: *group };
        let length = nodes[i + 1] - nodes[i];
        TetherElement {
            length,
            outer_diameter,
            wall_thickness,
            density,
            youngs_modulus,
            drag: 0.75,
            added_mass: 1.0,
            label,
        }
    };
    Line::new(groups.iter().enumerate().map(element).collect()).unwrap()
}

/// The fifty waves with their printed wave numbers and phases; amplitudes are equal, 1/50 of the energy within the limits.
fn waves() -> Vec<Component> {
    let amplitude = (2.0 * (6.2934f64 / 4.0).powi(2) / 50.0).sqrt();
    let lines = printed()["spectral_lines"].as_array().unwrap().clone();
    let wave = |line: &Value| {
        // the wave number has a digit more than the frequency
        let k = number(&line[1]);
        let frequency = (9.81 * k * (345.0 * k).tanh()).sqrt();
        Component { frequency, number: k, amplitude, toward: [-1.0, 0.0], phase: number(&line[3]).to_radians() }
    };
    lines.iter().map(wave).collect()
}

fn case() -> Towed {
    let spring = EndSpring { along: 0.5, y: 0.5, z: 0.5 };
    Towed {
        line: line(),
        origin: [-266.486, 0.0, -0.5],
        heading: 0.0,
        springs: [spring; 2],
        density: 1.027,
        gravity: 9.81,
        depth: Some(345.0),
        waves: waves(),
        current: Vec::new(),
        tow: [0.0; 2],
        multipliers: Multipliers { slam: 1.0, ..Multipliers::default() },
        compatibility: Compatibility::aqwa_5_4(),
    }
}

/// The run of the deck: 1501 records at 0.25 s.
fn steps() -> Steps {
    Steps { step: 0.25, number: 1501, ..Steps::default() }
}

fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let list: Vec<f64> = values.collect();
    (list.iter().map(|v| v * v).sum::<f64>() / list.len() as f64).sqrt()
}

#[test]
fn scan() {
    let p = printed();
    let case = case();
    for mode in case.modes(8).unwrap() {
        println!("{:?} {:?}", mode.plane, mode.period());
    }
    let mut at = Vec::new();
    let begin = std::time::Instant::now();
    case.run(&steps(), &mut |r: &Record| {
        if [0, 500, 1000, 1500].contains(&r.index) {
            at.push((
                r.positions.to_vec(),
                r.velocities.to_vec(),
                r.accelerations.to_vec(),
                r.ends.to_vec(),
                r.along.to_vec(),
            ))
        }
    })
    .unwrap();
    println!("{:?}", begin.elapsed());
    for ((x, v, a, ends, along), t) in at.iter().zip(["0", "125", "250", "375"]) {
        let rows = p["history"][t]["motion"].as_array().unwrap();
        let row = |i: usize, c: usize| number(&rows[13 - i][c]);
        println!(
            "t {t} z {} vz {} az {} ary {} along {}",
            rms((0..14).map(|i| x[i][1] - row(i, 3))),
            rms((0..14).map(|i| v[i][1] - row(i, 7))),
            rms((0..14).map(|i| a[i][1] - row(i, 11))),
            rms((0..14).map(|i| a[i][2].to_degrees() - row(i, 12))),
            rms((0..14).map(|i| along[i] - row(i, 1)))
        );
        let forces = &p["history"][t]["nodal_forces"];
        let my = |i: usize| number(&forces[(i + 1).to_string()]["MY"]);
        println!("MY {}", rms((0..14).map(|i| ends[if i == 0 { 0 } else { 2 * i - 1 }].moment[0] - my(i))));
        for i in 0..14 {
            let e = ends[if i == 13 { 25 } else { 2 * i + usize::from(false) }];
            print!(
                "{:.2}/{:.2} {:.3}/{:.3}; ",
                e.moment[0],
                my(i),
                e.shear[1],
                number(&forces[(i + 1).to_string()]["SZ"])
            );
        }
        println!();
    }
}

#[test]
fn statistics() {
    let p = printed();
    let mut history = History { every: 2, ..History::default() };
    case().run(&steps(), &mut history).unwrap();
    let of = |s: &[f64]| {
        let s = &s[49..];
        let m = s.iter().sum::<f64>() / s.len() as f64;
        (m, 2.0 * (s.iter().map(|x| (x - m).powi(2)).sum::<f64>() / s.len() as f64).sqrt())
    };
    for i in 0..14 {
        for (q, g) in [(1, "pos"), (5, "vel"), (9, "acc")] {
            let (m, r) = of(&history.node(i, 14, q));
            let want = &p["stats"][g][(i + 1).to_string()];
            print!("{g} {:.4} {:.3}%  ", m - number(&want["mean"][1]), 100.0 * (r / number(&want["rms2"][1]) - 1.0));
        }
        println!();
    }
    for e in 0..13 {
        for end in 0..2 {
            let (m, r) = of(&history.end(2 * e + end, 13, 2));
            let want = &p["stats"]["bm"][format!("{}{}", e + 1, ["a", "b"][end])];
            println!(
                "{e}{end} {:.3} {:.3}%",
                m - number(&want["mean"][0]),
                100.0 * (r / number(&want["rms2"][0]) - 1.0)
            );
        }
    }
}
