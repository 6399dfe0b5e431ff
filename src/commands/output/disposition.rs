//! The disposition menu: what can be done with a result.
//!
//! Source: [MOSES-REF disp_men].

use crate::commands::menu;
use crate::commands::name_filter::raise;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::{Disposition, DispositionError, RowChoice};
use crate::report::page;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Cell, Table};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun, Value};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, MenuSpec, Opens, OptionSpec, ValueSpec};

/// Where these commands are offered.
pub(crate) const MENU: &[&MenuSpec] = &[&menu::DISPOSITION];
/// A column of the table.
pub(crate) const COLUMN: ValueSpec =
    ValueSpec::new("COLUMN", Kind::Name(Noun::Selector), "number, a:b, or name with wild characters");
/// -RECORD.
pub(crate) const RECORD: OptionSpec = OptionSpec::new(
    "-RECORD",
    &[
        ValueSpec::new("I", Kind::Integer, "first row, from 1").in_range(1.0, 1e15),
        ValueSpec::new("J", Kind::Integer, "last row").in_range(1.0, 1e15),
    ],
    "rows I to J (row numbers, not times)",
);
/// -VALUES.
pub(crate) const VALUES: OptionSpec = OptionSpec::new(
    "-VALUES",
    &[
        COLUMN,
        ValueSpec::new("MIN", Kind::Number(Dim::None), "smallest value (user units)"),
        ValueSpec::new("MAX", Kind::Number(Dim::None), "largest value (user units)"),
    ],
    "rows whose column lies within bounds",
);
/// -EVENTS of REPORT.
pub(crate) const EVENTS: OptionSpec = OptionSpec::new(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::None), "first event: a time of the first column"),
        ValueSpec::new("END", Kind::Number(Dim::None), "last event").or("the last one"),
        ValueSpec::new("INC", Kind::Number(Dim::None), "from event to event").or("every one").positive(),
    ],
    "rows whose first column lies from BEG to END, in steps of INC",
);
/// -HARD.
pub(crate) const HARD: OptionSpec = OptionSpec::new("-HARD", &[], "to the report file OUT00001.TXT");
/// -BOTH.
pub(crate) const BOTH: OptionSpec = OptionSpec::new("-BOTH", &[], "to the screen and the report file");
/// -WIDE.
pub(crate) const WIDE: OptionSpec = OptionSpec::new(
    "-WIDE",
    &[],
    "as wide as the columns; without it columns that do not fit a terminal go on below, behind the row heads",
)
.owner(Owner::Ours);
/// -DISPOSE.
pub(crate) const DISPOSE: OptionSpec = OptionSpec::new(
    "-DISPOSE",
    &[ValueSpec::new("N", Kind::Integer, "which of its tables").or("1").in_range(1.0, 1e6)],
    "opens the disposition menu over a table instead of printing",
)
.owner(Owner::Ours);
/// -HEADING.
pub(crate) const HEADING: OptionSpec = OptionSpec::new(
    "-HEADING",
    &[ValueSpec::new("TEXT", Kind::Text, "heading, in quotes when it holds blanks")],
    "heading above the output",
);
/// -MAG_USE.
pub(crate) const MAG_USE: OptionSpec = OptionSpec::new("-MAG_USE", &[], "uses absolute values");

const EXAMPLE: &str = "MEDIT\n*P 0 0 0\n~W B_CAT 4 -LEN 4000 -DEP 500\nCONNECTOR A ~W *P\nEND\nCONN_DESIGN\nTABLE A\nREPORT X Force\n\
                       VLIST\nVIEW X 2:4 -RECORD 1 3\nSTORE example.csv\nSTORE example.parquet\nSTORE example.nc\n\
                       PLOT X Force\nPLOT X Force figure.svg\nPLOT X Force page.html\nSTATISTIC X Force -PEAKS\n\
                       SET_VARIABLE TOP 4 -RECORD 30 30\nC_SCALE 0.5 Force\nC_SHIFT 10 X\nCULL Force 0 50 200 300\nEND\nEND\nEND";

/// The spec of a command of this menu.
pub(crate) const fn spec(name: &'static str, help: &'static str) -> CommandSpec {
    CommandSpec { menus: MENU, example: EXAMPLE, ..CommandSpec::new(name, help) }
}

/// REPORT.
pub static REPORT: Command = Command { spec: &REPORT_SPEC, edits: false, run: report };
/// VLIST.
pub static VLIST: Command = Command { spec: &VLIST_SPEC, edits: false, run: vlist };
/// VIEW.
pub static VIEW: Command = Command { spec: &VIEW_SPEC, edits: false, run: view };
/// SET_VARIABLE.
pub static SET_VARIABLE: Command = Command { spec: &SET_VARIABLE_SPEC, edits: false, run: set_variable };
/// C_SCALE.
pub static C_SCALE: Command = Command { spec: &C_SCALE_SPEC, edits: false, run: scale };
/// C_SHIFT.
pub static C_SHIFT: Command = Command { spec: &C_SHIFT_SPEC, edits: false, run: shift };
/// CULL.
pub static CULL: Command = Command { spec: &CULL_SPEC, edits: false, run: cull };

/// The file of STORE.
pub(crate) const STORED: ValueSpec = ValueSpec::new(
    "FILE",
    Kind::File,
    "file name ending in .csv, .xlsx, .parquet or .nc; .csv is added when it has no ending",
)
.or("PPO00001.CSV, PPO00002.CSV ..");
/// A column that may be left out.
pub(crate) const ANY_COLUMN: ValueSpec = COLUMN.or("all columns");
static REPORT_SPEC: CommandSpec = CommandSpec {
    data: &[ANY_COLUMN],
    repeat: 1,
    options: &[RECORD, VALUES, EVENTS, HARD, BOTH, WIDE, HEADING],
    detail: "The formatted report; C_SCALE and C_SHIFT do not act on it. The name of a group of columns, as of LOCATION, VELOCITY and \
             ACCELERATION of a TRAJECTORY, is all of it, after the first column.",
    ..spec("REPORT", "prints the formatted report")
};
static VLIST_SPEC: CommandSpec = spec("VLIST", "lists the columns with their units and ranges");
static VIEW_SPEC: CommandSpec = CommandSpec {
    data: &[ANY_COLUMN],
    repeat: 1,
    options: &[RECORD, VALUES, HARD, BOTH, WIDE, HEADING, MAG_USE],
    detail: "With row numbers and three digits more than the report; C_SCALE and C_SHIFT act.",
    ..spec("VIEW", "shows columns")
};
static SET_VARIABLE_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("VAR", Kind::Text, "global variable"), COLUMN],
    options: &[RECORD, VALUES],
    ..spec("SET_VARIABLE", "puts the values of a column into a variable")
};
static C_SCALE_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("F", Kind::Number(Dim::None), "factor"), COLUMN],
    repeat: 1,
    detail: "Lasts until END; acts on all but REPORT.",
    ..spec("C_SCALE", "multiplies columns by a factor")
};
static C_SHIFT_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("F", Kind::Number(Dim::None), "number to add (user units)"), COLUMN],
    repeat: 1,
    detail: "Lasts until END; acts on all but REPORT.",
    ..spec("C_SHIFT", "adds a number to columns")
};
static CULL_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        COLUMN,
        ValueSpec::new("EXL", Kind::Number(Dim::None), "lower end of a range to exclude (user units)"),
        ValueSpec::new("EXU", Kind::Number(Dim::None), "upper end of that range (user units)"),
    ],
    repeat: 2,
    detail: "Goes by one column: a row whose value, as VIEW shows it (user units, C_SCALE and C_SHIFT applied), lies inside of \
             any of the ranges, ends included, is left out; all others are kept, also those without a value. CULL 1 0 50 \
             200 300 leaves out the rows with column 1 between 0 and 50 or between 200 and 300. Opens an inner disposition \
             menu over the rows kept, which are numbered anew; END returns. The values stay as they came, and C_SCALE and \
             C_SHIFT made so far go on acting in it as before.",
    ..spec("CULL", "leaves out the rows inside of ranges")
};

/// The menu a command works in.
pub(crate) fn open_disposition(job: &Job, span: Span) -> Outcome<&Disposition> {
    match job.menu() {
        Menu::Disposition(d) => Ok(d),
        _ => Err(Diagnostic::error("no result is being disposed of", span)),
    }
}

/// An error of the library at the word it is about, else at the command.
pub(crate) fn to_diagnostic(args: &Args, error: &DispositionError) -> Box<Diagnostic> {
    let named = match error {
        // the last of that name: a file or variable before the columns may have it too
        DispositionError::Column(c) => {
            let given = args.option_if_declared(&VALUES).map_or(&[][..], |g| &g.values);
            args.data.iter().rev().chain(given).find(|v| v.word() == Some(&c.name)).map(|v| v.span)
        }
        DispositionError::Rows { .. } => args.option_if_declared(&RECORD).map(|g| g.span),
        DispositionError::NoRow => args.option_if_declared(&VALUES).map(|g| g.span),
        DispositionError::NoEvent => args.option_if_declared(&EVENTS).map(|g| g.span),
        DispositionError::NotOne { .. } => args.data.first().map(|v| v.span),
        _ => None,
    };
    Diagnostic::error(error.to_string(), named.unwrap_or(args.span)).help("VLIST lists the columns")
}

/// The words among some values.
pub(crate) fn selectors(values: &[Value]) -> Vec<&str> {
    values.iter().filter_map(|v| v.word()).collect()
}

fn rows(args: &Args) -> RowChoice {
    RowChoice {
        record: args.option_if_declared(&RECORD).map(|given| {
            let [from, to] =
                const { [RECORD.integer("I"), RECORD.integer("J")] }.map(|key| given.integer(key).unwrap_or(0));
            (from, to)
        }),
        values: args.option_if_declared(&VALUES).map(|g| {
            let [least, most] = g.numbers_or_zero(const { VALUES.numbers(["MIN", "MAX"]) });
            (g.word(const { VALUES.word("COLUMN") }).unwrap_or_default().to_string(), least, most)
        }),
        from: None,
        events: args.option_if_declared(&EVENTS).and_then(|given| {
            let [begin, end, step] = const { EVENTS.numbers(["BEG", "END", "INC"]) }.map(|key| given.number(key));
            Some((begin?, end, step))
        }),
    }
}

/// The columns that words of a record choose, as a table with scales, shifts and -MAG_USE applied.
pub(crate) fn chosen_columns(job: &Job, args: &Args, columns: &[Value]) -> Outcome<Table> {
    chosen_rows(job, args, columns, &rows(args))
}

/// The same for statistics, which leave the transient of a run out unless -RECORD or -VALUES choose rows; with what is to be said of that.
pub(crate) fn chosen_for_statistics(job: &Job, args: &Args) -> Outcome<(Table, Option<String>)> {
    let chosen = args.has(&RECORD) || args.has(&VALUES);
    let from = open_disposition(job, args.span)?.transient().filter(|_| !chosen);
    let table = chosen_rows(job, args, &args.data, &RowChoice { from, ..rows(args) })?;
    let said =
        from.map(|t| format!("without the transient: rows from TTRA_SET, {t} s, on; -RECORD or -VALUES take others"));
    Ok((table, said))
}

fn chosen_rows(job: &Job, args: &Args, columns: &[Value], rows: &RowChoice) -> Outcome<Table> {
    let d = open_disposition(job, args.span)?;
    let result = d.columns(&selectors(columns)).and_then(|c| d.extract(&c, rows, true, job.units));
    let mut table = result.map_err(|e| to_diagnostic(args, &e))?;
    if args.option_if_declared(&MAG_USE).is_some() {
        table.map_cells(|_, _, cell| match cell {
            Cell::Number(value) => Cell::Number(value.abs()),
            other => other.clone(),
        });
    }
    Ok(table)
}

/// Sends what `layout` makes of a width where -HARD and -BOTH say: to the screen as wide as that is, unless -WIDE, to files as wide as
/// it is.
pub(crate) fn send(job: &mut Job, args: &Args, layout: impl Fn(Option<usize>) -> String) -> Outcome<()> {
    let hard = args.has(&HARD) || args.has(&BOTH);
    let heading = args
        .option_if_declared(&HEADING)
        .and_then(|given| given.first_word())
        .map(|h| format!("{h}\n\n"))
        .unwrap_or_default();
    let layout = |width| format!("{heading}{}", layout(width));
    if hard {
        job.output.hard(&layout(None)).map_err(|e| Diagnostic::error(e.to_string(), args.span))?;
    }
    if !hard || args.has(&BOTH) {
        let wide = args.option_if_declared(&WIDE).is_some();
        job.say_fitted(|width| layout(width.filter(|_| !wide)));
    }
    Ok(())
}

/// Sends the reports of some tables where -HARD, -BOTH and -WIDE say.
pub(crate) fn send_tables(job: &mut Job, args: &Args, tables: &[Table]) -> Outcome<()> {
    job.keep_for_page(tables);
    let (units, head) = (job.units, job.page_head());
    send(job, args, |width| page::render_all(tables, units, &head, width))
}

/// Opens the disposition menu over the one of some tables that -DISPOSE asks for. Statistics of it leave out the instants before
/// `transient` (s); its warnings are raised at `place`. False without the option.
///
/// # Errors
/// There is no table of this number.
pub(crate) fn open_chosen_table(
    job: &mut Job,
    args: &Args,
    tables: &[Table],
    (transient, position): (Option<f64>, Span),
) -> Outcome<bool> {
    let Some(given) = args.option(&DISPOSE) else { return Ok(false) };
    let wanted = given.first_integer().unwrap_or(1);
    let index = usize::try_from(wanted - 1).unwrap_or(0);
    let Some(table) = tables.get(index).cloned() else {
        let text = format!("there is no table {wanted} here: there are {}", tables.len());
        return Err(Diagnostic::error(text, given.span));
    };
    raise(job, &table, position);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table).after_transient(transient))));
    Ok(true)
}

/// Prints some tables where -HARD and -BOTH say, or opens the disposition menu over one of them: [`open_chosen_table`].
///
/// # Errors
/// There is no table of the number of -DISPOSE; the report file cannot be written.
pub(crate) fn print_or_dispose(
    job: &mut Job,
    args: &Args,
    tables: &[Table],
    when: (Option<f64>, Span),
) -> Outcome<Effect> {
    if open_chosen_table(job, args, tables, when)? {
        return Ok(Effect::Done);
    }
    send_tables(job, args, tables)?;
    tables.iter().for_each(|table| raise(job, table, when.1));
    Ok(Effect::Done)
}

fn report(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let d = open_disposition(job, args.span)?;
    let table = d
        .report_columns(&selectors(&args.data))
        .and_then(|c| d.extract(&c, &rows(args), false, job.units))
        .map_err(|e| to_diagnostic(args, &e))?;
    send_tables(job, args, &[table])?;
    Ok(Effect::Done)
}

fn vlist(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let lines = open_disposition(job, call.args.span)?.vlist(job.units).join("\n");
    job.say(&lines);
    Ok(Effect::Done)
}

fn view(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let numbers = {
        let d = open_disposition(job, args.span)?;
        d.rows(&rows(args), job.units).map_err(|e| to_diagnostic(args, &e))?
    };
    let table = chosen_columns(job, args, &args.data)?;
    let units = job.units;
    send(job, args, |width| page::view(&table, &numbers, units, width).join("\n"))?;
    Ok(Effect::Done)
}

/// Writes a file, and says where it went.
pub(crate) fn write_file(job: &mut Job, name: &str, bytes: &[u8], span: Span) -> Outcome<()> {
    let path =
        job.output.folder.write(name, bytes).map_err(|e| crate::commands::files::file::to_diagnostic(&e, span))?;
    let text = format!("wrote {}", path.display());
    job.say(&text);
    Ok(())
}

fn set_variable(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    const VARIABLE: DatumKey<str> = SET_VARIABLE_SPEC.word("VAR");
    let name = args.word(VARIABLE).unwrap_or_default();
    let good = name.len() <= 64 && !name.is_empty() && name.bytes().all(|b| b.is_ascii_alphanumeric() || b == b'_');
    if !good {
        return Err(Diagnostic::error(format!("`{name}` cannot name a variable"), args.position(VARIABLE)));
    }
    let d = open_disposition(job, args.span)?;
    let column = args.word(const { SET_VARIABLE_SPEC.word("COLUMN") }).unwrap_or_default();
    let text = d.values(column, &rows(args), job.units).map_err(|e| to_diagnostic(args, &e))?;
    Ok(Effect::Set(name.to_string(), text))
}

fn adjust(
    job: &mut Job,
    args: &Args,
    change: impl Fn(&mut Disposition, f64, &[&str]) -> Result<Vec<usize>, DispositionError>,
) -> Outcome<Effect> {
    // C_SHIFT names its data alike
    const FACTOR: DatumKey<f64> = C_SCALE_SPEC.number("F");
    let value = args.number(FACTOR).unwrap_or(0.0);
    if let Some(Menu::Disposition(d)) = job.menus.last_mut() {
        change(d, value, &selectors(args.data_after(FACTOR))).map_err(|e| to_diagnostic(args, &e))?;
    }
    Ok(Effect::Done)
}

fn scale(job: &mut Job, call: &Call) -> Outcome<Effect> {
    adjust(job, &call.args, |d, v, s| d.scale(v, s))
}

fn shift(job: &mut Job, call: &Call) -> Outcome<Effect> {
    adjust(job, &call.args, |d, v, s| d.shift(v, s))
}

fn cull(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let mut excluded = Vec::new();
    const COLUMN: DatumKey<str> = CULL_SPEC.word("COLUMN");
    const LOWER: DatumKey<f64> = CULL_SPEC.number("EXL");
    const UPPER: DatumKey<f64> = CULL_SPEC.number("EXU");
    for range in args.groups_from(LOWER) {
        if let (Some(low), Some(high)) = (range.number(LOWER), range.number(UPPER)) {
            if low > high {
                let text = format!("the range from {low} to {high} holds nothing");
                return Err(
                    Diagnostic::error(text, range.position(UPPER)).label("expected no less than the value before it")
                );
            }
            excluded.push((low, high));
        }
    }
    let column = args.word(COLUMN).unwrap_or_default();
    let culled =
        open_disposition(job, args.span)?.cull(column, &excluded, job.units).map_err(|e| to_diagnostic(args, &e))?;
    job.menus.push(Menu::Disposition(Box::new(culled)));
    Ok(Effect::Done)
}
