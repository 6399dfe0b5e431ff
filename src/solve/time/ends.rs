//! Ends of connectors under way.

use super::forces::Motion;
use crate::model::{End, Pose, Six};
use crate::solve::link::Attachment;
use nalgebra::Vector3;

/// An end of a connector on a body that moves, or in the ground, with its velocity and acceleration.
pub(super) fn end_of(end: &Attachment, motions: &[Motion]) -> End {
    let (body, at) = match end {
        Attachment::Ground(pose) => return End::still(*pose),
        Attachment::Body(body, at) => (motions.get(*body).copied().unwrap_or_default(), at),
    };
    let pose = Pose { origin: body.pose.point(*at), axes: body.pose.axes };
    let arm = pose.origin - body.pose.origin;
    let [turn, faster] = [body.velocity, body.acceleration].map(|six| Vector3::new(six[3], six[4], six[5]));
    let linear = |v: Vector3<f64>| Six::new(v.x, v.y, v.z, 0.0, 0.0, 0.0);
    let by_turn = turn.cross(&arm);
    End {
        pose,
        velocity: body.velocity + linear(by_turn),
        acceleration: body.acceleration + linear(faster.cross(&arm) + turn.cross(&by_turn)),
    }
}
