//! What the nonlinear solvers share: root searches in one unknown, the convergence test, the line search by halvings, statistics.
//!
//! Each is a state that the solver's own loop asks and records to, so that an evaluation may fail, or be the solution of another problem.
//!
//! # Example
//! The depth at which a buoy of 1 m diameter floats that displaces a third of its volume:
//! ```
//! use windlass_nonlinear::{BracketedRoot, Halvings};
//!
//! // share of a sphere's volume below the depth h
//! let off = |h: f64| h * h * (3.0 - 2.0 * h) - 1.0 / 3.0;
//! let mut search = BracketedRoot::new([0.0, 1.0], [off(0.0), off(1.0)], Halvings::Never);
//! while let Some(depth) = search.propose() {
//!     search.record(depth, off(depth));
//! }
//! // h = 1/2 - sin(asin(1/3) / 3), from the cubic's angle
//! assert!((search.best().0 - (0.5 - ((1.0f64 / 3.0).asin() / 3.0).sin())).abs() < 1e-15);
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

mod bisection;
mod bracketed_root;
mod convergence;
mod line_search;
mod newton_bracket;
mod statistics;

pub use bisection::{bisect, try_bisect};
pub use bracketed_root::{BracketedRoot, Halvings};
pub use convergence::{Convergence, ConvergenceStatus};
pub use line_search::backtrack;
pub use newton_bracket::{NewtonBracket, NewtonSearch};
pub use statistics::NewtonStatistics;
