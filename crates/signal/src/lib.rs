//! Post-processing of plain series: statistics, extremes, spectra, distributions, rainflow, harmonics, fatigue.
//!
//! A series is a `&[f64]` of samples, with a `&[f64]` of growing times where time matters. Values are SI; nothing here
//! knows where they come from. [`tables`] does the same to the columns of a [`windlass_base::table::Table`], the first of which
//! is the independent one.
//!
//! # Example
//! The series of [ASTM-E1049 figure 6]:
//! ```
//! let cycles = windlass_signal::rainflow::cycles(&[-2.0, 1.0, -3.0, 5.0, -1.0, 3.0, -4.0, 4.0, -2.0])?;
//! let of_range = |range: f64| cycles.iter().filter(|c| c.range == range).map(|c| c.count).sum::<f64>();
//! assert_eq!([3.0, 4.0, 6.0, 8.0, 9.0].map(of_range), [0.5, 1.5, 0.5, 1.0, 0.5]);
//! # Ok::<(), windlass_signal::SeriesError>(())
//! ```

#![forbid(unsafe_code)]
#![deny(missing_docs)]

pub mod band_filter;
pub mod cycle;
pub mod distribution;
pub mod ensemble;
pub mod extremes;
pub mod fatigue;
pub mod harmonics;
pub mod line;
pub mod rainflow;
pub mod running;
pub mod sampling;
pub mod spectra;
pub mod statistics;
pub mod tables;
pub mod tether;

/// Why a series could not be worked on.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum SeriesError {
    /// Fewer values than the work needs.
    #[error("{what} needs at least {need}, and there are {got}")]
    TooFew {
        /// What was asked for and what it counts, e.g. `a Weibull fit of maxima`.
        what: &'static str,
        /// How many it needs.
        need: usize,
        /// How many there are.
        got: usize,
    },
    /// A value that is no finite number.
    #[error("value {row} is not a finite number")]
    NotFinite {
        /// Its number, from 1.
        row: usize,
    },
    /// Times and values of unlike number.
    #[error("there are {times} times for {values} values")]
    Lengths {
        /// Times.
        times: usize,
        /// Values.
        values: usize,
    },
    /// Times that do not grow.
    #[error("the independent column does not grow from value {row} to the next")]
    NotGrowing {
        /// Number of the value before, from 1.
        row: usize,
    },
    /// A series without variation where one is needed.
    #[error("the series does not vary")]
    Constant,
    /// A setting out of its range.
    #[error("{what} must be {expected}, not {value}")]
    Setting {
        /// Which setting.
        what: &'static str,
        /// What it must be.
        expected: &'static str,
        /// What it was.
        value: f64,
    },
    /// Anything else, in a sentence.
    #[error("{0}")]
    Refused(String),
}

/// Sees that all values are finite.
///
/// # Errors
/// The first value that is not.
pub fn finite(values: &[f64]) -> Result<(), SeriesError> {
    match values.iter().position(|v| !v.is_finite()) {
        Some(at) => Err(SeriesError::NotFinite { row: at + 1 }),
        None => Ok(()),
    }
}

/// Sees that times and values are as many, finite, and that times grow.
///
/// # Errors
/// What is wrong, with the number of the value.
pub fn check_times(times: &[f64], values: &[f64]) -> Result<(), SeriesError> {
    if times.len() != values.len() {
        return Err(SeriesError::Lengths { times: times.len(), values: values.len() });
    }
    finite(times)?;
    finite(values)?;
    match times.windows(2).position(|w| matches!(w, [a, b] if b <= a)) {
        Some(at) => Err(SeriesError::NotGrowing { row: at + 1 }),
        None => Ok(()),
    }
}
