//! Spectra of series as tables.

use super::{SIX_DIGITS, SeriesRecord, TableSeries, numbers};
use crate::spectra::{self, Density, SpectralMoments, Window};
use crate::{SeriesError, sampling};
use std::f64::consts::TAU;
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// What the density of a quantity measures: its square times seconds. `None` where no unit of that is kept.
fn density_dimension(dim: Dim) -> Option<Dim> {
    let derived = |force, length, seconds| Some(Dim::Derived { force, length, seconds });
    match dim {
        Dim::None => derived(0, 0, 1),
        Dim::Length => Some(Dim::SpectralDensity),
        Dim::Velocity => derived(0, 2, -1),
        Dim::Acceleration => derived(0, 2, -3),
        Dim::Force => derived(2, 0, 1),
        Dim::ForcePerLength => derived(2, -2, 1),
        Dim::Moment => derived(2, 2, 1),
        Dim::Angle => Some(Dim::AngleDensity),
        _ => None,
    }
}

/// Segments an eighth of a series long, the first power of two not above that, leave some fifteen of them to be averaged.
fn usual_length(samples: usize) -> usize {
    let eighth = (samples / 8).max(8);
    if eighth.is_power_of_two() { eighth } else { eighth.next_power_of_two() / 2 }
}

/// The series of a record with their densities, and whether any was interpolated to uniform times.
type Densities<'a> = (Vec<(&'a TableSeries, Density)>, bool);

fn densities(record: &SeriesRecord, length: Option<usize>) -> Result<Densities<'_>, SeriesError> {
    let mut resampled = false;
    let mut out = Vec::new();
    for series in &record.series {
        let grid = sampling::uniform(&record.times, &series.values)?;
        resampled |= grid.resampled;
        let length = length.unwrap_or_else(|| usual_length(grid.values.len()));
        out.push((series, spectra::welch(&grid.values, grid.step, length, Window::Hann)?));
    }
    Ok((out, resampled))
}

const RESAMPLED: &str = "the times are not uniform: the series were interpolated linearly at their mean step";

fn periods(frequencies: &[f64]) -> Vec<Cell> {
    numbers(frequencies.iter().map(|w| TAU / w))
}

/// Spectral densities by Welch's method (Hann window, half overlap), one-sided over rad/s, by frequency; frequency 0 is left
/// out. `length` is the number of samples of a segment; without it, an eighth of the series, as a power of two.
///
/// # Errors
/// As [`spectra::welch`].
pub fn density(record: &SeriesRecord, length: Option<usize>) -> Result<Table, SeriesError> {
    let (found, resampled) = densities(record, length)?;
    let Some((_, first)) = found.first() else { return Err(SeriesError::Constant) };
    let frequencies = first.frequencies.get(1..).unwrap_or_default();
    let mut columns = vec![
        Column::new("", "Frequency", Dim::Frequency, SIX_DIGITS, numbers(frequencies.iter().copied())),
        Column::new("", "Period", Dim::Time, SIX_DIGITS, periods(frequencies)),
    ];
    let mut notes = Vec::new();
    for (series, density) in &found {
        let dim = density_dimension(series.dim);
        if dim.is_none() {
            notes.push(format!("the density of {} is in SI units", series.name));
        }
        let values = density.values.iter().skip(1).copied();
        columns.push(Column::new(&series.name, "Density", dim.unwrap_or(Dim::None), SIX_DIGITS, numbers(values)));
    }
    let mut table = Table::from_columns(format!("Spectrum of {}", record.title), columns);
    table = table.fact("Segments Averaged", first.segments, Dim::None);
    table.note(
        "Welch's method, Hann window, half overlap; the sum of densities times the step of frequency is the variance",
    );
    if resampled {
        table.note(RESAMPLED);
    }
    table.add_notes(notes);
    Ok(table)
}

/// Moments, periods and widths of each series by its density, with the name of the series.
///
/// # Errors
/// As [`density`]; a series that does not vary.
pub fn moments(record: &SeriesRecord, length: Option<usize>) -> Result<Vec<(String, SpectralMoments)>, SeriesError> {
    let (found, _) = densities(record, length)?;
    found.iter().map(|(series, d)| Ok((series.name.clone(), spectra::moments(d)?))).collect()
}

/// Amplitudes and phases of the harmonics of the whole record; the first row is the mean, with its sign.
///
/// # Errors
/// As [`spectra::amplitudes`].
pub fn amplitudes(record: &SeriesRecord) -> Result<Table, SeriesError> {
    let mut columns = Vec::new();
    let mut resampled = false;
    for series in &record.series {
        let grid = sampling::uniform(&record.times, &series.values)?;
        resampled |= grid.resampled;
        let found = spectra::amplitudes(&grid.values, grid.step)?;
        if columns.is_empty() {
            let mut period = periods(&found.frequencies);
            if let Some(first) = period.first_mut() {
                *first = Cell::Missing;
            }
            columns.push(Column::new("", "Frequency", Dim::Frequency, SIX_DIGITS, numbers(found.frequencies)));
            columns.push(Column::new("", "Period", Dim::Time, SIX_DIGITS, period));
        }
        columns.push(Column::new(&series.name, "Amplitude", series.dim, SIX_DIGITS, numbers(found.amplitudes)));
        columns.push(Column::new(&series.name, "Phase", Dim::Angle, Digits::Usual, numbers(found.phases)));
    }
    let mut table = Table::from_columns(format!("Amplitudes of {}", record.title), columns);
    table.note("sum of amplitude cos(frequency (t - first time) + phase); no window; the first row is the mean");
    if resampled {
        table.note(RESAMPLED);
    }
    Ok(table)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn record(step: f64, dim: Dim) -> SeriesRecord {
        let times: Vec<f64> = (0..4096).map(|i| step * f64::from(i)).collect();
        let values = times.iter().map(|t| 2.0 * (TAU * t / (64.0 * step)).sin()).collect();
        SeriesRecord { title: "t".into(), series: vec![TableSeries { name: "S".into(), dim, values }], times }
    }

    #[test]
    fn density_table_sums_to_variance_in_its_unit() {
        let r = record(0.5, Dim::Force);
        let t = density(&r, None).unwrap();
        let w = t.columns()[0].numbers();
        let sum: f64 = t.columns()[2].numbers().iter().sum::<f64>() * (w[1] - w[0]);
        assert!((sum - 2.0).abs() < 1e-9, "{sum}");
        assert_eq!(t.columns()[2].dim, Dim::Derived { force: 2, length: 0, seconds: 1 });
        let m = moments(&r, None).unwrap();
        assert!((m[0].1.peak_period - 32.0).abs() < 1e-9 && w.len() == 256);
    }

    #[test]
    fn nonuniform_times_are_interpolated_with_a_note() {
        let mut r = record(0.5, Dim::Stress);
        r.times[7] += 0.2;
        let t = density(&r, Some(1024)).unwrap();
        assert!(
            t.notes.iter().any(|n| n.text == RESAMPLED) && t.notes.iter().any(|n| n.text.contains("SI units")),
            "{:?}",
            t.notes
        );
        let t = amplitudes(&record(0.5, Dim::Angle)).unwrap();
        assert_eq!((t.columns().len(), t.rows(), t.columns()[1].cells[0].clone()), (4, 2049, Cell::Missing));
        assert!((t.columns()[2].numbers()[64] - 2.0).abs() < 1e-12);
        assert!(density(&r, Some(5000)).is_err());
    }
}
