use super::*;
use std::f64::consts::{PI, TAU};
use windlass_base::span::Span;
use windlass_model::{
    Components, Current, Curve, CurveKind, CurveReference, Division, Environment, Filling, Phasing, Stretching, Wind,
};

const GRAVITY: f64 = 9.80665;

fn curve_reference(kind: &str, value: Option<f64>) -> Option<CurveReference> {
    Some(CurveReference { kind: kind.into(), value, span: Span::default() })
}

fn sea(spectrum: &str, height: f64, period: f64) -> Option<windlass_model::SeaDefinition> {
    let positions = [Span::default(); 4];
    Some(windlass_model::SeaDefinition {
        spectrum: spectrum.into(),
        direction: PI,
        height,
        period,
        shape: Vec::new(),
        positions,
    })
}

/// A model whose environment in force is this.
fn model(environment: Environment) -> Model {
    let mut model = Model { environment, ..Model::default() };
    model.defaults.gravity = GRAVITY;
    model.defaults.ramp = 0.0;
    model
}

fn curve(model: &mut Model, name: &str, kind: CurveKind, points: &[(f64, f64)]) {
    let made =
        Curve { name: name.into(), kind, points: points.to_vec(), exponentials: 5, metres: 1.0, span: Span::default() };
    model.curves.insert(name.into(), made);
}

fn build_ambient(model: &Model) -> (Arc<dyn Ambient>, Option<Arc<Sea>>) {
    let sea = Sea::new(model, &model.environment).unwrap().map(Arc::new);
    (ambient(model, sea.as_ref()).unwrap(), sea)
}

fn flow(around: &Arc<dyn Ambient>, time: f64, position: [f64; 3]) -> Flow {
    let mut out = [Flow::still_water(f64::NAN)];
    around.flow(time, &[position.into()], &mut out);
    out[0]
}

#[test]
fn regular_wave_matches_closed_form_with_tide() {
    let env = Environment { sea: sea("REGULAR", 4.0, 10.0), tide: Some(1.5), ..Environment::default() };
    let (around, _) = build_ambient(&model(env));
    let (w, a) = (TAU / 10.0, 2.0);
    let k = w * w / GRAVITY;
    for (x, y, z, t) in [(0.0, 0.0, -3.0, 0.0), (17.0, -40.0, -0.2, 3.3), (-250.0, 9.0, -25.0, 77.0)] {
        let found = flow(&around, t, [x, y, z]);
        // Airy in deep water, from 180 degrees: it travels toward +X
        let (sin, cos) = (k * x - w * t).sin_cos();
        let decay = (k * (z - 1.5)).exp();
        let velocity = Vector3::new(cos, 0.0, sin) * (a * w * decay);
        let acceleration = Vector3::new(sin, 0.0, -cos) * (a * w * w * decay);
        // wave numbers are solved to 1e-12
        let surface = if z < 1.5 - a { 0.0 } else { a * cos };
        assert!((found.surface - 1.5 - surface).abs() < 1e-9, "{x}");
        assert!((found.velocity - velocity).norm() < 1e-9 && (found.acceleration - acceleration).norm() < 1e-9, "{x}");
        // p = rho g a exp(k z) cos beside that of the water up to the mean level
        assert!((found.surface + found.head - 1.5 - a * decay * cos).abs() < 1e-9, "{x}");
    }
}

#[test]
fn kinematics_are_sea_below_surface_and_surface_values_above() {
    let kinds = [Stretching::Linear, Stretching::Wheeler, Stretching::Delta, Stretching::Exponential];
    for (stretching, spectrum, depth) in kinds
        .iter()
        .flat_map(|s| [(*s, "ISSC", None), (*s, "ISSC", Some(40.0))])
        .chain([(Stretching::Linear, "STOKES", Some(40.0))])
    {
        let env = Environment {
            sea: sea(spectrum, 6.0, 10.0),
            depth,
            tide: Some(2.0),
            ramp: Some(30.0),
            stretching: Some(stretching),
            phasing: Some(Phasing::Seeded(3)),
            ..Environment::default()
        };
        let (around, sea) = build_ambient(&model(env));
        let sea = sea.unwrap();
        let time = 21.0;
        let (mut over, mut under) = (0, 0);
        for i in 0..40 {
            let position = Vector3::new(11.0 * f64::from(i), -3.0 * f64::from(i), -38.0 + 1.3 * f64::from(i));
            let found = flow(&around, time, position.into());
            let surface = 2.0 + sea.elevation(position.x, position.y, time);
            // Airy waves leave places below the sum of their amplitudes under the mean level, and there a millionth of each is left out
            let highest: f64 = sea.components.iter().map(|c| c.amplitude).sum();
            let far = stretching == Stretching::Linear && sea.stokes.is_none() && position.z < 2.0 - highest;
            assert!((found.surface - if far { 2.0 } else { surface }).abs() < 1e-12, "{stretching:?} {i}");
            // a micron below the surface, where the place is above it
            let at = Vector3::new(position.x, position.y, position.z.min(surface - 1e-6));
            let want = sea.kinematics(at, time);
            let speeds: f64 = sea.components.iter().map(|c| c.amplitude * c.frequency).sum();
            let near = if position.z > surface {
                1e-5
            } else if far {
                2e-6 * speeds
            } else {
                1e-12
            };
            (over, under) = if position.z > surface { (over + 1, under) } else { (over, under + 1) };
            assert!((found.velocity - want.velocity).norm() < near, "{stretching:?} {i}");
            assert!((found.acceleration - want.acceleration).norm() < near, "{stretching:?} {i}");
        }
        assert!(over > 5 && under > 20, "{over} {under}");
    }
}

#[test]
fn pressure_matches_wave_at_depth_and_is_zero_at_surface() {
    for stretching in [Stretching::Linear, Stretching::Wheeler, Stretching::Delta, Stretching::Exponential] {
        let env = Environment {
            sea: sea("REGULAR", 10.0, 8.0),
            tide: Some(1.0),
            stretching: Some(stretching),
            ..Environment::default()
        };
        let (around, _) = build_ambient(&model(env));
        // a crest and a trough of 5 m at x = y = 0
        for (time, amplitude) in [(0.0, 5.0), (4.0, -5.0)] {
            let head = |depth: f64| {
                let found = flow(&around, time, [0.0, 0.0, 1.0 + amplitude - depth]);
                let deep = stretching == Stretching::Linear && depth > 5.0 + amplitude;
                assert!((found.surface - 1.0 - if deep { 0.0 } else { amplitude }).abs() < 1e-9);
                // over still water up to the crest or trough
                found.surface + found.head - 1.0 - amplitude
            };
            // exp(-k 500) is 2e-14: nothing of the wave is left, and the water weighs as that up to the mean level
            assert!((head(500.0) + amplitude).abs() < 1e-9, "{stretching:?}");
            // at the surface linear theory is off by no more than a share exp(k a) - 1 of the wave, and stretched to the surface by nothing
            let k = (TAU / 8.0).powi(2) / GRAVITY;
            let most = if stretching == Stretching::Wheeler { 1e-9 } else { 5.0 * ((k * 5.0).exp() - 1.0) };
            assert!(head(0.0).abs() <= most, "{stretching:?} {}", head(0.0));
        }
        // above the mean level the water is taken as still up to the crest
        if stretching == Stretching::Linear {
            assert!([0.1, 2.5, 4.9].iter().all(|z| flow(&around, 0.0, [0.0, 0.0, 1.0 + z]).head.abs() < 1e-9));
        }
    }
}

#[test]
fn current_has_profile_history_and_no_waves_in_mean() {
    let env = Environment {
        current: Some(Current::Profiles(vec![("CUR".into(), PI), ("SIDE".into(), -PI / 2.0)])),
        current_history: curve_reference("TURN", None),
        sea: sea("REGULAR", 4.0, 10.0),
        depth: Some(100.0),
        tide: Some(1.0),
        ..Environment::default()
    };
    let mut model = model(env);
    curve(&mut model, "CUR", CurveKind::CurrentProfile, &[(0.0, 2.0), (50.0, 1.0)]);
    curve(&mut model, "SIDE", CurveKind::CurrentProfile, &[(0.0, 0.5), (10.0, 0.5)]);
    curve(&mut model, "TURN", CurveKind::CurrentHistory, &[(0.0, 1.0), (100.0, 3.0)]);
    let (around, sea) = build_ambient(&model);
    let sea = sea.unwrap();
    // 26 m deep at z = -25 with the tide: 2 - 26/50; at 50 s twice that
    let at = Vector3::new(5.0, 6.0, -25.0);
    let mean = Vector3::new(2.0 - 26.0 / 50.0, 0.5, 0.0);
    let mut out = [Flow::still_water(0.0)];
    around.mean(&[at], &mut out);
    assert!((out[0].velocity - mean).norm() < 1e-12 && out[0].acceleration.norm() == 0.0);
    assert_eq!(out[0].surface, 1.0);
    let found = flow(&around, 50.0, at.into());
    // waves far down are within 2e-9 of what they are at the mean level, here of 2 m 2 pi / 10 s
    let waves = sea.kinematics(at, 50.0).velocity;
    assert!((found.velocity - 2.0 * mean - waves).norm() < 2e-9 * 2.0 * TAU / 10.0);
    // what lies presses itself in a little: below the bottom it is that at the bottom
    around.mean(&[Vector3::new(0.0, 0.0, -100.1)], &mut out);
    assert_eq!(out[0].velocity, Vector3::new(1.0, 0.5, 0.0));
}

#[test]
fn wind_has_profile_and_history() {
    let env = Environment {
        wind: Some(Wind { speed: 0.0, direction: PI / 2.0 }),
        wind_history: curve_reference("BLOW", None),
        tide: Some(1.0),
        ..Environment::default()
    };
    let mut model = model(env);
    curve(&mut model, "BLOW", CurveKind::WindHistory, &[(0.0, 0.0), (60.0, 30.0)]);
    let (around, _) = build_ambient(&model);
    // a power law of exponent 1/7 over 10 m above the water, from +Y
    let found = flow(&around, 40.0, [0.0, 0.0, 31.0]);
    assert!((found.wind - Vector3::new(0.0, -20.0 * 3f64.powf(1.0 / 7.0), 0.0)).norm() < 1e-9, "{}", found.wind);
    let mut out = [Flow::still_water(0.0)];
    around.mean(&[Vector3::new(0.0, 0.0, 31.0)], &mut out);
    assert_eq!(out[0].wind.norm(), 0.0);
    model.environment.wind = Some(Wind { speed: 25.0, direction: PI / 2.0 });
    model.environment.wind_history = None;
    let (around, _) = build_ambient(&model);
    around.mean(&[Vector3::new(0.0, 0.0, 11.0)], &mut out);
    assert!((out[0].wind - Vector3::new(0.0, -25.0, 0.0)).norm() < 1e-9);
    // gusts are the same at all heights
    model.environment.gusts = curve_reference("NPD", None);
    let (around, _) = build_ambient(&model);
    let gust = |z: f64| flow(&around, 12.0, [0.0, 0.0, z]).wind.norm();
    let still = |z: f64| 25.0 * (z / 10.0f64).powf(1.0 / 7.0);
    assert!((gust(11.0) - 25.0).abs() > 1e-3);
    assert!((gust(51.0) - still(50.0) - (gust(11.0) - 25.0)).abs() < 1e-9);
}

#[test]
fn growth_is_half_of_diameter_increase() {
    let mut model = model(Environment { growth: curve_reference("GROW", None), ..Environment::default() });
    curve(&mut model, "GROW", CurveKind::MarineGrowth, &[(-40.0, 0.1), (0.0, 0.2)]);
    let (around, _) = build_ambient(&model);
    assert_eq!(around.growth(0.0), (0.1, super::super::growth::DEFAULT_DENSITY));
    assert!((around.growth(-20.0).0 - 0.075).abs() < 1e-15);
    assert_eq!(around.growth(0.1).0, 0.0);
    model.environment.growth = curve_reference("GROW", Some(1100.0));
    assert_eq!(build_ambient(&model).0.growth(0.0).1, 1100.0);
    model.environment.growth = None;
    assert_eq!(build_ambient(&model).0.growth(0.0), (0.0, 0.0));
}

#[test]
fn seabed_is_flat_or_gridded_and_current_continues_below_flat_one() {
    let env = Environment {
        depth: Some(50.0),
        current: Some(Current::Uniform { velocity: 1.0, direction: PI }),
        ..Environment::default()
    };
    let mut model = model(env);
    let deep = Vector3::new(50.0, 0.0, -54.0);
    let (around, _) = build_ambient(&model);
    assert_eq!(around.bottom(3.0, 4.0), Some((-50.0, [0.0, 0.0])));
    assert!((flow(&around, 0.0, deep.into()).velocity.x - 1.0).abs() < 1e-15);
    let heights = [-50.0, -60.0, -50.0, -60.0];
    let grid = Bathymetry::new("SLOPE", vec![0.0, 100.0], vec![0.0, 100.0], &heights, Span::default()).unwrap();
    model.bathymetries.insert("SLOPE".into(), Arc::new(grid));
    model.environment.bathymetry = curve_reference("slope", None);
    let (around, _) = build_ambient(&model);
    let (z, [by_x, by_y]) = around.bottom(50.0, 70.0).unwrap();
    assert!((z + 55.0).abs() < 1e-12 && (by_x + 0.1).abs() < 1e-15 && by_y.abs() < 1e-15);
    assert!((flow(&around, 0.0, deep.into()).velocity.x - 1.0).abs() < 1e-15);
    model.environment.bathymetry = curve_reference("GONE", None);
    assert!(ambient(&model, None).unwrap_err().to_string().contains("no bathymetry GONE"));
    model.environment = Environment::default();
    model.defaults.depth = None;
    assert_eq!(build_ambient(&model).0.bottom(0.0, 0.0), None);
}

#[test]
fn contents_match_set_named_by_environment() {
    let mut model = model(Environment { filling: curve_reference("HOT", None), ..Environment::default() });
    assert!(ambient(&model, None).unwrap_err().to_string().contains("no set of T_PRESSURE data HOT"));
    let contents = Contents { warmer: 60.0, pressure: 1.5e7, at: 12.0, density: 800.0 };
    model.fillings.insert("HOT".into(), Filling { name: "Hot".into(), contents, span: Span::default() });
    assert_eq!(build_ambient(&model).0.contents(), Some(contents));
    model.environment.filling = None;
    assert_eq!(build_ambient(&model).0.contents(), None);
}

#[test]
fn many_points_match_single_point_evaluation() {
    let env = Environment {
        sea: sea("ISSC", 6.0, 10.0),
        components: Some(Components {
            number: 100,
            division: Division::EqualEnergy,
            limits: None,
            span: Span::default(),
        }),
        wind: Some(Wind { speed: 20.0, direction: 0.3 }),
        current: Some(Current::Uniform { velocity: 1.0, direction: PI }),
        ..Environment::default()
    };
    let (around, _) = build_ambient(&model(env));
    let positions: Vec<Vector3<f64>> =
        (0..200).map(|i| Vector3::new(3.0 * f64::from(i), f64::from(i), -190.0 + f64::from(i))).collect();
    let mut out = vec![Flow::still_water(0.0); positions.len()];
    around.flow(123.4, &positions, &mut out);
    for (position, found) in positions.iter().zip(&out) {
        assert_eq!(*found, flow(&around, 123.4, (*position).into()));
    }
    if std::env::var_os("AMBIENT_SPEED").is_some() {
        let begun = std::time::Instant::now();
        for i in 0..500 {
            around.flow(f64::from(i), &positions, &mut out);
        }
        let each = begun.elapsed().as_secs_f64() / (500.0 * positions.len() as f64);
        std::io::Write::write_fmt(&mut std::io::stderr(), format_args!("{:.0} ns a place\n", each * 1e9)).unwrap();
    }
}
