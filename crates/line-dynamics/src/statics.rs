//! The position of rest of a rod.

use super::drawn::{LEFT, drawn};
use super::ends::End;
use super::error::RodError;
use super::falls::{masses, weight};
use super::held::Calm;
use super::hinges::end_moment;
use super::mesh::Rod;
use super::rope::Memory;
use super::state::State;
use super::step::{At, EndForces, Solver};
use super::surroundings::World;
use super::system::Weights;
use super::trial::{lay, sample, soften};
use nalgebra::Vector3;

/// Newton iterations after which statics gives up.
const MOST_ITERATIONS: usize = 20_000;
/// Newton iterations after which it is looked for another way than with friction from the first fall on.
const MOST_DRAWN: usize = 400;
/// Newton iterations after which it is taken to find no rest with friction against sliding down alone.
const MOST_LIMP: usize = 5_000;
/// Strain of an element from which on a rod that bears no compression has piled up.
const PILED: f64 = -1e-3;
/// Newton iterations after which a rod that rests without friction is left without it.
const MOST_RUBBED: usize = 1_500;

impl Solver {
    /// Moves the state to where it is at rest, from wherever it is: the ends at their motions' positions, all
    /// velocities zero.
    ///
    /// The way there is a row of falls, each a step from rest by implicit Euler, which never gains energy: forces
    /// balance the mass of the nodes times their move over the square of a pseudo-time step. While Newton's iteration
    /// finds a fall easily the next is longer; when it does not, the fall is tried again shorter. In the end the
    /// falls are so long that Newton's iteration on the forces alone is left. With it the search begins where the state
    /// rested before and its ends have moved little, and takes a few iterations.
    ///
    /// With a bottom it also sets how softly a node meets it from then on. Between two nodes a line that lifts off
    /// with tension T and weight w sags by w l^2 / (8 T): the mesh knows its height over the bottom no better than
    /// that. The stiffness of the bottom therefore grows to its full value over no less than this height (at most a
    /// fiftieth of the element), or every node would hit the bottom as a hammer does. It falls with the square of the
    /// element length.
    ///
    /// # Errors
    /// [`RodError::Statics`] when no equilibrium is reached, [`RodError::Interrupted`], [`RodError::Shape`] for a state of another rod; the
    /// state is then as before.
    pub fn statics(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        ends: [End; 2],
    ) -> Result<EndForces, RodError> {
        self.begin(rod, state, world, &ends)?;
        let made = self.nearby(world, |solver, world, near| solver.come_to_rest(rod, state, world, near.ends(ends)));
        self.done(made, |_| true)
    }

    /// As [`Solver::statics`], for a state that is near rest with friction of the bottom: none where that is not found soon.
    ///
    /// # Errors
    /// As [`Solver::statics`].
    pub fn statics_beside(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        ends: [End; 2],
    ) -> Result<Option<EndForces>, RodError> {
        self.begin(rod, state, world, &ends)?;
        let mass = masses(rod, world);
        let made = self
            .nearby(world, |solver, world, near| solver.rest_beside(rod, state, world, near.ends(ends), &mass, &mut 0));
        self.done(made, Option::is_some)
    }

    /// Measures positions from where end A is held.
    fn begin(&mut self, rod: &Rod, state: &mut State, world: &World, ends: &[End; 2]) -> Result<(), RodError> {
        self.fits(rod, state)?;
        if let Some(motion) = ends[0].motion.filter(|motion| motion.position.iter().all(|c| c.is_finite())) {
            state.move_origin(motion.position);
        }
        self.trial.origin = state.origin;
        self.stands = rod.is_stiff(weight(rod, world));
        self.at = At::Nowhere;
        self.slid = false;
        self.trial.still = true;
        Ok(())
    }

    fn done<T>(&mut self, made: Result<T, RodError>, rests: impl Fn(&T) -> bool) -> Result<T, RodError> {
        self.trial.still = false;
        if made.as_ref().is_ok_and(rests) {
            self.at = At::Rest;
        }
        made
    }

    /// Whether the last position of rest is one without friction, but against sliding down a slope, though the bottom has some: no
    /// rest was found with it.
    pub fn slid(&self) -> bool {
        self.slid
    }

    /// Rows of falls: with friction from the start, which finds what lies slack where it lies; or, from a start that is far from rest,
    /// first without friction.
    fn come_to_rest(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        ends: [End; 2],
    ) -> Result<EndForces, RodError> {
        let (mass, mut done) = (masses(rod, world), 0);
        if let Some(made) = self.rest_beside(rod, state, world, ends, &mass, &mut done)? {
            return Ok(made);
        }
        if self.stands
            && let Some(done) = self.rest_followed(rod, state, world, &ends, &mass)?
        {
            return Ok(self.rested(rod, state, world, &ends, done));
        }
        let drawn = drawn(rod, world, &ends);
        if drawn.is_none()
            && let Some(made) = self.rest_held(rod, state, world, ends, &mass, &mut done)?
        {
            return Ok(made);
        }
        // without what holds it back it falls where it may; but down a slope it does not slide
        self.lie(rod, state, world, &ends);
        (self.trial.drawn, self.trial.limp, self.trial.held) = (drawn, drawn.is_some(), false);
        let most = if drawn.is_some() { done + MOST_LIMP } else { MOST_ITERATIONS };
        match self.fall_to_rest(rod, world, &mass, &mut done, most) {
            Err(RodError::Statics { .. }) if drawn.is_some() => {
                self.lie(rod, state, world, &ends);
                (self.trial.drawn, self.trial.limp) = (None, false);
                self.fall_to_rest(rod, world, &mass, &mut done, MOST_ITERATIONS)?;
                self.slid = true;
            }
            made => made?,
        }
        let drags = self.drags(rod, world);
        if drags > LEFT {
            let (x, director, laid) = (self.trial.x.clone(), self.trial.director.clone(), self.trial.laid.clone());
            self.trial.limp = false;
            let most = done + MOST_RUBBED;
            if !self.drawn_to_rest(rod, world, &mass, &mut done, most)? {
                // less than the friction of one node is less than the mesh knows
                (self.trial.limp, self.slid) = (true, drags > 1.0);
                (self.trial.x, self.trial.director, self.trial.laid) = (x, director, laid);
                self.left(rod, world);
                self.work.keep_ends();
            }
        }
        Ok(self.rested(rod, state, world, &ends, done))
    }

    /// Newton's iteration from where it is, or falls with friction from there; none if they do not come to rest soon.
    fn rest_beside(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        ends: [End; 2],
        mass: &[f64],
        done: &mut usize,
    ) -> Result<Option<EndForces>, RodError> {
        self.lie(rod, state, world, &ends);
        let drawn = drawn(rod, world, &ends);
        if drawn.is_none() && self.lies(rod, world) && self.is_moved(world) {
            return Ok(None);
        }
        (self.trial.drawn, self.trial.held) = (drawn, false);
        self.trial.limp = drawn.is_some() && self.slackest(rod) < PILED;
        self.lay_as_stuck(rod, world);
        if let Some(done) = self.settle(rod, state, world, mass, &ends)
            && !(self.trial.limp && self.drags(rod, world) > 1.0)
        {
            return Ok(Some(self.rested(rod, state, world, &ends, done)));
        }
        self.trial.limp = false;
        if drawn.is_some() {
            self.lie(rod, state, world, &ends);
            self.swing(rod, state, world);
            self.lay_as_stuck(rod, world);
            if self.drawn_to_rest(rod, world, mass, done, MOST_DRAWN)? {
                return Ok(Some(self.rested(rod, state, world, &ends, *done)));
            }
        }
        Ok(None)
    }

    /// Whether the trial lies somewhere on a bottom with friction, to a thousandth of an element.
    fn lies(&self, rod: &Rod, world: &World) -> bool {
        let near = 1e-3 * rod.shortest();
        let rough = world.bottom.filter(|(_, ground)| ground.rough());
        rough.is_some_and(|(bottom, _)| self.trial.x.iter().any(|x| x.z < bottom.height(x.x, x.y).0 + near))
    }

    /// Whether water or air moves along the trial, of a world whose bottom has friction.
    fn is_moved(&mut self, world: &World) -> bool {
        if !world.bottom.is_some_and(|(_, ground)| ground.rough()) {
            return false;
        }
        sample(world, self.trial.time, &mut self.trial);
        self.trial.fluid.iter().any(|f| f.velocity != Vector3::zeros() || f.wind != Vector3::zeros())
    }

    /// Rest of a rod that has not been drawn to an end, in water or air that moves: see [`super::held`]. None where nothing moves, or no
    /// rest is found.
    fn rest_held(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        ends: [End; 2],
        mass: &[f64],
        done: &mut usize,
    ) -> Result<Option<EndForces>, RodError> {
        self.lie(rod, state, world, &ends);
        if !self.is_moved(world) {
            return Ok(None);
        }
        let calm = Calm(world.fluid);
        let bottom = world.bottom.map(|(bottom, ground)| (bottom, ground.smooth()));
        let mut laid = state.clone();
        match self.come_to_rest(rod, &mut laid, &World { fluid: &calm, bottom, ..*world }, ends) {
            Ok(made) => *done += made.iterations,
            Err(RodError::Statics { .. }) => {
                self.slid = true;
                return Ok(None);
            }
            Err(error) => return Err(error),
        }
        self.lie(rod, &laid, world, &ends);
        if !self.lies(rod, world) {
            return Ok(None);
        }
        self.trial.laid.copy_from_slice(&laid.position);
        (self.trial.drawn, self.trial.limp, self.trial.held) = (None, false, true);
        let most = *done + MOST_RUBBED;
        if self.drawn_to_rest(rod, world, mass, done, most)? {
            return Ok(Some(self.rested(rod, state, world, &ends, *done)));
        }
        self.slid = true;
        Ok(None)
    }

    /// Whether falls with friction come to rest, and with no element that pushes.
    fn drawn_to_rest(
        &mut self,
        rod: &Rod,
        world: &World,
        mass: &[f64],
        done: &mut usize,
        most: usize,
    ) -> Result<bool, RodError> {
        match self.fall_to_rest(rod, world, mass, done, most) {
            Err(interrupted @ RodError::Interrupted { .. }) => Err(interrupted),
            made => Ok(made.is_ok() && !self.pushes(rod)),
        }
    }

    /// Takes the state as the trial, at rest with its ends where they are to be.
    pub(super) fn lie(&mut self, rod: &Rod, state: &State, world: &World, ends: &[End; 2]) {
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
        lay(rod, state, world, &mut self.trial.lay);
        soften(state, world, &mut self.trial.soft);
        self.trial.laid.copy_from_slice(&state.stuck);
        // at rest viscoelastic rope has let go of everything
        self.trial.memory.fill(Memory::default());
    }

    /// Takes the trial, which rests, as the state.
    fn rested(&mut self, rod: &Rod, state: &mut State, world: &World, ends: &[End; 2], done: usize) -> EndForces {
        state.position.copy_from_slice(&self.trial.x);
        state.director.copy_from_slice(&self.trial.director);
        for list in [&mut state.velocity, &mut state.acceleration, &mut state.averaged] {
            list.fill(Vector3::zeros());
        }
        state.yielded = rod.yielded(&state.position);
        self.bed(rod, world, state);
        self.stick(rod, world, state);
        let moment = [0, 1].map(|side| end_moment(rod, state, &ends[side], side));
        EndForces { force: self.work.end_forces(), moment, iterations: done, parts: 1 }
    }

    /// Sets how softly each node meets the bottom: see [`Solver::statics`].
    fn bed(&self, rod: &Rod, world: &World, state: &mut State) {
        let last = rod.elements.len();
        let sag = |i: usize| {
            let element = &rod.elements[i];
            let fluid = &self.trial.fluid[i];
            let weight = (element.mass - fluid.density * element.volume) * world.gravity / element.rest * 2.0;
            let tension = self.pull(rod, world, i);
            let most = 0.02 * element.rest;
            if tension > 0.0 { (weight.abs() * element.rest * element.rest / (8.0 * tension)).min(most) } else { most }
        };
        for node in 0..=last {
            let sides = [node.checked_sub(1), (node < last).then_some(node)];
            state.bedding[node] = sides.into_iter().flatten().map(sag).fold(0.0, f64::max);
        }
    }
}
