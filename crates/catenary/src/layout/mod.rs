//! A line over any bottom, laid down from the fairlead to the anchor.
//!
//! With the horizontal force at the fairlead given, the line is found span by span. Of all curves that hang free from the
//! fairlead, the first span is the steepest one that stays above the bottom: where it touches, the line begins to lie.
//! What lies loses `w (sin + mu cos)` of tension a length toward the anchor (Coulomb, friction fully mobilised toward the
//! fairlead) [JONKMAN-2007 2.7.2], around a ridge the factor `exp(-mu angle)`
//! [EYTELWEIN-1808]. It lies as far as it can: up to the last place from which the free rest of the line stays above the
//! bottom. There the next span begins, and so on to the anchor. A curve sinks everywhere when its vertical force at the
//! beginning grows, or when it leaves the bottom later, so that each span is one safeguarded search; a curve that has
//! been found stays a possible continuation of itself, so that there always is an answer.
//!
//! With friction a curve that leaves later can also rise, since it leaves with less tension: a span then has several
//! beginnings, of which the last is taken, and the end of the line jumps at the force where that one is lost. `fold` finds
//! the equilibria between the two sides of such a jump.
//!
//! Spare length without tension lies in a heap, which is level and moves no part of the line that lies in it: at the
//! touchdown, in a hollow, or at the anchor where the bottom is too steep for friction.
//!
//! One search in the horizontal force (or in the distance) is left, which brings the end to the anchor. All numbers carry
//! their derivatives by the horizontal force and by the place of the fairlead: the stiffness is that of the formulas.
//!
//! Axes: `u` the distance from the anchor toward the fairlead, `z` upward; `h` and `v` are the tension's components,
//! `v` positive where the line rises toward the fairlead.

mod ends;
mod fold;
mod path;
mod span;
mod states;

pub(super) use ends::{at_force, between_ends};
pub(super) use states::point;

use super::dual::Var;
use super::element::{LinePiece, spring_reach, strain, stretch};
use super::error::LineError;
use super::line::Line;
use super::multi_segment::JointPull;
use super::profile::{SeabedProfile, Tilt};
use super::state::Heap;
use path::{LaidPath, PathEnd, Spare};
use span::{TouchCandidate, TouchKind};

/// A point of the line.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct LinePoint {
    /// The piece, and the unstretched length from its upper end (m).
    pub element: usize,
    pub s: Var,
    pub u: Var,
    pub z: Var,
    pub h: Var,
    pub v: Var,
}

impl LinePoint {
    fn eliminate(self, zero: &Var) -> LinePoint {
        let LinePoint { element, s, u, z, h, v } = self;
        LinePoint {
            element,
            s: s.eliminate(zero),
            u: u.eliminate(zero),
            z: z.eliminate(zero),
            h: h.eliminate(zero),
            v: v.eliminate(zero),
        }
    }
}

/// How a stretch of a piece is held.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum SupportMode {
    /// It hangs free.
    Hangs,
    /// It lies on a face, losing this much tension a length (N/m).
    Lies { tilt: Tilt, loss: f64 },
    /// It lies in a heap, without tension.
    Heap,
}

/// A stretch of a piece.
#[derive(Clone, Copy, Debug)]
pub(super) struct PieceStretch {
    pub element: usize,
    /// Unstretched lengths from the upper end of the piece (m).
    pub from: f64,
    pub to: f64,
    /// Place and forces at its upper end.
    pub u: f64,
    pub z: f64,
    pub h: f64,
    pub v: f64,
    /// Place and forces at its lower end.
    pub low: [f64; 4],
    pub manner: SupportMode,
}

impl PieceStretch {
    /// Whether it lies on the same face as the one before it.
    pub fn continues_on_face_of(&self, before: &PieceStretch) -> bool {
        match (self.manner, before.manner) {
            (SupportMode::Lies { tilt, .. }, SupportMode::Lies { tilt: same, .. }) => tilt == same,
            _ => false,
        }
    }
}

/// What became of a joint.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct JointAt {
    pub u: f64,
    pub z: f64,
    /// Its lift (N, upward) and what the bottom carries (N, along its normal).
    pub lift: f64,
    pub reaction: f64,
    /// Whether the lift is between the two sides of its step, and whether it is past it.
    pub held: bool,
    pub passed: bool,
}

/// A line laid down.
#[derive(Clone, Debug, Default)]
pub(super) struct LaidLine {
    /// How far from the anchor the line ends, along u (m): positive when it falls short.
    pub short: Var,
    /// Vertical force at the fairlead (N).
    pub top: Var,
    /// Forces at the anchor (N).
    pub end: [Var; 2],
    pub stretches: Vec<PieceStretch>,
    pub joints: Vec<JointAt>,
    pub heap: Option<(Heap, f64)>,
    /// Whether it has slid down to the anchor: `short` is that of the place without tension.
    pub slid: bool,
    /// The weight (N) that lies before each span that leaves the bottom.
    pub left_at: Vec<Option<f64>>,
    /// The piece of the line in which each span lands.
    pub lands_in: Vec<usize>,
    /// Joints that are past the step of their lift.
    pub sunk: Vec<bool>,
    /// The gaps (m) at which the spans whose places are held land, each with its span.
    pub gaps: Vec<(usize, f64)>,
    /// Largest gap left at a landing (m).
    pub left: f64,
    pub iterations: usize,
}

impl LaidLine {
    /// The line ends at a point. Where it has slid down to the anchor, only its tension from there on counts.
    fn arrive(&mut self, at: &LinePoint) {
        if self.slid {
            self.end = [at.h, at.v].map(|v| Var::constant(v.value));
        } else {
            (self.short, self.end) = (at.u, [at.h, at.v]);
        }
    }

    /// The line slides down to the anchor from a point where its tension ends.
    fn slide(&mut self, from: &LinePoint) {
        (self.slid, self.short) = (true, from.u);
        self.heap = Some((Heap::Anchor, 0.0));
    }
}

/// Where a span begins.
pub(super) enum SpanStart {
    Fairlead,
    /// At a joint that stands at a step of its lift.
    Held {
        before: LinePoint,
        low: f64,
        high: f64,
    },
    Ground(LaidPath),
}

/// The line to be laid.
pub(super) struct LineLayout<'a> {
    line: &'a Line,
    elements: &'a [LinePiece],
    pulls: &'a [JointPull],
    bottom: &'a SeabedProfile,
    friction: f64,
    least: f64,
    /// Whether the last place from which a span can leave is sought among many, where several may be.
    thorough: bool,
    /// Unstretched length (m), all weights (N), and the rounding of a place (m).
    length: f64,
    weight: f64,
    fine: f64,
}

/// The fairlead and the force there.
#[derive(Clone, Copy, Debug)]
pub(super) struct Top<'h> {
    pub h: Var,
    pub u: Var,
    pub z: Var,
    /// Vertical force to begin with (N), when one is near.
    pub near: Option<f64>,
    /// Length that lies in a heap where the line first touches the bottom (m).
    pub heap: Var,
    /// A hollow of the bottom (distance from the anchor) in which a length lies in a heap.
    pub hollow: Option<(f64, Var)>,
    /// Spans that leave the bottom at given places, in their order, and whether the line is laid on behind the last of them.
    pub holds: &'h [FixedDeparture],
    pub should_continue: bool,
    /// Joints that are past the step of their lift to begin with; none where it is empty.
    pub sunk: &'h [bool],
}

/// A span that leaves the bottom at a given place: what it lands on is at a gap from it.
#[derive(Clone, Copy, Debug)]
pub(super) struct FixedDeparture {
    pub span: usize,
    /// Weight that lies before it (N).
    pub weight: f64,
    /// The piece of the line with which the span before it lands, whatever it would reach beyond; any where none is given.
    pub lands_in: Option<usize>,
}

impl<'a> LineLayout<'a> {
    pub fn new(line: &'a Line, x: f64, z: f64) -> LineLayout<'a> {
        let chain = &line.chain;
        let length = chain.length();
        let weight = chain.elements.iter().map(|e| e.weight().abs()).sum::<f64>()
            + chain.pulls.iter().map(|p| p.lift.abs()).sum::<f64>();
        LineLayout {
            line,
            elements: &chain.elements,
            pulls: &chain.pulls,
            bottom: &line.profile,
            friction: line.floor.map_or(0.0, |f| f.friction),
            least: chain.least,
            thorough: false,
            length,
            weight,
            fine: 2.0 * f64::EPSILON * (length + x.abs() + (z - line.anchor).abs()),
        }
    }

    /// The piece below a point over an unstretched length.
    fn hang(&self, from: &LinePoint, length: Var) -> LinePoint {
        let (h, v) = (from.h, from.v);
        match self.elements.get(from.element) {
            Some(LinePiece::Length { segment, law, .. }) => {
                let low = v - length * segment.weight;
                let r = stretch(segment, law.as_ref(), length.value, h.value, low.value);
                let tension = h.value.hypot(low.value);
                // what is added at the lower end
                let more = if tension > 0.0 { (1.0 + strain(segment, law.as_ref(), tension).0) / tension } else { 0.0 };
                let x = Var::function(r.x, [(h, r.x_h), (v, r.x_v), (length, more * h.value)]);
                let z = Var::function(r.z, [(h, r.z_h), (v, r.z_v), (length, more * low.value)]);
                LinePoint { s: from.s + length, u: from.u - x, z: from.z - z, v: low, ..*from }
            }
            Some(LinePiece::Link(law)) => {
                let part = spring_reach(law, h.value, v.value);
                let x = Var::function(part.x, [(h, part.x_h), (v, part.x_v)]);
                let z = Var::function(part.z, [(h, part.z_h), (v, part.z_v)]);
                LinePoint { u: from.u - x, z: from.z - z, ..*from }
            }
            None => *from,
        }
    }

    fn element_length(&self, element: usize) -> f64 {
        self.elements[element].length()
    }

    /// Elevation of the step of a joint's lift, if it has one.
    fn step(&self, joint: usize) -> Option<f64> {
        let pull = self.pulls.get(joint)?;
        pull.steps.first().map(|(z, _)| z + self.line.datum())
    }

    /// The lift above and below the step of a joint.
    fn lifts(&self, joint: usize) -> (f64, f64) {
        let pull = &self.pulls[joint];
        (pull.lift_after(pull.steps.len()), pull.lift)
    }

    /// Lays the line.
    ///
    /// # Errors
    /// A span that does not land, or joints that go on sinking in turn.
    pub fn lay(&self, top: &Top) -> Result<LaidLine, LineError> {
        let mut sunk: Vec<bool> =
            (0..self.pulls.len()).map(|joint| top.sunk.get(joint).is_some_and(|past| *past)).collect();
        // a joint that sinks may take one before it along
        for _ in 0..=self.pulls.len() {
            if let Some(laid) = self.lay_with(top, &mut sunk)? {
                return Ok(LaidLine { sunk, ..laid });
            }
        }
        Err(LineError::NotConverged { force: top.h.value, residual: f64::NAN, iterations: self.pulls.len() })
    }

    /// Lays the line with joints that are past the step of their lift; `None` when one more of them is found behind
    /// another that is held.
    fn lay_with(&self, top: &Top, sunk: &mut [bool]) -> Result<Option<LaidLine>, LineError> {
        let mut laid = LaidLine { joints: vec![JointAt::default(); self.pulls.len()], ..LaidLine::default() };
        let mut origin = SpanStart::Fairlead;
        let mut spare = if top.heap.value > 0.0 { Spare::Length(top.heap) } else { Spare::None };
        if let Some(lying) = self.fairlead_on_bottom(top) {
            laid.top = lying.at.v;
            match self.begin(&lying, spare, top.hollow, &mut laid) {
                Some(path) => origin = SpanStart::Ground(path),
                None => return Ok(Some(laid)),
            }
        }
        // every span begins further toward the anchor or sinks a buoy
        for _ in 0..=8 * (self.elements.len() + self.bottom.faces() + 2) {
            let (departure, landing) = self.next_span(&origin, top, sunk, &mut laid)?;
            if !top.should_continue && laid.gaps.len() == top.holds.len() {
                return Ok(Some(laid));
            }
            if let TouchKind::Held(joint) = landing.kind {
                let before = landing.at;
                let (low, high) = self.lifts(joint);
                let free = self.depart(&SpanStart::Held { before, low, high }, top, high);
                if self.limit(&free, sunk).gap.value >= 0.0 {
                    // all of its lift does not hold it
                    sunk[joint] = true;
                    if matches!(origin, SpanStart::Held { .. }) {
                        return Ok(None);
                    }
                    continue;
                }
                spare = self.record(&origin, &departure, &landing, sunk, &mut laid).unwrap_or(spare);
                origin = SpanStart::Held { before, low, high };
                continue;
            }
            spare = self.record(&origin, &departure, &landing, sunk, &mut laid).unwrap_or(spare);
            if matches!(landing.kind, TouchKind::End) {
                laid.arrive(&landing.at);
                return Ok(Some(laid));
            }
            match self.begin(&landing, spare, top.hollow, &mut laid) {
                Some(path) => origin = SpanStart::Ground(path),
                None => return Ok(Some(laid)),
            }
        }
        Err(LineError::NotConverged { force: top.h.value, residual: laid.left, iterations: laid.iterations })
    }

    /// Begins to lie; `None` when the line lies up to its end.
    fn begin(
        &self,
        landing: &TouchCandidate,
        spare: Spare,
        hollow: Option<(f64, Var)>,
        laid: &mut LaidLine,
    ) -> Option<LaidPath> {
        let path = self.path(landing, spare, hollow, laid);
        if let PathEnd::Lifted = path.end {
            return Some(path);
        }
        self.record_path(&path, None, laid);
        match path.end {
            PathEnd::Lifted => {}
            PathEnd::Anchor(at) => laid.arrive(&at),
            PathEnd::Hollow { at, sump } => {
                laid.short = at.u + -sump;
                laid.end = [Var::constant(0.0); 2];
            }
        }
        None
    }

    /// The landing of a fairlead that lies on the bottom itself.
    fn fairlead_on_bottom(&self, top: &Top) -> Option<TouchCandidate> {
        let first = self.elements.iter().position(|e| matches!(e, LinePiece::Length { .. }))?;
        if !self.elements.get(first).is_some_and(LinePiece::can_rest) {
            return None;
        }
        let face = self.bottom.face(top.u.value);
        let gap = top.z.value - self.bottom.elevation_of(face, top.u.value);
        (first == 0 && gap.abs() <= self.fine).then(|| {
            let at = LinePoint {
                u: top.u,
                z: top.z,
                h: top.h,
                v: top.h * self.bottom.tilt(face).slope(),
                ..LinePoint::default()
            };
            TouchCandidate { kind: TouchKind::Tangent(face), gap: Var::constant(gap), at }
        })
    }
}
