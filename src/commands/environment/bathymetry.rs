//! `&BATHYMETRY`: the bottom over a grid, by records or from a file.

use crate::commands::files::number_rows::rows;
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job, Menu};
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::Value;
use windlass_language::args;
use windlass_language::name as rule;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, TextForm, ValueSpec};
use windlass_model::bathymetry::{Bathymetry, MAX_GRID_POINTS, fits};
use windlass_model::{EntityKind, Model};

/// &BATHYMETRY.
pub static BATHYMETRY: Command = Command { spec: &SPEC, edits: false, run };
/// X within `&BATHYMETRY`.
pub static X: Command = Command { spec: &X_SPEC, edits: false, run: |job, call| record(job, call, &X_WORDS, columns) };
/// Y within `&BATHYMETRY`.
pub static Y: Command = Command { spec: &Y_SPEC, edits: false, run: |job, call| record(job, call, &Y_WORDS, row) };

const fn length(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Length), help)
}

const CSV: OptionSpec = OptionSpec::new(
    "-CSV",
    &[ValueSpec::new("FILE", Kind::File, "file of rows x, y, z; looked for where it says, then beside the script")],
    "reads the points from a file instead of records",
);
const DEPTHS: OptionSpec = OptionSpec::new("-DEPTHS", &[], "heights are depths below z = 0, positive downward")
    .default("elevations, global z, negative below the mean level");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    opens: Opens::WithoutOption(&menu::BATHYMETRY, &CSV),
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the bottom, for -BATHYMETRY of &ENV")],
    options: &[CSV, DEPTHS],
    detail: "The bottom as heights over a grid of x and y in global axes, whose spacing may vary. By records: X has the places of the columns, \
             then each Y a place and the heights along it, one for each X, and END makes the grid; places grow. With -CSV the points may stand in \
             any order, a line each, and a line of heads may come first; every x has one point at every y. All are in the units in force. Between the points \
             the bottom is bicubic (Hermite), with slopes of the parabola through a point and its neighbours: height and slope have no jump, and what is \
             quadratic in x and in y is met exactly; beside a step it overshoots, as smooth surfaces do, so give points there. Beyond its edges the bottom \
             has the height of the edge. z = 0 is the mean level without tide. At most 4000000 points are taken. A name given again is redefined. \
             &STATUS BATHYMETRY shows it, and -BATHYMETRY of &ENV puts it in force.",
    example: "&BATHYMETRY SLOPE -DEPTHS\nX 0 1000 2000\nY 0 300 350 420\nY 1500 310 365 430\nEND\n&ENV -DEPTH 350 -BATHYMETRY SLOPE\n\
              &STATUS BATHYMETRY\n&FILE OPEN G grid.csv\n&FILE WRITE G x,y,z\n&FILE WRITE G 0,0,-300\n&FILE WRITE G 500,0,-310\n\
              &FILE WRITE G 0,500,-305\n&FILE WRITE G 500,500,-316\n&FILE CLOSE G\n&BATHYMETRY FILED -CSV job.ans/grid.csv",
    ..CommandSpec::new("&BATHYMETRY", "defines a bottom over a grid, up to END")
};

static X_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::BATHYMETRY],
    form: TextForm::Text,
    data: &[length("x", "place of a column, growing")],
    repeat: 1,
    detail: "Several X records before the first Y continue each other.",
    example: "&BATHYMETRY SLOPE\nX 0 100\nX 200\nY 0 -30 -35 -42\nY 150 -31 -36 -43\nEND",
    ..CommandSpec::new("X", "places of the columns of a bottom")
};

static Y_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::BATHYMETRY],
    form: TextForm::Text,
    data: &[length("y", "place of the row, growing from record to record"), length("z", "height at each X in turn")],
    repeat: 1,
    detail: "As many heights as there are X: a record goes on after a \\ at its end. With -DEPTHS of &BATHYMETRY they are depths.",
    example: "&BATHYMETRY SLOPE\nX 0 100\nY 0 -30 -35\nY 150 -31 \\\n -36\nEND",
    ..CommandSpec::new("Y", "a row of a bottom")
};

/// What is behind X and Y: read here and not before, so that a record that is refused is known of.
static X_WORDS: CommandSpec = CommandSpec { form: TextForm::Words, ..X_SPEC };
static Y_WORDS: CommandSpec = CommandSpec { form: TextForm::Words, ..Y_SPEC };

/// Rows of a bottom on their way to a grid.
#[derive(Clone, Debug)]
pub struct Soundings {
    name: String,
    /// 1 for elevations, -1 for depths.
    sign: f64,
    x: Vec<f64>,
    y: Vec<f64>,
    heights: Vec<f64>,
    /// The first record that was refused.
    refused: Option<Span>,
    span: Span,
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    const NAME: DatumKey<str> = SPEC.word("NAME");
    let (name, span) = (args.word(NAME).unwrap_or_default(), args.position(NAME));
    rule::check(name, None, "bathymetry", span)?;
    job.model.free_name(name, &[EntityKind::Bathymetry], span)?;
    let sign = if args.has(&DEPTHS) { -1.0 } else { 1.0 };
    let Some(file) = args.option(&CSV).and_then(|given| given.values.first()) else {
        let (x, y, heights) = Default::default();
        let begun = Soundings { name: name.to_string(), sign, x, y, heights, refused: None, span };
        job.menus.push(Menu::Soundings(Box::new(begun)));
        return Ok(Effect::Done);
    };
    let read = rows::<3>(job, (file.word().unwrap_or_default(), file.span), "x, y, z", MAX_GRID_POINTS)?;
    let si = |v: f64| Dim::Length.to_si(v, job.units);
    let points = read.into_iter().map(|(_, [x, y, z])| [si(x), si(y), sign * si(z)]).collect();
    let made = Bathymetry::from_points(name, points, span);
    keep(job, made.map_err(|e| e.with_span(file.span).diagnostic(file.span, job.units))?);
    Ok(Effect::Done)
}

fn keep(job: &mut Job, made: Bathymetry) {
    let (name, span) = (made.name.clone(), made.span);
    if job.model.bathymetries.insert(Model::key(&name), Arc::new(made)).is_some() {
        job.remark(format!("bathymetry {name} is redefined"), span);
    }
}

/// Takes a record of the menu; one that is refused spoils the grid, which would have a hole without it.
fn record(
    job: &mut Job,
    call: &Call,
    spec: &'static CommandSpec,
    take: fn(&mut Soundings, &[Value], Span) -> Outcome<()>,
) -> Outcome<Effect> {
    let units = job.units;
    let Some(Menu::Soundings(soundings)) = job.menus.last_mut() else { return Ok(Effect::Done) };
    let [command, words @ ..] = call.words else { return Ok(Effect::Done) };
    let taken = args::read(spec, command.span, words, units).and_then(|args| take(soundings, &args.data, command.span));
    if taken.is_err() {
        soundings.refused.get_or_insert(command.span);
    }
    taken.map(|()| Effect::Done)
}

fn check_growing(last: Option<&f64>, next: f64, what: &str, span: Span) -> Outcome<()> {
    match last {
        Some(last) if next <= *last => {
            let text = format!("{what} of a bottom must grow from one to the next");
            Err(Diagnostic::error(text, span).label("not larger than the one before"))
        }
        _ => Ok(()),
    }
}

fn columns(soundings: &mut Soundings, data: &[Value], span: Span) -> Outcome<()> {
    if !soundings.y.is_empty() {
        return Err(Diagnostic::error("every X of a bottom comes before its first Y", span));
    }
    let mut x = soundings.x.clone();
    for value in data {
        let next = value.number().unwrap_or_default();
        check_growing(x.last(), next, "X", value.span)?;
        x.push(next);
    }
    fits(x.len(), 2).map_err(|e| e.diagnostic(span, Default::default()))?;
    soundings.x = x;
    Ok(())
}

fn row(soundings: &mut Soundings, data: &[Value], span: Span) -> Outcome<()> {
    let [position, heights @ ..] = data else { return Ok(()) };
    let (count, wanted) = (heights.len(), soundings.x.len());
    if wanted == 0 {
        return Err(Diagnostic::error("X of a bottom comes before its first Y", span).help("form: X x1 x2 .."));
    }
    if count != wanted {
        let at = heights.get(wanted).or(data.last()).map_or(span, |v| v.span);
        let text = format!("a row of this bottom has {wanted} heights, one for each X, and this one {count}");
        return Err(Diagnostic::error(text, at).help("form: Y y z1 z2 .."));
    }
    let y = position.number().unwrap_or_default();
    check_growing(soundings.y.last(), y, "Y", position.span)?;
    fits(wanted, soundings.y.len() + 1).map_err(|e| e.diagnostic(span, Default::default()))?;
    soundings.y.push(y);
    soundings.heights.extend(heights.iter().map(|v| soundings.sign * v.number().unwrap_or_default()));
    Ok(())
}

/// The end of the records: makes the grid.
///
/// # Errors
/// Records that were refused, or too few.
pub fn finish_grid(job: &mut Job, soundings: Soundings, at: Option<Span>) -> Outcome<()> {
    let Soundings { name, x, y, heights, refused, span, .. } = soundings;
    let position = at.unwrap_or(span);
    if let Some(refused) = refused {
        let text = format!("bathymetry {name} is not made: a record of it was refused");
        return Err(Diagnostic::error(text, position).other(refused, "this one"));
    }
    let grid = Bathymetry::new(&name, x, y, &heights, span);
    keep(job, grid.map_err(|e| e.with_span(position).diagnostic(position, job.units).other(span, "begun here"))?);
    Ok(())
}

/// The bottoms whose names fit.
pub(crate) fn table(model: &Model, fits: &dyn Fn(&str) -> bool) -> Table {
    let bottoms: Vec<_> = model.bathymetries.values().filter(|b| fits(&b.name)).collect();
    let mut table = Table::new("Bathymetry")
        .with_rows(&bottoms)
        .text("Name", |bottom| &bottom.name)
        .column("Columns", "Number", Dim::None, Digits::Usual, |bottom| bottom.size()[0])
        .columns("Columns", ["Least X", "Greatest X"], Dim::Length, Digits::Usual, |bottom| bottom.extent()[0])
        .column("Rows", "Number", Dim::None, Digits::Usual, |bottom| bottom.size()[1])
        .columns("Rows", ["Least Y", "Greatest Y"], Dim::Length, Digits::Usual, |bottom| bottom.extent()[1])
        .columns("Depth", ["Least", "Greatest"], Dim::Length, Digits::Usual, |bottom| {
            let [deepest, highest] = bottom.heights();
            [-highest, -deepest]
        })
        .build();
    if let Some(named) = &model.environment.bathymetry {
        table.note(format!("the environment in force has {}", named.kind));
    }
    table
}
