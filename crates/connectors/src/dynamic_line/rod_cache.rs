//! What a dynamic line is made of, and what its solver keeps for a warm start.

use super::describe::LineDescription;
use super::mesh::Bands;
use super::pipelay_supports::PipeLay;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_line_dynamics::{self as rod, PlaneBottom, Rod, RodSettings, RodSolver, RodState, SeabedLaw};
use windlass_model::{Ambient, Flow, SchemeWeights};

/// How often a rod halves a step of the run by itself, before the run halves its own.
const MAX_STEP_HALVINGS: u32 = 8;

/// The direction in which an end is held, in the axes of what holds it, and the stiffness of that (N m/rad); rigid where none.
pub(super) type EndDirection = (Vector3<f64>, Option<f64>);

/// What does not change while it is wound.
#[derive(Clone, Debug)]
pub(super) struct Base {
    pub description: LineDescription,
    pub rod: Rod,
    pub attached: Vec<rod::Attachment>,
    /// Which segments of the rod are those of each part.
    pub bands: Bands,
    pub ambient: Option<Arc<dyn Ambient>>,
    pub plane: Option<PlaneBottom>,
    /// Elevation of a flat bottom (m), where one is known.
    pub flat: Option<f64>,
    pub ground: SeabedLaw,
    /// Direction in which each end is held, in the axes of what holds it, and the stiffness of that.
    pub holds: [Option<EndDirection>; 2],
    /// Whether the first end is let go.
    pub freed: bool,
    /// The scheme that steps it; that of the engine where none.
    pub scheme: Option<SchemeWeights>,
    /// Which ends can move.
    pub moving_ends: [bool; 2],
    /// What it lies on, of a pipe; its ends are then those of its supports.
    pub laid: Option<PipeLay>,
}

/// What the solver of a dynamic line keeps from one answer to the next.
pub(super) struct RodCache {
    pub base: Arc<Base>,
    pub rod: Rod,
    /// What solves it, as long as [`RodCache::fit`] is asked when the rod has become another.
    pub solver: RodSolver,
    /// Nodes that the solver has memory for.
    nodes: usize,
    /// Where it last hung at rest.
    pub rest: Option<RodState>,
    /// Room for its state on the way, and for the water at its nodes.
    pub state: RodState,
    pub flows: Vec<Flow>,
}

impl RodCache {
    pub fn new(base: &Arc<Base>) -> Self {
        let rod = base.rod.clone();
        let (state, flows) = (RodState::default(), Vec::new());
        let nodes = rod.nodes();
        RodCache { base: base.clone(), solver: solver_of(base, &rod), nodes, rod, rest: None, state, flows }
    }

    /// Gives the rod another solver, if a winch has given it more nodes or fewer: of other lengths alone the solver remembers where it was.
    pub fn fit(&mut self) {
        if self.rod.nodes() != self.nodes {
            self.nodes = self.rod.nodes();
            self.solver = solver_of(&self.base, &self.rod);
        }
    }
}

/// A solver of a rod of a line.
fn solver_of(base: &Base, rod: &Rod) -> RodSolver {
    let usual = RodSettings::default();
    RodSolver::new(
        rod,
        RodSettings { halvings: MAX_STEP_HALVINGS, scheme: base.scheme.unwrap_or(usual.scheme), ..usual },
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::dynamic_line::{Seabed, description};
    use windlass_line_dynamics::{LineEnvironment, RodEnd, RodSegment, UniformFluid};

    #[test]
    fn solver_is_reused_while_winch_changes_lengths_only() {
        let rod = Rod::new("R", vec![RodSegment::line(10.0, 5, 10.0, 1e6, 0.1)], vec![]).unwrap();
        let ground = SeabedLaw::elastic(0.0);
        let base = Base {
            description: description("ROD", vec![], Seabed::default(), [None, None]),
            rod: rod.clone(),
            attached: vec![],
            bands: Bands::default(),
            ambient: None,
            plane: None,
            flat: None,
            ground,
            holds: [None, None],
            freed: false,
            scheme: None,
            moving_ends: [true; 2],
            laid: None,
        };
        let mut cache = RodCache::new(&Arc::new(base));
        let fluid = UniformFluid::vacuum();
        let environment = LineEnvironment::new(&fluid, 9.81);
        let ends = [Vector3::zeros(), Vector3::new(8.0, 0.0, 0.0)];
        let mut state = RodState::along_points(&rod, &ends).unwrap();
        cache.solver.statics(&rod, &mut state, &environment, ends.map(RodEnd::pin)).unwrap();
        cache.rod.set_length(0, 2.5, 0.5).unwrap();
        cache.fit();
        assert!(cache.solver.end_tangent(&rod, &environment).is_some());
        cache.rod.divide(0, &mut state).unwrap();
        cache.fit();
        assert!(cache.solver.end_tangent(&cache.rod, &environment).is_none());
    }
}
