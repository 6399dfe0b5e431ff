//! Bending against published large deflections.

use super::super::*;
use nalgebra::Vector3;
use windlass_model::SchemeWeights;

fn beam(length: f64, elements: usize, bending: f64, ea: f64) -> Rod {
    let segment = RodSegment { bending, compression: true, ..RodSegment::line(length, elements, 1.0, ea, 0.1) };
    Rod::new("beam", vec![segment], vec![]).unwrap()
}

#[test]
fn end_moment_of_two_pi_ei_over_l_bends_beam_into_circle() {
    let (length, bending) = (10.0, 1000.0);
    let rod = beam(length, 20, bending, 1e7);
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 0.0);
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * length]).unwrap();
    // beyond half a turn the rod could swing out of its plane and straighten, as nothing resists its twist
    let mut solver = RodSolver::new(&rod, RodSettings { unstable: true, ..RodSettings::default() });
    let clamp = RodEnd::pin(Vector3::zeros()).with_clamp(Vector3::x());
    let steps = 16;
    let mut moment = 0.0;
    for i in 1..=steps {
        let angle = 2.0 * std::f64::consts::PI * i as f64 / steps as f64;
        let tip = RodEnd::FREE.with_clamp(Vector3::new(angle.cos(), 0.0, angle.sin()));
        let made = solver.statics(&rod, &mut state, &world, [clamp, tip]).unwrap();
        moment = made.moment[1].norm();
    }
    // angles add up exactly and no force acts: rounding and the residual allowed are left
    let exact = 2.0 * std::f64::consts::PI * bending / length;
    assert!((moment / exact - 1.0).abs() < 1e-6, "{moment} {exact}");
    // the polygon closes
    assert!(state.position[20].norm() < 1e-5 * length, "{}", state.position[20]);
}

#[test]
fn cantilever_with_tip_load_matches_elastica() {
    // [MATTIASSON-1981 table]: P L^2 / EI, deflection w / L, shortening u / L
    for (load, w, u) in [(1.0, 0.30172, 0.05643), (5.0, 0.71379, 0.38763), (10.0, 0.81061, 0.55500)] {
        let error = |elements: usize| {
            let (length, bending) = (1.0, 1.0);
            let rod = beam(length, elements, bending, 1e7);
            let fluid = UniformFluid::vacuum();
            let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * length]).unwrap();
            let mut solver = RodSolver::new(&rod, RodSettings::default());
            let clamp = RodEnd::pin(Vector3::zeros()).with_clamp(Vector3::x());
            let forces = [(elements, Vector3::new(0.0, 0.0, -load))];
            let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, 0.0) };
            let made = solver.statics(&rod, &mut state, &world, [clamp, RodEnd::FREE]).unwrap();
            let tip = state.position[elements];
            let exact_moment = load * (1.0 - u);
            assert!((made.moment[0].norm() / exact_moment - 1.0).abs() < 0.01, "{}", made.moment[0]);
            (tip.x - (1.0 - u)).hypot(tip.z + w)
        };
        let (coarse, fine) = (error(20), error(80));
        // second order, down to the five printed figures
        assert!(fine < 1.5e-4 && coarse < 16.0 * 1.5e-4, "{load}: {coarse} {fine}");
    }
}

#[test]
fn short_stiff_cantilever_far_from_origin_bends_as_at_origin() {
    // P L^3 / (3 EI) + w L^4 / (8 EI) with EI = 2.16e8 N m2, P = 500 kN, w = 2.332 kN/m, L = 1 m; the slope of 1.2e-3 changes the sixth figure
    let (length, elements, bending) = (1.0, 100, 2.16e8);
    let exact = 5e5 / (3.0 * bending) + 2332.0 / (8.0 * bending);
    let segment =
        RodSegment { bending, compression: true, ..RodSegment::line(length, elements, 2332.0 / 9.80665, 5e10, 0.1) };
    let rod = Rod::new("short", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let forces = [(elements, Vector3::new(0.0, 0.0, -5e5))];
    let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, 9.80665) };
    for root in [Vector3::zeros(), Vector3::new(0.0, 0.0, 500.0), Vector3::new(7071.0678, -7071.0679, 500.0)] {
        let mut state = RodState::along_points(&rod, &[root, root + Vector3::x() * length]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let clamp = RodEnd::pin(root).with_clamp(Vector3::x());
        let made = solver.statics(&rod, &mut state, &world, [clamp, RodEnd::FREE]).unwrap();
        let bent = -state.position[elements].z;
        // a chain of n elements is stiffer by 1 / (4 n^2) of a cantilever under a tip load, 2.5e-5 here
        assert!((bent / exact - 1.0).abs() < 1e-4, "{root}: {bent} {exact}");
        let node = rod.results(&state, &world, &[clamp, RodEnd::FREE])[elements].position;
        assert!((node.z - root.z + bent).abs() < 1e-12 * (1.0 + root.norm()));
        assert!((made.moment[0].norm() / (5e5 + 1166.0) - 1.0).abs() < 1e-4, "{root}: {}", made.moment[0]);
    }
}

#[test]
fn clamped_and_tensioned_riser_bends_as_beam_with_tension() {
    // a light beam under tension T between clamps at x = 0 and L with a side load q: closed form of EI y'''' - T y'' = q
    let (length, bending, tension, q) = (100.0, 1e7, 2e5, 20.0);
    let elements = 200;
    let rod = beam(length, elements, bending, 1e10);
    let fluid = UniformFluid::vacuum();
    let forces: Vec<_> = (0..=elements)
        .map(|i| {
            let share = if i == 0 || i == elements { 0.5 } else { 1.0 };
            let pull = if i == elements { tension } else { 0.0 };
            (i, Vector3::new(pull, 0.0, -q * share * length / elements as f64))
        })
        .collect();
    let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, 0.0) };
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * length]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    // pinned at both heights: the far end slides, held in height by a stiff clamp of symmetry, is left for the pinned case
    let end = |x: f64| RodEnd::pin(Vector3::new(x, 0.0, 0.0)).with_clamp(Vector3::x());
    let stretched = length;
    let made = solver.statics(&rod, &mut state, &world, [end(0.0), end(stretched)]).unwrap();
    // tension comes from the sag of an inextensible rod; take the one found and check the moments against it
    let found = rod.results(&state, &world, &[end(0.0), end(stretched)]);
    let t = found[elements / 2].effective;
    let k = (t / bending).sqrt();
    let z = 0.5 * k * length;
    let clamp_moment = q / (k * k) * (z / z.tanh() - 1.0);
    let middle_moment = q / (k * k) * (1.0 - z / z.sinh());
    // second order in k l = 0.07, small rotations to the square of the slope
    assert!((found[0].moment / clamp_moment - 1.0).abs() < 2e-3, "{} {clamp_moment}", found[0].moment);
    assert!(
        (found[elements / 2].moment / middle_moment - 1.0).abs() < 2e-3,
        "{} {middle_moment}",
        found[elements / 2].moment
    );
    assert!((made.moment[0].norm() / clamp_moment - 1.0).abs() < 2e-3);
    assert!((found[0].shear / (0.5 * q * length) - 1.0).abs() < 0.02, "{}", found[0].shear);
}

/// The cantilever of [BATHE-BOLOURCHI-1979]: an eighth of a circle of radius 100 in the x-y plane, a square of one by
/// one, E = 1e7, G = E/2, clamped at the origin along y; its tip under a load along z.
fn forty_five_degrees(elements: usize, load: f64) -> Vector3<f64> {
    let (radius, quarter) = (100.0, std::f64::consts::FRAC_PI_4);
    let segment = RodSegment {
        compression: true,
        bending: 1e7 / 12.0,
        // both papers take the polar moment of the square, GJ = EI
        torsion: 1e7 / 12.0,
        ..RodSegment::line(radius * quarter, elements, 1.0, 1e7, 1.0)
    };
    let mut rod = Rod::new("bend", vec![segment], vec![]).unwrap();
    let at = |i: usize| {
        let angle = quarter * i as f64 / elements as f64;
        Vector3::new(radius * (1.0 - angle.cos()), radius * angle.sin(), 0.0)
    };
    let points: Vec<_> = (0..=elements).map(at).collect();
    let root = Vector3::y();
    rod.set_shape(&points, [root, Vector3::new(quarter.sin(), quarter.cos(), 0.0)]).unwrap();
    let fluid = UniformFluid::vacuum();
    let mut state = RodState::along_points(&rod, &points).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let clamp = RodEnd::pin(Vector3::zeros()).with_clamp(root).with_side(rod.sides().unwrap()[0]);
    let forces = [(elements, Vector3::new(0.0, 0.0, load))];
    let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, 0.0) };
    let made = solver.statics(&rod, &mut state, &world, [clamp, RodEnd::FREE]).unwrap();
    let tip = state.position[elements];
    // the clamp carries the load and its moment
    assert!((made.force[0].z - load).abs() < 1e-6 * load.abs().max(1.0));
    let moment = tip.cross(&Vector3::new(0.0, 0.0, load));
    assert!((made.moment[0] - moment).norm() < 1e-4 * moment.norm().max(1.0), "{} {moment}", made.moment[0]);
    tip
}

#[test]
fn forty_five_degree_bend_matches_published_positions() {
    // unloaded it keeps its shape
    let still = forty_five_degrees(16, 0.0);
    assert!((still - Vector3::new(29.289_321_9, 70.710_678_1, 0.0)).norm() < 0.1, "{still}");
    // [BATHE-BOLOURCHI-1979]: (22.5, 59.2, 39.5) at 300, (15.9, 47.2, 53.4) at
    // 600; [SIMO-VUQUOC-1986]: (22.33, 58.84, 40.08) and (15.79, 47.23,
    // 53.37)
    for (load, published) in [(300.0, [22.33, 58.84, 40.08]), (600.0, [15.79, 47.23, 53.37])] {
        let (coarse, fine) = (forty_five_degrees(16, load), forty_five_degrees(64, load));
        // their eight straight elements, and shear deformation, make a part in a thousand of the length; the two
        // papers differ by 0.6
        assert!((fine - Vector3::from(published)).amax() < 0.15, "{fine}");
        assert!((coarse - fine).amax() < 0.1, "{coarse} {fine}");
    }
}

/// A beam of which end A is clamped in a holder that turns about y at a steady rate, at a time; end B is free.
fn turning_ends(rate: f64, time: f64) -> [RodEnd; 2] {
    let (s, c) = (rate * time).sin_cos();
    let held = RodEnd::pin(Vector3::zeros()).with_clamp(Vector3::new(c, 0.0, -s)).with_side(Vector3::y());
    [held.with_turning(Vector3::y() * rate), RodEnd::FREE]
}

/// A beam that is stepped at these times, in as many parts as there are, from rest along x.
fn swung(times: &[f64], rate: f64, settings: RodSettings) -> (RodState, usize) {
    let segment = RodSegment { compression: true, bending: 2e5, ..RodSegment::line(10.0, 10, 20.0, 1e8, 0.1) };
    let rod = Rod::new("beam", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * 10.0]).unwrap();
    let mut solver = RodSolver::new(&rod, settings);
    let mut parts = 0;
    for time in times {
        parts += solver.step(&rod, &mut state, &world, *time, turning_ends(rate, *time)).unwrap().parts;
    }
    (state, parts)
}

#[test]
fn subdivided_step_rotates_clamp_by_the_same_total() {
    // so few iterations that a step of 0.8 s fails and its halves do not
    let rate = 1.0;
    let cut = (3..20).rev().find_map(|iterations| {
        let (state, parts) = swung(&[0.8], rate, RodSettings { iterations, ..RodSettings::default() });
        (parts == 2).then_some(state)
    });
    let (halves, parts) = swung(&[0.4, 0.8], rate, RodSettings::default());
    let off = cut.unwrap().position.iter().zip(&halves.position).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max);
    // the tolerance of a step is 1e-5 of an element of 1 m
    assert!(off < 1e-5 && parts == 2, "{off} {parts}");
}

#[test]
fn beam_energy_balance_includes_work_of_rotating_clamp() {
    let run = |h: f64| {
        let segment = RodSegment { compression: true, bending: 2e5, ..RodSegment::line(10.0, 10, 20.0, 1e8, 0.1) };
        let rod = Rod::new("beam", vec![segment], vec![]).unwrap();
        let fluid = UniformFluid::vacuum();
        let world = LineEnvironment::new(&fluid, 9.81);
        let rate = 0.5;
        let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * 10.0]).unwrap();
        let mut solver = RodSolver::new(
            &rod,
            RodSettings { scheme: SchemeWeights::generalised_alpha(1.0), ..RodSettings::default() },
        );
        solver.statics(&rod, &mut state, &world, turning_ends(0.0, 0.0)).unwrap();
        for (x, v) in state.position.iter().zip(state.velocity.iter_mut()) {
            *v = (Vector3::y() * rate).cross(x);
        }
        let made = solver.start(&rod, &mut state, &world, turning_ends(rate, 0.0)).unwrap();
        let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
        for i in 1..=(2.0 / h) as usize {
            let time = i as f64 * h;
            let made = solver.step(&rod, &mut state, &world, time, turning_ends(rate, time)).unwrap();
            balance.enter(&rod, &state, &world, &solver, &made);
        }
        (balance.energy_error().abs(), balance.work.ends[0].abs())
    };
    let (coarse, fine) = (run(4e-3), run(2e-3));
    // 8 kJ hold the beam back as it turns down; second order in the step until the tolerance of a step is left
    assert!(fine.0 < 1e-6 * fine.1 && fine.0 < coarse.0, "{coarse:?} {fine:?}");
}
