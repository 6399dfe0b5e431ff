//! What a rod is to what holds its ends: its forces and moments there, and how they follow the motion of the ends.

use super::hinges::{Clamp, clamp};
use super::mesh::Rod;
use super::step::{At, Solver};
use super::surroundings::World;
use super::system::Weights;
use nalgebra::SMatrix;

/// Places of the widest row of a band.
pub(super) const WIDEST: usize = 21;

/// Forces and moments of two ends by their translations and rotations.
pub type Twelve = SMatrix<f64, 12, 12>;

/// How the forces and moments of a rod on its two holders follow the motion of the holders at that time, all inner
/// nodes in balance.
///
/// Rows: force x, y, z and moment x, y, z about the end on end A's holder, then end B's. Columns: translation x, y, z
/// of end A and rotation of its holder, which turns direction and side of a clamped end, then end B's; all by global
/// axes, a rotation by its small vector from where the holder now is. Each matrix is the derivative by one of
/// position, velocity and acceleration with the other two and the start of the step as they are. Forces follow a
/// rotation by position alone. Columns and rows of an end without a given motion are zero, as are those of moments and
/// rotations where nothing clamps the rod.
///
/// Left out is how the fluid changes from place to place: it is taken as it is where the nodes are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndTangent {
    /// By position and angle (N/m, N, N m).
    pub position: Twelve,
    /// By velocity (N s/m, N s).
    pub velocity: Twelve,
    /// By acceleration (kg, kg m).
    pub acceleration: Twelve,
}

impl EndTangent {
    /// The one tangent of a body whose velocity and acceleration follow its position as `c` and `m` times it.
    pub fn by_position(&self, c: f64, m: f64) -> Twelve {
        self.position + self.velocity * c + self.acceleration * m
    }
}

/// The matrix at the last trial, as the motions of the ends enter it.
#[derive(Clone, Debug)]
pub(super) struct Near {
    /// How the unknowns beside an end feel its position, velocity and acceleration: kind, side, axis; a column of the
    /// matrix with its diagonal in the middle place.
    pub columns: [[[[f64; WIDEST]; 3]; 2]; 3],
    /// Whether they and the factors at hand are those of the last trial.
    pub ready: bool,
}

impl Near {
    pub fn new() -> Self {
        Near { columns: [[[[0.0; WIDEST]; 3]; 2]; 3], ready: false }
    }
}

impl Solver {
    /// The tangent of the end forces at the last [`Solver::trial`], before it is accepted, or at rest after
    /// [`Solver::statics`], when velocities and accelerations have no part in it: the rod condensed to its ends. Of a
    /// step that was cut it is that of its last part.
    ///
    /// None where there is no trial, or the system cannot be solved, as it could in the trial.
    pub fn end_tangent(&mut self, rod: &Rod, world: &World) -> Option<EndTangent> {
        self.linearise(rod, world)?;
        let clamps = [0, 1].map(|side| clamp(rod, &self.trial, side));
        let zero = Twelve::zeros();
        let mut made = [zero; 3];
        for side in 0..2 {
            let held = self.trial.ends[side].motion.is_some();
            match &clamps[side] {
                Some(_) => self.feel::<6>(side, &clamps, &mut made),
                None if held => self.feel::<3>(side, &clamps, &mut made),
                None => {}
            }
        }
        let [position, velocity, acceleration] = made;
        Some(EndTangent { position, velocity, acceleration })
    }

    /// Assembles and factors the tangent where the last trial ended, with the columns of the ends.
    pub(super) fn linearise(&mut self, rod: &Rod, world: &World) -> Option<()> {
        let last = rod.elements.len();
        let weights = self.weights;
        let single = [
            Weights { k: 1.0, c: 0.0, m: 0.0 },
            Weights { k: 0.0, c: 1.0, m: 0.0 },
            Weights { k: 0.0, c: 0.0, m: 1.0 },
        ];
        let kinds = match self.at {
            At::Nowhere => return None,
            // the trial's own positions are at hand in the state that follows it
            At::Trial => {
                self.follow_next();
                3
            }
            At::Rest => {
                self.trial.still = true;
                1
            }
        };
        let known = self.trial.ends.map(|e| e.motion.is_some());
        self.near = Near::new();
        self.trial.exact = true;
        let stride = self.work.stride();
        let ranges = if last <= 4 { [0..last, 0..last] } else { [0..2, last - 2..last] };
        for (kind, weights) in self.near.columns.iter_mut().zip(single).take(kinds) {
            for (side, range) in ranges.iter().enumerate().filter(|(side, _)| known[*side]) {
                self.work.assemble_part(rod, world, &self.trial, weights, range.clone());
                for (axis, column) in kind[side].iter_mut().enumerate() {
                    self.work.column(side * stride * last + axis, column);
                }
            }
        }
        self.work.assemble(rod, world, &self.trial, weights, 0..last);
        (self.trial.exact, self.trial.still) = (false, false);
        self.work.keep_rows();
        for (side, node) in [(0, 0), (1, last)] {
            if known[side] {
                self.work.fix(node);
            }
        }
        self.work.factor().ok()?;
        self.near.ready = true;
        Some(())
    }

    /// The rows of an end: its force, and with `N` = 6 its moment.
    ///
    /// With outputs F(u, p) and balance R(u, p) = 0 of unknowns u and motions p, dF/dp = F_p - L R_p where L R_u =
    /// F_u: a row of the tangent is one solution with the transpose, whatever the number of motions.
    fn feel<const N: usize>(&mut self, side: usize, clamps: &[Option<Clamp>; 2], made: &mut [Twelve; 3]) {
        let stride = self.work.stride();
        let size = self.change.len();
        let place = [0, size - stride];
        let known = self.trial.ends.map(|e| e.motion.is_some());
        let end_of = |row: usize| (0..2).find(|s| known[*s] && (place[*s]..place[*s] + 3).contains(&row));
        // where the edge beside an end and its turn have their unknowns, and with what sign
        let edge = |side: usize| {
            let first = if side == 0 { 0 } else { size - 2 * stride };
            let axis = move |i: usize| [(i, first + stride + i, 1.0), (i, first + i, -1.0)];
            let turn = (stride > 3).then_some((3, first + 3, 1.0));
            (0..3).flat_map(axis).chain(turn)
        };
        let (right, _) = self.adjoint.as_chunks_mut::<N>();
        let right = &mut right[..size];
        right.fill([0.0; N]);
        if known[side] {
            self.work.kept_rows(side, |i, column, value| right[column][i] = -value);
        }
        if let Some(clamp) = clamps[side].as_ref().filter(|_| N == 6) {
            for (local, column, sign) in edge(side) {
                for k in 0..3 {
                    right[column][3 + k] += sign * clamp.moment_by_near[(k, local)];
                }
            }
        }
        // the moment feels the place of a held end itself
        let own = place.map(|first| [0, 1, 2].map(|axis| right[first + axis]));
        let first = if side == 0 { 0 } else { size.saturating_sub(stride + WIDEST / 2) };
        self.work.solve_transposed(right, first);
        // what an entry of R_p does: on an inner row through the solution, on a row of this end as its own force
        let add = |column: &mut [f64; N], row: usize, entry: f64| match end_of(row) {
            None => {
                for (c, y) in column.iter_mut().zip(&right[row]) {
                    *c -= y * entry;
                }
            }
            Some(end) if end == side => column[row - place[side]] -= entry,
            Some(_) => {}
        };
        for other in 0..2 {
            for (kind, matrix) in made.iter_mut().enumerate().filter(|_| known[other]) {
                for axis in 0..3 {
                    let mut column = [0.0; N];
                    for (i, entry) in self.near.columns[kind][other][axis].iter().enumerate() {
                        let row = (place[other] + axis + i).checked_sub(WIDEST / 2).filter(|row| *row < size);
                        if let Some(row) = row.filter(|_| *entry != 0.0) {
                            add(&mut column, row, *entry);
                        }
                    }
                    if kind == 0 {
                        for k in 3..N {
                            column[k] += own[other][axis][k];
                        }
                    }
                    for (k, value) in column.iter().enumerate() {
                        matrix[(6 * side + k, 6 * other + axis)] = *value;
                    }
                }
            }
            if let Some(clamp) = &clamps[other] {
                for axis in 0..3 {
                    let mut column = [0.0; N];
                    for (local, row, sign) in edge(other) {
                        add(&mut column, row, sign * clamp.near_by_rotation[(local, axis)]);
                    }
                    for k in (3..N).filter(|_| other == side) {
                        column[k] += clamp.moment_by_rotation[(k - 3, axis)];
                    }
                    for (k, value) in column.iter().enumerate() {
                        made[0][(6 * side + k, 6 * other + 3 + axis)] = *value;
                    }
                }
            }
        }
    }
}
