//! Marine growth on the tubes of a body: its weight, its buoyancy, its inertia, and the wider shape that current meets.
//!
//! Growth is put on every piece that is a tube, but those that are open spaces within others, by the elevations at which the body
//! stands when its loads are made, and moves with it. It is cut in rings along the axis. Pieces of panels and blocks have none.

use super::growth::Growth;
use super::{BodyLoad, Category, Load, cross};
use nalgebra::{Matrix6, Vector3};
use windlass_base::pose::{Pose, Six};
use windlass_model::{Body, ClassError, Model, Shape, Surroundings};

/// Length of a ring (m), and the greatest number of them on a tube.
const RING_LENGTH_M: f64 = 1.0;
const MAX_RINGS: f64 = 500.0;
/// By how much of a tube a station stands off a jump of the growth.
const JUMP_OFFSET_SHARE: f64 = 1e-9;

/// A ring of growth.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Ring {
    /// Its middle, in the body (m).
    at: Vector3<f64>,
    /// Its volume (m3).
    volume: f64,
    /// Its height where the body stands (m): over it the ring goes into the water.
    height: f64,
}

/// The buoyancy of rings.
#[derive(Debug)]
struct GrowthBuoyancy {
    rings: Vec<Ring>,
    around: Surroundings,
}

/// The weight of rings.
#[derive(Debug)]
struct GrowthWeight {
    weight: f64,
    /// Their centre of gravity, in the body (m).
    centre: Vector3<f64>,
}

/// What growth does to a body.
#[derive(Debug, Default)]
pub struct GrowthLoads {
    /// Its weight and buoyancy.
    pub loads: Vec<Box<dyn BodyLoad>>,
    /// Its inertia about the body's origin, body axes (kg, kg m, kg m2).
    pub mass: Matrix6<f64>,
}

/// The growth of the environment in force on a body.
///
/// # Errors
/// As [`Growth::from_environment`].
pub fn build_growth_loads(model: &Model, body: &Body) -> Result<GrowthLoads, ClassError> {
    let mut made = GrowthLoads::default();
    let Some(growth) = Growth::from_environment(model, &model.environment)? else { return Ok(made) };
    let (pose, around) = (Pose::from_place(&body.position), model.surroundings());
    let mut all = Vec::new();
    for part in model.parts_of(body) {
        for piece in part.pieces.iter().filter(|p| p.permeability >= 0.0 && p.compartment.is_none()) {
            if let Shape::Tube { ends, diameter } = piece.shape.with_displacement(&part.position) {
                all.extend(rings(&growth, &pose, ends.map(Vector3::from), diameter));
            }
        }
    }
    let volume: f64 = all.iter().map(|r| r.volume).sum();
    if volume <= 0.0 {
        return Ok(made);
    }
    for ring in &all {
        made.mass += inertia(growth.density * ring.volume, ring.at);
    }
    let centre = all.iter().map(|r| r.at * r.volume).sum::<Vector3<f64>>() / volume;
    made.loads.push(Box::new(GrowthWeight { weight: growth.density * volume * around.gravity, centre }));
    made.loads.push(Box::new(GrowthBuoyancy { rings: all, around }));
    Ok(made)
}

/// The rings on a tube between two points of the body (m), of a bare diameter (m).
fn rings(growth: &Growth, pose: &Pose, [from, to]: [Vector3<f64>; 2], diameter: f64) -> Vec<Ring> {
    let axis = to - from;
    let length = axis.norm();
    let count = (length / RING_LENGTH_M).ceil().clamp(1.0, MAX_RINGS);
    let rise = if length > 0.0 { (pose.axes * axis).z.abs() / length } else { 0.0 };
    let across = (1.0 - rise * rise).max(0.0).sqrt();
    let ring = |n: usize| {
        let at = from + axis * ((n as f64 + 0.5) / count);
        let z = pose.point(at).z;
        let height = rise * length / count + across * (diameter + growth.added_diameter(z));
        Ring { at, volume: growth.section(diameter, z) * length / count, height }
    };
    (0..count as usize).map(ring).filter(|r| r.volume > 0.0 && r.height > 0.0).collect()
}

/// The inertia of a point of a mass (kg) at a point of the body (m), about its origin.
fn inertia(mass: f64, at: Vector3<f64>) -> Matrix6<f64> {
    let mut made = Matrix6::zeros();
    let arm = cross(at);
    made.fixed_view_mut::<3, 3>(0, 0).fill_diagonal(mass);
    made.fixed_view_mut::<3, 3>(0, 3).copy_from(&(-arm * mass));
    made.fixed_view_mut::<3, 3>(3, 0).copy_from(&(arm * mass));
    made.fixed_view_mut::<3, 3>(3, 3).copy_from(&(-arm * arm * mass));
    made
}

/// Where along a tube, from 0 to 1, it has which outside diameter (m) with growth on it: straight between the stations.
pub fn stations(growth: &Growth, pose: &Pose, [from, to]: [Vector3<f64>; 2], diameter: f64) -> Vec<(f64, f64)> {
    let (low, high) = (pose.point(from).z, pose.point(to).z);
    let part = |z: f64| (z - low) / (high - low);
    let inside = |t: &f64| *t > 2.0 * JUMP_OFFSET_SHARE && *t < 1.0 - 2.0 * JUMP_OFFSET_SHARE;
    let mut cuts: Vec<f64> = growth.elevations().map(part).filter(inside).collect();
    cuts.extend([0.0, 1.0]);
    cuts.sort_by(f64::total_cmp);
    let wide = |t: f64| diameter + growth.added_diameter(low + (high - low) * t);
    let mut made: Vec<(f64, f64)> = Vec::new();
    for pair in cuts.windows(2) {
        let [a, b] = pair else { continue };
        made.extend([(*a, wide(a + JUMP_OFFSET_SHARE)), (*b, wide(b - JUMP_OFFSET_SHARE))]);
    }
    made
}

impl BodyLoad for GrowthWeight {
    fn category(&self) -> Category {
        Category::Weight
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        Ok(Load::constant(Vector3::new(0.0, 0.0, -self.weight), pose.axes * self.centre))
    }
}

impl BodyLoad for GrowthBuoyancy {
    fn category(&self) -> Category {
        Category::Buoyancy
    }

    fn mean_load(&self, pose: &Pose) -> Result<Load, ClassError> {
        let mut sum = Load::none();
        for ring in &self.rings {
            let arm = pose.axes * ring.at;
            let sunk = 0.5 - (pose.origin.z + arm.z - self.around.tide) / ring.height;
            let whole = self.around.water_weight() * ring.volume;
            let Load { wrench, stiffness } = Load::constant(Vector3::new(0.0, 0.0, whole * sunk.clamp(0.0, 1.0)), arm);
            sum.wrench += wrench;
            sum.stiffness += stiffness;
            if sunk > 0.0 && sunk < 1.0 {
                let turn = arm.cross(&Vector3::z());
                let lift = Six::new(0.0, 0.0, 1.0, turn.x, turn.y, turn.z);
                sum.stiffness += lift * lift.transpose() * (whole / ring.height);
            }
        }
        Ok(sum)
    }
}
