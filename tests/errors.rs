//! Error scripts: `tests/errors/*.cif` carry the message they must draw beside the record that draws it,
//! `$! error 5-9: text`, with the columns of the underlined word (from 1, both ends included). Every message must be
//! foretold and every foretold message must come; the model must be the same before and after each refused record.

#![allow(clippy::unwrap_used)]

use libtest_mimic::{Arguments, Failed, Trial};
use std::fs;
use std::path::{Path, PathBuf};
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_base::diagnostic::Severity;

fn main() {
    let arguments = Arguments::from_args();
    let mut scripts: Vec<PathBuf> = fs::read_dir("tests/errors").unwrap().flatten().map(|e| e.path()).collect();
    scripts.sort();
    let trials = scripts
        .into_iter()
        .map(|script| {
            let name = script.file_stem().unwrap().to_string_lossy().into_owned();
            Trial::test(name, move || check(&script))
        })
        .collect();
    libtest_mimic::run(&arguments, trials).exit();
}

/// Line, severity, columns, text.
type Foretold = (usize, String, Option<(usize, usize)>, String);

fn foretold(text: &str) -> Vec<Foretold> {
    let mut list = Vec::new();
    for (number, line) in text.lines().enumerate() {
        for part in line.split("$! ").skip(1) {
            let (head, message) = part.split_once(": ").unwrap();
            let (severity, columns) = head.split_once(' ').map_or((head, None), |(s, c)| (s, Some(c)));
            let columns = columns.map(|c| {
                let (from, to) = c.split_once('-').unwrap();
                (from.parse().unwrap(), to.parse().unwrap())
            });
            list.push((number + 1, severity.to_string(), columns, message.trim().to_string()));
        }
    }
    list
}

fn check(script: &Path) -> Result<(), Failed> {
    let folder = tempfile::tempdir()?;
    let text = fs::read_to_string(script)?;
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(Vec::new()), Box::new(Vec::new()), false));
    session.job.settings.error_limit = i64::MAX;
    session.keep_reports = true;
    session.open("script", text.clone());
    session.run();
    let mut wrong = Vec::new();
    let mut want = foretold(&text);
    for report in &session.reports {
        let severity = match report.severity {
            Severity::Note => "note",
            Severity::Warning => "warning",
            Severity::Error => "error",
            Severity::Fatal => "fatal",
        };
        let sources = &session.interpreter.sources;
        let (line, column) = report.span.and_then(|s| sources.position(s)).unwrap_or((0, 0));
        let width = report.span.map_or(0, |s| (s.end - s.start) as usize);
        let found = want.iter().position(|(l, s, c, m)| {
            *l == line
                && s == severity
                && c.is_none_or(|(from, to)| from == column && to + 1 == column + width.max(1))
                && report.message.contains(m.as_str())
        });
        match found {
            Some(index) => {
                want.remove(index);
            }
            None => wrong.push(format!(
                "not foretold: {line}: {severity} {column}-{}: {}",
                (column + width).saturating_sub(1),
                report.message
            )),
        }
    }
    wrong.extend(find_model_changes(&text));
    wrong.extend(want.iter().map(|w| format!("did not come: {w:?}")));
    if wrong.is_empty() { Ok(()) } else { Err(wrong.join("\n").into()) }
}

/// Records that drew an error and changed the model all the same: each record is fed by itself and the model compared.
fn find_model_changes(text: &str) -> Vec<String> {
    let folder = tempfile::tempdir().unwrap();
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(Vec::new()), Box::new(Vec::new()), false));
    session.interactive = true;
    session.interpreter.open_terminal();
    let mut wrong = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let (before, errors) = (format!("{:?}", session.job.model), session.errors);
        session.interpreter.feed("record", line, number + 1);
        session.run();
        if session.errors > errors && format!("{:?}", session.job.model) != before {
            wrong.push(format!("line {} was refused and changed the model", number + 1));
        }
    }
    wrong
}
