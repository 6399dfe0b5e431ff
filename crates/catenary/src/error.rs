//! What is refused of a line, and where it has no answer.

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
    #[error("{what} of segment {segment} cannot be {}", format_value(*.value))]
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
    /// Too few rows, or rows whose distances do not grow: nothing to interpolate.
    #[error("the table has {0} rows of growing distance, and needs two to be interpolated")]
    Table(usize),
    /// The fairlead lies below the bottom.
    #[error("the fairlead lies {0:.3} m below the bottom")]
    BelowBottom(f64),
    /// The anchor lies below the bottom.
    #[error("the anchor lies {0:.3} m below the bottom")]
    AnchorBelow(f64),
    /// A pendant longer than the water is deep would hold its joint below the bottom.
    #[error("the pendant of segment {segment} is {by:.3} m longer than the water is deep there")]
    Pendant {
        /// Which segment, from 1.
        segment: usize,
        /// How much (m).
        by: f64,
    },
    /// The line hanging straight down already pulls more.
    #[error("no position has the {what} {wanted:.6e} N: the line hanging straight down has {least:.6e} N")]
    Weight {
        /// Which force at the fairlead.
        what: &'static str,
        /// The one asked for (N).
        wanted: f64,
        /// The smallest one (N).
        least: f64,
    },
    /// No length of the first segment gives the force.
    #[error("no length of the first segment gives {wanted:.6e} N; the nearest is {nearest:.6e} N")]
    NoLength {
        /// The force asked for (N).
        wanted: f64,
        /// The nearest one found (N).
        nearest: f64,
    },
    /// A stretch law that does not grow.
    #[error("the tension of segment {0} does not grow with its strain")]
    StretchLaw(usize),
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

/// A value in as many digits as one reads.
fn format_value(value: f64) -> String {
    if value == 0.0 || (1e-4..1e9).contains(&value.abs()) { value.to_string() } else { format!("{value:.3e}") }
}
