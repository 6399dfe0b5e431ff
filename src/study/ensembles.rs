//! Extremes over seeds: a row for each result of each ensemble of a study.

use super::tables::{RowSource, cell_of, input_column, input_heads, number_column, text_column};
use crate::report::stored::StoredColumn;
use rayon::prelude::*;
use std::ops::Range;
use windlass_signal::ensemble::{GumbelFit, SeedExtremes, seeds_for_scatter, seeds_for_scatter_of_minima};
use windlass_study::ensemble::{Ensemble, EnsembleResult, ensembles, is_seed_column};
use windlass_study::record::CaseStatus;
use windlass_study::records::RecordView;
use windlass_study::store::Study;

/// Confidence level of the intervals.
const LEVEL: f64 = 0.95;
/// Ensembles whose rows are made at once.
const ENSEMBLES_AT_ONCE: usize = 1 << 12;
/// Fractiles of the maximum of one seed: the mode, F = 1/e, and those that are asked for in practice.
const FRACTILES: [(&str, f64); 4] = [("mpm", 0.367_879_441_171_442_3), ("p50", 0.5), ("p90", 0.9), ("p95", 0.95)];

/// Numbers of a row that need no fit.
const COUNTS: [&str; 5] = ["cases", "failed", "overloaded", "missing", "repeated"];
/// Numbers of the sample.
const SAMPLE: [&str; 5] = ["count", "mean", "standard_deviation", "largest", "least"];

/// A row of the table.
struct Row<'a> {
    ensemble: &'a Ensemble<'a>,
    result: EnsembleResult,
    numbers: Vec<Option<f64>>,
    reason: Option<String>,
}

impl<'a> Row<'a> {
    /// The first case of the ensemble.
    fn first(&self) -> Option<RecordView<'a>> {
        self.ensemble.cases().next()
    }
}

/// Names of the numbers, in the order of [`Row::numbers`].
fn heads(seeds: String) -> Vec<String> {
    let mut heads: Vec<String> = COUNTS.iter().chain(&SAMPLE).map(|&name| name.to_owned()).collect();
    for fit in ["moments", "likelihood"] {
        heads.extend(["location", "scale"].map(|name| format!("{fit}_{name}")));
        for (name, _) in FRACTILES {
            heads.extend(["", "_low", "_high"].map(|end| format!("{fit}_{name}{end}")));
        }
    }
    heads.push(seeds);
    heads
}

/// Location, scale and fractiles with their intervals. The minima of storms are fitted as the maxima of their negatives.
fn fitted(values: &[f64], is_least: bool, fit: GumbelFit) -> Result<Vec<f64>, String> {
    let turned = |value: f64| if is_least { -value } else { value };
    let maxima: Vec<f64> = values.iter().copied().map(turned).collect();
    let extremes = SeedExtremes::fit(&maxima, fit).map_err(|error| error.to_string())?;
    let mut numbers = vec![turned(extremes.gumbel.location), extremes.gumbel.scale];
    for (_, probability) in FRACTILES {
        let found = extremes.fractile(probability, LEVEL).map_err(|error| error.to_string())?;
        let (low, high) = found.interval;
        let (low, high) = if is_least { (-high, -low) } else { (low, high) };
        numbers.extend([turned(found.value), low, high]);
    }
    if numbers.iter().any(|number| !number.is_finite()) {
        return Err("the fit is beyond the range of numbers".into());
    }
    Ok(numbers)
}

/// Mean, standard deviation (n - 1; none of one value), largest and least of a sample.
fn sample(values: &[f64]) -> [Option<f64>; 4] {
    let n = values.len() as f64;
    let Some(largest) = values.iter().copied().reduce(f64::max) else { return [None; 4] };
    let least = values.iter().copied().fold(largest, f64::min);
    let mean = largest + values.iter().map(|x| x - largest).sum::<f64>() / n;
    let deviation =
        (values.len() > 1).then(|| (values.iter().map(|x| (x - mean).powi(2)).sum::<f64>() / (n - 1.0)).sqrt());
    [Some(mean), deviation, Some(largest), Some(least)].map(|number| number.filter(|number| number.is_finite()))
}

fn row<'a>(ensemble: &'a Ensemble<'a>, result: EnsembleResult, (percent, seeds_head): (f64, &str)) -> Row<'a> {
    let [mean, deviation, largest, least] = sample(&result.values);
    let whole = |count: usize| Some(count as f64);
    let mut numbers = vec![
        whole(ensemble.len()),
        whole(ensemble.count(CaseStatus::Failed)),
        whole(ensemble.count(CaseStatus::Overloaded)),
        whole(result.missing),
        whole(ensemble.repeated),
        whole(result.values.len()),
        mean,
        deviation,
        largest,
        least,
    ];
    let mut reason = None;
    for (name, fit) in [("moments", GumbelFit::Moments), ("likelihood", GumbelFit::Likelihood)] {
        match fitted(&result.values, result.is_least, fit) {
            Ok(found) => numbers.extend(found.into_iter().map(Some)),
            Err(error) => {
                numbers.extend(std::iter::repeat_n(None, 2 + 3 * FRACTILES.len()));
                reason.get_or_insert_with(|| format!("no fit by {name}: {error}"));
            }
        }
    }
    let seeds = if result.is_least { seeds_for_scatter_of_minima } else { seeds_for_scatter };
    let seeds = match (mean, deviation) {
        (Some(mean), Some(deviation)) if reason.is_none() => seeds(deviation / mean, percent / 100.0, LEVEL)
            .map_err(|error| reason = Some(format!("no {seeds_head}: {error}")))
            .ok(),
        _ => None,
    };
    numbers.push(seeds.and_then(whole));
    Row { ensemble, result, numbers, reason }
}

/// The rows of `ensembles.csv`.
pub(super) struct EnsembleRows<'a> {
    ensembles: Vec<Ensemble<'a>>,
    inputs: Vec<(&'a str, bool)>,
    /// Half width of the interval of the most probable maximum that a number of seeds is about, per cent of it.
    percent: f64,
}

impl<'a> EnsembleRows<'a> {
    /// None where no case shares its inputs with another, or no result is kept.
    pub(super) fn new(study: &'a Study) -> Option<Self> {
        let ensembles = ensembles(&study.records);
        if ensembles.iter().all(|ensemble| ensemble.len() + ensemble.repeated < 2) {
            return None;
        }
        let has_result = |record: RecordView| {
            let has_tension = || record.lines().any(|row| row.largest_tension.or(row.least_tension).is_some());
            record.status() != CaseStatus::Failed && (record.results().next().is_some() || has_tension())
        };
        if !ensembles.iter().any(|ensemble| ensemble.cases().any(has_result)) {
            return None;
        }
        let mut inputs = input_heads(ensembles.iter().filter_map(|ensemble| ensemble.cases().next()));
        inputs.retain(|(name, _)| !is_seed_column(name));
        Some(EnsembleRows { ensembles, inputs, percent: study.info.scatter_percent })
    }
}

impl RowSource for EnsembleRows<'_> {
    fn count(&self) -> usize {
        self.ensembles.len()
    }

    fn at_once(&self) -> usize {
        ENSEMBLES_AT_ONCE
    }

    fn columns(&self, range: Range<usize>) -> Vec<StoredColumn> {
        let seeds_head = format!("seeds_for_{}_percent", self.percent);
        let ensembles = range.into_par_iter().filter_map(|place| self.ensembles.get(place));
        let rows_of = |ensemble| {
            let results = Ensemble::results(ensemble).into_iter();
            results.map(|result| row(ensemble, result, (self.percent, &seeds_head))).collect::<Vec<_>>()
        };
        let rows: Vec<Row<'_>> = ensembles.flat_map_iter(rows_of).collect();
        let first = rows.iter().map(|row| row.first().map(|case| case.case().to_owned()));
        let mut columns = vec![text_column("first_case", first.collect())];
        for (input, is_number) in &self.inputs {
            let cells = rows.iter().map(|row| cell_of(row.first()?, input)).collect();
            columns.push(input_column(input, *is_number, cells));
        }
        columns.push(text_column("result", rows.iter().map(|row| Some(row.result.name.clone())).collect()));
        let extreme = |row: &Row<'_>| Some(if row.result.is_least { "least" } else { "largest" }.to_owned());
        columns.push(text_column("extreme", rows.iter().map(extreme).collect()));
        let unit = |row: &Row<'_>| Some(row.result.unit.clone()).filter(|unit| !unit.is_empty());
        columns.push(text_column("unit", rows.iter().map(unit).collect()));
        for (at, head) in heads(seeds_head.clone()).iter().enumerate() {
            let values = rows.iter().map(|row| row.numbers.get(at).copied().flatten()).collect();
            columns.push(number_column(head, "", values));
        }
        columns.push(text_column("reason", rows.iter().map(|row| row.reason.clone()).collect()));
        columns
    }
}
