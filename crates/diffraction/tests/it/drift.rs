use crate::cylinder::{CylinderMesh, problem as in_depth, rows};
use crate::hemisphere::{QUARTER, WATER, hemisphere, problem as of_hemisphere};
use nalgebra::{Complex, DMatrix, Vector3};
use std::f64::consts::PI;
use windlass_diffraction::{
    ControlCylinder, ControlSurface, DiffractionBody, DiffractionProblem, FreeBody, HullMesh, MirrorPlanes,
    free_motions,
};

const FIXED: [Complex<f64>; 6] = [Complex::new(0.0, 0.0); 6];

/// The hemisphere with the mass of the water that it displaces, and its centre of gravity in the origin: pitch and yaw have no stiffness and no
/// load, an inertia of one keeps them.
fn free_hemisphere() -> FreeBody {
    let mass = 2.0 / 3.0 * PI * WATER.density;
    let mut stiffness = DMatrix::zeros(6, 6);
    stiffness[(2, 2)] = WATER.density * WATER.gravity * PI;
    FreeBody {
        mass: DMatrix::from_diagonal(&[mass, mass, mass, mass, mass, mass].to_vec().into()),
        stiffness,
        damping: DMatrix::zeros(6, 6),
    }
}

#[test]
fn far_field_drift_of_hemisphere_meets_exact_series() {
    // 1 % of the largest drift of each column, 0.65 and 0.87
    let problem = of_hemisphere(20, QUARTER);
    for n in rows(include_str!("../data/hemisphere.csv")).iter().filter(|n| n[0] <= 4.0) {
        let waves = problem.solve_waves((n[0] * WATER.gravity).sqrt(), &[0.0]).unwrap();
        let motions = free_motions(&waves.forces, &free_hemisphere()).unwrap();
        for (motions, exact, largest) in [(&FIXED[..], n[9], 0.648), (&motions[0], n[10], 0.872)] {
            let found = waves.far_field_drift(0, motions).unwrap();
            let surge = found.surge / (WATER.density * WATER.gravity);
            assert!((surge - exact).abs() < 0.01 * largest, "K {}: {surge} for {exact}", n[0]);
            let other = found.sway.hypot(found.yaw) / (WATER.density * WATER.gravity);
            assert!(other < 1e-6, "K {}: {other}", n[0]);
        }
    }
}

#[test]
fn far_field_drift_of_bottom_mounted_cylinder_meets_closed_form() {
    let problem = in_depth(CylinderMesh { draught: 2.0, rows: 20, rings: 0, turns: 12 }.build(), 2.0);
    for n in rows(include_str!("../data/bottom_mounted_cylinder.csv")).iter().filter(|n| n[0] <= 2.0) {
        let waves = problem.solve_waves((n[1] * 9.81).sqrt(), &[0.0]).unwrap();
        let surge = waves.far_field_drift(0, &FIXED).unwrap().surge / 9810.0;
        assert!((surge - n[4]).abs() < 0.01 * 0.762, "k {}: {surge} for {}", n[0], n[4]);
    }
}

#[test]
fn far_field_drift_of_truncated_cylinder_meets_matched_eigenfunctions() {
    let mesh = CylinderMesh { draught: 0.5, rows: 12, rings: 12, turns: 8 }.build().with_lid().unwrap();
    let problem = in_depth(mesh, 1.5);
    for n in rows(include_str!("../data/truncated_cylinder.csv")) {
        let waves = problem.solve_waves((n[0] * 9.81).sqrt(), &[0.0]).unwrap();
        let surge = waves.far_field_drift(0, &FIXED).unwrap().surge / 9810.0;
        assert!((surge - n[10]).abs() < 0.01 * 0.635, "nu {}: {surge} for {}", n[0], n[10]);
    }
}

#[test]
fn oblique_drift_turns_with_wave_and_has_moment_about_distant_origin() {
    // a body of revolution about (3, -2): the force lies along the wave, its moment about the global origin is x Fy - y Fx
    let (centre, heading) = (Vector3::new(3.0, -2.0, 0.0), 0.7_f64);
    let quads: Vec<_> = hemisphere(8, MirrorPlanes::default())
        .hull()
        .iter()
        .map(|panel| panel.corners().map(|corner| corner + centre))
        .collect();
    let mesh = HullMesh::new(&quads, MirrorPlanes::default()).unwrap();
    let problem = DiffractionProblem::new(&[DiffractionBody { mesh, origin: centre }], WATER).unwrap();
    let waves = problem.solve_waves(WATER.gravity.sqrt(), &[heading]).unwrap();
    let found = waves.far_field_drift(0, &FIXED).unwrap();
    let force = found.surge.hypot(found.sway);
    assert!((found.sway / found.surge - heading.tan()).abs() < 1e-3, "{found:?}");
    let moment = centre.x * found.sway - centre.y * found.surge;
    assert!((found.yaw - moment).abs() < 5e-3 * force, "{found:?} {moment}");
    assert!(found.energy_residual.abs() < 0.02, "{found:?}");
    assert!(waves.far_field_drift(1, &FIXED).is_none() && waves.far_field_drift(0, &FIXED[..3]).is_none());
}

#[test]
fn control_surface_drift_of_hemisphere_meets_exact_series() {
    // 1.5 % of the largest drift of each column
    let problem = of_hemisphere(14, QUARTER);
    let cylinder = problem.control_cylinder();
    for n in rows(include_str!("../data/hemisphere.csv")).iter().filter(|n| [0.5, 1.0, 1.4, 2.0].contains(&n[0])) {
        let waves = problem.solve_waves((n[0] * WATER.gravity).sqrt(), &[0.0]).unwrap();
        let free = free_motions(&waves.forces, &free_hemisphere()).unwrap();
        for (motions, exact, largest) in [(vec![FIXED.to_vec()], n[9], 0.648), (free, n[10], 0.872)] {
            let found = waves.control_surface_drift(&motions, &ControlSurface::Cylinder(cylinder)).unwrap()[0];
            let surge = found.surge / (WATER.density * WATER.gravity);
            assert!((surge - exact).abs() < 0.015 * largest, "K {}: {surge} for {exact}", n[0]);
        }
    }
    let crossing = ControlCylinder { radius: 0.5, ..cylinder };
    let waves = problem.solve_waves(3.0, &[0.0]).unwrap();
    assert!(waves.control_surface_drift(&[FIXED.to_vec()], &ControlSurface::Cylinder(crossing)).is_none());
}

#[test]
fn elevation_around_bottom_mounted_cylinder_meets_closed_form() {
    // [MACCAMY-FUCHS-1954] at k a = 1: sum e_m i^m (J_m(kr) - J_m'(ka)/H_m'(ka) H_m(kr)) cos m theta; 1 % of the
    // incident wave
    let problem = in_depth(CylinderMesh { draught: 2.0, rows: 20, rings: 0, turns: 12 }.build(), 2.0);
    let (k, radius) = (1.0_f64, 1.5_f64);
    let waves = problem.solve_waves((9.81 * k * (2.0 * k).tanh()).sqrt(), &[0.0]).unwrap();
    let angles = [0.0_f64, 1.0, 2.0, PI];
    let points = angles.map(|angle| [radius * angle.cos(), radius * angle.sin()]);
    let found = waves.elevations(&[FIXED.to_vec()], &points).unwrap();
    let bessel = |m: i32, x: f64| Complex::new(libm::jn(m, x), libm::yn(m, x));
    let slope = |m: i32, x: f64| if m == 0 { -bessel(1, x) } else { (bessel(m - 1, x) - bessel(m + 1, x)) * 0.5 };
    for (angle, found) in angles.into_iter().zip(&found[0]) {
        let exact: Complex<f64> = (0..16)
            .map(|m| {
                let scattered = bessel(m, k * radius) * (slope(m, k).re / slope(m, k));
                let own = (Complex::from(bessel(m, k * radius).re) - scattered) * (f64::from(m) * angle).cos();
                own * Complex::i().powi(m) * if m == 0 { 1.0 } else { 2.0 }
            })
            .sum();
        assert!((found - exact).norm() < 0.01, "{angle}: {found} for {exact}");
    }
}

#[test]
fn wave_drift_damping_of_hemisphere_is_derivative_of_exact_drift() {
    // along the waves omega/g (4 F + 2 K dF/dK), across them 2 omega F/g, turned by the heading; dF/dK by differences of five rows of the exact
    // series; 1.5 % of the larger
    let exact = rows(include_str!("../data/hemisphere.csv"));
    let problem = of_hemisphere(20, QUARTER);
    for (k, step) in [(0.5, 0.1), (1.6, 0.2)] {
        let at = |i: i32| {
            let row = exact.iter().find(|n| (n[0] - (k + f64::from(i) * step)).abs() < 1e-9).unwrap();
            row[9]
        };
        let slope = (at(-2) - 8.0 * at(-1) + 8.0 * at(1) - at(2)) / (12.0 * step);
        let omega = (k * WATER.gravity).sqrt();
        let [along, across] = [4.0 * at(0) + 2.0 * k * slope, 2.0 * at(0)].map(|b| b * omega * WATER.density);
        let heading = 0.4_f64;
        let found = problem.wave_drift_damping(omega, heading, |_| Ok(vec![FIXED.to_vec(); 3])).unwrap();
        let (sine, cosine) = heading.sin_cos();
        let expected = [
            [along * cosine * cosine + across * sine * sine, (along - across) * sine * cosine],
            [(along - across) * sine * cosine, along * sine * sine + across * cosine * cosine],
        ];
        for (i, row) in expected.iter().enumerate() {
            for (j, exact) in row.iter().enumerate() {
                let made = found.damping[(i, j)];
                assert!((made - exact).abs() < 0.015 * along, "K {k} {i} {j}: {made} for {exact}");
            }
        }
    }
}
