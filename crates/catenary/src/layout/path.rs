//! What lies: from the place where a span lands to the last one from which the line can leave.

use super::span::{Candidate, Departure, Kind, stretched};
use super::{Laid, Layout, Manner, Point, Stretch};
use crate::dual::{UNKNOWN, Var};
use crate::element::{Element, mean_strain, strain};
use crate::profile::Tilt;
use crate::refused::LineError;
use crate::state::Heap;

/// A piece of the path.
#[derive(Clone, Copy, Debug)]
struct Piece {
    /// Weight that lies before it, and on it (N).
    before: f64,
    weight: f64,
    what: What,
}

#[derive(Clone, Copy, Debug)]
enum What {
    /// A stretch along a face, with its tension at the upper end; `limp` when there is none.
    Lie { from: Point, face: usize, tension: Var, length: Var, limp: bool },
    /// A joint that presses on a face: the line's forces along and normal to it, with the joint's lift.
    Support { joint: usize, at: Point, face: usize, along: Var, normal: Var, lift: f64 },
    /// A ridge; the line comes to it at an angle and could leave it along the next face.
    Turn { vertex: usize, at: Point, tension: Var, angle: Var },
    /// Line in a heap.
    Heap { from: Point, to: f64 },
}

/// How the path ends.
#[derive(Clone, Copy, Debug)]
pub enum End {
    /// The line has to leave before: something lifts it, or a hollow is ahead.
    Lifted,
    /// It lies up to its end.
    Anchor(Point),
    /// Without tension: what is left slides down to a place at this distance from the anchor.
    Heap { at: Point, sump: f64 },
}

/// What lies.
#[derive(Clone, Debug)]
pub struct Path {
    pieces: Vec<Piece>,
    /// Weight of all of it (N).
    pub weight: f64,
    pub end: End,
}

/// A place on the path.
struct Cursor {
    at: Point,
    face: usize,
    tension: Var,
}

/// Length of a span over a hollow (share of the line's) that is left out.
const SHORTEST_SPAN: f64 = 1e-11;

impl Path {
    pub fn begins_with_heap(&self) -> bool {
        self.pieces.iter().any(|p| matches!(p.what, What::Heap { .. }))
    }

    fn push(&mut self, weight: f64, what: What) {
        let weight = weight.max(0.0);
        self.pieces.push(Piece { before: self.weight, weight, what });
        self.weight += weight;
    }
}

impl Layout<'_> {
    /// The path from a landing; `heap` is the length that lies in a heap there, `hollow` the place and length of one in a
    /// hollow of the bottom.
    pub fn path(
        &self,
        landing: &Candidate,
        heap: Option<Var>,
        hollow: Option<(f64, Var)>,
        laid: &mut Laid,
    ) -> Result<Path, LineError> {
        let mut path = Path { pieces: Vec::new(), weight: 0.0, end: End::Lifted };
        let at = landing.at;
        let mut cursor = match landing.kind {
            Kind::Tangent(face) => Cursor { at, face, tension: along(self.bottom.tilt(face), &at) },
            Kind::Vertex(vertex) => {
                let (h, v) = (at.h, at.v);
                let t = h.value.hypot(v.value);
                let tension = Var::function(t, [(h, h.value / t), (v, v.value / t)]);
                let angle = v.value.atan2(h.value);
                let angle = Var::function(angle, [(h, -v.value / (t * t)), (v, h.value / (t * t))]);
                self.turn(&mut path, vertex, at, tension, angle)
            }
            Kind::Joint(joint) => {
                let (above, _) = self.lifts(joint);
                let face = self.bottom.face(at.u.value);
                self.support(&mut path, joint, at, face, above)
            }
            Kind::Held(_) | Kind::End => return Ok(path),
        };
        if let Some(length) = heap {
            self.heaped(&mut path, &mut cursor, length)?;
            laid.heap = Some((Heap::Touchdown, length.value));
        }
        path.end = self.extend(&mut path, cursor);
        if let (End::Heap { at, sump }, Some((place, length))) = (path.end, hollow)
            && sump == place
        {
            let vertex = self.bottom.face(sump);
            let (u, z) = self.bottom.vertex(vertex);
            let at = Point { u: Var::fixed(u), z: Var::fixed(z), ..at };
            let tension = Var::fixed(self.least);
            let mut cursor = Cursor { at, face: vertex.saturating_sub(1), tension };
            self.heaped(&mut path, &mut cursor, length)?;
            laid.heap = Some((Heap::Hollow(sump), length.value));
            path.end = self.extend(&mut path, cursor);
        }
        if let End::Heap { at, sump } = path.end {
            let buoyant = self.elements.iter().skip(at.element).any(|e| e.weight() < 0.0)
                || (at.element..self.pulls.len()).any(|j| self.lifts(j).1 > 0.0);
            // what floats above a heap has no definite shape
            laid.vague |= buoyant || self.raised();
            let rest: f64 = self.elements.iter().skip(at.element).map(Element::length).sum();
            let place = if sump == 0.0 { Heap::Anchor } else { Heap::Hollow(sump) };
            laid.heap = Some((place, rest - at.s.value));
        }
        Ok(path)
    }

    /// Whether the anchor is above the bottom.
    fn raised(&self) -> bool {
        self.line.anchor > self.bottom.elevation_of(0, 0.0) + self.fine
    }

    fn extend(&self, path: &mut Path, mut cursor: Cursor) -> End {
        loop {
            let Some(element) = self.elements.get(cursor.at.element) else {
                if self.raised() {
                    return End::Lifted;
                }
                let tilt = self.bottom.tilt(cursor.face);
                let at = Point { h: cursor.tension * tilt.cos, v: cursor.tension * tilt.sin, ..cursor.at };
                return End::Anchor(at);
            };
            let tilt = self.bottom.tilt(cursor.face);
            if let Element::Length { segment, law, sees_bottom } = element {
                if segment.weight < 0.0 || !*sees_bottom {
                    return End::Lifted;
                }
                let loss = segment.weight * (tilt.sin + self.friction * tilt.cos);
                let mut length = -cursor.at.s + segment.length;
                let limp = loss > 0.0 && cursor.tension.value <= self.least;
                if limp && tilt.sin > self.friction * tilt.cos {
                    return End::Heap { at: cursor.at, sump: self.sump(cursor.face) };
                }
                let mut spent = false;
                if !limp && loss > 0.0 && (cursor.tension.value - self.least) < loss * length.value {
                    (length, spent) = ((cursor.tension + -self.least) * (1.0 / loss), true);
                }
                let mut reached = self.lie(&cursor, length, limp);
                let (edge, _) = self.bottom.extent(cursor.face);
                let mut at_edge = false;
                if reached.at.u.value < edge {
                    // the length up to the vertex, and how it changes
                    let rate = |c: &Cursor| {
                        let e = if limp { 0.0 } else { strain(segment, law.as_ref(), c.tension.value).0 };
                        tilt.cos * (1.0 + e)
                    };
                    let mut part = (cursor.at.u.value - edge) / rate(&cursor);
                    for _ in 0..100 {
                        let there = self.lie(&cursor, Var::fixed(part), limp);
                        let off = there.at.u.value - edge;
                        part = (part + off / rate(&there)).clamp(0.0, length.value);
                        if off.abs() <= self.fine {
                            break;
                        }
                    }
                    let there = self.lie(&cursor, Var::fixed(part), limp);
                    let by = rate(&there);
                    length = Var { value: part, by: there.at.u.by.map(|b| b / by) };
                    reached = self.lie(&cursor, length, limp);
                    (at_edge, spent) = (true, false);
                }
                let what = What::Lie { from: cursor.at, face: cursor.face, tension: cursor.tension, length, limp };
                path.push(segment.weight * length.value, what);
                cursor = reached;
                if at_edge {
                    let vertex = cursor.face;
                    if self.bottom.is_ridge(vertex) {
                        let angle = Var::fixed(tilt.angle());
                        cursor = self.turn(path, vertex, cursor.at, cursor.tension, angle);
                    } else {
                        let bend = tilt.angle() - self.bottom.tilt(vertex.saturating_sub(1)).angle();
                        let span = cursor.tension.value * bend;
                        if span > SHORTEST_SPAN * self.length * segment.weight {
                            return End::Lifted;
                        }
                        cursor.face = vertex.saturating_sub(1);
                    }
                    continue;
                }
                if spent {
                    cursor.tension = Var::fixed(self.least);
                    continue;
                }
            } else {
                let hung = self.hang(&forced(&cursor, tilt), Var::fixed(0.0));
                cursor.at = Point { h: Var::default(), v: Var::default(), ..hung };
            }
            let joint = cursor.at.element;
            if joint >= self.pulls.len() {
                cursor.at = Point { element: joint + 1, s: Var::fixed(0.0), ..cursor.at };
                continue;
            }
            let (above, below) = self.lifts(joint);
            let lift = if self.step(joint).is_some_and(|z| cursor.at.z.value < z) { below } else { above };
            if lift > 0.0 {
                return End::Lifted;
            }
            let at = forced(&cursor, tilt);
            cursor = self.support(path, joint, at, cursor.face, lift);
        }
    }

    /// Along a face for a length.
    fn lie(&self, from: &Cursor, length: Var, limp: bool) -> Cursor {
        let tilt = self.bottom.tilt(from.face);
        let Some(Element::Length { segment, law, .. }) = self.elements.get(from.at.element) else {
            return Cursor { ..*from };
        };
        let tension = from.tension;
        let (along, left) = if limp {
            (length, tension)
        } else {
            let loss = segment.weight * (tilt.sin + self.friction * tilt.cos);
            let left = tension - length * loss;
            let left = if left.value < self.least { Var::fixed(self.least) } else { left };
            let (mean, by) = mean_strain(segment, law.as_ref(), tension.value, left.value);
            let end = 1.0 + strain(segment, law.as_ref(), left.value).0;
            (Var::function(length.value * (1.0 + mean), [(tension, length.value * by), (length, end)]), left)
        };
        let at = Point {
            s: from.at.s + length,
            u: from.at.u - along * tilt.cos,
            z: from.at.z - along * tilt.sin,
            ..from.at
        };
        Cursor { at, face: from.face, tension: left }
    }

    /// A joint that presses on a face, and the line beyond it along that face.
    fn support(&self, path: &mut Path, joint: usize, at: Point, face: usize, lift: f64) -> Cursor {
        let tilt = self.bottom.tilt(face);
        let (along, normal) = turned(tilt, at.h, at.v + lift);
        let presses = -normal;
        if presses.value > 0.0 {
            path.push(presses.value, What::Support { joint, at, face, along, normal, lift });
        } else {
            path.push(0.0, What::Support { joint, at, face, along, normal: Var::fixed(0.0), lift });
        }
        let tension = if presses.value > 0.0 { along - presses * self.friction } else { along };
        let tension = if tension.value <= self.least { Var::fixed(self.least) } else { tension };
        let at = Point { element: joint + 1, s: Var::fixed(0.0), ..at };
        Cursor { at, face, tension }
    }

    /// A ridge, and the line beyond it along the next face.
    fn turn(&self, path: &mut Path, vertex: usize, at: Point, tension: Var, angle: Var) -> Cursor {
        let face = vertex.saturating_sub(1);
        let by = self.bottom.tilt(face).angle() - angle.value;
        path.push(tension.value * by, What::Turn { vertex, at, tension, angle });
        let next = self.turned_by(tension, -angle + self.bottom.tilt(face).angle());
        Cursor { at, face, tension: next }
    }

    /// The tension after a turn (Euler and Eytelwein).
    fn turned_by(&self, tension: Var, turn: Var) -> Var {
        let share = (-self.friction * turn.value).exp();
        let left =
            Var::function(tension.value * share, [(tension, share), (turn, -self.friction * tension.value * share)]);
        if left.value <= self.least { Var::fixed(self.least) } else { left }
    }

    /// Where what slides down a face comes to rest: the distance from the anchor.
    fn sump(&self, face: usize) -> f64 {
        let slides = |f: usize| {
            let tilt = self.bottom.tilt(f);
            tilt.sin > self.friction * tilt.cos
        };
        let mut last = face;
        while last > 0 && slides(last - 1) {
            last -= 1;
        }
        if last == 0 { 0.0 } else { self.bottom.vertex(last).0 }
    }

    /// A length of line in a heap at the beginning of a path.
    fn heaped(&self, path: &mut Path, cursor: &mut Cursor, length: Var) -> Result<(), LineError> {
        let mut left = length;
        loop {
            let Some(element) = self.elements.get(cursor.at.element) else { return Ok(()) };
            if element.weight() < 0.0 {
                return Err(LineError::SlackSlope);
            }
            let room = -cursor.at.s + element.length();
            let part = if left.value < room.value { left } else { room };
            let from = cursor.at;
            cursor.at.s = from.s + part;
            path.push(0.0, What::Heap { from, to: cursor.at.s.value });
            cursor.tension = Var::fixed(self.least);
            if left.value < room.value {
                return Ok(());
            }
            left = left - room;
            let joint = from.element;
            if joint < self.pulls.len() {
                let (above, below) = self.lifts(joint);
                let lift = if self.step(joint).is_some_and(|z| cursor.at.z.value < z) { below } else { above };
                if lift > 0.0 {
                    return Err(LineError::SlackSlope);
                }
                let tilt = self.bottom.tilt(cursor.face);
                let (at, face) = (cursor.at, cursor.face);
                let none = Var::fixed(0.0);
                path.push(
                    0.0,
                    What::Support { joint, at, face, along: none, normal: Var::fixed(lift * tilt.cos), lift },
                );
            }
            cursor.at = Point { element: joint + 1, s: Var::fixed(0.0), ..cursor.at };
        }
    }

    /// The place where so much weight lies before, and the curve that leaves there.
    pub fn leave(&self, path: &Path, unknown: f64) -> Departure {
        let index = path.pieces.partition_point(|p| p.before <= unknown).max(1) - 1;
        let Some(piece) = path.pieces.get(index) else {
            return Departure { point: Point { h: Var::fixed(f64::NAN), ..Point::default() }, face: None };
        };
        let share = (unknown - piece.before).clamp(0.0, piece.weight);
        match piece.what {
            What::Lie { from, face, tension, length, limp } => {
                let weight = match self.elements.get(from.element) {
                    Some(Element::Length { segment, .. }) if segment.weight > 0.0 => segment.weight,
                    _ => return self.departure(Cursor { at: from, face, tension }),
                };
                let arc = Var::parameter(from.s.value + (share / weight).min(length.value), UNKNOWN, 1.0 / weight);
                let there = self.lie(&Cursor { at: from, face, tension }, arc - from.s, limp);
                self.departure(Cursor { at: Point { s: arc, ..there.at }, ..there })
            }
            What::Support { joint, at, face, along, normal, .. } => {
                let carried = Var::parameter(share, UNKNOWN, 1.0);
                let tilt = self.bottom.tilt(face);
                let normal = normal + carried;
                // friction leaves the line beyond at least upright
                let tension = along - carried * self.friction;
                let upright = (normal * tilt.sin + self.least) * (1.0 / tilt.cos);
                let tension = if tension.value <= upright.value { upright } else { tension };
                let h = tension * tilt.cos - normal * tilt.sin;
                let v = tension * tilt.sin + normal * tilt.cos;
                let point = Point { element: joint + 1, s: Var::fixed(0.0), h, v, ..at };
                Departure { point, face: Some(face) }
            }
            What::Turn { vertex, at, tension, angle } => {
                let slope = 1.0 / tension.value;
                let turn = Var::parameter(share * slope, UNKNOWN, slope);
                let left = self.turned_by(tension, turn);
                let angle = angle + turn;
                let (sin, cos) = angle.value.sin_cos();
                let h = Var::function(left.value * cos, [(left, cos), (angle, -left.value * sin)]);
                let v = Var::function(left.value * sin, [(left, sin), (angle, left.value * cos)]);
                Departure { point: Point { h, v, ..at }, face: Some(vertex.saturating_sub(1)) }
            }
            What::Heap { from, .. } => Departure { point: from, face: None },
        }
    }

    /// A curve that leaves a face along it.
    fn departure(&self, cursor: Cursor) -> Departure {
        let tilt = self.bottom.tilt(cursor.face);
        Departure { point: forced(&cursor, tilt), face: Some(cursor.face) }
    }

    /// Keeps what lies up to a departure, or all of it.
    pub fn record_path(&self, path: &Path, departure: Option<&Point>, laid: &mut Laid) {
        let leaves = |at: &Point| departure.is_some_and(|d| d.element == at.element);
        for piece in &path.pieces {
            match piece.what {
                What::Lie { from, face, tension, length, limp } => {
                    let tilt = self.bottom.tilt(face);
                    let start = Cursor { at: from, face, tension };
                    let end = from.s.value + length.value;
                    let stop = departure.filter(|d| leaves(&from) && d.s.value <= end);
                    let length = stop.map_or(length, |d| d.s - from.s);
                    if stop.is_some() && length.value <= 0.0 {
                        return;
                    }
                    let low = self.lie(&start, length, limp);
                    let loss = match self.elements.get(from.element) {
                        Some(Element::Length { segment, .. }) if !limp => {
                            segment.weight * (tilt.sin + self.friction * tilt.cos)
                        }
                        _ => 0.0,
                    };
                    let (at, low) = (forced(&start, tilt), forced(&low, tilt));
                    laid.stretches.push(stretched(&at, &low, Manner::Lies { tilt, loss }));
                    if stop.is_some() {
                        return;
                    }
                }
                What::Support { joint, at, face, normal, lift, .. } => {
                    // the curve may leave at the joint itself, which then carries what is missing
                    let tilt = self.bottom.tilt(face);
                    let here = departure.filter(|d| d.element == joint + 1 && d.s.value == 0.0);
                    let carried = here.map_or(-normal.value, |d| {
                        let (_, q) = tilt.turned(d.h.value, d.v.value);
                        (q - normal.value).clamp(0.0, (-normal.value).max(0.0))
                    });
                    self.keep_joint(joint, &at, (lift, carried), [false, false], laid);
                }
                What::Turn { .. } => {}
                What::Heap { from, to } => {
                    let low = Point { s: Var::fixed(to), ..from };
                    laid.stretches.push(heap_stretch(&from, &low));
                }
            }
        }
        if let (None, End::Heap { at, sump }) = (departure, path.end) {
            let z = Var::fixed(self.bottom.elevation(sump));
            for element in at.element..self.elements.len() {
                let s = if element == at.element { at.s } else { Var::fixed(0.0) };
                let from = Point { element, s, u: Var::fixed(sump), z, ..Point::default() };
                let low = Point { s: Var::fixed(self.element_length(element)), ..from };
                laid.stretches.push(heap_stretch(&from, &low));
                if element < self.pulls.len() {
                    let (lift, _) = self.lifts(element);
                    let cos = self.bottom.tilt(self.bottom.face(sump)).cos;
                    self.keep_joint(element, &from, (lift, -lift * cos), [false, false], laid);
                }
            }
        }
    }
}

fn heap_stretch(from: &Point, low: &Point) -> Stretch {
    let none = Var::fixed(0.0);
    let still = |p: &Point| Point { h: none, v: none, ..*p };
    stretched(&still(from), &still(low), Manner::Heap)
}

/// The point of a cursor with its forces.
fn forced(cursor: &Cursor, tilt: Tilt) -> Point {
    Point { h: cursor.tension * tilt.cos, v: cursor.tension * tilt.sin, ..cursor.at }
}

fn along(tilt: Tilt, at: &Point) -> Var {
    turned(tilt, at.h, at.v).0
}

/// Components along and normal to a face.
fn turned(tilt: Tilt, h: Var, v: Var) -> (Var, Var) {
    (h * tilt.cos + v * tilt.sin, v * tilt.cos - h * tilt.sin)
}
