//! `windlass._core`: what the Python package `windlass` takes from the engines. The package around it is in `python/windlass`.
//!
//! Every call releases the interpreter while it computes, returns an exception of `windlass.errors` for what is wrong, and stops at Ctrl-C
//! where it may take long. A panic, which is a defect, becomes `windlass.InternalError`. There is no unsafe code here: what PyO3 and
//! arrow-array hold of it is theirs.

mod arrow;
mod catenary;
mod dynamics;
mod errors;
mod interruptible;
mod session;
mod studies;
mod svg;
mod system;
mod table;

use pyo3::prelude::*;

#[pymodule(gil_used = false)]
mod _core {
    use super::*;

    #[pymodule_export]
    use super::catenary::{Line, solve};
    #[pymodule_export]
    use super::dynamics::Dynamics;
    #[pymodule_export]
    use super::session::{Message, Result, Session};
    #[pymodule_export]
    use super::studies::{read_study, run_program};
    #[pymodule_export]
    use super::svg::{Film, Svg};
    #[pymodule_export]
    use super::system::System;
    #[pymodule_export]
    use super::table::Table;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        // this library is the only code whose panics the hook sees
        windlass::hosted::keep_panics_quiet();
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }
}
