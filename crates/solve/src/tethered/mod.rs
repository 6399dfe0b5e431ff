//! Tethers in time: what the model says of them, of the structure that they hold and of the water, made into a case of the tether
//! engine; its run, kept; and tables of it.
//!
//! A towed tether runs alone: its vessel is taken as at rest. Installed tethers run with the one body that they are attached to, and with
//! its other connectors.
//!
//! Source: [AQWA-TETHER chapters 1 to 4].

mod actions;
mod case;
mod history;
mod modal;
mod moored;
mod run_record;
mod statistics;
mod structure;
mod tables;

pub use case::{TetherCase, TowedCase, TowingVessel, case};
pub use history::{StructureHistory, TetherHistory, TetherQuantity, TetherRunEvent};
pub use modal::{description_table, names, natural};
pub use run_record::{TetherRun, statistics_tables};
pub use statistics::{StatisticsSteps, TetherStatistics};
pub use structure::{harmonics, structure, structure_series};
pub use tables::{HistoryTarget, actions, events, forces, motions, run_table, series, table_along_tether};

use crate::SolveError;
use crate::time::{RunFileError, Watcher};
use windlass_model::{ClassError, Model};
use windlass_signal::running::Running;

/// How a run of tethers goes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TetherRunSettings {
    /// Time of its first instant (s), zero or more.
    pub start: f64,
    /// Time from there to its end (s).
    pub observed: f64,
    /// Step (s).
    pub step: f64,
    /// Steps from one stored instant to the next.
    pub store: usize,
    /// With the peculiarities of AQWA 5.4, of which [AQWA-TETHER 8] has listings.
    pub compatible: bool,
    /// Factor on slam of a towed tether; 0 leaves it out.
    pub slam: f64,
    /// Velocity over the ground of the tow of a towed tether, global x and y (m/s).
    pub tow: [f64; 2],
    /// Time from the start that statistics leave out (s).
    pub transient: f64,
    /// Whether the stored instants are kept; else statistics of them alone are.
    pub keep: bool,
}

/// A run of tethers.
#[derive(Clone, Debug)]
pub struct Tethered {
    /// How it went.
    pub settings: TetherRunSettings,
    /// The stored instants (s).
    pub times: Vec<f64>,
    /// The structure, of installed tethers.
    pub structure: Option<StructureHistory>,
    /// The tethers, in the order of the model.
    pub tethers: Vec<TetherHistory>,
    /// What happened on the way.
    pub happened: Vec<TetherRunEvent>,
    /// The actions of the run: names, and when they happened (s), where they have.
    pub actions: Vec<(String, Option<f64>)>,
    /// Seed of the random phases of its sea, where they are random.
    pub seed: Option<u64>,
    /// What a user should know of how the case was made.
    pub notes: Vec<String>,
    /// Whether it was interrupted before its end.
    pub interrupted: bool,
    /// Statistics of each value of a stored instant behind the transient, where the instants are not kept: structure, then nodes and ends of each tether.
    pub running: Vec<Running>,
}

/// Values kept at most: some 4 GB.
const MAX_STORED_VALUES: f64 = 5e8;

impl TetherRunSettings {
    /// Time from which on statistics are of it (s): behind its transient.
    pub fn statistics_start(&self) -> f64 {
        self.start + self.transient
    }

    /// Time of a step, from 0 at the start (s).
    fn time(&self, step: usize) -> f64 {
        self.start + step as f64 * self.step
    }

    /// Number of states, the first counted.
    fn states(&self) -> usize {
        (self.observed / self.step + 1e-9).floor().max(0.0) as usize + 1
    }

    fn check(&self) -> Result<(), ClassError> {
        let sound = |value: f64| value.is_finite() && value > 0.0;
        if self.start.is_finite()
            && self.start >= 0.0
            && sound(self.observed)
            && sound(self.step)
            && self.step <= self.observed
        {
            return Ok(());
        }
        Err(ClassError::new(
            "a run of tethers needs a time and a step above zero, a start that is not negative, the step not longer than the time",
        ))
    }

    /// Refuses to keep more than memory has.
    fn room(&self, values: usize) -> Result<(), ClassError> {
        let instants = if self.keep { self.states() as f64 / self.store.max(1) as f64 } else { 1.0 };
        if instants * values as f64 <= MAX_STORED_VALUES {
            return Ok(());
        }
        let store = (self.states() as f64 * values as f64 / MAX_STORED_VALUES).ceil();
        Err(ClassError::new(format!("this run would keep {:.1E} numbers", instants * values as f64))
            .help(format!("-STORE {store} keeps fewer instants, -STATISTICS none")))
    }
}

/// Whether a model has tethers that act.
pub fn has_tethers(model: &Model) -> bool {
    model.connectors.values().any(|c| c.active && !case::sections(model, c).is_empty())
}

/// Runs the tethers of a model; `should_continue` is asked at every state.
///
/// # Errors
/// A model without tethers, or with what does not run with them; what the engine refuses.
pub fn run(
    model: &Model,
    settings: TetherRunSettings,
    should_continue: &mut dyn FnMut(f64) -> bool,
) -> Result<Tethered, SolveError> {
    struct ProgressWatcher<'a>(&'a mut dyn FnMut(f64) -> bool);
    impl Watcher for ProgressWatcher<'_> {
        fn row(&mut self, _row: &[f64]) -> Result<(), RunFileError> {
            Ok(())
        }

        fn should_continue(&mut self, time: f64) -> bool {
            (self.0)(time)
        }
    }
    TetherRun::new(model, &[], settings)?.run(&mut ProgressWatcher(should_continue))
}
