//! One segment between two given ends: positions in, end forces and tangent stiffness out.
//!
//! Suspended: (H, V) -> (x, z) is the gradient of a convex function (the complementary energy of the line), so that a
//! damped Newton iteration finds the one answer; nested one-dimensional searches stand behind it. Touching the bottom:
//! with V = 0 at the touchdown, w z = (T - H) + (T2 - H2)/(2 EA) gives T from H in closed form, and one search in H is
//! left. Friction takes `friction` times the weight on the bottom from the tension, down to zero (Coulomb, fully
//! mobilised toward the fairlead) [JONKMAN-2007 2.7.2].

use super::element::{LinePiece, vertical_of_contact};
use super::end_forces::{EndForces, FlatBottom, Regime};
use super::end_forces_newton::{NewtonOptions, newton, tangent_stiffness};
use super::error::LineError;
use super::line::{MAX_MAGNITUDE, Segment};
use super::multi_segment::MultiSegmentLine;
use super::search::{FunctionPoint, rising_root};
use super::segment::{SpanReach, hanging, lifted_reach};

/// Newton's iteration of the cold start; after it the nested search takes over.
const COLD_START: NewtonOptions = NewtonOptions { evaluations: 40, tolerance: 0.0, line_search: true };
/// Largest accepted residual as a share of the tension at the fairlead.
pub(super) const RESIDUAL_TOLERANCE: f64 = 1e-9;

/// See [`Segment::solve_end_forces`].
///
/// # Errors
/// Numbers that are not finite or make no line, a fairlead below the bottom, a line stretched beyond what its force can be found
/// for.
pub fn solve_end_forces(segment: &Segment, x: f64, z: f64, bottom: Option<FlatBottom>) -> Result<EndForces, LineError> {
    check(segment, x, z, bottom)?;
    solve_cold_start(segment, x, z, bottom)
}

/// Refuses what is no line or no place for its end.
pub(super) fn check(segment: &Segment, x: f64, z: f64, bottom: Option<FlatBottom>) -> Result<(), LineError> {
    segment.check(1)?;
    let friction = bottom.map_or(0.0, |b| b.friction);
    for (what, value, good) in [
        ("the horizontal distance", x, (0.0..MAX_MAGNITUDE).contains(&x)),
        ("the rise", z, (segment.weight * z).abs().max(z.abs()) < MAX_MAGNITUDE),
        ("the friction coefficient", friction, friction >= 0.0),
    ] {
        if !(good && value.is_finite()) {
            return Err(LineError::Value { what, segment: 1, value });
        }
    }
    if bottom.is_some() && z < 0.0 {
        return Err(LineError::BelowBottom(-z));
    }
    Ok(())
}

/// The forces without an answer to begin with, for numbers that were checked.
pub(super) fn solve_cold_start(
    segment: &Segment,
    x: f64,
    z: f64,
    bottom: Option<FlatBottom>,
) -> Result<EndForces, LineError> {
    if segment.weight < 0.0 {
        // a buoyant line is a heavy one upside down; arched between ends above the bottom it never touches it
        return solve_suspended(&segment.upside_down(), x, -z).map(EndForces::upside_down);
    }
    if let Some(FlatBottom { friction }) = bottom
        && segment.weight > 0.0
    {
        if z == 0.0 {
            return on_bottom(segment, x, friction);
        }
        if let Some(answer) = touching(segment, x, z, friction)? {
            return Ok(answer);
        }
    }
    solve_suspended(segment, x, z)
}

/// All of the line on the bottom.
fn on_bottom(segment: &Segment, x: f64, friction: f64) -> Result<EndForces, LineError> {
    let Segment { length, weight, ea } = *segment;
    let stretch = x - length;
    let mut answer = EndForces {
        regime: Regime::OnBottomSlack,
        at: [x, 0.0],
        fairlead: [0.0; 2],
        anchor: [0.0; 2],
        grounded: length,
        stiffness: [[0.0, 0.0], [0.0, weight]],
        residual: 0.0,
        iterations: 0,
    };
    if stretch <= 0.0 {
        return Ok(answer);
    }
    let loss = friction * weight * length;
    let partly = (2.0 * friction * weight * ea * stretch).sqrt();
    let (h, slope) = if partly < loss {
        (partly, friction * weight * ea / partly)
    } else {
        (ea * stretch / length + 0.5 * loss, ea / length)
    };
    if !h.is_finite() {
        return Err(LineError::Unproven { residual: f64::NAN, tension: h });
    }
    answer.regime = Regime::OnBottomTaut;
    answer.fairlead[0] = h;
    answer.anchor[0] = (h - loss).max(0.0);
    // the lift of the end: w z = H (sec - 1) + ..., so that V grows as the root of z: no finite stiffness
    answer.stiffness = [[slope, 0.0], [0.0, f64::INFINITY]];
    Ok(answer)
}

/// A line that lies on the bottom in part; `None` when it does not reach down to it with V = 0.
fn touching(segment: &Segment, x: f64, z: f64, friction: f64) -> Result<Option<EndForces>, LineError> {
    let Segment { length, weight, ea } = *segment;
    let free = 2.0 * z / (1.0 + (1.0 + 2.0 * weight * z / ea).sqrt());
    if length - free >= x {
        return Ok(Some(EndForces {
            regime: Regime::FullySlack,
            at: [x, z],
            fairlead: [0.0, weight * free],
            anchor: [0.0; 2],
            grounded: length - free,
            stiffness: [[0.0, 0.0], [0.0, weight / (1.0 + weight * free / ea)]],
            residual: 0.0,
            iterations: 0,
        }));
    }
    if free >= length {
        return Ok(None);
    }
    // contact ends where V = w L: T - H = w z - (w L)2/(2 EA)
    let all = weight * length;
    let change = weight * z - 0.5 * all * (all / ea);
    let most = if change > 0.0 { 0.5 * (all - change) * (all + change) / change } else { f64::INFINITY };
    if most.is_finite() && in_contact(segment, most, z, friction).1.x < x {
        return Ok(None);
    }
    let start = guess(segment, x, z).0.min(most);
    let (h, steps) = rising_root(start, x, |h| {
        let reach = in_contact(segment, h, z, friction).1;
        FunctionPoint { value: reach.x, slope: reach.x_h - reach.x_v * (reach.z_h / reach.z_v) }
    });
    let (high, reach) = in_contact(segment, h, z, friction);
    prove_contact(segment, [x, z], [h, high], &reach, friction, steps).map(Some)
}

/// V at the fairlead of a line that touches down below it under the tension `h`, and its reach.
pub(super) fn in_contact(segment: &Segment, h: f64, z: f64, friction: f64) -> (f64, SpanReach) {
    let high = vertical_of_contact(segment, h, z);
    (high, with_friction(segment, h, high, friction))
}

/// Makes the answer of a line that lies on the bottom in part.
pub(super) fn prove_contact(
    segment: &Segment,
    at: [f64; 2],
    [h, high]: [f64; 2],
    reach: &SpanReach,
    friction: f64,
    steps: usize,
) -> Result<EndForces, LineError> {
    let Segment { length, weight, .. } = *segment;
    let grounded = (length - high / weight).max(0.0);
    let anchor = (h - friction * weight * grounded).max(0.0);
    let regime = match (friction > 0.0 && grounded > 0.0, anchor > 0.0) {
        (false, _) => Regime::Contact,
        (true, true) => Regime::ContactFriction,
        (true, false) => Regime::ContactFrictionAnchorZero,
    };
    prove(segment, regime, at, [h, high], [anchor, 0.0], reach, grounded, steps)
}

/// The reach of a touching line, less the stretch that friction keeps from the grounded part.
fn with_friction(segment: &Segment, h: f64, high: f64, friction: f64) -> SpanReach {
    let (mut reach, ground) = lifted_reach(segment, h, high);
    if friction == 0.0 {
        return reach;
    }
    let Segment { weight, ea, .. } = *segment;
    let loss = friction * weight;
    if loss * ground <= h {
        reach.x -= 0.5 * loss * ground * ground / ea;
        reach.x_v += friction * ground / ea;
    } else {
        reach.x += h * (0.5 * h / loss - ground) / ea;
        reach.x_h += (h / loss - ground) / ea;
        reach.x_v += h / (ea * weight);
    }
    reach
}

/// A line free from end to end; `weight` zero or more.
fn solve_suspended(segment: &Segment, x: f64, z: f64) -> Result<EndForces, LineError> {
    if x == 0.0 {
        return vertical(segment, z);
    }
    let all = segment.weight * segment.length;
    let chord = x.hypot(z);
    if all == 0.0 {
        let tension = segment.ea * (chord - segment.length) / segment.length;
        if tension <= 0.0 {
            return Ok(EndForces::slack([x, z]));
        }
        let (h, v) = (tension * (x / chord), tension * (z / chord));
        let reach = hanging(segment, h, v);
        return prove(segment, Regime::Suspended, [x, z], [h, v], [h, v], &reach, 0.0, 0);
    }
    let (h, v) = guess(segment, x, z);
    if let Some(([h, v], reach, steps)) =
        newton(segment, [x, z], [h, v], COLD_START, |[h, v]| ([h, v], hanging(segment, h, v - all)))
        && let Ok(answer) = prove(segment, Regime::Suspended, [x, z], [h, v], [h, v - all], &reach, 0.0, steps)
    {
        return Ok(answer);
    }
    let elements = vec![LinePiece::Length { segment: *segment, law: None, sees_bottom: false }];
    let chain = MultiSegmentLine { elements, pulls: Vec::new(), least: 0.0 };
    let (h, steps) = rising_root(h, x, |h| match chain.solve_contact(h, z, 0.0, None) {
        Ok(rested) => FunctionPoint { value: rested.x, slope: rested.x_by[0] },
        Err(_) => FunctionPoint { value: f64::NAN, slope: f64::NAN },
    });
    let v = chain.solve_contact(h, z, 0.0, None)?.held.first().map_or(f64::NAN, |held| held.v_hi);
    let reach = hanging(segment, h, v - all);
    prove(segment, Regime::Suspended, [x, z], [h, v], [h, v - all], &reach, 0.0, steps)
}

/// The line straight down and, without a bottom, back up.
fn vertical(segment: &Segment, z: f64) -> Result<EndForces, LineError> {
    let Segment { length, weight, ea } = *segment;
    let all = weight * length;
    // hanging from one end: the other end carries nothing
    let own = length + 0.5 * all * (length / ea);
    if all == 0.0 && z.abs() <= length {
        return Ok(EndForces::slack([0.0, z]));
    }
    let (v, z_v) = if z.abs() >= own {
        let middle = ea * (z.abs() - length) / length * z.signum();
        (middle + 0.5 * all, length / ea)
    } else {
        // (|V1| - |V0|)/w + (V12 - V02)/(2 EA w) with V1 > 0 > V0 = V1 - w L is linear in V1
        let slope = (2.0 / weight) * (1.0 + 0.5 * all / ea);
        (0.5 * all + z / slope, slope)
    };
    let low = v - all;
    // dx/dH at H = 0: the integral of 1/|V| and the stretch; where V changes sign the integral has no bound
    let lateral = if v * low > 0.0 { 1.0 / (length * inverse_mean(v.abs(), low.abs()) + length / ea) } else { 0.0 };
    let answer = EndForces {
        regime: if v * low > 0.0 { Regime::VerticalTaut } else { Regime::Suspended },
        at: [0.0, z],
        fairlead: [0.0, v],
        anchor: [0.0, low],
        grounded: 0.0,
        stiffness: [[lateral, 0.0], [0.0, 1.0 / z_v]],
        residual: 0.0,
        iterations: 0,
    };
    if v.is_finite() && low.is_finite() {
        Ok(answer)
    } else {
        Err(LineError::Unproven { residual: f64::NAN, tension: v })
    }
}

/// The mean of 1/V between two values of one sign: ln(a/b)/(a - b), without a difference of near equals.
fn inverse_mean(a: f64, b: f64) -> f64 {
    let half = (a - b) / (a + b);
    if half.abs() < 1e-5 { 2.0 / (a + b) * (1.0 + half * half / 3.0) } else { (a / b).ln() / (a - b) }
}

/// Forces to begin with: the parabola of a taut line, or the catenary of [JONKMAN-2007 2.7.2] for a slack one.
fn guess(segment: &Segment, x: f64, z: f64) -> (f64, f64) {
    let Segment { length, weight, ea } = *segment;
    let chord = x.hypot(z);
    let all = weight * length;
    if length > 1.1 * chord {
        let lambda = (3.0 * ((length - z) * (length + z) / (x * x) - 1.0)).sqrt();
        let h = 0.5 * weight * x / lambda;
        return (h.max(1e-12 * all), 0.5 * (all + weight * z / lambda.tanh()));
    }
    // T3/EA - e T2 = (w L cos)2/24, e the strain that would do without sag
    let strain = chord / length - 1.0;
    let sag = (all * x / chord) * (all * x / chord) / 24.0;
    let mut t = (sag * ea).cbrt() + (ea * strain).max(0.0);
    for _ in 0..6 {
        let slope = t * (3.0 * t / ea - 2.0 * strain);
        t -= (t * t * (t / ea - strain) - sag) / slope;
    }
    (t * x / chord, t * z / chord + 0.5 * all)
}

/// Makes the answer, if what is left of the distances is small enough: as a force, or below the rounding of the
/// distances themselves.
#[allow(clippy::too_many_arguments)]
pub(super) fn prove(
    segment: &Segment,
    regime: Regime,
    [x, z]: [f64; 2],
    fairlead: [f64; 2],
    anchor: [f64; 2],
    reach: &SpanReach,
    grounded: f64,
    iterations: usize,
) -> Result<EndForces, LineError> {
    let (rx, rz) = (reach.x - x, reach.z - z);
    let tension = fairlead[0].hypot(fairlead[1]);
    let stiffness = tangent_stiffness(reach);
    let residual = stiffness.map_or(f64::NAN, |[[a, b], [c, d]]| (a * rx + b * rz).hypot(c * rx + d * rz));
    let rounding = 4.0 * f64::EPSILON * (segment.length + x + z.abs());
    let proven = residual <= RESIDUAL_TOLERANCE * tension || rx.abs().max(rz.abs()) <= rounding;
    match stiffness {
        Some(stiffness) if proven && fairlead.iter().chain(&anchor).all(|v| v.is_finite()) => {
            Ok(EndForces { regime, at: [x, z], fairlead, anchor, grounded, stiffness, residual, iterations })
        }
        _ => Err(LineError::Unproven { residual, tension }),
    }
}
