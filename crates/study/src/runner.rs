//! Runs the cases of a study side by side, keeps their records, and goes on where an earlier start ended.

use crate::kept::LineRow;
use crate::record::{CaseRecord, CaseStatus, FileRead};
use crate::records::{RecordView, Records};
use crate::store::{Files, INFO, KEPT_CASES, Study, StudyError, StudyInfo, UNFINISHED, results_file};
use crate::table::{Case, CaseTable};
use serde::{Deserialize, Serialize};
use std::borrow::Borrow;
use std::collections::{HashMap, HashSet};
use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Condvar, Mutex, PoisonError};
use std::time::Duration;

/// Longest time that a record waits for the disk: however long the next case takes, a kill loses no more.
const SYNC_AFTER: Duration = Duration::from_secs(1);

/// Failed cases that keep the folder of their answers, unless all cases do: a study in which all fail is not to fill the disk.
pub const MAX_FAILED_FOLDERS: usize = 200;

/// Which cases keep the folder of their answers.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Keep {
    /// None.
    Nothing,
    /// Those that failed.
    Failed,
    /// Those that failed, and those that govern: the largest or the least value of a result, or the most severe row of a segment of a
    /// line, intact, damaged or transient.
    #[default]
    Governing,
    /// All.
    Everything,
}

/// A study to run.
#[derive(Clone, Debug)]
pub struct StudyPlan {
    /// Its folder.
    pub folder: PathBuf,
    /// The script.
    pub model: String,
    /// The folder that script and table are named from.
    pub begun_in: String,
    /// Name of the table.
    pub table_name: String,
    /// The table.
    pub table: CaseTable,
    /// The seed of the study.
    pub seed: u64,
    /// Version of the program.
    pub version: String,
    /// Cases at a time.
    pub jobs: usize,
    /// What is kept.
    pub keep: Keep,
    /// Whether failed cases of an earlier start are run again.
    pub retry_failed: bool,
    /// Scatter of the most probable maximum over seeds that a number of seeds is said for (per cent).
    pub scatter_percent: f64,
}

/// A way to run a case.
pub trait RunCase: Sync {
    /// Runs a case with its answers in a folder, which is there and empty; `None` where it was interrupted. A transient case gets the
    /// record of the intact one that it follows, which has not failed. The start of the record is set by the study.
    fn run(&self, case: &Case, columns: &[String], folder: &Path, intact: Option<&CaseRecord>) -> Option<CaseRecord>;
    /// Whether a file is still as a case has read it.
    fn is_unchanged(&self, read: &FileRead) -> bool;
}

/// How far a study is.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Progress {
    /// Cases finished in this start.
    pub finished: usize,
    /// Of these, those that failed.
    pub failed: usize,
    /// Cases to run in this start.
    pub total: usize,
}

/// What came of a start.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct StudyEnd {
    /// Cases that were finished before.
    pub kept: usize,
    /// Cases run again, with the reason.
    pub again: Vec<(String, String)>,
    /// How far it came.
    pub progress: Progress,
}

/// The governing values so far, and the cases they are of: the largest and the least of each result, and the most severe row of each
/// segment in each condition. Failed cases govern nothing.
#[derive(Default)]
struct Governing {
    best: HashMap<String, (f64, String)>,
    /// Of how many values a case is the largest.
    held: HashMap<String, usize>,
}

impl Governing {
    /// Takes up a record: whether it governs, and which cases do so no more.
    fn offer(&mut self, record: &CaseRecord) -> (bool, Vec<String>) {
        if record.status == CaseStatus::Failed {
            return (false, Vec::new());
        }
        let results = record.results.iter().map(|result| (result.name.as_str(), result.value));
        let judged = record.lines.iter().filter(|_| record.judges_tension());
        self.offer_values(&record.case, results, judged)
    }

    /// The same of a record among others.
    fn offer_view(&mut self, record: RecordView) {
        if record.status() == CaseStatus::Failed {
            return;
        }
        let results = record.results().map(|((name, _, _), value)| (name.as_str(), value));
        if record.line_count() > 0 && record.judges_tension() {
            self.offer_values(record.case(), results, record.lines());
        } else {
            self.offer_values(record.case(), results, std::iter::empty::<LineRow>());
        }
    }

    fn offer_values<'a>(
        &mut self,
        case: &str,
        results: impl Iterator<Item = (&'a str, f64)>,
        lines: impl Iterator<Item = impl Borrow<LineRow>>,
    ) -> (bool, Vec<String>) {
        let mut gone = Vec::new();
        // one text for all: few values govern, and only their keys are kept
        let mut key = String::new();
        for (name, value) in results {
            for (kind, value) in [("largest ", value), ("least ", -value)] {
                key.clear();
                key.push_str(kind);
                key.extend(name.chars().map(|letter| letter.to_ascii_uppercase()));
                self.offer_value(&key, value, case, &mut gone);
            }
        }
        for row in lines {
            let row = row.borrow();
            let Some((kind, value)) = row.severity() else { continue };
            key.clear();
            // a text takes all that is written into it
            let _ = write!(key, "line {} {} {kind:?}", row.label(), row.condition.word());
            self.offer_value(&key, value, case, &mut gone);
        }
        gone.retain(|case| !self.governs(case));
        gone.dedup();
        (self.governs(case), gone)
    }

    fn offer_value(&mut self, key: &str, value: f64, case: &str, gone: &mut Vec<String>) {
        let best = self.best.get(key);
        // of equal values the case whose name comes first, whatever the order they end in
        if best.is_some_and(|(old, known)| value < *old || (value == *old && *case >= **known)) {
            return;
        }
        if let Some((_, before)) = self.best.insert(key.to_owned(), (value, case.to_owned())) {
            let left = self.held.entry(before.clone()).or_default();
            *left = left.saturating_sub(1);
            if *left == 0 {
                self.held.remove(&before);
                gone.push(before);
            }
        }
        *self.held.entry(case.to_owned()).or_default() += 1;
    }

    /// Whether a case governs.
    fn governs(&self, case: &str) -> bool {
        self.held.get(case).copied().unwrap_or(0) > 0
    }
}

/// How long a worker waits for an intact case before it looks whether the study has been stopped.
const LOOK_AFTER: Duration = Duration::from_millis(100);

/// The records of intact cases that transient ones follow.
#[derive(Default)]
pub(crate) struct Followed {
    /// Those that have ended; `None` of one that has been interrupted.
    ended: Mutex<HashMap<String, Option<Arc<CaseRecord>>>>,
    /// Names of those to wait for.
    expected: HashSet<String>,
    news: Condvar,
}

impl Followed {
    /// What cases that are to run can follow: those of them that have transient ones behind them, and the records of earlier ones.
    pub(crate) fn new(pending: &[&Case], ended: impl Iterator<Item = CaseRecord>) -> Self {
        let ended = ended.map(|record| (record.case.clone(), Some(Arc::new(record)))).collect();
        let expected = pending.iter().map(|case| case.name.clone()).collect();
        Followed { ended: Mutex::new(ended), expected, news: Condvar::new() }
    }

    /// Takes up a case that has ended, where another follows it.
    fn end(&self, case: &Case, record: impl FnOnce() -> Option<CaseRecord>) {
        if case.peaks_of.is_empty() {
            return;
        }
        let mut ended = self.ended.lock().unwrap_or_else(PoisonError::into_inner);
        ended.insert(case.name.clone(), record().map(Arc::new));
        self.news.notify_all();
    }

    /// The record of a case, once it has ended; `None` where there will be none.
    fn wait(&self, case: &str, stop: &AtomicBool) -> Option<Arc<CaseRecord>> {
        let mut ended = self.ended.lock().unwrap_or_else(PoisonError::into_inner);
        loop {
            if let Some(record) = ended.get(case) {
                return record.clone();
            }
            if stop.load(Ordering::Relaxed) || !self.expected.contains(case) {
                return None;
            }
            ended = self.news.wait_timeout(ended, LOOK_AFTER).unwrap_or_else(PoisonError::into_inner).0;
        }
    }
}

/// A file of records, only ever added to.
pub(crate) struct ResultsFile {
    path: PathBuf,
    /// Whether it holds more than was seen through to the disk.
    is_ahead: Mutex<bool>,
}

impl ResultsFile {
    pub(crate) fn new(path: PathBuf) -> Self {
        ResultsFile { path, is_ahead: Mutex::new(false) }
    }

    /// Adds bytes.
    fn append(&self, bytes: &[u8], files: &dyn Files) -> Result<(), StudyError> {
        let mut is_ahead = self.is_ahead.lock().unwrap_or_else(PoisonError::into_inner);
        *is_ahead = true;
        files.append(&self.path, bytes).map_err(StudyError::of(&self.path))
    }

    /// Sees what was added through to the disk.
    fn sync(&self, files: &dyn Files) -> Result<(), StudyError> {
        let mut is_ahead = self.is_ahead.lock().unwrap_or_else(PoisonError::into_inner);
        if *is_ahead {
            files.sync(&self.path).map_err(StudyError::of(&self.path))?;
            *is_ahead = false;
        }
        Ok(())
    }
}

/// Where a worker writes.
pub(crate) struct Lane {
    /// The file of its records. Workers may share one.
    pub(crate) results: Arc<ResultsFile>,
    /// The folder of the answers of the case that it runs.
    pub(crate) running: PathBuf,
}

/// Cases to run side by side, a lane a worker.
pub(crate) struct Batch<'a> {
    pub(crate) columns: &'a [String],
    pub(crate) pending: Vec<&'a Case>,
    pub(crate) followed: Followed,
    pub(crate) version: &'a str,
    pub(crate) lanes: Vec<Lane>,
    pub(crate) keep: Keep,
    pub(crate) kept_cases: PathBuf,
    /// Failed cases that keep the folder of their answers, unless all cases do.
    pub(crate) max_failed: usize,
    pub(crate) start: u64,
    pub(crate) files: &'a dyn Files,
    pub(crate) runner: &'a dyn RunCase,
    pub(crate) stop: &'a AtomicBool,
    pub(crate) told: &'a (dyn Fn(Progress) + Sync),
}

/// What the workers share.
struct Shared<'a> {
    batch: &'a Batch<'a>,
    next: AtomicUsize,
    state: Mutex<(Governing, Progress, Option<StudyError>)>,
}

impl Batch<'_> {
    /// Runs the cases; `governing` has the values of those that are done.
    ///
    /// # Errors
    /// Files that cannot be written; the cases that are done stay done.
    fn run(&self, governing: Governing) -> Result<Progress, StudyError> {
        let progress = Progress { total: self.pending.len(), ..Progress::default() };
        let state = Mutex::new((governing, progress, None));
        let shared = Shared { batch: self, next: AtomicUsize::new(0), state };
        let give_up = |error: StudyError| {
            self.stop.store(true, Ordering::Relaxed);
            shared.state.lock().unwrap_or_else(PoisonError::into_inner).2.get_or_insert(error);
        };
        let (are_over, news) = (Mutex::new(false), Condvar::new());
        std::thread::scope(|scope| {
            scope.spawn(|| self.sync_until(&are_over, &news).unwrap_or_else(give_up));
            let (shared, give_up) = (&shared, &give_up);
            let begin = |lane| scope.spawn(move || work(shared, lane).unwrap_or_else(give_up));
            let workers: Vec<_> = self.lanes.iter().map(begin).collect();
            let ended: Vec<_> = workers.into_iter().map(|worker| worker.join()).collect();
            *are_over.lock().unwrap_or_else(PoisonError::into_inner) = true;
            news.notify_all();
            if let Some(panic) = ended.into_iter().find_map(Result::err) {
                std::panic::resume_unwind(panic);
            }
        });
        let (_, progress, error) = shared.state.into_inner().unwrap_or_else(PoisonError::into_inner);
        error.map_or(Ok(progress), Err)
    }

    /// Sees records through to the disk every second until the workers are over.
    fn sync_until(&self, are_over: &Mutex<bool>, news: &Condvar) -> Result<(), StudyError> {
        let mut over = are_over.lock().unwrap_or_else(PoisonError::into_inner);
        while !*over {
            over = news.wait_timeout(over, SYNC_AFTER).unwrap_or_else(PoisonError::into_inner).0;
            for lane in &self.lanes {
                lane.results.sync(self.files)?;
            }
        }
        Ok(())
    }

    /// Runs the cases of which none governs anything before.
    ///
    /// # Errors
    /// Files that cannot be written; the cases that are done stay done.
    pub(crate) fn run_alone(&self) -> Result<Progress, StudyError> {
        self.run(Governing::default())
    }
}

/// A study that is begun or gone on with, before its cases are run.
pub struct BegunStudy<'a> {
    /// Number of this start.
    pub start: u64,
    /// Cases to run, in the order of the table, transient ones behind the others.
    pub pending: Vec<&'a Case>,
    /// The records of earlier starts.
    pub records: Records,
    /// What was kept, and what is run again.
    pub end: StudyEnd,
    governing: Governing,
    followed: Followed,
}

/// Begins a study or goes on with one: its folder, what it is of, and which cases are to run.
///
/// # Errors
/// A folder of another study, and files that cannot be written.
pub fn begin_study<'a>(
    plan: &'a StudyPlan,
    files: &dyn Files,
    runner: &dyn RunCase,
) -> Result<BegunStudy<'a>, StudyError> {
    let folder = plan.folder.as_path();
    files.make_folder(folder).map_err(StudyError::of(folder))?;
    for entry in std::fs::read_dir(folder).map_err(StudyError::of(folder))? {
        let entry = entry.map_err(StudyError::of(folder))?;
        if entry.file_name().to_string_lossy().starts_with(UNFINISHED) {
            files.remove(&entry.path()).map_err(StudyError::of(folder))?;
        }
    }
    let info_path = folder.join(INFO);
    let earlier = if info_path.exists() {
        Some(Study::open_with(folder, &mut |path, valid| files.truncate(path, valid))?)
    } else {
        let is_empty = std::fs::read_dir(folder).map_err(StudyError::of(folder))?.next().is_none();
        if !is_empty {
            let message = "it holds files and is of no study: name an empty folder or a new one".to_owned();
            return Err(StudyError::Folder { path: folder.to_path_buf(), message });
        }
        None
    };
    if let Some(known) = earlier.as_ref().filter(|study| study.info.seed != plan.seed) {
        let message = format!("its study has the seed {}, not {}: name another folder", known.info.seed, plan.seed);
        return Err(StudyError::Folder { path: folder.to_path_buf(), message });
    }
    let start = earlier.as_ref().map_or(1, |study| study.info.start + 1);
    let info = StudyInfo {
        model: plan.model.clone(),
        begun_in: plan.begun_in.clone(),
        table: plan.table_name.clone(),
        seed: plan.seed,
        version: plan.version.clone(),
        start,
        scatter_percent: plan.scatter_percent,
        cases: plan.table.cases.iter().map(|case| case.name.clone()).collect(),
    };
    let text = serde_json::to_vec_pretty(&info).map_err(|error| StudyError::of(&info_path)(error.into()))?;
    files.write(&info_path, &text).map_err(StudyError::of(&info_path))?;

    let records = earlier.map(|study| study.records).unwrap_or_default();
    let known: HashMap<&str, RecordView> = records.iter().map(|record| (record.case(), record)).collect();
    let mut unchanged: Option<RecordView> = None;
    let (mut end, mut governing, mut pending) = (StudyEnd::default(), Governing::default(), Vec::new());
    let (mut followed, mut behind) = (Followed::default(), Vec::new());
    // intact cases before the transient ones that follow them: no worker waits while there is other work
    let (transient, others): (Vec<&Case>, Vec<&Case>) = plan.table.cases.iter().partition(|case| case.intact.is_some());
    for case in others.into_iter().chain(transient) {
        let list = if case.intact.is_some() { &mut behind } else { &mut pending };
        let Some(record) = known.get(case.name.as_str()) else {
            followed.expected.insert(case.name.clone());
            list.push(case);
            continue;
        };
        // the files of a record like the last one have been looked at
        let has_read_the_same = unchanged.is_some_and(|last| last.is_like(record));
        let reason = reason_to_run_again(plan, case, record, (runner, has_read_the_same)).or_else(|| {
            let intact = case.intact.as_deref()?;
            if followed.expected.contains(intact) {
                return Some(format!("its intact case {intact} is run again"));
            }
            let now = known.get(intact).map(|record| record.followed());
            (now.as_ref() != record.intact()).then(|| format!("its intact case {intact} has changed"))
        });
        match reason {
            None => {
                end.kept += 1;
                governing.offer_view(*record);
                followed.end(case, || Some(record.to_record()));
                unchanged = Some(*record);
            }
            Some(reason) => {
                end.again.push((case.name.clone(), reason));
                followed.expected.insert(case.name.clone());
                list.push(case);
            }
        }
    }
    pending.append(&mut behind);
    let kept_cases = folder.join(KEPT_CASES);
    files.make_folder(&kept_cases).map_err(StudyError::of(&kept_cases))?;
    Ok(BegunStudy { start, pending, records, end, governing, followed })
}

/// Runs what is left of a study.
///
/// # Errors
/// A folder of another study, and files that cannot be written; the cases that are done stay done.
pub fn run_study(
    plan: &StudyPlan,
    files: &dyn Files,
    runner: &dyn RunCase,
    stop: &AtomicBool,
    told: &(dyn Fn(Progress) + Sync),
) -> Result<StudyEnd, StudyError> {
    let begun = begin_study(plan, files, runner)?;
    let BegunStudy { start, pending, records: _, mut end, governing, followed } = begun;
    end.progress = run_here(plan, (start, pending, followed), governing, files, runner, stop, told)?;
    Ok(end)
}

impl BegunStudy<'_> {
    /// The records of the intact cases that some of the pending ones follow and that are not run again themselves.
    pub(crate) fn intact_records(&self, cases: &[&Case]) -> Vec<CaseRecord> {
        let mut wanted: HashSet<&str> = cases.iter().filter_map(|case| case.intact.as_deref()).collect();
        if !wanted.is_empty() {
            self.pending.iter().for_each(|case| {
                wanted.remove(case.name.as_str());
            });
        }
        if wanted.is_empty() {
            return Vec::new();
        }
        self.records.iter().filter(|record| wanted.contains(record.case())).map(|record| record.to_record()).collect()
    }

    /// Places of the pending cases that have to be run by one process, intact ones with the transient ones that follow them.
    pub fn groups(&self) -> Vec<Vec<usize>> {
        let (mut groups, mut known): (Vec<Vec<usize>>, HashMap<&str, usize>) = (Vec::new(), HashMap::new());
        for (place, case) in self.pending.iter().enumerate() {
            match case.intact.as_deref().and_then(|intact| known.get(intact)) {
                Some(group) => groups.get_mut(*group).into_iter().for_each(|group| group.push(place)),
                None => {
                    known.insert(&case.name, groups.len());
                    groups.push(vec![place]);
                }
            }
        }
        groups
    }

    /// Runs some of the pending cases, by their places, and the intact ones that they follow; they are then pending no more, and their records are among those of the study.
    ///
    /// # Errors
    /// Files that cannot be written; the cases that are done stay done.
    pub fn run_sample(
        &mut self,
        places: &[usize],
        plan: &StudyPlan,
        files: &dyn Files,
        runner: &dyn RunCase,
        stop: &AtomicBool,
        told: &(dyn Fn(Progress) + Sync),
    ) -> Result<(), StudyError> {
        let mut names: HashSet<&str> = HashSet::new();
        for case in places.iter().filter_map(|place| self.pending.get(*place)) {
            names.insert(&case.name);
            names.extend(case.intact.as_deref());
        }
        let sample: Vec<&Case> = self.pending.iter().copied().filter(|c| names.contains(c.name.as_str())).collect();
        let followed = Followed::new(&sample, self.intact_records(&sample).into_iter());
        let governing = std::mem::take(&mut self.governing);
        self.end.progress = run_here(plan, (self.start, sample, followed), governing, files, runner, stop, told)?;
        self.records = Study::open(&plan.folder)?.records;
        let of_start = self.records.iter().filter(|record| record.start() == self.start);
        let done: HashSet<&str> = of_start.map(|record| record.case()).collect();
        self.pending.retain(|case| !done.contains(case.name.as_str()));
        Ok(())
    }
}

/// Runs cases of a start in this process, and drops the folders that are not kept.
fn run_here(
    plan: &StudyPlan,
    (start, pending, followed): (u64, Vec<&Case>, Followed),
    governing: Governing,
    files: &dyn Files,
    runner: &dyn RunCase,
    stop: &AtomicBool,
    told: &(dyn Fn(Progress) + Sync),
) -> Result<Progress, StudyError> {
    let lanes = (0..plan.jobs.clamp(1, pending.len().max(1))).map(|worker| Lane {
        results: Arc::new(ResultsFile::new(results_file(&plan.folder, worker))),
        running: plan.folder.join(format!(".running-{worker}")),
    });
    let batch = Batch {
        columns: &plan.table.columns,
        lanes: lanes.collect(),
        keep: plan.keep,
        kept_cases: plan.folder.join(KEPT_CASES),
        max_failed: MAX_FAILED_FOLDERS,
        version: &plan.version,
        pending,
        followed,
        start,
        files,
        runner,
        stop,
        told,
    };
    let progress = batch.run(governing)?;
    let study = Study::open(&plan.folder)?;
    drop_stray_folders(&plan.folder, &keepers(&study, plan.keep), files)?;
    Ok(progress)
}

/// Which of the cases of a study keep the folder of their answers.
pub(crate) fn keepers(study: &Study, keep: Keep) -> HashSet<&str> {
    let mut governing = Governing::default();
    if keep == Keep::Governing {
        study.records.iter().for_each(|record| governing.offer_view(record));
    }
    let mut failed = 0;
    let stays = |record: &RecordView| {
        if record.status() == CaseStatus::Failed {
            failed += 1;
            if failed > MAX_FAILED_FOLDERS && keep != Keep::Everything {
                return false;
            }
        }
        keeps(keep, record.status(), governing.governs(record.case()))
    };
    study.records.iter().filter(stays).map(|record| record.case()).collect()
}

/// Drops kept folders of cases that no longer keep theirs: of another table, and of what was stopped between a folder and its record.
pub(crate) fn drop_stray_folders(folder: &Path, stays: &HashSet<&str>, files: &dyn Files) -> Result<(), StudyError> {
    let kept_cases = folder.join(KEPT_CASES);
    for entry in std::fs::read_dir(&kept_cases).map_err(StudyError::of(&kept_cases))? {
        let entry = entry.map_err(StudyError::of(&kept_cases))?;
        if !stays.contains(entry.file_name().to_string_lossy().as_ref()) {
            let path = entry.path();
            files.remove_folder(&path).map_err(StudyError::of(&path))?;
        }
    }
    Ok(())
}

/// Whether a case keeps the folder of its answers.
fn keeps(keep: Keep, status: CaseStatus, governs: bool) -> bool {
    let failed = status == CaseStatus::Failed;
    match keep {
        Keep::Nothing => false,
        Keep::Failed => failed,
        Keep::Governing => failed || governs,
        Keep::Everything => true,
    }
}

/// Why a finished case has to be run again; the files it has read are not looked at where they are known to be the same.
fn reason_to_run_again(
    plan: &StudyPlan,
    case: &Case,
    record: &RecordView,
    (runner, has_read_the_same): (&dyn RunCase, bool),
) -> Option<String> {
    let values = plan.table.columns.iter().map(String::as_str).zip(case.values.iter().map(String::as_str));
    if record.status() == CaseStatus::Failed && plan.retry_failed {
        return Some("it failed".into());
    }
    if !values.eq(record.values()) {
        return Some("its row has changed".into());
    }
    if record.seed() != case.seed {
        return Some("its seed has changed".into());
    }
    if record.version() != plan.version {
        return Some(format!("it is of version {}", record.version()));
    }
    let changed = || record.read().iter().find(|read| !runner.is_unchanged(read));
    if let Some(changed) = (!has_read_the_same).then(changed).flatten() {
        return Some(format!("{} has changed", changed.path));
    }
    let has_peaks = |line: &&String| record.peaks().iter().any(|peaks| peaks.line.eq_ignore_ascii_case(line));
    let line = case.peaks_of.iter().find(|line| !has_peaks(line)).filter(|_| record.status() != CaseStatus::Failed)?;
    Some(format!("it has kept no peaks of {line}, which a transient case loses"))
}

/// Runs a case, a transient one when the intact case that it follows has ended; `None` where it was interrupted, or that case was.
fn run_case(shared: &Shared, case: &Case, running: &Path) -> Option<CaseRecord> {
    let Batch { columns, runner, followed, stop, version, .. } = shared.batch;
    let Some(name) = &case.intact else { return runner.run(case, columns, running, None) };
    let intact = followed.wait(name, stop)?;
    if intact.status != CaseStatus::Failed {
        return runner.run(case, columns, running, Some(&intact));
    }
    Some(CaseRecord {
        case: case.name.clone(),
        values: columns.iter().cloned().zip(case.values.iter().cloned()).collect(),
        seed: case.seed,
        status: CaseStatus::Failed,
        reason: format!("its intact case {name} has failed: {}", intact.reason),
        version: (*version).to_owned(),
        intact: Some(intact.followed()),
        ..CaseRecord::default()
    })
}

/// One of the workers.
fn work(shared: &Shared, lane: &Lane) -> Result<(), StudyError> {
    let Batch { files, .. } = shared.batch;
    let Lane { results, running } = lane;
    while !shared.batch.stop.load(Ordering::Relaxed) {
        let Some(case) = shared.batch.pending.get(shared.next.fetch_add(1, Ordering::Relaxed)) else { break };
        files.remove_folder(running).map_err(StudyError::of(running))?;
        files.make_folder(running).map_err(StudyError::of(running))?;
        let made = run_case(shared, case, running);
        shared.batch.followed.end(case, || made.clone());
        let Some(mut record) = made else {
            if case.intact.is_some() && !shared.batch.stop.load(Ordering::Relaxed) {
                continue;
            }
            break;
        };
        record.start = shared.batch.start;
        let line = record.encode().map_err(|error| StudyError::of(&results.path)(error.into()))?;
        // the folder first: a record says that all of its case is there
        keep_folder(shared, &record, running)?;
        results.append(&line, *files)?;
        if let Ok(mut state) = shared.state.lock() {
            state.1.finished += 1;
            state.1.failed += usize::from(record.status == CaseStatus::Failed);
            (shared.batch.told)(state.1);
        }
    }
    results.sync(*files)?;
    files.remove_folder(running).map_err(StudyError::of(running))
}

/// Keeps the folder of a case, or not, and drops those of cases that govern no more.
fn keep_folder(shared: &Shared, record: &CaseRecord, running: &Path) -> Result<(), StudyError> {
    let Batch { keep, kept_cases, max_failed, files, .. } = shared.batch;
    let mut state = shared.state.lock().unwrap_or_else(PoisonError::into_inner);
    let (governs, gone) = state.0.offer(record);
    let too_many = record.status == CaseStatus::Failed && state.1.failed >= *max_failed;
    if (*keep == Keep::Everything || !too_many) && keeps(*keep, record.status, governs) {
        let to = kept_cases.join(&record.case);
        files.move_folder(running, &to).map_err(StudyError::of(&to))?;
    }
    if *keep == Keep::Governing {
        for case in gone {
            let path = kept_cases.join(&case);
            files.remove_folder(&path).map_err(StudyError::of(&path))?;
        }
    }
    Ok(())
}
