//! Mean drift of each body by the pressure on its hull [PINKSTER-1980] [LEE-2007].
//!
//! With the motion `X = xi + alpha x r` of a point of the hull, the elevation `zeta` of its waterline and the forces `F` of the water of first order, in the
//! mean over a period
//!
//! ```text
//! F2 = (rho g/2) int (zeta - X_z)2 n dl - rho int (|grad phi|2/2 + X . grad phi_t) n dS + alpha x F
//! M2 = (rho g/2) int (zeta - X_z)2 r x n dl - rho int (|grad phi|2/2 + X . grad phi_t) r x n dS + xi x F + alpha x M'
//! ```
//!
//! in x and y, and about the vertical; `M'` is the moment of the pressure about the origin of the body, in axes of the body.

use crate::local_fit::{LocalFit, LocalPotential};
use crate::problem::{BodyPart, MOTIONS};
use crate::rankine::mirrored;
use crate::wave_solution::WaveSolution;
use nalgebra::{Complex, Vector3};
use rayon::prelude::*;

type C = Complex<f64>;

/// A panel has no sideways part below this share of its normal.
const FLAT_SHARE: f64 = 1e-6;
/// Places of Gauss's rule of two points along a side.
const SIDE_POINTS: [f64; 2] = [0.211_324_865_405_187_1, 0.788_675_134_594_812_9];

/// Mean drift of a body by the pressure on its hull, for a wave of amplitude 1 m.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct NearFieldDrift {
    /// Force along x (N/m2).
    pub surge: f64,
    /// Force along y (N/m2).
    pub sway: f64,
    /// Moment about the vertical through the origin of the body (N m/m2).
    pub yaw: f64,
}

/// The mean of the product of two numbers over a period.
fn mean(a: C, b: C) -> f64 {
    0.5 * (a * b.conj()).re
}

/// The mean of the vector product of two vectors over a period.
fn mean_cross(a: &[C; 3], b: &[C; 3]) -> Vector3<f64> {
    let part = |i: usize, j: usize| mean(a[i], b[j]) - mean(a[j], b[i]);
    Vector3::new(part(1, 2), part(2, 0), part(0, 1))
}

impl WaveSolution {
    /// The mean drift of each body by the pressure on its hull, heading by heading, then body by body; `motions` are those of all bodies for each heading
    /// (m/m, rad/m). None where the motions are not those of all headings.
    ///
    /// At sharp edges the velocity has no bound, and the panels have to be small there: the error falls slower than that of the other ways.
    pub fn near_field_drift(&self, motions: &[Vec<C>]) -> Option<Vec<Vec<NearFieldDrift>>> {
        if motions.len() != self.headings.len() {
            return None;
        }
        let fits = self.local_fits();
        let of_heading = |(heading, motions): (usize, &Vec<C>)| self.near_field_of_heading(heading, motions, &fits);
        motions.iter().enumerate().map(of_heading).collect()
    }

    fn near_field_of_heading(
        &self,
        heading: usize,
        motions: &[C],
        fits: &[Option<LocalFit>],
    ) -> Option<Vec<NearFieldDrift>> {
        let (potential, _) = self.sent_out(heading, motions)?;
        let beta = *self.headings.get(heading)?;
        // that of the incident wave is exact
        let scattered: Vec<C> =
            self.surface.iter().zip(&potential).map(|(at, all)| all - self.wave.at(&at.centroid, beta).0).collect();
        let of_body = |(body, part): (usize, &BodyPart)| -> Option<NearFieldDrift> {
            let own: [C; MOTIONS] = motions.get(MOTIONS * body..)?.first_chunk().copied()?;
            let moving =
                RigidMotion { shift: [own[0], own[1], own[2]], turn: [own[3], own[4], own[5]], origin: part.origin };
            let is_own = |at: &usize| part.panels.contains(&self.surface[*at].panel);
            let elements: Vec<usize> = (0..self.surface.len()).filter(is_own).collect();
            let shares: Vec<[Vector3<f64>; 2]> = elements
                .par_iter()
                .map(|at| {
                    fits[*at]
                        .as_ref()
                        .map_or([Vector3::zeros(); 2], |fit| self.of_element(*at, fit, beta, &scattered, &moving))
                })
                .collect();
            let [force, moment] =
                shares.iter().fold([Vector3::zeros(); 2], |sum, own| [sum[0] + own[0], sum[1] + own[1]]);
            let first = self.first_order(heading, motions, body, &elements, &moving)?;
            let (loads, moments) = (&first[0], &first[1]);
            let turned = mean_cross(&moving.turn, loads);
            let shifted = mean_cross(&moving.shift, loads);
            let twisted = mean_cross(&moving.turn, moments);
            Some(NearFieldDrift {
                surge: force.x + turned.x,
                sway: force.y + turned.y,
                yaw: moment.z + shifted.z + twisted.z,
            })
        };
        self.bodies.iter().enumerate().map(of_body).collect()
    }

    /// Force of the water of first order on a body, in axes that do not turn; its moment about the origin of the body, in axes that turn.
    fn first_order(
        &self,
        heading: usize,
        motions: &[C],
        body: usize,
        elements: &[usize],
        moving: &RigidMotion,
    ) -> Option<[[C; 3]; 2]> {
        let forces = &self.forces;
        let excitation = forces.excitation.get(heading)?;
        let mut made = [[C::default(); 3]; 2];
        for (axis, value) in made.iter_mut().flatten().enumerate() {
            let direction = MOTIONS * body + axis;
            *value = excitation.get(direction)? + forces.radiation_force(direction, motions);
        }
        // of the water at rest: in the force the horizontal parts of the pressure and of the turn of the force of rest cancel
        let weight = -self.water.density * self.water.gravity;
        for at in elements {
            let element = &self.surface[*at];
            let panel = self.mesh.panels().get(element.panel)?;
            for (point, area) in panel.rule() {
                let point = mirrored(point, element.image);
                let pressure = moving.at(&point)[2] * (weight * area);
                let arm = (point - moving.origin).cross(&element.normal);
                made[0][2] += pressure * element.normal.z;
                (0..3).for_each(|axis| made[1][axis] += pressure * arm[axis]);
            }
        }
        Some(made)
    }

    /// Force and moment about the origin of the body by the pressure of second order on an element and on its waterline.
    fn of_element(
        &self,
        at: usize,
        fit: &LocalFit,
        beta: f64,
        scattered: &[C],
        moving: &RigidMotion,
    ) -> [Vector3<f64>; 2] {
        let element = &self.surface[at];
        let (density, gravity, omega) = (self.water.density, self.wave.gravity, self.wave.frequency);
        let incident = |point: &Vector3<f64>| self.wave.at(point, beta);
        // of the scattered waves, along a normal
        let by_normal = |point: &Vector3<f64>, normal: &Vector3<f64>| -> C {
            let moved: C = moving.at(point).iter().zip(normal.iter()).map(|(x, n)| x * *n).sum();
            let passing: C = incident(point).1.iter().zip(normal.iter()).map(|(g, n)| g * *n).sum();
            C::new(0.0, -omega) * moved - passing
        };
        let nu = omega * omega / gravity;
        let corner = fit.corner.as_ref().map_or_else(C::default, |corner| corner.strength(moving, omega, nu));
        // without the part of the corner of hull and surface
        let smooth = |at: usize| {
            let part = fit.corner.as_ref().map_or(0.0, |own| own.part(&self.surface[at].centroid).0);
            scattered[at] - corner * part
        };
        let own = smooth(at);
        let around = fit.around.iter().map(|(other, share)| share.map(C::from) * (smooth(*other) - own));
        let conditions = fit.sides.iter().filter_map(|side| {
            let middle = (side.ends[0] + side.ends[1]) * 0.5;
            let normal = fit.normal_at(&middle);
            let given = own * nu - by_normal(&middle, &normal) * normal.z;
            side.condition.map(|condition| condition.map(C::from) * given)
        });
        let local = LocalPotential { fit, value: own, coefficients: around.chain(conditions).sum(), corner };
        let mut made = [Vector3::zeros(); 2];
        let Some(panel) = self.mesh.panels().get(element.panel) else { return made };
        let mut add = |point: &Vector3<f64>, load: Vector3<f64>| {
            made[0] += load;
            made[1] += (point - moving.origin).cross(&load);
        };
        for (point, area) in panel.rule() {
            let point = &mirrored(point, element.image);
            let normal = fit.normal_at(point);
            let flow = incident(point).1 + local.velocity(point, by_normal(point, &normal));
            let square: f64 = flow.iter().map(|v| mean(*v, *v)).sum();
            // X . grad phi_t
            let moved: f64 =
                moving.at(point).iter().zip(flow.iter()).map(|(x, v)| mean(*x, v * C::new(0.0, -omega))).sum();
            add(point, element.normal * (-density * (0.5 * square + moved) * area));
        }
        let sideways = Vector3::new(element.normal.x, element.normal.y, 0.0);
        let Some(outward) = sideways.try_normalize(FLAT_SHARE) else { return made };
        for side in &fit.sides {
            let length = (side.ends[1] - side.ends[0]).norm();
            for share in SIDE_POINTS {
                let point = side.ends[0] + (side.ends[1] - side.ends[0]) * share;
                let head = (incident(&point).0 + local.value(&point)) * C::new(0.0, omega / gravity);
                let relative = head - moving.at(&point)[2];
                // in a damped patch the water rises beyond the head of its pressure
                let square = mean(relative, relative) - side.damping * side.damping * mean(head, head);
                add(&point, outward * (0.5 * density * gravity * square * 0.5 * length));
            }
        }
        made
    }
}

/// Motion of a body in waves of amplitude 1 m (m/m, rad/m).
pub(crate) struct RigidMotion {
    shift: [C; 3],
    turn: [C; 3],
    origin: Vector3<f64>,
}

impl RigidMotion {
    /// That of a point.
    pub(crate) fn at(&self, point: &Vector3<f64>) -> [C; 3] {
        let arm = point - self.origin;
        let part = |i: usize, j: usize| self.turn[i] * arm[j] - self.turn[j] * arm[i];
        [self.shift[0] + part(1, 2), self.shift[1] + part(2, 0), self.shift[2] + part(0, 1)]
    }
}
