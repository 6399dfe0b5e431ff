//! Linear waves added up: elevation, velocity, acceleration and pressure.
//!
//! Of a component (Faltinsen, Sea Loads on Ships and Offshore Structures, 1990, table 2.1), with q = k (toward . (x, y)) - w t + phase:
//! u = a w C cos q, w = a w S sin q, p = rho g a cosh(k(z+d))/cosh(kd) cos q; C and S are cosh and sinh of k(z+d) over sinh(kd).

use super::{Component, Kinematics, Sea};
use crate::model::Stretching;
use nalgebra::Vector3;

/// Water this deep (k d) is deep to the last digit: exp(-2 k d) < 1e-17.
const DEEP: f64 = 20.0;
/// The factor of delta stretching (Rodenbusch and Forristall 1986).
const DELTA: f64 = 0.3;

/// Components as arrays, with what does not change.
#[derive(Clone, Debug, Default)]
pub(super) struct Lanes {
    lanes: Vec<Lane>,
    /// Depth of delta stretching: two standard deviations of the surface (m).
    stretch: f64,
}

/// What does not change of one component.
#[derive(Clone, Copy, Debug)]
struct Lane {
    /// Wave number along x and y (1/m).
    kx: f64,
    ky: f64,
    /// Wave number (1/m), frequency (rad/s).
    k: f64,
    w: f64,
    toward: [f64; 2],
    /// exp(-2 k d), and tanh(k d).
    q: f64,
    tanh: f64,
}

impl Lanes {
    /// Those of components in a depth (m).
    pub(super) fn of(components: &[Component], depth: Option<f64>) -> Self {
        let lane = |c: &Component| {
            let kd = depth.map_or(f64::INFINITY, |d| c.number * d);
            let q = if kd > DEEP { 0.0 } else { (-2.0 * kd).exp() };
            let [x, y] = c.toward;
            let (k, w) = (c.number, c.frequency);
            Lane { kx: k * x, ky: k * y, k, w, toward: c.toward, q, tanh: kd.tanh() }
        };
        let variance: f64 = components.iter().map(|c| 0.5 * c.amplitude * c.amplitude).sum();
        Lanes { lanes: components.iter().map(lane).collect(), stretch: 2.0 * variance.sqrt() }
    }
}

/// A sea at one time, prepared for many places.
#[derive(Clone, Debug)]
pub struct SeaAt<'a> {
    sea: &'a Sea,
    /// The ramp's rate over its value (1/s).
    growth: f64,
    /// Amplitude, ramp in it, times cosine and sine of `phase - w t`.
    phasors: Vec<[f64; 2]>,
}

impl<'a> SeaAt<'a> {
    /// A sea at a time (s).
    pub(super) fn of(sea: &'a Sea, time: f64) -> Self {
        let mut made = SeaAt { sea, growth: 0.0, phasors: Vec::with_capacity(sea.components.len()) };
        made.move_to(time);
        made
    }

    /// Goes to another time (s), without another allocation.
    pub fn move_to(&mut self, time: f64) {
        let (factor, rate) = self.sea.factor_and_rate(time);
        self.growth = if factor > 0.0 { rate / factor } else { 0.0 };
        self.phasors.clear();
        self.phasors.extend(self.sea.components.iter().map(|c| {
            let (sin, cos) = (c.phase - c.frequency * time).sin_cos();
            [factor * c.amplitude * cos, factor * c.amplitude * sin]
        }));
    }

    /// Height of the surface above the mean level (m).
    pub fn elevation(&self, x: f64, y: f64) -> f64 {
        let waves = self.sea.lanes.lanes.iter().zip(&self.phasors);
        waves
            .map(|(lane, [c, s])| {
                let (sin, cos) = (lane.kx * x + lane.ky * y).sin_cos();
                c * cos - s * sin
            })
            .sum()
    }

    /// The water at a global place (m); nothing above the surface, but with [`Stretching::Exponential`]. Below the bottom it
    /// is as on it.
    pub fn kinematics(&self, at: Vector3<f64>) -> Kinematics {
        let sea = self.sea;
        let height = at.z - sea.level;
        match sea.stretching {
            Stretching::Exponential => self.sums(at, height, 0.0),
            Stretching::Linear => self.below(self.sums(at, height.min(0.0), height.max(0.0)), height),
            Stretching::Wheeler => {
                let elevation = self.elevation(at.x, at.y);
                if height > elevation {
                    return Kinematics::still(elevation);
                }
                // Wheeler (1970): the surface is taken for the mean level, the bottom stays
                let scale = sea.depth.map_or(1.0, |d| d / (d + elevation).max(f64::MIN_POSITIVE));
                self.sums(at, ((height - elevation) * scale).min(0.0), 0.0)
            }
            Stretching::Delta => {
                let elevation = self.elevation(at.x, at.y);
                if height > elevation {
                    return Kinematics::still(elevation);
                }
                let deep = sea.lanes.stretch;
                let mapped = if height > -deep && deep + elevation > 0.0 {
                    (height + deep) * (deep + DELTA * elevation) / (deep + elevation) - deep
                } else {
                    height
                };
                self.sums(at, mapped.min(0.0), mapped.max(0.0))
            }
        }
    }

    fn below(&self, found: Kinematics, height: f64) -> Kinematics {
        if height > found.elevation { Kinematics::still(found.elevation) } else { found }
    }

    /// The waves added up at a height over the mean level (m), and straight on by a rise above it (m).
    fn sums(&self, at: Vector3<f64>, height: f64, rise: f64) -> Kinematics {
        let sea = self.sea;
        let height = sea.depth.map_or(height, |d| height.max(-d));
        let mut velocity = Vector3::zeros();
        let mut acceleration = Vector3::zeros();
        let (mut elevation, mut pressure) = (0.0, 0.0);
        for (lane, [c, s]) in sea.lanes.lanes.iter().zip(&self.phasors) {
            let (sin, cos) = (lane.kx * at.x + lane.ky * at.y).sin_cos();
            let (a_cos, a_sin) = (c * cos - s * sin, s * cos + c * sin);
            elevation += a_cos;
            let decay = (lane.k * height).exp();
            // cosh(k(z+d)) / sinh(kd) = exp(kz) (1 + exp(-2k(z+d))) / (1 - exp(-2kd)), and so the sine
            let mirror = if lane.q > 0.0 { lane.q / (decay * decay) } else { 0.0 };
            let scale = decay / (1.0 - lane.q);
            let (cosh, sinh) = (scale * (1.0 + mirror), scale * (1.0 - mirror));
            pressure += cosh * lane.tanh * a_cos;
            let (cosh, sinh) = (cosh + rise * lane.k * sinh, sinh + rise * lane.k * cosh);
            let (along, along_rate) = (lane.w * cosh * a_cos, lane.w * lane.w * cosh * a_sin);
            let [x, y] = lane.toward;
            velocity += Vector3::new(along * x, along * y, lane.w * sinh * a_sin);
            acceleration += Vector3::new(along_rate * x, along_rate * y, -lane.w * lane.w * sinh * a_cos);
        }
        acceleration += velocity * self.growth;
        Kinematics { velocity, acceleration, pressure: pressure * sea.density * sea.gravity, elevation }
    }
}
