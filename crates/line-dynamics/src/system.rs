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

    /// Adds so many elements that were taken at once, from the first on: node by node, so that every row is written once.
    pub fn shares<const TANGENT: bool>(&mut self, first: usize, count: usize) {
        let RodSystem { band, residual, batch, .. } = self;
        let shares = &batch.shares;
        let count = count.min(BATCH_SIZE);
        add_node::<TANGENT, W, H, S>((&mut *band, &mut *residual), first, (None, Some(0)), shares);
        for n in 1..count {
            add_inner_node::<TANGENT, W, H, S>((&mut *band, &mut *residual), first + n, n, shares);
        }
        add_node::<TANGENT, W, H, S>((band, residual), first + count, (count.checked_sub(1), None), shares);
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

/// A part of a node's row of a batch: three numbers of one lane.
#[inline(always)]
fn three(of: &[[f64; BATCH_SIZE]; 3], lane: usize) -> [f64; 3] {
    [of[0][lane], of[1][lane], of[2][lane]]
}

/// Adds to a node what the elements before and after it have there, by their lanes.
#[inline(always)]
fn add_node<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    (band, residual): (&mut BandMatrix<H, S>, &mut [f64]),
    node: usize,
    (before, after): (Option<usize>, Option<usize>),
    shares: &BatchTangent,
) {
    for (lane, side, other) in
        [before.map(|n| (n, 1, node.wrapping_sub(1))), after.map(|n| (n, 0, node + 1))].into_iter().flatten()
    {
        for (residual, by) in residual[W * node..W * node + 3].iter_mut().zip(three(&shares.force[side], lane)) {
            *residual += by;
        }
        if TANGENT {
            for i in 0..3 {
                band.add_to_row(W * node + i, W * node, three(&shares.itself[side][i], lane));
                band.add_to_row(W * node + i, W * other, three(&shares.other[side][i], lane));
            }
        }
    }
}

/// Adds to a node between two elements of a batch what both have there; `n` is the lane of the one after it.
#[inline(always)]
fn add_inner_node<const TANGENT: bool, const W: usize, const H: usize, const S: usize>(
    (band, residual): (&mut BandMatrix<H, S>, &mut [f64]),
    node: usize,
    n: usize,
    shares: &BatchTangent,
) {
    if W > 3 {
        return add_node::<TANGENT, W, H, S>((band, residual), node, (Some(n - 1), Some(n)), shares);
    }
    let [after, before] = &shares.force;
    let (a, b) = (three(before, n - 1), three(after, n));
    let r = &mut residual[W * node..W * node + 3];
    r[0] += a[0] + b[0];
    r[1] += a[1] + b[1];
    r[2] += a[2] + b[2];
    if TANGENT {
        for i in 0..3 {
            let (a, b) = (three(&shares.itself[1][i], n - 1), three(&shares.itself[0][i], n));
            let (x, y) = (three(&shares.other[1][i], n - 1), three(&shares.other[0][i], n));
            let row = [x[0], x[1], x[2], a[0] + b[0], a[1] + b[1], a[2] + b[2], y[0], y[1], y[2]];
            band.add_to_row(W * node + i, W * (node - 1), row);
        }
    }
}
