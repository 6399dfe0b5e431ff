//! Pseudo-transient statics: damped steps in pseudo-time from a trial to equilibrium. See [`RodSolver::statics`](super::RodSolver::statics).
//!
//! The iteration is its own because the pivots of each factorisation decide whether the step is taken, and the rod is softened on the way.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::error::RodError;
use super::mesh::{Rod, RodElement};
use super::newton_iteration::NewtonSystem;
use super::state::RodState;
use super::statics_friction::{NodeFriction, place_laid_nodes_at_trial, seabed_friction};
use super::system::Weights;
use super::tension::{ElementStretch, TensionOptions, find_overstretched, tension};
use super::trial::{
    Softening, StaticFriction, Trial, largest_change, sample_fluid, set_friction_directions,
    set_seabed_penetration_scales, turn_directors,
};
use super::viscoelastic::MaxwellMemory;
use nalgebra::{Matrix3, Vector3};

/// Newton iterations after which one pseudo-step is given up and repeated shorter.
const MAX_INNER_ITERATIONS: usize = 12;
/// Newton iterations after which a tension-only or softened rod gets its full stiffness, at rest or not.
const MAX_SOFTENED_ITERATIONS: usize = 3000;
/// Strain under its own weight that the axial stiffness of a softened rod is scaled to.
const SOFTENED_STRAIN: f64 = 0.01;
/// Factor by which the axial stiffness grows each time the softened rod has come to rest.
const STIFFENING_FACTOR: f64 = 30.0;
/// Longest pseudo-step as a multiple of the first: the inertia terms are then 1e-12 of those of the first pseudo-step, which leaves
/// Newton's iteration on the forces alone.
const MAX_PSEUDO_STEP_RATIO: f64 = 1e6;
/// Shortest pseudo-step as a multiple of the first: a node moves by 1e-18 of its move in the first one, which is below rounding.
const MIN_PSEUDO_STEP_RATIO: f64 = 1e-9;
/// Least acceleration of gravity (m/s2) that pseudo-time is scaled by. It only affects how soon the pseudo-step has the right length,
/// so any number but zero will do.
const MIN_PACING_GRAVITY: f64 = 1.0;
/// Least pseudo-mass of a rod as a share of the mass attached to it.
const MIN_ATTACHED_MASS_SHARE: f64 = 1e-3;
/// Strain of an element below which the start is so short that it would buckle: the rod is then first solved as tension-only.
const MIN_START_STRAIN: f64 = -0.01;
/// Largest residual of a node at rest as a share of the largest force in the rod.
const RESIDUAL_TOLERANCE: f64 = 1e-9;

/// Residual, as a share of the rod's weight, that is accepted where no pseudo-step reduces it further.
const ACCEPTED_RESIDUAL_SHARE: f64 = 1e-7;

/// Stiffness that holds a grounded node about the start of the first pseudo-step, over its friction stiffness.
const CREEP_STIFFNESS_RATIO: f64 = 10.0;

/// Pseudo-transient continuation of a rod in a world: damped steps of a trial toward rest.
pub(super) struct PseudoTransient<'a> {
    pub rod: &'a Rod,
    pub world: &'a LineEnvironment<'a>,
    /// Pseudo-mass of each node (kg).
    pub mass: &'a [f64],
    pub trial: &'a mut Trial,
    pub system: &'a mut NewtonSystem,
    /// Whether the rod stands by its bending stiffness: see [`Rod::is_stiff`].
    pub is_stiff: bool,
    /// Whether a position that any push would make the rod leave counts as rest.
    pub accepts_unstable: bool,
}

impl PseudoTransient<'_> {
    /// The same in another world.
    pub fn in_world<'b>(&'b mut self, world: &'b LineEnvironment<'b>) -> PseudoTransient<'b> {
        PseudoTransient { world, trial: &mut *self.trial, system: &mut *self.system, ..*self }
    }

    /// Takes the state as the trial, at rest with its ends where they are to be.
    pub fn set_trial_at_rest(&mut self, state: &RodState, ends: &[RodEnd; 2]) {
        let (rod, world) = (self.rod, self.world);
        let (last, zero) = (rod.elements.len(), Vector3::zeros());
        self.system.weights = Weights { k: 1.0, c: 0.0, m: 0.0 };
        self.trial.time = state.time;
        self.trial.ends = *ends;
        self.trial.x.copy_from_slice(&state.position);
        self.trial.director.copy_from_slice(&state.director);
        self.trial.v.fill(zero);
        self.trial.a.fill(zero);
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                self.trial.x[node] = motion.position;
            }
        }
        set_friction_directions(rod, state, world, &mut self.trial.friction_direction);
        set_seabed_penetration_scales(state, world, &mut self.trial.seabed_penetration_scale);
        self.trial.laid_at.copy_from_slice(&state.stuck);
        // at rest viscoelastic rope has let go of everything
        self.trial.memory.fill(MaxwellMemory::default());
    }

    /// Pseudo-transient solution from the trial to rest. `done` counts the iterations so far, `most_iterations` bounds them.
    ///
    /// With friction the rod is not softened: the start is near its final shape.
    ///
    /// # Errors
    /// Rest that is not reached within `most_iterations`, or an interruption.
    pub fn solve(&mut self, done: &mut usize, most_iterations: usize) -> Result<(), RodError> {
        let (rod, world) = (self.rod, self.world);
        let last = rod.elements.len();
        let weight = total_weight(rod, world);
        if !self.trial.resists_shortening() && self.trial.friction != StaticFriction::Stick && !self.is_stiff {
            // a start that is much too short would buckle in all its elements at once: it is first solved without compression
            let strains =
                rod.elements.iter().zip(self.trial.x.windows(2)).map(|(e, x)| (x[1] - x[0]).norm() / e.rest - 1.0);
            let tension_only = strains.fold(0.0, f64::min) < MIN_START_STRAIN;
            // and a rod that is stiff for its weight converges more easily when softened
            let stiffness = rod.segments.iter().map(|s| s.axial.evaluate(0.0).1).fold(0.0, f64::max);
            let scale = (weight / (SOFTENED_STRAIN * stiffness)).min(1.0);
            let axial_stiffness_scale = if scale == 0.0 { 1.0 } else { scale };
            self.trial.softening = Softening { tension_only, axial_stiffness_scale };
        }
        let mut from = self.trial.x.clone();
        let mut director = self.trial.director.clone();
        let mut pseudo = first_pseudo_step(rod, world);
        // the longest and shortest pseudo-steps that are worth a try
        let (most, least) = (MAX_PSEUDO_STEP_RATIO * pseudo, MIN_PSEUDO_STEP_RATIO * pseudo);
        let mut longest = most;
        let mut worst = (0, f64::INFINITY);
        while *done < most_iterations && pseudo > least {
            if world.fluid.is_interrupted() {
                self.trial.softening = Softening::NONE;
                return Err(RodError::Interrupted { rod: rod.name.clone() });
            }
            let mut before = f64::INFINITY;
            let mut settled = None;
            for inner in 1..=MAX_INNER_ITERATIONS {
                *done += 1;
                match self.iterate(&from, pseudo) {
                    StepOutcome::Converged | StepOutcome::Unstable if self.trial.softening.is_soft() => {
                        let scale = self.trial.softening.axial_stiffness_scale;
                        let axial_stiffness_scale = (scale * STIFFENING_FACTOR).min(1.0);
                        self.trial.softening = Softening { tension_only: false, axial_stiffness_scale };
                        from.copy_from_slice(&self.trial.x);
                        director.copy_from_slice(&self.trial.director);
                        pseudo = first_pseudo_step(rod, world);
                        break;
                    }
                    StepOutcome::Converged => return Ok(()),
                    StepOutcome::Unstable => {
                        // a small perturbation, the same every time
                        let hair = 1e-6 * rod.length() / last as f64;
                        for (i, x) in self.trial.x.iter_mut().enumerate().skip(1).take(last - 1) {
                            let s = i as f64;
                            *x += Vector3::new((1.3 * s).sin(), (2.1 * s).cos(), (0.7 * s).sin()) * hair;
                        }
                        from.copy_from_slice(&self.trial.x);
                        director.copy_from_slice(&self.trial.director);
                        pseudo = first_pseudo_step(rod, world);
                        break;
                    }
                    StepOutcome::Failed => break,
                    StepOutcome::Moved { share, worst: found } => {
                        worst = found;
                        if share > 0.5 * before && inner > 2 {
                            break;
                        }
                        before = share;
                        if share < 1e-3 {
                            settled = Some(inner);
                            break;
                        }
                    }
                }
            }
            if self.trial.softening.is_soft() && *done > MAX_SOFTENED_ITERATIONS {
                self.trial.softening = Softening::NONE;
                pseudo = first_pseudo_step(rod, world);
            }
            match settled {
                Some(inner) => {
                    place_laid_nodes_at_trial(self.trial, rod, world);
                    from.copy_from_slice(&self.trial.x);
                    director.copy_from_slice(&self.trial.director);
                    longest = (longest * 1.3f64).min(most);
                    pseudo = (pseudo
                        * if inner <= 3 {
                            4.0
                        } else if inner <= 6 {
                            2.0
                        } else {
                            1.0
                        })
                    .min(longest);
                }
                None => {
                    self.trial.x.copy_from_slice(&from);
                    self.trial.director.copy_from_slice(&director);
                    longest = 0.7 * pseudo;
                    pseudo *= 0.4;
                }
            }
        }
        let whole = !self.trial.softening.is_soft();
        self.trial.softening = Softening::NONE;
        if whole && self.largest_residual() <= ACCEPTED_RESIDUAL_SHARE * weight {
            return Ok(());
        }
        if let Some(element) = find_overstretched(rod, &self.trial.x) {
            let why = format!("element {} has a strain beyond the limit of its tension law", element + 1);
            return Err(RodError::Shape { rod: rod.name.clone(), why });
        }
        Err(RodError::Statics {
            rod: rod.name.clone(),
            iterations: *done,
            residual: worst.1,
            element: worst.0.clamp(1, last),
        })
    }

    /// Largest residual (N) of a node at the trial.
    pub fn largest_residual(&mut self) -> f64 {
        let (rod, world) = (self.rod, self.world);
        sample_fluid(world, self.trial.time, self.trial);
        self.trial.fluid.iter_mut().for_each(|fluid| fluid.acceleration = Vector3::zeros());
        self.system.work.forces(rod, world, self.trial);
        self.system.work.largest_residual(self.trial.ends.map(|e| e.motion.is_some())).1
    }

    /// One Newton iteration of a pseudo-step of length `pseudo` (s) that began at `from`.
    pub fn iterate(&mut self, from: &[Vector3<f64>], pseudo: f64) -> StepOutcome {
        let (rod, world) = (self.rod, self.world);
        let last = rod.elements.len();
        let known = self.trial.ends.map(|e| e.motion.is_some());
        sample_fluid(world, self.trial.time, self.trial);
        for fluid in &mut self.trial.fluid {
            fluid.acceleration = Vector3::zeros();
        }
        self.system.work.assemble(rod, world, self.trial, self.system.weights, 0..last);
        self.system.work.store_end_residuals();
        let worst = self.system.work.largest_residual(known);
        if !worst.1.is_finite() {
            return StepOutcome::Failed;
        }
        let rest = worst.1 <= self.residual_tolerance();
        // at rest the tangent is checked with almost no inertia: an instability that grows slower than this is allowed
        let pseudo = if rest { 100.0 * first_pseudo_step(rod, world) } else { pseudo };
        for (node, m) in self.mass.iter().enumerate() {
            let inertia = m / (pseudo * pseudo);
            self.system.work.add_node_inertia(node, inertia, &((self.trial.x[node] - from[node]) * inertia));
        }
        self.add_creep_stiffness(from, first_pseudo_step(rod, world) / pseudo);
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.system.work.drop_residual(node);
                self.system.work.fix(node);
            }
        }
        match (self.system.work.factor(), rest) {
            (Ok(_), true) if self.accepts_unstable => return StepOutcome::Converged,
            (Ok(_), false) if self.accepts_unstable => {}
            (Ok(0), true) => return StepOutcome::Converged,
            (_, true) => return StepOutcome::Unstable,
            (Ok(0), false) => {}
            // with a negative pivot the step would go to a saddle of the energy
            (_, false) => return StepOutcome::Failed,
        }
        self.system.work.newton(&mut self.system.change);
        let (stride, shortest) = (self.system.work.stride(), rod.shortest());
        let size = largest_change(&self.system.change, stride, shortest);
        if size > 2.0 * rod.length() {
            return StepOutcome::Failed;
        }
        turn_directors(&mut self.trial.director, &self.trial.x, &self.system.change, stride, known);
        for i in 0..=last {
            let d = &self.system.change[stride * i..stride * i + 3];
            self.trial.x[i] += Vector3::new(d[0], d[1], d[2]);
        }
        StepOutcome::Moved { share: self.relative_change(size), worst }
    }

    /// Size of the last change relative to what Newton's iteration converges for; `size` is its largest coordinate (m). Relative to the
    /// shortest element; for a stiff rod, which moves far without bending much, the largest change of an element's vector over its length.
    pub fn relative_change(&self, size: f64) -> f64 {
        let rod = self.rod;
        if !self.is_stiff {
            return size / rod.shortest();
        }
        let stride = self.system.work.stride();
        let pairs = self.system.change.chunks_exact(stride).zip(self.system.change.chunks_exact(stride).skip(1));
        let edge = |((a, b), element): ((&[f64], &[f64]), &RodElement)| {
            let square: f64 = a.iter().zip(b).take(3).map(|(a, b)| (b - a) * (b - a)).sum();
            square.sqrt() / element.rest
        };
        let turns = self.system.change.chunks_exact(stride).flat_map(|node| node[3..].iter().map(|turn| turn.abs()));
        pairs.zip(rod.elements.iter()).map(edge).chain(turns).fold(0.0, f64::max)
    }

    /// Convergence tolerance of the residual (N): a share of the largest force in the rod, or the force that rounding of positions makes
    /// through its stiffness.
    fn residual_tolerance(&self) -> f64 {
        let (rod, world) = (self.rod, self.world);
        let weight = total_weight(rod, world);
        let extent = self.trial.x.iter().fold(0.0, |most: f64, x| most.max(x.amax()));
        let mut tolerance = RESIDUAL_TOLERANCE * weight;
        for (i, (element, x)) in rod.elements.iter().zip(self.trial.x.windows(2)).enumerate() {
            tolerance = tolerance.max(RESIDUAL_TOLERANCE * element_tension(rod, world, self.trial, i).abs());
            // a slack element, too, may be made taut by the rounding of a position
            let strain = (x[1] - x[0]).norm() / element.rest - 1.0;
            let slope = rod.segments[element.segment].axial.evaluate(strain).1;
            let stiffness = slope / element.rest + 10.0 * element.bending / element.rest.powi(3);
            tolerance = tolerance.max(32.0 * f64::EPSILON * extent * stiffness);
        }
        tolerance
    }

    /// Holds grounded nodes about the start of a pseudo-step; `hasty` is the length of the first pseudo-step over that of this one.
    ///
    /// A slack grounded line has no other resistance to compression: one pseudo-step from a start that is not quite at rest would fold it.
    /// This stiffness lets it creep; it vanishes as pseudo-steps get longer.
    pub fn add_creep_stiffness(&mut self, from: &[Vector3<f64>], hasty: f64) {
        let (rod, world) = (self.rod, self.world);
        let (StaticFriction::Pulled { end: side, drags: true }, Some((_, ground))) =
            (self.trial.friction, world.bottom)
        else {
            return;
        };
        for i in 0..rod.elements.len() {
            if let Some(NodeFriction { node, whole, normal, .. }) = seabed_friction(rod, world, self.trial, i, side) {
                let flat = Matrix3::identity() - normal * normal.transpose();
                let held = flat * (CREEP_STIFFNESS_RATIO * hasty * whole / ground.friction_travel);
                self.system.work.add_node_stiffness(node, &held, &(held * (self.trial.x[node] - from[node])));
            }
        }
    }
}

/// Tension (N) of an element of the trial, at rest, with what heat and pressure do to it.
pub(super) fn element_tension(rod: &Rod, world: &LineEnvironment, trial: &Trial, i: usize) -> f64 {
    let element = &rod.elements[i];
    let (a, b) = (&trial.x[i], &trial.x[i + 1]);
    let strain = (b - a).norm() / element.rest - 1.0;
    let stretched = ElementStretch { strain, rate: 0.0, height: 0.5 * (a.z + b.z), datum: trial.origin.z };
    let taken = TensionOptions { compression: element.compression, axial_stiffness_scale: 1.0 };
    let fluids = [&trial.fluid[i], &trial.fluid[i + 1]];
    tension(rod, element, taken, &stretched, trial.memory.get(i), fluids, world.gravity).value
}

/// Length of the first pseudo-step (s): the time of a free fall through half a hundredth of the rod's length.
pub(super) fn first_pseudo_step(rod: &Rod, world: &LineEnvironment) -> f64 {
    (0.01 * rod.length() / world.gravity.abs().max(MIN_PACING_GRAVITY)).sqrt()
}

/// Outcome of one Newton iteration of a pseudo-step.
pub(super) enum StepOutcome {
    /// Equilibrium, and stable.
    Converged,
    /// Unstable equilibrium, as of a strut about to buckle.
    Unstable,
    /// No step could be made: the residual is not finite, the tangent not positive definite, or the move too large.
    Failed,
    /// The relative change, and node and value (N) of the largest residual.
    Moved { share: f64, worst: (usize, f64) },
}

/// Weight of a rod in air, with what is attached (N).
pub(super) fn total_weight(rod: &Rod, world: &LineEnvironment) -> f64 {
    let own = rod.elements.iter().map(|e| 2.0 * e.mass).sum::<f64>();
    (own + rod.attachments.iter().map(|a| a.mass).sum::<f64>()) * world.gravity.abs()
}

/// Pseudo-mass of each node (kg). Displaced water is left out: the length of pseudo-steps adapts, and a rope that floats up needs no
/// more of them than one that sinks.
///
/// Where loads or bending forces exceed the weight, pseudo-steps scaled by the rod's own mass are too long. The excess force over g is
/// then added as mass along the length; and the mass is no less than a share of what is attached.
pub(super) fn pseudo_masses(rod: &Rod, world: &LineEnvironment) -> Vec<f64> {
    let given: f64 = world.forces.iter().map(|(_, force)| force.norm()).sum();
    let whole = total_weight(rod, world);
    let attached = rod.attachments.iter().map(|a| a.mass).sum::<f64>() * world.gravity.abs();
    let beyond =
        (given.max(rod.bending_force()) - whole).max(MIN_ATTACHED_MASS_SHARE * attached - (whole - attached)).max(0.0);
    let more = beyond / world.gravity.abs().max(MIN_PACING_GRAVITY) / rod.length();
    let mut mass = vec![0.0; rod.nodes()];
    for (i, element) in rod.elements.iter().enumerate().filter(|_| more > 0.0) {
        mass[i] += 0.5 * more * element.rest;
        mass[i + 1] += 0.5 * more * element.rest;
    }
    for (i, element) in rod.elements.iter().enumerate() {
        mass[i] += element.mass;
        mass[i + 1] += element.mass;
    }
    for a in &rod.attachments {
        mass[a.node] += a.mass;
    }
    mass
}
