//! The thirty rows of `CONN_DESIGN TABLE`.
//!
//! Source: [W-TABLE]: H_n = T (n/29)^2, n = 0..29, with T the table limit or the largest break
//! of all segments; row 0 uses 1.4e-4 T in place of zero.

use super::error::LineError;
use super::line::Line;
use super::state::LineState;

/// Number of rows.
pub const DEFAULT_ROWS: usize = 30;

/// A row of the table.
#[derive(Clone, Debug)]
pub struct TableRow {
    /// The configuration.
    pub state: LineState,
    /// Largest tension / own break over the segments.
    pub ratio: f64,
    /// The segment that has it, from 1.
    pub critical: usize,
    /// Its break (N).
    pub critical_break: f64,
}

/// A row without a proven configuration.
#[derive(Clone, Debug, PartialEq)]
pub struct MissingRow {
    /// Its number, from 1.
    pub number: usize,
    /// Its horizontal force (N).
    pub force: f64,
    /// Why.
    pub error: LineError,
}

/// The horizontal force of row 0 as a share of the largest force (1.4e-4: the value seen in MOSES's own output).
pub fn first_force(largest: f64) -> f64 {
    1.4e-4 * largest
}

/// The rows for a fairlead at elevation `fairlead` (m), and those without a configuration; `breaks` (N) one a segment, `largest`
/// the largest H (N).
///
/// # Errors
/// Breaks that do not fit; the reason of the first row when no row has a configuration.
pub fn table(
    line: &Line,
    breaks: &[f64],
    largest: f64,
    fairlead: f64,
) -> Result<(Vec<TableRow>, Vec<MissingRow>), LineError> {
    let positive = |v: &f64| v.is_finite() && *v > 0.0;
    if breaks.len() != line.segments.len() || !breaks.iter().all(positive) || !positive(&largest) {
        return Err(LineError::Breaks);
    }
    let last = (DEFAULT_ROWS - 1) as f64;
    let row = |force: f64| {
        let state = line.at_horizontal_force(force, fairlead)?;
        let mut row = TableRow { ratio: 0.0, critical: 1, critical_break: breaks[0], state };
        for (index, (segment, limit)) in row.state.segments.iter().zip(breaks).enumerate() {
            let ratio = segment.top_tension.max(segment.bottom_tension) / limit;
            if ratio > row.ratio {
                (row.ratio, row.critical, row.critical_break) = (ratio, index + 1, *limit);
            }
        }
        Ok(row)
    };
    let (mut rows, mut missing) = (Vec::with_capacity(DEFAULT_ROWS), Vec::new());
    for n in 0..DEFAULT_ROWS {
        let share = n as f64 / last;
        let force = if n == 0 { first_force(largest) } else { largest * share * share };
        match row(force) {
            Ok(row) => rows.push(row),
            Err(error) => missing.push(MissingRow { number: n + 1, force, error }),
        }
    }
    match missing.first() {
        Some(first) if rows.is_empty() => Err(first.error.clone()),
        _ => Ok((rows, missing)),
    }
}
