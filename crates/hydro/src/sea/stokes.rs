//! A regular wave by Stokes' theory to the fifth order, in any depth.
//!
//! Source: [FENTON-1985 table 1]; a
//! lower order leaves out the higher powers of e = k H/2. The water has no mean Eulerian current, so the wave speed is Fenton's
//! mean speed in the frame of the wave. Crest at k X - w t + phase = 0.

use super::{Kinematics, Water};
use nalgebra::Vector3;
use windlass_base::units::Dim;
use windlass_model::ClassError;
use windlass_nonlinear::bisect;

/// Share of the length that a wave breaks at in deep water [MICHE-1944]: H = 0.142 L tanh(k d).
const MICHE_BREAKING_STEEPNESS: f64 = 0.142;
/// H L^2/d^3 up to which Stokes' series serves [HEDGES-1995].
const MAX_URSELL_NUMBER: f64 = 40.0;

/// Refuses a wave higher than it can be.
///
/// # Errors
/// A height (m) beyond Miche's limit for a wave number (1/m) in this water.
pub fn breaks(height: f64, number: f64, water: &Water) -> Result<(), ClassError> {
    let length = std::f64::consts::TAU / number;
    let limit = MICHE_BREAKING_STEEPNESS * length * water.depth.map_or(1.0, |d| (number * d).tanh());
    if height <= limit {
        return Ok(());
    }
    let text = "a wave {} high and {} long breaks: it can be {} high";
    Err(ClassError::with_values(text, &[(height, Dim::Length), (length, Dim::Length), (limit, Dim::Length)])
        .help("0.142 L tanh(k d) (Miche); give a smaller height or a longer period"))
}

/// Refuses a wave for which the series of Stokes does not serve.
fn serves(height: f64, number: f64, water: &Water) -> Result<(), ClassError> {
    let length = std::f64::consts::TAU / number;
    match water.depth {
        Some(depth) if height * length * length > MAX_URSELL_NUMBER * depth.powi(3) => {
            let text = "a wave {} high and {} long is too long for Stokes' theory in a depth of {}";
            let values = [(height, Dim::Length), (length, Dim::Length), (depth, Dim::Length)];
            Err(ClassError::with_values(text, &values).help("H L^2/d^3 may be 40; REGULAR is the linear wave"))
        }
        _ => Ok(()),
    }
}

/// Fenton's coefficients, those of the potential times cosh(j k d).
#[derive(Clone, Copy, Debug, PartialEq)]
struct Coefficients {
    /// `a[j-1]` of harmonic j: the coefficients of e^1 .. e^5.
    a: [[f64; 5]; 5],
    /// The same of the elevation.
    b: [[f64; 5]; 5],
    /// Wave speed: C0, C2, C4.
    c: [f64; 3],
    /// Bernoulli's constant: E2, E4.
    e: [f64; 2],
}

/// A polynomial of S, lowest power first.
fn poly(s: f64, coefficients: &[f64]) -> f64 {
    coefficients.iter().rev().fold(0.0, |sum, c| sum * s + c)
}

impl Coefficients {
    /// Those of k d; `None`: deep.
    fn new(kd: Option<f64>) -> Self {
        let (s, tanh) = kd.map_or((0.0, 1.0), |kd| (1.0 / (2.0 * kd).cosh(), kd.tanh()));
        let (coth, r) = (1.0 / tanh, 1.0 - s);
        let (two, four) = (3.0 + 2.0 * s, 4.0 + s);
        let fifth = 64.0 * two * four * r.powi(6);
        // cosh(jkd) over cosh(kd) or cosh(2kd) is a polynomial of 1/S: 2/S - 1, 2/S^2 - 1, 4/S^2 - 2/S - 1
        let (c3, c4, c5) = (2.0 - s, 2.0 - s * s, 4.0 - 2.0 * s - s * s);
        let a22 = 1.5 * s / (r * r);
        let a31 = coth * poly(s, &[-4.0, -20.0, 10.0, -13.0]) / (8.0 * r.powi(3));
        let a33 = coth * poly(s, &[0.0, -2.0, 11.0]) * c3 / (8.0 * r.powi(3));
        let a42 = poly(s, &[12.0, -14.0, -264.0, -45.0, -13.0]) / (24.0 * r.powi(5));
        let a44 = poly(s, &[0.0, 10.0, -174.0, 291.0, 278.0]) * c4 / (48.0 * two * r.powi(5));
        let a51 = coth * poly(s, &[-1184.0, 32.0, 13232.0, 21712.0, 20940.0, 12554.0, -500.0, -3341.0, -670.0]) / fifth;
        let a53 = coth * poly(s, &[4.0, 105.0, 198.0, -1376.0, -1302.0, -117.0, 58.0]) * c3 / (32.0 * two * r.powi(6));
        let a55 = coth * poly(s, &[0.0, -6.0, 272.0, -1552.0, 852.0, 2029.0, 430.0]) * c5 / fifth;
        let b22 = coth * (1.0 + 2.0 * s) / (2.0 * r);
        let b31 = -3.0 * poly(s, &[1.0, 3.0, 3.0, 2.0]) / (8.0 * r.powi(3));
        let b42 = coth * poly(s, &[6.0, -26.0, -182.0, -204.0, -25.0, 26.0]) / (6.0 * two * r.powi(4));
        let b44 = coth * poly(s, &[24.0, 92.0, 122.0, 66.0, 67.0, 34.0]) / (24.0 * two * r.powi(4));
        let b53 = 9.0 * poly(s, &[132.0, 17.0, -2216.0, -5897.0, -6292.0, -2687.0, 194.0, 467.0, 82.0]) / (2.0 * fifth);
        let b55 = 5.0 * poly(s, &[300.0, 1579.0, 3176.0, 2949.0, 1188.0, 675.0, 1326.0, 827.0, 130.0]) / (6.0 * fifth);
        let c0 = tanh.sqrt();
        Coefficients {
            a: [
                [coth, 0.0, a31, 0.0, a51],
                [0.0, a22, 0.0, a42, 0.0],
                [0.0, 0.0, a33, 0.0, a53],
                [0.0, 0.0, 0.0, a44, 0.0],
                [0.0, 0.0, 0.0, 0.0, a55],
            ],
            b: [
                [1.0, 0.0, b31, 0.0, -(b53 + b55)],
                [0.0, b22, 0.0, b42, 0.0],
                [0.0, 0.0, -b31, 0.0, b53],
                [0.0, 0.0, 0.0, b44, 0.0],
                [0.0, 0.0, 0.0, 0.0, b55],
            ],
            c: [
                c0,
                c0 * (2.0 + 7.0 * s * s) / (4.0 * r * r),
                c0 * poly(s, &[4.0, 32.0, -116.0, -400.0, -71.0, 146.0]) / (32.0 * r.powi(5)),
            ],
            e: [
                tanh * (2.0 + 2.0 * s + 5.0 * s * s) / (4.0 * r * r),
                tanh * poly(s, &[8.0, 12.0, -152.0, -308.0, -42.0, 77.0]) / (32.0 * r.powi(5)),
            ],
        }
    }

    /// The wave speed over sqrt(g/k), to an order.
    fn wave_speed(&self, e: f64, order: u8) -> f64 {
        let third = if order >= 3 { self.c[1] * e * e } else { 0.0 };
        let fifth = if order >= 5 { self.c[2] * e.powi(4) } else { 0.0 };
        self.c[0] + third + fifth
    }
}

/// A water particle in the plane of a wave's travel.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ParticleMotion {
    /// Along the travel of the wave and up (m/s).
    pub velocity: [f64; 2],
    /// Along the travel of the wave and up (m/s2).
    pub acceleration: [f64; 2],
}

/// Cosine and sine of an angle and of its multiples, 1 first.
fn multiples([cos, sin]: [f64; 2]) -> impl Iterator<Item = [f64; 2]> {
    std::iter::successors(Some([cos, sin]), move |[c, s]| Some([c * cos - s * sin, s * cos + c * sin]))
}

/// A Stokes wave.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stokes {
    /// Order, 1 to 5.
    pub order: u8,
    /// Height from trough to crest (m).
    pub height: f64,
    /// Wave number (1/m).
    pub number: f64,
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Unit vector of travel.
    pub toward: [f64; 2],
    /// Phase (rad).
    pub phase: f64,
    water: Water,
    /// Amplitudes of the harmonics of the elevation (m).
    surface: [f64; 5],
    /// Amplitudes of the harmonics of the horizontal velocity at the mean level (m/s).
    along: [f64; 5],
    /// What Bernoulli's equation adds to the pressure over density everywhere (m2/s2).
    constant: f64,
}

impl Stokes {
    /// The wave of a height (m) and a frequency (rad/s): its number is solved for.
    ///
    /// # Errors
    /// A wave that breaks, is too long for the theory, or has no wave number.
    pub fn new(
        order: u8,
        (height, frequency): (f64, f64),
        (toward, phase): ([f64; 2], f64),
        water: Water,
    ) -> Result<Self, ClassError> {
        let linear = super::dispersion::wave_number(frequency, water.depth, water.gravity)?;
        let at = |k: f64| Coefficients::new(water.depth.map(|d| k * d));
        let over = |k: f64| (water.gravity * k).sqrt() * at(k).wave_speed(0.5 * k * height, order) - frequency;
        breaks(height, linear, &water)?;
        serves(height, linear, &water)?;
        // a wave of finite height is faster than a small one, so it is longer
        let [low, high] = [0.2 * linear, linear * (1.0 + 1e-12)];
        if !(over(low) < 0.0 && over(high) >= 0.0) {
            let text = "no wave number was found for a Stokes wave {} high with a period of {}";
            let values = [(height, Dim::Length), (std::f64::consts::TAU / frequency, Dim::Time)];
            return Err(ClassError::with_values(text, &values).help("REGULAR is the linear wave"));
        }
        // halves until the bounds are neighbours
        let [low, high] = bisect([low, high], 120, |k| over(k) < 0.0);
        let number = 0.5 * (low + high);
        breaks(height, number, &water)?;
        serves(height, number, &water)?;
        let c = at(number);
        let e = 0.5 * number * height;
        let sum = |row: &[f64; 5]| (1..=order.clamp(1, 5)).zip(row).map(|(i, c)| c * e.powi(i32::from(i))).sum::<f64>();
        let speed = (water.gravity / number).sqrt();
        let mut along = c.a.map(|row| sum(&row) * c.c[0] * speed);
        (1u8..).zip(&mut along).for_each(|(j, u)| *u *= f64::from(j));
        let second = if order >= 2 { (c.e[0] - c.c[0] * c.c[1]) * e * e } else { 0.0 };
        let fourth = c.e[1] - c.c[0] * c.c[2] - 0.5 * c.c[1] * c.c[1];
        let fourth = if order >= 4 { fourth * e.powi(4) } else { 0.0 };
        let constant = (second + fourth) * water.gravity / number;
        let surface = c.b.map(|row| sum(&row) / number);
        Ok(Stokes { order, height, number, frequency, toward, phase, water, surface, along, constant })
    }

    fn angle(&self, x: f64, y: f64, time: f64) -> f64 {
        self.number * (self.toward[0] * x + self.toward[1] * y) - self.frequency * time + self.phase
    }

    /// Height of the surface above the mean level (m).
    pub fn elevation(&self, x: f64, y: f64, time: f64) -> f64 {
        self.elevation_at(self.angle(x, y, time))
    }

    /// Height of the surface above the mean level (m) at an angle (rad) from the crest.
    pub fn elevation_at(&self, angle: f64) -> f64 {
        (1u8..).zip(&self.surface).map(|(j, a)| a * (f64::from(j) * angle).cos()).sum()
    }

    /// Amplitudes of the velocities of harmonic `j`, along and up (m/s), at a height above the mean level (m), by that `along` it at the mean level.
    fn velocities_at_height(&self, j: f64, along: f64, z: f64) -> [f64; 2] {
        // cosh(jk(z+d)) / cosh(jkd), and so the sine, without their overflow
        let twice = -2.0 * j * self.number;
        let (near, far) = self.water.depth.map_or((0.0, 0.0), |d| ((twice * (z + d)).exp(), (twice * d).exp()));
        let scale = along * (j * self.number * z).exp() / (1.0 + far);
        [scale * (1.0 + near), scale * (1.0 - near)]
    }

    /// Height of the surface above the mean level (m) where the angle from the crest has this cosine and sine.
    pub fn elevation_of_phase(&self, phase: [f64; 2]) -> f64 {
        multiples(phase).zip(&self.surface).map(|([cos, _], a)| a * cos).sum()
    }

    /// The water particle where the angle from the crest has this cosine and sine, at a height above the mean level (m), also above the
    /// surface; below the bottom as on it. The acceleration is that of the particle: `du/dt + u . grad u`.
    pub fn particle_of_phase(&self, phase: [f64; 2], height: f64) -> ParticleMotion {
        let z = self.water.depth.map_or(height, |d| height.max(-d));
        // velocities, their rates at a place, and their slopes along the wave and up; without rotation dw/dx = du/dz, without sources
        // dw/dz = -du/dx
        let ([mut u, mut w], mut rates, [mut along_x, mut along_z]) = ([0.0; 2], [0.0; 2], [0.0; 2]);
        for ((j, [cos, sin]), along) in (1u8..).zip(multiples(phase)).zip(&self.along) {
            let j = f64::from(j);
            let [cosh, sinh] = self.velocities_at_height(j, *along, z);
            u += cosh * cos;
            w += sinh * sin;
            rates[0] += j * self.frequency * cosh * sin;
            rates[1] -= j * self.frequency * sinh * cos;
            along_x -= j * self.number * cosh * sin;
            along_z += j * self.number * sinh * cos;
        }
        ParticleMotion {
            velocity: [u, w],
            acceleration: [rates[0] + u * along_x + w * along_z, rates[1] + u * along_z - w * along_x],
        }
    }

    /// The water at a global place (m) and a time (s), also above the surface; below the bottom as on it.
    pub fn kinematics(&self, at: Vector3<f64>, time: f64) -> Kinematics {
        let angle = self.angle(at.x, at.y, time);
        let z = at.z - self.water.level;
        let z = self.water.depth.map_or(z, |d| z.max(-d));
        let [mut u, mut w, mut u_rate, mut w_rate, mut elevation] = [0.0; 5];
        for (j, (along, surface)) in (1u8..).zip(self.along.iter().zip(&self.surface)) {
            let j = f64::from(j);
            let (sin, cos) = (j * angle).sin_cos();
            elevation += surface * cos;
            let [cosh, sinh] = self.velocities_at_height(j, *along, z);
            let rate = j * self.frequency;
            u += cosh * cos;
            w += sinh * sin;
            u_rate += rate * cosh * sin;
            w_rate -= rate * sinh * cos;
        }
        let speed = self.frequency / self.number;
        let pressure = self.water.density * (speed * u - 0.5 * (u * u + w * w) + self.constant);
        let [x, y] = self.toward;
        Kinematics {
            velocity: Vector3::new(u * x, u * y, w),
            acceleration: Vector3::new(u_rate * x, u_rate * y, w_rate),
            pressure,
            elevation,
        }
    }
}

#[cfg(test)]
#[allow(clippy::unwrap_used)]
mod tests {
    use super::*;
    use crate::sea::dispersion::wave_number;

    const GRAVITY: f64 = 9.80665;

    fn water(depth: Option<f64>) -> Water {
        Water { depth, level: 0.0, gravity: GRAVITY, density: 1000.0 }
    }

    /// A wave of a steepness e = k H/2 of about this, of linear length 100 m.
    fn wave(order: u8, e: f64, depth: Option<f64>) -> Stokes {
        let k = std::f64::consts::TAU / 100.0;
        let frequency = crate::sea::dispersion::frequency(k, depth, GRAVITY);
        Stokes::new(order, (2.0 * e / k, frequency), ([1.0, 0.0], 0.0), water(depth)).unwrap()
    }

    #[test]
    fn stokes_coefficients_match_fenton_table() {
        // [FENTON-1985 table 2]: k d = 0.753982 (as quoted in the tests of AMR-Wind)
        let kd = 0.753_982f64;
        let c = Coefficients::new(Some(kd));
        let a = |i: usize, j: usize| c.a[j - 1][i - 1] / (j as f64 * kd).cosh();
        let close = |found: f64, printed: f64| {
            assert!((found - printed).abs() < 2e-5 * printed.abs().max(1.0), "{found} {printed}")
        };
        for (i, j, printed) in [
            (1, 1, 1.208490),
            (2, 2, 0.799840),
            (3, 1, -9.105340),
            (3, 3, 0.368275),
            (4, 2, -12.196150),
            (4, 4, 0.058723),
            (5, 1, 108.46831725),
            (5, 3, -6.941756),
            (5, 5, -0.074979),
        ] {
            close(a(i, j), printed);
        }
        for (i, j, printed) in [
            (2, 2, 2.502414),
            (3, 1, -5.731666),
            (4, 2, -32.407508),
            (4, 4, 14.033758),
            (5, 3, -103.44536875),
            (5, 5, 37.200027),
        ] {
            close(c.b[j - 1][i - 1], printed);
        }
        let printed = [0.798448, 1.940215, -12.970403, 1.781926, -11.573657];
        [c.c[0], c.c[1], c.c[2], c.e[0], c.e[1]].into_iter().zip(printed).for_each(|(f, p)| close(f, p));
    }

    #[test]
    fn stokes_height_is_exact_and_mean_level_is_kept() {
        for order in 1..=5 {
            for depth in [None, Some(20.0)] {
                let wave = wave(order, 0.15, depth);
                let crest = wave.elevation_at(0.0) - wave.elevation_at(std::f64::consts::PI);
                assert!((crest / wave.height - 1.0).abs() < 1e-12, "{order}");
                let mean: f64 = (0..64).map(|i| wave.elevation_at(f64::from(i) * std::f64::consts::TAU / 64.0)).sum();
                assert!(mean.abs() < 1e-10);
            }
        }
    }

    /// The largest error of a wave in its conditions at the surface, in its own units: no pressure, and water stays in it.
    fn residuals(wave: &Stokes) -> [f64; 2] {
        let speed = wave.frequency / wave.number;
        let mut worst = [0.0f64; 2];
        for i in 0..200 {
            let angle = f64::from(i) * std::f64::consts::TAU / 200.0;
            let (zeta, x) = (wave.elevation_at(angle), angle / wave.number);
            let found = wave.kinematics(Vector3::new(x, 0.0, zeta), 0.0);
            let h = 1e-5;
            let slope = wave.number * (wave.elevation_at(angle + h) - wave.elevation_at(angle - h)) / (2.0 * h);
            let through = found.velocity.z - (found.velocity.x - speed) * slope;
            let pressure = found.pressure / 1000.0 - GRAVITY * zeta;
            for (worst, now) in worst.iter_mut().zip([through / speed, pressure / (speed * speed)]) {
                *worst = worst.max(now.abs());
            }
        }
        worst
    }

    #[test]
    fn surface_errors_fall_with_steepness_above_the_order() {
        for depth in [None, Some(60.0), Some(20.0)] {
            for order in 1..=5u8 {
                let (steep, mild) = (residuals(&wave(order, 0.04, depth)), residuals(&wave(order, 0.02, depth)));
                for (kind, (a, b)) in steep.into_iter().zip(mild).enumerate() {
                    let power = (a / b).log2();
                    // a power less a third, for the terms of still higher order in shallow water
                    assert!(
                        power > f64::from(order) + 1.0 - 0.35,
                        "{depth:?} order {order} condition {kind}: {power} {a}"
                    );
                }
            }
        }
    }

    #[test]
    fn steep_deep_water_wave_matches_exact_speed_and_crest() {
        // c^2 k/g = 1 + e^2 + e^4/2 + .. with e = k H/2 [FENTON-1985; STOKES-1847], k eta at the crest e + e^2/2 + ..
        let wave = wave(5, 0.25, None);
        let e = 0.5 * wave.number * wave.height;
        let square = wave.frequency * wave.frequency / (GRAVITY * wave.number);
        assert!((square - (1.0 + e * e + 0.5 * e.powi(4))).abs() < e.powi(6), "{square}");
        let crest = wave.number * wave.elevation_at(0.0);
        assert!((crest - (e + e * e / 2.0 + (1.0 / 3.0 + 1.0 / 3.0) * e.powi(4))).abs() < 1e-12, "{crest}");
        // small waves are Airy's
        let small = super::tests::wave(5, 1e-4, Some(30.0));
        assert!((small.number / wave_number(small.frequency, Some(30.0), GRAVITY).unwrap() - 1.0).abs() < 1e-7);
    }

    #[test]
    fn velocity_derivative_matches_acceleration_and_euler_pressure() {
        for depth in [None, Some(20.0)] {
            let wave = wave(5, 0.15, depth);
            let (at, time, h) = (Vector3::new(7.0, 3.0, -2.0), 4.0, 1e-4);
            let v = |at: Vector3<f64>, time: f64| wave.kinematics(at, time).velocity;
            let rate = (v(at, time + h) - v(at, time - h)) / (2.0 * h);
            let found = wave.kinematics(at, time);
            assert!((rate - found.acceleration).norm() < 1e-7);
            let slope = |i: usize| {
                let mut step = Vector3::zeros();
                step[i] = h;
                let p =
                    (wave.kinematics(at + step, time).pressure - wave.kinematics(at - step, time).pressure) / (2.0 * h);
                (p, (v(at + step, time) - v(at - step, time)) / (2.0 * h))
            };
            let convective = slope(0).1 * found.velocity.x + slope(2).1 * found.velocity.z;
            for i in [0, 2] {
                assert!((slope(i).0 / 1000.0 + found.acceleration[i] + convective[i]).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn wave_too_steep_or_too_long_is_refused() {
        let of = |height, period: f64, depth| {
            Stokes::new(5, (height, std::f64::consts::TAU / period), ([1.0, 0.0], 0.0), water(depth))
        };
        assert!(of(25.0, 10.0, None).unwrap_err().to_string().contains("breaks"));
        assert!(of(2.0, 20.0, Some(5.0)).unwrap_err().to_string().contains("too long"));
        assert!(of(15.0, 15.0, Some(500.0)).is_ok());
    }
}
