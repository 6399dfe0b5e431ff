//! What is answered about a text: messages, completion, help, places of names, symbols, folds, fixes, the layout.

use super::check::{Analysis, Found};
use super::documents::{Document, Documents};
use super::names::{NameKind, Occurrence, occurrences, spec_of_record, values_of};
use super::positions::{Encoding, LineIndex};
use super::{PositionParams, RangeParams};
use crate::assist::{Known, candidates};
use crate::commands::help::{describe, option_lines, value_help};
use crate::commands::{COMMANDS, internal_names, menu};
use crate::format_scripts::format_script;
use crate::report::files::is_within;
use serde_json::{Map, Value, json};
use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::ops::Range;
use std::path::Path;
use windlass_base::diagnostic::Severity;
use windlass_base::span::SourceId;
use windlass_base::units::UnitSystem;
use windlass_base::wildcard::{is_wild, matches};
use windlass_connectors::class_specs;
use windlass_language::flow::macros::control_word;
use windlass_language::flow::specs::CONTROL;
use windlass_language::record;
use windlass_language::select::{Owner, SearchResult, keyword};
use windlass_language::source::Text;
use windlass_language::spec::{CommandSpec, MenuSpec, OptionSpec};
use windlass_language::token::{self, TokenKind};

/// Most messages shown of a text.
const MAX_SHOWN: usize = 200;
/// Most files offered in the place of a name.
const MAX_FILES: usize = 200;
/// Longest new name (characters), as the language has it.
const LONGEST_NAME: usize = 64;

/// All that an answer is made of.
pub struct Answers<'a> {
    /// The texts that the editor holds.
    pub documents: &'a Documents,
    /// The one that is asked about.
    pub document: &'a Document,
    /// The last check that it took part in.
    pub analysis: Option<&'a Analysis>,
    /// How characters are counted.
    pub encoding: Encoding,
}

/// The messages of a file of a check.
pub fn diagnostics(analysis: &Analysis, source: usize, documents: &Documents, encoding: Encoding) -> Vec<Value> {
    let Some((_, text)) = analysis.sources.get(source) else { return Vec::new() };
    let index = LineIndex::new(text, encoding);
    let mut list: Vec<Value> = Vec::new();
    let own = |found: &&Found| found.source == source;
    let mut seen: Vec<(u32, &str)> = Vec::new();
    for found in analysis.found.iter().filter(own) {
        let span = found.said.span.unwrap_or_default();
        // a record of a loop says the same in every trip
        if seen.contains(&(span.start, found.said.message.as_str())) {
            continue;
        }
        seen.push((span.start, found.said.message.as_str()));
        if list.len() == MAX_SHOWN {
            let more = analysis.found.iter().filter(own).count() - MAX_SHOWN;
            let message = format!("{more} more messages: windlass check lists them");
            list.push(json!({"range": index.range(0..0), "severity": 3, "source": "windlass", "message": message}));
            break;
        }
        let mut message = found.said.message.clone();
        if !found.said.label.is_empty() {
            message.push_str(&format!("\n{}", found.said.label));
        }
        for help in &found.said.help {
            message.push_str(&format!("\nhelp: {help}"));
        }
        let severity = match found.said.severity {
            Severity::Error | Severity::Fatal => 1,
            Severity::Warning => 2,
            Severity::Note => 3,
        };
        let range = index.range(span.start as usize..span.end as usize);
        let mut one = json!({"range": range, "severity": severity, "source": "windlass", "message": message});
        if let (Some((span, text)), Some(other)) = (&found.said.other, found.other)
            && let Some((path, other_text)) = analysis.sources.get(other)
            && let Some(object) = one.as_object_mut()
        {
            let range = LineIndex::new(other_text, encoding).range(span.start as usize..span.end as usize);
            let location = json!({"uri": documents.uri_of(path), "range": range});
            object.insert("relatedInformation".into(), json!([{"location": location, "message": text}]));
        }
        list.push(one);
    }
    list
}

/// A file, its text, and the places of a name in it.
type NamePlaces<'a> = (&'a Path, &'a str, Vec<Occurrence>);

/// A record at a place of a text.
struct RecordAt {
    /// Its first byte.
    start: usize,
    /// Its text up to the place, lines that are continued joined.
    before: String,
}

impl Answers<'_> {
    fn text(&self) -> &str {
        &self.document.text
    }

    fn index(&self) -> LineIndex<'_> {
        LineIndex::new(self.text(), self.encoding)
    }

    fn byte(&self, position: PositionParams) -> usize {
        self.index().byte(position.line, position.character)
    }

    fn units(&self) -> UnitSystem {
        self.analysis.map_or_else(UnitSystem::default, |analysis| analysis.units)
    }

    /// The record that a byte stands in; `None` within a comment.
    fn record_at(&self, byte: usize) -> Option<RecordAt> {
        let text = self.text();
        let mut start = 0;
        while start < text.len() {
            let (_, next, _) = record::read(text, SourceId::default(), start);
            if byte < next || next >= text.len() {
                break;
            }
            start = next;
        }
        // behind the last end of a line a record begins
        if text.get(start..byte).is_some_and(|typed| typed.ends_with('\n')) {
            let line = text.get(start..byte)?;
            let is_open = line.lines().fold(false, |open, line| token::is_continued(line, open));
            start = if is_open { start } else { byte };
        }
        let typed = text.get(start..byte)?;
        let line = typed.rfind('\n').map_or(0, |at| at + 1);
        let last = typed.get(line..)?;
        if token::line_end(last).0 < last.len() {
            return None;
        }
        let mut before = String::new();
        for line in typed.split('\n') {
            if !before.is_empty() {
                before.push(' ');
            }
            before.push_str(line.get(..token::line_end(line).0).unwrap_or_default());
        }
        Some(RecordAt { start, before })
    }

    /// The menu that is open before a byte, as the last check found it.
    fn menu_at(&self, byte: usize) -> &'static MenuSpec {
        let records = self.analysis.and_then(|analysis| {
            let own = analysis.source_of(&self.document.path)?;
            analysis.records.iter().rev().find(|(source, met)| *source == own && (met.span.end as usize) <= byte)
        });
        records.map_or(&menu::MAIN, |(_, met)| met.menu)
    }

    /// The commands that a check found at the first bytes of the records of a file.
    fn met(&self, path: &Path) -> HashMap<usize, &'static CommandSpec> {
        let Some(analysis) = self.analysis else { return HashMap::new() };
        let own = analysis.source_of(path);
        let records = analysis.records.iter().filter(|(source, _)| Some(*source) == own);
        records.filter_map(|(_, met)| Some((met.span.start as usize, met.command?.spec))).collect()
    }

    /// What could stand at a place.
    pub fn completion(&self, position: PositionParams) -> Value {
        let byte = self.byte(position);
        let Some(at) = self.record_at(byte) else { return json!([]) };
        let none = Known::default();
        let known = self.analysis.map_or(&none, |analysis| &analysis.known);
        let open_menu = self.menu_at(at.start);
        let found = candidates(known, open_menu, &at.before);
        let word = at.before.get(found.start..).unwrap_or_default();
        let words: Vec<String> = if found.is_file { self.files(word) } else { found.words };
        let range = self.index().range(byte.saturating_sub(word.len())..byte);
        let head = at.before.get(..found.start).unwrap_or_default();
        let tokens = token::words(head);
        let spec = crate::assist::spec_of(open_menu, head, &tokens).map(|(spec, _)| spec);
        let items = words.into_iter().map(|text| {
            let (kind, detail) = self.describe_candidate(&text, spec, tokens.is_empty(), found.is_file);
            let typed = if text.contains(char::is_whitespace) { format!("'{text}'") } else { text.clone() };
            json!({"label": text, "kind": kind, "detail": detail, "filterText": text, "textEdit": {"range": range, "newText": typed}})
        });
        json!({"isIncomplete": false, "items": items.collect::<Vec<_>>()})
    }

    /// The kind of a candidate in the protocol, and a line of help.
    fn describe_candidate(
        &self,
        text: &str,
        spec: Option<&'static CommandSpec>,
        is_first: bool,
        is_file: bool,
    ) -> (u8, String) {
        if is_file {
            return (17, String::new());
        }
        match (text.chars().next(), spec) {
            (Some('-'), Some(spec)) => {
                let option = spec.options.iter().find(|option| option.name == text);
                return (5, option.map_or_else(String::new, |option| format!("{}: {}", option.syntax(), option.help)));
            }
            (Some('%'), _) => return (6, "variable".into()),
            (Some('~'), _) => return (7, "class".into()),
            (Some('*'), _) => return (21, "point".into()),
            _ => {}
        }
        let commands = COMMANDS.iter().map(|command| command.spec).chain(CONTROL);
        let is_class = spec.is_none() && !is_first;
        let mut all: Box<dyn Iterator<Item = &CommandSpec>> =
            if is_class { Box::new(class_specs()) } else { Box::new(commands) };
        match all.find(|known| (is_first || is_class) && known.name == text) {
            Some(known) => (14, known.help.to_string()),
            None => (12, String::new()),
        }
    }

    /// The files below the folder of the text whose names begin with a word.
    fn files(&self, word: &str) -> Vec<String> {
        let Some(folder) = self.document.path.parent().filter(|folder| folder.is_absolute()) else { return Vec::new() };
        let (below, begun) = word.rsplit_once('/').map_or(("", word), |(below, begun)| (below, begun));
        let listed = folder.join(below);
        if !is_within(&listed, folder) {
            return Vec::new();
        }
        let Ok(entries) = std::fs::read_dir(&listed) else { return Vec::new() };
        let mut names: Vec<String> = entries
            .flatten()
            .take(10 * MAX_FILES)
            .filter_map(|entry| {
                let name = entry.file_name().into_string().ok()?;
                let shown = name.starts_with(begun) && !name.starts_with('.');
                let is_folder = entry.file_type().is_ok_and(|kind| kind.is_dir());
                let slash = if is_folder { "/" } else { "" };
                let before = if below.is_empty() { String::new() } else { format!("{below}/") };
                shown.then(|| format!("{before}{name}{slash}"))
            })
            .collect();
        names.sort();
        names.truncate(MAX_FILES);
        names
    }

    /// The help of the word at a place.
    pub fn hover(&self, position: PositionParams) -> Value {
        let byte = self.byte(position);
        self.hover_at(byte).unwrap_or(Value::Null)
    }

    fn hover_at(&self, byte: usize) -> Option<Value> {
        let at = self.record_at(byte)?;
        let (record, ..) = record::read(self.text(), SourceId::default(), at.start);
        let words = record.words();
        let within = |range: &Range<usize>| range.contains(&byte);
        let ranges: Vec<Range<usize>> =
            words.iter().map(|word| word.span.start as usize..word.span.end as usize).collect();
        let at_word = ranges.iter().position(within)?;
        let (word, range) = (words.get(at_word)?, ranges.get(at_word)?.clone());
        let units = self.units();
        let met = self.met(&self.document.path).get(&at.start).copied();
        let met = met.or_else(|| {
            let open = crate::assist::spec_of(self.menu_at(at.start), record.text(), &token::words(record.text()));
            open.map(|(spec, _)| spec)
        });
        let spec = spec_of_record(&record, met);
        let is_class = words.first()?.kind == TokenKind::Class;
        let lead = if is_class { "~NAME " } else { "" };
        let mut text = match spec {
            Some((spec, from)) if at_word + 1 == from || (at_word == 0 && !is_class) => {
                Some(describe(spec, lead, units))
            }
            Some((spec, _)) if word.kind == TokenKind::Option => match keyword(&word.text, spec.option_names()) {
                SearchResult::One(option) => Some(option_help(spec, lead, option, units)),
                _ => None,
            },
            Some((spec, from)) => {
                let value = values_of(spec, &words, from).get(at_word).copied().flatten();
                value.map(|value| format!("{}   {}", value.name, value_help(value, units)))
            }
            None => None,
        };
        if let Some(defined) = self.described_name(byte) {
            text = Some(text.map_or(defined.clone(), |text| format!("{defined}\n\n{text}")));
        }
        let text = text?;
        // a fence that no text of help ends
        let value = format!("```text\n{}\n```", text.replace("```", "` ` `"));
        Some(json!({"contents": {"kind": "markdown", "value": value}, "range": self.index().range(range)}))
    }

    /// The record that defines the name at a byte, where it is another one.
    fn described_name(&self, byte: usize) -> Option<String> {
        let all = self.named();
        let (path, text, defined) = Self::find_definition(&all, byte)?;
        if path == self.document.path && defined.record.contains(&byte) {
            return None;
        }
        let record = text.get(defined.record.clone())?;
        let line = 1 + text.get(..defined.range.start)?.matches('\n').count();
        let name = path.file_name()?.to_string_lossy().into_owned();
        let shown: String = record.lines().take(4).collect::<Vec<_>>().join("\n");
        Some(format!("{} of {name}:{line}\n   {}", defined.kind.noun(), shown.chars().take(400).collect::<String>()))
    }

    /// The text that is asked about, and those that are read with it.
    fn texts(&self) -> Vec<(&Path, &str)> {
        let mut list = vec![(self.document.path.as_path(), self.text())];
        for (path, text) in self.analysis.map_or(&[][..], |analysis| &analysis.sources) {
            if *path != self.document.path {
                let held = self.documents.by_path(path).map_or(&**text, |document| &document.text);
                list.push((path, held));
            }
        }
        list
    }

    /// The files that are read together with their names. A call that abbreviates a macro has the macro's whole name.
    fn named(&self) -> Vec<NamePlaces<'_>> {
        let texts = self.texts().into_iter();
        let mut all: Vec<NamePlaces<'_>> =
            texts.map(|(path, text)| (path, text, occurrences(text, &self.met(path)))).collect();
        let every = all.iter().flat_map(|(_, _, list)| list);
        let macros: BTreeSet<String> =
            every.filter(|one| one.defines && one.kind == NameKind::Macro).map(|one| one.name.clone()).collect();
        let calls =
            all.iter_mut().flat_map(|(_, _, list)| list).filter(|one| one.kind == NameKind::Macro && !one.defines);
        for call in calls {
            if !macros.contains(&call.name)
                && let [whole] = *macros.iter().filter(|name| name.starts_with(&call.name)).collect::<Vec<_>>()
            {
                call.name.clone_from(whole);
            }
        }
        all
    }

    /// The name at a byte of the text that is asked about, the first of those that are read.
    fn name_at<'a>(all: &'a [NamePlaces<'_>], byte: usize) -> Option<&'a Occurrence> {
        let (_, _, own) = all.first()?;
        own.iter().find(|one| one.range.start <= byte && byte <= one.range.end)
    }

    /// The record that defines the name at a byte.
    fn find_definition<'a, 't>(all: &'a [NamePlaces<'t>], byte: usize) -> Option<(&'t Path, &'t str, &'a Occurrence)> {
        let wanted = Self::name_at(all, byte)?;
        let means = |one: &&Occurrence| one.defines && one.name == wanted.name && wanted.kind.may_be(one.kind);
        all.iter().find_map(|(path, text, list)| Some((*path, *text, list.iter().find(means)?)))
    }

    /// The name that the record of a definition gives, and every place of it among all of them.
    fn places<'t>(all: &[NamePlaces<'t>], byte: usize) -> Option<(Occurrence, Vec<NamePlaces<'t>>)> {
        let (_, _, defined) = Self::find_definition(all, byte)?;
        let means = |one: &&Occurrence| one.name == defined.name && one.kind.may_be(defined.kind);
        let of_text =
            |(path, text, list): &NamePlaces<'t>| (*path, *text, list.iter().filter(means).cloned().collect());
        Some((defined.clone(), all.iter().map(of_text).collect()))
    }

    fn location(&self, path: &Path, text: &str, range: Range<usize>) -> Value {
        json!({"uri": self.documents.uri_of(path), "range": LineIndex::new(text, self.encoding).range(range)})
    }

    /// Where the name at a place is defined.
    pub fn definition(&self, position: PositionParams) -> Value {
        let all = self.named();
        let found = Self::find_definition(&all, self.byte(position));
        found.map_or(Value::Null, |(path, text, one)| self.location(path, text, one.range.clone()))
    }

    /// All places of the name at a place.
    pub fn references(&self, position: PositionParams) -> Value {
        let Some((_, places)) = Self::places(&self.named(), self.byte(position)) else { return json!([]) };
        let all = places.iter().flat_map(|(path, text, list)| {
            list.iter().map(|one| self.location(path, text, one.range.clone())).collect::<Vec<_>>()
        });
        Value::Array(all.collect())
    }

    /// The range of the name at a place, where it can have another.
    pub fn prepare_rename(&self, position: PositionParams) -> Value {
        let byte = self.byte(position);
        let all = self.named();
        match (Self::find_definition(&all, byte), Self::name_at(&all, byte)) {
            (Some(_), Some(one)) => {
                let range = self.index().range(one.range.clone());
                json!({"range": range, "placeholder": self.text().get(one.range.clone())})
            }
            _ => Value::Null,
        }
    }

    /// The changes that give the name at a place another.
    ///
    /// # Errors
    /// A place without a name that is defined, a new name that cannot be one, or one that is taken.
    pub fn rename(&self, position: PositionParams, new_name: &str) -> Result<Value, String> {
        let byte = self.byte(position);
        let all = self.named();
        let Some((defined, places)) = Self::places(&all, byte) else {
            return Err("there is no name here that a record defines".into());
        };
        let kind = defined.kind;
        let mark = match kind {
            NameKind::Class => "~",
            NameKind::Point => "*",
            NameKind::Selector => ":",
            _ => "",
        };
        let bare = new_name.strip_prefix(mark).unwrap_or(new_name);
        let fits = |sign: char| {
            if kind == NameKind::Variable { sign.is_ascii_alphanumeric() || sign == '_' } else { is_of_name(sign) }
        };
        if bare.is_empty() || bare.chars().count() > LONGEST_NAME || !bare.chars().all(fits) || bare.starts_with('-') {
            return Err(format!(
                "`{new_name}` cannot name a {}: letters, digits and _, at most {LONGEST_NAME}",
                kind.noun()
            ));
        }
        let name = format!("{mark}{bare}");
        let upper = name.to_ascii_uppercase();
        let mut every = all.iter().flat_map(|(_, _, list)| list);
        let is_taken = every.any(|one| one.defines && one.name == upper && one.kind.may_be(kind));
        if is_taken && defined.name != upper {
            return Err(format!("there is a {} {name} already", kind.noun()));
        }
        if kind == NameKind::Macro
            && let Some(command) = command_of(&name)
        {
            return Err(format!(
                "{name} is a name of the command {command}: records that call the macro would be that command"
            ));
        }
        for (_, text, _) in &all {
            let changed = patterns(text).into_iter().find(|pattern| {
                let mut each = [&defined.name, &upper].map(|one| matches(pattern, one)).into_iter();
                kind != NameKind::Macro && kind != NameKind::Variable && each.next() != each.next()
            });
            if let Some(pattern) = changed.filter(|_| defined.name != upper) {
                return Err(format!(
                    "the pattern {pattern} matches one of {} and {name} and not the other: the script would do something else",
                    defined.name
                ));
            }
        }
        let mut changes: BTreeMap<String, Vec<Value>> = BTreeMap::new();
        for (path, text, list) in places.iter().filter(|(_, _, list)| !list.is_empty()) {
            let index = LineIndex::new(text, self.encoding);
            let edit = |one: &Occurrence| json!({"range": index.range(one.range.clone()), "newText": name});
            changes.insert(self.documents.uri_of(path), list.iter().map(edit).collect());
        }
        Ok(json!({"changes": changes}))
    }

    /// The names that the text defines, each once.
    pub fn symbols(&self) -> Value {
        let index = self.index();
        let mut seen: Vec<(NameKind, String)> = Vec::new();
        let mut list = Vec::new();
        for one in occurrences(self.text(), &self.met(&self.document.path)).into_iter().filter(|one| one.defines) {
            let key = (one.kind, one.name.clone());
            if seen.contains(&key) {
                continue;
            }
            seen.push(key);
            list.push(json!({
                "name": self.text().get(one.range.clone()),
                "detail": one.kind.noun(),
                "kind": one.kind.symbol(),
                "range": index.range(one.record),
                "selectionRange": index.range(one.range),
            }));
        }
        Value::Array(list)
    }

    /// Menus, blocks, records of several lines and comments, as lines that can be folded.
    pub fn folds(&self) -> Value {
        let text = self.text();
        let index = self.index();
        let mut folds: Vec<(usize, usize, &str)> = Vec::new();
        if let Some((analysis, own)) = self.analysis.and_then(|a| Some((a, a.source_of(&self.document.path)?))) {
            let mut open: Vec<usize> = Vec::new();
            for (_, met) in analysis.records.iter().filter(|(source, _)| *source == own) {
                let (before, behind) = met.depth;
                let line = index.line((met.span.start as usize).min(text.len()));
                open.extend(std::iter::repeat_n(line, behind.saturating_sub(before)));
                for _ in behind..before {
                    folds.extend(open.pop().map(|first| (first, line, "region")));
                }
            }
        }
        let internal: Vec<(&'static str, Owner)> =
            CONTROL.iter().map(|spec| (spec.name, spec.owner)).chain(internal_names()).collect();
        let mut blocks: Vec<(&str, usize)> = Vec::new();
        let mut comment: Option<(usize, usize)> = None;
        let mut at = 0;
        while at < text.len() {
            let (record, next, _) = record::read(text, SourceId::default(), at);
            let (first, last) = (index.line(at), index.line(next.saturating_sub(1).max(at)));
            let is_comment = text.get(at..next).is_some_and(|typed| typed.trim_start().starts_with('$'));
            comment = match comment {
                Some((begun, _)) if is_comment => Some((begun, last)),
                None if is_comment => Some((first, last)),
                open => {
                    folds.extend(open.map(|(begun, end)| (begun, end, "comment")));
                    None
                }
            };
            if !is_comment {
                folds.push((first, last, "region"));
            }
            match control_word(record.first_word(), &internal) {
                Some(name @ ("&IF" | "&LOOP" | "&MACRO")) => blocks.push((name, first)),
                Some(name @ ("&ENDIF" | "&ENDLOOP" | "&ENDMACRO")) => {
                    let opened = name.replace("END", "");
                    if let Some(place) = blocks.iter().rposition(|(block, _)| *block == opened) {
                        folds.extend(blocks.get(place).map(|(_, begun)| (*begun, first, "region")));
                        blocks.truncate(place);
                    }
                }
                _ => {}
            }
            at = next;
        }
        folds.extend(comment.map(|(begun, end)| (begun, end, "comment")));
        folds.sort();
        folds.dedup();
        let lines = folds.iter().filter(|(first, last, _)| first < last);
        Value::Array(
            lines.map(|(first, last, kind)| json!({"startLine": first, "endLine": last, "kind": kind})).collect(),
        )
    }

    /// The fixes that messages of a range name.
    pub fn actions(&self, range: Option<RangeParams>) -> Value {
        let (Some(analysis), Some(range)) = (self.analysis, range) else { return json!([]) };
        let Some(own) = analysis.source_of(&self.document.path) else { return json!([]) };
        // the places are those of the text that was checked
        if analysis.versions.get(&self.document.path) != Some(&self.document.version) {
            return json!([]);
        }
        let (from, to) = (self.byte(range.start), self.byte(range.end));
        let shown = diagnostics(analysis, own, self.documents, self.encoding);
        let mut list = Vec::new();
        for found in analysis.found.iter().filter(|found| found.source == own) {
            let span = found.said.span.unwrap_or_default();
            let place = span.start as usize..span.end as usize;
            let word = self.text().get(place.clone()).unwrap_or_default();
            if place.start > to || place.end < from || word.is_empty() || word.contains(char::is_whitespace) {
                continue;
            }
            let range = self.index().range(place);
            let said = shown.iter().find(|one| one.get("range") == Some(&range));
            for name in proposed(found) {
                let mut changes = Map::new();
                changes.insert(self.document.uri.clone(), json!([{"range": range, "newText": name}]));
                list.push(json!({
                    "title": format!("Write {name} for {word}"),
                    "kind": "quickfix",
                    "diagnostics": said.into_iter().collect::<Vec<_>>(),
                    "edit": {"changes": changes},
                }));
            }
        }
        Value::Array(list)
    }

    /// The change that lays the text out; none where it is a deck or is laid out.
    pub fn formatting(&self) -> Value {
        let text = self.text();
        let Ok(formatted) = format_script(&self.document.path.to_string_lossy(), &Text::from(text.to_string())) else {
            return Value::Null;
        };
        if formatted == text {
            return json!([]);
        }
        // only the lines between the first and the last that change, so that marks of the editor elsewhere stay
        let same = |a: &str, b: &str| a == b;
        let head: usize = text
            .split_inclusive('\n')
            .zip(formatted.split_inclusive('\n'))
            .take_while(|(old, new)| same(old, new))
            .map(|(old, _)| old.len())
            .sum();
        let (old, new) = (text.get(head..).unwrap_or_default(), formatted.get(head..).unwrap_or_default());
        let tail: usize = old
            .split_inclusive('\n')
            .rev()
            .zip(new.split_inclusive('\n').rev())
            .take_while(|(old, new)| same(old, new))
            .map(|(old, _)| old.len())
            .sum();
        let range = self.index().range(head..text.len() - tail);
        json!([{"range": range, "newText": new.get(..new.len() - tail).unwrap_or_default()}])
    }
}

/// What can stand in a name, as a word that is read without quotes.
fn is_of_name(sign: char) -> bool {
    sign.is_alphanumeric() || "_.+-/".contains(sign)
}

/// The help of an option alone.
fn option_help(spec: &CommandSpec, lead: &str, option: &OptionSpec, units: UnitSystem) -> String {
    format!("{lead}{} {}\n\n{}", spec.name, option.name, option_lines(option, units).join("\n"))
}

/// The names that a message proposes: those of "did you mean", or those that an ambiguous word could be.
fn proposed(found: &Found) -> Vec<String> {
    let meant = found.said.help.iter().filter_map(|help| help.strip_prefix("did you mean ")?.strip_suffix('?'));
    let could_be = found.said.label.strip_prefix("could be ");
    let lists = meant.chain(could_be);
    lists
        .flat_map(|list| list.split(", ").flat_map(|names| names.split(" or ")))
        .map(|name| name.trim().trim_matches('`').to_string())
        .filter(|name| !name.is_empty() && !name.contains(char::is_whitespace))
        .collect()
}

/// The words of a text that select names by wild characters.
fn patterns(text: &str) -> Vec<String> {
    let mut list = Vec::new();
    let mut at = 0;
    while at < text.len() {
        let (record, next, _) = record::read(text, SourceId::default(), at);
        let words = record.words();
        let wild = words.iter().map(|word| word.text.to_ascii_uppercase()).filter(|word| is_wild(word));
        list.extend(wild.filter(|word| !word.contains('%')));
        at = next;
    }
    list
}

/// The command that a word calls in some menu; a macro of that name is never called there.
fn command_of(word: &str) -> Option<&'static str> {
    let specs = COMMANDS.iter().map(|command| command.spec).chain(CONTROL);
    specs.map(|spec| spec.name).find(|name| name.eq_ignore_ascii_case(word))
}
