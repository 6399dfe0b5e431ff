//! Friction of the bottom on a rod at rest.
//!
//! What friction a line at rest has is not a matter of where it is: it depends on how it came there. As the exact
//! catenary does, statics take it that a line that is held on the bottom at one end and leaves it toward the other has
//! been drawn toward that other end [JONKMAN-2007 eq. 2-36 to 2-38]: every node on the bottom that it moved
//! holds back with the whole of its friction. From the touchdown on the tension falls by mu w per length, down to
//! nothing or to what the anchor holds; where there is no tension the line has not moved, and nothing holds back.
//!
//! Beside that what lies stays where it lies, on a slope and in a current, by as much friction as it takes: along it before it is drawn,
//! across it about where it was laid. Both together are no more than the whole, as under way.
//!
//! On the way to rest the line also resists being shortened: a node that has lost its tension would lose its friction as well, and
//! be drawn away at once. At rest every element of it has a tension. What is longer than that, as a line that piles up straight under
//! its upper end, is limp: no friction against being drawn, and no resistance to being shortened. Where there is a tension all the
//! same that friction should have taken, [`Solver::slid`] tells.

use super::contact::{Borne, borne};
use super::ends::End;
use super::held::hold;
use super::immersed::{Node, on_half};
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
    /// The force on it (N).
    pub force: Vector3<f64>,
    /// The most it can be along or across the rod (N).
    pub whole: f64,
    /// The force as a share of the most it can be along the rod and across.
    pub held: Vector3<f64>,
    /// What friction against being drawn takes of the tension beyond the node, or would of a limp rod (N).
    pub drag: f64,
    /// Normal of the bottom there, and the direction across the rod on it.
    pub normal: Vector3<f64>,
    pub aside: Vector3<f64>,
    /// Its derivative by the position of the node itself and of the other of the element (N/m).
    pub by: [Matrix3<f64>; 2],
}

/// Tension that friction leaves, as a share of what friction a node can bring up against being drawn: it holds the nodes in line that
/// nothing else holds.
pub(super) const LEFT: f64 = 0.01;

/// Share of that friction that acts on a node by the tension beyond it, as a share of the same, and its slope. So
/// friction takes no more tension than there is.
fn mobilised(tension: f64) -> (f64, f64) {
    let spare = (tension - LEFT).clamp(0.0, 1.0);
    if spare > 0.0 { (spare * (2.0 - spare), 2.0 * (1.0 - spare)) } else { (0.0, 0.0) }
}

/// The least share of its friction that a node has against being drawn, where a slope takes all of it.
const SPARE: f64 = 1e-3;

/// The end a rod has been drawn to: none without friction, or where its ends do not say.
pub(super) fn drawn(rod: &Rod, world: &World, ends: &[End; 2]) -> Option<usize> {
    let (bottom, _) = world.bottom.filter(|(_, ground)| ground.rough())?;
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

/// What weight, water and wind do to a node of a rod at rest (N).
fn load(rod: &Rod, world: &World, trial: &Trial, node: usize) -> Vector3<f64> {
    let mut sum = Vector3::zeros();
    for (i, other) in [(node.checked_sub(1), node.wrapping_sub(1)), (Some(node), node + 1)] {
        let Some((i, element)) = i.and_then(|i| Some((i, rod.elements.get(i)?))) else { continue };
        sum.z -= element.mass * world.gravity;
        let Some(t) = (trial.x[i + 1] - trial.x[i]).try_normalize(1e-9 * element.rest) else { continue };
        let at = |node: usize| Node {
            position: &trial.x[node],
            velocity: &trial.v[node],
            acceleration: &trial.a[node],
            fluid: &trial.fluid[node],
        };
        sum += on_half(element, &t, world, [at(node), at(other)]);
    }
    sum
}

/// How steep the bottom is for a node: what pulls it along the bottom over what presses it on it, as a vector along the bottom against
/// that pull. In still water it is the slope.
fn steep(rod: &Rod, world: &World, trial: &Trial, node: usize, normal: &Vector3<f64>) -> Vector3<f64> {
    let fluid = &trial.fluid[node];
    let still = fluid.velocity == Vector3::zeros() && fluid.wind == Vector3::zeros();
    let load = if still { -Vector3::z() } else { load(rod, world, trial, node) };
    let pressed = -load.dot(normal);
    if pressed > 0.0 { -(load + normal * pressed) / pressed } else { Vector3::zeros() }
}

/// Friction at element `i` of a rod at rest that has been drawn to an end.
pub(super) fn rub(rod: &Rod, world: &World, trial: &Trial, i: usize, side: usize) -> Option<Rub> {
    let (bottom, ground) = world.bottom?;
    let (node, other) = (i + side, i + 1 - side);
    let Borne { force: n, normal, by_depth } =
        borne(bottom, &ground, trial.soft[node], rod.bearing(node), &trial.x[node])?;
    let [mu, mu_across] = [ground.friction_along, ground.friction_across];
    let element = &rod.elements[i];
    let d = trial.x[other] - trial.x[node];
    let length = d.norm().max(1e-9 * element.rest);
    // away from the end it has been drawn to
    let t = d / length;
    let flat = Matrix3::identity() - normal * normal.transpose();
    let level = (flat * t).norm();
    if n <= 0.0 || level < 1e-3 {
        return None;
    }
    let way = flat * t / level;
    let aside = normal.cross(&way);
    // how the way turns aside with the other node
    let turns = (Matrix3::identity() - t * t.transpose()) * aside / (level * length);
    let signs = [-1.0, 1.0];
    // across it is held about where it was laid: by a share c, which leaves a share most along it
    let off = trial.x[node] - trial.laid[node];
    let u = if mu_across > 0.0 { off.dot(&aside) / ground.friction_travel } else { 0.0 };
    let most = 1.0 / u.hypot(1.0);
    let (c, cubed) = (-u * most, most.powi(3));
    let du = signs.map(|sign| {
        let own = if sign < 0.0 && mu_across > 0.0 { aside } else { Vector3::zeros() };
        let turned = if mu_across > 0.0 { turns * (sign * -off.dot(&way)) } else { Vector3::zeros() };
        (own + turned) / ground.friction_travel
    });
    // what keeps it from sliding along is there before it is drawn
    let steep = steep(rod, world, trial, node, &normal);
    let wanted = if mu > 0.0 { way.dot(&steep) / mu } else { 0.0 };
    let kept = wanted.clamp(-most, most);
    let spare = (most - kept).max(SPARE);
    let taken = Taken { compression: (element.compression || !trial.limp) && !trial.loose, ease: trial.ease };
    let height = 0.5 * (trial.x[node].z + trial.x[other].z);
    let stretch = Stretch { strain: length / element.rest - 1.0, rate: 0.0, height, datum: trial.origin.z };
    let fluids = [&trial.fluid[i], &trial.fluid[i + 1]];
    let pull = tension(rod, element, taken, &stretch, trial.memory.get(i), fluids, world.gravity);
    let drawn = if mu > 0.0 { pull.value / (spare * mu * n) } else { 0.0 };
    let (share, slope) = if trial.limp { (0.0, 0.0) } else { mobilised(drawn) };
    let a = kept + spare * share;
    let held = way * a + aside * c;
    let force = (way * (mu * a) + aside * (mu_across * c)) * n;
    let by = [0, 1].map(|j| {
        let turned = turns * signs[j];
        let pressed = if j == 0 { normal * -by_depth } else { Vector3::zeros() };
        let by_most = du[j] * (-u * cubed);
        let by_kept =
            if kept == wanted && mu > 0.0 { turned * (aside.dot(&steep) / mu) } else { by_most * wanted.signum() };
        let by_spare = if spare > SPARE { by_most - by_kept } else { Vector3::zeros() };
        let pulled = t * (signs[j] * pull.by_strain / element.rest) + Vector3::z() * (0.5 * pull.by_height);
        let by_drawn = if mu > 0.0 { pulled / (mu * n) - pressed * (drawn * spare / n) } else { Vector3::zeros() };
        let by_a = by_kept + by_spare * (share - drawn * slope) + by_drawn * slope;
        let by_c = du[j] * -cubed;
        force * pressed.transpose() / n
            + (way * by_a.transpose() + aside * turned.transpose() * a) * (mu * n)
            + (aside * by_c.transpose() - way * turned.transpose() * c) * (mu_across * n)
    });
    Some(Rub {
        node,
        force,
        whole: mu.max(mu_across) * n,
        held,
        drag: spare * mu * n * mobilised(drawn).0,
        normal,
        aside,
        by,
    })
}

/// The largest share of friction across by which a node is taken to be held about where it was laid.
const STUCK: f64 = 0.9999;

/// How much stiffer than where it sticks a node on the bottom is held, in the first fall, about where the fall began.
const CREEP: f64 = 10.0;

impl Solver {
    /// Holds nodes on the bottom, at rest by friction, about where a fall began; `hasty` is how much shorter it is than the first.
    ///
    /// What lies slack has nothing else that resists as it is pushed: one fall from a start that is not quite at rest would fold it.
    /// So it creeps, as through mud; the longer the falls, the less that takes.
    pub(super) fn creep(&mut self, rod: &Rod, world: &World, from: &[Vector3<f64>], hasty: f64) {
        let (Some(side), Some((_, ground))) = (self.trial.drawn.filter(|_| !self.trial.limp), world.bottom) else {
            return;
        };
        for i in 0..rod.elements.len() {
            if let Some(Rub { node, whole, normal, .. }) = rub(rod, world, &self.trial, i, side) {
                let flat = Matrix3::identity() - normal * normal.transpose();
                let held = flat * (CREEP * hasty * whole / ground.friction_travel);
                self.work.hold(node, &held, &(held * (self.trial.x[node] - from[node])));
            }
        }
    }

    /// Lays nodes where they are: those on the bottom without the way along the rod that they have gone since they were laid, the others
    /// as they hang.
    pub(super) fn relay(&mut self, rod: &Rod, world: &World) {
        self.lay_nodes(rod, world, |off| off);
    }

    /// Lays nodes where their friction across is what it was in a state with the same way from where they stuck.
    pub(super) fn lay_as_stuck(&mut self, rod: &Rod, world: &World) {
        let Some((_, ground)) = world.bottom else { return };
        self.lay_nodes(rod, world, |off| {
            let share = (off / ground.friction_travel).clamp(-STUCK, STUCK);
            ground.friction_travel * share / (1.0 - share * share).sqrt()
        });
    }

    fn lay_nodes(&mut self, rod: &Rod, world: &World, off: impl Fn(f64) -> f64) {
        let Some(side) = self.trial.drawn else { return };
        let mut laid = self.trial.x.clone();
        for i in 0..rod.elements.len() {
            if let Some(Rub { node, aside, .. }) = rub(rod, world, &self.trial, i, side) {
                laid[node] -= aside * off(aside.dot(&(self.trial.x[node] - self.trial.laid[node])));
            }
        }
        self.trial.laid = laid;
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
            self.trial.laid[at(i)] = place - turn * (was[at(i)] - self.trial.laid[at(i)]);
            x[at(i)] = place;
        }
        carry(&mut self.trial.director, was, x);
    }

    /// What friction against being drawn takes of the tension of a rod at rest in all, or would of a limp one, over the most that a
    /// single node has.
    pub(super) fn drags(&self, rod: &Rod, world: &World) -> f64 {
        let Some(side) = self.trial.drawn else { return 0.0 };
        let all = (0..rod.elements.len()).filter_map(|i| rub(rod, world, &self.trial, i, side));
        let (sum, most) = all.fold((0.0, 0.0f64), |(sum, most), rub| (sum + rub.drag, most.max(rub.whole)));
        if most > 0.0 { sum / most } else { 0.0 }
    }

    /// Least strain of the elements of the trial that bear no compression.
    pub(super) fn slackest(&self, rod: &Rod) -> f64 {
        let soft = rod.elements.iter().zip(self.trial.x.windows(2)).filter(|(element, _)| !element.compression);
        soft.map(|(element, x)| (x[1] - x[0]).norm() / element.rest - 1.0).fold(0.0, f64::min)
    }

    /// Whether a rod that rests with friction does so by an element that pushes, which it cannot.
    pub(super) fn pushes(&self, rod: &Rod) -> bool {
        // what rounding and the proof of rest leave
        const NOTHING: f64 = -1e-9;
        self.trial.stiff() && self.slackest(rod) < NOTHING
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
        if let (true, Some((_, ground))) = (self.trial.held, world.bottom) {
            for node in 0..rod.nodes() {
                if let Some(hold) = hold(rod, world, &self.trial, node) {
                    state.stuck[node] += hold.held * ground.friction_travel;
                }
            }
        }
        self.trial.stuck.copy_from_slice(&state.stuck);
        lay(rod, state, world, &mut self.trial.lay);
    }
}
