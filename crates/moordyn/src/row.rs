//! Rows: words between blanks, each with its place.

use crate::Given;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::{SourceId, Span};

/// A word and its place.
pub(crate) type Word<'a> = Given<&'a str>;

/// The words of a line before a comment, and the place of the line.
#[derive(Clone, Debug, Default)]
pub(crate) struct Row<'a> {
    pub(crate) words: Vec<Word<'a>>,
    pub(crate) span: Span,
    /// Whether the line begins with a blank.
    pub(crate) is_indented: bool,
}

/// The words of a line that begins at a byte of the source; a word with `#` begins a comment, but in files of MAP++, where it marks a guess.
pub(crate) fn words(line: &str, offset: usize, source: SourceId, has_comments: bool) -> Row<'_> {
    let mut list = Vec::new();
    let mut at = 0;
    for piece in line.split_inclusive(|c: char| c.is_whitespace() || c == '\0') {
        let word = piece.trim_end_matches(|c: char| c.is_whitespace() || c == '\0');
        let start = offset + at;
        at += piece.len();
        if has_comments && word.contains('#') {
            break;
        }
        if !word.is_empty() {
            list.push(Given { value: word, span: Span::new(source, start, start + word.len()) });
        }
    }
    let first = line.len() - line.trim_start().len();
    let last = line.trim_end().len();
    let is_indented = first > 0 && first < line.len();
    Row { words: list, span: Span::new(source, offset + first.min(last), offset + last), is_indented }
}

/// A finite number, whole to the last character: MoorDyn reads `6l2` as 6.
pub(crate) fn number(word: &Word<'_>, what: &str) -> Outcome<Given<f64>> {
    // Rust's parser takes words such as inf and nan, which no deck means
    let is_numeric = word.value.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
    match word.value.parse::<f64>() {
        Ok(value) if is_numeric && value.is_finite() => Ok(Given { value, span: word.span }),
        _ => {
            Err(Diagnostic::error(format!("{what} is not a number: {}", word.value), word.span)
                .label("expected a number"))
        }
    }
}

/// A number that is not negative, or, where `is_positive` says so, greater than zero.
pub(crate) fn size(word: &Word<'_>, what: &str, is_positive: bool) -> Outcome<Given<f64>> {
    let given = number(word, what)?;
    if given.value < 0.0 || (is_positive && given.value == 0.0) {
        let allowed = if is_positive { "greater than 0" } else { "0 or more" };
        return Err(
            Diagnostic::error(format!("{what} is {}", word.value), word.span).label(format!("must be {allowed}"))
        );
    }
    Ok(given)
}

/// A whole number from 1.
pub(crate) fn count(word: &Word<'_>, what: &str, least: usize) -> Outcome<Given<usize>> {
    match word.value.parse::<usize>() {
        Ok(value) if value >= least => Ok(Given { value, span: word.span }),
        _ => Err(Diagnostic::error(format!("{what} is {}", word.value), word.span)
            .label(format!("expected a whole number from {least}"))),
    }
}

/// One to six numbers between `|`, as in `1|2|3`.
pub(crate) fn numbers(word: &Word<'_>, what: &str, counts: &[usize]) -> Outcome<Given<Vec<f64>>> {
    let parts: Result<Vec<f64>, _> =
        word.value.split('|').map(|value| number(&Given { value, span: word.span }, what).map(|n| n.value)).collect();
    let value = parts?;
    if !counts.contains(&value.len()) {
        let allowed = counts.iter().map(ToString::to_string).collect::<Vec<_>>().join(" or ");
        return Err(Diagnostic::error(format!("{what} has {} values", value.len()), word.span)
            .label(format!("expected {allowed} between |")));
    }
    Ok(Given { value, span: word.span })
}
