//! Rods at rest against the catenary, and their modes against closed forms.

use super::super::*;
use nalgebra::Vector3;

/// A rope in vacuum hung between two points, cut into elements; end forces and positions.
fn hung(elements: usize, b: Vector3<f64>) -> (RodEndForces, RodState) {
    let rod = Rod::new("rope", vec![RodSegment::line(100.0, elements, 50.0, 1e6, 0.1)], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let a = Vector3::zeros();
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)]).unwrap();
    (made, state)
}

/// x and z of the end of an elastic catenary with horizontal force h and vertical force v at its upper end (Irvine
/// 1981, 1.4).
fn catenary(h: f64, v: f64, length: f64, w: f64, ea: f64) -> [f64; 2] {
    let low = v - w * length;
    let x = h / w * ((v / h).asinh() - (low / h).asinh()) + h * length / ea;
    let z = h / w * ((v / h).hypot(1.0) - (low / h).hypot(1.0)) + (v * length - 0.5 * w * length * length) / ea;
    [x, z]
}

#[test]
fn hanging_rope_converges_to_elastic_catenary_with_second_order() {
    for b in [Vector3::new(60.0, 0.0, 40.0), Vector3::new(95.0, 0.0, 10.0), Vector3::new(40.0, 0.0, -50.0)] {
        let error = |elements| {
            let force = hung(elements, b).0.force[1];
            // the rope pulls its holder back and down
            let (h, v) = (-force.x, -force.z);
            let [x, z] = catenary(h, v, 100.0, 50.0 * 9.81, 1e6);
            (x - b.x).hypot(z - b.z) / 100.0
        };
        let errors = [25, 50, 100, 200].map(error);
        assert!(errors[3] < 1e-4, "{b}: {errors:?}");
        for pair in errors.windows(2) {
            let order = (pair[0] / pair[1]).log2();
            // two, with a little of the next order left in coarse meshes
            assert!((order - 2.0).abs() < 0.1, "{b}: {errors:?} order {order}");
        }
    }
}

#[test]
fn slack_vertical_grounded_and_buoyant_ropes_find_equilibrium() {
    let fluid = UniformFluid::still_water(1025.0);
    let bottom = PlaneBottom { height: -50.0, slope: [0.02, 0.01] };
    let ground = SeabedLaw { damping: 1e4, penetration_scale: 0.01, ..SeabedLaw::elastic(1e6) };
    let world = LineEnvironment { bottom: Some((&bottom, ground)), ..LineEnvironment::new(&fluid, 9.81) };
    for (mass, diameter) in [(100.0, 0.1), (20.0, 0.3)] {
        for bending in [0.0, 1e5, 1e6] {
            let segment =
                RodSegment { bending, compression: bending > 0.0, ..RodSegment::line(100.0, 60, mass, 1e8, diameter) };
            let rod = Rod::new("line", vec![segment], vec![]).unwrap();
            for (a, b) in [
                ([0.0, 0.0, -49.9], [20.0, 0.0, -10.0]),
                ([0.0, 0.0, -49.9], [99.0, 0.0, -47.0]),
                ([0.0, 0.0, -10.0], [30.0, 5.0, -10.0]),
                ([0.0, 0.0, -49.9], [3.0, 0.0, -1.0]),
                ([0.0, 0.0, -49.9], [60.0, 0.0, -48.0]),
                ([0.0, 0.0, -10.0], [0.1, 0.0, -30.0]),
                ([0.0, 0.0, -49.0], [90.0, 0.0, -5.0]),
            ] {
                if bending > 0.0 && b[0] < 5.0 {
                    // such a beam would be folded to a hairpin much narrower than its stiffness lets it
                    continue;
                }
                let (a, b) = (Vector3::from(a), Vector3::from(b));
                let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
                let mut solver = RodSolver::new(&rod, RodSettings::default());
                let made = solver.statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)]);
                let made = made.unwrap_or_else(|e| panic!("{mass} {bending} {a} {b}: {e}"));
                // whatever the shape, the holders and the bottom carry the submerged weight; free of the bottom, the
                // holders alone
                let weight = 100.0 * 9.81 * (mass - 1025.0 * std::f64::consts::FRAC_PI_4 * diameter * diameter);
                let held = made.force[0].z + made.force[1].z;
                let clear = state.node_positions().iter().all(|x| x.z > bottom.height(x.x, x.y).0 && x.z < -0.2);
                if clear {
                    assert!((held + weight).abs() < 1e-6 * weight.abs(), "{held} {weight}");
                }
                assert!(state.position.iter().all(|x| x.iter().all(|c| c.is_finite())));
                println!("{mass} {bending} {:?}: {} iterations", b.as_slice(), made.iterations);
            }
        }
    }
}

#[test]
fn hanging_chain_modes_match_zeros_of_j0() {
    let rod = Rod::new("chain", vec![RodSegment::line(10.0, 200, 5.0, 1e8, 0.1)], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let ends = [RodEnd::pin(Vector3::zeros()), RodEnd::FREE];
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::new(0.0, 0.0, -10.0)]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let modes = solver.modes(&rod, &state, &world, ends, 6).unwrap();
    // zeros of J0 (Abramowitz and Stegun, table 9.5); each mode stands twice, in x and in y
    for (i, zero) in [2.404_825_558, 5.520_078_110, 8.653_727_913].into_iter().enumerate() {
        let exact = 0.5 * zero * (9.81f64 / 10.0).sqrt();
        for mode in &modes[2 * i..2 * i + 2] {
            // second order: lumped mass and straight elements make it (8.65/400)^2 slow, 5e-4
            assert!((mode.frequency / exact - 1.0).abs() < 1e-3, "{i}: {} {exact}", mode.frequency);
        }
    }
}

#[test]
fn taut_string_and_bar_frequencies_match_closed_form() {
    let (length, mass, ea, stretch) = (50.0, 2.0, 1e7, 0.001);
    let segment = RodSegment { compression: true, ..RodSegment::line(length, 80, mass, ea, 0.1) };
    let rod = Rod::new("string", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 0.0);
    let (a, b) = (Vector3::zeros(), Vector3::new(length * (1.0 + stretch), 0.0, 0.0));
    let ends = [RodEnd::pin(a), RodEnd::pin(b)];
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    let modes = solver.modes(&rod, &state, &world, ends, 12).unwrap();
    let wave = (ea * stretch / (mass / (1.0 + stretch))).sqrt();
    for n in 1..=6 {
        let exact = n as f64 * std::f64::consts::PI / b.x * wave;
        // lumped mass: (n pi / 80)^2 / 24 is 2e-3 at n = 6
        let found = modes[2 * (n - 1)].frequency;
        assert!((found / exact - 1.0).abs() < 2.5e-3, "{n}: {found} {exact}");
    }
}

#[test]
fn equilibrium_near_a_known_one_takes_few_iterations() {
    let segment = RodSegment { drag_normal: 1.2, ..RodSegment::line(900.0, 50, 199.0, 8.54e8, 0.18) };
    let rod = Rod::new("chain", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::moving(1025.0, Vector3::new(0.2, 0.5, 0.0));
    let bottom = PlaneBottom { height: -300.0, slope: [0.0, 0.0] };
    let world =
        LineEnvironment { bottom: Some((&bottom, SeabedLaw::elastic(3e6))), ..LineEnvironment::new(&fluid, 9.80665) };
    let (a, b) = (Vector3::new(-800.0, 0.0, -300.0), Vector3::new(0.0, 0.0, -10.0));
    let mut state = RodState::along_points(&rod, &[a, Vector3::new(-350.0, 0.0, -300.0), b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let mut at =
        |state: &mut RodState, b| solver.statics(&rod, state, &world, [RodEnd::pin(a), RodEnd::pin(b)]).unwrap();
    at(&mut state, b);
    // the first time on a bottom that has become as soft as the elements are long
    assert!(at(&mut state, b).iterations <= 10);
    assert!(at(&mut state, b).iterations <= 3);
    let moves = [
        (Vector3::zeros(), 1),
        (Vector3::x() * 0.01, 4),
        (Vector3::new(0.3, -0.2, 0.1), 4),
        (Vector3::new(-2.0, 1.0, 0.0), 9),
    ];
    for (move_by, most) in moves {
        let mut near = state.clone();
        let made = at(&mut near, b + move_by);
        assert!(made.iterations <= most, "{move_by} {}", made.iterations);
        // the same as from far away, on a bottom as soft
        let mut far = RodState::along_points(&rod, &[a, Vector3::new(-350.0, 0.0, -300.0), b + move_by]).unwrap();
        far.bedding.clone_from(&state.bedding);
        let other = at(&mut far, b + move_by);
        // what a residual of 1e-9 of the largest force leaves, through a line fifty elements long
        assert!((made.force[1] - other.force[1]).norm() < 1e-7 * other.force[1].norm());
    }
}

#[test]
fn hanging_rope_end_tensions_are_its_weight_and_zero() {
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment::new(&fluid, 9.81);
    let (diameter, mass): (f64, f64) = (0.1, 40.0);
    let area = std::f64::consts::FRAC_PI_4 * diameter * diameter;
    // in air, and from 15 m above to 25 m below the surface
    for (top, wet) in [(100.0, 0.0), (15.0, 25.0)] {
        let rod = Rod::new("rope", vec![RodSegment::line(40.0, 8, mass, 1e12, diameter)], vec![]).unwrap();
        let ends = [RodEnd::pin(Vector3::z() * top), RodEnd::FREE];
        let mut state = RodState::along_points(&rod, &[Vector3::z() * top, Vector3::z() * (top - 40.0)]).unwrap();
        RodSolver::new(&rod, RodSettings::default()).statics(&rod, &mut state, &world, ends).unwrap();
        let found = rod.results(&state, &world, &ends);
        let exact = 9.81 * (40.0 * mass - 1025.0 * area * wet);
        // stretch of 1e-8, and the residual of statics, 1e-9 of the weight
        assert!((found[0].effective / exact - 1.0).abs() < 1e-7, "{} {exact}", found[0].effective);
        assert!(found[8].effective.abs() < 1e-7 * exact, "{}", found[8].effective);
    }
}

#[test]
fn rope_end_tension_is_nonnegative_and_matches_holder_in_motion() {
    // a rope of few elements that is shaken at its top while its foot lies on the bottom: carried on from the middles of
    // its elements the tension of the foot would be less than nothing
    let fluid = UniformFluid::moving(1025.0, Vector3::new(0.5, 0.2, 0.1));
    let bottom = PlaneBottom { height: -60.0, slope: [0.0; 2] };
    let world =
        LineEnvironment { bottom: Some((&bottom, SeabedLaw::elastic(1e5))), ..LineEnvironment::new(&fluid, 9.81) };
    let segment = RodSegment {
        drag_normal: 1.2,
        drag_tangential: 0.1,
        added_normal: 1.0,
        added_tangential: 0.2,
        ..RodSegment::line(185.0, 12, 150.0, 1e8, 0.3)
    };
    let rod = Rod::new("rope", vec![segment], vec![]).unwrap();
    let (a, b) = (Vector3::new(0.0, 0.0, -5.0), Vector3::new(150.0, 0.0, -60.0));
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    let mut ends = [RodEnd::pin(a), RodEnd::pin(b)];
    solver.statics(&rod, &mut state, &world, ends).unwrap();
    for i in 0..=100 {
        let result = rod.results(&state, &world, &ends);
        assert!(result.iter().all(|n| n.effective >= 0.0), "{i}: {result:?}");
        let t = f64::from(i + 1) * 0.05;
        let (s, c) = t.sin_cos();
        ends[0] = RodEnd::from_motion(RodEndMotion {
            position: a + Vector3::z() * (1.0 - c),
            velocity: Vector3::z() * s,
            acceleration: Vector3::z() * c,
        });
        let made = solver.step(&rod, &mut state, &world, t, ends).unwrap();
        let result = rod.results(&state, &world, &ends);
        let d = (state.position[1] - state.position[0]).normalize();
        let along = made.force[0].dot(&d);
        // the rod's pull on its holder along its first element, but for the tolerance of a step: 1e-5 of an element by the
        // stiffness of one is far more than what its last change leaves
        assert!(
            (result[0].effective - along).abs() < 1e-4 * along.abs().max(1e4),
            "{i}: {} {along}",
            result[0].effective
        );
    }
}

#[test]
fn buoyant_rope_mirrors_sinking_rope_in_as_many_iterations() {
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment::new(&fluid, 9.81);
    let water = 1025.0 * std::f64::consts::FRAC_PI_4 * 0.09;
    let rest = |mass: f64, up: f64| {
        let rod = Rod::new("rope", vec![RodSegment::line(100.0, 40, mass, 1e8, 0.3)], vec![]).unwrap();
        let (a, b) = (Vector3::new(0.0, 0.0, -300.0), Vector3::new(60.0, 0.0, -300.0 + up));
        let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
        let ends = [RodEnd::pin(a), RodEnd::pin(b)];
        let made = RodSolver::new(&rod, RodSettings::default()).statics(&rod, &mut state, &world, ends).unwrap();
        (state.node_positions(), made.iterations)
    };
    let ((light, few), (heavy, many)) = (rest(0.2, 10.0), rest(2.0 * water - 0.2, -10.0));
    for (a, b) in light.iter().zip(&heavy) {
        // 1e-9 of the weight, by the stiffness of its hanging shape
        assert!((a.x - b.x).abs() < 1e-5 && (a.z + 300.0 + b.z + 300.0).abs() < 1e-5, "{a} {b}");
    }
    assert!(few <= many, "{few} {many}");
}
