//! Ends of connectors under way.

use super::forces::BodyMotion;
use crate::link::EndAttachment;
use nalgebra::Vector3;
use windlass_base::pose::{Pose, Six};
use windlass_model::End;

/// An end of a connector on a body that moves, or in the ground, and its arm from the origin of its body (m, global). Its acceleration
/// is reported where it is wanted.
pub(crate) fn end_of(end: &EndAttachment, motions: &[BodyMotion], accelerates: bool) -> (End, Vector3<f64>) {
    let (body, at) = match end {
        EndAttachment::Ground(pose) => return (End::at_rest(*pose), Vector3::zeros()),
        EndAttachment::Body(body, at) => (motions[*body], at),
    };
    let pose = Pose { origin: body.pose.point(*at), axes: body.pose.axes };
    let arm = pose.origin - body.pose.origin;
    let linear = |v: Vector3<f64>| Six::new(v.x, v.y, v.z, 0.0, 0.0, 0.0);
    let turn = Vector3::new(body.velocity[3], body.velocity[4], body.velocity[5]);
    let by_turn = turn.cross(&arm);
    let mut made = End { pose, velocity: body.velocity + linear(by_turn), acceleration: Six::zeros() };
    if accelerates {
        let faster = body.acceleration.fixed_rows::<3>(3).into_owned();
        made.acceleration = body.acceleration + linear(faster.cross(&arm) + turn.cross(&by_turn));
    }
    (made, arm)
}
