//! The weight of a body.

use super::{BodyLoad, BodyStep, Category, DynamicLoad, Load};
use nalgebra::Vector3;
use windlass_base::pose::{Pose, Six};
use windlass_model::{ClassError, Mass};

#[derive(Debug)]
struct WeightLoad {
    /// In newtons.
    weight: f64,
    /// Centre of gravity in the body (m).
    centre: Vector3<f64>,
}

/// The weight of a mass under a gravity (m/s2); none of a body without mass.
pub fn build_weight(mass: &Mass, gravity: f64) -> Option<Box<dyn BodyLoad>> {
    let made = WeightLoad { weight: mass.mass * gravity, centre: mass.centre };
    (mass.mass != 0.0).then(|| Box::new(made) as Box<dyn BodyLoad>)
}

impl BodyLoad for WeightLoad {
    fn category(&self) -> Category {
        Category::Weight
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        Ok(Load::constant(Vector3::new(0.0, 0.0, -self.weight), pose.axes * self.centre))
    }

    fn add_dynamic_load(&self, at: &BodyStep, _state: &[f64], out: &mut DynamicLoad) -> Result<(), ClassError> {
        let (force, arm) = (Vector3::new(0.0, 0.0, -self.weight), at.pose.axes * self.centre);
        let moment = arm.cross(&force);
        out.load.wrench += Six::new(0.0, 0.0, force.z, moment.x, moment.y, moment.z);
        let mut turning = out.load.stiffness.fixed_view_mut::<3, 3>(3, 3);
        turning -= force.cross_matrix() * arm.cross_matrix();
        Ok(())
    }
}
