//! Rods as a user has them, by records through the program, against closed forms, the exact catenary and MoorDyn.

#![allow(clippy::unwrap_used)]

#[allow(dead_code)]
mod common;
#[allow(dead_code)]
#[path = "common/run.rs"]
mod runs;

use runs::{model, run, settings, trapezoidal};
use std::f64::consts::{FRAC_PI_4, PI, TAU};
use windlass::model::Model;
use windlass::solve::System;
use windlass::solve::results::along::lines_at_rest;
use windlass::solve::time::{Run, Settings};
use windlass::table::Table;

/// Force of a connector on the first body it is fixed to, at rest where its ends stand (N).
fn pull(model: &Model, name: &str) -> [f64; 3] {
    let system = System::of(model, &[]).unwrap();
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

/// How far the force of a rod of 20, 40, 80 and 160 elements is from that of another class. `records` have CLASS and ROD where the
/// class types stand.
fn refined(exact: &str, rod: impl Fn(usize) -> String) -> Vec<f64> {
    let want = pull(&model(exact), "L");
    [20, 40, 80, 160].map(|n| apart(pull(&model(&rod(n)), "L"), want)).to_vec()
}

/// A line from a body at (0, 0, -5) to an anchor `reach` away in 100 m of water.
fn moored(class: &str, reach: f64) -> String {
    format!(
        "&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 0 0 -5\n~L {class} -DEPANCHOR 100\nCONNECTOR L -ANC 0 {reach} ~L *F\nEND\n"
    )
}

/// A line between two bodies.
fn between(class: &str, from: &str, to: &str) -> String {
    format!(
        "&ENV -DEPTH 1000\nMEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*A {from}\n&DESCRIBE BODY B -IGNORE X Y Z RX RY RZ\n*B {to}\n\
         ~L {class}\nCONNECTOR L ~L *A *B\nEND\n"
    )
}

#[test]
fn the_force_of_a_grounded_rod_goes_to_that_of_the_exact_catenary() {
    for (length, reach) in [(800.0, 785.0), (600.0, 560.0), (200.0, 170.0)] {
        let errors = refined(&moored(&format!("B_CAT 120 EXACT -LEN {length}"), reach), |n| {
            moored(&format!("ROD 120 60 -LEN {length} -REFINE {n} -EI 0 -SEABED 1E7"), reach)
        });
        println!("grounded {length} {reach}: {errors:?}");
    }
}

#[test]
fn the_force_of_a_hanging_rod_goes_to_that_of_the_exact_catenary_with_the_second_order() {
    for (what, section, length, from, to) in [
        ("in air", "-BUOY 0", 120.0, "0 0 50", "100 0 80"),
        ("under water", "", 350.0, "0 0 -5", "300 40 -50"),
        ("buoyant", "-BUOY 400", 250.0, "0 0 -300", "200 0 -320"),
        ("U", "", 300.0, "0 0 -5", "20 0 -10"),
        ("taut", "", 300.0, "0 0 -5", "302 0 -10"),
    ] {
        let errors = refined(&between(&format!("H_CAT 120 EXACT -LEN {length} {section}"), from, to), |n| {
            between(&format!("ROD 120 60 -LEN {length} -REFINE {n} -EI 0 {section}"), from, to)
        });
        println!("{what}: {errors:?}");
    }
}

#[test]
fn a_rope_hanging_straight_down_has_its_weight_and_its_stretch() {
    let class = "ROD 120 60 -LEN 300 -REFINE 40 -EI 0 -EA 5E6 -WTPLEN 500 -BUOY 0";
    let table = at_rest(&model(&between(class, "0 0 -5", "0 0 -305")));
    println!("{:?}", column(&table, "Tension"));
}

/// Fairlead force of the chain of shared/validation/moordyn_chain900 (N) at each step.
fn chain(elements: usize, step: f64) -> Run {
    let class = format!(
        "~CHAIN ROD 180 90 -LEN 900 -REFINE {elements} -EI 0 -EA 8.54E8 -WTPLEN 199*9.80665 -CD 1.333 0.639 -CA 1 0.5 -AX_DAMPING 1E6 -SEABED 3E6 3E5"
    );
    let records = format!(
        "&ENV DRIVEN -DEPTH 300\nMEDIT\n{class}\n&DESCRIBE BODY RIG\n*F 0 0 -10\nCONNECTOR CHAIN -ANC 180 800 ~CHAIN *F\n\
         PRESCRIBE RIG -SINUSOID X 5 10 -RAMP 20\nEND\n"
    );
    run(&model(&records), settings(120.0, step), vec![])
}

#[test]
fn the_fairlead_force_of_a_driven_chain_is_that_of_moordyn_in_both_its_parts() {
    let text = std::fs::read_to_string("tests/data/moordyn_chain900.csv").unwrap();
    let rows: Vec<Vec<f64>> =
        text.lines().skip(2).map(|line| line.split(',').map(|c| c.parse().unwrap()).collect()).collect();
    for (n, step) in [(100, 0.1), (200, 0.1), (200, 0.05), (400, 0.025), (400, 0.0125)] {
        let made = chain(n, step);
        let at = made.history.layout.wrench(0, 0).unwrap();
        let parts = [made.history.series(at), made.history.series(at + 2)];
        let whole: Vec<f64> = parts[0].iter().zip(&parts[1]).map(|(x, z)| x.hypot(*z)).collect();
        for (name, mine, theirs) in [("fx", &parts[0], 1), ("fz", &parts[1], 2), ("f", &whole, 0)] {
            let want = |row: &Vec<f64>| if theirs == 0 { row[1].hypot(row[2]) } else { row[theirs] };
            let high = rows.iter().map(want).fold(f64::NEG_INFINITY, f64::max);
            let low = rows.iter().map(want).fold(f64::INFINITY, f64::min);
            let errors: Vec<f64> =
                rows.iter().map(|r| (mine[(r[0] / step).round() as usize] - want(r)) / (high - low)).collect();
            let most = errors.iter().fold(0.0, |m: f64, e| m.max(e.abs()));
            let rms = (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt();
            println!("{n} {step} {name}: {most} {rms} range {}", high - low);
        }
    }
}

/// Time between passages through a level, upward, on average over all of them.
fn period(times: &[f64], values: &[f64], level: f64) -> f64 {
    let crossings: Vec<f64> = times
        .windows(2)
        .zip(values.windows(2))
        .filter(|(_, v)| v[0] < level && v[1] >= level)
        .map(|(t, v)| t[0] + (t[1] - t[0]) * (level - v[0]) / (v[1] - v[0]))
        .collect();
    (crossings[crossings.len() - 1] - crossings[0]) / (crossings.len() - 1) as f64
}

#[test]
fn a_heavy_body_on_a_light_bar_swings_with_the_period_of_a_pendulum() {
    // 10 t on 20 m of 20 kg/m, EI too stiff to bend
    let records = |elements: usize| {
        format!(
            "MEDIT\n*G 0 0 50\n&DESCRIBE BODY BOB -IGNORE Y RX RY RZ\n*C 0 0 0\n#WEIGHT *C 98066.5 1 1 1\n\
             ~R ROD 200 10 -LEN 20 -REFINE {elements} -WTPLEN 20*9.80665 -EA 1E10 -EI 1E9\nCONNECTOR R ~R *C *G\nEND\n&INSTATE -LOCATE BOB 0.2 0 30.001\n"
        )
    };
    let exact = TAU * ((1e4 + 400.0 / 3.0) / (1e4 + 400.0 / 2.0) * 20.0 / 9.80665f64).sqrt();
    for (n, method, step) in [(4, None, 0.05), (8, None, 0.02), (8, Some(trapezoidal()), 0.02)] {
        let mut set = settings(90.0, step);
        if let Some(m) = method {
            set = Settings { method: m, ..set };
        }
        let made = run(&model(&records(n)), set, vec![]);
        let x = made.history.series(made.history.layout.body(0));
        let found = period(&made.history.times(), &x, 0.0);
        let (first, last) = (x[0], x[x.len() - 400..].iter().fold(0.0, |m: f64, v| m.max(*v)));
        println!("pendulum {n} {step}: {found} {exact} {} {first} {last}", found / exact - 1.0);
    }
}

#[test]
fn a_body_on_a_bar_of_its_own_weight_swings_up_and_down_with_the_exact_frequency() {
    // b tan b = m/M = 1: b = 0.860333589; w = b c/L, c = sqrt(EA/m')
    let records = |elements: usize| {
        format!(
            "MEDIT\n*G 0 0 150\n&DESCRIBE BODY BOB -IGNORE X Y RX RY RZ\n*C 0 0 0\n#WEIGHT *C 98066.5 1 1 1\n\
             ~R ROD 200 10 -LEN 100 -REFINE {elements} -WTPLEN 100*9.80665 -EA 1E7\nCONNECTOR R ~R *C *G\nEND\n&INSTATE -LOCATE BOB 0 0 48\n"
        )
    };
    let exact = TAU / (0.860_333_589 * (1e7f64 / 100.0).sqrt() / 100.0);
    for (n, step) in [(10, 0.02), (20, 0.02), (40, 0.01)] {
        let set = Settings { method: trapezoidal(), ..settings(60.0, step) };
        let made = run(&model(&records(n)), set, vec![]);
        let z = made.history.series(made.history.layout.body(0) + 2);
        let mean = z.iter().sum::<f64>() / z.len() as f64;
        let found = period(&made.history.times(), &z, mean);
        println!("axial {n} {step}: {found} {exact} {}", found / exact - 1.0);
    }
}

#[test]
fn a_driven_bar_carries_the_axial_wave_to_its_fixed_end() {
    // u = a sin kx / sin kL: the forces are EA a k / sin kL at the fixed end, times cos kL at the driven end
    let (ea, mass, length, amplitude) = (1e7, 100.0, 100.0, 0.01);
    let k = 1.0 / length;
    let period = TAU / (k * (ea / mass as f64).sqrt());
    let records = |elements: usize| {
        format!(
            "MEDIT\n&DESCRIBE BODY A\n*A 0 0 150\n&DESCRIBE BODY B\n*B 0 0 49\n\
             ~R ROD 200 10 -LEN {length} -REFINE {elements} -WTPLEN {mass}*9.80665 -EA {ea} -EI 0 -AX_DAMPING 1E3\nCONNECTOR R ~R *A *B\n\
             PRESCRIBE A -SINUSOID X 0 10\nPRESCRIBE B -SINUSOID Z {amplitude} {period} -RAMP {}\nEND\n",
            20.0 * period
        )
    };
    for n in [10, 20, 40] {
        let step = period / 200.0;
        let made = run(&model(&records(n)), settings(40.0 * period, step), vec![]);
        let swing = |end: usize| {
            let at = made.history.layout.wrench(0, end).unwrap() + 2;
            let all = made.history.series(at);
            let late = &all[all.len() - 2000..];
            0.5 * (late.iter().fold(f64::MIN, |m, v| m.max(*v)) - late.iter().fold(f64::MAX, |m, v| m.min(*v)))
        };
        let fixed = ea * amplitude * k / 1f64.sin();
        println!("wave {n}: {} {}", swing(0) / fixed - 1.0, swing(1) / (fixed * 1f64.cos()) - 1.0);
    }
}

/// Angle from straight down of a line in a current: what its drag across does to its weight.
fn hanging_angle(weight: f64, drag: f64) -> f64 {
    let (mut low, mut high) = (0.0f64, PI / 2.0);
    for _ in 0..80 {
        let a = 0.5 * (low + high);
        if weight * a.sin() < drag * a.cos().powi(2) { low = a } else { high = a }
    }
    low
}

#[test]
fn a_line_that_hangs_in_a_current_leans_by_its_drag_against_its_weight() {
    let (speed, diameter, weight) = (1.0, 0.1, 150.0);
    let angle = hanging_angle(weight, 0.5 * 1025.0 * 1.2 * diameter * speed * speed);
    let records = format!(
        "&ENV -DEPTH 1000 -CURRENT {speed} 180\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*A 0 0 -5\n&DESCRIBE BODY END -IGNORE Y RX RY RZ\n*B 0 0 0\n#WEIGHT *B 0.5 1 1 1\n\
         ~L ROD 100 50 -LEN 200 -REFINE 40 -EI 0 -EA 1E9 -WTPLEN {weight} -BUOY 0 -CD 1.2 0\nCONNECTOR L ~L *A *B\nEND\n&INSTATE -LOCATE END 50 0 -190\n&EQUI\n"
    );
    let made = model(&records);
    let table = at_rest(&made);
    let (x, z) = (column(&table, "X"), column(&table, "Z"));
    println!("{:?} {:?}", x, z);
    println!("lean {angle} {:?}", x.iter().zip(&z).skip(1).map(|(x, z)| x.atan2(-5.0 - z)).collect::<Vec<_>>());
}

/// A riser without weight in water between the bottom and a body that is free to rise and pulls up by a force.
fn riser(options: &str, elements: usize) -> Table {
    let records = format!(
        "&ENV -DEPTH 150 -CURRENT 0.5 180\nMEDIT\n*G 0 0 -110\n&DESCRIBE BODY TOP -IGNORE X Y RX RY RZ\n*T 0 0 0\n#WEIGHT *T 1 1 1 1\n\
         ~R ROD 300 15 -LEN 100 -REFINE {elements} -WTPLEN 1025*9.80665*{FRAC_PI_4}*0.09 -EA 1E10 -EI 4E7 -CD 1.2 0 {options}\nCONNECTOR R ~R *T *G\n\
         &INSTATE -LOCATE TOP 0 0 -10\n&APPLY -FORCE TOP 0 0 200001\nEND\n&EQUI\n"
    );
    at_rest(&model(&records))
}

#[test]
fn a_tensioned_riser_bends_in_a_current_as_the_tensioned_beam() {
    let q = 0.5 * 1025.0 * 1.2 * 0.3 * 0.25;
    let (t, ei, l) = (2e5, 4e7, 100.0);
    let k: f64 = (t / ei as f64).sqrt();
    let u = 0.5 * k * l;
    for n in [20, 40, 80] {
        let pinned = riser("", n);
        let y = q * l * l / (8.0 * t) - q / (t * k * k) * (1.0 - 1.0 / u.cosh());
        let m = q * ei / t * (1.0 - 1.0 / u.cosh());
        let (x, moment) = (column(&pinned, "X"), column(&pinned, "Moment"));
        println!(
            "pinned {n} {} {}   {y} {m} {}",
            x[n / 2] / y - 1.0,
            moment[n / 2] / m - 1.0,
            column(&pinned, "Tension")[0]
        );
        let clamped = riser("-CLAMP BOTH", n);
        let a = q * l / (2.0 * t * k * u.sinh());
        let y = q * l * l / (8.0 * t) + a * (1.0 - u.cosh());
        let m = q * ei / t * (u / u.tanh() - 1.0);
        let (x, moment) = (column(&clamped, "X"), column(&clamped, "Moment"));
        println!("clamped {n} {} {} {}   {y} {m}", x[n / 2] / y - 1.0, moment[0] / m - 1.0, moment[n] / m - 1.0);
    }
}

#[test]
fn a_pipe_held_at_both_ends_has_the_wall_force_of_its_heat_and_pressures() {
    // steel, 400 mm by 20 mm, straight up: Tw = 2 nu (pi Ai - pe Ae) - E A alpha dT where it cannot get longer
    let pipe = |from: &str, to: &str, hot: &str| {
        let class = "ROD 400 20 -LEN 20 -REFINE 20 -WTPLEN 1 -BUOY 0 -EMOD 210000 -POI 0.3 -ALPHA 1.2E-5";
        let records = between(class, from, to)
            .replace("END\n", &format!("T_PRESSURE HOT {hot}\nEND\n&ENV -DEPTH 1000 -T_PRESSURE HOT\n"));
        at_rest(&model(&records))
    };
    for (from, to, hot) in [
        ("0 0 60", "0 0 40", "-40 0"),
        ("0 0 60", "0 0 40", "0 20"),
        ("0 0 60", "0 0 40", "15 30"),
        ("0 0 -490", "0 0 -510", "-40 10 -AT -500"),
        ("0 0 -490", "0 0 -510", "-40 10 -AT -500 -SPG 0.8"),
    ] {
        let table = pipe(from, to, hot);
        let middle = 10;
        let get = |name: &str| column(&table, name)[middle];
        println!(
            "{from} {hot}: T {} W {} axial {} hoop {} vm {}",
            get("Tension"),
            get("Wall"),
            get("Axial"),
            get("Hoop"),
            get("Von Mises")
        );
    }
}
