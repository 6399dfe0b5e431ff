//! `TETHER` and `STRUCTURE` of the PRCPOST menu: what a run of tethers came to.
//!
//! Source: [AQWA-TETHER 2.1 to 2.3 and 7.3 to 7.10].

use crate::commands::menu;
use crate::commands::output::disposition::{BOTH, HARD, send};
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use crate::report::page;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given};
use windlass_hydro::spectrum::is_regular;
use windlass_language::select::{Owner, choose};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_signal::SeriesError;
use windlass_signal::tether::fatigue::{Endurance, FatigueSettings};
use windlass_solve::tethered::{self, Of, StatisticsSteps, TetherHistory, TetherStatistics, Tethered};
use windlass_tether::installed::RigChange;

/// TETHER.
pub static TETHER: Command = Command { spec: &TETHER_SPEC, edits: false, run: tether };
/// STRUCTURE.
pub static STRUCTURE: Command = Command { spec: &STRUCTURE_SPEC, edits: false, run: structure };

choices! {
    /// What TETHER reports.
    enum TetherReport {
        Motions = "MOTIONS",
        Forces = "FORCES",
        Node = "NODE",
        EndOf = "END_OF",
        Along = "ALONG",
        Statistics = "STATISTICS",
        Ranges = "RANGES",
        Fatigue = "FATIGUE",
        Events = "EVENTS",
    }
}

choices! {
    /// What STRUCTURE reports.
    #[derive(Default)]
    enum StructureReport {
        #[default]
        Pages = "PAGES",
        History = "HISTORY",
        Harmonics = "HARMONICS",
    }
}

const NAME: DatumKey<str> = TETHER_SPEC.word("NAME");
const WHAT: DatumKey<TetherReport> = TETHER_SPEC.choice("WHAT");
const NUMBER: DatumKey<str> = TETHER_SPEC.word("N");
const OF_STRUCTURE: DatumKey<StructureReport> = STRUCTURE_SPEC.choice("WHAT");
/// Times on one graph [AQWA-TETHER 2.2].
const MAX_CURVES: usize = 20;

const fn ours(name: &'static str, values: &'static [ValueSpec], help: &'static str) -> OptionSpec {
    OptionSpec::new(name, values, help).owner(Owner::Ours)
}
const EVENTS: OptionSpec = ours(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::Time), "time of the first instant"),
        ValueSpec::new("END", Kind::Number(Dim::Time), "time of the last").or("the end of the run"),
        ValueSpec::new("INC", Kind::Number(Dim::Time), "time from one to the next").or("every one").not_negative(),
    ],
    "the stored instants that are reported or counted",
)
.default("all; STATISTICS, RANGES and FATIGUE leave out those before TTRA_SET");
const DISPOSE: OptionSpec = ours(
    "-DISPOSE",
    &[ValueSpec::new("N", Kind::Integer, "which of its tables").or("1").in_range(1.0, 1e6)],
    "opens the disposition menu over a table instead of printing",
);

const SLACK: OptionSpec = ours(
    "-SLACK",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time reported from each time a tether goes slack").not_negative()],
    "only instants after a tether of the run went slack",
);
const STEPS: OptionSpec = ours(
    "-STEPS",
    &[
        ValueSpec::new("FIRST", Kind::Integer, "step at which statistics start; the start of the run is step 1")
            .in_range(1.0, 1e9),
        ValueSpec::new("LAST", Kind::Integer, "step at which they finish").or("the last").in_range(1.0, 1e9),
        ValueSpec::new("EVERY", Kind::Integer, "steps from one record to the next")
            .or("-STORE of the run")
            .in_range(1.0, 1e9),
    ],
    "the steps of STATISTICS, RANGES and FATIGUE, as cards TSTS, TSTF and TGRV count them; the record at or before FIRST is the first",
);
const AT: OptionSpec =
    ours("-AT", &[ValueSpec::new("T", Kind::Number(Dim::Time), "times, twenty at most")], "instants of ALONG")
        .repeating(1)
        .default("the last");
const SN: OptionSpec = ours(
    "-SN",
    &[
        ValueSpec::new("SCF", Kind::Number(Dim::None), "stress concentration factor").positive(),
        ValueSpec::new("A", Kind::Number(Dim::None), "intercept of N = A / R**m, R in kN/m2").positive(),
        ValueSpec::new("M", Kind::Number(Dim::None), "slope").positive(),
    ],
    "fatigue curve",
)
.default("1.24 1.3367E24 3.5");
const HOURS: OptionSpec = ours(
    "-HOURS",
    &[ValueSpec::new("H", Kind::Number(Dim::None), "hours").positive()],
    "time in which the peak stress is expected",
)
.default("3");

static TETHER_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::Connector), "a tether of the run"),
        ValueSpec::choice::<TetherReport>("WHAT", "what to report"),
        ValueSpec::new("N", Kind::Text, "number of the node or the element, or what ALONG is of")
            .or("1, and 2 of STATISTICS"),
    ],
    options: &[EVENTS, STEPS, SLACK, AT, SN, HOURS, DISPOSE, HARD, BOTH],
    detail: "Of a tether that TDOM -TETHERS has run. MOTIONS and FORCES are pages at instants, NODE and END_OF have one node or one \
             end of an element over time (END_OF 5 is the lower end of element 3, 6 its upper end), ALONG one quantity along the tether, with the least and the \
             largest of the run: Y Z RY RZ (X Y RX RY of an installed tether), the same with V or A before them for velocities and accelerations, and \
             of a towed tether SY SZ MY MZ SMAX STY STZ, of an installed one EFF WALL SX SY MX MY SHEAR MAX MIN MISES STY. STATISTICS 1 has a page \
             for each node and end, STATISTICS 2 one for each parameter: mean, twice the deviation, means of the highest third of the maxima and \
             of the lowest of the minima, three largest peaks. RANGES and FATIGUE are of towed tethers: rainflow as that program has it, life in days, peak expected. \
             Nodes and elements count from the anchor or the trailing end.",
    example: EXAMPLE,
    ..CommandSpec::new("TETHER", "results of a tether")
};

const EXAMPLE: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*E -100 0 -0.5\n&DESCRIBE BODY TUG -IGNORE X Y Z RX RY RZ\n*V 0 0 -0.5\n#WEIGHT *V 1000 1 1 1\n\
     ~T TETHER 1.1 0.038 -LEN 100 -REFINE 4\nCONNECTOR T ~T *V *E -TOWED -V_MOORING 1 1 1 -A_MOORING 1 1 1\n\
     END\n&ENV -SEA ISSC 0 2 8 -TIME 20 0.25\nTDOM -TETHERS\nPRCPOST\nTETHER T MOTIONS -EVENTS 0 10 5\nTETHER T FORCES -EVENTS 10\n\
     TETHER T STATISTICS 2 -EVENTS 5 20\nTETHER T FATIGUE\nTETHER T ALONG MY -AT 5 10 15 -DISPOSE\nREPORT\nEND\nTETHER T NODE 3 -DISPOSE\n\
     VIEW Time Z VZ\nEND\nEND";

static STRUCTURE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: &[
        ValueSpec::choice::<StructureReport>("WHAT", "what to report").or("PAGES"),
        ValueSpec::new("*P", Kind::Name(Noun::Point), "points of the structure whose places are reported").or("none"),
    ],
    repeat: 1,
    options: &[EVENTS, DISPOSE, HARD, BOTH],
    detail: "Of the body that installed tethers hold, in a run of TDOM -TETHERS: PAGES of the motion of its centre of gravity and of the \
             forces on it by category at instants, with the expected error of the step; HISTORY has all over time, in columns X to RZ, VX, AX, and of forces G (gravity), H (hydrostatic), D (drag), FK (Froude-Krylov), \
             WI (wave inertia), DF (diffraction and what else acts on the body), GY (gyroscopic), M (mooring), T (total) with the axis behind; HARMONICS the mean, the drift and four harmonics of the \
             motion over the first cycle of a regular wave, or over the instants of -EVENTS.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*A 0 0 -100\n&DESCRIBE BODY SPAR\n*B 0 0 -30\n*T 0 0 12\n*G 0 0 -20\n#WEIGHT *G 18000 12 12 5\n\
              &SURFACE\nTUBE HULL *B *T 10000\nEND\n~T TETHER 0.6 0.03 -LEN 69.97 -REFINE 4\nCONNECTOR T ~T *B *A -V_SPRINGS 0 0 0 -A_SPRINGS 0 0 0\n\
              END\n&ENV -DEPTH 100 -SEA STOKES 180 4 8 -STOKES 2 -TIME 16 0.1\nTDOM -TETHERS\nPRCPOST\nSTRUCTURE PAGES *T -EVENTS 0 8 4\n\
              STRUCTURE HARMONICS\nSTRUCTURE HISTORY -DISPOSE\nREPORT POSITION\nEND\nEND",
    ..CommandSpec::new("STRUCTURE", "results of the structure that tethers hold")
};

/// The last run of tethers.
fn last_run(job: &Job, span: Span) -> Outcome<&Tethered> {
    let missing = || Diagnostic::error("there is no run of tethers yet", span).help("TDOM -TETHERS makes one");
    job.tethered.as_ref().ok_or_else(missing)
}

/// The places of the stored instants that a record asks for.
fn instants(run: &Tethered, args: &Args) -> Outcome<Vec<usize>> {
    let slack = 1e-6 * run.settings.step;
    let (begin, end, increment) = match args.option(&EVENTS) {
        None => (f64::NEG_INFINITY, f64::INFINITY, 0.0),
        Some(given) => {
            let [begin, end, increment] = const { EVENTS.numbers(["BEG", "END", "INC"]) }.map(|key| given.number(key));
            (begin.unwrap_or(0.0), end.unwrap_or(f64::INFINITY), increment.unwrap_or(0.0))
        }
    };
    let mut next = begin;
    let mut list = Vec::new();
    for (place, time) in run.times.iter().enumerate() {
        if *time < next - slack || *time > end + slack {
            continue;
        }
        list.push(place);
        if increment > 0.0 {
            next = if next.is_finite() { next } else { *time };
            while next <= *time + slack {
                next += increment;
            }
        }
    }
    if list.is_empty() {
        let span = args.option(&EVENTS).map_or(args.span, |g| g.span);
        return Err(Diagnostic::error("no stored instant is between these times", span));
    }
    Ok(list)
}

/// Those of them that are within a time of a tether's going slack: the listing of [AQWA-TETHER 8.2] then has all tethers.
fn slack_alone(run: &Tethered, given: Option<&Given>, list: Vec<usize>) -> Vec<usize> {
    let Some(lasting) = given.and_then(|g| g.first_number()) else { return list };
    let slack = 1e-6 * run.settings.step;
    let began: Vec<f64> = run.happened.iter().filter(|e| e.change == RigChange::Slack).map(|e| e.time).collect();
    let near = |place: &usize| {
        let time = run.times.get(*place).copied().unwrap_or_default();
        began.iter().any(|from| time >= from - slack && time <= from + lasting + slack)
    };
    list.into_iter().filter(near).collect()
}

/// The records that statistics are of: between steps, or between times.
fn window(run: &Tethered, args: &Args) -> Outcome<TetherStatistics> {
    if let Some(given) = args.option(&STEPS) {
        let whole = |n: Option<i64>| n.and_then(|n| usize::try_from(n).ok());
        let keys = const { [STEPS.integer("FIRST"), STEPS.integer("LAST"), STEPS.integer("EVERY")] };
        let [first, last, every] = keys.map(|key| whole(given.integer(key)));
        let steps = StatisticsSteps {
            first: first.unwrap_or(1),
            last: last.unwrap_or(usize::MAX),
            every: every.unwrap_or(run.settings.store),
        };
        if let Some(times) = args.option(&EVENTS) {
            return Err(Diagnostic::error("-EVENTS does not go with -STEPS", times.span)
                .help("-STEPS counts steps from 1, -EVENTS has times: one of them sets the records"));
        }
        return TetherStatistics::between_steps(run, steps).map_err(|e| Diagnostic::error(e.to_string(), given.span));
    }
    let given = args.option(&EVENTS);
    let from = given.and_then(|given| given.number(const { EVENTS.number("BEG") })).unwrap_or(run.settings.transient);
    let to = given.and_then(|given| given.number(const { EVENTS.number("END") })).unwrap_or(f64::INFINITY);
    Ok(TetherStatistics::new(run, from, to))
}

/// The number of a record, within a range.
fn whole(args: &Args, most: usize, what: &str) -> Outcome<usize> {
    let Some(word) = args.word(NUMBER) else { return Ok(1) };
    let found = word.parse::<usize>().ok().filter(|n| (1..=most).contains(n));
    let wrong = || Diagnostic::error(format!("{word} is no {what}: they are 1 to {most}"), args.place(NUMBER));
    found.ok_or_else(wrong)
}

fn tether(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let tables = tether_tables(job, args)?;
    out(job, args, tables)
}

fn tether_tables(job: &Job, args: &Args) -> Outcome<Vec<Table>> {
    let run = last_run(job, args.span)?;
    let name = args.word(NAME).unwrap_or_default();
    let Some(tether) = run.tethers.iter().find(|t| t.name.eq_ignore_ascii_case(name)) else {
        let names: Vec<&str> = run.tethers.iter().map(|t| t.name.as_str()).collect();
        let text = format!("{name} is no tether of the run: it has {}", names.join(" "));
        return Err(Diagnostic::error(text, args.place(NAME)));
    };
    let wrong = |e: SeriesError| Diagnostic::error(e.to_string(), args.span);
    let towed_alone = || {
        let text = format!("tether {name} is installed: ranges and fatigue are of towed tethers [AQWA-TETHER 3.7]");
        if tether.towed { Ok(()) } else { Err(Diagnostic::error(text, args.place(WHAT))) }
    };
    let some = || {
        let list = slack_alone(run, args.option(&SLACK), instants(run, args)?);
        Ok::<_, Box<Diagnostic>>(list)
    };
    let Some(what) = args.choice(WHAT) else { return Ok(Vec::new()) };
    Ok(match what {
        TetherReport::Motions => vec![tethered::motions(run, tether, &some()?)],
        TetherReport::Forces => vec![tethered::forces(run, tether, &some()?)],
        TetherReport::Node => {
            let node = whole(args, tether.line.nodes(), "node of the tether")?;
            vec![tethered::series(run, tether, Of::Node(node - 1))]
        }
        TetherReport::EndOf => {
            let end = whole(args, 2 * tether.line.elements().len(), "end of an element of the tether")?;
            vec![tethered::series(run, tether, Of::End(end - 1))]
        }
        TetherReport::Along => vec![table_along(run, tether, args)?],
        TetherReport::Statistics => {
            let window = window(run, args)?;
            let made = match args.word(NUMBER) {
                Some("1") => window.type_one(run, tether),
                None | Some("2") => window.type_two(run, tether),
                Some(_) => return Err(Diagnostic::error("statistics are of type 1 or 2", args.place(NUMBER))),
            };
            made.map_err(wrong)?
        }
        TetherReport::Ranges | TetherReport::Fatigue => {
            towed_alone()?;
            let [ranges, fatigue] = window(run, args)?.fatigue(run, tether, fatigue_settings(args)).map_err(wrong)?;
            vec![if what == TetherReport::Ranges { ranges } else { fatigue }]
        }
        TetherReport::Events => vec![tethered::events(run)],
    })
}

/// Curve and hours of FATIGUE.
fn fatigue_settings(args: &Args) -> FatigueSettings {
    let usual = Endurance::KILONEWTONS;
    let curve = args.option(&SN).map_or(usual, |g| Endurance {
        concentration: g.number(const { SN.number("SCF") }).unwrap_or(usual.concentration),
        intercept: g.number(const { SN.number("A") }).unwrap_or(usual.intercept),
        slope: g.number(const { SN.number("M") }).unwrap_or(usual.slope),
    });
    let hours = args.option_number(&HOURS).unwrap_or(3.0);
    FatigueSettings { duration: 1.0, curve: curve.in_unit(1000.0), peak_time: hours * 3600.0 }
}

fn table_along(run: &Tethered, tether: &TetherHistory, args: &Args) -> Outcome<Table> {
    let quantities = |at_nodes: bool| if at_nodes { tether.node_quantities() } else { tether.end_quantities() };
    let codes = || [true, false].into_iter().flat_map(|n| quantities(n).iter().map(|q| (q.code, Owner::Ours, q.code)));
    let word = args.word(NUMBER).unwrap_or("Y");
    let code = choose(word, args.place(NUMBER), "quantity of the tether", codes())?;
    let found = [true, false].into_iter().find_map(|n| Some((n, quantities(n).iter().position(|q| q.code == code)?)));
    let times = args.option(&AT).map(Given::numbers).unwrap_or_default();
    if times.len() > MAX_CURVES {
        let text = format!("{} instants: {MAX_CURVES} at most on one graph", times.len());
        return Err(Diagnostic::error(text, args.option(&AT).map_or(args.span, |g| g.span)));
    }
    let far = |place: &usize, time: f64| (run.times.get(*place).copied().unwrap_or_default() - time).abs();
    let nearest = |time: &f64| (0..run.times.len()).min_by(|a, b| far(a, *time).total_cmp(&far(b, *time)));
    let mut places: Vec<usize> = times.iter().filter_map(nearest).collect();
    if places.is_empty() {
        places.extend(run.times.len().checked_sub(1));
    }
    let made = found.and_then(|(at_nodes, index)| tethered::table_along_tether(run, tether, at_nodes, index, &places));
    made.ok_or_else(|| Diagnostic::error(format!("{word} is no quantity of the tether"), args.place(NUMBER)))
}

fn structure(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let tables = structure_tables(job, args)?;
    out(job, args, tables)
}

fn structure_tables(job: &Job, args: &Args) -> Outcome<Vec<Table>> {
    let run = last_run(job, args.span)?;
    let Some(history) = &run.structure else {
        return Err(Diagnostic::error("the run is of a towed tether, which has no structure", args.span));
    };
    let mut points = Vec::new();
    for value in args.data_after(OF_STRUCTURE) {
        let word = value.word().unwrap_or_default();
        let Some(place) = history.points.iter().position(|p| p.eq_ignore_ascii_case(word)) else {
            let text = format!("{word} is no point of {}", history.body);
            return Err(Diagnostic::error(text, value.span));
        };
        points.push(place);
    }
    Ok(match args.choice(OF_STRUCTURE).unwrap_or_default() {
        StructureReport::History => vec![tethered::structure_series(run, history)],
        StructureReport::Harmonics => {
            let made = tethered::harmonics(run, history, period(job), &instants(run, args)?);
            vec![made.map_err(|e| Diagnostic::error(e.to_string(), args.span))?]
        }
        StructureReport::Pages => instants(run, args)?
            .iter()
            .flat_map(|instant| tethered::structure(run, history, *instant, &points))
            .collect(),
    })
}

/// The period of the regular wave in force.
fn period(job: &Job) -> Option<f64> {
    let sea = job.model.environment.sea.as_ref()?;
    is_regular(sea).then_some(sea.period)
}

/// Prints tables, or opens the disposition menu over one.
fn out(job: &mut Job, args: &Args, tables: Vec<Table>) -> Outcome<Effect> {
    if let Some(given) = args.option(&DISPOSE) {
        let wanted = given.first_integer().unwrap_or(1);
        let index = usize::try_from(wanted - 1).unwrap_or(0);
        let Some(table) = tables.get(index).cloned() else {
            let text = format!("there is no table {wanted} here: there are {}", tables.len());
            return Err(Diagnostic::error(text, given.span));
        };
        let run = job.tethered.as_ref().filter(|_| !args.has(&EVENTS));
        let transient = run.map_or(0.0, |run| run.settings.transient);
        job.menus.push(Menu::Disposition(Box::new(Disposition::new(table).after_transient(transient))));
        return Ok(Effect::Done);
    }
    let head = job.page_head();
    let text = tables.iter().map(|t| page::render(t, job.units, &head)).collect::<Vec<_>>().join("\n");
    send(job, args, &text)?;
    Ok(Effect::Done)
}
