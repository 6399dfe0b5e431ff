//! `ROD` of the PRCPOST menu: what a run came to along a dynamic line.

use crate::commands::chosen::raise;
use crate::commands::menu;
use crate::commands::output::disposition::{BOTH, HARD, send};
use crate::commands::post::prcpost::{asked_behind_transient, last_run, run_and_events, transient_of};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use crate::report::page;
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_signal::line::fatigue::{MAX_CIRCUMFERENCE_POINTS, Round};
use windlass_signal::line::lrfd::{LrfdFactors, SafetyClass};
use windlass_signal::line::working_stress::DesignCase;
use windlass_solve::results::along::{self, Code, LineResults, Where};
use windlass_solve::results::{self, EventWindow, Magnitude, RunEvent};

/// ROD.
pub static ROD: Command = Command { spec: &SPEC, edits: false, run };

choices! {
    /// What ROD reports.
    #[derive(Default)]
    enum Report {
        /// The least, mean and most of each node.
        #[default]
        Envelope = "ENVELOPE",
        /// The line at instants.
        At = "AT",
        /// Nodes over time.
        Node = "NODE",
        /// Touchdown over time.
        Touchdown = "TOUCHDOWN",
        /// Forces of a pipe on its supports.
        Supports = "SUPPORTS",
        /// Fatigue along the line.
        Fatigue = "FATIGUE",
        /// Use along the line.
        Check = "CHECK",
    }
}

const NAME: DatumKey<str> = SPEC.word("NAME");
const WHAT: DatumKey<Report> = SPEC.choice("WHAT");
choices! {
    /// What CHECK checks tubes by.
    #[derive(Default)]
    enum CheckCode {
        /// DNV-ST-F201.
        #[default]
        F201 = "F201",
        /// API RP 2RD.
        Api2rd = "2RD",
        /// Tension over breaking tension.
        Break = "BREAK",
    }
}

/// Most places reported side by side.
const MAX_PLACES: usize = 100;

const fn ours(name: &'static str, values: &'static [ValueSpec], help: &'static str) -> OptionSpec {
    OptionSpec::new(name, values, help).owner(Owner::Ours)
}
const fn plain(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::None), help)
}

const EVENTS: OptionSpec = ours(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::Time), "time of the first instant"),
        ValueSpec::new("END", Kind::Number(Dim::Time), "time of the last").or("the end of the run"),
        ValueSpec::new("INC", Kind::Number(Dim::Time), "time from one to the next; 0: the stored instants")
            .or("the stored instants")
            .not_negative(),
    ],
    "the instants that are reported or counted",
)
.default("all stored instants; ENVELOPE, FATIGUE and CHECK leave out those before TTRA_SET");
const ARC: OptionSpec = ours(
    "-ARC",
    &[ValueSpec::new("S", Kind::Number(Dim::Length), "unstretched distance from the first end").not_negative()],
    "places of NODE, beside its nodes",
)
.repeating(1);
const CODE: OptionSpec = ours(
    "-CODE",
    &[ValueSpec::choice::<CheckCode>("C", "F201: DNV-ST-F201, 2RD: API RP 2RD, BREAK: tension over break")],
    "what CHECK checks tubes by; other sections go by tension over break",
)
.default("F201");
const SAFETY_OPTION: OptionSpec =
    ours("-SAFETY", &[ValueSpec::choice::<SafetyClass>("C", "safety class")], "safety class of F201").default("NORMAL");
const FACTORS: OptionSpec = ours(
    "-FACTORS",
    &[
        plain("GF", "gamma_F, on what acts at rest").positive(),
        plain("GE", "gamma_E, on what the environment adds").or("1.3").positive(),
        plain("GM", "gamma_m, on resistance").or("1.15").positive(),
    ],
    "factors of F201; a load that relieves takes the inverse",
)
.default("1.1 1.3 1.15");
const PIPE: OptionSpec = ours(
    "-PIPE",
    &[
        plain("F0", "ovality, at least 0.005").in_range(0.0, 0.1),
        plain("AFAB", "fabrication factor: 1 seamless, 0.925 UO, 0.85 UOE").or("1").in_range(0.1, 1.0),
    ],
    "how round the tubes of F201 are and how they were made",
)
.default("0.005 1");
const CASE: OptionSpec =
    ours("-CASE", &[ValueSpec::choice::<DesignCase>("C", "design case")], "design case of 2RD: 1, 1.2 or 1.5")
        .default("OPERATING");
const CORROSION: OptionSpec = ours(
    "-CORROSION",
    &[ValueSpec::new("T", Kind::Number(Dim::Section), "of the wall").not_negative()],
    "what CHECK takes from the walls",
)
.default("0");
const POINTS: OptionSpec = ours(
    "-POINTS",
    &[ValueSpec::new("N", Kind::Integer, "points").in_range(1.0, MAX_CIRCUMFERENCE_POINTS as f64)],
    "points round a tube at which FATIGUE looks",
)
.default("8");
const SCF: OptionSpec =
    ours("-SCF", &[plain("F", "factor on stress").positive()], "stress concentration of tubes in FATIGUE").default("1");
const DFF: OptionSpec =
    ours("-DFF", &[plain("F", "factor").in_range(1.0, 1000.0)], "design fatigue factor: life is divided by it")
        .default("1");
const DISPOSE: OptionSpec = ours(
    "-DISPOSE",
    &[ValueSpec::new("N", Kind::Integer, "which of its tables").or("1").in_range(1.0, 1e6)],
    "opens the disposition menu over a table instead of printing",
);

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::Line), "a line of the run; &PIPE that of a pipe assembly"),
        ValueSpec::choice::<Report>("WHAT", "what to report").or("ENVELOPE"),
        plain("N", "times of AT (s), numbers of NODE").or("the last instant; node 1"),
    ],
    repeat: 1,
    options: &[EVENTS, ARC, CODE, SAFETY_OPTION, FACTORS, PIPE, CASE, CORROSION, POINTS, SCF, DFF, DISPOSE, HARD, BOTH],
    detail: "Of a ROD, or a line that &CONNECTOR -DYNAMICS makes dynamic, in the last TDOM. Nodes count from 1 at the first end, those that \
             TDOM -ALONG has kept. ENVELOPE has for each node the least, mean and most of the run; of a run with -STATISTICS it alone is told. AT is \
             the line at instants with its forces, NODE its nodes over time, with -ARC any place. TOUCHDOWN is the first node on the bottom and where \
             between it and the one before the line comes down. SUPPORTS has the forces of a pipe on each of its rollers or davits. FATIGUE counts rainflow cycles: of a tube with a curve of stress, by the stress at \
             -POINTS round it, else of tension; the curve is that of -C_SN of the class or the last of &REP_SELECT -SN. CHECK has the largest use of \
             each node and when. Its F201 is combined loading of DNV-ST-F201 (of 2018, as others publish it), ultimate limit state: the \
             first stored instant is functional load, of a node that a winch made later what was then at its distance from the first end; with more \
             pressure outside the root of the criterion is told. Where two segments meet both are judged, and the one that comes off worse is told. \
             Pressure outside is that of the waves at the depth. M1 and M2 are the parts of the moment about two directions across the line.",
    example: EXAMPLE,
    ..CommandSpec::new("ROD", "results along a dynamic line")
};

const EXAMPLE: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 -5\n#WEIGHT *T 1000 5 5 5\n*E 150 0 -100\n\
     ~R ROD 300 20 -LEN 185 -REFINE 12 -FYIELD 450 -C_SN DNV_D_FREE\nCONNECTOR A ~R *T *E\nEND\n&ENV -DEPTH 100 -SEA REGULAR 180 4 9 -TIME 10 0.5\nTDOM\nPRCPOST\n\
     ROD A\nROD A AT 5 10\nROD A NODE 1 3 -ARC 50 -DISPOSE\nVIEW Time Tension\nEND\nROD A TOUCHDOWN -EVENTS 5 10\nROD A FATIGUE -DFF 3\n\
     ROD A CHECK -SAFETY HIGH\nROD A CHECK -CODE 2RD -CASE EXTREME\nEND";

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let tables = tables(job, args)?;
    if let Some(given) = args.option(&DISPOSE) {
        let wanted = given.first_integer().unwrap_or(1);
        let index = usize::try_from(wanted - 1).unwrap_or(0);
        let Some(table) = tables.get(index).cloned() else {
            let text = format!("there is no table {wanted} here: there are {}", tables.len());
            return Err(Diagnostic::error(text, given.span));
        };
        raise(job, &table, args.place(NAME));
        job.menus.push(Menu::Disposition(Box::new(Disposition::new(table).after_transient(transient_of(job, args)))));
        return Ok(Effect::Done);
    }
    let head = job.page_head();
    let text = tables.iter().map(|t| page::render(t, job.units, &head)).collect::<Vec<_>>().join("\n");
    send(job, args, &text)?;
    tables.iter().for_each(|t| raise(job, t, args.place(NAME)));
    Ok(Effect::Done)
}

fn tables(job: &Job, args: &Args) -> Outcome<Vec<Table>> {
    let run = last_run(job, args.span)?;
    let line = LineResults::find(run, args.word(NAME).unwrap_or_default())
        .map_err(|e| e.diagnostic(args.place(NAME), job.units))?;
    let wrong = |e| to_diagnostic(e, &job.model, args.span, job.units);
    let what = args.choice(WHAT).unwrap_or_default();
    refuse_what_does_not_go(args, what)?;
    // of a run without rows its own envelope is reported
    let bare = what == Report::Envelope && run.history.is_empty() && !args.has(&EVENTS);
    let whole = || if bare { Ok(Vec::new()) } else { asked_behind_transient(job, args).map(|(_, events)| events) };
    let stored = || run_and_events(job, args).map(|(_, events)| events);
    let made = match what {
        Report::Envelope => along::envelope(&line, &whole()?),
        Report::At => return tables_at_instants(job, args, &line),
        Report::Node => {
            let events = stored()?;
            along::histories(&line, &places(args, &line)?, &events)
        }
        Report::Touchdown => along::touchdown(&line, &stored()?),
        Report::Supports => along::supports(&line, Magnitude::default(), &stored()?),
        Report::Fatigue => {
            let events = whole()?;
            let points = args.option_integer(&POINTS);
            let usual = Round::default();
            let round = Round {
                points: points.and_then(|n| usize::try_from(n).ok()).unwrap_or(usual.points),
                concentration: args.option_number(&SCF).unwrap_or(usual.concentration),
            };
            let factor = args.option_number(&DFF).unwrap_or(1.0);
            along::fatigue_along(&line, &job.model.fatigue, (&round, factor), &events)
        }
        Report::Check => along::check(&line, &code(args), &whole()?),
    };
    Ok(vec![made.map_err(wrong)?])
}

/// Options that belong to another of the tables.
fn refuse_what_does_not_go(args: &Args, what: Report) -> Outcome<()> {
    const OF: [(OptionSpec, Report); 10] = [
        (ARC, Report::Node),
        (CODE, Report::Check),
        (SAFETY_OPTION, Report::Check),
        (FACTORS, Report::Check),
        (PIPE, Report::Check),
        (CASE, Report::Check),
        (CORROSION, Report::Check),
        (POINTS, Report::Fatigue),
        (SCF, Report::Fatigue),
        (DFF, Report::Fatigue),
    ];
    for (option, of) in OF {
        if let Some(given) = args.option(&option).filter(|_| what != of) {
            return Err(Diagnostic::error(
                format!("{} goes with {}, not with {}", option.name, of.word(), what.word()),
                given.span,
            ));
        }
    }
    let code = chosen_code(args);
    const BY: [(OptionSpec, &[CheckCode]); 5] = [
        (SAFETY_OPTION, &[CheckCode::F201]),
        (FACTORS, &[CheckCode::F201]),
        (PIPE, &[CheckCode::F201]),
        (CASE, &[CheckCode::Api2rd]),
        (CORROSION, &[CheckCode::F201, CheckCode::Api2rd]),
    ];
    for (option, codes) in BY {
        if let Some(given) = args.option(&option).filter(|_| !codes.contains(&code)) {
            let codes: Vec<&str> = codes.iter().map(|code| code.word()).collect();
            let text = format!("{} goes with -CODE {}, not with {}", option.name, codes.join(" and "), code.word());
            return Err(Diagnostic::error(text, given.span));
        }
    }
    if let (Some(surplus), false) = (args.data_after(WHAT).first(), matches!(what, Report::At | Report::Node)) {
        return Err(Diagnostic::error(format!("{} takes no numbers", what.word()), surplus.span));
    }
    match args.option(&EVENTS) {
        Some(given) if what == Report::At => {
            Err(Diagnostic::error("AT names its instants itself: -EVENTS does not go with it", given.span))
        }
        _ => Ok(()),
    }
}

/// The line at instants.
fn tables_at_instants(job: &Job, args: &Args, line: &LineResults) -> Outcome<Vec<Table>> {
    let history = &last_run(job, args.span)?.history;
    let times: Vec<(f64, Span)> = args.data_after(WHAT).iter().filter_map(|v| Some((v.number()?, v.span))).collect();
    let stored = history.times();
    let one = |begin: f64, span: Span| -> Outcome<RunEvent> {
        if let (Some(first), Some(last)) = (stored.first(), stored.last())
            && !(*first - 1e-9..=last * (1.0 + 1e-9)).contains(&begin)
        {
            let text = format!("the run has no instant at {begin} s: it is from {first} s to {last} s");
            return Err(Diagnostic::error(text, span));
        }
        // an increment, so that a time between two stored ones is one, too
        let window = EventWindow { begin, end: Some(begin), increment: Some(1.0) };
        let found = results::events(history, Some(&window)).map_err(|e| e.diagnostic(span, job.units))?;
        found.first().copied().ok_or_else(|| Diagnostic::error("the run has no such instant", span))
    };
    let mut events = Vec::new();
    for (time, span) in &times {
        events.push(one(*time, *span)?);
    }
    if times.is_empty() {
        let all = results::events(history, None).map_err(|e| e.diagnostic(args.span, job.units))?;
        events.extend(all.last().copied());
    }
    let made = events.iter().map(|event| along::shape(line, event));
    made.collect::<Result<_, _>>().map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))
}

/// The places of NODE.
fn places(args: &Args, line: &LineResults) -> Outcome<Vec<Where>> {
    let mut list = Vec::new();
    for given in args.data_after(WHAT) {
        let value = given.number().unwrap_or(f64::NAN);
        if !(value >= 1.0 && value <= line.nodes() as f64 && value.fract() == 0.0) {
            let text = format!("{value} is no node of {}: they are 1 to {}", line.name, line.nodes());
            return Err(Diagnostic::error(text, given.span));
        }
        list.push(Where::Node(value as usize));
    }
    list.extend(args.option(&ARC).map(Given::numbers).unwrap_or_default().into_iter().map(Where::Arc));
    if list.is_empty() {
        list.push(Where::Node(1));
    }
    if list.len() > MAX_PLACES {
        let text = format!("{} places: {MAX_PLACES} at most stand side by side", list.len());
        return Err(Diagnostic::error(text, args.span));
    }
    Ok(list)
}

/// The code that CHECK goes by.
fn chosen_code(args: &Args) -> CheckCode {
    args.option_choice(&CODE, const { CODE.choice("C") }).unwrap_or_default()
}

/// What CHECK checks by.
fn code(args: &Args) -> Code {
    let corroded = args.option_number(&CORROSION).unwrap_or(0.0);
    let number = |option: &OptionSpec, key| args.option(option).and_then(|given| given.number(key));
    match chosen_code(args) {
        CheckCode::Api2rd => {
            let case = args.option_choice(&CASE, const { CASE.choice("C") });
            Code::WorkingStress(case.unwrap_or(DesignCase::Operating), corroded)
        }
        CheckCode::Break => Code::Break,
        CheckCode::F201 => {
            let usual = LrfdFactors::default();
            let class = args.option_choice(&SAFETY_OPTION, const { SAFETY_OPTION.choice("C") });
            let class = class.unwrap_or(SafetyClass::Normal);
            let factors = LrfdFactors {
                class,
                functional: number(&FACTORS, const { FACTORS.number("GF") }).unwrap_or(usual.functional),
                environmental: number(&FACTORS, const { FACTORS.number("GE") }).unwrap_or(usual.environmental),
                material: number(&FACTORS, const { FACTORS.number("GM") }).unwrap_or(usual.material),
                ovality: number(&PIPE, const { PIPE.number("F0") }).unwrap_or(usual.ovality),
                fabrication: number(&PIPE, const { PIPE.number("AFAB") }).unwrap_or(usual.fabrication),
            };
            Code::Lrfd(factors, corroded)
        }
    }
}
