//! A section of line between two places of known elevation: the fairlead, a held buoy, the anchor.

use super::line::{LineError, Segment};
use super::segment::{Reach, hanging, lifted};

/// A run of segments with the lift (N, upward) at the joints between them.
pub struct Section<'a> {
    /// Segments, upper first.
    pub segments: &'a [Segment],
    /// Lift at the joint below each segment but the last.
    pub lifts: &'a [f64],
    /// From this segment on the bottom carries what comes down on it; the number of segments when there is none below.
    pub bottom_from: usize,
}

/// What a segment ends up with when the section is walked down.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ends {
    /// Vertical force at the upper end (N).
    pub high: f64,
    /// Vertical force at the lower end (N).
    pub low: f64,
    /// Unstretched length on the bottom (m).
    pub ground: f64,
    /// Horizontal reach (m).
    pub x: f64,
    /// Rise (m).
    pub z: f64,
}

/// How a search ended.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Search {
    /// Iterations used.
    pub iterations: usize,
    /// Vertical distance left (m).
    pub residual: f64,
}

/// Iterations after which a search gives up.
const MOST_ITERATIONS: usize = 200;

impl Section<'_> {
    /// Walks down from vertical force `top` at the upper end; `each` sees every segment.
    pub fn walk(&self, h: f64, top: f64, mut each: impl FnMut(Ends)) -> Reach {
        let mut sum = Reach::default();
        let mut high = top;
        let mut aground = false;
        for (index, segment) in self.segments.iter().enumerate() {
            let low = high - segment.weight * segment.length;
            if !aground && index >= self.bottom_from && low < 0.0 {
                let (reach, ground) = if high > 0.0 { lifted(segment, h, high) } else { grounded(segment, h) };
                sum += reach;
                each(Ends { high: high.max(0.0), low: 0.0, ground, x: reach.x, z: reach.z });
                aground = true;
                continue;
            }
            if aground {
                let (reach, ground) = grounded(segment, h);
                sum += reach;
                each(Ends { high: 0.0, low: 0.0, ground, x: reach.x, z: 0.0 });
                continue;
            }
            let reach = hanging(segment, h, low);
            sum += reach;
            each(Ends { high, low, ground: 0.0, x: reach.x, z: reach.z });
            high = low + self.lifts.get(index).copied().unwrap_or(0.0);
        }
        sum
    }

    /// The vertical force at the upper end at which the section rises by `rise` (m); the rise grows with the force.
    /// Returns the force, the reach, and how it was found.
    ///
    /// # Errors
    /// [`LineError::NotConverged`] when the rise cannot be met to 1e-12 of the length, or to what 1e-9 of the tension
    /// makes of it.
    pub fn solve(&self, h: f64, rise: f64) -> Result<(f64, Reach, Search), LineError> {
        let length: f64 = self.segments.iter().map(|s| s.length).sum();
        let weight: f64 = self.segments.iter().map(|s| s.weight * s.length).sum();
        let step = weight.abs() + h + self.lifts.iter().map(|l| l.abs()).sum::<f64>();
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let mut top = 0.5 * weight + h * (rise / length).clamp(-2.0, 2.0);
        let mut grow = step;
        let mut best = (f64::INFINITY, top, Reach::default());
        let mut iterations = 0;
        while iterations < MOST_ITERATIONS {
            iterations += 1;
            let reach = self.walk(h, top, |_| {});
            let off = reach.z - rise;
            if !off.is_finite() {
                break;
            }
            if off.abs() < best.0 {
                best = (off.abs(), top, reach);
            }
            if off == 0.0 || best.0 <= 4.0 * f64::EPSILON * (length + rise.abs()) {
                break;
            }
            if off > 0.0 {
                high = high.min(top);
            } else {
                low = low.max(top);
            }
            let newton = top - off / reach.z_v;
            let bracketed = low.is_finite() && high.is_finite();
            let next =
                if newton.is_finite() && newton > low && newton < high && (bracketed || (newton - top).abs() < grow) {
                    newton
                } else if bracketed {
                    0.5 * (low + high)
                } else {
                    grow *= 2.0;
                    if off > 0.0 { top - grow } else { top + grow }
                };
            if next == top || (bracketed && high - low <= 4.0 * f64::EPSILON * (low.abs() + high.abs())) {
                break;
            }
            top = next;
        }
        let (off, top, reach) = best;
        let tension = h.hypot(top);
        if off <= 1e-12 * length || off <= 1e-9 * tension * reach.z_v {
            return Ok((top, reach, Search { iterations, residual: off }));
        }
        Err(LineError::NotConverged { force: h, residual: off, iterations })
    }
}

/// A segment lying on the bottom from end to end.
fn grounded(segment: &Segment, h: f64) -> (Reach, f64) {
    let stretch = 1.0 + h / segment.ea;
    let reach = Reach { x: segment.length * stretch, x_h: segment.length / segment.ea, ..Reach::default() };
    (reach, segment.length)
}
