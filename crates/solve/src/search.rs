//! Newton step and line search of the equilibrium search (`&EQUI`).
//!
//! The step solves the tangent stiffness against the residual. Where the stiffness is not positive definite, a share of the inertia is
//! added to it: a pseudo-transient step, whose share shrinks with the residual. The line search shortens a step until the work of the
//! residual along it has not changed sign. Where something stiff turns, that makes steps very short; after several short steps, up to
//! five non-monotone steps are tried, and the search returns to the best place when they do not reduce the residual.
//! The line search is its own because a place on the way may have no answer, and because what a step needed of regularisation and length
//! decides on the next.

use super::equilibrium::{EquilibriumOptions, UNRESTRAINED_EIGENVALUE};
use super::parts::BodySubset;
use super::system::{SolveError, System, SystemState};
use super::ties::interpolate_forces;
use super::unknowns::Unknowns;
use nalgebra::{DMatrix, DVector};
use windlass_base::dense::{Cholesky, DenseError, Lu, Stop};
use windlass_base::pose::{Pose, Six};
use windlass_nonlinear::NewtonStatistics;

/// Deflection (m, rad) that the force held in a tie may leave unexplained at rest.
const TIE_TOLERANCE: f64 = 1e-6;
/// Non-monotone steps in a row without a better place.
const MAX_NONMONOTONE_STEPS: usize = 5;
/// Short steps in a row after which non-monotone steps are tried, for the first time; twice as many each further time.
const SHORT_STEPS_BEFORE_NONMONOTONE: usize = 3;
/// Share of a step that is short.
const SHORT_STEP_SHARE: f64 = 0.2;
/// Most trials of a step.
const MAX_LINE_SEARCH_TRIALS: usize = 14;
/// Most times a trial place without an answer is brought nearer: by then the step is a trillionth of its length.
const MAX_RETREATS: usize = 40;
/// Steps in a row without a place that has an answer, each with ten times the regularisation of the one before, after which the
/// search fails.
const MAX_BLOCKED_STEPS: usize = 6;

/// Where bodies are, and the forces of stiff ties there.
#[derive(Clone, Debug)]
pub(super) struct BodyPlaces {
    poses: Vec<Pose>,
    ties: Vec<Option<Six>>,
}

impl BodyPlaces {
    pub fn from_state(state: &SystemState) -> Self {
        BodyPlaces { poses: state.poses.clone(), ties: state.ties.forces.clone() }
    }

    /// Puts a state there.
    pub fn restore(self, state: &mut SystemState) {
        state.poses = self.poses;
        state.ties.forces = self.ties;
    }
}

/// Steps that may leave more than the one before.
struct NonMonotoneSteps {
    /// The place where they began, or the better one that they found.
    best: BodyPlaces,
    /// What is left there, over what is tolerated.
    left: f64,
    /// Steps since.
    since: usize,
}

/// A search on its way.
pub(super) struct EquilibriumSearch<'a> {
    pub system: &'a System,
    pub options: &'a EquilibriumOptions,
    /// The bodies that it brings to rest; all where there is none.
    part: Option<&'a BodySubset>,
    /// Evaluations and damped steps so far; who asks for steps counts them.
    pub statistics: NewtonStatistics,
    /// Regularisation: share of the inertia added to the stiffness (1/s2).
    regularisation: f64,
    /// Short steps in a row.
    short_steps: usize,
    /// Short steps in a row after which non-monotone steps are tried.
    max_short_steps: usize,
    /// Non-monotone steps, where they are tried.
    non_monotone: Option<NonMonotoneSteps>,
    /// Steps in a row without a place that has an answer.
    blocked: usize,
}

impl<'a> EquilibriumSearch<'a> {
    pub fn new(system: &'a System, options: &'a EquilibriumOptions, part: Option<&'a BodySubset>) -> Self {
        EquilibriumSearch {
            system,
            options,
            part,
            statistics: NewtonStatistics::default(),
            regularisation: 0.0,
            short_steps: 0,
            max_short_steps: SHORT_STEPS_BEFORE_NONMONOTONE,
            non_monotone: None,
            blocked: 0,
        }
    }

    /// Forces of the bodies of this part at the trial, counted.
    ///
    /// # Errors
    /// A connector without an answer at this place, or an interruption.
    pub fn evaluate(&mut self, state: &mut SystemState) -> Result<(), SolveError> {
        self.statistics.evaluations += 1;
        state.ties.holds = true;
        self.system.evaluate_part(state, self.part)
    }

    /// The largest residual acceleration over the tolerance (a ratio; below 1 is rest), or deflection of a tie that its force does not
    /// explain, and the unknown.
    pub fn worst(&self, unknowns: &Unknowns, state: &SystemState) -> (f64, usize) {
        let (worst, at) = unknowns.worst(&unknowns.residual(state), self.options);
        // a number that is none stays the worst
        (if worst.is_nan() { worst } else { worst.max(state.ties.gap() / TIE_TOLERANCE) }, at)
    }

    /// Goes on from a place where `worst` is left: a step, or back to a better place.
    ///
    /// # Errors
    /// A trial that no shortening of the step makes answerable, or an interruption.
    pub fn advance(&mut self, unknowns: &Unknowns, state: &mut SystemState, worst: f64) -> Result<(), SolveError> {
        if let Some(steps) = &mut self.non_monotone {
            if worst < steps.left {
                *steps = NonMonotoneSteps { best: BodyPlaces::from_state(state), left: worst, since: 0 };
            } else {
                steps.since += 1;
            }
            if steps.since > MAX_NONMONOTONE_STEPS {
                steps.best.clone().restore(state);
                self.non_monotone = None;
                (self.short_steps, self.max_short_steps) = (0, self.max_short_steps.saturating_mul(2));
                self.regularisation = 0.0;
                return self.evaluate(state);
            }
        } else if self.short_steps >= self.max_short_steps {
            self.non_monotone = Some(NonMonotoneSteps { best: BodyPlaces::from_state(state), left: worst, since: 0 });
        }
        self.step(unknowns, state, worst)
    }

    fn step(&mut self, unknowns: &Unknowns, state: &mut SystemState, worst: f64) -> Result<(), SolveError> {
        let residual = unknowns.residual(state);
        let asked = &residual + unknowns.project_forces(&state.ties.excess);
        let stop = || self.system.is_interrupted();
        let made = direction(unknowns, &unknowns.stiffness(state), &asked, self.regularisation, &stop);
        let (step, needed) = made.map_err(|e| unknowns.singular_stiffness_error(self.system, e))?;
        let work = residual.dot(&step).abs();
        let from = BodyPlaces::from_state(state);
        let motions = unknowns.motions(from.poses.len(), &step, 1.0);
        let ties = state.ties.predict(&|body| motions[body]);
        let position = |state: &mut SystemState, share: f64| {
            state.poses = unknowns.move_bodies(&from.poses, &step, share);
            state.ties.forces = interpolate_forces(&from.ties, &ties, share);
        };
        let within = unknowns.limit(&step);
        // nothing holds back along a step that had to be limited: it is no measure of how far it is
        let blind = needed > 0.0 && within < 1.0;
        let asked = self.options.longest_step.map_or(1.0, |longest| unknowns.limit_to(&step, longest));
        let longest = self.options.fraction * within.min(asked);
        let takes_any = self.non_monotone.is_some() && !blind;
        // share and force along the step of the farthest place before the forces turn around, and of the nearest behind
        let (mut before, mut behind): ((f64, f64), Option<(f64, f64)>) = ((0.0, work), None);
        let mut share = longest;
        let (mut error, mut trials, mut retreats) = (None, 0, 0);
        while trials < MAX_LINE_SEARCH_TRIALS && retreats < MAX_RETREATS {
            position(state, share);
            match self.evaluate(state) {
                Ok(()) => {
                    trials += 1;
                    let new = unknowns.residual(state);
                    let (now, after) = (self.worst(unknowns, state).0, new.dot(&step));
                    let fell = after.abs() <= 0.9 * work;
                    if takes_any || now < worst || (after >= -0.5 * work && (fell || behind.is_none())) {
                        self.record_step(share / longest, needed, now / worst, blind);
                        self.blocked = 0;
                        return Ok(());
                    }
                    if after >= -0.5 * work {
                        before = (share, after);
                    } else {
                        behind = Some((share, after));
                    }
                }
                Err(wrong) if wrong.error.lasting => {
                    from.restore(state);
                    return Err(wrong);
                }
                // a place without an answer is no place to go to: nearer ones may have one
                Err(wrong) => {
                    retreats += 1;
                    trials += usize::from(before.0 > 0.0);
                    error = Some(wrong);
                    behind = Some((share, -work));
                }
            }
            let Some((far, force)) = behind else { break };
            // where the force along the step is nothing, were it straight
            let (near, at) = before;
            let straight = at.abs() / (at.abs() + force.abs());
            share = near + (far - near) * straight.clamp(0.05, 0.7);
        }
        if before.0 > 0.0 {
            position(state, before.0);
            self.evaluate(state)?;
            self.record_step(before.0 / longest, needed, 1.0, blind);
            self.blocked = 0;
            return Ok(());
        }
        from.restore(state);
        self.blocked = if error.is_some() { self.blocked + 1 } else { 0 };
        if let Some(error) = error.filter(|_| self.blocked > MAX_BLOCKED_STEPS) {
            return Err(error);
        }
        // no share of the step is good: a shorter step in pseudo-time
        self.regularisation = (10.0 * needed.max(self.regularisation)).max(1e-3);
        self.evaluate(state)
    }

    /// Remembers how much of a step was taken, and what it left over what there was.
    fn record_step(&mut self, share: f64, needed: f64, left: f64, blind: bool) {
        self.statistics.damped_steps += usize::from(share < 1.0);
        self.short_steps = if share < SHORT_STEP_SHARE && !blind { self.short_steps + 1 } else { 0 };
        // the regularisation shrinks with the residual
        let change = if left <= 1.0 { (0.5 * left).max(0.1) } else { left.min(4.0) };
        self.regularisation = Some(needed * change).filter(|h| *h >= UNRESTRAINED_EIGENVALUE).unwrap_or(0.0);
    }
}

/// The step, and the share of the inertia (1/s2) that had to be added to the stiffness to hold the bodies.
fn direction(
    unknowns: &Unknowns,
    stiffness: &DMatrix<f64>,
    residual: &DVector<f64>,
    regularisation: f64,
    stop: Stop,
) -> Result<(DVector<f64>, f64), DenseError> {
    let root = unknowns.inertia.map(|d| 1.0 / d.sqrt());
    let scaled = DMatrix::from_fn(root.len(), root.len(), |i, j| stiffness[(i, j)] * root[i] * root[j]);
    let symmetric = (&scaled + scaled.transpose()) * 0.5;
    let size = symmetric.amax().max(1e-6);
    let right = residual.component_mul(&root);
    // forces without an energy: what their stiffness does is not given by its symmetric part
    if regularisation == 0.0 && (&scaled - scaled.transpose()).amax() > 1e-6 * size {
        let solved = Lu::new(scaled.clone(), stop)?.solve(&right).ok();
        if let Some(step) = solved.filter(|s| s.dot(&right) > 0.0).map(|s| s.component_mul(&root))
            && unknowns.limit(&step) >= 1.0
        {
            return Ok((step, 0.0));
        }
    }
    let mut needed = regularisation;
    let mut next = (1e-9 * size).max(10.0 * UNRESTRAINED_EIGENVALUE);
    loop {
        let mut held = symmetric.clone();
        held.iter_mut().step_by(root.len() + 1).for_each(|d| *d += needed - UNRESTRAINED_EIGENVALUE);
        match Cholesky::new(held, stop) {
            Err(DenseError::NotPositive) if needed <= 1e3 * size => {}
            Ok(_) | Err(DenseError::NotPositive) => break,
            Err(error) => return Err(error),
        }
        needed = needed.max(next);
        next = 10.0 * needed;
    }
    let mut held = scaled;
    held.iter_mut().step_by(root.len() + 1).for_each(|d| *d += needed);
    let solved = Lu::new(held, stop)?.solve(&right);
    Ok((solved.unwrap_or(right).component_mul(&root), needed))
}
