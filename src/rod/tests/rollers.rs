//! Rods on rollers, against beam theory and the balance of forces.

use super::super::*;
use super::tangent::compare;
use nalgebra::Vector3;

/// A roller at x under a rod that runs along x.
fn plain(x: f64, stiffness: f64) -> Roller {
    Roller {
        place: Vector3::new(x, 0.0, 0.0),
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
    let segment = Segment { bending, compression: true, ..Segment::line(length, elements, weight / 9.81, 1e9, 0.3) };
    Rod::new("pipe", vec![segment], vec![]).unwrap()
}

#[test]
fn a_beam_over_three_rollers_has_the_reactions_of_the_continuous_beam() {
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
        let fluid = UniformFluid::none();
        let world = World { rollers: &rollers, ..World::new(&fluid, 9.81) };
        let (a, b) = (Vector3::zeros(), Vector3::x() * rod.length());
        let mut state = State::along(&rod, &[a, b]).unwrap();
        let mut solver = Solver::new(&rod, Settings::default());
        let made = solver.statics(&rod, &mut state, &world, [End::pinned(a), End::FREE]).unwrap();
        let told = rod.rollers(&state, &world);
        for (told, wanted) in told.iter().zip(wanted) {
            // second order in the element, (1/80)^2; a support sinks by 2e-5 m, which takes 12 EI / L^3 of it
            assert!((told.force.z / wanted - 1.0).abs() < 1e-3, "{elements}: {told:?} {wanted}");
            assert!(told.gap.unwrap() < 0.0);
        }
        let sum = told.iter().map(|r| r.force.z).sum::<f64>() - made.force[0].z;
        // of the whole weight, to the residual of statics
        assert!((sum / (w * rod.length()) - 1.0).abs() < 1e-6, "{sum}");
        let moment = rod.results(&state, &world, &[End::pinned(a), End::FREE]);
        let most = moment.iter().filter(|n| (n.arc - span).abs() < 1.0).fold(0.0, |m: f64, n| m.max(n.moment));
        assert!((most / m1.abs() - 1.0).abs() < 0.02, "{most} {m1}");
    }
}

/// Reactions of the middle of seven rollers as a pipe is pulled over them by two metres, and the largest pull along.
fn slid(elements: usize) -> (Vec<f64>, f64) {
    let (span, w) = (10.0, 100.0);
    let length = 7.0 * span;
    let rod = pipe(length, elements, w, 1e7);
    let rollers: Vec<Roller> = (0..7).map(|i| Roller { damping: 1e4, ..plain(span * i as f64 + 4.0, 1e7) }).collect();
    let fluid = UniformFluid::none();
    let world = World { rollers: &rollers, ..World::new(&fluid, 9.81) };
    let mut state = State::along(&rod, &[Vector3::zeros(), Vector3::x() * length]).unwrap();
    let mut solver = Solver::new(&rod, Settings::default());
    solver.statics(&rod, &mut state, &world, [End::pinned(Vector3::zeros()), End::FREE]).unwrap();
    let (mut reactions, mut pull) = (Vec::new(), 0.0f64);
    let (speed, h) = (0.1, 0.1);
    for i in 1..=200 {
        let t = h * i as f64;
        let motion = Motion {
            position: Vector3::x() * (-speed * t),
            velocity: Vector3::x() * -speed,
            acceleration: Vector3::zeros(),
        };
        let made = solver.step(&rod, &mut state, &world, t, [End::moved(motion), End::FREE]).unwrap();
        // the jolt of the start has died out after two seconds
        if i > 20 {
            reactions.push(rod.rollers(&state, &world)[3].force.z);
            pull = pull.max(made.force[0].x.abs());
        }
    }
    (reactions, pull)
}

#[test]
fn a_pipe_that_slides_over_rollers_presses_evenly_as_nodes_go_by() {
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
fn lying(cradle: Roller, load: Vector3<f64>) -> (Vector3<f64>, RollerResult) {
    let segment = Segment { compression: true, ..Segment::line(200.0, 2, 1e-3, 1e7, 0.1) };
    let rod = Rod::new("line", vec![segment], vec![]).unwrap();
    let forces = [(1, load)];
    let fluid = UniformFluid::none();
    let rollers = [cradle];
    let world = World { rollers: &rollers, forces: &forces, ..World::new(&fluid, 0.0) };
    let (a, b) = (Vector3::x() * -100.0, Vector3::x() * 100.0);
    let mut state = State::along(&rod, &[a, b]).unwrap();
    let mut solver = Solver::new(&rod, Settings::default());
    solver.statics(&rod, &mut state, &world, [End::pinned(a), End::pinned(b)]).unwrap();
    (state.position[1], rod.rollers(&state, &world)[0])
}

#[test]
fn a_cradle_holds_a_pipe_by_the_balance_of_its_faces() {
    let load = Vector3::new(0.0, 300.0, -1000.0);
    // a V of 90 degrees: N1 + N2 = W / sin 45, N1 - N2 = H / cos 45
    let vee = Roller { half_width: 0.0, opening: std::f64::consts::FRAC_PI_2, ..plain(0.0, 1e5) };
    let (place, told) = lying(vee, load);
    // the rope, taut by 1e7 (d / 100)^2 / 2, bears a hundred-thousandth
    assert!((told.force + load).norm() < 1e-3 * load.norm(), "{told:?}");
    // depth of each face N / k: z = -(N1 + N2) sin / (2 k sin^2) and y = (N1 - N2) cos / (2 k cos^2)
    assert!((place.z + 1000.0 / 1e5).abs() < 1e-5 && (place.y - 300.0 / 1e5).abs() < 1e-5, "{place}");
    // a U: the floor bears the weight, the flank at 0.2 m the side load
    let (place, told) = lying(Roller { half_width: 0.2, ..plain(0.0, 1e5) }, load);
    assert!((place.z + 0.01).abs() < 2e-4 && (place.y - 0.203).abs() < 2e-4, "{place}");
    assert!((told.gap.unwrap() + 0.01).abs() < 2e-4, "{told:?}");
    // lifted: nothing acts, and the gap is its height
    let (place, told) = lying(Roller { half_width: 0.2, ..plain(0.0, 1e5) }, Vector3::z() * 2.0);
    assert_eq!(told.force, Vector3::zeros());
    assert!(place.z > 0.0 && (told.gap.unwrap() - place.z.min(0.2)).abs() < 1e-9, "{told:?} {place}");
    // a rod that ends before it
    let (_, told) = lying(plain(300.0, 1e5), load * 1e-3);
    assert_eq!((told.gap, told.arc), (None, None));
}

/// The books of a pipe dropped on two rollers that heave, by steps of `h` seconds.
fn dropped(h: f64) -> Balance {
    // soft along, so that its steps follow the waves of its landing
    let segment = Segment { bending: 1e6, compression: true, ..Segment::line(40.0, 40, 30.0, 1e6, 0.3) };
    let rod = Rod::new("pipe", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::none();
    let w = 0.9;
    let rollers = |t: f64| {
        [12.3, 30.0].map(|x| Roller {
            place: Vector3::new(x, 0.0, -0.4 + 0.2 * (w * t).sin()),
            velocity: Vector3::z() * (0.2 * w * (w * t).cos()),
            damping: 2e3,
            soft: 0.05,
            half_width: 0.1,
            opening: 1.0,
            ..plain(x, 1e5)
        })
    };
    let start = Vector3::zeros();
    let mut state = State::along(&rod, &[start, Vector3::new(40.0, 0.0, 1.0)]).unwrap();
    let mut solver = Solver::new(&rod, Settings { rho_inf: 0.9, ..Settings::default() });
    let ends = [End::pinned(start), End::FREE];
    let at = rollers(0.0);
    solver.start(&rod, &mut state, &World { rollers: &at, ..World::new(&fluid, 9.81) }, ends).unwrap();
    let mut books = None;
    for i in 1..=(6.0 / h).round() as usize {
        let t = i as f64 * h;
        let at = rollers(t);
        let world = World { rollers: &at, ..World::new(&fluid, 9.81) };
        let made = solver.step(&rod, &mut state, &world, t, ends).unwrap();
        match &mut books {
            None => books = Some(Balance::open(&rod, &state, &world, &solver, &made)),
            Some(books) => books.enter(&rod, &state, &world, &solver, &made),
        }
    }
    books.unwrap()
}

#[test]
fn a_pipe_dropped_on_moving_rollers_keeps_its_books() {
    let (coarse, fine) = (dropped(0.002), dropped(0.0005));
    assert!(fine.work.rollers.abs() > 0.01 * fine.turnover, "{fine:?}");
    // what the scheme damps of the pipe's ringing as it lands, and the trapezoidal rule leaves, falls with the step
    let [coarse_error, error] = [&coarse, &fine].map(|b| b.energy_error().abs() / b.turnover);
    assert!(coarse_error < 1e-3 && error < 0.3 * coarse_error, "{coarse_error} {error}");
    assert!(fine.momentum_error().norm() < 1e-3 * fine.impulse.norm().max(300.0 * 40.0 / 9.81), "{fine:?}");
}

#[test]
fn tangent_of_a_rod_on_rollers_is_the_difference_of_its_residual() {
    // soft along, so that rounding of its tension does not hide the rollers
    let segment = Segment { bending: 1e4, compression: true, ..Segment::line(20.0, 5, 30.0, 1e5, 0.3) };
    let rod = Rod::new("pipe", vec![segment], vec![]).unwrap();
    let mut state = State::along(&rod, &[Vector3::new(0.0, 0.0, -0.3), Vector3::new(19.0, 2.0, 0.0)]).unwrap();
    for i in 0..rod.nodes() {
        let s = i as f64;
        state.position[i] += Vector3::new((s * 1.3).sin(), (s * 2.1).cos(), (s * 0.7).sin()) * 0.2;
        state.velocity[i] = Vector3::new((s * 0.9).cos(), (s * 1.7).sin(), 0.5 * (s * 2.3).cos());
    }
    let tilted = nalgebra::Rotation3::from_euler_angles(0.2, -0.3, 0.4);
    let axes = [Vector3::x(), Vector3::y(), Vector3::z()].map(|a| tilted * a);
    let base = Roller { axes, velocity: Vector3::new(0.3, -0.4, 0.2), damping: 2e3, ..plain(0.0, 4e4) };
    let rollers = [
        Roller { place: Vector3::new(5.0, 0.4, 0.6), half_width: 0.0, opening: 1.7, ..base },
        Roller { place: Vector3::new(10.0, 1.5, 0.9), half_width: 0.1, opening: 0.3, soft: 0.02, ..base },
        Roller { place: Vector3::new(15.0, 1.2, 0.9), soft: 5.0, ..base },
    ];
    let fluid = UniformFluid::none();
    let world = World { rollers: &rollers, ..World::new(&fluid, 9.81) };
    // all three are in touch
    assert!(rod.rollers(&state, &world).iter().all(|r| r.force.norm() > 100.0), "{:?}", rod.rollers(&state, &world));
    let mut solver = Solver::new(&rod, Settings::default());
    compare(&rod, &state, &world, &mut solver);
}

#[test]
fn what_makes_no_cradle_says_why() {
    let good = plain(0.0, 1e5);
    assert_eq!(good.fault(), None);
    assert!(Roller { stiffness: -1.0, ..good }.fault().unwrap().contains("stiffness"));
    assert!(Roller { damping: f64::NAN, ..good }.fault().unwrap().contains("damping"));
    assert!(Roller { half_width: f64::NAN, ..good }.fault().unwrap().contains("half width"));
    assert!(Roller { opening: 3.2, ..good }.fault().unwrap().contains("opening"));
    assert!(Roller { axes: [Vector3::x(); 3], ..good }.fault().unwrap().contains("right angles"));
    assert!(Roller { place: Vector3::repeat(f64::INFINITY), ..good }.fault().unwrap().contains("place"));
}
