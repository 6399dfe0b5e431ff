//! `windlass verify`.

use super::case::{Case, CaseError, Cost, embedded, read_cases};
use super::installation::Installation;
use super::judge::Verdict;
use super::run::{CaseResult, run_case};
use super::{listing, page};
use crate::report::files::JobFolder;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;
use windlass_base::diagnostic::did_you_mean;

/// What to verify.
#[derive(clap::Args, Debug, Default)]
pub struct VerifyArgs {
    /// Cases to run and to show with their scripts; without one all are run
    pub names: Vec<String>,
    /// List the cases without running them
    #[arg(long)]
    pub list: bool,
    /// Run also the cases that take long
    #[arg(long)]
    pub all: bool,
    /// Write the table to a file too: .md (Markdown) or .csv
    #[arg(short, long, value_name = "FILE")]
    pub output: Option<PathBuf>,
    /// Cases of a folder (*.toml, with the files they read) in place of those in the program
    #[arg(long, value_name = "DIR")]
    pub cases: Option<PathBuf>,
}

/// How verification ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum VerifyEnd {
    /// Every quantity is met or explained.
    Met,
    /// A quantity is missed, a case cannot be read, or a file cannot be written.
    Missed,
    /// Wrong use of the command line.
    Usage,
}

/// A file of the table.
enum Form {
    Markdown,
    Csv,
}

/// Verifies: the table goes to `screen`, messages to `complain`.
pub fn verify(args: &VerifyArgs, screen: &mut dyn Write, complain: &dyn Fn(&str)) -> VerifyEnd {
    let output = match args.output.as_deref().map(form).transpose() {
        Ok(output) => output,
        Err(message) => {
            complain(&message);
            return VerifyEnd::Usage;
        }
    };
    let read = match args.cases.as_deref().map_or_else(|| Ok(embedded()), read_cases) {
        Ok(read) => read,
        Err(error) => {
            complain(&error.to_string());
            return VerifyEnd::Usage;
        }
    };
    let (cases, unreadable) = sort(read, complain);
    if cases.is_empty() && unreadable == 0 {
        complain("there are no cases: a case is a file NAME.toml of the folder");
        return VerifyEnd::Usage;
    }
    let chosen = match choose(&cases, args) {
        Ok(chosen) => chosen,
        Err(message) => {
            complain(&message);
            return VerifyEnd::Usage;
        }
    };
    let mut writer = Screen { screen, failed: None };
    if args.list {
        let list: Vec<Case> = chosen.into_iter().cloned().collect();
        writer.write(&listing::list(&list));
        return writer.end(if unreadable > 0 { VerifyEnd::Missed } else { VerifyEnd::Met }, complain);
    }
    let installation = Installation::here();
    let left_out = if args.names.is_empty() { cases.len() - chosen.len() } else { 0 };
    writer.write(&listing::head(&installation, chosen.len(), left_out));
    let begun = Instant::now();
    let mut results: Vec<(&Case, CaseResult)> = Vec::new();
    for case in chosen {
        let result = run_case(case);
        writer.write(&listing::case_block(case, &result));
        if !args.names.is_empty() {
            writer.write(&page::script_block(case));
        }
        results.push((case, result));
    }
    writer.write(&listing::summary(&results, unreadable, begun.elapsed().as_secs_f64()));
    let missed = unreadable > 0 || results.iter().any(|(_, result)| result.verdict() == Verdict::Missed);
    let mut end = if missed { VerifyEnd::Missed } else { VerifyEnd::Met };
    if let (Some(form), Some(file)) = (output, &args.output) {
        match write(&form, file, &installation, &results) {
            Ok(written) => writer.write(&format!("written: {written}\n")),
            Err(message) => {
                complain(&message);
                end = VerifyEnd::Missed;
            }
        }
    }
    writer.end(end, complain)
}

/// The form of a file, by its ending.
fn form(file: &Path) -> Result<Form, String> {
    match file.extension().and_then(|end| end.to_str()).map(str::to_ascii_lowercase).as_deref() {
        Some("md") => Ok(Form::Markdown),
        Some("csv") => Ok(Form::Csv),
        _ => Err(format!("--output {}: the ending chooses the form: .md or .csv", file.display())),
    }
}

/// The cases that could be read, and the number of the others, which are complained of.
fn sort(read: Vec<Result<Case, CaseError>>, complain: &dyn Fn(&str)) -> (Vec<Case>, usize) {
    let mut cases = Vec::new();
    let mut unreadable = 0;
    for one in read {
        match one {
            Ok(case) => cases.push(case),
            Err(error) => {
                unreadable += 1;
                complain(&error.to_string());
            }
        }
    }
    (cases, unreadable)
}

/// The cases asked for.
fn choose<'c>(cases: &'c [Case], args: &VerifyArgs) -> Result<Vec<&'c Case>, String> {
    if args.names.is_empty() {
        return Ok(cases.iter().filter(|case| args.all || args.list || case.cost != Cost::Long).collect());
    }
    let find = |name: &String| {
        let wanted = name.strip_suffix(".toml").unwrap_or(name);
        cases.iter().find(|case| case.name.eq_ignore_ascii_case(wanted)).ok_or_else(|| {
            let near = did_you_mean(wanted, cases.iter().map(|case| case.name.as_str()));
            format!(
                "there is no case {name}: {}",
                near.unwrap_or_else(|| "windlass verify --list has their names".into())
            )
        })
    };
    args.names.iter().map(find).collect()
}

fn write(
    form: &Form,
    file: &Path,
    installation: &Installation,
    results: &[(&Case, CaseResult)],
) -> Result<String, String> {
    let bytes = match form {
        Form::Markdown => page::markdown(Some(installation), results).into_bytes(),
        Form::Csv => page::csv(installation, results)?,
    };
    let wrong = |text: String| format!("the table is not written: {text}");
    let folder = file.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let name = file.file_name().ok_or_else(|| wrong(format!("{} is no file", file.display())))?;
    if !folder.is_dir() {
        return Err(wrong(format!("there is no folder {}", folder.display())));
    }
    let place = JobFolder::new(PathBuf::from("verification"), Some(folder.to_path_buf()), false);
    let written = place.check().and_then(|()| place.write(&name.to_string_lossy(), &bytes));
    written.map(|path| path.display().to_string()).map_err(|error| wrong(error.to_string()))
}

/// The screen, which may fail once.
struct Screen<'s> {
    screen: &'s mut dyn Write,
    failed: Option<std::io::Error>,
}

impl Screen<'_> {
    fn write(&mut self, text: &str) {
        if self.failed.is_none()
            && let Err(error) = self.screen.write_all(text.as_bytes()).and_then(|()| self.screen.flush())
        {
            self.failed = Some(error);
        }
    }

    /// The end, unless the screen was lost. A pipe that nobody reads any more is no trouble.
    fn end(self, end: VerifyEnd, complain: &dyn Fn(&str)) -> VerifyEnd {
        match self.failed {
            Some(error) if error.kind() != std::io::ErrorKind::BrokenPipe => {
                complain(&format!("standard output cannot be written: {error}"));
                VerifyEnd::Missed
            }
            _ => end,
        }
    }
}
