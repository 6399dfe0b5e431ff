//! Engines over the model: the system of bodies and connectors, its equilibrium, its stiffness and natural periods, its
//! restoring forces. They know nothing of commands, files or printing.

mod change;
mod equilibrium;
pub mod excursion;
pub mod excursion_tables;
pub mod film;
pub mod frequency;
mod link;
mod modes;
pub mod offset;
mod outline;
pub mod pretension;
pub mod results;
pub mod run_tables;
pub mod scene;
mod search;
mod settle;
mod system;
pub mod tables;
pub mod tethered;
pub mod time;
mod unknowns;
pub mod watch;

pub use equilibrium::{Equilibrium, Options, equilibrium};
pub use modes::{Mode, modes};
pub use settle::{Settled, settle};
pub use system::{Contribution, FREEDOMS, Node, SolveError, State, System};
