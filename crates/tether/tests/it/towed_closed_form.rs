//! The towed tether where its motion is known without a program: rest, a particle's path, symmetry, the frame of the tow.

use std::f64::consts::{FRAC_PI_4, PI, TAU};
use windlass_hydro::sea::stokes::Stokes;
use windlass_hydro::sea::{Component, Water};
use windlass_tether::towed::loads::Loading;
use windlass_tether::towed::scheme::TowedState;
use windlass_tether::towed::{
    EndSpring, Towed, TowedCompatibility, TowedHistory, TowedRecord, TowedSteps, WaterForceMultipliers,
};
use windlass_tether::{TetherElement, TetherLine};

const DENSITY: f64 = 1025.0;
const GRAVITY: f64 = 9.81;

/// A tube of 1 m as heavy as a share of its displacement, in ten elements of 10 m.
fn line(share: f64) -> TetherLine {
    let area = FRAC_PI_4 * (1.0 - 0.96f64.powi(2));
    let element = TetherElement {
        length: 10.0,
        outer_diameter: 1.0,
        wall_thickness: 0.02,
        density: share * DENSITY * FRAC_PI_4 / area,
        youngs_modulus: 2.1e11,
        drag: 0.75,
        added_mass: 1.0,
        label: Default::default(),
    };
    TetherLine::with_numbered_nodes(vec![element; 10]).unwrap()
}

fn case(share: f64, depth: f64) -> Towed {
    Towed {
        line: line(share),
        origin: [-100.0, 0.0, -depth],
        heading: 0.0,
        springs: [EndSpring { along: 500.0, y: 500.0, z: 500.0 }; 2],
        density: DENSITY,
        gravity: GRAVITY,
        depth: None,
        waves: Vec::new(),
        stokes: None,
        current: Vec::new(),
        tow: [0.0; 2],
        multipliers: WaterForceMultipliers { slam: 1.0, ..WaterForceMultipliers::default() },
        compatibility: TowedCompatibility::native(),
    }
}

fn wave(amplitude: f64, frequency: f64, toward: f64, phase: f64) -> Component {
    let number = frequency * frequency / GRAVITY;
    Component { frequency, number, amplitude, toward: [toward.cos(), toward.sin()], phase }
}

/// Y, Z, RY, RZ of each node at each record.
fn positions(case: &Towed, steps: &TowedSteps) -> Vec<[f64; 4]> {
    let mut found = Vec::new();
    case.run(steps, &mut |r: &TowedRecord| found.extend_from_slice(r.positions)).unwrap();
    found
}

fn steps(number: usize) -> TowedSteps {
    TowedSteps { step: 0.1, number, ..TowedSteps::default() }
}

fn largest(values: impl Iterator<Item = f64>) -> f64 {
    values.fold(0.0, |most, v| most.max(v.abs()))
}

#[test]
fn tube_of_half_water_density_floats_half_submerged() {
    let found = positions(&case(0.5, 0.0), &steps(50));
    // areas of halves cancel to some roundings of the weight, 4 kN/m, on 800 kg/m
    assert!(largest(found.into_iter().flatten()) < 1e-12);
}

#[test]
fn light_tube_released_under_water_settles_at_its_draft() {
    // a quarter of the area under water: the wet segment spans the angle a with a - sin a = pi/2, a = 2.309881460
    let bare = Towed {
        multipliers: WaterForceMultipliers { slam: 0.0, ..WaterForceMultipliers::default() },
        ..case(0.25, 0.0)
    };
    let soft = EndSpring { along: 0.0, y: 1.0, z: 1.0 };
    let run = Towed { springs: [soft; 2], ..bare };
    let mut last = 0.0;
    run.run(&TowedSteps { step: 0.1, number: 6001, ..TowedSteps::default() }, &mut |r: &TowedRecord| {
        last = r.positions[5][1]
    })
    .unwrap();
    // the chord is r cos(a/2) under the axis, which is above the water by as much
    let rest = 0.5 * (2.309_881_460_010_057f64 / 2.0).cos();
    // quadratic drag leaves a motion that dies with one over the time
    assert!((last - rest).abs() < 5e-3, "{last} {rest}");
}

#[test]
fn neutrally_buoyant_tube_follows_small_beam_wave() {
    // mass + added mass times its acceleration is (1 + Ca) rho A times that of the water: without drag it keeps to the water
    let (amplitude, frequency, depth) = (1e-3, 0.8, 5.0);
    let free = EndSpring::default();
    let run = Towed {
        waves: vec![wave(amplitude, frequency, PI / 2.0, 0.3)],
        springs: [free; 2],
        multipliers: WaterForceMultipliers { drag: 0.0, ..WaterForceMultipliers::default() },
        ..case(1.0, depth)
    };
    assert_eq!(run.warnings().len(), 4);
    let found = positions(&run, &steps(201));
    let orbit = amplitude * (-frequency * frequency / GRAVITY * depth).exp();
    for (record, nodes) in found.chunks(11).enumerate() {
        let t = 0.1 * record as f64;
        // velocity a w cos(p - w t), sin(p - w t) from rest: the velocity at the start is taken off
        let y = orbit * (0.3f64.sin() - (0.3 - frequency * t).sin() - frequency * t * 0.3f64.cos());
        let z = orbit * ((0.3 - frequency * t).cos() - 0.3f64.cos() - frequency * t * 0.3f64.sin());
        for node in nodes {
            // the scheme is of second order: (w dt)^2/12 of the orbit a radian, and drift; the path itself is a wave number times less
            let close = orbit * (2e-3 + 1e-3 * frequency * t);
            assert!((node[0] - y).abs() < close && (node[1] - z).abs() < close, "{t}: {node:?} {y} {z}");
            assert!(node[2].abs() < 1e-12 && node[3].abs() < 1e-12);
        }
    }
}

#[test]
fn short_tether_rides_on_second_harmonic_of_stokes_wave() {
    // held along its axis, a short tether on long waves has the height of the surface at its place: k a^2/2 cos 2 w t of the second order
    // in deep water [DEAN-DALRYMPLE-1991 11.2], nothing of an Airy wave
    let (amplitude, period) = (4.0, 16.0);
    let frequency = TAU / period;
    let water = Water { depth: None, level: 0.0, gravity: GRAVITY, density: DENSITY };
    let stokes = Stokes::new(2, (2.0 * amplitude, frequency), ([1.0, 0.0], 0.0), water).unwrap();
    let short = |e: &TetherElement| TetherElement { length: 0.5, ..*e };
    let second = |stokes: Option<Stokes>| {
        let run = Towed {
            line: TetherLine::new(line(0.5).elements().iter().map(short).collect()).unwrap(),
            origin: [-5.0, 0.0, 0.0],
            waves: vec![wave(amplitude, frequency, 0.0, 0.0)],
            stokes,
            springs: [EndSpring { along: 1.0, y: 1.0, z: 1.0 }; 2],
            multipliers: WaterForceMultipliers::default(),
            ..case(0.5, 0.0)
        };
        let found = positions(&run, &TowedSteps { step: 0.05, number: 2561, ..TowedSteps::default() });
        // the last two of eight periods, of the middle node
        let cycle = 320;
        let of = |i: usize| (0.05 * i as f64, found[11 * i + 5][1]);
        let [mut cos, mut sin] = [0.0; 2];
        for (time, z) in (2560 - 2 * cycle..2560).map(of) {
            cos += z * (2.0 * frequency * time).cos() / cycle as f64;
            sin += z * (2.0 * frequency * time).sin() / cycle as f64;
        }
        // the angle at the middle, which is 2.5 m behind the vessel's end at the origin
        let angle = 2.0 * -2.5 * frequency * frequency / GRAVITY;
        [cos * angle.cos() + sin * angle.sin(), sin * angle.cos() - cos * angle.sin()]
    };
    let want = 0.5 * frequency * frequency / GRAVITY * amplitude * amplitude;
    let ([with, across], without) = (second(Some(stokes)), second(None));
    assert!((with - want).abs() < 0.05 * want && across.abs() < 0.05 * want, "{want} {with} {across}");
    assert!(without[0].hypot(without[1]) < 0.1 * want, "{want} {without:?}");
}

#[test]
fn mirrored_waves_give_mirrored_motion() {
    let of = |sign: f64| {
        let waves = vec![wave(1.5, 0.7, sign * 2.5, 0.4), wave(0.8, 1.1, sign * 2.0, 1.9)];
        let current = vec![(0.0, [-0.4, 0.2 * sign]), (-20.0, [0.0, 0.1 * sign])];
        positions(&Towed { waves, current, ..case(0.95, 0.3) }, &steps(300))
    };
    let (one, other) = (of(1.0), of(-1.0));
    let moved = largest(one.iter().map(|p| p[0]));
    assert!(moved > 0.1, "{moved}");
    for (a, b) in one.iter().zip(&other) {
        let mirrored = [-b[0], b[1], b[2], -b[3]];
        // roundings, grown by where the surface cuts the tube
        assert!(largest((0..4).map(|i| a[i] - mirrored[i])) < 1e-9, "{a:?} {b:?}");
    }
}

#[test]
fn rotated_sea_and_tether_give_equal_motions() {
    let of = |turn: f64| {
        let (sin, cos) = turn.sin_cos();
        let turned = |x: f64, y: f64| [cos * x - sin * y, sin * x + cos * y];
        let [x, y] = turned(-100.0, 7.0);
        positions(
            &Towed {
                waves: vec![wave(1.5, 0.7, 2.5 + turn, 0.4), wave(0.8, 1.1, 3.0 + turn, 1.9)],
                current: vec![(0.0, turned(-0.4, 0.2))],
                tow: turned(1.0, 0.1),
                heading: turn,
                origin: [x, y, -0.3],
                ..case(0.95, 0.3)
            },
            &steps(200),
        )
    };
    for (a, b) in of(0.0).iter().zip(&of(1.234)) {
        assert!(largest((0..4).map(|i| a[i] - b[i])) < 1e-9, "{a:?} {b:?}");
    }
}

#[test]
fn tow_matches_opposite_current() {
    let waves = vec![wave(1.0, 0.8, PI, 0.4)];
    let towed = Towed { waves: waves.clone(), tow: [1.5, 0.0], ..case(0.95, 0.3) };
    let held = Towed { waves, current: vec![(0.0, [-1.5, 0.0])], ..case(0.95, 0.3) };
    assert_eq!(positions(&towed, &steps(100)), positions(&held, &steps(100)));
}

#[test]
fn towed_tether_responds_at_encounter_frequency() {
    // deep enough to be linear, without drag: a stiff tube swings as the waves come
    let (frequency, speed) = (0.8f64, 2.0);
    let number = frequency * frequency / GRAVITY;
    let stiff = |e: &TetherElement| TetherElement { youngs_modulus: 1e4 * e.youngs_modulus, ..*e };
    let run = Towed {
        line: TetherLine::new(line(1.0).elements().iter().map(stiff).collect()).unwrap(),
        waves: vec![wave(1e-3, frequency, PI, 0.0)],
        tow: [speed, 0.0],
        springs: [EndSpring::default(); 2],
        multipliers: WaterForceMultipliers { drag: 0.0, ..WaterForceMultipliers::default() },
        ..case(1.0, 10.0)
    };
    let mut history = TowedHistory::default();
    run.run(&TowedSteps { step: 0.05, number: 400, ..TowedSteps::default() }, &mut history).unwrap();
    let series = history.node(5, 11, 9);
    // x(t+h) + x(t-h) = 2 cos(w h) x(t) of a harmonic
    let h = 20;
    let (mut top, mut bottom) = (0.0, 0.0);
    for i in 5 * h..series.len() - h {
        top += (series[i + h] + series[i - h]) * series[i];
        bottom += 2.0 * series[i] * series[i];
    }
    let met = (top / bottom).acos() / (0.05 * h as f64);
    assert!((met / (frequency + number * speed) - 1.0).abs() < 0.01, "{met}");
}

#[test]
fn step_too_large_for_springs_is_refused_and_proposed_step_runs() {
    let stiff = EndSpring { along: 0.0, y: 1e6, z: 1e6 };
    let run = Towed { springs: [stiff; 2], ..case(0.95, 0.3) };
    let error =
        run.run(&TowedSteps { step: 0.5, number: 2, ..TowedSteps::default() }, &mut |_: &TowedRecord| {}).unwrap_err();
    assert!(error.to_string().contains("too large for the end springs"), "{error}");
    let longest = error.message.values().nth(1).unwrap();
    let mut most: f64 = 0.0;
    let good = TowedSteps { step: 0.99 * longest, number: 500, ..TowedSteps::default() };
    run.run(&good, &mut |r: &TowedRecord| most = most.max(r.positions[0][1].abs())).unwrap();
    assert!(longest > 0.01 && most < 1.0, "{longest} {most}");
}

#[test]
fn invalid_towed_tether_is_error() {
    let go = |case: Towed, steps: TowedSteps| case.run(&steps, &mut |_: &TowedRecord| {}).unwrap_err().to_string();
    let usual = || case(0.95, 0.3);
    assert!(go(Towed { density: 0.0, ..usual() }, steps(2)).contains("density of the water"));
    assert!(go(Towed { depth: Some(f64::NAN), ..usual() }, steps(2)).contains("depth"));
    let spring = EndSpring { z: -1.0, ..EndSpring::default() };
    assert!(go(Towed { springs: [spring; 2], ..usual() }, steps(2)).contains("a spring"));
    assert!(go(Towed { waves: vec![wave(1.0, 0.0, 0.0, 0.0)], ..usual() }, steps(2)).contains("component 1"));
    let short = Component { number: 1e9, ..wave(1.0, 1.0, 0.0, 0.0) };
    assert!(go(Towed { waves: vec![short], ..usual() }, steps(2)).contains("integration lengths"));
    assert!(
        go(Towed { current: vec![(-5.0, [0.0; 2]), (0.0, [0.0; 2])], ..usual() }, steps(2))
            .contains("heights do not fall")
    );
    assert!(go(usual(), TowedSteps { step: 0.0, ..steps(2) }).contains("step above zero"));
    assert!(go(usual(), TowedSteps { b: 0.4, ..steps(2) }).contains("not stable"));
    let gale = Towed { tow: [0.0, 1e9], ..usual() };
    assert!(go(gale, steps(200)).contains("towed tether"));
}

#[test]
fn waves_meet_foreshortened_tether_at_shifted_positions() {
    // a straight tether 30 m down that lies at a slope of s in plan: a place x from the vessel's end is at x (1 - s^2/2) from there
    let (s, time) = (0.3, 4.0_f64);
    let mut case = case(1.0, 30.0);
    case.compatibility.unstretched_crests = true;
    let elements: Vec<_> = case.line.elements().iter().map(|e| TetherElement { drag: 0.0, ..*e }).collect();
    case.line = TetherLine::with_numbered_nodes(elements).unwrap();
    for frequency in [0.6, 1.5] {
        case.waves = vec![wave(2.0, frequency, 0.0, 0.4)];
        let length: f64 = case.line.elements().iter().map(|e| e.length).sum();
        let mut state = TowedState { at: [vec![0.0; 22], vec![0.0; 22]], velocity: [vec![0.0; 22], vec![0.0; 22]] };
        for (node, x) in case.line.distances().iter().enumerate() {
            (state.at[0][2 * node], state.at[0][2 * node + 1]) = (s * x, s);
        }
        let mut loading = Loading::new(&case).unwrap();
        loading.find(time, &state);
        let found: f64 = loading.forces.iter().map(|[_, z]| z[0] + z[2]).sum();
        // displaced and added mass times the mean of -a w^2 exp(kz) cos(k (x - 100) - w t + phase); it weighs what it displaces
        let (k, shorter) = (case.waves[0].number, 1.0 - 0.5 * s * s);
        let phase = |x: f64| k * (length - (length - x) * shorter - 100.0) - frequency * time + 0.4;
        let mean = (phase(length).sin() - phase(0.0).sin()) / (k * shorter * length);
        let moved = 2.0 * DENSITY * FRAC_PI_4 * length;
        let wanted = -moved * 2.0 * frequency * frequency * (-30.0 * k).exp() * mean;
        // four Gauss points a quarter wave
        let size = moved * 2.0 * frequency * frequency * (-30.0 * k).exp();
        assert!((found - wanted).abs() < 1e-8 * size, "{frequency}: {found} {wanted} {size}");
    }
}

#[test]
fn rotation_of_thirty_degrees_ends_small_deflections() {
    // chapter 4: rotations of more than 30 degrees invalidate the analysis
    let run = case(0.95, 50.0);
    let straight = |degrees: f64| {
        let slope = degrees.to_radians().tan();
        let state: Vec<f64> = (0..11).flat_map(|node| [10.0 * slope * f64::from(node), slope]).collect();
        let velocity = [vec![0.0; 22], vec![0.0; 22]];
        run.run_from(TowedState { at: [vec![0.0; 22], state], velocity }, &steps(1), &mut |_: &TowedRecord| {})
    };
    assert!(straight(29.9).is_ok());
    let error = straight(30.1).unwrap_err().to_string();
    assert!(error.contains("element 1 of the towed tether is steeper than 30 degrees at record 1"), "{error}");
}

#[test]
fn natural_periods_below_hundredth_of_second_are_counted() {
    // modes of a free element with consistent mass in a plane: w2 = 720 EI/(m L4) and 8400 EI/(m L4), and two rigid ones; the
    // mass is that of the tube and the water that goes along, deep under it
    let mut run = Towed { springs: [EndSpring::default(); 2], ..case(0.95, 50.0) };
    let element = run.line.elements()[0];
    let mass = element.mass_per_length() + DENSITY * FRAC_PI_4;
    let stiffness_of = |period: f64, factor: f64| (2.0 * PI / period).powi(2) * mass * element.length.powi(4) / factor;
    for (stiffness, fast) in [
        (stiffness_of(0.0101, 8400.0), 0),
        (stiffness_of(0.0099, 8400.0), 2),
        (stiffness_of(0.0101, 720.0), 2),
        (stiffness_of(0.0099, 720.0), 4),
    ] {
        let youngs_modulus = element.youngs_modulus * stiffness / element.bending_stiffness();
        run.line = TetherLine::with_numbered_nodes(vec![TetherElement { youngs_modulus, ..element }]).unwrap();
        assert_eq!(run.count_fast_modes().unwrap(), fast, "{stiffness}");
    }
}
