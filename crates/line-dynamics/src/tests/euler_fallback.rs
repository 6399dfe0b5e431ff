//! A mass that falls into a stiff rope which cannot push, in steps that do not follow the snap.

use super::super::*;
use nalgebra::Vector3;
use windlass_model::SchemeWeights;

const GRAVITY: f64 = 9.81;
/// Of the load (kg).
const MASS: f64 = 100.0;

/// Drops 100 kg by `height` into a rope of 2 m in a vacuum: how high it comes in the 30 s after its first bounce as a
/// share of the height, from where the rope is taut; it is let go `aside` (m) of where the rope hangs.
fn rebound([elements, ea]: [f64; 2], [height, aside]: [f64; 2], rho_inf: f64, h: f64) -> f64 {
    let (length, elements) = (2.0, elements as usize);
    let load = Attachment::mass(elements, MASS);
    let rod = Rod::new("rope", vec![RodSegment::line(length, elements, 0.05, ea, 0.01)], vec![load]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, GRAVITY);
    let top = Vector3::zeros();
    let low = Vector3::new(aside, 0.0, height - length);
    let belly = (0.25 * (length * length - low.norm_squared())).max(0.0).sqrt();
    let mut state = RodState::along_points(&rod, &[top, 0.5 * low + Vector3::y() * belly, low]).unwrap();
    let mut solver = RodSolver::new(
        &rod,
        RodSettings { scheme: SchemeWeights::generalised_alpha(rho_inf), ..RodSettings::default() },
    );
    let ends = [RodEnd::pin(top), RodEnd::FREE];
    solver.start(&rod, &mut state, &world, ends).unwrap();
    let (mut bounced, mut highest) = (false, f64::MIN);
    for i in 1..=(30.0 / h) as usize {
        solver.step(&rod, &mut state, &world, i as f64 * h, ends).unwrap();
        bounced |= state.velocity[elements].z > 0.0;
        if bounced {
            highest = highest.max(state.position[elements].z + length);
        }
    }
    highest / height
}

#[test]
fn mass_falling_into_stiff_rope_rebounds_no_higher() {
    let ropes = [
        ([1.0, 1e4], 0.0),
        ([1.0, 1e7], 0.0),
        ([1.0, 1e7], 0.3),
        ([6.0, 1e5], 0.0),
        ([6.0, 1e7], 0.3),
        ([6.0, 1e8], 0.0),
    ];
    for (rope, aside) in ropes {
        for h in [0.003, 0.01, 0.03, 0.1, 0.17] {
            for rho in [0.0, 0.2, 0.5, 0.8, 0.9, 0.95] {
                for height in [0.5, 1.0] {
                    let found = rebound(rope, [height, aside], rho, h);
                    // where the steps follow the bounce each is right to the second order, (w h)^2
                    let turn = (rope[1] / (2.0 * MASS)).sqrt() * h;
                    let most = if turn < 0.3 { 1.0 + turn * turn } else { 1.0 };
                    assert!(found <= most, "{rope:?} {aside} {h} {rho} {height}: {found}");
                }
            }
        }
    }
}

#[test]
fn resolved_bounce_keeps_height_and_second_order_period() {
    // free flight, and half a swing about the static stretch: exact in closed form
    let (length, ea, height): (f64, f64, f64) = (2.0, 1e4, 1.0);
    let k = ea / length;
    let (w, speed) = ((k / MASS).sqrt(), (2.0 * GRAVITY * height).sqrt());
    let sag = GRAVITY / (w * w);
    // from the first touch to the lowest point and back
    let hang = 2.0 * (std::f64::consts::PI - (speed / (w * sag)).atan()) / w;
    let period = 2.0 * speed / GRAVITY + hang;
    let load = Attachment::mass(1, MASS);
    let rod = Rod::new("rope", vec![RodSegment::line(length, 1, 1e-6, ea, 0.01)], vec![load]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, GRAVITY);
    let (top, from) = (Vector3::zeros(), Vector3::z() * (height - length));
    let ends = [RodEnd::pin(top), RodEnd::FREE];
    let away = |steps: usize| {
        let mut state = RodState::along_points(&rod, &[top, from]).unwrap();
        let mut solver = RodSolver::new(
            &rod,
            RodSettings { scheme: SchemeWeights::generalised_alpha(0.9), ..RodSettings::default() },
        );
        solver.start(&rod, &mut state, &world, ends).unwrap();
        for i in 1..=steps {
            solver.step(&rod, &mut state, &world, i as f64 * period / steps as f64, ends).unwrap();
        }
        // at the top it rests
        state.velocity[1].norm()
    };
    // mean errors of neighbouring step lengths: where in a step the rope becomes taut is as chance has it
    let mean = |steps: usize| (0..10).map(|i| away(steps + i)).sum::<f64>() / 10.0;
    let (coarse, fine) = (mean(200), mean(800));
    println!("{coarse:e} {fine:e}");
    assert!(fine < coarse / 12.0, "{coarse} {fine}");
}
