//! Added mass of members.

use super::member::{MemberInPose, MemberLength, across_axis};
use crate::{cross, in_pose};
use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_base::pose::Pose;

/// Adds a mass at an arm from the origin that has inertia as a matrix says (kg).
pub(super) fn add(sum: &mut Matrix6<f64>, arm: &Vector3<f64>, mass: &Matrix3<f64>) {
    let arm = cross(*arm);
    let beside = mass * arm;
    for (at, block) in [((0, 0), *mass), ((0, 3), -beside), ((3, 0), arm * mass), ((3, 3), -(arm * beside))] {
        let mut position = sum.fixed_view_mut::<3, 3>(at.0, at.1);
        position += block;
    }
}

/// Adds that of a member in a pose under a surface of a height (m, global).
fn add_member_added_mass(sum: &mut Matrix6<f64>, rod: &MemberLength, standing: &MemberInPose, level: f64) {
    let axis = &standing.axis;
    if rod.added != [0.0; 2] {
        let whole = across_axis(axis, &standing.first, rod.added);
        for station in rod.ranges().flat_map(|range| standing.stations(range, level)) {
            add(sum, &standing.arm(station.at), &(whole * (station.area() * station.long)));
        }
    }
    for (at, mass) in [0.0, rod.length].into_iter().zip(rod.end_added).filter(|(_, mass)| *mass != 0.0) {
        let share = standing.station(at, 0.0, level).area();
        add(sum, &standing.arm(at), &(axis * axis.transpose() * (mass * share)));
    }
}

/// That of members under a level surface, body axes.
pub(super) fn at_rest(rods: &[MemberLength], pose: &Pose, level: f64) -> Matrix6<f64> {
    let mut sum = Matrix6::zeros();
    for rod in rods {
        add_member_added_mass(&mut sum, rod, &rod.standing(pose), level);
    }
    in_pose(&sum, &Pose { axes: pose.axes.transpose(), ..*pose })
}
