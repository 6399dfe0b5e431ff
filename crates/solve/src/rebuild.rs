//! The equilibrium of a model: the system is made, solved, and made anew where a part of it depends on where it came to
//! rest.

use super::equilibrium::{Equilibrium, EquilibriumOptions, equilibrium};
use super::system::{SolveError, System, SystemState};
use windlass_base::geometry::Place;
use windlass_model::{ClassError, Model};

/// Most times a system is made anew.
const MAX_REBUILDS: usize = 12;

/// A model at rest.
#[derive(Debug)]
pub struct EquilibriumResult {
    /// How it was found.
    pub found: Equilibrium,
    /// The system there.
    pub system: System,
    /// Its forces and stiffness there.
    pub state: SystemState,
}

/// Brings the bodies of a model to rest and leaves them there; their `previous` place is the one they came from.
///
/// # Errors
/// As [`equilibrium`]; the model is then where the last solution had it: callers keep a copy.
pub fn find_equilibrium_with_rebuilds(
    model: &mut Model,
    options: &EquilibriumOptions,
) -> Result<EquilibriumResult, SolveError> {
    let start: Vec<Place> = model.bodies.values().map(|b| b.position).collect();
    let made = |model: &Model| {
        let mut system = System::new(model, &[])?;
        // what does not move in this solution is not reported as free either
        for (body, dof) in &options.ignored {
            if let Some(free) = system.nodes.get_mut(*body).and_then(|n| n.free.get_mut(*dof)) {
                *free = false;
            }
        }
        Ok(system)
    };
    let mut system = made(model)?;
    let mut state = system.state(model);
    let mut found = equilibrium(&system, &mut state, options)?;
    system.position(&state, model);
    let mut settled = !system.has_placed_elements();
    for _ in 0..MAX_REBUILDS {
        if !system.has_placed_elements() {
            break;
        }
        system = made(model)?;
        state = system.state(model);
        let again = equilibrium(&system, &mut state, options)?;
        system.position(&state, model);
        let moved = again.search.iterations > 1;
        found.search += again.search;
        found.loose = again.loose;
        settled = !moved;
        if settled {
            break;
        }
    }
    if !settled {
        let text = "the layout of its dynamic lines on the bottom does not settle at the places their ends come to";
        return Err(SolveError::new(ClassError::new(text).help("&EQUI again goes on from the last place")));
    }
    for (body, position) in model.bodies.values_mut().zip(start) {
        body.previous = position;
    }
    Ok(EquilibriumResult { found, system, state })
}
