//! Static lines on a bathymetry, beside catenaries on the same bottom by scipy (tests/data/bathymetry_lines.py).

use crate::common;
use crate::common::run::model;
use windlass_base::pose::Six;
use windlass_model::Model;
use windlass_solve::System;

/// Bottom at z = -200 + 0.05 y.
const PLANE: &str = "&BATHYMETRY P -DEPTHS\nX -2000 0 2000\nY -2000 300 300 300\nY 0 200 200 200\nY 2000 100 100 100\nEND\n\
                     &ENV -DEPTH 200 -BATHYMETRY P\n";

/// Bottom at z = -200 - 5e-5 (x - 250)^2, every 100 m.
fn dome() -> String {
    let positions: Vec<f64> = (-10..=20).map(|i| 100.0 * f64::from(i)).collect();
    let joined = |values: Vec<String>| values.join(" ");
    let x = joined(positions.iter().map(|x| x.to_string()).collect());
    let z = joined(positions.iter().map(|x| (200.0 + 5e-5 * (x - 250.0).powi(2)).to_string()).collect());
    format!("&BATHYMETRY D -DEPTHS\nX {x}\nY -100 {z}\nY 0 {z}\nY 100 {z}\nEND\n&ENV -DEPTH 200 -BATHYMETRY D\n")
}

/// A line of 968 m and 1200 N/m to an anchor at the origin.
fn moored_model(bottom: &str, [x, y]: [f64; 2], class: &str) -> Model {
    let direction = (-y).atan2(-x).to_degrees();
    model(&format!(
        "{bottom}MEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F {x} {y} -10\n~L B_CAT 100 -LEN 968 -BUOY 0 -WTPL 1200 {class}\n\
         CONNECTOR L -ANC {direction} {} ~L *F\nEND\n",
        x.hypot(y)
    ))
}

/// What the line exerts on its body, with its stiffness.
fn load(model: &Model) -> (Six, nalgebra::Matrix6<f64>) {
    let system = System::new(model, &[]).unwrap();
    let all = system.contributions(&system.state(model).poses).unwrap();
    let line = all.into_iter().find(|c| c.connector.is_some()).unwrap();
    (line.load.wrench, line.load.stiffness)
}

fn close(got: f64, want: f64, within: f64) {
    assert!((got - want).abs() <= within, "{got}, not {want}");
}

/// EA 6E8 N.
const ELASTIC: &str = "-EMOD 76394.37268410977";

#[test]
fn line_on_bathymetry_follows_slope_along_its_azimuth() {
    for (degrees, horizontal, vertical) in [
        (0f64, 322139.172296, 445754.758471),
        (30.0, 239215.813830, 378117.063380),
        (-90.0, 488016.631298, 562988.655535),
    ] {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let (force, _) = load(&moored_model(PLANE, [900.0 * cos, 900.0 * sin], ELASTIC));
        // what the line solver proves: 1e-9 of the tension
        close(force[0], -horizontal * cos, 1e-3);
        close(force[1], -horizontal * sin, 1e-3);
        close(force[2], -vertical, 1e-3);
    }
}

#[test]
fn line_stiffness_across_slope_includes_depth_change() {
    let (_, stiffness) = load(&moored_model(PLANE, [900.0, 0.0], ELASTIC));
    // d(H, V)/d(azimuth) over the distance, and H over the distance; forces proven to 1e-9 over 2e-4 rad
    for (row, want) in [(0, -168536.0208 / 900.0), (1, 322139.172296 / 900.0), (2, -130207.1862 / 900.0)] {
        close(stiffness[(row, 1)], want, 2e-3);
    }
}

#[test]
fn line_on_curved_bathymetry_follows_its_curvature() {
    let made = moored_model(&dome(), [900.0, 0.0], "-EMOD 1E9");
    let (force, _) = load(&made);
    // chords of 6.25 m are up to 5e-5 / 4 * 6.25^2 = 0.49 mm below the dome, times the stiffness by depth
    let (_, stiffness) = load(&made);
    close(force[0], -360652.022695, 0.49e-3 * stiffness[(0, 2)].abs());
    close(force[2], -472936.590995, 0.49e-3 * stiffness[(2, 2)].abs());
}

#[test]
fn table_option_on_bathymetry_interpolates_along_azimuth() {
    let position = [900.0 * 30f64.to_radians().cos(), 450.0];
    let (force, _) = load(&moored_model(PLANE, position, &format!("{ELASTIC} -TABLE")));
    // thirty rows: interpolation errs by a few per mille
    close(force.fixed_rows::<2>(0).norm(), 239215.813830, 5e-3 * 239215.0);
}

#[test]
fn line_with_own_slope_keeps_it_with_a_note() {
    let (mut session, _screen, _folder) = common::session();
    let records = format!(
        "&DIMEN -DIMEN METERS N\n{PLANE}MEDIT\n&DESCRIBE BODY A -IGNORE X Y Z RX RY RZ\n*F 900 0 -10\n\
         ~L B_CAT 100 -LEN 968 -BUOY 0 -WTPL 1200 -SLOPE 0.01\nCONNECTOR L -ANC 180 900 ~L *F\nEND\n"
    );
    session.open("test", records);
    session.run();
    assert_eq!(session.errors, 0);
    let text = format!("{:?}", session.reports);
    assert!(text.contains("L lies on the plane bottom through its anchor, not on bathymetry P"), "{text}");
}
