//! `windlass verify`: the cases of share/verification, their page in the manual, and cases of a user that are wrong.

use std::fmt::Write;
use std::fs;
use std::path::Path;
use std::process::Command;
use windlass::verification::{Case, CaseResult, Cost, Verdict, embedded, markdown, run_case};

/// Longest name of a quantity with its unit that fits its column.
const NAME_WIDTH: usize = 34;

fn cases() -> Vec<Case> {
    embedded().into_iter().map(|case| case.unwrap_or_else(|error| panic!("{error}"))).collect()
}

/// Whether this build runs a case: a debug build only what is quick.
fn is_run(case: &Case) -> bool {
    case.cost == Cost::Quick || !cfg!(debug_assertions)
}

/// Runs `windlass verify` in a folder: exit code, standard output, messages.
fn verify(folder: &Path, words: &[&str]) -> (Option<i32>, String, String) {
    let run =
        Command::new(env!("CARGO_BIN_EXE_windlass")).arg("verify").args(words).current_dir(folder).output().unwrap();
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).unwrap();
    (run.status.code(), text(&run.stdout), text(&run.stderr))
}

/// A case of one line of 100 m that weighs 1 kN/m and hangs straight down 100 m.
fn hanging_line(quantity: &str) -> String {
    format!(
        "shows = \"A line that hangs straight down\"\nsource = \"weight times length\"\nreference = \"closed form\"\nscript = '''\n\
         &DIMEN -DIMEN METERS KN\nMEDIT\n*TOP 0 0 100\n*LOW 0 0 0\n~LINE H_CAT 100 EXACT -LEN 99 -WTPL 1 -EMOD 1E9\n\
         CONNECTOR A ~LINE *TOP *LOW\nEND\n&STATUS F_CONNECTOR\n&SET N = 7 8\n'''\n{quantity}"
    )
}

#[test]
fn cases_are_of_their_form_and_as_many_as_promised() {
    let cases = cases();
    let quantities: usize = cases.iter().map(|case| case.quantities.len()).sum();
    assert!(cases.len() >= 40 && quantities >= 150, "{} cases, {quantities} quantities", cases.len());
    let mut wide = String::new();
    for case in &cases {
        let plain = case.name.bytes().all(|b| b.is_ascii_lowercase() || b.is_ascii_digit() || b == b'-');
        assert!(plain && case.shows.chars().count() < 100, "{}", case.name);
        for quantity in &case.quantities {
            let unit = if quantity.unit.is_empty() { 0 } else { quantity.unit.chars().count() + 3 };
            if quantity.name.chars().count() + unit > NAME_WIDTH {
                writeln!(wide, "{}: {}", case.name, quantity.name).unwrap();
            }
        }
    }
    assert!(wide.is_empty(), "names wider than their column:\n{wide}");
}

/// The rows of the tables of a section of the page, without heads.
fn rows(section: &str) -> Vec<Vec<&str>> {
    let lines = section.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| ---"));
    lines.map(|line| line.trim_matches(['|', ' ']).split(" | ").map(str::trim).collect::<Vec<_>>()).skip(1).collect()
}

/// Whether two cells say the same: numbers may differ by two units of their last digit, which mathematics libraries leave.
fn same(kept: &str, made: &str) -> bool {
    let unit = |text: &str| {
        let (digits, power) = text.split_once('e').unwrap_or((text, "0"));
        let decimals = digits.split_once('.').map_or(0, |(_, d)| d.len());
        10f64.powi(power.parse::<i32>().unwrap_or(0) - i32::try_from(decimals).unwrap())
    };
    match (kept.parse::<f64>(), made.parse::<f64>()) {
        (Ok(a), Ok(b)) => (a - b).abs() <= 2.0 * unit(kept),
        _ => kept == made,
    }
}

#[test]
fn quick_cases_are_met_and_page_of_manual_is_theirs() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("docs/verification.md");
    let page = fs::read_to_string(&path).unwrap();
    let bless = std::env::var_os("BLESS").is_some();
    let cases = cases();
    let chosen = cases.iter().filter(|case| bless || is_run(case));
    let results: Vec<(&Case, CaseResult)> = chosen.map(|case| (case, run_case(case))).collect();
    let missed: Vec<String> = results
        .iter()
        .filter(|(_, result)| result.verdict() == Verdict::Missed)
        .map(|(case, result)| format!("{}: {result:?}", case.name))
        .collect();
    assert!(missed.is_empty(), "{}", missed.join("\n"));
    let made = markdown(None, &results);
    let (before, rest) = page.split_once("do not edit. -->\n").unwrap();
    let (kept, after) = rest.split_once("<!-- End of cases. -->").unwrap();
    if bless {
        fs::write(&path, format!("{before}do not edit. -->\n\n{made}<!-- End of cases. -->{after}")).unwrap();
        return;
    }
    let section = |text: &str, name: &str| -> Option<String> {
        let (_, rest) = text.split_once(&format!("### {name}\n"))?;
        Some(rest.split("\n### ").next().unwrap_or(rest).to_string())
    };
    for case in &cases {
        let kept = section(kept, &case.name).unwrap_or_else(|| panic!("{} is not in docs/verification.md", case.name));
        let names = rows(&kept).len();
        assert_eq!(names, case.quantities.len(), "{}: the page has other quantities", case.name);
        let Some(made) = section(&made, &case.name) else { continue };
        for (kept, made) in rows(&kept).iter().zip(rows(&made)) {
            // quantity, unit, printed, ours, tolerance, verdict; errors follow from them
            for at in [0, 1, 2, 3, 6, 7] {
                assert!(same(kept[at], made[at]), "{}: the page has {kept:?}, now it is {made:?}", case.name);
            }
        }
        let words =
            |text: &str| text.lines().filter(|l| !l.starts_with('|')).collect::<Vec<_>>().join("\n").trim().to_string();
        assert_eq!(words(&kept), words(&made), "{}: docs/verification.md is of another case file", case.name);
    }
    assert_eq!(kept.matches("\n### ").count(), cases.len(), "the page has a case that is no more");
}

#[test]
fn met_explained_and_missed_quantities_set_the_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let cases = folder.path().join("own");
    fs::create_dir(&cases).unwrap();
    // H_CAT carries 99 kN at its top and stretches to 100 m: EA 7.854e9 kN times 1/99 on its middle
    let quantity = |name: &str, printed: &str, more: &str| {
        format!("[[quantity]]\nname = \"{name}\"\nunit = \"\"\nprinted = \"{printed}\"\nours = \"%N 2%\"\n{more}\n")
    };
    let met = quantity("digits", "8.0", "") + &quantity("met", "8.4", "tolerance = \"5 %\"\nreason = \"said\"");
    let explained = quantity("explained", "9", "explained = { within = \"1\", reason = \"rounded up\" }");
    fs::write(cases.join("good.toml"), hanging_line(&format!("{met}{explained}"))).unwrap();
    let (code, out, err) = verify(folder.path(), &["--cases", "own", "--output", "t.csv"]);
    assert_eq!((code, err.as_str()), (Some(0), ""), "{out}");
    for text in [
        "met to its digits      1",
        "met                    1",
        "explained              1",
        "MISSED                 0",
        "rounded up",
        "within 5 %; said",
    ] {
        assert!(out.contains(text), "{text}\n{out}");
    }
    assert!(out.lines().all(|line| line.chars().count() <= 100), "{out}");
    let mut reader = csv::Reader::from_path(folder.path().join("t.csv")).unwrap();
    let written: Vec<csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(written.len(), 3);
    assert_eq!((&written[1][3], &written[1][6], &written[1][7], &written[1][12]), ("met", "8.4", "8", "met"));
    fs::write(cases.join("bad.toml"), hanging_line(&quantity("missed", "9", ""))).unwrap();
    let (code, out, _) = verify(folder.path(), &["--cases", "own", "-o", "t.md"]);
    assert_eq!(code, Some(1), "{out}");
    assert!(out.contains("missed in: bad"), "{out}");
    assert!(fs::read_to_string(folder.path().join("t.md")).unwrap().contains("### good"));
    // a case by its name is shown with its script
    let (code, out, _) = verify(folder.path(), &["--cases", "own", "GOOD"]);
    assert_eq!((code, out.contains("  &STATUS F_CONNECTOR\n")), (Some(0), true), "{out}");
    let (code, out, _) = verify(folder.path(), &["--cases", "own", "--list"]);
    assert_eq!((code, out.contains("2 cases, 4 quantities")), (Some(0), true), "{out}");
}

#[test]
fn wrong_case_file_is_located_and_the_others_are_run() {
    let folder = tempfile::tempdir().unwrap();
    let good = "[[quantity]]\nname = \"n\"\nprinted = \"8\"\nours = \"%N 2%\"\n";
    fs::write(folder.path().join("a-good.toml"), hanging_line(good)).unwrap();
    // the script ends in line 14, and the quantity begins in line 15
    for (quantity, message) in [
        (good.replace("printed", "prnted"), "b.toml:17:1: prnted: unknown field `prnted`, expected one of"),
        (good.replace("\"8\"", "\"8 kN\""), "b.toml:17:11: printed: `8 kN` is not a number as a source prints it"),
        (good.replace("\"8\"", "8"), "b.toml:17:11: printed: invalid type: integer `8`, expected a string"),
        (format!("{good}tolerance = \"5\"\n"), "b.toml:19:13: reason: the tolerance has no reason beside it"),
        (
            format!("{good}tolerance = \"5 mm\"\nreason = \"so\"\n"),
            "b.toml:19:13: tolerance: `5 mm` is neither a number",
        ),
        (good.replace("%N 2%", "A | B | C | D"), "b.toml:18:8: ours: a place is written"),
        (good.replace("printed = \"8\"\n", ""), "b.toml:16:8: printed: the number of the source is missing"),
        (format!("{good}{good}"), "b.toml:20:8: name: a second quantity is called `n`"),
        (String::new(), "b.toml: quantity: the case compares nothing"),
        ("[[quantity]\n".to_string(), "b.toml:15:12:"),
    ] {
        fs::write(folder.path().join("b.toml"), hanging_line(&quantity)).unwrap();
        let (code, out, err) = verify(folder.path(), &["--cases", "."]);
        assert_eq!(code, Some(1), "{err}");
        assert!(err.contains(message), "{message}\n{err}");
        assert!(out.contains("a-good") && out.contains("1 case files could not be read"), "{out}");
    }
    // a refused script, a missing table and a wrong row are missed, with the reason
    fs::write(folder.path().join("b.toml"), hanging_line(&good.replace("%N 2%", "Forces | A | FX"))).unwrap();
    let (code, out, _) = verify(folder.path(), &["--cases", "."]);
    assert!(code == Some(1) && out.contains("there is no table Forces"), "{out}");
    fs::write(folder.path().join("b.toml"), hanging_line(good).replace("-LEN 99", "-LENGHT 99")).unwrap();
    let (code, out, _) = verify(folder.path(), &["--cases", "."]);
    assert!(code == Some(1) && out.contains("unknown option of H_CAT `-LENGHT`"), "{out}");
}

#[test]
fn wrong_use_of_verify_is_refused_before_anything_runs() {
    let folder = tempfile::tempdir().unwrap();
    for (words, message) in [
        (vec!["--output", "t.xls"], "--output t.xls: the ending chooses the form: .md or .csv"),
        (vec!["oc3-line-tabel"], "there is no case oc3-line-tabel: did you mean oc3-line-table?"),
        (vec!["--cases", "nowhere"], "nowhere: No such file or directory"),
        (vec!["--cases", "."], "there are no cases"),
    ] {
        let (code, out, err) = verify(folder.path(), &words);
        assert_eq!((code, out.as_str()), (Some(2), ""), "{err}");
        assert!(err.contains(message), "{err}");
    }
    let (code, _, err) = verify(folder.path(), &["rainflow-astm", "--output", "none/t.csv"]);
    assert_eq!((code, err.contains("the table is not written: there is no folder none")), (Some(1), true), "{err}");
}
