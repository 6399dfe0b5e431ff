//! The inertia of bodies under way, and how it changes as they turn.

use super::forces::BodyMotion;
use crate::system::{SystemBody, mass_block};
use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_model::Mass;

/// The inertia of a body about its origin in a pose (kg, kg m, kg m2), with added mass, global axes.
pub fn inertia(node: &SystemBody, pose: &Pose) -> Matrix6<f64> {
    let own = mass_block(&node.floating.mass, pose);
    if node.added { own + node.floating.added_mass(pose) } else { own }
}

/// What turning adds to inertia: `m w x (w x r)` and `w x (I w)` about the origin, as what the forces have to balance.
pub fn gyroscopic(mass: &Mass, motion: &BodyMotion) -> Six {
    let v = &motion.velocity;
    let turn = Vector3::new(v[3], v[4], v[5]);
    let axes = &motion.pose.axes;
    let force = turn.cross(&turn.cross(&(axes * mass.centre))) * mass.mass;
    let moment = turn.cross(&(axes * (mass.inertia * (axes.transpose() * turn))));
    Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z)
}

/// How inertia about the origin changes with the rotation vector and with the rate of turning: `d(M a + gyroscopic)/d(motion)` and
/// `/d(velocity)`.
pub(super) fn turned_inertia(node: &SystemBody, motion: &BodyMotion) -> [Matrix6<f64>; 2] {
    let [mut position, velocity] = of_mass(&node.floating.mass, motion);
    if node.added {
        position += rotated_added_inertia(&node.floating.added_mass(&motion.pose), &motion.acceleration);
    }
    [position, velocity]
}

/// `d(A a)/d(rotation)` of a matrix that turns with its body: each 3x3 block B of it changes `B x` by `(B [x] - [B x])` times the rotation.
pub(super) fn rotated_added_inertia(matrix: &Matrix6<f64>, a: &Six) -> Matrix6<f64> {
    let halves = [Vector3::new(a[0], a[1], a[2]), Vector3::new(a[3], a[4], a[5])];
    let mut made = Matrix6::zeros();
    for row in [0, 3] {
        let mut sum = Matrix3::zeros();
        for (column, half) in [0, 3].into_iter().zip(&halves) {
            let block = matrix.fixed_view::<3, 3>(row, column);
            sum += block * half.cross_matrix() - (block * half).cross_matrix();
        }
        made.fixed_view_mut::<3, 3>(row, 3).copy_from(&sum);
    }
    made
}

/// The same of a mass. A lever turns by `-[lever]` times the rotation, a moment of inertia as its axes do.
fn of_mass(mass: &Mass, motion: &BodyMotion) -> [Matrix6<f64>; 2] {
    let (a, v, axes) = (&motion.acceleration, &motion.velocity, &motion.pose.axes);
    let [linear, alpha] = [Vector3::new(a[0], a[1], a[2]), Vector3::new(a[3], a[4], a[5])].map(|x| x.cross_matrix());
    let omega = Vector3::new(v[3], v[4], v[5]).cross_matrix();
    let lever = (axes * mass.centre).cross_matrix() * mass.mass;
    let own = axes * mass.inertia * axes.transpose();
    let of = |x: &Matrix3<f64>| (own * Vector3::new(x.m32, x.m13, x.m21)).cross_matrix();
    let (mut position, mut velocity) = (Matrix6::zeros(), Matrix6::zeros());
    position.fixed_view_mut::<3, 3>(0, 3).copy_from(&-((alpha + omega * omega) * lever));
    let moment = linear * lever + own * alpha - of(&alpha) + omega * (own * omega - of(&omega));
    position.fixed_view_mut::<3, 3>(3, 3).copy_from(&moment);
    // w x (w x r): by the inner rate and by the outer one
    let swung = omega * lever - lever * omega;
    velocity.fixed_view_mut::<3, 3>(0, 3).copy_from(&-(omega * lever + swung));
    velocity.fixed_view_mut::<3, 3>(3, 3).copy_from(&(omega * own - of(&omega)));
    [position, velocity]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn inertia_rotation_derivative_matches_finite_difference() {
        let inertia = Matrix3::new(9e3, 200.0, -300.0, 200.0, 1.4e4, 500.0, -300.0, 500.0, 1.1e4);
        let mass = Mass { mass: 100.0, centre: Vector3::new(3.0, -2.0, 5.0), inertia };
        let pose = Pose::default().after_motion(&Six::new(0.0, 0.0, 0.0, 0.4, -0.7, 1.1));
        let velocity = Six::new(1.0, 2.0, -1.0, 0.3, -0.5, 0.2);
        let start = BodyMotion {
            pose,
            velocity,
            acceleration: Six::new(0.7, -1.1, 0.4, 0.2, 0.6, -0.9),
            ..BodyMotion::default()
        };
        let whole = |m: &BodyMotion| mass_block(&mass, &m.pose) * m.acceleration + gyroscopic(&mass, m);
        let [position, rate] = of_mass(&mass, &start);
        for n in 0..6 {
            // central differences of 1e-6 of numbers of 1e4: rounding 1e-16 * 1e4 / 1e-6, the third derivative 1e-12 * 1e4
            let step = 1e-6;
            let moved = |sign: f64| {
                let mut by = Six::zeros();
                by[n] = sign * step;
                let turned = BodyMotion { pose: start.pose.after_motion(&by), ..start };
                let faster = BodyMotion { velocity: start.velocity + by, ..start };
                [whole(&turned), whole(&faster)]
            };
            let ([a, c], [b, d]) = (moved(1.0), moved(-1.0));
            assert!(((a - b) / (2.0 * step) - position.column(n)).amax() < 1e-4, "place {n}");
            assert!(((c - d) / (2.0 * step) - rate.column(n)).amax() < 1e-4, "velocity {n}");
        }
    }

    #[test]
    fn added_inertia_rotation_derivative_matches_finite_difference() {
        let own = Matrix6::from_fn(|i, j| 100.0 * ((i * 5 + j * 3) as f64).sin());
        let pose = Pose::default().after_motion(&Six::new(0.0, 0.0, 0.0, 0.4, -0.7, 1.1));
        let a = Six::new(0.7, -1.1, 0.4, 0.2, 0.6, -0.9);
        let whole = |pose: &Pose| windlass_hydro::in_pose(&own, pose) * a;
        let made = rotated_added_inertia(&windlass_hydro::in_pose(&own, &pose), &a);
        for n in 3..6 {
            let mut by = Six::zeros();
            by[n] = 1e-6;
            let difference = (whole(&pose.after_motion(&by)) - whole(&pose.after_motion(&-by))) / 2e-6;
            // rounding of numbers of 100 over 1e-6
            assert!((difference - made.column(n)).amax() < 1e-6, "{n}");
        }
    }
}
