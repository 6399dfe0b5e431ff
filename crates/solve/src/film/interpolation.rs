//! Rows of a run between its stored instants.

use crate::time::History;

/// The rows of a run at instants in rising order, straight between stored ones.
pub(super) fn rows(history: &History, times: &[f64]) -> Vec<Vec<f64>> {
    let stored: Vec<&[f64]> = history.rows().collect();
    let time = |row: &[f64]| row.first().copied().unwrap_or(f64::NAN);
    let at = |wanted: &f64| -> Option<Vec<f64>> {
        let behind = stored.partition_point(|row| time(row) <= *wanted);
        let before = *stored.get(behind.checked_sub(1)?)?;
        let Some(after) = stored.get(behind).filter(|_| time(before) != *wanted) else { return Some(before.to_vec()) };
        let share = (wanted - time(before)) / (time(after) - time(before));
        Some(before.iter().zip(*after).map(|(a, b)| a + share * (b - a)).collect())
    };
    times.iter().filter_map(at).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history() -> History {
        let values = (0..=10).flat_map(|n| [0.5 * f64::from(n), f64::from(n * n)]).collect();
        let mut made = History { values, ..History::default() };
        made.layout.width = 2;
        made
    }

    #[test]
    fn rows_are_linear_between_stored_instants_and_exact_at_them() {
        let found = rows(&history(), &[0.0, 0.75, 1.0, 5.0]);
        assert_eq!(found, [[0.0, 0.0], [0.75, 2.5], [1.0, 4.0], [5.0, 100.0]].map(Vec::from));
    }
}
