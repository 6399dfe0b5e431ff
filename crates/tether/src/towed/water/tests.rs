//! Water on a towed tether against closed forms and the sea as it is elsewhere.

use super::super::{EndSpring, TowedCompatibility, WaterForceMultipliers};
use super::*;
use crate::{TetherElement, TetherLine};
use nalgebra::Vector3;
use windlass_hydro::sea::{Sea, Water};
use windlass_model::Stretching;

fn case(compatibility: TowedCompatibility, depth: Option<f64>) -> Towed {
    let element = TetherElement {
        length: 10.0,
        outer_diameter: 1.0,
        wall_thickness: 0.02,
        density: 7850.0,
        youngs_modulus: 2.1e11,
        drag: 0.75,
        added_mass: 1.0,
        label: Default::default(),
    };
    let wave = |i: usize| {
        let (i, frequency) = (i as f64, 0.4 + 0.13 * i as f64);
        let number = windlass_hydro::sea::dispersion::wave_number(frequency, depth, 9.81).unwrap();
        let toward = [(0.3 * i).cos(), (0.3 * i).sin()];
        Component { frequency, number, amplitude: 0.2 + 0.01 * i, toward, phase: 1.3 * i }
    };
    Towed {
        line: TetherLine::with_numbered_nodes(vec![element]).unwrap(),
        origin: [-20.0, 4.0, -0.5],
        heading: 0.7,
        springs: [EndSpring::default(); 2],
        density: 1025.0,
        gravity: 9.81,
        depth,
        waves: (0..11).map(wave).collect(),
        stokes: None,
        current: Vec::new(),
        tow: [0.0; 2],
        multipliers: WaterForceMultipliers::default(),
        compatibility,
    }
}

/// Elevation and flow at a place of the tether's axes.
fn flow_at(waters: &Waters, time: f64, x: f64, y: f64, height: f64) -> (f64, TowedFlow) {
    let (mut turns, mut position) = (Vec::new(), Vec::new());
    waters.at_time(time, &mut turns);
    waters.at_place(x, y, &mut position);
    let elevation = waters.elevation(&turns, &position);
    (elevation, waters.flow(&turns, &position, height, elevation))
}

#[test]
fn exponential_matches_standard_library() {
    for i in -200_000..200_000i32 {
        let power = f64::from(i) * 3.4e-3;
        let value = exp([power; 4])[2];
        // a rounding of the power is one of the value times the power
        assert!((value / power.exp() - 1.0).abs() < 1e-15 + 3e-16 * power.abs(), "{power}");
    }
    assert!(exp([f64::NAN; 4])[0].is_nan() && exp([1e9; 4])[0].is_finite());
}

#[test]
fn towed_water_matches_sea_in_tether_axes() {
    for (depth, exponential) in [(None, true), (Some(30.0), true), (None, false), (Some(30.0), false)] {
        let compatibility = TowedCompatibility { unstretched_crests: exponential, ..TowedCompatibility::native() };
        let case = case(compatibility, depth);
        let waters = Waters::new(&case);
        let stretching = if exponential { Stretching::Exponential } else { Stretching::Wheeler };
        let water = Water { depth, level: 0.0, gravity: 9.81, density: 1025.0 };
        let sea = Sea::airy(case.waves.clone(), water, 0.0, stretching);
        let (sin, cos) = 0.7f64.sin_cos();
        for (time, x, y, height) in [(0.0, 0.0, 0.0, -1.0), (7.3, 6.0, -0.4, -3.0), (12.9, 9.0, 2.0, -0.9)] {
            let global = Vector3::new(-20.0 + cos * x - sin * y, 4.0 + sin * x + cos * y, height);
            let (elevation, flow) = flow_at(&waters, time, x, y, height);
            let want = sea.kinematics(global, time);
            assert!((elevation - sea.elevation(global.x, global.y, time)).abs() < 1e-13);
            assert!(height < elevation, "the place is under water");
            for (found, v) in [(flow.velocity, want.velocity), (flow.acceleration, want.acceleration)] {
                let turned = [cos * v.x + sin * v.y, cos * v.y - sin * v.x, v.z];
                for (a, b) in found.iter().zip(turned) {
                    assert!((a - b).abs() < 1e-13, "{depth:?} {exponential} {time}: {found:?} {turned:?}");
                }
            }
        }
    }
}

#[test]
fn towed_surface_matches_surface_at_current_position() {
    let still = case(TowedCompatibility::native(), None);
    let (vx, vy) = (1.7, -0.6);
    let under_way = Towed { tow: [vx, vy], ..still.clone() };
    let (one, other) = (Waters::new(&still), Waters::new(&under_way));
    let (sin, cos) = 0.7f64.sin_cos();
    for t in [0.0, 3.0, 11.0] {
        let (dx, dy) = (cos * vx + sin * vy, cos * vy - sin * vx);
        let (passed, flow) = flow_at(&one, t, 2.0 + dx * t, 1.0 + dy * t, -2.0);
        let (met, flow_nearby) = flow_at(&other, t, 2.0, 1.0, -2.0);
        assert!((passed - met).abs() < 1e-13);
        assert!((flow.velocity[0] - dx - flow_nearby.velocity[0]).abs() < 1e-13);
        assert!((flow.velocity[1] - dy - flow_nearby.velocity[1]).abs() < 1e-13);
        assert!((flow.acceleration[2] - flow_nearby.acceleration[2]).abs() < 1e-13);
    }
}

/// Place, surface, velocity, acceleration.
type WavePoint = ([f64; 3], f64, [f64; 2], [f64; 2]);

/// A wave of the second order, 4 m high with a period of 10 s in 30 m, by its closed form [DEAN-DALRYMPLE-1991 11.2] in forty digits: place along it, height (m)
/// and time (s); surface (m), velocity along and up (m/s), acceleration of the particle (m/s2).
const SECOND_ORDER: [WavePoint; 4] = [
    ([0.0, -5.0, 0.0], 2.149_852_451_373_923, [1.213_269_444_540_679, 0.0], [0.0, -0.591_157_534_951_884_3]),
    (
        [17.0, -3.0, 2.5],
        1.401_817_589_246_167,
        [0.890_394_390_158_456_3, -0.806_769_227_036_505_8],
        [-0.610_784_043_212_502_1, -0.404_632_618_372_480_7],
    ),
    (
        [-40.0, -20.0, 6.1],
        1.677_275_108_343_625,
        [0.616_364_872_819_284_7, 0.194_486_914_255_156_5],
        [0.276_799_689_333_313_1, -0.156_472_607_698_296_9],
    ),
    (
        [5.0, 0.5, 0.8],
        2.053_457_740_495_545,
        [1.455_540_404_165_443, -0.380_030_902_490_654],
        [-0.280_288_898_833_338_1, -0.747_207_629_932_350_9],
    ),
];

#[test]
fn second_order_wave_of_towed_water_matches_closed_form() {
    let water = Water { depth: Some(30.0), level: 0.0, gravity: 9.80665, density: 1025.0 };
    let frequency = std::f64::consts::TAU / 10.0;
    // the wave runs 0.4 rad from the axis; the axis begins 3 m behind a crest
    let (turn, start) = (0.4f64, 3.0);
    for (heading, tow) in [(0.0, [0.0; 2]), (1.1, [0.9, -0.5])] {
        let toward = [(heading + turn).cos(), (heading + turn).sin()];
        let wave = Stokes::new(2, (4.0, frequency), (toward, 0.0), water).unwrap();
        assert!((wave.number - 0.045_775_705_189_078_34).abs() < 1e-15);
        let component = Component { frequency, number: wave.number, amplitude: 2.0, toward, phase: 0.0 };
        let waters = Waters::new(&Towed {
            origin: [-start * toward[0], -start * toward[1], -0.5],
            heading,
            gravity: 9.80665,
            waves: vec![component],
            stokes: Some(wave),
            tow,
            ..case(TowedCompatibility::native(), Some(30.0))
        });
        for ([along, height, time], elevation, velocity, acceleration) in SECOND_ORDER {
            // as the axis, which goes with the tow, has the place then
            let (sin, cos) = heading.sin_cos();
            let gone = [cos * tow[0] + sin * tow[1], cos * tow[1] - sin * tow[0]];
            let [x, y] = [turn.cos() * (along + start), turn.sin() * (along + start)];
            let (surface, flow) = flow_at(&waters, time, x - gone[0] * time, y - gone[1] * time, height);
            assert!((surface - elevation).abs() < 1e-12, "{surface} {elevation}");
            let axes = |[along, up]: [f64; 2]| [turn.cos() * along, turn.sin() * along, up];
            let [u, v, w] = axes(velocity);
            for (found, want) in
                [(flow.velocity, [u - gone[0], v - gone[1], w]), (flow.acceleration, axes(acceleration))]
            {
                assert!(found.iter().zip(want).all(|(a, b)| (a - b).abs() < 1e-12), "{found:?} {want:?}");
            }
        }
    }
}

#[test]
fn current_is_linear_between_its_heights() {
    let current = vec![(0.0, [1.0, 0.0]), (-10.0, [0.5, 0.0]), (-20.0, [0.0, 0.0])];
    let waters = Waters::new(&Towed { heading: 0.0, current, ..case(TowedCompatibility::native(), None) });
    let found: Vec<f64> = [3.0, 0.0, -4.0, -10.0, -15.0, -30.0].iter().map(|z| waters.current_at(*z)[0]).collect();
    for (a, b) in found.iter().zip([1.0, 1.0, 0.8, 0.5, 0.25, 0.0]) {
        assert!((a - b).abs() < 1e-15);
    }
}
