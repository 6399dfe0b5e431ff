//! Tables that `windlass study` makes of its cases, and tables of cases that are refused.

use std::fs;
use std::path::Path;
use std::process::Command;

fn windlass(folder: &Path, arguments: &[&str]) -> (Option<i32>, String, String) {
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).args(arguments).current_dir(folder).output().unwrap();
    let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
    (run.status.code(), text(run.stdout), text(run.stderr))
}

/// The cells of a CSV file, the head first.
fn rows(path: &Path) -> Vec<Vec<String>> {
    let mut reader = csv::ReaderBuilder::new().has_headers(false).from_path(path).unwrap();
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

#[test]
fn gumbel_fits_over_seeds_are_those_of_scipy() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    // the maxima `tension10` of crates/signal/tests/data/ensemble.py
    let model = "&SET T = &TOKEN(%MEMBER% 5210.0 4987.5 5534.2 5105.8 5078.4 5391.0 5640.7 5012.3 5166.9 5288.6 1)\n\
        &RESULT T %T% -UNIT kN\n&RESULT SAME 4 -UNIT m\n&IF %HS% .EQ. 0 &THEN\n&ENDIF\n&IF %MEMBER% .EQ. 11 &THEN\n&NO_SUCH_RECORD\n&ENDIF\n";
    fs::write(here.join("maxima.cif"), model).unwrap();
    let mut cases = "case,HS,member\nlone,2,1\n".to_owned();
    for member in 1..=11 {
        cases.push_str(&format!("storm{member},9,{member}\n"));
    }
    fs::write(here.join("cases.csv"), &cases).unwrap();
    let (code, out, err) = windlass(here, &["study", "cases.csv", "maxima.cif", "--out", "S"]);
    assert_eq!((code, err.as_str()), (Some(1), ""), "{out}");
    let table = rows(&here.join("S/ensembles.csv"));
    let at = |name: &str| table[0].iter().position(|head| head == name).unwrap_or_else(|| panic!("{name}"));
    let named: Vec<[&str; 4]> = table[1..]
        .iter()
        .map(|row| ["first_case", "HS", "result", "unit"].map(|head| row[at(head)].as_str()))
        .collect();
    assert_eq!(
        named,
        [
            ["lone", "2", "T", "kN"],
            ["lone", "2", "SAME", "m"],
            ["storm1", "9", "T", "kN"],
            ["storm1", "9", "SAME", "m"]
        ]
    );
    let number = |row: usize, head: &str| table[row][at(head)].parse::<f64>().unwrap();
    for (head, wanted) in [("cases", 11.0), ("failed", 1.0), ("overloaded", 0.0), ("missing", 0.0), ("count", 10.0)] {
        assert_eq!(number(3, head).to_bits(), f64::to_bits(wanted), "{head}");
    }
    // scipy 1.17, crates/signal/tests/data/ensemble.csv; the search of its likelihood stops at 1e-7
    let scipy = include_str!("../../../crates/signal/tests/data/ensemble.csv");
    let scipy = scipy.lines().find(|line| line.starts_with("tension10,")).unwrap();
    let scipy: Vec<f64> = scipy.split(',').skip(1).map(|cell| cell.parse().unwrap()).collect();
    for (head, wanted, tolerance) in [
        ("mean", scipy[1], 1e-9),
        ("standard_deviation", scipy[2], 1e-9),
        ("moments_location", scipy[3], 1e-9),
        ("moments_scale", scipy[4], 1e-9),
        ("moments_mpm", scipy[3], 1e-9),
        ("likelihood_location", scipy[5], 1e-6),
        ("likelihood_scale", scipy[6], 1e-6),
        ("moments_p90", scipy[7], 1e-9),
        ("largest", 5640.7, 1e-12),
        // the median of a Gumbel distribution is location - scale ln ln 2
        ("moments_p50", scipy[3] + 0.366_512_920_581_664 * scipy[4], 1e-9),
    ] {
        let found = number(3, head);
        assert!((found / wanted - 1.0).abs() < tolerance, "{head}: {found} is not {wanted}");
    }
    let reason = |row: usize| table[row][at("reason")].as_str();
    assert_eq!(reason(3), "");
    assert!(reason(1).starts_with("no fit by moments: ") && reason(1).contains("at least 3"), "{}", reason(1));
    assert!(reason(4).starts_with("no fit by moments: "), "{}", reason(4));
    for head in ["moments_mpm", "likelihood_p95", "seeds_for_5_percent"] {
        assert_eq!((table[1][at(head)].as_str(), table[4][at(head)].as_str()), ("", ""), "{head}");
    }
    assert!(here.join("S/ensembles.parquet").is_file());

    // a table without seeds leaves none of an earlier one
    fs::write(here.join("cases.csv"), "case,HS,member\nlone,2,1\n").unwrap();
    assert_eq!(windlass(here, &["study", "cases.csv", "maxima.cif", "--out", "S"]).0, Some(0));
    assert!(!here.join("S/ensembles.csv").exists() && !here.join("S/ensembles.parquet").exists());
}

#[test]
fn tables_with_too_many_cases_or_non_finite_cells_run_no_case() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("model.cif"), "&RESULT A %A%\n").unwrap();
    fs::write(here.join("cases.toml"), "case = \"c{A}\"\n[grid]\nA = [1, 2, 3]\n").unwrap();
    let (code, _, err) = windlass(here, &["study", "cases.toml", "model.cif", "--out", "S", "--max-cases", "2"]);
    let wanted = "windlass: cases.toml: the lists multiply to more than 2 cases: --max-cases allows more\n";
    assert_eq!((code, err.as_str()), (Some(2), wanted));
    fs::write(here.join("cases.csv"), "case,A\na,1\nb,inf\n").unwrap();
    let (code, _, err) = windlass(here, &["study", "cases.csv", "model.cif", "--out", "S"]);
    assert_eq!((code, err.as_str()), (Some(2), "windlass: cases.csv:3: column A: `inf` is not a finite number\n"));
    assert!(!here.join("S").exists());
}

#[test]
fn column_that_no_record_uses_is_an_error_with_its_near_match() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::create_dir(here.join("parts")).unwrap();
    fs::write(here.join("model.cif"), "$ %HSS% is only spoken of\n&INSERT parts/sea.cif\n").unwrap();
    fs::write(here.join("parts/sea.cif"), "&RESULT H %HS%\n&RESULT T %(TP)\n").unwrap();
    fs::write(here.join("cases.csv"), "case,HSS,TP\na,1,2\n").unwrap();
    let study = |table: &str| windlass(here, &["study", table, "model.cif", "--out", "S"]);
    let (code, _, err) = study("cases.csv");
    let wanted = "windlass: cases.csv: column HSS: no record of model.cif uses %HSS%; did you mean HS?\n";
    assert_eq!((code, err.as_str()), (Some(2), wanted));
    assert!(!here.join("S").exists());
    // columns of the study itself, and those that name the cases of a grid, need no record
    let grid = "case = \"{storm}_{member}\"\n[grid]\nmember = [1, 2]\n[[zip]]\nstorm = [\"low\"]\nhs = [1]\nTP = [2]\n";
    fs::write(here.join("cases.toml"), grid).unwrap();
    let (code, out, err) = study("cases.toml");
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    // a file that is named by a variable may use any column
    fs::write(here.join("model.cif"), "&SET F = parts/sea.cif\n&SET HS = 1\n&INSERT %F%\n").unwrap();
    let (code, out, err) = study("cases.csv");
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
}

#[test]
fn table_of_pandas_is_read() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let table = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/study_cases.parquet");
    fs::copy(table, here.join("cases.parquet")).unwrap();
    fs::write(here.join("torn.parquet"), b"PAR1 no more").unwrap();
    fs::write(here.join("sample.cif"), "&RESULT W2 %W% -UNIT kN\n&SET N = %(note)\n").unwrap();
    let (code, _, err) = windlass(here, &["study", "cases.parquet", "sample.cif", "--out", "S"]);
    assert_eq!((code, err.as_str()), (Some(0), ""));
    let table = rows(&here.join("S/results.csv"));
    let column = |name: &str| {
        let at = table[0].iter().position(|head| head == name).unwrap_or_else(|| panic!("{name}"));
        [table[1][at].as_str(), table[2][at].as_str()]
    };
    // tests/data/study_cases.py
    assert_eq!(column("case"), ["light", "heavy"]);
    assert_eq!(column("W2 (kN)"), ["100", "250.5"]);
    assert_eq!((column("note"), column("member")), (["spring", "Spring"], ["1", "2"]));
    let (code, _, err) = windlass(here, &["study", "torn.parquet", "sample.cif", "--out", "T"]);
    assert!(code == Some(2) && err.starts_with("windlass: torn.parquet: it is no Parquet: "), "{err}");
    assert!(!here.join("T").exists());
}
