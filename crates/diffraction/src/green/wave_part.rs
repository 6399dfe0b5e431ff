//! The wave part of the deep-water Green function from tables, to 1e-6.
//!
//! Four regions, so that every polynomial meets a smooth function:
//! - near the source, X and Y below 2: in `d` and `c = Y/d`, after the logarithm `-2 exp(-Y) J0(X) ln((d + Y)/2)` is taken out;
//! - X and Y below 16: rectangles, whose sides double with Y and stay 2 along the waves of X;
//! - beyond: the wave `2 pi exp(-Y) (-Y0 + i J0)` and a series in `1/d`, as a polynomial in `16/d` and `c` [NEWMAN-1985].

use super::patch::{Interval, LANES, Patch};
use super::quadrature::integrate_wave_part;
use multiversion::multiversion;
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
/// Behind the rectangles: the far region.
const FAR_REGION: u8 = ((ROWS.len() - 1) * COLUMNS) as u8;
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

/// The wave part at many points, part by part.
#[derive(Clone, Debug, Default)]
pub struct WavePartBatch {
    /// Real part of W.
    pub re: Vec<f64>,
    /// Imaginary part of W.
    pub im: Vec<f64>,
    /// Real part of dW/dX.
    pub re_by_x: Vec<f64>,
    /// Imaginary part of dW/dX.
    pub im_by_x: Vec<f64>,
    /// The points sorted by their region.
    order: Vec<usize>,
    /// The region of each point.
    regions: Vec<u8>,
}

/// The parts of several points: of W real and imaginary, of dW/dX real and imaginary.
type Parts = [[f64; LANES]; 4];

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

impl WavePartTable {
    /// The rectangle of a point, 0 near the source, [`FAR_REGION`] far away.
    fn region(x: f64, y: f64) -> u8 {
        let row = u8::from(y >= ROWS[1]) + u8::from(y >= ROWS[2]) + u8::from(y >= ROWS[3]);
        let near = row * COLUMNS as u8 + (x * (1.0 / NEAR)) as u8;
        if x >= FAR || y >= FAR { FAR_REGION } else { near }
    }

    /// As [`WavePartTable::evaluate`] at many points of as many `x` as `y`.
    pub fn evaluate_batch(&self, x: &[f64], y: &[f64], made: &mut WavePartBatch) {
        let count = x.len().min(y.len());
        let WavePartBatch { re, im, re_by_x, im_by_x, order, regions } = made;
        for part in [&mut *re, &mut *im, &mut *re_by_x, &mut *im_by_x] {
            part.resize(count, 0.0);
        }
        // sorted by region, in the order of the points
        regions.clear();
        regions.extend(x.iter().zip(y).map(|(x, y)| Self::region(*x, *y)));
        let mut ends = [0_usize; FAR_REGION as usize + 2];
        for region in regions.iter() {
            ends[usize::from(*region) + 1] += 1;
        }
        for i in 1..ends.len() {
            ends[i] += ends[i - 1];
        }
        let mut next = ends;
        order.resize(count, 0);
        for (i, region) in regions.iter().enumerate() {
            let place = &mut next[usize::from(*region)];
            order[*place] = i;
            *place += 1;
        }
        for (region, limits) in ends.windows(2).enumerate() {
            let members = &order[limits[0]..limits[1]];
            if region == usize::from(FAR_REGION) {
                for i in members {
                    let found = self.evaluate(x[*i], y[*i]);
                    (re[*i], im[*i]) = (found.value.re, found.value.im);
                    (re_by_x[*i], im_by_x[*i]) = (found.by_x.re, found.by_x.im);
                }
                continue;
            }
            let (whole, rest) = members.as_chunks::<LANES>();
            // lanes that are left over repeat the last point
            let padded = rest.last().map(|last| std::array::from_fn(|lane| *rest.get(lane).unwrap_or(last)));
            for some in whole.iter().chain(&padded) {
                let found = self.evaluate_lanes(region, &some.map(|i| x[i]), &some.map(|i| y[i]));
                for (lane, i) in some.iter().enumerate() {
                    re[*i] = found[0][lane];
                    im[*i] = found[1][lane];
                    re_by_x[*i] = found[2][lane];
                    im_by_x[*i] = found[3][lane];
                }
            }
        }
    }

    fn evaluate_lanes(&self, region: usize, x: &[f64; LANES], y: &[f64; LANES]) -> Parts {
        let bessel = [0, 1].map(|order| &self.bessel[order][region % COLUMNS]);
        if region == 0 {
            near_lanes(&self.near, bessel, x, y)
        } else {
            rectangle_lanes(&self.rectangles[region], bessel, x, y)
        }
    }
}

/// In the region near the source. Compiled for several widths of vector register, with the same operations, so that all give the same
/// digits.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn near_lanes(patch: &Patch<2>, bessel: [&Interval; 2], x: &[f64; LANES], y: &[f64; LANES]) -> Parts {
    let mut d = [0.0; LANES];
    let mut c = [0.0; LANES];
    for lane in 0..LANES {
        d[lane] = (x[lane] * x[lane] + y[lane] * y[lane]).sqrt();
        c[lane] = y[lane] / d[lane];
    }
    let [value, by_x] = patch.evaluate_lanes(&d, &c);
    let [j0, j1] = bessel.map(|interval| interval.evaluate_lanes(x));
    let mut made = [[0.0; LANES]; 4];
    for lane in 0..LANES {
        let fall = exponential(-y[lane]);
        let wave = 2.0 * PI * fall;
        let log = logarithm(0.5 * (d[lane] + y[lane]));
        made[0][lane] = value[lane] - 2.0 * fall * j0[lane] * log;
        made[1][lane] = wave * j0[lane];
        made[2][lane] = x[lane] / d[lane] * by_x[lane]
            + 2.0 * fall * (j1[lane] * log - j0[lane] * x[lane] / (d[lane] * (d[lane] + y[lane])));
        made[3][lane] = -wave * j1[lane];
    }
    made
}

/// In a rectangle; compiled as [`near_lanes`].
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl+fma", "x86_64+avx2+fma"))]
fn rectangle_lanes(patch: &Patch<2>, bessel: [&Interval; 2], x: &[f64; LANES], y: &[f64; LANES]) -> Parts {
    let [value, by_x] = patch.evaluate_lanes(x, y);
    let [j0, j1] = bessel.map(|interval| interval.evaluate_lanes(x));
    let mut made = [value, [0.0; LANES], by_x, [0.0; LANES]];
    for lane in 0..LANES {
        let wave = 2.0 * PI * exponential(-y[lane]);
        made[1][lane] = wave * j0[lane];
        made[3][lane] = -wave * j1[lane];
    }
    made
}

/// `exp(x)` for `x` between -700 and 700, to 1e-14, without a branch.
#[inline(always)]
fn exponential(x: f64) -> f64 {
    /// Added to a number it leaves its nearest integer in the last bits.
    const ROUND: f64 = 6_755_399_441_055_744.0;
    /// ln 2 in two parts, the first with zeros at its end.
    const LN2: [f64; 2] = [0.693_147_180_369_123_8, 1.908_214_929_270_587_7e-10];
    let shifted = x * std::f64::consts::LOG2_E + ROUND;
    let power = shifted - ROUND;
    let rest = x - power * LN2[0] - power * LN2[1];
    // 1/n! down from n = 11: the next term is 0.35^12/12! = 7e-15
    let factors = [
        1.0 / 39_916_800.0,
        1.0 / 3_628_800.0,
        1.0 / 362_880.0,
        1.0 / 40_320.0,
        1.0 / 5_040.0,
        1.0 / 720.0,
        1.0 / 120.0,
        1.0 / 24.0,
        1.0 / 6.0,
        0.5,
        1.0,
        1.0,
    ];
    let sum = factors.iter().fold(0.0, |sum, factor| sum * rest + factor);
    sum * f64::from_bits((shifted.to_bits() << 52).wrapping_add(1023 << 52))
}

/// `ln(x)` of a normal `x` above zero, to 1e-12, without a branch.
#[inline(always)]
fn logarithm(x: f64) -> f64 {
    /// 2 to the 52, as bits: an integer in the last bits is added to it.
    const INTEGER: u64 = 0x4330_0000_0000_0000;
    // x = m 2^e with m between sqrt(1/2) and sqrt(2)
    let bits = x.to_bits().wrapping_add(0x3ff0_0000_0000_0000 - std::f64::consts::FRAC_1_SQRT_2.to_bits());
    let e = f64::from_bits((bits >> 52) | INTEGER) - (f64::from_bits(INTEGER) + 1023.0);
    let m = f64::from_bits((bits & 0x000f_ffff_ffff_ffff) + std::f64::consts::FRAC_1_SQRT_2.to_bits());
    let s = (m - 1.0) / (m + 1.0);
    let square = s * s;
    // 2 (s + s3/3 + ..): s2 is at most 0.0295
    let factors = [1.0 / 15.0, 1.0 / 13.0, 1.0 / 11.0, 1.0 / 9.0, 1.0 / 7.0, 1.0 / 5.0, 1.0 / 3.0, 1.0];
    let sum = factors.iter().fold(0.0, |sum, factor| sum * square + factor);
    2.0 * s * sum + e * std::f64::consts::LN_2
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn exponential_and_logarithm_meet_those_of_the_library() {
        for i in 1..2000 {
            let x = 0.0173 * f64::from(i);
            assert!((exponential(-x) / (-x).exp() - 1.0).abs() < 1e-13, "{x}");
            assert!((logarithm(x) - x.ln()).abs() < 1e-11, "{x}");
        }
    }

    #[test]
    fn batch_meets_single_points_in_every_region() {
        let points: Vec<[f64; 2]> =
            (0..1500).map(|i| [0.0133 * f64::from(i), 20.0 * (0.37 * f64::from(i)).sin().powi(2)]).collect();
        let (x, y): (Vec<f64>, Vec<f64>) = points.iter().map(|[x, y]| (*x, *y)).unzip();
        let mut made = WavePartBatch::default();
        let table = WavePartTable::shared();
        table.evaluate_batch(&x[1..], &y[1..], &mut made);
        for (i, [x, y]) in points.iter().skip(1).enumerate() {
            let single = table.evaluate(*x, *y);
            let value = Complex::new(made.re[i], made.im[i]) - single.value;
            let by_x = Complex::new(made.re_by_x[i], made.im_by_x[i]) - single.by_x;
            assert!(value.norm() < 1e-11 && by_x.norm() < 1e-10, "{x} {y}: {value} {by_x}");
        }
    }
}
