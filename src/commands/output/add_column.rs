//! ADD_COLUMN of the disposition menu: a column made of others.
//!
//! Source: [MOSES-RUNS how_to/rp2sk], which shows both options; what the mean does is our reading.

use crate::commands::output::disposition::{COLUMN, open_disposition, spec, to_diagnostic};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::{Disposition, RowChoice};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::table::{Cell, Column, Digits};
use windlass_base::units::Dim;
use windlass_base::values::{Given, Value};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_signal::band_filter::remove_periods;

/// ADD_COLUMN.
pub static ADD_COLUMN: Command = Command { spec: &SPEC, edits: false, run };

choices! {
    /// What the bands of -FILTER are of.
    enum BandOf {
        Period = "PERIOD",
    }
}

const COMBINE: OptionSpec = OptionSpec::new(
    "-COMBINE",
    &[
        ValueSpec::new("COLUMN", Kind::Item, "number or name of a column"),
        ValueSpec::new("F", Kind::Number(Dim::None), "its factor"),
    ],
    "the sum of columns, each times its factor",
)
.repeating(2);
const FILTER: OptionSpec = OptionSpec::new(
    "-FILTER",
    &[
        ValueSpec::choice::<BandOf>("BY", "what the bands are of"),
        ValueSpec { name: "TIME", ..COLUMN },
        ValueSpec { name: "SIGNAL", ..COLUMN },
        ValueSpec::new("T1", Kind::Number(Dim::Time), "lower end of a band of periods that is removed").not_negative(),
        ValueSpec::new("T2", Kind::Number(Dim::Time), "upper end of that band").positive(),
    ],
    "a column of a signal (the second one named) over a column of time (the first) without its periods in bands",
)
.repeating(2);

static SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("NAME", Kind::Text, "name of the new column")],
    options: &[COMBINE, FILTER],
    detail: "Puts a column behind the others, until END. -COMBINE 5 1 23 -1 is column 5 less column 23; columns of unlike units are combined by \
             their numbers in user units. -FILTER PERIOD 1 5 30 1E5 is column 5 over the times of column 1 without its Fourier components of \
             periods from 30 to 1E5 s: sines that fit the record whole are kept or removed exactly, others leak at its ends. The mean has no period and \
             stays (our reading). Times that are not uniform are interpolated at their mean step. C_SCALE and C_SHIFT made so far act on what is taken.",
    example: "&BUILDG -CSV\nTime (s),Tension (kips)\n0,100\n1,121\n2,132\n3,127\n4,108\n5,91\n6,78\n7,83\nEND\n\
              ADD_COLUMN HIGH -FILTER PERIOD 1 2 5 1E5\nADD_COLUMN LOW -COMBINE 2 1 3 -1\nVIEW\nSTATISTIC Time HIGH LOW\nEND",
    ..spec("ADD_COLUMN", "puts a column made of others behind them")
};

const NAME: DatumKey<str> = SPEC.word("NAME");

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (name, position) = (args.word(NAME).unwrap_or_default().to_string(), args.position(NAME));
    let d = open_disposition(job, args.span)?;
    if name.is_empty() || d.table.columns().iter().any(|c| c.name.eq_ignore_ascii_case(&name)) {
        return Err(Diagnostic::error(format!("there is a column called {name} already"), position));
    }
    if name.bytes().all(|b| b.is_ascii_digit() || b == b':') {
        return Err(Diagnostic::error(format!("`{name}` would be the number of a column"), position));
    }
    let (column, said) = match (args.option(&COMBINE), args.option(&FILTER)) {
        (Some(_), Some(second)) => {
            return Err(Diagnostic::error("-COMBINE and -FILTER make a column each", second.span));
        }
        (Some(given), None) => (combine_columns(job, d, &name, given, call)?, None),
        (None, Some(given)) => filter_column(job, d, &name, given, call)?,
        (None, None) => {
            return Err(Diagnostic::error("ADD_COLUMN lacks -COMBINE or -FILTER", args.span));
        }
    };
    if let Some(text) = said {
        job.remark(text, args.span);
    }
    if let Some(Menu::Disposition(d)) = job.menus.last_mut() {
        d.add_column(column);
    }
    Ok(Effect::Done)
}

/// One column of numbers that a word chooses, with C_SCALE and C_SHIFT applied.
fn choose_column(job: &Job, d: &Disposition, value: &Value, call: &Call) -> Outcome<Column> {
    let word = value.word().unwrap_or_default();
    let found =
        d.numeric(&[word]).map_err(|e| Diagnostic::error(e.to_string(), value.span).help("VLIST lists the columns"))?;
    let [index] = found.as_slice() else {
        return Err(Diagnostic::error(format!("{word} names {} columns: one is needed", found.len()), value.span));
    };
    let table =
        d.extract(&[*index], &RowChoice::default(), true, job.units).map_err(|e| to_diagnostic(&call.args, &e))?;
    let lost = || Diagnostic::error(format!("no column is called {word}"), value.span);
    table.columns().first().cloned().ok_or_else(lost)
}

fn combine_columns(job: &Job, d: &Disposition, name: &str, given: &Given, call: &Call) -> Outcome<Column> {
    let mut parts = Vec::new();
    for pair in given.groups() {
        let Some(column) = pair.value(const { COMBINE.word("COLUMN") }) else { continue };
        let factor = pair.number(const { COMBINE.number("F") }).unwrap_or(0.0);
        parts.push((choose_column(job, d, column, call)?, factor));
    }
    let dim = parts.first().map_or(Dim::None, |(column, _)| column.dim);
    let dim = if parts.iter().all(|(column, _)| column.dim == dim) { dim } else { Dim::None };
    let number = |column: &Column, row: usize| {
        let value = column.cells.get(row).and_then(Cell::number)?;
        Some(if dim == column.dim { value } else { column.dim.from_si(value, job.units) })
    };
    let sum =
        |row: usize| parts.iter().try_fold(0.0, |sum, (column, factor)| Some(sum + factor * number(column, row)?));
    let cells: Vec<Cell> = (0..d.table.rows()).map(|row| sum(row).map_or(Cell::Missing, Cell::Number)).collect();
    let digits = parts.first().filter(|(column, _)| column.dim == dim).map_or(SIX_DIGITS, |(column, _)| column.digits);
    Ok(Column::new("", name, dim, digits, cells))
}

/// Digits of numbers of unlike units.
const SIX_DIGITS: Digits = Digits::Scientific(6);

fn filter_column(
    job: &Job,
    d: &Disposition,
    name: &str,
    given: &Given,
    call: &Call,
) -> Outcome<(Column, Option<&'static str>)> {
    let columns = const { [FILTER.word("TIME"), FILTER.word("SIGNAL")] };
    let [Some(time), Some(signal)] = columns.map(|key| given.value(key)) else {
        return Err(Diagnostic::error("-FILTER takes a column of time, one of a signal, and a band", given.span));
    };
    let (times, column) = (choose_column(job, d, time, call)?, choose_column(job, d, signal, call)?);
    if !matches!(times.dim, Dim::Time | Dim::None) {
        return Err(Diagnostic::error(format!("column {} is no time", times.name), time.span));
    }
    let mut list = Vec::new();
    for band in given.groups() {
        const UPPER: ValueKey<f64> = FILTER.number("T2");
        let [from, to] = band.numbers_or_zero([const { FILTER.number("T1") }, UPPER]);
        if from > to {
            let text = format!("the band from {from} to {to} s holds nothing");
            return Err(Diagnostic::error(text, band.position(UPPER)));
        }
        list.push([from, to]);
    }
    let numbers = |column: &Column, span: Span| -> Outcome<Vec<f64>> {
        let value = |(row, cell): (usize, &Cell)| {
            let missing = || Diagnostic::error(format!("column {} has no value in row {}", column.name, row + 1), span);
            cell.number().ok_or_else(missing)
        };
        column.cells.iter().enumerate().map(value).collect::<Result<Vec<f64>, _>>()
    };
    let (times, values) = (numbers(&times, time.span)?, numbers(&column, signal.span)?);
    let made = remove_periods(&times, &values, &list).map_err(|e| Diagnostic::error(e.to_string(), given.span));
    let (values, resampled) = made?;
    let said = resampled.then_some("the times are not uniform: the signal was interpolated at their mean step");
    let cells: Vec<Cell> = values.into_iter().map(Cell::Number).collect();
    Ok((Column::new("", name, column.dim, column.digits, cells), said))
}
