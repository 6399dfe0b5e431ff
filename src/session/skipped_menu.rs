//! What follows a record that should have opened a menu and was refused: in a script the commands meant for that menu are
//! passed over up to its `END`, so that one mistake gives one message and every `END` leaves the menu it was written for.

use super::{Meaning, Session};
use crate::commands::{Command, Menu, find_opened_menu};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_language::record::Word;
use windlass_language::token::TokenKind;

impl Session {
    /// Hands back the error of a command; where the command would have opened a menu, and the run goes on, its place is
    /// taken by a menu that passes over what follows.
    pub(super) fn refuse(&mut self, command: &Command, words: &[Word], error: Box<Diagnostic>) -> Box<Diagnostic> {
        let settings = &self.job.settings;
        let last = settings.batch
            || self.errors - self.errors_of_absent + 1 >= settings.error_limit
            || error.severity == Severity::Fatal;
        match find_opened_menu(&self.job, command.spec, words) {
            Some(name) if !self.interactive && !last => {
                self.job.menus.push(Menu::Refused(name));
                error.help("the commands up to its END are passed over")
            }
            _ => error,
        }
    }

    /// Whether the innermost menu is one whose opener was refused.
    pub(super) fn passing(&self) -> bool {
        matches!(self.job.menu(), Menu::Refused(_))
    }

    /// Passes over a plain record of a refused menu; false when the record acts as in every menu. A command that opens a
    /// menu is one more for whose `END` to wait.
    pub(super) fn pass_over(&mut self, first: &Word, words: &[Word]) -> bool {
        if !self.passing() || first.kind == TokenKind::Internal {
            return false;
        }
        match self.resolve(first) {
            Ok(Meaning::Absent(entry)) => {
                self.job.menus.extend(entry.opens.map(Menu::Refused));
                true
            }
            Ok(Meaning::Macro(_)) => false,
            Ok(Meaning::Command(command)) if command.spec.menus.is_empty() => false,
            Ok(Meaning::Command(command)) => {
                self.job.menus.extend(find_opened_menu(&self.job, command.spec, words).map(Menu::Refused));
                true
            }
            Err(_) => true,
        }
    }

    /// Goes on at a terminal: errors no longer end the run, and nothing that is typed is passed over.
    pub fn take_terminal(&mut self) {
        self.interactive = true;
        self.job.menus.retain(|menu| !matches!(menu, Menu::Refused(_)));
    }
}
