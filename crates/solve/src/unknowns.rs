//! The unknowns of an equilibrium: degrees of freedom that move, what they weigh, and how a step in them moves the bodies.

use super::equilibrium::EquilibriumOptions;
use super::parts::BodySubset;
use super::system::{SolveError, System, SystemBody, SystemState};
use nalgebra::{DMatrix, DVector};
use windlass_base::dense::DenseError;
use windlass_base::geometry::Place;
use windlass_base::pose::{Pose, Six};

/// Longest step (m), and largest rotation in it (rad).
const MAX_STEP: [f64; 2] = [50.0, 0.3];
/// Share of what pulls at a junction that is taken for its weight where a residual is measured.
const JUNCTION_WEIGHT_SHARE: f64 = 1e-3;

/// Rows of the system with their shares in one unknown, the larger first.
pub(super) type UnknownDirection = [(usize, f64); 2];

/// The free unknowns and their measures.
pub(super) struct Unknowns<'a> {
    /// The direction of each: a row of the system, or two with their shares.
    pub rows: Vec<UnknownDirection>,
    /// Inertia of each (kg or kg m2).
    pub inertia: DVector<f64>,
    /// Force (N) or moment (N m) that is gravity's on it; of a junction a thousandth of what pulls at it.
    measure: DVector<f64>,
    turns: &'a [Turns],
}

impl<'a> Unknowns<'a> {
    /// Those of a part, `None` for all bodies, that keep some of their angles.
    pub fn new(
        system: &System,
        state: &SystemState,
        options: &EquilibriumOptions,
        (turns, part): (&'a [Turns], Option<&BodySubset>),
    ) -> Self {
        let (mut rows, mut inertia, mut measure) = (Vec::new(), Vec::new(), Vec::new());
        let belongs = |body: usize| part.is_none_or(|p| p[body]);
        for (body, node) in system.nodes.iter().enumerate().filter(|(body, _)| belongs(*body)) {
            let own = &node.floating.mass;
            let pull = state.pull[body] / system.gravity;
            let mass = if node.junction || own.mass <= 0.0 { own.mass.max(pull).max(1e-3) } else { own.mass };
            let about = own.inertia.trace() / 3.0 - mass * own.centre.norm_squared() * 2.0 / 3.0;
            let radius = if about > 1e-12 * mass { (about / mass).sqrt() } else { 1.0 };
            let weighs = if node.junction { own.mass.max(JUNCTION_WEIGHT_SHARE * pull).max(1e-3) } else { mass };
            for (dof, free) in node.free.iter().enumerate() {
                if !free || options.ignored.contains(&(body, dof)) {
                    continue;
                }
                match options.held {
                    Some((held, angle)) if held == body && dof < 2 => {
                        match transverse_direction(body, angle, &node.free) {
                            Some(direction) if dof == 1 => rows.push(direction),
                            _ => continue,
                        }
                    }
                    _ => rows.push([(6 * body + dof, 1.0), (6 * body + dof, 0.0)]),
                }
                let turning = dof >= 3;
                inertia.push(if turning { mass * radius * radius } else { mass });
                measure.push(if turning { weighs * radius * system.gravity } else { weighs * system.gravity });
            }
        }
        Unknowns { rows, inertia: DVector::from_vec(inertia), measure: DVector::from_vec(measure), turns }
    }

    /// The residual forces along the unknowns (N, N m).
    pub fn residual(&self, state: &SystemState) -> DVector<f64> {
        self.project_forces(&state.residual)
    }

    /// Forces of the system, six a body (N, N m), along the unknowns.
    pub fn project_forces(&self, forces: &DVector<f64>) -> DVector<f64> {
        let along = |d: &UnknownDirection| d.iter().map(|(r, share)| share * forces[*r]).sum();
        DVector::from_iterator(self.rows.len(), self.rows.iter().map(along))
    }

    /// The stiffness against the unknowns (N/m, N, N m).
    pub fn stiffness(&self, state: &SystemState) -> DMatrix<f64> {
        DMatrix::from_fn(self.rows.len(), self.rows.len(), |i, j| {
            let (rows, columns) = (&self.rows[i], &self.rows[j]);
            rows.iter()
                .flat_map(|(r, one)| columns.iter().map(move |(c, other)| one * other * state.stiffness[(*r, *c)]))
                .sum()
        })
    }

    /// The largest residual acceleration over the tolerance (a ratio; below 1 is rest), and the unknown that has it.
    pub fn worst(&self, residual: &DVector<f64>, options: &EquilibriumOptions) -> (f64, usize) {
        let [shift, turn] = options.tolerance;
        let share = |(i, (r, m)): (usize, (&f64, &f64))| {
            let tolerance = if self.dof(i) >= 3 { turn } else { shift };
            (r.abs() / m / tolerance, i)
        };
        residual.iter().zip(self.measure.iter()).enumerate().map(share).fold((0.0, 0), |worst, one| {
            // what is no number is the worst
            if one.0 > worst.0 || one.0.is_nan() { one } else { worst }
        })
    }

    /// The largest residual acceleration (fraction of g).
    pub fn largest(&self, residual: &DVector<f64>) -> f64 {
        residual.iter().zip(self.measure.iter()).fold(0.0, |most: f64, (r, m)| most.max(r.abs() / m))
    }

    pub fn dof(&self, unknown: usize) -> usize {
        let [(row, _), _] = self.rows[unknown];
        row % 6
    }

    pub fn body(&self, unknown: usize) -> usize {
        let [(row, _), _] = self.rows[unknown];
        row / 6
    }

    /// The error of a stiffness that has no factors.
    pub fn singular_stiffness_error(&self, system: &System, error: DenseError) -> SolveError {
        let rows: Vec<usize> = self.rows.iter().map(|[(row, _), _]| *row).collect();
        system.singular_matrix_error("stiffness", &rows, error)
    }

    /// The share of a step that stays within the longest.
    pub fn limit(&self, step: &DVector<f64>) -> f64 {
        self.limit_to(step, MAX_STEP)
    }

    /// The share of a step that stays within a longest one, in translation (m) and rotation (rad).
    pub fn limit_to(&self, step: &DVector<f64>, [far, turn]: [f64; 2]) -> f64 {
        step.iter().enumerate().fold(1.0, |share: f64, (i, s)| {
            let most = if self.dof(i) >= 3 { turn } else { far };
            share.min(most / s.abs().max(1e-300))
        })
    }

    /// The motion of each of so many bodies in a share of a step.
    pub fn motions(&self, bodies: usize, step: &DVector<f64>, share: f64) -> Vec<Six> {
        let mut motions = vec![Six::zeros(); bodies];
        for (direction, s) in self.rows.iter().zip(step.iter()) {
            for (row, part) in direction {
                if let Some(motion) = motions.get_mut(row / 6) {
                    motion[row % 6] += share * part * s;
                }
            }
        }
        motions
    }

    pub fn move_bodies(&self, poses: &[Pose], step: &DVector<f64>, share: f64) -> Vec<Pose> {
        let motions = self.motions(poses.len(), step, share);
        let turn = |body: usize, pose: Pose| match self.turns.get(body) {
            Some(turns) if turns.iter().any(Option::is_some) => restore_restrained_rotations(pose, turns),
            _ => pose,
        };
        let one = |(body, (p, m)): (usize, (&Pose, &Six))| {
            if *m == Six::zeros() { *p } else { turn(body, p.after_motion(m)) }
        };
        poses.iter().zip(&motions).enumerate().map(one).collect()
    }
}

/// The horizontal direction across an angle (rad), where the body is free in both.
fn transverse_direction(body: usize, angle: f64, free: &[bool; 6]) -> Option<UnknownDirection> {
    let [x, y, ..] = *free;
    let (x_share, y_share) = (-angle.sin(), angle.cos());
    let (x_row, y_row) = ((6 * body, x_share), (6 * body + 1, y_share));
    (x && y).then_some(if x_share.abs() > y_share.abs() { [x_row, y_row] } else { [y_row, x_row] })
}

/// Roll, pitch and yaw (rad) that a body keeps, where it has some rotations left out and others not: turning about some axes
/// of space alone would change the others by the square of the turn.
pub(super) type Turns = [Option<f64>; 3];

/// The angles each body of a system keeps.
pub(super) fn find_restrained_rotations(
    system: &System,
    state: &SystemState,
    options: &EquilibriumOptions,
) -> Vec<Turns> {
    let kept = |(body, (node, pose)): (usize, (&SystemBody, &Pose))| {
        let free = [3, 4, 5].map(|f| node.free.get(f) == Some(&true) && !options.ignored.contains(&(body, f)));
        let some = free.contains(&true) && free.contains(&false);
        let [roll, pitch, yaw] = pose.position(&Place::default()).turn;
        let mut turns = [Some(roll), Some(pitch), Some(yaw)];
        for (turn, free) in turns.iter_mut().zip(free) {
            if free || !some {
                *turn = None;
            }
        }
        turns
    };
    system.nodes.iter().zip(&state.poses).enumerate().map(kept).collect()
}

/// A pose with the angles it keeps.
fn restore_restrained_rotations(pose: Pose, turns: &Turns) -> Pose {
    let mut position = pose.position(&Place::default());
    for (turn, kept) in position.turn.iter_mut().zip(turns) {
        *turn = kept.unwrap_or(*turn);
    }
    Pose { axes: Pose::from_place(&position).axes, ..pose }
}
