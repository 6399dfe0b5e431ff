//! `TETHER` of the PRCPOST menu: what a run came to along a tether.
//!
//! Source: [AQWA-TETHER 2.1 to 2.3 and 7.3 to 7.10].

mod along;
mod end_of;
mod events;
mod fatigue;
mod forces;
pub(crate) mod instants;
mod motions;
mod node;
mod records;
mod statistics;

use self::instants::{EVENTS, instants, last_run, transient_of};
use crate::commands::menu;
use crate::commands::output::disposition::{BOTH, DISPOSE, HARD, WIDE, print_or_dispose};
use crate::commands::post::report::{Report, ReportRegistry, Tables};
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_signal::SeriesError;
use windlass_solve::tethered::{TetherHistory, Tethered};
use windlass_tether::installed::RigChange;

/// TETHER.
pub static TETHER: Command = Command { spec: &SPEC, edits: false, run };

/// A report of TETHER.
pub(crate) type TetherReport = Report<fn(&TetherQuery) -> Tables>;

impl ReportRegistry for fn(&TetherQuery) -> Tables {
    const REPORTS: &'static [&'static TetherReport] = &[
        &motions::MOTIONS,
        &forces::FORCES,
        &node::NODE,
        &end_of::END_OF,
        &along::ALONG,
        &statistics::STATISTICS,
        &fatigue::RANGES,
        &fatigue::FATIGUE,
        &events::EVENTS,
    ];
    const SHARED: &'static [OptionSpec] = &[DISPOSE, HARD, BOTH, WIDE];
}

const NAME: DatumKey<str> = SPEC.word("NAME");
const WHAT: DatumKey<&'static TetherReport> = SPEC.choice("WHAT");
const NUMBER: DatumKey<str> = SPEC.word("N");

/// -SLACK.
const SLACK: OptionSpec = OptionSpec::ours(
    "-SLACK",
    &[ValueSpec::new("T", Kind::Number(Dim::Time), "time reported from each time a tether goes slack").not_negative()],
    "only instants after a tether of the run went slack",
);

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: &[
        ValueSpec::new("NAME", Kind::Name(Noun::Connector), "a tether of the run"),
        ValueSpec::choice::<&TetherReport>("WHAT", "what to report"),
        ValueSpec::new("N", Kind::Text, "number of the node or the end, quantity of ALONG, type of STATISTICS")
            .or("1, Y of ALONG, 2 of STATISTICS"),
    ],
    options: TetherReport::OPTIONS,
    detail: "Of a tether that TDOM -TETHERS has run. Quantities of ALONG are \
             Y Z RY RZ (X Y RX RY of an installed tether), the same with V or A before them for velocities and accelerations, and \
             of a towed tether SY SZ MY MZ SMAX STY STZ, of an installed one EFF WALL SX SY MX MY SHEAR MAX MIN MISES STY. \
             STATISTICS are mean, twice the deviation, means of the highest third of the maxima and of the lowest of the minima, three largest peaks. \
             Nodes and elements count from the anchor or the trailing end.",
    example: EXAMPLE,
    ..CommandSpec::new("TETHER", "results of a tether")
};

const EXAMPLE: &str = "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*E -100 0 -0.5\n&DESCRIBE BODY TUG -IGNORE X Y Z RX RY RZ\n*V 0 0 -0.5\n#WEIGHT *V 1000 1 1 1\n\
     ~T TETHER 1.1 0.038 -LEN 100 -REFINE 4\nCONNECTOR T ~T *V *E -TOWED -V_MOORING 1 1 1 -A_MOORING 1 1 1\n\
     END\n&ENV -SEA ISSC 0 2 8 -TIME 20 0.25\nTDOM -TETHERS\nPRCPOST\nTETHER T MOTIONS -EVENTS 0 10 5\nTETHER T FORCES -EVENTS 10\n\
     TETHER T STATISTICS 2 -EVENTS 5 20\nTETHER T FATIGUE\nTETHER T ALONG MY -AT 5 10 15 -DISPOSE\nREPORT\nEND\nTETHER T NODE 3 -DISPOSE\n\
     VIEW Time Z VZ\nEND\nEND";

/// A record of TETHER as its reports see it.
pub(crate) struct TetherQuery<'a> {
    call: &'a Call<'a>,
    run: &'a Tethered,
    tether: &'a TetherHistory,
}

impl TetherQuery<'_> {
    /// Data and options of the record.
    fn args(&self) -> &Args {
        &self.call.args
    }

    /// The places of the stored instants it asks for.
    fn instants(&self) -> Outcome<Vec<usize>> {
        Ok(keep_after_slack(self.run, self.args(), instants(self.run, self.args())?))
    }

    /// What was made of a series, its error at the record.
    fn to_outcome<T>(&self, made: Result<T, SeriesError>) -> Outcome<T> {
        made.map_err(|e| Diagnostic::error(e.to_string(), self.args().span))
    }

    /// The number of the record, from 1 to `most`.
    fn number(&self, most: usize, what: &str) -> Outcome<usize> {
        let Some(word) = self.args().word(NUMBER) else { return Ok(1) };
        let found = word.parse::<usize>().ok().filter(|n| (1..=most).contains(n));
        let wrong =
            || Diagnostic::error(format!("{word} is no {what}: they are 1 to {most}"), self.args().position(NUMBER));
        found.ok_or_else(wrong)
    }
}

/// Those of them that are within a time of a tether's going slack: the listing of [AQWA-TETHER 8.2] then has all tethers.
fn keep_after_slack(run: &Tethered, args: &Args, list: Vec<usize>) -> Vec<usize> {
    let Some(lasting) = args.option_number(&SLACK) else { return list };
    let slack = 1e-6 * run.settings.step;
    let began: Vec<f64> = run.happened.iter().filter(|e| e.change == RigChange::Slack).map(|e| e.time).collect();
    let near = |position: &usize| {
        let time = run.times.get(*position).copied().unwrap_or_default();
        began.iter().any(|from| time >= from - slack && time <= from + lasting + slack)
    };
    list.into_iter().filter(near).collect()
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let tables = tables(job, call)?;
    let transient = transient_of(job, args);
    print_or_dispose(job, args, &tables, (transient, args.position(NAME)))
}

fn tables(job: &Job, call: &Call) -> Tables {
    let args = &call.args;
    let run = last_run(job, args.span)?;
    let name = args.word(NAME).unwrap_or_default();
    let Some(tether) = run.tethers.iter().find(|t| t.name.eq_ignore_ascii_case(name)) else {
        let names: Vec<&str> = run.tethers.iter().map(|t| t.name.as_str()).collect();
        let text = format!("{name} is no tether of the run: it has {}", names.join(" "));
        return Err(Diagnostic::error(text, args.position(NAME)));
    };
    let Some(chosen) = args.choice(WHAT) else { return Ok(Vec::new()) };
    chosen.check_record(args, args.data_after(WHAT).first(), "number")?;
    (chosen.tables)(&TetherQuery { call, run, tether })
}
