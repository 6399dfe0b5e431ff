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
    /// Its state at the start of a step.
    pub state: RodState,
    /// The numbers `state` was unpacked from, of the mesh that `rod` has; empty where `state` is another.
    started: Vec<f64>,
    /// The numbers that the end of the solver's last trial was packed into, of the mesh that `rod` has; empty where it was not.
    ended: Vec<f64>,
    /// Room for the water at its nodes.
    pub flows: Vec<Flow>,
}

/// Whether two lists are of the same numbers, to the last bit.
fn same_bits(a: &[f64], b: &[f64]) -> bool {
    // a way out at every chunk: inside one they go many at a time
    a.len() == b.len()
        && a.chunks(64)
            .zip(b.chunks(64))
            .all(|(a, b)| a.iter().zip(b).fold(0, |other, (a, b)| other | (a.to_bits() ^ b.to_bits())) == 0)
}

impl RodCache {
    pub fn new(base: &Arc<Base>) -> Self {
        let rod = base.rod.clone();
        let (state, flows) = (RodState::default(), Vec::new());
        let nodes = rod.nodes();
        let (started, ended) = (Vec::new(), Vec::new());
        let solver = solver_of(base, &rod);
        RodCache { base: base.clone(), solver, nodes, rod, rest: None, state, started, ended, flows }
    }

    /// Makes `rod` and `state` those of the numbers of a state where that is known without unpacking them: of another trial of the
    /// same step, or of the step that follows the last trial.
    pub fn has_start(&mut self, committed: &[f64]) -> bool {
        if !self.started.is_empty() && same_bits(&self.started, committed) {
            return true;
        }
        if !self.has_end(committed) {
            return false;
        }
        self.state.copy_from(self.solver.end());
        std::mem::swap(&mut self.started, &mut self.ended);
        true
    }

    /// Whether the solver's last trial ended in the numbers of a state.
    pub fn has_end(&self, state: &[f64]) -> bool {
        !self.ended.is_empty() && same_bits(&self.ended, state)
    }

    /// Keeps the numbers that `state` was unpacked from.
    pub fn keep_start(&mut self, committed: &[f64]) {
        self.started.clear();
        self.started.extend_from_slice(committed);
    }

    /// Keeps the numbers that the end of the solver's trial was packed into.
    pub fn keep_end(&mut self, trial: &[f64]) {
        self.ended.clear();
        self.ended.extend_from_slice(trial);
    }

    /// `state` is no longer that of the start of a step.
    pub fn forget_start(&mut self) {
        self.started.clear();
    }

    /// The solver no longer has the end of a trial.
    pub fn forget_end(&mut self) {
        self.ended.clear();
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

    /// A line of five elements between ends 8 m apart, at rest.
    fn hanging_line(environment: &LineEnvironment) -> (RodCache, Rod, RodState) {
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
        let mut state = RodState::along_points(&rod, &ENDS).unwrap();
        cache.solver.statics(&rod, &mut state, environment, ENDS.map(RodEnd::pin)).unwrap();
        (cache, rod, state)
    }

    const ENDS: [Vector3<f64>; 2] = [Vector3::new(0.0, 0.0, 0.0), Vector3::new(8.0, 0.0, 0.0)];

    #[test]
    fn end_of_trial_is_start_of_next_step_to_the_last_bit() {
        let fluid = UniformFluid::vacuum();
        let environment = LineEnvironment::new(&fluid, 9.81);
        let (mut cache, rod, start) = hanging_line(&environment);
        let ends = [ENDS[0], ENDS[1] + Vector3::new(0.01, 0.0, 0.0)];
        cache.solver.trial(&rod, &start, &environment, 0.1, ends.map(RodEnd::pin)).unwrap();
        let mut numbers = Vec::new();
        cache.solver.end().pack(&mut numbers);
        assert!(!cache.has_start(&numbers));
        cache.keep_end(&numbers);
        assert!(cache.has_end(&numbers) && cache.has_start(&numbers));
        assert_eq!(cache.state, RodState::unpack(&rod, &numbers).unwrap());
        // another trial of that step, and one from a state that differs by the sign of a zero
        assert!(cache.has_start(&numbers) && !cache.has_end(&numbers));
        let zero = numbers.iter().position(|v| *v == 0.0).unwrap();
        numbers[zero] = -numbers[zero];
        assert!(!cache.has_start(&numbers));
        cache.forget_start();
        numbers[zero] = -numbers[zero];
        assert!(!cache.has_start(&numbers));
    }

    #[test]
    fn solver_is_reused_while_winch_changes_lengths_only() {
        let fluid = UniformFluid::vacuum();
        let environment = LineEnvironment::new(&fluid, 9.81);
        let (mut cache, rod, mut state) = hanging_line(&environment);
        cache.rod.set_length(0, 2.5, 0.5).unwrap();
        cache.fit();
        assert!(cache.solver.end_tangent(&rod, &environment).is_some());
        cache.rod.divide(0, &mut state).unwrap();
        cache.fit();
        assert!(cache.solver.end_tangent(&cache.rod, &environment).is_none());
    }
}
