//! Dense factorisations and eigenvalues: the one place where the engines call for them.
//!
//! The algorithms are nalgebra's: LU with partial pivoting, Cholesky, the implicit QR iterations for singular values and eigenvalues
//! (Golub and Van Loan, Matrix Computations, 4th ed., ch. 3, 4, 7 and 8). Here each of them is guarded: numbers that are not finite are
//! refused before and after, iterations are bounded, a matrix without rows has its plain answer, and an interrupt is listened to
//! before and after each factorisation. A factorisation itself runs to its end: a tenth of a second for 600 unknowns.
//!
//! # Example
//! ```
//! use nalgebra::{Matrix2, Vector2};
//! use windlass_base::dense::{DenseError, Lu, never};
//!
//! let lu = Lu::new(Matrix2::new(4.0, 1.0, 2.0, 3.0), &never)?;
//! assert!((lu.solve(&Vector2::new(6.0, 8.0))? - Vector2::new(1.0, 2.0)).norm() < 1e-15);
//! let damaged = Matrix2::new(4.0, f64::NAN, 2.0, 3.0);
//! assert_eq!(Lu::new(damaged, &never).unwrap_err(), DenseError::NotFinite { row: 0, column: 1 });
//! # Ok::<(), DenseError>(())
//! ```

use nalgebra::allocator::Allocator;
use nalgebra::{
    Complex, ComplexField, DMatrix, DVector, DefaultAllocator, Dim, DimDiff, DimMin, DimSub, LU, OMatrix, OVector, SVD,
    Schur, U1,
};

/// Whether whoever waits for an answer wants none any more: Ctrl-C.
pub type Stop<'a> = &'a dyn Fn() -> bool;

/// Nobody interrupts: for matrices of a size that is fixed and small.
pub fn never() -> bool {
    false
}

/// Iterations a row of a matrix before an iterative factorisation is given up; two to four are usual, and LAPACK allows 30.
const MAX_ITERATIONS_A_ROW: usize = 60;

/// Why a matrix has no factors.
#[derive(Clone, Copy, Debug, PartialEq, Eq, thiserror::Error)]
pub enum DenseError {
    /// An entry is not finite.
    #[error("row {}, column {} of the matrix is not finite", row + 1, column + 1)]
    NotFinite {
        /// Its row, from 0.
        row: usize,
        /// Its column, from 0.
        column: usize,
    },
    /// The matrix has no inverse, or none that is finite.
    #[error("the matrix is singular")]
    Singular,
    /// A Cholesky factor was asked for, and the matrix is not positive definite.
    #[error("the matrix is not positive definite")]
    NotPositive,
    /// Singular values or eigenvalues did not converge.
    #[error("no convergence within {iterations} iterations")]
    NotConverged {
        /// The bound.
        iterations: usize,
    },
    /// It was interrupted.
    #[error("interrupted")]
    Interrupted,
}

/// Sees that there is something to do, and numbers to do it with.
fn check<T: ComplexField, R: Dim, C: Dim>(matrix: &OMatrix<T, R, C>, stop: Stop) -> Result<(), DenseError>
where
    DefaultAllocator: Allocator<R, C>,
{
    if stop() {
        return Err(DenseError::Interrupted);
    }
    match matrix.iter().position(|v| !v.is_finite()) {
        Some(at) => Err(DenseError::NotFinite { row: at % matrix.nrows(), column: at / matrix.nrows() }),
        None => Ok(()),
    }
}

/// A result, where its numbers are finite.
fn finite<T: ComplexField, R: Dim, C: Dim>(
    made: Option<OMatrix<T, R, C>>,
    otherwise: DenseError,
) -> Result<OMatrix<T, R, C>, DenseError>
where
    DefaultAllocator: Allocator<R, C>,
{
    made.filter(|m| m.iter().all(ComplexField::is_finite)).ok_or(otherwise)
}

/// The factors of a square matrix: LU with partial pivoting.
#[derive(Clone, Debug)]
pub struct Lu<T: ComplexField, D: DimMin<D, Output = D>>(LU<T, D, D>)
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>;

impl<T: ComplexField, D: DimMin<D, Output = D>> Lu<T, D>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>,
{
    /// Factors a matrix.
    ///
    /// # Errors
    /// An entry that is not finite; an interrupt. A singular matrix has factors: [`Lu::solve`] refuses it.
    pub fn new(matrix: OMatrix<T, D, D>, stop: Stop) -> Result<Self, DenseError> {
        check(&matrix, stop)?;
        let made = Lu(LU::new(matrix));
        if stop() { Err(DenseError::Interrupted) } else { Ok(made) }
    }

    /// Solves for right sides, a column each.
    ///
    /// # Errors
    /// A singular matrix; a right side or a solution that is not finite.
    pub fn solve<C: Dim>(&self, right: &OMatrix<T, D, C>) -> Result<OMatrix<T, D, C>, DenseError>
    where
        DefaultAllocator: Allocator<D, C>,
    {
        check(right, &never)?;
        if right.is_empty() {
            return Ok(right.clone());
        }
        finite(self.0.solve(right), DenseError::Singular)
    }

    /// The inverse.
    ///
    /// # Errors
    /// A singular matrix.
    pub fn inverse(&self) -> Result<OMatrix<T, D, D>, DenseError> {
        if self.0.lu_internal().is_empty() {
            return Ok(self.0.lu_internal().clone());
        }
        finite(self.0.try_inverse(), DenseError::Singular)
    }
}

/// The inverse of a square matrix.
///
/// # Errors
/// An entry that is not finite; a singular matrix.
pub fn inverse<T: ComplexField, D: Dim>(matrix: OMatrix<T, D, D>) -> Result<OMatrix<T, D, D>, DenseError>
where
    DefaultAllocator: Allocator<D, D>,
{
    check(&matrix, &never)?;
    if matrix.is_empty() {
        return Ok(matrix);
    }
    finite(matrix.try_inverse(), DenseError::Singular)
}

/// The Cholesky factor `L` of a matrix `L L^T` of which the lower triangle is read.
#[derive(Clone, Debug)]
pub struct Cholesky<D: Dim>(nalgebra::Cholesky<f64, D>)
where
    DefaultAllocator: Allocator<D, D>;

impl<D: Dim> Cholesky<D>
where
    DefaultAllocator: Allocator<D, D>,
{
    /// Factors a matrix.
    ///
    /// # Errors
    /// An entry that is not finite; a matrix that is not positive definite; an interrupt.
    pub fn new(matrix: OMatrix<f64, D, D>, stop: Stop) -> Result<Self, DenseError> {
        check(&matrix, stop)?;
        let made = nalgebra::Cholesky::new(matrix).ok_or(DenseError::NotPositive)?;
        if stop() { Err(DenseError::Interrupted) } else { Ok(Cholesky(made)) }
    }

    /// Solves for right sides, a column each.
    ///
    /// # Errors
    /// A right side or a solution that is not finite.
    pub fn solve<C: Dim>(&self, right: &OMatrix<f64, D, C>) -> Result<OMatrix<f64, D, C>, DenseError>
    where
        DefaultAllocator: Allocator<D, C>,
    {
        check(right, &never)?;
        if right.is_empty() {
            return Ok(right.clone());
        }
        finite(Some(self.0.solve(right)), DenseError::Singular)
    }

    /// The lower triangle `L`.
    pub fn lower(&self) -> OMatrix<f64, D, D> {
        self.0.l()
    }

    /// Its inverse.
    ///
    /// # Errors
    /// An inverse that is not finite.
    pub fn inverse_of_lower(&self) -> Result<OMatrix<f64, D, D>, DenseError> {
        inverse(self.0.l())
    }
}

/// Eigenvalues of a symmetric or Hermitian matrix, in no order, with their vectors of length 1 as columns.
#[derive(Clone, Debug)]
pub struct SymmetricEigen<T: ComplexField, D: Dim>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>,
{
    /// The eigenvalues.
    pub values: OVector<T::RealField, D>,
    /// The vector of each, a column.
    pub vectors: OMatrix<T, D, D>,
}

impl<T: ComplexField<RealField = f64>, D: DimSub<U1>> SymmetricEigen<T, D>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D> + Allocator<DimDiff<D, U1>>,
{
    /// Solves a matrix of which the lower triangle is read.
    ///
    /// # Errors
    /// An entry that is not finite; iterations that do not converge; an interrupt.
    pub fn new(matrix: OMatrix<T, D, D>, stop: Stop) -> Result<Self, DenseError> {
        check(&matrix, stop)?;
        let (rows, _) = matrix.shape_generic();
        if matrix.is_empty() {
            let (values, vectors) = (OVector::zeros_generic(rows, U1), matrix);
            return Ok(SymmetricEigen { values, vectors });
        }
        let iterations = MAX_ITERATIONS_A_ROW * matrix.nrows();
        let failed = DenseError::NotConverged { iterations };
        let made = nalgebra::SymmetricEigen::try_new(matrix, f64::EPSILON, iterations).ok_or(failed)?;
        if stop() {
            return Err(DenseError::Interrupted);
        }
        let values = finite(Some(made.eigenvalues), failed)?;
        Ok(SymmetricEigen { values, vectors: finite(Some(made.eigenvectors), failed)? })
    }
}

/// The eigenvalues of a square matrix.
///
/// # Errors
/// An entry that is not finite; iterations that do not converge; an interrupt.
pub fn eigenvalues<D: DimSub<U1>>(matrix: OMatrix<f64, D, D>, stop: Stop) -> Result<Vec<Complex<f64>>, DenseError>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D> + Allocator<DimDiff<D, U1>> + Allocator<D, DimDiff<D, U1>>,
{
    check(&matrix, stop)?;
    if matrix.is_empty() {
        return Ok(Vec::new());
    }
    let iterations = MAX_ITERATIONS_A_ROW * matrix.nrows();
    let failed = DenseError::NotConverged { iterations };
    let made = Schur::try_new(matrix, f64::EPSILON, iterations).ok_or(failed)?;
    if stop() {
        return Err(DenseError::Interrupted);
    }
    Ok(finite(Some(made.complex_eigenvalues()), failed)?.iter().copied().collect())
}

/// What solves a system with the least residual, and of all such with the least size: along singular vectors whose values are below
/// `least` it is zero.
///
/// # Errors
/// An entry that is not finite; singular values that do not converge; an interrupt.
pub fn least_squares(
    matrix: DMatrix<f64>,
    right: &DMatrix<f64>,
    least: f64,
    stop: Stop,
) -> Result<DMatrix<f64>, DenseError> {
    check(&matrix, stop)?;
    check(right, stop)?;
    if matrix.is_empty() || right.is_empty() {
        return Ok(DMatrix::zeros(matrix.ncols(), right.ncols()));
    }
    let iterations = MAX_ITERATIONS_A_ROW * matrix.nrows().max(matrix.ncols());
    let failed = DenseError::NotConverged { iterations };
    let made = SVD::try_new_unordered(matrix, true, true, 5.0 * f64::EPSILON, iterations).ok_or(failed)?;
    if stop() {
        return Err(DenseError::Interrupted);
    }
    finite(made.solve(right, least).ok(), failed)
}

/// The same for one right side.
///
/// # Errors
/// As [`least_squares`].
pub fn least_squares_of_one(
    matrix: DMatrix<f64>,
    right: &DVector<f64>,
    least: f64,
    stop: Stop,
) -> Result<DVector<f64>, DenseError> {
    let right = DMatrix::from_column_slice(right.nrows(), 1, right.as_slice());
    let made = least_squares(matrix, &right, least, stop)?;
    Ok(made.column_iter().next().map_or_else(|| DVector::zeros(0), |column| column.into_owned()))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use nalgebra::{Dyn, Matrix2, Matrix3, Matrix6, Vector3};

    fn empty() -> DMatrix<f64> {
        DMatrix::zeros(0, 0)
    }

    /// A matrix with one damaged entry.
    fn matrix_with_damaged_entry(value: f64) -> DMatrix<f64> {
        let mut made = DMatrix::from_fn(7, 7, |i, j| 1.0 / (1.0 + (i + j) as f64));
        made[(4, 2)] = value;
        made
    }

    #[test]
    fn entry_not_finite_is_refused_with_its_position() {
        let at = DenseError::NotFinite { row: 4, column: 2 };
        for value in [f64::NAN, f64::INFINITY, f64::NEG_INFINITY] {
            let right = DMatrix::zeros(7, 1);
            assert_eq!(Lu::new(matrix_with_damaged_entry(value), &never).unwrap_err(), at);
            assert_eq!(Cholesky::new(matrix_with_damaged_entry(value), &never).unwrap_err(), at);
            assert_eq!(SymmetricEigen::new(matrix_with_damaged_entry(value), &never).unwrap_err(), at);
            assert_eq!(eigenvalues(matrix_with_damaged_entry(value), &never).unwrap_err(), at);
            assert_eq!(least_squares(matrix_with_damaged_entry(value), &right, 0.0, &never).unwrap_err(), at);
            assert_eq!(inverse(matrix_with_damaged_entry(value)).unwrap_err(), at);
        }
        assert_eq!(at.to_string(), "row 5, column 3 of the matrix is not finite");
    }

    #[test]
    fn largest_finite_entries_end_with_answer_or_error() {
        // squares of such entries are no numbers; what matters is that each call returns
        for size in [1e152, 1e154, 1e200, f64::MAX] {
            let matrix = matrix_with_damaged_entry(size) * 1.0;
            let _ = Lu::new(matrix.clone(), &never).and_then(|lu| lu.solve(&DMatrix::repeat(7, 1, size)));
            let _ = Cholesky::new(matrix.clone(), &never);
            let _ = SymmetricEigen::new(&matrix + matrix.transpose() * 0.5, &never);
            let _ = eigenvalues(matrix.clone(), &never);
            let _ = least_squares(matrix.clone(), &DMatrix::repeat(7, 1, size), 0.0, &never);
        }
    }

    #[test]
    fn matrix_without_rows_gives_empty_answer() {
        assert_eq!(Lu::new(empty(), &never).unwrap().solve(&DMatrix::zeros(0, 3)).unwrap().shape(), (0, 3));
        assert_eq!(Lu::new(empty(), &never).unwrap().inverse().unwrap().shape(), (0, 0));
        assert_eq!(Cholesky::new(empty(), &never).unwrap().inverse_of_lower().unwrap().shape(), (0, 0));
        assert_eq!(SymmetricEigen::new(empty(), &never).unwrap().values.len(), 0);
        assert_eq!(eigenvalues(empty(), &never).unwrap(), []);
        assert_eq!(least_squares(empty(), &DMatrix::zeros(0, 2), 0.0, &never).unwrap().shape(), (0, 2));
        assert_eq!(least_squares_of_one(empty(), &DVector::zeros(0), 0.0, &never).unwrap().len(), 0);
        assert_eq!(inverse(empty()).unwrap().shape(), (0, 0));
    }

    #[test]
    fn interrupt_stops_every_factorisation() {
        let stop = || true;
        let identity = || DMatrix::<f64>::identity(3, 3);
        assert_eq!(Lu::new(identity(), &stop).unwrap_err(), DenseError::Interrupted);
        assert_eq!(Cholesky::new(identity(), &stop).unwrap_err(), DenseError::Interrupted);
        assert_eq!(SymmetricEigen::<f64, Dyn>::new(identity(), &stop).unwrap_err(), DenseError::Interrupted);
        assert_eq!(eigenvalues(identity(), &stop).unwrap_err(), DenseError::Interrupted);
        assert_eq!(least_squares(identity(), &identity(), 0.0, &stop).unwrap_err(), DenseError::Interrupted);
    }

    #[test]
    fn small_matrices_match_hand_solutions() {
        // [[2 1][1 2]]: 1 and 3; a turn by a right angle: i and -i; a dyad: the least answer lies along it
        let mut values: Vec<f64> =
            SymmetricEigen::new(Matrix2::new(2.0, 1.0, 1.0, 2.0), &never).unwrap().values.iter().copied().collect();
        values.sort_by(f64::total_cmp);
        assert!((values[0] - 1.0).abs() < 1e-15 && (values[1] - 3.0).abs() < 1e-15);
        let turned = eigenvalues(Matrix3::new(0.0, -1.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0, 5.0), &never).unwrap();
        let mut parts: Vec<(f64, f64)> = turned.iter().map(|z| (z.re.round(), z.im.round())).collect();
        parts.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.total_cmp(&b.1)));
        assert_eq!(parts, [(0.0, -1.0), (0.0, 1.0), (5.0, 0.0)]);
        let along = DVector::from_vec(vec![1.0, 2.0, 2.0]);
        let found = least_squares_of_one(&along * along.transpose(), &(&along * 9.0), 1e-12, &never).unwrap();
        assert!((found - along).norm() < 1e-14);
        let singular = Lu::new(Matrix6::<f64>::zeros(), &never).unwrap();
        assert_eq!(singular.solve(&nalgebra::Vector6::repeat(1.0)).unwrap_err(), DenseError::Singular);
        let weak = Cholesky::new(Matrix3::from_diagonal(&Vector3::new(1.0, -1.0, 1.0)), &never);
        assert_eq!(weak.unwrap_err(), DenseError::NotPositive);
    }
}
