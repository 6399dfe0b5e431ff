//! Radiation of bodies that were solved together against kernels in closed form.

use nalgebra::{Complex, Matrix6};
use std::f64::consts::PI;
use windlass_hydro::database::Database;
use windlass_hydro::database::radiation::Radiation;

/// A kernel `p(t) exp(-t)`, by the coefficients of p, whose damping at a frequency is given.
struct ClosedForm {
    polynomial: [f64; 4],
    damping: fn(f64) -> f64,
}

/// `2/pi int_0^inf cos(w t)/(1 + w2)^n dw` is `exp(-t)` times 1, (1 + t)/2, (3 + 3 t + t2)/8, (15 + 15 t + 6 t2 + t3)/48 for n = 1 to 4: of
/// `B = w2/(1 + w2)^3` the kernel is `(1 + t - t2)/8 exp(-t)`.
const OWN: ClosedForm =
    ClosedForm { polynomial: [0.125, 0.125, -0.125, 0.0], damping: |w| w * w / (1.0 + w * w).powi(3) };
/// Of `B = -0.6 w2 (1 - w2)/(1 + w2)^4`, which is never above that of the bodies themselves, `-0.6 (3 t2 - t3)/24 exp(-t)`.
const COUPLING: ClosedForm = ClosedForm {
    polynomial: [0.0, 0.0, -0.075, 0.025],
    damping: |w| -0.6 * w * w * (1.0 - w * w) / (1.0 + w * w).powi(4),
};

impl ClosedForm {
    fn kernel(&self, t: f64) -> f64 {
        self.polynomial.iter().rev().fold(0.0, |sum, c| sum * t + c) * (-t).exp()
    }

    /// `-1/w int_0^inf K(t) sin(w t) dt`, with `int t^n exp(-t) exp(i w t) dt = n!/(1 - i w)^(n + 1)`.
    fn added_mass_above_infinite(&self, w: f64) -> f64 {
        let over = Complex::new(1.0, -w).inv();
        let mut term = over;
        let mut sum = Complex::new(0.0, 0.0);
        for (n, coefficient) in self.polynomial.iter().enumerate() {
            sum += term * *coefficient;
            term *= over * (n + 1) as f64;
        }
        -sum.im / w
    }

    /// In sway alone, with a limit of added mass.
    fn database(&self, last: i32, infinite: f64) -> Database {
        let matrix = |value: f64| {
            let mut made = Matrix6::zeros();
            made[(1, 1)] = value;
            made
        };
        let frequencies: Vec<f64> = (1..=last).map(|n| 0.1 * f64::from(n)).collect();
        Database {
            source: "two bodies".into(),
            added_mass: frequencies.iter().map(|w| matrix(infinite + self.added_mass_above_infinite(*w))).collect(),
            damping: frequencies.iter().map(|w| matrix((self.damping)(*w))).collect(),
            infinite: Some(matrix(infinite)),
            frequencies,
            ..Database::default()
        }
    }
}

#[test]
fn kernels_between_bodies_are_found_from_frequencies_that_end_early() {
    // up to 1 rad/s, where the bodies themselves have 84 % of their largest damping; of the largest of each. With damping that is straight between
    // frequencies and falls as 1/w3 from the last, the kernel of the coupling was wrong by 81 %, its added mass by 8 %
    let database = |row: usize, column: usize| Some(form(row, column).0.database(10, form(row, column).1));
    let made = Radiation::of_bodies(2, database);
    for (pair, radiation) in made.iter().enumerate() {
        let (radiation, (form, infinite)) = (radiation.as_ref().unwrap(), form(pair / 2, pair % 2));
        let off = |places: &[f64], exact: &dyn Fn(f64) -> f64, found: &dyn Fn(f64) -> f64| {
            let largest = places.iter().map(|x| exact(*x).abs()).fold(0.0, f64::max);
            places.iter().map(|x| (found(*x) - exact(*x)).abs()).fold(0.0, f64::max) / largest
        };
        let frequencies: Vec<f64> = (1..=10).map(|n| 0.1 * f64::from(n)).collect();
        let times: Vec<f64> = (0..80).map(|n| 0.1 * f64::from(n)).collect();
        let added = off(&frequencies, &|w| form.added_mass_above_infinite(w), &|w| {
            radiation.added_mass_at(w)[(1, 1)] - infinite
        });
        let kernel = off(&times, &|t| form.kernel(t), &|t| radiation.kernel_at(t)[(1, 1)]);
        assert!(added < 0.05 && kernel < 0.05, "{pair}: {added} {kernel}");
    }
}

/// The radiation of a pair of bodies, and its limit of added mass.
fn form(row: usize, column: usize) -> (&'static ClosedForm, f64) {
    if row == column { (&OWN, 1.0) } else { (&COUPLING, 0.2) }
}

#[test]
fn tails_of_bodies_together_give_no_energy() {
    // a coupling of -1.2 times the damping of the bodies themselves, which no water has: beyond the last frequency it is cut to -1, so that of
    // motions alike nothing is left. By K(0) = 2/pi int B dw the sum of the kernels at no lag is then that of the frequencies that are given, and of
    // what goes on from the last of them as w^-7
    let given = |row: usize, column: usize| {
        let mut data = OWN.database(10, 1.0);
        if row != column {
            data.added_mass.iter_mut().chain(&mut data.damping).for_each(|m| *m *= -1.2);
            data.infinite = data.infinite.map(|m| m * -1.2);
        }
        Some(data)
    };
    let made = Radiation::of_bodies(2, given);
    let at_once = |pair: usize| made[pair].as_ref().unwrap().kernel_at(0.0)[(1, 1)];
    let sum: f64 = (0..4).map(at_once).sum();
    // int_0^1 w2/(1 + w2)^3 dw = pi/32, and 1/8 of int_1^inf w^-7 dw
    let inside = 2.0 * (1.0 - 1.2) * 2.0 / PI * (PI / 32.0 + 1.0 / 48.0);
    assert!((sum - inside).abs() < 0.05 * inside.abs(), "{sum} {inside}");
}
