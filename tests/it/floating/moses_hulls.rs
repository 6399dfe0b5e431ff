//! Hulls in the forms of MOSES: names left out, sections by rectangle, circle and points, blocks on both sides, surfaces before a body.

use crate::common::{assert_near, fact, print_metric_records};

/// The displaced volume of each piece of body B, deep under water, by &STATUS HYDROSTATICS of the body.
fn volume(records: &str) -> f64 {
    let (text, errors) = print_metric_records(&format!("{records}\n&INSTATE -CONDITION 500\n&STATUS HYDROSTATICS"));
    assert_eq!(errors, 0, "{text}");
    fact(&text, "Volume")
}

const BARGE: &str = "MEDIT\n&DESCRIBE BODY BARGE\nPGEN\nPLANE 0 91.5 -RECT 0 6.10 27.50\nEND\nEND\n\
    &WEIGHT -TOTAL BARGE 6000 45.75 0 5 9 25 25\n&INSTATE -CONDITION 2.32634";

#[test]
fn tutorial_barge_without_a_name_has_wall_sided_hydrostatics() {
    // closed forms of a box of 91.5 x 27.5 m under 6000 t, KG 5 m: d = W/(rho L B), BMT = B^2/(12 d), BML = L^2/(12 d)
    let (text, errors) = print_metric_records(&format!("{BARGE}\n&EQUI\n&STATUS HYDROSTATICS"));
    assert_eq!(errors, 0, "{text}");
    for (name, want) in [
        ("KB", 1.16317),
        ("BM Transverse", 27.0901),
        ("GM Transverse", 23.2533),
        ("BM Longitudinal", 299.908),
        ("GM Longitudinal", 296.071),
    ] {
        // reports have two decimals
        assert!((fact(&text, name) - want).abs() <= 0.0051, "{name} {want}: {text}");
    }
    let (text, _) = print_metric_records(&format!("{BARGE}\nHSTATICS\nRARM 2.5 3\nREPORT\nEND\nEND"));
    // wall-sided formula GZ = sin a (GM + BM/2 tan^2 a): 1.01542, 2.03569, 3.06580 m
    for want in ["1.0154", "2.0357", "3.0658"] {
        assert!(text.contains(want), "{want}: {text}");
    }
}

#[test]
fn pieces_without_names_are_numbered() {
    let (text, errors) = print_metric_records(
        "MEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 9 -RECT 0 3 4\nEND\n&DESCRIBE PIECE -PERM 0\nPANEL 0 0 -9 0 1 -9 1 0 -9\nPGEN\n\
         PLANE 20 29 -RECT 0 3 4\nEND\nEND\n&SURFACE\nBLOCK\nPLANE 40 49 -RECT 0 3 4\nEND_BLOCK\nEND\n&STATUS PIECES",
    );
    assert_eq!(errors, 0, "{text}");
    for name in ["PIECE1", "PIECE2", "PIECE3", "PIECE4"] {
        assert!(text.contains(name), "{name}: {text}");
    }
}

#[test]
fn sections_enclose_volumes_of_closed_forms() {
    let body = "MEDIT\n&DESCRIBE BODY B";
    let octagon = 4.0 * 31.5 * 31.5 * std::f64::consts::FRAC_PI_4.sin();
    for (what, records, want) in [
        ("points of -RECT change nothing", "PGEN\nPLANE 0 10 -RECT 0 4 6 9\nEND", 240.0),
        ("nine points are eight sides", "PGEN\nPLANE 0 2 -CIRC 0 0 31.5 9\nEND", 2.0 * octagon),
        ("half circle by an arc is mirrored", "PGEN\nPLANE 0 2 -CIRC 0 0 31.5 5 -90 45\nEND", 2.0 * octagon),
        ("-STBD is half of a rectangle", "PGEN -STBD\nPLANE 0 10 -RECT 0 4 6\nEND", 120.0),
        ("-BOTH is both halves", "PGEN -BOTH\nPLANE 0 10 -RECT 0 4 6\nEND", 240.0),
        ("-PORT of points", "PGEN -PORT\nPLANE 0 10 -CART 2 0 5 0 5 4 2 4\nEND", 120.0),
        ("points with y < 0 are the section", "PGEN\nPLANE 0 10 -CART -2 0 1 0 1 4 -2 4\nEND", 120.0),
        // a prismatoid between a square of 2 m and one of 4 m, with unequal numbers of points: h/6 (4 + 4*9 + 16)
        ("unequal points", "PGEN\nPLANE 0 -RECT -1 1 2\nPLANE 6 -CART 2 -2 2 0 2 2\nEND", 56.0),
        (
            "circle to rectangle",
            "PGEN\nPLANE 0 3 -CIRC 0 0 2 5 -45\nPLANE 5 -RECT -1.4142135623730951 1.4142135623730951 2.8284271247461903\nEND",
            40.0,
        ),
    ] {
        let found = volume(&format!("{body}\n{records}\nEND"));
        // reports have two decimals, long numbers fewer
        assert!((found - want).abs() <= 0.006 + 5e-5 * want, "{what}: {found} is not {want}");
    }
}

#[test]
fn location_turns_and_shifts_a_piece() {
    let (text, errors) = print_metric_records(
        "MEDIT\n&DESCRIBE BODY B\nPGEN P -LOCATION 100 20 5 0 0 90\nPLANE 0 10 -RECT 0 4 6\nEND\nEND\n&STATUS PIECES",
    );
    assert_eq!(errors, 0, "{text}");
    let row = text.lines().find(|line| line.contains("panels")).unwrap_or_default();
    let numbers: Vec<f64> = row.split_whitespace().filter_map(|word| word.parse().ok()).collect();
    // x 0..10, y -3..3, z 0..4 turned by 90 degrees and shifted: x 97..103, y 20..30, z 5..9
    for want in [97.0, 20.0, 5.0, 103.0, 30.0, 9.0] {
        assert!(numbers.iter().any(|x| (x - want).abs() < 0.006), "{want}: {row}");
    }
}

#[test]
fn surfaces_before_body_displace_only_after_emit() {
    let surfaces = "&SURFACE\nBLOCK COLUMN -LOCATION 0 0 -5\nPLANE 0 2 -CIRC 0 0 31.5 9\nEND_BLOCK\nCOPY_BLOCK COLUMN SECOND 100\n\
        REFLECT_BLOCK SECOND\nEND_&SURFACE\n&DESCRIBE BODY B";
    let (text, errors) = print_metric_records(&format!("{surfaces}\n&STATUS HYDROSTATICS"));
    assert!(errors == 0 && !text.contains("Volume"), "{text}");
    let octagon = 4.0 * 31.5 * 31.5 * std::f64::consts::FRAC_PI_4.sin();
    assert_near(volume(&format!("{surfaces}\nEMIT COLUMN")), 2.0 * octagon, 1e-4);
    assert_near(volume(&format!("{surfaces}\nEMIT @")), 4.0 * octagon, 1e-4);
}

#[test]
fn system_of_four_points_places_points_by_hand() {
    // x from *P1 to *P2, which is +Y; *P3 to *P4 is -X, so that z = (0 1 0) x (-1 0 0) = +Z and y = -X: (2 3 4) stands at (10-3 20+2 30+4).
    // Of *Q1 to *Q2 along (1 0 1): x = (1 0 1)/sqrt 2, the way (0 1 0), z = (-1 0 1)/sqrt 2, y = (0 1 0)
    let script = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P1 5 0 0\n*P2 5 7 0\n*P3 9 1 0\n*P4 2 1 0\n*Q1 1 1 1\n*Q2 3 1 3\n*Q3 0 0 0\n*Q4 0 5 0\n\
                  &DEFAULT -LOCATION 10 20 30 *P1 *P2 *P3 *P4\n*A 2 3 4\n&DEFAULT -LOCATION 10 20 30 *Q1 *Q2 *Q3 *Q4\n&DEFAULT -RECT\nEND\n";
    let at = crate::common::function_values(script, "&POINT(COORDINATES *A)");
    let near = |got: &[f64], want: [f64; 3]| got.iter().zip(want).all(|(g, w)| (g - w).abs() < 1e-12);
    assert!(near(&at, [7.0, 22.0, 34.0]), "{at:?}");
    let tilted = script.replace("&DEFAULT -RECT\n", "").replace("*A 2 3 4\n", "").replace("END\n", "*A 2 3 4\nEND\n");
    let at = crate::common::function_values(&tilted, "&POINT(COORDINATES *A)");
    let root = 2f64.sqrt();
    assert!(near(&at, [10.0 + 2.0 / root - 4.0 / root, 23.0, 30.0 + 2.0 / root + 4.0 / root]), "{at:?}");
}
