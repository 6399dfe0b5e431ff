//! What is written of a finished case: a line of JSON behind its check sum.

use crate::kept::{KeptResult, LineRow};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::io::{self, BufRead};

/// How a case ended.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum CaseStatus {
    /// Without an error.
    Done,
    /// A tension was beyond its break.
    Overloaded,
    /// An error, or no answer at all.
    #[default]
    Failed,
}

impl CaseStatus {
    /// As a table has it.
    pub fn text(self) -> &'static str {
        match self {
            CaseStatus::Done => "done",
            CaseStatus::Overloaded => "overloaded",
            CaseStatus::Failed => "failed",
        }
    }
}

/// A file that a case has read.
#[derive(Clone, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct FileRead {
    /// Its path.
    pub path: String,
    /// Its size (bytes).
    pub size: u64,
    /// SHA-256 of it, in hexadecimal digits.
    pub hash: String,
}

/// A value at an instant of a run.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Peak {
    /// Time (s).
    pub time: f64,
    /// The value: a tension (N), an offset (m).
    pub value: f64,
    /// The stored instant before it (s), and the value there.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub before: Option<(f64, f64)>,
}

/// When a line of an intact run pulls hardest, and when its body is farthest away.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct LinePeaks {
    /// Name of the line.
    pub line: String,
    /// Maxima of its tension at the first end between crossings of the mean, largest first (N).
    pub tension: Vec<Peak>,
    /// Largest horizontal distance of the body at its first end from where the model has it (m).
    pub offset: Option<Peak>,
}

/// The intact case that a transient one has followed.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct FollowedCase {
    /// Its name.
    pub case: String,
    /// Check sum of its peaks; `None` where it had failed.
    pub sum: Option<String>,
}

impl FollowedCase {
    /// What is kept of an intact case with such an end and such peaks.
    pub(crate) fn new(case: &str, status: CaseStatus, peaks: &[LinePeaks]) -> Self {
        let text = (status != CaseStatus::Failed).then(|| serde_json::to_string(peaks).unwrap_or_default());
        let sum = text.map(|text| format!("{:08x}", crc32fast::hash(text.as_bytes())));
        FollowedCase { case: case.to_owned(), sum }
    }
}

/// A finished case.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct CaseRecord {
    /// Its name.
    pub case: String,
    /// Columns and values of its row.
    pub values: Vec<(String, String)>,
    /// Its seed.
    pub seed: u64,
    /// How it ended.
    pub status: CaseStatus,
    /// Why it failed; empty of others.
    pub reason: String,
    /// Title of its job.
    #[serde(default)]
    pub title: String,
    /// Labels of the units of length and of force that its script uses.
    #[serde(default)]
    pub units: Option<(String, String)>,
    /// Seconds of the clock that it took.
    pub seconds: f64,
    /// Errors and warnings.
    pub messages: Vec<String>,
    /// What every report of the case says: shortcuts of the solve, and what is missing and accepted.
    #[serde(default)]
    pub caveats: Vec<String>,
    /// Named results.
    pub results: Vec<KeptResult>,
    /// Rows of lines.
    pub lines: Vec<LineRow>,
    /// Peaks of the lines that transient cases lose, of an intact case that such cases follow.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub peaks: Vec<LinePeaks>,
    /// The intact case that it has followed.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub intact: Option<FollowedCase>,
    /// What it has read.
    pub read: Vec<FileRead>,
    /// Version of the program.
    pub version: String,
    /// Which start of the study it is of: the later counts.
    pub start: u64,
}

impl CaseRecord {
    /// What a transient case that follows this one keeps of it.
    pub fn followed(&self) -> FollowedCase {
        FollowedCase::new(&self.case, self.status, &self.peaks)
    }

    /// The line of the file, its end included.
    ///
    /// # Errors
    /// What JSON cannot hold: none of the values that this crate makes.
    pub fn encode(&self) -> Result<Vec<u8>, serde_json::Error> {
        let text = serde_json::to_string(self)?;
        Ok(format!("{:08x} {text}\n", crc32fast::hash(text.as_bytes())).into_bytes())
    }
}

/// The records of a file, and how many of its bytes they take; what is behind them is half a record, as a kill leaves it.
pub fn decode(bytes: &[u8]) -> (Vec<CaseRecord>, usize) {
    let mut records = Vec::new();
    // bytes in memory are read without an error
    let valid = decode_each(bytes, &mut |record| records.push(record)).map_or(0, |end| end.valid);
    (records, usize::try_from(valid).unwrap_or(bytes.len()))
}

/// Where the records of a file end.
pub(crate) struct RecordsEnd {
    /// Bytes of whole records.
    pub(crate) valid: u64,
    /// Whether half a record is behind them.
    pub(crate) is_torn: bool,
}

/// Bytes of records that are decoded at once, side by side; a longer record is decoded alone.
const DECODED_AT_ONCE: usize = 1 << 22;

/// Gives each record of a file in its order, up to half a record as a kill leaves it. A few megabytes of them are held at a time.
///
/// # Errors
/// What the system says as the file is read.
pub(crate) fn decode_each(mut file: impl BufRead, take: &mut dyn FnMut(CaseRecord)) -> io::Result<RecordsEnd> {
    let (mut text, mut valid) = (Vec::new(), 0);
    loop {
        text.clear();
        let mut lines = Vec::new();
        let mut from = 0;
        while from < DECODED_AT_ONCE && file.read_until(b'\n', &mut text)? > 0 {
            lines.push(from..text.len());
            from = text.len();
        }
        if lines.is_empty() {
            return Ok(RecordsEnd { valid, is_torn: false });
        }
        let decoded: Vec<Option<CaseRecord>> =
            lines.par_iter().map(|range| text.get(range.clone()).and_then(decode_line)).collect();
        for (range, record) in lines.into_iter().zip(decoded) {
            let Some(record) = record else { return Ok(RecordsEnd { valid, is_torn: true }) };
            take(record);
            valid += range.len() as u64;
        }
    }
}

/// The record of a line with its end; `None` of half a record, and of one that does not fit its check sum.
fn decode_line(line: &[u8]) -> Option<CaseRecord> {
    let (sum, text) = std::str::from_utf8(line.strip_suffix(b"\n")?).ok()?.split_once(' ')?;
    let fits = u32::from_str_radix(sum, 16).ok()? == crc32fast::hash(text.as_bytes());
    if fits { serde_json::from_str(text).ok() } else { None }
}
