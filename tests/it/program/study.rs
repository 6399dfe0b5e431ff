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

/// A catenary that hardly stretches, by hand: at H = 500 kN, 200 m high and 1 kN/m heavy its tension at the fairlead is
/// H + w h = 700 kN, it hangs over sqrt(h2 + 2 h H/w) = 489.898 m, and its anchor is 953.609 m away.
const CATENARIES: &str = "&DIMEN -DIMEN METERS N\n&TITLE Rig <script>alert(1)</script>\nMEDIT\n&DESCRIBE BODY RIG\n*P 0 0 0\n*Q 0 5 0\n\
    ~L B_CAT 100 -LEN 1010 -DEP 200 -BUOY 0 -WTPL 1000 -EMOD 1E11 -B_TEN %BREAK%\n\
    CONNECTOR A ~L *P -ANC 0 953.609\nCONNECTOR B ~L *Q -ANC 180 953.609\nEND\n\
    &IF %LOST% .NE. NONE &THEN\n&CONNECTOR %LOST% -INACTIVE\n&ENDIF\n\
    CONN_DESIGN\nCODE_CHECK %CHECK%\nEND\n&RESULT OFFSET %HEADING% -UNIT m\n&IF %BREAK% .LT. 1E6 &THEN\n&NO_SUCH_RECORD\n&ENDIF\n";

#[test]
fn report_has_governing_catenaries_by_hand_and_failed_cases_apart() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("rig.cif"), CATENARIES.replace("%CHECK%", "-CODE API_RP_2SK_3")).unwrap();
    let table = "case,BREAK,LOST,HEADING\nstrong,3E6,NONE,0\nweak,1.2E6,NONE,90\nlost,1.2E6,B,180\nbad,5E5,NONE,270\n";
    fs::write(here.join("cases.csv"), table).unwrap();
    assert_eq!(windlass(here, &["study", "cases.csv", "rig.cif", "--out", "S"]).0, Some(1));
    // the failed one has the least factor, and governs nothing; it is kept as failed
    let (code, out, err) = windlass(here, &["report", "S"]);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    assert!(out.starts_with("2 of 5 checks of lines are NOT met.\n1 of 4 cases have failed"), "{out}");
    let text = fs::read_to_string(here.join("S/report.md")).unwrap();
    // 1,200 kN over 700 kN: below 2.0 intact, above 1.43 with a line lost
    assert!(text.contains("| intact | 2 | A 1 | weak | 1.71 | 2.00 | 1.167 | FAIL | 2 of 4 |"), "{text}");
    assert!(text.contains("| damaged | 1 | A 1 | lost | 1.71 | 1.43 | 0.834 | pass | 0 of 1 |"), "{text}");
    assert!(text.contains("| intact | B 1 | weak |") && text.contains("| damaged | A 1 | lost | B | 1.71 |"), "{text}");
    assert!(text.contains("| bad | failed | rig.cif:") && text.contains("NO\\_SUCH\\_RECORD"), "{text}");
    // each direction with its offset and the tension of 700 kN; that of the failed case is not among them
    let number = |start: &str, at: usize| -> f64 {
        let line = text.lines().find(|line| line.starts_with(start)).unwrap_or_else(|| panic!("no {start}: {text}"));
        line.split('|').nth(at).unwrap().trim().parse().unwrap()
    };
    for start in ["| 0 | intact | 1 | 0 |", "| 90 | intact | 1 | 90 |", "| 180 | damaged | 1 | 180 |"] {
        assert!((number(start, 5) - 7e5).abs() < 50.0, "{start}: {text}");
    }
    assert!(!text.contains("\n| 270 |"), "{text}");
    // the anchor bears H = 500 kN
    assert!((number("| intact | A | strong |", 4) - 5e5).abs() < 50.0, "{text}");
    let page = fs::read_to_string(here.join("S/report.html")).unwrap();
    assert!(!page.contains("<script>alert") && page.matches("<script").count() == 1, "a name is markup");
    for outside in ["http://", "https://", "@import", "url("] {
        assert!(!page.replace("http://www.w3.org", "").contains(outside), "{outside}");
    }
    // what windlass has written it writes again, the same to the last byte
    assert_eq!(windlass(here, &["report", "S"]).0, Some(0));
    assert!(fs::read_to_string(here.join("S/report.html")).unwrap() == page);
}

#[test]
fn report_with_factors_from_memory_never_prints_a_pass() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let check = "-CODE DNV_OS_E301_2015 -CLASS 1 -UNCONFIRMED";
    fs::write(here.join("rig.cif"), CATENARIES.replace("%CHECK%", check)).unwrap();
    fs::write(here.join("cases.csv"), "case,BREAK,LOST,HEADING\nA,3E6,NONE,0\n").unwrap();
    let (code, out, err) = windlass(here, &["study", "cases.csv", "rig.cif", "--out", "S"]);
    assert_eq!(code, Some(0), "{out}{err}");
    let (code, out, _) = windlass(here, &["report", "S", "--out", "review.html", "--title", "Rev | B"]);
    assert!(code == Some(0) && out.starts_with("UNCONFIRMED: "), "{out}");
    let text = fs::read_to_string(here.join("review.md")).unwrap();
    assert!(text.contains("# Rev \\| B\n") && text.contains("| UNCONFIRMED |") && !text.contains("| pass |"), "{text}");
    let page = fs::read_to_string(here.join("review.html")).unwrap();
    assert!(!page.contains(">pass<") && page.contains("class=\"unconfirmed\""));
}

#[test]
fn wrong_reports_write_nothing_over_what_is_there() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    let report = |words: &[&str]| windlass(here, &[&["report"][..], words].concat());
    let (code, _, err) = report(&["S"]);
    assert_eq!((code, err.as_str()), (Some(2), "windlass: S is no folder of a study: windlass study makes one\n"));
    fs::write(here.join("spring.cif"), MODEL).unwrap();
    fs::write(here.join("cases.csv"), "case,W\nA,100\n").unwrap();
    assert_eq!(windlass(here, &["study", "cases.csv", "spring.cif", "--out", "S"]).0, Some(0));
    let (code, _, err) = report(&["S", "--direction", "V"]);
    assert!(
        code == Some(2) && err.contains("--direction V: the cases have no column of that name, they have W"),
        "{err}"
    );
    let (code, _, err) = report(&["S", "--out", "page.pdf"]);
    assert_eq!((code, err.as_str()), (Some(2), "windlass: --out page.pdf: a report ends in .html\n"));
    fs::write(here.join("mine.html"), "mine").unwrap();
    fs::write(here.join("notes.md"), "mine").unwrap();
    fs::create_dir(here.join("photos-figures")).unwrap();
    fs::write(here.join("photos-figures/me.png"), "mine").unwrap();
    for out in ["mine.html", "notes.html", "photos.html", "nowhere/page.html"] {
        assert_eq!(report(&["S", "--out", out]).0, Some(2), "{out}");
    }
    assert_eq!(fs::read_to_string(here.join("mine.html")).unwrap(), "mine");
    assert!(!here.join("notes.html").exists() && !here.join("photos.html").exists());
    // a study without lines has a report that says so
    let (code, out, err) = report(&["S"]);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    let text = fs::read_to_string(here.join("S/report.md")).unwrap();
    assert!(
        text.contains("No tension is checked by a code.") && text.contains("| Z (m) | all | 1 | -2 | A |"),
        "{text}"
    );
}

/// A buoy on two lines that is let go 5 ft off its place, for a minute.
const BUOY: &str = "MEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P 2000 10 10 10\n\
    ~W B_CAT 4 -LEN 4000 -DEP 500\nCONNECTOR A -ANC 0 3900 ~W *P\nCONNECTOR B -ANC 180 3900 ~W *P\nEND\n\
    &INSTATE -LOCATE BUOY %X%\n&ENV -TIME 60 1\nTDOM\nPRCPOST\nCODE_CHECK -CODE API_RP_2SK_3\nEND\n";

#[test]
fn kept_case_opens_as_session_and_report_draws_its_peak() {
    let folder = tempfile::tempdir().unwrap();
    let here = folder.path();
    fs::write(here.join("buoy.cif"), BUOY).unwrap();
    fs::write(here.join("cases.csv"), "case,X\nnear,2\nfar,5\n").unwrap();
    let (code, out, err) = windlass(here, &["study", "cases.csv", "buoy.cif", "--out", "S"]);
    assert_eq!(code, Some(0), "{out}{err}");
    // the farther it is let go, the larger the tension: one case governs both lines
    assert!(here.join("S/cases/far").is_dir() && !here.join("S/cases/near").exists());
    let records =
        ["-c", "&STATUS CONFIGURATION", "-c", "PRCPOST", "-c", "TRAJECTORY BUOY", "-c", "STATISTIC X", "-c", "END"];
    let (code, out, err) = windlass(here, &[&["open", "S/cases/far"][..], &records].concat());
    assert!(code == Some(0) && out.contains("BUOY"), "{out}{err}");
    let (code, out, err) = windlass(here, &["report", "S"]);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    let text = fs::read_to_string(here.join("S/report.md")).unwrap();
    assert!(
        text.contains("](report-figures/model.svg)") && text.contains("](report-figures/history-intact-1.svg)"),
        "{text}"
    );
    let drawn = fs::read_to_string(here.join("S/report-figures/history-intact-1.svg")).unwrap();
    assert!(drawn.starts_with("<svg") && drawn.contains("tension of A 1") && drawn.contains("strength / 2"), "{drawn}");
    // how the lines were run, and the ratio of the replay
    assert!(text.contains("| A | 2 |") && text.contains("Largest screening ratio"), "{text}");
}
