//! Structural members: BEAM and PLATE against areas, volumes and forces by hand.

use crate::common::tangent::differences;
use crate::common::{assert_near, assert_share, session};
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::f64::consts::PI;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::{BodyLoad, Category, Floating, morison};
use windlass_model::{Mass, Model};

const RHO: f64 = 1025.0;
const STEEL: f64 = 7850.0;
const G: f64 = 9.80665;

fn run(records: &str) -> (Model, Vec<String>, i64) {
    let (mut session, _screen, _folder) = session();
    let text = format!("&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025\nMEDIT\n&DESCRIBE BODY B\n{records}\n");
    session.open("records", text);
    session.run();
    let said = session.reports.iter().map(|d| format!("{} {}", d.message, d.help.join(" "))).collect();
    (session.job.model.clone(), said, session.errors)
}

fn model(records: &str) -> Model {
    let (model, said, errors) = run(records);
    assert_eq!(errors, 0, "{said:?}");
    model
}

fn mass(model: &Model) -> Mass {
    Mass::from_parts(model.parts_of(&model.bodies["B"]), G)
}

fn load(model: &Model, category: Category) -> Box<dyn BodyLoad> {
    let floating = Floating::at_rest(model, &model.bodies["B"]).unwrap();
    floating.loads.into_iter().find(|l| l.category() == category).unwrap()
}

fn force(model: &Model, category: Category) -> Six {
    load(model, category).mean_load(&Pose::default()).unwrap().wrench
}

fn added_mass(model: &Model) -> Matrix6<f64> {
    morison::build_members(model, &model.bodies["B"], None).unwrap().1
}

/// Four legs of 1200 x 30 mm, 20 m apart, from 40 m below to 10 m over the water.
fn frame(more: &str) -> String {
    let mut text = String::new();
    for (n, (x, y)) in [(10, 10), (-10, 10), (-10, -10), (10, -10)].into_iter().enumerate() {
        text.push_str(&format!("*F{n} {x} {y} -40\n*H{n} {x} {y} 10\n"));
    }
    text.push_str("~LEG TUBE 1200 30\n");
    (0..4).for_each(|n| text.push_str(&format!("BEAM {more} ~LEG *F{n} *H{n}\n")));
    text + "END"
}

#[test]
fn frame_of_four_legs_has_weight_buoyancy_and_waterplane_by_hand() {
    let model = model(&frame(""));
    let metal = PI / 4.0 * (1.2 * 1.2 - 1.14 * 1.14);
    let whole = mass(&model);
    assert_share(whole.mass, 4.0 * STEEL * metal * 50.0, 1e-12);
    assert_near(whole.centre.z, -15.0, 1e-9);
    // slender legs 10 m from both axes: k^2 = L^2/12 + 10^2 about x and y, 2 x 10^2 about z
    let [kx, ky, kz] = whole.radii().map(Option::unwrap);
    for (got, want) in [(kx, 50.0 * 50.0 / 12.0 + 100.0), (ky, 50.0 * 50.0 / 12.0 + 100.0), (kz, 200.0)] {
        assert_share(got * got, want, 1e-12);
    }
    let buoyancy = load(&model, Category::Buoyancy).mean_load(&Pose::default()).unwrap();
    let disc = PI / 4.0 * 1.2 * 1.2;
    assert_share(buoyancy.wrench[2], 4.0 * RHO * G * disc * 40.0, 1e-12);
    assert_share(buoyancy.stiffness[(2, 2)], RHO * G * 4.0 * disc, 1e-9);
    let flooded = self::model(&frame("-FLOOD YES"));
    assert_share(force(&flooded, Category::Buoyancy)[2], 4.0 * RHO * G * metal * 40.0, 1e-12);
}

#[test]
fn member_in_uniform_current_is_dragged_by_its_diameter() {
    let vertical = "*A 3 0 -30\n*B 3 0 -10\n~C TUBE 800 20\nBEAM ~C *A *B\nEND\n&ENV -DEPTH 50 -CURRENT 1.5 180";
    let drag = 0.5 * RHO * 0.8 * 20.0 * 1.5 * 1.5;
    assert_share(force(&model(vertical), Category::ViscousDrag)[0], drag, 1e-12);
    let less = vertical.replace("BEAM", "&PARAMETER -DRGTUB 1E5 0.7\nBEAM");
    assert_share(force(&model(&less), Category::ViscousDrag)[0], 0.7 * drag, 1e-12);
    let wider = vertical.replace("800 20", "800 20 -DRAGDIAMETER 1000");
    assert_share(force(&model(&wider), Category::ViscousDrag)[0], drag / 0.8, 1e-12);
}

#[test]
fn bar_in_oblique_current_is_dragged_along_width_and_depth() {
    // local z of an upright bar is +x: its depth 0.9 m lies along x and its width 0.3 m along y. A flow u = 2 (cos 30, sin 30) meets the width
    // along x and the depth along y: 1/2 rho b |u| u_e a length
    let records = "*A 0 0 -30\n*B 0 0 -10\n~C PRI 900 300\nBEAM ~C *A *B\nEND\n&ENV -DEPTH 50 -CURRENT 2 210";
    let made = model(records);
    let wrench = force(&made, Category::ViscousDrag);
    let half = 0.5 * RHO * 20.0 * 2.0;
    assert_share(wrench[0], half * 0.3 * 2.0 * 30f64.to_radians().cos(), 1e-9);
    assert_share(wrench[1], half * 0.9 * 2.0 * 30f64.to_radians().sin(), 1e-9);
    // turned by a right angle about its axis the two change places
    let turned = force(&model(&records.replace("~C *A", "~C -CA 90 *A")), Category::ViscousDrag);
    assert_share(turned[0], half * 0.9 * 2.0 * 30f64.to_radians().cos(), 1e-9);
    // a reference point along y has the same effect
    let aimed = records.replace("~C *A", "~C -REFN *R *A").replace("*A 0 0", "*R 0 5 -20\n*A 0 0");
    assert_share(force(&model(&aimed), Category::ViscousDrag)[1], half * 0.3 * 2.0 * 30f64.to_radians().sin(), 1e-9);
    // solid: it displaces its outline
    assert_share(force(&made, Category::Buoyancy)[2], RHO * G * 0.27 * 20.0, 1e-9);
    // the stiffness of the drag is the difference of the force, in a lean that the profile of the current sees
    let leans = "&DATA CURVES C_PROFILE P 0 2 40 0.5\n&ENV -DEPTH 50 -CURRENT P 210";
    let sheared = model(&records.replace("&ENV -DEPTH 50 -CURRENT 2 210", leans));
    let pose = Pose::from_place(&Place::new([0.0, 0.0, -2.0, 0.2, 0.3, 0.1]));
    let drag = load(&sheared, Category::ViscousDrag);
    let (exact, by_difference) = (drag.mean_load(&pose).unwrap().stiffness, differences(drag.as_ref(), &pose));
    // differences of a force of 1e5 N over 1e-4: rounding and the square term leave 1e-6 of the largest
    assert!((exact - by_difference).amax() < 1e-5 * by_difference.amax(), "{exact} {by_difference}");
}

#[test]
fn member_over_water_has_wind_on_its_diameter() {
    let records = "*A 0 0 10\n*B 0 0 30\n~C TUBE 600 20\nBEAM ~C *A *B\nEND\n&ENV -WIND 50 180 -W_PROFILE POWER 0";
    let speed = 50.0 * 1852.0 / 3600.0;
    // a prism of 64 sides stands for it: within 0.1 % of the diameter
    let whole = 0.5 * 1.226 * 0.6 * 20.0 * speed * speed;
    assert_share(force(&model(records), Category::Wind)[0], whole, 1e-3);
    let bar = records.replace("TUBE 600 20", "PRI 900 300 -WINDDIAMETER 500");
    assert_share(force(&model(&bar), Category::Wind)[0], whole * 0.5 / 0.6, 1e-9);
}

#[test]
fn submerged_upright_members_have_added_mass_by_hand() {
    let tube = "*A 0 0 -30\n*B 0 0 -10\n~C TUBE 1000 25\nBEAM ~C *A *B\nEND";
    let whole = RHO * PI / 4.0 * 20.0;
    let found = added_mass(&model(tube));
    for (at, want) in [((0, 0), whole), ((1, 1), whole), ((2, 2), 0.0), ((0, 4), -20.0 * whole)] {
        assert!((found[at] - want).abs() <= 1e-9 * whole, "{at:?} {}", found[at]);
    }
    // flooded, the water within it moves too
    let found = added_mass(&model(&tube.replace("~C *A", "~C -FLOOD YES *A")));
    assert_share(found[(0, 0)], whole + RHO * PI / 4.0 * 0.95 * 0.95 * 20.0, 1e-9);
    // a bar moves the circle over the breadth it shows: 0.3 m along x, 0.9 m along y
    let found = added_mass(&model(&tube.replace("TUBE 1000 25", "IBEAM 900 300 16 28")));
    assert_share(found[(0, 0)], RHO * PI / 4.0 * 0.09 * 20.0, 1e-9);
    assert_share(found[(1, 1)], RHO * PI / 4.0 * 0.81 * 20.0, 1e-9);
}

#[test]
fn cone_and_segments_have_volume_and_weight_by_hand() {
    // 10 m of tube of 2 m, a cone of 6 m down to 1 m, and what is left of 24 m, 8 m, of 1 m; walls 20 mm
    let records = "*A 0 0 -40\n*B 0 0 -16\n~C TUBE 2000 20 -LEN 10\n~C CONE 2000 1000 20 -LEN 6\n~C TUBE 1000 20\nBEAM LEG ~C *A *B\nEND";
    let made = model(records);
    let volume = PI / 4.0 * 4.0 * 10.0 + PI / 12.0 * 6.0 * (4.0 + 2.0 + 1.0) + PI / 4.0 * 8.0;
    assert_share(force(&made, Category::Buoyancy)[2], RHO * G * volume, 1e-12);
    // the wall of a cone: pi t (D - t), straight along it
    let wall = |d: f64| PI * 0.02 * (d - 0.02);
    let [a, b, c] = [wall(2.0) * 10.0, 0.5 * (wall(2.0) + wall(1.0)) * 6.0, wall(1.0) * 8.0];
    let whole = mass(&made);
    assert_share(whole.mass, STEEL * (a + b + c), 1e-12);
    // the centroid of the trapezoid of the cone from its wider end: L/3 (w1 + 2 w2)/(w1 + w2)
    let of_cone = -30.0 + 2.0 * (wall(2.0) + 2.0 * wall(1.0)) / (wall(2.0) + wall(1.0));
    assert_share(whole.centre.z, (-35.0 * a + of_cone * b - 20.0 * c) / (a + b + c), 1e-12);
}

#[test]
fn leaning_beam_has_products_of_inertia_of_a_slender_rod() {
    let made = model("*A 1 2 3\n*B 7 -2 15\n~C TUBE 500 20\nBEAM ~C *A *B\nEND");
    let (along, whole) = (Vector3::new(6.0, -4.0, 12.0), mass(&made));
    let about = whole.inertia_about(whole.centre);
    let want: Matrix3<f64> =
        (Matrix3::identity() * along.norm_squared() - along * along.transpose()) * (whole.mass / 12.0);
    assert!((about - want).amax() < 1e-9 * want.amax(), "{about} {want}");
    assert!((whole.centre - Vector3::new(4.0, 0.0, 9.0)).norm() < 1e-9);
}

#[test]
fn sections_weigh_their_area_by_hand() {
    for (section, area) in [
        ("TUBE 900 25", PI / 4.0 * (0.9 * 0.9 - 0.85 * 0.85)),
        ("TUBE 100", PI / 4.0 * 0.01),
        ("BOX 600 400 20 15", 0.6 * 0.4 - 0.57 * 0.36),
        ("WBOX 900 500 15 25 350", 2.0 * 0.5 * 0.025 + 2.0 * 0.85 * 0.015),
        ("PRI 300 200", 0.06),
        ("IBEAM 900 300 16 28", 2.0 * 0.3 * 0.028 + 0.844 * 0.016),
        ("TEE 400 200 12 20", 0.2 * 0.02 + 0.38 * 0.012),
        ("CHANNEL 300 100 10 16", 2.0 * 0.1 * 0.016 + 0.268 * 0.01),
        ("ANGLE 150 100 12", 0.15 * 0.012 + 0.088 * 0.012),
        ("D_ANGLE 150 100 12 10", 2.0 * (0.15 * 0.012 + 0.088 * 0.012)),
        ("G_IBEAM 900 300 16 28 250 20 0 0 -SECTION 26640", 0.02664),
        ("LLEG 1500 40 600 30 500 25 0 0 -SECTION 230000", 0.23),
        ("IBEAM 900 300 16 28 12 300", 2.0 * 0.3 * 0.028 + 0.844 * 0.016),
        ("IBEAM 900 300 16 28 -SECTION 40000 1 2 3", 0.04),
        ("PRI 300 200 -WTPLEN 9", 9e3 / (STEEL * G)),
        ("PRI 300 200 -SPGRAVITY 2.7", 0.06 * 2700.0 / STEEL),
    ] {
        let made = model(&format!("*A 0 0 5\n*B 12 0 5\n~S {section}\nBEAM ~S *A *B\nEND"));
        assert_share(mass(&made).mass, STEEL * area * 12.0, 1e-12);
    }
}

#[test]
fn plate_has_weight_buoyancy_and_normal_drag_of_its_area() {
    // a triangle of 12 x 9 m, 4 m under water, across the current
    let made = model(
        "*A 0 0 -10\n*B 0 12 -10\n*C 0 0 -1\n~P PLATE 25\nPLATE LID ~P *A *B *C\nEND\n&ENV -DEPTH 50 -CURRENT 2 180",
    );
    let area = 54.0;
    let whole = mass(&made);
    assert_share(whole.mass, STEEL * area * 0.025, 1e-12);
    assert!((whole.centre - Vector3::new(0.0, 4.0, -7.0)).norm() < 1e-9, "{:?}", whole.centre);
    // a lamina: its moment of inertia about an edge through the centroid's axes, Iyy + Izz = m (b^2 + h^2)/18 for a right triangle
    let about = whole.inertia_about(whole.centre);
    assert_share(about[(0, 0)], whole.mass * (144.0 + 81.0) / 18.0, 1e-9);
    assert_share(force(&made, Category::Buoyancy)[2], RHO * G * area * 0.025, 1e-9);
    assert_share(force(&made, Category::ViscousDrag)[0], 0.5 * RHO * area * 4.0, 1e-9);
    // strips along the longest side, 15 m, whose breadth rises to 7.2 m and falls: rho pi/4 times the integral of b^2, here of midpoints of 8
    // strips each way, within 1/(4 x 64) of 15 x 7.2^2/3
    assert_share(added_mass(&made)[(0, 0)], RHO * PI / 4.0 * 15.0 * 7.2 * 7.2 / 3.0, 1.0 / 200.0);
}

#[test]
fn string_of_beams_takes_classes_and_options_before_each() {
    let made = model(
        "*A 0 0 -20\n*B 10 0 -20\n*C 20 0 -20\n*D 30 0 -20\n~C1 TUBE 1000 25\n~C2 TUBE 500 20\n\
         BEAM LONG ~C1 -FLOOD YES *A *B LAST ~C2 *C -FLOOD NO *D\nEND",
    );
    let names: Vec<&str> = made.parts["B"].pieces.iter().map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["LONG", "LAST", "BEAM3"]);
    let ring = |d: f64, t: f64| PI * t * (d - t);
    let volume = 10.0 * (ring(1.0, 0.025) + ring(0.5, 0.02) + PI / 4.0 * 0.25);
    assert_share(force(&made, Category::Buoyancy)[2], RHO * G * volume, 1e-12);
    assert_share(mass(&made).mass, STEEL * 10.0 * (ring(1.0, 0.025) + 2.0 * ring(0.5, 0.02)), 1e-12);
}

#[test]
fn option_behind_the_last_node_holds_for_the_record() {
    let ring = |d: f64, t: f64| PI * t * (d - t);
    let made = model("*A 0 0 -20\n*B 10 0 -20\n~C TUBE 1000 25\nBEAM ~C *A *B -FLOOD YES\nEND");
    assert_share(force(&made, Category::Buoyancy)[2], RHO * G * 10.0 * ring(1.0, 0.025), 1e-12);
}

#[test]
fn redefined_or_deleted_element_loses_its_weight() {
    let (made, said, errors) = run(
        "*A 0 0 5\n*B 10 0 5\n~C PRI 100 100\n~D PRI 200 100\nBEAM ONE ~C *A *B\nBEAM TWO ~C *A *B\nBEAM ONE ~D *A *B\nDELETE TWO\nEND",
    );
    assert_eq!(errors, 0, "{said:?}");
    assert_share(mass(&made).mass, STEEL * 0.02 * 10.0, 1e-12);
    assert_eq!(made.parts["B"].pieces.len(), 1);
}

#[test]
fn inmodel_takes_beams_before_their_classes_and_nodes() {
    let made = model("END\nINMODEL\n&DESCRIBE BODY B\nBEAM ~C *A *B\n~C PRI 100 100\n*A 0 0 5\n*B 10 0 5\nEND");
    assert_share(mass(&made).mass, STEEL * 0.01 * 10.0, 1e-12);
}

#[test]
fn shape_acts_with_its_dimensions_and_stops_without() {
    let records = "*A 0 0 5\n*B 10 0 5\n~C W14X140 -SPGRAVITY 7.85\nBEAM ~C *A *B\nBEAM ~C *B *A\nEND\n&EQUI";
    let (_, said, errors) = run(records);
    assert_eq!(errors, 1, "{said:?}");
    assert!(
        said.iter().any(|s| s.contains("not computed is BEAM of class ~C") && s.contains("&DATA SHAPES")),
        "{said:?}"
    );
    let known = format!("END\n&DATA SHAPES\nW14X140 IBEAM 366 394 18 28 -SECTION 26600\nEND_&DATA\nMEDIT\n{records}");
    let made = model(&known.replace("\n&EQUI", "").replace("BEAM ~C *B *A\n", ""));
    assert_share(mass(&made).mass, 7850.0 * 0.0266 * 10.0, 1e-12);
}

#[test]
fn dimensions_that_are_not_known_stop_the_next_solve() {
    for (section, names) in [
        ("TUBE 500 20 400 20", "class ~S of a BEAM (what C and D of a TUBE do)"),
        ("TUBE 500 20 -T_STIFF 2 ~RING", "class ~S of a BEAM (the weight of its stiffeners)"),
    ] {
        let (_, said, errors) =
            run(&format!("*A 0 0 5\n*B 12 0 5\n~S {section}\nBEAM ~S *A *B\nBEAM ~S *B *A\nEND\n&EQUI"));
        assert!(errors == 1 && said.iter().any(|s| s.contains(names)), "{section}: {said:?}");
    }
    let offset = "*A 0 0 5\n*B 12 0 5\n~S PRI 100 100\nBEAM ~S -GOA 1 0 0 *A *B\nEND\n&EQUI";
    let (_, said, errors) = run(offset);
    assert!(errors == 1 && said.iter().any(|s| s.contains("-GOA of a BEAM")), "{said:?}");
}

#[test]
fn member_multipliers_scale_every_load_by_attribute() {
    // upright from 20 m under water to 10 m over it: 0.8 m wide, in a current of 1.5 m/s and a wind of 50 knots
    let tube = "*A 3 0 -20\n*B 3 0 10\n~C TUBE 800 20\nBEAM ~C *A *B -CATEGORY LEGS\nEND\n";
    let around = "&ENV -DEPTH 50 -CURRENT 1.5 180 -WIND 50 180 -W_PROFILE POWER 0\n";
    let apply = "&APPLY -PERCENT -CATEGORY LEGS #DEAD 103 #BUOY 107 #WIND 130 #DRAG 80 #AMASS 150\n";
    let weight = STEEL * PI * 0.02 * 0.78 * 30.0;
    let disc = PI / 4.0 * 0.64;
    let drag = 0.5 * RHO * 0.8 * 20.0 * 1.5 * 1.5;
    let speed = 50.0 * 1852.0 / 3600.0;
    let wind = 0.5 * 1.226 * 0.8 * 10.0 * speed * speed;
    for (more, [dead, buoy, of_wind, of_drag, of_mass]) in [
        ("", [1.0; 5]),
        (apply, [1.03, 1.07, 1.3, 0.8, 1.5]),
        // the group of the part multiplies them all
        (&format!("{apply}&APPLY -LOAD_GROUP B 0.5\n"), [0.515, 0.535, 0.65, 0.4, 0.75]),
        ("&APPLY -FORCE WIND 0.5 -FORCE V_DRAG 0.25\n", [1.0, 1.0, 0.5, 0.25, 1.0]),
        ("&APPLY -CATEGORY STR_MODEL #BUOY 2 #DEAD 2 #WIND 2 #DRAG 2 #AMASS 2\n", [1.0; 5]),
    ] {
        let made = model(&format!("{tube}{around}{more}"));
        assert_share(mass(&made).mass, dead * weight, 1e-12);
        let lift = load(&made, Category::Buoyancy).mean_load(&Pose::default()).unwrap();
        assert_share(lift.wrench[2], buoy * RHO * G * disc * 20.0, 1e-12);
        assert_share(lift.stiffness[(2, 2)], buoy * RHO * G * disc, 1e-9);
        assert_share(force(&made, Category::ViscousDrag)[0], of_drag * drag, 1e-9);
        // a prism of 64 sides stands for the tube
        assert_share(force(&made, Category::Wind)[0], of_wind * wind, 1e-3);
        assert_share(added_mass(&made)[(0, 0)], of_mass * RHO * disc * 20.0, 1e-9);
    }
    // a flat bar, and a TUBE, whose category is EXTRA
    let bar = "*A 0 0 -30\n*B 0 0 -10\n~C PRI 900 300\nBEAM ~C *A *B\nEND\n&APPLY -CATEGORY STR_MODEL #BUOY 1.1\n";
    assert_share(force(&model(bar), Category::Buoyancy)[2], 1.1 * RHO * G * 0.27 * 20.0, 1e-9);
    let plate = "*A 0 -3 -9\n*B 0 3 -9\n*C 0 3 -5\n*D 0 -3 -5\n~P PLATE 50\nPLATE ~P *A *B *C *D\nEND\n\
                 &ENV -DEPTH 50 -CURRENT 2 180\n&APPLY -CATEGORY STR_MODEL #BUOY 1.2 #DRAG 0.7\n";
    let plate = model(plate);
    assert_share(force(&plate, Category::Buoyancy)[2], 1.2 * RHO * G * 24.0 * 0.05, 1e-9);
    assert_share(force(&plate, Category::ViscousDrag)[0], 0.7 * 0.5 * RHO * 24.0 * 4.0, 1e-9);
    let spar = "*A 0 0 -30\n*B 0 0 -10\nEND\n&SURFACE\nTUBE T *A *B 800\nEND\n&APPLY -CATEGORY EXTRA #BUOY 0.9\n";
    assert_share(force(&model(spar), Category::Buoyancy)[2], 0.9 * RHO * G * disc * 20.0, 1e-12);
}
