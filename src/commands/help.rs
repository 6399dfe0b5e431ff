//! `&HELP`: everything a spec says, in words.

use crate::commands::environment::env;
use crate::commands::menu::join_names;
use crate::commands::post::{TABLES, rod, structure, tether};
use crate::commands::{COMMANDS, Call, Command, Effect, Job, absent, commands_of_menu, help_search, menus, status};
use crate::report::page;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::UnitSystem;
use windlass_connectors::class_specs;
use windlass_hydro::gusts::GUST_SPECTRA;
use windlass_hydro::sea::spectra::SPECTRA;
use windlass_language::flow::specs::CONTROL;
use windlass_language::functions;
use windlass_language::name;
use windlass_language::record::Word;
use windlass_language::select::{Owner, SearchResult, choose, keyword};
use windlass_language::spec::{
    CommandSpec, Kind, Need, OptionEffect, OptionSpec, SolveKind, ValueSpec, describe_expected,
};
use windlass_language::token::TokenKind;

/// &HELP.
pub static HELP: Command = Command { spec: &SPEC, edits: false, run };

static SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new(
            "NAME",
            Kind::Text,
            "command, class type, function, -OPTION, UNITS, ~CLASS, or a word to look for",
        )
        .or("what this menu offers"),
        ValueSpec::new("TYPE", Kind::Text, "an -OPTION of it; after ~CLASS a class type").or("all of it"),
    ],
    detail: "A word that names nothing is looked for in the names and the help of all commands, options, class types, functions, kinds \
             of &STATUS, spectra, units and columns of reports. At a terminal `help` and `?` are &HELP.",
    form: windlass_language::spec::TextForm::Text,
    example: "&HELP\n&HELP &DIMEN\n&HELP &ENV -SEA\n&HELP ~CLASS B_CAT\n&HELP tension\n&HELP UNITS",
    ..CommandSpec::new("&HELP", "explains a command, a function or a class type")
};

/// A registry that the help of a command lists behind its spec.
struct HelpList {
    command: &'static Command,
    head: &'static str,
    /// The options whose words it lists; none: those of the command itself.
    options: &'static [&'static str],
    /// Names, with one line of help each.
    rows: fn(UnitSystem) -> Vec<(&'static str, String)>,
}

static LISTS: &[HelpList] = &[
    HelpList {
        command: &status::STATUS,
        head: "It reports:",
        options: &[],
        rows: |_| status::listed_kinds().collect(),
    },
    HelpList {
        command: &menus::PRCPOST,
        head: "Its tables:",
        options: &[],
        rows: |_| TABLES.iter().map(|table| (table.spec.name, table.spec.help.to_string())).collect(),
    },
    HelpList { command: &rod::ROD, head: "It reports:", options: &[], rows: |_| rod::RodReport::help_rows() },
    HelpList {
        command: &tether::TETHER,
        head: "It reports:",
        options: &[],
        rows: |_| tether::TetherReport::help_rows(),
    },
    HelpList {
        command: &structure::STRUCTURE,
        head: "It reports:",
        options: &[],
        rows: |_| structure::StructureReport::help_rows(),
    },
    HelpList {
        command: &env::ENV,
        head: "Spectra of -SEA and -A_SEA:",
        options: &["-SEA", "-A_SEA"],
        rows: spectra_help,
    },
    HelpList {
        command: &env::ENV,
        head: "Gust spectra of -W_SPECTRUM:",
        options: &["-W_SPECTRUM"],
        rows: |_| GUST_SPECTRA.iter().map(|spectrum| (spectrum.name, spectrum.help.to_string())).collect(),
    },
];

/// Wave spectra, each with its parameters.
fn spectra_help(units: UnitSystem) -> Vec<(&'static str, String)> {
    let mut rows = Vec::new();
    for spectrum in SPECTRA {
        rows.push((spectrum.name, spectrum.help.to_string()));
        for parameter in spectrum.parameters {
            let unit = describe_expected(Kind::Number(parameter.dim), units);
            rows.push(("", format!("{}: {}: {unit}", parameter.name, parameter.help)));
        }
    }
    rows
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let words: Vec<&Word> = call.words.iter().skip(1).collect();
    // found out once, so that a word that names nothing is refused before anything is printed
    let topic = topic(job, &words)?;
    let units = job.units;
    match topic {
        Topic::Text(text) => job.say_fitted(|width| page::fold_text(&text, width)),
        Topic::Spec(spec, lead, more) => {
            job.say_fitted(|width| {
                let mut text = describe_within(spec, lead, units, width.map_or(TEXT_WIDTH, |w| w.saturating_sub(4)));
                for list in LISTS.iter().filter(|list| std::ptr::eq(spec, list.command.spec)) {
                    text.push_str(&list.text(units));
                }
                text.push_str(&more);
                page::fold_text(&text, width)
            });
        }
    }
    Ok(Effect::Done)
}

/// Columns of running text where nobody looks on.
const TEXT_WIDTH: usize = 92;

/// What is explained.
enum Topic {
    Text(String),
    /// A spec, what stands before its form, and text behind its help.
    Spec(&'static CommandSpec, &'static str, String),
}

fn topic(job: &Job, words: &[&Word]) -> Outcome<Topic> {
    let units = job.units;
    let Some(word) = words.first() else { return Ok(Topic::Text(overview(job))) };
    let second = words.get(1);
    if word.text.starts_with('~') {
        let Some(kind) = second else {
            let rows = class_specs().map(|spec| format!("   {:<12} {}", spec.name, spec.help));
            return Ok(Topic::Text(rows.collect::<Vec<_>>().join("\n")));
        };
        let known = class_specs().map(|spec| (spec.name, spec.owner, spec));
        let spec = choose(&kind.text, kind.span, "class type", known)?;
        return with_option(spec, "~NAME ", words.get(2), units);
    }
    if word.kind == TokenKind::Option {
        return option_anywhere(job, word);
    }
    if word.text.eq_ignore_ascii_case("UNITS") {
        return Ok(Topic::Text(help_search::units(units)));
    }
    let functions = functions::FUNCTION_HELP.iter().chain(crate::commands::functions::FUNCTION_HELP);
    let function = find_function(functions, &word.text).map(|(name, form, meaning)| {
        let meaning = wrap(meaning, TEXT_WIDTH).join("\n   ");
        format!("{name}: string function\n\n   {form}\n   {meaning}")
    });
    let both = COMMANDS.iter().find(|c| c.spec.name.eq_ignore_ascii_case(&word.text));
    match (function, both) {
        (Some(text), Some(command)) if second.is_none() => {
            return Ok(Topic::Spec(command.spec, "", format!("\n\n{text}")));
        }
        (Some(text), None) => return Ok(Topic::Text(text)),
        _ => {}
    }
    let menu = job.menu().spec();
    let mut known_here = COMMANDS.iter().map(|c| c.spec.name).chain(CONTROL.iter().map(|s| s.name));
    if let Some(entry) = absent::ABSENT.iter().find(|e| e.name.eq_ignore_ascii_case(&word.text))
        && !known_here.any(|name| name == entry.name)
    {
        return Ok(Topic::Text(format!("{}\n   {}", entry.sentence(), entry.instead)));
    }
    let here = COMMANDS.iter().find(|c| c.spec.name.eq_ignore_ascii_case(&word.text) && c.spec.menus.contains(&menu));
    let specs = COMMANDS.iter().map(|c| c.spec).chain(CONTROL).chain(class_specs());
    let found = match here {
        Some(command) => SearchResult::One(command.spec),
        None => keyword(&word.text, specs.clone().map(|s| (s.name, s.owner, s))),
    };
    let SearchResult::One(spec) = found else {
        // several may begin so: all that says the word tells them apart
        return match help_search::search(job, &word.text, TEXT_WIDTH) {
            Some(text) => Ok(Topic::Text(text)),
            None => Err(choose(&word.text, word.span, "command", specs.map(|s| (s.name, s.owner, s)))
                .err()
                .unwrap_or_else(|| Diagnostic::error(format!("no help says `{}`", word.text), word.span))),
        };
    };
    let lead = if class_specs().any(|class| std::ptr::eq(class, spec)) { "~NAME " } else { "" };
    let topic = with_option(spec, lead, second, units)?;
    let exact = spec.name.trim_start_matches('&').eq_ignore_ascii_case(word.text.trim_start_matches('&'));
    Ok(match topic {
        // a word of the language that happens to begin a name is looked for too
        Topic::Spec(spec, lead, mut more) if !exact && word.kind == TokenKind::Word => {
            if let Some(text) = help_search::search(job, &word.text, TEXT_WIDTH) {
                more.push_str(&format!("\n\n{text}"));
            }
            Topic::Spec(spec, lead, more)
        }
        topic => topic,
    })
}

/// The help of a spec, or of the option alone that a word names.
fn with_option(
    spec: &'static CommandSpec,
    lead: &'static str,
    word: Option<&&Word>,
    units: UnitSystem,
) -> Outcome<Topic> {
    let Some(word) = word else { return Ok(Topic::Spec(spec, lead, String::new())) };
    if word.kind != TokenKind::Option {
        return Err(Diagnostic::error(format!("`{}` is no option of {}", word.text, spec.name), word.span)
            .label("expected an option, -NAME"));
    }
    let option = choose(&word.text, word.span, &format!("option of {}", spec.name), spec.option_names())?;
    Ok(Topic::Text(option_text(spec, lead, option, units)))
}

/// The help of an option alone.
fn option_text(spec: &CommandSpec, lead: &str, option: &OptionSpec, units: UnitSystem) -> String {
    let mut lines = vec![format!("{lead}{} {}", spec.name, option.name), String::new()];
    lines.extend(option_lines(option, units));
    let mut text = lines.join("\n");
    for list in LISTS.iter().filter(|list| std::ptr::eq(spec, list.command.spec) && list.options.contains(&option.name))
    {
        text.push_str(&list.text(units));
    }
    text
}

/// The help of an option of any command: where a single one has it the option alone, else the commands that do.
fn option_anywhere(job: &Job, word: &Word) -> Outcome<Topic> {
    let classes = class_specs().map(|spec| (spec, "~NAME "));
    let specs = COMMANDS.iter().map(|c| (c.spec, "")).chain(CONTROL.iter().map(|spec| (spec, ""))).chain(classes);
    let mut found: Vec<(&CommandSpec, &str, &OptionSpec)> = Vec::new();
    for (spec, lead) in specs {
        let mut named = spec.option_names().filter(|(name, ..)| name.eq_ignore_ascii_case(&word.text));
        found.extend(named.next().map(|(_, _, option)| (spec, lead, option)));
    }
    match found.as_slice() {
        [] => help_search::search(job, &word.text, TEXT_WIDTH)
            .map(Topic::Text)
            .ok_or_else(|| Diagnostic::error(format!("no record has an option {}", word.text), word.span)),
        list => {
            let texts = list.iter().map(|(spec, lead, option)| option_text(spec, lead, option, job.units));
            Ok(Topic::Text(texts.collect::<Vec<_>>().join("\n\n")))
        }
    }
}

impl HelpList {
    /// Its head and rows, behind the help of its command.
    fn text(&self, units: UnitSystem) -> String {
        let rows = (self.rows)(units).into_iter().map(|(name, help)| format!("\n      {name:<14} {help}"));
        format!("\n\n   {}{}", self.head, rows.collect::<String>())
    }
}

/// A function by its name; without its `&` only where no command has that name.
fn find_function<'a>(
    mut functions: impl Iterator<Item = &'a (&'static str, &'static str, &'static str)>,
    word: &str,
) -> Option<&'a (&'static str, &'static str, &'static str)> {
    let command = COMMANDS.iter().any(|c| c.spec.name.eq_ignore_ascii_case(word));
    functions.find(|(name, _, _)| {
        name.eq_ignore_ascii_case(word) || (!command && name.trim_start_matches('&').eq_ignore_ascii_case(word))
    })
}

fn overview(job: &Job) -> String {
    let menu = job.menu();
    let mut lines = vec![format!("Menu {} ({} leaves it). Its commands:", menu.name(), menu.end())];
    let line = |name: &str, help: &str| format!("   {name:<14} {help}");
    lines.extend(
        commands_of_menu(menu.spec()).filter(|c| !c.spec.menus.is_empty()).map(|c| line(c.spec.name, c.spec.help)),
    );
    lines.push("Commands of every menu:".into());
    lines.extend(
        commands_of_menu(menu.spec()).filter(|c| c.spec.menus.is_empty()).map(|c| line(c.spec.name, c.spec.help)),
    );
    lines.push("Variables, branches, loops, macros:".into());
    lines.extend(CONTROL.iter().map(|s| line(s.name, s.help)));
    lines.push(
        "String functions: ".to_string()
            + &functions::FUNCTION_HELP
                .iter()
                .chain(crate::commands::functions::FUNCTION_HELP)
                .map(|f| f.0)
                .collect::<Vec<_>>()
                .join(" "),
    );
    lines.extend(wrap(name::RULE, 96));
    lines.push("&HELP NAME explains one, &HELP NAME -OPTION an option alone; &HELP ~CLASS lists the class types; &HELP WORD looks for a word.".into());
    lines.join("\n")
}

/// The whole help of a spec.
pub fn describe(spec: &CommandSpec, lead: &str, units: UnitSystem) -> String {
    describe_within(spec, lead, units, TEXT_WIDTH)
}

/// The same with running text of so many columns.
fn describe_within(spec: &CommandSpec, lead: &str, units: UnitSystem, width: usize) -> String {
    let mut lines = vec![format!("{}: {}", spec.name, spec.help), String::new(), format!("   {lead}{}", spec.syntax())];
    if !spec.menus.is_empty() {
        lines.push(format!("   in menu {}", join_names(spec.menus, " or ")));
    }
    match spec.owner {
        Owner::Moses => {}
        Owner::Aqwa => lines.push("   a name of AQWA".into()),
        Owner::Ours => lines.push("   a name of ours, not of MOSES".into()),
    }
    lines.push(String::new());
    lines.extend(spec.data.iter().map(|v| format!("   {:<28} {}", v.name, value_help(v, units))));
    lines.extend(spec.options.iter().flat_map(|option| option_lines(option, units)));
    if !spec.detail.is_empty() {
        lines.push(String::new());
        lines.extend(wrap(spec.detail, width).into_iter().map(|l| format!("   {l}")));
    }
    if !spec.example.is_empty() {
        lines.push(String::new());
        lines.push("   Example:".into());
        lines.extend(spec.example.lines().map(|l| format!("      {l}")));
    }
    lines.join("\n")
}

/// The help of an option, a line for it and one for each of its values.
pub fn option_lines(option: &OptionSpec, units: UnitSystem) -> Vec<String> {
    let default = if option.default.is_empty() { String::new() } else { format!(" [default: {}]", option.default) };
    let effect = match option.effect {
        OptionEffect::Acts => "",
        OptionEffect::Noted => " [no effect on results]",
        OptionEffect::Stops(SolveKind::Hydrostatics | SolveKind::Statics, _) => " [not computed: stops the next solve]",
        OptionEffect::Stops(SolveKind::Motions, _) => " [not computed: stops the next solve of motions]",
    };
    let explained = option.values.len() > 1 || option.values.iter().any(|v| v.help != option.help);
    // a value that the option explains stands in its line, with its unit
    let value = option.values.first().filter(|_| !explained);
    let expected = value.map_or(String::new(), |v| format!(": {}", describe_expected(v.kind, units)));
    let mut lines = vec![format!("   {:<28} {}{expected}{default}{effect}", option.syntax(), option.help)];
    if explained {
        lines.extend(option.values.iter().map(|v| format!("        {:<23} {}", v.name, value_help(v, units))));
    }
    lines
}

/// The help of a value: its meaning, its unit, its default.
pub fn value_help(value: &ValueSpec, units: UnitSystem) -> String {
    let default = match value.need {
        Need::Required => String::new(),
        Need::Optional(text) => format!(" [default: {text}]"),
    };
    format!("{}: {}{default}", value.help, describe_expected(value.kind, units))
}

/// Text in lines of at most `width` characters.
pub(super) fn wrap(text: &str, width: usize) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for word in text.split_whitespace() {
        match lines.last_mut() {
            Some(line) if line.len() + 1 + word.len() <= width => {
                line.push(' ');
                line.push_str(word);
            }
            _ => lines.push(word.to_string()),
        }
    }
    lines
}
