//! The command line as its user types it: records given with -c, wrong uses, the log.

#![allow(clippy::unwrap_used)]

use std::path::Path;
use std::process::Command;

/// Exit code, standard output and messages of a run in a folder.
fn run_in(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

fn run(arguments: &[&str]) -> (Option<i32>, String, String) {
    run_in(tempfile::tempdir().unwrap().path(), arguments)
}

#[test]
fn blocks_go_on_from_one_record_of_the_command_line_to_the_next() {
    let block = ["-c", "&IF 1 .EQ. 2 &THEN", "-c", "&TYPE runs", "-c", "&ELSE", "-c", "&TYPE other", "-c", "&ENDIF"];
    assert_eq!(run(&block), (Some(0), "other\n".into(), String::new()));
    let loops = ["-c", "&LOOP I 1 2", "-c", "&TYPE \\", "-c", "trip %I", "-c", "&ENDLOOP"];
    assert_eq!(run(&loops).1, "trip 1\ntrip 2\n");
}

#[test]
fn a_message_names_the_number_of_the_wrong_record() {
    let (code, out, err) = run(&["-c", "&TYPE one", "-c", "NONSENSE", "-c", "&TYPE three"]);
    assert_eq!((code, out.as_str()), (Some(1), "one\nthree\n"));
    assert!(err.contains("-c:2:1"), "{err}");
    let (_, _, err) = run(&["-c", "&TYPE one", "-c", "&IF .FALSE. &THEN"]);
    assert!(err.contains("-c:2:1") && err.contains("not closed"), "{err}");
}

#[test]
fn records_write_their_log_where_out_says_and_else_none() {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["-c", "&TYPE hi"]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    assert_eq!(run_in(folder.path(), &["-c", "&TYPE hi", "--out", "zz"]).0, Some(0));
    let log = std::fs::read_to_string(folder.path().join("zz/LOG00001.TXT")).unwrap();
    assert_eq!(log, "> &TYPE hi\nhi\n");
}

#[test]
fn a_second_record_without_its_c_is_told_to_have_one() {
    for arguments in [&["-c", "&TYPE a", "&TYPE b"][..], &["-c", "&TYPE a", "&TYPE b", "&TYPE c"]] {
        let (code, out, err) = run(arguments);
        assert_eq!((code, out.as_str()), (Some(2), ""));
        assert!(err.contains("`&TYPE b` is a record, it needs a -c of its own"), "{err}");
    }
    let (code, _, err) = run(&["a.cif", "b.cif"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("`b.cif` is one too many"), "{err}");
}

#[test]
fn a_missing_script_is_named_as_it_was_typed() {
    let (code, _, err) = run(&["nofile.cif"]);
    assert_eq!((code, err.as_str()), (Some(2), "windlass: there is no file nofile.cif\n"));
    assert!(run(&["nofile"]).2.contains("there is no file nofile, nor nofile.cif"));
}
