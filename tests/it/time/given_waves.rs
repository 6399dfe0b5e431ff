//! Waves given one by one (`-WAVES`) and by their elevation over time (`-S_HISTORY`), against linear theory in deep water.

use crate::common;

use nalgebra::Vector3;
use std::f64::consts::TAU;
use windlass_hydro::sea::Sea;

const G: f64 = 9.80665;

fn sea(records: &str) -> Sea {
    let (mut session, screen, _folder) = common::session();
    session.open("records", format!("&DIMEN -DIMEN METERS K-NTS\n&DEFAULT -WATER 1025 -GRAVITY {G}\n{records}\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?} {}", session.reports, screen.text());
    Sea::new(&session.job.model, &session.job.model.environment).unwrap().unwrap()
}

#[test]
fn two_listed_waves_have_the_elevation_and_velocity_of_linear_theory() {
    let sea = sea("&ENV -WAVES 9 1.4 30 180 6 0.5 -70 300");
    // amplitude, frequency, phase, direction of travel
    let waves = [(1.4, TAU / 9.0, 30f64.to_radians(), 0.0), (0.5, TAU / 6.0, -70f64.to_radians(), 120f64.to_radians())];
    for (x, y, z, time) in [(0.0, 0.0, -2.0, 0.0), (13.0, -7.0, -5.0, 4.2), (-40.0, 22.0, -11.0, 31.7)] {
        let angle =
            |w: f64, phase: f64, toward: f64| w * w / G * (x * toward.cos() + y * toward.sin()) - w * time + phase;
        let elevation: f64 = waves.iter().map(|(a, w, phase, toward)| a * angle(*w, *phase, *toward).cos()).sum();
        assert!((sea.elevation(x, y, time) - elevation).abs() < 1e-9);
        let mut velocity = Vector3::zeros();
        for (a, w, phase, toward) in waves {
            let (sin, cos) = angle(w, phase, toward).sin_cos();
            let size = a * w * (w * w / G * z).exp();
            velocity += Vector3::new(size * cos * toward.cos(), size * cos * toward.sin(), size * sin);
        }
        assert!((sea.kinematics(Vector3::new(x, y, z), time).velocity - velocity).norm() < 1e-9);
    }
}

#[test]
fn sea_of_a_history_passes_through_its_elevations() {
    let elevations = [0.0, 0.7, 1.1, 0.2, -0.9, -1.3, -0.1, 0.3];
    let pairs: Vec<String> = elevations.iter().enumerate().map(|(n, z)| format!("{} {z}", 2 * n)).collect();
    let sea = sea(&format!("&DATA CURVES S_HISTORY SWELL {}\n&ENV -S_HISTORY SWELL 180", pairs.join(" ")));
    for (n, elevation) in elevations.iter().enumerate() {
        // their mean is nought
        assert!((sea.elevation(0.0, 0.0, 2.0 * n as f64) - elevation).abs() < 1e-12, "{n}");
    }
    // toward +x: a wave meets x later
    let [first, ..] = sea.components[..] else { panic!("no waves") };
    assert_eq!(first.toward, [1.0, 0.0]);
}

#[test]
fn waves_are_added_to_a_sea_and_a_stokes_wave_refuses_them() {
    let both = sea("&ENV -SEA ISSC 180 4 10 -COMPONENTS 50 -WAVES 14 0.8 0 90");
    assert_eq!((both.components.len(), both.components[50].amplitude), (51, 0.8));
    let (text, errors) =
        common::print_records("&ENV -SEA STOKES 180 4 10 -WAVES 14 0.8 0 90 -DEPTH 300\n&STATUS SEA_SPECTRUM\n");
    assert!(errors > 0 && text.contains("cannot be added"), "{text}");
}

#[test]
fn history_curve_of_another_type_is_refused_at_its_name() {
    let (text, errors) = common::print_records("&DATA CURVES C_HISTORY TURN 0 1 9 2\n&ENV -S_HISTORY TURN 180\n");
    assert_eq!(errors, 1, "{text}");
    assert!(text.contains("curve TURN is a C_HISTORY, not a S_HISTORY"), "{text}");
}
