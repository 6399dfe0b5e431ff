//! Gauss's rule of quadrature.

use std::f64::consts::PI;

/// Newton's iteration of a root of a Legendre polynomial ends after so many steps; three are enough in double precision.
const MAX_ROOT_STEPS: usize = 20;

/// Points and weights of Gauss's rule on [-1, 1] [ABRAMOWITZ-STEGUN 25.4.29].
#[derive(Clone, Debug)]
pub struct GaussRule {
    points: Vec<(f64, f64)>,
}

impl GaussRule {
    /// The rule of `count` points, exact for polynomials up to degree `2 count - 1`.
    pub fn new(count: usize) -> Self {
        let degree = count as f64;
        let points = (0..count)
            .map(|i| {
                let slope = |x: f64| {
                    let (value, before) = legendre(count, x);
                    (value, degree * (x * value - before) / (x * x - 1.0))
                };
                let mut x = (PI * (i as f64 + 0.75) / (degree + 0.5)).cos();
                for _ in 0..MAX_ROOT_STEPS {
                    let (value, by_x) = slope(x);
                    x -= value / by_x;
                    if (value / by_x).abs() < 1e-15 {
                        break;
                    }
                }
                let (_, slope) = slope(x);
                (x, 2.0 / ((1.0 - x * x) * slope * slope))
            })
            .collect();
        GaussRule { points }
    }

    /// Points and weights between two limits.
    pub fn between(&self, low: f64, high: f64) -> impl Iterator<Item = (f64, f64)> + '_ {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        self.points.iter().map(move |(x, weight)| (middle + half * x, half * weight))
    }
}

/// Legendre's polynomials of degree `degree` and of one less.
fn legendre(degree: usize, x: f64) -> (f64, f64) {
    let (mut value, mut before) = (x, 1.0);
    for n in 2..=degree {
        let n = n as f64;
        (value, before) = (((2.0 * n - 1.0) * x * value - (n - 1.0) * before) / n, value);
    }
    (value, before)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn gauss_rule_of_three_points_is_that_of_tables() {
        let rule: Vec<_> = GaussRule::new(3).between(-1.0, 1.0).collect();
        let root = 0.6_f64.sqrt();
        for ((x, w), (x0, w0)) in rule.into_iter().zip([(root, 5.0 / 9.0), (0.0, 8.0 / 9.0), (-root, 5.0 / 9.0)]) {
            assert!((x - x0).abs() < 1e-15 && (w - w0).abs() < 1e-15, "{x} {w}");
        }
    }
}
