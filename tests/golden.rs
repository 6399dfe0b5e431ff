//! Golden scripts: every `scripts/*.cif`, and the decks `scripts/*.dat`, is run as a user runs it, and its log and the CSV files it writes are compared
//! with `tests/golden/`. Text must be equal; numbers may differ by 2e-6 of their size, the room between mathematics
//! libraries in numbers printed with up to seven figures. `BLESS=1 cargo test --test golden` accepts what is printed.

#![allow(clippy::unwrap_used)]

use libtest_mimic::{Arguments, Failed, Trial};
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

const TOLERANCE: f64 = 2e-6;
/// Numbers smaller than this are what rounding leaves of forces in thousands of units: their digits are those of a machine.
const ROUNDING: f64 = 1e-7;

fn main() {
    let arguments = Arguments::from_args();
    let mut scripts: Vec<PathBuf> = fs::read_dir("scripts").unwrap().flatten().map(|e| e.path()).collect();
    // he01.dat is he01_phases.dat with random phases
    let is_run = |p: &Path| p.extension().is_some_and(|e| e == "cif" || (e == "dat" && !p.ends_with("he01.dat")));
    scripts.retain(|p| is_run(p));
    scripts.sort();
    let mut trials: Vec<Trial> = scripts
        .into_iter()
        .map(|script| {
            let name = script.file_stem().unwrap().to_string_lossy().into_owned();
            Trial::test(name.clone(), move || check(&script, &name))
        })
        .collect();
    trials.push(Trial::test("study", check_study));
    libtest_mimic::run(&arguments, trials).exit();
}

/// The line of a page head of a deck, which sets no date, with today's blotted out.
fn without_date(line: &str) -> String {
    let date = line.strip_prefix('*').and_then(|l| l.strip_suffix('*')).map(str::trim).filter(|word| {
        let fits = |(i, c): (usize, char)| if i == 4 || i == 7 { c == '-' } else { c.is_ascii_digit() };
        word.len() == 10 && word.char_indices().all(fits)
    });
    date.map_or_else(|| line.to_string(), |date| line.replace(date, "YYYY-MM-DD"))
}

fn check(script: &Path, name: &str) -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("out");
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).arg(script).arg("--out").arg(&out).output()?;
    let mut text = format!("exit code {}\n", run.status.code().unwrap_or(-1));
    let mut files: Vec<PathBuf> = fs::read_dir(&out)?.flatten().map(|e| e.path()).filter(|p| p.is_file()).collect();
    files.sort();
    for file in files {
        let title = file.file_name().unwrap().to_string_lossy().into_owned();
        let shown = match file.extension().and_then(|e| e.to_str()) {
            Some("png" | "svg") => "(a picture)\n".to_string(),
            Some("html") => "(a page)\n".to_string(),
            Some("parquet" | "nc") => "(not text)\n".to_string(),
            // the rows of a run as numbers, this one's or an earlier one's: what they come to is in the log
            _ if title.contains(".run") => "(a run)\n".to_string(),
            Some("csv") => without_residuals(&fs::read_to_string(&file)?),
            _ => {
                let text = fs::read_to_string(&file)?
                    .replace(&*out.to_string_lossy(), "OUT")
                    .replace(env!("CARGO_MANIFEST_DIR"), "HERE");
                let is_deck = script.extension().is_some_and(|e| e == "dat");
                let dated = |l: &str| if is_deck { without_date(l) } else { l.to_string() };
                // what &DCPTIME prints is a time of the machine
                text.lines().filter(|l| !l.starts_with("*** time ")).map(|l| format!("{}\n", dated(l))).collect()
            }
        };
        text.push_str(&format!("==== {title}\n{shown}"));
    }
    hold(&text, name)
}

/// The small study of scripts/study: what it prints, and its tables without the seconds that cases took.
fn check_study() -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let out = folder.path().join("S");
    let words = ["study", "scripts/study/tanker.toml", "scripts/study/tanker.cif", "--out"];
    let run = Command::new(env!("CARGO_BIN_EXE_windlass")).args(words).arg(&out).output()?;
    let said = String::from_utf8(run.stdout)?.replace(&*out.to_string_lossy(), "OUT");
    let mut text = format!("exit code {}\n{said}", run.status.code().unwrap_or(-1));
    for name in ["results.csv", "lines.csv", "ensembles.csv"] {
        let mut reader = csv::Reader::from_path(out.join(name))?;
        let seconds = reader.headers()?.iter().position(|head| head == "seconds (s)");
        let mut writer = csv::Writer::from_writer(Vec::new());
        for record in std::iter::once(Ok(reader.headers()?.clone())).chain(reader.records()) {
            let record = record?;
            writer
                .write_record(record.iter().enumerate().filter(|(at, _)| Some(*at) != seconds).map(|(_, cell)| cell))?;
        }
        text.push_str(&format!("==== {name}\n{}", String::from_utf8(writer.into_inner()?)?));
    }
    hold(&text, "study")
}

/// Compares with what is stored, or stores it.
fn hold(text: &str, name: &str) -> Result<(), Failed> {
    let golden = Path::new("tests/golden").join(format!("{name}.txt"));
    if std::env::var_os("BLESS").is_some() {
        fs::write(&golden, text)?;
        return Ok(());
    }
    let want = fs::read_to_string(&golden).map_err(|e| format!("{}: {e}; BLESS=1 makes it", golden.display()))?;
    compare(&want, text)
}

/// A CSV file with `small` for a residual of at most 1e-9 of the fairlead tension: below that its digits are rounding.
fn without_residuals(text: &str) -> String {
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_reader(text.as_bytes());
    let heads = reader.headers().unwrap().clone();
    let at = |name: &str| heads.iter().position(|h| h == name);
    let (Some(residual), Some(h), Some(v)) = (at("residual"), at("fairlead_H_N"), at("fairlead_V_N")) else {
        return text.to_string();
    };
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(&heads).unwrap();
    for record in reader.records() {
        let record = record.unwrap();
        let number = |at: usize| record[at].parse::<f64>().unwrap_or(f64::NAN);
        let small = number(residual).abs() <= 1e-9 * number(h).hypot(number(v));
        let cells = record.iter().enumerate().map(|(at, cell)| if small && at == residual { "small" } else { cell });
        writer.write_record(cells).unwrap();
    }
    String::from_utf8(writer.into_inner().unwrap()).unwrap()
}

fn compare(want: &str, got: &str) -> Result<(), Failed> {
    for (number, (w, g)) in want.lines().zip(got.lines()).enumerate() {
        if !same(w, g) {
            return Err(format!("line {}:\n  want {w}\n  got  {g}", number + 1).into());
        }
    }
    if want.lines().count() != got.lines().count() {
        return Err(format!("{} lines wanted, {} got", want.lines().count(), got.lines().count()).into());
    }
    Ok(())
}

/// Equal but for numbers, which may differ within the tolerance; the blanks that fill a column may then differ too.
fn same(want: &str, got: &str) -> bool {
    if want == got {
        return true;
    }
    let split = |s: &str| s.split([' ', ',']).filter(|w| !w.is_empty()).map(str::to_string).collect::<Vec<_>>();
    let (want, got) = (split(want), split(got));
    want.len() == got.len()
        && want.iter().zip(&got).all(|(w, g)| match (w.parse::<f64>(), g.parse::<f64>()) {
            (Ok(a), Ok(b)) => (a - b).abs() <= (TOLERANCE * a.abs().max(b.abs())).max(ROUNDING),
            _ => w == g,
        })
}
