//! Hydrodynamic databases: what programs of potential flow computed, and the forces it makes in time.
//!
//! The data and its conventions are [`Database`] of the model. Sources are read by [`wamit`], [`nemoh`], [`capytaine`], [`aqwa`] and [`rao`]; [`interpolation`]
//! interpolates; [`radiation`], [`interaction`], [`excitation`], [`slow_drift`] and [`drift_damping`] make the loads on a body, which [`attached`] puts together.

pub mod aqwa;
pub mod attached;
pub mod capytaine;
pub mod checks;
pub mod drift_damping;
pub mod excitation;
pub mod interaction;
pub mod interpolation;
mod matrices;
pub mod memory;
pub mod nemoh;
mod nemoh_case;
pub mod radiation;
pub mod rao;
mod rows;
pub mod slow_drift;
mod symmetry;
pub mod typed;
pub mod wamit;
mod wamit_qtf;
mod waves;

pub use interpolation::{DatabaseLookup, drift_at};
pub use rows::{DatabaseError, SourceFile};
pub use slow_drift::mean_drift;
pub use symmetry::mirror_headings;
pub use windlass_model::{Amplitudes, Database, DriftTable, Qtf};
