//! What could stand where in a record, from the lexer and the specs: for the terminal and for the editors of `windlass lsp`.

use crate::commands::{COMMANDS, Menu, commands_of_menu, menu, status_kinds, status_names};
use crate::session::Session;
use windlass_base::printable::is_acted_on;
use windlass_base::values::Noun;
use windlass_connectors::class_specs;
use windlass_connectors::line_types::library;
use windlass_language::flow::specs::CONTROL;
use windlass_language::functions;
use windlass_language::select::{SearchResult, keyword};
use windlass_language::spec::{CommandSpec, Kind as ValueKind, MenuSpec, OptionSpec, ValueSpec};
use windlass_language::token::{self, Token, TokenKind};
use windlass_model::{EntityKind, Model, PIPE};

/// Names to complete, taken from the session before each line.
#[derive(Default)]
pub struct Known {
    menu: Option<&'static MenuSpec>,
    bodies: Vec<String>,
    parts: Vec<String>,
    points: Vec<String>,
    classes: Vec<String>,
    connectors: Vec<String>,
    pipes: Vec<String>,
    curves: Vec<String>,
    bathymetries: Vec<String>,
    fillings: Vec<String>,
    environments: Vec<String>,
    selectors: Vec<String>,
    compartments: Vec<String>,
    holes: Vec<String>,
    draft_marks: Vec<String>,
    sensors: Vec<String>,
    columns: Vec<String>,
    macros: Vec<String>,
    variables: Vec<String>,
}

impl Known {
    /// The menu the record is typed in.
    pub fn menu(&self) -> &'static MenuSpec {
        self.menu.unwrap_or(&menu::MAIN)
    }

    /// Takes the names of the session as it is now.
    pub fn update(&mut self, session: &Session) {
        let model = &session.job.model;
        let menu = session.job.menu();
        *self = Known {
            menu: Some(menu.spec()),
            bodies: model.bodies.values().map(|b| b.name.clone()).collect(),
            parts: names_of_kind(model, EntityKind::Part),
            points: model.points.values().map(|p| p.name.clone()).collect(),
            classes: model.classes.values().map(|c| c.name.clone()).collect(),
            connectors: model.connectors.values().map(|c| c.name.clone()).collect(),
            pipes: model.assemblies.values().map(|a| a.name.clone()).filter(|name| name == PIPE).collect(),
            bathymetries: model.bathymetries.values().map(|b| b.name.clone()).collect(),
            fillings: model.fillings.values().map(|f| f.name.clone()).collect(),
            curves: model.curves.values().map(|c| c.name.clone()).collect(),
            environments: model.environments.values().map(|e| e.name.clone()).collect(),
            selectors: model.selectors.values().map(|s| s.name.clone()).collect(),
            compartments: names_of_kind(model, EntityKind::Compartment),
            holes: model.holes.values().map(|h| h.name.clone()).collect(),
            draft_marks: names_of_kind(model, EntityKind::DraftMark),
            sensors: model.sensors.values().map(|s| s.name.clone()).collect(),
            columns: match menu {
                Menu::Disposition(d) => d.table.columns().iter().map(|c| c.name.clone()).collect(),
                _ => Vec::new(),
            },
            macros: session.interpreter.macros().map(|m| m.name.clone()).collect(),
            variables: session.interpreter.variables.names().map(str::to_string).collect(),
        };
    }

    /// The names a value takes: of the sorts its declaration names, with the selectors, else of its noun.
    fn names_for(&self, value: &ValueSpec, noun: Noun) -> Vec<String> {
        match value.among {
            [] => self.names_of(noun),
            [Noun::Selector] => self.selectors.clone(),
            nouns => nouns.iter().flat_map(|noun| self.names_of(*noun)).chain(self.selectors.iter().cloned()).collect(),
        }
    }

    /// The names a kind of &STATUS takes.
    fn names_of_kinds(&self, kinds: &[EntityKind]) -> Vec<String> {
        let noun = |kind: &EntityKind| match kind {
            EntityKind::Connector => Some(Noun::Connector),
            EntityKind::Class => Some(Noun::Class),
            EntityKind::Point => Some(Noun::Point),
            EntityKind::Body => Some(Noun::Body),
            EntityKind::Assembly => Some(Noun::Line),
            EntityKind::Part => Some(Noun::Part),
            EntityKind::Compartment => Some(Noun::Compartment),
            EntityKind::Environment => Some(Noun::Environment),
            EntityKind::Curve => Some(Noun::Curve),
            EntityKind::Bathymetry => Some(Noun::Bathymetry),
            EntityKind::Filling => Some(Noun::Filling),
            EntityKind::DraftMark => Some(Noun::DraftMark),
            EntityKind::Piece | EntityKind::Selector => None,
        };
        let names = kinds.iter().filter_map(noun).flat_map(|noun| self.names_of(noun));
        names.chain(self.selectors.iter().cloned()).collect()
    }

    fn names_of(&self, noun: Noun) -> Vec<String> {
        match noun {
            Noun::Class => self.classes.clone(),
            Noun::Point => self.points.clone(),
            Noun::Body => self.bodies.clone(),
            Noun::Part => self.parts.clone(),
            Noun::Connector => self.connectors.clone(),
            Noun::Line => self.connectors.iter().chain(&self.pipes).cloned().collect(),
            Noun::Curve => self.curves.clone(),
            Noun::Bathymetry => self.bathymetries.clone(),
            Noun::Filling => self.fillings.clone(),
            Noun::Environment => self.environments.clone(),
            Noun::Selector if !self.columns.is_empty() => self.columns.clone(),
            Noun::Selector => [
                &self.selectors,
                &self.connectors,
                &self.classes,
                &self.points,
                &self.bodies,
                &self.parts,
                &self.curves,
                &self.bathymetries,
                &self.fillings,
                &self.environments,
            ]
            .into_iter()
            .flatten()
            .cloned()
            .collect(),
            Noun::Compartment => self.compartments.clone(),
            Noun::Hole => self.holes.clone(),
            Noun::DraftMark => self.draft_marks.clone(),
            Noun::Sensor => self.sensors.clone(),
            Noun::Macro => self.macros.clone(),
            Noun::LineType => line_type_names().collect(),
            Noun::New => Vec::new(),
        }
    }
}

fn names_of_kind(model: &Model, kind: EntityKind) -> Vec<String> {
    model.names(kind).into_iter().map(str::to_string).collect()
}

fn line_type_names() -> impl Iterator<Item = String> {
    library().types.iter().map(|t| t.name.clone())
}

/// The spec of the record being typed: a command of the menu, or the class type after a class name.
pub fn spec_of(menu: &'static MenuSpec, text: &str, words: &[Token]) -> Option<(&'static CommandSpec, usize)> {
    let word = |i: usize| words.get(i).and_then(|t| text.get(t.range.clone()));
    let first = words.first()?;
    match first.kind {
        TokenKind::Class => {
            let kind = keyword(word(1)?, class_specs().map(|spec| (spec.name, spec.owner, spec)));
            if let SearchResult::One(spec) = kind { Some((spec, 2)) } else { None }
        }
        TokenKind::Point => COMMANDS.iter().find(|c| c.spec.name == "*POINT").map(|c| (c.spec, 1)),
        TokenKind::Selector => COMMANDS.iter().find(|c| c.spec.name == ":SELECTOR").map(|c| (c.spec, 1)),
        _ => {
            let names = commands_of_menu(menu).map(|c| c.spec).chain(CONTROL).map(|s| (s.name, s.owner, s));
            if let SearchResult::One(spec) = keyword(word(0)?, names) { Some((spec, 1)) } else { None }
        }
    }
}

/// What the names of the kind of a `&STATUS` record are of.
fn kind_of_status(text: &str, words: &[Token]) -> &'static [EntityKind] {
    let word = words.get(1).and_then(|t| text.get(t.range.clone())).unwrap_or_default();
    match keyword(word, status_kinds()) {
        SearchResult::One(name) => status_names(name),
        _ => &[],
    }
}

/// Whether the first datum of a `&STATUS` record is LINE_TYPES.
fn tells_of_line_types(text: &str, words: &[Token]) -> bool {
    let word = words.get(1).and_then(|t| text.get(t.range.clone())).unwrap_or_default();
    keyword(word, status_kinds()) == SearchResult::One("LINE_TYPES")
}

/// What stands at the end of the record: the value expected there, and whether an option must have it.
pub fn expected_value(
    spec: &'static CommandSpec,
    text: &str,
    words: &[Token],
    from: usize,
) -> Option<(&'static ValueSpec, bool)> {
    let mut data = 0;
    let mut option: Option<(&'static OptionSpec, usize)> = None;
    for token in words.get(from..).unwrap_or_default() {
        let word = text.get(token.range.clone()).unwrap_or_default();
        if token.kind == TokenKind::Option {
            option = match keyword(word, spec.option_names()) {
                SearchResult::One(found) => Some((found, 0)),
                _ => None,
            };
            continue;
        }
        match &mut option {
            Some((found, taken)) if *taken < found.values.len() || found.repeat > 0 => *taken += 1,
            _ => data += 1,
        }
    }
    if let Some((found, taken)) = option {
        if let Some(value) = found.values.get(taken) {
            return Some((value, value.is_required()));
        }
        if found.repeat > 0 {
            let fixed = found.values.len() - found.repeat;
            let within = (taken - fixed) % found.repeat;
            return found.values.get(fixed + within).map(|value| (value, within > 0 && value.is_required()));
        }
    }
    let datum = spec.data.get(data).or_else(|| {
        let fixed = spec.data.len().checked_sub(spec.repeat).filter(|_| spec.repeat > 0)?;
        spec.data.get(fixed + (data - fixed) % spec.repeat)
    });
    datum.map(|value| (value, false))
}

/// The string functions, each as it begins.
fn string_functions() -> impl Iterator<Item = String> {
    functions::FUNCTION_HELP
        .iter()
        .chain(crate::commands::functions::FUNCTION_HELP)
        .map(|(name, _, _)| format!("{name}("))
}

/// Where a string function may begin within a word.
fn function_start(word: &str) -> Option<usize> {
    word.rfind('&').filter(|at| !word.get(..*at).is_some_and(|head| head.ends_with(|c: char| c.is_alphanumeric())))
}

/// What could stand at the end of a text.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Candidates {
    /// The byte at which the word begins that they stand for.
    pub start: usize,
    /// The words, in order, each once.
    pub words: Vec<String>,
    /// A name of a file is expected; no words are found here.
    pub is_file: bool,
}

impl Candidates {
    fn sorted(start: usize, mut words: Vec<String>) -> Candidates {
        words.retain(|text| !text.contains(is_acted_on));
        words.sort();
        words.dedup();
        Candidates { start, words, is_file: false }
    }
}

/// What could stand at the end of the beginning of a record, in a menu.
pub fn candidates(known: &Known, menu: &'static MenuSpec, before: &str) -> Candidates {
    let start = before.rfind(|c: char| c.is_whitespace() || c == ',').map_or(0, |i| i + 1);
    let word = before.get(start..).unwrap_or_default();
    let head = before.get(..start).unwrap_or_default();
    let words = token::words(head);
    let mut candidates: Vec<String> = Vec::new();
    if let Some(name) = word.strip_prefix('%') {
        candidates.extend(known.variables.iter().filter(|v| begins(v, name)).map(|v| format!("%{v}")));
        return Candidates::sorted(start, candidates);
    }
    let spec = spec_of(menu, head, &words);
    if words.is_empty() {
        candidates.extend(
            commands_of_menu(menu).map(|c| c.spec.name).filter(|n| !n.starts_with(['~', '*', ':'])).map(str::to_string),
        );
        candidates.extend(CONTROL.iter().map(|s| s.name.to_string()));
        candidates.extend(known.macros.iter().chain(&known.classes).cloned());
        if menu != &crate::commands::menu::MAIN {
            candidates.push(menu.end.to_string());
        }
    } else if spec.is_some_and(|(spec, _)| spec.name == "&HELP") {
        if words.len() == 1 {
            candidates.extend(COMMANDS.iter().map(|c| c.spec).chain(CONTROL).map(|s| s.name.to_string()));
            candidates.extend(string_functions().map(|name| name.trim_end_matches('(').to_string()));
        }
        candidates.extend(class_specs().map(|spec| spec.name.to_string()));
        candidates.retain(|c| begins(c, word) || c.strip_prefix('&').is_some_and(|bare| begins(bare, word)));
        return Candidates::sorted(start, candidates);
    } else if let Some(at) = function_start(word) {
        let name = word.get(at..).unwrap_or_default();
        return Candidates::sorted(start + at, string_functions().filter(|f| begins(f, name)).collect());
    } else if words.first().is_some_and(|w| w.kind == TokenKind::Class) && words.len() == 1 {
        candidates.extend(class_specs().map(|spec| spec.name.to_string()));
    } else if let Some((spec, from)) = spec {
        let expected = expected_value(spec, head, &words, from);
        let begins_option = word.starts_with('-') && !word.starts_with("-.");
        if spec.name == "&STATUS" && words.len() == 1 && !begins_option {
            candidates.extend(status_kinds().map(|(name, _, _)| name.to_string()));
        } else if spec.name == "&STATUS" && words.len() == 2 && tells_of_line_types(head, &words) {
            candidates.extend(line_type_names());
        } else if let (false, Some((value, _))) = (begins_option, expected) {
            match value.kind {
                ValueKind::Choice(choices) => candidates.extend(choices.iter().map(|c| (*c).to_string())),
                ValueKind::Name(_) if spec.name == "&STATUS" => {
                    candidates.extend(known.names_of_kinds(kind_of_status(head, &words)));
                }
                ValueKind::Name(noun) => candidates.extend(known.names_for(value, noun)),
                ValueKind::ChoiceOrName(choices, noun) => {
                    candidates.extend(choices.iter().map(|c| (*c).to_string()).chain(known.names_for(value, noun)));
                }
                ValueKind::File => {
                    return Candidates { start, words: Vec::new(), is_file: true };
                }
                _ => {}
            }
        }
        // where an option still lacks a value no other can begin
        if begins_option || (word.is_empty() && !expected.is_some_and(|(_, must)| must)) {
            candidates.extend(spec.options.iter().map(|o| o.name.to_string()));
        }
    }
    candidates.retain(|c| begins(c, word));
    Candidates::sorted(start, candidates)
}

/// The rest of the form of a record that ends with a blank.
pub fn hint_of(menu: &'static MenuSpec, line: &str) -> Option<String> {
    let words = token::words(line);
    let (spec, from) = spec_of(menu, line, &words)?;
    let value = expected_value(spec, line, &words, from).map(|(value, _)| value);
    let last = words.last().filter(|t| t.kind == TokenKind::Option).and_then(|t| line.get(t.range.clone()));
    let option = last.and_then(|name| match keyword(name, spec.option_names()) {
        SearchResult::One(found) => Some(found),
        _ => None,
    });
    let text = match (option, value) {
        (Some(option), _) if !option.values.is_empty() => {
            option.syntax().get(option.name.len() + 1..).unwrap_or_default().to_string()
        }
        (_, Some(value)) if words.len() > from => format!("{}  ({})", value.name, value.help),
        (_, Some(_)) => spec.syntax().get(spec.name.len() + 1..).unwrap_or_default().to_string(),
        _ => return None,
    };
    Some(text)
}

fn begins(name: &str, word: &str) -> bool {
    name.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word))
}
