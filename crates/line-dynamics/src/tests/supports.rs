//! Rods on rollers, against beam theory and the balance of forces.

use super::super::*;
use super::tangent::compare;
use nalgebra::{Matrix3, Rotation3, Vector3};
use windlass_model::SchemeWeights;

/// A cradle: a floor that reaches `half_width` to each side, with a flank beyond on each side, `opening` between them.
/// Each pushes by stiffness times depth, which grows from zero over the first `soft`, with damping, and never pulls.
#[derive(Clone, Copy, Debug)]
struct Cradle {
    position: Vector3<f64>,
    velocity: Vector3<f64>,
    axes: [Vector3<f64>; 3],
    half_width: f64,
    opening: f64,
    stiffness: f64,
    damping: f64,
    soft: f64,
}

impl Cradle {
    /// The faces that push: unit normal into the cradle, and how far from the place along it the face lies (m).
    fn faces(&self) -> impl Iterator<Item = (Vector3<f64>, f64)> {
        let [_, across, up] = self.axes;
        let (sine, cosine) = (0.5 * self.opening).sin_cos();
        let floor = (self.half_width > 0.0).then_some((up, 0.0));
        let walled = self.half_width.is_finite();
        let flank = move |side: f64| walled.then(|| (up * sine - across * (side * cosine), -self.half_width * cosine));
        [floor, flank(-1.0), flank(1.0)].into_iter().flatten()
    }

    fn support(&self) -> Support<'_> {
        let holds = SupportTarget::Crossing(self.axes[0]);
        Support { position: self.position, velocity: self.velocity, target: holds, law: self }
    }
}

impl SupportLaw for Cradle {
    fn reaction(&self, at: &Vector3<f64>, velocity: &Vector3<f64>) -> Option<SupportReaction> {
        let mut made = SupportReaction::default();
        for (normal, offset) in self.faces() {
            let depth = offset - at.dot(&normal);
            if depth <= 0.0 {
                continue;
            }
            let soft = self.soft;
            let (spring, grown, bend, held) = if depth < soft {
                (0.5 * depth * depth / soft, depth / soft, 1.0 / soft, depth.powi(3) / (6.0 * soft))
            } else {
                (depth - 0.5 * soft, 1.0, 0.0, 0.5 * depth * depth - 0.5 * soft * depth + soft * soft / 6.0)
            };
            made.elastic.1 += self.stiffness * held;
            made.elastic.0 += normal * (self.stiffness * spring);
            let sinking = -velocity.dot(&normal);
            let push = self.stiffness * spring + self.damping * grown * sinking;
            if push <= 0.0 {
                continue;
            }
            let outer = normal * normal.transpose();
            made.force += normal * push;
            made.by_position += outer * (self.stiffness * grown + self.damping * bend * sinking);
            made.by_velocity += outer * (self.damping * grown);
        }
        (made.elastic.1 > 0.0).then_some(made)
    }
}

fn supports(cradles: &[Cradle]) -> Vec<Support<'_>> {
    cradles.iter().map(Cradle::support).collect()
}

/// A roller at x under a rod that runs along x.
fn plain(x: f64, stiffness: f64) -> Cradle {
    Cradle {
        position: Vector3::new(x, 0.0, 0.0),
        velocity: Vector3::zeros(),
        axes: [Vector3::x(), Vector3::y(), Vector3::z()],
        half_width: f64::INFINITY,
        opening: 0.0,
        stiffness,
        damping: 0.0,
        soft: 0.0,
    }
}

/// A pipe of a weight per length (N/m).
fn pipe(length: f64, elements: usize, weight: f64, bending: f64) -> Rod {
    let segment =
        RodSegment { bending, compression: true, ..RodSegment::line(length, elements, weight / 9.81, 1e9, 0.3) };
    Rod::new("pipe", vec![segment], vec![]).unwrap()
}

#[test]
fn beam_on_three_rollers_matches_continuous_beam_reactions() {
    // four supports, three equal spans, an overhang of a: Clapeyron's equations of three moments
    let (span, overhang, w, ei) = (20.0, 2.0, 100.0, 1e7);
    let m3 = -0.5 * w * overhang * overhang;
    let full = -0.5 * w * span * span;
    let m2 = (4.0 * (full - m3) - full) / 15.0;
    let m1 = (full - m2) / 4.0;
    let share = |near: f64, far: f64| 0.5 * w * span + (far - near) / span;
    let wanted = [share(m1, 0.0) + share(m1, m2), share(m2, m1) + share(m2, m3), share(m3, m2) + w * overhang];
    // nodes over the rollers, and rollers between nodes
    for elements in [248, 311] {
        let rod = pipe(3.0 * span + overhang, elements, w, ei);
        let rollers = [1.0, 2.0, 3.0].map(|i| plain(i * span, 1e8));
        let fluid = UniformFluid::vacuum();
        let world = LineEnvironment { supports: &supports(&rollers), ..LineEnvironment::new(&fluid, 9.81) };
        let (a, b) = (Vector3::zeros(), Vector3::x() * rod.length());
        let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::FREE]).unwrap();
        let result = rod.support_forces(&state, &world);
        for (result, wanted) in result.iter().zip(wanted) {
            // second order in the element, (1/80)^2; a support sinks by 2e-5 m, which takes 12 EI / L^3 of it
            assert!((-result.force.z / wanted - 1.0).abs() < 1e-3, "{elements}: {result:?} {wanted}");
        }
        let sum = -result.iter().map(|r| r.force.z).sum::<f64>() - made.force[0].z;
        // of the whole weight, to the residual of statics
        assert!((sum / (w * rod.length()) - 1.0).abs() < 1e-6, "{sum}");
        let moment = rod.results(&state, &world, &[RodEnd::pin(a), RodEnd::FREE]);
        let most = moment.iter().filter(|n| (n.arc - span).abs() < 1.0).fold(0.0, |m: f64, n| m.max(n.moment));
        // the nodes beside a roller share its force, which rounds the peak by a quarter of force times element at most
        let rounded = 0.25 * wanted[0] * rod.length() / elements as f64;
        assert!(most < m1.abs() && most > 0.995 * m1.abs() - rounded, "{most} {m1} {rounded}");
    }
}

/// Reactions of the middle of seven rollers as a pipe is pulled over them by two metres, and the largest pull along.
fn slid(elements: usize) -> (Vec<f64>, f64) {
    let (span, w) = (10.0, 100.0);
    let length = 7.0 * span;
    let rod = pipe(length, elements, w, 1e7);
    let rollers: Vec<Cradle> = (0..7).map(|i| Cradle { damping: 1e4, ..plain(span * i as f64 + 4.0, 1e7) }).collect();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment { supports: &supports(&rollers), ..LineEnvironment::new(&fluid, 9.81) };
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::x() * length]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, [RodEnd::pin(Vector3::zeros()), RodEnd::FREE]).unwrap();
    let (mut reactions, mut pull) = (Vec::new(), 0.0f64);
    let (speed, h) = (0.1, 0.1);
    for i in 1..=200 {
        let t = h * i as f64;
        let motion = RodEndMotion {
            position: Vector3::x() * (-speed * t),
            velocity: Vector3::x() * -speed,
            acceleration: Vector3::zeros(),
        };
        let made = solver.step(&rod, &mut state, &world, t, [RodEnd::from_motion(motion), RodEnd::FREE]).unwrap();
        // the jolt of the start has died out after two seconds
        if i > 20 {
            reactions.push(-rod.support_forces(&state, &world)[3].force.z);
            pull = pull.max(made.force[0].x.abs());
        }
    }
    (reactions, pull)
}

#[test]
fn pipe_sliding_over_rollers_presses_evenly_across_nodes() {
    let meshes = [70, 140, 280].map(slid);
    for (reactions, pull) in &meshes {
        let jump = reactions.windows(2).map(|r| (r[1] - r[0]).abs()).fold(0.0, f64::max);
        // an inner support of many spans bears w L = 1000 N, but for the ends; a step goes by a hundredth of a span
        assert!(reactions.iter().all(|r| (r / 1000.0 - 1.0).abs() < 0.01), "{reactions:?}");
        assert!(jump < 0.2, "{jump}");
        // of the 7 kN that lie on the rollers
        assert!(*pull < 1.0, "{pull}");
    }
    let apart = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    let (coarse, fine) = (apart(&meshes[0].0, &meshes[2].0), apart(&meshes[1].0, &meshes[2].0));
    // elements of a metre in spans of ten ripple by a part in five thousand, and finer ones by less
    assert!(coarse < 0.2 && fine < 0.5 * coarse, "{coarse} {fine}");
}

/// A heavy point on a hinge of light rope along x, let down into a cradle and pulled aside.
fn lying(cradle: Cradle, load: Vector3<f64>) -> (Vector3<f64>, SupportForce) {
    let segment = RodSegment { compression: true, ..RodSegment::line(200.0, 2, 1e-3, 1e7, 0.1) };
    let rod = Rod::new("line", vec![segment], vec![]).unwrap();
    let forces = [(1, load)];
    let fluid = UniformFluid::vacuum();
    let rollers = [cradle];
    let world = LineEnvironment { supports: &supports(&rollers), forces: &forces, ..LineEnvironment::new(&fluid, 0.0) };
    let (a, b) = (Vector3::x() * -100.0, Vector3::x() * 100.0);
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)]).unwrap();
    (state.position[1], rod.support_forces(&state, &world)[0])
}

#[test]
fn cradle_holds_pipe_by_force_balance_of_faces() {
    let load = Vector3::new(0.0, 300.0, -1000.0);
    // a V of 90 degrees: N1 + N2 = W / sin 45, N1 - N2 = H / cos 45
    let vee = Cradle { half_width: 0.0, opening: std::f64::consts::FRAC_PI_2, ..plain(0.0, 1e5) };
    let (position, result) = lying(vee, load);
    // the rope, taut by 1e7 (d / 100)^2 / 2, bears a hundred-thousandth
    assert!((result.force - load).norm() < 1e-3 * load.norm(), "{result:?}");
    // depth of each face N / k: z = -(N1 + N2) sin / (2 k sin^2) and y = (N1 - N2) cos / (2 k cos^2)
    assert!((position.z + 1000.0 / 1e5).abs() < 1e-5 && (position.y - 300.0 / 1e5).abs() < 1e-5, "{position}");
    // a U: the floor bears the weight, the flank at 0.2 m the side load
    let (position, _) = lying(Cradle { half_width: 0.2, ..plain(0.0, 1e5) }, load);
    assert!((position.z + 0.01).abs() < 2e-4 && (position.y - 0.203).abs() < 2e-4, "{position}");
    // lifted: nothing acts
    let (position, result) = lying(Cradle { half_width: 0.2, ..plain(0.0, 1e5) }, Vector3::z() * 2.0);
    assert_eq!(result.force, Vector3::zeros());
    assert!(position.z > 0.0, "{position}");
    // a rod that ends before it
    let (_, result) = lying(plain(300.0, 1e5), load * 1e-3);
    assert_eq!((result.force, result.arc), (Vector3::zeros(), None));
}

/// The energy balance of a pipe dropped on two rollers that heave, by steps of `h` seconds.
fn energy_balance_of_drop(h: f64) -> RodEnergyBalance {
    // soft along, so that its steps follow the waves of its landing
    let segment = RodSegment { bending: 1e6, compression: true, ..RodSegment::line(40.0, 40, 30.0, 1e6, 0.3) };
    let rod = Rod::new("pipe", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let w = 0.9;
    let rollers = |t: f64| {
        [12.3, 30.0].map(|x| Cradle {
            position: Vector3::new(x, 0.0, -0.4 + 0.2 * (w * t).sin()),
            velocity: Vector3::z() * (0.2 * w * (w * t).cos()),
            damping: 2e3,
            soft: 0.05,
            half_width: 0.1,
            opening: 1.0,
            ..plain(x, 1e5)
        })
    };
    let start = Vector3::zeros();
    let mut state = RodState::along_points(&rod, &[start, Vector3::new(40.0, 0.0, 1.0)]).unwrap();
    let mut solver =
        RodSolver::new(&rod, RodSettings { scheme: SchemeWeights::generalised_alpha(0.9), ..RodSettings::default() });
    let ends = [RodEnd::pin(start), RodEnd::FREE];
    let at = rollers(0.0);
    solver
        .start(
            &rod,
            &mut state,
            &LineEnvironment { supports: &supports(&at), ..LineEnvironment::new(&fluid, 9.81) },
            ends,
        )
        .unwrap();
    let mut balance = None;
    for i in 1..=(6.0 / h).round() as usize {
        let t = i as f64 * h;
        let at = rollers(t);
        let world = LineEnvironment { supports: &supports(&at), ..LineEnvironment::new(&fluid, 9.81) };
        let made = solver.step(&rod, &mut state, &world, t, ends).unwrap();
        match &mut balance {
            None => balance = Some(RodEnergyBalance::open(&rod, &state, &world, &solver, &made)),
            Some(balance) => balance.enter(&rod, &state, &world, &solver, &made),
        }
    }
    balance.unwrap()
}

#[test]
fn pipe_dropped_on_moving_rollers_keeps_energy_balance() {
    let (coarse, fine) = (energy_balance_of_drop(0.002), energy_balance_of_drop(0.0005));
    assert!(fine.work.supports.abs() > 0.01 * fine.turnover, "{fine:?}");
    // what the scheme damps of the pipe's ringing as it lands, and the trapezoidal rule leaves, falls with the step
    let [coarse_error, error] = [&coarse, &fine].map(|b| b.energy_error().abs() / b.turnover);
    assert!(coarse_error < 1e-3 && error < 0.3 * coarse_error, "{coarse_error} {error}");
    assert!(fine.momentum_error().norm() < 1e-3 * fine.impulse.norm().max(300.0 * 40.0 / 9.81), "{fine:?}");
}

#[test]
fn rod_on_rollers_tangent_matches_finite_difference() {
    // soft along, so that rounding of its tension does not hide the rollers
    let segment = RodSegment { bending: 1e4, compression: true, ..RodSegment::line(20.0, 5, 30.0, 1e5, 0.3) };
    let rod = Rod::new("pipe", vec![segment], vec![]).unwrap();
    let mut state =
        RodState::along_points(&rod, &[Vector3::new(0.0, 0.0, -0.3), Vector3::new(19.0, 2.0, 0.0)]).unwrap();
    state.move_origin(Vector3::zeros());
    for i in 0..rod.nodes() {
        let s = i as f64;
        state.position[i] += Vector3::new((s * 1.3).sin(), (s * 2.1).cos(), (s * 0.7).sin()) * 0.2;
        state.velocity[i] = Vector3::new((s * 0.9).cos(), (s * 1.7).sin(), 0.5 * (s * 2.3).cos());
    }
    let tilted = nalgebra::Rotation3::from_euler_angles(0.2, -0.3, 0.4);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|a| tilted * a);
    let base = Cradle { axes, velocity: Vector3::new(0.3, -0.4, 0.2), damping: 2e3, ..plain(0.0, 4e4) };
    let rollers = [
        Cradle { position: Vector3::new(5.0, 0.4, 0.6), half_width: 0.0, opening: 1.7, ..base },
        Cradle { position: Vector3::new(10.0, 1.5, 0.9), half_width: 0.1, opening: 0.3, soft: 0.02, ..base },
        Cradle { position: Vector3::new(15.0, 1.2, 0.9), soft: 5.0, ..base },
    ];
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment { supports: &supports(&rollers), ..LineEnvironment::new(&fluid, 9.81) };
    // all three are in touch
    assert!(
        rod.support_forces(&state, &world).iter().all(|r| r.force.norm() > 100.0),
        "{:?}",
        rod.support_forces(&state, &world)
    );
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    compare(&rod, &state, &world, &mut solver);
}

/// A soft spring from a support to a node.
#[derive(Debug)]
struct Sling(f64);

impl SupportLaw for Sling {
    fn reaction(&self, at: &Vector3<f64>, _: &Vector3<f64>) -> Option<SupportReaction> {
        let stiffness = Matrix3::identity() * self.0;
        let elastic = (-at * self.0, 0.5 * self.0 * at.norm_squared());
        Some(SupportReaction { force: -at * self.0, by_position: stiffness, by_velocity: Matrix3::zeros(), elastic })
    }
}

/// A pipe on two cradles, the first turned by `motion` about its place and the second tilted, its first node on a sling: forces and
/// moments on all three, and how they follow.
fn on_three(motion: &[[f64; 6]; 3]) -> (Vec<[Vector3<f64>; 2]>, SupportTangent) {
    let segment = RodSegment { bending: 1e4, compression: true, ..RodSegment::line(30.0, 30, 30.0, 1e6, 0.3) };
    let rod = Rod::new("pipe", vec![segment], vec![]).unwrap();
    let placed = |i: usize, position: Vector3<f64>| position + Vector3::from_row_slice(&motion[i][..3]);
    let turned = |i: usize, tilt: f64| {
        let turn = Rotation3::from_scaled_axis(Vector3::from_row_slice(&motion[i][3..]));
        let axes = Rotation3::from_axis_angle(&Vector3::y_axis(), tilt);
        [Vector3::x(), Vector3::y(), Vector3::z()].map(|a| turn * (axes * a))
    };
    let cradle = |i: usize, x: f64, tilt: f64| Cradle {
        position: placed(i, Vector3::new(x, 0.1, 0.2)),
        axes: turned(i, tilt),
        half_width: 0.0,
        opening: 1.5,
        ..plain(x, 1e5)
    };
    let cradles = [cradle(0, 10.2, 0.0), cradle(1, 20.4, -0.15)];
    let sling = Sling(2e4);
    let mut held = supports(&cradles);
    let position = placed(2, Vector3::new(-0.5, 0.3, 0.4));
    held.push(Support { position, velocity: Vector3::zeros(), target: SupportTarget::Node(0), law: &sling });
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment { supports: &held, ..LineEnvironment::new(&fluid, 9.81) };
    let (a, b) = (Vector3::zeros(), Vector3::new(30.0, 0.0, -0.5));
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, [RodEnd::FREE, RodEnd::pin(b)]).unwrap();
    let result = rod.support_forces(&state, &world).iter().map(|s| [s.force, s.moment]).collect();
    (result, solver.support_tangent(&rod, &world).unwrap())
}

#[test]
fn support_force_derivatives_match_motion_finite_differences() {
    let (result, tangent) = on_three(&[[0.0; 6]; 3]);
    assert!(result.iter().all(|t| t[0].norm() > 100.0), "{result:?}");
    assert!(tangent.velocity.is_empty());
    let size = tangent.position.iter().map(|k| k.amax()).fold(0.0, f64::max);
    let step = 1e-4;
    for (j, dof) in (0..3).flat_map(|j| (0..6).map(move |f| (j, f))) {
        let moved = |sign: f64| {
            let mut motion = [[0.0; 6]; 3];
            motion[j][dof] = sign * step;
            on_three(&motion).0
        };
        let (plus, minus) = (moved(1.0), moved(-1.0));
        for i in 0..3 {
            for row in 0..6 {
                let slope = (plus[i][row / 3][row % 3] - minus[i][row / 3][row % 3]) / (2.0 * step);
                let own = tangent.position[3 * i + j][(row, dof)];
                // positions of rest are found to a part in 1e9 of the weight, 9 kN, against a step of 1e-4
                assert!((slope - own).abs() < 1e-4 * size, "{i} {row} {j} {dof}: {slope} {own} {size}");
            }
        }
    }
}
