//! What a rod is to what holds its ends: its forces there, and how they follow the motion of the ends.

use super::assemble::Weights;
use super::mesh::Rod;
use super::step::Solver;
use super::surroundings::World;
use nalgebra::{Matrix3, Matrix6, Vector3};

/// How the forces of a rod on its two holders at the end of a step follow the motion of the ends at that time. Rows and
/// columns: end A's x, y, z, then end B's. Each is d(force on the holder)/d(position, velocity or acceleration) with the other two and
/// the start of the step as they are, all inner nodes in balance.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndTangent {
    /// By position (N/m).
    pub position: Matrix6<f64>,
    /// By velocity (N s/m).
    pub velocity: Matrix6<f64>,
    /// By acceleration (kg).
    pub acceleration: Matrix6<f64>,
}

impl EndTangent {
    /// The one tangent of a body whose velocity and acceleration follow its position as `c` and `m` times it.
    pub fn by_position(&self, c: f64, m: f64) -> Matrix6<f64> {
        self.position + self.velocity * c + self.acceleration * m
    }
}

impl Solver {
    /// The tangent of the end forces at the last trial: the rod condensed to its ends. Columns of an end without a given motion are
    /// zero.
    ///
    /// # Errors
    /// None if the trial before it converged; a system that cannot be solved gives `None`.
    pub fn end_tangent(&mut self, rod: &Rod, world: &World) -> Option<EndTangent> {
        let last = rod.elements.len();
        let weights = self.weights;
        let single = [
            Weights { k: 1.0, c: 0.0, m: 0.0 },
            Weights { k: 0.0, c: 1.0, m: 0.0 },
            Weights { k: 0.0, c: 0.0, m: 1.0 },
        ];
        let known = self.trial.ends.map(|e| e.motion.is_some());
        // the trial's own positions are at hand in the state that follows it
        self.follow_next();
        // how the nodes beside an end feel its motion, by kind of motion
        let mut near = [[[Matrix3::<f64>::zeros(); 3]; 2]; 3];
        for (kind, weights) in near.iter_mut().zip(single) {
            let mut ranges = [0..2.min(last), last.saturating_sub(2)..last];
            if last <= 4 {
                ranges = [0..last, 0..last];
            }
            for (side, range) in ranges.into_iter().enumerate() {
                self.work.assemble(rod, world, &self.trial, weights, range);
                let end = if side == 0 { 0 } else { last };
                for (d, block) in kind[side].iter_mut().enumerate() {
                    if let Some(node) = inward(side, d, last) {
                        *block = self.work.block(node, end);
                    }
                }
            }
        }
        self.work.assemble(rod, world, &self.trial, weights, 0..last);
        // how an end feels the nodes beside it
        let mut felt = [[Matrix3::<f64>::zeros(); 3]; 2];
        for (side, blocks) in felt.iter_mut().enumerate() {
            let end = if side == 0 { 0 } else { last };
            for (d, block) in blocks.iter_mut().enumerate() {
                if let Some(node) = inward(side, d, last) {
                    *block = self.work.block(end, node);
                }
            }
        }
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.fix(node);
            }
        }
        self.work.factor().ok()?;
        let mut made = [Matrix6::zeros(); 3];
        for (matrix, kind) in made.iter_mut().zip(&near) {
            for side in (0..2).filter(|s| known[*s]) {
                for axis in 0..3 {
                    self.change.fill(0.0);
                    for (d, block) in kind[side].iter().enumerate().skip(1) {
                        let Some(node) = inward(side, d, last) else { continue };
                        if (node == 0 && known[0]) || (node == last && known[1]) {
                            continue;
                        }
                        for i in 0..3 {
                            self.change[3 * node + i] = -block[(i, axis)];
                        }
                    }
                    self.work.solve(&mut self.change);
                    for (other, blocks) in felt.iter().enumerate().filter(|(o, _)| known[*o]) {
                        let mut force = Vector3::zeros();
                        for (d, block) in blocks.iter().enumerate().skip(1) {
                            let Some(node) = inward(other, d, last) else { continue };
                            force += block * Vector3::from_column_slice(&self.change[3 * node..3 * node + 3]);
                        }
                        // the holder's own part, and across a rod of one or two elements the other holder's
                        if other == side {
                            force += kind[side][0].column(axis);
                        } else if let Some(block) = kind[side].get(last) {
                            force += block.column(axis);
                        }
                        matrix.fixed_view_mut::<3, 1>(3 * other, 3 * side + axis).copy_from(&-force);
                    }
                }
            }
        }
        let [position, velocity, acceleration] = made;
        Some(EndTangent { position, velocity, acceleration })
    }
}

/// The node `d` places inward of an end.
fn inward(side: usize, d: usize, last: usize) -> Option<usize> {
    if d > last {
        None
    } else if side == 0 {
        Some(d)
    } else {
        Some(last - d)
    }
}
