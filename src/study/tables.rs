//! The tables of a study: a row a case, and a row a line of each case.

use crate::report::csv::guard_formula;
use crate::report::parquet;
use crate::report::stored::{ColumnValues, StoredColumn};
use std::io;
use std::path::Path;
use windlass_study::kept::LineRow;
use windlass_study::record::CaseRecord;
use windlass_study::store::{Files, Study};

/// A row a case.
pub const RESULTS_CSV: &str = "results.csv";

/// The tables of a study, as columns.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyTables {
    /// A row a case.
    pub results: Vec<StoredColumn>,
    /// A row a line of each case; no column where no case has one.
    pub lines: Vec<StoredColumn>,
    /// A row a result of each ensemble: cases that differ in their seeds alone. No column where there is none of two cases.
    pub ensembles: Vec<StoredColumn>,
}

impl StudyTables {
    /// The tables of a study.
    pub fn new(study: &Study) -> Self {
        StudyTables {
            results: result_columns(study),
            lines: line_columns(study),
            ensembles: super::ensembles::columns(study),
        }
    }
}

/// Writes results.csv, lines.csv and ensembles.csv, and the same as Parquet. Lines and ensembles where there are some; what an earlier
/// start wrote of them is removed where there are none.
///
/// # Errors
/// What the system refuses.
pub fn write(study: &Study, folder: &Path, files: &dyn Files) -> io::Result<()> {
    let StudyTables { results, lines, ensembles } = StudyTables::new(study);
    for (name, title, columns) in [
        ("results", "Results of a study", results),
        ("lines", "Lines of a study", lines),
        ("ensembles", "Extremes over seeds of a study", ensembles),
    ] {
        let (csv, parquet) = (folder.join(format!("{name}.csv")), folder.join(format!("{name}.parquet")));
        if columns.is_empty() {
            files.remove(&csv)?;
            files.remove(&parquet)?;
        } else {
            files.write(&csv, &csv_bytes(&columns)?)?;
            files.write(&parquet, &parquet_bytes(title, columns)?)?;
        }
    }
    Ok(())
}

pub(super) fn text_column(name: &str, values: Vec<Option<String>>) -> StoredColumn {
    StoredColumn { head: name.into(), long_name: name.into(), unit: String::new(), values: ColumnValues::Texts(values) }
}

pub(super) fn number_column(name: &str, unit: &str, values: Vec<Option<f64>>) -> StoredColumn {
    StoredColumn { head: name.into(), long_name: name.into(), unit: unit.into(), values: ColumnValues::Numbers(values) }
}

/// A column of a table of cases: numbers where all of it are.
pub(super) fn input_column(name: &str, values: Vec<Option<String>>) -> StoredColumn {
    let numbers: Option<Vec<Option<f64>>> = values
        .iter()
        .map(|value| match value {
            None => Some(None),
            Some(text) => text.parse::<f64>().ok().filter(|number| number.is_finite()).map(Some),
        })
        .collect();
    match numbers {
        Some(numbers) => number_column(name, "", numbers),
        None => text_column(name, values),
    }
}

fn result_columns(study: &Study) -> Vec<StoredColumn> {
    let records = &study.records;
    let texts =
        |of: &dyn Fn(&CaseRecord) -> String| records.iter().map(|r| Some(of(r)).filter(|t| !t.is_empty())).collect();
    let mut columns = vec![text_column("case", texts(&|r| r.case.clone()))];
    let mut heads: Vec<&str> = Vec::new();
    let mut names: Vec<(&str, &str)> = Vec::new();
    for record in records {
        for (head, _) in &record.values {
            if !heads.contains(&head.as_str()) {
                heads.push(head);
            }
        }
        for result in &record.results {
            if !names.iter().any(|(known, _)| known.eq_ignore_ascii_case(&result.name)) {
                names.push((&result.name, &result.unit));
            }
        }
    }
    for head in heads.iter().filter(|head| !head.eq_ignore_ascii_case("seed")) {
        let of = |r: &CaseRecord| r.values.iter().find(|(name, _)| name == head).map(|(_, value)| value.clone());
        columns.push(input_column(head, records.iter().map(of).collect()));
    }
    columns.push(number_column("seed", "", records.iter().map(|r| Some(r.seed as f64)).collect()));
    columns.push(text_column("status", texts(&|r| r.status.text().to_owned())));
    columns.push(text_column("reason", texts(&|r| r.reason.clone())));
    columns.push(number_column("seconds", "s", records.iter().map(|r| Some(r.seconds)).collect()));
    for (name, unit) in names {
        let of = |r: &CaseRecord| {
            let found = r.results.iter().find(|result| result.name.eq_ignore_ascii_case(name));
            // of another unit than the column it is no number of it
            found.filter(|result| result.unit == unit).map(|result| result.value)
        };
        columns.push(number_column(name, unit, records.iter().map(of).collect()));
    }
    columns.push(text_column("messages", texts(&|r| r.messages.join(" | "))));
    columns
}

/// A number of a row of a line, with its name and unit.
type LineNumber = (&'static str, &'static str, fn(&LineRow) -> Option<f64>);

const LINE_NUMBERS: [LineNumber; 26] = [
    ("mean_tension", "N", |l| l.mean_tension),
    ("dynamic_tension", "N", |l| l.dynamic_tension),
    ("max_tension", "N", |l| l.max_tension),
    ("largest_tension", "N", |l| l.largest_tension),
    ("least_tension", "N", |l| l.least_tension),
    ("maxima", "", |l| l.maxima.map(|n| n as f64)),
    ("mpm", "N", |l| l.mpm),
    ("mpm_low", "N", |l| l.mpm_low),
    ("mpm_high", "N", |l| l.mpm_high),
    ("breaking_load", "N", |l| l.breaking_load),
    ("utilisation", "", |l| l.utilisation),
    ("safety_factor", "", |l| l.safety_factor),
    ("required_safety_factor", "", |l| l.required_safety_factor),
    ("screening_ratio", "", |l| l.screening_ratio),
    ("anchor_horizontal", "N", |l| l.anchor_horizontal),
    ("anchor_vertical", "N", |l| l.anchor_vertical),
    ("uplift", "", |l| l.uplift.map(|u| f64::from(u8::from(u)))),
    ("anchor_capacity", "N", |l| l.anchor_capacity),
    ("anchor_safety_factor", "", |l| l.anchor_safety_factor),
    ("anchor_required_factor", "", |l| l.anchor_required_factor),
    ("annual_damage", "1/year", |l| l.annual_damage),
    ("design_life", "years", |l| l.design_life),
    ("fatigue_factor", "", |l| l.fatigue_factor),
    ("grounded_length", "m", |l| l.grounded_length),
    ("offset", "m", |l| l.offset),
    ("loss_time", "s", |l| l.loss.as_ref().map(|loss| loss.time)),
];

/// Columns of the rows of lines; none where no case has one.
fn line_columns(study: &Study) -> Vec<StoredColumn> {
    let rows: Vec<(&CaseRecord, &LineRow)> =
        study.records.iter().flat_map(|record| record.lines.iter().map(move |line| (record, line))).collect();
    if rows.is_empty() {
        return Vec::new();
    }
    let texts = |of: &dyn Fn(&CaseRecord, &LineRow) -> Option<String>| rows.iter().map(|(r, l)| of(r, l)).collect();
    let mut columns = vec![
        text_column("case", texts(&|r, _| Some(r.case.clone()))),
        text_column("line", texts(&|_, l| Some(l.line.clone()))),
        number_column("segment", "", rows.iter().map(|(_, l)| l.segment.map(|n| n as f64)).collect()),
        text_column("analysis", texts(&|_, l| Some(l.analysis?.word().to_owned()))),
        text_column("condition", texts(&|_, l| Some(l.condition.word().to_owned()))),
        text_column("lost", texts(&|_, l| Some(l.lost.join(" ")).filter(|t| !t.is_empty()))),
        text_column("lost_at", texts(&|_, l| Some(l.loss.as_ref()?.reason.clone()))),
        text_column("code", texts(&|_, l| l.code.clone())),
        text_column("verdict", texts(&|_, l| Some(l.verdict?.word().to_owned()))),
        text_column("anchor_verdict", texts(&|_, l| Some(l.anchor_verdict?.word().to_owned()))),
    ];
    columns.extend(
        LINE_NUMBERS
            .iter()
            .map(|(name, unit, of)| number_column(name, unit, rows.iter().map(|(_, l)| of(l)).collect())),
    );
    columns
}

/// A column's head in CSV: its name and its unit.
fn csv_head(column: &StoredColumn) -> String {
    if column.unit.is_empty() { column.head.clone() } else { format!("{} ({})", column.head, column.unit) }
}

fn csv_bytes(columns: &[StoredColumn]) -> io::Result<Vec<u8>> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(columns.iter().map(csv_head))?;
    let rows = columns.first().map_or(0, |column| column.values.len());
    for row in 0..rows {
        let cell = |column: &StoredColumn| match &column.values {
            ColumnValues::Numbers(list) => list.get(row).copied().flatten().map(|n| n.to_string()),
            ColumnValues::Wholes(list) => list.get(row).copied().flatten().map(|n| n.to_string()),
            ColumnValues::Texts(list) => list.get(row).and_then(Option::as_ref).map(|t| guard_formula(t).into_owned()),
        };
        writer.write_record(columns.iter().map(|column| cell(column).unwrap_or_default()))?;
    }
    writer.into_inner().map_err(|error| io::Error::other(error.to_string()))
}

fn parquet_bytes(title: &str, columns: Vec<StoredColumn>) -> io::Result<Vec<u8>> {
    parquet::column_bytes(title, "", columns).map_err(|error| io::Error::other(error.to_string()))
}
