//! The length of the first segment of a line that moves by itself, with which its first end bears a force at rest.

use super::system::SolveError;
use crate::hydro::ambient;
use crate::language::units::Dim;
use crate::model::{ClassError, Condition, Connector, End, Model, Situation};

/// Steps from the present length to one beyond the force, each half as long again as the one before.
const STEPS: usize = 60;
/// Halvings between the two.
const HALVINGS: usize = 60;
/// Share of the force within which it is met. The mesh changes with the length: an element more or less moves the force by less.
const PROOF: f64 = 1e-3;

/// The length (m) with which the force at the first end is as wanted between the ends as they are, in the mean current.
///
/// # Errors
/// A condition that is no force, a line that finds no rest, a force that no length near the present one gives.
pub fn first_length(model: &Model, connector: &Connector, wanted: Condition) -> Result<f64, SolveError> {
    let wrong = SolveError::of(&connector.name);
    let ambient = ambient(model, None).map_err(&wrong)?;
    let (target, level) = match wanted {
        Condition::Tension(force) => (force, false),
        Condition::Horizontal(force) => (force, true),
        _ => return Err(wrong(ClassError::new("its length is solved for a tension or a horizontal force"))),
    };
    let surroundings = model.surroundings();
    let ends = model.end_poses(connector).map(End::still);
    let force = |length: f64| {
        let wound = Connector { first_length: Some(length), ..connector.clone() };
        let element = model.element_in(&wound, Some(&ambient))?;
        let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
        let mut wrenches = Vec::new();
        element.wrenches(&at, &vec![0.0; element.states()], &mut None, &mut wrenches)?;
        let pull = wrenches.first().map_or(0.0, |w| if level { w[0].hypot(w[1]) } else { w.fixed_rows::<3>(0).norm() });
        Ok::<f64, ClassError>(pull)
    };
    let start = model.first_length(connector).unwrap_or(0.0);
    let mut near = (start, force(start).map_err(&wrong)?);
    // a shorter line pulls harder
    let side = if near.1 < target { -1.0 } else { 1.0 };
    let mut step = 1e-3 * start;
    let mut far = near;
    for _ in 0..STEPS {
        let length = near.0 + side * step;
        if length <= 0.0 {
            break;
        }
        far = (length, force(length).map_err(&wrong)?);
        if (far.1 - target) * side <= 0.0 {
            break;
        }
        // the tension of what hangs rises again with its weight: no length beyond gives less
        if side > 0.0 && far.1 > near.1 * 1.001 {
            break;
        }
        near = far;
        step *= 1.5;
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (near.0 + far.0);
        let found = (middle, force(middle).map_err(&wrong)?);
        if (found.1 - target).abs() <= 1e-9 * target || (near.0 - far.0).abs() <= 1e-12 * start {
            near = found;
            break;
        }
        if (found.1 - target) * side > 0.0 { near = found } else { far = found }
    }
    let (length, found) = if (near.1 - target).abs() < (far.1 - target).abs() { near } else { far };
    if (found - target).abs() > PROOF * target {
        let text = "no length of the first segment gives {}; the nearest is {}";
        return Err(wrong(ClassError::of(text, &[(target, Dim::Force), (found, Dim::Force)])));
    }
    Ok(length)
}
