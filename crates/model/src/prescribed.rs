//! Motions that bodies are given, instead of what forces would make them do.

use std::sync::Arc;
use windlass_base::span::Span;

/// The motion of a body that is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Prescription {
    /// The motion.
    pub motion: GivenMotion,
    /// Where it was given.
    pub span: Span,
}

/// A motion by its kind.
#[derive(Clone, Debug, PartialEq)]
pub enum GivenMotion {
    /// Sines about where the body stands when a run begins.
    Sinusoids {
        /// The sines; those of one degree of freedom add up.
        list: Vec<Sinusoid>,
        /// Time over which they grow from nothing (s); 0: they are there at once.
        ramp: f64,
    },
    /// Responses to each wave of the sea, about where the body stands when a run begins.
    Responses(Arc<Responses>),
    /// Places at times: time (s), x, y, z (m), roll, pitch, yaw (rad). Times grow; between them is a cubic spline.
    Path(Arc<Vec<PathRow>>),
}

/// A time (s) with x, y, z (m) and roll, pitch, yaw (rad).
pub type PathRow = (f64, [f64; 6]);

/// `amplitude sin(2 pi t / period + phase)` in one degree of freedom.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sinusoid {
    /// The degree of freedom: x, y, z, roll, pitch, yaw from 0 on, global axes and the body's angles.
    pub dof: usize,
    /// Amplitude (m or rad).
    pub amplitude: f64,
    /// Period (s).
    pub period: f64,
    /// Phase (rad).
    pub phase: f64,
}

/// Response amplitude operators of a body: by heading and frequency.
#[derive(Clone, Debug, PartialEq)]
pub struct Responses {
    /// Headings, which grow; each with its rows, of which the frequencies grow.
    pub headings: Vec<(f64, Vec<ResponseRow>)>,
    /// Whether what comes from the other side is the mirror image.
    pub symmetric: bool,
}

/// Responses to a wave of 1 m amplitude.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ResponseRow {
    /// Frequency of the wave (rad/s).
    pub frequency: f64,
    /// Of surge, sway, heave, roll, pitch, yaw: amplitude (m/m, rad/m), and lag behind the crest at the body's origin (rad).
    pub values: [(f64, f64); 6],
}
