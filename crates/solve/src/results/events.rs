//! Which instants of a run are reported.

use super::super::time::History;
use windlass_base::units::Dim;
use windlass_model::ClassError;

/// Most events of one table.
const MAX_EVENTS: f64 = 2e6;

/// The events a user asks for, by their times (s).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct EventWindow {
    /// The first.
    pub begin: f64,
    /// The last; none, or one behind the last of the run: that.
    pub end: Option<f64>,
    /// From one to the next; none or zero: the stored instants.
    pub increment: Option<f64>,
}

/// An instant of a run: a stored row, or a share of the way from it to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunEvent {
    pub(super) row: usize,
    pub(super) share: f64,
}

impl RunEvent {
    /// Its time (s), where it is a stored row of this history or behind one.
    pub fn time(&self, history: &History) -> Option<f64> {
        let at = |row: usize| history.values.get(row * history.layout.width.max(1)).copied();
        let here = at(self.row)?;
        Some(if self.share > 0.0 { here + self.share * (at(self.row + 1)? - here) } else { here })
    }
}

/// The instants a window asks for; without one all that are stored.
///
/// # Errors
/// A run without rows; a window that chooses nothing, or more than two million events.
pub fn events(history: &History, window: Option<&EventWindow>) -> Result<Vec<RunEvent>, ClassError> {
    let times = history.times();
    let (Some(first), Some(last)) = (times.first().copied(), times.last().copied()) else {
        return Err(ClassError::new("the run kept no instants").help("TDOM without -STATISTICS keeps them"));
    };
    let Some(window) = window else {
        return Ok((0..times.len()).map(|row| RunEvent { row, share: 0.0 }).collect());
    };
    // what a user types is a stored time but for rounding
    let near = 1e-9 * last.abs().max(1.0);
    let wanted = window.end.unwrap_or(last);
    let end = wanted.min(last);
    if wanted < window.begin {
        let text = "-EVENTS ends at {}, before it begins at {}";
        return Err(ClassError::with_values(text, &[(wanted, Dim::Time), (window.begin, Dim::Time)]));
    }
    let nothing = || {
        let text = "-EVENTS from {} to {} chooses none of the instants, which are from {} to {}";
        let values = [window.begin, wanted, first, last].map(|v| (v, Dim::Time));
        ClassError::with_values(text, &values)
    };
    let mut found = Vec::new();
    match window.increment.filter(|i| *i > 0.0) {
        None => {
            let within = |t: &f64| *t >= window.begin - near && *t <= end + near;
            let rows = times.iter().enumerate().filter(|(_, t)| within(t));
            found.extend(rows.map(|(row, _)| RunEvent { row, share: 0.0 }));
        }
        Some(increment) => {
            // the first that is not before the run
            let from = ((first - near - window.begin) / increment).ceil().max(0.0);
            let to = ((end + near - window.begin) / increment).floor();
            if to - from > MAX_EVENTS {
                let text = "-EVENTS with an increment of {} makes more than two million events";
                return Err(ClassError::with_values(text, &[(increment, Dim::Time)]).help("a larger INC"));
            }
            let count = if to >= from { (to - from) as usize + 1 } else { 0 };
            let mut row = 0;
            for k in 0..count {
                let time = window.begin + (from + k as f64) * increment;
                while times.get(row + 1).is_some_and(|next| *next <= time + near) {
                    row += 1;
                }
                let (Some(here), next) = (times.get(row), times.get(row + 1)) else { break };
                let share = match next {
                    Some(next) if time > here + near => ((time - here) / (next - here)).clamp(0.0, 1.0),
                    _ => 0.0,
                };
                found.push(RunEvent { row, share });
            }
        }
    }
    if found.is_empty() { Err(nothing()) } else { Ok(found) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::time::RowLayout;

    /// Rows of the time alone, every half second to ten.
    fn history() -> History {
        let mut layout = RowLayout::default();
        layout.width = 1;
        History { layout, values: (0..=20).map(|n| 0.5 * f64::from(n)).collect() }
    }

    fn events_between(begin: f64, end: Option<f64>, increment: Option<f64>) -> Result<Vec<(usize, f64)>, ClassError> {
        let found = events(&history(), Some(&EventWindow { begin, end, increment }))?;
        Ok(found.into_iter().map(|e| (e.row, e.share)).collect())
    }

    #[test]
    fn events_are_times_and_end_beyond_data_is_clipped() {
        assert_eq!(events_between(9.0, Some(9000.0), None).unwrap(), [(18, 0.0), (19, 0.0), (20, 0.0)]);
        assert_eq!(events_between(8.0, Some(9000.0), Some(1.0)).unwrap(), [(16, 0.0), (18, 0.0), (20, 0.0)]);
        assert_eq!(
            events_between(-3.0, Some(0.0), Some(2.0)).unwrap_err().to_string().matches("none of the instants").count(),
            1
        );
        assert_eq!(events_between(-2.0, Some(0.0), Some(2.0)).unwrap(), [(0, 0.0)]);
        assert_eq!(events(&history(), None).unwrap().len(), 21);
    }

    #[test]
    fn instant_between_stored_ones_has_its_fraction() {
        assert_eq!(
            events_between(1.0, Some(1.5), Some(0.125)).unwrap(),
            [(2, 0.0), (2, 0.25), (2, 0.5), (2, 0.75), (3, 0.0)]
        );
    }

    #[test]
    fn empty_or_too_large_time_windows_are_refused() {
        assert!(events_between(11.0, None, None).is_err());
        assert!(events_between(0.6, Some(0.7), None).is_err());
        assert!(events_between(5.0, Some(4.0), None).unwrap_err().to_string().contains("before it begins"));
        assert!(events_between(0.0, None, Some(1e-9)).unwrap_err().to_string().contains("two million"));
        assert!(events(&History::default(), None).is_err());
    }
}
