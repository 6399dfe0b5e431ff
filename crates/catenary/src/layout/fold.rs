//! Solutions between folds.
//!
//! Friction takes tension from what lies, so that the line that leaves the bottom further toward the anchor leaves it with
//! less. The curve then need not sink: at one force (or at one place of the fairlead) a span may begin at several places.
//! [`super::LineLayout::lay`] takes the last one. Where that one ends, at a fold, it goes over to another at a distance, and
//! the end of the line jumps. The equilibria between are those of a line that begins its span between the two places: there
//! the place is given, and the force (or the place of the fairlead) sought with which the span lands.
//!
//! On the way between the two places another span may come to a fold of its own, where the end jumps again. That span is then
//! held as well, between its own two places: the force and the places of the spans held before are sought together, by
//! Newton's method, with which all of them land. So on for as many spans as come to a fold.

use super::{FixedDeparture, LaidLine, LineLayout, Top};
use nalgebra::{DMatrix, DVector};
use windlass_base::dense::{Lu, never};
use windlass_nonlinear::{BracketedRoot, Halvings, backtrack};

/// Difference of what lies before a span (share of all weights) that is a jump.
const JUMP_SHARE: f64 = 1e-9;
/// Places between the two sides of a jump that are tried, and how often the way from one to the next is halved.
const PLACES_IN_JUMP: usize = 24;
const MAX_WAY_HALVINGS: usize = 6;
/// First change of the parameter in search of a landing, the factor by which it grows, and how often.
const FIRST_SHIFT: f64 = 1e-12;
const SHIFT_FACTOR: f64 = 8.0;
const MAX_SHIFTS: usize = 15;
/// Steps of a bracketed search.
const MAX_SEARCH_STEPS: usize = 200;
/// Spans that are held at once at most: each multiplies what a search costs by some ten.
const MAX_HELD_SPANS: usize = 4;
/// Steps of Newton's method for the landings of several spans, and halvings of one.
const MAX_LANDING_STEPS: usize = 30;
const MAX_STEP_HALVINGS: usize = 8;
/// Change of an unknown (share) by which a landing is differentiated: the root of the rounding.
const DIFFERENCE: f64 = 1e-7;
/// Gap of a landing (roundings of a place) with which it is taken as one.
const LANDED: f64 = 1e3;

/// A line of which some spans begin at given places.
#[derive(Clone, Debug)]
struct HeldLine {
    parameter: f64,
    /// In the order of the spans.
    holds: Vec<FixedDeparture>,
    /// Joints up to the landings of these that are past the step of their lift.
    sunk: Vec<bool>,
    laid: LaidLine,
}

impl HeldLine {
    fn short(&self) -> f64 {
        self.laid.short.value
    }

    /// Its held spans with another one among them.
    fn holds_with(&self, hold: FixedDeparture) -> Vec<FixedDeparture> {
        let mut holds: Vec<_> = self.holds.iter().copied().filter(|h| h.span != hold.span).collect();
        holds.insert(holds.partition_point(|h| h.span < hold.span), hold);
        holds
    }
}

/// The search for a line between folds: `top` makes the fairlead of a parameter, `shifted` moves a parameter by a share.
struct FoldSearch<'s, 'a, T, S> {
    layout: &'s LineLayout<'a>,
    top: &'s T,
    shifted: &'s S,
}

impl LineLayout<'_> {
    /// The line between the two sides of a jump, given by their parameters: the end falls short of the anchor at the first
    /// and is beyond it at the second. `top` makes the fairlead of a parameter, `shifted` moves a parameter by a share.
    pub fn between_folds(
        &self,
        top: &impl Fn(f64) -> Top<'static>,
        shifted: &impl Fn(f64, f64) -> f64,
        [short_at, beyond_at]: [f64; 2],
    ) -> Option<(f64, LaidLine)> {
        let search = FoldSearch { layout: self, top, shifted };
        let outward = (short_at - beyond_at).signum();
        let first = search.side(short_at, outward, |short| short > 0.0)?;
        let second = search.side(beyond_at, -outward, |short| short <= 0.0)?;
        search.between([&first, &second]).map(|found| (found.parameter, found.laid))
    }
}

impl<T: Fn(f64) -> Top<'static>, S: Fn(f64, f64) -> f64> FoldSearch<'_, '_, T, S> {
    /// The line between the two sides of a jump, whose ends are on unlike sides of the anchor.
    fn between(&self, sides: [&HeldLine; 2]) -> Option<HeldLine> {
        let [first, second] = sides;
        if first.holds.len() >= MAX_HELD_SPANS {
            return None;
        }
        let is_held = |span: usize| first.holds.iter().any(|hold| hold.span == span);
        let weight = |line: &HeldLine, span: usize| line.laid.left_at.get(span).copied().flatten();
        let spans = first.laid.left_at.len().max(second.laid.left_at.len());
        let mut pairs =
            (0..spans).filter(|span| !is_held(*span)).map(|span| (span, sides.map(|side| weight(side, span))));
        // where one side only just touches the bottom, none of it lies
        let (span, from, to, side) = pairs.find_map(|(span, weights)| match weights {
            [Some(a), Some(b)] => ((a - b).abs() > JUMP_SHARE * self.layout.weight).then_some((span, a, b, first)),
            [Some(a), None] => Some((span, a, 0.0, first)),
            [None, Some(b)] => Some((span, 0.0, b, second)),
            [None, None] => None,
        })?;
        let lands_in = span.checked_sub(1).and_then(|before| side.laid.lands_in.get(before).copied());
        let shorts = sides.map(HeldLine::short);
        // a joint sinks when its span is found, and not when that is held: those that do before the span lands, or all of them
        let landing = side.laid.lands_in.get(span).copied().unwrap_or(0);
        let sunk_to = |last: usize| {
            let is_past = |flags: &[bool], joint: usize| flags.get(joint).is_some_and(|past| *past);
            let past = |joint| is_past(&side.sunk, joint) || (joint <= last && is_past(&side.laid.sunk, joint));
            (0..side.laid.sunk.len()).map(past).collect::<Vec<bool>>()
        };
        let mut choices = vec![side.sunk.clone(), sunk_to(landing), sunk_to(usize::MAX)];
        choices.dedup_by_key(|flags| flags.iter().filter(|past| **past).count());
        choices.into_iter().map(|sunk| HeldLine { sunk, ..side.clone() }).find_map(|start| {
            [None, lands_in].iter().take(1 + usize::from(lands_in.is_some())).find_map(|lands_in| {
                let hold = FixedDeparture { span, weight: from, lands_in: *lands_in };
                let found = self.between_places(&start, (hold, to), shorts);
                found.filter(|line| line.short().abs() <= JUMP_SHARE * self.layout.length)
            })
        })
    }

    /// The line with a span that begins between the place of `hold` and another one, where the end falls short of the anchor by
    /// `shorts`; `side` is a line at one of the two.
    fn between_places(
        &self,
        side: &HeldLine,
        (hold, to): (FixedDeparture, f64),
        [short_at_first, short_at_last]: [f64; 2],
    ) -> Option<HeldLine> {
        let at_share = |share: f64| FixedDeparture { weight: hold.weight + share * (to - hold.weight), ..hold };
        let mut near = (0.0, side.clone());
        let mut place = |share: f64| {
            near = (share, self.follow(&near, share, &at_share, MAX_WAY_HALVINGS)?);
            Some(near.1.clone())
        };
        let mut before = (0.0, short_at_first, None);
        for step in 1..=PLACES_IN_JUMP {
            let share = step as f64 / PLACES_IN_JUMP as f64;
            let line = if step == PLACES_IN_JUMP { None } else { Some(place(share)?) };
            let value = line.as_ref().map_or(short_at_last, HeldLine::short);
            if (value > 0.0) == (before.1 > 0.0) {
                before = (share, value, line);
                continue;
            }
            let mut search = BracketedRoot::new([before.0, share], [before.1, value], Halvings::EveryThird);
            // the line nearest to the anchor on either side of it
            let mut closest = [before.2, line];
            if value > 0.0 {
                closest.reverse();
            }
            for _ in 0..MAX_SEARCH_STEPS {
                let Some(at) = search.propose() else { break };
                let Some(found) = place(at) else { break };
                search.record(at, found.short());
                let side = usize::from(found.short() <= 0.0);
                closest[side] = Some(found);
            }
            let best = closest.iter().flatten().min_by(|a, b| a.short().abs().total_cmp(&b.short().abs()))?;
            if best.short().abs() <= JUMP_SHARE * self.layout.length {
                return Some(best.clone());
            }
            // another span has a fold here
            let [Some(short), Some(beyond)] = &closest else { return None };
            return self.between([short, beyond]);
        }
        None
    }

    /// The line with a span beginning at a share of its way, from the line at another share; by halves of the way where
    /// that is too far at once.
    fn follow(
        &self,
        from: &(f64, HeldLine),
        share: f64,
        at_share: &impl Fn(f64) -> FixedDeparture,
        halvings: usize,
    ) -> Option<HeldLine> {
        if let Some(found) = self.landed(&from.1, at_share(share)) {
            return Some(found);
        }
        // one unknown is found from far or not at all
        if halvings == 0 || from.1.holds_with(at_share(share)).len() < 2 {
            return None;
        }
        let middle = 0.5 * (from.0 + share);
        let half = (middle, self.follow(from, middle, at_share, halvings - 1)?);
        self.follow(&half, share, at_share, halvings - 1)
    }

    /// The line at a side of a jump: at a parameter, or as little further out as leaves it there.
    fn side(&self, at: f64, outward: f64, is_there: impl Fn(f64) -> bool) -> Option<HeldLine> {
        let mut shift = 0.0;
        for _ in 0..MAX_SHIFTS {
            let parameter = (self.shifted)(at, outward * shift);
            let laid = self.layout.lay(&(self.top)(parameter)).ok().filter(|l| is_there(l.short.value));
            if let Some(laid) = laid {
                return Some(HeldLine { parameter, holds: Vec::new(), sunk: Vec::new(), laid });
            }
            shift = if shift == 0.0 { FIRST_SHIFT } else { SHIFT_FACTOR * shift };
        }
        None
    }

    /// The line near another one, all of whose held spans land, one more of them beginning at a given place.
    fn landed(&self, near: &HeldLine, hold: FixedDeparture) -> Option<HeldLine> {
        let holds = near.holds_with(hold);
        let (parameter, holds) = match holds.as_slice() {
            [_] => (self.parameter_of_landing(near.parameter, (&holds, &near.sunk))?, holds),
            _ => self.landing_of_several(near.parameter, (holds, &near.sunk), hold.span)?,
        };
        let top = Top { holds: &holds, sunk: &near.sunk, ..(self.top)(parameter) };
        let laid = self.layout.lay(&top).ok()?;
        // what was taken as sunk is below its step
        let sound = near.sunk.iter().zip(&laid.joints).enumerate().all(|(joint, (past, at))| {
            !past || self.layout.step(joint).is_none_or(|step| at.z <= step + LANDED * self.layout.fine)
        });
        sound.then(|| HeldLine { parameter, holds, sunk: near.sunk.clone(), laid })
    }

    /// The gaps at which held spans land (m), in their order.
    fn gaps(&self, parameter: f64, (holds, sunk): (&[FixedDeparture], &[bool])) -> Option<DVector<f64>> {
        let top = Top { holds, sunk, should_continue: false, ..(self.top)(parameter) };
        let gaps = self.layout.lay(&top).ok()?.gaps;
        let sound = gaps.len() == holds.len() && gaps.iter().all(|(_, gap)| gap.is_finite());
        sound.then(|| DVector::from_iterator(gaps.len(), gaps.iter().map(|(_, gap)| *gap)))
    }

    /// The parameter, near one, with which a span that begins at a given place lands.
    fn parameter_of_landing(&self, near: f64, holds: (&[FixedDeparture], &[bool])) -> Option<f64> {
        let gap = |parameter: f64| self.gaps(parameter, holds).map(|gaps| gaps[0]);
        let start = (near, gap(near)?);
        if start.1 == 0.0 {
            return Some(near);
        }
        let mut ends = [start, start];
        let mut shift = FIRST_SHIFT;
        for _ in 0..MAX_SHIFTS {
            for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
                let at = (self.shifted)(near, sign * shift);
                let Some(found) = gap(at) else { continue };
                if (found > 0.0) != (end.1 > 0.0) {
                    let (root, left) = bracketed_root(*end, (at, found), gap);
                    // a span before may jump there
                    if left.abs() <= LANDED * self.layout.fine {
                        return Some(root);
                    }
                }
                *end = (at, found);
            }
            shift *= SHIFT_FACTOR;
        }
        None
    }

    /// The parameter and the places of all held spans but one, near these, with which all of them land.
    fn landing_of_several(
        &self,
        near: f64,
        (holds, sunk): (Vec<FixedDeparture>, &[bool]),
        given: usize,
    ) -> Option<(f64, Vec<FixedDeparture>)> {
        let sought: Vec<usize> = (0..holds.len()).filter(|index| holds[*index].span != given).collect();
        // the first unknown is a shift of the parameter, the others are shares of all weights
        let moved = |(parameter, holds): &(f64, Vec<FixedDeparture>), by: &DVector<f64>| {
            let mut holds = holds.clone();
            for (index, share) in sought.iter().zip(by.iter().skip(1)) {
                holds[*index].weight += share * self.layout.weight;
            }
            ((self.shifted)(*parameter, by[0]), holds)
        };
        let gaps = |at: &(f64, Vec<FixedDeparture>)| self.gaps(at.0, (&at.1, sunk));
        let mut at = (near, holds);
        let mut left = gaps(&at)?;
        for _ in 0..MAX_LANDING_STEPS {
            if left.amax() <= self.layout.fine {
                break;
            }
            let mut slopes = DMatrix::zeros(left.len(), left.len());
            for unknown in 0..left.len() {
                let by = DVector::from_fn(left.len(), |i, _| if i == unknown { DIFFERENCE } else { 0.0 });
                let ahead = gaps(&moved(&at, &by));
                let behind = gaps(&moved(&at, &-by));
                let slope = match (ahead, behind) {
                    (Some(ahead), Some(behind)) => (ahead - behind) / (2.0 * DIFFERENCE),
                    (Some(ahead), None) => (ahead - &left) / DIFFERENCE,
                    (None, Some(behind)) => (&left - behind) / DIFFERENCE,
                    (None, None) => return None,
                };
                slopes.set_column(unknown, &slope);
            }
            let step = Lu::new(slopes, &never).ok()?.solve(&-&left).ok()?;
            let nearer = backtrack(1.0, MAX_STEP_HALVINGS, |share| {
                let there = moved(&at, &(&step * share));
                gaps(&there).filter(|gaps| gaps.amax() < left.amax()).map(|gaps| (there, gaps))
            });
            let Some((_, (there, gaps))) = nearer else { break };
            (at, left) = (there, gaps);
        }
        (left.amax() <= LANDED * self.layout.fine).then_some(at)
    }
}

/// A root between two arguments with values of unlike signs, and the value there; a value of none ends the search.
fn bracketed_root(a: (f64, f64), b: (f64, f64), mut f: impl FnMut(f64) -> Option<f64>) -> (f64, f64) {
    let mut search = BracketedRoot::new([a.0, b.0], [a.1, b.1], Halvings::EveryThird);
    for _ in 0..MAX_SEARCH_STEPS {
        let Some(at) = search.propose() else { break };
        let Some(value) = f(at) else { break };
        search.record(at, value);
    }
    search.best()
}
