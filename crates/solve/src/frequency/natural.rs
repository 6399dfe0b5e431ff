//! Natural periods with added mass at each mode's own frequency, and damping ratios.

use super::linear::LinearSystem;
use crate::modes::{SystemMode, modes_with};
use crate::system::SolveError;
use nalgebra::DVector;

/// Times a mode's frequency is found again.
const MAX_ITERATIONS: usize = 100;
/// Change of a frequency that is none.
const FREQUENCY_TOLERANCE: f64 = 1e-9;
/// Eigenvalue below which nothing holds a motion (rad2/s2): a period of 17 hours.
const UNRESTRAINED_EIGENVALUE: f64 = 1e-8;

/// A mode with its damping.
#[derive(Clone, Debug, PartialEq)]
pub struct Natural {
    /// Its eigenvalue, undamped period and shape, with added mass at its own frequency.
    pub mode: SystemMode,
    /// Damping over critical damping, at its own frequency; `None` where nothing holds it. It is that of the mode by itself:
    /// damping that couples modes is left out.
    pub damping: Option<f64>,
    /// Whether the frequency and its added mass agree.
    pub settled: bool,
}

/// The modes of a system about its place, lowest eigenvalue first as found with added mass at infinite frequency.
///
/// # Errors
/// As [`crate::modes()`].
pub fn natural(linear: &LinearSystem) -> Result<Vec<Natural>, SolveError> {
    let stiffness = &linear.stiffness;
    let start = modes_with(&linear.system, &linear.system.mass_matrix(&linear.poses), stiffness)?;
    let floats = linear.floats.iter().any(Option::is_some);
    start.into_iter().map(|mode| iterate_mode(linear, mode, floats)).collect()
}

fn iterate_mode(linear: &LinearSystem, mut mode: SystemMode, floats: bool) -> Result<Natural, SolveError> {
    let frequency = |mode: &SystemMode| mode.eigenvalue.max(0.0).sqrt();
    let mut settled = !floats;
    for _ in 0..MAX_ITERATIONS {
        if settled {
            break;
        }
        let w = frequency(&mode);
        let (mass, _) = linear.slow_inertia_and_damping(w);
        let list = modes_with(&linear.system, &mass, &linear.stiffness)?;
        // the one most alike in shape, with translations and rotations weighed by their inertia
        let weigh = |i: usize| mass[(i, i)].max(0.0);
        let product = |a: &DVector<f64>, b: &DVector<f64>| -> f64 {
            a.iter().zip(b.iter()).enumerate().map(|(i, (a, b))| weigh(i) * a * b).sum()
        };
        let alike = |other: &SystemMode| {
            let size = product(&other.shape, &other.shape) * product(&mode.shape, &mode.shape);
            if size > 0.0 { product(&mode.shape, &other.shape).powi(2) / size } else { 0.0 }
        };
        let best = list.into_iter().map(|m| (alike(&m), m)).reduce(|a, b| if b.0 > a.0 { b } else { a });
        let Some((_, next)) = best else { break };
        settled = (frequency(&next) - w).abs() <= FREQUENCY_TOLERANCE * w.max(UNRESTRAINED_EIGENVALUE.sqrt());
        mode = next;
    }
    let w = frequency(&mode);
    let damping = (mode.eigenvalue > UNRESTRAINED_EIGENVALUE).then(|| {
        let (mass, damping) = linear.slow_inertia_and_damping(w);
        let of = |m: &nalgebra::DMatrix<f64>| mode.shape.dot(&(m * &mode.shape));
        of(&damping) / (2.0 * w * of(&mass))
    });
    Ok(Natural { mode, damping: damping.filter(|d| d.is_finite()), settled })
}
