//! What the tables of the PRCPOST menu share: options, the events of the last run, bodies and connectors by name.
//!
//! Source: [MOSES-REF ppo_conn, ppo_bodies, ppo_afor]. In MOSES the events of a run are times, its increment is one of time, and what lies between
//! two stored instants is on the straight line between them.

use crate::commands::menu;
use crate::commands::name_filter::{NameFilter, note_caveats};
use crate::commands::solve::equilibrium::to_diagnostic;
use crate::commands::{Call, Effect, Job, Menu};
use crate::report::disposition::Disposition;
use windlass_base::choice::YesNo;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::table::Table;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Value};
use windlass_language::spec::{CommandSpec, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::EntityKind;
use windlass_solve::SolveError;
use windlass_solve::results::{self, EventWindow, Magnitude, RunEvent};
use windlass_solve::time::Run;

pub(crate) const EVENTS: OptionSpec = OptionSpec::new(
    "-EVENTS",
    &[
        ValueSpec::new("BEG", Kind::Number(Dim::Time), "time of the first event"),
        ValueSpec::new("END", Kind::Number(Dim::Time), "time of the last; one after the run is its end")
            .or("the end of the run"),
        ValueSpec::new("INC", Kind::Number(Dim::Time), "time from one to the next; 0: the stored instants")
            .or("the stored instants")
            .not_negative(),
    ],
    "the events that are reported",
)
.default("all stored instants; STATISTIC, SPECTRUM, EXTREMES and their like leave out those before TTRA_SET");
choices! {
    /// An axis.
    enum Axis {
        X = "X",
        Y = "Y",
        Z = "Z",
    }
}
pub(crate) const MAG_DEFINE: OptionSpec = OptionSpec::new(
    "-MAG_DEFINE",
    &[ValueSpec::choice::<Axis>("AXIS", "X, Y or Z")],
    "magnitudes are those of the projection on these axes: one is a line, two a plane",
)
.repeating(1)
.default("X Y Z");
const NAME: ValueSpec =
    ValueSpec::new("BODY", Kind::Name(Noun::Selector), "body, pattern or selector").among(&[Noun::Body]);
pub(crate) const BODY: OptionSpec = OptionSpec::new("-BODY", &[NAME], "bodies, as the data name them").repeating(1);
pub(crate) const BODIES: &[ValueSpec] = &[NAME.or("all bodies but junctions")];
pub(crate) const CONNECTORS: &[ValueSpec] =
    &[ValueSpec::new(":C", Kind::Name(Noun::Selector), "connector, pattern or selector")
        .among(&[Noun::Connector])
        .or("all connectors")];
pub(crate) const LOCAL: OptionSpec = OptionSpec::new(
    "-LOCAL",
    &[ValueSpec::choice::<YesNo>("YES/NO", "NO is as without the option").or("YES")],
    "velocities, accelerations and displacements along the axes of the body",
)
.default("along the global axes");

const EXAMPLE: &str = "MEDIT\n&DESCRIBE BODY BUOY -IGNORE Z RX RY RZ\n*P 0 0 0\n*Q 0 10 5\n#WEIGHT *P 2000 10 10 10\n~W B_CAT 4 -LEN 4000 -DEP 500\n\
                       CONNECTOR A -ANC 0 3900 ~W *P\nCONNECTOR B -ANC 180 3900 ~W *P\n&DESCRIBE INTEREST *P\n&DESCRIBE DMARK MARK *P *Q\n\
                       &DESCRIBE SENSOR PULL -SIGNAL C_FORCE A\nEND\n\
                       &INSTATE -LOCATE BUOY 5\n&ENV -TIME 4 1\nTDOM\nPRCPOST\n\
                       TRAJECTORY BUOY -CG -LOCAL\nREPORT LOCATION\nEND\nPOINTS *P -EVENTS 0 9000 2\nREPORT\nEND\n\
                       CONFORCE A -MAG_DEFINE X Y\nREPORT\nEND\nCF_MAGNITUDE -EVENTS 1 3 0.5\nREPORT\nEND\n\
                       TOT_CFORCE -BODY BUOY\nVIEW Time FX\nEND\nC_LENGTH A\nREPORT\nEND\nBODY_FORCE BUOY -EVENTS 4\n\
                       REPORT INERTIA TOTAL\nEND\nELMFORCE A B\nREPORT\nEND\nLDGFORCE BUOY\nREPORT\nEND\nREL_MOTION *P *Q\nREPORT\nEND\nP_MIN_DISTANCE *P *Q\nREPORT\nEND\n\
                       DRAFT MARK\nREPORT\nEND\nSENSOR PULL\nREPORT\nEND\nEND";

/// The spec of a table; fill in the rest with `..`.
pub(crate) const fn spec(name: &'static str, data: &'static [ValueSpec], help: &'static str) -> CommandSpec {
    CommandSpec {
        opens: Opens::Menu(&menu::DISPOSITION),
        menus: const { &[&menu::PRCPOST] },
        data,
        repeat: 1,
        example: EXAMPLE,
        ..CommandSpec::new(name, help)
    }
}

/// The last run.
///
/// # Errors
/// There is none.
pub(crate) fn last_run(job: &Job, span: Span) -> Outcome<&Run> {
    job.run.as_ref().ok_or_else(|| job.lacks_results("there is no run yet", &["TDOM"], "TDOM makes one", span))
}

/// The run a record is about, and its events.
pub(crate) fn run_and_events<'a>(job: &'a Job, args: &Args) -> Outcome<(&'a Run, Vec<RunEvent>)> {
    let run = last_run(job, args.span)?;
    let given = args.option(&EVENTS);
    let window = given.and_then(|g| {
        let [begin, end] = const { EVENTS.numbers(["BEG", "END"]) }.map(|key| g.number(key));
        let increment = g.number_if_declared(const { EVENTS.number("INC") });
        Some(EventWindow { begin: begin?, end, increment })
    });
    let span = given.map_or(args.span, |g| g.span);
    let events = results::events(&run.history, window.as_ref()).map_err(|e| e.diagnostic(span, job.units))?;
    Ok((run, events))
}

/// The same for what sums up a run: without -EVENTS the instants behind its transient.
pub(crate) fn asked_behind_transient<'a>(job: &'a Job, args: &Args) -> Outcome<(&'a Run, Vec<RunEvent>)> {
    let transient = transient_of(job, args);
    let Some(transient) = transient else { return run_and_events(job, args) };
    let run = last_run(job, args.span)?;
    let window = EventWindow { begin: transient, end: None, increment: None };
    let found = results::events(&run.history, Some(&window)).map_err(|_| {
        let text = format!(
            "the run has no instant from {transient} s on; what is before is left out as its transient, TTRA_SET"
        );
        Diagnostic::error(text, args.span).help("-EVENTS takes a part of the run")
    })?;
    Ok((run, found))
}

/// The time before which statistics of a result leave the last run out (s): none where it has no transient, or -EVENTS chooses instants.
pub(crate) fn transient_of(job: &Job, args: &Args) -> Option<f64> {
    let run = job.run.as_ref().filter(|_| !args.has(&EVENTS));
    run.filter(|run| run.settings.transient > 0.0).map(Run::statistics_start)
}

/// A record that asks for a table of the last run.
pub(crate) struct PostQuery<'a> {
    /// The job.
    pub job: &'a Job,
    /// The record.
    pub call: &'a Call<'a>,
    /// The last run.
    pub run: &'a Run,
}

impl PostQuery<'_> {
    /// Data and options of the record.
    pub fn args(&self) -> &Args {
        &self.call.args
    }

    /// The place of the record.
    pub fn span(&self) -> Span {
        self.call.args.span
    }

    /// The events it asks for: those of `-EVENTS`, or all stored instants.
    ///
    /// # Errors
    /// No run, or an event outside of it.
    pub fn events(&self) -> Outcome<Vec<RunEvent>> {
        Ok(run_and_events(self.job, self.args())?.1)
    }

    /// What magnitudes are of.
    pub fn magnitude(&self) -> Magnitude {
        let Some(given) = self.args().option(&MAG_DEFINE) else { return Magnitude::default() };
        let named =
            |axis: Axis| given.choices::<Axis>(const { MAG_DEFINE.choice("AXIS") }).any(|chosen| chosen == axis);
        Magnitude([Axis::X, Axis::Y, Axis::Z].map(named))
    }

    /// Whether it asks for the axes of the body.
    pub fn is_local(&self) -> bool {
        self.args().switch(&LOCAL, false)
    }

    /// The bodies of the run that the record chooses, by data and -BODY.
    ///
    /// # Errors
    /// A name that is no body of the run.
    pub fn bodies(&self) -> Outcome<Vec<usize>> {
        bodies(self.job, self.run, self.args())
    }

    /// The connectors of the run that the record chooses.
    ///
    /// # Errors
    /// A name that is no connector of the run.
    pub fn connectors(&self) -> Outcome<Vec<usize>> {
        connectors(self.job, self.run, self.call)
    }

    /// What an engine made, its error at the record.
    ///
    /// # Errors
    /// The engine's error, with the span of the record.
    pub fn to_outcome<T>(&self, made: Result<T, SolveError>) -> Outcome<T> {
        made.map_err(|e| to_diagnostic(e, &self.job.model, self.span(), self.job.units))
    }
}

/// Opens the disposition menu over a table of the last run.
///
/// # Errors
/// No run, and what `build` says.
pub(crate) fn show(job: &mut Job, call: &Call, build: fn(&PostQuery) -> Outcome<Table>) -> Outcome<Effect> {
    let run = last_run(job, call.args.span)?;
    let mut table = build(&PostQuery { job, call, run })?;
    note_caveats(&run.model, std::slice::from_mut(&mut table));
    let transient = transient_of(job, &call.args);
    job.menus.push(Menu::Disposition(Box::new(Disposition::new(table).after_transient(transient))));
    Ok(Effect::Done)
}

/// The places among some names of those that a record chooses.
fn positions<'n>(chosen: &NameFilter, names: impl Iterator<Item = &'n str>) -> Vec<usize> {
    names.enumerate().filter(|(_, name)| chosen.matches(name)).map(|(position, _)| position).collect()
}

/// The bodies of a run that a record chooses, by data and -BODY.
fn bodies(job: &Job, run: &Run, args: &Args) -> Outcome<Vec<usize>> {
    let given: Vec<&Value> =
        args.data.iter().chain(args.option(&BODY).map_or(&[][..], |g| g.values.as_slice())).collect();
    let chosen = NameFilter::new(given, &job.model);
    let names = run.history.layout.bodies.iter();
    let mut list = positions(&chosen, names.clone().map(|(name, _)| name.as_str()));
    chosen.check_used("the bodies of the run", &[EntityKind::Body])?;
    if chosen.chooses_all() {
        // junctions are reported only by name: they are many
        let junction = |body: &usize| {
            let key = run.history.layout.bodies.get(*body).map(|(_, key)| key);
            key.and_then(|key| run.model.bodies.get(key)).is_some_and(|b| b.junction.is_some())
        };
        list.retain(|body| !junction(body));
    }
    if list.is_empty() {
        return Err(Diagnostic::error("the run has no body to report", args.span));
    }
    Ok(list)
}

/// The connectors of a run that a record chooses.
pub(crate) fn connectors(job: &Job, run: &Run, call: &Call) -> Outcome<Vec<usize>> {
    let chosen = NameFilter::new(&call.args.data, &job.model);
    let list = positions(&chosen, run.history.layout.links.iter().map(|l| l.name.as_str()));
    chosen.check_used("the connectors of the run", &[EntityKind::Connector, EntityKind::Assembly])?;
    if list.is_empty() {
        return Err(Diagnostic::error("no connector acts in the run", call.args.span));
    }
    Ok(list)
}
