//! `&STATUS TETHERS` and `TETHER_MODES`.

use crate::commands::Job;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::status;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Args;
use windlass_solve::tethered;

/// The tables of the tethers that fit.
///
/// # Errors
/// No tether, or one that cannot be reckoned with.
pub(crate) fn tables(job: &Job, args: &Args, kind: &str, fits: &dyn Fn(&str) -> bool) -> Outcome<Vec<Table>> {
    let wrong = |e| to_diagnostic(e, &job.model, args.span, job.units);
    let names: Vec<String> = tethered::names(&job.model).into_iter().filter(|name| fits(name)).collect();
    if names.is_empty() {
        return Err(Diagnostic::error("the model has no such tether that acts", args.span)
            .help("a connector of class type TETHER is one"));
    }
    let number = args.option_integer(&status::NUMBER);
    let number = number.and_then(|n| usize::try_from(n).ok()).unwrap_or(6);
    let mut tables = Vec::new();
    for name in names {
        if kind == "TETHERS" {
            tables.push(tethered::description_table(&job.model, &name).map_err(wrong)?);
        } else {
            tables.extend(tethered::natural(&job.model, &name, number, args.has(&status::AQWA)).map_err(wrong)?);
        }
    }
    Ok(tables)
}
