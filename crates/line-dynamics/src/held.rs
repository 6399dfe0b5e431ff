//! Friction of the bottom on a rod at rest that has not been drawn to either end: that lies on the bottom from end to end, or leaves it
//! toward both.
//!
//! Nothing says which way it has moved. It is taken to have been laid in still water and air, so that no friction was left in it; what
//! comes later, a current or the wind on what hangs, moves it against the whole of its friction, each node about where it was laid.

use super::contact::{Borne, borne};
use super::mesh::Rod;
use super::surroundings::{Fluid, FluidField, World};
use super::trial::Trial;
use nalgebra::{Matrix3, Vector3};

/// Friction on a node.
pub(super) struct Hold {
    /// The force (N), and as a share of the most it can be along the rod and across.
    pub force: Vector3<f64>,
    pub held: Vector3<f64>,
    /// Its derivative by the position (N/m).
    pub by: Matrix3<f64>,
}

/// Friction at a node of a rod at rest about where it was laid: `N mu u / sqrt(1 + u^2)`, with u the way in travels of
/// [`Ground`](super::Ground).
pub(super) fn hold(rod: &Rod, world: &World, trial: &Trial, node: usize) -> Option<Hold> {
    let (bottom, ground) = world.bottom?;
    let Borne { force: n, normal, by_depth } =
        borne(bottom, &ground, trial.soft[node], rod.bearing(node), &trial.x[node])?;
    let flat = Matrix3::identity() - normal * normal.transpose();
    let way = (flat * trial.lay[node]).try_normalize(1e-9).unwrap_or_else(Vector3::zeros);
    let along = way * way.transpose();
    let mu = along * ground.friction_along + (flat - along) * ground.friction_across;
    let u = flat * (trial.x[node] - trial.laid[node]) / ground.friction_travel;
    let size = 1.0 / u.norm().hypot(1.0);
    let held = u * -size;
    let turned = (flat - held * held.transpose()) * (size / ground.friction_travel);
    let force = mu * held * n;
    Some(Hold { force, held, by: mu * turned * -n - mu * held * normal.transpose() * by_depth })
}

/// A fluid and the air over it without their motion.
pub(super) struct Calm<'a>(pub &'a dyn FluidField);

impl FluidField for Calm<'_> {
    fn at(&self, position: &Vector3<f64>, time: f64) -> Fluid {
        let zero = Vector3::zeros();
        Fluid { velocity: zero, acceleration: zero, wind: zero, ..self.0.at(position, time) }
    }

    fn uniform(&self) -> bool {
        self.0.uniform()
    }

    fn interrupted(&self) -> bool {
        self.0.interrupted()
    }
}
