//! Connectors that push are in negative tension wherever a run reports tension: its statistics, actions and fatigue.

use crate::common;

use std::f64::consts::FRAC_PI_4;
use windlass::session::Session;
use windlass_signal::fatigue::{cycle_damage, find};
use windlass_signal::line::fatigue::TubeCircumference;
use windlass_signal::rainflow::RainflowCycle;
use windlass_solve::results::along::{LineResults, fatigue_along};
use windlass_solve::results::{events, line_damages};
use windlass_solve::time::Run;

/// A session after records in metres and kilonewtons, none of them refused.
fn run_records(records: &str) -> Session {
    let (mut session, _, _folder) = common::session();
    session.open("test", format!("&DIMEN -DIMEN METERS K-NTS\n{records}"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session
}

/// The texts of a session's reports.
fn reports(session: &Session) -> Vec<String> {
    session.reports.iter().map(|r| format!("{r:?}")).collect()
}

/// A body that heaves by 0.05 m in 5 s, held by a class 80 m long over an end `apart` from it.
fn tendon(class: &str, far: &str, rest: &str) -> String {
    format!(
        "&ENV -DEPTH 100 -TIME 20 0.05\nMEDIT\n*L1 {far}\n&DESCRIBE BODY B\n*T 0 0 -20\n#WEIGHT *T 100 1 1 1\n~T {class}\n\
         CONNECTOR T1 ~T *T *L1\nPRESCRIBE B -SINUSOID Z 0.05 5\nEND\n{rest}\n"
    )
}

const ROD: &str = "ROD 1000 30 -LEN 79.98 -REF 8 -C_SN DNV_D_FREE";
const SPRING: &str = "SL_ELEM 50 -LEN 79.98 -C_SN DNV_D_FREE";
const BELOW: &str = "0 0 -100";

/// Least and most tension of the only connector of a run (N).
fn tensions(run: &Run) -> [f64; 2] {
    let found = run.statistics.results().find(|(series, _)| series.name == "T1 Tension").unwrap();
    let reported = found.1.summary().unwrap();
    [reported.minimum.value, reported.maximum.value]
}

#[test]
fn compressed_tendon_and_spring_have_negative_tension() {
    for class in [ROD, SPRING] {
        let session = run_records(&tendon(class, BELOW, "TDOM"));
        let run = session.job.run.as_ref().unwrap();
        let [least, most] = tensions(run);
        let force = run.history.series(run.history.layout.wrench(0, 0).unwrap() + 2);
        // on the body, a push is upward
        let (up, down) = (force.iter().fold(f64::MIN, |a, b| a.max(*b)), force.iter().fold(f64::MAX, |a, b| a.min(*b)));
        assert!(up > 0.0 && down < 0.0, "{class}: {up} {down}");
        assert!((least / -up - 1.0).abs() < 1e-3 && (most / -down - 1.0).abs() < 1e-3, "{class}: {least} {most}");
    }
    // EA/L times 0.05 m less what 20 mm of pretension and the weight leave
    let session = run_records(&tendon(ROD, BELOW, "TDOM"));
    let [least, _] = tensions(session.job.run.as_ref().unwrap());
    assert!((least / -6.7e6 - 1.0).abs() < 0.05, "{least}");
}

#[test]
fn hanging_and_tension_only_lines_never_have_negative_tension() {
    // 100 m between ends 60 m apart, which sags; a spring of the same without compression
    for (class, far) in [
        ("ROD 300 10 -LEN 100 -REF 10", "60 0 -20"),
        ("ROD 60 30 -LEN 79.98 -REF 8 -EI 0", BELOW),
        ("SL_ELEM 50 TENSION -LEN 79.98", BELOW),
    ] {
        let session = run_records(&tendon(class, far, "TDOM"));
        let [least, most] = tensions(session.job.run.as_ref().unwrap());
        assert!(least >= 0.0 && most > 0.0, "{class}: {least} {most}");
    }
}

#[test]
fn action_treats_compressed_line_as_slack() {
    for class in [ROD, SPRING] {
        let met = |force: &str| {
            let session = run_records(&tendon(class, BELOW, &format!("&ACTION SL -SLACK T1 {force} -STOP\nTDOM")));
            let run = session.job.run.as_ref().unwrap();
            let [Some(time)] = run.fired[..] else { panic!("{class}: {:?}", run.fired) };
            time
        };
        let (slack, pushed) = (met("0"), met("-20"));
        // the body goes down in the second half of the period at the latest
        assert!(slack > 0.0 && slack < pushed && pushed < 5.0, "{class}: {slack} {pushed}");
    }
}

#[test]
fn damage_counts_full_range_of_sign_changing_tension() {
    let session = run_records(&tendon(ROD, BELOW, "&ENV -TIME 55 0.05\nTDOM"));
    let run = session.job.run.as_ref().unwrap();
    let all = events(&run.history, None).unwrap();
    let whole = line_damages(run, &[0], &run.model.fatigue, &all).unwrap().remove(0).1.segments.remove(0);
    let line = LineResults::find(run, "T1").unwrap();
    let along = fatigue_along(&line, &run.model.fatigue, (&TubeCircumference::default(), 1.0), &all).unwrap();
    let along = along.get("Damage").unwrap().numbers();
    // the record begins and ends halfway; later it buckles sideways; until then a cycle each 5 s of the range over the wall
    let area = FRAC_PI_4 * (1.0 - 0.94_f64.powi(2));
    let [least, most] = tensions(run);
    let range: f64 = 1e-6 * (most - least) / area;
    let [from, to] = [all.first(), all.last()].map(|e| e.unwrap().time(&run.history).unwrap());
    let periods = (to - from) / 5.0;
    let curve = find("DNV_D_FREE", &run.model.fatigue).unwrap();
    let by_hand = cycle_damage(&[RainflowCycle { range, mean: 0.0, count: periods }], &curve, 0.0).unwrap().sum;
    assert!((whole.damage / by_hand - 1.0).abs() < 0.05, "{whole:?} {by_hand}");
    assert!((along[0] / by_hand - 1.0).abs() < 0.05, "{along:?} {by_hand}");
}

#[test]
fn elements_beyond_their_euler_load_are_reported() {
    // 12 MN by EA/L times 0.05 m; an element of 80 m bears 3.4 MN, one of 10 m 220 MN
    for (elements, reported) in [(1, true), (8, false)] {
        let class = format!("ROD 1000 30 -LEN 80.05 -REF {elements}");
        let session = run_records(&tendon(&class, BELOW, "&STATUS F_CONNECTOR"));
        let found =
            reports(&session).iter().any(|r| r.contains("elements of its segment 1 are pushed beyond Euler's load"));
        assert_eq!(found, reported, "{elements}: {:?}", session.reports);
    }
}
