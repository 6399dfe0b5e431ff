//! A run: steps from a start to an end, with what happens on the way, and rows kept.

use super::action::Action;
use super::forces::{Memory, Motion};
use super::history::{History, Layout, Told};
use super::inertia::gyroscopic;
use super::scheme::Method;
use super::snapshot::Snapshot;
use super::statistics::Statistics;
use super::step::{Convergence, Effort, Instant, Stepper};
use crate::hydro::sea::Sea;
use crate::model::{ClassError, Model, Place, Six};
use crate::post::SeriesError;
use crate::solve::system::{SolveError, System, mass_block};
use std::sync::Arc;

/// Times a step may be halved.
const HALVINGS: u32 = 12;
/// Steps between two snapshots, at which what solvers remember is forgotten.
pub const SNAPSHOT: usize = 500;

/// How a run goes.
#[derive(Clone, Debug, PartialEq)]
pub struct Settings {
    /// Length of the run (s).
    pub observed: f64,
    /// Step (s).
    pub dt: f64,
    /// Scheme.
    pub method: Method,
    /// When a step is solved.
    pub convergence: Convergence,
    /// Steps from one stored instant to the next.
    pub store: usize,
    /// Goes on when a body has rolled or pitched beyond 90 degrees.
    pub capsize: bool,
    /// Largest error of place of one step (m; rotations times 10 m): steps are halved as it asks. None: steps are as given.
    pub adaptive: Option<f64>,
    /// Keeps rows. Without, only who is told of them has them.
    pub keep: bool,
    /// Time that statistics leave out at the beginning (s).
    pub transient: f64,
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// At its end.
    Done,
    /// It was told to stop.
    Interrupted,
    /// A body rolled or pitched beyond 90 degrees.
    Capsized(String),
    /// An action ended it.
    Stopped(String),
}

/// What a run did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Counts {
    /// Steps taken, those that were halved by their parts.
    pub steps: usize,
    /// Steps that had to be cut because no balance was found.
    pub cut: usize,
    /// Iterations.
    pub iterations: usize,
    /// Evaluations of all forces.
    pub evaluations: usize,
}

/// Who is told how a run goes.
pub trait Watcher {
    /// A stored row.
    ///
    /// # Errors
    /// It could not be kept, in one sentence: the run ends.
    fn row(&mut self, row: &[f64]) -> Result<(), String>;

    /// Everything needed to go on from here.
    ///
    /// # Errors
    /// It could not be kept, in one sentence: the run ends.
    fn snapshot(&mut self, _snapshot: &Snapshot) -> Result<(), String> {
        Ok(())
    }

    /// No more comes.
    ///
    /// # Errors
    /// What came could not be kept, in one sentence.
    fn finish(&mut self) -> Result<(), String> {
        Ok(())
    }

    /// Asked before every step; false ends the run, which keeps what it has.
    fn goes_on(&mut self, _time: f64) -> bool {
        true
    }
}

/// A run.
#[derive(Debug)]
pub struct Run {
    /// The model, with the connectors and lengths of now; bodies stand where they began.
    pub model: Model,
    /// How it goes.
    pub settings: Settings,
    /// What happens.
    pub actions: Vec<Action>,
    /// When each action happened (s).
    pub fired: Vec<Option<f64>>,
    /// Rows.
    pub history: History,
    /// Statistics of the stored instants behind the transient.
    pub statistics: Statistics,
    /// What it did.
    pub counts: Counts,
    /// The sea now.
    pub sea: Option<Arc<Sea>>,
    pub(super) system: System,
    pub(super) now: Instant,
    pub(super) taken: usize,
    pub(super) winches: Vec<(String, f64, Option<f64>)>,
    stepper: Stepper,
    pub(super) near: Vec<Place>,
    row: Vec<f64>,
    told: Told,
    /// Whether a length has changed since the last row.
    pub(super) wound: bool,
    /// The seas of the run, each with the time since when it has been there (s).
    pub seas: Vec<(f64, Option<Arc<Sea>>)>,
    origin: Model,
    start: Vec<(usize, Six)>,
}

impl Run {
    /// A run of a model from its present configuration, at rest.
    ///
    /// # Errors
    /// The body or connector that makes no part of it; an action on what is not there.
    pub fn new(model: &Model, settings: Settings, actions: Vec<Action>) -> Result<Self, SolveError> {
        let (origin, model) = (model.clone(), model.clone());
        let sea = Sea::of(&model, &model.environment).map_err(SolveError::new)?.map(Arc::new);
        let system = System::under_way(&model, sea.as_ref())?;
        let mut links: Vec<(String, Vec<Option<usize>>)> = system.link_ends();
        for name in actions.iter().flat_map(|a| a.connectors()) {
            if !links.iter().any(|(n, _)| n.eq_ignore_ascii_case(name)) {
                links.push(System::ends_of(&model, name)?);
            }
        }
        let layout = Layout::new(&system, links);
        let motions: Vec<Motion> =
            system.state(&model).poses.into_iter().map(|pose| Motion { pose, ..Motion::default() }).collect();
        let memory = Memory::of(&system);
        let fired = vec![None; actions.len()];
        let near = model.bodies.values().map(|b| b.place).collect();
        let from = settings.transient;
        let mut run = Run {
            now: Instant { motions, memory, ..Instant::default() },
            model,
            settings,
            actions,
            fired,
            statistics: Statistics::new(&layout, from),
            history: History::new(layout),
            counts: Counts::default(),
            seas: vec![(0.0, sea.clone())],
            sea,
            system,
            taken: 0,
            winches: Vec::new(),
            stepper: Stepper::default(),
            near,
            row: Vec::new(),
            told: Told::default(),
            wound: true,
            origin,
            start: Vec::new(),
        };
        run.check_actions()?;
        run.prescribe()?;
        run.prepare()?;
        Ok(run)
    }

    /// The same run from its start, with other settings.
    ///
    /// # Errors
    /// As [`Run::new`].
    pub fn begun_again(&self, change: impl FnOnce(Settings) -> Settings) -> Result<Run, SolveError> {
        let mut again = Run::new(&self.origin, change(self.settings.clone()), self.actions.clone())?;
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
        self.now.memory.begin(&self.system, (&self.now.motions, &self.now.motions), (self.now.time, 0.0))?;
        self.stepper.balance(&self.system, &mut self.now, 0.0)
    }

    /// Takes steps to the end.
    ///
    /// # Errors
    /// A body or connector without an answer, or a watcher that could not keep a row; rows so far are kept.
    pub fn go(&mut self, watcher: &mut dyn Watcher) -> Result<Ending, SolveError> {
        let ended = self.steps(watcher);
        let kept = watcher.finish().map_err(|text| SolveError::new(ClassError::new(text)));
        ended.and_then(|ending| kept.map(|()| ending))
    }

    fn steps(&mut self, watcher: &mut dyn Watcher) -> Result<Ending, SolveError> {
        let steps = (self.settings.observed / self.settings.dt - 1e-9).ceil().max(0.0) as usize;
        if self.taken == 0 {
            self.keep(watcher)?;
            self.save(watcher)?;
        }
        while self.taken < steps {
            if !watcher.goes_on(self.now.time) {
                return Ok(Ending::Interrupted);
            }
            let end = (self.settings.dt * (self.taken + 1) as f64).min(self.settings.observed);
            self.to(end)?;
            self.taken += 1;
            // the step's own time, so that no rounding adds up
            self.now.time = end;
            let stop = self.happens()?;
            let capsized = self.capsized();
            let last = self.taken == steps || stop.is_some() || capsized.is_some();
            if last || self.taken.is_multiple_of(self.settings.store.max(1)) {
                self.keep(watcher)?;
            }
            if let Some(name) = stop {
                return Ok(Ending::Stopped(name));
            }
            if let Some(name) = capsized {
                return Ok(Ending::Capsized(name));
            }
            if self.taken.is_multiple_of(SNAPSHOT) {
                self.save(watcher)?;
            }
        }
        Ok(Ending::Done)
    }

    /// Goes to a time, in as many parts as that needs.
    fn to(&mut self, end: f64) -> Result<(), SolveError> {
        let mut level = 0;
        loop {
            let left = end - self.now.time;
            if left <= 1e-9 * self.settings.dt {
                return Ok(());
            }
            let mut part = (self.settings.dt / f64::from(1u32 << level)).min(left);
            // an action at a time ends a step there
            if let Some(at) = self.next_action(end)
                && at > self.now.time + 1e-9 * self.settings.dt
            {
                part = part.min(at - self.now.time);
            }
            self.wind(self.now.time + part)?;
            let before = self
                .settings
                .adaptive
                .map(|_| (self.now.motions.clone(), self.now.memory.clone(), self.system.states.clone()));
            let start = self.now.time;
            match self.stepper.step(
                &mut self.system,
                &mut self.now,
                part,
                (&self.settings.method, &self.settings.convergence),
            ) {
                Ok(Effort { iterations, evaluations }) => {
                    self.counts.iterations += iterations;
                    self.counts.evaluations += evaluations;
                    if let (Some(allowed), Some((motions, memory, states))) = (self.settings.adaptive, before) {
                        let error = self.error_of_step(&motions, part);
                        if error > allowed && level < HALVINGS {
                            (self.now.motions, self.now.memory, self.system.states) = (motions, memory, states);
                            self.now.time = start;
                            self.now.forces.unsettle();
                            level += 1;
                            continue;
                        }
                        if error < allowed / 10.0 && level > 0 {
                            level -= 1;
                        }
                    }
                    self.counts.steps += 1;
                    if part < self.settings.dt * 0.999 {
                        self.happens()?;
                    }
                }
                Err(error) if level >= HALVINGS => return Err(error),
                Err(_) => {
                    self.counts.cut += 1;
                    level += 1;
                }
            }
        }
    }

    /// The error of place of one step (m): `h^2 |beta - 1/6|` times the change of the acceleration (Zienkiewicz and Xie, Earthquake
    /// Engineering and Structural Dynamics 20, 1991, 871-887, eq. 12).
    fn error_of_step(&self, before: &[Motion], dt: f64) -> f64 {
        let factor = match self.settings.method {
            Method::Implicit(scheme) => (scheme.beta - 1.0 / 6.0).abs().max(1.0 / 12.0),
            Method::Corrector => 1.0 / 12.0,
        };
        let change = |(new, old): (&Motion, &Motion)| {
            let by = new.acceleration - old.acceleration;
            by.fixed_rows::<3>(0).norm().max(10.0 * by.fixed_rows::<3>(3).norm())
        };
        factor * dt * dt * self.now.motions.iter().zip(before).map(change).fold(0.0, f64::max)
    }

    /// Forgets what solvers remember, so that a run that goes on from a snapshot finds the same digits.
    pub(super) fn forget(&mut self) {
        self.now.forces.guesses.clear();
        self.now.forces.unsettle();
    }

    fn save(&mut self, watcher: &mut dyn Watcher) -> Result<(), SolveError> {
        self.forget();
        watcher.snapshot(&self.snapshot()).map_err(|text| SolveError::new(ClassError::new(text)))
    }

    fn keep(&mut self, watcher: &mut dyn Watcher) -> Result<(), SolveError> {
        let mut told = std::mem::take(&mut self.told);
        told.inertia.clear();
        for (node, motion) in self.system.nodes.iter().zip(&self.now.motions) {
            let a = &motion.acceleration;
            let own = -(mass_block(&node.floating.mass, &motion.pose) * a);
            let added = if node.added { -(node.floating.added(&motion.pose) * a) } else { Six::zeros() };
            told.inertia.push([own, added, -gyroscopic(&node.floating.mass, motion)]);
        }
        // lengths change by winches alone
        if !self.winches.is_empty() || told.lengths.is_empty() || self.wound {
            let length =
                |name: &String| self.model.connectors.get(&Model::key(name)).and_then(|c| self.model.first_length(c));
            told.lengths.clear();
            told.lengths.extend(self.history.layout.links.iter().map(|l| length(&l.name)));
            self.wound = false;
        }
        let (layout, now) = (&self.history.layout, &self.now);
        layout.write((&self.system, now.time), (&now.motions, &now.forces, &told), &mut self.near, &mut self.row);
        self.told = told;
        let wrong = |e: SeriesError| SolveError::new(ClassError::new(e.to_string()));
        self.statistics.take(&self.row).map_err(wrong)?;
        if self.settings.keep {
            self.history.values.extend_from_slice(&self.row);
        }
        watcher.row(&self.row).map_err(|text| SolveError::new(ClassError::new(text)))
    }

    fn capsized(&self) -> Option<String> {
        if self.settings.capsize {
            return None;
        }
        let over = |m: &Motion| m.pose.axes[(2, 2)] < 0.0;
        let found = self.system.nodes.iter().zip(&self.now.motions).find(|(n, m)| !n.junction && over(m));
        found.map(|(n, _)| n.name.clone())
    }

    /// Time reached (s).
    pub fn time(&self) -> f64 {
        self.now.time
    }

    /// Motions now.
    pub fn motions(&self) -> &[Motion] {
        &self.now.motions
    }

    /// The sea at a time (s) of the run: actions may have changed it.
    pub fn sea_at(&self, time: f64) -> Option<&Sea> {
        let found = self.seas.iter().rev().find(|(since, _)| *since <= time).or(self.seas.first());
        found.and_then(|(_, sea)| sea.as_deref())
    }

    /// Everything needed to go on from here.
    pub fn snapshot(&self) -> Snapshot {
        let lengths = self.history.layout.links.iter().map(|l| self.model.connectors.get(&Model::key(&l.name)));
        Snapshot {
            time: self.now.time,
            taken: self.taken,
            motions: self.now.motions.clone(),
            loads: self.now.memory.loads.clone(),
            states: self.system.states.clone(),
            lengths: lengths.map(|c| c.and_then(|c| c.first_length)).collect(),
            fired: self.fired.clone(),
            winches: self.winches.clone(),
            near: self.near.clone(),
            rows: self.history.len(),
            counts: self.counts,
        }
    }
}
