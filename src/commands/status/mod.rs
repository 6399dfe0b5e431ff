//! `&STATUS`: what the model and the program hold.

pub(crate) mod assembly_table;
pub(crate) mod body_status;
pub(crate) mod body_tables;
pub(crate) mod buoyancy_weight;
pub(crate) mod categories;
pub(crate) mod class_tables;
pub(crate) mod compartments;
pub(crate) mod curve_table;
pub(crate) mod database_table;
pub(crate) mod draft_marks;
pub(crate) mod environment_table;
pub(crate) mod fatigue_table;
pub(crate) mod forces;
pub(crate) mod kind;
pub(crate) mod line_angles;
pub(crate) mod line_types;
pub(crate) mod loads_table;
pub(crate) mod model_tables;
pub(crate) mod offsets;
pub(crate) mod rod_status;
pub(crate) mod sea_table;
pub(crate) mod settings_table;
pub(crate) mod spread;
pub(crate) mod summary_menu;
pub(crate) mod system;
pub(crate) mod tether_status;
pub(crate) mod time_series;
pub(crate) mod wind_table;

use crate::commands::menu;
use crate::commands::name_filter::{NameFilter, note_caveats, raise};
use crate::commands::output::disposition::{BOTH, DISPOSE, HARD, WIDE, open_chosen_table, send};
use crate::commands::status::kind::{Query, StatusKind};
use crate::commands::verdict::Verdict;
use crate::commands::{Call, Command, Effect, Job, Menu, absent};
use crate::report::disposition::Disposition;
use crate::report::page;
use crate::report::plot::Chart;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::values::{Args, Noun};
use windlass_language::select::{Owner, choose, list_known};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::EntityKind;

/// &STATUS.
pub static STATUS: Command = Command { spec: &SPEC, edits: false, run };

choices! {
    /// The forces of reports [MOSES-REF forces].
    pub(crate) enum ForceName {
        Weight = "WEIGHT",
        Contents = "CONTENTS",
        Buoyancy = "BUOYANCY",
        Wind = "WIND",
        ViscousDrag = "V_DRAG",
        Wave = "WAVE",
        RadiationDrag = "R_DRAG",
        Slam = "SLAM",
        Coriolis = "CORIOLIS",
        WaveDrift = "W_DRIFT",
        Deformation = "DEFORMATION",
        Extra = "EXTRA",
        Applied = "APPLIED",
        Inertia = "INERTIA",
        AddedInertia = "A_INERTIA",
        ConvolutionInertia = "C_INERTIA",
        FlexibleConnectors = "FLEX_CONNECTORS",
        RigidConnectors = "RIGID_CONNECTORS",
        Total = "TOTAL",
    }
}

/// Every kind, in the order of the help.
static KINDS: &[&StatusKind] = &[
    &model_tables::CONFIGURATION,
    &class_tables::CL_FLEX,
    &model_tables::G_CONNECTOR,
    &forces::F_CONNECTOR,
    &forces::FOUNDATION,
    &line_angles::LINE_ANGLES,
    &spread::SPREAD,
    &spread::DG_CONNECTOR,
    &system::SYSTEM,
    &body_status::FORCE,
    &buoyancy_weight::B_W,
    &categories::CATEGORY,
    &draft_marks::DRAFT,
    &assembly_table::ASSEMBLIES,
    &body_status::STIFFNESS,
    &body_status::MODES,
    &curve_table::CURVES,
    &model_tables::BATHYMETRY,
    &model_tables::T_PRESSURE,
    &environment_table::ENVIRONMENT,
    &wind_table::WIND_SPECTRUM,
    &sea_table::SEA_SPECTRUM,
    &time_series::SEA_TSERIES,
    &time_series::WIND_TSERIES,
    &settings_table::RUN,
    &rod_status::ROD,
    &rod_status::ROD_MODES,
    &tether_status::TETHERS,
    &tether_status::TETHER_MODES,
    &class_tables::CLASSES,
    &loads_table::LOADS,
    &body_tables::WEIGHT,
    &body_tables::PIECES,
    &compartments::COMPARTMENT,
    &compartments::V_HOLES,
    &body_tables::HYDROSTATICS,
    &database_table::DATABASE,
    &model_tables::BODIES,
    &model_tables::POINTS,
    &settings_table::DIMENSIONS,
    &settings_table::DEFAULTS,
    &model_tables::SELECTORS,
    &system::SIZE,
    &system::NAMES,
    &system::PARAMETER,
    &system::PROCESS,
    &fatigue_table::SN,
    &line_types::LINE_TYPES,
];

/// What &STATUS can tell of, with one line each, for its help.
pub fn listed_kinds() -> impl Iterator<Item = (&'static str, String)> {
    rows().map(|(name, help, _)| (name, help))
}

/// Every kind with one line of help, and whose word it is.
pub fn rows() -> impl Iterator<Item = (&'static str, String, Owner)> {
    KINDS.iter().map(|kind| {
        let help = match kind.aliases {
            [] => kind.help.to_string(),
            aliases => format!("{} (also {})", kind.help, aliases.join(", ")),
        };
        (kind.name, help, kind.owner)
    })
}

/// What &STATUS can tell of, for completion: each word with the kind it asks for.
pub fn kinds() -> impl Iterator<Item = (&'static str, Owner, &'static str)> + Clone {
    KINDS.iter().flat_map(|kind| {
        let aliases = kind.aliases.iter().map(|alias| (*alias, Owner::Moses, kind.name));
        std::iter::once((kind.name, kind.owner, kind.name)).chain(aliases)
    })
}

/// The sorts of things whose names a kind of [`kinds`] takes.
pub fn names(kind: &str) -> &'static [EntityKind] {
    find_kind(kind).names
}

/// The kind of a name of [`kinds`].
fn find_kind(name: &str) -> &'static StatusKind {
    KINDS.iter().find(|kind| kind.name == name).copied().unwrap_or(&model_tables::SUMMARY)
}

const PLOT: OptionSpec = OptionSpec::new(
    "-PLOT",
    &[],
    "plots CURVES, the spectra of SEA_SPECTRUM and WIND_SPECTRUM, SEA_TSERIES, WIND_TSERIES or the lines of DG_CONNECTOR and ROD, \
     and opens the disposition menu over the table of the first plot, as in MOSES",
);
/// `-NUMBER`.
pub(crate) const NUMBER: OptionSpec = OptionSpec::new(
    "-NUMBER",
    &[ValueSpec::new("N", Kind::Integer, "how many").in_range(1.0, 1000.0)],
    "modes of each tether or dynamic line",
)
.owner(Owner::Ours)
.default("6");
/// `-SHAPE`.
pub(crate) const SHAPE: OptionSpec =
    OptionSpec::new("-SHAPE", &[], "a table of the shape of each mode of ROD_MODES after that of their periods")
        .owner(Owner::Ours);
/// `-AQWA`.
pub(crate) const AQWA: OptionSpec =
    OptionSpec::new("-AQWA", &[], "modes of tethers with the peculiarities of AQWA, as TDOM -TETHERS AQWA")
        .owner(Owner::Ours);
const BRIEF: OptionSpec = OptionSpec::new("-BRIEF", &[], "leaves out the notes below the tables (our reading)");
/// `-FORCE`.
pub(crate) const FORCE: OptionSpec = OptionSpec::new(
    "-FORCE",
    &[ValueSpec::choice::<ForceName>("NAME", "name of a force")],
    "only these categories of FORCE and SYSTEM",
)
.repeating(1)
.default("all");
static SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new("WHAT", Kind::Text, "what to report, as listed below").or("a summary"),
        ValueSpec::new(
            "NAME",
            Kind::Name(Noun::Selector),
            "only what fits this name or pattern; of LINE_TYPES also a diameter",
        )
        .or("all"),
    ],
    repeat: 1,
    opens: Opens::WithEither(&menu::DISPOSITION, [&DISPOSE, &PLOT]),
    options: &[PLOT, BRIEF, FORCE, body_status::ABOUT, NUMBER, SHAPE, AQWA, DISPOSE, HARD, BOTH, WIDE],
    detail: "Alone it counts what the model holds. ENVIRONMENT alone is the one in force, with a NAME the one kept \
             under it. LINE_TYPES lists the chains and ropes that -TYPE of a line \
             class knows; LINE_TYPES 3 gives their values at a nominal diameter, LINE_TYPES CHAIN_R4 the formulas of one. \
             F_CONNECTOR solves every line between its ends as they are: the \
             force it exerts on its first end in the global system, its tension and the largest share of a segment's break, \
             what its anchor bears (V. Pull upward, H. Pull toward the first end), and the unstretched length on the bottom. \
             A line without a solution has a row without numbers and a warning that says why. FORCE sums what acts on each body \
             where it stands, about its origin. STIFFNESS is the change of these forces with the motion of one body, other bodies held: \
             -d(force)/d(translation of the point, rotation in radians) in global axes, about the body's origin or the point of -ABOUT, \
             taken to move with the body; junctions follow to their own equilibrium; with names of connectors that of each of them. Connectors of classes with -IG_STIFF between two bodies are left out of it. \
             B_W lists weights and buoyancy of bodies; DRAFT the drafts at the marks of &DESCRIBE DMARK. ROD_MODES reports the slowest modes of a line about its rest, its ends held where they stand. -DISPOSE takes a table to the disposition menu: \
             REPORT, VIEW, STORE, PLOT.",
    example: "MEDIT\n*P 0 0 10\n~W B_CAT 4 EXACT -LEN 4000 -DEP 500\nCONNECTOR A -ANC 0 3900 ~W *P\nEND\n&STATUS F_CONNECTOR A\n\
              &STATUS\n&STATUS DEFAULTS\n&STATUS DIMENSIONS\n&STATUS LINE_TYPES 3\n&STATUS F_CONNECTOR -DISPOSE\nVIEW Name FX FZ\nEND\n\
              MEDIT\n&CONNECTOR A -DYNAMICS 40\nEND\n&STATUS ROD_MODES A -NUMBER 2",
    ..CommandSpec::new("&STATUS", "reports what the model holds")
};

/// The kind of table.
pub(super) const WHAT: DatumKey<str> = SPEC.word("WHAT");

/// The kind that a record asks for.
fn asked_kind(args: &Args) -> Outcome<&'static StatusKind> {
    Ok(match args.word(WHAT) {
        Some(word) => {
            match absent::find_report(word).filter(|_| kinds().all(|(name, ..)| !name.eq_ignore_ascii_case(word))) {
                Some((name, instead)) => {
                    return Err(Diagnostic::error(
                        format!("&STATUS {name} of MOSES is not in windlass"),
                        args.position(WHAT),
                    )
                    .help(*instead));
                }
                None => {
                    let listed = |mut error: Box<Diagnostic>| {
                        if error.help.is_empty() && error.label.is_empty() {
                            error.help.extend(list_known(&kinds().map(|(name, ..)| name).collect::<Vec<_>>()));
                        }
                        error
                    };
                    find_kind(choose(word, args.position(WHAT), "kind of &STATUS", kinds()).map_err(listed)?)
                }
            }
        }
        None => &model_tables::SUMMARY,
    })
}

/// Sees that a record asks for a kind that is there, without making its tables.
///
/// # Errors
/// No such kind.
pub(crate) fn check_kind(call: &Call) -> Outcome<()> {
    asked_kind(&call.args).map(|_| ())
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let kind = asked_kind(args)?;
    if let Some(given) =
        args.option(&FORCE).filter(|_| *kind.name != *body_status::FORCE.name && *kind.name != *system::SYSTEM.name)
    {
        return Err(Diagnostic::error(format!("{} has no forces to choose among", kind.name), given.span)
            .help("-FORCE goes with FORCE and SYSTEM"));
    }
    let names = NameFilter::new(args.data_after(WHAT), &job.model);
    let query = Query { job, call, names: &names };
    let mut verdict = Verdict::default();
    let mut tables = (kind.tables)(&query, &mut verdict)?;
    names.check(kind.name, &tables, kind.names)?;
    if kind.caveats {
        note_caveats(&job.model, &mut tables);
    }
    if args.has(&BRIEF) {
        // what is dangerous stays
        tables.iter_mut().for_each(|table| table.notes.retain(|note| note.severity == Severity::Warning));
    }
    let charts = match (args.option(&PLOT), kind.charts) {
        (None, _) => Vec::new(),
        (Some(given), Some(charts)) => {
            let charts = charts(&query, &tables)?;
            if charts.is_empty() {
                return Err(Diagnostic::error(format!("{} has nothing to plot here", kind.name), given.span));
            }
            charts
        }
        (Some(given), None) => {
            return Err(Diagnostic::error(format!("{} has nothing to plot", kind.name), given.span)
                .help(format!("-PLOT goes with {}", plotted_kinds())));
        }
    };
    job.verdict.over_break.append(&mut verdict.over_break);
    let position = args.position(const { SPEC.word("NAME") });
    if open_chosen_table(job, args, &tables, (None, position))? {
        return Ok(Effect::Done);
    }
    let head = job.page_head();
    let mut drawings = String::new();
    let (columns, lines) = job.plot_size();
    for table in &charts {
        let drawn = Chart::from_table(table, job.units).and_then(|chart| chart.terminal(columns, lines));
        drawings.push('\n');
        drawings.push_str(&drawn.map_err(|e| Diagnostic::error(e.to_string(), args.span))?);
    }
    let units = job.units;
    send(job, args, |width| format!("{}{drawings}", page::render_all(&tables, units, &head, width)))?;
    tables.iter().for_each(|t| raise(job, t, position));
    if let Some(plotted) = charts.into_iter().next() {
        job.menus.push(Menu::Disposition(Box::new(Disposition::new(plotted))));
    }
    Ok(Effect::Done)
}

/// The kinds that `-PLOT` draws, for a message.
fn plotted_kinds() -> String {
    KINDS.iter().filter(|kind| kind.charts.is_some()).map(|kind| kind.name).collect::<Vec<_>>().join(" ")
}
