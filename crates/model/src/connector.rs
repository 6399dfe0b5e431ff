//! Connectors: a class between one or two points.

use super::tether::TetherEnds;
use windlass_base::geometry::Position;
use windlass_base::pose::Pose;
use windlass_base::span::Span;

/// Where the far end of a line to ground lies.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Anchor {
    /// Direction from the fairlead, from +X toward +Y (rad).
    pub direction: f64,
    /// Horizontal distance from the fairlead (m).
    pub distance: f64,
    /// Global position of the anchor in the horizontal plane (m).
    pub at: [f64; 2],
    /// Its elevation (m), where `&CONNECTOR -ANCHOR` gave one; else the class's or the environment's depth says it.
    pub elevation: Option<f64>,
}

/// Where a tug pulls, of `-TUG`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tug {
    /// Direction it pulls toward in the global horizontal plane, from +X toward +Y (rad).
    pub direction: f64,
    /// Its distance from the point (m): where it is drawn.
    pub distance: f64,
}

/// A connector.
#[derive(Clone, Debug, PartialEq)]
pub struct Connector {
    /// Its name as written.
    pub name: String,
    /// Its class, with `~`.
    pub class: String,
    /// One point (the other end is ground) or two.
    pub points: Vec<String>,
    /// Anchor of a line to ground.
    pub anchor: Option<Anchor>,
    /// The tug of a TUG_BOAT.
    pub tug: Option<Tug>,
    /// How its ends are held, of a tether.
    pub tether: Option<TetherEnds>,
    /// Offsets of the two ends from their points, in the system of the end's body (m).
    pub offsets: [Position; 2],
    /// Where its two ends stood when it was defined; behind a single point the ground end stands where the point was, with
    /// global axes.
    pub defined: [Pose; 2],
    /// Euler angles of the element axes (rad), where given.
    pub euler: Option<[f64; 3]>,
    /// Length of its first segment in place of the class's (m), where `&CONNECTOR` gave one.
    pub first_length: Option<f64>,
    /// Into how many elements it is cut as a dynamic line, where `&CONNECTOR -DYNAMICS` says so of a class that does
    /// not by itself.
    pub dynamics: Option<usize>,
    /// Whether it acts.
    pub active: bool,
    /// Where it was defined.
    pub span: Span,
}
