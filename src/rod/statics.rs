//! The position of rest of a rod.

use super::assemble::Weights;
use super::ends::End;
use super::error::RodError;
use super::mesh::{Rod, State};
use super::step::{EndForces, Solver, end_moment, lay, sample, soften};
use super::surroundings::World;
use nalgebra::Vector3;

/// Iterations after which statics gives up.
const MOST_ITERATIONS: usize = 3000;
/// Largest residual of a node as a share of the largest force in the rod.
const PROOF: f64 = 1e-9;

impl Solver {
    /// Moves the state to where it is at rest, from wherever it is: the ends at their motions' positions, all velocities zero.
    ///
    /// Each iteration is Newton's with the mass of the nodes over the square of a pseudo-time step added to the stiffness: a step
    /// from rest by implicit Euler. While forces are far from balance the step is short, and the rod falls into place as a
    /// damped one would; as they settle it grows and Newton's own convergence is left.
    ///
    /// With a bottom it also sets how softly a node meets it from then on. Between two nodes a line that lifts off with tension T
    /// and weight w sags by w l^2 / (8 T): the mesh knows its height over the bottom no better than that. The stiffness of the bottom
    /// therefore grows to its full value over no less than this height (at most a fiftieth of the element), or every node
    /// would hit the bottom as a hammer does. It falls with the square of the element length.
    ///
    /// # Errors
    /// [`RodError::Statics`] when no equilibrium is reached; the state is then as before.
    pub fn statics(
        &mut self,
        rod: &Rod,
        state: &mut State,
        world: &World,
        ends: [End; 2],
    ) -> Result<EndForces, RodError> {
        let last = rod.elements.len();
        let known = [ends[0].motion.is_some(), ends[1].motion.is_some()];
        let zero = Vector3::zeros();
        self.weights = Weights { k: 1.0, c: 0.0, m: 0.0 };
        self.trial.time = state.time;
        self.trial.ends = ends;
        self.trial.x.copy_from_slice(&state.position);
        self.trial.v.fill(zero);
        self.trial.a.fill(zero);
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                self.trial.x[node] = motion.position;
            }
        }
        lay(rod, state, world, &mut self.trial.lay);
        soften(state, world, &mut self.trial.soft);
        let mass = masses(rod);
        let reach = 0.05 * rod.length();
        let mut pseudo = (0.001 * rod.length() / world.gravity.abs().max(1.0)).sqrt();
        let mut best = f64::INFINITY;
        let mut worst = (0, f64::INFINITY);
        for iteration in 1..=MOST_ITERATIONS {
            sample(world, state.time, &mut self.trial);
            for fluid in &mut self.trial.fluid {
                fluid.acceleration = zero;
            }
            self.work.assemble(rod, world, &self.trial, self.weights, 0..last);
            self.work.keep_ends();
            worst = self.work.worst(known);
            let scale = self.force_scale(rod, world, &mass);
            if worst.1 <= PROOF * scale {
                for i in 0..=last {
                    state.position[i] = self.trial.x[i];
                }
                state.velocity.fill(zero);
                state.acceleration.fill(zero);
                state.averaged.fill(zero);
                self.bed(rod, world, state);
                let moment = [0, 1].map(|side| end_moment(rod, state, &ends[side], side));
                return Ok(EndForces { force: self.work.end_forces(), moment, iterations: iteration, parts: 1 });
            }
            if !worst.1.is_finite() {
                break;
            }
            for (node, m) in mass.iter().enumerate() {
                self.work.stiffen(node, m / (pseudo * pseudo));
            }
            for (side, node) in [(0, 0), (1, last)] {
                if known[side] {
                    self.work.fix(node);
                }
            }
            let solved = self.work.factor().is_ok();
            if solved {
                self.work.newton(&mut self.change);
            }
            let size = self.change.iter().fold(0.0, |most: f64, c| if c.is_nan() { f64::INFINITY } else { most.max(c.abs()) });
            if !solved || !size.is_finite() {
                pseudo *= 0.25;
                continue;
            }
            // long moves are shortened, not turned: the direction is that of a damped fall
            let share = (reach / size).min(1.0);
            for i in 0..=last {
                let d = &self.change[3 * i..3 * i + 3];
                self.trial.x[i] += Vector3::new(d[0], d[1], d[2]) * share;
            }
            let ratio = best / worst.1;
            best = worst.1;
            pseudo *= if share < 1.0 { 0.5 } else { ratio.clamp(0.3, 1.5) * 1.3 };
            pseudo = pseudo.clamp(1e-4, 1e5);
        }
        Err(RodError::Statics {
            rod: rod.name.clone(),
            iterations: MOST_ITERATIONS,
            residual: worst.1,
            element: worst.0.clamp(1, last),
        })
    }

    /// Sets how softly each node meets the bottom: see [`Solver::statics`].
    fn bed(&self, rod: &Rod, world: &World, state: &mut State) {
        let last = rod.elements.len();
        let sag = |i: usize| {
            let element = &rod.elements[i];
            let fluid = &self.trial.fluid[i];
            let weight = (element.mass - fluid.density * element.volume) * world.gravity / element.rest * 2.0;
            let strain = (state.position[i + 1] - state.position[i]).norm() / element.rest - 1.0;
            let tension = rod.segments[element.segment].axial.at(strain).0;
            let most = 0.02 * element.rest;
            if tension > 0.0 { (weight.abs() * element.rest * element.rest / (8.0 * tension)).min(most) } else { most }
        };
        for node in 0..=last {
            let sides = [node.checked_sub(1), (node < last).then_some(node)];
            state.bedding[node] = sides.into_iter().flatten().map(sag).fold(0.0, f64::max);
        }
    }

    /// The largest force in the rod (N), below which nothing can be told from rounding.
    fn force_scale(&self, rod: &Rod, world: &World, mass: &[f64]) -> f64 {
        let weight = mass.iter().sum::<f64>() * world.gravity.abs();
        let strongest = rod.elements.iter().zip(self.trial.x.windows(2)).map(|(element, x)| {
            let strain = (x[1] - x[0]).norm() / element.rest - 1.0;
            if strain < 0.0 && !element.compression { 0.0 } else { rod.segments[element.segment].axial.at(strain).0.abs() }
        });
        strongest.fold(weight, f64::max)
    }
}

/// Mass of each node with the water it displaces, so that a buoyant rod settles as a heavy one does (kg).
fn masses(rod: &Rod) -> Vec<f64> {
    let mut mass = vec![0.0; rod.nodes()];
    for (i, element) in rod.elements.iter().enumerate() {
        mass[i] += element.mass;
        mass[i + 1] += element.mass;
    }
    for a in &rod.attachments {
        mass[a.node] += a.mass;
    }
    mass
}
