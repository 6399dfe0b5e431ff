//! The waves of a sea gathered by their direction, with tables of what they do by heading, summed fast.
//!
//! Waves lie eight by eight, and a sum over them is eight sums side by side in a fixed order. The sums are compiled for several
//! widths of vector register and the machine takes the widest that it has (multiversion); no product is contracted with its sum, so
//! that the digits are the same on all of them.

use super::checks::MAX_DATABASE_NUMBERS;
use super::interpolation::bracket_heading;
use crate::sea::Sea;
use multiversion::multiversion;
use std::f64::consts::FRAC_2_PI;
use windlass_model::ClassError;

/// Waves side by side.
pub(super) const LANES: usize = 8;
/// One number of each of them.
pub(super) type LaneValues = [f64; LANES];
/// Sine and cosine, or another pair, of each.
pub(super) type Pairs = [LaneValues; 2];

/// Waves of one direction of travel.
#[derive(Clone, Debug, Default)]
pub(super) struct WaveGroup {
    /// Direction of travel (rad, global).
    pub toward: f64,
    /// Amplitudes (m), frequencies (rad/s).
    pub amplitude: Vec<f64>,
    pub frequency: Vec<f64>,
    /// Frequencies, wave numbers by x and y (1/m) and phases (rad), eight waves at a time; of what fills the last eight, nothing.
    phases: Vec<[LaneValues; 4]>,
}

impl WaveGroup {
    /// Cosines and sines of `k . x - w t + phase`, eight waves at a time.
    pub fn phasors(&self, at: (f64, f64, f64)) -> impl Iterator<Item = Pairs> + '_ {
        self.phases.iter().map(move |waves| phasors(waves, at))
    }

    fn push(&mut self, [amplitude, frequency, kx, ky, phase]: [f64; 5]) {
        let position = self.amplitude.len() % LANES;
        self.amplitude.push(amplitude);
        self.frequency.push(frequency);
        if position == 0 {
            self.phases.push([[0.0; LANES]; 4]);
        }
        if let Some(last) = self.phases.last_mut() {
            for (lane, value) in last.iter_mut().zip([frequency, kx, ky, phase]) {
                lane[position] = value;
            }
        }
    }
}

/// Cosines and sines of eight waves.
#[inline(always)]
fn phasors([w, kx, ky, phase]: &[LaneValues; 4], (time, x, y): (f64, f64, f64)) -> Pairs {
    let [mut cos, mut sin] = [[0.0; LANES]; 2];
    for n in 0..LANES {
        let angle = kx[n] * x + ky[n] * y + phase[n] - w[n] * time;
        (sin[n], cos[n]) = sine_and_cosine(angle);
    }
    [cos, sin]
}

/// The waves of a sea by their directions, in the order in which they come.
pub(super) fn groups(sea: &Sea) -> Vec<WaveGroup> {
    let mut groups: Vec<([f64; 2], WaveGroup)> = Vec::new();
    for wave in &sea.components {
        let index = match groups.iter().position(|g| g.0 == wave.toward) {
            Some(index) => index,
            None => {
                let toward = wave.toward[1].atan2(wave.toward[0]);
                groups.push((wave.toward, WaveGroup { toward, ..WaveGroup::default() }));
                groups.len() - 1
            }
        };
        if let Some((_, group)) = groups.get_mut(index) {
            let [x, y] = wave.toward.map(|part| wave.number * part);
            group.push([wave.amplitude, wave.frequency, x, y, wave.phase]);
        }
    }
    groups.into_iter().map(|g| g.1).collect()
}

/// Values of a heading, eight waves at a time, and the share of the heading.
type Share<'a, const WIDTH: usize> = (&'a [[LaneValues; WIDTH]], f64);

/// Values of each wave of a group at each heading of a table, `WIDTH` of them.
#[derive(Clone, Debug)]
pub(super) struct WaveTable<const WIDTH: usize> {
    headings: Vec<f64>,
    /// By heading, values of the waves of the group, eight at a time; of what fills the last eight, nothing.
    tables: Vec<Vec<[LaneValues; WIDTH]>>,
}

impl<const WIDTH: usize> WaveTable<WIDTH> {
    /// A table of values of the waves of a group.
    ///
    /// # Errors
    /// More values than memory is taken for; values that are not there.
    pub fn build(
        group: &WaveGroup,
        headings: &[f64],
        mut value: impl FnMut(usize, f64, f64) -> Result<[f64; WIDTH], ClassError>,
    ) -> Result<Self, ClassError> {
        if group.amplitude.len().saturating_mul(headings.len()).saturating_mul(WIDTH) > MAX_DATABASE_NUMBERS {
            return Err(ClassError::new("the sea has more waves, and the database more headings, than are tabulated"));
        }
        let mut tables = Vec::with_capacity(headings.len());
        for (index, _) in headings.iter().enumerate() {
            let mut table = Vec::with_capacity(group.phases.len());
            for (frequencies, amplitudes) in group.frequency.chunks(LANES).zip(group.amplitude.chunks(LANES)) {
                let mut lanes = [[0.0; LANES]; WIDTH];
                for (position, (w, a)) in frequencies.iter().zip(amplitudes).enumerate() {
                    let values = value(index, *w, *a)?;
                    lanes.iter_mut().zip(values).for_each(|(lane, v)| lane[position] = v);
                }
                table.push(lanes);
            }
            tables.push(table);
        }
        Ok(WaveTable { headings: headings.to_vec(), tables })
    }

    /// The tables around a heading (rad), and the share of the second.
    ///
    /// # Errors
    /// A heading in a gap of the table.
    fn bracket_tables(&self, heading: f64) -> Result<[Share<'_, WIDTH>; 2], ClassError> {
        let (a, b, share) = bracket_heading(&self.headings, heading)?;
        match (self.tables.get(a), self.tables.get(b)) {
            (Some(first), Some(second)) => Ok([(first, 1.0 - share), (second, share)]),
            _ => Err(ClassError::new("the database has no headings")),
        }
    }
}

impl WaveTable<12> {
    /// `Re sum X exp(i q)` of the waves of the group, `q = k . x - w t + phase`, at a time (s) and place (m), toward a heading (rad): six
    /// real parts are followed by six imaginary ones.
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn real(&self, group: &WaveGroup, at: (f64, f64, f64), heading: f64) -> Result<[f64; 6], ClassError> {
        Ok(real(&group.phases, at, self.bracket_tables(heading)?))
    }
}

impl WaveTable<7> {
    /// `sum D exp(i q)` of the waves of the group, real and imaginary parts, as [`WaveTable::real`].
    ///
    /// # Errors
    /// A heading in a gap of the table.
    pub fn whole(&self, group: &WaveGroup, at: (f64, f64, f64), heading: f64) -> Result<[[f64; 7]; 2], ClassError> {
        Ok(whole(&group.phases, at, self.bracket_tables(heading)?))
    }
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn real(waves: &[[LaneValues; 4]], at: (f64, f64, f64), [(first, a), (second, b)]: [Share<'_, 12>; 2]) -> [f64; 6] {
    let mut sums = [[0.0; LANES]; 6];
    for ((waves, first), second) in waves.iter().zip(first).zip(second) {
        let [cos, sin] = phasors(waves, at);
        for (mode, sum) in sums.iter_mut().enumerate() {
            let (low, high) = ([&first[mode], &first[mode + 6]], [&second[mode], &second[mode + 6]]);
            for n in 0..LANES {
                sum[n] += (a * low[0][n] + b * high[0][n]) * cos[n] - (a * low[1][n] + b * high[1][n]) * sin[n];
            }
        }
    }
    sums.map(|sum| sum.iter().sum())
}

#[multiversion(targets("x86_64+avx512f+avx512dq+avx512vl", "x86_64+avx2"))]
fn whole(
    waves: &[[LaneValues; 4]],
    at: (f64, f64, f64),
    [(first, a), (second, b)]: [Share<'_, 7>; 2],
) -> [[f64; 7]; 2] {
    let mut sums = [[[0.0; LANES]; 7]; 2];
    for ((waves, first), second) in waves.iter().zip(first).zip(second) {
        let phasors = phasors(waves, at);
        for (sums, part) in sums.iter_mut().zip(&phasors) {
            for ((sum, low), high) in sums.iter_mut().zip(first).zip(second) {
                for n in 0..LANES {
                    sum[n] += (a * low[n] + b * high[n]) * part[n];
                }
            }
        }
    }
    sums.map(|modes| modes.map(|sum| sum.iter().sum()))
}

/// Sine and cosine of an angle of some 1e6 rad at most, without branches so that a loop of it runs in vectors: to 1 ulp and the
/// rounding of the angle. The angle less whole quarters in two parts (Cody and Waite), then the polynomials of fdlibm (k_sin.c, k_cos.c).
#[inline(always)]
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
    // odd quarters swap the two; quarters 2 and 3 turn the sine round, 1 and 2 the cosine
    let (sine, cosine) = (sine.to_bits(), cosine.to_bits());
    let swap = (sine ^ cosine) & 0u64.wrapping_sub(turn & 1);
    let sign = |quarters: u64| (quarters << 62) & (1 << 63);
    (f64::from_bits(sine ^ swap ^ sign(turn)), f64::from_bits(cosine ^ swap ^ sign(turn ^ (turn << 1))))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_match_library() {
        for n in -200_000..200_000 {
            let angle = 0.7317 * f64::from(n);
            let (sine, cosine) = sine_and_cosine(angle);
            // an ulp of 1, and what three parts of a quarter turn leave over 1e5 of them
            assert!((sine - angle.sin()).abs() < 1e-15 && (cosine - angle.cos()).abs() < 1e-15, "{angle}");
        }
    }

    #[test]
    fn batched_wave_sums_match_single_sums() {
        let mut group = WaveGroup::default();
        for n in 0..203 {
            let n = f64::from(n);
            group.push([1.0 + (0.3 * n).sin(), 0.2 + 0.011 * n, 0.02 * n.cos(), 0.03 * (1.7 * n).sin(), 2.3 * n]);
        }
        let value = |h: usize, w: f64, mode: usize| (w * (h as f64 + 1.7) * (mode as f64 + 0.6)).sin();
        let headings = [0.0, 1.2, 2.4, 3.6, 4.8];
        let excitation =
            WaveTable::<12>::build(&group, &headings, |h, w, a| Ok(std::array::from_fn(|mode| a * value(h, w, mode))));
        let drift =
            WaveTable::<7>::build(&group, &headings, |h, w, a| Ok(std::array::from_fn(|mode| a * value(h, w, mode))));
        let (time, x, y) = (9876.5, 12.25, -3.5);
        let found = excitation.unwrap().real(&group, (time, x, y), 1.5).unwrap();
        let [real, imaginary] = drift.unwrap().whole(&group, (time, x, y), 1.5).unwrap();
        let share = 0.3 / 1.2;
        for mode in 0..7 {
            let mut sums = [0.0; 3];
            for n in 0..203 {
                let w = group.frequency[n];
                let [_, kx, ky, phase] = group.phases[n / LANES].map(|lane| lane[n % LANES]);
                let (sin, cos) = (kx * x + ky * y + phase - w * time).sin_cos();
                let at =
                    |mode: usize| group.amplitude[n] * ((1.0 - share) * value(1, w, mode) + share * value(2, w, mode));
                sums[0] += at(mode) * cos - at((mode + 6) % 12) * sin;
                sums[1] += at(mode) * cos;
                sums[2] += at(mode) * sin;
            }
            // 200 terms of some 1, phases of 2e4 to 4e-12: 1e-9 of the force is 1e-8
            assert!(mode > 5 || (found[mode] - sums[0]).abs() < 1e-10, "{mode}");
            assert!((real[mode] - sums[1]).abs() < 1e-10 && (imaginary[mode] - sums[2]).abs() < 1e-10, "{mode}");
        }
    }
}
