//! The line between two given ends, or with a given horizontal force.

use super::{LaidLine, LineLayout, SupportMode, Top};
use crate::dual::Var;
use crate::element::LinePiece;
use crate::error::LineError;
use crate::line::Line;
use crate::search::{FunctionPoint, rising_root};
use crate::state::{Heap, LineState};
use windlass_nonlinear::{Convergence, NewtonBracket};

/// Parameters of a layout: the horizontal force (or the length of a heap), and the place of the fairlead.
const FORCE_PARAMETER: usize = 0;
const DISTANCE_PARAMETER: usize = 1;
const HEIGHT_PARAMETER: usize = 2;
/// Share of the length by which a line falls short where the search has closed in on a jump, and share within which it has.
const JUMP_SHARE: f64 = 1e-9;
/// Steps of the search for the distance.
const MAX_SEARCH_STEPS: usize = 200;

impl LineLayout<'_> {
    fn top(&self, h: Var, x: f64, z: f64, near: Option<f64>) -> Top<'static> {
        let (u, z) = (Var::parameter(x, DISTANCE_PARAMETER, 1.0), Var::parameter(z, HEIGHT_PARAMETER, 1.0));
        Top { h, u, z, near, heap: Var::constant(0.0), hollow: None, holds: &[], should_continue: true, sunk: &[] }
    }

    /// The least force stands for none: what hangs under it is upright but for this (m).
    fn aside(&self, laid: &LaidLine) -> f64 {
        let hanging = laid.stretches.iter().filter(|s| s.manner == SupportMode::Hangs && s.h <= 2.0 * self.least);
        hanging.map(|s| s.u - s.low[0]).sum()
    }

    /// By how much a fairlead lies below a bottom that carries the first piece (m).
    fn fairlead_penetration(&self, x: f64, z: f64) -> Option<f64> {
        let first = self.elements.iter().find(|e| matches!(e, LinePiece::Length { .. }))?;
        let by = self.bottom.elevation(x) - z;
        (first.can_rest() && by > self.fine).then_some(by)
    }
}

/// The line with its fairlead `x` (m) beside the anchor, at elevation `z` (m).
///
/// # Errors
/// A fairlead below a bottom that carries the line, a line without an equilibrium there, or a search that ends beside the
/// anchor.
pub fn between_ends(line: &Line, x: f64, z: f64, last: Option<&LineState>) -> Result<LineState, LineError> {
    let found = seek_between_ends(LineLayout::new(line, x, z), [x, z], last);
    match found {
        // the end may jump where one of several places was taken from which a span can leave, not the last of them
        Err(LineError::NotConverged { .. } | LineError::Unproven { .. }) => {
            let layout = LineLayout { thorough: true, ..LineLayout::new(line, x, z) };
            seek_between_ends(layout, [x, z], None).or(found)
        }
        found => found,
    }
}

fn seek_between_ends(
    mut layout: LineLayout,
    [x, z]: [f64; 2],
    last: Option<&LineState>,
) -> Result<LineState, LineError> {
    let line = layout.line;
    if let Some(by) = layout.fairlead_penetration(x, z) {
        return Err(LineError::BelowBottom(by));
    }
    let least = layout.least;
    let mut near = last.map(|s| s.top_vertical);
    let begin = match last {
        Some(last) if last.force > least && last.stiffness[0][0].is_finite() => {
            let [[xx, xz], _] = last.stiffness;
            let risen = last.positions.first().map_or(0.0, |p| z - p.1);
            let predicted = last.force + xx * (x - last.x) + if xz.is_finite() { xz * risen } else { 0.0 };
            predicted.max(0.1 * last.force)
        }
        _ => (0.3 * layout.weight).max(16.0 * least),
    };
    let mut best: Option<(f64, LaidLine)> = None;
    let mut sides: [Option<f64>; 2] = [None, None];
    let mut failed = None;
    let mut hollow = None;
    let (_, steps) = rising_root(begin, x, |h| {
        let h = h.max(least);
        match layout.lay(&layout.top(Var::parameter(h, FORCE_PARAMETER, 1.0), x, z, near)) {
            Ok(laid) => {
                let (short, slope) = (laid.short.value, -laid.short.by[FORCE_PARAMETER]);
                near = Some(laid.top.value);
                if let Some((Heap::Hollow(sump), _)) = laid.heap {
                    hollow = Some((h, sump));
                }
                // the least force already reaches so far
                let limp = h <= least && short <= 0.0;
                sides[usize::from(short <= 0.0)] = Some(h);
                if limp || best.as_ref().is_none_or(|(_, b)| short.abs() <= b.short.value.abs()) {
                    best = Some((h, laid));
                }
                FunctionPoint { value: if limp { x } else { x - short }, slope }
            }
            Err(error) => {
                // too little force, as far as the search knows; what is found is proven
                failed = Some(error);
                FunctionPoint { value: x - layout.length, slope: f64::NAN }
            }
        }
    });
    let Some((mut h, mut laid)) = best else {
        return Err(failed.unwrap_or(LineError::NotConverged { force: begin, residual: f64::NAN, iterations: steps }));
    };
    laid.iterations += steps;
    let in_hollow = matches!(laid.heap, Some((Heap::Hollow(_), _)));
    if let Some((force, sump)) = hollow.filter(|_| in_hollow || laid.short.value.abs() > JUMP_SHARE * layout.length) {
        laid = heap_in_hollow(&layout, [x, z], force, sump)?;
    } else if laid.short.value.abs() > JUMP_SHARE * layout.length
        && let [Some(low), Some(high)] = sides
        && (high - low).abs() <= JUMP_SHARE * high
    {
        let top = |h: f64| layout.top(Var::parameter(h, FORCE_PARAMETER, 1.0), x, z, None);
        if let Some(found) = layout.between_folds(&top, &|h, by: f64| h * by.exp(), [low, high]) {
            (h, laid) = found;
        }
    }
    let slack = h <= 4.0 * least && laid.short.value <= 0.0;
    if slack {
        // little may hang: without horizontal force means little against that
        let hanging = laid.top.value.abs();
        if hanging > least && hanging * 1e-11 < least {
            layout.least = 1e-11 * hanging;
            let finer = layout.lay(&layout.top(Var::parameter(layout.least, FORCE_PARAMETER, 1.0), x, z, near));
            laid = finer.unwrap_or(laid);
        }
        if line.weightless() && laid.short.value < -1e-9 * (layout.length + x) {
            return Err(LineError::Undetermined);
        }
        let lies = laid.stretches.iter().any(|s| s.manner != SupportMode::Hangs);
        if lies && laid.short.value < -layout.fine {
            laid = heap_at_touchdown(&layout, x, z, &laid)?;
        }
        // what hangs has no place for spare length but where it weighs nothing
        if !lies && laid.short.value < -1e-9 * (layout.length + x) - layout.aside(&laid) {
            return Err(LineError::Undetermined);
        }
    }
    layout.state(laid, [x, z], slack).map_err(|error| match (error, failed) {
        (LineError::Unproven { .. }, Some(reason)) => reason,
        (error, _) => error,
    })
}

/// The line without horizontal force: it hangs straight down, and what it has too much lies in a heap there.
fn heap_at_touchdown(layout: &LineLayout, x: f64, z: f64, without: &LaidLine) -> Result<LaidLine, LineError> {
    let mut best: Option<LaidLine> = None;
    let mut failed = None;
    let start = -without.short.value;
    rising_root(start, 0.0, |length| {
        let top = layout.top(Var::constant(layout.least), x, z, Some(without.top.value));
        match layout.lay(&Top { heap: Var::parameter(length, FORCE_PARAMETER, 1.0), ..top }) {
            Ok(laid) => {
                let found = FunctionPoint { value: laid.short.value, slope: laid.short.by[FORCE_PARAMETER] };
                if best.as_ref().is_none_or(|b| found.value.abs() <= b.short.value.abs()) {
                    best = Some(laid);
                }
                found
            }
            Err(error) => {
                failed = Some(error);
                FunctionPoint { value: f64::NAN, slope: f64::NAN }
            }
        }
    });
    let Some(laid) = best else {
        let none = LineError::NotConverged { force: layout.least, residual: f64::NAN, iterations: 0 };
        return Err(failed.unwrap_or(none));
    };
    let residual = laid.short.value.abs();
    if residual <= 1e-9 * (layout.length + x) + layout.aside(&laid) {
        return Ok(laid);
    }
    let iterations = laid.iterations;
    Err(failed.unwrap_or(LineError::NotConverged { force: layout.least, residual, iterations }))
}

/// The line whose spare length lies in a hollow: without tension it comes down to it from the one side, and hangs down to
/// it from the anchor on the other.
fn heap_in_hollow(layout: &LineLayout, [x, z]: [f64; 2], force: f64, sump: f64) -> Result<LaidLine, LineError> {
    let mut near: Option<(f64, LaidLine)> = None;
    let lost = |left| LineError::NotConverged { force, residual: left, iterations: MAX_SEARCH_STEPS };
    rising_root(force, 0.0, |h| match layout.lay(&layout.top(Var::parameter(h, FORCE_PARAMETER, 1.0), x, z, None)) {
        Ok(laid) if laid.heap.is_some_and(|(position, _)| position == Heap::Hollow(sump)) => {
            let found = FunctionPoint { value: -laid.short.value, slope: -laid.short.by[FORCE_PARAMETER] };
            if near.as_ref().is_none_or(|(_, n)| laid.short.value < n.short.value) {
                near = Some((h, laid));
            }
            found
        }
        // with tension beyond the hollow
        _ => FunctionPoint { value: layout.length, slope: f64::NAN },
    });
    let Some((h, above)) = near else { return Err(lost(f64::NAN)) };
    beyond_hollow(layout, [x, z], h, sump, above)
}

/// The line that hangs down from the anchor to a hollow, on whose other side it is known.
fn beyond_hollow(
    layout: &LineLayout,
    [x, z]: [f64; 2],
    h: f64,
    sump: f64,
    above: LaidLine,
) -> Result<LaidLine, LineError> {
    let lost = |left| LineError::NotConverged { force: h, residual: left, iterations: MAX_SEARCH_STEPS };
    let mut best: Option<LaidLine> = None;
    rising_root(0.01 * layout.length, 0.0, |length| {
        let top = layout.top(Var::constant(h), x, z, Some(above.top.value));
        match layout.lay(&Top { hollow: Some((sump, Var::parameter(length, FORCE_PARAMETER, 1.0))), ..top }) {
            Ok(laid) => {
                let found = FunctionPoint { value: laid.short.value, slope: laid.short.by[FORCE_PARAMETER] };
                if best.as_ref().is_none_or(|b| found.value.abs() <= b.short.value.abs()) {
                    best = Some(laid);
                }
                found
            }
            Err(_) => FunctionPoint { value: f64::NAN, slope: f64::NAN },
        }
    });
    let below = best.ok_or_else(|| lost(f64::NAN))?;
    if below.short.value.abs() > 1e-9 * layout.length {
        return Err(lost(below.short.value));
    }
    // the two sides do not feel each other
    let end = below.end.map(|v| Var::constant(v.value));
    Ok(LaidLine { short: above.short, top: above.top, end, ..below })
}

/// The line with a horizontal force (N) at its fairlead, at elevation `z` (m).
///
/// # Errors
/// A force under which the line has no equilibrium, or a search that ends beside it.
pub fn at_force(line: &Line, force: f64, z: f64) -> Result<LineState, LineError> {
    let layout = LineLayout::new(line, line.length(), z);
    let top = |at: f64| layout.top(Var::parameter(force, FORCE_PARAMETER, 1.0), at, z, None);
    let mut at = 0.9 * layout.length;
    let mut near = None;
    let mut sides: [Option<f64>; 2] = [None, None];
    let mut best: Option<(f64, LaidLine)> = None;
    let mut convergence = Convergence::new(layout.fine);
    let mut buried = f64::INFINITY;
    for _ in 0..MAX_SEARCH_STEPS {
        let low = sides[1].unwrap_or(f64::NEG_INFINITY);
        if layout.fairlead_penetration(at, z).is_some() {
            buried = at;
            at = if low.is_finite() { 0.5 * (low + at) } else { at - layout.length };
            continue;
        }
        let laid = layout.lay(&Top { near, ..top(at) })?;
        near = Some(laid.top.value);
        let (short, slope) = (laid.short.value, laid.short.by[DISTANCE_PARAMETER]);
        let status = convergence.record(short.abs());
        if status.is_improved() || best.is_none() {
            best = Some((at, laid));
        }
        sides[usize::from(short <= 0.0)] = Some(at);
        let [above, below] = sides;
        let bracket =
            NewtonBracket::new(below.unwrap_or(f64::NEG_INFINITY), above.unwrap_or(f64::INFINITY).min(buried));
        if status.is_final() {
            break;
        }
        let newton = if status.is_improved() || !bracket.is_closed() { at - short / slope } else { f64::NAN };
        let next = bracket.step(newton, || at - short);
        if next == at || next.is_nan() || bracket.high - bracket.low <= layout.fine {
            break;
        }
        at = next;
    }
    let Some((mut x, mut laid)) = best else {
        return Err(LineError::NotConverged { force, residual: f64::NAN, iterations: MAX_SEARCH_STEPS });
    };
    if laid.short.value.abs() > JUMP_SHARE * layout.length
        && let [Some(high), Some(low)] = sides
        && (high - low).abs() <= JUMP_SHARE * layout.length
        && let Some(found) = layout.between_folds(&top, &|at, by| at + by * layout.length, [high, low])
    {
        (x, laid) = found;
    }
    if let Some((Heap::Hollow(sump), _)) = laid.heap {
        laid = beyond_hollow(&layout, [x, z], force, sump, laid)?;
    }
    layout.state(laid, [x, z], false)
}
