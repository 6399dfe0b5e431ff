//! The channels of a job: the screen, the log, and the report file.

use super::files::{FileError, JobFolder};
use std::io::Write;
use std::path::PathBuf;

/// Name of the log: type and serial, as MOSES names its answers.
const LOG: &str = "LOG00001.TXT";
/// Name of the report file.
const REPORT: &str = "OUT00001.TXT";

/// Where everything a job says goes.
///
/// What goes to the screen goes to the log too; the log also holds the records read. The log and the report file are
/// made when first written to, and everything is handed to the system at once: a job that is killed keeps them.
pub struct Output {
    /// The job's folder.
    pub folder: JobFolder,
    screen: Box<dyn Write + Send>,
    messages: Box<dyn Write + Send>,
    /// Messages may use colour.
    pub colour: bool,
    /// Columns of the screen as it is now; `None` when it is no terminal.
    pub columns: fn() -> Option<usize>,
    /// No log and no report file: a job that was given records on the command line only.
    pub keep_log: bool,
    log: Option<std::fs::File>,
    report: Option<(PathBuf, std::fs::File)>,
    log_failed: bool,
}

impl Output {
    /// Channels writing to a screen, and to a second stream for messages.
    pub fn new(
        folder: JobFolder,
        screen: Box<dyn Write + Send>,
        messages: Box<dyn Write + Send>,
        colour: bool,
    ) -> Self {
        Output {
            folder,
            screen,
            messages,
            colour,
            columns: || None,
            keep_log: true,
            log: None,
            report: None,
            log_failed: false,
        }
    }

    /// Writes text to the screen and the log; a newline is added where it lacks one.
    pub fn text(&mut self, text: &str) {
        put(&mut self.screen, text);
        self.log(text);
    }

    /// Writes a message: in colour (if allowed) to the message stream, plain to the log.
    pub fn message(&mut self, coloured: &str, plain: &str) {
        // a screen that is gone (a closed pipe) must not stop the job
        let _ = self.screen.flush();
        put(&mut self.messages, if self.colour { coloured } else { plain });
        let _ = self.messages.flush();
        self.log(plain);
    }

    /// Writes text to the log only.
    pub fn log(&mut self, text: &str) {
        if !self.keep_log || self.log_failed {
            return;
        }
        if self.log.is_none() {
            match self.folder.create(LOG) {
                Ok(file) => self.log = Some(file),
                Err(error) => return self.lose_log(&format!("no log is kept: {error}")),
            }
        }
        if let Some(log) = &mut self.log
            && let Err(error) = append(log, text)
        {
            self.lose_log(&format!("the log ends here: {error}"));
        }
    }

    /// Goes on without a log, and says so once.
    fn lose_log(&mut self, why: &str) {
        self.log_failed = true;
        put(&mut self.messages, &format!("warning: {why}"));
    }

    /// Writes text to the report file `OUT00001.TXT`.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn hard(&mut self, text: &str) -> Result<(), FileError> {
        if self.report.is_none() {
            let file = self.folder.create(REPORT)?;
            self.report = Some((self.folder.folder.join(REPORT), file));
        }
        match &mut self.report {
            Some((path, file)) => append(file, text).map_err(|source| FileError::System { path: path.clone(), source }),
            None => Ok(()),
        }
    }

    /// Empties the buffer of the screen; the files have none.
    pub fn flush(&mut self) {
        let _ = self.screen.flush();
    }
}

/// Adds text to a file in one piece, its last line ended.
fn append(file: &mut std::fs::File, text: &str) -> std::io::Result<()> {
    if text.ends_with('\n') { file.write_all(text.as_bytes()) } else { file.write_all(format!("{text}\n").as_bytes()) }
}

/// Writes text and ends its last line; a stream that refuses loses it.
fn put(to: &mut dyn Write, text: &str) {
    let _ = to.write_all(text.as_bytes());
    if !text.ends_with('\n') {
        let _ = to.write_all(b"\n");
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(folder: &std::path::Path) -> Output {
        let job = JobFolder::new(folder.join("job"), None, false);
        Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false)
    }

    #[test]
    fn what_was_said_is_in_the_files_before_the_job_ends() {
        let dir = tempfile::tempdir().unwrap();
        let mut out = output(dir.path());
        out.log("> TABLE A");
        out.text("said\n");
        out.hard("reported").unwrap();
        // nothing is flushed and nothing dropped: the state a killed job leaves
        let read = |name: &str| std::fs::read_to_string(out.folder.folder.join(name)).unwrap();
        assert_eq!((read(LOG), read(REPORT)), ("> TABLE A\nsaid\n".into(), "reported\n".into()));
    }

    #[test]
    fn a_folder_that_cannot_be_made_costs_the_log_and_refuses_the_report() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("job.ans"), "in the way").unwrap();
        let mut out = output(dir.path());
        out.log("lost");
        assert!(out.log_failed && out.hard("refused").is_err());
    }
}
