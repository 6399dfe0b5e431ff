//! Running a case, and comparing what its script leaves.

use super::case::{Case, Quantity, Wanted, WantedRow};
use super::judge::{Tolerance, Verdict, judge};
use super::place::{Place, Row, find_cells, find_fact};
use super::printed::Printed;
use crate::commands::KeptTable;
use crate::report::files::JobFolder;
use crate::report::output::Output;
use crate::session::Session;
use std::path::Path;
use std::time::Instant;
use windlass_base::diagnostic::Severity;
use windlass_base::table::{Column, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_language::render::render;

/// What a case came to.
#[derive(Clone, Debug)]
pub struct CaseResult {
    /// One comparison a quantity, in the order of the case.
    pub comparisons: Vec<Comparison>,
    /// Errors of the script.
    pub errors: Vec<String>,
    /// How long it ran (s).
    pub seconds: f64,
}

/// A result beside a printed number. Of a column it is that of the row that is worst.
#[derive(Clone, Debug)]
pub struct Comparison {
    /// The printed number.
    pub printed: Option<Printed>,
    /// The result, in the unit of the printed number.
    pub ours: Option<f64>,
    /// What a fraction of the error is taken of.
    pub size: f64,
    /// Numbers that were compared.
    pub count: usize,
    /// What it comes to.
    pub verdict: Verdict,
    /// Why there is no result.
    pub trouble: Option<String>,
}

impl Comparison {
    /// The result less the printed number.
    pub fn error(&self) -> Option<f64> {
        Some(self.ours? - self.printed.as_ref()?.value)
    }

    /// The error as a fraction of the printed number, or of the size of its column; `None` of nothing.
    pub fn relative_error(&self) -> Option<f64> {
        self.error().filter(|_| self.size > 0.0).map(|error| error / self.size)
    }

    /// The error in units of the last printed digit.
    pub fn last_digits(&self) -> Option<f64> {
        Some(self.error()? / self.printed.as_ref()?.unit)
    }
}

impl CaseResult {
    /// The worst of its verdicts.
    pub fn verdict(&self) -> Verdict {
        self.comparisons.iter().map(|comparison| comparison.verdict).max().unwrap_or(Verdict::Missed)
    }
}

/// Runs a case as a user would, in a folder of its own that is removed, and compares.
pub fn run_case(case: &Case) -> CaseResult {
    let begun = Instant::now();
    let (left, mut errors) = match tempfile::tempdir() {
        Ok(folder) => run_script(case, folder.path()),
        Err(error) => (Left::default(), vec![format!("no folder to run in: {error}")]),
    };
    let comparisons: Vec<Comparison> = case.quantities.iter().map(|quantity| compare(quantity, &left)).collect();
    errors.dedup();
    let failed = !errors.is_empty();
    let judged = comparisons.into_iter().map(|mut comparison| {
        if failed {
            comparison.verdict = Verdict::Missed;
        }
        comparison
    });
    CaseResult { comparisons: judged.collect(), errors, seconds: begun.elapsed().as_secs_f64() }
}

/// What a script leaves.
#[derive(Default)]
struct Left {
    tables: Vec<KeptTable>,
    variables: Vec<(String, String)>,
}

fn run_script(case: &Case, folder: &Path) -> (Left, Vec<String>) {
    let mut errors = Vec::new();
    for (name, text) in &case.files {
        if let Err(error) = std::fs::write(folder.join(name), text) {
            errors.push(format!("{name}: {error}"));
        }
    }
    let job = JobFolder::new(folder.join(&case.name), None, false);
    let answers = job.folder.clone();
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.keep_reports = true;
    session.job.output.keep_log = false;
    session.job.kept_tables = Some(Vec::new());
    session.open(&case.name, case.script.clone());
    session.run();
    let wrong = |severity| matches!(severity, Severity::Error | Severity::Fatal);
    let said = session.reports.iter().filter(|said| wrong(said.severity));
    errors.extend(said.map(|said| render(said, &session.interpreter.sources, false)));
    let mut left = Left { tables: session.job.kept_tables.take().unwrap_or_default(), variables: Vec::new() };
    let variable = |name: &str| session.interpreter.variables.get(name).map(str::to_string);
    for quantity in &case.quantities {
        match &quantity.ours {
            Place::Variable(name, _) => left.variables.extend(variable(name).map(|value| (name.clone(), value))),
            Place::Cell { table, .. }
                if table.ends_with(".csv") && !left.tables.iter().any(|kept| kept.table.title == *table) =>
            {
                left.tables.extend(read_csv(&answers.join(table), table));
            }
            _ => {}
        }
    }
    (left, errors)
}

/// A CSV file that the script wrote, as a table of texts.
fn read_csv(path: &Path, name: &str) -> Option<KeptTable> {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).ok()?;
    let heads = reader.headers().ok()?.clone();
    let records: Vec<csv::StringRecord> = reader.records().flatten().collect();
    let column = |(at, head): (usize, &str)| {
        let cells = records.iter().map(|record| record.get(at).unwrap_or_default().to_string());
        Column::new("", head, Dim::None, Digits::Usual, cells)
    };
    let columns = heads.iter().enumerate().map(column).collect();
    Some(KeptTable { table: Table::from_columns(name, columns), units: UnitSystem::SI })
}

fn compare(quantity: &Quantity, left: &Left) -> Comparison {
    let tolerance = quantity.tolerance.as_ref().map(|bound| bound.within);
    let explained = quantity.explained.as_ref().map(|bound| bound.within);
    let found =
        find(&quantity.ours, left).map(|list| list.into_iter().map(|v| v * quantity.factor).collect::<Vec<_>>());
    match (&quantity.wanted, found) {
        (Wanted::Number(printed), Ok(list)) => {
            let ours = list.first().copied().unwrap_or(f64::NAN);
            let verdict = judge(ours, printed, tolerance, explained, printed.value);
            let (size, printed) = (printed.value.abs(), Some(printed.clone()));
            Comparison { printed, ours: Some(ours), size, count: 1, verdict, trouble: None }
        }
        (Wanted::Numbers(rows), Ok(list)) if rows.len() == list.len() => worst(rows, &list, tolerance, explained),
        (Wanted::Numbers(rows), Ok(list)) => {
            missed(None, rows.len(), format!("the source has {} rows, the result {}", rows.len(), list.len()))
        }
        (Wanted::Number(printed), Err(trouble)) => missed(Some(printed.clone()), 1, trouble),
        (Wanted::Numbers(rows), Err(trouble)) => missed(None, rows.len(), trouble),
    }
}

fn missed(printed: Option<Printed>, count: usize, trouble: String) -> Comparison {
    Comparison { printed, ours: None, size: 0.0, count, verdict: Verdict::Missed, trouble: Some(trouble) }
}

/// The comparison of the row of a column whose error is the largest part of its size.
fn worst(rows: &[WantedRow], list: &[f64], tolerance: Option<Tolerance>, explained: Option<Tolerance>) -> Comparison {
    let one = |(row, ours): (&WantedRow, &f64)| Comparison {
        printed: Some(row.printed.clone()),
        ours: Some(*ours),
        size: row.size,
        count: rows.len(),
        verdict: judge(*ours, &row.printed, tolerance, explained, row.size),
        trouble: None,
    };
    let weight = |c: &Comparison| c.error().map_or(f64::INFINITY, |error| error.abs() / c.size.max(f64::MIN_POSITIVE));
    let all = rows.iter().zip(list).map(one);
    let found = all.max_by(|a, b| a.verdict.cmp(&b.verdict).then(weight(a).total_cmp(&weight(b))));
    found.unwrap_or_else(|| missed(None, 0, "there are no rows".into()))
}

/// The numbers of a place.
fn find(place: &Place, left: &Left) -> Result<Vec<f64>, String> {
    match place {
        Place::Variable(name, word) => {
            let found = left.variables.iter().find(|(known, _)| known == name);
            let (_, text) = found.ok_or_else(|| format!("the script sets no variable {name}"))?;
            let word = text.split_whitespace().nth(word - 1).unwrap_or_default();
            let number = word.parse::<f64>().map_err(|_| format!("%{name}% is `{text}`, no number"))?;
            Ok(vec![number])
        }
        Place::Fact { table, fact } => find_fact(&left.tables, table, fact).map(|value| vec![value]),
        Place::Cell { table, row, column } => find_cells(&left.tables, table, row, column).map(|list| match row {
            Row::All => list,
            _ => list.into_iter().take(1).collect(),
        }),
    }
}
