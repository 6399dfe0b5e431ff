use super::*;

fn bathymetry(x: &[f64], y: &[f64], height: impl Fn(f64, f64) -> f64) -> Bathymetry {
    let heights: Vec<f64> = y.iter().flat_map(|y| x.iter().map(|x| height(*x, *y)).collect::<Vec<_>>()).collect();
    Bathymetry::new("B", x.to_vec(), y.to_vec(), &heights, Span::default()).unwrap()
}

const X: [f64; 5] = [-300.0, -120.0, 10.0, 55.0, 400.0];
const Y: [f64; 4] = [-200.0, -90.0, 30.0, 260.0];

#[test]
fn quadratic_surface_is_interpolated_exactly_with_slopes() {
    let height = |x: f64, y: f64| {
        -500.0 + 0.1 * x - 0.05 * y + 2e-4 * x * x - 3e-4 * y * y + 1e-4 * x * y + 2e-9 * x * x * y * y
    };
    let bottom = bathymetry(&X, &Y, height);
    for i in 0..40 {
        for j in 0..30 {
            let (x, y) = (-300.0 + 700.0 * f64::from(i) / 39.0, -200.0 + 460.0 * f64::from(j) / 29.0);
            let (z, [zx, zy]) = bottom.elevation_and_slopes(x, y);
            let wanted = [0.1 + 4e-4 * x + 1e-4 * y + 4e-9 * x * y * y, -0.05 - 6e-4 * y + 1e-4 * x + 4e-9 * x * x * y];
            // rounding of heights of 500 m over steps of 45 m
            assert!((z - height(x, y)).abs() < 1e-10, "{x} {y}: {z}");
            assert!((zx - wanted[0]).abs() < 1e-11 && (zy - wanted[1]).abs() < 1e-11, "{x} {y}: {zx} {zy}");
        }
    }
}

#[test]
fn slopes_match_finite_differences_of_depth_and_are_continuous() {
    let bottom = bathymetry(&X, &Y, |x, y| -100.0 + 20.0 * (x / 90.0).sin() * (y / 70.0).cos());
    let step = 1e-4;
    for i in 0..50 {
        for j in 0..50 {
            let (x, y) = (-299.0 + 698.0 * f64::from(i) / 49.0, -199.0 + 458.0 * f64::from(j) / 49.0);
            let (_, [zx, zy]) = bottom.elevation_and_slopes(x, y);
            let by_x = (bottom.elevation_and_slopes(x + step, y).0 - bottom.elevation_and_slopes(x - step, y).0)
                / (2.0 * step);
            let by_y = (bottom.elevation_and_slopes(x, y + step).0 - bottom.elevation_and_slopes(x, y - step).0)
                / (2.0 * step);
            // rounding of 100 m over 2e-4 m is 7e-11; curvature is below 0.02/m
            assert!((zx - by_x).abs() < 1e-8 && (zy - by_y).abs() < 1e-8, "{x} {y}");
        }
    }
    // across the lines of the grid: 1e-9 m times the curvature
    for (a, b) in [((10.0, 77.0), (1e-9, 0.0)), ((200.0, 30.0), (0.0, 1e-9)), ((55.0, -90.0), (1e-9, 1e-9))] {
        let (one, other) =
            (bottom.elevation_and_slopes(a.0 - b.0, a.1 - b.1), bottom.elevation_and_slopes(a.0 + b.0, a.1 + b.1));
        assert!((one.0 - other.0).abs() < 1e-8, "{a:?}");
        assert!((0..2).all(|i| (one.1[i] - other.1[i]).abs() < 1e-8), "{a:?}: {one:?} {other:?}");
    }
}

#[test]
fn four_corners_give_a_plane_constant_beyond_its_edges() {
    let bottom = bathymetry(&[0.0, 100.0], &[0.0, 50.0], |x, y| -20.0 - 0.1 * x + 0.2 * y);
    let near = |found: (f64, [f64; 2]), z: f64, slopes: [f64; 2]| {
        assert!((found.0 - z).abs() < 1e-12, "{found:?}");
        assert!((0..2).all(|i| (found.1[i] - slopes[i]).abs() < 1e-13), "{found:?}");
    };
    near(bottom.elevation_and_slopes(30.0, 20.0), -19.0, [-0.1, 0.2]);
    near(bottom.elevation_and_slopes(100.0, 50.0), -20.0, [-0.1, 0.2]);
    near(bottom.elevation_and_slopes(1e6, 20.0), -26.0, [0.0, 0.2]);
    near(bottom.elevation_and_slopes(30.0, -1e6), -23.0, [-0.1, 0.0]);
    near(bottom.elevation_and_slopes(-7.0, 51.0), -10.0, [0.0, 0.0]);
    assert!(bottom.elevation_and_slopes(f64::NAN, 1.0).0.is_nan());
}

#[test]
fn smooth_bathymetry_converges_with_third_order() {
    // Bessel's slopes are off by h^2 z'''/6 at most, and so the surface by h^3 between the points [DEBOOR-1978 IV]
    let height = |x: f64, y: f64| (x / 50.0).sin() + (y / 40.0).cos() * (x / 80.0).cos();
    let error = |count: u32| {
        let positions: Vec<f64> = (0..=count).map(|i| 200.0 * f64::from(i) / f64::from(count)).collect();
        let bottom = bathymetry(&positions, &positions, height);
        let off = |i: u32| {
            let at = (200.0 * (f64::from(i) * 0.618_034).fract(), 200.0 * (f64::from(i) * 0.754_878).fract());
            (bottom.elevation_and_slopes(at.0, at.1).0 - height(at.0, at.1)).abs()
        };
        (0..3000).map(off).fold(0.0, f64::max)
    };
    let (coarse, fine) = (error(20), error(40));
    assert!(coarse < 3e-3 && coarse / fine > 6.5, "{coarse} {fine}");
}

#[test]
fn point_file_gives_same_bathymetry_in_any_order() {
    let height = |x: f64, y: f64| -80.0 + 0.02 * x + (y / 60.0).sin();
    let mut points: Vec<[f64; 3]> = X.iter().flat_map(|x| Y.iter().map(|y| [*x, *y, height(*x, *y)])).collect();
    points.reverse();
    points.swap(3, 11);
    assert_eq!(Bathymetry::from_points("B", points, Span::default()).unwrap(), bathymetry(&X, &Y, height));
}

#[test]
fn invalid_bathymetry_is_refused_with_reason() {
    let new = |x: &[f64], y: &[f64], z: &[f64]| {
        Bathymetry::new("B", x.to_vec(), y.to_vec(), z, Span::default()).unwrap_err().to_string()
    };
    assert!(new(&[0.0], &[0.0, 1.0], &[0.0; 2]).contains("at least two different x"));
    assert!(new(&[0.0, 1.0], &[], &[]).contains("at least two different y"));
    assert!(new(&[0.0, 1.0], &[1.0, 0.0], &[0.0; 4]).contains("y of the bottom must grow: 0 m follows 1 m"));
    assert!(new(&[0.0, 0.0], &[0.0, 1.0], &[0.0; 4]).contains("x of the bottom must grow"));
    assert!(new(&[0.0, f64::NAN], &[0.0, 1.0], &[0.0; 4]).contains("x of the bottom must grow"));
    assert!(new(&[0.0, 1.0], &[0.0, 1.0], &[0.0; 3]).contains("have 4 heights, not 3"));
    assert!(new(&[0.0, 1.0], &[0.0, 1.0], &[0.0, 0.0, f64::INFINITY, 0.0]).contains("not finite"));
    let many: Vec<f64> = (0..3000).map(f64::from).collect();
    assert!(new(&many, &many, &[]).contains("3000 by 3000 points asks for 288 MB"));
    assert!(fits(usize::MAX, 3).is_err());
    let of =
        |points: &[[f64; 3]]| Bathymetry::from_points("B", points.to_vec(), Span::default()).unwrap_err().to_string();
    let hole = of(&[[0.0, 0.0, -1.0], [1.0, 0.0, -1.0], [0.0, 1.0, -1.0]]);
    assert!(hole.contains("3 points with 2 different x and 2 different y make no grid"), "{hole}");
    let inner = of(&[[0.0, 0.0, 1.0], [0.0, 1.0, 1.0], [1.0, 1.0, 1.0]]);
    assert!(inner.contains("without a height is x = 1 m, y = 0 m"), "{inner}");
    assert!(of(&[[0.0, 0.0, -1.0], [0.0, 0.0, -2.0]]).contains("given twice: -1 m and -2 m"));
    assert!(of(&[[0.0, 0.0, f64::NAN]]).contains("not finite"));
}

#[test]
fn bathymetry_reports_extent_size_and_depths() {
    let bottom = bathymetry(&X, &Y, |x, _| -100.0 + 0.1 * x);
    assert_eq!(bottom.extent(), [[-300.0, 400.0], [-200.0, 260.0]]);
    assert_eq!((bottom.size(), bottom.heights()), ([5, 4], [-130.0, -60.0]));
}
