//! The system of a rod by its kind: as narrow a band as its stiffness needs.

use super::assemble::{System, Trial, Weights, assemble};
use super::mesh::Rod;
use super::surroundings::World;
use nalgebra::{Matrix3, Vector3};
use std::ops::Range;

/// The linear system of one iteration.
#[derive(Clone, Debug)]
pub(super) enum Workspace {
    /// No bending stiffness: two nodes an equation.
    Rope(System<3, 5, 11>),
    /// Bending: three nodes an equation.
    Beam(System<3, 8, 17>),
}

/// Calls the same with whichever system is there.
macro_rules! each {
    ($workspace:expr, $system:ident => $body:expr) => {
        match $workspace {
            Workspace::Rope($system) => $body,
            Workspace::Beam($system) => $body,
        }
    };
}

impl Workspace {
    /// The system that fits a rod.
    pub fn of(rod: &Rod) -> Self {
        if rod.elements.iter().all(|e| e.bending == 0.0) {
            Workspace::Rope(System::new(rod.nodes()))
        } else {
            Workspace::Beam(System::new(rod.nodes()))
        }
    }

    /// Residual and tangent of the whole rod at a trial.
    pub fn assemble(&mut self, rod: &Rod, world: &World, trial: &Trial, weights: Weights, range: Range<usize>) {
        each!(self, system => {
            system.clear();
            assemble::<true, _, _, _>(rod, world, trial, weights, range, system);
        });
    }

    /// Residual of the whole rod at a trial; the matrix stays as it is.
    pub fn forces(&mut self, rod: &Rod, world: &World, trial: &Trial) {
        let none = Weights { k: 0.0, c: 0.0, m: 0.0 };
        each!(self, system => {
            system.residual.fill(0.0);
            assemble::<false, _, _, _>(rod, world, trial, none, 0..rod.elements.len(), system);
        });
    }

    /// Force a node needs from outside (N).
    #[cfg(test)]
    pub fn residual(&self, node: usize) -> Vector3<f64> {
        each!(self, system => system.residual_at(node))
    }

    /// Product of the rows of a node with a vector.
    pub fn rows_times(&self, node: usize, vector: &[f64]) -> Vector3<f64> {
        each!(self, system => system.rows_times(node, vector))
    }

    /// The block that couples a node's residual to the position of another.
    pub fn block(&self, row: usize, column: usize) -> Matrix3<f64> {
        each!(self, system => system.block_at(row, column))
    }

    /// Keeps the rows of the end nodes before they are fixed.
    pub fn keep_rows(&mut self) {
        each!(self, system => system.keep_rows());
    }

    /// Keeps the residuals of the end nodes.
    pub fn keep_ends(&mut self) {
        each!(self, system => system.keep_ends());
    }

    /// Takes the kept residuals of the ends on to changed positions.
    pub fn carry_ends(&mut self, change: &[f64]) {
        each!(self, system => system.carry_ends(change));
    }

    /// Forces of the rod on its holders (N): the kept residuals, turned around.
    pub fn end_forces(&self) -> [Vector3<f64>; 2] {
        each!(self, system => system.ends.map(|force| -force))
    }

    /// Leaves the residual of a node to what holds it.
    pub fn drop_residual(&mut self, node: usize) {
        each!(self, system => system.residual[3 * node..3 * node + 3].fill(0.0));
    }

    /// Takes the unknowns of a node as known.
    pub fn fix(&mut self, node: usize) {
        each!(self, system => for i in 0..3 {
            system.band.unit_row(3 * node + i);
        });
    }

    /// Adds to the diagonal of a node and to its residual.
    pub fn stiffen(&mut self, node: usize, by: f64, force: &Vector3<f64>) {
        each!(self, system => for i in 0..3 {
            system.band.add(3 * node + i, 3 * node + i, by);
            system.residual[3 * node + i] += force[i];
        });
    }

    /// Factors: the number of negative pivots; the node whose pivot vanished otherwise.
    pub fn factor(&mut self) -> Result<usize, usize> {
        each!(self, system => system.band.factor().map_err(|row| row / 3))
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

    /// Node with the largest residual (N), of those without an end's motion; a residual that is no number comes first.
    pub fn worst(&self, known: [bool; 2]) -> (usize, f64) {
        each!(self, system => {
            let nodes = system.residual.len() / 3;
            let mut worst = (0, 0.0);
            for node in 0..nodes {
                if (node == 0 && known[0]) || (node + 1 == nodes && known[1]) {
                    continue;
                }
                let size = system.residual_at(node).amax();
                let nan = system.residual[3 * node..3 * node + 3].iter().any(|r| !r.is_finite());
                if nan {
                    return (node, f64::NAN);
                }
                if size > worst.1 {
                    worst = (node, size);
                }
            }
            worst
        })
    }
}
