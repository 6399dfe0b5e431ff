//! Mooring lines that are lost: how long the motion behind the loss lasts, and whether bodies rest without them.

use super::equilibrium::EquilibriumOptions;
use super::frequency::{LinearSystem, natural};
use super::rebuild::find_equilibrium_with_rebuilds;
use super::system::{SolveError, System};
use windlass_model::{ClassError, Environment, Model};

/// Share of what lost lines pull that may be unbalanced where the bodies are to rest without them.
pub const BALANCED_SHARE: f64 = 0.01;

/// The longest natural period (s) of small motions about the equilibrium of a model, with added mass at the period of the mode. Motions
/// that nothing restrains have none.
///
/// # Errors
/// No equilibrium; no motion that is restrained.
pub fn slow_period(model: &Model, options: &EquilibriumOptions) -> Result<f64, SolveError> {
    let mut rested = model.clone();
    find_equilibrium_with_rebuilds(&mut rested, options)?;
    let list = natural(&LinearSystem::new(&rested)?)?;
    let periods = list.iter().filter(|mode| mode.damping.is_some()).filter_map(|mode| mode.mode.period);
    periods.reduce(f64::max).ok_or_else(|| {
        let text = "no motion of the bodies has a natural period: nothing restrains them";
        SolveError::new(ClassError::new(text))
    })
}

/// How much of the pull of lost lines is unbalanced where the bodies stand: 0 at an equilibrium without them, 1 at the one with them.
/// The lines are inactive in the model. The smaller of the shares with the mean forces of the environment and in calm water is given: a
/// run may begin from either.
///
/// # Errors
/// A connector or body that cannot be evaluated.
pub fn unbalanced_share(model: &Model, lost: &[String]) -> Result<f64, SolveError> {
    let mut calm = model.clone();
    calm.environment =
        Environment { sea: None, added_sea: None, wind: None, gusts: None, current: None, ..calm.environment };
    Ok(share(model, lost)?.min(share(&calm, lost)?))
}

fn share(model: &Model, lost: &[String]) -> Result<f64, SolveError> {
    let mut whole = model.clone();
    for connector in whole.connectors.values_mut() {
        connector.active |= lost.iter().any(|name| name.eq_ignore_ascii_case(&connector.name));
    }
    let forces = |model: &Model| -> Result<Vec<f64>, SolveError> {
        let system = System::new(model, &[])?;
        let mut state = system.state(model);
        system.evaluate(&mut state)?;
        let moves = |i: usize| i % 6 < 3 && system.nodes.get(i / 6).is_some_and(|node| node.moves(i % 6));
        Ok(state.residual.iter().enumerate().map(|(i, force)| if moves(i) { *force } else { 0.0 }).collect())
    };
    let (without, with) = (forces(model)?, forces(&whole)?);
    let norm = |squares: f64| squares.sqrt();
    let left = norm(without.iter().map(|force| force * force).sum());
    let pull = norm(without.iter().zip(&with).map(|(a, b)| (a - b).powi(2)).sum());
    Ok(if left > 0.0 && pull > 0.0 { left / pull } else { 0.0 })
}
