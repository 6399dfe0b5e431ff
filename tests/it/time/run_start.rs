//! Runs that begin later than at 0 s (-START of `&ENV`, card TIME of deck 16): waves and actions are those of their times.

use crate::common::run::{model, run, settings};
use crate::common::{self, assert_share};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use windlass_hydro::Category;

const G: f64 = 9.806_65;

/// A pile of 1.5 m that nothing moves, 50 m deep, in a wave of 1 cm and 12 s along X: the times of a run of 20 s from 100 s (s), and the
/// force of the wave along X there (N).
fn wave_force(options: &str) -> Vec<(f64, f64)> {
    let records = "MEDIT\n&DESCRIBE BODY B\n*A 0 0 -50\n*C 0 0 20\n#WEIGHT *A 1000 1 1 1\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\nEND\n\
                   &SURFACE\nTUBE PILE *A *C 1500 -CD 0 -CA 0.9\nEND";
    let sea = format!("&DEFAULT -WATER 1025\n&ENV -SEA REGULAR 180 0.02 12 -TIME 20 0.5 -START 100 {options}");
    let made = run(&model(&format!("{records}\n{sea}")), settings(20.0, 0.5), vec![]);
    let along = |category| made.history.series(made.history.layout.category(0, category).unwrap());
    // what is slow of it has a category of its own
    let sums = along(Category::Wave).into_iter().zip(along(Category::WaveMean)).map(|(fast, slow)| fast + slow);
    made.history.times().into_iter().zip(sums).collect()
}

const FREQUENCY: f64 = TAU / 12.0;

/// Largest force of the wave (N), of deep water: `rho (1 + Ca) A a g (1 - exp(-k d))`.
fn largest() -> f64 {
    let number = FREQUENCY * FREQUENCY / G;
    1025.0 * 1.9 * FRAC_PI_4 * 1.5 * 1.5 * 0.01 * G * (1.0 - (-50.0 * number).exp())
}

/// The force of the wave (N), whose crest is at x = 0 at 0 s: that of the change of its velocity, cos(w t).
fn morison(time: f64) -> f64 {
    -largest() * (FREQUENCY * time).sin()
}

#[test]
fn wave_force_on_fixed_pile_is_that_of_absolute_time() {
    let rows = wave_force("-RAMP 0");
    assert_eq!((rows[0].0, rows.last().unwrap().0, rows.len()), (100.0, 120.0, 41));
    for (time, force) in rows {
        // the wave wets a centimetre more or less, of 36 m over which its force falls by e
        assert!((force - morison(time)).abs() < 1e-3 * largest(), "{time}: {force} {}", morison(time));
    }
}

#[test]
fn ramp_grows_from_the_start_of_the_run() {
    for (time, force) in wave_force("-RAMP 8") {
        // the velocity grows by (1 - cos(pi t/8))/2, and its change with it
        let (sin, cos) = (PI * ((time - 100.0) / 8.0).min(1.0)).sin_cos();
        let (grown, rate) = (0.5 * (1.0 - cos), 0.5 * PI / 8.0 * sin);
        let want = grown * morison(time) + rate * largest() / FREQUENCY * (FREQUENCY * time).cos();
        assert!((force - want).abs() < 1e-3 * largest(), "{time}: {force} {want}");
    }
}

/// A session after records about a body that is moved by 3 m sin(2 pi t/10), in metres.
fn moved(environment: &str, more: &str) -> (windlass::session::Session, String) {
    let (mut session, screen, _folder) = common::session();
    let body = "MEDIT\n*G 0 0 0\n&DESCRIBE BODY B\n*B 0 0 0\n";
    let motion = "PRESCRIBE B -SINUSOID X 3 10 -RAMP 20\n~S GSPR BOTH X 40 -LEN 0\nCONNECTOR K ~S *B *G\nEND";
    session.open("test", format!("&DIMEN -DIMEN METERS KN\n{environment}\n{body}{motion}\n{more}\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    (session, screen.text())
}

#[test]
fn statistics_and_given_motion_count_from_the_start() {
    let (session, text) =
        moved("&ENV -TIME 70 0.1 20 -START 102.5", "TDOM\nPRCPOST\nTRAJECTORY B\nSTATISTIC Time X\nEND\nEND");
    let made = session.job.run.as_ref().unwrap();
    let rows: Vec<(f64, f64)> = made.history.times().into_iter().zip(made.history.series(1)).collect();
    // nothing has grown at the start, where the sine is at its crest; all of it 20 s later
    assert_eq!((rows[0].0, rows[0].1), (102.5, 0.0));
    for (time, x) in rows.iter().filter(|(time, _)| *time >= 122.5) {
        assert!((x - 3.0 * (TAU * time / 10.0).sin()).abs() < 1e-9, "{time} {x}");
    }
    // five whole periods from crest to crest, 501 instants: the mean is a crest more, 3/501, the square 9 x 251/501 less that of the mean
    let line =
        text.split_once("Shape and Cycles").unwrap().0.lines().rfind(|line| line.contains("Location: X")).unwrap();
    let numbers: Vec<f64> = line.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    assert_eq!(numbers[0], 501.0, "{line}");
    assert!((numbers[1] - 3.0 / 501.0).abs() < 1e-5, "{line}");
    assert_share(numbers[2], (9.0 * 251.0 / 501.0 - (3.0f64 / 501.0).powi(2)).sqrt(), 1e-5);
}

#[test]
fn actions_happen_at_their_times_or_before_the_first_instant() {
    let acts = |time: &str| {
        let (session, text) = moved("&ENV -TIME 30 0.1 -START 100", &format!("&ACTION GO -AT {time} -RELEASE K\nTDOM"));
        let made = session.job.run.as_ref().unwrap();
        let active = made.history.layout.links[0].active;
        let first = made.history.rows().find(|row| row[active] == 0.0).map(|row| row[0]);
        (made.fired[0], first, format!("{text} {:?}", session.reports))
    };
    let (fired, first, _) = acts("107.25");
    assert!((fired.unwrap() - 107.25).abs() < 1e-9 && (first.unwrap() - 107.3).abs() < 1e-9, "{fired:?} {first:?}");
    // it is released already
    assert_eq!((acts("40").0, acts("40").1), (Some(100.0), Some(100.0)));
    let (fired, first, text) = acts("131");
    assert_eq!((fired, first), (None, None));
    assert!(text.contains("the run ends at 130 s, before the actions GO at 131 s"), "{text}");
    // the page of the run says when it began
    let line = text.lines().find(|line| line.contains("   Start ")).unwrap_or_else(|| panic!("{text}"));
    assert!(line.ends_with("= 100.00 s"), "{line}");
}

#[test]
fn run_from_a_later_start_goes_on_from_its_file() {
    let (mut session, _, _folder) = common::session();
    let records = "&DIMEN -DIMEN METERS KN\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*B 0 0 0\n#WEIGHT *B 100 1 1 1\n\
                   ~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *B *G\nEND\n&INSTATE -LOCATE B 0.5 0 0\n";
    let text = format!("{records}&ENV -TIME 60 0.1 -START 50\nTDOM\n&ENV -TIME 90 0.1 -START 50\nTDOM -RESTART");
    session.open("test", text);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let made = session.job.run.as_ref().unwrap();
    assert_eq!((made.history.times()[0], made.time(), made.history.len()), (50.0, 140.0, 901));
}
