//! What a rod is to what holds its ends: its forces and moments there, and how they follow the motion of the ends.

use super::environment::LineEnvironment;
use super::hinges::{Clamp, clamp};
use super::mesh::Rod;
use super::system::Weights;
use super::trial::Trial;
use super::workspace::Workspace;
use nalgebra::SMatrix;

/// Places of the widest row of a band.
pub(super) const MAX_BANDWIDTH: usize = 21;

/// Forces and moments of two ends by their translations and rotations.
pub type Matrix12 = SMatrix<f64, 12, 12>;

/// How the forces and moments of a rod on its two holders follow the motion of the holders at that time, all inner
/// nodes in balance.
///
/// Rows: force x, y, z and moment x, y, z about the end on end A's holder, then end B's. Columns: translation x, y, z
/// of end A and rotation of its holder, which turns direction and side of a clamped end, then end B's; all by global
/// axes, a rotation by its small vector from where the holder now is. Each matrix is the derivative by one of
/// position, velocity and acceleration with the other two and the start of the step as they are. Forces follow a
/// rotation by position alone. What an end without a given motion has of forces and translations is zero, as are
/// moments and rotations where nothing clamps the rod.
///
/// Left out is how the fluid changes from place to place: it is taken as it is where the nodes are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct EndTangent {
    /// By position and angle (N/m, N, N m).
    pub position: Matrix12,
    /// By velocity (N s/m, N s).
    pub velocity: Matrix12,
    /// By acceleration (kg, kg m).
    pub acceleration: Matrix12,
}

impl EndTangent {
    /// The one tangent (N/m) of a body whose velocity and acceleration follow its position as `c` and `m` times it.
    pub fn by_position(&self, c: f64, m: f64) -> Matrix12 {
        self.position + self.velocity * c + self.acceleration * m
    }
}

/// Condensation of the current tangent to the ends: its columns of the ends, and the condensed tangent.
#[derive(Clone, Debug)]
pub(super) struct EndCondensation {
    /// How the unknowns beside an end feel its position, velocity and acceleration: kind, side, axis; a column of the
    /// matrix with its diagonal in the middle place.
    pub columns: [[EndColumns; 2]; 3],
    /// The same by all three together, as the scheme makes them follow each other.
    together: [EndColumns; 2],
    /// Whether the columns of each end are there.
    pub ready: [bool; 2],
    /// The condensed tangent asked for last.
    condensed: Option<Box<EndTangent>>,
    /// These ends, where it is the tangent by the columns that are there: of a rod that nothing clamps.
    condensed_sides: Option<[bool; 2]>,
    /// How far a node may have moved since the matrix was factored (m).
    pub moved: f64,
    /// Workspace for the parts of a matrix beside its ends, which keeps the current factors.
    spare_work: Workspace,
    /// Solutions with the transpose of the matrix.
    adjoint: Vec<f64>,
}

/// Columns of the matrix by the three translations of an end.
type EndColumns = [[f64; MAX_BANDWIDTH]; 3];

/// Share of the shortest element that nodes may have moved since a matrix was factored that is as good as a new one.
pub(super) const MAX_REUSE_MOVE: f64 = 1e-3;

impl EndCondensation {
    /// Memory for a system of so many unknowns.
    pub fn new(work: &Workspace, size: usize) -> Self {
        let none = [[[0.0; MAX_BANDWIDTH]; 3]; 2];
        EndCondensation {
            columns: [none; 3],
            together: none,
            ready: [false; 2],
            condensed: None,
            condensed_sides: None,
            moved: f64::INFINITY,
            spare_work: work.clone(),
            adjoint: vec![0.0; 6 * size],
        }
    }

    /// Finds the columns of the ends that are asked about, where the trial is; at rest velocities and accelerations have none.
    pub fn find_columns(
        &mut self,
        (rod, world): (&Rod, &LineEnvironment),
        trial: &Trial,
        weights: Weights,
        at_rest: bool,
        asked: [bool; 2],
    ) {
        let last = rod.elements.len();
        let known = trial.ends.map(|e| e.motion.is_some());
        let stride = self.spare_work.stride();
        let reach = self.spare_work.bandwidth().min(last);
        let single = [Weights { k: 0.0, c: 1.0, m: 0.0 }, Weights { k: 0.0, c: 0.0, m: 1.0 }];
        let shares = [weights.c, weights.m];
        let [by_position, others @ ..] = &mut self.columns;
        for (side, range) in [(0, 0..reach), (1, last - reach..last)] {
            if !asked[side] || self.ready[side] {
                continue;
            }
            by_position[side] = self.together[side];
            for ((kind, single), share) in others.iter_mut().zip(single).zip(shares) {
                kind[side] = [[0.0; MAX_BANDWIDTH]; 3];
                if !known[side] || at_rest {
                    continue;
                }
                self.spare_work.assemble_part(rod, world, trial, single, range.clone());
                for axis in 0..3 {
                    let column = &mut kind[side][axis];
                    self.spare_work.column(side * stride * last + axis, column);
                    for (p, other) in by_position[side][axis].iter_mut().zip(column) {
                        *p -= share * *other;
                    }
                }
            }
        }
        self.ready = [0, 1].map(|side| self.ready[side] || asked[side]);
    }

    /// Condenses the current matrix to the ends that are asked about.
    pub fn condense(&mut self, rod: &Rod, trial: &Trial, work: &Workspace, sides: [bool; 2]) -> Option<&EndTangent> {
        let clamps = [0, 1].map(|side| clamp(rod, trial, side));
        let pinned = clamps.iter().all(Option::is_none);
        if pinned && self.condensed_sides == Some(sides) {
            return self.condensed.as_deref();
        }
        let mut made = self.condensed.take().unwrap_or_default();
        let EndTangent { position, velocity, acceleration } = &mut *made;
        let mut kinds = [position, velocity, acceleration];
        kinds.iter_mut().for_each(|kind| kind.fill(0.0));
        for side in (0..2).filter(|side| sides[*side]) {
            let held = trial.ends[side].motion.is_some();
            match &clamps[side] {
                Some(_) => self.add_end_columns::<6>((trial, work), (side, sides), &clamps, &mut kinds),
                None if held => self.add_end_columns::<3>((trial, work), (side, sides), &clamps, &mut kinds),
                None => {}
            }
        }
        (self.condensed, self.condensed_sides) = (Some(made), pinned.then_some(sides));
        self.condensed.as_deref()
    }

    /// Keeps of a matrix that has just been assembled what is asked of it later: the rows and columns of the ends.
    pub fn reset(&mut self, work: &mut Workspace) {
        (self.ready, self.condensed_sides) = ([false; 2], None);
        work.store_end_rows();
        let first_rows = [0, work.residuals().len() - work.stride()];
        for (columns, first_row) in self.together.iter_mut().zip(first_rows) {
            for (axis, column) in columns.iter_mut().enumerate() {
                work.column(first_row + axis, column);
            }
        }
    }

    /// The rows of an end: its force, and with `N` = 6 its moment.
    ///
    /// With outputs F(u, p) and balance R(u, p) = 0 of unknowns u and motions p, dF/dp = F_p - L R_p where L R_u =
    /// F_u: a row of the tangent is one solution with the transpose, whatever the number of motions.
    fn add_end_columns<const N: usize>(
        &mut self,
        (trial, work): (&Trial, &Workspace),
        (side, sides): (usize, [bool; 2]),
        clamps: &[Option<Clamp>; 2],
        made: &mut [&mut Matrix12; 3],
    ) {
        let stride = work.stride();
        let size = work.residuals().len();
        let first_rows = [0, size - stride];
        let known = trial.ends.map(|e| e.motion.is_some());
        let end_of = |row: usize| (0..2).find(|s| known[*s] && (first_rows[*s]..first_rows[*s] + 3).contains(&row));
        // where the edge beside an end and its turn have their unknowns, and with what sign
        let edge = |side: usize| {
            let first = if side == 0 { 0 } else { size - 2 * stride };
            let axis = move |i: usize| [(i, first + stride + i, 1.0), (i, first + i, -1.0)];
            let turn = (stride > 3).then_some((3, first + 3, 1.0));
            (0..3).flat_map(axis).chain(turn)
        };
        let (right, _) = self.adjoint.as_chunks_mut::<N>();
        let right = &mut right[..size];
        // rows beside end A, where nothing is asked or answered beyond them
        let beside = 2 * stride + MAX_BANDWIDTH / 2;
        let wanted = if sides[1] { size } else { beside };
        let filled = if side == 0 { beside } else { size };
        // beyond these rows nothing is read
        right[..size.min(filled.max(wanted) + MAX_BANDWIDTH)].fill([0.0; N]);
        if known[side] {
            work.visit_end_rows(side, |i, column, value| right[column][i] = -value);
        }
        if let Some(clamp) = clamps[side].as_ref().filter(|_| N == 6) {
            for (local, column, sign) in edge(side) {
                for k in 0..3 {
                    right[column][3 + k] += sign * clamp.moment_by_near[(k, local)];
                }
            }
        }
        // the moment feels the place of a held end itself
        let own = first_rows.map(|first| [0, 1, 2].map(|axis| right[first + axis]));
        work.solve_transposed(right, (filled, wanted));
        // what an entry of R_p does: on an inner row through the solution, on a row of this end as its own force
        let add = |column: &mut [f64; N], row: usize, entry: f64| match end_of(row) {
            None => {
                for (c, y) in column.iter_mut().zip(&right[row]) {
                    *c -= y * entry;
                }
            }
            Some(end) if end == side => column[row - first_rows[side]] -= entry,
            Some(_) => {}
        };
        for other in (0..2).filter(|other| sides[*other]) {
            for (kind, matrix) in made.iter_mut().enumerate().filter(|_| known[other]) {
                for axis in 0..3 {
                    let mut column = [0.0; N];
                    for (i, entry) in self.columns[kind][other][axis].iter().enumerate() {
                        let row =
                            (first_rows[other] + axis + i).checked_sub(MAX_BANDWIDTH / 2).filter(|row| *row < size);
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
