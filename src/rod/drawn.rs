//! Friction of the bottom on a rod at rest.
//!
//! What friction a line at rest has is not a matter of where it is: it depends on how it came there. As the exact
//! catenary does, statics take it that a line that is held on the bottom at one end and leaves it toward the other has
//! been drawn toward that other end (Jonkman, NREL/TP-500-41958, 2007, equations 2-36 to 2-38): every node on the bottom that it moved
//! holds back with the whole of its friction. From the touchdown on the tension falls by mu w per length, down to
//! nothing or to what the anchor holds; where there is no tension the line has not moved, and nothing holds back. On a slope what
//! lies stays where it lies by as much friction as that takes, along it and across; only the rest is there against being drawn.
//!
//! On the way to rest the line also resists being shortened: a node that has lost its tension would lose its friction as well, and
//! be drawn away at once. At rest every element of it has a tension. Where friction cannot do that, as in a line much longer than from
//! its anchor to straight under its other end, it rests without any.

use super::contact::borne;
use super::ends::End;
use super::mesh::Rod;
use super::state::State;
use super::step::Solver;
use super::surroundings::World;
use super::tension::{Stretch, Taken, tension};
use super::trial::{Trial, carry, lay};
use nalgebra::{Matrix3, Rotation3, Vector3};

/// Friction on the node of an element that is toward the end the rod has been drawn to.
pub(super) struct Rub {
    pub node: usize,
    /// The force on it (N), and the most it can be along the rod.
    pub force: Vector3<f64>,
    pub whole: f64,
    /// The force as a share of the most it can be along the rod and across.
    pub held: Vector3<f64>,
    /// Whether there is a tension that it takes some of.
    pub drawn: bool,
    /// Normal of the bottom there.
    pub normal: Vector3<f64>,
    /// Its derivative by the position of the node itself and of the other of the element (N/m).
    pub by: [Matrix3<f64>; 2],
}

/// Tension that friction leaves, as a share of what friction a node can bring up against being drawn: it holds the nodes in line that
/// nothing else holds.
const LEFT: f64 = 0.01;

/// Share of that friction that acts on a node by the tension beyond it, as a share of the same, and its slope. So
/// friction takes no more tension than there is.
fn mobilised(tension: f64) -> (f64, f64) {
    let spare = (tension - LEFT).clamp(0.0, 1.0);
    if spare > 0.0 { (spare * (2.0 - spare), 2.0 * (1.0 - spare)) } else { (0.0, 0.0) }
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
    let normal = borne.normal;
    let flat = Matrix3::identity() - normal * normal.transpose();
    let level = (flat * t).norm();
    if whole <= 0.0 || level < 1e-3 {
        return None;
    }
    let way = flat * t / level;
    let taken = Taken { compression: !trial.loose, ease: trial.ease };
    let height = 0.5 * (trial.x[node].z + trial.x[other].z);
    let stretch = Stretch { strain: length / element.rest - 1.0, rate: 0.0, height };
    let fluids = [&trial.fluid[i], &trial.fluid[i + 1]];
    let pull = tension(rod, element, taken, &stretch, trial.memory.get(i), fluids, world.gravity);
    // what keeps it from sliding down a slope is there before it is drawn
    let steep = flat.column(2) / normal.z;
    let (along, across) = (way * way.dot(&steep), steep - way * way.dot(&steep));
    let capped = |v: Vector3<f64>, most: f64| v * (most / v.norm().max(most));
    let aside = capped(across, ground.friction_across.max(f64::MIN_POSITIVE));
    let resting = capped(along, friction) + aside;
    let kept = way.dot(&resting);
    let spare = (friction - kept).max(1e-3 * friction);
    let drawn = pull.value / (spare * borne.force);
    let (share, slope) = mobilised(drawn);
    let drag = spare * borne.force * share;
    let by_kept = borne.force * (drawn * slope - share);
    let turning: Matrix3<f64> =
        (Matrix3::identity() - way * way.transpose()) * flat * (Matrix3::identity() - t * t.transpose())
            / (level * length);
    let turned: Matrix3<f64> = turning * drag + way * (resting.transpose() * turning) * by_kept;
    let stretched = way * t.transpose() * (slope * pull.by_strain / element.rest);
    let raised = way * Vector3::z().transpose() * (0.5 * slope * pull.by_height);
    let pressed = (resting + way * (spare * (share - drawn * slope))) * normal.transpose() * borne.by_depth;
    Some(Rub {
        node,
        force: resting * borne.force + way * drag,
        held: way * (kept + spare * share) / friction + aside / ground.friction_across.max(friction * 1e-9),
        whole,
        drawn: share > 0.0,
        normal,
        by: [raised - turned - stretched - pressed, raised + turned + stretched],
    })
}

/// How much stiffer than where it sticks a node on the bottom is held, in the first fall, about where the fall began.
const CREEP: f64 = 10.0;

impl Solver {
    /// Holds nodes on the bottom, at rest by friction, about where a fall began; `hasty` is how much shorter it is than the first.
    ///
    /// What lies slack has nothing else that resists as it is pushed: one fall from a start that is not quite at rest would fold it.
    /// So it creeps, as through mud; the longer the falls, the less that takes.
    pub(super) fn creep(&mut self, rod: &Rod, world: &World, from: &[Vector3<f64>], hasty: f64) {
        let (Some(side), Some((_, ground))) = (self.trial.drawn, world.bottom) else { return };
        for i in 0..rod.elements.len() {
            if let Some(Rub { node, whole, normal, .. }) = rub(rod, world, &self.trial, i, side) {
                let flat = Matrix3::identity() - normal * normal.transpose();
                let held = flat * (CREEP * hasty * whole / ground.friction_travel);
                self.work.hold(node, &held, &(held * (self.trial.x[node] - from[node])));
            }
        }
    }

    /// Takes the nodes along with an end that has moved: the line swings round about the one it is held by.
    pub(super) fn swing(&mut self, rod: &Rod, state: &State, world: &World) {
        let (Some(side), Some((bottom, _))) = (self.trial.drawn, world.bottom) else { return };
        let last = rod.elements.len();
        let (tip, root) = (side * last, (1 - side) * last);
        let (was, x) = (&state.position, &mut self.trial.x);
        if x[tip] == was[tip] && x[root] == was[root] {
            return;
        }
        let (from, to) = (was[tip] - was[root], x[tip] - x[root]);
        let angle = (from.x * to.y - from.y * to.x).atan2(from.x * to.x + from.y * to.y);
        let turn = Rotation3::from_axis_angle(&Vector3::z_axis(), angle);
        let base = x[root];
        let over = |x: &Vector3<f64>| x.z - bottom.height(x.x, x.y).0;
        // from the held end on
        let at = |i: usize| if side == 1 { i } else { last - i };
        let foot = (0..=last).rev().find(|i| over(&was[at(*i)]) < 0.0).unwrap_or(0);
        let rotated = |i: usize| base + turn * (was[at(i)] - was[root]);
        for i in 1..last {
            let mut place = rotated(i);
            if i <= foot {
                place.z += over(&was[at(i)]) - over(&place);
            }
            x[at(i)] = place;
        }
        carry(&mut self.trial.director, was, x);
    }

    /// Whether a rod that rests without friction has a tension on the bottom that friction would take some of.
    pub(super) fn rubs(&self, rod: &Rod, world: &World, drawn: Option<usize>) -> bool {
        let rubs = |side: usize| {
            (0..rod.elements.len()).any(|i| rub(rod, world, &self.trial, i, side).is_some_and(|rub| rub.drawn))
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
                    state.stuck[rub.node] += rub.held * ground.friction_travel;
                }
            }
        }
        self.trial.stuck.copy_from_slice(&state.stuck);
        lay(rod, state, world, &mut self.trial.lay);
    }
}
