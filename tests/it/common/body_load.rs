//! Steps of a load on a body.

use windlass_hydro::{BodyLoad, BodyStep};

/// The state of a load that begins a first step.
pub fn begin_step(load: &dyn BodyLoad, at: &BodyStep) -> Vec<f64> {
    let mut state = Vec::new();
    if let Some(stateful) = load.as_stateful() {
        state.resize(stateful.states(), 0.0);
        stateful.begin(at, &mut state).unwrap();
    }
    state
}
