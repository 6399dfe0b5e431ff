//! Loads on wires: let out by a winch, and heaved.

use super::super::*;
use nalgebra::Vector3;

#[test]
fn load_lowered_by_winch_keeps_weight_and_moves_at_payout_rate() {
    let (mass, rate): (f64, f64) = (5000.0, 0.5);
    let load = Attachment::mass(10, mass);
    let segment = RodSegment { axial_damping: 1e6, ..RodSegment::line(50.0, 10, 5.0, 1e8, 0.05) };
    let mut rod = Rod::new("wire", vec![segment], vec![load]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::FREE];
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::new(0.0, 0.0, -50.0)]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let (start, h) = (state.position[10].z, 0.05);
    let mut force = Vector3::zeros();
    for i in 1..=400 {
        let t = i as f64 * h;
        // the first element is let out, at a rate that comes up over five seconds
        let up = (t / 5.0).min(1.0);
        let out = if t < 5.0 { 0.5 * rate * t * up } else { rate * (t - 2.5) };
        rod.set_length(0, 5.0 + out, rate * up).unwrap();
        force = solver.step(&rod, &mut state, &world, t, ends).unwrap().force[0];
    }
    let out = rate * 17.5;
    // the wire stretches by the weight it carries: 5e-4 of what is let out
    let weight = 9.81 * (mass + 5.0 * (50.0 + out));
    assert!((state.position[10].z - (start - out * (1.0 + weight / 1e8))).abs() < 2e-3, "{}", state.position[10].z);
    // what swings still is the wire's own spring: a part in a thousand
    assert!((force.z / -weight - 1.0).abs() < 2e-3, "{} {weight}", force.z);
}

#[test]
fn elements_added_at_winch_leave_load_position() {
    let (mass, rate): (f64, f64) = (5000.0, 0.5);
    let load = Attachment::mass(5, mass);
    let segment = RodSegment { axial_damping: 1e6, ..RodSegment::line(25.0, 5, 5.0, 1e8, 0.05) };
    let mut rod = Rod::new("wire", vec![segment], vec![load]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::FREE];
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::new(0.0, 0.0, -25.0)]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let (start, h, mut first) = (state.position[5].z, 0.05, 5.0);
    for i in 1..=400 {
        let t = i as f64 * h;
        let up = (t / 5.0).min(1.0);
        first += rate * h * ((t - 0.5 * h) / 5.0).min(1.0);
        rod.set_length(0, first, rate * up).unwrap();
        if first > 7.5 {
            // the first element is divided, and the part at the winch goes on growing
            rod.divide(0, &mut state).unwrap();
            first *= 0.5;
            solver = RodSolver::new(&rod, RodSettings::default());
        }
        solver.step(&rod, &mut state, &world, t, ends).unwrap();
    }
    let out = rate * 17.5;
    assert!((rod.length() - 25.0 - out).abs() < 1e-9);
    assert!(rod.nodes() > 6);
    let weight = 9.81 * (mass + 5.0 * (25.0 + out));
    let last = state.position.last().unwrap().z;
    // the wire stretches by the weight it carries; the load bobs on it by what its start has left
    assert!((last - (start - out * (1.0 + weight / 1e8))).abs() < 2e-3, "{last} {}", start - out);
    // and back: joined again it has the elements it had
    while rod.nodes() > 6 {
        rod.join(0, &mut state).unwrap();
    }
    assert!((rod.length() - 25.0 - out).abs() < 1e-9);
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    assert!((state.position[5].z - last).abs() < 2e-3, "{} {last}", state.position[5].z);
    assert!(rod.join(4, &mut state).is_err() && rod.divide(9, &mut state).is_err());
}

#[test]
fn heave_of_top_excites_load_spring_resonance_at_any_mass() {
    // a light wire with a load of any mass below an end that heaves: amplitude over heave 1 / (1 - (w / wn)^2)
    for mass in [10.0, 1e4, 1e6] {
        let load = Attachment::mass(6, mass);
        let (length, frequency, heave): (f64, f64, f64) = (30.0, 1.0, 0.1);
        // the wire's stiffness is that of a natural frequency of three
        let ea = 9.0 * mass * length;
        let rod = Rod::new("wire", vec![RodSegment::line(length, 6, 1e-3 * mass, ea, 0.05)], vec![load]).unwrap();
        let fluid = UniformFluid::vacuum();
        let world = LineEnvironment::new(&fluid, 9.81);
        let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::new(0.0, 0.0, -length)]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let still = [RodEnd::pin(Vector3::zeros()), RodEnd::FREE];
        solver.statics(&rod, &mut state, &world, still).unwrap();
        let start = state.position[6].z;
        let (mut high, mut low) = (f64::MIN, f64::MAX);
        for i in 1..=4000 {
            let t = i as f64 * 0.02;
            let rise = (t / 40.0).min(1.0);
            let (s, c) = (frequency * t).sin_cos();
            let ramp = if t < 40.0 { 1.0 / 40.0 } else { 0.0 };
            let motion = RodEndMotion {
                position: Vector3::z() * (heave * rise * s),
                velocity: Vector3::z() * (heave * (ramp * s + rise * frequency * c)),
                acceleration: Vector3::z() * (heave * (2.0 * ramp * frequency * c - rise * frequency * frequency * s)),
            };
            solver.step(&rod, &mut state, &world, t, [RodEnd::from_motion(motion), RodEnd::FREE]).unwrap();
            if t > 60.0 {
                high = high.max(state.position[6].z - start);
                low = low.min(state.position[6].z - start);
            }
        }
        // load and a third of the wire swing on the spring
        let square = 9.0 / (1.0 + 0.03 / 3.0);
        let exact = heave / (1.0 - 1.0 / square);
        // what the ramp has left of the free swing, and the wire's own weight on the way
        assert!((0.5 * (high - low) / exact - 1.0).abs() < 0.02, "{mass}: {} {exact}", 0.5 * (high - low));
    }
}
