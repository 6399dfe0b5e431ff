//! Round members in waves and current, against the integrals of linear theory over a pile
//! [DNV-RP-C205 6.5; SARPKAYA-ISAACSON-1981 4.2], and against statics.

use crate::common;
use crate::common::assert_share;
use crate::common::body_load::begin_step;
use crate::common::tangent;

use nalgebra::{Matrix6, Vector3};
use std::f64::consts::PI;
use std::sync::Arc;
use tangent::differences;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::hull::{Solid, TubeHull};
use windlass_hydro::sea::{Component, Sea, Water, dispersion::wave_number};
use windlass_hydro::{BodyLoad, BodyStep, Category, DynamicLoad, Floating, morison};
use windlass_model::{Model, Stretching};

const RHO: f64 = 1025.0;
const G: f64 = 9.80665;
const POINTS: &str = "*A 0 0 -50\n*B 0 0 20\n*C -30 0 0\n*D 30 0 0\n*E 10 20 -30\n*F -20 5 50\n*G 0 0 -20\n*H 0 0 -10";

fn body(pieces: &str, more: &str) -> Model {
    let (mut session, screen, _folder) = common::session();
    let text = format!(
        "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025\nMEDIT\n&DESCRIBE BODY B\n{POINTS}\nEND\n&SURFACE\n{pieces}\nEND\n{more}\n"
    );
    session.open("records", text);
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    session.job.model.clone()
}

fn water(depth: Option<f64>) -> Water {
    Water { depth, level: 0.0, gravity: G, density: RHO }
}

/// A regular wave toward a direction (rad), in phase at the origin at the time zero.
fn wave(amplitude: f64, frequency: f64, toward: f64, depth: Option<f64>, stretching: Stretching) -> Arc<Sea> {
    let number = wave_number(frequency, depth, G).unwrap();
    let component = Component { frequency, number, amplitude, toward: [toward.cos(), toward.sin()], phase: 0.0 };
    Arc::new(Sea::airy(vec![component], water(depth), 0.0, stretching))
}

/// The load of members of the body under way.
fn members(model: &Model, sea: Option<&Arc<Sea>>) -> Box<dyn BodyLoad> {
    let floating = Floating::under_way(model, &model.bodies["B"], sea).unwrap();
    floating.loads.into_iter().find(|l| l.category() == Category::Wave).unwrap()
}

/// The load at a time, in a pose and with a velocity that are those expected.
fn load_at(load: &dyn BodyLoad, time: f64, pose: &Pose, velocity: &Six) -> DynamicLoad {
    let ahead = BodyStep { time, dt: 0.0, pose, velocity };
    let state = begin_step(load, &ahead);
    load.dynamic_load(&ahead, &state).unwrap()
}

fn force(load: &dyn BodyLoad, time: f64) -> Six {
    load_at(load, time, &Pose::default(), &Six::zeros()).load.wrench
}

fn position(values: [f64; 6]) -> Pose {
    let [x, y, z, roll, pitch, yaw] = values;
    Pose::from_place(&Place::new([x, y, z, roll.to_radians(), pitch.to_radians(), yaw.to_radians()]))
}

#[test]
fn pile_inertia_force_matches_closed_form_at_mean_level_crossing() {
    let (d, diameter, a) = (50.0, 6.0, 4.0);
    for (depth, w) in [(Some(d), 0.35), (Some(d), 0.9), (None, 1.6)] {
        let k = wave_number(w, depth, G).unwrap();
        for stretching in [Stretching::Wheeler, Stretching::Linear, Stretching::Exponential, Stretching::Delta] {
            let model = body("TUBE PILE *A *B 6000 -CD 0 -CA 0.8", "");
            let sea = wave(a, w, 0.0, depth, stretching);
            // cos q = 0: du/dt = a w^2 C(z), towards +x a quarter of a period before the crest
            let got = force(members(&model, Some(&sea)).as_ref(), -0.5 * PI / w);
            let mass = RHO * PI * diameter * diameter / 4.0 * 1.8;
            let (force, moment) = match depth {
                // int C dz = 1/k; int (z + d) C dz = d/k - (cosh kd - 1)/(k^2 sinh kd)
                Some(_) => {
                    let kd: f64 = k * d;
                    let about_foot = d / k - (kd.cosh() - 1.0) / (k * k * kd.sinh());
                    (mass * a * w * w / k, mass * a * w * w * (about_foot - d / k))
                }
                // from -50 m on: exp(-kd) is left out below
                None => {
                    let rest = (-k * d).exp();
                    let first = -(1.0 - rest) / (k * k) + d * rest / k;
                    (mass * a * w * w * (1.0 - rest) / k, mass * a * w * w * first)
                }
            };
            // four points a segment of two thirds of a radian of wave: 3e-7 at most
            assert_share(got[0], force, 1e-6);
            assert_share(got[4], moment, 1e-6);
            assert!(got[1].abs() < 1e-6 * force && got[3].abs() < 1e-6 * force.abs() * d);
        }
    }
}

#[test]
fn pile_drag_under_crest_matches_closed_form_up_to_surface() {
    let (d, w) = (50.0, 0.6);
    let k: f64 = wave_number(w, Some(d), G).unwrap();
    let model = body("TUBE PILE *A *B 1500 -CD 0.7 -CA 0", "");
    for a in [1e-3, 5.0] {
        let sea = wave(a, w, PI / 3.0, Some(d), Stretching::Exponential);
        let got = force(members(&model, Some(&sea)).as_ref(), 0.0);
        // int cosh^2 k(z+d) dz from the bottom to the crest
        let long = (d + a) / 2.0 + (2.0 * k * (d + a)).sinh() / (4.0 * k);
        let want = 0.5 * RHO * 0.7 * 1.5 * (a * w / (k * d).sinh()).powi(2) * long;
        // the passage of the section at the surface, a thousandth of the radius long, is of no account; the points: 1e-6
        assert_share(got[0], want * 0.5, 3e-6);
        assert_share(got[1], want * (PI / 3.0).sin(), 3e-6);
        // to the mean level: int = d/2 + sinh(2kd)/(4k), of an amplitude of 1 mm within 2ka
        let flat = d / 2.0 + (2.0 * k * d).sinh() / (4.0 * k);
        if a < 1.0 {
            assert_share(got[0], 0.5 * want / long * flat, 3.0 * k * a);
        }
    }
}

#[test]
fn spar_is_lifted_by_pressure_on_its_bottom_alone() {
    let (draft, diameter) = (50.0, 20.0);
    let area = PI * diameter * diameter / 4.0;
    for (depth, w, a) in [(None, 0.5, 8.0), (Some(80.0), 0.4, 3.0), (None, 1.0, 0.1)] {
        let k = wave_number(w, depth, G).unwrap();
        for stretching in [Stretching::Wheeler, Stretching::Linear, Stretching::Delta] {
            let model = body("TUBE SPAR *A *B 20000 -CD 0 -CA 0", "");
            let sea = wave(a, w, 0.0, depth, stretching);
            let load = members(&model, Some(&sea));
            for phase in [0.0, 0.8, 2.0, PI, 5.0] {
                let decay = depth.map_or((-k * draft).exp(), |d| (k * (d - draft)).cosh() / (k * d).cosh());
                let want = RHO * G * area * a * phase.cos() * decay;
                let got = force(load.as_ref(), phase / w)[2];
                match stretching {
                    // Wheeler's water at a place is that of another height: the foot's by -zeta in deep water, and by
                    // what is left of it over the draft in finite depth
                    Stretching::Wheeler => {
                        let zeta = a * phase.cos();
                        let scale = depth.map_or(1.0, |d| d / (d + zeta));
                        let z = (-draft - zeta) * scale;
                        let decay = depth.map_or((k * z).exp(), |d| (k * (d + z)).cosh() / (k * d).cosh());
                        assert_share(got, RHO * G * area * zeta * decay, 1e-11);
                    }
                    _ => assert_share(got, want, 1e-11),
                }
            }
        }
    }
}

#[test]
fn buoyancy_in_rising_level_matches_tube_in_new_level() {
    // a wave a thousand times round the earth: no slope, no acceleration, pressure rho g zeta at every depth
    let component = Component { frequency: 1e-6, number: 1e-10, amplitude: 1.7, toward: [1.0, 0.0], phase: 0.0 };
    let sea = Arc::new(Sea::airy(vec![component], water(None), 0.0, Stretching::Linear));
    for (piece, from, to, od) in [
        ("TUBE T *E *F 7000", [10.0, 20.0, -30.0], [-20.0, 5.0, 50.0], 7.0),
        ("TUBE T *C *D 4000", [-30.0, 0.0, 0.0], [30.0, 0.0, 0.0], 4.0),
        ("TUBE T *A *B 9000", [0.0, 0.0, -50.0], [0.0, 0.0, 20.0], 9.0),
    ] {
        let model = body(piece, "");
        let tube = TubeHull { ends: [from, to].map(Vector3::from), diameter: od };
        let floating = Floating::under_way(&model, &model.bodies["B"], Some(&sea)).unwrap();
        for pose in [
            position([0.0; 6]),
            position([3.0, 2.0, -1.0, 4.0, -7.0, 30.0]),
            position([0.0, 0.0, 1.5, 80.0, 0.0, 10.0]),
        ] {
            let sum: Vec<DynamicLoad> =
                floating.loads.iter().map(|load| load_at(load.as_ref(), 0.0, &pose, &Six::zeros())).collect();
            let got: Six = sum.iter().map(|m| m.load.wrench).sum();
            let stiffness: Matrix6<f64> = sum.iter().map(|m| m.load.stiffness).sum();
            let want = tube.wet(&pose, 1.7).load(RHO * G);
            // 1e-10 of the wave number over 100 m, and rounding
            assert!((got - want.wrench).norm() <= 1e-7 * want.wrench.norm(), "{piece} {got} {}", want.wrench);
            assert!((stiffness - want.stiffness).norm() <= 1e-9 * want.stiffness.norm().max(1.0), "{piece}");
        }
    }
}

#[test]
fn members_without_waves_and_motion_have_no_force() {
    let model = body("TUBE T *E *F 7000\nTUBE U *C *D 3000", "");
    for sea in [None, Some(wave(0.0, 0.5, 0.0, None, Stretching::Wheeler))] {
        assert_eq!(force(members(&model, sea.as_ref()).as_ref(), 3.0), Six::zeros());
    }
}

const CURRENT: &str = "&DATA CURVES C_PROFILE P 0 2.5 8 1.7 40 0.3\n&ENV -CURRENT P 110 -DEPTH 90 -TIDE 1";

#[test]
fn steady_current_in_time_domain_matches_statics() {
    let pieces = "TUBE T *E *F 7000 -CD 0.9 -CDA 0.03\nTUBE U *C *D 3000\nTUBE V *A *G 2000";
    let model = body(pieces, CURRENT);
    let at_rest = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    let statics = at_rest.loads.iter().find(|l| l.category() == Category::ViscousDrag).unwrap();
    let moving = members(&model, None);
    for pose in
        [position([0.0; 6]), position([3.0, 2.0, -1.0, 14.0, -7.0, 30.0]), position([0.0, 0.0, 1.5, 80.0, 0.0, 10.0])]
    {
        let (got, want) =
            (load_at(moving.as_ref(), 5.0, &pose, &Six::zeros()).load.wrench, statics.mean_load(&pose).unwrap().wrench);
        assert!((got - want).norm() <= 1e-12 * want.norm(), "{got} {want}");
        // and an engine's mean of it is the same
        assert_eq!(moving.mean_load(&pose).unwrap().wrench, want);
    }
}

#[test]
fn pile_drag_in_uniform_current_matches_closed_form() {
    let model = body("TUBE PILE *A *B 2000 -CD 0.65", "&ENV -CURRENT 1.5 180");
    let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    let load = floating.loads.iter().find(|l| l.category() == Category::ViscousDrag).unwrap();
    let got = load.mean_load(&Pose::default()).unwrap().wrench;
    let want = 0.5 * RHO * 0.65 * 2.0 * 50.0 * 1.5 * 1.5;
    assert_share(got[0], want, 1e-12);
    // the passage of a thousandth of the radius at the surface: 1e-6 m2 in 1250 m2
    assert_share(got[4], -25.0 * want, 1e-9);
    // lying in the surface, half of it is wet
    let model = body("TUBE PILE *C *D 2000 -CD 0.65", "&ENV -CURRENT 1.5 90");
    let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    let load = floating.loads.iter().find(|l| l.category() == Category::ViscousDrag).unwrap();
    assert_share(
        load.mean_load(&Pose::default()).unwrap().wrench[1],
        -0.5 * RHO * 0.65 * 1.0 * 60.0 * 1.5 * 1.5,
        1e-12,
    );
}

#[test]
fn static_drag_tangent_matches_finite_differences() {
    let model = body("TUBE T *E *F 7000 -CD 0.9 -CDA 0.03\nTUBE U *C *D 3000", CURRENT);
    let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    let load = floating.loads.iter().find(|l| l.category() == Category::ViscousDrag).unwrap();
    for pose in [
        [0.0, 0.0, 0.3, 0.0, 0.0, 0.0],
        [30.0, -60.0, -3.0, 12.0, -17.0, 63.0],
        [0.0, 0.0, 2.0, -100.0, 25.0, 200.0],
        [5.0, 3.0, 0.2, 1.5, -0.7, 30.0],
    ] {
        let pose = position(pose);
        let (got, want) = (load.mean_load(&pose).unwrap().stiffness, differences(load.as_ref(), &pose));
        // rounding of the differences over steps of 1e-5 m and 1e-6 rad
        assert!((got - want).norm() <= 1e-6 * want.norm(), "{got} {want}");
    }
}

#[test]
fn damping_matches_finite_differences_and_drag_only_dissipates() {
    let model = body("TUBE T *E *F 7000 -CD 0.9 -CDA 0.03\nTUBE U *C *D 3000\nTUBE V *A *G 2000", "");
    let load = members(&model, None);
    for pose in [position([0.0; 6]), position([3.0, 2.0, -1.0, 14.0, -7.0, 30.0])] {
        for n in 0..40 {
            let one = |i: usize| ((n * 6 + i) as f64 * 2.399).sin() * if i < 3 { 2.0 } else { 0.1 };
            let velocity = Six::from_iterator((0..6).map(one));
            let found = load_at(load.as_ref(), 0.0, &pose, &velocity);
            assert!(found.load.wrench.dot(&velocity) < 0.0);
            let symmetric = (found.damping + found.damping.transpose()) * 0.5;
            assert!(symmetric.symmetric_eigenvalues().min() > -1e-9 * symmetric.norm());
            for column in 0..6 {
                let step = 1e-5;
                let moved = |sign: f64| {
                    let mut v = velocity;
                    v[column] += sign * step;
                    load_at(load.as_ref(), 0.0, &pose, &v).load.wrench
                };
                let want = (moved(-1.0) - moved(1.0)) / (2.0 * step);
                // rounding of the difference, and its second order where the flow past a station turns
                assert!((want - found.damping.column(column)).norm() <= 1e-5 * found.damping.norm());
            }
        }
    }
}

#[test]
fn moving_body_drag_matches_opposite_current() {
    let model = body("TUBE T *E *F 7000 -CD 0.9 -CDA 0.03\nTUBE U *C *D 3000", "");
    let flow = body("TUBE T *E *F 7000 -CD 0.9 -CDA 0.03\nTUBE U *C *D 3000", "&ENV -CURRENT 1.25 0");
    let towed =
        load_at(members(&model, None).as_ref(), 0.0, &Pose::default(), &Six::new(1.25, 0.0, 0.0, 0.0, 0.0, 0.0));
    let held = load_at(members(&flow, None).as_ref(), 0.0, &Pose::default(), &Six::zeros());
    assert!((towed.load.wrench - held.load.wrench).norm() <= 1e-13 * held.load.wrench.norm());
}

#[test]
fn submerged_pontoon_force_is_cm_times_displaced_mass() {
    // level, across the wave, 20 m under: every section is in the same water
    let (d, w, a) = (20.0, 0.7, 2.0);
    let model = body("TUBE P *C *D 3000 -CD 0 -CA 1.1", "");
    let k = w * w / G;
    let load = members(&model, Some(&wave(a, w, PI / 2.0, None, Stretching::Linear)));
    let pose = position([0.0, 0.0, -d, 0.0, 0.0, 0.0]);
    let mass = RHO * PI * 9.0 / 4.0 * 60.0 * 2.1;
    for phase in [0.0, 1.0, 2.5] {
        let got = load_at(load.as_ref(), phase / w, &pose, &Six::zeros()).load.wrench;
        let size = mass * a * w * w * (-k * d).exp();
        // q = -w t: du/dt = a w^2 e^kz sin q, dw/dt = -a w^2 e^kz cos q
        assert_share(got[1], -size * phase.sin(), 1e-11);
        assert_share(got[2], -size * phase.cos(), 1e-11);
        assert!(got[0].abs() < 1e-9 * size);
    }
}

#[test]
fn pontoon_ends_along_wave_carry_pressure_difference() {
    let (d, w, a) = (20.0, 0.7, 2.0);
    let model = body("TUBE P *C *D 3000 -CD 0 -CA 0", "");
    let k = w * w / G;
    let load = members(&model, Some(&wave(a, w, 0.0, None, Stretching::Linear)));
    let got = load_at(load.as_ref(), 1.3, &position([0.0, 0.0, -d, 0.0, 0.0, 0.0]), &Six::zeros()).load.wrench;
    let pressure = |x: f64| RHO * G * a * (-k * d).exp() * (k * x - w * 1.3).cos();
    assert_share(got[0], PI * 9.0 / 4.0 * (pressure(-30.0) - pressure(30.0)), 1e-11);
}

#[test]
fn spar_added_mass_matches_closed_form() {
    let model = body("TUBE S *A *B 20000 -CA 0.9 -CAA 0.64", "");
    let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    let line = RHO * PI * 100.0 * 0.9;
    let got = floating.added_mass;
    assert_share(got[(0, 0)], line * 50.0, 1e-12);
    assert_share(got[(1, 1)], line * 50.0, 1e-12);
    assert_share(got[(2, 2)], RHO * PI * 8000.0 / 12.0 * 0.64, 1e-12);
    // about the origin, in the surface, where the passage of 0.01 m makes (0.01 m)^2/8 of 1250 m2
    assert_share(got[(4, 4)], line * 50f64.powi(3) / 3.0, 1e-7);
    assert_share(got[(0, 4)], -line * 50.0 * 25.0, 1e-7);
    assert!((got - got.transpose()).norm() < 1e-9 * got.norm());
}

#[test]
fn end_joined_to_another_piece_has_no_added_mass() {
    // a pontoon of 3 m under water: half spheres of its diameter over its ends, along its axis
    let along = |caa: &str| {
        let model = body(&format!("TUBE P *C *D 3000 -CA 0 {caa}"), "");
        let deep = position([0.0, 0.0, -20.0, 0.0, 0.0, 0.0]);
        let mut lowered = model.clone();
        lowered.bodies.get_mut("B").unwrap().position.shift = deep.origin.into();
        Floating::at_rest(&lowered, &lowered.bodies["B"]).unwrap().added_mass[(0, 0)]
    };
    let half_sphere = RHO * PI * 27.0 / 12.0;
    assert_share(along("-CAA 0.64"), 2.0 * 0.64 * half_sphere, 1e-12);
    assert_share(along("-CAA 0.64 0"), 0.64 * half_sphere, 1e-12);
    assert_share(along("-CAA 0.2 0.5"), 0.7 * half_sphere, 1e-12);
}

#[test]
fn added_mass_change_with_surface_is_in_step_inertia() {
    let model = body("TUBE S *A *B 20000 -CD 0 -CA 0.9", "");
    let load = members(&model, None);
    let (start, deeper) = (Pose::default(), position([0.0, 0.0, -5.0, 0.0, 0.0, 0.0]));
    let before = Six::new(1.0, 0.0, 0.0, 0.0, 0.0, 0.0);
    let now = BodyStep { time: 0.0, dt: 0.0, pose: &start, velocity: &before };
    let mut state = begin_step(load.as_ref(), &now);
    let after = Six::new(1.3, 0.0, 0.0, 0.0, 0.0, 0.0);
    let end = BodyStep { time: 0.5, dt: 0.5, pose: &deeper, velocity: &after };
    load.as_stateful().unwrap().begin(&end, &mut state).unwrap();
    let more = RHO * PI * 100.0 * 0.9 * 5.0;
    assert_share(load.as_inertial().unwrap().inertia(&state)[(0, 0)], more, 1e-9);
    // and no force of velocities
    let found = load.dynamic_load(&end, &state).unwrap();
    assert!(found.load.wrench[0].abs() < 1e-9 * more && found.damping[(0, 0)] == 0.0);
}

#[test]
fn piece_covered_by_database_keeps_drag_alone() {
    let model = body("TUBE S *A *B 20000 -DIFTYPE 3DDIF", "");
    let floating = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
    assert_eq!(floating.added_mass, Matrix6::zeros());
    let load = members(&model, Some(&wave(3.0, 0.6, 0.0, None, Stretching::Wheeler)));
    // cos q = 0: there is no flow along the wave, and across the tube none at all
    let got = force(load.as_ref(), -0.5 * PI / 0.6);
    assert!(got.norm() > 0.0 && got[0].abs() < 1e-9 * RHO * 9.81 * 314.0, "{got}");
    assert!(load_at(load.as_ref(), 0.0, &Pose::default(), &Six::zeros()).load.wrench[0] > 0.0);
}

#[test]
fn drag_in_time_domain_has_its_own_category() {
    let model = body("TUBE T *A *B 2000", "&ENV -CURRENT 1 180");
    let load = members(&model, Some(&wave(2.0, 0.8, 0.0, None, Stretching::Wheeler)));
    let (pose, velocity) = (Pose::default(), Six::zeros());
    let now = BodyStep { time: 0.0, dt: 0.0, pose: &pose, velocity: &velocity };
    let state = begin_step(load.as_ref(), &now);
    let divided = load.as_divided().unwrap();
    assert_eq!(divided.other_categories(), [Category::ViscousDrag, Category::WaveMean]);
    let drag = divided.part(Category::ViscousDrag, &now, &state);
    let whole = load.dynamic_load(&now, &state).unwrap().load.wrench;
    // under the crest there is no acceleration along the wave: all of it is drag
    assert_share(whole[0], drag[0], 1e-12);
    assert!(drag[0] > 0.0);
}

#[test]
fn hull_without_wave_loads_is_reported() {
    let model = body(
        "TUBE T *A *B 2000\nBLOCK H 0 0 0 1 1 1\nBLOCK F 2 0 0 3 1 1 -DIFTYPE FK\nBLOCK D 4 0 0 5 1 1 -DIFTYPE 3DDIF",
        "",
    );
    let names: Vec<&str> =
        morison::pieces_without_wave_load(&model, &model.bodies["B"]).map(|p| p.name.as_str()).collect();
    assert_eq!(names, ["H"]);
}

/// The force of waves on a box of 60 x 20 x 14 m, 8 m deep, that lets them pass.
fn on_a_box(sea: &Arc<Sea>, time: f64, pose: &Pose) -> Six {
    let model = body("BLOCK H -30 -10 -8 30 10 6 -DIFTYPE FK", "");
    load_at(members(&model, Some(sea)).as_ref(), time, pose, &Six::zeros()).load.wrench
}

#[test]
fn box_wave_pressure_force_matches_closed_form() {
    // over the bottom: rho g a e^-kT B int cos(kx - wt) dx; on the ends: rho g a B (1 - e^-kT)/k times the difference of cosines
    let (w, a, long, wide, deep) = (0.7, 0.01, 60.0, 20.0, 8.0);
    let k = w * w / G;
    let sea = wave(a, w, 0.0, None, Stretching::Linear);
    for time in [0.0, 1.5, 4.0] {
        let got = on_a_box(&sea, time, &Pose::default());
        let side = 2.0 * (k * long / 2.0).sin();
        let heave = RHO * G * a * (-k * deep).exp() * wide * side / k * (w * time).cos();
        let surge = -RHO * G * a * wide * (1.0 - (-k * deep).exp()) / k * side * (w * time).sin();
        // panels err by the fourth power of k h, 2e-4; at the waterline by its square over some ten cells; the square of the amplitude by a/deep
        assert_share(got[2], heave, 1e-3);
        if time > 0.0 {
            assert_share(got[0], surge, 5e-3);
        }
    }
}

#[test]
fn very_long_waves_lift_box_like_a_tide() {
    let component = Component { frequency: 1e-6, number: 1e-10, amplitude: 1.7, toward: [1.0, 0.0], phase: 0.0 };
    let sea = Arc::new(Sea::airy(vec![component], water(None), 0.0, Stretching::Linear));
    let hull = windlass_hydro::hull::Surface::block([-30.0, -10.0, -8.0], [30.0, 10.0, 6.0]);
    for pose in [Pose::default(), position([0.0, 0.0, 1.0, 25.0, -10.0, 50.0])] {
        let got = on_a_box(&sea, 0.0, &pose);
        let at = |level: f64| hull.wet(&pose, level).load(RHO * G).wrench;
        let want = at(1.7) - at(0.0);
        assert!((got - want).norm() <= 1e-7 * want.norm(), "{got} {want}");
    }
    let calm = wave(0.0, 0.7, 0.0, None, Stretching::Wheeler);
    let left = on_a_box(&calm, 0.0, &position([0.0, 0.0, 1.0, 25.0, -10.0, 50.0]));
    assert!(left.norm() <= 1e-12 * RHO * G * 16_800.0 * 30.0, "{left}");
}
