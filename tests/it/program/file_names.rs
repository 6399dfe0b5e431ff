//! What a file name in a script means, that a bad one is refused where it is given, and that no file opened is lost.

use std::fs;
use std::process::{Command, Output};

/// Records that open the disposition menu of a short table.
const TABLE: &str = "MEDIT\n&DESCRIBE BODY B\n*P 0 0 0\n~W B_CAT 4 -LEN 4000 -DEP 500 -BUOY 0 -WTPL .04 -EMOD 12000\n\
                     CONNECTOR A ~W *P\nEND\nCONN_DESIGN\nTABLE A\n";
const TABLE_END: &str = "END\nEND\n";

struct ProcessRun {
    folder: tempfile::TempDir,
    code: Option<i32>,
    out: String,
    err: String,
}

impl ProcessRun {
    /// Runs a script `here/job.cif` from the folder `here`.
    fn start(script: &str, arguments: &[&str]) -> ProcessRun {
        let folder = tempfile::tempdir().unwrap();
        fs::create_dir(folder.path().join("here")).unwrap();
        ProcessRun::start_in(folder, script, arguments)
    }

    fn start_in(folder: tempfile::TempDir, script: &str, arguments: &[&str]) -> ProcessRun {
        let here = folder.path().join("here");
        fs::write(here.join("job.cif"), script).unwrap();
        let Output { status, stdout, stderr } = Command::new(env!("CARGO_BIN_EXE_windlass"))
            .arg("job.cif")
            .args(arguments)
            .current_dir(&here)
            .output()
            .unwrap();
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        ProcessRun { folder, code: status.code(), out: text(&stdout), err: text(&stderr) }
    }

    /// A file's text, its path taken from `here`.
    fn read(&self, path: &str) -> Option<String> {
        fs::read_to_string(self.folder.path().join("here").join(path)).ok()
    }

    /// The names in a folder, sorted.
    fn names(&self, path: &str) -> Vec<String> {
        let mut names: Vec<String> = fs::read_dir(self.folder.path().join("here").join(path))
            .unwrap()
            .map(|e| e.unwrap().file_name().into_string().unwrap())
            .collect();
        names.sort();
        names
    }
}

#[test]
fn relative_names_with_and_without_folders_are_inside_jobs_folder() {
    let script = format!(
        "&FILE MKDIR a/b\n&FILE OPEN T a/b/n.txt\n&FILE WRITE T one\n&FILE CLOSE T\n&FILE CP a/b/n.txt a/c.txt\n\
         &FILE MV a/c.txt d.txt\n&FILE CP d.txt e.txt\n&FILE RM e.txt\n{TABLE}STORE s X Force\nSTORE a/s X Force\n\
         STORE a/../b X Force\nPLOT X Force a/b/p.svg\nPLOT X Force -FILE a/p.png\n{TABLE_END}"
    );
    for (arguments, folder) in [(&[][..], "job.ans"), (&["--out", "answers"][..], "answers")] {
        let beside = tempfile::tempdir().unwrap();
        // folders of the same names beside the script are none of the job's
        fs::create_dir_all(beside.path().join("here/a/b")).unwrap();
        let run = ProcessRun::start_in(beside, &script, arguments);
        assert_eq!(run.code, Some(0), "{}", run.err);
        assert!(run.names(".").iter().all(|name| ["a", folder, "job.cif"].contains(&name.as_str())));
        assert_eq!((run.names("a"), run.names("a/b")), (vec!["b".to_string()], vec![]));
        assert_eq!(run.names(folder), ["LOG00001.TXT", "a", "b.csv", "d.txt", "s.csv"]);
        assert_eq!(run.names(&format!("{folder}/a")), ["b", "p.png", "s.csv"]);
        assert_eq!(run.names(&format!("{folder}/a/b")), ["n.txt", "p.svg"]);
        assert_eq!(run.read(&format!("{folder}/d.txt")).unwrap(), "one\n");
    }
}

#[test]
fn dotted_and_absolute_names_are_shell_paths() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("here/sub")).unwrap();
    let absolute = folder.path().join("absolute.txt");
    let script = format!(
        "&FILE OPEN T ./sub/n.txt\n&FILE CLOSE T\n&FILE OPEN T '{}'\n&FILE CLOSE T\n\
         {TABLE}STORE ./s X Force\nPLOT X Force ../p.svg\n{TABLE_END}&FILE MKDIR x\n&FILE MV ./job.ans/x ./job.ans/y\n",
        absolute.display()
    );
    let run = ProcessRun::start_in(folder, &script, &["--allow-files"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert_eq!(run.names("."), ["job.ans", "job.cif", "s.csv", "sub"]);
    assert_eq!(run.names(".."), ["absolute.txt", "here", "p.svg"]);
    assert_eq!(
        (run.names("sub"), run.names("job.ans")),
        (vec!["n.txt".into()], vec!["LOG00001.TXT".into(), "y".into()])
    );
}

#[test]
fn outside_file_is_never_overwritten_and_needs_allow_files() {
    let script = format!(
        "{TABLE}STORE ./job.cif X Force\n{TABLE_END}&FILE RM ./job.cif\n&FILE CP ./job.cif ./copy\n\
         &FILE MV ./job.cif moved\n&FILE MKDIR ../new\n"
    );
    let run = ProcessRun::start(&script, &[]);
    assert_eq!(run.code, Some(1));
    assert_eq!(run.err.matches("--allow-files lifts this").count(), 5, "{}", run.err);
    assert_eq!((run.names("."), run.names("..")), (vec!["job.ans".into(), "job.cif".into()], vec!["here".into()]));
    assert_eq!(run.read("job.cif").unwrap(), script);
    let run = ProcessRun::start(&format!("{TABLE}STORE ./job.cif X Force\n{TABLE_END}"), &["--allow-files"]);
    assert_eq!((run.code, run.err.matches("no file is overwritten").count()), (Some(1), 1), "{}", run.err);
    let script = "&FILE CP ./job.cif ./copy\n&FILE CP ./copy copy\n&FILE MV ./copy ../moved\n&FILE MKDIR ./new\n";
    let run = ProcessRun::start(script, &["--allow-files"]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    assert_eq!(
        (run.names("."), run.names("..")),
        (vec!["job.ans".into(), "job.cif".into(), "new".into()], vec!["here".into(), "moved".into()])
    );
    assert_eq!(run.read("job.ans/copy").unwrap(), script);
}

#[test]
fn climbing_relative_name_is_refused_even_with_allow_files() {
    let script = format!(
        "&DEVICE -LIMERROR 99\n&FILE MKDIR a\n&FILE OPEN T a/../../x\n&FILE MKDIR a/../../x\n&FILE RM a/../../job.cif\n\
         &FILE MV a/../../job.cif x\n&FILE CP a a/../../x\n&FILE OPEN T a/..\n&FILE ANS_DIRECTORY a/../../x\n\
         {TABLE}STORE a/../../x X Force\nPLOT X Force a/../../x.svg\n{TABLE_END}"
    );
    for arguments in [&[][..], &["--allow-files"]] {
        let run = ProcessRun::start(&script, arguments);
        assert_eq!(run.code, Some(1));
        assert_eq!(run.err.matches("leads to nothing below the job's own folder").count(), 9, "{}", run.err);
        assert_eq!(run.err.matches("begins with ./ or ../").count(), 9, "{}", run.err);
        assert_eq!(run.names("."), ["job.ans", "job.cif"]);
        assert_eq!(run.names("job.ans"), ["LOG00001.TXT", "a"]);
    }
}

#[test]
fn unwritable_file_fails_at_open() {
    let refused = |name: &str, why: &str| {
        let script = format!("&FILE MKDIR sub\n&FILE OPEN T {name}\n&FILE WRITE T lost\n");
        let run = ProcessRun::start(&script, &["--allow-files"]);
        assert_eq!(run.code, Some(1));
        assert!(run.err.contains(why) && run.err.contains("--> job.cif:2:14"), "{name}: {}", run.err);
        assert!(run.err.contains("no file of type T is open"), "{name}: {}", run.err);
        assert_eq!((run.names("."), run.names("job.ans/sub")), (vec!["job.ans".into(), "job.cif".into()], vec![]));
    };
    refused("none/x.txt", "there is no folder");
    refused("./none/x.txt", "there is no folder");
    refused("/no/such/folder/x.txt", "there is no folder");
    refused("./job.cif/x.txt", "there is no folder");
    refused("./job.cif", "exists already");
    refused("sub", "is a directory");
    refused("new/", "is a directory");
    refused(&"n".repeat(300), "too long");
    #[cfg(target_os = "linux")]
    refused("/proc/x.txt", "/proc/x.txt: ");
}

#[test]
fn file_never_closed_is_written_whole_and_named_at_any_end() {
    let body = "&FILE OPEN NOTE n.txt\n&FILE OPEN OUT ./o.txt\n&FILE WRITE NOTE one\n&FILE WRITE OUT two\n&FILE WRITE NOTE three\n";
    for (end, arguments, code) in [
        ("", &[][..], 0),
        ("&FINISH\n", &[], 0),
        ("&ERROR FATAL no more\n", &[], 1),
        ("NONSENSE\n&TYPE x\n", &["--batch"], 1),
        (&*"NONSENSE\n".repeat(30), &[], 1),
        ("&FILE ANS_DIRECTORY other\n", &[], 0),
    ] {
        let run = ProcessRun::start(&format!("{body}{end}"), &[arguments, &["--allow-files"]].concat());
        assert_eq!(run.code, Some(code), "{end}: {}", run.err);
        assert_eq!(run.read("job.ans/n.txt").as_deref(), Some("one\nthree\n"), "{end}");
        assert_eq!(run.read("o.txt").as_deref(), Some("two\n"), "{end}");
        for (name, position) in [("job.ans/n.txt", "job.cif:1:17"), ("./o.txt", "job.cif:2:16")] {
            let note = format!("note: {name} was not closed and is written as it stands");
            assert!(run.err.contains(&note) && run.err.contains(position), "{end}: {}", run.err);
        }
    }
}

#[test]
fn reopened_type_writes_pending_output_and_file_has_one_type() {
    let run = ProcessRun::start(
        "&FILE OPEN T a.txt\n&FILE WRITE T first\n&FILE OPEN T a.txt\n&FILE WRITE T second\n&FILE OPEN U a.txt\n\
         &FILE CLOSE T\n",
        &[],
    );
    assert!(run.err.contains("a.txt was not closed") && run.err.contains("is open already, as type T"), "{}", run.err);
    assert_eq!(run.names("job.ans"), ["LOG00001.TXT", "a.txt", "a.txt.1"]);
    let read = |name: &str| run.read(&format!("job.ans/{name}")).unwrap();
    assert_eq!((read("a.txt"), read("a.txt.1")), ("second\n".into(), "first\n".into()));
}

#[test]
fn file_that_cannot_be_written_at_end_is_error() {
    let run = ProcessRun::start("&FILE OPEN T a.txt\n&FILE WRITE T x\n&FILE MKDIR a.txt\n", &[]);
    assert_eq!(run.code, Some(1));
    assert!(run.err.contains("a.txt: is a directory") && run.err.contains("job.cif:1:14"), "{}", run.err);
}

#[test]
fn help_of_file_states_the_name_rule() {
    let run = ProcessRun::start("&HELP &FILE\n", &[]);
    let text = run.out.split_whitespace().collect::<Vec<_>>().join(" ");
    assert!(text.contains("a relative name, with folders or without, is inside the job's own folder"), "{text}");
}

#[test]
fn running_log_and_open_files_are_neither_removed_nor_moved() {
    let script = format!(
        "&DEVICE -LIMERROR 99\n&FILE OPEN T a.txt\n&FILE CLOSE T\n&FILE OPEN T a.txt\n&FILE CP LOG00001.TXT copy\n\
         &FILE USE U copy\n&FILE RM LOG00001.TXT\n&FILE MV LOG00001.TXT b.txt\n&FILE RM ./job.ans/../job.ans/LOG00001.TXT\n\
         &FILE OPEN V LOG00001.TXT\n{TABLE}STORE LOG00001.TXT X Force\n{TABLE_END}&FILE RM a.txt\n&FILE MV copy c\n\
         &TYPE the log goes on\n&FILE CLOSE T\n&FILE RM a.txt.1\n&FILE CLOSE U\n&FILE RM copy\n"
    );
    for arguments in [&[][..], &["--allow-files"]] {
        let run = ProcessRun::start(&script, arguments);
        assert_eq!(run.err.matches("is in use: this job has it open").count(), 7, "{}", run.err);
        assert_eq!(run.err.matches("error: ").count(), 7, "{}", run.err);
        assert!(run.err.contains("job.cif:8:10") && run.err.contains("&FILE CLOSE U closes it"), "{}", run.err);
        assert_eq!(run.names("job.ans"), ["LOG00001.TXT", "a.txt"]);
        assert!(run.read("job.ans/LOG00001.TXT").unwrap().contains("the log goes on"));
    }
}

#[test]
fn script_reads_back_its_own_file_by_same_name() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("here")).unwrap();
    fs::write(folder.path().join("here/n.txt"), "beside the script\n").unwrap();
    fs::write(folder.path().join("here/only.txt"), "only beside\n").unwrap();
    let script = "&FILE OPEN T n.txt\n&FILE WRITE T mine\n&FILE CLOSE T\n&FILE MKDIR sub\n&FILE CP n.txt sub/m.txt\n\
                  &FILE USE R n.txt\n&IF &F_READ(R LINE) &THEN\n&ENDIF\n&TYPE <%LINE%>\n\
                  &FILE USE R sub/m.txt\n&IF &F_READ(R LINE) &THEN\n&ENDIF\n&TYPE <%LINE%>\n\
                  &FILE USE R ./n.txt\n&IF &F_READ(R LINE) &THEN\n&ENDIF\n&TYPE <%LINE%>\n\
                  &FILE USE R only.txt\n&IF &F_READ(R LINE) &THEN\n&ENDIF\n&TYPE <%LINE%>\n\
                  &TYPE &INFO(FILE_EXISTS sub/m.txt) &INFO(FILE_EXISTS only.txt) &INFO(FILE_EXISTS m.txt)\n";
    let run = ProcessRun::start_in(folder, script, &[]);
    assert_eq!(run.code, Some(0), "{}", run.err);
    let want = "<mine>\n<mine>\n<beside the script>\n<only beside>\n.TRUE. .TRUE. .FALSE.";
    assert!(run.out.contains(want), "{}", run.out);
}

#[cfg(unix)]
#[test]
fn open_plot_and_store_write_nothing_through_link_out_of_folder() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir_all(folder.path().join("here/job.ans")).unwrap();
    fs::create_dir(folder.path().join("out")).unwrap();
    std::os::unix::fs::symlink(folder.path().join("out"), folder.path().join("here/job.ans/link")).unwrap();
    let script = format!("&FILE OPEN T link/x\n{TABLE}STORE link/s X Force\nPLOT X Force link/p.svg\n{TABLE_END}");
    let run = ProcessRun::start_in(folder, &script, &[]);
    assert_eq!(run.err.matches("is not below the job's own folder").count(), 3, "{}", run.err);
    assert!(run.names("../out").is_empty());
}

#[test]
fn refused_copy_or_move_points_at_offending_name() {
    let script = "&FILE OPEN T h.txt\n&FILE CLOSE T\n&FILE CP h.txt ./new.txt\n&FILE MV h.txt ./new.txt\n&FILE CP h.txt h.txt\n\
                  &FILE CP none new.txt\n&FILE MV ./job.cif new.txt\n&FILE CP h.txt none/x\n";
    let run = ProcessRun::start(script, &[]);
    for position in ["job.cif:3:16", "job.cif:4:16", "job.cif:5:16", "job.cif:6:10", "job.cif:7:10", "job.cif:8:16"] {
        assert!(run.err.contains(position), "{position}: {}", run.err);
    }
}

/// Runs the program in a folder with this on its standard input.
fn run_fed(here: &std::path::Path, arguments: &[&str], input: &str) -> Output {
    let file = here.join("input");
    fs::write(&file, input).unwrap();
    let stdin = fs::File::open(&file).unwrap();
    Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(here).stdin(stdin).output().unwrap()
}

#[test]
fn untyped_record_makes_no_file_outside_job_folder() {
    let folder = tempfile::tempdir().unwrap();
    let (home, here) = (folder.path().join("home"), folder.path().join("home/here"));
    fs::create_dir_all(&here).unwrap();
    let lines = "id,x_m,z_m,length_m,EA_N,w_N_per_m\n1,400,100,500,1e9,1000\n";
    let outside = home.join(".bash_login");
    let records = format!(
        "&FILE OPEN T ../.bash_login\n&FILE OPEN T {}\n&FILE OPEN T ~/../x\n&FILE OPEN T ./n\n&FILE MKDIR ../.ssh\n&FILE CP ./lines.csv ../n\n{TABLE}STORE ../s X Force\n\
         PLOT X Force ../p.svg\n&PICTURE -FILE ../p.png\nEND\nLINES lines.csv ../out.csv\nEND\n",
        outside.display()
    );
    let files = [
        ("lines.csv", lines.to_string()),
        ("records.cif", records.clone()),
        ("inserted.cif", "&INSERT records.cif\n".into()),
        ("called.cif", format!("&MACRO M\n{records}&ENDMACRO\nM\n")),
        ("job.dat", records.clone()),
        ("model.cif", "INMODEL\n".into()),
    ];
    for (name, text) in &files {
        fs::write(here.join(name), text).unwrap();
    }
    fs::write(here.join("input"), "").unwrap();
    let before = || {
        let mut names: Vec<_> = fs::read_dir(&home).unwrap().map(|e| e.unwrap().file_name()).collect();
        names.extend(fs::read_dir(&here).unwrap().map(|e| e.unwrap().file_name()));
        names.retain(|name| !name.to_string_lossy().ends_with(".ans"));
        names.sort();
        names
    };
    let there = before();
    let by_c: Vec<&str> = records.lines().flat_map(|record| ["-c", record]).collect();
    let limit = "&DEVICE -LIMERROR 99\n";
    let ways: [(&[&str], String); 6] = [
        (&["records.cif"], String::new()),
        (&["inserted.cif"], String::new()),
        (&["called.cif"], String::new()),
        (&by_c, String::new()),
        (&["-"], format!("{limit}{records}")),
        (&["-i", "-c", limit], records.clone()),
    ];
    for (arguments, input) in ways {
        let done = run_fed(&here, arguments, &input);
        let err = String::from_utf8_lossy(&done.stderr);
        assert_eq!(done.status.code(), Some(1), "{arguments:?}: {err}");
        assert!(err.matches("--allow-files lifts this").count() >= 7, "{arguments:?}: {err}");
        assert_eq!(before(), there, "{arguments:?}");
    }
}

#[cfg(unix)]
#[test]
fn linked_answers_folder_is_refused_unless_named_by_out() {
    let folder = tempfile::tempdir().unwrap();
    let (here, victim) = (folder.path().join("here"), folder.path().join("victim"));
    fs::create_dir(&here).unwrap();
    fs::create_dir(&victim).unwrap();
    fs::write(victim.join("x"), "mine").unwrap();
    for link in ["job.ans", "windlass.ans"] {
        std::os::unix::fs::symlink(&victim, here.join(link)).unwrap();
    }
    fs::write(here.join("job.cif"), "&FILE RM x\n&FILE MKDIR y\n&FILE OPEN T z\n&FILE MV x w\n").unwrap();
    for arguments in [&["job.cif"][..], &["job"], &["-c", "&FILE RM x", "-c", "&FILE OPEN T ./windlass.ans/z"]] {
        let done = run_fed(&here, arguments, "");
        let err = String::from_utf8_lossy(&done.stderr);
        assert_eq!(done.status.code(), Some(2), "{arguments:?}: {err}");
        assert!(err.contains(".ans is a link") && err.contains("--out DIR names"), "{err}");
        assert_eq!(fs::read_dir(&victim).unwrap().count(), 1);
    }
    fs::write(here.join("job.cif"), "&FILE MKDIR y\n&FILE OPEN T z\n&FILE MV x w\n").unwrap();
    let done = run_fed(&here, &["job.cif", "--out", "job.ans"], "");
    assert_eq!(done.status.code(), Some(0), "{}", String::from_utf8_lossy(&done.stderr));
    assert!(victim.join("w").exists() && victim.join("y").is_dir() && victim.join("z").exists());
}

#[test]
fn file_read_outside_script_folder_is_in_log() {
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("here")).unwrap();
    for (name, text) in [("out.cif", "&TYPE from outside\n"), ("out.txt", "x\n"), ("here/in.txt", "y\n")] {
        fs::write(folder.path().join(name), text).unwrap();
    }
    let run = ProcessRun::start_in(
        folder,
        "&INSERT ../out.cif\n&FILE USE T ../out.txt\n&FILE USE U in.txt\n&FILE USE U ../out.txt\n",
        &[],
    );
    assert_eq!(run.code, Some(0), "{}", run.err);
    let log = run.read("job.ans/LOG00001.TXT").unwrap();
    let read_notes: Vec<&str> = log.lines().filter(|line| line.contains("outside of the script's folder")).collect();
    assert_eq!(read_notes.len(), 2, "{log}");
    assert!(
        read_notes[0].contains("out.cif")
            && read_notes[1].contains("out.txt")
            && read_notes.iter().all(|t| t.starts_with("read "))
    );
    assert!(!run.out.contains("outside of the script's folder"));
}

#[cfg(unix)]
#[test]
fn special_file_is_refused_without_blocking_wherever_read() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path().join("here");
    fs::create_dir(&here).unwrap();
    assert!(Command::new("mkfifo").arg(here.join("pipe")).status().unwrap().success());
    let proc = if cfg!(target_os = "linux") { "&FILE USE T /proc/kmsg\n&FILE USE T /proc/self/environ\n" } else { "" };
    let script = format!(
        "&DEVICE -LIMERROR 99\n&FILE USE T pipe\n&FILE USE T /dev/zero\n&INSERT pipe\nINMODEL -AQWA pipe\n\
         CONN_DESIGN\nLINES pipe out.csv\nEND\n{proc}&BUILDG -CSV pipe\n"
    );
    let run = ProcessRun::start_in(folder, &script, &[]);
    assert_eq!(run.code, Some(1));
    assert!(
        run.err.matches("error: ").count()
            >= script.lines().filter(|l| l.contains("pipe") || l.contains("USE")).count(),
        "{}",
        run.err
    );
    let run = ProcessRun::start(if proc.is_empty() { "X\n" } else { proc }, &[]);
    assert_eq!(run.err.matches("this is not a regular file").count(), proc.lines().count(), "{}", run.err);
}

#[cfg(target_os = "linux")]
#[test]
fn failed_output_exits_with_1_and_reason_and_closed_pipe_is_quiet() {
    let folder = tempfile::tempdir().unwrap();
    let program = || {
        let mut command = Command::new(env!("CARGO_BIN_EXE_windlass"));
        command.current_dir(folder.path());
        command
    };
    for arguments in [&["-c", "&TYPE x"][..], &["-c", "&TYPE x", "--out", "answers"], &["--help"], &["--version"]] {
        let full = fs::OpenOptions::new().write(true).open("/dev/full").unwrap();
        let done = program().args(arguments).stdout(full).output().unwrap();
        let err = String::from_utf8_lossy(&done.stderr);
        assert_eq!(done.status.code(), Some(1), "{arguments:?}: {err}");
        assert_eq!(err.matches("standard output cannot be written: No space left on device").count(), 1, "{err}");
    }
    let mut child = program()
        .args(["-c", "&TYPE x"])
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    drop(child.stdout.take());
    let done = child.wait_with_output().unwrap();
    assert_eq!((done.status.code(), done.stderr.len()), (Some(0), 0), "{}", String::from_utf8_lossy(&done.stderr));
}

#[cfg(unix)]
#[test]
fn answers_folder_deleted_during_run_is_error_with_its_name() {
    use std::io::{BufRead, Write};
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_windlass"))
        .args(["-i", "-c", "&TYPE begun", "--out", "answers"])
        .current_dir(folder.path())
        .stdin(std::process::Stdio::piped())
        .stdout(std::process::Stdio::piped())
        .stderr(std::process::Stdio::piped())
        .spawn()
        .unwrap();
    let mut line = String::new();
    std::io::BufReader::new(child.stdout.take().unwrap()).read_line(&mut line).unwrap();
    assert_eq!(line, "begun\n");
    fs::remove_dir_all(folder.path().join("answers")).unwrap();
    child.stdin.take().unwrap().write_all(b"&FILE OPEN T x\n").unwrap();
    let done = child.wait_with_output().unwrap();
    let err = String::from_utf8_lossy(&done.stderr);
    assert_eq!(done.status.code(), Some(1), "{err}");
    assert!(err.contains("the answers folder answers was deleted while the job ran"), "{err}");
    assert!(err.contains("LOG00001.TXT was deleted while the job ran"), "{err}");
}

#[test]
fn terminal_control_characters_are_escaped_wherever_printed() {
    // OSC 52 (the clipboard), clear screen, C1, a right-to-left override; a script of MS-DOS shows none of its line ends
    let bad = "\u{1b}]52;c;AA\u{7}\u{1b}[2J\u{9b}31m\u{202e}";
    let script = format!(
        "&TITLE {bad}t\r\n&TYPE a{bad}\r\n&CTYPE {bad}c\r\n&SET V = {bad}v\r\n&TYPE %V%\r\n{bad}\r\n&FILE USE T {bad}none\r\n\
         &DEVICE -OECHO\r\n&ERROR WARNING {bad}w\r\nMEDIT\r\n*P{bad} 0 0 0\r\n&ENV -DEPTH {bad}\r\n",
    );
    let folder = tempfile::tempdir().unwrap();
    fs::create_dir(folder.path().join("here")).unwrap();
    let run = ProcessRun::start_in(folder, &script, &[]);
    assert_eq!(run.code, Some(1));
    let log = run.read("job.ans/LOG00001.TXT").unwrap();
    for text in [&run.out, &run.err, &log] {
        assert!(text.chars().all(|c| c == '\n' || (!c.is_control() && c != '\u{202e}')), "{text:?}");
    }
    let spelled = r"a\u{1b}]52;c;AA\u{7}\u{1b}[2J\u{9b}31m\u{202e}";
    assert!(run.out.lines().any(|line| line == spelled), "{}", run.out);
    assert!(!run.out.contains(r"\u{d}") && !run.err.contains(r"\u{d}"), "{}{}", run.out, run.err);
}
