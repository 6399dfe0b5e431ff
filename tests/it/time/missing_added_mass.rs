//! A hull under the pressure of waves alone has no added mass: modes and runs are refused, or say so.

use crate::common::print_records;

/// What a session with a floating box of 20 x 20 x 10 m prints, its hull under the pressure of waves, after records; and its errors.
fn print_box(load: &str, records: &str) -> (String, i64) {
    print_records(&format!(
        "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV -DEPTH 100 -TIME 2 0.1 -SEA REGULAR 180 1 9\nMEDIT\n\
             &DESCRIBE BODY BOX -IGNORE X Y RX RY RZ\n*G 0 0 -1\n#WEIGHT *G 20103.6325 7 7 8\n{load}\nEND\n&SURFACE\n\
             BLOCK H -10 -10 -5 10 10 5 -DIFTYPE FK\nEND\n{records}\n"
    ))
}

#[test]
fn modes_and_runs_of_hull_without_added_mass_are_refused() {
    for records in ["&STATUS MODES", "TDOM", "FREQ_RESPONSE\nRAO -PERIOD 9\nEND"] {
        let (text, errors) = print_box("", records);
        assert!(errors > 0 && text.contains("no added mass of BOX"), "{records}: {text}");
        assert!(text.contains("#AMASS") && text.contains("-ACCEPT_MISSING"), "{records}: {text}");
    }
    // where it rests does not depend on it
    let (text, errors) = print_box("", "&EQUI");
    assert!(errors == 0 && text.contains("natural periods are left out: no added mass of BOX"), "{text}");
    assert!(!text.contains("Natural Periods"), "{text}");
}

#[test]
fn accepted_missing_added_mass_is_noted_in_every_report() {
    for records in ["&STATUS MODES", "TDOM", "&EQUI"] {
        let (text, errors) = print_box("", &format!("&PARAMETER -ACCEPT_MISSING YES\n{records}"));
        assert!(errors == 0 && text.contains("without added mass and radiation"), "{records}: {text}");
        assert!(text.contains("-ACCEPT_MISSING accepts: BOX"), "{records}: {text}");
    }
    let (text, _) = print_box("", "&PARAMETER -ACCEPT_MISSING YES\n&STATUS MODES");
    // modes are those of still water: members without waves are named by motions in them
    assert!(!text.contains("in TDOM alone") && !text.contains("no waves act on"), "{text}");
}

#[test]
fn box_heave_with_added_mass_matches_closed_form_period() {
    // 2 pi sqrt((W + A)/(g C)), C = rho g 20 m 20 m: W = 20103.6, A = 20000 kN: 6.336 s; by dry mass 4.486 s
    let stiffness = 1.025 * 9.80665 * 400.0;
    let period = |weight: f64| std::f64::consts::TAU * (weight / 9.80665 / stiffness).sqrt();
    for (load, accepted, want) in
        [("#AMASS *G 0 0 20000", "", period(40103.6325)), ("", "&PARAMETER -ACCEPT_MISSING YES\n", period(20103.6325))]
    {
        let (text, errors) = print_box(load, &format!("{accepted}&STATUS MODES"));
        assert_eq!(errors, 0, "{text}");
        let frequency = format!("{:.4}", std::f64::consts::TAU / want);
        assert!(text.contains(&frequency), "{frequency} in {text}");
    }
}
