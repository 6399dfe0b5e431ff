//! What a run says of its own steps, against closed forms of the schemes.

#![allow(clippy::unwrap_used)]

use crate::common;
use crate::common::run as runs;
use runs::{model, run, settings, trapezoidal};
use std::f64::consts::TAU;
use windlass_model::Model;
use windlass_solve::run_tables::{warning_of_accuracy, warnings_of_step};
use windlass_solve::time::{History, Method, Run, RunSettings, TimeScheme};

/// 1000 kg on a spring of 4000 N/m along X, 2 rad/s, drawn out 0.5 m; a second body of 1 kg hangs beside it, at rest.
fn mass_on_a_spring() -> Model {
    let weight = 1000.0 * 9.80665;
    model(&format!(
        "MEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C {weight} 1 1 1\n\
         ~SPRING GSPR BOTH X 4000 1E9 -LEN 0\nCONNECTOR S ~SPRING *C *G\nEND\n&INSTATE -LOCATE CART 0.5 0 0\n"
    ))
}

fn run_oscillator(method: Method, steps: f64, periods: f64) -> Run {
    let period = TAU / 2.0;
    run(&mass_on_a_spring(), RunSettings { method, ..settings(periods * period, period / steps) }, vec![])
}

/// Period and damping (share of critical) of an oscillation, by a fit of its zeros and of its envelope.
fn fit_period_and_damping(history: &History) -> (f64, f64) {
    let at = history.layout.body(0);
    let rows: Vec<(f64, f64, f64)> = history.rows().map(|r| (r[0], r[at], r[at + 6])).collect();
    // phase and amplitude of x and v/w, unwrapped; the phase of each round is the same however x and v are scaled
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    let phase = |r: &(f64, f64, f64)| (-r.2 / 2.0).atan2(r.1);
    let mut turned = 0.0;
    for pair in rows.windows(2) {
        turned += (phase(&pair[1]) - phase(&pair[0])).rem_euclid(TAU);
    }
    let size = |r: &(f64, f64, f64)| r.1.hypot(r.2 / 2.0);
    let decay = (size(&first) / size(&last)).ln();
    (TAU * (last.0 - first.0) / turned, decay / turned.hypot(decay))
}

#[test]
fn trapezoidal_period_error_matches_closed_form() {
    // tan(W h/2) = w h/2 [HUGHES-1987 9.1]
    for steps in [8.0, 12.0, 40.0] {
        let made = run_oscillator(trapezoidal(), steps, 60.0);
        let worst = made.worst_followed().unwrap();
        let angle: f64 = TAU / steps;
        let exact = angle / (2.0 * (0.5 * angle).atan()) - 1.0;
        // over n periods and a part of one the integral of a squared sine is off by 1/(4 pi n) of itself, one way for the velocity
        // and the other for the acceleration; the instant at which the run begins is not a step
        let bound = 2.0 / (2.0 * TAU * 60.0) + 2.0 / (60.0 * steps);
        assert!((worst.distortion.period / exact - 1.0).abs() < bound, "{steps} {worst:?} {exact}");
        assert!((worst.period / (TAU / 2.0) - 1.0).abs() < 2e-3, "{worst:?}");
        assert_eq!((worst.body.as_str(), worst.dof), ("CART", "X"));
    }
}

#[test]
fn generalised_alpha_error_and_damping_match_the_oscillation() {
    // beside it what numpy finds as eigenvalues of the matrix of the scheme's form of [CHUNG-HULBERT-1993]
    for (rho, steps, period, damping) in
        [(0.2, 10.0, 0.080910, 0.022552), (0.2, 20.0, 0.023147, 0.003954), (0.5, 12.0, 0.032954, 0.002313)]
    {
        let made = run_oscillator(Method::Implicit(TimeScheme::generalised_alpha(rho)), steps, 16.0);
        let worst = made.worst_followed().unwrap();
        let (own, decay) = fit_period_and_damping(&made.history);
        let own = own / (TAU / 2.0) - 1.0;
        // the first steps settle into the oscillation of the scheme; velocity and acceleration of a decay are not quite those of a sine
        assert!((own / period - 1.0).abs() < 0.03 && (decay / damping - 1.0).abs() < 0.03, "{own} {decay}");
        assert!((worst.distortion.period / period - 1.0).abs() < 0.08, "{worst:?}");
        assert!((worst.distortion.damping / damping - 1.0).abs() < 0.12, "{worst:?}");
    }
}

#[test]
fn step_error_matches_first_term_of_closed_form() {
    // the trapezoidal rule misses x by h^3 w^3 A/12 in a step, and the next term is (w h)^2 of that
    let (steps, w, amplitude) = (40.0, 2.0f64, 0.5);
    let made = run_oscillator(trapezoidal(), steps, 10.0);
    let angle: f64 = TAU / steps;
    let exact = amplitude * angle.powi(3) / 12.0;
    assert!((made.accuracy.largest.0 / exact - 1.0).abs() < angle * angle, "{} {exact} {w}", made.accuracy.largest.0);
}

#[test]
fn step_too_long_for_motion_is_warned_and_adequate_step_is_not() {
    assert_eq!(warning_of_accuracy(&run_oscillator(Method::default(), 20.0, 10.0)), None);
    let said = warning_of_accuracy(&run_oscillator(Method::default(), 5.0, 20.0)).unwrap();
    assert!(said.contains("the motion of CART in X") && said.contains("its period of 3.1"), "{said}");
}

/// A box of 20 x 20 x 10 m with the pressure of waves alone, in waves of 3 m and 8 s, with a step (s).
fn floating_box(step: f64) -> Run {
    let records = format!(
        "&DIMEN -DIMEN METERS KN\n&PARAMETER -ACCEPT_MISSING YES\n&ENV -DEPTH 100 -TIME 60 {step} -SEA ISSC 180 3 8\nMEDIT\n&DESCRIBE BODY B\n*G 0 0 -1\n\
         #WEIGHT *G 20110 7 7 8\nEND\n&SURFACE\nBLOCK H -10 -10 -5 10 10 5 -DIFTYPE FK\nEND\nTDOM\n"
    );
    let (mut session, _, _folder) = common::session();
    session.open("test", records);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session.job.run.take().unwrap()
}

#[test]
fn floating_box_with_step_beyond_heave_period_is_named_in_warning() {
    let made = floating_box(5.0);
    let said = warnings_of_step(&made);
    assert!(said.iter().any(|s| s.contains("too long for the waves")), "{said:?}");
    assert!(said.iter().any(|s| s.contains("natural period of B in ")), "{said:?}");
    let said = warning_of_accuracy(&made).unwrap();
    assert!(said.contains("the motion of B in "), "{said}");
    let made = floating_box(0.4);
    assert_eq!((warnings_of_step(&made), warning_of_accuracy(&made)), (vec![], None));
}

#[test]
fn natural_periods_at_start_match_springs_and_masses() {
    // 2 rad/s
    let made = run_oscillator(Method::default(), 20.0, 1.0);
    let [only] = made.resolution.natural.as_slice() else { panic!("{:?}", made.resolution) };
    assert!((only.period - TAU / 2.0).abs() < 1e-9 && only.dof == "X");
}

#[test]
fn very_long_run_is_announced() {
    // 1e12 steps of 1e-5 s: 1e7 s, or 2778 h
    let long = RunSettings { keep: false, ..settings(1e9, 1e-3) };
    let said = warnings_of_step(&Run::new(&mass_on_a_spring(), long, vec![]).unwrap());
    assert!(said.len() == 1 && said[0].contains("1.0e12 steps") && said[0].contains("2778 hours"), "{said:?}");
}
