//! Buoyancy by a constant stiffness about an upright equilibrium.
//!
//! Source: [AQWA-REF deck 7]: F = K (Xe - X) + B at the centre of gravity. X are the place of that point and the
//! roll, pitch and yaw of the body. Our reading: K stands in axes that turn with the yaw, since roll and pitch do; Xe is
//! (0, 0, height) and upright with no yaw. The force is exact for these angles of any size, and so is its stiffness.

use super::{BodyLoad, Category, Load};
use nalgebra::{Matrix3, Matrix6, Rotation3, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, LinearHydrostatics};

/// Where roll and yaw are no longer distinguished: cosine of the pitch.
const MIN_PITCH_COSINE: f64 = 1e-6;

/// Buoyancy of a body that has a linear stiffness.
pub fn build_linear_buoyancy(body: &Body) -> Option<Box<dyn BodyLoad>> {
    body.linear.clone().map(|linear| Box::new(linear) as Box<dyn BodyLoad>)
}

impl BodyLoad for LinearHydrostatics {
    fn category(&self) -> Category {
        Category::Buoyancy
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let (roll, pitch, yaw) = Rotation3::from_matrix_unchecked(pose.axes).euler_angles();
        if pitch.cos() < MIN_PITCH_COSINE {
            return Err(ClassError::new("a linear hydrostatic stiffness has no value at a pitch of 90 degrees"));
        }
        let heading: Matrix3<f64> = *Rotation3::from_axis_angle(&Vector3::z_axis(), yaw).matrix();
        let to_heading = heading.transpose();
        let arm = pose.axes * Vector3::from(self.at);
        let away = to_heading * (Vector3::new(0.0, 0.0, self.height) - pose.origin - arm);
        let six = |a: Vector3<f64>, b: Vector3<f64>| Six::new(a.x, a.y, a.z, b.x, b.y, b.z);
        let halves = |f: Six| (f.fixed_rows::<3>(0).into_owned(), f.fixed_rows::<3>(3).into_owned());
        let held = self.stiffness * six(away, -Vector3::new(roll, pitch, yaw));
        let (force, moment) = halves(held);
        let (pull, turn) = (heading * force, heading * moment);
        let total = pull + Vector3::new(0.0, 0.0, self.buoyancy);
        let wrench = six(total, turn + arm.cross(&total));
        // rates of roll, pitch and yaw of a body that turns at `rates` in heading axes
        let (cos, tan) = (pitch.cos(), pitch.tan());
        let turned = Matrix3::new(1.0 / cos, 0.0, 0.0, 0.0, 1.0, 0.0, tan, 0.0, 1.0) * to_heading;
        let yawing = turned.row(2).into_owned();
        // d(away, -angles)/d(translation, rotation): an arm that turns moves its end by -[arm] rotation
        let crossed = arm.cross_matrix();
        let mut by = Matrix6::zeros();
        by.fixed_view_mut::<3, 3>(0, 0).copy_from(&-to_heading);
        by.fixed_view_mut::<3, 3>(0, 3).copy_from(&(to_heading * crossed - Vector3::z().cross(&away) * yawing));
        by.fixed_view_mut::<3, 3>(3, 3).copy_from(&-turned);
        let of_held = self.stiffness * by;
        let mut stiffness = Matrix6::zeros();
        for column in [0, 3] {
            let mut of_pull = heading * of_held.fixed_view::<3, 3>(0, column);
            let mut of_moment = heading * of_held.fixed_view::<3, 3>(3, column);
            if column == 3 {
                of_pull += Vector3::z().cross(&pull) * yawing;
                of_moment += Vector3::z().cross(&turn) * yawing + total.cross_matrix() * crossed;
            }
            of_moment += crossed * of_pull;
            stiffness.fixed_view_mut::<3, 3>(0, column).copy_from(&-of_pull);
            stiffness.fixed_view_mut::<3, 3>(3, column).copy_from(&-of_moment);
        }
        Ok(Load { wrench, stiffness })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use windlass_base::geometry::Place;
    use windlass_base::span::Span;

    fn linear(off_diagonal: f64) -> LinearHydrostatics {
        let mut stiffness = Matrix6::from_diagonal(&Six::new(1e3, 2e3, 4e6, 9e8, 8e10, 5e7));
        for i in 0..6 {
            for j in 0..6 {
                if i != j {
                    stiffness[(i, j)] = off_diagonal * ((i * 7 + j * 3) as f64).sin();
                }
            }
        }
        LinearHydrostatics { at: [60.0, 1.0, 5.0], height: 3.0, buoyancy: 1e8, stiffness, span: Span::default() }
    }

    #[test]
    fn linear_force_at_rest_is_buoyancy_at_its_point() {
        let load = linear(1e6).mean_load(&Pose::from_place(&Place::new([-60.0, -1.0, -2.0, 0.0, 0.0, 0.0]))).unwrap();
        assert_eq!(load.wrench, Six::new(0.0, 0.0, 1e8, 1e8, -60.0 * 1e8, 0.0));
    }

    #[test]
    fn heave_and_roll_restoring_is_independent_of_heading() {
        for yaw in [0.0f64, 1.0, -2.5] {
            let linear = LinearHydrostatics {
                stiffness: Matrix6::from_diagonal(&Six::new(0.0, 0.0, 4e6, 9e8, 8e10, 0.0)),
                at: [0.0; 3],
                ..linear(0.0)
            };
            let load = linear.mean_load(&Pose::from_place(&Place::new([7.0, 8.0, 3.5, 0.1, 0.0, yaw]))).unwrap();
            // half a metre above its place: 1e8 - 4e6 / 2; rolled by 0.1 rad about its own x axis
            assert!((load.wrench[2] - 9.8e7).abs() < 1e-4);
            let moment = Vector3::new(load.wrench[3], load.wrench[4], load.wrench[5]);
            let want = Vector3::new(yaw.cos(), yaw.sin(), 0.0) * -9e7;
            assert!((moment - want).norm() < 1e-4, "{moment} {want}");
        }
    }

    #[test]
    fn stiffness_matches_finite_difference_of_force() {
        let linear = linear(2e5);
        for position in [[3.0, -2.0, -1.0, 0.2, -0.3, 1.1], [0.0, 0.0, 5.0, -0.8, 0.9, -2.0]] {
            let pose = Pose::from_place(&Place::new(position));
            let load = linear.mean_load(&pose).unwrap();
            for n in 0..6 {
                let step = if n < 3 { 1e-4 } else { 1e-6 };
                let mut motion = Six::zeros();
                motion[n] = step;
                let [up, down] = [motion, -motion].map(|m| linear.mean_load(&pose.after_motion(&m)).unwrap().wrench);
                let difference = (down - up) / (2.0 * step);
                let column = load.stiffness.column(n).into_owned();
                // wrenches of 1e10 N m leave 1e-16 * 1e10 / 1e-6 = 1 of rounding beside columns of 1e10
                assert!((difference - column).amax() < 1e-7 * column.amax(), "{n}: {difference} {column}");
            }
        }
    }
}
