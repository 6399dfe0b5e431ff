//! Where names stand in a text: points, classes, selectors by their marks; bodies, connectors and the like where a record defines them or a
//! spec expects a name; macros and variables.

use crate::assist::spec_of;
use crate::commands::{COMMANDS, menu};
use crate::session::defined_name;
use std::collections::HashMap;
use std::ops::Range;
use windlass_base::span::SourceId;
use windlass_base::values::Noun;
use windlass_language::flow::specs::CONTROL;
use windlass_language::record::{self, Record, Word};
use windlass_language::select::{SearchResult, keyword};
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, TextForm, ValueSpec};
use windlass_language::token::{Token, TokenKind};

/// What a name is of.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum NameKind {
    /// `~NAME`.
    Class,
    /// `*NAME`.
    Point,
    /// `:NAME`.
    Selector,
    /// A body.
    Body,
    /// A part of a body.
    Part,
    /// A connector or an element.
    Connector,
    /// A macro.
    Macro,
    /// A variable.
    Variable,
    /// A curve, an environment, a block, a compartment.
    Other,
    /// A name of any sort.
    Any,
}

impl NameKind {
    /// What it is called.
    pub fn noun(self) -> &'static str {
        match self {
            NameKind::Class => "class",
            NameKind::Point => "point",
            NameKind::Selector => "selector",
            NameKind::Body => "body",
            NameKind::Part => "part",
            NameKind::Connector => "connector",
            NameKind::Macro => "macro",
            NameKind::Variable => "variable",
            NameKind::Other | NameKind::Any => "name",
        }
    }

    /// Its number in the list of kinds of symbols of the protocol.
    pub fn symbol(self) -> u8 {
        match self {
            NameKind::Class => 5,
            NameKind::Point => 14,
            NameKind::Selector => 18,
            NameKind::Body | NameKind::Part => 2,
            NameKind::Connector => 11,
            NameKind::Macro => 12,
            NameKind::Variable => 13,
            NameKind::Other | NameKind::Any => 23,
        }
    }

    /// Whether a name of this sort, where it stands, may mean one of another.
    pub fn may_be(self, other: NameKind) -> bool {
        self == other || (self == NameKind::Any && !matches!(other, NameKind::Macro | NameKind::Variable))
    }

    fn of(noun: Noun) -> NameKind {
        match noun {
            Noun::Class => NameKind::Class,
            Noun::Point => NameKind::Point,
            Noun::Body => NameKind::Body,
            Noun::Part => NameKind::Part,
            Noun::Connector | Noun::Line => NameKind::Connector,
            Noun::Macro => NameKind::Macro,
            Noun::Selector => NameKind::Any,
            _ => NameKind::Other,
        }
    }
}

/// A name at a place.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Occurrence {
    /// What it is of.
    pub kind: NameKind,
    /// The name in upper case, with its mark (`~ * :`) and without the `%` of a variable.
    pub name: String,
    /// Where it stands, as `name` is written.
    pub range: Range<usize>,
    /// The record defines it.
    pub defines: bool,
    /// The whole record.
    pub record: Range<usize>,
}

/// The names of a text, in order. `met` gives the commands that a check found at the first bytes of records.
pub fn occurrences(text: &str, met: &HashMap<usize, &'static CommandSpec>) -> Vec<Occurrence> {
    let mut list = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let (record, next, _) = record::read(text, SourceId::default(), at);
        if !record.is_blank() {
            let whole = record.whole();
            let met = met.get(&(whole.start as usize)).copied();
            let first = list.len();
            of_record(&record, met, &mut list);
            of_variables(text, at..next, &mut list);
            let typed = text.get(at..next).unwrap_or_default();
            let range = at..at + typed.trim_end().len();
            for occurrence in list.iter_mut().skip(first) {
                occurrence.record = range.clone();
            }
        }
        at = next;
    }
    list
}

/// The spec of a record: what a check found there, else what its first word says in any menu, and the index of its first value.
pub fn spec_of_record(record: &Record, met: Option<&'static CommandSpec>) -> Option<(&'static CommandSpec, usize)> {
    let words = record.words();
    let first = words.first()?;
    let tokens: Vec<Token> = windlass_language::token::words(record.text());
    if matches!(first.kind, TokenKind::Class | TokenKind::Point | TokenKind::Selector) {
        return spec_of(&menu::MAIN, record.text(), &tokens);
    }
    if let Some(spec) = met {
        return Some((spec, 1));
    }
    let names = COMMANDS.iter().map(|command| command.spec).chain(CONTROL);
    match keyword(&first.text, names.clone().map(|spec| (spec.name, spec.owner, spec))) {
        SearchResult::One(spec) => Some((spec, 1)),
        _ => None,
    }
}

/// The value that each word of a record is, as its spec has it; `None` for options and what the spec does not expect.
pub fn values_of(spec: &'static CommandSpec, words: &[Word], from: usize) -> Vec<Option<&'static ValueSpec>> {
    let mut values = vec![None; words.len().min(from)];
    let mut data = 0;
    let mut option: Option<(&'static OptionSpec, usize)> = None;
    for word in words.get(from..).unwrap_or_default() {
        if word.kind == TokenKind::Option {
            option = match keyword(&word.text, spec.option_names()) {
                SearchResult::One(found) => Some((found, 0)),
                _ => None,
            };
            values.push(None);
            continue;
        }
        if let Some((found, taken)) = &mut option
            && (*taken < found.values.len() || found.repeat > 0)
        {
            values.push(repeated(found.values, found.repeat, *taken));
            *taken += 1;
            continue;
        }
        values.push(repeated(spec.data, spec.repeat, data));
        data += 1;
    }
    values
}

/// The value at an index of a list whose last `repeat` ones repeat.
fn repeated(list: &'static [ValueSpec], repeat: usize, index: usize) -> Option<&'static ValueSpec> {
    list.get(index).or_else(|| {
        let fixed = list.len().checked_sub(repeat).filter(|_| repeat > 0)?;
        list.get(fixed + (index - fixed) % repeat)
    })
}

fn of_record(record: &Record, met: Option<&'static CommandSpec>, list: &mut Vec<Occurrence>) {
    let words = record.words();
    let Some(first) = words.first() else { return };
    let spec = spec_of_record(record, met);
    let control = spec.map(|(spec, _)| spec.name).filter(|name| CONTROL.iter().any(|control| control.name == *name));
    // what is only printed names nothing
    let is_text =
        spec.is_some_and(|(spec, _)| spec.form == TextForm::Text && spec.data.is_empty()) && control.is_none();
    let is_class = first.kind == TokenKind::Class;
    if is_text && !is_class {
        return;
    }
    let values = spec.map_or_else(Vec::new, |(spec, from)| values_of(spec, &words, from));
    let defined = if control.is_none() { defined_name(&words).map(|word| word.span) } else { None };
    for (index, word) in words.iter().enumerate() {
        let marked = match word.kind {
            TokenKind::Class => Some(NameKind::Class),
            TokenKind::Point => Some(NameKind::Point),
            TokenKind::Selector => Some(NameKind::Selector),
            _ => None,
        };
        let value = values.get(index).copied().flatten();
        let is_defined = defined == Some(word.span);
        let kind = match (marked, value.map(|value| value.kind)) {
            (Some(kind), _) => kind,
            _ if is_defined => defined_kind(first, &words),
            (None, Some(Kind::Name(noun) | Kind::ChoiceOrName(_, noun))) if word.kind == TokenKind::Word => {
                NameKind::of(noun)
            }
            _ if control == Some("&MACRO") && index == 1 => NameKind::Macro,
            // a word that is no command may call a macro
            _ if index == 0 && spec.is_none() && word.kind == TokenKind::Word => NameKind::Macro,
            _ => continue,
        };
        // within the arguments of a function a parenthesis may stand behind it; patterns name several
        let name = word.text.trim_end_matches(')');
        let least = if marked.is_some() { 2 } else { 1 };
        if name.len() < least || name.contains(['@', '%', '(', '&']) || (name.contains('/') && !is_defined) {
            continue;
        }
        let start = word.span.start as usize;
        // a word that stands across the end of a line, or came from a variable, has another length
        if start + word.text.len() != word.span.end as usize {
            continue;
        }
        let defines = is_defined || kind == NameKind::Macro && control.is_some();
        list.push(Occurrence {
            kind,
            name: name.to_ascii_uppercase(),
            range: start..start + name.len(),
            defines,
            record: 0..0,
        });
    }
    let variables: Vec<&Word> = match control {
        Some("&SET" | "&SET_VAR" | "&LOCAL") => words.get(1).into_iter().collect(),
        Some("&LOOP") if words.len() > 2 => words.get(1).into_iter().collect(),
        Some("&MACRO") => {
            let follows_equals = |index: usize| words.get(index - 1).is_some_and(|word| word.text.as_ref() == "=");
            let is_name = |index: usize, word: &Word| {
                word.kind == TokenKind::Word && word.text.as_ref() != "=" && !follows_equals(index)
            };
            words
                .iter()
                .enumerate()
                .skip(2)
                .filter(|(index, word)| is_name(*index, word))
                .map(|(_, word)| word)
                .collect()
        }
        _ => Vec::new(),
    };
    for word in variables {
        let name = word.text.trim_end_matches('.');
        let start = word.span.start as usize;
        list.push(Occurrence {
            kind: NameKind::Variable,
            name: name.to_ascii_uppercase(),
            range: start..start + name.len(),
            defines: true,
            record: 0..0,
        });
    }
}

/// What a record that is no `~`, `*` or `:` defines.
fn defined_kind(first: &Word, words: &[Word]) -> NameKind {
    let begins = |whole: &str, word: &str| {
        word.len() > 2 && whole.get(..word.len()).is_some_and(|head| head.eq_ignore_ascii_case(word))
    };
    let second = words.get(1).map_or("", |word| word.text.as_ref());
    if begins("&DESCRIBE", &first.text) {
        return match second {
            body if begins("BODY", body) => NameKind::Body,
            part if begins("PART", part) => NameKind::Part,
            _ => NameKind::Other,
        };
    }
    if ["CONNECTOR", "BEAM", "PLATE"].iter().any(|whole| begins(whole, &first.text)) {
        NameKind::Connector
    } else {
        NameKind::Other
    }
}

/// The variables that a record is given the values of: `%NAME`, `%NAME%`, `%(NAME)`.
fn of_variables(text: &str, lines: Range<usize>, list: &mut Vec<Occurrence>) {
    let mut start = lines.start;
    for line in text.get(lines).unwrap_or_default().split_inclusive('\n') {
        let end = windlass_language::token::line_end(line.trim_end_matches('\n')).0;
        let kept = line.get(..end).unwrap_or_default();
        for (mark, _) in kept.match_indices('%') {
            let rest = kept.get(mark + 1..).unwrap_or_default();
            let open = usize::from(rest.starts_with('('));
            let name = rest.get(open..).unwrap_or_default();
            let length = name.bytes().take_while(|byte| byte.is_ascii_alphanumeric() || *byte == b'_').count();
            if length > 0 {
                let at = start + mark + 1 + open;
                let name = name.get(..length).unwrap_or_default().to_ascii_uppercase();
                // the % that closes a name begins none
                let closes = list.last().is_some_and(|last: &Occurrence| {
                    last.kind == NameKind::Variable && !last.defines && last.range.end == start + mark
                });
                if !closes {
                    list.push(Occurrence {
                        kind: NameKind::Variable,
                        name,
                        range: at..at + length,
                        defines: false,
                        record: 0..0,
                    });
                }
            }
        }
        start += line.len();
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn names(text: &str) -> Vec<(NameKind, String, bool)> {
        let list = occurrences(text, &HashMap::new());
        for one in &list {
            assert!(text[one.range.clone()].eq_ignore_ascii_case(&one.name), "{one:?}");
        }
        list.into_iter().map(|one| (one.kind, one.name, one.defines)).collect()
    }

    #[test]
    fn names_are_found_where_they_are_defined_and_used() {
        let text = "&DESCRIBE BODY tbrg\n*MLA 1 2 3 $ *NOT\n~W B_CAT 4 \\\n -LEN 5\nCONNECTOR A ~w *mla\n&TYPE *MLA is at &POINT(COORD *MLA)\n";
        let got = names(text);
        let want = [
            (NameKind::Body, "TBRG", true),
            (NameKind::Point, "*MLA", true),
            (NameKind::Class, "~W", true),
            (NameKind::Connector, "A", true),
            (NameKind::Class, "~W", false),
            (NameKind::Point, "*MLA", false),
        ];
        assert_eq!(got, want.map(|(kind, name, defines)| (kind, name.to_string(), defines)));
    }

    #[test]
    fn macros_and_variables_are_found() {
        let got = names("&MACRO LEG NAME = x -OPT FLAG\n*%NAME% 0 0 %(FLAG)\n&ENDMACRO\nLEG a\n&SET N = 3%N\n");
        let want = [
            (NameKind::Macro, "LEG", true),
            (NameKind::Variable, "NAME", true),
            (NameKind::Variable, "FLAG", true),
            (NameKind::Variable, "NAME", false),
            (NameKind::Variable, "FLAG", false),
            (NameKind::Macro, "LEG", false),
            (NameKind::Variable, "N", true),
            (NameKind::Variable, "N", false),
        ];
        assert_eq!(got, want.map(|(kind, name, defines)| (kind, name.to_string(), defines)));
    }
}
