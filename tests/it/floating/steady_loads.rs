//! Wind, current and mean wave drift on bodies, against numbers derived by hand beside them.

use crate::common::assert_share;
use crate::common::run::{body, model};
use crate::common::tangent;

use nalgebra::Vector3;
use tangent::differences;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::area::AreaLoad;
use windlass_hydro::steady::{Medium, Steady};
use windlass_hydro::wind::{WindField, WindProfile};
use windlass_hydro::{BodyLoad, Category, Floating};
use windlass_model::Model;

const KNOT: f64 = 1852.0 / 3600.0;

fn sum(model: &Model, category: Category, pose: &Pose) -> Six {
    let floating = Floating::at_rest(model, &model.bodies["B"]).unwrap();
    floating.loads.iter().filter(|l| l.category() == category).map(|l| l.mean_load(pose).unwrap().wrench).sum()
}

fn position(values: [f64; 6]) -> Pose {
    let [x, y, z, roll, pitch, yaw] = values;
    Pose::from_place(&Place::new([x, y, z, roll.to_radians(), pitch.to_radians(), yaw.to_radians()]))
}

fn wind_at(environment: &str, height: f64) -> f64 {
    let model = model(environment);
    WindField::from_environment(&model.environment).unwrap().unwrap().speed(height).0
}

#[test]
fn wind_of_sixty_knots_on_area_matches_closed_form() {
    let model = body("*P 0 0 10\n#AREA *P 100 400", "&ENV -WIND 60 180");
    let got = sum(&model, Category::Wind, &Pose::default());
    // 60 kn = 30.8667 m/s; 1/2 x 1.226 x 100 x 952.751 = 58403.6 N toward +x, 10 m up
    assert_share(got[0], 58_403.6, 1e-6);
    assert_share(got[4], 584_036.0, 1e-6);
    assert_eq!(got[1], 0.0);
}

#[test]
fn wind_acts_from_its_direction_and_rotates_with_body() {
    // from 90: it blows toward -y; on a body yawed by 90 degrees that is from ahead, on the area along x
    let model = body("*P 0 0 10\n#AREA *P 100 400", "&ENV -WIND 60 90");
    let got = sum(&model, Category::Wind, &position([0.0, 0.0, 0.0, 0.0, 0.0, 90.0]));
    assert_share(got[1], -58_403.6, 1e-6);
    assert!(got[0].abs() < 1e-9);
}

#[test]
fn oblique_wind_uses_area_components_and_full_speed() {
    let model = body("*P 0 0 10\n#AREA *P 100 400", "&ENV -WIND 60 150");
    let got = sum(&model, Category::Wind, &Pose::default());
    assert_share(got[0], 58_403.6 * 30f64.to_radians().cos(), 1e-6);
    assert_share(got[1], -4.0 * 58_403.6 * 30f64.to_radians().sin(), 1e-6);
}

#[test]
fn published_wind_profiles_match_values() {
    // power law, 1/7: (50/10)^(1/7) = 1.2584989; [API-RP-2A], 20th edition: 5^0.125 = 1.2228445
    assert_share(wind_at("&ENV -WIND 60 0", 50.0), 60.0 * KNOT * 1.258_498_95, 1e-8);
    assert_share(wind_at("&ENV -WIND 60 0 -W_PROFILE API", 50.0), 60.0 * KNOT * 1.222_844_55, 1e-8);
    assert_share(wind_at("&ENV -WIND 60 0 -W_PROFILE POWER 0.1", 100.0), 60.0 * KNOT * 1.258_925_41, 1e-8);
    // [ISO-19901-1]: C = 0.0573 sqrt(1 + 0.15 x 30.866667) = 0.1359593; 1 + C ln 5 = 1.2188180
    assert_share(wind_at("&ENV -WIND 60 0 -W_PROFILE ISO", 50.0), 60.0 * KNOT * 1.218_818_0, 1e-7);
    // DNV: 1 + 0.137 ln 5 = 1.2204930
    assert_share(wind_at("&ENV -WIND 60 0 -W_PROFILE DNV", 50.0), 60.0 * KNOT * 1.220_493, 1e-6);
    // ABS: height coefficient 1.10 in the middle of the band of 50 to 100 ft, 1.30 in that of 150 to 200 ft
    assert_share(wind_at("&ENV -WIND 60 0 -W_PROFILE ABS", 22.86), 60.0 * KNOT * 1.1f64.sqrt(), 1e-12);
    assert_share(wind_at("&ENV -WIND 60 0 -W_PROFILE ABS", 53.34), 60.0 * KNOT * 1.3f64.sqrt(), 1e-12);
}

#[test]
fn charnock_roughness_satisfies_its_equation() {
    let model = model("&ENV -WIND 60 0 -W_PROFILE LOG");
    let WindProfile::Logarithmic(z0) = WindField::from_environment(&model.environment).unwrap().unwrap().profile else {
        panic!()
    };
    let shear = 0.4 * 60.0 * KNOT / (10.0 / z0).ln();
    assert_share(z0, 0.014 / 9.80665 * shear * shear, 1e-9);
    // over open sea in a storm the roughness is some millimetres
    assert!((1e-3..1e-2).contains(&z0), "{z0}");
}

#[test]
fn design_winds_are_converted_by_gust_factor_of_their_code() {
    // ISO, 3 s at 10 m: Iu = 0.06 (1 + 0.043 x 30.866667) = 0.1396360; 1 + 0.41 Iu ln 1200 = 1.4059123
    assert_share(wind_at("&ENV -WIND 60 0 -W_DESIGN ISO 3", 10.0), 60.0 * KNOT * 1.405_912_3, 1e-7);
    // API 20th, 3 s at 20 m: 1 + 3 x 0.15 = 1.45 on the hourly profile 2^0.125
    assert_share(wind_at("&ENV -WIND 60 0 -W_DESIGN API 3", 20.0), 60.0 * KNOT * 1.45 * 2f64.powf(0.125), 1e-9);
    // DNV, 60 s at 10 m: 1 + 0.047 ln 10 = 1.1082215
    assert_share(wind_at("&ENV -WIND 60 0 -W_DESIGN DNV 60", 10.0), 60.0 * KNOT * 1.108_221_5, 1e-7);
    for refused in ["-W_DESIGN API 600", "-W_DESIGN ABS 3", "-W_DESIGN ISO 7200", "-W_PROFILE DNV 0.1"] {
        assert!(
            WindField::from_environment(&model(&format!("&ENV -WIND 60 0 {refused}")).environment).is_err(),
            "{refused}"
        );
    }
}

#[test]
fn tide_raises_wind_heights_and_current_depths() {
    let curve = "&DATA CURVES C_PROFILE C 0 2 10 1 30 0.5\n";
    let at = |env: &str, medium, z| {
        Steady::new(&model(&format!("{curve}&ENV -WIND 60 180 -CURRENT C 180 -DEPTH 100 {env}")))
            .unwrap()
            .velocity(medium, z)
            .0
            .x
    };
    assert_eq!(at("-TIDE 3", Medium::Air, 33.0), at("", Medium::Air, 30.0));
    // at z = -2 under a tide of 3 m the depth is 5 m
    assert_share(at("-TIDE 3", Medium::Water, -2.0), 1.5, 1e-12);
    assert_share(at("", Medium::Water, -20.0), 0.75, 1e-12);
    assert_share(at("", Medium::Water, -60.0), 0.5, 1e-12);
    assert_share(at("", Medium::Water, 5.0), 2.0, 1e-12);
    assert_eq!(at("", Medium::Water, -100.5), 0.0);
}

#[test]
fn currents_of_several_curves_add_up_as_vectors() {
    let records = "&DATA CURVES C_PROFILE A 0 3 100 3\n&DATA CURVES C_PROFILE B 0 4 100 0\n&ENV -CURRENT A 180 B 270";
    let steady = Steady::new(&model(records)).unwrap();
    // toward +x with 3, toward +y with 4 at the surface and 2 at 50 m
    assert!((steady.velocity(Medium::Water, 0.0).0 - Vector3::new(3.0, 4.0, 0.0)).norm() < 1e-12);
    assert!((steady.velocity(Medium::Water, -50.0).0 - Vector3::new(3.0, 2.0, 0.0)).norm() < 1e-12);
    assert_share(steady.velocity(Medium::Water, -50.0).1.y, 0.04, 1e-12);
}

#[test]
fn plate_force_acts_along_normal_at_area_centre() {
    // a trapezium in the plane x = 2: z from 4 to 10, widths 6 and 12: area 54, centre 4 + 6/3 (6 + 24)/18 = 7.333333
    let corners = "*A 2 -3 4\n*B 2 3 4\n*C 2 6 10\n*D 2 -6 10\n#PLATE *A *B *C *D -CD 1.2";
    let model = body(corners, "&ENV -WIND 40 150 -W_PROFILE POWER 0");
    let got = sum(&model, Category::Wind, &Pose::default());
    // across: 40 kn cos 30 = 17.820878 m/s; 1/2 x 1.226 x 1.2 x 54 x 317.5837 = 12615.19 N
    let across = 40.0 * KNOT * 30f64.to_radians().cos();
    let force = 0.5 * 1.226 * 1.2 * 54.0 * across * across;
    assert_share(force, 12_615.19, 1e-6);
    assert_share(got[0], force, 1e-12);
    assert!(got[1].abs() < 1e-9 && got[2].abs() < 1e-9);
    assert_share(got[4], force * 22.0 / 3.0, 1e-12);
}

#[test]
fn current_acts_below_water_and_wind_above() {
    let deep = body("*P 0 0 -5\n#AREA *P 10", "&ENV -WIND 60 180 -CURRENT 2 180");
    assert_eq!(sum(&deep, Category::Wind, &Pose::default())[0], 0.0);
    // 1/2 x 1025 x 10 x 4
    assert_share(sum(&deep, Category::ViscousDrag, &Pose::default())[0], 20_500.0, 1e-12);
    let risen = position([0.0, 0.0, 20.0, 0.0, 0.0, 0.0]);
    assert_eq!(sum(&deep, Category::ViscousDrag, &risen)[0], 0.0);
    assert!(sum(&deep, Category::Wind, &risen)[0] > 0.0);
    let loaded = body("*P 0 0 5\n#AREA *P 10 -FLUID WATER", "&ENV -WIND 60 180 -CURRENT 2 180");
    assert_share(sum(&loaded, Category::ViscousDrag, &Pose::default())[0], 20_500.0, 1e-12);
    assert_eq!(sum(&loaded, Category::Wind, &Pose::default())[0], 0.0);
}

#[test]
fn load_table_is_read_at_relative_heading() {
    let table = "*P 50 0 -3\n#TABLE *P 0 -90 0 0 0 0 0 90 0 -900 0 0 0 70 180 80 0 0 0 0 0 -SYMM";
    let model = body(table, "&ENV -CURRENT 2 180");
    let ahead = sum(&model, Category::ViscousDrag, &Pose::default());
    assert_share(ahead[0], 80.0 * 4.0, 1e-12);
    // the body yawed by 90: what comes from 180 comes from its 90; its -y is global +x
    let yawed = position([0.0, 0.0, 0.0, 0.0, 0.0, 90.0]);
    let side = sum(&model, Category::ViscousDrag, &yawed);
    assert_share(side[0], 900.0 * 4.0, 1e-12);
    // the point is at global (0, 50, -3): yaw moment of the table, and of the force: -50 x 3600
    assert_share(side[5], 70.0 * 4.0 - 50.0 * 3600.0, 1e-12);
    // from -90 the mirror: sway and yaw change sign
    let other = sum(&model, Category::ViscousDrag, &position([0.0, 0.0, 0.0, 0.0, 0.0, -90.0]));
    assert_share(other[0], 3600.0, 1e-12);
    assert_share(other[5], -70.0 * 4.0 + 50.0 * 3600.0, 1e-12);
}

#[test]
fn rotated_part_carries_its_table_and_areas() {
    let records = "&DESCRIBE PART TURRET -MOVE 10 0 0 0 0 90\n*P 0 0 -3\n\
                   #TABLE *P 0 -90 0 0 0 0 0 90 0 -900 0 0 0 0 180 80 0 0 0 0 0 -SYMM\n*Q 0 0 20\n#AREA *Q 100 400";
    let model = body(records, "&ENV -CURRENT 2 180 -WIND 60 180 -W_PROFILE POWER 0");
    // body x is -y of the part: what comes from body 180 comes from 90 of the part and pushes along its -y
    assert_share(sum(&model, Category::ViscousDrag, &Pose::default())[0], 900.0 * 4.0, 1e-12);
    assert_share(sum(&model, Category::Wind, &Pose::default())[0], 4.0 * 58_403.6, 1e-6);
}

#[test]
fn linear_drag_uses_current_at_its_point() {
    let model = body("*P 0 0 -10\n#DRAG *P 1000 4000 0 0 0 1E6", "&ENV -CURRENT 2 120");
    let got = sum(&model, Category::ViscousDrag, &Pose::default());
    // toward (0.5, -0.866) x 2
    assert_share(got[0], 1000.0, 1e-12);
    assert_share(got[1], -8000.0 * 60f64.to_radians().sin(), 1e-12);
    // 10 m below the origin: Mx = 10 Fy, My = -10 Fx
    assert_share(got[4], -10_000.0, 1e-12);
    let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    assert_share(floating.damping[(5, 5)], 1e6, 1e-12);
    assert_share(floating.damping[(4, 4)], 100.0 * 1000.0, 1e-12);
    assert_share(floating.damping[(4, 0)], -10.0 * 1000.0, 1e-12);
}

#[test]
fn added_mass_from_weight_transforms_to_the_origin() {
    let model = body("*P 0 3 0\n#AMASS *P 9806.65 0 19613.3 9806.65", "");
    let added = Floating::at_rest(&model, &model.bodies["B"]).unwrap().added_mass;
    assert_share(added[(0, 0)], 1000.0, 1e-12);
    // 2000 kg of heave 3 m to the side: roll 1000 + 2000 x 9, heave-roll 6000; surge: yaw 9000
    assert_share(added[(3, 3)], 19_000.0, 1e-12);
    assert_share(added[(2, 3)], 6000.0, 1e-12);
    assert_share(added[(5, 5)], 9000.0, 1e-12);
    assert!((added - added.transpose()).amax() < 1e-9);
}

const DRIFT: &str = "*P 0 0 0\n#DRIFT *P 0 5 -50 0 0 0 0 0 10 -20 0 0 0 0 0 20 -1 0 0 0 0 0\n\
                     #DRIFT *P 180 5 50 0 0 0 0 0 10 20 0 0 0 0 0 20 1 0 0 0 0 0";

#[test]
fn regular_wave_drift_is_coefficient_times_amplitude_squared() {
    let model = body(DRIFT, "&ENV -SEA REGULAR 180 3 10");
    assert_share(sum(&model, Category::WaveDrift, &Pose::default())[0], 20.0 * 1.5 * 1.5, 1e-12);
}

#[test]
fn narrow_sea_drift_matches_waves_of_its_energy() {
    // m0 = Hs^2/16 at one frequency: 2 m0 D = Hs^2/8 D, an amplitude of Hs / (2 sqrt 2)
    let curve = "&DATA CURVES F_SPECTRUM N 0.9999 0 1.0 7 1.0001 0\n";
    let model = body(DRIFT, &format!("{curve}&ENV -SEA N 180 4 10"));
    assert_share(sum(&model, Category::WaveDrift, &Pose::default())[0], 20.0 * 16.0 / 8.0, 1e-4);
}

#[test]
fn issc_drift_matches_its_integral() {
    // D = k w between the periods: 2 k m1, with m1 = m0 2 pi / T1 and T1 the mean period given; here k = 10 from 0.1 to 10
    // rad/s, where all energy lies but for some 2e-4 beyond, which a constant D cuts
    let tau = std::f64::consts::TAU;
    let rows = format!("{} {} 0 0 0 0 0 {} {} 0 0 0 0 0", tau / 10.0, 100.0, tau / 0.1, 1.0);
    let records = format!("*P 0 0 0\n#DRIFT *P 180 {rows}\n#DRIFT *P 0 {}", rows.replace("100", "-100"));
    let model = body(&records, "&ENV -SEA ISSC 180 4 9");
    assert_share(sum(&model, Category::WaveDrift, &Pose::default())[0], 2.0 * 10.0 * tau / 9.0, 1e-3);
}

#[test]
fn drift_of_two_seas_adds_up() {
    let model = body(DRIFT, "&ENV -SEA REGULAR 180 3 10 -A_SEA REGULAR 0 2 10");
    assert_share(sum(&model, Category::WaveDrift, &Pose::default())[0], 20.0 * (1.5 * 1.5 - 1.0), 1e-12);
}

#[test]
fn sea_without_formula_is_refused_only_for_wave_drift() {
    let env = "&ENV -SEA 2JONSWAP 180 3 10 -WIND 60 180";
    let model = body(DRIFT, env);
    assert!(Floating::at_rest(&model, &model.bodies["B"]).is_err());
    let wind = body("*P 0 0 10\n#AREA *P 100", env);
    assert!(Floating::at_rest(&wind, &wind.bodies["B"]).is_ok());
}

#[test]
fn multipliers_of_category_and_part_compound() {
    let records = "*P 0 0 10\n#AREA *P 100";
    let half = "&ENV -WIND 60 180\n&APPLY -PERCENT -FORCE WIND 50 -LOAD_GROUP B 50";
    assert_share(sum(&body(records, half), Category::Wind, &Pose::default())[0], 0.25 * 58_403.6, 1e-6);
}

#[test]
fn every_load_tangent_matches_finite_differences_in_any_pose() {
    let records = "*A 20 3 -4\n*B 21 8 9\n*C 25 -6 12\n*D 30 1 4\n\
        #AREA *A 30 70 20\n#AREA *B 30 70 20\n#PLATE *B *C *D -CD 1.3\n#PLATE *B *C *D -FLUID WATER\n\
        #TABLE *A 0 -90 0 3 10 20 0 50 -40 -300 2 7 30 80 90 5 -900 0 0 0 70 180 80 0 9 -50 20 0 250 8 450 7 -6 5 400\n\
        #TABLE *B 0 -90 0 3 10 20 0 50 -40 -300 2 7 30 80 90 5 -900 0 0 0 70 180 80 0 9 -50 20 0 -FLUID AIR\n\
        #DRAG *A 500 900 0 0 0 7E4\n#DRIFT *C 0 6 -60 0 3 0 40 0 16 -2 0 0 0 5 0\n\
        #DRIFT *C 90 6 3 -300 2 7 10 90 16 0 -9 0 0 0 0\n#DRIFT *C 200 6 60 5 1 0 0 20 16 2 0 0 0 0 0";
    let curves = "&DATA CURVES C_PROFILE P 0 2.5 8 1.7 40 0.3\n&DATA CURVES C_PROFILE Q 0 0.4 100 0.2\n";
    for profile in ["POWER", "LOG", "ISO", "ABS", "DNV", "API -W_DESIGN API 15", "NPD -W_DESIGN NPD 60"] {
        let env = format!(
            "{curves}&ENV -WIND 55 130 -W_PROFILE {profile} -CURRENT P 110 Q 250 -DEPTH 90 -TIDE 1 -SEA JONSWAP 160 4 9"
        );
        let model = body(records, &env);
        let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
        assert!(floating.loads.len() >= 10, "{}", floating.loads.len());
        // the second brings a point into the passage about the surface, at z = 1 +- 0.25
        for pose in [
            [0.0; 6],
            [1.0, 2.0, 5.1, 0.0, 0.0, 0.0],
            [10.0, -20.0, 0.3, 12.0, -17.0, 63.0],
            [0.0, 0.0, -3.0, -30.0, 25.0, 200.0],
        ] {
            let pose = position(pose);
            for load in &floating.loads {
                let found = load.mean_load(&pose).unwrap();
                let want = differences(load.as_ref(), &pose);
                let scale = want.amax().max(found.wrench.amax());
                assert!(
                    (found.stiffness - want).amax() <= 2e-7 * scale,
                    "{} {profile} {pose:?}: {} not {want}",
                    load.category().name(),
                    found.stiffness
                );
            }
        }
    }
}

#[test]
fn piece_areas_take_wind_and_current_at_their_points() {
    let steady = std::sync::Arc::new(Steady::new(&model("&ENV -WIND 60 180 -CURRENT 2 180")).unwrap());
    let wind = AreaLoad::wind(steady.clone(), [100.0, 0.0, 0.0], Vector3::new(0.0, 0.0, 10.0));
    assert_share(wind.mean_load(&Pose::default()).unwrap().wrench[0], 58_403.6, 1e-6);
    let current = AreaLoad::current(steady, [10.0, 0.0, 0.0], Vector3::new(0.0, 0.0, -5.0));
    assert_eq!(current.category(), Category::ViscousDrag);
    assert_share(current.mean_load(&Pose::default()).unwrap().wrench[0], 20_500.0, 1e-12);
}

#[test]
fn loads_follow_their_body_through_rename_and_delete() {
    let records = "*P 0 0 10\n#AREA *P 100\nRENAME B C\nRENAME C B";
    assert_share(sum(&body(records, "&ENV -WIND 60 180"), Category::Wind, &Pose::default())[0], 58_403.6, 1e-6);
    assert!(body("*P 0 0 10\n#AREA *P 100\nDELETE B", "").loads.is_empty());
}
