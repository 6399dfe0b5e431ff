//! A pipe on its supports under way: it stays where it rests, its tensioner keeps its limits, rollers do not pull, books add up.

#![allow(clippy::unwrap_used)]

#[allow(dead_code)]
mod common;

use windlass::language::diagnostic::Severity;
use windlass::model::PIPE;
use windlass::session::Session;
use windlass::solve::time::Run;

/// A run of a pipe over five rollers of a barge that moves as it is told, in metres and newtons.
fn laid(limits: [f64; 2], motion: &str, tdom: &str) -> Session {
    let records = format!(
        "&DIMEN -DIMEN METERS N\n&ENV -DEPTH 50 -TIME 40 0.1\nMEDIT\n&DESCRIBE BODY BARGE\n*R1 35.65 0 1.70\n*R2 26.82 0 3.58\n\
         *R3 17.97 0 4.92\n*R4 9 0 5.73\n*R5 0 0 6\n~ROLL ROLLER COMPRESSION Z 2E7\n~PIPE ROD 323.9 15.9 -LEN 12 -WTPLEN 1200\n\
         CONNECTOR R1 ~ROLL *R1\nCONNECTOR R2 ~ROLL *R2\nCONNECTOR R3 ~ROLL *R3\nCONNECTOR R4 ~ROLL *R4\nCONNECTOR R5 ~ROLL *R5\n\
         PIPE ~PIPE R1 R2 R3 R4 R5 -PIPE_TENSION {} {}\nPRESCRIBE BARGE {motion}\nEND\nTDOM -ALONG 1 {tdom}\n",
        limits[0], limits[1]
    );
    let (mut session, screen, _folder): (Session, _, _) = common::session();
    session.open("records", records);
    session.run();
    assert!(session.reports.iter().all(|r| r.severity != Severity::Error), "{}", screen.text());
    session
}

/// Time, tension at the tensioner, and the wrench on each support from the first, of each stored instant.
fn told(run: &Run) -> Vec<(f64, f64, Vec<[f64; 6]>)> {
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
fn a_pipe_at_rest_on_a_barge_that_stands_stays_where_it_is() {
    let session = laid([4e5, 5e5], "-SINUSOID X 0 10", "");
    let rows = told(session.job.run.as_ref().unwrap());
    let ((_, first, begun), (_, last, ended)) = (rows.first().unwrap(), rows.last().unwrap());
    // laid at the mean of its limits; at rest and under way it is the same, to the tolerance of steps
    assert!((first / 4.5e5 - 1.0).abs() < 1e-3, "{first}");
    assert!((last / first - 1.0).abs() < 1e-5, "{first} {last}");
    for (a, b) in begun.iter().zip(ended) {
        assert!(a.iter().zip(b).all(|(a, b)| (a - b).abs() < 5.0), "{a:?} {b:?}");
    }
}

#[test]
fn the_tensioner_keeps_its_limits_and_no_roller_pulls_the_pipe_down() {
    let limits = [4.3e5, 4.7e5];
    let session = laid(limits, "-SINUSOID X 1.0 20 -SINUSOID RY 1.0 9 -RAMP 10", "-BALANCE");
    let run = session.job.run.as_ref().unwrap();
    let rows = told(run);
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
    let all = run.books();
    let (_, books) = all.iter().find(|(name, _)| name == PIPE).unwrap();
    // 1.5 % with these steps, and 0.3 % with a fifth of them
    assert!(books.energy_error.abs() < 0.02 * books.turnover, "{books:?}");
}

#[test]
fn a_riser_on_one_roller_bears_its_weight_below_the_pull_of_its_tensioner() {
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
    let nodes: Vec<_> = (0..).map_while(|place| along.node(place, first)).collect();
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
