//! Tethers between anchors on the bottom and a moving structure [AQWA-TETHER chapters 1 to 4, 7, 8.2 and appendix A].
//!
//! The axis of a tether (TLA) runs straight from the anchor to the attachment and moves with it; X and Y across it are the global ones
//! turned with the axis from the vertical. In each plane a chain of beams moves across the axis ([`bending`]); tension is static along it
//! ([`tension`]). [`run`] moves structure and tethers together and shows every state to an observer, of which [`history`] keeps what is
//! reported. Rotations are `RX = -dY/dz`, `RY = dX/dz`.

pub mod axis;
pub mod bending;
pub mod description;
pub mod history;
pub mod modes;
pub mod rig;
pub mod run;
pub mod stress;
pub mod tension;
pub mod tether;

pub use history::{InstalledHistory, Keep};
pub use rig::{Rig, RigChange};
pub use run::{Installation, InstalledObserver, InstalledRunSettings, Moment, TetherEvent};
pub use tether::{DefaultTaken, EndSprings, Impact, InstalledTether, InternalFluid, NodeConstraint};
