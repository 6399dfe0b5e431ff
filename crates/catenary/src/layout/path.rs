//! What lies: from the place where a span lands to the last one from which the line can leave.

use super::span::{Departure, TouchCandidate, TouchKind, stretch_between};
use super::{LaidLine, LineLayout, LinePoint, PieceStretch, SupportMode};
use crate::dual::{SPAN_UNKNOWN, Var};
use crate::element::{LinePiece, mean_strain, strain};
use crate::profile::Tilt;
use crate::state::Heap;

/// A piece of the path.
#[derive(Clone, Copy, Debug)]
struct PathPiece {
    /// Weight that lies before it, and on it (N).
    before: f64,
    weight: f64,
    /// What is left of the spare length: before a heap, behind any other piece.
    spare: Spare,
    what: PathPieceKind,
}

#[derive(Clone, Copy, Debug)]
enum PathPieceKind {
    /// A stretch along a face, with its tension at the upper end; `limp` when there is none.
    Lie { from: LinePoint, face: usize, tension: Var, length: Var, limp: bool },
    /// A joint that presses on a face: the line's forces along and normal to it, with the joint's lift.
    Support { joint: usize, at: LinePoint, face: usize, along: Var, normal: Var, lift: f64 },
    /// A ridge; the line comes to it at an angle and could leave it along the next face.
    Turn { vertex: usize, at: LinePoint, tension: Var, angle: Var },
    /// The place from which the line slides down to the anchor, without tension.
    Slide { from: LinePoint },
    /// Line in a heap: so much of it, from a point on.
    Heap { from: LinePoint, length: Var },
}

/// Length without tension that has to lie in a heap.
#[derive(Clone, Copy, Debug)]
pub enum Spare {
    None,
    Length(Var),
    /// All that comes.
    All,
}

impl Spare {
    /// What is left when so much lies.
    fn less(self, length: Var) -> Spare {
        match self {
            Spare::Length(left) if left.value > length.value => Spare::Length(left - length),
            Spare::Length(_) => Spare::None,
            other => other,
        }
    }
}

/// How the path ends.
#[derive(Clone, Copy, Debug)]
pub enum PathEnd {
    /// The line has to leave before: something lifts it, or a hollow is ahead.
    Lifted,
    /// It lies up to its end.
    Anchor(LinePoint),
    /// Without tension: what is left slides down to a hollow at this distance from the anchor.
    Hollow { at: LinePoint, sump: f64 },
}

/// What lies.
#[derive(Clone, Debug)]
pub struct LaidPath {
    pieces: Vec<PathPiece>,
    /// Weight of all of it (N).
    pub weight: f64,
    pub end: PathEnd,
    /// The spare length that is left at its beginning and behind it.
    begun: Spare,
    spare: Spare,
}

/// What comes behind a piece of the path.
enum PathContinuation {
    /// The joint at the end of the line's piece.
    Joint,
    /// More of the same piece.
    Piece,
    /// Nothing: the path ends.
    Stop,
}

/// A place on the path.
struct Cursor {
    at: LinePoint,
    face: usize,
    tension: Var,
}

/// Length of a span over a hollow (share of the line's) that is left out.
const SHORTEST_SPAN: f64 = 1e-11;

impl LaidPath {
    /// What is left of the spare length where the line leaves.
    pub fn spare_at(&self, departure: &Departure) -> Spare {
        match self.pieces.get(departure.piece) {
            Some(PathPiece { what: PathPieceKind::Heap { from, .. }, spare, .. }) => {
                spare.less(departure.point.s - from.s)
            }
            Some(piece) => piece.spare,
            None => self.begun,
        }
    }

    /// Places on it, from its end to its beginning, as the weights (N) that lie before them: the ends of its pieces, and so many parts
    /// of each.
    pub fn places(&self, parts: usize) -> impl Iterator<Item = f64> {
        let part_of =
            move |piece: &PathPiece, part: usize| piece.before + piece.weight * (1.0 - part as f64 / parts as f64);
        self.pieces.iter().rev().flat_map(move |piece| (0..parts).map(move |part| part_of(piece, part))).chain([0.0])
    }

    fn push(&mut self, weight: f64, what: PathPieceKind) {
        let weight = weight.max(0.0);
        self.pieces.push(PathPiece { before: self.weight, weight, spare: self.spare, what });
        self.weight += weight;
    }
}

impl LineLayout<'_> {
    /// The path from a landing; `spare` lies in a heap there, and `hollow` is the place and length of a heap in a hollow
    /// of the bottom.
    pub fn path(
        &self,
        landing: &TouchCandidate,
        spare: Spare,
        hollow: Option<(f64, Var)>,
        laid: &mut LaidLine,
    ) -> LaidPath {
        let mut path = LaidPath { pieces: Vec::new(), weight: 0.0, end: PathEnd::Lifted, begun: spare, spare };
        let at = landing.at;
        let cursor = match landing.kind {
            TouchKind::Tangent(face) => Cursor { at, face, tension: along_face(self.bottom.tilt(face), &at) },
            TouchKind::Vertex(vertex) => {
                let (h, v) = (at.h, at.v);
                let t = h.value.hypot(v.value);
                let tension = Var::function(t, [(h, h.value / t), (v, v.value / t)]);
                let angle = v.value.atan2(h.value);
                let angle = Var::function(angle, [(h, -v.value / (t * t)), (v, h.value / (t * t))]);
                self.turn(&mut path, vertex, at, tension, angle)
            }
            TouchKind::Joint(joint) => {
                let (above, _) = self.lifts(joint);
                let face = self.bottom.face(at.u.value);
                self.support(&mut path, joint, at, face, above)
            }
            TouchKind::Held(_) | TouchKind::End => return path,
        };
        if let Spare::Length(_) = spare {
            laid.heap = laid.heap.or(Some((Heap::Touchdown, 0.0)));
        }
        self.extend(&mut path, cursor);
        if let PathEnd::Hollow { at, sump } = path.end {
            let rest: f64 = self.elements.iter().skip(at.element).map(LinePiece::length).sum();
            laid.heap = Some((Heap::Hollow(sump), rest - at.s.value));
            if let Some((position, length)) = hollow
                && sump == position
            {
                let vertex = self.bottom.face(sump);
                let (u, z) = self.bottom.vertex(vertex);
                let at = LinePoint { u: Var::constant(u), z: Var::constant(z), ..at };
                let cursor = Cursor { at, face: vertex.saturating_sub(1), tension: Var::constant(self.least) };
                laid.heap = Some((Heap::Hollow(sump), 0.0));
                path.spare = Spare::Length(length);
                path.end = PathEnd::Lifted;
                self.extend(&mut path, cursor);
            }
        }
        path
    }

    /// Whether the anchor is above the bottom.
    fn is_anchor_raised(&self) -> bool {
        self.line.anchor > self.bottom.elevation_of(0, 0.0) + self.fine
    }

    /// Goes on with a path that could be lifted anywhere, up to where it must be or to its end.
    fn extend(&self, path: &mut LaidPath, mut cursor: Cursor) {
        loop {
            let tilt = self.bottom.tilt(cursor.face);
            let Some(element) = self.elements.get(cursor.at.element) else {
                if !self.is_anchor_raised() {
                    path.end = PathEnd::Anchor(with_forces(&cursor, tilt));
                }
                return;
            };
            if let LinePiece::Length { segment, sees_bottom, .. } = element {
                if segment.weight < 0.0 || !*sees_bottom {
                    return;
                }
                let next = match path.spare {
                    Spare::None => self.follow_seabed(path, &mut cursor),
                    spare => self.heap(path, &mut cursor, spare),
                };
                match next {
                    PathContinuation::Joint => {}
                    PathContinuation::Piece => continue,
                    PathContinuation::Stop => return,
                }
            } else {
                let hung = self.hang(&with_forces(&cursor, tilt), Var::constant(0.0));
                cursor.at = LinePoint { h: Var::default(), v: Var::default(), ..hung };
            }
            let joint = cursor.at.element;
            if joint >= self.pulls.len() {
                cursor.at = LinePoint { element: joint + 1, s: Var::constant(0.0), ..cursor.at };
                continue;
            }
            let (above, below) = self.lifts(joint);
            let lift = if self.step(joint).is_some_and(|z| cursor.at.z.value < z) { below } else { above };
            if lift > 0.0 {
                return;
            }
            let at = with_forces(&cursor, self.bottom.tilt(cursor.face));
            cursor = self.support(path, joint, at, cursor.face, lift);
        }
    }

    /// Heaps the rest of a piece, or what is left of the spare length.
    fn heap(&self, path: &mut LaidPath, cursor: &mut Cursor, spare: Spare) -> PathContinuation {
        let from = cursor.at;
        let room = -from.s + self.element_length(from.element);
        let (length, next) = match spare {
            Spare::Length(left) if left.value < room.value => (left, PathContinuation::Piece),
            _ => (room, PathContinuation::Joint),
        };
        let weight = self.elements[from.element].weight_per_length();
        path.push(weight * length.value, PathPieceKind::Heap { from, length });
        path.spare = spare.less(length);
        cursor.at.s = from.s + length;
        cursor.tension = Var::constant(self.least);
        next
    }

    /// Lies on a face: up to the end of the piece, to the next face, or to where no tension is left.
    fn follow_seabed(&self, path: &mut LaidPath, cursor: &mut Cursor) -> PathContinuation {
        let tilt = self.bottom.tilt(cursor.face);
        let Some(LinePiece::Length { segment, law, .. }) = self.elements.get(cursor.at.element) else {
            return PathContinuation::Joint;
        };
        let loss = segment.weight * (tilt.sin + self.friction * tilt.cos);
        let mut length = -cursor.at.s + segment.length;
        let limp = loss > 0.0 && cursor.tension.value <= self.least;
        if limp && tilt.sin > self.friction * tilt.cos {
            let sump = self.sump(cursor.face);
            if sump > 0.0 {
                path.end = PathEnd::Hollow { at: cursor.at, sump };
                return PathContinuation::Stop;
            }
            path.push(0.0, PathPieceKind::Slide { from: cursor.at });
            path.spare = Spare::All;
            let (u, z) = (Var::constant(0.0), Var::constant(self.bottom.elevation_of(0, 0.0)));
            *cursor = Cursor { at: LinePoint { u, z, ..cursor.at }, face: 0, tension: Var::constant(self.least) };
            return PathContinuation::Piece;
        }
        let mut spent = false;
        if !limp && loss > 0.0 && (cursor.tension.value - self.least) < loss * length.value {
            (length, spent) = ((cursor.tension + -self.least) * (1.0 / loss), true);
        }
        let mut reached = self.lie(cursor, length, limp);
        let (edge, _) = self.bottom.extent(cursor.face);
        let mut at_edge = false;
        if reached.at.u.value < edge {
            // the length up to the vertex, and how it changes
            let rate = |c: &Cursor| {
                let e = if limp { 0.0 } else { strain(segment, law.as_ref(), c.tension.value).0 };
                tilt.cos * (1.0 + e)
            };
            let mut part = (cursor.at.u.value - edge) / rate(cursor);
            for _ in 0..100 {
                let there = self.lie(cursor, Var::constant(part), limp);
                let off = there.at.u.value - edge;
                part = (part + off / rate(&there)).min(length.value).max(0.0);
                if off.abs() <= self.fine {
                    break;
                }
            }
            let there = self.lie(cursor, Var::constant(part), limp);
            let by = rate(&there);
            length = Var { value: part, by: there.at.u.by.map(|b| b / by) };
            reached = self.lie(cursor, length, limp);
            (at_edge, spent) = (true, false);
        }
        let what = PathPieceKind::Lie { from: cursor.at, face: cursor.face, tension: cursor.tension, length, limp };
        path.push(segment.weight * length.value, what);
        *cursor = reached;
        if at_edge {
            let vertex = cursor.face;
            if self.bottom.is_ridge(vertex) {
                let angle = Var::constant(tilt.angle());
                *cursor = self.turn(path, vertex, cursor.at, cursor.tension, angle);
            } else {
                let bend = tilt.angle() - self.bottom.tilt(vertex.saturating_sub(1)).angle();
                let span = cursor.tension.value * bend;
                if span > SHORTEST_SPAN * self.length * segment.weight {
                    return PathContinuation::Stop;
                }
                cursor.face = vertex.saturating_sub(1);
            }
            return PathContinuation::Piece;
        }
        if spent {
            cursor.tension = Var::constant(self.least);
            return PathContinuation::Piece;
        }
        PathContinuation::Joint
    }

    /// Along a face for a length.
    fn lie(&self, from: &Cursor, length: Var, limp: bool) -> Cursor {
        let tilt = self.bottom.tilt(from.face);
        let Some(LinePiece::Length { segment, law, .. }) = self.elements.get(from.at.element) else {
            return Cursor { ..*from };
        };
        let tension = from.tension;
        let (along, left) = if limp {
            (length, tension)
        } else {
            let loss = segment.weight * (tilt.sin + self.friction * tilt.cos);
            let left = tension - length * loss;
            let left = if left.value < self.least { Var::constant(self.least) } else { left };
            let (mean, by) = mean_strain(segment, law.as_ref(), tension.value, left.value);
            let end = 1.0 + strain(segment, law.as_ref(), left.value).0;
            (Var::function(length.value * (1.0 + mean), [(tension, length.value * by), (length, end)]), left)
        };
        let at = LinePoint {
            s: from.at.s + length,
            u: from.at.u - along * tilt.cos,
            z: from.at.z - along * tilt.sin,
            ..from.at
        };
        Cursor { at, face: from.face, tension: left }
    }

    /// A joint that presses on a face, and the line beyond it along that face.
    fn support(&self, path: &mut LaidPath, joint: usize, at: LinePoint, face: usize, lift: f64) -> Cursor {
        let tilt = self.bottom.tilt(face);
        let (along, normal) = to_face(tilt, at.h, at.v + lift);
        let presses = if normal.value < 0.0 { -normal } else { Var::constant(0.0) };
        let pulled = along - presses * self.friction;
        let held = self.heap_resistance(path, pulled, presses);
        path.push(
            presses.value,
            PathPieceKind::Support { joint, at, face, along: along - held, normal: -presses, lift },
        );
        let tension = pulled - held;
        let tension = if tension.value <= self.least { Var::constant(self.least) } else { tension };
        let at = LinePoint { element: joint + 1, s: Var::constant(0.0), ..at };
        Cursor { at, face, tension }
    }

    /// What a heap holds of the force that pulls a joint down its face. A joint at the edge of a heap takes as much of the
    /// spare length as a line of its weight, and is held by the share of that which is there: so no force is jumped over.
    fn heap_resistance(&self, path: &mut LaidPath, pulled: Var, presses: Var) -> Var {
        match path.spare {
            Spare::Length(left) if pulled.value > self.least => {
                let all = presses * (self.length / self.weight);
                path.spare = path.spare.less(all);
                if left.value >= all.value {
                    return pulled;
                }
                let share = left.value / all.value;
                let by_left = pulled.value / all.value;
                Var::function(pulled.value * share, [(pulled, share), (left, by_left), (all, -by_left * share)])
            }
            _ => Var::constant(0.0),
        }
    }

    /// A ridge, and the line beyond it along the next face.
    fn turn(&self, path: &mut LaidPath, vertex: usize, at: LinePoint, tension: Var, angle: Var) -> Cursor {
        let face = vertex.saturating_sub(1);
        let by = self.bottom.tilt(face).angle() - angle.value;
        path.push(tension.value * by, PathPieceKind::Turn { vertex, at, tension, angle });
        let next = self.tension_after_turn(tension, -angle + self.bottom.tilt(face).angle());
        Cursor { at, face, tension: next }
    }

    /// The tension after a turn (Euler and Eytelwein).
    fn tension_after_turn(&self, tension: Var, turn: Var) -> Var {
        let share = (-self.friction * turn.value).exp();
        let left =
            Var::function(tension.value * share, [(tension, share), (turn, -self.friction * tension.value * share)]);
        if left.value <= self.least { Var::constant(self.least) } else { left }
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

    /// The place where so much weight lies before, and the curve that leaves there.
    pub fn leave(&self, path: &LaidPath, unknown: f64) -> Departure {
        let index = path.pieces.partition_point(|p| p.before <= unknown).max(1) - 1;
        let Some(piece) = path.pieces.get(index) else {
            return Departure {
                point: LinePoint { h: Var::constant(f64::NAN), ..LinePoint::default() },
                face: None,
                piece: index,
                unknown,
            };
        };
        let share = (unknown - piece.before).clamp(0.0, piece.weight);
        match piece.what {
            PathPieceKind::Lie { from, face, tension, length, limp } => {
                let weight = match self.elements.get(from.element) {
                    Some(LinePiece::Length { segment, .. }) if segment.weight > 0.0 => segment.weight,
                    _ => return self.departure(Cursor { at: from, face, tension }, (index, unknown)),
                };
                let arc = Var::parameter(from.s.value + (share / weight).min(length.value), SPAN_UNKNOWN, 1.0 / weight);
                let there = self.lie(&Cursor { at: from, face, tension }, arc - from.s, limp);
                self.departure(Cursor { at: LinePoint { s: arc, ..there.at }, ..there }, (index, unknown))
            }
            PathPieceKind::Support { joint, at, face, along, normal, .. } => {
                let carried = Var::parameter(share, SPAN_UNKNOWN, 1.0);
                let tilt = self.bottom.tilt(face);
                let normal = normal + carried;
                // friction leaves the line beyond at least upright
                let tension = along - carried * self.friction;
                let upright = (normal * tilt.sin + self.least) * (1.0 / tilt.cos);
                let tension = if tension.value <= upright.value { upright } else { tension };
                let h = tension * tilt.cos - normal * tilt.sin;
                let v = tension * tilt.sin + normal * tilt.cos;
                let point = LinePoint { element: joint + 1, s: Var::constant(0.0), h, v, ..at };
                Departure { point, face: Some(face), piece: index, unknown }
            }
            PathPieceKind::Turn { vertex, at, tension, angle } => {
                let slope = 1.0 / tension.value;
                let turn = Var::parameter(share * slope, SPAN_UNKNOWN, slope);
                let left = self.tension_after_turn(tension, turn);
                let angle = angle + turn;
                let (sin, cos) = angle.value.sin_cos();
                let h = Var::function(left.value * cos, [(left, cos), (angle, -left.value * sin)]);
                let v = Var::function(left.value * sin, [(left, sin), (angle, left.value * cos)]);
                Departure {
                    point: LinePoint { h, v, ..at },
                    face: Some(vertex.saturating_sub(1)),
                    piece: index,
                    unknown,
                }
            }
            PathPieceKind::Slide { from } => Departure { point: from, face: None, piece: index, unknown },
            PathPieceKind::Heap { from, length, .. } => {
                let cursor =
                    Cursor { at: from, face: self.bottom.face(from.u.value), tension: Var::constant(self.least) };
                let weight = self.elements[from.element].weight_per_length();
                if weight <= 0.0 {
                    return self.departure(cursor, (index, unknown));
                }
                let arc = Var::parameter(from.s.value + (share / weight).min(length.value), SPAN_UNKNOWN, 1.0 / weight);
                self.departure(Cursor { at: LinePoint { s: arc, ..from }, ..cursor }, (index, unknown))
            }
        }
    }

    /// A curve that leaves a face along it.
    fn departure(&self, cursor: Cursor, (piece, unknown): (usize, f64)) -> Departure {
        let tilt = self.bottom.tilt(cursor.face);
        Departure { point: with_forces(&cursor, tilt), face: Some(cursor.face), piece, unknown }
    }

    /// Keeps what lies up to a departure, or all of it.
    pub fn record_path(&self, path: &LaidPath, departure: Option<&Departure>, laid: &mut LaidLine) {
        let until = departure.map_or(path.pieces.len(), |d| d.piece.saturating_add(1));
        for (index, piece) in path.pieces.iter().enumerate().take(until) {
            let here = departure.filter(|d| d.piece == index).map(|d| d.point);
            match piece.what {
                PathPieceKind::Lie { from, face, tension, length, limp } => {
                    let tilt = self.bottom.tilt(face);
                    let start = Cursor { at: from, face, tension };
                    let length = here.map_or(length, |d| d.s - from.s);
                    if here.is_some() && length.value <= 0.0 {
                        return;
                    }
                    let low = self.lie(&start, length, limp);
                    let loss = match self.elements.get(from.element) {
                        Some(LinePiece::Length { segment, .. }) if !limp => {
                            segment.weight * (tilt.sin + self.friction * tilt.cos)
                        }
                        _ => 0.0,
                    };
                    let (at, low) = (with_forces(&start, tilt), with_forces(&low, tilt));
                    laid.stretches.push(stretch_between(&at, &low, SupportMode::Lies { tilt, loss }));
                }
                PathPieceKind::Support { joint, at, face, normal, lift, .. } => {
                    // the curve may leave at the joint itself, which then carries what is missing
                    let tilt = self.bottom.tilt(face);
                    let carried = here.map_or(-normal.value, |d| {
                        let (_, q) = tilt.to_face(d.h.value, d.v.value);
                        (q - normal.value).clamp(0.0, (-normal.value).max(0.0))
                    });
                    self.keep_joint(joint, &at, lift, carried, [false, false], laid);
                }
                PathPieceKind::Turn { .. } => {}
                PathPieceKind::Slide { from } => laid.slide(&from),
                PathPieceKind::Heap { from, length } => {
                    let length = here.map_or(length.value, |d| d.s.value - from.s.value);
                    if here.is_some() && length <= 0.0 {
                        return;
                    }
                    if let Some((_, heaped)) = &mut laid.heap {
                        *heaped += length;
                    }
                    let low = LinePoint { s: from.s + length, ..from };
                    laid.stretches.push(heap_stretch(&from, &low));
                }
            }
        }
    }
}

fn heap_stretch(from: &LinePoint, low: &LinePoint) -> PieceStretch {
    let none = Var::constant(0.0);
    let still = |p: &LinePoint| LinePoint { h: none, v: none, ..*p };
    stretch_between(&still(from), &still(low), SupportMode::Heap)
}

/// The point of a cursor with its forces.
fn with_forces(cursor: &Cursor, tilt: Tilt) -> LinePoint {
    LinePoint { h: cursor.tension * tilt.cos, v: cursor.tension * tilt.sin, ..cursor.at }
}

fn along_face(tilt: Tilt, at: &LinePoint) -> Var {
    to_face(tilt, at.h, at.v).0
}

/// Components along and normal to a face.
fn to_face(tilt: Tilt, h: Var, v: Var) -> (Var, Var) {
    (h * tilt.cos + v * tilt.sin, v * tilt.cos - h * tilt.sin)
}
