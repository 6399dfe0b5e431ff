//! The position of rest of a rod.

use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::error::RodError;
use super::hinges::end_moment;
use super::mesh::Rod;
use super::pseudo_transient::{pseudo_masses, total_weight};
use super::state::RodState;
use super::statics_friction::{RESIDUAL_TENSION_SHARE, pulled_end};
use super::step::{RodEndForces, RodSolver, SolverPhase};
use super::stick_friction::StillFluid;
use super::system::Weights;
use super::trial::{StaticFriction, sample_fluid, set_friction_directions, set_seabed_penetration_scales};
use super::viscoelastic::MaxwellMemory;
use nalgebra::Vector3;

/// Newton iterations after which statics gives up.
const MAX_ITERATIONS: usize = 20_000;
/// Newton iterations allowed for the solution that has seabed friction from the first pseudo-step on.
const MAX_ITERATIONS_WITH_FRICTION: usize = 400;
/// Newton iterations allowed for the solution whose friction acts against sliding down a slope only.
const MAX_ITERATIONS_WITHOUT_DRAG_FRICTION: usize = 5_000;
/// Strain of an element below which a tension-only rod counts as piled up.
const PILED_UP_STRAIN: f64 = -1e-3;
/// Newton iterations allowed for adding friction to a rod at rest without it.
const MAX_ITERATIONS_FRICTION_ADDED: usize = 1_500;

impl RodSolver {
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
        self.begin_statics(rod, state, world, &ends)?;
        let made = self
            .in_local_coordinates(world, |solver, world, near| solver.find_rest(rod, state, world, near.ends(ends)));
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
        self.begin_statics(rod, state, world, &ends)?;
        let mass = pseudo_masses(rod, world);
        let made = self.in_local_coordinates(world, |solver, world, near| {
            solver.find_rest_with_friction(rod, state, world, near.ends(ends), &mass, &mut 0)
        });
        self.end_statics(made, Option::is_some)
    }

    /// Measures positions from where end A is held.
    fn begin_statics(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: &[RodEnd; 2],
    ) -> Result<(), RodError> {
        self.fits(rod, state)?;
        if let Some(motion) = ends[0].motion.filter(|motion| motion.position.iter().all(|c| c.is_finite())) {
            state.move_origin(motion.position);
        }
        self.trial.origin = state.origin;
        self.is_stiff = rod.is_stiff(total_weight(rod, world));
        self.phase = SolverPhase::Idle;
        self.slid_without_friction = false;
        self.trial.is_static = true;
        Ok(())
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

    /// Pseudo-transient solutions: with friction from the start, which leaves slack parts where they lie; or, from a start that is far
    /// from rest, first without friction.
    fn find_rest(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        let (mass, mut done) = (pseudo_masses(rod, world), 0);
        if let Some(made) = self.find_rest_with_friction(rod, state, world, ends, &mass, &mut done)? {
            return Ok(made);
        }
        if self.is_stiff
            && let Some(done) = self.rest_by_continuation(rod, state, world, &ends, &mass)?
        {
            return Ok(self.accept_rest(rod, state, world, &ends, done));
        }
        let drawn = pulled_end(rod, world, &ends);
        if drawn.is_none()
            && let Some(made) = self.find_rest_stick_friction(rod, state, world, ends, &mass, &mut done)?
        {
            return Ok(made);
        }
        // without drag friction it settles freely; but it does not slide down a slope
        self.set_trial_at_rest(rod, state, world, &ends);
        self.trial.friction = StaticFriction::pulled(drawn, false);
        let most = if drawn.is_some() { done + MAX_ITERATIONS_WITHOUT_DRAG_FRICTION } else { MAX_ITERATIONS };
        match self.solve_pseudo_transient(rod, world, &mass, &mut done, most) {
            Err(RodError::Statics { .. }) if drawn.is_some() => {
                self.set_trial_at_rest(rod, state, world, &ends);
                self.trial.friction = StaticFriction::None;
                self.solve_pseudo_transient(rod, world, &mass, &mut done, MAX_ITERATIONS)?;
                self.slid_without_friction = true;
            }
            made => made?,
        }
        let drags = self.relative_drag(rod, world);
        if drags > RESIDUAL_TENSION_SHARE {
            let (x, director, laid) = (self.trial.x.clone(), self.trial.director.clone(), self.trial.laid_at.clone());
            self.trial.friction.set_drag(true);
            let most = done + MAX_ITERATIONS_FRICTION_ADDED;
            if !self.find_rest_pulled(rod, world, &mass, &mut done, most)? {
                // less than the friction of one node is less than the mesh knows
                self.trial.friction.set_drag(false);
                self.slid_without_friction = drags > 1.0;
                (self.trial.x, self.trial.director, self.trial.laid_at) = (x, director, laid);
                self.largest_residual(rod, world);
                self.work.store_end_residuals();
            }
        }
        Ok(self.accept_rest(rod, state, world, &ends, done))
    }

    /// Newton's iteration from where it is, or pseudo-steps with friction from there; none if they do not come to rest soon.
    fn find_rest_with_friction(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
        mass: &[f64],
        done: &mut usize,
    ) -> Result<Option<RodEndForces>, RodError> {
        self.set_trial_at_rest(rod, state, world, &ends);
        let drawn = pulled_end(rod, world, &ends);
        if drawn.is_none() && self.touches_rough_bottom(rod, world) && self.has_moving_fluid(world) {
            return Ok(None);
        }
        let is_piled_up = self.least_strain(rod) < PILED_UP_STRAIN;
        self.trial.friction = StaticFriction::pulled(drawn, !is_piled_up);
        self.place_laid_nodes_from_state(rod, world);
        if let Some(done) = self.rest_from_warm_start(rod, state, world, mass, &ends)
            && !(is_piled_up && self.relative_drag(rod, world) > 1.0)
        {
            return Ok(Some(self.accept_rest(rod, state, world, &ends, done)));
        }
        self.trial.friction.set_drag(true);
        if drawn.is_some() {
            self.set_trial_at_rest(rod, state, world, &ends);
            self.swing_with_end(rod, state, world);
            self.place_laid_nodes_from_state(rod, world);
            if self.find_rest_pulled(rod, world, mass, done, MAX_ITERATIONS_WITH_FRICTION)? {
                return Ok(Some(self.accept_rest(rod, state, world, &ends, *done)));
            }
        }
        Ok(None)
    }

    /// Whether the trial lies somewhere on a bottom with friction, to a thousandth of an element.
    fn touches_rough_bottom(&self, rod: &Rod, world: &LineEnvironment) -> bool {
        let near = 1e-3 * rod.shortest();
        let rough = world.bottom.filter(|(_, ground)| ground.rough());
        rough.is_some_and(|(bottom, _)| self.trial.x.iter().any(|x| x.z < bottom.height(x.x, x.y).0 + near))
    }

    /// Whether water or air moves along the trial, of a world whose bottom has friction.
    fn has_moving_fluid(&mut self, world: &LineEnvironment) -> bool {
        if !world.bottom.is_some_and(|(_, ground)| ground.rough()) {
            return false;
        }
        sample_fluid(world, self.trial.time, &mut self.trial);
        self.trial.fluid.iter().any(|f| f.velocity != Vector3::zeros() || f.wind != Vector3::zeros())
    }

    /// Rest of a rod that has no pulled end, in moving water or air: see [`super::stick_friction`]. None where nothing moves, or no
    /// rest is found.
    fn find_rest_stick_friction(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
        mass: &[f64],
        done: &mut usize,
    ) -> Result<Option<RodEndForces>, RodError> {
        self.set_trial_at_rest(rod, state, world, &ends);
        if !self.has_moving_fluid(world) {
            return Ok(None);
        }
        let calm = StillFluid(world.fluid);
        let bottom = world.bottom.map(|(bottom, ground)| (bottom, ground.smooth()));
        let mut laid = state.clone();
        match self.find_rest(rod, &mut laid, &LineEnvironment { fluid: &calm, bottom, ..*world }, ends) {
            Ok(made) => *done += made.iterations,
            Err(RodError::Statics { .. }) => {
                self.slid_without_friction = true;
                return Ok(None);
            }
            Err(error) => return Err(error),
        }
        self.set_trial_at_rest(rod, &laid, world, &ends);
        if !self.touches_rough_bottom(rod, world) {
            return Ok(None);
        }
        self.trial.laid_at.copy_from_slice(&laid.position);
        self.trial.friction = StaticFriction::Stick;
        let most = *done + MAX_ITERATIONS_FRICTION_ADDED;
        if self.find_rest_pulled(rod, world, mass, done, most)? {
            return Ok(Some(self.accept_rest(rod, state, world, &ends, *done)));
        }
        self.slid_without_friction = true;
        Ok(None)
    }

    /// Whether pseudo-steps with friction come to rest with no element in compression.
    fn find_rest_pulled(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        mass: &[f64],
        done: &mut usize,
        most: usize,
    ) -> Result<bool, RodError> {
        match self.solve_pseudo_transient(rod, world, mass, done, most) {
            Err(interrupted @ RodError::Interrupted { .. }) => Err(interrupted),
            made => Ok(made.is_ok() && !self.has_compressed_element(rod)),
        }
    }

    /// Takes the state as the trial, at rest with its ends where they are to be.
    pub(super) fn set_trial_at_rest(
        &mut self,
        rod: &Rod,
        state: &RodState,
        world: &LineEnvironment,
        ends: &[RodEnd; 2],
    ) {
        let (last, zero) = (rod.elements.len(), Vector3::zeros());
        self.weights = Weights { k: 1.0, c: 0.0, m: 0.0 };
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

    /// Takes the trial, which rests, as the state.
    fn accept_rest(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: &[RodEnd; 2],
        done: usize,
    ) -> RodEndForces {
        state.position.copy_from_slice(&self.trial.x);
        state.director.copy_from_slice(&self.trial.director);
        for list in [&mut state.velocity, &mut state.acceleration, &mut state.averaged] {
            list.fill(Vector3::zeros());
        }
        state.yielded = rod.yielded_strains(&state.position);
        self.set_seabed_penetration_scale(rod, world, state);
        self.set_stick_points(rod, world, state);
        let moment = [0, 1].map(|side| end_moment(rod, state, &ends[side], side));
        RodEndForces { force: self.work.end_forces(), moment, iterations: done, parts: 1 }
    }

    /// Sets how softly each node meets the bottom: see [`RodSolver::statics`].
    fn set_seabed_penetration_scale(&self, rod: &Rod, world: &LineEnvironment, state: &mut RodState) {
        let last = rod.elements.len();
        let sag = |i: usize| {
            let element = &rod.elements[i];
            let fluid = &self.trial.fluid[i];
            let weight = (element.mass - fluid.density * element.volume) * world.gravity / element.rest * 2.0;
            let tension = self.element_tension(rod, world, i);
            let most = 0.02 * element.rest;
            if tension > 0.0 { (weight.abs() * element.rest * element.rest / (8.0 * tension)).min(most) } else { most }
        };
        for node in 0..=last {
            let sides = [node.checked_sub(1), (node < last).then_some(node)];
            state.bedding[node] = sides.into_iter().flatten().map(sag).fold(0.0, f64::max);
        }
    }
}
