//! A session for tests: its job in a folder of its own, what it prints kept.

pub mod body_load;
#[path = "../../../crates/tether/tests/it/installed_example.rs"]
pub mod installed_example;
// here the numbers of MoorDyn alone are needed
#[allow(dead_code)]
#[path = "../../../crates/line-dynamics/tests/it/moordyn.rs"]
pub mod moordyn;
pub mod run;
pub mod tangent;

use std::io::Write;
use std::sync::{Arc, Mutex};
use tempfile::TempDir;
use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;

/// Fails unless a number is another to a share of it, or to that share of 1 where it is smaller.
pub fn assert_near(got: f64, want: f64, share: f64) {
    assert!((got - want).abs() <= share * want.abs().max(1.0), "{got} is not {want}");
}

/// Fails unless a number is another to a share of it, however small it is.
pub fn assert_share(got: f64, want: f64, share: f64) {
    assert!((got - want).abs() <= share * want.abs().max(1e-9), "{got} is not {want}");
}

/// What a session prints.
#[derive(Clone, Default)]
pub struct Screen(Arc<Mutex<Vec<u8>>>);

impl Screen {
    pub fn text(&self) -> String {
        String::from_utf8(self.0.lock().unwrap().clone()).unwrap()
    }
}

impl Write for Screen {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        self.0.lock().unwrap().extend_from_slice(bytes);
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// A session that keeps its reports, its screen, and the folder its job lives in as long as the value does.
pub fn session() -> (Session, Screen, TempDir) {
    let screen = Screen::default();
    let folder = tempfile::tempdir().unwrap();
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(screen.clone()), Box::new(std::io::sink()), false));
    session.keep_reports = true;
    (session, screen, folder)
}

/// What a session prints of records, with its messages and their help behind it, and the number of its errors.
pub fn print_records(records: &str) -> (String, i64) {
    let (mut session, screen, _folder) = session();
    session.open("records", records.to_string());
    session.run();
    let reported: Vec<String> = session.reports.iter().map(|d| format!("{} {}", d.message, d.help.join(" "))).collect();
    (format!("{}\n{}", screen.text(), reported.join("\n")), session.errors)
}

/// The same of records in metres and metric tons, in water of 1025 kg/m3.
pub fn print_metric_records(records: &str) -> (String, i64) {
    print_records(&format!("&DIMEN -DIMEN METERS M-TONS\n&DEFAULT -WATER 1025 -G 9.80665\n{records}\n"))
}

/// A number behind its name in a report: `Volume = 24.00 m3`; the last one.
pub fn fact(text: &str, name: &str) -> f64 {
    let named = |line: &str| {
        Some(line.trim().strip_prefix(name)?.trim().strip_prefix('=')?.split_whitespace().next()?.to_string())
    };
    let found = text.lines().filter_map(named).next_back().and_then(|word| word.parse().ok());
    found.unwrap_or_else(|| panic!("{name} in {text}"))
}

/// What a script prints, and its messages.
pub fn run_script(script: &str) -> (String, Vec<String>) {
    let (mut session, screen, _folder) = session();
    session.open("script", script.to_string());
    session.run();
    session.job.output.flush();
    (screen.text(), session.reports.iter().map(|r| r.message.clone()).collect())
}

/// The numbers that a string function gives behind a script.
pub fn function_values(script: &str, function: &str) -> Vec<f64> {
    let (text, said) = run_script(&format!("{script}&TYPE => {function}\n"));
    let line = text.lines().find_map(|line| line.strip_prefix("=> "));
    let line = line.unwrap_or_else(|| panic!("{function} gives nothing: {said:?}"));
    line.split_whitespace().map(|word| word.parse().unwrap()).collect()
}
