//! Hydrodynamic databases: what programs of potential flow computed, and the forces it makes in time.
//!
//! The data and its conventions are [`Database`] of the model; [`at`] interpolates it.

mod at;

pub use crate::model::{Amplitudes, Database, DriftTable, Qtf};
