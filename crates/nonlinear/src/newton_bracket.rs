//! Newton's iteration in one unknown, kept within a bracket: a step that leaves the bracket is replaced by its middle, or by a step outward
//! while one side is still open.

/// The bracket of the root of a rising function.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewtonBracket {
    /// The largest argument below the root; minus infinity while there is none.
    pub low: f64,
    /// The least argument above the root; infinity while there is none.
    pub high: f64,
}

impl NewtonBracket {
    /// Open on both sides.
    pub const OPEN: NewtonBracket = NewtonBracket { low: f64::NEG_INFINITY, high: f64::INFINITY };

    /// A bracket between two arguments.
    pub fn new(low: f64, high: f64) -> Self {
        NewtonBracket { low, high }
    }

    /// Records what the function has over its wanted value at an argument: that becomes the upper end where it is too much, else the lower.
    pub fn record(&mut self, at: f64, excess: f64) {
        if excess > 0.0 {
            self.high = at;
        } else {
            self.low = at;
        }
    }

    /// Whether it is bounded on both sides.
    pub fn is_closed(&self) -> bool {
        self.low.is_finite() && self.high.is_finite()
    }

    /// Whether an argument lies strictly within it.
    pub fn contains(&self, at: f64) -> bool {
        at.is_finite() && at > self.low && at < self.high
    }

    /// Its middle.
    pub fn middle(&self) -> f64 {
        0.5 * (self.low + self.high)
    }

    /// Whether it is closed and no wider than so many roundings of its ends.
    pub fn is_narrower_than(&self, roundings: f64) -> bool {
        self.is_closed() && self.high - self.low <= roundings * f64::EPSILON * (self.low.abs() + self.high.abs())
    }

    /// The next argument: that of Newton's step if it lies within (a step that is not wanted is NaN), otherwise the middle of a closed
    /// bracket, otherwise `outward`.
    pub fn step(&self, newton: f64, outward: impl FnOnce() -> f64) -> f64 {
        if self.contains(newton) {
            newton
        } else if self.is_closed() {
            self.middle()
        } else {
            outward()
        }
    }
}

/// Newton's iteration for the root of a rising function of which nothing is known but a start and a length of step.
#[derive(Clone, Copy, Debug)]
pub struct NewtonSearch {
    /// The bracket so far.
    pub bracket: NewtonBracket,
    /// The longest step while the bracket is open; doubled with each step outward.
    reach: f64,
}

impl NewtonSearch {
    /// A search that begins in a bracket, which may be open, and while it is goes no further than `reach` at a time.
    pub fn new(bracket: NewtonBracket, reach: f64) -> Self {
        NewtonSearch { bracket, reach }
    }

    /// Records what the function has over its wanted value at an argument, and proposes the next: that of Newton's step where it is in the
    /// bracket and within reach (a step that is not wanted is NaN).
    pub fn advance(&mut self, at: f64, excess: f64, newton: f64) -> f64 {
        self.bracket.record(at, excess);
        let within_reach = self.bracket.is_closed() || (newton - at).abs() < self.reach;
        self.bracket.step(if within_reach { newton } else { f64::NAN }, || {
            self.reach *= 2.0;
            if excess > 0.0 { at - self.reach } else { at + self.reach }
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The root of a rising function given with its slope, from a start without a bracket, and the evaluations it took.
    fn root(start: f64, f: impl Fn(f64) -> (f64, f64)) -> (f64, usize) {
        let (mut search, mut at) = (NewtonSearch::new(NewtonBracket::OPEN, 1.0), start);
        for evaluation in 1..200 {
            let (excess, slope) = f(at);
            let next = search.advance(at, excess, at - excess / slope);
            if next == at || excess.abs() <= f64::EPSILON || search.bracket.is_narrower_than(4.0) {
                return (at, evaluation);
            }
            at = next;
        }
        (f64::NAN, 200)
    }

    #[test]
    fn root_is_found_where_newton_alone_diverges() {
        // atan: Newton alone diverges from beyond 1.3917
        for start in [-50.0, -2.0, 0.5, 3.0, 1e4] {
            let (at, evaluations) = root(start, |x| (x.atan() - 1.0, 1.0 / (1.0 + x * x)));
            assert!((at - 1f64.tan()).abs() < 4e-16 && evaluations < 40, "{start} {at} {evaluations}");
        }
    }

    #[test]
    fn step_goes_outward_until_the_bracket_is_closed() {
        let mut bracket = NewtonBracket::OPEN;
        bracket.record(1.0, -1.0);
        assert_eq!(bracket, NewtonBracket::new(1.0, f64::INFINITY));
        assert_eq!(
            (bracket.step(f64::NAN, || 9.0), bracket.step(2.0, || 9.0), bracket.step(0.5, || 9.0)),
            (9.0, 2.0, 9.0)
        );
        bracket.record(4.0, 1.0);
        assert_eq!(
            (bracket.step(f64::INFINITY, || 9.0), bracket.step(4.0, || 9.0), bracket.is_closed()),
            (2.5, 2.5, true)
        );
        assert!(!bracket.is_narrower_than(4.0) && NewtonBracket::new(1.0, 1.0 + f64::EPSILON).is_narrower_than(1.0));
    }
}
