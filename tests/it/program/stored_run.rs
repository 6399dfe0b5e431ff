//! `windlass open`: a run without the script that made it.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

/// A cart on a spring: 100 kN of weight on 40 kN/m swings with a period of 2 pi sqrt(100 / 9.80665 / 40) = 3.173 s.
const SCRIPT: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n\
                      #WEIGHT *C 100 1 1 1\n~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n\
                      &INSTATE -LOCATE CART 0.5 0 0\n&ENV -TIME 10 0.1\nTDOM\nPRCPOST\nTRAJECTORY CART\nVIEW Time X\nEND\nEND\n";

fn windlass(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(folder).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8(bytes.to_vec()).unwrap()
}

/// The numbered rows of VIEW.
fn rows(text: &str) -> Vec<String> {
    let is_number = |word: &str| word.parse::<f64>().is_ok();
    let is_row = |line: &&str| line.split_whitespace().count() == 3 && line.split_whitespace().all(is_number);
    text.lines().filter(is_row).map(str::to_string).collect()
}

#[test]
fn stored_run_opens_without_its_script_with_the_same_rows_and_film() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("job.cif"), SCRIPT).unwrap();
    let run = windlass(folder.path(), &["job.cif"]);
    assert_eq!(run.status.code(), Some(0), "{}", text(&run.stderr));
    fs::remove_file(folder.path().join("job.cif")).unwrap();
    let log = fs::read(folder.path().join("job.ans/LOG00001.TXT")).unwrap();
    let records = ["PRCPOST", "TRAJECTORY CART", "VIEW Time X", "END", "END", "&ANIMATE film.html"];
    for name in ["job.ans", "job"] {
        let arguments = records.iter().flat_map(|record| ["-c", record]);
        let arguments: Vec<&str> = ["open", name].into_iter().chain(arguments).collect();
        let opened = windlass(folder.path(), &arguments);
        let said = text(&opened.stdout);
        assert_eq!(opened.status.code(), Some(0), "{said}{}", text(&opened.stderr));
        assert!(said.contains("TDOM: reached 10.0 s of 10.0 s in 100 steps"), "{said}");
        let found = rows(&said);
        assert_eq!((found.len(), &found), (101, &rows(&text(&run.stdout))));
        // released at rest, 0.5 m out: back after the period of 3.173 s
        let at = |row: &String| row.split_whitespace().nth(2).unwrap().parse::<f64>().unwrap();
        assert!((at(&found[32]) - 0.5).abs() < 0.01, "{}", found[32]);
    }
    assert!(folder.path().join("job.ans/film.html").is_file());
    assert_eq!(fs::read(folder.path().join("job.ans/LOG00001.TXT")).unwrap(), log, "the log of the job stays");
}

#[test]
fn folder_without_run_or_records_or_of_another_version_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("job.cif"), SCRIPT).unwrap();
    windlass(folder.path(), &["job.cif"]);
    let refused = |what: &str| {
        let opened = windlass(folder.path(), &["open", "job.ans", "-c", "&TYPE no"]);
        let said = text(&opened.stderr);
        assert!(opened.status.code() != Some(0) && said.contains(what), "{what}: {said}");
    };
    let run = folder.path().join("job.ans/TDOM.run");
    let bytes = fs::read(&run).unwrap();
    let mut other = bytes.clone();
    other[7] = 2;
    fs::write(&run, other).unwrap();
    refused("another version of windlass wrote it");
    fs::write(&run, &bytes[..40]).unwrap();
    refused("holds no snapshot");
    fs::write(&run, &bytes).unwrap();
    let records = folder.path().join("job.ans/TDOM.run.cif");
    let script = fs::read_to_string(&records).unwrap();
    fs::write(&records, script.replace("BOTH X 40", "BOTH X 50")).unwrap();
    refused("not that of the records kept beside it");
    fs::remove_file(&records).unwrap();
    refused("needs it to make the model of the run again");
    fs::remove_file(&run).unwrap();
    refused("holds no run");
    let missing = windlass(folder.path(), &["open", "nowhere.ans"]);
    assert!(text(&missing.stderr).contains("there is no folder of answers"), "{}", text(&missing.stderr));
}

/// The first line of VIEW that has a time: `row time x`.
fn place_at(rows: &[String], time: f64) -> f64 {
    let numbers = |row: &String| -> Vec<f64> { row.split_whitespace().map(|word| word.parse().unwrap()).collect() };
    rows.iter().map(numbers).find(|row| (row[1] - time).abs() < 1e-9).map(|row| row[2]).unwrap()
}

#[test]
fn stored_run_that_began_from_an_earlier_run_opens_with_the_same_rows() {
    let folder = tempfile::tempdir().unwrap();
    // a quarter of the period of 3.173 s after release: X is near zero, and the cart moves at its fastest
    let began = [
        ("-RESET", "TDOM -RESET 0.8\n"),
        ("-EVENT", "&INSTATE -EVENT 0.8\nTDOM\n"),
        ("both", "&INSTATE -EVENT 1.6\nTDOM\nTDOM -RESET 0.8\n"),
    ];
    for (name, records) in began {
        let script = SCRIPT.replace("TDOM\n", &format!("TDOM\n{records}"));
        fs::write(folder.path().join("job.cif"), script).unwrap();
        let run = windlass(folder.path(), &["job.cif"]);
        assert_eq!(run.status.code(), Some(0), "{name}: {}", text(&run.stderr));
        let records = ["PRCPOST", "TRAJECTORY CART", "VIEW Time X", "END", "END"];
        let arguments = records.iter().flat_map(|record| ["-c", record]);
        let arguments: Vec<&str> = ["open", "job.ans"].into_iter().chain(arguments).collect();
        let opened = windlass(folder.path(), &arguments);
        assert_eq!(opened.status.code(), Some(0), "{name}: {}{}", text(&opened.stdout), text(&opened.stderr));
        let (ran, found) = (rows(&text(&run.stdout)), rows(&text(&opened.stdout)));
        assert_eq!((found.len(), &found), (101, &ran), "{name}");
        // 0.5 cos(2 pi 0.8 / 3.173) = -0.0067 m; of a run released at rest at 0.5 cos(2 pi 1.6 / 3.173) = -0.4998 m it is 0.0067 m
        let start = if name == "both" { 0.0067 } else { -0.0067 };
        assert!((place_at(&found, 0.0) - start).abs() < 0.005, "{name}: {}", found[0]);
    }
}

#[test]
fn stored_run_that_began_from_an_earlier_run_tells_a_state_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("job.cif"), SCRIPT.replace("TDOM\n", "TDOM\nTDOM -RESET 0.8\n")).unwrap();
    windlass(folder.path(), &["job.cif"]);
    let records = folder.path().join("job.ans/TDOM.run.cif");
    let script = fs::read_to_string(&records).unwrap();
    fs::write(&records, script.replace("-RESET 0.8", "-RESET 0.9")).unwrap();
    let run = fs::read(folder.path().join("job.ans/TDOM.run")).unwrap();
    let opened = windlass(folder.path(), &["open", "job.ans", "-c", "&TYPE no"]);
    assert!(text(&opened.stderr).contains("there is no run of these bodies to begin from"), "{}", text(&opened.stderr));
    assert_eq!(fs::read(folder.path().join("job.ans/TDOM.run")).unwrap(), run, "the run stays");
}
