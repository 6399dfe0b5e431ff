//! `BEAM` and `PLATE`: structural elements, with their weight and what water and wind do to them; no stiffness.
//!
//! Source: [MOSES-REF ele_beams, ele_plates, ele_sys].

use crate::commands::menu;
use crate::commands::model::{piece, weight};
use crate::commands::{Call, Command, Effect, Job, Menu};
use nalgebra::Vector3;
use windlass_base::choice::YesNo;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::{Args, Given, Noun, Value};
use windlass_hydro::structure::{BeamPlace, MemberCoefficients, StructuralElement, build_beam, build_plate};
use windlass_language::name as rule;
use windlass_language::number::evaluate;
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec};
use windlass_model::{
    Class, Defaults, ElementOf, Model, Parameters, Part, Piece, STR_MODEL, SolveKind, UnmodelledEffect, WaveAction,
    Weight, find,
};

/// BEAM.
pub static BEAM: Command = Command { spec: &BEAM_SPEC, edits: true, run: beam };
/// PLATE.
pub static PLATE: Command = Command { spec: &PLATE_SPEC, edits: true, run: plate };

const WORDS: &[ValueSpec] = &[ValueSpec::new("WORD", Kind::Item, "a name, ~CLASS or *NODE")];
const FLOOD: OptionSpec = OptionSpec::new(
    "-FLOOD",
    &[ValueSpec::choice::<YesNo>("YES/NO", "YES: water fills it")],
    "whether a closed section displaces its metal alone",
)
.many()
.default("NO");
const CATEGORY: OptionSpec = OptionSpec { many: true, default: STR_MODEL, ..weight::CATEGORY };
const REFN: OptionSpec = OptionSpec::new(
    "-REFN",
    &[ValueSpec::new("*REFNOD", Kind::Name(Noun::Point), "a point")],
    "local z is in the plane of the beam and this point",
)
.many()
.default("-DIR_BEAM of &DEFAULT");
const COMPONENT: ValueSpec =
    ValueSpec::new("V", Kind::Number(Dim::None), "components, of one direction or two, in the part");
const DIR_LOC: OptionSpec =
    OptionSpec::new("-DIR_LOC", &[COMPONENT], "as -DIR_BEAM of &DEFAULT, for these beams").repeating(1).many();
const CHORD_ANGLE: OptionSpec = OptionSpec::new(
    "-CA",
    &[ValueSpec::new("ANGLE", Kind::Number(Dim::Angle), "angle about the beam, from local y to local z")],
    "turns the section about its axis (our reading)",
)
.many()
.default("0");
const OFFSET: &[ValueSpec] = &[ValueSpec::new("V", Kind::Number(Dim::None), "components")];
const GOA: OptionSpec = OptionSpec::new("-GOA", OFFSET, "offset of the first end")
    .repeating(1)
    .many()
    .stops(SolveKind::Statics, "where the beam ends");
const GOB: OptionSpec = OptionSpec::new("-GOB", OFFSET, "offset of the second end")
    .repeating(1)
    .many()
    .stops(SolveKind::Statics, "where the beam ends");
const FREE_SIDE: OptionSpec =
    OptionSpec::new("-FSOPT", &[ValueSpec::new("*FP", Kind::Name(Noun::Point), "a point")], "points of a free edge")
        .repeating(1)
        .stops(SolveKind::Statics, "a free edge");
/// Values of an option that is read and not used.
const ANY: &[ValueSpec] = &[ValueSpec::new("V", Kind::Item, "a value").or("none")];
/// An option of a stress analysis.
const fn stress(name: &'static str) -> OptionSpec {
    OptionSpec::new(name, ANY, "of a stress analysis or a code check").repeating(1).many().without_effect()
}

static BEAM_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: WORDS,
    repeat: 1,
    interleaved: true,
    options: &[
        FLOOD,
        CATEGORY,
        REFN,
        DIR_LOC,
        CHORD_ANGLE,
        GOA,
        GOB,
        stress("-RELEASE"),
        stress("-KFAC"),
        stress("-CMFAC"),
        stress("-BLENGTH"),
        stress("-USE"),
        stress("-STRW_USE"),
        stress("-SCF"),
    ],
    detail: "BEAM [NAME] ~CLASS *N1 *N2 *N3 ..: beams from node to node. A further [NAME] ~CLASS or option holds for the beams behind it: \
             BEAM ~C1 *A *B ~C2 -FLOOD YES *C has ~C1 from *A to *B, ~C2 flooded from *B to *C. An option behind the last node holds for every beam that has none of its own (our reading). Without a name a beam is BEAM1, BEAM2 ..; a name given again replaces that beam. \
             A beam has no stiffness here and its body is rigid. It has the weight of its metal, in category STR_MODEL (our reading); the buoyancy of what its walls \
             enclose, or with -FLOOD YES and in open sections of its metal; and drag, added mass and pressure of waves by Morison's \
             formula, with the coefficients of &PARAMETER: -DRGTUB, -AMCTUB and -WCSTUBE of tubes; bars have a drag of -DRGPLA, else 1, along width and depth, on the \
             breadth seen from there, an added mass of the circle over that breadth, and wind on the projected area (our reading). Water in \
             a flooded member moves with it across its axis. Members are counted from node to node, also where they run into each other. Nodes are of one body. In INMODEL the names may be \
             defined later. &STATUS PIECES lists the members.",
    example: "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY JACKET\n*A 0 0 -40\n*B 2 0 0\n*C 4 0 10\n~LEG TUBE 1200 30\n\
              ~TOP IBEAM 900 300 16 28\nBEAM LEG ~LEG -FLOOD YES *A *B ~TOP -FLOOD NO *C\nEND\n&STATUS PIECES\n&STATUS WEIGHT",
    ..CommandSpec::new("BEAM", "structural members from node to node")
};
static PLATE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: WORDS,
    repeat: 1,
    interleaved: true,
    options: &[
        CATEGORY,
        REFN,
        DIR_LOC,
        FREE_SIDE,
        stress("-KFAC"),
        stress("-CMFAC"),
        stress("-BLENGTH"),
        stress("-USE"),
        stress("-STRW_USE"),
        stress("-SCF"),
    ],
    detail: "PLATE [NAME] ~CLASS *N1 *N2 *N3 [*N4 ..]: a plane convex plate with its nodes round it, of a class of type PLATE. It has the \
             weight and the buoyancy of its metal; wind on its projected area; and drag, along its normal on its area and along its edges on its \
             thickness, with -DRGPLA of &PARAMETER, else 1, and the added mass of strips along its longest side, rho pi/4 b^2 a length (our \
             reading). -REFN and -DIR_LOC turn local axes of stresses, and nothing here. A name given again replaces that plate.",
    example: "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY DECK\n*A 0 0 5\n*B 12 0 5\n*C 12 6 5\n*D 0 6 5\n~P PLATE 12\n\
              PLATE LID ~P *A *B *C *D\nEND\n&STATUS PIECES\n&STATUS WEIGHT",
    ..CommandSpec::new("PLATE", "structural plate")
};

/// A record of an open INMODEL, with what held when it was read.
#[derive(Clone, Debug)]
pub struct DeferredElement {
    is_plate: bool,
    args: Args,
    defaults: Defaults,
    parameters: Parameters,
}

fn beam(job: &mut Job, call: &Call) -> Outcome<Effect> {
    element(job, call, false)
}

fn plate(job: &mut Job, call: &Call) -> Outcome<Effect> {
    element(job, call, true)
}

fn element(job: &mut Job, call: &Call, is_plate: bool) -> Outcome<Effect> {
    let (defaults, parameters) = (job.model.defaults, job.model.parameters);
    let record = DeferredElement { is_plate, args: call.args.clone(), defaults, parameters };
    if matches!(job.menu(), Menu::Inmodel) {
        job.deferred_elements.push(record);
        return Ok(Effect::Done);
    }
    build_elements(job, &record)?;
    Ok(Effect::Done)
}

/// What a word of the record is.
fn sort_of(value: &Value) -> Option<char> {
    value.word().and_then(|word| word.chars().next()).filter(|c| "~*".contains(*c))
}

/// Makes the elements of a record whose names are all defined.
///
/// # Errors
/// Unknown names, nodes of two bodies or of none, a record without class or nodes, sections that do not fit.
pub fn build_elements(job: &mut Job, record: &DeferredElement) -> Outcome<()> {
    let args = &record.args;
    let what = if record.is_plate { "PLATE" } else { "BEAM" };
    let mut name: Option<&Value> = None;
    let mut class: Option<&Value> = None;
    let mut nodes: Vec<(usize, &Value)> = Vec::new();
    let mut made = 0;
    for (index, value) in args.data.iter().enumerate() {
        match sort_of(value) {
            Some('~') => class = Some(value),
            Some(_) => {
                nodes.push((index, value));
                let (Some(of), [.., (_, a), (_, b)], false) = (class, nodes.as_slice(), record.is_plate) else {
                    continue;
                };
                make_beam(job, record, StatedElement { name: name.take(), class: of, index }, [*a, *b])?;
                made += 1;
            }
            None => {
                if let Some(before) = name {
                    let text = format!("{} and this are both names of one {what}", before.word().unwrap_or_default());
                    return Err(
                        Diagnostic::error(text, value.span).help(format!("form: {what} [NAME] ~CLASS *N1 *N2 .."))
                    );
                }
                name = Some(value);
            }
        }
    }
    let lacks = |text: &str| {
        let spec = if record.is_plate { &PLATE_SPEC } else { &BEAM_SPEC };
        Err(Diagnostic::error(format!("{what} lacks {text}"), args.span)
            .help(format!("form: {}", spec.detail.split(':').next().unwrap_or_default())))
    };
    let Some(class) = class else { return lacks("its ~CLASS") };
    if record.is_plate {
        if nodes.len() < 3 {
            return lacks("three nodes or more");
        }
        let corners: Vec<&Value> = nodes.iter().map(|(_, node)| *node).collect();
        return make_plate(job, record, StatedElement { name, class, index: args.data.len() }, &corners);
    }
    if made == 0 {
        return lacks("two nodes");
    }
    Ok(())
}

/// The name and the class of an element, and how many words stand before it is complete.
struct StatedElement<'a> {
    name: Option<&'a Value>,
    class: &'a Value,
    index: usize,
}

/// An option as it holds for an element that is complete behind a number of words: the last given before, else one behind all words.
fn in_force<'a>(args: &'a Args, option: &OptionSpec, index: usize) -> Option<&'a Given> {
    let behind = || args.occurrences(option).find(|given| given.after >= args.data.len());
    args.occurrences(option).rfind(|given| given.after <= index).or_else(behind)
}

/// The part of a node, where it is a part of a body.
fn part_of<'m>(model: &'m Model, node: &Value) -> Outcome<&'m Part> {
    let point = find(&model.points, node.word().unwrap_or_default(), "point", node.span)?;
    model.parts.get(&Model::key(&point.part)).filter(|_| model.body_of(point).is_some()).ok_or_else(|| {
        Diagnostic::error(format!("{} is a point of the ground, which has no members", point.name), node.span)
            .other(point.span, "defined here")
    })
}

/// The class of an element: `None` where its shape is not known, and solves stop.
fn class_of<'j>(job: &'j Job, class: &Value) -> Outcome<Option<&'j Class>> {
    let word = class.word().unwrap_or_default();
    if job.absent_classes.contains_key(&Model::key(word)) && !job.model.classes.contains_key(&Model::key(word)) {
        return Ok(None);
    }
    let found = find(&job.model.classes, word, "class", class.span)?;
    if found.object.as_members().is_none() {
        let text = format!("{} is a {}, not a section of members", found.name, found.object.kind());
        return Err(Diagnostic::error(text, class.span).other(found.span, "defined here"));
    }
    Ok(Some(found))
}

/// What members have where their records say nothing.
fn coefficients(parameters: &Parameters) -> MemberCoefficients {
    MemberCoefficients {
        tube_drag: parameters.tube_drag.unwrap_or(1.0),
        tube_added: parameters.tube_added_mass.unwrap_or(1.0),
        tube_wind: parameters.tube_wind.unwrap_or(1.0),
        flat_drag: parameters.plate_drag.unwrap_or(1.0),
        flat_added: 1.0,
        flat_wind: 1.0,
    }
}

fn make_beam(job: &mut Job, record: &DeferredElement, of: StatedElement, nodes: [&Value; 2]) -> Outcome<()> {
    let part = part_of(&job.model, nodes[0])?;
    let at = |node: &Value| -> Outcome<Vector3<f64>> {
        let position = piece::point_in_part(&job.model, node.word().unwrap_or_default(), part, node.span)?;
        Ok(position.into())
    };
    let ends = [at(nodes[0])?, at(nodes[1])?];
    let Some(class) = class_of(job, of.class)? else {
        keep_missing(job, &of, "BEAM");
        return Ok(());
    };
    let args = &record.args;
    let mut directions = record.defaults.beam_direction;
    if let Some(given) = in_force(args, &DIR_LOC, of.index) {
        set_directions(&mut directions, given)?;
    }
    if let Some(value) = in_force(args, &REFN, of.index).and_then(|given| given.values.first()) {
        directions[0] = (at(value)? - ends[0]).into();
    }
    let position = BeamPlace {
        ends,
        directions,
        turn: in_force(args, &CHORD_ANGLE, of.index).and_then(Given::first_number).unwrap_or(0.0),
        is_flooded: in_force(args, &FLOOD, of.index).is_some_and(Given::is_on),
    };
    let sections = class.object.as_members().unwrap_or_default();
    if let Some(section) = sections.iter().find(|s| s.kind == "PLATE") {
        return Err(Diagnostic::error(format!("{} is a {}: PLATE takes it", class.name, section.kind), of.class.span)
            .other(class.span, "defined here"));
    }
    let unread = sections.iter().find_map(|section| section.unread);
    let water = job.model.surroundings().water_weight();
    let built = build_beam(sections, &position, &coefficients(&record.parameters), water)
        .map_err(|error| error.with_subject("the beam").diagnostic(nodes[1].span, job.units))?;
    let (part, class) = (Model::key(&part.name), class.name.clone());
    if let Some(offset) = [GOA, GOB].iter().find_map(|option| in_force(args, option, of.index)) {
        let (record, effect) = (format!("{} of a BEAM", offset.name()), "where the beam ends".to_string());
        job.model.keep_unmodelled(UnmodelledEffect {
            record,
            effect,
            matters_to: SolveKind::Statics,
            span: offset.span,
        });
    }
    insert(job, record, of, ("BEAM", &part, &class, unread), built)
}

fn make_plate(job: &mut Job, record: &DeferredElement, of: StatedElement, nodes: &[&Value]) -> Outcome<()> {
    let Some(first) = nodes.first() else { return Ok(()) };
    let part = part_of(&job.model, first)?;
    let position = |node: &&Value| piece::point_in_part(&job.model, node.word().unwrap_or_default(), part, node.span);
    let corners: Vec<Vector3<f64>> =
        nodes.iter().map(|node| position(node).map(Vector3::from)).collect::<Outcome<_>>()?;
    let Some(class) = class_of(job, of.class)? else {
        keep_missing(job, &of, "PLATE");
        return Ok(());
    };
    let Some(section) = class.object.as_members().and_then(<[_]>::first) else { return Ok(()) };
    let built = build_plate(section, &corners, &coefficients(&record.parameters))
        .map_err(|error| error.with_subject("the plate").diagnostic(first.span, job.units))?;
    let (part, class, unread) = (Model::key(&part.name), class.name.clone(), section.unread);
    if let Some(edge) = in_force(&record.args, &FREE_SIDE, of.index) {
        let (record, effect) = (format!("{} of a PLATE", edge.name()), "a free edge".to_string());
        job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to: SolveKind::Statics, span: edge.span });
    }
    insert(job, record, of, ("PLATE", &part, &class, unread), built)
}

/// Reads one direction or two.
///
/// # Errors
/// Another number of components, a word that is neither an axis nor a number.
pub fn set_directions(directions: &mut [[f64; 3]; 2], given: &Given) -> Outcome<()> {
    let mut components = Vec::new();
    for value in &given.values {
        if let Some(component) = value.number() {
            components.push(component);
            continue;
        }
        let word = value.word().unwrap_or_default();
        match word.to_ascii_uppercase().as_str() {
            "X" => components.extend([1.0, 0.0, 0.0]),
            "Y" => components.extend([0.0, 1.0, 0.0]),
            "Z" => components.extend([0.0, 0.0, 1.0]),
            _ => components.push(evaluate(word).map_err(|e| {
                let text = format!("V of {} must be X, Y or Z, or a number", given.name());
                Diagnostic::error(text, value.span).label(e.to_string())
            })?),
        }
    }
    match components.as_slice() {
        [a, b, c] => directions[0] = [*a, *b, *c],
        [a, b, c, d, e, f] => *directions = [[*a, *b, *c], [*d, *e, *f]],
        other => {
            let text = format!("{} takes three components or six, not {}", given.name(), other.len());
            return Err(Diagnostic::error(text, given.span));
        }
    }
    Ok(())
}

/// Keeps the element of a shape without dimensions: the next solve stops.
fn keep_missing(job: &mut Job, of: &StatedElement, what: &str) {
    let record = format!("{what} of class {}", of.class.word().unwrap_or_default());
    let effect = "weight, buoyancy, wind and drag of a shape without dimensions; &DATA SHAPES gives them".to_string();
    if !job.model.unmodelled.iter().any(|kept| kept.record == record) {
        let (matters_to, span) = (SolveKind::Hydrostatics, of.class.span);
        job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to, span });
    }
}

/// Puts an element into its part.
fn insert(
    job: &mut Job,
    record: &DeferredElement,
    of: StatedElement,
    (what, part, class, unread): (&str, &str, &str, Option<&'static str>),
    built: StructuralElement,
) -> Outcome<()> {
    let count: usize = job.model.parts.values().map(|part| part.pieces.len()).sum();
    let (name, span) = match of.name {
        Some(value) => (value.word().unwrap_or_default().to_string(), value.span),
        None => (piece::free_name_from(&job.model, what, count + 1), of.class.span),
    };
    if of.name.is_some() {
        rule::check(&name, None, "element", span)?;
        if job.model.remove_element(&name) {
            job.remark(format!("element {name} is replaced"), span);
        }
        if let Some((_, old)) = job.model.piece(&name) {
            return Err(
                Diagnostic::error(format!("piece {} exists already", old.name), span).other(old.span, "defined here")
            );
        }
        job.model.free_name(&name, &[], span)?;
    }
    if let Some(effect) = unread {
        let (record, effect) = (format!("class {class} of a {what}"), effect.to_string());
        if !job.model.unmodelled.iter().any(|kept| kept.record == record) {
            let (matters_to, span) = (SolveKind::Hydrostatics, of.class.span);
            job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to, span });
        }
    }
    let category = in_force(&record.args, &CATEGORY, of.index).and_then(Given::first_word);
    let category = category.map_or_else(|| STR_MODEL.to_string(), str::to_ascii_uppercase);
    let element = ElementOf { name: name.clone(), class: class.to_string() };
    let names: Vec<String> =
        (0..built.pieces.len()).map(|n| if n == 0 { name.clone() } else { format!("{name}.{}", n + 1) }).collect();
    let Some(part) = job.model.parts.get_mut(part) else { return Ok(()) };
    for (name, made) in names.into_iter().zip(built.pieces) {
        part.pieces.push(Piece {
            name,
            permeability: made.permeability,
            shape: made.shape,
            cs_wind: made.cs_wind,
            cs_current: [0.0; 3],
            member: Some(made.member),
            element: Some(element.clone()),
            category: Some(category.clone()),
            waves: WaveAction::ByForm,
            own_panels: false,
            eddy_damping: 0.0,
            drift_damping: None,
            kept: Vec::new(),
            unmodelled: Vec::new(),
            compartment: None,
            span,
        });
    }
    for (at, weight) in built.weights {
        let (category, element) = (category.clone(), Some(element.name.clone()));
        part.weights.push(Weight { at, weight, category, element, span, ..Weight::default() });
    }
    job.model.refresh_weight_multipliers();
    job.note_name(&name, span);
    Ok(())
}

/// Refuses to move or mirror a piece of an element: its weight is where its nodes are.
///
/// # Errors
/// A piece of an element.
pub fn refuse_element(piece: &Piece, span: Span) -> Outcome<()> {
    match &piece.element {
        None => Ok(()),
        Some(of) => {
            Err(Diagnostic::error(format!("{} is of element {}, which stands at its nodes", piece.name, of.name), span)
                .help("move its points and give it anew"))
        }
    }
}
