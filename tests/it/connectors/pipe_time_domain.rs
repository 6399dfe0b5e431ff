//! A pipe on its supports under way: it stays where it rests, its tensioner keeps its limits, rollers do not pull, the energy balance closes.

use crate::common;

use std::fs;
use tempfile::TempDir;
use windlass::session::Session;
use windlass_base::diagnostic::Severity;
use windlass_base::table::Cell;
use windlass_hydro::Category;
use windlass_model::PIPE;
use windlass_solve::results::along::{self, LineResults};
use windlass_solve::results::{self, Magnitude};
use windlass_solve::time::Run;

/// Records of a pipe over five rollers of a barge that moves as it is reported, in metres and newtons, up to its TDOM.
fn records(limits: [f64; 2], motion: &str) -> String {
    format!(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 50 -TIME 40 0.1\nMEDIT\n&DESCRIBE BODY BARGE\n*R1 35.65 0 1.70\n*R2 26.82 0 3.58\n\
         *R3 17.97 0 4.92\n*R4 9 0 5.73\n*R5 0 0 6\n~ROLL ROLLER COMPRESSION Z 2E7\n~PIPE ROD 323.9 15.9 -LEN 12 -WTPLEN 1200\n\
         CONNECTOR R1 ~ROLL *R1\nCONNECTOR R2 ~ROLL *R2\nCONNECTOR R3 ~ROLL *R3\nCONNECTOR R4 ~ROLL *R4\nCONNECTOR R5 ~ROLL *R5\n\
         PIPE ~PIPE R1 R2 R3 R4 R5 -PIPE_TENSION {} {}\nPRESCRIBE BARGE {motion}\nEND\n",
        limits[0], limits[1]
    )
}

/// A session after records, none of them refused, with the folder of its answers.
fn run_records(records: String, earlier: Option<&[u8]>) -> (Session, TempDir) {
    let (mut session, screen, folder) = common::session();
    if let Some(bytes) = earlier {
        fs::create_dir_all(folder.path().join("job.ans")).unwrap();
        fs::write(folder.path().join("job.ans/TDOM.run"), bytes).unwrap();
    }
    session.open("records", records);
    session.run();
    assert!(session.reports.iter().all(|r| r.severity != Severity::Error), "{}", screen.text());
    (session, folder)
}

/// A run of it.
fn run_pipelay(limits: [f64; 2], motion: &str, tdom: &str) -> Session {
    run_records(format!("{}TDOM -ALONG 1 {tdom}\n", records(limits, motion)), None).0
}

/// Time, tension at the tensioner, and the wrench on each support from the first, of each stored instant.
fn read_rows(run: &Run) -> Vec<(f64, f64, Vec<[f64; 6]>)> {
    let layout = &run.history.layout;
    let link = layout.links.iter().position(|l| l.name == PIPE).unwrap();
    let along = layout.links[link].along.as_ref().unwrap();
    let of = |row: &[f64]| {
        let wrench = |end: usize| {
            let at = layout.wrench(link, end).unwrap();
            std::array::from_fn(|i| row[at + i])
        };
        (row[0], along.node(0, row).unwrap().effective, (0..5).map(wrench).collect())
    };
    run.history.rows().map(of).collect()
}

#[test]
fn pipe_at_rest_on_fixed_barge_stays_in_place() {
    let session = run_pipelay([4e5, 5e5], "-SINUSOID X 0 10", "");
    let rows = read_rows(session.job.run.as_ref().unwrap());
    let ((_, first, begun), (_, last, ended)) = (rows.first().unwrap(), rows.last().unwrap());
    // laid at the mean of its limits; at rest and under way it is the same, to the tolerance of steps
    assert!((first / 4.5e5 - 1.0).abs() < 1e-3, "{first}");
    assert!((last / first - 1.0).abs() < 1e-5, "{first} {last}");
    for (a, b) in begun.iter().zip(ended) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 5.0), "{a:?} {b:?}");
    }
}

#[test]
fn tensioner_keeps_its_limits_and_rollers_never_pull_down() {
    let limits = [4.3e5, 4.7e5];
    let session = run_pipelay(limits, "-SINUSOID X 1.0 20 -SINUSOID RY 1.0 9 -RAMP 10", "-BALANCE");
    let run = session.job.run.as_ref().unwrap();
    let rows = read_rows(run);
    let (mut low, mut high) = (f64::INFINITY, 0.0f64);
    for (time, tension, supports) in &rows {
        // the pull along X of the tensioner is within its limits, at the pitch of the barge and the slope of the pipe
        (low, high) = (low.min(*tension), high.max(*tension));
        assert!(*tension > 0.99 * limits[0] && *tension < 1.01 * limits[1], "{time} {tension}");
        for wrench in &supports[..4] {
            assert!(wrench[2] < 1.0, "{time} {wrench:?}");
        }
    }
    // a metre of surge is far more than the pipe gives: it is paid out and hauled in
    assert!(low < 1.01 * limits[0] && high > 0.99 * limits[1], "{low} {high}");
    let all = run.balance();
    let (_, balance) = all.iter().find(|(name, _)| name == PIPE).unwrap();
    // 1.5 % with these steps, and 0.3 % with a fifth of them
    assert!(balance.energy_error.abs() < 0.02 * balance.turnover, "{balance:?}");
}

#[test]
fn riser_on_one_roller_carries_weight_below_tensioner_pull() {
    let records = "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 100 -TIME 20 0.1\nMEDIT\n&DESCRIBE BODY RIG\n*T 0 0 20\n\
         ~ROLL ROLLER COMPRESSION Y 1E6 Z 1E6 -Y_ROLLER 0 0 -Z_ROLLER 0 0\n~PIPE ROD 323.9 15.9 -LEN 12 -WTPLEN 1200 -BUOY 0\nCONNECTOR T ~ROLL *T\n\
         PIPE ~PIPE T -PIPE_TENSION 2E5 3E5\nPRESCRIBE RIG -SINUSOID Z 0.5 10 -RAMP 10\nEND\nTDOM -ALONG 1\n";
    let (mut session, screen, _folder): (Session, _, _) = common::session();
    session.open("records", records.to_string());
    session.run();
    assert!(session.reports.iter().all(|r| r.severity != Severity::Error), "{}", screen.text());
    let run = session.job.run.as_ref().unwrap();
    let along = run.history.layout.links[0].along.as_ref().unwrap();
    let first = run.history.rows().next().unwrap();
    let nodes: Vec<_> = (0..).map_while(|position| along.node(position, first)).collect();
    let (top, bottom) = (nodes.first().unwrap(), nodes.last().unwrap());
    // TUPPER at the top, and 120 m of 1200 N/m less at the bottom
    assert!((top.effective / 3e5 - 1.0).abs() < 1e-4, "{}", top.effective);
    assert!(((top.effective - bottom.effective) / (1200.0 * 120.0) - 1.0).abs() < 1e-3, "{}", bottom.effective);
    assert!((bottom.position[2] + 100.0).abs() < 1e-9 && bottom.position[0].abs() < 1e-6, "{:?}", bottom.position);
    // as the rig heaves by half a metre it is paid out at TUPPER and hauled in at TLOWER
    let tops: Vec<f64> = run.history.rows().map(|row| along.node(0, row).unwrap().effective).collect();
    let (low, high) = tops.iter().fold((f64::INFINITY, 0.0f64), |(l, h), t| (l.min(*t), h.max(*t)));
    assert!(low > 1.98e5 && high < 3.03e5 && low < 2.05e5, "{low} {high}");
}

/// A barge that surges, pitches and sways.
const MOVES: &str = "-SINUSOID X 0.3 9 -SINUSOID Y 0.3 11 -SINUSOID RY 1.0 9 -RAMP 5";

#[test]
fn pipe_run_restarts_with_digits_of_uninterrupted_run() {
    let bits =
        |s: &Session| -> Vec<u64> { s.job.run.as_ref().unwrap().history.values.iter().map(|v| v.to_bits()).collect() };
    let records = records([4.3e5, 4.7e5], MOVES);
    let (whole, folder) = run_records(format!("{records}TDOM -ALONG 5\n"), None);
    let bytes = fs::read(folder.path().join("job.ans/TDOM.run")).unwrap();
    for share in [0.4, 0.9] {
        let cut = &bytes[..(bytes.len() as f64 * share) as usize];
        let (again, _folder) = run_records(format!("{records}TDOM -ALONG 5 -RESTART\n"), Some(cut));
        assert!(again.reports.iter().any(|r| r.message.starts_with("goes on from ")));
        assert!(bits(&again) == bits(&whole), "{share}");
    }
}

#[test]
fn sea_starting_during_run_finds_pipe_on_its_supports() {
    let limits = [4.3e5, 4.7e5];
    let sea = "&ENV SEA -DEPTH 50 -SEA REGULAR 180 3 8 -TIME 40 0.1\n&ENV CALM -DEPTH 50 -TIME 40 0.1\n";
    let run = |action: &str| {
        let still = records(limits, "-SINUSOID X 0 10");
        run_records(format!("{still}{sea}&ENV CALM\n{action}TDOM -ALONG 1\n"), None).0
    };
    let [calm, rough] = ["", "&ACTION STORM -AT 20 -ENVIRONMENT SEA\n"].map(|action| {
        let session = run(action);
        let run = session.job.run.as_ref().unwrap();
        let along = run.history.layout.links[0].along.as_ref().unwrap();
        // a node between the stinger and the bottom: least and most elevation before and after the sea comes
        let mut seen = [[f64::INFINITY, f64::NEG_INFINITY]; 2];
        for row in run.history.rows() {
            let z = along.node(45, row).unwrap().position[2];
            let [low, high] = &mut seen[usize::from(row[0] > 20.0)];
            (*low, *high) = (low.min(z), high.max(z));
        }
        seen.map(|[low, high]| high - low)
    });
    assert!(calm[0] < 1e-3 && calm[1] < 1e-3 && rough[0] == calm[0], "{calm:?} {rough:?}");
    assert!(rough[1] > 0.02, "{rough:?}");
}

#[test]
fn support_forces_add_up_to_load_on_barge() {
    let session = run_pipelay([4.3e5, 4.7e5], MOVES, "");
    let run = session.job.run.as_ref().unwrap();
    let line = LineResults::find(run, PIPE).unwrap();
    let events = results::events(&run.history, None).unwrap();
    let table = along::supports(&line, Magnitude::default(), &events).unwrap();
    let number = |column: usize, row: usize| match table.columns()[column].cells[row] {
        Cell::Number(value) => value,
        ref other => panic!("{other:?}"),
    };
    let column = run.history.layout.category(0, Category::FlexConnectors).unwrap();
    for (row, values) in run.history.rows().enumerate() {
        for axis in 0..3 {
            let sum: f64 = (0..5).map(|support| number(1 + 4 * support + axis, row)).sum();
            assert!((sum - values[column + axis]).abs() < 1e-3, "{row} {axis}: {sum} {}", values[column + axis]);
        }
    }
}

#[test]
fn action_on_pipe_support_is_refused() {
    for action in ["-AT 5 -RELEASE R2", "-TENSION R2 1E5 -STOP"] {
        let (mut session, _, _folder) = common::session();
        session.open("records", format!("{}&ACTION OFF {action}\nTDOM\n", records([4e5, 5e5], "-SINUSOID X 0 10")));
        session.run();
        let reported = format!("{:?}", session.reports);
        assert!(session.errors == 1 && reported.contains("R2: a pipe lies on it"), "{reported}");
    }
}

#[test]
fn run_ends_when_pipe_pull_exceeds_limit() {
    let records = records([4.3e5, 4.7e5], MOVES);
    let (session, _folder) = run_records(format!("{records}&ACTION OFF -TENSION &PIPE 4.6E5 -STOP\nTDOM\n"), None);
    let run = session.job.run.as_ref().unwrap();
    let at = run.history.layout.pull(0).unwrap();
    let pulls: Vec<f64> =
        run.history.rows().map(|row| row[at..at + 3].iter().map(|f| f * f).sum::<f64>().sqrt()).collect();
    let (last, before) = pulls.split_last().unwrap();
    assert!(*last > 4.6e5 && before.iter().all(|p| *p <= 4.6e5) && before.len() < 400, "{last} {}", before.len());
}

#[test]
fn tensioner_holds_at_its_current_position() {
    // surge of half a metre turns at 10 s and 30 s; from then on it is held until the pipe itself pulls by the other limit
    let session = run_pipelay([5.8e5, 6.2e5], "-SINUSOID X 0.5 40", "");
    let run = session.job.run.as_ref().unwrap();
    let at = run.history.layout.pull(0).unwrap();
    for row in run.history.rows() {
        let pull = row[at..at + 3].iter().map(|f| f * f).sum::<f64>().sqrt();
        let wanted = match row[0] {
            t if (1.0..10.0).contains(&t) || (34.0..40.0).contains(&t) => 5.8e5,
            t if (15.0..29.0).contains(&t) => 6.2e5,
            _ => continue,
        };
        // the roller under it takes what is across
        assert!((pull / wanted - 1.0).abs() < 2e-3, "{}: {pull}", row[0]);
    }
}

#[test]
fn current_starting_during_run_keeps_pipe_length() {
    let still = records([4e5, 8e5], "-SINUSOID X 0 10");
    let streams = "&ENV STREAM -DEPTH 50 -CURRENT 1.0 90 -TIME 40 0.1\n&ENV CALM -DEPTH 50 -TIME 40 0.1\n";
    let (session, _folder) =
        run_records(format!("{still}{streams}&ENV CALM\n&ACTION SW -AT 5 -ENVIRONMENT STREAM\nTDOM -ALONG 1\n"), None);
    let run = session.job.run.as_ref().unwrap();
    let (at, along) = (run.history.layout.pull(0).unwrap(), run.history.layout.links[0].along.as_ref().unwrap());
    let seen = |row: &[f64]| {
        let end = along.nodes(row).last().unwrap().1.arc;
        (row[at..at + 3].iter().map(|f| f * f).sum::<f64>().sqrt(), end)
    };
    let rows: Vec<_> = run.history.rows().map(|row| (row[0], seen(row))).collect();
    for pair in rows.windows(2) {
        let ((time, (pull, end)), (_, (next, other))) = (pair[0], pair[1]);
        assert_eq!(end, other, "{time}");
        // what comes by the drag alone
        assert!((next - pull).abs() < 2e4, "{time}: {pull} {next}");
    }
}
