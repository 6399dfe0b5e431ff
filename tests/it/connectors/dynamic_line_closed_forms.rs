//! Rods as a user has them, by records through the program, against closed forms, the exact catenary and MoorDyn.

use crate::common::moordyn;
use crate::common::run as runs;

use runs::{model, run, settings, trapezoidal};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use windlass_base::table::Table;
use windlass_model::{ConnectorResponse, End, Model, Situation, SolverCache};
use windlass_solve::System;
use windlass_solve::results::along::lines_at_rest;
use windlass_solve::time::{Run, RunSettings};

/// Force of a connector on the first body it is fixed to, at rest where its ends stand (N).
fn pull(model: &Model, name: &str) -> [f64; 3] {
    let system = System::new(model, &[]).unwrap();
    let state = system.state(model);
    let all = system.contributions(&state.poses).unwrap();
    let wrench = all.iter().find(|c| c.connector.as_deref() == Some(name)).unwrap().load.wrench;
    [wrench[0], wrench[1], wrench[2]]
}

/// The line at rest of a model that has one.
fn at_rest(model: &Model) -> Table {
    lines_at_rest(model, &|_| true).unwrap().remove(0)
}

fn column(table: &Table, name: &str) -> Vec<f64> {
    table.get(name).unwrap_or_else(|| panic!("{name}")).numbers()
}

fn size(force: [f64; 3]) -> f64 {
    force.iter().map(|v| v * v).sum::<f64>().sqrt()
}

/// Distance of two forces over the size of the second.
fn apart(a: [f64; 3], b: [f64; 3]) -> f64 {
    size([a[0] - b[0], a[1] - b[1], a[2] - b[2]]) / size(b)
}

/// How far the forces of rods of 20, 40, 80 and 160 elements are from an exact one.
fn errors_of_refinement(want: [f64; 3], rod: impl Fn(usize) -> String) -> Vec<f64> {
    [20, 40, 80, 160].map(|n| apart(pull(&model(&rod(n)), "L"), want)).to_vec()
}

/// A line from a body at (0, 0, -5) to an anchor `reach` away in 100 m of water.
fn moored_records(class: &str, reach: f64) -> String {
    format!(
        "&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n~L {class} -DEPANCHOR 100\n\
         CONNECTOR L -ANC 0 {reach} ~L *F\nEND\n"
    )
}

/// A line between two bodies, in deep water.
fn line_between(class: &str, from: [f64; 3], to: [f64; 3]) -> String {
    let position = |p: [f64; 3]| format!("{} {} {}", p[0], p[1], p[2]);
    format!(
        "&ENV -DEPTH 1000\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*A {}\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n\
         *B {}\n~L {class}\nCONNECTOR L ~L *A *B\nEND\n",
        position(from),
        position(to)
    )
}

#[test]
fn grounded_dynamic_line_force_converges_to_exact_catenary() {
    for (length, reach) in [(800.0, 785.0), (600.0, 560.0), (200.0, 170.0)] {
        let exact = pull(&model(&moored_records(&format!("B_CAT 120 EXACT -LEN {length}"), reach)), "L");
        let errors = errors_of_refinement(exact, |n| {
            moored_records(&format!("ROD 120 60 -LEN {length} -REFINE {n} -EI 0 -SEABED 1E7"), reach)
        });
        // the bottom gives way by 0.07 mm, 1e-6 of the height; what is left is the mesh, of the second order but for where in an
        // element the line comes down
        assert!(errors[3] < 1e-4, "{length}: {errors:?}");
        assert!(errors.windows(2).all(|e| e[1] < e[0] / 3.0), "{length}: {errors:?}");
        let order = (errors[0] / errors[3]).log2() / 3.0;
        assert!((1.9..2.7).contains(&order), "{length}: {order}");
    }
}

#[test]
fn grounded_dynamic_line_anchor_carries_pull_along_seabed_alone() {
    // a line that does not stretch, a = H/w, 95 m below its fairlead: x = L - s + a acosh(1 + h/a), s = sqrt(h^2 + 2 h a)
    let (length, reach, height) = (800.0, 785.0, 95.0f64);
    let net = (7850.0 - 1025.0) * FRAC_PI_4 * 0.12 * 0.12 * 9.80665;
    let (mut low, mut high) = (1.0, 1e4);
    for _ in 0..200 {
        let a: f64 = 0.5 * (low + high);
        let x = length - (height * height + 2.0 * height * a).sqrt() + a * (1.0 + height / a).acosh();
        if x < reach { low = a } else { high = a }
    }
    let horizontal = low * net;
    for class in ["ROD 120 60 -LEN 800 -REFINE 40 -EI 0", "ROD 120 60 -LEN 800 -REFINE 160 -EI 0"] {
        let made = model(&moored_records(&format!("{class} -EA 1E11 -SEABED 1E7"), reach));
        let (element, ends) = (made.element(&made.connectors["L"]).unwrap(), made.end_poses(&made.connectors["L"]));
        let ends = ends.map(End::at_rest);
        let at = Situation { ends: &ends, step: None, surroundings: &made.surroundings() };
        let (mut state, mut out) = (vec![0.0; element.states()], ConnectorResponse::default());
        element.start(&mut state);
        let committed = state.clone();
        element.evaluate(&at, &committed, &mut state, &mut SolverCache::new(), &mut out).unwrap();
        let [x, y, z] = [0, 1, 2].map(|i| out.wrench[1][i]);
        // half an element of 40 weighs 7.6 kN
        assert!(z == 0.0 && y.abs() < 1e-6 * horizontal, "{z}");
        // where in an element the line comes down moves its force by up to the square of the element over the suspended length
        assert!((x.abs() / horizontal - 1.0).abs() < 5e-3, "{x} {horizontal}");
    }
}

#[test]
fn hanging_dynamic_line_converges_to_catenary_with_second_order() {
    // weight, less what water of 1025 kg/m3 carries
    let area = FRAC_PI_4 * 0.12 * 0.12;
    let heavy = |water: f64| (7850.0 - water) * area * 9.80665;
    // net weight of the rod of -WTPLEN 900 with a diameter of 400 mm for buoyancy
    let light = 900.0 - 1025.0 * 9.80665 * FRAC_PI_4 * 0.16;
    for (what, length, options, net, [from, to]) in [
        ("air", 120.0, "", heavy(0.0), [[0.0, 0.0, 50.0], [100.0, 0.0, 80.0]]),
        ("water", 350.0, "", heavy(1025.0), [[0.0, 0.0, -5.0], [300.0, 40.0, -50.0]]),
        ("U", 300.0, "", heavy(1025.0), [[0.0, 0.0, -5.0], [60.0, 0.0, -10.0]]),
        ("taut", 300.0, "", heavy(1025.0), [[0.0, 0.0, -5.0], [301.0, 0.0, -10.0]]),
        ("buoyant", 250.0, "-BUOY 400 -WTPLEN 900", light, [[0.0, 0.0, -300.0], [200.0, 0.0, -320.0]]),
    ] {
        // H_CAT knows no water: it has the net weight; a line that rises is one that hangs, upside down
        let up = net.signum();
        let turned = |p: [f64; 3]| [p[0], p[1], up * p[2]];
        let class = format!("H_CAT 120 EXACT -LEN {length} -WTPLEN {}", net.abs());
        let [x, y, z] = pull(&model(&line_between(&class, turned(from), turned(to))), "L");
        let weight = if options.is_empty() { format!("-WTPLEN {}", heavy(0.0)) } else { options.to_string() };
        let errors = errors_of_refinement([x, y, up * z], |n| {
            line_between(&format!("ROD 120 60 -LEN {length} -REFINE {n} -EI 0 {weight}"), from, to)
        });
        assert!(errors[3] < 1e-4, "{what}: {errors:?}");
        // a U whose bend is within a few elements converges faster than its mesh, until it is fine enough
        let order = (errors[0] / errors[3]).log2() / 3.0;
        assert!(order > 1.9 && (order < 2.2 || what == "U"), "{what}: {order} {errors:?}");
    }
}

/// A run of the chain of tests/data/moordyn_chain900.csv: its fairlead force (N) at each step.
fn chain(elements: usize, step: f64) -> Vec<f64> {
    let class = format!(
        "~CHAIN ROD 180 90 -LEN 900 -REFINE {elements} -EI 0 -EA 8.54E8 -WTPLEN 199*9.80665 -CD 1.333 0.639 -CA 1 0.5 \
         -AX_DAMPING 1E6 -SEABED 3E6 3E5"
    );
    let records = format!(
        "&ENV DRIVEN -DEPTH 300\nMEDIT\n{class}\n&DESCRIBE BODY RIG\n*F 0 0 -10\nCONNECTOR CHAIN -ANC 180 800 ~CHAIN *F\n\
         PRESCRIBE RIG -SINUSOID X 5 10 -RAMP 20\nEND\n"
    );
    let made = run(&model(&records), settings(120.0, step), vec![]);
    let at = made.history.layout.wrench(0, 0).unwrap();
    made.history.rows().map(|row| row[at].hypot(row[at + 2])).collect()
}

#[test]
fn driven_chain_fairlead_force_matches_moordyn() {
    let (rows, range) = moordyn::reference();
    let made = [(200, 0.05), (400, 0.025), (400, 0.0125)].map(|(n, step)| (step, chain(n, step)));
    let at = |(step, force): &(f64, Vec<f64>), t: f64| force[(t / step).round() as usize] / range;
    for run in &made {
        let errors: Vec<f64> = rows.iter().map(|(t, force)| at(run, *t) - force / range).collect();
        let most = errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
        let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
        // met already by 200 elements; MoorDyn with 100 segments is 0.33 % from MoorDyn with 200
        assert!(most < 0.01 && rms < 0.0015, "{} s: {most} {rms}", run.0);
    }
    // mesh and step are converged: 0.05 % of the range
    let own = rows.iter().map(|(t, _)| (at(&made[1], *t) - at(&made[2], *t)).abs()).fold(0.0, f64::max);
    assert!(own < 5e-4, "{own}");
}

/// Time from passage to passage through a level, upward, on average over all of them (s).
fn period(run: &Run, dof: usize, level: f64) -> f64 {
    let (times, values) = (run.history.times(), run.history.series(run.history.layout.body(0) + dof));
    let passages: Vec<f64> = times
        .windows(2)
        .zip(values.windows(2))
        .filter(|(_, v)| v[0] < level && v[1] >= level)
        .map(|(t, v)| t[0] + (t[1] - t[0]) * (level - v[0]) / (v[1] - v[0]))
        .collect();
    (passages[passages.len() - 1] - passages[0]) / (passages.len() - 1) as f64
}

#[test]
fn heavy_body_on_light_bar_oscillates_with_pendulum_period() {
    // 10 t on 20 m of 20 kg/m that does not bend: inertia of the bar about its end is a third, its weight acts halfway
    let (body, bar, length) = (1e4, 400.0, 20.0);
    let exact = TAU * ((body + bar / 3.0) / (body + bar / 2.0) * length / 9.80665f64).sqrt();
    let records = "MEDIT\n*G 0 0 50\n&DESCRIBE BODY BOB -IGNORE Y RX RY RZ\n*C 0 0 0\n#WEIGHT *C 98066.5 1 1 1\n\
         ~R ROD 200 10 -LEN 20 -REFINE 8 -WTPLEN 20*9.80665 -EA 1E10 -EI 1E9\nCONNECTOR R ~R *C *G\nEND\n\
         &INSTATE -LOCATE BOB 0.2 0 30.001\n";
    let found = period(&run(&model(records), settings(90.0, 0.02), vec![]), 0, 0.0);
    // (w h)^2/12 of the step is 2e-5, the amplitude squared over 16 6e-6, the bar's mass on its nodes 5e-5
    assert!((found / exact - 1.0).abs() < 1.2e-4, "{found} {exact}");
}

#[test]
fn body_on_equally_heavy_bar_has_exact_axial_frequency() {
    // b tan b = m/M = 1: b = 0.860333589; w = b c/L with c = sqrt(EA/m')
    let exact = TAU / (0.860_333_589 * (1e7f64 / 100.0).sqrt() / 100.0);
    let records = "MEDIT\n*G 0 0 150\n&DESCRIBE BODY BOB -IGNORE X Y RX RY RZ\n*C 0 0 0\n#WEIGHT *C 98066.5 1 1 1\n\
         ~R ROD 200 10 -LEN 100 -REFINE 40 -WTPLEN 100*9.80665 -EA 1E7\nCONNECTOR R ~R *C *G\nEND\n&INSTATE -LOCATE BOB 0 0 48\n";
    let made = run(&model(records), RunSettings { method: trapezoidal(), ..settings(60.0, 0.01) }, vec![]);
    let z = made.history.series(made.history.layout.body(0) + 2);
    let found = period(&made, 2, z.iter().sum::<f64>() / z.len() as f64);
    // (w h)^2/12 of the step is 6e-5, (b/n)^2/24 of the mesh 2e-5
    assert!((found / exact - 1.0).abs() < 1e-4, "{found} {exact}");
}

#[test]
fn driven_bar_carries_axial_wave_to_its_fixed_end() {
    // u = a sin kx / sin kL: the forces are EA a k / sin kL at the fixed end, times cos kL at the driven end
    let (ea, mass, length, amplitude): (f64, f64, f64, f64) = (1e7, 100.0, 100.0, 0.01);
    let k = 1.0 / length;
    let time = TAU / (k * (ea / mass).sqrt());
    let records = format!(
        "MEDIT\n&DESCRIBE BODY A\n*A 0 0 150\n&DESCRIBE BODY B\n*B 0 0 49\n\
         ~R ROD 200 10 -LEN {length} -REFINE 40 -WTPLEN {mass}*9.80665 -EA {ea} -EI 0 -AX_DAMPING 1E3\nCONNECTOR R ~R *A *B\n\
         PRESCRIBE A -SINUSOID X 0 10\nPRESCRIBE B -SINUSOID Z {amplitude} {time} -RAMP {}\nEND\n",
        20.0 * time
    );
    let made = run(&model(&records), settings(40.0 * time, time / 200.0), vec![]);
    let swing = |end: usize| {
        let all = made.history.series(made.history.layout.wrench(0, end).unwrap() + 2);
        let late = &all[all.len() - 2000..];
        0.5 * (late.iter().fold(f64::MIN, |m, v| m.max(*v)) - late.iter().fold(f64::MAX, |m, v| m.min(*v)))
    };
    let fixed = ea * amplitude * k / 1f64.sin();
    // 40 elements of kL = 1 are (1/40)^2 = 6e-4 off at most
    assert!((swing(0) / fixed - 1.0).abs() < 6e-4 && (swing(1) / fixed / 1f64.cos() - 1.0).abs() < 6e-4);
}

#[test]
fn line_in_current_leans_by_drag_over_weight() {
    // w sin a = drag cos2 a all along, by which the line is straight: cos2 = 1 - sin2
    let (weight, drag): (f64, f64) = (150.0, 0.5 * 1025.0 * 1.2 * 0.1);
    let share = weight / drag;
    let sine = 0.5 * ((share * share + 4.0).sqrt() - share);
    // from EQUI of a body of next to no weight at its end
    let records = format!(
        "&ENV -DEPTH 1000 -CURRENT 1 180\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*A 0 0 -5\n\
         &DESCRIBE BODY END -IGNORE Y RX RY RZ\n*B 0 0 0\n#WEIGHT *B 0.5 1 1 1\n\
         ~L ROD 100 50 -LEN 200 -REFINE 40 -EI 0 -EA 1E9 -WTPLEN {weight} -BUOY 0 -CD 1.2 0\nCONNECTOR L ~L *A *B\nEND\n\
         &INSTATE -LOCATE END 50 0 -190\n&EQUI\n"
    );
    let table = at_rest(&model(&records));
    let (x, z) = (column(&table, "X"), column(&table, "Z"));
    for (x, z) in x.iter().zip(&z).skip(1) {
        let angle = x.atan2(-5.0 - z);
        // the body's weight straightens the last metre: 0.5 N of 30 000 N
        assert!((angle / sine.asin() - 1.0).abs() < 5e-5, "{x} {z}: {angle} {}", sine.asin());
    }
    let tension = column(&table, "Tension");
    // without drag along it the line carries its weight along itself
    let whole = weight * 200.0 * sine.asin().cos();
    assert!((tension[0] / whole - 1.0).abs() < 1e-4, "{} {whole}", tension[0]);
}

/// A riser of 100 m without weight in water, held at both ends and drawn, in a current of 0.5 m/s.
fn riser(options: &str) -> Table {
    let weight = 1025.0 * 9.80665 * FRAC_PI_4 * 0.09;
    let class = format!("ROD 300 15 -LEN 99.98 -REFINE 80 -WTPLEN {weight} -EA 1E9 -EI 4E7 -CD 1.2 0 {options}");
    let records = line_between(&class, [0.0, 0.0, -10.0], [0.0, 0.0, -110.0]);
    at_rest(&model(&records.replace("-DEPTH 1000", "-DEPTH 1000 -CURRENT 0.5 180")))
}

#[test]
fn tensioned_riser_in_current_matches_tensioned_beam() {
    // the beam under load q and tension T, pinned and clamped; u = L/2 sqrt(T/EI)
    let (q, ei, l): (f64, f64, f64) = (0.5 * 1025.0 * 1.2 * 0.3 * 0.25, 4e7, 100.0);
    for (options, clamped) in [("", false), ("-CLAMP BOTH", true)] {
        let table = riser(options);
        let (x, moment, tension) = (column(&table, "X"), column(&table, "Moment"), column(&table, "Tension"));
        let t = tension[40];
        let u = 0.5 * l * (t / ei).sqrt();
        let parabola = q * l * l / (8.0 * t);
        let (middle, at, bend) = if clamped {
            (parabola + q * l * l / (4.0 * t * u * u.sinh()) * (1.0 - u.cosh()), 0, q * ei / t * (u / u.tanh() - 1.0))
        } else {
            (parabola - q * ei / (t * t) * (1.0 - 1.0 / u.cosh()), 40, q * ei / t * (1.0 - 1.0 / u.cosh()))
        };
        // the slope, 3 %, squared changes drag and length by a thousandth; 80 elements
        assert!((x[40] / middle - 1.0).abs() < 2e-3, "{options}: {} {middle}", x[40]);
        assert!((moment[at] / bend - 1.0).abs() < 5e-3, "{options}: {} {bend}", moment[at]);
    }
}

#[test]
fn pipe_fixed_at_both_ends_has_thermal_and_pressure_wall_force() {
    // steel, 400 mm by 20 mm, upright: Tw = 2 nu (pi Ai - pe Ae) - E A alpha dT where it cannot get longer; Te = Tw - pi Ai + pe Ae
    let (b, a): (f64, f64) = (0.2, 0.18);
    let (outside, inside) = (PI * b * b, PI * a * a);
    for (z, warmer, pressure, filled) in
        [(50.0, -40.0, 0.0, 0.0), (50.0, 0.0, 20.0, 0.0), (50.0, 15.0, 30.0, 0.0), (-500.0, -40.0, 10.0, 800.0)]
    {
        let class = "ROD 400 20 -LEN 20 -REFINE 20 -WTPLEN 1 -BUOY 0 -EMOD 210000 -POI 0.3 -ALPHA 1.2E-5";
        let records = line_between(class, [0.0, 0.0, z + 10.0], [0.0, 0.0, z - 10.0]);
        let hot = format!(
            "T_PRESSURE HOT {warmer} {pressure} -AT {z} -DENSITY {filled}\nEND\n&ENV -DEPTH 1000 -T_PRESSURE HOT\n"
        );
        let table = at_rest(&model(&records.replace("END\n", &hot)));
        let middle = |name: &str| column(&table, name)[10];
        let (pi, pe) = (1e6 * pressure, 1025.0 * 9.80665 * f64::max(-z, 0.0));
        let wall = 0.6 * (pi * inside - pe * outside) - 2.1e11 * (outside - inside) * 1.2e-5 * warmer;
        let hoop = (pi * (a * a + b * b) - 2.0 * pe * b * b) / (b * b - a * a);
        // weight of the middle element, 1 N/m and 800 kg/m3, against 1 MN
        let close = |name: &str, want: f64| {
            let share = (middle(name) - want).abs() / wall.abs().max(want.abs());
            assert!(share < 1e-8, "{z} {warmer} {pressure}: {name} {} {want}", middle(name));
        };
        close("Wall", wall);
        close("Tension", wall - pi * inside + pe * outside);
        close("Hoop", hoop);
        close("Axial", wall / (outside - inside));
    }
}
