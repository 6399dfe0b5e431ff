//! Columns of tables: which word of a row is which quantity, by the names in the table's head.

use crate::row::{Row, Word};
use crate::section::Section;
use windlass_base::diagnostic::{Diagnostic, Outcome};

/// Where a column may be absent.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Presence {
    Required,
    /// The head may lack it; a row under a head that has it may not.
    InHead,
    /// A row may end before it.
    Optional,
}

/// A column: the names decks have for it, the first for messages, and where it may be absent.
pub(crate) struct Column {
    pub(crate) names: &'static [&'static str],
    presence: Presence,
}

/// A column that every row has.
pub(crate) const fn column(names: &'static [&'static str]) -> Column {
    Column { names, presence: Presence::Required }
}

/// A column that a row may end before.
pub(crate) const fn optional(names: &'static [&'static str]) -> Column {
    Column { names, presence: Presence::Optional }
}

/// A column that decks of version 1 or of MoorPy may not have.
pub(crate) const fn newer(names: &'static [&'static str]) -> Column {
    Column { names, presence: Presence::InHead }
}

/// The order of the columns in one table.
pub(crate) struct Layout {
    columns: &'static [Column],
    /// Index of the column for each word of a row.
    order: Vec<usize>,
}

/// The program whose order of columns holds where the names do not, for messages.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(crate) enum Dialect {
    MoorDyn,
    Map,
}

impl Dialect {
    const fn program(self) -> &'static str {
        match self {
            Dialect::MoorDyn => "MoorDyn v2",
            Dialect::Map => "MAP++",
        }
    }
}

/// A column name without what decks write around it: `CG*`, `Cd?`.
fn bare(name: &str) -> &str {
    name.trim_matches(['*', '(', ')', '[', ']'])
}

impl Layout {
    /// The layout of a section. A head with a name that is not known leaves the order of the program, with a
    /// warning, or is an error where its other names have another order; names in another order than the program's are a warning too.
    pub(crate) fn new(
        section: &Section<'_>,
        columns: &'static [Column],
        dialect: Dialect,
        messages: &mut Vec<Diagnostic>,
    ) -> Self {
        let program = dialect.program();
        let mut order = Vec::new();
        for word in &section.columns.words {
            // bodies have Y0 and y0: the first that is still free
            let is_this = |c: &Column| c.names.iter().any(|n| n.eq_ignore_ascii_case(bare(word.value)));
            let found = columns.iter().enumerate().find(|(index, c)| is_this(c) && !order.contains(index));
            match found {
                Some((index, _)) => order.push(index),
                None => {
                    let known = columns.iter().filter_map(|c| c.names.first().copied()).collect::<Vec<_>>().join(" ");
                    let warning = Diagnostic::warning(format!("column {} is not known here", word.value), word.span);
                    let warning = warning.label(format!("columns are read in {program}'s order"));
                    // where the names that are known stand elsewhere than in that order, it is not the order of this table
                    let place = |w: &Word<'_>| {
                        columns.iter().position(|c| c.names.iter().any(|n| n.eq_ignore_ascii_case(bare(w.value))))
                    };
                    let mut named = section.columns.words.iter().enumerate();
                    if named.any(|(index, w)| w.value != "y0" && place(w).is_some_and(|p| p != index)) {
                        let error = Diagnostic::error(format!("column {} is not known here", word.value), word.span);
                        let error = error.label(format!("the other columns are not in {program}'s order"));
                        messages.push(*error.help(format!("known: {known}")));
                        return Layout { columns, order };
                    }
                    messages.push(*warning.help(format!("the order is {known}")));
                    return Layout { columns, order: (0..columns.len()).collect() };
                }
            }
        }
        // names in another order than MoorDyn 2 reads: what is written is taken, and that it differs is said
        let moved = order.windows(2).position(|pair| matches!(pair, [a, b] if a > b));
        if let Some(word) = moved.and_then(|index| section.columns.words.get(index + 1)) {
            let text = format!("columns stand in another order than in {program}");
            let warning = Diagnostic::warning(text, word.span);
            let warning = warning.label("the names are followed");
            let help = format!("{program} skips the names and reads its own order: it gives other answers");
            messages.push(*warning.help(help));
        }
        if order.is_empty() {
            order = (0..columns.len()).collect();
        }
        Layout { columns, order }
    }

    /// The words of a row by column; `None` for optional ones the row does not have.
    ///
    /// # Errors
    /// A row with more words than columns, or without a column that must be there.
    pub(crate) fn place<'a>(&self, row: &Row<'a>) -> Outcome<Vec<Option<Word<'a>>>> {
        let mut placed: Vec<Option<Word<'a>>> = self.columns.iter().map(|_| None).collect();
        if let Some(extra) = row.words.get(self.order.len()) {
            let count = row.words.len();
            let error =
                Diagnostic::error(format!("the row has {count} values for {} columns", self.order.len()), extra.span);
            return Err(error.label("belongs to no column"));
        }
        for (word, &index) in row.words.iter().zip(&self.order) {
            if let Some(slot) = placed.get_mut(index) {
                *slot = Some(word.clone());
            }
        }
        let is_needed = |index: usize, column: &Column| match column.presence {
            Presence::Required => true,
            Presence::InHead => self.order.contains(&index),
            Presence::Optional => false,
        };
        let mut cells = self.columns.iter().zip(&placed).enumerate();
        if let Some((_, (column, _))) =
            cells.find(|(index, (column, word))| word.is_none() && is_needed(*index, column))
        {
            let name = column.names.first().copied().unwrap_or_default();
            return Err(Diagnostic::error(format!("the row has no value for {name}"), row.span)
                .label(format!("expected {name}")));
        }
        Ok(placed)
    }
}
