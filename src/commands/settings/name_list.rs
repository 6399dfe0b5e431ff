//! `&VARIABLE`: lists of names kept by a name, and the function that goes through one.
//!
//! Source: [MOSES-REF lang_functions]: `&VARIABLE <MACDBF>NAME -ADD ITEM` and `&VARIABLE(-WHILE <MACDBF>NAME :SEL VAR)`.

use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;
use windlass_base::wildcard::matches;
use windlass_language::logic;
use windlass_language::record::Word;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::Model;

/// &VARIABLE.
pub static VARIABLE: Command = Command { spec: &SPEC, edits: false, run };

/// The databases that there are.
const DATABASES: [&str; 2] = ["MACDBF", "SYSDBF"];
/// Most items of a list.
const MAX_ITEMS: usize = 10_000;

const ADD: OptionSpec =
    OptionSpec::new("-ADD", &[ValueSpec::new("ITEM", Kind::Item, "a word")], "adds words to the list").repeating(1);

static SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("<DATABASE>NAME", Kind::Text, "a list of the database MACDBF or SYSDBF")],
    options: &[ADD],
    detail: "A list is there from its first -ADD to the end of the job. &VARIABLE(-WHILE <DATABASE>NAME :SEL VAR) puts its words that fit a pattern or a selector into the \
             variable VAR, one at a call, and is .FALSE. while there is one, else .TRUE.: a loop leaves by it. MACDBF and SYSDBF are alike (our reading).",
    example: "&VARIABLE <MACDBF>TANKS -ADD 1P 1S 2P\n&LOOP\n&EXIT &VARIABLE(-WHILE <MACDBF>TANKS 1@ T)\n&TYPE tank %T\n&ENDLOOP",
    ..CommandSpec::new("&VARIABLE", "keeps a list of names")
};

/// The key of a list of a database.
fn list_key(word: &str, span: Span) -> Outcome<String> {
    let form = "form: <MACDBF>NAME";
    let split = word.strip_prefix('<').and_then(|rest| rest.split_once('>'));
    let Some((database, name)) = split.filter(|(_, name)| !name.is_empty()) else {
        return Err(Diagnostic::error(format!("`{word}` names no list of a database"), span).help(form));
    };
    if !DATABASES.iter().any(|known| known.eq_ignore_ascii_case(database)) {
        let mut error = Diagnostic::error(format!("unknown database {database}"), span).help(form);
        error.help.extend(suggest(database, DATABASES));
        return Err(error);
    }
    Ok(format!("{}>{}", database.to_ascii_uppercase(), name.to_ascii_uppercase()))
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const LIST: DatumKey<str> = SPEC.word("<DATABASE>NAME");
    let args = &call.args;
    let key = list_key(args.word(LIST).unwrap_or_default(), args.position(LIST))?;
    let Some(given) = args.option(&ADD) else {
        return Err(Diagnostic::error("&VARIABLE lacks -ADD ITEM", args.span));
    };
    let items: Vec<String> = given.values.iter().filter_map(|v| v.word()).map(str::to_string).collect();
    let list = job.name_lists.entry(key).or_default();
    if list.len() + items.len() > MAX_ITEMS {
        return Err(Diagnostic::error(format!("a list has at most {MAX_ITEMS} words"), given.span));
    }
    list.extend(items);
    Ok(Effect::Done)
}

/// The value of `&VARIABLE(-WHILE <DATABASE>NAME :SEL VAR)`.
///
/// # Errors
/// Another form, an unknown database or list.
pub(crate) fn next_name(job: &mut Job, words: &[Word], span: Span) -> Outcome<String> {
    let [option, list, selector, variable] = words else {
        return Err(Diagnostic::error("&VARIABLE(..) takes -WHILE, a list, a selector and a variable", span)
            .help("form: &VARIABLE(-WHILE <MACDBF>NAME :SEL VAR)"));
    };
    if !option.text.eq_ignore_ascii_case("-WHILE") {
        return Err(Diagnostic::error(format!("unknown option of &VARIABLE `{}`", option.text), option.span)
            .help("form: &VARIABLE(-WHILE <MACDBF>NAME :SEL VAR)"));
    }
    let key = list_key(&list.text, list.span)?;
    let Some(names) = job.name_lists.get(&key) else {
        return Err(Diagnostic::error(format!("there is no list {}", list.text), list.span)
            .help("&VARIABLE <MACDBF>NAME -ADD ITEM begins one"));
    };
    let model = &job.model;
    let fits = |name: &&String| match model.selectors.get(&Model::key(&selector.text)) {
        Some(chosen) => chosen.matches(name, model),
        None => matches(&selector.text, name),
    };
    let walk = (key.clone(), selector.text.to_ascii_uppercase());
    let taken = job.name_walks.get(&walk).copied().unwrap_or(0);
    match names.iter().filter(fits).nth(taken).cloned() {
        Some(name) => {
            job.name_walks.insert(walk, taken + 1);
            job.assignments.push((variable.text.to_string(), name));
            Ok(logic::word(false).into())
        }
        None => {
            job.name_walks.shift_remove(&walk);
            Ok(logic::word(true).into())
        }
    }
}
