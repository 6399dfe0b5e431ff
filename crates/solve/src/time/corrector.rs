//! A step by predictor and corrector, for `-NEWMARK NO`.

use super::forces::BodyMotion;
use super::scheme::TimeScheme;
use super::step::{StepTolerance, Stepper, SystemInstant, not_finite, unsolved_error};
use crate::system::{SolveError, System};
use windlass_base::pose::Six;
use windlass_model::{ClassError, TimeStep};
use windlass_nonlinear::NewtonStatistics;

impl Stepper {
    /// A step by predictor and corrector: the trapezoidal rule by repetition.
    pub(super) fn corrector(
        &mut self,
        system: &mut System,
        now: &mut SystemInstant,
        dt: f64,
        wanted: &StepTolerance,
    ) -> Result<NewtonStatistics, SolveError> {
        let (time, mut effort) = (now.time + dt, NewtonStatistics::default());
        self.weigh(system, &now.motions);
        self.choose(system, &now.forces);
        if let Some(row) = self.rows.iter().find(|r| !r.heavy) {
            let name = system.nodes.get(row.at / 6).map(|n| n.name.clone());
            let error = ClassError::new("-NEWMARK NO needs inertia in every degree of freedom that moves")
                .help("give it weight, or leave -NEWMARK out");
            return Err(SolveError { who: name, error });
        }
        let start = now.motions.clone();
        let mut ahead = SystemInstant {
            time,
            motions: start.clone(),
            memory: std::mem::take(&mut now.memory),
            ..SystemInstant::default()
        };
        std::mem::swap(&mut ahead.forces, &mut now.forces);
        // Euler's step first, with the place to second order; then the mean of both ends
        let euler = TimeScheme::newmark(0.0, 0.0);
        let trapezoid = TimeScheme::newmark(0.25, 0.5);
        let outcome = self.correct(system, &start, &mut ahead, dt, ([euler, trapezoid], wanted, &mut effort));
        std::mem::swap(&mut ahead.forces, &mut now.forces);
        now.memory = std::mem::take(&mut ahead.memory);
        outcome?;
        self.trial = ahead.motions;
        self.accept(system, now, TimeStep { time, dt });
        Ok(effort)
    }

    fn correct(
        &mut self,
        system: &System,
        start: &[BodyMotion],
        ahead: &mut SystemInstant,
        dt: f64,
        ([euler, trapezoid], wanted, effort): ([TimeScheme; 2], &StepTolerance, &mut NewtonStatistics),
    ) -> Result<(), SolveError> {
        let mut scheme = euler;
        loop {
            self.trial.clear();
            self.trial.extend_from_slice(&ahead.motions);
            self.over.clear();
            self.over.resize(start.len(), Six::zeros());
            self.prescribe(system, TimeStep { time: ahead.time, dt })?;
            self.position(system, start, dt, &scheme);
            self.pose(system, start);
            ahead.motions.clone_from(&self.trial);
            if effort.evaluations == 0 {
                ahead.memory.begin(system, (start, &ahead.motions), TimeStep { time: ahead.time, dt })?;
            }
            let before: Vec<Six> = ahead.motions.iter().map(|m| m.acceleration).collect();
            self.balance(system, ahead, dt)?;
            effort.evaluations += 1;
            let changes = ahead.motions.iter().zip(&before).map(|(m, b)| m.acceleration - b);
            let change = changes.clone().map(|c| c.amax()).fold(0.0, f64::max);
            effort.residual = change / system.gravity;
            if !change.is_finite() {
                return Err(not_finite(system, &ahead.forces.sum, ahead.time));
            }
            if effort.iterations > 0 && change <= wanted.tolerance * system.gravity {
                return Ok(());
            }
            if effort.iterations >= wanted.most {
                let worst = changes.enumerate().map(|(body, c)| (6 * body + c.iamax(), c.amax()));
                let worst = worst.reduce(|a, b| if b.1 > a.1 { b } else { a }).map_or(0, |(at, _)| at);
                let (time, what) = (ahead.time, "the acceleration still changes by");
                return Err(unsolved_error(system, worst, change, TimeStep { time, dt }, what));
            }
            effort.iterations += 1;
            scheme = trapezoid;
        }
    }
}
