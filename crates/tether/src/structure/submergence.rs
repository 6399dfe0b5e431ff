//! How much of a straight member is under the surface as it is, by the crossing of its axis.

use super::flow::FlowAt;
use nalgebra::Vector3;
use windlass_nonlinear::{BracketedRoot, Halvings};

/// Evaluations of the surface to find the crossing: it is smooth along a member, some five serve.
const MAX_CROSSING_ITERATIONS: usize = 60;
/// Share of a member within which the crossing is found.
const CROSSING_TOLERANCE: f64 = 1e-13;

/// The wet part of a member.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct WetPart {
    /// Its end that is under water (m, global); the first of the two where both are.
    pub from: Vector3<f64>,
    /// Unit vector along the axis, away from there.
    pub axis: Vector3<f64>,
    /// Length of the whole member (m).
    pub length: f64,
    /// Share of the length that is wet.
    pub share: f64,
}

impl WetPart {
    /// The wet part of a member between two ends (m, global); `None`: dry. A surface that crosses the axis more than once is taken at one
    /// of the crossings: members are short of half a wave.
    pub fn new([first, second]: [Vector3<f64>; 2], water: &FlowAt) -> Option<Self> {
        let above = |at: Vector3<f64>| at.z - water.surface(at.x, at.y);
        let (low, high) = (above(first), above(second));
        let (from, to, dry) = match (low < 0.0, high < 0.0) {
            (false, false) => return None,
            (true, true) => (first, second, None),
            (true, false) => (first, second, Some([low, high])),
            (false, true) => (second, first, Some([high, low])),
        };
        let length = (to - from).norm();
        let axis = (to - from).try_normalize(0.0)?;
        let share = dry.map_or(1.0, |ends| crossing(ends, |x| above(from + (to - from) * x)));
        Some(WetPart { from, axis, length, share })
    }

    /// Length that is wet (m).
    pub fn wet(&self) -> f64 {
        self.length * self.share
    }

    /// The point at a share of the whole length (m, global).
    pub fn point(&self, share: f64) -> Vector3<f64> {
        self.from + self.axis * (self.length * share)
    }
}

/// Where a function passes through zero between 0 and 1, of which `ends` are its values: below zero at 0 and not below at 1.
fn crossing(ends: [f64; 2], value: impl Fn(f64) -> f64) -> f64 {
    let mut search = BracketedRoot::new([0.0, 1.0], ends, Halvings::Never);
    for _ in 0..MAX_CROSSING_ITERATIONS {
        let Some(share) = search.propose() else { break };
        let closed = search.width() < CROSSING_TOLERANCE;
        search.record(share, value(share));
        if closed {
            break;
        }
    }
    search.best().0
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn surface_crossing_is_found_to_rounding() {
        let f = |x: f64| x.powi(5) - 0.3;
        assert!((crossing([-0.3, 0.7], f) - 0.3f64.powf(0.2)).abs() < 1e-13);
        assert_eq!(crossing([-1.0, 0.0], |x| x - 1.0), 1.0);
    }
}
