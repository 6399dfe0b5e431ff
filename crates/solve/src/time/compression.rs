//! The pull of a connector as a number: its tension, negative of one that pushes.

use super::history::VALUES_PER_BODY;
use crate::link::EndAttachment;
use nalgebra::Vector3;
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;

/// The pull of a connector by its force on an end (N), negative where that pushes the end away from the other one, which is `apart`
/// from it (m); `from` is the least distance at which it may ([`windlass_model::ConnectorElement::compression_onset`]).
pub(crate) fn pull(force: &Vector3<f64>, apart: &Vector3<f64>, from: f64) -> f64 {
    let pushed = force.dot(apart) < 0.0 && apart.norm() >= from;
    if pushed { -force.norm() } else { force.norm() }
}

/// A connector that may push, in the rows of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct CompressionOnset {
    /// Least distance of its ends from which on it does (m).
    from: f64,
    /// The end whose force is reported, and the other: a body with the point in its system, or a place in the ground (m).
    ends: [(Option<usize>, Vector3<f64>); 2],
}

impl CompressionOnset {
    /// Of a connector between two ends, of which that of a number is reported, or else the first on a body.
    pub(crate) fn new(from: f64, ends: &[EndAttachment], pulling_end: usize) -> Option<Self> {
        let position = |end: &EndAttachment| match end {
            EndAttachment::Ground(pose) => (None, pose.origin),
            EndAttachment::Body(body, at) => (Some(*body), *at),
        };
        let [first, second] = ends else { return None };
        let on_body = |end: &EndAttachment| matches!(end, EndAttachment::Body(..));
        let is_second_end = if on_body(first) && on_body(second) { pulling_end == 1 } else { on_body(second) };
        let (near, far) = if is_second_end { (second, first) } else { (first, second) };
        Some(CompressionOnset { from, ends: [position(near), position(far)] })
    }

    /// The pull by the force on the end that is reported (N), where a row has the bodies.
    pub(super) fn pull(&self, force: &Vector3<f64>, row: &[f64]) -> f64 {
        let [near, far] = self.ends.map(|(body, at)| body.map_or(at, |b| pose(row, b).point(at)));
        pull(force, &(far - near), self.from)
    }
}

/// Where a body is in a row.
fn pose(row: &[f64], body: usize) -> Pose {
    let at = 1 + VALUES_PER_BODY * body;
    match row.get(at..at + 6) {
        Some([x, y, z, roll, pitch, yaw]) => {
            Pose::from_place(&Place { shift: [*x, *y, *z], turn: [*roll, *pitch, *yaw] })
        }
        _ => Pose::default(),
    }
}
