//! Accelerations with which a run starts.

use super::ends::End;
use super::error::RodError;
use super::mesh::{Rod, State};
use super::step::Solver;
use super::surroundings::World;
use super::system::Weights;
use super::trial::{lay, sample, soften};
use nalgebra::Vector3;

impl Solver {
    /// Copies where the last trial ended, without taking it as the new state of the solver's own run.
    pub fn reached(&self, state: &mut State) {
        state.clone_from(&self.next);
    }

    /// Gives a state the accelerations that its forces make, as at the start of a run that is not at rest, or after a
    /// line has parted. A state from [`Solver::statics`] has them.
    ///
    /// # Errors
    /// A force that is no number, a node without mass, or a state of another rod.
    pub fn start(&mut self, rod: &Rod, state: &mut State, world: &World, ends: [End; 2]) -> Result<(), RodError> {
        self.fits(rod, state)?;
        let last = rod.elements.len();
        let known = ends.map(|e| e.motion.is_some());
        self.trial.time = state.time;
        self.trial.ends = ends;
        self.trial.x.copy_from_slice(&state.position);
        self.trial.v.copy_from_slice(&state.velocity);
        self.trial.a.fill(Vector3::zeros());
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                self.trial.a[node] = motion.acceleration;
            }
        }
        self.trial.director.copy_from_slice(&state.director);
        lay(rod, state, world, &mut self.trial.lay);
        soften(state, world, &mut self.trial.soft);
        sample(world, state.time, &mut self.trial);
        self.work.assemble(rod, world, &self.trial, Weights { k: 0.0, c: 0.0, m: 1.0 }, 0..last);
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.drop_residual(node);
                self.work.fix(node);
            }
        }
        let refuse = |node: usize| RodError::Step {
            rod: rod.name.clone(),
            time: state.time,
            step: 0.0,
            element: node.clamp(1, last),
            why: "it has no acceleration there".to_string(),
        };
        self.work.factor().map_err(refuse)?;
        self.work.newton(&mut self.change);
        let stride = self.work.stride();
        if let Some(node) = self.change.chunks_exact(stride).position(|d| d[..3].iter().any(|c| !c.is_finite())) {
            return Err(refuse(node));
        }
        for (i, d) in self.change.chunks_exact(stride).enumerate() {
            let moved = self.trial.a[i] + Vector3::new(d[0], d[1], d[2]);
            (state.acceleration[i], state.averaged[i]) = (moved, moved);
        }
        Ok(())
    }
}
