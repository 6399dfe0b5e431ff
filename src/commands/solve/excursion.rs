//! MOVE and WATCH of the CONN_DESIGN menu: a body moved until a line breaks, and where a force takes it.
//!
//! Source: [MOSES-RUNS con_d]: MOVE body [angle]; its sixth column is the restoring force.

use crate::commands::menu;
use crate::commands::name_filter::{note_caveats, raise};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::summary::of_table;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use crate::report::format::number_in_full;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::pose::Pose;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun, Value};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Body, Model, find};
use windlass_solve::excursion::ExcursionPath;
use windlass_solve::excursion_tables::{
    ExcursionTableOptions, Systems, circle, table_along_direction, table_of_directions,
};
use windlass_solve::watch::watch;
use windlass_solve::{SolveError, System};

/// MOVE.
pub static MOVE: Command = Command { spec: &MOVE_SPEC, edits: false, run: run_excursion };
/// WATCH.
pub static WATCH: Command = Command { spec: &WATCH_SPEC, edits: false, run: run_watch_circle };

/// Most directions of one record.
const MAX_DIRECTIONS: usize = 3600;

const BODY: ValueSpec = ValueSpec::new("BODY", Kind::Name(Noun::Body), "body");
const ANGLE: ValueSpec =
    ValueSpec::new("ANGLE", Kind::Number(Dim::Angle), "direction in which it is moved, from +X toward +Y");
const ANGLES: OptionSpec = OptionSpec::new(
    "-ANGLES",
    &[
        ValueSpec::new("FROM", Kind::Number(Dim::Angle), "first direction, from +X toward +Y"),
        ValueSpec::new("TO", Kind::Number(Dim::Angle), "last direction, which is among them when a step ends there"),
        ValueSpec::new("STEP", Kind::Number(Dim::Angle), "between one and the next").positive(),
    ],
    "directions in equal steps",
)
.owner(Owner::Ours);
const REMOVE: OptionSpec = OptionSpec::new(
    "-REMOVE",
    &[ValueSpec::new("LINE", Kind::Name(Noun::Connector), "connector that does not act")],
    "with these lines removed; the intact mooring stands beside it",
)
.repeating(1)
.owner(Owner::Ours);
const FREE: OptionSpec = OptionSpec::new("-FREE", &[], "all other degrees of freedom of all bodies come to rest")
    .owner(Owner::Ours)
    .default("held");

const DISTANCE: OptionSpec = OptionSpec::new(
    "-DISTANCE",
    &[ValueSpec::new("D", Kind::Number(Dim::Length), "excursion").positive()],
    "no farther than this, also when no line breaks",
)
.owner(Owner::Ours);
const ROWS: OptionSpec = OptionSpec::new(
    "-ROWS",
    &[ValueSpec::new("N", Kind::Integer, "rows").in_range(2.0, 10_000.0)],
    "rows of one direction",
)
.owner(Owner::Ours)
.default("30");
const AT: OptionSpec = OptionSpec::new(
    "-AT",
    &[ValueSpec::new("D", Kind::Number(Dim::Length), "excursion").not_negative()],
    "of several directions: the restoring force at these excursions too",
)
.repeating(1)
.owner(Owner::Ours);

static MOVE_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::DISPOSITION),
    menus: &[&menu::CONN_DESIGN],
    data: &[BODY, ANGLE.or("0, and more of them: one row a direction")],
    repeat: 1,
    options: &[ANGLES, FREE, REMOVE, DISTANCE, ROWS, AT],
    detail: "The body is moved from where it stands along a horizontal direction, in equal steps up to the excursion at which \
             the first line breaks (the last row), or to -DISTANCE. Its other degrees of freedom and the other bodies stay as they are; \
             with -FREE they come to rest at every excursion, and what acts on them (weight and the like) then counts. Forces \
             are those of the connectors on the body: Restoring along the direction, positive when it pushes back; \
             Transverse toward its left; Vertical upward; moments about the body's origin along global axes. Ten and T/TB are \
             the tension at the first end and the largest tension over break of each. With -REMOVE all of this is of the \
             mooring without those lines, and the last columns are of the intact one at the same excursion. Several angles, or -ANGLES, give \
             one row a direction: where the first line breaks, with the force there and at the excursions of -AT; PLOT Direction \
             Excursion -POLAR draws them. Nothing in the model is changed. The result goes to the disposition menu: PLOT 1 6 \
             is excursion and restoring force.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*P 0 50 20\n*S 0 -50 20\n~W B_CAT 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC 45 3900 ~W *P\nCONNECTOR B -ANC 135 3900 ~W *P\nCONNECTOR C -ANC -135 3900 ~W *S\n\
              CONNECTOR D -ANC -45 3900 ~W *S\nEND\nCONN_DESIGN\nMOVE TBRG 90\nREPORT 1:8 -RECORD 1 30\nPLOT 1 6 -NO\nEND\n\
              MOVE TBRG 0 -REMOVE A -DISTANCE 20 -ROWS 5\nVIEW 1 6 Intact@\nEND\n\
              MOVE TBRG -ANGLES 0 345 15 -AT 10\nPLOT Direction Excursion -POLAR\nEND\nEND",
    ..CommandSpec::new("MOVE", "moves a body until a line breaks")
};

static WATCH_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    opens: Opens::Menu(&menu::DISPOSITION),
    menus: &[&menu::CONN_DESIGN],
    data: &[
        BODY,
        ValueSpec::new("FORCE", Kind::Number(Dim::Force), "horizontal force at the body's origin").positive(),
    ],
    options: &[ANGLES.default("0 360 15"), FREE, REMOVE],
    detail: "Where the body comes to rest under the force, beside all that acts on it in the environment in force, for each \
             direction the force comes from (from +X toward +Y, as of wind and current in &ENV). The body moves in X, Y \
             and about Z, and all else stays; with -FREE all bodies come to rest in all degrees of freedom. Excursions are from where the \
             body stands. With -REMOVE the lines do not act, and the last columns are of the intact mooring. PLOT X Y draws \
             the path of its origin, PLOT From Excursion -POLAR the excursion by direction. Nothing in the model is changed. \
             The result goes to the disposition menu.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*P 0 50 20\n*S 0 -50 20\n~W B_CAT 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC 45 3900 ~W *P\nCONNECTOR B -ANC 135 3900 ~W *P\nCONNECTOR C -ANC -135 3900 ~W *S\n\
              CONNECTOR D -ANC -45 3900 ~W *S\nEND\nCONN_DESIGN\nWATCH TBRG 50\nREPORT\nPLOT X Y\nPLOT From Excursion -POLAR\nEND\n\
              WATCH TBRG 50 -ANGLES 0 90 30 -REMOVE A\nVIEW\nEND\nEND",
    ..CommandSpec::new("WATCH", "watch circle: where a force from each direction takes a body")
};

/// The body of MOVE, and of WATCH, which names it alike.
const NAMED: DatumKey<str> = MOVE_SPEC.word(BODY.name);

/// The body a record names, and its number.
fn body<'a>(job: &'a Job, args: &Args) -> Outcome<(&'a Body, usize)> {
    let found = find(&job.model.bodies, args.word(NAMED).unwrap_or_default(), "body", args.position(NAMED))?;
    let index = job.model.bodies.get_index_of(&Model::key(&found.name)).unwrap_or(0);
    Ok((found, index))
}

/// The directions of -ANGLES.
fn range(args: &Args) -> Outcome<Option<Vec<f64>>> {
    let Some(given) = args.option(&ANGLES) else { return Ok(None) };
    let [Some(from), Some(to), Some(step)] =
        const { ANGLES.numbers(["FROM", "TO", "STEP"]) }.map(|key| given.number(key))
    else {
        return Ok(None);
    };
    let count = (to - from) / step + 1e-9;
    if count < 0.0 {
        return Err(Diagnostic::error("-ANGLES holds no direction: it ends before it begins", given.span));
    }
    if count >= MAX_DIRECTIONS as f64 {
        return Err(Diagnostic::error(format!("-ANGLES holds more than {MAX_DIRECTIONS} directions"), given.span));
    }
    Ok(Some((0..=count as usize).map(|n| from + step * n as f64).collect()))
}

/// The system without the lines of -REMOVE, and the intact one beside it.
fn systems(job: &Job, args: &Args) -> Outcome<Systems> {
    let mut removed: Vec<String> = Vec::new();
    for value in args.option(&REMOVE).map_or(&[][..], |g| &g.values) {
        let Some(word) = value.word() else { continue };
        let connector = find(&job.model.connectors, word, "connector", value.span)?;
        if !connector.active {
            return Err(Diagnostic::error(format!("connector {} is inactive already", connector.name), value.span));
        }
        removed.push(connector.name.clone());
    }
    let wrong = |e: SolveError| to_diagnostic(e, &job.model, args.position(NAMED), job.units);
    let system = System::new(&job.model, &removed).map_err(wrong)?;
    let intact = (!removed.is_empty()).then(|| System::new(&job.model, &[])).transpose().map_err(wrong)?;
    Ok(Systems { system, intact, removed })
}

/// Prints the summary of a table with what to look at next, opens the disposition menu over it, and raises its warnings.
fn dispose(job: &mut Job, (command, next): (&str, &str), mut made: Table, args: &Args) -> Effect {
    let acting = job.model.connectors.values().filter(|c| c.active).map(|c| c.name.as_str());
    made.add_notes(job.model.idealisations(acting));
    note_caveats(&job.model, std::slice::from_mut(&mut made));
    raise(job, &made, args.position(NAMED));
    let residual = if args.has(&FREE) || command == WATCH_SPEC.name {
        "bodies that move are at rest within the tolerance of &EQUI"
    } else {
        "none to solve for: other degrees of freedom are held; -FREE brings them to rest"
    };
    of_table(command, &made, residual, job.units).print(job, next);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(made))));
    Effect::Done
}

fn poses(job: &Job) -> Vec<Pose> {
    job.model.bodies.values().map(|b| Pose::from_place(&b.position)).collect()
}

fn run_excursion(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (body, index) = body(job, args)?;
    let given: Vec<f64> = args.data_after(NAMED).iter().filter_map(Value::number).collect();
    let several = range(args)?;
    if let (Some(option), false) = (args.option(&ANGLES), given.is_empty()) {
        return Err(Diagnostic::error("directions are given twice", option.span)
            .other(args.position(const { MOVE_SPEC.number(ANGLE.name) }), "first given here"));
    }
    let one = several.is_none() && given.len() < 2;
    let unused = if one { AT } else { ROWS };
    if let Some(option) = args.option(&unused) {
        let of = if one { "several directions" } else { "one direction" };
        return Err(Diagnostic::error(format!("{} goes with {of}", unused.name), option.span));
    }
    let systems = systems(job, args)?;
    let directions = several.unwrap_or(given);
    let direction = directions.first().copied().unwrap_or(0.0);
    let path = ExcursionPath { body: index, direction, free: args.has(&FREE), most: args.option_number(&DISTANCE) };
    let start = poses(job);
    let asked =
        ExcursionTableOptions { name: &body.name, position: &body.position, start: &start, path, units: job.units };
    let made = if one {
        let rows = args.option_integer(&ROWS);
        table_along_direction(&systems, &asked, rows.and_then(|n| usize::try_from(n).ok()).unwrap_or(30))
    } else {
        let at: Vec<(f64, String)> = args
            .option(&AT)
            .map_or(&[][..], |g| &g.values)
            .iter()
            .filter_map(|v| v.number())
            .map(|v| (v, number_in_full((Dim::Length.from_si(v, job.units) * 1e9).round() / 1e9)))
            .collect();
        table_of_directions(&systems, &asked, &directions, &at)
    };
    let made = made.map_err(|e| to_diagnostic(e, &job.model, args.position(NAMED), job.units))?;
    let next =
        if one { "REPORT: all rows; PLOT Excursion Restoring" } else { "REPORT; PLOT Direction Excursion -POLAR" };
    Ok(dispose(job, (MOVE_SPEC.name, next), made, args))
}

fn run_watch_circle(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (body, index) = body(job, args)?;
    let force = args.number(const { WATCH_SPEC.number("FORCE") }).unwrap_or(0.0);
    let around = (0..=24).map(|n| (15.0 * f64::from(n)).to_radians());
    let directions = range(args)?.unwrap_or_else(|| around.collect());
    let mut systems = systems(job, args)?;
    let (free, start) = (args.has(&FREE), poses(job));
    let wrong = |e: SolveError| to_diagnostic(e, &job.model, args.position(NAMED), job.units);
    let asked_for = (index, force, free);
    let found = watch(&mut systems.system, &start, asked_for, &directions).map_err(wrong)?;
    let intact = match &mut systems.intact {
        Some(system) => Some(watch(system, &start, asked_for, &directions).map_err(wrong)?),
        None => None,
    };
    let path = ExcursionPath { body: index, direction: 0.0, free, most: None };
    let asked =
        ExcursionTableOptions { name: &body.name, position: &body.position, start: &start, path, units: job.units };
    let made = circle((&asked, force), &systems, &found, intact.as_ref());
    Ok(dispose(job, (WATCH_SPEC.name, "REPORT: all rows; PLOT X Y: the watch circle"), made, args))
}
