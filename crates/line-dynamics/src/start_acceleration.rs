//! Accelerations with which a run starts.

use super::ends::RodEnd;
use super::environment::{FluidState, LineEnvironment};
use super::error::RodError;
use super::hinges::end_moment;
use super::mesh::Rod;
use super::state::RodState;
use super::step::{RodEndForces, RodSolver, SolverPhase};
use super::system::Weights;
use super::trial::{StaticFriction, sample_fluid, set_friction_directions, set_seabed_penetration_scales};
use super::viscoelastic::update_memory;
use nalgebra::{Matrix3, Vector3};

impl RodSolver {
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
        let last = self.change.len() - self.work.stride();
        [0, 1].map(|side| {
            let mut made = Matrix3::zeros();
            if self.trial.ends[side].motion.is_some() {
                let first = side * last;
                self.work.visit_end_rows(side, |i, column, value| {
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
        self.in_local_coordinates(world, |solver, world, near| solver.start_nearby(rod, state, world, near.ends(ends)))
    }

    /// [`RodSolver::start`] in coordinates from the origin of the state.
    fn start_nearby(
        &mut self,
        rod: &Rod,
        state: &mut RodState,
        world: &LineEnvironment,
        ends: [RodEnd; 2],
    ) -> Result<RodEndForces, RodError> {
        let last = rod.elements.len();
        let known = ends.map(|e| e.motion.is_some());
        self.trial.time = state.time;
        self.trial.ends = ends;
        self.trial.friction = StaticFriction::None;
        self.trial.stuck_at.copy_from_slice(&state.stuck);
        self.trial.x.copy_from_slice(&state.position);
        self.trial.v.copy_from_slice(&state.velocity);
        self.trial.a.fill(Vector3::zeros());
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                self.trial.a[node] = motion.acceleration;
            }
        }
        self.trial.director.copy_from_slice(&state.director);
        set_friction_directions(rod, state, world, &mut self.trial.friction_direction);
        set_seabed_penetration_scales(state, world, &mut self.trial.seabed_penetration_scale);
        update_memory(rod, state, 0.0, &mut self.trial.memory);
        sample_fluid(world, state.time, &mut self.trial);
        self.work.assemble(rod, world, &self.trial, Weights { k: 0.0, c: 0.0, m: 1.0 }, 0..last);
        self.work.store_end_rows();
        self.work.store_end_residuals();
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
        // forces are linear in the accelerations, so one solution has them whole
        self.work.update_end_residuals(&self.change);
        let moment = [0, 1].map(|side| end_moment(rod, state, &ends[side], side));
        Ok(RodEndForces { force: self.work.end_forces(), moment, iterations: 1, parts: 1 })
    }
}
