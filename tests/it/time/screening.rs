//! Quasi-static lines replayed as dynamic lines after a run, against MoorDyn.

use crate::common;
use windlass_solve::screening::{Replay, quasi_static_lines, remarks, screen, table, warnings};
use windlass_solve::time::Run;

/// MoorDyn's chain: segments, mean, standard deviation, least and most of the fairlead tension from 100 to 200 s (kN).
const MOORDYN: &str = include_str!("../../data/moordyn_screened_chain.csv");

/// The largest fairlead tension of MoorDyn with 60 segments (kN).
fn moordyn_most() -> f64 {
    let row = MOORDYN.lines().find(|l| l.starts_with("60,")).unwrap();
    row.split(',').next_back().unwrap().parse().unwrap()
}

/// The chain that MoorDyn has, its fairlead moved by 3 m in 10 s, as a script in metres and kN.
fn script(time: &str, class: &str, tdom: &str) -> String {
    format!(
        "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 300 -TIME {time}\nMEDIT\n~C B_CAT -TYPE CHAIN_R4 100 -LEN 1200 {class}\n\
         &DESCRIBE BODY RIG\n*F 0 0 -10\nCONNECTOR L -ANC 0 1130 ~C *F\nPRESCRIBE RIG -SINUSOID X 3 10\nEND\n{tdom}\n"
    )
}

/// What a session shows for a script, the warnings it gives, and its run.
fn ran(script: String) -> (String, Vec<String>, Run) {
    let (mut session, screen, _folder) = common::session();
    session.open("test", script);
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let said = session.reports.iter().map(|r| r.message.clone()).collect();
    (screen.text(), said, session.job.run.take().unwrap())
}

fn replays(run: &Run) -> Vec<Replay> {
    screen(run, &|| true).replays
}

#[test]
fn replayed_chain_tension_matches_moordyn_chain() {
    // the polynomials between stored instants follow the motion
    let (text, said, run) = ran(script("200 0.25 100", "", "TDOM"));
    let [made] = &replays(&run)[..] else { panic!("one line") };
    // scheme, mesh and the internal damping of MoorDyn's chain: its own 120 segments differ from 60 by 0.1 %
    assert!((1e-3 * made.dynamic.0 / moordyn_most() - 1.0).abs() < 2e-3, "{made:?}");
    // the exact catenary at 3 m
    assert!(
        (1e-3 * made.quasi_static - 2237.04).abs() < 0.01 && (made.ratio() - moordyn_most() / 2237.04).abs() < 3e-3
    );
    assert_eq!(
        (made.window.map(f64::round), made.period.round(), made.elements, made.steps),
        ([100.0, 200.0], 10.0, 60, 1200)
    );
    assert!(text.contains("quasi-static lines, without inertia and drag of their own: L"), "{text}");
    assert!(said.iter().any(|s| s.starts_with("L: as a dynamic line it pulls 1.28 times as hard")), "{said:?}");
}

#[test]
fn tabulated_line_replay_matches_exact_line() {
    let (.., run) = ran(script("200 0.25 100", "-TABLE", "TDOM -SCREEN NO"));
    let [made] = &replays(&run)[..] else { panic!("one line") };
    assert!((1e-3 * made.dynamic.0 / moordyn_most() - 1.0).abs() < 2e-3, "{made:?}");
}

#[test]
fn skipped_screening_is_reported_with_reason() {
    for (tdom, class, reason) in [
        ("TDOM -SCREEN NO", "", "not replayed as dynamic lines: -SCREEN NO"),
        ("TDOM -STATISTICS", "", "not replayed as dynamic lines: -STATISTICS keeps no motion of their ends"),
        (
            "TDOM -STORE 12",
            "",
            "not replayed as a dynamic line: L: its stored instants, 2.4 s apart, are too few for a period of",
        ),
        (
            "TDOM",
            "-X_DAMPING 10 1",
            "not replayed as a dynamic line: L: springs, dashpots, convolutions and pistons of a class do not go",
        ),
    ] {
        let (text, said, _) = ran(script("60 0.2 20", class, tdom));
        assert!(text.contains(reason), "{reason}: {text}");
        assert!(!said.iter().any(|s| s.contains("as a dynamic line it pulls")), "{said:?}");
    }
}

#[test]
fn line_between_bodies_is_replayed_with_both_motions() {
    // a mirror image: the other end moves the other way, and is reported of
    let hung = |[moved, still]: [&str; 2], by: f64| {
        let (.., run) = ran(format!(
            "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 400 -TIME 60 0.2 20\nMEDIT\n~C H_CAT 120 EXACT -LEN 420\n\
             &DESCRIBE BODY A\n*A -200 0 -10\n&DESCRIBE BODY B\n*B 200 0 -10\nCONNECTOR L ~C *{moved} *{still}\nCONNECTOR M ~C *{moved} *{still}\n\
             PRESCRIBE {still} -SINUSOID Y 0 10\nPRESCRIBE {moved} -SINUSOID X {by} 8\nEND\nTDOM -SCREEN NO\n"
        ));
        assert_eq!(quasi_static_lines(&run), ["L", "M"]);
        replays(&run)
    };
    let ([one, again], [other, _]) = (&hung(["A", "B"], -2.0)[..], &hung(["B", "A"], 2.0)[..]) else {
        panic!("two lines each")
    };
    // a mirror image to what Newton's iteration leaves
    assert!((one.dynamic.0 / other.dynamic.0 - 1.0).abs() < 1e-4 && one.ratio() > 1.01, "{one:?} {other:?}");
    assert_eq!(one.dynamic, again.dynamic);
}

#[test]
fn interrupted_replay_is_reported_and_fails_alone() {
    let (.., run) = ran(script("60 0.2 20", "", "TDOM -SCREEN NO"));
    let made = screen(&run, &|| false);
    assert!(made.replays.is_empty() && made.left[0].1.to_string().contains("interrupted"), "{made:?}");
    let units = windlass_base::units::UnitSystem::default();
    assert_eq!(remarks(&made, units), ["not replayed as a dynamic line: L: the replay was interrupted"]);
    assert!(table(&made).is_none() && warnings(&made, units).is_empty());
}
