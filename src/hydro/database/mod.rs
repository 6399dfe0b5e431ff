//! Hydrodynamic databases: what programs of potential flow computed, and the forces it makes in time.
//!
//! The data and its conventions are [`Database`] of the model; [`at`] interpolates it.

pub mod at;
pub mod capytaine;
pub mod checks;
mod matrices;
pub mod nemoh;
mod nemoh_case;
mod rows;
pub mod wamit;
mod wamit_qtf;

pub use crate::model::{Amplitudes, Database, DriftTable, Qtf};
pub use rows::{DatabaseError, SourceFile};
