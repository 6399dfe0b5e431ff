//! CODE_CHECK of a catenary that hardly stretches, by hand: at H = 500 kN, 200 m high and 1 kN/m heavy its tension at the fairlead is
//! H + w h = 700 kN, it hangs over sqrt(h2 + 2 h H/w) = 489.898 m, and its anchor is 953.609 m away.

use crate::common;

const MODEL: &str = "MEDIT\n&DESCRIBE BODY RIG\n*P 0 0 0\n*Q 0 5 0\n\
    ~L B_CAT 100 -LEN 1010 -DEP 200 -BUOY 0 -WTPL 1000 -EMOD 1E11 -B_TEN 3E6\n\
    CONNECTOR A ~L *P -ANC 0 953.609\nCONNECTOR B ~L *Q -ANC 180 953.609\nEND\n";

/// What the checks of some records print.
fn printed(before: &str, check: &str) -> String {
    let (text, errors) = common::print_records(&format!(
        "&DIMEN -DIMEN METERS N\n{MODEL}{before}\nCONN_DESIGN\nCODE_CHECK {check}\nEND\n"
    ));
    assert_eq!(errors, 0, "{text}");
    text
}

/// The words of the first row of a line, behind a title with its letters apart.
fn row(text: &str, title: &str) -> Vec<String> {
    let apart: Vec<String> = title.to_uppercase().chars().map(String::from).collect();
    let behind = text.split_once(&apart.join(" ")).unwrap_or_else(|| panic!("no {title}: {text}")).1;
    let line = behind.lines().find(|line| line.trim_start().starts_with("A ")).unwrap();
    line.split_whitespace().map(str::to_string).collect()
}

/// Safety factor, the one required, utilisation and verdict, which end a row.
fn judged(row: &[String]) -> ([f64; 3], &str) {
    let (verdict, numbers) = row.split_last().unwrap();
    let last: Vec<f64> = numbers.iter().rev().take(3).rev().map(|word| word.parse().unwrap()).collect();
    (last.try_into().unwrap(), verdict)
}

/// Numbers as a report prints them, to three decimals.
fn assert_printed(found: [f64; 3], by_hand: [f64; 3]) {
    for (a, b) in found.into_iter().zip(by_hand) {
        assert!((a - b).abs() <= 0.00051, "{found:?} for {by_hand:?}");
    }
}

#[test]
fn intact_line_has_safety_factor_of_catenary_by_hand() {
    let text = printed("", "-CODE API_RP_2SK_3");
    let row = row(&text, "Code Check of Lines");
    let (numbers, verdict) = judged(&row);
    // 3,000 kN over 700 kN, 2.0 required
    assert_printed(numbers, [3000.0 / 700.0, 2.0, 1400.0 / 3000.0]);
    assert_eq!(verdict, "pass");
}

#[test]
fn lost_line_takes_damaged_factor() {
    let text = printed("&CONNECTOR B -INACTIVE", "-CODE API_RP_2SK_3");
    let row = row(&text, "Code Check of Lines");
    assert_printed(judged(&row).0, [3000.0 / 700.0, 1.43, 1.43 * 700.0 / 3000.0]);
}

#[test]
fn corrosion_reduces_strength_by_area() {
    let text = printed("", "-CODE API_RP_2SK_3 -CORROSION 10");
    let row = row(&text, "Code Check of Lines");
    // 100 mm less 10 mm leaves 0.81 of the area
    assert_printed(judged(&row).0, [2430.0 / 700.0, 2.0, 1400.0 / 2430.0]);
}

#[test]
fn pile_bears_horizontal_force_of_catenary() {
    let text = printed("", "-CODE API_RP_2SK_3 -MOORING PERMANENT -ANCHOR PILE LATERAL 1E6");
    let row = row(&text, "Code Check of Anchors");
    let (numbers, verdict) = judged(&row);
    // 1,000 kN over H = 500 kN, 1.6 required
    assert_printed(numbers, [2.0, 1.6, 0.8]);
    assert_eq!(verdict, "pass");
}

#[test]
fn factor_from_memory_never_passes() {
    let (text, errors) = common::print_records(&format!(
        "&DIMEN -DIMEN METERS N\n{MODEL}CONN_DESIGN\nCODE_CHECK -CODE DNV_OS_E301_2015 -CLASS 1\nEND\n"
    ));
    assert_eq!(errors, 1, "{text}");
    let text = printed("", "-CODE DNV_OS_E301_2015 -CLASS 1 -UNCONFIRMED -GROUNDED 100");
    assert!(!text.lines().any(|line| line.ends_with("  pass")), "{text}");
    let row = row(&text, "Code Check of Lines");
    let (verdict, numbers) = row.split_last().unwrap();
    // 1.7 T over S_C = 0.95 MBL
    let utilisation: f64 = numbers.last().unwrap().parse().unwrap();
    assert!((utilisation - 1.7 * 700.0 / (0.95 * 3000.0)).abs() < 0.00051, "{utilisation}");
    assert_eq!(verdict, "UNCONFIRMED");
}

#[test]
fn grounded_length_is_that_of_catenary() {
    let text = printed("", "-CODE API_RP_2SK_3 -GROUNDED 521");
    let line = text.lines().find(|line| line.contains("length of A on the bottom")).unwrap();
    let value: f64 = line.split_whitespace().filter_map(|word| word.parse().ok()).next().unwrap();
    // 1,010 m less 489.898 m, and less than 521 m
    assert!((value - 520.102).abs() < 0.02 && line.contains("FAIL"), "{line}");
}
