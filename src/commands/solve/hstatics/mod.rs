//! `HSTATICS`: hydrostatics, stability and longitudinal strength of one body.
//!
//! Source: [MOSES-REF hstatic]; each command names its own.

pub(crate) mod arms;
pub(crate) mod cform;
pub(crate) mod criteria;
pub(crate) mod equi_h;
pub(crate) mod kg_allow;
pub(crate) mod moment;
pub(crate) mod tank_capacity;

use crate::commands::menu;
use crate::commands::name_filter::raise;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_hydro::stability::StaticWave;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Body, SolveKind, find};

/// HSTATICS.
pub static HSTATICS: Command = Command { spec: &SPEC, edits: false, run };

/// Most rows of a table.
const MAX_ROWS: f64 = 1000.0;

/// What the menu works on.
#[derive(Clone, Debug)]
pub struct HydrostaticsMenu {
    /// The name of the body.
    body: String,
    /// The static wave in force.
    wave: Option<StaticWave>,
}

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MAIN],
    opens: Opens::Menu(&menu::HSTATICS),
    data: &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body").or("the body described last")],
    detail: "Hydrostatics of one body by itself: its connectors are left out. EQUI_H alone changes the configuration. Compartments that are flooded lose their buoyancy in \
             CFORM, and weigh in the others. -WAVE of a command puts the body under a static wave, which stays for the commands that follow up to the END of the menu or \
             a -WAVE of no height: the surface is a cosine along the heading of the body (our reading), the pressure that of the water above, without the decay below a moving wave.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nEND\n&WEIGHT -TOTAL TBRG 23000 200 0 12 38 118 120\n\
              &INSTATE -CONDITION 9\nHSTATICS TBRG\nCFORM 1 1 12\nEND\nRARM 5 12\nPLOT Roll Arm\nEND\nEND",
    ..CommandSpec::new("HSTATICS", "hydrostatics of a body, up to END")
};

/// `-WAVE` of the menu's commands.
const WAVE: OptionSpec = OptionSpec::new(
    "-WAVE",
    &[
        ValueSpec::new("WLENGTH", Kind::Number(Dim::Length), "length of the wave").or("0: no wave").not_negative(),
        ValueSpec::new("STEEP", Kind::Number(Dim::None), "length over height").or("0: no wave").not_negative(),
        ValueSpec::new(
            "CREST",
            Kind::Number(Dim::Length),
            "distance of a crest from the body's origin along its x axis",
        )
        .or("0"),
    ],
    "static wave along the body; it stays until a wave of no height",
)
.default("that of the command before, else still water");

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const BODY: DatumKey<str> = SPEC.word("BODY");
    let args = &call.args;
    let body = match args.word(BODY) {
        Some(name) => find(&job.model.bodies, name, "body", args.position(BODY))?,
        None => job.model.current_body().ok_or_else(|| {
            Diagnostic::error("no body is described yet", args.span).help("&DESCRIBE BODY describes one")
        })?,
    };
    let body = body.name.clone();
    job.menus.push(Menu::Hydrostatics(HydrostaticsMenu { body, wave: None }));
    Ok(Effect::Done)
}

/// The body of the menu.
///
/// # Errors
/// None of its name, or a record of weight or buoyancy whose effect is not computed.
fn body(job: &Job, span: Span) -> Outcome<&Body> {
    job.model.check_effects(SolveKind::Hydrostatics).map_err(|e| e.diagnostic(span, job.units))?;
    let name = job.menus.iter().rev().find_map(|menu| match menu {
        Menu::Hydrostatics(open) => Some(open.body.as_str()),
        _ => None,
    });
    find(&job.model.bodies, name.unwrap_or_default(), "body", span)
}

/// The static wave of `-WAVE`, else the one in force.
fn static_wave(job: &Job, args: &Args) -> Option<StaticWave> {
    let open = job.menus.iter().rev().find_map(|menu| match menu {
        Menu::Hydrostatics(open) => Some(open),
        _ => None,
    })?;
    let Some(given) = args.option(&WAVE) else { return open.wave };
    let [length, steepness, crest] = given.numbers_or_zero(const { WAVE.numbers(["WLENGTH", "STEEP", "CREST"]) });
    let is_wave = length > 0.0 && steepness > 0.0;
    is_wave.then(|| StaticWave { length, height: length / steepness, crest })
}

/// Puts a static wave in force for the commands that follow.
fn keep_wave(job: &mut Job, wave: Option<StaticWave>) {
    for menu in job.menus.iter_mut().rev() {
        if let Menu::Hydrostatics(open) = menu {
            open.wave = wave;
            return;
        }
    }
}

/// The facts of a static wave for the head of a table.
fn with_wave(table: Table, wave: Option<&StaticWave>) -> Table {
    match wave {
        None => table,
        Some(wave) => table
            .fact("Wave Length", wave.length, Dim::Length)
            .fact("Wave Height", wave.height, Dim::Length)
            .fact("Crest", wave.crest, Dim::Length),
    }
}

fn dispose(job: &mut Job, table: Table, span: Span) -> Effect {
    raise(job, &table, span);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
    Effect::Done
}

/// Zero for what rounding leaves of it.
fn clean(x: f64) -> f64 {
    if x.abs() < 1e-9 { 0.0 } else { x }
}
