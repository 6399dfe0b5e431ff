//! Linearisation of what is not linear in velocity, in a sea: the damping that a Gaussian velocity meets on the mean.
//!
//! Of a force f of a Gaussian velocity v, the linear damping that leaves the least square of the difference is `E[-df/dv]`
//! [KAZAKOV-1965; ROBERTS-SPANOS-1990 5.3]. For `c |v| v` that is
//! `c sqrt(8/pi) sigma` [BORGMAN-1967]. The mean is taken over points
//! of equal probability, so that any connector and any load is linearised, alone or together.

use super::linear::LinearSystem;
use super::response::FrequencyResponse;
use crate::system::SolveError;
use crate::time::BodyForces;
use nalgebra::{DMatrix, DVector};
use statrs::distribution::{ContinuousCDF, Normal};
use windlass_base::pose::Six;
use windlass_model::ClassError;

/// Velocities over which the mean is taken.
const MEAN_SAMPLES: usize = 1024;
/// Most rounds.
const MAX_ITERATIONS: usize = 100;
/// Change of the deviation of a velocity, as its share, that is none.
const CONVERGENCE_TOLERANCE: f64 = 1e-5;
/// Share of the largest variance below which a velocity of its own is none.
const NEGLIGIBLE_VARIANCE_SHARE: f64 = 1e-8;

/// Linearises until damping and response agree; the response is then that of the result. Gives the rounds it took.
///
/// # Errors
/// It does not settle; a load that has no answer.
pub(super) fn linearise_to_convergence(
    linear: &mut LinearSystem,
    response: &mut FrequencyResponse,
    again: impl Fn(&LinearSystem) -> Result<FrequencyResponse, SolveError>,
) -> Result<usize, SolveError> {
    let mut before: Option<DVector<f64>> = None;
    let mut order = Vec::new();
    for round in 0..MAX_ITERATIONS {
        let spread = covariance(linear, response);
        let deviations = spread.diagonal().map(|v| v.max(0.0).sqrt());
        if let Some(before) = &before {
            let largest = deviations.amax();
            let same = |(a, b): (&f64, &f64)| (a - b).abs() <= CONVERGENCE_TOLERANCE * b.max(1e-6 * largest);
            if deviations.iter().zip(before.iter()).all(same) {
                return Ok(round);
            }
        }
        // the same in every round, so that the mean changes smoothly with the velocities
        if round == 0 {
            order = pivots(&spread);
        }
        let Some(mean) = mean_damping(linear, &spread, &order)? else { return Ok(0) };
        // half way: a motion that only this damping holds goes as its inverse, and would swing about the answer
        linear.linearised = if round == 0 { mean } else { (&linear.linearised + mean) * 0.5 };
        *response = again(linear)?;
        before = Some(deviations);
    }
    let text = format!("the linearisation of its damping does not settle in {MAX_ITERATIONS} rounds");
    Err(SolveError::new(ClassError::new(text).help("TDOM has no need of it")))
}

/// Covariance of the velocities of all bodies, six a body.
fn covariance(linear: &LinearSystem, response: &FrequencyResponse) -> DMatrix<f64> {
    let size = 6 * linear.system.nodes.len();
    let mut sum = DMatrix::zeros(size, size);
    for point in response.waves.iter().chain(&response.slow) {
        let square = point.frequency * point.frequency;
        for part in &point.parts {
            for i in 0..size {
                for j in 0..size {
                    sum[(i, j)] += square * (part[i] * part[j].conj()).re;
                }
            }
        }
    }
    sum
}

/// A metre a second beside which a rotation of a radian a second counts ten: the arm of a point on a body (m).
const ROTATION_ARM_M: f64 = 10.0;

/// The velocities that determine all others of a covariance, each with what it has of its own: the pivots of its Cholesky factor.
fn pivots(spread: &DMatrix<f64>) -> Vec<usize> {
    let weigh = |i: usize| if i % 6 < 3 { 1.0 } else { ROTATION_ARM_M * ROTATION_ARM_M };
    let mut rest = spread.clone();
    let mut order = Vec::new();
    let largest = (0..rest.nrows()).fold(0.0, |most: f64, i| most.max(rest[(i, i)] * weigh(i)));
    while order.len() < rest.nrows() {
        let own = (0..rest.nrows()).map(|i| (rest[(i, i)] * weigh(i), i));
        let (value, pivot) = own.fold((0.0, 0), |best, one| if one.0 > best.0 { one } else { best });
        if value <= NEGLIGIBLE_VARIANCE_SHARE * largest {
            break;
        }
        let column = rest.column(pivot) / rest[(pivot, pivot)].sqrt();
        rest -= &column * column.transpose();
        order.push(pivot);
    }
    order
}

/// Velocities that make a covariance, each times a number of the normal distribution, by the pivots in order.
fn factor(spread: &DMatrix<f64>, order: &[usize]) -> Vec<DVector<f64>> {
    let mut rest = spread.clone();
    let mut columns = Vec::new();
    for pivot in order {
        let own = rest[(*pivot, *pivot)];
        let column = if own > 0.0 { rest.column(*pivot) / own.sqrt() } else { DVector::zeros(rest.nrows()) };
        rest -= &column * column.transpose();
        columns.push(column);
    }
    columns
}

/// What velocities of a covariance meet on the mean beyond the damping at rest; `None` where it is linear.
fn mean_damping(
    linear: &LinearSystem,
    spread: &DMatrix<f64>,
    order: &[usize],
) -> Result<Option<DMatrix<f64>>, SolveError> {
    if order.is_empty() {
        return Ok(None);
    }
    let axes = factor(spread, order);
    let mut sum = DMatrix::zeros(spread.nrows(), spread.nrows());
    let steps = steps(axes.len());
    let normal = Normal::standard();
    let mut forces = BodyForces::default();
    for n in 0..MEAN_SAMPLES {
        let mut velocity = DVector::zeros(spread.nrows());
        for (axis, step) in axes.iter().zip(&steps) {
            // one velocity in even steps, several in those of a sequence of low discrepancy
            let share = (0.5 + (n as f64 + 0.5) * step).fract();
            let share = if axes.len() == 1 { (n as f64 + 0.5) / MEAN_SAMPLES as f64 } else { share };
            velocity += axis * normal.inverse_cdf(share.clamp(1e-9, 1.0 - 1e-9));
        }
        let six = |body: usize| Six::from_fn(|i, _| velocity[6 * body + i]);
        let velocities: Vec<Six> = (0..linear.system.nodes.len()).map(six).collect();
        let more = linear.damping_under(&velocities, &mut forces)? - &linear.damping;
        // one velocity of a linear damping gives all
        if n == 0 && more.amax() <= 1e-9 * linear.damping.amax() {
            return Ok(None);
        }
        sum += more;
    }
    match sum.iter().all(|v| v.is_finite()) {
        true => Ok(Some(sum / MEAN_SAMPLES as f64)),
        false => Err(SolveError::new(ClassError::new("a damping has no mean over the velocities in this sea"))),
    }
}

/// Steps of a sequence of low discrepancy in so many dimensions: powers of the inverse of the root of `x^(d+1) = x + 1`
/// (the generalised golden section [ROBERTS-2018]).
fn steps(dimensions: usize) -> Vec<f64> {
    let mut root: f64 = 1.5;
    for _ in 0..100 {
        root = (1.0 + root).powf(1.0 / (dimensions as f64 + 1.0));
    }
    (1..=dimensions).map(|i| root.powi(-i32::try_from(i).unwrap_or(1)).fract()).collect()
}
