//! The frequency domain against closed forms, published values and runs in time.

use crate::common;

use nalgebra::{Complex, Matrix6};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass::session::Session;
use windlass_base::span::Span;
use windlass_hydro::database::DatabaseLookup;
use windlass_hydro::database::{Database, DriftTable};
use windlass_model::{AttachedDatabase, DriftMethod, Model};
use windlass_solve::frequency::{
    Derivative, ExtremeKind, LinearQuantity, LinearSystem, Operators, ResponseOptions, ResponseStatistics, Trains,
    natural, respond, sea_response,
};

const G: f64 = 9.80665;

fn run(session: &mut Session, records: &str) {
    let errors = session.errors;
    session.open("test", records.to_string());
    session.run();
    assert_eq!(session.errors, errors, "{:?}", session.reports);
}

/// A body of 1000 t that heaves, and surges, on springs of 800 and 300 kN/m; `more` are further records of MEDIT.
fn model(more: &str, env: &str) -> Model {
    let (mut session, _, _folder) = common::session();
    run(
        &mut session,
        &format!(
            "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 30 -20 0\n&DESCRIBE BODY BUOY -IGNORE Y RX RY RZ\n*C 0 0 0\n\
             #WEIGHT *C {} 1 1 1\n#HYDROSTATIC *C 0 0 0 -BUOYANCY {} -ZCGE 0\n\
             ~Z GSPR BOTH Z 800 1000 -LEN 0\nCONNECTOR KZ ~Z *C *G\n~X GSPR BOTH X 300 1000 -LEN 0\nCONNECTOR KX ~X *C *G\n{more}END\n\
             &INSTATE -LOCATE BUOY 30 -20 0\n{env}",
            1000.0 * G,
            1000.0 * G
        ),
    );
    session.job.model.clone()
}

const ADDED: f64 = 4e5;
const RADIATED: f64 = 6e4;

/// A database with the same values at all frequencies: heave and surge forces of 7e5 N/m lagging by 40 degrees, drift of 2e4 N/m2 in surge.
fn attach(model: &mut Model, drift: DriftMethod) {
    let frequencies: Vec<f64> = (1..=60).map(|i| 0.05 * f64::from(i)).collect();
    let count = frequencies.len();
    let mut six = [Complex::new(0.0, 0.0); 6];
    (six[0], six[2]) = (Complex::from_polar(7e5, 40f64.to_radians()), Complex::from_polar(7e5, 40f64.to_radians()));
    let headings: Vec<f64> = (0..8).map(|i| f64::from(i) * PI / 4.0).collect();
    let added = Matrix6::from_diagonal_element(ADDED);
    let mut mean = [0.0; 6];
    mean[0] = 2e4;
    let data = Database {
        source: "constants".into(),
        added_mass: vec![added; count],
        damping: vec![Matrix6::from_diagonal_element(RADIATED); count],
        infinite: Some(added),
        excitation: vec![vec![six; count]; headings.len()],
        drift: Some(DriftTable {
            frequencies: frequencies.clone(),
            headings: headings.clone(),
            values: vec![vec![mean; count]; headings.len()],
            method: None,
        }),
        frequencies,
        headings,
        density: 1025.0,
        gravity: G,
        ..Database::default()
    };
    let body = model.bodies.get_mut("BUOY").unwrap();
    body.database = Some(AttachedDatabase {
        data: Arc::new(data),
        at: [0.0; 3],
        memory: None,
        drift,
        drift_damping: None,
        hydrostatics: false,
        span: Span::default(),
    });
}

fn oscillator(force: Complex<f64>, stiffness: f64, damping: f64, w: f64) -> Complex<f64> {
    force / Complex::new(stiffness - w * w * (1e6 + ADDED), -w * damping)
}

#[test]
fn oscillator_amplitude_and_phase_match_closed_form() {
    let mut model = model("#DAMP *C 50 0 90 0 0 0\n", "");
    attach(&mut model, DriftMethod::None);
    let linear = LinearSystem::new(&model).unwrap();
    // waves from 150 degrees travel toward -30; the body stands at (30, -20)
    let (from, w) = (150f64.to_radians(), 0.7);
    let found = Operators::new(&linear, &[w, 0.4], &[from]).unwrap();
    let motions = found.operators().next().unwrap().motions;
    let lag = w * w / G * (30.0 * (from + PI).cos() - 20.0 * (from + PI).sin());
    let force = Complex::from_polar(7e5, 40f64.to_radians() + lag);
    for (dof, stiffness, damping) in [(0, 3e5, 5e4 + RADIATED), (2, 8e5, 9e4 + RADIATED)] {
        let want = oscillator(force, stiffness, damping, w);
        assert!((motions[dof] - want).norm() < 1e-9 * want.norm(), "{dof} {} {want}", motions[dof]);
    }
    // the acceleration of a point of an unturned body is that of its origin
    let [_, _, z] = LinearQuantity::point(&linear, 0, nalgebra::Vector3::new(3.0, 4.0, 5.0));
    let ratio = z.amplitude(motions, w, Derivative::Acceleration) / motions[2];
    assert!((ratio + w * w).norm() < 1e-12, "{ratio}");
}

/// Sailing toward -x: waves that travel toward a direction meet the body at `w - k V cos b` with V along -x.
#[test]
fn sailing_oscillator_moves_at_encounter_frequency() {
    let sea = model("", "&ENV -SEA REGULAR 180 2 10.4719755119659774\n").environment;
    let mut model = model("#DAMP *C 50 0 90 0 0 0\n", "");
    attach(&mut model, DriftMethod::None);
    let mut linear = LinearSystem::new(&model).unwrap();
    let (speed, w) = (6.0, 0.6);
    linear.set_speed(speed);
    let k = w * w / G;
    // head waves come from 180 degrees, following ones from 0; fast ones are overtaken
    for (from, v) in [(PI, speed), (0.0, speed), (0.0, 25.0), (PI / 2.0, speed)] {
        let mut linear = LinearSystem::new(&model).unwrap();
        linear.set_speed(v);
        let met = w - k * v * from.cos();
        let found = Operators::new(&linear, &[w], &[from]).unwrap();
        let own = found.operators().next().unwrap();
        assert!((own.encounter - met).abs() < 1e-9, "{} {met}", own.encounter);
        let lag = k * (30.0 * (from + PI).cos() - 20.0 * (from + PI).sin());
        let force = Complex::from_polar(7e5, 40f64.to_radians() + lag);
        let want = oscillator(force, 8e5, 9e4 + RADIATED, met);
        assert!((own.motions[2] - want).norm() < 1e-8 * want.norm(), "{from} {v} {} {want}", own.motions[2]);
        let [_, _, z] = LinearQuantity::point(&linear, 0, nalgebra::Vector3::zeros());
        let ratio = z.amplitude(own.motions, own.encounter, Derivative::Velocity) / own.motions[2];
        assert!((ratio - Complex::new(0.0, -met)).norm() < 1e-9, "{ratio}");
    }
    // a regular head sea: the variance is half the square of the amplitude, the period that of encounter
    let trains = Trains::new(&model, &sea).unwrap().unwrap();
    let made = sea_response(&linear, &trains, &ResponseOptions::default()).unwrap();
    let [_, _, z] = LinearQuantity::point(&linear, 0, nalgebra::Vector3::zeros());
    let found = ResponseStatistics::new(&made, &z, Derivative::Place);
    let met = w + k * speed;
    let want = oscillator(Complex::new(7e5, 0.0), 8e5, 9e4 + RADIATED, met).norm() / 2f64.sqrt();
    // the period of the sea is 2 pi / 0.6 to sixteen figures
    assert!((found.deviation / want - 1.0).abs() < 1e-8, "{} {want}", found.deviation);
    assert!((found.period.unwrap() * met / TAU - 1.0).abs() < 1e-8, "{found:?}");
    // waves that keep pace
    linear.set_speed(G / w);
    let wrong = Operators::new(&linear, &[w], &[0.0]).unwrap_err();
    assert!(wrong.error.to_string().contains("keep pace"), "{wrong:?}");
}

/// Turning by a small angle about y and sinking, by hand: a point at height h moves h times the angle along x.
#[test]
fn cargo_force_and_relative_motion_of_pitching_body() {
    let mut model = model("", "");
    attach(&mut model, DriftMethod::None);
    let linear = LinearSystem::new(&model).unwrap();
    let (w, pitch, heave, height, ahead) = (0.7, 0.01, 0.3, 12.0, 5.0);
    let mut motions = nalgebra::DVector::from_element(6, Complex::new(0.0, 0.0));
    (motions[2], motions[4]) = (Complex::new(heave, 0.0), Complex::new(pitch, 0.0));
    let at = nalgebra::Vector3::new(ahead, 0.0, height);
    let (weight, ky) = (3e5, 4.0);
    let mass = weight / G;
    let force = LinearQuantity::cargo_force(&linear, 0, at, weight, [2.0, ky, 3.0]);
    let of = |i: usize| force[i].amplitude(&motions, w, Derivative::Place).re;
    let want = [
        mass * w * w * height * pitch + weight * pitch,
        0.0,
        mass * w * w * (heave - ahead * pitch),
        0.0,
        mass * ky * ky * w * w * pitch,
        0.0,
    ];
    for (i, want) in want.into_iter().enumerate() {
        assert!((of(i) - want).abs() < 1e-9 * weight, "{i}: {} {want}", of(i));
    }
    assert!((force[2].mean + weight).abs() < 1e-9 * weight && force[0].mean.abs() < 1e-9);
    let [x, y, z] = LinearQuantity::point(&linear, 0, at);
    let [a, b, c] = LinearQuantity::point(&linear, 0, nalgebra::Vector3::new(-ahead, 7.0, 0.0));
    let between = [x.minus(&a), y.minus(&b), z.minus(&c)].map(|q| q.amplitude(&motions, w, Derivative::Place).re);
    for (got, want) in between.into_iter().zip([height * pitch, 0.0, -2.0 * ahead * pitch]) {
        assert!((got - want).abs() < 1e-12, "{got} {want}");
    }
}

#[test]
fn natural_periods_and_damping_ratios_match_oscillators() {
    let mut model = model("#DAMP *C 50 0 90 0 0 0\n", "");
    attach(&mut model, DriftMethod::None);
    let modes = natural(&LinearSystem::new(&model).unwrap()).unwrap();
    for (mode, (stiffness, damping)) in modes.iter().zip([(3e5, 5e4 + RADIATED), (8e5, 9e4 + RADIATED)]) {
        let w = f64::sqrt(stiffness / (1e6 + ADDED));
        assert!((mode.mode.period.unwrap() * w / TAU - 1.0).abs() < 1e-9 && mode.settled);
        let ratio = damping / (2.0 * w * (1e6 + ADDED));
        assert!((mode.damping.unwrap() / ratio - 1.0).abs() < 1e-9, "{mode:?} {ratio}");
    }
}

#[test]
fn motion_without_damping_at_its_natural_period_is_refused() {
    let mut model = model("", "");
    attach(&mut model, DriftMethod::None);
    let attached = model.bodies.get_mut("BUOY").unwrap().database.as_mut().unwrap();
    Arc::get_mut(&mut attached.data).unwrap().damping.iter_mut().for_each(|b| b.fill(0.0));
    let linear = LinearSystem::new(&model).unwrap();
    let w = (8e5f64 / (1e6 + ADDED)).sqrt();
    let wrong = Operators::new(&linear, &[w], &[0.0]).unwrap_err();
    assert!(wrong.error.to_string().contains("BUOY in Z"), "{wrong:?}");
    assert!(Operators::new(&linear, &[1.01 * w], &[0.0]).is_ok());
}

#[test]
fn response_statistics_match_rayleigh() {
    // sigma 2, Tz 10 s: in 10800 s 1080 maxima, the most probable largest 2 sqrt(2 ln 1080) = 7.47514
    let made = ResponseStatistics::from_moments(1.0, [4.0, 0.0], 4.0 * (TAU / 10.0).powi(2));
    assert!((made.period.unwrap() - 10.0).abs() < 1e-12 && made.significant() == 4.0);
    assert!((made.most_probable(10_800.0).unwrap() - 2.0 * (2.0 * 1080f64.ln()).sqrt()).abs() < 1e-12);
    assert!((made.most_probable(10_800.0).unwrap() - 7.475_14).abs() < 1e-5);
    assert_eq!(made.most_probable(5.0), None);
    // exp(-2) of the amplitudes are above twice the deviation
    let twice = [ExtremeKind::Times(2.0), ExtremeKind::Exceeded((-2f64).exp())].map(|e| made.extreme(e).unwrap());
    assert!(twice.iter().all(|x| (x - made.significant()).abs() < 1e-12), "{twice:?}");
}

/// Response in the sea of a model.
fn respond_in_sea(
    model: &Model,
    asked: &ResponseOptions,
) -> (LinearSystem, windlass_solve::frequency::FrequencyResponse) {
    let trains = Trains::new(model, &model.environment).unwrap().unwrap();
    let mut linear = LinearSystem::new(model).unwrap();
    let made = respond(&mut linear, &trains, asked).unwrap();
    (linear, made)
}

#[test]
fn body_following_waves_has_sea_height_and_period() {
    // stiffness of 1e15 N/m in place of inertia and 1e15 N/m of wave force: motion is elevation
    let mut model =
        model("~S GSPR BOTH Z 1E12 1000 -LEN 0\nCONNECTOR STIFF ~S *C *G\n", "&ENV -SEA ISSC 30 4 10 -SP_TYPE PEAK");
    attach(&mut model, DriftMethod::None);
    let attached = model.bodies.get_mut("BUOY").unwrap().database.as_mut().unwrap();
    let data = Arc::get_mut(&mut attached.data).unwrap();
    // held beyond the last frequency, where the excitation would fade
    data.frequencies.iter_mut().for_each(|w| *w *= 10.0);
    data.excitation.iter_mut().flatten().for_each(|x| x[2] = Complex::new(1e15, 0.0));
    let (linear, made) = respond_in_sea(&model, &ResponseOptions::default());
    let z = LinearQuantity::dof(&linear, 0, 2);
    let reported = ResponseStatistics::new(&made, &z, Derivative::Place);
    // the energy is exact; what is above 15 times the frequency of the peak is counted there, which takes 0.3 % of the second moment
    assert!((reported.significant() / 2.0 - 1.0).abs() < 1e-6, "{reported:?}");
    let tz = 10.0 * (0.8 / PI).powf(0.25);
    assert!((reported.period.unwrap() / tz - 1.0).abs() < 2e-3, "{reported:?} {tz}");
}

#[test]
fn spread_sea_response_is_mean_square_over_directions() {
    // surge by the cosine of the heading: the mean of cos^2 over cos^2 spreading about the axis is 3/4
    let of = |spread: &str| {
        let mut model = model("", &format!("&ENV -SEA JONSWAP 180 2 9 3.3 {spread}"));
        attach(&mut model, DriftMethod::None);
        let attached = model.bodies.get_mut("BUOY").unwrap().database.as_mut().unwrap();
        let data = Arc::get_mut(&mut attached.data).unwrap();
        data.headings = (0..72).map(|i| f64::from(i) * PI / 36.0).collect();
        data.drift = None;
        let one = |h: &f64| {
            let mut six = [Complex::new(0.0, 0.0); 6];
            six[0] = Complex::new(7e5 * h.cos(), 0.0);
            vec![six; data.frequencies.len()]
        };
        data.excitation = data.headings.iter().map(one).collect();
        let (linear, made) = respond_in_sea(&model, &ResponseOptions::default());
        ResponseStatistics::new(&made, &LinearQuantity::dof(&linear, 0, 0), Derivative::Place).deviation
    };
    let ratio = of("-SPREAD 2") / of("");
    // eleven directions of equal shares
    assert!((ratio * ratio / 0.75 - 1.0).abs() < 0.01, "{ratio}");
}

#[test]
fn slow_drift_of_rectangular_spectrum_matches_pinkster() {
    let (low, high) = (0.6, 0.9);
    let curve = format!("&DATA CURVES\nF_SPECTRUM BOX {low} 1 {high} 1\nEND\n");
    let mut model = model("#DAMP *C 50 0 90 0 0 0\n", &format!("{curve}&ENV -SEA BOX 180 4 {}", TAU / low));
    attach(&mut model, DriftMethod::Newman);
    let (linear, made) = respond_in_sea(&model, &ResponseOptions { spectral: true, ..ResponseOptions::default() });
    let x = LinearQuantity::dof(&linear, 0, 0);
    // S = 1 m2 over 0.3 rad/s; S_F = 8 S2 D2 (high - low - mu)
    let s = 1.0 / (high - low);
    assert!(made.slow.len() > 50);
    for point in made.slow.iter().filter(|p| p.frequency < 0.28) {
        let mu = point.frequency;
        let operator = oscillator(Complex::new(1.0, 0.0), 3e5, 5e4 + RADIATED, mu).norm_sqr();
        let most = 8.0 * s * s * 2e4f64.powi(2) * (high - low) * operator;
        let want = most * (1.0 - mu / (high - low));
        let density = point.variance(&x, Derivative::Place) / point.width.unwrap();
        // either end of the box lies somewhere in a cell of 1/120 of it
        assert!((density - want).abs() < 0.006 * most, "{mu} {density} {want}");
    }
    // no drift, no slow motion
    attach(&mut model, DriftMethod::Mean);
    let (_, none) = respond_in_sea(&model, &ResponseOptions { spectral: true, ..ResponseOptions::default() });
    assert!(none.slow.is_empty());
}

#[test]
fn quadratic_dashpot_linearisation_matches_borgman() {
    // 400 kN (s/m)2 in heave: the damping in the sea is c sqrt(8/pi) of the deviation of the velocity that it leads to
    let dashpot = "~D GSPR BOTH Z 1E-6 1000 -LEN 0 -Z_DAMPING 400 2\nCONNECTOR D ~D *C *G\n";
    let mut model = model(dashpot, "&ENV -SEA ISSC 180 4 9");
    attach(&mut model, DriftMethod::None);
    let (mut linear, made) = respond_in_sea(&model, &ResponseOptions { spectral: true, ..ResponseOptions::default() });
    assert!(made.rounds > 1);
    let z = LinearQuantity::dof(&linear, 0, 2);
    let velocity = ResponseStatistics::new(&made, &z, Derivative::Velocity).deviation;
    let (_, damping) = linear.inertia_and_damping(1.0);
    let want = RADIATED + 4e5 * (8.0 / PI).sqrt() * velocity;
    // 1024 velocities stand for the normal distribution
    assert!((damping[(2, 2)] / want - 1.0).abs() < 2e-3, "{} {want}", damping[(2, 2)]);
    // a dashpot so strong that nothing else holds the body settles too
    let mut strong = self::model(&dashpot.replace("400 2", "4E5 2"), "&ENV -SEA ISSC 180 4 9");
    attach(&mut strong, DriftMethod::None);
    assert!(respond_in_sea(&strong, &ResponseOptions { spectral: true, ..ResponseOptions::default() }).1.rounds > 1);
    // without it waves are answered as by a body without the dashpot
    let trains = Trains::new(&model, &model.environment).unwrap().unwrap();
    linear = LinearSystem::new(&model).unwrap();
    let free = sea_response(&linear, &trains, &ResponseOptions::default()).unwrap();
    assert!(ResponseStatistics::new(&free, &z, Derivative::Velocity).deviation > 1.2 * velocity);
}

const RADIUS: f64 = 10.0;

/// The hemisphere of tests/data, afloat; `more` are records of MEDIT, `dofs` those left out.
fn hemisphere(dofs: &str, more: &str, rest: &str) -> Session {
    let (mut session, _, _folder) = common::session();
    let file = format!("{}/tests/data/hemisphere/hemisphere.nc", env!("CARGO_MANIFEST_DIR"));
    let weight = 1.025 * G * 2.0 / 3.0 * PI * RADIUS.powi(3);
    run(
        &mut session,
        &format!(
            "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BALL {dofs}\n*CG 0 0 -3\n#WEIGHT *CG {weight} 5 5 5\n\
             DATABASE BALL -CAPYTAINE {file} -HYDROSTATICS YES -DRIFT NONE\n{more}END\n{rest}"
        ),
    );
    session
}

/// [HULME-1982 table 1]: Ka, added mass over displaced mass, damping over displaced mass times frequency, in heave.
const HULME: [(f64, f64, f64); 6] = [
    (0.2, 0.7938, 0.2793),
    (0.5, 0.5861, 0.3391),
    (0.8, 0.4698, 0.2899),
    (1.0, 0.4284, 0.2484),
    (1.4, 0.3924, 0.1756),
    (2.0, 0.3884, 0.1031),
];

#[test]
fn hemisphere_heave_matches_formula_and_hulme() {
    let session = hemisphere("-IGNORE X Y RX RY RZ", "", "");
    let model = &session.job.model;
    let linear = LinearSystem::new(model).unwrap();
    let data = Arc::clone(&model.bodies["BALL"].database.as_ref().unwrap().data);
    let mass = 1025.0 * 2.0 / 3.0 * PI * RADIUS.powi(3);
    let mut worst = 0.0f64;
    for (ka, added, radiated) in HULME {
        let w = (ka * G / RADIUS).sqrt();
        let found = Operators::new(&linear, &[w], &[0.0]).unwrap();
        let z = found.motions[0][0][2];
        let (a, b) = (data.added_mass_at(w).unwrap()[(2, 2)], data.damping_at(w).unwrap()[(2, 2)]);
        let k = data.hydrostatics.unwrap()[(2, 2)];
        let x = data.excitation_at(PI, w).unwrap()[2];
        let own = x / Complex::new(k - w * w * (mass + a), -w * b);
        assert!((z - own).norm() < 1e-9 * own.norm(), "{ka} {z} {own}");
        // Haskind's relation of an axisymmetric body in deep water: |X|2 = 2 rho g3 B / w3 (Newman, Marine Hydrodynamics, eq. 6.174)
        let published = radiated * mass * w;
        let force = (2.0 * 1025.0 * G.powi(3) * published / w.powi(3)).sqrt();
        let want = force
            / Complex::new(1025.0 * G * PI * RADIUS * RADIUS - w * w * mass * (1.0 + added), -w * published).norm();
        worst = worst.max((z.norm() / want - 1.0).abs());
    }
    // 32 by 64 panels displace 0.3 % less than the sphere, and near resonance the motion feels it several times over
    assert!(worst < 0.02, "{worst}");
}

/// Amplitude and lag of the harmonic of a frequency in the last rows of a run, over whole periods, straight drift taken out.
fn harmonic(times: &[f64], values: &[f64], w: f64) -> (f64, f64) {
    let mut normal = nalgebra::Matrix4::zeros();
    let mut right = nalgebra::Vector4::zeros();
    let middle = times[times.len() / 2];
    for (t, v) in times.iter().zip(values) {
        let row = nalgebra::Vector4::new((w * t).cos(), (w * t).sin(), 1.0, t - middle);
        normal += row * row.transpose();
        right += row * *v;
    }
    let solved = normal.lu().solve(&right).unwrap();
    (solved[0].hypot(solved[1]), solved[1].atan2(solved[0]))
}

#[test]
fn moored_hemisphere_in_small_waves_matches_frequency_domain() {
    let mut lines = String::from("#DAMP *CG 300 300 0 0 0 0\n~CHAIN B_CAT 100 EXACT -LEN 400 -DEPANCHOR 100\n");
    for (n, (x, y)) in [(9, 0), (0, 9), (-9, 0), (0, -9)].into_iter().enumerate() {
        lines.push_str(&format!("*F{n} {x} {y} -2\nCONNECTOR L{n} -ANC {} 370 ~CHAIN *F{n}\n", 90 * n));
    }
    let (period, step) = (9.0, 0.1);
    let w = TAU / period;
    let rest = format!("&EQUI\n&ENV -DEPTH 100 -SEA REGULAR 200 0.2 {period} -RAMP 60 -TIME 540 {step}\nTDOM\n");
    let session = hemisphere("-IGNORE RZ", &lines, &rest);
    let linear = LinearSystem::new(&session.job.model).unwrap();
    let found = Operators::new(&linear, &[w], &[200f64.to_radians()]).unwrap();
    let motions = &found.motions[0][0];
    let history = &session.job.run.as_ref().unwrap().history;
    let times = history.times();
    let from = times.len() - (12.0 * period / step) as usize;
    let fit = |values: &[f64]| harmonic(&times[from..], &values[from..], w);
    for dof in 0..5 {
        let own = motions[dof] * 0.1;
        let (amplitude, lag) = fit(&history.series(history.layout.body(0) + dof));
        println!("{dof} {} {amplitude} {} {lag}", own.norm(), own.arg());
        // half a percent: the step of 0.1 s, the memory's length, the square of a wave of 0.1 m
        assert!((amplitude / own.norm() - 1.0).abs() < 5e-3, "{dof}: {amplitude} {}", own.norm());
        assert!((lag - own.arg() + PI).rem_euclid(TAU) - PI < 0.02, "{dof}: {lag} {}", own.arg());
    }
    for n in 0..4 {
        let (_, size) = LinearQuantity::tension(&linear, &format!("L{n}")).unwrap().unwrap();
        let size = size.unwrap();
        let own = size.amplitude(motions, w, Derivative::Place) * 0.1;
        let at = history.layout.wrench(n, 0).unwrap();
        let values: Vec<f64> =
            history.rows().map(|r| r[at..at + 3].iter().map(|v| v * v).sum::<f64>().sqrt()).collect();
        let (amplitude, _) = fit(&values);
        println!("L{n} {} {amplitude}, at rest {}", own.norm(), size.mean);
        assert!((amplitude / own.norm() - 1.0).abs() < 5e-3, "L{n}: {amplitude} {}", own.norm());
    }
}

#[test]
fn dynamic_lines_are_reported_as_quasi_static_in_frequency_domain() {
    let rod = "~R ROD 60 30 -LEN 90 -REFINE 8 -EI 0 -DEPANCHOR 60\nCONNECTOR ROD -ANC 0 60 ~R *C\n";
    for (more, reported) in [(rod, true), ("", false)] {
        let mut model = model(more, "");
        attach(&mut model, DriftMethod::None);
        let linear = LinearSystem::new(&model).unwrap();
        let found = linear.notes.iter().any(|n| n.text.starts_with("ROD: ") && n.text.contains("without dynamics"));
        assert_eq!(found, reported, "{:?}", linear.notes);
    }
}

/// A body of 20000 kN that heaves and rolls with an added weight of 10000 kN, 3000 kN/m of hydrostatic stiffness and 30 kN s/m of damping, with its stiffness in roll (kN m)
/// and further records.
fn said_of_rao(roll: f64, more: &str, rao: &str) -> String {
    let (mut session, _, _folder) = common::session();
    let row = |values: [f64; 6]| values.map(|v| v.to_string()).join(" ");
    let matrix = |heave: f64, roll: f64| {
        let rows = [0.0, 0.0, heave, roll, 0.0, 0.0];
        let all: Vec<String> =
            (0..6).map(|i| row(std::array::from_fn(|j| if i == j { rows[i] } else { 0.0 }))).collect();
        all.join(" ")
    };
    let period = |t: f64| {
        format!(
            "H_PERIOD {t}\nH_AMASS {}\nH_DAMP {}\nH_FORCE 180 0 0 0 0 1500 20 0 0 0 0 0 0\n",
            matrix(1e4, 1e4),
            matrix(30.0, 1e5)
        )
    };
    let records = format!(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY BALL -IGNORE X Y RY RZ\n*CG 0 0 0\n#WEIGHT *CG 20000 4 4 4\n\
         #HYDROSTATIC *CG 3000 {roll} 1E5 -BUOYANCY 20000 -ZCGE 0\n{more}END\nHYDRODYNAMICS\nI_TOTAL BALL\nH_ORIGIN 0 0 0\n{}{}END_I_TOTAL\nEND\n\
         FREQ_RESPONSE\n{rao}\nEND\n",
        period(5.0),
        period(9.0)
    );
    run(&mut session, &records);
    session.reports.iter().map(|report| report.message.clone()).collect::<Vec<_>>().join("\n")
}

#[test]
fn modes_of_little_damping_at_periods_of_waves_are_named() {
    // 2 pi sqrt(30000/9.80665/3000) = 6.34 s; 30/(2 sqrt(3000 30000/9.80665)) = 0.495 %
    let text = said_of_rao(1e5, "", "RAO");
    let (period, ratio) = (TAU * (3e4 / G / 3e3_f64).sqrt(), 50.0 * 30.0 / (3e3 * 3e4 / G).sqrt());
    let said = format!("BALL Z has {ratio:.2} % of critical damping at its natural period of {period:.2} s");
    assert!(text.contains(&said), "{said}: {text}");
    // a wave has no part of roll, nor of heave far from its period, and 200 kN s/m are 3.8 %
    assert!(!text.contains("BALL RX has"), "{text}");
    for (more, rao) in [("", "RAO -PERIOD 8 9"), ("#DAMP *CG 0 0 200\n", "RAO")] {
        let text = said_of_rao(1e5, more, rao);
        assert!(!text.contains("of critical damping"), "{text}");
    }
    assert!(!text.contains("is not stable"), "{text}");
    let text = said_of_rao(-1e5, "", "RAO");
    assert!(text.contains("BALL is not stable in RX"), "{text}");
}
