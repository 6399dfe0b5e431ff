//! The shape of a line, springs at its ends, stretch laws, and the line found from a tension.

use windlass_catenary::{Joint, Line, LineError, SeabedModel, Segment, StretchLaw};

const CHAIN: Segment = Segment { length: 800.0, weight: 1200.0, ea: 6e8 };
const ROPE: Segment = Segment { length: 500.0, weight: 40.0, ea: 8e7 };

fn build_mixed_line(slope: f64, friction: f64) -> Line {
    let floor = SeabedModel { elevation: -250.0, slope, friction };
    let line = Line::new(vec![CHAIN, ROPE, CHAIN], vec![Joint::Weight(3e4), Joint::Weight(-6e4)], -250.0, 0.0).unwrap();
    line.with_seabed(Some(floor)).unwrap()
}

#[test]
fn shape_runs_from_fairlead_to_anchor_along_tension() {
    for (slope, friction, x) in [(0.0, 0.0, 1900.0), (0.0, 0.6, 1950.0), (0.05, 0.0, 2020.0), (-0.05, 0.4, 1960.0)] {
        let line = build_mixed_line(slope, friction);
        let state = line.at_distance(x, -10.0).unwrap();
        let shape = line.shape(&state, 4000);
        let (first, last) = (shape.first().unwrap(), shape.last().unwrap());
        assert_eq!((first.x, first.z), (0.0, -10.0));
        assert!((last.x - x).abs() < 1e-6 && (last.z + 250.0).abs() < 1e-6, "{last:?}");
        assert!((first.horizontal - state.force).abs() < 1e-6 * state.force);
        assert!((last.horizontal - state.anchor_horizontal).abs() < 1e-6 * state.force, "{last:?} {state:?}");
        for (a, b) in shape.iter().zip(shape.iter().skip(1)).filter(|(a, b)| b.arc - a.arc > 1e-3) {
            let bottom = -250.0 + (x - b.x) * slope;
            assert!(b.z > bottom - 1e-6, "{b:?} below {bottom}");
            assert!(!b.on_bottom || (b.z - bottom).abs() < 1e-6);
            let segment = line.segments()[b.segment - 1];
            // the chord runs along the mean tension, as long as it is stretched
            let (dx, dz) = (b.x - a.x, a.z - b.z);
            let (h, v) = (0.5 * (a.horizontal + b.horizontal), 0.5 * (a.vertical + b.vertical));
            let tension = h.hypot(v).max(1e-9);
            let cross = (dx * v - dz * h).abs() / (dx.hypot(dz) * tension);
            let bend = segment.weight * (b.arc - a.arc) / tension * f64::from(!b.on_bottom as u8);
            assert!(cross < 1e-6 + bend * bend, "{a:?} {b:?} {cross}");
            let strain = dx.hypot(dz) / (b.arc - a.arc) - 1.0;
            assert!((strain - h.hypot(v) / segment.ea).abs() < 1e-6 + bend * bend, "{a:?} {b:?}");
        }
        if let Some((tx, tz)) = state.touchdown {
            assert!(shape.iter().any(|p| (p.x - tx).abs() < 1e-6 && (p.z - tz).abs() < 1e-6), "{:?}", state.touchdown);
        }
    }
}

#[test]
fn point_of_line_is_on_its_shape() {
    let line = build_mixed_line(0.0, 0.3);
    let state = line.at_distance(1900.0, 0.0).unwrap();
    for want in line.shape(&state, 7) {
        let got = line.point_at(&state, want.arc).unwrap();
        assert!((got.x - want.x).abs() < 1e-6 && (got.z - want.z).abs() < 1e-6, "{got:?} {want:?}");
    }
    assert_eq!(line.point_at(&state, -1.0), None);
    assert_eq!(line.point_at(&state, 1e6), None);
}

#[test]
fn springs_in_series_add_their_stretch_along_line() {
    // weightless and straight: T = (chord - L)/(L/EA + 1/k1 + y(T)/T)
    let line =
        Line::new(vec![Segment { weight: 0.0, ..ROPE }], vec![], -400.0, 0.0).unwrap().with_seabed(None).unwrap();
    let curve = StretchLaw::Curve(vec![(1e5, 0.5), (3e5, 1.0)]);
    let sprung = line.with_springs([Some(StretchLaw::Linear(2e5)), Some(curve)]).unwrap();
    let state = sprung.at_distance(304.5, 0.0).unwrap();
    let t = state.top_tension;
    let y = if t <= 1e5 { 0.5 * t / 1e5 } else { 0.5 + 0.5 * (t - 1e5) / 2e5 };
    let chord = 500.0 * (1.0 + t / 8e7) + t / 2e5 + y;
    assert!((chord - 304.5f64.hypot(400.0)).abs() < 1e-8, "{t} {chord}");
    assert!((state.force / t - 304.5 / 304.5f64.hypot(400.0)).abs() < 1e-10);
}

#[test]
fn spring_at_fairlead_softens_heavy_line_by_its_flexibility() {
    let line = Line::new(vec![CHAIN], vec![], -250.0, 0.0).unwrap();
    let line_below = line.clone();
    let sprung = line.with_springs([Some(StretchLaw::Linear(4e5)), None]).unwrap();
    let state = sprung.at_horizontal_force(8e5, 0.0).unwrap();
    let d = 10.0;
    let slope = (sprung.at_horizontal_force(8e5 + d, 0.0).unwrap().x
        - sprung.at_horizontal_force(8e5 - d, 0.0).unwrap().x)
        / (2.0 * d);
    assert!((slope - state.dx_dh).abs() < 1e-6 * slope, "{slope} {}", state.dx_dh);
    // the line itself begins where the spring ends
    let (h, v) = (state.force, state.top_vertical);
    let below = line_below.at_horizontal_force(8e5, -v / 4e5).unwrap();
    assert!((below.x + h / 4e5 - state.x).abs() < 1e-9 * state.x && (below.top_vertical - v).abs() < 1e-6, "{below:?}");
}

#[test]
fn polynomial_stiffness_holds_on_straight_line() {
    // T = (EA + k1 e + k2 e2 + k3 e3) e, secant reading
    let line =
        Line::new(vec![Segment { weight: 0.0, ..ROPE }], vec![], -300.0, 0.0).unwrap().with_seabed(None).unwrap();
    let law = StretchLaw::Polynomial { ea: 8e7, k: [2e8, 3e9, 4e10], most: 0.05 };
    let line = line.with_laws(vec![Some(law)]).unwrap();
    for strain in [0.001, 0.02, 0.05, 0.07] {
        let chord = 500.0 * (1.0 + strain);
        let state = line.at_distance((chord * chord - 9e4f64).sqrt(), 0.0).unwrap();
        let at = |e: f64| 8e7 + e * (2e8 + e * (3e9 + e * 4e10));
        let slope = |e: f64| 2e8 + e * (6e9 + e * 12e10);
        let ea = if strain <= 0.05 { at(strain) } else { at(0.05) + slope(0.05) * (strain - 0.05) };
        assert!(
            (state.top_tension / (ea * strain) - 1.0).abs() < 1e-9,
            "{strain} {} {}",
            state.top_tension,
            ea * strain
        );
    }
}

#[test]
fn polynomial_without_coefficients_gives_linear_law() {
    let line = Line::new(vec![CHAIN, ROPE], vec![Joint::Free], -250.0, 0.0).unwrap();
    let law = |ea: f64| Some(StretchLaw::Polynomial { ea, k: [0.0; 3], most: 0.1 });
    let other = line.clone().with_laws(vec![law(6e8), law(8e7)]).unwrap();
    for h in [1e3, 1e5, 3e6] {
        let (a, b) = (line.at_horizontal_force(h, 0.0).unwrap(), other.at_horizontal_force(h, 0.0).unwrap());
        assert!((a.x - b.x).abs() < 1e-8 && (a.top_vertical - b.top_vertical).abs() < 1e-8 * a.top_tension);
    }
}

#[test]
fn line_yields_at_its_largest_tension() {
    let line =
        Line::new(vec![Segment { weight: 0.0, ..ROPE }], vec![], -300.0, 0.0).unwrap().with_seabed(None).unwrap();
    let line = line.with_laws(vec![Some(StretchLaw::Capped { ea: 8e7, most: 1e6 })]).unwrap();
    let state = line.at_distance(600.0, 0.0).unwrap();
    assert!((state.top_tension / 1e6 - 1.0).abs() < 5e-5, "{}", state.top_tension);
}

#[test]
fn line_solved_for_tension_has_it_and_too_low_tension_is_refused() {
    for (slope, friction) in [(0.0, 0.0), (0.0, 0.5), (0.03, 0.2)] {
        let line = build_mixed_line(slope, friction);
        let state = line.at_tension(9e5, 0.0).unwrap();
        assert!((state.top_tension - 9e5).abs() < 1e-3, "{}", state.top_tension);
        assert!(line.at_tension(1e3, 0.0).is_err());
        let state = line.at_vertical_force(5e5, 0.0).unwrap();
        assert!((state.top_vertical - 5e5).abs() < 1e-3, "{}", state.top_vertical);
    }
    assert!(matches!(build_mixed_line(0.0, 0.0).at_tension(1e3, 0.0), Err(LineError::Weight { .. })));
}

#[test]
fn pendant_longer_than_depth_and_falling_law_are_refused() {
    let buoy = Joint::SpringBuoy { capacity: 1e5, depth: 300.0 };
    let line = Line::new(vec![CHAIN, CHAIN], vec![buoy], -250.0, 0.0).unwrap();
    let error = line.at_distance(900.0, 0.0).unwrap_err();
    assert_eq!(
        line.with_seabed(Some(SeabedModel { elevation: -250.0, slope: 0.0, friction: 0.5 })).unwrap_err(),
        error
    );
    assert!(matches!(error, LineError::Pendant { segment: 1, .. }), "{error}");
    let line = Line::new(vec![CHAIN], vec![], -250.0, 0.0).unwrap();
    let falling = StretchLaw::Polynomial { ea: 1e8, k: [-5e9, 0.0, 0.0], most: 0.05 };
    assert_eq!(line.with_laws(vec![Some(falling)]).unwrap_err(), LineError::StretchLaw(1));
}

#[test]
fn both_stiffnesses_match_end_force_finite_differences() {
    let hung = Line::new(vec![CHAIN, ROPE], vec![Joint::Weight(2e4)], -150.0, 0.0).unwrap().with_seabed(None).unwrap();
    let lines = [
        (build_mixed_line(0.0, 0.0), 1950.0),
        (build_mixed_line(0.0, 0.3), 1970.0),
        (build_mixed_line(0.03, 0.0), 2040.0),
        (build_mixed_line(-0.03, 0.2), 2000.0),
        (hung, 900.0),
    ];
    for (line, x) in lines {
        let middle = line.at_distance(x, -10.0).unwrap();
        for axis in 0..2 {
            let at = |by: f64| {
                let s = line
                    .at_distance(x + if axis == 0 { by } else { 0.0 }, -10.0 + if axis == 1 { by } else { 0.0 })
                    .unwrap();
                [[s.force, s.top_vertical], [s.anchor_horizontal, s.anchor_vertical]]
            };
            let (plus, minus) = (at(1e-4), at(-1e-4));
            for row in 0..2 {
                for (end, matrix) in [middle.stiffness, middle.coupling].into_iter().enumerate() {
                    let want = (plus[end][row] - minus[end][row]) / 2e-4;
                    let scale = middle.stiffness[0][0].abs() + middle.stiffness[1][1].abs();
                    assert!(
                        (matrix[row][axis] - want).abs() < 1e-5 * scale,
                        "{x} {end} {row} {axis}: {matrix:?} {want}"
                    );
                }
            }
        }
    }
}

#[test]
fn warm_started_line_matches_forces_of_cold_start() {
    for line in [build_mixed_line(0.0, 0.0), build_mixed_line(0.0, 0.4), build_mixed_line(0.04, 0.2)] {
        let mut last = line.at_distance(1900.0, -10.0).unwrap();
        for step in 0..300 {
            let t = f64::from(step) * 0.1;
            let (x, z) = (1950.0 + 60.0 * t.sin(), -10.0 + 4.0 * (1.7 * t).cos());
            let (next, anew) = (line.solve_warm_start(x, z, &last).unwrap(), line.at_distance(x, z).unwrap());
            let off = (next.force - anew.force).hypot(next.top_vertical - anew.top_vertical);
            assert!(off <= 1e-8 * anew.top_tension, "{step}: {off} {}", anew.top_tension);
            last = next;
        }
    }
}
