//! The angle between two directions: its energy, force and stiffness.

use nalgebra::{Matrix3, Vector3};

/// How the square of the angle between two directions follows c = cos phi.
pub(super) struct BendSlopes {
    /// d(phi^2 / 2)/dc.
    pub first: f64,
    /// Its derivative by c.
    pub second: f64,
    /// phi / sin phi with its first and second derivatives by c.
    pub ratio: [f64; 3],
}

/// The slopes at an angle given by its sine and cosine; series where the sine loses its figures.
#[inline]
pub(super) fn bend_slopes(sine: f64, c: f64) -> BendSlopes {
    let angle = sine.atan2(c);
    let square = angle * angle;
    let (ratio, second) = if angle < 0.02 {
        (1.0 + square / 6.0, 1.0 / 3.0 + 2.0 / 15.0 * square)
    } else {
        (angle / sine, (1.0 - angle * c / sine) / (sine * sine))
    };
    // the third loses five powers of the angle
    let third = if angle < 0.1 {
        4.0 / 15.0 + square * 6.0 / 35.0
    } else {
        (angle * (1.0 + 2.0 * c * c) - 3.0 * sine * c) / sine.powi(5)
    };
    BendSlopes { first: -ratio, second, ratio: [ratio, -second, third] }
}

/// A hinge between two edges at their actual shape: energy 1/2 k phi^2 of the angle phi between them.
pub(super) struct Hinge {
    /// The angle (rad).
    pub angle: f64,
    /// d(energy)/d(first edge) and d(energy)/d(second edge) (N).
    pub gradient: [Vector3<f64>; 2],
    /// Second derivatives: first-first, first-second, second-second (N/m).
    pub curvature: [Matrix3<f64>; 3],
}

/// The hinge of stiffness `k` (N m) between edges of directions `e`, `f` (unit) and lengths `le`, `lf` (m).
///
/// With c = cos phi = e.f, all derivatives go through c: dc/de = (f - c e)/le.
#[inline]
pub(super) fn hinge(k: f64, e: &Vector3<f64>, le: f64, f: &Vector3<f64>, lf: f64) -> Hinge {
    let c = e.dot(f);
    let (across_e, across_f) = (f - e * c, e - f * c);
    let sine = across_e.norm();
    let angle = sine.atan2(c);
    let slopes = bend_slopes(sine, c);
    let (first, second) = (k * slopes.first, k * slopes.second);
    let (de, df) = (across_e / le, across_f / lf);
    let unit = Matrix3::identity();
    let (ee, ff, ef) = (e * e.transpose(), f * f.transpose(), e * f.transpose());
    let cee = (ee * (3.0 * c) - ef - ef.transpose() - unit * c) / (le * le);
    let cff = (ff * (3.0 * c) - ef - ef.transpose() - unit * c) / (lf * lf);
    // d2c/(de df): rows by e, columns by f
    let cef = (unit - ee - ff + ef * c) / (le * lf);
    Hinge {
        angle,
        gradient: [de * first, df * first],
        curvature: [
            de * de.transpose() * second + cee * first,
            de * df.transpose() * second + cef * first,
            df * df.transpose() * second + cff * first,
        ],
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gradient(e: Vector3<f64>, f: Vector3<f64>) -> [Vector3<f64>; 2] {
        hinge(2.0, &e.normalize(), e.norm(), &f.normalize(), f.norm()).gradient
    }

    #[test]
    fn hinge_stiffness_matches_force_finite_difference() {
        let h = 1e-6;
        for f in [Vector3::new(1.0, 0.4, -0.3), Vector3::new(-0.5, 1.0, 0.2), Vector3::new(1.0, 0.005, 0.01)] {
            let e = Vector3::new(1.3, 0.0, 0.0);
            let whole = hinge(2.0, &e.normalize(), e.norm(), &f.normalize(), f.norm());
            for i in 0..3 {
                let mut step = Vector3::zeros();
                step[i] = h;
                let by_e = (gradient(e + step, f)[0] - gradient(e - step, f)[0]) / (2.0 * h);
                let by_f = (gradient(e, f + step)[1] - gradient(e, f - step)[1]) / (2.0 * h);
                let mixed = (gradient(e, f + step)[0] - gradient(e, f - step)[0]) / (2.0 * h);
                // central differences of numbers of order one; the series is cut at the fourth power of 0.02
                assert!((by_e - whole.curvature[0].column(i)).norm() < 1e-7);
                assert!((by_f - whole.curvature[2].column(i)).norm() < 1e-7);
                assert!((mixed - whole.curvature[1].column(i)).norm() < 1e-7);
            }
        }
    }

    #[test]
    fn hinge_force_matches_energy_finite_difference() {
        let (e, f, h) = (Vector3::new(1.3, 0.1, 0.0), Vector3::new(0.2, 1.0, 0.5), 1e-6);
        let energy = |e: Vector3<f64>, f: Vector3<f64>| e.angle(&f).powi(2);
        for i in 0..3 {
            let mut step = Vector3::zeros();
            step[i] = h;
            let by_e = (energy(e + step, f) - energy(e - step, f)) / (2.0 * h);
            let by_f = (energy(e, f + step) - energy(e, f - step)) / (2.0 * h);
            // central differences of numbers of order one
            assert!((gradient(e, f)[0][i] - by_e).abs() < 1e-8);
            assert!((gradient(e, f)[1][i] - by_f).abs() < 1e-8);
        }
    }
}
