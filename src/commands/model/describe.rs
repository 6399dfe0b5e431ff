//! `&DESCRIBE`, points, and `&INSTATE`.

use crate::commands::chosen::NameFilter;
use crate::commands::menu;
use crate::commands::model::piece::{self, OPTIONS};
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::Dof;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::{Place, Position, unit_vector};
use windlass_base::units::Dim;
use windlass_base::values::{Given, Noun, Value};
use windlass_language::name as rule;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, TextForm, ValueSpec, join_options};
use windlass_model::{Body, Coordinates, EntityKind, GROUND, Model, Part, Point, Shape, find};

/// &DESCRIBE.
pub static DESCRIBE: Command = Command { spec: &DESCRIBE_SPEC, edits: false, run: describe };
/// *POINT.
pub static POINT: Command = Command { spec: &POINT_SPEC, edits: false, run: point };
/// &INSTATE.
pub static INSTATE: Command = Command { spec: &INSTATE_SPEC, edits: true, run: instate };

/// Most bodies [MOSES-REF bod_par].
const MAX_BODIES: usize = 50;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
/// X Y Z and roll, pitch, yaw.
pub(crate) const PLACE: [ValueSpec; 6] = [
    number("X", Dim::Length, "X").or("0"),
    number("Y", Dim::Length, "Y").or("0"),
    number("Z", Dim::Length, "Z").or("0"),
    number("RX", Dim::Angle, "roll").or("0"),
    number("RY", Dim::Angle, "pitch").or("0"),
    number("RZ", Dim::Angle, "yaw").or("0"),
];
const BODY: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Body), "body");
const LOCATION: &[ValueSpec] = &[BODY, PLACE[0], PLACE[1], PLACE[2], PLACE[3], PLACE[4], PLACE[5]];

const MOVE: OptionSpec = OptionSpec::new("-MOVE", &PLACE, "places a part in its body");
const IGNORE: OptionSpec = OptionSpec::new(
    "-IGNORE",
    &[ValueSpec::choice::<Dof>("DOF", "degree of freedom")],
    "degrees of freedom of a body left out",
)
.repeating(1);

/// What a body or a part takes.
const OWN: &[OptionSpec] = &[MOVE, IGNORE];
static DESCRIBE_OPTIONS: [OptionSpec; OWN.len() + OPTIONS.len()] = join_options(OWN, &OPTIONS);

choices! {
    /// What `&DESCRIBE` describes.
    enum Described {
        Body = "BODY",
        Part = "PART",
        Piece = "PIECE",
        Interest = "INTEREST",
    }
}

const KIND: DatumKey<Described> = DESCRIBE_SPEC.choice("KIND");
const NAME: DatumKey<str> = DESCRIBE_SPEC.word("NAME");

static DESCRIBE_SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::choice::<Described>("KIND", "what is described"),
        ValueSpec::new("NAME", Kind::Name(Noun::Selector), "its name; of INTEREST a point, a pattern or a selector"),
        ValueSpec::new("POINT", Kind::Name(Noun::Selector), "further points of INTEREST").or("none"),
    ],
    repeat: 1,
    options: &DESCRIBE_OPTIONS,
    detail: "Points that follow belong to the body or part described last. Describing a known body or part again goes on with it. PIECE \
             begins a surface: its PANEL records follow, or PGEN; it is complete at the next &DESCRIBE, PGEN or &SURFACE, and at END. \
             &HELP &SURFACE says how pieces are read, and what wind and current do to them: without -CS_WIND and -CS_CURRENT the shape \
             coefficients of a piece that displaces water are 1 1 1. INTEREST marks points, on bodies or in the ground, for POINTS of \
             PRCPOST, which reports their motion from where they stand now; marks add up.",
    example: "&DESCRIBE BODY TBRG\n&DESCRIBE PART DECK -MOVE 0 0 20\n&STATUS BODIES\nMEDIT\n*BOW 90 0 5\n&DESCRIBE INTEREST *BOW\n&DESCRIBE PIECE WEDGE -PERM 1\n\
              PANEL 0 0 0  0 9 0  9 0 0\nPANEL 0 0 0  9 0 0  0 0 9\nPANEL 0 0 0  0 0 9  0 9 0\nPANEL 9 0 0  0 9 0  0 0 9\nEND\n\
              &STATUS PIECES",
    ..CommandSpec::new("&DESCRIBE", "describes a body, a part or a piece")
};

static POINT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        number("X", Dim::Length, "x, or the radius").or("0"),
        number("Y", Dim::Length, "y (with &DEFAULT -CYLINDER or -SPHERICAL: the angle in degrees)").or("0"),
        number("Z", Dim::Length, "z (with -SPHERICAL: the angle above the plane)").or("0"),
    ],
    form: TextForm::Text,
    detail: "In the system of the part described last; before any &DESCRIBE a point belongs to GROUND, in the global system.",
    example: "MEDIT\n*MLA 400 50 20\nEND\n&STATUS POINTS",
    ..CommandSpec::new("*POINT", "X Y Z: defines a point")
};

const LOCATE: OptionSpec = OptionSpec::new("-LOCATE", LOCATION, "places a body").many();
const MOVE_BODY: OptionSpec = OptionSpec::new("-MOVE", LOCATION, "moves a body from where it is").many();
const CONDITION: OptionSpec = OptionSpec::new(
    "-CONDITION",
    &[
        BODY.or("the body described last"),
        number("DRAFT", Dim::Length, "draft of the body's origin below the mean surface").or("0"),
        number("ROLL", Dim::Angle, "roll").or("0"),
        number("TRIM", Dim::Angle, "trim: the pitch").or("0"),
    ],
    "sets draft, roll and trim of a body",
)
.many();
const PREVIOUS: OptionSpec = OptionSpec::new("-PREVIOUS", &[], "puts every body back to where it was before");

static INSTATE_SPEC: CommandSpec = CommandSpec {
    options: &[LOCATE, MOVE_BODY, CONDITION, PREVIOUS],
    detail: "Options act in the order given. Angles: yaw about Z, then pitch about Y, then roll about X, about the axes already turned. \
             -CONDITION leaves x, y and yaw; with x aft, y to starboard and z up a roll lifts the starboard side and a trim sinks the stern. \
             -MOVE adds to the six numbers of &STATUS CONFIGURATION, angles to angles, so that moving back by the same numbers restores them \
             to the digit; x, y, z are global. -PREVIOUS stands alone: it goes back to before the last &INSTATE or equilibrium, and given \
             again it returns.",
    example: "&DESCRIBE BODY TBRG\n&INSTATE -CONDITION 9 0 1\n&INSTATE -LOCATE TBRG 0 0 -9\n&INSTATE -MOVE TBRG 10\n&STATUS CONFIGURATION",
    ..CommandSpec::new("&INSTATE", "sets the initial configuration")
};

/// What a record goes on with.
#[derive(Clone, Copy, PartialEq)]
enum PartKind {
    Body,
    Part,
    Piece,
}

impl PartKind {
    fn name(self) -> &'static str {
        match self {
            PartKind::Body => "body",
            PartKind::Part => "part",
            PartKind::Piece => "piece",
        }
    }
}

fn describe(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let name = args.word(NAME).unwrap_or_default().to_string();
    let (key, span) = (Model::key(&name), args.place(NAME));
    let kind = match args.choice(KIND) {
        Some(Described::Body) => PartKind::Body,
        Some(Described::Part) => PartKind::Part,
        Some(Described::Piece) => PartKind::Piece,
        Some(Described::Interest) | None => return interest(job, call),
    };
    if let Some(surplus) = args.data_after(NAME).first() {
        return Err(Diagnostic::error("&DESCRIBE takes one name", surplus.span).help("only INTEREST takes several"));
    }
    let of = |given: &Given| match given {
        _ if given.is(&MOVE) => PartKind::Part,
        _ if given.is(&IGNORE) => PartKind::Body,
        _ => PartKind::Piece,
    };
    if let Some(given) = args.options.iter().find(|given| of(given) != kind) {
        let error = Diagnostic::error(format!("{} belongs to a {}", given.name(), of(given).name()), given.span);
        return Err(if of(given) == PartKind::Part && kind == PartKind::Body {
            error.help("&INSTATE -LOCATE places a body")
        } else {
            error
        });
    }
    if kind == PartKind::Piece {
        let piece = piece::begin_piece(job, args, &name, span, Shape::Panels(Vec::new()))?;
        piece::add(job, piece, false);
        return Ok(Effect::Done);
    }
    let model = &mut job.model;
    rule::check(&name, None, "body or part", span)?;
    if key == GROUND {
        return Err(
            Diagnostic::error(format!("`{name}` cannot name a body or part"), span).label("it is the ground's name")
        );
    }
    let mine: &[EntityKind] =
        if kind == PartKind::Body { &[EntityKind::Body] } else { &[EntityKind::Body, EntityKind::Part] };
    model.free_name(&name, mine, span)?;
    if kind == PartKind::Body {
        if !model.bodies.contains_key(&key) {
            if model.bodies.values().filter(|b| b.junction.is_none()).count() >= MAX_BODIES {
                return Err(Diagnostic::error(format!("a model has at most {MAX_BODIES} bodies"), span));
            }
            let place = Place::default();
            let (junction, linear) = (None, None);
            let body = Body {
                name: name.clone(),
                place,
                previous: place,
                ignored: Vec::new(),
                junction,
                linear,
                database: None,
                prescribed: None,
                span,
            };
            model.bodies.insert(key.clone(), body);
            model.parts.insert(key.clone(), Part::new(&name, &name, place, span));
        }
        if let (Some(given), Some(body)) = (args.option(&IGNORE), model.bodies.get_mut(&key)) {
            body.ignored = given.choices(const { IGNORE.choice("DOF") }).collect();
        }
    } else {
        let place = args.option(&MOVE).map(|g| place_of(&g.values));
        match model.parts.get_mut(&key) {
            Some(part) => part.place = place.unwrap_or(part.place),
            None => {
                let body = model
                    .current_part
                    .as_ref()
                    .and_then(|p| model.parts.get(&Model::key(p)))
                    .map(|p| p.body.clone())
                    .ok_or_else(|| Diagnostic::error("a part belongs to a body, and none is described yet", span))?;
                model.parts.insert(key, Part::new(&name, &body, place.unwrap_or_default(), span));
            }
        }
    }
    model.current_part = Some(name.clone());
    piece::finish_piece(job);
    job.note_name(&name, span);
    Ok(Effect::Done)
}

/// Marks points of interest where they stand.
fn interest(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    if let Some(given) = args.options.first() {
        return Err(Diagnostic::error(format!("{} does not belong to INTEREST", given.name()), given.span));
    }
    let marked: Vec<(String, Position)> = {
        let (model, chosen) = (&job.model, NameFilter::new(call.args.data_after(KIND), &job.model));
        let points = model.points.iter().filter(|(_, p)| chosen.takes(&p.name));
        let marked = points.map(|(key, point)| (key.clone(), model.global(point))).collect();
        chosen.check_used("the points", &[EntityKind::Point])?;
        marked
    };
    for (key, at) in marked {
        if let Some(point) = job.model.points.get_mut(&key) {
            point.interest = Some(at);
        }
    }
    Ok(Effect::Done)
}

fn place_of(values: &[Value]) -> Place {
    let numbers = values.iter().filter(|v| v.word().is_none()).map(|v| v.number().unwrap_or(0.0));
    let mut six = [0.0; 6];
    for (slot, value) in six.iter_mut().zip(numbers) {
        *slot = value;
    }
    Place::new(six)
}

fn point(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let [name, rest @ ..] = call.words else { return Ok(Effect::Done) };
    rule::check(&name.text, Some('*'), "point", name.span)?;
    let args = windlass_language::args::read(&POINT_SPEC, name.span, rest, job.units)?;
    let at = args.numbers_or_zero(const { POINT_SPEC.numbers(["X", "Y", "Z"]) });
    // the angles of the other modes are degrees, not lengths
    let direction = |value: f64| unit_vector(Dim::Length.from_si(value, job.units).to_radians());
    let [a, b, c] = at;
    let at = match job.model.defaults.coordinates {
        Coordinates::Rectangular => at,
        Coordinates::Cylindrical => {
            let (cos, sin) = direction(b);
            [a * cos, a * sin, c]
        }
        Coordinates::Spherical => {
            let ((cos, sin), (flat, up)) = (direction(b), direction(c));
            [a * flat * cos, a * flat * sin, a * up]
        }
    };
    let part = job.model.current_part.clone().unwrap_or_else(|| GROUND.to_string());
    let key = Model::key(&name.text);
    let interest = job.model.points.get(&key).and_then(|p| p.interest);
    let made = Point { name: name.text.to_string(), part, at, interest, span: name.span };
    if let Some(old) = job.model.points.insert(key, made) {
        let users = job.model.users_of_point(&name.text).len();
        job.remark(
            match users {
                0 => format!("point {} is redefined", old.name),
                n => format!("point {} is redefined; {n} connectors use it", old.name),
            },
            name.span,
        );
    }
    job.note_name(&name.text, name.span);
    Ok(Effect::Done)
}

fn instate(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let model = &mut job.model;
    let before: Vec<Place> = model.bodies.values().map(|b| b.place).collect();
    if let (Some(given), true) = (call.args.option(&PREVIOUS), call.args.options.len() > 1) {
        return Err(Diagnostic::error("-PREVIOUS stands alone", given.span));
    }
    for given in &call.args.options {
        let body = given
            .first_word()
            .map(|name| find(&model.bodies, name, "body", given.first_place()).map(|b| Model::key(&b.name)));
        match given {
            _ if given.is(&PREVIOUS) => {
                for body in model.bodies.values_mut() {
                    std::mem::swap(&mut body.place, &mut body.previous);
                }
                return Ok(Effect::Done);
            }
            _ if given.is(&CONDITION) => {
                let key = body.transpose()?.or_else(|| model.current_body().map(|b| Model::key(&b.name)));
                let body = key.and_then(|key| model.bodies.get_mut(&key)).ok_or_else(|| {
                    Diagnostic::error("no body is described yet", given.span).help("&DESCRIBE BODY describes one")
                })?;
                let from =
                    usize::from(given.first_word().is_some() || given.values.first().is_some_and(|v| !v.is_given()));
                let at = |i: usize| given.values.get(from + i).and_then(Value::number).unwrap_or(0.0);
                body.place.shift[2] = -at(0);
                body.place.turn = [at(1), at(2), body.place.turn[2]];
            }
            _ => {
                let Some(key) = body.transpose()? else { continue };
                let place = place_of(given.values.get(1..).unwrap_or_default());
                if let Some(body) = model.bodies.get_mut(&key) {
                    let values = body.place.values();
                    let moved = [0, 1, 2, 3, 4, 5].map(|i| values[i] + place.values()[i]);
                    body.place = if given.is(&LOCATE) { place } else { Place::new(moved) };
                }
            }
        }
    }
    for (body, place) in model.bodies.values_mut().zip(before) {
        body.previous = place;
    }
    Ok(Effect::Done)
}
