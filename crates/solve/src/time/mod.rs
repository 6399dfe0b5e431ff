//! The time domain: bodies on connectors in wind, current and waves, step by step.
//!
//! Source: [MOSES-REF timdom]. The equations are Newton's and Euler's about the origin of each body, in global axes:
//! `M a = F(t, q, v) - gyroscopic(v)`; connectors and loads are evaluated at the end of each step.

mod accuracy;
mod action;
mod along;
mod compression;
mod corrector;
mod ends;
mod events;
mod force_predictor;
mod forces;
mod history;
mod inertia;
mod newton;
mod parallel;
mod prescribed;
mod resolution;
mod resume;
mod run;
mod run_access;
mod run_requirements;
mod run_settings;
mod scheme;
mod snapshot;
mod statistics;
mod step;

pub use accuracy::{Accuracy, Distortion, POOR_DAMPING, POOR_PERIOD, WorstFollowed};
pub(crate) use action::point_in_body;
pub use action::{Action, ActionKind, Observable, Trigger};
pub use along::{AlongColumns, AlongEnvelope, BentRow, NodeQuantity, NodeRow};
pub use compression::CompressionOnset;
pub(crate) use compression::pull;
pub(crate) use ends::end_of;
pub use forces::{BodyForces, BodyMotion, LoadMemory};
pub use history::{History, LinkColumns, LinkEnds, RowLayout, VALUES_PER_BODY};
pub use prescribed::{Prescribed, build_prescribed};
pub use resolution::{NaturalPeriod, Resolution};
pub use run::{Run, STEPS_PER_SNAPSHOT};
pub use run_requirements::RunRequirements;
pub use run_settings::{Ending, RunCounts, RunFileError, RunSettings, SilentWatcher, Watcher};
pub use scheme::{Method, TimeScheme};
pub use snapshot::Snapshot;
pub use statistics::{ResultSeries, RunStatistics, results};
pub use step::StepTolerance;
