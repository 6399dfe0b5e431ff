//! The rod: a line whose own dynamics and bending matter.
//!
//! A [`Rod`] is what the line is: [`Segment`]s cut into elements, and [`Attachment`]s on their nodes. A [`State`] is
//! where it is and how it moves. A [`Solver`] holds the memory of a run: [`Solver::statics`] brings a state to rest,
//! [`Solver::step`] takes it on in time, or [`Solver::trial`] and [`Solver::accept`] with a body at an end that must
//! find its own motion by [`Solver::end_tangent`]; [`Solver::modes`] finds how it swings. A [`World`] says what
//! surrounds it, an [`End`] what holds it. [`Rod::results`] gives tensions, moments and stresses along it,
//! [`Balance`] keeps the books of energy and momentum.
//!
//! SI units (m, kg, s, N, rad), global axes with z up. End A is the first node. Nothing is allocated in a step, and a
//! step costs as much as its elements: one pass over them, and a band to factor.
//!
//! # Example
//! A chain of 100 kg/m hangs in air between two points 90 m apart: both ends together carry its weight.
//! ```
//! use nalgebra::Vector3;
//! use windlass_line_dynamics::{End, Rod, Segment, Settings, Solver, State, UniformFluid, World};
//!
//! let rod = Rod::new("chain", vec![Segment::line(100.0, 20, 100.0, 1e9, 0.1)], vec![])?;
//! let ends = [Vector3::zeros(), Vector3::new(90.0, 0.0, 0.0)];
//! let mut state = State::along(&rod, &[ends[0], Vector3::new(45.0, 0.0, -20.0), ends[1]])?;
//! let air = UniformFluid::none();
//! let mut solver = Solver::new(&rod, Settings::default());
//! let held = solver.statics(&rod, &mut state, &World::new(&air, 9.81), ends.map(End::pinned))?;
//! assert!((held.force[0].z + held.force[1].z + 100.0 * 100.0 * 9.81).abs() < 1.0);
//! # Ok::<(), windlass_line_dynamics::RodError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod abreast;
mod again;
mod assemble;
mod balance;
mod band;
mod bend;
mod books;
mod condense;
mod contact;
mod continuation;
mod drawn;
mod ends;
mod error;
mod falls;
mod held;
mod hinges;
mod immersed;
mod iterate;
mod mesh;
mod modes;
mod nearby;
mod on_nodes;
mod results;
mod rope;
mod scheme;
mod section;
mod settle;
mod snap;
mod snapshot;
mod spatial;
mod start;
mod state;
mod statics;
mod step;
mod supports;
mod surroundings;
mod system;
mod tension;
#[cfg(test)]
mod tests;
mod trial;
mod winch;
mod workspace;

pub use balance::{Balance, Energy, Work};
pub use condense::{EndTangent, Twelve};
pub use ends::{End, Motion};
pub use error::RodError;
pub use mesh::{BYTES_PER_ELEMENT, MOST_ELEMENTS, Rod};
pub use modes::Mode;
pub use rope::Viscoelastic;
pub use scheme::Settings;
pub use section::{Attachment, Axial, Segment, Tube};
pub use state::State;
pub use step::{EndForces, Solver};
pub use supports::{OnSupport, SupportTangent};
pub use surroundings::{
    Bottom, Fluid, FluidField, Grip, Gripped, Ground, Holds, PlaneBottom, Support, UniformFluid, World,
};
