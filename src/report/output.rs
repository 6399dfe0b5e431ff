//! The channels of a job: the screen, the log, and the report file.

use super::files::{FileError, JobFolder};
use std::io::{BufWriter, Write};

/// Where everything a job says goes.
///
/// What goes to the screen goes to the log too; the log also holds the records read. The log and the report file are
/// made when first written to.
pub struct Output {
    /// The job's folder.
    pub folder: JobFolder,
    screen: Box<dyn Write + Send>,
    messages: Box<dyn Write + Send>,
    /// Messages may use colour.
    pub colour: bool,
    /// No log and no report file: a job that was given records on the command line only.
    pub keep_log: bool,
    log: Option<BufWriter<std::fs::File>>,
    report: Option<BufWriter<std::fs::File>>,
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
        Output { folder, screen, messages, colour, keep_log: true, log: None, report: None, log_failed: false }
    }

    /// Writes text to the screen and the log; a newline is added where it lacks one.
    pub fn text(&mut self, text: &str) {
        put(&mut self.screen, text);
        self.log(text);
        self.flush_log();
    }

    /// Writes a message: in colour (if allowed) to the message stream, plain to the log.
    pub fn message(&mut self, coloured: &str, plain: &str) {
        // a screen that is gone (a closed pipe) must not stop the job
        let _ = self.screen.flush();
        put(&mut self.messages, if self.colour { coloured } else { plain });
        let _ = self.messages.flush();
        self.log(plain);
        self.flush_log();
    }

    /// Empties the log's buffer: what has been said is kept though the run be killed. Records alone wait in the buffer.
    fn flush_log(&mut self) {
        if let Some(log) = &mut self.log {
            let _ = log.flush();
        }
    }

    /// Writes text to the log only.
    pub fn log(&mut self, text: &str) {
        if !self.keep_log || self.log_failed {
            return;
        }
        if self.log.is_none() {
            match self.folder.create("LOG00001.TXT") {
                Ok(file) => self.log = Some(BufWriter::new(file)),
                Err(error) => {
                    self.log_failed = true;
                    put(&mut self.messages, &format!("warning: no log is kept: {error}"));
                    return;
                }
            }
        }
        if let Some(log) = &mut self.log {
            put(log, text);
        }
    }

    /// Writes text to the report file `OUT00001.TXT`.
    ///
    /// # Errors
    /// What the system refuses.
    pub fn hard(&mut self, text: &str) -> Result<(), FileError> {
        if self.report.is_none() {
            self.report = Some(BufWriter::new(self.folder.create("OUT00001.TXT")?));
        }
        if let Some(report) = &mut self.report {
            put(report, text);
        }
        Ok(())
    }

    /// Empties all buffers.
    pub fn flush(&mut self) {
        let _ = self.screen.flush();
        for file in [&mut self.log, &mut self.report].into_iter().flatten() {
            let _ = file.flush();
        }
    }
}

/// Writes text and ends its last line; a stream that refuses loses it.
fn put(to: &mut dyn Write, text: &str) {
    let _ = to.write_all(text.as_bytes());
    if !text.ends_with('\n') {
        let _ = to.write_all(b"\n");
    }
}
