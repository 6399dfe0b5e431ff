//! A case as a process of its own: what the study gives it, and what it gives back.

use super::peaks::line_peaks;
use crate::commands::{IntactRun, Job, check_damaged_start};
use crate::report::files::{JobFolder, open_regular};
use crate::report::output::Output;
use crate::session::{Session, read_text};
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};
use std::collections::HashMap;
use std::io::{Read, Write};
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Mutex;
use std::time::Instant;
use windlass_base::diagnostic::Severity;
use windlass_base::units::Dim;
use windlass_connectors::has_rope_stiffness;
use windlass_study::kept::{KeptResult, LineRow, MooringCondition};
use windlass_study::lost::{CONDITION, LOST, LostLines};
use windlass_study::record::{CaseRecord, CaseStatus, FileRead, LinePeaks};
use windlass_study::runner::RunCase;
use windlass_study::table::{Case, SEED};

/// Most messages that are kept of a case.
const MOST_MESSAGES: usize = 50;
/// The word that makes the program run one case.
pub const CASE_COMMAND: &str = "study-case";

/// What a case is given, on its standard input.
#[derive(Serialize, Deserialize)]
struct CaseInput {
    model: PathBuf,
    folder: PathBuf,
    variables: Vec<(String, String)>,
    /// The condition that the row says, of a table with lines lost, and these lines.
    lost: Option<(MooringCondition, Vec<String>)>,
    /// The stiffness of fibre ropes, as `&PARAMETER -STIFFNESS` has it.
    stiffness: Option<String>,
    /// Lines whose peaks are to be kept.
    peaks_of: Vec<String>,
    /// Peaks of the intact case that a transient one follows, which instant of these it is run with, and the folders of those before.
    intact: Option<(Vec<LinePeaks>, usize, Vec<PathBuf>)>,
}

/// What a case gives back, on its standard output.
#[derive(Serialize, Deserialize)]
struct CaseOutput {
    interrupted: bool,
    over_break: bool,
    error: Option<String>,
    title: String,
    units: Option<(String, String)>,
    messages: Vec<String>,
    caveats: Vec<String>,
    results: Vec<KeptResult>,
    lines: Vec<LineRow>,
    read: Vec<PathBuf>,
    peaks: Vec<LinePeaks>,
    /// How many instants of a loss there are.
    instants: usize,
}

/// The program that runs one case when [`CASE_COMMAND`] stands behind its arguments.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct CaseProgram {
    /// The file of the program.
    pub file: PathBuf,
    /// What stands before [`CASE_COMMAND`].
    pub arguments: Vec<String>,
}

impl CaseProgram {
    /// This program itself.
    ///
    /// # Errors
    /// What the system says of the program's own file.
    pub fn of_this_process() -> std::io::Result<Self> {
        Ok(CaseProgram { file: std::env::current_exe()?, arguments: Vec::new() })
    }
}

/// Runs cases as processes of a program.
pub struct Processes {
    program: CaseProgram,
    model: PathBuf,
    begun_in: Option<PathBuf>,
    threads: usize,
    hashes: Mutex<HashMap<PathBuf, Option<(u64, String)>>>,
}

impl Processes {
    /// Processes over a script, each with so many threads; of this program, where no other is given.
    ///
    /// # Errors
    /// What the system says of the program's own file.
    pub fn new(model: &Path, threads: usize, program: Option<&CaseProgram>) -> std::io::Result<Self> {
        let program = program.map_or_else(CaseProgram::of_this_process, |program| Ok(program.clone()))?;
        Ok(Processes { program, model: model.to_path_buf(), begun_in: None, threads, hashes: Mutex::default() })
    }

    /// The same with files named from another folder than the present one, where that is there.
    pub fn begun_in(mut self, folder: &str) -> Self {
        self.begun_in = Some(PathBuf::from(folder)).filter(|folder| folder.is_absolute() && folder.is_dir());
        self
    }

    /// Size and hash of a file, found once in a study; none of one that cannot be read.
    fn hash(&self, path: &Path) -> Option<(u64, String)> {
        if let Ok(known) = self.hashes.lock()
            && let Some(found) = known.get(path)
        {
            return found.clone();
        }
        let found = match &self.begun_in {
            Some(folder) => hash_file(&folder.join(path)).ok(),
            None => hash_file(path).ok(),
        };
        if let Ok(mut known) = self.hashes.lock() {
            known.insert(path.to_path_buf(), found.clone());
        }
        found
    }

    fn start(&self, input: &CaseInput) -> std::io::Result<std::process::Output> {
        let mut command = Command::new(&self.program.file);
        if let Some(folder) = &self.begun_in {
            command.current_dir(folder);
        }
        let mut child = command
            .args(&self.program.arguments)
            .arg(CASE_COMMAND)
            .env("RAYON_NUM_THREADS", self.threads.to_string())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()?;
        let text = serde_json::to_vec(input)?;
        if let Some(mut to) = child.stdin.take() {
            // a process that is gone says why by how it ended
            let _ = to.write_all(&text);
        }
        child.wait_with_output()
    }
}

impl Processes {
    /// The record of a case of which nothing is known yet.
    fn blank(&self, case: &Case, columns: &[String]) -> CaseRecord {
        CaseRecord {
            case: case.name.clone(),
            values: columns.iter().cloned().zip(case.values.iter().cloned()).collect(),
            seed: case.seed,
            version: env!("CARGO_PKG_VERSION").to_owned(),
            ..CaseRecord::default()
        }
    }

    /// Runs a case as a process, a transient one with an instant of its intact case; its record, and how many instants there are.
    fn run_process(
        &self,
        case: &Case,
        columns: &[String],
        folder: &Path,
        intact: Option<(&CaseRecord, usize)>,
    ) -> Option<(CaseRecord, usize)> {
        let since = Instant::now();
        let mut record = self.blank(case, columns);
        let own = [SEED, LOST, CONDITION];
        let is_plain = |name: &str| !own.iter().any(|known| name.eq_ignore_ascii_case(known));
        let mut variables = vec![("CASE".to_owned(), case.name.clone())];
        variables.extend(record.values.iter().filter(|(name, _)| is_plain(name)).cloned());
        variables.push(("SEED".to_owned(), case.seed.to_string()));
        if let Some(lost) = &case.lost {
            variables.push((LOST.to_ascii_uppercase(), lost.variable()));
            variables.push((CONDITION.to_ascii_uppercase(), lost.condition.word().to_ascii_uppercase()));
        }
        let input = CaseInput {
            model: self.model.clone(),
            folder: folder.to_path_buf(),
            variables,
            lost: case.lost.as_ref().map(|lost| (lost.condition, lost.lines.clone())),
            stiffness: case.stiffness.map(|stiffness| stiffness.word().to_ascii_uppercase()),
            peaks_of: case.peaks_of.clone(),
            intact: intact.map(|(record, instant)| {
                let earlier = (1..=instant).map(|number| folder.with_file_name(instant_folder(number))).collect();
                (record.peaks.clone(), instant, earlier)
            }),
        };
        let ended = self.start(&input);
        record.seconds = since.elapsed().as_secs_f64();
        let ended = match ended {
            Ok(ended) => ended,
            Err(error) => {
                record.reason = format!("no process can be started: {error}");
                return Some((record, 0));
            }
        };
        let Ok(output) = serde_json::from_slice::<CaseOutput>(&ended.stdout) else {
            let said = String::from_utf8_lossy(&ended.stderr);
            let last = said.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it said nothing");
            record.reason = format!("its process ended without results ({}): {last}", ended.status);
            return Some((record, 0));
        };
        if output.interrupted {
            return None;
        }
        let error = output.error.or_else(|| case.lost.as_ref().and_then(|lost| other_lines_lost(lost, &output.lines)));
        record.status = match (&error, output.over_break) {
            (Some(_), _) => CaseStatus::Failed,
            (None, true) => CaseStatus::Overloaded,
            (None, false) => CaseStatus::Done,
        };
        record.reason = error.unwrap_or_default();
        (record.title, record.units) = (output.title, output.units);
        (record.messages, record.caveats) = (output.messages, output.caveats);
        (record.results, record.lines, record.peaks) = (output.results, output.lines, output.peaks);
        for path in output.read {
            let (size, hash) = self.hash(&path).unwrap_or_default();
            record.read.push(FileRead { path: path.display().to_string(), size, hash });
        }
        Some((record, output.instants))
    }
}

/// What is wrong where the checks of a case are of another condition, or without other lines, than its row says.
fn other_lines_lost(row: &LostLines, checked: &[LineRow]) -> Option<String> {
    let names = |lines: &[String]| if lines.is_empty() { "no line".to_owned() } else { lines.join(" and ") };
    let same = |a: &[String], b: &[String]| {
        let within = |a: &[String], b: &[String]| a.iter().all(|x| b.iter().any(|y| x.eq_ignore_ascii_case(y)));
        within(a, b) && within(b, a)
    };
    let other = checked.iter().find(|line| line.condition != row.condition || !same(&line.lost, &row.lines))?;
    Some(format!(
        "the row is {} with {} lost, and CODE_CHECK found the mooring {} with {} lost",
        row.condition.word(),
        names(&row.lines),
        other.condition.word(),
        names(&other.lost)
    ))
}

/// The record of a case that was run with several instants of a loss: of each result the largest, of each row of a segment the most
/// severe.
fn join_instants(mut known: CaseRecord, more: CaseRecord) -> CaseRecord {
    if more.status == CaseStatus::Failed {
        (known.status, known.reason) = (more.status, more.reason);
    } else if more.status == CaseStatus::Overloaded {
        known.status = more.status;
    }
    known.seconds += more.seconds;
    for result in more.results {
        match known.results.iter_mut().find(|other| other.name.eq_ignore_ascii_case(&result.name)) {
            Some(other) => other.take_extreme(&result),
            None => known.results.push(result),
        }
    }
    for row in more.lines {
        match known.lines.iter_mut().find(|other| other.line == row.line && other.segment == row.segment) {
            Some(other) => other.take_severer(row),
            None => known.lines.push(row),
        }
    }
    for (list, more) in [(&mut known.messages, more.messages), (&mut known.caveats, more.caveats)] {
        for text in more {
            if !list.contains(&text) {
                list.push(text);
            }
        }
    }
    for file in more.read {
        if !known.read.contains(&file) {
            known.read.push(file);
        }
    }
    known
}

/// The folder of an instant of a transient case, from 1, in that of the case.
fn instant_folder(number: usize) -> String {
    format!("instant-{number}")
}

/// Moves the answers of the instant with the most severe row to the top of the folder of a case; those of the others stay in folders of
/// their own.
fn raise_governing(record: &CaseRecord, folder: &Path) -> std::io::Result<()> {
    let severity = |row: &&LineRow| row.severity().map_or(f64::NEG_INFINITY, |(_, value)| value);
    let governing = record.lines.iter().max_by(|a, b| severity(a).total_cmp(&severity(b)));
    let number = governing.and_then(|row| row.loss.as_ref()).map_or(1, |loss| loss.number);
    let own = folder.join(instant_folder(number));
    if !own.is_dir() {
        return Ok(());
    }
    for entry in std::fs::read_dir(&own)? {
        let entry = entry?;
        std::fs::rename(entry.path(), folder.join(entry.file_name()))?;
    }
    std::fs::remove_dir(&own)
}

/// Size and SHA-256 of a file.
fn hash_file(path: &Path) -> std::io::Result<(u64, String)> {
    let mut file = open_regular(path)?;
    let (mut hasher, mut room, mut size) = (Sha256::new(), vec![0; 1 << 16], 0);
    loop {
        let read = file.read(&mut room)?;
        if read == 0 {
            break;
        }
        size += read as u64;
        hasher.update(room.get(..read).unwrap_or_default());
    }
    let digits = hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect();
    Ok((size, digits))
}

impl RunCase for Processes {
    fn run(&self, case: &Case, columns: &[String], folder: &Path, intact: Option<&CaseRecord>) -> Option<CaseRecord> {
        let Some(intact) = intact else {
            return self.run_process(case, columns, folder, None).map(|(record, _)| record);
        };
        let mut all: Option<CaseRecord> = None;
        let (mut instant, mut count) = (0, 1);
        while instant < count {
            // each with a folder of its own; that of the governing one goes to the top
            let own = folder.join(instant_folder(instant + 1));
            let made =
                std::fs::create_dir_all(&own).map(|()| self.run_process(case, columns, &own, Some((intact, instant))));
            let (record, instants) = match made {
                Ok(made) => made?,
                Err(error) => {
                    let reason = format!("{}: {error}", own.display());
                    (CaseRecord { reason, ..self.blank(case, columns) }, 0)
                }
            };
            count = instants;
            let mut whole = match all.take() {
                Some(known) => join_instants(known, record),
                None => record,
            };
            whole.intact = Some(intact.followed());
            let failed = whole.status == CaseStatus::Failed;
            all = Some(whole);
            if failed {
                break;
            }
            instant += 1;
        }
        let mut record = all?;
        if let Err(error) = raise_governing(&record, folder) {
            (record.status, record.reason) = (CaseStatus::Failed, format!("{}: {error}", folder.display()));
        }
        Some(record)
    }

    fn is_unchanged(&self, read: &FileRead) -> bool {
        self.hash(Path::new(&read.path)).is_some_and(|(size, hash)| size == read.size && hash == read.hash)
    }
}

/// Whether the last run of a case is what its row says.
///
/// # Errors
/// What it is not: a transient run that loses no line, a damaged one that does not begin at rest without its lines.
fn wrong_run(job: &Job, condition: MooringCondition, lines: &[String]) -> Result<(), String> {
    match (condition, &job.run) {
        (MooringCondition::Transient, _) if job.line_loss.is_none() => {
            Err("the row is transient, and no run lost its lines: TDOM -LOSE %LOST%".to_owned())
        }
        (MooringCondition::Damaged, Some(run)) => check_damaged_start(job, run, lines),
        _ => Ok(()),
    }
}

/// Runs the case that standard input describes, and prints what came of it; the exit code.
pub fn run_one(input: impl Read, mut output: impl Write) -> u8 {
    let Ok(input) = serde_json::from_reader::<_, CaseInput>(input) else { return 2 };
    let name = input.model.display().to_string();
    let mut made = CaseOutput {
        interrupted: false,
        over_break: false,
        error: None,
        title: String::new(),
        units: None,
        messages: Vec::new(),
        caveats: Vec::new(),
        results: Vec::new(),
        lines: Vec::new(),
        read: Vec::new(),
        peaks: Vec::new(),
        instants: 0,
    };
    match read_text(&input.model) {
        Err(error) => made.error = Some(error.to_string()),
        Ok(text) => {
            let folder = JobFolder::new(input.model.with_extension(""), Some(input.folder), false);
            let out = Output::new(folder, Box::new(std::io::sink()), Box::new(std::io::sink()), false);
            let mut session = Session::new(out);
            session.keep_reports = true;
            session.job.output.folder.note_reading(&input.model);
            let running = std::sync::Arc::clone(&session.interpreter.interrupt);
            let _ = ctrlc::set_handler(move || running.store(true, std::sync::atomic::Ordering::Relaxed));
            for (name, value) in &input.variables {
                if let Err(error) = session.interpreter.variables.set(name, value) {
                    made.error.get_or_insert_with(|| format!("{name}: {error}"));
                }
            }
            session.job.intact_run =
                input.intact.map(|(peaks, instant, earlier)| IntactRun { peaks, instant, earlier });
            session.open_job(&name, text);
            if let Some(word) = &input.stiffness {
                // before the script, and one of the records that make the model of a kept run
                session.open("the column stiffness", format!("&PARAMETER -STIFFNESS {word}\n"));
            }
            session.run();
            session.finish();
            session.job.output.flush();
            made.interrupted = session.interpreter.was_interrupted;
            let verdict = &session.job.verdict;
            made.over_break = !verdict.over_break.is_empty();
            let sources = &session.interpreter.sources;
            for report in &session.reports {
                let place = report.span.map(|span| format!("{}: ", sources.location(span))).unwrap_or_default();
                let text = format!("{place}{}", report.message);
                let kind = match report.severity {
                    Severity::Fatal | Severity::Error => {
                        made.error.get_or_insert_with(|| text.clone());
                        "error"
                    }
                    Severity::Warning => "warning",
                    _ => continue,
                };
                if made.messages.len() < MOST_MESSAGES {
                    made.messages.push(format!("{kind}: {text}"));
                }
            }
            if let Some((condition, lines)) = &input.lost
                && made.error.is_none()
            {
                made.error = wrong_run(&session.job, *condition, lines).err();
            }
            let has_rope =
                || session.job.model.classes.values().any(|class| class.records.iter().any(has_rope_stiffness));
            if input.stiffness.is_some() && !has_rope() {
                made.error.get_or_insert_with(|| {
                    "the column stiffness acts on fibre rope, and no class of the model has -EA_BOUNDS or -ROPE"
                        .to_owned()
                });
            }
            if verdict.absent > 0 {
                made.error.get_or_insert_with(|| "a result that was asked for does not exist".to_owned());
            }
            let units = session.job.units;
            made.title = session.job.titles.first().cloned().unwrap_or_default();
            made.units = Some((Dim::Length.label(units), Dim::Force.label(units)));
            made.caveats = session.job.run.as_ref().map_or(&session.job.model, |run| &run.model).caveats();
            made.results = session.job.kept.results().to_vec();
            made.lines = std::mem::take(&mut session.job.kept.lines);
            made.read = session.job.output.folder.files_read();
            made.peaks = line_peaks(session.job.run.as_ref(), &session.job.model, &input.peaks_of);
            made.instants = session.job.line_loss.as_ref().map_or(0, |loss| loss.count);
        }
    }
    let written = serde_json::to_writer(&mut output, &made).is_ok() && output.flush().is_ok();
    u8::from(!written)
}
