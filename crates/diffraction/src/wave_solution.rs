//! Potentials on the hulls at one frequency, and the mean drift that waves far away tell.
//!
//! The waves that a body sends out have far away the elevation `f(theta) exp(i k r)/sqrt(r)`,
//!
//! ```text
//! f(theta) = -(omega a0/2 g) sqrt(2/(pi k)) exp(-i pi/4) H(theta)
//! H(theta) = int (phi_n - phi d/dn) cosh k(z + h)/cosh k h exp(-i k (x cos theta + y sin theta)) dS
//! ```
//!
//! with Kochin's function `H` and the amplitude `a0` of the Green function. The momentum that they carry away and that the incident wave loses
//! is the mean drift [MARUO-1960] [NEWMAN-1967].

use crate::incident_wave::IncidentWave;
use crate::mesh::{HullMesh, SurfaceElement};
use crate::problem::{BodyPart, FrequencyForces, Water};
use nalgebra::Complex;
use std::f64::consts::PI;
use std::sync::Arc;

type C = Complex<f64>;

/// Directions of the waves far away beyond two for each wave length of the hull's circumference; the sum converges faster than any power.
const SPARE_DIRECTIONS: usize = 48;

/// Forces at one frequency, with the potentials on the hulls.
#[derive(Clone, Debug)]
pub struct WaveSolution {
    /// Added mass, damping and wave forces.
    pub forces: FrequencyForces,
    pub(crate) wave: IncidentWave,
    /// Of the Green function far away (1/m).
    pub(crate) amplitude: f64,
    pub(crate) mesh: Arc<HullMesh>,
    pub(crate) bodies: Arc<[BodyPart]>,
    pub(crate) surface: Vec<SurfaceElement>,
    pub(crate) headings: Vec<f64>,
    pub(crate) water: Water,
    /// Of each motion: the normal velocity on the surface, out of the water.
    pub(crate) velocities: Vec<Vec<f64>>,
    /// Of each motion: the potential of its unit velocity.
    pub(crate) radiated: Vec<Vec<C>>,
    /// Of each heading: the potential of the incident and the scattered wave together.
    pub(crate) diffracted: Vec<Vec<C>>,
}

/// Mean drift by the waves far away, for a wave of amplitude 1 m; of several bodies the sum.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct FarFieldDrift {
    /// Force along x (N/m2).
    pub surge: f64,
    /// Force along y (N/m2).
    pub sway: f64,
    /// Moment about the vertical through the global origin (N m/m2).
    pub yaw: f64,
    /// What is left of the balance of energy, over the energy that the bodies scatter: a measure of the mesh.
    pub energy_residual: f64,
}

/// Kochin's function in one direction, and its derivative by the angle.
#[derive(Clone, Copy, Default)]
struct Kochin {
    value: C,
    by_angle: C,
}

impl WaveSolution {
    /// The mean drift for one of the headings, by its index; `motions` are those of the bodies for a wave of amplitude 1 m (m/m, rad/m), zeros
    /// for fixed bodies. None where there is no such heading, or the motions are not six a body.
    ///
    /// Power that the motions lose to other damping than radiation is taken from the incident wave.
    pub fn far_field_drift(&self, heading: usize, motions: &[C]) -> Option<FarFieldDrift> {
        let beta = *self.headings.get(heading)?;
        let (potential, by_normal) = self.sent_out(heading, motions)?;
        let (k, omega) = (self.wave.wave_number, self.wave.frequency);
        let radius = self.surface.iter().map(|at| at.centroid.x.hypot(at.centroid.y)).fold(0.0, f64::max);
        let count = SPARE_DIRECTIONS + 2 * (2.0 * k * radius).ceil() as usize;
        let step = 2.0 * PI / count as f64;
        // |f|2 = scale |H|2
        let factor = omega * self.amplitude / self.wave.gravity;
        let scale = factor * factor / (2.0 * PI * k);
        let (mut energy, mut along, mut across, mut turning) = (0.0, 0.0, 0.0, 0.0);
        for i in 0..count {
            let angle = step * i as f64;
            let found = self.kochin(&potential, &by_normal, angle);
            let share = scale * step * found.value.norm_sqr();
            energy += share;
            along += share * angle.cos();
            across += share * angle.sin();
            turning += scale * step * (found.value.conj() * found.by_angle).im;
        }
        let forward = self.kochin(&potential, &by_normal, beta);
        let interference = -2.0 * factor / k * forward.value.re;
        let turning_interference = -2.0 * factor / k * forward.by_angle.im;
        let unit = 0.5 * self.water.density * self.water.gravity * self.wave.group_share();
        let speed = omega / k;
        // the work of the water on the bodies, which other damping takes, and what damped patches take
        let taken = self.absorbed_power(heading, motions)? + self.dissipated_power(heading, motions)?;
        let absorbed = taken / (unit * speed);
        let (sine, cosine) = beta.sin_cos();
        Some(FarFieldDrift {
            surge: unit * ((energy + absorbed) * cosine - along),
            sway: unit * ((energy + absorbed) * sine - across),
            yaw: -unit / k * (turning + turning_interference),
            energy_residual: (energy + interference + absorbed) / energy,
        })
    }

    /// The potential whose waves go out from the bodies, and its derivative along the normal; that of the incident wave goes through the
    /// hull and sends out nothing.
    pub(crate) fn sent_out(&self, heading: usize, motions: &[C]) -> Option<(Vec<C>, Vec<C>)> {
        let mut potential = self.diffracted.get(heading)?.clone();
        let mut by_normal = vec![C::default(); potential.len()];
        if motions.len() != self.radiated.len() {
            return None;
        }
        for ((motion, radiated), velocities) in motions.iter().zip(&self.radiated).zip(&self.velocities) {
            let velocity = C::new(0.0, -self.wave.frequency) * motion;
            for (value, own) in potential.iter_mut().zip(radiated) {
                *value += own * velocity;
            }
            for (value, own) in by_normal.iter_mut().zip(velocities) {
                *value += velocity * *own;
            }
        }
        // a damped patch is a layer of sources
        for (at, epsilon) in self.patch_elements() {
            let nu = self.wave.frequency * self.wave.frequency / self.wave.gravity;
            by_normal[at] = potential[at] * C::new(0.0, epsilon * nu);
            potential[at] = C::default();
        }
        Some((potential, by_normal))
    }

    /// Elements of the surface that are of damped patches, and their damping.
    pub(crate) fn patch_elements(&self) -> impl Iterator<Item = (usize, f64)> + '_ {
        let (first, (_, damping)) = (self.mesh.hull_count(), self.mesh.patches());
        self.surface
            .iter()
            .enumerate()
            .filter_map(move |(i, at)| Some((i, *damping.get(at.panel.checked_sub(first)?)?)))
    }

    /// The mean power (W/m2) that damped patches take from waves of amplitude 1 m from one of the headings, by its index, with the motions of the bodies:
    /// `rho omega nu/2 int epsilon |phi|2 dS`. None as of [`WaveSolution::far_field_drift`].
    pub fn dissipated_power(&self, heading: usize, motions: &[C]) -> Option<f64> {
        let (_, by_normal) = self.sent_out(heading, motions)?;
        let nu = self.wave.frequency * self.wave.frequency / self.wave.gravity;
        let of_element = |(at, epsilon): (usize, f64)| {
            // the sources are i epsilon nu phi
            let share = if epsilon > 0.0 { by_normal[at].norm_sqr() / (epsilon * nu) } else { 0.0 };
            share * self.surface[at].area
        };
        Some(0.5 * self.water.density * self.wave.frequency * self.patch_elements().map(of_element).sum::<f64>())
    }

    fn kochin(&self, potential: &[C], by_normal: &[C], angle: f64) -> Kochin {
        let k = self.wave.wave_number;
        let (sine, cosine) = angle.sin_cos();
        let mut sum = Kochin::default();
        for ((at, potential), by_normal) in self.surface.iter().zip(potential).zip(by_normal) {
            let (x, y) = (at.centroid.x, at.centroid.y);
            let (fall, slope) = self.wave.profile(at.centroid.z);
            let (along, across) = (x * cosine + y * sine, y * cosine - x * sine);
            let wave = C::from_polar(at.area, -k * along);
            let normal_along = at.normal.x * cosine + at.normal.y * sine;
            let normal_across = at.normal.y * cosine - at.normal.x * sine;
            // d/dn of the wave, over the wave
            let inclination = C::new(slope * at.normal.z, -k * normal_along * fall);
            let source = by_normal * fall - potential * inclination;
            let turned = C::new(0.0, k * normal_across * fall) * potential;
            sum.value += wave * source;
            sum.by_angle += wave * (source * C::new(0.0, -k * across) + turned);
        }
        sum
    }

    /// The mean power of the water on moving bodies (W/m2).
    fn absorbed_power(&self, heading: usize, motions: &[C]) -> Option<f64> {
        let forces = &self.forces;
        let excitation = forces.excitation.get(heading)?;
        let omega = forces.frequency;
        let power = motions.iter().zip(excitation).enumerate().map(|(i, (motion, excitation))| {
            let radiation = forces.radiation_force(i, motions);
            0.5 * ((C::new(0.0, -omega) * motion).conj() * (excitation + radiation)).re
        });
        Some(power.sum())
    }
}
