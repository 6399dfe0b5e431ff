//! A span of one line over pulleys, or of a line that runs off a winch drum (`ASSEMBLY PULLEY`, `ASSEMBLY WINCH`).
//!
//! Spans are straight and weightless, but the last, which may be a line with weight. Pulleys are points without friction, inertia and
//! size: the tension where two spans meet is one, and the first segments of the spans share one unstretched length,
//! `sum l_k(T) = L`. Of a straight span of distance d, whose further segments have the lengths l_j, `l = (d - sum l_j (1 + T/EA_j)) / (1 + T/EA)`.
//! Where the last span has weight, its first segment has what the others leave, and T is the tension at its first end. Both sides change in one
//! direction with T, so that there is one answer.
//!
//! A drum changes L by what it pays out. In a run its rate v follows from `I dv/dt = R (T R - M)` by the trapezoidal rule: what is paid
//! out at the end of a step is a + b T, which goes into the same equation. M is the torque of the motor, which hauls in, or of a slipping
//! brake, which is against the motion. A brake that holds, and a curve over time, leave b = 0.
//!
//! Each span is an element of its own, whose ends are followed by those of the other spans: it exerts forces on its own two, which all ends
//! change.

use nalgebra::{Matrix3, Matrix6, Vector3};
use windlass_base::pose::Six;
use windlass_base::units::Dim;
use windlass_model::{
    ClassError, ConnectorElement, ConnectorResponse, ConnectorSummary, Curve, CurveKind, Drum, DrumControl, End, Note,
    Placement, ReevedLayout, ReevedSpan, Situation, SolverCache, TimeStep,
};
use windlass_nonlinear::{BracketedRoot, Halvings};

/// Most steps of the search for the tension.
const MAX_ITERATIONS: usize = 200;
/// Share of the tension to which it is found.
const TENSION_TOLERANCE: f64 = 1e-13;
/// Share of a length by which the forces of a line with weight are compared: the square of it, 1e-8, is the share by which its stiffness is off.
const LENGTH_DIFFERENCE: f64 = 1e-4;
/// Least length of the first segment of a span, as a share of the whole.
const LEAST_SHARE: f64 = 1e-9;

/// Positions of the state of a line off a drum.
const PAID_OUT: usize = 0;
const RATE: usize = 1;
const LAST_TENSION: usize = 2;
const HAS_TENSION: usize = 3;

/// A span of a line over pulleys.
#[derive(Debug)]
pub struct ReevedLine {
    layout: ReevedLayout,
    /// The segments of each straight span; none of a last span with weight.
    spans: Vec<Option<Vec<[f64; 2]>>>,
    /// Unstretched length of the first segments together (m).
    whole: f64,
}

/// A straight span between its ends.
#[derive(Clone, Copy, Debug)]
struct SpanAt {
    distance: f64,
    along: Vector3<f64>,
}

/// The first segment of a straight span under a tension: its length (m), and how that changes with the distance and the tension.
#[derive(Clone, Copy, Debug)]
struct FirstSegment {
    length: f64,
    by_distance: f64,
    by_tension: f64,
}

/// The line in a situation.
#[derive(Debug)]
struct Reeved {
    tension: f64,
    spans: Vec<SpanAt>,
    /// The length of the first segment of each span (m).
    lengths: Vec<f64>,
    /// d(tension)/d(place) of both ends of each span (N/m).
    by_ends: Vec<[Vector3<f64>; 2]>,
    /// What the drum has paid out (m), and at which rate it does (m/s).
    drum: DrumMotion,
}

/// What a drum has paid out by the end of a step.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct DrumMotion {
    paid_out: f64,
    rate: f64,
}

/// What a drum pays out under a tension: `at_rest` + `by_tension` T (m, m/N).
#[derive(Clone, Copy, Debug, Default)]
struct PayoutLaw {
    without_tension: f64,
    by_tension: f64,
}

impl ReevedLine {
    /// The element of a layout.
    ///
    /// # Errors
    /// A span with weight that is not the last; a curve of a kind that governs no drum.
    pub fn new(layout: ReevedLayout) -> Result<Self, ClassError> {
        let last = layout.spans.len().saturating_sub(1);
        let mut spans = Vec::new();
        for (index, span) in layout.spans.iter().enumerate() {
            let class = span.class.as_reeved();
            let class =
                class.ok_or_else(|| ClassError::new(format!("a {} does not run over a pulley", span.class.kind())))?;
            class
                .may_reeve()
                .map_err(|error| error.with_subject(format!("connector {} of {}", span.name, layout.name)))?;
            spans.push(match class.straight_segments(&span.placement) {
                Ok(segments) => Some(segments),
                Err(_) if index == last => None,
                Err(error) => return Err(error.with_subject(format!("connector {} of {}", span.name, layout.name))),
            });
        }
        if let Some((_, Some(curve))) = &layout.drum
            && !matches!(curve.kind, CurveKind::LoadMultiplier | CurveKind::ConnectorLength)
        {
            let text = format!("curve {} is a {}, which governs no drum", curve.name, curve.kind.name());
            return Err(ClassError::new(text)
                .help("LT_MULTIPLIER gives a rate over time as a factor, CT_LENGTH a length paid out over time"));
        }
        let whole = layout.spans.iter().map(|span| span.first_length).sum();
        Ok(ReevedLine { layout, spans, whole })
    }

    /// Where the ends of a span stand among those of the element.
    fn first_end(&self, span: usize) -> usize {
        match span.cmp(&self.layout.own) {
            std::cmp::Ordering::Equal => 0,
            std::cmp::Ordering::Less => 2 * (span + 1),
            std::cmp::Ordering::Greater => 2 * span,
        }
    }

    /// The ends of a span.
    fn ends_of<'e>(&self, span: usize, ends: &'e [End]) -> Result<&'e [End], ClassError> {
        let from = self.first_end(span);
        ends.get(from..from + 2).ok_or_else(|| {
            ClassError::new(format!(
                "its tension is that of the whole line of {}, which is not found alone",
                self.layout.name
            ))
            .help("&CONNECTOR -LENGTH and -L_DELTA give the length of a span")
        })
    }

    fn first_segment(segments: &[[f64; 2]], distance: f64, tension: f64) -> FirstSegment {
        let Some(([_, ea], rest)) = segments.split_first() else {
            return FirstSegment { length: 0.0, by_distance: 0.0, by_tension: 0.0 };
        };
        let (mut fixed, mut compliance) = (0.0, 0.0);
        for [length, ea] in rest {
            fixed += length * (1.0 + tension / ea);
            compliance += length / ea;
        }
        let stretch = 1.0 + tension / ea;
        let length = (distance - fixed) / stretch;
        FirstSegment { length, by_distance: 1.0 / stretch, by_tension: -(compliance + length / ea) / stretch }
    }

    /// The first segments of all straight spans together under a tension: length, and its change with the tension.
    fn straight_length(&self, at: &[SpanAt], tension: f64) -> (f64, f64) {
        let mut sum = (0.0, 0.0);
        for (segments, span) in self.spans.iter().zip(at) {
            if let Some(segments) = segments {
                let first = ReevedLine::first_segment(segments, span.distance, tension);
                sum.0 += first.length;
                sum.1 += first.by_tension;
            }
        }
        sum
    }

    /// The last span, where it has weight.
    fn hanging(&self) -> Option<(usize, &ReevedSpan)> {
        let last = self.spans.len().checked_sub(1)?;
        self.spans.get(last)?.is_none().then_some(())?;
        self.layout.spans.get(last).map(|span| (last, span))
    }

    /// The tension that tightens straight spans to a whole length (m) that grows by `by_tension` (m/N): zero where they are slack.
    fn straight_tension(&self, at: &[SpanAt], whole: f64, by_tension: f64) -> Result<f64, ClassError> {
        let excess = |tension: f64| {
            let (length, slope) = self.straight_length(at, tension);
            (length - whole - by_tension * tension, slope - by_tension)
        };
        if excess(0.0).0 <= 0.0 {
            return Ok(0.0);
        }
        // convex and falling: the steps go up to the root from below, until rounding turns them back
        let mut tension = 0.0;
        for _ in 0..MAX_ITERATIONS {
            let (value, slope) = excess(tension);
            let next = tension - value / slope;
            if !next.is_finite() {
                break;
            }
            if next - tension <= TENSION_TOLERANCE * next {
                return Ok(next);
            }
            tension = next;
        }
        Err(ClassError::new("no tension of the line over its pulleys is found"))
    }

    /// The forces of the last span with weight at a length of its first segment (m).
    fn hang(&self, span: &ReevedSpan, length: f64, ends: &[End]) -> Result<ConnectorResponse, ClassError> {
        let element = span_element(span, length, &self.layout)?;
        let mut out = ConnectorResponse::default();
        let at = Situation { ends, step: None, surroundings: &self.layout.surroundings };
        element.evaluate(&at, &[], &mut [], &mut SolverCache::new(), &mut out)?;
        Ok(out)
    }

    /// The tension where the last span has weight.
    fn hanging_tension(
        &self,
        (index, span): (usize, &ReevedSpan),
        (at, ends): (&[SpanAt], &[End]),
        (whole, by_tension): (f64, f64),
        start: f64,
    ) -> Result<f64, ClassError> {
        let own = self.ends_of(index, ends)?;
        let least = LEAST_SHARE * self.whole;
        let excess = |tension: f64| -> Result<f64, ClassError> {
            let length = whole + by_tension * tension - self.straight_length(at, tension).0;
            // a span without line pulls more than any
            if length <= least { Ok(f64::MAX.sqrt()) } else { Ok(pull(&self.hang(span, length, own)?, 0) - tension) }
        };
        let (mut high, mut value) = (start.max(1.0), 0.0);
        let mut low = None;
        for _ in 0..MAX_ITERATIONS {
            value = excess(high)?;
            if value <= 0.0 {
                break;
            }
            low = Some((high, value));
            high *= 2.0;
        }
        let mut below = high;
        while low.is_none() && below > f64::MIN_POSITIVE.sqrt() {
            below *= 0.5;
            match excess(below)? {
                above if above > 0.0 => low = Some((below, above)),
                further => (high, value) = (below, further),
            }
        }
        let (Some(low), true) = (low, value <= 0.0) else {
            return Err(ClassError::new("no tension of the line over its pulleys is found"));
        };
        let mut search = BracketedRoot::new([low.0, high], [low.1, value], Halvings::EveryThird);
        for _ in 0..MAX_ITERATIONS {
            if search.width() <= TENSION_TOLERANCE * high {
                break;
            }
            let Some(next) = search.propose() else { break };
            search.record(next, excess(next)?);
        }
        Ok(search.best().0)
    }

    /// The tension, lengths and tangent for what a drum pays out.
    fn solve(&self, ends: &[End], law: PayoutLaw, start: f64) -> Result<Reeved, ClassError> {
        let mut at = Vec::new();
        for index in 0..self.spans.len() {
            let [first, second] = self.ends_of(index, ends)? else { continue };
            let apart = second.pose.origin - first.pose.origin;
            let distance = apart.norm();
            let along = if distance > 0.0 { apart / distance } else { Vector3::z() };
            at.push(SpanAt { distance, along });
        }
        let (whole, by_tension) = (self.whole + law.without_tension, law.by_tension);
        if whole <= 0.0 {
            return Err(ClassError::new(format!("the line of {} is hauled in to its end", self.layout.name)));
        }
        let tension = match self.hanging() {
            Some(span) => self.hanging_tension(span, (&at, ends), (whole, by_tension), start)?,
            None => self.straight_tension(&at, whole, by_tension)?,
        };
        let paid_out = law.without_tension + by_tension * tension;
        let mut made = Reeved {
            tension,
            by_ends: vec![[Vector3::zeros(); 2]; at.len()],
            lengths: Vec::new(),
            spans: at,
            drum: DrumMotion { paid_out, rate: 0.0 },
        };
        let (straight, slope) = self.straight_length(&made.spans, tension);
        let left = self.whole + paid_out - straight;
        for (segments, span) in self.spans.iter().zip(&made.spans) {
            made.lengths.push(match segments {
                Some(segments) if tension > 0.0 => ReevedLine::first_segment(segments, span.distance, tension).length,
                Some(_) => span.distance,
                None => left,
            });
        }
        if let Some(index) = made.lengths.iter().position(|length| *length < -LEAST_SHARE * self.whole) {
            let name = self.layout.spans.get(index).map_or("", |span| span.name.as_str());
            return Err(ClassError::new(format!("the first segment of {name} has run over its pulley to the end")));
        }
        // d(distance)/d(place) is -+ the direction
        let straight_by = |made: &mut Reeved, factor: &dyn Fn(f64) -> f64| {
            for ((segments, span), by) in self.spans.iter().zip(&made.spans).zip(&mut made.by_ends) {
                if let Some(segments) = segments {
                    let first = ReevedLine::first_segment(segments, span.distance, tension);
                    let change = span.along * factor(first.by_distance);
                    *by = [-change, change];
                }
            }
        };
        match self.hanging() {
            None if tension > 0.0 => straight_by(&mut made, &|by_distance| by_distance / (by_tension - slope)),
            None => {}
            Some((index, span)) => {
                let own = self.ends_of(index, ends)?;
                let here = self.hang(span, left, own)?;
                let by_length = self.by_length(span, left, own)?;
                let direction = force(&here, 0).try_normalize(0.0).unwrap_or_default();
                let pull_by_length = direction.dot(&by_length[0]);
                // G(T) = F(l(T)) - T with l = whole + b T - straight(T)
                let slope = pull_by_length * (by_tension - slope) - 1.0;
                straight_by(&mut made, &|by_distance| pull_by_length * by_distance / slope);
                if let Some(by) = made.by_ends.get_mut(index) {
                    *by = [0, 1].map(|end| block(&here, 0, end).transpose() * direction / slope);
                }
            }
        }
        Ok(made)
    }

    /// How the forces on both ends of a span with weight change with the length of its first segment (N/m).
    fn by_length(&self, span: &ReevedSpan, length: f64, ends: &[End]) -> Result<[Vector3<f64>; 2], ClassError> {
        let step = LENGTH_DIFFERENCE * length;
        let (longer, shorter) = (self.hang(span, length + step, ends)?, self.hang(span, length - step, ends)?);
        Ok([0, 1].map(|end| (force(&longer, end) - force(&shorter, end)) / (2.0 * step)))
    }

    /// The line at the end of a step, with its drum.
    fn at(&self, at: &Situation, committed: &[f64]) -> Result<Reeved, ClassError> {
        let kept = |index: usize| committed.get(index).copied().unwrap_or(0.0);
        let start = if kept(HAS_TENSION) > 0.0 { kept(LAST_TENSION) } else { 0.0 };
        let held = |paid_out: f64| PayoutLaw { without_tension: paid_out, by_tension: 0.0 };
        let (Some((drum, curve)), Some(step)) = (&self.layout.drum, at.step.filter(|step| step.dt > 0.0)) else {
            return self.solve(at.ends, held(kept(PAID_OUT)), start);
        };
        let motion = DrumMotion { paid_out: kept(PAID_OUT), rate: kept(RATE) };
        let stopped = |paid_out: f64| self.solve(at.ends, held(paid_out), start);
        if let (DrumControl::Curve { factor, .. }, Some(curve)) = (&drum.control, curve) {
            let wanted = follow_curve(curve, *factor, motion, step);
            let mut made = stopped(self.within_bounds(drum, wanted.paid_out))?;
            if made.drum.paid_out == wanted.paid_out {
                made.drum.rate = wanted.rate;
            }
            return Ok(made);
        }
        let torque = match &drum.control {
            DrumControl::Motor { share, .. } => share * drum.max_torque,
            _ => {
                if motion.rate == 0.0 {
                    let made = stopped(motion.paid_out)?;
                    if made.tension * drum.radius <= drum.static_brake {
                        return Ok(made);
                    }
                }
                // paying out, as a line only pulls
                drum.dynamic_brake * if motion.rate < 0.0 { -1.0 } else { 1.0 }
            }
        };
        // v1 = v0 + c (R (T0 + T1)/2 - M) with c = dt R/I, and s1 = s0 + dt (v0 + v1)/2
        let gain = step.dt * drum.radius / drum.inertia;
        let (share, known) = if kept(HAS_TENSION) > 0.0 { (0.5, 0.5 * kept(LAST_TENSION)) } else { (1.0, 0.0) };
        let without = motion.rate + gain * (drum.radius * known - torque);
        let by_tension = gain * drum.radius * share;
        let law = PayoutLaw {
            without_tension: motion.paid_out + 0.5 * step.dt * (motion.rate + without),
            by_tension: 0.5 * step.dt * by_tension,
        };
        let mut made = self.solve(at.ends, law, start)?;
        made.drum.rate = without + by_tension * made.tension;
        let stops = !matches!(drum.control, DrumControl::Motor { .. })
            && (motion.rate > 0.0 && made.drum.rate < 0.0
                || motion.rate < 0.0 && made.drum.rate > 0.0
                || motion.rate == 0.0 && made.drum.rate < 0.0);
        if stops {
            // it stands when its rate, straight over the step, is zero
            let share = if motion.rate == 0.0 { 0.0 } else { motion.rate / (motion.rate - made.drum.rate) };
            return stopped(motion.paid_out + 0.5 * step.dt * motion.rate * share);
        }
        let within = self.within_bounds(drum, made.drum.paid_out);
        if within == made.drum.paid_out { Ok(made) } else { stopped(within) }
    }

    /// What may be paid out at most, and at least, of what would be (m).
    fn within_bounds(&self, drum: &Drum, paid_out: f64) -> f64 {
        let paid_out = paid_out.min(drum.stored);
        match drum.control.bound().map(|bound| bound - self.whole) {
            Some(bound) if bound < 0.0 => paid_out.max(bound),
            Some(bound) => paid_out.min(bound),
            None => paid_out,
        }
    }
}

/// What a curve has paid out at the end of a step.
fn follow_curve(curve: &Curve, factor: f64, before: DrumMotion, step: TimeStep) -> DrumMotion {
    let from = step.time - step.dt;
    if curve.kind == CurveKind::ConnectorLength {
        let [a, b] = [from, step.time].map(|time| factor * curve.value_at(time));
        return DrumMotion { paid_out: before.paid_out + b - a, rate: (b - a) / step.dt };
    }
    let way = factor * curve.integral(from, step.time);
    DrumMotion { paid_out: before.paid_out + way, rate: factor * curve.value_at(step.time) }
}

/// The element of a span with a length of its first segment (m).
fn span_element(
    span: &ReevedSpan,
    length: f64,
    layout: &ReevedLayout,
) -> Result<Box<dyn ConnectorElement>, ClassError> {
    let position = Placement { first_length: Some(length), ..span.placement.clone() };
    let class = span.class.as_line();
    let class = class.ok_or_else(|| ClassError::new(format!("a {} does not run over a pulley", span.class.kind())))?;
    class.line(&position, &layout.surroundings)?.element()
}

/// The force on an end (N).
fn force(response: &ConnectorResponse, end: usize) -> Vector3<f64> {
    response.wrench.get(end).map_or_else(Vector3::zeros, |w| w.fixed_rows::<3>(0).into_owned())
}

/// Its size (N).
fn pull(response: &ConnectorResponse, end: usize) -> f64 {
    force(response, end).norm()
}

/// -d(force on an end)/d(place of an end) of a span with two ends (N/m), negative: how the force changes.
fn block(response: &ConnectorResponse, end: usize, other: usize) -> Matrix3<f64> {
    response.stiffness.get(2 * end + other).map_or_else(Matrix3::zeros, |k| k.fixed_view::<3, 3>(0, 0).into_owned())
}

impl ConnectorElement for ReevedLine {
    fn states(&self) -> usize {
        if self.layout.drum.is_some() { HAS_TENSION + 1 } else { 0 }
    }

    fn acting_ends(&self) -> usize {
        2
    }

    fn evaluate(
        &self,
        at: &Situation,
        committed: &[f64],
        trial: &mut [f64],
        _: &mut SolverCache,
        out: &mut ConnectorResponse,
    ) -> Result<(), ClassError> {
        let made = self.at(at, committed)?;
        let state = [made.drum.paid_out, made.drum.rate, made.tension, 1.0];
        trial.iter_mut().zip(state).for_each(|(kept, value)| *kept = value);
        let count = at.ends.len();
        out.clear(count);
        let own = self.layout.own;
        let (Some(span), Some(length)) = (made.spans.get(own), made.lengths.get(own)) else { return Ok(()) };
        // forces on both ends, how they change with the tension, and with the places of the own ends
        let (forces, by_tension, own_change) = match self.hanging().filter(|(index, _)| *index == own) {
            Some((_, hanging)) => {
                let ends = self.ends_of(own, at.ends)?;
                let here = self.hang(hanging, *length, ends)?;
                let by_length = self.by_length(hanging, *length, ends)?;
                let forces = [0, 1].map(|end| force(&here, end));
                // the tension changes the length that the other spans leave, and so do their ends
                let (_, slope) = self.straight_length(&made.spans, made.tension);
                let drum = match &self.layout.drum {
                    Some(_) if at.step.is_some() => self.payout_by_tension(at, committed, &made),
                    _ => 0.0,
                };
                let by_tension = by_length.map(|change| change * (drum - slope));
                for (index, (segments, other)) in self.spans.iter().zip(&made.spans).enumerate() {
                    let Some(segments) = segments else { continue };
                    let first = ReevedLine::first_segment(segments, other.distance, made.tension);
                    let taken = other.along * first.by_distance;
                    for (side, sense) in [(0, 1.0), (1, -1.0)] {
                        for (end, change) in by_length.iter().enumerate() {
                            add(
                                out,
                                count,
                                (end, self.first_end(index) + side),
                                &-(change * taken.transpose() * sense),
                            );
                        }
                    }
                }
                let own_change = [0, 1].map(|end| [0, 1].map(|other| -block(&here, end, other)));
                (forces, by_tension, own_change)
            }
            None => {
                let u = span.along;
                let across = if span.distance > 0.0 {
                    (Matrix3::identity() - u * u.transpose()) * (made.tension / span.distance)
                } else {
                    Matrix3::identity() * 0.0
                };
                ([u * made.tension, -u * made.tension], [u, -u], [[-across, across], [across, -across]])
            }
        };
        for (end, pull) in forces.iter().enumerate() {
            if let Some(wrench) = out.wrench.get_mut(end) {
                *wrench = Six::new(pull.x, pull.y, pull.z, 0.0, 0.0, 0.0);
            }
            for (other, change) in own_change[end].iter().enumerate() {
                add(out, count, (end, other), &-change);
            }
            for (index, sides) in made.by_ends.iter().enumerate() {
                for (side, by) in sides.iter().enumerate() {
                    add(out, count, (end, self.first_end(index) + side), &-(by_tension[end] * by.transpose()));
                }
            }
        }
        Ok(())
    }

    fn running_length(&self, at: &Situation, committed: &[f64]) -> Result<Option<f64>, ClassError> {
        let made = self.at(&Situation { step: None, ..*at }, committed)?;
        Ok(made.lengths.get(self.layout.own).copied())
    }

    fn summary(&self, at: &Situation, committed: &[f64]) -> Result<ConnectorSummary, ClassError> {
        let made = self.at(&Situation { step: None, ..*at }, committed)?;
        let own = self.layout.own;
        let ends = self.ends_of(own, at.ends)?;
        let length = made.lengths.get(own).copied().unwrap_or(0.0);
        let slack = made.tension == 0.0;
        let mut summary = match self.layout.spans.get(own).filter(|_| !slack && length > 0.0) {
            Some(span) => {
                let at = Situation { ends, step: None, surroundings: &self.layout.surroundings };
                span_element(span, length, &self.layout)?.summary(&at, &[])?
            }
            None => ConnectorSummary { tension: Some(0.0), solution: "exact", ..ConnectorSummary::default() },
        };
        if slack {
            summary.notes.push("the line is slack".into());
        } else if length <= 0.0 {
            summary.tension = Some(made.tension);
            summary.notes.push(Note::warning("its first segment has run over the pulley to its end"));
        }
        if let Some((drum, _)) = self.layout.drum.as_ref().filter(|(drum, _)| drum.has_machine && own == 0)
            && made.tension * drum.radius > drum.static_brake
        {
            let text = "the brake of its drum does not hold its tension: it holds {}";
            summary.notes.push(Note::warning(windlass_base::message::Message::with_values(
                text,
                &[(drum.static_brake / drum.radius, Dim::Force)],
            )));
        }
        Ok(summary)
    }
}

impl ReevedLine {
    /// How what the drum has paid out changes with the tension (m/N).
    fn payout_by_tension(&self, at: &Situation, committed: &[f64], made: &Reeved) -> f64 {
        let kept = |index: usize| committed.get(index).copied().unwrap_or(0.0);
        let (Some((drum, _)), Some(step)) = (&self.layout.drum, at.step) else { return 0.0 };
        let turns = made.drum.rate != 0.0 && !matches!(drum.control, DrumControl::Curve { .. });
        if !turns {
            return 0.0;
        }
        let share = if kept(HAS_TENSION) > 0.0 { 0.5 } else { 1.0 };
        0.5 * step.dt * share * step.dt * drum.radius * drum.radius / drum.inertia
    }
}

/// Adds to the stiffness of an end by the place of an end.
fn add(out: &mut ConnectorResponse, count: usize, (end, other): (usize, usize), change: &Matrix3<f64>) {
    if let Some(block) = out.stiffness.get_mut(count * end + other) {
        let mut made = Matrix6::zeros();
        made.fixed_view_mut::<3, 3>(0, 0).copy_from(change);
        *block += made;
    }
}
