//! The position of rest of a rod.

use super::continuation::rest_by_continuation;
use super::ends::RodEnd;
use super::environment::LineEnvironment;
use super::error::RodError;
use super::hinges::end_moment;
use super::pseudo_transient::{PseudoTransient, element_tension};
use super::solver::RodEndForces;
use super::state::RodState;
use super::statics_friction::{
    RESIDUAL_TENSION_SHARE, has_compressed_element, least_strain, place_laid_nodes_from_state, pulled_end,
    relative_drag, set_stick_points, swing_with_end,
};
use super::statics_warm_start::rest_from_warm_start;
use super::stick_friction::StillFluid;
use super::trial::{StaticFriction, sample_fluid};
use super::viscoelastic::yielded_strains;
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

/// The search of a position of rest of a rod whose ends are where they are to be.
pub(super) struct RestSearch<'a> {
    pseudo: PseudoTransient<'a>,
    ends: [RodEnd; 2],
    /// Newton iterations so far.
    done: usize,
    /// See [`super::RodSolver::has_slid_without_friction`].
    pub slid_without_friction: bool,
}

impl<'a> RestSearch<'a> {
    /// A search that has not begun.
    pub fn new(pseudo: PseudoTransient<'a>, ends: [RodEnd; 2]) -> Self {
        RestSearch { pseudo, ends, done: 0, slid_without_friction: false }
    }

    /// Pseudo-transient solutions: with friction from the start, which leaves slack parts where they lie; or, from a start that is far
    /// from rest, first without friction.
    ///
    /// # Errors
    /// Rest that is not reached within the iterations allowed, or an interruption.
    pub fn find_rest(&mut self, state: &mut RodState) -> Result<RodEndForces, RodError> {
        let (rod, world, ends) = (self.pseudo.rod, self.pseudo.world, self.ends);
        if let Some(made) = self.find_rest_with_friction(state)? {
            return Ok(made);
        }
        if self.pseudo.is_stiff
            && let Some(done) = rest_by_continuation(&mut self.pseudo, state, &ends)?
        {
            self.done = done;
            return Ok(self.accept_rest(state));
        }
        let drawn = pulled_end(rod, world, &ends);
        if drawn.is_none()
            && let Some(made) = self.find_rest_stick_friction(state)?
        {
            return Ok(made);
        }
        // without drag friction it settles freely; but it does not slide down a slope
        self.pseudo.set_trial_at_rest(state, &ends);
        self.pseudo.trial.friction = StaticFriction::with_pulled_end(drawn, false);
        let most = if drawn.is_some() { self.done + MAX_ITERATIONS_WITHOUT_DRAG_FRICTION } else { MAX_ITERATIONS };
        match self.pseudo.solve(&mut self.done, most) {
            Err(RodError::Statics { .. }) if drawn.is_some() => {
                self.pseudo.set_trial_at_rest(state, &ends);
                self.pseudo.trial.friction = StaticFriction::None;
                self.pseudo.solve(&mut self.done, MAX_ITERATIONS)?;
                self.slid_without_friction = true;
            }
            made => made?,
        }
        let drags = relative_drag(self.pseudo.trial, rod, world);
        if drags > RESIDUAL_TENSION_SHARE {
            let (x, director, laid) =
                (self.pseudo.trial.x.clone(), self.pseudo.trial.director.clone(), self.pseudo.trial.laid_at.clone());
            self.pseudo.trial.friction.set_drag(true);
            let most = self.done + MAX_ITERATIONS_FRICTION_ADDED;
            if !self.find_rest_pulled(most)? {
                // less than the friction of one node is less than the mesh knows
                self.pseudo.trial.friction.set_drag(false);
                self.slid_without_friction = drags > 1.0;
                (self.pseudo.trial.x, self.pseudo.trial.director, self.pseudo.trial.laid_at) = (x, director, laid);
                self.pseudo.largest_residual();
                self.pseudo.system.work.store_end_residuals();
            }
        }
        Ok(self.accept_rest(state))
    }

    /// Newton's iteration from where it is, or pseudo-steps with friction from there; none if they do not come to rest soon.
    ///
    /// # Errors
    /// An interruption, or numbers that are not finite.
    pub fn find_rest_with_friction(&mut self, state: &mut RodState) -> Result<Option<RodEndForces>, RodError> {
        let (rod, world, ends) = (self.pseudo.rod, self.pseudo.world, self.ends);
        self.pseudo.set_trial_at_rest(state, &ends);
        let drawn = pulled_end(rod, world, &ends);
        if drawn.is_none() && self.touches_rough_bottom() && self.has_moving_fluid() {
            return Ok(None);
        }
        let is_piled_up = least_strain(self.pseudo.trial, rod) < PILED_UP_STRAIN;
        self.pseudo.trial.friction = StaticFriction::with_pulled_end(drawn, !is_piled_up);
        place_laid_nodes_from_state(self.pseudo.trial, rod, world);
        if let Some(done) = rest_from_warm_start(&mut self.pseudo, state, &ends)
            && !(is_piled_up && relative_drag(self.pseudo.trial, rod, world) > 1.0)
        {
            self.done = done;
            return Ok(Some(self.accept_rest(state)));
        }
        self.pseudo.trial.friction.set_drag(true);
        if drawn.is_some() {
            self.pseudo.set_trial_at_rest(state, &ends);
            swing_with_end(self.pseudo.trial, rod, state, world);
            place_laid_nodes_from_state(self.pseudo.trial, rod, world);
            if self.find_rest_pulled(MAX_ITERATIONS_WITH_FRICTION)? {
                return Ok(Some(self.accept_rest(state)));
            }
        }
        Ok(None)
    }

    /// Whether the trial lies somewhere on a bottom with friction, to a thousandth of an element.
    fn touches_rough_bottom(&self) -> bool {
        let (rod, world) = (self.pseudo.rod, self.pseudo.world);
        let near = 1e-3 * rod.shortest();
        let rough = world.bottom.filter(|(_, ground)| ground.holds_at_rest());
        rough.is_some_and(|(bottom, _)| self.pseudo.trial.x.iter().any(|x| x.z < bottom.height(x.x, x.y).0 + near))
    }

    /// Whether water or air moves along the trial, of a world whose bottom has friction.
    fn has_moving_fluid(&mut self) -> bool {
        let world = self.pseudo.world;
        if !world.bottom.is_some_and(|(_, ground)| ground.holds_at_rest()) {
            return false;
        }
        sample_fluid(world, self.pseudo.trial.time, self.pseudo.trial);
        self.pseudo.trial.fluid.iter().any(|f| f.velocity != Vector3::zeros() || f.wind != Vector3::zeros())
    }

    /// Rest of a rod that has no pulled end, in moving water or air: see [`super::stick_friction`]. None where nothing moves, or no
    /// rest is found.
    fn find_rest_stick_friction(&mut self, state: &mut RodState) -> Result<Option<RodEndForces>, RodError> {
        let (world, ends) = (self.pseudo.world, self.ends);
        self.pseudo.set_trial_at_rest(state, &ends);
        if !self.has_moving_fluid() {
            return Ok(None);
        }
        let calm = StillFluid(world.fluid);
        let bottom = world.bottom.map(|(bottom, ground)| (bottom, ground.smooth()));
        let mut laid = state.clone();
        let still = LineEnvironment { fluid: &calm, bottom, ..*world };
        let mut search = RestSearch::new(self.pseudo.in_world(&still), ends);
        let found = search.find_rest(&mut laid);
        self.slid_without_friction |= search.slid_without_friction;
        match found {
            Ok(made) => self.done += made.iterations,
            Err(RodError::Statics { .. }) => {
                self.slid_without_friction = true;
                return Ok(None);
            }
            Err(error) => return Err(error),
        }
        self.pseudo.set_trial_at_rest(&laid, &ends);
        if !self.touches_rough_bottom() {
            return Ok(None);
        }
        self.pseudo.trial.laid_at.copy_from_slice(&laid.position);
        self.pseudo.trial.friction = StaticFriction::Stick;
        let most = self.done + MAX_ITERATIONS_FRICTION_ADDED;
        if self.find_rest_pulled(most)? {
            return Ok(Some(self.accept_rest(state)));
        }
        self.slid_without_friction = true;
        Ok(None)
    }

    /// Whether pseudo-steps with friction come to rest with no element in compression.
    fn find_rest_pulled(&mut self, most: usize) -> Result<bool, RodError> {
        match self.pseudo.solve(&mut self.done, most) {
            Err(interrupted @ RodError::Interrupted { .. }) => Err(interrupted),
            made => Ok(made.is_ok() && !has_compressed_element(self.pseudo.trial, self.pseudo.rod)),
        }
    }

    /// Takes the trial, which rests, as the state.
    fn accept_rest(&mut self, state: &mut RodState) -> RodEndForces {
        let (rod, world, ends) = (self.pseudo.rod, self.pseudo.world, self.ends);
        state.position.copy_from_slice(&self.pseudo.trial.x);
        state.director.copy_from_slice(&self.pseudo.trial.director);
        for list in [&mut state.velocity, &mut state.acceleration, &mut state.averaged] {
            list.fill(Vector3::zeros());
        }
        state.yielded = yielded_strains(rod, &state.position);
        self.set_seabed_penetration_scale(state);
        set_stick_points(self.pseudo.trial, rod, world, state);
        let moment = [0, 1].map(|side| end_moment(rod, state, &ends[side], side));
        RodEndForces { force: self.pseudo.system.work.end_forces(), moment, iterations: self.done, parts: 1 }
    }

    /// Sets how softly each node meets the bottom: see [`RodSolver::statics`](super::RodSolver::statics).
    fn set_seabed_penetration_scale(&self, state: &mut RodState) {
        let (rod, world) = (self.pseudo.rod, self.pseudo.world);
        let last = rod.elements.len();
        let sag = |i: usize| {
            let element = &rod.elements[i];
            let fluid = &self.pseudo.trial.fluid[i];
            let weight = (element.mass - fluid.density * element.volume) * world.gravity / element.rest * 2.0;
            let tension = element_tension(rod, world, self.pseudo.trial, i);
            let most = 0.02 * element.rest;
            if tension > 0.0 { (weight.abs() * element.rest * element.rest / (8.0 * tension)).min(most) } else { most }
        };
        for node in 0..=last {
            let sides = [node.checked_sub(1), (node < last).then_some(node)];
            state.bedding[node] = sides.into_iter().flatten().map(sag).fold(0.0, f64::max);
        }
    }
}
