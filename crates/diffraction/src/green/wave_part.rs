//! The wave part of the deep-water Green function from tables, to 1e-6.
//!
//! Four regions, so that every polynomial meets a smooth function:
//! - near the source, X and Y below 2: in `d` and `c = Y/d`, after the logarithm `-2 exp(-Y) J0(X) ln((d + Y)/2)` is taken out;
//! - X and Y below 16: rectangles, whose sides double with Y and stay 2 along the waves of X;
//! - beyond: the wave `2 pi exp(-Y) (-Y0 + i J0)` and a series in `1/d`, as a polynomial in `16/d` and `c` [NEWMAN-1985].

use super::patch::{Interval, Patch};
use super::quadrature::integrate_wave_part;
use nalgebra::Complex;
use std::f64::consts::{FRAC_2_PI, FRAC_PI_4, PI};
use std::sync::LazyLock;

/// Side of the region near the source, and of the rectangles along X.
const NEAR: f64 = 2.0;
/// Where the far region begins.
const FAR: f64 = 16.0;
/// Rectangles along X.
const COLUMNS: usize = 8;
/// Limits of the rectangles in Y.
const ROWS: [f64; 5] = [0.0, 2.0, 4.0, 8.0, 16.0];
/// Terms of the series in 1/d: the last is the least at its beginning.
const FAR_TERMS: usize = 15;
/// Below this depth under the source waves are less than rounding of the tables.
const NO_WAVES: f64 = 20.0;

/// The wave part `W` and its derivative by X.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WavePart {
    /// W.
    pub value: Complex<f64>,
    /// dW/dX.
    pub by_x: Complex<f64>,
}

/// Tables of the wave part.
#[derive(Clone, Debug)]
pub struct WavePartTable {
    near: Patch<2>,
    /// By rows of Y, then columns of X; the first stands for the region near the source and is not read.
    rectangles: Vec<Patch<2>>,
    far: Patch<2>,
    /// J0 and J1 on intervals of length [`NEAR`].
    bessel: [Vec<Interval>; 2],
}

static SHARED: LazyLock<WavePartTable> = LazyLock::new(WavePartTable::build);

impl WavePartTable {
    /// The one table of the process, made at its first use.
    pub fn shared() -> &'static Self {
        &SHARED
    }

    fn build() -> Self {
        let columns = |column: usize| [column as f64 * NEAR, (column + 1) as f64 * NEAR];
        let rectangles = ROWS
            .windows(2)
            .flat_map(|row| (0..COLUMNS).map(move |column| (column, [row[0], row[1]])))
            .map(|(column, row)| {
                Patch::fit(columns(column), row, |x, y| {
                    let found = integrate_wave_part(x, y);
                    [found.value.re, found.by_x.re]
                })
            })
            .collect();
        let near = Patch::fit([0.0, NEAR * 2.0_f64.sqrt()], [0.0, 1.0], |d, c| {
            let (y, s) = (d * c, (1.0 - c * c).sqrt());
            let x = d * s;
            let found = integrate_wave_part(x, y);
            let log = Logarithm::new(x, y, d, [libm::j0(x), libm::j1(x)], (-y).exp());
            // the derivative vanishes at the axis like s
            [found.value.re - log.value, (found.by_x.re - log.by_x) / s]
        });
        let far = Patch::fit([0.0, 1.0], [0.0, 1.0], far_series);
        let bessel = [libm::j0, libm::j1]
            .map(|function| (0..COLUMNS).map(|column| Interval::fit(columns(column), function)).collect());
        WavePartTable { near, rectangles, far, bessel }
    }

    /// The wave part at `x` and `y`, not below zero and not both zero (without unit), to 1e-6 of the larger of 1 and `1/d`.
    pub fn evaluate(&self, x: f64, y: f64) -> WavePart {
        let d = (x * x + y * y).sqrt();
        let fall = (-y).exp();
        let wave = 2.0 * PI * fall;
        if x >= FAR || y >= FAR {
            let [value, by_x] = self.far.evaluate(FAR / d, y / d);
            let [j, y_functions] = if x >= FAR && y < NO_WAVES { hankel(x) } else { [[0.0; 2]; 2] };
            return WavePart {
                value: Complex::new(-2.0 * value / d - wave * y_functions[0], wave * j[0]),
                by_x: Complex::new(2.0 * x * by_x / (d * d * d) + wave * y_functions[1], -wave * j[1]),
            };
        }
        let column = ((x * (1.0 / NEAR)) as usize).min(COLUMNS - 1);
        let j = [self.bessel[0][column].evaluate(x), self.bessel[1][column].evaluate(x)];
        let [re, re_by_x] = if x < NEAR && y < NEAR {
            let [value, by_x] = self.near.evaluate(d, y / d);
            let log = Logarithm::new(x, y, d, j, fall);
            [value + log.value, x / d * by_x + log.by_x]
        } else {
            let row = ROWS.iter().skip(1).take_while(|limit| y >= **limit).count().min(ROWS.len() - 2);
            self.rectangles[row * COLUMNS + column].evaluate(x, y)
        };
        WavePart { value: Complex::new(re, wave * j[0]), by_x: Complex::new(re_by_x, -wave * j[1]) }
    }
}

/// `-2 exp(-Y) J0(X) ln((d + Y)/2)` and its derivative by X.
struct Logarithm {
    value: f64,
    by_x: f64,
}

impl Logarithm {
    fn new(x: f64, y: f64, d: f64, [j0, j1]: [f64; 2], fall: f64) -> Self {
        let log = (0.5 * (d + y)).ln();
        Logarithm { value: -2.0 * fall * j0 * log, by_x: 2.0 * fall * (j1 * log - j0 * x / (d * (d + y))) }
    }
}

/// `sum n! P_n(c) / d^n` and `sum n! P'_(n+1)(c) / d^n` for `q = FAR/d`.
fn far_series(q: f64, c: f64) -> [f64; 2] {
    let (mut value, mut by_x) = (0.0, 0.0);
    // P_n, P_(n+1), P'_n, P'_(n+1) from n = 0
    let (mut p, mut next, mut dp, mut dnext) = (1.0, c, 0.0, 1.0);
    let mut share = 1.0;
    for n in 0..FAR_TERMS {
        value += share * p;
        by_x += share * dnext;
        let m = n as f64 + 1.0;
        let after = ((2.0 * m + 1.0) * c * next - m * p) / (m + 1.0);
        let dafter = dp + (2.0 * m + 1.0) * next;
        (p, next, dp, dnext) = (next, after, dnext, dafter);
        share *= m * q / FAR;
    }
    [value, by_x]
}

/// J0, J1 and Y0, Y1 at `x >= FAR` by Hankel's series [ABRAMOWITZ-STEGUN 9.2.5 to 9.2.10].
fn hankel(x: f64) -> [[f64; 2]; 2] {
    let amplitude = (FRAC_2_PI / x).sqrt();
    let (sine, cosine) = (x - FRAC_PI_4).sin_cos();
    let z = 1.0 / (8.0 * x);
    let zz = z * z;
    let p0 = 1.0 + zz * (-9.0 / 2.0 + zz * (11_025.0 / 24.0));
    let q0 = z * (-1.0 + zz * (225.0 / 6.0 - zz * (893_025.0 / 120.0)));
    let p1 = 1.0 + zz * (15.0 / 2.0 - zz * (14_175.0 / 24.0));
    let q1 = z * (3.0 + zz * (-315.0 / 6.0 + zz * (1_091_475.0 / 120.0)));
    // the phase of order one lies a quarter of a turn behind: cos becomes sin, and sin becomes -cos
    [
        [amplitude * (p0 * cosine - q0 * sine), amplitude * (p1 * sine + q1 * cosine)],
        [amplitude * (p0 * sine + q0 * cosine), amplitude * (q1 * sine - p1 * cosine)],
    ]
}
