//! `TABLE -VARY` of what makes the line itself: each row is the line of a class so written.

use std::process::Command;

/// The rows of the last VIEW of a script, as numbers.
fn rows(records: &str) -> Vec<Vec<f64>> {
    let folder = tempfile::tempdir().unwrap();
    let script = folder.path().join("job.cif");
    std::fs::write(&script, format!("&DIMEN -DIMEN METERS KN\n{records}\n")).unwrap();
    let out = Command::new(env!("CARGO_BIN_EXE_windlass")).arg(&script).output().unwrap();
    assert_eq!(out.status.code(), Some(0), "{}", String::from_utf8_lossy(&out.stderr));
    let mut reader = csv::Reader::from_path(folder.path().join("job.ans/rows.csv")).unwrap();
    reader.records().map(|r| r.unwrap().iter().map(|c| c.parse().unwrap()).collect()).collect()
}

fn model(options: &str, length: f64) -> String {
    format!(
        "MEDIT\n&DESCRIBE BODY V\n*P 0 0 -10\n~C B_CAT 90 EXACT -LEN {length} -BUOY 0 -DEP {options}\n\
         CONNECTOR A -ANC 30 1050 ~C *P\nEND\nCONN_DESIGN\n"
    )
}

#[test]
fn varied_parameter_matches_class_of_each_value() {
    let base = "300 -WTPL 1.6 -EMOD 50000 -FRICTION 0.4 -SLOPE 0.02";
    let cases = [
        (
            "DEPTH 280 320",
            [
                "280 -WTPL 1.6 -EMOD 50000 -FRICTION 0.4 -SLOPE 0.02",
                "320 -WTPL 1.6 -EMOD 50000 -FRICTION 0.4 -SLOPE 0.02",
            ],
        ),
        (
            "FRICTION 0 0.8",
            ["300 -WTPL 1.6 -EMOD 50000 -SLOPE 0.02", "300 -WTPL 1.6 -EMOD 50000 -FRICTION 0.8 -SLOPE 0.02"],
        ),
        (
            "SLOPE -0.01 0.03",
            [
                "300 -WTPL 1.6 -EMOD 50000 -FRICTION 0.4 -SLOPE -0.01",
                "300 -WTPL 1.6 -EMOD 50000 -FRICTION 0.4 -SLOPE 0.03",
            ],
        ),
        (
            "WEIGHT 0.5 2",
            [
                "300 -WTPL 0.8 -EMOD 50000 -FRICTION 0.4 -SLOPE 0.02",
                "300 -WTPL 3.2 -EMOD 50000 -FRICTION 0.4 -SLOPE 0.02",
            ],
        ),
        (
            "STIFFNESS 0.1 3",
            [
                "300 -WTPL 1.6 -EMOD 5000 -FRICTION 0.4 -SLOPE 0.02",
                "300 -WTPL 1.6 -EMOD 150000 -FRICTION 0.4 -SLOPE 0.02",
            ],
        ),
    ];
    for (vary, written) in cases {
        let varied = rows(&format!("{}TABLE A -VARY {vary}\nSTORE rows.csv 2:10\nEND\nEND", model(base, 1120.0)));
        for (row, options) in varied.iter().zip(written) {
            // a length varied by nothing: the class's own line, in the same columns
            let alone =
                rows(&format!("{}TABLE A -VARY LENGTH 1120\nSTORE rows.csv 2:10\nEND\nEND", model(options, 1120.0)));
            let size = row.iter().fold(0.0, |m: f64, v| m.max(v.abs()));
            for (a, b) in row.iter().zip(&alone[0]) {
                assert!((a - b).abs() <= 1e-8 * size, "{vary} {options}: {row:?} is not {:?}", alone[0]);
            }
        }
    }
}
