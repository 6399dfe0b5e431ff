//! `&SELECT`: selectors, one in a record or many in a menu.
//!
//! Source: [MOSES-REF ams_cmd_menu, men_select].

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::values::Noun;
use windlass_language::name as rule;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Model, Selector, find};

/// &SELECT.
pub static SELECT: Command = Command { spec: &SPEC, edits: false, run };
/// A selector's record within the menu of `&SELECT`.
pub static SELECTOR: Command = Command { spec: &SELECTOR_SPEC, edits: false, run: record };

const NAMES: &[ValueSpec] = &[ValueSpec::new("NAME", Kind::Name(Noun::Selector), "name, pattern or selector")];

const SELECT_OPTION: OptionSpec = OptionSpec::new("-SELECT", NAMES, "names taken in").repeating(1);
const EXCEPT: OptionSpec = OptionSpec::new("-EXCEPT", NAMES, "names taken out again").repeating(1);

const OPTIONS: &[OptionSpec] = &[SELECT_OPTION, EXCEPT];

static SPEC: CommandSpec = CommandSpec {
    opens: Opens::AtMost(&menu::SELECT, 0),
    data: &[ValueSpec::new(":NAME", Kind::Name(Noun::Selector), "the selector")
        .among(&[Noun::Selector])
        .or("a menu of selectors")],
    options: OPTIONS,
    detail: "@ stands for any run of characters, / for exactly one. A selector given again is replaced. &SELECT alone opens a \
             menu of records :NAME -SELECT NAME .. -EXCEPT NAME .., up to END.",
    example: "&SELECT :BOW -SELECT *ML@ -EXCEPT *MLD\n&SELECT\n:STERN -SELECT *MLC *MLD\nEND\n&STATUS SELECTORS",
    ..CommandSpec::new("&SELECT", "defines selectors")
};

static SELECTOR_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SELECT],
    options: OPTIONS,
    detail: "The record is :NAME -SELECT NAME .. -EXCEPT NAME ..; what &SELECT does in one record.",
    example: "&SELECT\n:BOW -SELECT *ML@ -EXCEPT *MLD\n:STERN -SELECT *MLD\nEND\n&STATUS SELECTORS",
    ..CommandSpec::new(":SELECTOR", ":NAME -SELECT NAME ..: defines a selector")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = SPEC.word(":NAME");
    match call.args.word(NAME) {
        Some(name) => define(job, call, name, call.args.position(NAME)),
        None if call.args.options.is_empty() => {
            job.menus.push(Menu::Selectors);
            Ok(Effect::Done)
        }
        None => Err(Diagnostic::error("&SELECT lacks the name of the selector", call.args.span).help(FORM)),
    }
}

fn record(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let name = call.words.first().map_or("", |w| &w.text);
    define(job, call, name, call.args.span)
}

fn circular(name: &str, used: &str, span: Span) -> Box<Diagnostic> {
    let label = if name.eq_ignore_ascii_case(used) { "this is itself".into() } else { format!("it selects by {name}") };
    Diagnostic::error(format!("selector {name} would select by itself"), span).label(label)
}

const FORM: &str = "form: &SELECT :NAME -SELECT NAME .. -EXCEPT NAME ..";

fn define(job: &mut Job, call: &Call, name: &str, span: Span) -> Outcome<Effect> {
    rule::check(name, Some(':'), "selector", span)?;
    if !call.args.has(&SELECT_OPTION) {
        return Err(Diagnostic::error("-SELECT is missing: a selector without names selects nothing", span).help(FORM));
    }
    let key = Model::key(name);
    let list = |option: &OptionSpec| -> Vec<String> {
        call.args
            .option(option)
            .map_or(Vec::new(), |g| g.values.iter().filter_map(|v| v.word()).map(str::to_string).collect())
    };
    for value in call.args.options.iter().flat_map(|given| given.values.iter()) {
        if let Some(used) = value.word().filter(|word| word.starts_with(':')) {
            if job.model.refers_to(used, &key) {
                return Err(circular(name, used, value.span));
            }
            find(&job.model.selectors, used, "selector", value.span)?;
        }
    }
    let made = Selector { name: name.to_string(), select: list(&SELECT_OPTION), except: list(&EXCEPT), span };
    job.model.selectors.insert(key, made);
    Ok(Effect::Done)
}
