//! The check of a text as one types: the checking mode of `windlass check` on what the editor holds, on a thread of its own.
//!
//! Nothing is solved or written, and files are read below the folder of the script alone, as `windlass check` does it.

use crate::assist::Known;
use crate::report::files::JobFolder;
use crate::report::output::Output;
use crate::session::{CheckedRecord, Judgement, Session, UnsavedTexts};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::{SourceId, Span};
use windlass_base::units::UnitSystem;
use windlass_language::source::Text;

/// Longest text that is checked as one types (bytes).
pub const LONGEST_CHECKED: usize = 8 << 20;
/// Most messages kept of a check.
const MAX_FOUND: usize = 1000;
/// Stack of the thread that checks (bytes).
const STACK: usize = 32 << 20;

/// A script or deck to check, with all that the editor holds.
#[derive(Clone, Debug)]
pub struct CheckTask {
    /// The file that the job begins with.
    pub root: PathBuf,
    /// Its text.
    pub text: Arc<str>,
    /// The texts that the editor holds, with their versions.
    pub held: BTreeMap<PathBuf, (i64, Arc<str>)>,
}

/// Something that a check says of a place.
#[derive(Clone, Debug)]
pub struct Found {
    /// The file, as an index of [`Analysis::sources`].
    pub source: usize,
    /// What is said, with its span in that file.
    pub said: Diagnostic,
    /// The file of the other place, where there is one.
    pub other: Option<usize>,
}

/// What a check has found.
#[derive(Default)]
pub struct Analysis {
    /// The file that the job begins with.
    pub root: PathBuf,
    /// The files that were read as records, with their texts; the job's first.
    pub sources: Vec<(PathBuf, Arc<str>)>,
    /// The versions of those that the editor held.
    pub versions: BTreeMap<PathBuf, i64>,
    /// What is said.
    pub found: Vec<Found>,
    /// The records that were met, each with the index of its file.
    pub records: Vec<(usize, CheckedRecord)>,
    /// The names known at the end.
    pub known: Known,
    /// The units in force at the end.
    pub units: UnitSystem,
}

impl Analysis {
    /// The index of a file.
    pub fn source_of(&self, path: &Path) -> Option<usize> {
        self.sources.iter().position(|(own, _)| own == path)
    }
}

/// A check under way.
#[derive(Debug, Default)]
pub struct RunningCheck {
    /// Set, the session ends at its next record.
    interrupt: Arc<AtomicBool>,
    abandoned: Arc<AtomicBool>,
}

impl RunningCheck {
    /// Starts a check; `done` takes what it has found, or `None` where it was abandoned. `None` where the system gives no thread.
    pub fn start(task: CheckTask, done: impl FnOnce(Option<Analysis>) + Send + 'static) -> Option<RunningCheck> {
        let running = RunningCheck::default();
        let (interrupt, abandoned) = (Arc::clone(&running.interrupt), Arc::clone(&running.abandoned));
        let work = move || {
            let checked = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| check(&task, &interrupt)));
            // a defect in a check is no reason to leave the editor
            let analysis = checked.unwrap_or_else(|_| Analysis { root: task.root.clone(), ..Analysis::default() });
            done((!abandoned.load(Ordering::Relaxed)).then_some(analysis));
        };
        let thread = std::thread::Builder::new().name("check".into()).stack_size(STACK).spawn(work);
        thread.is_ok().then_some(running)
    }

    /// Ends it at the next record; nothing of it is wanted.
    pub fn abandon(&self) {
        self.abandoned.store(true, Ordering::Relaxed);
        self.interrupt.store(true, Ordering::Relaxed);
    }
}

/// Checks a script or a deck; it ends at the next record when `interrupt` is set.
pub fn check(task: &CheckTask, interrupt: &Arc<AtomicBool>) -> Analysis {
    let mut analysis = Analysis { root: task.root.clone(), ..Analysis::default() };
    if task.text.len() > LONGEST_CHECKED {
        let text = format!(
            "the text has {} bytes, and is not checked as one types: at most {LONGEST_CHECKED}; windlass check reads it",
            task.text.len()
        );
        analysis.versions.extend(task.held.get(&task.root).map(|(version, _)| (task.root.clone(), *version)));
        analysis.sources.push((task.root.clone(), Arc::clone(&task.text)));
        let said = *Diagnostic::remark(text, Span::new(SourceId::default(), 0, 0));
        analysis.found.push(Found { source: 0, said, other: None });
        return analysis;
    }
    let folder = JobFolder::new(task.root.with_extension(""), None, false);
    let output = Output::new(folder, Box::new(std::io::sink()), Box::new(std::io::sink()), false);
    let mut session = Session::new(output);
    session.interpreter.interrupt = Arc::clone(interrupt);
    session.job.interrupt = Arc::clone(interrupt);
    session.job.model.interrupt = Arc::clone(interrupt);
    session.job.output.keep_log = false;
    session.keep_reports = true;
    let texts = task.held.iter().map(|(path, (_, text))| (path.clone(), Text::from(text.to_string())));
    session.unsaved = UnsavedTexts::new(texts.collect());
    session.start_check();
    session.keep_checked_records();
    let ends = Arc::clone(interrupt);
    let watch = session.watch_check(move |_| ends.store(true, Ordering::Relaxed));
    session.open_to_check(&task.root.display().to_string(), &task.root, Text::from(task.text.to_string()));
    session.run();
    drop(watch);
    collect(&mut session, task, &mut analysis);
    analysis
}

/// Takes what a check has found out of its session.
fn collect(session: &mut Session, task: &CheckTask, analysis: &mut Analysis) {
    let mut indices: BTreeMap<usize, usize> = BTreeMap::new();
    for (id, path) in &session.source_files {
        let Some(source) = session.interpreter.sources.get(*id) else { continue };
        let path = path.canonicalize().unwrap_or_else(|_| path.clone());
        let index = analysis.source_of(&path).unwrap_or_else(|| {
            analysis.versions.extend(task.held.get(&path).map(|(version, _)| (path.clone(), *version)));
            analysis.sources.push((path, Arc::clone(&source.text)));
            analysis.sources.len() - 1
        });
        indices.insert(id.index(), index);
    }
    let index_of = |span: Span| indices.get(&span.source.index()).copied();
    let (records, listed, ended) = session.end_of_check();
    // that its time was over is said by the report of the check
    let reports = session.reports.drain(..).filter(|said| said.message != "interrupted");
    for said in reports.take(MAX_FOUND) {
        let other = said.other.as_ref().and_then(|(span, _)| index_of(*span));
        match said.span {
            Some(span) => analysis.found.extend(index_of(span).map(|source| Found { source, said, other })),
            // of the text as a whole
            None => analysis.found.push(Found { source: 0, said, other }),
        }
    }
    for record in listed.into_iter().take(MAX_FOUND) {
        let severity = match record.judgement {
            Judgement::Stops => Severity::Warning,
            Judgement::Noted => Severity::Note,
            _ => continue,
        };
        let text = match severity {
            Severity::Note => format!("changes nothing: {}", record.said),
            _ => format!("the next solve that it matters to stops: {}", record.said),
        };
        let mut said = Diagnostic::plain(severity, text);
        said.span = Some(record.span);
        analysis.found.extend(index_of(record.span).map(|source| Found { source, said, other: None }));
    }
    if let Some(why) = ended {
        let last = records.iter().rev().find(|record| index_of(record.span) == Some(0));
        let mut said = Diagnostic::plain(Severity::Note, format!("{why}: what follows is not checked"));
        said.span = last.map(|record| record.span);
        analysis.found.push(Found { source: 0, said, other: None });
    }
    analysis.records = records.iter().filter_map(|record| Some((index_of(record.span)?, *record))).collect();
    analysis.known.update(session);
    analysis.units = session.job.units;
}
