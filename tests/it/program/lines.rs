//! LINES as a user runs it: the exact answers of catenary_2000.csv through files and commands, what goes through and what
//! is added, rows that are refused, names of files, Ctrl-C.

use std::fs;
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_base::diagnostic::Severity;
use windlass_catenary::{FlatBottom, Segment};

const HEAD: &str = "id,x_m,z_m,length_m,EA_N,w_N_per_m";
const GOOD: &str = "g,850,155,914,6.5E6,196";
const ADDED: &str = "fairlead_H_N,fairlead_V_N,anchor_H_N,anchor_V_N,grounded_length_m,regime,residual,error";

fn session(folder: &Path) -> Session {
    let job = JobFolder::new(folder.join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.keep_reports = true;
    session
}

/// Runs records in the menu; the messages.
fn run(folder: &Path, records: &str) -> Vec<String> {
    let mut session = session(folder);
    session.open("script", format!("CONN_DESIGN\n{records}\nEND\n"));
    session.run();
    assert!(session.reports.iter().all(|r| !r.message.contains("defect")));
    session.reports.iter().map(|r| [std::slice::from_ref(&r.message), &r.help].concat().join("; ")).collect()
}

/// Solves a text; the messages, and the file made of it, if any.
fn solve(text: impl AsRef<[u8]>) -> (Vec<String>, Option<String>) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("in.csv"), text).unwrap();
    let messages = run(folder.path(), "LINES in.csv out");
    (messages, fs::read_to_string(folder.path().join("job.ans/out.csv")).ok())
}

fn names(folder: &Path) -> Vec<String> {
    let Ok(entries) = fs::read_dir(folder) else { return Vec::new() };
    let mut names: Vec<String> = entries.map(|e| e.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn all_2000_lines_match_exact_answers_to_1e_8_through_program() {
    let folder = tempfile::tempdir().unwrap();
    fs::copy("tests/data/catenary_2000.csv", folder.path().join("in.csv")).unwrap();
    assert_eq!(run(folder.path(), "LINES in.csv out"), Vec::<String>::new());
    let mut reader = csv::Reader::from_path(folder.path().join("job.ans/out.csv")).unwrap();
    let heads = reader.headers().unwrap().clone();
    let at = |name: &str| heads.iter().position(|h| h == name).unwrap_or_else(|| panic!("no column {name}"));
    let (mut rows, mut worst) = (0, 0.0_f64);
    for record in reader.records() {
        let record = record.unwrap();
        let number = |name: &str| record[at(name)].parse::<f64>().unwrap();
        let tension = number("fairlead_H_N_in").hypot(number("fairlead_V_N_in")).max(f64::MIN_POSITIVE);
        for name in ["fairlead_H_N", "fairlead_V_N", "anchor_H_N", "anchor_V_N"] {
            worst = worst.max((number(name) - number(&format!("{name}_in"))).abs() / tension);
        }
        let grounded = (number("grounded_length_m") - number("grounded_length_m_in")).abs() / number("length_m");
        assert!(grounded < 1e-7, "{}: grounded {grounded:.1e}", &record[0]);
        assert_eq!(&record[at("regime")], &record[at("regime_in")], "{}", &record[0]);
        assert!(number("residual") <= 1e-9 * tension || number("residual") < 1e-9, "{}", &record[0]);
        assert_eq!(&record[at("error")], "");
        rows += 1;
    }
    assert_eq!(rows, 2000);
    assert!(worst <= 1e-8, "{worst:.2e}");
    println!("largest error {worst:.2e}");
}

#[test]
fn columns_keep_order_and_numbers_read_back_bit_for_bit() {
    let text = "\u{feff}note, EA_N ,id,length_m,z_m,x_m,w_N_per_m,Error,error_in\r\n\
                \"a \"\"b\"\", c\", 6.5E6 ,  q ,914.10,155,850,1.96e2,kept,\r\n";
    let (messages, made) = solve(text);
    let made = made.unwrap();
    assert!(messages.is_empty(), "{messages:?}");
    let mut lines = made.lines();
    let head = "note,EA_N,id,length_m,z_m,x_m,w_N_per_m,Error_in,error_in";
    assert_eq!(lines.next().unwrap(), format!("{head},{ADDED}"));
    let row = lines.next().unwrap();
    let through = "\"a \"\"b\"\", c\", 6.5E6 ,  q ,914.10,155,850,1.96e2,kept,,";
    let added: Vec<&str> = row.strip_prefix(through).unwrap_or_else(|| panic!("{row}")).split(',').collect();
    let segment = Segment { length: 914.1, weight: 196.0, ea: 6.5e6 };
    let exact = segment.solve_end_forces(850.0, 155.0, Some(FlatBottom::default())).unwrap();
    let want = [exact.fairlead[0], exact.fairlead[1], exact.anchor[0], exact.anchor[1], exact.grounded];
    for (got, want) in added.iter().zip(want) {
        assert_eq!(got.parse::<f64>().unwrap().to_bits(), want.to_bits());
    }
    assert_eq!((added[5], added[7]), ("contact", ""));
}

#[test]
fn lines_output_can_be_solved_again_with_unique_columns() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("in.csv"), format!("{HEAD}\n{GOOD}\n")).unwrap();
    let again = "LINES in.csv one\nLINES job.ans/one.csv two\nLINES job.ans/two.csv three";
    assert_eq!(run(folder.path(), again), Vec::<String>::new());
    let made = fs::read_to_string(folder.path().join("job.ans/three.csv")).unwrap();
    let mut heads: Vec<&str> = made.lines().next().unwrap().split(',').collect();
    assert!(heads.contains(&"regime_in") && heads.contains(&"regime_in_in"), "{heads:?}");
    let count = heads.len();
    heads.sort_unstable();
    heads.dedup();
    assert_eq!(heads.len(), count);
}

#[test]
fn job_units_do_not_change_results() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("in.csv"), format!("{HEAD}\n{GOOD}\n")).unwrap();
    run(folder.path(), "LINES in.csv feet\n&DIMEN -DIMEN METERS M-TONS\nLINES in.csv metres");
    let read = |name: &str| fs::read_to_string(folder.path().join("job.ans").join(name)).unwrap();
    assert_eq!(read("feet.csv"), read("metres.csv"));
}

#[test]
fn bad_rows_are_warned_by_line_number_ten_at_most() {
    let bad = "b,850,155,-1,6.5E6,196\n".repeat(4) + "\n\"b\nb\",850,x,914,6.5E6,196\n" + &"c,1\n".repeat(8);
    let (messages, made) = solve(format!("{HEAD}\n{bad}{GOOD}\n"));
    assert_eq!(messages.len(), 11, "{messages:?}");
    assert_eq!(messages[0], "in.csv:2: length_m must be greater than zero, this is -1 (id b)");
    assert_eq!(messages[4], "in.csv:7: z_m must be a finite number, this is `x` (id b b)");
    assert_eq!(messages[5], "in.csv:9: it has 2 cells under 6 headers (id c)");
    assert_eq!(messages[10], "3 further rows of in.csv are refused; the column error of out.csv says why");
    let made = made.unwrap();
    let mut reader = csv::Reader::from_reader(made.as_bytes());
    let rows: Vec<csv::StringRecord> = reader.records().map(|r| r.unwrap()).collect();
    assert_eq!(rows.len(), 14);
    assert!(rows[..13].iter().all(|r| !r[13].is_empty() && r.iter().skip(6).take(7).all(str::is_empty)));
    assert_eq!((&rows[13][0], &rows[13][11], &rows[13][13]), ("g", "contact", ""));
}

#[test]
fn refused_row_is_warning_and_file_is_written_without_good_rows() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("in.csv"), format!("{HEAD}\nb,1,1,1,x,1\n")).unwrap();
    let mut session = session(folder.path());
    session.open("script", "CONN_DESIGN\nLINES in.csv out\n&TYPE &INFO(SEVERITY)\nEND\n".to_string());
    session.run();
    assert_eq!((session.errors, session.reports[0].severity), (0, Severity::Warning));
    let log = fs::read_to_string(folder.path().join("job.ans/LOG00001.TXT")).unwrap();
    assert!(log.contains("in.csv: 0 rows solved, 1 refused\nwrote "), "{log}");
    assert!(log.find("in.csv:2:").unwrap() < log.find("0 rows solved").unwrap(), "the count comes last");
    assert!(folder.path().join("job.ans/out.csv").is_file());
}

#[test]
fn unusable_file_is_one_error_with_reason_and_writes_nothing() {
    for (text, want) in [
        (String::new(), "in.csv cannot be used: it is empty"),
        (format!("{HEAD}\r\n\r\n"), "it is empty"),
        (HEAD.replace("EA_N", "EA"), "it has no column EA_N; the nearest header is `EA`"),
        (HEAD.replace("EA_N", "EA_kN"), "it has no column EA_N; the nearest header is `EA_kN`"),
        (format!("{HEAD},Friction,friction\n{GOOD},0,0\n"), "column friction stands in it twice"),
        (format!("{HEAD}\n{GOOD}\n\"{}", "x\n".repeat(1 << 20)), "is a quote not closed?"),
    ] {
        let (messages, made) = solve(text);
        assert_eq!((messages.len(), made), (1, None), "{want}: {messages:?}");
        assert!(messages[0].contains(want), "{want}: {messages:?}");
    }
    let (messages, made) = solve([&[0x7f, b'E', b'L', b'F', 0, 255, b'\n'][..], &[0; 4096]].concat());
    assert!(messages.len() == 1 && made.is_none() && messages[0].contains("it has no column id"), "{messages:?}");
}

#[test]
fn non_text_bytes_pass_through_in_unread_column() {
    let folder = tempfile::tempdir().unwrap();
    let text = [HEAD.as_bytes(), b",caf\xe9\n", GOOD.as_bytes(), b",\xff\0\xe9\n"].concat();
    fs::write(folder.path().join("in.csv"), text).unwrap();
    assert_eq!(run(folder.path(), "LINES in.csv out"), Vec::<String>::new());
    let made = fs::read(folder.path().join("job.ans/out.csv")).unwrap();
    assert!(made.windows(4).any(|w| w == b",\xff\0\xe9"));
}

#[test]
fn lines_file_is_found_and_written_by_the_usual_name_rules() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name).display().to_string();
    fs::write(at("in.csv"), format!("{HEAD}\n{GOOD}\n")).unwrap();
    fs::write(at("taken.csv"), "mine").unwrap();
    let script = format!(
        "LINES in.csv out\nLINES '{}' out.txt\nLINES in.csv out\nLINES in.csv '{}'\nLINES im.csv x\nLINES job.ans x\n\
         LINES in.csv none/x\nLINES in.csv a/../../x\nLINES in.csv '{}'",
        at("in.csv"),
        at("taken.csv"),
        at("free.csv")
    );
    let messages = run(folder.path(), &script);
    let own = "is not below the job's own folder";
    let parts = [own, "did you mean in.csv", "is a folder", "no folder", "leads to nothing", own];
    assert_eq!(messages.len(), parts.len(), "{messages:?}");
    for (message, part) in messages.iter().zip(parts) {
        assert!(message.contains(part), "{part}: {message}");
    }
    assert_eq!(names(&folder.path().join("job.ans")), ["LOG00001.TXT", "out.csv", "out.csv.1", "out.txt"]);
    assert_eq!(names(folder.path()), ["in.csv", "job.ans", "taken.csv"]);
    assert_eq!(fs::read_to_string(at("taken.csv")).unwrap(), "mine");
}

#[test]
fn input_file_replaced_by_its_output_is_kept() {
    let folder = tempfile::tempdir().unwrap();
    let text = format!("{HEAD}\n{}", format!("{GOOD}\n").repeat(5000));
    fs::create_dir(folder.path().join("job.ans")).unwrap();
    fs::write(folder.path().join("job.ans/a.csv"), &text).unwrap();
    assert_eq!(run(folder.path(), "LINES job.ans/a.csv a.csv"), Vec::<String>::new());
    let read = |name: &str| fs::read_to_string(folder.path().join("job.ans").join(name)).unwrap();
    assert_eq!((read("a.csv").lines().count(), read("a.csv.1")), (5001, text));
}

#[test]
fn ctrl_c_stops_lines_without_partial_file_and_ends_run() {
    let folder = tempfile::tempdir().unwrap();
    // many seconds of work, if nothing stopped it
    fs::write(folder.path().join("in.csv"), format!("{HEAD}\n{}", format!("{GOOD}\n").repeat(4_000_000))).unwrap();
    let mut session = session(folder.path());
    let interrupt = Arc::clone(&session.interpreter.interrupt);
    let answers = folder.path().join("job.ans");
    let watched = answers.clone();
    let presser = std::thread::spawn(move || {
        // a file that has grown under its temporary name: rows are being written
        let growing = || {
            let entries = fs::read_dir(&watched).into_iter().flatten().flatten();
            entries
                .filter_map(|e| e.metadata().ok().map(|m| (e.file_name(), m.len())))
                .any(|(name, bytes)| name != "LOG00001.TXT" && bytes > 0)
        };
        while !growing() {
            std::thread::yield_now();
        }
        interrupt.store(true, Ordering::Relaxed);
    });
    session.open("script", "CONN_DESIGN\nLINES in.csv out\n&TYPE never\nEND\n".to_string());
    session.run();
    presser.join().unwrap();
    let messages: Vec<&str> = session.reports.iter().map(|r| r.message.as_str()).collect();
    assert_eq!(messages.len(), 3, "{messages:?}");
    assert!(messages[0].starts_with("LINES is given up at line ") && messages[0].ends_with("out.csv is not written"));
    assert_eq!(messages[1], "interrupted");
    assert_eq!(names(&answers), ["LOG00001.TXT"]);
}

#[test]
fn help_of_lines_names_every_input_and_output_column() {
    let folder = tempfile::tempdir().unwrap();
    run(folder.path(), "&HELP LINES");
    let log = fs::read_to_string(folder.path().join("job.ans/LOG00001.TXT")).unwrap();
    let log = log.split_whitespace().collect::<Vec<_>>().join(" ");
    for name in HEAD.split(',').chain(ADDED.split(',')).chain(["friction", "suspended", "_in"]) {
        assert!(log.contains(name), "{name}");
    }
}
