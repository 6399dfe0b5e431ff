//! The page for users of MOSES: a phrasebook, and the state of every record.

use super::markdown::{code, describe_effect, escape, sentence, table};
use crate::commands::SHIPPED_LIBRARIES;
use crate::commands::absent::{ABSENT, Absent, CLASSES, LIBRARIES, Loss, REPORTS};
use crate::commands::check_list::CheckedAs;
use crate::commands::{COMMANDS, Command, menu, status_rows};
use indexmap::IndexMap;
use windlass_language::flow::specs::CONTROL;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, MenuSpec, OptionEffect, OptionSpec, SolveKind};

/// What a user reads before the tables.
const PHRASEBOOK: &str = include_str!("moses_phrasebook.md");

/// What a record of MOSES does in windlass.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum RecordState {
    Acts,
    Stops,
    Noted,
    Refused,
}

impl RecordState {
    const ALL: [RecordState; 4] = [RecordState::Acts, RecordState::Stops, RecordState::Noted, RecordState::Refused];

    fn word(self) -> &'static str {
        match self {
            RecordState::Acts => "acts",
            RecordState::Stops => "stops",
            RecordState::Noted => "noted",
            RecordState::Refused => "refused",
        }
    }

    fn of_command(command: &'static Command) -> Self {
        match CheckedAs::from_command(command) {
            CheckedAs::WithoutEffect => RecordState::Noted,
            _ if !command.spec.stops.is_empty() => RecordState::Stops,
            _ => RecordState::Acts,
        }
    }

    fn of_absent(entry: &Absent) -> Self {
        match entry.loss {
            Loss::Nothing => RecordState::Noted,
            Loss::Results => RecordState::Refused,
            Loss::Solves(_) => RecordState::Stops,
        }
    }

    fn of_option(option: &OptionSpec) -> Self {
        match option.effect {
            OptionEffect::Acts => RecordState::Acts,
            OptionEffect::Noted => RecordState::Noted,
            OptionEffect::Stops(..) => RecordState::Stops,
        }
    }
}

/// A record of MOSES in one menu.
struct RecordRow {
    name: &'static str,
    state: RecordState,
    says: String,
    options: String,
}

/// The page.
pub fn build_page() -> String {
    let positions: Vec<(Option<&'static MenuSpec>, Vec<RecordRow>)> = std::iter::once(None)
        .chain(menu::ALL.iter().copied().map(Some))
        .map(|position| (position, rows_of_menu(position)))
        .collect();
    let states = || positions.iter().flat_map(|(_, rows)| rows).map(|row| row.state);
    let options = moses_options();
    let counts: Vec<[String; 3]> = RecordState::ALL
        .iter()
        .map(|state| {
            let records = states().filter(|other| other == state).count();
            let options = options.iter().filter(|option| RecordState::of_option(option) == *state).count();
            [state.word().to_string(), records.to_string(), options.to_string()]
        })
        .collect();
    let mut text = format!(
        "# MOSES scripts\n\n<!-- Made from the declarations in the source by `windlass manual`; do not edit. -->\n\n{PHRASEBOOK}## State of \
         every record\n\n**acts**: its effect is computed. **stops**: no solver computes it; the next solve that needs it stops. **noted**: \
         it is read and has no effect on results. **refused**: it asks for results that windlass does not compute.\n\n"
    );
    text.push_str(&table(["State", "Records", "Options of records that act"], &counts));
    for (position, rows) in positions.iter().filter(|(_, rows)| !rows.is_empty()) {
        let head = position.map_or("Every menu".to_string(), |menu| format!("Menu {}", escape(menu.name)));
        let cells: Vec<[String; 4]> = rows
            .iter()
            .map(|row| [code(row.name), row.state.word().into(), row.says.clone(), row.options.clone()])
            .collect();
        text.push_str(&format!(
            "### {head}\n\n{}",
            table(["Record", "State", "What it does", "Options that do not act"], &cells)
        ));
    }
    text.push_str(&format!("### Class types\n\n{}", table(["Class", "State", "What it is"], &class_rows())));
    text.push_str(&format!(
        "### Kinds of \\&STATUS\n\n{}",
        table(["Kind", "State", "What it reports"], &report_rows())
    ));
    let shipped: Vec<[String; 2]> =
        SHIPPED_LIBRARIES.iter().map(|library| [code(library.name), code(library.macros)]).collect();
    text.push_str(&format!(
        "### Libraries of macros that ship with windlass\n\n{}",
        table(["Library", "Macros"], &shipped)
    ));
    let libraries: Vec<[String; 2]> = LIBRARIES.iter().map(|(name, macros)| [code(name), code(macros)]).collect();
    text.push_str(&format!(
        "### Libraries of macros that are not in windlass\n\n{}",
        table(["Library", "Macros that scripts call"], &libraries)
    ));
    format!("{}\n", text.trim_end())
}

/// The options of MOSES of its records.
fn moses_options() -> Vec<&'static OptionSpec> {
    let specs =
        COMMANDS.iter().filter(|command| command.spec.owner == Owner::Moses).flat_map(|command| command.spec.options);
    specs.filter(|option| option.owner == Owner::Moses).collect()
}

/// The records of a menu, those of every menu where there is none; one that several menus share stands in the first.
fn rows_of_menu(position: Option<&'static MenuSpec>) -> Vec<RecordRow> {
    let here = |menus: &[&'static MenuSpec]| menus.first().copied() == position;
    let commands = COMMANDS.iter().filter(|command| command.spec.owner == Owner::Moses && here(command.spec.menus));
    let mut rows: Vec<RecordRow> = commands
        .map(|command| RecordRow {
            name: command.spec.name,
            state: RecordState::of_command(command),
            says: escape(&describe_command(command.spec)),
            options: idle_options(command.spec),
        })
        .collect();
    if position.is_none() {
        rows.extend(CONTROL.iter().map(|spec| RecordRow {
            name: spec.name,
            state: RecordState::Acts,
            says: escape(&sentence(spec.help)),
            options: String::new(),
        }));
    }
    rows.extend(ABSENT.iter().filter(|entry| here(entry.menus)).map(|entry| RecordRow {
        name: entry.name,
        state: RecordState::of_absent(entry),
        says: describe_absent(entry),
        options: String::new(),
    }));
    rows
}

fn describe_command(spec: &CommandSpec) -> String {
    let stops = if spec.stops.is_empty() { String::new() } else { format!(" {}", sentence(spec.stops)) };
    format!("{}{stops}", sentence(spec.help))
}

fn describe_absent(entry: &Absent) -> String {
    let solves = match entry.loss {
        Loss::Solves(SolveKind::Motions) => " Stops solves of motions.",
        _ => "",
    };
    let instead = if entry.instead.is_empty() { String::new() } else { format!(" {}", sentence(entry.instead)) };
    escape(&format!("{}{solves}{instead}", sentence(entry.what)))
}

/// The options of MOSES that do not act, those that do the same together.
fn idle_options(spec: &CommandSpec) -> String {
    let idle = spec.options.iter().filter(|option| option.owner == Owner::Moses && option.effect != OptionEffect::Acts);
    let mut groups: IndexMap<String, Vec<String>> = IndexMap::new();
    for option in idle {
        let effect = describe_effect(option).trim_end_matches('.').to_lowercase();
        groups.entry(effect).or_default().push(code(option.name));
    }
    let mut listed: Vec<String> =
        groups.iter().map(|(effect, names)| format!("{}: {effect}", names.join(" "))).collect();
    listed.extend(spec.absent.iter().map(|(name, why)| format!("{}: refused: {}", code(name), escape(why))));
    listed.join("; ")
}

fn class_rows() -> Vec<[String; 3]> {
    let there = windlass_connectors::class_specs().filter(|spec| spec.owner == Owner::Moses);
    let mut rows: Vec<[String; 3]> = there
        .map(|spec| [code(spec.name), RecordState::Acts.word().to_string(), escape(&sentence(spec.help))])
        .collect();
    rows.extend(CLASSES.iter().map(|class| {
        let says = format!("A connector of it stops solves: {}.", class.of_connectors);
        [code(class.name), RecordState::Stops.word().to_string(), escape(&says)]
    }));
    rows
}

fn report_rows() -> Vec<[String; 3]> {
    let there = status_rows().filter(|(.., owner)| *owner == Owner::Moses);
    let mut rows: Vec<[String; 3]> = there
        .map(|(name, help, _)| [code(name), RecordState::Acts.word().to_string(), escape(&sentence(&help))])
        .collect();
    rows.extend(
        REPORTS
            .iter()
            .map(|(name, instead)| [code(name), RecordState::Refused.word().to_string(), escape(&sentence(instead))]),
    );
    rows
}
