//! `ASSEMBLY`: slings that meet in a hook below the tip of a boom, a line over pulleys, a line off a winch drum.
//!
//! Source: [MOSES-REF conn_sling, conn_pulley, conn_winch]; of pulleys and winches the sources give the form, and the rest is our reading.

use crate::commands::menu;
use crate::commands::model::junction;
use crate::commands::model::rigging::{self, Rigging};
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::spec::ValueKey;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given, Noun, Value};
use windlass_language::name as name_rule;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, OptionSpec, ValueSpec};
use windlass_model::{Assembly, AssemblyKind, Body, ClassRole, Connector, CurveKind, Drum, DrumControl, Model, find};

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
        Pulley = "PULLEY",
        Winch = "WINCH",
        LaunchLeg = "LLEG",
        Control = "CONTROL",
    }
}

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const WINCH: OptionSpec = OptionSpec::new(
    "-WINCH",
    &[
        number("WEIGHT", Dim::Force, "weight of the drum, which makes its inertia; it belongs to the body's own")
            .positive(),
        number("MAX_TORQUE", Dim::Moment, "torque of the motor").not_negative(),
        number("S_MOMENT", Dim::Moment, "torque up to which the brake holds").not_negative(),
        number("D_MOMENT", Dim::Moment, "torque of the brake while it slips").not_negative(),
        number("LENGTH", Dim::Length, "line on the drum: all that can be paid out").not_negative(),
        number("GYRADIUS", Dim::Length, "radius of gyration of the drum").positive(),
        number("RADIUS", Dim::Length, "radius at which the line leaves the drum").positive(),
    ],
    "drum of WINCH, with motor and brake",
);
const VELOCITY: OptionSpec = OptionSpec::new(
    "-VELOCITY",
    &[
        ValueSpec::new("CURVE", Kind::Name(Noun::Curve), "a curve LT_MULTIPLIER: factor over time"),
        number("MULT", Dim::Velocity, "rate of paying out that it multiplies; negative hauls in"),
    ],
    "of WINCH: the drum turns as a curve says",
);

const NAME: DatumKey<str> = SPEC.word("NAME");
const BOOM: DatumKey<str> = SPEC.word("BHE");

static SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::choice::<AssemblyForm>("TYPE", "a tip-hook set, a line over pulleys, a winch"),
        ValueSpec::new("NAME", Kind::Name(Noun::New), "its name, and that of the hook"),
        ValueSpec::new(
            "BHE",
            Kind::Name(Noun::Connector),
            "SLING from the tip of the boom to the hook; the first span of a line",
        ),
        ValueSpec::new(
            "EL",
            Kind::Name(Noun::Connector),
            "SLING from the hook to the body, up to four; further spans of a line",
        )
        .or("none of WINCH"),
    ],
    repeat: 1,
    options: &[INITIAL, ORIENT, VERTICAL, DEACTIVATE, WINCH, VELOCITY],
    detail: "PULLEY NAME EL EL ..: the ELs are the spans of one line that runs over a pulley from each to the next, where they share a point. A pulley is a point without friction, \
             size and inertia: there is one tension where two spans meet, and their first segments share one length, the sum of theirs (&CONNECTOR -LENGTH changes that of one, and the sum). \
             The ELs are of H_CAT without EXACT, straight and without weight, but the last, which may have weight: a B_CAT from the last pulley to its anchor, or an H_CAT EXACT. \
             A span that does not act lets the whole line go. WINCH NAME EL ..: the same, off a drum at the first point of the first EL; one EL is a line on a drum. -WINCH gives the drum a motor and a brake, which holds unless &CONNECTOR -L_DYNAMIC says other; \
             in TDOM it turns by I dv/dt = R (T R - M), v being the rate of paying out, I = WEIGHT/g GYRADIUS^2, R RADIUS and M the torque of motor or slipping brake. -VELOCITY turns it as a curve says. In statics it stands. \
             What is paid out is not kept behind a run. These readings are ours; MOSES gives the forms. \
             T-H_DEFINITION: all connectors are of class type SLING, of a single node, and defined before; the nodes of the ELs are on one body, that of BHE \
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
    ..CommandSpec::new("ASSEMBLY", "slings that meet in a hook, a line over pulleys, a winch")
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
/// more than four slings; slings too short to meet; spans that do not meet; a name that is taken.
pub fn build_assembly(job: &mut Job, args: &Args) -> Outcome<()> {
    let form = args.choice(const { SPEC.choice::<AssemblyForm>("TYPE") });
    let is_line = matches!(form, Some(AssemblyForm::Pulley | AssemblyForm::Winch));
    let of_line = [WINCH, VELOCITY];
    let wrong = args.options.iter().find(|given| given.is_any(&of_line) != is_line);
    if let Some(given) = wrong.or(args.option(&WINCH).filter(|_| form == Some(AssemblyForm::Pulley))) {
        let kind = form.map_or("", Choice::word);
        return Err(Diagnostic::error(format!("{} is not an option of ASSEMBLY {kind}", given.name()), given.span));
    }
    if is_line { build_line(job, args, form == Some(AssemblyForm::Winch)) } else { build_tip_hook(job, args) }
}

/// Makes a line over pulleys, or off a drum.
fn build_line(job: &mut Job, args: &Args, is_winch: bool) -> Outcome<()> {
    let model = &job.model;
    let name = args.word(NAME).unwrap_or_default().to_string();
    name_rule::check(&name, None, "assembly", args.position(NAME))?;
    model.free_name(&name, &[], args.position(NAME))?;
    let mut line: Vec<&Connector> = Vec::new();
    for value in args.data_after(NAME).iter().filter(|value| value.is_given()) {
        let connector = span(model, value.word().unwrap_or_default(), value.span)?;
        if line.iter().any(|c| c.name == connector.name) {
            return Err(Diagnostic::error(format!("{} is given twice", connector.name), value.span));
        }
        let meets = |before: &&Connector| {
            let key = |point: &String| Model::key(point);
            before.points.iter().any(|point| connector.points.iter().any(|own| key(own) == key(point)))
        };
        if let Some(before) = line.last().filter(|before| !meets(before)) {
            let text =
                format!("{} and {} share no point: a pulley is where two spans meet", before.name, connector.name);
            return Err(Diagnostic::error(text, value.span).other(connector.span, "defined here"));
        }
        line.push(connector);
    }
    if line.len() < 2 && !is_winch {
        return Err(Diagnostic::error("a line over a pulley has two spans or more", args.span)
            .help("form: ASSEMBLY PULLEY NAME EL EL .."));
    }
    let drum = if is_winch { read_drum(job, args)? } else { Drum::default() };
    let line: Vec<String> = line.into_iter().map(|c| c.name.clone()).collect();
    let first = line.first().cloned().unwrap_or_default();
    let kind = if is_winch { AssemblyKind::Winch { line, drum } } else { AssemblyKind::Pulley { line } };
    job.model.assemblies.insert(Model::key(&name), Assembly { name: name.clone(), kind, span: args.span });
    // what makes no line is refused here, not in a solve
    let made = job.model.connectors.get(&Model::key(&first)).map(|c| job.model.element(c));
    if let Some(Err(error)) = made {
        job.model.assemblies.shift_remove(&Model::key(&name));
        return Err(error.diagnostic(args.position(NAME), job.units));
    }
    job.note_name(&name, args.position(NAME));
    Ok(())
}

/// A connector that may be a span of a line.
fn span<'a>(model: &'a Model, name: &str, span: Span) -> Outcome<&'a Connector> {
    let connector = find(&model.connectors, name, "connector", span)?;
    let class = model.classes.get(&Model::key(&connector.class)).map(|c| &c.object);
    if class.is_none_or(|c| c.as_reeved().is_none()) || model.is_dynamic_line(connector) {
        let kind = if model.is_dynamic_line(connector) { "dynamic line" } else { class.map_or("", |c| c.kind()) };
        let text = format!("{} is a {kind}, which does not run over a pulley", connector.name);
        return Err(Diagnostic::error(text, span).other(connector.span, "defined here").help("H_CAT and B_CAT do"));
    }
    not_assembled(model, connector, span)?;
    Ok(connector)
}

/// Sees that a connector is of no assembly.
fn not_assembled(model: &Model, connector: &Connector, span: Span) -> Outcome<()> {
    match model.assembly_of(&connector.name) {
        Some(other) => {
            Err(Diagnostic::error(format!("{} is of assembly {} already", connector.name, other.name), span)
                .other(other.span, "defined here")
                .help(format!("DELETE {} takes that assembly apart", other.name)))
        }
        None => Ok(()),
    }
}

/// The drum of a winch.
fn read_drum(job: &Job, args: &Args) -> Outcome<Drum> {
    let mut drum = Drum { stored: f64::INFINITY, ..Drum::default() };
    if let Some(given) = args.option(&WINCH) {
        let [weight, max_torque, static_brake, dynamic_brake, stored, gyradius, radius] = given.numbers_or_zero(
            const { WINCH.numbers(["WEIGHT", "MAX_TORQUE", "S_MOMENT", "D_MOMENT", "LENGTH", "GYRADIUS", "RADIUS"]) },
        );
        let inertia = weight / job.model.defaults.gravity * gyradius * gyradius;
        let control = DrumControl::Brake;
        drum = Drum { radius, inertia, max_torque, static_brake, dynamic_brake, stored, has_machine: true, control };
    }
    if let Some(given) = args.option(&VELOCITY) {
        const CURVE: ValueKey<str> = VELOCITY.word("CURVE");
        let name = given.word(CURVE).unwrap_or_default();
        let curve = find(&job.model.curves, name, "curve", given.position(CURVE))?;
        if curve.kind != CurveKind::LoadMultiplier {
            let text = format!("curve {} is a {}, and -VELOCITY takes a LT_MULTIPLIER", curve.name, curve.kind.name());
            return Err(Diagnostic::error(text, given.position(CURVE)).other(curve.span, "defined here"));
        }
        let factor = given.number(const { VELOCITY.number("MULT") }).unwrap_or_default();
        drum.control = DrumControl::Curve { name: curve.name.clone(), factor, bound: None };
    }
    Ok(drum)
}

/// Changes what governs the drum that a name is of, or that a span of its name runs off; what is said of it.
///
/// # Errors
/// A name of neither, a drum without a motor and a brake, a curve that governs no drum.
pub fn govern_drum(model: &mut Model, name: &Value, given: &Given, units: UnitSystem) -> Outcome<String> {
    let word = name.word().unwrap_or_default();
    let assembly = model.assemblies.get(&Model::key(word)).or_else(|| model.reeving(word));
    let Some((key, drum)) = assembly.and_then(|a| match &a.kind {
        AssemblyKind::Winch { drum, .. } => Some((Model::key(&a.name), drum.clone())),
        _ => None,
    }) else {
        return Err(Diagnostic::error(format!("{word} is no winch, and no span of the line of one"), name.span)
            .help("ASSEMBLY WINCH makes one"));
    };
    let how = given.first_word().unwrap_or_default();
    let mut numbers = given.values.iter().skip(1);
    let factor = numbers.next().and_then(Value::number).unwrap_or(1.0);
    let bound = numbers.next().and_then(Value::number);
    let control = match how.to_ascii_uppercase().as_str() {
        word @ ("MOTOR" | "BRAKE") if !drum.has_machine => {
            let text = format!("the drum has no {}", word.to_ascii_lowercase());
            return Err(Diagnostic::error(text, given.span).help("-WINCH of ASSEMBLY gives it one"));
        }
        "MOTOR" => DrumControl::Motor { share: factor, bound },
        "BRAKE" => DrumControl::Brake,
        _ => {
            let curve = find(&model.curves, how, "curve", given.first_place())?;
            let factor = match curve.kind {
                CurveKind::LoadMultiplier => Dim::Velocity.to_si(factor, units),
                CurveKind::ConnectorLength => factor,
                other => {
                    let text = format!("curve {} is a {}, which governs no drum", curve.name, other.name());
                    return Err(Diagnostic::error(text, given.first_place()).help(
                        "LT_MULTIPLIER gives a rate over time as a factor, CT_LENGTH a length paid out over time",
                    ));
                }
            };
            DrumControl::Curve { name: curve.name.clone(), factor, bound }
        }
    };
    if let Some(Assembly { name, kind: AssemblyKind::Winch { drum, .. }, .. }) = model.assemblies.get_mut(&key) {
        drum.control = control;
        return Ok(format!("winch {name}: {how}"));
    }
    Ok(String::new())
}

/// Makes a tip-hook set.
fn build_tip_hook(job: &mut Job, args: &Args) -> Outcome<()> {
    let model = &job.model;
    let name = args.word(NAME).unwrap_or_default().to_string();
    junction::free(model, &name, "assembly", args.position(NAME))?;
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
    junction::insert(model, &name, hook.into(), [0.0; 2], args.position(NAME));
    for member in std::iter::once(&boom).chain(&slings) {
        if let Some(connector) = model.connectors.get_mut(&Model::key(member)) {
            connector.points.push(format!("*{name}"));
        }
    }
    let kind = AssemblyKind::TipHook { boom, slings };
    model.assemblies.insert(Model::key(&name), Assembly { name: name.clone(), kind, span: args.span });
    job.note_name(&name, args.position(NAME));
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
    not_assembled(model, connector, span)?;
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
        return Err(Diagnostic::error(text, args.position(BOOM)));
    }
    Ok(found)
}
