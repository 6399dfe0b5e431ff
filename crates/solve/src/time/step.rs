//! One step of time: Newton's iteration on the accelerations at its end.
//!
//! Unknowns are the accelerations of the degrees of freedom that move. A degree of freedom without inertia (a junction without weight) has none: its
//! unknown is its motion over the step, and it stands where nothing is left on it, as in statics.

use super::forces::{BodyForces, BodyMotion, LoadMemory};
use super::inertia::{gyroscopic, inertia};
use super::scheme::{Method, TimeScheme};
use crate::failure_reasons::no_inertia;
use crate::system::{DOFS, SolveError, System};
use nalgebra::{DMatrix, DVector, Matrix6, U6};
use windlass_base::dense::{DenseError, Lu};
use windlass_base::pose::Six;
use windlass_model::{ClassError, TimeStep};
use windlass_nonlinear::NewtonStatistics;

/// Square of the time (s2) over which stiff ties hold their ends together where a run begins: times their stiffness it is large against the
/// inertia of anything that floats.
const TIE_SETTLING_TIME_SQUARED: f64 = 1.0;

/// When a step is solved.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepTolerance {
    /// Most iterations before the step is cut.
    pub most: usize,
    /// Residual acceleration (fraction of gravity, rotations times the radius of gyration); of a degree of freedom without inertia the
    /// largest force left, as a share of the largest force of a connector on it.
    pub tolerance: f64,
}

impl Default for StepTolerance {
    fn default() -> Self {
        StepTolerance { most: 20, tolerance: 1e-7 }
    }
}

/// Everything that moves, at an instant.
#[derive(Debug, Default)]
pub struct SystemInstant {
    /// Time (s).
    pub time: f64,
    /// Motions of the bodies.
    pub motions: Vec<BodyMotion>,
    /// What loads remember.
    pub memory: LoadMemory,
    /// Forces there.
    pub forces: BodyForces,
}

/// A row of the unknowns.
#[derive(Clone, Copy, Debug)]
pub(super) struct UnknownRow {
    /// Body and degree of freedom: six a body.
    pub(super) at: usize,
    /// Whether it has inertia.
    pub(super) heavy: bool,
}

/// Solves steps of a system.
#[derive(Debug, Default)]
pub struct Stepper {
    pub(super) trial: Vec<BodyMotion>,
    /// Motion of each body over the step: translation and rotation vector.
    pub(super) over: Vec<Six>,
    pub(super) rows: Vec<UnknownRow>,
    pub(super) matrix: DMatrix<f64>,
    pub(super) right: DVector<f64>,
    pub(super) moved: Vec<f64>,
    /// The matrix as it was last solved with, of one body.
    pub(super) factors: Option<Lu<f64, U6>>,
    pub(super) masses: Vec<Matrix6<f64>>,
    /// How inertia changes with place and velocity.
    pub(super) turned: Vec<[Matrix6<f64>; 2]>,
}

impl Stepper {
    /// Finds the rows that move.
    pub(super) fn choose(&mut self, system: &System, forces: &BodyForces) {
        self.rows.clear();
        for (body, node) in system.nodes.iter().enumerate() {
            let mass = &self.masses[body];
            let largest = mass.diagonal().amax();
            for dof in 0..6 {
                if node.moves(dof) {
                    let at = 6 * body + dof;
                    // what hangs on it may have inertia where it has none itself
                    let carried = forces.inertia[(at, at)];
                    let heavy = mass[(dof, dof)] > 1e-12 * largest || carried > 1e-12 * largest;
                    self.rows.push(UnknownRow { at, heavy });
                }
            }
        }
    }

    pub(super) fn weigh(&mut self, system: &System, motions: &[BodyMotion]) {
        self.masses.clear();
        self.masses.extend(system.nodes.iter().zip(motions).map(|(n, m)| inertia(n, &m.pose)));
    }

    /// The accelerations that balance the forces at an instant, whose forces are evaluated here.
    ///
    /// # Errors
    /// A body or connector without an answer; a degree of freedom without inertia in the mass matrix.
    pub fn balance(&mut self, system: &System, now: &mut SystemInstant, dt: f64) -> Result<(), SolveError> {
        // at a start stiff ties begin with the force of their law; an explicit step knows no other
        now.forces.ties.holds = dt == 0.0;
        now.forces.ties.forces.clear();
        now.forces.evaluate(system, &now.memory, &now.motions, TimeStep { time: now.time, dt })?;
        self.weigh(system, &now.motions);
        self.choose(system, &now.forces);
        let light: Vec<usize> = self.rows.iter().filter(|r| !r.heavy).map(|r| r.at / 6).collect();
        now.forces.ties.keep(&|body| !light.contains(&body));
        let rows: Vec<usize> = self.rows.iter().filter(|r| r.heavy).map(|r| r.at).collect();
        let mut matrix = DMatrix::zeros(rows.len(), rows.len());
        let mut right = DVector::zeros(rows.len());
        for (i, at) in rows.iter().enumerate() {
            let (node, motion) = (&system.nodes[at / 6], &now.motions[at / 6]);
            right[i] = now.forces.sum[*at] - gyroscopic(&node.floating.mass, motion)[at % 6];
            if node.prescribed.is_none() {
                for (j, column) in rows.iter().enumerate() {
                    // the sum is that with the accelerations of before
                    let carried = now.forces.inertia[(*at, *column)];
                    let before = now.motions[column / 6].acceleration[column % 6];
                    right[i] += carried * before;
                    matrix[(i, j)] = carried;
                    if column / 6 == at / 6 {
                        matrix[(i, j)] += self.masses[at / 6][(at % 6, column % 6)];
                    }
                }
            }
        }
        for (body, other, block) in now.forces.ties.blocks() {
            let given = system.nodes[other].prescribed.is_some();
            let acceleration = now.motions[other].acceleration;
            for (i, at) in rows.iter().enumerate().filter(|(_, at)| **at / 6 == body) {
                if given {
                    right[i] -= TIE_SETTLING_TIME_SQUARED * block.row(at % 6).transpose().dot(&acceleration);
                }
                for (j, column) in rows.iter().enumerate().filter(|(_, column)| **column / 6 == other) {
                    matrix[(i, j)] += TIE_SETTLING_TIME_SQUARED * block[(at % 6, column % 6)];
                }
            }
        }
        let solved = Lu::new(matrix, &|| system.is_interrupted()).and_then(|lu| lu.solve(&right));
        let solved = solved.map_err(|e| match e {
            DenseError::Singular => self.singular(system, &rows),
            other => system.singular_matrix_error("force or inertia", &rows, other),
        })?;
        for motion in now.motions.iter_mut().zip(&system.nodes).filter(|(_, n)| n.prescribed.is_none()).map(|(m, _)| m)
        {
            motion.acceleration = Six::zeros();
        }
        for (i, at) in rows.iter().enumerate() {
            now.motions[at / 6].acceleration[at % 6] = solved[i];
        }
        if !now.forces.ties.is_empty() {
            let accelerations: Vec<Six> =
                now.motions.iter().map(|m| m.acceleration * TIE_SETTLING_TIME_SQUARED).collect();
            let ties = now.forces.ties.predict(&|body| accelerations[body]);
            now.forces.ties.forces = ties;
            now.forces.evaluate(system, &now.memory, &now.motions, TimeStep { time: now.time, dt })?;
        }
        for motion in &mut now.motions {
            (motion.auxiliary, motion.jerk) = (motion.acceleration, Six::zeros());
        }
        Ok(())
    }

    /// The error of a mass matrix that cannot be solved: the degree of freedom with the least inertia.
    fn singular(&self, system: &System, rows: &[usize]) -> SolveError {
        let inertia = |at: &usize| self.masses[at / 6][(at % 6, at % 6)];
        let turning = rows.iter().filter(|at| *at % 6 >= 3);
        let least = turning.min_by(|a, b| inertia(a).total_cmp(&inertia(b))).or(rows.first()).copied().unwrap_or(0);
        let dof = DOFS.get(least % 6).copied().unwrap_or_default();
        let name = system.nodes.get(least / 6).map(|n| n.name.clone()).unwrap_or_default();
        no_inertia(&name, dof)
    }

    /// Takes a step of `dt` from `now` to its end: what it took, with the residual acceleration as a share of gravity. Nothing has
    /// changed when it fails.
    ///
    /// # Errors
    /// A body or connector without an answer; no balance within the most iterations.
    pub fn step(
        &mut self,
        system: &mut System,
        now: &mut SystemInstant,
        dt: f64,
        (method, wanted): (&Method, &StepTolerance),
    ) -> Result<NewtonStatistics, SolveError> {
        let made = match method {
            Method::Implicit(scheme) => self.implicit(system, now, dt, (scheme, wanted)),
            Method::Corrector => self.corrector(system, now, dt, wanted),
        };
        match made {
            Ok(effort) if effort.iterations > 0 => now.forces.end_step(dt),
            // a trial that held as it was needs no prediction, nor does most likely the next
            _ => now.forces.clear_predictor(),
        }
        made
    }

    /// Trial motions for the present accelerations of the trial.
    pub(super) fn position(&mut self, system: &System, start: &[BodyMotion], dt: f64, scheme: &TimeScheme) {
        for (((trial, over), old), node) in self.trial.iter_mut().zip(&mut self.over).zip(start).zip(&system.nodes) {
            if node.prescribed.is_some() {
                continue;
            }
            trial.auxiliary = scheme.auxiliary(&old.acceleration, &old.auxiliary, &trial.acceleration);
            trial.velocity = scheme.velocity(dt, &old.velocity, &old.auxiliary, &trial.auxiliary);
            *over = scheme.motion(dt, &old.velocity, &old.auxiliary, &trial.auxiliary);
        }
    }

    /// Puts the trial bodies where their motion over the step takes them.
    pub(super) fn pose(&mut self, system: &System, start: &[BodyMotion]) {
        for (((trial, over), old), node) in self.trial.iter_mut().zip(&self.over).zip(start).zip(&system.nodes) {
            if node.prescribed.is_none() {
                trial.pose = old.pose.after_motion(over);
            }
        }
    }

    pub(super) fn prescribe(&mut self, system: &System, TimeStep { time, dt }: TimeStep) -> Result<(), SolveError> {
        for ((trial, over), node) in self.trial.iter_mut().zip(&mut self.over).zip(&system.nodes) {
            if let Some(prescribed) = &node.prescribed {
                let before = *trial;
                *trial = prescribed.motion_at(time).map_err(SolveError::error_about(&node.name))?;
                let by = trial.pose.origin - before.pose.origin;
                let turn = (before.velocity + trial.velocity) * (0.5 * dt);
                // to the order of the step, as a forecast needs it
                *over = Six::new(by.x, by.y, by.z, turn[3], turn[4], turn[5]);
            }
        }
        Ok(())
    }

    fn implicit(
        &mut self,
        system: &mut System,
        now: &mut SystemInstant,
        dt: f64,
        (scheme, wanted): (&TimeScheme, &StepTolerance),
    ) -> Result<NewtonStatistics, SolveError> {
        let (time, mut effort) = (now.time + dt, NewtonStatistics::default());
        self.trial.clear();
        self.trial.extend_from_slice(&now.motions);
        self.over.clear();
        self.over.resize(now.motions.len(), Six::zeros());
        // as of the last trial: which degrees of freedom have inertia does not turn with the axes
        if self.masses.len() != system.nodes.len() {
            self.weigh(system, &now.motions);
        }
        self.choose(system, &now.forces);
        self.prescribe(system, TimeStep { time, dt })?;
        // ahead as the acceleration changed last; what has no inertia goes on with its velocity
        for (trial, _) in self.trial.iter_mut().zip(&system.nodes).filter(|(_, n)| n.prescribed.is_none()) {
            trial.acceleration += trial.jerk * dt;
        }
        self.position(system, &now.motions, dt, scheme);
        for row in self.rows.iter().filter(|r| !r.heavy) {
            let (Some(trial), Some(over)) = (self.trial.get_mut(row.at / 6), self.over.get_mut(row.at / 6)) else {
                continue;
            };
            (trial.acceleration[row.at % 6], trial.auxiliary[row.at % 6]) = (0.0, 0.0);
            over[row.at % 6] = trial.velocity[row.at % 6] * dt;
        }
        self.pose(system, &now.motions);
        self.weigh_again(system);
        now.memory.begin(system, (&now.motions, &self.trial), TimeStep { time, dt })?;
        let gain = scheme.gain();
        let (by_place, by_velocity) = (dt * dt * scheme.beta * gain, dt * scheme.gamma * gain);
        let parts = (self.trial.as_slice(), now.motions.as_slice(), self.over.as_slice());
        // what is predicted knows no forces held in ties
        let mut predicted = now.forces.ties.is_empty() && now.forces.predict((&now.memory, dt), parts);
        now.forces.ties.holds = true;
        let unexplained = wanted.tolerance * system.gravity * by_place;
        if predicted {
            let left = self.residual(system, &now.forces);
            // a trial that is expected to hold needs no correction: half, as what is predicted is off, too
            predicted = left.is_finite() && left > 0.5 * wanted.tolerance * system.gravity;
        }
        if predicted {
            // stiffness and damping are still those of the start
            self.turn(system);
            self.jacobian(&now.forces, dt, by_place, by_velocity);
            predicted = self.solve(system).is_ok();
        }
        if predicted {
            effort.iterations += 1;
            self.correct_trial(system, &now.motions, dt, gain, by_place, by_velocity);
            self.weigh_again(system);
        }
        loop {
            now.forces.evaluate(system, &now.memory, &self.trial, TimeStep { time, dt })?;
            effort.evaluations += 1;
            let left = self.residual(system, &now.forces);
            effort.residual = left / system.gravity;
            if !left.is_finite() {
                return Err(not_finite(system, &now.forces.sum, time));
            }
            if left <= wanted.tolerance * system.gravity && now.forces.ties.gap() <= unexplained {
                // what is predicted is near, not balanced: with the matrix at hand what is left goes, too
                if predicted
                    && effort.evaluations == 1
                    && !now.forces.has_dynamic_lines
                    && self.solve_again(system).is_ok()
                {
                    self.correct_trial(system, &now.motions, dt, gain, by_place, by_velocity);
                }
                break;
            }
            if effort.iterations >= wanted.most {
                return Err(self.unbalanced_error(system, left, time, dt));
            }
            effort.iterations += 1;
            self.turn(system);
            self.jacobian(&now.forces, dt, by_place, by_velocity);
            self.ask(&now.forces);
            self.solve(system).map_err(|e| self.unsolvable(system, e, left, TimeStep { time, dt }))?;
            self.update_tie_forces(&mut now.forces, by_place);
            self.correct_trial(system, &now.motions, dt, gain, by_place, by_velocity);
            self.weigh_again(system);
        }
        now.forces.learn(dt, (&self.trial, &now.motions, &self.over));
        self.accept(system, now, TimeStep { time, dt });
        Ok(effort)
    }

    /// Inertia follows the axes of bodies whose inertia is not the same about all of them.
    pub(super) fn weigh_again(&mut self, system: &System) {
        for ((mass, node), trial) in self.masses.iter_mut().zip(&system.nodes).zip(&self.trial) {
            *mass = inertia(node, &trial.pose);
        }
    }

    /// Makes the trial the present.
    pub(super) fn accept(&mut self, system: &mut System, now: &mut SystemInstant, TimeStep { time, dt }: TimeStep) {
        now.time = time;
        for (trial, old) in self.trial.iter_mut().zip(&now.motions) {
            trial.jerk = (trial.acceleration - old.acceleration) / dt;
        }
        now.motions.clear();
        now.motions.extend_from_slice(&self.trial);
        now.memory.commit(system, &now.motions, TimeStep { time, dt });
        system.states.clear();
        system.states.extend_from_slice(&now.forces.trial);
    }

    /// The error of a step whose correction cannot be found.
    fn unsolvable(&self, system: &System, error: DenseError, left: f64, TimeStep { time, dt }: TimeStep) -> SolveError {
        match error {
            DenseError::Singular | DenseError::NotPositive => self.unbalanced_error(system, left, time, dt),
            other => {
                let rows: Vec<usize> = self.rows.iter().map(|r| r.at).collect();
                let made = system.singular_matrix_error("stiffness, damping or inertia", &rows, other);
                SolveError {
                    error: ClassError { message: made.error.message.then(format!(" at {time} s")), ..made.error },
                    ..made
                }
            }
        }
    }

    /// The error of a step whose iteration ended before the balance was found.
    fn unbalanced_error(&self, system: &System, left: f64, time: f64, dt: f64) -> SolveError {
        let most = |a: (usize, f64), b: (usize, f64)| if b.1.abs() > a.1.abs() { b } else { a };
        let worst = self.right.iter().copied().enumerate().reduce(most).and_then(|(at, _)| self.rows.get(at));
        unsolved_error(system, worst.map_or(0, |r| r.at), left, TimeStep { time, dt }, "an acceleration is left of")
    }
}

/// The error of a step without a solution: the degree of freedom that is worst, six a body, and what is left there (m/s2).
pub(super) fn unsolved_error(
    system: &System,
    at: usize,
    left: f64,
    TimeStep { time, dt }: TimeStep,
    what: &str,
) -> SolveError {
    let name = system.nodes.get(at / 6).map(|n| n.name.clone());
    let dof = DOFS.get(at % 6).copied().unwrap_or_default();
    let text =
        format!("no balance at {time} s with a step of {dt} s: {what} {:.2e} g, most in {dof}", left / system.gravity);
    SolveError { who: name, error: ClassError::new(text) }
}

/// The error of a force that is no number.
pub(super) fn not_finite(system: &System, sum: &DVector<f64>, time: f64) -> SolveError {
    let at = sum.iter().position(|v| !v.is_finite()).unwrap_or(0);
    let name = system.nodes.get(at / 6).map(|n| n.name.clone());
    let error = ClassError::new(format!("the force in {} is not finite at {time} s", DOFS[at % 6]));
    SolveError { who: name, error }
}
