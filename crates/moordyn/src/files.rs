//! Files beside a deck: seafloor, current profile, waves, tables of stiffness [MOORDYN-2].
//!
//! [`Deck::files`](crate::Deck::files) names what a deck needs; who reads the deck opens them.

use crate::row::{Row, Word, count, number, words};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::{SourceId, Span};

/// Lines of a current profile or of a table of stiffness before its rows.
const HEAD_LINES: usize = 3;

/// Most points of a seafloor.
const MAX_SEAFLOOR_POINTS: usize = 4_000_000;

/// A file that a deck needs.
#[derive(Clone, Debug, PartialEq)]
pub struct NeededFile {
    /// Its name, from the folder of the deck.
    pub name: String,
    /// The word of the deck that asks for it.
    pub span: Span,
}

/// The text of a file, and its id in the places of messages.
#[derive(Clone, Debug)]
pub struct FileText<T> {
    /// The text.
    pub text: T,
    /// The id.
    pub source: SourceId,
}

/// A bottom over a grid.
#[derive(Clone, Debug, PartialEq)]
pub struct Seafloor {
    /// Places of columns and rows (m), growing.
    pub x: Vec<f64>,
    /// Rows.
    pub y: Vec<f64>,
    /// Heights (m), row by row of one y.
    pub heights: Vec<f64>,
}

/// A current by depth.
#[derive(Clone, Debug, PartialEq)]
pub struct CurrentProfile {
    /// Depth below the mean level (m), growing, and velocity in x and y (m/s).
    pub rows: Vec<(f64, [f64; 2])>,
}

/// A wave: `zeta = a cos(k x - w t + phase)`, x along its travel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Wave {
    /// Frequency (rad/s).
    pub frequency: f64,
    /// Amplitude (m).
    pub amplitude: f64,
    /// Phase (rad).
    pub phase: f64,
    /// Direction it travels toward (rad).
    pub toward: f64,
}

/// The rows of a text that have words, behind lines of heads.
///
/// # Errors
/// A row of numbers among the heads.
fn rows<'a>(text: &'a str, source: SourceId, skip: usize) -> Outcome<Vec<Row<'a>>> {
    let mut list = Vec::new();
    let mut offset = 0;
    for (index, line) in text.split_inclusive('\n').enumerate() {
        let row = words(line, offset, source, true);
        offset += line.len();
        let is_of_numbers = || row.words.len() > 1 && row.words.iter().all(|word| word.value.parse::<f64>().is_ok());
        if index < skip && is_of_numbers() {
            let text = format!("a row of numbers stands among the {skip} lines of heads");
            let error = Diagnostic::error(text, row.span).label("would not be read");
            return Err(error.help("the file begins with lines of a title, names and units"));
        }
        if index >= skip && !row.words.is_empty() {
            list.push(row);
        }
    }
    Ok(list)
}

fn empty(what: &str, source: SourceId) -> Box<Diagnostic> {
    Diagnostic::error(format!("{what} has no rows of numbers"), Span::new(source, 0, 0))
}

/// The word of a row at an index.
fn cell<'r, 'a>(row: &'r Row<'a>, index: usize, what: &str) -> Outcome<&'r Word<'a>> {
    row.words.get(index).ok_or_else(|| {
        Diagnostic::error(format!("the row has no value for {what}"), row.span).label(format!("expected {what}"))
    })
}

fn value(row: &Row<'_>, index: usize, what: &str) -> Outcome<f64> {
    cell(row, index, what).and_then(|word| number(word, what)).map(|given| given.value)
}

fn at_most(row: &Row<'_>, most: usize, what: &str) -> Outcome<()> {
    match row.words.get(most) {
        Some(extra) => Err(Diagnostic::error("the row has more values than are known here", extra.span)
            .label(format!("behind {what}"))),
        None => Ok(()),
    }
}

/// Reads a seafloor: the numbers of x and of y, the x, the y, then rows of x, y and z.
///
/// # Errors
/// A word that is not a number, places that do not grow, a point that is not of the grid, twice there or missing.
pub fn seafloor(text: &str, source: SourceId) -> Outcome<Seafloor> {
    let list = rows(text, source, 0)?;
    let [sizes, columns, lines, points @ ..] = list.as_slice() else { return Err(empty("the seafloor file", source)) };
    let mut places: [Vec<f64>; 2] = Default::default();
    for (axis, (row, what)) in [(columns, "x"), (lines, "y")].into_iter().enumerate() {
        let wanted = count(cell(sizes, axis, &format!("the number of {what}"))?, &format!("the number of {what}"), 2)?;
        let mut found: Vec<f64> = Vec::new();
        for word in &row.words {
            let given = number(word, what)?;
            if found.last().is_some_and(|last| *last >= given.value) {
                return Err(Diagnostic::error(format!("{what} must grow"), word.span));
            }
            found.push(given.value);
        }
        if found.len() != wanted.value {
            let text = format!("the row has {} values of {what}", found.len());
            return Err(Diagnostic::error(text, row.span).label(format!("expected {}", wanted.value)));
        }
        if let Some(slot) = places.get_mut(axis) {
            *slot = found;
        }
    }
    at_most(sizes, 2, "the numbers of x and y")?;
    let [x, y] = places;
    let size = x.len().saturating_mul(y.len());
    if size > MAX_SEAFLOOR_POINTS {
        return Err(Diagnostic::error(format!("a seafloor of more than {MAX_SEAFLOOR_POINTS} points"), sizes.span));
    }
    let mut heights: Vec<Option<f64>> = vec![None; size];
    for row in points {
        at_most(row, 3, "x, y and z")?;
        let [px, py, z] = [value(row, 0, "x")?, value(row, 1, "y")?, value(row, 2, "z")?];
        let place = |list: &[f64], at: f64| list.iter().position(|known| *known == at);
        let (Some(column), Some(line)) = (place(&x, px), place(&y, py)) else {
            let error = Diagnostic::error("the point is not of the grid", row.span);
            return Err(error.label("its x and y must be among those of the second and third row"));
        };
        match heights.get_mut(line * x.len() + column) {
            Some(slot @ None) => *slot = Some(z),
            _ => return Err(Diagnostic::error("the point is there twice", row.span)),
        }
    }
    let missing = heights.iter().position(Option::is_none);
    if let Some(missing) = missing {
        let at = (x.get(missing % x.len()), y.get(missing / x.len()));
        if let (Some(x), Some(y)) = at {
            let text = format!("the grid has no z at x {x}, y {y}");
            return Err(Diagnostic::error(text, sizes.span).label("expected a row for each x at each y"));
        }
    }
    Ok(Seafloor { x, y, heights: heights.into_iter().flatten().collect() })
}

/// Reads a current profile: three lines of heads, then rows of z and the velocity in x, y and z.
///
/// # Errors
/// A word that is not a number, heights that neither grow nor fall, a velocity upward.
pub fn current_profile(text: &str, source: SourceId) -> Outcome<CurrentProfile> {
    let list = rows(text, source, HEAD_LINES)?;
    let mut found: Vec<(f64, [f64; 2], Span)> = Vec::new();
    for row in &list {
        at_most(row, 4, "z, ux, uy and uz")?;
        let z = value(row, 0, "z")?;
        let x = value(row, 1, "ux")?;
        let y = if row.words.len() > 2 { value(row, 2, "uy")? } else { 0.0 };
        if let Some(word) = row.words.get(3)
            && number(word, "uz")?.value != 0.0
        {
            return Err(Diagnostic::error("a current upward is not computed", word.span).label("expected 0"));
        }
        found.push((-z, [x, y], row.span));
    }
    if found.is_empty() {
        return Err(empty("the current profile", source));
    }
    if found.len() > 1 && found.first().map(|row| row.0) > found.last().map(|row| row.0) {
        found.reverse();
    }
    let fault = found.windows(2).find(|pair| matches!(pair, [(a, ..), (b, ..)] if a >= b));
    if let Some([_, (.., span)]) = fault {
        return Err(Diagnostic::error("z neither grows nor falls from row to row", *span));
    }
    Ok(CurrentProfile { rows: found.into_iter().map(|(depth, velocity, _)| (depth, velocity)).collect() })
}

/// Reads wave components: rows of frequency (rad/s), real and imaginary part of the amplitude (m), and the direction of travel (rad). The wave of
/// a row is `|a| sin(w t - k x + arg a)`.
///
/// # Errors
/// A word that is not a number, a frequency below zero, a height at the frequency zero.
pub fn wave_components(text: &str, source: SourceId) -> Outcome<Vec<Wave>> {
    let list = rows(text, source, 0)?;
    let mut waves = Vec::new();
    for row in &list {
        at_most(row, 4, "frequency, real and imaginary part and direction")?;
        let frequency = value(row, 0, "the frequency")?;
        let (real, imaginary) = (value(row, 1, "the real part")?, value(row, 2, "the imaginary part")?);
        let toward = if row.words.len() > 3 { value(row, 3, "the direction")? } else { 0.0 };
        let amplitude = real.hypot(imaginary);
        if frequency < 0.0 {
            return Err(Diagnostic::error("a frequency below zero", cell(row, 0, "the frequency")?.span));
        }
        if amplitude == 0.0 {
            continue;
        }
        if frequency == 0.0 {
            return Err(Diagnostic::error("a wave of the frequency zero has a height", row.span).label("expected 0 0"));
        }
        let phase = std::f64::consts::FRAC_PI_2 - imaginary.atan2(real);
        waves.push(Wave { frequency, amplitude, phase, toward });
    }
    if list.is_empty() { Err(empty("the file of wave components", source)) } else { Ok(waves) }
}

/// Reads an elevation over time: rows of time (s) and elevation (m) at x = y = 0.
///
/// # Errors
/// A word that is not a number, times that do not grow, fewer than three rows.
pub fn wave_elevation(text: &str, source: SourceId) -> Outcome<Vec<(f64, f64)>> {
    let list = rows(text, source, 0)?;
    let mut found: Vec<(f64, f64)> = Vec::new();
    for row in &list {
        at_most(row, 2, "time and elevation")?;
        let (time, elevation) = (value(row, 0, "the time")?, value(row, 1, "the elevation")?);
        if found.last().is_some_and(|(last, _)| *last >= time) {
            return Err(Diagnostic::error("times must grow from row to row", row.span));
        }
        found.push((time, elevation));
    }
    if found.len() < 3 { Err(empty("the wave elevation of less than three rows", source)) } else { Ok(found) }
}

/// Reads a table of stiffness: three lines of heads, then rows of strain and tension (N).
///
/// # Errors
/// A word that is not a number, strains or tensions that do not grow, fewer than two rows.
pub fn stiffness_table(text: &str, source: SourceId) -> Outcome<Vec<(f64, f64)>> {
    let list = rows(text, source, HEAD_LINES)?;
    let mut found: Vec<(f64, f64)> = Vec::new();
    for row in list.iter().filter(|row| row.words.first().is_some_and(|word| !word.value.starts_with("---"))) {
        at_most(row, 2, "strain and tension")?;
        let (strain, tension) = (value(row, 0, "the strain")?, value(row, 1, "the tension")?);
        if found.last().is_some_and(|(e, t)| *e >= strain || *t >= tension) {
            return Err(Diagnostic::error("strain and tension must grow from row to row", row.span));
        }
        found.push((strain, tension));
    }
    if found.len() < 2 { Err(empty("the table of stiffness of less than two rows", source)) } else { Ok(found) }
}
