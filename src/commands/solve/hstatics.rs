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
use windlass_hydro::{Floating, Hull, Tank, balance_heave_and_trim, laden_mass};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Body, SolveKind, find};

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
/// TANK_CAPACITY.
pub static TANK_CAPACITY: Command = Command { spec: &CAPACITY_SPEC, edits: false, run: tank_capacity };

const ROLL: OptionSpec =
    OptionSpec::new("-ROLL", &[ValueSpec::new("A", Kind::Number(Dim::Angle), "roll")], "roll of the body").default("0");
const PITCH: OptionSpec =
    OptionSpec::new("-PITCH", &[ValueSpec::new("A", Kind::Number(Dim::Angle), "pitch")], "pitch of the body")
        .default("0");

static CAPACITY_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("TNAME", Kind::Text, "the compartment"),
        ValueSpec::new("INC", Kind::Number(Dim::Length), "step of the sounding").positive(),
    ],
    options: &[ROLL, PITCH],
    detail: "What a compartment holds by its sounding, from the bottom of its tube to its top, in the attitude given. Weights are of the liquid that is in it. \
             Centres are in the system of the body; the second moments of the surface are about axes through its centroid. The result goes to the \
             disposition menu.",
    example: "&DESCRIBE BODY TBRG\nMEDIT\n&DESCRIBE COMPARTMENT T1\nPGEN\nPLANE 10 60 -RECT 1 19 90\nEND\nEND\nHSTATICS\nTANK_CAPACITY T1 3\nREPORT\nEND\nEND",
    ..CommandSpec::new("TANK_CAPACITY", "what a compartment holds by its sounding")
};

static RARM_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HSTATICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("INC", Kind::Number(Dim::Angle), "step of roll"),
        ValueSpec::new("NUM", Kind::Integer, "number of steps").in_range(1.0, MAX_ROWS),
    ],
    detail: "Righting arms of the body rolled from upright in steps, heave and trim balanced under weight, contents of \
             compartments and buoyancy; free surfaces are exact at every angle. The arm is positive where it turns the body back from a positive roll. Area is that under the arm from upright, by \
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
    let mass = laden_mass(&job.model, body).map_err(to_error)?;
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

fn tank_capacity(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const TANK: DatumKey<str> = CAPACITY_SPEC.word("TNAME");
    const STEP: DatumKey<f64> = CAPACITY_SPEC.number("INC");
    let (args, span) = (&call.args, call.args.span);
    let model = &job.model;
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    let compartment = find(&model.compartments, args.word(TANK).unwrap_or_default(), "compartment", args.place(TANK))?;
    let tank = Tank::new(model, compartment).map_err(to_error)?;
    let turn = [args.option_number(&ROLL).unwrap_or(0.0), args.option_number(&PITCH).unwrap_or(0.0), 0.0];
    let pose = Pose::from_place(&Place { turn, ..Place::default() });
    let tube = tank.sounding_tube(model, compartment);
    let [top, bottom] = tube.map(nalgebra::Vector3::from);
    let (length, step) = ((top - bottom).norm(), args.number(STEP).unwrap_or(1.0));
    if length / step > MAX_ROWS {
        return Err(Diagnostic::error(format!("more than {MAX_ROWS} steps"), args.place(STEP)));
    }
    let mut soundings: Vec<f64> =
        (0..).map(|n| f64::from(n) * step).take_while(|s| *s < length * (1.0 - 1e-9)).collect();
    soundings.push(length);
    let at = |sounding: &f64| {
        let volume = tank.volume_at(&pose, tube, *sounding).ok_or_else(|| {
            windlass_model::ClassError::new(format!(
                "the sounding tube of {} lies level in this attitude",
                compartment.name
            ))
        })?;
        Ok((*sounding, tank.liquid_of(&pose, volume)?))
    };
    let rows = soundings.iter().map(at).collect::<Result<Vec<_>, _>>().map_err(to_error)?;
    let weight = tank.density() * model.defaults.gravity;
    let centre = |liquid: &windlass_hydro::Liquid| {
        let found = liquid.centroid().map(|c| pose.axes.transpose() * c);
        found.map_or([None; 3], |c| [c.x, c.y, c.z].map(|x| Some(if x.abs() < 1e-9 { 0.0 } else { x })))
    };
    let fourth = Dim::Derived { force: 0, length: 4, seconds: 0 };
    let table = Table::new(format!("Capacity of {}", compartment.name))
        .fact("Roll", turn[0], Dim::Angle)
        .fact("Pitch", turn[1], Dim::Angle)
        .with_rows(&rows)
        .column("", "Sounding", Dim::Length, Digits::Usual, |(sounding, _)| *sounding)
        .column("", "% Full", Dim::None, Digits::Decimals(2), |(_, l)| 100.0 * l.volume() / tank.capacity)
        .column("", "Volume", Dim::Volume, Digits::Usual, |(_, l)| l.volume())
        .column("", "Weight", Dim::Force, Digits::Usual, |(_, l)| l.volume() * weight)
        .columns("Center", ["X", "Y", "Z"], Dim::Length, Digits::Usual, |(_, l)| centre(l))
        .columns("Free Surface", ["Trans.", "Long."], fourth, Digits::Usual, |(_, l)| {
            l.surface_inertia(&pose).map(Some)
        })
        .build();
    Ok(dispose(job, table, span))
}

fn rarm(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    let body = body(job, span)?;
    let to_error = |e: windlass_model::ClassError| e.diagnostic(span, job.units);
    job.model.check_effects(SolveKind::Statics).map_err(to_error)?;
    let floating = Floating::at_rest(&job.model, body).map_err(to_error)?;
    let dry = floating.mass.mass * job.model.defaults.gravity;
    let mut table = Table::new(format!("Righting Arms of {}", body.name)).fact("Weight", dry, Dim::Force);
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
        rows.push((roll, found, area));
    }
    table.add_notes(job.model.caveats());
    table.note("Area in length times radians; draft is that of the body's origin");
    let small = |x: f64| if x.abs() < 1e-9 { 0.0 } else { x };
    let table = table
        .with_rows(&rows)
        .column("", "Roll", Dim::Angle, Digits::Usual, |(roll, ..)| *roll)
        .column("", "Arm", Dim::Length, Digits::Decimals(4), |(_, found, _)| small(found.arm))
        .column("", "Moment", Dim::Moment, Digits::Usual, |(_, found, _)| small(found.arm) * found.weight)
        .column("", "Area", Dim::Length, Digits::Decimals(4), |(_, _, area)| small(*area))
        .column("", "Draft", Dim::Length, Digits::Usual, |(_, found, _)| -found.place.shift[2])
        .column("", "Trim", Dim::Angle, Digits::Usual, |(_, found, _)| small(found.place.turn[1]))
        .build();
    Ok(dispose(job, table, span))
}
