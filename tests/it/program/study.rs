//! `windlass study`: a table of cases through processes, and what comes of them.

use std::fs;
use std::path::Path;
use std::process::Command;

fn windlass(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

/// A body of a weight (kN) on a vertical spring of 50 kN/m: it hangs W / 50 m below where the spring has no force.
const MODEL: &str = "&DIMEN -DIMEN METERS KN\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE X Y RX RY RZ\n*C 0 0 0\n\
    #WEIGHT *C %W% 1 1 1\n~S GSPR BOTH Z 50 1E6 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&EQUI\n&SET Z = &TOKEN(3 &BODY(LOCATION CART))\n\
    &RESULT Z %Z% -UNIT m\n&RESULT SEED_USED %SEED%\n&IF %W% .EQ. 13 &THEN\n&NO_SUCH_RECORD\n&ENDIF\n";

/// The cells of a CSV file, the head first.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path).unwrap();
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

#[test]
fn results_of_cases_are_those_of_springs_by_hand_and_failures_have_their_reason() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("spring.cif"), MODEL).unwrap();
    fs::write(here.join("cases.csv"), "case,W\nlight,100\nheavy,250\nbad,13\n").unwrap();
    let (code, out, err) = windlass(here, &["study", "cases.csv", "spring.cif", "--out", "S", "--jobs", "2"]);
    assert_eq!((code, err.as_str()), (Some(1), ""), "{out}");
    assert!(out.starts_with("3 cases: 2 done, 0 overloaded, 1 failed\n   bad failed: "), "{out}");
    let table = rows(&here.join("S/results.csv"));
    let column = |name: &str| table[0].iter().position(|head| head == name).unwrap();
    let (z, status, reason) = (column("Z (m)"), column("status"), column("reason"));
    let found: Vec<f64> = table[1..].iter().map(|row| row[z].parse().unwrap()).collect();
    for (found, by_hand) in found.iter().zip([-2.0, -5.0, -0.26]) {
        assert!((found - by_hand).abs() < 1e-6, "{found} for {by_hand}");
    }
    let ended: Vec<&str> = table[1..].iter().map(|row| row[status].as_str()).collect();
    assert_eq!(ended, ["done", "done", "failed"]);
    assert!(
        table[3][reason].contains("spring.cif:15:1: ") && table[3][reason].contains("&NO_SUCH_RECORD"),
        "{table:?}"
    );
    // seeds as an independent program has them for study 1, member 0
    let seeds: Vec<&str> = table[1..].iter().map(|row| row[column("SEED_USED")].as_str()).collect();
    assert_eq!(seeds, ["412308024", "69975954", "1301918919"]);
    // the heaviest has the largest of nothing but its seed; the failed one is kept
    assert!(here.join("S/cases/bad/LOG00001.TXT").is_file());

    let (code, out, _) = windlass(here, &["study", "rerun", "S", "heavy"]);
    assert_eq!((code, out.lines().next()), (Some(0), Some("heavy: done, the same results, to the last digit")));
    assert!(here.join("S/rerun/heavy/LOG00001.TXT").is_file());

    // a model that has changed is seen, and everything is run again
    fs::write(here.join("spring.cif"), MODEL.replace("Z 50 ", "Z 100 ")).unwrap();
    let (_, out, _) = windlass(here, &["study", "rerun", "S", "heavy"]);
    assert!(out.contains("other results than before") && out.contains("spring.cif has changed"), "{out}");
    let (code, out, _) = windlass(here, &["study", "cases.csv", "spring.cif", "--out", "S"]);
    assert!(
        code == Some(1) && out.contains("light was run again: ") && out.contains("spring.cif has changed"),
        "{out}"
    );
    let table = rows(&here.join("S/results.csv"));
    assert!((table[2][z].parse::<f64>().unwrap() + 2.5).abs() < 1e-6, "{table:?}");
}

#[test]
fn wrong_studies_run_no_case() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("spring.cif"), MODEL).unwrap();
    fs::write(here.join("cases.csv"), "case,W\nA,100\nA,\n").unwrap();
    let study = |words: &[&str]| windlass(here, &[&["study"][..], words].concat());
    let (code, out, err) = study(&["cases.csv", "spring.cif", "--out", "S"]);
    assert_eq!((code, out.as_str()), (Some(2), ""));
    assert_eq!(err, "windlass: cases.csv:3: column W: the cell is empty\n");
    assert!(!here.join("S").exists());
    let (code, _, err) = study(&["nothing.csv", "spring.cif", "--out", "S"]);
    assert!(code == Some(2) && err.contains("nothing.csv"), "{err}");
    fs::write(here.join("cases.csv"), "case,W\nA,100\n").unwrap();
    let (code, _, err) = study(&["cases.csv", "none.cif", "--out", "S"]);
    assert!(code == Some(2) && err == "windlass: there is no script none.cif\n", "{err}");
    let (code, _, err) = study(&["cases.csv", "spring.cif"]);
    assert!(code == Some(2) && err.contains("--out <DIR>"), "{err}");
    let (code, _, err) = study(&["cases.csv", "spring.cif", "--out", "S", "--jobs", "0"]);
    assert!(code == Some(2) && err.contains("--jobs"), "{err}");
    assert_eq!(study(&["cases.csv", "spring.cif", "--out", "S"]).0, Some(0));
    let (code, _, err) = study(&["rerun", "S", "B"]);
    assert!(code == Some(2) && err.contains("S has no finished case B"), "{err}");
}
