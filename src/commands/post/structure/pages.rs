//! `PAGES` of STRUCTURE: motion and forces at instants.

use super::{EVENTS, StructureQuery, StructureReport, WHAT};
use crate::commands::post::report::Tables;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::Diagnostic;
use windlass_language::spec::{OptionSpec, ValueSpec};
use windlass_solve::tethered;

/// PAGES.
pub(super) static PAGES: StructureReport = StructureReport::new(
    "PAGES",
    "at instants the motion of the centre of gravity and of points, forces by category, expected error of the step",
    tables,
)
.with_options(&[EVENTS, OMIT])
.with_data();

choices! {
    /// Rows of a page, in the order of what a run keeps.
    enum PageRow {
        Position = "POSITION",
        Velocity = "VELOCITY",
        Acceleration = "ACCELERATION",
        Gravity = "GRAVITY",
        Hydrostatic = "HYDROSTATIC",
        Drag = "DRAG",
        FroudeKrylov = "FROUDE",
        WaveInertia = "WAVE_INERTIA",
        Diffraction = "DIFFRACTION",
        Gyroscopic = "GYROSCOPIC",
        Mooring = "MOORING",
        Total = "TOTAL",
        Error = "ERROR",
    }
}

const OMIT: OptionSpec = OptionSpec::ours(
    "-OMIT",
    &[ValueSpec::choice::<PageRow>("ROW", "rows of the pages")],
    "rows that PAGES leaves out",
)
.repeating(1);

/// The kinds of rows that -OMIT leaves out.
fn find_omitted_rows(query: &StructureQuery) -> Vec<usize> {
    let given = query.args().option(&OMIT);
    let rows: Vec<PageRow> =
        given.map(|given| given.choices(const { OMIT.choice("ROW") }).collect()).unwrap_or_default();
    (0..).zip(PageRow::ALL).filter(|(_, row)| rows.contains(row)).map(|(index, _)| index).collect()
}

fn tables(query: &StructureQuery) -> Tables {
    let (run, structure) = (query.run, query.structure);
    let mut points = Vec::new();
    for value in query.args().data_after(WHAT) {
        let word = value.word().unwrap_or_default();
        let Some(position) = structure.points.iter().position(|p| p.eq_ignore_ascii_case(word)) else {
            let text = format!("{word} is no point of {}", structure.body);
            return Err(Diagnostic::error(text, value.span));
        };
        points.push(position);
    }
    let omitted = find_omitted_rows(query);
    let rows = (points.as_slice(), omitted.as_slice());
    let page = |instant: &usize| tethered::structure(run, structure, *instant, rows, query.job.units);
    Ok(query.instants()?.iter().map(page).collect())
}
