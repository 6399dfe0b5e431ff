//! The command line as its user types it: records given with -c, wrong uses, the log.

use std::io::Write;
use std::path::Path;
use std::process::{Command, Stdio};

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
fn blocks_continue_across_command_line_records() {
    let block = ["-c", "&IF 1 .EQ. 2 &THEN", "-c", "&TYPE runs", "-c", "&ELSE", "-c", "&TYPE other", "-c", "&ENDIF"];
    assert_eq!(run(&block), (Some(0), "other\n".into(), String::new()));
    let loops = ["-c", "&LOOP I 1 2", "-c", "&TYPE \\", "-c", "trip %I", "-c", "&ENDLOOP"];
    assert_eq!(run(&loops).1, "trip 1\ntrip 2\n");
}

#[test]
fn message_names_number_of_wrong_record() {
    let (code, out, err) = run(&["-c", "&TYPE one", "-c", "NONSENSE", "-c", "&TYPE three"]);
    assert_eq!((code, out.as_str()), (Some(1), "one\nthree\n"));
    assert!(err.contains("-c:2:1"), "{err}");
    let (_, _, err) = run(&["-c", "&TYPE one", "-c", "&IF .FALSE. &THEN"]);
    assert!(err.contains("-c:2:1") && err.contains("not closed"), "{err}");
}

#[test]
fn command_line_records_log_only_where_out_names_a_folder() {
    let folder = tempfile::tempdir().unwrap();
    run_in(folder.path(), &["-c", "&TYPE hi"]);
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    assert_eq!(run_in(folder.path(), &["-c", "&TYPE hi", "--out", "zz"]).0, Some(0));
    let log = std::fs::read_to_string(folder.path().join("zz/LOG00001.TXT")).unwrap();
    assert_eq!(log, "> &TYPE hi\nhi\n");
}

#[test]
fn second_record_without_c_is_refused_with_a_hint() {
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
fn missing_script_is_named_as_typed() {
    let (code, _, err) = run(&["nofile.cif"]);
    assert_eq!((code, err.as_str()), (Some(2), "windlass: there is no file nofile.cif\n"));
    assert!(run(&["nofile"]).2.contains("there is no file nofile, nor nofile.cif"));
}

#[test]
fn macro_may_have_abbreviation_name_but_no_command_name() {
    let called = ["-c", "&MACRO &TYP A", "-c", "&TYPE mine %A", "-c", "&ENDMACRO", "-c", "&TYP 1", "-c", "&TYPE own"];
    assert_eq!(run(&called), (Some(0), "mine 1\nown\n".into(), String::new()));
    let (code, out, err) = run(&["-c", "&MACRO &TYPE A", "-c", "&TYPE mine", "-c", "&ENDMACRO", "-c", "&TYPE own"]);
    assert_eq!((code, out.as_str()), (Some(1), "own\n"));
    assert!(err.contains("macro &TYPE cannot be called"), "{err}");
}

#[test]
fn comma_with_blanks_is_one_separator_and_two_leave_empty_field() {
    let point =
        |record: &str| run(&["-c", "MEDIT", "-c", record, "-c", "&TYPE at &POINT(COORDINATES *D)", "-c", "END"]).1;
    assert_eq!(point("*D , 1"), "at 1 0 0\n");
    assert_eq!(point("*D ,, 1"), "at 0 1 0\n");
}

#[test]
fn part_rotated_by_quarter_turn_has_exact_coordinates() {
    let records = "MEDIT\n&DESCRIBE BODY B\n&DESCRIBE PART P -MOVE 0 0 0 0 0 90\n*C 10 0 0\n\
                   &TYPE at &POINT(COORDINATES *C -GLOBAL)\nEND";
    assert_eq!(run(&["-c", records]).1, "at 0 10 0\n");
}

#[test]
fn plot_without_terminal_is_ninety_columns_wide() {
    let plot = ["-c", "&DATA CURVES C_PROFILE CUR 0 1 100 2", "-c", "&STATUS CURVES -PLOT"];
    let widest = |text: &str| {
        let plotted = text.lines().filter(|l| l.contains(|c| ('\u{2800}'..='\u{28ff}').contains(&c)));
        plotted.map(|l| l.chars().count()).max().unwrap_or(0)
    };
    assert!((88..=90).contains(&widest(&run(&plot).1)));
    let set = run(&["-c", "&DEVICE -PLOT_SIZE 50 12", plot[0], plot[1], plot[2], plot[3]]).1;
    assert!((48..=50).contains(&widest(&set)), "{set}");
}

/// A barge between two lines of about 760 kN; `line` is their class behind its length, `asked` what is asked of them.
fn run_moored(line: &str, asked: &str) -> (Option<i32>, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let script = format!(
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY RIG\n*CG 0 0 -2\n*F 0 0 -10\n#WEIGHT *CG 20000 8 8 8\n&SURFACE\n\
         BLOCK HULL -10 -10 -10 10 10 10\nEND_&SURFACE\n\
         ~C B_CAT {line} -LEN 900 -BUOY 0 -WTPL 1\n\
         CONNECTOR A -ANC 0 800 ~C *F\nCONNECTOR B -ANC 180 800 ~C *F\nEND\n&ENV -DEPTH 300 -TIME 2 0.5\n{asked}\n"
    );
    std::fs::write(folder.path().join("job.cif"), script).unwrap();
    run_in(folder.path(), &["run", "job.cif"])
}

/// A chain with a break (kN).
fn chain(breaking: u32) -> String {
    format!("100 EXACT -EMOD 50000 -B_TENSION {breaking}")
}

#[test]
fn line_far_too_short_for_its_ends_exits_with_3() {
    // 2200 ft away and 100 ft deep: hypot(2200, 100) / 2000 - 1 = 10.1 %; nothing gives its break
    let mut records =
        vec!["MEDIT", "&DESCRIBE BODY B", "*F 0 0 0", "~W B_CAT 4 -LEN 2000 -DEP 100", "CONNECTOR A -ANC 0 2200 ~W *F"];
    records.extend(["END", "&STATUS F_CONNECTOR"]);
    let arguments: Vec<&str> = records.into_iter().flat_map(|record| ["-c", record]).collect();
    let (code, _, err) = run(&arguments);
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("windlass: exit code 3: A is 10.1 per cent too short for its ends"), "{err}");
}

#[test]
fn tension_beyond_given_break_exits_with_3() {
    for asked in ["&EQUI", "&STATUS F_CONNECTOR", "TDOM"] {
        let (code, _, err) = run_moored(&chain(400), asked);
        assert_eq!(code, Some(3), "{asked}: {err}");
        assert!(err.contains("windlass: exit code 3: the tension of A is 1."), "{asked}: {err}");
        assert_eq!(run_moored(&chain(4000), asked).0, Some(0), "{asked}");
    }
}

#[test]
fn given_break_behind_more_loaded_bare_segment_exits_with_3() {
    // the bare wire of 5 mm is the critical segment, and the chain behind it was given a break that both exceed
    let bare = "5 EXACT -LEN 100 -BUOY 0 -WTPL 0.001 -EMOD 200000\n~C B_CAT";
    let (code, _, err) = run_moored(&format!("{bare} 100 EXACT -EMOD 50000 -B_TENSION 10"), "&STATUS F_CONNECTOR");
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("the break of its segment 2"), "{err}");
}

#[test]
fn action_that_never_fired_excuses_no_line_break() {
    let action = "&ACTION B1 -TENSION A 1E6 -RELEASE A B\nTDOM";
    assert_eq!(run_moored(&chain(400), action).0, Some(3));
}

#[test]
fn tension_beyond_break_is_reported_beside_a_wrong_record() {
    let (code, _, err) = run_moored(&chain(400), "&EQUI\n&BOGUS");
    assert_eq!(code, Some(1), "{err}");
    assert!(err.contains("warning: the tension of A is 1."), "{err}");
}

#[test]
fn output_folder_that_is_a_file_is_refused_before_job_runs() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("job.cif"), "&TYPE ran\n").unwrap();
    let (code, out, err) = run_in(folder.path(), &["--out", "job.cif", "job.cif"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert!(err.contains("--out job.cif: this is a file; name a folder"), "{err}");
}

#[test]
fn break_of_diameter_only_segment_never_exits_with_3() {
    // steel over 20 mm bears some 150 kN
    let (code, out, err) = run_moored("20 EXACT", "&EQUI\n&STATUS F_CONNECTOR");
    assert!(err.contains("beyond its breaking tension"), "{out}{err}");
    assert_eq!(code, Some(0), "{err}");
}

#[test]
fn sweeps_beyond_break_exit_with_0() {
    for asked in [
        "CONN_DESIGN\nTABLE A\nEND\nEND",
        "CONN_DESIGN\nMOVE RIG 0 -DISTANCE 40\nEND\nEND",
        "CONN_DESIGN\nWATCH RIG 100\nEND\nEND",
    ] {
        let (code, _, err) = run_moored(&chain(400), asked);
        assert_eq!(code, Some(0), "{asked}: {err}");
    }
}

#[test]
fn lines_released_by_action_do_not_exit_with_3() {
    let release = |lines: &str| run_moored(&chain(400), &format!("&ACTION B1 -TENSION A 400 -RELEASE {lines}\nTDOM"));
    let (code, _, err) = release("A");
    assert_eq!(code, Some(3), "{err}");
    assert!(err.contains("the tension of B is") && !err.contains("the tension of A is"), "{err}");
}

#[test]
fn missing_result_exits_with_1_and_a_message() {
    let (code, out, err) = run_moored(&chain(4000), "&ENV -DEPTH 5\n&STATUS F_CONNECTOR");
    assert_eq!(code, Some(1), "{out}{err}");
    assert!(err.contains("windlass: exit code 1: a result that was asked for does not exist"), "{err}");
}

#[test]
fn reserved_words_are_commands_and_such_a_root_needs_extension() {
    let folder = tempfile::tempdir().unwrap();
    let (code, _, err) = run_in(folder.path(), &["check"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("Usage: windlass check <SCRIPT>"), "{err}");
    std::fs::write(folder.path().join("d.dat"), "JOB TEST  NAUT  TIME\nTITLE\nOPTIONS REST END\nRESTART   4  5\n")
        .unwrap();
    let (code, out, err) = run_in(folder.path(), &["check", "d.dat"]);
    assert_eq!((code, err.contains("deck 0, JOB: `TIME` is no known analysis")), (Some(1), true), "{err}");
    assert!(out.contains("the deck has errors: what follows is not checked"), "{out}");
    let (code, _, err) = run_in(folder.path(), &["--batch", "check", "a.cif"]);
    assert_eq!(
        (code, err.as_str()),
        (Some(2), "windlass: check comes first, and takes a script: windlass check --compat model.cif\n")
    );
    let (code, _, err) = run_in(folder.path(), &["--batch", "manual", "docs"]);
    assert_eq!(
        (code, err.as_str()),
        (Some(2), "windlass: manual comes first, and takes a folder: windlass manual docs\n")
    );
    let (code, _, err) = run_in(folder.path(), &["--batch", "verify"]);
    assert_eq!((code, err.as_str()), (Some(2), "windlass: verify comes first: windlass verify --list\n"));
    std::fs::write(folder.path().join("run.cif"), "&TYPE mine\n&FINISH\n").unwrap();
    let (code, _, err) = run_in(folder.path(), &["run"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("the script run.cif has its name: write `./run` or `run.cif`"), "{err}");
    for job in [&["./run"][..], &["run.cif"], &["run", "run"], &["run", "run.cif"]] {
        assert_eq!(run_in(folder.path(), job), (Some(0), "mine\n".into(), String::new()), "{job:?}");
    }
    for words in [&["run"][..], &["--batch", "run"]] {
        let (code, _, err) = run_in(folder.path(), words);
        assert_eq!(code, Some(2));
        assert!(err.contains("run needs a JOB"), "{err}");
    }
    assert_eq!(run_in(folder.path(), &["--batch", "run", "run"]).1, "mine\n");
    assert!(run_in(folder.path(), &["-i", "report"]).2.contains("report comes first, and takes the folder of a study"));
    assert!(run_in(folder.path(), &["-i", "study"]).2.contains("study comes first, and takes a table and a script"));
    std::fs::create_dir(folder.path().join("run")).unwrap();
    let (_, _, err) = run_in(folder.path(), &["run"]);
    assert!(err.contains("write `run.cif` to run it") && !err.contains("./run"), "{err}");
    assert_eq!(run_in(folder.path(), &["./run"]).1, "mine\n");
    for (word, meant) in [("RUN", "run"), ("chek", "check")] {
        let (code, _, err) = run_in(folder.path(), &[word, "study.cif"]);
        assert_eq!(code, Some(2));
        assert!(err.contains(&format!("did you mean the command `{meant}`?")), "{err}");
    }
}

#[test]
fn man_page_and_completions_name_every_option() {
    let (code, page, err) = run(&["--man"]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    let (code, script, err) = run(&["--completions", "bash"]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    for option in ["batch", "interactive", "out", "allow-files", "man", "completions"] {
        assert!(page.contains(&format!("\\-\\-{}", option.replace('-', "\\-"))), "{option}: {page}");
        assert!(script.contains(&format!("--{option}")), "{option}: {script}");
    }
    // commands have no pages of their own: their options and exit codes are here
    for part in
        [".SH WINDLASS\\ FMT", "\\-\\-check", ".SH WINDLASS\\ STUDY", "with \\-\\-check, a script would be changed"]
    {
        assert!(page.contains(part), "{part}: {page}");
    }
    assert!(!page.contains("windlass\\-fmt(1)") && page.matches(".TH ").count() == 1, "{page}");
    let (code, _, err) = run(&["--completions", "dish"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("invalid value 'dish'") && err.contains("fish"), "{err}");
}

#[test]
fn manual_is_written_below_named_folder_or_refused_with_reason() {
    let folder = tempfile::tempdir().unwrap();
    let (code, out, err) = run_in(folder.path(), &["manual", "docs"]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    assert!(out.ends_with("pages below docs\n"), "{out}");
    assert!(std::fs::read_to_string(folder.path().join("docs/moses.md")).unwrap().starts_with("# MOSES scripts\n"));
    let page = folder.path().join("docs/reference/classes.md");
    let made = std::fs::read_to_string(&page).unwrap();
    // a page of an earlier version makes way, another file is kept
    std::fs::write(&page, made.replace("## ROD", "## BAR")).unwrap();
    std::fs::write(folder.path().join("docs/reference/status.md"), "notes of mine\n").unwrap();
    assert_eq!(run_in(folder.path(), &["manual", "docs"]).0, Some(0));
    assert_eq!(std::fs::read_to_string(&page).unwrap(), made);
    let names = std::fs::read_dir(folder.path().join("docs/reference")).unwrap().flatten();
    let kept = names.map(|entry| entry.file_name().into_string().unwrap()).filter(|name| !name.ends_with(".md"));
    assert_eq!(kept.collect::<Vec<_>>(), ["status.md.1"]);
    std::fs::write(folder.path().join("taken"), "").unwrap();
    let (code, _, err) = run_in(folder.path(), &["manual", "taken"]);
    assert_eq!(code, Some(1));
    assert!(err.starts_with("windlass: the manual cannot be written: taken"), "{err}");
    let (code, _, err) = run_in(folder.path(), &["manual"]);
    assert_eq!(code, Some(2));
    assert!(err.contains("Usage: windlass manual <DIR>"), "{err}");
}

#[test]
fn help_lists_exit_codes() {
    let (code, out, _) = run(&["--help"]);
    assert_eq!(code, Some(0));
    for line in
        ["  0    done", "  1    a record was wrong", "  2    wrong use", "  3    all results", "  130  interrupted"]
    {
        assert!(out.contains(line), "{out}");
    }
}

#[test]
fn questions_of_script_are_answered_by_lines_of_standard_input() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(
        folder.path().join("ask.cif"),
        "&SET A = &GET(LENGTH )\n&SET B = &GET(AGAIN YES/NO )\n&TYPE <%A|%B>\n",
    )
    .unwrap();
    let answer = |input: &str| {
        let mut child = Command::new(env!("CARGO_BIN_EXE_windlass"))
            .arg("ask.cif")
            .current_dir(folder.path())
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        child.stdin.take().unwrap().write_all(input.as_bytes()).unwrap();
        let done = child.wait_with_output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (done.status.code(), text(done.stdout), text(done.stderr))
    };
    let (code, out, err) = answer("120\nYES\n");
    assert_eq!((code, out.as_str()), (Some(0), "<120|YES>\n"));
    assert!(err.contains("LENGTH? ") && err.contains("AGAIN YES/NO? "), "{err}");
    let (code, _, err) = answer("120\n");
    assert!(code == Some(1) && err.contains("&GET got no answer"), "{code:?} {err}");
}
