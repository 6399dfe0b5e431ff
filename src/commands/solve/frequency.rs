//! The FREQ_RESPONSE menu: motions of unit waves, and those in a sea.
//!
//! Source: [MOSES-REF freq_mot].

use crate::commands::environment::env;
use crate::commands::environment::probability;
use crate::commands::menu;
use crate::commands::name_filter::raise;
use crate::commands::post::frequency_posts::MPM_DURATION_S;
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::summary::{SolveSummary, count, largest_in_sea, largest_operators, worst_in_sea};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::page;
use std::f64::consts::TAU;
use std::sync::Arc;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::span::Span;
use windlass_base::table::{Table, TableNote};
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Environment, Model, find};
use windlass_solve::beyond_database::{warnings_of_frequencies, warnings_of_sea};
use windlass_solve::frequency::{
    ExtremeKind, FrequencyResponse, LinearSystem, Operators, ResponseOptions, Trains, WaveBand, respond,
    warnings_of_free_drift, warnings_of_modes,
};

/// FREQ_RESPONSE.
pub static FREQ_RESPONSE: Command = Command { spec: &MENU_SPEC, edits: false, run: open };
/// RAO.
pub static RAO: Command = Command { spec: &RAO_SPEC, edits: false, run: rao };
/// SRESPONSE.
pub static SRESPONSE: Command = Command { spec: &SRESPONSE_SPEC, edits: false, run: sresponse };

/// What the menu has found.
#[derive(Clone, Debug, Default)]
pub enum FrequencyResults {
    /// Nothing yet.
    #[default]
    Nothing,
    /// Motions of unit waves.
    Operators(Arc<LinearSystem>, Operators),
    /// Motions in a sea, and the extreme its environment asks for.
    Spectral(Arc<LinearSystem>, FrequencyResponse, Option<ExtremeKind>),
}

/// The open menu: what it has found, and the point asked for last.
#[derive(Clone, Debug, Default)]
pub struct FrequencyMenu {
    /// What it has found.
    pub results: FrequencyResults,
    /// The points of the last FR_POINT: one, or one and another it is relative to.
    pub points: Vec<PlacedPoint>,
}

/// A point of a body.
#[derive(Clone, Debug, PartialEq)]
pub struct PlacedPoint {
    /// Its name, or its coordinates.
    pub name: String,
    /// Its body.
    pub body: String,
    /// Where it is in the body (m).
    pub at: [f64; 3],
}

impl FrequencyResults {
    /// The equations it was found with.
    pub(crate) fn linear(&self) -> Option<&Arc<LinearSystem>> {
        match self {
            FrequencyResults::Nothing => None,
            FrequencyResults::Operators(linear, _) | FrequencyResults::Spectral(linear, ..) => Some(linear),
        }
    }
}

/// The records of a body that heaves in waves, and the menu open, for examples.
macro_rules! heaving {
    () => {
        "&DIMEN -DIMEN METERS K-NTS\n&FILE OPEN A ball.1\n&FILE WRITE A 6 3 3 900 300\n&FILE WRITE A 9 3 3 1100 400\n&FILE CLOSE A\n\
         &FILE OPEN X ball.3\n&FILE WRITE X 6 180 3 150 0 150 0\n&FILE WRITE X 9 180 3 220 0 220 0\n&FILE CLOSE X\n\
         MEDIT\n*G 0 0 1\n&DESCRIBE BODY BALL -IGNORE X Y RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 20000 4 4 4\n\
         #HYDROSTATIC *CG 3000 0 0 -BUOYANCY 20000 -ZCGE 0\n~S GSPR BOTH Z 100 1000 -LEN 0\nCONNECTOR LINE ~S *CG *G\n\
         DATABASE BALL -WAMIT job.ans/ball\nEND\n&EQUI\n&ENV -SEA ISSC 0 2 8\nFREQ_RESPONSE\n"
    };
}
pub(crate) use heaving;

static MENU_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MAIN],
    opens: Opens::Menu(&menu::FREQ_RESPONSE),
    detail: "RAO or SRESPONSE finds the motions of all bodies about their present places, which &EQUI should have found: the stiffness \
             is that of everything there. MOTION, FR_POINT and CONFORCE then show them, STATISTICS reports what they come to in a sea. \
             Waves act on the bodies that have a DATABASE; they do not on members, whose drag meets the body alone, and gusts have no part in it.",
    example: concat!(heaving!(), "RAO\nMOTION BALL\nREPORT\nEND\nEND"),
    ..CommandSpec::new("FREQ_RESPONSE", "motions in the frequency domain, up to END")
};

const PERIOD: OptionSpec = OptionSpec::new(
    "-PERIOD",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "period of the waves").positive()],
    "periods",
)
.repeating(1);

const HEADING: OptionSpec = OptionSpec::new(
    "-HEADING",
    &[ValueSpec::new("H", Kind::Number(Dim::Angle), "where the waves come from, from +X toward +Y")],
    "headings",
)
.repeating(1)
.default("those of &DEFAULT, else of the first body's database");

const SPEED: OptionSpec = OptionSpec::new(
    "-SPEED",
    &[ValueSpec::new(
        "V",
        Kind::Number(Dim::WindSpeed),
        "speed in knots, toward -X of the first body: ahead, with the origin at the bow",
    )],
    "the speed of the bodies (our reading)",
)
.default("0");

static RAO_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::FREQ_RESPONSE],
    options: &[PERIOD.default("those of &DEFAULT, else of the databases"), HEADING, SPEED],
    detail: "Motions in waves of unit amplitude, at each heading and period. Damping is that of radiated waves, #DAMP, #DRAG and \
             connectors, as it is at rest: what grows with the velocity has none. A new sea may then be given with STATISTICS. Slow drift \
             has no part in it. With -SPEED periods are those of the waves; the bodies move at the period at which they meet them, with added mass and damping there, \
             and forces of the waves are those without speed: what speed itself changes in radiation and excitation is left out (our reading).",
    example: concat!(
        heaving!(),
        "RAO -PERIOD 6 7 8 9 -HEADING 0\nMOTION BALL\nVIEW Period 'Z Amp' 'Z Phase'\nEND\nEND"
    ),
    ..CommandSpec::new("RAO", "motions in unit waves")
};

static SRESPONSE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::FREQ_RESPONSE],
    data: &[ValueSpec::new("ENV", Kind::Name(Noun::Environment), "environment").or("the environment in force")],
    options: &[PERIOD.default("those of -E_PERIOD, else as the sea and the natural periods need them")],
    detail: "Motions in the seas of an environment, as spectra. Damping that grows with the velocity is linearised in that sea: it is the mean \
             that the velocities meet, found anew until both agree. Slow drift is added for bodies whose database has drift, by Newman's approximation, \
             with all damping; -DRIFT MEAN or NONE of DATABASE leaves it out, and QTF takes the mean drift of the QTF. Spread seas have eleven directions. Mean forces, also of \
             wind and current, are in the place at rest and its stiffness; gusts have no part in it.",
    example: concat!(heaving!(), "SRESPONSE\nSTATISTICS MOTION BALL\nREPORT\nEND\nEND"),
    ..CommandSpec::new("SRESPONSE", "motions in a sea")
};

fn open(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::Frequency(Box::default()));
    Ok(Effect::Done)
}

/// What is said where there are no motions.
pub(crate) fn no_motions(job: &Job, span: Span) -> Box<Diagnostic> {
    job.lacks_results("there are no motions yet", &["RAO", "SRESPONSE"], "RAO or SRESPONSE finds them", span)
}

/// What the open menu has found.
///
/// # Errors
/// Nothing yet.
pub(crate) fn open_results(job: &Job, span: Span) -> Outcome<&FrequencyResults> {
    match open_menu(job).map(|menu| &menu.results) {
        Some(FrequencyResults::Nothing) | None => Err(no_motions(job, span)),
        Some(found) => Ok(found),
    }
}

/// The open menu.
fn open_menu(job: &Job) -> Option<&FrequencyMenu> {
    job.menus.iter().rev().find_map(|menu| match menu {
        Menu::Frequency(found) => Some(found.as_ref()),
        _ => None,
    })
}

/// The points of the last FR_POINT; none before the first.
pub(crate) fn last_points(job: &Job) -> &[PlacedPoint] {
    open_menu(job).map_or(&[], |menu| &menu.points)
}

/// Keeps the points of an FR_POINT for what is asked about them.
pub(crate) fn keep_points(job: &mut Job, points: Vec<PlacedPoint>) {
    let menu = job.menus.iter_mut().rev().find_map(|menu| match menu {
        Menu::Frequency(found) => Some(found),
        _ => None,
    });
    if let Some(menu) = menu {
        menu.points = points;
    }
}

fn keep(job: &mut Job, made: FrequencyResults) {
    if let Some(Menu::Frequency(found)) = job.menus.last_mut() {
        found.results = made;
    }
}

/// The equations of a model, on whose bodies waves must act.
fn linear(job: &Job, model: &Model, span: Span) -> Outcome<LinearSystem> {
    let made = LinearSystem::new(model).map_err(|e| to_diagnostic(e, model, span, job.units))?;
    if !made.is_excited() {
        return Err(Diagnostic::error("waves act on no body: none has a database with wave forces", span)
            .help("DATABASE BODY -WAMIT ROOT, -NEMOH FOLDER or -CAPYTAINE FILE reads one"));
    }
    Ok(made)
}

/// Frequencies of the periods of a record (rad/s).
fn frequencies(args: &Args) -> Vec<f64> {
    args.option(&PERIOD).map_or(Vec::new(), |g| g.numbers().iter().map(|t| TAU / t).collect())
}

fn rao(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let mut linear = linear(job, &job.model, args.span)?;
    linear.set_speed(args.option_number(&SPEED).unwrap_or(0.0));
    let mut periods = frequencies(args);
    if periods.is_empty() {
        periods = job.model.wave_defaults.periods.iter().map(|period| TAU / period).collect();
    }
    if periods.is_empty() {
        periods = linear.frequencies();
    }
    let usual = || Some(job.model.wave_defaults.headings.clone()).filter(|list| !list.is_empty());
    let headings = args.option(&HEADING).map(|given| given.numbers()).or_else(usual);
    let headings = headings.unwrap_or_else(|| linear.headings());
    let made =
        Operators::new(&linear, &periods, &headings).map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    let mut table = Table::new("Motions in Unit Waves").fact("Periods", periods.len(), Dim::None).fact(
        "Headings",
        headings.len(),
        Dim::None,
    );
    table.add_notes(linear.notes.iter().cloned());
    table.add_notes(linear.without_waves.iter().map(TableNote::warning));
    table.add_notes(warnings_of_frequencies(&job.model, &periods).into_iter().map(TableNote::warning));
    let waves = WaveBand { frequencies: &periods, headings: &headings };
    table.add_notes(warnings_of_modes(&linear, waves).into_iter().map(TableNote::warning));
    let [shift, turn] = largest_operators(&linear, &made, job.units);
    let what = format!("{} and {}", count(periods.len(), "period"), count(headings.len(), "heading"));
    let summary = SolveSummary::new(format!("RAO: motions in unit waves of {what}"))
        .line("Residual", "none: the equations are linear and solved directly")
        .line("Excursion", shift)
        .line("Rotation", turn);
    say(
        job,
        (summary, "MOTION BODY: operators; STATISTICS MOTION|TENSION: in a sea, with the worst line"),
        &table,
        args.span,
    );
    keep(job, FrequencyResults::Operators(Arc::new(linear), made));
    Ok(Effect::Done)
}

/// Prints a summary with what to look at next, then facts, and raises warnings.
fn say(job: &mut Job, (summary, next): (SolveSummary, &str), table: &Table, span: Span) {
    raise(job, table, span);
    summary.print(job, next);
    let mut plain = table.clone();
    plain.notes.retain(|note| note.severity != Severity::Warning);
    // the table is kept as it was raised
    job.keep_for_page(std::slice::from_ref(table));
    let (units, head) = (job.units, job.page_head());
    job.say_fitted(|width| page::render(&plain, units, &head, width));
}

/// The seas of an environment.
///
/// # Errors
/// Calm water; a sea that cannot be.
pub(crate) fn seas(job: &Job, env: &Environment, span: Span) -> Outcome<Trains> {
    match Trains::new(&job.model, env).map_err(|e| e.diagnostic(span, job.units))? {
        Some(made) => Ok(made),
        None => Err(Diagnostic::error("the environment has no sea", span).help("&ENV -SEA gives it one")),
    }
}

fn sresponse(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const ENV: DatumKey<str> = SRESPONSE_SPEC.word("ENV");
    let args = &call.args;
    let mut model = job.model.clone();
    if let Some(name) = args.word(ENV) {
        model.environment = find(&job.model.environments, name, "environment", args.position(ENV))?.clone();
    }
    let trains = seas(job, &model.environment, args.span)?;
    let mut linear = linear(job, &model, args.span)?;
    let mut frequencies = frequencies(args);
    if frequencies.is_empty() {
        let of_env = model.environment.options.iter().find(|given| given.is(&env::E_PERIOD));
        frequencies = of_env.map_or(Vec::new(), |g| g.numbers().iter().map(|t| TAU / t).collect());
    }
    frequencies.sort_by(f64::total_cmp);
    frequencies.dedup();
    let asked = ResponseOptions { frequencies, spectral: true };
    let made = respond(&mut linear, &trains, &asked).map_err(|e| to_diagnostic(e, &model, args.span, job.units))?;
    let mut table = Table::new("Motions in a Sea")
        .fact("Frequencies of Waves", made.waves.len(), Dim::None)
        .fact("Frequencies of Slow Drift", made.slow.len(), Dim::None)
        .fact("Rounds of Linearisation", made.rounds, Dim::None);
    table.add_notes(linear.notes.iter().cloned());
    table.add_notes(linear.without_waves.iter().map(TableNote::warning));
    let of_sea = warnings_of_sea(&model).map_err(|e| e.diagnostic(args.span, job.units))?;
    table.add_notes(of_sea.into_iter().map(TableNote::warning));
    let (met, headings): (Vec<f64>, _) = (made.waves.iter().map(|point| point.frequency).collect(), trains.headings());
    let waves = WaveBand { frequencies: &met, headings: &headings };
    let of_modes = warnings_of_modes(&linear, waves).into_iter().chain(warnings_of_free_drift(&linear));
    table.add_notes(of_modes.map(TableNote::warning));
    let extreme = probability::extreme(&model);
    let kind = extreme.unwrap_or(ExtremeKind::MostProbable(MPM_DURATION_S));
    let both = (&linear, &made);
    let summary = SolveSummary::new(format!("SRESPONSE: motions in a sea of {}", count(made.waves.len(), "frequency")))
        .line("Residual", format!("damping and velocities agree after {}", count(made.rounds, "round")))
        .worst(worst_in_sea(&model, both, kind, &|_| true), job.units)
        .line("Excursion", largest_in_sea(both, kind, job.units));
    say(
        job,
        (summary, "STATISTICS MOTION|TENSION|POINT: deviations and extremes; MOTION BODY: spectra"),
        &table,
        args.span,
    );
    keep(job, FrequencyResults::Spectral(Arc::new(linear), made, extreme));
    Ok(Effect::Done)
}
