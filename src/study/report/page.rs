//! The report as a document: sections of texts, tables and figures, written as one page of HTML and as Markdown.

use crate::report::embedded::base64;
use crate::report::format;
use crate::report::plot::PlotError;
use minijinja::value::Serde;
use minijinja::{Environment, Value, context};
use serde::Serialize;
use windlass_base::printable::printable;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::{Dim, UnitSystem};

/// The page, and what it takes in.
const PAGE: &str = include_str!("../../../share/study/report.html");
const STYLE: &str = include_str!("../../../share/study/style.css");
const SCRIPT: &str = include_str!("../../../share/study/report.js");
/// What stands in every page and every Markdown file that this program makes.
pub const GENERATOR: &str = "<meta name=\"generator\" content=\"windlass\">";
/// The same of a Markdown file.
pub const MARKDOWN_GENERATOR: &str = "<!-- made by windlass report -->";

/// How a cell or a text is coloured.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Tone {
    /// As it is.
    #[default]
    Plain,
    /// A check that is met.
    Pass,
    /// A check that is met by factors that are not confirmed.
    Unconfirmed,
    /// A check that is not met, a case that has failed.
    Fail,
}

/// A cell of a table.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ReportCell {
    /// What it shows.
    pub text: String,
    /// What it is sorted by, where it is a number.
    pub number: Option<f64>,
    /// Its colour.
    pub tone: Tone,
}

impl ReportCell {
    /// A text.
    pub fn text(text: impl Into<String>) -> Self {
        ReportCell { text: text.into(), ..ReportCell::default() }
    }

    /// A number with so many decimals; empty of none.
    pub fn number(value: Option<f64>, decimals: usize) -> Self {
        let value = value.filter(|value| value.is_finite());
        ReportCell {
            text: value.map(|value| format!("{value:.decimals$}")).unwrap_or_default(),
            number: value,
            tone: Tone::Plain,
        }
    }

    /// A value of SI units as reports have it in the user's; empty of none.
    pub fn quantity(value: Option<f64>, dim: Dim, units: UnitSystem) -> Self {
        let Some(value) = value.filter(|value| value.is_finite()) else { return ReportCell::default() };
        let text = format::report(&Cell::Number(value), dim, Digits::Usual, units);
        ReportCell { text, number: Some(dim.from_si(value, units)), tone: Tone::Plain }
    }

    /// A number as short as it can be with so many figures; empty of none.
    pub fn figures(value: Option<f64>, figures: usize) -> Self {
        let value = value.filter(|value| value.is_finite());
        ReportCell {
            text: value.map(|value| shortest(value, figures)).unwrap_or_default(),
            number: value,
            tone: Tone::Plain,
        }
    }

    /// The same in a colour.
    pub fn toned(self, tone: Tone) -> Self {
        ReportCell { tone, ..self }
    }
}

/// A number with so many significant figures, without the zeros at its end.
pub fn shortest(value: f64, figures: usize) -> String {
    let rounded: f64 = format!("{value:.*e}", figures.saturating_sub(1)).parse().unwrap_or(value);
    let size = rounded.abs();
    if size != 0.0 && !(1e-3..1e9).contains(&size) { format!("{rounded:e}") } else { format!("{rounded}") }
}

/// A table of the report.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct ReportTable {
    /// Heads, with their units.
    pub heads: Vec<String>,
    /// Rows.
    pub rows: Vec<Vec<ReportCell>>,
}

impl ReportTable {
    /// The table without the columns that are empty in every row.
    pub fn without_empty_columns(mut self) -> Self {
        let is_filled = |at: usize| self.rows.iter().any(|row| row.get(at).is_some_and(|cell| !cell.text.is_empty()));
        let filled: Vec<bool> = (0..self.heads.len()).map(is_filled).collect();
        let keeps = |at: usize| filled.get(at).copied().unwrap_or(false);
        let mut at = 0;
        self.heads.retain(|_| {
            at += 1;
            keeps(at - 1)
        });
        for row in &mut self.rows {
            let mut at = 0;
            row.retain(|_| {
                at += 1;
                keeps(at - 1)
            });
        }
        self
    }

    /// A table with these heads.
    pub fn new(heads: &[&str]) -> Self {
        ReportTable { heads: heads.iter().map(|head| (*head).to_owned()).collect(), rows: Vec::new() }
    }
}

/// A figure of the report.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Figure {
    /// Name of its file in the folder beside the Markdown file.
    pub file: String,
    /// What stands below it.
    pub caption: String,
    /// The figure as SVG, in base64.
    data: String,
    #[serde(skip)]
    svg: Vec<u8>,
}

/// A part of a section.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[serde(rename_all = "kebab-case", tag = "kind")]
pub enum Block {
    /// A paragraph.
    Text {
        /// What it says.
        text: String,
        /// Its colour.
        tone: Tone,
    },
    /// A smaller heading.
    Heading {
        /// What it says.
        text: String,
    },
    /// A table.
    Table(ReportTable),
    /// A figure.
    Figure(Figure),
}

/// A section of the report.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Section {
    /// What links lead to.
    pub id: &'static str,
    /// Its heading.
    pub title: &'static str,
    /// Its parts.
    pub blocks: Vec<Block>,
}

impl Section {
    /// A section without parts.
    pub fn new(id: &'static str, title: &'static str) -> Self {
        Section { id, title, blocks: Vec::new() }
    }

    /// Adds a paragraph.
    pub fn say(&mut self, text: impl Into<String>) {
        self.say_in(Tone::Plain, text);
    }

    /// Adds a paragraph in a colour.
    pub fn say_in(&mut self, tone: Tone, text: impl Into<String>) {
        self.blocks.push(Block::Text { text: text.into(), tone });
    }

    /// Adds a smaller heading.
    pub fn head(&mut self, text: impl Into<String>) {
        self.blocks.push(Block::Heading { text: text.into() });
    }

    /// Adds a table, where it has rows.
    pub fn show(&mut self, table: ReportTable) {
        if !table.rows.is_empty() {
            self.blocks.push(Block::Table(table));
        }
    }

    /// Adds a figure; where it cannot be drawn, why.
    pub fn draw(&mut self, file: &str, caption: impl Into<String>, svg: Result<Vec<u8>, PlotError>) {
        let caption = caption.into();
        match svg {
            Ok(svg) => {
                let figure = Figure { file: format!("{file}.svg"), caption, data: base64(&svg), svg };
                self.blocks.push(Block::Figure(figure));
            }
            Err(error) => self.say_in(Tone::Unconfirmed, format!("{caption}: not drawn, {error}")),
        }
    }

    /// Adds a table of a record: its title, facts, rows and notes.
    pub fn show_record(&mut self, table: &Table, units: UnitSystem) {
        self.head(&table.title);
        if !table.facts.is_empty() {
            let mut facts = ReportTable::new(&["What", "Value"]);
            let mut above = "";
            for fact in &table.facts {
                let value = format::report(&fact.value, fact.dim, fact.digits, units);
                let unit = if fact.value.number().is_some() { fact.dim.label(units) } else { String::new() };
                let value = if fact.value == Cell::Missing { "not given".into() } else { format!("{value} {unit}") };
                let name = fact.name.trim();
                // an indented fact belongs to the one above
                let name = match fact.name.starts_with(' ') {
                    true => format!("{above}: {name}"),
                    false => {
                        above = name;
                        name.to_owned()
                    }
                };
                facts.rows.push(vec![ReportCell::text(name), ReportCell::text(value.trim())]);
            }
            self.show(facts);
        }
        let heads = table.columns().iter().map(|column| {
            let name = format!("{} {}", column.group, column.name);
            format::name_with_unit(name.trim(), column.dim, units)
        });
        let cell = |row: usize, column: &windlass_base::table::Column| {
            let cell = column.cells.get(row).unwrap_or(&Cell::Missing);
            let number = cell.number().map(|value| column.dim.from_si(value, units)).filter(|v| v.is_finite());
            ReportCell { text: format::report(cell, column.dim, column.digits, units), number, tone: Tone::Plain }
        };
        let rows = (0..table.rows()).map(|row| table.columns().iter().map(|column| cell(row, column)).collect());
        self.show(ReportTable { heads: heads.collect(), rows: rows.collect() });
        for note in &table.notes {
            self.say(note.to_string());
        }
    }
}

/// A value of SI units as a number of the report's.
pub fn in_units(value: Option<f64>, dim: Dim, units: UnitSystem) -> Option<f64> {
    value.map(|value| dim.from_si(value, units))
}

/// The report.
#[derive(Clone, Debug, Default, PartialEq, Serialize)]
pub struct Report {
    /// Its title.
    pub title: String,
    /// What stands on top of all.
    pub banner: Vec<Block>,
    /// Its sections.
    pub sections: Vec<Section>,
}

impl Report {
    /// The page. All texts are escaped, and nothing is fetched from elsewhere.
    ///
    /// # Errors
    /// What the template library reports.
    pub fn html(&self) -> Result<String, minijinja::Error> {
        let mut env = Environment::new();
        env.add_template("report.html", PAGE)?;
        env.get_template("report.html")?.render(context! {
            report => Value::from(Serde(self)),
            style => Value::from_safe_string(STYLE.to_owned()),
            script => Value::from_safe_string(SCRIPT.to_owned()),
        })
    }

    /// The figures, with the names of their files.
    pub fn figures(&self) -> impl Iterator<Item = (&str, &[u8])> {
        self.sections.iter().flat_map(|section| &section.blocks).filter_map(|block| match block {
            Block::Figure(figure) => Some((figure.file.as_str(), figure.svg.as_slice())),
            _ => None,
        })
    }

    /// The report as Markdown, its figures in a folder beside it.
    pub fn markdown(&self, folder: &str) -> String {
        let mut text = format!("{MARKDOWN_GENERATOR}\n\n# {}\n", escape(&self.title));
        for block in &self.banner {
            push_block(&mut text, block, folder);
        }
        for section in &self.sections {
            text.push_str(&format!("\n## {}\n", section.title));
            for block in &section.blocks {
                push_block(&mut text, block, folder);
            }
        }
        text
    }
}

fn push_block(text: &mut String, block: &Block, folder: &str) {
    text.push('\n');
    match block {
        Block::Text { text: said, tone } => {
            let said = escape(said);
            text.push_str(&if *tone == Tone::Plain { said } else { format!("**{said}**") });
            text.push('\n');
        }
        Block::Heading { text: said } => text.push_str(&format!("### {}\n", escape(said))),
        Block::Figure(figure) => {
            let place = percent_encode(&format!("{folder}/{}", figure.file));
            text.push_str(&format!("![{}]({place})\n\n{0}\n", escape(&figure.caption)));
        }
        Block::Table(table) => {
            let line =
                |cells: &mut dyn Iterator<Item = String>| format!("| {} |\n", cells.collect::<Vec<_>>().join(" | "));
            text.push_str(&line(&mut table.heads.iter().map(|head| escape(head))));
            let is_number = |at: usize| table.rows.iter().any(|row| row.get(at).is_some_and(|c| c.number.is_some()));
            let rules = (0..table.heads.len()).map(|at| if is_number(at) { "---:" } else { "---" }.to_owned());
            text.push_str(&line(&mut { rules }));
            for row in &table.rows {
                text.push_str(&line(&mut row.iter().map(|cell| escape(&cell.text))));
            }
        }
    }
}

/// A path as a link has it (RFC 3986, section 2.1).
fn percent_encode(path: &str) -> String {
    let mut made = String::with_capacity(path.len());
    for byte in path.bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'/' | b'.' | b'-' | b'_' | b'~' => made.push(char::from(byte)),
            other => made.push_str(&format!("%{other:02X}")),
        }
    }
    made
}

/// Text that Markdown takes as it is, on one line.
fn escape(text: &str) -> String {
    let mut made = String::with_capacity(text.len());
    for letter in printable(text).chars() {
        match letter {
            '\\' | '`' | '*' | '_' | '[' | ']' | '|' | '#' | '~' => made.extend(['\\', letter]),
            '<' => made.push_str("&lt;"),
            '>' => made.push_str("&gt;"),
            '&' => made.push_str("&amp;"),
            '\n' | '\t' => made.push(' '),
            other => made.push(other),
        }
    }
    made
}
