//! The 2,000 random single lines of tests/data/catenary_2000.csv, solved by nested bracketing to 1e-12 of the length:
//! forces within 1e-8 of the fairlead tension, the same regime, and a tangent that is the difference of the force.

use windlass_catenary::{EndForces, FlatBottom, Segment};

struct ListedLine {
    id: String,
    segment: Segment,
    x: f64,
    z: f64,
    bottom: Option<FlatBottom>,
    fairlead: [f64; 2],
    anchor: [f64; 2],
    grounded: f64,
    regime: String,
}

fn cases() -> Vec<ListedLine> {
    let mut reader = csv::Reader::from_path("../../tests/data/catenary_2000.csv").unwrap();
    let read = |row: csv::StringRecord| {
        let v = |i: usize| row[i].parse::<f64>().unwrap();
        ListedLine {
            id: row[0].to_string(),
            x: v(2),
            z: v(3),
            segment: Segment { length: v(4), ea: v(5), weight: v(6) },
            bottom: (&row[8] == "0").then(|| FlatBottom { friction: v(7) }),
            fairlead: [v(9), v(10)],
            anchor: [v(11), v(12)],
            grounded: v(13),
            regime: row[14].to_string(),
        }
    };
    reader.records().map(|r| read(r.unwrap())).collect()
}

#[test]
fn all_lines_agree_to_1e_8_of_fairlead_tension() {
    let cases = cases();
    assert_eq!(cases.len(), 2000);
    let (mut worst, mut wrong, mut steps) = (0.0_f64, Vec::new(), 0);
    for c in &cases {
        let got = match c.segment.solve_end_forces(c.x, c.z, c.bottom) {
            Ok(got) => got,
            Err(error) => {
                wrong.push(format!("{} {}: {error}", c.id, c.regime));
                continue;
            }
        };
        let scale = c.fairlead[0].hypot(c.fairlead[1]).max(f64::MIN_POSITIVE);
        let pairs = c.fairlead.iter().zip(&got.fairlead).chain(c.anchor.iter().zip(&got.anchor));
        let error = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) / scale;
        let ground = (got.grounded - c.grounded).abs() / c.segment.length;
        worst = worst.max(error);
        steps += got.iterations;
        if error > 1e-8 || ground > 1e-7 || got.regime.name() != c.regime {
            wrong.push(format!("{} {} {:?}: {error:.2e}, ground {ground:.2e}", c.id, c.regime, got.regime));
        }
    }
    assert!(wrong.is_empty(), "{} wrong\n{}", wrong.len(), wrong.join("\n"));
    println!("largest error {worst:.2e}, {:.2} steps a line", steps as f64 / cases.len() as f64);
}

#[test]
fn stiffness_matches_finite_difference_of_force() {
    for c in cases().iter().filter(|c| c.x > 0.0 && c.z != 0.0) {
        let at = |x: f64, z: f64| c.segment.solve_end_forces(x, z, c.bottom).unwrap();
        let middle = at(c.x, c.z);
        // as far as H changes by some 1e-4 of itself, so that rounding of the distances stays below
        let tension = middle.fairlead[0].hypot(middle.fairlead[1]);
        let size = middle.stiffness.iter().flatten().fold(0.0_f64, |m, v| m.max(v.abs()));
        let d = 1e-4 * (tension / size).min(c.x).min(c.z.abs());
        let (e, w) = (at(c.x + d, c.z), at(c.x - d, c.z));
        let (n, s) = (at(c.x, c.z + d), at(c.x, c.z - d));
        if [e, w, n, s].iter().any(|a| a.regime != middle.regime) || middle.fairlead[0] < 1e-6 * tension {
            continue;
        }
        for row in 0..2 {
            for (column, (plus, minus)) in [(&e, &w), (&n, &s)].into_iter().enumerate() {
                let difference = (plus.fairlead[row] - minus.fairlead[row]) / (2.0 * d);
                let off = (difference - middle.stiffness[row][column]).abs() / size;
                assert!(off < 1e-5, "{} {} k{row}{column}: {off:.1e} of {size:.3e}", c.id, c.regime);
            }
        }
    }
}

#[test]
fn suspended_line_reversed_or_mirrored_keeps_its_forces() {
    for c in cases().iter().filter(|c| c.regime == "suspended" && c.bottom.is_none()) {
        let there = c.segment.solve_end_forces(c.x, c.z, None).unwrap();
        let back = c.segment.solve_end_forces(c.x, -c.z, None).unwrap();
        let scale = 1e-8 * there.fairlead[0].hypot(there.fairlead[1]).max(there.anchor[1].abs());
        assert!((there.fairlead[0] - back.fairlead[0]).abs() < scale, "{}", c.id);
        assert!((there.fairlead[1] + back.anchor[1]).abs() < scale, "{}", c.id);
        let turned = Segment { weight: -c.segment.weight, ..c.segment }.solve_end_forces(c.x, -c.z, None).unwrap();
        assert!((there.fairlead[1] + turned.fairlead[1]).abs() < scale, "{}", c.id);
    }
}

#[test]
fn extreme_numbers_are_errors_and_never_nan() {
    let values = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e-300, 1e-9, 1.0, 1e9, 1e300];
    for length in values {
        for weight in values {
            for ea in values {
                for (x, z) in values.into_iter().flat_map(|x| values.map(|z| (x, z))) {
                    for bottom in [None, Some(FlatBottom { friction: 0.0 }), Some(FlatBottom { friction: 0.7 })] {
                        let Ok(got) = (Segment { length, weight, ea }).solve_end_forces(x, z, bottom) else { continue };
                        let all = got.fairlead.into_iter().chain(got.anchor).chain([got.grounded]);
                        assert!(all.into_iter().all(f64::is_finite), "{length} {weight} {ea} {x} {z}: {got:?}");
                    }
                }
            }
        }
    }
}

#[test]
fn weightless_line_is_tension_only_spring() {
    let spring = Segment { length: 100.0, weight: 0.0, ea: 1e6 };
    let got = spring.solve_end_forces(60.6, 80.8, None).unwrap();
    assert!((got.fairlead[0] - 6e3).abs() < 1e-6 && (got.fairlead[1] - 8e3).abs() < 1e-6, "{got:?}");
    for (x, z, bottom) in
        [(30.0, 40.0, None), (0.0, 40.0, None), (0.0, 0.0, None), (30.0, 40.0, Some(FlatBottom { friction: 0.3 }))]
    {
        let slack = spring.solve_end_forces(x, z, bottom).unwrap();
        assert_eq!((slack.fairlead, slack.anchor, slack.stiffness), ([0.0; 2], [0.0; 2], [[0.0; 2]; 2]), "{x} {z}");
        assert_eq!(slack.regime.name(), "weightless_slack");
    }
}

#[test]
fn vertical_line_is_limit_of_nearly_vertical_line() {
    for (weight, z) in [(800.0, 120.0), (800.0, 101.0), (800.0, 30.0), (800.0, -45.0), (-300.0, 130.0), (0.0, 130.0)] {
        let segment = Segment { length: 100.0, weight, ea: 1e6 };
        let (at, near) =
            (segment.solve_end_forces(0.0, z, None).unwrap(), segment.solve_end_forces(1e-9, z, None).unwrap());
        let scale = at.fairlead[1].abs().max(at.anchor[1].abs());
        assert!((at.fairlead[1] - near.fairlead[1]).abs() < 1e-8 * scale, "{weight} {z}: {at:?} {near:?}");
        assert!((at.anchor[1] - near.anchor[1]).abs() < 1e-8 * scale, "{weight} {z}: {at:?} {near:?}");
        assert!((at.stiffness[1][1] / near.stiffness[1][1] - 1.0).abs() < 1e-6, "{weight} {z}: {at:?} {near:?}");
        if at.stiffness[0][0] > 0.0 {
            assert!((at.stiffness[0][0] / near.stiffness[0][0] - 1.0).abs() < 1e-6, "{weight} {z}: {at:?} {near:?}");
        }
    }
}

/// The larger of the differences at fairlead and anchor, as a share of the tension at the fairlead.
fn apart(a: &EndForces, b: &EndForces) -> f64 {
    let pairs = a.fairlead.iter().zip(&b.fairlead).chain(a.anchor.iter().zip(&b.anchor));
    let most = pairs.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    if most == 0.0 { 0.0 } else { most / a.fairlead[0].hypot(a.fairlead[1]) }
}

#[test]
fn warm_started_line_matches_cold_start_along_its_path() {
    let (mut worst, mut warm) = (0.0_f64, 0);
    for c in cases() {
        let mut last = c.segment.solve_end_forces(c.x, c.z, c.bottom).unwrap();
        for n in 1..=100 {
            let phase = std::f64::consts::TAU * f64::from(n) / 100.0;
            let x = (c.x + 0.01 * c.segment.length * phase.sin()).max(0.0);
            let rise = 0.005 * c.segment.length * (phase.cos() - 1.0);
            let z = if c.bottom.is_some() { (c.z + rise).max(0.0) } else { c.z + rise };
            let cold = c.segment.solve_end_forces(x, z, c.bottom).unwrap();
            last = c.segment.solve_warm_start(x, z, c.bottom, &last).unwrap();
            assert_eq!(last.regime, cold.regime, "{} step {n}", c.id);
            assert_eq!(last.at, [x, z]);
            assert!((last.grounded - cold.grounded).abs() <= 1e-8 * c.segment.length, "{} step {n}", c.id);
            let error = apart(&cold, &last);
            assert!(error <= 1e-9, "{} step {n}: {error:.2e}\n{cold:?}\n{last:?}", c.id);
            worst = worst.max(error);
            warm += u32::from(last != cold);
        }
    }
    println!("largest difference {worst:.2e}, {warm} followed");
}

#[test]
fn warm_start_from_any_line_gives_same_result() {
    let cases = cases();
    let answers: Vec<_> = cases.iter().map(|c| c.segment.solve_end_forces(c.x, c.z, c.bottom).unwrap()).collect();
    for (n, (c, answer)) in cases.iter().zip(&answers).enumerate() {
        for far in (1..40).map(|k| &answers[(n + 37 * k) % answers.len()]) {
            let spoilt = [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300];
            let spoilt = spoilt.into_iter().flat_map(|v| {
                let at = EndForces { at: [v, v], ..*answer };
                let forces = EndForces { fairlead: [v, -v], ..*answer };
                [at, forces, EndForces { stiffness: [[v, 0.0], [v, -v]], ..*answer }]
            });
            for last in [*far, EndForces { regime: answer.regime, ..*far }].into_iter().chain(spoilt) {
                let got = c.segment.solve_warm_start(c.x, c.z, c.bottom, &last).unwrap();
                assert_eq!(got.regime, answer.regime, "{} from {last:?}", c.id);
                let error = apart(answer, &got);
                assert!(error <= 1e-9, "{} from {last:?}: {error:.2e}", c.id);
            }
        }
        assert!(c.segment.solve_warm_start(-1.0, c.z, c.bottom, answer).is_err());
        assert!(c.segment.solve_warm_start(c.x, f64::NAN, c.bottom, answer).is_err());
    }
}
