//! How a run is to go, how it ended and what it did, and who is told as it goes.

use super::scheme::Method;
use super::snapshot::Snapshot;
use super::step::Convergence;

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
