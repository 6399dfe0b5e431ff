//! Values between the frequencies and headings of a database.

use crate::sea::dispersion::wave_number;
use nalgebra::{Complex, Matrix6, Vector3};
use std::f64::consts::TAU;
use windlass_model::{Amplitudes, ClassError, Database, DriftTable};

/// The widest gap between two headings that is interpolated over (rad): 90 degrees, and a little for rounding.
pub const WIDEST_GAP: f64 = std::f64::consts::FRAC_PI_2 + 1e-6;

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
        let text = format!(
            "the database has no waves toward {:.1} degrees in the body: its headings leave a gap from {:.1} to {:.1}",
            turn.to_degrees(),
            a.to_degrees(),
            b.to_degrees()
        );
        return Err(ClassError::new(text).help("compute the database for headings all round, 90 degrees apart at most"));
    }
    Ok((low, high, from / gap))
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
    /// (rad) is the direction of travel in the body. Straight between headings and frequencies in real and imaginary part; held
    /// below the first frequency, beyond the last it falls in proportion to the period.
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
    let (a, b, by_heading) = bracket_heading(headings, heading)?;
    let (i, j, by_frequency) = bracket_frequency(frequencies, frequency);
    let fade = match frequencies.last() {
        Some(last) if frequency > *last => last / frequency,
        _ => 1.0,
    };
    let cell = |h: usize, f: usize| table[h][f];
    let line = |h: usize| {
        let (low, high) = (cell(h, i), cell(h, j));
        [0, 1, 2, 3, 4, 5].map(|k: usize| low[k] + (high[k] - low[k]) * by_frequency)
    };
    let (low, high) = (line(a), line(b));
    Ok([0, 1, 2, 3, 4, 5].map(|k: usize| (low[k] + (high[k] - low[k]) * by_heading) * fade))
}

/// A force about a point as one about the origin that `arm` leads from.
pub(super) fn moved_force([x, y, z, mx, my, mz]: Amplitudes, arm: Vector3<f64>) -> Amplitudes {
    [x, y, z, mx + z * arm.y - y * arm.z, my + x * arm.z - z * arm.x, mz + y * arm.x - x * arm.y]
}

/// A matrix about a point as one about the origin that `arm` leads from.
pub(super) fn moved_matrix(about: &Matrix6<f64>, arm: Vector3<f64>) -> Matrix6<f64> {
    super::super::move_stiffness(about, arm, arm)
}
