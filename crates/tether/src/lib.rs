//! Tethers: chains of slender steel tubes under water, as the AQWATM-TETHER manual [AQWA-TETHER] has them. Small deflections from
//! a straight axis; two translations and two slopes a node; nothing moves or turns along the axis.
//!
//! Units: SI, or any consistent set (the manual's decks are in t, kN, m): gravity and the density of water are given, and
//! nothing here knows another constant with a unit.
//!
//! Axes of the tether (TLA): x along the straight axis from the first node (trailing end, anchor) to the last (vessel); y and
//! z across it. The two planes share no stiffness and no mass, so each is a chain of its own with two unknowns a node,
//! **deflection and slope d/dx**: `y, y'` and `z, z'`. Rotations by the right hand are `RY = -z'`, `RZ = +y'`.
//!
//! | file | what it is |
//! |--|--|
//! | [`section`] | the tube's cross section |
//! | [`mod@line`] | elements one after the other, checked |
//! | [`beam`] | matrices and loads of one element in one plane |
//! | [`modes`] | natural modes of a plane |
//! | [`jacobi`] | the place of each mode in the matrices, as the listing has it |
//! | [`description`] | what is reported of a tether before a run |
//! | [`towed`] | the towed tether in waves |
//! | [`structure`] | the structure that installed tethers hold, and the water around |
//! | [`installed`] | tethers between anchors and a moving structure; their z runs along the axis, X and Y across |
//! | [`compatibility`] | peculiarities of another program in the last two, each with a name |
//!
//! # Example
//! The weight in air of a tendon of three steel tubes:
//! ```
//! use windlass_tether::{TetherElement, TetherLine, line::ElementLabel};
//!
//! let element = TetherElement {
//!     length: 100.0,
//!     outer_diameter: 1.0,
//!     wall_thickness: 0.05,
//!     density: 7850.0,
//!     youngs_modulus: 2.1e11,
//!     drag: 1.0,
//!     added_mass: 1.0,
//!     label: ElementLabel::default(),
//! };
//! let line = TetherLine::with_numbered_nodes(vec![element; 3])?;
//! let steel = std::f64::consts::PI * 0.95 * 0.05 * 300.0 * 7850.0 * 9.81;
//! assert!((line.weight(9.81) / steel - 1.0).abs() < 1e-12);
//! # Ok::<(), windlass_model::ClassError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod beam;
pub mod compatibility;
pub mod description;
pub mod installed;
pub mod jacobi;
pub mod line;
pub mod modes;
pub mod section;
pub mod structure;
pub mod towed;

pub use line::{TetherElement, TetherLine};
pub use section::TetherTube;
