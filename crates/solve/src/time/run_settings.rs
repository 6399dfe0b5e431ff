//! How a run is to go, how it ended and what it did, and who follows it.

use super::along::AlongColumns;
use super::history::RowLayout;
use super::scheme::Method;
use super::snapshot::Snapshot;
use super::step::StepTolerance;
use crate::system::SolveError;
use std::path::PathBuf;
use windlass_model::ClassError;

/// How a run goes.
#[derive(Clone, Debug, PartialEq)]
pub struct RunSettings {
    /// Length of the run (s).
    pub observed: f64,
    /// Step (s).
    pub dt: f64,
    /// Scheme.
    pub method: Method,
    /// When a step is solved.
    pub convergence: StepTolerance,
    /// Steps from one stored instant to the next.
    pub store: usize,
    /// Goes on when a body has rolled or pitched beyond 90 degrees.
    pub capsize: bool,
    /// Largest error of place of one step (m; rotations times 10 m): steps are halved as it asks. None: steps are as given.
    pub adaptive: Option<f64>,
    /// Keeps rows. Without, only watchers have them.
    pub keep: bool,
    /// Of the nodes of dynamic lines every so manieth is kept; 0: none.
    pub along: usize,
    /// Keeps the energy and momentum balance of dynamic lines.
    pub balance: bool,
    /// Time from the start of the run that statistics leave out (s).
    pub transient: f64,
}

/// Most bytes of the rows of a run.
const MAX_RUN_BYTES: f64 = 4e9;

impl RunSettings {
    /// Sees that the rows of a run have room in memory.
    ///
    /// # Errors
    /// They would take more than 4 GB.
    pub fn fits(&self, layout: &RowLayout) -> Result<(), SolveError> {
        if !self.keep {
            return Ok(());
        }
        let rows = (self.observed / self.dt / self.store.max(1) as f64).ceil() + 2.0;
        let bytes = rows * layout.width as f64 * size_of::<f64>() as f64;
        if bytes <= MAX_RUN_BYTES {
            return Ok(());
        }
        let along: usize = layout.links.iter().filter_map(|l| l.along.as_ref()).map(AlongColumns::width).sum();
        let (size, most) = (bytes / 1e9, MAX_RUN_BYTES / 1e9);
        let text = format!(
            "{rows} stored instants of {} numbers each, {along} of them of nodes of lines, take {size:.1} GB of memory: more than {most} GB",
            layout.width
        );
        let help = "-STORE keeps fewer instants, -ALONG fewer nodes of lines, -STATISTICS none of either";
        Err(SolveError::new(ClassError::new(text).help(help)))
    }
}

/// Why a run ended.
#[derive(Clone, Debug, PartialEq)]
pub enum Ending {
    /// At its end.
    Done,
    /// It was interrupted.
    Interrupted,
    /// A body rolled or pitched beyond 90 degrees.
    Capsized(String),
    /// An action ended it.
    Stopped(String),
}

/// What a run did.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RunCounts {
    /// Steps taken, those that were halved by their parts.
    pub steps: usize,
    /// Steps that had to be cut because no balance was found.
    pub cut: usize,
    /// Iterations.
    pub iterations: usize,
    /// Evaluations of all forces.
    pub evaluations: usize,
}

/// Why what came of a run could not be kept in its file.
#[derive(Debug, thiserror::Error)]
pub enum RunFileError {
    /// The system refused to write.
    #[error("{}: {error}", path.display())]
    Unwritable {
        /// The file.
        path: PathBuf,
        /// Why.
        error: std::io::Error,
    },
    /// Somebody deleted the file.
    #[error("{} was deleted while the run was written to it", path.display())]
    Deleted {
        /// The file.
        path: PathBuf,
    },
}

/// Who follows how a run goes.
pub trait Watcher {
    /// A stored row.
    ///
    /// # Errors
    /// It could not be kept: the run ends.
    fn row(&mut self, row: &[f64]) -> Result<(), RunFileError>;

    /// Everything needed to go on from here.
    ///
    /// # Errors
    /// It could not be kept: the run ends.
    fn snapshot(&mut self, _snapshot: &Snapshot) -> Result<(), RunFileError> {
        Ok(())
    }

    /// No more comes.
    ///
    /// # Errors
    /// What came could not be kept.
    fn finish(&mut self) -> Result<(), RunFileError> {
        Ok(())
    }

    /// Asked before every step; false ends the run, which keeps what it has.
    fn should_continue(&mut self, _time: f64) -> bool {
        true
    }
}

/// Takes rows and says nothing: for a run whose results are read from the run itself.
#[derive(Clone, Copy, Debug, Default)]
pub struct SilentWatcher;

impl Watcher for SilentWatcher {
    fn row(&mut self, _row: &[f64]) -> Result<(), RunFileError> {
        Ok(())
    }
}
