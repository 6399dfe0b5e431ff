//! The CONN_DESIGN menu.

use crate::commands::menu;
use crate::commands::name_filter::{NameFilter, raise};
use crate::commands::output::disposition::{BOTH, HARD, WIDE, send_tables};
use crate::commands::solve::summary::of_table;
use crate::commands::solve::vary;
use crate::commands::{Call, Command, Effect, Job, Menu, status};
use crate::report::disposition::Disposition;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::{Digits, Fact, Table};
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{AbsentRow, Class, Condition, Connector, EntityKind, LineSampling, find};

/// TABLE.
pub static TABLE: Command = Command { spec: &TABLE_SPEC, edits: false, run: table };
/// GEOMETRY.
pub static GEOMETRY: Command = Command { spec: &GEOMETRY_SPEC, edits: false, run: geometry };
/// PROPERTIES.
pub static PROPERTIES: Command = Command { spec: &PROPERTIES_SPEC, edits: false, run: properties };

const LINE: ValueSpec = ValueSpec::new("LINE", Kind::Name(Noun::Connector), "connector");
const HORIZONTAL: OptionSpec = OptionSpec::new(
    "-HORIZONTAL",
    &[ValueSpec::new("F", Kind::Number(Dim::Force), "horizontal force at the fairlead").positive()],
    "pulled out until it has this horizontal force",
)
.owner(Owner::Ours);
const VERTICAL: OptionSpec = OptionSpec::new(
    "-VERTICAL",
    &[ValueSpec::new("F", Kind::Number(Dim::Force), "vertical force at the fairlead").positive()],
    "pulled out until it has this vertical force",
)
.owner(Owner::Ours);
const TENSION: OptionSpec = OptionSpec::new(
    "-TENSION",
    &[ValueSpec::new("F", Kind::Number(Dim::Force), "tension at the fairlead").positive()],
    "pulled out until it has this tension",
)
.owner(Owner::Ours);
const DISTANCE: OptionSpec = OptionSpec::new(
    "-DISTANCE",
    &[ValueSpec::new("X", Kind::Number(Dim::Length), "horizontal distance of its ends").not_negative()],
    "at this horizontal distance between its ends",
)
.owner(Owner::Ours);

static TABLE_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::DISPOSITION),
    menus: &[&menu::CONN_DESIGN],
    data: &[LINE],
    options: &[vary::VARY, HORIZONTAL, TENSION, DISTANCE],
    detail: "Thirty rows with horizontal forces T (n/29)**2 up to T, the table limit or the largest breaking tension of all \
             segments; the fairlead stays at its present height. A row without a configuration has its force alone, and a warning. Rows beyond the breaking tension are kept and said. With \
             -VARY the rows are those of one parameter in place of the force: LENGTH (of the first segment), FAIRLEAD \
             (elevation of the fairlead), DEPTH (of the anchor), FRICTION, SLOPE, WEIGHT and STIFFNESS (factors on all \
             segments), DISTANCE, HORIZONTAL (force) or TENSION (at the fairlead); all but the last three are varied between \
             the ends as they are, or at the -HORIZONTAL force, the -TENSION or the -DISTANCE given. A value without a \
             configuration has a row without numbers and a warning. Line on Bottom is stretched. The result goes to the \
             disposition menu, which ends with END.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*MLA 400 50 20\n~WIRE b_cat 4.19 -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC -45 3900 ~WIRE *MLA\nEND\nCONN_DESIGN\nTABLE A\nVIEW X Force\nEND\n\
              TABLE A -VARY LENGTH 3950 4000 4050\nVIEW Length 'Ten Top'\nEND\n\
              TABLE A -VARY FAIRLEAD 10 20 30 -TENSION 60\nREPORT\nEND\nEND",
    ..CommandSpec::new("TABLE", "tabulates a line")
};

const POINTS: OptionSpec = OptionSpec::new(
    "-POINTS",
    &[ValueSpec::new("N", Kind::Integer, "points inside each segment, evenly spaced").in_range(0.0, 10_000.0)],
    "so many rows inside each segment",
)
.owner(Owner::Ours)
.default("as many as a drawn curve needs: the line turns by at most 2.3 degrees from row to row");

static GEOMETRY_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::DISPOSITION),
    menus: &[&menu::CONN_DESIGN],
    data: &[LINE],
    options: &[HORIZONTAL, VERTICAL, TENSION, DISTANCE, POINTS],
    detail: "The shape of the line between its ends as they are, or with one of the options; the fairlead keeps its height. \
             X is the horizontal distance from the fairlead, Z the elevation, Arc Length the unstretched length from the \
             fairlead; forces are those in the line, the angle is above the horizontal. Bottom and Surface are there to be \
             plotted with it; Touchdown and Joint have the Z of those rows only. Ends of segments and touchdown points \
             always have a row. The result goes to the disposition menu: \
             PLOT X Z Bottom Surface Touchdown Joint.",
    example: "MEDIT\n*P 0 0 10\n~W B_CAT 4 -LEN 2000 -DEP 500 -CLUMP 20\n~W B_CAT 4 -LEN 2000\nCONNECTOR A -ANC 0 3800 ~W *P\n\
              END\nCONN_DESIGN\nGEOMETRY A\nPLOT X Z Bottom Surface Touchdown Joint\nEND\n\
              GEOMETRY A -TENSION 120\nREPORT X Z Tension Angle\nEND\nEND",
    ..CommandSpec::new("GEOMETRY", "the shape of a line")
};

static PROPERTIES_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::CONN_DESIGN],
    data: &[ValueSpec::new("~CLASS", Kind::Name(Noun::Selector), "class, pattern or selector")
        .among(&[Noun::Class])
        .or("all classes of lines")],
    repeat: 1,
    options: &[HARD, BOTH, WIDE],
    detail: "One table a class, with its records as they were given: what &STATUS CL_FLEX prints.",
    example: "MEDIT\n~WIRE B_CAT 4.19 -LEN 4000 -DEP 500\n~CHAIN B_CAT -TYPE CHAIN_R4 4 -LEN 900 -DEP 500\nEND\nCONN_DESIGN\n\
              PROPERTIES\nPROPERTIES ~CH@\nEND",
    ..CommandSpec::new("PROPERTIES", "the properties of classes")
};

/// The connector of TABLE, and of GEOMETRY, which names it alike.
const NAMED: DatumKey<str> = TABLE_SPEC.word(LINE.name);

/// The connector that a record's first datum names, and its class.
fn find_connector<'a>(job: &'a Job, args: &Args) -> Outcome<(&'a Connector, &'a Class)> {
    let connector =
        find(&job.model.connectors, args.word(NAMED).unwrap_or_default(), "connector", args.position(NAMED))?;
    if let Some(assembly) = job.model.reeving(&connector.name) {
        let text =
            format!("{} is a span of the line of {}, whose tension is not found alone", connector.name, assembly.name);
        return Err(Diagnostic::error(text, args.position(NAMED)).help("&STATUS ASSEMBLIES reports the line"));
    }
    Ok((connector, find(&job.model.classes, &connector.class, "class", args.position(NAMED))?))
}

/// The configuration a record asks for: the ends as they are, or that of one option.
fn condition(args: &Args) -> Outcome<Condition> {
    let mut given = args.options.iter().filter_map(|g| {
        let value = g.first_number()?;
        let made = match g {
            _ if g.is(&HORIZONTAL) => Condition::Horizontal(value),
            _ if g.is(&TENSION) => Condition::Tension(value),
            _ if g.is(&VERTICAL) => Condition::Vertical(value),
            _ if g.is(&DISTANCE) => Condition::Distance(value),
            _ => return None,
        };
        Some((g, made))
    });
    match (given.next(), given.next()) {
        (Some((first, _)), Some((second, _))) => {
            let text = format!("{} and {} cannot hold at once", first.name(), second.name());
            Err(Diagnostic::error(text, second.span).other(first.span, "first given here"))
        }
        (Some((_, made)), None) => Ok(made),
        _ => Ok(Condition::Placed),
    }
}

/// Prints the summary of the table of a class's line with what to look at next, opens the disposition menu over it, and raises its warnings.
fn dispose(job: &mut Job, class: &str, (command, next): (&str, &str), mut made: Table, span: Span) -> Effect {
    let name = Fact { name: "Line Class".into(), value: class.into(), dim: Dim::None, digits: Digits::Usual };
    made.facts.insert(0, name);
    raise(job, &made, span);
    of_table(command, &made, "each row is solved to the tolerance of the line engine", job.units).print(job, next);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(made))));
    Effect::Done
}

fn table(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.position(NAMED));
    let (connector, class) = find_connector(job, args)?;
    let name = class.name.clone();
    let held = condition(args)?;
    if let Some(vary) = args.option(&vary::VARY) {
        let (made, missing) = vary::tabulate(job, (connector, class), vary, held, args)?;
        let effect = dispose(job, &name, ("TABLE", "REPORT: all rows; PLOT draws columns"), made, span);
        missing.into_iter().for_each(|(text, position)| job.warn(text, position));
        return Ok(effect);
    }
    if let Some(option) = args.options.first() {
        return Err(Diagnostic::error(format!("{} of TABLE goes with -VARY", option.name()), option.span)
            .help("GEOMETRY shows a line in one configuration"));
    }
    let line = class.line(&job.model.placement(connector), &job.model.surroundings());
    let (mut made, absent) = line
        .and_then(|l| l.tabulate(&connector.name))
        .map_err(|e| e.diagnostic(span, job.units).help(format!("while tabulating connector {}", connector.name)))?;
    made.absent = absent.len();
    for AbsentRow { number, error } in absent {
        made.warn(format!("row {number} has no configuration: {}", error.text(job.units)));
    }
    Ok(dispose(job, &name, ("TABLE", "REPORT: all rows; PLOT X Force"), made, span))
}

fn geometry(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let (args, span) = (&call.args, call.args.position(NAMED));
    let (connector, class) = find_connector(job, args)?;
    let (name, condition) = (class.name.clone(), condition(args)?);
    let points = args.option_integer(&POINTS).and_then(|n| usize::try_from(n).ok());
    let sampling = points.map_or(LineSampling::Adaptive, LineSampling::Inside);
    let line = class.line(&job.model.placement(connector), &job.model.surroundings());
    let made = line
        .and_then(|l| {
            let mut made = l.geometry(&connector.name, condition, sampling)?;
            let remarks = l.configuration(condition)?.notes;
            made.notes.splice(0..0, remarks.iter().map(|note| note.for_table(job.units)));
            Ok(made)
        })
        .map_err(|e| e.diagnostic(span, job.units).help(format!("while shaping connector {}", connector.name)))?;
    Ok(dispose(job, &name, ("GEOMETRY", "REPORT: all points; PLOT X Z: the shape"), made, span))
}

fn properties(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let tables = {
        let chosen = NameFilter::new(&call.args.data, &job.model);
        let tables = status::class_tables::classes(job, &|class| {
            if chosen.chooses_all() { class.object.as_line().is_some() } else { chosen.matches(&class.name) }
        });
        chosen.check("the classes", &tables, &[EntityKind::Class])?;
        if tables.is_empty() {
            return Err(Diagnostic::error("no class of a line is defined yet", call.args.span));
        }
        tables
    };
    send_tables(job, &call.args, &tables)?;
    Ok(Effect::Done)
}
