//! Bisection: for a place that is known by a yes or no alone, or a function that is cheap.

/// Halves a bracket so many times: `is_below` answers yes at its first end and no at its second. The two ends that are left.
pub fn bisect([mut low, mut high]: [f64; 2], halvings: usize, mut is_below: impl FnMut(f64) -> bool) -> [f64; 2] {
    for _ in 0..halvings {
        let middle = 0.5 * (low + high);
        if is_below(middle) { low = middle } else { high = middle }
    }
    [low, high]
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
}
