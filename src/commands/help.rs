//! `&HELP`: everything a spec says, in words.

use crate::commands::environment::env;
use crate::commands::menu::join_names;
use crate::commands::post::{TABLES, rod, structure, tether};
use crate::commands::{COMMANDS, Call, Command, Effect, Job, absent, commands_of_menu, menus, status};
use windlass_base::diagnostic::Outcome;
use windlass_base::units::UnitSystem;
use windlass_connectors::class_specs;
use windlass_hydro::gusts::GUST_SPECTRA;
use windlass_hydro::sea::spectra::SPECTRA;
use windlass_language::flow::specs::CONTROL;
use windlass_language::functions;
use windlass_language::name;
use windlass_language::select::{Owner, choose};
use windlass_language::spec::{CommandSpec, Kind, Need, OptionEffect, SolveKind, ValueSpec, describe_expected};

/// &HELP.
pub static HELP: Command = Command { spec: &SPEC, edits: false, run };

static SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new("NAME", Kind::Text, "command, function, or ~CLASS").or("what this menu offers"),
        ValueSpec::new("TYPE", Kind::Text, "class type, after ~CLASS").or("all class types"),
    ],
    form: windlass_language::spec::TextForm::Text,
    example: "&HELP\n&HELP &DIMEN\n&HELP ~CLASS B_CAT",
    ..CommandSpec::new("&HELP", "explains a command, a function or a class type")
};

/// A registry that the help of a command lists behind its spec.
struct HelpList {
    command: &'static Command,
    head: &'static str,
    /// Names, with one line of help each.
    rows: fn(UnitSystem) -> Vec<(&'static str, String)>,
}

static LISTS: &[HelpList] = &[
    HelpList { command: &status::STATUS, head: "It reports:", rows: |_| status::listed_kinds().collect() },
    HelpList {
        command: &menus::PRCPOST,
        head: "Its tables:",
        rows: |_| TABLES.iter().map(|table| (table.spec.name, table.spec.help.to_string())).collect(),
    },
    HelpList { command: &rod::ROD, head: "It reports:", rows: |_| rod::RodReport::help_rows() },
    HelpList { command: &tether::TETHER, head: "It reports:", rows: |_| tether::TetherReport::help_rows() },
    HelpList { command: &structure::STRUCTURE, head: "It reports:", rows: |_| structure::StructureReport::help_rows() },
    HelpList { command: &env::ENV, head: "Spectra of -SEA and -A_SEA:", rows: spectra_help },
    HelpList {
        command: &env::ENV,
        head: "Gust spectra of -W_SPECTRUM:",
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
    let units = job.units;
    let text = match call.words.get(1) {
        None => overview(job),
        Some(word) if word.text.starts_with('~') => match call.words.get(2) {
            None => {
                class_specs().map(|spec| format!("   {:<12} {}", spec.name, spec.help)).collect::<Vec<_>>().join("\n")
            }
            Some(kind) => {
                let known = class_specs().map(|spec| (spec.name, spec.owner, spec));
                describe(choose(&kind.text, kind.span, "class type", known)?, "~NAME ", units)
            }
        },
        Some(word) => {
            let functions = functions::FUNCTION_HELP.iter().chain(crate::commands::functions::FUNCTION_HELP);
            let function = find_function(functions.into_iter(), &word.text).map(|(name, form, meaning)| {
                let meaning = wrap(meaning, 92).join("\n   ");
                format!("{name}: string function\n\n   {form}\n   {meaning}")
            });
            let both = COMMANDS.iter().find(|c| c.spec.name.eq_ignore_ascii_case(&word.text));
            if let (Some(text), Some(command)) = (&function, both) {
                format!("{}\n\n{text}", describe(command.spec, "", units))
            } else if let Some(text) = function {
                text
            } else {
                let menu = job.menu().spec();
                let known_here = COMMANDS.iter().map(|c| c.spec.name).chain(CONTROL.iter().map(|s| s.name));
                if let Some(entry) = absent::ABSENT.iter().find(|e| e.name.eq_ignore_ascii_case(&word.text))
                    && !known_here.into_iter().any(|name| name == entry.name)
                {
                    job.say(&format!("{}\n   {}", entry.sentence(), entry.instead));
                    return Ok(Effect::Done);
                }
                let here = COMMANDS
                    .iter()
                    .find(|c| c.spec.name.eq_ignore_ascii_case(&word.text) && c.spec.menus.contains(&menu));
                let known = COMMANDS.iter().map(|c| c.spec).chain(CONTROL);
                let spec = match here {
                    Some(command) => command.spec,
                    None => choose(
                        &word.text,
                        word.span,
                        "command",
                        known.chain(class_specs()).map(|s| (s.name, s.owner, s)),
                    )?,
                };
                let lead = if class_specs().any(|class| std::ptr::eq(class, spec)) { "~NAME " } else { "" };
                let mut text = describe(spec, lead, units);
                for list in LISTS.iter().filter(|list| std::ptr::eq(spec, list.command.spec)) {
                    text.push_str(&format!("\n\n   {}", list.head));
                    for (name, help) in (list.rows)(units) {
                        text.push_str(&format!("\n      {name:<14} {help}"));
                    }
                }
                text
            }
        }
    };
    job.say(&text);
    Ok(Effect::Done)
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
    lines.push("&HELP NAME explains one; &HELP ~CLASS lists the class types.".into());
    lines.join("\n")
}

/// The whole help of a spec.
pub fn describe(spec: &CommandSpec, lead: &str, units: UnitSystem) -> String {
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
    for option in spec.options {
        let default = if option.default.is_empty() { String::new() } else { format!(" [default: {}]", option.default) };
        let effect = match option.effect {
            OptionEffect::Acts => "",
            OptionEffect::Noted => " [no effect on results]",
            OptionEffect::Stops(SolveKind::Statics, _) => " [not computed: stops the next solve]",
            OptionEffect::Stops(SolveKind::Motions, _) => " [not computed: stops the next solve of motions]",
        };
        lines.push(format!("   {:<28} {}{default}{effect}", option.syntax(), option.help));
        if option.values.len() > 1 || option.values.iter().any(|v| v.help != option.help) {
            lines.extend(option.values.iter().map(|v| format!("        {:<23} {}", v.name, value_help(v, units))));
        }
    }
    if !spec.detail.is_empty() {
        lines.push(String::new());
        lines.extend(wrap(spec.detail, 92).into_iter().map(|l| format!("   {l}")));
    }
    if !spec.example.is_empty() {
        lines.push(String::new());
        lines.push("   Example:".into());
        lines.extend(spec.example.lines().map(|l| format!("      {l}")));
    }
    lines.join("\n")
}

fn value_help(value: &ValueSpec, units: UnitSystem) -> String {
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
