//! Stiff rods and light ropes under loads far beyond their weight.

use super::super::*;
use nalgebra::Vector3;

const GRAVITY: f64 = 9.80665;
const LENGTH: f64 = 10.0;

/// The pipe of benches/cantilever_elastica.py, of a weight (N/m).
fn pipe(elements: usize, weight: f64) -> Rod {
    let (outer, inner) = (0.1683f64, 0.1683 - 2.0 * 0.00711);
    let quarter = std::f64::consts::FRAC_PI_4;
    let area = quarter * (outer * outer - inner * inner);
    let bending = 2e11 * quarter / 16.0 * (outer.powi(4) - inner.powi(4));
    let segment = RodSegment {
        bending,
        compression: true,
        ..RodSegment::line(LENGTH, elements, weight / GRAVITY, 2e11 * area, outer)
    };
    Rod::new("pipe", vec![segment], vec![]).unwrap()
}

/// Load (N), weight (N/m), place of the tip from the clamp, and moment there (N m): scipy's elastica.
fn elastica() -> impl Iterator<Item = (f64, f64, Vector3<f64>, f64)> {
    let text = include_str!("../../tests/data/cantilever_elastica.csv");
    text.lines().skip(1).map(|line| {
        let row: Vec<f64> = line.split(',').map(|v| v.parse().unwrap()).collect();
        (row[0], row[1], Vector3::new(row[2], 0.0, row[3]), row[5])
    })
}

#[test]
fn cantilever_under_dead_tip_load_matches_elastica_at_any_mesh() {
    let fluid = UniformFluid::vacuum();
    for (load, weight, tip, moment) in elastica() {
        let rest = |elements: usize| {
            // a rod has some mass
            let rod = pipe(elements, weight.max(1e-9));
            let forces = [(elements, Vector3::new(0.0, 0.0, -load))];
            let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, GRAVITY) };
            let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * LENGTH]).unwrap();
            let clamp = RodEnd::pin(Vector3::zeros()).with_clamp(Vector3::x());
            let mut solver = RodSolver::new(&rod, RodSettings::default());
            let made = solver.statics(&rod, &mut state, &world, [clamp, RodEnd::FREE]).unwrap();
            (state.node_position(elements).unwrap(), made.moment[0].norm())
        };
        let made = [20, 40, 80, 160].map(rest);
        for (coarse, fine) in made.iter().zip(&made[1..]) {
            let ratio = (coarse.0 - tip).norm() / (fine.0 - tip).norm();
            // second order: 4 but for the next term
            assert!((3.8..4.2).contains(&ratio), "{load} {weight}: {ratio}");
        }
        // what is left once the term of second order is taken out is of the fourth, and the nine figures stored
        let beyond = |a: Vector3<f64>, b: Vector3<f64>| (b * 4.0 - a) / 3.0;
        let off = (beyond(made[2].0, made[3].0) - tip).norm() / LENGTH;
        assert!(off < 2e-7, "{load} {weight}: {off:e}");
        let clamped = (4.0 * made[3].1 - made[2].1) / 3.0 / moment - 1.0;
        assert!(clamped.abs() < 1e-6, "{load} {weight}: {clamped:e}");
    }
}

#[test]
fn cantilever_with_displaced_tip_reacts_against_load() {
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, GRAVITY);
    for (load, weight, tip, _) in elastica() {
        let [coarse, fine] = [80, 160].map(|elements| {
            let rod = pipe(elements, weight.max(1e-9));
            let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * LENGTH]).unwrap();
            let clamp = RodEnd::pin(Vector3::zeros()).with_clamp(Vector3::x());
            let mut solver = RodSolver::new(&rod, RodSettings::default());
            solver.statics(&rod, &mut state, &world, [clamp, RodEnd::pin(tip)]).unwrap().force[1]
        });
        let force = (fine * 4.0 - coarse) / 3.0;
        // across the rod EI is soft, along it EA: the fourth-order term and the nine figures of the place, 1e-9 of EA / L
        assert!((force - Vector3::z() * load).norm() < 1e-4 * load, "{load} {weight}: {force}");
    }
}

#[test]
fn weightless_rope_with_clump_has_two_straight_halves() {
    // T sin(a) = W / 2 with the halves of 10 (1 + T / EA) over 9.5 m each, by bisection of the sag
    let (load, ea, half) = (1.25e8, 7.2e8, 9.5f64);
    let pull = |sag: f64| ea * (half.hypot(sag) / 10.0 - 1.0);
    let (mut low, mut high) = (3.2, 20.0);
    for _ in 0..200 {
        let sag = 0.5 * (low + high);
        *(if 2.0 * pull(sag) * sag / half.hypot(sag) < load { &mut low } else { &mut high }) = sag;
    }
    for bending in [0.0, 1e-3] {
        let segment =
            RodSegment { bending, compression: bending > 0.0, ..RodSegment::line(10.0, 20, 1e-7, ea, 0.1683) };
        let clump = Attachment::mass(20, load / GRAVITY);
        let rod = Rod::new("light", vec![segment.clone(), segment], vec![clump]).unwrap();
        let fluid = UniformFluid::vacuum();
        let ends = [0.0, 2.0 * half].map(|x| Vector3::new(x, 0.0, 0.0));
        let mut state = RodState::along_points(&rod, &ends).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let made =
            solver.statics(&rod, &mut state, &LineEnvironment::new(&fluid, GRAVITY), ends.map(RodEnd::pin)).unwrap();
        assert!(
            (state.node_position(20).unwrap().z + low).abs() < 1e-6,
            "{bending}: {} {low}",
            state.node_position(20).unwrap()
        );
        assert!((made.force[0].norm() / pull(low) - 1.0).abs() < 1e-8, "{bending}: {} {}", made.force[0], pull(low));
    }
}
