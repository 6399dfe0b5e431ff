//! The TextMate grammar of scripts, which editors colour by: made from the lexer's kinds of words and the names of commands and options.

use crate::commands::{COMMANDS, FUNCTION_HELP, internal_names};
use serde_json::{Value, json};
use std::collections::BTreeSet;
use windlass_connectors::class_specs;
use windlass_language::flow::specs::CONTROL;
use windlass_language::functions;

/// Where it stands in the project.
pub const GRAMMAR_FILE: &str = "editors/vscode/syntaxes/windlass.tmLanguage.json";
/// Fewest letters that a name is abbreviated to; shorter ones are taken for any word.
const SHORTEST: usize = 4;
/// Fewest letters of an option: its sign tells it from other words.
const SHORTEST_OPTION: usize = 3;
/// What ends a word.
const END: &str = r"(?=[\s,]|$)";

/// A name whose letters behind the first `shortest` may be left off, as a regular expression.
fn abbreviated(name: &str, shortest: usize) -> String {
    let letters: Vec<char> = name.chars().collect();
    let signs = letters.iter().take_while(|c| !c.is_ascii_alphanumeric()).count();
    let escape = |c: &char| if c.is_ascii_alphanumeric() || *c == '_' { c.to_string() } else { format!("\\{c}") };
    let (whole, rest) = letters.split_at(letters.len().min(signs + shortest));
    let whole: String = whole.iter().map(escape).collect();
    let rest = rest.iter().rev().fold(String::new(), |behind, c| format!("(?:{}{behind})?", escape(c)));
    format!("{whole}{rest}")
}

/// An alternative of names; the longest first, since an editor takes the first that fits.
fn any_of(names: &BTreeSet<&str>, shortest: usize) -> String {
    let mut names: Vec<&str> = names.iter().copied().collect();
    names.sort_by_key(|name| (std::cmp::Reverse(name.len()), *name));
    names.into_iter().map(|name| abbreviated(name, shortest)).collect::<Vec<_>>().join("|")
}

/// The grammar, as JSON with an end of line.
pub fn build_grammar() -> String {
    let control: BTreeSet<&str> = CONTROL.iter().map(|spec| spec.name).collect();
    let (mut records, mut options) = (BTreeSet::new(), BTreeSet::new());
    for spec in COMMANDS.iter().map(|command| command.spec).chain(class_specs()) {
        options.extend(spec.options.iter().map(|option| option.name));
    }
    records.extend(COMMANDS.iter().map(|command| command.spec.name));
    let classes: BTreeSet<&str> = class_specs().map(|spec| spec.name).collect();
    records.extend(internal_names().map(|(name, _)| name));
    records.retain(|name| !control.contains(name) && !name.is_empty() && !name.starts_with('#'));
    let calls: BTreeSet<&str> = FUNCTION_HELP.iter().chain(functions::FUNCTION_HELP).map(|help| help.0).collect();
    let rule = |name: &str, pattern: String| json!({ "name": format!("{name}.windlass"), "match": pattern });
    let grammar: Value = json!({
        "$schema": "https://raw.githubusercontent.com/martinring/tmlanguage/master/tmlanguage.json",
        "name": "windlass",
        "scopeName": "source.windlass",
        "fileTypes": ["cif", "mac"],
        "patterns": [
            rule("comment.line.dollar", r"(?:^|(?<=[\s,]))\$.*$".into()),
            rule("constant.character.escape.continuation", r"\\(?=\s*(?:\$.*)?$)".into()),
            rule("string.quoted.double", r#"(?:^|(?<=[\s,]))"[^"]*""#.into()),
            rule("string.quoted.single", r"(?:^|(?<=[\s,]))'[^']*'".into()),
            rule("keyword.control", format!(r"(?i)^\s*(?:{}){END}", any_of(&control, SHORTEST))),
            rule("support.function", format!(r"(?i)(?:{})(?=\()", any_of(&calls, SHORTEST))),
            rule("keyword.other.command", format!(r"(?i)^\s*(?:{}){END}", any_of(&records, SHORTEST))),
            rule("keyword.other.command", r"(?i)^\s*END(?:_[A-Z_&]+)?(?=[\s,]|$)".into()),
            json!({
                "match": format!(r"(?i)(?:^|(?<=[\s,]))(~[^\s,%]+)[\s,]+({}){END}", any_of(&classes, SHORTEST)),
                "captures": {
                    "1": { "name": "entity.name.type.class.windlass" },
                    "2": { "name": "support.type.class.windlass" },
                },
            }),
            rule("entity.other.attribute-name", format!(r"(?i)(?<=[\s,])(?:{}){END}", any_of(&options, SHORTEST_OPTION))),
            rule("variable.other", r"%\([^)\s]*\)|%[A-Za-z_][A-Za-z0-9_]*%?".into()),
            rule("entity.name.type.class", r"(?:^|(?<=[\s,]))~[^\s,%]+".into()),
            rule("entity.name.tag.point", r"(?:^|(?<=[\s,]))\*[^\s,%]+".into()),
            rule("entity.name.section.selector", r"(?:^|(?<=[\s,])):[^\s,%]+".into()),
            rule("storage.type.load", r"(?:^|(?<=[\s,]))#[^\s,%]+".into()),
            rule("constant.numeric", r"(?:^|(?<=[\s,]))[-+]*[0-9.][0-9.]*(?:[eE][-+]?[0-9]+)?(?=[\s,]|$)".into()),
        ],
    });
    format!("{grammar:#}\n")
}
