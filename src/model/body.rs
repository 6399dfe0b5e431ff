//! Bodies, their parts, and points.

use super::geometry::{Place, Position};
use crate::language::source::Span;

/// The part that points outside of any body belong to: fixed in the global system.
pub const GROUND: &str = "GROUND";

/// A rigid body.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Its name as written.
    pub name: String,
    /// Where it stands now.
    pub place: Place,
    /// Where it stood before the last `&INSTATE` or equilibrium.
    pub previous: Place,
    /// Degrees of freedom left out (X Y Z RX RY RZ).
    pub ignored: Vec<String>,
    /// Where it was defined.
    pub span: Span,
}

/// A part of a body; every attribute of a body belongs to a part.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// Its name as written.
    pub name: String,
    /// Its body.
    pub body: String,
    /// Where it stands in its body.
    pub place: Place,
    /// Where it was defined.
    pub span: Span,
}

/// A named point.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Its name as written, with its `*`.
    pub name: String,
    /// Its part, or [`GROUND`].
    pub part: String,
    /// Coordinates in the part (m).
    pub at: Position,
    /// Where it was defined.
    pub span: Span,
}
