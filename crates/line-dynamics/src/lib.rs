//! Dynamic lines: rods with their own inertia, hydrodynamic loads, bending and seabed contact.
//!
//! A [`Rod`] is what the line is: [`RodSegment`]s cut into elements, and [`Attachment`]s on their nodes. A [`RodState`] is
//! where it is and how it moves. A [`RodSolver`] holds the memory of a run: [`RodSolver::statics`] brings a state to rest,
//! [`RodSolver::step`] takes it on in time, or [`RodSolver::trial`] and [`RodSolver::accept`] with a body at an end that must
//! find its own motion by [`RodSolver::end_tangent`]; [`RodSolver::modes`] finds how it swings. A [`LineEnvironment`] says what
//! surrounds it, an [`RodEnd`] what holds it. [`Rod::results`] gives tensions, moments and stresses along it,
//! [`RodEnergyBalance`] is the energy and momentum balance. [`CoupledLines`] are lines for a program that moves their fairleads.
//!
//! SI units (m, kg, s, N, rad), global axes with z up. End A is the first node. Nothing is allocated in a step, and a
//! step costs as much as its elements: one pass over them, and a band to factor.
//!
//! # Example
//! A chain of 100 kg/m hangs in air between two points 90 m apart: both ends together carry its weight.
//! ```
//! use nalgebra::Vector3;
//! use windlass_line_dynamics::{LineEnvironment, Rod, RodEnd, RodSegment, RodSettings, RodSolver, RodState, UniformFluid};
//!
//! let rod = Rod::new("chain", vec![RodSegment::line(100.0, 20, 100.0, 1e9, 0.1)], vec![])?;
//! let ends = [Vector3::zeros(), Vector3::new(90.0, 0.0, 0.0)];
//! let mut state = RodState::along_points(&rod, &[ends[0], Vector3::new(45.0, 0.0, -20.0), ends[1]])?;
//! let air = UniformFluid::vacuum();
//! let mut solver = RodSolver::new(&rod, RodSettings::default());
//! let held = solver.statics(&rod, &mut state, &LineEnvironment::new(&air, 9.81), ends.map(RodEnd::pin))?;
//! assert!((held.force[0].z + held.force[1].z + 100.0 * 100.0 * 9.81).abs() < 1.0);
//! # Ok::<(), windlass_line_dynamics::RodError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod assemble;
mod balance_snapshot;
mod bend;
mod condense;
mod contact;
mod continuation;
mod coupled;
mod element_batch;
mod element_list;
mod ends;
mod energy_balance;
mod environment;
mod error;
mod euler_fallback;
mod hinges;
mod local_environment;
mod mesh;
mod modes;
mod morison;
mod newton_iteration;
mod nodal_loads;
mod pseudo_transient;
mod results;
mod scheme;
mod section;
mod snapshot;
mod solver;
mod spatial;
mod start_acceleration;
mod state;
mod statics;
mod statics_friction;
mod statics_warm_start;
mod step;
mod stick_friction;
mod supports;
mod system;
mod tension;
#[cfg(test)]
mod tests;
mod trial;
mod viscoelastic;
mod warm_start;
mod winch;
mod workspace;

pub use condense::{EndTangent, Matrix12};
pub use coupled::{CoupledLine, CoupledLines, Surroundings};
pub use ends::{RodEnd, RodEndMotion};
pub use energy_balance::{Energy, RodEnergyBalance, Work};
pub use environment::{
    FluidField, FluidState, LineEnvironment, PlaneBottom, SeabedLaw, SeabedPush, SeabedShape, Support, SupportLaw,
    SupportReaction, SupportTarget, UniformFluid,
};
pub use error::RodError;
pub use mesh::{BYTES_PER_ELEMENT, MAX_ELEMENTS, Rod};
pub use modes::RodMode;
pub use scheme::RodSettings;
pub use section::{Attachment, RodSegment, TensionLaw, TubeSection};
pub use solver::{RodEndForces, RodSolver};
pub use state::RodState;
pub use supports::{SupportForce, SupportTangent};
pub use viscoelastic::ViscoelasticRope;
