//! A run: steps from a start to an end, with what happens on the way, and rows kept.

use super::accuracy::Accuracy;
use super::action::Action;
use super::along::AlongEnvelope;
use super::forces::{BodyMotion, LoadMemory};
use super::history::{History, RowLayout, RowSources};
use super::inertia::gyroscopic;
use super::resolution::Resolution;
use super::run_requirements::RunRequirements;
use super::run_settings::{Ending, RunCounts, RunFileError, RunSettings, Watcher};
use super::statistics::RunStatistics;
use super::step::{Stepper, SystemInstant};
use crate::system::{SolveError, System, mass_block, moving_nodes};
use std::sync::Arc;
use windlass_base::geometry::Place;
use windlass_base::pose::Six;
use windlass_hydro::sea::Sea;
use windlass_model::{ClassError, Model, TimeStep};
use windlass_signal::SeriesError;

/// Times a step may be halved.
const MAX_STEP_HALVINGS: u32 = 12;
/// Times a step is halved to meet a condition.
const EVENT_BISECTIONS: u32 = 6;
/// Steps between two snapshots, at which what solvers remember is forgotten.
pub const STEPS_PER_SNAPSHOT: usize = 500;

/// A run.
#[derive(Debug)]
pub struct Run {
    /// The model, with the connectors and lengths of now; bodies stand where they began.
    pub model: Model,
    /// How it goes.
    pub settings: RunSettings,
    /// What happens.
    pub actions: Vec<Action>,
    /// When each action happened (s).
    pub fired: Vec<Option<f64>>,
    /// Rows.
    pub history: History,
    /// Statistics of the stored instants behind the transient.
    pub statistics: RunStatistics,
    /// Least and most along each line of the layout behind the transient, of a run that keeps no rows.
    pub envelopes: Vec<AlongEnvelope>,
    /// What it did.
    pub counts: RunCounts,
    /// What its step has to follow, as it is at the start.
    pub resolution: Resolution,
    /// What it has seen of its own steps.
    pub accuracy: Accuracy,
    /// The sea now.
    pub sea: Option<Arc<Sea>>,
    pub(super) system: System,
    pub(super) now: SystemInstant,
    pub(super) taken: usize,
    pub(super) winches: Vec<(String, f64, Option<f64>)>,
    stepper: Stepper,
    pub(super) near: Vec<Place>,
    row: Vec<f64>,
    row_sources: RowSources,
    /// Whether a length has changed since the last row.
    pub(super) wound: bool,
    /// The seas of the run, each with the time since when it has been there (s).
    pub seas: Vec<(f64, Option<Arc<Sea>>)>,
    /// From what it began, for who reads of it.
    pub began: String,
    origin: Model,
    start: Vec<(usize, Six)>,
}

/// What stood before a part of a step.
struct Checkpoint {
    time: f64,
    motions: Vec<BodyMotion>,
    memory: LoadMemory,
    states: Vec<f64>,
}

/// A watcher could not store what it was given: the disk is full, say.
fn unkept(error: RunFileError) -> SolveError {
    SolveError::new(ClassError::new(error.to_string()).help(
        "the run ends here and what it has stays for PRCPOST; with room for its file, TDOM -RESTART goes on from the last snapshot there",
    ))
}

impl Run {
    /// A run of a model from its present configuration, at rest.
    ///
    /// # Errors
    /// The body or connector that makes no part of it; an action on what is not there.
    pub fn new(model: &Model, settings: RunSettings, actions: Vec<Action>) -> Result<Self, SolveError> {
        model.check_motions().map_err(SolveError::new)?;
        let (origin, model) = (model.clone(), model.clone());
        let sea = Sea::new(&model, &model.environment).map_err(SolveError::new)?.map(Arc::new);
        let duties = RunRequirements::new(&model, &actions, &settings);
        let system = System::under_way(&model, sea.as_ref(), duties)?;
        let mut links = system.link_ends();
        for name in actions.iter().filter_map(|a| a.when.connector()) {
            if !links.iter().any(|l| l.name.eq_ignore_ascii_case(name)) {
                system.ends_of(&model, name)?;
            }
        }
        for name in actions.iter().flat_map(|a| a.connectors()) {
            if !links.iter().any(|l| l.name.eq_ignore_ascii_case(name)) {
                links.push(system.ends_of(&model, name)?);
            }
        }
        let mut later = Vec::new();
        for environment in actions.iter().filter_map(|a| model.environments.get(&Model::key(a.environment()?))) {
            let changed = Model { environment: environment.clone(), ..model.clone() };
            let sea = Sea::new(&changed, environment).map_err(SolveError::new)?.map(Arc::new);
            later.extend(moving_nodes(&changed, sea.as_ref())?);
        }
        let layout = RowLayout::new(&system, &later, links, settings.along);
        settings.fits(&layout)?;
        let motions: Vec<BodyMotion> =
            system.state(&model).poses.into_iter().map(|pose| BodyMotion { pose, ..BodyMotion::default() }).collect();
        let memory = LoadMemory::new(&system);
        let fired = vec![None; actions.len()];
        let near = model.bodies.values().map(|b| b.position).collect();
        let start = model.environment.run_start;
        let statistics_start = start + settings.transient;
        let mut run = Run {
            now: SystemInstant { time: start, motions, memory, ..SystemInstant::default() },
            model,
            settings,
            actions,
            fired,
            statistics: RunStatistics::new(&layout, statistics_start),
            envelopes: vec![AlongEnvelope::default(); layout.links.len()],
            history: History::new(layout),
            counts: RunCounts::default(),
            resolution: Resolution::default(),
            accuracy: Accuracy::default(),
            seas: vec![(start, sea.clone())],
            sea,
            system,
            taken: 0,
            winches: Vec::new(),
            stepper: Stepper::default(),
            near,
            row: Vec::new(),
            row_sources: RowSources::default(),
            wound: true,
            began: "as the bodies stand, at rest".into(),
            origin,
            start: Vec::new(),
        };
        run.check_actions()?;
        run.prescribe()?;
        let poses: Vec<_> = run.now.motions.iter().map(|m| m.pose).collect();
        if let Some(lacks) = run.system.without_inertia(&poses) {
            return Err(lacks);
        }
        run.prepare()?;
        Ok(run)
    }

    /// The same run from its start, with other settings.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn restart_with(&self, change: impl FnOnce(RunSettings) -> RunSettings) -> Result<Run, SolveError> {
        let mut again = Run::new(&self.origin, change(self.settings.clone()), self.actions.clone())?;
        again.began.clone_from(&self.began);
        if !self.start.is_empty() {
            again.begin_with(&self.start)?;
        }
        Ok(again)
    }

    /// Gives bodies velocities to begin with (m/s, rad/s, global axes).
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn begin_with(&mut self, velocities: &[(usize, Six)]) -> Result<(), SolveError> {
        self.start = velocities.to_vec();
        for (body, velocity) in velocities {
            if let Some(motion) = self.now.motions.get_mut(*body) {
                motion.velocity = *velocity;
            }
        }
        self.prepare()
    }

    /// Accelerations that balance the forces as they are now.
    pub(super) fn prepare(&mut self) -> Result<(), SolveError> {
        self.now.memory.begin(
            &self.system,
            (&self.now.motions, &self.now.motions),
            TimeStep { time: self.now.time, dt: 0.0 },
        )?;
        self.stepper.balance(&self.system, &mut self.now, 0.0)?;
        // with the accelerations found, which what has inertia of its own feels
        let SystemInstant { time, motions, memory, forces } = &mut self.now;
        forces.evaluate(&self.system, memory, motions, TimeStep { time: *time, dt: 0.0 })?;
        // a dynamic line begins where it hangs
        self.system.begin_dynamic_lines(&self.now.forces.trial);
        self.resolution = Resolution::from_run(self);
        Ok(())
    }

    /// Time of its first instant (s).
    pub fn start(&self) -> f64 {
        self.origin.environment.run_start
    }

    /// Time of its end, if nothing ends it before (s).
    pub fn end(&self) -> f64 {
        self.start() + self.settings.observed
    }

    /// Time from which on statistics are of it (s): behind its transient.
    pub fn statistics_start(&self) -> f64 {
        self.start() + self.settings.transient
    }

    /// Takes steps to the end.
    ///
    /// # Errors
    /// A body or connector without an answer, or a watcher that could not keep a row; rows so far are kept.
    pub fn run(&mut self, watcher: &mut dyn Watcher) -> Result<Ending, SolveError> {
        let ended = self.steps(watcher);
        let kept = watcher.finish().map_err(unkept);
        ended.and_then(|ending| kept.map(|()| ending))
    }

    fn steps(&mut self, watcher: &mut dyn Watcher) -> Result<Ending, SolveError> {
        let steps = (self.settings.observed / self.settings.dt - 1e-9).ceil().max(0.0) as usize;
        // one that goes on from its start has that row
        if self.taken == 0 && self.history.is_empty() {
            let stop = self.process_events()?;
            self.record(watcher)?;
            self.write_snapshot(watcher)?;
            if let Some(name) = stop {
                return Ok(Ending::Stopped(name));
            }
        }
        while self.taken < steps {
            if !watcher.should_continue(self.now.time) {
                return Ok(Ending::Interrupted);
            }
            let end = self.start() + (self.settings.dt * (self.taken + 1) as f64).min(self.settings.observed);
            let mut stop = match self.advance_to(end) {
                Ok(stop) => stop,
                // a factorisation that listened ends its step with an error
                Err(_) if !watcher.should_continue(self.now.time) => return Ok(Ending::Interrupted),
                Err(error) => {
                    // from here -RESTART goes on, with what made it fail put right
                    self.write_snapshot(watcher)?;
                    return Err(error);
                }
            };
            self.taken += 1;
            if stop.is_none() {
                // the step's own time, so that no rounding adds up
                self.now.time = end;
                stop = self.process_events()?;
            }
            let capsized = self.find_capsized_body();
            let last = self.taken == steps || stop.is_some() || capsized.is_some();
            if last || self.taken.is_multiple_of(self.settings.store.max(1)) {
                self.record(watcher)?;
            }
            if let Some(name) = stop {
                return Ok(Ending::Stopped(name));
            }
            if let Some(name) = capsized {
                return Ok(Ending::Capsized(name));
            }
            if self.taken.is_multiple_of(STEPS_PER_SNAPSHOT) {
                self.write_snapshot(watcher)?;
            }
        }
        Ok(Ending::Done)
    }

    /// Goes to a time, in as many parts as that needs; gives the name of an action that ends the run before.
    fn advance_to(&mut self, end: f64) -> Result<Option<String>, SolveError> {
        // halvings for the error or a balance, and to locate a trigger
        let (mut level, mut sought) = (0, 0);
        loop {
            let left = end - self.now.time;
            if left <= 1e-9 * self.settings.dt {
                return Ok(None);
            }
            let mut part = (self.settings.dt / f64::from(1u32 << (level + sought).min(MAX_STEP_HALVINGS))).min(left);
            if !self.winches.is_empty() {
                part = part.min(self.part_to_wind()?);
            }
            // an action at a time ends a step there
            if let Some(at) = self.next_action(end)
                && at > self.now.time + 1e-9 * self.settings.dt
            {
                part = part.min(at - self.now.time);
            }
            let before = (self.settings.adaptive.is_some() || self.waits()).then(|| self.checkpoint());
            let winches = self.wind(self.now.time + part)?;
            match self.stepper.step(
                &mut self.system,
                &mut self.now,
                part,
                (&self.settings.method, &self.settings.convergence),
            ) {
                Ok(effort) => {
                    self.counts.iterations += effort.iterations;
                    self.counts.evaluations += effort.evaluations;
                    if let Some(before) = before {
                        let error = self.settings.method.error_of_step(self.now.motions.iter(), part);
                        let rough =
                            self.settings.adaptive.is_some_and(|allowed| error > allowed) && level < MAX_STEP_HALVINGS;
                        let sudden = sought < EVENT_BISECTIONS && self.trigger_crossed();
                        if rough || sudden {
                            self.unwind(winches);
                            self.rollback(before);
                            level += u32::from(rough);
                            sought += u32::from(!rough);
                            continue;
                        }
                        if self.settings.adaptive.is_some_and(|allowed| error < allowed / 10.0) {
                            level = level.saturating_sub(1);
                        }
                    }
                    self.counts.steps += 1;
                    let (nodes, motions) = (&self.system.nodes, &self.now.motions);
                    self.accuracy.take(nodes, motions, &self.settings.method, (self.now.time, part));
                    if part < self.settings.dt * 0.999 {
                        let fired = self.fired.iter().flatten().count();
                        if let Some(name) = self.process_events()? {
                            return Ok(Some(name));
                        }
                        if self.fired.iter().flatten().count() > fired {
                            sought = 0;
                        }
                    }
                }
                Err(error) => {
                    self.unwind(winches);
                    if error.error.lasting {
                        return Err(error);
                    }
                    if level >= MAX_STEP_HALVINGS {
                        return Err(self.find_line_nearly_reeled_in().unwrap_or_else(|| self.reason(error)));
                    }
                    self.counts.cut += 1;
                    level += 1;
                }
            }
        }
    }

    /// What is behind a step without a solution, where that can be determined.
    fn reason(&self, error: SolveError) -> SolveError {
        let poses: Vec<_> = self.now.motions.iter().map(|m| m.pose).collect();
        if let Some(lacks) = self.system.without_inertia(&poses) {
            let help = error.error.message.without_values();
            return SolveError { error: lacks.error.help(help), ..lacks };
        }
        let sunk = |body: usize| {
            let motion = self.now.motions.get(body)?;
            let began = self.origin.bodies.get_index(body)?.1.position.shift[2];
            (motion.velocity[2] < 0.0).then_some(began - motion.pose.origin.z)
        };
        self.system.because_it_sinks(error, &sunk)
    }

    /// What a part of a step changes.
    fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            time: self.now.time,
            motions: self.now.motions.clone(),
            memory: self.now.memory.clone(),
            states: self.system.states.clone(),
        }
    }

    /// Forgets a part of a step.
    fn rollback(&mut self, before: Checkpoint) {
        (self.now.time, self.now.motions) = (before.time, before.motions);
        (self.now.memory, self.system.states) = (before.memory, before.states);
        self.now.forces.clear_predictor();
    }

    /// Forgets what solvers remember, so that a run that goes on from a snapshot finds the same digits.
    pub(super) fn clear_caches(&mut self) {
        self.now.forces.caches.clear();
        self.now.forces.ties.forces.clear();
        self.now.forces.clear_predictor();
    }

    fn write_snapshot(&mut self, watcher: &mut dyn Watcher) -> Result<(), SolveError> {
        self.clear_caches();
        watcher.snapshot(&self.snapshot()).map_err(unkept)
    }

    fn record(&mut self, watcher: &mut dyn Watcher) -> Result<(), SolveError> {
        let mut sources = std::mem::take(&mut self.row_sources);
        sources.inertia.clear();
        for (node, motion) in self.system.nodes.iter().zip(&self.now.motions) {
            let a = &motion.acceleration;
            let own = -(mass_block(&node.floating.mass, &motion.pose) * a);
            let added = if node.added { -(node.floating.added_mass(&motion.pose) * a) } else { Six::zeros() };
            sources.inertia.push([own, added, -gyroscopic(&node.floating.mass, motion)]);
        }
        // lengths change by winches alone
        if !self.winches.is_empty() || sources.lengths.is_empty() || self.wound {
            let length =
                |name: &String| self.model.connectors.get(&Model::key(name)).and_then(|c| self.model.first_length(c));
            sources.lengths.clear();
            sources.lengths.extend(self.history.layout.links.iter().map(|l| length(&l.name)));
            self.wound = false;
        }
        let (layout, now) = (&self.history.layout, &mut self.now);
        let parts = (now.motions.as_slice(), &mut now.forces, &mut sources);
        layout.write((&self.system, now.time), parts, &mut self.near, &mut self.row)?;
        self.row_sources = sources;
        let wrong = |e: SeriesError| SolveError::new(ClassError::new(e.to_string()));
        self.statistics.take(&self.row).map_err(wrong)?;
        if self.settings.keep {
            self.history.values.extend_from_slice(&self.row);
        } else if now.time >= self.origin.environment.run_start + self.settings.transient {
            for (link, envelope) in self.history.layout.links.iter().zip(&mut self.envelopes) {
                if let Some(along) = &link.along {
                    envelope.take(along, &self.row).map_err(wrong)?;
                }
            }
        }
        watcher.row(&self.row).map_err(unkept)
    }

    fn find_capsized_body(&self) -> Option<String> {
        if self.settings.capsize {
            return None;
        }
        let over = |m: &BodyMotion| m.pose.axes[(2, 2)] < 0.0;
        let found = self.system.nodes.iter().zip(&self.now.motions).find(|(n, m)| !n.junction && over(m));
        found.map(|(n, _)| n.name.clone())
    }
}
