//! Data of an object by name: what is used, what does nothing here, and what is left over.

use crate::yaml::{Content, Entry, Node};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;

/// A value and its place.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Given<T> {
    /// The value.
    pub value: T,
    /// Its place.
    pub span: Span,
}

/// A finite number, `Infinity` among them where `is_endless`.
fn number(node: &Node, name: &str, is_endless: bool) -> Outcome<Given<f64>> {
    let text = node.text().unwrap_or_default();
    let value = match text {
        "Infinity" if is_endless => Some(f64::INFINITY),
        _ => {
            let is_numeric = text.bytes().all(|b| b.is_ascii_digit() || b"+-.eE".contains(&b));
            text.parse::<f64>().ok().filter(|value| is_numeric && value.is_finite())
        }
    };
    let Some(value) = value else {
        let shown = if text.is_empty() { "a list or nothing" } else { text };
        return Err(Diagnostic::error(format!("{name} is not a number: {shown}"), node.span).label("expected a number"));
    };
    Ok(Given { value, span: node.span })
}

/// The data of one object, and which of them have been asked for.
pub(crate) struct Data<'a> {
    entries: &'a [Entry],
    used: Vec<bool>,
    /// The place of the object.
    pub(crate) span: Span,
}

impl<'a> Data<'a> {
    /// The data of a map.
    ///
    /// # Errors
    /// A node that is none.
    pub(crate) fn new(node: &'a Node, what: &str) -> Outcome<Self> {
        match &node.content {
            Content::Map(entries) => Ok(Data { entries, used: vec![false; entries.len()], span: node.span }),
            _ => Err(Diagnostic::error(format!("{what} is no list of names with values"), node.span)
                .label("expected NAME: VALUE")),
        }
    }

    /// What a name has; none where it is absent.
    pub(crate) fn entry(&mut self, name: &str) -> Option<&'a Entry> {
        let index = self.entries.iter().position(|entry| entry.name == name)?;
        if let Some(used) = self.used.get_mut(index) {
            *used = true;
        }
        self.entries.get(index)
    }

    /// What a name has; none where it is absent or `~`.
    pub(crate) fn node(&mut self, name: &str) -> Option<&'a Node> {
        self.entry(name).map(|entry| &entry.value).filter(|node| !node.is_default())
    }

    /// A number; none where it is absent or `~`.
    pub(crate) fn number(&mut self, name: &str) -> Outcome<Option<Given<f64>>> {
        self.node(name).map(|node| number(node, name, false)).transpose()
    }

    /// A number that is zero or more.
    pub(crate) fn not_negative(&mut self, name: &str) -> Outcome<Option<Given<f64>>> {
        match self.number(name)? {
            Some(given) if given.value < 0.0 => {
                Err(Diagnostic::error(format!("{name} is {}", given.value), given.span).label("must be 0 or more"))
            }
            given => Ok(given),
        }
    }

    /// A number that must be there, greater than zero.
    pub(crate) fn size(&mut self, name: &str, what: &str) -> Outcome<Given<f64>> {
        let Some(given) = self.number(name)? else {
            return Err(Diagnostic::error(format!("{what} has no {name}"), self.span).label(format!("expected {name}")));
        };
        if given.value <= 0.0 {
            return Err(
                Diagnostic::error(format!("{name} is {}", given.value), given.span).label("must be greater than 0")
            );
        }
        Ok(given)
    }

    /// Numbers of a list, or one number; `~` is the default at its place.
    pub(crate) fn numbers<const N: usize>(&mut self, name: &str, defaults: [f64; N]) -> Outcome<[f64; N]> {
        let Some(node) = self.node(name) else { return Ok(defaults) };
        let mut values = defaults;
        let items = match &node.content {
            Content::List(items) => items.as_slice(),
            _ => std::slice::from_ref(node),
        };
        // one number alone stands for the first
        if items.len() > N || (items.len() > 1 && items.len() < N) {
            return Err(Diagnostic::error(format!("{name} has {} values", items.len()), node.span)
                .label(format!("expected {N}")));
        }
        for (value, item) in values.iter_mut().zip(items) {
            if !item.is_default() {
                *value = number(item, name, false)?.value;
            }
        }
        Ok(values)
    }

    /// A word; none where it is absent or `~`.
    pub(crate) fn word(&mut self, name: &str) -> Outcome<Option<Given<&'a str>>> {
        let Some(node) = self.node(name) else { return Ok(None) };
        let text = node.text().ok_or_else(|| Diagnostic::error(format!("{name} is no word"), node.span));
        Ok(Some(Given { value: text?, span: node.span }))
    }

    /// A word that must be one of those that load nothing here.
    ///
    /// # Errors
    /// Another word, for the reason given.
    pub(crate) fn only(&mut self, name: &str, allowed: &[&str], why: &str) -> Outcome<()> {
        match self.word(name)? {
            Some(given) if !allowed.contains(&given.value) => {
                let error = Diagnostic::error(format!("{name} {} is not read: {why}", given.value), given.span);
                Err(error.label(format!("expected {}", allowed.join(" or "))))
            }
            _ => Ok(()),
        }
    }

    /// Numbers that must be zero, or absent.
    ///
    /// # Errors
    /// Another number, for the reason given.
    pub(crate) fn zero(&mut self, name: &str, why: &str) -> Outcome<()> {
        let Some(node) = self.node(name) else { return Ok(()) };
        let items = match &node.content {
            Content::List(items) => items.as_slice(),
            _ => std::slice::from_ref(node),
        };
        for item in items.iter().filter(|item| !item.is_default()) {
            let is_zero = number(item, name, true).is_ok_and(|given| given.value == 0.0);
            if !is_zero {
                let shown = item.text().unwrap_or("a list");
                let error = Diagnostic::error(format!("{name} {shown} is not read: {why}"), item.span);
                return Err(error.label("expected 0"));
            }
        }
        Ok(())
    }

    /// The rows of a table whose columns are the names between commas in its own name, which begins with `first`; each cell by its column.
    pub(crate) fn table(&mut self, first: &str) -> Outcome<Option<Rows<'a>>> {
        let is_this = |entry: &Entry| entry.name.split(',').next().is_some_and(|name| name.trim() == first);
        let Some(index) = self.entries.iter().position(is_this) else { return Ok(None) };
        if let Some(used) = self.used.get_mut(index) {
            *used = true;
        }
        let Some(entry) = self.entries.get(index) else { return Ok(None) };
        let columns: Vec<&str> = entry.name.split(',').map(str::trim).collect();
        let mut rows = Vec::new();
        for item in entry.value.items() {
            let cells: Vec<&Node> = match &item.content {
                Content::List(cells) => cells.iter().collect(),
                _ => vec![item],
            };
            if cells.len() != columns.len() {
                let text = format!("the row has {} values for {} columns", cells.len(), columns.len());
                return Err(Diagnostic::error(text, item.span).label(format!("expected {}", entry.name)));
            }
            rows.push(TableRow { cells, span: item.span });
        }
        Ok(Some(Rows { columns, rows, span: entry.span }))
    }

    /// Whether a list or table of a name holds anything.
    pub(crate) fn refuse_rows(&mut self, first: &str, why: &str) -> Outcome<()> {
        match self.table(first)? {
            Some(rows) if !rows.rows.is_empty() => {
                Err(Diagnostic::error(format!("{first} is not read: {why}"), rows.span))
            }
            _ => Ok(()),
        }
    }

    /// Names that were not asked for.
    pub(crate) fn left(&self) -> Vec<&'a Entry> {
        self.entries.iter().zip(&self.used).filter(|(_, used)| !**used).map(|(entry, _)| entry).collect()
    }
}

/// A table by its columns.
pub(crate) struct Rows<'a> {
    columns: Vec<&'a str>,
    pub(crate) rows: Vec<TableRow<'a>>,
    /// The place of its name.
    pub(crate) span: Span,
}

/// A row of a table.
pub(crate) struct TableRow<'a> {
    cells: Vec<&'a Node>,
    pub(crate) span: Span,
}

impl<'a> Rows<'a> {
    /// Sees that its columns are among those that are read; of others that resemble none it is said that they are not used.
    ///
    /// # Errors
    /// A column that resembles one.
    pub(crate) fn check_columns(&self, known: &[&'static str], messages: &mut Vec<Diagnostic>) -> Outcome<()> {
        for column in self.columns.iter().filter(|column| !known.contains(column)) {
            let text = format!("the column {column} is not used");
            if let Some(help) = suggest(column, known.iter().copied()) {
                return Err(Diagnostic::error(text, self.span).help(help));
            }
            messages.push(*Diagnostic::remark(text, self.span));
        }
        Ok(())
    }

    /// The cell of a row in a column; none where the table lacks the column or the cell is `~`.
    pub(crate) fn node(&self, row: &TableRow<'a>, column: &str) -> Option<&'a Node> {
        let index = self.columns.iter().position(|name| *name == column)?;
        row.cells.get(index).copied().filter(|node| !node.is_default())
    }

    /// A number of a row.
    pub(crate) fn number(&self, row: &TableRow<'a>, column: &str) -> Outcome<Option<Given<f64>>> {
        self.node(row, column).map(|node| number(node, column, false)).transpose()
    }

    /// A number of a row that must be there.
    pub(crate) fn needed(&self, row: &TableRow<'a>, column: &str) -> Outcome<Given<f64>> {
        let lacks =
            || Diagnostic::error(format!("the row has no {column}"), row.span).label(format!("expected {column}"));
        self.number(row, column)?.ok_or_else(lacks)
    }

    /// A word of a row that must be there.
    pub(crate) fn word(&self, row: &TableRow<'a>, column: &str) -> Outcome<Given<&'a str>> {
        let lacks =
            || Diagnostic::error(format!("the row has no {column}"), row.span).label(format!("expected {column}"));
        let node = self.node(row, column).ok_or_else(lacks)?;
        Ok(Given { value: node.text().ok_or_else(lacks)?, span: node.span })
    }
}
