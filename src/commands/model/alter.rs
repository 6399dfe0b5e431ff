//! `&CONNECTOR`: what is changed of connectors that exist: whether they act, the length of their first segment, the
//! place of their anchor; given, or solved for a force at the fairlead.
//!
//! Source: [MOSES-REF conn_alter].

use crate::commands::model::assembly;
use crate::commands::{Call, Command, Effect, Job};
use crate::report::format::report;
use windlass_base::diagnostic::{Diagnostic, Outcome, Severity};
use windlass_base::geometry::unit_vector;
use windlass_base::span::Span;
use windlass_base::table::{Cell, Digits};
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given, Value};
use windlass_base::wildcard::{is_wild, matches};
use windlass_language::select::Owner;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{Anchor, ClassError, Condition, Connector, FoundLength, LineLoads, LineModel, Model, find};
use windlass_solve::pretension;

/// &CONNECTOR.
pub static ALTER: Command = Command { spec: &SPEC, edits: true, run };

/// Share of a force within which what is found must bear what was asked for.
const FORCE_TOLERANCE: f64 = 1e-6;

/// Share of a force by which the table of a class may miss it before a warning.
const TABLE_TOLERANCE: f64 = 0.01;

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const HORIZONTAL: &[ValueSpec] =
    &[number("F", Dim::Force, "horizontal force at the fairlead, present configuration").positive()];
const TENSION: &[ValueSpec] = &[number("F", Dim::Force, "tension at the fairlead, present configuration").positive()];

const LENGTH: OptionSpec = OptionSpec::new(
    "-LENGTH",
    &[number("L", Dim::Length, "its length, unstretched").positive()],
    "gives the first segment this length",
)
.many();
const L_DELTA: OptionSpec =
    OptionSpec::new("-L_DELTA", &[number("DL", Dim::Length, "added to it")], "makes the first segment longer").many();
const L_HORIZONTAL: OptionSpec =
    OptionSpec::new("-L_HORIZONTAL", HORIZONTAL, "solves the length of the first segment").many();
const L_TENSION: OptionSpec = OptionSpec::new("-L_TENSION", TENSION, "solves the length of the first segment").many();
const ANCHOR: OptionSpec = OptionSpec::new(
    "-ANCHOR",
    &[
        number("X", Dim::Length, "global X"),
        number("Y", Dim::Length, "global Y"),
        number("Z", Dim::Length, "global Z, negative below the mean water surface"),
    ],
    "puts the anchor there",
)
.many();
const A_HORIZONTAL: OptionSpec =
    OptionSpec::new("-A_HORIZONTAL", HORIZONTAL, "solves the place of the anchor along its direction").many();
const A_TENSION: OptionSpec =
    OptionSpec::new("-A_TENSION", TENSION, "solves the place of the anchor along its direction").many();
const DYNAMICS: OptionSpec = OptionSpec::new(
    "-DYNAMICS",
    &[ValueSpec::new("N", Kind::Integer, "elements of the whole line, at least one a segment; 0: none")
        .in_range(0.0, 100_000.0)],
    "makes a line of B_CAT, H_CAT or CATENARY dynamic, as a ROD is",
)
.owner(Owner::Ours)
.many();
const L_DYNAMIC: OptionSpec = OptionSpec::new(
    "-L_DYNAMIC",
    &[
        ValueSpec::new("HOW", Kind::Item, "MOTOR, BRAKE, or a curve"),
        number("MULT", Dim::None, "share of the torque of the motor, or factor of the curve").or("1"),
        number("BOUND", Dim::Length, "length of the first segments together at which the drum stops")
            .or("none")
            .positive(),
    ],
    "what governs the drum of ASSEMBLY WINCH in a run; the name is that of the assembly or of a span",
)
.many();
const ACTIVE: OptionSpec = OptionSpec::new("-ACTIVE", &[], "the connector acts").many();
const INACTIVE: OptionSpec = OptionSpec::new("-INACTIVE", &[], "the connector does not act").many();

static SPEC: CommandSpec = CommandSpec {
    data: &[
        ValueSpec::new(":SEL", Kind::Name(Noun::Selector), "connector, pattern or selector").among(&[Noun::Connector])
    ],
    repeat: 1,
    interleaved: true,
    options: &[
        LENGTH,
        L_DELTA,
        L_HORIZONTAL,
        L_TENSION,
        ANCHOR,
        A_HORIZONTAL,
        A_TENSION,
        DYNAMICS,
        L_DYNAMIC,
        ACTIVE,
        INACTIVE,
    ],
    detail: "An option acts on the names before it: those since the option before, else the same as that one's. Options act in \
             the order given; if one connector cannot be solved, or its line has no \
             configuration behind a change, the record changes nothing. -L_HORIZONTAL and -L_TENSION take the length nearest to the present one and name the others that give the force. Lengths are those of the connector: \
             its class and the other connectors of the class keep theirs. -A_HORIZONTAL and -A_TENSION keep the direction from \
             the fairlead and the depth. An anchor put at X Y Z has the depth -Z whatever -DEPANCHOR and &ENV say; under a B_CAT \
             the bottom goes with it. What solves does so exactly, also for a class with -TABLE, and \
             passes over connectors that are inactive. -L_DYNAMIC is our reading: MOTOR hauls in with MULT times its MAX_TORQUE, BRAKE holds up to S_MOMENT and slips \
             with D_MOMENT, a curve LT_MULTIPLIER pays out at MULT (a speed) times its factor over time, CT_LENGTH pays out MULT times its length. \
             -DYNAMICS is the cable dynamics of AQWA: weight, drag, added mass and bottom act all along the line, in statics and in time; \
             its forces then follow from -CD, -CA and the diameters of its class.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\n*MLA 400 50 20\n*MLB 400 -50 20\n\
              ~WIRE b_cat 4.19 EXACT -DEP 500 -LEN 4000 -BUOY 0 -WTPL .0125\n\
              CONNECTOR A -ANC 45 20 ~WIRE *MLA\nCONNECTOR B -ANC -45 20 ~WIRE *MLB\nEND\n\
              &CONNECTOR @ -A_TENSION 50 A -L_DELTA -10 B -L_HORIZONTAL 60\n&CONNECTOR B -INACTIVE\n&STATUS G_CONNECTOR",
    ..CommandSpec::new("&CONNECTOR", "changes connectors: length, anchor, activity")
};

fn run(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let mut said = Said { units: job.units, lines: Vec::new(), warnings: Vec::new() };
    for (given, names) in groups(args)? {
        let units = job.units;
        if given.is(&L_DYNAMIC) {
            for value in names {
                said.lines.push(assembly::govern_drum(&mut job.model, value, given, units)?);
            }
            continue;
        }
        let keys = select_connectors(&job.model, names).map_err(|error| match job.deferred.as_slice() {
            [] => error,
            _ => error.help("the connectors of INMODEL are made at its END"),
        })?;
        for key in keys {
            if job.is_interrupted() {
                return Err(Diagnostic::error("&CONNECTOR: nothing is changed", args.span));
            }
            let Some(mut made) = job.model.connectors.get(&key).cloned() else { continue };
            let text = change(&job.model, &mut made, given, &mut said).map_err(|error| {
                let elsewhere = error.span.is_some();
                let error = error.with_subject(format!("connector {}", made.name)).diagnostic(given.span, units);
                if elsewhere { error.other(given.span, "asked for here") } else { error }
            })?;
            said.lines.push(format!("connector {}: {text}", made.name));
            job.model.connectors.insert(key, made);
        }
    }
    let Said { lines, warnings, .. } = said;
    warnings.into_iter().for_each(|(text, span)| job.warn(text, span));
    Ok(Effect::Say(lines.join("\n")))
}

/// Each option with the names it acts on.
///
/// # Errors
/// An option before any name, names behind the last option.
fn groups(args: &Args) -> Outcome<Vec<(&Given, &[Value])>> {
    const FORM: &str = "form: &CONNECTOR NAME .. -OPTION VALUE; an option acts on the names before it";
    let (mut from, mut to) = (0, 0);
    let mut made = Vec::new();
    for given in &args.options {
        if given.after > to {
            (from, to) = (to, given.after);
        }
        let names = args.data.get(from..to).unwrap_or_default();
        if names.is_empty() {
            let text = format!("no connector is named before {}", given.name());
            return Err(Diagnostic::error(text, given.span).help(FORM));
        }
        made.push((given, names));
    }
    match args.data.get(to) {
        None => Ok(made),
        Some(name) => {
            let text = format!("no option acts on {}", name.word().unwrap_or_default());
            Err(Diagnostic::error(text, name.span).help(FORM))
        }
    }
}

/// Keys of the connectors that names, patterns and selectors choose, each once.
///
/// # Errors
/// A name that is none, a pattern or selector that chooses no connector.
pub(crate) fn select_connectors(model: &Model, names: &[Value]) -> Outcome<Vec<String>> {
    let mut keys: Vec<String> = Vec::new();
    for value in names {
        let name = value.word().unwrap_or_default();
        let all = || model.connectors.values().map(|c| c.name.as_str());
        let found: Vec<&str> = if name.starts_with(':') {
            let selector = find(&model.selectors, name, "selector", value.span)?;
            all().filter(|n| selector.matches(n, model)).collect()
        } else if is_wild(name) && !model.connectors.contains_key(&Model::key(name)) {
            all().filter(|n| matches(name, n)).collect()
        } else {
            vec![find(&model.connectors, name, "connector", value.span)?.name.as_str()]
        };
        if found.is_empty() {
            return Err(Diagnostic::error(format!("{name} chooses no connector"), value.span));
        }
        for key in found.into_iter().map(Model::key) {
            if !keys.contains(&key) {
                keys.push(key);
            }
        }
    }
    Ok(keys)
}

/// What is reported when the whole record has succeeded.
struct Said {
    units: UnitSystem,
    lines: Vec<String>,
    warnings: Vec<(String, Span)>,
}

impl Said {
    fn digits(&self, si: f64, dim: Dim) -> String {
        report(&Cell::Number(si), dim, Digits::Usual, self.units)
    }

    fn format_value(&self, si: f64, dim: Dim) -> String {
        format!("{} {}", self.digits(si, dim), dim.label(self.units))
    }

    fn warn(&mut self, connector: &Connector, given: &Given, text: &str) {
        self.warnings.push((format!("connector {}: {text}", connector.name), given.span));
    }
}

/// What an option asks for at the fairlead.
fn aim(given: &Given) -> Option<Condition> {
    let force = given.first_number()?;
    match given {
        _ if given.is(&L_HORIZONTAL) || given.is(&A_HORIZONTAL) => Some(Condition::Horizontal(force)),
        _ if given.is(&L_TENSION) || given.is(&A_TENSION) => Some(Condition::Tension(force)),
        _ => None,
    }
}

/// Changes one connector by one option; what is said of it.
fn change(model: &Model, made: &mut Connector, given: &Given, said: &mut Said) -> Result<String, ClassError> {
    if given.is(&ACTIVE) || given.is(&INACTIVE) {
        made.active = given.is(&ACTIVE);
        return Ok(if made.active { "active" } else { "inactive" }.into());
    }
    let reeving = model.reeving(&made.name);
    if let Some(assembly) = reeving.filter(|_| !given.is(&LENGTH) && !given.is(&L_DELTA)) {
        let text = format!("{} does not act on a span of the line of {}", given.name(), assembly.name);
        return Err(ClassError::new(text).help("-LENGTH, -L_DELTA, -ACTIVE and -INACTIVE do"));
    }
    if given.is(&DYNAMICS) {
        let elements = given.first_integer().and_then(|n| usize::try_from(n).ok());
        made.dynamics = elements.filter(|n| *n > 0);
        // what makes no such line is refused here, not in a run
        model.element(made)?;
        return Ok(made
            .dynamics
            .map_or("without dynamics of its own".into(), |n| format!("dynamic line of {n} elements")));
    }
    let aim = aim(given);
    if aim.is_some() && !made.active {
        return Ok(format!("inactive, passed over by {}", given.name()));
    }
    if matches!(aim, Some(Condition::Tension(_))) && begins_in_ground(model, made) {
        let text = "its first end is in the ground, and the tension of a line is that at its first end";
        return Err(ClassError::new(text).help("name the point on the body first in its CONNECTOR record"));
    }
    let old = (model.first_length(made), made.anchor);
    let value = given.first_number().unwrap_or(0.0);
    let mut also = String::new();
    let lengthened = given.is(&LENGTH) || given.is(&L_DELTA);
    let pulled = given.is(&L_HORIZONTAL) || given.is(&L_TENSION);
    match aim {
        _ if given.is(&LENGTH) => made.first_length = Some(value),
        _ if given.is(&L_DELTA) => {
            if !adjustable(model, made) {
                line(model, made)?;
            }
            let length = old.0.unwrap_or(0.0) + value;
            if length <= 0.0 {
                let text = format!("its first segment is {} long", said.format_value(length - value, Dim::Length));
                return Err(ClassError::new(text).help("-L_DELTA must leave more than nothing of it"));
            }
            made.first_length = Some(length);
        }
        Some(aim) if pulled && model.is_dynamic_line(made) => {
            made.first_length = Some(pretension::first_length(model, made, aim).map_err(|e| e.error)?);
        }
        Some(aim) if pulled => {
            line(model, made)?;
            check_placed(model, made)?;
            let found = line(model, made)?.first_length(aim)?;
            made.first_length = Some(found.length);
            also = others(&found, said);
        }
        _ if given.is(&ANCHOR) => {
            check_has_no_far_end(made)?;
            let [y, z] = given.numbers_or_zero(const { ANCHOR.numbers(["Y", "Z"]) });
            move_anchor(model, made, [value, y]);
            if let Some(anchor) = &mut made.anchor {
                anchor.elevation = Some(z);
            }
        }
        Some(aim) => {
            check_has_no_far_end(made)?;
            let made_of = line(model, made)?;
            let anchor = made.anchor.ok_or_else(no_anchor)?;
            check_placed(model, made)?;
            let distance = made_of.distance(aim)?;
            if distance < 0.0 {
                return Err(ClassError::new("the anchor would lie beyond the fairlead, against its direction"));
            }
            let position = model.placement(made);
            let [x, y, _] = position.fairlead;
            let (apart, along) = position.span();
            let (cos, sin) = unit_vector(anchor.direction);
            let [ux, uy] = if apart > 0.0 { along } else { [cos, sin] };
            move_anchor(model, made, [x + distance * ux, y + distance * uy]);
        }
        None => {}
    }
    if reeving.is_some() {
        return Ok(describe_change(made, given, old, said));
    }
    if model.is_dynamic_line(made) && lengthened {
        // what makes no such line is refused here, not in a run
        model.element(made)?;
    }
    let placed_anew = given.is(&ANCHOR) && old.1.is_some();
    if model.is_dynamic_line(made) && pulled {
        // found and proven by the dynamic line itself
        return Ok(describe_change(made, given, old, said));
    }
    if adjustable(model, made) && (placed_anew || lengthened || pulled) {
        return Ok(describe_change(made, given, old, said));
    }
    let found = line(model, made)?;
    let forces = forces(found.as_ref(), model, made, given, said)?;
    Ok(format!("{}{forces}{also}", describe_change(made, given, old, said)))
}

/// The further lengths that give the same force, and those without a configuration.
fn others(found: &FoundLength, said: &Said) -> String {
    let list: Vec<String> = found.others.iter().map(|l| said.format_value(*l, Dim::Length)).collect();
    let mut text = if list.is_empty() {
        String::new()
    } else {
        format!("; a first segment of {} gives the same", list.join(" or "))
    };
    for [from, to] in &found.unsolved {
        let [from, to] = [from, to].map(|l| said.format_value(*l, Dim::Length));
        text.push_str(&format!("; of {from} to {to} it has no configuration"));
    }
    text
}

/// Whether it has a length though it is no mooring line.
fn adjustable(model: &Model, connector: &Connector) -> bool {
    let class = model.classes.get(&Model::key(&connector.class)).and_then(|class| class.object.as_length());
    class.is_some_and(|class| class.is_adjustable())
}

/// The line a connector makes.
fn line(model: &Model, connector: &Connector) -> Result<Box<dyn LineModel>, ClassError> {
    let class = model.classes.get(&Model::key(&connector.class));
    let class = class.ok_or_else(|| ClassError::new(format!("its class {} is not defined", connector.class)))?;
    class.line(&model.placement(connector), &model.surroundings())
}

/// Whether a connector goes from the ground to a body.
fn begins_in_ground(model: &Model, connector: &Connector) -> bool {
    let on_body = |index: usize| {
        let point = connector.points.get(index).and_then(|name| model.points.get(&Model::key(name)))?;
        Some(model.body_of(point).is_some())
    };
    on_body(0) == Some(false) && on_body(1) == Some(true)
}

fn no_anchor() -> ClassError {
    ClassError::new("it has no anchor").help("give one with -ANCHOR X Y Z")
}

/// A connector whose other end has a place.
fn check_placed(model: &Model, connector: &Connector) -> Result<(), ClassError> {
    model.placement(connector).other.map(|_| ()).ok_or_else(no_anchor)
}

/// A connector that may have an anchor.
fn check_has_no_far_end(connector: &Connector) -> Result<(), ClassError> {
    if connector.points.len() > 1 {
        return Err(
            ClassError::new("it lies between two points and has no anchor").help("-L_TENSION changes its length")
        );
    }
    Ok(())
}

/// Puts the anchor at a place; its direction and distance from the fairlead follow.
fn move_anchor(model: &Model, connector: &mut Connector, at: [f64; 2]) {
    let [x, y, _] = model.placement(connector).fairlead;
    let [ax, ay] = at;
    let distance = (ax - x).hypot(ay - y);
    let old = connector.anchor.map(|a| a.direction);
    // a direction that is kept keeps the number it was given as
    let same = |direction: &f64| {
        let (cos, sin) = unit_vector(*direction);
        (x + distance * cos - ax).hypot(y + distance * sin - ay) <= 1e-9 * distance
    };
    let direction = old.filter(same).unwrap_or_else(|| (ay - y).atan2(ax - x));
    let elevation = connector.anchor.and_then(|a| a.elevation);
    connector.anchor = Some(Anchor { direction, distance, at, elevation });
}

/// The new length or place beside the old one.
fn describe_change(made: &Connector, given: &Given, old: (Option<f64>, Option<Anchor>), said: &Said) -> String {
    let length = |l: f64| said.digits(l, Dim::Length);
    match made.anchor.filter(|_| [ANCHOR, A_HORIZONTAL, A_TENSION].iter().any(|option| given.is(option))) {
        Some(anchor) => {
            let [x, y] = anchor.at.map(length);
            let z = anchor.elevation.map_or(String::new(), |z| format!(" {}", length(z)));
            let was = old.1.map_or("no anchor".into(), |a| length(a.distance));
            let away = said.format_value(anchor.distance, Dim::Length);
            let toward = said.format_value(anchor.direction, Dim::Angle);
            format!("anchor at {x} {y}{z}, {away} from the fairlead toward {toward} (was {was})")
        }
        None => {
            let now = said.format_value(made.first_length.unwrap_or(0.0), Dim::Length);
            format!("first segment {now} (was {})", old.0.map_or("none".into(), length))
        }
    }
}

/// The forces at the fairlead after a change. What was solved for is proven here: the line between its new ends bears it.
fn forces(
    found: &dyn LineModel,
    model: &Model,
    made: &Connector,
    given: &Given,
    said: &mut Said,
) -> Result<String, ClassError> {
    let Some([_, _, anchor]) = model.placement(made).other else { return Ok(String::new()) };
    let aim = aim(given);
    if let (true, Some(depth)) = (given.is(&ANCHOR), model.anchor_depth(made))
        && (depth + anchor).abs() > 1e-3 * depth
    {
        let (own, other) = (said.format_value(-anchor, Dim::Length), said.format_value(depth, Dim::Length));
        said.warn(made, given, &format!("the depth of its anchor is now {own}, not the {other} of -DEPANCHOR or &ENV"));
    }
    let LineLoads { fairlead: [fx, fy, _], tension, solution, notes, .. } = found.loads()?;
    let units = said.units;
    for note in notes.iter().filter(|note| note.severity == Severity::Warning) {
        said.warn(made, given, &note.sentence(units));
    }
    let horizontal = fx.hypot(fy);
    let [h, t] = [horizontal, tension].map(|f| said.format_value(f, Dim::Force));
    let asked = match aim {
        Some(Condition::Horizontal(force)) => Some(("horizontal force", force, horizontal)),
        Some(Condition::Tension(force)) => Some(("tension", force, tension)),
        _ => None,
    };
    let table = solution == "table";
    if let Some((what, wanted, got)) = asked.filter(|(_, wanted, got)| (got - wanted).abs() > FORCE_TOLERANCE * wanted)
    {
        let [wants, gets] = [wanted, got].map(|f| said.format_value(f, Dim::Force));
        if !table {
            return Err(ClassError::new(format!("its {what} would be {gets}, not {wants}")));
        }
        if (got - wanted).abs() > TABLE_TOLERANCE * wanted {
            let text = format!(
                "its table of thirty points gives a {what} of {gets}, not {wants}: its class without -TABLE does"
            );
            said.warn(made, given, &text);
        }
    }
    let source = if table { " (from its table of thirty points)" } else { "" };
    Ok(format!(", horizontal force {h}, tension {t}{source}"))
}
