//! CSV files of rows of numbers.

use crate::commands::Job;
use crate::commands::settings::device::{existing, read_input};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_language::source::LARGEST_FILE;

/// A row of numbers, with its line in the file.
pub(crate) type NumberLine<const N: usize> = (u64, [f64; N]);

/// The numbers of a CSV file, N a row and at most so many rows; a first line without numbers is one of heads.
///
/// # Errors
/// A file that cannot be read, a row that is none, too many rows.
pub(crate) fn rows<const N: usize>(
    job: &Job,
    (name, span): (&str, Span),
    what: &str,
    most: usize,
) -> Outcome<Vec<NumberLine<N>>> {
    let path = existing(job, name, span)?;
    let refused =
        |why: String| Diagnostic::error(format!("{name} cannot be used: {why}"), span).help(format!("a row is {what}"));
    let bytes = read_input(job, &path, LARGEST_FILE).map_err(|e| refused(e.to_string()))?;
    let mut reader = csv::ReaderBuilder::new()
        .has_headers(false)
        .flexible(true)
        .comment(Some(b'#'))
        .trim(csv::Trim::All)
        .from_reader(bytes.as_slice());
    let mut found = Vec::new();
    for (index, record) in reader.records().enumerate() {
        let record = record.map_err(|e| refused(e.to_string()))?;
        let line = record.position().map_or(0, csv::Position::line);
        let number = |text: &str| text.parse::<f64>();
        if index == 0 && record.iter().all(|text| number(text).is_err()) {
            continue;
        }
        if record.len() != N {
            return Err(refused(format!("line {line} has {} values, not {N}", record.len())));
        }
        let mut row = [0.0; N];
        for (column, (slot, text)) in row.iter_mut().zip(&record).enumerate() {
            *slot = number(text).ok().filter(|v| v.abs() <= Dim::Length.most()).ok_or_else(|| {
                refused(format!("line {line}: value {} is `{text}`, which is not a number up to 1E9", column + 1))
            })?;
        }
        if found.len() >= most {
            return Err(refused(format!("it has more than {most} rows")));
        }
        found.push((line, row));
    }
    if found.is_empty() { Err(refused("it has no rows of numbers".into())) } else { Ok(found) }
}
