//! `&SELECT`: selectors.

use super::{Call, Command, Effect, Job};
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::language::spec::{CommandSpec, Kind, Noun, OptionSpec, ValueSpec};
use crate::model::{Model, Selector};

/// &SELECT.
pub static SELECT: Command = Command { spec: &SPEC, edits: false, run };

const NAMES: &[ValueSpec] = &[ValueSpec::new("NAME", Kind::Name(Noun::Selector), "name, pattern or selector")];

static SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new(":NAME", Kind::Name(Noun::Selector), "the selector")],
    options: &[
        OptionSpec::new("-SELECT", NAMES, "names taken in").repeating(1),
        OptionSpec::new("-EXCEPT", NAMES, "names taken out again").repeating(1),
    ],
    detail: "@ stands for any run of characters, / for exactly one. A selector given again is replaced.",
    example: "&SELECT :BOW -SELECT *ML@ -EXCEPT *MLD",
    ..CommandSpec::new("&SELECT", "defines a selector")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let name = call.args.word(0).unwrap_or_default().to_string();
    let span = call.args.place(0);
    if !name.starts_with(':') || name.len() < 2 {
        return Err(Diagnostic::error(format!("`{name}` cannot name a selector"), span).label("expected :NAME"));
    }
    if !call.args.has("-SELECT") {
        return Err(Diagnostic::error("-SELECT is missing: a selector without names selects nothing", span)
            .help("form: &SELECT :NAME -SELECT NAME .. -EXCEPT NAME .."));
    }
    let list = |option: &str| -> Vec<String> {
        call.args
            .option(option)
            .map_or(Vec::new(), |g| g.values.iter().filter_map(|v| v.word()).map(str::to_string).collect())
    };
    let made = Selector { name: name.clone(), select: list("-SELECT"), except: list("-EXCEPT"), span };
    job.model.selectors.insert(Model::key(&name), made);
    Ok(Effect::Done)
}
