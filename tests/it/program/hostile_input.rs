//! Input nobody should send: each ends in an error that names the place, and the session goes on to the next record.

use std::io::Write;
use std::process::{Command, Output, Stdio};

const AFTER: &str = "\n&TYPE still here\n";

/// Runs bytes as a script from standard input, in a folder of its own.
fn run(bytes: &[u8]) -> (Output, String, String) {
    let folder = tempfile::tempdir().unwrap();
    let mut child = Command::new(env!("CARGO_BIN_EXE_windlass"))
        .arg("-")
        .current_dir(folder.path())
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap();
    let mut stdin = child.stdin.take().unwrap();
    let bytes = bytes.to_vec();
    let writer = std::thread::spawn(move || {
        let _ = stdin.write_all(&bytes);
    });
    let output = child.wait_with_output().unwrap();
    writer.join().unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout).into(), String::from_utf8_lossy(&output.stderr).into());
    (output, out, err)
}

fn assert_refused(script: &str, message: &str) {
    let (output, out, err) = run(format!("{script}{AFTER}").as_bytes());
    assert_eq!(output.status.code(), Some(1), "{err}");
    assert!(err.contains(message), "{message} is missing from\n{}", &err[..err.len().min(2000)]);
    assert!(out.contains("still here"), "the session did not go on: {err}");
    assert!(err.len() < 100_000, "a message of {} bytes", err.len());
}

#[test]
fn line_of_ten_megabytes_is_error() {
    assert_refused(&"A".repeat(10 << 20), "characters; at most");
    assert_refused(&format!("&TYPE {}", "word ".repeat(2 << 20)), "characters; at most");
}

#[test]
fn endlessly_continued_record_is_error() {
    assert_refused(&"&TYPE x \\\n".repeat(1 << 20), "characters; at most");
    let (_, _, err) = run(b"&TYPE x \\");
    assert!(err.contains("ends inside a record that is continued"), "{err}");
}

#[test]
fn binary_input_is_error() {
    let (output, _, err) = run(&[0x7f, b'E', b'L', b'F', 0, 1, 2, 255]);
    assert_eq!(output.status.code(), Some(1));
    assert!(err.contains("the byte 0x00 is not text") && err.contains("standard input:1:5"), "{err}");
    assert_eq!(err.matches("is not text").count(), 1, "one error of a line: {err}");
    let (output, out, err) =
        run(b"\xef\xbb\xbf&TYPE one\n&TYPE caf\xc3\xa9\xff\xfe\r\n&TYPE two\n$ \xe9\n&TYPE a\0b\n&TYPE three");
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(out.lines().collect::<Vec<_>>(), ["one", "two", "three"], "{err}");
    for (byte, position) in [("0xFF", "2:11"), ("0xE9", "4:3"), ("0x00", "5:8")] {
        let (message, position) = (format!("the byte {byte} is not text"), format!("standard input:{position}"));
        assert!(err.contains(&message) && err.contains(&position), "{message} at {position}: {err}");
    }
    assert_eq!(err.matches("error:").count(), 3, "{err}");
    assert!(err.contains("&TYPE caf\u{e9}\u{fffd}\u{fffd}"), "what was read is shown: {err}");
}

#[test]
fn record_continued_over_bad_line_is_one_error_and_is_not_run() {
    let (output, out, err) = run(b"&TYPE one \\\n\xff two \\\n&TYPE three\n&TYPE four\n");
    assert_eq!((output.status.code(), out.as_str()), (Some(1), "four\n"), "{err}");
    assert!(err.contains("standard input:2:1") && err.matches("error:").count() == 1, "{err}");
}

#[test]
fn binary_lines_are_errors_and_other_lines_run() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, bytes: &[u8]| std::fs::write(folder.path().join(name), bytes).unwrap();
    write(
        "job.cif",
        b"&TYPE a\n\xff\n&INSERT in.cif\nINMODEL\n&TYPE d\nMEDIT\n*R 1 1 1\nEND\n&TYPE %(&NAMES(POINTS))\n",
    );
    write("in.cif", b"&TYPE b\n  \0\n&TYPE c\n");
    write("job.dat", b"*P 0 0 0\n*Q 0 0 \xc3\n*S 0 0 0\n");
    let run = |arguments: &[&str]| {
        Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(folder.path()).output().unwrap()
    };
    let output = run(&["job.cif"]);
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(1));
    assert!(["a", "b", "c", "d"].iter().all(|word| out.lines().any(|l| l == *word)), "{out}{err}");
    for position in ["job.cif:2:1", "in.cif:2:3", "job.dat:2:8"] {
        assert!(err.contains(position), "{position}: {err}");
    }
    assert_eq!(err.matches("is not text").count(), 3, "{err}");
    let output = run(&["--batch", "job.cif"]);
    assert_eq!((output.status.code(), &*output.stdout), (Some(1), &b"a\n"[..]), "--batch stops at the bad line");
}

#[test]
fn binary_lines_of_pipe_are_errors_and_others_run() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bad.cif"), b"\xff\n".repeat(1000)).unwrap();
    let input = folder.path().join("input");
    std::fs::write(&input, b"&TYPE a\n&TYPE \xff\n&TYPE b \\\n c\n&INSERT bad.cif\n&TYPE \0\n&TYPE d").unwrap();
    let output = Command::new(env!("CARGO_BIN_EXE_windlass"))
        .args(["-i", "-c", "&TYPE first"])
        .current_dir(folder.path())
        .stdin(std::fs::File::open(&input).unwrap())
        .output()
        .unwrap();
    let (out, err) = (String::from_utf8_lossy(&output.stdout), String::from_utf8_lossy(&output.stderr));
    assert_eq!(output.status.code(), Some(1));
    assert_eq!(out.lines().collect::<Vec<_>>(), ["first", "a", "b   c", "d"], "{err}");
    for (position, count) in
        [("terminal:2:7", 1), ("terminal:6:7", 1), ("bad.cif:", 10), ("what was being read is given up", 1)]
    {
        assert_eq!(err.matches(position).count(), count, "{position}: {err}");
    }
}

#[test]
fn huge_binary_file_stops_at_error_limit_in_seconds() {
    // a generator of no statistical merit: bytes of every value, 64 MB
    let mut state = 1u32;
    let noise: Vec<u8> = std::iter::repeat_with(|| {
        state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (state >> 24) as u8
    })
    .take(64 << 20)
    .collect();
    for bytes in [noise, b"\xff\n".repeat(16 << 20), vec![0; 64 << 20]] {
        let started = std::time::Instant::now();
        let (output, _, err) = run(&bytes);
        assert_eq!(output.status.code(), Some(1));
        assert!((1..=10).contains(&err.matches("error:").count()) && err.len() < 20_000, "{} bytes", err.len());
        assert!(started.elapsed().as_secs() < 20, "{:?}", started.elapsed());
    }
}

#[test]
fn endless_nesting_is_error() {
    let deep = |n: usize| format!("{}1{}", "(".repeat(n), ")".repeat(n));
    assert_refused(&format!("&ENV -DEPTH {}", deep(10_000)), "too deeply nested");
    assert_refused(&format!("&TYPE x {}1{}", "&NUMBER(REAL ".repeat(10_000), ")".repeat(10_000)), "nested deeper");
    assert_refused(&format!("&IF {} .TRUE. &THEN\n&ENDIF", ".NOT. ".repeat(100_000)), "nested too deeply");
    assert_refused(&"&IF .TRUE. &THEN\n".repeat(50_000), "not closed");
}

#[test]
fn self_inserting_file_ends_in_error() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("me.cif"), "&INSERT me.cif\n").unwrap();
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).arg("me.cif").current_dir(folder.path()).output().unwrap();
    let err = String::from_utf8_lossy(&run.stderr);
    assert_eq!(run.status.code(), Some(1));
    assert!(err.contains("does the file insert itself?"), "{err}");
}

#[test]
fn endless_macros_and_loops_end_in_error() {
    assert_refused("&MACRO M\nM\n&ENDMACRO\nM", "macros call each other deeper than");
    let (output, out, err) = run(b"&DEVICE -RECORDS 5000\n&LOOP\n&SET A = 1\n&ENDLOOP\n&TYPE after\n");
    assert_eq!(output.status.code(), Some(1));
    assert!(err.contains("has executed its 5000 records"), "{err}");
    assert!(!out.contains("after"));
    let (_, _, err) = run(b"&LOOP\n&ENDLOOP\n");
    assert!(err.contains("has executed its 2000000 records"), "{err}");
}

#[test]
fn variable_doubled_repeatedly_is_error() {
    assert_refused("&SET A = xxxxxxxx\n&LOOP I 1 9\n&SET A = %A%%A%%A%%A%%A%%A%%A%%A%\n&ENDLOOP", "longer than");
}

#[test]
fn numbers_out_of_all_bounds_are_errors() {
    for word in ["1E400", "9**9**9**9", "1/0", "0**(-1)", "(-1)**0.5", "LN(0)", "1E308*1E308", "--", "((", "1..2", "é"]
    {
        assert_refused(&format!("&ENV -DEPTH {word}"), "must be");
    }
}

#[test]
fn odd_characters_are_handled_anywhere() {
    for script in
        ["&TYPE %(", "&TYPE %()", "&TYPE &POINT(", "~", "*", ":", "#", "&", "-", "%", ",,,,", "'", "\"", "\\ x"]
    {
        let (output, out, err) = run(format!("{script}{AFTER}").as_bytes());
        assert!(output.status.code().is_some(), "{script} crashed: {err}");
        assert!(out.contains("still here"), "{script}: {err}");
    }
}

#[test]
fn after_ten_errors_script_ends_and_batch_ends_at_first() {
    let (_, _, err) = run("NONSENSE\n".repeat(50).as_bytes());
    assert_eq!(err.matches("unknown command").count(), 10, "{err}");
    let run = Command::new(env!("CARGO_BIN_EXE_windlass"))
        .args(["--batch", "-c", "NONSENSE", "-c", "&TYPE never"])
        .output()
        .unwrap();
    assert_eq!(run.status.code(), Some(1));
    assert!(run.stdout.is_empty());
}

#[test]
fn exit_codes_distinguish_correct_wrong_and_misused_runs() {
    let code = |args: &[&str]| Command::new(env!("CARGO_BIN_EXE_windlass")).args(args).output().unwrap().status.code();
    assert_eq!(code(&["-c", "&TYPE x"]), Some(0));
    assert_eq!(code(&["-c", "NONSENSE"]), Some(1));
    assert_eq!(code(&["no_such_file.cif"]), Some(2));
    assert_eq!(code(&["--no-such-flag"]), Some(2));
}
