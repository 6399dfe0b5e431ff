//! Bodies that float: weights, pieces, hydrostatics, and the initial configuration, against numbers by hand. The barge is that of
//! the multi-point mooring sample [W-SAMPLE]: a box of 400 x 100 x 20 ft with its origin at bow and keel.

use crate::common;
use crate::common::assert_share;

use common::session;
use nalgebra::{Vector3, Vector6};
use windlass_base::diagnostic::Severity;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::units::{METRES_PER_FOOT, NEWTONS_PER_KIP};
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::stability::{Attitude, BalanceLimits, StillBody};
use windlass_hydro::{Category, Floating, Hull};
use windlass_model::{Mass, Model};

/// The model of records that must draw no error; and the texts of what else they draw.
fn model(records: &str) -> (Model, Vec<String>) {
    let (mut session, _screen, _folder) = session();
    session.open("records", records.to_string());
    session.run();
    let errors: Vec<_> = session.reports.iter().filter(|r| r.severity == Severity::Error).collect();
    assert!(errors.is_empty(), "{errors:?}");
    (session.job.model.clone(), session.reports.iter().map(|r| r.message.clone()).collect())
}

const BARGE: &str = "MEDIT\n&DESCRIBE BODY TBRG\n*CG 200 0 12\nPGEN HULL\nPLANE 0 400 -RECT 0 20 100\nEND PGEN\nEND\n\
                     &WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n&INSTATE -CONDITION 9\n";

/// Hydrostatics of the first body where it is.
fn state(model: &Model) -> Hydrostatics {
    let body = &model.bodies[0];
    let (hull, pose) = (Hull::new(model, body).unwrap().unwrap(), Pose::from_place(&body.position));
    let mass = Mass::from_parts(model.parts_of(body), model.defaults.gravity);
    Hydrostatics::new(&hull.wet(&pose), &pose, mass.centre, hull.water_weight()).unwrap()
}

#[test]
fn barge_hydrostatics_match_box_formulas() {
    let (length, beam, draft, kg) = (400.0, 100.0, 9.0, 12.0);
    let found = state(&model(BARGE).0);
    let volume = length * beam * draft;
    assert_share(found.volume / METRES_PER_FOOT.powi(3), volume, 1e-12);
    assert_share(found.displacement, volume * METRES_PER_FOOT.powi(3) * 1025.0 * 9.80665, 1e-12);
    assert_share(found.kb / METRES_PER_FOOT, draft / 2.0, 1e-12);
    assert_share(found.plane_area / METRES_PER_FOOT.powi(2), length * beam, 1e-12);
    assert_share(found.wetted_area / METRES_PER_FOOT.powi(2), length * beam + 2.0 * draft * (length + beam), 1e-12);
    assert_share(found.bm_t / METRES_PER_FOOT, beam * beam / (12.0 * draft), 1e-12);
    assert_share(found.bm_l / METRES_PER_FOOT, length * length / (12.0 * draft), 1e-12);
    assert_share(found.gm_t / METRES_PER_FOOT, draft / 2.0 + beam * beam / (12.0 * draft) - kg, 1e-12);
    let [x, y] = found.centre_of_flotation.unwrap();
    assert_share(x / METRES_PER_FOOT, 200.0, 1e-12);
    assert!(y.abs() < 1e-9);
}

#[test]
fn panels_boxes_sections_and_meshes_of_one_form_have_equal_buoyancy() {
    let body = "&DESCRIBE BODY B\n&INSTATE -LOCATE B 0 0 -9 3 2 30\n";
    let want = state(&model(&format!("{body}&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n")).0);
    let corners =
        "*A 0 -50 0\n*B 400 -50 0\n*C 400 50 0\n*D 0 50 0\n*E 0 -50 20\n*F 400 -50 20\n*G 400 50 20\n*H 0 50 20\n";
    let faces = "*A *D *C *B|*E *F *G *H|*A *B *F *E|*B *C *G *F|*C *D *H *G|*D *A *E *H";
    let outward: String = faces.split('|').map(|f| format!("PANEL {f}\n")).collect();
    let inward: String =
        faces.split('|').map(|f| format!("PANEL {}\n", f.split(' ').rev().collect::<Vec<_>>().join(" "))).collect();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("box.obj");
    let obj = "v 0 -500 0\nv 4000 -500 0\nv 4000 500 0\nv 0 500 0\nv 0 -500 200\nv 4000 -500 200\nv 4000 500 200\nv 0 500 200\n\
               f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";
    std::fs::write(&path, obj).unwrap();
    for hull in [
        format!("MEDIT\n&DESCRIBE BODY B\n{corners}&DESCRIBE PIECE HULL\n{outward}END\n"),
        format!("MEDIT\n&DESCRIBE BODY B\n{corners}&DESCRIBE PIECE HULL\n{inward}END\n"),
        "MEDIT\nPGEN HULL\nPLANE 400 100 0 -CARTESIAN 0 0 50 0 50 20 0 20\nEND_PGEN\nEND\n".into(),
        "MEDIT\n&DESCRIBE PIECE HULL\nPGEN\nPLANE 0 50 0 50 20\nPLANE 400 50 0 50 7 50 20\nEND_PGEN\nEND\n".into(),
        format!("&SURFACE\nMESH HULL \"{}\" -SCALE 0.1\nEND\n", path.display()),
        // the box in a part that stands elsewhere, turned by a quarter
        "&DESCRIBE PART HOLD -MOVE 400 0 0 0 0 90\n&SURFACE\nBLOCK HULL -50 0 0 50 400 20\nEND\n".into(),
        // and two halves side by side, and a whole of which a half is taken off and given back by permeability
        "&SURFACE\nBLOCK BOW 0 -50 0 150 50 20\nBLOCK STERN 150 -50 0 400 50 20\nEND\n".into(),
        "&SURFACE\nBLOCK A 0 -50 0 400 50 20\nBLOCK B 10 -5 1 20 5 19 -PERM -1\nBLOCK C 10 -5 1 20 5 19\nEND\n".into(),
    ] {
        let (model, said) = model(&format!("{body}{hull}"));
        let found = state(&model);
        let all = |h: &Hydrostatics| {
            let b = h.centre_of_buoyancy;
            [h.volume, b.x, b.y, b.z, h.plane_area, h.kb, h.bm_t, h.bm_l]
        };
        for (a, b) in all(&found).into_iter().zip(all(&want)) {
            assert!((a - b).abs() <= 1e-9 * b.abs(), "{hull}\n{found:?}\n{want:?}\n{said:?}");
        }
        let turned = said.iter().any(|s| s.contains("look inward"));
        assert_eq!(turned, hull.contains(&inward), "{said:?}");
    }
}

#[test]
fn moved_part_takes_its_pieces_and_weights_along() {
    let records = "MEDIT\n&DESCRIBE BODY B\n&DESCRIBE PART P -MOVE 100 0 5 0 0 90\n*W 10 0 1\n#WEIGHT *W 50 1 2 2\nEND\n&SURFACE\n\
                   BLOCK H 0 0 -10 20 10 0\nEND\n&INSTATE -LOCATE B 0 0 0\n";
    let (model, _) = model(records);
    let mass = Mass::from_parts(model.parts_of(&model.bodies[0]), model.defaults.gravity);
    // the part's x is the body's y
    assert!((mass.centre / METRES_PER_FOOT - Vector3::new(100.0, 10.0, 6.0)).norm() < 1e-9, "{}", mass.centre);
    let radii = mass.radii().map(|k| k.unwrap() / METRES_PER_FOOT);
    for (k, want) in radii.into_iter().zip([2.0, 1.0, 2.0]) {
        assert_share(k, want, 1e-6);
    }
    let found = state(&model);
    // between z = -5 and 0: half of 20 x 10 x 10 ft
    assert_share(found.volume / METRES_PER_FOOT.powi(3), 1000.0, 1e-12);
    let centre = found.centre_of_buoyancy / METRES_PER_FOOT;
    assert!((centre - Vector3::new(95.0, 10.0, -2.5)).norm() < 1e-9, "{centre}");
}

#[test]
fn total_adds_the_missing_weight() {
    let (model, _) = model(
        "MEDIT\n&DESCRIBE BODY B\n*A 100 0 10\n*C 0 20 0\n#WEIGHT *A 300 5 6 7\n#WEIGHT *C 200\nEND\n&WEIGHT -TOTAL B 1000 50 2 8 30 60 70\n",
    );
    let mass = Mass::from_parts(model.parts_of(&model.bodies[0]), model.defaults.gravity);
    assert_share(mass.mass * 9.80665, 1000.0 * NEWTONS_PER_KIP, 1e-12);
    assert!((mass.centre / METRES_PER_FOOT - Vector3::new(50.0, 2.0, 8.0)).norm() < 1e-9);
    for (k, want) in mass.radii().into_iter().zip([30.0, 60.0, 70.0]) {
        assert_share(k.unwrap() / METRES_PER_FOOT, want, 1e-9);
    }
    // 500 kips at (1000 c - 300 a - 200 c') / 500, by hand: x (50000 - 30000) / 500 = 40, y (2000 - 4000) / 500 = -4, z (8000 - 3000) / 500 = 10
    let added = model.parts["B"].weights.last().unwrap();
    assert_share(added.weight, 500.0 * NEWTONS_PER_KIP, 1e-12);
    assert!((Vector3::from(added.at) / METRES_PER_FOOT - Vector3::new(40.0, -4.0, 10.0)).norm() < 1e-9);
}

#[test]
fn margins_compound_and_keep_centre_and_radii() {
    let records = format!("{BARGE}&WEIGHT -MARGIN TBRG 10 -MARGIN TBRG 10\n");
    let (model, _) = model(&records);
    let mass = Mass::from_parts(model.parts_of(&model.bodies[0]), model.defaults.gravity);
    assert_share(mass.mass * 9.80665, 1.21 * 23000.0 * NEWTONS_PER_KIP, 1e-12);
    for (k, want) in mass.radii().into_iter().zip([38.0, 118.0, 120.0]) {
        assert_share(k.unwrap() / METRES_PER_FOOT, want, 1e-9);
    }
}

#[test]
fn body_weight_and_buoyancy_tangent_matches_finite_differences() {
    let (model, _) = model(&format!("{BARGE}&INSTATE -LOCATE TBRG 30 -20 -9 4 1 25\n"));
    let floating = Floating::at_rest(&model, &model.bodies[0]).unwrap();
    assert_eq!(floating.loads.iter().map(|l| l.category()).collect::<Vec<_>>(), [Category::Weight, Category::Buoyancy]);
    let pose = Pose::from_place(&model.bodies[0].position);
    for load in &floating.loads {
        let at = load.mean_load(&pose).unwrap();
        for n in 0..6 {
            let step = if n < 3 { 1e-3 } else { 1e-5 };
            let mut motion = Vector6::zeros();
            motion[n] = step;
            let [up, down] = [motion, -motion].map(|m| load.mean_load(&pose.after_motion(&m)).unwrap().wrench);
            let difference = (down - up) / (2.0 * step);
            // wrenches of 1e10 N m leave 1e-16 * 1e10 / 1e-5 = 0.1 of rounding, beside entries of 1e8 and more
            let size = at.stiffness.amax();
            assert!((difference - at.stiffness.column(n)).amax() < 1e-7 * size, "{:?} {n}", load.category());
        }
    }
}

#[test]
fn tide_raises_water_surface_for_buoyancy() {
    let (low, high) = (state(&model(BARGE).0), state(&model(&format!("&DEFAULT -DEPTH 500\n{BARGE}&ENV -TIDE 2\n")).0));
    assert_share((high.volume - low.volume) / METRES_PER_FOOT.powi(3), 400.0 * 100.0 * 2.0, 1e-12);
}

#[test]
fn linear_stiffness_matches_aqwa_deck_buoyancy() {
    // K33 = 70 kips/ft, 2 ft deeper than at rest: B + 140; rolled by 0.01 rad: moment -12 kips-ft about the centre of gravity
    let (model, _) = model(
        "MEDIT\n&DESCRIBE BODY T\n*CG 30 0 0.5\n#WEIGHT *CG 650\n#HYDROSTATIC *CG 70 1200 60000 -BUOYANCY 650 -ZCGE -0.5\nEND\n\
         &INSTATE -LOCATE T -30 0 -3 0.5729577951308232\n",
    );
    let body = &model.bodies[0];
    let floating = Floating::at_rest(&model, body).unwrap();
    let pose = Pose::from_place(&body.position);
    let total: Vector6<f64> = floating.loads.iter().map(|l| l.mean_load(&pose).unwrap().wrench).sum();
    let depth = 2.0 + 0.5 * (1.0 - 0.01f64.cos());
    assert_share(total[2] / NEWTONS_PER_KIP, 70.0 * depth, 1e-9);
    let arm = pose.axes * floating.mass.centre;
    let about = Vector3::new(total[3], total[4], total[5]) - arm.cross(&Vector3::new(total[0], total[1], total[2]));
    assert_share(about.x / NEWTONS_PER_KIP / METRES_PER_FOOT, -12.0, 1e-9);
}

#[test]
fn hull_with_linear_stiffness_is_refused() {
    let (model, _) = model(&format!("{BARGE}MEDIT\n#HYDROSTATIC *CG 70 1200 60000 -BUOYANCY 650 -ZCGE 3\nEND\n"));
    assert!(Floating::at_rest(&model, &model.bodies[0]).unwrap_err().to_string().contains("count twice"));
}

#[test]
fn open_piece_is_warned_and_has_no_buoyancy() {
    let (model, said) = model(
        "MEDIT\n&DESCRIBE BODY B\n&DESCRIBE PIECE LID\nPANEL 0 0 0  1 0 0  0 1 0\n&DESCRIBE PIECE NONE -PERM 0\nEND\n",
    );
    assert!(said.iter().any(|s| s.contains("LID: it is open")), "{said:?}");
    assert!(said.iter().any(|s| s.contains("NONE: it has no panels")), "{said:?}");
    assert!(Floating::at_rest(&model, &model.bodies[0]).unwrap_err().to_string().contains("LID"));
}

#[test]
fn overlapping_pieces_are_located_and_nested_interior_is_allowed() {
    let two = |p: &str| {
        let records =
            format!("&DESCRIBE BODY B\n&SURFACE\nBLOCK A 0 0 0 10 10 10\nBLOCK B 5 5 5 8 8 8 -PERM {p}\nEND\n");
        model(&records).1
    };
    assert!(two("1").iter().any(|s| s.contains("pieces A and B overlap at")), "{:?}", two("1"));
    assert!(two("-1").is_empty(), "{:?}", two("-1"));
}

#[test]
fn pieces_that_no_waves_move_are_those_of_diftype_none_and_hulls_without_database() {
    let (model, _) = model(
        "&DESCRIBE BODY B\n&SURFACE\nBLOCK PLAIN 0 0 0 9 9 9\nBLOCK PRESSED 10 0 0 19 9 9 -DIFTYPE FK\nBLOCK NONE 20 0 0 29 9 9 -DIFTYPE NONE\n\
         BLOCK HELD 30 0 0 39 9 9 -DIFTYPE 3DDIF\nBLOCK THIN 40 0 0 49 9 9 -PERM 0\nEND_&SURFACE\nMEDIT\n&DESCRIBE COMPARTMENT T\n\
         &DESCRIBE PIECE TANK -DIFTYPE NONE\nPANEL 1 1 1  1 2 1  2 1 1\nPANEL 1 1 1  2 1 1  1 1 2\nPANEL 1 1 1  1 1 2  1 2 1\nPANEL 2 1 1  1 2 1  1 1 2\nEND\n",
    );
    let pieces = windlass_hydro::morison::pieces_without_wave_load(&model, &model.bodies[0]);
    assert_eq!(pieces.map(|piece| piece.name.as_str()).collect::<Vec<_>>(), ["PLAIN", "NONE"]);
}

#[test]
fn pieces_of_surface_menu_are_compared_once_at_its_end() {
    // a well that DIFFERENCE takes out, and three boxes of which each reaches into the next; the last is renamed
    let records = "&DESCRIBE BODY B\n&SURFACE\nBLOCK HULL 0 -10 0 60 10 6\nBLOCK WELL 20 -5 -1 30 5 8\nDIFFERENCE HULL HULL WELL\n\
                   BLOCK BOX 60 -10 0 80 10 6\nBLOCK OVER 70 -10 0 90 10 6\nBLOCK OLD 85 -3 0 95 3 6\nRENAME_BLOCK OLD FRESH\n";
    let (_, said) = model(&format!("{records}END_&SURFACE\n"));
    let pairs: Vec<&str> = said.iter().map(|text| text.split(" overlap at").next().unwrap_or_default()).collect();
    assert!(pairs.len() == 2 && pairs[0].ends_with("pieces BOX and OVER"), "{pairs:?}");
    assert!(pairs[1].ends_with("pieces OVER and FRESH"), "{pairs:?}");
}

#[test]
fn conditions_of_several_bodies_keep_position_and_heading() {
    let (model, _) = model(
        "&DESCRIBE BODY A\n&DESCRIBE BODY B\n&INSTATE -LOCATE A 1 2 3 4 5 6 -LOCATE B 7 8 9 10 11 12\n\
         &INSTATE -CONDITION A 9 1 2 -CONDITION 5\n",
    );
    let values = |name: &str| {
        let [x, y, z, a, b, c] = model.bodies[name].position.values();
        [x / METRES_PER_FOOT, y / METRES_PER_FOOT, z / METRES_PER_FOOT, a.to_degrees(), b.to_degrees(), c.to_degrees()]
            .map(|v| (v * 1e9).round() / 1e9)
    };
    assert_eq!(values("A"), [1.0, 2.0, -9.0, 1.0, 2.0, 6.0]);
    // the body described last, at 5 ft draft, upright
    assert_eq!(values("B"), [7.0, 8.0, -5.0, 0.0, 0.0, 12.0]);
}

#[test]
fn positive_roll_lifts_starboard_and_trim_sinks_stern() {
    let (model, _) =
        model("MEDIT\n&DESCRIBE BODY A\n*STARBOARD 0 10 0\n*STERN 10 0 0\nEND\n&INSTATE -CONDITION 0 5 0\n");
    assert!(model.global(&model.points["*STARBOARD"])[2] > 0.0);
    let (model, _) =
        self::model("MEDIT\n&DESCRIBE BODY A\n*STARBOARD 0 10 0\n*STERN 10 0 0\nEND\n&INSTATE -CONDITION 0 0 5\n");
    assert!(model.global(&model.points["*STERN"])[2] < 0.0);
}

#[test]
fn move_and_its_inverse_restore_configuration() {
    let records = "&DESCRIBE BODY A\n&INSTATE -LOCATE A 1 2 3 40 50 60\n&INSTATE -MOVE A 1 2 4 8 16 32\n&INSTATE -MOVE A -1 -2 -4 -8 -16 -32\n";
    let position = model(records).0.bodies["A"].position;
    let want = [
        METRES_PER_FOOT,
        2.0 * METRES_PER_FOOT,
        3.0 * METRES_PER_FOOT,
        40f64.to_radians(),
        50f64.to_radians(),
        60f64.to_radians(),
    ];
    for (a, b) in position.values().into_iter().zip(want) {
        assert!((a - b).abs() < 1e-15 * (1.0 + b), "{position:?}");
    }
}

#[test]
fn box_righting_arm_matches_wall_sided_formula() {
    // while neither bilge nor deck edge crosses the surface (tan roll < 9 / 50): GZ = sin roll (GM + BM tan^2 roll / 2), with the draft
    // that carries the weight; trim stays zero, and the heading does not matter
    let (model, _) = model(BARGE);
    let still = StillBody::new(&model, &model.bodies[0], None).unwrap();
    let draft = 23000.0 * NEWTONS_PER_KIP / (1025.0 * 9.80665) / METRES_PER_FOOT.powi(3) / 40_000.0;
    let bm = 10_000.0 / 12.0 / draft;
    let gm = draft / 2.0 + bm - 12.0;
    for (degrees, yaw) in [(0.5f64, 0.0), (5.0, 1.0), (10.0, -2.0), (-10.0, 3.0)] {
        let roll = degrees.to_radians();
        let from = Attitude::from_place(&Place::new([5.0, 6.0, -2.0, roll, 0.0, yaw]));
        let found = still.balance(&from, [true, false, true], &BalanceLimits::default()).unwrap();
        let want = roll.sin() * (gm + 0.5 * bm * roll.tan().powi(2));
        assert_share(found.arm / METRES_PER_FOOT, want, 1e-8);
        assert!(found.attitude.trim.abs() < 1e-9, "{found:?}");
    }
}

#[test]
fn sinking_body_has_no_righting_arm() {
    let (model, _) =
        model("MEDIT\n&DESCRIBE BODY B\n*P 5 5 5\n#WEIGHT *P 5000\nEND\n&SURFACE\nBLOCK H 0 0 0 10 10 10\nEND\n");
    let still = StillBody::new(&model, &model.bodies[0], None).unwrap();
    let from = Attitude::from_place(&Place::default());
    let error = still.balance(&from, [true, false, true], &BalanceLimits::default()).unwrap_err();
    assert!(error.to_string().contains("no balance"));
}

#[test]
fn hydrostatics_report_is_in_user_units() {
    let (mut session, screen, _folder) = session();
    session.open(
        "records",
        format!("{BARGE}&STATUS HYDROSTATICS\n&STATUS WEIGHT\nHSTATICS\nCFORM 9 1 2\nREPORT\nEND\nEND\n"),
    );
    session.run();
    let text = screen.text();
    // 360,000 ft3; BM 100^2 / (12 x 9); the weight of water over 40,000 ft2, 63.989 lb/ft3; GM = 4.5 + 92.593 - 12
    for wanted in ["360000.00 ft3", "92.59 ft", "2.55955E+03", "85.09 ft", "23000.00", "118.00"] {
        assert!(text.contains(wanted), "{wanted} in {text}");
    }
    assert!(session.reports.is_empty(), "{:?}", session.reports);
}
