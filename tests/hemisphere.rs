//! A floating hemisphere by Capytaine (tests/data/hemisphere, with the script that made it), against published values.

#![allow(clippy::unwrap_used)]

use windlass::hydro::database::{Database, capytaine};

const RADIUS: f64 = 10.0;

fn hemisphere() -> Database {
    let bytes = std::fs::read("tests/data/hemisphere/hemisphere.nc").unwrap();
    capytaine::read("hemisphere.nc", &bytes, None).unwrap()
}

/// Displaced mass of the true hemisphere (kg).
fn displaced(data: &Database) -> f64 {
    data.density * 2.0 / 3.0 * std::f64::consts::PI * RADIUS.powi(3)
}

/// Hulme, The wave forces acting on a floating hemisphere undergoing forced periodic oscillations, J. Fluid Mech. 121 (1982),
/// table 1: Ka, added mass over displaced mass, damping over displaced mass times frequency, in heave.
const HEAVE: [(f64, f64, f64); 25] = [
    (0.05, 0.8764, 0.1036),
    (0.1, 0.8627, 0.1816),
    (0.2, 0.7938, 0.2793),
    (0.3, 0.7157, 0.3254),
    (0.4, 0.6452, 0.3410),
    (0.5, 0.5861, 0.3391),
    (0.6, 0.5381, 0.3271),
    (0.7, 0.4999, 0.3098),
    (0.8, 0.4698, 0.2899),
    (0.9, 0.4464, 0.2691),
    (1.0, 0.4284, 0.2484),
    (1.2, 0.4047, 0.2096),
    (1.4, 0.3924, 0.1756),
    (1.6, 0.3871, 0.1469),
    (1.8, 0.3864, 0.1229),
    (2.0, 0.3884, 0.1031),
    (2.5, 0.3988, 0.0674),
    (3.0, 0.4111, 0.0452),
    (4.0, 0.4322, 0.0219),
    (5.0, 0.4471, 0.0116),
    (6.0, 0.4574, 0.0066),
    (7.0, 0.4647, 0.0040),
    (8.0, 0.4700, 0.0026),
    (9.0, 0.4740, 0.0017),
    (10.0, 0.4771, 0.0012),
];

#[test]
fn heave_of_the_hemisphere_is_that_of_hulme() {
    let data = hemisphere();
    let mass = displaced(&data);
    let (mut worst_added, mut worst_damping) = (0.0f64, 0.0f64);
    for (ka, added, damping) in HEAVE {
        let w = (ka * data.gravity / RADIUS).sqrt();
        let own = data.added_mass_at(w).unwrap()[(2, 2)] / mass;
        let radiated = data.damping_at(w).unwrap()[(2, 2)] / mass / w;
        println!("{ka} {:.4} {:.4}", own - added, radiated - damping);
        worst_added = worst_added.max((own - added).abs());
        worst_damping = worst_damping.max((radiated - damping).abs());
    }
    println!("{worst_added} {worst_damping}");
    println!("{:?}", data.remarks);
    println!("{} {}", data.infinite.unwrap()[(2, 2)] / mass, data.zero.unwrap()[(2, 2)] / mass);
}
