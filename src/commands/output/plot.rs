//! PLOT: columns of a result against one of them, in the terminal or as a file.

use crate::commands::output::disposition::{
    ANY_COLUMN, COLUMN, HEADING, MAG_USE, RECORD, VALUES, chosen_columns, open_disposition, selectors, spec,
    to_diagnostic, write_file,
};
use crate::commands::{Call, Command, Effect, Job};
use crate::report::plot::{Chart, PlotError, PlotSeries, PlotSize};
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Content, Value};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};

/// PLOT.
pub static PLOT: Command = Command { spec: &SPEC, edits: false, run };

/// Endings of a last word that is taken for a file.
const ENDINGS: [&str; 3] = [".svg", ".png", ".html"];

const NO: OptionSpec = OptionSpec::new("-NO", &[], "nothing is asked before plotting").without_effect();
const HARD: OptionSpec = OptionSpec::new("-HARD", &[], "to the next figure file, FIGUREn.svg");
const FILE: OptionSpec = OptionSpec::new(
    "-FILE",
    &[ValueSpec::new("FILE", Kind::File, "file name ending in .svg, .png or .html")],
    "to a file",
)
.owner(Owner::Ours);
const HTML: OptionSpec =
    OptionSpec::new("-HTML", &[], "to the next figure file, FIGUREn.html: a page that shows values and zooms")
        .owner(Owner::Ours);
const RAX: OptionSpec = OptionSpec::new("-RAX", &[COLUMN], "columns on the right axis")
    .repeating(1)
    .owner(Owner::Ours)
    .default("columns of another unit than the first one's");
const POLAR: OptionSpec =
    OptionSpec::new("-POLAR", &[], "a polar plot: the first column holds directions").owner(Owner::Ours);

const EQUAL: OptionSpec = OptionSpec::new(
    "-EQUAL",
    &[ValueSpec::choice::<YesNo>("YES/NO", "whether both axes have one scale").or("YES")],
    "one scale for both axes",
)
.owner(Owner::Ours)
.default("YES where both are lengths of which one is at most five times the other");
const INTACT: OptionSpec = OptionSpec::new(
    "-INTACT",
    &[ValueSpec::choice::<YesNo>("YES/NO", "whether the intact mooring is drawn beside").or("YES")],
    "the curves of the intact mooring beside those with lines removed",
)
.owner(Owner::Ours)
.default("YES where the table has them");

const PIXELS: OptionSpec = OptionSpec::new(
    "-PIXELS",
    &[
        ValueSpec::new("WIDTH", Kind::Integer, "width of the plot (pixels)").in_range(300.0, 4000.0),
        ValueSpec::new("HEIGHT", Kind::Integer, "height without the legend (pixels)")
            .in_range(200.0, 4000.0)
            .or("2/3 of WIDTH"),
    ],
    "size of a plot in an .svg or .png file",
)
.owner(Owner::Ours)
.default("900 600");

static SPEC: CommandSpec = CommandSpec {
    data: &[COLUMN, COLUMN, ANY_COLUMN],
    repeat: 1,
    options: &[RECORD, VALUES, HEADING, MAG_USE, NO, HARD, FILE, HTML, RAX, POLAR, EQUAL, INTACT, PIXELS],
    detail: "The first column is the independent one. A last word that ends in .svg, .png or .html is a file name, inside the \
             job's folder when relative (&HELP &FILE); without one the plot is drawn in the terminal. Columns of a second unit have an \
             axis of their own on the right; more than two units on one plot are refused. A page (.html) needs nothing from elsewhere: it shows \
             the values under the pointer, zooms where one drags, and hides a curve whose name is clicked. -POLAR counts \
             directions from +X, to the right, toward +Y, up, and has the other columns as distances from the middle, all of one unit. \
             Lengths over lengths are drawn to one scale (-EQUAL). Where the table is of a mooring with lines removed, the intact one is drawn beside it (-INTACT).",
    ..spec("PLOT", "plots columns against the first one")
};

/// The file a record asks for; `None` for the terminal. A name among the data is taken from them.
fn file(job: &mut Job, args: &mut Args) -> Option<String> {
    let given = args.option(&FILE).and_then(|g| g.values.first()).and_then(Value::word).map(str::to_string);
    let is_file = |w: &str| ENDINGS.iter().any(|e| w.to_ascii_lowercase().ends_with(e));
    if given.is_some() {
        return given;
    }
    if args.data.last().and_then(Value::word).is_some_and(is_file) {
        return args.data.pop().and_then(|v| v.word().map(str::to_string));
    }
    let ending = if args.has(&HTML) { "html" } else { "svg" };
    (args.has(&HARD) || args.has(&HTML))
        .then(|| format!("{}{}.{ending}", job.settings.figure_name, job.settings.figure_number))
}

/// Whether all columns of a table are lengths.
fn has_lengths_alone(table: &Table) -> bool {
    table.columns().iter().all(|c| c.dim == Dim::Length)
}

/// Adds the curves of the intact mooring: for each column drawn, the one of the same name behind `Intact`, over that of the independent
/// column where it has one.
fn add_intact(job: &Job, args: &Args, table: &Table, chart: &mut Chart) -> Outcome<()> {
    let names: Vec<String> = table.columns().iter().map(|c| c.name.clone()).collect();
    let Some((x, ys)) = names.split_first() else { return Ok(()) };
    let menu = open_disposition(job, args.span)?;
    let intact = |name: &str| format!("Intact {name}");
    let has = |name: &str| menu.table.columns().iter().any(|c| c.name == intact(name));
    let over = if has(x) { intact(x) } else { x.clone() };
    let wanted: Vec<String> = ys.iter().filter(|y| has(y) && !names.contains(&intact(y))).map(|y| intact(y)).collect();
    for column in wanted {
        let columns = [&over, &column]
            .map(|name| Value { content: Content::Word(name.as_str().into()), ..Value::empty(args.span) });
        let pair = chosen_columns(job, args, &columns)?;
        let made = if chart.polar { Chart::polar(&pair, job.units) } else { Chart::from_table(&pair, job.units) };
        if let Ok(made) = made {
            chart.series.extend(made.series.into_iter().map(|series| PlotSeries { name: column.clone(), ..series }));
        }
    }
    Ok(())
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let mut args = call.args.clone();
    let name = file(job, &mut args);
    let numbered = name.is_some() && args.option(&FILE).is_none() && args.data.len() == call.args.data.len();
    // the columns of -RAX are columns as the others are, behind them
    let on_right = args.option(&RAX).cloned();
    args.data.extend(on_right.iter().flat_map(|g| g.values.iter().cloned()));
    let menu = open_disposition(job, args.span)?;
    let numbers = menu.numeric(&selectors(&args.data)).map_err(|e| to_diagnostic(&args, &e))?;
    if numbers.len() < 2 {
        return Err(Diagnostic::error("a plot needs the independent column and at least one more", args.span)
            .help("VLIST lists the columns"));
    }
    let right = match &on_right {
        Some(given) => menu.numeric(&selectors(&given.values)).map_err(|e| to_diagnostic(&args, &e))?,
        None => Vec::new(),
    };
    // places in the table of the chosen columns
    let right: Vec<usize> = numbers.iter().enumerate().filter(|(_, n)| right.contains(n)).map(|(at, _)| at).collect();
    let table = chosen_columns(job, &args, &args.data)?;
    let wrong = |e: PlotError| Diagnostic::error(e.to_string(), on_right.as_ref().map_or(args.span, |g| g.span));
    let made =
        if args.has(&POLAR) { Chart::polar(&table, job.units) } else { Chart::with_right(&table, &right, job.units) };
    let mut chart = made.map_err(wrong)?;
    if args.switch(&INTACT, true) && right.is_empty() {
        add_intact(job, &args, &table, &mut chart)?;
    }
    let is_drawn_to_scale = !chart.polar && has_lengths_alone(&table) && chart.has_similar_sides();
    chart.equal = args.switch(&EQUAL, is_drawn_to_scale) && !chart.polar;
    if let Some(heading) = args.option_word(&HEADING) {
        chart.title = heading.to_string();
    }
    if let Some(given) = args.option(&PIXELS) {
        let pixels = |key| given.integer(key).and_then(|n| u32::try_from(n).ok());
        let width = pixels(const { PIXELS.integer("WIDTH") }).unwrap_or(chart.size.width);
        let height = pixels(const { PIXELS.integer("HEIGHT") }).unwrap_or(width * 2 / 3);
        chart.size = PlotSize { width, height };
    }
    match name {
        Some(name) => {
            let bytes = chart.file(&name).map_err(wrong)?;
            write_file(job, &name, &bytes, args.span)?;
            job.settings.figure_number += i64::from(numbered);
        }
        None => {
            let (columns, lines) = job.plot_size();
            let text = chart.terminal(columns, lines).map_err(wrong)?;
            job.say(&text);
        }
    }
    Ok(Effect::Done)
}
