//! A root between two arguments, without derivatives: false position in the form of Illinois [DOWELL-JARRATT-1971].
//!
//! The secant through both ends proposes the next argument. When the same end stays twice in a row its weight is halved, which
//! makes the order of convergence 1.442. A function that jumps or is rough defeats the secant: there every third argument halves the
//! bracket.

/// Least share of the bracket between a proposal and either end, where halvings guard the search.
const MIN_SHARE: f64 = 1e-3;
/// One proposal of so many is the middle, where halvings guard the search.
const HALVING_INTERVAL: usize = 3;

/// Whether some proposals halve the bracket.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Halvings {
    /// None: for a smooth function, of which an evaluation is dear.
    Never,
    /// Every third, and no other comes nearer to an end than a thousandth of the bracket: for one that may jump.
    EveryThird,
}

/// The search for a root between two arguments with values of unlike signs.
#[derive(Clone, Debug)]
pub struct BracketedRoot {
    ends: [f64; 2],
    /// Values at the ends, halved where an end has stayed.
    weights: [f64; 2],
    /// The end that the last record replaced.
    replaced: Option<usize>,
    best: (f64, f64),
    proposals: usize,
    halvings: Halvings,
}

impl BracketedRoot {
    /// The search between two arguments, in any order, and their values, one of which is above zero and the other below, or zero.
    pub fn new(ends: [f64; 2], values: [f64; 2], halvings: Halvings) -> Self {
        let [a, b] = [(ends[0], values[0]), (ends[1], values[1])];
        let best = if a.1.abs() < b.1.abs() { a } else { b };
        BracketedRoot { ends, weights: values, replaced: None, best, proposals: 0, halvings }
    }

    /// The next argument to evaluate; `None` where the value of one recorded is zero, or the proposal is an end itself by
    /// rounding.
    pub fn propose(&mut self) -> Option<f64> {
        if self.best.1 == 0.0 {
            return None;
        }
        let ([a, b], [at_a, at_b]) = (self.ends, self.weights);
        let secant = at_a / (at_a - at_b);
        let share = match self.halvings {
            Halvings::Never => secant,
            Halvings::EveryThird if self.proposals % HALVING_INTERVAL == HALVING_INTERVAL - 1 => 0.5,
            Halvings::EveryThird => secant.clamp(MIN_SHARE, 1.0 - MIN_SHARE),
        };
        self.proposals += 1;
        let next = a + share * (b - a);
        (next > a.min(b) && next < a.max(b)).then_some(next)
    }

    /// Records the value at an argument within the bracket, which becomes one of its ends.
    pub fn record(&mut self, at: f64, value: f64) {
        if value.abs() < self.best.1.abs() {
            self.best = (at, value);
        }
        let side = usize::from((value < 0.0) != (self.weights[0] < 0.0));
        (self.ends[side], self.weights[side]) = (at, value);
        if self.replaced == Some(side) {
            self.weights[1 - side] *= 0.5;
        }
        self.replaced = Some(side);
    }

    /// The two ends of the bracket: where it began at the first of those given, and at the second.
    pub fn ends(&self) -> [f64; 2] {
        self.ends
    }

    /// Its width, in the unit of the argument.
    pub fn width(&self) -> f64 {
        (self.ends[1] - self.ends[0]).abs()
    }

    /// The argument with the least value so far, and that value.
    pub fn best(&self) -> (f64, f64) {
        self.best
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The root of a function, and the evaluations it took.
    fn root(ends: [f64; 2], halvings: Halvings, f: impl Fn(f64) -> f64) -> (f64, usize) {
        let mut search = BracketedRoot::new(ends, ends.map(&f), halvings);
        let mut evaluations = 0;
        while let Some(at) = search.propose() {
            evaluations += 1;
            assert!(evaluations < 200);
            search.record(at, f(at));
        }
        (search.best().0, evaluations)
    }

    #[test]
    fn known_roots_are_found_to_rounding_from_either_side() {
        for halvings in [Halvings::Never, Halvings::EveryThird] {
            for ends in [[0.0, 2.0], [2.0, 0.0]] {
                assert!((root(ends, halvings, |x| x * x - 2.0).0 - 2f64.sqrt()).abs() < 3e-16);
                assert!((root(ends, halvings, |x| 0.3 - x.powi(5)).0 - 0.3f64.powf(0.2)).abs() < 3e-16);
                // Kepler's equation with e = 1/2: E - sin(E)/2 = pi/2 - 1/2 has the root pi/2
                let kepler = |x: f64| x - 0.5 * x.sin() - (std::f64::consts::FRAC_PI_2 - 0.5);
                assert!((root(ends, halvings, kepler).0 - std::f64::consts::FRAC_PI_2).abs() < 5e-16);
            }
        }
    }

    #[test]
    fn smooth_root_takes_few_evaluations() {
        // three evaluations multiply the digits by three: a dozen are ample
        let (at, evaluations) = root([0.0, 1.0], Halvings::Never, |x| x.exp() - 2.0);
        assert!((at - std::f64::consts::LN_2).abs() < 2e-16 && evaluations <= 12, "{evaluations}");
    }

    #[test]
    fn jump_is_enclosed_by_halvings() {
        let jump = |x: f64| if x < 0.7 { -1.0 } else { 1e6 };
        let mut search = BracketedRoot::new([0.0, 1.0], [-1.0, 1e6], Halvings::EveryThird);
        while let Some(at) = search.propose() {
            search.record(at, jump(at));
        }
        let [below, above] = search.ends();
        assert!(below < 0.7 && above >= 0.7 && search.width() < 1e-12);
    }

    #[test]
    fn root_at_an_end_needs_no_proposal() {
        let mut search = BracketedRoot::new([0.0, 1.0], [-1.0, 0.0], Halvings::Never);
        assert_eq!((search.propose(), search.best()), (None, (1.0, 0.0)));
    }
}
