//! Band matrices and their factors: the linear systems of lines and tethers, whose nodes are coupled to their neighbours alone.
//!
//! All entries of row i lie in the columns i - H .. i + H: H is 5 for a rope (two nodes of three unknowns), 8 for a beam (three
//! nodes), 3 for a plane of a tether (two nodes of two unknowns). Elimination (Golub and Van Loan, Matrix Computations, 4th ed., 4.3)
//! costs O(H^2) a row. Rows are not exchanged: the
//! matrices are dominated by inertia, or symmetric and positive definite, and exchange would widen the band. What a pivot has to be is
//! the caller's choice: not zero ([`BandMatrix::factor`]), positive ([`BandMatrix::factor_positive`]), or anything
//! ([`BandMatrix::factor_shifted`], which counts eigenvalues of a symmetric matrix).
//!
//! # Example
//! ```
//! use windlass_base::band::BandMatrix;
//!
//! // -u'' = 1 on four inner points of the unit interval: u = x (1 - x) / 2
//! let mut matrix = BandMatrix::<1, 3>::new(4);
//! for i in 0..4 {
//!     matrix.add(i, i, 2.0);
//!     if i > 0 {
//!         matrix.add_symmetric(i, i - 1, -1.0);
//!     }
//! }
//! matrix.factor_positive()?;
//! let mut u = [0.04; 4];
//! matrix.solve(&mut u);
//! assert!((u[1] - 0.4 * 0.6 / 2.0).abs() < 1e-15);
//! # Ok::<(), windlass_base::band::UnusablePivot>(())
//! ```

/// Rows above a pivot that the unknowns of one node of a line and the next always reach.
const ALWAYS_COUPLED: usize = 3;

/// A pivot that cannot be divided by: zero or not finite, or not positive where it has to be.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
#[error("the pivot of row {} of the band matrix cannot be used", row + 1)]
pub struct UnusablePivot {
    /// Its row, from 0.
    pub row: usize,
}

/// A square band matrix; row i holds columns i - H .. i + H in `S` = 2 H + 1 places.
#[derive(Debug, PartialEq)]
pub struct BandMatrix<const H: usize, const S: usize> {
    rows: Vec<[f64; S]>,
}

impl<const H: usize, const S: usize> Clone for BandMatrix<H, S> {
    fn clone(&self) -> Self {
        BandMatrix { rows: self.rows.clone() }
    }

    /// Copies into the memory that is there.
    fn clone_from(&mut self, source: &Self) {
        self.rows.clone_from(&source.rows);
    }
}

impl<const H: usize, const S: usize> BandMatrix<H, S> {
    /// The zero matrix.
    pub fn new(size: usize) -> Self {
        debug_assert_eq!(S, 2 * H + 1);
        BandMatrix { rows: vec![[0.0; S]; size] }
    }

    /// Its number of rows.
    pub fn order(&self) -> usize {
        self.rows.len()
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
            let position = &mut self.rows[row + i][start..start + 3];
            position[0] += block[(i, 0)];
            position[1] += block[(i, 1)];
            position[2] += block[(i, 2)];
        }
    }

    /// Adds entries of a row, side by side from `column` on.
    #[inline(always)]
    pub fn add_to_row<const N: usize>(&mut self, row: usize, column: usize, values: [f64; N]) {
        let start = column + H - row;
        for (position, value) in self.rows[row][start..start + N].iter_mut().zip(values) {
            *position += value;
        }
    }

    /// Writes a column: the entry of row `column - H + i` at place `centre - H + i`, whose neighbours are left as they are; rows that are
    /// not there leave their places as well.
    pub fn column<const N: usize>(&self, column: usize, centre: usize, entries: &mut [f64; N]) {
        let first = column.saturating_sub(H);
        let rows = self.rows.iter().enumerate().skip(first).take((column + H + 1).saturating_sub(first));
        for (row, values) in rows {
            if let (Some(entry), Some(value)) = (entries.get_mut(centre + row - column), values.get(column + H - row)) {
                *entry = *value;
            }
        }
    }

    /// Adds to an entry beside the diagonal and to its mirror image.
    pub fn add_symmetric(&mut self, row: usize, column: usize, value: f64) {
        self.add(row, column, value);
        self.add(column, row, value);
    }

    /// Becomes `self + factor * other`, of the same order.
    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        debug_assert_eq!(self.order(), other.order());
        for (mine, theirs) in self.rows.iter_mut().flatten().zip(other.rows.iter().flatten()) {
            *mine += factor * theirs;
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

    /// Holds an unknown of a symmetric matrix at zero: its row and column become those of the unit matrix times `diagonal`.
    pub fn hold(&mut self, unknown: usize, diagonal: f64) {
        let first = unknown.saturating_sub(H);
        for (row, entries) in self.rows.iter_mut().enumerate().skip(first).take(unknown + H + 1 - first) {
            entries[unknown + H - row] = 0.0;
        }
        self.rows[unknown] = [0.0; S];
        self.rows[unknown][H] = diagonal;
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
    /// condensed to it, stands in the first rows alone. Returns how many pivots are negative, which for a symmetric matrix is the
    /// number of its negative eigenvalues.
    ///
    /// # Errors
    /// A pivot that vanishes or is not finite.
    pub fn factor(&mut self) -> Result<usize, UnusablePivot> {
        self.factor_by(|_, pivot| (pivot.abs() > f64::MIN_POSITIVE && pivot.is_finite()).then_some(pivot))
    }

    /// The same for a symmetric matrix that has to be positive definite.
    ///
    /// # Errors
    /// A pivot that is not above zero, or not finite.
    pub fn factor_positive(&mut self) -> Result<(), UnusablePivot> {
        self.factor_by(|_, pivot| (pivot > 0.0 && pivot.is_finite()).then_some(pivot)).map(|_| ())
    }

    /// The same for a symmetric matrix whatever the signs of its eigenvalues, copied from `matrix`. A pivot that vanishes against its
    /// row becomes a rounding of it: the matrix is taken a rounding beside itself. Returns the number of negative
    /// eigenvalues, by Sylvester's law of inertia.
    ///
    /// # Errors
    /// An entry that is not finite.
    pub fn factor_shifted(&mut self, matrix: &Self) -> Result<usize, UnusablePivot> {
        self.clone_from(matrix);
        self.factor_by(|row, pivot| {
            let largest = matrix.rows[row].iter().fold(f64::MIN_POSITIVE / f64::EPSILON, |most, v| v.abs().max(most));
            let least = f64::EPSILON * largest;
            let pivot = if pivot.abs() < least { least.copysign(pivot) } else { pivot };
            pivot.is_finite().then_some(pivot)
        })
    }

    /// Factors in place by the pivots that `usable` makes of those found: of a row and its pivot the one to divide by.
    ///
    /// The next pivot is kept at hand, as a processor waits for what it has only just stored.
    #[inline(always)]
    fn factor_by(&mut self, usable: impl Fn(usize, f64) -> Option<f64>) -> Result<usize, UnusablePivot> {
        let mut negative = 0;
        let mut found = self.rows.last().map_or(1.0, |row| row[H]);
        for k in (0..self.rows.len()).rev() {
            let (head, tail) = self.rows.split_at_mut(k);
            let pivot_row = &mut tail[0];
            let Some(pivot) = usable(k, found) else {
                return Err(UnusablePivot { row: k });
            };
            negative += usize::from(pivot < 0.0);
            let inverse = 1.0 / pivot;
            pivot_row[H] = inverse;
            if let Some((_, near)) = head.split_last_chunk_mut::<H>() {
                found = eliminate::<H, S>(pivot_row, &mut near[H - 1], 1, inverse);
                for d in 2..=H {
                    let row = &mut near[H - d];
                    // what the band has room for and the nodes of a line do not couple
                    if d <= ALWAYS_COUPLED || row[H + d] != 0.0 {
                        eliminate::<H, S>(pivot_row, row, d, inverse);
                    }
                }
            } else {
                for (d, row) in head.iter_mut().rev().enumerate() {
                    let next = eliminate::<H, S>(pivot_row, row, d + 1, inverse);
                    if d == 0 {
                        found = next;
                    }
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
            for j in (1..H).rev() {
                sum -= row[H - 1 - j] * near[j];
            }
            // the value found last is divided by the pivot apart from the others, so that it is waited for once
            let last = sum * row[H] - (row[H - 1] * row[H]) * near[0];
            for j in (1..H).rev() {
                near[j] = near[j - 1];
            }
            near[0] = last;
            *value = last;
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

/// Takes the pivot row out of the row `d` above it; returns the diagonal of that row.
#[inline(always)]
fn eliminate<const H: usize, const S: usize>(pivot_row: &[f64; S], row: &mut [f64; S], d: usize, inverse: f64) -> f64 {
    let factor = row[H + d] * inverse;
    row[H + d] = factor;
    let diagonal = row[H] - factor * pivot_row[H - d];
    for j in 0..H {
        row[d + j] -= factor * pivot_row[j];
    }
    diagonal
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    use crate::dense::{Lu, SymmetricEigen, never};
    use nalgebra::{DMatrix, DVector};

    /// Numbers between -1 and 1 that look random and are the same every time.
    fn noise(seed: u64) -> impl FnMut() -> f64 {
        let mut state = seed;
        move || {
            state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (state >> 11) as f64 / (1u64 << 52) as f64 - 1.0
        }
    }

    /// A random matrix, its diagonal raised by `shift`, and the same dense.
    fn random<const H: usize, const S: usize>(
        size: usize,
        shift: f64,
        symmetric: bool,
        draw: &mut impl FnMut() -> f64,
    ) -> (BandMatrix<H, S>, DMatrix<f64>) {
        let (mut band, mut dense) = (BandMatrix::new(size), DMatrix::zeros(size, size));
        for i in 0..size {
            for j in i.saturating_sub(H)..(i + H + 1).min(size) {
                if symmetric && j > i {
                    continue;
                }
                let value = draw() + if i == j { shift } else { 0.0 };
                if symmetric && i != j {
                    band.add_symmetric(i, j, value);
                    dense[(j, i)] = value;
                } else {
                    band.add(i, j, value);
                }
                dense[(i, j)] = value;
            }
        }
        (band, dense)
    }

    /// Products, solutions and those of the transpose against nalgebra's dense ones.
    fn compare_with_dense<const H: usize, const S: usize>(size: usize, seed: u64) {
        let mut draw = noise(seed);
        let (mut band, dense) = random::<H, S>(size, 2.0 * S as f64, false, &mut draw);
        let right = DVector::from_fn(size, |_, _| draw());
        let mut product = vec![0.0; size];
        band.times(right.as_slice(), &mut product);
        let off = (DVector::from_vec(product) - &dense * &right).amax();
        assert!(off < 1e-13, "{size} {off}");
        band.factor().unwrap();
        let (mut found, mut across) = (right.clone(), right.iter().map(|r| [*r]).collect::<Vec<_>>());
        band.solve(found.as_mut_slice());
        band.solve_transposed(&mut across, (size, size));
        let off = (found - Lu::new(dense.clone(), &never).unwrap().solve(&right).unwrap()).amax();
        let across = DVector::from_iterator(size, across.iter().map(|x| x[0]));
        let off_across = (across - Lu::new(dense.transpose(), &never).unwrap().solve(&right).unwrap()).amax();
        // solutions are below one half, the condition below 10
        assert!(off < 1e-15 && off_across < 1e-15, "{size} {off} {off_across}");
    }

    #[test]
    fn products_and_solutions_equal_dense_ones_of_random_matrices() {
        for seed in 0..20 {
            for size in [1, 2, 5, 23, 60] {
                compare_with_dense::<3, 7>(size, seed);
                compare_with_dense::<5, 11>(size, seed + 100);
                compare_with_dense::<8, 17>(size, seed + 200);
                compare_with_dense::<10, 21>(size, seed + 300);
            }
        }
    }

    #[test]
    fn negative_pivots_equal_negative_eigenvalues_of_random_matrices() {
        let mut draw = noise(7);
        let mut factors = BandMatrix::new(0);
        for size in [1, 4, 17, 40] {
            for _ in 0..25 {
                let (mut band, dense) = random::<3, 7>(size, 0.5, true, &mut draw);
                let values = SymmetricEigen::new(dense, &never).unwrap().values;
                let negative = values.iter().filter(|v| **v < 0.0).count();
                assert_eq!(factors.factor_shifted(&band), Ok(negative));
                assert_eq!(band.clone().factor(), Ok(negative));
                assert_eq!(band.factor_positive().is_ok(), negative == 0);
            }
        }
    }

    #[test]
    fn factors_at_eigenvalue_are_those_a_rounding_beside() {
        // the chain of springs [[1 -1][-1 1]] has the eigenvalues 0 and 2
        let mut band = BandMatrix::<1, 3>::new(2);
        band.add(0, 0, 1.0);
        band.add(1, 1, 1.0);
        band.add_symmetric(1, 0, -1.0);
        let mut factors = BandMatrix::new(2);
        assert_eq!(factors.factor_shifted(&band), Ok(0));
        let mut shape = [1.0, 0.5];
        factors.solve(&mut shape);
        assert!((shape[0] / shape[1] - 1.0).abs() < 1e-15 && shape[0].abs() > 1e15);
    }

    #[test]
    fn fixed_unknown_stays_zero_and_does_not_affect_others() {
        let (mut band, mut dense) = random::<3, 7>(9, 10.0, true, &mut noise(3));
        for i in 0..9 {
            (dense[(4, i)], dense[(i, 4)]) = (0.0, 0.0);
        }
        dense[(4, 4)] = 2.0;
        band.hold(4, 2.0);
        for i in 0..9 {
            for j in 0..9 {
                assert_eq!(band.get(i, j), dense[(i, j)]);
            }
        }
        band.factor_positive().unwrap();
        let mut right = [1.0; 9];
        right[4] = 0.0;
        band.solve(&mut right);
        assert_eq!(right[4], 0.0);
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
        assert_eq!(band.clone().factor(), Err(UnusablePivot { row: 1 }));
        assert_eq!(band.factor_positive(), Err(UnusablePivot { row: 1 }));
        band.add(0, 0, f64::NAN);
        assert_eq!(BandMatrix::new(3).factor_shifted(&band), Err(UnusablePivot { row: 0 }));
        assert_eq!(UnusablePivot { row: 1 }.to_string(), "the pivot of row 2 of the band matrix cannot be used");
    }
}
