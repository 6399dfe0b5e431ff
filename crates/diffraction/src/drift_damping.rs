//! Wave drift damping from the mean drift in waves of other frequencies and headings [ARANHA-1994].
//!
//! A body that drifts slowly through deep water meets other waves: their frequency is shifted, their heading turned. To first order in its
//! velocity V the force falls by `B V`,
//!
//! ```text
//! B_ix = omega/g [(4 F_i + omega dF_i/domega) cos beta - 2 dF_i/dbeta sin beta]
//! B_iy = omega/g [(4 F_i + omega dF_i/domega) sin beta + 2 dF_i/dbeta cos beta]
//! ```

use crate::error::DiffractionError;
use crate::problem::{DiffractionProblem, FrequencyForces};
use nalgebra::{Complex, Matrix2, Vector2};

/// Step of the frequency in differences of the drift, over the frequency: the error is some 1e-4 where the drift changes over a tenth of the
/// frequency.
const FREQUENCY_SHARE: f64 = 0.01;
/// Step of the heading (rad).
const HEADING_STEP: f64 = 0.02;

/// Mean drift in surge and sway, and how it damps slow motions; for a wave of amplitude 1 m.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DriftDamping {
    /// Mean force along x and y (N/m2).
    pub force: Vector2<f64>,
    /// Damping: row the force, column the velocity (N s/m3). A body with the velocity V through the water has the force `force -
    /// damping V`.
    pub damping: Matrix2<f64>,
}

impl DiffractionProblem {
    /// The wave drift damping in surge and sway at a frequency (rad/s) and heading (rad), in deep water, by the drift far away; of several bodies
    /// the sum. `motions` gives the motions of the bodies for the headings of a solution, zeros for fixed bodies.
    ///
    /// # Errors
    /// Water of finite depth, for which the formula does not hold; motions that are not six a body; as of [`DiffractionProblem::solve`].
    pub fn wave_drift_damping(
        &self,
        frequency: f64,
        heading: f64,
        motions: impl Fn(&FrequencyForces) -> Result<Vec<Vec<Complex<f64>>>, DiffractionError>,
    ) -> Result<DriftDamping, DiffractionError> {
        if let Some(depth) = self.water().depth {
            return Err(DiffractionError::DriftDampingDepth(depth));
        }
        let drifts = |frequency: f64, headings: &[f64]| -> Result<Vec<Vector2<f64>>, DiffractionError> {
            let waves = self.solve_waves(frequency, headings)?;
            let motions = motions(&waves.forces)?;
            (0..headings.len())
                .map(|index| {
                    let found = motions.get(index).and_then(|motions| waves.far_field_drift(index, motions));
                    found.map(|drift| Vector2::new(drift.surge, drift.sway)).ok_or(DiffractionError::MotionCount)
                })
                .collect()
        };
        let own = drifts(frequency, &[heading, heading - HEADING_STEP, heading + HEADING_STEP])?;
        let below = drifts(frequency * (1.0 - FREQUENCY_SHARE), &[heading])?;
        let above = drifts(frequency * (1.0 + FREQUENCY_SHARE), &[heading])?;
        let (force, by_heading) = (own[0], (own[2] - own[1]) / (2.0 * HEADING_STEP));
        // omega dF/domega
        let by_frequency = (above[0] - below[0]) / (2.0 * FREQUENCY_SHARE);
        let (sine, cosine) = heading.sin_cos();
        let along = force * 4.0 + by_frequency;
        let columns = [along * cosine - by_heading * (2.0 * sine), along * sine + by_heading * (2.0 * cosine)];
        let damping = Matrix2::from_columns(&columns) * (frequency / self.water().gravity);
        Ok(DriftDamping { force, damping })
    }
}
