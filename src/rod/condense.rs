//! What a rod is to what holds its ends: its forces there, and how they follow the motion of the ends.

use super::mesh::Rod;
use super::step::Solver;
use super::surroundings::World;
use super::system::Weights;
use nalgebra::Matrix6;

/// Places of the widest row of a band.
pub(super) const WIDEST: usize = 21;

/// How the forces of a rod on its two holders at the end of a step follow the motion of the ends at that time. Rows
/// and columns: end A's x, y, z, then end B's. Each is d(force on the holder)/d(position, velocity or acceleration)
/// with the other two and the start of the step as they are, all inner nodes in balance; of a step that was cut, it
/// is that of its last part.
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
    /// The tangent of the end forces at the last trial: the rod condensed to its ends. Columns of an end without a
    /// given motion are zero.
    ///
    /// None where the system cannot be solved, as it could in the trial.
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
        self.trial.exact = true;
        // how the unknowns beside an end feel each of its motions: the columns of the matrix
        let stride = self.work.stride();
        let size = stride * (last + 1);
        let end_place = [0, stride * last];
        let mut near = [[[[0.0; WIDEST]; 3]; 2]; 3];
        for (kind, weights) in near.iter_mut().zip(single) {
            let mut ranges = [0..2.min(last), last.saturating_sub(2)..last];
            if last <= 4 {
                ranges = [0..last, 0..last];
            }
            for (side, range) in ranges.into_iter().enumerate() {
                self.work.assemble(rod, world, &self.trial, weights, range);
                for (axis, column) in kind[side].iter_mut().enumerate() {
                    self.work.column(end_place[side] + axis, column);
                }
            }
        }
        self.work.assemble(rod, world, &self.trial, weights, 0..last);
        self.trial.exact = false;
        self.work.keep_rows();
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.fix(node);
            }
        }
        self.work.factor().ok()?;
        let mut made = [Matrix6::zeros(); 3];
        for (matrix, kind) in made.iter_mut().zip(&near) {
            for side in (0..2).filter(|s| known[*s]) {
                for (axis, column) in kind[side].iter().enumerate() {
                    let place = end_place[side] + axis;
                    let reach = WIDEST / 2;
                    let first = place.saturating_sub(reach);
                    let rows = first..(place + reach + 1).min(size);
                    let entry = |row: usize| column[row + reach - place];
                    let held = |row: usize| (0..2).any(|s| known[s] && (end_place[s]..end_place[s] + 3).contains(&row));
                    self.change.fill(0.0);
                    for row in rows.clone().filter(|r| !held(*r)) {
                        self.change[row] = -entry(row);
                    }
                    self.work.solve(&mut self.change);
                    for other in (0..2).filter(|o| known[*o]) {
                        let mut force = self.work.ends_by(other, &self.change);
                        // the holders' own part, without the nodes between
                        for (i, f) in force.iter_mut().enumerate() {
                            let row = end_place[other] + i;
                            if rows.contains(&row) {
                                *f += entry(row);
                            }
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
