//! Work in parts that threads take side by side. What the parts give is returned in their order, so that sums over it do not depend on the number
//! of threads.

use std::sync::{Mutex, PoisonError};

/// Hands each of `count` parts to a function; the calling thread takes parts, too, and threads of the pool that find time.
pub fn for_each_part<P>(count: usize, parts: impl Iterator<Item = P> + Send, function: impl Fn(P) + Sync) {
    let helpers = rayon::current_num_threads().min(count).saturating_sub(1);
    if helpers == 0 {
        return parts.for_each(function);
    }
    let left = Mutex::new(parts);
    let next = || left.lock().unwrap_or_else(PoisonError::into_inner).next();
    let work = || {
        while let Some(part) = next() {
            function(part);
        }
    };
    rayon::in_place_scope(|scope| {
        for _ in 0..helpers {
            scope.spawn(|_| work());
        }
        work();
    });
}

/// Applies a function to each part, as [`for_each_part`].
pub(crate) fn map_parts<P: Send, R: Send>(parts: impl Iterator<Item = P>, function: impl Fn(P) -> R + Sync) -> Vec<R> {
    let parts: Vec<P> = parts.collect();
    let mut results: Vec<Option<R>> = parts.iter().map(|_| None).collect();
    for_each_part(parts.len(), parts.into_iter().zip(&mut results), |(part, result)| *result = Some(function(part)));
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
