//! The rod: a line whose own dynamics and bending matter.

mod assemble;
mod balance;
mod band;
mod bend;
mod condense;
mod contact;
mod ends;
mod error;
mod hinges;
mod immersed;
mod mesh;
mod modes;
mod on_nodes;
mod results;
mod scheme;
mod section;
mod spatial;
mod start;
mod statics;
mod step;
mod surroundings;
mod system;
mod tension;
#[cfg(test)]
mod tests;
mod trial;
mod workspace;

pub use balance::{Balance, Energy, Work};
pub use condense::EndTangent;
pub use ends::{End, Motion};
pub use error::RodError;
pub use mesh::{MOST_ELEMENTS, Rod, State};
pub use modes::Mode;
pub use results::{NodeResult, Stress};
pub use scheme::Settings;
pub use section::{Attachment, Axial, Segment, Tube};
pub use step::{EndForces, Solver};
pub use surroundings::{Bottom, Fluid, FluidField, Ground, PlaneBottom, UniformFluid, World};
