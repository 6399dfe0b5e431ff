//! Energy and momentum balance of a run.

use super::bend::hinge;
use super::contact::{self, contact};
use super::environment::LineEnvironment;
use super::hinges::{HingePlace, hinge_sides};
use super::local_environment::LocalEnvironment;
use super::mesh::{Rod, RodElement};
use super::morison::{HalfNode, half_force, wet_prism};
use super::solver::{RodEndForces, RodSolver};
use super::spatial;
use super::state::RodState;
use super::supports::{find_support_contact, support_load};
use super::tension::{ElementStretch, TensionOptions, tension};
use super::trial::Trial;
use super::viscoelastic::{MaxwellMemory, rope_strain};
use nalgebra::Vector3;

/// Energy a rod holds at one time (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Energy {
    /// Of motion.
    pub kinetic: f64,
    /// Of stretch and bending.
    pub elastic: f64,
    /// Of height, in air.
    pub gravity: f64,
    /// In the bottom under it.
    pub bottom: f64,
    /// In what supports it.
    pub supports: f64,
}

impl Energy {
    /// Their sum (J).
    pub fn total(&self) -> f64 {
        self.kinetic + self.elastic + self.gravity + self.bottom + self.supports
    }
}

/// Work done on a rod since the balance was opened (J).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Work {
    /// By the holders of end A and end B, by force and moment.
    pub ends: [f64; 2],
    /// By the water and the air: buoyancy, drag, inertia, slam.
    pub fluid: f64,
    /// By internal damping; negative.
    pub damping: f64,
    /// By damping and friction of the bottom; negative.
    pub bottom: f64,
    /// By damping and motion of its supports.
    pub supports: f64,
    /// By forces given.
    pub given: f64,
}

impl Work {
    /// Their sum (J).
    pub fn total(&self) -> f64 {
        self.ends[0] + self.ends[1] + self.fluid + self.damping + self.bottom + self.supports + self.given
    }

    fn add(&mut self, h: f64, a: &Work, b: &Work) {
        let half = 0.5 * h;
        self.ends[0] += half * (a.ends[0] + b.ends[0]);
        self.ends[1] += half * (a.ends[1] + b.ends[1]);
        self.fluid += half * (a.fluid + b.fluid);
        self.damping += half * (a.damping + b.damping);
        self.bottom += half * (a.bottom + b.bottom);
        self.supports += half * (a.supports + b.supports);
        self.given += half * (a.given + b.given);
    }
}

/// Energy and momentum balance of one rod. Work and impulse are sums of power and force over the steps by the trapezoidal rule, so
/// the imbalance decreases with the square of the step; what is left is the numerical damping of the scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodEnergyBalance {
    pub(super) time: f64,
    pub(super) opened: (f64, Vector3<f64>),
    pub(super) power: Work,
    pub(super) force: Vector3<f64>,
    /// Energy now.
    pub energy: Energy,
    /// Work done so far.
    pub work: Work,
    /// Momentum now (N s).
    pub momentum: Vector3<f64>,
    /// Impulse of all outer forces so far (N s).
    pub impulse: Vector3<f64>,
    /// Largest sum of energy and work so far (J): the scale of the imbalance.
    pub turnover: f64,
}

/// Energy, power, momentum and force of a rod at one time.
#[derive(Default)]
struct BalanceSample {
    energy: Energy,
    power: Work,
    momentum: Vector3<f64>,
    force: Vector3<f64>,
}

impl RodEnergyBalance {
    /// Opens the balance at a state; `made` is the trial or statics that led to it.
    pub fn open(rod: &Rod, state: &RodState, world: &LineEnvironment, solver: &RodSolver, made: &RodEndForces) -> Self {
        let look = sample_balance(rod, state, world, solver, made);
        RodEnergyBalance {
            time: state.time,
            opened: (look.energy.total(), look.momentum),
            power: look.power,
            force: look.force,
            energy: look.energy,
            work: Work::default(),
            momentum: look.momentum,
            impulse: Vector3::zeros(),
            turnover: 0.0,
        }
    }

    /// Enters an accepted step.
    pub fn enter(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        solver: &RodSolver,
        made: &RodEndForces,
    ) {
        let look = sample_balance(rod, state, world, solver, made);
        let h = state.time - self.time;
        self.work.add(h, &self.power, &look.power);
        self.impulse += (self.force + look.force) * (0.5 * h);
        self.time = state.time;
        self.power = look.power;
        self.force = look.force;
        self.energy = look.energy;
        self.momentum = look.momentum;
        let w = &self.work;
        let parts = [
            w.ends[0],
            w.ends[1],
            w.fluid,
            w.damping,
            w.bottom,
            w.supports,
            w.given,
            look.energy.kinetic,
            look.energy.elastic,
        ];
        self.turnover = parts.iter().fold(self.turnover, |most, p| most.max(p.abs()));
    }

    /// Energy gained beyond the work done (J); negative is what the scheme has damped.
    pub fn energy_error(&self) -> f64 {
        self.energy.total() - self.opened.0 - self.work.total()
    }

    /// Momentum gained beyond the impulse (N s).
    pub fn momentum_error(&self) -> Vector3<f64> {
        self.momentum - self.opened.1 - self.impulse
    }
}

/// A rod at the end of a step.
struct StepView<'a> {
    rod: &'a Rod,
    state: &'a RodState,
    world: &'a LineEnvironment<'a>,
    trial: &'a Trial,
}

fn sample_balance(
    rod: &Rod,
    state: &RodState,
    world: &LineEnvironment,
    solver: &RodSolver,
    made: &RodEndForces,
) -> BalanceSample {
    let trial = &solver.trial;
    let near = LocalEnvironment::new(world, state.origin, Vec::new());
    let at = StepView { rod, state, world: &near.world(), trial };
    let mut found = BalanceSample::default();
    for i in 0..rod.elements.len() {
        found.stretch(&at, i);
        found.halves(&at, i);
    }
    found.bending(&at);
    found.attachments(&at);
    found.bottom(&at);
    found.supports(&at);
    let last = rod.elements.len();
    for (node, force) in world.forces.iter().filter(|f| f.0 <= last) {
        found.power.given += force.dot(&state.velocity[*node]);
        found.force += force;
    }
    for (side, node) in [(0, 0), (1, last)] {
        found.power.ends[side] = -made.moment[side].dot(&trial.ends[side].turning);
        if trial.ends[side].motion.is_some() {
            found.power.ends[side] -= made.force[side].dot(&state.velocity[node]);
            found.force -= made.force[side];
        }
    }
    found
}

impl BalanceSample {
    /// A mass at a node.
    fn lump(&mut self, StepView { state, world, .. }: &StepView, node: usize, mass: f64) {
        let (x, v) = (&state.position[node], &state.velocity[node]);
        self.energy.kinetic += 0.5 * mass * v.norm_squared();
        self.energy.gravity += mass * world.gravity * (x.z + state.origin.z);
        self.momentum += v * mass;
        self.force.z -= mass * world.gravity;
    }

    /// What an element's stretch stores and its damper takes.
    fn stretch(&mut self, StepView { rod, state, world, trial }: &StepView, i: usize) {
        let (x, v, element) = (&state.position, &state.velocity, &rod.elements[i]);
        let (t, length) = direction(x, element, i);
        let strain = length / element.rest - 1.0;
        let rate = (t.dot(&(v[i + 1] - v[i])) - length / element.rest * element.rate) / element.rest;
        let height = 0.5 * (x[i].z + x[i + 1].z);
        let taken = TensionOptions { compression: element.compression, axial_stiffness_scale: 1.0 };
        let memory = state.yielded.get(i).map(|yielded| MaxwellMemory::instantaneous(*yielded));
        let pull = |rate| {
            let stretched = ElementStretch { strain, rate, height, datum: state.origin.z };
            let fluids = [&trial.fluid[i], &trial.fluid[i + 1]];
            tension(rod, element, taken, &stretched, memory.as_ref(), fluids, world.gravity).value
        };
        let (whole, rateless) = (pull(rate), pull(0.0));
        let segment = &rod.segments[element.segment];
        let mechanical = strain - segment.tube.as_ref().map_or(0.0, |t| t.expansion * t.warmer);
        let held = mechanical > 0.0 || element.compression;
        let (law, energy) = if let (Some(rope), Some(memory)) = (rod.viscoelastic_law(element), &memory) {
            let pulled = rope_strain(rod, element, rope, [&x[i], &x[i + 1]], memory);
            let (energy, lost) = rope.energy_and_loss(pulled, -memory.kept);
            self.power.damping -= lost * element.rest;
            (rope.slow.evaluate(pulled).0 + rope.maxwell_tension(pulled, memory).0, energy)
        } else if held {
            (segment.axial.evaluate(mechanical).0, segment.axial.energy(mechanical))
        } else {
            (0.0, 0.0)
        };
        self.energy.elastic += energy * element.rest;
        if held || segment.tube.is_some() {
            // what pressure and damping do beside the law's own energy
            self.power.damping -= (whole - rateless) * rate * element.rest;
            self.power.fluid -= (rateless - law) * rate * element.rest;
        }
    }

    /// The masses of the halves of an element, and the water and the wind on them.
    fn halves(&mut self, at: &StepView, i: usize) {
        let StepView { rod, state: RodState { position: x, velocity: v, acceleration: a, .. }, world, trial } = at;
        let element = &rod.elements[i];
        let (t, _) = direction(x, element, i);
        let half = |node: usize| HalfNode {
            position: &x[node],
            velocity: &v[node],
            acceleration: &a[node],
            fluid: &trial.fluid[node],
        };
        for (node, other) in [(i, i + 1), (i + 1, i)] {
            self.lump(at, node, element.mass);
            let force = half_force(element, &t, world, [half(node), half(other)]);
            self.power.fluid += force.dot(&v[node]);
            self.force += force;
        }
    }

    /// What the hinges of elements that bend store, and those of the ends.
    fn bending(&mut self, StepView { rod, state, trial, .. }: &StepView) {
        let (x, last) = (&state.position, rod.elements.len());
        for (i, element) in rod.elements.iter().enumerate().filter(|(_, e)| e.bending > 0.0) {
            if rod.twists() {
                let first = (i == 0).then_some(HingePlace::A);
                let inner = (i > 0).then_some(HingePlace::Inner(i));
                let end = (i + 1 == last).then_some(HingePlace::B);
                for at in [first, inner, end].into_iter().flatten() {
                    if let Some((k, kt, e, f)) = hinge_sides(rod, x, &state.director, &trial.ends, at) {
                        self.energy.elastic += spatial::energy(k, kt, &e, &f);
                    }
                }
                continue;
            }
            let (t, length) = direction(x, element, i);
            if let Some(before) = i.checked_sub(1) {
                let (e, le) = direction(x, &rod.elements[before], before);
                let k = rod.hinge(i);
                self.energy.elastic += 0.5 * k * hinge(k, &e, le, &t, length).angle.powi(2);
            }
            for (side, at) in [(0, 0), (1, last - 1)] {
                if i == at
                    && let Some((k, direction)) = trial.ends[side].hinge(element)
                {
                    self.energy.elastic += 0.5 * k * hinge(k, &direction, 1.0, &t, length).angle.powi(2);
                }
            }
        }
    }

    /// What is attached between elements, with its water.
    fn attachments(&mut self, at: &StepView) {
        let StepView { rod, state: RodState { position: x, velocity: v, acceleration: a, .. }, world, trial } = at;
        for held in &rod.attachments {
            let node = held.node;
            self.lump(at, node, held.mass);
            let fluid = &trial.fluid[node];
            let depth = fluid.surface - x[node].z - held.pendant;
            let share = wet_prism(depth, held.height).0;
            let (u, q) = (v[node] - fluid.velocity, a[node] - fluid.acceleration);
            let water = fluid.density * held.volume;
            let mut force = u * (-0.5 * fluid.density * held.drag * u.norm()) - q * (water * held.added)
                + fluid.acceleration * water;
            force.z += water * world.gravity;
            self.power.fluid += force.dot(&v[node]) * share;
            self.force += force * share;
        }
    }

    /// What the bottom stores, and takes by damping and friction.
    fn bottom(&mut self, StepView { rod, state, world, trial }: &StepView) {
        let Some((bottom, ground)) = &world.bottom else { return };
        for (node, (x, v)) in state.position.iter().zip(&state.velocity).enumerate() {
            let area = rod.contact_area(node);
            let soft = trial.seabed_penetration_scale[node];
            self.energy.bottom += contact::energy(*bottom, ground, soft, area, x);
            let at = |v: &Vector3<f64>| {
                contact(*bottom, ground, soft, area, x, v, &trial.friction_direction[node], &trial.stuck_at[node], true)
            };
            let acts = at(v).map_or_else(Vector3::zeros, |c| c.force[0] + c.force[1]);
            let still = at(&Vector3::zeros()).map_or_else(Vector3::zeros, |c| c.elastic);
            self.power.bottom += (acts - still).dot(v);
            self.force += acts;
        }
    }

    /// What supports store, and do by damping and their own motion.
    fn supports(&mut self, StepView { rod, state, world, .. }: &StepView) {
        let (x, v) = (&state.position, &state.velocity);
        for support in world.supports {
            let Some(over) = find_support_contact(rod.is_smooth(), support, x) else { continue };
            if let Some(made) = support_load(support, &over, v) {
                self.energy.supports += made.energy;
                // the springs give back what they take but for the motion of the support itself
                let power =
                    (made.force - made.elastic).dot(&over.value_at_contact(v)) + made.elastic.dot(&support.velocity);
                self.power.supports -= power;
                self.force -= made.force;
            }
        }
    }
}

/// Direction of an element, and its length (m).
fn direction(x: &[Vector3<f64>], element: &RodElement, i: usize) -> (Vector3<f64>, f64) {
    let d = x[i + 1] - x[i];
    let length = d.norm().max(1e-9 * element.rest);
    (d / length, length)
}
