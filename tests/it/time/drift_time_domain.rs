//! #DRIFT in the time domain: against its mean at rest, which is tested beside closed forms in `steady_loads`, and the slow surge
//! of a moored body against the closed form of a narrow response to white noise.

use crate::common;
use crate::common::body_load::begin_step;
use crate::common::run as runs;

use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::sea::Sea;
use windlass_hydro::{BodyLoad, BodyStep, Category, Floating};
use windlass_model::Model;

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
    Arc::new(Sea::new(model, &model.environment).unwrap().unwrap())
}

fn drifts(floating: Floating) -> Vec<Box<dyn BodyLoad>> {
    floating.loads.into_iter().filter(|l| l.category() == Category::WaveDrift).collect()
}

fn under_way(model: &Model) -> Vec<Box<dyn BodyLoad>> {
    drifts(Floating::under_way(model, &model.bodies["B"], Some(&sea(model))).unwrap())
}

/// The force at a time under way.
fn force_at(loads: &[Box<dyn BodyLoad>], time: f64, pose: &Pose) -> Six {
    let velocity = Six::zeros();
    let now = BodyStep { time, dt: 0.1, pose, velocity: &velocity };
    let one = |load: &dyn BodyLoad| {
        let state = begin_step(load, &now);
        load.dynamic_load(&now, &state).unwrap().load.wrench
    };
    loads.iter().map(|load| one(load.as_ref())).sum()
}

fn at_rest(model: &Model, pose: &Pose) -> Six {
    let loads = drifts(Floating::at_rest(model, &model.bodies["B"]).unwrap());
    loads.iter().map(|load| load.mean_load(pose).unwrap().wrench).sum()
}

fn yawed_pose(x: f64, y: f64, yaw: f64) -> Pose {
    Pose::from_place(&Place::new([x, y, 0.0, 0.0, 0.0, f64::to_radians(yaw)]))
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
fn regular_wave_drift_equals_static_mean_at_all_times() {
    for part in ["", "&DESCRIBE PART P -MOVE 3 1 2 0 0 30\n"] {
        for from in [180, 135, 20] {
            let model =
                body(&format!("{part}*P 12 3 0\n{}", table("*P")), &format!("&ENV -SEA REGULAR {from} 3 9 -RAMP 50"));
            let loads = under_way(&model);
            for pose in [Pose::default(), yawed_pose(40.0, -70.0, 77.0)] {
                let want = at_rest(&model, &pose);
                for time in [50.0, 61.7, 300.0] {
                    let got = force_at(&loads, time, &pose);
                    // straight between headings of 5 degrees, where the table is cubic: h^2/8 = 1e-3 of its second derivative
                    assert!((got - want).amax() <= 5e-3 * want.amax(), "{from} {got} {want}");
                }
                // half the ramp: a quarter of the square of the amplitude
                assert!((force_at(&loads, 25.0, &pose) * 4.0 - want).amax() <= 5e-3 * want.amax());
            }
        }
    }
}

#[test]
fn slow_drift_in_sea_has_static_mean() {
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
    let series: Vec<f64> = (0..count).map(|n| force_at(&loads, f64::from(n) * step, &Pose::default())[0]).collect();
    let mean = series.iter().sum::<f64>() / f64::from(count);
    assert!((mean - exact).abs() <= error, "{mean} {exact} {error}");
    // and it is slow drift: it varies about its mean, by no less than a half of it in a sea of one hump
    let variance = series.iter().map(|f| (f - mean).powi(2)).sum::<f64>() / f64::from(count);
    assert!(variance.sqrt() > 0.5 * mean, "{variance} {mean}");
}

#[test]
fn drift_from_both_records_and_database_is_refused() {
    let mut model = body(&format!("*P 0 0 0\n{}", table("*P")), "&ENV -SEA REGULAR 180 3 9");
    let drift = windlass_model::DriftTable {
        frequencies: vec![0.5],
        headings: vec![0.0],
        values: vec![vec![[1.0, 0.0, 0.0, 0.0, 0.0, 0.0]]],
        method: None,
    };
    let data = windlass_model::Database { drift: Some(drift), ..Default::default() };
    let span = model.loads[0].span;
    let mut attached = windlass_model::AttachedDatabase {
        data: Arc::new(data),
        at: [0.0; 3],
        memory: None,
        drift: windlass_model::DriftMethod::Newman,
        drift_damping: None,
        hydrostatics: false,
        span,
    };
    model.bodies["B"].database = Some(attached.clone());
    let error = Floating::at_rest(&model, &model.bodies["B"]).unwrap_err();
    assert!(error.to_string().contains("#DRIFT") && error.span == Some(span), "{error:?}");
    assert!(Floating::under_way(&model, &model.bodies["B"], Some(&sea(&model))).is_err());
    attached.drift = windlass_model::DriftMethod::None;
    model.bodies["B"].database = Some(attached);
    assert!(Floating::at_rest(&model, &model.bodies["B"]).is_ok());
}

/// The spectrum of ISSC (m2 s/rad) of a height (m) and mean period (s): both moments in closed form.
fn issc(w: f64, height: f64, mean_period: f64) -> f64 {
    // Gamma(3/4), of m1 = m0 B^(1/4) Gamma(3/4)
    let b = (TAU / mean_period / 1.225_416_702_465_178).powi(4);
    4.0 * (height * height / 16.0) * b * w.powi(-5) * (-b / w.powi(4)).exp()
}

/// The spectrum of slow drift (N2 s/rad), 8 int S(w) S(w + mu) D(w + mu/2)^2 dw ([PINKSTER-1980 eq. 3.36]
/// with D of the middle frequency), of D = `slope` w.
fn drift_spectrum(mu: f64, slope: f64, height: f64, mean_period: f64) -> f64 {
    let step = 2e-3;
    let at = |n: u32| {
        let w = 0.1 + step * f64::from(n);
        let drift = slope * (w + 0.5 * mu);
        8.0 * issc(w, height, mean_period) * issc(w + mu, height, mean_period) * drift * drift
    };
    (0..2000).map(at).sum::<f64>() * step
}

#[test]
fn slow_surge_on_spring_matches_narrow_response_to_white_noise() {
    // 10 t on 25 N/m: w0 = 0.05 rad/s, 5 % of critical damping
    let (mass, w0, ratio) = (1e4, 0.05, 0.05);
    let (stiffness, damping) = (mass * w0 * w0, 2.0 * ratio * mass * w0);
    let (height, mean_period, slope) = (4.0, 9.0, 10.0);
    let rows = format!("{} 100 0 0 0 0 0 {} 1 0 0 0 0 0", TAU / 10.0, TAU / 0.1);
    let weight = mass * 9.80665;
    let records = format!(
        "MEDIT\n*G 0 0 0\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P {weight} 1 1 1\n#DAMP *P {damping}\n\
         #DRIFT *P 180 {rows}\n#DRIFT *P 0 {}\n~S GSPR BOTH X {stiffness} 1E9 -LEN 0\nCONNECTOR K ~S *P *G\nEND\n\
         &ENV -SEA ISSC 180 {height} {mean_period} -RAMP 100",
        rows.replace(" 100", " -100")
    );
    let model = runs::model(&records);
    // the transient has died away to exp(-0.05 x 0.05 x 4000) = 5e-5
    let (long, transient) = (200_000.0, 4000.0);
    let made = runs::run(&model, runs::settings(long, 2.0), vec![]);
    let at = made.history.layout.body(0);
    let surge: Vec<f64> = made.history.rows().filter(|r| r[0] > transient).map(|r| r[at]).collect();
    let count = surge.len() as f64;
    let mean = surge.iter().sum::<f64>() / count;
    let deviation = (surge.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / count).sqrt();
    // the mean: 2 int S D dw / k = slope Hs^2/8 2 pi/T1 / k
    let offset = slope * height * height / 8.0 * TAU / mean_period / stiffness;
    assert!((mean / offset - 1.0).abs() < 0.02, "{mean} {offset}");
    let white = (PI * drift_spectrum(w0, slope, height, mean_period) / (2.0 * damping * stiffness)).sqrt();
    // the same without taking the spectrum as constant over the peak
    let step = w0 / 200.0;
    let response = |n: u32| {
        let mu = (f64::from(n) + 0.5) * step;
        let s = drift_spectrum(mu, slope, height, mean_period);
        s / ((stiffness - mass * mu * mu).powi(2) + (damping * mu).powi(2)) * step
    };
    let whole = (0..1000).map(response).sum::<f64>().sqrt();
    // of a record of length T the deviation is sure to 1/(2 sqrt(ratio w0 T)), here 2.3 %: three times that
    let sure = 0.5 / (ratio * w0 * (long - transient)).sqrt();
    assert!((deviation / whole - 1.0).abs() < 3.0 * sure, "{deviation} {whole}");
    assert!((deviation / white - 1.0).abs() < 3.0 * sure + 0.02, "{deviation} {white}");
}

#[test]
fn slow_mode_with_little_damping_is_named_with_period_and_ratio() {
    // 10 t on 25 N/m: 2 pi/0.05 = 125.66 s; 2 zeta m w0 = 20 N s/m for zeta = 2 %, 40 for 4 %
    let said = |damping: f64, sea: &str| {
        let weight = 1e4 * 9.80665;
        common::run_script(&format!(
            "&DIMEN -DIMEN METERS N\n&DEFAULT -G 9.80665\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P {weight} 1 1 1\n#DAMP *P {damping}\n\
             #DRIFT *P 180 5 100 0 0 0 0 0 20 10 0 0 0 0 0\n#DRIFT *P 0 5 -100 0 0 0 0 0 20 -10 0 0 0 0 0\n\
             ~S GSPR BOTH X 25 1E9 -LEN 0\nCONNECTOR K ~S *P *G\nEND\n&ENV {sea} -RAMP 10 -TIME 20 0.5\nTDOM\n"
        ))
        .1
    };
    let named = |list: &[String], text: &str| list.iter().any(|line| line.contains(text));
    let light = said(20.0, "-SEA ISSC 180 2 9");
    assert!(named(&light, "the slow mode B X with a period of 125.7 s has 2.00 % of critical damping"), "{light:?}");
    assert!(!named(&said(40.0, "-SEA ISSC 180 2 9"), "slow mode"));
}

/// The wave number of a period (s) by halving of w2 = g k tanh(k h) (1/m).
fn number(period: f64, depth: f64) -> f64 {
    let (mut low, mut high) = (1e-6, 1.0);
    for _ in 0..100 {
        let k = 0.5 * (low + high);
        if 9.80665 * k * f64::tanh(k * depth) > (TAU / period).powi(2) { high = k } else { low = k }
    }
    low
}

#[test]
fn newman_in_shallow_water_is_warned_of_by_mean_kh() {
    // two waves of equal energy, of 10 s and 12 s
    let said = |depth: f64| {
        let weight = 1e4 * 9.80665;
        common::run_script(&format!(
            "&DIMEN -DIMEN METERS N\n&DEFAULT -G 9.80665\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P {weight} 1 1 1\n#DAMP *P 400\n\
             #DRIFT *P 180 5 100 0 0 0 0 0 20 10 0 0 0 0 0\n#DRIFT *P 0 5 -100 0 0 0 0 0 20 -10 0 0 0 0 0\n\
             ~S GSPR BOTH X 25 1E9 -LEN 0\nCONNECTOR K ~S *P *G\nEND\n\
             &ENV -SEA REGULAR 180 1 10 -A_SEA REGULAR 180 1 12 -DEPTH {depth} -RAMP 10 -TIME 20 0.5\nTDOM\n"
        ))
        .1
    };
    let shallow = said(12.0);
    let mean = 0.5 * (number(10.0, 12.0) + number(12.0, 12.0)) * 12.0;
    assert!(mean < 1.0);
    let text = format!("k h is {mean:.2}");
    assert!(shallow.iter().any(|line| line.contains(&text)), "{text}: {shallow:?}");
    assert!(0.5 * (number(10.0, 40.0) + number(12.0, 40.0)) * 40.0 > 1.0);
    assert!(!said(40.0).iter().any(|line| line.contains("k h")));
}

#[test]
fn newman_in_shallow_water_is_warned_of_by_sresponse() {
    // a spectrum of equal densities from 0.5 to 0.6 rad/s: the mean of k h is that over the frequencies
    let said = |depth: f64| {
        let (text, list) = common::run_script(&format!(
            "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -G 9.80665\n&ENV -DEPTH {depth}\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY TANKER -IGNORE Y Z RX RY RZ\n*CG 0 0 0\n\
             #WEIGHT *CG 1600000 15 65 65\n#AMASS *CG 80000\n#DAMP *CG 1300\nDATABASE TANKER -WAMIT {}/tests/data/tanker/tanker\n\
             ~S GSPR BOTH X 1000 1E9 -LEN 0\nCONNECTOR K ~S *CG *G\nEND\n&DATA CURVES\nF_SPECTRUM BOX 0.5 1 0.6 1\nEND\n\
             &ENV HEAD -DEPTH {depth} -SEA BOX 180 2 {}\nFREQ_RESPONSE\nSRESPONSE HEAD\nSTATISTICS MOTION TANKER\nREPORT\nEND\nEND\n",
            env!("CARGO_MANIFEST_DIR"),
            TAU / 0.5
        ));
        format!("{text}\n{}", list.join("\n"))
    };
    let mean = |depth: f64| {
        let of = |i: i32| number(TAU / (0.5 + 0.001 * (f64::from(i) + 0.5)), depth);
        (0..100).map(of).sum::<f64>() / 100.0 * depth
    };
    assert!(mean(15.0) < 1.0 && mean(60.0) > 1.0);
    let shallow = said(15.0);
    let text = format!("k h is {:.2}", mean(15.0));
    assert!(shallow.contains(&text), "{text}: {shallow}");
    let deep = said(60.0);
    assert!(deep.contains("slow drift by Newman's approximation") && !deep.contains("k h is"), "{deep}");
}
