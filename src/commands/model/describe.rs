//! `&DESCRIBE`, points, and `&INSTATE`.

use crate::commands::menu;
use crate::commands::model::compartment;
use crate::commands::model::draft_mark;
use crate::commands::model::piece::{self, OPTIONS};
use crate::commands::model::process;
use crate::commands::model::sensor;
use crate::commands::name_filter::NameFilter;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::{Choice, Dof, YesNo};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::{Place, Position, unit_vector};
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::{Given, Noun, Value};
use windlass_language::name as rule;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, TextForm, ValueSpec, join_options};
use windlass_model::{Body, Coordinates, EntityKind, GROUND, LoadGroup, Model, Part, Point, Shape, find};

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
const PLACE_NAMES: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];
const BODY: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Body), "body");
const LOCATION: &[ValueSpec] = &[
    BODY.or("BODY of the record, else that described last"),
    PLACE[0],
    PLACE[1],
    PLACE[2],
    PLACE[3],
    PLACE[4],
    PLACE[5],
];

const MOVE: OptionSpec = OptionSpec::new("-MOVE", &PLACE, "places a part in its body");
const IGNORE: OptionSpec = OptionSpec::new(
    "-IGNORE",
    &[ValueSpec::choice::<Dof>("DOF", "degree of freedom")],
    "degrees of freedom of a body left out",
)
.repeating(1);

const ASSOCIATE: OptionSpec = OptionSpec::new(
    "-ASSOCIATE",
    &[ValueSpec::new("POINT", Kind::Name(Noun::Selector), "a point, a pattern or a selector").among(&[Noun::Point])],
    "the points of INTEREST",
)
.repeating(1);

const FUSE: &[ValueSpec] = &[ValueSpec::choice::<YesNo>("YES/NO", "YES or NO")];
const DAMP_FUSE: OptionSpec =
    OptionSpec::new("-DAMP_FUSE", FUSE, "of a load group: whether its damping is one matrix; the same on a rigid body");
const AMASS_FUSE: OptionSpec = OptionSpec::new(
    "-AMASS_FUSE",
    FUSE,
    "of a load group: whether its added mass is one matrix; the same on a rigid body",
);

const EVENTS: OptionSpec = OptionSpec::new("-EVENTS", &[], "of PROCESS: forgets its events (our reading)");

/// What a body, a part, INTEREST, a load group or PROCESS takes.
const OWN: &[OptionSpec] = &[MOVE, IGNORE, ASSOCIATE, DAMP_FUSE, AMASS_FUSE, EVENTS];
const OWN_AND_TANKS: [OptionSpec; OWN.len() + compartment::OWN.len()] = join_options(OWN, &compartment::OWN);
const OWN_AND_SENSORS: [OptionSpec; OWN_AND_TANKS.len() + sensor::OWN.len()] =
    join_options(&OWN_AND_TANKS, &sensor::OWN);
static DESCRIBE_OPTIONS: [OptionSpec; OWN_AND_SENSORS.len() + OPTIONS.len()] = join_options(&OWN_AND_SENSORS, &OPTIONS);

choices! {
    /// What `&DESCRIBE` describes.
    enum Described {
        Body = "BODY",
        Part = "PART",
        Piece = "PIECE",
        Interest = "INTEREST",
        DraftMark = "DMARK",
        Compartment = "COMPARTMENT",
        Hole = "HOLE",
        LoadGroup = "LOAD_GROUP",
        Load = "LOAD",
        Process = "PROCESS",
        Sensor = "SENSOR",
    }
}

const KIND: DatumKey<Described> = DESCRIBE_SPEC.choice("KIND");
const NAME: DatumKey<str> = DESCRIBE_SPEC.word("NAME");

static DESCRIBE_SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::choice::<Described>("KIND", "what is described"),
        ValueSpec::new("NAME", Kind::Name(Noun::Selector), "its name; of INTEREST a point, a pattern or a selector")
            .or("PIECE1, PIECE2 .. of a PIECE; not of INTEREST -ASSOCIATE nor of SENSOR -ON, -OFF and -DELETE; the others need one"),
        ValueSpec::new("POINT", Kind::Name(Noun::Selector), "further points of INTEREST; the two points of DMARK")
            .among(&[Noun::Point])
            .or("none"),
    ],
    repeat: 1,
    options: &DESCRIBE_OPTIONS,
    detail: "Points that follow belong to the body or part described last. Describing a known body or part again goes on with it. PIECE \
             begins a surface: its PANEL records follow, or PGEN; it is complete at the next &DESCRIBE, PGEN or &SURFACE, and at END. \
             &HELP &SURFACE says how pieces are read, and what wind and current do to them: without -CS_WIND and -CS_CURRENT the shape \
             coefficients of a piece that displaces water are 1 1 1. INTEREST marks points, on bodies or in the ground, for POINTS of \
             PRCPOST, which reports their motion from where they stand now; marks add up; -ASSOCIATE gives the points too. DMARK is a draft mark: the draft \
             is read along the line from its first point to its second one, from the first (our reading); PROCESS goes over to a process: each has places of bodies, activity, lengths and anchors of connectors, multipliers, an environment and \
             a run of its own, a new one those of the one before and no run; the first is DEFAULT, and TDOM -RESTART goes on from the run made last. &STATUS DRAFT reports a draft mark, -DRAFT of \
             &INSTATE sets it. LOAD_GROUP (or LOAD GROUP) NAME begins a group of loads of the \
             part: # records that follow belong to it, &APPLY -LOAD_GROUP multiplies it; every body and part has a group of its own name. COMPARTMENT NAME begins a compartment of the \
             part described last: pieces that follow bound it, with -PERMEABILITY -1 where none is given (-0.98: liquid fills 98 % of it). They take no wind, \
             current and waves and displace nothing; what is in them weighs (&COMPARTMENT). A NAME that is a part's is its exterior, the hull. HOLE NAME TYPE \
             describes a hole; &STATUS V_HOLES reports its height above the water. Water does not flow through holes: &COMPARTMENT -FLOOD opens a \
             compartment to the sea. SENSOR NAME -SIGNAL .. describes a sensor, which SENSOR of PRCPOST reports.",
    example: "&DESCRIBE BODY TBRG\nMEDIT\n*LOW 0 50 0\n*HIGH 0 50 20\nEND\n&DESCRIBE DMARK FWD_S *LOW *HIGH\n&STATUS DRAFT\n&DESCRIBE PART DECK -MOVE 0 0 20\n&STATUS BODIES\nMEDIT\n*BOW 90 0 5\n&DESCRIBE INTEREST *BOW\n&DESCRIBE PIECE WEDGE -PERM 1\n\
              PANEL 0 0 0  0 9 0  9 0 0\nPANEL 0 0 0  9 0 0  0 0 9\nPANEL 0 0 0  0 0 9  0 9 0\nPANEL 9 0 0  0 9 0  0 0 9\nEND\n\
              &STATUS PIECES",
    ..CommandSpec::new("&DESCRIBE", "describes a body, a part or a piece")
};

static POINT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT, &menu::BLOCK, &menu::MESH],
    data: &[
        number("X", Dim::Length, "x, or the radius").or("0"),
        number("Y", Dim::Length, "y (with &DEFAULT -CYLINDER or -SPHERICAL: the angle in degrees)").or("0"),
        number("Z", Dim::Length, "z (with -SPHERICAL: the angle above the plane)").or("0"),
    ],
    form: TextForm::Text,
    detail: "In the system of the part described last; before any &DESCRIBE, and after &DESCRIBE PART GROUND, a point belongs to the ground, in the global system.",
    example: "MEDIT\n*MLA 400 50 20\nEND\n&STATUS POINTS",
    ..CommandSpec::new("*POINT", "X Y Z: defines a point")
};

const LOCATE: OptionSpec = OptionSpec::new("-LOCATE", LOCATION, "places a body").many();
const MOVE_BODY: OptionSpec = OptionSpec::new("-MOVE", LOCATION, "moves a body from where it is").many();
const CONDITION: OptionSpec = OptionSpec::new(
    "-CONDITION",
    &[
        BODY.or("BODY of the record, else that described last"),
        number("DRAFT", Dim::Length, "draft of the body's origin below the mean surface").or("0"),
        number("ROLL", Dim::Angle, "roll").or("0"),
        number("TRIM", Dim::Angle, "trim: the pitch").or("0"),
    ],
    "sets draft, roll and trim of a body",
)
.many();
pub(super) const DRAFT: OptionSpec = OptionSpec::new(
    "-DRAFT",
    &[
        ValueSpec::new("DMARK", Kind::Name(Noun::Selector), "a draft mark").among(&[Noun::DraftMark]),
        number("DRAFT", Dim::Length, "the draft along it"),
    ],
    "brings the body of one to three draft marks to these drafts",
)
.repeating(2)
.many();
const TO_POINT: OptionSpec = OptionSpec::new(
    "-POINT",
    &[
        ValueSpec::new("*PT", Kind::Name(Noun::Point), "a point of the body"),
        number("X", Dim::Length, "global X").or("as it is"),
        number("Y", Dim::Length, "global Y").or("as it is"),
        number("Z", Dim::Length, "global Z").or("as it is"),
    ],
    "moves the body of a point, without turning it, until the point stands there",
)
.many();
const EVENT: OptionSpec = OptionSpec::new(
    "-EVENT",
    &[number("EVENT", Dim::Time, "time of the event").not_negative()],
    "puts the bodies where they were in the last run of TDOM, at the stored instant nearest to a time",
);
const PREVIOUS: OptionSpec = OptionSpec::new("-PREVIOUS", &[], "puts every body back to where it was before");

const INSTATE_BODY: DatumKey<str> = INSTATE_SPEC.word("BODY");

static INSTATE_SPEC: CommandSpec = CommandSpec {
    data: &[BODY.or("the body that each option names, else that described last")],
    options: &[LOCATE, MOVE_BODY, CONDITION, DRAFT, TO_POINT, EVENT, PREVIOUS],
    absent: &[("-SL_SET", "lengths of slings are found by ASSEMBLY T-H_DEFINITION, and set by &CONNECTOR -LENGTH")],
    detail: "Options act in the order given. &INSTATE BODY -CONDITION 9 is &INSTATE -CONDITION BODY 9. Angles: yaw about Z, then pitch about Y, then roll about X, about the axes already turned. \
             -CONDITION leaves x, y and yaw; with x aft, y to starboard and z up a roll lifts the starboard side and a trim sinks the stern. \
             -MOVE adds to the six numbers of &STATUS CONFIGURATION, angles to angles, so that moving back by the same numbers restores them \
             to the digit; x, y, z are global. What follows is our reading: -DRAFT changes the height at one mark, height and trim or roll \
             at two (as the marks are farther apart lengthwise or across), all three at three; an event of -EVENT is a time of the run. -PREVIOUS stands alone: it goes back to before the last &INSTATE or equilibrium, and given \
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
    Interest,
    LoadGroup,
    Process,
    Compartment,
    Hole,
    Sensor,
}

impl PartKind {
    fn name(self) -> &'static str {
        match self {
            PartKind::Body => "body",
            PartKind::Part => "part",
            PartKind::Piece => "piece",
            PartKind::Interest => "set of points of INTEREST",
            PartKind::LoadGroup => "load group",
            PartKind::Process => "process",
            PartKind::Compartment => "compartment",
            PartKind::Hole => "hole",
            PartKind::Sensor => "sensor",
        }
    }
}

fn describe(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let lacks_name = args.word(NAME).is_none();
    if let (true, Some(described)) = (
        lacks_name,
        args.choice::<Described>(KIND)
            .filter(|d| !matches!(d, Described::Piece | Described::Interest | Described::Sensor)),
    ) {
        return Err(Diagnostic::error(
            format!("&DESCRIBE {} lacks its value NAME", described.word()),
            args.position(KIND),
        ));
    }
    let name = args.word(NAME).map_or_else(|| piece::free_piece_name(&job.model), str::to_string);
    let (key, span) = (Model::key(&name), args.position(NAME));
    let kind = match args.choice(KIND) {
        Some(Described::Body) => PartKind::Body,
        Some(Described::Part) => PartKind::Part,
        Some(Described::Piece) => PartKind::Piece,
        Some(Described::Process) => {
            if let Some(given) = args.options.iter().find(|given| !given.is(&EVENTS)) {
                return Err(Diagnostic::error(format!("{} does not belong to PROCESS", given.name()), given.span));
            }
            process::describe(job, &name, span, args.has(&EVENTS))?;
            return Ok(Effect::Done);
        }
        Some(Described::Sensor) => {
            sensor::describe(job, args, args.word(NAME).map(|name| (name, span)), args.data_after(NAME))?;
            return Ok(Effect::Done);
        }
        Some(Described::Compartment) => PartKind::Compartment,
        Some(Described::Hole) => PartKind::Hole,
        Some(Described::DraftMark) => {
            if let Some(given) = args.options.first() {
                return Err(Diagnostic::error(format!("{} does not belong to DMARK", given.name()), given.span));
            }
            draft_mark::describe(job, &name, span, args.data_after(NAME))?;
            return Ok(Effect::Done);
        }
        Some(Described::LoadGroup | Described::Load) => return load_group(job, call),
        Some(Described::Interest) | None => return interest(job, call),
    };
    if let Some(surplus) = args.data_after(NAME).first().filter(|_| kind != PartKind::Hole) {
        return Err(Diagnostic::error("&DESCRIBE takes one name", surplus.span).help("only INTEREST takes several"));
    }
    let of = |given: &Given| match given {
        _ if given.is(&MOVE) => PartKind::Part,
        _ if given.is(&IGNORE) => PartKind::Body,
        _ if given.is(&ASSOCIATE) => PartKind::Interest,
        _ if given.is_any(&[DAMP_FUSE, AMASS_FUSE]) => PartKind::LoadGroup,
        _ if given.is(&EVENTS) => PartKind::Process,
        _ if given.is_any(&sensor::OWN) => PartKind::Sensor,
        _ if given.is_any(&compartment::OF_HOLE) => PartKind::Hole,
        _ if given.is_any(&compartment::OWN) => PartKind::Compartment,
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
    if kind == PartKind::Compartment {
        compartment::describe(job, args, &name, span)?;
        return Ok(Effect::Done);
    }
    if kind == PartKind::Hole {
        compartment::describe_hole(job, args, &name, span, args.data_after(NAME))?;
        return Ok(Effect::Done);
    }
    if kind == PartKind::Piece {
        let piece = piece::begin_piece(job, args, &name, span, Shape::Panels(Vec::new()))?;
        piece::add(job, piece, false);
        return Ok(Effect::Done);
    }
    let model = &mut job.model;
    rule::check(&name, None, "body or part", span)?;
    if key == GROUND {
        if let Some(given) = args.options.first() {
            return Err(Diagnostic::error(
                format!("{} does not belong to the ground, which is fixed", given.name()),
                given.span,
            ));
        }
        model.current_part = Some(GROUND.to_string());
        model.current_load_group = None;
        model.current_compartment = None;
        piece::finish_piece(job);
        return Ok(Effect::Done);
    }
    let mine: &[EntityKind] =
        if kind == PartKind::Body { &[EntityKind::Body] } else { &[EntityKind::Body, EntityKind::Part] };
    model.free_name(&name, mine, span)?;
    if kind == PartKind::Body {
        if !model.bodies.contains_key(&key) {
            if model.bodies.values().filter(|b| b.junction.is_none()).count() >= MAX_BODIES {
                return Err(Diagnostic::error(format!("a model has at most {MAX_BODIES} bodies"), span));
            }
            let position = Place::default();
            let (junction, linear) = (None, None);
            let body = Body {
                name: name.clone(),
                position,
                previous: position,
                ignored: Vec::new(),
                junction,
                linear,
                database: None,
                prescribed: None,
                span,
            };
            model.bodies.insert(key.clone(), body);
            model.parts.insert(key.clone(), Part::new(&name, &name, position, span));
        }
        if let (Some(given), Some(body)) = (args.option(&IGNORE), model.bodies.get_mut(&key)) {
            body.ignored = given.choices(const { IGNORE.choice("DOF") }).collect();
        }
    } else {
        let position = args.option(&MOVE).map(|g| Place::new(g.numbers_or_zero(const { MOVE.numbers(PLACE_NAMES) })));
        match model.parts.get_mut(&key) {
            Some(part) => part.position = position.unwrap_or(part.position),
            None => {
                let body = model
                    .current_part
                    .as_ref()
                    .and_then(|p| model.parts.get(&Model::key(p)))
                    .map(|p| p.body.clone())
                    .ok_or_else(|| Diagnostic::error("a part belongs to a body, and none is described yet", span))?;
                model.parts.insert(key, Part::new(&name, &body, position.unwrap_or_default(), span));
            }
        }
    }
    model.current_part = Some(name.clone());
    model.current_load_group = None;
    model.current_compartment = None;
    piece::finish_piece(job);
    job.note_name(&name, span);
    Ok(Effect::Done)
}

/// Begins a load group of the part described last: loads that follow belong to it.
fn load_group(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let mut rest = args.data_after(KIND).iter();
    if args.choice(KIND) == Some(Described::Load)
        && let Some(value) = rest.next().filter(|v| !v.word().is_some_and(|w| w.eq_ignore_ascii_case("GROUP")))
    {
        return Err(Diagnostic::error("expected GROUP after LOAD", value.span)
            .help("form: &DESCRIBE LOAD_GROUP NAME :NODES, or LOAD GROUP NAME :NODES"));
    }
    let Some((name, span)) = rest.next().and_then(|v| Some((v.word()?.to_string(), v.span))) else {
        return Err(Diagnostic::error("&DESCRIBE LOAD_GROUP lacks its value NAME", args.span));
    };
    rule::check(&name, None, "load group", span)?;
    if let Some(given) = args.options.iter().find(|given| !given.is_any(&[DAMP_FUSE, AMASS_FUSE])) {
        return Err(Diagnostic::error(format!("{} does not belong to LOAD_GROUP", given.name()), given.span));
    }
    let Some(part) = job.model.current_part.clone().filter(|part| Model::key(part) != GROUND) else {
        return Err(Diagnostic::error("a load group belongs to a part, and none is described yet", args.span)
            .help("&DESCRIBE BODY describes one"));
    };
    let values: Vec<&Value> = rest.collect();
    let nodes: Vec<String> = if values.is_empty() {
        Vec::new()
    } else {
        let chosen = NameFilter::new(values, &job.model);
        let points = job.model.points.values().filter(|p| chosen.matches(&p.name));
        let nodes: Vec<String> = points.map(|p| p.name.clone()).collect();
        chosen.check_used("the points", &[EntityKind::Point])?;
        nodes
    };
    let spans = nodes.iter().filter_map(|name| job.model.points.get(&Model::key(name)));
    if let Some(point) = spans.into_iter().find(|p| Model::key(&p.part) != Model::key(&part)) {
        return Err(Diagnostic::error(
            format!("load group {name} spans parts: {} is no point of part {part}", point.name),
            span,
        )
        .other(point.span, "defined here"));
    }
    let made = LoadGroup { name: name.clone(), part, nodes, span };
    job.model.load_groups.insert(Model::key(&name), made);
    job.model.current_load_group = Some(name);
    piece::finish_piece(job);
    Ok(Effect::Done)
}

/// Marks points of interest where they stand.
fn interest(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    if let Some(given) = args.options.iter().find(|given| !given.is(&ASSOCIATE)) {
        return Err(Diagnostic::error(format!("{} does not belong to INTEREST", given.name()), given.span));
    }
    let named = args.data_after(KIND).iter().filter(|value| value.is_given());
    let associated = args.option(&ASSOCIATE).map_or(&[][..], |given| &given.values);
    let values: Vec<&Value> = named.chain(associated).collect();
    if values.is_empty() {
        return Err(Diagnostic::error("INTEREST lacks its points", args.position(KIND))
            .help("form: &DESCRIBE INTEREST *PT .. or &DESCRIBE INTEREST -ASSOCIATE :SEL .."));
    }
    let marked: Vec<(String, Position)> = {
        let (model, chosen) = (&job.model, NameFilter::new(values, &job.model));
        let points = model.points.iter().filter(|(_, p)| chosen.matches(&p.name));
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
        Coordinates::Placed(position) => position.apply(at),
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

/// Moves the body of a point until the point stands at the coordinates given.
fn move_point(model: &mut Model, given: &Given) -> Outcome<()> {
    const POINT: ValueKey<str> = TO_POINT.word("*PT");
    let position = given.position(POINT);
    let point = find(&model.points, given.word(POINT).unwrap_or_default(), "point", position)?;
    let now = model.global(point);
    let body = model.body_of(point).map(|b| Model::key(&b.name));
    let wrong = || Diagnostic::error(format!("{} is on no body", point.name), position);
    let body = body.ok_or_else(wrong)?;
    let wanted = const { TO_POINT.numbers(["X", "Y", "Z"]) }.map(|key| given.number(key));
    if let Some(body) = model.bodies.get_mut(&body) {
        for ((shift, now), wanted) in body.position.shift.iter_mut().zip(now).zip(wanted) {
            *shift += wanted.map_or(0.0, |wanted| wanted - now);
        }
    }
    Ok(())
}

fn instate(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let before: Vec<Place> = job.model.bodies.values().map(|b| b.position).collect();
    if let (Some(given), true) = (call.args.option(&PREVIOUS), call.args.options.len() > 1) {
        return Err(Diagnostic::error("-PREVIOUS stands alone", given.span));
    }
    for given in &call.args.options {
        let model = &mut job.model;
        let body = || -> Outcome<String> {
            let named = given.first_word().map(|name| (name, given.first_place()));
            let own = call.args.word(INSTATE_BODY).map(|name| (name, call.args.position(INSTATE_BODY)));
            match named.or(own) {
                Some((name, span)) => find(&model.bodies, name, "body", span).map(|b| Model::key(&b.name)),
                None => model.current_body().map(|b| Model::key(&b.name)).ok_or_else(|| {
                    Diagnostic::error("no body is described yet", given.span).help("&DESCRIBE BODY describes one")
                }),
            }
        };
        match given {
            _ if given.is(&PREVIOUS) => {
                for body in model.bodies.values_mut() {
                    std::mem::swap(&mut body.position, &mut body.previous);
                }
                return Ok(Effect::Done);
            }
            _ if given.is(&DRAFT) => draft_mark::set_drafts(model, given)?,
            _ if given.is(&TO_POINT) => move_point(model, given)?,
            _ if given.is(&EVENT) => {
                let time = given.first_number().unwrap_or_default();
                if let Some(checking) = &mut job.checking
                    && checking.solved
                {
                    checking.hangs_on_result = true;
                    continue;
                }
                job.take_state(time).and_then(|state| state.put(&mut job.model)).ok_or_else(|| {
                    Diagnostic::error("there is no run of these bodies to take an event of", given.span)
                })?;
            }
            _ if given.is(&CONDITION) => {
                let key = body()?;
                let [draft, roll, trim] = given.numbers_or_zero(const { CONDITION.numbers(["DRAFT", "ROLL", "TRIM"]) });
                if let Some(body) = model.bodies.get_mut(&key) {
                    body.position.shift[2] = -draft;
                    body.position.turn = [roll, trim, body.position.turn[2]];
                }
            }
            _ => {
                // -MOVE of a body has the values of -LOCATE
                let position = Place::new(given.numbers_or_zero(const { LOCATE.numbers(PLACE_NAMES) }));
                let key = body()?;
                if let Some(body) = model.bodies.get_mut(&key) {
                    let values = body.position.values();
                    let moved = [0, 1, 2, 3, 4, 5].map(|i| values[i] + position.values()[i]);
                    body.position = if given.is(&LOCATE) { position } else { Place::new(moved) };
                }
            }
        }
    }
    for (body, position) in job.model.bodies.values_mut().zip(before) {
        body.previous = position;
    }
    Ok(Effect::Done)
}
