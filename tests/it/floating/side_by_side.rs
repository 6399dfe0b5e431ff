//! Two barges side by side, scripts/side_by_side.cif: fenders and hawsers by hand, and the statics of what is printed.

use crate::common;

use nalgebra::Vector3;
use windlass_model::Model;
use windlass_solve::System;

/// The model and the screen after so many equilibria of the script.
fn solve_equilibria(equilibria: usize) -> (Model, String) {
    let script = std::fs::read_to_string("scripts/side_by_side.cif").unwrap();
    let (mut end, record) = (0, "&EQUI\n&STATUS F_CONNECTOR\n");
    for _ in 0..equilibria {
        end += script[end..].find(record).unwrap() + record.len();
    }
    let (mut session, screen, _folder) = common::session();
    session.open("script", script[..end].to_string());
    session.run();
    assert_eq!(session.errors, 0, "{}", screen.text());
    (session.job.model.clone(), screen.text())
}

/// Global place of a point on a body (m).
fn point_of_body(model: &Model, body: &str, point: [f64; 3]) -> Vector3<f64> {
    let system = System::new(model, &[]).unwrap();
    system.state(model).poses[system.nodes.iter().position(|n| n.name == body).unwrap()].point(point.into())
}

const FENDERS: [(&str, f64); 3] = [("F1", -30.0), ("F2", 0.0), ("F3", 30.0)];
/// Name, x on the inner and the outer barge, unstretched length (m).
const HAWSERS: [(&str, f64, f64, f64); 4] = [
    ("BREAST1", 40.0, 40.0, 15.0),
    ("BREAST4", -40.0, -40.0, 15.0),
    ("SPRING2", 15.0, -15.0, 33.0),
    ("SPRING3", -15.0, 15.0, 33.0),
];

/// What the fenders and hawsers do to the outer barge, by hand from where the barges are (kN): force and where it acts.
fn by_hand(model: &Model) -> Vec<(&'static str, Vector3<f64>, Vector3<f64>)> {
    let mut list = Vec::new();
    let side = point_of_body(model, "INNER", [0.0, 1.0, 0.0]) - point_of_body(model, "INNER", [0.0; 3]);
    for (name, x) in FENDERS {
        let (inner, outer) =
            (point_of_body(model, "INNER", [x, 10.0, 2.0]), point_of_body(model, "OUTER", [x, -10.0, 2.0]));
        // pushed in by u = 4 m less what is between the sides; the spring in series with the curve: u = P / 100000 + Y(P). To
        // (100 kN, 0.3 m) Y = 0.003 P, so that P = u / 0.00301; to (400 kN, 0.6 m) Y = 0.3 + (P - 100) / 1000: P = (u - 0.2) / 0.00101
        let pushed = 4.0 - (outer - inner).dot(&side);
        assert!(pushed > 0.0 && pushed < 0.604, "{name}: {pushed}");
        let push = if pushed < 0.301 { pushed / 0.00301 } else { (pushed - 0.2) / 0.00101 };
        list.push((name, side * push, outer));
    }
    for (name, from, to, length) in HAWSERS {
        let (inner, outer) =
            (point_of_body(model, "INNER", [from, 4.0, 4.0]), point_of_body(model, "OUTER", [to, -4.0, 4.0]));
        // EA (chord - L) / L, EA of a full section of 60 mm and 2000 MPa
        let chord = inner - outer;
        let ea = 2000.0e3 * std::f64::consts::FRAC_PI_4 * 0.06 * 0.06;
        list.push((name, chord.normalize() * ea * (chord.norm() - length) / length, outer));
    }
    list
}

/// Forces on the first end as printed by the last &STATUS F_CONNECTOR (kN).
fn printed_forces(screen: &str, name: &str) -> [f64; 3] {
    let line = screen
        .lines()
        .rfind(|l| l.trim_start().starts_with(name) && (l.contains(" exact ") || l.contains(" weightless ")))
        .unwrap();
    let words: Vec<f64> = line.split_whitespace().filter_map(|w| w.parse().ok()).collect();
    [words[1], words[2], words[3]]
}

/// The load of the wind on the outer barge: force and moment about its origin (kN, kN m).
fn wind(model: &Model) -> (Vector3<f64>, Vector3<f64>) {
    let system = System::new(model, &[]).unwrap();
    let outer = system.nodes.iter().position(|n| n.name == "OUTER").unwrap();
    let list = system.contributions(&system.state(model).poses).unwrap();
    let own = list.iter().filter(|c| c.body == outer && c.category.name() == "WIND");
    let total: windlass_base::pose::Six = own.map(|c| c.load.wrench / 1e3).sum();
    (total.fixed_rows::<3>(0).into_owned(), total.fixed_rows::<3>(3).into_owned())
}

#[test]
fn fender_forces_balance_hawser_forces_in_calm() {
    let (model, screen) = solve_equilibria(1);
    let hand = by_hand(&model);
    let sum = |names: &dyn Fn(&str) -> bool| hand.iter().filter(|(n, ..)| names(n)).map(|(_, f, _)| f.y).sum::<f64>();
    let (fenders, hawsers) = (sum(&|n| n.starts_with('F')), sum(&|n| !n.starts_with('F')));
    assert!((fenders + hawsers).abs() < 1e-6, "{fenders} {hawsers}");
    // symmetric about the middle of the barges, and the two barges roll alike against each other
    assert!((hand[0].1 - hand[2].1).norm() < 1e-8 && (hand[0].1 - hand[1].1).norm() < 1e-8);
    let roll = |body: &str| model.bodies.get(body).unwrap().position.values()[3];
    assert!(roll("INNER") < 0.0 && (roll("INNER") + roll("OUTER")).abs() < 0.05 * roll("OUTER"), "{}", roll("OUTER"));
    for (name, force, _) in &hand {
        let got = printed_forces(&screen, name);
        assert!((0..3).all(|i| (got[i] + force[i]).abs() < 0.0051), "{name}: {got:?} {force}");
    }
}

#[test]
fn printed_forces_and_moments_balance_wind() {
    for equilibria in [2, 3] {
        let (model, screen) = solve_equilibria(equilibria);
        let hand = by_hand(&model);
        let (force, moment) = wind(&model);
        assert!(force.y.abs() > 150.0 && force.x.abs() > 40.0, "{force}");
        let mut total = force;
        let mut yaw = moment.z;
        let origin = point_of_body(&model, "OUTER", [0.0; 3]);
        for (name, force, point) in &hand {
            let got = printed_forces(&screen, name);
            assert!((0..3).all(|i| (got[i] + force[i]).abs() < 0.0051), "{name}: {got:?} {force}");
            total += Vector3::from(got) * -1.0;
            yaw += (point - origin).cross(force).z;
        }
        // seven numbers printed to 0.01 kN, the table's own rounding; yaw from the exact ones
        assert!(total.x.abs() < 0.036 && total.y.abs() < 0.036, "{total}");
        assert!(yaw.abs() < 1e-5, "{yaw}");
    }
}
