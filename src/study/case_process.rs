//! A case as a process of its own: what the study gives it, and what it gives back.

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
use windlass_study::kept::{KeptResult, LineRow};
use windlass_study::record::{CaseRecord, CaseStatus, FileRead};
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
        Ok(Processes { program, model: model.to_path_buf(), threads, hashes: Mutex::default() })
    }

    /// Size and hash of a file, found once in a study; none of one that cannot be read.
    fn hash(&self, path: &Path) -> Option<(u64, String)> {
        if let Ok(known) = self.hashes.lock()
            && let Some(found) = known.get(path)
        {
            return found.clone();
        }
        let found = hash_file(path).ok();
        if let Ok(mut known) = self.hashes.lock() {
            known.insert(path.to_path_buf(), found.clone());
        }
        found
    }

    fn start(&self, input: &CaseInput) -> std::io::Result<std::process::Output> {
        let mut child = Command::new(&self.program.file)
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
    fn run(&self, case: &Case, columns: &[String], folder: &Path) -> Option<CaseRecord> {
        let since = Instant::now();
        let values: Vec<(String, String)> = columns.iter().cloned().zip(case.values.iter().cloned()).collect();
        let mut variables = vec![("CASE".to_owned(), case.name.clone())];
        variables.extend(values.iter().filter(|(name, _)| !name.eq_ignore_ascii_case(SEED)).cloned());
        variables.push(("SEED".to_owned(), case.seed.to_string()));
        let input = CaseInput { model: self.model.clone(), folder: folder.to_path_buf(), variables };
        let mut record = CaseRecord {
            case: case.name.clone(),
            values,
            seed: case.seed,
            status: CaseStatus::Failed,
            reason: String::new(),
            title: String::new(),
            units: None,
            seconds: 0.0,
            messages: Vec::new(),
            caveats: Vec::new(),
            results: Vec::new(),
            lines: Vec::new(),
            read: Vec::new(),
            version: env!("CARGO_PKG_VERSION").to_owned(),
            start: 0,
        };
        let ended = self.start(&input);
        record.seconds = since.elapsed().as_secs_f64();
        let ended = match ended {
            Ok(ended) => ended,
            Err(error) => {
                record.reason = format!("no process can be started: {error}");
                return Some(record);
            }
        };
        let Ok(output) = serde_json::from_slice::<CaseOutput>(&ended.stdout) else {
            let said = String::from_utf8_lossy(&ended.stderr);
            let last = said.lines().rev().find(|line| !line.trim().is_empty()).unwrap_or("it said nothing");
            record.reason = format!("its process ended without results ({}): {last}", ended.status);
            return Some(record);
        };
        if output.interrupted {
            return None;
        }
        record.status = match (&output.error, output.over_break) {
            (Some(_), _) => CaseStatus::Failed,
            (None, true) => CaseStatus::Overloaded,
            (None, false) => CaseStatus::Done,
        };
        record.reason = output.error.unwrap_or_default();
        (record.title, record.units) = (output.title, output.units);
        (record.messages, record.caveats) = (output.messages, output.caveats);
        (record.results, record.lines) = (output.results, output.lines);
        for path in output.read {
            let (size, hash) = self.hash(&path).unwrap_or_default();
            record.read.push(FileRead { path: path.display().to_string(), size, hash });
        }
        Some(record)
    }

    fn is_unchanged(&self, read: &FileRead) -> bool {
        self.hash(Path::new(&read.path)).is_some_and(|(size, hash)| size == read.size && hash == read.hash)
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
            session.open_job(&name, text);
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
        }
    }
    let written = serde_json::to_writer(&mut output, &made).is_ok() && output.flush().is_ok();
    u8::from(!written)
}
