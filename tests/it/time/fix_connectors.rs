//! Bodies joined by FIX move as one rigid body, however light, far from the origin or far from their own: against closed forms.

#![allow(clippy::unwrap_used)]

use crate::common::run as runs;

use runs::{model, run, settings, trapezoidal};
use windlass_model::Model;
use windlass_solve::time::{Run, RunSettings, StepTolerance};
use windlass_solve::{EquilibriumOptions, find_equilibrium_with_rebuilds};

const G: f64 = 9.80665;

/// Weight of each body (N), distance of all from the origin in X and Y (m), of the origin of the second from its centre of gravity (m).
const CASES: [(f64, f64, f64); 6] = [
    (1e3, 10.0, 0.0),
    (1e4, 100.0, 0.0),
    (1e6, 5000.0, 0.0),
    (1e3, 10.0, 100.0),
    (1e6, 5000.0, 100.0),
    (1e3, 5000.0, 0.0),
];

/// Largest moment of inertia about an axis across, as a share of mass: radii of 2 m.
const RADIUS: f64 = 2.0;

/// Two bodies side by side, 8 m between their centres, joined half way, hung at that place on a spring (rad/s: its natural frequency).
fn pair(weight: f64, far: f64, off: f64, natural: f64) -> Model {
    let stiffness = 2.0 * weight / G * natural * natural;
    let (a, b) = (far - 4.0, far + 4.0 - off);
    model(&format!(
        "MEDIT\n*Q {far} {far} -10\n&DESCRIBE BODY A\n*CA 0 0 0\n*PA 4 0 0\n#WEIGHT *CA {weight} 2 2 2\n\
         &DESCRIBE BODY B\n*CB {off} 0 0\n*PB {} 0 0\n#WEIGHT *CB {weight} 2 2 2\nEND\n\
         &INSTATE -LOCATE A {a} {far} -10 -LOCATE B {b} {far} -10\nMEDIT\n\
         ~F FIX\nCONNECTOR F ~F *PA *PB\n\
         ~K GSPR BOTH X {stiffness} Y {stiffness} Z {stiffness} -LEN 0\nCONNECTOR K ~K *PA *Q\nEND\n",
        off - 4.0
    ))
}

fn link(made: &Run, name: &str) -> usize {
    made.history.layout.links.iter().position(|l| l.name == name).unwrap()
}

#[test]
fn bodies_joined_by_fix_heave_together_and_share_weight() {
    let (natural, h) = (2.0, 0.05);
    for (weight, far, off) in CASES {
        let model = pair(weight, far, off, natural);
        // FIX gives way by its moment, up to 8 m of the weight, over 1e12 N m/rad; nothing holds the pair, and what the steps leave adds up:
        // it is measured about a body's origin
        let tilt = 1e-6 * (1.0 + off / 10.0) + 8.0 * weight / 1e12;
        // which makes the spring softer by 4 m squared over that: the period longer by half of it, over 10 s, of the amplitude g/w2
        let softer = 2.0 * weight / G * natural * natural * 16.0 / 1e12;
        let late = 0.5 * softer * natural * 10.0 * G / (natural * natural);
        // a deflection that is rounding, as a step leaves it, rings on with 1e12 N/m under a rule that damps nothing
        let ring = 4.0 * 1e12 * (1e-13 + 8.0 * f64::EPSILON * far);
        let convergence = StepTolerance { tolerance: 1e-9, ..StepTolerance::default() };
        let made = run(&model, RunSettings { method: trapezoidal(), convergence, ..settings(10.0, h) }, vec![]);
        assert_eq!(made.counts.cut, 0, "{weight} {far} {off}");
        // from rest on an unstretched spring: z = -g/w2 (1 - cos W t), with the trapezoidal rule's tan(W h/2) = w h/2
        let rule = 2.0 / h * (0.5 * natural * h).atan();
        let history = &made.history;
        let [a, b] = [0, 1].map(|body| history.layout.body(body));
        let wrench = history.layout.wrench(link(&made, "F"), 1).unwrap();
        for (row, time) in history.rows().zip(history.times()) {
            let swing = G / (natural * natural) * (1.0 - (rule * time).cos());
            for (body, arm) in [(a, 4.0), (b, 4.0 + off)] {
                assert!(
                    (row[body + 2] + 10.0 + swing).abs() < 1e-6 + arm * tilt + late,
                    "{weight} {far} {off} at {time}: {} {swing}",
                    row[body + 2]
                );
                for turn in 3..6 {
                    assert!(row[body + turn].abs() < tilt, "{weight} {far} {off} at {time}: {row:?}");
                }
            }
            // the tie carries the other body: m (g + a) with a = w2 swing - g, and its moment about the middle, 4 m away
            let carried = weight / G * natural * natural * swing;
            let (force, moment) = (row[wrench + 2], row[wrench + 4]);
            assert!(
                (force - carried).abs() < 2e-6 * weight + weight / G * natural * natural * late + ring,
                "{weight} {far} {off} at {time}: {force} {carried}"
            );
            assert!(
                (moment - -4.0 * carried).abs()
                    < 2e-5 * weight + 4.0 * weight / G * natural * natural * late + 10.0 * ring,
                "{weight} {far} {off} at {time}: {moment} {carried}"
            );
        }
    }
}

/// Two bodies one below the other on a pin in the ground, 4 and 12 m below it, both with their origins at the pin.
fn pendulum(weight: f64, far: f64, degrees: f64) -> Model {
    model(&format!(
        "MEDIT\n*Q {far} {far} -10\n&DESCRIBE BODY A\n*TA 0 0 0\n*CA 0 0 -4\n*PA 0 0 -8\n#WEIGHT *CA {weight} 2 2 2\n\
         &DESCRIBE BODY B\n*CB 0 0 -12\n*PB 0 0 -8\n#WEIGHT *CB {weight} 2 2 2\nEND\n\
         &INSTATE -LOCATE A {far} {far} -10 -LOCATE B {far} {far} -10\nMEDIT\n\
         ~F FIX\nCONNECTOR F ~F *PA *PB\n~PIN FIX X Y Z\nCONNECTOR PIN ~PIN *Q *TA\nEND\n\
         &INSTATE -LOCATE A {far} {far} -10 0 {degrees} 0 -LOCATE B {far} {far} -10 0 {degrees} 0\n"
    ))
}

/// Angle and rate at times of a rigid pendulum, by Runge and Kutta with 2,000 steps a second.
fn swung(start: f64, square: f64, until: f64) -> [f64; 2] {
    let steps = (2000.0 * until).round() as usize;
    let h = until / steps as f64;
    let slope = |[angle, rate]: [f64; 2]| [rate, -square * angle.sin()];
    let on = |[a, b]: [f64; 2], [p, q]: [f64; 2], h: f64| [a + h * p, b + h * q];
    (0..steps).fold([start, 0.0], |x, _| {
        let k1 = slope(x);
        let k2 = slope(on(x, k1, 0.5 * h));
        let k3 = slope(on(x, k2, 0.5 * h));
        let k4 = slope(on(x, k3, h));
        [0, 1].map(|i| x[i] + h / 6.0 * (k1[i] + 2.0 * k2[i] + 2.0 * k3[i] + k4[i]))
    })
}

#[test]
fn bodies_joined_by_fix_oscillate_as_one_compound_pendulum() {
    let degrees: f64 = 10.0;
    // I = m (2 k2 + 4^2 + 12^2) about the pin, M g d = m g (4 + 12)
    let square = 16.0 * G / (2.0 * RADIUS * RADIUS + 160.0);
    for (weight, far, _) in CASES {
        let model = pendulum(weight, far, degrees);
        let made = run(&model, settings(8.0, 0.02), vec![]);
        assert_eq!(made.counts.cut, 0, "{weight} {far}");
        let history = &made.history;
        let [a, b] = [0, 1].map(|body| history.layout.body(body));
        let wrench = history.layout.wrench(link(&made, "F"), 1).unwrap();
        // FIX begins unloaded, 2e-6 m short of what a heavy pair asks of it: that rings off in the first seconds
        for (row, time) in history.rows().zip(history.times()).skip(200).step_by(40) {
            let [angle, rate] = swung(degrees.to_radians(), square, time);
            // the scheme's period is long by (w h)^2/12 or so: 4e-5, of 8 rad
            for body in [a, b] {
                assert!((row[body + 4] - angle).abs() < 1e-4, "{weight} {far} at {time}: {} {angle}", row[body + 4]);
            }
            // FIX gives way by its moment, less than 4 m of the weight, over 1e12 N m/rad
            assert!((row[a + 4] - row[b + 4]).abs() < 1e-9 + 4.0 * weight / 1e12, "{weight} {far} at {time}");
            // along the rod: m (g cos t + 12 rate^2)
            let force = [row[wrench], row[wrench + 1], row[wrench + 2]];
            let along = force[0] * angle.sin() + force[2] * angle.cos();
            let want = weight / G * (G * angle.cos() + 12.0 * rate * rate);
            assert!((along / want - 1.0).abs() < 1e-4, "{weight} {far} at {time}: {along} {want}");
        }
    }
}

#[test]
fn bodies_joined_by_fix_hang_plumb_below_their_pin() {
    for (weight, far, _) in CASES {
        for degrees in [30.0, 170.0] {
            let mut model = pendulum(weight, far, degrees);
            let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
            assert!(found.found.search.residual < 1e-9, "{weight} {far} {:?}", found.found);
            for body in model.bodies.values() {
                let give = 1e-6 + 3.0 * weight / 1e12;
                let off = [0, 1].map(|i| (body.position.shift[i] - far).abs()).into_iter().fold(0.0, f64::max);
                assert!(
                    off < give && (body.position.shift[2] + 10.0).abs() < give,
                    "{weight} {far} {:?}",
                    body.position
                );
                assert!(body.position.turn.iter().all(|t| t.abs() < 1e-7), "{weight} {far} {:?}", body.position);
            }
            // the pin carries both, the tie the lower one; what reports print is the law's force: 1e12 N/m times the rounding of places
            let list = found.system.contributions(&found.state.poses).unwrap();
            let rounding = 1e12 * 4.0 * f64::EPSILON * far;
            for (name, body, want) in [("PIN", 0, 2.0 * weight), ("F", 1, weight)] {
                let one = list.iter().find(|c| c.connector.as_deref() == Some(name) && c.body == body).unwrap();
                assert!((one.load.wrench[2] - want).abs() < 1e-6 * weight + rounding, "{name} {weight} {far} {one:?}");
            }
        }
    }
}
