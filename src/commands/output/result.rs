//! `&RESULT`, and `-RESULT` of `STATISTIC` and `EXTREMES`: what is kept of a run, as a column of a study's table.

use crate::commands::{Call, Command, Effect, Job, count};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Cell, Column, Table};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_study::kept::{KeptError, KeptResult};

/// &RESULT.
pub static RESULT: Command = Command { spec: &SPEC, edits: false, run };

const UNIT: OptionSpec =
    OptionSpec::ours("-UNIT", &[ValueSpec::new("UNIT", Kind::Text, "unit of VALUE as text")], "the unit of the value")
        .default("none: a pure number");

const LEAST: OptionSpec = OptionSpec::ours(
    "-LEAST",
    &[],
    "the value is the least of a storm (a clearance, a tension that goes slack): over seeds its distribution is one of minima",
)
.default("it is the largest");

/// -RESULT of the commands that describe columns.
pub(crate) const KEEP: OptionSpec = OptionSpec::ours(
    "-RESULT",
    &[ValueSpec::new("NAME", Kind::Text, "beginning of the results' names, one for each column described")],
    "keeps what is found as results of a study, as &RESULT does",
)
.repeating(1);

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    data: &[
        ValueSpec::new("NAME", Kind::Text, "name of the result: a letter, then letters, digits and _"),
        ValueSpec::new("VALUE", Kind::Number(Dim::None), "the number, in the unit of -UNIT"),
    ],
    options: &[UNIT, LEAST],
    detail: "In a study (windlass study) the result is a column of its table; a row that lacks it has an empty cell. Elsewhere it is \
             printed alone. A name is kept once; two that differ in capitals alone are one. A value that is not finite is an error, so \
             that its case counts as failed. NAME_MIN of STATISTIC is the least of a storm. -RESULT of STATISTIC and EXTREMES keeps what they find.",
    example: "&SET TOP = 412.5\n&RESULT TOP_TENSION %TOP% -UNIT kips",
    ..CommandSpec::new("&RESULT", "keeps a number as a result of a study")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let name = args.word(const { SPEC.word("NAME") }).unwrap_or_default();
    let value = args.number(const { SPEC.number("VALUE") }).unwrap_or(f64::NAN);
    let unit = args.option(&UNIT).and_then(|given| given.word(const { UNIT.word("UNIT") })).unwrap_or_default();
    let span = args.data.first().map_or(args.span, |value| value.span);
    keep(job, name, (value, args.has(&LEAST)), unit, span)?;
    let text = format!("{name} = {value} {unit}");
    Ok(Effect::Say(format!("Result {}", text.trim_end())))
}

/// Keeps a result, a value and whether it is the least of a storm; a wrong one is an error at `span`.
fn keep(job: &mut Job, name: &str, (value, is_least): (f64, bool), unit: &str, span: Span) -> Outcome<()> {
    let refused = |error: KeptError| Diagnostic::error(error.to_string(), span);
    let result = KeptResult::new(name, value, unit).map_err(refused)?;
    job.kept.add(if is_least { result.least() } else { result }).map_err(refused)
}

/// The names that -RESULT gives to the `columns` described; none without it.
///
/// # Errors
/// Another number of names than of columns.
fn given_names<'a>(args: &'a Args, columns: &[String]) -> Outcome<Option<(Vec<&'a str>, &'a Given)>> {
    let Some(given) = args.option(&KEEP) else { return Ok(None) };
    let names: Vec<&str> = given.values.iter().filter_map(|value| value.word()).collect();
    if names.len() != columns.len() {
        let text = format!("-RESULT has {} for {}", count(names.len(), "name"), count(columns.len(), "column"));
        return Err(Diagnostic::error(text, given.span).help(format!("columns: {}", columns.join(", "))));
    }
    Ok(Some((names, given)))
}

/// Keeps what STATISTIC found: NAME_MEAN, NAME_SD, NAME_MIN and NAME_MAX of each column described, in user units. `table` is as it
/// is printed, a row a column.
///
/// # Errors
/// Names that do not fit, and a column without a number.
pub(crate) fn keep_statistics(job: &mut Job, args: &Args, table: &Table) -> Outcome<()> {
    let texts = |name: &str| -> Vec<String> {
        let cells = table.get(name).map_or(&[][..], |column| &column.cells);
        cells.iter().map(|cell| if let Cell::Text(text) = cell { text.clone() } else { String::new() }).collect()
    };
    let columns = texts("Column");
    let Some((names, given)) = given_names(args, &columns)? else { return Ok(()) };
    let units = texts("Unit");
    for (row, (name, unit)) in names.iter().zip(&units).enumerate() {
        for (ending, head) in [("MEAN", "Mean"), ("SD", "Std. Dev."), ("MIN", "Minimum"), ("MAX", "Maximum")] {
            let cell = table.get(head).and_then(|column| column.cells.get(row)).and_then(Cell::number);
            let value = (cell.unwrap_or(f64::NAN), ending == "MIN");
            keep(job, &format!("{name}_{ending}"), value, unit, given.span)?;
        }
    }
    Ok(())
}

/// Keeps what EXTREMES found: NAME_RAYLEIGH, NAME_WEIBULL and NAME_GUMBEL are the most probable values of each way that had enough to
/// go by, in user units, and _LOW and _HIGH of a fit the ends of its 95 per cent interval.
///
/// # Errors
/// Names that do not fit.
pub(crate) fn keep_extremes(job: &mut Job, args: &Args, table: &Table, units: UnitSystem) -> Outcome<()> {
    let probable: Vec<&Column> = table.columns().iter().filter(|column| column.name == "Most Probable").collect();
    let series: Vec<String> = probable.iter().map(|column| column.group.clone()).collect();
    let Some((names, given)) = given_names(args, &series)? else { return Ok(()) };
    let parts = [("", "Most Probable"), ("_LOW", "95% Low"), ("_HIGH", "95% High")];
    for (name, group) in names.iter().zip(&series) {
        for (ending, head) in parts {
            let column = table.columns().iter().find(|c| c.name == head && c.group == *group);
            for (row, method) in ["RAYLEIGH", "WEIBULL", "GUMBEL"].iter().enumerate() {
                let Some(column) = column else { continue };
                let Some(value) = column.cells.get(row).and_then(Cell::number) else { continue };
                let (value, unit) = (column.dim.from_si(value, units), column.dim.label(units));
                keep(job, &format!("{name}_{method}{ending}"), (value, false), &unit, given.span)?;
            }
        }
    }
    Ok(())
}
