//! `TANK_BAL`, `TANK_FLD` and `HOLE_FLOODING` of the PRCPOST menu: contents of compartments, heads at their walls and holes.
//!
//! Source: [MOSES-REF ppo_tank].

use crate::commands::Command;
use crate::commands::name_filter::NameFilter;
use crate::commands::post::points::track;
use crate::commands::post::prcpost::{EVENTS, PostQuery, show, spec};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, ValueSpec};
use windlass_model::{EntityKind, Hole, find};
use windlass_solve::results::{self, TrackedHole, TrackedTank};

/// TANK_BAL.
pub static TANK_BAL: Command =
    Command { spec: &TANK_BAL_SPEC, edits: false, run: |job, call| show(job, call, contents) };
/// TANK_FLD.
pub static TANK_FLD: Command =
    Command { spec: &TANK_FLD_SPEC, edits: false, run: |job, call| show(job, call, flooding) };
/// HOLE_FLOODING.
pub static HOLE_FLOODING: Command =
    Command { spec: &HOLE_SPEC, edits: false, run: |job, call| show(job, call, at_holes) };

const COMPARTMENTS: &[ValueSpec] =
    &[ValueSpec::new(":C", Kind::Name(Noun::Selector), "compartment, pattern or selector")
        .among(&[Noun::Compartment])
        .or("all compartments")];

const EXAMPLE: &str = "MEDIT\n&DESCRIBE BODY BOX -IGNORE X Y RX RY RZ\n*C 2 0 1\n#WEIGHT *C 100 1 1 1\n*VENT 2 0 3\n\
                       &DESCRIBE HOLE H1 VENT -POINT *VENT\n&DESCRIBE COMPARTMENT TANK -HOLES H1\nPGEN\nPLANE 0 4 -RECT 0 3 2\nEND\nEND\n\
                       &COMPARTMENT -PERCENT TANK 50\n&ENV -TIME 1 0.5\nTDOM\nPRCPOST\nTANK_BAL TANK\nREPORT\nEND\nTANK_FLD\nREPORT\nEND\n\
                       HOLE_FLOODING H1\nREPORT\nEND\nEND";

static TANK_BAL_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    example: EXAMPLE,
    detail: "Of each compartment what fills it in per cent, sounding and ullage along its sounding tube, amount, the head at its lowest point \
             (Pressure), and the largest difference of the heads inside and outside of its walls (Max Diff.), with the sea at its mean level. Heads are \
             heights of sea water (our reading). Contents are constant in a run, those of a flooded compartment follow the waterline: flow rates are not computed.",
    ..spec("TANK_BAL", COMPARTMENTS, "contents of compartments")
};
static TANK_FLD_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    example: EXAMPLE,
    detail: "The columns of TANK_BAL, then for the holes of these compartments those of HOLE_FLOODING. Times to flood are not computed: water does not \
             flow through holes.",
    ..spec("TANK_FLD", COMPARTMENTS, "contents of compartments, and heads at their holes")
};
static HOLE_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    example: EXAMPLE,
    detail: "Of each hole its height above the water with its waves, the head of the sea outside (External), that of the contents of its compartment \
             (Internal) and the first less the second. Heads are heights of sea water. Flow rates are not computed.",
    ..spec(
        "HOLE_FLOODING",
        &[ValueSpec::new(":H", Kind::Name(Noun::Selector), "hole, pattern or selector")
            .among(&[Noun::Hole])
            .or("all holes")],
        "heads at holes of compartments",
    )
};

/// The compartments of the run that a filter takes.
fn find_tracked_tanks(query: &PostQuery, takes: impl Fn(&str) -> bool) -> Outcome<Vec<TrackedTank>> {
    let mut tanks = Vec::new();
    for compartment in query.run.model.compartments.values().filter(|c| takes(&c.name)) {
        let made = TrackedTank::new(query.run, compartment);
        tanks.extend(made.map_err(|e| e.diagnostic(query.span(), query.job.units))?);
    }
    Ok(tanks)
}

/// The compartments that a record chooses.
fn chosen_tanks(query: &PostQuery) -> Outcome<Vec<TrackedTank>> {
    let chosen = NameFilter::new(&query.args().data, &query.job.model);
    let tanks = find_tracked_tanks(query, |name| chosen.matches(name))?;
    chosen.check_used("the compartments of the run", &[EntityKind::Compartment])?;
    match tanks.is_empty() {
        true => Err(Diagnostic::error("the run has no compartment", query.span())),
        false => Ok(tanks),
    }
}

fn contents(query: &PostQuery) -> Outcome<Table> {
    query.to_outcome(results::tanks(query.run, &chosen_tanks(query)?, &query.events()?))
}

/// The holes that are followed, each with its compartment among those followed.
fn tracked_holes(query: &PostQuery, tanks: &[TrackedTank], takes: impl Fn(&Hole) -> bool) -> Outcome<Vec<TrackedHole>> {
    let (model, compartments) = (&query.job.model, &query.run.model.compartments);
    let mut holes = Vec::new();
    for hole in model.holes.values().filter(|hole| takes(hole)) {
        let Some(name) = &hole.point else {
            return Err(Diagnostic::error(format!("hole {} stands nowhere", hole.name), query.span())
                .help("&DESCRIBE HOLE NAME TYPE -POINT *PT places it"));
        };
        let point = track(query, find(&model.points, name, "point", query.span())?)?;
        let own = compartments.values().find(|c| c.holes.iter().any(|name| name.eq_ignore_ascii_case(&hole.name)));
        let tank = own.and_then(|own| tanks.iter().position(|tank| tank.name == own.name));
        holes.push(TrackedHole { name: hole.name.clone(), point, tank });
    }
    Ok(holes)
}

fn at_holes(query: &PostQuery) -> Outcome<Table> {
    let tanks = find_tracked_tanks(query, |_| true)?;
    let chosen = NameFilter::new(&query.args().data, &query.job.model);
    let holes = tracked_holes(query, &tanks, |hole| chosen.matches(&hole.name))?;
    chosen.check_used("the holes", &[])?;
    if holes.is_empty() {
        return Err(Diagnostic::error("there is no hole", query.span())
            .help("&DESCRIBE HOLE NAME TYPE -POINT *PT describes one"));
    }
    query.to_outcome(results::holes(query.run, (&holes, &tanks), &query.events()?))
}

fn flooding(query: &PostQuery) -> Outcome<Table> {
    let (tanks, events) = (chosen_tanks(query)?, query.events()?);
    let mut table = query.to_outcome(results::tanks(query.run, &tanks, &events))?;
    let compartments = &query.run.model.compartments;
    let own = |hole: &Hole| {
        let of = compartments.values().find(|c| c.holes.iter().any(|name| name.eq_ignore_ascii_case(&hole.name)));
        of.is_some_and(|own| tanks.iter().any(|tank| tank.name == own.name))
    };
    let holes = tracked_holes(query, &tanks, own)?;
    if !holes.is_empty() {
        let more = query.to_outcome(results::holes(query.run, (&holes, &tanks), &events))?;
        let columns: Vec<_> = table.columns().iter().cloned().chain(more.columns().iter().skip(1).cloned()).collect();
        table = table.with_columns(columns);
        table.add_notes(more.notes.into_iter().filter(|note| note.text.starts_with("heads")));
    }
    table.note("times to flood are not computed: water does not flow through holes");
    Ok(table)
}
