//! What a line that moves by itself is made of, and what its solver remembers.

use super::describe::Description;
use crate::model::{Ambient, Flow};
use crate::rod::{self, Ground, PlaneBottom, Rod, Settings, Solver, State};
use nalgebra::Vector3;
use std::sync::Arc;

/// How often a rod halves a step of the run by itself, before the run halves its own.
const HALVINGS: u32 = 8;

/// The direction in which an end is held, in the axes of what holds it, and the stiffness of that (N m/rad); rigid where none.
pub(super) type Held = (Vector3<f64>, Option<f64>);

/// What does not change while it is wound.
#[derive(Debug)]
pub(super) struct Base {
    pub description: Description,
    pub rod: Rod,
    pub attached: Vec<rod::Attachment>,
    /// Part of each segment of the rod.
    pub part: Vec<usize>,
    pub ambient: Option<Arc<dyn Ambient>>,
    pub plane: Option<PlaneBottom>,
    /// Elevation of a flat bottom (m), where one is known.
    pub flat: Option<f64>,
    pub ground: Ground,
    /// Direction in which each end is held, in the axes of what holds it, and the stiffness of that.
    pub holds: [Option<Held>; 2],
    /// Whether the first end is let go.
    pub freed: bool,
    /// Which ends can move.
    pub felt: [bool; 2],
}

/// What a solver of a line remembers.
pub(super) struct Warm {
    pub base: Arc<Base>,
    pub rod: Rod,
    pub solver: Solver,
    /// Where it last hung at rest.
    pub rest: Option<State>,
    /// Room for its state on the way, and for the water at its nodes.
    pub state: State,
    pub flows: Vec<Flow>,
}

impl Warm {
    pub fn of(base: &Arc<Base>) -> Self {
        let rod = base.rod.clone();
        let (state, flows) = (State::default(), Vec::new());
        Warm { base: base.clone(), solver: solver_of(&rod), rod, rest: None, state, flows }
    }

    /// Becomes that of another rod.
    pub fn take(&mut self, rod: Rod) {
        self.solver = solver_of(&rod);
        self.rod = rod;
    }
}

/// A solver of a rod.
pub(super) fn solver_of(rod: &Rod) -> Solver {
    Solver::new(rod, Settings { halvings: HALVINGS, ..Settings::default() })
}
