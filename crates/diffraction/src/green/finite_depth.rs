//! What the bottom adds to the deep-water Green function, from tables that are made for each frequency.
//!
//! With `V = z + zeta + 2 h` and `V' = |z - zeta|` the Green function of water of depth h is `g(R, V) + g(R, V')`,
//!
//! ```text
//! g(R, V) = 1/sqrt(R2 + V2) + int_0^inf F(k, V) J0(k R) dk
//! F(k, V) = q (exp(-k (2 h - V)) + exp(-k (2 h + V))) / (1 - q exp(-2 k h)),   q = (k + nu)/(k - nu)
//! ```
//!
//! on a path below the poles; and by eigenfunctions, for R above zero [JOHN-1950],
//!
//! ```text
//! g(R, V) = i pi C0 cosh(k0 V) H0(k0 R) + 2 sum_n Cn cos(kn V) K0(kn R)
//! ```
//!
//! The term `q exp(-k (2 h - V))` at V is the deep-water Green function's `1/r' + nu W`, so that
//! `G = 1/r + 1/r' + 1/r_b + nu W + S(R, V) + S'(R, V')`, `r_b` the distance from the image below the bottom. The real parts of `S` and `S'`
//! are smooth, for their sources lie a depth and more away; they are tabulated over the reach of the bodies, up to twelve depths. The
//! imaginary part is `2 pi C0 cosh k0(z + h) cosh k0(zeta + h) J0(k0 R)`, of which that of `nu W` is taken off. Beyond twelve depths the
//! propagating wave alone is left of the eigenfunctions, and no table is needed: hulls of any size take the same memory.

use super::patch::{Patch, TERMS};
use super::special::{complex_bessel, modified_bessel};
use super::wave_part::{WavePart, WavePartTable};
use crate::dispersion::{evanescent_wave_number, wave_number};
use crate::gauss::GaussRule;
use nalgebra::Complex;
use rayon::prelude::*;
use std::f64::consts::PI;
use std::sync::LazyLock;

type C = Complex<f64>;

/// Points on each piece of the path of integration.
static RULE: LazyLock<GaussRule> = LazyLock::new(|| GaussRule::new(24));
/// Distance over depth from which the eigenfunctions are summed.
const SERIES_DISTANCE: f64 = 0.5;
/// Eigenfunctions whose Bessel function has an argument beyond it are left out.
const SERIES_REACH: f64 = 34.0;
/// Depth times nu beyond which the integrand is nothing before it comes to its poles.
const DEEP: f64 = 24.0;
/// Wave number times depth at which it is cut there.
const DEEP_CUT: f64 = 18.0;
/// The same where the poles are gone round.
const CUT: f64 = 34.0;
/// Distance over depth beyond which the propagating wave is all: the first of the other eigenfunctions has `k1 h` above `pi/2`, and
/// `K0(6 pi)` is 2e-9.
const FAR_DISTANCE: f64 = 12.0;
/// Wave number times depth up to which patches shorten with the wave length; of shorter waves the corrections feel nothing.
const PATCHED_WAVE: f64 = DEEP;
/// Longest piece of the path behind the poles, times the depth.
const LONGEST_PIECE: f64 = 4.0;

/// Real part of S or S', and its derivatives by R and V.
type Correction = [f64; 3];

/// The corrections of one frequency over the reach of the bodies.
#[derive(Clone, Debug)]
pub struct FiniteDepthTable {
    depth: f64,
    nu: f64,
    /// The wave number of the propagating wave (1/m).
    wave_number: f64,
    /// `C0 cosh2(k0 h)`, so that the heights enter by `cosh k0(z + h)/cosh k0 h`.
    amplitude: f64,
    /// Length of a patch along R (m).
    step: f64,
    /// S over R and V.
    sum_part: Vec<Patch<3>>,
    /// S' over R and V'.
    difference_part: Vec<Patch<3>>,
}

/// The part of the Green function that depends on the frequency, `nu W + S + S'`, with its derivatives.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrequencyPart {
    /// The part itself (1/m).
    pub value: C,
    /// By the horizontal distance (1/m2).
    pub by_distance: C,
    /// By the heights of the point and of the source (1/m2).
    pub by_heights: [C; 2],
}

/// Derivatives of the part of the Green function that depends on the frequency, up to those that velocities by sources and dipoles take.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct FrequencySlopes {
    /// By the horizontal distance (1/m2).
    pub by_distance: C,
    /// By the heights of the point and of the source (1/m2).
    pub by_heights: [C; 2],
    /// Twice by the horizontal distance (1/m3).
    pub by_distance_twice: C,
    /// By the horizontal distance, over that (1/m3).
    pub over_distance: C,
    /// By the horizontal distance, and the height of the point or of the source (1/m3).
    pub by_distance_and_heights: [C; 2],
    /// By both heights (1/m3).
    pub by_both_heights: C,
}

/// Above the source, within this share of the height, the derivative over the distance is the second derivative: to the square of it.
const AXIS_SHARE: f64 = 0.01;

impl FrequencySlopes {
    /// Those of deep water from the wave part at X and Y, by the equation of Laplace and `dW/dY = -(W + 2/d)`.
    pub fn from_wave_part(found: WavePart, nu: f64, [x, y]: [f64; 2]) -> Self {
        let over = 1.0 / (x * x + y * y).sqrt();
        let cube = over * over * over;
        let square = nu * nu;
        let by_y = -(found.value + 2.0 * over);
        let twice_by_y = 2.0 * y * cube - by_y;
        let over_x = if x <= AXIS_SHARE * y { -0.5 * twice_by_y } else { found.by_x / x };
        let by_height = -by_y * square;
        let mixed = (found.by_x - 2.0 * x * cube) * (square * nu);
        FrequencySlopes {
            by_distance: found.by_x * square,
            by_heights: [by_height; 2],
            by_distance_twice: -(over_x + twice_by_y) * (square * nu),
            over_distance: over_x * (square * nu),
            by_distance_and_heights: [mixed; 2],
            by_both_heights: twice_by_y * (square * nu),
        }
    }
}

impl FrequencyPart {
    /// That of deep water: `nu W`.
    pub fn in_deep_water(table: &WavePartTable, nu: f64, distance: f64, heights: [f64; 2]) -> Self {
        let (x, y) = (nu * distance, -nu * (heights[0] + heights[1]));
        Self::from_wave_part(table.evaluate(x, y), nu, [x, y])
    }

    /// The same from the wave part at X and Y.
    pub fn from_wave_part(found: WavePart, nu: f64, [x, y]: [f64; 2]) -> Self {
        let by_height = (found.value + 2.0 / (x * x + y * y).sqrt()) * (nu * nu);
        FrequencyPart { value: found.value * nu, by_distance: found.by_x * (nu * nu), by_heights: [by_height; 2] }
    }
}

impl FiniteDepthTable {
    /// The table of a frequency, `nu = omega2/g` (1/m), in water of a depth (m), for points at most `reach` (m) apart horizontally and
    /// `draught` (m) below the mean level.
    pub fn new(nu: f64, depth: f64, reach: f64, draught: f64) -> Self {
        let modes = Modes::new(nu, depth);
        // waves want three patches a wave length, the images two a depth
        let shortest = modes.wave_number.min(PATCHED_WAVE / depth);
        let step = (2.0 / shortest).min(SERIES_DISTANCE * depth);
        let count = (reach.min(FAR_DISTANCE * depth) / step).ceil().max(1.0) as usize;
        let draught = draught.clamp(1e-3 * depth, depth);
        let fit = |part: Part, limits: [f64; 2]| -> Vec<Patch<3>> {
            (0..count)
                .into_par_iter()
                .map(|i| {
                    Patch::fit_rows([i as f64 * step, (i + 1) as f64 * step], limits, |r, heights| {
                        modes.corrections(part, r, heights)
                    })
                })
                .collect()
        };
        let sum_part = fit(Part::Sum, [2.0 * (depth - draught), 2.0 * depth]);
        let difference_part = fit(Part::Difference, [0.0, draught]);
        let (wave_number, amplitude) = (modes.wave_number, modes.amplitude);
        FiniteDepthTable { depth, nu, wave_number, amplitude, step, sum_part, difference_part }
    }

    /// The wave number of the propagating wave (1/m).
    pub fn wave_number(&self) -> f64 {
        self.wave_number
    }

    /// `C0 cosh2(k0 h)` (1/m): far away G is `2 pi i` times it, times `cosh k0(z + h)/cosh k0 h` of both heights, times `H0(k0 R)`.
    pub fn amplitude(&self) -> f64 {
        self.amplitude
    }

    /// The part of the frequency for a horizontal distance and the heights of the point and of the source (m).
    pub fn evaluate(&self, deep: &WavePartTable, distance: f64, heights: [f64; 2]) -> FrequencyPart {
        self.correct(FrequencyPart::in_deep_water(deep, self.nu, distance, heights), distance, heights)
    }

    /// The same from the part of deep water.
    pub fn correct(&self, found: FrequencyPart, distance: f64, heights: [f64; 2]) -> FrequencyPart {
        if distance > FAR_DISTANCE * self.depth {
            return self.far_part(distance, heights);
        }
        let [z, source] = heights;
        let patch = ((distance / self.step) as usize).min(self.sum_part.len() - 1);
        let sum = self.sum_part[patch].evaluate(distance, z + source + 2.0 * self.depth);
        let rise = z - source;
        let difference = self.difference_part[patch].evaluate(distance, rise.abs());
        let by_rise = rise.signum() * difference[2];
        let k = self.wave_number;
        let [(own, own_slope), (other, other_slope)] = heights.map(|height| self.profile(height));
        let wave = 2.0 * PI * self.amplitude;
        let (j0, j1) = (libm::j0(k * distance), libm::j1(k * distance));
        FrequencyPart {
            value: C::new(found.value.re + sum[0] + difference[0], wave * own * other * j0),
            by_distance: C::new(found.by_distance.re + sum[1] + difference[1], -wave * own * other * k * j1),
            by_heights: [
                C::new(found.by_heights[0].re + sum[2] + by_rise, wave * own_slope * other * j0),
                C::new(found.by_heights[1].re + sum[2] - by_rise, wave * own * other_slope * j0),
            ],
        }
    }

    /// The derivatives in water of finite depth from those of deep water.
    pub fn correct_slopes(&self, found: FrequencySlopes, distance: f64, heights: [f64; 2]) -> FrequencySlopes {
        if distance > FAR_DISTANCE * self.depth {
            return self.far_slopes(distance, heights);
        }
        let [z, source] = heights;
        let patch = ((distance / self.step) as usize).min(self.sum_part.len() - 1);
        let rise = z - source;
        let mut made = found;
        // of the heights of the point and of the source: how they change V and V'
        let parts = [
            (&self.sum_part[patch], z + source + 2.0 * self.depth, [1.0, 1.0]),
            (&self.difference_part[patch], rise.abs(), [rise.signum(), -rise.signum()]),
        ];
        for (part, height, signs) in parts {
            let [values, by_first, by_second] = part.evaluate_with_slopes(distance, height);
            let (slope, twice, mixed) = (values[1], by_first[1], by_second[1]);
            let over = if distance <= AXIS_SHARE * self.step { twice } else { slope / distance };
            made.by_distance.re += slope;
            made.by_distance_twice.re += twice;
            made.over_distance.re += over;
            for (which, sign) in signs.into_iter().enumerate() {
                made.by_heights[which].re += sign * values[2];
                made.by_distance_and_heights[which].re += sign * mixed;
            }
            made.by_both_heights.re -= signs[0] * signs[1] * (twice + over);
        }
        let k = self.wave_number;
        let [(own, own_slope), (other, other_slope)] = heights.map(|height| self.profile(height));
        let wave = 2.0 * PI * self.amplitude;
        let kr = k * distance;
        let (j0, j1) = (libm::j0(kr), libm::j1(kr));
        // J1(x)/x without rounding on the axis
        let over = if kr < 1e-4 { 0.5 } else { j1 / kr };
        made.by_distance.im = -wave * own * other * k * j1;
        made.by_heights[0].im = wave * own_slope * other * j0;
        made.by_heights[1].im = wave * own * other_slope * j0;
        made.by_distance_twice.im = -wave * own * other * k * k * (j0 - over);
        made.over_distance.im = -wave * own * other * k * k * over;
        made.by_distance_and_heights[0].im = -wave * own_slope * other * k * j1;
        made.by_distance_and_heights[1].im = -wave * own * other_slope * k * j1;
        made.by_both_heights.im = wave * own_slope * other_slope * j0;
        made
    }

    /// As [`FiniteDepthTable::far_part`].
    fn far_slopes(&self, distance: f64, heights: [f64; 2]) -> FrequencySlopes {
        let k = self.wave_number;
        let [(own, own_slope), (other, other_slope)] = heights.map(|height| self.profile(height));
        let wave = 2.0 * PI * self.amplitude;
        let hankel = C::new(-libm::y0(k * distance), libm::j0(k * distance)) * wave;
        let slope = C::new(libm::y1(k * distance), -libm::j1(k * distance)) * (wave * k);
        let over = slope / distance;
        let mut made = FrequencySlopes {
            by_distance: slope * (own * other),
            by_heights: [hankel * (own_slope * other), hankel * (own * other_slope)],
            by_distance_twice: -(hankel * (k * k) + over) * (own * other),
            over_distance: over * (own * other),
            by_distance_and_heights: [slope * (own_slope * other), slope * (own * other_slope)],
            by_both_heights: hankel * (own_slope * other_slope),
        };
        let [z, source] = heights;
        for (rise, with_source) in [(z - source, -1.0), (z + source, 1.0), (z + source + 2.0 * self.depth, 1.0)] {
            let over = 1.0 / distance.hypot(rise);
            let (cube, fifth) = (over.powi(3), 3.0 * over.powi(5));
            made.by_distance.re += distance * cube;
            made.by_distance_twice.re += cube - distance * distance * fifth;
            made.over_distance.re += cube;
            for (which, sign) in [1.0, with_source].into_iter().enumerate() {
                made.by_heights[which].re += sign * rise * cube;
                made.by_distance_and_heights[which].re -= sign * distance * rise * fifth;
            }
            made.by_both_heights.re += with_source * (cube - rise * rise * fifth);
        }
        made
    }

    /// `cosh k(z + h)/cosh k h` and its derivative by z (1/m).
    fn profile(&self, height: f64) -> (f64, f64) {
        let k = self.wave_number;
        let scale = 1.0 / (1.0 + (-2.0 * k * self.depth).exp());
        let (up, down) = ((k * height).exp(), (-k * (height + 2.0 * self.depth)).exp());
        ((up + down) * scale, k * (up - down) * scale)
    }

    /// The propagating wave, less the source and its images, which stand elsewhere in the Green function.
    fn far_part(&self, distance: f64, heights: [f64; 2]) -> FrequencyPart {
        let k = self.wave_number;
        let [(own, own_slope), (other, other_slope)] = heights.map(|height| self.profile(height));
        let wave = 2.0 * PI * self.amplitude;
        let hankel = C::new(-libm::y0(k * distance), libm::j0(k * distance)) * wave;
        let slope = C::new(libm::y1(k * distance), -libm::j1(k * distance)) * (wave * k);
        let mut made = FrequencyPart {
            value: hankel * (own * other),
            by_distance: slope * (own * other),
            by_heights: [hankel * (own_slope * other), hankel * (own * other_slope)],
        };
        let [z, source] = heights;
        // the height of the point over the source or an image, and how it changes with that of the source
        for (rise, with_source) in [(z - source, -1.0), (z + source, 1.0), (z + source + 2.0 * self.depth, 1.0)] {
            let [value, by_distance, by_rise] = inverse_distance(distance, rise);
            made.value.re -= value;
            made.by_distance.re -= by_distance;
            made.by_heights[0].re -= by_rise;
            made.by_heights[1].re -= by_rise * with_source;
        }
        made
    }
}

/// Which of the two smooth corrections.
#[derive(Clone, Copy, PartialEq)]
enum Part {
    Sum,
    Difference,
}

/// Wave numbers of a frequency and what goes with them.
struct Modes {
    nu: f64,
    depth: f64,
    wave_number: f64,
    /// C0 cosh2(k0 h) (1/m).
    amplitude: f64,
    /// kn (1/m) and Cn (1/m).
    evanescent: Vec<(f64, f64)>,
}

impl Modes {
    fn new(nu: f64, depth: f64) -> Self {
        let k = wave_number(nu, depth);
        let kh = k * depth;
        // (k2 - nu2) cosh2 = k2 and h (k2 - nu2) + nu = (k2 - nu2)(h + sinh(2kh)/2k)
        let tanh = kh.tanh();
        let sech2 = 1.0 - tanh * tanh;
        let amplitude = k / (kh * sech2 + tanh);
        let count = (SERIES_REACH / (PI * SERIES_DISTANCE)).ceil() as usize + 2;
        let evanescent = (1..=count)
            .map(|n| {
                let k = evanescent_wave_number(nu, depth, n);
                let square = k * k + nu * nu;
                (k, square / (square * depth - nu))
            })
            .collect();
        Modes { nu, depth, wave_number: k, amplitude, evanescent }
    }

    /// Corrections at one distance and several V.
    fn corrections(&self, part: Part, r: f64, heights: [f64; TERMS]) -> [Correction; TERMS] {
        if r >= SERIES_DISTANCE * self.depth {
            self.by_series(part, r, heights)
        } else {
            self.by_path(part, r, heights)
        }
    }

    /// From the eigenfunctions, less what else stands in the Green function.
    fn by_series(&self, part: Part, r: f64, heights: [f64; TERMS]) -> [Correction; TERMS] {
        let k = self.wave_number;
        let (y0, y1) = (libm::y0(k * r), libm::y1(k * r));
        let modes: Vec<(f64, [f64; 2])> = self
            .evanescent
            .iter()
            .take_while(|(k, _)| k * r < SERIES_REACH)
            .map(|(k, c)| (*k, modified_bessel(k * r).map(|value| 2.0 * c * value)))
            .collect();
        heights.map(|v| {
            // cosh(kV)/cosh2(kh) without large exponents
            let decay = (-2.0 * k * self.depth).exp();
            let scale = 2.0 / (1.0 + decay).powi(2);
            let (up, down) = ((k * (v - 2.0 * self.depth)).exp(), (-k * (v + 2.0 * self.depth)).exp());
            let (cosh, sinh) = ((up + down) * scale, (up - down) * scale);
            let c = -PI * self.amplitude;
            let mut g = [c * cosh * y0, -c * k * cosh * y1, c * k * sinh * y0];
            for (k, [k0, k1]) in &modes {
                let (sine, cosine) = (k * v).sin_cos();
                g = [g[0] + cosine * k0, g[1] - k * cosine * k1, g[2] - k * sine * k0];
            }
            let own = inverse_distance(r, v);
            for (value, own) in g.iter_mut().zip(own) {
                *value -= own;
            }
            if part == Part::Sum {
                let deep = self.deep(r, 2.0 * self.depth - v);
                for (value, deep) in g.iter_mut().zip(deep) {
                    *value -= deep;
                }
            }
            g
        })
    }

    /// Real part of `1/r' + nu W` for a depth A below the image of the surface, with derivatives by R and V.
    fn deep(&self, r: f64, a: f64) -> Correction {
        let (x, y) = (self.nu * r, self.nu * a);
        let found = WavePartTable::shared().evaluate(x, y);
        let image = inverse_distance(r, a);
        let by_y = -(found.value.re + 2.0 / x.hypot(y));
        let square = self.nu * self.nu;
        [image[0] + self.nu * found.value.re, image[1] + square * found.by_x.re, -image[2] - square * by_y]
    }

    /// By the integral over k, on a path below the poles where they matter.
    fn by_path(&self, part: Part, r: f64, heights: [f64; TERMS]) -> [Correction; TERMS] {
        let (h, nu) = (self.depth, self.nu);
        let mut sums = [[0.0; 3]; TERMS];
        let mut add = |from: C, to: C, pieces: usize| {
            let side = (to - from) / pieces as f64;
            for piece in 0..pieces {
                for (t, weight) in RULE.between(piece as f64, piece as f64 + 1.0) {
                    let k = from + side * t;
                    let [j0, j1] = complex_bessel(k * r);
                    for (sum, v) in sums.iter_mut().zip(heights) {
                        let [value, by_v] = self.integrand(part, k, v);
                        let share = side * weight;
                        *sum = [
                            sum[0] + (share * value * j0).re,
                            sum[1] - (share * value * k * j1).re,
                            sum[2] + (share * by_v * j0).re,
                        ];
                    }
                }
            }
        };
        if nu * h > DEEP {
            add(C::default(), C::new(DEEP_CUT / h, 0.0), 8);
        } else {
            // down to below the poles in steps that double from the first of them, back to the axis behind them, and along it
            let k = self.wave_number;
            let turn = C::new(k, -0.5 * k);
            let mut share = 0.0;
            let mut next = (nu / k).min(1.0);
            while share < 1.0 {
                add(turn * share, turn * next, 1);
                (share, next) = (next, (2.0 * next).min(1.0));
            }
            let behind = C::new(2.0 * k, 0.0);
            add(turn, behind, 3);
            let last = (CUT / h).max(2.0 * k + 1.0 / h);
            let mut low = behind.re;
            while low < last {
                let high = (low + low.min(LONGEST_PIECE / h)).min(last);
                add(C::new(low, 0.0), C::new(high, 0.0), 1);
                low = high;
            }
        }
        sums
    }

    /// `F` without the terms that stand elsewhere, and its derivative by V.
    fn integrand(&self, part: Part, k: C, v: f64) -> [C; 2] {
        let h = self.depth;
        let q = (k + self.nu) / (k - self.nu);
        let loop_ = (-k * (2.0 * h)).exp() * q;
        let (near, far) = ((-k * (2.0 * h - v)).exp(), (-k * (2.0 * h + v)).exp());
        let rest = q / (C::new(1.0, 0.0) - loop_);
        match part {
            Part::Difference => [rest * (near + far), rest * k * (near - far)],
            // q near is the deep-water part
            Part::Sum => [rest * (near * loop_ + far), rest * k * (near * loop_ - far)],
        }
    }
}

/// 1/sqrt(R2 + V2) and its derivatives.
fn inverse_distance(r: f64, v: f64) -> Correction {
    let over = 1.0 / r.hypot(v);
    let cube = over.powi(3);
    [over, -r * cube, -v * cube]
}
