//! The configuration of a whole line at a given horizontal force: the states of its spring buoys, then section by
//! section between the held ones.

use super::line::{Joint, Line, LineError, Segment};
use super::search::{Point, rising_root};
use super::section::{Ends, Search, Section};
use super::segment::Reach;

/// Most spring buoys in a line; the search goes through at most 3 to this power combinations of their states.
pub const MOST_BUOYS: usize = 5;

/// How a spring buoy stands.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Buoy {
    /// The joint is above the end of its pendant: no pull.
    Slack,
    /// The joint hangs on its pendant; the buoy floats.
    Held,
    /// The buoy is pulled under with all its capacity.
    Sunk,
}

/// A segment in a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SegmentState {
    /// Tension at the end toward the fairlead (N).
    pub top_tension: f64,
    /// Tension at the end toward the anchor (N).
    pub bottom_tension: f64,
    /// Vertical force at the end toward the fairlead (N, positive where the line rises toward the fairlead).
    pub top_vertical: f64,
    /// Vertical force at the end toward the anchor (N).
    pub bottom_vertical: f64,
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
}

/// A joint in a configuration.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct JointState {
    /// Horizontal distance from the fairlead (m).
    pub x: f64,
    /// Elevation (m).
    pub z: f64,
    /// Force applied to the line there (N, upward; a clump weight on the bottom is carried by the bottom).
    pub lift: f64,
    /// State of the spring buoy, if there is one.
    pub buoy: Option<Buoy>,
}

/// A line in equilibrium.
#[derive(Clone, Debug, PartialEq)]
pub struct State {
    /// Horizontal force (N).
    pub force: f64,
    /// Horizontal distance from fairlead to anchor (m).
    pub x: f64,
    /// Derivative of the distance with respect to the horizontal force at a fixed fairlead elevation (m/N).
    pub dx_dh: f64,
    /// Vertical force of the line on the fairlead (N, downward).
    pub top_vertical: f64,
    /// Tension at the fairlead (N).
    pub top_tension: f64,
    /// Vertical pull on the anchor (N, upward).
    pub anchor_vertical: f64,
    /// Unstretched length on the bottom (m).
    pub grounded: f64,
    /// The same, stretched (m).
    pub grounded_stretched: f64,
    /// Segments, fairlead first.
    pub segments: Vec<SegmentState>,
    /// Joints, fairlead first.
    pub joints: Vec<JointState>,
    /// Segments (from 1) that hang below the bottom because the seed lets those above a spring buoy ignore it, with
    /// how far (m).
    pub below_bottom: Vec<(usize, f64)>,
    /// Iterations of the vertical searches, for the one that was accepted.
    pub iterations: usize,
    /// Largest vertical distance left in a section of the line (m): at most 1e-12 of its length, or what 1e-9 of the
    /// tension makes of it.
    pub residual: f64,
}

/// See [`Line::at_horizontal_force`].
pub fn at_horizontal_force(line: &Line, h: f64, fairlead: f64) -> Result<State, LineError> {
    for (what, value, good) in
        [("the horizontal force", h, h > 0.0), ("the fairlead elevation", fairlead, fairlead.is_finite())]
    {
        if !(good && value.is_finite()) {
            return Err(LineError::Value { what, segment: 1, value });
        }
    }
    if fairlead < line.anchor && line.bottom_from() == 0 {
        return Err(LineError::BelowBottom(line.anchor - fairlead));
    }
    let buoys: Vec<usize> =
        line.joints.iter().enumerate().filter(|(_, j)| matches!(j, Joint::SpringBuoy { .. })).map(|(i, _)| i).collect();
    let mut states = vec![Buoy::Slack; buoys.len()];
    let mut last = None;
    // all combinations, sunk first: tables spend most of their rows there
    let combinations = 3usize.pow(u32::try_from(buoys.len()).unwrap_or(0));
    for number in 0..combinations {
        let mut rest = number;
        for state in &mut states {
            *state = match rest % 3 {
                0 => Buoy::Sunk,
                1 => Buoy::Held,
                _ => Buoy::Slack,
            };
            rest /= 3;
        }
        match line.assume(h, fairlead, &buoys, &states) {
            Ok(Some(state)) => return Ok(state),
            Ok(None) => {}
            Err(error) => last = Some(error),
        }
    }
    Err(last.unwrap_or(LineError::NotConverged { force: h, residual: f64::NAN, iterations: combinations }))
}

/// See [`Line::at_distance`]. The distance grows with the force, also through the changes of the buoys' states.
pub fn at_distance(line: &Line, x: f64, fairlead: f64) -> Result<State, LineError> {
    if !(x > 0.0 && x.is_finite()) {
        return Err(LineError::Value { what: "the horizontal distance", segment: 1, value: x });
    }
    let weight: f64 = line.segments.iter().map(|s| (s.weight * s.length).abs()).sum();
    let start = if weight > 0.0 { 0.3 * weight } else { 1.0 };
    let (force, _) = rising_root(start, x, |h| match line.at_horizontal_force(h, fairlead) {
        Ok(state) => Point { value: state.x, slope: state.dx_dh },
        Err(_) => Point { value: f64::NAN, slope: f64::NAN },
    });
    let state = line.at_horizontal_force(force, fairlead)?;
    let off = (state.x - x).abs();
    let residual = off / state.dx_dh;
    if residual <= 1e-9 * state.top_tension && off <= 1e-6 * (line.length() + x)
        || off <= 4.0 * f64::EPSILON * (line.length() + x)
    {
        return Ok(state);
    }
    if state.x > x && force < 1e-9 * start {
        return Err(LineError::Slack { force, reach: state.x });
    }
    Err(LineError::Unproven { residual, tension: state.top_tension })
}

impl Line {
    /// The first segment from which on the bottom carries the line: below the last buoyant part.
    fn bottom_from(&self) -> usize {
        let lifts = |joint: &Joint| match joint {
            Joint::SpringBuoy { .. } => true,
            Joint::Weight(w) => *w < 0.0,
            Joint::Free => false,
        };
        let joint = self.joints.iter().rposition(lifts).map_or(0, |i| i + 1);
        let segment = self.segments.iter().rposition(|s| s.weight <= 0.0).map_or(0, |i| i + 1);
        joint.max(segment)
    }

    /// The last joint that carries a spring buoy: segments up to it ignore the bottom.
    fn last_spring_buoy(&self) -> Option<usize> {
        self.joints.iter().rposition(|j| matches!(j, Joint::SpringBuoy { .. }))
    }

    /// Solves with the buoys in assumed states; `None` when the result contradicts them.
    fn assume(&self, h: f64, fairlead: f64, buoys: &[usize], states: &[Buoy]) -> Result<Option<State>, LineError> {
        let state_of = |joint: usize| buoys.iter().position(|b| *b == joint).and_then(|i| states.get(i)).copied();
        let lifts: Vec<f64> = self
            .joints
            .iter()
            .enumerate()
            .map(|(index, joint)| match (joint, state_of(index)) {
                (Joint::Weight(w), _) => -w,
                (Joint::SpringBuoy { capacity, .. }, Some(Buoy::Sunk)) => *capacity,
                _ => 0.0,
            })
            .collect();
        let bottom_from = self.bottom_from();
        let mut work = Work::new(self.segments.len());
        let (mut from, mut upper) = (0, fairlead);
        for end in 0..self.segments.len() {
            let last = end + 1 == self.segments.len();
            let held = match (self.joints.get(end), state_of(end)) {
                (Some(Joint::SpringBuoy { depth, .. }), Some(Buoy::Held)) => Some(self.surface - depth),
                _ => None,
            };
            if !last && held.is_none() {
                continue;
            }
            let lower = held.unwrap_or(self.anchor);
            let section = Section {
                segments: self.segments.get(from..=end).unwrap_or_default(),
                lifts: lifts.get(from..end).unwrap_or_default(),
                bottom_from: bottom_from.saturating_sub(from),
            };
            if last && section.bottom_from == 0 && upper < lower {
                return Ok(None);
            }
            let (top, reach, search) = section.solve(h, upper - lower)?;
            section.walk(h, top, |ends| work.ends.push(ends));
            work.add(reach, search);
            (from, upper) = (end + 1, lower);
        }
        self.accept(h, fairlead, &lifts, work, state_of)
    }

    /// Makes the state of a walked line, unless it contradicts what was assumed of its buoys.
    fn accept(
        &self,
        h: f64,
        fairlead: f64,
        lifts: &[f64],
        work: Work,
        state_of: impl Fn(usize) -> Option<Buoy>,
    ) -> Result<Option<State>, LineError> {
        let scale = 1e-9 * (self.length() + fairlead.abs() + self.anchor.abs());
        let (mut x, mut z) = (0.0, fairlead);
        let mut joints = Vec::with_capacity(self.joints.len());
        let mut below_bottom = Vec::new();
        let last_buoy = self.last_spring_buoy();
        for (index, ends) in work.ends.iter().enumerate() {
            if let Some(segment) = self.segments.get(index)
                && let Some(by) = sag_below(segment, h, ends, z - ends.z - self.anchor).filter(|by| *by > scale)
            {
                if last_buoy.is_none_or(|b| index > b) {
                    return Err(LineError::Crosses { segment: index + 1, by });
                }
                below_bottom.push((index + 1, by));
            }
            x += ends.x;
            z -= ends.z;
            let Some(joint) = self.joints.get(index) else { break };
            let (next, aground) =
                work.ends.get(index + 1).map_or((0.0, false), |n| (n.high, n.ground > 0.0 && n.high == 0.0));
            // a joint on the bottom: what the line feels is what is left of its tension's vertical part
            let mut lift = if aground { -ends.low } else { lifts.get(index).copied().unwrap_or(0.0) };
            let buoy = state_of(index);
            if let (Joint::SpringBuoy { capacity, depth }, Some(state)) = (joint, buoy) {
                let held = self.surface - depth;
                let fits = match state {
                    Buoy::Slack => z >= held - scale,
                    Buoy::Sunk => z <= held + scale,
                    Buoy::Held => {
                        lift = next - ends.low;
                        let slip = 1e-9 * (capacity + h);
                        z = held;
                        lift >= -slip && lift <= capacity + slip
                    }
                };
                if !fits {
                    return Ok(None);
                }
            }
            joints.push(JointState { x, z, lift, buoy });
        }
        let top_vertical = work.ends.first().map_or(0.0, |e| e.high);
        let anchor_vertical = work.ends.last().map_or(0.0, |e| e.low);
        let stretched = |(ends, segment): (&Ends, &Segment)| ends.ground * (1.0 + h / segment.ea);
        let segments = work.ends.iter().map(|e| SegmentState {
            top_tension: h.hypot(e.high),
            bottom_tension: h.hypot(e.low),
            top_vertical: e.high,
            bottom_vertical: e.low,
            grounded: e.ground,
        });
        let state = State {
            force: h,
            x: work.x,
            dx_dh: work.dx_dh,
            top_vertical,
            top_tension: h.hypot(top_vertical),
            anchor_vertical,
            grounded: work.ends.iter().map(|e| e.ground).sum(),
            grounded_stretched: work.ends.iter().zip(&self.segments).map(stretched).sum(),
            segments: segments.collect(),
            joints,
            below_bottom,
            iterations: work.iterations,
            residual: work.residual,
        };
        let line = [state.x, state.dx_dh, state.top_tension, state.anchor_vertical, state.grounded_stretched];
        let joints = state.joints.iter().flat_map(|j| [j.x, j.z, j.lift]);
        let parts = state.segments.iter().flat_map(|s| [s.top_tension, s.bottom_tension]);
        if line.into_iter().chain(joints).chain(parts).any(|v| !v.is_finite()) {
            return Err(LineError::NotConverged { force: h, residual: f64::NAN, iterations: work.iterations });
        }
        Ok(Some(state))
    }
}

/// Sums over the sections of a line.
struct Work {
    ends: Vec<Ends>,
    x: f64,
    dx_dh: f64,
    iterations: usize,
    residual: f64,
}

impl Work {
    fn new(segments: usize) -> Self {
        Work { ends: Vec::with_capacity(segments), x: 0.0, dx_dh: 0.0, iterations: 0, residual: 0.0 }
    }

    /// A section between fixed elevations: at constant rise, dV/dH = -z_H/z_V.
    fn add(&mut self, reach: Reach, search: Search) {
        self.x += reach.x;
        let turned = if reach.z_v > 0.0 { reach.x_v * reach.z_h / reach.z_v } else { 0.0 };
        self.dx_dh += reach.x_h - turned;
        self.iterations += search.iterations;
        self.residual = self.residual.max(search.residual);
    }
}

/// How far below the bottom (m) the lowest point of a free segment lies, when it hangs below its lower end or that end
/// itself is below; `height` is the elevation of the lower end above the bottom (m).
fn sag_below(segment: &Segment, h: f64, ends: &Ends, height: f64) -> Option<f64> {
    if ends.ground > 0.0 {
        return None;
    }
    let sag = if ends.low < 0.0 && ends.high > 0.0 && segment.weight > 0.0 {
        // from the lower end, where V is negative, down to V = 0
        let v = -ends.low;
        (v * v / (h.hypot(v) + h) + 0.5 * v * v / segment.ea) / segment.weight
    } else {
        0.0
    };
    let lowest = height - sag;
    (lowest < 0.0).then_some(-lowest)
}
