//! The plane forces of a line behind a link at its first end ([`Extension`]).
//!
//! With p the first end, y the end of the line and F(y) = (H, V) the pull there, p = y + a(T) F / T. Newton on y, with the stiffness K of
//! the line and C = a' t t' + (a / T)(1 - t t') of the link: dp = (1 + C K) dy, and the stiffness of both is K (1 + C K)^-1.

use super::extension::Extension;
use nalgebra::{Matrix2, Vector2};
use windlass_base::dense::inverse;
use windlass_base::pose::Six;
use windlass_catenary::{LineError, LineForces};
use windlass_nonlinear::backtrack;

/// Newton steps.
const MAX_NEWTON_ITERATIONS: usize = 60;
/// Halvings of a step that does not come nearer.
const MAX_STEP_HALVINGS: usize = 40;
/// Residual, as a force over the tension, at which the search ends, and that which is proof enough.
const CONVERGENCE_TOLERANCE: f64 = 1e-13;
const ACCEPTED_RESIDUAL: f64 = 1e-9;

/// The forces of a line on its two ends (N, global axes), by the direction from the first to the other.
pub fn end_wrenches(forces: &LineForces, [ux, uy]: [f64; 2]) -> [Six; 2] {
    let ([h, v], [far_h, far_v]) = (forces.fairlead, forces.anchor);
    let force = |x: f64, y: f64, z: f64| Six::new(x, y, z, 0.0, 0.0, 0.0);
    [force(h * ux, h * uy, -v), force(-far_h * ux, -far_h * uy, far_v)]
}

fn matrix([[a, b], [c, d]]: [[f64; 2]; 2]) -> Matrix2<f64> {
    // a fairlead on the bottom is held there without a slope that has an end
    let own = if a.is_finite() { a } else { 0.0 };
    Matrix2::new(a, b, c, d).map(|v| if v.is_finite() { v } else { own })
}

fn rows(m: &Matrix2<f64>) -> [[f64; 2]; 2] {
    [[m[(0, 0)], m[(0, 1)]], [m[(1, 0)], m[(1, 1)]]]
}

/// A place of the line's end with what is there.
struct TrialPoint {
    at: Vector2<f64>,
    plane: LineForces,
    /// C.
    give: Matrix2<f64>,
    /// p - y - a t.
    rest: Vector2<f64>,
}

impl TrialPoint {
    fn tension(&self) -> f64 {
        Vector2::from(self.plane.fairlead).norm()
    }

    /// What is left, as a force.
    fn unbalance(&self) -> f64 {
        (matrix(self.plane.stiffness) * self.rest).norm()
    }
}

/// The forces with the first end at `from` (distance from the other end, elevation; m), and where the line itself begins. `straight` is
/// the direction from the other end to the first, that of a line without tension; `start` a pull to begin with; `size` a length of the
/// line's order; `line` its forces without the link.
///
/// # Errors
/// No answer of the line, or none that could be proven.
pub fn solve_with_link(
    by: Extension,
    from: [f64; 2],
    straight: [f64; 2],
    start: Option<[f64; 2]>,
    size: f64,
    mut line: impl FnMut(f64, f64) -> Result<LineForces, LineError>,
) -> Result<(LineForces, [f64; 2]), LineError> {
    let position = Vector2::from(from);
    let straight = Vector2::from(straight);
    let link = |pull: [f64; 2]| {
        let pull = Vector2::from(pull);
        let tension = pull.norm();
        let (unit, across) = match pull.try_normalize(0.0) {
            Some(unit) => (unit, by.length(tension) / tension),
            None => (straight, 0.0),
        };
        let axis = unit * unit.transpose();
        (unit * by.length(tension), axis * by.compliance + (Matrix2::identity() - axis) * across)
    };
    let mut at = |mut at: Vector2<f64>| -> Result<TrialPoint, LineError> {
        at.x = at.x.max(0.0);
        let plane = line(at.x, at.y)?;
        let (way, give) = link(plane.fairlead);
        Ok(TrialPoint { at, plane, give, rest: position - at - way })
    };
    let begun = start.map(|pull| at(position - link(pull).0));
    let mut now = match begun {
        Some(Ok(tried)) => tried,
        _ => at(position)?,
    };
    let fine = 4.0 * f64::EPSILON * (size + position.norm());
    for _ in 0..MAX_NEWTON_ITERATIONS {
        if now.rest.norm() <= fine || now.unbalance() <= CONVERGENCE_TOLERANCE * now.tension() {
            break;
        }
        let whole = Matrix2::identity() + now.give * matrix(now.plane.stiffness);
        let step = inverse(whole).map_or(now.rest, |inverse| inverse * now.rest);
        let nearer = backtrack(1.0, MAX_STEP_HALVINGS, |share| {
            let tried = at(now.at + step * share).ok()?;
            (tried.rest.norm() < now.rest.norm()).then_some(tried)
        });
        let Some((_, next)) = nearer else { break };
        now = next;
    }
    let (tension, unbalance) = (now.tension(), now.unbalance());
    if now.rest.norm() > fine
        && !(unbalance <= ACCEPTED_RESIDUAL * tension
            && now.rest.norm() <= ACCEPTED_RESIDUAL * (size + position.norm()))
    {
        return Err(LineError::Unproven { residual: unbalance, tension });
    }
    let (k, give) = (matrix(now.plane.stiffness), now.give);
    let whole = Matrix2::identity() + give * k;
    let inverse = inverse(whole).map_err(|_| LineError::Unproven { residual: f64::NAN, tension })?;
    let plane = LineForces {
        stiffness: rows(&(k * inverse)),
        coupling: rows(&(matrix(now.plane.coupling) * inverse)),
        ..now.plane
    };
    Ok((plane, now.at.into()))
}
