//! What follows a record that should have opened a menu and was refused: in a script the commands meant for that menu are
//! passed over up to its `END`, so that one mistake gives one message and every `END` leaves the menu it was written for.

use super::{Meaning, Session};
use crate::commands::{self, COMMANDS, Command, Effect, Menu, find_opened_menu, menu};
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_language::record::Word;
use windlass_language::spec::MenuSpec;
use windlass_language::token::TokenKind;
use windlass_model::{SolveKind, UnmodelledEffect};

/// The menus that commands of a menu open.
static INNER_MENUS: &[(&MenuSpec, &[&MenuSpec])] = &[
    (&menu::PRCPOST, &[&menu::DISPOSITION]),
    (&menu::FREQ_RESPONSE, &[&menu::DISPOSITION]),
    (&menu::HSTATICS, &[&menu::DISPOSITION]),
    (&menu::HYDRODYNAMICS, &[&menu::DISPOSITION, &menu::I_TOTAL]),
    (&menu::CONN_DESIGN, &[&menu::DISPOSITION]),
    (&menu::SURFACE, &[&menu::BLOCK, &menu::MESH]),
    (&menu::INMODEL, &[&menu::PGEN]),
    (&menu::MEDIT, &[&menu::PGEN]),
    (
        &menu::MAIN,
        &[
            &menu::SURFACE,
            &menu::SUMMARY,
            &menu::HSTATICS,
            &menu::HYDRODYNAMICS,
            &menu::FREQ_RESPONSE,
            &menu::PRCPOST,
            &menu::CONN_DESIGN,
        ],
    ),
];

/// Records that give surfaces to hulls and compartments.
const SURFACE_RECORDS: [&str; 12] = [
    "PGEN",
    "PLANE",
    "PANEL",
    "BLOCK",
    "MESH",
    "VERTEX",
    "UNION",
    "INTERSECT",
    "DIFFERENCE",
    "EMIT",
    "&EMIT",
    "TUBTANK",
];

/// The first of the menus that a menu opens which has a command of this name, where the menu itself has none.
fn inner_menu(outer: &'static MenuSpec, word: &str) -> Option<&'static MenuSpec> {
    let (_, inner) = INNER_MENUS.iter().find(|(menu, _)| *menu == outer)?;
    let named = |menu: &MenuSpec| {
        COMMANDS.iter().any(|c| c.spec.menus.contains(&menu) && c.spec.name.eq_ignore_ascii_case(word))
    };
    inner.iter().copied().find(|menu| named(menu))
}

impl Session {
    /// Hands back the error of a command; where the command would have opened a menu, and the run goes on, its place is
    /// taken by a menu that passes over what follows.
    pub(super) fn refuse(&mut self, command: &Command, words: &[Word], error: Box<Diagnostic>) -> Box<Diagnostic> {
        if !self.interactive && SURFACE_RECORDS.contains(&command.spec.name) {
            commands::keep_refused_surface(&mut self.job, command.spec.name, error.span.unwrap_or_default());
        }
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

    /// The words of a record whose first has an option without a blank before it, `TRAJECTORY-EVENT`, with the two apart; `None` of any other.
    pub(super) fn part_glued_option(&self, words: &[Word]) -> Option<Vec<Word>> {
        let [first, rest @ ..] = words else { return None };
        let (head, option) = first.text.split_once('-').filter(|(head, _)| !head.is_empty())?;
        if first.kind != TokenKind::Word || self.resolve(first).is_ok() {
            return None;
        }
        let word = |kind: TokenKind, text: &str| Word { kind, text: text.into(), span: first.span };
        let [command, option] = [word(TokenKind::Word, head), word(TokenKind::Option, &format!("-{option}"))];
        let is_command = matches!(self.resolve(&command), Ok(Meaning::Command(_) | Meaning::Absent(_)));
        is_command.then(|| [command, option].into_iter().chain(rest.iter().cloned()).collect())
    }

    /// What is answered in a script to a word that names nothing in its menu. Where the word before was unknown too, and this one is a command
    /// of a menu that the present one opens, the unknown word was to open that menu: its records are passed over up to their `END`, without an
    /// error of their own. Records of a disposition menu where no table is open are passed over behind one error.
    pub(super) fn without_cascade(
        &mut self,
        (first, words): (&Word, &[Word]),
        error: Box<Diagnostic>,
    ) -> Outcome<Effect> {
        if self.may_be_of_missing_library(first) {
            return self.answer_missing_macro(first);
        }
        if self.interactive {
            return Err(error);
        }
        let lost = std::mem::replace(&mut self.lost_opener, first.kind == TokenKind::Word);
        let Some(meant) = inner_menu(self.job.menu().spec(), &first.text) else { return Err(error) };
        if !lost && meant != &menu::DISPOSITION {
            return Err(error);
        }
        self.lost_opener = false;
        self.job.menus.push(Menu::Refused(meant));
        // the record may itself open a menu, for whose END there is to wait as well
        self.pass_over(first, words);
        if lost { Ok(Effect::Done) } else { Err(error.help("no table is open: the records up to END are passed over")) }
    }

    /// Whether an unknown word may be a macro of a library that USE_MAC did not find.
    fn may_be_of_missing_library(&self, first: &Word) -> bool {
        const CALLERS: [&MenuSpec; 4] = [&menu::MAIN, &menu::INMODEL, &menu::MEDIT, &menu::SURFACE];
        let elsewhere = COMMANDS.iter().any(|command| command.spec.name.eq_ignore_ascii_case(&first.text));
        let is_macro_name = first.kind == TokenKind::Word && !elsewhere;
        is_macro_name && !self.job.missing_libraries.is_empty() && CALLERS.contains(&self.job.menu().spec())
    }

    /// Says once that a macro is missing, and keeps that solves go without what it would do.
    fn answer_missing_macro(&mut self, first: &Word) -> Outcome<Effect> {
        let record = first.text.to_ascii_uppercase();
        let of = self.job.missing_libraries.join(" or ");
        let known = self.job.model.unmodelled_effects(SolveKind::Hydrostatics).iter().any(|kept| kept.record == record);
        if known {
            return Ok(Effect::Done);
        }
        let effect = format!("a macro of {of}, which was not found");
        self.job.warn(format!("{record} is taken for {effect}; solves will stop (said once)"), first.span);
        let (matters_to, span) = (SolveKind::Hydrostatics, first.span);
        self.job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to, span });
        Ok(Effect::Done)
    }

    /// Goes on at a terminal: errors no longer end the run, and nothing that is typed is passed over.
    pub fn take_terminal(&mut self) {
        self.interactive = true;
        self.job.menus.retain(|menu| !matches!(menu, Menu::Refused(_)));
    }
}
