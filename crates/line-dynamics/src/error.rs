//! What a rod can refuse, and how it says where.

use thiserror::Error;

/// Why a rod could not be made, or why a run of it stopped.
#[derive(Clone, Debug, PartialEq, Error)]
pub enum RodError {
    /// A property that makes no rod.
    #[error("{rod}, segment {segment}: {what} is {value}; {expected}")]
    Property {
        /// The rod's name.
        rod: String,
        /// The segment from end A, from 1.
        segment: usize,
        /// The property.
        what: &'static str,
        /// What was given (SI).
        value: f64,
        /// What would do.
        expected: &'static str,
    },
    /// More elements than one run should hold.
    #[error("{rod}: {elements} elements would take about {megabytes:.0} MB; at most {most} are allowed")]
    TooLarge {
        /// The rod's name.
        rod: String,
        /// Elements asked for.
        elements: usize,
        /// Memory they would take (MB).
        megabytes: f64,
        /// Most elements.
        most: usize,
    },
    /// A rod without segments, or points that make no line.
    #[error("{rod}: {why}")]
    Shape {
        /// The rod's name.
        rod: String,
        /// One clause.
        why: String,
    },
    /// A step that did not converge however short it was made.
    #[error("{rod}: no solution at t = {time} s by steps down to {step:.3e} s; worst at element {element}: {why}")]
    Step {
        /// The rod's name.
        rod: String,
        /// The time the step would have ended at (s).
        time: f64,
        /// The shortest step tried (s).
        step: f64,
        /// Element with the largest residual, from 1 at end A.
        element: usize,
        /// What went wrong there.
        why: String,
    },
    /// The fluid said to give up.
    #[error("{rod}: interrupted")]
    Interrupted {
        /// The rod's name.
        rod: String,
    },
    /// No position of rest was found.
    #[error("{rod}: no equilibrium after {iterations} iterations; {residual:.3e} N is left at element {element}")]
    Statics {
        /// The rod's name.
        rod: String,
        /// Iterations made.
        iterations: usize,
        /// Largest residual (N).
        residual: f64,
        /// Element with the largest residual, from 1 at end A.
        element: usize,
    },
}
