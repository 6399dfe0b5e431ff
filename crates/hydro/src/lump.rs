//! A small body in the water, of which only its volume, drag areas and coefficients of added mass are known: `#LUMP`, `JUNCTION -DRAG -AMASS`.
//!
//! With the water of undisturbed waves and current at the point (velocity u, acceleration of the waves a), the velocity v of the point and w
//! the turning of the body, all in the axes of the part [MORISON-1950]:
//! - buoyancy: `rho g V` upward at the point;
//! - drag: `1/2 rho A |u - v| (u - v)` along each axis with its area A, and `-1/2 rho B |w| w` about each axis with its B (m5);
//! - waves: `rho V (1 + Ca) a` along each axis, unless the lump ignores it; the added mass `rho Ca V` is part of the inertia of the body.
//!
//! Each acts in the share of a sphere of the volume that is under the mean level, or, of a body of constant volume, always. The added mass is
//! whole wherever the point is. The velocity and acceleration of waves are those of the place expected at the end of a step.

use super::sea::Sea;
use super::steady::{Medium, Steady};
use super::stream::{Immersion, LoadPlace, StreamWrench};
use super::{BodyLoad, BodyStep, Category, DynamicLoad, Load, StatefulLoad, cross};
use nalgebra::{Matrix3, Matrix6, Matrix6x3, Vector3};
use std::f64::consts::PI;
use std::sync::Arc;
use windlass_base::pose::{Pose, Six};
use windlass_model::{ClassError, Lump};

/// Half the least height over which a lump comes under water (m): one without a volume has drag areas and no size.
const LEAST_HALF_HEIGHT_M: f64 = 0.25;
/// Velocity and acceleration of the water.
const STATES: usize = 6;

/// What surrounds the lumps of a body.
pub(super) struct LumpSurroundings<'a> {
    pub(super) steady: &'a Arc<Steady>,
    /// Under way the sea, where there is one.
    pub(super) sea: Option<&'a Arc<Sea>>,
    pub(super) is_under_way: bool,
}

/// The loads of a lump at a point of a body (m), its axes those of the columns of a matrix in the body.
pub(super) fn build_lump_loads(
    lump: &Lump,
    (at, axes): (Vector3<f64>, Matrix3<f64>),
    around: &LumpSurroundings,
) -> Vec<Box<dyn BodyLoad>> {
    let radius = (0.75 * lump.volume / PI).cbrt();
    let immersion = if lump.is_constant {
        Immersion::Whole
    } else {
        Immersion::Sphere { half_height: radius.max(LEAST_HALF_HEIGHT_M) }
    };
    let position = LoadPlace { at, medium: Medium::Water, immersion };
    let density = around.steady.around.water_density;
    let mut list: Vec<Box<dyn BodyLoad>> = Vec::new();
    let lift = if lump.is_buoyant { around.steady.around.water_weight() * lump.volume } else { 0.0 };
    if lift > 0.0 {
        list.push(Box::new(LumpBuoyancy { lift, position, steady: Arc::clone(around.steady) }));
    }
    let dragged = lump.drag_areas.iter().chain(&lump.rotary_drag).any(|value| *value > 0.0);
    if dragged && (around.is_under_way || !around.steady.is_still(Medium::Water)) {
        list.push(Box::new(LumpDrag {
            steady: Arc::clone(around.steady),
            sea: around.sea.cloned(),
            position,
            axes,
            areas: Vector3::from(lump.drag_areas) * (0.5 * density),
            rotary: Vector3::from(lump.rotary_drag) * (0.5 * density),
        }));
    }
    if let Some(sea) = around.sea.filter(|_| lump.volume > 0.0 && !lump.ignores_water_acceleration) {
        let mass = Vector3::from(lump.added).map(|ca| density * lump.volume * (1.0 + ca));
        let mass = axes * Matrix3::from_diagonal(&mass) * axes.transpose();
        list.push(Box::new(LumpInertia { steady: Arc::clone(around.steady), sea: Arc::clone(sea), position, mass }));
    }
    list
}

/// The added mass of a lump at its point, in the axes of its part (kg).
pub(super) fn added_mass(lump: &Lump, density: f64) -> Matrix6<f64> {
    let [x, y, z] = lump.added.map(|ca| density * lump.volume * ca);
    Matrix6::from_diagonal(&Six::new(x, y, z, 0.0, 0.0, 0.0))
}

/// Buoyancy.
#[derive(Debug)]
struct LumpBuoyancy {
    /// All of it (N).
    lift: f64,
    position: LoadPlace,
    steady: Arc<Steady>,
}

impl BodyLoad for LumpBuoyancy {
    fn category(&self) -> Category {
        Category::Buoyancy
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let arm = pose.axes * self.position.at;
        let (share, slope) = self.position.immersed_share(&self.steady, pose.origin.z + arm.z);
        let mut load = Load::constant(Vector3::new(0.0, 0.0, self.lift * share), arm);
        // the force changes as the point rises by d_z + (turn x arm)_z
        let rise = Six::new(0.0, 0.0, 1.0, arm.y, -arm.x, 0.0);
        load.stiffness -= rise * rise.transpose() * (self.lift * slope);
        Ok(load)
    }
}

/// Drag on areas and against turning.
#[derive(Debug)]
struct LumpDrag {
    steady: Arc<Steady>,
    sea: Option<Arc<Sea>>,
    position: LoadPlace,
    /// Columns: directions of the areas in the body.
    axes: Matrix3<f64>,
    /// Half the density times the areas (kg/m), and times what stands against turning (kg m2).
    areas: Vector3<f64>,
    rotary: Vector3<f64>,
}

impl LumpDrag {
    fn push(&self, stream: Vector3<f64>) -> StreamWrench {
        let speed = stream.norm();
        if speed == 0.0 {
            return StreamWrench::zero();
        }
        let tensor = self.axes * Matrix3::from_diagonal(&self.areas) * self.axes.transpose();
        let force = tensor * stream * speed;
        let mut by_velocity = Matrix6x3::zeros();
        let change = tensor * speed + (tensor * stream) * stream.transpose() / speed;
        by_velocity.fixed_rows_mut::<3>(0).copy_from(&change);
        StreamWrench { wrench: Six::new(force.x, force.y, force.z, 0.0, 0.0, 0.0), by_velocity }
    }

    /// Moment against the turning of the body, and its change with that, global axes.
    fn against_turning(&self, at: &BodyStep) -> DynamicLoad {
        let axes = at.pose.axes * self.axes;
        let turning = at.velocity.fixed_rows::<3>(3).into_owned();
        let own = axes.transpose() * turning;
        let moment = axes * own.component_mul(&own.abs()).component_mul(&-self.rotary);
        let by_rate = Matrix3::from_diagonal(&own.abs().component_mul(&(self.rotary * 2.0)));
        let by_rate = axes * by_rate * axes.transpose();
        let arm = at.pose.axes * self.position.at;
        let (share, slope) = self.position.immersed_share(&self.steady, at.pose.origin.z + arm.z);
        let mut made = DynamicLoad::default();
        made.load.wrench.fixed_rows_mut::<3>(3).copy_from(&(moment * share));
        made.damping.fixed_view_mut::<3, 3>(3, 3).copy_from(&(by_rate * share));
        // the axes turn with the body under a turning that stays
        let by_axes = (cross(moment) + by_rate * cross(turning)) * share;
        made.load.stiffness.fixed_view_mut::<3, 3>(3, 3).copy_from(&by_axes);
        let rise = Six::new(0.0, 0.0, 1.0, arm.y, -arm.x, 0.0);
        let mut by_rise = made.load.stiffness.fixed_rows_mut::<3>(3);
        by_rise -= moment * slope * rise.transpose();
        made
    }
}

impl BodyLoad for LumpDrag {
    fn category(&self) -> Category {
        Category::ViscousDrag
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        Ok(self.position.load(&self.steady, pose, |stream| self.push(stream)))
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let of_waves = three(state);
        let mut made = self.position.dynamic_load_in_waves(&self.steady, at, of_waves, |stream| self.push(stream));
        if self.rotary != Vector3::zeros() {
            let turning = self.against_turning(at);
            made.load.wrench += turning.load.wrench;
            made.load.stiffness += turning.load.stiffness;
            made.damping += turning.damping;
        }
        Ok(made)
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        self.sea.as_ref().map(|_| self as _)
    }
}

impl StatefulLoad for LumpDrag {
    fn states(&self) -> usize {
        if self.sea.is_some() { STATES } else { 0 }
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        if let Some(sea) = &self.sea {
            keep_water(sea, ahead, self.position.at, state);
        }
        Ok(())
    }
}

/// Pressure of waves, and their acceleration on the added mass.
#[derive(Debug)]
struct LumpInertia {
    steady: Arc<Steady>,
    sea: Arc<Sea>,
    position: LoadPlace,
    /// Displaced and added mass (kg), body axes.
    mass: Matrix3<f64>,
}

impl BodyLoad for LumpInertia {
    fn category(&self) -> Category {
        Category::Wave
    }

    /// Waves have no mean acceleration.
    fn mean_load(&self, _: &Pose) -> Result<Load, ClassError> {
        Ok(Load::none())
    }

    fn dynamic_load(&self, at: &BodyStep, state: &[f64]) -> Result<DynamicLoad, ClassError> {
        let acceleration = three(state.get(3..).unwrap_or_default());
        let arm = at.pose.axes * self.position.at;
        let (share, _) = self.position.immersed_share(&self.steady, at.pose.origin.z + arm.z);
        let force = at.pose.axes * self.mass * at.pose.axes.transpose() * acceleration * share;
        // how the force changes within a trial is of the second order of the wave: it is held for the step
        let moment = arm.cross(&force);
        let wrench = Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
        Ok(Load { wrench, stiffness: Matrix6::zeros() }.into())
    }

    fn as_stateful(&self) -> Option<&dyn StatefulLoad> {
        Some(self)
    }
}

impl StatefulLoad for LumpInertia {
    fn states(&self) -> usize {
        STATES
    }

    fn begin(&self, ahead: &BodyStep, state: &mut [f64]) -> Result<(), ClassError> {
        keep_water(&self.sea, ahead, self.position.at, state);
        Ok(())
    }
}

/// Keeps the velocity and acceleration of waves at a point of the body where it is expected.
fn keep_water(sea: &Sea, ahead: &BodyStep, at: Vector3<f64>, state: &mut [f64]) {
    let found = sea.kinematics(ahead.pose.point(at), ahead.time);
    for (kept, value) in state.iter_mut().zip(found.velocity.iter().chain(found.acceleration.iter())) {
        *kept = *value;
    }
}

fn three(values: &[f64]) -> Vector3<f64> {
    Vector3::from_iterator(values.iter().copied().chain([0.0; 3]).take(3))
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use windlass_base::geometry::Place;
    use windlass_model::{Current, Environment, Model};

    /// The loads of a lump in a current, under way without waves, at an oblique pose near the surface.
    fn loads(is_constant: bool) -> Vec<Box<dyn BodyLoad>> {
        let current = Some(Current::Uniform { velocity: 1.3, direction: 0.7 });
        let environment = Environment { current, depth: Some(100.0), ..Environment::default() };
        let steady = Arc::new(Steady::from_environment(&Model::default(), &environment).unwrap());
        let lump = Lump {
            volume: 4.0,
            is_buoyant: true,
            is_constant,
            drag_areas: [2.0, 3.0, 5.0],
            rotary_drag: [7.0, 11.0, 13.0],
            added: [0.5, 1.0, 1.5],
            ignores_water_acceleration: false,
        };
        let around = LumpSurroundings { steady: &steady, sea: None, is_under_way: true };
        build_lump_loads(&lump, (Vector3::new(0.4, -0.2, 0.3), Matrix3::identity()), &around)
    }

    fn sum(loads: &[Box<dyn BodyLoad>], pose: &Pose, velocity: &Six) -> DynamicLoad {
        let at = BodyStep { time: 1.0, dt: 0.1, pose, velocity };
        let mut made = DynamicLoad::default();
        loads.iter().for_each(|load| load.add_dynamic_load(&at, &[], &mut made).unwrap());
        made
    }

    #[test]
    fn stiffness_and_damping_of_a_lump_are_differences_of_its_force() {
        for is_constant in [false, true] {
            let loads = loads(is_constant);
            let pose = Pose::from_place(&Place::new([1.0, 2.0, -0.4, 0.3, -0.5, 0.8]));
            let velocity = Six::new(0.3, -0.7, 0.5, 0.2, -0.4, 0.6);
            let made = sum(&loads, &pose, &velocity);
            for freedom in 0..6 {
                let mut step = Six::zeros();
                step[freedom] = 1e-6;
                let [after, before] =
                    [step, -step].map(|step| sum(&loads, &pose.after_motion(&step), &velocity).load.wrench);
                let by_place = -(after - before) / 2e-6;
                let found = made.load.stiffness.column(freedom).into_owned();
                assert!((by_place - found).norm() < 1e-4 * (1.0 + found.norm()), "{freedom}: {by_place} {found}");
                let [after, before] = [step, -step].map(|step| sum(&loads, &pose, &(velocity + step)).load.wrench);
                let by_velocity = -(after - before) / 2e-6;
                let found = made.damping.column(freedom).into_owned();
                assert!((by_velocity - found).norm() < 1e-4 * (1.0 + found.norm()), "{freedom}: {by_velocity} {found}");
            }
        }
    }

    #[test]
    fn lump_half_under_water_bears_half_of_its_volume_and_a_constant_one_all() {
        for (is_constant, share) in [(false, 0.5), (true, 1.0)] {
            let loads = loads(is_constant);
            // its point is at the mean level
            let pose = Pose::from_position([0.0, 0.0, -0.3]);
            let lift: f64 = loads
                .iter()
                .filter(|load| load.category() == Category::Buoyancy)
                .map(|load| load.mean_load(&pose).unwrap().wrench[2])
                .sum();
            let whole = Model::default().surroundings().water_weight() * 4.0;
            assert!((lift / whole - share).abs() < 1e-12, "{lift}");
        }
    }
}
