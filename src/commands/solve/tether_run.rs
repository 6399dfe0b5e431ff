//! `TDOM -TETHERS`: tethers in time, with bending and dynamics of their own. A run is kept in a file, from whose last checkpoint -RESTART goes on;
//! -STATISTICS keeps statistics alone.
//!
//! Source: [AQWA-TETHER chapters 1 to 4]; [AQWA-REF decks 16, 17].

use crate::commands::name_filter::note_caveats;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::tdom;
use crate::commands::solve::tdom::RunProgress;
use crate::commands::{Call, Effect, Job};
use crate::report::run_log::{self, RunLog};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::unit_vector;
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_solve::tethered::{self, TetherRun, TetherRunSettings};

choices! {
    /// Whose peculiarities a run of tethers has.
    #[derive(Default)]
    pub enum Peculiarities {
        /// None.
        #[default]
        Native = "NATIVE",
        /// Those of AQWA-TETHER.
        Aqwa = "AQWA",
    }
}

/// -TETHERS.
pub const TETHERS: OptionSpec = OptionSpec::new(
    "-TETHERS",
    &[ValueSpec::choice::<Peculiarities>("AS", "AQWA keeps the peculiarities of that program").or("NATIVE")],
    "runs tethers with bending and dynamics of their own, and the body that installed ones hold",
)
.owner(Owner::Ours)
.default("they are bars without mass");
/// -SLAM.
pub const SLAM: OptionSpec = OptionSpec::new(
    "-SLAM",
    &[ValueSpec::new("C", Kind::Number(Dim::None), "factor on the force of entry into the water").not_negative()],
    "slam on a towed tether",
)
.owner(Owner::Ours)
.default("0: none");
/// -TOW.
pub const TOW: OptionSpec = OptionSpec::new(
    "-TOW",
    &[
        ValueSpec::new("V", Kind::Number(Dim::Velocity), "speed over the ground").not_negative(),
        ValueSpec::new("TO", Kind::Number(Dim::Angle), "direction it goes toward, from +X toward +Y"),
    ],
    "the tow of a towed tether: waves meet it with their encounter frequency",
)
.owner(Owner::Ours)
.default("0: it stays");

/// The file of a run of tethers.
pub(crate) const FILE: &str = "TETHERS.run";
/// Options of TDOM that a run of tethers does not take.
const NOT_TAKEN: [OptionSpec; 10] = [
    tdom::NO_CAPSIZE,
    tdom::EQUI,
    tdom::NEWMARK,
    tdom::CONVERGE,
    tdom::RESET,
    tdom::RHO,
    tdom::ADAPTIVE,
    tdom::CHECK,
    tdom::ALONG,
    tdom::SCREEN,
];

/// Runs the tethers of the model.
///
/// # Errors
/// No -TIME, an option that does not go with it, what the engine refuses.
pub fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let span = args.span;
    let stored = job.stored_run.take();
    if let Some(given) = NOT_TAKEN.iter().find_map(|option| args.option(option)) {
        let text = format!("{} does not go with -TETHERS", given.name());
        return Err(Diagnostic::error(text, given.span).help("tethers run by a scheme of two stages with fixed steps"));
    }
    let Some(window) = job.model.environment.time else {
        return Err(Diagnostic::error("the environment has no -TIME: how long, and with which step", span)
            .help("&ENV NAME -TIME TOBSERV DELTA_TIME"));
    };
    let peculiarities = args.option_choice(&TETHERS, const { TETHERS.choice("AS") });
    let compatible = match peculiarities.unwrap_or_default() {
        Peculiarities::Native => false,
        Peculiarities::Aqwa => true,
    };
    let store = args.option_integer(&tdom::STORE);
    let tow = args.option(&TOW).map(|given| {
        let [speed, direction] = given.numbers_or_zero(const { TOW.numbers(["V", "TO"]) });
        let (cos, sin) = unit_vector(direction);
        [speed * cos, speed * sin]
    });
    let start = job.model.environment.run_start;
    let settings = TetherRunSettings {
        start,
        // a stored run is not gone on with
        observed: stored.as_ref().map_or(window.observed, |kept| kept.last_time - start),
        step: window.step,
        store: store.and_then(|n| usize::try_from(n).ok()).unwrap_or(1),
        compatible,
        slam: args.option_number(&SLAM).unwrap_or(0.0),
        tow: tow.unwrap_or_default(),
        transient: window.transient.unwrap_or(0.0),
        keep: !args.has(&tdom::STATISTICS),
    };
    let wrong = |e, job: &Job| to_diagnostic(e, &job.model, span, job.units);
    let mut run = TetherRun::new(&job.model, &job.actions, settings).map_err(|e| wrong(e, job))?;
    let log = match stored {
        Some(kept) => {
            if kept.fingerprint != run.fingerprint() || kept.width != run.width() {
                return Err(Diagnostic::error("the run is not that of the records kept beside it", span)
                    .help("a file that they read has changed, or another version of windlass made the run"));
            }
            run.take_up(&kept.snapshot, &kept.rows).map_err(|e| wrong(e, job))?;
            job.settings.silent = false;
            None
        }
        None => open_log(job, call, &mut run)?,
    };
    let mut progress = RunProgress::with_length(job, (start, window.observed), log);
    let made = run.run(&mut progress);
    drop(progress);
    let made = made.map_err(|e| wrong(e, job))?;
    let mut tables = vec![tethered::run_table(&made)];
    note_caveats(&job.model, &mut tables);
    tables.extend([tethered::actions(&made), tethered::events(&made)].into_iter().filter(|table| table.rows() > 0));
    tables.extend(tethered::statistics_tables(&made));
    job.say_tables(&tables);
    for event in
        made.happened.iter().filter(|e| matches!(e.change, windlass_tether::installed::RigChange::LowerStop { .. }))
    {
        job.warn(format!("tether {} fell on its lower stop at {:.2} s", event.tether, event.time), span);
    }
    if made.interrupted {
        let kept = if made.settings.keep {
            "what it has is kept, and -RESTART goes on"
        } else {
            "the statistics are those up to there"
        };
        job.warn(format!("the run was interrupted: {kept}"), span);
    }
    job.tethered = Some(made);
    Ok(Effect::Done)
}

/// The file of a run that keeps its instants; with -RESTART, what is in it is taken up.
fn open_log(job: &mut Job, call: &Call, run: &mut TetherRun) -> Outcome<Option<RunLog>> {
    let args = &call.args;
    if let (Some(one), Some(other)) = (args.option(&tdom::STATISTICS), args.option(&tdom::RESTART)) {
        let error = Diagnostic::error("-RESTART does not go with -STATISTICS", other.span);
        return Err(error.other(one.span, "it keeps no file to go on from"));
    }
    if args.has(&tdom::STATISTICS) {
        return Ok(None);
    }
    let path = job.output.folder.folder.join(FILE);
    let Some(again) = args.option(&tdom::RESTART) else {
        let refused = |text: String| Diagnostic::error(text, args.span);
        let file = job.output.folder.create(FILE).map_err(|e| refused(e.to_string()))?;
        tdom::keep_records(job, FILE, call, "");
        let log = RunLog::begin((file, path), (run.fingerprint(), run.width()), job.states_taken());
        return Ok(Some(log.map_err(|e| refused(e.to_string()))?));
    };
    let refused =
        |text: String| Diagnostic::error(text, again.span).help("TDOM -TETHERS without -RESTART begins a run");
    let mut file = job.output.folder.reopen(FILE).map_err(|e| refused(e.to_string()))?;
    let kept = run_log::read(&mut file, again.first_number().unwrap_or(f64::INFINITY));
    let kept = kept.map_err(|e| refused(format!("{}: {e}", path.display())))?;
    if kept.fingerprint != run.fingerprint() || kept.width != run.width() {
        let text = format!("the run kept in {} is of another model, environment, step or scheme", path.display());
        return Err(refused(text).help("all must be as they were, -STORE too, but for the time observed"));
    }
    run.take_up(&kept.snapshot, &kept.rows).map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    let log = RunLog::resume(file, path, &kept).map_err(|e| refused(e.to_string()))?;
    job.remark(format!("goes on from {} s", kept.snapshot.time), again.span);
    Ok(Some(log))
}
