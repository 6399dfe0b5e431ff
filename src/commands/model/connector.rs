//! `CONNECTOR`.

use crate::commands::menu;
use crate::commands::model::tether_ends as tether;
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::unit_vector;
use windlass_base::pose::Pose;
use windlass_base::spec::ValueKey;
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_language::name as rule;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Anchor, Connector, Model, Point, SolveKind, Tug, UnmodelledEffect, find};

/// CONNECTOR.
pub static CONNECTOR: Command = Command { spec: &CONNECTOR_SPEC, edits: false, run: connector };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const OFFSET: &[ValueSpec] =
    &[number("X", Dim::Length, "offset"), number("Y", Dim::Length, "offset"), number("Z", Dim::Length, "offset")];

const ANCHOR: OptionSpec = OptionSpec::new(
    "-ANCHOR",
    &[
        number("THET", Dim::Angle, "direction from the fairlead, from +X toward +Y"),
        number("DTA", Dim::Length, "horizontal distance from fairlead to anchor").not_negative(),
    ],
    "where the anchor lies, in the present configuration",
);
const TUG: OptionSpec = OptionSpec::new(
    "-TUG",
    &[
        number("ANG", Dim::Angle, "direction it pulls toward, from +X toward +Y"),
        number("DIST", Dim::Length, "distance of the tug, where it is drawn").not_negative(),
    ],
    "where the tug of a TUG_BOAT is",
);
const GO1: OptionSpec = OptionSpec::new("-GO1", OFFSET, "offset of the first end from its point");
const GO2: OptionSpec = OptionSpec::new("-GO2", OFFSET, "offset of the second end from its point");
const EULER: OptionSpec = OptionSpec::new(
    "-EULER",
    &[number("RX", Dim::Angle, "about X"), number("RY", Dim::Angle, "about Y"), number("RZ", Dim::Angle, "about Z")],
    "angles of the element axes",
)
.default("body axes of the first node");

static CONNECTOR_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the connector"),
        ValueSpec::new("~CLASS", Kind::Name(Noun::Class), "its class"),
        ValueSpec::new("*N1", Kind::Name(Noun::Point), "its first point: the fairlead"),
        ValueSpec::new("*N2", Kind::Name(Noun::Point), "its second point").or("ground"),
    ],
    options: &[
        ANCHOR,
        TUG,
        GO1,
        GO2,
        EULER,
        tether::INSTALLED,
        tether::TOWED,
        tether::V_SPRINGS,
        tether::A_SPRINGS,
        tether::V_MOORING,
        tether::A_MOORING,
        tether::CAPS,
        tether::FLUID,
        tether::IMPACT,
        tether::LOW_STOP,
        tether::CONSTRAINT,
        tether::GROUP,
        tether::GIVEN,
    ],
    detail: "With one point the other end is ground. A tether (class type TETHER) goes from the vessel to its anchor or, towed, to \
             its trailing end. In INMODEL the names may be defined later. No body, part, curve or \
             environment has the name of a connector: DELETE NAME means one thing.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*MLA 400 50 20\n~WIRE b_cat 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC -45 20 ~WIRE *MLA\nEND\n&STATUS G_CONNECTOR",
    ..CommandSpec::new("CONNECTOR", "connects a point to ground or two points")
};

const NAME: DatumKey<str> = CONNECTOR_SPEC.word("NAME");
const CLASS: DatumKey<str> = CONNECTOR_SPEC.word("~CLASS");

fn connector(job: &mut Job, call: &Call) -> Outcome<Effect> {
    rule::check(call.args.word(NAME).unwrap_or_default(), None, "connector", call.args.position(NAME))?;
    if matches!(job.menu(), Menu::Inmodel) {
        job.deferred.push(call.args.clone());
        return Ok(Effect::Done);
    }
    build_connector(job, &call.args)?;
    Ok(Effect::Done)
}

/// Makes a connector of a record whose names are all defined.
///
/// # Errors
/// Unknown names, a class that is not complete, ends that do not fit the class, a name that is taken.
pub fn build_connector(job: &mut Job, args: &Args) -> Outcome<()> {
    let name = args.word(NAME).unwrap_or_default();
    let class = Model::key(args.word(CLASS).unwrap_or_default());
    if let Some(effect) = job.absent_classes.get(&class).filter(|_| !job.model.classes.contains_key(&class)) {
        let record = format!("CONNECTOR {name} of class {}", args.word(CLASS).unwrap_or_default());
        let effect = effect.unwrap_or("what a connector of structural sections does").to_string();
        let (matters_to, span) = (SolveKind::Statics, args.position(CLASS));
        job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to, span });
        return Ok(());
    }
    let model = &job.model;
    if let Some(old) = model.connectors.get(&Model::key(name)) {
        return Err(Diagnostic::error(format!("connector {name} exists already"), args.position(NAME))
            .other(old.span, "defined here")
            .help(format!("DELETE {name} first, or use another name")));
    }
    model.free_name(name, &[], args.position(NAME))?;
    let class = find(&model.classes, args.word(CLASS).unwrap_or_default(), "class", args.position(CLASS))?;
    let mut points = Vec::new();
    let mut on_bodies = 0;
    for value in args.data_after(CLASS) {
        let Some(word) = value.word() else { continue };
        let point = find(&model.points, word, "point", value.span)?;
        if points.iter().any(|p: &&Point| p.name == point.name) {
            return Err(Diagnostic::error(format!("{} cannot be both ends of a connector", point.name), value.span));
        }
        on_bodies += usize::from(model.body_of(point).is_some());
        points.push(point);
    }
    let vector = |option: &OptionSpec, keys: [ValueKey<f64>; 3]| {
        args.option(option).map_or([0.0; 3], |given| given.numbers_or_zero(keys))
    };
    let mut made = Connector {
        name: name.to_string(),
        class: class.name.clone(),
        points: points.iter().map(|p| p.name.clone()).collect(),
        anchor: None,
        tug: args.option(&TUG).map(|given| {
            let [direction, distance] = given.numbers_or_zero(const { TUG.numbers(["ANG", "DIST"]) });
            Tug { direction, distance }
        }),
        tether: tether::read(args)?,
        offsets: [
            vector(&GO1, const { GO1.numbers(["X", "Y", "Z"]) }),
            vector(&GO2, const { GO2.numbers(["X", "Y", "Z"]) }),
        ],
        defined: Default::default(),
        euler: args.has(&EULER).then(|| vector(&EULER, const { EULER.numbers(["RX", "RY", "RZ"]) })),
        first_length: None,
        dynamics: None,
        active: true,
        span: args.span,
    };
    let first = model.end_pose(&made, 0).unwrap_or_default();
    let ground = Pose { axes: Pose::default().axes, ..first };
    made.defined = [first, model.end_pose(&made, 1).unwrap_or(ground)];
    made.anchor = args.option(&ANCHOR).map(|given| {
        let [direction, distance] = given.numbers_or_zero(const { ANCHOR.numbers(["THET", "DTA"]) });
        let [x, y, _] = model.end(&made, 0).unwrap_or_default();
        let (cos, sin) = unit_vector(direction);
        Anchor { direction, distance, at: [x + distance * cos, y + distance * sin], elevation: None }
    });
    class.object.check()?;
    class.object.check_ends(&made, on_bodies)?;
    if made.tether.is_some() && class.tether_sections().is_empty() {
        let text = format!("{} is of class type {}, which is no tether", made.class, class.object.kind());
        return Err(
            Diagnostic::error(text, args.position(CLASS)).help("the options of tethers go with class type TETHER")
        );
    }
    let span = args.position(NAME);
    let held = |point: &Point| model.body_of(point).map_or("ground", |b| b.name.as_str()).to_string();
    if let [first, second] = points.as_slice()
        && held(first) == held(second)
    {
        let unless = ", unless ASSEMBLY makes it a span of a line over pulleys";
        let unless = if class.object.as_reeved().is_some() { unless } else { "" };
        let text = format!("connector {name} joins two points of {}: it moves nothing{unless}", held(first));
        job.warn(text, span);
    }
    job.model.connectors.insert(Model::key(name), made);
    crate::commands::environment::ambient_options::plane(job, name, span);
    job.note_name(name, span);
    Ok(())
}
