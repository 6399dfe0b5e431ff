//! Excursions and watch circles against closed forms.

use crate::common;

use std::f64::consts::{FRAC_PI_4, TAU};
use windlass::session::Session;
use windlass_base::pose::{Pose, Six};
use windlass_base::table::Table;
use windlass_catenary::{Line, Segment};
use windlass_model::{Model, Weight};
use windlass_solve::excursion::{ExcursionEnd, ExcursionPath, ExcursionSearch, resolve_wrench};
use windlass_solve::offset::{BodyConnectors, ConnectorPull};
use windlass_solve::watch::{WatchedBody, watch};
use windlass_solve::{SolveError, System};

/// The session that has run records, in metres and newtons.
fn ran(records: &str) -> Session {
    let (mut session, screen, _folder): (Session, _, _) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS N\n{records}\n"));
    session.run();
    assert_eq!(session.errors, 0, "{}", screen.text());
    session
}

fn model(records: &str) -> Model {
    ran(records).job.model.clone()
}

/// The table in the disposition menu that records leave open.
fn table(records: &str) -> Table {
    match ran(records).job.menu() {
        windlass::commands::Menu::Disposition(d) => d.table.clone(),
        other => panic!("{other:?}"),
    }
}

fn path(direction: f64) -> ExcursionPath {
    ExcursionPath { body: 0, direction, free: false, most: None }
}

/// EA of the springs: 29,000 ksi and a diameter of 50 mm (N).
fn ea() -> f64 {
    29000.0 * 6894757.293168361 * FRAC_PI_4 * 0.05 * 0.05
}

const LENGTH: f64 = 99.99;
const BREAK: f64 = 1e6;

/// Springs of 99.99 m from the origin of a body to points 100 m away: E, N, W, S.
fn springs(count: usize) -> String {
    let mut text = String::from("MEDIT\n");
    for n in 0..count {
        let (sin, cos) = (TAU * n as f64 / count as f64).sin_cos();
        text += &format!("*G{n} {:.15} {:.15} 0\n", 100.0 * cos, 100.0 * sin);
    }
    text += &format!("&DESCRIBE BODY SHIP\n*O 0 0 0\n~T SL_ELEM 50 TENSION -LEN {LENGTH} -B_TENSION {BREAK}\n");
    for n in 0..count {
        text += &format!("CONNECTOR L{n} ~T *O *G{n}\n");
    }
    text + "END"
}

/// The restoring force of four such springs along one of them.
fn closed_form(e: f64) -> f64 {
    let k = ea() / LENGTH;
    let side = 100.0_f64.hypot(e);
    let taut = |chord: f64| k * (chord - LENGTH).max(0.0);
    taut(100.0 + e) - taut(100.0 - e) + 2.0 * taut(side) * e / side
}

#[test]
fn four_taut_springs_match_closed_form_and_break_at_windward() {
    let made = model(&springs(4));
    let system = System::new(&made, &[]).unwrap();
    let start = system.state(&made).poses;
    let mut walk = ExcursionSearch::new(&system, &start, path(0.0)).unwrap();
    let (rows, end) = walk.rows(30).unwrap();
    assert_eq!((rows.len(), end), (30, ExcursionEnd::Breaks(2)));
    for row in &rows {
        let [restoring, transverse, vertical] = resolve_wrench(&row.wrench, 0.0);
        let want = closed_form(row.excursion);
        assert!((restoring - want).abs() < 1e-7 * BREAK, "{} {restoring} {want}", row.excursion);
        // the two at the sides balance but for the rounding of 100 m
        assert!(transverse.abs() < 1e-7 * BREAK && vertical == 0.0, "{transverse} {vertical}");
    }
    let last = rows.last().unwrap();
    let at = LENGTH * (1.0 + BREAK / ea()) - 100.0;
    assert!((last.excursion - at).abs() < 1e-10, "{} {at}", last.excursion);
    let (ratio, line) = last.worst().unwrap();
    assert!((ratio - 1.0).abs() < 1e-12 && line == 2, "{ratio}");
    for (n, row) in rows.iter().enumerate() {
        assert!((row.excursion - at * n as f64 / 29.0).abs() < 1e-10);
    }
}

/// Two chains along X from the origin of a body at the surface, anchors 830 m away in 300 m of water.
const PAIR: &str = "MEDIT\n&DESCRIBE BODY SHIP\n*O 0 0 0\n\
                    ~C B_CAT 100 EXACT -LEN 900 -DEP 300 -BUOY 0 -WTPL 1700 -EMOD 108734.2 -B_TENSION 4E6\n\
                    CONNECTOR A -ANC 0 830 ~C *O\nCONNECTOR B -ANC 180 830 ~C *O\nEND";

#[test]
fn pair_of_chains_restores_with_difference_of_its_lines() {
    let made = model(PAIR);
    let system = System::new(&made, &[]).unwrap();
    let start = system.state(&made).poses;
    let (rows, end) = ExcursionSearch::new(&system, &start, path(0.0)).unwrap().rows(30).unwrap();
    assert_eq!(end, ExcursionEnd::Breaks(1));
    let segment = Segment { length: 900.0, weight: 1700.0, ea: 108734.2e6 * FRAC_PI_4 * 0.01 };
    let line = Line::new(vec![segment], vec![], -300.0, 0.0).unwrap();
    for row in &rows {
        let lee = line.at_distance(830.0 - row.excursion, 0.0).unwrap();
        let windward = line.at_distance(830.0 + row.excursion, 0.0).unwrap();
        let [restoring, _, vertical] = resolve_wrench(&row.wrench, 0.0);
        let scale = windward.top_tension;
        assert!((restoring - (windward.force - lee.force)).abs() < 1e-8 * scale, "{}", row.excursion);
        assert!((vertical + windward.top_vertical + lee.top_vertical).abs() < 1e-8 * scale);
        assert!((row.lines[1].tension.unwrap() - scale).abs() < 1e-8 * scale);
    }
    // the first breaks with its breaking tension at its top
    let last = line.at_distance(830.0 + rows.last().unwrap().excursion, 0.0).unwrap();
    assert!((last.top_tension / 4e6 - 1.0).abs() < 1e-9, "{}", last.top_tension);
}

#[test]
fn repeated_directions_have_equal_excursion_and_force() {
    let records = format!("{}\nCONN_DESIGN\nMOVE SHIP -ANGLES 0 360 15 -AT 0.1", springs(4));
    let made = table(&records);
    let column = |name: &str| made.get(name).unwrap().numbers();
    let (excursion, force, at) = (column("Excursion"), column("Restoring"), column("Force 0.1"));
    assert_eq!(excursion.len(), 25);
    for n in 0..25 {
        // a quarter turn, and the mirror image about X
        for other in [(n + 6) % 24, (24 - n) % 24] {
            assert!((excursion[n] - excursion[other]).abs() < 1e-9, "{n} {excursion:?}");
            assert!((force[n] / force[other] - 1.0).abs() < 1e-7, "{n} {force:?}");
            assert!((at[n] / at[other] - 1.0).abs() < 1e-7, "{n} {at:?}");
        }
    }
    assert!((at[0] - closed_form(0.1)).abs() < 1e-7 * BREAK);
}

#[test]
fn removed_line_has_no_effect_and_intact_mooring_is_listed_beside() {
    let whole = springs(4);
    let made = table(&format!("{whole}\nCONN_DESIGN\nMOVE SHIP 45 -REMOVE L1 -ROWS 9"));
    let without = whole.replace("CONNECTOR L1 ~T *O *G1\n", "");
    let alone = table(&format!("{without}\nCONN_DESIGN\nMOVE SHIP 45 -ROWS 9"));
    for name in ["Excursion", "Restoring", "Transverse", "MZ", "Max T/TB", "Ten L0", "Ten L3"] {
        assert_eq!(made.get(name).unwrap().numbers(), alone.get(name).unwrap().numbers(), "{name}");
    }
    assert!(made.get("Ten L1").is_none());
    let farthest = made.get("Excursion").unwrap().numbers()[8];
    let intact = table(&format!("{whole}\nCONN_DESIGN\nMOVE SHIP 45 -DISTANCE {farthest} -ROWS 9"));
    for (beside, name) in [("Intact Force", "Restoring"), ("Intact T/TB", "Max T/TB")] {
        let pairs = made.get(beside).unwrap().numbers().into_iter().zip(intact.get(name).unwrap().numbers());
        pairs.for_each(|(a, b)| assert!((a - b).abs() <= 1e-9 * BREAK.max(b), "{name} {a} {b}"));
    }
}

#[test]
fn held_excursion_stays_on_its_line_and_free_one_yields_sideways() {
    // the weight hangs between three springs of unlike angles: moved along 20 degrees it is pushed aside, up and around
    let records = "MEDIT\n*G0 100 0 60\n*G1 -60 80 60\n*G2 -50 -90 60\n&DESCRIBE BODY SHIP\n*P 2 0 1\n*Q -1 1 1\n*R -1 -1 1\n\
                   ~T SL_ELEM 50 TENSION -LEN 116 -B_TENSION 1E9\nCONNECTOR L0 ~T *P *G0\nCONNECTOR L1 ~T *Q *G1\n\
                   CONNECTOR L2 ~T *R *G2\nEND";
    let mut made = model(records);
    let weight = Weight { at: [0.0, 0.0, -1.0], weight: 5e5, radii: [2.0; 3], ..Weight::default() };
    made.parts.get_mut("SHIP").unwrap().weights.push(weight);
    let system = System::new(&made, &[]).unwrap();
    let start = system.state(&made).poses;
    let angle = 20.0_f64.to_radians();
    let held = ExcursionPath { most: Some(6.0), ..path(angle) };
    let (rows, _) = ExcursionSearch::new(&system, &start, held).unwrap().rows(5).unwrap();
    for row in &rows {
        let gone = row.poses[0].origin - start[0].origin;
        assert!((gone.x - row.excursion * angle.cos()).abs() < 1e-12);
        assert!((gone.y - row.excursion * angle.sin()).abs() < 1e-12);
        assert!(gone.z == 0.0 && row.poses[0].axes == start[0].axes);
    }
    let free = ExcursionPath { free: true, ..held };
    let (rows, end) = ExcursionSearch::new(&system, &start, free).unwrap().rows(5).unwrap();
    assert_eq!((rows.len(), end), (5, ExcursionEnd::Most));
    for row in &rows {
        let gone = row.poses[0].origin - start[0].origin;
        let along = gone.x * angle.cos() + gone.y * angle.sin();
        assert!((along - row.excursion).abs() < 1e-9, "{along} {}", row.excursion);
        assert!((gone.y * angle.cos() - gone.x * angle.sin()).abs() > 1e-3);
        let [restoring, transverse, vertical] = resolve_wrench(&row.wrench, angle);
        assert!(transverse.abs() < 1e-3 && (vertical - 5e5).abs() < 1e-3, "{transverse} {vertical}");
        // the connectors carry the weight where it is; only a force along the direction is left
        let arm = row.poses[0].axes * nalgebra::Vector3::new(0.0, 0.0, -1.0);
        let moment = arm.cross(&nalgebra::Vector3::new(0.0, 0.0, -5e5));
        for i in 0..3 {
            assert!((row.wrench[3 + i] + moment[i]).abs() < 1e-2, "{:?}", row.wrench);
        }
        assert!(restoring.is_finite());
    }
    // the force along the direction is the slope of nothing hidden: it grows away from rest
    let force = |n: usize| resolve_wrench(&rows[n].wrench, angle)[0];
    assert!(force(4) > force(3) && force(3) > force(2));
}

/// The places of a watch circle, and the force left on the body there.
fn find_watched_bodies(made: &Model, force: f64, free: bool, count: usize) -> Vec<WatchedBody> {
    let mut system = System::new(made, &[]).unwrap();
    let start: Vec<Pose> = system.state(made).poses;
    let directions: Vec<f64> = (0..=count).map(|n| TAU * n as f64 / count as f64).collect();
    let list = watch(&mut system, &start, (0, force, free), &directions).unwrap().positions;
    for one in &list {
        let mut pull = ConnectorPull::default();
        BodyConnectors::on_body(&system, 0).unwrap().pull(&system, &[one.pose], &mut pull).unwrap();
        let left = pull.wrench - Six::new(force * one.direction.cos(), force * one.direction.sin(), 0.0, 0.0, 0.0, 0.0);
        let left = left[0].abs().max(left[1].abs());
        assert!(left < 1e-7 * force, "{left}");
    }
    list
}

#[test]
fn watch_circle_repeats_with_symmetry_and_is_round_for_many_lines() {
    // with n lines the stiffness of a small excursion e varies over the direction with (e/100)^(n-2): 32 lines, nothing
    let made = model(&springs(32));
    let list = find_watched_bodies(&made, 3e5, false, 24);
    let radius = |w: &WatchedBody| w.pose.origin.xy().norm();
    let mean = list.iter().map(radius).sum::<f64>() / list.len() as f64;
    // less than 0.01 m, where the lee springs would go slack
    assert!(mean > 0.004 && mean < 0.009, "{mean}");
    for one in &list {
        assert!((radius(one) / mean - 1.0).abs() < 1e-6, "{} {mean}", radius(one));
        // it goes where the force pushes it: away from where it comes from
        let (sin, cos) = one.direction.sin_cos();
        assert!((one.pose.origin.x + mean * cos).abs() < 1e-6 && (one.pose.origin.y + mean * sin).abs() < 1e-6);
    }
    // along a spring of four the excursion is that of the closed form
    let four = find_watched_bodies(&model(&springs(4)), 5e5, false, 8);
    let e = radius(&four[0]);
    assert!((closed_form(e) - 5e5).abs() < 1e-3, "{e}");
    for n in 0..8 {
        assert!((radius(&four[n]) - radius(&four[(n + 2) % 8])).abs() < 1e-9);
    }
}

#[test]
fn watch_circle_with_removed_line_is_listed_beside_intact_one() {
    let records = springs(4);
    let both = table(&format!("{records}\nCONN_DESIGN\nWATCH SHIP 2E5 -ANGLES 0 330 30 -REMOVE L0"));
    let intact = table(&format!("{records}\nCONN_DESIGN\nWATCH SHIP 2E5 -ANGLES 0 330 30"));
    assert_eq!(both.get("Intact Exc.").unwrap().numbers(), intact.get("Excursion").unwrap().numbers());
    // without the line of +X a force from +X has the body where its opposite alone would not hold it
    let (gone, before) = (both.get("X").unwrap().numbers(), intact.get("X").unwrap().numbers());
    assert!(gone[0] < before[0], "{gone:?} {before:?}");
    assert!(both.get("Max T/TB").unwrap().numbers().iter().all(|r| *r > 0.0));
}

#[test]
fn unbreakable_mooring_requires_distance_and_unmoored_body_is_named() {
    let records = springs(4).replace(&format!(" -B_TENSION {BREAK}"), " -B_TENSION 1E15");
    let made = model(&records);
    let system = System::new(&made, &[]).unwrap();
    let start = system.state(&made).poses;
    let SolveError { who, error } = ExcursionSearch::new(&system, &start, path(0.3)).unwrap().end().unwrap_err();
    assert_eq!(who.as_deref(), Some("SHIP"));
    assert!(error.to_string().contains("none of its lines breaks"), "{error}");
    let near = ExcursionPath { most: Some(5.0), ..path(0.3) };
    let (last, end) = ExcursionSearch::new(&system, &start, near).unwrap().end().unwrap();
    assert!(end == ExcursionEnd::Most && last.excursion == 5.0);
    let names: Vec<String> = (0..4).map(|n| format!("L{n}")).collect();
    let bare = System::new(&made, &names).unwrap();
    assert!(
        ExcursionSearch::new(&bare, &start, near).unwrap_err().error.to_string().contains("no connector acts on it")
    );
}

#[test]
fn forces_alone_match_evaluation_with_stiffness() {
    let made = model(PAIR);
    let system = System::new(&made, &[]).unwrap();
    let mut state = system.state(&made);
    let (mut connectors, mut pull) = (BodyConnectors::on_body(&system, 0).unwrap(), ConnectorPull::default());
    for n in 0..20 {
        state.poses[0].origin.x = f64::from(n);
        state.poses[0].origin.y = 3.0 * f64::from(n);
        system.evaluate(&mut state).unwrap();
        connectors.pull(&system, &state.poses, &mut pull).unwrap();
        let most = pull.tensions.iter().copied().fold(0.0, f64::max);
        assert!((most - state.pull[0]).abs() < 1e-9 * most);
        for i in 0..6 {
            assert!((pull.wrench[i] - state.residual[i]).abs() < 1e-8 * most, "{i}");
        }
    }
}

#[test]
fn free_excursion_of_restrained_body_equals_held_one() {
    let records = springs(4).replace("\nEND", "\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\nEND");
    let made = model(&records);
    let system = System::new(&made, &[]).unwrap();
    let start = system.state(&made).poses;
    let (held, _) = ExcursionSearch::new(&system, &start, path(0.4)).unwrap().rows(5).unwrap();
    let (free, _) =
        ExcursionSearch::new(&system, &start, ExcursionPath { free: true, ..path(0.4) }).unwrap().rows(5).unwrap();
    for (a, b) in held.iter().zip(&free) {
        assert!((a.wrench - b.wrench).norm() < 1e-6 * BREAK, "{:?} {:?}", a.wrench, b.wrench);
    }
}

#[test]
fn body_on_eight_chains_matches_moorpy_forces() {
    // MoorPy 1.3.0 [MOORPY-1] over the mooring of benches/offsets.rs (benches/moorpy.py); at rest it leaves 0.94 N and 0.31 N m
    let section = FRAC_PI_4 * 0.18 * 0.18;
    let (modulus, weight) = (8.54e8 / section / 1e6, (199.0 - 1025.0 * section) * 9.80665);
    let mut records = "MEDIT\n&DESCRIBE BODY SHIP\n".to_string();
    let angle = |line: i32| 22.5 + 45.0 * f64::from(line);
    for line in 0..8 {
        let (sin, cos) = angle(line).to_radians().sin_cos();
        records += &format!("*F{line} {} {} -10\n", 30.0 * cos, 30.0 * sin);
    }
    records += &format!("~CHAIN B_CAT 180 EXACT -LEN 900 -DEP 300 -BUOY 0 -WTPL {weight} -EMOD {modulus}\n");
    for line in 0..8 {
        records += &format!("CONNECTOR L{line} -ANC {} 800 ~CHAIN *F{line}\n", angle(line));
    }
    let made = model(&(records + "END"));
    let system = System::new(&made, &[]).unwrap();
    let start = system.state(&made).poses;
    let mut walk = ExcursionSearch::new(&system, &start, path(0.0)).unwrap();
    for (excursion, restoring, vertical, pitch, tensions) in [
        (
            20.0,
            1552812.877563,
            -8091431.066101,
            -5741465.419268,
            [996461.5908, 1131778.4214, 1402879.4731, 1681692.0422],
        ),
        (
            40.0,
            3685391.125206,
            -8585706.244316,
            -9599360.960422,
            [838083.9890, 1041307.1210, 1611060.6529, 2501301.2452],
        ),
    ] {
        let there = walk.move_to(excursion).unwrap();
        let [force, across, up] = resolve_wrench(&there.wrench, 0.0);
        for (got, want) in [(force, restoring), (across, 0.0), (up, vertical), (there.wrench[4], pitch)] {
            assert!((got - want).abs() < 5.0 + 1e-6 * want.abs(), "{got} {want}");
        }
        for (line, want) in there.lines.iter().zip(tensions) {
            assert!((line.tension.unwrap() / want - 1.0).abs() < 2e-6, "{:?} {want}", line.tension);
        }
    }
}

#[test]
fn free_watch_circle_of_hanging_weight_matches_pendulum() {
    // hook 2 m above the weight and the force: both lie on the line through the spring
    let records = "MEDIT\n*A 0 0 0\n&DESCRIBE BODY LOAD\n*HOOK 0 0 2\n~TIE SL_ELEM 50 TENSION -LEN 10\n\
                   CONNECTOR T ~TIE *HOOK *A\nEND\n&INSTATE -LOCATE LOAD 0 0 -12";
    let mut made = model(records);
    let weight = Weight { at: [0.0; 3], weight: 1e5, radii: [1.0; 3], ..Weight::default() };
    made.parts.get_mut("LOAD").unwrap().weights.push(weight);
    let (force, tension) = (2e4, 2e4_f64.hypot(1e5));
    let reach = 10.0 * (1.0 + tension / ea()) + 2.0;
    for one in find_watched_bodies(&made, force, true, 12) {
        let (sin, cos) = one.direction.sin_cos();
        let at = one.pose.origin;
        let want = [-cos * force, -sin * force, -1e5].map(|f| reach * f / tension);
        for (got, want) in at.iter().zip(want) {
            assert!((got - want).abs() < 1e-7, "{at} {want}");
        }
        assert!((one.lines[0].tension.unwrap() / tension - 1.0).abs() < 1e-9);
    }
}
