//! Drawings as a notebook shows them.

use crate::errors::engine_error;
use pyo3::prelude::*;
use std::path::PathBuf;

/// Writes a file whole: beside its place, then renamed.
fn write_whole(py: Python<'_>, path: &PathBuf, text: &str) -> PyResult<()> {
    let mut fresh = path.clone().into_os_string();
    fresh.push(".new");
    let written = std::fs::write(&fresh, text).and_then(|()| std::fs::rename(&fresh, path));
    written.map_err(|error| {
        // nothing to remove is what it should leave
        let _ = std::fs::remove_file(&fresh);
        engine_error(py, format!("{}: {error}", path.display()))
    })
}

/// A plot or a picture.
#[pyclass(frozen, module = "windlass")]
pub struct Svg {
    /// The drawing.
    #[pyo3(get)]
    pub text: String,
}

#[pymethods]
impl Svg {
    fn _repr_svg_(&self) -> &str {
        &self.text
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        write_whole(py, &path, &self.text)
    }

    fn __repr__(&self) -> String {
        format!("<windlass.Svg of {} bytes>", self.text.len())
    }
}

/// A run as a page.
#[pyclass(frozen, module = "windlass")]
pub struct Film {
    /// The page.
    #[pyo3(get)]
    pub html: String,
    /// What is to be said of it.
    #[pyo3(get)]
    pub notes: Vec<String>,
}

#[pymethods]
impl Film {
    /// The page in a frame of its own: its scripts and styles stay within.
    fn _repr_html_(&self) -> String {
        let quoted = escape(&self.html);
        format!("<iframe srcdoc=\"{quoted}\" width=\"100%\" height=\"600\" style=\"border:0\"></iframe>")
    }

    fn save(&self, py: Python<'_>, path: PathBuf) -> PyResult<()> {
        write_whole(py, &path, &self.html)
    }

    fn __repr__(&self) -> String {
        format!("<windlass.Film of {} bytes>", self.html.len())
    }
}

/// Text within HTML.
pub fn escape(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;").replace('"', "&quot;")
}
