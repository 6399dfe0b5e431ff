//! The instants of a film.

use crate::language::units::Dim;
use crate::model::ClassError;
use crate::solve::time::History;

/// Most instants that are listed before they are thinned.
const MOST: f64 = 1e6;

/// A part of a run.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Window {
    /// First instant (s); none: the first of the run.
    pub begin: Option<f64>,
    /// Last instant (s); none, or one behind the run: its end.
    pub end: Option<f64>,
    /// Time from one to the next (s); none: the stored instants.
    pub increment: Option<f64>,
}

impl Window {
    /// The instants (s), of which there is at least one.
    ///
    /// # Errors
    /// A run that kept none; a window behind its end or that holds none.
    pub(super) fn times(&self, history: &History) -> Result<Vec<f64>, ClassError> {
        let stored = history.times();
        let (Some(first), Some(last)) = (stored.first().copied(), stored.last().copied()) else {
            return Err(ClassError::new("the run kept no instants").help("TDOM without -STATISTICS keeps them"));
        };
        let begin = self.begin.unwrap_or(first).max(first);
        let end = self.end.unwrap_or(last).min(last);
        let none = || {
            let text = "no instant lies in the window: the run goes from {} to {}";
            Err(ClassError::of(text, &[(first, Dim::Time), (last, Dim::Time)]))
        };
        if begin > end {
            return none();
        }
        let times: Vec<f64> = match self.increment.filter(|i| *i > 0.0) {
            None => stored.into_iter().filter(|t| (begin..=end).contains(t)).collect(),
            Some(increment) => {
                // the end belongs to it when it is met but for rounding
                let count = ((end - begin) / increment + 1e-9).floor();
                if count > MOST {
                    let text = format!("an increment of {{}} makes {count:.0} instants, more than {MOST:.0}");
                    return Err(ClassError::of(text, &[(increment, Dim::Time)]));
                }
                (0..=count as usize).map(|n| (begin + increment * n as f64).min(end)).collect()
            }
        };
        if times.is_empty() { none() } else { Ok(times) }
    }
}

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
    fn instants_are_those_stored_or_those_of_an_increment_and_never_outside_of_the_run() {
        let all = Window::default().times(&history()).unwrap();
        assert_eq!((all.len(), all[10]), (11, 5.0));
        let part = Window { begin: Some(1.0), end: Some(99.0), increment: None };
        assert_eq!(part.times(&history()).unwrap()[0], 1.0);
        let even = Window { begin: Some(-3.0), end: Some(1.0), increment: Some(0.1) }.times(&history()).unwrap();
        assert_eq!((even.len(), even[10]), (11, 1.0));
        assert!(Window { begin: Some(6.0), ..Window::default() }.times(&history()).is_err());
        assert!(Window { increment: Some(1e-9), ..Window::default() }.times(&history()).is_err());
        assert!(Window::default().times(&History::default()).is_err());
    }

    #[test]
    fn between_stored_instants_rows_are_straight_and_at_them_exact() {
        let found = rows(&history(), &[0.0, 0.75, 1.0, 5.0]);
        assert_eq!(found, [[0.0, 0.0], [0.75, 2.5], [1.0, 4.0], [5.0, 100.0]].map(Vec::from));
    }
}
