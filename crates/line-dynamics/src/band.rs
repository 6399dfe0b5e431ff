//! The block-tridiagonal system of a rod, kept as a band.
//!
//! An element couples two neighbouring nodes and a bending hinge three, so the matrix has all its entries within `H`
//! places of the diagonal: H = 5 for a rope (two nodes of three unknowns), 8 for a beam (three nodes). Elimination
//! costs O(H^2) a row. No pivots are exchanged: the matrix of a step is dominated by its inertia, that of statics by
//! its damping; a pivot that vanishes is an error of the step, which is then cut.

/// A square band matrix; row i holds columns i - H .. i + H in `S` = 2 H + 1 places.
#[derive(Clone, Debug)]
pub(super) struct BandMatrix<const H: usize, const S: usize> {
    rows: Vec<[f64; S]>,
}

impl<const H: usize, const S: usize> BandMatrix<H, S> {
    /// The zero matrix.
    pub fn new(size: usize) -> Self {
        debug_assert_eq!(S, 2 * H + 1);
        BandMatrix { rows: vec![[0.0; S]; size] }
    }

    /// Sets all entries to zero.
    pub fn clear(&mut self) {
        self.rows.fill([0.0; S]);
    }

    /// Sets the entries of some rows to zero.
    pub fn clear_rows(&mut self, rows: std::ops::Range<usize>) {
        self.rows[rows].fill([0.0; S]);
    }

    /// Adds to an entry within the band.
    #[inline(always)]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.rows[row][column + H - row] += value;
    }

    /// Adds a block of 3 by 3 whose first entry is at `row`, `column`.
    #[inline(always)]
    pub fn add_block(&mut self, row: usize, column: usize, block: &nalgebra::Matrix3<f64>) {
        for i in 0..3 {
            let start = column + H - row - i;
            let place = &mut self.rows[row + i][start..start + 3];
            place[0] += block[(i, 0)];
            place[1] += block[(i, 1)];
            place[2] += block[(i, 2)];
        }
    }

    /// Adds three entries of a row, side by side.
    #[inline(always)]
    pub fn add_three(&mut self, row: usize, column: usize, values: [f64; 3]) {
        let start = column + H - row;
        for (place, value) in self.rows[row][start..start + 3].iter_mut().zip(values) {
            *place += value;
        }
    }

    /// An entry; zero outside the band.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        if row.abs_diff(column) > H { 0.0 } else { self.rows[row][column + H - row] }
    }

    /// Makes a row that of the unit matrix: its unknown is known.
    pub fn unit_row(&mut self, row: usize) {
        self.rows[row] = [0.0; S];
        self.rows[row][H] = 1.0;
    }

    /// A row.
    pub fn row(&self, row: usize) -> &[f64; S] {
        &self.rows[row]
    }

    /// Product of the entries of row number `row` with a vector.
    pub fn product(entries: &[f64; S], row: usize, vector: &[f64]) -> f64 {
        let first = row.saturating_sub(H);
        let last = (row + H).min(vector.len() - 1);
        vector[first..=last].iter().zip(&entries[first + H - row..]).map(|(a, b)| a * b).sum()
    }

    /// Product with a vector.
    pub fn times(&self, vector: &[f64], product: &mut [f64]) {
        for (row, made) in product.iter_mut().enumerate() {
            *made = Self::product(&self.rows[row], row, vector);
        }
    }

    /// Factors the matrix in place into U L, from its last row to its first, so that what an end A feels of itself, with all else
    /// condensed to it, stands in the first rows alone: how many pivots are negative, which for a symmetric matrix is the number of its
    /// negative eigenvalues; the row whose pivot vanished or is no number otherwise.
    pub fn factor(&mut self) -> Result<usize, usize> {
        let mut negative = 0;
        for k in (0..self.rows.len()).rev() {
            let (head, tail) = self.rows.split_at_mut(k);
            let pivot_row = &mut tail[0];
            let pivot = pivot_row[H];
            if !(pivot.abs() > f64::MIN_POSITIVE && pivot.is_finite()) {
                return Err(k);
            }
            negative += usize::from(pivot < 0.0);
            let inverse = 1.0 / pivot;
            pivot_row[H] = inverse;
            if let Some((_, near)) = head.split_last_chunk_mut::<H>() {
                for d in 1..=H {
                    eliminate::<H, S>(pivot_row, &mut near[H - d], d, inverse);
                }
            } else {
                for (d, row) in head.iter_mut().rev().enumerate() {
                    eliminate::<H, S>(pivot_row, row, d + 1, inverse);
                }
            }
        }
        Ok(negative)
    }

    /// Solves by the factors; `right` becomes the solution.
    ///
    /// The values found last are kept at hand, as a processor waits for what it has only just stored; the last of them
    /// comes last in each sum, so that the others do not wait for it. Beyond either end they are zero, as the entries are.
    pub fn solve(&self, right: &mut [f64]) {
        let mut near = [0.0; H];
        for (row, value) in self.rows.iter().zip(right.iter_mut()).rev() {
            let mut sum = *value;
            for j in (0..H).rev() {
                sum -= row[H + 1 + j] * near[j];
            }
            for j in (1..H).rev() {
                near[j] = near[j - 1];
            }
            near[0] = sum;
            *value = sum;
        }
        near = [0.0; H];
        for (row, value) in self.rows.iter().zip(right.iter_mut()) {
            let mut sum = *value;
            for j in (0..H).rev() {
                sum -= row[H - 1 - j] * near[j];
            }
            for j in (1..H).rev() {
                near[j] = near[j - 1];
            }
            near[0] = sum * row[H];
            *value = near[0];
        }
    }

    /// Solves with the transpose of the matrix, for `N` right-hand sides at once that are zero from row `filled` on; what is found is
    /// right before row `wanted`, which is not less.
    pub fn solve_transposed<const N: usize>(&self, right: &mut [[f64; N]], (filled, wanted): (usize, usize)) {
        for k in (0..filled.min(self.rows.len())).rev() {
            let row = &self.rows[k];
            let (head, tail) = right.split_at_mut(k);
            let solved = &mut tail[0];
            for value in solved.iter_mut() {
                *value *= row[H];
            }
            for (other, factor) in head[k.saturating_sub(H)..].iter_mut().zip(&row[H - k.min(H)..H]) {
                for (o, value) in other.iter_mut().zip(solved.iter()) {
                    *o -= factor * value;
                }
            }
        }
        for i in 0..wanted.min(self.rows.len()) {
            let row = &self.rows[i];
            let (head, tail) = right.split_at_mut(i + 1);
            for (other, factor) in tail.iter_mut().zip(&row[H + 1..]) {
                for (o, value) in other.iter_mut().zip(head[i].iter()) {
                    *o -= factor * value;
                }
            }
        }
    }
}

/// Takes the pivot row out of the row `d` above it.
#[inline(always)]
fn eliminate<const H: usize, const S: usize>(pivot_row: &[f64; S], row: &mut [f64; S], d: usize, inverse: f64) {
    let factor = row[H + d] * inverse;
    row[H + d] = factor;
    for j in 0..H {
        row[d + j] -= factor * pivot_row[j];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn banded_solve_inverts_banded_product() {
        let size = 23;
        let mut band = BandMatrix::<5, 11>::new(size);
        for i in 0..size {
            for j in i.saturating_sub(5)..(i + 6).min(size) {
                let value = ((i * 7 + j * 3) % 11) as f64 - 5.0 + if i == j { 30.0 } else { 0.0 };
                band.add(i, j, value);
            }
        }
        let x: Vec<f64> = (0..size).map(|i| (i as f64).sin()).collect();
        let mut b: Vec<f64> = (0..size).map(|i| BandMatrix::<5, 11>::product(band.row(i), i, &x)).collect();
        band.factor().unwrap();
        band.solve(&mut b);
        // diagonally dominant: rounding alone is left
        for (found, wanted) in b.iter().zip(&x) {
            assert!((found - wanted).abs() < 1e-13, "{found} {wanted}");
        }
    }

    #[test]
    fn transpose_gives_same_bilinear_product() {
        let (size, filled, wanted) = (23, 9, 14);
        let mut band = BandMatrix::<5, 11>::new(size);
        for i in 0..size {
            for j in i.saturating_sub(5)..(i + 6).min(size) {
                band.add(i, j, ((i * 7 + j * 3) % 11) as f64 - 5.0 + if i == j { 30.0 } else { 0.0 });
            }
        }
        band.factor().unwrap();
        let right: Vec<f64> = (0..size).map(|i| (i as f64).sin()).collect();
        let asked: Vec<[f64; 2]> =
            (0..size).map(|i| if i >= filled { [0.0; 2] } else { [(i as f64).cos(), 1.0] }).collect();
        let (mut solved, mut across) = (right.clone(), asked.clone());
        band.solve(&mut solved);
        let mut part = across.clone();
        band.solve_transposed(&mut across, (filled, size));
        band.solve_transposed(&mut part, (filled, wanted));
        assert_eq!(part[..wanted], across[..wanted]);
        for k in 0..2 {
            // f' (A^-1 b) = (A^-T f)' b
            let one: f64 = asked.iter().zip(&solved).map(|(f, x)| f[k] * x).sum();
            let other: f64 = across.iter().zip(&right).map(|(y, b)| y[k] * b).sum();
            assert!((one - other).abs() < 1e-14, "{one} {other}");
        }
    }

    #[test]
    fn vanishing_pivot_is_named() {
        let mut band = BandMatrix::<5, 11>::new(3);
        band.add(0, 0, 1.0);
        band.add(2, 2, 1.0);
        assert_eq!(band.factor(), Err(1));
    }
}
