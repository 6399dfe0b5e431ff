//! The time domain against closed forms: free and damped oscillation, conserved energy, order of accuracy, free rotation.

#![allow(clippy::unwrap_used)]

use crate::common::run as runs;

use runs::{model, run, settings, trapezoidal};
use std::f64::consts::TAU;
use windlass_base::pose::Six;
use windlass_model::Model;
use windlass_solve::time::{Ending, History, Method, Run, RunSettings, SilentWatcher, TimeScheme};

fn x(history: &History) -> Vec<f64> {
    history.series(history.layout.body(0))
}

/// 1000 kg on a spring of 4000 N/m along X, 2 rad/s, drawn out 0.5 m; `more` are further records of the body.
fn mass_on_a_spring(more: &str, start: f64) -> Model {
    let weight = 1000.0 * 9.80665;
    model(&format!(
        "MEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C {weight} 1 1 1\n{more}\
         ~SPRING GSPR BOTH X 4000 1E9 -LEN 0\nCONNECTOR S ~SPRING *C *G\nEND\n&INSTATE -LOCATE CART {start} 0 0\n"
    ))
}

#[test]
fn linear_spring_energy_drifts_below_1e_9_over_1000_periods() {
    let model = mass_on_a_spring("", 0.5);
    let period = TAU / 2.0;
    let made = run(&model, RunSettings { method: trapezoidal(), ..settings(1000.0 * period, period / 20.0) }, vec![]);
    let at = made.history.layout.body(0);
    let energy = |row: &[f64]| 0.5 * 4000.0 * row[at] * row[at] + 0.5 * 1000.0 * row[at + 6] * row[at + 6];
    let mut rows = made.history.rows();
    let first = energy(rows.next().unwrap());
    let worst = rows.map(|r| (energy(r) / first - 1.0).abs()).fold(0.0, f64::max);
    assert!(worst <= 1e-9, "{worst:e}");
    // linear: one iteration a step
    assert_eq!(made.counts.iterations, made.counts.steps);
}

#[test]
fn trapezoidal_rule_oscillates_with_its_closed_form_period() {
    // tan(W h/2) = w h/2 [HUGHES-1987 9.1]: x = cos(W t) at the steps
    let model = mass_on_a_spring("", 0.5);
    let h: f64 = 0.1;
    let made = run(&model, RunSettings { method: trapezoidal(), ..settings(50.0, h) }, vec![]);
    let frequency = 2.0 / h * (2.0 * h / 2.0).atan();
    for (row, time) in x(&made.history).iter().zip(made.history.times()) {
        assert!((row - 0.5 * (frequency * time).cos()).abs() < 1e-9, "{time} {row}");
    }
}

#[test]
fn halving_step_quarters_error_of_every_scheme() {
    let model = mass_on_a_spring("", 0.5);
    for method in
        [Method::default(), trapezoidal(), Method::Implicit(TimeScheme::generalised_alpha(0.5)), Method::Corrector]
    {
        let error = |h: f64| {
            let made = run(&model, RunSettings { method, ..settings(10.0, h) }, vec![]);
            (x(&made.history).last().unwrap() - 0.5 * 20f64.cos()).abs()
        };
        let errors = [0.05, 0.025, 0.0125].map(error);
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            assert!((1.9..2.1).contains(&order), "{method:?} {errors:?}");
        }
    }
}

#[test]
fn linear_damping_matches_logarithmic_decrement_and_damped_period() {
    // 5 % of critical: c = 2 * 0.05 * sqrt(k m)
    let (ratio, w) = (0.05f64, 2.0);
    let model = mass_on_a_spring(&format!("#DAMP *C {} 0 0 0 0 0\n", 2.0 * ratio * 2000.0), 0.5);
    let made = run(&model, RunSettings { method: trapezoidal(), ..settings(20.0, 0.005) }, vec![]);
    let damped = w * (1.0 - ratio * ratio).sqrt();
    for (row, t) in x(&made.history).iter().zip(made.history.times()) {
        let exact = 0.5 * (-ratio * w * t).exp() * ((damped * t).cos() + ratio * w / damped * (damped * t).sin());
        // the error of the period: (w h)^2/12 of w t
        assert!((row - exact).abs() < 0.5 * 40.0 * 1e-4 / 12.0 * 1.1, "{t} {row} {exact}");
    }
}

#[test]
fn free_top_conserves_energy_and_angular_momentum_to_step_order() {
    // unlike moments of inertia, turning about none of its axes; Euler's equations leave both constant
    let weight = 1000.0 * 9.80665;
    let model = model(&format!(
        "MEDIT\n&DESCRIBE BODY TOP -IGNORE X Y Z\n*C 0 0 0\n#WEIGHT *C {weight} 1 2 3\nEND\n&INSTATE -LOCATE TOP 0 0 0\n"
    ));
    let drift = |h: f64| {
        let mut made = Run::new(&model, settings(20.0, h), vec![]).unwrap();
        made.begin_with(&[(0, Six::new(0.0, 0.0, 0.0, 0.3, 0.6, 0.2))]).unwrap();
        assert_eq!(made.run(&mut SilentWatcher), Ok(Ending::Done));
        let inertia = nalgebra::Matrix3::from_diagonal(&nalgebra::Vector3::new(1.0, 4.0, 9.0)) * 1000.0;
        let motion = made.motions()[0];
        let turn = motion.velocity.fixed_rows::<3>(3).into_owned();
        let momentum = motion.pose.axes * inertia * motion.pose.axes.transpose() * turn;
        let start = inertia * nalgebra::Vector3::new(0.3, 0.6, 0.2);
        let energy = 0.5 * turn.dot(&momentum);
        let first = 0.5 * start.dot(&nalgebra::Vector3::new(0.3, 0.6, 0.2));
        ((momentum - start).norm() / start.norm()).max((energy / first - 1.0).abs())
    };
    let errors = [0.1, 0.05, 0.025].map(drift);
    for pair in errors.windows(2) {
        assert!((pair[0] / pair[1]).log2() > 1.8, "{errors:?}");
    }
}

#[test]
fn coulomb_friction_reduces_every_swing_equally_and_stops_cart() {
    // 1000 kg on the ground, friction 0.05, on 4000 N/m: each half swing is 2 mu m g / k shorter than the one before; it stops
    // where the spring no longer overcomes the friction
    let weight = 1000.0 * 9.80665;
    let model = model(&format!(
        "MEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y RX RY RZ\n*C 0 0 0\n#WEIGHT *C {weight} 1 1 1\n\
         ~REST GAP 0.05\nCONNECTOR R -EULER 0 90 0 ~REST *C\n~SPRING GSPR BOTH X 4000 1E9 -LEN 0\n\
         CONNECTOR S ~SPRING *C *G\nEND\n&INSTATE -LOCATE CART 2 0 0\n"
    ));
    let made = run(&model, settings(20.0, 0.002), vec![]);
    let positions = x(&made.history);
    let turns: Vec<f64> = positions
        .windows(3)
        .filter(|w| (w[1] - w[0]) * (w[2] - w[1]) < 0.0 && (w[1] - w[0]).abs() > 1e-9)
        .map(|w| w[1].abs())
        .collect();
    let loss = 2.0 * 0.05 * weight / 4000.0;
    for (n, turn) in turns.iter().take(7).enumerate() {
        let exact = 2.0 - loss * (n + 1) as f64;
        // the weight comes upon the contact at the start and swings there: 1e-8 m; the turn lies between two steps
        assert!((turn - exact).abs() < 1e-3, "{n} {turn} {exact}");
    }
    let last = positions.last().unwrap();
    assert!(last.abs() <= loss / 2.0 && (last - positions[positions.len() - 500]).abs() < 1e-6, "{last}");
}

#[test]
fn pendulum_period_matches_large_angle_closed_form() {
    // 1000 kg on a pin 10 m below it, let go at 60 degrees: T = 4 K(sin 30) sqrt(L/g) = 1.0731820 * 2 pi sqrt(L/g)
    // (Abramowitz and Stegun 17.3.1: K at modulus 0.5 is 1.6857503548)
    let weight = 1000.0 * 9.80665;
    let (sin, cos) = 60f64.to_radians().sin_cos();
    let (x0, z0) = (10.0 * sin, -10.0 * cos);
    let model = model(&format!(
        "MEDIT\n*G 0 0 0\n&DESCRIBE BODY BOB\n*C 0 0 0\n*PIN 0 0 10\n#WEIGHT *C {weight} 0.1 0.1 0.1\nEND\n\
         &INSTATE -LOCATE BOB {x0} 0 {z0} 0 -60 0\nMEDIT\n~P SPR X 1E9 Y 1E9 Z 1E9\nCONNECTOR H ~P *PIN *G\nEND\n"
    ));
    let period = 4.0 * 1.685_750_354_8 * (10.0f64 / 9.80665).sqrt();
    let made = run(&model, settings(3.0 * period, 0.005), vec![]);
    let history = &made.history;
    let positions = x(history);
    let times = history.times();
    // the body's moment of inertia about the pin is m (L^2 + 0.01): its period longer by 0.5e-4
    let crossings: Vec<f64> = (1..positions.len())
        .filter(|i| positions[i - 1] < 0.0 && positions[*i] >= 0.0)
        .map(|i| times[i - 1] - positions[i - 1] * (times[i] - times[i - 1]) / (positions[i] - positions[i - 1]))
        .collect();
    let found = crossings[1] - crossings[0];
    let exact = period * (1.0f64 + 1e-4).sqrt();
    // of the step: (w h)^2 / 12 of the period, w = 2 pi / 6.8 s, a little more at large angles
    assert!((found / exact - 1.0).abs() < 1e-5, "{found} {exact}");
}

#[test]
fn berthing_fender_absorbs_ship_energy_and_friction_its_impulse() {
    // 1000 t at 0.15 m/s: 11.25 kNm, the area under 360 kN/m up to 0.25 m, after pi / 2 / sqrt(360 / 1000) = 2.618 s. It slides along at
    // 1 m/s: friction 0.2 takes 0.2 x 2 x 0.15 m/s while the push turns the ship back, whatever its curve. Steps of 0.01 s: 1e-5 of each
    let ship = model(
        "MEDIT\n*Q 0 0 0\n&DESCRIBE BODY SHIP -IGNORE Z RX RY RZ\n*C 0 0 0\n*SIDE 0 1.5 0\n#WEIGHT *C 9806650 5 5 5\n\
         ~F FENDER 1.5 9E4 0.25 4E5 0.6 -NORMAL 0 1 0 -RATED 0.2 -FRICTION 0.2\nCONNECTOR F ~F *Q *SIDE\nEND\n",
    );
    let mut made = Run::new(&ship, RunSettings { method: trapezoidal(), ..settings(8.0, 0.01) }, vec![]).unwrap();
    made.begin_with(&[(0, Six::new(1.0, -0.15, 0.0, 0.0, 0.0, 0.0))]).unwrap();
    made.run(&mut SilentWatcher).unwrap();
    let peaks = windlass_solve::results::fender_peaks(&made).unwrap();
    let [peak] = peaks.as_slice() else { panic!("{peaks:?}") };
    for (got, want) in [(peak.state.deflection, 0.25), (peak.state.reaction, 9e4), (peak.state.energy, 11_250.0)] {
        assert!((got / want - 1.0).abs() < 1e-5, "{got} is not {want}");
    }
    assert!((peak.time - 2.618).abs() < 0.011, "{}", peak.time);
    let at = made.history.layout.body(0);
    let last = made.history.rows().last().unwrap();
    assert!((last[at + 7] - 0.15).abs() < 1e-6, "{}", last[at + 7]);
    // rounded off under 0.01 m/s: v0^2 / (2 v^2) of it
    assert!((last[at + 6] - 0.94).abs() < 6e-6, "{}", last[at + 6]);
}
