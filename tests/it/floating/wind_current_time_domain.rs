//! Wind and current on bodies that move, and that vary in time: against closed forms beside them, and tangents by differences.

use crate::common::assert_share;
use crate::common::body_load::begin_step;
use crate::common::run::{body, model};

use nalgebra::Matrix6;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::gusts::{FREQUENCY_RANGE_HZ, GUST_SPECTRA, Gusts};
use windlass_hydro::{BodyLoad, BodyStep, Category, DynamicLoad, Floating};
use windlass_model::Model;

const KNOT: f64 = 1852.0 / 3600.0;

fn floating(model: &Model) -> Floating {
    Floating::under_way(model, &model.bodies["B"], None).unwrap()
}

fn position(values: [f64; 6]) -> Pose {
    let [x, y, z, roll, pitch, yaw] = values;
    Pose::from_place(&Place::new([x, y, z, roll.to_radians(), pitch.to_radians(), yaw.to_radians()]))
}

fn load_of_moving_body(load: &dyn BodyLoad, time: f64, pose: &Pose, velocity: &Six) -> DynamicLoad {
    let at = BodyStep { time, dt: 0.1, pose, velocity };
    let state = begin_step(load, &at);
    load.dynamic_load(&at, &state).unwrap()
}

fn sum(model: &Model, category: Category, time: f64, pose: &Pose, velocity: &Six) -> Six {
    let loads = floating(model).loads;
    loads
        .iter()
        .filter(|l| l.category() == category)
        .map(|l| load_of_moving_body(l.as_ref(), time, pose, velocity).load.wrench)
        .sum()
}

const RECORDS: &str = "*A 20 3 -4\n*B 21 8 9\n*C 25 -6 12\n*D 30 1 4\n\
    #AREA *A 30 70 20\n#AREA *B 30 70 20\n#PLATE *B *C *D -CD 1.3\n#PLATE *B *C *D -FLUID WATER\n\
    #TABLE *A 0 -90 0 3 10 20 0 50 -40 -300 2 7 30 80 90 5 -900 0 0 0 70 180 80 0 9 -50 20 0 250 8 450 7 -6 5 400\n\
    #DRAG *A 500 900 0 0 0 7E4";
const CURVES: &str = "&DATA CURVES C_PROFILE P 0 2.5 8 1.7 40 0.3\n&DATA CURVES C_PROFILE Q 0 0.4 100 0.2\n\
    &DATA CURVES W_HISTORY H 0 30 100 60 200 40\n&DATA CURVES C_HISTORY F 0 1 100 -0.5\n";

/// Loads of records and of a hull, with coefficients along all axes, in wind and current that vary with height and time.
fn all(environment: &str) -> Vec<Box<dyn BodyLoad>> {
    let hull = "&SURFACE\nBLOCK HULL -40 -12 -6 40 12 7 -CS_WIND 1.1 1.2 0.7 -CS_CURRENT 0.9 1.3 1.5\nEND";
    let model = model(&format!("MEDIT\n&DESCRIBE BODY B\n{RECORDS}\nEND\n{hull}\n{CURVES}{environment}"));
    let loads = floating(&model).loads;
    loads.into_iter().filter(|l| matches!(l.category(), Category::Wind | Category::ViscousDrag)).collect()
}

const VARYING: &str = "&ENV -WIND 50 130 -CURRENT P 110 Q 250 -DEPTH 90 -TIDE 1 -W_HISTORY H -C_HISTORY F";

#[test]
fn time_domain_damping_and_stiffness_match_finite_differences() {
    for environment in [VARYING, "&ENV -DEPTH 90"] {
        let loads = all(environment);
        assert!(loads.len() >= 9, "{}", loads.len());
        for pose in [[0.0; 6], [10.0, -20.0, 0.3, 12.0, -17.0, 63.0], [0.0, 0.0, -3.0, -30.0, 25.0, 200.0]] {
            let (pose, velocity) = (position(pose), Six::new(1.3, -0.7, 0.4, 0.05, -0.03, 0.08));
            for load in &loads {
                let found = load_of_moving_body(load.as_ref(), 40.0, &pose, &velocity);
                let (mut stiffness, mut damping) = (Matrix6::zeros(), Matrix6::zeros());
                for column in 0..6 {
                    // steps as in common/tangent.rs; the force is of second degree in the velocity
                    let step = if column < 3 { 1e-5 } else { 1e-6 };
                    let wrench = |sign: f64, motion: bool| {
                        let mut by = Six::zeros();
                        by[column] = sign * step;
                        let pose = if motion { pose.after_motion(&by) } else { pose };
                        let velocity = if motion { velocity } else { velocity + by };
                        load_of_moving_body(load.as_ref(), 40.0, &pose, &velocity).load.wrench
                    };
                    stiffness.set_column(column, &((wrench(-1.0, true) - wrench(1.0, true)) / (2.0 * step)));
                    damping.set_column(column, &((wrench(-1.0, false) - wrench(1.0, false)) / (2.0 * step)));
                }
                let scale = stiffness.amax().max(found.load.wrench.amax());
                // a hull's sums have some 1e3 terms, which leave a few digits of rounding in a difference
                let name = load.category().name();
                assert!(
                    (found.load.stiffness - stiffness).amax() <= 1e-6 * scale,
                    "{name} {pose:?}: {} not {stiffness}",
                    found.load.stiffness
                );
                let scale = damping.amax().max(found.load.wrench.amax());
                assert!(
                    (found.damping - damping).amax() <= 1e-6 * scale,
                    "{name} {pose:?}: {} not {damping}",
                    found.damping
                );
            }
        }
    }
}

#[test]
fn load_at_rest_in_mean_stream_matches_statics() {
    for load in all("&ENV -WIND 50 130 -CURRENT P 110 Q 250 -DEPTH 90 -TIDE 1") {
        let pose = position([10.0, -20.0, 0.3, 12.0, -17.0, 63.0]);
        let (rest, under_way) =
            (load.mean_load(&pose).unwrap(), load_of_moving_body(load.as_ref(), 3.0, &pose, &Six::zeros()).load);
        assert!((rest.wrench - under_way.wrench).amax() <= 1e-14 * rest.wrench.amax());
        assert!((rest.stiffness - under_way.stiffness).amax() <= 1e-13 * rest.stiffness.amax());
    }
}

#[test]
fn body_moving_with_stream_has_no_drag() {
    let model = body("*P 0 0 10\n#AREA *P 100 400\n*Q 0 0 -10\n#AREA *Q 100 400", "&ENV -WIND 40 180 -CURRENT 2 180");
    let wind = wind_at_ten();
    assert_share(
        sum(&model, Category::Wind, 0.0, &Pose::default(), &Six::new(wind, 0.0, 0.0, 0.0, 0.0, 0.0)).amax(),
        0.0,
        0.0,
    );
    let with = Six::new(2.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    assert_eq!(sum(&model, Category::ViscousDrag, 0.0, &Pose::default(), &with), Six::zeros());
}

fn wind_at_ten() -> f64 {
    40.0 * KNOT
}

#[test]
fn motion_in_still_water_has_drag() {
    // an area of 10 m2 through water of 1025 kg/m3 at 3 m/s: 1/2 x 1025 x 10 x 9 against it; on a hull the same
    let velocity = Six::new(3.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let area = body("*P 0 0 -5\n#AREA *P 10", "");
    assert_share(sum(&area, Category::ViscousDrag, 0.0, &Pose::default(), &velocity)[0], -46_125.0, 1e-12);
    let hull = model(
        "MEDIT\n&DESCRIBE BODY B\nEND\n&SURFACE\nBLOCK HULL -9 -5 -2 9 5 4 -CS_CURRENT 0.5 0 1\nEND\n&ENV -DEPTH 50",
    );
    // 0.5 x 10 x 2 m2
    assert_share(sum(&hull, Category::ViscousDrag, 0.0, &Pose::default(), &velocity)[0], -46_125.0, 1e-12);
    // sinking at 2 m/s on a bottom of 18 x 10 m: half the skin seen from above and below, and the cut, make it the whole
    let sinking = Six::new(0.0, 0.0, -2.0, 0.0, 0.0, 0.0);
    assert_share(
        sum(&hull, Category::ViscousDrag, 0.0, &Pose::default(), &sinking)[2],
        0.5 * 1025.0 * 180.0 * 4.0,
        1e-12,
    );
    // in statics there is no load at all
    let rest = Floating::at_rest(&hull, &hull.bodies["B"]).unwrap();
    assert!(!rest.loads.iter().any(|l| l.category() == Category::ViscousDrag));
}

#[test]
fn linear_drag_uses_current_speed_and_body_damping() {
    let model = body("*P 0 0 -10\n#DRAG *P 1000 4000", "&ENV -CURRENT 2 180");
    let velocity = Six::new(5.0, 1.0, 0.0, 0.0, 0.0, 0.1);
    assert_share(sum(&model, Category::ViscousDrag, 0.0, &Pose::default(), &velocity)[0], 2000.0, 1e-12);
    assert_share(floating(&model).damping[(0, 0)], 1000.0, 1e-12);
}

#[test]
fn plate_in_wind_approaches_wind_speed() {
    // m dv/dt = k (U - v)^2 from rest: v = U - U / (1 + k U t / m)
    let model = body(
        "*A 0 -3 9\n*B 0 3 9\n*C 0 3 11\n*D 0 -3 11\n#PLATE *A *B *C *D -CD 1",
        "&ENV -WIND 20 180 -W_PROFILE POWER 0",
    );
    let (loads, mass, wind) = (floating(&model).loads, 500.0, 20.0 * KNOT);
    let k = 0.5 * 1.226 * 12.0;
    let (mut speed, dt) = (0.0, 0.05);
    for step in 0..40_000 {
        // the trapezoidal rule, with the velocity found by Newton's method from the damping
        let force = |v: f64| {
            let velocity = Six::new(v, 0.0, 0.0, 0.0, 0.0, 0.0);
            let found = load_of_moving_body(loads[0].as_ref(), f64::from(step) * dt, &Pose::default(), &velocity);
            (found.load.wrench[0], found.damping[(0, 0)])
        };
        let (start, old) = (force(speed).0, speed);
        for _ in 0..20 {
            let (end, damping) = force(speed);
            speed -= (mass * (speed - old) / dt - 0.5 * (start + end)) / (mass / dt + 0.5 * damping);
        }
        let want = wind - wind / (1.0 + k * wind * f64::from(step + 1) * dt / mass);
        // the rule is of second order: (k U dt / m)^2 = 6e-5
        assert!((speed - want).abs() < 1e-5 * wind, "{step} {speed} {want}");
    }
    // at 2000 s U / 302 is left
    assert!(speed > 0.996 * wind && speed < wind, "{speed}");
}

#[test]
fn plate_falling_in_still_air_reaches_terminal_velocity() {
    // W = 1/2 rho A v^2 with A 12 m2 level: v = sqrt(2 W / (rho A))
    let model = body("*A 0 -3 90\n*B 2 -3 90\n*C 2 3 90\n*D 0 3 90\n#PLATE *A *B *C *D -CD 1", "");
    let (weight, rho) = (1000.0, 1.226);
    let speed = (2.0 * weight / (rho * 12.0f64)).sqrt();
    let falling = Six::new(0.0, 0.0, -speed, 0.0, 0.0, 0.0);
    assert_share(sum(&model, Category::Wind, 0.0, &Pose::default(), &falling)[2], weight, 1e-12);
}

#[test]
fn wind_history_replaces_mean_after_ramp() {
    let records = "*P 0 0 10\n#AREA *P 100\n&DATA CURVES W_HISTORY H 0 30 100 50";
    let at = |environment: &str, time| {
        let model = body(records, &format!("&ENV -WIND 30 180 -W_HISTORY H {environment}"));
        (sum(&model, Category::Wind, time, &Pose::default(), &Six::zeros())[0] / (0.5 * 1.226 * 100.0)).sqrt() / KNOT
    };
    for (time, knots) in [(0.0, 30.0), (50.0, 40.0), (100.0, 50.0), (1e4, 50.0)] {
        assert_share(at("", time), knots, 1e-12);
    }
    // half the ramp: half of what the history adds
    assert_share(at("-RAMP 100", 50.0), 35.0, 1e-12);
}

#[test]
fn current_history_multiplies_current() {
    let model = body("*Q 0 0 -5\n#AREA *Q 10\n&DATA CURVES C_HISTORY F 0 1 100 -1", "&ENV -CURRENT 2 180 -C_HISTORY F");
    for (time, speed) in [(0.0, 2.0f64), (25.0, 1.0), (50.0, 0.0), (100.0, -2.0)] {
        let want = 0.5 * 1025.0 * 10.0 * speed * speed.abs();
        assert_share(sum(&model, Category::ViscousDrag, time, &Pose::default(), &Six::zeros())[0], want, 1e-9);
    }
    let rest = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    assert_share(rest.loads[0].mean_load(&Pose::default()).unwrap().wrench[0], 20_500.0, 1e-12);
}

#[test]
fn invalid_stream_in_time_domain_is_refused() {
    let records = "*P 0 0 10\n#AREA *P 100\n&DATA CURVES W_HISTORY H 0 30 100 50";
    for environment in ["&ENV -WIND 30 0 -W_MD_CORRELATION 0.5", "&ENV -W_HISTORY H"] {
        let model = body(records, environment);
        assert!(Floating::under_way(&model, &model.bodies["B"], None).is_err(), "{environment}");
        assert!(Floating::at_rest(&model, &model.bodies["B"]).is_ok(), "{environment}");
    }
    let independent = body(records, "&ENV -WIND 30 0 -W_MD_CORRELATION 0");
    assert!(Floating::under_way(&independent, &independent.bodies["B"], None).is_ok());
}

fn gusts(environment: &str) -> Gusts {
    let model = model(environment);
    Gusts::new(&model, &model.environment).unwrap().unwrap()
}

/// Mean and variance of the gusts over a time (s), by steps of half a second.
fn statistics(gusts: &Gusts, time: f64) -> (f64, f64) {
    let count = (2.0 * time) as usize;
    let series: Vec<f64> = (0..count).map(|i| gusts.speed_at_time(0.5 * i as f64)).collect();
    let mean = series.iter().sum::<f64>() / count as f64;
    (mean, series.iter().map(|u| (u - mean).powi(2)).sum::<f64>() / count as f64)
}

#[test]
fn gust_series_variance_matches_spectrum_integral() {
    for shape in GUST_SPECTRA {
        let name = shape.name;
        let gusts = gusts(&format!("&ENV -WIND 50 180 -W_SPECTRUM {name}"));
        // the integral of the formula by Simpson's rule over the logarithm of the frequency
        let (parts, speed) = (4000, 50.0 * KNOT);
        let step = (FREQUENCY_RANGE_HZ[1] / FREQUENCY_RANGE_HZ[0]).ln() / f64::from(parts);
        let part = |i: i32| {
            let f = FREQUENCY_RANGE_HZ[0] * (step * f64::from(i)).exp();
            let weight = if i == 0 || i == parts { 1.0 } else { 2.0 + 2.0 * f64::from(i % 2) };
            weight * f * (shape.density)(f, speed) * step / 3.0
        };
        let want: f64 = (0..=parts).map(part).sum();
        // straight lines between the points of the table are off by 2e-5
        assert_share(gusts.deviation().powi(2), want, 5e-5);
        // 100 components over 30 hours: cut cycles and beats of neighbours, some 1e-3 rad/s apart, leave a percent
        let (mean, variance) = statistics(&gusts, 108_000.0);
        assert_share(variance, want, 2e-2);
        assert!(mean.abs() < 1e-2 * want.sqrt(), "{name} {mean}");
        // what is slower than an hour or faster than a second is left out: most of Kaimal's, (1 + 33 f z/U)^(-2/3) = 0.174 of it
        let whole = gusts.whole.unwrap().powi(2);
        assert!(want < whole && want > 0.82 * whole, "{name} {want} {whole}");
    }
}

#[test]
fn turbulence_intensity_scales_spectrum_and_curve_is_unscaled() {
    assert_share(
        gusts("&ENV -WIND 50 180 -W_SPECTRUM HARRIS -W_COMPONENTS 20 0.12").deviation(),
        0.12 * 50.0 * KNOT,
        1e-12,
    );
    // a triangle of 4 m2/s over 0.2 rad/s: 0.4 m2/s2
    let curve = "&DATA CURVES F_SPECTRUM G 0.1 0 0.2 4 0.3 0\n&ENV -WIND 50 180 -W_SPECTRUM G";
    assert_share(gusts(curve).deviation().powi(2), 0.4, 1e-12);
    assert_share(gusts(&format!("{curve} -W_COMPONENTS 10 0.05")).deviation(), 0.05 * 50.0 * KNOT, 1e-12);
}

#[test]
fn given_periods_match_components() {
    let gusts = gusts("&ENV -WIND 50 180 -W_SPECTRUM NPD -W_PERIOD 600 60 6");
    let periods: Vec<f64> = gusts.bands.iter().map(|b| std::f64::consts::TAU / b.frequency).collect();
    assert_eq!(periods.len(), 3);
    for (got, want) in periods.iter().zip([600.0, 60.0, 6.0]) {
        assert_share(*got, want, 1e-12);
    }
    // no energy is lost
    assert_share(gusts.deviation(), gusts.spectrum.moment(0).sqrt(), 1e-12);
}

#[test]
fn same_seed_gives_same_gusts_and_another_seed_others() {
    let at = |seed: &str| gusts(&format!("&ENV -WIND 50 180 -W_SPECTRUM API {seed}")).speed_at_time(123.4);
    assert_eq!(at(""), at("-SEED 1"));
    // reinforced waves leave the gusts as they are
    assert_eq!(at(""), at("-T_REINFORCE 100"));
    assert_ne!(at("-SEED 2"), at("-SEED 1"));
}

#[test]
fn gust_adds_to_wind_load_after_ramp() {
    let environment = "&ENV -WIND 30 180 -W_PROFILE POWER 0 -W_SPECTRUM API -RAMP 60";
    let model = body("*P 0 0 40\n#AREA *P 100", environment);
    let gusts = gusts(environment);
    let speed = |time: f64| (sum(&model, Category::Wind, time, &Pose::default(), &Six::zeros())[0] / 61.3).sqrt();
    assert_share(speed(0.0), 30.0 * KNOT, 1e-12);
    assert_share(speed(30.0), 30.0 * KNOT + 0.5 * gusts.speed_at_time(30.0), 1e-12);
    assert_share(speed(200.0), 30.0 * KNOT + gusts.speed_at_time(200.0), 1e-12);
}

#[test]
fn gusts_without_wind_are_refused() {
    let model = body("*P 0 0 10\n#AREA *P 100", "&ENV -W_SPECTRUM API");
    assert!(Floating::under_way(&model, &model.bodies["B"], None).is_err());
}

/// A tube of 1 m from 40 m below the water to 10 m above it, with 0.5 m of added diameter from 30 m deep to the surface.
const GROWN: &str = "MEDIT\n&DESCRIBE BODY B\n*A 0 0 -40\n*B 0 0 10\nEND\n\
    &SURFACE\nTUBE LEG *A *B 1000 -CS_CURRENT 1 1 0 -CA 0\nEND\n&DATA CURVES M_GROWTH G -30 500 0 500";

#[test]
fn growth_increases_current_area() {
    let drag = |environment: &str| {
        let model = model(&format!("{GROWN}\n&ENV -CURRENT 2 180 -DEPTH 60 {environment}"));
        let loads = Floating::at_rest(&model, &model.bodies["B"]).unwrap().loads;
        let mine = loads.iter().filter(|l| l.category() == Category::ViscousDrag);
        mine.map(|l| l.mean_load(&Pose::default()).unwrap().wrench).sum::<Six>()
    };
    // 1/2 rho U^2 over 40 m of 1 m, and over 10 of 1 m and 30 of 1.5 m; a prism of 64 sides is within 0.1 % of the width of a tube
    assert_share(drag("")[0], 0.5 * 1025.0 * 4.0 * 40.0, 1e-3);
    assert_share(drag("-M_GROWTH G")[0], 0.5 * 1025.0 * 4.0 * 55.0, 1e-3);
    // what is added has its centre 15 m deep
    assert_share(drag("-M_GROWTH G")[4] - drag("")[4], -0.5 * 1025.0 * 4.0 * 15.0 * 15.0, 1e-3);
}

#[test]
fn growth_adds_weight_buoyancy_and_inertia() {
    let model = model(&format!("{GROWN}\n&ENV -DEPTH 60 -M_GROWTH G 1400"));
    let floating = floating(&model);
    // a ring of 1.25 pi/4 m2 over 30 m
    let volume = 30.0 * std::f64::consts::FRAC_PI_4 * (1.5 * 1.5 - 1.0);
    let of = |category, pose: &Pose| {
        let bare = Floating::at_rest(&self::model(&format!("{GROWN}\n&ENV -DEPTH 60")), &model.bodies["B"]).unwrap();
        let sum = |loads: &[Box<dyn BodyLoad>]| -> f64 {
            loads.iter().filter(|l| l.category() == category).map(|l| l.mean_load(pose).unwrap().wrench[2]).sum()
        };
        sum(&floating.loads) - sum(&bare.loads)
    };
    assert_share(of(Category::Weight, &Pose::default()), -1400.0 * 9.80665 * volume, 1e-9);
    assert_share(of(Category::Buoyancy, &Pose::default()), 1025.0 * 9.80665 * volume, 1e-9);
    // risen by 7.3 m, so much of it is dry
    let risen = position([0.0, 0.0, 7.3, 0.0, 0.0, 0.0]);
    assert_share(of(Category::Buoyancy, &risen), 1025.0 * 9.80665 * volume * (1.0 - 7.3 / 30.0), 1e-9);
    assert_share(floating.added_mass[(0, 0)], 1400.0 * volume, 1e-12);
    // its centre is 15 m below the origin: surge turns it, and a rod of 30 m has length^2/12 beside that, in rings of a metre
    assert_share(floating.added_mass[(4, 0)], -15.0 * 1400.0 * volume, 1e-12);
    assert_share(floating.added_mass[(4, 4)], 1400.0 * volume * (225.0 + (900.0 - 1.0) / 12.0), 1e-9);
    for pose in [risen, position([3.0, 1.0, 7.3, 8.0, -5.0, 20.0])] {
        for load in floating.loads.iter().filter(|l| l.category() == Category::Buoyancy) {
            let found = load.mean_load(&pose).unwrap();
            let mut want = Matrix6::zeros();
            for column in 0..6 {
                let step = 1e-6;
                let wrench = |sign: f64| {
                    let mut by = Six::zeros();
                    by[column] = sign * step;
                    load.mean_load(&pose.after_motion(&by)).unwrap().wrench
                };
                want.set_column(column, &((wrench(-1.0) - wrench(1.0)) / (2.0 * step)));
            }
            assert!((found.stiffness - want).amax() <= 1e-6 * want.amax(), "{} {want}", found.stiffness);
        }
    }
}
