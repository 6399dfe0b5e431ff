//! What a line is made of, and what is refused.

use super::between::{Bottom, EndForces};
use super::solve::State;

/// A piece of line with the same properties all along.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Segment {
    /// Unstretched length (m).
    pub length: f64,
    /// Submerged weight per unstretched length (N/m); negative when buoyant.
    pub weight: f64,
    /// Axial stiffness (N).
    pub ea: f64,
}

/// What acts where a segment ends and the next begins.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Joint {
    /// Nothing.
    Free,
    /// A submerged weight (N); negative is a lift that does not know the surface.
    Weight(f64),
    /// A buoy on a pendant: it keeps the joint from sinking below `depth` until its capacity is used up.
    SpringBuoy {
        /// Largest pull (N).
        capacity: f64,
        /// Depth of the held joint below the water surface (m): the length of the pendant.
        depth: f64,
    },
}

/// A line from a fairlead to an anchor on the bottom.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    pub(super) segments: Vec<Segment>,
    pub(super) joints: Vec<Joint>,
    pub(super) anchor: f64,
    pub(super) surface: f64,
}

/// Why a line has no answer.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum LineError {
    /// A line without segments.
    #[error("the line has no segments")]
    Empty,
    /// A joint belongs between each two segments.
    #[error("a line of {segments} segments has {joints} joints, not one fewer")]
    Joints {
        /// Number of segments.
        segments: usize,
        /// Number of joints.
        joints: usize,
    },
    /// A value that is not finite or has the wrong sign.
    #[error("{what} of segment {segment} cannot be {value}")]
    Value {
        /// Which quantity.
        what: &'static str,
        /// Which segment, from 1.
        segment: usize,
        /// The value (SI).
        value: f64,
    },
    /// Breaking tensions that do not fit the segments.
    #[error("a table needs one positive breaking tension a segment and a positive largest force")]
    Breaks,
    /// More spring buoys than the search over their states goes through.
    #[error("the line has {0} spring buoys; at most {most} can be solved", most = super::solve::MOST_BUOYS)]
    TooManyBuoys(usize),
    /// The fairlead lies below the bottom.
    #[error("the fairlead lies {0:.3} m below the bottom")]
    BelowBottom(f64),
    /// A part that may not touch the bottom goes below it.
    #[error(
        "segment {segment} hangs {by:.3} m below the bottom, above a buoyant part of the line; such contact is not covered"
    )]
    Crosses {
        /// Which segment, from 1.
        segment: usize,
        /// How far (m).
        by: f64,
    },
    /// The line is so long that it pulls with no horizontal force that can be told.
    #[error("the line hangs slack: pulled with {force:.3e} N it already reaches {reach:.3} m")]
    Slack {
        /// The smallest horizontal force tried (N).
        force: f64,
        /// The distance it reaches there (m).
        reach: f64,
    },
    /// A weightless line with slack: any shape will do.
    #[error("a weightless line longer than the distance between its ends has no definite shape")]
    Undetermined,
    /// What is left of the distances between the ends is too large for an answer.
    #[error("no configuration found between the ends: {residual:.3e} N remain of a tension of {tension:.6e} N")]
    Unproven {
        /// The distances left, mapped through the stiffness (N).
        residual: f64,
        /// Tension at the fairlead (N).
        tension: f64,
    },
    /// The iteration ended without a proven answer.
    #[error(
        "no configuration found at a horizontal force of {force:.6e} N: {residual:.3e} m remain after {iterations} iterations"
    )]
    NotConverged {
        /// Horizontal force (N).
        force: f64,
        /// Vertical distance left (m).
        residual: f64,
        /// Iterations done.
        iterations: usize,
    },
}

impl Segment {
    /// The forces when the fairlead lies `x` >= 0 beside and `z` above the anchor (m); with a `bottom` at the anchor's
    /// elevation, or with none anywhere.
    ///
    /// # Errors
    /// [`LineError`]; forces that are returned have been proven.
    pub fn between(&self, x: f64, z: f64, bottom: Option<Bottom>) -> Result<EndForces, LineError> {
        super::between::between(self, x, z, bottom)
    }

    /// The same as [`Segment::between`], sooner: for a fairlead that has moved a little since `last`. What `last` holds
    /// decides how long the search takes, and the answer only within the proof.
    ///
    /// # Errors
    /// Those of [`Segment::between`].
    pub fn follow(&self, x: f64, z: f64, bottom: Option<Bottom>, last: &EndForces) -> Result<EndForces, LineError> {
        super::follow::follow(self, x, z, bottom, last)
    }

    /// The same segment upside down: a buoyant one for a heavy one.
    pub(super) fn turned(&self) -> Segment {
        Segment { weight: -self.weight, ..*self }
    }

    /// Refuses values that no segment can have; `number` is the segment's, from 1.
    pub(super) fn check(&self, number: usize) -> Result<(), LineError> {
        for (what, value, good) in [
            ("the length", self.length, self.length > 0.0),
            ("the axial stiffness", self.ea, self.ea > 0.0),
            ("the weight", self.weight, true),
        ] {
            if !(good && value.is_finite()) {
                return Err(LineError::Value { what, segment: number, value });
            }
        }
        Ok(())
    }
}

impl Line {
    /// A line from its fairlead to its anchor.
    ///
    /// `anchor` is the elevation of the anchor and of the flat, frictionless bottom (m, usually negative), `surface`
    /// that of the water surface (m, the tide).
    ///
    /// # Errors
    /// No segments, a number of joints other than one fewer than segments, values that are not finite, a length or
    /// stiffness that is not positive, more than [`super::solve::MOST_BUOYS`] spring buoys.
    pub fn new(segments: Vec<Segment>, joints: Vec<Joint>, anchor: f64, surface: f64) -> Result<Line, LineError> {
        if segments.is_empty() {
            return Err(LineError::Empty);
        }
        if joints.len() + 1 != segments.len() {
            return Err(LineError::Joints { segments: segments.len(), joints: joints.len() });
        }
        for (index, s) in segments.iter().enumerate() {
            s.check(index + 1)?;
        }
        for (index, joint) in joints.iter().enumerate() {
            let bad = match joint {
                Joint::Free => None,
                Joint::Weight(w) => (!w.is_finite()).then_some(("the clump weight", *w)),
                Joint::SpringBuoy { capacity, depth } => [("the buoy capacity", *capacity), ("the pendant", *depth)]
                    .into_iter()
                    .find(|(_, v)| !(v.is_finite() && *v >= 0.0)),
            };
            if let Some((what, value)) = bad {
                return Err(LineError::Value { what, segment: index + 1, value });
            }
        }
        for (what, value) in [("the anchor elevation", anchor), ("the water level", surface)] {
            if !value.is_finite() {
                return Err(LineError::Value { what, segment: segments.len(), value });
            }
        }
        let buoys = joints.iter().filter(|j| matches!(j, Joint::SpringBuoy { .. })).count();
        if buoys > super::solve::MOST_BUOYS {
            return Err(LineError::TooManyBuoys(buoys));
        }
        Ok(Line { segments, joints, anchor, surface })
    }

    /// The segments, fairlead first.
    pub fn segments(&self) -> &[Segment] {
        &self.segments
    }

    /// Unstretched length (m).
    pub fn length(&self) -> f64 {
        self.segments.iter().map(|s| s.length).sum()
    }

    /// The configuration in which the fairlead at elevation `fairlead` (m) is pulled with the horizontal force `force`
    /// (N, greater than zero).
    ///
    /// # Errors
    /// [`LineError`]; a state that is returned has been proven.
    pub fn at_horizontal_force(&self, force: f64, fairlead: f64) -> Result<State, LineError> {
        super::solve::at_horizontal_force(self, force, fairlead)
    }

    /// The configuration in which the fairlead at elevation `fairlead` (m) is `x` > 0 beside the anchor (m).
    ///
    /// # Errors
    /// [`LineError`]; [`LineError::Slack`] when the line needs no horizontal force to reach so far.
    pub fn at_distance(&self, x: f64, fairlead: f64) -> Result<State, LineError> {
        super::solve::at_distance(self, x, fairlead)
    }
}
