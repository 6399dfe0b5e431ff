//! One implicit step in time.

use super::condense::EndJacobian;
use super::ends::RodEnd;
use super::environment::{LineEnvironment, UniformFluid};
use super::error::RodError;
use super::hinges::end_moment;
use super::mesh::Rod;
use super::newton_iteration::LineSearch;
use super::scheme::{RodSettings, StepScheme};
use super::state::RodState;
use super::system::Weights;
use super::trial::{
    Softening, StaticFriction, Trial, advance_stick_points, interpolate, resample_fluid, sample_fluid,
    set_friction_directions, set_seabed_penetration_scales, turn_directors,
};
use super::viscoelastic::{MaxwellMemory, set_yielded_strains, update_memory};
use super::warm_start::WarmStart;
use super::workspace::Workspace;
use nalgebra::Vector3;

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

/// Why one attempt failed.
#[derive(Clone, Debug)]
pub(super) struct Failure {
    pub node: usize,
    pub why: &'static str,
}

/// Steps rods. It holds the memory of one rod; nothing is allocated in a step.
#[derive(Clone, Debug)]
pub struct RodSolver {
    pub(super) settings: RodSettings,
    pub(super) work: Workspace,
    pub(super) trial: Trial,
    pub(super) change: Vec<f64>,
    pub(super) line_search: LineSearch,
    /// Where the last trial ended.
    pub(super) next: RodState,
    /// Where the part before it ended, when a step is cut.
    part: RodState,
    /// Whether the current step is made by implicit Euler: see [`super::euler_fallback`].
    pub(super) uses_implicit_euler: bool,
    pub(super) weights: Weights,
    /// See [`RodSolver::has_slid_without_friction`].
    pub(super) slid_without_friction: bool,
    /// Whether the current rod stands by its bending stiffness: see [`Rod::is_stiff`].
    pub(super) is_stiff: bool,
    /// What the solver holds: see [`SolverPhase`].
    pub(super) phase: SolverPhase,
    /// Where the step of the last trial began, and whether it was made in one part.
    pub(super) step_start: RodState,
    pub(super) is_single_part: bool,
    /// Columns of the ends in the current tangent matrix.
    pub(super) end_jacobian: EndJacobian,
    /// Workspace for the parts of a matrix beside its ends, which keeps the current factors.
    pub(super) spare_work: Workspace,
    /// Solutions with the transpose of the matrix.
    pub(super) adjoint: Vec<f64>,
    /// Room for global places.
    pub(super) room: Vec<Vector3<f64>>,
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
            yielded: rod.yielded_strains(&zero),
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
        let work = Workspace::new(rod);
        RodSolver {
            settings,
            change: vec![0.0; work.stride() * nodes],
            line_search: LineSearch::new(work.stride() * nodes),
            spare_work: work.clone(),
            adjoint: vec![0.0; 6 * work.stride() * nodes],
            work,
            trial,
            part: state.clone(),
            uses_implicit_euler: false,
            step_start: state.clone(),
            next: state,
            weights: Weights { k: 1.0, c: 0.0, m: 0.0 },
            slid_without_friction: false,
            is_stiff: false,
            phase: SolverPhase::Idle,
            room: Vec::with_capacity(nodes),
            is_single_part: false,
            end_jacobian: EndJacobian::new(),
        }
    }

    /// Refuses a rod and state other than those it was made for.
    pub(super) fn fits(&self, rod: &Rod, state: &RodState) -> Result<(), RodError> {
        let nodes = rod.nodes();
        let own = [self.trial.x.len(), self.change.len() / self.work.stride()];
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

    /// [`RodSolver::trial`] in coordinates from the origin of the state.
    fn trial_nearby(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        let mut iterations = 0;
        if self.is_same_step(state, time, &ends) {
            match self.step_with_fallback(rod, state, world, time, ends, true) {
                Ok(count) => return Ok(self.end_forces(rod, count, 1)),
                Err(_) => iterations = self.settings.iterations,
            }
        }
        self.phase = SolverPhase::Idle;
        self.step_start.copy_from(state);
        let made = match self.step_with_fallback(rod, state, world, time, ends, false) {
            Ok(count) => Ok(self.end_forces(rod, iterations + count, 1)),
            Err(failure) => self.step_in_parts(rod, state, world, time, ends, failure),
        }?;
        (self.phase, self.is_single_part) = (SolverPhase::Trial, made.parts == 1);
        Ok(made)
    }

    /// Takes the last trial as the new state.
    pub fn accept(&mut self, state: &mut RodState) {
        std::mem::swap(&mut self.next, state);
        self.phase = SolverPhase::Idle;
    }

    /// A trial and its acceptance.
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

    /// The step in parts, each as long as converges.
    fn step_in_parts(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
        mut failure: Failure,
    ) -> Result<RodEndForces, RodError> {
        let whole = time - state.time;
        let (mut level, mut done, mut parts, mut iterations) = (1u32, 0u64, 0usize, self.settings.iterations);
        // positions in the step are counted in the smallest parts, so that the last one ends at `time` exactly
        let all = 1u64 << self.settings.halvings.min(40);
        self.part.copy_from(state);
        while done < all {
            if level > self.settings.halvings {
                return Err(RodError::Step {
                    rod: rod.name.clone(),
                    time,
                    step: whole / all as f64,
                    element: failure.node.clamp(1, rod.elements.len()),
                    why: failure.why.to_string(),
                });
            }
            let to = done + (all >> level);
            let share = to as f64 / all as f64;
            let target = if to == all { time } else { state.time + whole * share };
            let between = [0, 1].map(|side| {
                let node = if side == 0 { 0 } else { rod.elements.len() };
                interpolate(state, node, &ends[side], whole, share)
            });
            let from = std::mem::take(&mut self.part);
            let supports = world.supports_before(time - target);
            let within = LineEnvironment { supports: &supports, ..*world };
            let made = self.step_with_fallback(rod, &from, &within, target, between, false);
            self.part = from;
            match made {
                Ok(count) => {
                    iterations += count;
                    parts += 1;
                    done = to;
                    std::mem::swap(&mut self.part, &mut self.next);
                    // a longer part where it fits the grid of halvings
                    if level > 1 && done.is_multiple_of(all >> (level - 1)) {
                        level -= 1;
                    }
                }
                Err(found) => {
                    iterations += self.settings.iterations;
                    failure = found;
                    level += 1;
                }
            }
        }
        std::mem::swap(&mut self.part, &mut self.next);
        Ok(self.end_forces(rod, iterations, parts))
    }

    /// Newton's iterations of one step, from where the last trial ended if that is `near`: the iterations it took.
    pub(super) fn converge(
        &mut self,
        rod: &Rod,
        from: &RodState,
        world: &LineEnvironment,
        time: f64,
        ends: [RodEnd; 2],
        near: bool,
    ) -> Result<usize, Failure> {
        let h = time - from.time;
        let scheme =
            if self.uses_implicit_euler { StepScheme::euler(h) } else { StepScheme::new(h, &self.settings.scheme) };
        let last = rod.elements.len();
        self.weights = scheme.weights();
        let shortest = rod.shortest();
        let (tolerance, wild) = (self.settings.tolerance * shortest, 10.0 * rod.length());
        let moved = if near { self.predict_from_last_trial(rod, from, world, &scheme, &ends) } else { None };
        self.trial.time = time;
        self.trial.ends = ends;
        match moved {
            None => {
                self.trial.friction = StaticFriction::None;
                self.trial.stuck_at.copy_from_slice(&from.stuck);
                set_friction_directions(rod, from, world, &mut self.trial.friction_direction);
                set_seabed_penetration_scales(from, world, &mut self.trial.seabed_penetration_scale);
                update_memory(rod, from, scheme.h, &mut self.trial.memory);
                self.predict_step(from, &scheme, time, &ends);
            }
            Some(WarmStart::Iterate) => {}
            Some(WarmStart::Converged) => {
                set_yielded_strains(rod, &self.trial.memory, &mut self.next);
                advance_stick_points(world, from, &mut self.next);
                return Ok(0);
            }
        }
        let stride = self.work.stride();
        let known = [ends[0].motion.is_some(), ends[1].motion.is_some()];
        let (mut before, mut last_move) = (f64::INFINITY, f64::INFINITY);
        self.line_search.reset();
        for iteration in 1..=self.settings.iterations {
            std::mem::swap(&mut self.trial.x, &mut self.next.position);
            std::mem::swap(&mut self.trial.v, &mut self.next.velocity);
            std::mem::swap(&mut self.trial.a, &mut self.next.acceleration);
            std::mem::swap(&mut self.trial.director, &mut self.next.director);
            // the factors are those of the trial before where the nodes are, and so is the fluid unless they have left its place
            let close = iteration == 1 && moved.is_some();
            match iteration {
                1 if !close => sample_fluid(world, time, &mut self.trial),
                _ => resample_fluid(world, &mut self.trial, shortest),
            }
            // while the moves shrink fast the factors of the iteration before do as well
            let shrinks = last_move <= 1e-3 * shortest && last_move <= 0.2 * before;
            let fresh = !close && (iteration == 1 || !shrinks);
            let size = self.iterate(rod, world, known, fresh);
            std::mem::swap(&mut self.trial.x, &mut self.next.position);
            std::mem::swap(&mut self.trial.v, &mut self.next.velocity);
            std::mem::swap(&mut self.trial.a, &mut self.next.acceleration);
            std::mem::swap(&mut self.trial.director, &mut self.next.director);
            let size = size?;
            if !(size.is_finite() && size < wild) {
                return Err(Failure { node: self.work.largest_residual(known).0, why: "the iteration runs away" });
            }
            if !fresh && !close && size > last_move {
                // they do no more, as when an element comes to be slack: the move is not made
                before = last_move;
                self.line_search.reset();
                continue;
            }
            self.end_jacobian.moved += size;
            let next = &mut self.next;
            turn_directors(&mut next.director, &next.position, &self.change, stride, known);
            // ends whose motion is given keep it
            let given = [(0, 0), (1, last)].map(|(side, node)| known[side].then(|| (node, next.node_motion(node))));
            next.move_nodes(&self.change, stride);
            scheme.set_motions(from, next);
            given.into_iter().flatten().for_each(|(node, motion)| next.set_node_motion(node, motion));
            // what is still missing if the moves go on shrinking as they do
            let missing = if iteration == 1 { size } else { size * size / (last_move - size).max(0.0) };
            if size.min(missing) <= tolerance {
                if let Some(element) = rod.find_overstretched(&next.position) {
                    return Err(Failure { node: element + 1, why: "it is stretched beyond the most that it bears" });
                }
                set_yielded_strains(rod, &self.trial.memory, next);
                advance_stick_points(world, from, next);
                return Ok(iteration);
            }
            if iteration > 6 && size > last_move {
                return Err(Failure {
                    node: self.work.largest_residual(known).0,
                    why: "the iteration does not settle",
                });
            }
            before = last_move;
            last_move = size;
        }
        Err(Failure { node: self.work.largest_residual(known).0, why: "the iteration does not settle" })
    }

    fn end_forces(&self, rod: &Rod, iterations: usize, parts: usize) -> RodEndForces {
        let moment = [0, 1].map(|side| end_moment(rod, &self.next, &self.trial.ends[side], side));
        RodEndForces { force: self.work.end_forces(), moment, iterations, parts }
    }
}
