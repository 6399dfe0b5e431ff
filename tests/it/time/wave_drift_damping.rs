//! Wave drift damping and mean drift in a current: against the exact drift of a hemisphere and its slopes, closed forms of a decay, of a sea of one
//! height of spectrum, and of the offset of a spring.

use crate::common::body_load::begin_step;
use crate::common::{self, assert_share, run as runs};
use std::f64::consts::{PI, TAU};
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_base::span::Span;
use windlass_hydro::sea::Sea;
use windlass_hydro::{BodyStep, Category, Floating};
use windlass_model::{AttachedDatabase, Database, DriftMethod, DriftTable, Model, Qtf};
use windlass_solve::drift_damping::body_drift_dampings;

const G: f64 = 9.80665;
const DENSITY: f64 = 1025.0;
/// Radius of the hemisphere (m).
const RADIUS: f64 = 10.0;

/// K, and the drift of the held hemisphere over rho g a: exact series.
fn exact_drift() -> Vec<[f64; 2]> {
    let text = std::fs::read_to_string("crates/diffraction/tests/data/hemisphere.csv").unwrap();
    text.lines()
        .skip(2)
        .map(|line| {
            let row: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
            [row[0], row[9]]
        })
        .collect()
}

fn frequency(k: f64) -> f64 {
    (k * G / RADIUS).sqrt()
}

/// A table of drift along the waves, at 24 headings: straight between them it is within 0.9 %.
fn along_waves(rows: impl Iterator<Item = (f64, f64)>) -> DriftTable {
    let rows: Vec<(f64, f64)> = rows.collect();
    let headings: Vec<f64> = (0..24).map(|n| f64::from(n) * PI / 12.0).collect();
    let row = |h: &f64| rows.iter().map(|(_, d)| [d * h.cos(), d * h.sin(), 0.0, 0.0, 0.0, 0.0]).collect();
    DriftTable {
        values: headings.iter().map(row).collect(),
        frequencies: rows.iter().map(|r| r.0).collect(),
        headings,
        method: None,
    }
}

/// The exact drift of the hemisphere but for some rows.
fn hemisphere_without(left_out: &[f64]) -> DriftTable {
    let rows = exact_drift().into_iter().filter(|row| !left_out.contains(&row[0]));
    along_waves(rows.map(|[k, drift]| (frequency(k), DENSITY * G * RADIUS * drift)))
}

/// Damping along and across waves of the hemisphere at a K (N s/m3), by differences of five rows of the series a step apart.
fn exact_damping(k: f64, step: f64) -> [f64; 2] {
    let rows = exact_drift();
    let at = |i: i32| rows.iter().find(|row| (row[0] - (k + f64::from(i) * step)).abs() < 1e-9).unwrap()[1];
    let slope = (at(-2) - 8.0 * at(-1) + 8.0 * at(1) - at(2)) / (12.0 * step);
    [4.0 * at(0) + 2.0 * k * slope, 2.0 * at(0)].map(|b| b * frequency(k) * DENSITY * RADIUS)
}

/// Gives body B a database of mean drift alone.
fn attach(model: &mut Model, drift: DriftTable) {
    let data =
        Database { source: "series".into(), drift: Some(drift), density: DENSITY, gravity: G, ..Database::default() };
    model.bodies.get_mut("B").unwrap().database = Some(AttachedDatabase {
        data: Arc::new(data),
        at: [0.0; 3],
        memory: None,
        drift: DriftMethod::Newman,
        drift_damping: None,
        hydrostatics: false,
        span: Span::default(),
    });
}

/// A body of a mass (kg) on a spring (N/m) along x, in an environment.
fn on_spring(mass: f64, stiffness: f64, environment: &str) -> Model {
    let weight = mass * G;
    runs::model(&format!(
        "&DEFAULT -G {G}\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY B -IGNORE Y Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P {weight} 1 1 1\n\
         ~S GSPR BOTH X {stiffness} 1E12 -LEN 0\nCONNECTOR K ~S *P *G\nEND\n{environment}"
    ))
}

fn regular(k: f64, height: f64, from: f64) -> String {
    format!("&ENV -SEA REGULAR {from} {height} {}", TAU / frequency(k))
}

#[test]
fn damping_of_exact_hemisphere_drift_meets_slopes_of_series() {
    // the row itself is left out of the table: value and slope come from its neighbours. 1.5 % of the damping along the waves, as of the solver
    for (k, step) in [(0.5, 0.1), (0.8, 0.1), (1.6, 0.2)] {
        let [along, across] = exact_damping(k, step);
        for toward in [0.0_f64, 45.0, 90.0, 195.0] {
            let mut model = on_spring(1e6, 1e3, &regular(k, 2.0, toward + 180.0));
            attach(&mut model, hemisphere_without(&[k]));
            let list = body_drift_dampings(&model).unwrap();
            let found = list[0].damping;
            let (sine, cosine) = toward.to_radians().sin_cos();
            let shear = (along - across) * sine * cosine;
            let exact = [
                [along * cosine * cosine + across * sine * sine, shear],
                [shear, along * sine * sine + across * cosine * cosine],
            ];
            for (i, row) in exact.iter().enumerate() {
                for (j, exact) in row.iter().enumerate() {
                    let made = found[(i, j)];
                    assert!((made - exact).abs() < 0.015 * along, "K {k} {toward}: {i} {j} {made} for {exact}");
                }
            }
            assert!(list[0].warnings.is_empty(), "{:?}", list[0].warnings);
        }
    }
}

#[test]
fn surge_decays_by_exact_damping_of_hemisphere() {
    // K = 0.8, amplitude 0.4 m, damping b; about the offset of the mean drift x falls by exp(-2 pi z/sqrt(1 - z2)) a cycle, z = b/(2 sqrt(k m))
    let (k, amplitude, mass) = (0.8, 0.4, 2.0 / 3.0 * PI * RADIUS.powi(3) * DENSITY);
    let [along, _] = exact_damping(k, 0.1);
    let natural: f64 = TAU / 200.0;
    let stiffness = mass * natural * natural;
    let ratio = along * amplitude * amplitude / (2.0 * mass * natural);
    assert!(ratio > 0.01 && ratio < 0.1, "{ratio}");
    let mut model = on_spring(mass, stiffness, &regular(k, 2.0 * amplitude, 180.0));
    attach(&mut model, hemisphere_without(&[]));
    let start = 20.0;
    model.bodies.get_mut("B").unwrap().position.shift[0] = start;
    let made = runs::run(&model, runs::settings(2000.0, 0.5), vec![]);
    let at = made.history.layout.body(0);
    let drift = exact_drift().iter().find(|row| row[0] == k).unwrap()[1] * DENSITY * G * RADIUS * amplitude * amplitude;
    let offset = drift / stiffness;
    // the regular wave has no ramp, and the body begins at rest: x = offset + (start - offset) exp(-z w t) (cos wd t + z/sqrt(1 - z2) sin wd t)
    let damped = natural * (1.0 - ratio * ratio).sqrt();
    let exact = |t: f64| {
        let swing = (damped * t).cos() + ratio / (1.0 - ratio * ratio).sqrt() * (damped * t).sin();
        offset + (start - offset) * (-ratio * natural * t).exp() * swing
    };
    let largest = made.history.rows().map(|row| (row[at] - exact(row[0])).abs()).fold(0.0, f64::max);
    // the slope of the series by differences in K and by those in the frequency: 0.1 % of the damping; the scheme: 0.5 s in 200 s
    assert!(largest < 0.005 * (start - offset).abs(), "{largest}");
    // ten cycles later: the logarithmic decrement itself, 1 %
    let amplitude_at = |cycle: f64| {
        let time = cycle * TAU / damped;
        let row = made.history.rows().min_by(|a, b| (a[0] - time).abs().total_cmp(&(b[0] - time).abs())).unwrap();
        row[at] - offset
    };
    let decrement = (amplitude_at(0.0) / amplitude_at(9.0)).ln() / 9.0;
    assert_share(decrement, TAU * ratio / (1.0 - ratio * ratio).sqrt(), 0.01);
}

/// A drift of `slope` w, of which Aranha's formula makes the damping 5 slope w2/g along the waves.
fn straight(slope: f64) -> DriftTable {
    along_waves((1..=40).map(|n| 0.05 * f64::from(n)).map(|w| (w, slope * w)))
}

const BOX: &str = "&DATA CURVES\nF_SPECTRUM BOX 0.5 1 0.6 1\nEND";

#[test]
fn damping_in_sea_of_one_height_of_spectrum_has_closed_form() {
    // S = m0/0.1 from 0.5 to 0.6 rad/s: 2 int S B dw = 10 slope/g m0/0.1 (0.6^3 - 0.5^3)/3
    let (slope, height, mass, stiffness) = (4e4, 3.0_f64, 1e7, 1e4_f64);
    let m0 = height * height / 16.0;
    let exact = 10.0 * slope / G * m0 / 0.1 * (0.6_f64.powi(3) - 0.5_f64.powi(3)) / 3.0;
    let environment = format!("{BOX}\n&ENV -SEA BOX 180 {height} {}", TAU / 0.5);
    let mut model = on_spring(mass, stiffness, &environment);
    attach(&mut model, straight(slope));
    let statics = body_drift_dampings(&model).unwrap()[0].damping[(0, 0)];
    assert_share(statics, exact, 2e-3);
    // and the load of the sea under way has it on a velocity
    let sea = Arc::new(Sea::new(&model, &model.environment).unwrap().unwrap());
    let floating = Floating::under_way(&model, &model.bodies["B"], Some(&sea)).unwrap();
    let load = floating.loads.iter().find(|load| load.category() == Category::WaveDrift).unwrap();
    let (pose, velocity) = (Pose::default(), Six::new(0.7, 0.0, 0.0, 0.0, 0.0, 0.0));
    let at = BodyStep { time: 100.0, dt: 0.1, pose: &pose, velocity: &velocity };
    let state = begin_step(load.as_ref(), &at);
    let moving = load.dynamic_load(&at, &state).unwrap();
    let still = load.dynamic_load(&BodyStep { velocity: &Six::zeros(), ..at }, &state).unwrap();
    assert_share((still.load.wrench - moving.load.wrench)[0] / 0.7, exact, 2e-3);
    assert_share(moving.damping[(0, 0)], exact, 2e-3);
    // the mode has it in its ratio
    let linear = windlass_solve::frequency::LinearSystem::new(&model).unwrap();
    let modes = windlass_solve::frequency::natural(&linear).unwrap();
    assert_share(modes[0].damping.unwrap(), exact / (2.0 * (stiffness * mass).sqrt()), 2e-3);
}

#[test]
fn current_along_regular_wave_adds_to_drift_at_rest_and_under_way() {
    // D = slope w: at a speed U along the waves (1 + 5 w U/g) D, across them 2 D w U/g aside
    let (slope, w, amplitude, speed) = (4e4, 0.55, 1.5_f64, 0.8);
    let still = slope * w * amplitude * amplitude;
    let (along, aside) = (5.0 * w * speed / G * still, 2.0 * w * speed / G * still);
    for (from, force) in [(180.0, [still + along, 0.0]), (0.0, [still - along, 0.0]), (270.0, [still, aside])] {
        let environment = format!("&ENV -SEA REGULAR 180 {} {} -CURRENT {speed} {from}", 2.0 * amplitude, TAU / w);
        let mut model = on_spring(1e7, 1e4, &environment);
        for yaw in [0.0, 30.0] {
            model.bodies.get_mut("B").unwrap().position.turn[2] = f64::to_radians(yaw);
            attach(&mut model, straight(slope));
            let pose = Pose::from_place(&model.bodies["B"].position);
            let rest = Floating::at_rest(&model, &model.bodies["B"]).unwrap();
            let sea = Arc::new(Sea::new(&model, &model.environment).unwrap().unwrap());
            let under_way = Floating::under_way(&model, &model.bodies["B"], Some(&sea)).unwrap();
            let mean = rest
                .loads
                .iter()
                .find(|load| load.category() == Category::WaveDrift)
                .unwrap()
                .mean_load(&pose)
                .unwrap()
                .wrench;
            let load = under_way.loads.iter().find(|load| load.category() == Category::WaveDrift).unwrap();
            let at = BodyStep { time: 200.0, dt: 0.1, pose: &pose, velocity: &Six::zeros() };
            let state = begin_step(load.as_ref(), &at);
            let slow = load.dynamic_load(&at, &state).unwrap().load.wrench;
            for found in [mean, slow] {
                for (found, exact) in found.iter().zip(force) {
                    assert!((found - exact).abs() < 1e-3 * (still + along), "{from} {yaw}: {found} for {exact}");
                }
            }
            // a body that goes with the current has the drift of still water
            let toward = f64::to_radians(from + 180.0);
            let drifting = Six::new(speed * toward.cos(), speed * toward.sin(), 0.0, 0.0, 0.0, 0.0);
            let with = load.dynamic_load(&BodyStep { velocity: &drifting, ..at }, &state).unwrap().load.wrench;
            assert!((with[0] - still).abs() < 1e-3 * still && with[1].abs() < 1e-3 * still, "{from} {yaw}: {with}");
        }
    }
}

#[test]
fn current_of_a_history_adds_to_drift_by_its_factor() {
    // the current falls from its whole to minus its half over 100 s: a quarter of it at 50 s
    let (slope, w, amplitude, speed) = (4e4, 0.55, 1.5_f64, 0.8);
    let still = slope * w * amplitude * amplitude;
    let environment = format!(
        "&DATA CURVES C_HISTORY F 0 1 100 -0.5\n&ENV -SEA REGULAR 180 {} {} -CURRENT {speed} 180 -C_HISTORY F",
        2.0 * amplitude,
        TAU / w
    );
    let mut model = on_spring(1e7, 1e4, &environment);
    attach(&mut model, straight(slope));
    let sea = Arc::new(Sea::new(&model, &model.environment).unwrap().unwrap());
    let floating = Floating::under_way(&model, &model.bodies["B"], Some(&sea)).unwrap();
    let load = floating.loads.iter().find(|load| load.category() == Category::WaveDrift).unwrap();
    let pose = Pose::default();
    for (time, factor) in [(0.0, 1.0), (50.0, 0.25), (100.0, -0.5)] {
        let at = BodyStep { time, dt: 0.1, pose: &pose, velocity: &Six::zeros() };
        let found = load.dynamic_load(&at, &begin_step(load.as_ref(), &at)).unwrap().load.wrench[0];
        assert_share(found, still * (1.0 + 5.0 * w * speed * factor / G), 1e-3);
    }
}

#[test]
fn current_adds_its_mean_to_drift_of_full_qtf() {
    // the diagonal is D = slope w; one wave of it with itself
    let (slope, w, amplitude, speed) = (4e4, 0.55, 1.5_f64, 0.8);
    let still = slope * w * amplitude * amplitude;
    let environment = format!("&ENV -SEA REGULAR 180 {} {} -CURRENT {speed} 180", 2.0 * amplitude, TAU / w);
    let mut model = on_spring(1e7, 1e4, &environment);
    let table = straight(slope);
    attach(&mut model, table.clone());
    let values = table.values.iter().map(|row| {
        let pair = |a: &[f64; 6], b: &[f64; 6]| std::array::from_fn(|k| nalgebra::Complex::from(0.5 * (a[k] + b[k])));
        row.iter().map(|a| row.iter().map(|b| pair(a, b)).collect()).collect()
    });
    let qtf =
        Qtf { frequencies: table.frequencies.clone(), headings: table.headings.clone(), values: values.collect() };
    let attached = model.bodies["B"].database.as_mut().unwrap();
    attached.data = Arc::new(Database { qtf: Some(qtf), drift: None, ..attached.data.as_ref().clone() });
    attached.drift = DriftMethod::Full;
    let sea = Arc::new(Sea::new(&model, &model.environment).unwrap().unwrap());
    let floating = Floating::under_way(&model, &model.bodies["B"], Some(&sea)).unwrap();
    let load = floating.loads.iter().find(|load| load.category() == Category::WaveDrift).unwrap();
    let pose = Pose::default();
    let at = BodyStep { time: 200.0, dt: 0.1, pose: &pose, velocity: &Six::zeros() };
    let found = load.dynamic_load(&at, &begin_step(load.as_ref(), &at)).unwrap().load.wrench[0];
    assert_share(found, still * (1.0 + 5.0 * w * speed / G), 1e-3);
}

/// A tanker by its files in a sea, with options of its database and of a piece of it: what TDOM prints, and all said.
fn tanker(database: &str, piece: &str, sea: &str) -> String {
    let of_box = format!("-SEA BOX 180 2 {}", TAU / 0.5);
    let sea = if sea.is_empty() { &of_box } else { sea };
    let (text, list) = common::run_script(&format!(
        "&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -G {G}\n&ENV -DEPTH 500\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY TANKER -IGNORE Y Z RX RY RZ\n*CG 0 0 0\n\
         #WEIGHT *CG 1600000 15 65 65\n#AMASS *CG 80000\n#DAMP *CG 1300\n{piece}DATABASE TANKER -WAMIT {}/tests/data/tanker/tanker {database}\n\
         ~S GSPR BOTH X 1000 1E9 -LEN 0\nCONNECTOR K ~S *CG *G\nEND\n{BOX}\n\
         &ENV {sea} -RAMP 10 -TIME 20 0.5\nTDOM\n",
        env!("CARGO_MANIFEST_DIR")
    ));
    format!("{text}\n{}", list.join("\n"))
}

/// The damping in surge of the table that TDOM prints (kN s/m).
fn printed(text: &str) -> f64 {
    let from = text.find("W A V E   D R I F T   D A M P I N G").unwrap_or_else(|| panic!("{text}"));
    let line = text[from..].lines().find(|line| line.trim_start().starts_with("TANKER")).unwrap();
    line.split_whitespace().nth(1).unwrap().parse().unwrap()
}

#[test]
fn factor_of_piece_multiplies_wave_drift_damping_and_nothing_turns_it_off() {
    let whole = printed(&tanker("", "", ""));
    let piece = "&SURFACE\nBLOCK FIN -1 -1 -8 1 1 -5 -PERM 0";
    // three digits are printed
    assert_share(printed(&tanker("", &format!("{piece} -DD_MULT 2.5\nEND_&SURFACE\n"), "")), 2.5 * whole, 0.01);
    assert_share(
        printed(&tanker("-DD_MULT 0.5", &format!("{piece} -DD_MULT 2.5\nEND_&SURFACE\n"), "")),
        0.5 * whole,
        0.01,
    );
    let off = tanker("-DD_MULT 0", "", "");
    assert!(printed(&off) == 0.0 && off.contains("the wave drift damping of TANKER is left out"), "{off}");
    let two =
        tanker("", &format!("{piece} -DD_MULT 2\nBLOCK FIN2 -1 -1 -12 1 1 -9 -PERM 0 -DD_MULT 3\nEND_&SURFACE\n"), "");
    assert!(two.contains("two factors of its wave drift damping: -DD_MULT 2 of piece FIN, 3 of FIN2"), "{two}");
    let ratios = tanker("", &format!("{piece} -DD_MULT 2 1 4 2\nEND_&SURFACE\n"), "");
    assert!(ratios.contains("-DD_MULT 2 1 4 2 of piece FIN (factors by ratio"), "{ratios}");
    let negative = tanker("-DD_MULT -1", "", "");
    assert!(negative.contains("-DD_MULT") && negative.contains("-1"), "{negative}");
}

#[test]
fn waves_of_shallow_water_are_named_with_their_share_of_energy() {
    // deep from k h = pi on, half a wave length: 2 pi/T with w2 h/g = pi tanh(pi). In 100 m that is 11.33 s: waves of 12 s and 2 m have four
    // fifths of the energy, those of 9 s and 1 m the rest
    let edge = TAU / (G / 100.0 * PI * PI.tanh()).sqrt();
    assert!((edge - 11.34).abs() < 0.01, "{edge}");
    let sea = |depth: f64, period: f64| {
        tanker("", "", &format!("-SEA REGULAR 180 2 {period} -A_SEA REGULAR 180 1 9 -DEPTH {depth}"))
    };
    let text = "waves with 80 % of the energy of the sea have no part in the wave drift damping of TANKER";
    let (mixed, deep) = (sea(100.0, 11.4), sea(100.0, 11.3));
    assert!(mixed.contains(text), "{mixed}");
    assert!(!deep.contains("have no part"), "{deep}");
    // the waves of 9 s have what they have alone
    let alone = printed(&tanker("", "", "-SEA REGULAR 180 1 9 -DEPTH 500"));
    assert_share(printed(&mixed), alone, 0.01);
}

#[test]
fn drift_of_one_heading_or_far_frequencies_is_named() {
    let mut model = on_spring(1e6, 1e3, &regular(0.8, 2.0, 180.0));
    let mut table = hemisphere_without(&[]);
    table.headings.truncate(1);
    table.values.truncate(1);
    attach(&mut model, table);
    let said = body_drift_dampings(&model).unwrap();
    assert!(
        said[0].warnings[0].contains("B has no wave drift damping") && said[0].warnings[0].contains("0.0 degrees"),
        "{said:?}"
    );
    assert_eq!(said[0].damping[(0, 0)], 0.0);
    // across waves toward 0 the slope of Fy by headings 90 degrees apart counts
    let mut table = hemisphere_without(&[]);
    let quarters = |n: &usize| n.is_multiple_of(6);
    table.headings = table.headings.iter().enumerate().filter(|(n, _)| quarters(n)).map(|(_, h)| *h).collect();
    table.values = table.values.into_iter().enumerate().filter(|(n, _)| quarters(n)).map(|(_, row)| row).collect();
    attach(&mut model, table);
    let said = body_drift_dampings(&model).unwrap();
    assert!(said[0].warnings.iter().any(|text| text.contains("headings 90 degrees apart")), "{said:?}");
    // a peak between two frequencies
    let peak = [(0.4, 0.0), (0.6, 0.0), (0.8, 1e5), (1.0, 0.0), (1.2, 0.0), (1.4, 0.0)];
    attach(&mut model, along_waves(peak.into_iter()));
    let said = body_drift_dampings(&model).unwrap();
    assert!(said[0].warnings.iter().any(|text| text.contains("the wave drift damping of B is uncertain")), "{said:?}");
}

#[test]
fn current_too_fast_for_linear_formula_is_named() {
    // 0.8 rad/s by the speed over 9.80665 m/s2 is 0.15 at 1.839 m/s
    for (speed, is_fast) in [(1.85, true), (1.82, false)] {
        let environment = format!("&ENV -SEA REGULAR 180 2 {} -CURRENT {speed} 180", TAU / 0.8);
        let mut model = on_spring(1e6, 1e3, &environment);
        attach(&mut model, hemisphere_without(&[]));
        let said = body_drift_dampings(&model).unwrap();
        let named = said[0].warnings.iter().any(|text| text.contains("waves with 100 % of the energy of the sea"));
        assert_eq!(named, is_fast, "{speed}: {said:?}");
    }
}
