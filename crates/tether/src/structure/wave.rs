//! A regular wave of the second order in deep water.
//!
//! In deep water Stokes' second order has no potential of its own
//! [STOKES-1847; DEAN-DALRYMPLE-1991 11.2]: velocities are those of the first, `a w exp(kz) (cos th, sin th)` with `th = k X - w t + phase`, and the second
//! order stands in
//! - the surface, `a cos th + k a^2/2 cos 2 th`;
//! - the acceleration of the water particle, whose `u . grad u` is `k (a w)^2 exp(2kz)` upward;
//! - the pressure, `rho g a exp(kz) cos th - rho (a w)^2 exp(2kz)/2`.
//!
//! The profile goes on above the mean level as it is. It is the wave of the installed example of [AQWA-TETHER 8.2] (its `STOKES2 (D/W)`).

use nalgebra::Vector3;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_hydro::sea::{Kinematics, stokes};
use windlass_model::ClassError;

/// The wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct DeepWave {
    /// Amplitude of the first order (m).
    pub amplitude: f64,
    /// Frequency in the water (rad/s).
    pub frequency: f64,
    /// Frequency that a point at rest meets (rad/s): another than in the water where a current carries the wave.
    pub met: f64,
    /// Wave number (1/m).
    pub number: f64,
    /// Unit vector of travel, global x and y.
    pub toward: [f64; 2],
    /// Phase (rad): 0 has a crest at x = y = 0 at time 0.
    pub phase: f64,
    /// Whether the second order is counted; without it the wave is Airy's, its profile going on above the mean level.
    pub second: bool,
}

impl DeepWave {
    /// A wave of the second order with an amplitude (m), a period (s) that holds in the water, and a direction of travel (rad from +X
    /// toward +Y), with a crest at the origin at time 0, under a gravity (m/s2).
    ///
    /// # Errors
    /// A period or gravity that is no positive number; a wave that breaks (Miche).
    pub fn new(amplitude: f64, period: f64, direction: f64, gravity: f64) -> Result<Self, ClassError> {
        let sound = |value: f64| value.is_finite() && value > 0.0;
        if !(sound(period) && sound(gravity) && amplitude.is_finite() && amplitude >= 0.0 && direction.is_finite()) {
            let text = "a regular wave with an amplitude of {} and a period of {} cannot be";
            return Err(ClassError::with_values(text, &[(amplitude, Dim::Length), (period, Dim::Time)]));
        }
        let frequency = TAU / period;
        let number = frequency * frequency / gravity;
        let water = windlass_hydro::sea::Water { depth: None, level: 0.0, gravity, density: 1.0 };
        stokes::breaks(2.0 * amplitude, number, &water)?;
        let toward = [direction.cos(), direction.sin()];
        Ok(DeepWave { amplitude, frequency, met: frequency, number, toward, phase: 0.0, second: true })
    }

    /// The same on a current (m/s, global): a point at rest meets `w + k . U` [DEAN-DALRYMPLE-1991 3.5].
    pub fn on_current(self, current: Vector3<f64>) -> Self {
        let along = self.toward[0] * current.x + self.toward[1] * current.y;
        DeepWave { met: self.frequency + self.number * along, ..self }
    }

    /// The angle `th` at a place (m, global) and a time (s).
    fn angle(&self, x: f64, y: f64, time: f64) -> f64 {
        self.number * (self.toward[0] * x + self.toward[1] * y) - self.met * time + self.phase
    }

    /// Height of the surface above the mean level (m).
    pub fn elevation(&self, x: f64, y: f64, time: f64) -> f64 {
        let cos = self.angle(x, y, time).cos();
        self.surface(cos)
    }

    /// The surface (m) by the cosine of the angle.
    fn surface(&self, cos: f64) -> f64 {
        let second =
            if self.second { 0.5 * self.number * self.amplitude.powi(2) * (2.0 * cos * cos - 1.0) } else { 0.0 };
        self.amplitude * cos + second
    }

    /// The water at a place, `height` (m) being that over the mean level, of a density and under a gravity.
    pub fn kinematics(&self, at: Vector3<f64>, height: f64, time: f64, [density, gravity]: [f64; 2]) -> Kinematics {
        let (sin, cos) = self.angle(at.x, at.y, time).sin_cos();
        let decay = (self.number * height).exp();
        let speed = self.amplitude * self.frequency * decay;
        let rate = speed * self.frequency;
        let convective = if self.second { self.number * speed * speed } else { 0.0 };
        let dynamic = if self.second { 0.5 * speed * speed } else { 0.0 };
        let level = |along: f64, up: f64| Vector3::new(along * self.toward[0], along * self.toward[1], up);
        Kinematics {
            velocity: level(speed * cos, speed * sin),
            acceleration: level(rate * sin, convective - rate * cos),
            pressure: density * (gravity * self.amplitude * decay * cos - dynamic),
            elevation: self.surface(cos),
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;

    #[test]
    fn wave_matches_fenton_second_order_except_third_term() {
        // [FENTON-1985] as hydro::sea::stokes has it, at order 2 in deep water; its wave number is that of order 2 or 3, so it is taken
        let water = windlass_hydro::sea::Water { depth: None, level: 0.0, gravity: 9.81, density: 1025.0 };
        let mut own = DeepWave::new(1.0, 15.0, 0.0, 9.81).unwrap();
        let theirs = stokes::Stokes::new(2, (2.0, own.frequency), ([1.0, 0.0], 0.0), water).unwrap();
        own.number = theirs.number;
        for x in 0..20 {
            let at = Vector3::new(20.0 * f64::from(x), 0.0, -3.0);
            let (a, b) = (own.kinematics(at, at.z, 1.0, [1025.0, 9.81]), theirs.kinematics(at, 1.0));
            // k a = 0.018: the third order is 6e-6 of the first
            assert!((a.elevation - b.elevation).abs() < 1e-5, "{a:?} {b:?}");
            assert!((a.velocity - b.velocity).norm() < 1e-5 && (a.pressure - b.pressure).abs() < 0.5, "{a:?} {b:?}");
        }
    }

    #[test]
    fn wave_acceleration_matches_particle_acceleration() {
        let wave = DeepWave::new(10.0, 12.0, 0.3, 9.81).unwrap();
        let at = Vector3::new(3.0, -4.0, -7.0);
        let v = |at: Vector3<f64>, t: f64| wave.kinematics(at, at.z, t, [1025.0, 9.81]).velocity;
        let h = 1e-4;
        let mut want = (v(at, 2.0 + h) - v(at, 2.0 - h)) / (2.0 * h);
        let u = v(at, 2.0);
        for i in 0..3 {
            let mut step = Vector3::zeros();
            step[i] = h;
            want += (v(at + step, 2.0) - v(at - step, 2.0)) / (2.0 * h) * u[i];
        }
        // differences of the second order with a step of 1e-4: some 1e-9
        assert!((wave.kinematics(at, at.z, 2.0, [1025.0, 9.81]).acceleration - want).norm() < 1e-7);
    }

    #[test]
    fn breaking_wave_or_wave_without_period_is_refused() {
        assert!(DeepWave::new(15.0, 5.0, 0.0, 9.81).is_err() && DeepWave::new(1.0, 0.0, 0.0, 9.81).is_err());
    }
}
