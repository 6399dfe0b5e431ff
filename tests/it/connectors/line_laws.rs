//! Laws that every line class obeys, whatever its force: a new one is under them the day it is registered.

use crate::common;

use windlass::session::Session;
use windlass_connectors::CLASSES;
use windlass_model::{LineLoads, Placement};

/// A line class, records of it, its ends, whether to ground, and whether its forces have an energy.
type Example = (&'static str, &'static str, [f64; 3], [f64; 3], bool, bool);

/// Records of each line class, between ends where every part of its law acts: the fairlead, the other end, to ground; and
/// whether its forces have an energy: friction, mobilised toward the fairlead, depends on the vertical force alone and has
/// none.
const EXAMPLES: &[Example] = &[
    (
        "B_CAT",
        "~L B_CAT 100 EXACT -LEN 500 -BUOY 0 -WTPL 900 -DEP 200 -SEND 4E6 -CLUMP 5E4\n~L B_CAT 80 -LEN 600 -BUOY 0 -WTPL 500",
        [0.0, 0.0, -5.0],
        [900.0, 550.0, -200.0],
        true,
        true,
    ),
    (
        "B_CAT",
        "~L B_CAT 100 EXACT -LEN 500 -BUOY 0 -WTPL 900 -DEP 200 -FRICTION 0.5\n~L B_CAT 80 -LEN 600 -BUOY 0 -WTPL 500",
        [0.0, 0.0, -5.0],
        [900.0, 550.0, -200.0],
        true,
        false,
    ),
    ("H_CAT", "~L H_CAT 100 EXACT -LEN 320 -WTPL 700", [0.0, 0.0, 30.0], [200.0, 180.0, -10.0], false, true),
    ("H_CAT", "~L H_CAT 100 -LEN 250 -X_PY 1E5 0.2 1E6 0.5", [0.0, 0.0, 30.0], [200.0, 180.0, -10.0], false, true),
    ("SL_ELEM", "~L SL_ELEM 100 -LEN 300", [0.0, 0.0, 30.0], [200.0, 180.0, -10.0], false, true),
    (
        "CATENARY",
        "~L CATENARY 170 0.02 -LEN 280 -EA 7E8 -K 1E8 2E9 -CLUMP 3000 500\n~L CATENARY 60 0.01 -LEN 100 -EA 2E8",
        [0.0, 0.0, 30.0],
        [300.0, 180.0, -10.0],
        false,
        true,
    ),
];

struct SessionBench(Session);

impl SessionBench {
    fn new(records: &str) -> SessionBench {
        let (mut session, screen, _folder) = common::session();
        session.open("records", format!("&DIMEN -DIMEN METERS N\n&ENV -DEPTH 300\nMEDIT\n{records}\nEND\n"));
        session.run();
        assert!(!session.job.model.classes.is_empty(), "{records}: {:?} {}", session.reports, screen.text());
        SessionBench(session)
    }

    fn loads(&self, fairlead: [f64; 3], other: [f64; 3], to_ground: bool) -> LineLoads {
        let model = &self.0.job.model;
        let anchored = to_ground;
        let position = Placement { fairlead, other: Some(other), to_ground, anchored, ..Placement::default() };
        let class = model.classes.values().next_back().unwrap();
        class.line(&position, &model.surroundings()).unwrap().loads().unwrap()
    }
}

fn rotate_about_z([x, y, z]: [f64; 3], angle: f64) -> [f64; 3] {
    let (s, c) = angle.sin_cos();
    [c * x - s * y, s * x + c * y, z]
}

fn assert_near(got: [f64; 3], want: [f64; 3], share: f64, what: &str) {
    let size = want.iter().map(|v| v * v).sum::<f64>().sqrt();
    for (a, b) in got.iter().zip(want) {
        assert!((a - b).abs() <= share * size, "{what}: {got:?} is not {want:?}");
    }
}

#[test]
fn every_line_class_is_tested() {
    for kind in CLASSES {
        let name = kind.spec.name;
        let bench = SessionBench::new(kind.spec.example.trim_start_matches("MEDIT\n").split("\nEND").next().unwrap());
        let line = bench.0.job.model.classes.values().next_back().is_some_and(|c| c.object.as_line().is_some());
        assert_eq!(line, EXAMPLES.iter().any(|e| e.0 == name), "{name}");
    }
}

#[test]
fn rotated_or_mirrored_line_has_rotated_or_mirrored_forces() {
    for (name, records, from, to, ground, _) in EXAMPLES {
        let bench = SessionBench::new(records);
        let straight = bench.loads(*from, *to, *ground);
        for angle in [0.4, 1.9, 3.0, -2.2] {
            let got = bench.loads(rotate_about_z(*from, angle), rotate_about_z(*to, angle), *ground);
            assert_near(got.fairlead, rotate_about_z(straight.fairlead, angle), 1e-9, name);
            assert_near(got.other, rotate_about_z(straight.other, angle), 1e-9, name);
        }
        let mirror = |[x, y, z]: [f64; 3]| [x, -y, z];
        assert_near(bench.loads(mirror(*from), mirror(*to), *ground).fairlead, mirror(straight.fairlead), 1e-9, name);
        let shift = |[x, y, z]: [f64; 3]| [x + 1234.5, y - 777.0, z];
        assert_near(bench.loads(shift(*from), shift(*to), *ground).fairlead, straight.fairlead, 1e-8, name);
    }
}

#[test]
fn stiffness_is_symmetric_and_matches_force_finite_difference() {
    for (name, records, from, to, ground, conservative) in EXAMPLES {
        let bench = SessionBench::new(records);
        let middle = bench.loads(*from, *to, *ground);
        let scale = middle.stiffness.iter().flatten().fold(0.0, |m: f64, k| m.max(k.abs()));
        for axis in 0..3 {
            let moved = |by: f64| {
                let mut at = *from;
                at[axis] += by;
                bench.loads(at, *to, *ground).fairlead
            };
            let (plus, minus) = (moved(1e-4), moved(-1e-4));
            for row in 0..3 {
                let slope = (plus[row] - minus[row]) / 2e-4;
                let got = middle.stiffness[row][axis];
                assert!((slope - got).abs() <= 1e-5 * scale, "{name} [{row}][{axis}]: {got} is not {slope}");
                let across = middle.stiffness[axis][row];
                assert!(
                    !conservative || (across - got).abs() <= 1e-9 * scale,
                    "{name} [{row}][{axis}]: {got} {across}"
                );
            }
        }
    }
}

#[test]
fn line_force_does_no_work_over_closed_path() {
    for (name, records, from, to, ground, _) in EXAMPLES.iter().filter(|e| e.5) {
        let bench = SessionBench::new(records);
        let at = |t: f64| {
            let (s, c) = (std::f64::consts::TAU * t).sin_cos();
            [from[0] + 4.0 * c, from[1] + 3.0 * s, from[2] + 2.0 * s * c]
        };
        const STEPS: usize = 400;
        let (mut work, mut size) = (0.0, 0.0);
        for i in 0..STEPS {
            // midpoints: the error of a smooth closed path falls faster than any power of the step
            let t = (i as f64 + 0.5) / STEPS as f64;
            let h = 0.5 / STEPS as f64;
            let (a, b) = (at(t - h), at(t + h));
            let force = bench.loads(at(t), *to, *ground).fairlead;
            let step: f64 = (0..3).map(|k| force[k] * (b[k] - a[k])).sum();
            work += step;
            size += step.abs();
        }
        assert!(work.abs() <= 1e-6 * size, "{name}: {work} of {size}");
    }
}

#[test]
fn end_forces_balance_and_weight_hangs_between() {
    for (name, records, from, to, ground, conservative) in EXAMPLES {
        let bench = SessionBench::new(records);
        let got = bench.loads(*from, *to, *ground);
        let along = [to[0] - from[0], to[1] - from[1]];
        let length = along[0].hypot(along[1]);
        for force in [got.fairlead, got.other] {
            let across = (force[0] * along[1] - force[1] * along[0]) / length;
            assert!(across.abs() <= 1e-9 * got.tension.abs(), "{name}: {force:?}");
        }
        let horizontal = |f: [f64; 3]| (f[0] * along[0] + f[1] * along[1]) / length;
        let lost = horizontal(got.fairlead) + horizontal(got.other);
        let fine = 1e-9 * got.tension.abs();
        assert!(if *conservative { lost.abs() <= fine } else { lost > fine }, "{name}: {got:?}");
    }
}
