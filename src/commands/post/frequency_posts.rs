//! What the FREQ_RESPONSE menu shows of motions: of bodies, points and connectors, and their statistics.
//!
//! Source: [MOSES-REF freq_mot]; the forms of MOTION, CONFORCE and STATISTICS are ours.

use crate::commands::environment::env::{self, A_SEA_OPTION, SEA_OPTION, SP_TYPE_OPTION, SPREAD_OPTION};
use crate::commands::environment::probability;
use crate::commands::menu;
use crate::commands::name_filter::{NameFilter, raise};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::frequency::{
    FrequencyResults, PlacedPoint, heaving, keep_points, no_motions, open_results, seas,
};
use crate::commands::solve::summary::{WorstLine, count, of_statistics, worst_in_sea};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use nalgebra::Vector3;
use std::sync::Arc;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Cell, Table};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun, Value};
use windlass_language::number::evaluate;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{EntityKind, Environment, Idealisation, Model, add_model_column, find};
use windlass_solve::frequency::tables::{
    NamedQuantity, SolvedResponse, StatisticsRequest, body_statistics, operators, spectra, statistics,
};
use windlass_solve::frequency::{
    Derivative, ExtremeKind, FrequencyResponse, LinearQuantity, LinearSystem, ResponseOptions, sea_response,
};

/// MOTION.
pub static MOTION: Command = Command { spec: &MOTION_SPEC, edits: false, run: motion };
/// FR_POINT.
pub static FR_POINT: Command = Command { spec: &POINT_SPEC, edits: false, run: point };
/// CONFORCE.
pub static CONFORCE: Command = Command { spec: &FORCE_SPEC, edits: false, run: force };
/// STATISTICS.
pub static STATISTICS: Command = Command { spec: &STATISTICS_SPEC, edits: false, run: report_statistics };

/// The duration of the most probable maximum (s): three hours.
pub(crate) const MPM_DURATION_S: f64 = 10_800.0;
choices! {
    /// What STATISTICS is of.
    enum StatisticsOf {
        Motion = "MOTION",
        Point = "POINT",
        Tension = "TENSION",
    }
}

pub(super) const VELOCITY: OptionSpec = OptionSpec::new("-VELOCITY", &[], "velocities instead of motions");
pub(super) const ACCELERATION: OptionSpec = OptionSpec::new("-ACCELERATION", &[], "accelerations instead of motions");

static MOTION_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::FREQ_RESPONSE],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body").or("the first one")],
    detail: "Motions of the origin of a body along and about the global axes. After RAO: amplitudes in waves of an amplitude of one \
             length unit, and their lag behind the crest at the global origin. After SRESPONSE: spectral densities.",
    example: concat!(heaving!(), "SRESPONSE\nMOTION BALL\nVIEW Frequency Wave Z\nEND\nEND"),
    ..CommandSpec::new("MOTION", "motions of a body")
};
static POINT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::FREQ_RESPONSE],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::new("*PT", Kind::Item, "a point of a body; or X, before Y and Z, in the system of the first body"),
        ValueSpec::new("*PT2", Kind::Item, "a point whose motion is taken off; or Y")
            .or("none: the motion of the first"),
        ValueSpec::new("Z", Kind::Item, "Z of a point given by coordinates").or("none"),
    ],
    options: &[VELOCITY, ACCELERATION],
    detail: "Motions of a point of a body, or of one point less those of another; as MOTION. ST_POINT, EXFORCE, MATRICES, EQU_SUM and the \
             forces on cargo are about the point of the last FR_POINT.",
    example: concat!(heaving!(), "RAO\nFR_POINT *CG -ACCELERATION\nREPORT\nEND\nEND"),
    ..CommandSpec::new("FR_POINT", "motions of points")
};
static FORCE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::FREQ_RESPONSE],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[ValueSpec::new(":CONN", Kind::Name(Noun::Selector), "connector, pattern or selector")
        .among(&[Noun::Connector])
        .or("all")],
    repeat: 1,
    detail: "How the sizes of the forces of connectors on their first ends vary, by their stiffness and damping there: for a line its tension. \
             Of a single connector also its components in global axes. Lines follow without dynamics of their own. As MOTION.",
    example: concat!(heaving!(), "RAO\nCONFORCE LINE\nREPORT\nEND\nEND"),
    ..CommandSpec::new("CONFORCE", "forces of connectors")
};
pub(super) const DURATION_OPTION: OptionSpec = OptionSpec::new(
    "-DURATION",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").positive()],
    "time of the most probable maximum",
)
.default("by -PROBABILITY of &ENV, else 10800: three hours")
.owner(Owner::Ours);

static STATISTICS_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::FREQ_RESPONSE],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[
        ValueSpec::choice::<StatisticsOf>("WHAT", "of what"),
        ValueSpec::new("NAME", Kind::Name(Noun::Selector), "a body; one or two points; connectors")
            .among(&[Noun::Body, Noun::Point, Noun::Connector])
            .or("the first body; all connectors"),
    ],
    repeat: 1,
    options: &[VELOCITY, ACCELERATION, DURATION_OPTION, SEA_OPTION, A_SEA_OPTION, SPREAD_OPTION, SP_TYPE_OPTION],
    detail: "Standard deviations at the frequencies of the waves, of slow drift and of both; twice that is the significant amplitude; the most \
             probable maximum is Rayleigh's, by the number of zero up-crossings in the duration. After RAO the sea is that of the \
             environment in force, or the one given here; after SRESPONSE it is that of SRESPONSE. Accelerations are global and \
             without gravity.",
    example: concat!(
        heaving!(),
        "RAO\nSTATISTICS MOTION BALL -SEA JONSWAP 0 3 9 3.3\nREPORT\nEND\nSTATISTICS TENSION\nREPORT\nEND\nEND"
    ),
    ..CommandSpec::new("STATISTICS", "statistics of motions and forces in a sea")
};

pub(super) fn derivative(args: &Args) -> Outcome<Derivative> {
    match (args.option(&VELOCITY), args.option(&ACCELERATION)) {
        (Some(first), Some(second)) => {
            Err(Diagnostic::error("-VELOCITY and -ACCELERATION cannot hold at once", second.span)
                .other(first.span, "first given here"))
        }
        (Some(_), None) => Ok(Derivative::Velocity),
        (None, Some(_)) => Ok(Derivative::Acceleration),
        (None, None) => Ok(Derivative::Place),
    }
}

pub(super) fn derivative_name(derivative: Derivative) -> &'static str {
    match derivative {
        Derivative::Place => "Motion",
        Derivative::Velocity => "Velocity",
        Derivative::Acceleration => "Acceleration",
    }
}

/// How a connector is idealised here: a dynamic line follows the bodies as at rest.
pub(super) fn idealisation(model: &Model, name: &str) -> Option<Idealisation> {
    model.idealisation(name).map(|kind| if kind == Idealisation::Dynamic { Idealisation::QuasiStatic } else { kind })
}

/// Opens the disposition menu over a table.
pub(super) fn dispose(job: &mut Job, made: Table, span: Span) -> Effect {
    raise(job, &made, span);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(made))));
    Effect::Done
}

/// Prints the summary of statistics, with the worst line where they are of lines, and opens the disposition menu over them. `rounds` is how
/// often damping was linearised.
pub(super) fn dispose_statistics(
    job: &mut Job,
    (command, rounds): (&str, usize),
    made: Table,
    worst: Option<WorstLine>,
    span: Span,
) -> Effect {
    let solved = match rounds {
        0 => "none: the equations are linear and solved directly".to_string(),
        _ => format!("damping and velocities agree after {}", count(rounds, "round")),
    };
    let mut summary = of_statistics(command, &made, &solved, job.units);
    if worst.is_some() {
        summary = summary.worst(worst, job.units);
    }
    let effect = dispose(job, made, span);
    summary.print(job, "REPORT prints all rows, STORE FILE writes them, END leaves");
    effect
}

/// The table of what is found: amplitudes and phases, or spectra.
pub(super) fn results_table(
    job: &Job,
    title: String,
    list: &[NamedQuantity],
    derivative: Derivative,
    span: Span,
) -> Outcome<Table> {
    Ok(match open_results(job, span)? {
        FrequencyResults::Operators(linear, made) => {
            let unit = Dim::Length.to_si(1.0, job.units);
            operators(title, linear, made, list, derivative, unit)
        }
        FrequencyResults::Spectral(linear, made, _) => {
            spectra(title, SolvedResponse { linear, response: made }, list, derivative)
        }
        FrequencyResults::Nothing => Table::new(title),
    })
}

/// The number of a body of the motions by its name.
pub(super) fn body(job: &Job, linear: &LinearSystem, name: Option<&str>, span: Span) -> Outcome<(usize, String)> {
    let gone = || Diagnostic::error("that body has no part in the motions found", span).help("RAO or SRESPONSE again");
    let Some(name) = name else {
        let first = linear.system.nodes.iter().position(|n| !n.junction).unwrap_or(0);
        return Ok((first, linear.system.nodes.get(first).ok_or_else(gone)?.name.clone()));
    };
    let found = find(&job.model.bodies, name, "body", span)?;
    let index = linear.system.nodes.iter().position(|n| n.name == found.name).ok_or_else(gone)?;
    Ok((index, found.name.clone()))
}

/// A point of a body by its name.
fn find_placed_point(job: &Job, name: &str, span: Span) -> Outcome<PlacedPoint> {
    let point = find(&job.model.points, name, "point", span)?;
    let Some(owner) = job.model.body_of(point) else {
        return Err(Diagnostic::error(format!("point {name} belongs to no body"), span));
    };
    let part = job.model.parts.get(&Model::key(&point.part));
    let at = part.map_or(point.at, |p| p.position.apply(point.at));
    Ok(PlacedPoint { name: name.to_string(), body: owner.name.clone(), at })
}

/// One or two points by their names, or one by its coordinates in the first body.
fn read_points(job: &Job, linear: &LinearSystem, named: &[Value], span: Span) -> Outcome<Vec<PlacedPoint>> {
    let words: Vec<(&str, Span)> = named.iter().filter_map(|value| Some((value.word()?, value.span))).collect();
    let coordinates = words.first().is_some_and(|(word, _)| evaluate(word).is_ok());
    if coordinates {
        let [x, y, z] = words.as_slice() else {
            return Err(Diagnostic::error("a point is given by X, Y and Z", span)
                .help("form: FR_POINT X Y Z or FR_POINT *PT [*PT]"));
        };
        let number = |(word, position): &(&str, Span)| {
            let value = evaluate(word).map_err(|e| Diagnostic::error(e.to_string(), *position))?;
            Ok::<f64, Box<Diagnostic>>(Dim::Length.to_si(value, job.units))
        };
        let at = [number(x)?, number(y)?, number(z)?];
        let (_, body) = body(job, linear, None, span)?;
        return Ok(vec![PlacedPoint { name: format!("{} {} {} of {body}", x.0, y.0, z.0), body, at }]);
    }
    match words.as_slice() {
        [] => Err(Diagnostic::error("a point is missing", span).help("form: STATISTICS POINT *PT [*PT]")),
        [_, _, (_, surplus), ..] => Err(Diagnostic::error("there are more than two points", *surplus)),
        list => list.iter().map(|(word, position)| find_placed_point(job, word, *position)).collect(),
    }
}

/// The coordinates of a point, or of one less another, with a name for both.
pub(super) fn point_quantities(
    job: &Job,
    linear: &LinearSystem,
    points: &[PlacedPoint],
    span: Span,
) -> Outcome<(String, Vec<NamedQuantity>)> {
    let axes = |point: &PlacedPoint| -> Outcome<[LinearQuantity; 3]> {
        let (index, _) = body(job, linear, Some(&point.body), span)?;
        Ok(LinearQuantity::point(linear, index, Vector3::from(point.at)))
    };
    let (title, axes) = match points {
        [] => return Err(Diagnostic::error("a point is missing", span).help("FR_POINT chooses one")),
        [first] => (first.name.clone(), axes(first)?),
        [first, second, ..] => {
            let ([x, y, z], [a, b, c]) = (axes(first)?, axes(second)?);
            (format!("{} less {}", first.name, second.name), [x.minus(&a), y.minus(&b), z.minus(&c)])
        }
    };
    let list = ["X", "Y", "Z"].into_iter().zip(axes).map(|(name, q)| NamedQuantity::new(name, Dim::Length, q));
    Ok((title, list.collect()))
}

fn motion(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const BODY: DatumKey<str> = MOTION_SPEC.word("BODY");
    let args = &call.args;
    let linear = open_results(job, args.span)?.linear().cloned();
    let Some(linear) = linear else { return Ok(Effect::Done) };
    let (index, name) = body(job, &linear, args.word(BODY), args.position(BODY))?;
    let list = NamedQuantity::dofs(&linear, index);
    let made = results_table(job, format!("Motion of {name}"), &list, Derivative::Place, args.span)?;
    Ok(dispose(job, made, args.span))
}

fn point(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let linear = open_results(job, args.span)?.linear().cloned();
    let Some(linear) = linear else { return Ok(Effect::Done) };
    let derivative = derivative(args)?;
    let points = read_points(job, &linear, &args.data, args.span)?;
    let (name, list) = point_quantities(job, &linear, &points, args.span)?;
    keep_points(job, points.clone());
    let mut made =
        results_table(job, format!("{} of {name}", derivative_name(derivative)), &list, derivative, args.span)?;
    for point in points {
        for (axis, value) in ["X", "Y", "Z"].into_iter().zip(point.at) {
            made = made.fact(&format!("{axis} of {}", point.name), value, Dim::Length);
        }
    }
    Ok(dispose(job, made, args.span))
}

/// Tensions of the connectors that words of a record choose; with `components` those of a single one.
pub(super) fn tensions(
    job: &Job,
    linear: &LinearSystem,
    named: &[Value],
    span: Span,
    components: bool,
) -> Outcome<Vec<NamedQuantity>> {
    let chosen = NameFilter::new(named, &job.model);
    let names: Vec<String> = linear.connectors().filter(|name| chosen.matches(name)).map(str::to_string).collect();
    chosen.check_used("the connectors that act", &[EntityKind::Connector])?;
    let mut list = Vec::new();
    for name in &names {
        let made = LinearQuantity::tension(linear, name).map_err(|e| to_diagnostic(e, &job.model, span, job.units))?;
        let Some((axes, size)) = made else { continue };
        list.extend(size.map(|q| NamedQuantity::new(name.as_str(), Dim::Force, q)));
        if components && names.len() == 1 {
            let named = ["FX", "FY", "FZ"].into_iter().zip(axes);
            list.extend(named.map(|(axis, q)| NamedQuantity::new(axis, Dim::Force, q)));
        }
    }
    if list.is_empty() {
        return Err(Diagnostic::error("no connector bears a force whose size could vary", span));
    }
    Ok(list)
}

pub(super) fn force(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let span = call.args.span;
    let linear = open_results(job, span)?.linear().cloned();
    let Some(linear) = linear else { return Ok(Effect::Done) };
    let list = tensions(job, &linear, &call.args.data, span, true)?;
    let made = results_table(job, "Forces of Connectors".into(), &list, Derivative::Place, span)?;
    Ok(dispose(job, made, span))
}

/// The sea a record of STATISTICS gives, in the environment in force.
fn sea(job: &Job, args: &Args) -> Outcome<Environment> {
    let mut env = job.model.environment.clone();
    if let Some(given) = args.option(&SEA_OPTION) {
        env = env.without_sea();
        env::apply(job, &mut env, given)?;
    }
    for given in [A_SEA_OPTION, SPREAD_OPTION, SP_TYPE_OPTION].iter().filter_map(|option| args.option(option)) {
        env::apply(job, &mut env, given)?;
    }
    Ok(env)
}

/// The response that statistics are made of.
fn response(job: &Job, args: &Args) -> Outcome<(Arc<LinearSystem>, FrequencyResponse)> {
    let given = [SEA_OPTION, A_SEA_OPTION, SPREAD_OPTION, SP_TYPE_OPTION].iter().find_map(|option| args.option(option));
    match (open_results(job, args.span)?, given) {
        (FrequencyResults::Spectral(..), Some(given)) => Err(Diagnostic::error(
            format!("{} cannot follow SRESPONSE, whose sea is in its damping and drift", given.name()),
            given.span,
        )
        .help("SRESPONSE ENV takes another environment; a new sea may follow RAO")),
        (FrequencyResults::Spectral(linear, made, _), None) => Ok((Arc::clone(linear), made.clone())),
        (FrequencyResults::Operators(linear, _), _) => {
            let trains = seas(job, &sea(job, args)?, args.span)?;
            let made = sea_response(linear, &trains, &ResponseOptions::default());
            Ok((Arc::clone(linear), made.map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?))
        }
        (FrequencyResults::Nothing, _) => Err(no_motions(job, args.span)),
    }
}

fn report_statistics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let derivative = derivative(args)?;
    let of_env = match open_results(job, args.span)? {
        FrequencyResults::Spectral(.., extreme) => *extreme,
        _ => probability::extreme(&job.model),
    };
    let given = args.option_number(&DURATION_OPTION).map(ExtremeKind::MostProbable);
    let extreme = given.or(of_env).unwrap_or(ExtremeKind::MostProbable(MPM_DURATION_S));
    let (linear, made) = response(job, args)?;
    let both = SolvedResponse { linear: &linear, response: &made };
    let how = StatisticsRequest { derivative, extreme };
    let of = derivative_name(derivative);
    const WHAT: DatumKey<StatisticsOf> = STATISTICS_SPEC.choice("WHAT");
    let named = args.data_after(WHAT);
    let what = args.choice(WHAT).unwrap_or(StatisticsOf::Motion);
    let table = match what {
        StatisticsOf::Point => {
            let points = read_points(job, &linear, named, args.span)?;
            let (name, list) = point_quantities(job, &linear, &points, args.span)?;
            statistics(format!("Statistics: {of} of {name}"), both, &list, how)
        }
        StatisticsOf::Tension => {
            if let Some(given) = args.option(&VELOCITY).or(args.option(&ACCELERATION)) {
                return Err(Diagnostic::error(format!("a tension has no {}", given.name()), given.span));
            }
            let list = tensions(job, &linear, named, args.span, false)?;
            let mut table = statistics("Statistics: Forces of Connectors".into(), both, &list, how);
            add_model_column(&mut table, |name| idealisation(&job.model, name));
            table
        }
        StatisticsOf::Motion => {
            if let Some(surplus) = named.get(1).filter(|value| value.is_given()) {
                return Err(Diagnostic::error("MOTION takes one body", surplus.span));
            }
            const NAME: DatumKey<str> = STATISTICS_SPEC.word("NAME");
            let (index, name) = body(job, &linear, args.word(NAME), args.position(NAME))?;
            body_statistics(format!("Statistics: {of} of {name}"), both, index, how)
        }
    };
    let worst = match what {
        StatisticsOf::Tension => {
            let listed = table.columns().first().map_or(&[][..], |names| names.cells.as_slice());
            let fits = |name: &str| listed.contains(&Cell::from(name));
            worst_in_sea(&job.model, (&linear, &made), extreme, &fits)
        }
        StatisticsOf::Motion | StatisticsOf::Point => None,
    };
    Ok(dispose_statistics(job, ("STATISTICS", made.rounds), table, worst, args.span))
}
