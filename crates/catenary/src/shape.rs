//! The shape of a solved line: positions and tensions at any arc length.

use super::chain::Held;
use super::element::{Element, Tilt, stretch};
use super::layout::{Laid, Stretch, point};
use super::line::Line;
use super::state::State;

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
    pub fn shape(&self, state: &State, between: usize) -> Vec<ShapePoint> {
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

    /// The point at an unstretched length from the fairlead (m); `None` outside the line.
    pub fn point_at(&self, state: &State, length: f64) -> Option<ShapePoint> {
        let mut arc = 0.0;
        if let Some(laid) = &state.laid {
            let mut stretches = laid.stretches.iter().peekable();
            let mut number = 0;
            for (index, element) in self.chain.elements.iter().enumerate() {
                number += usize::from(matches!(element, Element::Length { .. }));
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

    fn laid_shape(&self, laid: &Laid, x: f64, between: usize) -> Vec<ShapePoint> {
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
                let goes_on = |next: &&Stretch| next.element == index && next.runs_on_from(part);
                let last = !stretches.peek().is_some_and(goes_on);
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
        state: &State,
        (segment, index): (usize, usize),
        element: &Element,
        held: &Held,
        s: f64,
        arc: f64,
    ) -> Option<ShapePoint> {
        let Element::Length { segment: properties, law, .. } = element else { return None };
        let ground = &self.chain.ground;
        let tilt = ground.tilt;
        let (across, along) = element.per_length(ground);
        let (x, z) = state.places.get(index).copied()?;
        let (end_x, end_z) = state.places.get(index + 1).copied()?;
        let hang = |s: f64, p: f64, q: f64| {
            let r = stretch(properties, law.as_ref(), tilt, s, p, q);
            tilt.back(r.x, r.z)
        };
        let lies = held.rests && s > held.above && s <= held.above + held.ground;
        let (x, z, p, q) = if !held.rests || s <= held.above {
            let (p, q) = (held.p_hi - along * s, held.q_hi - across * s);
            let (dx, dz) = if s > 0.0 { hang(s, p, q) } else { (0.0, 0.0) };
            (x + dx, z - dz, p, q)
        } else if lies {
            let touch = (held.p_hi - along * held.above).max(ground.least);
            let (dx, dz) = if held.above > 0.0 { hang(held.above, touch, 0.0) } else { (0.0, 0.0) };
            let rest = element.rest(ground, touch, s - held.above);
            // what lies in a heap keeps between its ends
            let whole = element.rest(ground, touch, held.ground).t;
            let room = room(tilt, (x + dx, z - dz), (end_x, end_z), held);
            let share = if whole > 0.0 { (room / whole).min(1.0) } else { 0.0 };
            let (gx, gz) = tilt.back(rest.t * share, 0.0);
            (x + dx + gx, z - dz - gz, rest.p, 0.0)
        } else {
            let left = element.length() - s;
            let (p, q) = (held.p_lo, held.q_lo);
            let (dx, dz) = if left > 0.0 { hang(left, p, q) } else { (0.0, 0.0) };
            (end_x - dx, end_z + dz, p + along * left, q + across * left)
        };
        let (horizontal, vertical) = tilt.back(p, q);
        let horizontal = if state.slack && horizontal.abs() <= 64.0 * ground.least { 0.0 } else { horizontal };
        Some(ShapePoint { arc: arc + s, segment, x, z, horizontal, vertical, on_bottom: lies })
    }
}

/// The room along the bottom between the touchdown and the place where the piece leaves it (m).
fn room(tilt: Tilt, touchdown: (f64, f64), end: (f64, f64), held: &Held) -> f64 {
    let (along, _) = tilt.turned(end.0 - touchdown.0, touchdown.1 - end.1);
    (along - held.lower.t).max(0.0)
}
