//! The waves of a sea gathered by their direction, with tables of what they do by heading, summed fast.

use super::at::around;
use super::checks::MOST;
use crate::hydro::sea::Sea;
use crate::model::ClassError;
use std::f64::consts::FRAC_2_PI;

/// Waves taken at a time.
pub(super) const BLOCK: usize = 64;

/// Waves of one direction of travel.
#[derive(Clone, Debug, Default)]
pub(super) struct Group {
    /// Direction of travel (rad, global).
    pub toward: f64,
    /// Amplitudes (m), frequencies (rad/s), wave numbers by x and y (1/m), phases (rad).
    pub amplitude: Vec<f64>,
    pub frequency: Vec<f64>,
    kx: Vec<f64>,
    ky: Vec<f64>,
    phase: Vec<f64>,
}

impl Group {
    /// Cosine and sine of `k . x - w t + phase` of a block of waves.
    pub fn phasors(&self, block: usize, (time, x, y): (f64, f64, f64), out: &mut [[f64; BLOCK]; 2]) -> usize {
        let from = block * BLOCK;
        let part = |list: &'_ [f64]| -> (usize, [f64; BLOCK]) {
            let mut own = [0.0; BLOCK];
            let source = list.get(from..).unwrap_or_default();
            let count = source.len().min(BLOCK);
            own[..count].copy_from_slice(&source[..count]);
            (count, own)
        };
        let ((count, w), (_, kx), (_, ky), (_, phase)) =
            (part(&self.frequency), part(&self.kx), part(&self.ky), part(&self.phase));
        let [cos, sin] = out;
        for n in 0..BLOCK {
            let angle = kx[n] * x + ky[n] * y + phase[n] - w[n] * time;
            (sin[n], cos[n]) = sine_and_cosine(angle);
        }
        count
    }

    /// How many blocks there are.
    pub fn blocks(&self) -> usize {
        self.amplitude.len().div_ceil(BLOCK)
    }
}

/// The waves of a sea by their directions, in the order in which they come.
pub(super) fn groups(sea: &Sea) -> Vec<Group> {
    let mut groups: Vec<([f64; 2], Group)> = Vec::new();
    for wave in &sea.components {
        let index = match groups.iter().position(|g| g.0 == wave.toward) {
            Some(index) => index,
            None => {
                let toward = wave.toward[1].atan2(wave.toward[0]);
                groups.push((wave.toward, Group { toward, ..Group::default() }));
                groups.len() - 1
            }
        };
        if let Some((_, group)) = groups.get_mut(index) {
            group.amplitude.push(wave.amplitude);
            group.frequency.push(wave.frequency);
            group.kx.push(wave.number * wave.toward[0]);
            group.ky.push(wave.number * wave.toward[1]);
            group.phase.push(wave.phase);
        }
    }
    groups.into_iter().map(|g| g.1).collect()
}

/// The lanes of a heading, and their share.
type Share<'a, const WIDTH: usize> = (&'a [Vec<f64>; WIDTH], f64);

/// Values of each wave of each group at each heading of a table, `WIDTH` lanes of them.
#[derive(Clone, Debug)]
pub(super) struct ByHeading<const WIDTH: usize> {
    headings: Vec<f64>,
    /// By heading, lanes of the waves of the group.
    tables: Vec<[Vec<f64>; WIDTH]>,
}

impl<const WIDTH: usize> ByHeading<WIDTH> {
    /// A table of values of the waves of a group.
    ///
    /// # Errors
    /// More values than memory is taken for; values that are not there.
    pub fn of(
        group: &Group,
        headings: &[f64],
        mut value: impl FnMut(usize, f64, f64) -> Result<[f64; WIDTH], ClassError>,
    ) -> Result<Self, ClassError> {
        if group.amplitude.len().saturating_mul(headings.len()).saturating_mul(WIDTH) > MOST {
            return Err(ClassError::new("the sea has more waves, and the database more headings, than are tabulated"));
        }
        let mut tables = Vec::with_capacity(headings.len());
        for (index, _) in headings.iter().enumerate() {
            let mut lanes: [Vec<f64>; WIDTH] = std::array::from_fn(|_| Vec::with_capacity(group.amplitude.len()));
            for (w, a) in group.frequency.iter().zip(&group.amplitude) {
                let values = value(index, *w, *a)?;
                lanes.iter_mut().zip(values).for_each(|(lane, v)| lane.push(v));
            }
            tables.push(lanes);
        }
        Ok(ByHeading { headings: headings.to_vec(), tables })
    }

    /// The tables around a heading (rad), and the share of the second.
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn around(&self, heading: f64) -> Result<[Share<'_, WIDTH>; 2], ClassError> {
        let (a, b, share) = around(&self.headings, heading)?;
        match (self.tables.get(a), self.tables.get(b)) {
            (Some(first), Some(second)) => Ok([(first, 1.0 - share), (second, share)]),
            _ => Err(ClassError::new("the database has no headings")),
        }
    }
}

/// A block of a lane.
pub(super) fn block(lane: &[f64], index: usize) -> &[f64] {
    let rest = lane.get(index * BLOCK..).unwrap_or_default();
    rest.get(..rest.len().min(BLOCK)).unwrap_or_default()
}

/// The sum of products of a lane with a phasor, in four sums side by side; the order is fixed.
pub(super) fn dot(lane: &[f64], phasor: &[f64]) -> f64 {
    let mut sums = [0.0; 4];
    let (lanes, phasors) = (lane.chunks_exact(4), phasor.get(..lane.len()).unwrap_or_default().chunks_exact(4));
    let rest: f64 = lanes.remainder().iter().zip(phasors.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in lanes.zip(phasors) {
        for (sum, (a, b)) in sums.iter_mut().zip(a.iter().zip(b)) {
            *sum += a * b;
        }
    }
    sums[0] + sums[1] + (sums[2] + sums[3]) + rest
}

/// The sum of `real cos - imaginary sin`, in eight sums side by side; the order is fixed.
pub(super) fn real_part(real: &[f64], imaginary: &[f64], [cos, sin]: &[[f64; BLOCK]; 2]) -> f64 {
    let count = real.len().min(imaginary.len()).min(BLOCK);
    let (real, imaginary) = (real[..count].chunks_exact(8), imaginary[..count].chunks_exact(8));
    let done = count - real.remainder().len();
    let last = real.remainder().iter().zip(imaginary.remainder()).zip(cos[done..].iter().zip(&sin[done..]));
    let rest: f64 = last.map(|((a, b), (c, s))| a * c - b * s).sum();
    let mut sums = [0.0; 8];
    for ((a, b), (c, s)) in real.zip(imaginary).zip(cos.chunks_exact(8).zip(sin.chunks_exact(8))) {
        for n in 0..8 {
            sums[n] += a[n] * c[n] - b[n] * s[n];
        }
    }
    sums.iter().sum::<f64>() + rest
}

/// Sine and cosine of an angle of some 1e6 rad at most, without branches so that a loop of it runs in vectors: to 1 ulp and the
/// rounding of the angle. The angle less whole quarters in two parts (Cody and Waite), then the polynomials of fdlibm (k_sin.c, k_cos.c).
fn sine_and_cosine(angle: f64) -> (f64, f64) {
    // adding it leaves a whole number in the last digits
    const WHOLE: f64 = 6_755_399_441_055_744.0;
    const QUARTER: [f64; 3] = [
        f64::from_bits(0x3FF9_21FB_5440_0000),
        f64::from_bits(0x3DD0_B461_1A60_0000),
        f64::from_bits(0x3BA3_198A_2E03_7073),
    ];
    let shifted = angle * FRAC_2_PI + WHOLE;
    let quarters = shifted - WHOLE;
    let turn = shifted.to_bits();
    let x = ((angle - quarters * QUARTER[0]) - quarters * QUARTER[1]) - quarters * QUARTER[2];
    let z = x * x;
    let sine = x + x
        * z
        * (-1.666_666_666_666_663_2e-1
            + z * (8.333_333_333_322_49e-3
                + z * (-1.984_126_982_985_795e-4
                    + z * (2.755_731_370_707_006_8e-6
                        + z * (-2.505_076_025_340_686_4e-8 + z * 1.589_690_995_211_55e-10)))));
    let cosine = 1.0 - 0.5 * z
        + z * z
            * (4.166_666_666_666_66e-2
                + z * (-1.388_888_888_887_411e-3
                    + z * (2.480_158_728_947_673e-5
                        + z * (-2.755_731_435_139_066_4e-7
                            + z * (2.087_572_321_298_175e-9 + z * -1.135_964_755_778_819_5e-11)))));
    let odd = turn & 1 == 1;
    let (s, c) = if odd { (cosine, sine) } else { (sine, cosine) };
    // quarters 2 and 3 turn the sine round, 1 and 2 the cosine
    let negative = |flag: u64, value: f64| f64::from_bits(value.to_bits() ^ (flag << 63));
    (negative((turn >> 1) & 1, s), negative(((turn >> 1) ^ turn) & 1, c))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_are_those_of_the_library() {
        for n in -200_000..200_000 {
            let angle = 0.7317 * f64::from(n);
            let (sine, cosine) = sine_and_cosine(angle);
            // an ulp of 1, and what three parts of a quarter turn leave over 1e5 of them
            assert!((sine - angle.sin()).abs() < 1e-15 && (cosine - angle.cos()).abs() < 1e-15, "{angle}");
        }
    }
}
