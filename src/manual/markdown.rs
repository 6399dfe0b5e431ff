//! Declarations as Markdown: texts, tables, values with their units.

use windlass_base::units::{Dim, ForceUnit, LengthUnit, UnitSystem};
use windlass_language::select::Owner;
use windlass_language::spec::{
    CommandSpec, Kind, Need, OptionEffect, OptionSpec, Range, SolveKind, ValueSpec, describe_expected,
};

/// The two systems that the manual names units in.
const METRIC: UnitSystem = UnitSystem { length: LengthUnit::Meters, force: ForceUnit::Kilonewtons };

/// Text that stands for itself in a paragraph or a cell of a table.
pub fn escape(text: &str) -> String {
    let mut escaped = String::with_capacity(text.len());
    for letter in text.chars() {
        if matches!(letter, '*' | '_' | '<' | '>' | '|' | '`' | '[' | ']' | '\\' | '~' | '&' | '#' | '$') {
            escaped.push('\\');
        }
        escaped.push(letter);
    }
    escaped
}

/// A word in the type of code; in a cell of a table its bars are escaped.
pub fn code(text: &str) -> String {
    format!("`{}`", text.replace('|', "\\|"))
}

/// A phrase as a sentence.
pub fn sentence(phrase: &str) -> String {
    let mut letters = phrase.chars();
    let Some(first) = letters.next() else { return String::new() };
    let word_end = phrase.find(' ').unwrap_or(phrase.len());
    // a word of a record keeps its letters
    let is_plain = phrase[..word_end].chars().all(|c| c.is_ascii_lowercase());
    let first: String = if is_plain { first.to_uppercase().collect() } else { first.to_string() };
    let end = if phrase.ends_with(['.', ':', '?']) { "" } else { "." };
    format!("{first}{}{end}", letters.as_str())
}

/// A table of these rows under heads, with an empty line behind it; nothing of no rows.
pub fn table<const N: usize>(heads: [&str; N], rows: &[[String; N]]) -> String {
    if rows.is_empty() {
        return String::new();
    }
    let line = |cells: &[String]| format!("| {} |\n", cells.join(" | "));
    let mut text = line(&heads.map(String::from));
    text.push_str(&line(&heads.map(|_| "---".to_string())));
    rows.iter().for_each(|row| text.push_str(&line(row)));
    text.push('\n');
    text
}

/// The unit of a dimension in feet and kips, and in metres and kilonewtons where it is another.
pub fn unit_names(dim: Dim) -> String {
    let (ours, metric) = (dim.label(UnitSystem::default()), dim.label(METRIC));
    if ours == metric { ours } else { format!("{ours} or {metric}") }
}

/// What a value is: a number with its units, one of some words, a name.
fn describe_kind(kind: Kind) -> String {
    match kind {
        Kind::Number(dim) => match unit_names(dim) {
            unit if unit.is_empty() => "a number".to_string(),
            unit => format!("a number ({unit})"),
        },
        Kind::StiffnessOfDof => {
            let (force, moment) = (unit_names(Dim::ForcePerLength), unit_names(Dim::MomentPerRadian));
            format!("a stiffness ({force}; of rotations {moment})")
        }
        Kind::ForceOfDof => {
            let (force, moment) = (unit_names(Dim::Force), unit_names(Dim::Moment));
            format!("a force ({force}) or moment ({moment})")
        }
        other => describe_expected(other, UnitSystem::default()),
    }
}

/// A value: its meaning, what it is, where it must lie and what holds without it.
pub fn describe_value(value: &ValueSpec) -> String {
    let range = match value.range {
        Range::Any => String::new(),
        Range::Positive => ", greater than 0".to_string(),
        Range::NotNegative => ", 0 or more".to_string(),
        Range::Within(low, high) => format!(", from {low} to {high}"),
    };
    let default = match value.need {
        Need::Required => String::new(),
        Need::Optional(text) => format!("; default: {text}"),
    };
    escape(&format!("{}: {}{range}{default}", value.help, describe_kind(value.kind)))
}

/// What an option does to results, where it is not what its help says.
pub fn describe_effect(option: &OptionSpec) -> String {
    match option.effect {
        OptionEffect::Acts => String::new(),
        OptionEffect::Noted => "No effect on results.".to_string(),
        OptionEffect::Stops(SolveKind::Hydrostatics | SolveKind::Statics, _) => {
            "Not computed: stops the next solve.".to_string()
        }
        OptionEffect::Stops(SolveKind::Motions, _) => "Not computed: stops the next solve of motions.".to_string(),
    }
}

/// Whose name it is, where it is not one of MOSES.
pub fn describe_owner(owner: Owner) -> &'static str {
    match owner {
        Owner::Moses => "",
        Owner::Aqwa => "A name of AQWA.",
        Owner::Ours => "A name of windlass, not of MOSES.",
    }
}

/// An option as rows of a table: itself, then its values where they say more.
fn option_rows(option: &OptionSpec) -> Vec<[String; 2]> {
    let mut parts = vec![escape(&sentence(option.help))];
    if !option.default.is_empty() {
        parts.push(escape(&format!("Default: {}.", option.default.trim_end_matches('.'))));
    }
    parts.push(describe_effect(option));
    parts.push(describe_owner(option.owner).to_string());
    if !option.aliases.is_empty() {
        parts.push(format!("Also {}.", option.aliases.iter().map(|a| code(a)).collect::<Vec<_>>().join(", ")));
    }
    if option.many {
        parts.push("May be given several times.".into());
    }
    parts.retain(|part| !part.is_empty());
    let mut rows = vec![[code(&option.syntax()), parts.join(" ")]];
    rows.extend(option.values.iter().map(|value| [format!("&emsp;{}", code(value.name)), describe_value(value)]));
    rows
}

/// The section of a command or a class type: form, data, options, details, example.
pub fn command_section(spec: &CommandSpec, lead: &str) -> String {
    let mut text = format!("## {}\n\n{}", escape(spec.name), escape(&sentence(spec.help)));
    let owner = describe_owner(spec.owner);
    if !owner.is_empty() {
        text.push_str(&format!(" {owner}"));
    }
    text.push_str(&format!("\n\n```text\n{lead}{}\n```\n\n", spec.syntax()));
    let data: Vec<[String; 2]> = spec.data.iter().map(|v| [code(v.name), describe_value(v)]).collect();
    text.push_str(&table(["Data", "Meaning"], &data));
    let options: Vec<[String; 2]> = spec.options.iter().flat_map(option_rows).collect();
    text.push_str(&table(["Option", "Meaning"], &options));
    let absent: Vec<[String; 2]> = spec.absent.iter().map(|(name, why)| [code(name), escape(why)]).collect();
    text.push_str(&table(["Refused", "Why"], &absent));
    if !spec.detail.is_empty() {
        let words: Vec<&str> = spec.detail.split_whitespace().collect();
        text.push_str(&format!("{}\n\n", escape(&words.join(" "))));
    }
    if !spec.example.is_empty() {
        text.push_str(&format!("```cif\n{}\n```\n\n", spec.example));
    }
    text
}
