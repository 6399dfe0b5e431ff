//! Motions that bodies are given: exact derivatives, responses to waves, splines, and what cannot be.

use crate::common;
use crate::common::run as runs;

use nalgebra::Vector3;
use runs::{settings, trapezoidal};
use std::f64::consts::{PI, TAU};
use std::fmt::Write;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::sea::{Component, Sea, Water};
use windlass_model::{Model, Stretching};
use windlass_solve::time::{
    Action, ActionKind, BodyMotion, Ending, Prescribed, Run, RunSettings, SilentWatcher, Trigger, build_prescribed,
};

/// A model with a body B and a file in the job's folder; the text of what was said.
fn session(file: &str, records: &str) -> (Model, i64, String) {
    let (mut session, screen, folder) = common::session();
    let path = folder.path().join("motion.csv");
    std::fs::write(&path, file).unwrap();
    let records = records.replace("FILE.CSV", path.to_str().unwrap());
    session.open(
        "records",
        format!("&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY B\n*P 0 0 0\nEND\n{records}\n"),
    );
    session.run();
    (session.job.model.clone(), session.errors, format!("{:?} {}", session.reports, screen.text()))
}

fn motion(file: &str, records: &str, sea: Option<&Arc<Sea>>) -> Box<dyn Prescribed> {
    let (model, errors, text) = session(file, records);
    assert_eq!(errors, 0, "{text}");
    build_prescribed(&model.bodies["B"], sea, 0.0).unwrap().unwrap()
}

fn motion_at(motion: &dyn Prescribed, time: f64) -> BodyMotion {
    motion.motion_at(time).unwrap()
}

/// Velocity and acceleration against central differences of place, rotation and velocity.
fn derivatives_agree(motion: &dyn Prescribed, times: impl Iterator<Item = f64>) {
    for time in times {
        let h = 1e-4;
        let (before, now, after) = (motion_at(motion, time - h), motion_at(motion, time), motion_at(motion, time + h));
        // of a small turn, the part of the matrix that changes its sign with it
        let m = after.pose.axes * before.pose.axes.transpose();
        let turn = Vector3::new(m[(2, 1)] - m[(1, 2)], m[(0, 2)] - m[(2, 0)], m[(1, 0)] - m[(0, 1)]) * 0.5;
        let shift = after.pose.origin - before.pose.origin;
        let rates = Six::from_iterator(shift.iter().chain(turn.iter()).map(|x| x / (2.0 * h)));
        let seconds = (after.velocity - before.velocity) / (2.0 * h);
        // third derivatives of some 1 times h^2, and rounding of 1e-15 over h
        assert!((rates - now.velocity).amax() < 1e-7, "{time}: {rates} {}", now.velocity);
        assert!((seconds - now.acceleration).amax() < 1e-7, "{time}: {seconds} {}", now.acceleration);
        assert_eq!(now.auxiliary, now.acceleration);
    }
}

fn steps(from: f64, to: f64) -> impl Iterator<Item = f64> {
    (0..57).map(move |n| from + (to - from) * f64::from(n) / 56.0)
}

#[test]
fn sinusoids_match_their_derivatives_with_all_three_angles() {
    let records = "&INSTATE -LOCATE B 5 6 7 10 -20 70\nMEDIT\nPRESCRIBE B -SINUSOID X 2 9 -SINUSOID Z 1 7 30 -SINUSOID RX 20 8 \
                   -SINUSOID RY 35 11 60 -SINUSOID RZ 50 13 -SINUSOID RZ 10 5 -RAMP 20\nEND";
    let made = motion("", records, None);
    derivatives_agree(made.as_ref(), steps(0.5, 40.0));
    // what grows from nothing begins at rest, and stands where the body stood
    let start = motion_at(made.as_ref(), 0.0);
    assert_eq!(start.pose.origin, Vector3::new(5.0, 6.0, 7.0));
    assert_eq!((start.velocity, start.acceleration), (Six::zeros(), Six::zeros()));
    // beyond the ramp: z = 7 + sin(2 pi t/7 + 30 degrees)
    let z = motion_at(made.as_ref(), 30.0).pose.origin.z;
    assert!((z - 7.0 - (TAU * 30.0 / 7.0 + PI / 6.0).sin()).abs() < 1e-14);
}

fn sea(components: &[(f64, f64, f64, f64)], ramp: f64) -> Arc<Sea> {
    let made = components.iter().map(|&(frequency, amplitude, toward, phase)| Component {
        frequency,
        number: frequency * frequency / 9.80665,
        amplitude,
        toward: [toward.cos(), toward.sin()],
        phase,
    });
    let water = Water { depth: None, level: 0.0, gravity: 9.80665, density: 1025.0 };
    Arc::new(Sea::airy(made.collect(), water, ramp, Stretching::Wheeler))
}

/// A table whose responses are straight over frequency and heading in the real parts: heave 1 at every heading with no lag.
fn table(headings: &[f64], row: impl Fn(f64, f64) -> [(f64, f64); 6]) -> String {
    let mut text = String::from("heading,period,surge,lag,sway,lag,heave,lag,roll,lag,pitch,lag,yaw,lag\n");
    for heading in headings {
        for period in [5.0, 8.0, 12.0, 20.0] {
            write!(text, "{heading},{period}").unwrap();
            for (amplitude, lag) in row(*heading, period) {
                write!(text, ",{amplitude},{lag}").unwrap();
            }
            text.push('\n');
        }
    }
    text
}

#[test]
fn body_heaving_with_wave_is_at_its_surface() {
    let file = table(&[0.0, 90.0, 180.0, 270.0], |_, _| {
        [(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]
    });
    let waves = sea(&[(0.5, 2.0, 0.3, 1.0), (0.9, 1.0, -2.0, 0.2), (0.4, 0.7, 1.1, -2.0)], 15.0);
    let made = motion(&file, "&INSTATE -LOCATE B 31 -17 0 0 0 40\nMEDIT\nPRESCRIBE B -RAO FILE.CSV\nEND", Some(&waves));
    for time in steps(0.0, 60.0) {
        let z = motion_at(made.as_ref(), time).pose.origin.z;
        assert!((z - waves.elevation(31.0, -17.0, time)).abs() < 1e-12);
    }
    derivatives_agree(made.as_ref(), steps(0.5, 40.0));
}

#[test]
fn raos_are_lagged_rotated_with_body_and_mirrored() {
    // surge follows a quarter of a period behind the crest; sway and roll answer beam seas only; of one side
    let row = |heading: f64, _: f64| {
        let beam = if heading == 90.0 { 1.0 } else { 0.0 };
        [(1.0 - beam, 90.0), (beam, 0.0), (0.0, 0.0), (3.0 * beam, 180.0), (0.0, 0.0), (0.0, 0.0)]
    };
    let file = table(&[0.0, 90.0, 180.0], row);
    let record = "&INSTATE -LOCATE B 0 0 0 0 0 90\nMEDIT\nPRESCRIBE B -RAO FILE.CSV -SYMMETRIC\nEND";
    let w = TAU / 10.0;
    // the body looks along +y; a wave that goes toward -y comes from ahead of it
    let ahead = motion(&file, record, Some(&sea(&[(w, 1.5, -PI / 2.0, 0.0)], 0.0)));
    let now = motion_at(ahead.as_ref(), 1.7);
    assert!((now.pose.origin - Vector3::y() * 1.5 * (w * 1.7 - PI / 2.0).cos()).norm() < 1e-12);
    // one that goes toward +x comes from -x, the left of the body, which is its +y: a heading of 90 degrees
    let beam = motion(&file, record, Some(&sea(&[(w, 1.5, 0.0, 0.0)], 0.0)));
    let now = motion_at(beam.as_ref(), 1.7);
    let swing = 1.5 * (w * 1.7).cos();
    assert!((now.pose.origin + Vector3::x() * swing).norm() < 1e-12, "{}", now.pose.origin);
    let position =
        |roll: f64| Pose::from_place(&windlass_base::geometry::Place::new([0.0, 0.0, 0.0, roll, 0.0, PI / 2.0])).axes;
    assert!((now.pose.axes - position(-(3.0 * swing).to_radians())).norm() < 1e-12);
    // from the other side all of it is the other way
    let other = motion(&file, record, Some(&sea(&[(w, 1.5, PI, 0.0)], 0.0)));
    let now = motion_at(other.as_ref(), 1.7);
    assert!((now.pose.origin - Vector3::x() * swing).norm() < 1e-12);
    assert!((now.pose.axes - position((3.0 * swing).to_radians())).norm() < 1e-12);
}

#[test]
fn raos_between_rows_are_linear_in_real_and_imaginary_parts() {
    // heave 1 at 8 s and i at 12 s, over frequency; the same at all headings
    let row = |_: f64, period: f64| {
        let lag = if period < 10.0 { 0.0 } else { 90.0 };
        [(0.0, 0.0), (0.0, 0.0), (1.0, lag), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]
    };
    let file = table(&[0.0, 90.0, 180.0, 270.0], row);
    let w = 0.5 * (TAU / 8.0 + TAU / 12.0);
    let made = motion(&file, "MEDIT\nPRESCRIBE B -RAO FILE.CSV\nEND", Some(&sea(&[(w, 1.0, 0.7, 0.0)], 0.0)));
    for time in [0.0, 1.0, 4.0] {
        let want = 0.5 * ((w * time).cos() + (w * time).sin());
        assert!((motion_at(made.as_ref(), time).pose.origin.z - want).abs() < 1e-12);
    }
    // shorter waves than the shortest move nothing, longer ones than the longest as that
    let short = motion(&file, "MEDIT\nPRESCRIBE B -RAO FILE.CSV\nEND", Some(&sea(&[(TAU / 4.9, 1.0, 0.7, 0.0)], 0.0)));
    assert_eq!(motion_at(short.as_ref(), 0.0).pose.origin.z, 0.0);
    let long = motion(&file, "MEDIT\nPRESCRIBE B -RAO FILE.CSV\nEND", Some(&sea(&[(TAU / 40.0, 1.0, 0.7, 0.0)], 0.0)));
    assert!((motion_at(long.as_ref(), 10.0).pose.origin.z - 1.0).abs() < 1e-12);
}

#[test]
fn rao_table_without_sea_headings_is_refused() {
    let file = table(&[0.0, 45.0, 90.0], |_, _| [(1.0, 0.0); 6]);
    let (model, errors, text) = session(&file, "MEDIT\nPRESCRIBE B -RAO FILE.CSV\nEND");
    assert_eq!(errors, 0, "{text}");
    let error = build_prescribed(&model.bodies["B"], Some(&sea(&[(0.6, 1.0, 0.0, 0.0)], 0.0)), 0.0).unwrap_err();
    assert!(error.to_string().contains("no headings within 90 degrees"), "{error}");
    assert!(error.span.is_some());
}

#[test]
fn spline_passes_its_rows_with_continuous_curvature() {
    let mut file = String::from("time,x,y,z,roll,pitch,yaw\n# rows of unlike steps\n");
    let times = [0.0, 1.0, 1.7, 3.0, 4.5, 5.0, 7.0, 8.0, 10.0];
    for t in times {
        let f = |a: f64, w: f64| a * (w * t).sin();
        let yaw = (170.0 + 30.0 * t).rem_euclid(360.0);
        writeln!(file, "{t},{},{},{},{},{},{yaw}", f(2.0, 0.9), f(1.0, 0.4), 1.0, f(15.0, 0.8), f(10.0, 0.6)).unwrap();
    }
    let made = motion(&file, "MEDIT\nPRESCRIBE B -FILE FILE.CSV\nEND", None);
    for t in times {
        let now = motion_at(made.as_ref(), t);
        assert!((now.pose.origin.x - 2.0 * (0.9 * t).sin()).abs() < 1e-12);
        // the yaw goes on by 30 degrees a second through 360; straight rows have no bend
        let heading = now.pose.axes.column(0).y.atan2(now.pose.axes.column(0).x);
        let want = (170.0 + 30.0 * t).to_radians();
        assert!((heading - want).sin().abs() < 1e-12, "{t}");
    }
    derivatives_agree(made.as_ref(), steps(0.1, 9.9).filter(|t| times.iter().all(|k| (t - k).abs() > 1e-3)));
    for t in &times[1..8] {
        let (before, after) = (motion_at(made.as_ref(), t - 1e-9), motion_at(made.as_ref(), t + 1e-9));
        assert!((before.acceleration - after.acceleration).amax() < 1e-7, "{t}");
    }
    // natural: no bend at the ends, and the body stands where the file begins
    assert!(motion_at(made.as_ref(), 0.0).acceleration.fixed_rows::<3>(0).amax() < 1e-12);
}

#[test]
fn spline_of_sine_converges_with_fourth_order() {
    // natural cubic spline through a sine that bends nowhere at its ends: error (5/384) h^4 [HALL-1968]
    let worst = |count: u32| {
        let h = TAU / f64::from(count);
        let file: String =
            (0..=count).map(|n| format!("{},{},0,0,0,0,0\n", h * f64::from(n), (h * f64::from(n)).sin())).collect();
        let made = motion(&file, "MEDIT\nPRESCRIBE B -FILE FILE.CSV\nEND", None);
        let error = |n: u32| {
            let t = TAU * f64::from(n) / 1000.0;
            (motion_at(made.as_ref(), t).pose.origin.x - t.sin()).abs()
        };
        let worst = (0..=1000).map(error).fold(0.0, f64::max);
        assert!(worst <= 5.0 / 384.0 * h.powi(4), "{worst:e}");
        worst
    };
    let ratio = worst(20) / worst(40);
    assert!((ratio - 16.0).abs() < 1.0, "{ratio}");
}

#[test]
fn body_starts_at_first_row_of_motion_file() {
    let (model, errors, _) =
        session("-1,0,0,0,0,0,0\n0,3,4,-5,1,2,33\n5,0,0,0,0,0,0\n", "MEDIT\nPRESCRIBE B -FILE FILE.CSV\nEND");
    assert_eq!(errors, 0);
    let position = model.bodies["B"].position;
    assert_eq!(position.shift, [3.0, 4.0, -5.0]);
    assert!((position.turn[2].to_degrees() - 33.0).abs() < 1e-12);
}

#[test]
fn time_outside_motion_file_is_error_with_its_span() {
    let made = motion("0,0,0,0,0,0,0\n20,1,0,0,0,0,0\n", "MEDIT\nPRESCRIBE B -FILE FILE.CSV\nEND", None);
    let error = made.motion_at(25.0).unwrap_err();
    assert_eq!(error.to_string(), "the motion of the body is given from 0 s to 20 s, and asked for at 25 s");
    assert!(made.motion_at(f64::NAN).is_err());
}

#[test]
fn invalid_motion_files_are_refused_with_line_number() {
    for (file, option, expected) in [
        ("0,0,0,0,0,0,0\n2,0,0,0,0,0,0\n2,0,0,0,0,0,0\n", "-FILE", "the time 2 of line 3 is not after 2"),
        ("0,0,0,0,0,0,0\n2,0,0,NaN,0,0,0\n", "-FILE", "line 2: value 4 is `NaN`, which is not a number"),
        ("0,0,0,0,0,0,0\n2,0,0,1e999,0,0,0\n", "-FILE", "line 2: value 4 is `1e999`"),
        ("0,0,0,0,0,0,0\n2,0,0\n", "-FILE", "line 2 has 3 values, not 7"),
        ("0,0,0,0,0,0,0\n", "-FILE", "two or more rows"),
        ("3,0,0,0,0,0,0\n4,0,0,0,0,0,0\n", "-FILE", "it goes from 3 s to 4 s, and runs begin at 0 s"),
        ("time,x,y,z,roll,pitch,yaw\n", "-FILE", "no rows of numbers"),
        ("", "-FILE", "no rows of numbers"),
        ("0,-5,1,0,1,0,1,0,1,0,1,0,1,0\n", "-RAO", "line 1: the period -5 is not positive"),
        ("0,5,1,0,1,0,1,0,1,0,1,0,1,0\n0,5,1,0,1,0,1,0,1,0,1,0,1,0\n", "-RAO", "has the period 5 twice"),
        ("0,5,1,0\n", "-RAO", "line 1 has 4 values, not 14"),
        ("270,5,1,0,1,0,1,0,1,0,1,0,1,0\n", "-SYMMETRIC -RAO", "side that -SYMMETRIC mirrors"),
    ] {
        let (model, errors, text) = session(file, &format!("MEDIT\nPRESCRIBE B {option} FILE.CSV\nEND"));
        assert_eq!(errors, 1, "{file}");
        // the page is wrapped
        let text = text.split_whitespace().collect::<Vec<_>>().join(" ");
        assert!(text.contains(expected), "{expected}: {text}");
        assert!(model.bodies["B"].prescribed.is_none());
    }
}

#[test]
fn body_with_prescribed_motion_is_fixed_in_equilibrium_until_freed() {
    let rig = "MEDIT\n&DESCRIBE BODY B\n#WEIGHT *P 10 1 1 1\n~S GSPR BOTH X 40 1000 Y 40 1000 Z 40 1000 -LEN 0\nCONNECTOR K ~S *P *G\n";
    let still = format!("{rig}PRESCRIBE B -SINUSOID X 1 10\nEND\n&INSTATE -LOCATE B 0.5 0 0\n&EQUI");
    let (model, errors, text) = session("", &still);
    assert_eq!(errors, 0, "{text}");
    assert_eq!(model.bodies["B"].position.shift, [0.5, 0.0, 0.0]);
    let free = format!(
        "{rig}PRESCRIBE B -SINUSOID X 1 10\nPRESCRIBE B -FREE\n&DESCRIBE BODY B -IGNORE RX RY RZ\nEND\n&INSTATE -LOCATE B 0.5 0 0\n&EQUI"
    );
    let (model, errors, text) = session("", &free);
    assert_eq!(errors, 0, "{text}");
    assert!(model.bodies["B"].position.shift[0].abs() < 1e-3);
}

#[test]
fn mass_on_spring_with_moving_end_matches_closed_form() {
    // 10 t on 40 kN/m: w0 = 2 rad/s; the other end moves with A sin(w t) from rest
    let (a, period) = (0.3, 5.0);
    let records = format!(
        "MEDIT\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 98.0665 1 1 1\n~S GSPR BOTH X 40 1E6 -LEN 0\n\
         CONNECTOR K ~S *C *P\nPRESCRIBE B -SINUSOID X {a} {period}\nEND"
    );
    let (model, errors, text) = session("", &records);
    assert_eq!(errors, 0, "{text}");
    let settings = RunSettings { method: trapezoidal(), ..settings(20.0, 0.01) };
    let run = runs::run(&model, settings, vec![]);
    let cart = model.bodies.get_index_of("CART").unwrap();
    let (w0, w) = (2.0, TAU / period);
    let at = run.history.layout.body(cart);
    for row in run.history.rows() {
        let t = row[0];
        let want = a * w0 * w0 / (w0 * w0 - w * w) * ((w * t).sin() - w / w0 * (w0 * t).sin());
        // the trapezoidal rule: phase of (w h)^2/12 a radian, 40 radians, and beats of 2 m
        assert!((row[at] - want).abs() < 2e-3, "{t}: {} {want}", row[at]);
    }
}

#[test]
fn body_following_waves_follows_those_of_its_new_sea() {
    let file = table(&[0.0, 90.0, 180.0, 270.0], |_, _| {
        [(0.0, 0.0), (0.0, 0.0), (1.0, 0.0), (0.0, 0.0), (0.0, 0.0), (0.0, 0.0)]
    });
    let records = "&INSTATE -LOCATE B 31 -17 0 0 0 40\nMEDIT\nPRESCRIBE B -RAO FILE.CSV\nEND\n\
                   &ENV LATER -SEA REGULAR 60 2.6 7.5\n&ENV NOW -SEA REGULAR 200 4 11";
    let (model, errors, text) = session(&file, records);
    assert_eq!(errors, 0, "{text}");
    let settings = RunSettings { method: trapezoidal(), ..settings(40.0, 0.1) };
    let change =
        Action { name: "CHANGE".into(), when: Trigger::At(20.0), what: ActionKind::Environment("LATER".into()) };
    let mut run = Run::new(&model, settings, vec![change]).unwrap();
    let seas = ["NOW", "LATER"].map(|name| Sea::new(&model, &model.environments[name]).unwrap().unwrap());
    assert_eq!(run.run(&mut SilentWatcher), Ok(Ending::Done));
    let at = run.history.layout.body(0);
    for row in run.history.rows() {
        let sea = if row[0] < 20.0 - 1e-9 { &seas[0] } else { &seas[1] };
        let want = sea.elevation(31.0, -17.0, row[0]);
        assert!((row[at + 2] - want).abs() < 1e-9, "{} {} {want}", row[0], row[at + 2]);
    }
}
