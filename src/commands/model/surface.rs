//! `&SURFACE`: pieces as boxes, meshes of files, and round members.
//!
//! Source: [MOSES-REF surface], for the names; it does not give the forms, which are ours and stand in the help.

use crate::commands::menu;
use crate::commands::model::describe::PLACE;
use crate::commands::model::element::refuse_element;
use crate::commands::model::member;
use crate::commands::model::pgen::{PLACING, PLACING_HELP, Placing, Planes, add_placed};
use crate::commands::model::piece::{self, OPTIONS, PIECE_HELP};
use crate::commands::settings::device::existing;
use crate::commands::status::body_tables::pieces;
use crate::commands::{Call, Command, Effect, Job, Menu, MeshVertices};
use crate::report::page;
use windlass_base::choice::Choice;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::{Place, Position};
use windlass_base::span::Span;
use windlass_base::units::{Dim, METRES_PER_FOOT, UnitSystem};
use windlass_base::values::Args;
use windlass_base::values::Noun;
use windlass_base::wildcard::matches;
use windlass_hydro::hull::{MeshFile, MeshKind, close_above_waterline, read_mesh};
use windlass_language::args;
use windlass_language::name as rule;
use windlass_language::number::evaluate;
use windlass_language::record::Word;
use windlass_language::select::Owner;
use windlass_language::source::LARGEST_FILE;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, TextForm, ValueSpec, join_options};
use windlass_language::token::TokenKind;
use windlass_model::{EntityKind, LOOSE_SURFACES, Model, Piece, Shape};

/// &SURFACE.
pub static SURFACE: Command = Command { spec: &SURFACE_SPEC, edits: false, run: surface };
/// BLOCK.
pub static BLOCK: Command = Command { spec: &BLOCK_SPEC, edits: false, run: block };
/// MESH.
pub static MESH: Command = Command { spec: &MESH_SPEC, edits: false, run: mesh };
/// TUBE.
pub static TUBE: Command = Command { spec: &TUBE_SPEC, edits: false, run: tube };
/// MOVE_BLOCK.
pub static MOVE_BLOCK: Command = Command { spec: &MOVE_SPEC, edits: false, run: move_block };
/// LIST_BLOCK.
pub static LIST_BLOCK: Command = Command { spec: &LIST_SPEC, edits: false, run: list_block };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
/// Units of length that differ by less than this share are one.
const SAME_UNIT: f64 = 1e-3;
const NEW: ValueSpec = ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the piece");
const NEW_OR_NONE: ValueSpec = NEW.or("PIECE1, PIECE2 ..");

static SURFACE_SPEC: CommandSpec = CommandSpec {
    opens: Opens::Menu(&menu::SURFACE),
    detail: PIECE_HELP,
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20 -PERM 1\nBLOCK POOL 180 -10 0 220 10 20 -PERM -1\n\
              LIST_BLOCK\nEND_&SURFACE\n&STATUS PIECES",
    ..CommandSpec::new("&SURFACE", "opens the menu of surfaces, up to END")
};

static BLOCK_OPTIONS: [OptionSpec; OPTIONS.len() + PLACING.len()] = join_options(&OPTIONS, &PLACING);

static BLOCK_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    opens: Opens::Short(&menu::BLOCK, 1),
    data: &[
        NEW_OR_NONE,
        number("X1", Dim::Length, "a corner of a box").or("PLANE or PANEL records follow, up to END_BLOCK"),
        number("Y1", Dim::Length, "a corner of a box").or("as X1"),
        number("Z1", Dim::Length, "a corner of a box").or("as X1"),
        number("X2", Dim::Length, "the corner opposite").or("as X1"),
        number("Y2", Dim::Length, "the corner opposite").or("as X1"),
        number("Z2", Dim::Length, "the corner opposite").or("as X1"),
    ],
    options: &BLOCK_OPTIONS,
    detail: PLACING_HELP,
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK COLUMN -BOTH -LOCATION 0 0 -60\nPLANE 0 30 -CIRC 200 0 40 17\nEND_BLOCK\nBLOCK HULL 0 -50 0 400 50 20\nBLOCK FIN -CS_WIND 0 0 0\nPANEL 0 0 -3  3 0 -3  0 3 -3\n\
              PANEL 0 0 -3  0 0 -1  3 0 -3\nPANEL 0 0 -3  0 3 -3  0 0 -1\nPANEL 3 0 -3  0 0 -1  0 3 -3\nEND_BLOCK\nEND\n&STATUS PIECES",
    ..CommandSpec::new(
        "BLOCK",
        "a box by two corners (ours: BLOCK [NAME] X1 Y1 Z1 X2 Y2 Z2), or sections (PLANE) or panels up to END_BLOCK",
    )
};

const FORMAT: OptionSpec =
    OptionSpec::new("-FORMAT", &[ValueSpec::choice::<MeshKind>("FORMAT", "format of the file")], "format of the file")
        .owner(Owner::Ours)
        .default("as the ending of its name says");
const SCALE: OptionSpec = OptionSpec::new(
    "-SCALE",
    &[number("S", Dim::None, "long length units of &DIMEN in a unit of the file").positive()],
    "size of the file's unit",
)
.owner(Owner::Ours)
.default("1");
const MOVE: OptionSpec = OptionSpec::new("-MOVE", &PLACE, "places the mesh in the part").owner(Owner::Ours);

/// What a mesh of a file takes besides.
const OF_FILE: &[OptionSpec] = &[FORMAT, SCALE, MOVE];
static MESH_OPTIONS: [OptionSpec; OPTIONS.len() + OF_FILE.len()] = join_options(&OPTIONS, OF_FILE);

static MESH_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    opens: Opens::Short(&menu::MESH, 1),
    data: &[
        NEW_OR_NONE,
        ValueSpec::new("FILE", Kind::File, "mesh file; looked for where it says, then beside the script")
            .or("PANEL records follow, up to END_MESH"),
    ],
    options: &MESH_OPTIONS,
    detail: "MESH NAME FILE reads an STL file (text or binary), a WAMIT GDF file, or a Wavefront OBJ file, complete in one record; \
             its numbers are lengths in the unit of &DIMEN times -SCALE (3.280839895 reads a file in metres where &DIMEN says feet). A mesh whose \
             open sides all lie at z = 0, as that of a wetted surface, goes on there by upright walls as high as it is deep, with a plane above them. MESH and MESH NAME open \
             a menu up to END_MESH or END, of PANEL records alone, or of VERTEX records and PANELs that name them (&HELP VERTEX).",
    example: "&FILE OPEN M tet.obj\n&FILE WRITE M v 0 0 0\n&FILE WRITE M v 30 0 0\n&FILE WRITE M v 0 30 0\n&FILE WRITE M v 0 0 30\n\
              &FILE WRITE M f 1 3 2\n&FILE WRITE M f 1 2 4\n&FILE WRITE M f 1 4 3\n&FILE WRITE M f 2 3 4\n&FILE CLOSE M\n\
              &DESCRIBE BODY TET\n&SURFACE\nMESH SKIN job.ans/tet.obj -SCALE 2\nMESH FIN\nPANEL 0 0 -3  3 0 -3  0 3 -3\nPANEL 0 0 -3  0 0 -1  3 0 -3\n\
              PANEL 0 0 -3  0 3 -3  0 0 -1\nPANEL 3 0 -3  0 0 -1  0 3 -3\nEND_MESH\nEND\n&STATUS PIECES",
    ..CommandSpec::new("MESH", "a surface of a file, or of panels")
};

static TUBE_OPTIONS: [OptionSpec; OPTIONS.len() + member::OPTIONS.len()] = join_options(&OPTIONS, &member::OPTIONS);

static TUBE_SPEC: CommandSpec = CommandSpec {
    owner: Owner::Ours,
    menus: &[&menu::SURFACE],
    data: &[
        NEW,
        ValueSpec::new("*P1", Kind::Name(Noun::Point), "centre of one end"),
        ValueSpec::new("*P2", Kind::Name(Noun::Point), "centre of the other end"),
        number("OD", Dim::Section, "outer diameter").positive(),
        number("OD2", Dim::Section, "diameter at the other end: refused where it differs").or("OD").positive(),
    ],
    options: &TUBE_OPTIONS,
    detail: member::TUBE_HELP,
    example: "MEDIT\n&DESCRIBE BODY SPAR\n*BOT 0 0 -300\n*TOP 0 0 50\nEND\n&SURFACE\nTUBE HULL *BOT *TOP 480 -CD 0.7 -CAA 0.64\nEND\n&STATUS PIECES",
    ..CommandSpec::new("TUBE", "a round member that displaces water")
};

static MOVE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    data: &[
        ValueSpec::new("NAME", Kind::Text, "the piece"),
        PLACE[0],
        PLACE[1],
        PLACE[2],
        PLACE[3],
        PLACE[4],
        PLACE[5],
    ],
    detail: "From where it is: first turned about the axes of its part (yaw, pitch, roll as of a body), then shifted.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nMOVE_BLOCK HULL -200\nLIST_BLOCK\nEND",
    ..CommandSpec::new("MOVE_BLOCK", "moves a piece within its part")
};

static LIST_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    detail: "What &STATUS PIECES reports.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK HULL 0 -50 0 400 50 20\nLIST_BLOCK\nEND",
    ..CommandSpec::new("LIST_BLOCK", "lists the pieces")
};

/// EMIT.
pub static EMIT: Command = Command { spec: &EMIT_SPEC, edits: true, run: emit };
/// COPY_BLOCK.
pub static COPY_BLOCK: Command = Command { spec: &COPY_SPEC, edits: true, run: copy_block };
/// REFLECT_BLOCK.
pub static REFLECT_BLOCK: Command = Command { spec: &REFLECT_SPEC, edits: true, run: reflect_block };

/// &EMIT.
pub static EMIT_ANYWHERE: Command = Command { spec: &EMIT_ANYWHERE_SPEC, edits: true, run: emit };
static EMIT_ANYWHERE_SPEC: CommandSpec = CommandSpec { menus: &[], ..CommandSpec { name: "&EMIT", ..EMIT_SPEC } };

static EMIT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MAIN, &menu::INMODEL, &menu::MEDIT, &menu::SURFACE],
    data: &[ValueSpec::new("NAME", Kind::Text, "a surface; wild characters may be used")],
    repeat: 1,
    options: &OPTIONS,
    detail: "A surface given in &SURFACE before any body is described belongs to no body and displaces nothing. EMIT puts it into the part described \
             last, with the options it was given, or with those of EMIT where it has any. Surfaces given while a body is described belong to it already. This is our reading.",
    example: "&SURFACE\nBLOCK COLUMN 0 -5 0 10 5 30\nCOPY_BLOCK COLUMN COLUMN2 50\nEND_&SURFACE\n&DESCRIBE BODY SEMI\nEMIT @\n&STATUS PIECES",
    ..CommandSpec::new("EMIT", "puts surfaces into the part described last")
};
static COPY_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    data: &[
        ValueSpec::new("NAME", Kind::Text, "the piece"),
        ValueSpec::new("NEW", Kind::Name(Noun::New), "name of the copy"),
        PLACE[0],
        PLACE[1],
        PLACE[2],
        PLACE[3],
        PLACE[4],
        PLACE[5],
    ],
    detail: "The copy has the options of the piece and is moved as by MOVE_BLOCK. The order of the data is our reading.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK A 0 -5 0 10 5 20\nCOPY_BLOCK A B 50 0 0\nLIST_BLOCK\nEND",
    ..CommandSpec::new("COPY_BLOCK", "copies a piece and moves the copy")
};
static REFLECT_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::SURFACE],
    data: &[
        ValueSpec::new("NAME", Kind::Text, "the piece"),
        ValueSpec::new("NEW", Kind::Name(Noun::New), "name of the mirror image").or("the piece itself is mirrored"),
    ],
    detail: "Mirrors at y = 0 of the part. The order of the data is our reading.",
    example: "&DESCRIBE BODY TBRG\n&SURFACE\nBLOCK A 0 5 0 10 9 20\nREFLECT_BLOCK A B\nLIST_BLOCK\nEND",
    ..CommandSpec::new("REFLECT_BLOCK", "mirrors a piece to the other side")
};

/// A piece by its name, with the nearest names where there is none.
pub(super) fn known_piece(job: &Job, name: &str, span: Span) -> Outcome<Piece> {
    if let Some((_, piece)) = job.model.piece(name) {
        return Ok(piece.clone());
    }
    let mut error = Diagnostic::error(format!("unknown piece {name}"), span);
    error.help.extend(windlass_base::diagnostic::suggest(name, job.model.names(EntityKind::Piece)));
    Err(error)
}

fn emit(job: &mut Job, call: &Call) -> Outcome<Effect> {
    piece::finish_piece(job);
    let part = Model::key(&piece::current_part(&job.model, call.args.span)?.name);
    for value in &call.args.data {
        let pattern = value.word().unwrap_or_default();
        let fits = |piece: &Piece| matches(&pattern.to_ascii_uppercase(), &piece.name.to_ascii_uppercase());
        let loose = job.model.parts.get_mut(LOOSE_SURFACES);
        let (taken, left): (Vec<Piece>, Vec<Piece>) =
            loose.map(|p| std::mem::take(&mut p.pieces)).unwrap_or_default().into_iter().partition(fits);
        if let Some(loose) = job.model.parts.get_mut(LOOSE_SURFACES) {
            loose.pieces = left;
        }
        if taken.is_empty() {
            let why = match job.model.piece(pattern) {
                // it is where it is to be put
                Some((own, known)) if Model::key(&own.name) == part && call.args.options.is_empty() => {
                    let text = format!("{} belongs to {} already", known.name, own.name);
                    job.remark(text, value.span);
                    continue;
                }
                Some((part, piece)) => format!("{} belongs to {} already", piece.name, part.name),
                None => format!("no surface without a body is called {pattern}"),
            };
            return Err(Diagnostic::error(why, value.span));
        }
        for mut piece in taken {
            if !call.args.options.is_empty() {
                piece = piece::begin_piece(job, &call.args, &piece.name, piece.span, piece.shape)?;
            }
            let name = piece.name.clone();
            if let Some(part) = job.model.parts.get_mut(&part) {
                part.pieces.push(piece);
            }
            job.model.current_piece = Some(name);
            piece::finish_piece(job);
        }
    }
    Ok(Effect::Done)
}

/// Adds a piece made of another one, behind it in its part.
fn add_beside(job: &mut Job, original: &str, made: Piece, span: Span) -> Outcome<()> {
    rule::check(&made.name, None, "piece", span)?;
    if let Some((_, old)) = job.model.piece(&made.name) {
        return Err(
            Diagnostic::error(format!("piece {} exists already", old.name), span).other(old.span, "defined here")
        );
    }
    job.model.free_name(&made.name, &[EntityKind::Body, EntityKind::Part], span)?;
    let part = job.model.piece(original).map(|(part, _)| Model::key(&part.name)).unwrap_or_default();
    let name = made.name.clone();
    if let Some(part) = job.model.parts.get_mut(&part) {
        part.pieces.push(made);
    }
    job.model.current_piece = Some(name);
    piece::finish_piece(job);
    Ok(())
}

fn copy_block(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    const NAME: DatumKey<str> = COPY_SPEC.word("NAME");
    const NEW_NAME: DatumKey<str> = COPY_SPEC.word("NEW");
    let original = known_piece(job, args.word(NAME).unwrap_or_default(), args.position(NAME))?;
    refuse_element(&original, args.position(NAME))?;
    let by = Place::new(args.numbers_or_zero(const { COPY_SPEC.numbers(["X", "Y", "Z", "RX", "RY", "RZ"]) }));
    let made = Piece {
        name: args.word(NEW_NAME).unwrap_or_default().to_string(),
        shape: original.shape.with_displacement(&by),
        span: args.position(NEW_NAME),
        ..original.clone()
    };
    add_beside(job, &original.name, made, args.position(NEW_NAME))?;
    Ok(Effect::Done)
}

/// A form mirrored at y = 0.
fn mirror(shape: &Shape) -> Shape {
    let over = |[x, y, z]: Position| [x, -y, z];
    match shape {
        Shape::Panels(panels) => {
            Shape::Panels(panels.iter().map(|p| p.iter().rev().map(|at| over(*at)).collect()).collect())
        }
        Shape::Block { low: [x, y, z], high: [v, w, u] } => Shape::Block { low: [*x, -w, *z], high: [*v, -y, *u] },
        Shape::Tube { ends, diameter } => Shape::Tube { ends: ends.map(over), diameter: *diameter },
        // the mirror image of a bar has the other hand, and so its width looks the other way
        Shape::Bar { ends, sides: [width, depth] } => {
            Shape::Bar { ends: ends.map(over), sides: [over(*width).map(|x| -x), over(*depth)] }
        }
    }
}

fn reflect_block(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    const NAME: DatumKey<str> = REFLECT_SPEC.word("NAME");
    const NEW_NAME: DatumKey<str> = REFLECT_SPEC.word("NEW");
    let original = known_piece(job, args.word(NAME).unwrap_or_default(), args.position(NAME))?;
    refuse_element(&original, args.position(NAME))?;
    let shape = mirror(&original.shape);
    match args.word(NEW_NAME) {
        Some(new) => {
            let made = Piece { name: new.to_string(), shape, span: args.position(NEW_NAME), ..original.clone() };
            add_beside(job, &original.name, made, args.position(NEW_NAME))?;
        }
        None => {
            if let Some(piece) = job.model.piece_mut(&original.name) {
                piece.shape = shape;
            }
            job.model.current_piece = Some(original.name);
            piece::finish_piece(job);
        }
    }
    Ok(Effect::Done)
}

fn surface(job: &mut Job, call: &Call) -> Outcome<Effect> {
    piece::finish_piece(job);
    if piece::current_part(&job.model, call.args.span).is_err() {
        job.remark(
            "no body is described yet: these surfaces belong to none until EMIT puts them into one",
            call.args.span,
        );
    }
    job.menus.push(Menu::Surface);
    Ok(Effect::Done)
}

/// The first datum of every record that makes a piece.
const PIECE: DatumKey<str> = BLOCK_SPEC.word("NAME");
/// Two opposite corners of a box.
const CORNERS: [DatumKey<f64>; 6] = BLOCK_SPEC.numbers(["X1", "Y1", "Z1", "X2", "Y2", "Z2"]);

/// A piece of a record without a surface: what its records give follows in a menu. Returns its name.
fn begin_menu(job: &mut Job, args: &Args) -> Outcome<String> {
    let name = args.word(PIECE).map_or_else(|| piece::free_piece_name(&job.model), str::to_string);
    let piece = piece::begin_piece(job, args, &name, args.position(PIECE), Shape::Panels(Vec::new()))?;
    piece::add(job, piece, false);
    Ok(name)
}

/// A piece that its record gives whole.
fn whole(job: &mut Job, args: &Args, shape: Shape) -> Outcome<Effect> {
    let piece = piece::begin_piece(job, args, args.word(PIECE).unwrap_or_default(), args.position(PIECE), shape)?;
    piece::add(job, piece, true);
    Ok(Effect::Done)
}

/// The words of a box without a name, with the name it has; `None` of a record of another form.
fn unnamed_box(job: &Job, call: &Call) -> Outcome<Option<Args>> {
    let [command, rest @ ..] = call.words else { return Ok(None) };
    let is_number = |word: &&Word| word.kind != TokenKind::Option && evaluate(&word.text).is_ok();
    if rest.iter().take_while(is_number).count() != CORNERS.len() {
        return Ok(None);
    }
    let name = Word { kind: TokenKind::Word, text: piece::free_piece_name(&job.model).into(), span: command.span };
    let named: Vec<Word> = std::iter::once(name).chain(rest.iter().cloned()).collect();
    args::read(&BLOCK_SPEC, command.span, &named, job.units).map(Some)
}

fn block(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let unnamed = unnamed_box(job, call)?;
    let args = unnamed.as_ref().unwrap_or(args);
    let corners: Vec<f64> = CORNERS.iter().filter_map(|key| args.number(*key)).collect();
    let [x1, y1, z1, x2, y2, z2] = corners.as_slice() else {
        let Some(last) = args.data_after(PIECE).last() else {
            let placing = Placing::from_args(args)?;
            let name = begin_menu(job, args)?;
            job.menus.push(Menu::Block(Box::new(Planes::of_block(&name, placing, args.span))));
            return Ok(Effect::Done);
        };
        return Err(Diagnostic::error("a box has two opposite corners", last.span)
            .label(format!("{} of six coordinates are given", corners.len()))
            .help("form: BLOCK [NAME] X1 Y1 Z1 X2 Y2 Z2"));
    };
    let pairs = [(x1, x2), (y1, y2), (z1, z2)];
    let [.., x, y, z] = CORNERS;
    let mut flat = pairs.iter().zip([("X", x), ("Y", y), ("Z", z)]).filter(|((a, b), _)| a == b);
    if let Some((_, (axis, key))) = flat.next() {
        return Err(Diagnostic::error(format!("the box has no volume: {axis}1 is {axis}2"), args.position(key)));
    }
    let shape = Shape::Block { low: pairs.map(|(a, b)| a.min(*b)), high: pairs.map(|(a, b)| a.max(*b)) };
    let placing = Placing::from_args(args)?;
    if placing == Placing::default() {
        return whole(job, args, shape);
    }
    let piece = piece::begin_piece(job, args, args.word(PIECE).unwrap_or_default(), args.position(PIECE), shape)?;
    add_placed(job, piece, placing)?;
    Ok(Effect::Done)
}

fn mesh(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    const FILE: DatumKey<str> = MESH_SPEC.word("FILE");
    let Some(name) = args.word(FILE) else {
        begin_menu(job, args)?;
        job.menus.push(Menu::Mesh(MeshVertices::default()));
        return Ok(Effect::Done);
    };
    let span = args.position(FILE);
    let MeshFile { mut panels, gravity, .. } = mesh_of(job, args, name, span)?;
    let scale = Dim::Length.to_si(args.option_number(&SCALE).unwrap_or(1.0), job.units);
    if let Some(text) = gravity.and_then(|gravity| other_unit(gravity, scale, job.units)) {
        job.warn(format!("{name}: {text}"), span);
    }
    if close_above_waterline(&mut panels).is_some() {
        let text =
            format!("{name} ends in its waterline, z = 0: upright walls are assumed above it, as high as it is deep");
        job.remark(text, span);
    }
    let largest = panels.iter().flatten().flatten().fold(0.0_f64, |most, x| most.max((scale * x).abs()));
    if largest > Dim::Length.most() {
        let text = format!("{name} cannot be used: a coordinate of {largest:e} m is no ship's");
        return Err(Diagnostic::error(text, span).help("-SCALE gives its unit"));
    }
    let scaled = panels.into_iter().map(|p| p.into_iter().map(|at| at.map(|x| scale * x)).collect()).collect();
    let by = args.option(&MOVE).map_or(Place::default(), |given| {
        Place::new(given.numbers_or_zero(const { MOVE.numbers(["X", "Y", "Z", "RX", "RY", "RZ"]) }))
    });
    whole(job, args, Shape::Panels(scaled).with_displacement(&by))
}

/// What is said where the gravity of a mesh file is of another unit of length than that (m) in which it is read.
fn other_unit(gravity: f64, unit: f64, units: UnitSystem) -> Option<String> {
    let (own, name) = match gravity {
        9.0..10.5 => (1.0, "metres"),
        30.0..34.0 => (METRES_PER_FOOT, "feet"),
        _ => return None,
    };
    ((unit / own - 1.0).abs() > SAME_UNIT).then(|| {
        let scale = own / Dim::Length.to_si(1.0, units);
        format!("by its gravity of {gravity} it is in {name}, and is read in another unit: -SCALE {scale:.6} reads it in {name}")
    })
}

/// A mesh file, in its own unit.
fn mesh_of(job: &Job, args: &Args, name: &str, span: Span) -> Outcome<MeshFile> {
    let path = existing(job, name, span)?;
    let ending = path.extension().map(|e| e.to_string_lossy().to_ascii_uppercase()).unwrap_or_default();
    let given = args.option_choice(&FORMAT, const { FORMAT.choice("FORMAT") });
    let kind = given.or_else(|| MeshKind::from_word(&ending)).ok_or_else(|| {
        Diagnostic::error(format!("the format of {name} does not follow from its name"), span)
            .help("give -FORMAT STL, GDF or OBJ")
    })?;
    let unusable = |why: String| Diagnostic::error(format!("{name} cannot be used: {why}"), span);
    let bytes =
        crate::commands::settings::device::read_input(job, &path, LARGEST_FILE).map_err(|e| unusable(e.to_string()))?;
    let file = read_mesh(kind, &bytes).map_err(|e| unusable(e.to_string()))?;
    if file.panels.is_empty() { Err(unusable("it has no panels".into())) } else { Ok(file) }
}

fn tube(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    let part = piece::current_part(&job.model, args.span)?;
    const SECOND: DatumKey<str> = TUBE_SPEC.word("*P2");
    const DIAMETER: DatumKey<f64> = TUBE_SPEC.number("OD");
    const OTHER_DIAMETER: DatumKey<f64> = TUBE_SPEC.number("OD2");
    let end = |key: DatumKey<str>| {
        piece::point_in_part(&job.model, args.word(key).unwrap_or_default(), part, args.position(key))
    };
    let ends = [end(const { TUBE_SPEC.word("*P1") })?, end(SECOND)?];
    if ends[0] == ends[1] {
        return Err(Diagnostic::error("a tube needs two points at different places", args.position(SECOND)));
    }
    if args.number(OTHER_DIAMETER).is_some_and(|other| Some(other) != args.number(DIAMETER)) {
        return Err(Diagnostic::error(
            "a TUBE has one diameter: tapers are not supported",
            args.position(OTHER_DIAMETER),
        )
        .help("divide it into TUBEs of steps in diameter; PGEN makes a cone that floats, without a member's forces"));
    }
    whole(job, args, Shape::Tube { ends, diameter: args.number(DIAMETER).unwrap_or_default() })
}

fn move_block(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let args = &call.args;
    const NAME: DatumKey<str> = MOVE_SPEC.word("NAME");
    let name = args.word(NAME).unwrap_or_default();
    if let Some((_, piece)) = job.model.piece(name) {
        refuse_element(piece, args.position(NAME))?;
    }
    let by = Place::new(args.numbers_or_zero(const { MOVE_SPEC.numbers(["X", "Y", "Z", "RX", "RY", "RZ"]) }));
    let known = job.model.names(windlass_model::EntityKind::Piece);
    let help = windlass_base::diagnostic::suggest(name, known);
    let Some(Piece { shape, name, .. }) = job.model.piece_mut(name) else {
        let mut error = Diagnostic::error(format!("unknown piece {name}"), args.position(NAME));
        error.help.extend(help);
        return Err(error);
    };
    *shape = shape.with_displacement(&by);
    job.model.current_piece = Some(name.clone());
    piece::finish_piece(job);
    Ok(Effect::Done)
}

fn list_block(job: &mut Job, _: &Call) -> Outcome<Effect> {
    let table = pieces(&job.model, &|_| true);
    let units = job.units;
    job.say_fitted(|width| page::grid(&table, units, width).join("\n"));
    Ok(Effect::Done)
}

/// VERTEX.
pub static VERTEX: Command = Command { spec: &VERTEX_SPEC, edits: false, run: vertex };

static VERTEX_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::MESH],
    form: TextForm::Text,
    data: &[
        ValueSpec::new("NAME", Kind::Text, "its name or number").or("1, 2 ..; X Y Z alone are three numbers"),
        number("X", Dim::Length, "x in the part"),
        number("Y", Dim::Length, "y in the part"),
        number("Z", Dim::Length, "z in the part"),
    ],
    detail: "VERTEX X Y Z, or VERTEX NAME X Y Z. The panels that follow in the same MESH name vertices: PANEL 1 2 3 4. All vertices come before \
             the first panel; coordinates in PANEL are then not taken. The words are our reading: [MOSES-REF surface] says only that vertices are \
             defined before the panels.",
    example: "&DESCRIBE BODY TET\n&SURFACE\nMESH SKIN\nVERTEX 0 0 0\nVERTEX 30 0 0\nVERTEX 0 30 0\nVERTEX TOP 0 0 30\nPANEL 1 3 2\nPANEL 1 2 TOP\n\
              PANEL 1 TOP 3\nPANEL 2 3 TOP\nEND_MESH\nLIST_BLOCK\nEND",
    ..CommandSpec::new("VERTEX", "a vertex of a mesh")
};

static THREE_NUMBERS: CommandSpec = CommandSpec {
    form: TextForm::Words,
    data: &[
        number("X", Dim::Length, "x in the part"),
        number("Y", Dim::Length, "y in the part"),
        number("Z", Dim::Length, "z in the part"),
    ],
    ..VERTEX_SPEC
};

fn vertex(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let [command, rest @ ..] = call.words else { return Ok(Effect::Done) };
    let (name, coordinates) = match rest {
        [name, x @ ..] if x.len() > 2 => (Some(name), x),
        x => (None, x),
    };
    let read = args::read(&THREE_NUMBERS, command.span, coordinates, job.units)?;
    let at = read.numbers_or_zero(const { THREE_NUMBERS.numbers(["X", "Y", "Z"]) });
    let has_panels = job
        .model
        .current_piece
        .as_ref()
        .and_then(|name| job.model.piece(name))
        .is_some_and(|(_, piece)| matches!(&piece.shape, Shape::Panels(panels) if !panels.is_empty()));
    if has_panels {
        return Err(Diagnostic::error("vertices come before the panels of a mesh", command.span));
    }
    let Some(Menu::Mesh(vertices)) = job.menus.last_mut() else { return Ok(Effect::Done) };
    let key = name.map_or_else(|| (vertices.len() + 1).to_string(), |name| name.text.to_ascii_uppercase());
    if vertices.contains_key(&key) {
        return Err(Diagnostic::error(format!("vertex {key} is given already"), name.map_or(command.span, |n| n.span)));
    }
    vertices.insert(key, at);
    Ok(Effect::Done)
}
