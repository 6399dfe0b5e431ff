//! What lengthens a line at its first end: a link along the tension there, which may itself give way.

use nalgebra::Vector3;
use std::fmt::Debug;
use windlass_model::{ClassError, ConnectorResponse, ConnectorSummary, End, SolverCache};

/// A link of `length + compliance T` between the first end and the line, in the direction of the tension T. A negative length takes
/// as much off the way between the ends.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extension {
    /// Length without tension (m).
    pub length: f64,
    /// Further length per tension (m/N), zero or more.
    pub compliance: f64,
}

impl Extension {
    /// No link.
    pub const NONE: Extension = Extension { length: 0.0, compliance: 0.0 };

    /// Length at a tension (m).
    pub fn length(&self, tension: f64) -> f64 {
        self.length + self.compliance * tension
    }
}

/// How a line pulls on its first end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EndPull {
    /// Tension (N); negative of a spring that pushes.
    pub tension: f64,
    /// Its direction, into the line.
    pub along: Vector3<f64>,
}

/// A line that can be lengthened at its first end.
pub trait ExtensibleLine: Debug + Send + Sync {
    /// Writes the forces on both ends of the line with the link, and their exact derivatives.
    ///
    /// # Errors
    /// A situation for which no answer could be proven.
    fn pull(
        &self,
        ends: &[End],
        by: Extension,
        cache: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<EndPull, ClassError>;

    /// What is reported of the line with the link.
    ///
    /// # Errors
    /// As [`ExtensibleLine::pull`].
    fn summary_with_link(&self, ends: &[End], by: Extension) -> Result<ConnectorSummary, ClassError>;

    /// See [`windlass_model::ConnectorElement::compression_onset`].
    fn compression_onset(&self) -> Option<f64> {
        None
    }
}
