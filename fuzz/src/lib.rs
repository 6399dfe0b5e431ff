//! What is done with bytes that nobody has looked at: one function a target of cargo-fuzz. `tests/it/program/fuzz_corpus.rs` calls the same
//! functions with the corpus and with changed pieces of it.
//!
//! A target panics where windlass would: on a panic of its own, and on a message that tells of a defect. Refusals are right answers.

// the test of the program includes this file
#![allow(clippy::unwrap_used, clippy::expect_used)]

use std::collections::HashSet;
use std::hash::{BuildHasher, BuildHasherDefault, DefaultHasher};
use std::io::{Cursor, sink};
use std::sync::atomic::Ordering;
use std::sync::mpsc::{RecvTimeoutError, channel};
use std::sync::{LazyLock, Mutex, OnceLock};
use std::time::Duration;
use windlass::commands::{COMMANDS, Job, internal_names};
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::report::run_log;
use windlass::session::Session;
use windlass_base::diagnostic::Diagnostic;
use windlass_base::span::Span;
use windlass_base::units::UnitSystem;
use windlass_connectors::CLASSES;
use windlass_hydro::database::rao::{self, RaoConvention};
use windlass_hydro::database::wamit::{self, WamitScale};
use windlass_hydro::database::{SourceFile, capytaine, nemoh};
use windlass_hydro::hull::{MeshKind, read_mesh};
use windlass_language::args;
use windlass_language::flow::{FlowStep, Interpreter};
use windlass_language::record::Record;
use windlass_language::source::{Sources, Text, floor_boundary};
use windlass_language::token::TokenKind;
use windlass_solve::time::Snapshot;

/// Records a script may execute: the loops of one input are not run for long.
const RECORDS: u64 = 300;
/// Longest time of a script.
const LONGEST: Duration = Duration::from_secs(1);

/// The job's folder of all inputs of this process; what a script writes stays in it.
fn output() -> Output {
    static FOLDER: OnceLock<tempfile::TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| tempfile::tempdir().expect("a folder for temporary files"));
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut output = Output::new(job, Box::new(sink()), Box::new(sink()), false);
    output.keep_log = false;
    output
}

/// Records as a script: control flow, variables, macros, arithmetic, and the words of each record against the spec it names. Nothing is
/// executed.
pub fn records(data: &[u8]) {
    let mut job = Job::new(output());
    let mut interpreter = Interpreter::new(internal_names());
    interpreter.budget = RECORDS;
    if interpreter.open("fuzzed", Text::from_bytes(data.to_vec()), 0, None).is_err() {
        return;
    }
    // an error is said and the next record read, as the session has it
    for _ in 0..4 * RECORDS {
        match interpreter.next_step(&mut job) {
            Ok(FlowStep::Record(record)) => read_record(&mut interpreter, &record),
            Ok(FlowStep::Ended(_)) | Err(_) => {}
            Ok(FlowStep::NeedLine | FlowStep::Done) => return,
        }
    }
}

fn read_record(interpreter: &mut Interpreter, record: &Record) {
    let words = record.words();
    let Some(first) = words.first() else { return };
    let called = interpreter.macros().find(|m| m.name.eq_ignore_ascii_case(&first.text)).cloned();
    if let Some(called) = called {
        let _ = interpreter.call(&called, record);
    }
    let name = match first.kind {
        TokenKind::Class => "~CLASS",
        TokenKind::Point => "*POINT",
        TokenKind::Selector => ":SELECTOR",
        _ => &first.text,
    };
    let given = words.get(1..).unwrap_or_default();
    for command in COMMANDS.iter().filter(|c| c.spec.name.eq_ignore_ascii_case(name)) {
        let _ = args::read(command.spec, first.span, given, UnitSystem::default());
    }
    if let (TokenKind::Class, Some(kind)) = (first.kind, given.first()) {
        for class in CLASSES.iter().filter(|c| c.spec.name.eq_ignore_ascii_case(&kind.text)) {
            let _ = args::read(class.spec, kind.span, words.get(2..).unwrap_or_default(), UnitSystem::SI);
        }
    }
}

/// Most messages that are remembered as rendered.
const REMEMBERED: usize = 1 << 20;

/// Whether this process has not rendered the message yet, with the line it points at. The same again shows nothing new, and rendering it
/// takes most of the time of a deck.
fn is_new(message: &Diagnostic, sources: &Sources) -> bool {
    static RENDERED: LazyLock<Mutex<HashSet<u64>>> = LazyLock::new(Mutex::default);
    let shown = |span: Span| {
        let text = sources.get(span.source).map_or("", |source| &source.text);
        let (start, end) = (floor_boundary(text, span.start as usize), floor_boundary(text, span.end as usize));
        let from = text[..start].rfind('\n').map_or(0, |at| at + 1);
        let to = text[end..].find('\n').map_or(text.len(), |at| end + at);
        (text[from..to].to_string(), start - from, span.end - span.start)
    };
    let other = message.other.as_ref().map(|(span, text)| (shown(*span), text));
    let key = (&message.message, &message.label, &message.help, message.span.map(shown), other);
    let mut rendered = RENDERED.lock().expect("no thread fails here");
    if rendered.len() >= REMEMBERED {
        rendered.clear();
    }
    rendered.insert(BuildHasherDefault::<DefaultHasher>::default().hash_one(key))
}

/// An AQWA deck, with its echo, its tables and the records it amounts to.
pub fn decks(data: &[u8]) {
    let text = Text::from_bytes(data.to_vec());
    let _ = windlass_aqwa::is_deck(text.as_str());
    let mut sources = Sources::default();
    let id = sources.add("fuzzed", text, 1);
    let reading = windlass_aqwa::read(&sources, id);
    for message in reading.messages.iter().filter(|message| is_new(message, &sources)) {
        let _ = windlass_language::render::render(message, &sources, false);
    }
    let deck = &reading.deck;
    let _ = (deck.echo(), deck.listing_before_tethers(), deck.listing_before_motion());
    if !reading.failed {
        if let Ok(records) = windlass_aqwa::records(deck) {
            let _ = records.script();
        }
        if let Ok(records) = windlass_aqwa::model_records(deck) {
            let _ = records.model_alone();
        }
    }
}

/// A mesh file; the first byte says of which format.
pub fn meshes(data: &[u8]) {
    let Some((kind, bytes)) = data.split_first() else { return };
    let kind = match kind % 3 {
        0 => MeshKind::Stl,
        1 => MeshKind::Gdf,
        _ => MeshKind::Obj,
    };
    let _ = read_mesh(kind, bytes);
}

/// The files of a hydrodynamic database; the first byte says of which program, and a line `==== NAME` begins a file of text.
pub fn databases(data: &[u8]) {
    let Some((kind, bytes)) = data.split_first() else { return };
    if kind % 4 == 0 {
        let _ = capytaine::read("fuzzed", bytes, None);
        return;
    }
    let text = String::from_utf8_lossy(bytes);
    let files: Vec<SourceFile> = text
        .split("==== ")
        .filter_map(|part| part.split_once('\n'))
        .map(|(name, text)| SourceFile { name: name.to_string(), text: text.to_string() })
        .collect();
    let scale = WamitScale { length: 1.0, density: 1025.0, gravity: 9.80665, depth: None, body: None, origin: None };
    match kind % 4 {
        1 => drop(wamit::read("fuzzed", &files, &scale)),
        2 => drop(nemoh::read("fuzzed", &files, None)),
        _ => {
            let convention = RaoConvention { lag: true, degrees: true, density: 1025.0, gravity: 9.80665, depth: None };
            if let Some(file) = files.first() {
                let _ = rao::read("fuzzed", file, &convention);
            }
        }
    }
}

/// The file of a run: as it stands; as blocks whose sums are put right, so that what is in them is read too; and as one snapshot.
pub fn run_files(data: &[u8]) {
    let _ = run_log::read(&mut Cursor::new(data), f64::INFINITY);
    let _ = Snapshot::read(data);
    let _ = run_log::read(&mut Cursor::new(mend_blocks(data)), f64::INFINITY);
}

/// The bytes of a file of a run with the lengths and sums of its blocks put right.
pub fn mend_blocks(data: &[u8]) -> Vec<u8> {
    let (head, mut rest) = data.split_at(data.len().min(24));
    let mut out = run_log::MARK.to_vec();
    out.extend_from_slice(head.get(8..).unwrap_or_default());
    out.resize(24, 0);
    // a block: its kind, eight bytes of its length, the bytes, eight of their sum
    while let Some((kind, behind)) = rest.split_first() {
        let length =
            behind.first_chunk::<8>().map_or(0, |b| usize::try_from(u64::from_le_bytes(*b)).unwrap_or(usize::MAX));
        let behind = behind.get(8..).unwrap_or_default();
        let (block, behind) = behind.split_at(length.min(behind.len()));
        let sum =
            block.iter().fold(0xcbf2_9ce4_8422_2325u64, |s, b| (s ^ u64::from(*b)).wrapping_mul(0x0100_0000_01b3));
        out.push(match kind {
            b'R' | b'S' => *kind,
            kind if kind % 2 == 0 => b'R',
            _ => b'S',
        });
        out.extend_from_slice(&(block.len() as u64).to_le_bytes());
        out.extend_from_slice(block);
        out.extend_from_slice(&sum.to_le_bytes());
        rest = behind.get(8..).unwrap_or_default();
    }
    out
}

/// A script that may solve: twenty steps in time, interrupted after a second as by Ctrl-C.
pub fn scripts(data: &[u8]) {
    let mut session = Session::new(output());
    session.keep_reports = true;
    session.interpreter.budget = RECORDS;
    session.job.settings.error_limit = i64::MAX;
    session.open("before", "&ENV -TIME 20 1\n");
    session.run();
    session.open("fuzzed", Text::from_bytes(data.to_vec()));
    let interrupt = std::sync::Arc::clone(&session.interpreter.interrupt);
    let (over, wait) = channel::<()>();
    std::thread::scope(|scope| {
        scope.spawn(move || {
            // the sender is dropped when the script has ended
            while wait.recv_timeout(LONGEST) == Err(RecvTimeoutError::Timeout) {
                interrupt.store(true, Ordering::Relaxed);
            }
        });
        session.run();
        session.finish();
        drop(over);
    });
    let defect = session.reports.iter().find(|report| report.message.contains("defect of windlass"));
    assert!(defect.is_none(), "{defect:?}");
}
