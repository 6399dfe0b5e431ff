//! Work in parts that threads take side by side. What the parts give is returned in their order, so that sums over it do not depend on the number
//! of threads.

use std::sync::{Mutex, PoisonError};

/// Applies a function to each part; the calling thread takes parts, too, and threads of the pool that find time.
pub(crate) fn map_parts<P: Send, R: Send>(parts: impl Iterator<Item = P>, function: impl Fn(P) -> R + Sync) -> Vec<R> {
    let parts: Vec<P> = parts.collect();
    let helpers = rayon::current_num_threads().min(parts.len()).saturating_sub(1);
    if helpers == 0 {
        return parts.into_iter().map(function).collect();
    }
    let mut results: Vec<Option<R>> = parts.iter().map(|_| None).collect();
    let left = Mutex::new(parts.into_iter().zip(&mut results));
    let next = || left.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = || {
        while let Some((part, result)) = next() {
            *result = Some(function(part));
        }
    };
    rayon::in_place_scope(|scope| {
        for _ in 0..helpers {
            scope.spawn(|_| work());
        }
        work();
    });
    results.into_iter().flatten().collect()
}

#[cfg(test)]
mod tests {
    use super::map_parts;

    #[test]
    fn parallel_results_keep_their_order() {
        let squares = map_parts(0..1000u64, |n| n * n);
        assert!(squares.iter().zip(0..1000u64).all(|(square, n)| *square == n * n) && squares.len() == 1000);
        assert!(map_parts(std::iter::empty::<u8>(), |n| n).is_empty());
    }
}
