//! Friction of the bottom on a rod at rest.
//!
//! What friction a line at rest has is not a matter of where it is: it depends on how it came there. As the exact
//! catenary does, statics take it that a line that is held on the bottom at one end and leaves it toward the other has
//! been drawn toward that other end (Jonkman, NREL/TP-500-41958, 2007, equations 2-36 to 2-38): every node on the bottom that it moved
//! holds back with the whole of its friction. From the touchdown on the tension falls by mu w per length, down to
//! nothing or to what the anchor holds; where there is no tension the line has not moved, and nothing holds back.
//!
//! On the way to rest the line also resists being shortened: a node that has lost its tension would lose its friction as well, and
//! be drawn away at once. At rest every element of it has a tension; a line that has none without friction has
//! nothing to rub with and is left as it is.

use super::contact::borne;
use super::ends::End;
use super::mesh::Rod;
use super::state::State;
use super::step::Solver;
use super::surroundings::World;
use super::tension::{Stretch, Taken, tension};
use super::trial::{Trial, lay};
use nalgebra::{Matrix3, Vector3};

/// Friction on the node of an element that is toward the end the rod has been drawn to.
pub(super) struct Rub {
    pub node: usize,
    /// The force on it (N), and the most it can be.
    pub force: Vector3<f64>,
    pub whole: f64,
    /// Its derivative by the position of the node itself and of the other of the element (N/m).
    pub by: [Matrix3<f64>; 2],
}

/// Tension that friction leaves, as a share of the whole friction of a node: it holds the nodes in line that nothing
/// else holds.
const LEFT: f64 = 0.01;

/// Share of friction that acts on a node by the tension beyond it, as a share of the node's whole friction, and its
/// slope. So friction takes no more tension than there is.
fn mobilised(tension: f64) -> (f64, f64) {
    let spare = (tension - LEFT).clamp(0.0, 1.0);
    (spare * (2.0 - spare), 2.0 * (1.0 - spare))
}

/// The end a rod has been drawn to: none without friction, or where its ends do not say.
pub(super) fn drawn(rod: &Rod, world: &World, ends: &[End; 2]) -> Option<usize> {
    let (bottom, _) = world.bottom.filter(|(_, ground)| ground.friction_along > 0.0)?;
    let last = rod.elements.len() - 1;
    let lies = |side: usize| {
        let x = ends[side].motion?.position;
        Some(x.z - bottom.height(x.x, x.y).0 < 0.5 * rod.elements[side * last].rest)
    };
    match [lies(0), lies(1)] {
        [Some(true), Some(false)] => Some(1),
        [Some(false), Some(true)] => Some(0),
        _ => None,
    }
}

/// Friction at element `i` of a rod at rest that has been drawn to an end.
pub(super) fn rub(rod: &Rod, world: &World, trial: &Trial, i: usize, side: usize) -> Option<Rub> {
    let (bottom, ground) = world.bottom?;
    let (node, other) = (i + side, i + 1 - side);
    let before = node.checked_sub(1).map_or(0.0, |i| rod.elements[i].contact);
    let area = before + rod.elements.get(node).map_or(0.0, |e| e.contact);
    let borne = borne(bottom, &ground, trial.soft[node], area, &trial.x[node])?;
    let friction = ground.friction_along;
    let whole = friction * borne.force;
    let element = &rod.elements[i];
    let d = trial.x[other] - trial.x[node];
    let length = d.norm().max(1e-9 * element.rest);
    // away from the end it has been drawn to
    let t = d / length;
    let flat = Matrix3::identity() - borne.normal * borne.normal.transpose();
    let level = (flat * t).norm();
    if whole <= 0.0 || level < 1e-3 {
        return None;
    }
    let way = flat * t / level;
    let taken = Taken { compression: element.compression && !trial.loose, ease: trial.ease };
    let height = 0.5 * (trial.x[node].z + trial.x[other].z);
    let stretch = Stretch { strain: length / element.rest - 1.0, rate: 0.0, height };
    let pull = tension(
        rod,
        element,
        taken,
        &stretch,
        trial.memory.get(i),
        [&trial.fluid[i], &trial.fluid[i + 1]],
        world.gravity,
    );
    if pull.value <= 0.0 {
        return None;
    }
    let tension = pull.value / whole;
    let (share, slope) = mobilised(tension);
    let turned = (Matrix3::identity() - way * way.transpose())
        * flat
        * (Matrix3::identity() - t * t.transpose())
        * (whole * share / (level * length));
    let stretched = way * t.transpose() * (slope * pull.by_strain / element.rest);
    let raised = way * Vector3::z().transpose() * (0.5 * slope * pull.by_height);
    let pressed = way * borne.normal.transpose() * (friction * borne.by_depth * (share - tension * slope));
    Some(Rub {
        node,
        force: way * (whole * share),
        whole,
        by: [raised - turned - stretched - pressed, raised + turned + stretched],
    })
}

impl Solver {
    /// Whether a rod that rests without friction has a tension on the bottom that friction would take some of.
    pub(super) fn rubs(&self, rod: &Rod, world: &World, drawn: Option<usize>) -> bool {
        let rubs = |side: usize| {
            (0..rod.elements.len())
                .any(|i| rub(rod, world, &self.trial, i, side).is_some_and(|rub| rub.force != Vector3::zeros()))
        };
        self.trial.drawn.is_none() && drawn.is_some_and(rubs)
    }

    /// Whether a rod that rests with friction does so by an element that pushes, which it cannot.
    pub(super) fn pushes(&self, rod: &Rod) -> bool {
        let pushes = |(i, x): (usize, &[Vector3<f64>])| {
            let element = &rod.elements[i];
            // what rounding and the proof of rest leave
            const NOTHING: f64 = -1e-9;
            !element.compression && (x[1] - x[0]).norm() / element.rest - 1.0 < NOTHING
        };
        self.trial.drawn.is_some() && self.trial.x.windows(2).enumerate().any(pushes)
    }

    /// Has every node of a state at rest stick where friction is what it is at rest.
    pub(super) fn stick(&mut self, rod: &Rod, world: &World, state: &mut State) {
        state.stuck.copy_from_slice(&state.position);
        if let (Some(side), Some((_, ground))) = (self.trial.drawn, world.bottom) {
            for i in 0..rod.elements.len() {
                if let Some(rub) = rub(rod, world, &self.trial, i, side) {
                    state.stuck[rub.node] += rub.force * (ground.friction_travel / rub.whole);
                }
            }
        }
        self.trial.stuck.copy_from_slice(&state.stuck);
        lay(rod, state, world, &mut self.trial.lay);
    }
}
