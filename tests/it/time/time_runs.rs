//! Runs as users make them: going on after they were cut off, lines that break, winches, slack hawsers, lines that swing a body.

use crate::common;

use std::fs;
use windlass::session::Session;

/// A box on four chains, away from rest; `options` are those of the chain, `time` that of the environment.
fn moored_records(options: &str, time: &str) -> String {
    let mut text = String::new();
    text.push_str(&format!(
        "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 {time}\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE Z RX RY\n*CG 0 0 0\n#WEIGHT *CG 50000 10 20 20\n\
         #DAMP *CG 100 100 0 0 0 5000\n~CHAIN B_CAT 100 {options} -LEN 400 -DEPANCHOR 100\n"
    ));
    for (n, (x, y)) in [(20, 0), (0, 10), (-20, 0), (0, -10)].into_iter().enumerate() {
        text.push_str(&format!("*F{n} {x} {y} 0\nCONNECTOR L{n} -ANC {} 370 ~CHAIN *F{n}\n", 90 * n));
    }
    text.push_str("END\n&INSTATE -LOCATE SHIP 5 2 0 0 0 3\n");
    text
}

fn run(session: &mut Session, records: &str) {
    let errors = session.errors;
    session.open("test", records.to_string());
    session.run();
    assert_eq!(session.errors, errors, "{:?}", session.reports);
}

fn rows(session: &Session) -> Vec<u64> {
    session.job.run.as_ref().unwrap().history.values.iter().map(|v| v.to_bits()).collect()
}

#[test]
fn run_cut_off_anywhere_restarts_with_digits_of_uninterrupted_run() {
    let time = "-TIME 150 0.1";
    let action = "&ACTION GONE -AT 62.35 -RELEASE L0\n&ACTION PAY -AT 20 -WINCH L2 0.1 405\n";
    let records = format!("{}{action}", moored_records("EXACT", time));
    let (mut whole, _, folder) = common::session();
    run(&mut whole, &format!("{records}TDOM"));
    let log = folder.path().join("job.ans").join("TDOM.run");
    let bytes = fs::read(&log).unwrap();
    let unbroken = rows(&whole);
    // killed while a block was being written, at several places
    for share in [0.5, 0.7, 0.93, 0.999] {
        let (mut again, _, folder) = common::session();
        let job = folder.path().join("job.ans");
        fs::create_dir_all(&job).unwrap();
        let cut = &bytes[..(bytes.len() as f64 * share) as usize];
        fs::write(job.join("TDOM.run"), cut).unwrap();
        run(&mut again, &format!("{records}TDOM -RESTART"));
        assert!(rows(&again) == unbroken, "cut at {share}");
        assert_eq!(fs::read(job.join("TDOM.run")).unwrap().len(), bytes.len());
    }
}

#[test]
fn run_extended_beyond_its_end_matches_longer_run() {
    let (mut whole, _, _folder) = common::session();
    run(&mut whole, &format!("{}TDOM", moored_records("EXACT", "-TIME 120 0.1")));
    let (mut parts, _, _other) = common::session();
    run(&mut parts, &format!("{}TDOM\n", moored_records("EXACT", "-TIME 70 0.1")));
    run(&mut parts, "&ENV -DEPTH 100 -TIME 120 0.1\nTDOM -RESTART 60\n");
    assert!(rows(&whole) == rows(&parts));
}

#[test]
fn run_of_another_model_is_refused_and_left_unchanged() {
    let (mut session, _, folder) = common::session();
    run(&mut session, &format!("{}TDOM", moored_records("EXACT", "-TIME 20 0.1")));
    let log = folder.path().join("job.ans").join("TDOM.run");
    let before = fs::read(&log).unwrap();
    for other in ["&ENV -DEPTH 100 -TIME 20 0.05\n", "&ENV -DEPTH 100 -TIME 20 0.1\n&CONNECTOR L1 -L_DELTA 1\n"] {
        session.open("test", format!("{other}TDOM -RESTART\n"));
        session.run();
        let said = session.reports.last().unwrap().message.clone();
        assert!(said.contains("another model"), "{said}");
    }
    assert_eq!(session.errors, 2);
    assert_eq!(fs::read(&log).unwrap(), before);
}

#[test]
fn invalid_run_files_are_refused_without_panic() {
    let (mut session, _, folder) = common::session();
    run(&mut session, &moored_records("EXACT", "-TIME 20 0.1"));
    let job = folder.path().join("job.ans");
    fs::create_dir_all(&job).unwrap();
    let hostile: [&[u8]; 4] = [b"", b"WINDRUN\x03", b"something else that is long enough to have a head", &[0xff; 64]];
    for (n, bytes) in hostile.iter().enumerate() {
        fs::write(job.join("TDOM.run"), bytes).unwrap();
        session.open("test", "TDOM -RESTART\n");
        session.run();
        assert_eq!(session.errors, n as i64 + 1);
    }
    let mut head = b"WINDRUN\x03".to_vec();
    head.extend_from_slice(&[0xff; 16]);
    head.push(b'S');
    head.extend_from_slice(&u64::MAX.to_le_bytes());
    fs::write(job.join("TDOM.run"), head).unwrap();
    session.open("test", "TDOM -RESTART\n");
    session.run();
    assert_eq!(session.errors, 5);
}

/// Energy of the body and the lines, by the work of the lines from the start: kinetic energy minus work must not change.
fn balance(session: &Session) -> (f64, f64) {
    let made = session.job.run.as_ref().unwrap();
    let history = &made.history;
    let (body, mass) = (history.layout.body(0), 50000e3 / 9.80665);
    let mut rows = history.rows();
    let first: Vec<f64> = rows.next().unwrap().to_vec();
    let flex = history.layout.category(0, windlass_hydro::Category::FlexConnectors).unwrap();
    let (mut work, mut before, mut worst, mut size) = (0.0, first, 0.0f64, 0.0f64);
    for row in rows {
        work += 0.5 * (row[flex] + before[flex]) * (row[body] - before[body]);
        let kinetic = 0.5 * mass * row[body + 6] * row[body + 6];
        worst = worst.max((kinetic - work).abs());
        size = size.max(kinetic);
        before = row.to_vec();
    }
    (worst, size)
}

#[test]
fn surge_on_catenaries_keeps_energy_to_1e_3_over_100_periods() {
    // no damping, trapezoidal rule: what the lines do in work is there in motion
    let records = moored_records("EXACT", "-TIME 4000 0.5")
        .replace("#DAMP *CG 100 100 0 0 0 5000\n", "")
        .replace("-IGNORE Z RX RY", "-IGNORE Y Z RX RY RZ");
    let (mut session, _, _folder) = common::session();
    run(&mut session, &format!("{records}&INSTATE -LOCATE SHIP 5 0 0\nTDOM -NEWMARK YES 0.25 0.5"));
    let (worst, size) = balance(&session);
    assert!(worst <= 1e-3 * size, "{worst} {size}");
}

#[test]
fn line_breaking_at_its_tension_releases_body_with_its_momentum() {
    let records = "&DIMEN -DIMEN METERS N\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 9806.65 1 1 1\n\
                   ~S GSPR BOTH X 4000 1E9 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&INSTATE -LOCATE CART 0 0 0\n&ENV -TIME 4 0.001\n";
    let (mut session, _, _folder) = common::session();
    // drawn to 0.5 m and let go, it is stretched with 1000 N at 0.25 m on the far side: v = w sqrt(0.5^2 - 0.25^2)
    run(
        &mut session,
        &format!("{records}&INSTATE -LOCATE CART -0.5 0 0\n&ACTION SNAP -ABOVE CART X 0.25 -RELEASE K\nTDOM"),
    );
    let made = session.job.run.as_ref().unwrap();
    let last = made.motions()[0].velocity[0];
    let speed = 2.0 * (0.25f64 - 0.0625).sqrt();
    // the condition is met within a 64th of the step
    assert!((last / speed - 1.0).abs() < 1e-3, "{last} {speed}");
    assert!(made.fired[0].is_some());
}

/// The largest force of a hawser that a drifting body draws taut, with this step.
fn snap(step: f64) -> f64 {
    let (mut session, _, _folder) = common::session();
    run(
        &mut session,
        &format!(
            "&DIMEN -DIMEN METERS N\nMEDIT\n*G 0 0 0\n*FAR 5 0 0\n&DESCRIBE BODY TUG -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 9806650 1 1 1\n\
             ~H SL_ELEM 100 TENSION -LEN 20 -EMOD 100\nCONNECTOR HAWSER ~H *C *G\n~P GSPR BOTH X 10000 1E9 -LEN 0\nCONNECTOR PULL ~P *C *FAR\nEND\n\
             &INSTATE -LOCATE TUG -19 0 0\n&ENV -TIME 60 {step}\nTDOM"
        ),
    );
    let history = &session.job.run.as_ref().unwrap().history;
    let at = history.layout.wrench(0, 0).unwrap();
    history.series(at).iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

#[test]
fn slack_hawser_snap_converges_with_step() {
    let forces = [0.4, 0.2, 0.1, 0.05, 0.025].map(snap);
    // taut at 20 m with the speed of the spring's swing of 24 m about 5 m; then spring and hawser together
    let (k, m, pull) = (100e6 * std::f64::consts::FRAC_PI_4 * 0.01 / 20.0, 1e6, 1e4);
    let speed2 = pull / m * (24.0f64 * 24.0 - 15.0 * 15.0);
    // energy: m v2/2 = (k + p) d2/2 + 15 p d
    let stretch = (-15.0 * pull + ((15.0 * pull).powi(2) + (k + pull) * m * speed2).sqrt()) / (k + pull);
    let off: Vec<f64> = forces.iter().map(|f| (f / (k * stretch) - 1.0).abs()).collect();
    assert!(off[4] < 2e-4 && off[4] < off[0] / 20.0, "{off:?}");
}

#[test]
fn event_is_located_within_64th_of_a_step_and_ends_run() {
    // x = -0.5 cos(2 t) rises through 0.25 m at t = 1.0472 s
    let records = "&DIMEN -DIMEN METERS N\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 9806.65 1 1 1\n\
                   ~S GSPR BOTH X 4000 1E9 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&INSTATE -LOCATE CART -0.5 0 0\n&ENV -TIME 4 0.1\n";
    let (mut session, _, _folder) = common::session();
    run(&mut session, &format!("{records}&ACTION FAR -ABOVE CART X 0.25 -STOP\nTDOM"));
    let made = session.job.run.as_ref().unwrap();
    let exact = std::f64::consts::PI / 3.0;
    // late by the 64th of a step, and by the scheme's own error of the period: (w h)^2/12 = 0.33 %
    assert!((made.time() - exact).abs() < 0.1 / 64.0 + 0.0035 * exact, "{}", made.time());
    assert!(made.fired[0] == Some(made.time()) && made.history.times().last() == Some(&made.time()));
    // a time between two steps ends a run, too
    run(&mut session, "&ACTION -CLEAR\n&ACTION END -AT 1.234 -STOP\nTDOM");
    assert!((session.job.run.as_ref().unwrap().time() - 1.234).abs() < 1e-12);
}

#[test]
fn winch_keeps_its_rate_in_bisected_steps() {
    let (mut session, _, _folder) = common::session();
    let records = moored_records("EXACT", "-TIME 10 0.5");
    run(
        &mut session,
        &format!(
            "{records}&ACTION PAY -AT 2 -WINCH L2 0.5\n&ACTION FAR -BELOW SHIP X 4.9 -RELEASE L0\nTDOM -ADAPTIVE 1E-6"
        ),
    );
    let made = session.job.run.as_ref().unwrap();
    assert!(made.counts.steps > 40 && made.fired.iter().all(Option::is_some), "{:?} {:?}", made.counts, made.fired);
    let at = made.history.layout.links.iter().find(|l| l.name == "L2").unwrap().active + 1;
    for (time, length) in made.history.times().iter().zip(made.history.series(at)) {
        assert!((length - (400.0 + 0.5 * (time - 2.0).max(0.0))).abs() < 1e-9, "{time} {length}");
    }
}

#[test]
fn winch_pays_out_at_its_rate_and_stops_at_its_length() {
    let (mut session, _, _folder) = common::session();
    run(&mut session, &format!("{}&ACTION PAY -AT 5 -WINCH L2 0.5 410\nTDOM", moored_records("EXACT", "-TIME 60 0.1")));
    let history = &session.job.run.as_ref().unwrap().history;
    let at = history.layout.links.iter().find(|l| l.name == "L2").unwrap().active + 1;
    for (time, length) in history.times().iter().zip(history.series(at)) {
        let exact = (400.0 + 0.5 * (time - 5.0).max(0.0)).min(410.0);
        assert!((length - exact).abs() < 1e-9, "{time} {length}");
    }
}

#[test]
fn same_sea_gives_same_file_alone_and_beside_a_parallel_run() {
    let tanker = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/data/tanker/tanker");
    let records = moored_records("", "-SEA JONSWAP 180 4 9 -RAMP 10 -TIME 60 0.1");
    let records = format!("{}TDOM", records.replace("#DAMP", &format!("DATABASE SHIP -WAMIT {tanker}\n#DAMP")));
    let made = || {
        let (mut session, _, folder) = common::session();
        run(&mut session, &records);
        fs::read(folder.path().join("job.ans").join("TDOM.run")).unwrap()
    };
    let alone = made();
    let both = std::thread::scope(|s| [s.spawn(made), s.spawn(made)].map(|t| t.join().unwrap()));
    assert!(both.iter().all(|file| *file == alone));
}
