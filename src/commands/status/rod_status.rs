//! `&STATUS ROD` and `&STATUS ROD_MODES`.

use crate::commands::Job;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::status;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Args;
use windlass_solve::results::along::{lines_at_rest, natural_modes};

/// The tables of the lines that fit.
///
/// # Errors
/// No such line, one that has no answer where its ends stand, or one that has fewer modes.
pub(crate) fn tables(job: &Job, args: &Args, kind: &str, fits: &dyn Fn(&str) -> bool) -> Outcome<Vec<Table>> {
    let number = args.option_integer(&status::NUMBER);
    let number = number.and_then(|n| usize::try_from(n).ok()).unwrap_or(6);
    let found = match kind {
        "ROD_MODES" => natural_modes(&job.model, fits, number, args.has(&status::SHAPE)),
        _ => lines_at_rest(&job.model, fits),
    };
    let tables = found.map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    if tables.is_empty() {
        return Err(Diagnostic::error("the model has no such active dynamic line", args.span)
            .help("a connector of class type ROD is one, or a line with &CONNECTOR -DYNAMICS"));
    }
    Ok(tables)
}
