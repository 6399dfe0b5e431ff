//! Solutions between two folds.
//!
//! Friction takes tension from what lies, so that the line that leaves the bottom further toward the anchor leaves it with
//! less. The curve then need not sink: at one force (or at one place of the fairlead) a span may begin at several places.
//! [`super::Layout::lay`] takes the last one. Where that one ends, at a fold, it goes over to another at a distance, and
//! the end of the line jumps. The equilibria between are those of a line that begins its span between the two places: there
//! the place is given, and the force (or the place of the fairlead) sought with which the span lands.

use super::{FixedDeparture, LaidLine, LineLayout, Top};
use windlass_nonlinear::{BracketedRoot, Halvings};

/// Difference of what lies before a span (share of all weights) that is a jump.
const JUMP_SHARE: f64 = 1e-9;
/// Places between the two sides of a jump that are tried.
const PLACES_IN_JUMP: usize = 24;
/// First change of the parameter in search of a landing, the factor by which it grows, and how often.
const FIRST_SHIFT: f64 = 1e-12;
const SHIFT_FACTOR: f64 = 8.0;
const MAX_SHIFTS: usize = 15;
/// Steps of a bracketed search.
const MAX_SEARCH_STEPS: usize = 200;

impl LineLayout<'_> {
    /// The line between the two sides of a jump, given by their parameters: the end falls short of the anchor at the first
    /// and is beyond it at the second. `top` makes the fairlead of a parameter, `shifted` moves a parameter by a share.
    pub fn between_folds(
        &self,
        top: &impl Fn(f64) -> Top,
        shifted: &impl Fn(f64, f64) -> f64,
        [short_at, beyond_at]: [f64; 2],
    ) -> Option<(f64, LaidLine)> {
        let outward = (short_at - beyond_at).signum();
        let (first_at, first) = self.side(top, shifted, short_at, outward, |short| short > 0.0)?;
        let (second_at, second) = self.side(top, shifted, beyond_at, -outward, |short| short <= 0.0)?;
        let mut pairs = first.left_at.iter().zip(&second.left_at).enumerate();
        // where one side only just touches the bottom, none of it lies
        let (span, from, to, (at, side)) = pairs.find_map(|(span, sides)| match sides {
            (Some(a), Some(b)) => {
                ((a - b).abs() > JUMP_SHARE * self.weight).then_some((span, *a, *b, (first_at, &first)))
            }
            (Some(a), None) => Some((span, *a, 0.0, (first_at, &first))),
            (None, Some(b)) => Some((span, 0.0, *b, (second_at, &second))),
            (None, None) => None,
        })?;
        let lands_in = span.checked_sub(1).and_then(|before| side.lands_in.get(before).copied());
        let shorts = [first.short.value, second.short.value];
        let found = |lands_in: Option<usize>| {
            let hold = FixedDeparture { span, weight: from, lands_in, should_continue: false };
            let found = self.between_places(top, shifted, (hold, to), (at, shorts));
            found.filter(|(_, laid)| laid.short.value.abs() <= JUMP_SHARE * self.length)
        };
        found(None).or_else(|| lands_in.and_then(|piece| found(Some(piece))))
    }

    /// The line with a span that begins between the place of `hold` and another one, where the end falls short of the anchor by
    /// `shorts`; `at` is the parameter at a side.
    fn between_places(
        &self,
        top: &impl Fn(f64) -> Top,
        shifted: &impl Fn(f64, f64) -> f64,
        (hold, to): (FixedDeparture, f64),
        (at, [short_at_first, short_at_last]): (f64, [f64; 2]),
    ) -> Option<(f64, LaidLine)> {
        // how far the line falls short with the span beginning at a place, and its parameter there
        let mut near = at;
        let mut short = |share: f64| {
            let hold = FixedDeparture { weight: hold.weight + share * (to - hold.weight), ..hold };
            let parameter = self.parameter_of_landing(top, shifted, near, hold)?;
            near = parameter;
            let laid = self
                .lay(&Top { hold: Some(FixedDeparture { should_continue: true, ..hold }), ..top(parameter) })
                .ok()?;
            Some((parameter, laid))
        };
        let mut before = (0.0, short_at_first);
        for step in 1..=PLACES_IN_JUMP {
            let share = step as f64 / PLACES_IN_JUMP as f64;
            let value = if step == PLACES_IN_JUMP { short_at_last } else { short(share)?.1.short.value };
            if (value > 0.0) != (before.1 > 0.0) {
                let mut best: Option<(f64, LaidLine)> = None;
                bracketed_root(before, (share, value), |share| {
                    let found = short(share)?;
                    let value = found.1.short.value;
                    if best.as_ref().is_none_or(|(_, b)| value.abs() < b.short.value.abs()) {
                        best = Some(found);
                    }
                    Some(value)
                });
                return best;
            }
            before = (share, value);
        }
        None
    }

    /// The line at a side of a jump: at a parameter, or as little further out as leaves it there.
    fn side(
        &self,
        top: &impl Fn(f64) -> Top,
        shifted: &impl Fn(f64, f64) -> f64,
        at: f64,
        outward: f64,
        is_there: impl Fn(f64) -> bool,
    ) -> Option<(f64, LaidLine)> {
        let mut shift = 0.0;
        for _ in 0..MAX_SHIFTS {
            let parameter = shifted(at, outward * shift);
            let laid = self.lay(&top(parameter)).ok().filter(|l| is_there(l.short.value));
            if let Some(laid) = laid {
                return Some((parameter, laid));
            }
            shift = if shift == 0.0 { FIRST_SHIFT } else { SHIFT_FACTOR * shift };
        }
        None
    }

    /// The parameter, near one, with which a span that begins at a given place lands.
    fn parameter_of_landing(
        &self,
        top: &impl Fn(f64) -> Top,
        shifted: &impl Fn(f64, f64) -> f64,
        near: f64,
        hold: FixedDeparture,
    ) -> Option<f64> {
        let gap = |parameter: f64| {
            let laid = self.lay(&Top { hold: Some(hold), ..top(parameter) }).ok()?;
            laid.gap.map(|g| g.value).filter(|g| g.is_finite())
        };
        let start = (near, gap(near)?);
        if start.1 == 0.0 {
            return Some(near);
        }
        let mut ends = [start, start];
        let mut shift = FIRST_SHIFT;
        for _ in 0..MAX_SHIFTS {
            for (end, sign) in ends.iter_mut().zip([-1.0, 1.0]) {
                let at = shifted(near, sign * shift);
                let Some(found) = gap(at) else { continue };
                if (found > 0.0) != (end.1 > 0.0) {
                    return Some(bracketed_root(*end, (at, found), gap));
                }
                *end = (at, found);
            }
            shift *= SHIFT_FACTOR;
        }
        None
    }
}

/// A root between two arguments with values of unlike signs; a value of none ends the search.
fn bracketed_root(a: (f64, f64), b: (f64, f64), mut f: impl FnMut(f64) -> Option<f64>) -> f64 {
    let mut search = BracketedRoot::new([a.0, b.0], [a.1, b.1], Halvings::EveryThird);
    for _ in 0..MAX_SEARCH_STEPS {
        let Some(at) = search.propose() else { break };
        let Some(value) = f(at) else { break };
        search.record(at, value);
    }
    search.best().0
}
