//! A disk that is full while a run or a table is written: it is said with the name of the file, and nothing that was computed is lost.

#![cfg(target_os = "linux")]

use crate::common::run as runs;

use std::fs;
use std::path::Path;
use std::process::Command;
use windlass::report::run_log::RunLog;
use windlass_solve::time::Run;

const CART: &str = "MEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 98066.5 1 1 1\n\
                    ~S GSPR BOTH X 40000 1E9 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&INSTATE -LOCATE CART 0.5 0 0\n";

#[test]
fn run_on_full_disk_reports_it_and_keeps_its_rows() {
    // every write to this file fails with \"no space left on device\"
    let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
    let mut run = Run::new(&runs::model(CART), runs::settings(100.0, 0.1), vec![]).unwrap();
    let mut log = RunLog::begin((full, "/dev/full".into()), (run.fingerprint(), run.history.layout.width), []).unwrap();
    let error = run.run(&mut log).unwrap_err();
    let text = format!("{error:?}");
    assert!(text.contains("/dev/full: No space left on device") && text.contains("-RESTART"), "{text}");
    assert_eq!(run.history.len(), 1);
}

/// Runs a script with files of at most 64 blocks (32 or 64 kB, as the shell counts them): writing beyond fails as on a full disk.
fn run_limited(folder: &Path, script: &str) -> (Option<i32>, String) {
    fs::write(folder.join("limited.cif"), script).unwrap();
    let command = "trap '' XFSZ; ulimit -f 64; exec \"$0\" limited.cif --out answers";
    let done = Command::new("sh").args(["-c", command, env!("CARGO_BIN_EXE_windlass")]).current_dir(folder).output();
    let done = done.unwrap();
    (done.status.code(), String::from_utf8_lossy(&done.stdout).into_owned() + &String::from_utf8_lossy(&done.stderr))
}

fn run_unlimited(folder: &Path, script: &str) {
    fs::write(folder.join("free.cif"), script).unwrap();
    let mut program = Command::new(env!("CARGO_BIN_EXE_windlass"));
    let done = program.args(["free.cif", "--out", "answers"]).current_dir(folder).output().unwrap();
    assert!(done.status.success(), "{}", String::from_utf8_lossy(&done.stdout));
}

#[test]
fn run_continued_after_full_disk_matches_uninterrupted_file() {
    let records = format!("&DIMEN -DIMEN METERS N\n{CART}&ENV -TIME 2000 0.1\n");
    let (short, whole) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    run_unlimited(whole.path(), &format!("{records}TDOM -STORE 50\n"));
    let after = "PRCPOST\nTRAJECTORY CART\nSTATISTIC 1 X\nEND\nEND\n";
    let (code, text) = run_limited(short.path(), &format!("{records}TDOM -STORE 50\n{after}"));
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("answers/TDOM.run: File too large"), "{text}");
    // what was computed is there for PRCPOST
    assert!(text.contains("Statistics of Trajectory"), "{text}");
    let log = |folder: &Path| fs::read(folder.join("answers/TDOM.run")).unwrap();
    assert!(log(short.path()).len() < log(whole.path()).len());
    run_unlimited(short.path(), &format!("{records}TDOM -STORE 50 -RESTART\n"));
    assert!(log(short.path()) == log(whole.path()));
}

#[test]
fn table_without_disk_space_is_named_and_leaves_no_partial_file() {
    let folder = tempfile::tempdir().unwrap();
    let rows = (0..9000).map(|n| format!("{n},{}\n", f64::from(n).sqrt())).collect::<String>();
    fs::write(folder.path().join("in.csv"), format!("A,B\n{rows}")).unwrap();
    let (code, text) = run_limited(folder.path(), "&BUILDG -CSV in.csv\nSTORE out.csv A B\nSTATISTIC A B\nEND\n");
    assert_eq!(code, Some(1), "{text}");
    assert!(text.contains("answers/out.csv: File too large") && text.contains("Statistics of"), "{text}");
    let mut names: Vec<_> =
        fs::read_dir(folder.path().join("answers")).unwrap().map(|e| e.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["LOG00001.TXT"]);
}
