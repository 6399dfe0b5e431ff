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

#[test]
fn a_macro_named_as_an_abbreviation_is_called_and_one_named_as_a_command_is_refused() {
    let called = ["-c", "&MACRO &TYP A", "-c", "&TYPE mine %A", "-c", "&ENDMACRO", "-c", "&TYP 1", "-c", "&TYPE own"];
    assert_eq!(run(&called), (Some(0), "mine 1\nown\n".into(), String::new()));
    let (code, out, err) = run(&["-c", "&MACRO &TYPE A", "-c", "&TYPE mine", "-c", "&ENDMACRO", "-c", "&TYPE own"]);
    assert_eq!((code, out.as_str()), (Some(1), "own\n"));
    assert!(err.contains("macro &TYPE cannot be called"), "{err}");
}

#[test]
fn a_comma_with_blanks_around_it_is_one_separator_and_two_leave_a_datum_empty() {
    let point =
        |record: &str| run(&["-c", "MEDIT", "-c", record, "-c", "&TYPE at &POINT(COORDINATES *D)", "-c", "END"]).1;
    assert_eq!(point("*D , 1"), "at 1 0 0\n");
    assert_eq!(point("*D ,, 1"), "at 0 1 0\n");
}

#[test]
fn a_part_turned_by_a_quarter_has_exact_coordinates() {
    let records = "MEDIT\n&DESCRIBE BODY B\n&DESCRIBE PART P -MOVE 0 0 0 0 0 90\n*C 10 0 0\n\
                   &TYPE at &POINT(COORDINATES *C -GLOBAL)\nEND";
    assert_eq!(run(&["-c", records]).1, "at 0 10 0\n");
}

#[test]
fn a_plot_that_goes_to_no_terminal_is_ninety_columns_wide() {
    let plot = ["-c", "&DATA CURVES C_PROFILE CUR 0 1 100 2", "-c", "&STATUS CURVES -PLOT"];
    let widest = |text: &str| {
        let plotted = text.lines().filter(|l| l.contains(|c| ('\u{2800}'..='\u{28ff}').contains(&c)));
        plotted.map(|l| l.chars().count()).max().unwrap_or(0)
    };
    assert!((88..=90).contains(&widest(&run(&plot).1)));
    let set = run(&["-c", "&DEVICE -PLOT_SIZE 50 12", plot[0], plot[1], plot[2], plot[3]]).1;
    assert!((48..=50).contains(&widest(&set)), "{set}");
}
