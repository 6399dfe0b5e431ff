//! Studies, and the program itself: both run as processes of `python -m windlass`.

use crate::errors::{detached, engine_error};
use crate::table::Table;
use clap::Parser;
use pyo3::prelude::*;
use std::path::PathBuf;
use windlass::cli::{Cli, Subcommand, run, say};
use windlass::study::{self, CaseProgram};

/// Runs the program with these arguments, the first its own name; the exit code. Cases of studies are run by `interpreter`.
#[pyfunction]
pub fn run_program(py: Python<'_>, arguments: Vec<String>, interpreter: PathBuf) -> u8 {
    py.detach(|| match Cli::try_parse_from(arguments) {
        Ok(mut cli) => {
            if let Some(Subcommand::Study(args)) = &mut cli.command {
                args.program = Some(CaseProgram { file: interpreter, arguments: vec!["-m".into(), "windlass".into()] });
            }
            run(cli)
        }
        Err(message) => say(&message),
    })
}

/// The tables of a study as it stands in its folder: a row a case, a row a line of each case, a row a result of each ensemble of seeds, a
/// row a segment of a line of each ensemble that is checked by a code.
#[pyfunction]
pub fn read_study(py: Python<'_>, folder: PathBuf) -> PyResult<(Table, Table, Table, Table)> {
    let tables = detached(py, || study::read(&folder))?.map_err(|error| engine_error(py, error))?;
    let table = |what: &str, columns| Table::from_columns(&format!("{what} of {}", folder.display()), columns);
    Ok((
        table("Results", tables.results),
        table("Lines", tables.lines),
        table("Extremes over seeds", tables.ensembles),
        table("Checks over seeds", tables.seed_checks),
    ))
}
