//! The incident wave.

use crate::rankine::mirrored;
use crate::symmetry::SymmetryClass;
use nalgebra::{Complex, Vector3};

type C = Complex<f64>;

/// A regular wave of amplitude 1 m.
#[derive(Clone, Copy, Debug)]
pub struct IncidentWave {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Wave number (1/m).
    pub wave_number: f64,
    /// Acceleration of gravity (m/s2).
    pub gravity: f64,
    /// Depth (m); none is deep water.
    pub depth: Option<f64>,
}

impl IncidentWave {
    /// `cosh k(z + h)/cosh k h` and its derivative by z (1/m).
    pub fn profile(&self, z: f64) -> (f64, f64) {
        let k = self.wave_number;
        // without large exponents
        self.depth.map_or(((k * z).exp(), k * (k * z).exp()), |depth| {
            let scale = 1.0 / (1.0 + (-2.0 * k * depth).exp());
            let (up, down) = ((k * z).exp(), (-k * (z + 2.0 * depth)).exp());
            ((up + down) * scale, k * (up - down) * scale)
        })
    }

    /// The speed of energy over that of crests: 1/2 in deep water, 1 in shallow water.
    pub fn group_share(&self) -> f64 {
        let twice = self.depth.map(|depth| 2.0 * self.wave_number * depth);
        // where sinh overflows the water is deep
        0.5 + twice.map_or(0.0, |twice| 0.5 * twice / twice.sinh())
    }

    /// Its potential at a point, and its gradient.
    pub fn at(&self, point: &Vector3<f64>, heading: f64) -> (C, Vector3<C>) {
        let (sine, cosine) = heading.sin_cos();
        let k = self.wave_number;
        let (fall, slope) = self.profile(point.z);
        let at_surface =
            C::new(0.0, -self.gravity / self.frequency) * C::from_polar(1.0, k * (point.x * cosine + point.y * sine));
        let potential = at_surface * fall;
        let along = C::new(0.0, k);
        (potential, Vector3::new(potential * along * cosine, potential * along * sine, at_surface * slope))
    }

    /// The part of its potential at a point of a panel that is in a symmetry class, and its derivative along the normal out of the water; the normal of the panel
    /// is into it.
    pub fn in_class(
        &self,
        (point, normal): (&Vector3<f64>, &Vector3<f64>),
        heading: f64,
        class: SymmetryClass,
        images: &[[f64; 2]],
    ) -> (C, C) {
        let mut sum = (C::default(), C::default());
        for image in images {
            let share = class.factor(*image) / images.len() as f64;
            let (potential, gradient) = self.at(&mirrored(point, *image), heading);
            let normal = -mirrored(normal, *image);
            let by_normal = gradient.x * normal.x + gradient.y * normal.y + gradient.z * normal.z;
            sum = (sum.0 + potential * share, sum.1 + by_normal * share);
        }
        sum
    }
}
