//! A motion through places at times.

use super::super::forces::BodyMotion;
use super::{DofMotion, Prescribed, motion_from_dofs};
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::{ClassError, PathRow};

/// The natural cubic spline through rows: its second derivative is continuous, and zero at both ends
/// [DEBOOR-1978 IV].
#[derive(Debug)]
pub(super) struct Spline {
    rows: Vec<PathRow>,
    /// Second derivatives at the rows.
    bends: Vec<[f64; 6]>,
}

impl Spline {
    /// That of rows whose times grow. Roll and yaw go the short way from row to row.
    pub(super) fn new(rows: &[PathRow]) -> Result<Self, ClassError> {
        let finite = rows.iter().all(|(t, v)| t.is_finite() && v.iter().all(|x| x.is_finite()));
        let grow = rows.windows(2).all(|w| w.first().zip(w.last()).is_some_and(|(a, b)| a.0 < b.0));
        if rows.len() < 2 || !finite || !grow {
            return Err(ClassError::new("a path needs two or more rows of numbers whose times grow"));
        }
        let mut rows = rows.to_vec();
        let mut before: Option<[f64; 6]> = None;
        for (_, values) in &mut rows {
            if let Some(before) = before {
                for dof in [3, 5] {
                    let turns = ((before[dof] - values[dof]) / TAU).round();
                    values[dof] += turns * TAU;
                }
            }
            before = Some(*values);
        }
        let bends = bends(&rows);
        Ok(Spline { rows, bends })
    }
}

/// Solves the tridiagonal equations of the second derivatives: `h0 m0 + 2 (h0 + h1) m1 + h1 m2 = 6 (slope1 - slope0)`.
fn bends(rows: &[PathRow]) -> Vec<[f64; 6]> {
    let slope = |a: &PathRow, b: &PathRow| [0, 1, 2, 3, 4, 5].map(|i| (b.1[i] - a.1[i]) / (b.0 - a.0));
    // forward: of each inner row the share of the next one's, and the rest
    let mut swept: Vec<(f64, [f64; 6])> = vec![(0.0, [0.0; 6])];
    for window in rows.windows(3) {
        let [a, b, c] = window else { continue };
        let (h0, h1) = (b.0 - a.0, c.0 - b.0);
        let (share, rest) = swept.last().copied().unwrap_or((0.0, [0.0; 6]));
        let pivot = 2.0 * (h0 + h1) - h0 * share;
        let (first, second) = (slope(a, b), slope(b, c));
        let right = [0, 1, 2, 3, 4, 5].map(|i| (6.0 * (second[i] - first[i]) - h0 * rest[i]) / pivot);
        swept.push((h1 / pivot, right));
    }
    let mut found = vec![[0.0; 6]];
    for (share, rest) in swept.iter().skip(1).rev() {
        let next = found.last().copied().unwrap_or([0.0; 6]);
        found.push([0, 1, 2, 3, 4, 5].map(|i| rest[i] - share * next[i]));
    }
    found.push([0.0; 6]);
    found.reverse();
    found
}

impl Prescribed for Spline {
    fn motion_at(&self, time: f64) -> Result<BodyMotion, ClassError> {
        let ends = self.rows.first().zip(self.rows.last());
        let (first, last) = ends.map(|(a, b)| (a.0, b.0)).unwrap_or_default();
        // a step's end may be a rounding beyond the last row
        let slack = 1e-9 * (last - first);
        if !(first - slack..=last + slack).contains(&time) {
            let text = "the motion of the body is given from {} to {}, and asked for at {}";
            return Err(ClassError::with_values(text, &[(first, Dim::Time), (last, Dim::Time), (time, Dim::Time)])
                .help("lengthen the file, or shorten -TIME of the environment"));
        }
        let after = self.rows.partition_point(|r| r.0 <= time).clamp(1, self.rows.len() - 1);
        let (Some(a), Some(b), Some(m), Some(n)) =
            (self.rows.get(after - 1), self.rows.get(after), self.bends.get(after - 1), self.bends.get(after))
        else {
            return Err(ClassError::new("a path without rows"));
        };
        let long = b.0 - a.0;
        let (p, q) = ((b.0 - time) / long, (time - a.0) / long);
        let mut dofs: DofMotion = [[0.0; 6]; 3];
        for i in 0..6 {
            let (from, to, m, n) = (a.1[i], b.1[i], m[i], n[i]);
            let bend = long * long / 6.0;
            dofs[0][i] = p * from + q * to + ((p * p * p - p) * m + (q * q * q - q) * n) * bend;
            dofs[1][i] = (to - from) / long + ((3.0 * q * q - 1.0) * n - (3.0 * p * p - 1.0) * m) * long / 6.0;
            dofs[2][i] = p * m + q * n;
        }
        Ok(motion_from_dofs(&dofs))
    }
}
