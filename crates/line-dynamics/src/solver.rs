//! The solver of a rod: rest, steps in time, modes, and what it is to the holders of its ends and to its supports.
//!
//! It holds the memory of one rod and takes each question to the type that answers it: [`RestSearch`] finds rest by [`PseudoTransient`],
//! `step` makes a step with the [`NewtonSystem`], [`TrialPrediction`](super::warm_start::TrialPrediction) begins a trial from the one
//! before, [`EndCondensation`](super::condense::EndCondensation) condenses the tangent to the ends.

use super::condense::{EndTangent, MAX_REUSE_MOVE};
use super::ends::RodEnd;
use super::environment::{FluidState, LineEnvironment, UniformFluid};
use super::error::RodError;
use super::local_environment::LocalEnvironment;
use super::mesh::Rod;
use super::modes::{RodMode, find_modes};
use super::newton_iteration::NewtonSystem;
use super::pseudo_transient::{PseudoTransient, pseudo_masses, total_weight};
use super::scheme::RodSettings;
use super::start_acceleration::find_start_accelerations;
use super::state::RodState;
use super::statics::RestSearch;
use super::supports::{SupportTangent, condense_to_supports};
use super::trial::{Softening, StaticFriction, Trial};
use super::viscoelastic::{MaxwellMemory, yielded_strains};
use super::workspace::Workspace;
use nalgebra::{Matrix3, Vector3};

/// What a step came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RodEndForces {
    /// Force on each holder from the rod (N, global): end A, end B. For a free end what is left of the residual.
    pub force: [Vector3<f64>; 2],
    /// Moment on each holder from the rod about the end (N m).
    pub moment: [Vector3<f64>; 2],
    /// Newton iterations, all parts of a cut step together.
    pub iterations: usize,
    /// Parts the step was made in: 1 if it was not cut.
    pub parts: usize,
}

/// Solves one rod: rest, steps in time, modes. It holds its memory; nothing is allocated in a step.
#[derive(Clone, Debug)]
pub struct RodSolver {
    pub(super) settings: RodSettings,
    pub(super) system: NewtonSystem,
    pub(super) trial: Trial,
    /// Where the last trial ended.
    pub(super) next: RodState,
    /// Where the part before it ended, when a step is cut.
    pub(super) part: RodState,
    /// Whether the current step is made by implicit Euler: see [`super::euler_fallback`].
    pub(super) uses_implicit_euler: bool,
    /// See [`RodSolver::has_slid_without_friction`].
    slid_without_friction: bool,
    /// What the solver holds: see [`SolverPhase`].
    pub(super) phase: SolverPhase,
    /// Where the step of the last trial began, and whether it was made in one part.
    pub(super) step_start: RodState,
    pub(super) is_single_part: bool,
    /// Room for global places.
    room: Vec<Vector3<f64>>,
}

/// What the solver's trial is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SolverPhase {
    /// No valid result.
    Idle,
    /// A trial that has not been accepted.
    Trial,
    /// A position of rest.
    Rest,
}

impl RodSolver {
    /// Memory for a rod.
    pub fn new(rod: &Rod, settings: RodSettings) -> Self {
        let nodes = rod.nodes();
        let zero = vec![Vector3::zeros(); nodes];
        let state = RodState {
            time: 0.0,
            origin: Vector3::zeros(),
            position: zero.clone(),
            velocity: zero.clone(),
            acceleration: zero.clone(),
            averaged: zero.clone(),
            director: if rod.twists() { vec![Vector3::x(); nodes - 1] } else { Vec::new() },
            bedding: vec![0.0; nodes],
            stuck: zero.clone(),
            yielded: yielded_strains(rod, &zero),
        };
        let still = UniformFluid::vacuum().0;
        let trial = Trial {
            time: 0.0,
            origin: Vector3::zeros(),
            x: zero.clone(),
            v: zero.clone(),
            a: zero.clone(),
            fluid: vec![still; nodes],
            sampled_at: zero.clone(),
            friction_direction: zero.clone(),
            stuck_at: zero.clone(),
            laid_at: zero,
            seabed_penetration_scale: vec![0.0; nodes],
            ends: [RodEnd::FREE; 2],
            softening: Softening::NONE,
            exact_friction_tangent: false,
            is_static: false,
            friction: StaticFriction::None,
            director: state.director.clone(),
            memory: vec![MaxwellMemory::default(); state.yielded.len()],
        };
        RodSolver {
            settings,
            system: NewtonSystem::new(rod),
            trial,
            part: state.clone(),
            uses_implicit_euler: false,
            step_start: state.clone(),
            next: state,
            slid_without_friction: false,
            phase: SolverPhase::Idle,
            room: Vec::with_capacity(nodes),
            is_single_part: false,
        }
    }

    /// Refuses a rod and state other than those it was made for.
    fn fits(&self, rod: &Rod, state: &RodState) -> Result<(), RodError> {
        let nodes = rod.nodes();
        let own = [self.trial.x.len(), self.system.change.len() / self.system.work.stride()];
        let other = [self.trial.director.len(), self.trial.memory.len()] != [state.director.len(), state.yielded.len()];
        if own != [nodes; 2] || other || !state.fits(rod) {
            let why = format!("the state or the solver is not that of this rod of {nodes} nodes");
            return Err(RodError::Shape { rod: rod.name.clone(), why });
        }
        Ok(())
    }

    /// Tries the step from `state` to `time`, at which the ends move as given; the state stays as it is until
    /// [`RodSolver::accept`], so that a body can try again with another motion of an end.
    ///
    /// The second and later trials of a step begin where the one before ended, and cost about one iteration if the ends
    /// have moved little since.
    ///
    /// A step that does not converge is cut in halves, with the ends moving along cubics in between.
    ///
    /// # Errors
    /// [`RodError::Step`] when the shortest step fails as well.
    pub fn trial(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        self.fits(rod, state)?;
        let whole = time - state.time;
        if !(whole > 0.0 && whole.is_finite()) {
            let why = format!("a step from {} s to {time} s goes nowhere", state.time);
            return Err(RodError::Shape { rod: rod.name.clone(), why });
        }
        self.trial.origin = state.origin;
        self.in_local_coordinates(world, |solver, world, near| {
            solver.trial_nearby(rod, state, world, time, near.ends(ends))
        })
    }

    /// Takes the last trial as the new state.
    pub fn accept(&mut self, state: &mut RodState) {
        std::mem::swap(&mut self.next, state);
        self.phase = SolverPhase::Idle;
    }

    /// A trial and its acceptance: one step to a time (s) and the motion of both ends.
    ///
    /// # Errors
    /// As [`RodSolver::trial`]; the state is then as before.
    pub fn step(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        let made = self.trial(rod, state, world, time, ends)?;
        self.accept(state);
        Ok(made)
    }

    /// Moves the state to where it is at rest, from wherever it is: the ends at their motions' positions, all
    /// velocities zero.
    ///
    /// The method is pseudo-transient continuation: steps from rest by implicit Euler, which never gains energy, so forces
    /// balance the mass of the nodes times their move over the square of the pseudo-step. The pseudo-step grows while
    /// Newton's iteration converges easily, and is repeated shorter when it does not. In the end it is so long that
    /// Newton's iteration on the forces alone is left. A state that was at rest and whose ends have moved little is a
    /// warm start: a few Newton iterations with a long pseudo-step.
    ///
    /// With a bottom it also sets how softly a node meets it from then on. Between two nodes a line that lifts off
    /// with tension T and weight w sags by w l^2 / (8 T): the mesh knows its height over the bottom no better than
    /// that. The stiffness of the bottom therefore grows to its full value over no less than this height (at most a
    /// fiftieth of the element), or every node would hit the bottom as a hammer does. It decreases with the square of the
    /// element length.
    ///
    /// # Errors
    /// [`RodError::Statics`] when no equilibrium is reached, [`RodError::Interrupted`], [`RodError::Shape`] for a state of another rod; the
    /// state is then as before.
    pub fn statics(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        self.begin_statics(rod, state, &ends)?;
        let made = self.search_rest(rod, world, ends, |search| search.find_rest(state));
        self.end_statics(made, |_| true)
    }

    /// As [`RodSolver::statics`], for a state that is near rest with friction of the bottom: none where that is not found soon.
    ///
    /// # Errors
    /// As [`RodSolver::statics`].
    pub fn statics_with_friction(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
    ) -> Result<Option<RodEndForces>, RodError> {
        self.begin_statics(rod, state, &ends)?;
        let made = self.search_rest(rod, world, ends, |search| search.find_rest_with_friction(state));
        self.end_statics(made, Option::is_some)
    }

    /// Measures positions from where end A is held.
    fn begin_statics(&mut self, rod: &Rod, state: &mut RodState, ends: &[RodEnd; 2]) -> Result<(), RodError> {
        self.fits(rod, state)?;
        if let Some(motion) = ends[0].motion.filter(|motion| motion.position.iter().all(|c| c.is_finite())) {
            state.move_origin(motion.position);
        }
        self.trial.origin = state.origin;
        self.phase = SolverPhase::Idle;
        self.slid_without_friction = false;
        self.trial.is_static = true;
        Ok(())
    }

    /// A search of rest from the origin of the trial.
    fn search_rest<T>(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
        find: impl FnOnce(&mut RestSearch) -> T,
    ) -> T {
        self.in_local_coordinates(world, |solver, world, near| {
            let pseudo = PseudoTransient {
                rod,
                world,
                mass: &pseudo_masses(rod, world),
                trial: &mut solver.trial,
                system: &mut solver.system,
                is_stiff: rod.is_stiff(total_weight(rod, world)),
                accepts_unstable: solver.settings.unstable,
            };
            let mut search = RestSearch::new(pseudo, near.ends(ends));
            let made = find(&mut search);
            solver.slid_without_friction = search.slid_without_friction;
            made
        })
    }

    fn end_statics<T>(&mut self, made: Result<T, RodError>, rests: impl Fn(&T) -> bool) -> Result<T, RodError> {
        self.trial.is_static = false;
        if made.as_ref().is_ok_and(rests) {
            self.phase = SolverPhase::Rest;
        }
        made
    }

    /// Whether the last position of rest is one without friction, but against sliding down a slope, though the bottom has some: no
    /// rest was found with it.
    pub fn has_slid_without_friction(&self) -> bool {
        self.slid_without_friction
    }

    /// Gives a state where the last trial ended, without taking it as the new state of the solver's own run.
    pub fn copy_end_to(&self, state: &mut RodState) {
        state.copy_from(&self.next);
    }

    /// Where the last trial ended.
    pub fn end(&self) -> &RodState {
        &self.next
    }

    /// The fluid at the nodes by which the last trial ended: where it was sampled they have moved by no more than a thousandth of the
    /// shortest element since.
    pub fn fluid(&self) -> &[FluidState] {
        &self.trial.fluid
    }

    /// What each holder feels of inertia at the instant of the last [`RodSolver::start`]: d(force the holder needs)/d(its
    /// acceleration) (kg), zero of a free end. At one instant the nodes beside an end do not follow it yet.
    pub fn end_masses(&self) -> [Matrix3<f64>; 2] {
        let last = self.system.change.len() - self.system.work.stride();
        [0, 1].map(|side| {
            let mut made = Matrix3::zeros();
            if self.trial.ends[side].motion.is_some() {
                let first = side * last;
                self.system.work.visit_end_rows(side, |i, column, value| {
                    if (first..first + 3).contains(&column) {
                        made[(i, column - first)] = value;
                    }
                });
            }
            made
        })
    }

    /// Gives a state the accelerations that its forces make, as at the start of a run that is not at rest, or after a
    /// line has parted, and returns the forces at that instant on holders with the given accelerations. A state from
    /// [`RodSolver::statics`] has its accelerations.
    ///
    /// # Errors
    /// A force that is no number, a node without mass, or a state of another rod.
    pub fn start(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        self.fits(rod, state)?;
        self.phase = SolverPhase::Idle;
        self.trial.origin = state.origin;
        self.in_local_coordinates(world, |solver, world, near| {
            find_start_accelerations(&mut solver.trial, &mut solver.system, rod, state, world, near.ends(ends))
        })
    }

    /// The `count` slowest modes about a state of rest, with added mass and the stiffness of the bottom.
    ///
    /// Subspace iteration [BATHE-1996 11.6] with the band's factors, so the cost is
    /// linear in the number of elements. The stiffness may be a little unsymmetric where a current turns with the
    /// rod: its symmetric part decides.
    ///
    /// # Errors
    /// A state of another rod, more modes than half the unknowns, an unstable position, or modes that do not settle.
    pub fn modes(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
        count: usize,
    ) -> Result<Vec<RodMode>, RodError> {
        self.fits(rod, state)?;
        self.phase = SolverPhase::Idle;
        self.trial.origin = state.origin;
        self.in_local_coordinates(world, |solver, world, near| {
            find_modes(&mut solver.trial, &mut solver.system.work, rod, state, world, near.ends(ends), count)
        })
    }

    /// The tangent of the end forces at the last [`RodSolver::trial`], before it is accepted, or at rest after
    /// [`RodSolver::statics`], when velocities and accelerations have no part in it: the rod condensed to its ends. Of a
    /// step that was cut it is that of its last part.
    ///
    /// None where there is no trial, or the system cannot be solved, as it could in the trial.
    pub fn end_tangent(&mut self, rod: &Rod, world: &LineEnvironment) -> Option<&EndTangent> {
        self.in_local_coordinates(world, |solver, world, _| solver.linearise(rod, world, true, [true; 2]))?;
        self.system.ends.condense(rod, &self.trial, &self.system.work, [true; 2])
    }

    /// The same by the factors the trial has left, as long as its nodes have moved by less than a thousandth of the
    /// shortest element since, with friction by its secant: for a body's Newton iteration, which converges by it as
    /// well, at a quarter of the cost. The trial's forces stay what they are.
    pub fn end_tangent_from_factors(&mut self, rod: &Rod, world: &LineEnvironment) -> Option<&EndTangent> {
        self.end_tangent_of_sides(rod, world, [true; 2])
    }

    /// The same, of which only the rows and columns of some ends are asked for, A and B: an end in the ground feels nothing and
    /// does not move. The others are zero. That of end A alone costs next to nothing.
    pub fn end_tangent_of_sides(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        sides: [bool; 2],
    ) -> Option<&EndTangent> {
        self.in_local_coordinates(world, |solver, world, _| solver.linearise(rod, world, false, sides))?;
        self.system.ends.condense(rod, &self.trial, &self.system.work, sides)
    }

    /// How what the rod does to its supports follows their motion at the last [`RodSolver::trial`], before it is accepted,
    /// or at rest after [`RodSolver::statics`]: the rod condensed to its supports, each derivative with the other motion
    /// and the start of the step as they are. That the turn of a support changes how fast the rod goes by it is left out.
    ///
    /// None where there is no trial, or the system cannot be solved, as it could in the trial.
    pub fn support_tangent(&mut self, rod: &Rod, world: &LineEnvironment) -> Option<SupportTangent> {
        self.in_local_coordinates(world, |solver, world, _| {
            solver.linearise(rod, world, true, [false; 2])?;
            Some(condense_to_supports(rod, world, &solver.trial, &solver.system))
        })
    }

    /// Sees to factors of the matrix where the last trial ended, or unless `exact` near enough, and to the columns of
    /// the ends that are asked about.
    pub(super) fn linearise(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        exact: bool,
        asked: [bool; 2],
    ) -> Option<()> {
        if self.phase == SolverPhase::Idle {
            return None;
        }
        let at_rest = self.phase == SolverPhase::Rest;
        let close = !exact && !at_rest && self.system.ends.moved <= MAX_REUSE_MOVE * rod.shortest();
        let ready = close && (0..2).all(|side| self.system.ends.ready[side] || !asked[side]);
        // the trial's own positions are at hand in the state that follows it; a rope, which nothing clamps, needs them for a matrix alone
        let asks_nothing = ready && matches!(self.system.work, Workspace::Rope(_));
        if !(at_rest || asks_nothing) {
            self.set_trial_from_next();
        }
        if !ready {
            (self.trial.exact_friction_tangent, self.trial.is_static) = (!close, at_rest);
            let RodSolver { trial, system, .. } = self;
            let made = if close { Some(()) } else { system.factor_tangent(rod, world, trial) };
            if made.is_some() {
                system.ends.find_columns((rod, world), trial, system.weights, at_rest, asked);
            }
            (self.trial.exact_friction_tangent, self.trial.is_static) = (false, false);
            made?;
        }
        Some(())
    }

    /// Takes the end of the last trial as the trial's motion.
    pub(super) fn set_trial_from_next(&mut self) {
        self.trial.x.copy_from_slice(&self.next.position);
        self.trial.v.copy_from_slice(&self.next.velocity);
        self.trial.a.copy_from_slice(&self.next.acceleration);
        self.trial.director.copy_from_slice(&self.next.director);
    }

    /// Acts in a world as it is in coordinates from the origin of the trial.
    fn in_local_coordinates<T>(
        &mut self,
        world: &LineEnvironment,
        act: impl FnOnce(&mut Self, &LineEnvironment, &LocalEnvironment) -> T,
    ) -> T {
        let near = LocalEnvironment::new(world, self.trial.origin, std::mem::take(&mut self.room));
        let made = act(self, &near.world(), &near);
        self.room = near.into_room();
        made
    }
}
