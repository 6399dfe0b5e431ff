//! `STRUCTURE` of the PRCPOST menu: what a run came to for the body that installed tethers hold.
//!
//! Source: [AQWA-TETHER 7.3 to 7.10].

mod harmonics;
mod history;
mod pages;

use crate::commands::menu;
use crate::commands::output::disposition::{BOTH, DISPOSE, HARD, WIDE, print_or_dispose};
use crate::commands::post::report::{Report, ReportRegistry, Tables};
use crate::commands::post::tether::instants::{EVENTS, instants, last_run, transient_of};
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::values::{Args, Noun};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_solve::tethered::{StructureHistory, Tethered};

/// STRUCTURE.
pub static STRUCTURE: Command = Command { spec: &SPEC, edits: false, run };

/// A report of STRUCTURE.
pub(crate) type StructureReport = Report<fn(&StructureQuery) -> Tables>;

impl ReportRegistry for fn(&StructureQuery) -> Tables {
    const REPORTS: &'static [&'static StructureReport] = &[&pages::PAGES, &history::HISTORY, &harmonics::HARMONICS];
    const SHARED: &'static [OptionSpec] = &[DISPOSE, HARD, BOTH, WIDE];
}

const WHAT: DatumKey<&'static StructureReport> = SPEC.choice("WHAT");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::PRCPOST],
    opens: Opens::WithOption(&menu::DISPOSITION, &DISPOSE),
    data: &[
        ValueSpec::choice::<&StructureReport>("WHAT", "what to report").or("PAGES"),
        ValueSpec::new("*P", Kind::Name(Noun::Point), "points of the structure whose places are reported").or("none"),
    ],
    repeat: 1,
    options: StructureReport::OPTIONS,
    detail: "Of the body that installed tethers hold, in a run of TDOM -TETHERS. Columns of HISTORY are X to RZ, VX, AX, and of forces \
             G (gravity), H (hydrostatic), D (drag), FK (Froude-Krylov), WI (wave inertia), DF (diffraction and what else acts on the \
             body), GY (gyroscopic), M (mooring), T (total) with the axis after it.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*A 0 0 -100\n&DESCRIBE BODY SPAR\n*B 0 0 -30\n*T 0 0 12\n*G 0 0 -20\n#WEIGHT *G 18000 12 12 5\n\
              &SURFACE\nTUBE HULL *B *T 10000\nEND\n~T TETHER 0.6 0.03 -LEN 69.97 -REFINE 4\nCONNECTOR T ~T *B *A -V_SPRINGS 0 0 0 -A_SPRINGS 0 0 0\n\
              END\n&ENV -DEPTH 100 -SEA STOKES 180 4 8 -STOKES 2 -TIME 16 0.1\nTDOM -TETHERS\nPRCPOST\nSTRUCTURE PAGES *T -EVENTS 0 8 4\n\
              STRUCTURE HARMONICS\nSTRUCTURE HISTORY -DISPOSE\nREPORT POSITION\nEND\nEND",
    ..CommandSpec::new("STRUCTURE", "results of the structure that tethers hold")
};

/// A record of STRUCTURE as its reports see it.
pub(crate) struct StructureQuery<'a> {
    job: &'a Job,
    call: &'a Call<'a>,
    run: &'a Tethered,
    structure: &'a StructureHistory,
}

impl StructureQuery<'_> {
    /// Data and options of the record.
    fn args(&self) -> &Args {
        &self.call.args
    }

    /// The places of the stored instants it asks for.
    fn instants(&self) -> Outcome<Vec<usize>> {
        instants(self.run, self.args())
    }
}

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let tables = tables(job, call)?;
    let transient = transient_of(job, args);
    print_or_dispose(job, args, &tables, (transient, args.position(WHAT)))
}

fn tables(job: &Job, call: &Call) -> Tables {
    let args = &call.args;
    let run = last_run(job, args.span)?;
    let Some(structure) = &run.structure else {
        return Err(Diagnostic::error("the run is of a towed tether whose vessel is no body", args.span));
    };
    let chosen = args.choice(WHAT).unwrap_or(&pages::PAGES);
    chosen.check_record(args, args.data_after(WHAT).first(), "points")?;
    (chosen.tables)(&StructureQuery { job, call, run, structure })
}
