//! `HSTATICS`: curves of form, and the righting arm.
//!
//! Source: [MOSES-REF static, hstatic], for the menu and RARM; the forms of the records are ours.

use super::chosen::raise;
use super::status::push;
use super::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::pose::Pose;
use windlass_base::span::Span;
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_hydro::hull::Hydrostatics;
use windlass_hydro::{Floating, Hull, balanced};
use windlass_language::spec::{CommandSpec, Kind, Opens, ValueSpec};
use windlass_model::{Body, Mass, find};

/// HSTATICS.
pub static HSTATICS: Command = Command { spec: &HSTATICS_SPEC, edits: false, run: hstatics };
/// CFORM.
pub static CFORM: Command = Command { spec: &CFORM_SPEC, edits: false, run: cform };
/// RARM.
pub static RARM: Command = Command { spec: &RARM_SPEC, edits: false, run: rarm };

/// Most rows of a table.
const MOST: f64 = 1000.0;

static HSTATICS_SPEC: CommandSpec = CommandSpec {
    menus: &["MAIN"],
    opens: Opens::Menu("HSTATICS"),
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body").or("the body described last")],
    detail: "Hydrostatics of one body by itself: its connectors are left out. The configuration stays as it is.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS TBRG\nCFORM 1 1 12\nEND\nRARM 5 12\nPLOT Roll Arm\nEND\nEND",
    ..CommandSpec::new("HSTATICS", "hydrostatics of a body, up to END")
};
static CFORM_SPEC: CommandSpec = CommandSpec {
    menus: &["HSTATICS"],
    opens: Opens::Menu("DISPOSITION"),
    data: &[
        ValueSpec::new("DRAFT", Kind::Number(Dim::Length), "first draft of the body's origin"),
        ValueSpec::new("INC", Kind::Number(Dim::Length), "step").positive(),
        ValueSpec::new("NUM", Kind::Integer, "number of drafts").within(1.0, MOST),
    ],
    detail: "Curves of form against draft: the body upright, at its x, y and yaw. KB, KM are above its origin, LCB and LCF its x there; \
             the moment to trim is that of BM, or of GM where the body has a weight. Drafts at which nothing is wet have no numbers. The \
             result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\nHSTATICS\nCFORM 1 1 12\nREPORT\nEND\nEND",
    ..CommandSpec::new("CFORM", "curves of form")
};
static RARM_SPEC: CommandSpec = CommandSpec {
    menus: &["HSTATICS"],
    opens: Opens::Menu("DISPOSITION"),
    data: &[
        ValueSpec::new("INC", Kind::Number(Dim::Angle), "step of roll"),
        ValueSpec::new("NUM", Kind::Integer, "number of steps").within(1.0, MOST),
    ],
    detail: "Righting arms of the body rolled from upright in steps, at constant displacement, heave and trim balanced under weight and \
             buoyancy. The arm is positive where it turns the body back from a positive roll. Area is that under the arm from upright, by \
             trapezoids. A roll without a balance ends the table, and is said. The result goes to the disposition menu.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS\nRARM 5 12\nREPORT\nEND\nEND",
    ..CommandSpec::new("RARM", "righting arms")
};

fn hstatics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let body = match args.word(0) {
        Some(name) => find(&job.model.bodies, name, "body", args.place(0))?,
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
    let told = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    let hull = Hull::of(&job.model, body).map_err(told)?;
    let hull = hull.ok_or_else(|| {
        Diagnostic::error(format!("{} has no hull", body.name), span)
            .help("PGEN, &SURFACE and &DESCRIBE PIECE give one")
    })?;
    let mass = Mass::of(job.model.parts_of(body), job.model.defaults.gravity);
    let mut table = Table::new(format!("Curves of Form of {}", body.name));
    for (group, name, dim) in [
        ("", "Draft", Dim::Length),
        ("", "Displ.", Dim::Force),
        ("", "Volume", Dim::Volume),
        ("", "KB", Dim::Length),
        ("", "LCB", Dim::Length),
        ("Waterplane", "Area", Dim::Area),
        ("Waterplane", "LCF", Dim::Length),
        ("Metacenter", "KMT", Dim::Length),
        ("Metacenter", "KML", Dim::Length),
        ("Change", "Immersion", Dim::ForcePerLength),
        ("Change", "Trim 1 Deg", Dim::Moment),
        ("", "Wet Area", Dim::Area),
    ] {
        table = table.column(group, name, dim, Digits::Usual);
    }
    let (first, step) = (args.number(0).unwrap_or_default(), args.number(1).unwrap_or_default());
    for n in 0..args.integer(2).unwrap_or(1) {
        let draft = first + step * n as f64;
        let mut place = Place { turn: [0.0, 0.0, body.place.turn[2]], ..body.place };
        place.shift[2] = -draft;
        let pose = Pose::of(&place);
        let found = Hydrostatics::of(&hull.wet(&pose), &pose, mass.centre, hull.water_weight());
        let mut row = vec![Cell::from(draft)];
        match found {
            None => row.extend([const { Cell::Missing }; 11]),
            Some(h) => {
                let in_body = |x: f64, y: f64| pose.local([x, y, 0.0].into()).x;
                let centre = h.centre_of_buoyancy;
                let high = if mass.mass > 0.0 { h.gm_l } else { h.bm_l };
                let flotation = h.centre_of_flotation.map(|[x, y]| in_body(x, y));
                row.extend([h.displacement, h.volume, h.kb, in_body(centre.x, centre.y), h.plane_area].map(Cell::from));
                row.push(flotation.into());
                let change = [h.plane_area * hull.water_weight(), h.displacement * high * 1f64.to_radians()];
                row.extend([h.kb + h.bm_t, h.kb + h.bm_l, change[0], change[1], h.wetted_area].map(Cell::from));
            }
        }
        push(&mut table, row);
    }
    Ok(dispose(job, table, span))
}

fn rarm(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let body = body(job, span)?;
    let told = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    let floating = Floating::of(&job.model, body).map_err(told)?;
    let weight = floating.mass.mass * job.model.defaults.gravity;
    let mut table = Table::new(format!("Righting Arms of {}", body.name)).fact("Weight", weight, Dim::Force);
    for (name, dim, digits) in [
        ("Roll", Dim::Angle, Digits::Usual),
        ("Arm", Dim::Length, Digits::Decimals(4)),
        ("Moment", Dim::Moment, Digits::Usual),
        ("Area", Dim::Length, Digits::Decimals(4)),
        ("Draft", Dim::Length, Digits::Usual),
        ("Trim", Dim::Angle, Digits::Usual),
    ] {
        table = table.column("", name, dim, digits);
    }
    let step = args.number(0).unwrap_or_default();
    let mut place = Place { turn: [0.0, 0.0, body.place.turn[2]], ..body.place };
    let (mut area, mut before) = (0.0, None);
    for n in 0..=args.integer(1).unwrap_or(1) {
        let roll = step * n as f64;
        place.turn[0] = roll;
        let found = match balanced(&floating, &place) {
            Ok(found) => found,
            Err(error) if n == 0 => return Err(told(error)),
            Err(error) => {
                table.note_absent(format!("{}: {}", body.name, error.text(job.units)));
                break;
            }
        };
        area += before.map_or(0.0, |arm: f64| 0.5 * (arm + found.arm) * step);
        before = Some(found.arm);
        place = found.place;
        let small = |x: f64| if x.abs() < 1e-9 { 0.0 } else { x };
        let row =
            [roll, small(found.arm), small(found.arm) * weight, small(area), -place.shift[2], small(place.turn[1])];
        push(&mut table, row.map(Cell::from).to_vec());
    }
    table.note("Area in length times radians; draft is that of the body's origin");
    Ok(dispose(job, table, span))
}
