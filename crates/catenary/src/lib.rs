//! The catenary line engine: elastic segments, clump weights, spring buoys, a flat, sloped or uneven bottom.
//!
//! SI throughout (m, N). Elevations are above the mean water surface z = 0. A line is described from the fairlead to
//! the anchor. `H` is the horizontal component of the tension, the same all along a line without friction; `V` is the
//! vertical component of the tension at a section, positive where the line rises toward the fairlead.
//!
//! [`Line::solve_forces`] gives the forces at both ends with their tangent, at one place of the fairlead after the other; one segment over a flat
//! bottom is its fast path. [`Line::at_horizontal_force`] and its inverse [`Line::at_distance`] give the whole configuration. On a
//! flat bottom without friction all contacts of a line are found at once; on any other, and for very many segments, the line is laid
//! down from the fairlead to the anchor. [`Segment::solve_end_forces`] is the fast path by itself, for one segment in every regime, with or
//! without a bottom, with friction.
//!
//! Source of the formulas: the elastic catenary [IRVINE-1981 1.4], written so that no
//! difference of nearly equal numbers is formed; the spring buoy after [MOSES-FLEX -CLUMP].
//!
//! # Example
//! A line of 235.04 m hangs between two points 200 m apart: sinh(1) = 235.04/200, so that H is its weight times 100 m.
//! ```
//! let line = windlass_catenary::Segment { length: 200.0 * 1f64.sinh(), weight: 1000.0, ea: 1e15 };
//! let forces = line.solve_end_forces(200.0, 0.0, None)?;
//! assert!((forces.fairlead[0] - 1000.0 * 100.0).abs() < 1e-3);
//! # Ok::<(), windlass_catenary::LineError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod active_set;
mod adjust;
mod contact_problem;
mod dual;
mod element;
mod end_forces;
mod end_forces_cold;
mod end_forces_newton;
mod end_forces_warm;
mod error;
mod interpolate;
mod layout;
mod line;
mod line_forces;
mod line_state;
mod multi_segment;
mod profile;
mod search;
mod segment;
mod shape;
mod solve;
mod state;
mod stretch_law;
mod table;

pub use adjust::{Aim, Lengths};
pub use end_forces::{EndForces, FlatBottom, Regime};
pub use error::LineError;
pub use interpolate::{FromTable, Interpolated};
pub use line::{Joint, Line, SeabedModel, Segment};
pub use line_forces::{CatenaryWarmStart, LineForces};
pub use search::{FunctionPoint, rising_root};
pub use shape::ShapePoint;
pub use state::{Buoy, Heap, JointState, LineState, SegmentState};
pub use stretch_law::StretchLaw;
pub use table::{DEFAULT_ROWS, MissingRow, TableRow, first_force, table};
