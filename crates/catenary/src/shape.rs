//! The shape of a solved line: positions and tensions at any arc length.

use super::element::{LinePiece, stretch};
use super::layout::{LaidLine, PieceStretch, point};
use super::line::Line;
use super::multi_segment::SegmentSolution;
use super::state::LineState;

/// Points inside each segment before its curve is refined.
const LEAST_INNER_POINTS: usize = 3;
/// Halvings between two points of a curve: more would be finer than a sixty-fourth of a quarter of a segment.
const MAX_BISECTIONS: usize = 6;
/// Points from which on a curve is not refined any more: a line of very many segments has enough of them.
const MAX_ADAPTIVE_POINTS: usize = 2_000;

/// A point of a line.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ShapePoint {
    /// Unstretched length from the fairlead (m).
    pub arc: f64,
    /// Segment, from 1.
    pub segment: usize,
    /// Horizontal distance from the fairlead (m).
    pub x: f64,
    /// Elevation (m).
    pub z: f64,
    /// Horizontal force (N).
    pub horizontal: f64,
    /// Vertical force (N, positive where the line rises toward the fairlead).
    pub vertical: f64,
    /// Whether it lies on the bottom.
    pub on_bottom: bool,
}

impl ShapePoint {
    /// Tension (N).
    pub fn tension(&self) -> f64 {
        self.horizontal.hypot(self.vertical)
    }

    /// Angle of the line above the horizontal, toward the fairlead (rad).
    pub fn angle(&self) -> f64 {
        self.vertical.atan2(self.horizontal)
    }
}

impl Line {
    /// The shape of the line in a state of its own: both ends of each segment, `between` points evenly inside, and the
    /// places where it meets and leaves the bottom.
    pub fn shape(&self, state: &LineState, between: usize) -> Vec<ShapePoint> {
        if let Some(laid) = &state.laid {
            return self.laid_shape(laid, state.x, between);
        }
        let mut points = Vec::new();
        let mut arc = 0.0;
        for (number, (index, element, held)) in self.lengths(&state.rested).enumerate() {
            let length = element.length();
            let mut at: Vec<f64> = (0..=between + 1).map(|i| length * i as f64 / (between + 1) as f64).collect();
            if held.rests {
                at.extend([held.above, held.above + held.ground]);
                at.sort_by(f64::total_cmp);
                at.dedup_by(|a, b| (*a - *b).abs() <= 1e-9 * length);
            }
            for s in at {
                points.extend(self.point(state, (number + 1, index), element, held, s, arc));
            }
            arc += length;
        }
        points
    }

    /// The shape of the line with as many points as a drawn curve needs: those of [`Line::shape`] with three inside each segment,
    /// and further ones until the line turns by no more than `turn` (rad) from one to the next.
    pub fn adaptive_shape(&self, state: &LineState, turn: f64) -> Vec<ShapePoint> {
        let base = self.shape(state, LEAST_INNER_POINTS);
        let mut points: Vec<ShapePoint> = base.first().copied().into_iter().collect();
        for (a, b) in base.iter().zip(base.iter().skip(1)) {
            if a.segment == b.segment && points.len() < MAX_ADAPTIVE_POINTS {
                self.refine(state, (a, b), (turn, MAX_BISECTIONS), &mut points);
            }
            points.push(*b);
        }
        points
    }

    /// Adds the points between two of one segment where the line turns too far between them.
    fn refine(
        &self,
        state: &LineState,
        (a, b): (&ShapePoint, &ShapePoint),
        (turn, depth): (f64, usize),
        points: &mut Vec<ShapePoint>,
    ) {
        // a corner between two points at one length, as at a heap of spare line, is no curve
        let is_curved = (a.angle() - b.angle()).abs() > turn && b.arc - a.arc > 1e-9 * self.length();
        if depth == 0 || !is_curved {
            return;
        }
        let middle = self.point_at(state, 0.5 * (a.arc + b.arc)).filter(|p| p.segment == a.segment);
        if let Some(middle) = middle {
            self.refine(state, (a, &middle), (turn, depth - 1), points);
            points.push(middle);
            self.refine(state, (&middle, b), (turn, depth - 1), points);
        }
    }

    /// The point at an unstretched length from the fairlead (m); `None` outside the line.
    pub fn point_at(&self, state: &LineState, length: f64) -> Option<ShapePoint> {
        let mut arc = 0.0;
        if let Some(laid) = &state.laid {
            let mut stretches = laid.stretches.iter().peekable();
            let mut number = 0;
            for (index, element) in self.chain.elements.iter().enumerate() {
                number += usize::from(matches!(element, LinePiece::Length { .. }));
                let s = length - arc;
                while let Some(part) = stretches.next_if(|p| p.element == index) {
                    if (part.from..=part.to).contains(&s) {
                        return point(element, part, s, state.x, (number, arc));
                    }
                }
                arc += element.length();
            }
            return None;
        }
        for (number, (index, element, held)) in self.lengths(&state.rested).enumerate() {
            let s = length - arc;
            if (0.0..=element.length()).contains(&s) {
                return self.point(state, (number + 1, index), element, held, s, arc);
            }
            arc += element.length();
        }
        None
    }

    fn laid_shape(&self, laid: &LaidLine, x: f64, between: usize) -> Vec<ShapePoint> {
        let mut points = Vec::new();
        let mut stretches = laid.stretches.iter().peekable();
        let (mut arc, mut number) = (0.0, 0);
        for (index, element) in self.chain.elements.iter().enumerate() {
            let length = element.length();
            number += usize::from(length > 0.0);
            let mut inside = (0..=between + 1).map(|i| length * i as f64 / (between + 1) as f64).peekable();
            while let Some(part) = stretches.next_if(|p| p.element == index) {
                // and the places where it meets and leaves the bottom
                while let Some(s) = inside.next_if(|s| *s <= part.to + 1e-9 * length) {
                    points.extend(point(element, part, s, x, (number, arc)));
                }
                let should_continue = |next: &&PieceStretch| next.element == index && next.continues_on_face_of(part);
                let last = !stretches.peek().is_some_and(should_continue);
                if last && points.last().is_none_or(|p| (p.arc - arc - part.to).abs() > 1e-9 * length) {
                    points.extend(point(element, part, part.to, x, (number, arc)));
                }
            }
            arc += length;
        }
        points
    }

    /// A point of a piece, `s` below its upper end; `arc` is the length before it.
    fn point(
        &self,
        state: &LineState,
        (segment, index): (usize, usize),
        element: &LinePiece,
        held: &SegmentSolution,
        s: f64,
        arc: f64,
    ) -> Option<ShapePoint> {
        let LinePiece::Length { segment: properties, law, .. } = element else { return None };
        let least = self.chain.least;
        let weight = properties.weight;
        let (x, z) = state.positions.get(index).copied()?;
        let (end_x, end_z) = state.positions.get(index + 1).copied()?;
        // a leg of this length with these forces at its lower end
        let hang = |length: f64, h: f64, v: f64| {
            if length > 0.0 {
                let r = stretch(properties, law.as_ref(), length, h, v);
                (r.x, r.z)
            } else {
                (0.0, 0.0)
            }
        };
        let lies = held.rests && s > held.above && s <= held.above + held.ground;
        let (x, z, h, v) = if !held.rests || s <= held.above {
            let v = held.v_hi - weight * s;
            let (dx, dz) = hang(s, held.h, v);
            (x + dx, z - dz, held.h, v)
        } else if lies {
            let h = held.h.max(least);
            let (dx, dz) = hang(held.above, h, 0.0);
            let stretched = 1.0 + element.strain(h).0;
            // what lies in a heap keeps between its ends
            let whole = held.ground * stretched;
            let room = (end_x - (x + dx) - held.lower.x).max(0.0);
            let share = if whole > 0.0 { (room / whole).min(1.0) } else { 0.0 };
            (x + dx + (s - held.above) * stretched * share, z - dz, h, 0.0)
        } else {
            let left = element.length() - s;
            let (dx, dz) = hang(left, held.h, held.v_lo);
            (end_x - dx, end_z + dz, held.h, held.v_lo + weight * left)
        };
        let horizontal = if state.slack && h.abs() <= 64.0 * least { 0.0 } else { h };
        Some(ShapePoint { arc: arc + s, segment, x, z, horizontal, vertical: v, on_bottom: lies })
    }
}
