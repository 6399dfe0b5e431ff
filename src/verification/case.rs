//! Reading of verification cases.

use super::judge::Tolerance;
use super::place::Place;
use super::printed::Printed;
use super::texts;
use serde::Deserialize;
use std::fmt;
use std::ops::Range;
use std::path::Path;
use toml::Spanned;

/// A verification case.
#[derive(Clone, Debug)]
pub struct Case {
    /// Its name: that of its file without the ending.
    pub name: String,
    /// What it shows, in one line.
    pub shows: String,
    /// Where the numbers are printed.
    pub source: String,
    /// What kind of reference that is.
    pub reference: Reference,
    /// How long it takes.
    pub cost: Cost,
    /// Files that the script reads: names and texts.
    pub files: Vec<(String, String)>,
    /// The script.
    pub script: String,
    /// What is compared.
    pub quantities: Vec<Quantity>,
}

/// What a result is compared with.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Deserialize)]
pub enum Reference {
    /// A formula, evaluated elsewhere.
    #[serde(rename = "closed form")]
    ClosedForm,
    /// The listing of a program that a manual prints.
    #[serde(rename = "listing")]
    Listing,
    /// Numbers of a paper, a report, a standard or a table.
    #[serde(rename = "published case")]
    PublishedCase,
    /// The result of another program.
    #[serde(rename = "other program")]
    OtherProgram,
}

impl Reference {
    /// All kinds.
    pub const ALL: [Reference; 4] =
        [Reference::ClosedForm, Reference::Listing, Reference::PublishedCase, Reference::OtherProgram];

    /// As case files and pages write it.
    pub fn text(self) -> &'static str {
        match self {
            Reference::ClosedForm => "closed form",
            Reference::Listing => "listing",
            Reference::PublishedCase => "published case",
            Reference::OtherProgram => "other program",
        }
    }
}

/// How long a case takes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Deserialize)]
pub enum Cost {
    /// So little that every `cargo test` runs it.
    #[default]
    #[serde(rename = "quick")]
    Quick,
    /// Up to some seconds in a release build: `windlass verify` runs it.
    #[serde(rename = "heavy")]
    Heavy,
    /// Longer: only `windlass verify --all` and `windlass verify NAME` run it.
    #[serde(rename = "long")]
    Long,
}

/// What is compared.
#[derive(Clone, Debug)]
pub struct Quantity {
    /// What it is.
    pub name: String,
    /// Unit of the printed number; empty of plain numbers.
    pub unit: String,
    /// The number or the numbers of the source.
    pub wanted: Wanted,
    /// Where the script leaves the result.
    pub ours: Place,
    /// Factor from the result to the printed unit and sign.
    pub factor: f64,
    /// How far the result may lie from the printed number, and why so far.
    pub tolerance: Option<Bound>,
    /// How far beyond that it may lie, and why it does.
    pub explained: Option<Bound>,
}

/// The number or the numbers of the source.
#[derive(Clone, Debug)]
pub enum Wanted {
    /// A printed number.
    Number(Printed),
    /// A column of numbers.
    Numbers(Vec<WantedRow>),
}

/// A number of a column.
#[derive(Clone, Debug)]
pub struct WantedRow {
    /// The number.
    pub printed: Printed,
    /// What a tolerance in percent is taken of.
    pub size: f64,
}

/// A tolerance with its reason.
#[derive(Clone, Debug, PartialEq)]
pub struct Bound {
    /// The tolerance.
    pub within: Tolerance,
    /// As the case writes it.
    pub text: String,
    /// Why.
    pub reason: String,
}

/// What is wrong in the file of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct CaseError {
    /// The file.
    pub file: String,
    /// Line and column, from 1.
    pub place: Option<(usize, usize)>,
    /// The key it is about.
    pub key: String,
    /// What is wrong.
    pub message: String,
}

impl fmt::Display for CaseError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}:", self.file)?;
        if let Some((line, column)) = self.place {
            write!(f, "{line}:{column}:")?;
        }
        if !self.key.is_empty() {
            write!(f, " {}:", self.key)?;
        }
        write!(f, " {}", self.message)
    }
}

/// The text of a case, and where its data files are.
#[derive(Clone, Copy, Debug)]
pub struct CaseText<'t> {
    /// Name of its file.
    pub file: &'t str,
    /// The text.
    pub text: &'t str,
    /// The folder of its data files; without one they are those in the program.
    pub folder: Option<&'t Path>,
}

/// A case file as it stands.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct RawCase {
    shows: Spanned<String>,
    source: Spanned<String>,
    reference: Reference,
    #[serde(default)]
    cost: Cost,
    #[serde(default)]
    files: Vec<Spanned<String>>,
    tolerance: Option<Spanned<String>>,
    reason: Option<Spanned<String>>,
    script: Spanned<String>,
    #[serde(default)]
    quantity: Vec<Spanned<RawQuantity>>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawQuantity {
    name: Spanned<String>,
    #[serde(default)]
    unit: String,
    printed: Option<Spanned<String>>,
    printed_column: Option<Spanned<String>>,
    scale: Option<Spanned<String>>,
    ours: Spanned<String>,
    factor: Option<Spanned<f64>>,
    tolerance: Option<Spanned<String>>,
    reason: Option<Spanned<String>>,
    explained: Option<RawBound>,
}

#[derive(Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct RawBound {
    within: Spanned<String>,
    reason: Spanned<String>,
}

/// The cases in the program, by name; each a case or what is wrong in it.
pub fn embedded() -> Vec<Result<Case, CaseError>> {
    texts::CASES.iter().map(|(file, text)| CaseText { file, text, folder: None }.read()).collect()
}

/// The cases of a folder, by name; each a case or what is wrong in it.
///
/// # Errors
/// A folder that cannot be read.
pub fn read_cases(folder: &Path) -> Result<Vec<Result<Case, CaseError>>, CaseError> {
    let at = |file: &Path, error: String| CaseError {
        file: file.display().to_string(),
        place: None,
        key: String::new(),
        message: error,
    };
    let entries = std::fs::read_dir(folder).map_err(|error| at(folder, error.to_string()))?;
    let mut paths: Vec<_> = entries.flatten().map(|entry| entry.path()).collect();
    paths.retain(|path| path.extension().is_some_and(|end| end == "toml"));
    paths.sort();
    let read = |path: &Path| {
        let text = crate::session::read_text(path).map_err(|error| at(path, error.to_string()))?;
        CaseText { file: &path.display().to_string(), text: text.as_str(), folder: Some(folder) }.read()
    };
    Ok(paths.iter().map(|path| read(path)).collect())
}

impl CaseText<'_> {
    /// Reads the case.
    ///
    /// # Errors
    /// What is wrong, with line and key.
    pub fn read(&self) -> Result<Case, CaseError> {
        let raw: RawCase = toml::from_str(self.text).map_err(|error| {
            let key = error.span().map_or("", |span| self.key_at(&span));
            self.error(error.span(), key, error.message().trim().replace('\n', ", "))
        })?;
        let line = |key: &str, text: &Spanned<String>| {
            let is_line = !text.get_ref().trim().is_empty() && !text.get_ref().contains('\n');
            let wrong = || self.error(Some(text.span()), key, "one line of text is needed".into());
            is_line.then(|| text.get_ref().trim().to_string()).ok_or_else(wrong)
        };
        let mut files = Vec::new();
        for file in &raw.files {
            files.push((file.get_ref().clone(), self.data(file.get_ref(), || file.span(), "files")?));
        }
        if raw.quantity.is_empty() {
            return Err(self.error(None, "quantity", "the case compares nothing: add a table [[quantity]]".into()));
        }
        let bound = self.bound(raw.tolerance.as_ref(), raw.reason.as_ref())?;
        let mut quantities: Vec<Quantity> = Vec::new();
        for given in &raw.quantity {
            let made = self.quantity(given, bound.as_ref())?;
            if quantities.iter().any(|quantity| quantity.name == made.name) {
                let text = format!("a second quantity is called `{}`", made.name);
                return Err(self.error(Some(given.get_ref().name.span()), "name", text));
            }
            quantities.push(made);
        }
        let stem = Path::new(self.file).file_stem().unwrap_or_default().to_string_lossy().into_owned();
        Ok(Case {
            name: stem,
            shows: line("shows", &raw.shows)?,
            source: line("source", &raw.source)?,
            reference: raw.reference,
            cost: raw.cost,
            files,
            script: raw.script.get_ref().clone(),
            quantities,
        })
    }

    fn quantity(&self, given: &Spanned<RawQuantity>, case: Option<&Bound>) -> Result<Quantity, CaseError> {
        let raw = given.get_ref();
        let ours = Place::read(raw.ours.get_ref()).map_err(|text| self.error(Some(raw.ours.span()), "ours", text))?;
        let wanted = match (&raw.printed, &raw.printed_column) {
            (Some(text), None) => {
                let wrong = || format!("`{}` is not a number as a source prints it", text.get_ref());
                let read = Printed::read(text.get_ref());
                Wanted::Number(read.ok_or_else(|| self.error(Some(text.span()), "printed", wrong()))?)
            }
            (None, Some(column)) => Wanted::Numbers(self.column(column, raw.scale.as_ref())?),
            (Some(_), Some(column)) => {
                let text = "printed and printed_column cannot be given together".into();
                return Err(self.error(Some(column.span()), "printed_column", text));
            }
            (None, None) => {
                let text = "the number of the source is missing: printed = \"1.23\", or printed_column".into();
                return Err(self.error(Some(raw.name.span()), "printed", text));
            }
        };
        if ours.is_column() != matches!(wanted, Wanted::Numbers(_)) {
            let text = "a row * goes with printed_column, any other row with printed".into();
            return Err(self.error(Some(raw.ours.span()), "ours", text));
        }
        if let (Some(scale), None) = (&raw.scale, &raw.printed_column) {
            return Err(self.error(Some(scale.span()), "scale", "scale goes with printed_column".into()));
        }
        let factor = raw.factor.as_ref().map_or(1.0, |factor| *factor.get_ref());
        if let Some(given) = raw.factor.as_ref().filter(|_| factor == 0.0 || !factor.is_finite()) {
            return Err(self.error(Some(given.span()), "factor", "a number other than 0 is needed".into()));
        }
        let own = self.bound(raw.tolerance.as_ref(), raw.reason.as_ref())?;
        let explained = match &raw.explained {
            Some(raw) => self.bound(Some(&raw.within), Some(&raw.reason))?,
            None => None,
        };
        Ok(Quantity {
            name: raw.name.get_ref().clone(),
            unit: raw.unit.clone(),
            wanted,
            ours,
            factor,
            tolerance: own.or_else(|| case.cloned()),
            explained,
        })
    }

    /// A tolerance with its reason; one without the other is wrong.
    fn bound(
        &self,
        within: Option<&Spanned<String>>,
        reason: Option<&Spanned<String>>,
    ) -> Result<Option<Bound>, CaseError> {
        match (within, reason) {
            (Some(within), Some(reason)) => {
                let wrong = || {
                    let text =
                        format!("`{}` is neither a number above 0 nor a percentage: 0.01 or 0.5 %", within.get_ref());
                    self.error(Some(within.span()), self.key_at(&within.span()), text)
                };
                let read = Tolerance::read(within.get_ref()).ok_or_else(wrong)?;
                let (text, reason) = (within.get_ref().trim().to_string(), reason.get_ref().trim().to_string());
                Ok(Some(Bound { within: read, text, reason }))
            }
            (Some(within), None) => {
                Err(self.error(Some(within.span()), "reason", "the tolerance has no reason beside it".into()))
            }
            (None, Some(reason)) => {
                Err(self.error(Some(reason.span()), "tolerance", "the reason has no tolerance beside it".into()))
            }
            (None, None) => Ok(None),
        }
    }

    /// The numbers of a column of a CSV file, with what percentages are taken of.
    fn column(&self, given: &Spanned<String>, scale: Option<&Spanned<String>>) -> Result<Vec<WantedRow>, CaseError> {
        let wrong = |text: String| self.error(Some(given.span()), "printed_column", text);
        let Some((file, column)) = given.get_ref().split_once('|') else {
            return Err(wrong("a column is written `file.csv | column`".into()));
        };
        let text = self.data(file.trim(), || given.span(), "printed_column")?;
        let mut reader = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
        let heads = reader.headers().map_err(|error| wrong(error.to_string()))?.clone();
        let find = |name: &str| heads.iter().position(|head| head.trim() == name.trim());
        let at = find(column).ok_or_else(|| {
            let names: Vec<&str> = heads.iter().collect();
            wrong(format!("{} has no column {}: it has {}", file.trim(), column.trim(), names.join(", ")))
        })?;
        let mut scales = Vec::new();
        for name in scale.into_iter().flat_map(|scale| scale.get_ref().split(',')).filter(|name| name.trim() != "range")
        {
            scales.push(find(name).ok_or_else(|| {
                let text = format!("{} has no column {}", file.trim(), name.trim());
                self.error(scale.map(Spanned::span), "scale", text)
            })?);
        }
        let mut rows = Vec::new();
        for (row, record) in reader.records().enumerate() {
            let record = record.map_err(|error| wrong(error.to_string()))?;
            let number = |at: usize| record.get(at).and_then(|text| Printed::read(text.trim()));
            let not_one = || wrong(format!("row {} of column {} is no number", row + 1, column.trim()));
            let printed = number(at).ok_or_else(not_one)?;
            let sum: f64 = scales.iter().filter_map(|at| number(*at)).map(|p| p.value * p.value).sum();
            let size = if scales.is_empty() { printed.value.abs() } else { sum.sqrt() };
            rows.push(WantedRow { printed, size });
        }
        if scale.is_some_and(|scale| scale.get_ref().trim() == "range") {
            let values = || rows.iter().map(|row: &WantedRow| row.printed.value);
            let range = values().fold(f64::NEG_INFINITY, f64::max) - values().fold(f64::INFINITY, f64::min);
            rows.iter_mut().for_each(|row| row.size = range);
        }
        if rows.is_empty() {
            return Err(wrong(format!("{} has no rows", file.trim())));
        }
        Ok(rows)
    }

    /// The text of a data file.
    fn data(&self, name: &str, span: impl Fn() -> Range<usize>, key: &str) -> Result<String, CaseError> {
        let wrong = |text: String| self.error(Some(span()), key, text);
        if name.is_empty() || name.contains(['/', '\\']) || name.starts_with('.') {
            return Err(wrong(format!("`{name}` is no plain file name")));
        }
        for path in self.folder.into_iter().flat_map(|folder| [folder.join(name), folder.join("data").join(name)]) {
            if path.exists() {
                let text = crate::session::read_text(&path).map_err(|error| wrong(error.to_string()))?;
                return Ok(text.as_str().to_string());
            }
        }
        let found = texts::DATA.iter().find(|(file, _)| *file == name);
        found.map(|(_, text)| (*text).to_string()).ok_or_else(|| wrong(format!("there is no data file {name}")))
    }

    fn error(&self, span: Option<Range<usize>>, key: &str, message: String) -> CaseError {
        let place = span.map(|span| {
            let before = self.text.get(..span.start.min(self.text.len())).unwrap_or_default();
            let line_start = before.rfind('\n').map_or(0, |at| at + 1);
            let column = before.get(line_start..).map_or(1, |text| text.chars().count() + 1);
            (before.matches('\n').count() + 1, column)
        });
        CaseError { file: self.file.to_string(), place, key: key.to_string(), message }
    }

    /// The key of the line a span begins in.
    fn key_at(&self, span: &Range<usize>) -> &str {
        let before = self.text.get(..span.start.min(self.text.len())).unwrap_or_default();
        let line_start = before.rfind('\n').map_or(0, |at| at + 1);
        let line = self.text.get(line_start..).and_then(|rest| rest.lines().next()).unwrap_or_default();
        line.split_once('=').map_or("", |(key, _)| key.trim())
    }
}
