//! Accelerations with which a run starts.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::error::RodError;
use super::hinges::end_moment;
use super::mesh::Rod;
use super::newton_iteration::NewtonSystem;
use super::solver::RodEndForces;
use super::state::RodState;
use super::system::Weights;
use super::trial::{StaticFriction, Trial, sample_fluid, set_friction_directions, set_seabed_penetration_scales};
use super::viscoelastic::update_memory;
use nalgebra::Vector3;

/// [`super::RodSolver::start`] in coordinates from the origin of the state.
pub(super) fn find_start_accelerations(
    trial: &mut Trial,
    system: &mut NewtonSystem,
    rod: &Rod,
    state: &mut RodState,
    world: &LineEnvironment,
    ends: [RodEnd; 2],
) -> Result<RodEndForces, RodError> {
    let last = rod.elements.len();
    let known = ends.map(|e| e.motion.is_some());
    trial.time = state.time;
    trial.ends = ends;
    trial.friction = StaticFriction::None;
    trial.stuck_at.copy_from_slice(&state.stuck);
    trial.x.copy_from_slice(&state.position);
    trial.v.copy_from_slice(&state.velocity);
    trial.a.fill(Vector3::zeros());
    for (side, node) in [(0, 0), (1, last)] {
        if let Some(motion) = ends[side].motion {
            trial.a[node] = motion.acceleration;
        }
    }
    trial.director.copy_from_slice(&state.director);
    set_friction_directions(rod, state, world, &mut trial.friction_direction);
    set_seabed_penetration_scales(state, world, &mut trial.seabed_penetration_scale);
    update_memory(rod, state, 0.0, &mut trial.memory);
    sample_fluid(world, state.time, trial);
    system.work.assemble(rod, world, trial, Weights { k: 0.0, c: 0.0, m: 1.0 }, 0..last);
    system.work.store_end_rows();
    system.work.store_end_residuals();
    for (side, node) in [(0, 0), (1, last)] {
        if known[side] {
            system.work.drop_residual(node);
            system.work.fix(node);
        }
    }
    let refuse = |node: usize| RodError::Step {
        rod: rod.name.clone(),
        time: state.time,
        step: 0.0,
        element: node.clamp(1, last),
        why: "it has no acceleration there".to_string(),
    };
    system.work.factor().map_err(refuse)?;
    system.work.newton(&mut system.change);
    let stride = system.work.stride();
    if let Some(node) = system.change.chunks_exact(stride).position(|d| d[..3].iter().any(|c| !c.is_finite())) {
        return Err(refuse(node));
    }
    for (i, d) in system.change.chunks_exact(stride).enumerate() {
        let moved = trial.a[i] + Vector3::new(d[0], d[1], d[2]);
        (state.acceleration[i], state.averaged[i]) = (moved, moved);
    }
    // forces are linear in the accelerations, so one solution has them whole
    system.work.update_end_residuals(&system.change);
    let moment = [0, 1].map(|side| end_moment(rod, state, &ends[side], side));
    Ok(RodEndForces { force: system.work.end_forces(), moment, iterations: 1, parts: 1 })
}
