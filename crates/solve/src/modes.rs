//! Small motions about a place: the eigenvalues of the stiffness against the mass, and natural periods.

use super::system::{DOFS, SolveError, System, SystemState};
use nalgebra::{DMatrix, DVector};
use std::f64::consts::TAU;
use windlass_base::dense::{Cholesky, DenseError, Lu, Stop, SymmetricEigen, eigenvalues, least_squares};

/// A small motion of the whole system.
#[derive(Clone, Debug, PartialEq)]
pub struct SystemMode {
    /// Eigenvalue of the stiffness against the mass (rad2/s2), its real part; negative: not stable.
    pub eigenvalue: f64,
    /// Its imaginary part: other than zero where forces without an energy couple two motions; these feed each other.
    pub beside: f64,
    /// Undamped natural period (s), where it is stable.
    pub period: Option<f64>,
    /// The degree of freedom that moves most: body and degree of freedom, as written.
    pub most: (String, &'static str),
    /// Its motion, six a body, largest 1 with rotations times 1 m.
    pub shape: DVector<f64>,
}

/// The modes of the degrees of freedom that move, lowest eigenvalue first. Degrees of freedom of bodies without mass follow the others.
///
/// # Errors
/// A mass or stiffness that is not finite, with its body and degree of freedom; eigenvalues that do not converge; an interrupt.
pub fn modes(system: &System, state: &SystemState) -> Result<Vec<SystemMode>, SolveError> {
    modes_with(system, &system.mass_matrix(&state.poses), &state.stiffness)
}

/// The same of a mass matrix and a stiffness, six a body.
pub(super) fn modes_with(
    system: &System,
    mass: &DMatrix<f64>,
    stiffness: &DMatrix<f64>,
) -> Result<Vec<SystemMode>, SolveError> {
    let free = |i: usize| system.nodes[i / 6].free[i % 6];
    let rows: Vec<usize> = (0..mass.nrows()).filter(|i| free(*i)).collect();
    let (heavy, light): (Vec<usize>, Vec<usize>) = rows.iter().partition(|i| mass[(**i, **i)] > 0.0);
    if heavy.is_empty() {
        return Ok(Vec::new());
    }
    let stop = || system.is_interrupted();
    let part = |m: &DMatrix<f64>, r: &[usize], c: &[usize]| m.select_rows(r).select_columns(c);
    let mut k = part(stiffness, &heavy, &heavy);
    let solved = solve_least_motion(part(stiffness, &light, &light), &part(stiffness, &light, &heavy), &stop);
    let solved = solved.map_err(|e| system.singular_matrix_error("stiffness", &light, e))?;
    k -= part(stiffness, &heavy, &light) * &solved;
    let follow = -solved;
    // weights without radii of gyration make a mass without inertia about some axis
    let mut m = part(mass, &heavy, &heavy);
    let tiny = m.diagonal().amax() * 1e-12;
    m.iter_mut().step_by(heavy.len() + 1).for_each(|d| *d += tiny);
    let root = match Cholesky::new(m, &stop).and_then(|c| c.inverse_of_lower()) {
        Ok(root) => root,
        // added mass may take away more than there is
        Err(DenseError::NotPositive | DenseError::Singular) => return Ok(Vec::new()),
        Err(error) => return Err(system.singular_matrix_error("mass", &heavy, error)),
    };
    let pairs = pairs(&(&root * k * root.transpose()), &stop)
        .map_err(|e| system.singular_matrix_error("stiffness", &heavy, e))?;
    let mode = |(eigenvalue, beside, vector): (f64, f64, DVector<f64>)| {
        let heavy_part = root.transpose() * vector;
        let light_part = &follow * &heavy_part;
        let mut shape = DVector::zeros(mass.nrows());
        for (row, value) in heavy.iter().zip(heavy_part.iter()).chain(light.iter().zip(light_part.iter())) {
            shape[*row] = *value;
        }
        let size = shape.amax();
        if size > 0.0 {
            shape /= size;
        }
        // a translation through the radius of gyration weighs as much as the rotation
        let weigh = |i: usize| shape[i].abs() * mass[(i, i)].max(0.0).sqrt();
        let most = (0..shape.len()).max_by(|a, b| weigh(*a).total_cmp(&weigh(*b))).unwrap_or(0);
        let body = system.nodes.get(most / 6).map_or(String::new(), |n| n.name.clone());
        SystemMode {
            eigenvalue,
            beside,
            period: (eigenvalue > 0.0).then(|| TAU / eigenvalue.sqrt()),
            most: (body, DOFS.get(most % 6).copied().unwrap_or_default()),
            shape,
        }
    };
    Ok(pairs.into_iter().map(mode).collect())
}

/// What solves `k x = right` with as little motion as can be: what nothing holds does not move.
pub(super) fn solve_least_motion(
    k: DMatrix<f64>,
    right: &DMatrix<f64>,
    stop: Stop,
) -> Result<DMatrix<f64>, DenseError> {
    let size = k.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    least_squares(k, right, 1e-12 * size, stop)
}

/// Share of its largest element by which a matrix may differ from its transpose and be taken for symmetric.
const SYMMETRY_TOLERANCE: f64 = 1e-7;

/// Eigenvalues of a matrix, real and imaginary parts, with vectors, lowest first. Forces without an energy (a pin in a cone of
/// unlike springs, friction, tables) make it unsymmetric.
fn pairs(matrix: &DMatrix<f64>, stop: Stop) -> Result<Vec<(f64, f64, DVector<f64>)>, DenseError> {
    let size = matrix.amax();
    let mut list: Vec<(f64, f64, DVector<f64>)> = if (matrix - matrix.transpose()).amax() <= SYMMETRY_TOLERANCE * size {
        let eigen = SymmetricEigen::new((matrix + matrix.transpose()) * 0.5, stop)?;
        let vectors = eigen.vectors.column_iter().map(|c| c.into_owned());
        eigen.values.iter().zip(vectors).map(|(value, vector)| (*value, 0.0, vector)).collect()
    } else {
        let values = eigenvalues(matrix.clone(), stop)?;
        let one = |value: nalgebra::Complex<f64>| Ok((value.re, value.im, vector(matrix, value.re, stop)?));
        values.into_iter().map(one).collect::<Result<_, DenseError>>()?
    };
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    Ok(list)
}

/// The vector of an eigenvalue, by inverse iteration from beside it.
fn vector(matrix: &DMatrix<f64>, value: f64, stop: Stop) -> Result<DVector<f64>, DenseError> {
    let size = matrix.amax().max(f64::MIN_POSITIVE);
    let mut shifted = matrix.clone();
    shifted.iter_mut().step_by(matrix.nrows() + 1).for_each(|d| *d -= value + 1e-10 * size);
    let solver = Lu::new(shifted, stop)?;
    // no eigenvector is at right angles to all of these numbers
    let mut vector = DVector::from_fn(matrix.nrows(), |i, _| 1.0 + 0.37 * i as f64);
    for _ in 0..3 {
        match solver.solve(&vector) {
            Ok(next) if next.norm() > 0.0 => vector = next.normalize(),
            _ => break,
        }
    }
    Ok(vector)
}
