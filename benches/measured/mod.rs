//! Models from records, and the seconds of the processor.

// every bench takes what it needs
#![allow(dead_code, clippy::unwrap_used)]

use windlass::report::files::JobFolder;
use windlass::report::output::Output;
use windlass::session::Session;
use windlass_model::Model;

/// The model that records make; the job has a folder of its own, since tests run side by side.
pub fn model_from_records(records: &str) -> Model {
    let folder = tempfile::tempdir().unwrap();
    let job = JobFolder::new(folder.path().join("job"), None, false);
    let mut session = Session::new(Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false));
    session.keep_reports = true;
    session.open("bench", records.to_string());
    session.run();
    assert_eq!(session.errors, 0, "{:?}", session.reports);
    session.job.model.clone()
}

/// Seconds the processor has worked for this program, in hundredths.
pub fn processor() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/self/stat").ok()?;
    let ticks: f64 = text.rsplit(')').next()?.split_whitespace().nth(11)?.parse().ok()?;
    Some(ticks / 100.0)
}

/// Seconds the processor has worked for this thread, to the nanosecond, where the system reports them.
pub fn thread_time() -> Option<f64> {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").ok()?;
    Some(1e-9 * text.split_whitespace().next()?.parse::<f64>().ok()?)
}
