use nalgebra::{Complex, Vector3};
use std::f64::consts::{FRAC_PI_2, PI};
use windlass_diffraction::{
    DiffractionBody, DiffractionError, DiffractionProblem, FrequencyForces, FrequencyLimit, HullMesh, MirrorPlanes,
    Water,
};

pub const WATER: Water = Water { density: 1000.0, gravity: 9.81, depth: None };
pub const QUARTER: MirrorPlanes = MirrorPlanes { x: true, y: true };

/// Panels of a hemisphere of radius 1: `m` rows, `m` columns a quarter; 4 m2 with their images.
pub fn hemisphere(m: usize, mirrors: MirrorPlanes) -> HullMesh {
    let quarters = 4 / mirrors.images().len();
    let point = |i: usize, j: usize| {
        let (t, p) = (FRAC_PI_2 * i as f64 / m as f64, 2.0 * PI * j as f64 / (4 * m) as f64);
        // the mirror planes pass exactly through the last corners
        let clean = |x: f64| if x.abs() < 1e-15 { 0.0 } else { x };
        Vector3::new(clean(t.cos() * p.cos()), clean(t.cos() * p.sin()), -t.sin())
    };
    let quads: Vec<_> = (0..m)
        .flat_map(|i| {
            (0..quarters * m).map(move |j| [point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)])
        })
        .collect();
    HullMesh::new(&quads, mirrors).unwrap()
}

/// A row of the exact series without unit: K, A11, B11, A33, B33, X1, X3.
struct Exact {
    k: f64,
    matrices: [f64; 4],
    forces: [Complex<f64>; 2],
}

fn exact() -> Vec<Exact> {
    include_str!("../data/hemisphere.csv")
        .lines()
        .skip(2)
        .map(|line| {
            let n: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
            let forces = [Complex::new(n[5], n[6]), Complex::new(n[7], n[8])];
            Exact { k: n[0], matrices: [n[1], n[2], n[3], n[4]], forces }
        })
        .collect()
}

/// A11, B11, A33, B33 over those of the displaced mass of the sphere.
fn without_unit(found: &FrequencyForces) -> [f64; 4] {
    let mass = 2.0 / 3.0 * PI * WATER.density;
    let damping = mass * found.frequency;
    [
        found.added_mass[(0, 0)] / mass,
        found.damping[(0, 0)] / damping,
        found.added_mass[(2, 2)] / mass,
        found.damping[(2, 2)] / damping,
    ]
}

fn solve(problem: &DiffractionProblem, k: f64) -> FrequencyForces {
    problem.solve((k * WATER.gravity).sqrt(), &[0.0]).unwrap()
}

pub fn problem(m: usize, mirrors: MirrorPlanes) -> DiffractionProblem {
    let body = DiffractionBody { mesh: hemisphere(m, mirrors), origin: Vector3::zeros() };
    DiffractionProblem::new(&[body], WATER).unwrap()
}

/// Errors of A and B as shares of the displaced mass, of X by pressure and by Haskind as shares of |X|, and of the phase of either (degrees): the largest each.
fn largest_errors(problem: &DiffractionProblem, most_k: f64) -> [f64; 4] {
    let mut worst = [0.0_f64; 4];
    for row in exact().iter().filter(|row| row.k <= most_k) {
        let found = solve(problem, row.k);
        for (a, b) in without_unit(&found).iter().zip(row.matrices) {
            worst[0] = worst[0].max((a - b).abs());
        }
        for (mode, force) in [0, 2].into_iter().zip(row.forces) {
            for (i, made) in [found.pressure_excitation[0][mode], found.excitation[0][mode]].into_iter().enumerate() {
                let made = made / (WATER.density * WATER.gravity);
                worst[1 + i] = worst[1 + i].max((made - force).norm() / force.norm());
                worst[3] = worst[3].max((made / force).arg().abs().to_degrees());
            }
        }
    }
    worst
}

#[test]
fn hemisphere_of_1600_panels_meets_exact_series() {
    // 0.3 % of the displaced mass, 0.5 % of the forces
    let [matrices, pressure, haskind, phase] = largest_errors(&problem(20, QUARTER), 2.0);
    let said = format!("{matrices} {pressure} {haskind} {phase}");
    assert!(matrices < 0.003 && pressure < 0.005 && haskind < 0.005 && phase < 0.5, "{said}");
}

#[test]
fn hemisphere_of_400_panels_meets_exact_series() {
    // at K = 0.1 A33 is 0.45 % of the displaced mass too small and X1 by Haskind's relation 0.8 %; the panels lie inside of the sphere and
    // enclose 0.8 % less than it. Corners further out, so that they enclose as much, turn the signs: A33 is then 0.43 % too large
    let [matrices, pressure, haskind, phase] = largest_errors(&problem(10, QUARTER), 1.0);
    let said = format!("{matrices} {pressure} {haskind} {phase}");
    assert!(matrices < 0.0045 && pressure < 0.007 && haskind < 0.0085 && phase < 0.5, "{said}");
}

#[test]
fn moment_of_hemisphere_about_point_below_its_middle_is_force_times_arm() {
    // every normal of a sphere goes through its middle
    let body = DiffractionBody { mesh: hemisphere(6, QUARTER), origin: Vector3::new(0.0, 0.0, -0.3) };
    let problem = DiffractionProblem::new(&[body], WATER).unwrap();
    for k in [0.2, 0.5, 1.0] {
        let found = solve(&problem, k);
        for forces in [&found.excitation[0], &found.pressure_excitation[0]] {
            let arm = forces[4] / forces[0];
            assert!((arm - 0.3).norm() < 0.003, "{k}: {arm}");
        }
        // the coupling of pitch and surge too
        let arm = found.added_mass[(4, 0)] / found.added_mass[(0, 0)];
        assert!((arm - 0.3).abs() < 0.003 && found.added_mass[(0, 4)] == found.added_mass[(4, 0)], "{k}: {arm}");
    }
}

#[test]
fn error_of_hemisphere_falls_with_square_of_panel_size() {
    let errors = [5, 10, 20].map(|m| largest_errors(&problem(m, QUARTER), 0.5)[0]);
    for pair in errors.windows(2) {
        let ratio = pair[0] / pair[1];
        assert!((3.6..4.4).contains(&ratio), "{errors:?}");
    }
}

#[test]
fn quarter_with_two_mirror_planes_gives_same_as_whole() {
    let [whole, half, quarter] = [MirrorPlanes::default(), MirrorPlanes { x: false, y: true }, QUARTER]
        .map(|mirrors| solve(&problem(5, mirrors), 0.8));
    for other in [half, quarter] {
        let difference = (&whole.added_mass - &other.added_mass).amax() / whole.added_mass.amax();
        assert!(difference < 1e-6, "{difference:e}");
        for (a, b) in whole.excitation[0].iter().zip(&other.excitation[0]) {
            assert!((a - b).norm() < 1e-6 * whole.excitation[0][2].norm(), "{a} {b}");
        }
    }
}

#[test]
fn damping_of_hemisphere_is_energy_of_radiated_waves() {
    // B33 = k |X3|2/(4 rho g v_g), B11 = k |X1|2/(8 rho g v_g), v_g = g/(2 omega)
    let problem = problem(20, QUARTER);
    for k in [0.3, 1.0, 1.6] {
        let found = solve(&problem, k);
        let group_velocity = WATER.gravity / (2.0 * found.frequency);
        for (mode, share) in [(0, 8.0), (2, 4.0)] {
            let energy =
                k * found.excitation[0][mode].norm_sqr() / (share * WATER.density * WATER.gravity * group_velocity);
            let damping = found.damping[(mode, mode)];
            assert!((energy / damping - 1.0).abs() < 0.005, "{k} {mode}: {energy} {damping}");
        }
    }
}

#[test]
fn added_mass_of_hemisphere_has_exact_limits() {
    // doubled about the mean level it is a sphere: A33 at infinity and A11 at zero are half of the displaced mass; A11 at infinity is 0.2732
    // [HULME-1982]. A33 at zero is that of a sphere whose halves part, with the normal velocity |mu| = sum (2 n + 1) I_n P_n(mu) over even n,
    // I_n = int_0^1 mu P_n dmu: A33/M = 3 sum (2 n + 1) I_n^2/(n + 1)
    let (mut integral, mut parting) = (0.5, 0.0);
    for n in (0..40).step_by(2).map(f64::from) {
        parting += 3.0 * (2.0 * n + 1.0) * integral * integral / (n + 1.0);
        integral *= -(n - 1.0) / (n + 4.0);
    }
    let problem = problem(20, QUARTER);
    let mass = 2.0 / 3.0 * PI * WATER.density;
    let limit = |limit| problem.added_mass_limit(limit).unwrap() / mass;
    let [zero, infinite] = [FrequencyLimit::Zero, FrequencyLimit::Infinite].map(limit);
    for (found, exact) in
        [(infinite[(2, 2)], 0.5), (zero[(0, 0)], 0.5), (infinite[(0, 0)], 0.2732), (zero[(2, 2)], parting)]
    {
        assert!((found - exact).abs() < 0.003, "{found} for {exact}");
    }
}

#[test]
fn added_mass_at_infinity_in_deep_finite_depth_is_that_of_deep_water() {
    let body = |depth: Option<f64>| {
        let body = DiffractionBody { mesh: hemisphere(6, QUARTER), origin: Vector3::zeros() };
        DiffractionProblem::new(&[body], Water { depth, ..WATER }).unwrap()
    };
    let [deep, bounded] =
        [None, Some(12.0)].map(|depth| body(depth).added_mass_limit(FrequencyLimit::Infinite).unwrap());
    let difference = (&deep - &bounded).amax() / deep.amax();
    assert!(difference < 1e-3, "{difference}");
    let refused = body(Some(12.0)).added_mass_limit(FrequencyLimit::Zero).unwrap_err();
    assert_eq!(refused, DiffractionError::ZeroFrequency(12.0));
}
