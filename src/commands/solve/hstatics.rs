//! `HSTATICS`: curves of form, and the righting arm.
//!
//! Source: [MOSES-REF static, hstatic], for the menu and RARM; the forms of the records are ours.

use crate::commands::chosen::raise;
use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::span::Span;
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::{Floating, Hull, balance_heave_and_trim};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, ValueSpec};
use windlass_model::{Body, Mass, find};

/// HSTATICS.
pub static HSTATICS: Command = Command { spec: &HSTATICS_SPEC, edits: false, run: hstatics };
/// CFORM.
pub static CFORM: Command = Command { spec: &CFORM_SPEC, edits: false, run: cform };
/// RARM.
pub static RARM: Command = Command { spec: &RARM_SPEC, edits: false, run: rarm };

/// Most rows of a table.
const MAX_ROWS: f64 = 1000.0;

static HSTATICS_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MAIN],
    opens: Opens::Menu(&menu::HSTATICS),
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body").or("the body described last")],
    detail: "Hydrostatics of one body by itself: its connectors are left out. The configuration stays as it is.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS TBRG\nCFORM 1 1 12\nEND\nRARM 5 12\nPLOT Roll Arm\nEND\nEND",
    ..CommandSpec::new("HSTATICS", "hydrostatics of a body, up to END")
};
static CFORM_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("DRAFT", Kind::Number(Dim::Length), "first draft of the body's origin"),
        ValueSpec::new("INC", Kind::Number(Dim::Length), "step").positive(),
        ValueSpec::new("NUM", Kind::Integer, "number of drafts").in_range(1.0, MAX_ROWS),
    ],
    detail: "Curves of form against draft: the body upright, at its x, y and yaw. KB, KM are above its origin, LCB and LCF its x there; \
             the moment to trim is that of BM, or of GM where the body has a weight. Drafts at which nothing is wet have no numbers. The \
             result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\nHSTATICS\nCFORM 1 1 12\nREPORT\nEND\nEND",
    ..CommandSpec::new("CFORM", "curves of form")
};
static RARM_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("INC", Kind::Number(Dim::Angle), "step of roll"),
        ValueSpec::new("NUM", Kind::Integer, "number of steps").in_range(1.0, MAX_ROWS),
    ],
    detail: "Righting arms of the body rolled from upright in steps, at constant displacement, heave and trim balanced under weight and \
             buoyancy. The arm is positive where it turns the body back from a positive roll. Area is that under the arm from upright, by \
             trapezoids. A roll without a balance ends the table, and is said. The result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS\nRARM 5 12\nREPORT\nEND\nEND",
    ..CommandSpec::new("RARM", "righting arms")
};

fn hstatics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const BODY: DatumKey<str> = HSTATICS_SPEC.word("BODY");
    let args = &call.args;
    let body = match args.word(BODY) {
        Some(name) => find(&job.model.bodies, name, "body", args.place(BODY))?,
        None => job.model.current_body().ok_or_else(|| {
            Diagnostic::error("no body is described yet", args.span).help("&DESCRIBE BODY describes one")
        })?,
    };
    let name = body.name.clone();
    job.menus.push(Menu::Hydrostatics(name));
    Ok(Effect::Done)
}

/// The body of the menu.
fn body(job: &Job, span: Span) -> Outcome<&Body> {
    let name = job.menus.iter().rev().find_map(|menu| match menu {
        Menu::Hydrostatics(name) => Some(name.as_str()),
        _ => None,
    });
    find(&job.model.bodies, name.unwrap_or_default(), "body", span)
}

fn dispose(job: &mut Job, table: Table, span: Span) -> Effect {
    raise(job, &table, span);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
    Effect::Done
}

fn cform(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let body = body(job, span)?;
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    let hull = Hull::new(&job.model, body).map_err(to_error)?;
    let hull = hull.ok_or_else(|| {
        Diagnostic::error(format!("{} has no hull", body.name), span)
            .help("PGEN, &SURFACE and &DESCRIBE PIECE give one")
    })?;
    let mass = Mass::from_parts(job.model.parts_of(body), job.model.defaults.gravity);
    let [first, step] = args.numbers_or_zero(const { CFORM_SPEC.numbers(["DRAFT", "INC"]) });
    let at_draft = |draft: f64| {
        let mut place = Place { turn: [0.0, 0.0, body.place.turn[2]], ..body.place };
        place.shift[2] = -draft;
        let pose = Pose::from_place(&place);
        (draft, pose, Hydrostatics::new(&hull.wet(&pose), &pose, mass.centre, hull.water_weight()))
    };
    let rows: Vec<_> = (0..args.integer(const { CFORM_SPEC.integer("NUM") }).unwrap_or(1))
        .map(|n| at_draft(first + step * n as f64))
        .collect();
    let high = |h: &Hydrostatics| if mass.mass > 0.0 { h.gm_l } else { h.bm_l };
    let table = Table::new(format!("Curves of Form of {}", body.name))
        .with_rows(&rows)
        .column("", "Draft", Dim::Length, Digits::Usual, |(draft, ..)| *draft)
        .column("", "Displ.", Dim::Force, Digits::Usual, |(.., h)| h.map(|h| h.displacement))
        .column("", "Volume", Dim::Volume, Digits::Usual, |(.., h)| h.map(|h| h.volume))
        .column("", "KB", Dim::Length, Digits::Usual, |(.., h)| h.map(|h| h.kb))
        .column("", "LCB", Dim::Length, Digits::Usual, |(_, pose, h)| {
            h.map(|h| pose.local([h.centre_of_buoyancy.x, h.centre_of_buoyancy.y, 0.0].into()).x)
        })
        .column("Waterplane", "Area", Dim::Area, Digits::Usual, |(.., h)| h.map(|h| h.plane_area))
        .column("Waterplane", "LCF", Dim::Length, Digits::Usual, |(_, pose, h)| {
            h.and_then(|h| h.centre_of_flotation).map(|[x, y]| pose.local([x, y, 0.0].into()).x)
        })
        .column("Metacenter", "KMT", Dim::Length, Digits::Usual, |(.., h)| h.map(|h| h.kb + h.bm_t))
        .column("Metacenter", "KML", Dim::Length, Digits::Usual, |(.., h)| h.map(|h| h.kb + h.bm_l))
        .column("Change", "Immersion", Dim::ForcePerLength, Digits::Usual, |(.., h)| {
            h.map(|h| h.plane_area * hull.water_weight())
        })
        .column("Change", "Trim 1 Deg", Dim::Moment, Digits::Usual, |(.., h)| {
            h.map(|h| h.displacement * high(&h) * 1f64.to_radians())
        })
        .column("", "Wet Area", Dim::Area, Digits::Usual, |(.., h)| h.map(|h| h.wetted_area))
        .build();
    Ok(dispose(job, table, span))
}

fn rarm(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let body = body(job, span)?;
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    let floating = Floating::at_rest(&job.model, body).map_err(to_error)?;
    let weight = floating.mass.mass * job.model.defaults.gravity;
    let mut table = Table::new(format!("Righting Arms of {}", body.name)).fact("Weight", weight, Dim::Force);
    let step = args.number(const { RARM_SPEC.number("INC") }).unwrap_or_default();
    let mut place = Place { turn: [0.0, 0.0, body.place.turn[2]], ..body.place };
    let (mut area, mut before, mut rows) = (0.0, None, Vec::new());
    for n in 0..=args.integer(const { RARM_SPEC.integer("NUM") }).unwrap_or(1) {
        let roll = step * n as f64;
        place.turn[0] = roll;
        let found = match balance_heave_and_trim(&floating, &place) {
            Ok(found) => found,
            Err(error) if n == 0 => return Err(to_error(error)),
            Err(error) => {
                table.note_absent(format!("{}: {}", body.name, error.text(job.units)));
                break;
            }
        };
        area += before.map_or(0.0, |arm: f64| 0.5 * (arm + found.arm) * step);
        before = Some(found.arm);
        place = found.place;
        rows.push((roll, found.arm, area, place));
    }
    table.note("Area in length times radians; draft is that of the body's origin");
    let small = |x: f64| if x.abs() < 1e-9 { 0.0 } else { x };
    let table = table
        .with_rows(&rows)
        .column("", "Roll", Dim::Angle, Digits::Usual, |(roll, ..)| *roll)
        .column("", "Arm", Dim::Length, Digits::Decimals(4), |(_, arm, ..)| small(*arm))
        .column("", "Moment", Dim::Moment, Digits::Usual, |(_, arm, ..)| small(*arm) * weight)
        .column("", "Area", Dim::Length, Digits::Decimals(4), |(_, _, area, _)| small(*area))
        .column("", "Draft", Dim::Length, Digits::Usual, |(.., place)| -place.shift[2])
        .column("", "Trim", Dim::Angle, Digits::Usual, |(.., place)| small(place.turn[1]))
        .build();
    Ok(dispose(job, table, span))
}
