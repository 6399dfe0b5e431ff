//! Union, intersection and difference of closed surfaces, by the volumes of closed forms.

use nalgebra::Vector3;
use std::f64::consts::{PI, TAU};
use windlass_hydro::hull::{Combination, CombinationError, Surface, TubeHull};

fn block(low: [f64; 3], high: [f64; 3]) -> Surface {
    Surface::block(low, high)
}

/// A sphere of triangles between its parallels and meridians, with its corners on it.
fn sphere(centre: Vector3<f64>, radius: f64, parallels: u32) -> Surface {
    let meridians = 2 * parallels;
    let position = |i: u32, j: u32| {
        let (sin_polar, cos_polar) = (PI * f64::from(i) / f64::from(parallels)).sin_cos();
        let (sin, cos) = (TAU * f64::from(j) / f64::from(meridians)).sin_cos();
        centre + Vector3::new(sin_polar * cos, sin_polar * sin, cos_polar) * radius
    };
    let mut vertices = vec![centre + Vector3::z() * radius, centre - Vector3::z() * radius];
    vertices.extend((1..parallels).flat_map(|i| (0..meridians).map(move |j| position(i, j))));
    let at = |i: u32, j: u32| match i {
        0 => 0,
        i if i == parallels => 1,
        i => 2 + (i - 1) * meridians + j % meridians,
    };
    let cell =
        |i: u32, j: u32| [[at(i, j), at(i + 1, j), at(i + 1, j + 1)], [at(i, j), at(i + 1, j + 1), at(i, j + 1)]];
    let cells = (0..parallels).flat_map(|i| (0..meridians).flat_map(move |j| cell(i, j)));
    let faces = cells.filter(|[a, b, c]| a != b && b != c && c != a).collect();
    Surface { vertices, faces }
}

fn volume(a: &Surface, b: &Surface, how: Combination) -> f64 {
    let made = a.combined(b, how).unwrap();
    assert_eq!(made.leaks(), []);
    made.volume()
}

/// Volumes of the union, the intersection and the difference.
fn volumes(a: &Surface, b: &Surface) -> [f64; 3] {
    [Combination::Union, Combination::Intersection, Combination::Difference].map(|how| volume(a, b, how))
}

fn assert_near(found: f64, expected: f64, tolerance: f64, what: &str) {
    assert!((found - expected).abs() <= tolerance * expected.abs(), "{what}: {found}, expected {expected}");
}

#[test]
fn overlapping_boxes_have_volumes_of_counting() {
    // 8 x 6 x 4 m and the same moved by (5, 4, 3): they share 3 x 2 x 1
    let (a, b) = (block([0.0; 3], [8.0, 6.0, 4.0]), block([5.0, 4.0, 3.0], [13.0, 10.0, 7.0]));
    for (found, expected) in volumes(&a, &b).into_iter().zip([378.0, 6.0, 186.0]) {
        assert_near(found, expected, 1e-12, "overlapping boxes");
    }
}

#[test]
fn boxes_with_common_faces_join_without_crack() {
    // the second continues the first, and lies in its planes on four sides
    let (a, b) = (block([0.0; 3], [8.0, 6.0, 4.0]), block([8.0, 0.0, 0.0], [10.0, 6.0, 4.0]));
    assert_near(volume(&a, &b, Combination::Union), 240.0, 1e-12, "side by side");
    // a well cut flush with bottom and deck is a hole right through
    let well = block([2.0, 2.0, 0.0], [4.0, 4.0, 4.0]);
    assert_near(volume(&a, &well, Combination::Difference), 176.0, 1e-12, "well");
    // a hollow that touches nothing
    let hollow = block([1.0; 3], [2.0; 3]);
    assert_near(volume(&a, &hollow, Combination::Difference), 191.0, 1e-12, "hollow");
}

#[test]
fn cylinder_through_box_leaves_hole_of_its_section() {
    let tube = TubeHull { ends: [Vector3::new(4.0, 3.0, -1.0), Vector3::new(4.0, 3.0, 5.0)], diameter: 2.0 };
    let prism = tube.prism(64).unwrap();
    let (sides, length) = (64.0_f64, 6.0);
    // a prism of n sides whose corners are at R has the area n/2 R^2 sin(2 pi/n); R gives it the circumference of the tube (Cauchy)
    let corner = (PI / sides) / (PI / sides).sin();
    let area = 0.5 * sides * corner * corner * (TAU / sides).sin();
    assert_near(prism.volume(), area * length, 1e-12, "prism");
    let hull = block([0.0; 3], [8.0, 6.0, 4.0]);
    let expected = [192.0 + area * (length - 4.0), area * 4.0, 192.0 - area * 4.0];
    for (found, expected) in volumes(&hull, &prism).into_iter().zip(expected) {
        assert_near(found, expected, 1e-12, "cylinder in box");
    }
}

#[test]
fn lens_of_two_spheres_converges_to_closed_form() {
    // two spheres of radius R, centres d apart, share pi (4 R + d) (2 R - d)^2 / 12; the polyhedra converge as 1/n^2
    let (radius, apart) = (1.0, 0.8);
    let lens = PI * (4.0 * radius + apart) * (2.0 * radius - apart) * (2.0 * radius - apart) / 12.0;
    let found = |parallels: u32| {
        let centres = [Vector3::new(0.1, 0.2, 0.3), Vector3::new(0.1 + apart, 0.2, 0.3)];
        let [a, b] = centres.map(|centre| sphere(centre, radius, parallels));
        volume(&a, &b, Combination::Intersection)
    };
    let errors = [16, 32].map(|n| 1.0 - found(n) / lens);
    assert!(errors[1] > 0.0 && errors[1] < 0.01, "{errors:?}");
    assert!((errors[0] / errors[1] - 4.0).abs() < 0.3, "{errors:?}");
}

#[test]
fn turned_cubes_share_octagonal_prism() {
    // a square of side 2 and the same turned by 45 degrees share a regular octagon of inradius 1, of area 8 tan(22.5 deg)
    let (sin, cos) = std::f64::consts::FRAC_PI_4.sin_cos();
    let cube = block([-1.0; 3], [1.0; 3]);
    let turn = |v: &Vector3<f64>| Vector3::new(cos * v.x - sin * v.y, sin * v.x + cos * v.y, v.z);
    let turned = Surface { vertices: cube.vertices.iter().map(turn).collect(), faces: cube.faces.clone() };
    let shared = 2.0 * 8.0 * (PI / 8.0).tan();
    for (found, expected) in volumes(&cube, &turned).into_iter().zip([16.0 - shared, shared, 8.0 - shared]) {
        assert_near(found, expected, 1e-12, "turned cubes");
    }
}

#[test]
fn open_surface_and_empty_result_are_errors() {
    let (a, b) = (block([0.0; 3], [8.0, 6.0, 4.0]), block([20.0; 3], [21.0; 3]));
    assert_eq!(a.combined(&b, Combination::Intersection), Err(CombinationError::Empty));
    assert_eq!(b.combined(&block([0.0; 3], [30.0; 3]), Combination::Difference), Err(CombinationError::Empty));
    let mut open = b.clone();
    open.faces.pop();
    let found = a.combined(&open, Combination::Union);
    assert!(matches!(found, Err(CombinationError::NotSolid { which: 1, .. })), "{found:?}");
}
