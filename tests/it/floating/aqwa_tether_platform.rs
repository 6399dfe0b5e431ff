//! The tension leg platform of [AQWA-TETHER 8.2], at rest on its tethers, scripts/tlp.cif, against closed forms.

use crate::common;

use std::f64::consts::PI;
use windlass_base::geometry::Place;
use windlass_model::Model;
use windlass_solve::{EquilibriumOptions, find_equilibrium_with_rebuilds, modes};

const G: f64 = 9.81;
const MASS: f64 = 268.8e6;
const COLUMN: f64 = PI / 4.0 * 31.1 * 31.1;
const PONTOON: f64 = PI / 4.0 * 13.0 * 13.0;
/// Four columns 81 m deep and four pontoons.
const VOLUME: f64 = 4.0 * COLUMN * 81.0 + 4.0 * PONTOON * 2.0 * 28.3377;
const EA: f64 = 50929.58e6 * PI / 4.0;
const LENGTH: f64 = 263.768395;

fn platform() -> Model {
    let script = std::fs::read_to_string("scripts/tlp.cif").unwrap();
    let (mut session, screen, _folder) = common::session();
    // the closed forms below are of the platform's own mass: its tubes without added mass
    let script = script.replace(" 31100\n", " 31100 -CA 0\n").replace(" 13000\n", " 13000 -CA 0\n");
    session.open("script", script[..script.find("&EQUI").unwrap()].to_string());
    session.run();
    assert_eq!(session.errors, 0, "{}", screen.text());
    session.job.model.clone()
}

#[test]
fn platform_at_rest_has_buoyancy_less_weight_in_tethers() {
    let mut model = platform();
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    let [x, y, z, ..] = model.bodies.get("TLP").unwrap().position.values();
    // the length of the script is rounded to 1e-6 m, the platform with it
    assert!(x == 0.0 && y == 0.0 && (z + 17.4).abs() < 3e-6, "{x} {y} {z}");
    // 2.77742E6 kN, and the weight printed in [AQWA-TETHER 8.2] as 2.6369E6 kN
    let pretension = 1025.0 * G * VOLUME - MASS * G;
    assert!((pretension / 1e3 - 140_489.0).abs() < 0.5, "{pretension}");
    let list = found.system.contributions(&found.state.poses).unwrap();
    for tether in list.iter().filter(|c| c.connector.is_some()) {
        let got = tether.load.wrench[2];
        // 3e-6 m of 30.5 kN/mm of waterplane
        assert!((got + pretension / 4.0).abs() < 30.0, "{got} N");
        assert!((got + EA * (264.0 + z + 17.4 - LENGTH) / LENGTH).abs() < 1e-2, "{got} N");
    }
    assert_eq!(list.iter().filter(|c| c.connector.is_some()).count(), 4);
}

#[test]
fn platform_stiffness_matches_hydrostatics_and_four_strings() {
    let mut model = platform();
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    let (gamma, arm, half) = (1025.0 * G, 63.6, 40.0);
    let pull = gamma * VOLUME - MASS * G;
    let (across, along) = (pull / 264.0, 4.0 * EA / LENGTH);
    // about the centre of gravity: rho g (I + V z_B), z_B of columns and pontoons below it
    let inertia = 4.0 * (COLUMN * half * half + PI / 64.0 * 31.1f64.powi(4));
    let moment = 4.0 * COLUMN * 81.0 * (40.5 - arm) + 4.0 * PONTOON * 2.0 * 28.3377 * (8.124 - arm);
    let upright = gamma * (inertia + moment);
    let want = [
        (0, 0, across),
        (1, 1, across),
        (2, 2, gamma * 4.0 * COLUMN + along),
        // tops `arm` below: pushed sideways by the turn, pulled down beside the centre
        (3, 3, upright + along * half * half + across * arm * arm + pull * arm),
        (4, 4, upright + along * half * half + across * arm * arm + pull * arm),
        (5, 5, across * 2.0 * half * half),
        (0, 4, -across * arm),
        (1, 3, across * arm),
        (0, 2, 0.0),
        (2, 4, 0.0),
    ];
    for (row, column, want) in want {
        for (r, c) in [(row, column), (column, row)] {
            let got = found.state.stiffness[(r, c)];
            // the place is 3e-6 m off, of 264 m of tether
            assert!((got - want).abs() < 1e-6 * want.abs() + 1e-2, "{r} {c}: {got} is not {want}");
        }
    }
}

#[test]
fn platform_periods_match_string_spring_and_coupled_pair() {
    let mut model = platform();
    let found = find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default()).unwrap();
    let k = |r: usize, c: usize| found.state.stiffness[(r, c)];
    let close = |got: f64, want: f64| assert!((got / want - 1.0).abs() < 1e-6, "{got} is not {want}");
    let list = modes(&found.system, &found.state).unwrap();
    // yaw and heave stand alone; surge and pitch are the roots of (k11 - m w)(k55 - I w) = k15 2; radii 35 m and 42 m
    let inertia = MASS * 35.0 * 35.0;
    let (p, q) = (k(0, 0) * inertia + k(4, 4) * MASS, k(0, 0) * k(4, 4) - k(0, 4) * k(0, 4));
    let high = (p + (p * p - 4.0 * MASS * inertia * q).sqrt()) / (2.0 * MASS * inertia);
    let low = q / (MASS * inertia * high);
    let want = [low, low, k(5, 5) / (MASS * 42.0 * 42.0), k(2, 2) / MASS, high, high];
    for (mode, want) in list.iter().zip(want) {
        close(mode.eigenvalue, want);
    }
    // surge without added mass, by hand: 2 pi sqrt(m l / T) = 141.2 s
    close(2.0 * PI / (k(0, 0) / MASS).sqrt(), 2.0 * PI * (MASS * 264.0 / (VOLUME * 1025.0 * G - MASS * G)).sqrt());
}

#[test]
fn platform_offset_sets_down_on_tether_circle() {
    let mut model = platform();
    model.bodies.get_mut("TLP").unwrap().position = Place::new([-46.0, 0.0, -21.4, 0.0, 0.0, 0.0]);
    let (x, pitch) = (0, 4);
    let options = EquilibriumOptions { ignored: vec![(0, x), (0, pitch)], ..EquilibriumOptions::default() };
    let found = find_equilibrium_with_rebuilds(&mut model, &options).unwrap();
    let [_, _, z, ..] = model.bodies.get("TLP").unwrap().position.values();
    // tethers of length l at 46 m: vertical balance rho g (V + A (z0 - z)) - W = T sqrt(l2 - 46 2) / l, T = EA (l - L) / L for four,
    // l2 = 46 2 + (264 + z - z0) 2: by bisection
    let (mut low, mut high) = (-8.0, 0.0);
    for _ in 0..200 {
        let set = 0.5 * (low + high);
        let length = 46.0f64.hypot(264.0 + set);
        let up = 1025.0 * G * (VOLUME - 4.0 * COLUMN * set) - MASS * G;
        let down = 4.0 * EA * (length - LENGTH) / LENGTH * (264.0 + set) / length;
        if up > down {
            low = set;
        } else {
            high = set;
        }
    }
    let want = -17.4 + 0.5 * (low + high);
    assert!((z - want).abs() < 1e-9, "{z} is not {want}");
    let pull: f64 = found.state.residual[x];
    let set = z + 17.4;
    let length = 46.0f64.hypot(264.0 + set);
    let back = 4.0 * EA * (length - LENGTH) / LENGTH * 46.0 / length;
    assert!((pull / back - 1.0).abs() < 1e-9, "{pull} is not {back}");
}
