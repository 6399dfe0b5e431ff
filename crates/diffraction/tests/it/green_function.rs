use windlass_diffraction::green::{FiniteDepthTable, WavePartTable, integrate_wave_part};

/// The rows of a table behind its two heading lines.
fn rows<const N: usize>(text: &str) -> Vec<[f64; N]> {
    text.lines()
        .skip(2)
        .map(|line| {
            let numbers: Vec<f64> = line.split(',').map(|word| word.parse().unwrap()).collect();
            numbers.try_into().unwrap()
        })
        .collect()
}

#[test]
fn deep_water_table_matches_independent_quadrature() {
    let table = WavePartTable::shared();
    let rows = rows(include_str!("../data/green_deep_water.csv"));
    assert_eq!(rows.len(), 40);
    for [x, y, re, im, re_by_x, im_by_x] in rows {
        let found = table.evaluate(x, y);
        let scale = 1.0_f64.max(1.0 / x.hypot(y));
        for (a, b, scale) in [
            (found.value.re, re, 1.0),
            (found.value.im, im, 1.0),
            (found.by_x.re, re_by_x, scale),
            (found.by_x.im, im_by_x, 1.0),
        ] {
            assert!((a - b).abs() < 1e-6 * scale, "X {x}, Y {y}: {a} for {b}, {:e}", (a - b).abs());
        }
    }
}

#[test]
fn deep_water_table_matches_quadrature_over_whole_domain() {
    let table = WavePartTable::shared();
    let (mut worst, mut worst_by_x) = (0.0_f64, 0.0_f64);
    for i in 0..160 {
        for j in 0..160 {
            // 1e-3 to 100 and 1e-4 to 40
            let (x, y) = (10_f64.powf(-3.0 + 5.0 * i as f64 / 159.0), 10_f64.powf(-4.0 + 5.6 * j as f64 / 159.0));
            let (found, exact) = (table.evaluate(x, y), integrate_wave_part(x, y));
            let scale = 1.0_f64.max(1.0 / x.hypot(y));
            worst = worst.max((found.value - exact.value).norm());
            worst_by_x = worst_by_x.max((found.by_x - exact.by_x).norm() / scale);
        }
    }
    assert!(worst < 1e-6 && worst_by_x < 1e-6, "{worst:e} {worst_by_x:e}");
}

#[test]
fn finite_depth_table_matches_eigenfunction_series() {
    let rows = rows(include_str!("../data/green_finite_depth.csv"));
    assert_eq!(rows.len(), 24);
    for [nu, r, z, source, re, im, re_by_r, im_by_r] in rows {
        let table = FiniteDepthTable::new(nu, 1.0, 10.5, 1.0);
        let found = table.evaluate(WavePartTable::shared(), r, [z, source]);
        let (mut value, mut by_r) = (found.value.re, found.by_distance.re);
        for height in [z - source, z + source, z + source + 2.0] {
            let over = 1.0 / r.hypot(height);
            value += over;
            by_r -= r * over.powi(3);
        }
        for (a, b, tolerance) in [
            (value, re, 1e-6),
            (found.value.im, im, 1e-6),
            (by_r, re_by_r, 1e-5),
            (found.by_distance.im, im_by_r, 1e-5),
        ] {
            assert!((a - b).abs() < tolerance, "nu {nu}, R {r}: {a} for {b}, {:e}", a - b);
        }
    }
}

#[test]
fn far_away_the_propagating_wave_follows_on_the_table() {
    // the table ends at twelve depths; the value changes over 2e-9 by less than its slope times that
    for nu in [0.02, 0.5, 2.0, 8.0, 40.0] {
        let table = FiniteDepthTable::new(nu, 1.0, 30.0, 1.0);
        for heights in [[0.0, -0.3], [-0.9, -0.2], [-0.5, -0.5]] {
            let [near, far] = [12.0 - 1e-9, 12.0 + 1e-9].map(|r| table.evaluate(WavePartTable::shared(), r, heights));
            let pairs = [
                (near.value, far.value),
                (near.by_distance, far.by_distance),
                (near.by_heights[0], far.by_heights[0]),
                (near.by_heights[1], far.by_heights[1]),
            ];
            // tables are good to 1e-6 of nu for the value and nu^2 for derivatives
            for ((a, b), order) in pairs.into_iter().zip([1, 2, 2, 2]) {
                assert!((a - b).norm() < 4e-6 * nu.max(1.0_f64).powi(order), "nu {nu} {heights:?}: {a} {b}");
            }
        }
    }
}
