//! The line between two given ends, or with a given horizontal force.

use super::{Laid, Layout, Manner, Top};
use crate::dual::Var;
use crate::element::Element;
use crate::line::Line;
use crate::refused::LineError;
use crate::search::{Point, rising_root};
use crate::state::{Heap, State};

/// Parameters of a layout: the horizontal force (or the length of a heap), and the place of the fairlead.
const FORCE: usize = 0;
const ASIDE: usize = 1;
const ABOVE: usize = 2;
/// Steps of the search for the distance.
const MOST_STEPS: usize = 200;

impl Layout<'_> {
    fn top(&self, h: Var, x: f64, z: f64, near: Option<f64>) -> Top {
        let (u, z) = (Var::parameter(x, ASIDE, 1.0), Var::parameter(z, ABOVE, 1.0));
        Top { h, u, z, near, heap: Var::fixed(0.0), hollow: None }
    }

    /// By how much a fairlead lies below a bottom that carries the first piece (m).
    fn buried(&self, x: f64, z: f64) -> Option<f64> {
        let first = self.elements.iter().find(|e| matches!(e, Element::Length { .. }))?;
        let by = self.bottom.elevation(x) - z;
        (first.can_rest() && by > self.fine).then_some(by)
    }
}

/// The line with its fairlead `x` beside the anchor, at elevation `z`.
pub fn between_ends(line: &Line, x: f64, z: f64, last: Option<&State>) -> Result<State, LineError> {
    let mut layout = Layout::new(line, x, z);
    if let Some(by) = layout.buried(x, z) {
        return Err(LineError::BelowBottom(by));
    }
    let least = layout.least;
    let mut near = last.map(|s| s.top_vertical);
    let begin = match last {
        Some(last) if last.force > least && last.stiffness[0][0].is_finite() => {
            let [[xx, xz], _] = last.stiffness;
            let risen = last.places.first().map_or(0.0, |p| z - p.1);
            let predicted = last.force + xx * (x - last.x) + if xz.is_finite() { xz * risen } else { 0.0 };
            predicted.max(0.1 * last.force)
        }
        _ => (0.3 * layout.weight).max(16.0 * least),
    };
    let mut best: Option<(f64, Laid)> = None;
    let mut failed = None;
    let mut hollow = None;
    let (_, steps) = rising_root(begin, x, |h| {
        let h = h.max(least);
        match layout.lay(&layout.top(Var::parameter(h, FORCE, 1.0), x, z, near)) {
            Ok(laid) => {
                let (short, slope) = (laid.short.value, -laid.short.by[FORCE]);
                near = Some(laid.top.value);
                if let Some((Heap::Hollow(sump), _)) = laid.heap {
                    hollow = Some((h, sump));
                }
                // the least force already reaches so far
                let limp = h <= least && short <= 0.0;
                if limp || best.as_ref().is_none_or(|(_, b)| short.abs() <= b.short.value.abs()) {
                    best = Some((h, laid));
                }
                Point { value: if limp { x } else { x - short }, slope }
            }
            Err(error) => {
                // too little force, as far as the search knows; what is found is proven
                failed = Some(error);
                Point { value: x - layout.length, slope: f64::NAN }
            }
        }
    });
    let Some((h, mut laid)) = best else {
        return Err(failed.unwrap_or(LineError::NotConverged { force: begin, residual: f64::NAN, iterations: steps }));
    };
    laid.iterations += steps;
    let in_hollow = matches!(laid.heap, Some((Heap::Hollow(_), _)));
    if let Some((force, sump)) = hollow.filter(|_| in_hollow || laid.short.value.abs() > 1e-9 * layout.length) {
        laid = heap_in_hollow(&layout, [x, z], force, sump)?;
    }
    let slack = h <= 4.0 * least && laid.short.value <= 0.0;
    if slack {
        // little may hang: without horizontal force means little against that
        let hanging = laid.top.value.abs();
        if hanging > least && hanging * 1e-11 < least {
            layout.least = 1e-11 * hanging;
            let finer = layout.lay(&layout.top(Var::parameter(layout.least, FORCE, 1.0), x, z, near));
            laid = finer.unwrap_or(laid);
        }
        if line.weightless() && laid.short.value < -1e-9 * (layout.length + x) {
            return Err(LineError::Undetermined);
        }
        let lies = laid.stretches.iter().any(|s| s.manner != Manner::Hangs);
        if lies && laid.short.value < -layout.fine {
            laid = heap_at_touchdown(&layout, x, z, &laid)?;
        }
        // what hangs has no place for spare length but where it weighs nothing
        if !lies && laid.short.value < -1e-9 * (layout.length + x) {
            return Err(LineError::Undetermined);
        }
    }
    layout.state(laid, [x, z], slack).map_err(|error| match (error, failed) {
        (LineError::Unproven { .. }, Some(reason)) => reason,
        (error, _) => error,
    })
}

/// The line without horizontal force: it hangs straight down, and what it has too much lies in a heap there.
fn heap_at_touchdown(layout: &Layout, x: f64, z: f64, without: &Laid) -> Result<Laid, LineError> {
    let mut best: Option<Laid> = None;
    let mut failed = None;
    let start = -without.short.value;
    rising_root(start, 0.0, |length| {
        let top = layout.top(Var::fixed(layout.least), x, z, Some(without.top.value));
        match layout.lay(&Top { heap: Var::parameter(length, FORCE, 1.0), ..top }) {
            Ok(laid) => {
                let found = Point { value: laid.short.value, slope: laid.short.by[FORCE] };
                if best.as_ref().is_none_or(|b| found.value.abs() <= b.short.value.abs()) {
                    best = Some(laid);
                }
                found
            }
            Err(error) => {
                failed = Some(error);
                Point { value: f64::NAN, slope: f64::NAN }
            }
        }
    });
    match (best, failed) {
        (_, Some(error)) => Err(error),
        (Some(laid), None) if laid.short.value.abs() > 1e-9 * (layout.length + x) => Err(LineError::NotConverged {
            force: layout.least,
            residual: laid.short.value.abs(),
            iterations: laid.iterations,
        }),
        (Some(laid), None) => Ok(laid),
        (None, None) => Err(LineError::SlackSlope),
    }
}

/// The line whose spare length lies in a hollow: without tension it comes down to it from the one side, and hangs down to
/// it from the anchor on the other.
fn heap_in_hollow(layout: &Layout, [x, z]: [f64; 2], force: f64, sump: f64) -> Result<Laid, LineError> {
    let mut near: Option<(f64, Laid)> = None;
    let lost = |left| LineError::NotConverged { force, residual: left, iterations: MOST_STEPS };
    rising_root(force, 0.0, |h| match layout.lay(&layout.top(Var::parameter(h, FORCE, 1.0), x, z, None)) {
        Ok(laid) if laid.heap.is_some_and(|(place, _)| place == Heap::Hollow(sump)) => {
            let found = Point { value: -laid.short.value, slope: -laid.short.by[FORCE] };
            if near.as_ref().is_none_or(|(_, n)| laid.short.value < n.short.value) {
                near = Some((h, laid));
            }
            found
        }
        // with tension beyond the hollow
        _ => Point { value: layout.length, slope: f64::NAN },
    });
    let Some((h, above)) = near else { return Err(lost(f64::NAN)) };
    let mut best: Option<Laid> = None;
    rising_root(0.01 * layout.length, 0.0, |length| {
        let top = layout.top(Var::fixed(h), x, z, Some(above.top.value));
        match layout.lay(&Top { hollow: Some((sump, Var::parameter(length, FORCE, 1.0))), ..top }) {
            Ok(laid) => {
                let found = Point { value: laid.short.value, slope: laid.short.by[FORCE] };
                if best.as_ref().is_none_or(|b| found.value.abs() <= b.short.value.abs()) {
                    best = Some(laid);
                }
                found
            }
            Err(_) => Point { value: f64::NAN, slope: f64::NAN },
        }
    });
    let below = best.ok_or_else(|| lost(f64::NAN))?;
    if below.short.value.abs() > 1e-9 * layout.length {
        return Err(lost(below.short.value));
    }
    // the two sides do not feel each other
    let end = below.end.map(|v| Var::fixed(v.value));
    Ok(Laid { short: above.short, top: above.top, end, ..below })
}

/// The line with a horizontal force at its fairlead, at elevation `z`.
pub fn at_force(line: &Line, force: f64, z: f64) -> Result<State, LineError> {
    let layout = Layout::new(line, line.length(), z);
    let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
    let mut at = 0.9 * layout.length;
    let mut near = None;
    let mut best: Option<(f64, Laid)> = None;
    for _ in 0..MOST_STEPS {
        if layout.buried(at, z).is_some() {
            high = at;
            at = if low.is_finite() { 0.5 * (low + high) } else { at - layout.length };
            continue;
        }
        let laid = layout.lay(&layout.top(Var::parameter(force, FORCE, 1.0), at, z, near))?;
        near = Some(laid.top.value);
        let (short, slope) = (laid.short.value, laid.short.by[ASIDE]);
        if short > 0.0 {
            high = at;
        } else {
            low = at;
        }
        let better = best.as_ref().is_none_or(|(_, b)| short.abs() < b.short.value.abs());
        if better {
            best = Some((at, laid));
        }
        let newton = at - short / slope;
        let next = if newton > low && newton < high {
            newton
        } else if low.is_finite() && high.is_finite() {
            0.5 * (low + high)
        } else {
            at - short
        };
        if short.abs() <= layout.fine || !better || next == at || next.is_nan() {
            break;
        }
        at = next;
    }
    match best {
        Some((x, laid)) => layout.state(laid, [x, z], false),
        None => Err(LineError::NotConverged { force, residual: f64::NAN, iterations: MOST_STEPS }),
    }
}
