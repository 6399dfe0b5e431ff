//! #DRIFT in the time domain: against its mean at rest, which is tested beside closed forms in `steady_loads`.

#![allow(clippy::unwrap_used)]

mod common;

use std::f64::consts::TAU;
use std::sync::Arc;
use windlass::hydro::sea::Sea;
use windlass::hydro::{BodyLoad, Category, Floating, Underway};
use windlass::model::{Model, Place, Pose, Six};

/// A body with records on points of it, in an environment; metres and newtons.
fn body(records: &str, environment: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    let text = format!("&DIMEN -DIMEN METERS N\nMEDIT\n&DESCRIBE BODY B\n{records}\nEND\n{environment}\n");
    session.open("records", text);
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

fn sea(model: &Model) -> Arc<Sea> {
    Arc::new(Sea::of(model, &model.environment).unwrap().unwrap())
}

fn drifts(floating: Floating) -> Vec<Box<dyn BodyLoad>> {
    floating.loads.into_iter().filter(|l| l.category() == Category::WaveDrift).collect()
}

fn under_way(model: &Model) -> Vec<Box<dyn BodyLoad>> {
    drifts(Floating::under_way(model, &model.bodies["B"], Some(&sea(model))).unwrap())
}

/// The force at a time under way.
fn at(loads: &[Box<dyn BodyLoad>], time: f64, pose: &Pose) -> Six {
    let velocity = Six::zeros();
    let now = Underway { time, dt: 0.1, pose, velocity: &velocity };
    let one = |load: &Box<dyn BodyLoad>| {
        let mut state = vec![0.0; load.states()];
        load.start(&mut state);
        load.begin(&now, &mut state).unwrap();
        load.moving(&now, &state).unwrap().load.wrench
    };
    loads.iter().map(one).sum()
}

fn at_rest(model: &Model, pose: &Pose) -> Six {
    let loads = drifts(Floating::of(model, &model.bodies["B"]).unwrap());
    loads.iter().map(|load| load.load(pose).unwrap().wrench).sum()
}

fn turned(x: f64, y: f64, yaw: f64) -> Pose {
    Pose::of(&Place::new([x, y, 0.0, 0.0, 0.0, f64::to_radians(yaw)]))
}

/// Surge, sway and yaw by heading, cubic between headings of 45 degrees; of half a body.
fn table(point: &str) -> String {
    let rows = [(0, -50.0, 0.0), (45, -30.0, -20.0), (90, 2.0, -60.0), (135, 25.0, -25.0), (180, 40.0, 0.0)];
    let record = |(heading, x, y): (i32, f64, f64)| {
        let row = |period: f64, share: f64| format!("{period} {} {} 0 0 0 {}", x * share, y * share, 7.0 * y * share);
        format!("#DRIFT {point} {heading} {} {} {} -SYMM\n", row(5.0, 1.0), row(10.0, 0.4), row(20.0, 0.02))
    };
    rows.map(record).concat()
}

#[test]
fn in_a_regular_wave_drift_is_the_mean_at_rest_at_all_times() {
    for part in ["", "&DESCRIBE PART P -MOVE 3 1 2 0 0 30\n"] {
        for from in [180, 135, 20] {
            let model =
                body(&format!("{part}*P 12 3 0\n{}", table("*P")), &format!("&ENV -SEA REGULAR {from} 3 9 -RAMP 50"));
            let loads = under_way(&model);
            for pose in [Pose::default(), turned(40.0, -70.0, 77.0)] {
                let want = at_rest(&model, &pose);
                for time in [50.0, 61.7, 300.0] {
                    let got = at(&loads, time, &pose);
                    // straight between headings of 5 degrees, where the table is cubic: h^2/8 = 1e-3 of its second derivative
                    assert!((got - want).amax() <= 5e-3 * want.amax(), "{from} {got} {want}");
                }
                // half the ramp: a quarter of the square of the amplitude
                assert!((at(&loads, 25.0, &pose) * 4.0 - want).amax() <= 5e-3 * want.amax());
            }
        }
    }
}

#[test]
fn slow_drift_in_a_sea_has_the_mean_of_statics() {
    // D = 10 w from 0.1 to 10 rad/s: the mean 2 k m1 = k Hs^2/8 2 pi/T1 needs no more of the components than their centroids
    let rows = format!("{} 100 0 0 0 0 0 {} 1 0 0 0 0 0", TAU / 10.0, TAU / 0.1);
    let records = format!("*P 0 0 0\n#DRIFT *P 180 {rows}\n#DRIFT *P 0 {}", rows.replace(" 100", " -100"));
    let model = body(&records, "&ENV -SEA ISSC 180 4 9");
    let (loads, waves) = (under_way(&model), sea(&model));
    let exact: f64 = waves.components.iter().map(|c| c.amplitude * c.amplitude * 10.0 * c.frequency).sum();
    // the tails that neither has: 1e-3 of the first moment
    assert!((exact - 2.0 * 10.0 * TAU / 9.0).abs() < 5e-3 * exact, "{exact}");
    let statics = at_rest(&model, &Pose::default())[0];
    assert!((exact - statics).abs() < 5e-3 * exact, "{exact} {statics}");
    // N instants h apart leave of a pair at most 1/(N sin(dw h/2)) (the sum of a geometric series)
    let (count, step) = (50_000, 1.0);
    let mut error = 0.0;
    for (m, a) in waves.components.iter().enumerate() {
        for b in &waves.components[m + 1..] {
            let left = 1.0 / (f64::from(count) * (0.5 * (a.frequency - b.frequency) * step).sin().abs());
            error += a.amplitude * b.amplitude * 10.0 * (a.frequency + b.frequency) * left.min(1.0);
        }
    }
    assert!(error < 0.2 * exact, "{error} {exact}");
    let series: Vec<f64> = (0..count).map(|n| at(&loads, f64::from(n) * step, &Pose::default())[0]).collect();
    let mean = series.iter().sum::<f64>() / f64::from(count);
    assert!((mean - exact).abs() <= error, "{mean} {exact} {error}");
    // and it is slow drift: it varies about its mean, by no less than a half of it in a sea of one hump
    let variance = series.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / f64::from(count);
    assert!(variance.sqrt() > 0.5 * mean, "{variance} {mean}");
}

#[test]
fn drift_of_records_and_of_a_database_on_one_body_is_refused() {
    let mut model = body(&format!("*P 0 0 0\n{}", table("*P")), "&ENV -SEA REGULAR 180 3 9");
    let drift = windlass::model::DriftTable {
        frequencies: vec![0.5],
        headings: vec![0.0],
        values: vec![vec![[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]]],
    };
    let data = windlass::model::Database { drift: Some(drift), ..Default::default() };
    let span = model.loads[0].span;
    let mut attached = windlass::model::AttachedDatabase {
        data: Arc::new(data),
        at: [0.0; 3],
        memory: None,
        drift: windlass::model::DriftMethod::Newman,
        hydrostatics: false,
        span,
    };
    model.bodies["B"].database = Some(attached.clone());
    let error = Floating::of(&model, &model.bodies["B"]).unwrap_err();
    assert!(error.message.contains("#DRIFT") && error.span == Some(span), "{error:?}");
    assert!(Floating::under_way(&model, &model.bodies["B"], Some(&sea(&model))).is_err());
    attached.drift = windlass::model::DriftMethod::None;
    model.bodies["B"].database = Some(attached);
    assert!(Floating::of(&model, &model.bodies["B"]).is_ok());
}
