//! What a rested chain means: the state of the line, proven.

use super::element::{LinePiece, stretch};
use super::error::LineError;
use super::line::{Joint, Line, Segment};
use super::multi_segment::{JointStatus, LineSolution, SegmentSolution};
use super::segment::hanging;
use super::solve::RESIDUAL_TOLERANCE;
use super::state::{Buoy, JointState, LineState, SegmentState};

impl Line {
    /// The state of a rested chain; `wanted` is the distance that was asked for, if one was.
    pub(super) fn state(
        &self,
        rested: LineSolution,
        wanted: Option<f64>,
        fairlead: f64,
    ) -> Result<LineState, LineError> {
        let (Some(first), Some(last)) = (rested.held.first().copied(), rested.held.last().copied()) else {
            return Err(LineError::Empty);
        };
        let least = self.chain.least.min(first.h);
        let [x_h, _] = rested.x_by;
        let [v_h, v_z] = rested.v_by;
        let mut force = (first.h, first.v_hi);
        let mut far = (last.h, last.v_lo);
        let scale = force.0.hypot(force.1).max(far.0.hypot(far.1));
        let off = wanted.map_or(0.0, |x| rested.x - x);
        // the least force already reaches so far: no horizontal force at all
        let slack = wanted.is_some() && first.h <= 4.0 * least && off >= 0.0;
        let residual = if slack { 0.0 } else { (off / x_h).abs() * (1.0 + v_h.abs()) };
        let fine = 4.0 * f64::EPSILON * (self.length() + rested.x.abs());
        if !(residual <= RESIDUAL_TOLERANCE * scale || off.abs() <= fine) {
            return Err(LineError::Unproven { residual, tension: scale });
        }
        let loose = |h: &SegmentSolution| h.ground > 0.0 || (h.v_hi > 0.0 && h.v_lo < 0.0);
        let mut stiffness = by_place(rested.x_by, [1.0, 0.0], rested.v_by);
        let mut coupling = by_place(rested.x_by, rested.far_h_by, rested.far_v_by);
        if slack {
            if self.weightless() && off > 1e-9 * (self.length() + rested.x.abs()) {
                return Err(LineError::Undetermined);
            }
            (force, far) = (without_least_tension(force, least), without_least_tension(far, least));
            if rested.held.iter().any(loose) {
                stiffness = [[0.0, 0.0], [0.0, v_z]];
                // between two legs the far one does not feel the near one; free, both carry
                let [_, far] = rested.far_v_by;
                coupling = [[0.0, 0.0], [0.0, far]];
            }
        }
        let positions = self.positions(&rested, wanted, fairlead);
        let x = wanted.unwrap_or_else(|| positions.last().map_or(0.0, |p| p.0));
        let segments = self.segment_states(&rested, slack.then_some(least));
        let state = LineState {
            force: force.0,
            x,
            dx_dh: x_h,
            top_vertical: force.1,
            top_tension: force.0.hypot(force.1),
            anchor_horizontal: far.0,
            anchor_vertical: far.1,
            stiffness,
            coupling,
            grounded: segments.iter().map(|s| s.grounded).sum(),
            grounded_stretched: rested.held.iter().map(|h| h.ground_stretched).sum(),
            touchdown: self.touchdown(&rested, &positions),
            joints: self.joint_states(&rested, &positions),
            below_bottom: self.below_bottom(&rested),
            above_surface: self.above_surface(&rested, &positions),
            segments,
            slack,
            heap: None,
            iterations: rested.iterations,
            residual,
            unbalance: rested.unbalance,
            positions,
            rested,
            laid: None,
        };
        if !state.is_finite() {
            return Err(LineError::NotConverged { force: force.0, residual: f64::NAN, iterations: state.iterations });
        }
        Ok(state)
    }

    /// Whether nothing pulls the line down or up.
    pub(super) fn weightless(&self) -> bool {
        self.chain.elements.iter().all(|e| e.weight() == 0.0) && self.chain.pulls.iter().all(|p| p.lift == 0.0)
    }

    /// Ends of the pieces: distance from the fairlead and elevation (m).
    fn positions(&self, rested: &LineSolution, x: Option<f64>, fairlead: f64) -> Vec<(f64, f64)> {
        // a slack line lies straight from the anchor, what is too long in a heap at the touchdown
        let mut lies = x.unwrap_or(f64::INFINITY);
        lies -= rested.held.iter().map(|h| h.upper.x + h.lower.x).sum::<f64>();
        let mut at = 0.0;
        let mut positions: Vec<(f64, f64)> = Vec::with_capacity(rested.z.len());
        for (i, z) in rested.z.iter().enumerate().rev() {
            positions.push((at, *z));
            if let Some(held) = i.checked_sub(1).and_then(|i| rested.held.get(i)) {
                let legs = held.upper.x + held.lower.x;
                let rest = (held.x - legs).min(lies.max(0.0));
                lies -= rest;
                at += legs + rest;
            }
        }
        positions.reverse();
        let x = x.unwrap_or(at);
        let count = positions.len();
        let position = |(i, (at, z)): (usize, (f64, f64))| match i {
            0 => (0.0, fairlead),
            i if i + 1 == count => (x, self.anchor),
            _ => (x - at, z + self.datum()),
        };
        positions.into_iter().enumerate().map(position).collect()
    }

    /// The rested lengths of line, without the springs at the ends.
    pub(super) fn lengths<'a>(
        &'a self,
        rested: &'a LineSolution,
    ) -> impl Iterator<Item = (usize, &'a LinePiece, &'a SegmentSolution)> {
        let parts = self.chain.elements.iter().zip(&rested.held).enumerate();
        parts.filter(|(_, (e, _))| matches!(e, LinePiece::Length { .. })).map(|(i, (e, h))| (i, e, h))
    }

    fn segment_states(&self, rested: &LineSolution, slack: Option<f64>) -> Vec<SegmentState> {
        self.lengths(rested)
            .map(|(_, _, h)| {
                let clean = |force: (f64, f64)| slack.map_or(force, |least| without_least_tension(force, least));
                let (top, bottom) = (clean((h.h, h.v_hi)), clean((h.h, h.v_lo)));
                SegmentState {
                    top_tension: top.0.hypot(top.1),
                    bottom_tension: bottom.0.hypot(bottom.1),
                    top_horizontal: top.0,
                    bottom_horizontal: bottom.0,
                    top_vertical: top.1,
                    bottom_vertical: bottom.1,
                    grounded: h.ground,
                }
            })
            .collect()
    }

    fn joint_states(&self, rested: &LineSolution, positions: &[(f64, f64)]) -> Vec<JointState> {
        let first = self.first_joint();
        let state = |(j, joint): (usize, &Joint)| {
            let at = j + first;
            let (x, z) = positions[at + 1];
            let (lift, reaction) = (rested.lifts[at], rested.reactions[at].max(0.0));
            let buoy = match (joint, rested.policy.stands.get(at)) {
                (Joint::SpringBuoy { .. } | Joint::Buoy { .. }, Some(stand)) => Some(match stand {
                    JointStatus::Free(0) | JointStatus::Bottom => Buoy::Sunk,
                    JointStatus::Free(_) => Buoy::Slack,
                    JointStatus::Step(_) => Buoy::Held,
                }),
                _ => None,
            };
            // what the line feels of a clump that the bottom carries
            let lift = if matches!(joint, Joint::Weight(_)) { lift + reaction } else { lift };
            JointState { x, z, lift, reaction, buoy }
        };
        self.joints.iter().enumerate().map(state).collect()
    }

    /// Where the line, seen from the fairlead, first meets the bottom: distance from the fairlead and elevation (m).
    fn touchdown(&self, rested: &LineSolution, positions: &[(f64, f64)]) -> Option<(f64, f64)> {
        let (index, element, held) = self.lengths(rested).find(|(_, _, h)| h.ground > 0.0)?;
        let LinePiece::Length { segment, law, .. } = element else { return None };
        let (x, z) = positions.get(index).copied()?;
        if held.above == 0.0 {
            return Some((x, z));
        }
        let leg = stretch(segment, law.as_ref(), held.above, held.h, 0.0);
        Some((x + leg.x, z - leg.z))
    }

    /// Segments that do not see the bottom and hang below it, with how far (m).
    fn below_bottom(&self, rested: &LineSolution) -> Vec<(usize, f64)> {
        if self.floor.is_none() {
            return Vec::new();
        }
        let scale = 1e-9 * (self.length() + self.anchor.abs());
        let mut list = Vec::new();
        for (number, (index, element, held)) in self.lengths(rested).enumerate() {
            let LinePiece::Length { segment, law, sees_bottom: false } = element else { continue };
            let (high, low) = (rested.z[index], rested.z[index + 1]);
            let mut lowest = high.min(low);
            if held.v_lo < 0.0 && held.v_hi > 0.0 && segment.weight > 0.0 {
                let s = -held.v_lo / segment.weight;
                lowest = low + stretch(segment, law.as_ref(), s, held.h, held.v_lo).z;
            }
            if lowest < -scale {
                list.push((number + 1, -lowest));
            }
        }
        list
    }

    /// Buoyant segments, and segments that begin at a buoyant joint, that rise above the water surface, with how far
    /// (m).
    fn above_surface(&self, rested: &LineSolution, positions: &[(f64, f64)]) -> Vec<(usize, f64)> {
        let scale = 1e-9 * (self.length() + self.anchor.abs());
        let mut list = Vec::new();
        for (number, (index, element, held)) in self.lengths(rested).enumerate() {
            let LinePiece::Length { segment, .. } = element else { continue };
            let (_, low) = positions[index + 1];
            let lifted = self.joints.get(number).is_some_and(|j| matches!(j, Joint::Weight(w) if *w < 0.0));
            let mut highest = if lifted { low } else { f64::NEG_INFINITY };
            if segment.weight < 0.0 {
                highest = highest.max(low);
                if held.v_lo > 0.0 && held.v_hi < 0.0 {
                    let part = Segment { length: -held.v_lo / segment.weight, ..*segment };
                    highest = highest.max(low + hanging(&part, held.h, held.v_lo).z);
                }
            }
            if highest > self.surface + scale {
                list.push((number + 1, highest - self.surface));
            }
        }
        list
    }
}

/// H and V of a slack line, solved with the least tension: without what that is.
fn without_least_tension((h, v): (f64, f64), least: f64) -> (f64, f64) {
    if h.hypot(v) <= 64.0 * least {
        (0.0, 0.0)
    } else if h.abs() <= 64.0 * least {
        (0.0, v)
    } else {
        (h, v)
    }
}

/// d(H, V)/d(x, z of the fairlead) of forces whose derivatives by the horizontal force and the height at the fairlead are
/// `h_by` and `v_by`; `x_by` those of the reach.
fn by_place([x_h, x_z]: [f64; 2], h_by: [f64; 2], v_by: [f64; 2]) -> [[f64; 2]; 2] {
    [h_by, v_by].map(|[by_h, by_z]| [by_h / x_h, by_z - by_h * x_z / x_h])
}
