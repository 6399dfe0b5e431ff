//! Newton iteration of one time step: the residual of the equations of motion, its Jacobian (inertia, damping and stiffness by the
//! weights of the scheme), and the correction of the trial accelerations. There is no line search: a step that fails is halved.
//! The loop (`Stepper::implicit`) is its own because the first correction may be predicted before the forces are evaluated.

use super::forces::{BodyForces, BodyMotion};
use super::inertia::{gyroscopic, turned_inertia};
use super::step::Stepper;
use crate::system::{System, SystemBody};
use nalgebra::{DMatrix, DVector, Matrix6};
use windlass_base::dense::{DenseError, Lu, least_squares_of_one};
use windlass_base::pose::Six;

impl Stepper {
    /// Fills the right side with what is left; gives its measure (m/s2).
    pub(super) fn residual(&mut self, system: &System, forces: &BodyForces) -> f64 {
        if self.right.nrows() != self.rows.len() {
            self.right = DVector::zeros(self.rows.len());
        }
        let mut most: f64 = 0.0;
        let mut inertia = (usize::MAX, Six::zeros(), 1.0);
        for (i, row) in self.rows.iter().enumerate() {
            let (body, dof) = (row.at / 6, row.at % 6);
            let (node, trial, mass) = (&system.nodes[body], &self.trial[body], &self.masses[body]);
            if inertia.0 != body {
                let own = mass * trial.acceleration + gyroscopic(&node.floating.mass, trial);
                let whole = |i: usize| mass[(i, i)] + forces.inertia[(6 * body + i, 6 * body + i)].max(0.0);
                inertia = (body, own, whole(0).max(whole(2)));
            }
            let left = if row.heavy { forces.sum[row.at] - inertia.1[dof] } else { forces.sum[row.at] };
            self.right[i] = left;
            let measure = if row.heavy {
                let own = mass[(dof, dof)] + forces.inertia[(row.at, row.at)].max(0.0);
                // of a rotation, times the radius of gyration
                if dof < 3 { own } else { (own * inertia.2.max(f64::MIN_POSITIVE)).sqrt() }
            } else {
                let pull = forces.pull[body];
                pull.max(1.0) / system.gravity
            };
            let share = left.abs() / measure;
            // a comparison with a number that is none would pass it over
            most = if share.is_nan() { f64::INFINITY } else { most.max(share) };
        }
        most
    }

    /// Adds to what is left what stiff ties have beyond the forces held in them: together they ask for a correction of both.
    pub(super) fn ask(&mut self, forces: &BodyForces) {
        for (i, row) in self.rows.iter().enumerate() {
            self.right[i] += forces.ties.excess[row.at];
        }
    }

    /// The forces of stiff ties follow the correction that was found.
    pub(super) fn update_tie_forces(&self, forces: &mut BodyForces, by_place: f64) {
        if forces.ties.is_empty() {
            return;
        }
        let mut motions = vec![Six::zeros(); self.trial.len()];
        for (row, by) in self.rows.iter().zip(&self.moved) {
            motions[row.at / 6][row.at % 6] = if row.heavy { by * by_place } else { *by };
        }
        forces.ties.forces = forces.ties.predict(&|body| motions[body]);
    }

    /// What turning changes in the inertia of each body.
    pub(super) fn turn(&mut self, system: &System) {
        self.turned.clear();
        let made = |(node, trial): (&SystemBody, &BodyMotion)| turned_inertia(node, trial);
        self.turned.extend(system.nodes.iter().zip(&self.trial).map(made));
    }

    pub(super) fn jacobian(&mut self, forces: &BodyForces, dt: f64, by_place: f64, by_velocity: f64) {
        let size = self.rows.len();
        if self.matrix.nrows() != size {
            self.matrix = DMatrix::zeros(size, size);
        }
        if let ([mass], [turned], 6, true) =
            (self.masses.as_slice(), self.turned.as_slice(), size, self.rows.iter().all(|r| r.heavy))
        {
            let block = |m: &DMatrix<f64>| m.fixed_view::<6, 6>(0, 0).into_owned();
            let [position, velocity] = *turned;
            let whole = (block(&forces.stiffness) + position) * by_place
                + (block(&forces.damping) + velocity) * by_velocity
                + block(&forces.inertia)
                + mass;
            self.matrix.copy_from(&whole);
            return;
        }
        for (j, column) in self.rows.iter().enumerate() {
            let (position, velocity) = if column.heavy { (by_place, by_velocity) } else { (1.0, 1.0 / dt) };
            for (i, row) in self.rows.iter().enumerate() {
                let (at, to) = (row.at, column.at);
                let mut value = forces.stiffness[(at, to)] * position + forces.damping[(at, to)] * velocity;
                if row.heavy && column.heavy {
                    value += forces.inertia[(at, to)];
                }
                if row.heavy && column.heavy && at / 6 == to / 6 {
                    let position = (at % 6, to % 6);
                    value += self.masses[at / 6][position];
                    let [by_turn, by_spin] = &self.turned[at / 6];
                    value += by_turn[position] * by_place + by_spin[position] * by_velocity;
                }
                self.matrix[(i, j)] = value;
            }
        }
    }

    /// Finds the correction; what nothing holds and nothing weighs does not move.
    pub(super) fn solve(&mut self, system: &System) -> Result<(), DenseError> {
        if self.rows.len() == 6 {
            let matrix: Matrix6<f64> = self.matrix.fixed_view::<6, 6>(0, 0).into_owned();
            self.factors = Some(Lu::new(matrix, &|| system.is_interrupted())?);
        }
        match self.solve_again(system) {
            Err(DenseError::Singular) => {}
            other => return other,
        }
        let least = 1e-12 * self.matrix.amax();
        let found = least_squares_of_one(self.matrix.clone(), &self.right, least, &|| system.is_interrupted())?;
        self.moved.extend(found.iter());
        Ok(())
    }

    /// Finds the correction for another right side with the matrix that was solved last.
    pub(super) fn solve_again(&mut self, system: &System) -> Result<(), DenseError> {
        self.moved.clear();
        if let (Some(right), 6) = (self.right.as_slice().first_chunk::<6>(), self.rows.len()) {
            let factors = self.factors.as_ref().ok_or(DenseError::Singular)?;
            self.moved.extend(factors.solve(&Six::from(*right))?.iter());
        } else {
            let factors = Lu::new(self.matrix.clone(), &|| system.is_interrupted())?;
            self.moved.extend(factors.solve(&self.right)?.iter());
        }
        Ok(())
    }

    /// Moves the trial by the correction that was found.
    pub(super) fn correct_trial(
        &mut self,
        system: &System,
        start: &[BodyMotion],
        dt: f64,
        gain: f64,
        by_place: f64,
        by_velocity: f64,
    ) {
        for (row, by) in self.rows.iter().zip(&self.moved) {
            let (Some(trial), Some(over)) = (self.trial.get_mut(row.at / 6), self.over.get_mut(row.at / 6)) else {
                continue;
            };
            let dof = row.at % 6;
            if row.heavy {
                trial.acceleration[dof] += by;
                trial.auxiliary[dof] += by * gain;
                trial.velocity[dof] += by * by_velocity;
                over[dof] += by * by_place;
            } else {
                over[dof] += by;
                trial.velocity[dof] = over[dof] / dt;
            }
        }
        self.pose(system, start);
    }
}
