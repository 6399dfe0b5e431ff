//! A safeguarded search for a positive root.

use windlass_nonlinear::NewtonBracket;

/// A function's value and slope.
#[derive(Clone, Copy, Debug)]
pub struct FunctionPoint {
    /// Value of the function.
    pub value: f64,
    /// Its derivative by the argument.
    pub slope: f64,
}

/// Steps after which a search gives up.
const MAX_SEARCH_STEPS: usize = 200;

/// The argument > 0 at which a rising function has the value `target`: Newton within a bracket, which is widened by
/// factors until it holds the root, and halved in the logarithm where Newton leaves it. Returns the best argument met
/// and the steps; the caller proves it.
pub fn rising_root(start: f64, target: f64, mut f: impl FnMut(f64) -> FunctionPoint) -> (f64, usize) {
    let mut bracket = NewtonBracket::new(0.0, f64::INFINITY);
    let mut at = start;
    let mut best = (f64::INFINITY, start);
    for step in 1..=MAX_SEARCH_STEPS {
        let FunctionPoint { value, slope } = f(at);
        let off = value - target;
        if off.is_nan() {
            return (best.1, step);
        }
        if off.abs() < best.0 {
            best = (off.abs(), at);
        }
        if off == 0.0 {
            return (at, step);
        }
        bracket.record(at, off);
        let newton = at - off / slope;
        let NewtonBracket { low, high } = bracket;
        let next = if bracket.contains(newton) && newton < 16.0 * at && newton > at / 64.0 {
            newton
        } else if high.is_infinite() {
            16.0 * at
        } else if low > 0.0 {
            low.sqrt() * high.sqrt()
        } else {
            at / 64.0
        };
        let close = 2.0 * f64::EPSILON * next;
        if (next - at).abs() <= close || next == 0.0 || next.is_infinite() || high - low <= close {
            return (best.1, step);
        }
        at = next;
    }
    (best.1, MAX_SEARCH_STEPS)
}
