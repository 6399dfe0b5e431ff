//! Newton iteration on both end forces of one segment: that of the cold start, which searches along each step, and that of the warm
//! start, which gives up sooner.

use super::line::Segment;
use super::segment::SpanReach;
use windlass_nonlinear::{Convergence, backtrack};

/// Halvings of a step.
const MAX_STEP_HALVINGS: usize = 30;
/// Share of the work along a step that may be left with the opposite sign at its end.
const MAX_OVERSHOOT: f64 = 0.9;
/// Share of the horizontal force that is left where a step would turn it around.
const LEAST_FORCE_SHARE: f64 = 0.1;

/// How the iteration goes.
#[derive(Clone, Copy, Debug)]
pub(super) struct NewtonOptions {
    /// Evaluations after which it gives up.
    pub evaluations: usize,
    /// Change of the forces, as a share of them, at which it ends before the residual is that of rounding.
    pub tolerance: f64,
    /// Whether a step is shortened while it runs past the minimum along its own direction: of a free line the reach is the gradient of
    /// a convex function of the forces.
    pub line_search: bool,
}

/// Finds the forces (H, V) at the fairlead whose reach is `x`, `z`, from `start`. `evaluate` takes forces and returns those it stands for
/// with the reach. With the evaluations it took, a line search counting as one.
pub(super) fn newton(
    segment: &Segment,
    [x, z]: [f64; 2],
    start: [f64; 2],
    options: NewtonOptions,
    evaluate: impl Fn([f64; 2]) -> ([f64; 2], SpanReach),
) -> Option<([f64; 2], SpanReach, usize)> {
    let fine = 2.0 * f64::EPSILON * (segment.length + x + z.abs());
    let mut convergence = Convergence::new(fine);
    let (mut forces, mut reach) = evaluate(start);
    for count in 1..=options.evaluations {
        let (rx, rz) = (x - reach.x, z - reach.z);
        let off = rx.abs().max(rz.abs());
        if convergence.record(off).is_final() {
            return (forces[0] > 0.0).then_some((forces, reach, count));
        }
        let change = newton_change(&reach, rx, rz)?;
        if square(change) <= options.tolerance * options.tolerance * square(forces) {
            return (forces[0] > 0.0).then_some((forces, reach, count));
        }
        let first = step_share(forces, change);
        if !options.line_search {
            (forces, reach) = evaluate(add_share(forces, change, first));
            continue;
        }
        let work = rx * change[0] + rz * change[1];
        let accept = |share: f64| {
            let made = evaluate(add_share(forces, change, share));
            let left = (made.1.x - x) * change[0] + (made.1.z - z) * change[1];
            (left <= MAX_OVERSHOOT * work || convergence.is_near(off)).then_some(made)
        };
        (forces, reach) = backtrack(first, MAX_STEP_HALVINGS, accept)?.1;
    }
    None
}

/// The share of a change that may be made: less than all where it would turn H around.
pub(super) fn step_share([h, _]: [f64; 2], [dh, _]: [f64; 2]) -> f64 {
    if h + dh < LEAST_FORCE_SHARE * h { -(1.0 - LEAST_FORCE_SHARE) * h / dh } else { 1.0 }
}

/// The forces after a share of a change.
pub(super) fn add_share([h, v]: [f64; 2], [dh, dv]: [f64; 2], share: f64) -> [f64; 2] {
    [h + share * dh, v + share * dv]
}

pub(super) fn square([h, v]: [f64; 2]) -> f64 {
    h * h + v * v
}

/// The change of (H, V) that makes the change (x, z).
fn newton_change(reach: &SpanReach, x: f64, z: f64) -> Option<[f64; 2]> {
    let [[a, b], [c, d]] = tangent_stiffness(reach)?;
    Some([a * x + b * z, c * x + d * z])
}

/// The tangent stiffness of a reach.
pub(super) fn tangent_stiffness(r: &SpanReach) -> Option<[[f64; 2]; 2]> {
    // eliminate V first: z_v is the sturdier pivot of a slack line, x_h that of a flat one
    let soft = 1.0 / r.z_v;
    let det = r.x_h - r.x_v * (r.z_h * soft);
    let k = 1.0 / det;
    let kzx = -k * (r.z_h * soft);
    let kxz = -k * (r.x_v * soft);
    let kzz = (1.0 - r.z_h * kxz) * soft;
    (det > 0.0 && [k, kzx, kxz, kzz].iter().all(|v| v.is_finite())).then_some([[k, kxz], [kzx, kzz]])
}
