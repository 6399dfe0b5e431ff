//! Fatigue life and expected peak stress along a tether [AQWA-TETHER 3.7, 7.9, 7.10].

use super::dripping::half_cycles;
use super::global::spread;
use crate::SeriesError;

/// Number of stress ranges that half cycles are counted into (figure 7.9).
pub const STRESS_RANGE_BINS: usize = 50;

/// Lives are cut off here (days), as the listing does.
pub const LONGEST_LIFE: f64 = 99_999.0;

const CIRCUMFERENCE_POINTS: usize = 18;

/// S-N curve and concentration (card TFAT, appendix A.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Endurance {
    /// Stress concentration factor on the range.
    pub concentration: f64,
    /// Intercept A of N = A / R^m, with R in the unit of the stresses given.
    pub intercept: f64,
    /// Slope m.
    pub slope: f64,
}

impl Endurance {
    /// The defaults of card TFAT, for stresses in kN/m2.
    pub const KILONEWTONS: Endurance = Endurance { concentration: 1.24, intercept: 1.3367e24, slope: 3.5 };

    /// The same curve for stresses in a unit of which one kN/m2 (or what this curve is for) has `factor`.
    #[must_use]
    pub fn in_unit(self, factor: f64) -> Endurance {
        Endurance { intercept: self.intercept * factor.powf(self.slope), ..self }
    }

    fn check(self) -> Result<(), SeriesError> {
        let above = |what: &'static str, value: f64| {
            let fits = value.is_finite() && value > 0.0;
            if fits { Ok(()) } else { Err(SeriesError::Setting { what, expected: "above zero", value }) }
        };
        above("the stress concentration factor", self.concentration)?;
        above("the S-N curve's intercept", self.intercept)?;
        above("the S-N curve's slope", self.slope)
    }
}

/// Half cycles counted by stress range into [`STRESS_RANGE_BINS`] equal bins from zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Ranges {
    /// Width of a bin.
    pub width: f64,
    /// Half cycles of each bin.
    pub counts: [u64; STRESS_RANGE_BINS],
}

impl Ranges {
    /// Counts of no cycles, for bins of this width (Pa).
    pub fn from_width(width: f64) -> Ranges {
        Ranges { width, counts: [0; STRESS_RANGE_BINS] }
    }

    /// Counts the half cycles of a series. What is beyond the last bin counts there.
    pub fn count(values: &[f64], width: f64) -> Ranges {
        let mut ranges = Ranges::from_width(width);
        for range in half_cycles(values) {
            let bin = if width > 0.0 { (range / width) as usize } else { 0 };
            if let Some(count) = ranges.counts.get_mut(bin.min(STRESS_RANGE_BINS - 1)) {
                *count += 1;
            }
        }
        ranges
    }

    /// Half cycles of all bins.
    pub fn total(&self) -> u64 {
        self.counts.iter().sum()
    }

    /// The range that does the same damage in as many cycles, with the concentration factor in it:
    /// [sum n (SCF R)^m / sum n]^(1/m), R the middle of a bin. Zero without cycles.
    pub fn effective(&self, curve: Endurance) -> f64 {
        let total = self.total();
        if total == 0 {
            return 0.0;
        }
        let middle = |bin: usize| (bin as f64 + 0.5) * self.width * curve.concentration;
        let sum: f64 = self.counts.iter().enumerate().map(|(bin, n)| *n as f64 * middle(bin).powf(curve.slope)).sum();
        (sum / total as f64).powf(curve.slope.recip())
    }
}

/// Damage a second of `cycles` a second at an effective range: N R^m / A (3.7 with its misprint mended: the
/// concentration factor is raised to the slope with the range).
pub fn damage_rate(effective: f64, cycles: f64, curve: Endurance) -> f64 {
    cycles * effective.powf(curve.slope) / curve.intercept
}

/// Life (days) at a damage a second, at most [`LONGEST_LIFE`].
pub fn life_days(damage_rate: f64) -> f64 {
    (1.0 / (damage_rate * 86_400.0)).min(LONGEST_LIFE)
}

/// Peak expected of a Rayleigh-distributed stress, in the unit of `mean` and `rms`: |mean| + rms sqrt(2 ln n) with the number n of cycles in
/// the time [AQWA-TETHER 3.7],
/// with a misprint mended. With less than one cycle, the mean alone.
pub fn expected_peak(mean: f64, rms: f64, cycles: f64) -> f64 {
    mean.abs() + rms * (2.0 * cycles.max(1.0).ln()).sqrt()
}

/// One end of an element in the fatigue table (figure 7.10). Stresses and moments in the units given; frequencies a second.
#[derive(Clone, Debug, PartialEq)]
pub struct EndFatigue {
    /// Significant moment about Y, about Z and at the place of most damage.
    pub significant_moments: [f64; 3],
    /// Effective stress range at the place of most damage.
    pub effective_range: f64,
    /// That place round the circumference (rad, a multiple of ten degrees; zero where the moment about Y bends).
    pub angle: f64,
    /// Stress cycles there (1/s).
    pub cycles: f64,
    /// Damage there (1/s).
    pub damage_rate: f64,
    /// Life (days), at most [`LONGEST_LIFE`].
    pub life_days: f64,
    /// Largest stress round the circumference in the record.
    pub largest: f64,
    /// Mean stress at the place of the largest expected peak.
    pub mean: f64,
    /// Significant stress there.
    pub significant: f64,
    /// That place (rad).
    pub peak_angle: f64,
    /// Peaks there (1/s).
    pub peak_cycles: f64,
    /// Peak expected in the time asked for.
    pub expected_peak: f64,
    /// Half cycles at the place of most damage.
    pub ranges: Ranges,
}

/// The moments of an element's end over a record.
#[derive(Clone, Copy, Debug)]
pub struct EndRecord<'a> {
    /// Moment about Y.
    pub about_y: &'a [f64],
    /// Moment about Z.
    pub about_z: &'a [f64],
    /// Stress at the outer diameter under a unit moment: radius / second moment of area.
    pub stress_of_moment: f64,
}

/// What holds for all ends of a tether.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FatigueSettings {
    /// Time the record lasts (s).
    pub duration: f64,
    /// S-N curve.
    pub curve: Endurance,
    /// Time a peak is expected in (s), three hours by default (card TPSH).
    pub peak_time: f64,
}

fn moment_at(record: &EndRecord, angle: f64, out: &mut Vec<f64>) {
    let (sine, cosine) = angle.sin_cos();
    out.clear();
    out.extend(record.about_y.iter().zip(record.about_z).map(|(y, z)| y * cosine + z * sine));
}

fn largest_moment(record: &EndRecord) -> f64 {
    record.about_y.iter().zip(record.about_z).map(|(y, z)| y.hypot(*z)).fold(0.0, f64::max)
}

/// Width of the bins (Pa): fifty from zero to twice the largest stress of all ends.
pub fn bin_width(ends: &[EndRecord]) -> f64 {
    let largest = ends.iter().map(|end| largest_moment(end) * end.stress_of_moment).fold(0.0, f64::max);
    2.0 * largest / STRESS_RANGE_BINS as f64
}

/// Fatigue and expected peak of every end; the places of most damage and of the largest expected peak are sought round the
/// circumference every ten degrees.
///
/// # Errors
/// A curve, a duration or a time for peaks that is not above zero, moments of unlike number or not finite.
pub fn fatigue_of_ends(ends: &[EndRecord], asked: FatigueSettings) -> Result<Vec<EndFatigue>, SeriesError> {
    asked.curve.check()?;
    for (what, value) in [("the time of the record", asked.duration), ("the time of expected peaks", asked.peak_time)] {
        if !(value.is_finite() && value > 0.0) {
            return Err(SeriesError::Setting { what, expected: "above zero", value });
        }
    }
    for end in ends {
        if end.about_y.len() != end.about_z.len() {
            return Err(SeriesError::Lengths { times: end.about_y.len(), values: end.about_z.len() });
        }
        crate::finite(end.about_y)?;
        crate::finite(end.about_z)?;
    }
    let width = bin_width(ends);
    Ok(ends.iter().map(|end| of_end(end, width, asked)).collect())
}

fn of_end(end: &EndRecord, width: f64, asked: FatigueSettings) -> EndFatigue {
    let significant = |values: &[f64]| 2.0 * spread(values).1;
    let mut moment = Vec::with_capacity(end.about_y.len());
    let mut found = EndFatigue {
        significant_moments: [significant(end.about_y), significant(end.about_z), 0.0],
        effective_range: 0.0,
        angle: 0.0,
        cycles: 0.0,
        damage_rate: -1.0,
        life_days: LONGEST_LIFE,
        largest: largest_moment(end) * end.stress_of_moment,
        mean: 0.0,
        significant: 0.0,
        peak_angle: 0.0,
        peak_cycles: 0.0,
        expected_peak: -1.0,
        ranges: Ranges::from_width(width),
    };
    for step in 0..CIRCUMFERENCE_POINTS {
        let angle = (step as f64 * 10.0).to_radians();
        moment_at(end, angle, &mut moment);
        let (mean, rms) = spread(&moment);
        moment.iter_mut().for_each(|m| *m *= end.stress_of_moment);
        let ranges = Ranges::count(&moment, width);
        let cycles = 0.5 * ranges.total() as f64 / asked.duration;
        let effective = ranges.effective(asked.curve);
        let damage = damage_rate(effective, cycles, asked.curve);
        // the listing's count of peaks: half of the half cycles, cut to an integer, and one
        let peaks = ((ranges.total() / 2) as f64 + 1.0) / asked.duration;
        let (mean_stress, rms_stress) = (mean * end.stress_of_moment, rms * end.stress_of_moment);
        let peak = expected_peak(mean_stress, rms_stress, peaks * asked.peak_time);
        if damage > found.damage_rate {
            found.damage_rate = damage;
            found.life_days = life_days(damage);
            (found.effective_range, found.angle, found.cycles) = (effective, angle, cycles);
            found.significant_moments = [found.significant_moments[0], found.significant_moments[1], 2.0 * rms];
            found.ranges = ranges;
        }
        if peak > found.expected_peak {
            (found.expected_peak, found.peak_angle, found.peak_cycles) = (peak, angle, peaks);
            (found.mean, found.significant) = (mean_stress, 2.0 * rms_stress);
        }
    }
    found
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bending_plane_is_found_around_the_circumference() {
        let wave = |i: i32| (f64::from(i) * 0.31).sin();
        let (sine, cosine) = 40.0_f64.to_radians().sin_cos();
        let about_y: Vec<f64> = (0..400).map(|i| wave(i) * cosine).collect();
        let about_z: Vec<f64> = (0..400).map(|i| wave(i) * sine).collect();
        let end = EndRecord { about_y: &about_y, about_z: &about_z, stress_of_moment: 30.0 };
        let asked = FatigueSettings { duration: 200.0, curve: Endurance::KILONEWTONS, peak_time: 10_800.0 };
        let found = fatigue_of_ends(&[end], asked).unwrap_or_default();
        assert!(found.iter().all(|f| (f.angle.to_degrees() - 40.0).abs() < 1e-9 && f.angle == f.peak_angle));
        assert!(found.iter().all(|f| (f.significant_moments[2] - f.significant / 30.0).abs() < 1e-9));
    }

    #[test]
    fn unloaded_tether_has_longest_life_and_zero_expected_stress() {
        let still = [0.0; 10];
        let end = EndRecord { about_y: &still, about_z: &still, stress_of_moment: 1.0 };
        let asked = FatigueSettings { duration: 5.0, curve: Endurance::KILONEWTONS, peak_time: 10_800.0 };
        let found = fatigue_of_ends(&[end], asked).unwrap_or_default();
        assert!(found.iter().all(|f| f.life_days == LONGEST_LIFE && f.expected_peak == 0.0 && f.cycles == 0.0));
    }

    #[test]
    fn curve_gives_same_lives_in_another_stress_unit() {
        let (one, other) = (Endurance::KILONEWTONS, Endurance::KILONEWTONS.in_unit(1000.0));
        let (a, b) = (damage_rate(1.5e5, 0.2, one), damage_rate(1.5e8, 0.2, other));
        assert!((a / b - 1.0).abs() < 1e-12);
    }
}
