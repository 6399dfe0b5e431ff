//! `ASSEMBLY T-H_DEFINITION`: slings that meet in a hook below the tip of a boom.
//!
//! Source: [MOSES-REF conn_sling].

use crate::commands::menu;
use crate::commands::model::junction;
use crate::commands::model::rigging::{self, Rigging};
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Assembly, AssemblyKind, Body, ClassRole, Connector, Model, find};

/// ASSEMBLY.
pub static ASSEMBLY: Command = Command { spec: &SPEC, edits: true, run };

/// Most slings of a hook [MOSES-REF conn_sling].
const MAX_SLINGS: usize = 4;

const INITIAL: OptionSpec =
    OptionSpec::new("-INITIAL", &[], "moves the body under the boom; of a later set, takes the sag out of its lines");
const ORIENT: OptionSpec = OptionSpec::new("-ORIENT", &[], "gives the body a system by the order of its slings");
const VERTICAL: OptionSpec = OptionSpec::new("-VERTICAL", &[], "with -INITIAL: turns the body so that it hangs");
const DEACTIVATE: OptionSpec = OptionSpec::new("-DEACTIVATE", &[], "the sets defined before no longer act");

choices! {
    /// Types of assemblies.
    enum AssemblyForm {
        TipHook = "T-H_DEFINITION",
        LaunchLeg = "LLEG",
        Control = "CONTROL",
    }
}

const NAME: DatumKey<str> = SPEC.word("NAME");
const BOOM: DatumKey<str> = SPEC.word("BHE");

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::choice::<AssemblyForm>("TYPE", "a tip-hook set"),
        ValueSpec::new("NAME", Kind::Name(Noun::New), "its name, and that of the hook"),
        ValueSpec::new("BHE", Kind::Name(Noun::Connector), "SLING from the tip of the boom to the hook"),
        ValueSpec::new("EL", Kind::Name(Noun::Connector), "SLING from the hook to the body; up to four"),
    ],
    repeat: 1,
    options: &[INITIAL, ORIENT, VERTICAL, DEACTIVATE],
    detail: "All connectors are of class type SLING, of a single node, and defined before; the nodes of the ELs are on one body, that of BHE \
             on another or on ground. The hook is a point without weight with three degrees of freedom that &EQUI solves with the bodies; it makes \
             the point *NAME, the second end of every line. &STATUS ASSEMBLIES reports where it is and what its lines bear; &CONNECTOR changes \
             their -LENGTH and activity; DELETE NAME takes the set apart. \
             -INITIAL of the first set: the hook is put the length of BHE straight below the boom, and the body so that the hook is at \
             the highest place above it that stretches no sling; its attitude stays. With four slings, or unlike ones, those that are longer \
             than need be are slack there. -INITIAL of a later set: the body stays, the hook is put as near to the boom as its slings let it, \
             those that are slack there are shortened until they are straight, and BHE gets the length that is left. Without -INITIAL only \
             the hook is placed so, where the solution begins. Where the sources are silent we read: -VERTICAL turns the body by the \
             least rotation that brings its center of gravity straight below the hook, as it hangs; -ORIENT puts the origin of the body into \
             the midpoint between the middles of nodes 1, 2 and 3, 4 (of three slings, between the middle of 1, 2 and node 3), x toward the \
             middle of 1, 2, y in the plane of the nodes toward the side of node 1, z normal to it; it asks for three slings, and for a \
             body with no other connector yet. Parts, points and weights stay where they are.",
    example: "&DIMEN -DIMEN METERS K-NTS\nMEDIT\n*BOOM 0 0 60\n&DESCRIBE BODY DECK\n*CG 0 0 0\n*S1 8 6 1\n*S2 -8 6 1\n*S3 -8 -6 1\n*S4 8 -6 1\n\
              #WEIGHT *CG 2000 4 5 6\n~FALL SLING 200 -LEN 10\n~SLING SLING 100 -LEN 20\nCONNECTOR FALL ~FALL *BOOM\nCONNECTOR L1 ~SLING *S1\n\
              CONNECTOR L2 ~SLING *S2\nCONNECTOR L3 ~SLING *S3\nCONNECTOR L4 ~SLING *S4\n\
              ASSEMBLY T-H_DEFINITION HOOK FALL L1 L2 L3 L4 -INITIAL\nEND\n&EQUI -IGNORE DECK RZ\n&STATUS ASSEMBLIES",
    ..CommandSpec::new("ASSEMBLY", "slings that meet in a hook below a boom")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    if matches!(job.menu(), Menu::Inmodel) {
        job.deferred_assemblies.push(call.args.clone());
        return Ok(Effect::Done);
    }
    build_assembly(job, &call.args)?;
    Ok(Effect::Done)
}

/// Makes an assembly of a record whose connectors are all defined.
///
/// # Errors
/// Connectors that are unknown, of another class type, given twice or in an assembly already; nodes on unlike bodies;
/// more than four slings; slings too short to meet; a name that is taken.
pub fn build_assembly(job: &mut Job, args: &Args) -> Outcome<()> {
    let model = &job.model;
    let name = args.word(NAME).unwrap_or_default().to_string();
    junction::free(model, &name, "assembly", args.place(NAME))?;
    if let Some(extra) = args.data_after(BOOM).get(MAX_SLINGS) {
        return Err(Diagnostic::error(format!("a hook takes at most {MAX_SLINGS} slings"), extra.span));
    }
    let mut members: Vec<&Connector> = Vec::new();
    for value in args.data_after(NAME) {
        let connector = member(model, value.word().unwrap_or_default(), value.span)?;
        if members.iter().any(|c| c.name == connector.name) {
            return Err(Diagnostic::error(format!("{} is given twice", connector.name), value.span));
        }
        members.push(connector);
    }
    let [boom, slings @ ..] = members.as_slice() else { return Ok(()) };
    let body = one_body(model, boom, slings, args)?;
    if let (Some(given), false) = (args.option(&VERTICAL), args.has(&INITIAL)) {
        return Err(Diagnostic::error("-VERTICAL needs -INITIAL: it turns the body that -INITIAL moves", given.span));
    }
    let body = body.name.clone();
    let (boom, slings) = (boom.name.clone(), slings.iter().map(|c| c.name.clone()).collect::<Vec<_>>());
    if let Some(given) = args.option(&ORIENT) {
        rigging::orient(&mut job.model, &body, &slings, given.span)?;
    }
    let sets = |a: &Assembly| matches!(a.kind, AssemblyKind::TipHook { .. });
    let first = !job.model.assemblies.values().any(sets);
    let rigging = Rigging { body: &body, boom: &boom, slings: &slings, span: args.span, units: job.units };
    let hook = match (args.has(&INITIAL), first) {
        (true, true) => rigging.move_body(&mut job.model, args.has(&VERTICAL))?,
        (true, false) => {
            if let Some(given) = args.option(&VERTICAL) {
                let text = "-VERTICAL turns the body, which stays where it is for a further set";
                return Err(Diagnostic::error(text, given.span));
            }
            let (hook, said) = rigging.straighten(&mut job.model)?;
            said.into_iter().for_each(|text| job.remark(text, args.span));
            hook
        }
        (false, _) => rigging.begin(&job.model)?,
    };
    if args.has(&DEACTIVATE) {
        let model = &mut job.model;
        for member in model.assemblies.values().filter(|a| sets(a)).flat_map(Assembly::members) {
            if let Some(connector) = model.connectors.get_mut(&Model::key(member)) {
                connector.active = false;
            }
        }
    }
    let model = &mut job.model;
    junction::insert(model, &name, hook.into(), [0.0; 2], args.place(NAME));
    for member in std::iter::once(&boom).chain(&slings) {
        if let Some(connector) = model.connectors.get_mut(&Model::key(member)) {
            connector.points.push(format!("*{name}"));
        }
    }
    let kind = AssemblyKind::TipHook { boom, slings };
    model.assemblies.insert(Model::key(&name), Assembly { name: name.clone(), kind, span: args.span });
    job.note_name(&name, args.place(NAME));
    Ok(())
}

/// A connector that may be of a tip-hook set.
fn member<'a>(model: &'a Model, name: &str, span: Span) -> Outcome<&'a Connector> {
    let connector = find(&model.connectors, name, "connector", span)?;
    let class = model.classes.get(&Model::key(&connector.class)).map(|c| &c.object);
    if class.is_none_or(|c| c.role() != ClassRole::Sling) {
        let kind = class.map_or("", |c| c.kind());
        let text = format!("{} is of class type {kind}, and a tip-hook set is of SLINGs", connector.name);
        return Err(Diagnostic::error(text, span).other(connector.span, "defined here"));
    }
    if let Some(other) = model.assembly_of(name) {
        return Err(Diagnostic::error(format!("{} is of assembly {} already", connector.name, other.name), span)
            .other(other.span, "defined here")
            .help(format!("DELETE {} takes that assembly apart", other.name)));
    }
    Ok(connector)
}

/// The body of a connector's node.
fn body_of<'a>(model: &'a Model, connector: &Connector) -> Option<&'a Body> {
    let point = connector.points.first().and_then(|p| model.points.get(&Model::key(p)))?;
    model.body_of(point)
}

/// The body all slings are on.
fn one_body<'a>(model: &'a Model, boom: &Connector, slings: &[&Connector], args: &Args) -> Outcome<&'a Body> {
    let mut found: Option<&Body> = None;
    for (sling, value) in slings.iter().zip(args.data_after(BOOM)) {
        let span = value.span;
        let Some(body) = body_of(model, sling) else {
            let text = format!("{} is on no body, and a hook lifts one", sling.name);
            return Err(Diagnostic::error(text, span).other(sling.span, "defined here"));
        };
        if let Some(first) = found.filter(|first| first.name != body.name) {
            let text = format!("{} is on {}, and the slings before it on {}", sling.name, body.name, first.name);
            return Err(Diagnostic::error(text, span).label("the slings of a hook are on one body"));
        }
        found = Some(body);
    }
    let found = found.ok_or_else(|| Diagnostic::error("a hook needs a sling", args.span))?;
    if body_of(model, boom).is_some_and(|b| b.name == found.name) {
        let text = format!("{} is on {} as the slings are: a body cannot lift itself", boom.name, found.name);
        return Err(Diagnostic::error(text, args.place(BOOM)));
    }
    Ok(found)
}
