//! &ACTION: what happens during a run.

use crate::commands::model::alter::select_connectors;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::Dof;
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given};
use windlass_language::name as rule;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Model, PIPE, find, line_name};
use windlass_solve::time::{Action, ActionKind, Observable, Trigger};

/// &ACTION.
pub static ACTION: Command = Command { spec: &SPEC, edits: false, run };

const LINE: ValueSpec = ValueSpec::new("LINE", Kind::Name(Noun::Line), "connector, or &PIPE");
const FORCE: ValueSpec = ValueSpec::new(
    "F",
    Kind::Number(Dim::Force),
    "tension at its first end, negative where it pushes; of a pipe at its tensioner or first davit",
);
const BODY: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Body), "body");
const DOF: ValueSpec =
    ValueSpec::choice::<Dof>("DOF", "degree of freedom of its origin, roll, pitch and yaw as RX RY RZ");
const LIMIT: ValueSpec = ValueSpec::new("V", Kind::Number(Dim::None), "a length, or an angle in degrees");
const POINT: ValueSpec = ValueSpec::new("*PT", Kind::Name(Noun::Point), "point of a body");
const HEIGHT: ValueSpec = ValueSpec::new("Z", Kind::Number(Dim::Length), "height above the mean water level");
const LINES: &[ValueSpec] =
    &[ValueSpec::new(":SEL", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector])];

/// Options that say when.
const WHEN: [OptionSpec; 7] = [AT, TENSION, SLACK, ABOVE, BELOW, HIGH, LOW];
/// Options that say what.
const WHAT: [OptionSpec; 5] = [RELEASE, ACTIVATE, WINCH, ENVIRONMENT, STOP];

const AT: OptionSpec =
    OptionSpec::new("-AT", &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").not_negative()], "at a time");
const TENSION: OptionSpec = OptionSpec::new("-TENSION", &[LINE, FORCE], "when the tension of a line is first above F");
const SLACK: OptionSpec = OptionSpec::new("-SLACK", &[LINE, FORCE], "when the tension of a line is first below F");
const ABOVE: OptionSpec =
    OptionSpec::new("-ABOVE", &[BODY, DOF, LIMIT], "when a body degree of freedom first exceeds V");
const BELOW: OptionSpec =
    OptionSpec::new("-BELOW", &[BODY, DOF, LIMIT], "when a body degree of freedom first falls below V");
const HIGH: OptionSpec = OptionSpec::new("-HIGH", &[POINT, HEIGHT], "when a point is first higher than Z");
const LOW: OptionSpec = OptionSpec::new("-LOW", &[POINT, HEIGHT], "when a point is first lower than Z");
const AFTER: OptionSpec = OptionSpec::new(
    "-AFTER",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").not_negative()],
    "a condition is looked for from this time on",
)
.default("from the start");
const RELEASE: OptionSpec =
    OptionSpec::new("-RELEASE", LINES, "connectors act no more: they break or are let go").repeating(1);
const ACTIVATE: OptionSpec = OptionSpec::new("-ACTIVATE", LINES, "connectors that are inactive act").repeating(1);
const WINCH: OptionSpec = OptionSpec::new(
    "-WINCH",
    &[
        ValueSpec::new(":SEL", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector]),
        ValueSpec::new("RATE", Kind::Number(Dim::Velocity), "length a second, positive pays out, 0 stops it"),
        ValueSpec::new("LENGTH", Kind::Number(Dim::Length), "length at which it stops").or("goes on").positive(),
    ],
    "the first segment of connectors gets longer or shorter",
);
const ENVIRONMENT: OptionSpec = OptionSpec::new(
    "-ENVIRONMENT",
    &[ValueSpec::new("NAME", Kind::Name(Noun::Environment), "environment")],
    "its wind, waves and current from then on; the water must be the same",
);
const STOP: OptionSpec = OptionSpec::new("-STOP", &[], "the run ends");
const DELETE: OptionSpec = OptionSpec::new("-DELETE", &[], "forgets the action");
const CLEAR: OptionSpec = OptionSpec::new("-CLEAR", &[], "forgets all actions");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the action").or("none: with -CLEAR")],
    options: &[
        AT,
        TENSION,
        SLACK,
        ABOVE,
        BELOW,
        HIGH,
        LOW,
        AFTER,
        RELEASE,
        ACTIVATE,
        WINCH,
        ENVIRONMENT,
        STOP,
        DELETE,
        CLEAR,
    ],
    detail: "Says what happens in runs of TDOM, from then on in every one; an action happens once a run. One option says when, one says \
             what. A time is met exactly: a step ends there. Conditions are checked after each step; the step is bisected to locate them \
             within 1/64 of it. Connectors that come to act are made between their ends as these stand at \
             the start of the run. One that is cut into \
             elements changes by half of one at most in a part of a step, of which there are as many as that takes, up to 1000.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 100 1 1 1\n\
              ~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&INSTATE -LOCATE CART 0.5 0 0\n&ENV -TIME 10 0.1\n\
              &ACTION BREAK -TENSION K 15 -RELEASE K\n&ACTION FAR -ABOVE CART X 3 -STOP\nTDOM\n&ACTION FAR -DELETE\n&ACTION -CLEAR",
    ..CommandSpec::new("&ACTION", "says what happens during a run, and when")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = SPEC.word("NAME");
    let args = &call.args;
    if args.has(&CLEAR) {
        job.actions.clear();
        return Ok(Effect::Done);
    }
    let name = args.word(NAME).unwrap_or_default();
    if name.is_empty() {
        return Err(
            Diagnostic::error("an action needs a name", args.span).help("form: &ACTION NAME -AT 100 -RELEASE A")
        );
    }
    if args.has(&DELETE) {
        let before = job.actions.len();
        job.actions.retain(|a| !a.name.eq_ignore_ascii_case(name));
        if job.actions.len() == before {
            let mut error = Diagnostic::error(format!("there is no action {name}"), args.position(NAME));
            error.help.extend(suggest(name, job.actions.iter().map(|a| a.name.as_str())));
            return Err(error);
        }
        return Ok(Effect::Done);
    }
    rule::check(name, None, "action", args.position(NAME))?;
    let mut when = parse_trigger(&job.model, single_option(args, &WHEN, "when it happens")?, job.units)?;
    if let Some(given) = args.option(&AFTER) {
        if matches!(when, Trigger::At(_)) {
            return Err(Diagnostic::error("-AFTER goes with a condition, and -AT is a time", given.span));
        }
        when = Trigger::After(given.number(const { AFTER.number("T") }).unwrap_or(0.0), Box::new(when));
    }
    let what = parse_action(&job.model, single_option(args, &WHAT, "what happens")?)?;
    job.actions.retain(|a| !a.name.eq_ignore_ascii_case(name));
    job.actions.push(Action { name: name.to_string(), when, what });
    Ok(Effect::Done)
}

/// The one option of a list that is given.
fn single_option<'a>(args: &'a Args, options: &[OptionSpec], of: &str) -> Outcome<&'a Given> {
    let mut given = args.options.iter().filter(|given| given.is_any(options));
    match (given.next(), given.next()) {
        (Some(one), None) => Ok(one),
        (Some(one), Some(other)) => {
            let text = format!("{} and {} both say {of}", one.name(), other.name());
            Err(Diagnostic::error(text, other.span).other(one.span, "first given here").help("give two actions"))
        }
        _ => Err(Diagnostic::error(format!("the action does not say {of}"), args.span)
            .help(options.iter().map(|option| option.name).collect::<Vec<_>>().join(", "))),
    }
}

fn parse_trigger(model: &Model, given: &Given, units: UnitSystem) -> Outcome<Trigger> {
    let position = given.first_place();
    let name = given.first_word().unwrap_or_default();
    let number = |key| given.number(key).unwrap_or(0.0);
    let line = || match model.assemblies.get(&Model::key(line_name(name))) {
        Some(pipe) if pipe.name == PIPE => Ok(Observable::Tension(pipe.name.clone())),
        _ => find(&model.connectors, name, "connector", position).map(|c| Observable::Tension(c.name.clone())),
    };
    let dof = || -> Outcome<(Observable, f64)> {
        let body = find(&model.bodies, name, "body", position)?;
        let dof: Dof = given.choice(const { ABOVE.choice("DOF") }).unwrap_or(Dof::X);
        let dim = if dof.is_rotation() { Dim::Angle } else { Dim::Length };
        Ok((Observable::Dof(body.name.clone(), dof.index()), dim.to_si(number(const { ABOVE.number("V") }), units)))
    };
    let point = || {
        let found = find(&model.points, name, "point", position)?;
        match model.body_of(found) {
            Some(_) => Ok(Observable::Height(found.name.clone())),
            None => Err(Diagnostic::error(format!("point {name} belongs to no body"), position)),
        }
    };
    Ok(match given {
        _ if given.is(&AT) => Trigger::At(number(const { AT.number("T") })),
        _ if given.is(&TENSION) => Trigger::Above(line()?, number(const { TENSION.number("F") })),
        _ if given.is(&SLACK) => Trigger::Below(line()?, number(const { SLACK.number("F") })),
        _ if given.is(&ABOVE) => dof().map(|(watched, value)| Trigger::Above(watched, value))?,
        _ if given.is(&BELOW) => dof().map(|(watched, value)| Trigger::Below(watched, value))?,
        _ if given.is(&HIGH) => Trigger::Above(point()?, number(const { HIGH.number("Z") })),
        _ => Trigger::Below(point()?, number(const { LOW.number("Z") })),
    })
}

fn parse_action(model: &Model, given: &Given) -> Outcome<ActionKind> {
    let names = |count: usize| -> Outcome<Vec<String>> {
        let keys = select_connectors(model, given.values.get(..count).unwrap_or(&given.values))?;
        Ok(keys.iter().filter_map(|k| model.connectors.get(k)).map(|c| c.name.clone()).collect())
    };
    Ok(match given {
        _ if given.is(&RELEASE) => ActionKind::Release(names(usize::MAX)?),
        _ if given.is(&ACTIVATE) => ActionKind::Activate(names(usize::MAX)?),
        _ if given.is(&WINCH) => {
            let [rate, length] = const { WINCH.numbers(["RATE", "LENGTH"]) };
            ActionKind::Winch(names(1)?, given.number(rate).unwrap_or(0.0), given.number(length))
        }
        _ if given.is(&ENVIRONMENT) => {
            let (name, position) = (given.first_word().unwrap_or_default(), given.first_place());
            ActionKind::Environment(find(&model.environments, name, "environment", position)?.name.clone())
        }
        _ => ActionKind::Stop,
    })
}
