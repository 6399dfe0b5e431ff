//! `&EQUI`: brings the bodies to rest.
//!
//! Source: [MOSES-REF equi].

use crate::commands::name_filter::{note_caveats, raise};
use crate::commands::output::disposition::{BOTH, HARD, WIDE, send_tables};
use crate::commands::solve::summary::{SolveSummary, count, farthest_move, worst_in_state};
use crate::commands::verdict::{OverBreak, check_over_break};
use crate::commands::{Call, Command, Effect, Job};
use indexmap::IndexMap;
use windlass_base::choice::{Dof, YesNo};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::span::Span;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Given;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{Model, find};
use windlass_solve::beyond_database::warnings_of_mean_drift;
use windlass_solve::drift_damping::{body_drift_dampings, drift_damping_table};
use windlass_solve::results::along::static_cautions;
use windlass_solve::{EquilibriumOptions, SolveError, find_equilibrium_with_rebuilds, tables};

/// &EQUI.
pub static EQUI: Command = Command { spec: &SPEC, edits: true, run };

const TOLERANCE: ValueSpec =
    ValueSpec::new("T", Kind::Number(Dim::None), "residual acceleration tolerance (fraction of g)")
        .in_range(1e-12, 1.0);

const DEFAULTS: OptionSpec = OptionSpec::new("-DEFAULTS", &[], "forgets what was given before");
const ITER_MAX: OptionSpec = OptionSpec::new(
    "-ITER_MAX",
    &[ValueSpec::new("N", Kind::Integer, "steps").in_range(1.0, 100_000.0)],
    "most steps of the solution",
)
.default("50");
const TOLERANCE_OPTION: OptionSpec = OptionSpec::new(
    "-TOLERANCE",
    &[TOLERANCE, ValueSpec { name: "R", ..TOLERANCE }.or("the same: rotation, times the radius of gyration")],
    "largest accelerations left",
)
.default("0.001");
const IGNORE: OptionSpec = OptionSpec::new(
    "-IGNORE",
    &[
        ValueSpec::new("BODY", Kind::Name(Noun::Body), "body"),
        ValueSpec::choice::<Dof>("DOF", "a degree of freedom that does not move in this solution"),
        MORE,
        MORE,
        MORE,
        MORE,
        MORE,
    ],
    "holds degrees of freedom of a body, this time",
)
.many();

const OMEGA: OptionSpec = OptionSpec::new(
    "-OMEGA",
    &[ValueSpec::new("FRACT", Kind::Number(Dim::None), "fraction of the step").in_range(1e-3, 1.0)],
    "the fraction of each Newton step that is taken",
)
.default("1");
const MOVE_MAX: OptionSpec = OptionSpec::new(
    "-MOVE_MAX",
    &[
        ValueSpec::new("TRANSLATION", Kind::Number(Dim::Length), "translation").positive(),
        ValueSpec::new("ANGLE", Kind::Number(Dim::Angle), "rotation").or("not limited").positive(),
    ],
    "the largest change of a degree of freedom in one step",
);
const ECHO: OptionSpec = OptionSpec::new(
    "-ECHO",
    &[ValueSpec::choice::<YesNo>("YES/NO", "either")],
    "steps are not printed, the report says how many there were",
)
.without_effect();

static SPEC: CommandSpec = CommandSpec {
    options: &[DEFAULTS, ITER_MAX, TOLERANCE_OPTION, IGNORE, OMEGA, MOVE_MAX, ECHO, HARD, BOTH, WIDE],
    detail: "All bodies and active connectors in the environment in force. Newton iteration with the analytic stiffness, of each group of bodies and junctions that \
             connectors join and then of all together; far from equilibrium, and where the stiffness is not stable, it is regularised by a share of the mass. The residual acceleration is \
             reported and must be below the tolerance, a fraction of gravity: 0.001 means a force of a thousandth of the body's weight. -OMEGA and -MOVE_MAX shorten steps, where whole ones go too far or to another equilibrium; they need a \
             larger -ITER_MAX and leave the tolerance as it is. Options but -IGNORE are remembered. Degrees of freedom are global directions at the body's \
             origin. An unrestrained direction without force is left as it is and reported. The result is the \
             configuration from then on; &INSTATE -PREVIOUS goes back. \
             Several equilibria may exist; none is promised.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*A 0 0 20\n&DESCRIBE BODY LOAD\n*HOOK 0 0 2\n*CG 0 0 0\n#WEIGHT *CG 500 1 1 1\n\
              ~TIE SL_ELEM 60 TENSION -LEN 10\nCONNECTOR T ~TIE *HOOK *A\nEND\n&INSTATE -LOCATE LOAD 0 0 8\n\
              &EQUI -ITER_MAX 100 -IGNORE LOAD RZ\n&STATUS F_CONNECTOR",
    ..CommandSpec::new("&EQUI", "finds the equilibrium of bodies and connectors")
};

const MORE: ValueSpec = ValueSpec::choice::<Dof>("DOF", "a further one").or("no more");

/// The degrees of freedom one -IGNORE holds, each with the number of its body.
fn ignored_dofs(model: &Model, given: &Given) -> Outcome<Vec<(usize, usize)>> {
    let position = given.first_place();
    let body = find(&model.bodies, given.first_word().unwrap_or_default(), "body", position)?;
    let index = model.bodies.get_index_of(&Model::key(&body.name)).unwrap_or(0);
    let dofs = given.choices::<Dof>(const { IGNORE.choice("DOF") });
    Ok(dofs.map(|dof| (index, dof.index())).collect())
}

/// What a record asks for, beside what was asked for before.
fn options(job: &Job, call: &Call) -> Outcome<EquilibriumOptions> {
    let args = &call.args;
    let before = if args.has(&DEFAULTS) { EquilibriumOptions::default() } else { job.equilibrium.clone() };
    let mut made = EquilibriumOptions { ignored: Vec::new(), ..before };
    if let Some(most) = args.option_integer(&ITER_MAX) {
        made.most = usize::try_from(most).unwrap_or(made.most);
    }
    if let Some(given) = args.option(&TOLERANCE_OPTION) {
        let [shift, turn] = const { TOLERANCE_OPTION.numbers([TOLERANCE.name, "R"]) }.map(|key| given.number(key));
        let shift = shift.unwrap_or(made.tolerance[0]);
        made.tolerance = [shift, turn.unwrap_or(shift)];
    }
    if let Some(fraction) = args.option_number(&OMEGA) {
        made.fraction = fraction;
    }
    if let Some(given) = args.option(&MOVE_MAX) {
        let [far, turn] = const { MOVE_MAX.numbers(["TRANSLATION", "ANGLE"]) }.map(|key| given.number(key));
        made.longest_step = far.map(|far| [far, turn.unwrap_or(f64::INFINITY)]);
    }
    for given in args.occurrences(&IGNORE) {
        made.ignored.extend(ignored_dofs(&job.model, given)?);
    }
    Ok(made)
}

/// The message of an engine, with who it is about.
pub(crate) fn to_diagnostic(wrong: SolveError, model: &Model, span: Span, units: UnitSystem) -> Box<Diagnostic> {
    let SolveError { who, mut error } = wrong;
    if let Some(who) = who {
        let what = if model.bodies.contains_key(&Model::key(&who)) { "body" } else { "connector" };
        error.message = error.message.with_subject(format!("{what} {who}"));
    }
    error.diagnostic(span, units)
}

/// Warns of what is to be known of dynamic lines where they rest.
pub(crate) fn warn_of_lines(job: &mut Job, span: Span) {
    let mut texts: IndexMap<&str, Vec<String>> = IndexMap::new();
    for (name, text) in static_cautions(&job.model) {
        texts.entry(text).or_default().push(name);
    }
    for (text, names) in texts {
        job.warn(format!("{}: {text}", names.join(", ")), span);
    }
}

/// Warns of tensions beyond a break, and keeps them for the exit code.
pub(crate) fn warn_of_breaks(job: &mut Job, list: Vec<OverBreak>, span: Span) {
    list.iter().for_each(|over| job.warn(over.text(), span));
    job.verdict.over_break.extend(list);
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let options = options(job, call)?;
    if job.model.bodies.is_empty() {
        return Err(
            Diagnostic::error("there is no body to bring to rest", call.args.span).help("&DESCRIBE BODY describes one")
        );
    }
    let before: Vec<Place> = job.model.bodies.values().map(|body| body.position).collect();
    let settled = find_equilibrium_with_rebuilds(&mut job.model, &options)
        .map_err(|e| to_diagnostic(e, &job.model, call.args.span, job.units))?;
    let forces = tables::by_category(&settled.system, &settled.state, &|_| true)
        .map_err(|e| to_diagnostic(e, &job.model, call.args.span, job.units))?;
    let (mut over, mut unknown, mut summaries) = (Vec::new(), Vec::new(), Vec::new());
    for (name, summary) in settled.system.summaries(&settled.state) {
        match summary {
            Ok(summary) => {
                over.extend(check_over_break(name, &summary, "&EQUI"));
                summaries.push((name, summary));
            }
            Err(error) => unknown.push(format!("the tension of {name} is not known: {}", error.error.text(job.units))),
        }
    }
    let (bodies, steps) =
        (settled.system.nodes.iter().filter(|n| !n.junction).count(), settled.found.search.iterations);
    let what = format!("{} and {}", count(bodies, "body"), count(summaries.len() + unknown.len(), "connector"));
    let residual = format!(
        "{:.1e} of gravity is the largest acceleration left; the tolerance is {}",
        settled.found.search.residual, options.tolerance[0]
    );
    let worst = worst_in_state(summaries.iter().map(|(name, summary)| (*name, summary)));
    let broken = !over.is_empty();
    let summary = SolveSummary::new(format!("&EQUI: {what} at rest after {}", count(steps, "step")))
        .line("Residual", residual)
        .worst(worst, job.units)
        .line("Excursion", farthest_move(&before, &job.model, job.units));
    job.equilibrium = EquilibriumOptions { ignored: Vec::new(), ..options };
    let mut list = vec![tables::rest(&job.model, &settled), forces];
    let dampings = body_drift_dampings(&job.model).map_err(|e| e.diagnostic(call.args.span, job.units))?;
    let of_drift = warnings_of_mean_drift(&job.model).map_err(|e| e.diagnostic(call.args.span, job.units))?;
    of_drift.iter().for_each(|text| list.iter_mut().take(1).for_each(|table| table.warn(text)));
    // without a current it matters to motions alone
    if job.model.environment.current.is_some() {
        list.extend(drift_damping_table(&dampings));
        let warnings = dampings.iter().flat_map(|body| &body.warnings);
        warnings.for_each(|text| list.iter_mut().take(1).for_each(|table| table.warn(text)));
    }
    match job.model.check_motions() {
        Ok(()) => list.push(
            tables::periods(&settled.system, &settled.state)
                .map_err(|e| to_diagnostic(e, &job.model, call.args.span, job.units))?,
        ),
        Err(error) => {
            let text = format!("natural periods are left out: {}", error.text(job.units));
            list.iter_mut().take(1).for_each(|t| t.warn(&text));
        }
    }
    note_caveats(&job.model, &mut list);
    list.iter().for_each(|t| raise(job, t, call.args.span));
    warn_of_lines(job, call.args.span);
    warn_of_breaks(job, over, call.args.span);
    unknown.into_iter().for_each(|text| job.warn(text, call.args.span));
    let next = if broken {
        "a line is beyond its break: &STATUS F_CONNECTOR shows all tensions, &STATUS FORCE what acts on the bodies"
    } else {
        "&STATUS F_CONNECTOR: tensions; &STATUS LINE_ANGLES: anchors; &STATUS FORCE: what acts on the bodies"
    };
    summary.print(job, next);
    send_tables(job, &call.args, &list)?;
    Ok(Effect::Done)
}
