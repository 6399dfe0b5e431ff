//! What a rod is to what holds its ends: its forces and moments there, and how they follow the motion of the ends.

use super::environment::LineEnvironment;
use super::hinges::{Clamp, clamp};
use super::mesh::Rod;
use super::step::{RodSolver, SolverPhase};
use super::system::Weights;
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
    /// The one tangent of a body whose velocity and acceleration follow its position as `c` and `m` times it.
    pub fn by_position(&self, c: f64, m: f64) -> Matrix12 {
        self.position + self.velocity * c + self.acceleration * m
    }
}

/// Jacobian columns of the ends in the current tangent matrix, and the tangent condensed to them.
#[derive(Clone, Debug)]
pub(super) struct EndJacobian {
    /// How the unknowns beside an end feel its position, velocity and acceleration: kind, side, axis; a column of the
    /// matrix with its diagonal in the middle place.
    pub columns: [[EndColumns; 2]; 3],
    /// The same by all three together, as the scheme makes them follow each other.
    pub together: [EndColumns; 2],
    /// Whether the columns of each end are there.
    pub ready: [bool; 2],
    /// The condensed tangent asked for last.
    pub condensed: Option<Box<EndTangent>>,
    /// These ends, where it is the tangent by the columns that are there: of a rod that nothing clamps.
    pub condensed_sides: Option<[bool; 2]>,
    /// How far a node may have moved since the matrix was factored (m).
    pub moved: f64,
}

/// Columns of the matrix by the three translations of an end.
type EndColumns = [[f64; MAX_BANDWIDTH]; 3];

/// Share of the shortest element that nodes may have moved since a matrix was factored that is as good as a new one.
const MAX_REUSE_MOVE: f64 = 1e-3;

impl EndJacobian {
    pub fn new() -> Self {
        let none = [[[0.0; MAX_BANDWIDTH]; 3]; 2];
        EndJacobian {
            columns: [none; 3],
            together: none,
            ready: [false; 2],
            condensed: None,
            condensed_sides: None,
            moved: f64::INFINITY,
        }
    }
}

impl RodSolver {
    /// The tangent of the end forces at the last [`RodSolver::trial`], before it is accepted, or at rest after
    /// [`RodSolver::statics`], when velocities and accelerations have no part in it: the rod condensed to its ends. Of a
    /// step that was cut it is that of its last part.
    ///
    /// None where there is no trial, or the system cannot be solved, as it could in the trial.
    pub fn end_tangent(&mut self, rod: &Rod, world: &LineEnvironment) -> Option<&EndTangent> {
        self.in_local_coordinates(world, |solver, world, _| solver.linearise(rod, world, true, [true; 2]))?;
        self.condense(rod, [true; 2])
    }

    /// The same by the factors the trial has left, as long as its nodes have moved by less than a thousandth of the
    /// shortest element since, with friction by its secant: for a body's Newton iteration, which converges by it as
    /// well, at a quarter of the cost. The trial's forces stay what they are.
    pub fn end_tangent_from_factors(&mut self, rod: &Rod, world: &LineEnvironment) -> Option<&EndTangent> {
        self.end_tangent_of_sides(rod, world, [true; 2])
    }

    /// The same, of which only the rows and columns of some ends are asked for, A and B: an end in the ground feels nothing and
    /// does not move. The others are zero. That of end A alone costs next to nothing.
    pub fn end_tangent_of_sides(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        sides: [bool; 2],
    ) -> Option<&EndTangent> {
        self.in_local_coordinates(world, |solver, world, _| solver.linearise(rod, world, false, sides))?;
        self.condense(rod, sides)
    }

    /// Condenses the current matrix to the ends that are asked about.
    fn condense(&mut self, rod: &Rod, sides: [bool; 2]) -> Option<&EndTangent> {
        let clamps = [0, 1].map(|side| clamp(rod, &self.trial, side));
        let pinned = clamps.iter().all(Option::is_none);
        if pinned && self.end_jacobian.condensed_sides == Some(sides) {
            return self.end_jacobian.condensed.as_deref();
        }
        let mut made = self.end_jacobian.condensed.take().unwrap_or_default();
        let EndTangent { position, velocity, acceleration } = &mut *made;
        let mut kinds = [position, velocity, acceleration];
        kinds.iter_mut().for_each(|kind| kind.fill(0.0));
        for side in (0..2).filter(|side| sides[*side]) {
            let held = self.trial.ends[side].motion.is_some();
            match &clamps[side] {
                Some(_) => self.add_end_columns::<6>((side, sides), &clamps, &mut kinds),
                None if held => self.add_end_columns::<3>((side, sides), &clamps, &mut kinds),
                None => {}
            }
        }
        (self.end_jacobian.condensed, self.end_jacobian.condensed_sides) = (Some(made), pinned.then_some(sides));
        self.end_jacobian.condensed.as_deref()
    }

    /// Sees to factors of the matrix where the last trial ended, or unless `exact` near enough, and to the columns of
    /// the ends that are asked about.
    pub(super) fn linearise(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        exact: bool,
        asked: [bool; 2],
    ) -> Option<()> {
        if self.phase == SolverPhase::Idle {
            return None;
        }
        let at_rest = self.phase == SolverPhase::Rest;
        let close = !exact && !at_rest && self.end_jacobian.moved <= MAX_REUSE_MOVE * rod.shortest();
        let ready = close && (0..2).all(|side| self.end_jacobian.ready[side] || !asked[side]);
        // the trial's own positions are at hand in the state that follows it; a rope, which nothing clamps, needs them for a matrix alone
        let asks_nothing = ready && matches!(self.work, Workspace::Rope(_));
        if !(at_rest || asks_nothing) {
            self.set_trial_from_next();
        }
        if !ready {
            (self.trial.exact_friction_tangent, self.trial.is_static) = (!close, at_rest);
            let made = self.columns(rod, world, (close, at_rest), asked);
            (self.trial.exact_friction_tangent, self.trial.is_static) = (false, false);
            made?;
        }
        Some(())
    }

    /// Factors the matrix where the trial is unless those at hand are `close`, and finds the columns of the ends.
    fn columns(
        &mut self,
        rod: &Rod,
        world: &LineEnvironment,
        (close, at_rest): (bool, bool),
        asked: [bool; 2],
    ) -> Option<()> {
        let last = rod.elements.len();
        let known = self.trial.ends.map(|e| e.motion.is_some());
        if !close {
            self.end_jacobian.moved = f64::INFINITY;
            self.work.assemble(rod, world, &self.trial, self.weights, 0..last);
            self.reset_end_jacobian();
            for (side, node) in [(0, 0), (1, last)] {
                if known[side] {
                    self.work.fix(node);
                }
            }
            self.work.factor().ok()?;
            self.end_jacobian.moved = 0.0;
        }
        let stride = self.work.stride();
        let reach = self.work.bandwidth().min(last);
        let single = [Weights { k: 0.0, c: 1.0, m: 0.0 }, Weights { k: 0.0, c: 0.0, m: 1.0 }];
        let shares = [self.weights.c, self.weights.m];
        let [by_position, others @ ..] = &mut self.end_jacobian.columns;
        for (side, range) in [(0, 0..reach), (1, last - reach..last)] {
            if !asked[side] || self.end_jacobian.ready[side] {
                continue;
            }
            by_position[side] = self.end_jacobian.together[side];
            for ((kind, weights), share) in others.iter_mut().zip(single).zip(shares) {
                kind[side] = [[0.0; MAX_BANDWIDTH]; 3];
                if !known[side] || at_rest {
                    continue;
                }
                self.spare_work.assemble_part(rod, world, &self.trial, weights, range.clone());
                for axis in 0..3 {
                    let column = &mut kind[side][axis];
                    self.spare_work.column(side * stride * last + axis, column);
                    for (p, other) in by_position[side][axis].iter_mut().zip(column) {
                        *p -= share * *other;
                    }
                }
            }
        }
        self.end_jacobian.ready = [0, 1].map(|side| self.end_jacobian.ready[side] || asked[side]);
        Some(())
    }

    /// Keeps of a matrix that has just been assembled what is asked of it later: the rows and columns of the ends.
    pub(super) fn reset_end_jacobian(&mut self) {
        (self.end_jacobian.ready, self.end_jacobian.condensed_sides) = ([false; 2], None);
        self.work.store_end_rows();
        let place = [0, self.change.len() - self.work.stride()];
        for (columns, place) in self.end_jacobian.together.iter_mut().zip(place) {
            for (axis, column) in columns.iter_mut().enumerate() {
                self.work.column(place + axis, column);
            }
        }
    }

    /// The rows of an end: its force, and with `N` = 6 its moment.
    ///
    /// With outputs F(u, p) and balance R(u, p) = 0 of unknowns u and motions p, dF/dp = F_p - L R_p where L R_u =
    /// F_u: a row of the tangent is one solution with the transpose, whatever the number of motions.
    fn add_end_columns<const N: usize>(
        &mut self,
        (side, sides): (usize, [bool; 2]),
        clamps: &[Option<Clamp>; 2],
        made: &mut [&mut Matrix12; 3],
    ) {
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
            self.work.visit_end_rows(side, |i, column, value| right[column][i] = -value);
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
        // rows beside end A, where nothing is asked or answered beyond them
        let beside = 2 * stride + MAX_BANDWIDTH / 2;
        let wanted = if sides[1] { size } else { beside };
        self.work.solve_transposed(right, (if side == 0 { beside } else { size }, wanted));
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
        for other in (0..2).filter(|other| sides[*other]) {
            for (kind, matrix) in made.iter_mut().enumerate().filter(|_| known[other]) {
                for axis in 0..3 {
                    let mut column = [0.0; N];
                    for (i, entry) in self.end_jacobian.columns[kind][other][axis].iter().enumerate() {
                        let row = (place[other] + axis + i).checked_sub(MAX_BANDWIDTH / 2).filter(|row| *row < size);
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
