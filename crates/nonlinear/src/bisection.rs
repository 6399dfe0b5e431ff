//! Bisection: for a place that is known by a yes or no alone, or a function that is cheap.

use std::convert::Infallible;

/// Halves a bracket so many times: `is_below` answers yes at its first end and no at its second. The two ends that are left.
pub fn bisect(ends: [f64; 2], halvings: usize, mut is_below: impl FnMut(f64) -> bool) -> [f64; 2] {
    match try_bisect(ends, halvings, |_| false, |at| Ok::<bool, Infallible>(is_below(at))) {
        Ok(left) => left,
        Err(never) => match never {},
    }
}

/// Halves a bracket at most so many times, until `is_close` of its ends: as [`bisect`], with an answer that may fail.
///
/// # Errors
/// What `is_below` says.
pub fn try_bisect<E>(
    [mut low, mut high]: [f64; 2],
    halvings: usize,
    is_close: impl Fn([f64; 2]) -> bool,
    mut is_below: impl FnMut(f64) -> Result<bool, E>,
) -> Result<[f64; 2], E> {
    for _ in 0..halvings {
        if is_close([low, high]) {
            break;
        }
        let middle = 0.5 * (low + high);
        if is_below(middle)? { low = middle } else { high = middle }
    }
    Ok([low, high])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn halvings_leave_neighbours_about_the_root_from_either_side() {
        for ends in [[0.0, 2.0], [2.0, 0.0]] {
            let [low, high] = bisect(ends, 60, |x| (x * x < 2.0) == (ends[0] < ends[1]));
            assert!((low - 2f64.sqrt()).abs() < 3e-16 && (high - 2f64.sqrt()).abs() < 3e-16);
        }
        assert_eq!(bisect([0.0, 8.0], 3, |x| x < 5.5), [5.0, 6.0]);
    }

    #[test]
    fn bisection_ends_at_close_bracket_or_first_error() {
        let close = |[low, high]: [f64; 2]| high - low <= 2.0;
        assert_eq!(try_bisect([0.0, 8.0], 50, close, |x| Ok::<bool, ()>(x < 5.5)), Ok([4.0, 6.0]));
        assert_eq!(try_bisect([0.0, 8.0], 50, close, |_| Err("no number")), Err("no number"));
    }
}
