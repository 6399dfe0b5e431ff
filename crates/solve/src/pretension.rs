//! The length of the first segment of a dynamic line, with which its first end bears a force at rest.

use super::system::SolveError;
use windlass_base::units::Dim;
use windlass_hydro::ambient;
use windlass_model::{ClassError, Condition, Connector, End, Model, Situation, SolverCache};
use windlass_nonlinear::{BracketedRoot, Halvings};

/// Steps from the present length to one beyond the force, each half as long again as the one before.
const MAX_BRACKETING_STEPS: usize = 60;
/// Steps of the search between the two.
const MAX_SEARCH_STEPS: usize = 60;
/// Share of the force within which it is met. The mesh changes with the length: an element more or less moves the force by less.
const FORCE_TOLERANCE: f64 = 1e-3;
/// Steps in a row in which the force falls by less than that until the search gives up: what is added lies on the bottom. One of them may
/// have a coarser mesh.
const MAX_STALLED_STEPS: usize = 2;
/// Steps shorter than this share of the first segment say nothing of that.
const MIN_INFORMATIVE_STEP: f64 = 0.02;
/// The longest line that is tried, in ways from end to end with a way to the surface and back from each: a heavy line pulls least where
/// it is little longer than that way down.
const MAX_LENGTH_RATIO: f64 = 2.0;

/// The length (m) with which the force at the first end is as wanted between the ends as they are, in the mean current.
///
/// # Errors
/// A condition that is no force, a line that finds no rest, a force that no length near the present one gives.
pub fn first_length(model: &Model, connector: &Connector, wanted: Condition) -> Result<f64, SolveError> {
    let wrong = SolveError::error_about(&connector.name);
    let ambient = ambient(model, None).map_err(&wrong)?;
    let (target, level) = match wanted {
        Condition::Tension(force) => (force, false),
        Condition::Horizontal(force) => (force, true),
        _ => return Err(wrong(ClassError::new("its length is solved for a tension or a horizontal force"))),
    };
    let surroundings = model.surroundings();
    let ends = model.end_poses(connector).map(End::at_rest);
    let force = |length: f64| {
        let wound = Connector { first_length: Some(length), ..connector.clone() };
        let element = model.element_in(&wound, Some(&ambient))?;
        let at = Situation { ends: &ends, step: None, surroundings: &surroundings };
        let mut wrenches = Vec::new();
        element.evaluate_wrenches(&at, &vec![0.0; element.states()], &mut SolverCache::new(), &mut wrenches)?;
        let pull = wrenches.first().map_or(0.0, |w| if level { w[0].hypot(w[1]) } else { w.fixed_rows::<3>(0).norm() });
        Ok::<f64, ClassError>(pull)
    };
    let ask = |length: f64| match model.is_interrupted() {
        true => Err(wrong(ClassError::new("interrupted"))),
        false => force(length).map_err(&wrong),
    };
    let start = model.first_length(connector).unwrap_or(0.0);
    let mut near = (start, ask(start)?);
    // a shorter line pulls harder
    let side = if near.1 < target { -1.0 } else { 1.0 };
    let [from, to] = ends.map(|e| e.pose.origin);
    let longest = MAX_LENGTH_RATIO * ((to - from).norm() + from.z.abs() + to.z.abs()).max(start);
    let mut step = 1e-3 * start;
    let (mut far, mut least, mut stale) = (near, near.1, 0);
    for _ in 0..MAX_BRACKETING_STEPS {
        let length = near.0 + side * step;
        if !(0.0..=longest).contains(&length) || length == 0.0 {
            break;
        }
        far = (length, ask(length)?);
        if (far.1 - target) * side <= 0.0 {
            break;
        }
        // the tension of what hangs rises again with its weight, and does not fall with what lies: no length beyond gives less
        if side > 0.0 && step > MIN_INFORMATIVE_STEP * start {
            stale = if far.1 > least * (1.0 - FORCE_TOLERANCE) { stale + 1 } else { 0 };
            if stale >= MAX_STALLED_STEPS || far.1 > least * (1.0 + FORCE_TOLERANCE) {
                break;
            }
            least = least.min(far.1);
        }
        near = far;
        step *= 1.5;
    }
    let nothing = |found: f64| {
        let text = "no length of the first segment gives {}; the nearest is {}";
        Err(wrong(ClassError::with_values(text, &[(target, Dim::Force), (found, Dim::Force)])))
    };
    if (far.1 - target) * side > 0.0 {
        let (length, found) = if (near.1 - target).abs() < (far.1 - target).abs() { near } else { far };
        return if (found - target).abs() <= FORCE_TOLERANCE * target { Ok(length) } else { nothing(found) };
    }
    // where the mesh changes the force jumps
    let mut search = BracketedRoot::new([near.0, far.0], [near.1 - target, far.1 - target], Halvings::EveryThird);
    for _ in 0..MAX_SEARCH_STEPS {
        let Some(length) = search.propose() else { break };
        let off = ask(length)? - target;
        let closed = search.width() <= 1e-12 * start;
        search.record(length, off);
        if off.abs() <= 1e-9 * target || closed {
            break;
        }
    }
    let (length, off) = search.best();
    if off.abs() > FORCE_TOLERANCE * target {
        return nothing(target + off);
    }
    Ok(length)
}
