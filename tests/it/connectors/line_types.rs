//! `-TYPE NAME D`: what a record with a line type of the library amounts to, and what is said of it. The library itself
//! is tested against catalogues in `crates/connectors/src/line_types.rs`.

use crate::common;

/// Runs records; what they print, and the messages.
fn run(records: &str) -> (String, Vec<String>) {
    let (mut session, screen, _folder) = common::session();
    session.open("records", records.to_string());
    session.run();
    session.job.output.flush();
    let text = screen.text();
    (text, session.reports.iter().map(|r| r.message.clone()).collect())
}

/// The row of the first segment of a class record, in metres and kilonewtons unless `before` says otherwise: OD, length,
/// weight in air and water, AE, break; and the messages.
fn segment(before: &str, record: &str) -> (Vec<String>, Vec<String>) {
    let (out, messages) = run(&format!("&DIMEN -DIMEN METERS K-NTS\n{before}\nMEDIT\n{record}\nEND\n&STATUS CL_FLEX"));
    let row = out.lines().find(|l| l.trim_start().starts_with("1 ")).map(|l| l.split_whitespace().skip(1).take(6));
    (row.map(|words| words.map(str::to_string).collect()).unwrap_or_default(), messages)
}

/// CHAIN_R4 of 84 mm by hand: 19.9e3 d2 = 140.41 kg/m; displaced pi/4 (1.8 d)2 = 0.017955 m3/m; 0.854e8 d2 kN;
/// 0.0274 x 84**2 (44 - 0.08 x 84) kN.
const R4_84: [&str; 6] = ["84.0", "100.00", "1.3770", "1.1965", "6.0258E+05", "7207.51"];

#[test]
fn type_sets_section_properties_of_every_line_class_that_takes_it() {
    for class in ["B_CAT", "B_CAT EXACT", "H_CAT EXACT", "H_CAT", "SL_ELEM", "SL_ELEM TENSION"] {
        let (row, messages) = segment("", &format!("~C {class} -TYPE CHAIN_R4 84 -LEN 100"));
        assert_eq!(row, R4_84, "{class}");
        // what hangs without weight is said to
        let others: Vec<&String> = messages.iter().filter(|m| !m.contains("weight")).collect();
        assert!(others.is_empty(), "{class}: {messages:?}");
    }
}

#[test]
fn type_diameter_is_in_inches_with_feet_and_name_may_be_short() {
    let (row, messages) =
        segment("&DIMEN -SAVE -DIMEN FEET KIPS", "~C B_CAT -TYPE chain_r4 84/25.4 -LEN 100/0.3048\n&DIMEN -REM");
    assert_eq!((row, messages), (R4_84.map(String::from).to_vec(), vec![]));
    let (row, _) = segment("", "~C B_CAT -TYPE WIRE_SP 76 -LEN 100");
    // 1022e6 d2 and 97.1e9 d2
    assert_eq!(&row[4..], ["5.6085E+05", "5903.07"]);
}

#[test]
fn submerged_weight_of_type_uses_water_density() {
    // fresh water: (140.414 - 1000 x 0.0179553) x 9.80665
    let (row, _) = segment("&DEFAULT -WATER 1000", "~C B_CAT -TYPE CHAIN_R4 84 -LEN 100");
    assert_eq!(row[3], "1.2009");
}

#[test]
fn option_beside_type_overrides_one_value_with_remark() {
    // pi/4 84**2 mm2 = 5541.77 mm2; displaced 0.180480 kN/m in sea water
    for (option, column, value, said) in [
        ("-WTPLEN 2", 2, "2.0000", "-WTPLEN (weight) overrides"),
        ("-DENSITY 8000", 2, "0.4348", "-DENSITY (weight, of the solid area) overrides"),
        ("-SPGRAVITY 8", 2, "0.4348", "-SPGRAVITY (weight, of the solid area) overrides"),
        ("-BUOYDIA 0", 3, "1.3770", "-BUOYDIAMETER (buoyancy) overrides"),
        ("-DISPLEN 0.377", 3, "1.0000", "-DISPLEN (buoyancy) overrides"),
        ("-EMODULUS 100000", 4, "5.5418E+05", "-EMODULUS (AE, of the solid area) overrides"),
        ("-TENSTR 1000", 5, "5541.77", "-TENSTR (break, of the solid area) overrides"),
        ("-FYIELD 600", 5, "5541.77", "-FYIELD (break, of the solid area) overrides"),
        ("-B_TENSION 5000", 5, "5000.00", "-B_TENSION (break) overrides"),
    ] {
        let (row, messages) = segment("", &format!("~C B_CAT -TYPE CHAIN_R4 84 -LEN 100 {option}"));
        assert_eq!(row[column], value, "{option}");
        // the weight in water follows a weight given; all else is the type's
        let others = |c: &usize| *c != column && !(column == 2 && *c == 3);
        assert!((0..6).filter(others).all(|c| row[c] == R4_84[c]), "{option}: {row:?}");
        assert_eq!(messages, [format!("{said} what CHAIN_R4 gives")]);
    }
}

#[test]
fn diameter_given_beside_type_is_listed() {
    let (row, messages) = segment("", "~C B_CAT 90 -TYPE CHAIN_R4 84 -LEN 100");
    assert_eq!(row[0], "90.0");
    assert_eq!(row[1..], R4_84[1..]);
    assert!(messages[0].contains("OD is the diameter listed"), "{messages:?}");
}

#[test]
fn hydrodynamic_diameters_of_type_are_listed_and_can_be_given() {
    let line = |record: &str| {
        let (out, _) = run(&format!("&DIMEN -DIMEN METERS K-NTS\nMEDIT\n{record}\nEND\n&STATUS CL_FLEX"));
        let row = out.lines().find(|l| l.contains(" CHAIN_R4 ") && !l.contains("record")).unwrap().to_string();
        row.split_whitespace().skip_while(|w| *w != "CHAIN_R4").skip(1).map(str::to_string).collect::<Vec<_>>()
    };
    assert_eq!(line("~C B_CAT -TYPE CHAIN_R4 84 -LEN 9"), ["151.2", "84.0", "151.2", "84.0"]);
    let given = "~C B_CAT -TYPE CHAIN_R4 84 -LEN 9 -BUOY 1 -DRAGDIA 2 -AMAS 3 -WINDDIA 4";
    assert_eq!(line(given), ["1.0", "2.0", "3.0", "4.0"]);
}

#[test]
fn segments_of_different_types_are_tabulated_in_one_line() {
    let (out, messages) = run("&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -DEPTH 300\nMEDIT\n&DESCRIBE BODY B\n*P 0 0 0\n\
         ~L B_CAT -TYPE CHAIN_R4 84 -LEN 100\n~L B_CAT -TYPE WIRE_SPIRAL 90 -LEN 500\n~L B_CAT -TYPE CHAIN_R4 84 -LEN 800\n\
         CONNECTOR A ~L *P\nEND\nCONN_DESIGN\nTABLE A\nVIEW Force 'Ten Top' -RECORD 30 30\nEND\nEND");
    assert!(messages.is_empty(), "{messages:?}");
    // the last row is at the largest break of all segments: 1022e6 x 0.09**2 N
    assert!(out.contains("8278.2"), "{out}");
}

#[test]
fn out_of_range_diameter_warns_and_unknown_type_suggests_nearest() {
    let (row, messages) = segment("", "~C B_CAT -TYPE POLYESTER 200 -LEN 100");
    assert_eq!(row[5], "6818.64");
    assert_eq!(messages, ["200 mm is outside of 8 to 96 mm, which the formulas of POLYESTER are held for"]);
    let (row, messages) = segment("", "~C B_CAT -TYPE CHIAN_R4 84 -LEN 100");
    assert!(row.is_empty());
    assert!(messages[0].contains("unknown line type `CHIAN_R4`"), "{messages:?}");
}

#[test]
fn status_lists_values_at_diameter_in_session_units() {
    let (out, _) = run("&DIMEN -DIMEN METERS K-NTS\n&STATUS LINE_TYPES 84");
    let row = |out: &str| -> Vec<String> {
        let line = out.lines().find(|l| l.trim_start().starts_with("CHAIN_R4 ")).unwrap();
        line.split_whitespace().map(str::to_string).collect()
    };
    assert_eq!(row(&out)[1..8], ["151.2", "140.41", "1.3770", "1.1965", "6.0258E+05", "7207.51", "yes"]);
    let (out, _) = run("&STATUS LINE_TYPES 84/25.4");
    // 7207.51 kN is 1620.31 kips
    assert_eq!(row(&out)[6..8], ["1620.31", "yes"]);
    // chain has no strength by its formula at 600 mm: it is not listed
    let (out, _) = run("&DIMEN -DIMEN METERS K-NTS\n&STATUS LINE_TYPES 600");
    assert!(out.contains("WIRE_6STRAND") && !out.contains("CHAIN_R4 "), "{out}");
}
