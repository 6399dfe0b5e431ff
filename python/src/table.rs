//! A result: columns of one length with names and units.

use crate::arrow;
use crate::errors::engine_error;
use crate::svg::{Svg, escape};
use numpy::IntoPyArray;
use pyo3::exceptions::{PyIndexError, PyKeyError, PyValueError};
use pyo3::prelude::*;
use pyo3::types::{PyCapsule, PyDict, PyList};
use std::sync::Arc;
use windlass::hosted::{self, KeptTable};
use windlass::report::stored::{ColumnValues, StoredColumn};
use windlass_base::diagnostic::suggest;
use windlass_base::table::Cell;

/// Units of SI that columns of studies have, and none.
const SI_UNITS: [&str; 16] =
    ["", "m", "m2", "m3", "N", "N-m", "N-m2", "N/m", "Pa", "rad", "rad/s", "s", "kg", "kg/m", "m/s", "m/s2"];
/// Rows that a notebook shows.
const SHOWN_ROWS: usize = 60;

/// A table.
#[pyclass(frozen, module = "windlass")]
pub struct Table {
    title: String,
    /// No two alike.
    names: Vec<String>,
    columns: Vec<StoredColumn>,
    /// What it was made of; a table of a study is made of columns.
    kept: Option<Arc<KeptTable>>,
}

impl Table {
    /// Of a table that a record showed.
    pub fn new(kept: KeptTable) -> Self {
        let columns = hosted::columns(&kept);
        let short = kept.table.columns().iter().map(|column| column.name.clone()).collect();
        let names = unique_names(short, &columns);
        Table { title: kept.table.title.clone(), names, columns, kept: Some(Arc::new(kept)) }
    }

    /// Of columns.
    pub fn from_columns(title: &str, columns: Vec<StoredColumn>) -> Self {
        let names = unique_names(columns.iter().map(|column| column.long_name.clone()).collect(), &columns);
        Table { title: title.into(), names, columns, kept: None }
    }

    /// The title.
    pub fn title_text(&self) -> &str {
        &self.title
    }

    fn rows(&self) -> usize {
        self.columns.first().map_or(0, |column| column.values.len())
    }

    fn position(&self, name: &str) -> Option<usize> {
        let same = |(at, known): (usize, &String)| (known == name).then_some(at);
        let head = || self.columns.iter().position(|column| column.head == name || column.long_name == name);
        self.names.iter().enumerate().find_map(same).or_else(head)
    }

    fn unknown(&self, name: &str) -> PyErr {
        let near = suggest(name, self.names.iter().map(String::as_str));
        let help = near.map_or(String::new(), |near| format!(": {near}"));
        PyKeyError::new_err(format!("no column is called {name}{help}"))
    }
}

/// A name a column: its own where no other has it, else that with its group, else that with its number.
fn unique_names(short: Vec<String>, columns: &[StoredColumn]) -> Vec<String> {
    let long: Vec<&String> = columns.iter().map(|column| &column.long_name).collect();
    let name = |(at, (short_name, long_name)): (usize, (&String, &&String))| {
        if short.iter().filter(|other| *other == short_name).count() == 1 {
            short_name.clone()
        } else if long.iter().filter(|other| *other == long_name).count() == 1 {
            (*long_name).clone()
        } else {
            format!("{long_name} #{}", at + 1)
        }
    };
    short.iter().zip(&long).enumerate().map(name).collect()
}

/// A column as a numpy array: doubles with NaN for what is missing, whole numbers, or objects of text and None.
fn array<'py>(py: Python<'py>, values: &ColumnValues) -> PyResult<Bound<'py, PyAny>> {
    let doubles = |list: Vec<f64>| list.into_pyarray(py).into_any();
    Ok(match values {
        ColumnValues::Numbers(list) => doubles(list.iter().map(|value| value.unwrap_or(f64::NAN)).collect()),
        ColumnValues::Wholes(list) => match list.iter().copied().collect::<Option<Vec<i64>>>() {
            Some(wholes) => wholes.into_pyarray(py).into_any(),
            None => doubles(list.iter().map(|value| value.map_or(f64::NAN, |whole| whole as f64)).collect()),
        },
        ColumnValues::Texts(list) => {
            let options = PyDict::new(py);
            options.set_item("dtype", "object")?;
            py.import("numpy")?.getattr("array")?.call((PyList::new(py, list)?,), Some(&options))?
        }
    })
}

fn cell<'py>(py: Python<'py>, value: &Cell) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Cell::Number(number) => number.into_pyobject(py)?.into_any(),
        Cell::Integer(whole) => whole.into_pyobject(py)?.into_any(),
        Cell::Text(text) => text.into_pyobject(py)?.into_any(),
        Cell::Missing => py.None().into_bound(py),
    })
}

#[pymethods]
impl Table {
    /// The title.
    #[getter]
    fn title(&self) -> &str {
        &self.title
    }

    /// The names of the columns.
    #[getter]
    fn names(&self) -> Vec<String> {
        self.names.clone()
    }

    /// The unit of each column; empty of counts, ratios and text.
    #[getter]
    fn units<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let units = PyDict::new(py);
        for (name, column) in self.names.iter().zip(&self.columns) {
            units.set_item(name, &column.unit)?;
        }
        Ok(units)
    }

    /// What holds for all rows: name, value, unit.
    #[getter]
    fn facts<'py>(&self, py: Python<'py>) -> PyResult<Vec<(String, Bound<'py, PyAny>, String)>> {
        let facts = self.kept.as_deref().map(hosted::facts).unwrap_or_default();
        facts.into_iter().map(|(name, value, unit)| Ok((name, cell(py, &value)?, unit))).collect()
    }

    /// The remarks below the rows.
    #[getter]
    fn notes(&self) -> Vec<String> {
        self.kept.as_deref().map_or(Vec::new(), |kept| kept.table.notes.iter().map(ToString::to_string).collect())
    }

    /// The same in SI units: m, N, rad, s.
    ///
    /// # Errors
    /// `ValueError`: a table of a study with other units, which are those of its scripts.
    fn in_si(&self) -> PyResult<Table> {
        if let Some(kept) = self.kept.as_deref() {
            return Ok(Table::new(hosted::in_si(kept)));
        }
        match self.columns.iter().find(|column| !SI_UNITS.contains(&column.unit.as_str())) {
            Some(column) => Err(PyValueError::new_err(format!(
                "{} is in {}: a table of a study has the units of its scripts",
                column.long_name, column.unit
            ))),
            None => Ok(Table::from_columns(&self.title, self.columns.clone())),
        }
    }

    /// The columns by name, as numpy arrays.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyDict>> {
        let columns = PyDict::new(py);
        for (name, column) in self.names.iter().zip(&self.columns) {
            columns.set_item(name, array(py, &column.values)?)?;
        }
        Ok(columns)
    }

    /// A DataFrame of pandas; its `attrs` hold the title and the units.
    #[pyo3(signature = (*, with_units = false))]
    fn to_pandas<'py>(&self, py: Python<'py>, with_units: bool) -> PyResult<Bound<'py, PyAny>> {
        let columns = PyDict::new(py);
        for (name, column) in self.names.iter().zip(&self.columns) {
            columns.set_item(if with_units { &column.head } else { name }, array(py, &column.values)?)?;
        }
        let frame = py.import("pandas")?.getattr("DataFrame")?.call1((columns,))?;
        let attributes = frame.getattr("attrs")?;
        attributes.set_item("title", &self.title)?;
        attributes.set_item("units", self.units(py)?)?;
        Ok(frame)
    }

    /// The table as an Arrow stream, for `pyarrow.table(t)`, `polars.DataFrame(t)`, `pandas.DataFrame.from_arrow(t)`.
    #[pyo3(signature = (requested_schema = None))]
    fn __arrow_c_stream__<'py>(
        &self,
        py: Python<'py>,
        requested_schema: Option<Bound<'py, PyAny>>,
    ) -> PyResult<Bound<'py, PyCapsule>> {
        // the protocol allows to give the schema that is there
        drop(requested_schema);
        let stream = arrow::stream(&self.title, &self.names, &self.columns).map_err(|e| engine_error(py, e))?;
        PyCapsule::new_with_value(py, stream, c"arrow_array_stream")
    }

    fn __getitem__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let column = self.position(name).and_then(|at| self.columns.get(at)).ok_or_else(|| self.unknown(name))?;
        array(py, &column.values)
    }

    fn __contains__(&self, name: &str) -> bool {
        self.position(name).is_some()
    }

    fn __len__(&self) -> usize {
        self.rows()
    }

    /// A row as a dict.
    fn row<'py>(&self, py: Python<'py>, index: isize) -> PyResult<Bound<'py, PyDict>> {
        let rows = self.rows();
        let at = if index < 0 { rows.checked_sub(index.unsigned_abs()) } else { usize::try_from(index).ok() };
        let Some(at) = at.filter(|at| *at < rows) else {
            return Err(PyIndexError::new_err(format!("there is no row {index}: the table has {rows}")));
        };
        let row = PyDict::new(py);
        for (name, column) in self.names.iter().zip(&self.columns) {
            match &column.values {
                ColumnValues::Numbers(list) => row.set_item(name, list.get(at).copied().flatten())?,
                ColumnValues::Wholes(list) => row.set_item(name, list.get(at).copied().flatten())?,
                ColumnValues::Texts(list) => row.set_item(name, list.get(at).cloned().flatten())?,
            }
        }
        Ok(row)
    }

    /// Columns against the first one; all of them where none is named.
    #[pyo3(signature = (*columns))]
    pub fn plot(&self, py: Python<'_>, columns: Vec<String>) -> PyResult<Svg> {
        let Some(kept) = self.kept.as_deref() else {
            return Err(engine_error(py, "a table of a study has no plot of its own: t.to_pandas().plot()"));
        };
        let numbers: Result<Vec<String>, PyErr> = columns
            .iter()
            .map(|name| Ok((self.position(name).ok_or_else(|| self.unknown(name))? + 1).to_string()))
            .collect();
        let text = hosted::plot(kept, &numbers?).map_err(|error| engine_error(py, error))?;
        Ok(Svg { text })
    }

    fn __str__(&self) -> String {
        match self.kept.as_deref() {
            Some(kept) => hosted::text(kept),
            None => self.__repr__(),
        }
    }

    fn __repr__(&self) -> String {
        format!("<windlass.Table {:?}: {} rows of {}>", self.title, self.rows(), self.names.join(", "))
    }

    fn _repr_html_(&self) -> String {
        let mut html = format!("<table><caption>{}</caption><thead><tr>", escape(&self.title));
        for column in &self.columns {
            html.push_str(&format!("<th>{}</th>", escape(&column.head)));
        }
        html.push_str("</tr></thead><tbody>");
        for row in 0..self.rows().min(SHOWN_ROWS) {
            html.push_str("<tr>");
            for column in &self.columns {
                html.push_str(&format!("<td>{}</td>", escape(&shown(&column.values, row))));
            }
            html.push_str("</tr>");
        }
        html.push_str("</tbody></table>");
        if self.rows() > SHOWN_ROWS {
            html.push_str(&format!("<p>{} rows more</p>", self.rows() - SHOWN_ROWS));
        }
        for note in self.notes() {
            html.push_str(&format!("<p>{}</p>", escape(&note)));
        }
        html
    }
}

/// A value with the digits that one reads; files and arrays have them all.
fn shown(values: &ColumnValues, row: usize) -> String {
    match values {
        ColumnValues::Numbers(list) => match list.get(row).copied().flatten() {
            Some(value) if value == 0.0 || (1e-3..1e7).contains(&value.abs()) => {
                let decimals = (5 - value.abs().max(1.0).log10().floor() as i32).max(0) as usize;
                let text = format!("{value:.decimals$}");
                if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').into() } else { text }
            }
            Some(value) => format!("{value:.5e}"),
            None => String::new(),
        },
        ColumnValues::Wholes(list) => list.get(row).copied().flatten().map_or(String::new(), |whole| whole.to_string()),
        ColumnValues::Texts(list) => list.get(row).cloned().flatten().unwrap_or_default(),
    }
}
