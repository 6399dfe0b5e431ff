//! Motions of bodies that float freely or on springs.

use crate::error::DiffractionError;
use crate::problem::FrequencyForces;
use nalgebra::{Complex, DMatrix, DVector};
use windlass_base::dense::{Lu, never};

type C = Complex<f64>;

/// What holds and slows bodies besides the waves; six motions a body, about its origin.
#[derive(Clone, Debug)]
pub struct FreeBody {
    /// Mass and moments of inertia (kg, kg m, kg m2).
    pub mass: DMatrix<f64>,
    /// Hydrostatic stiffness and that of the moorings (N/m, N, N m).
    pub stiffness: DMatrix<f64>,
    /// Damping that is not radiation (N s/m, N s, N m s).
    pub damping: DMatrix<f64>,
}

/// Motions by waves of amplitude 1 m (m/m, rad/m), heading by heading, from `(-omega2 (M + A) - i omega (B + B') + C) xi = X` with the forces by
/// Haskind's relation.
///
/// # Errors
/// Matrices of another size than those of the forces; equations without a solution.
pub fn free_motions(forces: &FrequencyForces, body: &FreeBody) -> Result<Vec<Vec<C>>, DiffractionError> {
    let shape = forces.added_mass.shape();
    let FreeBody { mass, stiffness, damping } = body;
    if [mass, stiffness, damping].iter().any(|matrix| matrix.shape() != shape) {
        return Err(DiffractionError::MatrixSize(shape.0));
    }
    let omega = forces.frequency;
    let dynamic = DMatrix::from_fn(shape.0, shape.1, |i, j| {
        let inertia = mass[(i, j)] + forces.added_mass[(i, j)];
        C::new(stiffness[(i, j)] - omega * omega * inertia, -omega * (damping[(i, j)] + forces.damping[(i, j)]))
    });
    let factors = Lu::new(dynamic, &never).map_err(|_| DiffractionError::NoMotions(omega))?;
    forces
        .excitation
        .iter()
        .map(|excitation| {
            let motions = factors.solve(&DVector::from_column_slice(excitation));
            motions.map(|motions| motions.as_slice().to_vec()).map_err(|_| DiffractionError::NoMotions(omega))
        })
        .collect()
}
