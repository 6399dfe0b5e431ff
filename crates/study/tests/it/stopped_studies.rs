//! A study of six cases stopped after the n-th operation on files, for every n, and gone on with: its records, its kept folders and its
//! rows are those of one that was never stopped.

use std::collections::BTreeSet;
use std::fs;
use std::io;
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Condvar, Mutex};
use std::time::Duration;
use windlass_study::kept::KeptResult;
use windlass_study::parts::{Part, collect, divide};
use windlass_study::record::{CaseRecord, CaseStatus, FileRead, LinePeaks, Peak, decode};
use windlass_study::runner::{Keep, RunCase, StudyPlan, begin_study, run_study};
use windlass_study::store::{Files, Fill, SCATTER_PERCENT, Study, SystemFiles};
use windlass_study::table::{Case, CaseTable, MOST_CASES};

/// Files that fail for good from an operation on; the one it falls in writes half of what it was given.
struct Stopping {
    left: AtomicUsize,
}

impl Stopping {
    fn ask(&self) -> io::Result<()> {
        let left = self.left.fetch_update(Ordering::Relaxed, Ordering::Relaxed, |n| n.checked_sub(1));
        left.map(drop).map_err(|_| io::Error::other("stopped"))
    }
}

impl Files for Stopping {
    fn make_folder(&self, path: &Path) -> io::Result<()> {
        self.ask()?;
        SystemFiles.make_folder(path)
    }

    fn append(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        if let Err(stopped) = self.ask() {
            SystemFiles.append(path, &bytes[..bytes.len() / 2])?;
            return Err(stopped);
        }
        SystemFiles.append(path, bytes)
    }

    fn sync(&self, path: &Path) -> io::Result<()> {
        self.ask()?;
        SystemFiles.sync(path)
    }

    fn truncate(&self, path: &Path, length: u64) -> io::Result<()> {
        self.ask()?;
        SystemFiles.truncate(path, length)
    }

    fn write_by(&self, path: &Path, fill: &mut Fill) -> io::Result<()> {
        self.ask()?;
        SystemFiles.write_by(path, fill)
    }

    fn move_folder(&self, from: &Path, to: &Path) -> io::Result<()> {
        self.ask()?;
        SystemFiles.move_folder(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        self.ask()?;
        SystemFiles.remove(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        self.ask()?;
        SystemFiles.remove_folder(path)
    }
}

/// Cases whose result is the square of X, of which that of X = 4 fails.
struct Squares;

impl RunCase for Squares {
    fn run(&self, case: &Case, columns: &[String], folder: &Path, _: Option<&CaseRecord>) -> Option<CaseRecord> {
        let x: f64 = case.values[0].parse().unwrap();
        fs::write(folder.join("answer"), &case.name).unwrap();
        let failed = x == 4.0;
        Some(CaseRecord {
            case: case.name.clone(),
            values: columns.iter().cloned().zip(case.values.iter().cloned()).collect(),
            seed: case.seed,
            status: if failed { CaseStatus::Failed } else { CaseStatus::Done },
            reason: if failed { "four".into() } else { String::new() },
            results: if failed { Vec::new() } else { vec![KeptResult::new("SQUARE", x * x, "").unwrap()] },
            read: vec![FileRead { path: "model".into(), size: 1, hash: "h".into() }],
            version: "1".into(),
            ..CaseRecord::default()
        })
    }

    fn is_unchanged(&self, read: &FileRead) -> bool {
        read.hash == "h"
    }
}

fn plan(folder: &Path) -> StudyPlan {
    // the least square comes first and the largest third: folders are kept and given up
    let table = "case,X\nA,1\nB,2\nC,9\nD,4\nE,3\nF,5\n";
    StudyPlan {
        folder: folder.join("S"),
        model: "model".into(),
        begun_in: String::new(),
        table_name: "cases.csv".into(),
        table: CaseTable::parse("cases.csv", table, 1, MOST_CASES).unwrap(),
        seed: 1,
        version: "1".into(),
        jobs: 1,
        keep: Keep::Governing,
        retry_failed: false,
        scatter_percent: SCATTER_PERCENT,
    }
}

/// Case, status and square of each record, in the order of the table.
fn rows(study: &Study) -> Vec<(String, CaseStatus, Option<f64>)> {
    let row = |r: CaseRecord| (r.case, r.status, r.results.first().map(|s| s.value));
    study.records.iter().map(|view| row(view.to_record())).collect()
}

fn kept(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder.join("S/cases")).unwrap();
    entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect()
}

#[test]
fn study_stopped_after_any_operation_goes_on_to_the_same_end() {
    let by_hand: Vec<(String, CaseStatus, Option<f64>)> = [
        ("A", CaseStatus::Done, Some(1.0)),
        ("B", CaseStatus::Done, Some(4.0)),
        ("C", CaseStatus::Done, Some(81.0)),
        ("D", CaseStatus::Failed, None),
        ("E", CaseStatus::Done, Some(9.0)),
        ("F", CaseStatus::Done, Some(25.0)),
    ]
    .map(|(name, status, square)| (name.to_owned(), status, square))
    .into();
    let (mut stops, mut finished) = (0, 0);
    for n in 0.. {
        let folder = tempfile::tempdir().unwrap();
        let plan = plan(folder.path());
        let files = Stopping { left: AtomicUsize::new(n) };
        let first = run_study(&plan, &files, &Squares, &AtomicBool::new(false), &|_| ());
        let is_whole = first.is_ok();
        if let Ok(end) = first {
            assert_eq!((end.kept, end.progress.finished, end.progress.failed), (0, 6, 1));
            finished += 1;
        } else {
            stops += 1;
            if plan.folder.join("study.json").exists() {
                // what is there before it goes on is whole records
                let before = Study::open(&plan.folder).unwrap();
                assert!(rows(&before).iter().all(|row| by_hand.contains(row)), "{n}");
            }
            run_study(&plan, &SystemFiles, &Squares, &AtomicBool::new(false), &|_| ()).unwrap();
        }
        let study = Study::open(&plan.folder).unwrap();
        assert_eq!(rows(&study), by_hand, "stopped after {n} operations");
        assert_eq!(
            kept(folder.path()),
            // the least, the largest and the failed one
            BTreeSet::from(["A".to_owned(), "C".to_owned(), "D".to_owned()]),
            "stopped after {n} operations"
        );
        let torn = fs::read(plan.folder.join("results-0.jsonl")).unwrap();
        assert_eq!(decode(&torn).1, torn.len(), "half a record is left after {n} operations");
        if is_whole {
            break;
        }
    }
    // three before the cases, three or four for each of them, and what is given up and seen to the disk
    assert!((25..40).contains(&stops) && finished == 1, "{stops} stops");
}

/// Cases with lines lost: an intact one has its X as the time of the peaks of its lines, a transient one keeps twice that of the intact case it
/// follows.
struct Losses;

impl RunCase for Losses {
    fn run(&self, case: &Case, columns: &[String], folder: &Path, intact: Option<&CaseRecord>) -> Option<CaseRecord> {
        let made = Squares.run(case, columns, folder, None)?;
        let x: f64 = case.values[0].parse().unwrap();
        let peaks = |line: &String| LinePeaks {
            line: line.clone(),
            tension: vec![Peak { time: x, value: 1.0, before: None }],
            offset: None,
        };
        assert_eq!(intact.is_some(), case.intact.is_some(), "{}", case.name);
        let Some(intact) = intact else {
            return Some(CaseRecord { peaks: case.peaks_of.iter().map(peaks).collect(), ..made });
        };
        let results = vec![KeptResult::new("SQUARE", 2.0 * intact.peaks[0].tension[0].time, "").unwrap()];
        Some(CaseRecord { results, intact: Some(intact.followed()), ..made })
    }

    fn is_unchanged(&self, read: &FileRead) -> bool {
        read.hash == "h"
    }
}

/// A transient case before the intact one that it follows, and one whose intact case fails.
const LOSSES: &str = "case,X,lost,condition,seed_of\nT,7,L1,transient,a\nI,7,NONE,intact,a\nD,7,L1,damaged,a\n\
                      J,4,NONE,intact,b\nU,4,L1+L2,transient,b\n";

fn losses(folder: &Path, text: &str, jobs: usize) -> StudyPlan {
    StudyPlan { table: CaseTable::parse("cases.csv", text, 1, MOST_CASES).unwrap(), jobs, ..plan(folder) }
}

#[test]
fn transient_cases_follow_intact_ones_wherever_a_study_is_stopped() {
    let end = |plan: &StudyPlan| {
        let study = Study::open(&plan.folder).unwrap();
        let row = |r: CaseRecord| (r.case, r.status, r.results.first().map(|s| s.value), r.reason);
        study.records.iter().map(|view| row(view.to_record())).collect::<Vec<_>>()
    };
    let row = |case: &str, status, value, reason: &str| (case.to_owned(), status, value, reason.to_owned());
    let by_hand = [
        row("T", CaseStatus::Done, Some(14.0), ""),
        row("I", CaseStatus::Done, Some(49.0), ""),
        row("D", CaseStatus::Done, Some(49.0), ""),
        row("J", CaseStatus::Failed, None, "four"),
        row("U", CaseStatus::Failed, None, "its intact case J has failed: four"),
    ];
    for jobs in [1, 3] {
        for n in 0..40 {
            let folder = tempfile::tempdir().unwrap();
            let plan = losses(folder.path(), LOSSES, jobs);
            let files = Stopping { left: AtomicUsize::new(n) };
            let _ = run_study(&plan, &files, &Losses, &AtomicBool::new(false), &|_| ());
            run_study(&plan, &SystemFiles, &Losses, &AtomicBool::new(false), &|_| ()).unwrap();
            assert_eq!(end(&plan), by_hand, "{jobs} workers, stopped after {n} operations");
        }
    }
}

/// Divides what is left of a study into so many parts, a group after the other in turn, and runs them, each stopped after so many operations
/// first.
fn run_in_parts(plan: &StudyPlan, parts: usize, stop_after: usize, scratch: &Path) {
    let begun = begin_study(plan, &SystemFiles, &Losses).unwrap();
    let mut packed = vec![Vec::new(); parts];
    begun.groups().into_iter().enumerate().for_each(|(n, group)| packed[n % parts].extend(group));
    packed.iter_mut().for_each(|part| part.sort_unstable());
    divide(plan, &begun, &packed, &SystemFiles).unwrap();
    for number in 1..=parts {
        let part = Part::open(&plan.folder, begun.start, number).unwrap();
        for left in [stop_after, usize::MAX] {
            let files = Stopping { left: AtomicUsize::new(left) };
            let _ = part.run((2, scratch), &files, &Losses, &AtomicBool::new(false), &|_| ());
        }
    }
}

#[test]
fn parts_keep_transient_cases_with_their_intact_ones_wherever_they_are_stopped() {
    for stop_after in 0..30 {
        let folder = tempfile::tempdir().unwrap();
        let (whole, scratch) = (folder.path().join("whole"), folder.path().join("scratch"));
        let one = losses(&whole, LOSSES, 1);
        run_study(&one, &SystemFiles, &Losses, &AtomicBool::new(false), &|_| ()).unwrap();
        let plan = losses(folder.path(), LOSSES, 1);
        run_in_parts(&plan, 3, stop_after, &scratch);
        let place = (2, scratch.as_path());
        let stop = AtomicBool::new(false);
        let study = collect(&plan.folder, Keep::Governing, place, &SystemFiles, &Losses, &stop).unwrap();
        let without_start =
            |study: &Study| study.records.iter().map(|r| CaseRecord { start: 0, ..r.to_record() }).collect::<Vec<_>>();
        assert_eq!(without_start(&study), without_start(&Study::open(&one.folder).unwrap()), "{stop_after}");
        assert_eq!(kept(folder.path()), kept(&whole), "{stop_after}");
        // a transient case more: the part has the record of the intact one that it follows
        let more = losses(folder.path(), &format!("{LOSSES}V,7,L1,transient,a\n"), 1);
        run_in_parts(&more, 2, stop_after, &scratch);
        let study = Study::open(&more.folder).unwrap();
        let last = study.records.iter().last().unwrap().to_record();
        assert_eq!((last.case.as_str(), last.results[0].value.to_bits()), ("V", f64::to_bits(14.0)));
    }
}

#[test]
fn transient_case_is_run_again_with_the_intact_one() {
    let folder = tempfile::tempdir().unwrap();
    let go = |text: &str, retry_failed| {
        let plan = StudyPlan { retry_failed, ..losses(folder.path(), text, 2) };
        let mut again = run_study(&plan, &SystemFiles, &Losses, &AtomicBool::new(false), &|_| ()).unwrap().again;
        again.sort();
        again.into_iter().map(|(case, reason)| format!("{case}: {reason}")).collect::<Vec<_>>()
    };
    assert!(go(LOSSES, false).is_empty());
    assert!(go(LOSSES, false).is_empty());
    let both = ["J: it failed", "U: it failed"];
    assert_eq!(go(LOSSES, true), both);
    // a line more is lost: the intact case has no peaks of it
    let more = format!("{LOSSES}V,7,L3,transient,a\n");
    let wanted = ["I: it has kept no peaks of L3, which a transient case loses", "T: its intact case I is run again"];
    assert_eq!(go(&more, false), wanted);
    // the intact case that failed does so no more
    let mended = more.replace("J,4", "J,5").replace("U,4", "U,5");
    assert_eq!(go(&mended, false), ["J: its row has changed", "U: its row has changed"]);
    let study = Study::open(&folder.path().join("S")).unwrap();
    assert!(study.records.iter().all(|record| record.status() == CaseStatus::Done));
}

#[test]
fn what_has_changed_is_run_again_and_said_why() {
    let folder = tempfile::tempdir().unwrap();
    let first = plan(folder.path());
    let go = |plan: &StudyPlan| run_study(plan, &SystemFiles, &Squares, &AtomicBool::new(false), &|_| ());
    go(&first).unwrap();
    let table = "case,X\nG,6\nF,5\nA,7\n";
    let second = StudyPlan { table: CaseTable::parse("cases.csv", table, 1, MOST_CASES).unwrap(), ..first.clone() };
    let end = go(&second).unwrap();
    assert_eq!((end.kept, end.progress.finished), (1, 2));
    assert_eq!(end.again, [("A".to_owned(), "its row has changed".to_owned())]);
    let study = Study::open(&second.folder).unwrap();
    let squares: Vec<_> = rows(&study).into_iter().take(3).map(|(name, _, square)| (name, square)).collect();
    assert_eq!(squares, [("G".to_owned(), Some(36.0)), ("F".to_owned(), Some(25.0)), ("A".to_owned(), Some(49.0))]);
    let newer = StudyPlan { version: "2".into(), ..second.clone() };
    assert!(go(&newer).unwrap().again.iter().all(|(_, reason)| reason == "it is of version 1"));
    let failed = StudyPlan { retry_failed: true, ..first.clone() };
    assert_eq!(go(&failed).unwrap().again.iter().filter(|(case, _)| case == "D").count(), 1);
    let other = StudyPlan { seed: 2, ..first };
    assert!(go(&other).unwrap_err().to_string().ends_with("its study has the seed 1, not 2: name another folder"));
}

#[test]
fn study_killed_while_its_first_file_was_written_begins_anew() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan(folder.path());
    fs::create_dir(&plan.folder).unwrap();
    fs::write(plan.folder.join(".unfinished-a1b2c3"), "{\"model\":").unwrap();
    let end = run_study(&plan, &SystemFiles, &Squares, &AtomicBool::new(false), &|_| ()).unwrap();
    assert_eq!((end.progress.finished, plan.folder.join(".unfinished-a1b2c3").exists()), (6, false));
}

#[test]
fn folder_of_something_else_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let plan = plan(folder.path());
    fs::create_dir(&plan.folder).unwrap();
    fs::write(plan.folder.join("letter"), "mine").unwrap();
    let error = run_study(&plan, &SystemFiles, &Squares, &AtomicBool::new(false), &|_| ()).unwrap_err();
    assert!(error.to_string().contains("it holds files and is of no study"), "{error}");
}

/// Files that say how many records have been added, and how many of these have been seen through to the disk.
struct Watched {
    records: Mutex<(usize, usize)>,
    news: Condvar,
}

impl Files for Watched {
    fn make_folder(&self, path: &Path) -> io::Result<()> {
        SystemFiles.make_folder(path)
    }

    fn append(&self, path: &Path, bytes: &[u8]) -> io::Result<()> {
        self.records.lock().unwrap().0 += 1;
        SystemFiles.append(path, bytes)
    }

    fn sync(&self, path: &Path) -> io::Result<()> {
        let mut records = self.records.lock().unwrap();
        records.1 = records.0;
        self.news.notify_all();
        SystemFiles.sync(path)
    }

    fn truncate(&self, path: &Path, length: u64) -> io::Result<()> {
        SystemFiles.truncate(path, length)
    }

    fn write_by(&self, path: &Path, fill: &mut Fill) -> io::Result<()> {
        SystemFiles.write_by(path, fill)
    }

    fn move_folder(&self, from: &Path, to: &Path) -> io::Result<()> {
        SystemFiles.move_folder(from, to)
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        SystemFiles.remove(path)
    }

    fn remove_folder(&self, path: &Path) -> io::Result<()> {
        SystemFiles.remove_folder(path)
    }
}

/// Five short cases, and a sixth that ends only when the records of the others are on the disk.
struct LongLast<'a>(&'a Watched);

impl RunCase for LongLast<'_> {
    fn run(&self, case: &Case, columns: &[String], folder: &Path, _: Option<&CaseRecord>) -> Option<CaseRecord> {
        if case.name == "F" {
            let records = self.0.records.lock().unwrap();
            // the limit ends a test that would hang
            let limit = Duration::from_secs(60);
            let waited = self.0.news.wait_timeout_while(records, limit, |(_, synced)| *synced < 5).unwrap();
            assert!(!waited.1.timed_out(), "the records before a long case are never seen through to the disk");
        }
        Squares.run(case, columns, folder, None)
    }

    fn is_unchanged(&self, read: &FileRead) -> bool {
        Squares.is_unchanged(read)
    }
}

#[test]
fn records_before_a_long_case_are_on_the_disk_while_it_runs() {
    let folder = tempfile::tempdir().unwrap();
    let files = Watched { records: Mutex::new((0, 0)), news: Condvar::new() };
    let end = run_study(&plan(folder.path()), &files, &LongLast(&files), &AtomicBool::new(false), &|_| ()).unwrap();
    assert_eq!((end.progress.finished, end.progress.failed), (6, 1));
}
