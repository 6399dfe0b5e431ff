//! The residual of a rod and its tangent, with what adds to them by nodes.

use super::element_batch::{BATCH_SIZE, BatchTangent, ElementBatch};
use super::spatial::Vector8;
use nalgebra::{Matrix3, SMatrix, Vector3};
use windlass_base::band::BandMatrix;

/// How velocity and acceleration follow the unknown positions: the tangent is k K + c C + m M.
#[derive(Clone, Copy, Debug)]
pub(super) struct Weights {
    pub k: f64,
    pub c: f64,
    pub m: f64,
}

/// Residual (what the nodes need from outside, N) and its tangent; `W` unknowns a node.
#[derive(Clone, Debug)]
pub(super) struct RodSystem<const W: usize, const H: usize, const S: usize> {
    pub band: BandMatrix<H, S>,
    pub residual: Vec<f64>,
    /// Room for elements taken at once.
    pub batch: ElementBatch,
    /// Residual of the two end nodes.
    pub ends: [Vector3<f64>; 2],
    /// Rows of the two end nodes.
    rows: [[[f64; S]; 3]; 2],
}

impl<const W: usize, const H: usize, const S: usize> RodSystem<W, H, S> {
    pub fn new(nodes: usize) -> Self {
        RodSystem {
            band: BandMatrix::new(W * nodes),
            residual: vec![0.0; W * nodes],
            batch: ElementBatch::default(),
            ends: [Vector3::zeros(); 2],
            rows: [[[0.0; S]; 3]; 2],
        }
    }

    pub fn clear(&mut self) {
        self.band.clear();
        self.residual.fill(0.0);
    }

    /// Clears what the elements of a range add to.
    pub fn clear_part(&mut self, range: &std::ops::Range<usize>) {
        let rows = W * range.start.saturating_sub(1)..W * (range.end + 1);
        self.band.clear_rows(rows);
    }

    #[inline(always)]
    pub fn push(&mut self, node: usize, force: &Vector3<f64>) {
        let r = &mut self.residual[W * node..W * node + 3];
        r[0] += force.x;
        r[1] += force.y;
        r[2] += force.z;
    }

    #[inline(always)]
    pub fn block<const TANGENT: bool>(&mut self, row: usize, column: usize, block: &Matrix3<f64>) {
        if TANGENT {
            self.band.add_block(W * row, W * column, block);
        }
    }

    /// Adds so many elements that were taken at once, from the first on.
    pub fn shares<const TANGENT: bool>(&mut self, first: usize, count: usize) {
        let ElementBatch { shares, .. } = &self.batch;
        for n in 0..count.min(BATCH_SIZE) {
            add_share::<TANGENT, W, H, S>((&mut self.band, &mut self.residual), (first + n, n), shares);
        }
    }

    /// Unknowns a node.
    pub fn stride(&self) -> usize {
        W
    }

    /// Adds a spatial hinge between two elements, or an element and a holder.
    pub fn hinge<const TANGENT: bool>(
        &mut self,
        sides: [Option<usize>; 2],
        k: f64,
        gradient: &Vector8,
        matrix: &SMatrix<f64, 8, 8>,
    ) {
        // each of the eight unknowns by those of the nodes: an edge is its second node less its first
        let positions = |local: usize| -> [Option<(usize, f64)>; 2] {
            let side = if local < 6 { local / 3 } else { local - 6 };
            match sides[side] {
                None => [None, None],
                Some(i) if local < 6 => [Some((W * (i + 1) + local % 3, 1.0)), Some((W * i + local % 3, -1.0))],
                Some(i) => [Some((W * i + 3, 1.0)), None],
            }
        };
        for a in 0..8 {
            for (row, sign) in positions(a).into_iter().flatten() {
                self.residual[row] += sign * gradient[a];
                if TANGENT {
                    for b in 0..8 {
                        for (column, other) in positions(b).into_iter().flatten() {
                            self.band.add(row, column, sign * other * k * matrix[(a, b)]);
                        }
                    }
                }
            }
        }
    }

    /// Keeps the rows of the end nodes.
    pub fn store_end_rows(&mut self) {
        let last = self.residual.len() / W - 1;
        for (side, node) in [(0, 0), (1, last)] {
            for i in 0..3 {
                self.rows[side][i] = *self.band.row(W * node + i);
            }
        }
    }

    /// Keeps the residual of the end nodes.
    pub fn store_end_residuals(&mut self) {
        let last = self.residual.len() / W - 1;
        for (side, node) in [(0, 0), (1, last)] {
            self.ends[side] = self.residual_at(node);
        }
    }

    /// Product of the kept rows of an end (N/m) with a change of all unknowns (m): the change of its force (N).
    pub fn ends_by(&self, side: usize, change: &[f64]) -> Vector3<f64> {
        let node = if side == 0 { 0 } else { self.residual.len() / W - 1 };
        Vector3::from_fn(|i, _| BandMatrix::<H, S>::product(&self.rows[side][i], W * node + i, change))
    }

    /// Visits every entry of the stored rows of an end: row of the three, column, value.
    pub fn visit_end_rows(&self, side: usize, mut entry: impl FnMut(usize, usize, f64)) {
        let size = self.residual.len();
        let node = if side == 0 { 0 } else { size / W - 1 };
        for (i, row) in self.rows[side].iter().enumerate() {
            for (j, value) in row.iter().enumerate() {
                if let Some(column) = (W * node + i + j).checked_sub(H).filter(|c| *c < size) {
                    entry(i, column, *value);
                }
            }
        }
    }

    /// Takes the kept residuals on to changed unknowns.
    pub fn update_end_residuals(&mut self, change: &[f64]) {
        for side in [0, 1] {
            self.ends[side] += self.ends_by(side, change);
        }
    }

    /// Residual of a node as a vector (N).
    pub fn residual_at(&self, node: usize) -> Vector3<f64> {
        Vector3::from_column_slice(&self.residual[W * node..W * node + 3])
    }

    /// The block that couples a node's residual to another's position.
    #[cfg(test)]
    pub fn block_at(&self, row: usize, column: usize) -> Matrix3<f64> {
        Matrix3::from_fn(|i, j| self.band.get(W * row + i, W * column + j))
    }
}

/// Adds an element of a number, one of those taken at once.
#[inline(always)]
fn add_share<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    (band, residual): (&mut BandMatrix<H, S>, &mut [f64]),
    (element, n): (usize, usize),
    shares: &BatchTangent,
) {
    let three = |of: &[[f64; BATCH_SIZE]; 3]| [of[0][n], of[1][n], of[2][n]];
    for (second, force) in shares.force.iter().enumerate() {
        let (node, other) = if second == 0 { (element, element + 1) } else { (element + 1, element) };
        for (residual, by) in residual[W * node..W * node + 3].iter_mut().zip(three(force)) {
            *residual += by;
        }
        if TANGENT {
            for i in 0..3 {
                band.add_to_row(W * node + i, W * node, three(&shares.itself[second][i]));
                band.add_to_row(W * node + i, W * other, three(&shares.other[second][i]));
            }
        }
    }
}
