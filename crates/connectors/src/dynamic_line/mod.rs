//! Dynamic lines: what classes say of them, and the rod of `windlass_line_dynamics` as an element of an engine.
//!
//! Source: [MOSES-FLEX ROD] and [AQWA-CONN 5.8.3] (cable dynamics of AQWA). A line is cut into elements, feels water, wind and bottom all
//! along itself, and is held at its ends by bodies or the ground; what is between its ends is solved and condensed here.

mod answer;
mod build;
mod describe;
mod element;
mod environment;
mod mesh;
mod modes;
mod node_output;
mod pipelay;
mod pipelay_supports;
mod rod_cache;
mod sections;
mod start;
mod state_layout;
mod static_start;

pub use describe::{BreakingStrength, EndFixity, JointMass, LineDescription, LinePart, Seabed};
pub use element::DynamicLine;
pub use sections::{
    AX_DAMPING, CA, CD, CLAMP, CLUMP_DRAG, EA, Flexure, LINE_OPTIONS, MID_TENSION, ROPE, SEABED, SLAM, STRETCH,
    VERTICAL_PUSH, describe_chain, description, parse_seabed, read_end_fixities,
};
