//! Waves and current in the axes of the tether, laid out for many places at one time.
//!
//! A Stokes wave (`windlass_hydro::sea::stokes`) is one wave of the frequency of encounter, whose angle goes by the same turns; it reaches up to its own
//! surface, and its accelerations are those of the water particle.
//!
//! Airy waves added up (as [`windlass_hydro::sea`]): with `q = kx x + ky y - w t + phase`, C and S being cosh and sinh of k(z+d)
//! over sinh(kd), u = a w C cos q, w = a w S sin q. Along an element the places of the first look do not move, so their
//! `cos(kx x)` and `sin(kx x)` are kept; sines of the time are taken anew at every time, without recurrence. The sums are compiled for
//! several widths of vector register, in one order on all of them, so that the digits are the same.

use super::Towed;
use multiversion::multiversion;
use std::f64::consts::{LN_2, LOG2_E};
use windlass_hydro::sea::Component;
use windlass_hydro::sea::simd_math::{Lanes8, sin_cos};
use windlass_hydro::sea::stokes::Stokes;

/// Water this deep (k d) is deep to the last digit: exp(-2 k d) < 1e-17.
const DEEP_WATER_KD: f64 = 20.0;

/// Added to a number and subtracted again it rounds to a whole one, which then stands in the lowest bits.
const ROUNDING_SHIFT: f64 = 6_755_399_441_055_744.0;
/// The Chebyshev series of the exponential over `-ln 2 / 2 .. ln 2 / 2` to the tenth power, highest first: within 4e-16 of it.
const EXP_CHEBYSHEV: [f64; 11] = [
    2.7632640675430235e-07,
    2.7640182247362188e-06,
    2.480148547921643e-05,
    0.0001984117026651832,
    0.0013888888952318045,
    0.008333333385671316,
    0.04166666666648808,
    0.16666666666554392,
    0.5000000000000019,
    1.0000000000000067,
    1.0,
];

/// Four numbers: as many as stay in registers with all that is made of them.
type Lanes4 = [f64; 4];

/// Four values, each of its number.
#[inline(always)]
fn four(value: impl Fn(usize) -> f64) -> Lanes4 {
    [value(0), value(1), value(2), value(3)]
}

/// Exponentials. Beyond 1e300 and below 1e-300 they stay there.
#[inline(always)]
fn exp(powers: Lanes4) -> Lanes4 {
    let powers = four(|i| powers[i].clamp(-690.0, 690.0));
    let shifted = four(|i| powers[i] * LOG2_E + ROUNDING_SHIFT);
    // one part of the logarithm is enough: an error of 1e-16 of the power is one of the value
    let r = four(|i| powers[i] - (shifted[i] - ROUNDING_SHIFT) * LN_2);
    let mut value = [EXP_CHEBYSHEV[0]; 4];
    for c in &EXP_CHEBYSHEV[1..] {
        value = four(|i| value[i] * r[i] + c);
    }
    four(|i| value[i] * f64::from_bits(shifted[i].to_bits().wrapping_add(1023) << 52))
}

/// Cosine and sine of eight waves at a place; at a time those times the speed `a w` (m/s).
pub type Turn = [Lanes8; 2];

/// Lanes8 waves in the axes of the tether; those that fill up the last block have no amplitude.
#[derive(Clone, Debug)]
struct WaveBlock {
    kx: Lanes8,
    ky: Lanes8,
    k: Lanes8,
    /// Frequency of encounter (rad/s), phase at the first node (rad).
    met: Lanes8,
    phase: Lanes8,
    /// Speed at the surface `a w` (m/s), and what makes it the amplitude: 1/w (s).
    speed: Lanes8,
    slowness: Lanes8,
    /// What makes it the velocity along x and y, and the acceleration along x, y (1/s) and z (1/s).
    toward: [Lanes8; 2],
    growth: [Lanes8; 3],
    /// exp(-2 k d), and one over one less it.
    q: Lanes8,
    whole: Lanes8,
    /// Whether q is nothing for all of them.
    deep: bool,
}

/// The water of a towed tether.
#[derive(Clone, Debug)]
pub struct Waters {
    blocks: Vec<WaveBlock>,
    /// Whether a wave goes across the axis.
    pub lateral: bool,
    /// Largest wave number along the axis (1/m).
    pub steepest: f64,
    /// Current less tow in the axes of the tether: height (m) and velocity along x and y (m/s), heights falling.
    current: Vec<(f64, [f64; 2])>,
    depth: Option<f64>,
    stretched: bool,
    /// The wave where it is Stokes', with its direction in the axes of the tether.
    stokes: Option<(Stokes, [f64; 2])>,
}

/// Velocity and acceleration of the water in the axes of the tether; the tow is taken off the velocity.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TowedFlow {
    /// Along x, y, z (m/s).
    pub velocity: [f64; 3],
    /// Along x, y, z (m/s2).
    pub acceleration: [f64; 3],
}

/// Lanes8 values, each of its number.
#[inline(always)]
fn lanes8(value: impl Fn(usize) -> f64) -> Lanes8 {
    let mut made = [0.0; 8];
    for (i, lane) in made.iter_mut().enumerate() {
        *lane = value(i);
    }
    made
}

impl Waters {
    /// That around a tether.
    pub fn new(case: &Towed) -> Self {
        let (sin, cos) = case.heading.sin_cos();
        let turned = |v: [f64; 2]| [cos * v[0] + sin * v[1], cos * v[1] - sin * v[0]];
        let still = [(0.0, [0.0; 2])];
        let given = if case.current.is_empty() { &still[..] } else { &case.current[..] };
        let past = |(height, v): &(f64, [f64; 2])| (*height, turned([v[0] - case.tow[0], v[1] - case.tow[1]]));
        let current: Vec<_> = given.iter().map(past).collect();
        let surface = current.first().map_or([0.0; 2], |c| c.1);
        let block = |waves: &[Component]| {
            let each = |value: &dyn Fn(&Component) -> f64| {
                let mut lanes = [0.0; 8];
                lanes.iter_mut().zip(waves).for_each(|(lane, wave)| *lane = value(wave));
                lanes
            };
            let toward = |c: &Component| turned(c.toward);
            let kd = |c: &Component| case.depth.map_or(f64::INFINITY, |d| c.number * d);
            let q = each(&|c| if kd(c) > DEEP_WATER_KD { 0.0 } else { (-2.0 * kd(c)).exp() });
            WaveBlock {
                kx: each(&|c| c.number * toward(c)[0]),
                ky: each(&|c| c.number * toward(c)[1]),
                k: each(&|c| c.number),
                met: each(&|c| c.frequency + c.number * (toward(c)[0] * surface[0] + toward(c)[1] * surface[1])),
                phase: each(&|c| c.phase + c.number * (c.toward[0] * case.origin[0] + c.toward[1] * case.origin[1])),
                speed: each(&|c| c.amplitude * c.frequency),
                slowness: each(&|c| 1.0 / c.frequency),
                toward: [each(&|c| toward(c)[0]), each(&|c| toward(c)[1])],
                growth: [
                    each(&|c| c.frequency * toward(c)[0]),
                    each(&|c| c.frequency * toward(c)[1]),
                    each(&|c| c.frequency),
                ],
                q,
                whole: each(&|c| -1.0 / (-2.0 * kd(c)).exp_m1()),
                deep: q.iter().all(|v| *v == 0.0),
            }
        };
        let blocks: Vec<WaveBlock> = case.waves.chunks(8).map(block).collect();
        // a wave along the axis has the rounding of its direction's sine across it
        let lateral = blocks.iter().any(|b| b.ky.iter().zip(&b.k).any(|(y, k)| y.abs() > 1e-12 * k));
        let stretched = !case.compatibility.unstretched_crests;
        let steepest = blocks.iter().flat_map(|b| b.kx).fold(0.0, |most: f64, k| most.max(k.abs()));
        // a wave of no height has no angle
        let stokes = case.stokes.filter(|wave| wave.height > 0.0).map(|wave| (wave, turned(wave.toward)));
        Waters { blocks, lateral, steepest, current, depth: case.depth, stretched, stokes }
    }

    /// Number of blocks of eight waves.
    pub fn blocks(&self) -> usize {
        self.blocks.len()
    }

    /// Turns of the waves at a time (s), times their speeds, into a list that is there.
    pub fn at_time(&self, time: f64, turns: &mut Vec<Turn>) {
        turns.clear();
        turns.extend(self.blocks.iter().map(|b| {
            let (sin, cos) = sin_cos(&lanes8(|i| b.phase[i] - b.met[i] * time));
            [lanes8(|i| b.speed[i] * cos[i]), lanes8(|i| b.speed[i] * sin[i])]
        }));
    }

    /// Turns of the waves at a place (m), to the end of a list.
    pub fn at_place(&self, x: f64, y: f64, turns: &mut Vec<Turn>) {
        turns.extend(self.blocks.iter().map(|b| {
            let (sin, cos) = sin_cos(&lanes8(|i| b.kx[i] * x + b.ky[i] * y));
            [cos, sin]
        }));
    }

    /// Turns at a place that lies so far (m) along the axis from one whose turns are at hand, to the end of a list: by the series of sine
    /// and cosine, for changes of phase up to 0.1.
    pub fn at_shifted_place(&self, turns: &[Turn], shift: f64, shifted: &mut Vec<Turn>) {
        let from = shifted.len();
        shifted.extend_from_slice(turns);
        shift_turns(&self.blocks, shift, &mut shifted[from..]);
    }

    /// Height of the surface above the still water level (m).
    #[inline]
    pub fn elevation(&self, time: &[Turn], position: &[Turn]) -> f64 {
        if let Some((wave, _)) = &self.stokes {
            return wave.elevation_of_phase(self.first_phase(time, position));
        }
        total(&elevations(&self.blocks, time, position))
    }

    /// The water at a height above the still water level (m), under a surface of an elevation (m).
    pub fn flow(&self, time: &[Turn], position: &[Turn], height: f64, elevation: f64) -> TowedFlow {
        if let Some((wave, toward)) = &self.stokes {
            let motion = wave.particle_of_phase(self.first_phase(time, position), height);
            let axes = |[along, up]: [f64; 2]| [toward[0] * along, toward[1] * along, up];
            let [u, v, w] = axes(motion.velocity);
            let [cx, cy] = self.current_at(height);
            return TowedFlow { velocity: [u + cx, v + cy, w], acceleration: axes(motion.acceleration) };
        }
        let z = self.reach(height, elevation);
        let sums = flows(&self.blocks, time, position, z, self.lateral);
        let [u, v, w, ax, ay, az] = sums.map(|s| (s[0] + s[2]) + (s[1] + s[3]));
        let [cx, cy] = self.current_at(height);
        TowedFlow { velocity: [u + cx, v + cy, w], acceleration: [ax, ay, az] }
    }

    /// Cosine and sine of the angle of the first wave.
    fn first_phase(&self, time: &[Turn], position: &[Turn]) -> [f64; 2] {
        let (Some(block), Some(t), Some(p)) = (self.blocks.first(), time.first(), position.first()) else {
            return [1.0, 0.0];
        };
        let speed = block.speed[0];
        [(t[0][0] * p[0][0] - t[1][0] * p[1][0]) / speed, (t[1][0] * p[0][0] + t[0][0] * p[1][0]) / speed]
    }

    /// The height at which the waves are taken for that of a place [WHEELER-1970]: the actual surface is taken for the still
    /// one, the bottom stays; what is above the surface is as on it.
    #[inline]
    fn reach(&self, height: f64, elevation: f64) -> f64 {
        if !self.stretched {
            return height;
        }
        let scale = self.depth.map_or(1.0, |d| d / (d + elevation).max(f64::MIN_POSITIVE));
        ((height - elevation) * scale).min(0.0)
    }

    /// Current less tow at a height (m), along x and y (m/s).
    fn current_at(&self, height: f64) -> [f64; 2] {
        let below = self.current.iter().position(|c| c.0 <= height);
        match below {
            Some(0) => self.current[0].1,
            None => self.current.last().map_or([0.0; 2], |c| c.1),
            Some(i) => {
                let ((high, above), (low, under)) = (self.current[i - 1], self.current[i]);
                let share = (height - low) / (high - low);
                [under[0] + share * (above[0] - under[0]), under[1] + share * (above[1] - under[1])]
            }
        }
    }

    /// The longest integration length (m): a quarter of the length of the wave with number 4N/5 + 1 of N in order of their
    /// wave numbers; of a regular wave its own [AQWA-TETHER 3.4]. `None` without waves.
    pub fn integration_length(waves: &[Component]) -> Option<f64> {
        let mut numbers: Vec<f64> = waves.iter().map(|c| c.number).collect();
        numbers.sort_by(f64::total_cmp);
        numbers.get(4 * numbers.len() / 5).map(|k| std::f64::consts::FRAC_PI_2 / k)
    }
}

/// Takes turns at a place to one that lies so far (m) along the axis.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn shift_turns(blocks: &[WaveBlock], shift: f64, turns: &mut [Turn]) {
    for (block, [cos, sin]) in blocks.iter().zip(turns) {
        for i in 0..8 {
            let phase = block.kx[i] * shift;
            let square = phase * phase;
            let s = phase * (1.0 - square / 6.0 * (1.0 - square / 20.0 * (1.0 - square / 42.0)));
            let c = 1.0 - square / 2.0 * (1.0 - square / 12.0 * (1.0 - square / 30.0 * (1.0 - square / 56.0)));
            (cos[i], sin[i]) = (cos[i] * c - sin[i] * s, sin[i] * c + cos[i] * s);
        }
    }
}

/// Sums of the elevations of every eighth wave (m).
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn elevations(blocks: &[WaveBlock], time: &[Turn], position: &[Turn]) -> Lanes8 {
    let mut sums = [0.0; 8];
    for ((block, t), p) in blocks.iter().zip(time).zip(position) {
        for (i, sum) in sums.iter_mut().enumerate() {
            *sum += block.slowness[i] * (t[0][i] * p[0][i] - t[1][i] * p[1][i]);
        }
    }
    sums
}

/// Sums of the velocities and accelerations of every fourth wave at a height.
#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn flows(blocks: &[WaveBlock], time: &[Turn], position: &[Turn], z: f64, lateral: bool) -> [Lanes4; 6] {
    let mut sums = [[0.0; 4]; 6];
    for ((b, t), p) in blocks.iter().zip(time).zip(position) {
        if b.deep {
            half::<true, 0>(b, t, p, z, lateral, &mut sums);
            half::<true, 4>(b, t, p, z, lateral, &mut sums);
        } else {
            half::<false, 0>(b, t, p, z, lateral, &mut sums);
            half::<false, 4>(b, t, p, z, lateral, &mut sums);
        }
    }
    sums
}

/// Adds the velocities and accelerations of four waves of a block, from number `FROM`, at a height.
#[inline(always)]
fn half<const DEEP: bool, const FROM: usize>(
    b: &WaveBlock,
    t: &Turn,
    p: &Turn,
    z: f64,
    lateral: bool,
    sums: &mut [Lanes4; 6],
) {
    let grown = exp(four(|i| b.k[FROM + i] * z));
    let (along, up) = if DEEP {
        (grown, grown)
    } else {
        let back = four(|i| b.q[FROM + i] / grown[i]);
        (four(|i| (grown[i] + back[i]) * b.whole[FROM + i]), four(|i| (grown[i] - back[i]) * b.whole[FROM + i]))
    };
    let cos = four(|i| t[0][FROM + i] * p[0][FROM + i] - t[1][FROM + i] * p[1][FROM + i]);
    let sin = four(|i| t[1][FROM + i] * p[0][FROM + i] + t[0][FROM + i] * p[1][FROM + i]);
    let (ac, as_) = (four(|i| along[i] * cos[i]), four(|i| along[i] * sin[i]));
    sums[0] = four(|i| sums[0][i] + b.toward[0][FROM + i] * ac[i]);
    sums[2] = four(|i| sums[2][i] + up[i] * sin[i]);
    sums[3] = four(|i| sums[3][i] + b.growth[0][FROM + i] * as_[i]);
    sums[5] = four(|i| sums[5][i] - b.growth[2][FROM + i] * up[i] * cos[i]);
    // most seas have none across
    if lateral {
        sums[1] = four(|i| sums[1][i] + b.toward[1][FROM + i] * ac[i]);
        sums[4] = four(|i| sums[4][i] + b.growth[1][FROM + i] * as_[i]);
    }
}

/// The sum of eight.
#[inline]
fn total(lanes: &Lanes8) -> f64 {
    ((lanes[0] + lanes[4]) + (lanes[2] + lanes[6])) + ((lanes[1] + lanes[5]) + (lanes[3] + lanes[7]))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests;
