//! FATIGUE of the PRCPOST menu: damage of lines over a run and a scatter of environments.
//!
//! Source: [MOSES-REF sn_def, sn_bind, fatigue].

use crate::commands::environment::env;
use crate::commands::menu;
use crate::commands::name_filter::note_caveats;
use crate::commands::post::prcpost::{CONNECTORS, asked_behind_transient, connectors};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::{Call, Command, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::add_model_column;
use windlass_solve::results::{self, ScatterExposure};

/// FATIGUE.
pub static FATIGUE: Command = Command { spec: &SPEC, edits: false, run };

const EVENTS: OptionSpec = OptionSpec::new(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::Time), "time of the first event"),
        ValueSpec::new("END", Kind::Number(Dim::Time), "time of the last").or("the end of the run"),
    ],
    "the part of the run that is counted; its stored instants",
)
.default("all of it but TTRA_SET");
const DURATION: OptionSpec = OptionSpec::new(
    "-DURATION",
    &[ValueSpec::new("D", Kind::Number(Dim::Days), "days").positive()],
    "how long the environment of the run lasts",
)
.default("the -DURATION of its &ENV");
const ADD: OptionSpec =
    OptionSpec::new("-ADD", &[], "adds the run to those FATIGUE was given before, instead of beginning anew");
const DFF: OptionSpec = OptionSpec::new(
    "-DFF",
    &[ValueSpec::new("F", Kind::Number(Dim::None), "factor").in_range(1.0, 1000.0)],
    "design fatigue factor: life is divided by it",
)
.default("1");

static SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    opens: Opens::Menu(&menu::DISPOSITION),
    menus: &[&menu::PRCPOST],
    data: CONNECTORS,
    repeat: 1,
    options: &[EVENTS, DURATION, ADD, DFF],
    detail: "Rainflow cycles of the tension at the upper end of each segment, each by the curve of -C_SN of its class or by the last of \
             &REP_SELECT -SN, stress with -THICK_SN; Palmgren and Miner's sum. CDR is that of all environments, each for its duration, and \
             Life when they come again for ever. A scatter is run one environment after the other: TDOM and FATIGUE, then TDOM and FATIGUE \
             -ADD for each further one. Tension below the fairlead is found at the turning points of that at the fairlead. TTRA_SET of \
             &ENV -TIME is left out, other parts by -EVENTS. Governs marks the segment that MOSES goes by: that with the largest tension over its \
             break where its curve is one of tension, else that with the largest stress.",
    example: "MEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*P 0 0 0\n#WEIGHT *P 2000 10 10 10\n~W B_CAT 4 -LEN 1000 -C_SN CHAIN\n\
              ~W B_CAT 4 -LEN 3000 -DEP 500\nCONNECTOR A -ANC 0 3900 ~W *P\nCONNECTOR B -ANC 180 3900 ~W *P\nEND\n&REP_SELECT -SN WIRE\n\
              &INSTATE -LOCATE BUOY 5\n&ENV -TIME 60 1 -DURATION 10\nTDOM\nPRCPOST\nFATIGUE\nREPORT\nEND\nEND\n\
              &INSTATE -LOCATE BUOY 9\nTDOM\nPRCPOST\nFATIGUE -ADD -DURATION 2 -DFF 3\nREPORT\nEND\nEND",
    ..CommandSpec::new("FATIGUE", "damage and life of lines")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let (run, events) = asked_behind_transient(job, args)?;
    let span = args.option(&EVENTS).map_or(args.span, |g| g.span);
    let time = |event: Option<&results::RunEvent>| event.and_then(|e| e.time(&run.history)).unwrap_or(0.0);
    let record = time(events.last()) - time(events.first());
    if record <= 0.0 {
        return Err(Diagnostic::error("fatigue needs more than one instant", span));
    }
    let env = &run.model.environment;
    let of_env = env.options.iter().find(|given| given.is(&env::DURATION)).and_then(|g| g.first_number());
    let duration = args.option_number(&DURATION).or(of_env).filter(|d| *d > 0.0).ok_or_else(|| {
        Diagnostic::error("how long the environment lasts is not said", args.span).help("-DURATION, here or of &ENV")
    })?;
    let mut links = connectors(job, run, call)?;
    let mut left_out: Vec<String> = Vec::new();
    if args.data.is_empty() {
        // a line that is lost has no record of the whole run: it is counted in a part of the run in which it acts, or not at all
        let layout = &run.history.layout;
        let lost = results::lost_lines(run);
        let acts = |name: &str| {
            let link = layout.links.iter().position(|link| link.name == name);
            link.is_some_and(|link| results::acts_throughout(run, link, &events))
        };
        left_out = { lost.before }.into_iter().chain(lost.during).filter(|name| !acts(name)).collect();
        links.retain(|link| layout.links.get(*link).is_some_and(|link| !left_out.contains(&link.name)));
    }
    let lines = results::line_damages(run, &links, &job.model.fatigue, &events)
        .map_err(|e| to_diagnostic(e, &job.model, args.span, job.units))?;
    if lines.is_empty() {
        return Err(Diagnostic::error("none of the connectors is of a class with sections", args.span)
            .help("lines, rods and elastic elements have them"));
    }
    let own = ScatterExposure { environment: env.name.clone(), record, duration, lines };
    let mut runs = if args.has(&ADD) { job.scatter.clone() } else { Vec::new() };
    runs.push(own);
    let factor = args.option_number(&DFF).unwrap_or(1.0);
    let mut table = results::scatter(&runs, factor)
        .map_err(|e| Diagnostic::error(e.to_string(), args.span).help("without -ADD a scatter begins anew"))?;
    job.scatter = runs;
    if !left_out.is_empty() {
        table.note(format!(
            "{}: lost, and left out; -EVENTS BEG END chooses a part of the run in which it acts",
            left_out.join(", ")
        ));
    }
    if let Some(run) = &job.run {
        add_model_column(&mut table, |name| run.model.idealisation(name));
        note_caveats(&run.model, std::slice::from_mut(&mut table));
    }
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table))));
    Ok(Effect::Done)
}
