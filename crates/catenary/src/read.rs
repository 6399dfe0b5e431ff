//! What a rested chain means: the state of the line, proven.

use super::chain::{Held, Rested, Stand};
use super::element::{Element, Tilt, stretch};
use super::line::{Joint, Line, Segment};
use super::refused::LineError;
use super::segment::hanging;
use super::solve::PROOF;
use super::state::{Buoy, JointState, SegmentState, State};

impl Line {
    /// The state of a rested chain; `wanted` is the distance and the reach along t that were asked for, if they were.
    pub(super) fn state(&self, rested: Rested, wanted: Option<(f64, f64)>, fairlead: f64) -> Result<State, LineError> {
        let tilt = self.tilt();
        let (Some(first), Some(last)) = (rested.held.first().copied(), rested.held.last().copied()) else {
            return Err(LineError::Empty);
        };
        let mut least = self.chain.ground.least;
        if tilt == Tilt::FLAT {
            least = least.min(first.p_hi);
        }
        let [t_p, t_n] = rested.t_by;
        let [q_p, q_n] = rested.q_by;
        let mut force = tilt.back(first.p_hi, first.q_hi);
        let mut far = tilt.back(last.p_lo, last.q_lo);
        let scale = force.0.hypot(force.1).max(far.0.hypot(far.1));
        let off = wanted.map_or(0.0, |(_, t)| rested.t - t);
        // the least tension already reaches so far: no horizontal force at all
        let limit = if tilt == Tilt::FLAT { 4.0 * least } else { (1e-9 * scale).max(64.0 * least) };
        let slack = wanted.is_some() && force.0 <= limit && off >= 0.0;
        let residual = if slack { 0.0 } else { (off / t_p).abs() * (1.0 + (q_p).abs()) };
        let fine = 4.0 * f64::EPSILON * (self.length() + rested.t.abs());
        if !(residual <= PROOF * scale || off.abs() <= fine) {
            return Err(LineError::Unproven { residual, tension: scale });
        }
        let loose = |h: &Held| h.ground > 0.0 || (h.q_hi > 0.0 && h.q_lo < 0.0);
        let mut stiffness = turned(tilt, [t_p, t_n], [1.0, 0.0], [q_p, q_n]);
        let mut coupling = turned(tilt, [t_p, t_n], rested.far_p_by, rested.far_q_by);
        if slack {
            if self.weightless() && off > 1e-9 * (self.length() + rested.t.abs()) {
                return Err(LineError::Undetermined);
            }
            if -tilt.sin > self.chain.ground.friction * tilt.cos {
                return Err(LineError::Slides);
            }
            let buoyant =
                self.chain.pulls.iter().any(|p| p.lift > 0.0) || self.chain.elements.iter().any(|e| e.weight() < 0.0);
            if tilt != Tilt::FLAT && buoyant {
                return Err(LineError::SlackSlope);
            }
            (force, far) = (still(force, least), still(far, least));
            if rested.held.iter().any(loose) {
                stiffness = [[0.0, 0.0], [0.0, q_n]];
                // between two legs the far one does not feel the near one; free, both carry
                let [_, far] = rested.far_q_by;
                coupling = [[0.0, 0.0], [0.0, far]];
            }
        }
        if self.slides(&rested) {
            return Err(LineError::Slides);
        }
        let places = self.places(&rested, wanted.map(|w| w.0), fairlead);
        let x = wanted.map_or_else(|| places.last().map_or(0.0, |p| p.0), |w| w.0);
        let segments = self.segment_states(&rested, slack.then_some(least));
        let state = State {
            force: force.0,
            x,
            dx_dh: if tilt == Tilt::FLAT || slack { t_p } else { 1.0 / stiffness[0][0] },
            top_vertical: force.1,
            top_tension: force.0.hypot(force.1),
            anchor_horizontal: far.0,
            anchor_vertical: far.1,
            stiffness,
            coupling,
            grounded: segments.iter().map(|s| s.grounded).sum(),
            grounded_stretched: rested.held.iter().map(|h| h.ground_stretched).sum(),
            touchdown: self.touchdown(&rested, &places),
            joints: self.joint_states(&rested, &places),
            below_bottom: self.below_bottom(&rested),
            above_surface: self.above_surface(&rested, &places),
            segments,
            slack,
            heap: None,
            iterations: rested.iterations,
            residual,
            unbalance: rested.unbalance,
            places,
            rested,
            laid: None,
        };
        if !state.is_finite() {
            return Err(LineError::NotConverged { force: force.0, residual: f64::NAN, iterations: state.iterations });
        }
        Ok(state)
    }

    /// Whether something without tension lies on a slope steeper than friction holds, or a clump is pulled downhill with
    /// more than friction bears.
    fn slides(&self, rested: &Rested) -> bool {
        let ground = &self.chain.ground;
        if ground.tilt == Tilt::FLAT {
            return false;
        }
        let steep = ground.tilt.sin > ground.friction * ground.tilt.cos;
        let heap = |h: &Held| h.rests && h.ground > 1e-9 * self.length() && h.leave <= ground.least;
        if steep && rested.held.iter().any(heap) {
            return true;
        }
        rested.policy.stands.iter().enumerate().any(|(j, stand)| {
            let value = |list: &[f64]| list.get(j).copied().unwrap_or(0.0);
            let above = rested.held.get(j).map_or(0.0, |h| h.p_lo);
            let along = above + value(&rested.lifts) * ground.tilt.sin;
            let held = ground.friction * value(&rested.reactions).max(0.0);
            *stand == Stand::Bottom
                && along < -held - 1e-9 * (above.abs() + value(&rested.lifts).abs()) - 64.0 * ground.least
        })
    }

    /// Whether nothing pulls the line down or up.
    pub(super) fn weightless(&self) -> bool {
        self.chain.elements.iter().all(|e| e.weight() == 0.0) && self.chain.pulls.iter().all(|p| p.lift == 0.0)
    }

    /// Ends of the pieces: distance from the fairlead and elevation (m).
    fn places(&self, rested: &Rested, x: Option<f64>, fairlead: f64) -> Vec<(f64, f64)> {
        let tilt = self.tilt();
        let (mut t, _) = self.anchor_place();
        // a slack line lies straight from the anchor, what is too long in a heap at the touchdown
        let mut lies = x.map_or(f64::INFINITY, |x| self.height(x, fairlead).0 - t);
        lies -= rested.held.iter().map(|h| h.upper.t + h.lower.t).sum::<f64>();
        let mut places: Vec<(f64, f64)> = Vec::with_capacity(rested.n.len());
        for (i, n) in rested.n.iter().enumerate().rev() {
            places.push((t, *n));
            if let Some(held) = i.checked_sub(1).and_then(|i| rested.held.get(i)) {
                let legs = held.upper.t + held.lower.t;
                let rest = (held.t - legs).min(lies.max(0.0));
                lies -= rest;
                t += legs + rest;
            }
        }
        places.reverse();
        let origin = x.unwrap_or_else(|| places.first().map_or(0.0, |(t, n)| tilt.back(*t, *n).0));
        let count = places.len();
        let place = |(i, (t, n)): (usize, (f64, f64))| {
            let (x, z) = tilt.back(t, n);
            match i {
                0 => (0.0, fairlead),
                i if i + 1 == count => (origin, self.anchor),
                _ => (origin - x, z + self.datum()),
            }
        };
        places.into_iter().enumerate().map(place).collect()
    }

    /// The rested lengths of line, without the springs at the ends.
    pub(super) fn lengths<'a>(&'a self, rested: &'a Rested) -> impl Iterator<Item = (usize, &'a Element, &'a Held)> {
        let parts = self.chain.elements.iter().zip(&rested.held).enumerate();
        parts.filter(|(_, (e, _))| matches!(e, Element::Length { .. })).map(|(i, (e, h))| (i, e, h))
    }

    fn segment_states(&self, rested: &Rested, slack: Option<f64>) -> Vec<SegmentState> {
        let tilt = self.tilt();
        self.lengths(rested)
            .map(|(_, _, h)| {
                let clean = |force: (f64, f64)| slack.map_or(force, |least| still(force, least));
                let (top, bottom) = (clean(tilt.back(h.p_hi, h.q_hi)), clean(tilt.back(h.p_lo, h.q_lo)));
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

    fn joint_states(&self, rested: &Rested, places: &[(f64, f64)]) -> Vec<JointState> {
        let first = self.first_joint();
        let state = |(j, joint): (usize, &Joint)| {
            let at = j + first;
            let (x, z) = places.get(at + 1).copied().unwrap_or_default();
            let value = |list: &[f64]| list.get(at).copied().unwrap_or(0.0);
            let (lift, reaction) = (value(&rested.lifts), value(&rested.reactions).max(0.0));
            let buoy = match (joint, rested.policy.stands.get(at)) {
                (Joint::SpringBuoy { .. } | Joint::Buoy { .. }, Some(stand)) => Some(match stand {
                    Stand::Free(0) | Stand::Bottom => Buoy::Sunk,
                    Stand::Free(_) => Buoy::Slack,
                    Stand::Step(_) => Buoy::Held,
                }),
                _ => None,
            };
            // what the line feels of a clump that the bottom carries
            let lift = if matches!(joint, Joint::Weight(_)) { lift + reaction * self.tilt().cos } else { lift };
            JointState { x, z, lift, reaction, buoy }
        };
        self.joints.iter().enumerate().map(state).collect()
    }

    /// Where the line, seen from the fairlead, first meets the bottom: distance from the fairlead and elevation (m).
    fn touchdown(&self, rested: &Rested, places: &[(f64, f64)]) -> Option<(f64, f64)> {
        let tilt = self.tilt();
        let (index, element, held) = self.lengths(rested).find(|(_, _, h)| h.ground > 0.0)?;
        let Element::Length { segment, law, .. } = element else { return None };
        let (x, z) = places.get(index).copied()?;
        if held.above == 0.0 {
            return Some((x, z));
        }
        let p = held.p_hi - segment.weight * tilt.sin * held.above;
        let leg = stretch(segment, law.as_ref(), tilt, held.above, p, 0.0);
        let (dx, dz) = tilt.back(leg.x, leg.z);
        Some((x + dx, z - dz))
    }

    /// Segments that do not see the bottom and hang below it, with how far (m).
    fn below_bottom(&self, rested: &Rested) -> Vec<(usize, f64)> {
        if self.floor.is_none() {
            return Vec::new();
        }
        let tilt = self.tilt();
        let scale = 1e-9 * (self.length() + self.anchor.abs());
        let mut list = Vec::new();
        for (number, (index, element, held)) in self.lengths(rested).enumerate() {
            let Element::Length { segment, law, sees_bottom: false } = element else { continue };
            let end = |i: usize| rested.n.get(i).copied().unwrap_or(0.0);
            let mut lowest = end(index).min(end(index + 1));
            if held.q_lo < 0.0 && held.q_hi > 0.0 && segment.weight > 0.0 {
                let s = -held.q_lo / (segment.weight * tilt.cos);
                lowest = end(index + 1) + stretch(segment, law.as_ref(), tilt, s, held.p_lo, held.q_lo).z;
            }
            if lowest < -scale {
                list.push((number + 1, -lowest));
            }
        }
        list
    }

    /// Buoyant segments, and segments that begin at a buoyant joint, that rise above the water surface, with how far
    /// (m).
    fn above_surface(&self, rested: &Rested, places: &[(f64, f64)]) -> Vec<(usize, f64)> {
        let tilt = self.tilt();
        let scale = 1e-9 * (self.length() + self.anchor.abs());
        let mut list = Vec::new();
        for (number, (index, element, held)) in self.lengths(rested).enumerate() {
            let Element::Length { segment, .. } = element else { continue };
            let (_, low) = places.get(index + 1).copied().unwrap_or_default();
            let lifted = self.joints.get(number).is_some_and(|j| matches!(j, Joint::Weight(w) if *w < 0.0));
            let mut highest = if lifted { low } else { f64::NEG_INFINITY };
            if segment.weight < 0.0 {
                let (h, v) = tilt.back(held.p_lo, held.q_lo);
                let (_, top) = tilt.back(held.p_hi, held.q_hi);
                highest = highest.max(low);
                if v > 0.0 && top < 0.0 {
                    let part = Segment { length: -v / segment.weight, ..*segment };
                    highest = highest.max(low + hanging(&part, h, v).z);
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
fn still((h, v): (f64, f64), least: f64) -> (f64, f64) {
    if h.hypot(v) <= 64.0 * least {
        (0.0, 0.0)
    } else if h.abs() <= 64.0 * least {
        (0.0, v)
    } else {
        (h, v)
    }
}

/// d(H, V)/d(x, z of the fairlead) of forces whose derivatives by the tension and the height at the fairlead are `p_by`
/// along the bottom and `q_by` normal to it; `t_by` those of the reach.
fn turned(tilt: Tilt, [t_p, t_n]: [f64; 2], p_by: [f64; 2], q_by: [f64; 2]) -> [[f64; 2]; 2] {
    let row = |[by_p, by_n]: [f64; 2]| (by_p / t_p, by_n - by_p * t_n / t_p);
    let ((a, b), (c, d)) = (row(p_by), row(q_by));
    if tilt == Tilt::FLAT {
        return [[a, b], [c, d]];
    }
    // rows are forces, columns displacements: both turn
    let ((a, b), (c, d)) = (tilt.back(a, b), tilt.back(c, d));
    let ((a, c), (b, d)) = (tilt.back(a, c), tilt.back(b, d));
    [[a, b], [c, d]]
}
