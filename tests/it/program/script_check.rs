//! `windlass check`: records counted by hand, nothing solved, nothing written, and an end to every script.

use std::path::Path;
use std::process::{Command, Output};

fn check(folder: &Path, script: &str, options: &[&str]) -> Output {
    std::fs::write(folder.join("m.cif"), script).unwrap();
    Command::new(env!("CARGO_BIN_EXE_windlass"))
        .args(["check", "m.cif"])
        .args(options)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// The line that counts the records, and the exit code.
fn counts(script: &str) -> (String, i32) {
    let folder = tempfile::tempdir().unwrap();
    let done = check(folder.path(), script, &[]);
    let names: Vec<_> = std::fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    assert_eq!(names, ["m.cif"], "a check writes nothing");
    let text = String::from_utf8(done.stdout).unwrap();
    let line = text.lines().find(|line| line.contains(" records: ")).unwrap_or_else(|| panic!("{text}"));
    (line.to_string(), done.status.code().unwrap())
}

#[test]
fn script_check_counts_records_by_effect() {
    // &DIMEN, MEDIT, &DESCRIBE, *P, &EQUI, &FILE, TDOM act; BEAM has no place outside of a model
    let script = "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY B\n*P 1 2 3\nEND\n&LOGDEVICE OUTPUT\nBEAM ~C *P *P\n\
                  &EQUI\n&FILE MKDIR there\nTDOM\n";
    assert_eq!(counts(script), ("9 records: 7 act, 0 stop a solve, 1 noted, 1 refused, 0 not judged".into(), 1));
    let stops = "MEDIT\n&DESCRIBE BODY B\nEND\nHYDRODYNAMICS\nG_PRESSURE B\nEND\n&EQUI\n";
    assert_eq!(counts(stops), ("5 records: 4 act, 1 stop a solve, 0 noted, 0 refused, 0 not judged".into(), 0));
}

#[test]
fn branches_on_results_are_read_but_not_judged() {
    // the two &TITLE and the last are not judged, the misspelt option of the branch is refused
    let script = "MEDIT\n&DESCRIBE BODY B\nEND\n&EQUI\n&SET D = &NUMBER(REAL 2*&BODY(DRAFT B))\n&IF %D .GT. 3 &THEN\n&TITLE deep\n\
                  &ELSE\n&TITLE shallow\n&EQUI -BOGUS\n&ENDIF\n&TITLE %D\n";
    assert_eq!(counts(script), ("7 records: 3 act, 0 stop a solve, 0 noted, 1 refused, 3 not judged".into(), 1));
    // what does not hang on a result is known: one branch is read
    let known = "MEDIT\n&DESCRIBE BODY B\nEND\n&IF &BODY(CURRENT) .EQ. B &THEN\n&TITLE one\n&ELSE\n&TITLE two\n&EQUI -BOGUS\n&ENDIF\n";
    assert_eq!(counts(known), ("3 records: 3 act, 0 stop a solve, 0 noted, 0 refused, 0 not judged".into(), 0));
}

#[test]
fn loops_on_unknown_values_end() {
    // &TITLE of the loop up to an unknown number is read once; the endless loop is left where it would be left by a result
    let script = "MEDIT\n&DESCRIBE BODY B\nEND\n&EQUI\n&LOOP I 1 &BODY(DRAFT B)\n&TITLE a\n&ENDLOOP\n\
                  &LOOP\n&TITLE b\n&EXIT &BODY(DRAFT B) .GT. 3\n&ENDLOOP\n&TITLE c\n";
    assert_eq!(counts(script), ("6 records: 6 act, 0 stop a solve, 0 noted, 0 refused, 0 not judged".into(), 0));
    let folder = tempfile::tempdir().unwrap();
    let done = check(folder.path(), "&LOOP\n&SUBTITLE a\n&ENDLOOP\n", &[]);
    let text = String::from_utf8(done.stdout).unwrap();
    assert!(text.contains("what follows is not checked"), "{text}");
}

#[test]
fn files_outside_of_the_scripts_folder_are_not_read() {
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("inside");
    std::fs::create_dir(&inside).unwrap();
    std::fs::write(folder.path().join("secret.cif"), "&TITLE secret\n").unwrap();
    std::fs::write(inside.join("own.cif"), "&TITLE own\n").unwrap();
    let done = check(&inside, "&INSERT ../secret.cif\n&INSERT own.cif\n", &["--compat"]);
    let [text, said] = [done.stdout, done.stderr].map(|bytes| String::from_utf8(bytes).unwrap());
    assert!(text.contains("3 records: 2 act, 0 stop a solve, 0 noted, 1 refused, 0 not judged"), "{text}");
    assert!(said.contains("outside of the script's folder: a check does not read it"), "{said}");
    assert!(text.contains("m.cif:1:1  &INSERT ../secret.cif"), "{text}");
}

#[test]
fn shipped_scripts_refuse_only_intended_records() {
    // records that are wrong or absent on purpose, or ask for files outside of scripts/ or that are made by another script
    let wrong = ["database", "hemisphere_rao", "history", "members", "moses", "prescribed", "refused", "two_barges"];
    for entry in std::fs::read_dir("scripts").unwrap() {
        let path = entry.unwrap().path();
        let stem = path.file_stem().unwrap().to_string_lossy().into_owned();
        if path.extension().is_none_or(|end| end != "cif") || wrong.contains(&stem.as_str()) {
            continue;
        }
        let done = Command::new(env!("CARGO_BIN_EXE_windlass")).arg("check").arg(&path).output().unwrap();
        assert_eq!(done.status.code(), Some(0), "{stem}: {}", String::from_utf8_lossy(&done.stderr));
    }
}

#[test]
fn watch_ends_check_within_a_record_and_says_so() {
    use std::sync::mpsc::channel;
    use windlass::session::CheckWatch;
    // a check that never comes to its next record, with no time to wait
    let (send, receive) = channel();
    let _watch = CheckWatch::start(std::sync::Arc::default(), std::time::Duration::ZERO, move |report| {
        send.send((report.take_lines(false), report.take_lines(false))).unwrap();
    });
    let (first, second) = receive.recv().unwrap();
    let lines = first.unwrap();
    assert_eq!(lines[0], "0 records: 0 act, 0 stop a solve, 0 noted, 0 refused, 0 not judged");
    assert!(
        lines[1].contains("the check ended after 0 s") && lines[1].contains("what follows is not checked"),
        "{lines:?}"
    );
    assert!(second.is_none(), "a report is printed once");
}

#[test]
fn event_of_a_run_is_not_judged() {
    let script = "MEDIT\n&DESCRIBE BODY B\nEND\nTDOM\n&INSTATE -EVENT 10\n";
    assert_eq!(counts(script), ("4 records: 3 act, 0 stop a solve, 0 noted, 0 refused, 1 not judged".into(), 0));
}
