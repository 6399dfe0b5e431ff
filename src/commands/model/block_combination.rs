//! `UNION`, `INTERSECT`, `DIFFERENCE` of `&SURFACE`, and `RENAME_BLOCK`, `DELETE_BLOCK`: blocks made of others.
//!
//! Source: [MOSES-REF surface] says that blocks are combined by Boolean operations; the forms of the records are our reading.

use crate::commands::menu;
use crate::commands::model::element::refuse_element;
use crate::commands::model::piece::{self, OPTIONS};
use crate::commands::model::surface::known_piece;
use crate::commands::{Call, Command, Effect, Job};
use windlass_base::choice::Choice;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_hydro::combine_pieces;
use windlass_hydro::hull::Combination;
use windlass_language::name as rule;
use windlass_language::record::Word;
use windlass_language::select::choose_word;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, MenuSpec, ValueSpec};
use windlass_model::{EntityKind, LOOSE_SURFACES, Model, Piece, Shape};

/// UNION.
pub static UNION: Command = Command { spec: &UNION_SPEC, edits: true, run: union };
/// INTERSECT.
pub static INTERSECT: Command = Command { spec: &INTERSECT_SPEC, edits: true, run: intersect };
/// DIFFERENCE.
pub static DIFFERENCE: Command = Command { spec: &DIFFERENCE_SPEC, edits: true, run: difference };
/// RENAME_BLOCK.
pub static RENAME_BLOCK: Command = Command { spec: &RENAME_SPEC, edits: true, run: rename };
/// DELETE_BLOCK.
pub static DELETE_BLOCK: Command = Command { spec: &DELETE_SPEC, edits: true, run: delete };

choices! {
    /// Words between blocks.
    enum Operation {
        Union = "UNION",
        Intersect = "INTERSECT",
        Difference = "DIFFERENCE",
    }
}

impl Operation {
    fn combination(self) -> Combination {
        match self {
            Operation::Union => Combination::Union,
            Operation::Intersect => Combination::Intersection,
            Operation::Difference => Combination::Difference,
        }
    }
}

const EXAMPLE: &str = "&DESCRIBE BODY RIG\n&SURFACE\nBLOCK HULL 0 -20 0 70 20 8\nBLOCK WELL -LOCATION 10 0 4 0 90 0\nPLANE -6 6 -CIRC 0 0 4 17\n\
                       END_BLOCK\nDIFFERENCE HULL HULL WELL\nBLOCK BOX 60 -30 0 80 30 8\nHULL = HULL UNION BOX\nLIST_BLOCK\nEND_&SURFACE";
const DETAIL: &str = "UNION, INTERSECT and DIFFERENCE NAME A B .. make NAME of A and B, and then of what they make and the next; NAME = A UNION B DIFFERENCE C \
                      says the same, left to right. NAME may be A. The polyhedra are exact to rounding. The result has the options of A. In a body the blocks \
                      that are combined are used up, so that nothing counts twice; before any body they stay, and EMIT takes what it names. Each must be a \
                      closed surface whose panels do not cut each other. A TUBE is a member and takes no part: BLOCK with PLANE -CIRCULAR gives a cylinder of \
                      panels. These forms are our reading.";

const NEW: ValueSpec =
    ValueSpec::new("NEW", Kind::Name(Noun::New), "name of the result; it may be that of a block it is made of");
const FIRST: ValueSpec = ValueSpec::new("A", Kind::Text, "the first block");
const NEXT: ValueSpec = ValueSpec::new("B", Kind::Text, "a further block");

const MENU: &[&MenuSpec] = &[&menu::SURFACE];
const DATA: &[ValueSpec] = &[NEW, FIRST, NEXT];

const fn spec(name: &'static str, help: &'static str) -> CommandSpec {
    CommandSpec { menus: MENU, data: DATA, repeat: 1, detail: DETAIL, example: EXAMPLE, ..CommandSpec::new(name, help) }
}

static UNION_SPEC: CommandSpec = spec("UNION", "a block of what is in any of several");
static INTERSECT_SPEC: CommandSpec = spec("INTERSECT", "a block of what is in all of several");
static DIFFERENCE_SPEC: CommandSpec = spec("DIFFERENCE", "a block of what is in one and in none of the others");

static RENAME_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    data: &[
        ValueSpec::new("NAME", Kind::Text, "the block"),
        ValueSpec::new("NEW", Kind::Name(Noun::New), "its name from now on"),
    ],
    detail: "The order of the data is our reading.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK A 0 5 0 10 9 20\nRENAME_BLOCK A WING\nLIST_BLOCK\nEND",
    ..CommandSpec::new("RENAME_BLOCK", "gives a block another name")
};
static DELETE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    data: &[ValueSpec::new("NAME", Kind::Text, "a block")],
    repeat: 1,
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK A 0 5 0 10 9 20\nBLOCK B 0 -9 0 10 -5 20\nDELETE_BLOCK A\nLIST_BLOCK\nEND",
    ..CommandSpec::new("DELETE_BLOCK", "takes blocks away")
};

/// A block by its name, where it stands in a record.
type Named = (String, Span);

fn union(job: &mut Job, call: &Call) -> Outcome<Effect> {
    combine_all(job, call, Operation::Union)
}

fn intersect(job: &mut Job, call: &Call) -> Outcome<Effect> {
    combine_all(job, call, Operation::Intersect)
}

fn difference(job: &mut Job, call: &Call) -> Outcome<Effect> {
    combine_all(job, call, Operation::Difference)
}

fn combine_all(job: &mut Job, call: &Call, how: Operation) -> Outcome<Effect> {
    const NEW_NAME: DatumKey<str> = UNION_SPEC.word("NEW");
    let named = |value: &windlass_base::values::Value| Some((value.word()?.to_string(), value.span));
    let mut blocks = call.args.data_after(NEW_NAME).iter().filter_map(named);
    let Some(first) = blocks.next() else { return Ok(Effect::Done) };
    let rest: Vec<(Operation, Named)> = blocks.map(|block| (how, block)).collect();
    let made = (call.args.word(NEW_NAME).unwrap_or_default().to_string(), call.args.position(NEW_NAME));
    combine(job, made, first, &rest)
}

/// `NAME = A UNION B DIFFERENCE C ..`; `None` where a record has another form.
///
/// # Errors
/// A word that is no operation, a block that is missing, and as the commands.
pub fn assign(job: &mut Job, words: &[Word]) -> Option<Outcome<Effect>> {
    let [name, sign, rest @ ..] = words else { return None };
    if sign.text.as_ref() != "=" {
        return None;
    }
    let model = job.model.clone();
    let outcome = assign_blocks(job, name, sign, rest);
    if outcome.is_err() {
        job.model = model;
    }
    Some(outcome)
}

fn assign_blocks(job: &mut Job, name: &Word, sign: &Word, rest: &[Word]) -> Outcome<Effect> {
    let form = "form: NAME = A UNION B, with UNION, INTERSECT or DIFFERENCE between blocks";
    let [first, operations @ ..] = rest else {
        return Err(Diagnostic::error("a block is missing after `=`", sign.span).help(form));
    };
    if operations.is_empty() {
        return Err(Diagnostic::error("an operation is missing after the first block", first.span).help(form));
    }
    let mut steps = Vec::new();
    for pair in operations.chunks(2) {
        let [word, block] = pair else {
            return Err(Diagnostic::error(
                "a block is missing after the operation",
                pair.first().map_or(sign.span, |w| w.span),
            )
            .help(form));
        };
        let how: Operation = choose_word(&word.text, word.span, "operation between blocks")?;
        steps.push((how, (block.text.to_string(), block.span)));
    }
    combine(job, (name.text.to_string(), name.span), (first.text.to_string(), first.span), &steps)
}

/// A block that can be combined, with the key of its part.
fn operand(job: &Job, (name, span): &Named) -> Outcome<(String, Piece)> {
    let piece = known_piece(job, name, *span)?;
    refuse_element(&piece, *span)?;
    if let Shape::Tube { .. } = piece.shape {
        return Err(Diagnostic::error(format!("{} is a TUBE, which takes no part", piece.name), *span)
            .other(piece.span, "defined here")
            .help("BLOCK with PLANE -CIRCULAR gives a cylinder of panels"));
    }
    let part = job.model.piece(name).map(|(part, _)| Model::key(&part.name)).unwrap_or_default();
    Ok((part, piece))
}

fn combine(job: &mut Job, (new, at): Named, first: Named, rest: &[(Operation, Named)]) -> Outcome<Effect> {
    piece::finish_piece(job);
    rule::check(&new, None, "piece", at)?;
    let (part, original) = operand(job, &first)?;
    let mut made = Piece { name: new.clone(), span: at, ..original.clone() };
    let mut used = vec![original.name.clone()];
    for (how, next) in rest {
        let (other_part, other) = operand(job, next)?;
        if other_part != part || other.compartment != original.compartment {
            return Err(Diagnostic::error(
                format!("{} and {} belong to different parts or compartments", original.name, other.name),
                next.1,
            )
            .other(other.span, "defined here"));
        }
        let record = format!("{} {} {}", original.name, how.word(), other.name);
        let panels = combine_pieces(&made, &other, how.combination()).map_err(|error| {
            let text = format!("{record}: {}", error.text(job.units));
            Diagnostic::error(text, next.1).other(original.span, "the first block").other(other.span, "the other block")
        })?;
        if other.permeability != original.permeability
            || other.cs_wind != original.cs_wind
            || other.cs_current != original.cs_current
        {
            job.remark(format!("{new} has the permeability and the coefficients of {}", original.name), at);
        }
        made.shape = Shape::Panels(panels);
        used.push(other.name);
    }
    let is_used = |name: &str| used.iter().any(|own| Model::key(own) == Model::key(name));
    match job.model.piece(&new) {
        Some((_, old)) if !is_used(&new) => {
            return Err(
                Diagnostic::error(format!("piece {} exists already", old.name), at).other(old.span, "defined here")
            );
        }
        Some(_) => {}
        None => job.model.free_name(&new, &[EntityKind::Body, EntityKind::Part], at)?,
    }
    let stay = part == LOOSE_SURFACES;
    if let Some(part) = job.model.parts.get_mut(&part) {
        part.pieces.retain(|p| Model::key(&p.name) != Model::key(&new) && (stay || !is_used(&p.name)));
        part.pieces.push(made);
    }
    job.note_name(&new, at);
    job.model.current_piece = Some(new);
    piece::finish_piece(job);
    Ok(Effect::Done)
}

fn rename(job: &mut Job, call: &Call) -> Outcome<Effect> {
    piece::finish_piece(job);
    let args = &call.args;
    const NAME: DatumKey<str> = RENAME_SPEC.word("NAME");
    const NEW_NAME: DatumKey<str> = RENAME_SPEC.word("NEW");
    let old = known_piece(job, args.word(NAME).unwrap_or_default(), args.position(NAME))?;
    refuse_element(&old, args.position(NAME))?;
    let new = args.word(NEW_NAME).unwrap_or_default();
    rule::check(new, None, "piece", args.position(NEW_NAME))?;
    if let Some((_, taken)) = job.model.piece(new) {
        return Err(Diagnostic::error(format!("piece {} exists already", taken.name), args.position(NEW_NAME))
            .other(taken.span, "defined here"));
    }
    job.model.free_name(new, &[EntityKind::Body, EntityKind::Part], args.position(NEW_NAME))?;
    if let Some(piece) = job.model.piece_mut(&old.name) {
        piece.name = new.to_string();
    }
    job.uncompared_pieces.iter_mut().filter(|name| **name == old.name).for_each(|name| *name = new.to_string());
    job.note_name(new, args.position(NEW_NAME));
    Ok(Effect::Done)
}

fn delete(job: &mut Job, call: &Call) -> Outcome<Effect> {
    piece::finish_piece(job);
    for value in &call.args.data {
        let piece = known_piece(job, value.word().unwrap_or_default(), value.span)?;
        refuse_element(&piece, value.span)?;
        for part in job.model.parts.values_mut() {
            part.pieces.retain(|p| p.name != piece.name);
        }
    }
    Ok(Effect::Done)
}

/// TUBTANK.
pub static TUBTANK: Command = Command { spec: &TUBTANK_SPEC, edits: true, run: tubtank };

static TUBTANK_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    data: &[
        ValueSpec::new("*P1", Kind::Name(Noun::Point), "centre of one end"),
        ValueSpec::new("*P2", Kind::Name(Noun::Point), "centre of the other end"),
        ValueSpec::new("DIAMETER", Kind::Number(Dim::Section), "outer diameter").positive(),
        ValueSpec::new(
            "THICKNESS",
            Kind::Number(Dim::Section),
            "thickness of the wall: the space within it is the tank",
        )
        .or("0")
        .not_negative(),
    ],
    options: &OPTIONS,
    detail: "A cylinder of the compartment described last, any number of them. Its length is that between the points. Water in a flooded member \
             (-FLOOD YES) that lies in the same place is counted twice. The order of the data is our reading.",
    example: "MEDIT\n&DESCRIBE BODY SEMI\nPGEN\nPLANE 0 40 -RECT 0 8 12\nEND\n*T1 2 0 4\n*T2 38 0 4\n&DESCRIBE COMPARTMENT T1\nTUBTANK *T1 *T2 24 0.5\nEND\n\
              &INSTATE -CONDITION 3\n&COMPARTMENT -PERCENT T1 50\n&STATUS COMPARTMENT",
    ..CommandSpec::new("TUBTANK", "a cylinder as the space of a compartment")
};

fn tubtank(job: &mut Job, call: &Call) -> Outcome<Effect> {
    piece::finish_piece(job);
    let args = &call.args;
    if job.model.current_compartment.is_none() {
        return Err(Diagnostic::error("a TUBTANK belongs to a compartment, and none is described", args.span)
            .help("&DESCRIBE COMPARTMENT NAME describes one"));
    }
    const SECOND: DatumKey<str> = TUBTANK_SPEC.word("*P2");
    const THICKNESS: DatumKey<f64> = TUBTANK_SPEC.number("THICKNESS");
    let part = piece::current_part(&job.model, args.span)?;
    let end = |key: DatumKey<str>| {
        piece::point_in_part(&job.model, args.word(key).unwrap_or_default(), part, args.position(key))
    };
    let ends = [end(const { TUBTANK_SPEC.word("*P1") })?, end(SECOND)?];
    if ends[0] == ends[1] {
        return Err(Diagnostic::error("a TUBTANK needs two points at different places", args.position(SECOND)));
    }
    let outer = args.number(const { TUBTANK_SPEC.number("DIAMETER") }).unwrap_or_default();
    let diameter = outer - 2.0 * args.number(THICKNESS).unwrap_or_default();
    if diameter <= 0.0 {
        return Err(Diagnostic::error("the wall leaves no space within the diameter", args.position(THICKNESS)));
    }
    let name = piece::free_piece_name(&job.model);
    let piece = piece::begin_piece(job, args, &name, args.span, Shape::Tube { ends, diameter })?;
    piece::add(job, piece, true);
    Ok(Effect::Done)
}
