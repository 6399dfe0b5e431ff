//! A session for a program that calls it: records go in, tables, text and messages come out. The Python package and the C interface
//! are made of this module; what is particular to their languages is there.
//!
//! A call stops at its first error, and what was to be read behind that record is given up, as a program expects of a call that failed.
//! Otherwise a hosted session acts as one at a terminal: menus stay open between calls, a refused record may be given again, and the
//! model is as before it. No panic leaves a call.

use crate::commands::FILM_LINE_POINTS;
use crate::report::columns::choose;
use crate::report::files::JobFolder;
use crate::report::film;
use crate::report::output::Output;
use crate::report::page::{self, PageHead};
use crate::report::picture::{Picture, USUAL_WIDTH, View};
use crate::report::plot::Chart;
use crate::report::stored::{StoredColumn, columns_of};
use crate::session::{Session, SessionEnd, read_text};
use std::io::Write;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, Once};
use windlass_base::diagnostic::{Diagnostic, Severity};
use windlass_base::span::Span;
use windlass_base::table::{Cell, Column, Fact, Table};
use windlass_base::units::UnitSystem;
use windlass_hydro::sea::Sea;
use windlass_language::render::render;
use windlass_language::source::Text;
use windlass_model::Ambient;
use windlass_solve::film::{Film, FilmSelection};
use windlass_solve::scene::{Scene, SceneOptions};

pub use crate::commands::KeptTable;

/// Where the files of a hosted session go, and what it may touch.
#[derive(Clone, Debug)]
pub struct HostSettings {
    /// The root of its names: answers go to `ROOT.ans`, `INMODEL` reads `ROOT.dat`.
    pub root: PathBuf,
    /// The folder of its answers, where it is another.
    pub answers: Option<PathBuf>,
    /// Files may be made outside of the folder of answers.
    pub allow_files: bool,
    /// A log is kept in the folder of answers.
    pub keep_log: bool,
}

impl Default for HostSettings {
    fn default() -> Self {
        HostSettings { root: "windlass".into(), answers: None, allow_files: false, keep_log: false }
    }
}

/// A message of a session, with its place in words.
#[derive(Clone, Debug, PartialEq)]
pub struct HostMessage {
    /// How serious.
    pub severity: Severity,
    /// One sentence without a full stop.
    pub message: String,
    /// What is read there: a file, or the name of the call.
    pub source: Option<String>,
    /// Line, from 1.
    pub line: Option<usize>,
    /// Column of the word, from 1, in characters.
    pub column: Option<usize>,
    /// The word it is about, as written.
    pub word: Option<String>,
    /// What stands under the underlined word, as `expected a number`.
    pub label: String,
    /// Further lines: what to write instead.
    pub help: Vec<String>,
    /// The message as it is printed: the record, the word underlined, the help.
    pub rendered: String,
}

impl HostMessage {
    /// A message without a place.
    fn plain(severity: Severity, message: impl Into<String>, help: Vec<String>) -> Self {
        let mut said = Diagnostic::plain(severity, message);
        said.help = help;
        let rendered = render(&said, &Default::default(), false);
        HostMessage {
            severity,
            message: said.message,
            source: None,
            line: None,
            column: None,
            word: None,
            label: String::new(),
            help: said.help,
            rendered,
        }
    }

    fn is_error(&self) -> bool {
        matches!(self.severity, Severity::Error | Severity::Fatal)
    }
}

/// What a call came to.
#[derive(Clone, Debug, Default)]
pub struct RunOutcome {
    /// The error at which it stopped.
    pub error: Option<HostMessage>,
    /// Warnings and notes, in order.
    pub remarks: Vec<HostMessage>,
    /// What a terminal would have shown, messages left out.
    pub text: String,
    /// The tables that were shown or opened, in order.
    pub tables: Vec<KeptTable>,
    /// Ctrl-C, or another thread by [`HostedSession::interrupt_flag`], stopped it.
    pub interrupted: bool,
    /// `&FINISH` was read.
    pub finished: bool,
    /// Results that were asked for and do not exist; the tables say why.
    pub absent: usize,
    /// Tensions over a break, one sentence each.
    pub over_break: Vec<String>,
}

/// Why there is no picture or film.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[error("{0}")]
pub struct NoDrawing(String);

/// From where a picture is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum HostView {
    /// From above, X to the right.
    Plan,
    /// Horizontally, by a viewer in a direction from +X toward +Y (rad).
    Elevation(f64),
    /// Slantwise from above, by a viewer in a direction from +X toward +Y (rad).
    Isometric(f64),
}

/// Text that a session prints and its caller takes.
#[derive(Clone, Default)]
struct CollectedText(Arc<Mutex<Vec<u8>>>);

impl CollectedText {
    fn take(&self) -> String {
        let bytes = self.0.lock().map(|mut bytes| std::mem::take(&mut *bytes)).unwrap_or_default();
        String::from_utf8_lossy(&bytes).into_owned()
    }
}

impl Write for CollectedText {
    fn write(&mut self, bytes: &[u8]) -> std::io::Result<usize> {
        if let Ok(mut text) = self.0.lock() {
            text.extend_from_slice(bytes);
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> std::io::Result<()> {
        Ok(())
    }
}

/// What surrounds lines whose fairleads a program moves, beside an environment of records.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LineWater {
    /// Depth (m); none of water that is deep.
    pub depth: Option<f64>,
    /// Density (kg/m3).
    pub density: f64,
    /// Gravity (m/s2).
    pub gravity: f64,
}

/// Longest options of an environment (bytes).
const LONGEST_ENVIRONMENT: usize = 1 << 20;

impl LineWater {
    /// The water of an environment: `options` are those of a `&ENV` record (`-SEA JONSWAP 180 9 12 3.3 -SEED 5 -RAMP 60`), in metres, seconds,
    /// degrees and kilonewtons. Lines feel it as those of `TDOM` do.
    ///
    /// # Errors
    /// What the record refuses; what lines of a program do not feel: marine growth, a bottom over a grid; a depth or density of its own.
    pub fn ambient(&self, options: &str) -> Result<Arc<dyn Ambient>, Box<HostMessage>> {
        let refuse = |text: &str| Err(Box::new(HostMessage::plain(Severity::Error, text, Vec::new())));
        if options.len() > LONGEST_ENVIRONMENT
            || options.contains(|letter: char| letter.is_control() || "$&%\\".contains(letter))
        {
            return refuse(
                "the environment holds options of one &ENV record, without `$`, `&`, `%`, `\\` and ends of lines",
            );
        }
        let mut hosted = HostedSession::new(HostSettings::default());
        let ended = hosted.run("&DIMEN -DIMEN METERS KN", None);
        let ended = if ended.error.is_none() {
            hosted.run(&format!("&ENV WATER {options}"), Some("environment"))
        } else {
            ended
        };
        if let Some(error) = ended.error {
            return Err(Box::new(error));
        }
        let model = &mut hosted.session.job.model;
        if model.environment.depth.is_some() || model.environment.water_density.is_some() {
            return refuse("depth and density are arguments of their own, not options of the environment");
        }
        (model.environment.depth, model.environment.water_density) = (self.depth, Some(self.density));
        model.defaults.gravity = self.gravity;
        let wrong = |error: windlass_model::ClassError| {
            let text = error.diagnostic(Span::default(), UnitSystem::SI).message.clone();
            Box::new(HostMessage::plain(Severity::Error, text, Vec::new()))
        };
        let sea = Sea::new(model, &model.environment).map_err(wrong)?.map(Arc::new);
        let ambient = windlass_hydro::ambient(model, sea.as_ref()).map_err(wrong)?;
        if ambient.grows() || ambient.has_bottom_grid() {
            return refuse("marine growth and a bottom over a grid are not felt by these lines");
        }
        Ok(ambient)
    }
}

/// A session that a program calls.
pub struct HostedSession {
    session: Session,
    screen: CollectedText,
    calls: usize,
    /// A call ended by a panic: what it left is not to be relied on.
    broken: bool,
}

impl HostedSession {
    /// A new session.
    pub fn new(settings: HostSettings) -> Self {
        let screen = CollectedText::default();
        let folder = JobFolder::new(settings.root, settings.answers, settings.allow_files);
        let output = Output::new(folder, Box::new(screen.clone()), Box::new(std::io::sink()), false);
        let mut session = Session::new(output);
        session.job.output.keep_log = settings.keep_log;
        session.keep_reports = true;
        session.stops_at_error = true;
        session.take_terminal();
        session.interpreter.open_terminal();
        HostedSession { session, screen, calls: 0, broken: false }
    }

    /// Set by another thread, it stops the call that runs: see [`RunOutcome::interrupted`].
    pub fn interrupt_flag(&self) -> Arc<AtomicBool> {
        Arc::clone(&self.session.interpreter.interrupt)
    }

    /// Runs records. `name` is what messages call them; without one `call 1`, `call 2` and so on.
    pub fn run(&mut self, records: &str, name: Option<&str>) -> RunOutcome {
        self.calls += 1;
        let name = name.map_or_else(|| format!("call {}", self.calls), str::to_string);
        self.guarded(|session| {
            session.open(&name, records);
            session.run()
        })
    }

    /// Runs a script, or an AQWA deck.
    pub fn run_file(&mut self, path: &Path) -> RunOutcome {
        let text: Text = match read_text(path) {
            Ok(text) => text,
            Err(error) => {
                let error = HostMessage::plain(Severity::Error, error.to_string(), Vec::new());
                return RunOutcome { error: Some(error), ..RunOutcome::default() };
            }
        };
        let name = path.display().to_string();
        self.guarded(|session| {
            session.open_job(&name, text);
            session.run()
        })
    }

    /// A call, with all that it leaves taken out of the session.
    fn guarded(&mut self, call: impl FnOnce(&mut Session) -> SessionEnd) -> RunOutcome {
        if self.broken {
            let help = vec!["make a new session".into()];
            let text = "an earlier call ended by an internal error: this session is not to be relied on";
            let error = HostMessage::plain(Severity::Fatal, text, help);
            return RunOutcome { error: Some(error), ..RunOutcome::default() };
        }
        let session = &mut self.session;
        session.job.kept_tables = Some(Vec::new());
        session.interpreter.interrupt.store(false, Ordering::Relaxed);
        session.interpreter.was_interrupted = false;
        session.errors = 0;
        session.interpreter.feed("terminal", "", 1);
        let ended = catch_unwind(AssertUnwindSafe(|| {
            let end = call(session);
            session.job.output.flush();
            end
        }));
        session.interpreter.unwind();
        let mut messages = self.messages();
        let session = &mut self.session;
        if ended.is_err() {
            self.broken = true;
            let help = vec!["please report this record, and make a new session".into()];
            messages.push(HostMessage::plain(Severity::Fatal, internal_error(), help));
        }
        let error = messages.iter().position(HostMessage::is_error).map(|at| messages.remove(at));
        let verdict = std::mem::take(&mut session.job.verdict);
        let mut tables = session.job.kept_tables.take().unwrap_or_default();
        // a record that shows a table and opens it has kept it twice
        tables.dedup();
        RunOutcome {
            error,
            remarks: messages,
            text: self.screen.take(),
            tables,
            interrupted: session.interpreter.was_interrupted,
            finished: matches!(ended, Ok(SessionEnd::Finished)),
            absent: verdict.absent,
            over_break: verdict.over_break.iter().map(|over| format!("{} ({})", over.text(), over.command)).collect(),
        }
    }

    /// The messages since this was last asked.
    fn messages(&mut self) -> Vec<HostMessage> {
        let reports = std::mem::take(&mut self.session.reports);
        let sources = &self.session.interpreter.sources;
        let message = |said: Diagnostic| {
            let source = said.span.and_then(|span| sources.get(span.source));
            let position = said.span.and_then(|span| sources.position(span));
            let word = said.span.zip(source).and_then(|(span, source)| {
                let range = usize::try_from(span.start).ok()?..usize::try_from(span.end).ok()?;
                source.text.get(range)
            });
            HostMessage {
                severity: said.severity,
                source: source.map(|source| source.name.clone()),
                line: position.map(|(line, _)| line),
                column: position.map(|(_, column)| column),
                word: word.map(str::to_string),
                rendered: render(&said, sources, false),
                message: said.message,
                label: said.label,
                help: said.help,
            }
        };
        reports.into_iter().map(message).collect()
    }

    /// The value of a variable of the records, as text.
    pub fn variable(&self, name: &str) -> Option<String> {
        self.session.interpreter.variables.get(name).map(str::to_string)
    }

    /// The name of the menu that is open.
    pub fn menu(&self) -> &'static str {
        self.session.job.menu().name()
    }

    /// The numbers that `&RESULT` and `-RESULT` have kept: name, value, unit.
    pub fn results(&self) -> Vec<(String, f64, String)> {
        let results = self.session.job.kept.results().iter();
        results.map(|result| (result.name.clone(), result.value, result.unit.clone())).collect()
    }

    /// The units of the present records, in words.
    pub fn units(&self) -> String {
        self.session.job.units.to_string()
    }

    /// A picture of the model where it stands, as SVG.
    ///
    /// # Errors
    /// [`NoDrawing`]: nothing to draw, or a place beyond all measure.
    pub fn picture(&self, views: &[HostView]) -> Result<String, NoDrawing> {
        let job = &self.session.job;
        let choice = SceneOptions { connector: &|_| true, body: &|_| true, stop: &|| job.is_interrupted() };
        let drawn = || {
            let (scene, _) = Scene::build(&job.model, &choice).ok_or_else(|| NoDrawing("interrupted".into()))?;
            let view = |view: &HostView| match *view {
                HostView::Plan => View::plan(),
                HostView::Elevation(from) => View::elevation(from, 1.0),
                HostView::Isometric(from) => View::isometric(from, 1.0),
            };
            let picture = Picture {
                title: job.titles.first().cloned().unwrap_or_default(),
                scene,
                views: views.iter().map(view).collect(),
                names: true,
                units: job.units,
                tensions: true,
                north: None,
                width: USUAL_WIDTH,
            };
            let (bytes, _) = picture.file("picture.svg").map_err(|error| NoDrawing(error.to_string()))?;
            String::from_utf8(bytes).map_err(|error| NoDrawing(error.to_string()))
        };
        without_panic(drawn)
    }

    /// The last run as a page for a browser, with nothing to be fetched from elsewhere, and what is to be said of it.
    ///
    /// # Errors
    /// [`NoDrawing`]: no run, or none with anything that moves.
    pub fn film(&self) -> Result<(String, Vec<String>), NoDrawing> {
        let job = &self.session.job;
        let made = || {
            let run = job.run.as_ref().ok_or_else(|| NoDrawing("there is no run yet: TDOM makes one".into()))?;
            let chosen = FilmSelection {
                connector: &|_| true,
                body: &|_| true,
                window: None,
                points: FILM_LINE_POINTS,
                stop: &|| job.is_interrupted(),
            };
            let film = Film::build(run, &chosen)
                .map_err(|error| NoDrawing(error.diagnostic(Default::default(), job.units).message))?;
            let title = job.titles.first().filter(|title| !title.is_empty()).map_or("Time Domain", String::as_str);
            let page = film::page(&film, title, job.units).map_err(|error| NoDrawing(format!("{error:#}")))?;
            Ok((page, film.notes))
        };
        without_panic(made)
    }
}

/// A table's columns by type, also of one without rows: names no two alike, units, values in the user's units.
pub fn columns(kept: &KeptTable) -> Vec<StoredColumn> {
    columns_of(&kept.table, kept.units)
}

/// The same table in SI: m, N, rad and s.
pub fn in_si(kept: &KeptTable) -> KeptTable {
    let mut table = kept.table.clone();
    table.facts.iter_mut().for_each(|fact| fact.dim = fact.dim.in_si());
    let column = |column: &Column| Column { dim: column.dim.in_si(), ..column.clone() };
    let columns = table.columns().iter().map(column).collect();
    KeptTable { table: table.with_columns(columns), units: UnitSystem::SI }
}

/// The facts above the rows of a table: name, value in the user's units, unit.
pub fn facts(kept: &KeptTable) -> Vec<(String, Cell, String)> {
    let value = |fact: &Fact| match &fact.value {
        Cell::Number(value) => Cell::Number(fact.dim.from_si(*value, kept.units)),
        other => other.clone(),
    };
    kept.table.facts.iter().map(|fact| (fact.name.clone(), value(fact), fact.dim.label(kept.units))).collect()
}

/// A table as it is printed.
pub fn text(kept: &KeptTable) -> String {
    let head = PageHead { date: None, titles: Default::default(), process: String::new() };
    page::render(&kept.table, kept.units, &head, None)
}

/// Columns of a table against its first one, as SVG. A name is a selector of the disposition menu: a name, the beginning of one, a number, a
/// range. Where none is given, those columns of numbers whose units are the first two behind that of the first one: a plot has two axes.
///
/// # Errors
/// [`NoDrawing`]: a name of no column, columns of more than two units, nothing to draw.
pub fn plot(kept: &KeptTable, names: &[String]) -> Result<String, NoDrawing> {
    without_panic(|| {
        let table = &kept.table;
        let chosen = if names.is_empty() {
            columns_of_two_units(kept)
        } else {
            let mut chosen: Vec<usize> = Vec::new();
            for name in names {
                chosen.extend(choose(table, name).map_err(|error| NoDrawing(error.to_string()))?);
            }
            if chosen.len() == 1 || !chosen.contains(&0) {
                chosen.insert(0, 0);
            }
            chosen.dedup();
            chosen
        };
        let columns = chosen.iter().filter_map(|index| table.columns().get(*index).cloned()).collect();
        let part = Table::from_columns(table.title.clone(), columns);
        let svg = Chart::from_table(&part, kept.units).and_then(|chart| chart.svg());
        let svg = svg.map_err(|error| NoDrawing(error.to_string()))?;
        String::from_utf8(svg).map_err(|error| NoDrawing(error.to_string()))
    })
}

/// The first column of numbers and those behind it whose units are the first two there.
fn columns_of_two_units(kept: &KeptTable) -> Vec<usize> {
    let has_number = |column: &Column| column.cells.iter().any(|cell| cell.number().is_some());
    let mut units: Vec<String> = Vec::new();
    let mut chosen = Vec::new();
    for (index, column) in kept.table.columns().iter().enumerate().filter(|(_, column)| has_number(column)) {
        let unit = column.dim.label(kept.units);
        if !chosen.is_empty() && !units.contains(&unit) {
            if units.len() == 2 {
                continue;
            }
            units.push(unit);
        }
        chosen.push(index);
    }
    chosen
}

/// What is made, or that a panic was met.
fn without_panic<T>(make: impl FnOnce() -> Result<T, NoDrawing>) -> Result<T, NoDrawing> {
    catch_unwind(AssertUnwindSafe(make)).unwrap_or_else(|_| Err(NoDrawing(internal_error())))
}

/// Where the last panic was, while [`keep_panics_quiet`] is in force.
static LAST_PANIC: Mutex<Option<String>> = Mutex::new(None);

/// From here on no panic prints anything: where it was goes into the error that the caller gets. For a shared library, whose panics are
/// all its own.
pub fn keep_panics_quiet() {
    static HOOK: Once = Once::new();
    HOOK.call_once(|| {
        std::panic::set_hook(Box::new(|panic| {
            if let Ok(mut last) = LAST_PANIC.lock() {
                *last = panic.location().map(ToString::to_string);
            }
        }));
    });
}

/// What is said of a panic.
pub fn internal_error() -> String {
    let place = LAST_PANIC.lock().ok().and_then(|mut last| last.take());
    format!("internal error{}", place.map_or(String::new(), |place| format!(" at {place}")))
}
