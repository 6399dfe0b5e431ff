//! A session of records.

use crate::errors::{engine_error, of_record, warn};
use crate::interruptible;
use crate::svg::{Film, Svg, escape};
use crate::table::Table;
use pyo3::exceptions::{PyKeyError, PyRuntimeError, PyValueError};
use pyo3::prelude::*;
use std::path::PathBuf;
use std::sync::atomic::AtomicBool;
use std::sync::{Arc, Mutex, TryLockError};
use windlass::hosted::{HostMessage, HostSettings, HostView, HostedSession, NoDrawing, RunOutcome};
use windlass_base::diagnostic::{Severity, suggest};
use windlass_base::units::Dim;
use windlass_base::units::UnitSystem;

/// A session.
#[pyclass(frozen, module = "windlass")]
pub struct Session {
    inner: Mutex<HostedSession>,
    stop: Arc<AtomicBool>,
    /// The tables of the last call that showed some.
    tables: Mutex<Vec<Py<Table>>>,
}

/// A warning or a note.
#[pyclass(frozen, get_all, module = "windlass")]
pub struct Message {
    /// `note` or `warning`.
    severity: &'static str,
    message: String,
    /// The message as it is printed.
    text: String,
    source: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
    word: Option<String>,
    help: Vec<String>,
}

#[pymethods]
impl Message {
    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self) -> String {
        format!("<windlass.Message {}: {}>", self.severity, self.message)
    }
}

impl From<&HostMessage> for Message {
    fn from(said: &HostMessage) -> Self {
        Message {
            severity: if said.severity == Severity::Note { "note" } else { "warning" },
            message: said.message.clone(),
            text: said.rendered.clone(),
            source: said.source.clone(),
            line: said.line,
            column: said.column,
            word: said.word.clone(),
            help: said.help.clone(),
        }
    }
}

/// What a call of records came to.
#[pyclass(frozen, module = "windlass")]
pub struct Result {
    /// What a terminal would have shown, messages left out.
    #[pyo3(get)]
    text: String,
    tables: Vec<Py<Table>>,
    messages: Vec<Py<Message>>,
    /// `&FINISH` was read: what stood behind it was not.
    #[pyo3(get)]
    finished: bool,
    /// Results that were asked for and do not exist.
    #[pyo3(get)]
    absent: usize,
    /// Tensions over a break, a sentence each.
    #[pyo3(get)]
    over_break: Vec<String>,
}

#[pymethods]
impl Result {
    /// The tables that were shown or opened, in order.
    #[getter]
    fn tables(&self, py: Python<'_>) -> Vec<Py<Table>> {
        self.tables.iter().map(|table| table.clone_ref(py)).collect()
    }

    /// Warnings and notes, in order.
    #[getter]
    fn messages(&self, py: Python<'_>) -> Vec<Py<Message>> {
        self.messages.iter().map(|message| message.clone_ref(py)).collect()
    }

    fn __str__(&self) -> &str {
        &self.text
    }

    fn __repr__(&self) -> String {
        match self.text.trim_end() {
            "" => format!("<windlass.Result: {} tables>", self.tables.len()),
            text => text.to_string(),
        }
    }

    fn _repr_html_(&self) -> String {
        match self.text.trim_end() {
            "" => String::new(),
            text => format!("<pre>{}</pre>", escape(text)),
        }
    }
}

impl Session {
    /// Does something with the session on a thread beside the interpreter.
    fn with<T: Send>(&self, py: Python<'_>, work: impl FnOnce(&mut HostedSession) -> T + Send) -> PyResult<T> {
        let mut inner = match self.inner.try_lock() {
            Ok(inner) => inner,
            // a panic within was caught and said where it happened
            Err(TryLockError::Poisoned(poisoned)) => poisoned.into_inner(),
            Err(TryLockError::WouldBlock) => {
                return Err(PyRuntimeError::new_err("the session is at work in another thread"));
            }
        };
        let session = &mut *inner;
        interruptible::run(py, &self.stop, || work(session))
    }

    /// The result of a call, or its error as an exception; warnings are warned of.
    fn outcome(&self, py: Python<'_>, outcome: RunOutcome) -> PyResult<Result> {
        let made: PyResult<Vec<Py<Table>>> =
            outcome.tables.into_iter().map(|kept| Py::new(py, Table::new(kept))).collect();
        let tables = made?;
        if !tables.is_empty()
            && let Ok(mut last) = self.tables.lock()
        {
            *last = tables.iter().map(|table| table.clone_ref(py)).collect();
        }
        for said in outcome.remarks.iter().filter(|said| said.severity == Severity::Warning) {
            warn(py, said.rendered.trim_end())?;
        }
        for text in &outcome.over_break {
            warn(py, text)?;
        }
        if outcome.absent > 0 {
            warn(py, "a result that was asked for does not exist; the notes of its table say why")?;
        }
        if let Some(error) = &outcome.error {
            return Err(of_record(py, error));
        }
        let messages: PyResult<Vec<Py<Message>>> =
            outcome.remarks.iter().map(|said| Py::new(py, Message::from(said))).collect();
        Ok(Result {
            text: outcome.text,
            tables,
            messages: messages?,
            finished: outcome.finished,
            absent: outcome.absent,
            over_break: outcome.over_break,
        })
    }
}

#[pymethods]
impl Session {
    #[new]
    #[pyo3(signature = (root = None, *, answers = None, allow_files = false, log = false))]
    fn new(root: Option<PathBuf>, answers: Option<PathBuf>, allow_files: bool, log: bool) -> Self {
        let usual = HostSettings::default();
        let root = root.unwrap_or(usual.root);
        let session = HostedSession::new(HostSettings { root, answers, allow_files, keep_log: log });
        let stop = session.interrupt_flag();
        Session { inner: Mutex::new(session), stop, tables: Mutex::default() }
    }

    /// Runs records.
    #[pyo3(signature = (records, *, name = None))]
    fn run(&self, py: Python<'_>, records: &str, name: Option<&str>) -> PyResult<Result> {
        let outcome = self.with(py, |session| session.run(records, name))?;
        self.outcome(py, outcome)
    }

    /// Runs a script or an AQWA deck.
    fn load(&self, py: Python<'_>, path: PathBuf) -> PyResult<Result> {
        let outcome = self.with(py, |session| session.run_file(&path))?;
        self.outcome(py, outcome)
    }

    /// A table of the last call that showed some: the last one, or that of a title.
    #[pyo3(signature = (title = None))]
    fn table(&self, py: Python<'_>, title: Option<&str>) -> PyResult<Py<Table>> {
        let tables = self.tables(py);
        let Some(wanted) = title else {
            return tables
                .into_iter()
                .next_back()
                .ok_or_else(|| engine_error(py, "no record has shown a table yet: &EQUI, TABLE, &STATUS .. do"));
        };
        let has = |table: &Py<Table>, same: &dyn Fn(&str) -> bool| same(&table.get().title_text().to_ascii_uppercase());
        let wanted_capitals = wanted.to_ascii_uppercase();
        let exact = tables.iter().rfind(|table| has(table, &|title| title == wanted_capitals));
        let within: Vec<&Py<Table>> =
            tables.iter().filter(|table| has(table, &|title| title.contains(&wanted_capitals))).collect();
        let mut titles: Vec<&str> = within.iter().map(|table| table.get().title_text()).collect();
        titles.dedup();
        let help = match (exact.or(within.last().copied()), titles.as_slice()) {
            (Some(found), [] | [_]) => return Ok(found.clone_ref(py)),
            (Some(found), _) if exact.is_some() => return Ok(found.clone_ref(py)),
            (Some(_), several) => format!("it could be {}", several.join(" or ")),
            (None, _) => {
                let all = tables.iter().map(|table| table.get().title_text());
                suggest(wanted, all).unwrap_or_else(|| "none was shown".into())
            }
        };
        Err(PyKeyError::new_err(format!("no table has the title {wanted}: {help}")))
    }

    /// The tables of the last call that showed some.
    #[getter]
    fn tables(&self, py: Python<'_>) -> Vec<Py<Table>> {
        let tables = self.tables.lock().map(|tables| tables.iter().map(|table| table.clone_ref(py)).collect());
        tables.unwrap_or_default()
    }

    /// The value of a variable of the records, as text.
    fn variable(&self, py: Python<'_>, name: &str) -> PyResult<Option<String>> {
        self.with(py, |session| session.variable(name))
    }

    /// The numbers kept by `&RESULT` and `-RESULT`: value and unit by name.
    #[getter]
    fn results(&self, py: Python<'_>) -> PyResult<std::collections::BTreeMap<String, (f64, String)>> {
        let results = self.with(py, |session| session.results())?;
        Ok(results.into_iter().map(|(name, value, unit)| (name, (value, unit))).collect())
    }

    /// The name of the menu that is open.
    #[getter]
    fn menu(&self, py: Python<'_>) -> PyResult<&'static str> {
        self.with(py, |session| session.menu())
    }

    /// The units of the present records, in words.
    #[getter]
    fn units(&self, py: Python<'_>) -> PyResult<String> {
        self.with(py, |session| session.units())
    }

    /// A plot of the last table, or of that of a title: its columns against the first one.
    #[pyo3(signature = (*columns, title = None))]
    fn plot(&self, py: Python<'_>, columns: Vec<String>, title: Option<&str>) -> PyResult<Svg> {
        self.table(py, title)?.get().plot(py, columns)
    }

    /// A picture of the model where it stands; `angle` is the direction to the viewer in degrees from +X toward +Y.
    #[pyo3(signature = (*views, angle = None))]
    fn picture(&self, py: Python<'_>, views: Vec<String>, angle: Option<f64>) -> PyResult<Svg> {
        let degrees = |usual: f64| Dim::Angle.to_si(angle.unwrap_or(usual), UnitSystem::SI);
        if angle.is_some_and(|angle| !angle.is_finite()) {
            return Err(PyValueError::new_err("the angle of the viewer is not finite"));
        }
        let view = |name: &String| match name.to_ascii_uppercase().as_str() {
            "PLAN" => Ok(HostView::Plan),
            "ELEVATION" => Ok(HostView::Elevation(degrees(-90.0))),
            "ISO" => Ok(HostView::Isometric(degrees(-60.0))),
            _ => Err(PyValueError::new_err(format!("{name} is no view: plan, elevation, iso"))),
        };
        let chosen: PyResult<Vec<HostView>> = views.iter().map(view).collect();
        let mut chosen = chosen?;
        if chosen.is_empty() {
            chosen = vec![HostView::Plan, HostView::Elevation(degrees(-90.0))];
        }
        let text = self.drawn(py, move |session| session.picture(&chosen))?;
        Ok(Svg { text })
    }

    /// The last run as a film.
    fn film(&self, py: Python<'_>) -> PyResult<Film> {
        let (html, notes) = self.drawn(py, |session| session.film())?;
        for note in &notes {
            warn(py, note)?;
        }
        Ok(Film { html, notes })
    }

    fn __repr__(&self) -> String {
        "<windlass.Session>".into()
    }
}

impl Session {
    fn drawn<T: Send>(
        &self,
        py: Python<'_>,
        draw: impl FnOnce(&HostedSession) -> std::result::Result<T, NoDrawing> + Send,
    ) -> PyResult<T> {
        self.with(py, |session| draw(session))?.map_err(|error| engine_error(py, error))
    }
}
