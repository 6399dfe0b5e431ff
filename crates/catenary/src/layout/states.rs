//! What a laid line means: its state, proven, and its shape.

use super::{LaidLine, LineLayout, PieceStretch, SupportMode};
use crate::dual::Var;
use crate::element::{LinePiece, mean_strain, stretch};
use crate::error::LineError;
use crate::line::{Joint, Segment};
use crate::shape::ShapePoint;
use crate::solve::RESIDUAL_TOLERANCE;
use crate::state::{Buoy, JointState, LineState, SegmentState};

/// How far from the anchor a line may end, as a share of its length, and in roundings of its force by how much it lengthens with the force:
/// a line that is soft beside a jump of its end has next to no force left there, though it ends far away.
const MAX_SHORT_SHARE: f64 = 1e-9;
const MAX_SHORT_ROUNDINGS: f64 = 64.0;

impl LineLayout<'_> {
    /// The state of a line laid from a fairlead at `x` beside the anchor and elevation `z`.
    ///
    /// # Errors
    /// A line that was laid without a piece, or that ends beside its anchor.
    pub fn state(&self, laid: LaidLine, [x, z]: [f64; 2], slack: bool) -> Result<LineState, LineError> {
        let [by_first, by_x, by_z, _] = laid.short.by;
        let Some(first) = laid.stretches.first().copied() else { return Err(LineError::Empty) };
        // the least tension stands for none
        let none = if slack { 64.0 } else { 2.0 } * self.least;
        let clean = |v: f64| if v.abs() <= none { 0.0 } else { v };
        // as the fairlead moves, the end stays at the anchor
        let moved = |v: Var| {
            let [own, x, z, _] = v.by;
            let share = |by: f64| if by_first == 0.0 { 0.0 } else { own * by / by_first };
            [x - share(by_x), z - share(by_z)]
        };
        let [end_h, end_v] = laid.end;
        let force = Var::parameter(first.h, 0, 1.0);
        let (mut stiffness, mut coupling) = ([moved(force), moved(laid.top)], [moved(end_h), moved(end_v)]);
        if slack {
            stiffness[0] = [0.0; 2];
            coupling[0] = if laid.heap.is_some() { coupling[0] } else { [0.0; 2] };
        }
        let on_bottom = first.manner != SupportMode::Hangs;
        if on_bottom {
            stiffness[1][1] = f64::INFINITY;
        }
        let tension = first.h.hypot(first.v);
        let scale = tension.max(end_h.value.hypot(end_v.value));
        let [[xx, _], [zx, _]] = stiffness;
        let short = laid.short.value;
        let residual = if slack { 0.0 } else { short.abs() * xx.hypot(zx) };
        let rounding = 2.0 * self.fine;
        let by_rounding = if xx == 0.0 { 0.0 } else { MAX_SHORT_ROUNDINGS * f64::EPSILON * first.h / xx.abs() };
        let arrives = short.abs() <= MAX_SHORT_SHARE * self.length + by_rounding;
        if !(slack || (arrives && residual <= RESIDUAL_TOLERANCE * scale) || short.abs() <= rounding) {
            return Err(LineError::Unproven { residual, tension: scale });
        }
        if laid.left > 1e-12 * (self.length + x.abs()) + 64.0 * self.fine {
            return Err(LineError::NotConverged { force: first.h, residual: laid.left, iterations: laid.iterations });
        }
        let position = |u: f64, z: f64| (x - u, z);
        let mut positions: Vec<(f64, f64)> = vec![(0.0, z)];
        let mut segments = Vec::new();
        let (mut grounded, mut grounded_stretched, mut touchdown) = (0.0, 0.0, None);
        let mut below_bottom = Vec::new();
        let mut above_surface = Vec::new();
        let mut at = 0;
        for (index, element) in self.elements.iter().enumerate() {
            let from = at;
            while laid.stretches.get(at).is_some_and(|s| s.element == index) {
                at += 1;
            }
            let parts = &laid.stretches[from..at];
            let (Some(head), Some(tail)) = (parts.first(), parts.last()) else { return Err(LineError::Empty) };
            let [u, z, low_h, low_v] = tail.low;
            positions.push(position(u, z));
            let LinePiece::Length { segment, sees_bottom, .. } = element else { continue };
            let number = segments.len() + 1;
            let mut on_bottom = 0.0;
            for part in parts.iter().filter(|p| p.manner != SupportMode::Hangs) {
                touchdown = touchdown.or(Some(position(part.u, part.z)));
                on_bottom += part.to - part.from;
                let [u, z, ..] = part.low;
                grounded_stretched +=
                    if part.manner == SupportMode::Heap { part.to - part.from } else { (part.u - u).hypot(part.z - z) };
            }
            grounded += on_bottom;
            let (top_h, top_v) = (clean(head.h), clean(head.v));
            let (low_h, low_v) = (clean(low_h), clean(low_v));
            segments.push(SegmentState {
                top_tension: top_h.hypot(top_v),
                bottom_tension: low_h.hypot(low_v),
                top_horizontal: top_h,
                bottom_horizontal: low_h,
                top_vertical: top_v,
                bottom_vertical: low_v,
                grounded: on_bottom,
            });
            let fine = 1e-9 * (self.length + self.line.anchor.abs());
            if let (false, true, Some(by)) = (*sees_bottom, self.line.floor.is_some(), self.depth_below(segment, head))
            {
                below_bottom.extend((by > fine).then_some((number, by)));
            }
            let lifted = matches!(self.line.joints.get(number - 1), Some(Joint::Weight(w)) if *w < 0.0);
            let highest = highest(segment, head, if lifted { z } else { f64::NEG_INFINITY });
            above_surface.extend((highest > self.line.surface + fine).then_some((number, highest - self.line.surface)));
        }
        let skip = self.line.first_joint();
        let joints = self.line.joints.iter().zip(laid.joints.iter().skip(skip)).map(|(joint, at)| {
            let (x, z) = position(at.u, at.z);
            let buoy = matches!(joint, Joint::SpringBuoy { .. } | Joint::Buoy { .. }).then_some(
                match (at.held, at.passed || at.reaction > 0.0) {
                    (true, _) => Buoy::Held,
                    (_, true) => Buoy::Sunk,
                    _ => Buoy::Slack,
                },
            );
            // what the line feels of a clump that the bottom carries
            let cos = self.bottom.tilt(self.bottom.face(at.u)).cos;
            let lift = if matches!(joint, Joint::Weight(_)) { at.lift + at.reaction * cos } else { at.lift };
            JointState { x, z, lift, reaction: at.reaction, buoy }
        });
        let (force, vertical) = (clean(first.h), clean(first.v));
        let state = LineState {
            force,
            x,
            dx_dh: if slack { 0.0 } else { 1.0 / xx },
            top_vertical: vertical,
            top_tension: force.hypot(vertical),
            anchor_horizontal: clean(end_h.value),
            anchor_vertical: clean(end_v.value),
            stiffness,
            coupling,
            grounded,
            grounded_stretched,
            touchdown,
            joints: joints.collect(),
            below_bottom,
            above_surface,
            segments,
            slack,
            heap: laid.heap,
            iterations: laid.iterations,
            residual,
            unbalance: laid.left * xx.abs(),
            positions,
            rested: Default::default(),
            laid: Some(Box::new(laid)),
        };
        if !state.is_finite() {
            return Err(LineError::NotConverged { force, residual: f64::NAN, iterations: state.iterations });
        }
        Ok(state)
    }

    /// How far a hanging stretch that does not see the bottom is below it (m).
    fn depth_below(&self, segment: &Segment, part: &PieceStretch) -> Option<f64> {
        let mut lowest: f64 = self.bottom.elevation(part.low[0]) - part.low[1];
        for face in self.bottom.face(part.low[0])..=self.bottom.face(part.u) {
            let s = (part.v - part.h * self.bottom.tilt(face).slope()) / segment.weight;
            if segment.weight > 0.0 && s > part.from && s < part.to {
                let reach = stretch(segment, None, s, part.h, part.v - segment.weight * s);
                let (u, z) = (part.u - reach.x, part.z - reach.z);
                lowest = lowest.max(self.bottom.elevation(u) - z);
            }
        }
        Some(lowest)
    }
}

/// The highest place of a buoyant segment, which does not lie, and of its lower end `joint` (m) where that is lifted.
fn highest(segment: &Segment, part: &PieceStretch, joint: f64) -> f64 {
    let [_, low, _, v] = part.low;
    let mut highest = joint;
    if segment.weight < 0.0 {
        highest = highest.max(low);
        if v > 0.0 && part.v < 0.0 {
            let above = Segment { length: -v / segment.weight, ..*segment };
            highest = highest.max(low + stretch(&above, None, above.length, part.h, v).z);
        }
    }
    highest
}

/// A point of a stretch, `s` from the upper end of its piece; `x` is the distance of the ends and `arc` the length before
/// the piece.
pub fn point(
    element: &LinePiece,
    part: &PieceStretch,
    s: f64,
    x: f64,
    (segment, arc): (usize, f64),
) -> Option<ShapePoint> {
    let LinePiece::Length { segment: properties, law, .. } = element else { return None };
    let length = (s - part.from).clamp(0.0, part.to - part.from);
    let (u, z, h, v) = match part.manner {
        SupportMode::Hangs => {
            let v = part.v - properties.weight * length;
            let reach = stretch(properties, law.as_ref(), length, part.h, v);
            (part.u - reach.x, part.z - reach.z, part.h, v)
        }
        SupportMode::Lies { tilt, loss } => {
            let (tension, _) = tilt.to_face(part.h, part.v);
            let left = (tension - loss * length).max(0.0);
            let along = length * (1.0 + mean_strain(properties, law.as_ref(), tension, left).0);
            (part.u - along * tilt.cos, part.z - along * tilt.sin, left * tilt.cos, left * tilt.sin)
        }
        SupportMode::Heap => (part.u, part.z, 0.0, 0.0),
    };
    let on_bottom = part.manner != SupportMode::Hangs;
    Some(ShapePoint { arc: arc + s, segment, x: x - u, z, horizontal: h, vertical: v, on_bottom })
}
