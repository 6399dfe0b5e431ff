//! Engines over the model: the system of bodies and connectors, its equilibrium, its stiffness and natural periods, its
//! restoring forces. They know nothing of commands, files or printing.
//!
//! # Example
//! A body of 1 MN that floats with 0.9 MN of buoyancy at z = 0 and a heave stiffness of 0.5 MN/m sinks by 0.2 m:
//! ```
//! use nalgebra::{Matrix6, Vector6};
//! use windlass_model::{Body, LinearHydrostatics, Model, Part, Weight};
//! use windlass_solve::{EquilibriumOptions, find_equilibrium_with_rebuilds};
//!
//! let linear = LinearHydrostatics {
//!     at: [0.0; 3],
//!     height: 0.0,
//!     buoyancy: 0.9e6,
//!     stiffness: Matrix6::from_diagonal(&Vector6::repeat(0.5e6)),
//!     span: Default::default(),
//! };
//! let weight = Weight { weight: 1e6, radii: [5.0; 3], ..Weight::default() };
//! let part = Part { name: "B".into(), body: "B".into(), weights: vec![weight], ..Part::default() };
//! let mut model = Model::default();
//! model.bodies.insert("B".into(), Body { name: "B".into(), linear: Some(linear), ..Body::default() });
//! model.parts.insert("B".into(), part);
//! find_equilibrium_with_rebuilds(&mut model, &EquilibriumOptions::default())?;
//! assert!((model.bodies["B"].position.shift[2] + 0.2).abs() < 1e-9);
//! # Ok::<(), windlass_solve::SolveError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beyond_database;
pub mod drift_damping;
mod equilibrium;
pub mod excursion;
pub mod excursion_tables;
mod failure_reasons;
pub mod film;
pub mod frequency;
pub mod line_loss;
mod link;
mod modes;
pub mod offset;
mod outline;
mod parts;
pub mod pretension;
mod rebuild;
pub mod results;
pub mod run_tables;
pub mod scene;
pub mod screening;
mod search;
pub mod slow_checks;
mod system;
mod system_changes;
pub mod tables;
pub mod tethered;
mod ties;
pub mod time;
mod unknowns;
pub mod watch;

pub use equilibrium::{Equilibrium, EquilibriumOptions, equilibrium};
pub use modes::{SystemMode, modes};
pub use rebuild::{EquilibriumResult, find_equilibrium_with_rebuilds};
pub use system::{Contribution, DOFS, SolveError, System, SystemBody, SystemState};
