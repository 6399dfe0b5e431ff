//! `ROD` of the PRCPOST menu: what a run came to along a dynamic line.

mod at;
mod check;
mod envelope;
mod fatigue;
mod node;
mod supports;
mod touchdown;

use crate::commands::menu;
use crate::commands::output::disposition::{BOTH, DISPOSE, HARD, WIDE, print_or_dispose};
use crate::commands::post::prcpost::{self, asked_behind_transient, last_run, run_and_events, transient_of};
use crate::commands::post::report::{Report, ReportRegistry, Tables};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::solve::summary::SolveSummary;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Outcome, Severity};
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_solve::SolveError;
use windlass_solve::results::RunEvent;
use windlass_solve::results::along::LineResults;
use windlass_solve::time::Run;

/// ROD.
pub static ROD: Command = Command { spec: &SPEC, edits: false, run };

/// A report of ROD.
pub(crate) type RodReport = Report<fn(&RodQuery) -> Tables>;

impl ReportRegistry for fn(&RodQuery) -> Tables {
    const REPORTS: &'static [&'static RodReport] = &[
        &envelope::ENVELOPE,
        &at::AT,
        &node::NODE,
        &touchdown::TOUCHDOWN,
        &supports::SUPPORTS,
        &fatigue::FATIGUE,
        &check::CHECK,
    ];
    const SHARED: &'static [OptionSpec] = &[EVENTS, DISPOSE, HARD, BOTH, WIDE];
}

const NAME: DatumKey<str> = SPEC.word("NAME");
const WHAT: DatumKey<&'static RodReport> = SPEC.choice("WHAT");

const fn plain(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::None), help)
}

const EVENTS: OptionSpec = prcpost::EVENTS
    .owner(Owner::Ours)
    .default("all stored instants; ENVELOPE, FATIGUE and CHECK leave out those before TTRA_SET");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::Line), "a line of the run; &PIPE that of a pipe assembly"),
        ValueSpec::choice::<&RodReport>("WHAT", "what to report").or("ENVELOPE"),
        plain("N", "times of AT (s), numbers of NODE").or("the last instant; node 1"),
    ],
    repeat: 1,
    options: RodReport::OPTIONS,
    detail: "Of a ROD, or a line that &CONNECTOR -DYNAMICS makes dynamic, in the last TDOM. Nodes count from 1 at the first end, those that \
             TDOM -ALONG has kept. The curve of FATIGUE is that of -C_SN of the class or the last of &REP_SELECT -SN. \
             F201 of CHECK is combined loading of DNV-ST-F201 (of 2018, as others publish it), ultimate limit state: the \
             first stored instant is functional load, of a node that a winch made later what was then at its distance from the first end; with more \
             pressure outside CHECK reports the root of the criterion. Where two segments meet both are checked, and the larger utilisation is reported. \
             Pressure outside is that of the waves at the depth. M1 and M2 are the parts of the moment about two directions across the line.",
    example: EXAMPLE,
    ..CommandSpec::new("ROD", "results along a dynamic line")
};

const EXAMPLE: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n&DESCRIBE BODY SHIP -IGNORE X Y Z RX RY RZ\n*T 0 0 -5\n#WEIGHT *T 1000 5 5 5\n*E 150 0 -100\n\
     ~R ROD 300 20 -LEN 185 -REFINE 12 -FYIELD 450 -C_SN DNV_D_FREE\nCONNECTOR A ~R *T *E\nEND\n&ENV -DEPTH 100 -SEA REGULAR 180 4 9 -TIME 10 0.5\nTDOM\nPRCPOST\n\
     ROD A\nROD A AT 5 10\nROD A NODE 1 3 -ARC 50 -DISPOSE\nVIEW Time Tension\nEND\nROD A TOUCHDOWN -EVENTS 5 10\nROD A FATIGUE -DFF 3\n\
     ROD A CHECK -SAFETY HIGH\nROD A CHECK -CODE 2RD -CASE EXTREME\nEND";

/// A record of ROD as its reports see it.
pub(crate) struct RodQuery<'a> {
    job: &'a Job,
    call: &'a Call<'a>,
    run: &'a Run,
    line: LineResults<'a>,
}

impl RodQuery<'_> {
    /// Data and options of the record.
    fn args(&self) -> &Args {
        &self.call.args
    }

    /// The events it asks for: those of -EVENTS, or all stored instants.
    fn events(&self) -> Outcome<Vec<RunEvent>> {
        Ok(run_and_events(self.job, self.args())?.1)
    }

    /// The same, without -EVENTS the instants behind the transient of the run.
    fn events_after_transient(&self) -> Outcome<Vec<RunEvent>> {
        Ok(asked_behind_transient(self.job, self.args())?.1)
    }

    /// The table of an engine, its error at the record.
    fn to_tables(&self, made: Result<Table, SolveError>) -> Tables {
        let table = made.map_err(|e| to_diagnostic(e, &self.job.model, self.args().span, self.job.units))?;
        Ok(vec![table])
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (tables, summary) = make_tables(job, call)?;
    if let Some(summary) = summary {
        let warnings = tables.iter().flat_map(|table| &table.notes).filter(|note| note.severity == Severity::Warning);
        summary.print_with(
            job,
            warnings.count(),
            "ROD NAME AT T: the line at an instant; NODE N: a node over time; CHECK, FATIGUE",
        );
    }
    let transient = transient_of(job, args);
    print_or_dispose(job, args, &tables, (transient, args.position(NAME)))
}

/// The tables that a record asks for; of ENVELOPE with a summary.
fn make_tables(job: &Job, call: &Call) -> Outcome<(Vec<Table>, Option<SolveSummary>)> {
    let args = &call.args;
    let run = last_run(job, args.span)?;
    let line = LineResults::find(run, args.word(NAME).unwrap_or_default())
        .map_err(|e| e.diagnostic(args.position(NAME), job.units))?;
    let chosen = args.choice(WHAT).unwrap_or(&envelope::ENVELOPE);
    chosen.check_record(args, args.data_after(WHAT).first(), "numbers")?;
    let query = RodQuery { job, call, run, line };
    let tables = (chosen.tables)(&query)?;
    let summary = if *chosen == envelope::ENVELOPE { Some(envelope::summarise(&query)?) } else { None };
    Ok((tables, summary))
}
