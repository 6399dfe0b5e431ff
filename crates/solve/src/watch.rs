//! A watch circle: where a horizontal force from each direction takes a body.

use super::equilibrium::{EquilibriumOptions as Rest, equilibrium};
use super::offset::BodyConnectors;
use super::system::{SolveError, System, SystemState};
use windlass_base::pose::{Pose, Six};
use windlass_model::ConnectorSummary;

/// Most steps of the solution from one direction to the next.
const MAX_STEPS_BETWEEN_DIRECTIONS: usize = 2000;

/// A body under the force from one direction.
#[derive(Clone, Debug, PartialEq)]
pub struct WatchedBody {
    /// Where the force comes from, from +X toward +Y (rad).
    pub direction: f64,
    /// The body at rest under it.
    pub pose: Pose,
    /// What is reported of each of its connectors.
    pub lines: Vec<ConnectorSummary>,
}

/// A body under a force from each of several directions.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Circle {
    /// Names of its connectors.
    pub names: Vec<String>,
    /// One for each direction.
    pub positions: Vec<WatchedBody>,
}

/// A body at rest under a horizontal force (N) at its origin that comes from each of these directions in turn, beside all
/// that acts on it, from where `start` has it. It moves in X, Y and about Z and all else stays, or with `free` all
/// bodies come to rest.
///
/// # Errors
/// A body without connectors; a direction in which it does not come to rest, which is said.
pub fn watch(
    system: &mut System,
    start: &[Pose],
    (body, force, free): (usize, f64, bool),
    directions: &[f64],
) -> Result<Circle, SolveError> {
    let connectors = BodyConnectors::on_body(system, body)?;
    let moves = |b: usize, dof: usize| free || (b == body && [0, 1, 5].contains(&dof));
    let all = (0..system.nodes.len()).flat_map(|b| (0..6).map(move |dof| (b, dof)));
    let ignored = all.filter(|(b, f)| !moves(*b, *f)).collect();
    // from one direction to the next is far for a body that hangs on stiff lines
    let options = Rest { ignored, most: MAX_STEPS_BETWEEN_DIRECTIONS, ..Rest::default() };
    let mut state = SystemState::from_poses(start.to_vec());
    let mut list = Vec::with_capacity(directions.len());
    for direction in directions {
        let wrong = |e: SolveError| {
            let degrees = (direction.to_degrees() * 1e6).round() / 1e6;
            SolveError { error: e.error.help(format!("while the force comes from {degrees} degrees")), ..e }
        };
        let (sin, cos) = direction.sin_cos();
        system.applied = vec![(body, Six::new(-force * cos, -force * sin, 0.0, 0.0, 0.0, 0.0))];
        equilibrium(system, &mut state, &options).map_err(wrong)?;
        let lines = connectors.summaries(system, &state.poses).map_err(wrong)?;
        list.push(WatchedBody { direction: *direction, pose: state.poses[body], lines });
    }
    let names = connectors.names(system).map(str::to_string).collect();
    system.applied.clear();
    Ok(Circle { names, positions: list })
}
