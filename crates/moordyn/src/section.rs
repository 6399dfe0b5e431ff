//! Sections of a deck: a head is a line with `---` and the name of a section; the section ends at the next line with `---`.

use crate::row::{Row, words};
use windlass_base::diagnostic::{Diagnostic, nearest};
use windlass_base::span::{SourceId, Span};

/// What a section holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum SectionKind {
    LineTypes,
    RodTypes,
    Bodies,
    Rods,
    Points,
    Lines,
    Options,
    Outputs,
    /// One that acts on the system and that windlass does not read.
    Refused,
}

/// The names of sections in versions 1 and 2, and of the Fortran version.
const NAMES: [(&str, SectionKind); 27] = [
    ("LINE TYPES", SectionKind::LineTypes),
    ("LINE DICTIONARY", SectionKind::LineTypes),
    ("ROD TYPES", SectionKind::RodTypes),
    ("ROD DICTIONARY", SectionKind::RodTypes),
    ("BODIES", SectionKind::Bodies),
    ("BODY LIST", SectionKind::Bodies),
    ("BODY PROPERTIES", SectionKind::Bodies),
    ("RODS", SectionKind::Rods),
    ("ROD LIST", SectionKind::Rods),
    ("ROD PROPERTIES", SectionKind::Rods),
    ("POINTS", SectionKind::Points),
    ("POINT LIST", SectionKind::Points),
    ("POINT PROPERTIES", SectionKind::Points),
    ("CONNECTION PROPERTIES", SectionKind::Points),
    ("NODE PROPERTIES", SectionKind::Points),
    ("LINES", SectionKind::Lines),
    ("LINE LIST", SectionKind::Lines),
    ("LINE PROPERTIES", SectionKind::Lines),
    ("OPTIONS", SectionKind::Options),
    ("SOLVER OPTIONS", SectionKind::Options),
    ("OUTPUTS", SectionKind::Outputs),
    ("OUTPUT", SectionKind::Outputs),
    ("SYROPE IC", SectionKind::Refused),
    ("FAILURE", SectionKind::Refused),
    ("CONTROL", SectionKind::Refused),
    ("EXTERNAL LOADS", SectionKind::Refused),
    ("EXTERNAL LOAD", SectionKind::Refused),
];

/// One section: its head, the rows of column names and of units, and the rows of values.
pub(crate) struct Section<'a> {
    pub(crate) kind: SectionKind,
    pub(crate) head: Span,
    pub(crate) columns: Row<'a>,
    pub(crate) units: Row<'a>,
    pub(crate) rows: Vec<Row<'a>>,
}

/// The first section name in a head, the longest where two begin at one place.
fn kind_of(head: &str) -> Option<(SectionKind, &'static str)> {
    let upper = head.to_ascii_uppercase();
    let found = NAMES.iter().filter_map(|&(name, kind)| Some((upper.find(name)?, name, kind)));
    found.min_by_key(|&(at, name, _)| (at, usize::MAX - name.len())).map(|(_, name, kind)| (kind, name))
}

/// Whether a line holds values: numbers among its first words.
fn is_row_of_values(row: &Row<'_>) -> bool {
    row.words.iter().take(5).filter(|word| word.value.parse::<f64>().is_ok_and(f64::is_finite)).count() >= 2
}

/// The sections of a text. Text before the first head is free; behind it, rows under a head without a name are an error.
///
/// A file of MAP++ has names and units behind the head of its options too, and no comments in its rows.
pub(crate) fn split<'a>(
    text: &'a str,
    source: SourceId,
    is_map: bool,
    messages: &mut Vec<Diagnostic>,
) -> Vec<Section<'a>> {
    let mut sections: Vec<Section<'a>> = Vec::new();
    // whether rows belong to the last section, and how many lines of names and units are still to come
    let mut is_open = false;
    let mut heading_lines = 0;
    let mut nameless: Option<Span> = None;
    let mut offset = 0;
    for line in text.split_inclusive('\n') {
        let begin = offset;
        let row = words(line, begin, source, !is_map);
        offset += line.len();
        if line.contains("---") {
            let head = row.span;
            if is_open && is_row_of_values(&row) {
                let error = Diagnostic::error("a line with --- ends the section, and this one holds values", head);
                messages.push(*error.label("would not be read").help("--- stands in heads of sections alone"));
            }
            nameless = None;
            is_open = false;
            if let Some((kind, name)) = kind_of(line) {
                if kind == SectionKind::Refused {
                    let error = Diagnostic::error(
                        format!("section {name} is not read: what it does to the system would be lost"),
                        head,
                    );
                    messages.push(*error.help("take the section out to run the system without it"));
                }
                let is_headless = matches!(kind, SectionKind::Options | SectionKind::Outputs) && !is_map;
                heading_lines = if is_headless { 0 } else { 2 };
                sections.push(Section { kind, head, columns: Row::default(), units: Row::default(), rows: Vec::new() });
                is_open = true;
                continue;
            }
            let title = line.trim().trim_matches('-').trim();
            let near = if title.is_empty() { Vec::new() } else { nearest(title, NAMES.iter().map(|&(name, _)| name)) };
            if let Some(near) = near.first() {
                let error = Diagnostic::error(format!("section {title} is not known"), head);
                let error = error.help(format!("did you mean {near}?"));
                messages.push(*error.help("a title is a line without ---, or one that resembles no section"));
            } else if !sections.is_empty() {
                nameless = Some(head);
            }
        } else if is_open && heading_lines > 0 {
            if is_row_of_values(&row) {
                let what = if heading_lines == 2 { "names of columns" } else { "units" };
                let error = Diagnostic::error(format!("a row of values stands where the line of {what} is"), row.span);
                messages.push(
                    *error.label("would not be read").help("a section begins with a line of names and a line of units"),
                );
            }
            if let Some(section) = sections.last_mut() {
                if heading_lines == 2 {
                    section.columns = row;
                } else {
                    // (#) is a unit here, and begins no comment
                    section.units = words(line, begin, source, false);
                }
            }
            heading_lines -= 1;
        } else if row.words.is_empty() {
            continue;
        } else if let (true, Some(section)) = (is_open, sections.last_mut()) {
            section.rows.push(row);
        } else if let Some(head) = nameless.take() {
            let error = Diagnostic::error("this row belongs to no section", row.span).label("would not be read");
            messages.push(*error.other(head, "a line with --- ends the section before it; this one names none"));
        }
    }
    sections
}
