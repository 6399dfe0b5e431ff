//! The PRCPOST menu: tables of the last run.
//!
//! Source: [MOSES-REF ppo_conn, ppo_bodies, ppo_afor]. In MOSES the events of a run are times, its increment is one of time, and what lies between
//! two stored instants is on the straight line between them.

use crate::commands::chosen::{NameFilter, note_caveats};
use crate::commands::menu;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use windlass_base::choice::YesNo;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Value};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{EntityKind, Model};
use windlass_solve::SolveError;
use windlass_solve::results::{self, EventWindow, Magnitude, MotionOptions, RunEvent, TrackedPoint};
use windlass_solve::time::Run;

/// TRAJECTORY.
pub static TRAJECTORY: Command = Command { spec: &TRAJECTORY_SPEC, edits: false, run: trajectory };
/// POINTS.
pub static POINTS: Command = Command { spec: &POINTS_SPEC, edits: false, run: points };
/// CONFORCE.
pub static CONFORCE: Command = Command { spec: &CONFORCE_SPEC, edits: false, run: conforce };
/// CF_MAGNITUDE.
pub static CF_MAGNITUDE: Command = Command { spec: &CF_MAGNITUDE_SPEC, edits: false, run: cf_magnitude };
/// TOT_CFORCE.
pub static TOT_CFORCE: Command = Command { spec: &TOT_CFORCE_SPEC, edits: false, run: tot_cforce };
/// C_LENGTH.
pub static C_LENGTH: Command = Command { spec: &C_LENGTH_SPEC, edits: false, run: c_length };
/// BODY_FORCE.
pub static BODY_FORCE: Command = Command { spec: &BODY_FORCE_SPEC, edits: false, run: body_force };

const EVENTS: OptionSpec = OptionSpec::new(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::Time), "time of the first event"),
        ValueSpec::new("END", Kind::Number(Dim::Time), "time of the last; one behind the run is its end")
            .or("the end of the run"),
        ValueSpec::new("INC", Kind::Number(Dim::Time), "time from one to the next; 0: the stored instants")
            .or("the stored instants")
            .not_negative(),
    ],
    "the events that are reported",
)
.default("all stored instants; STATISTIC, SPECTRUM, EXTREMES and their like leave out those before TTRA_SET");
choices! {
    /// An axis.
    enum Axis {
        X = "X",
        Y = "Y",
        Z = "Z",
    }
}
const MAG_DEFINE: OptionSpec = OptionSpec::new(
    "-MAG_DEFINE",
    &[ValueSpec::choice::<Axis>("AXIS", "X, Y or Z")],
    "magnitudes are those of the projection on these axes: one is a line, two a plane",
)
.repeating(1)
.default("X Y Z");
const NAME: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Selector), "body, pattern or selector");
const BODY: OptionSpec = OptionSpec::new("-BODY", &[NAME], "bodies, as the data name them").repeating(1);
const BODIES: &[ValueSpec] = &[NAME.or("all bodies but junctions")];
pub(crate) const CONNECTORS: &[ValueSpec] =
    &[ValueSpec::new(":C", Kind::Name(Noun::Selector), "connector, pattern or selector").or("all connectors")];
const LOCAL: OptionSpec = OptionSpec::new(
    "-LOCAL",
    &[ValueSpec::choice::<YesNo>("YES/NO", "NO is as without the option").or("YES")],
    "velocities, accelerations and displacements along the axes of the body",
)
.default("along the global axes");

const EXAMPLE: &str = "MEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P 2000 10 10 10\n~W B_CAT 4 -LEN 4000 -DEP 500\n\
                       CONNECTOR A -ANC 0 3900 ~W *P\nCONNECTOR B -ANC 180 3900 ~W *P\n&DESCRIBE INTEREST *P\nEND\n\
                       &INSTATE -LOCATE BUOY 5\n&ENV -TIME 4 1\nTDOM\nPRCPOST\n\
                       TRAJECTORY BUOY -CG -LOCAL\nREPORT LOCATION\nEND\nPOINTS *P -EVENTS 0 9000 2\nREPORT\nEND\n\
                       CONFORCE A -MAG_DEFINE X Y\nREPORT\nEND\nCF_MAGNITUDE -EVENTS 1 3 0.5\nREPORT\nEND\n\
                       TOT_CFORCE -BODY BUOY\nVIEW Time FX\nEND\nC_LENGTH A\nREPORT\nEND\nBODY_FORCE BUOY -EVENTS 4\n\
                       REPORT INERTIA TOTAL\nEND\nEND";

const fn spec(name: &'static str, data: &'static [ValueSpec], help: &'static str) -> CommandSpec {
    CommandSpec {
        opens: Opens::Menu(&menu::DISPOSITION),
        menus: const { &[&menu::PRCPOST] },
        data,
        repeat: 1,
        example: EXAMPLE,
        ..CommandSpec::new(name, help)
    }
}

const CG: OptionSpec = OptionSpec::new("-CG", &[], "of the centre of gravity").default("of the origin of the body");

static TRAJECTORY_SPEC: CommandSpec = CommandSpec {
    options: &[BODY, EVENTS, MAG_DEFINE, CG, LOCAL],
    detail: "Of each body its location, velocity, acceleration, clearance of the bottom and displacement from the start of the run; \
             REPORT LOCATION, VELOCITY, ACCELERATION, BOTTOM or DISPLACEMENT prints one of these groups. Locations and angles are those of \
             &STATUS CONFIGURATION, angles without jumps; rates of turning are about the axes X, Y, Z. The clearance is the height of the \
             origin, or centre of gravity, above the bottom at the depth of the environment. Events between stored instants are interpolated.",
    ..spec("TRAJECTORY", BODIES, "motions of bodies")
};
static POINTS_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE, LOCAL],
    detail: "Of each point that &DESCRIBE INTEREST has marked its location, velocity and acceleration, its motion from where it was marked, \
             the elevation of the waves above the mean water level at its x and y (W. Elv), and its height above the waves (Clearance). \
             Points are taken where they stand in their bodies now, also those marked after the run.",
    ..spec(
        "POINTS",
        &[ValueSpec::new("*POINT", Kind::Name(Noun::Selector), "point, pattern or selector")
            .or("all points of interest")],
        "motions of points of interest",
    )
};
static CONFORCE_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    detail: "Of each connector the force on its first end on a body in global axes, its magnitude, the largest tension of a segment \
             over its break (of springs the force over its allowable), the unstretched length on the bottom, and what its anchor bears: \
             V. Pull upward, H. Pull toward the fairlead. The force is that of the run; what follows it is found between the ends where the \
             run had them, with the length a winch had given it. A connector with a memory, as a piston, has no answer for these; one that \
             does not act has no numbers.",
    ..spec("CONFORCE", CONNECTORS, "forces of connectors")
};
static CF_MAGNITUDE_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS, MAG_DEFINE],
    detail: "A column a connector: the magnitude of the force on its first end on a body.",
    ..spec("CF_MAGNITUDE", CONNECTORS, "magnitudes of the forces of connectors")
};
static TOT_CFORCE_SPEC: CommandSpec = CommandSpec {
    options: &[BODY, EVENTS, MAG_DEFINE],
    detail: "Of each body the sum of the forces of all connectors on it, and their moment about its origin, global axes.",
    ..spec("TOT_CFORCE", BODIES, "sums of the forces of connectors on bodies")
};
static C_LENGTH_SPEC: CommandSpec = CommandSpec {
    options: &[EVENTS],
    detail: "A column a connector: the unstretched length of its first segment, which a winch changes.",
    ..spec("C_LENGTH", CONNECTORS, "lengths of connectors")
};
static BODY_FORCE_SPEC: CommandSpec = CommandSpec {
    options: &[BODY, EVENTS, MAG_DEFINE],
    detail: "Of each body the forces of every category and the moments about its origin, global axes; inertia is a force among them. TOTAL \
             is their sum: what the steps left, and in degrees of freedom of -IGNORE what holds the body. REPORT WIND TOTAL prints two categories.",
    ..spec("BODY_FORCE", BODIES, "forces on bodies by category")
};

/// The last run.
///
/// # Errors
/// There is none.
pub(crate) fn last_run(job: &Job, span: Span) -> Outcome<&Run> {
    job.run.as_ref().ok_or_else(|| Diagnostic::error("there is no run yet", span).help("TDOM makes one"))
}

/// The run a record is about, and its events.
pub(crate) fn run_and_events<'a>(job: &'a Job, args: &Args) -> Outcome<(&'a Run, Vec<RunEvent>)> {
    let run = last_run(job, args.span)?;
    let given = args.option(&EVENTS);
    let window = given.and_then(|g| {
        let [begin, end] = const { EVENTS.numbers(["BEG", "END"]) }.map(|key| g.number(key));
        let increment = g.number_if_declared(const { EVENTS.number("INC") });
        Some(EventWindow { begin: begin?, end, increment })
    });
    let span = given.map_or(args.span, |g| g.span);
    let events = results::events(&run.history, window.as_ref()).map_err(|e| e.diagnostic(span, job.units))?;
    Ok((run, events))
}

/// The same for what sums up a run: without -EVENTS the instants behind its transient.
pub(crate) fn asked_behind_transient<'a>(job: &'a Job, args: &Args) -> Outcome<(&'a Run, Vec<RunEvent>)> {
    let transient = transient_of(job, args);
    if transient <= 0.0 {
        return run_and_events(job, args);
    }
    let run = last_run(job, args.span)?;
    let window = EventWindow { begin: transient, end: None, increment: None };
    let found = results::events(&run.history, Some(&window)).map_err(|_| {
        let text = format!("the run has no instant behind TTRA_SET, {transient} s, which is left out");
        Diagnostic::error(text, args.span).help("-EVENTS takes a part of the run")
    })?;
    Ok((run, found))
}

/// How much of the beginning of the last run statistics of a result leave out (s): nothing where -EVENTS chooses instants.
pub(crate) fn transient_of(job: &Job, args: &Args) -> f64 {
    let run = job.run.as_ref().filter(|_| !args.has(&EVENTS));
    run.map_or(0.0, |run| run.settings.transient)
}

/// What magnitudes are of.
fn magnitude(args: &Args) -> Magnitude {
    let Some(given) = args.option(&MAG_DEFINE) else { return Magnitude::default() };
    let named = |axis: Axis| given.choices::<Axis>(const { MAG_DEFINE.choice("AXIS") }).any(|chosen| chosen == axis);
    Magnitude([Axis::X, Axis::Y, Axis::Z].map(named))
}

fn local(args: &Args) -> bool {
    args.switch(&LOCAL, false)
}

/// The places among some names of those that a record chooses.
fn places<'n>(chosen: &NameFilter, names: impl Iterator<Item = &'n str>) -> Vec<usize> {
    names.enumerate().filter(|(_, name)| chosen.takes(name)).map(|(place, _)| place).collect()
}

/// The bodies of a run that a record chooses, by data and -BODY.
fn bodies(job: &Job, run: &Run, args: &Args) -> Outcome<Vec<usize>> {
    let given: Vec<&Value> =
        args.data.iter().chain(args.option(&BODY).map_or(&[][..], |g| g.values.as_slice())).collect();
    let chosen = NameFilter::new(given, &job.model);
    let names = run.history.layout.bodies.iter();
    let mut list = places(&chosen, names.clone().map(|(name, _)| name.as_str()));
    chosen.check_used("the bodies of the run", &[EntityKind::Body])?;
    if chosen.chooses_all() {
        // junctions are reported only by name: they are many
        let junction = |body: &usize| {
            let key = run.history.layout.bodies.get(*body).map(|(_, key)| key);
            key.and_then(|key| run.model.bodies.get(key)).is_some_and(|b| b.junction.is_some())
        };
        list.retain(|body| !junction(body));
    }
    if list.is_empty() {
        return Err(Diagnostic::error("the run has no body to report", args.span));
    }
    Ok(list)
}

/// The connectors of a run that a record chooses.
pub(crate) fn connectors(job: &Job, run: &Run, call: &Call) -> Outcome<Vec<usize>> {
    let chosen = NameFilter::new(&call.args.data, &job.model);
    let list = places(&chosen, run.history.layout.links.iter().map(|l| l.name.as_str()));
    chosen.check_used("the connectors of the run", &[EntityKind::Connector, EntityKind::Assembly])?;
    if list.is_empty() {
        return Err(Diagnostic::error("no connector acts in the run", call.args.span));
    }
    Ok(list)
}

/// Opens the disposition menu over what a run came to.
fn dispose(job: &mut Job, made: Result<Table, SolveError>, args: &Args) -> Outcome<Effect> {
    let mut table = made.map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    if let Some(run) = &job.run {
        note_caveats(&run.model, std::slice::from_mut(&mut table));
    }
    let transient = transient_of(job, args);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table).after_transient(transient))));
    Ok(Effect::Done)
}

fn trajectory(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (run, events) = run_and_events(job, args)?;
    let how = MotionOptions { centre: args.has(&CG), local: local(args), magnitude: magnitude(args) };
    let made = results::trajectory(run, &bodies(job, run, args)?, &how, &events);
    dispose(job, made, args)
}

fn points(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (run, events) = run_and_events(job, args)?;
    let (model, chosen) = (&job.model, NameFilter::new(&call.args.data, &job.model));
    let mut list = Vec::new();
    for point in model.points.values().filter(|p| p.interest.is_some()) {
        if !chosen.takes(&point.name) {
            continue;
        }
        let part = model.parts.get(&Model::key(&point.part));
        let at = part.map_or(point.at, |p| p.place.apply(point.at));
        let body = match model.body_of(point) {
            None => None,
            Some(body) => {
                let key = Model::key(&body.name);
                let found = run.history.layout.bodies.iter().position(|(_, k)| *k == key);
                let missing = || {
                    let text = format!("body {} of point {} makes no part of the run", body.name, point.name);
                    Diagnostic::error(text, args.span).help("it was made after the run: TDOM makes another")
                };
                Some(found.ok_or_else(missing)?)
            }
        };
        list.push(TrackedPoint { name: point.name.clone(), body, at, marked: point.interest.unwrap_or_default() });
    }
    chosen.check_used("the points of interest", &[EntityKind::Point])?;
    if list.is_empty() {
        return Err(Diagnostic::error("no point is marked", args.span).help("&DESCRIBE INTEREST *POINT marks points"));
    }
    let made = results::points(run, &list, (local(args), magnitude(args)), &events);
    dispose(job, made, args)
}

fn conforce(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (run, events) = run_and_events(job, &call.args)?;
    let made = results::connector_forces(run, &connectors(job, run, call)?, magnitude(&call.args), &events);
    dispose(job, made, &call.args)
}

fn cf_magnitude(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (run, events) = run_and_events(job, &call.args)?;
    let made = results::magnitudes(run, &connectors(job, run, call)?, magnitude(&call.args), &events);
    dispose(job, made, &call.args)
}

fn tot_cforce(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (run, events) = run_and_events(job, &call.args)?;
    let made = results::total_forces(run, &bodies(job, run, &call.args)?, magnitude(&call.args), &events);
    dispose(job, made, &call.args)
}

fn c_length(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (run, events) = run_and_events(job, &call.args)?;
    let made = results::lengths(run, &connectors(job, run, call)?, &events);
    dispose(job, made, &call.args)
}

fn body_force(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (run, events) = run_and_events(job, &call.args)?;
    let made = results::body_forces(run, &bodies(job, run, &call.args)?, magnitude(&call.args), &events);
    dispose(job, made, &call.args)
}
