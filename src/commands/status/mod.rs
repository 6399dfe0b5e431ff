//! `&STATUS`: what the model and the program hold.

pub(crate) mod assembly_table;
pub(crate) mod body_status;
pub(crate) mod body_tables;
pub(crate) mod curve_table;
pub(crate) mod database_table;
pub(crate) mod environment_table;
pub(crate) mod fatigue_table;
pub(crate) mod forces;
pub(crate) mod line_types;
pub(crate) mod loads_table;
pub(crate) mod model_tables;
pub(crate) mod offsets;
pub(crate) mod rod_status;
pub(crate) mod sea_table;
pub(crate) mod settings_table;
pub(crate) mod tether_status;
pub(crate) mod wind_table;

use crate::commands::chosen::{NameFilter, note_caveats, raise};
use crate::commands::environment::bathymetry;
use crate::commands::menu;
use crate::commands::model::{member, t_pressure};
use crate::commands::output::disposition::{BOTH, HARD, send};
use crate::commands::post::prcpost::last_run;
use crate::commands::solve::prescribe;
use crate::commands::status::assembly_table::assemblies;
use crate::commands::status::curve_table::{chart, curves};
use crate::commands::status::environment_table::environments;
use crate::commands::status::forces::{forces, foundations};
use crate::commands::status::loads_table::loads;
use crate::commands::status::offsets::offsets;
use crate::commands::verdict::Verdict;
use crate::commands::written::{as_written, option_as_written};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use crate::report::page;
use crate::report::plot::Chart;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::Table;
use windlass_base::values::Noun;
use windlass_language::select::{Owner, choose};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Class, EntityKind};
use windlass_solve::run_tables;

/// &STATUS.
pub static STATUS: Command = Command { spec: &SPEC, edits: false, run };

const KINDS: &[(&str, Owner, &str)] = &[
    ("CONFIGURATION", Owner::Moses, "where the bodies stand"),
    ("CL_FLEX", Owner::Moses, "flexible connector classes with W/L, AE, break"),
    ("G_CONNECTOR", Owner::Moses, "connector geometry"),
    ("F_CONNECTOR", Owner::Moses, "forces of the connectors between their ends as they are"),
    ("FOUNDATION", Owner::Ours, "the FOUNDATION check: forces of foundations over their allowables"),
    ("FORCE", Owner::Moses, "what acts on the bodies where they stand, by category"),
    ("ASSEMBLIES", Owner::Ours, "tip-hook sets: where the hook is, what its lines bear"),
    ("STIFFNESS", Owner::Ours, "stiffness of bodies and connectors about a point"),
    ("MODES", Owner::Ours, "natural periods, damping and shapes of small motions about where the bodies stand"),
    ("CURVES", Owner::Moses, "curves"),
    ("BATHYMETRY", Owner::Ours, "bottoms over a grid: extent, least and greatest depth"),
    ("T_PRESSURE", Owner::Ours, "temperature, pressure and contents of pipes"),
    ("ENVIRONMENT", Owner::Moses, "the environment in force, or one kept under a name"),
    ("WIND_SPECTRUM", Owner::Ours, "the components of the gusts of an environment, and with -PLOT their spectrum"),
    (
        "SEA_SPECTRUM",
        Owner::Moses,
        "the wave components of the seas of the environment in force, or of one kept under a name",
    ),
    ("RUN", Owner::Ours, "how the last run went"),
    ("ROD", Owner::Ours, "dynamic lines, at rest between their ends as they stand"),
    ("ROD_MODES", Owner::Ours, "how dynamic lines swing about that, -NUMBER modes of each"),
    ("TETHERS", Owner::Ours, "what tethers are made of and hang on, as TDOM -TETHERS has them"),
    ("TETHER_MODES", Owner::Ours, "natural modes of tethers where they stand, -NUMBER of each"),
    ("CLASSES", Owner::Ours, "the same as CL_FLEX"),
    ("LOADS", Owner::Ours, "loads of wind, current and waves on parts, and the forces they come to"),
    ("WEIGHT", Owner::Ours, "weights, centers and radii of gyration of bodies and parts"),
    ("PIECES", Owner::Ours, "pieces of hulls"),
    ("HYDROSTATICS", Owner::Ours, "what bodies displace where they are, and their hydrostatic stiffness"),
    ("DATABASE", Owner::Ours, "hydrodynamic databases of bodies: radiation, excitation, drift, memory"),
    ("BODIES", Owner::Ours, "bodies and their parts"),
    ("POINTS", Owner::Ours, "points, in their parts and in the global system"),
    ("DIMENSIONS", Owner::Ours, "units"),
    ("DEFAULTS", Owner::Ours, "defaults"),
    ("SELECTORS", Owner::Ours, "selectors"),
    ("SN", Owner::Ours, "fatigue curves, and those the segments of line classes go by"),
    ("LINE_TYPES", Owner::Ours, "chains and ropes of the library, for -TYPE"),
];

/// What &STATUS can tell of, with one line each, for its help.
pub fn kinds_told() -> impl Iterator<Item = (&'static str, &'static str)> {
    KINDS.iter().map(|(name, _, help)| (*name, *help))
}

/// What &STATUS can tell of, for completion.
pub fn kinds() -> impl Iterator<Item = (&'static str, Owner, &'static str)> + Clone {
    KINDS.iter().map(|(name, owner, _)| (*name, *owner, *name))
}

const PLOT: OptionSpec =
    OptionSpec::new("-PLOT", &[], "plots curves, or the spectra of SEA_SPECTRUM and WIND_SPECTRUM");
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
    OptionSpec::new("-SHAPE", &[], "a table of the shape of each mode of ROD_MODES behind that of their periods")
        .owner(Owner::Ours);
/// `-AQWA`.
pub(crate) const AQWA: OptionSpec =
    OptionSpec::new("-AQWA", &[], "modes of tethers with the peculiarities of AQWA, as TDOM -TETHERS AQWA")
        .owner(Owner::Ours);
const DISPOSE: OptionSpec = OptionSpec::new(
    "-DISPOSE",
    &[ValueSpec::new("N", Kind::Integer, "which of its tables").or("1").in_range(1.0, 1e6)],
    "opens the disposition menu over a table instead of printing",
)
.owner(Owner::Ours);

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
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    options: &[PLOT, body_status::ABOUT, NUMBER, SHAPE, AQWA, DISPOSE, HARD, BOTH],
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
             ROD_MODES holds the ends of a line where they stand, and tells of its slowest modes about its rest there. -DISPOSE takes a table to the disposition menu: \
             REPORT, VIEW, STORE, PLOT.",
    example: "MEDIT\n*P 0 0 10\n~W B_CAT 4 EXACT -LEN 4000 -DEP 500\nCONNECTOR A -ANC 0 3900 ~W *P\nEND\n&STATUS F_CONNECTOR A\n\
              &STATUS\n&STATUS DEFAULTS\n&STATUS DIMENSIONS\n&STATUS LINE_TYPES 3\n&STATUS F_CONNECTOR -DISPOSE\nVIEW Name FX FZ\nEND\n\
              MEDIT\n&CONNECTOR A -DYNAMICS 40\nEND\n&STATUS ROD_MODES A -NUMBER 2",
    ..CommandSpec::new("&STATUS", "reports what the model holds")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let kind = match args.word(0) {
        Some(word) => choose(word, args.place(0), "kind of &STATUS", kinds())?,
        None => "SUMMARY",
    };
    let model = &job.model;
    let chosen = NameFilter::new(call, 1, model);
    let fits = |name: &str| chosen.takes(name);
    let mut verdict = Verdict::default();
    let mut tables = match kind {
        "CONFIGURATION" => vec![model_tables::configuration(model, &fits)],
        "CL_FLEX" | "CLASSES" => classes(job, &|class| fits(&class.name)),
        "G_CONNECTOR" => std::iter::once(model_tables::connectors(model, &fits)).chain(offsets(model, &fits)).collect(),
        "F_CONNECTOR" => forces(model, &fits, job.units, &mut verdict),
        "FOUNDATION" => vec![foundations(model, &fits, job.units)],
        "ASSEMBLIES" => assemblies(model, &fits, job.units),
        "FORCE" => body_status::forces(job, call, &fits)?,
        "STIFFNESS" => body_status::stiffness(job, call, &chosen)?,
        "MODES" => body_status::modes(job, call)?,
        "CURVES" => curves(model, &fits),
        "BATHYMETRY" => vec![bathymetry::table(model, &fits)],
        "T_PRESSURE" => vec![t_pressure::table(model, &fits)],
        "ENVIRONMENT" => environments(job, (!chosen.chooses_all()).then_some(&fits)),
        "SEA_SPECTRUM" => sea_table::spectra(job, (!chosen.chooses_all()).then_some(&fits), args.place(0))?,
        "WIND_SPECTRUM" => wind_table::spectra(job, (!chosen.chooses_all()).then_some(&fits), args.place(0))?,
        "LOADS" => loads(job, &fits),
        "WEIGHT" => vec![body_tables::weights(model, &fits)],
        "PIECES" => {
            let added = member::added_mass(model, &fits).map_err(|e| e.diagnostic(args.place(0), job.units))?;
            std::iter::once(body_tables::pieces(model, &fits))
                .chain(member::members(model, &fits))
                .chain(added)
                .collect()
        }
        "HYDROSTATICS" => body_tables::hydrostatics(model, &fits, job.units),
        "DATABASE" => database_table::tables(model, &fits),
        "BODIES" => {
            std::iter::once(model_tables::bodies(model, &fits)).chain(prescribe::motions(model, &fits)).collect()
        }
        "POINTS" => vec![model_tables::points(model, &fits)],
        "DIMENSIONS" => vec![settings_table::dimensions(job)],
        "DEFAULTS" => vec![settings_table::defaults(model)],
        "RUN" => vec![run_tables::run_table(last_run(job, args.span)?)],
        "ROD" | "ROD_MODES" => rod_status::tables(job, args, kind, &fits)?,
        "TETHERS" | "TETHER_MODES" => tether_status::tables(job, args, kind, &fits)?,
        "SELECTORS" => vec![model_tables::selectors(model, &fits)],
        "SN" => fatigue_table::tables(job, &fits, chosen.chooses_all()),
        "LINE_TYPES" => line_types::tables(job, &args.data)?,
        _ => vec![model_tables::summary(model)],
    };
    chosen.check(kind, &tables, things(kind))?;
    if ["F_CONNECTOR", "FORCE", "STIFFNESS"].contains(&kind) {
        note_caveats(model, &mut tables);
    }
    job.verdict.over_break.append(&mut verdict.over_break);
    if let Some(given) = args.option(&DISPOSE) {
        let wanted = given.first_integer().unwrap_or(1);
        let index = usize::try_from(wanted - 1).unwrap_or(0);
        let Some(table) = tables.get(index).cloned() else {
            let text = format!("{kind} makes no table {wanted} here: there are {}", tables.len());
            return Err(Diagnostic::error(text, given.span));
        };
        raise(job, &table, args.place(1));
        job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
        return Ok(Effect::Done);
    }
    let head = job.page_head();
    let mut text = tables.iter().map(|t| page::render(t, job.units, &head)).collect::<Vec<_>>().join("\n");
    let charts: Vec<Table> = match kind {
        _ if !args.has(&PLOT) => Vec::new(),
        "CURVES" => tables.iter().filter(|t| chart(t)).cloned().collect(),
        "SEA_SPECTRUM" => sea_table::densities(job, (!chosen.chooses_all()).then_some(&fits), args.place(0))?,
        "WIND_SPECTRUM" => wind_table::densities(job, (!chosen.chooses_all()).then_some(&fits), args.place(0))?,
        _ => Vec::new(),
    };
    let (columns, lines) = job.plot_size();
    for table in &charts {
        let drawn = Chart::from_table(table, job.units).and_then(|chart| chart.terminal(columns, lines));
        text.push('\n');
        text.push_str(&drawn.map_err(|e| Diagnostic::error(e.to_string(), args.span))?);
    }
    send(job, args, &text)?;
    tables.iter().for_each(|t| raise(job, t, args.place(1)));
    Ok(Effect::Done)
}

/// The things whose names a kind of &STATUS takes.
fn things(kind: &str) -> &'static [EntityKind] {
    match kind {
        "CONFIGURATION" | "FORCE" | "DATABASE" => &[EntityKind::Body],
        "STIFFNESS" => &[EntityKind::Body, EntityKind::Connector],
        "BODIES" | "LOADS" | "WEIGHT" => &[EntityKind::Body, EntityKind::Part],
        "HYDROSTATICS" => &[EntityKind::Body],
        "PIECES" => &[EntityKind::Piece, EntityKind::Body, EntityKind::Part],
        "ASSEMBLIES" => &[EntityKind::Assembly],
        "CL_FLEX" | "CLASSES" | "SN" => &[EntityKind::Class],
        "G_CONNECTOR" | "F_CONNECTOR" | "FOUNDATION" | "TETHERS" | "TETHER_MODES" => &[EntityKind::Connector],
        "ROD" | "ROD_MODES" => &[EntityKind::Connector, EntityKind::Assembly],
        "CURVES" => &[EntityKind::Curve],
        "BATHYMETRY" => &[EntityKind::Bathymetry],
        "T_PRESSURE" => &[EntityKind::Filling],
        "ENVIRONMENT" | "SEA_SPECTRUM" | "WIND_SPECTRUM" => &[EntityKind::Environment],
        "POINTS" => &[EntityKind::Point],
        "SELECTORS" => &[EntityKind::Selector],
        _ => &[],
    }
}

/// The property tables of the classes that fit, with their records as they were given.
pub(crate) fn classes(job: &Job, fits: &dyn Fn(&Class) -> bool) -> Vec<Table> {
    let model = &job.model;
    let surroundings = model.surroundings();
    model
        .classes
        .values()
        .filter(|c| fits(c))
        .map(|class| {
            let mut table = class.object.properties(&class.name, &surroundings);
            for (index, record) in class.records.iter().enumerate() {
                let data = as_written(&record.args.data, job.units);
                let options = record.args.options.iter().map(|g| option_as_written(g, job.units));
                let words: Vec<String> = data.into_iter().chain(options).collect();
                table.note(format!("record {}: {} {}", index + 1, class.object.kind(), words.join(" ")));
            }
            table
        })
        .collect()
}
