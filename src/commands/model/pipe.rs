//! `PIPE`: a pipe on rollers or davits.
//!
//! Source: [MOSES-REF conn_pipe].

use crate::commands::menu;
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Assembly, AssemblyKind, ClassRole, Model, PIPE, find};

/// PIPE.
pub static PIPE_COMMAND: Command = Command { spec: &SPEC, edits: true, run };

/// Most supports.
const MAX_SUPPORTS: usize = 100;
/// How far a support may be from the global X axis (m).
const MAX_SUPPORT_OFFSET_M: f64 = 1e-3;

const PIPE_TENSION: OptionSpec = OptionSpec::new(
    "-PIPE_TENSION",
    &[
        ValueSpec::new("TLOWER", Kind::Number(Dim::Force), "least tension; on davits the nominal one").positive(),
        ValueSpec::new("TUPPER", Kind::Number(Dim::Force), "largest tension of the tensioner")
            .or("of rollers only")
            .positive(),
    ],
    "limits of the tensioner, or the tension at the first davit",
);

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("~CLASS", Kind::Name(Noun::Class), "ROD class of the pipe"),
        ValueSpec::new(
            "EL",
            Kind::Name(Noun::Connector),
            "its supports, from the stern to the tensioner: all ROLLER or all DAVIT",
        ),
    ],
    repeat: 1,
    options: &[PIPE_TENSION],
    detail: "The supports are single-node connectors with their nodes above the global X axis (Y = 0) when PIPE is read, in order along it. The \
             pipe leaves beyond the first, away from the last, and lies on the bottom of &ENV -DEPTH; a vessel that lays toward -X has its first \
             roller farthest aft. There is one: &PIPE/ASSEMBLY. It starts as a catenary with the weight in water of OD, T and the options of the \
             class, above the water in air, and is then brought to rest as a ROD of the first segment of its class: it feels water, wind and \
             bottom all along, and in TDOM it is a dynamic line. It is as long as it needs to be; its elements are as long as -LEN over -REFINE, \
             or without -REFINE an eighth of a span on the supports and a quarter of sqrt(EI/H) beyond. It rolls through its rollers, which push it at \
             right angles and take nothing along it, and hangs by its davits from nodes of its own; as these lean toward what pulls them, less than \
             TLOWER is left at rest. The bottom has no friction on it at rest. The last roller is the tensioner and holds \
             the end of the pipe: laid at the mean of TLOWER and TUPPER, the end is held along X of its body while its tension stays between \
             them, is paid out or hauled in beyond them, and is held anew where it then is, as our reading. &EQUI lays the pipe anew where the vessel comes to rest; in TDOM its far \
             end stays where it was when the run began. A single roller makes a vertical riser, pulled up by TUPPER as it is laid and pinned on \
             the bottom below; X of its roller then runs down the pipe and Z along X of the body, and -Y_ROLLER 0 0 -Z_ROLLER 0 0 hold it all around. Springs of the ROLLER in X, RX, RY and RZ do nothing to it. &STATUS ASSEMBLIES reports what it exerts on its supports; \
             &STATUS ROD, ROD_MODES and ROD of PRCPOST what is along it, by its name or &PIPE.",
    example: "&DIMEN -DIMEN METERS K-NTS\n&ENV -DEPTH 50\nMEDIT\n*R1 40 0 2\n*R2 30 0 3.2\n*R3 20 0 4\n~ROLL ROLLER COMPRESSION Z 5000\n\
              ~PIPE ROD 323.9 15.9 -LEN 12\nCONNECTOR R1 ~ROLL *R1\nCONNECTOR R2 ~ROLL *R2\nCONNECTOR R3 ~ROLL *R3\n\
              PIPE ~PIPE R1 R2 R3 -PIPE_TENSION 180 220\nEND\n&STATUS ASSEMBLIES",
    ..CommandSpec::new("PIPE", "a pipe laid over rollers or davits")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    if matches!(job.menu(), Menu::Inmodel) {
        return Err(Diagnostic::error("PIPE is given in MEDIT, when its connectors are made", call.args.span));
    }
    build(&mut job.model, &call.args)?;
    Ok(Effect::Done)
}

fn build(model: &mut Model, args: &Args) -> Outcome<()> {
    const CLASS: DatumKey<str> = SPEC.word("~CLASS");
    if let Some(old) = model.assemblies.get(PIPE) {
        return Err(Diagnostic::error("there is a pipe already", args.span)
            .other(old.span, "defined here")
            .help(format!("DELETE {PIPE} takes it away")));
    }
    let class = find(&model.classes, args.word(CLASS).unwrap_or_default(), "class", args.position(CLASS))?;
    if class.object.as_pipe().is_none() {
        let text = format!("{} is of class type {}, and a pipe is a ROD", class.name, class.object.kind());
        return Err(Diagnostic::error(text, args.position(CLASS)));
    }
    if let Some(extra) = args.data_after(CLASS).get(MAX_SUPPORTS) {
        return Err(Diagnostic::error(format!("a pipe has at most {MAX_SUPPORTS} supports"), extra.span));
    }
    let (mut supports, mut positions): (Vec<String>, Vec<f64>) = (Vec::new(), Vec::new());
    let mut first: Option<(&str, ClassRole)> = None;
    for value in args.data_after(CLASS) {
        let span = value.span;
        let connector = find(&model.connectors, value.word().unwrap_or_default(), "connector", span)?;
        let class = model.classes.get(&Model::key(&connector.class)).map(|c| &c.object);
        let (kind, role) = class.map_or(("", ClassRole::Connector), |c| (c.kind(), c.role()));
        if !matches!(role, ClassRole::PipeRoller | ClassRole::PipeDavit) {
            let text =
                format!("{} is of class type {kind}, and a pipe lies on ROLLERs or hangs from DAVITs", connector.name);
            return Err(Diagnostic::error(text, span));
        }
        if let Some((first, _)) = first.filter(|(_, before)| *before != role) {
            let text = format!("{} is a {kind} and those before it are {first}s: they are not mixed", connector.name);
            return Err(Diagnostic::error(text, span));
        }
        first = Some((kind, role));
        if supports.contains(&connector.name) {
            return Err(Diagnostic::error(format!("{} is given twice", connector.name), span));
        }
        let [x, y, _] = model.end(connector, 0).unwrap_or_default();
        if y.abs() > MAX_SUPPORT_OFFSET_M {
            let text = format!("{} is not on the global X axis", connector.name);
            return Err(Diagnostic::error(text, span).help("a pipe is laid along X with Y = 0"));
        }
        let apart: Vec<f64> = positions.iter().copied().chain([x]).collect();
        let steps: Vec<f64> =
            apart.windows(2).map(|w| w.iter().rev().copied().reduce(|b, a| b - a).unwrap_or(0.0)).collect();
        if steps.iter().any(|s| *s == 0.0 || (s > &0.0) != (steps.first() > Some(&0.0))) {
            let text = format!("{} is out of order along X: from the first support to the tensioner", connector.name);
            return Err(Diagnostic::error(text, span));
        }
        supports.push(connector.name.clone());
        positions.push(x);
    }
    let role = first.map_or(ClassRole::Connector, |(_, role)| role);
    if supports.len() < 2 && role == ClassRole::PipeDavit {
        let text = "a pipe hangs from two davits or more";
        return Err(Diagnostic::error(text, args.position(const { SPEC.word("EL") }))
            .help("a single roller makes a vertical riser of it"));
    }
    let Some(given) = args.option(&PIPE_TENSION) else {
        return Err(Diagnostic::error("PIPE lacks -PIPE_TENSION", args.span).help("form: -PIPE_TENSION TLOWER TUPPER"));
    };
    let [lower, upper] = const { PIPE_TENSION.numbers(["TLOWER", "TUPPER"]) }.map(|key| given.number(key));
    let lower = lower.unwrap_or(0.0);
    let upper = match (role, upper) {
        (ClassRole::PipeRoller, None) => {
            return Err(Diagnostic::error("the tensioner of rollers needs TUPPER of -PIPE_TENSION", given.span));
        }
        (ClassRole::PipeRoller, Some(upper)) if upper < lower => {
            return Err(Diagnostic::error("TUPPER of -PIPE_TENSION is less than TLOWER", given.span));
        }
        (ClassRole::PipeRoller, upper) => upper,
        _ => None,
    };
    let kind = AssemblyKind::Pipe { class: class.name.clone(), supports, tension: (lower, upper) };
    model.assemblies.insert(PIPE.to_string(), Assembly { name: PIPE.to_string(), kind, span: args.span });
    Ok(())
}
