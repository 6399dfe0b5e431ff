//! The low-frequency part of a signal, and the low-frequency place and heading of a body.
//!
//! Linear wave theory has first-order forces about the mean place and heading of a body. In time that mean is what a causal filter leaves of the
//! place and heading; the first-order motion about it is not part of it. In the phase of the waves, or in the axes of the forces, that motion
//! would make products of two first-order quantities: a mean force that no theory has, as its companions are missing.
//!
//! The filter is an inverse Chebyshev filter of the fifth order, 60 dB [PARKS-BURRUS-1987 7.2], with a zero that
//! takes away its lag at constant speed. Of a sine it leaves 0.7 % at the dividing period T and at most 4 % below; one of 10 T comes through within
//! 25 %, of 20 T within 6 %, a constant speed exactly. In between, motions of 2 to 5 T count up to two and a half times.

use super::body_load::BodyStep;
use super::sea::Sea;
use nalgebra::{Complex, Matrix3, Rotation3, UnitQuaternion, Vector2, Vector3};
use std::f64::consts::{PI, TAU};
use windlass_base::pose::{Pose, Six};
use windlass_model::Model;

/// Poles and residues over the frequency of the dividing period, those of pairs twice, and what goes through at once: scipy's
/// `z, p, k = cheby2(5, 60, 1, analog=True, output='zpk')` times `1 + lag s`, lag = sum(-1/p) + sum(1/z), one at s = 0, in partial fractions.
const POLES: [Complex<f64>; 3] = [
    Complex::new(-0.459_307_864_878_345, 0.0),
    Complex::new(-0.346_344_168_127_635_6, 0.276_907_350_992_985_47),
    Complex::new(-0.119_190_236_938_464_02, 0.403_673_471_633_411_5),
];
const RESIDUES: [Complex<f64>; 3] = [
    Complex::new(-1.834_208_054_058_505_5, 0.0),
    Complex::new(2.687_878_320_690_456_4, -0.103_656_624_706_494_59),
    Complex::new(-0.897_650_001_127_465_8, -0.299_201_707_195_963_6),
];
const DIRECT_GAIN: f64 = 0.035_227_674_540_170_55;

/// The share of a sea's energy that has longer periods than the dividing period.
const LONGER_WAVES: f64 = 0.01;
/// The frequency of the first zero of the filter over that of the dividing period: 1/cos(pi/10).
const FIRST_ZERO: f64 = 1.051_462_224_238_267;
/// The dividing period where there are no waves (s).
const CALM_DIVIDING_PERIOD_S: f64 = 15.0;

/// The dividing period of a model (s): as `TDOM -DIVIDING` gives it, else [`dividing_period_of`].
pub fn dividing_period(model: &Model, sea: Option<&Sea>) -> f64 {
    model.parameters.dividing.unwrap_or_else(|| dividing_period_of(sea))
}

/// The dividing period where none is given (s): 1.05 times that above which a hundredth of the energy of the sea is, so that the first zero of the
/// filter is there; 15 s without waves.
pub fn dividing_period_of(sea: Option<&Sea>) -> f64 {
    let mut list: Vec<(f64, f64)> =
        sea.iter().flat_map(|s| &s.components).map(|c| (c.frequency, c.amplitude * c.amplitude)).collect();
    list.sort_by(|a, b| a.0.total_cmp(&b.0));
    let whole: f64 = list.iter().map(|c| c.1).sum();
    let mut sum = 0.0;
    let found = list.into_iter().find(|(_, energy)| {
        sum += energy;
        sum > LONGER_WAVES * whole
    });
    found.map_or(CALM_DIVIDING_PERIOD_S, |(frequency, _)| FIRST_ZERO * TAU / frequency)
}

/// The filter of one signal.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowPass {
    /// Frequency of the dividing period (rad/s).
    frequency: f64,
}

impl LowPass {
    /// Number of values it remembers: the signal at the end of the last step, and the three modes there.
    pub const STATES: usize = 7;

    /// That of a dividing period (s).
    pub fn new(dividing: f64) -> Self {
        LowPass { frequency: TAU / dividing }
    }

    /// The state after a signal that has always had one value, in the unit of the signal.
    pub fn at_rest(value: f64) -> [f64; Self::STATES] {
        let [a, b, c] = POLES.map(|pole| -value / pole);
        [value, a.re, a.im, b.re, b.im, c.re, c.im]
    }

    /// Goes on over a step (s), over which the signal goes straight to a value. Exact for such a signal.
    pub fn advance(&self, value: f64, dt: f64, state: &mut [f64; Self::STATES]) {
        if dt <= 0.0 {
            return;
        }
        let step = self.frequency * dt;
        let [before, modes @ ..] = state;
        let (modes, _) = modes.as_chunks_mut::<2>();
        for (mode, pole) in modes.iter_mut().zip(POLES) {
            // y' = pole y + u
            let [whole, share] = integrals(pole * step);
            let old = Complex::new(mode[0], mode[1]);
            let now = (pole * step).exp() * old + (whole * *before + share * (value - *before)) * step;
            *mode = [now.re, now.im];
        }
        *before = value;
    }

    /// The low-frequency part of the signal, in the signal's unit.
    pub fn low_frequency_part(state: &[f64; Self::STATES]) -> f64 {
        let [value, a, _, b, bi, c, ci] = state;
        let [first, second, third] = RESIDUES;
        DIRECT_GAIN * value + first.re * a + (second.re * b - second.im * bi) + (third.re * c - third.im * ci)
    }
}

/// `int_0^1 exp(z (1 - x)) dx` and the same of `x exp(z (1 - x))`.
fn integrals(z: Complex<f64>) -> [Complex<f64>; 2] {
    if z.norm() > 0.3 {
        let first = (z.exp() - 1.0) / z;
        return [first, (first - 1.0) / z];
    }
    let (mut term, mut sums) = (Complex::new(1.0, 0.0), [Complex::new(0.0, 0.0); 2]);
    for n in 1..12 {
        // z^(n-1)/n! and z^(n-1)/(n+1)!
        term /= f64::from(n);
        sums[0] += term;
        sums[1] += term / f64::from(n + 1);
        term *= z;
    }
    sums
}

/// Finds what is slow of a wrench, in a state of [`SlowWrench::STATES`] values that begins with zeros.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SlowWrench {
    filter: LowPass,
}

impl SlowWrench {
    /// Number of values it remembers.
    pub const STATES: usize = 6 * LowPass::STATES;

    /// With a dividing period (s).
    pub fn new(dividing: f64) -> Self {
        SlowWrench { filter: LowPass::new(dividing) }
    }

    /// A step (s) is accepted with a wrench at its end.
    pub fn commit(&self, wrench: &Six, dt: f64, state: &mut [f64]) {
        let (signals, _) = state.as_chunks_mut::<{ LowPass::STATES }>();
        for (signal, value) in signals.iter_mut().zip(wrench.iter()) {
            self.filter.advance(*value, dt, signal);
        }
    }

    /// What was slow of it at the end of the last step.
    pub fn low_frequency_part(state: &[f64]) -> Six {
        let (signals, _) = state.as_chunks::<{ LowPass::STATES }>();
        Six::from_iterator(signals.iter().map(LowPass::low_frequency_part).chain([0.0; 6]).take(6))
    }
}

/// Where a body is but for its first-order motion.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct LowFrequencyPosition {
    /// Its origin on the plan (m, global).
    pub origin: Vector2<f64>,
    /// Where its x axis points on the plan (rad).
    pub heading: f64,
}

impl LowFrequencyPosition {
    /// A body without first-order motion in a pose.
    pub fn at_rest(pose: &Pose) -> Self {
        LowFrequencyPosition { origin: pose.origin.xy(), heading: crate::heading_of(pose) }
    }

    /// Axes of the heading: x along it, z upward.
    pub fn axes(&self) -> Matrix3<f64> {
        let (sin, cos) = self.heading.sin_cos();
        Matrix3::new(cos, -sin, 0.0, sin, cos, 0.0, 0.0, 0.0, 1.0)
    }

    /// The small rotation by which a body in these axes (body to global) is turned from those of the heading: its rotation vector (rad), in
    /// axes of the
    /// heading.
    pub fn rotation(&self, axes: &Matrix3<f64>) -> Vector3<f64> {
        UnitQuaternion::from(Rotation3::from_matrix_unchecked(self.axes().transpose() * axes)).scaled_axis()
    }

    /// What gives of a rate of rotation (global axes) the rates of [`LowFrequencyPosition::rotation`] at a heading that stays. The mean of
    /// such rates over whole periods
    /// is nothing, where that of the rate of rotation is not: an axis that goes round a cone turns the body.
    pub fn rates(&self, axes: &Matrix3<f64>) -> Matrix3<f64> {
        let turned = self.rotation(axes);
        let (angle, cross) = (turned.norm(), turned.cross_matrix());
        // the inverse of the left Jacobian of rotations; the factor is 1/12 at none
        let factor =
            if angle < 1e-3 { 1.0 / 12.0 } else { (1.0 - 0.5 * angle / (0.5 * angle).tan()) / (angle * angle) };
        (Matrix3::identity() - cross * 0.5 + cross * cross * factor) * self.axes().transpose()
    }
}

/// Follows the low-frequency place and heading of a body, in a state of [`LowFrequency::STATES`] values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowFrequency {
    filter: LowPass,
}

impl LowFrequency {
    /// Number of values it remembers: whether a step has been accepted, and the filters of x, y and heading.
    pub const STATES: usize = 1 + 3 * LowPass::STATES;

    /// With a dividing period (s).
    pub fn new(dividing: f64) -> Self {
        LowFrequency { filter: LowPass::new(dividing) }
    }

    /// Where the body will be at the end of the step from a state to a pose expected. Before the first step it is taken to have been there
    /// always.
    pub fn predict(&self, at: &BodyStep, state: &mut [f64]) -> LowFrequencyPosition {
        if let [started, signals @ ..] = state
            && *started == 0.0
        {
            let LowFrequencyPosition { origin, heading } = LowFrequencyPosition::at_rest(at.pose);
            for (own, value) in signals.chunks_exact_mut(LowPass::STATES).zip([origin.x, origin.y, heading]) {
                own.copy_from_slice(&LowPass::at_rest(value));
            }
        }
        self.advance_filters(at, state).1
    }

    /// The step is accepted with its end there.
    pub fn commit(&self, at: &BodyStep, state: &mut [f64]) {
        let signals = self.advance_filters(at, state).0;
        if let [started, own @ ..] = state {
            *started = 1.0;
            own.iter_mut().zip(signals.as_flattened()).for_each(|(own, now)| *own = *now);
        }
    }

    fn advance_filters(&self, at: &BodyStep, state: &[f64]) -> ([[f64; LowPass::STATES]; 3], LowFrequencyPosition) {
        let mut signals = [[0.0; LowPass::STATES]; 3];
        let kept = &state[1..];
        signals.as_flattened_mut().iter_mut().zip(kept).for_each(|(signal, kept)| *signal = *kept);
        let LowFrequencyPosition { origin, heading } = LowFrequencyPosition::at_rest(at.pose);
        // a heading goes on without a jump
        let heading = signals[2][0] + (heading - signals[2][0] + PI).rem_euclid(TAU) - PI;
        for (signal, value) in signals.iter_mut().zip([origin.x, origin.y, heading]) {
            self.filter.advance(value, at.dt, signal);
        }
        let [x, y, heading] = signals.map(|s| LowPass::low_frequency_part(&s));
        (signals, LowFrequencyPosition { origin: Vector2::new(x, y), heading })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is left of a sine of a period (s), with steps of a length (s): in phase, and ahead by a quarter.
    fn gain_of_sine(dividing: f64, period: f64, dt: f64) -> Complex<f64> {
        let filter = LowPass::new(dividing);
        let mut state = LowPass::at_rest(0.0);
        let count = (period / dt).round() as usize;
        let settled = (20.0 * dividing / period).ceil() as usize * count;
        let mut sum = Complex::new(0.0, 0.0);
        for n in 1..=settled + count {
            let angle = TAU * n as f64 / count as f64;
            filter.advance(angle.cos(), dt, &mut state);
            if n > settled {
                sum += LowPass::low_frequency_part(&state) * Complex::from_polar(1.0, -angle) * (2.0 / count as f64);
            }
        }
        sum
    }

    #[test]
    fn filtered_sines_match_transfer_function() {
        // scipy: |H| and |1 - H| of the filter at the dividing period over the period
        for (times, whole, off) in [
            (0.5, 0.007063, 0.994294),
            (1.0, 0.007116, 0.998004),
            (3.0, 2.446673, 2.626557),
            (10.0, 1.223272, 0.248002),
        ] {
            let got = gain_of_sine(12.0, 12.0 * times, 0.02);
            // a straight signal between steps errs by (w h)^2/12: 4e-5 of the shortest
            assert!((got.norm() - whole).abs() < 1e-4 && ((1.0 - got).norm() - off).abs() < 1e-4, "{times}: {got}");
        }
    }

    #[test]
    fn constant_speed_is_followed_without_lag_at_any_step() {
        let filter = LowPass::new(12.0);
        let mut state = LowPass::at_rest(0.0);
        let mut time = 0.0;
        for n in 0..4000 {
            let dt = [0.05, 0.4, 2.3][n % 3];
            time += dt;
            filter.advance(2.0 * time, dt, &mut state);
        }
        assert!((LowPass::low_frequency_part(&state) - 2.0 * time).abs() < 1e-9 * time);
    }

    #[test]
    fn filtered_heading_is_continuous_through_half_turn() {
        let slow = LowFrequency::new(10.0);
        let mut state = [0.0; LowFrequency::STATES];
        let mut found = LowFrequencyPosition::default();
        for n in 0..4000 {
            let time = 0.1 * f64::from(n);
            let axes = LowFrequencyPosition { heading: 0.05 * time, ..LowFrequencyPosition::default() }.axes();
            let pose = Pose { origin: Vector3::new(time, -time, 3.0), axes };
            let velocity = Six::zeros();
            let at = BodyStep { time, dt: if n == 0 { 0.0 } else { 0.1 }, pose: &pose, velocity: &velocity };
            found = slow.predict(&at, &mut state);
            if n > 0 {
                slow.commit(&at, &mut state);
            }
        }
        assert!((found.heading - 0.05 * 399.9).abs() < 1e-6 && (found.origin.y + 399.9).abs() < 1e-6, "{found:?}");
    }

    #[test]
    fn small_rotation_rates_match_finite_differences() {
        let slow = LowFrequencyPosition { heading: 0.7, ..LowFrequencyPosition::default() };
        let turned = |angle: Vector3<f64>| slow.axes() * Rotation3::new(angle).matrix();
        for angle in [Vector3::new(0.3, -0.2, 0.4), Vector3::new(1e-4, 0.0, -2e-4), Vector3::zeros()] {
            let rates = slow.rates(&turned(angle));
            for n in 0..3 {
                let by = Vector3::ith(n, 1e-6);
                // d(R)/dt R^T = [rate of rotation x]
                let spin = (turned(angle + by) - turned(angle - by)) / 2e-6 * turned(angle).transpose();
                let rate = Vector3::new(spin.m32, spin.m13, spin.m21);
                assert!((rates * rate - Vector3::ith(n, 1.0)).norm() < 1e-8, "{angle}: {}", rates * rate);
            }
        }
    }
}
