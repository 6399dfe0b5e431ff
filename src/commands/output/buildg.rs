//! `&BUILDG`: a table from records or a file, for the disposition menu.
//!
//! Source: [MOSES-REF men_buildg]. A file behind the option is ours.

use crate::commands::menu;
use crate::commands::settings::device::{read_input, readable};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use crate::report::readback::{self, TableReadError};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_language::record::Record;
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};

/// &BUILDG.
pub static BUILDG: Command = Command { spec: &SPEC, edits: false, run };

const FILE: ValueSpec = ValueSpec::new("FILE", Kind::File, "file name").or("the records that follow, up to END");

const CSV: OptionSpec =
    OptionSpec::new("-CSV", &[FILE], "a line of heads, then rows, parted by commas or blanks, up to END");
const BRIEF: OptionSpec =
    OptionSpec::new("-BRIEF", &[FILE], "labels, one a line, a blank line, then rows of numbers up to a blank line");

static SPEC: CommandSpec = CommandSpec {
    opens: Opens::AtMostElse(&menu::BUILDG, 1, &menu::DISPOSITION),
    options: &[CSV, BRIEF],
    detail: "With a FILE it reads that and opens the disposition menu; without one the records that follow are the table, and \
             END opens the menu. A head that ends in a unit in parentheses, as STORE writes it, gives its column that unit, \
             whatever units are in force. With -CSV a first line of nothing but numbers is a row; with -BRIEF the rows begin \
             with the first line of nothing but numbers, their values parted by blanks or commas; a blank line behind them ends the table and opens the menu, \
             as END does. With -CSV a line without a comma is parted by its blanks, a unit in parentheses going with the word before it. Records that begin with & \
             act as elsewhere: &INSERT reads rows from a file. FILE is looked for as by &FILE USE.",
    example: "&BUILDG -CSV\nTime (s),Tension (kips)\n0,100\n1,120\n2,90\nEND\nVLIST\nSTORE rows.csv\nEND\n&BUILDG -CSV rows.csv\nVIEW\nEND\n\
              &BUILDG -BRIEF\nTime (s)\nHeave (ft)\n\n0 1.5\n1 -1.5\n\nVIEW\nEND",
    ..CommandSpec::new("&BUILDG", "reads a table for the disposition menu")
};

/// A table being given by records.
#[derive(Clone, Debug)]
pub struct Building {
    /// Whether labels stand one a line.
    brief: bool,
    /// Whether a line of nothing but numbers was among them.
    has_rows: bool,
    /// The records so far.
    text: String,
    /// Where it began.
    span: Span,
}

impl Building {
    /// Whether labels stand one a line, and a blank line ends the rows.
    pub fn is_brief(&self) -> bool {
        self.brief
    }

    /// Whether its rows have begun.
    pub fn has_rows(&self) -> bool {
        self.has_rows
    }
}

/// Largest table given by records or a file (bytes).
const MAX_TABLE_BYTES: u64 = 256 << 20;

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let [given] = args.options.as_slice() else {
        return Err(Diagnostic::error("&BUILDG asks for -CSV or -BRIEF", args.span)
            .help("form: &BUILDG -CSV [FILE] or &BUILDG -BRIEF [FILE]"));
    };
    let brief = given.is(&BRIEF);
    let Some(file) = given.values.first() else {
        job.menus.push(Menu::Building(Box::new(Building {
            brief,
            has_rows: false,
            text: String::new(),
            span: args.span,
        })));
        return Ok(Effect::Done);
    };
    let name = file.word().unwrap_or_default();
    let path = readable(job, name, file.span)?;
    let at = |e: std::io::Error| Diagnostic::error(format!("{}: {e}", path.display()), file.span);
    let text = String::from_utf8(read_input(job, &path, MAX_TABLE_BYTES).map_err(at)?)
        .map_err(|e| Diagnostic::error(format!("{}: {e}", path.display()), file.span))?;
    open(job, brief, name, &text).map_err(|e| Diagnostic::error(format!("{name}: {e}"), file.span))?;
    Ok(Effect::Done)
}

/// Takes a record as a line of the table being built.
///
/// # Errors
/// A table that grows too large.
pub fn take(job: &mut Job, record: &Record) -> Outcome<Effect> {
    if let Some(Menu::Building(building)) = job.menus.last_mut() {
        let line = record.text().trim();
        if (building.text.len() + line.len()) as u64 > MAX_TABLE_BYTES {
            return Err(Diagnostic::error("the table grows too large", record.whole()));
        }
        let mut words = line.split([' ', '\t', ',']).filter(|word| !word.is_empty());
        building.has_rows |= !line.is_empty() && words.all(|word| word.parse::<f64>().is_ok());
        building.text.push_str(line);
        building.text.push('\n');
    }
    Ok(Effect::Done)
}

/// Opens the disposition menu over the table that has been given, at its END.
///
/// # Errors
/// Records that make no table; what follows up to another END is then passed over.
pub fn open_built_table(job: &mut Job, building: &Building, at: Option<Span>) -> Outcome<()> {
    open(job, building.brief, "the Table Given", &building.text).map_err(|e| {
        job.menus.push(Menu::Refused(&menu::DISPOSITION));
        Diagnostic::error(format!("the records of &BUILDG make no table: {e}"), at.unwrap_or(building.span))
            .other(building.span, "begun here")
            .help("lines are counted from the record after &BUILDG")
    })
}

fn open(job: &mut Job, brief: bool, name: &str, text: &str) -> Result<(), TableReadError> {
    let table = if brief { readback::brief(name, text) } else { readback::csv(name, text) }?;
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
    Ok(())
}
