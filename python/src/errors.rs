//! The exceptions of `windlass.errors`, made of the errors of the engines.

use pyo3::prelude::*;
use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use windlass::hosted::{HostMessage, internal_error};

/// An exception of `windlass.errors` by its name, or the exception that its module cannot be imported.
fn exception(py: Python<'_>, class: &str, text: &str) -> PyErr {
    let made = py.import("windlass.errors").and_then(|errors| errors.getattr(class)?.call1((text,)));
    made.map_or_else(|error| error, |value| PyErr::from_value(value))
}

/// `windlass.Error`: an engine refuses.
pub fn engine_error(py: Python<'_>, text: impl std::fmt::Display) -> PyErr {
    exception(py, "Error", &text.to_string())
}

/// `windlass.InternalError`: a panic was met.
pub fn of_panic(py: Python<'_>, _: Box<dyn Any + Send>) -> PyErr {
    exception(py, "InternalError", &format!("{}; please report it", internal_error()))
}

/// What `work` returns beside the interpreter.
///
/// # Errors
/// `windlass.InternalError` where it panics.
pub fn detached<T: Send>(py: Python<'_>, work: impl FnOnce() -> T + Send) -> PyResult<T> {
    py.detach(|| catch_unwind(AssertUnwindSafe(work))).map_err(|panic| of_panic(py, panic))
}

/// `windlass.RecordError` with the place of the word.
pub fn of_record(py: Python<'_>, said: &HostMessage) -> PyErr {
    let make = || -> PyResult<PyErr> {
        let class = py.import("windlass.errors")?.getattr("RecordError")?;
        let place = (said.source.as_deref(), said.line, said.column, said.word.as_deref());
        let (source, line, column, word) = place;
        let texts = (said.message.as_str(), said.rendered.as_str());
        let value =
            class.call1((texts.0, texts.1, source, line, column, word, said.label.as_str(), said.help.clone()))?;
        Ok(PyErr::from_value(value))
    };
    make().unwrap_or_else(|error| error)
}

/// Warns of a text as `windlass.RecordWarning`, of the line that called.
pub fn warn(py: Python<'_>, text: &str) -> PyResult<()> {
    let class = py.import("windlass.errors")?.getattr("RecordWarning")?;
    py.import("warnings")?.getattr("warn")?.call1((text, class)).map(drop)
}
