//! Wind above the surface, and slam on the way through it.

use super::super::*;
use super::tangent::compare;
use nalgebra::Vector3;
use windlass_model::SchemeWeights;

const AIR: f64 = 1.226;

fn windy(wind: Vector3<f64>) -> UniformFluid {
    UniformFluid(FluidState { wind, air_density: AIR, ..UniformFluid::still_water(1025.0).0 })
}

#[test]
fn rope_hanging_in_wind_has_critical_angle() {
    // a straight line of weight w with normal drag alone: 1/2 rho Cd D V^2 cos^2(a) = w sin(a), a from the vertical
    let (diameter, speed, mass, cd): (f64, f64, f64, f64) = (0.1, 30.0, 4.0, 1.2);
    let segment = RodSegment { wind_drag: cd, ..RodSegment::line(20.0, 10, mass, 1e8, diameter) };
    let rod = Rod::new("flag", vec![segment], vec![]).unwrap();
    let fluid = windy(Vector3::x() * speed);
    let world = LineEnvironment::new(&fluid, 9.81);
    let top = Vector3::new(0.0, 0.0, 40.0);
    let mut state = RodState::along_points(&rod, &[top, Vector3::new(0.0, 0.0, 20.0)]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(top), RodEnd::FREE]).unwrap();
    let (q, w) = (0.5 * AIR * cd * diameter * speed * speed, mass * 9.81);
    let sine = (-w + (w * w + 4.0 * q * q).sqrt()) / (2.0 * q);
    for pair in state.position.windows(2) {
        let d = pair[1] - pair[0];
        // residual of statics: 1e-9 of its weight
        assert!((d.x / d.norm() - sine).abs() < 1e-6, "{} {sine}", d.x / d.norm());
    }
    let side = q * (1.0 - sine * sine) * 20.0 * (1.0 - sine * sine).sqrt();
    // drag goes by the unstretched length: stretch is 1e-5
    assert!((made.force[0].x / side - 1.0).abs() < 1e-5, "{} {side}", made.force[0].x);
}

#[test]
fn wind_acts_on_dry_part_alone() {
    let fluid = windy(Vector3::y() * 25.0);
    let world = LineEnvironment::new(&fluid, 0.0);
    for low in [-14.0, -10.0, -7.3] {
        let segment = RodSegment { wind_drag: 1.0, wind_diameter: 0.5, ..RodSegment::line(20.0, 8, 100.0, 1e12, 0.2) };
        let rod = Rod::new("pile", vec![segment], vec![]).unwrap();
        let (a, b) = (Vector3::new(0.0, 0.0, low), Vector3::new(0.0, 0.0, low + 20.0));
        let state = RodState::along_points(&rod, &[a, b]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let mut started = state.clone();
        solver.start(&rod, &mut started, &world, [RodEnd::FREE; 2]).unwrap();
        let push: f64 =
            started.acceleration.iter().enumerate().map(|(i, a)| a.y * lumped_mass(i, 8, 100.0 * 20.0)).sum();
        let wanted = 0.5 * AIR * 0.5 * 25.0 * 25.0 * (low + 20.0);
        // the share goes over a section evenly: the length in air is exact, but for rounding
        assert!((push / wanted - 1.0).abs() < 1e-9, "{push} {wanted}");
    }
}

/// Mass of a node of a rod of equal elements.
fn lumped_mass(node: usize, elements: usize, mass: f64) -> f64 {
    mass / elements as f64 * if node == 0 || node == elements { 0.5 } else { 1.0 }
}

#[test]
fn cylinder_entering_surface_takes_momentum_of_added_mass() {
    let (length, diameter, speed) = (12.0f64, 0.8, 3.0);
    let added = 1025.0 * std::f64::consts::FRAC_PI_4 * diameter * diameter * length;
    for (tilt, slam) in [(0.0f64, true), (0.3, true), (0.3, false)] {
        let segment =
            RodSegment { added_normal: 1.0, compression: true, ..RodSegment::line(length, 1, 50.0, 1e9, diameter) };
        let rod = Rod::new("cylinder", vec![segment], vec![]).unwrap();
        let fluid = UniformFluid::still_water(1025.0);
        let world = LineEnvironment { slam, ..LineEnvironment::new(&fluid, 0.0) };
        let along = Vector3::new(tilt.cos(), 0.0, tilt.sin()) * length;
        let start = Vector3::new(0.0, 0.0, 1.0);
        let mut state = RodState::along_points(&rod, &[start, start + along]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let sink = |t: f64, from: Vector3<f64>, speed: f64| {
            RodEnd::from_motion(RodEndMotion {
                position: from - Vector3::z() * (speed * t),
                velocity: Vector3::z() * -speed,
                acceleration: Vector3::zeros(),
            })
        };
        let (steps, h) = (2000, 1e-3);
        let run = |state: &mut RodState, solver: &mut RodSolver, speed: f64| {
            let (t0, from) = (state.time, [0, 1].map(|node| state.node_position(node).unwrap()));
            (1..=steps).fold(Vector3::zeros(), |sum, i| {
                let t = i as f64 * h;
                let made = solver
                    .step(&rod, state, &world, t0 + t, [sink(t, from[0], speed), sink(t, from[1], speed)])
                    .unwrap();
                sum - (made.force[0] + made.force[1]) * h
            })
        };
        let down = run(&mut state, &mut solver, speed);
        let normal = Vector3::new(-tilt.sin(), 0.0, tilt.cos());
        let wanted = normal * if slam { -added * speed * tilt.cos() } else { 0.0 };
        // the sum over steps: by Euler's rule within a step of the whole, which begins and ends at nothing
        assert!((down - wanted).norm() < 1e-4 * added * speed, "{down} {wanted}");
        // on the way out it leaves its water behind
        let up = run(&mut state, &mut solver, -speed);
        assert!(up.norm() < 1e-9 * added * speed, "{up}");
    }
}

#[test]
fn cylinder_impacting_surface_shares_momentum_with_water() {
    // [VON-KARMAN-1929]: m v0 = (m + m_a) v
    let (length, diameter, mass, speed) = (10.0, 0.5, 150.0, 4.0);
    let segment = RodSegment { added_normal: 1.0, ..RodSegment::line(length, 4, mass, 1e8, diameter) };
    let rod = Rod::new("cylinder", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment { slam: true, ..LineEnvironment::new(&fluid, 0.0) };
    let at = |x: f64| Vector3::new(x, 0.0, 0.6);
    let mut state = RodState::along_points(&rod, &[at(0.0), at(length)]).unwrap();
    state.velocity.fill(Vector3::z() * -speed);
    let mut solver =
        RodSolver::new(&rod, RodSettings { scheme: SchemeWeights::generalised_alpha(1.0), ..RodSettings::default() });
    solver.start(&rod, &mut state, &world, [RodEnd::FREE; 2]).unwrap();
    let made = RodEndForces { force: [Vector3::zeros(); 2], moment: [Vector3::zeros(); 2], iterations: 0, parts: 1 };
    let mut balance = RodEnergyBalance::open(&rod, &state, &world, &solver, &made);
    for i in 1..=1000 {
        let made = solver.step(&rod, &mut state, &world, i as f64 * 5e-4, [RodEnd::FREE; 2]).unwrap();
        balance.enter(&rod, &state, &world, &solver, &made);
    }
    let added = 1025.0 * std::f64::consts::FRAC_PI_4 * diameter * diameter;
    let wanted = -mass * speed / (mass + added);
    // second order in the step
    assert!((state.velocity[2].z / wanted - 1.0).abs() < 1e-4, "{} {wanted}", state.velocity[2].z);
    // the trapezoidal rule of the balance over the entry
    assert!(balance.momentum_error().norm() < 1e-3 * mass * speed * length, "{}", balance.momentum_error());
    assert!(
        balance.energy_error().abs() < 1e-3 * balance.energy.total().max(balance.turnover),
        "{}",
        balance.energy_error()
    );
}

#[test]
fn pipe_dropped_level_on_sea_slams_and_floats() {
    // the worst for an iteration: every element meets the water at once, in long steps
    let (length, diameter): (f64, f64) = (60.0, 0.6);
    let mass = 0.4 * 1025.0 * std::f64::consts::FRAC_PI_4 * diameter * diameter;
    let segment = RodSegment {
        compression: true,
        bending: 5e7,
        drag_normal: 1.2,
        added_normal: 1.0,
        ..RodSegment::line(length, 30, mass, 1e9, diameter)
    };
    let rod = Rod::new("pipe", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment { slam: true, ..LineEnvironment::new(&fluid, 9.81) };
    for h in [0.02, 0.1, 0.3] {
        let mut state = RodState::along_points(&rod, &[Vector3::z() * 4.0, Vector3::new(length, 0.0, 4.0)]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        solver.start(&rod, &mut state, &world, [RodEnd::FREE; 2]).unwrap();
        for i in 1..=(60.0 / h) as usize {
            solver.step(&rod, &mut state, &world, i as f64 * h, [RodEnd::FREE; 2]).unwrap();
        }
        // afloat with two fifths of its section under: 3 s^2 - 2 s^3 = 0.4 at s = 0.432932
        let wanted = (0.5 - 0.432_932) * diameter;
        let bent = state.node_positions().iter().map(|x| (x.z - wanted).abs()).fold(0.0, f64::max);
        // what is left of its heave, which dies out with drag
        assert!(bent < 0.02, "{h}: {bent}");
        assert!(state.velocity.iter().all(|v| v.norm() < 0.1), "{h}: {:?}", state.velocity[0]);
    }
}

#[test]
fn surface_piercing_rod_tangent_matches_finite_difference() {
    let fluid = UniformFluid(FluidState {
        velocity: Vector3::new(0.7, -0.2, 0.1),
        surface: 0.1,
        wind: Vector3::new(20.0, -8.0, 1.0),
        air_density: AIR,
        ..UniformFluid::still_water(1025.0).0
    });
    let world = LineEnvironment { slam: true, ..LineEnvironment::new(&fluid, 9.81) };
    let segment = RodSegment {
        drag_normal: 1.2,
        added_normal: 1.0,
        added_tangential: 0.2,
        wind_drag: 1.1,
        ..RodSegment::line(20.0, 4, 80.0, 1e6, 0.9)
    };
    let rod = Rod::new("floating", vec![segment], vec![]).unwrap();
    let mut state = RodState::along_points(&rod, &[Vector3::new(0.0, 0.0, 0.0), Vector3::new(20.1, 1.0, 0.2)]).unwrap();
    for i in 0..rod.nodes() {
        let s = i as f64;
        state.position[i] += Vector3::new((s * 1.3).sin(), (s * 2.1).cos(), (s * 0.7).sin()) * 0.15;
        state.velocity[i] = Vector3::new((s * 0.9).cos(), (s * 1.7).sin(), -1.0 - 0.5 * (s * 2.3).cos());
        state.acceleration[i] = Vector3::new((s * 1.9).cos(), (s * 0.4).sin(), (s * 1.3).cos());
    }
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    compare(&rod, &state, &world, &mut solver);
}
