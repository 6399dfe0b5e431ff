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
