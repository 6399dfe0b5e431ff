//! First-order radiation and diffraction of waves by floating bodies: potential flow by flat panels, in deep water or water of finite depth.
//!
//! Numbers are SI, time goes as `exp(-i omega t)`, z points up from the mean level. Every body has six motions about its own origin.
//!
//! # Example
//!
//! ```
//! use nalgebra::Vector3;
//! use windlass_diffraction::{DiffractionBody, DiffractionProblem, HullMesh, MirrorPlanes, Water};
//!
//! # fn main() -> Result<(), windlass_diffraction::DiffractionError> {
//! // a quarter of a raft of 2 x 2 m, 0.5 m deep: bottom and two sides, corners counter-clockwise as seen from the water
//! let at = Vector3::new;
//! let quads = [
//!     [at(0.0, 0.0, -0.5), at(0.0, 1.0, -0.5), at(1.0, 1.0, -0.5), at(1.0, 0.0, -0.5)],
//!     [at(1.0, 0.0, -0.5), at(1.0, 1.0, -0.5), at(1.0, 1.0, 0.0), at(1.0, 0.0, 0.0)],
//!     [at(1.0, 1.0, -0.5), at(0.0, 1.0, -0.5), at(0.0, 1.0, 0.0), at(1.0, 1.0, 0.0)],
//! ];
//! let mesh = HullMesh::new(&quads, MirrorPlanes { x: true, y: true })?;
//! let water = Water { density: 1025.0, gravity: 9.81, depth: Some(20.0) };
//! let problem = DiffractionProblem::new(&[DiffractionBody { mesh, origin: Vector3::zeros() }], water)?;
//! let forces = problem.solve(0.8, &[0.0])?;
//! assert!(forces.damping[(2, 2)] > 0.0);
//! # Ok(())
//! # }
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod curvature;
mod dispersion;
mod drift_damping;
mod error;
mod excitation_check;
mod field;
mod free_body;
mod gauss;
mod gmres;
pub mod green;
mod incident_wave;
mod influence;
mod lid;
mod local_fit;
mod mesh;
mod near_field;
mod panel;
mod problem;
mod quality;
mod rankine;
mod symmetry;
mod wave_solution;
mod wave_system;

pub use drift_damping::DriftDamping;
pub use error::DiffractionError;
pub use excitation_check::{ExcitationDifference, ExcitationPair, excitation_differences};
pub use field::{ControlBox, ControlCylinder, ControlSurface, ControlSurfaceDrift};
pub use free_body::{FreeBody, free_motions};
pub use mesh::{HullMesh, MirrorPlanes};
pub use near_field::NearFieldDrift;
pub use panel::Panel;
pub use problem::{DampedPatch, DiffractionBody, DiffractionProblem, FrequencyForces, FrequencyLimit, MOTIONS, Water};
pub use quality::MeshQuality;
pub use wave_solution::{FarFieldDrift, WaveSolution};
