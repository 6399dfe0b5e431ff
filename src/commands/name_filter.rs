//! The names a record gives to choose among what the model holds.

use crate::commands::Job;
use std::cell::Cell;
use windlass_base::diagnostic::Severity;
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;
use windlass_base::table::{Table, TableNote};
use windlass_base::values::Value;
use windlass_base::wildcard::matches;
use windlass_model::{EntityKind, Model};

/// Names, patterns and selectors; none given chooses all. It remembers which of them chose something.
pub struct NameFilter<'a> {
    model: &'a Model,
    given: Vec<(&'a str, Span, Cell<bool>)>,
    asked: Cell<bool>,
}

impl<'a> NameFilter<'a> {
    /// The words among some values.
    pub fn new(values: impl IntoIterator<Item = &'a Value>, model: &'a Model) -> Self {
        let given = values.into_iter().filter_map(|v| Some((v.word()?, v.span, Cell::new(false)))).collect();
        NameFilter { model, given, asked: Cell::new(false) }
    }

    /// Whether no name is given.
    pub fn chooses_all(&self) -> bool {
        self.given.is_empty()
    }

    /// Whether a name is chosen.
    pub fn matches(&self, name: &str) -> bool {
        self.asked.set(true);
        self.given.iter().fold(self.given.is_empty(), |taken, (pattern, _, used)| {
            let fits = match self.model.selectors.get(&Model::key(pattern)) {
                Some(selector) => selector.matches(name, self.model),
                None => matches(pattern, name),
            };
            used.set(used.get() || fits);
            taken || fits
        })
    }

    /// Refuses a name that chose nothing for these tables of such things.
    ///
    /// # Errors
    /// The first such name, at its place, with near ones.
    pub fn check(&self, what: &str, tables: &[Table], things: &[EntityKind]) -> Outcome<()> {
        let empty = tables.iter().all(|t| t.rows() == 0 && t.facts.is_empty());
        self.refuse(what, things, |used| empty || (self.asked.get() && !used))
    }

    /// Refuses a name that chose nothing.
    ///
    /// # Errors
    /// The first such name, at its place, with near ones.
    pub fn check_used(&self, what: &str, things: &[EntityKind]) -> Outcome<()> {
        self.refuse(what, things, |used| !used)
    }

    fn refuse(&self, what: &str, things: &[EntityKind], wrong: impl Fn(bool) -> bool) -> Outcome<()> {
        let unused = self.given.iter().find(|(_, _, used)| wrong(used.get()));
        unused.map_or(Ok(()), |(name, span, _)| {
            let mut error = Diagnostic::error(format!("nothing among {what} is called {name}"), *span);
            error.help.extend(suggest(name, things.iter().flat_map(|t| self.model.names(*t))));
            Err(error)
        })
    }
}

/// The remarks of several things, each once, with the names of all it holds for.
pub fn merge_remarks(list: &[(String, Vec<TableNote>)]) -> Vec<TableNote> {
    /// Names written out; of more the number is given.
    const MAX_NAMES: usize = 8;
    let mut merged: Vec<(&TableNote, Vec<&str>)> = Vec::new();
    for (name, notes) in list {
        for note in notes {
            match merged.iter_mut().find(|(known, _)| *known == note) {
                Some((_, names)) => names.push(name),
                None => merged.push((note, vec![name])),
            }
        }
    }
    let line = |(note, names): (&TableNote, Vec<&str>)| {
        let more = names.len().saturating_sub(MAX_NAMES);
        let names = names.into_iter().take(MAX_NAMES).collect::<Vec<_>>().join(", ");
        let more = if more > 0 { format!(" and {more} more") } else { String::new() };
        TableNote { text: format!("{names}{more}: {}", note.text), ..note.clone() }
    };
    merged.into_iter().map(line).collect()
}

/// Raises the warnings among the notes of a table at once: they concern all of it, whatever is then printed of it.
pub fn raise(job: &mut Job, table: &Table, span: Span) {
    job.verdict.absent += table.absent;
    job.keep_table(table);
    let warnings = table.notes.iter().filter(|note| note.severity == Severity::Warning);
    warnings.for_each(|note| job.warn(note.text.as_str(), span));
}

/// Notes what is computed by a shortcut or is missing and accepted, under the first of some tables.
pub fn note_caveats(model: &Model, tables: &mut [Table]) {
    if let Some(table) = tables.first_mut() {
        table.add_notes(model.caveats());
    }
}

#[cfg(test)]
mod tests {
    use super::TableNote;

    #[test]
    fn remark_on_several_items_is_reported_once_with_all_names() {
        let breaks = || TableNote::warning("it breaks");
        let both = || vec![breaks(), "it is slack".into()];
        let list = [("A".to_string(), both()), ("B".into(), vec![breaks()])];
        let merge_remarks = |list: &[_]| super::merge_remarks(list).iter().map(ToString::to_string).collect::<Vec<_>>();
        assert_eq!(merge_remarks(&list), ["warning: A, B: it breaks", "A: it is slack"]);
        let many: Vec<_> = (1..=10).map(|n| (n.to_string(), both())).collect();
        assert_eq!(merge_remarks(&many)[1], "1, 2, 3, 4, 5, 6, 7, 8 and 2 more: it is slack");
    }
}
