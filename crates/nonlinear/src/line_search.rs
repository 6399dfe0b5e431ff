//! A line search by halvings.

/// Tries shares of a step from `first` on, each half of the one before, at most `most` of them: the first that `accept` makes something
/// of, with what it made.
pub fn backtrack<T>(first: f64, most: usize, mut accept: impl FnMut(f64) -> Option<T>) -> Option<(f64, T)> {
    let mut share = first;
    for _ in 0..most {
        if let Some(made) = accept(share) {
            return Some((share, made));
        }
        share *= 0.5;
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn first_share_with_lower_function_is_taken() {
        // Newton's step from 3 for the root of atan: a quarter of it comes nearer than the start, a half does not
        let (at, step) = (3.0f64, -3f64.atan() * 10.0);
        let lower = |share: f64| Some(at + share * step).filter(|x| x.atan().abs() < at.atan());
        assert_eq!(backtrack(1.0, 30, lower), Some((0.25, at + 0.25 * step)));
        assert_eq!(backtrack(1.0, 2, lower), None);
    }
}
