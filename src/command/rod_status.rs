//! `&STATUS ROD`.

use super::Job;
use super::equilibrium::told;
use crate::language::args::Args;
use crate::language::diagnostic::{Diagnostic, Outcome};
use crate::solve::results::along::lines_at_rest;
use crate::table::Table;

/// The tables of the lines that fit.
///
/// # Errors
/// No such line, or one that has no answer where its ends stand.
pub(super) fn tables(job: &Job, args: &Args, fits: &dyn Fn(&str) -> bool) -> Outcome<Vec<Table>> {
    let tables = lines_at_rest(&job.model, fits).map_err(|e| told(e, &job.model, args.span, job.units))?;
    if tables.is_empty() {
        return Err(Diagnostic::error("the model has no such line that acts and moves by itself", args.span)
            .help("a connector of class type ROD is one, or a line with &CONNECTOR -DYNAMICS"));
    }
    Ok(tables)
}
