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
        current: Vec::new(),
        tow: [0.0; 2],
        multipliers: WaterForceMultipliers::default(),
        compatibility,
    }
}

/// Elevation and flow at a place of the tether's axes.
fn flow_at(waters: &Waters, time: f64, x: f64, y: f64, height: f64) -> (f64, TowedFlow) {
    let (mut turns, mut place) = (Vec::new(), Vec::new());
    waters.at_time(time, &mut turns);
    waters.at_place(x, y, &mut place);
    let elevation = waters.elevation(&turns, &place);
    (elevation, waters.flow(&turns, &place, height, elevation))
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

#[test]
fn current_is_linear_between_its_heights() {
    let current = vec![(0.0, [1.0, 0.0]), (-10.0, [0.5, 0.0]), (-20.0, [0.0, 0.0])];
    let waters = Waters::new(&Towed { heading: 0.0, current, ..case(TowedCompatibility::native(), None) });
    let found: Vec<f64> = [3.0, 0.0, -4.0, -10.0, -15.0, -30.0].iter().map(|z| waters.current_at(*z)[0]).collect();
    for (a, b) in found.iter().zip([1.0, 1.0, 0.8, 0.5, 0.25, 0.0]) {
        assert!((a - b).abs() < 1e-15);
    }
}
