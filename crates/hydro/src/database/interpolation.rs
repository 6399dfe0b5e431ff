//! Values between the frequencies and headings of a database.

use crate::sea::dispersion::wave_number;
use nalgebra::{Complex, Matrix6, Vector3};
use std::f64::consts::{PI, TAU};
use windlass_model::{Amplitudes, ClassError, Database, DriftTable};

/// The widest gap between two headings that is interpolated over (rad): 90 degrees, and a little for rounding.
pub const WIDEST_GAP: f64 = std::f64::consts::FRAC_PI_2 + 1e-6;

/// Amplitudes are straight between headings at most this far apart (rad), three degrees, to which the headings of a database are refined.
const FINE_STEP: f64 = std::f64::consts::PI / 60.0;
/// Gaps between headings that differ by less (rad) are equal.
const EQUAL_GAPS: f64 = 1e-6;

/// Headings of a list, by their place, with the share of each.
pub(super) type HeadingShares = Vec<(usize, f64)>;

/// Two neighbours in a list and the share of the second.
pub(super) type Bracket = (usize, usize, f64);

/// The neighbours of a frequency in a list that grows; the ends hold beyond it.
pub(super) fn bracket_frequency(list: &[f64], at: f64) -> Bracket {
    let next = list.partition_point(|w| *w <= at);
    match (next.checked_sub(1), list.get(next)) {
        (Some(low), Some(high)) => {
            let first = list[low];
            (low, next, (at - first) / (high - first))
        }
        (Some(low), None) => (low, low, 0.0),
        (None, _) => (0, 0, 0.0),
    }
}

/// The neighbours of a heading in headings that grow in one turn.
///
/// # Errors
/// No headings; a gap wider than [`WIDEST_GAP`] around the heading.
pub(super) fn bracket_heading(headings: &[f64], heading: f64) -> Result<Bracket, ClassError> {
    let turn = heading.rem_euclid(TAU);
    if !turn.is_finite() {
        return Err(ClassError::new("the heading is not finite"));
    }
    let next = headings.partition_point(|h| *h <= turn);
    let count = headings.len();
    if count == 0 {
        return Err(ClassError::new("the database has no headings"));
    }
    let low = if next == 0 { count - 1 } else { next - 1 };
    let high = next % count;
    let (a, b) = (headings[low], headings[high]);
    let gap = if count == 1 { TAU } else { (b - a).rem_euclid(TAU) };
    let from = (turn - a).rem_euclid(TAU);
    // a heading that the list has needs no neighbour
    for (index, off) in [(low, from), (high, gap - from)] {
        if off.abs() < 1e-6 {
            return Ok((index, index, 0.0));
        }
    }
    if gap > WIDEST_GAP {
        let [from, turn, a, b] = [turn + PI, turn, a, b].map(rounded_degrees);
        let why = if count == 1 {
            format!("it has those toward {a} degrees alone")
        } else {
            format!("its headings leave a gap from {a} to {b}")
        };
        let text = format!("the database has no waves toward {turn} degrees in the body (from {from}): {why}");
        return Err(ClassError::new(text).help("compute the database for headings all round, 90 degrees apart at most"));
    }
    Ok((low, high, from / gap))
}

/// An angle (rad) in degrees from 0 to 360, to as many digits as tell headings apart that are not the same.
fn rounded_degrees(angle: f64) -> f64 {
    let degrees = (angle.to_degrees() * 1e4).round() / 1e4;
    // no zero with a sign
    degrees.rem_euclid(360.0) + 0.0
}

/// The headings of a database, and between them as many equally far apart as leave no gap wider than three degrees; gaps that are not interpolated
/// over stay. Growing in one turn.
pub(super) fn finer_headings(headings: &[f64]) -> Vec<f64> {
    let Some(first) = headings.first() else { return Vec::new() };
    let next = headings.iter().skip(1).copied().chain([first + TAU]);
    let mut made: Vec<f64> = headings
        .iter()
        .zip(next)
        .flat_map(|(from, to)| {
            let gap = to - from;
            let parts = if gap > WIDEST_GAP { 1 } else { (gap / FINE_STEP - EQUAL_GAPS).ceil().max(1.0) as usize };
            (0..parts).map(move |part| (from + gap * part as f64 / parts as f64).rem_euclid(TAU))
        })
        .collect();
    made.sort_by(f64::total_cmp);
    made
}

/// The shares of the headings of a database in an amplitude between them: of headings all round and equally far apart those of the trigonometric
/// polynomial through all, of others those of the cubic through two on either side, of fewer where a gap is not interpolated over.
///
/// # Errors
/// As of [`bracket_heading`].
pub(super) fn heading_shares(headings: &[f64], heading: f64) -> Result<HeadingShares, ClassError> {
    let (low, high, share) = bracket_heading(headings, heading)?;
    let count = headings.len();
    if low == high {
        return Ok(vec![(low, 1.0)]);
    }
    let gap = |from: usize| (headings[(from + 1) % count] - headings[from]).rem_euclid(TAU);
    if count >= 4 && (0..count).all(|from| (gap(from) - TAU / count as f64).abs() < EQUAL_GAPS) {
        let half = 0.5 * count as f64;
        let of = |own: &f64| {
            let x = heading - own;
            let over = if count.is_multiple_of(2) { (0.5 * x).tan() } else { (0.5 * x).sin() };
            (half * x).sin() / (count as f64 * over)
        };
        return Ok(headings.iter().map(of).enumerate().collect());
    }
    // places along the gap, from its beginning
    let own = gap(low);
    let mut places = vec![(low, 0.0), (high, own)];
    let before = (low + count - 1) % count;
    if before != high && gap(before) <= WIDEST_GAP {
        places.insert(0, (before, -gap(before)));
    }
    let behind = (high + 1) % count;
    if behind != low && behind != before && gap(high) <= WIDEST_GAP {
        places.push((behind, own + gap(high)));
    }
    let at = share * own;
    let of = |(place, x): &(usize, f64)| {
        let others = places.iter().filter(|other| other.0 != *place);
        (*place, others.map(|(_, other)| (at - other) / (x - other)).product())
    };
    Ok(places.iter().map(of).collect())
}

/// Values of a database at any frequency and heading.
pub trait DatabaseLookup {
    /// Added mass about the body's origin at a frequency (rad/s), straight between the frequencies given; held beyond them,
    /// toward the value at zero or infinite frequency where the source has it. `None` without any.
    fn added_mass_at(&self, frequency: f64) -> Option<Matrix6<f64>>;

    /// Damping about the body's origin at a frequency (rad/s), straight between the frequencies given and from nothing at zero; beyond
    /// the last as 1/w3. `None` without any.
    fn damping_at(&self, frequency: f64) -> Option<Matrix6<f64>>;

    /// Excitation over wave amplitude about the body's origin, phases referred to it: the wave is `Re(a exp(-i w t))` there. The heading
    /// (rad) is the direction of travel in the body. Between headings it is the trigonometric polynomial through them where they are all round and
    /// equally far apart, else a cubic, in real and imaginary part and in steps of at most three degrees. Straight between frequencies; held below
    /// the first, beyond the last it falls in proportion to the period.
    ///
    /// # Errors
    /// A database without excitation; a heading in a gap wider than 90 degrees.
    fn excitation_at(&self, heading: f64, frequency: f64) -> Result<Amplitudes, ClassError>;

    /// Motions of the body's origin over wave amplitude, where the source gives motions; else as [`DatabaseLookup::excitation_at`].
    ///
    /// # Errors
    /// A database without motions; a heading in a gap wider than 90 degrees.
    fn motion_at(&self, heading: f64, frequency: f64) -> Result<Amplitudes, ClassError>;
}

impl DatabaseLookup for Database {
    fn added_mass_at(&self, frequency: f64) -> Option<Matrix6<f64>> {
        let (first, last) = (*self.frequencies.first()?, *self.frequencies.last()?);
        let (low, high) = (self.added_mass.first()?, self.added_mass.last()?);
        let about_reference = match (frequency < first, frequency > last, self.zero, self.infinite) {
            (true, _, Some(zero), _) => zero + (low - zero) * (frequency.max(0.0) / first),
            // as 1/w2, with which added mass goes to its limit
            (_, true, _, Some(infinite)) => infinite + (high - infinite) * (last / frequency).powi(2),
            _ => interpolate_matrix(&self.added_mass, bracket_frequency(&self.frequencies, frequency))?,
        };
        Some(moved_matrix(&about_reference, self.reference))
    }

    fn damping_at(&self, frequency: f64) -> Option<Matrix6<f64>> {
        let (first, last) = (*self.frequencies.first()?, *self.frequencies.last()?);
        let factor = if frequency < first {
            frequency.max(0.0) / first
        } else if frequency > last {
            (last / frequency).powi(3)
        } else {
            1.0
        };
        let damping = interpolate_matrix(&self.damping, bracket_frequency(&self.frequencies, frequency))? * factor;
        Some(moved_matrix(&damping, self.reference))
    }

    fn excitation_at(&self, heading: f64, frequency: f64) -> Result<Amplitudes, ClassError> {
        if self.excitation.is_empty() {
            return Err(ClassError::new(format!("the database ({}) has no excitation", self.source)));
        }
        let x = amplitudes_at(&self.excitation, (&self.headings, &self.frequencies), heading, frequency)?;
        let shift = phase_shift(self, heading, frequency)?;
        Ok(moved_force(x, self.reference).map(|v| v * shift))
    }

    fn motion_at(&self, heading: f64, frequency: f64) -> Result<Amplitudes, ClassError> {
        let Some(motions) = &self.motions else {
            return Err(ClassError::new(format!("the database ({}) has no motions", self.source)));
        };
        let [x, y, z, rx, ry, rz] = amplitudes_at(motions, (&self.headings, &self.frequencies), heading, frequency)?;
        // the origin stands at -reference from the reference point
        let (arm, shift) = (-self.reference, phase_shift(self, heading, frequency)?);
        let moved = [x + ry * arm.z - rz * arm.y, y + rz * arm.x - rx * arm.z, z + rx * arm.y - ry * arm.x, rx, ry, rz];
        Ok(moved.map(|v| v * shift))
    }
}

/// What turns an amplitude over the wave at the reference point into one over the wave at the origin.
fn phase_shift(data: &Database, heading: f64, frequency: f64) -> Result<Complex<f64>, ClassError> {
    let along = data.reference.x * heading.cos() + data.reference.y * heading.sin();
    if along == 0.0 {
        return Ok(Complex::new(1.0, 0.0));
    }
    Ok(Complex::from_polar(1.0, wave_number(frequency, data.depth, data.gravity)? * along))
}

/// Mean drift over the square of the wave amplitude (N/m2, N m/m2) at a heading that the waves travel toward (rad, in the body) and a
/// frequency (rad/s), straight between headings and frequencies; held beyond the first and last frequency. About the reference point.
///
/// # Errors
/// A heading in a gap wider than 90 degrees.
pub fn drift_at(table: &DriftTable, heading: f64, frequency: f64) -> Result<[f64; 6], ClassError> {
    let (a, b, by_heading) = bracket_heading(&table.headings, heading)?;
    let (i, j, by_frequency) = bracket_frequency(&table.frequencies, frequency);
    let cell = |h: usize, f: usize| table.values[h][f];
    let line = |h: usize| {
        let (low, high) = (cell(h, i), cell(h, j));
        [0, 1, 2, 3, 4, 5].map(|k: usize| low[k] + (high[k] - low[k]) * by_frequency)
    };
    let (low, high) = (line(a), line(b));
    Ok([0, 1, 2, 3, 4, 5].map(|k: usize| low[k] + (high[k] - low[k]) * by_heading))
}

/// A matrix between two of a list.
fn interpolate_matrix(list: &[Matrix6<f64>], (low, high, share): Bracket) -> Option<Matrix6<f64>> {
    let (a, b) = (list.get(low)?, list.get(high)?);
    Some(a + (b - a) * share)
}

/// Amplitudes between headings and frequencies; see [`DatabaseLookup::excitation_at`].
fn amplitudes_at(
    table: &[Vec<Amplitudes>],
    (headings, frequencies): (&[f64], &[f64]),
    heading: f64,
    frequency: f64,
) -> Result<Amplitudes, ClassError> {
    let shares = stepped_shares(headings, heading)?;
    let (i, j, by_frequency) = bracket_frequency(frequencies, frequency);
    let fade = match frequencies.last() {
        Some(last) if frequency > *last => last / frequency,
        _ => 1.0,
    };
    let mut sum = Amplitudes::default();
    for (row, share) in shares.into_iter().filter_map(|(place, share)| Some((table.get(place)?, share * fade))) {
        let (Some(low), Some(high)) = (row.get(i), row.get(j)) else { continue };
        for (sum, (low, high)) in sum.iter_mut().zip(low.iter().zip(high)) {
            *sum += (low + (high - low) * by_frequency) * share;
        }
    }
    Ok(sum)
}

/// As [`heading_shares`], straight between the refined headings: as waves in time take them from tables.
///
/// # Errors
/// As of [`bracket_heading`].
fn stepped_shares(headings: &[f64], heading: f64) -> Result<HeadingShares, ClassError> {
    let (low, high, share) = bracket_heading(headings, heading)?;
    if low == high {
        return Ok(vec![(low, 1.0)]);
    }
    let (from, to) = (headings[low], headings[high]);
    let gap = (to - from).rem_euclid(TAU);
    let parts = (gap / FINE_STEP - EQUAL_GAPS).ceil().max(1.0);
    let part = (share * parts).floor().min(parts - 1.0);
    let beyond = share * parts - part;
    let at = |part: f64| heading_shares(headings, from + gap * part / parts);
    let mut made: HeadingShares = at(part)?.into_iter().map(|(place, own)| (place, own * (1.0 - beyond))).collect();
    made.extend(at(part + 1.0)?.into_iter().map(|(place, own)| (place, own * beyond)));
    Ok(made)
}

/// A force about a point as one about the origin that `arm` leads from.
pub(super) fn moved_force([x, y, z, mx, my, mz]: Amplitudes, arm: Vector3<f64>) -> Amplitudes {
    [x, y, z, mx + z * arm.y - y * arm.z, my + x * arm.z - z * arm.x, mz + y * arm.x - x * arm.y]
}

/// A matrix about a point as one about the origin that `arm` leads from.
pub(super) fn moved_matrix(about: &Matrix6<f64>, arm: Vector3<f64>) -> Matrix6<f64> {
    super::super::move_stiffness(about, arm, arm)
}
