//! First-order loads of a database about the low-frequency place and heading: no drift where none is given.

use crate::common;
use crate::common::run as runs;

use nalgebra::Complex;
use runs::settings;
use std::f64::consts::TAU;
use windlass_hydro::Category;
use windlass_model::Model;
use windlass_solve::frequency::LinearSystem;
use windlass_solve::time::{History, Run, SilentWatcher};

/// A hemisphere on soft linear springs, its centre of gravity off its axis so that it yaws; in an environment, with more records.
fn ball(environment: &str, more: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    session.open(
        "records",
        format!(
            "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*GA 4 0 -3\n*GB -4 0 -3\n&DESCRIBE BODY BALL\n*CG 1 0 -3\n*A 4 0 -3\n*B -4 0 -3\n\
             #WEIGHT *CG 21053 8 8 8\n#DAMP *CG 100 100 0 0 0 5000\n\
             DATABASE BALL -CAPYTAINE {}/tests/data/hemisphere/hemisphere.nc -SYMMETRIC -HYDROSTATICS YES\n\
             ~K GSPR BOTH X 11 1E6 Y 11 1E6 -LEN 0\nCONNECTOR KA ~K *A *GA\nCONNECTOR KB ~K *B *GB\n{more}\nEND\n&ENV {environment}\n",
            env!("CARGO_MANIFEST_DIR")
        ),
    );
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

fn run(model: &Model, (time, dt): (f64, f64)) -> Run {
    let mut made = Run::new(model, settings(time, dt), vec![]).unwrap();
    made.run(&mut SilentWatcher).unwrap();
    made
}

/// Mean and amplitude of the numbers from `at` on over the last instants.
fn mean_and_amplitude(history: &History, at: usize, count: usize) -> (f64, f64) {
    let series = history.series(at);
    let last = &series[series.len() - count..];
    let mean = last.iter().sum::<f64>() / count as f64;
    (mean, last.iter().fold(0.0, |most: f64, v| most.max((v - mean).abs())))
}

#[test]
fn free_body_in_regular_wave_does_not_drift() {
    // linear radiation has mean 0, and a body without drift coefficients none: 20 whole periods of 7 s behind ramp and transient
    let (dt, periods) = (0.1, 20);
    for heading in [180.0, 135.0, 0.0] {
        for height in [1.0, 2.0] {
            let made =
                run(&ball(&format!("-SEA REGULAR {heading} {height} 7 -TIME 1050 {dt} -RAMP 100"), ""), (1050.0, dt));
            let count = (7.0 / dt) as usize * periods;
            let at = made.history.layout.category(0, Category::RadiationDrag).unwrap();
            let all: Vec<(f64, f64)> = (0..6).map(|n| mean_and_amplitude(&made.history, at + n, count)).collect();
            let kind = |n: usize| if n < 3 { &all[..3] } else { &all[3..] };
            for (n, (mean, amplitude)) in all.iter().enumerate() {
                // what is rounding beside the others has no mean of its own
                let largest = kind(n).iter().fold(0.0f64, |most, a| most.max(a.1));
                let allowed = 1e-4 * amplitude.max(1e-6 * largest);
                assert!(mean.abs() <= allowed, "{heading} {height} {n}: {mean} of {amplitude}");
            }
            // by the pull of the springs, 22 kN/m along each axis
            let pull = made.history.layout.category(0, Category::FlexConnectors).unwrap();
            let along = |n: usize| mean_and_amplitude(&made.history, pull + n, count);
            let amplitude = along(0).1.hypot(along(1).1);
            for n in [0, 1] {
                assert!(along(n).0.abs() <= 0.01 * amplitude, "{heading} {height} {n}: {} of {amplitude}", along(n).0);
            }
            assert!(amplitude > 0.1 * height * 22e3);
        }
    }
}

/// The amplitude of a number of rows over the last whole periods, as a complex number: Re(a exp(-i w t)).
fn harmonic(history: &History, at: usize, (period, count): (f64, usize)) -> Complex<f64> {
    let rows: Vec<(f64, f64)> = history.rows().map(|row| (row[0], row[at])).collect();
    let last = &rows[rows.len() - count..];
    last.iter().map(|(t, v)| Complex::from_polar(2.0 * v / count as f64, TAU * t / period)).sum()
}

#[test]
fn offset_and_slow_yaw_shift_phase_and_heading() {
    // held 30 m down the wave the force comes 30 k later; turned by 20 degrees the round body feels it across by tan(20)
    let excited = |position: &str, dofs: &str| {
        let model = ball(
            "-SEA REGULAR 180 2 7 -TIME 140 0.1 -RAMP 20",
            &format!("END\n&DESCRIBE BODY BALL -IGNORE {dofs}\n&INSTATE -LOCATE BALL {position}\nMEDIT"),
        );
        let made = run(&model, (140.0, 0.1));
        let at = made.history.layout.category(0, Category::Wave).unwrap();
        [0, 1, 2].map(|n| harmonic(&made.history, at + n, (7.0, 700)))
    };
    let all = "X Y Z RX RY RZ";
    let here = excited("0 0 0", all);
    let k = (TAU / 7.0).powi(2) / 9.80665;
    let there = excited("30 0 0", all);
    for n in [0, 2] {
        let turned = there[n] / here[n] * Complex::from_polar(1.0, -30.0 * k);
        // the depth is infinite; gravity of the records against 9.80665: 1e-5 of 30 k
        assert!((turned - 1.0).norm() < 1e-3, "{n}: {turned}");
    }
    // a round body has surge cos(b) and sway sin(b) of waves toward b in its axes, which headings 45 degrees apart carry: turned it feels the same
    let yawed = excited("0 0 0 0 0 20", all);
    // panels are symmetric to a thousandth
    for (n, want) in [(0, 1.0), (1, 0.0)] {
        assert!((yawed[n] / here[0] - want).norm() < 1e-3, "{n}: {yawed:?} {here:?} {want}");
    }
}

#[test]
fn slow_yaw_in_calm_water_is_damped_as_given() {
    // released from 5 degrees: I yaw'' + c yaw' + k yaw = 0 about the centre of gravity, c = 5000 kN m s, so that the amplitude falls by
    // exp(-c t/(2 I)); nothing comes by the filter of the heading
    let model =
        ball("-TIME 240 0.1", "END\n&DESCRIBE BODY BALL -IGNORE X Y Z RX RY\n&INSTATE -LOCATE BALL 0 0 0 0 0 5\nMEDIT");
    let made = run(&model, (240.0, 0.1));
    let yaw = made.history.series(made.history.layout.body(0) + 5);
    // about the origin, which is held: the radius of 8 m and 1 m to the centre; by springs of 2 x 11 kN/m on arms of 4 m
    let inertia = 21053.0 / 9.80665 * (64.0 + 1.0);
    let damping = 5000.0 + 100.0;
    let stiffness = 2.0 * 11.0 * 16.0;
    let decay = damping / (2.0 * inertia);
    let w = f64::sqrt(stiffness / inertia - decay * decay);
    for (n, angle) in yaw.iter().enumerate().step_by(100) {
        let t = 0.1 * n as f64;
        let exact = 5f64.to_radians() * (-decay * t).exp() * ((w * t).cos() + decay / w * (w * t).sin());
        // springs on arms of 4 m turned by 5 degrees are stiffer by their turn: a thousandth, and its phase over four periods
        assert!((angle - exact).abs() < 0.02 * 5f64.to_radians(), "{t}: {angle} {exact}");
    }
}

#[test]
fn moored_ball_surge_in_sea_matches_frequency_domain() {
    let model = ball("-SEA JONSWAP 180 0.2 9 -TIME 3600 0.2 -RAMP 100", "#DAMP *CG 0 0 0 30000 30000 0");
    let made = run(&model, (3600.0, 0.2));
    // at the springs, by their pull of 22 kN/m
    let pull = made.history.layout.category(0, Category::FlexConnectors).unwrap();
    let surge = made.history.series(pull).split_off(3000).into_iter().map(|f| -f / 22e3);
    let linear = LinearSystem::new(&model).unwrap();
    let waves: Vec<_> = (made.sea.as_ref().unwrap().components.iter())
        .map(|c| {
            let motion = &linear.operators(c.frequency, &[c.toward[1].atan2(c.toward[0])]).unwrap()[0];
            (c.frequency, (motion[0] - motion[4] * 3.0) * Complex::from_polar(c.amplitude, c.phase))
        })
        .collect();
    let by_frequency = |t: f64| waves.iter().map(|(w, a)| (a * Complex::from_polar(1.0, -w * t)).re).sum::<f64>();
    let pairs: Vec<(f64, f64)> =
        surge.zip(made.history.times().split_off(3000)).map(|(x, t)| (x, by_frequency(t))).collect();
    let count = pairs.len() as f64;
    let square = |f: &dyn Fn(&(f64, f64)) -> f64| (pairs.iter().map(|p| f(p).powi(2)).sum::<f64>() / count).sqrt();
    let (own, other, off) = (square(&|p| p.0), square(&|p| p.1), square(&|p| p.0 - p.1));
    // steps of 0.2 s lengthen a wave of 9 s by a thousandth and more by shorter ones, and the memory fades: some percent of the motion
    assert!((own / other - 1.0).abs() < 0.02 && off < 0.05 * other, "{own} {other} {off}");
    // what is slow: means of 20 s
    let slow = |f: &dyn Fn(&(f64, f64)) -> f64| {
        let means = pairs.chunks_exact(100).map(|c| c.iter().map(f).sum::<f64>() / 100.0);
        (means.clone().map(|m| m * m).sum::<f64>() / means.len() as f64).sqrt()
    };
    let (own, other_slow) = (slow(&|p| p.0), slow(&|p| p.1));
    assert!((own - other_slow).abs() < 0.005 * other, "{own} {other_slow} of {other}");
}
