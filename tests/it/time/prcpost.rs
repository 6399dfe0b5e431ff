//! Tables of a run against closed forms: a point on a turning body, a line that hardly stretches between its ends, sums of forces,
//! a winched length, a wave.

use crate::common::run as runs;

use nalgebra::Vector3;
use runs::{model, settings};
use std::sync::Arc;
use windlass_base::pose::Six;
use windlass_base::table::{Cell, Table};
use windlass_hydro::sea::{Component, Sea, Water};
use windlass_model::{FatigueSelection, Model, Stretching};
use windlass_signal::fatigue::{cycle_damage, find};
use windlass_signal::rainflow::cycles;
use windlass_solve::results::{self, EventWindow, Magnitude, MotionOptions, ScatterExposure, TrackedPoint};
use windlass_solve::time::{Action, ActionKind, Ending, Run, SilentWatcher, Trigger};

fn run(model: &Model, (observed, dt): (f64, f64), start: &[(usize, Six)], actions: Vec<Action>) -> Run {
    let mut run = Run::new(model, settings(observed, dt), actions).unwrap();
    run.begin_with(start).unwrap();
    assert_eq!(run.run(&mut SilentWatcher), Ok(Ending::Done));
    run
}

/// The numbers of a column, by its group and name.
fn column(table: &Table, group: &str, name: &str) -> Vec<f64> {
    let found = table.columns().iter().find(|c| c.group == group && c.name == name);
    let found = found.unwrap_or_else(|| panic!("no {group}: {name} in {:?}", table.title));
    found.cells.iter().map(|c| c.number().unwrap_or(f64::NAN)).collect()
}

fn vectors(table: &Table, group: &str, names: [&str; 3]) -> Vec<Vector3<f64>> {
    let [x, y, z] = names.map(|n| column(table, group, n));
    (0..x.len()).map(|i| Vector3::new(x[i], y[i], z[i])).collect()
}

fn assert_near(got: &[Vector3<f64>], want: impl Fn(f64) -> Vector3<f64>, dt: f64, tolerance: f64) {
    for (i, got) in got.iter().enumerate() {
        let want = want(dt * i as f64);
        assert!((got - want).norm() <= tolerance, "at {}: {got:?} is not {want:?}", dt * i as f64);
    }
}

/// A body that only turns about a vertical axis through its origin, and does so without end.
const TOP: &str = "&ENV E -DEPTH 50\nMEDIT\n&DESCRIBE BODY TOP -IGNORE X Y Z RX RY\n*C 4 0 2\n*P 3 -4 1\n#WEIGHT *C 1E5 2 2 3\n\
                   END\n&INSTATE -LOCATE TOP 10 20 5\n&DESCRIBE INTEREST *P\n";
const SPIN: f64 = 0.7;

fn rotate_about_z(angle: f64, v: Vector3<f64>) -> Vector3<f64> {
    let (sin, cos) = angle.sin_cos();
    Vector3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z)
}

#[test]
fn point_of_rotating_body_moves_on_a_circle() {
    // the angle is the integral of a constant: rounding of 200 steps is left
    let (dt, tolerance) = (0.1, 1e-10);
    let made = run(&model(TOP), (20.0, dt), &[(0, Six::new(0.0, 0.0, 0.0, 0.0, 0.0, SPIN))], vec![]);
    let events = results::events(&made.history, None).unwrap();
    let spin = Vector3::new(0.0, 0.0, SPIN);
    let (origin, centre) = (Vector3::new(10.0, 20.0, 5.0), Vector3::new(4.0, 0.0, 2.0));
    let options = MotionOptions { centre: true, ..MotionOptions::default() };
    let table = results::trajectory(&made, &[0], &options, &events).unwrap();
    let at = |t: f64| rotate_about_z(SPIN * t, centre);
    assert_near(&vectors(&table, "Location", ["X", "Y", "Z"]), |t| origin + at(t), dt, tolerance);
    assert_near(&vectors(&table, "Velocity", ["VX", "VY", "VZ"]), |t| spin.cross(&at(t)), dt, tolerance);
    assert_near(
        &vectors(&table, "Acceleration", ["AX", "AY", "AZ"]),
        |t| spin.cross(&spin.cross(&at(t))),
        dt,
        tolerance,
    );
    assert_near(&vectors(&table, "Displacement", ["DX", "DY", "DZ"]), |t| at(t) - centre, dt, tolerance);
    // two turns and more: angles do not jump
    let yaw = column(&table, "Displacement", "DYaw");
    assert!((yaw.last().unwrap() - SPIN * 20.0).abs() < tolerance, "{yaw:?}");
    // 50 m of water below the mean level, the centre 7 m above it
    assert!(column(&table, "Bottom", "Clearance").iter().all(|c| (c - 57.0).abs() < tolerance));
    assert!(column(&table, "Velocity", "V Mag.").iter().all(|v| (v - 4.0 * SPIN).abs() < tolerance));

    // along its own axes what turns with it stands still
    let options = MotionOptions { centre: true, local: true, magnitude: Magnitude([true, false, false]) };
    let table = results::trajectory(&made, &[0], &options, &events).unwrap();
    assert_near(&vectors(&table, "Velocity", ["VX", "VY", "VZ"]), |_| spin.cross(&centre), dt, tolerance);
    assert_near(
        &vectors(&table, "Acceleration", ["AX", "AY", "AZ"]),
        |_| spin.cross(&spin.cross(&centre)),
        dt,
        tolerance,
    );
    assert!(column(&table, "Acceleration", "A Mag.").iter().all(|a| (a - 4.0 * SPIN * SPIN).abs() < tolerance));
    // columns where the published samples have them
    assert_eq!(table.columns()[1].name, "X");
    assert_eq!(table.columns()[5].name, "Roll");
}

#[test]
fn points_of_interest_move_with_body_in_wave_of_run() {
    let mut made = run(&model(TOP), (4.0, 0.1), &[(0, Six::new(0.0, 0.0, 0.0, 0.0, 0.0, SPIN))], vec![]);
    let wave = Component { frequency: 0.6, number: 0.04, amplitude: 1.5, toward: [0.6, 0.8], phase: 0.3 };
    let water = Water { depth: Some(50.0), level: 0.25, gravity: 9.80665, density: 1025.0 };
    made.seas = vec![(0.0, Some(Arc::new(Sea::airy(vec![wave], water, 0.0, Stretching::default()))))];
    let point = made.model.points["*P"].clone();
    // (10, 20, 5) + (3, -4, 1)
    assert_eq!(point.interest, Some([13.0, 16.0, 6.0]));
    let marked = point.interest.unwrap();
    let on_body = TrackedPoint { name: "*P".into(), body: Some(0), at: point.at, marked };
    let fixed = TrackedPoint { name: "*G".into(), body: None, at: [100.0, 50.0, 3.0], marked: [100.0, 50.0, 3.0] };
    let window = EventWindow { begin: 0.0, end: Some(99.0), increment: Some(0.2) };
    let events = results::events(&made.history, Some(&window)).unwrap();
    let table = results::points(&made, &[on_body, fixed], (false, Magnitude::default()), &events).unwrap();
    assert_eq!(table.rows(), 21);
    let own = Vector3::new(3.0, -4.0, 1.0);
    let at = |t: f64| Vector3::new(10.0, 20.0, 5.0) + rotate_about_z(SPIN * t, own);
    assert_near(&vectors(&table, "*P Location", ["X", "Y", "Z"]), at, 0.2, 1e-10);
    assert_near(&vectors(&table, "*P Motion", ["DX", "DY", "DZ"]), |t| at(t) - Vector3::from(marked), 0.2, 1e-10);
    let level = |at: Vector3<f64>, t: f64| 1.5 * (0.04 * (0.6 * at.x + 0.8 * at.y) - 0.6 * t + 0.3).cos();
    for (name, position) in [("*P Waves", None), ("*G Waves", Some(Vector3::new(100.0, 50.0, 3.0)))] {
        let (waves, clear) = (column(&table, name, "W. Elv"), column(&table, name, "Clearance"));
        for i in 0..waves.len() {
            let t = 0.2 * i as f64;
            let at = position.unwrap_or(at(t));
            assert!((waves[i] - level(at, t)).abs() < 1e-9, "{name} {t}: {}", waves[i]);
            assert!((clear[i] - (at.z - 0.25 - level(at, t))).abs() < 1e-9);
        }
    }
}

/// Weight of a line a metre (N/m).
const W: f64 = 1000.0;
/// Its breaking tension (N).
const BREAK: f64 = 1e6;
/// Height of its fairlead above the bottom (m).
const HEIGHT: f64 = 202.0;

/// A barge on three lines of 1010 m that hardly stretch (a strain of 6e-10), let go beside its rest.
fn moored_model(more: &str) -> Model {
    model(&format!(
        "&ENV E -DEPTH 200\nMEDIT\n&DESCRIBE BODY BARGE -IGNORE Z RX RY\n*C 1 0 0\n#WEIGHT *C 2E7 10 10 14\n\
         *A 20 -3 2\n*B -20 8 2\n*D 0 -8 2\n{more}\
         ~L B_CAT 100 EXACT -LEN 1010 -DEP 200 -BUOY 0 -WTPL 1000 -EMOD 1E11 -B_TEN 1E6\n\
         CONNECTOR A -ANC 30 920 ~L *A\nCONNECTOR B -ANC 150 925 ~L *B\nCONNECTOR D -ANC -90 920 ~L *D\nEND\n\
         &INSTATE -LOCATE BARGE 6 -3 0 0 0 5\n"
    ))
}

/// Horizontal force and suspended length of a line that does not stretch, its ends `x` apart: bisection on the closed catenary
/// of one that lies on the bottom, `x = L - s + H/w acosh(1 + w h/H)`, `s = sqrt(h^2 + 2 h H/w)`.
fn closed_form(x: f64, length: f64) -> (f64, f64) {
    let of = |a: f64| {
        let s = (HEIGHT * HEIGHT + 2.0 * HEIGHT * a).sqrt();
        (length - s + a * (1.0 + HEIGHT / a).acosh(), s)
    };
    let (mut low, mut high) = (1e-3, 1e5);
    for _ in 0..200 {
        let a: f64 = 0.5 * (low + high);
        if of(a).0 < x { low = a } else { high = a }
    }
    (W * low, of(low).1)
}

/// Anchors of the lines, and their fairleads in the barge.
fn ends(model: &Model, line: &str, point: &str) -> (Vector3<f64>, Vector3<f64>) {
    let [x, y] = model.connectors[line].anchor.unwrap().at;
    (Vector3::new(x, y, -200.0), Vector3::from(model.points[point].at))
}

#[test]
fn line_forces_match_catenary_at_every_event() {
    let model = moored_model("");
    // A is paid out from 10 s on
    let winch =
        Action { name: "W".into(), when: Trigger::At(10.0), what: ActionKind::Winch(vec!["A".into()], 0.3, None) };
    let made = run(&model, (30.0, 0.5), &[], vec![winch]);
    let events = results::events(&made.history, None).unwrap();
    let positions = results::trajectory(&made, &[0], &MotionOptions::default(), &events).unwrap();
    let (at, yaw) = (vectors(&positions, "Location", ["X", "Y", "Z"]), column(&positions, "Location", "Yaw"));
    for (link, (line, point)) in [("A", "*A"), ("B", "*B"), ("D", "*D")].into_iter().enumerate() {
        let table = results::connector_forces(&made, &[link], Magnitude::default(), &events).unwrap();
        let forces = vectors(&table, "Force", ["FX", "FY", "FZ"]);
        let ratios = column(&table, "Force", "Mag./Break");
        let grounded = column(&table, "On Bottom", "Length");
        let (up, along) = (column(&table, "Anchor", "V. Pull"), column(&table, "Anchor", "H. Pull"));
        let columns = &made.history.layout.links[link];
        let length: Vec<f64> = made.history.rows().map(|row| columns.length(row).unwrap()).collect();
        let (anchor, own) = ends(&model, line, point);
        for i in 0..forces.len() {
            let t = 0.5 * i as f64;
            let want = if line == "A" { 1010.0 + 0.3 * (t - 10.0).max(0.0) } else { 1010.0 };
            assert!((length[i] - want).abs() < 1e-9, "{line} {t}: {}", length[i]);
            let to = anchor - (at[i] + rotate_about_z(yaw[i], own));
            let (h, suspended) = closed_form(to.x.hypot(to.y), length[i]);
            let tension = h + W * HEIGHT;
            let want = Vector3::new(h * to.x / to.x.hypot(to.y), h * to.y / to.x.hypot(to.y), -W * suspended);
            // the strain is 6e-10 of a length of 1010 m, and a metre changes the force by some hundredth
            assert!((forces[i] - want).norm() < 1e-6 * tension, "{line} {t}: {:?} is not {want:?}", forces[i]);
            assert!((ratios[i] - tension / BREAK).abs() < 1e-6, "{line} {t}: {}", ratios[i]);
            assert!((grounded[i] - (length[i] - suspended)).abs() < 1e-4, "{line} {t}: {}", grounded[i]);
            assert!(up[i].abs() < 1e-6 && (along[i] - h).abs() < 1e-6 * tension, "{line} {t}: {} {}", up[i], along[i]);
        }
        let sizes = results::magnitudes(&made, &[link], Magnitude([true, true, false]), &events).unwrap();
        for (size, force) in column(&sizes, "Force Magnitude", line).iter().zip(&forces) {
            assert!((size - force.x.hypot(force.y)).abs() < 1e-6);
        }
    }
}

#[test]
fn total_connector_force_is_sum_of_forces_and_moments() {
    let model = moored_model("");
    let made = run(&model, (10.0, 0.5), &[], vec![]);
    let events = results::events(&made.history, None).unwrap();
    let positions = results::trajectory(&made, &[0], &MotionOptions::default(), &events).unwrap();
    let yaw = column(&positions, "Location", "Yaw");
    let total = results::total_forces(&made, &[0], Magnitude::default(), &events).unwrap();
    let all = results::connector_forces(&made, &[0, 1, 2], Magnitude::default(), &events).unwrap();
    let each: Vec<_> = ["A", "B", "D"]
        .into_iter()
        .map(|n| (vectors(&all, &format!("{n} Force"), ["FX", "FY", "FZ"]), ends(&model, n, &format!("*{n}")).1))
        .collect();
    let sum = |i: usize| each.iter().map(|(f, _)| f[i]).sum::<Vector3<f64>>();
    let moment = |i: usize| each.iter().map(|(f, own)| rotate_about_z(yaw[i], *own).cross(&f[i])).sum::<Vector3<f64>>();
    let (forces, moments) =
        (vectors(&total, "Connectors", ["FX", "FY", "FZ"]), vectors(&total, "Connectors", ["MX", "MY", "MZ"]));
    for i in 0..forces.len() {
        // forces: rounding of 5e5 N. Moments: a place is corrected once more behind its forces, by what 1e-7 of gravity left turns a radius of
        // 15 m in a step of half a second, 4e-9 rad at most; 5e5 N on arms of 20 m
        let (force, moment) = ((forces[i] - sum(i)).norm(), (moments[i] - moment(i)).norm());
        assert!(force < 1e-7 && moment < 0.04, "{i}: {force} N, {moment} N m");
    }
}

#[test]
fn all_categories_with_inertia_balance_at_every_event() {
    let model = moored_model("#DAMP *C 2E5 3E5 0 0 0 5E8\n");
    let made = run(&model, (20.0, 0.25), &[(0, Six::new(0.5, 0.0, 0.0, 0.0, 0.0, 0.05))], vec![]);
    let events = results::events(&made.history, None).unwrap();
    let table = results::body_forces(&made, &[0], Magnitude::default(), &events).unwrap();
    // the step leaves 1e-7 g of acceleration, of a rotation times the radius of gyration: 2E7 N, some 15 m
    let (force, moment) = (1e-7 * 2e7, 1e-7 * 2e7 * 16.0);
    let groups: Vec<&str> = made.history.layout.categories.iter().map(|c| c.name()).collect();
    assert!(["WEIGHT", "FLEX_CONNECTORS", "INERTIA", "CORIOLIS"].iter().all(|g| groups.contains(g)), "{groups:?}");
    for (name, left) in [("FX", force), ("FY", force), ("MZ", moment)] {
        let each: Vec<Vec<f64>> = groups.iter().map(|g| column(&table, g, name)).collect();
        for (i, total) in column(&table, "TOTAL", name).iter().enumerate() {
            let sum: f64 = each.iter().map(|c| c[i]).sum();
            assert!((sum - total).abs() < 1e-6 && total.abs() <= left, "{name} {i}: {total}");
        }
        assert!(each.iter().flatten().any(|v| v.abs() > 1e3), "{name}");
    }
}

#[test]
fn released_line_has_no_values_after_release() {
    let gone = Action { name: "R".into(), when: Trigger::At(5.0), what: ActionKind::Release(vec!["D".into()]) };
    let made = run(&moored_model(""), (10.0, 0.5), &[], vec![gone]);
    let window = EventWindow { begin: 4.0, end: Some(6.0), increment: Some(0.25) };
    let events = results::events(&made.history, Some(&window)).unwrap();
    let table = results::connector_forces(&made, &[2], Magnitude::default(), &events).unwrap();
    for (at, time) in column(&table, "", "Time").into_iter().enumerate() {
        let known = time < 5.0;
        for cells in table.columns().iter().skip(1) {
            assert_eq!(cells.cells[at] != Cell::Missing, known, "{} at {time}", cells.name);
        }
    }
    for row in made.history.rows() {
        assert_eq!(made.history.layout.links[2].length(row).is_some(), row[0] < 5.0, "{}", row[0]);
    }
}

#[test]
fn values_between_stored_instants_are_interpolated_linearly() {
    let made = run(&moored_model(""), (4.0, 0.5), &[], vec![]);
    let all = results::magnitudes(&made, &[0], Magnitude::default(), &results::events(&made.history, None).unwrap());
    let stored = column(&all.unwrap(), "Force Magnitude", "A");
    let window = EventWindow { begin: 1.2, end: Some(1.2), increment: Some(1.0) };
    let events = results::events(&made.history, Some(&window)).unwrap();
    let between = results::magnitudes(&made, &[0], Magnitude::default(), &events).unwrap();
    let want = 0.6 * stored[2] + 0.4 * stored[3];
    assert!((column(&between, "Force Magnitude", "A")[0] - want).abs() < 1e-9 * want);
    assert!((column(&between, "", "Time")[0] - 1.2).abs() < 1e-12);
}

#[test]
fn segment_damage_uses_upper_end_tension_and_scatter_adds_by_days() {
    let records = "~T B_CAT 100 EXACT -LEN 150 -BUOY 0 -WTPL 1000 -EMOD 1E11 -B_TEN 2E6 -C_SN CHAIN\n\
                   ~T B_CAT 100 EXACT -LEN 860 -DEP 200 -BUOY 0 -WTPL 1000 -EMOD 1E11 -B_TEN 1E6\nCONNECTOR T -ANC 60 925 ~T *B\n";
    let made = run(&moored_model(records), (60.0, 0.5), &[], vec![]);
    let events = results::events(&made.history, None).unwrap();
    let selection = FatigueSelection { chosen: vec!["CHAIN".into()], ..FatigueSelection::default() };
    let link = made.history.layout.links.iter().position(|l| l.name == "T").unwrap();
    let damages = results::line_damages(&made, &[link], &selection, &events).unwrap();
    let segments = &damages[0].1.segments;
    let positions = results::trajectory(&made, &[0], &MotionOptions::default(), &events).unwrap();
    let (at, yaw) = (vectors(&positions, "Location", ["X", "Y", "Z"]), column(&positions, "Location", "Yaw"));
    let (anchor, own) = ends(&made.model, "T", "*B");
    let (mut top, mut joint) = (Vec::new(), Vec::new());
    for (at, yaw) in at.iter().zip(&yaw) {
        let to = anchor - (at + rotate_about_z(*yaw, own));
        let (h, suspended) = closed_form(to.x.hypot(to.y), 1010.0);
        top.push((h + W * HEIGHT) / 2e6);
        joint.push(h.hypot(W * (suspended - 150.0)) / 1e6);
    }
    let chain = find("CHAIN", &selection).unwrap();
    for (segment, ratios) in segments.iter().zip([&top, &joint]) {
        let mean = ratios.iter().sum::<f64>() / ratios.len() as f64;
        let want = cycle_damage(&cycles(ratios).unwrap(), &chain, mean).unwrap();
        let most = ratios.iter().copied().fold(0.0, f64::max);
        assert!((segment.most_used - most).abs() < 1e-6, "{segment:?} {most}");
        // by the third power of ranges of a hundredth, each with an error of 1e-6 of the tension
        assert!(want.sum > 0.0 && (segment.damage / want.sum - 1.0).abs() < 2e-3, "{segment:?} {want:?}");
    }
    let day = 86_400.0;
    let exposed = |days: f64| ScatterExposure {
        environment: "E".into(),
        record: 60.0,
        duration: days * day,
        lines: damages.clone(),
    };
    let table = results::scatter(&[exposed(10.0), exposed(5.0)], 2.0).unwrap();
    let (cdr, years) = (column(&table, "All Environments", "CDR"), column(&table, "All Environments", "Life, Years"));
    for (segment, (cdr, years)) in segments.iter().zip(cdr.iter().zip(years)) {
        assert!((cdr / (segment.damage * 15.0 * day / 60.0) - 1.0).abs() < 1e-12);
        assert!((years / (15.0 / 365.25 / cdr / 2.0) - 1.0).abs() < 1e-12);
    }
}
