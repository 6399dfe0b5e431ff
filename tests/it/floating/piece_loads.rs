//! Wind and current on the pieces of a hull, against numbers derived by hand beside them. The barge is that of the multi-point
//! mooring sample [W-SAMPLE]: a box of 400 x 100 x 20 ft with its origin at bow and keel.

use crate::common;
use crate::common::assert_share;
use crate::common::tangent;

use nalgebra::Vector3;
use tangent::differences;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_base::units::METRES_PER_FOOT;
use windlass_hydro::hull::{Fault, Surface, TubeHull};
use windlass_hydro::steady::{Medium, Steady};
use windlass_hydro::{Category, Floating};
use windlass_model::Model;

const KNOT: f64 = 1852.0 / 3600.0;
/// Pressure of 60 knots (Pa): 1/2 x 1.226 x 30.866667^2.
const WIND: f64 = 0.5 * 1.226 * (60.0 * KNOT) * (60.0 * KNOT);
/// Ends of tubes (ft): upright, level, oblique.
const POINTS: &str = "*A 0 0 -300\n*B 0 0 60\n*C 0 0 0\n*D 100 0 0\n*E 10 20 -30\n*F -20 5 50";
const HULL: &str = "BLOCK HULL 0 -50 0 400 50 20";

/// A body with pieces, in feet, in an environment.
fn body(pieces: &str, environment: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    session
        .open("records", format!("MEDIT\n&DESCRIBE BODY B\n{POINTS}\nEND\n&SURFACE\n{pieces}\nEND\n{environment}\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

fn floating(model: &Model) -> Floating {
    Floating::at_rest(model, &model.bodies["B"]).unwrap()
}

fn sum(model: &Model, category: Category, pose: &Pose) -> Six {
    floating(model).loads.iter().filter(|l| l.category() == category).map(|l| l.mean_load(pose).unwrap().wrench).sum()
}

/// A pose of the origin in feet and turns in degrees.
fn position(values: [f64; 6]) -> Pose {
    let [x, y, z, roll, pitch, yaw] = values;
    let [x, y, z] = [x * METRES_PER_FOOT, y * METRES_PER_FOOT, z * METRES_PER_FOOT];
    Pose::from_place(&Place::new([x, y, z, roll.to_radians(), pitch.to_radians(), yaw.to_radians()]))
}

const AFLOAT: [f64; 6] = [0.0, 0.0, -9.0, 0.0, 0.0, 0.0];

#[test]
fn wind_on_freeboard_matches_closed_form_at_its_centre() {
    let even = "-W_PROFILE POWER 0";
    // ahead: 11 x 100 ft2, 9 + 5.5 ft above the keel
    let ahead = sum(&body(HULL, &format!("&ENV -WIND 60 180 {even}")), Category::Wind, &position(AFLOAT));
    let force = WIND * 11.0 * 100.0 * METRES_PER_FOOT * METRES_PER_FOOT;
    assert_share(ahead[0], force, 1e-12);
    assert_share(ahead[4], 14.5 * METRES_PER_FOOT * force, 1e-12);
    assert!(ahead[1].abs() < 1e-6 * force && ahead[2].abs() < 1e-6 * force && ahead[5].abs() < 1e-6 * force);
    // abeam, from starboard (90): toward -y on 11 x 400 ft2, 200 ft aft of the origin
    let beam = sum(&body(HULL, &format!("&ENV -WIND 60 90 {even}")), Category::Wind, &position(AFLOAT));
    assert_share(beam[1], -4.0 * force, 1e-12);
    assert_share(beam[3], 4.0 * force * 14.5 * METRES_PER_FOOT, 1e-12);
    assert_share(beam[5], -4.0 * force * 200.0 * METRES_PER_FOOT, 1e-12);
    // twice the coefficient across, none along
    let given = body(&format!("{HULL} -CS_WIND 0 2 1"), &format!("&ENV -WIND 60 90 {even}"));
    assert_share(sum(&given, Category::Wind, &position(AFLOAT))[1], -8.0 * force, 1e-12);
}

#[test]
fn wind_profile_is_integrated_over_freeboard() {
    // z^(2/7) from 1 m to h = 3.3528 m, and that of 1 m below it
    let (h, ten): (f64, f64) = (11.0 * METRES_PER_FOOT, 10f64.powf(-2.0 / 7.0));
    let factor = ten * (1.0 + 7.0 / 9.0 * (h.powf(9.0 / 7.0) - 1.0));
    let got = sum(&body(HULL, "&ENV -WIND 60 180"), Category::Wind, &position(AFLOAT))[0];
    // what the parabolas of a strip leave (hydro/strips.rs)
    assert_share(got, WIND * 100.0 * METRES_PER_FOOT * factor, 5e-4);
}

#[test]
fn every_wind_profile_matches_integration_by_fine_slices() {
    for profile in ["POWER", "LOG", "ISO", "ABS", "DNV", "API -W_DESIGN API 15", "NPD -W_DESIGN NPD 60"] {
        let model = body("BLOCK TOWER 0 0 0 30 30 300", &format!("&ENV -WIND 60 180 -W_PROFILE {profile}"));
        let (steady, high) = (Steady::new(&model).unwrap(), 300.0 * METRES_PER_FOOT);
        let slices = 100_000;
        let step = high / f64::from(slices);
        let at = |n: i32| steady.velocity(Medium::Air, (f64::from(n) + 0.5) * step).0.norm_squared();
        let want = 0.5 * 1.226 * 30.0 * METRES_PER_FOOT * step * (0..slices).map(at).sum::<f64>();
        assert_share(sum(&model, Category::Wind, &Pose::default())[0], want, 5e-4);
    }
}

#[test]
fn current_is_integrated_over_the_draft() {
    let current = |v: f64| 0.5 * 1025.0 * v * v;
    let even = body(HULL, "&ENV -CURRENT 2 90");
    let got = sum(&even, Category::ViscousDrag, &position(AFLOAT));
    let force = current(2.0 * METRES_PER_FOOT) * 9.0 * 400.0 * METRES_PER_FOOT * METRES_PER_FOOT;
    assert_share(got[1], -force, 1e-12);
    assert_share(got[3], force * 4.5 * METRES_PER_FOOT, 1e-12);
    // v = 2 (1 - d/40): its square from 0 to 9 ft is 4 x 40/3 (1 - (31/40)^3) ft
    let curve = "&DATA CURVES C_PROFILE C 0 2 40 0\n&ENV -CURRENT C 90";
    let got = sum(&body(HULL, curve), Category::ViscousDrag, &position(AFLOAT));
    let long = 40.0 / 3.0 * (1.0 - 0.775f64.powi(3));
    assert_share(got[1], -force * long / 9.0, 1e-12);
    // int (1 - d/40)^2 d dd = 1600 (1/12 - q^3/3 + q^4/4), q = 31/40, at 9 - d above the keel
    let first = 1600.0 * (1.0 / 12.0 - 0.775f64.powi(3) / 3.0 + 0.775f64.powi(4) / 4.0);
    assert_share(got[3], force / 9.0 * (9.0 * long - first) * METRES_PER_FOOT, 1e-12);
}

#[test]
fn tide_raises_waterline() {
    let model = body(HULL, "&ENV -WIND 60 180 -W_PROFILE POWER 0 -CURRENT 2 180 -DEPTH 600 -TIDE 5");
    assert_share(
        sum(&model, Category::Wind, &position(AFLOAT))[0],
        WIND * 600.0 * METRES_PER_FOOT * METRES_PER_FOOT,
        1e-12,
    );
    assert_share(
        sum(&model, Category::ViscousDrag, &position(AFLOAT))[0],
        512.5 * 4.0 * 1400.0 * METRES_PER_FOOT.powi(4),
        1e-12,
    );
}

#[test]
fn capsized_dry_or_sunken_box_has_projected_areas_of_its_pose() {
    let model = body(HULL, "&ENV -WIND 60 180 -W_PROFILE POWER 0 -CURRENT 2 180");
    let [air, water] =
        [WIND * 100.0 * METRES_PER_FOOT * METRES_PER_FOOT, 0.5 * 1025.0 * 4.0 * 100.0 * METRES_PER_FOOT.powi(4)];
    for (pose, out, under) in [
        ([0.0, 0.0, 11.0, 180.0, 0.0, 0.0], 11.0, 9.0),
        ([0.0, 0.0, 5.0, 0.0, 0.0, 0.0], 20.0, 0.0),
        ([0.0, 0.0, -20.5, 0.0, 0.0, 0.0], 0.0, 20.0),
        // on its side: 100 ft high
        ([0.0, 0.0, 0.0, 90.0, 0.0, 0.0], 10.0, 10.0),
    ] {
        assert_share(sum(&model, Category::Wind, &position(pose))[0], air * out, 1e-9);
        assert_share(sum(&model, Category::ViscousDrag, &position(pose))[0], water * under, 1e-9);
    }
}

#[test]
fn pitched_dry_box_exposes_its_bottom_too() {
    let model = body(HULL, "&ENV -WIND 60 180 -W_PROFILE POWER 0");
    let got = sum(&model, Category::Wind, &position([0.0, 0.0, 200.0, 0.0, 10.0, 0.0]));
    // along x: A_x cos^2 + A_z sin^2 with 2,000 and 40,000 ft2; up: (A_z - A_x) sin cos
    let (sin, cos) = 10f64.to_radians().sin_cos();
    assert_share(got[0], WIND * METRES_PER_FOOT * METRES_PER_FOOT * (2000.0 * cos * cos + 40_000.0 * sin * sin), 1e-12);
    assert_share(got[2], WIND * METRES_PER_FOOT * METRES_PER_FOOT * 38_000.0 * sin * cos, 1e-12);
}

#[test]
fn vertical_area_on_even_keel_matches_deck() {
    // the lift by a pitch is q (A_z - A_x), of wind with the freeboard and of current with the draft
    let model = body(HULL, "&ENV -WIND 60 180 -W_PROFILE POWER 0 -CURRENT 2 180");
    let found = floating(&model);
    let lift = |category| {
        let mine = found.loads.iter().find(|l| l.category() == category).unwrap();
        mine.mean_load(&position(AFLOAT)).unwrap().stiffness[(2, 4)]
    };
    assert_share(lift(Category::Wind), -WIND * METRES_PER_FOOT * METRES_PER_FOOT * (40_000.0 - 1100.0), 1e-12);
    assert_share(
        lift(Category::ViscousDrag),
        -0.5 * 1025.0 * 4.0 * METRES_PER_FOOT.powi(4) * (40_000.0 - 900.0),
        1e-12,
    );
}

#[test]
fn tube_projects_its_diameter_to_every_side() {
    let spar = "TUBE SPAR *A *B 480 -PERM 1";
    for from in [0.0, 17.0, 90.0, 203.0] {
        // 40 ft x 60 ft and 40 ft x 300 ft; a prism of 64 sides is 0.04 % narrower at most, 0.08 % wider
        let model = body(spar, &format!("&ENV -WIND 60 {from} -W_PROFILE POWER 0 -CURRENT 2 {from}"));
        let [wind, current] = [Category::Wind, Category::ViscousDrag].map(|c| sum(&model, c, &Pose::default()));
        assert_share(wind.xy().norm(), WIND * 2400.0 * METRES_PER_FOOT * METRES_PER_FOOT, 1e-3);
        assert_share(current.xy().norm(), 0.5 * 1025.0 * 4.0 * 12_000.0 * METRES_PER_FOOT.powi(4), 1e-3);
    }
    // lying half in the water: its radius is above it
    let model = body("TUBE PONTOON *C *D 120 -PERM 1", "&ENV -WIND 60 90 -W_PROFILE POWER 0");
    assert_share(
        sum(&model, Category::Wind, &Pose::default())[1],
        -WIND * 500.0 * METRES_PER_FOOT * METRES_PER_FOOT,
        1e-3,
    );
}

#[test]
fn tube_prism_is_closed_surface_of_its_perimeter() {
    let tube = TubeHull { ends: [Vector3::new(1.0, 2.0, 3.0), Vector3::new(4.0, -2.0, 3.0)], diameter: 2.0 };
    let prism = tube.prism(64).unwrap();
    assert!(prism.faults().is_empty());
    assert_share(prism.volume(), std::f64::consts::PI * 5.0, 1e-3);
}

#[test]
fn coefficients_act_along_part_axes() {
    let records = "&DESCRIBE PART HOUSE -MOVE 0 0 0 0 0 90\nBLOCK H 0 0 0 10 20 30 -CS_WIND 0 1.5 0";
    let (mut session, _screen, _folder) = common::session();
    let text = records.replace("BLOCK", "&SURFACE\nBLOCK");
    session.open("records", format!("&DESCRIBE BODY B\n{text}\nEND\n&ENV -WIND 60 180 -W_PROFILE POWER 0\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    // y of the part is -x of the body: the area across it is 10 x 30 ft2
    assert_share(
        sum(&session.job.model, Category::Wind, &Pose::default())[0],
        1.5 * WIND * 300.0 * METRES_PER_FOOT * METRES_PER_FOOT,
        1e-12,
    );
}

#[test]
fn piece_without_displacement_takes_wind_only_on_request() {
    let env = "&ENV -WIND 60 180 -W_PROFILE POWER 0 -CURRENT 2 180";
    let forces = |records: &str| {
        let model = body(records, env);
        [Category::Wind, Category::ViscousDrag].map(|c| sum(&model, c, &position(AFLOAT))[0])
    };
    assert_eq!(forces(&format!("{HULL} -PERM 0")), [0.0; 2]);
    assert_eq!(forces(&format!("{HULL} -PERM -1")), [0.0; 2]);
    assert_eq!(forces(&format!("{HULL} -PERM -1 -CS_WIND 1 1 1")), [0.0; 2]);
    let [wind, current] = forces("BLOCK HOUSE 300 -40 20 380 40 60 -PERM 0 -CS_WIND 1 1 1");
    assert_share(wind, WIND * 80.0 * 40.0 * METRES_PER_FOOT * METRES_PER_FOOT, 1e-12);
    assert_eq!(current, 0.0);
}

#[test]
fn multipliers_scale_piece_loads() {
    let env = "&ENV -WIND 60 180 -W_PROFILE POWER 0\n&APPLY -PERCENT -FORCE WIND 50";
    assert_share(
        sum(&body(HULL, env), Category::Wind, &position(AFLOAT))[0],
        WIND * 550.0 * METRES_PER_FOOT * METRES_PER_FOOT,
        1e-12,
    );
}

#[test]
fn open_piece_has_error_instead_of_wind() {
    let records = "BLOCK SAIL -PERM 0 -CS_WIND 1 1 1\nPANEL 0 0 0 0 9 0 0 9 9 0 0 9\nEND_BLOCK";
    let model = body(records, "&ENV -WIND 60 180");
    let error = Floating::at_rest(&model, &model.bodies["B"]).unwrap_err();
    assert!(error.to_string().contains("SAIL") && error.to_string().contains("open"), "{error}");
}

#[test]
fn quick_check_finds_leaks_and_full_check_finds_intersections() {
    let mut two = Surface::block([0.0; 3], [1.0; 3]);
    let other = Surface::block([0.5; 3], [1.5; 3]);
    let first = two.vertices.len() as u32;
    two.vertices.extend(other.vertices);
    two.faces.extend(other.faces.iter().map(|f| f.map(|n| n + first)));
    assert!(two.leaks().is_empty());
    assert!(two.faults().iter().any(|f| matches!(f, Fault::Cut { .. })));
    two.faces.pop();
    assert!(two.leaks().iter().all(|f| matches!(f, Fault::Open { .. })) && two.leaks().len() == 3);
}

#[test]
fn piece_load_tangent_matches_finite_differences_in_any_pose() {
    let curves = "&DATA CURVES C_PROFILE P 0 2.5 8 1.7 40 0.3\n&DATA CURVES C_PROFILE Q 0 0.4 100 0.2\n";
    for pieces in [
        "BLOCK HULL 0 -50 0 400 50 20 -CS_WIND 1 1.2 0.7 -CS_CURRENT 0.5 1.3 0.9",
        "TUBE LEG *E *F 300 -PERM 1 -CS_WIND 1 1.2 0.7 -CS_CURRENT 0.5 1.3 0.9",
    ] {
        for profile in ["POWER", "ISO", "ABS", "API -W_DESIGN API 15"] {
            let env = format!("{curves}&ENV -WIND 55 130 -W_PROFILE {profile} -CURRENT P 110 Q 250 -DEPTH 300 -TIDE 1");
            let found = floating(&body(pieces, &env));
            let loads = found.loads.iter().filter(|l| matches!(l.category(), Category::Wind | Category::ViscousDrag));
            assert_eq!(loads.clone().count(), 2);
            for pose in [
                [0.0, 0.0, -9.3, 0.0, 0.0, 0.0],
                [30.0, -60.0, -3.0, 12.0, -17.0, 63.0],
                [0.0, 0.0, -10.0, -100.0, 25.0, 200.0],
                [5.0, 3.0, -11.0, 1.5, -0.7, 30.0],
                [5.0, 3.0, 150.0, 35.0, -7.0, 30.0],
            ] {
                let pose = position(pose);
                for load in loads.clone() {
                    let (found, want) = (load.mean_load(&pose).unwrap(), differences(load.as_ref(), &pose));
                    let scale = want.amax().max(found.wrench.amax());
                    let off = (found.stiffness - want).amax();
                    assert!(
                        off <= 2e-8 * scale,
                        "{pieces} {profile} {pose:?} {:?}: {off:e} of {scale:e}: {} not {want}",
                        load.category(),
                        found.stiffness
                    );
                }
            }
        }
    }
}
