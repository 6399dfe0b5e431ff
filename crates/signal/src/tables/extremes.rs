//! Extremes of series as a table: Rayleigh, Weibull and Gumbel beside each other.

use super::{SIX_DIGITS, SeriesRecord, TableSeries};
use crate::extremes::{ExpectedExtreme, FEWEST_BLOCKS, Gumbel, Weibull, block_maxima, rayleigh};
use crate::{SeriesError, statistics};
use windlass_base::table::{Cell, Column, Digits, Table};
use windlass_base::units::Dim;

/// What extremes are sought for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extremes {
    /// Duration (s) the largest value is sought in.
    pub duration: f64,
    /// Blocks the record is cut into for Gumbel; `None`: twenty, or fewer so that each holds ten up-crossings of the mean.
    pub blocks: Option<usize>,
    /// Seek the smallest value instead.
    pub lows: bool,
}

/// Blocks where nothing is said, and up-crossings that a block holds at least then.
const DEFAULT_BLOCKS: usize = 20;
const MIN_CROSSINGS_PER_BLOCK: usize = 10;

struct FoundExtremes {
    extreme: ExpectedExtreme,
    count: Option<usize>,
    shape: Option<f64>,
    scale: f64,
}

/// One row a method, one group of columns a series. A method that refuses has an empty row and a note that says why.
///
/// # Errors
/// A series that does not vary or crosses its mean fewer than twice; no method that answers for any of them.
pub fn extremes(record: &SeriesRecord, asked: Extremes) -> Result<Table, SeriesError> {
    let methods = ["Rayleigh", "Weibull", "Gumbel"];
    let mut columns = vec![Column::new("", "Method", Dim::None, Digits::Usual, methods)];
    let (mut notes, mut answered) = (Vec::new(), false);
    for series in &record.series {
        let found = of_series(record, series, asked)?;
        for (method, result) in methods.iter().zip(&found) {
            match result {
                Ok(_) => answered = true,
                Err(error) => notes.push(format!("{method} of {}: {error}", series.name)),
            }
        }
        let of = |take: &dyn Fn(&FoundExtremes) -> Cell| -> Vec<Cell> {
            found.iter().map(|f| f.as_ref().map_or(Cell::Missing, take)).collect()
        };
        let sign = if asked.lows { -1.0 } else { 1.0 };
        let bound = |f: &FoundExtremes, upper: bool| {
            // turned over, the bounds change places
            let take = |(low, high): (f64, f64)| if upper != asked.lows { high } else { low };
            f.extreme.interval.map(|i| sign * take(i)).into()
        };
        let mut add = |name: &str, dim: Dim, digits: Digits, cells: Vec<Cell>| {
            columns.push(Column::new(&series.name, name, dim, digits, cells));
        };
        add("Most Probable", series.dim, SIX_DIGITS, of(&|f| Cell::Number(sign * f.extreme.most_probable)));
        add("Expected", series.dim, SIX_DIGITS, of(&|f| Cell::Number(sign * f.extreme.expected)));
        add("95% Low", series.dim, SIX_DIGITS, of(&|f| bound(f, false)));
        add("95% High", series.dim, SIX_DIGITS, of(&|f| bound(f, true)));
        add("Scale", series.dim, SIX_DIGITS, of(&|f| Cell::Number(f.scale)));
        add("Shape", Dim::None, Digits::Decimals(4), of(&|f| f.shape.into()));
        add("Fitted To", Dim::None, Digits::Usual, of(&|f| f.count.into()));
    }
    if !answered {
        return Err(SeriesError::Refused(notes.join("; ")));
    }
    let what = if asked.lows { "Smallest Values" } else { "Largest Values" };
    let mut table = Table::from_columns(format!("{what} of {}", record.title), columns)
        .fact("Duration", asked.duration, Dim::Time)
        .fact("Record", record.length(), Dim::Time);
    table.note("Rayleigh: a Gaussian narrow-banded process of this deviation and up-crossing period");
    table.note("Weibull: greatest likelihood on the maxima between crossings of the mean; Gumbel: the same on maxima of blocks");
    table.note("intervals of the most probable value are asymptotic (Fisher information, delta method), maxima being independent");
    table.add_notes(notes);
    Ok(table)
}

fn of_series(
    record: &SeriesRecord,
    series: &TableSeries,
    asked: Extremes,
) -> Result<[Result<FoundExtremes, SeriesError>; 3], SeriesError> {
    let values: Vec<f64> = if asked.lows { series.values.iter().map(|v| -v).collect() } else { series.values.clone() };
    let moments = statistics::moments(&values)?;
    let crossings = statistics::crossings(&record.times, &values, moments.mean)?;
    let Some(period) = crossings.period() else {
        return Err(SeriesError::Refused(format!("{} crosses its mean upward fewer than twice", series.name)));
    };
    let by_rayleigh = rayleigh(moments.mean, moments.deviation, period, asked.duration).map(|extreme| FoundExtremes {
        extreme,
        count: None,
        shape: None,
        scale: moments.deviation,
    });
    // a maximum may lie on the mean itself, where a Weibull variable has no density
    let maxima: Vec<f64> = crossings.maxima.iter().map(|p| p.value).filter(|v| *v > moments.mean).collect();
    let by_weibull = Weibull::fit(&maxima, moments.mean).and_then(|w| {
        let extreme = w.extreme(period, asked.duration)?;
        Ok(FoundExtremes { extreme, count: Some(w.count), shape: Some(w.shape), scale: w.scale })
    });
    let blocks = asked.blocks.unwrap_or_else(|| (crossings.up / MIN_CROSSINGS_PER_BLOCK).min(DEFAULT_BLOCKS));
    let by_gumbel = if blocks < FEWEST_BLOCKS {
        let what = "a Gumbel fit (of blocks, each with ten up-crossings of the mean unless their number is given)";
        Err(SeriesError::TooFew { what, need: FEWEST_BLOCKS, got: blocks })
    } else {
        block_maxima(&values, blocks).and_then(|m| Gumbel::fit(&m)).and_then(|g| {
            let extreme = g.extreme(record.length() / blocks as f64, asked.duration)?;
            Ok(FoundExtremes { extreme, count: Some(g.count), shape: None, scale: g.scale })
        })
    };
    Ok([by_rayleigh, by_weibull, by_gumbel])
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    fn record(length: f64) -> SeriesRecord {
        let times: Vec<f64> = (0..(length * 2.0) as usize).map(|i| 0.5 * i as f64).collect();
        let beat = |t: &f64| (TAU * t / 9.7).sin() + 0.8 * (TAU * t / 8.3).sin() + 0.5 * (TAU * t / 12.9).cos();
        let values = times.iter().map(beat).collect();
        SeriesRecord {
            title: "t".into(),
            series: vec![TableSeries { name: "S".into(), dim: Dim::Length, values }],
            times,
        }
    }

    #[test]
    fn minima_are_maxima_of_negated_series() {
        let r = record(3600.0);
        let asked = Extremes { duration: 10800.0, blocks: None, lows: false };
        let high = extremes(&r, asked).unwrap();
        let mut turned = r.clone();
        turned.series[0].values.iter_mut().for_each(|v| *v = -*v);
        let low = extremes(&turned, Extremes { lows: true, ..asked }).unwrap();
        for (a, b) in [(1, 1), (2, 2), (3, 4), (4, 3)] {
            let (a, b) = (high.columns()[a].numbers(), low.columns()[b].numbers());
            assert_eq!(a, b.iter().map(|v| -v).collect::<Vec<_>>());
        }
        assert_eq!(high.columns()[1].numbers().len(), 3);
    }

    #[test]
    fn short_record_states_its_minimum_length() {
        let t = extremes(&record(200.0), Extremes { duration: 10800.0, blocks: None, lows: false }).unwrap();
        assert_eq!(t.columns()[1].numbers().len(), 1);
        assert!(
            t.notes.iter().any(|n| n.text.starts_with("Weibull of S") && n.text.contains("at least 30")),
            "{:?}",
            t.notes
        );
        assert!(extremes(&record(4.0), Extremes { duration: 10800.0, blocks: None, lows: false }).is_err());
        assert!(extremes(&record(200.0), Extremes { duration: 1.0, blocks: None, lows: false }).is_err());
    }
}
