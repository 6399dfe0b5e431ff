//! What MOSES shows of motions in FREQ_RESPONSE beside FR_POINT: forces of one connector, forces on cargo, and statistics in an
//! environment.
//!
//! Source: [MOSES-REF freq_mot, freq_fco]; the data of the forces on cargo are from memory of MOSES.

use crate::commands::environment::env::{self, A_SEA_OPTION, E_PERIOD, SEA_OPTION, SP_TYPE_OPTION, SPREAD_OPTION};
use crate::commands::environment::probability;
use crate::commands::menu;
use crate::commands::post::frequency_posts::{
    ACCELERATION, DURATION_OPTION, MPM_DURATION_S, VELOCITY, body, derivative, derivative_name, dispose,
    dispose_statistics, force, idealisation, point_quantities, results_table, tensions,
};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::frequency::{
    FrequencyResults, PlacedPoint, heaving, last_points, no_motions, open_results, seas,
};
use crate::commands::solve::summary::worst_in_sea;
use crate::commands::{Call, Command, Effect, Job};
use nalgebra::Vector3;
use std::f64::consts::TAU;
use std::sync::Arc;
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Environment, Model, add_model_column, find};
use windlass_solve::frequency::tables::{
    NamedQuantity, SolvedResponse, StatisticsRequest, load_statistics, statistics,
};
use windlass_solve::frequency::{
    Derivative, ExtremeKind, FrequencyResponse, LinearQuantity, LinearSystem, ResponseOptions, sea_response,
};

/// FR_CFORCE.
pub static FR_CFORCE: Command = Command { spec: &FR_CFORCE_SPEC, edits: false, run: force };
/// ST_POINT.
pub static ST_POINT: Command = Command { spec: &ST_POINT_SPEC, edits: false, run: point_statistics };
/// ST_CFORCE.
pub static ST_CFORCE: Command = Command { spec: &ST_CFORCE_SPEC, edits: false, run: force_statistics };
/// FR_FCARGO.
pub static FR_FCARGO: Command = Command { spec: &FR_FCARGO_SPEC, edits: false, run: cargo };
/// ST_FCARGO.
pub static ST_FCARGO: Command = Command { spec: &ST_FCARGO_SPEC, edits: false, run: cargo_statistics };
/// ST_CARGO, another name of MOSES for it.
pub static ST_CARGO: Command = Command { spec: &ST_CARGO_SPEC, edits: false, run: cargo_statistics };

const ENV: ValueSpec =
    ValueSpec::new("ENV", Kind::Name(Noun::Environment), "environment; with options it is defined anew by them")
        .or("the environment in force");
const CARGO: [ValueSpec; 4] = [
    ValueSpec::new("W", Kind::Number(Dim::Force), "weight of the cargo").positive(),
    ValueSpec::new("KX", Kind::Number(Dim::Length), "its radius of gyration about x").or("0").not_negative(),
    ValueSpec::new("KY", Kind::Number(Dim::Length), "about y").or("0").not_negative(),
    ValueSpec::new("KZ", Kind::Number(Dim::Length), "about z").or("0").not_negative(),
];
const SEAS: [OptionSpec; 7] =
    [SEA_OPTION, A_SEA_OPTION, SPREAD_OPTION, SP_TYPE_OPTION, E_PERIOD, CSTEEP, DURATION_OPTION];
const CSTEEP: OptionSpec = OptionSpec::new(
    "-CSTEEP",
    &[ValueSpec::choice::<YesNo>("YES/NO", "YES or NO")],
    "whether damping is linearised for one steepness: RAO has no damping to linearise, SRESPONSE linearises it in its sea",
)
.without_effect();
const IN_SEA: &str = "After RAO the sea is that of ENV, changed by the options, and of the environment in force without ENV; after SRESPONSE it is that of SRESPONSE.";

const fn spec(name: &'static str, help: &'static str) -> CommandSpec {
    CommandSpec {
        menus: const { &[&menu::FREQ_RESPONSE] },
        opens: Opens::Menu(&menu::DISPOSITION),
        example: concat!(
            heaving!(),
            "RAO\nFR_CFORCE LINE\nREPORT\nEND\nFR_POINT *CG\nEND\nST_POINT -SEA ISSC 0 2 8\nREPORT\nEND\nST_CFORCE LINE\nREPORT\nEND\n\
             FR_FCARGO 500 2 2 2\nREPORT\nEND\nST_FCARGO 500 2 2 2\nREPORT\nEND\nST_CARGO 500 2 2 2\nEND\nEND"
        ),
        ..CommandSpec::new(name, help)
    }
}

static FR_CFORCE_SPEC: CommandSpec = CommandSpec {
    data: &[ValueSpec::new("CONN", Kind::Name(Noun::Selector), "a connector").among(&[Noun::Connector])],
    detail: "The size of its force on its first body, for a line its tension, and its components in global axes, by its stiffness and damping \
             at rest. After RAO amplitudes and phases, after SRESPONSE spectral densities.",
    ..spec("FR_CFORCE", "the force of a connector")
};
static ST_POINT_SPEC: CommandSpec = CommandSpec {
    data: &[ENV],
    options: &[
        SEA_OPTION,
        A_SEA_OPTION,
        SPREAD_OPTION,
        SP_TYPE_OPTION,
        E_PERIOD,
        CSTEEP,
        DURATION_OPTION,
        VELOCITY,
        ACCELERATION,
    ],
    detail: "Statistics of the point, or of the two points, of the last FR_POINT, as STATISTICS POINT; the maximum is that of -PROBABILITY. After RAO the \
             sea is that of ENV, changed by the options, and of the environment in force without ENV; after SRESPONSE it is that of SRESPONSE.",
    ..spec("ST_POINT", "statistics of the point of FR_POINT")
};
static ST_CFORCE_SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new(":SEL", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector]),
        ENV,
    ],
    options: &SEAS,
    detail: IN_SEA,
    ..spec("ST_CFORCE", "statistics of the forces of connectors")
};
static FR_FCARGO_SPEC: CommandSpec = CommandSpec {
    data: &CARGO,
    detail: "The force and moment that a weight with its center at the point of the last FR_POINT exerts there on its body, along the axes of the body: by its \
             inertia, and by gravity as the body turns (our reading).",
    ..spec("FR_FCARGO", "the force of a cargo on its body")
};
static ST_FCARGO_SPEC: CommandSpec = CommandSpec {
    data: &[CARGO[0], CARGO[1], CARGO[2], CARGO[3], ENV],
    options: &SEAS,
    detail: IN_SEA,
    ..spec("ST_FCARGO", "statistics of the force of a cargo on its body")
};
static ST_CARGO_SPEC: CommandSpec = CommandSpec { name: "ST_CARGO", help: "as ST_FCARGO", ..ST_FCARGO_SPEC };

/// A response in a sea, with the equations it was found with and the extreme its environment asks for.
struct InSea {
    linear: Arc<LinearSystem>,
    response: FrequencyResponse,
    extreme: ExtremeKind,
}

/// The response in the environment that a record names and changes. An environment that is named and changed is defined anew.
fn respond_in(job: &mut Job, args: &Args, name: Option<(&str, Span)>) -> Outcome<InSea> {
    let changes: Vec<_> = args
        .options
        .iter()
        .filter(|given| given.is_any(&[SEA_OPTION, A_SEA_OPTION, SPREAD_OPTION, SP_TYPE_OPTION, E_PERIOD]))
        .collect();
    let usual = |extreme: Option<ExtremeKind>| {
        let given = args.option_number(&DURATION_OPTION).map(ExtremeKind::MostProbable);
        given.or(extreme).unwrap_or(ExtremeKind::MostProbable(MPM_DURATION_S))
    };
    if let Some(given) = args.option(&CSTEEP) {
        job.remark(
            "-CSTEEP has no effect: motions of RAO have no damping that a steepness would linearise",
            given.span,
        );
    }
    let linear = match open_results(job, args.span)? {
        FrequencyResults::Nothing => return Err(no_motions(job, args.span)),
        FrequencyResults::Spectral(linear, made, extreme) => {
            let given = changes.first().map(|given| (given.name(), given.span)).or(name);
            if let Some((what, span)) = given {
                return Err(Diagnostic::error(
                    format!("{what} cannot follow SRESPONSE, whose sea is in its damping and drift"),
                    span,
                )
                .help("SRESPONSE ENV takes another environment; a new sea may follow RAO"));
            }
            return Ok(InSea { linear: Arc::clone(linear), response: made.clone(), extreme: usual(*extreme) });
        }
        FrequencyResults::Operators(linear, _) => Arc::clone(linear),
    };
    let mut env: Environment = match name {
        None => job.model.environment.clone(),
        Some((name, span)) => match job.model.environments.get(&Model::key(name)) {
            Some(known) => known.clone(),
            None if changes.is_empty() => find(&job.model.environments, name, "environment", span)?.clone(),
            None => Environment { name: name.to_string(), ..job.model.environment.clone() },
        },
    };
    if args.has(&SEA_OPTION) {
        env = env.without_sea();
    }
    for given in &changes {
        env::apply(job, &mut env, given)?;
        env.options.retain(|old| !old.is(given.option));
        env.options.push((*given).clone());
    }
    let periods = env.options.iter().rev().find(|given| given.is(&E_PERIOD));
    let mut frequencies = periods.map_or(Vec::new(), |given| given.numbers().iter().map(|t| TAU / t).collect());
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let trains = seas(job, &env, args.span)?;
    let made = sea_response(&linear, &trains, &ResponseOptions { frequencies, spectral: false });
    let response = made.map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    let extreme = usual(probability::extreme_in(&job.model, &env));
    if let Some((name, _)) = name.filter(|_| !changes.is_empty()) {
        job.model.environments.insert(Model::key(name), env);
    }
    Ok(InSea { linear, response, extreme })
}

/// The name of an environment among the data of a record.
fn env_of(args: &Args, key: DatumKey<str>) -> Option<(&str, Span)> {
    args.word(key).map(|name| (name, args.position(key)))
}

fn point_statistics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let derivative = derivative(args)?;
    open_results(job, args.span)?;
    let points = last_points(job).to_vec();
    if points.is_empty() {
        return Err(
            Diagnostic::error("no point has been asked for yet", args.span).help("FR_POINT *PT before it chooses one")
        );
    }
    let InSea { linear, response, extreme } = respond_in(job, args, env_of(args, const { ST_POINT_SPEC.word("ENV") }))?;
    let (name, list) = point_quantities(job, &linear, &points, args.span)?;
    let title = format!("Statistics: {} of {name}", derivative_name(derivative));
    let made = statistics(
        title,
        SolvedResponse { linear: &linear, response: &response },
        &list,
        StatisticsRequest { derivative, extreme },
    );
    Ok(dispose_statistics(job, ("ST_POINT", response.rounds), made, None, args.span))
}

fn force_statistics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let InSea { linear, response, extreme } =
        respond_in(job, args, env_of(args, const { ST_CFORCE_SPEC.word("ENV") }))?;
    let named = args.data.get(..1).unwrap_or_default();
    let list = tensions(job, &linear, named, args.span, false)?;
    let title = "Statistics: Forces of Connectors".to_string();
    let how = StatisticsRequest { derivative: Derivative::Place, extreme };
    let mut made = statistics(title, SolvedResponse { linear: &linear, response: &response }, &list, how);
    add_model_column(&mut made, |name| idealisation(&job.model, name));
    let fits = |name: &str| list.iter().any(|quantity| quantity.name == name);
    let worst = worst_in_sea(&job.model, (&linear, &response), extreme, &fits);
    Ok(dispose_statistics(job, ("ST_CFORCE", response.rounds), made, worst, args.span))
}

/// The force and moment of the cargo of a record, and what its table is called.
fn cargo_quantities(job: &Job, linear: &LinearSystem, args: &Args) -> Outcome<(String, [LinearQuantity; 6])> {
    let points = last_points(job);
    let [PlacedPoint { name, body: owner, at }] = points else {
        let text =
            if points.is_empty() { "no point has been asked for yet" } else { "the last FR_POINT was of two points" };
        return Err(Diagnostic::error(text, args.span).help("FR_POINT *PT before it says where the cargo is"));
    };
    let (index, _) = body(job, linear, Some(owner), args.span)?;
    // ST_FCARGO names these data alike
    let [weight, kx, ky, kz] = args.numbers_or_zero(const { FR_FCARGO_SPEC.numbers(["W", "KX", "KY", "KZ"]) });
    let made = LinearQuantity::cargo_force(linear, index, Vector3::from(*at), weight, [kx, ky, kz]);
    Ok((format!("Force of a Cargo at {name}"), made))
}

fn cargo(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let linear = open_results(job, args.span)?.linear().cloned();
    let Some(linear) = linear else { return Ok(Effect::Done) };
    let (title, made) = cargo_quantities(job, &linear, args)?;
    let named = ["FX", "FY", "FZ", "MX", "MY", "MZ"].into_iter().zip(made).enumerate();
    let list: Vec<_> = named
        .map(|(i, (name, quantity))| NamedQuantity::new(name, if i < 3 { Dim::Force } else { Dim::Moment }, quantity))
        .collect();
    let made = results_table(job, title, &list, Derivative::Place, args.span)?;
    Ok(dispose(job, made, args.span))
}

fn cargo_statistics(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    open_results(job, args.span)?;
    let InSea { linear, response, extreme } =
        respond_in(job, args, env_of(args, const { ST_FCARGO_SPEC.word("ENV") }))?;
    let (title, made) = cargo_quantities(job, &linear, args)?;
    let table = load_statistics(
        format!("Statistics: {title}"),
        SolvedResponse { linear: &linear, response: &response },
        &made,
        extreme,
    );
    Ok(dispose_statistics(job, ("ST_FCARGO", response.rounds), table, None, args.span))
}
