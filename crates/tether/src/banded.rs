//! Symmetric matrices of one plane of a tether: only the diagonal and three lines below it are filled, since a node is
//! coupled to the next alone. Factors L D L' without exchange of rows: work and memory go with the order.

use windlass_model::ClassError;

/// Filled entries of a row up to the diagonal.
pub const BANDWIDTH: usize = 4;

/// A symmetric matrix with a band of [`BANDWIDTH`].
#[derive(Clone, Debug, PartialEq)]
pub struct Banded {
    /// Row by row: the diagonal, then the entries one, two, three columns to its left.
    rows: Vec<[f64; BANDWIDTH]>,
}

/// The factors of a [`Banded`]: rows of L (unit diagonal) with the diagonal matrix D in place of it.
#[derive(Clone, Debug, PartialEq)]
pub struct BandedFactors {
    rows: Vec<[f64; BANDWIDTH]>,
}

impl Banded {
    /// A matrix of zeros.
    pub fn zeros(order: usize) -> Self {
        Banded { rows: vec![[0.0; BANDWIDTH]; order] }
    }

    /// Its order.
    pub fn order(&self) -> usize {
        self.rows.len()
    }

    /// Makes all entries zero.
    pub fn clear(&mut self) {
        self.rows.fill([0.0; BANDWIDTH]);
    }

    /// Adds to an entry and to its mirror image. `row - column` is 0 to 3; entries outside the band are zero and stay so.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        if let Some(entry) = self.rows.get_mut(row).and_then(|r| r.get_mut(row.wrapping_sub(column))) {
            *entry += value;
        }
    }

    /// An entry on or below the diagonal.
    pub fn get(&self, row: usize, column: usize) -> f64 {
        self.rows.get(row).and_then(|r| r.get(row.wrapping_sub(column))).copied().unwrap_or_default()
    }

    /// Becomes `self + factor * other`, of the same order.
    pub fn add_scaled(&mut self, factor: f64, other: &Banded) {
        for (mine, theirs) in self.rows.iter_mut().flatten().zip(other.rows.iter().flatten()) {
            *mine += factor * theirs;
        }
    }

    /// Holds an unknown at zero: its row and column become those of the unit matrix times `diagonal`.
    pub fn hold(&mut self, unknown: usize, diagonal: f64) {
        for (row, entries) in self.rows.iter_mut().enumerate().skip(unknown).take(BANDWIDTH) {
            if row == unknown {
                *entries = [diagonal, 0.0, 0.0, 0.0];
            } else {
                entries[row - unknown] = 0.0;
            }
        }
    }

    /// The product with a vector, into `product`.
    pub fn times(&self, vector: &[f64], product: &mut [f64]) {
        product.fill(0.0);
        for (i, row) in self.rows.iter().enumerate() {
            product[i] += row[0] * vector[i];
            for k in 1..=i.min(BANDWIDTH - 1) {
                product[i] += row[k] * vector[i - k];
                product[i - k] += row[k] * vector[i];
            }
        }
    }

    /// Factors it, which must be positive definite.
    ///
    /// # Errors
    /// A pivot that is not above zero: a mass is missing, or a motion has neither stiffness nor mass.
    pub fn factor(&self) -> Result<BandedFactors, ClassError> {
        let mut factors = BandedFactors { rows: Vec::with_capacity(self.rows.len()) };
        self.factor_into(&mut factors)?;
        Ok(factors)
    }

    /// The same into factors that are there, without a new allocation once they are of this order.
    ///
    /// # Errors
    /// Those of [`Banded::factor`].
    pub fn factor_into(&self, factors: &mut BandedFactors) -> Result<(), ClassError> {
        factors.rows.clear();
        for row in 0..self.rows.len() {
            let made = self.eliminate_row(&factors.rows, row);
            // not `<=`: a pivot that is no number is refused as well
            if !(made[0] > 0.0 && made[0].is_finite()) {
                return Err(ClassError::new(format!(
                    "the matrix of the tether is singular at node {}: neither mass nor stiffness holds it",
                    row / 2 + 1
                )));
            }
            factors.rows.push(made);
        }
        Ok(())
    }

    /// Factors it whatever the signs of its pivots; one that vanishes against the row becomes a rounding of it (the matrix is
    /// then taken a rounding beside itself). Returned with the number of negative pivots, which by Sylvester's law is that of the
    /// negative eigenvalues.
    pub(super) fn factor_indefinite(&self, factors: &mut BandedFactors) -> usize {
        let mut negative = 0;
        factors.rows.clear();
        for row in 0..self.rows.len() {
            let mut made = self.eliminate_row(&factors.rows, row);
            let least = f64::EPSILON * self.rows[row][0].abs().max(f64::MIN_POSITIVE / f64::EPSILON);
            if made[0].abs() < least {
                made[0] = if made[0] < 0.0 { -least } else { least };
            }
            negative += usize::from(made[0] < 0.0);
            factors.rows.push(made);
        }
        negative
    }

    /// A row of the factors from those above it.
    #[inline]
    fn eliminate_row(&self, above: &[[f64; BANDWIDTH]], row: usize) -> [f64; BANDWIDTH] {
        let mut made = self.rows[row];
        let reach = row.min(BANDWIDTH - 1);
        // made[k] holds L * D of column row - k until it is divided
        for k in (1..=reach).rev() {
            for m in k + 1..=reach {
                made[k] -= made[m] * above[row - k][m - k];
            }
        }
        for k in 1..=reach {
            let scaled = made[k] / above[row - k][0];
            made[0] -= scaled * made[k];
            made[k] = scaled;
        }
        made
    }
}

impl BandedFactors {
    /// Factors of no matrix yet, with room for an order.
    pub fn with_room(order: usize) -> Self {
        BandedFactors { rows: Vec::with_capacity(order) }
    }

    /// Solves in place: the right-hand side becomes the solution.
    pub fn solve(&self, right: &mut [f64]) {
        for i in 0..self.rows.len() {
            for k in 1..=i.min(BANDWIDTH - 1) {
                right[i] -= self.rows[i][k] * right[i - k];
            }
        }
        for (value, row) in right.iter_mut().zip(&self.rows) {
            *value /= row[0];
        }
        for i in (0..self.rows.len()).rev() {
            for k in 1..=i.min(BANDWIDTH - 1) {
                right[i - k] -= self.rows[i][k] * right[i];
            }
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    /// A positive definite matrix with a full band.
    fn matrix(order: usize) -> Banded {
        let mut m = Banded::zeros(order);
        for i in 0..order {
            m.add(i, i, 9.0 + (i % 5) as f64);
            for k in 1..=i.min(3) {
                m.add(i, i - k, 1.5 / k as f64 - 0.3 * (i % 3) as f64);
            }
        }
        m
    }

    #[test]
    fn solution_times_matrix_equals_right_hand_side() {
        let m = matrix(31);
        let want: Vec<f64> = (0..31).map(|i| f64::from(i).sin()).collect();
        let mut product = vec![0.0; 31];
        m.times(&want, &mut product);
        m.factor().unwrap().solve(&mut product);
        assert!(product.iter().zip(&want).all(|(x, y)| (x - y).abs() < 1e-14));
    }

    #[test]
    fn fixed_unknown_stays_zero_and_does_not_affect_others() {
        let mut m = matrix(9);
        m.hold(4, 1.0);
        let mut right = vec![1.0; 9];
        right[4] = 0.0;
        m.factor().unwrap().solve(&mut right);
        assert_eq!(right[4], 0.0);
        assert_eq!((m.get(4, 4), m.get(4, 2), m.get(6, 4)), (1.0, 0.0, 0.0));
    }

    #[test]
    fn matrix_not_positive_definite_is_refused() {
        assert!(Banded::zeros(4).factor().unwrap_err().to_string().contains("node 1"));
        let mut m = matrix(6);
        m.add(3, 3, f64::NAN);
        assert!(m.factor().unwrap_err().to_string().contains("node 2"));
    }
}
