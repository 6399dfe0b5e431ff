//! Wave numbers of a frequency in water of finite depth.

use std::f64::consts::PI;

/// Steps of Newton's iteration; each root needs fewer.
const MAX_STEPS: usize = 60;

/// The wave number `k` (1/m) with `k tanh(k h) = nu` for `nu = omega2/g` (1/m) and the depth `h` (m).
pub fn wave_number(nu: f64, depth: f64) -> f64 {
    let target = nu * depth;
    // from above on the side where the function is convex
    let mut kh = if target > 1.0 { target } else { target.sqrt() };
    for _ in 0..MAX_STEPS {
        let tanh = kh.tanh();
        let step = (kh * tanh - target) / (tanh + kh * (1.0 - tanh * tanh));
        kh -= step;
        if step.abs() <= 1e-15 * kh {
            break;
        }
    }
    kh / depth
}

/// The evanescent wave number `k_n` (1/m), n >= 1, with `k_n tan(k_n h) = -nu`, between `(n - 1/2) pi/h` and `n pi/h`.
pub fn evanescent_wave_number(nu: f64, depth: f64, n: usize) -> f64 {
    let target = nu * depth;
    let most = n as f64 * PI;
    // x = n pi - y, tan y = target/x
    let mut y = (target / most).atan();
    for _ in 0..MAX_STEPS {
        let x = most - y;
        let residual = y - (target / x).atan();
        let step = residual / (1.0 - target / (x * x + target * target));
        y -= step;
        if step.abs() <= 1e-15 * most {
            break;
        }
    }
    (most - y) / depth
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn wave_numbers_satisfy_dispersion_relations() {
        for nu in [1e-4, 0.03, 1.0, 4.0, 30.0] {
            for depth in [0.5, 2.0, 40.0] {
                let k = wave_number(nu, depth);
                assert!((k * (k * depth).tanh() / nu - 1.0).abs() < 1e-12, "{nu} {depth} {k}");
                for n in [1, 2, 10, 80] {
                    let k = evanescent_wave_number(nu, depth, n);
                    let error = k * (k * depth).sin() + nu * (k * depth).cos();
                    assert!(error.abs() < 1e-11 * (k + nu), "{nu} {depth} {n} {error}");
                    let low = (n as f64 - 0.5) * PI / depth;
                    assert!(k > low && k <= n as f64 * PI / depth);
                }
            }
        }
    }
}
