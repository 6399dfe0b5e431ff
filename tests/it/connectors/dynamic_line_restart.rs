//! Runs with rods that fail: they say when, which line and where on it or what by, keep what they have, and go on with what made them
//! fail put right.

use crate::common;

use std::fs;
use tempfile::TempDir;
use windlass::session::Session;

/// A rod of 300 m on a body that goes as a file says.
fn records(path: &str, axial: &str, restart: &str) -> String {
    format!(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 100 -TIME 30 0.1\nMEDIT\n&DESCRIBE BODY A -IGNORE RX RY RZ\n*F 0 0 -5\n\
         ~L ROD 120 60 -LEN 300 -REFINE 20 -EI 0 {axial}\nCONNECTOR L -ANC 0 260 ~L *F\nPRESCRIBE A -FILE {path}\nEND\nTDOM {restart}\n"
    )
}

/// A file of places x by time, both in seconds and metres.
fn path(folder: &TempDir, rows: impl Iterator<Item = (f64, f64)>) -> String {
    let lines: String = rows.map(|(t, x)| format!("{t},{x},0,0,0,0,0\n")).collect();
    let position = folder.path().join("path.csv");
    fs::write(&position, format!("time,x,y,z,roll,pitch,yaw\n{lines}")).unwrap();
    position.to_str().unwrap().to_string()
}

/// A session of records, and what of an earlier one is on disk in its place.
fn run(text: String, earlier: Option<&TempDir>) -> (Session, TempDir) {
    let (mut session, _, folder) = common::session();
    if let Some(earlier) = earlier {
        fs::create_dir_all(folder.path().join("job.ans")).unwrap();
        fs::copy(earlier.path().join("job.ans/TDOM.run"), folder.path().join("job.ans/TDOM.run")).unwrap();
    }
    session.open("test", text);
    session.run();
    (session, folder)
}

/// The only error, with its help.
fn error(session: &Session) -> String {
    assert_eq!(session.errors, 1, "{:?}", session.reports);
    format!("{:?}", session.reports.last().unwrap())
}

/// The last row: its time, and the pull on the body (N).
fn last(session: &Session) -> (f64, f64) {
    let history = &session.job.run.as_ref().unwrap().history;
    let at = history.layout.wrench(0, 0).unwrap();
    let row = history.rows().last().unwrap();
    (row[0], row[at..at + 3].iter().map(|v| v * v).sum::<f64>().sqrt())
}

#[test]
fn run_with_short_motion_file_restarts_with_longer_one() {
    let folder = tempfile::tempdir().unwrap();
    let even = |end: u32| (0..=end).map(|n| (10.0 * f64::from(n), f64::from(n)));
    let file = path(&folder, even(2));
    let (short, kept) = run(records(&file, "", ""), None);
    let message = error(&short);
    assert!(message.contains("from 0 s to 20 s") && message.contains("asked for at 20.0"), "{message}");
    // all up to there is there
    let (time, _) = last(&short);
    assert!((time - 20.0).abs() < 1e-9, "{time}");
    path(&folder, even(4));
    let (long, _kept) = run(records(&file, "", ""), None);
    let (again, _kept) = run(records(&file, "", "-RESTART"), Some(&kept));
    assert_eq!((long.errors, again.errors), (0, 0), "{:?}", again.reports);
    let [(whole, pull), (end, found)] = [&long, &again].map(last);
    assert!((whole - 30.0).abs() < 1e-9 && whole == end);
    // the step in which it failed was tried in parts
    assert!((found / pull - 1.0).abs() < 1e-6, "{found} {pull}");
    let rows = |s: &Session| s.job.run.as_ref().unwrap().history.len();
    assert_eq!(rows(&long), rows(&again));
}

#[test]
fn overload_error_reports_time_and_element_and_survives_restart() {
    // tension over strain has a most of 2.5 MN at 5 %, beyond which nothing holds the line
    let folder = tempfile::tempdir().unwrap();
    let rows = (0..=160).map(|n| 0.25 * f64::from(n)).map(|t| (t, -6.0 * (t - 5.0f64).max(0.0)));
    let file = path(&folder, rows);
    let (broken, kept) = run(records(&file, "-EA 1E8 -1E9", ""), None);
    let message = error(&broken);
    assert!(message.contains("connector L") && message.contains("worst at element "), "{message}");
    let number = |before: &str| -> f64 {
        let rest = message.split(before).nth(1).unwrap();
        rest.chars().take_while(|c| c.is_ascii_digit() || *c == '.').collect::<String>().parse().unwrap()
    };
    let (failed, element) = (number("no solution at "), number("worst at element "));
    assert!((1.0..=20.0).contains(&element), "{element}");
    // the rows end before it, within a step, and hold the pull that was the most
    let history = &broken.job.run.as_ref().unwrap().history;
    let (time, _) = last(&broken);
    assert!(failed > time && failed <= time + 0.1 + 1e-9 && time > 10.0, "{failed} {time}");
    let at = history.layout.wrench(0, 0).unwrap();
    let pull = |row: &[f64]| row[at..at + 3].iter().map(|v| v * v).sum::<f64>().sqrt();
    let most = history.rows().map(pull).fold(0.0, f64::max);
    assert!((2e6..2.6e6).contains(&most), "{most}");
    // what was kept is what it was: nothing has been put right, and the same is reported
    let (again, _kept) = run(records(&file, "-EA 1E8 -1E9", "-RESTART"), Some(&kept));
    assert_eq!(error(&again).split(" by steps").next(), message.split(" by steps").next());
    let bits =
        |s: &Session| -> Vec<u64> { s.job.run.as_ref().unwrap().history.values.iter().map(|v| v.to_bits()).collect() };
    assert!(bits(&broken) == bits(&again));
    // it began where the other had come to
    let from = again.reports.iter().find(|r| r.message.starts_with("goes on from ")).unwrap();
    let from: f64 = from.message[13..].split(' ').next().unwrap().parse().unwrap();
    assert!(from >= time && from < failed, "{from}");
}

#[test]
fn run_with_energy_balance_refuses_restart_without_it() {
    let folder = tempfile::tempdir().unwrap();
    let file = path(&folder, (0..=6).map(|n| (5.0 * f64::from(n), 0.1 * f64::from(n))));
    for (begun, goes_on, text) in
        [("-BALANCE", "-RESTART 10", "begun with -BALANCE"), ("", "-BALANCE -RESTART 10", "begun without")]
    {
        let (first, kept) = run(records(&file, "", begun), None);
        assert_eq!(first.errors, 0, "{:?}", first.reports);
        let (again, _kept) = run(records(&file, "", goes_on), Some(&kept));
        assert!(error(&again).contains(text), "{}", error(&again));
    }
}

#[test]
fn winch_hauling_to_its_end_stops_run_with_action_line_and_time() {
    // 80 m at 2 m/s from 10 s on, and at a rate whose last step ends with a little left
    for (step, rate, time) in [(0.05, "2", "50"), (0.05, "1.999", "50.02001"), (0.08, "3", "36.666")] {
        let records = format!(
            "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100 -TIME 60 {step}\nMEDIT\n&DESCRIBE BODY CRANE -IGNORE X Y Z RX RY RZ\n\
             *TIP 0 0 20\n&DESCRIBE BODY LOAD -IGNORE RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 500 1 1 1\n\
             ~WIRE ROD 60 30 -LEN 80 -REFINE 8 -EI 0 -AX_DAMPING 2000\nCONNECTOR HOIST ~WIRE *TIP *CG\nEND\n\
             &INSTATE -LOCATE LOAD 0 0 -60\n&EQUI\n&ACTION PULL -AT 10 -WINCH HOIST -{rate}\nTDOM\n"
        );
        let (session, _kept) = run(records, None);
        let message = error(&session);
        for text in ["HOIST", "by action PULL", &format!("at {time}")] {
            assert!(message.contains(text), "{step} {rate}: {message}");
        }
    }
}
