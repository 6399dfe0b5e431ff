//! The corpus of the fuzz targets, and changed pieces of it: the twin of `cargo fuzz run` that runs with every test. The changes are of a
//! fixed seed, so that a failure comes again; `fuzz/README.md` says how the targets are run for long.

#[path = "../../../fuzz/src/lib.rs"]
mod targets;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::sample::Index;
use proptest::test_runner::{Config, RngAlgorithm, TestRng, TestRunner};
use std::fs;
use windlass::report::run_log::{self, RunLog};
use windlass_solve::time::{Snapshot, Watcher};

/// What one change does to the bytes.
#[derive(Clone, Debug)]
enum Mutation {
    Set(Index, u8),
    Insert(Index, Vec<u8>),
    Word(Index, &'static str),
    Delete(Index, usize),
    Copy(Index, Index, usize),
    Cut(Index),
}

/// Words that mean something to one of the readers.
const WORDS: [&str; 16] = [
    "\n",
    " 1E308 ",
    " -1 ",
    " 0 ",
    " NaN ",
    " 1/0 ",
    "%A%",
    "&LOOP I 1 9\n",
    "&ENDLOOP\n",
    "END\n",
    " -LEN 1 ",
    " \\\n",
    "(",
    "'",
    "\r\n",
    "\u{202e}",
];

fn change() -> impl Strategy<Value = Mutation> {
    prop_oneof![
        (any::<Index>(), any::<u8>()).prop_map(|(at, byte)| Mutation::Set(at, byte)),
        (any::<Index>(), vec(any::<u8>(), 1..8)).prop_map(|(at, bytes)| Mutation::Insert(at, bytes)),
        (any::<Index>(), proptest::sample::select(WORDS.to_vec())).prop_map(|(at, word)| Mutation::Word(at, word)),
        (any::<Index>(), 1..60usize).prop_map(|(at, count)| Mutation::Delete(at, count)),
        (any::<Index>(), any::<Index>(), 1..200usize).prop_map(|(from, to, count)| Mutation::Copy(from, to, count)),
        any::<Index>().prop_map(Mutation::Cut),
    ]
}

fn apply_mutations(bytes: &[u8], changes: &[Mutation]) -> Vec<u8> {
    let mut out = bytes.to_vec();
    for change in changes {
        let size = out.len();
        let position = |at: &Index| at.index(size + 1);
        let piece = |from: usize, count: usize| from..(from + count).min(size);
        match change {
            Mutation::Set(at, byte) if size > 0 => out[at.index(size)] = *byte,
            Mutation::Set(..) => {}
            Mutation::Insert(at, bytes) => drop(out.splice(position(at)..position(at), bytes.iter().copied())),
            Mutation::Word(at, word) => drop(out.splice(position(at)..position(at), word.bytes())),
            Mutation::Delete(at, count) => drop(out.drain(piece(position(at), *count))),
            Mutation::Copy(from, to, count) => {
                let copy = out[piece(position(from), *count)].to_vec();
                drop(out.splice(position(to)..position(to), copy));
            }
            Mutation::Cut(at) => out.truncate(position(at)),
        }
    }
    out
}

/// Runs the corpus of a target, then so many inputs made of it.
fn hold(name: &str, target: fn(&[u8]), cases: u32) {
    let mut files: Vec<_> = fs::read_dir(format!("fuzz/corpus/{name}")).unwrap().map(|e| e.unwrap().path()).collect();
    files.sort();
    let corpus: Vec<Vec<u8>> = files.iter().map(|path| fs::read(path).unwrap()).collect();
    assert!(!corpus.is_empty());
    corpus.iter().for_each(|bytes| target(bytes));
    let config = Config { cases, failure_persistence: None, max_shrink_iters: 200, ..Config::default() };
    let mut runner = TestRunner::new_with_rng(config, TestRng::deterministic_rng(RngAlgorithm::ChaCha));
    let inputs = (any::<Index>(), vec(change(), 1..12));
    runner
        .run(&inputs, |(file, changes)| {
            target(&apply_mutations(file.get::<Vec<u8>>(&corpus), &changes));
            Ok(())
        })
        .unwrap();
}

#[test]
fn records_of_any_bytes_are_read_or_refused() {
    hold("records", targets::records, 1000);
}

#[test]
fn decks_of_any_bytes_are_read_or_refused() {
    hold("decks", targets::decks, 500);
}

#[test]
fn meshes_of_any_bytes_are_read_or_refused() {
    hold("meshes", targets::meshes, 2000);
}

#[test]
fn databases_of_any_bytes_are_read_or_refused() {
    hold("databases", targets::databases, 400);
}

#[test]
fn run_files_of_any_bytes_are_read_or_refused() {
    hold("run_files", targets::run_files, 2000);
}

#[test]
fn scripts_of_any_bytes_are_run_or_refused() {
    hold("scripts", targets::scripts, 60);
}

#[test]
fn complete_run_file_is_unchanged_by_repair() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("TDOM.run");
    let file = fs::File::options().read(true).write(true).create_new(true).open(&path).unwrap();
    let mut log = RunLog::begin((file, path.clone()), (7, 3), []).unwrap();
    log.row(&[0.0, 1.0, 2.0]).unwrap();
    log.snapshot(&Snapshot { time: 0.5, rows: 1, ..Snapshot::default() }).unwrap();
    let bytes = fs::read(&path).unwrap();
    assert_eq!(targets::mend_blocks(&bytes), bytes);
    let mut damaged = bytes.clone();
    *damaged.last_mut().unwrap() ^= 1;
    let kept = run_log::read(&mut std::io::Cursor::new(targets::mend_blocks(&damaged)), 1.0).unwrap();
    assert_eq!((kept.fingerprint, kept.width, kept.rows, kept.snapshot.time), (7, 3, vec![0.0, 1.0, 2.0], 0.5));
}
