//! A structure of round members under Morison's formula, as AQWA has it for tubes.
//!
//! Of a member with section A = pi D^2/4 and axis e, u and a being velocity and acceleration of the water, v that of the member, and n and s
//! parts across and along the axis [W-INSTALLED 3]:
//! - hydrostatic: `rho g A` upward on each length of the axis that is under the surface as it is (the crossing of the axis; sections are
//!   not cut);
//! - Froude-Krylov: `rho A a_n` across, and `A (p_from - p_to)` along it, also taken where the surface cuts it: the dynamic pressure there
//!   is what the hydrostatic one has too much;
//! - wave inertia: `rho Ca A a_n`, nothing along the axis; added mass: `rho Ca A` across;
//! - drag: `1/2 rho Cd D |u_n - v_n| (u_n - v_n)` by three Gauss points, the water linear along the wet part; friction
//!   `1/2 rho Cf pi D L |u_s - v_s| (u_s - v_s)`; Munk's moment `-rho Ca A L (u_s - v_s) e x (u_n - v_n)` [MUNK-1924], with the means along it.
//!
//! The water is asked for at two Gauss points of the wet part.

use super::flow::FlowAt;
use super::submergence::WetPart;
use super::{Structure, StructureForces};
use crate::compatibility::Compatibility;
use nalgebra::{Matrix3, Matrix6, Vector3};
use std::f64::consts::PI;
use windlass_base::dense::{Cholesky, never};
use windlass_base::pose::{Pose, Six};
use windlass_hydro::{BodyStep, cross, move_wrench};
use windlass_model::ClassError;

/// Friction along a tube that AQWA always counts ([AQWA-REF TUBE]; a fit to the listing of [AQWA-TETHER 8.2] gives 0.01600).
pub const AQWA_FRICTION: f64 = 0.016;

/// Gauss points of two and of three on 0 to 1, with weights.
const GAUSS_TWO_POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];
const GAUSS_THREE_POINTS: [(f64, f64); 3] =
    [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];

/// A member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TubeMember {
    /// Its ends, axes of the structure from its centre of gravity (m). Its ends are closed: what joins another tube end to end cancels.
    pub ends: [Vector3<f64>; 2],
    /// Outer diameter (m).
    pub diameter: f64,
    /// Drag coefficient across.
    pub drag: f64,
    /// Added mass coefficient across.
    pub added: f64,
    /// Friction coefficient along it, on its surface.
    pub friction: f64,
}

/// A structure of tubes.
#[derive(Clone, Debug)]
pub struct Tubes {
    /// Mass (kg).
    mass: f64,
    /// Moments of inertia about the centre of gravity, axes of the structure (kg m2).
    inertia: Matrix3<f64>,
    tubes: Vec<TubeMember>,
    compatibility: Compatibility,
}

impl Tubes {
    /// A structure of a mass (kg), moments of inertia about its centre of gravity (kg m2, its own axes) and tubes.
    ///
    /// # Errors
    /// A mass or inertia that is not positive; a tube without length, or with a value that is not finite.
    pub fn new(
        mass: f64,
        inertia: Matrix3<f64>,
        tubes: Vec<TubeMember>,
        compatibility: Compatibility,
    ) -> Result<Self, ClassError> {
        if !(mass > 0.0 && mass.is_finite()) || Cholesky::new(inertia, &never).is_err() {
            return Err(ClassError::new("a structure of tubes needs a mass and moments of inertia greater than zero"));
        }
        for (index, tube) in tubes.iter().enumerate() {
            let length = (tube.ends[1] - tube.ends[0]).norm();
            let numbers = [tube.diameter, tube.drag, tube.added, tube.friction];
            if !(length > 0.0 && length.is_finite()) {
                return Err(ClassError::new(format!("tube {} of the structure has no length", index + 1)));
            }
            if !numbers.iter().all(|x| x.is_finite() && *x >= 0.0) || tube.diameter == 0.0 {
                let text = format!("tube {} of the structure has a diameter or coefficient out of range", index + 1);
                return Err(ClassError::new(text).help("a diameter is greater than zero, a coefficient not less"));
            }
        }
        Ok(Tubes { mass, inertia, tubes, compatibility })
    }

    /// Its tubes.
    pub fn tubes(&self) -> &[TubeMember] {
        &self.tubes
    }
}

impl Structure for Tubes {
    fn forces(&mut self, at: &BodyStep, water: &FlowAt, _: bool, out: &mut StructureForces) -> Result<(), ClassError> {
        let mooring = out.mooring;
        *out = StructureForces { mooring, ..StructureForces::default() };
        let turned = at.pose.axes * self.inertia * at.pose.axes.transpose();
        let spin = Vector3::new(at.velocity[3], at.velocity[4], at.velocity[5]);
        out.gravity[2] = -self.mass * water.flow().gravity;
        add_force(&mut out.gyroscopic, Vector3::zeros(), -spin.cross(&(turned * spin)));
        out.inertia.fixed_view_mut::<3, 3>(0, 0).fill_with_identity();
        out.inertia *= self.mass;
        out.inertia.fixed_view_mut::<3, 3>(3, 3).copy_from(&turned);
        for tube in &self.tubes {
            if let Some(wet) = WetPart::new(tube.ends.map(|end| at.pose.point(end)), water) {
                tube.add(&wet, (at.pose, at.velocity), water, &self.compatibility, out);
            }
        }
        Ok(())
    }
}

/// Adds a force (N) with an arm (m) and a moment (N m).
fn add_force(sum: &mut Six, force: Vector3<f64>, moment: Vector3<f64>) {
    *sum += Six::new(force.x, force.y, force.z, moment.x, moment.y, moment.z);
}

/// A value that is linear along a part, by those at its two Gauss points.
#[derive(Clone, Copy)]
struct Straight([Vector3<f64>; 2]);

impl Straight {
    /// At a place from 0 to 1.
    fn position(&self, x: f64) -> Vector3<f64> {
        self.0[0] + (self.0[1] - self.0[0]) * ((x - GAUSS_TWO_POINTS[0]) / (GAUSS_TWO_POINTS[1] - GAUSS_TWO_POINTS[0]))
    }
}

impl TubeMember {
    /// Adds what acts on the wet part of it.
    fn add(
        &self,
        wet: &WetPart,
        (pose, moves): (&Pose, &Six),
        water: &FlowAt,
        compatibility: &Compatibility,
        out: &mut StructureForces,
    ) {
        let (density, gravity) = (water.flow().density, water.flow().gravity);
        let section = PI * self.diameter * self.diameter / 4.0;
        let (length, axis) = (wet.wet(), wet.axis);
        let velocity = Vector3::new(moves[0], moves[1], moves[2]);
        let spin = Vector3::new(moves[3], moves[4], moves[5]);
        let arm = |share: f64| wet.point(share) - pose.origin;
        let across = |v: Vector3<f64>| v - axis * axis.dot(&v);
        let found = GAUSS_TWO_POINTS.map(|x| water.kinematics(wet.point(x * wet.share)));
        let (flow, rate) = (Straight(found.map(|k| k.velocity)), Straight(found.map(|k| k.acceleration)));
        // where along the fit a share of the whole member stands
        let along = |share: f64| if compatibility.whole_element_kinematics { share } else { share / wet.share };
        let relative = |share: f64| flow.position(along(share)) - velocity - spin.cross(&arm(share));

        let lift = Vector3::z() * (density * gravity * section * length);
        out.hydrostatic += move_wrench(&force(lift), arm(0.5 * wet.share));
        let [foot, head] = [0.0, wet.share].map(|share| water.kinematics(wet.point(share)).pressure);
        out.froude_krylov += move_wrench(&force(axis * (section * (foot - head))), arm(0.0));

        let mut mean = Vector3::zeros();
        for (x, weight) in GAUSS_THREE_POINTS {
            let share = x * wet.share;
            let part = weight * length;
            let u = across(relative(share));
            mean += u * weight;
            let inertial = across(rate.position(along(share))) * (density * section * part);
            out.froude_krylov += move_wrench(&force(inertial), arm(share));
            out.wave_inertia += move_wrench(&force(inertial * self.added), arm(share));
            let drag = u * (0.5 * density * self.drag * self.diameter * part * u.norm());
            out.drag += move_wrench(&force(drag), arm(share));
            self.add_mass(arm(share), axis, density * section * self.added * part, &mut out.inertia);
        }
        let at = if compatibility.friction_at_first_node { 0.0 } else { 0.5 * wet.share };
        let slip = axis.dot(&relative(at));
        let friction = 0.5 * density * self.friction * PI * self.diameter * length * slip.abs() * slip;
        out.drag += move_wrench(&force(axis * friction), arm(0.0));
        let munk = axis.cross(&mean) * (-density * section * self.added * length * slip);
        add_force(&mut out.drag, Vector3::zeros(), munk);
    }

    /// Adds a mass (kg) that resists motion across an axis at the end of an arm.
    fn add_mass(&self, arm: Vector3<f64>, axis: Vector3<f64>, mass: f64, inertia: &mut Matrix6<f64>) {
        let plane = (Matrix3::identity() - axis * axis.transpose()) * mass;
        // velocity of the point: v - arm x spin
        let lever = cross(arm);
        let turned = plane * lever;
        let mut add = |row: usize, column: usize, block: Matrix3<f64>| {
            let mut at = inertia.fixed_view_mut::<3, 3>(row, column);
            at += block;
        };
        add(0, 0, plane);
        add(0, 3, -turned);
        add(3, 0, -turned.transpose());
        add(3, 3, lever.transpose() * turned);
    }
}

/// A force without a moment.
fn force(f: Vector3<f64>) -> Six {
    Six::new(f.x, f.y, f.z, 0.0, 0.0, 0.0)
}
