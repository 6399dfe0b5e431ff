//! The tables of a study: a row a case, a row a line of each case, and a row a result of each ensemble. They are made and written some rows
//! at a time, so that a million cases need little more memory than their records.

use super::ensembles::EnsembleRows;
use super::seed_checks::SeedCheckRows;
use crate::report::csv::guard_formula;
use crate::report::parquet::ColumnWriter;
use crate::report::stored::{ColumnValues, StoredColumn};
use std::collections::HashSet;
use std::io::{self, Write};
use std::ops::Range;
use std::path::Path;
use windlass_study::kept::LineRow;
use windlass_study::records::{RecordView, Records};
use windlass_study::store::{Files, Study};

/// A row a case.
pub const RESULTS_CSV: &str = "results.csv";
/// Records whose rows are made at once: a group of rows of Parquet of a few megabytes.
const RECORDS_AT_ONCE: usize = 1 << 15;

/// The tables of a study, as columns.
#[derive(Clone, Debug, PartialEq)]
pub struct StudyTables {
    /// A row a case.
    pub results: Vec<StoredColumn>,
    /// A row a line of each case; no column where no case has one.
    pub lines: Vec<StoredColumn>,
    /// A row a result of each ensemble: cases that differ in their seeds alone. No column where there is none of two cases.
    pub ensembles: Vec<StoredColumn>,
    /// A row a segment of each ensemble whose lines are checked by a code; no column where there is none.
    pub seed_checks: Vec<StoredColumn>,
}

impl StudyTables {
    /// The tables of a study, whole.
    pub fn new(study: &Study) -> Self {
        let whole = |table: &dyn RowSource| table.columns(0..table.count());
        StudyTables {
            results: whole(&ResultRows::new(&study.records)),
            lines: whole(&LineRows::new(&study.records)),
            ensembles: EnsembleRows::new(study).map_or_else(Vec::new, |table| whole(&table)),
            seed_checks: SeedCheckRows::new(study).map_or_else(Vec::new, |table| whole(&table)),
        }
    }
}

/// A table whose rows are made of things in a row, some of these at a time.
pub(super) trait RowSource: Sync {
    /// How many things there are.
    fn count(&self) -> usize;
    /// How many are to be taken at once.
    fn at_once(&self) -> usize {
        RECORDS_AT_ONCE
    }
    /// The columns of the rows of some of them, the same columns whichever they are; none of a table without rows.
    fn columns(&self, range: Range<usize>) -> Vec<StoredColumn>;
}

/// Writes results.csv, lines.csv, ensembles.csv and seed_checks.csv, and the same as Parquet. All but the first where there are some; what an earlier
/// start wrote of them is removed where there are none.
///
/// # Errors
/// What the system refuses.
pub fn write(study: &Study, folder: &Path, files: &dyn Files) -> io::Result<()> {
    write_table(&ResultRows::new(&study.records), ("results", "Results of a study"), folder, files)?;
    write_table(&LineRows::new(&study.records), ("lines", "Lines of a study"), folder, files)?;
    match EnsembleRows::new(study) {
        Some(table) => write_table(&table, ("ensembles", "Extremes over seeds of a study"), folder, files)?,
        None => remove_table("ensembles", folder, files)?,
    }
    match SeedCheckRows::new(study) {
        Some(table) => write_table(&table, ("seed_checks", "Checks of lines over seeds of a study"), folder, files),
        None => remove_table("seed_checks", folder, files),
    }
}

fn remove_table(name: &str, folder: &Path, files: &dyn Files) -> io::Result<()> {
    files.remove(&folder.join(format!("{name}.csv")))?;
    files.remove(&folder.join(format!("{name}.parquet")))
}

/// Writes both files of a table side by side, or removes them where it has no rows.
fn write_table(table: &dyn RowSource, (name, title): (&str, &str), folder: &Path, files: &dyn Files) -> io::Result<()> {
    let step = table.at_once();
    let range = |from: usize| from..table.count().min(from + step);
    let first = table.columns(range(0));
    if first.is_empty() {
        return remove_table(name, folder, files);
    }
    let wrong = |error: ::parquet::errors::ParquetError| io::Error::other(error.to_string());
    let (csv, parquet) = (folder.join(format!("{name}.csv")), folder.join(format!("{name}.parquet")));
    let mut first = Some(first);
    files.write_by(&csv, &mut |csv| {
        let mut csv = csv::Writer::from_writer(csv);
        files.write_by(&parquet, &mut |parquet| {
            let mut columns = first.take().unwrap_or_else(|| table.columns(range(0)));
            csv.write_record(columns.iter().map(csv_head))?;
            let mut parquet = ColumnWriter::new(parquet, title, "", &columns).map_err(wrong)?;
            let mut from = 0;
            while !columns.is_empty() {
                from += step;
                let make_next = || if from < table.count() { table.columns(range(from)) } else { Vec::new() };
                let (written, next) = rayon::join(|| write_csv_rows(&mut csv, &columns), make_next);
                written?;
                parquet.write(std::mem::replace(&mut columns, next)).map_err(wrong)?;
            }
            parquet.close().map_err(wrong)
        })?;
        csv.flush()
    })
}

pub(super) fn text_column(name: &str, values: Vec<Option<String>>) -> StoredColumn {
    StoredColumn { head: name.into(), long_name: name.into(), unit: String::new(), values: ColumnValues::Texts(values) }
}

pub(super) fn number_column(name: &str, unit: &str, values: Vec<Option<f64>>) -> StoredColumn {
    StoredColumn { head: name.into(), long_name: name.into(), unit: unit.into(), values: ColumnValues::Numbers(values) }
}

/// Names without case that come first among others, each once, in the order they come in.
#[derive(Default)]
struct FirstNames<'a> {
    seen: HashSet<String>,
    names: Vec<(&'a str, &'a str)>,
}

impl<'a> FirstNames<'a> {
    fn add(&mut self, name: &'a str, unit: &'a str, without_case: bool) {
        let key = if without_case { name.to_ascii_uppercase() } else { name.to_owned() };
        if self.seen.insert(key) {
            self.names.push((name, unit));
        }
    }
}

/// Columns of the tables of cases, and whether each has numbers alone.
pub(super) fn input_heads<'a>(records: impl Iterator<Item = RecordView<'a>>) -> Vec<(&'a str, bool)> {
    let mut heads: Vec<(&str, bool)> = Vec::new();
    // cells that are the same text are asked once
    let mut known: HashSet<(usize, *const u8)> = HashSet::new();
    for record in records {
        for (at, (name, cell)) in record.values().enumerate() {
            // most records have the same columns at the same places
            let place = match heads.get(at).filter(|(head, _)| *head == name) {
                Some(_) => at,
                None => heads.iter().position(|(head, _)| *head == name).unwrap_or_else(|| {
                    heads.push((name, true));
                    heads.len() - 1
                }),
            };
            if let Some((_, is_number)) = heads.get_mut(place)
                && *is_number
                && known.insert((place, cell.as_ptr()))
            {
                *is_number = number_of(cell).is_some();
            }
        }
    }
    heads
}

fn number_of(cell: &str) -> Option<f64> {
    cell.parse::<f64>().ok().filter(|number| number.is_finite())
}

/// The column of an input, of the records that have it.
pub(super) fn input_column(name: &str, is_number: bool, cells: Vec<Option<&str>>) -> StoredColumn {
    if is_number {
        number_column(name, "", cells.into_iter().map(|cell| cell.and_then(number_of)).collect())
    } else {
        text_column(name, cells.into_iter().map(|cell| cell.map(str::to_owned)).collect())
    }
}

/// The cell of a record in a column.
pub(super) fn cell_of<'a>(record: RecordView<'a>, name: &str) -> Option<&'a str> {
    record.values().find(|(head, _)| *head == name).map(|(_, cell)| cell)
}

/// A row a case.
struct ResultRows<'a> {
    records: &'a Records,
    inputs: Vec<(&'a str, bool)>,
    /// Names and units of results.
    results: Vec<(&'a str, &'a str)>,
}

impl<'a> ResultRows<'a> {
    fn new(records: &'a Records) -> Self {
        let mut results = FirstNames::default();
        let mut last: Option<RecordView> = None;
        for record in records.iter() {
            // what has the same names adds none
            if last.is_some_and(|last| last.is_like(&record)) {
                continue;
            }
            record.results().for_each(|((name, unit, _), _)| results.add(name, unit, true));
            last = Some(record);
        }
        let mut inputs = input_heads(records.iter());
        inputs.retain(|(head, _)| !head.eq_ignore_ascii_case("seed"));
        ResultRows { records, inputs, results: results.names }
    }
}

impl RowSource for ResultRows<'_> {
    fn count(&self) -> usize {
        self.records.len()
    }

    fn columns(&self, range: Range<usize>) -> Vec<StoredColumn> {
        let records: Vec<RecordView> = range.filter_map(|place| self.records.get(place)).collect();
        let texts = |of: &dyn Fn(&RecordView) -> String| {
            records.iter().map(|r| Some(of(r)).filter(|t| !t.is_empty())).collect()
        };
        let numbers = |of: &dyn Fn(&RecordView) -> f64| records.iter().map(|r| Some(of(r))).collect();
        let mut columns = vec![text_column("case", texts(&|r| r.case().to_owned()))];
        for (head, is_number) in &self.inputs {
            columns.push(input_column(head, *is_number, records.iter().map(|r| cell_of(*r, head)).collect()));
        }
        columns.push(number_column("seed", "", numbers(&|r| r.seed() as f64)));
        columns.push(text_column("status", texts(&|r| r.status().text().to_owned())));
        columns.push(text_column("reason", texts(&|r| r.reason().to_owned())));
        columns.push(number_column("seconds", "s", numbers(&|r| r.seconds())));
        for (name, unit) in &self.results {
            let of = |record: &RecordView| {
                let found = record.results().find(|((known, _, _), _)| known.eq_ignore_ascii_case(name));
                // of another unit than the column it is no number of it
                found.filter(|((_, known, _), _)| known == unit).map(|(_, value)| value)
            };
            columns.push(number_column(name, unit, records.iter().map(of).collect()));
        }
        columns.push(text_column("messages", texts(&|r| r.messages().join(" | "))));
        columns
    }
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

/// A row a line of each case.
struct LineRows<'a> {
    records: &'a Records,
    has_rows: bool,
}

impl<'a> LineRows<'a> {
    fn new(records: &'a Records) -> Self {
        LineRows { records, has_rows: records.iter().any(|record| record.line_count() > 0) }
    }
}

impl RowSource for LineRows<'_> {
    fn count(&self) -> usize {
        self.records.len()
    }

    fn at_once(&self) -> usize {
        RECORDS_AT_ONCE / 8
    }

    fn columns(&self, range: Range<usize>) -> Vec<StoredColumn> {
        if !self.has_rows {
            return Vec::new();
        }
        let records = range.filter_map(|place| self.records.get(place));
        let rows: Vec<(&str, LineRow)> =
            records.flat_map(|record| record.lines().map(move |line| (record.case(), line))).collect();
        let texts = |of: &dyn Fn(&str, &LineRow) -> Option<String>| rows.iter().map(|(c, l)| of(c, l)).collect();
        let mut columns = vec![
            text_column("case", texts(&|c, _| Some(c.to_owned()))),
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
}

/// A column's head in CSV: its name and its unit.
fn csv_head(column: &StoredColumn) -> String {
    if column.unit.is_empty() { column.head.clone() } else { format!("{} ({})", column.head, column.unit) }
}

fn write_csv_rows(writer: &mut csv::Writer<impl Write>, columns: &[StoredColumn]) -> io::Result<()> {
    let rows = columns.first().map_or(0, |column| column.values.len());
    let mut text = String::new();
    for row in 0..rows {
        for column in columns {
            text.clear();
            let number = |number: &dyn std::fmt::Display, text: &mut String| {
                // a text takes all that is written into it
                let _ = std::fmt::Write::write_fmt(text, format_args!("{number}"));
            };
            match &column.values {
                ColumnValues::Numbers(list) => {
                    list.get(row).copied().flatten().iter().for_each(|n| number(n, &mut text))
                }
                ColumnValues::Wholes(list) => {
                    list.get(row).copied().flatten().iter().for_each(|n| number(n, &mut text))
                }
                ColumnValues::Texts(list) => {
                    let cell = list.get(row).and_then(Option::as_deref);
                    text.push_str(&cell.map(guard_formula).unwrap_or_default());
                }
            }
            writer.write_field(&text)?;
        }
        writer.write_record(None::<&[u8]>)?;
    }
    Ok(())
}
