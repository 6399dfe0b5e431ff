//! What statistics of a run leave out: TTRA_SET of `&ENV -TIME`, alike in TDOM and in PRCPOST, by a sinusoid that grows.

use crate::common;

/// A body that is moved by 3 m sin(2 pi t/10), grown over the first 20 s, in metres.
const GROWN: &str = "&DIMEN -DIMEN METERS KN\n&ENV -TIME 70 0.1 20\nMEDIT\n&DESCRIBE BODY B\n*B 0 0 0\n\
                     PRESCRIBE B -SINUSOID X 3 10 -RAMP 20\nEND\nTDOM\n";

/// What a session shows for records behind the run.
fn screen_after(posts: &str) -> String {
    let (mut session, screen, _folder) = common::session();
    session.open("test", format!("{GROWN}{posts}"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    screen.text()
}

/// The numbers of the first line with a name behind a title.
fn numbers(text: &str, title: &str, name: &str) -> Vec<f64> {
    let behind = text.split_once(title).unwrap_or_else(|| panic!("no {title}: {text}")).1;
    let line = behind.lines().find(|l| l.contains(name)).unwrap_or_else(|| panic!("no {name}: {behind}"));
    line.split_whitespace().filter_map(|w| w.parse().ok()).collect()
}

/// Standard deviation of 3 sin over 501 instants of five whole periods, both ends counted: the root of 9 x 250/501.
const WHOLE: f64 = 2.119_203;

#[test]
fn result_and_run_statistics_skip_the_same_transient() {
    let text = screen_after(
        "PRCPOST\nTRAJECTORY B\nSTATISTIC Time X\nSTATISTIC Time X -RECORD 1 701\nEND\nTRAJECTORY B -EVENTS 0 70\nSTATISTIC Time X\nEND\nEND\n",
    );
    // mean, deviation, least, ... to two decimals; the first number of a row of STATISTIC is the count
    let own = numbers(&text, "P L A C E S", "B X");
    assert!(own[0].abs() < 0.005 && (own[1] - WHOLE).abs() < 0.005, "{own:?}");
    assert_eq!(text.matches("without the transient: rows from TTRA_SET, 20 s, on").count(), 1, "{text}");
    let parts: Vec<&str> = text.split("Shape and Cycles").collect();
    let [behind, by_rows, by_events] = [parts[0], parts[1], parts[2]].map(|t| numbers(t, "Count", "Location: X"));
    assert!(behind[0] == 501.0 && (behind[2] - WHOLE).abs() < 1e-5, "{behind:?}");
    // the growth is chosen by hand
    assert!(by_rows[0] == 701.0 && by_rows[2] < WHOLE - 0.1, "{by_rows:?}");
    assert_eq!(by_events, by_rows);
}

#[test]
fn result_extremes_and_shares_skip_the_transient() {
    let text = screen_after(
        "PRCPOST\nTRAJECTORY B\nEXTREMES Time X\nREPORT\nEND\nEXCEEDANCE Time X -LEVELS 5\nREPORT\nEND\nHISTOGRAM Time X -BINS 2\nREPORT\nEND\nEND\nEND\n",
    );
    // Rayleigh's scale is the deviation
    let rayleigh = numbers(&text, "L A R G E S T", "Rayleigh");
    assert!((rayleigh[2] - WHOLE).abs() < 1e-5, "{rayleigh:?}");
    // of a sine a third is above half its amplitude: 33 of each 100 instants, of 501
    let half = numbers(&text, "E X C E E D A N C E", " 1.50000E+00");
    assert!((half[1] - 165.0 / 501.0).abs() < 1e-6, "{half:?}");
    assert_eq!(text.matches("without the transient").count(), 3, "{text}");
}
