//! The tangent of a load on a body, by differences.

use nalgebra::Matrix6;
use windlass_base::pose::{Pose, Six};
use windlass_hydro::BodyLoad;

/// Central differences of the wrench, by translations of a hundredth of a millimetre and rotations of 1e-6 rad: the third
/// derivative in a passage about the surface is large.
pub fn differences(load: &dyn BodyLoad, pose: &Pose) -> Matrix6<f64> {
    let mut made = Matrix6::zeros();
    for column in 0..6 {
        let step = if column < 3 { 1e-5 } else { 1e-6 };
        let moved = |sign: f64| {
            let mut motion = Six::zeros();
            motion[column] = sign * step;
            load.mean_load(&pose.after_motion(&motion)).unwrap().wrench
        };
        made.set_column(column, &((moved(-1.0) - moved(1.0)) / (2.0 * step)));
    }
    made
}
