//! `&STATUS TETHERS` and `TETHER_MODES`.

use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::status;
use crate::commands::status::kind::{Query, StatusKind};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_model::{EntityKind, Model};
use windlass_solve::{SolveError, tethered};

/// `&STATUS TETHERS`.
pub static TETHERS: StatusKind =
    StatusKind::new("TETHERS", "what tethers are made of and hang on, as TDOM -TETHERS has them", |query, _| {
        tables(query, |model, name, _| Ok(vec![tethered::description_table(model, name)?]))
    })
    .with_names(&[EntityKind::Connector]);

/// `&STATUS TETHER_MODES`.
pub static TETHER_MODES: StatusKind =
    StatusKind::new("TETHER_MODES", "natural modes of tethers where they stand, -NUMBER of each", |query, _| {
        let with_aqwa = query.args().has(&status::AQWA);
        tables(query, |model, name, number| tethered::natural(model, name, number, with_aqwa))
    })
    .with_names(&[EntityKind::Connector]);

/// The tables that a function makes of each tether that fits: by the model, its name and the number of modes asked for.
///
/// # Errors
/// No tether, or one that cannot be reckoned with.
fn tables(query: &Query, table: impl Fn(&Model, &str, usize) -> Result<Vec<Table>, SolveError>) -> Outcome<Vec<Table>> {
    let (job, args, fits) = (query.job, query.args(), query.fits());
    let names: Vec<String> = tethered::names(&job.model).into_iter().filter(|name| fits(name)).collect();
    if names.is_empty() {
        return Err(Diagnostic::error("the model has no such tether that acts", args.span)
            .help("a connector of class type TETHER is one"));
    }
    let number = args.option_integer(&status::NUMBER);
    let number = number.and_then(|n| usize::try_from(n).ok()).unwrap_or(6);
    let mut tables = Vec::new();
    for name in names {
        let made = table(&job.model, &name, number);
        tables.extend(made.map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?);
    }
    Ok(tables)
}
