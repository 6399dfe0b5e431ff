use crate::cylinder::rows;
use nalgebra::{Complex, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};
use windlass_diffraction::{DiffractionBody, DiffractionProblem, HullMesh, MirrorPlanes, Water};

/// A quarter of a sphere of radius 1 whose middle is below the surface: `m` rows a quarter of its meridian, `m` columns.
fn quarter_sphere(m: usize, depth: f64) -> HullMesh {
    let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
    let point = |i: usize, j: usize| {
        let (t, p) = (FRAC_PI_2 * (i as f64 / m as f64 - 1.0), FRAC_PI_2 * j as f64 / m as f64);
        Vector3::new(clean(t.cos() * p.cos()), clean(t.cos() * p.sin()), -t.sin() - depth)
    };
    let quads: Vec<_> = (0..2 * m)
        .flat_map(|i| (0..m).map(move |j| [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)]))
        .collect();
    HullMesh::new(&quads, MirrorPlanes { x: true, y: true }).unwrap()
}

#[test]
fn submerged_sphere_meets_exact_series() {
    // 3,200 panels with their images: 0.3 % of the displaced mass, 0.5 % of the largest force
    let water = Water { density: 1000.0, gravity: 9.81, depth: None };
    let body = DiffractionBody { mesh: quarter_sphere(20, 1.5), origin: Vector3::new(0.0, 0.0, -1.5) };
    let problem = DiffractionProblem::new(&[body], water).unwrap();
    let mass = 4.0 / 3.0 * PI * water.density;
    let exact = rows(include_str!("../data/submerged_sphere.csv"));
    let largest = exact.iter().flat_map(|n| [n[5].hypot(n[6]), n[7].hypot(n[8])]).fold(0.0, f64::max);
    for n in &exact {
        let omega = (n[0] * water.gravity).sqrt();
        let found = problem.solve(omega, &[0.0]).unwrap();
        for (mode, i) in [(0, 1), (2, 3)] {
            let made = [found.added_mass[(mode, mode)] / mass, found.damping[(mode, mode)] / (mass * omega)];
            for (made, exact) in made.into_iter().zip(&n[i..]) {
                assert!((made - exact).abs() < 0.003, "K {}, mode {mode}: {made} for {exact}", n[0]);
            }
            let exact = Complex::new(n[mode + 5], n[mode + 6]);
            for forces in [&found.excitation, &found.pressure_excitation] {
                let made = forces[0][mode] / (water.density * water.gravity);
                assert!((made - exact).norm() < 0.005 * largest, "K {}, mode {mode}: {made} for {exact}", n[0]);
            }
        }
    }
}
