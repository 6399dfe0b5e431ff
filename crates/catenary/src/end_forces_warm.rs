//! Warm start of one segment whose fairlead moves: Newton iteration from the last end forces.
//!
//! The last forces plus the last stiffness times the displacement are off by the square of the displacement, so that
//! one or two Newton steps are left. Wherever that does not lead to a proven answer at once, or leads so near another
//! regime that rounding decides, the search of [`Segment::solve_end_forces`] answers as if nothing were known.

use super::end_forces::{EndForces, FlatBottom, Regime};
use super::end_forces_cold::{
    RESIDUAL_TOLERANCE, check, in_contact, newton_change, prove, prove_contact, solve_cold_start,
};
use super::error::LineError;
use super::line::Segment;
use super::segment::{SpanReach, hanging};

/// Evaluations of the line after which the cold search takes over.
const MAX_EVALUATIONS: usize = 8;
/// Residual as a share of the tension at which a warm search ends: well inside the proof, so that the start does not
/// show.
const WARM_START_TOLERANCE: f64 = 1e-2 * RESIDUAL_TOLERANCE;

/// See [`Segment::solve_warm_start`].
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
    let (fairlead, reach, steps) = newton(segment, at, last, |[h, v]| ([h, v], hanging(segment, h, v - all)))?;
    let [h, v] = fairlead;
    prove(segment, Regime::Suspended, at, fairlead, [h, v - all], &reach, 0.0, steps).ok()
}

/// A line that lies on the bottom in part: V follows from H.
fn contact(segment: &Segment, at: [f64; 2], friction: f64, last: &EndForces) -> Option<EndForces> {
    let (fairlead, reach, steps) = newton(segment, at, last, |[h, _]| {
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

fn square([h, v]: [f64; 2]) -> f64 {
    h * h + v * v
}

/// Newton on both forces from where the last stiffness puts them. `evaluate` takes forces and returns those it stands
/// for with the reach.
fn newton(
    segment: &Segment,
    [x, z]: [f64; 2],
    last: &EndForces,
    evaluate: impl Fn([f64; 2]) -> ([f64; 2], SpanReach),
) -> Option<([f64; 2], SpanReach, usize)> {
    let [[a, b], [c, d]] = last.stiffness;
    let (dx, dz) = (x - last.at[0], z - last.at[1]);
    let mut forces = damped_step(last.fairlead, [a * dx + b * dz, c * dx + d * dz]);
    let fine = 2.0 * f64::EPSILON * (segment.length + x + z.abs());
    let mut before = f64::INFINITY;
    for step in 1..=MAX_EVALUATIONS {
        let (at, reach) = evaluate(forces);
        let (rx, rz) = (x - reach.x, z - reach.z);
        let change = newton_change(&reach, rx, rz)?;
        let off = rx.abs().max(rz.abs());
        if off <= fine
            || (off <= 64.0 * fine && off >= before)
            || square(change) <= WARM_START_TOLERANCE * WARM_START_TOLERANCE * square(at)
        {
            return (at[0] > 0.0).then_some((at, reach, step));
        }
        before = off;
        forces = damped_step(at, change);
    }
    None
}

/// The forces after a change, which is shortened where it would turn H around.
fn damped_step([h, v]: [f64; 2], [dh, dv]: [f64; 2]) -> [f64; 2] {
    let part = if h + dh < 0.1 * h { -0.9 * h / dh } else { 1.0 };
    [h + part * dh, v + part * dv]
}
