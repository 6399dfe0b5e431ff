//! Records whose effect no solver computes stop the solves they matter to, unless that is accepted.

use crate::common::print_records;

/// What a session with a floating box of 20 x 20 x 10 m and a piece more prints after records; and its errors.
fn print_box(piece: &str, records: &str) -> (String, i64) {
    print_records(&format!(
        "&DIMEN -DIMEN METERS KN\n&DEFAULT -WATER 1025 -G 9.80665\n&ENV -DEPTH 100 -TIME 2 0.1\n&DATA CURVES CS_VELOCITY CSV 1 1 2 0.5\n\
             MEDIT\n&DESCRIBE BODY BOX -IGNORE X Y RX RY RZ\n*G 0 0 -1\n#WEIGHT *G 20103.6325 7 7 8\nEND\n&SURFACE\n\
             BLOCK H -10 -10 -5 10 10 5\n{piece}\nEND\n{records}\n"
    ))
}

const FIN: &str = "BLOCK FIN -1 -1 -8 1 1 -5 -PERM 0";

#[test]
fn effect_on_motions_stops_motions_and_not_rest() {
    for (option, effect) in [
        ("-DD_MULT 2 1 4 2", "-DD_MULT 2 1 4 2 of piece FIN (factors by ratio"),
        ("-OBSTACLE", "-OBSTACLE of piece FIN (what a fixed obstacle"),
        ("-AMASS 1", "-AMASS 1 of piece FIN (added mass"),
    ] {
        for records in ["&STATUS MODES", "TDOM", "FREQ_RESPONSE\nRAO -PERIOD 9\nEND"] {
            let (text, errors) = print_box(&format!("{FIN} {option}"), records);
            assert!(errors == 1 && text.contains("the solve stops: not computed is"), "{option} {records}: {text}");
            assert!(text.contains(effect) && text.contains("-ACCEPT_MISSING YES"), "{option} {records}: {text}");
        }
        let (text, errors) = print_box(&format!("{FIN} {option}"), "&EQUI");
        assert!(errors == 0 && text.contains("natural periods are left out"), "{option}: {text}");
    }
}

#[test]
fn effect_on_forces_stops_every_solve() {
    for records in ["&EQUI", "TDOM", "&STATUS MODES", "HSTATICS BOX\nRARM 5 2"] {
        let (text, errors) = print_box(&format!("{FIN} -CS_VELOCITY CSV"), records);
        assert!(errors >= 1 && text.contains("-CS_VELOCITY CSV of piece FIN (drag factors"), "{records}: {text}");
    }
}

#[test]
fn accepted_effect_is_named_in_every_report() {
    for records in ["&EQUI", "TDOM", "&STATUS MODES", "&STATUS FORCE", "HSTATICS BOX\nRARM 5 2\nREPORT\nEND"] {
        let (text, errors) =
            print_box(&format!("{FIN} -CS_VELOCITY CSV"), &format!("&PARAMETER -ACCEPT_MISSING YES\n{records}"));
        let line = "not computed, as &PARAMETER -ACCEPT_MISSING accepts: -CS_VELOCITY CSV of piece FIN";
        assert!(errors == 0 && text.contains(line), "{records}: {text}");
    }
}

#[test]
fn colour_of_piece_stops_no_solve() {
    let (text, errors) = print_box(&format!("{FIN} -COLOR RED"), "&EQUI\nTDOM");
    assert!(errors == 0 && !text.contains("not computed"), "{text}");
}

#[test]
fn obstacle_adds_no_buoyancy() {
    // the box alone: 1.025 x 9.80665 kN/m3 x 20 m x 20 m x 5 m = 20103.6325 kN
    let (text, _) = print_box("BLOCK WALL 12 -10 -5 20 10 5 -OBSTACLE", "&STATUS HYDROSTATICS");
    let line = text.lines().find(|line| line.contains("Displacement")).unwrap_or_default();
    assert!(line.contains("20103.6"), "{text}");
}
