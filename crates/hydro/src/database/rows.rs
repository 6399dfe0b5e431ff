//! Text files of numbers, and rows of them on a grid where each place is to be filled once.

use nalgebra::Complex;
use std::f64::consts::TAU;
use windlass_base::units::Dim;
use windlass_model::Amplitudes;

/// Why a source makes no database.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum DatabaseError {
    /// A line that does not have the form.
    #[error("{file}, line {line}: {why}")]
    Line {
        /// The file.
        file: String,
        /// Its line, from 1.
        line: usize,
        /// What is wrong.
        why: String,
    },
    /// A file as a whole.
    #[error("{file}: {why}")]
    File {
        /// The file.
        file: String,
        /// What is wrong.
        why: String,
    },
    /// Several files together.
    #[error("{0}")]
    Whole(String),
}

/// A text file of a source.
#[derive(Clone, Debug, PartialEq)]
pub struct SourceFile {
    /// Its name, for messages; its ending says what it holds.
    pub name: String,
    /// Its text.
    pub text: String,
}

impl SourceFile {
    /// What is after the last point of its name, in lower case.
    pub(super) fn ending(&self) -> String {
        self.name.rsplit_once('.').map_or(String::new(), |(_, e)| e.to_ascii_lowercase())
    }

    /// An error of the file.
    pub(super) fn error(&self, why: impl Into<String>) -> DatabaseError {
        DatabaseError::File { file: self.name.clone(), why: why.into() }
    }

    /// An error of a line.
    pub(super) fn wrong_at(&self, line: usize, why: impl Into<String>) -> DatabaseError {
        DatabaseError::Line { file: self.name.clone(), line, why: why.into() }
    }

    /// Its rows of numbers; heads before the first of them are passed over, blank lines anywhere.
    pub(super) fn rows(&self, least: usize) -> Result<Vec<NumberRow>, DatabaseError> {
        let mut rows = Vec::new();
        for (index, line) in self.text.lines().enumerate() {
            let number = index + 1;
            if line.trim().is_empty() {
                continue;
            }
            match row(number, line) {
                Ok(row) if row.count >= least => rows.push(row),
                Ok(row) => {
                    let why = format!("{} numbers stand here, {least} are expected", row.count);
                    return Err(self.wrong_at(number, why));
                }
                // a head: its first word is no number at all
                Err(0) if rows.is_empty() => {}
                Err(word) => {
                    let shown = line.split(separates).filter(|w| !w.is_empty()).nth(word).unwrap_or_default();
                    let shown: String = shown.chars().take(24).filter(|c| !c.is_control()).collect();
                    let why = match parse_number(&shown).filter(|v| v.is_finite()) {
                        Some(_) => format!("`{shown}` is too large: the largest size taken is {:E}", Dim::None.most()),
                        None => format!("`{shown}` is no finite number"),
                    };
                    return Err(self.wrong_at(number, why));
                }
            }
        }
        if rows.is_empty() { Err(self.error("it has no rows of numbers")) } else { Ok(rows) }
    }
}

/// A row of up to sixteen numbers.
#[derive(Clone, Copy, Debug)]
pub(super) struct NumberRow {
    /// Its line, from 1.
    pub line: usize,
    /// How many numbers it has.
    pub count: usize,
    values: [f64; 16],
}

impl NumberRow {
    /// A number of it; zero past the end.
    pub fn number(&self, index: usize) -> f64 {
        self.values.get(index).copied().unwrap_or(0.0)
    }

    /// A whole number from 1; `None` for anything else.
    pub fn ordinal(&self, index: usize) -> Option<usize> {
        let value = self.number(index);
        ((1.0..=6000.0).contains(&value) && value.fract() == 0.0).then_some(value as usize)
    }
}

/// What stands between numbers.
pub(super) fn separates(c: char) -> bool {
    c.is_whitespace() || c == ',' || c == ';'
}

/// A number as Fortran, too, writes it.
fn parse_number(word: &str) -> Option<f64> {
    word.parse().or_else(|_| word.replace(['d', 'D'], "e").parse()).ok()
}

/// The same, where it is one that can be reckoned with.
pub(super) fn number(word: &str) -> Option<f64> {
    parse_number(word).filter(|value| value.abs() <= Dim::None.most())
}

/// The numbers of a line, up to sixteen; else which word is none.
fn row(line: usize, text: &str) -> Result<NumberRow, usize> {
    let mut row = NumberRow { line, count: 0, values: [0.0; 16] };
    let words = text.split(separates).filter(|w| !w.is_empty());
    for (index, (word, position)) in words.zip(row.values.iter_mut()).enumerate() {
        *position = number(word).ok_or(index)?;
        row.count = index + 1;
    }
    Ok(row)
}

/// Values in order, those that are the same but for the rounding of a file taken once.
pub(super) fn axis(values: impl Iterator<Item = f64>, same: fn(f64, f64) -> bool) -> Vec<f64> {
    let mut list: Vec<f64> = values.collect();
    list.sort_by(f64::total_cmp);
    list.dedup_by(|b, a| same(*a, *b));
    list
}

/// Whether two frequencies are one: files round them to six digits.
pub(super) fn same_frequency(a: f64, b: f64) -> bool {
    (b - a).abs() <= 2e-5 * a.abs().max(b.abs())
}

/// Whether two headings are one (rad).
pub(super) fn same_heading(a: f64, b: f64) -> bool {
    (b - a).abs() <= 1e-5
}

/// Where a value stands in an axis that has it.
pub(super) fn position(axis: &[f64], value: f64) -> usize {
    let next = axis.partition_point(|a| *a < value);
    let off = |i: usize| axis.get(i).map_or(f64::INFINITY, |a| (a - value).abs());
    match next.checked_sub(1) {
        Some(before) if off(before) <= off(next) => before,
        _ => next,
    }
}

/// A heading in degrees as one in [0, 2 pi).
pub(super) fn heading(degrees: f64) -> f64 {
    let turn = degrees.rem_euclid(360.0).to_radians();
    if turn > TAU - 1e-9 { 0.0 } else { turn }
}

/// A place of a grid that is empty, or filled twice with unlike values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Flaw<const K: usize> {
    /// No row.
    Missing([usize; K]),
    /// Two rows.
    Twice([usize; K]),
}

/// Values of all places of a grid, the last axis the fastest. No more memory is taken than for the rows there are.
///
/// # Errors
/// The first place that is empty or filled with unlike values.
pub(super) fn complete<const K: usize, V: Copy>(
    mut rows: Vec<([usize; K], V)>,
    sizes: [usize; K],
    same: impl Fn(&V, &V) -> bool,
) -> Result<Vec<V>, Flaw<K>> {
    rows.sort_by_key(|r| r.0);
    let mut values: Vec<V> = Vec::with_capacity(rows.len());
    let mut wanted = [0; K];
    let mut last: Option<([usize; K], V)> = None;
    for (at, value) in rows {
        if let Some((before, first)) = last
            && before == at
        {
            if same(&first, &value) {
                continue;
            }
            return Err(Flaw::Twice(at));
        }
        if at != wanted {
            return Err(Flaw::Missing(wanted));
        }
        values.push(value);
        last = Some((at, value));
        for (digit, size) in wanted.iter_mut().zip(sizes).rev() {
            *digit += 1;
            if *digit < size {
                break;
            }
            *digit = 0;
        }
    }
    if wanted == [0; K] && !values.is_empty() { Ok(values) } else { Err(Flaw::Missing(wanted)) }
}

/// An amplitude of one mode in one wave.
#[derive(Clone, Copy, Debug)]
pub(super) struct ModeRow {
    /// Direction of travel (rad).
    pub heading: f64,
    /// Frequency (rad/s).
    pub frequency: f64,
    /// 0 to 5.
    pub mode: usize,
    /// The amplitude.
    pub value: Complex<f64>,
}

/// Amplitudes by heading, then frequency.
#[derive(Clone, Debug, Default, PartialEq)]
pub(super) struct ByWave {
    pub headings: Vec<f64>,
    pub frequencies: Vec<f64>,
    pub values: Vec<Vec<Amplitudes>>,
}

/// Puts rows of modes on their grid. A mode without any row is zero; one with a row has one for each wave.
///
/// # Errors
/// A wave without a row of a mode that others have, or with two unlike ones.
pub(super) fn by_wave(file: &SourceFile, rows: &[ModeRow]) -> Result<ByWave, DatabaseError> {
    if rows.is_empty() {
        return Err(file.error("it has no row of this body"));
    }
    let headings = axis(rows.iter().map(|r| r.heading), same_heading);
    let frequencies = axis(rows.iter().map(|r| r.frequency), same_frequency);
    let modes = axis(rows.iter().map(|r| r.mode as f64), |a, b| a == b);
    let size = rows.iter().map(|r| r.value.norm()).fold(0.0, f64::max);
    let placed = rows.iter().map(|r| {
        (
            [position(&headings, r.heading), position(&frequencies, r.frequency), position(&modes, r.mode as f64)],
            r.value,
        )
    });
    let sizes = [headings.len(), frequencies.len(), modes.len()];
    let describe = |[h, f, m]: [usize; 3]| {
        let (heading, frequency, mode) = (headings[h].to_degrees(), frequencies[f], modes[m] + 1.0);
        format!("for mode {mode}, heading {heading:.2} degrees, {frequency:.5} rad/s (period {:.4} s)", TAU / frequency)
    };
    let dense = complete(placed.collect(), sizes, |a, b| (a - b).norm() <= 1e-4 * size).map_err(|flaw| match flaw {
        Flaw::Missing(at) => file.error(format!("it has no row {}", describe(at))),
        Flaw::Twice(at) => file.error(format!("it has two unlike rows {}", describe(at))),
    })?;
    let six = |chunk: &[Complex<f64>]| {
        let mut six: Amplitudes = Default::default();
        for (mode, value) in modes.iter().zip(chunk) {
            if let Some(position) = six.get_mut(*mode as usize) {
                *position = *value;
            }
        }
        six
    };
    let of_heading = frequencies.len() * modes.len();
    let values = dense.chunks(of_heading).map(|h| h.chunks(modes.len()).map(six).collect()).collect();
    Ok(ByWave { headings, frequencies, values })
}
