//! The system of a rod by its kind: as narrow a band as its stiffness needs.

use super::assemble::assemble;
use super::condense::MAX_BANDWIDTH;
use super::environment::LineEnvironment;
use super::mesh::Rod;
use super::system::{RodSystem, Weights};
use super::trial::Trial;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// The linear system of one iteration.
#[derive(Clone, Debug)]
pub(super) enum Workspace {
    /// No bending stiffness: two nodes an equation.
    Rope(RodSystem<3, 5, 11>),
    /// Bending: three nodes an equation.
    Beam(RodSystem<3, 8, 17>),
    /// Bending and torsion: three nodes an equation, with the turns of two elements.
    Twisted(RodSystem<4, 10, 21>),
}

/// Calls the same with whichever system is there.
macro_rules! each {
    ($workspace:expr, $system:ident => $body:expr) => {
        match $workspace {
            Workspace::Rope($system) => $body,
            Workspace::Beam($system) => $body,
            Workspace::Twisted($system) => $body,
        }
    };
}

impl Workspace {
    /// The system that fits a rod.
    pub fn new(rod: &Rod) -> Self {
        if rod.twists() {
            Workspace::Twisted(RodSystem::new(rod.nodes()))
        } else if rod.elements.iter().all(|e| e.bending == 0.0) {
            Workspace::Rope(RodSystem::new(rod.nodes()))
        } else {
            Workspace::Beam(RodSystem::new(rod.nodes()))
        }
    }

    /// Unknowns a node: the three translations, and with torsion the turn of the element after it.
    pub fn stride(&self) -> usize {
        each!(self, system => system.stride())
    }

    /// Elements beside an end that the motion of the end enters.
    pub fn bandwidth(&self) -> usize {
        if matches!(self, Workspace::Rope(_)) { 1 } else { 2 }
    }

    /// Residual and tangent of the whole rod at a trial.
    pub fn assemble(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        trial: &Trial,
        weights: Weights,
        range: Range<usize>,
    ) {
        each!(self, system => {
            system.clear();
            assemble::<true, _, _, _>(rod, world, trial, weights, range, system);
        });
    }

    /// Tangent of the elements of a range on their own nodes; the other rows and the residual are left as they are, or
    /// worse.
    pub fn assemble_part(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        trial: &Trial,
        weights: Weights,
        range: Range<usize>,
    ) {
        each!(self, system => {
            system.clear_part(&range);
            assemble::<true, _, _, _>(rod, world, trial, weights, range, system);
        });
    }

    /// Residual of the whole rod at a trial; the matrix stays as it is.
    pub fn forces(&mut self, rod: &Rod, world: &LineEnvironment, trial: &Trial) {
        let none = Weights { k: 0.0, c: 0.0, m: 0.0 };
        each!(self, system => {
            system.residual.fill(0.0);
            assemble::<false, _, _, _>(rod, world, trial, none, 0..rod.elements.len(), system);
        });
    }

    /// What all unknowns need from outside (N, N m).
    pub fn residuals(&self) -> &[f64] {
        each!(self, system => &system.residual)
    }

    /// Force a node needs from outside (N).
    #[cfg(test)]
    pub fn residual(&self, node: usize) -> Vector3<f64> {
        each!(self, system => system.residual_at(node))
    }

    /// Product of the matrix with a vector.
    pub fn times(&self, vector: &[f64], product: &mut [f64]) {
        each!(self, system => system.band.times(vector, product));
    }

    /// A column of the matrix, its diagonal in the middle place.
    pub fn column(&self, column: usize, entries: &mut [f64; MAX_BANDWIDTH]) {
        *entries = [0.0; MAX_BANDWIDTH];
        each!(self, system => system.band.column(column, MAX_BANDWIDTH / 2, entries));
    }

    /// Visits every entry of the stored rows of an end: row of the three, column, value.
    pub fn visit_end_rows(&self, side: usize, entry: impl FnMut(usize, usize, f64)) {
        each!(self, system => system.visit_end_rows(side, entry));
    }

    /// The block that couples a node's residual to the position of another.
    #[cfg(test)]
    pub fn block(&self, row: usize, column: usize) -> Matrix3<f64> {
        each!(self, system => system.block_at(row, column))
    }

    /// Keeps the rows of the end nodes before they are fixed.
    pub fn store_end_rows(&mut self) {
        each!(self, system => system.store_end_rows());
    }

    /// Keeps the residuals of the end nodes.
    pub fn store_end_residuals(&mut self) {
        each!(self, system => system.store_end_residuals());
    }

    /// Takes the kept residuals of the ends on to changed positions.
    pub fn update_end_residuals(&mut self, change: &[f64]) {
        each!(self, system => system.update_end_residuals(change));
    }

    /// Adds to the kept residuals of the ends.
    pub fn add_to_end_residuals(&mut self, by: &[Vector3<f64>; 2]) {
        each!(self, system => for (end, by) in system.ends.iter_mut().zip(by) {
            *end += by;
        });
    }

    /// Forces of the rod on its holders (N): the kept residuals, turned around.
    pub fn end_forces(&self) -> [Vector3<f64>; 2] {
        each!(self, system => system.ends.map(|force| -force))
    }

    /// Leaves the residual of a node to what holds it.
    pub fn drop_residual(&mut self, node: usize) {
        each!(self, system => {
            let first = system.stride() * node;
            system.residual[first..first + 3].fill(0.0);
        });
    }

    /// Makes the residual of a fixed node one that moves it by a change.
    pub fn prescribe_change(&mut self, node: usize, change: &Vector3<f64>) {
        each!(self, system => {
            let first = system.stride() * node;
            for (residual, c) in system.residual[first..first + 3].iter_mut().zip(change) {
                *residual = -c;
            }
        });
    }

    /// Takes the unknowns of a node as known.
    pub fn fix(&mut self, node: usize) {
        each!(self, system => for i in 0..3 {
            system.band.unit_row(system.stride() * node + i);
        });
    }

    /// Adds to the diagonal of a node and to its residual.
    pub fn add_node_inertia(&mut self, node: usize, by: f64, force: &Vector3<f64>) {
        each!(self, system => for i in 0..3 {
            let position = system.stride() * node + i;
            system.band.add(position, position, by);
            system.residual[position] += force[i];
        });
    }

    /// Adds to the block of a node and to its residual.
    pub fn add_node_stiffness(&mut self, node: usize, by: &Matrix3<f64>, force: &Vector3<f64>) {
        each!(self, system => for i in 0..3 {
            let position = system.stride() * node;
            for j in 0..3 {
                system.band.add(position + i, position + j, by[(i, j)]);
            }
            system.residual[position + i] += force[i];
        });
    }

    /// Factors: the number of negative pivots; the node whose pivot vanished otherwise.
    ///
    /// # Errors
    /// The node whose pivot vanished.
    pub fn factor(&mut self) -> Result<usize, usize> {
        each!(self, system => system.band.factor().map_err(|pivot| pivot.row / system.stride()))
    }

    /// The change that takes the residual away, by the factors.
    pub fn newton(&self, change: &mut [f64]) {
        each!(self, system => {
            for (c, r) in change.iter_mut().zip(&system.residual) {
                *c = -r;
            }
            system.band.solve(change);
        });
    }

    /// Solves for any right-hand side by the factors.
    pub fn solve(&self, right: &mut [f64]) {
        each!(self, system => system.band.solve(right));
    }

    /// Solves with the transpose by the factors: see [`windlass_base::band::BandMatrix::solve_transposed`].
    pub fn solve_transposed<const N: usize>(&self, right: &mut [[f64; N]], reach: (usize, usize)) {
        each!(self, system => system.band.solve_transposed(right, reach));
    }

    /// Node with the largest residual (N), of those without an end's motion; a residual that is no number comes first.
    pub fn largest_residual(&self, known: [bool; 2]) -> (usize, f64) {
        each!(self, system => {
            let stride = system.stride();
            let mut worst = (0, 0.0);
            let nodes = system.residual.len() / stride;
            for (node, residual) in system.residual.chunks_exact(stride).enumerate() {
                let known = (node == 0 && known[0]) || (node + 1 == nodes && known[1]);
                // the torque of a turn counts as the force it makes on an arm of a metre
                let looked_at = if known { &residual[3..] } else { residual };
                if looked_at.iter().any(|r| !r.is_finite()) {
                    return (node, f64::NAN);
                }
                let size = looked_at.iter().fold(0.0, |most: f64, r| most.max(r.abs()));
                if size > worst.1 {
                    worst = (node, size);
                }
            }
            worst
        })
    }
}
