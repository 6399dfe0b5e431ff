//! A position of rest beside one that is known.

use super::ends::End;
use super::falls::{Fall, first_fall};
use super::mesh::Rod;
use super::state::State;
use super::step::Solver;
use super::surroundings::World;
use super::trial::{largest, sample, turn};
use nalgebra::Vector3;

/// Newton iterations after which it is looked for another way.
const MOST_SETTLING: usize = 12;
/// Largest move of a node, as a share of the shortest element, that an iteration may make.
const NEAR: f64 = 0.5;
/// The same below which it need not be smaller than the one before.
const SMALL: f64 = 0.01;
/// Pseudo-time of the falls, in first falls: so long that Newton's iteration is left, and short enough to hold a node
/// that nothing else holds.
const LONG: f64 = 1e4;

impl Solver {
    /// Moves the trial, which is where the state is, to the position of rest beside it: by the linear response to the
    /// move of the ends, and Newton's iteration from there. The iterations it took; none if the state did not rest, or
    /// the ends have moved too far.
    pub(super) fn settle(
        &mut self,
        rod: &Rod,
        state: &State,
        world: &World,
        mass: &[f64],
        ends: &[End; 2],
    ) -> Option<usize> {
        let last = rod.elements.len();
        let pseudo = LONG * first_fall(rod, world);
        let mut done = 0;
        if (0..2).any(|side| ends[side].motion.is_some_and(|m| m.position != state.position[side * last])) {
            done += 1;
            self.lead(rod, state, world, mass, ends, pseudo)?;
        }
        let from = self.trial.x.clone();
        let mut before = f64::INFINITY;
        while done < MOST_SETTLING {
            done += 1;
            match self.fall(rod, world, mass, &from, pseudo) {
                Fall::Rest => return Some(done).filter(|_| !self.pushes(rod)),
                // nodes that meet the bottom anew or leave it take some iterations before their moves shrink
                Fall::Moved { share, .. } if share < SMALL || (share < NEAR && share < 0.5 * before) => before = share,
                _ => return None,
            }
        }
        None
    }

    /// Leads the nodes along with the ends.
    fn lead(
        &mut self,
        rod: &Rod,
        state: &State,
        world: &World,
        mass: &[f64],
        ends: &[End; 2],
        pseudo: f64,
    ) -> Option<()> {
        let (last, stride) = (rod.elements.len(), self.work.stride());
        self.trial.x.copy_from_slice(&state.position);
        sample(world, state.time, &mut self.trial);
        for fluid in &mut self.trial.fluid {
            fluid.acceleration = Vector3::zeros();
        }
        self.work.assemble(rod, world, &self.trial, self.weights, 0..last);
        for (node, m) in mass.iter().enumerate() {
            self.work.stiffen(node, m / (pseudo * pseudo), &Vector3::zeros());
        }
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                self.work.fix(node);
                self.work.lead_residual(node, &(motion.position - state.position[node]));
            }
        }
        if self.work.factor().ok()? > 0 {
            return None;
        }
        self.work.newton(&mut self.change);
        let size = largest(&self.change, stride, rod.shortest());
        if !size.is_finite() || self.share_moved(rod, size) > NEAR {
            return None;
        }
        turn(&mut self.trial.director, &self.trial.x, &self.change, stride, [false; 2]);
        for (x, d) in self.trial.x.iter_mut().zip(self.change.chunks_exact(stride)) {
            *x += Vector3::new(d[0], d[1], d[2]);
        }
        for (side, node) in [(0, 0), (1, last)] {
            if let Some(motion) = ends[side].motion {
                self.trial.x[node] = motion.position;
            }
        }
        Some(())
    }
}
