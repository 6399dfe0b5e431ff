//! Weightless straight spans of a line between points: what the tension of each exerts on them, and how that changes with their places
//! and velocities.
//!
//! A span from p to q has the length l = |q - p|, the direction n = (q - p)/l and the rate l' = n (vq - vp). Its tension T, a function of
//! the lengths and rates of all spans of the line, pulls p along n and q against it.

use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_model::{ClassError, ElementResponse, End};

/// Most spans of a line: one over two pulleys has three.
pub const MAX_SPANS: usize = 3;

/// A straight span.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TautSpan {
    /// Unit vector from its first point to its second.
    pub direction: Vector3<f64>,
    /// Its length (m).
    pub length: f64,
    /// Rate of its length (m/s).
    pub rate: f64,
    /// Velocity of the second point against the first across the span, over its length (1/s): the gradient of the rate by place.
    turning: Vector3<f64>,
}

/// The tension of a span, and how it changes with the lengths and rates of all spans.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SpanTension {
    /// Tension (N).
    pub tension: f64,
    /// Derivative by the length of each span (N/m).
    pub by_length: [f64; MAX_SPANS],
    /// Derivative by the rate of each span (N s/m).
    pub by_rate: [f64; MAX_SPANS],
}

/// The spans between consecutive ends.
///
/// # Errors
/// Fewer ends than two, two neighbouring ends in one place.
pub fn read_spans(ends: &[End]) -> Result<Vec<TautSpan>, ClassError> {
    if ends.len() < 2 {
        return Err(ClassError::new("a line has two ends").lasting());
    }
    ends.windows(2)
        .map(|pair| {
            let [first, second] = pair else { return Err(ClassError::new("a line has two ends").lasting()) };
            let chord = second.pose.origin - first.pose.origin;
            let length = chord.norm();
            if length == 0.0 {
                return Err(ClassError::new("its ends are in one place, where its tension has no direction"));
            }
            let direction = chord / length;
            let velocity = (second.velocity - first.velocity).fixed_rows::<3>(0).into_owned();
            let rate = direction.dot(&velocity);
            Ok(TautSpan { direction, length, rate, turning: (velocity - direction * rate) / length })
        })
        .collect()
}

/// The wrenches of the spans on their points with stiffness and damping, in `out`.
pub fn apply_tensions(spans: &[TautSpan], tensions: &[SpanTension], out: &mut ElementResponse) {
    let ends = spans.len() + 1;
    out.clear(ends);
    if tensions.iter().any(|t| t.by_rate.iter().any(|d| *d != 0.0)) {
        out.damping.resize(ends * ends, Matrix6::zeros());
    }
    for (own, (span, tension)) in spans.iter().zip(tensions).enumerate() {
        let n = span.direction;
        let across = (Matrix3::identity() - n * n.transpose()) * (tension.tension / span.length);
        // the pull on the first point is +T n, on the second -T n; a length grows with its second point and falls with its first
        for (row, pull) in [(own, 1.0), (own + 1, -1.0)] {
            if let Some(wrench) = out.wrench.get_mut(row) {
                let mut force = wrench.fixed_rows_mut::<3>(0);
                force += n * (pull * tension.tension);
            }
            add(&mut out.stiffness, row * ends + own, across * pull);
            add(&mut out.stiffness, row * ends + own + 1, across * -pull);
            for (index, (other, (by_length, by_rate))) in
                spans.iter().zip(tension.by_length.iter().zip(&tension.by_rate)).enumerate()
            {
                let by_place = n * (other.direction * *by_length + other.turning * *by_rate).transpose() * pull;
                let by_velocity = n * other.direction.transpose() * (pull * by_rate);
                for (column, sign) in [(index, 1.0), (index + 1, -1.0)] {
                    add(&mut out.stiffness, row * ends + column, by_place * sign);
                    add(&mut out.damping, row * ends + column, by_velocity * sign);
                }
            }
        }
    }
}

/// Adds forces over translations to a block; blocks that are not there take nothing.
fn add(blocks: &mut [Matrix6<f64>], index: usize, block: Matrix3<f64>) {
    if let Some(whole) = blocks.get_mut(index) {
        let mut part = whole.fixed_view_mut::<3, 3>(0, 0);
        part += block;
    }
}

/// Step from 0 at and below 0 to 1 at and above 1 without a kink, and its slope.
pub fn smooth_step(x: f64) -> (f64, f64) {
    let x = x.clamp(0.0, 1.0);
    (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x))
}
