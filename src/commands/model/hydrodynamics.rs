//! `HYDRODYNAMICS`: the hydrodynamic data of bodies in the forms of MOSES. `G_PRESSURE` makes a database by panels, `G_MDRIFT` its mean drift
//! anew; `I_TOTAL` reads the values of a database and `E_TOTAL` writes them; `V_MATRICES`, `V_EXFORCES` and `V_MDRIFT` show them.
//!
//! Source: [MOSES-REF hydr_men, pressure] for the menu and G_PRESSURE. The records of I_TOTAL are from memory of MOSES; their units, and
//! the file of E_TOTAL, are our reading.

use crate::commands::menu;
use crate::commands::model::database;
use crate::commands::model::panel_drift;
use crate::commands::model::panel_forces::{self, PanelRequest};
use crate::commands::output::disposition::write_file;
use crate::commands::settings::device::existing;
use crate::commands::status::database_table;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use nalgebra::{Complex, Matrix6, Vector3};
use std::f64::consts::{PI, TAU};
use std::fmt::Write as _;
use std::path::PathBuf;
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Place;
use windlass_base::span::Span;
use windlass_base::table::{Column, Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given, Noun, Value};
use windlass_hydro::database::Amplitudes;
use windlass_hydro::database::typed::{self, TypedAxes, TypedPeriod};
use windlass_hydro::wetted_hull::has_hull;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{AttachedDatabase, Body, DriftMethod, Model, SolveKind, UnmodelledEffect, find};

/// HYDRODYNAMICS.
pub static HYDRODYNAMICS: Command = Command { spec: &MENU_SPEC, edits: false, run: open };
/// G_PRESSURE.
pub static G_PRESSURE: Command = Command { spec: &PRESSURE_SPEC, edits: false, run: pressure };
/// G_MDRIFT.
pub static G_MDRIFT: Command = Command { spec: &MEAN_SPEC, edits: false, run: mean_drift };
/// I_TOTAL.
pub static I_TOTAL: Command = Command { spec: &TOTAL_SPEC, edits: false, run: total };
/// E_TOTAL.
pub static E_TOTAL: Command = Command { spec: &EXPORT_SPEC, edits: false, run: export };
/// H_ORIGIN.
pub static H_ORIGIN: Command = Command { spec: &ORIGIN_SPEC, edits: false, run: origin };
/// H_EULERA.
pub static H_EULERA: Command = Command { spec: &EULER_SPEC, edits: false, run: euler };
/// H_PERIOD.
pub static H_PERIOD: Command = Command { spec: &PERIOD_SPEC, edits: false, run: period };
/// H_AMASS.
pub static H_AMASS: Command = Command { spec: &MASS_SPEC, edits: false, run: |job, call| matrix(job, call, true) };
/// H_DAMP.
pub static H_DAMP: Command = Command { spec: &DAMPING_SPEC, edits: false, run: |job, call| matrix(job, call, false) };
/// H_FORCE.
pub static H_FORCE: Command = Command { spec: &FORCE_SPEC, edits: false, run: force };
/// V_MATRICES.
pub static V_MATRICES: Command = Command { spec: &MATRICES_SPEC, edits: false, run: show_matrices };
/// V_EXFORCES.
pub static V_EXFORCES: Command = Command { spec: &FORCES_SPEC, edits: false, run: show_forces };
/// V_MDRIFT.
pub static V_MDRIFT: Command = Command { spec: &DRIFT_SPEC, edits: false, run: show_drift };

/// Most periods of a database [MOSES-REF pressure].
const MAX_PERIODS: usize = 200;
/// Panels at sharp edges over the others where nothing else is asked for: with it the damping of the roll of a barge is as near as with half the size everywhere.
pub const USUAL_EDGE_SHARE: f64 = 0.1;
const LEAST_EDGE_SHARE: f64 = 0.02;

/// Largest damping of a lid: the surface as good as closed.
const MAX_LID_DAMPING: f64 = 100.0;

const BODY: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Body), "the body");
const PACKET: ValueSpec = ValueSpec::new("PKT_NAME", Kind::Text, "name of the data, kept in reports alone").or("none");

macro_rules! typed {
    () => {
        "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY BALL -IGNORE X Y RX RY RZ\n*CG 0 0 0\n#WEIGHT *CG 20000 4 4 4\n\
         #HYDROSTATIC *CG 3000 0 0 -BUOYANCY 20000 -ZCGE 0\nEND\nHYDRODYNAMICS\nI_TOTAL BALL\nH_ORIGIN 0 0 0\nH_PERIOD 6\n\
         H_AMASS 0 0 0 0 0 0  0 0 0 0 0 0  0 0 9000 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0\n\
         H_DAMP 0 0 0 0 0 0  0 0 0 0 0 0  0 0 300 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0\n\
         H_FORCE 180 0 0 0 0 1500 20 0 0 0 0 0 0\nH_PERIOD 9\n\
         H_AMASS 0 0 0 0 0 0  0 0 0 0 0 0  0 0 11000 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0\n\
         H_DAMP 0 0 0 0 0 0  0 0 0 0 0 0  0 0 400 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0  0 0 0 0 0 0\n\
         H_FORCE 180 0 0 0 0 2200 -10 0 0 0 0 0 0\nEND_I_TOTAL\n"
    };
}

static MENU_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MAIN],
    opens: Opens::Menu(&menu::HYDRODYNAMICS),
    detail: "G_PRESSURE makes the database of a body by panels; DATABASE reads those of WAMIT, NEMOH, Capytaine and AQWA, I_TOTAL those given by records.",
    example: concat!(typed!(), "V_MATRICES BALL\nREPORT\nEND\nEND"),
    ..CommandSpec::new("HYDRODYNAMICS", "hydrodynamic data of bodies, up to END")
};

const HEADING: OptionSpec = OptionSpec::new(
    "-HEADING",
    &[ValueSpec::new(
        "H",
        Kind::Number(Dim::Angle),
        "where the waves come from, from the X axis of the first body toward its Y axis",
    )],
    "headings",
)
.repeating(1)
.default("0 to 345 by 15");
const PERIOD: OptionSpec = OptionSpec::new(
    "-PERIOD",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "period").positive()],
    "periods, at most 200",
)
.repeating(1)
.default("those of &DEFAULT; else frequencies of 0.1 to 2 rad/s by 0.05, as far as a wave has sixteen panels");
const PANEL: OptionSpec = OptionSpec::ours(
    "-PANEL",
    &[ValueSpec::new("SIZE", Kind::Number(Dim::Length), "length of their sides, at most").positive()],
    "size of the panels",
)
.default("that of 1000 panels on the whole hull, before they are refined");
/// Size of panels at edges.
pub const EDGE_SHARE: OptionSpec = OptionSpec::ours(
    "-EDGE_SHARE",
    &[ValueSpec::new("SHARE", Kind::Number(Dim::None), "over the size of -PANEL: 1 leaves all panels of one size")
        .in_range(LEAST_EDGE_SHARE, 1.0)],
    "size of the panels at sharp edges and at the waterline, from where they grow by their distance",
)
.default("0.1; of own panels and of faces smaller than a panel 1");
const WATER_DEPTH: OptionSpec = OptionSpec::ours(
    "-DEPTH",
    &[ValueSpec::new("D", Kind::Number(Dim::Length), "depth").positive()],
    "the depth of the water",
)
.default("that of the environment; deep water where it has none");
const WITH: OptionSpec = OptionSpec::ours(
    "-WITH",
    &[ValueSpec::new("BODY", Kind::Name(Noun::Body), "another body")],
    "other bodies that are solved together with it",
)
.repeating(1);
const MEAN_DRIFT: OptionSpec = OptionSpec::ours(
    "-MEAN_DRIFT",
    &[ValueSpec::choice::<YesNo>("YES/NO", "NO leaves it out").or("YES")],
    "finds the mean drift of each body: of several by a control surface around each",
)
.default("YES");
/// A rectangle of damped surface.
pub const LID: OptionSpec = OptionSpec::ours(
    "-LID",
    &[
        ValueSpec::new("X1", Kind::Number(Dim::Length), "a corner, from the origin of the first body along its heading"),
        ValueSpec::new("Y1", Kind::Number(Dim::Length), "the same to the left"),
        ValueSpec::new("X2", Kind::Number(Dim::Length), "the opposite corner"),
        ValueSpec::new("Y2", Kind::Number(Dim::Length), "the same to the left"),
        ValueSpec::new("EPSILON", Kind::Number(Dim::None), "damping: 0 none, some 0.01 to 0.2 in gaps").in_range(0.0, MAX_LID_DAMPING),
    ],
    "the water surface of a rectangle takes energy from the waves, as a gap between hulls or a moonpool does by eddies; given again for each of them",
)
.many()
.default("none");
const CHECK: OptionSpec = OptionSpec::ours(
    "-CHECK",
    &[],
    "shows what the panels and the results are worth, and the change of every result with twice as many panels",
);
const KEPT: OptionSpec = OptionSpec::ours(
    "-KEPT",
    &[ValueSpec::new("FILE", Kind::File, "NetCDF file; looked for where it says, then beside the script")],
    "results of another job, taken where they are of the same mesh, water, headings, periods and motions",
);
const MD_TYPE: OptionSpec = OptionSpec::new(
    "-MD_TYPE",
    &[ValueSpec::new("TYPE", Kind::Text, "FORMULAE or SEMI")],
    "accepted, without effect: drift is that of the panels, not that of formulas",
);
const DIMENSIONS: OptionSpec = OptionSpec::new(
    "-DIMENSIONS",
    &[
        ValueSpec::new("L", Kind::Number(Dim::Length), "length"),
        ValueSpec::new("B", Kind::Number(Dim::Length), "beam"),
        ValueSpec::new("T", Kind::Number(Dim::Length), "draft"),
    ],
    "accepted, without effect: the hull has them",
);
const MAX_DIST: OptionSpec = OptionSpec::new(
    "-MAX_DIST",
    &[ValueSpec::new("D", Kind::Number(Dim::Length), "length").positive()],
    "accepted, without effect: -PANEL has the size of the panels",
);

static PRESSURE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    data: &[BODY, PACKET],
    options: &[HEADING, PERIOD, PANEL, EDGE_SHARE, WATER_DEPTH, WITH, LID, MEAN_DRIFT, CHECK, KEPT, MAX_DIST],
    detail: "Added mass, radiation damping and wave forces of first order of a body where it stands, by panels on its pieces below the water, which \
             are made one hull (tubes and members by Morison's formula, and pieces of -DIFTYPE FK or NONE, are left out; -DIFTYPE 3DDIF takes a tube). \
             Mirror planes of a single hull are found and used. Panels are of the size of -PANEL at most; toward sharp edges that stick out and toward the waterline they shrink to -EDGE_SHARE \
             of it: a barge in panels of one size is twice as far off. The waterplane inside of each ring of the waterline is closed by a lid, which takes \
             irregular frequencies away; a moonpool stays open. -LID damps the surface of a rectangle of it, or of a gap between bodies, by dphi/dz = w2/g (1 + i EPSILON) phi: \
             motions of the water that potential flow overrates fall, and the report has the value. -WITH solves several bodies together: each gets a database with the \
             radiation of the others, which acts in FREQ_RESPONSE, &EQUI and TDOM while they stand near where they stood; headings are those of the first. The result is the database of the body, as DATABASE reads one: its pieces are taken as -DIFTYPE 3DDIF, and it acts in \
             FREQ_RESPONSE, &EQUI and TDOM, with the added mass at infinite frequency. A hull with a flat face on the bottom stands there: it has no panels below. Matrices and forces are along upright axes of the heading, also of a body that is trimmed or heeled. \
             Mean drift is found with the motions that mass, stiffness, moorings and damping give the bodies now: of a body alone by the waves far away (G_MDRIFT finds it anew \
             after these have changed), of several by a control surface around each; where none fits around one of them it has what the drifts of the others leave of that of the waves far \
             away, which is said. The report has how far the drift by the pressure on the hull is from it. -MEAN_DRIFT NO leaves it out. Roll has the damping of radiated waves \
             alone: #DAMP adds what eddies take. Exciting forces are those of Haskind's relation; the report has the panels of a wave length and the largest difference of the forces by pressure from \
             them, which measures the mesh. The drift of a body alone is checked by a control surface where it is largest; a difference above 5 % of the largest, of several bodies of \
             their sum from the waves far away, is warned of with the size of panels that would agree. What was computed is written beside the answers, BODY.nc in the layout of Capytaine, and is taken from there by a run with the same mesh, \
             water, headings, periods and motions; DATABASE -CAPYTAINE reads it. Headings and periods are kept as those of RAO. A body with a database of DATABASE or I_TOTAL keeps it: \
             that is said. For a body without a hull motions stop with one error until it is given a database.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n#WEIGHT *CG 100552 12 26 26\n&SURFACE\n\
              BLOCK HULL -45 -15 -3.7 45 15 4\nEND_&SURFACE\nEND\nHYDRODYNAMICS\nG_PRESSURE BARGE -HEADING 180 90 -PERIOD 7 9 12 -PANEL 6\nEND\n\
              FREQ_RESPONSE\nRAO\nEND",
    ..CommandSpec::new("G_PRESSURE", "hydrodynamic pressures of a body")
};

static MEAN_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    data: &[BODY, PACKET],
    options: &[HEADING, PERIOD, PANEL, EDGE_SHARE, WATER_DEPTH, LID, MD_TYPE, DIMENSIONS],
    detail: "Mean drift in surge, sway and yaw of a body that has a database of G_PRESSURE, by its panels where it stands and with the motions that its mass, \
             stiffness, moorings and damping give it now, drag at rest; it replaces the drift of the database. It is found by the waves far away, which \
             solves use, by a control surface around the body and by the pressure on its hull: the report has all three and their differences, which measure the mesh; the pressure needs far smaller panels at sharp edges. A body that is held \
             (&DESCRIBE BODY -IGNORE of all its motions) has the drift of one that does not move. Panels, depth, headings and periods are those of \
             G_PRESSURE where none are given. -MD_TYPE and -DIMENSIONS of MOSES are read and have no effect.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 100\nMEDIT\n&DESCRIBE BODY BARGE\n*CG 0 0 0\n#WEIGHT *CG 100552 12 26 26\n#DAMP *CG 0 0 0 2E5\n&SURFACE\n\
              BLOCK HULL -45 -15 -3.7 45 15 4\nEND_&SURFACE\nEND\nHYDRODYNAMICS\nG_PRESSURE BARGE -HEADING 180 -PERIOD 9 12 -PANEL 7\nG_MDRIFT BARGE\nV_MDRIFT BARGE\nREPORT\nEND\nEND",
    ..CommandSpec::new("G_MDRIFT", "mean wave drift of a body by its panels")
};

static TOTAL_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    opens: Opens::Menu(&menu::I_TOTAL),
    data: &[BODY, PACKET],
    detail: "The database of a body by records, up to END_I_TOTAL, where it replaces the one it has: H_ORIGIN and H_EULERA, then for each period H_PERIOD, H_AMASS, \
             H_DAMP and one H_FORCE a heading. All periods have the same headings, and all or none have matrices. They are checked as those of DATABASE: asymmetry and negative damping are warned of; \
             &STATUS DATABASE reports them.",
    example: concat!(typed!(), "E_TOTAL BALL ball.tot\nEND\n&INSERT job.ans/ball.tot"),
    ..CommandSpec::new("I_TOTAL", "reads the database of a body, up to END_I_TOTAL")
};

const fn coordinate(name: &'static str, dim: Dim) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), "in the body")
}
static ORIGIN_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::I_TOTAL],
    data: &[coordinate("X", Dim::Length), coordinate("Y", Dim::Length), coordinate("Z", Dim::Length)],
    detail: "Moments and phases of the values are about this point of the body; without it they are about its origin.",
    example: concat!(typed!(), "END"),
    ..CommandSpec::new("H_ORIGIN", "the point that the values of I_TOTAL are about")
};
static EULER_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::I_TOTAL],
    data: &[coordinate("RX", Dim::Angle), coordinate("RY", Dim::Angle), coordinate("RZ", Dim::Angle)],
    detail: "Roll, pitch and yaw of the axes of the values in the body, in the order of &DESCRIBE PART -MOVE; headings turn with the yaw (our reading). Without it they are those of the body.",
    example: concat!(typed!(), "END"),
    ..CommandSpec::new("H_EULERA", "the axes of the values of I_TOTAL")
};
static PERIOD_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::I_TOTAL],
    data: &[ValueSpec::new("T", Kind::Number(Dim::Time), "period").positive()],
    detail: "H_AMASS, H_DAMP and H_FORCE that follow are of this period.",
    example: concat!(typed!(), "END"),
    ..CommandSpec::new("H_PERIOD", "begins a period of I_TOTAL")
};
const ENTRIES: &[ValueSpec] = &[ValueSpec::new("A", Kind::Number(Dim::None), "36 values, row by row")];
static MASS_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::I_TOTAL],
    data: ENTRIES,
    repeat: 1,
    detail: "X Y Z RX RY RZ by rows, as a weight like #AMASS (our reading): force; force times length between translation and rotation; force times length squared of rotations. Divided by gravity when computed. \
             MOSES prints added mass divided by the mass of the body: such values times its weight are these.",
    example: concat!(typed!(), "END"),
    ..CommandSpec::new("H_AMASS", "added mass of a period of I_TOTAL")
};
static DAMPING_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::I_TOTAL],
    data: ENTRIES,
    repeat: 1,
    detail: "X Y Z RX RY RZ by rows: force over velocity, with a power of length more for each rotation (our reading).",
    example: concat!(typed!(), "END"),
    ..CommandSpec::new("H_DAMP", "radiation damping of a period of I_TOTAL")
};
static FORCE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::I_TOTAL],
    data: &[
        ValueSpec::new(
            "HEADING",
            Kind::Number(Dim::Angle),
            "where the waves come from, from +X toward +Y of the values",
        ),
        ValueSpec::new("F", Kind::Number(Dim::None), "amplitude and phase of X, Y, Z, RX, RY, RZ: 12 values"),
    ],
    repeat: 1,
    detail: "Force and moment over wave amplitude, each with its lag behind the crest at H_ORIGIN in degrees (our reading).",
    example: concat!(typed!(), "END"),
    ..CommandSpec::new("H_FORCE", "exciting forces of a heading of I_TOTAL")
};
static EXPORT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    data: &[BODY, ValueSpec::new("FILE", Kind::File, "file in the folder of answers").or("BODY.tot")],
    detail: "Writes the database of a body as the records of HYDRODYNAMICS and I_TOTAL that read it back by &INSERT, in the units in force. Added mass at infinite frequency, drift, hydrostatics and motions have no records in it.",
    example: concat!(typed!(), "E_TOTAL BALL ball.tot\nEND"),
    ..CommandSpec::new("E_TOTAL", "writes the database of a body")
};
static MATRICES_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[BODY],
    detail: "Added mass as a weight, and damping, by period, about the point of the database, in the units in force: actual values. MOSES prints them divided by the mass of the body: added mass over \
             its weight, damping over its mass.",
    example: concat!(typed!(), "V_MATRICES BALL\nVLIST\nEND\nEND"),
    ..CommandSpec::new("V_MATRICES", "added mass and damping of a body")
};
static FORCES_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[BODY],
    detail: "Exciting forces over wave amplitude by heading and period, about the point of the database, with their lag behind the crest there; headings are where the waves travel toward in the body, as in &STATUS DATABASE.",
    example: concat!(typed!(), "V_EXFORCES BALL\nREPORT\nEND\nEND"),
    ..CommandSpec::new("V_EXFORCES", "exciting forces of a body")
};
static DRIFT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::HYDRODYNAMICS],
    opens: Opens::Menu(&menu::DISPOSITION),
    data: &[BODY],
    detail: "Mean drift over the square of the wave amplitude by heading and period, as in &STATUS DATABASE. G_PRESSURE and G_MDRIFT make it; I_TOTAL gives none.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&FILE OPEN A ball.1\n&FILE WRITE A 6 3 3 900 300\n&FILE WRITE A 9 3 3 1100 400\n&FILE CLOSE A\n\
              &FILE OPEN D ball.8\n&FILE WRITE D 6 180 180 1 5 180 -5 0\n&FILE WRITE D 9 180 180 1 3 180 -3 0\n&FILE CLOSE D\n\
              MEDIT\n&DESCRIBE BODY BALL\n*CG 0 0 0\n#WEIGHT *CG 20000 4 4 4\nDATABASE BALL -WAMIT job.ans/ball\nEND\n\
              HYDRODYNAMICS\nV_MDRIFT BALL\nREPORT\nEND\nEND",
    ..CommandSpec::new("V_MDRIFT", "mean drift of a body")
};

fn open(job: &mut Job, _: &Call) -> Outcome<Effect> {
    job.menus.push(Menu::Hydrodynamics);
    Ok(Effect::Done)
}

const HULL_HELP: &str = "BLOCK, PGEN or PANEL describes a hull (not with -DIFTYPE NONE or FK, nor a TUBE without -DIFTYPE 3DDIF); DATABASE reads those of WAMIT, NEMOH, \
                         Capytaine and AQWA; I_TOTAL .. END_I_TOTAL gives one by records";

/// The record that a body without a database lacks, as solves name it.
fn pressure_record(body: &str) -> String {
    format!("G_PRESSURE of {body}")
}

/// Takes back what G_PRESSURE said of a body that has a database now.
pub(super) fn settle_pressure(model: &mut Model, body: &str) {
    let record = pressure_record(body);
    model.unmodelled.retain(|effect| !effect.record.eq_ignore_ascii_case(&record));
}

fn pressure(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = PRESSURE_SPEC.word("BODY");
    let (args, span) = (&call.args, call.args.span);
    let body = find(&job.model.bodies, args.word(NAME).unwrap_or_default(), "body", args.position(NAME))?;
    let name = body.name.clone();
    // what it has made itself it makes again
    let has_database =
        body.database.as_ref().is_some_and(|attached| !attached.data.source.starts_with(panel_forces::SOURCE));
    let is_meshed = has_hull(&job.model, body);
    let mut names = vec![name.clone()];
    for value in args.option(&WITH).into_iter().flat_map(|given| &given.values) {
        let (word, place) = (value.word().unwrap_or_default(), args.option(&WITH).map_or(span, |given| given.span));
        let other = find(&job.model.bodies, word, "body", place)?;
        if names.iter().any(|own| own.eq_ignore_ascii_case(&other.name)) {
            return Err(Diagnostic::error(format!("{} is named twice", other.name), place));
        }
        let foreign = |attached: &AttachedDatabase| !attached.data.source.starts_with(panel_forces::SOURCE);
        if has_database || other.database.as_ref().is_some_and(foreign) {
            let text = "bodies that are solved together have no databases of DATABASE or I_TOTAL";
            return Err(Diagnostic::error(text, place));
        }
        names.push(other.name.clone());
    }
    let given = |option: &OptionSpec| args.option(option).map(Given::numbers).filter(|list| !list.is_empty());
    let (headings, periods) = (given(&HEADING), given(&PERIOD));
    if let Some(list) = periods.as_ref().filter(|list| list.len() > MAX_PERIODS) {
        let position = args.option(&PERIOD).map_or(span, |given| given.span);
        return Err(Diagnostic::error(format!("{} periods; at most {MAX_PERIODS} are taken", list.len()), position));
    }
    let defaults = &mut job.model.wave_defaults;
    defaults.headings = headings.unwrap_or_else(|| std::mem::take(&mut defaults.headings));
    defaults.periods = periods.unwrap_or_else(|| std::mem::take(&mut defaults.periods));
    if has_database {
        job.remark(
            format!("the hydrodynamic data of {name} are those of its database: G_PRESSURE computes none"),
            span,
        );
        return Ok(Effect::Done);
    }
    if is_meshed {
        if job.checking.is_some() {
            return Ok(Effect::Done);
        }
        let length = |option: &OptionSpec| given(option).and_then(|list| list.first().copied());
        let request = PanelRequest {
            headings: given(&HEADING).map_or_else(panel_forces::usual_headings, toward),
            periods: job.model.wave_defaults.periods.clone(),
            size: length(&PANEL),
            edge_share: args.option_number(&EDGE_SHARE).unwrap_or(USUAL_EDGE_SHARE),
            depth: length(&WATER_DEPTH),
            lids: lids_of(args),
            has_drift: args.option(&MEAN_DRIFT).is_none_or(Given::is_on),
            is_checked: args.has(&CHECK),
            kept: None,
            span,
        };
        let request = PanelRequest { kept: kept_of(job, args), ..request };
        panel_forces::compute(job, &names, &request)?;
        return Ok(Effect::Done);
    }
    settle_pressure(&mut job.model, &name);
    let effect = UnmodelledEffect {
        record: pressure_record(&name),
        effect: "added mass, radiation damping and wave forces by diffraction".into(),
        matters_to: SolveKind::Motions,
        span,
    };
    job.model.keep_unmodelled(effect);
    let said =
        Diagnostic::warning(format!("{name} has no hull for G_PRESSURE; motions stop until it has a database"), span);
    job.notices.push(*said.help(HULL_HELP));
    Ok(Effect::Done)
}

/// The rectangles of damped surface that a record gives.
pub fn lids_of(args: &Args) -> Vec<[f64; 5]> {
    args.occurrences(&LID).filter_map(|given| given.numbers().try_into().ok()).collect()
}

/// The file of results of another job; where there is none that is said.
fn kept_of(job: &mut Job, args: &Args) -> Option<PathBuf> {
    let given = args.option(&KEPT)?;
    let name = given.first_word()?;
    match existing(job, name, given.span) {
        Ok(path) => Some(path),
        Err(error) => {
            job.remark(format!("-KEPT: {}; what it would hold is computed", error.message), given.span);
            None
        }
    }
}

fn mean_drift(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = MEAN_SPEC.word("BODY");
    let (args, span) = (&call.args, call.args.span);
    let body = find(&job.model.bodies, args.word(NAME).unwrap_or_default(), "body", args.position(NAME))?;
    let name = body.name.clone();
    if job.checking.is_some() {
        return Ok(Effect::Done);
    }
    let Some(data) = body.database.as_ref().map(|attached| attached.data.clone()) else {
        let text = format!("{name} has no database whose drift could be found");
        return Err(Diagnostic::error(text, args.position(NAME))
            .help("G_PRESSURE makes one of its hull; #DRIFT gives mean drift by records"));
    };
    let Some(panels) = data.panels.filter(|_| data.interactions.is_empty()) else {
        if data.drift.is_some() || data.qtf.is_some() {
            job.remark(format!("the mean drift of {name} is that of its database: G_MDRIFT computes none"), span);
            return Ok(Effect::Done);
        }
        let text =
            format!("the database of {name} ({}) is not one that G_PRESSURE made of this body alone", data.source);
        return Err(Diagnostic::error(text, args.position(NAME)).help("#DRIFT gives mean drift by records"));
    };
    for option in [&MD_TYPE, &DIMENSIONS] {
        if let Some(given) = args.option(option) {
            let text = format!("{}: drift is that of the panels, not that of formulas", given.option.name);
            job.remark(text, given.span);
        }
    }
    let given = |option: &OptionSpec| args.option(option).map(Given::numbers).filter(|list| !list.is_empty());
    let length = |option: &OptionSpec| given(option).and_then(|list| list.first().copied());
    let request = PanelRequest {
        headings: given(&HEADING).map_or_else(|| data.headings.clone(), toward),
        periods: given(&PERIOD).unwrap_or_else(|| data.frequencies.iter().map(|w| TAU / w).collect()),
        size: length(&PANEL).or(Some(panels.largest)),
        edge_share: args.option_number(&EDGE_SHARE).unwrap_or(panels.edge_share),
        depth: length(&WATER_DEPTH).or(data.depth),
        lids: if args.has(&LID) { lids_of(args) } else { data.lids.clone() },
        has_drift: true,
        is_checked: false,
        kept: None,
        span,
    };
    panel_drift::compute(job, &name, &data, &request)?;
    Ok(Effect::Done)
}

/// Where waves go to (rad), growing, of headings that they come from.
pub(super) fn toward(list: Vec<f64>) -> Vec<f64> {
    let mut list: Vec<f64> = list.iter().map(|from| (from + PI).rem_euclid(TAU)).collect();
    list.sort_by(f64::total_cmp);
    list.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
    list
}

/// A database that records are giving.
#[derive(Clone, Debug)]
pub struct TotalData {
    body: String,
    /// Its packet.
    name: String,
    origin: [f64; 3],
    turn: [f64; 3],
    periods: Vec<TypedPeriod>,
    span: Span,
    /// A record of it was refused: it is not to be used.
    is_wrong: bool,
}

fn total(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = TOTAL_SPEC.word("BODY");
    const PACKET: DatumKey<str> = TOTAL_SPEC.word("PKT_NAME");
    let args = &call.args;
    let body = find(&job.model.bodies, args.word(NAME).unwrap_or_default(), "body", args.position(NAME))?;
    let made = TotalData {
        body: body.name.clone(),
        name: args.word(PACKET).unwrap_or_default().to_string(),
        origin: [0.0; 3],
        turn: [0.0; 3],
        periods: Vec::new(),
        span: args.span,
        is_wrong: false,
    };
    job.menus.push(Menu::Total(Box::new(made)));
    Ok(Effect::Done)
}

/// The database being given.
fn current(job: &mut Job, span: Span) -> Outcome<&mut TotalData> {
    match job.menus.last_mut() {
        Some(Menu::Total(data)) => Ok(data),
        _ => Err(Diagnostic::error("no I_TOTAL is open", span)),
    }
}

/// Its period now being given; a record that is wrong spoils the whole.
fn change(
    job: &mut Job,
    span: Span,
    edit: impl FnOnce(&mut TypedPeriod) -> Result<(), Box<Diagnostic>>,
) -> Outcome<Effect> {
    let data = current(job, span)?;
    let done = match data.periods.last_mut() {
        Some(period) => edit(period),
        None => Err(Diagnostic::error("H_PERIOD stands before the values of a period", span)),
    };
    data.is_wrong |= done.is_err();
    done.map(|()| Effect::Done)
}

fn origin(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let at = call.args.numbers_or_zero(const { ORIGIN_SPEC.numbers(["X", "Y", "Z"]) });
    current(job, call.args.span)?.origin = at;
    Ok(Effect::Done)
}

fn euler(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let turn = call.args.numbers_or_zero(const { EULER_SPEC.numbers(["RX", "RY", "RZ"]) });
    current(job, call.args.span)?.turn = turn;
    Ok(Effect::Done)
}

fn period(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let period = call.args.number(const { PERIOD_SPEC.number("T") }).unwrap_or_default();
    let data = current(job, call.args.span)?;
    if data.periods.len() >= MAX_PERIODS {
        data.is_wrong = true;
        return Err(Diagnostic::error(format!("at most {MAX_PERIODS} periods are taken"), call.args.span));
    }
    data.periods.push(TypedPeriod { period, ..TypedPeriod::default() });
    Ok(Effect::Done)
}

/// So many numbers of a record.
fn numbers(args: &Args, values: &[Value], count: usize) -> Outcome<Vec<f64>> {
    let list: Vec<f64> = values.iter().filter_map(Value::number).collect();
    if list.len() == count {
        return Ok(list);
    }
    let position = values.last().map_or(args.span, |value| value.span);
    Err(Diagnostic::error(format!("{} values; {count} are expected", list.len()), position))
}

/// The dimension of an entry of added mass as a weight, or of damping.
fn entry_dim(at: (usize, usize), is_mass: bool) -> Dim {
    let length = i8::from(at.0 >= 3) + i8::from(at.1 >= 3);
    if is_mass {
        Dim::Derived { force: 1, length, seconds: 0 }
    } else {
        Dim::Derived { force: 1, length: length - 1, seconds: 1 }
    }
}

fn matrix(job: &mut Job, call: &Call, is_mass: bool) -> Outcome<Effect> {
    let (args, units, gravity) = (&call.args, job.units, job.model.defaults.gravity);
    change(job, args.span, |period| {
        let list = numbers(args, &args.data, 36)?;
        let mut made = Matrix6::zeros();
        for (n, value) in list.into_iter().enumerate() {
            let at = (n / 6, n % 6);
            made[at] = entry_dim(at, is_mass).to_si(value, units);
        }
        let slot = if is_mass { &mut period.added_mass } else { &mut period.damping };
        if slot.is_some() {
            return Err(Diagnostic::error(format!("the period of {} s has them already", period.period), args.span));
        }
        *slot = Some(if is_mass { made / gravity } else { made });
        Ok(())
    })
}

/// The dimension of an exciting force over wave amplitude.
fn force_dim(direction: usize) -> Dim {
    Dim::Derived { force: 1, length: if direction < 3 { -1 } else { 0 }, seconds: 0 }
}

fn force(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const HEADING: DatumKey<f64> = FORCE_SPEC.number("HEADING");
    let (args, units) = (&call.args, job.units);
    change(job, args.span, |period| {
        let list = numbers(args, args.data_after(HEADING), 12)?;
        let mut made: Amplitudes = [Complex::new(0.0, 0.0); 6];
        for (direction, (slot, pair)) in made.iter_mut().zip(list.chunks(2)).enumerate() {
            if let [size, lag] = pair {
                *slot = Complex::from_polar(force_dim(direction).to_si(*size, units), lag.to_radians());
            }
        }
        // waves that come from a heading travel the other way
        let toward = args.number(HEADING).unwrap_or_default() + PI;
        period.forces.push((toward, made));
        Ok(())
    })
}

/// Gives the body the database whose records are complete. Returns what is wrong with it.
pub fn finish_total(job: &mut Job, data: TotalData, at: Option<Span>) -> Vec<Diagnostic> {
    if data.is_wrong {
        let text = format!("the data of {} are not used: a record of them is wrong", data.body);
        return vec![*Diagnostic::warning(text, at.unwrap_or(data.span))];
    }
    match attach_total(job, &data) {
        Ok(()) => Vec::new(),
        Err(error) => vec![*error],
    }
}

fn attach_total(job: &mut Job, data: &TotalData) -> Outcome<()> {
    let around = job.model.surroundings();
    let position = Place { shift: [0.0; 3], turn: data.turn };
    let axes =
        TypedAxes { reference: Vector3::from(data.origin), axes: *position.rotation().matrix(), yaw: data.turn[2] };
    let source = if data.name.is_empty() { "I_TOTAL".to_string() } else { format!("I_TOTAL {}", data.name) };
    let made = typed::build(&source, &axes, &data.periods, &around);
    let made = made.map_err(|e| Diagnostic::error(e.to_string(), data.span))?;
    let attached = AttachedDatabase {
        data: std::sync::Arc::new(made),
        at: [0.0; 3],
        memory: None,
        drift: DriftMethod::None,
        drift_damping: None,
        hydrostatics: false,
        span: data.span,
    };
    database::attach(job, &data.body, attached, data.span);
    Ok(())
}

/// A body that has a database.
fn find_database<'j>(job: &'j Job, args: &Args, key: DatumKey<str>) -> Outcome<(&'j Body, &'j AttachedDatabase)> {
    let body = find(&job.model.bodies, args.word(key).unwrap_or_default(), "body", args.position(key))?;
    let attached = body.database.as_ref().ok_or_else(|| {
        Diagnostic::error(format!("{} has no database", body.name), args.position(key)).help(
            "G_PRESSURE computes one of its hull, DATABASE reads one, I_TOTAL .. END_I_TOTAL gives one by records",
        )
    })?;
    Ok((body, attached))
}

fn export(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = EXPORT_SPEC.word("BODY");
    const FILE: DatumKey<str> = EXPORT_SPEC.word("FILE");
    let (args, units, gravity) = (&call.args, job.units, job.model.defaults.gravity);
    let (body, attached) = find_database(job, args, NAME)?;
    let data = &attached.data;
    if data.added_mass.is_empty() && data.excitation.is_empty() {
        return Err(Diagnostic::error(
            format!("the database of {} holds motions alone", body.name),
            args.position(NAME),
        ));
    }
    let [x, y, z]: [f64; 3] = data.reference.into();
    let lengths = [x, y, z].map(|x| Dim::Length.from_si(x, units));
    let mut text = format!("$ database of {}: {}\nHYDRODYNAMICS\nI_TOTAL {}\n", body.name, data.source, body.name);
    // writing into text does not fail
    let _ = writeln!(text, "H_ORIGIN {:?} {:?} {:?}", lengths[0], lengths[1], lengths[2]);
    let rows = |text: &mut String, name: &str, matrix: &Matrix6<f64>, is_mass: bool| {
        text.push_str(name);
        for row in 0..6 {
            text.push_str(" \\\n ");
            for column in 0..6 {
                let _ = write!(text, " {:?}", entry_dim((row, column), is_mass).from_si(matrix[(row, column)], units));
            }
        }
        text.push('\n');
    };
    for (n, frequency) in data.frequencies.iter().enumerate().rev() {
        let _ = writeln!(text, "H_PERIOD {:?}", TAU / frequency);
        if let (Some(mass), Some(damping)) = (data.added_mass.get(n), data.damping.get(n)) {
            rows(&mut text, "H_AMASS", &(mass * gravity), true);
            rows(&mut text, "H_DAMP", damping, false);
        }
        for (heading, forces) in data.headings.iter().zip(&data.excitation) {
            let Some(forces) = forces.get(n) else { continue };
            let from = (heading + PI).rem_euclid(TAU).to_degrees();
            let _ = write!(text, "H_FORCE {from:?} \\\n ");
            for (direction, value) in forces.iter().enumerate() {
                let size = force_dim(direction).from_si(value.norm(), units);
                let _ = write!(text, " {size:?} {:?}", value.arg().to_degrees());
            }
            text.push('\n');
        }
    }
    text.push_str("END_I_TOTAL\nEND_HYDRODYNAMICS\n");
    let file = args.word(FILE).map_or_else(|| format!("{}.tot", body.name), str::to_string);
    let lost: Vec<&str> = [
        (data.infinite.is_some(), "added mass at infinite frequency"),
        (data.drift.is_some() || data.qtf.is_some(), "drift"),
        (data.hydrostatics.is_some(), "hydrostatics"),
        (data.motions.is_some(), "motions"),
    ]
    .into_iter()
    .filter_map(|(is_lost, what)| is_lost.then_some(what))
    .collect();
    write_file(job, &file, text.as_bytes(), args.position(FILE))?;
    if !lost.is_empty() {
        job.warn(format!("{file} has no records of {}", lost.join(", ")), args.span);
    }
    Ok(Effect::Done)
}

fn dispose(job: &mut Job, table: Table) -> Effect {
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
    Effect::Done
}

/// Names of the six directions, as in columns.
const DIRECTIONS: [&str; 6] = ["X", "Y", "Z", "RX", "RY", "RZ"];

fn show_matrices(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = MATRICES_SPEC.word("BODY");
    let (body, attached) = find_database(job, &call.args, NAME)?;
    let data = &attached.data;
    if data.added_mass.is_empty() {
        return Err(Diagnostic::error(
            format!("the database of {} has no matrices", body.name),
            call.args.position(NAME),
        ));
    }
    let gravity = job.model.defaults.gravity;
    let mut table = Table::new(format!("Added Mass and Damping of {}", body.name));
    table.note("actual values, about the point of the database; MOSES prints them divided by the mass of the body: added mass, here a weight, over its weight, damping over its mass");
    let mut table = table
        .with_rows(&data.frequencies)
        .column("", "Period", Dim::Time, Digits::Decimals(3), |w| TAU / w)
        .column("", "Frequency", Dim::Frequency, Digits::Decimals(4), |w| *w)
        .build();
    for (group, letter, list, factor) in
        [("Added Mass", "A", &data.added_mass, gravity), ("Damping", "B", &data.damping, 1.0)]
    {
        for (row, down) in DIRECTIONS.iter().enumerate() {
            for (column, across) in DIRECTIONS.iter().enumerate() {
                let cells = list.iter().map(|matrix| matrix[(row, column)] * factor);
                let dim = entry_dim((row, column), letter == "A");
                let name = format!("{letter} {down}-{across}");
                table.add_column(Column::new(group, &name, dim, Digits::Scientific(4), cells));
            }
        }
    }
    Ok(dispose(job, table))
}

fn show_forces(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = FORCES_SPEC.word("BODY");
    let (body, attached) = find_database(job, &call.args, NAME)?;
    let table = database_table::excitation(body, attached).ok_or_else(|| {
        Diagnostic::error(format!("the database of {} has no exciting forces", body.name), call.args.position(NAME))
    })?;
    Ok(dispose(job, table))
}

fn show_drift(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = DRIFT_SPEC.word("BODY");
    let (body, attached) = find_database(job, &call.args, NAME)?;
    let table = database_table::drift(body, attached).ok_or_else(|| {
        Diagnostic::error(format!("the database of {} has no mean drift", body.name), call.args.position(NAME))
            .help("G_PRESSURE and G_MDRIFT make it of a hull; #DRIFT gives it by records; DATABASE reads it from the files of WAMIT, NEMOH, Capytaine and AQWA")
    })?;
    Ok(dispose(job, table))
}
