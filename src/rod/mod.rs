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

mod abreast;
mod again;
mod assemble;
mod balance;
mod band;
mod bend;
mod books;
mod condense;
mod contact;
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
