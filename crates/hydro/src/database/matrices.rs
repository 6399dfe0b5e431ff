//! Added mass and damping by frequency from rows of single pairs of directions.

use super::rows::{DatabaseError, Flaw, SourceFile, axis, complete, position, same_frequency};
use nalgebra::Matrix6;
use std::f64::consts::TAU;

/// Added mass and damping of one pair of directions: frequency (rad/s), `6 i + j`, the two values.
pub(super) type PairRow = (f64, usize, [f64; 2]);

/// Added mass and damping, a matrix a frequency.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ByFrequency {
    pub frequencies: Vec<f64>,
    pub added_mass: Vec<Matrix6<f64>>,
    pub damping: Vec<Matrix6<f64>>,
}

/// Puts pairs in matrices. A pair without any row is zero; one with a row has one for each frequency.
///
/// # Errors
/// No rows; a frequency without a pair that others have, or with two unlike rows of it.
pub(super) fn by_frequency(file: &SourceFile, rows: &[PairRow]) -> Result<ByFrequency, DatabaseError> {
    if rows.is_empty() {
        return Err(file.error("it has no frequency of this body"));
    }
    let frequencies = axis(rows.iter().map(|r| r.0), same_frequency);
    let pairs = axis(rows.iter().map(|r| r.1 as f64), |a, b| a == b);
    let placed = rows.iter().map(|(w, p, v)| ([position(&frequencies, *w), position(&pairs, *p as f64)], *v)).collect();
    let size = rows.iter().map(|r| r.2[0].abs()).fold(0.0, f64::max);
    let same = |a: &[f64; 2], b: &[f64; 2]| (a[0] - b[0]).abs() <= 1e-4 * size;
    let dense = complete(placed, [frequencies.len(), pairs.len()], same).map_err(|flaw| {
        let (text, [w, p]) = match flaw {
            Flaw::Missing(at) => ("it has no row", at),
            Flaw::Twice(at) => ("it has two unlike rows", at),
        };
        let w = frequencies.get(w).copied().unwrap_or_default();
        let n = pairs.get(p).copied().unwrap_or_default() as usize;
        let pair = format!("{} {}", n / 6 + 1, n % 6 + 1);
        file.error(format!("{text} for modes {pair} at {w:.5} rad/s (period {:.4} s)", TAU / w))
    })?;
    let (mut added_mass, mut damping) = (Vec::new(), Vec::new());
    for chunk in dense.chunks(pairs.len()) {
        added_mass.push(matrix(pairs.iter().zip(chunk).map(|(n, v)| (*n as usize, v[0]))));
        damping.push(matrix(pairs.iter().zip(chunk).map(|(n, v)| (*n as usize, v[1]))));
    }
    Ok(ByFrequency { frequencies, added_mass, damping })
}

/// A matrix of values at `6 i + j`.
pub(super) fn matrix(values: impl Iterator<Item = (usize, f64)>) -> Matrix6<f64> {
    let mut matrix = Matrix6::zeros();
    for (n, value) in values {
        matrix[(n / 6 % 6, n % 6)] = value;
    }
    matrix
}
