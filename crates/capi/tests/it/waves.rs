//! Lines of another program in waves: Morison's force on a taut vertical line by an integral of its own.

use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};
use windlass::hosted::LineWater;
use windlass_line_dynamics::{CoupledLine, CoupledLines, Rod, RodSegment, Surroundings, UniformFluid};

const DENSITY: f64 = 1025.0;
const GRAVITY: f64 = 9.80665;
const DEPTH: f64 = 50.0;
const AMPLITUDE: f64 = 2.0;
const PERIOD: f64 = 10.0;
const DIAMETER: f64 = 0.3;
const DRAG: f64 = 1.2;
const ADDED: f64 = 1.0;

/// Length without tension (m) of the line that is 10 m long: its loads are those of this length.
const UNSTRETCHED: f64 = 9.99;

/// Force (N) along the wave on a cylinder between 20 and 10 m below the surface at x = 0, by linear theory and Simpson's rule, of the length
/// without tension.
fn morison(time: f64, current: f64) -> f64 {
    let w = TAU / PERIOD;
    let k = (0..100).fold(w * w / GRAVITY, |k, _| w * w / (GRAVITY * (k * DEPTH).tanh()));
    let load = |z: f64| {
        let profile = AMPLITUDE * w * (k * (z + DEPTH)).cosh() / (k * DEPTH).sinh();
        let (u, rate) = (profile * (w * time).cos() + current, -profile * w * (w * time).sin());
        0.25 * PI * DIAMETER * DIAMETER * DENSITY * (1.0 + ADDED) * rate + 0.5 * DENSITY * DRAG * DIAMETER * u.abs() * u
    };
    let n = 200;
    let weight = |i: i32| {
        if i == 0 || i == n {
            1.0
        } else if i % 2 == 1 {
            4.0
        } else {
            2.0
        }
    };
    let h = 10.0 / f64::from(n);
    (0..=n).map(|i| weight(i) * load(-20.0 + h * f64::from(i))).sum::<f64>() * h / 3.0 * UNSTRETCHED / 10.0
}

/// A line of 10 m whose ends stay, pulled by 1 MN.
fn lines(current: f64, environment: &str) -> CoupledLines {
    let segment = RodSegment {
        drag_normal: DRAG,
        drag_tangential: 0.0,
        added_normal: ADDED,
        added_tangential: 0.0,
        ..RodSegment::line(UNSTRETCHED, 50, 100.0, 1e9, DIAMETER)
    };
    let rod = Rod::new("line", vec![segment], Vec::new()).unwrap();
    let line = CoupledLine { rod, anchor: Vector3::new(0.0, 0.0, -20.0), fairlead: Vector3::new(0.0, 0.0, -10.0) };
    let water = LineWater { depth: Some(DEPTH), density: DENSITY, gravity: GRAVITY };
    let around = Surroundings {
        water: UniformFluid::moving(DENSITY, Vector3::x() * current),
        ambient: Some(water.ambient(environment).unwrap()),
        bottom: None,
        gravity: GRAVITY,
    };
    CoupledLines::new(vec![line], around, 0.05).unwrap()
}

fn along(lines: &CoupledLines) -> f64 {
    lines.fairlead_forces()[0].x + lines.anchor_forces()[0].x
}

#[test]
fn wave_on_a_taut_vertical_line_is_morison() {
    for current in [0.0, 0.8] {
        let mut lines = lines(current, "-WAVES 10 2 0 180 -RAMP 20");
        // at rest the current alone
        let (found, wanted) = (along(&lines), 0.5 * DENSITY * DRAG * DIAMETER * current * current * UNSTRETCHED);
        assert!((found - wanted).abs() < 0.5, "{found} is not {wanted}");
        let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
        for step in 1..=80 {
            let time = 0.5 * f64::from(step);
            lines.step(time, &[Vector3::new(0.0, 0.0, -10.0)], &[Vector3::zeros()]).unwrap();
            if time > 25.0 {
                let wanted = morison(time, current);
                largest = largest.max(wanted.abs());
                worst = worst.max((along(&lines) - wanted).abs());
            }
        }
        // the line gives way by millimetres, and a node stands for 0.2 m
        assert!(worst < 0.005 * largest, "{worst} of {largest} N");
    }
}

#[test]
fn environment_of_lines_is_one_record_without_depth() {
    let water = LineWater { depth: Some(DEPTH), density: DENSITY, gravity: GRAVITY };
    for (options, said) in [
        ("-SEA JONSVAP 180 9 12", "JONSWAP"),
        ("-SEA JONSWAP 180 9 12\n&FINISH", "one &ENV record"),
        ("-DEPTH 80", "arguments of their own"),
        ("-SEE", "-SEE"),
    ] {
        let error = water.ambient(options).err().map(|error| error.rendered).unwrap_or_default();
        assert!(error.contains(said), "{options}: {error}");
    }
    assert!(water.ambient("-SEA JONSWAP 180 9 12 3.3 -SEED 5 -RAMP 60").is_ok());
}
