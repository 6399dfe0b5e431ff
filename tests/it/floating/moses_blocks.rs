//! Blocks of `&SURFACE` combined, meshes by vertices, tanks by tubes: volumes by closed forms, through records.

use crate::common::{self, assert_share};
use std::f64::consts::{FRAC_PI_4, TAU};
use windlass_base::diagnostic::Severity;

/// Sea water of 1 t/m3, metres and tonnes, so that a displacement in m-tons is a volume in m3.
const UNITS: &str = "&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -WATER 1000 -G 9.80665\n";

/// What a session prints, and its errors with their help.
fn printed(records: &str) -> (String, Vec<String>) {
    let (mut session, screen, _folder) = common::session();
    session.open("records", format!("{UNITS}{records}\n"));
    session.run();
    session.job.output.flush();
    let errors = session.reports.iter().filter(|report| report.severity == Severity::Error);
    (screen.text(), errors.map(|error| format!("{} {}", error.message, error.help.join(" "))).collect())
}

/// The volume of body B of these surface records (m3).
fn volume(surfaces: &str) -> f64 {
    let (text, errors) = printed(&format!(
        "MEDIT\n&DESCRIBE BODY B\nEND\n&SURFACE\n{surfaces}\nEND_&SURFACE\n&TYPE VOLUME &BODY(MAX_BUOY B)"
    ));
    assert_eq!(errors, Vec::<String>::new(), "{surfaces}: {text}");
    word_behind(&text, "VOLUME")
}

fn word_behind(text: &str, word: &str) -> f64 {
    let line = text.lines().find_map(|line| line.trim().strip_prefix(word)).unwrap_or_else(|| panic!("{word}: {text}"));
    line.split_whitespace().next().unwrap().parse().unwrap()
}

/// 8 x 6 x 4 m, and the same moved by (5, 4, 3): they share 3 x 2 x 1 m.
const TWO: &str = "BLOCK A 0 0 0 8 6 4\nBLOCK C 5 4 3 13 10 7\n";

#[test]
fn combined_blocks_have_volumes_of_counting() {
    for (records, want) in [
        ("UNION H A C", 378.0),
        ("INTERSECT H A C", 6.0),
        ("DIFFERENCE H A C", 186.0),
        ("H = A UNION C", 378.0),
        ("A = A DIFFERENCE C", 186.0),
        // left to right: what is left of the union without 1 x 1 x 1 m in its corner
        ("BLOCK D 0 0 0 1 1 1\nH = A UNION C DIFFERENCE D", 377.0),
        ("BLOCK D 20 0 0 21 1 1\nUNION H A C D", 379.0),
        ("RENAME_BLOCK C D\nH = A UNION D", 378.0),
        ("DELETE_BLOCK C", 192.0),
    ] {
        assert_share(volume(&format!("{TWO}{records}")), want, 1e-8);
    }
}

#[test]
fn leg_wells_are_cut_out_of_hull() {
    // two round wells of 16 sides of radius 4 m, right through 8 m of hull; the second is a copy of the first
    let hull = "BLOCK HULL 0 -20 0 70 20 8\nBLOCK W1 -LOCATION 12 0 0 0 -90 0\nPLANE -1 9 -CIRC 0 0 4 17\nEND_BLOCK\nCOPY_BLOCK W1 W2 46\n\
                HULL = HULL DIFFERENCE W1 DIFFERENCE W2";
    let well = 0.5 * 16.0 * 4.0 * 4.0 * (TAU / 16.0).sin() * 8.0;
    assert_share(volume(hull), 70.0 * 40.0 * 8.0 - 2.0 * well, 1e-8);
}

#[test]
fn loose_blocks_stay_and_emit_takes_result() {
    let (text, errors) = printed(&format!(
        "&SURFACE\n{TWO}H = A UNION C\nLIST_BLOCK\nEND_&SURFACE\nINMODEL\n&DESCRIBE BODY B\nEMIT H -PERM 0.5\nEND\n&TYPE VOLUME &BODY(MAX_BUOY B)"
    ));
    assert_eq!(errors, Vec::<String>::new(), "{text}");
    assert_share(word_behind(&text, "VOLUME"), 189.0, 1e-8);
    // EMIT of what is in the body already changes nothing
    let (text, errors) = printed(&format!(
        "INMODEL\n&DESCRIBE BODY B\n&SURFACE\n{TWO}H = A UNION C\nEMIT H\nEND_&SURFACE\nEND\n&TYPE VOLUME &BODY(MAX_BUOY B)"
    ));
    assert_eq!(errors, Vec::<String>::new(), "{text}");
    assert_share(word_behind(&text, "VOLUME"), 378.0, 1e-8);
}

#[test]
fn combinations_that_fail_name_blocks_and_change_nothing() {
    let open = "MESH M\nPANEL 0 0 0  0 1 0  1 0 0\nPANEL 0 0 0  1 0 0  0 0 1\nEND_MESH\n";
    for (records, says) in [
        ("H = A INTERSECT FAR", "A INTERSECT FAR: nothing is left"),
        ("H = A UNION M", "piece M: it is open"),
        ("H = A UNION CC", "unknown piece CC"),
        ("H = A JOIN C", "operation between blocks"),
        ("H = A UNION", "a block is missing after the operation"),
        ("H =", "a block is missing after `=`"),
        ("H = A", "an operation is missing"),
        ("C = A UNION FAR", "piece C exists already"),
        ("UNION H A", "UNION lacks its value B"),
        ("RENAME_BLOCK A C", "piece C exists already"),
        ("DELETE_BLOCK A AA", "unknown piece AA"),
        ("H = A UNION T", "T is a TUBE"),
    ] {
        let (text, errors) = printed(&format!(
            "MEDIT\n&DESCRIBE BODY B\n*P 50 0 0\n*Q 60 0 0\nEND\n&SURFACE\nBLOCK A 0 0 0 8 6 4\nBLOCK C 20 0 0 21 1 1\nBLOCK FAR 30 0 0 31 1 1\n\
             TUBE T *P *Q 1000 -PERM 0\n{open}{records}\nDELETE_BLOCK M\nEND\n&TYPE VOLUME &BODY(MAX_BUOY B)"
        ));
        assert!(errors.len() == 1 && errors[0].contains(says), "{records}: {errors:?} {text}");
        assert_share(word_behind(&text, "VOLUME"), 194.0, 1e-8);
    }
}

#[test]
fn mesh_by_vertices_encloses_its_tetrahedron() {
    // legs of 3 m: 27/6 m3; vertices by number, by name, as points, without a name of the mesh
    let faces = "PANEL 1 3 2\nPANEL 1 2 4\nPANEL 1 4 3\nPANEL 2 3 4\nEND_MESH";
    let numbered = format!("MESH\nVERTEX 0 0 0\nVERTEX 3 0 0\nVERTEX 0 3 0\nVERTEX 0 0 3\n{faces}");
    let named = format!("MESH M\nVERTEX 1 0 0 0\nVERTEX 2 3 0 0\nVERTEX 3 0 3 0\nVERTEX 4 0 0 3\n{faces}");
    let points = "MESH\n*V1 0 0 0\n*V2 3 0 0\n*V3 0 3 0\n*V4 0 0 3\nPANEL *V1 *V3 *V2\nPANEL *V1 *V2 *V4\nPANEL *V1 *V4 *V3\nPANEL *V2 *V3 *V4\nEND_MESH";
    for records in [numbered.as_str(), named.as_str(), points] {
        assert_share(volume(records), 4.5, 1e-8);
    }
    let (_, errors) =
        printed("&DESCRIBE BODY B\n&SURFACE\nMESH M\nVERTEX 0 0 0\nPANEL 1 2 3\nVERTEX 1 4 4 4\nEND_MESH\nEND");
    assert!(
        errors.len() == 2 && errors[0].contains("unknown vertex 2") && errors[1].contains("vertex 1 is given"),
        "{errors:?}"
    );
}

#[test]
fn boxes_by_corners_need_no_name() {
    assert_share(volume("BLOCK 0 0 0 2 3 4\nBLOCK 10 0 0 9 2*1.5 4 -PERM 0.5"), 24.0 + 6.0, 1e-8);
}

#[test]
fn tube_tank_holds_volume_within_its_wall() {
    // 500 mm with a wall of 10 mm, 7 m long, twice, of fresh water: pi/4 0.48^2 7 m3 each
    let tank =
        "MEDIT\n&DESCRIBE BODY B\nPGEN\nPLANE 0 9 -RECT 0 6 6\nEND\n*P1 1 0 1\n*P2 8 0 1\n*P3 1 1 1\n*P4 8 1 1\n";
    let (text, errors) = printed(&format!(
        "{tank}&DESCRIBE COMPARTMENT T1\nTUBTANK *P1 *P2 500 10\nTUBTANK *P3 *P4 480\nEND\n&COMPARTMENT -PERCENT T1 100 1\n\
         &TYPE HELD &TOKEN(2 &COMPARTMENT(T1 -AMOUNT))"
    ));
    assert_eq!(errors, Vec::<String>::new(), "{text}");
    assert_share(word_behind(&text, "HELD"), 2.0 * FRAC_PI_4 * 0.48 * 0.48 * 7.0, 1e-7);
    let (_, errors) =
        printed(&format!("{tank}TUBTANK *P1 *P2 500 10\n&DESCRIBE COMPARTMENT T1\nTUBTANK *P1 *P2 500 250\nEND"));
    assert!(
        errors.len() == 2 && errors[0].contains("belongs to a compartment") && errors[1].contains("no space"),
        "{errors:?}"
    );
}

#[test]
fn points_of_ground_are_global_after_describe_part_ground() {
    let (text, errors) = printed(
        "INMODEL\n&DESCRIBE BODY B\n&DESCRIBE PART GROUND\n*G 1 2 3\n&DESCRIBE BODY B\n*P 1 2 3\nEND\n&INSTATE -LOCATE B 10 0 0\n\
         &TYPE G &POINT(COORDINATES *G -GLOBAL)\n&TYPE P &POINT(COORDINATES *P -GLOBAL)",
    );
    assert_eq!(errors, Vec::<String>::new(), "{text}");
    assert_eq!((word_behind(&text, "G "), word_behind(&text, "P ")), (1.0, 11.0), "{text}");
}
