//! A span: the free curve that just touches what it must not pass.

use super::path::{LaidPath, Spare};
use super::{JointAt, LaidLine, LineLayout, LinePoint, PieceStretch, SpanStart, SupportMode, Top};
use crate::dual::{SPAN_UNKNOWN, Var};
use crate::element::{LinePiece, strain, stretch};
use crate::error::LineError;
use crate::line::Segment;
use crate::stretch_law::StretchLaw;
use windlass_nonlinear::{Convergence, NewtonBracket, NewtonSearch};

/// What a curve may touch.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum TouchKind {
    /// A face, along which the line goes on.
    Tangent(usize),
    /// A ridge.
    Vertex(usize),
    /// The bottom, with a joint.
    Joint(usize),
    /// The step of a joint's lift.
    Held(usize),
    /// The height of the anchor, with its end.
    End,
}

/// A place where a curve touches, or by how much it does not.
#[derive(Clone, Copy, Debug)]
pub struct TouchCandidate {
    pub kind: TouchKind,
    /// Height above what is touched (m).
    pub gap: Var,
    pub at: LinePoint,
}

impl TouchCandidate {
    /// How much the unknown may grow until it touches.
    fn room(&self) -> f64 {
        let slope = self.gap.by_unknown();
        if slope < 0.0 {
            -self.gap.value / slope
        } else if self.gap.value < 0.0 {
            f64::NEG_INFINITY
        } else {
            f64::INFINITY
        }
    }
}

/// Where a curve begins, and the face that it leaves.
#[derive(Clone, Copy, Debug)]
pub struct Departure {
    pub point: LinePoint,
    pub face: Option<usize>,
    /// The piece of the path in which it is.
    pub piece: usize,
    /// The unknown of its span (N).
    pub unknown: f64,
}

/// Steps after which a search gives up.
const MAX_SEARCH_STEPS: usize = 200;
/// Parts of a piece that lies, between which a span is tried in search of the last one that can leave.
const PLACES_IN_PIECE: usize = 16;
/// Steps after which every other one halves the bracket.
const NEWTON_STEPS: usize = 25;

impl LineLayout<'_> {
    /// The beginning of a span with its unknown at a value: the vertical force, the lift of the joint, or the weight that
    /// lies before it.
    pub fn depart(&self, origin: &SpanStart, top: &Top, unknown: f64) -> Departure {
        match origin {
            SpanStart::Fairlead => {
                let v = Var::parameter(unknown, SPAN_UNKNOWN, 1.0);
                let point = LinePoint { element: 0, s: Var::constant(0.0), u: top.u, z: top.z, h: top.h, v };
                Departure { point, face: None, piece: 0, unknown }
            }
            SpanStart::Held { before, .. } => {
                let v = before.v + Var::parameter(unknown, SPAN_UNKNOWN, 1.0);
                let point = LinePoint { element: before.element + 1, s: Var::constant(0.0), v, ..*before };
                Departure { point, face: None, piece: 0, unknown }
            }
            SpanStart::Ground(path) => self.leave(path, unknown),
        }
    }

    /// Finds the span: its beginning and where it lands.
    ///
    /// # Errors
    /// A span whose beginning is not found.
    pub fn next_span(
        &self,
        origin: &SpanStart,
        top: &Top,
        sunk: &[bool],
        laid: &mut LaidLine,
    ) -> Result<(Departure, TouchCandidate), LineError> {
        let span = laid.left_at.len();
        let hold = |span: usize| top.holds.iter().find(|h| h.span == span);
        let lands_in = hold(span + 1).and_then(|h| h.lands_in);
        if let (Some(hold), SpanStart::Ground(_)) = (hold(span), origin) {
            let departure = self.depart(origin, top, hold.weight);
            let landing = self.least_of(&departure, sunk, lands_in, |c| c.gap.value);
            // a buoy that sinks has the span found once more
            laid.gaps.retain(|(held, _)| *held != span);
            laid.gaps.push((span, landing.gap.value));
            return Ok(self.land_span(origin, hold.weight, departure, landing, laid));
        }
        let (bracket, mut at) = match origin {
            SpanStart::Fairlead => {
                let guess = 0.5 * self.weight + top.h.value * 0.1;
                (NewtonBracket::OPEN, top.near.unwrap_or(guess))
            }
            SpanStart::Held { low, high, .. } => (NewtonBracket::new(*low, *high), 0.5 * (low + high)),
            SpanStart::Ground(path) if self.thorough => self.last_departures(origin, top, path, (sunk, lands_in)),
            SpanStart::Ground(path) => (NewtonBracket::new(0.0, path.weight), path.weight),
        };
        let mut search = NewtonSearch::new(bracket, self.weight + top.h.value);
        let mut convergence = Convergence::new(self.fine);
        let mut best: Option<(f64, Departure, TouchCandidate)> = None;
        let mut steps = 0;
        while steps < MAX_SEARCH_STEPS {
            steps += 1;
            let departure = self.depart(origin, top, at);
            let found = self.least_of(&departure, sunk, lands_in, TouchCandidate::room);
            let gap = found.gap.value;
            if gap.is_nan() {
                break;
            }
            let status = convergence.record(gap.abs());
            let newton = at + found.room();
            if status.is_improved() || best.is_none() {
                best = Some((at, departure, found));
            }
            if status.is_final() {
                break;
            }
            // the gap falls with the unknown
            let wanted = steps < NEWTON_STEPS || steps % 2 == 0;
            let next = search.advance(at, -gap, if wanted { newton } else { f64::NAN });
            if next == at || search.bracket.is_narrower_than(2.0) {
                break;
            }
            at = next;
        }
        laid.iterations += steps;
        let Some((unknown, departure, landing)) = best else {
            return Err(LineError::NotConverged { force: top.h.value, residual: f64::NAN, iterations: steps });
        };
        Ok(self.land_span(origin, unknown, departure, landing, laid))
    }

    /// The weights (N) between which the last place is from which a span can leave a path, and one to begin with: what lies is gone
    /// along from its end, by pieces and parts of them, to where the curve no longer passes below what it must not pass.
    fn last_departures(
        &self,
        origin: &SpanStart,
        top: &Top,
        path: &LaidPath,
        (sunk, lands_in): (&[bool], Option<usize>),
    ) -> (NewtonBracket, f64) {
        let passes_below = |weight: f64| {
            let departure = self.depart(origin, top, weight);
            self.least_of(&departure, sunk, lands_in, TouchCandidate::room).gap.value < 0.0
        };
        let mut low = path.weight;
        for weight in path.places(PLACES_IN_PIECE) {
            if !passes_below(weight) {
                return (NewtonBracket::new(weight, low), low);
            }
            low = weight;
        }
        (NewtonBracket::new(0.0, low), low)
    }

    /// The span with the numbers that keep it in touch with what it lands on.
    fn land_span(
        &self,
        origin: &SpanStart,
        unknown: f64,
        departure: Departure,
        landing: TouchCandidate,
        laid: &mut LaidLine,
    ) -> (Departure, TouchCandidate) {
        laid.left = laid.left.max(landing.gap.value.abs());
        let zero = landing.gap;
        if matches!(origin, SpanStart::Fairlead) {
            laid.top = departure.point.v.eliminate(&zero);
        }
        let departure = Departure { point: departure.point.eliminate(&zero), ..departure };
        (Departure { unknown, ..departure }, TouchCandidate { at: landing.at.eliminate(&zero), ..landing })
    }

    /// What a curve touches first when its unknown grows.
    pub fn limit(&self, from: &Departure, sunk: &[bool]) -> TouchCandidate {
        self.least_of(from, sunk, None, TouchCandidate::room)
    }

    /// The least candidate, of those up to a landing in a piece when that is given.
    fn least_of(
        &self,
        from: &Departure,
        sunk: &[bool],
        lands_in: Option<usize>,
        size: impl Fn(&TouchCandidate) -> f64,
    ) -> TouchCandidate {
        let mut best: Option<TouchCandidate> = None;
        let mut take = |candidate: TouchCandidate| {
            let (element, held) = (candidate.at.element, matches!(candidate.kind, TouchKind::Held(_) | TouchKind::End));
            if lands_in.is_some_and(|last| element > last || (element == last && held)) {
                return;
            }
            if best.as_ref().is_none_or(|b| size(&candidate) < size(b)) {
                best = Some(candidate);
            }
        };
        let mut at = from.point;
        let mut departed = from.face;
        for element in from.point.element..self.elements.len() {
            let length = -at.s + self.element_length(element);
            let low = self.hang(&at, length);
            // what only weighs goes on to rise from the face that it left
            departed = departed.filter(|_| self.elements.get(element).is_some_and(|e| e.weight() >= 0.0));
            self.touches(&at, &low, length.value, departed, &mut take);
            let Some(pull) = self.pulls.get(element) else {
                at = low;
                break;
            };
            let face = self.bottom.face(low.u.value);
            if pull.on_bottom && departed != Some(face) {
                take(TouchCandidate {
                    kind: TouchKind::Joint(element),
                    gap: self.height_above_face(&low, face),
                    at: low,
                });
            }
            let (above, below) = self.lifts(element);
            let past = sunk.get(element).is_some_and(|past| *past);
            if let (Some(step), false) = (self.step(element), past) {
                take(TouchCandidate { kind: TouchKind::Held(element), gap: low.z + -step, at: low });
            }
            let lift = if past { below } else { above };
            at = LinePoint { element: element + 1, s: Var::constant(0.0), v: low.v + lift, ..low };
            departed = departed.filter(|_| lift <= 0.0);
        }
        let line = self.bottom.tilt(0).slope();
        let gap = at.z - at.u * line + -self.line.anchor;
        take(TouchCandidate { kind: TouchKind::End, gap, at });
        best.unwrap_or(TouchCandidate { kind: TouchKind::End, gap, at })
    }

    /// The height of a point above the plane of a face.
    fn height_above_face(&self, at: &LinePoint, face: usize) -> Var {
        let (from, z) = self.bottom.vertex(face);
        at.z - (at.u + -from) * self.bottom.tilt(face).slope() + -z
    }

    /// Where a stretch of a piece between two points comes nearest to the bottom.
    fn touches(
        &self,
        at: &LinePoint,
        low: &LinePoint,
        length: f64,
        departed: Option<usize>,
        take: &mut impl FnMut(TouchCandidate),
    ) {
        let Some(LinePiece::Length { segment, law, sees_bottom: true }) = self.elements.get(at.element) else { return };
        let (first, last) = (self.bottom.face(at.u.value), self.bottom.face(low.u.value));
        for face in (last..=first).rev() {
            if segment.weight > 0.0 && departed != Some(face) {
                let slope = self.bottom.tilt(face).slope();
                let s = (at.v - at.h * slope) * (1.0 / segment.weight);
                if s.value > 0.0 && s.value < length {
                    let touch = self.hang(at, s);
                    let (from, to) = self.bottom.extent(face);
                    if touch.u.value >= from && touch.u.value <= to {
                        take(TouchCandidate {
                            kind: TouchKind::Tangent(face),
                            gap: self.height_above_face(&touch, face),
                            at: touch,
                        });
                    }
                }
            }
            let (u, z) = self.bottom.vertex(face);
            // not the ridge that it has just left
            let ahead = at.u.value - u > 64.0 * self.fine && departed != Some(face);
            if face > last && ahead && self.bottom.is_ridge(face) {
                let reached = reach(segment, law.as_ref(), at, length, at.u.value - u);
                let over = self.hang(at, Var::constant(reached));
                let steep = over.v.value / over.h.value;
                let aside = over.u + -u;
                // the point of the line that is above the vertex
                let by = rate(segment, law.as_ref(), &over);
                let s = Var { value: reached, by: aside.by.map(|b| b / by) };
                let gap = over.z - aside * steep + -z;
                take(TouchCandidate { kind: TouchKind::Vertex(face), gap, at: self.hang(at, s) });
            }
        }
    }

    /// Keeps what hangs between a beginning and a landing; the spare length left behind what lies before it, if any does.
    pub fn record(
        &self,
        origin: &SpanStart,
        from: &Departure,
        to: &TouchCandidate,
        sunk: &[bool],
        laid: &mut LaidLine,
    ) -> Option<Spare> {
        let mut spare = None;
        laid.lands_in.push(to.at.element);
        laid.left_at.push(matches!(origin, SpanStart::Ground(_)).then_some(from.unknown));
        match origin {
            SpanStart::Ground(path) => {
                self.record_path(path, Some(from), laid);
                spare = Some(path.spare_at(from));
            }
            SpanStart::Held { before, .. } => {
                let lift = from.point.v.value - before.v.value;
                self.keep_joint(before.element, before, lift, 0.0, [true, false], laid);
            }
            SpanStart::Fairlead => {}
        }
        let last = if matches!(to.kind, TouchKind::End) { self.elements.len() } else { to.at.element + 1 };
        let mut at = from.point;
        for element in from.point.element..last {
            let whole =
                element + 1 < last || matches!(to.kind, TouchKind::End | TouchKind::Joint(_) | TouchKind::Held(_));
            let length = if whole { -at.s + self.element_length(element) } else { to.at.s - at.s };
            let low = self.hang(&at, length);
            laid.stretches.push(stretch_between(&at, &low, SupportMode::Hangs));
            if element + 1 < last && element < self.pulls.len() {
                let (above, below) = self.lifts(element);
                let past = sunk.get(element).is_some_and(|past| *past);
                let lift = if past { below } else { above };
                self.keep_joint(element, &low, lift, 0.0, [false, past], laid);
                at = LinePoint { element: element + 1, s: Var::constant(0.0), v: low.v + lift, ..low };
            }
        }
        spare
    }

    pub fn keep_joint(
        &self,
        joint: usize,
        at: &LinePoint,
        lift: f64,
        reaction: f64,
        [held, passed]: [bool; 2],
        laid: &mut LaidLine,
    ) {
        if let Some(position) = laid.joints.get_mut(joint) {
            *position = JointAt { u: at.u.value, z: at.z.value, lift, reaction, held, passed };
        }
    }
}

/// The stretch between two points of a piece.
pub fn stretch_between(at: &LinePoint, low: &LinePoint, manner: SupportMode) -> PieceStretch {
    PieceStretch {
        element: at.element,
        from: at.s.value,
        to: low.s.value,
        u: at.u.value,
        z: at.z.value,
        h: at.h.value,
        v: at.v.value,
        low: [low.u.value, low.z.value, low.h.value, low.v.value],
        manner,
    }
}

/// How fast u falls along the line at a point (unstretched length).
fn rate(segment: &Segment, law: Option<&StretchLaw>, at: &LinePoint) -> f64 {
    let tension = at.h.value.hypot(at.v.value);
    at.h.value / tension * (1.0 + strain(segment, law, tension).0)
}

/// The unstretched length below a point after which the line is `aside` nearer to the anchor.
fn reach(segment: &Segment, law: Option<&StretchLaw>, from: &LinePoint, length: f64, aside: f64) -> f64 {
    let (h, v) = (from.h.value, from.v.value);
    let mut bracket = NewtonBracket::new(0.0, length);
    let mut s = 0.5 * length;
    for _ in 0..MAX_SEARCH_STEPS {
        let end = v - segment.weight * s;
        let off = stretch(segment, law, s, h, end).x - aside;
        bracket.record(s, off);
        let tension = h.hypot(end);
        let newton = s - off * tension / (h * (1.0 + strain(segment, law, tension).0));
        let next = bracket.step(newton, || length);
        if (next - s).abs() <= 2.0 * f64::EPSILON * length {
            return next;
        }
        s = next;
    }
    s
}
