//! The channels of a job: the screen, the log, and the report file.

use super::files::{FileError, JobFolder, is_unlinked};
use super::pager::{Pager, screen_lines};
use std::io::{ErrorKind, Write};
use std::path::PathBuf;
use windlass_base::printable::printable;

/// Name of the log: type and serial, as MOSES names its answers.
const LOG: &str = "LOG00001.TXT";
/// Name of the report file.
const REPORT: &str = "OUT00001.TXT";

/// Bytes that are collected for the pager; a record that prints more is shown as it comes.
const MOST_COLLECTED: usize = 16 << 20;

/// Where everything a job says goes.
///
/// What goes to the screen goes to the log too; the log also holds the records read. The log and the report file are
/// made when first written to, and everything is handed to the system at once: a job that is killed keeps them. Text of records,
/// files and names passes here, and what a terminal would act on is spelled ([`printable`]). What cannot be written is kept as a
/// [`Trouble`], for the session to report.
pub struct Output {
    /// The job's folder.
    pub folder: JobFolder,
    screen: Box<dyn Write + Send>,
    messages: Box<dyn Write + Send>,
    /// Messages may use colour.
    pub colour: bool,
    /// Columns of the screen as it is now; `None` when it is no terminal.
    pub columns: fn() -> Option<usize>,
    /// Lines of the screen as it is now; `None` when it is no terminal.
    pub lines: fn() -> Option<usize>,
    /// Shows what is longer than the screen, where somebody looks on.
    pub pager: Option<Pager>,
    /// What the record at hand has printed and the screen does not show yet.
    collected: Option<String>,
    /// No log and no report file: a job that was given records on the command line only.
    pub keep_log: bool,
    log: Option<std::fs::File>,
    report: Option<(PathBuf, std::fs::File)>,
    log_failed: bool,
    screen_failed: bool,
    troubles: Vec<Trouble>,
}

/// Output that was lost.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Trouble {
    /// What was lost, and why.
    pub text: String,
    /// What to do about it.
    pub help: Option<&'static str>,
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
            lines: || None,
            pager: None,
            collected: None,
            keep_log: true,
            log: None,
            report: None,
            log_failed: false,
            screen_failed: false,
            troubles: Vec::new(),
        }
    }

    /// Writes text to the screen and the log; a newline is added where it lacks one.
    pub fn text(&mut self, text: &str) {
        self.laid_out(text, text);
    }

    /// Writes text as it is laid out for the screen to the screen, and as it is laid out for files to the log.
    pub fn laid_out(&mut self, for_screen: &str, for_log: &str) {
        let shown = printable(for_screen);
        match &mut self.collected {
            Some(page) => {
                page.push_str(&shown);
                if !shown.ends_with('\n') {
                    page.push('\n');
                }
                if page.len() > MOST_COLLECTED {
                    self.show_collected();
                }
            }
            None => self.write_screen(&shown),
        }
        self.log(for_log);
    }

    fn write_screen(&mut self, text: &str) {
        let written = write_text(&mut self.screen, text);
        self.lose_screen(written);
    }

    /// From here on text for the screen is collected, where there is a pager, until [`Output::show_collected`].
    pub fn collect(&mut self) {
        if self.pager.is_some() && self.collected.is_none() {
            self.collected = Some(String::new());
        }
    }

    /// Shows what was collected: by the pager where it is longer than the screen, else as it is. True where the pager was asked.
    pub fn show_collected(&mut self) -> bool {
        let Some(page) = self.collected.take().filter(|page| !page.is_empty()) else { return false };
        let written = self.screen.flush();
        self.lose_screen(written);
        let (columns, lines) = ((self.columns)().unwrap_or(80), (self.lines)().unwrap_or(usize::MAX));
        // the prompt takes a line too
        let is_long = screen_lines(&page, columns) >= lines;
        if !is_long || !self.pager.as_ref().is_some_and(|pager| pager.show(&page)) {
            self.write_screen(&page);
        }
        is_long
    }

    /// Writes a message: in colour (if allowed) to the message stream, plain to the log. The text of the user in the coloured one must be
    /// [`printable`] already.
    pub fn message(&mut self, coloured: &str, plain: &str) {
        self.flush();
        // a message that cannot be written has nowhere else to go but the log
        let _ = if self.colour {
            write_text(&mut self.messages, coloured)
        } else {
            write_text(&mut self.messages, &printable(plain))
        };
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
                Err(error) => {
                    let help = error.help().or(Some("--out DIR names another folder for answers"));
                    return self.lose_log(format!("no log is kept: {error}"), help);
                }
            }
        }
        if let Some(log) = &mut self.log
            && let Err(error) = append(log, &printable(text))
        {
            self.lose_log(format!("the log ends here: {error}"), None);
        }
    }

    /// Goes on without a log, and says so once.
    fn lose_log(&mut self, text: String, help: Option<&'static str>) {
        self.log_failed = true;
        self.troubles.push(Trouble { text, help });
    }

    /// Goes on without a screen, and says so once. A pipe that nobody reads any more is no trouble.
    fn lose_screen(&mut self, written: std::io::Result<()>) {
        if let Err(error) = written
            && error.kind() != ErrorKind::BrokenPipe
            && !self.screen_failed
        {
            self.screen_failed = true;
            self.troubles.push(Trouble { text: format!("standard output cannot be written: {error}"), help: None });
        }
    }

    /// What was lost since this was last asked.
    pub fn troubles(&mut self) -> Vec<Trouble> {
        std::mem::take(&mut self.troubles)
    }

    /// At the end of a job: sees that its files are still there.
    pub fn check_files(&mut self) {
        let log = self.log.take().map(|file| (self.folder.folder.join(LOG), file));
        let deleted = |(path, file): (PathBuf, std::fs::File)| is_unlinked(&file).then_some(path);
        for path in log.into_iter().chain(self.report.take()).filter_map(deleted) {
            self.log_failed |= path.ends_with(LOG);
            let text = format!("{} was deleted while the job ran", path.display());
            self.troubles.push(Trouble { text, help: None });
        }
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
            Some((path, file)) => {
                append(file, &printable(text)).map_err(|source| FileError::System { path: path.clone(), source })
            }
            None => Ok(()),
        }
    }

    /// Empties the buffer of the screen, and shows what was collected; the files have none.
    pub fn flush(&mut self) {
        self.show_collected();
        let written = self.screen.flush();
        self.lose_screen(written);
    }
}

/// Adds text to a file in one piece, its last line ended.
fn append(file: &mut std::fs::File, text: &str) -> std::io::Result<()> {
    if text.ends_with('\n') { file.write_all(text.as_bytes()) } else { file.write_all(format!("{text}\n").as_bytes()) }
}

/// Writes text and ends its last line.
fn write_text(to: &mut dyn Write, text: &str) -> std::io::Result<()> {
    to.write_all(text.as_bytes())?;
    if text.ends_with('\n') { Ok(()) } else { to.write_all(b"\n") }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn output(folder: &std::path::Path) -> Output {
        let job = JobFolder::new(folder.join("job"), None, false);
        Output::new(job, Box::new(std::io::sink()), Box::new(std::io::sink()), false)
    }

    #[test]
    fn log_is_written_before_the_job_ends() {
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
    fn unwritable_answers_folder_loses_log_and_refuses_report() {
        let dir = tempfile::tempdir().unwrap();
        std::fs::write(dir.path().join("job.ans"), "in the way").unwrap();
        let mut out = output(dir.path());
        out.log("lost");
        assert!(out.log_failed && out.hard("refused").is_err());
        assert!(out.troubles().iter().any(|t| t.text.contains("no log is kept")));
    }
}
