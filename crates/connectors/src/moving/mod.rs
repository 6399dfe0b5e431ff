//! Lines that move by themselves: what classes say of them, and the rod of `windlass_line_dynamics` as an element of an engine.
//!
//! Source: [MOSES-FLEX ROD] and [AQWA-CONN 5.8.3] (cable dynamics of AQWA). A line is cut into elements, feels water, wind and bottom all
//! along itself, and is held at its ends by bodies or the ground; what is between its ends is solved and condensed here.

mod afar;
mod answer;
mod around;
mod describe;
mod element;
mod kept;
mod laid;
mod laying;
mod made;
mod mesh;
mod modes;
mod sections;
mod start;
mod tell;
mod warm;

pub use describe::{Description, Hold, JointMass, Part, Seabed, Strength};
pub use element::MovingLine;
pub use sections::{
    AX_DAMPING, CA, CD, CLAMP, CLUMP_DRAG, EA, EI, Flexure, ROPE, SEABED, SLAM, STRETCH, chain, description, holds,
    seabed,
};
