//! What rows say of each other: ids in order, names and ids that are there.

use crate::tables::{Attachment, LineEnd};
use crate::{Deck, Given};
use std::collections::BTreeMap;
use windlass_base::diagnostic::{Diagnostic, suggest};
use windlass_base::span::{SourceId, Span};

pub(crate) fn check(deck: &Deck, source: SourceId, messages: &mut Vec<Diagnostic>) {
    if deck.lines.is_empty() && deck.bodies.is_empty() && deck.rods.is_empty() && messages.is_empty() {
        let error = Diagnostic::error("the file has no section LINES, BODIES or RODS", Span::new(source, 0, 0));
        messages.push(*error.help("a section begins with a line such as --- LINES ---"));
    }
    // of rows that could not be read, ids and names are missing: what refers to them is not judged
    if messages.iter().any(|m| m.severity == windlass_base::diagnostic::Severity::Error) {
        return;
    }
    ids("body", deck.bodies.iter().map(|body| &body.id), messages);
    ids("rod", deck.rods.iter().map(|rod| &rod.id), messages);
    ids("point", deck.points.iter().map(|point| &point.id), messages);
    ids("line", deck.lines.iter().map(|line| &line.id), messages);
    let line_types = names("line type", deck.line_types.iter().map(|kind| &kind.name), messages);
    let rod_types = names("rod type", deck.rod_types.iter().map(|kind| &kind.name), messages);
    for line in &deck.lines {
        known("line type", &line.line_type, &line_types, messages);
        for end in &line.ends {
            match end.value {
                LineEnd::Point(id) => exists("point", id, deck.points.len(), end.span, messages),
                LineEnd::RodA(id) | LineEnd::RodB(id) => exists("rod", id, deck.rods.len(), end.span, messages),
            }
        }
        let [a, b] = &line.ends;
        if a.value == b.value {
            messages.push(*Diagnostic::error("both ends of the line are at the same place", b.span));
        }
    }
    for rod in &deck.rods {
        known("rod type", &rod.rod_type, &rod_types, messages);
    }
    let attachments =
        deck.rods.iter().map(|rod| &rod.attachment).chain(deck.points.iter().map(|point| &point.attachment));
    for attachment in attachments {
        if let Attachment::Body(id) | Attachment::BodyPinned(id) = attachment.value {
            exists("body", id, deck.bodies.len(), attachment.span, messages);
        }
    }
}

fn ids<'a>(kind: &str, list: impl Iterator<Item = &'a Given<usize>>, messages: &mut Vec<Diagnostic>) {
    for (index, id) in list.enumerate() {
        if id.value != index + 1 {
            let error = Diagnostic::error(format!("{kind} {} stands in place {}", id.value, index + 1), id.span);
            messages
                .push(*error.label(format!("expected {}", index + 1)).help("ids are 1, 2, 3 .. in the order of rows"));
            return;
        }
    }
}

fn names<'a>(
    kind: &str,
    list: impl Iterator<Item = &'a Given<String>>,
    messages: &mut Vec<Diagnostic>,
) -> BTreeMap<&'a str, Span> {
    let mut found = BTreeMap::new();
    for name in list {
        if let Some(earlier) = found.insert(name.value.as_str(), name.span) {
            let error = Diagnostic::error(format!("{kind} {} is defined twice", name.value), name.span);
            messages.push(*error.other(earlier, "defined here first"));
        }
    }
    found
}

fn known(kind: &str, name: &Given<String>, all: &BTreeMap<&str, Span>, messages: &mut Vec<Diagnostic>) {
    if !all.contains_key(name.value.as_str()) {
        let error = Diagnostic::error(format!("{kind} {} is not known", name.value), name.span);
        messages.push(match suggest(&name.value, all.keys().copied()) {
            Some(help) => *error.help(help),
            None => *error,
        });
    }
}

fn exists(kind: &str, id: usize, count: usize, span: Span, messages: &mut Vec<Diagnostic>) {
    if id > count {
        let error = Diagnostic::error(format!("there is no {kind} {id}"), span);
        let last = if count == 0 { format!("the deck has no {kind}") } else { format!("the last {kind} is {count}") };
        messages.push(*error.label(last));
    }
}
