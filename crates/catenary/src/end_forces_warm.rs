//! Warm start of one segment whose fairlead moves: Newton iteration from the last end forces.
//!
//! The last forces plus the last stiffness times the displacement are off by the square of the displacement, so that
//! one or two Newton steps are left. Wherever that does not lead to a proven answer at once, or leads so near another
//! regime that rounding decides, the search of [`Segment::solve_end_forces`] answers as if nothing were known.

use super::end_forces::{EndForces, FlatBottom, Regime};
use super::end_forces_cold::{RESIDUAL_TOLERANCE, check, in_contact, prove, prove_contact, solve_cold_start};
use super::end_forces_newton::{NewtonOptions, add_share, newton, square, step_share};
use super::error::LineError;
use super::line::Segment;
use super::segment::hanging;

/// Newton's iteration of the warm start; after it the cold search takes over. The change at which it ends is well inside the proof, so that the
/// start does not show.
const WARM_START: NewtonOptions =
    NewtonOptions { evaluations: 8, tolerance: 1e-2 * RESIDUAL_TOLERANCE, line_search: false };

/// See [`Segment::solve_warm_start`].
///
/// # Errors
/// Those of the cold search, which takes over where the warm start does not converge.
pub fn solve_warm_start(
    segment: &Segment,
    x: f64,
    z: f64,
    bottom: Option<FlatBottom>,
    last: &EndForces,
) -> Result<EndForces, LineError> {
    check(segment, x, z, bottom)?;
    match warm(segment, x, z, bottom, last) {
        Some(answer) => Ok(answer),
        None => solve_cold_start(segment, x, z, bottom),
    }
}

/// The answer near the last one, if there is one in the same regime.
fn warm(segment: &Segment, x: f64, z: f64, bottom: Option<FlatBottom>, last: &EndForces) -> Option<EndForces> {
    if x == 0.0 {
        return None;
    }
    match (last.regime, bottom) {
        (Regime::Suspended, _) if segment.weight < 0.0 => {
            warm_start_suspended(&segment.upside_down(), [x, -z], &last.upside_down()).map(EndForces::upside_down)
        }
        (Regime::Suspended, None) if segment.weight > 0.0 => warm_start_suspended(segment, [x, z], last),
        (Regime::Suspended, Some(_)) if segment.weight > 0.0 && z > 0.0 => warm_start_suspended(segment, [x, z], last)
            .filter(|answer| answer.anchor[1] > regime_margin(answer.fairlead)),
        (
            Regime::Contact | Regime::ContactFriction | Regime::ContactFrictionAnchorZero,
            Some(FlatBottom { friction }),
        ) if segment.weight > 0.0 && z > 0.0 => contact(segment, [x, z], friction, last),
        _ => None,
    }
}

/// A line free from end to end.
fn warm_start_suspended(segment: &Segment, at: [f64; 2], last: &EndForces) -> Option<EndForces> {
    let all = segment.weight * segment.length;
    let (fairlead, reach, steps) =
        newton(segment, at, predict_forces(at, last), WARM_START, |[h, v]| ([h, v], hanging(segment, h, v - all)))?;
    let [h, v] = fairlead;
    prove(segment, Regime::Suspended, at, fairlead, [h, v - all], &reach, 0.0, steps).ok()
}

/// A line that lies on the bottom in part: V follows from H.
fn contact(segment: &Segment, at: [f64; 2], friction: f64, last: &EndForces) -> Option<EndForces> {
    let (fairlead, reach, steps) = newton(segment, at, predict_forces(at, last), WARM_START, |[h, _]| {
        let (high, reach) = in_contact(segment, h, at[1], friction);
        ([h, high], reach)
    })?;
    let answer = prove_contact(segment, at, fairlead, &reach, friction, steps).ok()?;
    let (h, near) = (fairlead[0], regime_margin(fairlead));
    let lifts = answer.grounded * segment.weight <= near;
    let slackens = h <= near;
    let slips = friction > 0.0 && (h - friction * segment.weight * answer.grounded).abs() <= near;
    (!(lifts || slackens || slips)).then_some(answer)
}

/// The force within which another regime is too near to tell.
fn regime_margin(fairlead: [f64; 2]) -> f64 {
    10.0 * RESIDUAL_TOLERANCE * square(fairlead).sqrt()
}

/// The forces to which the last stiffness takes the last ones.
fn predict_forces([x, z]: [f64; 2], last: &EndForces) -> [f64; 2] {
    let [[a, b], [c, d]] = last.stiffness;
    let (dx, dz) = (x - last.at[0], z - last.at[1]);
    let change = [a * dx + b * dz, c * dx + d * dz];
    add_share(last.fairlead, change, step_share(last.fairlead, change))
}
