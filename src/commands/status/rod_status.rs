//! `&STATUS ROD` and `&STATUS ROD_MODES`.

use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::status;
use crate::commands::status::kind::{Query, StatusKind};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_model::EntityKind;
use windlass_solve::SolveError;
use windlass_solve::results::along::{lines_at_rest, natural_modes};

/// `&STATUS ROD`.
pub static ROD: StatusKind =
    StatusKind::new("ROD", "dynamic lines, at rest between their ends as they stand", |query, _| {
        tables(query, |_| lines_at_rest(query.model(), &query.fits()))
    })
    .with_names(&[EntityKind::Connector, EntityKind::Assembly])
    .plotted(|_, tables| Ok(tables.to_vec()))
    .also(&["F_ROD", "S_ROD"]);

/// `&STATUS ROD_MODES`.
pub static ROD_MODES: StatusKind =
    StatusKind::new("ROD_MODES", "how dynamic lines swing about that, -NUMBER modes of each", |query, _| {
        let with_shapes = query.args().has(&status::SHAPE);
        tables(query, |number| natural_modes(query.model(), &query.fits(), number, with_shapes))
    })
    .with_names(&[EntityKind::Connector, EntityKind::Assembly]);

/// The tables of the lines that fit, by a function of the number of modes asked for.
///
/// # Errors
/// No such line, one that has no answer where its ends stand, or one that has fewer modes.
fn tables(query: &Query, tables: impl Fn(usize) -> Result<Vec<Table>, SolveError>) -> Outcome<Vec<Table>> {
    let (job, args) = (query.job, query.args());
    let number = args.option_integer(&status::NUMBER);
    let number = number.and_then(|n| usize::try_from(n).ok()).unwrap_or(6);
    let tables = tables(number).map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    if tables.is_empty() {
        return Err(Diagnostic::error("the model has no such active dynamic line", args.span)
            .help("a connector of class type ROD is one, or a line with &CONNECTOR -DYNAMICS"));
    }
    Ok(tables)
}
