//! Heat, pressure, stresses, and what makes no rod.

use super::super::*;
use nalgebra::Vector3;

const E: f64 = 2.07e11;

fn pipe(tube: TubeSection) -> Rod {
    let [outside, inside] = tube.areas();
    let segment = RodSegment {
        compression: true,
        bending: E * tube.second_moment(),
        tube: Some(tube),
        ..RodSegment::line(20.0, 10, 100.0, E * (outside - inside), tube.outer)
    };
    Rod::new("pipe", vec![segment], vec![]).unwrap()
}

#[test]
fn heated_pressurised_pipe_between_fixed_ends_matches_closed_form() {
    let tube = TubeSection { expansion: 1.17e-5, warmer: 50.0, pressure: 1e7, ..TubeSection::empty(0.3239, 0.2985) };
    let rod = pipe(tube);
    let fluid = UniformFluid::still_water(1025.0);
    let depth = 100.0;
    let world = LineEnvironment::new(&fluid, 9.80665);
    let (a, b) = (Vector3::new(0.0, 0.0, -depth), Vector3::new(20.0, 0.0, -depth));
    let state = RodState::along_points(&rod, &[a, b]).unwrap();
    let found = rod.results(&state, &world, &[RodEnd::pin(a), RodEnd::pin(b)])[5];
    // rho g h, and what the pipe was filled to
    assert_eq!(found.pressures, [1025.0 * 9.80665 * depth, 1e7]);
    let [outside, inside] = tube.areas();
    let wall = outside - inside;
    let outer = 1025.0 * 9.80665 * depth;
    // fixed length: thermal force -EA alpha dT, and by Poisson's ratio of the hoop and radial stress 2 nu (p_i A_i -
    // p_e A_e) in the wall (Lame)
    let exact = -E * wall * 1.17e-5 * 50.0 + 2.0 * 0.3 * (1e7 * inside - outer * outside);
    // the same formula another way: rounding
    assert!((found.wall / exact - 1.0).abs() < 1e-9, "{} {exact}", found.wall);
    let effective = exact + outer * outside - 1e7 * inside;
    assert!((found.effective / effective - 1.0).abs() < 1e-9);
    // hoop stress at the inner surface, Lame: (p_i (b^2 + a^2) - 2 p_e b^2) / (b^2 - a^2)
    let (ri, ro) = (0.5 * tube.inner, 0.5 * tube.outer);
    let hoop = (1e7 * (ro * ro + ri * ri) - 2.0 * outer * ro * ro) / (ro * ro - ri * ri);
    let stress = found.stress.unwrap();
    assert!((stress.hoop / hoop - 1.0).abs() < 1e-9, "{} {hoop}", stress.hoop);
    assert!((stress.axial / (exact / wall) - 1.0).abs() < 1e-9);
    let radial = -1e7;
    let mises =
        (0.5 * ((hoop - radial).powi(2) + (radial - stress.axial).powi(2) + (stress.axial - hoop).powi(2))).sqrt();
    assert!((stress.von_mises / mises - 1.0).abs() < 1e-9);
}

/// Linear waves in deep water along x, on still water (Airy).
struct Waves {
    amplitude: f64,
    number: f64,
}

impl Waves {
    /// Elevation of the surface over the mean level (m).
    fn elevation(&self, x: f64, time: f64) -> f64 {
        self.amplitude * (self.number * x - (self.number * G).sqrt() * time).cos()
    }
}

const G: f64 = 9.80665;

impl FluidField for Waves {
    fn sample(&self, at: &Vector3<f64>, time: f64) -> FluidState {
        let surface = self.elevation(at.x, time);
        FluidState {
            surface,
            head: surface * ((self.number * at.z.min(0.0)).exp() - 1.0),
            ..UniformFluid::still_water(1025.0).0
        }
    }
}

#[test]
fn external_pressure_on_deep_pipe_matches_wave_at_its_depth() {
    // a wave of 10 m and 8 s over a pipe between fixed ends
    let number = (std::f64::consts::TAU / 8.0).powi(2) / G;
    let waves = Waves { amplitude: 5.0, number };
    let world = LineEnvironment::new(&waves, G);
    let tube = TubeSection::empty(0.5, 0.46);
    let rod = pipe(tube);
    let [outside, _] = tube.areas();
    for depth in [2.0, 20.0, 300.0] {
        let (a, b) = (Vector3::new(0.0, 0.0, -depth), Vector3::new(20.0, 0.0, -depth));
        let ends = [RodEnd::pin(a), RodEnd::pin(b)];
        let pressure = |x: f64, time: f64| 1025.0 * G * (depth + waves.elevation(x, time) * (-number * depth).exp());
        for time in [0.0, 2.0, 4.0] {
            let state = RodState { time, ..RodState::along_points(&rod, &[a, b]).unwrap() };
            let found = rod.results(&state, &world, &ends);
            for (i, node) in found.iter().enumerate() {
                // at a trough of 5 m the first depth lies above the surface
                let wet = waves.elevation(node.position.x, time) > -depth;
                let exact = if wet { pressure(node.position.x, time) } else { 0.0 };
                assert!(
                    (node.pressures[0] - exact).abs() <= 1e-9 * exact,
                    "{depth} {time} {i}: {:?} {exact}",
                    node.pressures
                );
                if !wet || depth < 10.0 || i == 0 || i == 10 {
                    continue;
                }
                // Poisson's ratio alone stretches a pipe that is held: T = (1 - 2 nu) p A; the mean of three nodes has
                // the bend of the wave over 2 m in it; strains are rounded to 1e-15 of EA
                let mean = 0.25
                    * (pressure(node.position.x - 2.0, time) + 2.0 * exact + pressure(node.position.x + 2.0, time));
                assert!(
                    (node.effective / (0.4 * mean * outside) - 1.0).abs() < 1e-8,
                    "{depth} {time} {i}: {}",
                    node.effective
                );
                assert!((node.wall - (node.effective - exact * outside)).abs() < 1e-9 * exact * outside);
            }
        }
    }
}

#[test]
fn cooling_pipe_seabed_contact_stiffness_follows_its_tension() {
    // sag w l^2 / (8 T) of an element, T by Poisson's ratio and what cooling by 50 K pulls: EA alpha dT, 1.5 MN
    let tube = TubeSection { expansion: 1.17e-5, warmer: -50.0, ..TubeSection::empty(0.3239, 0.2985) };
    let rod = pipe(tube);
    let [outside, inside] = tube.areas();
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment::new(&fluid, G);
    let (a, b) = (Vector3::new(0.0, 0.0, -100.0), Vector3::new(20.0, 0.0, -100.0));
    let mut state = RodState::along_points(&rod, &[a, b]).unwrap();
    RodSolver::new(&rod, RodSettings::default())
        .statics(&rod, &mut state, &world, [RodEnd::pin(a), RodEnd::pin(b)])
        .unwrap();
    let pull = E * (outside - inside) * 1.17e-5 * 50.0 + 0.4 * 1025.0 * G * 100.0 * outside;
    let sag = (100.0 - 1025.0 * outside) * G * 4.0 / (8.0 * pull);
    for bedding in &state.bedding {
        // it sags by 5 mm, which stretches it by 1e-7 of what the cold does by 6e-4
        assert!((bedding / sag - 1.0).abs() < 1e-3, "{bedding} {sag}");
    }
}

#[test]
fn pressurised_tube_without_compression_is_taut() {
    let fluid = UniformFluid::still_water(1025.0);
    let world = LineEnvironment::new(&fluid, G);
    let depth = 1000.0;
    let pull = |pressure: f64, compression: bool, stretch: f64| {
        let tube = TubeSection { pressure, ..TubeSection::empty(0.3, 0.28) };
        let [outside, inside] = tube.areas();
        let segment = RodSegment { compression, tube: Some(tube), ..RodSegment::line(20.0, 10, 100.0, 1e9, 0.3) };
        let rod = Rod::new("hose", vec![segment], vec![]).unwrap();
        let (a, b) = (Vector3::new(0.0, 0.0, -depth), Vector3::new(20.0 * (1.0 + stretch), 0.0, -depth));
        let state = RodState::along_points(&rod, &[a, b]).unwrap();
        let found = rod.results(&state, &world, &[RodEnd::pin(a), RodEnd::pin(b)])[5].effective;
        (found, 1e9 * stretch + 0.4 * (1025.0 * G * depth * outside - pressure * inside))
    };
    for (pressure, stretch) in [(0.0, 0.0), (0.0, -1e-4), (0.0, -1e-3), (3e7, 1e-3), (3e7, 1e-4), (1e7, 0.0)] {
        // strains are rounded to 1e-15 of EA
        let (found, exact) = pull(pressure, true, stretch);
        assert!((found - exact).abs() < 1e-3, "{pressure} {stretch}: {found} {exact}");
        let (found, exact) = pull(pressure, false, stretch);
        assert!((found - exact.max(0.0)).abs() < 1e-3, "{pressure} {stretch}: {found} {exact}");
    }
}

#[test]
fn pressure_is_continuous_to_zero_at_surface_with_its_slope() {
    let waves = Waves { amplitude: 5.0, number: 0.063 };
    for time in [0.0, 1.1, 4.0] {
        let surface = waves.elevation(0.0, time);
        let at = |depth: f64| {
            let z = surface - depth;
            let fluid = waves.sample(&Vector3::new(0.0, 0.0, z), time);
            (fluid.pressure(z, G), fluid)
        };
        assert_eq!(at(-0.5).0, (0.0, 0.0));
        // a hand under the surface it is no more than twice that at rest
        assert!((0.0..=2.0 * 1025.0 * G * 0.1 * 1.000_001).contains(&at(0.1).0.0));
        for depth in [0.03, 1.0, 40.0] {
            let ((_, slope), fluid) = at(depth);
            let z = surface - depth;
            let h = 1e-5;
            let difference = (fluid.pressure(z + h, G).0 - fluid.pressure(z - h, G).0) / (2.0 * h);
            // rounding of 1e5 Pa over 1e-5 m
            assert!((slope - difference).abs() < 1e-4 * slope.abs(), "{time} {depth}: {slope} {difference}");
        }
    }
}

#[test]
fn invalid_rod_is_refused_with_its_reason() {
    let good = RodSegment::line(10.0, 5, 10.0, 1e6, 0.1);
    let message = |segment: RodSegment| Rod::new("R", vec![segment], vec![]).unwrap_err().to_string();
    assert!(message(RodSegment { elements: 0, ..good.clone() }).contains("number of elements"));
    assert!(message(RodSegment { mass: 0.0, ..good.clone() }).contains("mass per length is 0"));
    assert!(message(RodSegment { axial: TensionLaw::Linear(0.0), ..good.clone() }).contains("axial stiffness"));
    assert!(
        message(RodSegment { axial: TensionLaw::Table(vec![(0.0, 0.0)]), ..good.clone() }).contains("axial stiffness")
    );
    assert!(message(RodSegment { length: f64::NAN, ..good.clone() }).contains("length"));
    assert!(message(RodSegment { bending: -1.0, ..good.clone() }).contains("bending stiffness"));
    assert!(
        message(RodSegment { tube: Some(TubeSection::empty(0.1, 0.1)), ..good.clone() })
            .contains("thinner than the radius")
    );
    let huge = message(RodSegment { elements: usize::MAX, ..good.clone() });
    assert!(huge.contains("MB"), "{huge}");
    assert!(Rod::new("R", vec![], vec![]).is_err());
    let attachment = Attachment::mass(6, 1.0);
    assert!(Rod::new("R", vec![good.clone()], vec![attachment]).unwrap_err().to_string().contains("from 0 to 5"));
    let rod = Rod::new("R", vec![good], vec![]).unwrap();
    assert!(RodState::along_points(&rod, &[Vector3::zeros(), Vector3::zeros()]).is_err());
    // a state of another rod
    let other = Rod::new("S", vec![RodSegment::line(10.0, 7, 10.0, 1e6, 0.1)], vec![]).unwrap();
    let mut state = RodState::along_points(&other, &[Vector3::zeros(), Vector3::x()]).unwrap();
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let mut solver = RodSolver::new(&rod, RodSettings::default());
    assert!(solver.statics(&rod, &mut state, &world, [RodEnd::FREE; 2]).unwrap_err().to_string().contains("6 nodes"));
    assert!(solver.step(&rod, &mut state, &world, 1.0, [RodEnd::FREE; 2]).is_err());
    assert!(solver.modes(&other, &state, &world, [RodEnd::FREE; 2], 1).is_err());
}

#[test]
fn polynomial_and_tension_table_hang_as_the_law_they_describe() {
    let fluid = UniformFluid::vacuum();
    let world = LineEnvironment::new(&fluid, 9.81);
    let stretch = |axial: TensionLaw| {
        let rod =
            Rod::new("R", vec![RodSegment { axial, ..RodSegment::line(10.0, 50, 20.0, 1e4, 0.1) }], vec![]).unwrap();
        let top = Vector3::zeros();
        let mut state = RodState::along_points(&rod, &[top, Vector3::new(0.0, 0.0, -10.0)]).unwrap();
        let mut solver = RodSolver::new(&rod, RodSettings::default());
        solver.statics(&rod, &mut state, &world, [RodEnd::pin(top), RodEnd::FREE]).unwrap();
        -state.node_position(50).unwrap().z - 10.0
    };
    // own weight w over length L: w L^2 / 2 EA
    let linear = 20.0 * 9.81 * 100.0 / (2.0 * 1e4);
    // weight in lumps is exact for the sum of strains of a straight line
    assert!((stretch(TensionLaw::Linear(1e4)) / linear - 1.0).abs() < 1e-6);
    let table = (0..=40).map(|i| (i as f64 * 0.01, i as f64 * 100.0)).collect();
    assert!((stretch(TensionLaw::Table(table)) / linear - 1.0).abs() < 1e-6);
    // T = c e + d e^2: strain at tension T is (sqrt(c^2 + 4 d T) - c) / 2 d, integrated over T = w s
    let (c, d, w) = (1e4, 4e4, 20.0 * 9.81);
    let curved =
        ((c * c + 4.0 * d * w * 10.0f64).powf(1.5) - c * c * c) / (6.0 * d * w) / (2.0 * d) - c * 10.0 / (2.0 * d);
    let found = stretch(TensionLaw::Polynomial(vec![c, d]));
    // midpoint rule over 50 elements
    assert!((found / curved - 1.0).abs() < 1e-3, "{found} {curved}");
}

#[test]
fn helix_moments_rotate_against_untwisted_frame_by_torsion() {
    // a helix of radius r and rise c per radian: curvature r / (r^2 + c^2), torsion c / (r^2 + c^2); against a frame
    // carried without twist the binormal turns by the torsion along the arc [BISHOP-1975]
    let (r, c, turns, elements, bending): (f64, f64, f64, usize, f64) = (3.0, 4.0, 1.5, 600, 2e5);
    let (speed, whole) = (r.hypot(c), 2.0 * std::f64::consts::PI * turns);
    let point = |s: f64| Vector3::new(r * s.cos(), r * s.sin(), c * s);
    let points: Vec<_> = (0..=elements).map(|i| point(whole * i as f64 / elements as f64)).collect();
    let (half, length) = (elements / 2, speed * whole);
    let segment = |elements| RodSegment { bending, ..RodSegment::line(0.5 * length, elements, 10.0, 1e9, 0.1) };
    let rod = Rod::new("helix", vec![segment(half), segment(half)], vec![]).unwrap();
    let state = RodState::along_points(&rod, &points).unwrap();
    let fluid = UniformFluid::vacuum();
    let found = rod.results(&state, &LineEnvironment::new(&fluid, 9.81), &[RodEnd::FREE; 2]);
    let (curvature, torsion) = (r / (speed * speed), c / (speed * speed));
    let inner = &found[1..elements];
    let start = inner[0].bends[1].atan2(inner[0].bends[0]);
    for (i, node) in inner.iter().enumerate() {
        // chords of a six-hundredth of three half turns: (ds k)^2 / 12
        assert!((node.moment / (bending * curvature) - 1.0).abs() < 1e-4, "{node:?}");
        assert!((node.bends[0].hypot(node.bends[1]) / node.moment - 1.0).abs() < 1e-4, "{node:?}");
        let angle = start + torsion * length * i as f64 / elements as f64;
        let wrong = node.bends[1].atan2(node.bends[0]) - angle;
        assert!(wrong.sin().abs() < 1e-3 && wrong.cos() > 0.0, "{i} {wrong}");
    }
    assert_eq!([0, half - 1, half, elements].map(|i| found[i].segment), [0, 0, 1, 1]);
    assert_eq!(found[5].pressures, [0.0; 2]);
}

#[test]
fn bend_is_reported_on_the_side_of_its_holder() {
    // a cantilever along y under a load along -z: its moment is about x alone, load times the arm
    let segment = RodSegment { bending: 1e9, compression: true, ..RodSegment::line(10.0, 20, 1.0, 1e12, 0.1) };
    let rod = Rod::new("arm", vec![segment], vec![]).unwrap();
    let fluid = UniformFluid::vacuum();
    let forces = [(20, Vector3::z() * -100.0)];
    let world = LineEnvironment { forces: &forces, ..LineEnvironment::new(&fluid, 0.0) };
    let mut state = RodState::along_points(&rod, &[Vector3::zeros(), Vector3::y() * 10.0]).unwrap();
    let ends = [RodEnd::pin(Vector3::zeros()).with_clamp(Vector3::y()).with_side(Vector3::x()), RodEnd::FREE];
    RodSolver::new(&rod, RodSettings::default()).statics(&rod, &mut state, &world, ends).unwrap();
    let found = rod.results(&state, &world, &ends);
    for node in &found[..20] {
        let moment = 100.0 * (10.0 - node.arc);
        // the moment of a bend toward -z of a rod along y is about -x; slopes of 5e-6, residual of statics
        assert!((node.bends[0] + moment).abs() < 1e-3 * moment.max(1.0), "{node:?} {moment}");
        assert!(node.bends[1].abs() < 1e-3, "{node:?}");
    }
}
