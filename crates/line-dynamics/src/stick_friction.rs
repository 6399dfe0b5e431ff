//! Seabed friction of a rod at rest without a pulled end: one that lies on the bottom from end to end, or leaves it toward both.
//!
//! The direction it has moved in is unknown. It is assumed to have been laid in still water and air without friction forces. Loads that
//! come later, current or wind on the suspended part, act against the full friction of each node about the place where it was laid.

use super::contact::{NormalReaction, normal_reaction};
use super::environment::{FluidField, FluidState, LineEnvironment};
use super::mesh::Rod;
use super::trial::Trial;
use nalgebra::{Matrix3, Vector3};

/// Friction on a node.
pub(super) struct StickFriction {
    /// The force (N), and as a share of the most it can be along the rod and across.
    pub force: Vector3<f64>,
    pub held: Vector3<f64>,
    /// Its derivative by the position (N/m).
    pub by: Matrix3<f64>,
}

/// Friction at a node of a rod at rest about where it was laid: `N mu u / sqrt(1 + u^2)`, with u the way in travels of
/// [`SeabedLaw`](super::SeabedLaw).
pub(super) fn stick_friction(rod: &Rod, world: &LineEnvironment, trial: &Trial, node: usize) -> Option<StickFriction> {
    let (bottom, ground) = world.bottom?;
    let NormalReaction { force: n, normal, by_depth } =
        normal_reaction(bottom, &ground, trial.seabed_penetration_scale[node], rod.contact_area(node), &trial.x[node])?;
    let flat = Matrix3::identity() - normal * normal.transpose();
    let way = (flat * trial.friction_direction[node]).try_normalize(1e-9).unwrap_or_else(Vector3::zeros);
    let along = way * way.transpose();
    let mu = along * ground.friction_along + (flat - along) * ground.friction_across;
    let u = flat * (trial.x[node] - trial.laid_at[node]) / ground.friction_travel;
    let size = 1.0 / u.norm().hypot(1.0);
    let held = u * -size;
    let turned = (flat - held * held.transpose()) * (size / ground.friction_travel);
    let force = mu * held * n;
    Some(StickFriction { force, held, by: mu * turned * -n - mu * held * normal.transpose() * by_depth })
}

/// A fluid and the air over it with zero velocity and acceleration.
pub(super) struct StillFluid<'a>(pub &'a dyn FluidField);

impl FluidField for StillFluid<'_> {
    fn sample(&self, position: &Vector3<f64>, time: f64) -> FluidState {
        let zero = Vector3::zeros();
        FluidState { velocity: zero, acceleration: zero, wind: zero, ..self.0.sample(position, time) }
    }

    fn uniform(&self) -> bool {
        self.0.uniform()
    }

    fn is_interrupted(&self) -> bool {
        self.0.is_interrupted()
    }
}
