//! `JUNCTION`: a point in the sea where lines meet.

use crate::commands::menu;
use crate::commands::model::loads::NO_WAVE_INERTIA;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::Dof;
use windlass_base::diagnostic::with_article;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::{Place, Position};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_language::name as rule;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Body, Junction, LoadKind, Lump, Model, Part, PartLoad, Point, Weight};

/// JUNCTION.
pub static JUNCTION: Command = Command { spec: &SPEC, edits: false, run };

/// Most junctions: a solution takes the cube of their number.
const MAX_JUNCTIONS: usize = 200;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}

const WEIGHT: OptionSpec =
    OptionSpec::new("-WEIGHT", &[number("W", Dim::Force, "weight in air").not_negative()], "weight of what is there")
        .default("0");
const DISPLACEMENT: OptionSpec = OptionSpec::new(
    "-DISPLACEMENT",
    &[number("B", Dim::Force, "buoyancy when it is all under water").not_negative()],
    "a buoy: a sphere of this largest buoyancy",
)
.default("0");

const DRAG: OptionSpec = OptionSpec::new(
    "-DRAG",
    &[number("CDA", Dim::Area, "drag coefficient times area, alike in all directions").not_negative()],
    "drag of the water that moves past it",
)
.default("none");
const ADDED_MASS: OptionSpec = OptionSpec::new(
    "-AMASS",
    &[number("CA", Dim::None, "coefficient, on the mass of water of -DISPLACEMENT").not_negative()],
    "added mass",
)
.default("none");
const FORCE: OptionSpec = OptionSpec::new(
    "-FORCE",
    &[
        number("FX", Dim::Force, "along global x"),
        number("FY", Dim::Force, "along global y"),
        number("FZ", Dim::Force, "upward"),
    ],
    "a constant force on it",
)
.default("none");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::New), "its name"),
        number("X", Dim::Length, "global X where it begins").or("0"),
        number("Y", Dim::Length, "global Y").or("0"),
        number("Z", Dim::Length, "global Z, negative below the surface").or("0"),
    ],
    options: &[WEIGHT, DISPLACEMENT, DRAG, ADDED_MASS, NO_WAVE_INERTIA, FORCE],
    detail: "A point with three degrees of freedom that &EQUI solves with the bodies: the knot of a bridle or a Y-line, a buoy between two \
             lines, a clump weight where three meet. It makes the point *NAME, which connectors name as any other; lines between it and a \
             body or another junction are H_CAT, its lines to anchors B_CAT. X Y Z is where the solution begins; &INSTATE moves it by \
             its NAME. The sea bottom carries it within 10 mm of the depth of &ENV, without friction. The sphere of \
             -DISPLACEMENT floats with as much of it under water as it needs. -DRAG and -AMASS act as those of #LUMP: in current, on its own motion, and \
             in waves in TDOM.",
    example: "&ENV -DEPTH 100\nMEDIT\n*A 0 0 10\nJUNCTION KNOT 60 0 -60 -WEIGHT 5\n~UP H_CAT 3 EXACT -LEN 95\n~LEG B_CAT 3 EXACT -LEN 250\n\
              CONNECTOR UP ~UP *A *KNOT\nCONNECTOR L1 -ANC 30 230 ~LEG *KNOT\nCONNECTOR L2 -ANC -30 230 ~LEG *KNOT\nEND\n&EQUI\n&STATUS F_CONNECTOR",
    ..CommandSpec::new("JUNCTION", "a point in the sea where lines meet")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = SPEC.word("NAME");
    let args = &call.args;
    let name = args.word(NAME).unwrap_or_default();
    let at = args.numbers_or_zero(const { SPEC.numbers(["X", "Y", "Z"]) });
    let displacement = args.option_number(&DISPLACEMENT).unwrap_or(0.0);
    let weight = args.option_number(&WEIGHT).unwrap_or(0.0);
    let [area, added] = [DRAG, ADDED_MASS].map(|option| args.option_number(&option).unwrap_or(0.0));
    if let Some(given) = args.option(&ADDED_MASS).filter(|_| displacement == 0.0 && added > 0.0) {
        let text = "-AMASS without -DISPLACEMENT is none: the added mass is a share of the displaced water";
        return Err(Diagnostic::error(text, given.span));
    }
    free(&job.model, name, "junction", args.position(NAME))?;
    insert(&mut job.model, name, at, [weight, displacement], args.position(NAME));
    if area > 0.0 || added > 0.0 {
        let volume = displacement / (job.model.defaults.water_density * job.model.defaults.gravity);
        let (drag_areas, added) = ([area; 3], [added; 3]);
        let ignores_water_acceleration = args.has(&NO_WAVE_INERTIA);
        let lump = Lump { volume, drag_areas, added, ignores_water_acceleration, ..Lump::default() };
        job.model.loads.push(PartLoad::at_origin(name, LoadKind::Lump(lump), args.span));
    }
    if let Some(given) = args.option(&FORCE) {
        let force = given.numbers_or_zero(const { FORCE.numbers(["FX", "FY", "FZ"]) });
        let load = PartLoad::at_origin(name, LoadKind::Force(force), given.span);
        job.model.loads.push(load);
    }
    job.note_name(name, args.position(NAME));
    Ok(Effect::Done)
}

/// Sees that a junction, or what makes one, may have a name.
///
/// # Errors
/// A name that is none or is taken, also that of its point; too many junctions.
pub(crate) fn free(model: &Model, name: &str, what: &str, span: Span) -> Outcome<()> {
    rule::check(name, None, what, span)?;
    model.free_name(name, &[], span)?;
    let point = format!("*{name}");
    if let Some(old) = model.points.get(&Model::key(&point)) {
        return Err(Diagnostic::error(format!("there is a point {point} already"), span)
            .other(old.span, "defined here")
            .help(format!("{} makes the point of its name", with_article(what))));
    }
    if model.bodies.values().filter(|b| b.junction.is_some()).count() >= MAX_JUNCTIONS {
        return Err(Diagnostic::error(format!("a model has at most {MAX_JUNCTIONS} junctions and hooks"), span));
    }
    Ok(())
}

/// Adds a junction at a place (m), with its weight and displacement (N) and its point.
pub(crate) fn insert(model: &mut Model, name: &str, at: Position, [weight, displacement]: [f64; 2], span: Span) {
    let key = Model::key(name);
    let point = format!("*{name}");
    let [x, y, z] = at;
    let volume = displacement / (model.defaults.water_density * model.defaults.gravity);
    let weights = if weight > 0.0 { vec![Weight { weight, span, ..Weight::default() }] } else { Vec::new() };
    let position = Place::new([x, y, z, 0.0, 0.0, 0.0]);
    let body = Body {
        name: name.to_string(),
        position,
        previous: position,
        ignored: vec![Dof::Rx, Dof::Ry, Dof::Rz],
        junction: Some(Junction { displacement, volume }),
        linear: None,
        database: None,
        prescribed: None,
        span,
    };
    let part = Part { weights, ..Part::new(name, name, Place::default(), span) };
    model.bodies.insert(key.clone(), body);
    model.parts.insert(key, part);
    let made = Point { name: point.clone(), part: name.to_string(), at: [0.0; 3], interest: None, span };
    model.points.insert(Model::key(&point), made);
}
