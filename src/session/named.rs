//! What a word names in a menu, and what is said where it names nothing.

use crate::commands::menu::join_names;
use crate::commands::{COMMANDS, Command, Menu, commands_of_menu};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_language::flow::macros::Macro;
use windlass_language::flow::specs::CONTROL;
use windlass_language::record::Word;
use windlass_language::token::TokenKind;

/// A description record's command, when the menu takes descriptions.
pub(super) fn in_menu(name: &str, menu: &Menu, first: &Word) -> Outcome<&'static Command> {
    commands_of_menu(menu.spec()).find(|c| c.spec.name == name).ok_or_else(|| {
        let (what, help) = match first.kind {
            TokenKind::Selector => ("a selector", "&SELECT opens the menu of selectors; &SELECT :NAME .. defines one"),
            _ => ("a description record", "descriptions belong to INMODEL or MEDIT: enter MEDIT first"),
        };
        Diagnostic::error(format!("`{}` has no place in menu {}", first.text, menu.name()), first.span)
            .label(what)
            .help(help)
    })
}

/// The command that a word of everyday use asks for, where it names nothing else.
pub(super) fn plain_word(word: &str) -> Option<&'static Command> {
    let name = match word.to_ascii_uppercase().as_str() {
        "HELP" | "?" => "&HELP",
        "QUIT" | "EXIT" | "BYE" => "&FINISH",
        _ => return None,
    };
    COMMANDS.iter().copied().find(|command| command.spec.name == name)
}

/// The error for a word that names nothing here: where it would, or what is near.
pub(super) fn unknown_name_error<'a>(
    first: &Word,
    menu: &Menu,
    names: impl Iterator<Item = &'static str>,
    macros: impl Iterator<Item = &'a Arc<Macro>>,
) -> Box<Diagnostic> {
    let mut error = Diagnostic::error(format!("unknown command `{}` in menu {}", first.text, menu.name()), first.span);
    let elsewhere = COMMANDS.iter().find(|c| {
        !c.spec.menus.is_empty()
            && c.spec.name.get(..first.text.len()).is_some_and(|h| h.eq_ignore_ascii_case(&first.text))
    });
    let candidates: Vec<String> = names
        .map(str::to_string)
        .chain(CONTROL.iter().map(|s| s.name.to_string()))
        .chain(macros.map(|m| m.name.clone()))
        .collect();
    match elsewhere {
        Some(command) => {
            error.help.push(format!(
                "{} belongs to menu {}",
                command.spec.name,
                join_names(command.spec.menus, " and ")
            ));
        }
        None => error.help.extend(did_you_mean(&first.text, candidates.iter().map(String::as_str))),
    }
    if error.help.is_empty() {
        error.help.push("&HELP lists what can be typed here".into());
    }
    error
}
