//! Linear waves far below the surface, at eight places at once and wave by wave, as the nodes of lines ask for them.
//!
//! The formulas are those of [`super::airy`]. A wave goes through half turns and powers of two, so that whole numbers of both come off
//! without a remainder; what is left goes through polynomials.

use super::Component;
use super::simd_math::{Lanes8, ROUND};
use multiversion::multiversion;
use std::f64::consts::{FRAC_1_PI, LOG2_E};

/// At this power of two, and below, a wave is left out: a millionth of what it is at the mean level, twice that on a bottom.
const NEGLIGIBLE_LOG2: f64 = -19.931_568_569_324_174;
/// At this power of two, and below, the mirror term of finite depth is left out: a thousand-millionth of the wave at the mean level.
const NEGLIGIBLE_MIRROR_LOG2: f64 = -29.897_352_853_986_26;
/// Sine and cosine of r half turns, and two to a power f, by the squares of r and by f, lowest power first, with |r| and |f| up to a half:
/// Chebyshev's series cut off, written out in powers. They are within 3e-11, 3e-10 and 5e-11.
const SIN: [f64; 6] = [
    3.141_592_653_536_132,
    -5.167_712_764_593,
    2.550_163_317_938_427,
    -0.599_252_186_531_583,
    0.082_050_350_201_472_47,
    -0.007_028_303_855_203_096,
];
const COS: [f64; 6] = [
    0.999_999_999_779_154,
    -4.934_802_136_928_946,
    4.058_709_154_763_134,
    -1.335_211_949_390_550_3,
    0.234_937_068_595_086_5,
    -0.024_395_932_097_550_446,
];
const POWER: [f64; 8] = [
    0.999_999_999_959_561_8,
    0.693_147_180_556_832_4,
    0.240_226_512_134_980_92,
    0.055_504_109_063_258_665,
    0.009_618_025_613_318_034,
    0.001_333_347_847_368_541_4,
    0.000_154_697_292_141_182_96,
    0.000_015_303_701_136_569_35,
];

/// The waves of a sea.
#[derive(Clone, Debug, Default)]
pub(super) struct DeepWaveSum {
    waves: Vec<FarWave>,
    /// Farthest from x = y = 0 at which the phase of the shortest wave is known (m).
    pub reach: f64,
}

/// A wave, with what does not change.
#[derive(Clone, Copy, Debug)]
struct FarWave {
    /// Half turns a metre along x and y; the first alone holds all of them where all waves go one way.
    turns: [f64; 2],
    /// Half turns at x = y = 0 and no time, and how many go by a second.
    phase: f64,
    rate: f64,
    /// Powers of two a metre of height.
    number: f64,
    /// The mirror term of finite depth at the mean level, exp(-2kd), and its power of two.
    mirror: f64,
    twice: f64,
    /// cosh(k(z+d)) exp(-kd) where the bottom is.
    bottom: f64,
    /// Pressure over rho g, velocity along x and y and up, acceleration alike, at its crest or a quarter turn beside it, of a decay of one.
    sizes: [f64; 7],
}

/// Lanes8 places: x and y, or the way along the waves where all go one way, and the height over the mean level (m).
#[derive(Clone, Debug, Default)]
pub(super) struct Places {
    pub x: Lanes8,
    pub y: Lanes8,
    pub height: Lanes8,
}

impl DeepWaveSum {
    /// The waves of components in a depth (m), of which all go one way if there is one; a phase is known up to so many radians.
    pub fn new(components: &[Component], depth: Option<f64>, one_way: bool, known: f64) -> Self {
        let wave = |c: &Component| {
            let kd = depth.map_or(f64::INFINITY, |d| c.number * d);
            let whole = -1.0 / (-2.0 * kd).exp_m1();
            let speed = c.amplitude * c.frequency * whole;
            let along = if one_way { [1.0, 0.0] } else { c.toward };
            let [x, y] = along.map(|share| share * speed);
            let (number, mirror, twice) = (c.number * LOG2_E, (-2.0 * kd).exp(), -2.0 * kd * LOG2_E);
            // as the sums make it of the height of the bottom
            let bottom = depth.map_or(0.0, |d| {
                let power = number * -d;
                let [own, back] = decays(power, 0);
                remaining_amplitude(own, power, NEGLIGIBLE_LOG2)
                    + remaining_amplitude(back * mirror, twice - power, NEGLIGIBLE_MIRROR_LOG2)
            });
            FarWave {
                turns: along.map(|share| share * c.number * FRAC_1_PI),
                phase: c.phase * FRAC_1_PI,
                rate: c.frequency * FRAC_1_PI,
                number,
                mirror,
                twice,
                bottom,
                sizes: [
                    c.amplitude * whole * kd.tanh(),
                    x,
                    y,
                    speed,
                    c.frequency * x,
                    c.frequency * y,
                    -c.frequency * speed,
                ],
            }
        };
        let shortest = components.iter().map(|c| c.number).fold(f64::MIN_POSITIVE, f64::max);
        DeepWaveSum { waves: components.iter().map(wave).collect(), reach: known / shortest }
    }

    /// Pressure over rho g, velocity along x, y and up, and acceleration alike, of waves of full height at a time (s), each added up over
    /// the waves that reach down there.
    pub fn sums<const SPREAD: bool>(&self, time: f64, positions: &Places) -> [Lanes8; 7] {
        sum_components::<SPREAD, false>(&self.waves, time, positions)
    }

    /// The same on the bottom, whose height is that of all places.
    pub fn sums_on_bottom<const SPREAD: bool>(&self, time: f64, positions: &Places) -> [Lanes8; 7] {
        sum_components::<SPREAD, true>(&self.waves, time, positions)
    }
}

/// Two to a power and to the negative power, with the sign of half turns that `turned` has in its lowest bit.
#[inline(always)]
fn decays(power: f64, turned: u64) -> [f64; 2] {
    let shifted = power + ROUND;
    let f = power - (shifted - ROUND);
    let (whole, square) = (shifted.to_bits(), f * f);
    let even = polynomial(&[POWER[0], POWER[2], POWER[4], POWER[6]], square);
    let odd = f * polynomial(&[POWER[1], POWER[3], POWER[5], POWER[7]], square);
    let sign = turned << 63;
    let own = f64::from_bits((whole.wrapping_add(1023) << 52) ^ sign);
    let back = f64::from_bits((1023_u64.wrapping_sub(whole) << 52) ^ sign);
    [(even + odd) * own, (even - odd) * back]
}

/// What is left of a wave at a power of two: nothing below a least power.
#[inline(always)]
fn remaining_amplitude(value: f64, power: f64, least: f64) -> f64 {
    if power >= least { value } else { 0.0 }
}

#[inline(always)]
fn polynomial<const N: usize>(factors: &[f64; N], at: f64) -> f64 {
    let mut sum = factors[N - 1];
    let mut i = N - 1;
    while i > 0 {
        i -= 1;
        sum = sum * at + factors[i];
    }
    sum
}

/// Adds up waves that go many ways if `SPREAD`, on the bottom if `LYING`: cosine and sine times what is left of each.
///
/// What comes out at a place is the same whatever the other places are: a wave that is left out at one of them is left out there
/// alone.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn sum_components<const SPREAD: bool, const LYING: bool>(
    waves: &[FarWave],
    time: f64,
    positions: &Places,
) -> [Lanes8; 7] {
    let (mut highest, mut lowest) = (positions.height[0], positions.height[0]);
    for height in &positions.height {
        highest = highest.max(*height);
        lowest = lowest.min(*height);
    }
    let mut sums = [[0.0; 8]; 7];
    for wave in waves {
        if wave.number * highest < NEGLIGIBLE_LOG2 {
            continue;
        }
        let phase = wave.phase - wave.rate * time;
        let mirrored = wave.twice - wave.number * lowest >= NEGLIGIBLE_MIRROR_LOG2;
        if LYING {
            add::<SPREAD, true, false>(wave, phase, positions, &mut sums);
        } else if mirrored {
            add::<SPREAD, false, true>(wave, phase, positions, &mut sums);
        } else {
            add::<SPREAD, false, false>(wave, phase, positions, &mut sums);
        }
    }
    sums
}

/// Adds a wave of a phase (half turns) at x = y = 0, with its mirror term of finite depth if `MIRROR`.
#[inline(always)]
#[expect(
    clippy::needless_range_loop,
    reason = "a lane is a place of several lists, and closures keep the loop from wide vectors"
)]
fn add<const SPREAD: bool, const LYING: bool, const MIRROR: bool>(
    wave: &FarWave,
    phase: f64,
    positions: &Places,
    sums: &mut [Lanes8; 7],
) {
    for i in 0..8 {
        let mut turns = positions.x[i] * wave.turns[0];
        if SPREAD {
            turns += positions.y[i] * wave.turns[1];
        }
        turns += phase;
        let shifted = turns + ROUND;
        let r = turns - (shifted - ROUND);
        let z = r * r;
        let (sin, cos) = (r * polynomial(&SIN, z), polynomial(&COS, z));
        let turned = shifted.to_bits();
        if LYING {
            let cosh = f64::from_bits(wave.bottom.to_bits() ^ (turned << 63));
            let (c, s) = (cosh * cos, cosh * sin);
            sums[0][i] += wave.sizes[0] * c;
            sums[1][i] += wave.sizes[1] * c;
            sums[4][i] += wave.sizes[4] * s;
            if SPREAD {
                sums[2][i] += wave.sizes[2] * c;
                sums[5][i] += wave.sizes[5] * s;
            }
            continue;
        }
        let power = wave.number * positions.height[i];
        let [own, back] = decays(power, turned);
        let own = remaining_amplitude(own, power, NEGLIGIBLE_LOG2);
        let (mut cosh, mut sinh) = (own, own);
        if MIRROR {
            // where the wave itself is left out, so is its mirror term
            let back = remaining_amplitude(
                remaining_amplitude(back * wave.mirror, wave.twice - power, NEGLIGIBLE_MIRROR_LOG2),
                power,
                NEGLIGIBLE_LOG2,
            );
            (cosh, sinh) = (own + back, own - back);
        }
        let (c, s) = (cosh * cos, cosh * sin);
        sums[0][i] += wave.sizes[0] * c;
        sums[1][i] += wave.sizes[1] * c;
        sums[3][i] += wave.sizes[3] * (sinh * sin);
        sums[4][i] += wave.sizes[4] * s;
        if SPREAD {
            sums[2][i] += wave.sizes[2] * c;
            sums[5][i] += wave.sizes[5] * s;
        }
        sums[6][i] += wave.sizes[6] * (sinh * cos);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn deep_sines_and_powers_match_standard_library() {
        for i in -1_000..=1_000 {
            let r = f64::from(i) * 5e-4;
            let (sin, cos) = (PI * r).sin_cos();
            assert!((r * polynomial(&SIN, r * r) - sin).abs() < 3e-11, "{r}");
            assert!((polynomial(&COS, r * r) - cos).abs() < 3e-10, "{r}");
            for whole in [-19, -7, 0] {
                let power = r + f64::from(whole);
                let [found, inverse] = decays(power, 0);
                let wanted = power.exp2();
                assert!((found / wanted - 1.0).abs() < 7e-11 && (inverse * wanted - 1.0).abs() < 7e-11, "{power}");
                assert_eq!(decays(power, 7), [-found, -inverse]);
            }
        }
        assert_eq!(remaining_amplitude(f64::NAN, -1e300, NEGLIGIBLE_LOG2), 0.0);
        assert_eq!(remaining_amplitude(f64::INFINITY, f64::NEG_INFINITY, NEGLIGIBLE_MIRROR_LOG2), 0.0);
    }
}
