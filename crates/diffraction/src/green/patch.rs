//! Polynomials in one and two variables on a patch, fitted at Chebyshev's points.

use std::f64::consts::PI;

/// Coefficients of a polynomial in one variable: its degree is nine.
pub const TERMS: usize = 10;

/// Arguments that are worked on side by side in vector registers.
pub const LANES: usize = 16;
/// Coefficients below it are left out: of a hundred less than a tenth of what the tables are good for.
const NEGLIGIBLE: f64 = 1e-9;

/// A polynomial on an interval.
#[derive(Clone, Copy, Debug)]
pub struct Interval {
    middle: f64,
    over_half: f64,
    terms: [f64; TERMS],
}

impl Interval {
    /// Fits a function on an interval.
    pub fn fit([low, high]: [f64; 2], function: impl Fn(f64) -> f64) -> Self {
        let (middle, half) = (0.5 * (low + high), 0.5 * (high - low));
        Interval { middle, over_half: 1.0 / half, terms: fit_powers(|t| function(middle + half * t)) }
    }

    /// The polynomial at an argument.
    pub fn evaluate(&self, x: f64) -> f64 {
        horner(&self.terms, (x - self.middle) * self.over_half)
    }

    /// The polynomial at several arguments; each product and its sum are rounded once.
    #[inline(always)]
    pub fn evaluate_lanes(&self, x: &[f64; LANES]) -> [f64; LANES] {
        let mut sums = [0.0_f64; LANES];
        for term in self.terms.iter().rev() {
            for (sum, x) in sums.iter_mut().zip(x) {
                *sum = sum.mul_add((x - self.middle) * self.over_half, *term);
            }
        }
        sums
    }
}

/// `F` functions of two variables on a rectangle, as a polynomial each.
#[derive(Clone, Debug)]
pub struct Patch<const F: usize> {
    middle: [f64; 2],
    over_half: [f64; 2],
    /// By powers of the first variable, then of the second; the functions side by side.
    terms: [[[f64; F]; TERMS]; TERMS],
    /// Of each power of the first variable: so many powers of the second have a coefficient.
    lengths: [usize; TERMS],
}

impl<const F: usize> Patch<F> {
    /// Fits functions on a rectangle by their values at the points of a grid.
    pub fn fit(first: [f64; 2], second: [f64; 2], function: impl Fn(f64, f64) -> [f64; F]) -> Self {
        Self::fit_rows(first, second, |x, points| points.map(|y| function(x, y)))
    }

    /// The same by rows: all values of the second variable at one of the first.
    pub fn fit_rows(first: [f64; 2], second: [f64; 2], row: impl Fn(f64, [f64; TERMS]) -> [[f64; F]; TERMS]) -> Self {
        let middle = [0.5 * (first[0] + first[1]), 0.5 * (second[0] + second[1])];
        let half = [0.5 * (first[1] - first[0]), 0.5 * (second[1] - second[0])];
        let nodes = chebyshev_points();
        let across = nodes.map(|t| middle[1] + half[1] * t);
        let values = nodes.map(|s| row(middle[0] + half[0] * s, across));
        let mut terms = [[[0.0; F]; TERMS]; TERMS];
        for which in 0..F {
            let rows = values.map(|row| chebyshev_from_values(row.map(|functions| functions[which])));
            let mut shares = [[0.0; TERMS]; TERMS];
            for j in 0..TERMS {
                for (i, share) in chebyshev_from_values(rows.map(|row| row[j])).into_iter().enumerate() {
                    shares[i][j] = if share.abs() < NEGLIGIBLE { 0.0 } else { share };
                }
            }
            let rows = shares.map(powers_from_chebyshev);
            for j in 0..TERMS {
                let column = powers_from_chebyshev(rows.map(|row| row[j]));
                for (i, term) in column.into_iter().enumerate() {
                    terms[i][j][which] = term;
                }
            }
        }
        let lengths = terms.map(|row| TERMS - row.iter().rev().take_while(|term| **term == [0.0; F]).count());
        Patch { middle, over_half: half.map(|h| 1.0 / h), terms, lengths }
    }

    /// The functions at a point.
    pub fn evaluate(&self, first: f64, second: f64) -> [f64; F] {
        let s = (first - self.middle[0]) * self.over_half[0];
        let t = (second - self.middle[1]) * self.over_half[1];
        let mut sum = [0.0; F];
        for (row, length) in self.terms.iter().zip(self.lengths).rev() {
            let mut inner = [0.0; F];
            for term in row[..length].iter().rev() {
                for (value, term) in inner.iter_mut().zip(term) {
                    *value = *value * t + term;
                }
            }
            for (value, inner) in sum.iter_mut().zip(inner) {
                *value = *value * s + inner;
            }
        }
        sum
    }
}

impl<const F: usize> Patch<F> {
    /// The functions at a point, and their derivatives by the first and by the second variable.
    pub fn evaluate_with_slopes(&self, first: f64, second: f64) -> [[f64; F]; 3] {
        let s = (first - self.middle[0]) * self.over_half[0];
        let t = (second - self.middle[1]) * self.over_half[1];
        let [mut sum, mut by_first, mut by_second] = [[0.0; F]; 3];
        for (row, length) in self.terms.iter().zip(self.lengths).rev() {
            let [mut inner, mut slope] = [[0.0; F]; 2];
            for term in row[..length].iter().rev() {
                for which in 0..F {
                    slope[which] = slope[which] * t + inner[which];
                    inner[which] = inner[which] * t + term[which];
                }
            }
            for which in 0..F {
                by_first[which] = by_first[which] * s + sum[which];
                sum[which] = sum[which] * s + inner[which];
                by_second[which] = by_second[which] * s + slope[which];
            }
        }
        [sum, by_first.map(|v| v * self.over_half[0]), by_second.map(|v| v * self.over_half[1])]
    }

    /// The functions at several points; each product and its sum are rounded once.
    #[inline(always)]
    pub fn evaluate_lanes(&self, first: &[f64; LANES], second: &[f64; LANES]) -> [[f64; LANES]; F] {
        let s = first.map(|x| (x - self.middle[0]) * self.over_half[0]);
        let t = second.map(|y| (y - self.middle[1]) * self.over_half[1]);
        let mut sums = [[0.0_f64; LANES]; F];
        for (row, length) in self.terms.iter().zip(self.lengths).rev() {
            let mut inner = [[0.0_f64; LANES]; F];
            for term in row[..length].iter().rev() {
                for (values, term) in inner.iter_mut().zip(term) {
                    for (value, t) in values.iter_mut().zip(&t) {
                        *value = value.mul_add(*t, *term);
                    }
                }
            }
            for (values, inner) in sums.iter_mut().zip(&inner) {
                for ((value, inner), s) in values.iter_mut().zip(inner).zip(&s) {
                    *value = value.mul_add(*s, *inner);
                }
            }
        }
        sums
    }
}

/// Chebyshev's points of the first kind on [-1, 1].
fn chebyshev_points() -> [f64; TERMS] {
    std::array::from_fn(|i| (PI * (i as f64 + 0.5) / TERMS as f64).cos())
}

/// The powers of a function on [-1, 1].
fn fit_powers(function: impl Fn(f64) -> f64) -> [f64; TERMS] {
    powers_from_chebyshev(chebyshev_from_values(chebyshev_points().map(function)))
}

/// The coefficients of Chebyshev's polynomials through values at Chebyshev's points.
fn chebyshev_from_values(values: [f64; TERMS]) -> [f64; TERMS] {
    let count = TERMS as f64;
    std::array::from_fn(|n| {
        let share = if n == 0 { 1.0 } else { 2.0 } / count;
        share * (0..TERMS).map(|i| values[i] * (PI * n as f64 * (i as f64 + 0.5) / count).cos()).sum::<f64>()
    })
}

/// The coefficients of the powers of a sum of Chebyshev's polynomials.
fn powers_from_chebyshev(chebyshev: [f64; TERMS]) -> [f64; TERMS] {
    // T(n+1) = 2 t T(n) - T(n-1), in powers of t
    let (mut before, mut own) = ([0.0; TERMS], [0.0; TERMS]);
    before[0] = 1.0;
    own[1] = 1.0;
    let mut powers = [0.0; TERMS];
    powers[0] = chebyshev[0];
    for (n, coefficient) in chebyshev.iter().enumerate().skip(1) {
        for (power, term) in powers.iter_mut().zip(own) {
            *power += coefficient * term;
        }
        if n + 1 < TERMS {
            let mut next = [0.0; TERMS];
            for i in 0..TERMS {
                next[i] = if i > 0 { 2.0 * own[i - 1] } else { 0.0 } - before[i];
            }
            (before, own) = (own, next);
        }
    }
    powers
}

fn horner(terms: &[f64; TERMS], t: f64) -> f64 {
    terms.iter().rev().fold(0.0, |sum, term| sum * t + term)
}
