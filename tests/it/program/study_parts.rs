//! Studies in parts: divided, run by other processes, collected; and as job arrays of a Slurm that scripts stand for.

use std::fs;
use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::Command;

/// Runs windlass with programs of a folder in front of the system's.
fn windlass(folder: &Path, programs: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let path = format!("{}:{}", programs.display(), std::env::var("PATH").unwrap_or_default());
    windlass_of_path(folder, &path, arguments)
}

fn windlass_of_path(folder: &Path, path: &str, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_windlass"))
        .args(arguments)
        .current_dir(folder)
        .env("PATH", path)
        .env_remove("SLURM_CPUS_PER_TASK")
        .output()
        .unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

/// Twice W; 13 is bad luck.
const MODEL: &str = "&SET S = &NUMBER(REAL 2*%W%)\n&RESULT TWICE %S%\n&RESULT SEED_USED %SEED%\n&IF %W% .EQ. 13 &THEN\n&NO_SUCH_RECORD\n&ENDIF\n";

fn cases(number: usize) -> String {
    (0..number).fold("case,W\n".to_owned(), |text, n| format!("{text}C{n},{n}\n"))
}

/// The cells of a CSV file but for those of the column seconds.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path).unwrap();
    let mut rows: Vec<Vec<String>> =
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect();
    let at = rows[0].iter().position(|head| head == "seconds (s)").unwrap();
    for row in &mut rows {
        row.remove(at);
    }
    rows
}

fn kept(study: &Path) -> Vec<String> {
    let entries = fs::read_dir(study.join("cases")).unwrap();
    let mut names: Vec<String> = entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

#[test]
fn study_in_parts_has_the_tables_and_answers_of_one_in_one_piece() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("twice.cif"), MODEL).unwrap();
    fs::write(here.join("cases.csv"), cases(20)).unwrap();
    let go = |words: &[&str]| windlass(here, here, words);
    let common = ["study", "cases.csv", "twice.cif", "--out"];
    assert_eq!(go(&[&common[..], &["whole"]].concat()).0, Some(1));
    let (code, out, err) = go(&[&common[..], &["S", "--parts", "3"]].concat());
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    assert_eq!(
        out,
        "20 cases: 20 cases in 3 parts\n   windlass study part S N    runs one of them, N from 1 to 3\n   \
         windlass study collect S    makes the tables when they are over\n"
    );
    // dealt out in turn, 7, 7 and 6; the third has C0 + 2, 5, .. and not C13, which the second has
    let other = here.join("elsewhere");
    fs::create_dir(&other).unwrap();
    let study = here.join("S").display().to_string();
    let part = |number: &str| windlass(&other, here, &["study", "part", &study, number, "--jobs", "2"]);
    assert_eq!(part("3"), (Some(0), "part 3: 6 cases, 0 failed\n".into(), String::new()));
    assert_eq!(part("3"), (Some(0), "part 3: 0 cases, 0 failed, 6 done before\n".into(), String::new()));
    assert_eq!(part("2"), (Some(1), "part 2: 7 cases, 1 failed\n".into(), String::new()));
    assert_eq!(kept(&here.join("S")), ["C13"]);
    // before all are over the tables have what is there
    let (code, out, _) = go(&["study", "collect", "S"]);
    assert!(code == Some(1) && out.starts_with("20 cases: 12 done, 0 overloaded, 1 failed, 7 left"), "{out}");
    // a kill that leaves half a record: it is cut off, and its case is run again
    assert_eq!(part("1").0, Some(0));
    let file = here.join("S/results-1-1.jsonl");
    let bytes = fs::read(&file).unwrap();
    fs::write(&file, &bytes[..bytes.len() - 9]).unwrap();
    assert_eq!(part("1"), (Some(0), "part 1: 1 case, 0 failed, 6 done before\n".into(), String::new()));
    let (code, out, err) = go(&["study", "collect", "S"]);
    assert!(
        code == Some(1) && err.is_empty() && out.starts_with("20 cases: 19 done, 0 overloaded, 1 failed\n"),
        "{out}"
    );
    assert_eq!(rows(&here.join("S/results.csv")), rows(&here.join("whole/results.csv")));
    // least and largest of TWICE and SEED_USED, and the failed one; the collecting has made those that govern
    let names = kept(&here.join("S"));
    assert!(names.contains(&"C0".to_owned()) && names.contains(&"C19".to_owned()), "{names:?}");
    assert_eq!(names, kept(&here.join("whole")));
    assert!(here.join("S/cases/C19/LOG00001.TXT").is_file());
    // what has changed is divided anew, and nothing else
    fs::write(here.join("cases.csv"), cases(20).replace("C4,4", "C4,44")).unwrap();
    let (_, out, _) = go(&[&common[..], &["S", "--parts", "3"]].concat());
    assert!(out.starts_with("20 cases: 1 case in 3 parts of 0.0 minutes or less\n   19 were done before\n"), "{out}");
    assert!(out.contains("C4 was run again: its row has changed"), "{out}");
    for number in ["1", "2", "3"] {
        assert_eq!(part(number).0, Some(0), "{number}");
    }
    assert_eq!(go(&["study", "collect", "S"]).0, Some(1));
    assert_eq!(rows(&here.join("S/results.csv"))[5][1], "44");
}

#[test]
fn wrong_parts_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("twice.cif"), MODEL).unwrap();
    fs::write(here.join("cases.csv"), cases(4)).unwrap();
    let go = |words: &[&str]| windlass(here, here, words);
    let study = |words: &[&str]| go(&[&["study", "cases.csv", "twice.cif", "--out", "S"][..], words].concat());
    for (words, said) in [
        (&["--parts", "0"][..], "--parts"),
        (&["--parts", "2", "--pack", "5"], "--pack"),
        (&["--pack", "5"], "--slurm"),
        (&["--pack", "0", "--slurm"], "--pack 0: minutes above zero"),
        (&["--slurm", "--array=1-5"], "--slurm: `--array=1-5`: the study numbers the tasks; --array=%N"),
        (&["--slurm", "--dependency=afterok:1"], "the study sets --dependency itself"),
    ] {
        let (code, _, err) = study(words);
        assert!(code == Some(2) && err.contains(said), "{words:?}: {err}");
    }
    assert!(!here.join("S").exists());
    let (code, _, err) = go(&["study", "part", "S", "1"]);
    assert!(code == Some(2) && err.contains("S: it is not divided into parts"), "{err}");
    assert_eq!(study(&["--parts", "2"]).0, Some(0));
    for number in ["0", "3"] {
        let (code, _, err) = go(&["study", "part", "S", number]);
        assert!(code == Some(2) && err.contains(&format!("it has the parts 1 to 2, not {number}")), "{err}");
    }
    let (code, _, err) = go(&["study", "part", "S", "1", "--start", "7"]);
    assert!(code == Some(1) && err.contains("7.jsonl"), "{err}");
}

/// A Slurm of scripts: sbatch notes its words and gives numbers from 101 on, scontrol has arrays of two tasks, squeue has what is in a file.
fn fake_slurm(folder: &Path) {
    let programs = [
        (
            "sbatch",
            "for word in \"$@\"; do printf '%s ' \"$word\"; done >>DIR/said; echo >>DIR/said\n\
             n=$(wc -l <DIR/said); [ -e DIR/full ] && [ $n -ge 2 ] && { echo 'sbatch: error: QOSMaxSubmit' >&2; exit 1; }\n\
             echo \"$((100 + n));cluster\"\n",
        ),
        ("scontrol", "echo 'MaxArraySize            = 3'\n"),
        ("squeue", "cat DIR/queue 2>/dev/null\n"),
    ];
    for (name, text) in programs {
        let path = folder.join(name);
        fs::write(&path, format!("#!/bin/sh\n{}", text.replace("DIR", &folder.display().to_string()))).unwrap();
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
}

#[test]
fn slurm_gets_arrays_within_its_size_and_a_job_that_collects() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let slurm = here.join("slurm");
    fs::create_dir(&slurm).unwrap();
    fake_slurm(&slurm);
    let work = here.join("it's 50 %");
    fs::create_dir(&work).unwrap();
    fs::write(work.join("twice.cif"), MODEL).unwrap();
    fs::write(work.join("cases.csv"), cases(20)).unwrap();
    let go = |words: &[&str]| windlass(&work, &slurm, words);
    let study = |words: &[&str]| go(&[&["study", "cases.csv", "twice.cif", "--out", "S"][..], words].concat());
    // parts of a nanosecond: a case each, 16 of them, in arrays of two
    let (code, out, err) =
        study(&["--sample", "4", "--pack", "1e-11", "--slurm", "-p", "long", "--array=%5", "--time=2:00:00"]);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    assert!(out.starts_with("20 cases: 4 were run here to measure them, 0 failed; 16 cases in 16 parts of "), "{out}");
    assert!(out.contains("job array 101, 102, 103, 104, 105, 106, 107, 108; job 109 makes the tables"), "{out}");
    let said = fs::read_to_string(slurm.join("said")).unwrap();
    let said: Vec<&str> = said.lines().map(str::trim_end).collect();
    let study_folder = work.join("S").display().to_string();
    let common = |log: &str| {
        let log = format!("{study_folder}/parts/1-{log}.log").replace('%', "%%");
        format!("--parsable --open-mode=append --cpus-per-task=1 --job-name=windlass-S --output={log}")
    };
    for (number, line) in said.iter().take(8).enumerate() {
        let script = format!("{study_folder}/parts/1-array.sh {}", 2 * number);
        assert_eq!(*line, format!("{} --array=1-2%5 -p long --time=2:00:00 {script}", common("array")));
    }
    let all = "101:102:103:104:105:106:107:108";
    let script = format!("{study_folder}/parts/1-collect.sh");
    assert_eq!(said[8], format!("{} --dependency=afterany:{all} -p long --time=2:00:00 {script}", common("collect")));
    assert_eq!(said.len(), 9);
    // the script, as Slurm runs it
    let program = env!("CARGO_BIN_EXE_windlass");
    let array = fs::read_to_string(work.join("S/parts/1-array.sh")).unwrap();
    let place = work.display().to_string().replace('\'', "'\\''");
    assert_eq!(
        array,
        format!(
            "#!/bin/bash\n# Written by windlass study --slurm.\ncd '{place}' || exit 1\nexec '{program}' study part '{place}/S' \
             \"$((SLURM_ARRAY_TASK_ID + ${{1:-0}}))\" --start 1 --jobs \"${{SLURM_CPUS_PER_TASK:-1}}\"\n"
        )
    );
    let task = |number: usize| {
        Command::new("bash")
            .args([work.join("S/parts/1-array.sh").display().to_string(), (number / 2 * 2).to_string()])
            .env("SLURM_ARRAY_TASK_ID", (number % 2 + 1).to_string())
            .env("SLURM_CPUS_PER_TASK", "2")
            .current_dir(here)
            .output()
            .unwrap()
    };
    // one task of sixteen never runs
    let ended: Vec<Option<i32>> = (0..15).map(|number| task(number).status.code()).collect();
    assert_eq!(ended.iter().filter(|code| **code == Some(1)).count(), 1, "{ended:?}");
    let collected = Command::new("bash").arg(work.join("S/parts/1-collect.sh")).output().unwrap();
    let text = String::from_utf8(collected.stdout).unwrap();
    assert!(
        collected.status.code() == Some(1) && text.starts_with("20 cases: 18 done, 0 overloaded, 1 failed, 1 left")
    );
    // while squeue has the job nothing is begun over it
    fs::write(slurm.join("queue"), "104\n104\n").unwrap();
    for words in [&["--slurm"][..], &[]] {
        let (code, _, err) = study(words);
        assert!(
            code == Some(2) && err.contains("S: job 104 of Slurm is not over: wait for it, or scancel 104"),
            "{err}"
        );
    }
    fs::remove_file(slurm.join("queue")).unwrap();
    // what is left is one part of a case whose time is known
    let (code, out, _) = study(&["--slurm"]);
    assert!(code == Some(0) && out.starts_with("20 cases: 1 case in 1 part of 0.0 minutes or less\n"), "{out}");
    assert!(out.contains("19 were done before"), "{out}");
    assert!(go(&["study", "part", "S", "1"]).0.is_some_and(|code| code < 2));
    // nothing is left: the tables are made at once
    let (code, out, _) = study(&["--slurm"]);
    assert!(code == Some(1) && out.starts_with("20 cases: 19 done, 0 overloaded, 1 failed\n"), "{out}");
    assert_eq!(go(&["study", "cases.csv", "twice.cif", "--out", "whole"]).0, Some(1));
    assert_eq!(rows(&work.join("S/results.csv")), rows(&work.join("whole/results.csv")));
    assert_eq!(kept(&work.join("S")), kept(&work.join("whole")));
}

#[test]
fn refusal_of_sbatch_is_told_with_what_was_submitted() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("twice.cif"), MODEL).unwrap();
    fs::write(here.join("cases.csv"), cases(5)).unwrap();
    let words = ["study", "cases.csv", "twice.cif", "--out", "S", "--sample", "1", "--pack", "1e-11", "--slurm"];
    // a machine without Slurm
    let (code, _, err) = windlass_of_path(here, "/nowhere", &words);
    assert!(code == Some(1) && err.contains("sbatch cannot be started"), "{err}");
    let slurm = here.join("slurm");
    fs::create_dir(&slurm).unwrap();
    fake_slurm(&slurm);
    fs::write(slurm.join("full"), "").unwrap();
    let (code, _, err) = windlass(here, &slurm, &words);
    assert!(code == Some(1) && err.contains("QOSMaxSubmit; submitted before: scancel 101"), "{err}");
}
