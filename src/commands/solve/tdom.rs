//! TDOM: the time domain.
//!
//! Source: [MOSES-REF timdom].

use crate::commands::menu;
use crate::commands::solve::equilibrium::{to_diagnostic, warn_of_breaks, warn_of_lines};
use crate::commands::solve::line_loss::{self, LineLoss};
use crate::commands::solve::restart::resume;
use crate::commands::solve::summary::{SolveSummary, count, excursion_in_run, worst_in_run};
use crate::commands::solve::tether_run;
use crate::commands::verdict::over_break_in;
use crate::commands::{Call, Command, Effect, Job};
use crate::report::run_log::{RunLog, StoredRun};
use indicatif::{ProgressBar, ProgressStyle};
use std::io::Write;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Args;
use windlass_hydro::morison::pieces_without_wave_load;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::Model;
use windlass_solve::beyond_database::warnings_of_sea;
use windlass_solve::drift_damping::{body_drift_dampings, drift_damping_table};
use windlass_solve::results::{fender_peaks, fender_table};
use windlass_solve::screening::{self, Screening};
use windlass_solve::slow_checks;
use windlass_solve::time::{
    Ending, Method, Run, RunFileError, RunSettings, Snapshot, StepTolerance, TimeScheme, Trigger, Watcher,
};
use windlass_solve::{SolveError, find_equilibrium_with_rebuilds, run_tables, tethered};

/// TDOM.
pub static TDOM: Command = Command { spec: &SPEC, edits: true, run };

/// The file of a run, in the job's folder.
pub(crate) const FILE: &str = "TDOM.run";

const fn yes_no(help: &'static str) -> ValueSpec {
    ValueSpec::choice::<YesNo>("YES/NO", help)
}

/// `-NO_CAPSIZE`.
pub(crate) const NO_CAPSIZE: OptionSpec =
    OptionSpec::new("-NO_CAPSIZE", &[yes_no("YES goes on")], "goes on beyond a roll or pitch of 90 degrees")
        .default("NO: the run ends there");
/// `-EQUI`.
pub(crate) const EQUI: OptionSpec =
    OptionSpec::new("-EQUI", &[], "begins at the equilibrium with the mean forces, as &EQUI finds it");
/// `-NEWMARK`.
pub(crate) const NEWMARK: OptionSpec = OptionSpec::new(
    "-NEWMARK",
    &[
        yes_no("NO is the predictor and corrector").or("YES"),
        ValueSpec::new("BETA", Kind::Number(Dim::None), "beta").or("that of generalised-alpha").in_range(1e-3, 1.0),
        ValueSpec::new("ALPHA", Kind::Number(Dim::None), "gamma in the usual notation").or("0.5").in_range(0.0, 2.0),
    ],
    "the scheme of bodies and dynamic lines; with NO dynamic lines keep generalised-alpha with spectral radius 0.2",
)
.default("generalised-alpha with spectral radius 0.9; 0.2 with dynamic lines");
/// `-CONVERGE`.
pub(crate) const CONVERGE: OptionSpec = OptionSpec::new(
    "-CONVERGE",
    &[
        ValueSpec::new("NUMB", Kind::Integer, "most iterations of a step").in_range(1.0, 1000.0),
        ValueSpec::new("TOL", Kind::Number(Dim::None), "residual acceleration tolerance (fraction of g)")
            .or("1E-7")
            .in_range(1e-14, 0.1),
    ],
    "when a step is solved",
)
.default("20 1E-7");
/// `-RESTART`.
pub(crate) const RESTART: OptionSpec = OptionSpec::new(
    "-RESTART",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").or("where the run ended").not_negative()],
    "goes on with the run that was kept, from the last snapshot at or before a time",
);
/// `-RESET`.
pub(crate) const RESET: OptionSpec = OptionSpec::new(
    "-RESET",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time").not_negative()],
    "begins with the bodies as they were in the run at a time, at rest or moving; its own time begins at -START of &ENV, or zero",
);
/// `-STORE`.
pub(crate) const STORE: OptionSpec = OptionSpec::new(
    "-STORE",
    &[ValueSpec::new("INCR", Kind::Integer, "steps").in_range(1.0, 1e9)],
    "steps from one stored instant to the next",
)
.default("1");
/// `-RHO`.
pub(crate) const RHO: OptionSpec = OptionSpec::new(
    "-RHO",
    &[ValueSpec::new("R", Kind::Number(Dim::None), "spectral radius at infinite frequency").in_range(0.0, 1.0)],
    "generalised-alpha with another spectral radius, of bodies and dynamic lines: 1 damps nothing, 0 damps most",
)
.owner(Owner::Ours)
.default("0.9; 0.2 with dynamic lines");
/// `-ADAPTIVE`.
pub(crate) const ADAPTIVE: OptionSpec = OptionSpec::new(
    "-ADAPTIVE",
    &[ValueSpec::new("TOL", Kind::Number(Dim::Length), "largest error of place in a step").positive()],
    "halves steps where they err more; rotations count times 10 m",
)
.owner(Owner::Ours)
.default("steps are as given");
const DIVIDING: OptionSpec = OptionSpec::new(
            "-DIVIDING",
            &[ValueSpec::new("T", Kind::Number(Dim::Time), "period").positive()],
            "dividing period between first-order and low-frequency motion; first-order loads of databases act at the low-frequency position and heading",
        )
        .owner(Owner::Ours)
        .default("1.05 times the period above which a hundredth of the energy of the sea is; 15 s without waves");
/// `-CHECK`.
pub(crate) const CHECK: OptionSpec =
    OptionSpec::new("-CHECK", &[], "runs again with half the step and prints the difference of every result")
        .owner(Owner::Ours);
/// `-STATISTICS`.
pub(crate) const STATISTICS: OptionSpec =
    OptionSpec::new("-STATISTICS", &[], "keeps statistics of every result and no instants: flat memory, no file")
        .owner(Owner::Ours);
const BALANCE: OptionSpec =
    OptionSpec::new("-BALANCE", &[], "prints the energy and momentum balance of dynamic lines").owner(Owner::Ours);
/// `-ALONG`.
pub(crate) const ALONG: OptionSpec = OptionSpec::new(
    "-ALONG",
    &[ValueSpec::new("N", Kind::Integer, "every Nth; 0: none").in_range(0.0, 1e6)],
    "keeps every Nth node of dynamic lines, counted from their second ends, and both ends",
)
.owner(Owner::Ours)
.default("1: all nodes");
/// `-SCREEN`.
pub(crate) const SCREEN: OptionSpec = OptionSpec::new(
    "-SCREEN",
    &[yes_no("NO leaves it out")],
    "replays the three most loaded quasi-static lines as dynamic lines after the run",
)
.owner(Owner::Ours)
.default("YES");

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MAIN],
    options: &[
        NO_CAPSIZE,
        EQUI,
        NEWMARK,
        CONVERGE,
        RESTART,
        RESET,
        STORE,
        RHO,
        ADAPTIVE,
        DIVIDING,
        CHECK,
        STATISTICS,
        BALANCE,
        ALONG,
        SCREEN,
        line_loss::LOSE,
        line_loss::LOSE_AT,
        line_loss::INSTANTS,
        line_loss::FOLLOW,
        tether_run::TETHERS,
        tether_run::SLAM,
        tether_run::TOW,
    ],
    detail: "Runs bodies and connectors from where they stand, at rest, over TOBSERV with the step of &ENV -TIME, in the wind, current \
             and waves of the environment, which -RAMP lets grow; the statistics it prints leave out TTRA_SET. Each step balances forces, inertia included, by Newton's iteration; a \
             step that finds no balance is cut in halves, which is counted. -NEWMARK YES 0.25 0.5 is the trapezoidal rule; -NEWMARK NO \
             needs small steps. The bodies of the model stay where they stand. Results go to PRCPOST, and as the run goes to the file \
             TDOM.run in the job's folder, from which -RESTART goes on, also after the program was killed, with the digits of an \
             unbroken run. Ctrl-C ends a run and keeps what it has. Lines without &CONNECTOR -DYNAMICS are quasi-static: at every instant they hang as \
             at rest, without inertia and drag. After the run -SCREEN replays the three of these with the largest tension over break as dynamic \
             lines, ten periods around that tension, with their ends moved as in the run, and warns where they pull more than 1.1 times as hard. \
             A replay has elements of at most 20 m (60 to 200) and takes 1000 to 1200 steps. -TETHERS runs the connectors of class TETHER by the scheme of two stages of AQWA: a towed one \
             alone, its vessel at rest; installed ones with the one body they hold and its other connectors. It takes -STORE, -SLAM and -TOW of the \
             options here, and PRCPOST has TETHER and STRUCTURE for it. &ACTION says what happens during a run: lines that break, winches. \
             -LOSE takes lines away at -LOSE_AT and goes on for -FOLLOW, however long TOBSERV is; statistics are of what is behind the loss. In a study a \
             transient case has the instants from its intact case (docs/studies.md). \
             The first-order loads of a database are linear about the low-frequency place and heading of its body, what a filter leaves of them: \
             of motion with the dividing period and shorter ones 4 % at most, of ten and twenty times the period all within 25 % and 6 %. The period is printed.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*G 0 0 0\n&DESCRIBE BODY CART -IGNORE Y Z RX RY RZ\n*C 0 0 0\n#WEIGHT *C 100 1 1 1\n\
              ~S GSPR BOTH X 40 1000 -LEN 0\nCONNECTOR K ~S *C *G\nEND\n&INSTATE -LOCATE CART 0.5 0 0\n&ENV -TIME 10 0.1\nTDOM",
    ..CommandSpec::new("TDOM", "runs the system in time")
};

/// The scheme where a record says none.
fn usual(model: &Model) -> Method {
    if model.connectors.values().any(|c| c.active && (model.is_dynamic_line(c) || model.holds_pipe(&c.name))) {
        Method::with_moving_lines()
    } else {
        Method::default()
    }
}

/// Most steps of a run: a million a second, which only a single spring reaches, would take a third of a year.
const MAX_TIME_STEPS: f64 = 1e13;

/// How a record wants its run to go.
fn settings(job: &Job, args: &Args) -> Outcome<RunSettings> {
    let Some(window) = job.model.environment.time else {
        return Err(Diagnostic::error("the environment has no -TIME: how long, and with which step", args.span)
            .help("&ENV NAME -TIME TOBSERV DELTA_TIME"));
    };
    let steps = (window.observed / window.step).ceil();
    if steps > MAX_TIME_STEPS {
        let text = format!("-TIME asks for {steps:.3e} steps; at most {MAX_TIME_STEPS:.0e} are taken");
        return Err(Diagnostic::error(text, args.span)
            .help("&ENV NAME -TIME TOBSERV DELTA_TIME: a longer step, or a shorter time"));
    }
    let ramp = job.model.environment.ramp.unwrap_or(job.model.defaults.ramp);
    if ramp > 0.0 && window.step > ramp {
        let shown = |time: f64| Dim::Time.from_si(time, job.units);
        let text = format!("a step of {} s is longer than the ramp of {} s", shown(window.step), shown(ramp));
        return Err(Diagnostic::error(text, args.span)
            .help("the loads would come at once: a longer -RAMP, a shorter step, or -RAMP 0 to have them at once"));
    }
    let method = match args.option(&NEWMARK) {
        Some(given) if !given.is_on() => Method::Corrector,
        Some(given) => match given.number(const { NEWMARK.number("BETA") }) {
            Some(beta) => {
                let scheme = TimeScheme::newmark(beta, given.number(const { NEWMARK.number("ALPHA") }).unwrap_or(0.5));
                if scheme.gamma < 0.5 {
                    return Err(Diagnostic::error("an ALPHA below 0.5 makes every motion grow", given.span));
                }
                Method::Implicit(scheme)
            }
            None => usual(&job.model),
        },
        None => args
            .option_number(&RHO)
            .map_or_else(|| usual(&job.model), |r| Method::Implicit(TimeScheme::generalised_alpha(r))),
    };
    let mut convergence = StepTolerance::default();
    if let Some(given) = args.option(&CONVERGE) {
        let most = given.integer(const { CONVERGE.integer("NUMB") }).and_then(|n| usize::try_from(n).ok());
        convergence.most = most.unwrap_or(convergence.most);
        convergence.tolerance = given.number(const { CONVERGE.number("TOL") }).unwrap_or(convergence.tolerance);
    }
    let whole = |option: &OptionSpec| {
        let given = args.option(option).and_then(|g| g.values.first()).and_then(|v| v.integer());
        given.and_then(|n| usize::try_from(n).ok()).unwrap_or(1)
    };
    Ok(RunSettings {
        observed: window.observed,
        dt: window.step,
        method,
        convergence,
        store: whole(&STORE),
        capsize: args.switch(&NO_CAPSIZE, false),
        adaptive: args.option_number(&ADAPTIVE),
        keep: !args.has(&STATISTICS),
        along: whole(&ALONG),
        balance: args.has(&BALANCE),
        transient: window.transient.unwrap_or(0.0),
    })
}

/// A run that begins.
fn begin_run(job: &mut Job, args: &Args, settings: RunSettings, loss: Option<&LineLoss>) -> Outcome<Run> {
    let wrong = |e, job: &Job| to_diagnostic(e, &job.model, args.span, job.units);
    let mut model = job.model.clone();
    model.parameters.dividing = args.option_number(&DIVIDING);
    let mut velocities = Vec::new();
    let mut began = None;
    if let Some(given) = args.option(&RESET) {
        let time = given.first_number().unwrap_or(0.0);
        velocities = job
            .take_state(time)
            .and_then(|state| state.put(&mut model))
            .ok_or_else(|| Diagnostic::error("there is no run of these bodies to begin from", given.span))?;
        began = Some(format!("as the run before had the bodies at {} s", Dim::Time.from_si(time, job.units)));
    }
    if args.has(&EQUI) {
        let options = job.equilibrium.clone();
        find_equilibrium_with_rebuilds(&mut model, &options).map_err(|e| wrong(e, job))?;
        began = Some(line_loss::BEGAN_AT_EQUILIBRIUM.into());
    }
    let mut actions = job.actions.clone();
    actions.extend(loss.map(LineLoss::action));
    let mut made = Run::new(&model, settings, actions).map_err(|e| wrong(e, job))?;
    if let Some(text) = began {
        made.began = text;
    }
    if !velocities.is_empty() {
        made.begin_with(&velocities).map_err(|e| wrong(e, job))?;
    }
    Ok(made)
}

/// The file that a run is kept in, where it is kept; a run that goes on is taken to where the one in the file was.
fn open_file(job: &mut Job, call: &Call, made: &mut Run, loss: Option<&LineLoss>) -> Outcome<Option<RunLog>> {
    let args = &call.args;
    if !made.settings.keep {
        return Ok(None);
    }
    if let Some(again) = args.option(&RESTART) {
        return resume(job, made, again, args.span).map(Some);
    }
    let path = job.output.folder.folder.join(FILE);
    let refused = |text: String| Diagnostic::error(text, args.span);
    let file = job.output.folder.create(FILE).map_err(|e| refused(e.to_string()))?;
    keep_records(job, FILE, call, &loss.map_or_else(String::new, |loss| loss.missing_options(args)));
    let run = (made.fingerprint(), made.history.layout.width);
    let mut log = RunLog::begin((file, path), run, job.states_taken()).map_err(|e| refused(e.to_string()))?;
    if let Some(kept) = loss.and_then(|loss| loss.common_part(made)) {
        let rows = kept.rows.chunks_exact(kept.width.max(1));
        let written = { rows }.try_for_each(|row| log.row(row)).and_then(|()| log.snapshot(&kept.snapshot));
        written.map_err(|e| refused(e.to_string()))?;
        let time = kept.snapshot.time;
        made.resume_from(&kept.snapshot, kept.rows).map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
        job.remark(
            format!("goes on from {time} s of the run of another instant, which is the same up to there"),
            args.span,
        );
    }
    Ok(Some(log))
}

/// Writes the records that make the model of a run beside the file of the run, its own record last, with options that make it complete:
/// `windlass open` runs them.
pub(crate) fn keep_records(job: &mut Job, file: &str, call: &Call, options: &str) {
    let name = records_of(file);
    let text = format!("{}{}{options}\n", job.journal.script(true), call.record.text().trim());
    let written = if job.journal.overflows() {
        Err("the session has more records than are kept (64 MB)".to_string())
    } else {
        let made = job.output.folder.create(&name).map_err(|e| e.to_string());
        made.and_then(|mut file| file.write_all(text.as_bytes()).map_err(|e| e.to_string()))
    };
    if let Err(error) = written {
        job.warn(format!("{name} is not written, and `windlass open` cannot open the run: {error}"), call.args.span);
    }
}

/// The name of the file of the records of a run that is kept in a file.
pub fn records_of(file: &str) -> String {
    format!("{file}.cif")
}

/// Ends a run where the one in its file ended (s).
struct StoredEnd(f64);

impl Watcher for StoredEnd {
    fn row(&mut self, _: &[f64]) -> Result<(), RunFileError> {
        Ok(())
    }

    fn snapshot(&mut self, _: &Snapshot) -> Result<(), RunFileError> {
        Ok(())
    }

    fn finish(&mut self) -> Result<(), RunFileError> {
        Ok(())
    }

    fn should_continue(&mut self, time: f64) -> bool {
        time < self.0 * (1.0 - 1e-12)
    }
}

/// Takes the run of a file as the last run, with what it came to.
fn open_stored(
    job: &mut Job,
    args: &Args,
    (settings, loss): (RunSettings, Option<&LineLoss>),
    kept: StoredRun,
) -> Outcome<Effect> {
    let span = args.span;
    let mut made = begin_run(job, args, settings, loss)?;
    if kept.fingerprint != made.fingerprint() || kept.width != made.history.layout.width {
        return Err(Diagnostic::error("the run is not that of the records kept beside it", span)
            .help("a file that they read has changed, or another version of windlass made the run"));
    }
    let wrong = |e| to_diagnostic(e, &job.model, span, job.units);
    made.resume_from(&kept.snapshot, kept.rows).map_err(wrong)?;
    // what stands behind the last snapshot is found again, to the same digits
    made.run(&mut StoredEnd(kept.last_time)).map_err(wrong)?;
    let mut tables = vec![run_tables::run_table(&made)];
    tables.extend(run_tables::extremes(&made));
    let summary = summarise(&made, false, job.units);
    job.run = Some(made);
    job.settings.silent = false;
    summary.print(job, "PRCPOST: TRAJECTORY, CONFORCE and others over time; &ANIMATE: a film");
    job.say_tables(&tables);
    Ok(Effect::Done)
}

/// Warns of a scheme that damps dynamic lines too little.
fn warn_of_throwing(job: &mut Job, args: &Args, method: &Method) {
    let Some(given) = args.option(&RHO).or(args.option(&NEWMARK)) else { return };
    let damps = given.is(&RHO) && given.first_number().is_some_and(|r| r <= 0.2);
    let usual = usual(&job.model);
    if damps || *method == usual || usual != Method::with_moving_lines() {
        return;
    }
    let text = match method {
        Method::Corrector => return,
        Method::Implicit(scheme) if !scheme.unconditionally_stable() => {
            "dynamic lines have short natural periods: with 2 BETA below ALPHA the step must be shorter than these, or the lines become unstable"
        }
        Method::Implicit(_) => {
            "with -RHO above 0.2 a body on a stiff dynamic line that goes slack within a step can rebound too high"
        }
    };
    job.warn(text, given.span);
}

/// Warns of pieces that displace water and that the waves of a run move by no pressure.
fn warn_of_still_pieces(job: &mut Job, made: &Run, span: Span) {
    if made.sea.is_none() {
        return;
    }
    for (name, body) in &made.model.bodies {
        let list: Vec<&str> = pieces_without_wave_load(&made.model, body).map(|p| p.name.as_str()).collect();
        if list.is_empty() {
            continue;
        }
        let remedy = match body.database {
            Some(_) => format!("-DIFTYPE 3DDIF says that they are in the database of {name}"),
            None => "-DIFTYPE FK gives them the pressure of the waves".to_owned(),
        };
        let text =
            format!("waves of first order exert nothing on {}: neither members nor of a database", list.join(" "));
        job.warn(format!("{text}; {remedy}"), span);
    }
}

/// Warns of actions at times that the run does not reach.
fn warn_of_late_actions(job: &mut Job, made: &Run, span: Span) {
    let end = made.end();
    let late = made.actions.iter().filter_map(|action| match action.when {
        Trigger::At(time) if time > end => Some(format!("{} at {time} s", action.name)),
        _ => None,
    });
    let list: Vec<String> = late.collect();
    if !list.is_empty() {
        job.warn(format!("the run ends at {end} s, before the actions {}", list.join(", ")), span);
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.span);
    if args.has(&tether_run::TETHERS) {
        return tether_run::run(job, call);
    }
    if let Some(given) = args.option(&tether_run::SLAM).or(args.option(&tether_run::TOW)) {
        return Err(Diagnostic::error(format!("{} goes with -TETHERS", given.name()), given.span));
    }
    let mut settings = settings(job, args)?;
    if job.model.bodies.is_empty() {
        return Err(Diagnostic::error("there is no body to move", span).help("&DESCRIBE BODY describes one"));
    }
    let loss = LineLoss::new(job, args)?;
    if let Some(loss) = &loss {
        settings = loss.settings(job, settings, args)?;
    }
    let loss = loss.as_ref();
    job.line_loss = loss.map(|loss| loss.instant.clone());
    if let Some(kept) = job.stored_run.take() {
        return open_stored(job, args, (settings, loss), kept);
    }
    let mut made = begin_run(job, args, settings, loss)?;
    let log = open_file(job, call, &mut made, loss)?;
    if let Some(loss) = loss {
        job.remark(loss.remark(), span);
    }
    warn_of_still_pieces(job, &made, span);
    if tethered::has_tethers(&job.model) {
        job.remark(
            "tethers are bars without mass in this run: -TETHERS gives them bending and dynamics of their own",
            span,
        );
    }
    warn_of_throwing(job, args, &made.settings.method);
    warn_of_late_actions(job, &made, span);
    warn_of_lines(job, span);
    let mut going = RunProgress::new(job, &made, log);
    let dampings = body_drift_dampings(&made.model).map_err(|e| e.diagnostic(span, job.units))?;
    let of_damping = dampings.iter().flat_map(|body| body.warnings.iter().cloned());
    let of_sea = warnings_of_sea(&made.model).map_err(|e| e.diagnostic(span, job.units))?;
    let of_drift = slow_checks::warnings_of_slow_drift(&made).into_iter().chain(of_damping).chain(of_sea);
    for text in run_tables::warnings_of_step(&made).into_iter().chain(of_drift) {
        // at once for who looks on; for the log with the record
        going.bar.println(format!("warning: {text}"));
        job.warn(text, span);
    }
    let ended = made.run(&mut going);
    drop(going);
    let same = loss.map_or(Ok(()), |loss| loss.compare(&made));
    let screening = screen_lines(job, args, &made, ended.as_ref().ok());
    let mut first = run_tables::run_table(&made);
    if let Err(Some(reason)) = &screening {
        first.note(format!("the quasi-static lines are not replayed as dynamic lines: {reason}"));
    }
    for text in slow_checks::drift_methods(&made) {
        first.note(text);
    }
    let screening = screening.unwrap_or_default();
    first.add_notes(screening::remarks(&screening, job.units));
    let mut tables = vec![first];
    tables.extend(drift_damping_table(&dampings));
    tables.extend(run_tables::extremes(&made));
    tables.extend(run_tables::balance(&made));
    // what is not found of them costs no run
    let peaks = fender_peaks(&made);
    let fenders = peaks.as_deref().unwrap_or_default();
    if !fenders.is_empty() {
        let rows = fenders.iter().map(|p| (p.name.as_str(), &p.state, Some(p.time)));
        tables.push(fender_table("Fenders at Their Largest Deflection", rows));
    }
    tables.extend(screening::table(&screening));
    let checked = match &ended {
        Ok(_) if args.has(&CHECK) => Some(check(job, &made)),
        _ => None,
    };
    if let Some(Ok(list)) = &checked {
        tables.extend(list.iter().cloned());
    }
    let over = over_break_in(&made);
    let (poor, kept) = (ended.as_ref().ok().and_then(|_| run_tables::warning_of_accuracy(&made)), made.settings.keep);
    let summary = summarise(&made, ended.is_err(), job.units);
    let broken = !over.is_empty();
    job.run = Some(made);
    job.screened = screening.replays.iter().map(|replay| (replay.line.clone(), replay.ratio())).collect();
    if let Some(text) = poor {
        job.warn(text, span);
    }
    for text in screening::warnings(&screening, job.units) {
        job.warn(text, span);
    }
    warn_of_breaks(job, over, span);
    for p in fenders.iter().filter(|p| p.state.deflection > p.state.rated) {
        let share = 100.0 * p.state.deflection / p.state.rated;
        let text =
            format!("fender {} is deflected to {share:.0} per cent of its rated deflection at {:.1} s", p.name, p.time);
        job.warn(text, span);
    }
    match &ended {
        Ok(Ending::Done) | Err(_) => {}
        Ok(Ending::Interrupted) if kept => {
            job.warn("the run was interrupted: what it has is kept, and -RESTART goes on", span);
        }
        Ok(Ending::Interrupted) => {
            job.warn("the run was interrupted: the statistics are those up to there; -STATISTICS keeps no file to go on from", span);
        }
        Ok(Ending::Capsized(name)) => {
            job.warn(
                format!("body {name} rolled or pitched beyond 90 degrees: the run ended there (-NO_CAPSIZE YES)"),
                span,
            );
        }
        Ok(Ending::Stopped(name)) => job.remark(format!("action {name} ended the run"), span),
    }
    let next = match (broken, kept) {
        (true, _) => "a line is beyond its break: PRCPOST, CONFORCE NAME shows its force over time",
        (false, true) => "PRCPOST: TRAJECTORY, CONFORCE and others over time; &ANIMATE: a film",
        (false, false) => "the statistics below; without -STATISTICS instants are kept for PRCPOST",
    };
    summary.print(job, next);
    job.say_tables(&tables);
    let wrong = |e| to_diagnostic(e, &job.model, span, job.units);
    ended.map_err(wrong)?;
    same.map_err(|text| {
        Diagnostic::error(text, span).help("the script makes the same run of both cases up to the loss")
    })?;
    checked.transpose().map_err(wrong)?;
    peaks.map_err(wrong)?;
    Ok(Effect::Done)
}

/// What a run came to, in a few lines.
fn summarise(made: &Run, failed: bool, units: UnitSystem) -> SolveSummary {
    let asked = if failed { "FAILED at" } else { "reached" };
    let head =
        format!("TDOM: {asked} {:.1} s of {:.1} s in {}", made.time(), made.end(), count(made.counts.steps, "step"));
    let residual = format!("each step converged to {:e} of gravity", made.settings.convergence.tolerance);
    SolveSummary::new(head)
        .line("Residual", residual)
        .worst(worst_in_run(made), units)
        .line("Excursion", excursion_in_run(made, units))
}

/// The quasi-static lines of a run that ended, replayed as dynamic lines; or why not, where there are such lines.
fn screen_lines(
    job: &Job,
    args: &Args,
    made: &Run,
    ending: Option<&Ending>,
) -> Result<Screening, Option<&'static str>> {
    let off = !args.switch(&SCREEN, true);
    let reason = match ending {
        _ if screening::quasi_static_lines(made).is_empty() => return Err(None),
        _ if off => "-SCREEN NO",
        None => "the run failed",
        Some(Ending::Interrupted) => "the run was interrupted",
        Some(_) if !made.settings.keep => "-STATISTICS keeps no motion of their ends",
        Some(_) => return Ok(screening::screen(made, &|| !job.is_interrupted())),
    };
    Err(Some(reason))
}

/// The same run again with half the step, and what differs.
fn check(job: &Job, first: &Run) -> Result<Vec<Table>, SolveError> {
    let mut again = first.restart_with(|s| RunSettings { dt: s.dt / 2.0, store: s.store.saturating_mul(2), ..s })?;
    let mut going = RunProgress::new(job, &again, None);
    again.run(&mut going)?;
    Ok(run_tables::comparison_tables(first, &again.history))
}

/// Where the progress of a run goes: its file, the terminal; and Ctrl-C.
pub(crate) struct RunProgress {
    log: Option<RunLog>,
    interrupt: Arc<AtomicBool>,
    bar: ProgressBar,
    start: f64,
    asked: u64,
}

/// Steps between two looks at the terminal.
const STEPS_PER_TERMINAL_CHECK: u64 = 256;

impl RunProgress {
    fn new(job: &Job, run: &Run, log: Option<RunLog>) -> Self {
        RunProgress::with_length(job, (run.start(), run.settings.observed), log)
    }

    /// That of a run from a start over a time (s).
    pub(crate) fn with_length(job: &Job, (start, observed): (f64, f64), log: Option<RunLog>) -> Self {
        // hidden when nobody looks: it goes to the terminal behind stderr alone
        let bar = ProgressBar::new(observed.ceil() as u64);
        if let Ok(style) = ProgressStyle::with_template("{bar:30} {msg}, {elapsed} gone, {eta} to go") {
            bar.set_style(style);
        }
        RunProgress { log, interrupt: Arc::clone(&job.interrupt), bar, start, asked: 0 }
    }
}

impl Drop for RunProgress {
    fn drop(&mut self) {
        self.bar.finish_and_clear();
    }
}

impl Watcher for RunProgress {
    fn row(&mut self, row: &[f64]) -> Result<(), RunFileError> {
        self.log.as_mut().map_or(Ok(()), |log| log.row(row))
    }

    fn snapshot(&mut self, snapshot: &Snapshot) -> Result<(), RunFileError> {
        self.log.as_mut().map_or(Ok(()), |log| log.snapshot(snapshot))
    }

    fn finish(&mut self) -> Result<(), RunFileError> {
        self.log.as_mut().map_or(Ok(()), |log| log.finish())
    }

    fn should_continue(&mut self, time: f64) -> bool {
        if self.asked.is_multiple_of(STEPS_PER_TERMINAL_CHECK) {
            let gone = time - self.start;
            let rate = gone / self.bar.elapsed().as_secs_f64().max(1e-9);
            self.bar.set_position(gone.max(0.0) as u64);
            self.bar.set_message(format!("{time:.1} s, {rate:.0} times real time"));
        }
        self.asked += 1;
        !self.interrupt.load(Ordering::Relaxed)
    }
}
