//! Parts of a study: cases that processes on many machines run, each into a file of its own, and what is made of them when they are over.
//!
//! `parts/N.jsonl` holds the division of start N: a line of JSON on what all parts share, a line for the cases of each part, and the places of
//! these lines as numbers of one width, so that a part reads its own line alone. Part P of start N adds its records to `results-N-P.jsonl`;
//! it may be stopped and run again at any time.

use crate::record::{CaseRecord, CaseStatus, decode};
use crate::records::RecordView;
use crate::runner::{
    Batch, BegunStudy, Followed, Keep, Lane, MAX_FAILED_FOLDERS, Progress, ResultsFile, RunCase, StudyEnd, StudyPlan,
    drop_stray_folders, keepers,
};
use crate::store::{Files, KEPT_CASES, Study, StudyError};
use crate::table::Case;
use serde::{Deserialize, Serialize};
use std::collections::HashSet;
use std::fs::{self, File};
use std::io::{self, BufRead, BufReader, Read, Seek, SeekFrom};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

/// The folder of divisions.
pub const PARTS: &str = "parts";
/// Digits and line end of a place.
const PLACE_WIDTH: usize = 21;

/// What the parts of a start share.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Division {
    /// The start of the study.
    pub start: u64,
    /// How many parts there are.
    pub parts: usize,
    /// The script.
    pub model: String,
    /// The folder that the script is named from.
    pub begun_in: String,
    /// Columns of the table.
    pub columns: Vec<String>,
    /// What is kept.
    pub keep: Keep,
    /// Version of the program.
    pub version: String,
}

/// A part of a study.
#[derive(Clone, Debug, PartialEq)]
pub struct Part {
    /// What the parts share.
    pub division: Division,
    /// Its number, from 1.
    pub number: usize,
    /// Its cases.
    pub cases: Vec<Case>,
    /// Records of intact cases of earlier starts that transient ones of the part follow.
    intact: Vec<CaseRecord>,
    folder: PathBuf,
}

/// A part as its line has it.
#[derive(Serialize, Deserialize)]
struct PartLine<C, R> {
    cases: Vec<C>,
    #[serde(default = "Vec::new", skip_serializing_if = "Vec::is_empty")]
    intact: Vec<R>,
}

fn division_file(folder: &Path, start: u64) -> PathBuf {
    folder.join(PARTS).join(format!("{start}.jsonl"))
}

/// The newest start that is divided.
///
/// # Errors
/// What the system refuses.
pub fn newest_division(folder: &Path) -> Result<Option<u64>, StudyError> {
    let parts = folder.join(PARTS);
    let entries = match fs::read_dir(&parts) {
        Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(None),
        entries => entries.map_err(StudyError::of(&parts))?,
    };
    let mut newest = None;
    for entry in entries {
        let name = entry.map_err(StudyError::of(&parts))?.file_name();
        let number = name.to_string_lossy().strip_suffix(".jsonl").and_then(|start| start.parse().ok());
        newest = newest.max(number);
    }
    Ok(newest)
}

/// Writes how the pending cases of a start are divided: `packed` has the places of the cases of each part.
///
/// # Errors
/// What the system refuses.
pub fn divide(
    plan: &StudyPlan,
    begun: &BegunStudy,
    packed: &[Vec<usize>],
    files: &dyn Files,
) -> Result<(), StudyError> {
    let parts = plan.folder.join(PARTS);
    files.make_folder(&parts).map_err(StudyError::of(&parts))?;
    let start = begun.start;
    let division = Division {
        start,
        parts: packed.len(),
        model: plan.model.clone(),
        begun_in: plan.begun_in.clone(),
        columns: plan.table.columns.clone(),
        keep: plan.keep,
        version: plan.version.clone(),
    };
    let path = division_file(&plan.folder, start);
    let wrong = |error: serde_json::Error| StudyError::of(&path)(error.into());
    let mut text = serde_json::to_vec(&division).map_err(wrong)?;
    text.push(b'\n');
    let mut places = vec![text.len()];
    for places_of_part in packed {
        let cases: Vec<&Case> = places_of_part.iter().filter_map(|place| begun.pending.get(*place).copied()).collect();
        let intact = begun.intact_records(&cases);
        serde_json::to_writer(&mut text, &PartLine { cases, intact }).map_err(wrong)?;
        text.push(b'\n');
        places.push(text.len());
    }
    for place in places {
        text.extend(format!("{place:020}\n").bytes());
    }
    files.write(&path, &text).map_err(StudyError::of(&path))
}

impl Division {
    /// The division of a start.
    ///
    /// # Errors
    /// A start that is not divided, and what the system refuses.
    pub fn open(folder: &Path, start: u64) -> Result<Self, StudyError> {
        let path = division_file(folder, start);
        let file = File::open(&path).map_err(StudyError::of(&path))?;
        Self::read(&mut BufReader::new(file), &path)
    }

    fn read(file: &mut impl BufRead, path: &Path) -> Result<Self, StudyError> {
        let mut line = String::new();
        file.read_line(&mut line).map_err(StudyError::of(path))?;
        serde_json::from_str(&line).map_err(|error| StudyError::of(path)(error.into()))
    }
}

impl Part {
    /// A part of a start, its number from 1.
    ///
    /// # Errors
    /// A start that is not divided, a number of no part, and what the system refuses.
    pub fn open(folder: &Path, start: u64, number: usize) -> Result<Self, StudyError> {
        let path = division_file(folder, start);
        let mut file = BufReader::new(File::open(&path).map_err(StudyError::of(&path))?);
        let division = Division::read(&mut file, &path)?;
        if number == 0 || number > division.parts {
            let message = format!("it has the parts 1 to {}, not {number}", division.parts);
            return Err(StudyError::Folder { path, message });
        }
        let line = Self::read_line(&mut file, division.parts, number).map_err(StudyError::of(&path))?;
        let line: PartLine<Case, CaseRecord> =
            serde_json::from_slice(&line).map_err(|error| StudyError::of(&path)(error.into()))?;
        let PartLine { cases, intact } = line;
        Ok(Part { division, number, cases, intact, folder: folder.to_path_buf() })
    }

    /// The line of a part, by the places at the end of the file.
    fn read_line(file: &mut BufReader<File>, parts: usize, number: usize) -> io::Result<Vec<u8>> {
        let back = (parts + 2 - number) * PLACE_WIDTH;
        file.seek(SeekFrom::End(-i64::try_from(back).map_err(io::Error::other)?))?;
        let mut places = [0_u64; 2];
        for place in &mut places {
            let mut text = String::new();
            file.read_line(&mut text)?;
            *place = text.trim_end().parse().map_err(io::Error::other)?;
        }
        let [from, to] = places;
        file.seek(SeekFrom::Start(from))?;
        let mut line = Vec::new();
        file.take(to.saturating_sub(from)).read_to_end(&mut line)?;
        Ok(line)
    }

    /// The file of its records.
    pub fn results(&self) -> PathBuf {
        self.folder.join(format!("results-{}-{}.jsonl", self.division.start, self.number))
    }

    /// Runs the cases of the part that its file does not have, so many at a time, their answers in `scratch`. Answers of failed cases are kept
    /// as the study says; those that govern are not known before all parts are over: [`collect`] says which they are.
    ///
    /// # Errors
    /// Files that cannot be written; the cases that are done stay done.
    pub fn run(
        &self,
        (jobs, scratch): (usize, &Path),
        files: &dyn Files,
        runner: &dyn RunCase,
        stop: &AtomicBool,
        told: &(dyn Fn(Progress) + Sync),
    ) -> Result<StudyEnd, StudyError> {
        let results = self.results();
        let done = match fs::read(&results) {
            Err(error) if error.kind() == io::ErrorKind::NotFound => Vec::new(),
            bytes => {
                let bytes = bytes.map_err(StudyError::of(&results))?;
                let (records, valid) = decode(&bytes);
                if valid < bytes.len() {
                    files.truncate(&results, valid as u64).map_err(StudyError::of(&results))?;
                }
                records
            }
        };
        let names: HashSet<&str> = done.iter().map(|record| record.case.as_str()).collect();
        let pending: Vec<&Case> = self.cases.iter().filter(|case| !names.contains(case.name.as_str())).collect();
        let follows: HashSet<&str> = pending.iter().filter_map(|case| case.intact.as_deref()).collect();
        let ended = self.intact.iter().chain(&done).filter(|record| follows.contains(record.case.as_str()));
        let followed = Followed::new(&pending, ended.cloned());
        let kept_cases = self.folder.join(KEPT_CASES);
        let results = Arc::new(ResultsFile::new(results));
        let lanes = (0..jobs.clamp(1, pending.len().max(1)))
            .map(|worker| Lane { results: Arc::clone(&results), running: scratch.join(format!("running-{worker}")) });
        let batch = Batch {
            columns: &self.division.columns,
            lanes: lanes.collect(),
            keep: if self.division.keep == Keep::Governing { Keep::Failed } else { self.division.keep },
            kept_cases,
            max_failed: MAX_FAILED_FOLDERS.div_ceil(self.division.parts.max(1)),
            start: self.division.start,
            version: &self.division.version,
            pending,
            followed,
            files,
            runner,
            stop,
            told,
        };
        let progress = batch.run_alone()?;
        Ok(StudyEnd { kept: names.len(), again: Vec::new(), progress })
    }
}

/// Ends a study whose parts are over: drops answers that are not kept, and makes those of cases that govern, which no part could know, again,
/// so many at a time, in `scratch`. The study as it stands.
///
/// # Errors
/// Files that cannot be written.
pub fn collect(
    folder: &Path,
    keep: Keep,
    (jobs, scratch): (usize, &Path),
    files: &dyn Files,
    runner: &dyn RunCase,
    stop: &AtomicBool,
) -> Result<Study, StudyError> {
    let kept_cases = folder.join(KEPT_CASES);
    files.make_folder(&kept_cases).map_err(StudyError::of(&kept_cases))?;
    let study = Study::open(folder)?;
    let stays = keepers(&study, keep);
    drop_stray_folders(folder, &stays, files)?;
    let is_missing = |record: &RecordView| {
        record.status() != CaseStatus::Failed
            && stays.contains(record.case())
            && !kept_cases.join(record.case()).is_dir()
    };
    let missing: Vec<CaseRecord> = study.records.iter().filter(is_missing).map(|record| record.to_record()).collect();
    drop(stays);
    let (next, failed) = (AtomicUsize::new(0), Mutex::new(None));
    let make = |worker: usize| -> Result<(), StudyError> {
        let running = scratch.join(format!("running-{worker}"));
        while !stop.load(Ordering::Relaxed) {
            let Some(record) = missing.get(next.fetch_add(1, Ordering::Relaxed)) else { break };
            // a record that this crate has written has cells that it can read
            let Ok((case, columns)) = Case::from_record(record) else { continue };
            let intact = case.intact.as_ref().and_then(|name| study.records.of_case(name)).map(|view| view.to_record());
            files.remove_folder(&running).map_err(StudyError::of(&running))?;
            files.make_folder(&running).map_err(StudyError::of(&running))?;
            if runner.run(&case, &columns, &running, intact.as_ref()).is_none() {
                break;
            }
            let to = kept_cases.join(&record.case);
            files.move_folder(&running, &to).map_err(StudyError::of(&to))?;
        }
        Ok(())
    };
    std::thread::scope(|scope| {
        for worker in 0..jobs.clamp(1, missing.len().max(1)) {
            let (make, failed) = (&make, &failed);
            scope.spawn(move || {
                if let Err(error) = make(worker)
                    && let Ok(mut failed) = failed.lock()
                {
                    failed.get_or_insert(error);
                }
            });
        }
    });
    let failed = failed.into_inner().unwrap_or_else(std::sync::PoisonError::into_inner);
    failed.map_or(Ok(study), Err)
}
