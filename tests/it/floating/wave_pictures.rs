//! V_WAVES: pressures on a hull against a closed form, and the files of the pictures and the film.

use crate::common;

use nalgebra::{Complex, Vector3};
use std::f64::consts::FRAC_PI_2;
use windlass_diffraction::{DiffractionBody, DiffractionProblem, HullMesh, MirrorPlanes, Water};

/// Amplitude of the potential around a cylinder that stands on the bottom, over that of the incident wave, by the angle from where the waves go
/// [MACCAMY-FUCHS-1954]: |sum e_m i^m cos(m t) 2i/(pi ka H'_m(ka))| at ka = 1, evaluated by scipy 1.17.1.
const RUN_UP: [(usize, f64); 3] = [(0, 0.885_396_238_7), (5, 0.680_626_974_2), (11, 1.113_713_771_1)];

#[test]
fn pressures_on_bottom_mounted_cylinder_are_closed_form() {
    let (depth, rows, turns) = (2.0, 12, 12);
    let step = FRAC_PI_2 / turns as f64;
    let outer = (step / step.sin()).sqrt();
    let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
    let point = |j: usize, k: usize| {
        let angle = step * j as f64;
        Vector3::new(clean(outer * angle.cos()), clean(outer * angle.sin()), -depth * k as f64 / rows as f64)
    };
    let quads: Vec<_> = (0..turns)
        .flat_map(|j| (0..rows).map(move |k| [(j, k), (j, k + 1), (j + 1, k + 1), (j + 1, k)]))
        .map(|corners| corners.map(|(j, k)| point(j, k)))
        .collect();
    let mesh = HullMesh::new(&quads, MirrorPlanes { x: true, y: true }).unwrap();
    let water = Water { density: 1000.0, gravity: 9.81, depth: Some(depth) };
    let problem = DiffractionProblem::new(&[DiffractionBody { mesh, origin: Vector3::zeros() }], water).unwrap();
    let k = 1.0_f64;
    let frequency = (9.81 * k * (k * depth).tanh()).sqrt();
    let waves = problem.solve_waves(frequency, &[0.0]).unwrap();
    let held = vec![vec![Complex::default(); 6]];
    let pressures = &waves.hull_pressures(&held).unwrap()[0];
    let panels = waves.hull_panels();
    assert_eq!((panels.len(), pressures.len()), (4 * turns * rows, 4 * turns * rows));
    for (column, exact) in RUN_UP {
        for row in 0..rows {
            let index = column * rows + row;
            let middle = panels[index].iter().sum::<Vector3<f64>>() / 4.0;
            assert!((middle.y.atan2(middle.x) - step * (column as f64 + 0.5)).abs() < 1e-9);
            let fall = (k * (middle.z + depth)).cosh() / (k * depth).cosh();
            let made = pressures[index].norm() / (1000.0 * 9.81 * fall);
            // what 48 sides of a circle leave
            assert!((made / exact - 1.0).abs() < 0.01, "{column} {row}: {made} for {exact}");
        }
    }
}

const BARGE: &str = "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n#WEIGHT *CG 100552 12 26 26\n#DAMP *CG 0 0 0 2E5\n\
                     &SURFACE\nBLOCK HULL -45 -15 -3.7 45 15 4\nEND_&SURFACE\nEND\nHYDRODYNAMICS\n";

#[test]
fn pictures_and_film_of_waves_are_written() {
    let (mut session, screen, folder) = common::session();
    let asked = "V_WAVES BARGE -PERIOD 9 -PANEL 8 -POINTS 20\nV_WAVES BARGE -PERIOD 9 -HEADING 135 -PHASE 90 -PANEL 8 -POINTS 20 -FILE at.png\n\
                 V_WAVES BARGE -PERIOD 9 -HELD -PANEL 8 -POINTS 20 -FILE film.html\n";
    session.open("records", format!("{BARGE}{asked}END\n"));
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    let read = |name: &str| std::fs::read(folder.path().join("job.ans").join(name)).unwrap();
    let svg = String::from_utf8(read("FIGURE1.svg")).unwrap();
    assert!(
        svg.starts_with("<svg") && svg.contains("wave of 9.00 s from 180 degrees") && svg.contains("seen from below")
    );
    assert!(read("at.png").starts_with(b"\x89PNG"));
    let page = String::from_utf8(read("film.html")).unwrap();
    assert!(page.contains("\"field\":") && page.contains("held: wave of 9.00 s"), "{}", screen.text());
}

#[test]
fn picture_without_period_or_of_a_hull_that_cannot_be_meshed_is_refused() {
    let said = |asked: &str| {
        let (mut session, _screen, _folder) = common::session();
        session.open("records", format!("{BARGE}{asked}\nEND\n"));
        session.run();
        session.reports.iter().map(|r| r.message.clone()).collect::<Vec<_>>().join("\n")
    };
    assert!(said("V_WAVES BARGE").contains("V_WAVES needs -PERIOD, the period of the wave"));
    assert!(said("V_WAVES BARGE -PERIOD 2 -PANEL 5").contains("the shortest wave, of 6.24 m, has 1.2 panels"));
    assert!(said("V_WAVES BARGE -PERIOD 9 -DEPTH 3 -PANEL 8").contains("3.7"));
    assert!(said("V_WAVES BARGE -PERIOD 9 -PANEL 8 -POINTS 20 -FILE waves.pdf").contains("waves.pdf"));
}
