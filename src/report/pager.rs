//! Text longer than the screen, shown a screen at a time by the pager of the system.
//!
//! The pager is that of `PAGER`, else `less` with the habits of `less -FRX`: it ends by itself where the text fits, keeps colours and
//! leaves the text on the screen. `less` runs with LESSSECURE, so that no key starts a program. Without a pager text is printed as it is.

use std::ffi::OsString;
use std::io::{ErrorKind, Write};
use std::path::Path;
use std::process::{Command, Stdio};

/// A program that shows text a screen at a time.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Pager {
    program: String,
    arguments: Vec<String>,
    /// `LESS` of the environment is kept.
    keeps_settings: bool,
}

impl Pager {
    /// The pager that the values of `PAGER` and `LESS` ask for; `None` for `cat` and an empty `PAGER`.
    pub fn new(pager: Option<OsString>, less: Option<OsString>) -> Option<Self> {
        let given = pager.map_or_else(|| "less".to_string(), |text| text.to_string_lossy().into_owned());
        let mut words = given.split_whitespace().map(str::to_string);
        let program = words.next().filter(|program| program != "cat")?;
        Some(Pager { program, arguments: words.collect(), keeps_settings: less.is_some_and(|text| !text.is_empty()) })
    }

    /// Shows a text; false when there is no such program. A user who leaves the pager early loses nothing: the log has all.
    pub fn show(&self, text: &str) -> bool {
        let mut command = Command::new(&self.program);
        command.args(&self.arguments).stdin(Stdio::piped());
        command.env("LESSSECURE", "1").env_remove("LESSOPEN").env_remove("LESSCLOSE");
        let is_less = Path::new(&self.program).file_stem().is_some_and(|stem| stem == "less");
        if is_less && !self.keeps_settings && self.arguments.is_empty() {
            command.env("LESS", "FRX").env("LESSCHARSET", "utf-8");
        }
        let Ok(mut child) = command.spawn() else { return false };
        let mut written = Ok(());
        if let Some(mut input) = child.stdin.take() {
            written = input.write_all(text.as_bytes());
        }
        let ended = child.wait();
        let left_early = written.as_ref().is_err_and(|error| error.kind() == ErrorKind::BrokenPipe);
        // a pager that could not do its work says so by its exit code
        ended.is_ok_and(|status| status.success()) || left_early
    }
}

/// Lines that a text takes on a screen of so many columns.
pub fn screen_lines(text: &str, columns: usize) -> usize {
    text.lines().map(|line| line.chars().count().div_ceil(columns.max(1)).max(1)).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pager_of_environment_is_split_in_words_and_cat_is_none() {
        let made = |pager: Option<&str>| Pager::new(pager.map(OsString::from), None);
        let more = made(Some("more -d -p")).unwrap();
        assert_eq!((more.program.as_str(), more.arguments.len()), ("more", 2));
        assert_eq!(made(None).unwrap().program, "less");
        assert_eq!((made(Some("cat")), made(Some(" "))), (None, None));
    }

    #[test]
    fn missing_pager_says_that_nothing_was_shown() {
        let none = Pager::new(Some("windlass-no-such-pager".into()), None).unwrap();
        assert!(!none.show("text"));
    }

    #[test]
    fn wrapped_and_empty_lines_count_as_the_screen_shows_them() {
        assert_eq!(screen_lines("ab\n\nabcdefghijk\n", 5), 1 + 1 + 3);
        assert_eq!(screen_lines("", 5), 0);
    }
}
