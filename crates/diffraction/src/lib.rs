#![doc = include_str!("../README.md")]
#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod dispersion;
mod error;
mod gauss;
mod gmres;
pub mod green;
mod lid;
mod mesh;
mod panel;
mod problem;
mod rankine;
mod symmetry;
mod wave_system;

pub use error::DiffractionError;
pub use mesh::{HullMesh, MirrorPlanes};
pub use panel::Panel;
pub use problem::{DiffractionBody, DiffractionProblem, FrequencyForces, MOTIONS, Water};
