//! Tables of motion RAOs as text: OrcaFlex's columns, or heading, period and six amplitudes each with its phase.
//!
//! Source: help of OrcaFlex, "RAO data" and "Import": a row is one wave; columns are named WD (direction, degrees), WP (period, s), WFR (rad/s) or
//! WFH (Hz), then XA XP YA YP ZA ZP RXA RXP RYA RYP RZA RZP, amplitude and phase (degrees). Without names the columns are WD WP and the twelve in this order.
//! OrcaFlex's usual conventions: rotations in degrees a metre of wave amplitude, phases lag behind the crest at the origin of the RAOs.

use super::checks::check_database;
use super::rows::{DatabaseError, ModeRow, NumberRow, SourceFile, by_wave, heading, separates};
use nalgebra::Complex;
use std::f64::consts::TAU;
use windlass_model::Database;

/// What a table of RAOs does not say itself.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RaoConvention {
    /// Whether phases lag behind the crest (else they lead it).
    pub lag: bool,
    /// Whether rotations are in degrees (else rad) a metre.
    pub degrees: bool,
    /// Density of the water (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
    /// Depth (m); `None` for deep water.
    pub depth: Option<f64>,
}

/// Names of the columns, in the order where none are given; then those of frequency in place of period.
const COLUMNS: [&str; 16] =
    ["WD", "WP", "XA", "XP", "YA", "YP", "ZA", "ZP", "RXA", "RXP", "RYA", "RYP", "RZA", "RZP", "WFR", "WFH"];
const RADIANS: usize = 14;
const HERTZ: usize = 15;

/// Reads a table.
///
/// # Errors
/// A file that does not have the form; a wave that is missing or given twice.
pub fn read(source: &str, file: &SourceFile, convention: &RaoConvention) -> Result<Database, DatabaseError> {
    let columns = find_columns(file)?;
    let position = |column: usize| columns.iter().position(|c| *c == column);
    let (Some(direction), Some(wave)) =
        (position(0), position(1).or_else(|| position(RADIANS)).or_else(|| position(HERTZ)))
    else {
        return Err(file.error("its columns have no direction WD, or no period WP and no frequency WFR or WFH"));
    };
    let kind = columns.get(wave).copied().unwrap_or_default();
    let mut rows = Vec::new();
    for row in file.rows(columns.len())? {
        let frequency = frequency(file, &row, wave, kind)?;
        for mode in 0..6 {
            let (Some(amplitude), Some(phase)) = (position(2 + 2 * mode), position(3 + 2 * mode)) else { continue };
            let size = row.number(amplitude);
            let size = if mode >= 3 && convention.degrees { size.to_radians() } else { size };
            let phase = row.number(phase).to_radians();
            let value = Complex::from_polar(size, if convention.lag { phase } else { -phase });
            rows.push(ModeRow { heading: heading(row.number(direction)), frequency, mode, value });
        }
    }
    let table = by_wave(file, &rows)?;
    check_database(Database {
        source: source.to_string(),
        frequencies: table.frequencies,
        headings: table.headings,
        motions: Some(table.values),
        density: convention.density,
        gravity: convention.gravity,
        depth: convention.depth,
        ..Database::default()
    })
}

/// What each column is: by the line of names, or the usual order.
fn find_columns(file: &SourceFile) -> Result<Vec<usize>, DatabaseError> {
    for (index, line) in file.text.lines().enumerate() {
        let words: Vec<String> =
            line.split(separates).filter(|w| !w.is_empty()).take(COLUMNS.len() + 1).map(str::to_uppercase).collect();
        let found: Vec<Option<usize>> = words.iter().map(|w| COLUMNS.iter().position(|c| c == w)).collect();
        if found.len() < 3 || found.iter().filter(|f| f.is_some()).count() < 3 {
            continue;
        }
        let mut columns = Vec::new();
        for (word, column) in words.iter().zip(found) {
            let Some(column) = column else {
                let shown: String = word.chars().take(24).filter(|c| !c.is_control()).collect();
                return Err(file.wrong_at(index + 1, format!("`{shown}` is no column of RAOs: {}", COLUMNS.join(" "))));
            };
            if columns.contains(&column) {
                return Err(file.wrong_at(index + 1, format!("the column {word} stands twice")));
            }
            columns.push(column);
        }
        return Ok(columns);
    }
    Ok((0..14).collect())
}

/// The frequency of a row (rad/s).
fn frequency(file: &SourceFile, row: &NumberRow, column: usize, kind: usize) -> Result<f64, DatabaseError> {
    let value = row.number(column);
    let frequency = match kind {
        RADIANS => value,
        HERTZ => TAU * value,
        _ => TAU / value,
    };
    if frequency > 0.0 && frequency < 1e6 {
        Ok(frequency)
    } else {
        Err(file.wrong_at(row.line, format!("{value} is no period or frequency of a wave")))
    }
}
