//! A session with what its last call left, as text that C can read.

use std::ffi::{CStr, CString};
use std::path::PathBuf;
use windlass::hosted::{HostMessage, HostSettings, HostedSession, RunOutcome, columns};
use windlass::report::stored::{ColumnValues, StoredColumn};

/// A text for C: it ends where a NUL stands, which no text of a session has.
pub(crate) fn c_text(text: impl Into<Vec<u8>>) -> CString {
    let mut bytes: Vec<u8> = text.into();
    bytes.retain(|byte| *byte != 0);
    CString::new(bytes).unwrap_or_default()
}

/// A column with its texts for C.
#[derive(Clone, Debug, PartialEq)]
pub struct CColumn {
    /// Its name with its unit, as in a CSV file.
    pub name: CString,
    /// Its unit; empty of plain numbers and text.
    pub unit: CString,
    /// The texts of its rows, where it has any.
    pub texts: Option<Vec<CString>>,
    /// Its numbers, NaN where there is none.
    pub numbers: Vec<f64>,
}

/// A table with its texts for C.
#[derive(Clone, Debug, PartialEq)]
pub struct CTable {
    /// Its title.
    pub title: CString,
    /// Its number of rows.
    pub rows: usize,
    /// Its columns, all of so many rows.
    pub columns: Vec<CColumn>,
}

/// A session, and what its last call left.
pub struct CSession {
    session: HostedSession,
    text: CString,
    error: CString,
    warnings: CString,
    tables: Vec<CTable>,
    place: Option<(usize, usize)>,
}

impl CSession {
    /// A session of a root: its answers go to `ROOT.ans`.
    pub fn new(root: &str) -> Self {
        let settings = HostSettings { root: PathBuf::from(root), ..HostSettings::default() };
        CSession {
            session: HostedSession::new(settings),
            text: CString::default(),
            error: CString::default(),
            warnings: CString::default(),
            tables: Vec::new(),
            place: None,
        }
    }

    /// Runs records; false where one was refused.
    pub fn run(&mut self, records: &str) -> bool {
        let outcome = self.session.run(records, None);
        self.keep(outcome)
    }

    /// Runs a script or an AQWA deck; false where a record was refused or the file cannot be read.
    pub fn run_file(&mut self, path: &str) -> bool {
        let outcome = self.session.run_file(path.as_ref());
        self.keep(outcome)
    }

    /// What the last call printed.
    pub fn text(&self) -> &CStr {
        &self.text
    }

    /// The error of the last call as it is printed; empty without one.
    pub fn error(&self) -> &CStr {
        &self.error
    }

    /// Warnings and notes of the last call, as they are printed.
    pub fn warnings(&self) -> &CStr {
        &self.warnings
    }

    /// The tables that the last call showed.
    pub fn tables(&self) -> &[CTable] {
        &self.tables
    }

    /// Line and column of the word that the last error is about, from 1.
    pub fn error_place(&self) -> Option<(usize, usize)> {
        self.place
    }

    fn keep(&mut self, outcome: RunOutcome) -> bool {
        let RunOutcome { error, remarks, text, tables, .. } = outcome;
        self.place = error.as_ref().and_then(|error| error.line.zip(error.column));
        self.text = c_text(text);
        self.error = c_text(error.as_ref().map_or("", |error| error.rendered.as_str()));
        let warnings: Vec<&str> = remarks.iter().map(|said: &HostMessage| said.rendered.trim_end()).collect();
        self.warnings = c_text(warnings.join("\n"));
        let table = |kept: &windlass::hosted::KeptTable| CTable {
            title: c_text(kept.table.title.as_str()),
            rows: kept.table.rows(),
            columns: columns(kept).iter().map(column).collect(),
        };
        self.tables = tables.iter().map(table).collect();
        error.is_none()
    }
}

fn column(stored: &StoredColumn) -> CColumn {
    let (numbers, texts) = match &stored.values {
        ColumnValues::Numbers(list) => (list.iter().map(|value| value.unwrap_or(f64::NAN)).collect(), None),
        ColumnValues::Wholes(list) => (list.iter().map(|value| value.map_or(f64::NAN, |n| n as f64)).collect(), None),
        ColumnValues::Texts(list) => {
            let texts = list.iter().map(|text| c_text(text.as_deref().unwrap_or_default())).collect();
            (vec![f64::NAN; list.len()], Some(texts))
        }
    };
    CColumn { name: c_text(stored.head.as_str()), unit: c_text(stored.unit.as_str()), texts, numbers }
}
