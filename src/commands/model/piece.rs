//! Pieces of a hull: the options all of them take, `PANEL`, and what is checked when a piece is complete.
//!
//! Source: [MOSES-REF pieces].

use crate::commands::menu;
use crate::commands::model::{member, weight};
use crate::commands::model_values::option_as_written;
use crate::commands::{Call, Command, Effect, Job, Menu};
use nalgebra::Vector3;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome, did_you_mean};
use windlass_base::geometry::{Place, Position};
use windlass_base::span::Span;
use windlass_base::units::{Dim, UnitSystem};
use windlass_base::values::{Args, Given, Noun, Value};
use windlass_hydro as hydro;
use windlass_language::args;
use windlass_language::name as rule;
use windlass_language::spec::{CommandSpec, Kind, OptionEffect, OptionSpec, TextForm, ValueSpec};
use windlass_language::token::TokenKind as Lex;
use windlass_model::{
    EntityKind, GROUND, LOOSE_SURFACES, Model, Part, Piece, Shape, SolveKind, UnmodelledEffect, WaveAction, find,
};

/// PANEL.
pub static PANEL: Command = Command { spec: &PANEL_SPEC, edits: false, run: panel };

const fn number(name: &'static str, dim: Dim, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(dim), help)
}
const FACTORS: &[ValueSpec] = &[
    number("X", Dim::None, "factor in the part's x").not_negative(),
    number("Y", Dim::None, "factor in the part's y").not_negative(),
    number("Z", Dim::None, "factor in the part's z").not_negative(),
];
/// What holds without -CS_WIND and -CS_CURRENT.
const CS: &str = "1 1 1; 0 0 0 of a piece that displaces no water";
const FACTOR: &[ValueSpec] = &[number("F", Dim::None, "factor").not_negative()];

const PERMEABILITY: OptionSpec = OptionSpec::new(
    "-PERMEABILITY",
    &[number("P", Dim::None, "1 exterior, -1 interior open to the sea, or a fraction").in_range(-1.0, 1.0)],
    "share of the volume that displaces water",
)
.default("1");
const CS_WIND: OptionSpec =
    OptionSpec::new("-CS_WIND", FACTORS, "shape coefficients of the wind force along the part's x y z").default(CS);
/// `-CS_CURRENT`.
pub(crate) const CS_CURRENT: OptionSpec =
    OptionSpec::new("-CS_CURRENT", FACTORS, "shape coefficients of the current force along the part's x y z")
        .default(CS);
const OBSTACLE: OptionSpec = OptionSpec::new(
    "-OBSTACLE",
    &[],
    "a piece that does not move with the body: no buoyancy, wind or current of it acts on the body",
)
.stops(SolveKind::Motions, "what a fixed obstacle does to waves");
choices! {
    /// What waves do to a piece.
    enum DiffractionType {
        /// It is in the hull of a hydrodynamic database.
        Database = "3DDIF",
        /// Strip theory.
        Strip = "STRIP",
        /// A tube is a member; another piece feels nothing, and `G_PRESSURE` leaves it out.
        None = "NONE",
        /// Pressure of the waves as they are without it.
        FroudeKrylov = "FK",
    }
}

const DIFTYPE: OptionSpec = OptionSpec::new(
        "-DIFTYPE",
        &[ValueSpec::choice::<DiffractionType>(
            "TYPE",
            "3DDIF: in the hull of a hydrodynamic database; STRIP: by strip theory, which is not computed; NONE: nothing, not by G_PRESSURE either, but a TUBE is a member; FK (ours): the pressure of waves it does not change",
        )],
        "what waves do to it",
    )
    .default("a TUBE is a member; any other piece feels no waves until G_PRESSURE takes it into its hull");
const CS_VELOCITY: OptionSpec = OptionSpec::new(
    "-CS_VELOCITY",
    &[ValueSpec::new("NAME", Kind::Name(Noun::Curve), "curve of factors by velocity")],
    "factors of drag by velocity",
)
.stops(SolveKind::Statics, "drag factors by velocity");
const DD_MULT: OptionSpec = OptionSpec::new(
    "-DD_MULT",
    &[number(
        "F",
        Dim::None,
        "factor of the whole; or ratios, each with a factor there, which stop the next solve of motions",
    )
    .not_negative()],
    "factor of the wave drift damping of the body, and of what a current changes of its mean drift; 0 leaves both out",
)
.repeating(1)
.default("1: both act where the database of the body has mean drift");
const AMASS: OptionSpec = OptionSpec::new(
    "-AMASS",
    &[
        number("M", Dim::None, "factor of added mass").not_negative(),
        ValueSpec::new("CURVE", Kind::Name(Noun::Curve), "curve of pressures").or("none"),
    ],
    "added mass by pressures",
)
.stops(SolveKind::Motions, "added mass by a curve of pressures");
const TANAKA: OptionSpec = OptionSpec::new("-TANAKA", FACTOR, "factor of the eddy damping of roll: &HELP #TANAKA");
const ROLL_DAMPING: OptionSpec = OptionSpec::new("-ROLL_DAMPING", FACTOR, "factor of roll damping")
    .stops(SolveKind::Motions, "viscous damping of roll");
const LOOK: &[ValueSpec] = &[ValueSpec::new("DATA", Kind::Item, "as in MOSES")];
const COLOR: OptionSpec =
    OptionSpec::new("-COLOR", LOOK, "colours and their shares, in pictures").repeating(1).without_effect();
const TEXTURE: OptionSpec =
    OptionSpec::new("-TEXTURE", LOOK, "texture and its scales, in pictures").repeating(1).without_effect();

const OWN_PANELS: OptionSpec = OptionSpec::ours(
    "-OWN_PANELS",
    &[],
    "G_PRESSURE takes its panels as they are: cut at the water, divided by -PANEL alone; it is the only hull piece of its body",
);

/// What every piece takes, however its surface is given.
pub const OPTIONS: [OptionSpec; 13] = [
    PERMEABILITY,
    CS_WIND,
    CS_CURRENT,
    OBSTACLE,
    DIFTYPE,
    OWN_PANELS,
    CS_VELOCITY,
    DD_MULT,
    AMASS,
    TANAKA,
    ROLL_DAMPING,
    COLOR,
    TEXTURE,
];

/// How pieces are read, for the help of the commands that make them.
pub const PIECE_HELP: &str = "A piece belongs to the part described last and is given in its system. Its surface must be closed; \
     the corners of its panels go round the same way seen from outside, all counterclockwise or all clockwise. When it is \
     complete it is checked. Open edges and panels that look the wrong way are warned of with their places, and a body with such a \
     piece has no buoyancy until it is corrected; panels that cut each other and pieces that overlap are warned of, and count \
     twice where they do. With -PERMEABILITY 1 the volume displaces water, with \
     -1 it is taken off again (a moonpool, a flooded tank), with 0 the surface is for wind and current alone. Wind pushes on \
     what of a piece is above the water, current on what is below it: along each axis of the part with 1/2 rho CS A |v| v, where v \
     is the stream's component along that axis, |v| its whole speed, and A the area projected along it, half of what is seen \
     from its two sides (a hollow counts as if nothing sheltered it). |v| v is integrated over the height, by the profiles of \
     &ENV. CS is 1 1 1 where it is not given, so that wind in force is never without effect on a hull; -CS_WIND 0 0 0 turns it \
     off. A piece of permeability 0 or less takes none unless CS is given, an interior (less than 0) never. Tubes are \
     prisms of 64 sides for it. -DD_MULT multiplies the wave drift damping of the body (&HELP DATABASE). -CS_VELOCITY stops the next solve, -OBSTACLE, -AMASS and \
     -ROLL_DAMPING the next solve of motions, as their effect is not computed (&HELP &PARAMETER); -COLOR and -TEXTURE are for pictures. Under way in waves a TUBE is a member by Morison's formula (&HELP TUBE). Any other piece feels no waves of first order, \
     and keeps the buoyancy of the mean level, unless a hydrodynamic database holds it (-DIFTYPE 3DDIF) or it has -DIFTYPE FK: then the \
     pressure that the waves have without it is integrated up to their surface, without diffraction and radiation. TDOM warns of pieces \
     that feel none. &STATUS PIECES lists CS, &STATUS LOADS the forces.";

static PANEL_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT, &menu::BLOCK, &menu::MESH],
    form: TextForm::Text,
    data: &[ValueSpec::new("*P", Kind::Name(Noun::Point), "a corner: a point, or X Y Z")],
    repeat: 1,
    detail: "PANEL *P1 *P2 *P3 [*P4 ..] or PANEL X1 Y1 Z1 X2 Y2 Z2 X3 Y3 Z3 ..: a panel of the piece described last by &DESCRIBE \
             PIECE, BLOCK or MESH. Three or more corners, round the panel, in the system of the part; points of another part of \
             the same body are taken where they stand. What counts is where a point stands when the record is read.",
    example: "MEDIT\n&DESCRIBE BODY TET\n*O 0 0 0\n*X 3 0 0\n*Y 0 3 0\n*Z 0 0 3\n&DESCRIBE PIECE SKIN\nPANEL *O *Y *X\n\
              PANEL *O *X *Z\nPANEL *O *Z *Y\nPANEL 3 0 0  0 3 0  0 0 3\nEND\n&STATUS PIECES",
    ..CommandSpec::new("PANEL", "a panel of a piece, by points or coordinates")
};

static BY_POINTS: CommandSpec = CommandSpec { form: TextForm::Words, ..PANEL_SPEC };
static BY_VERTICES: CommandSpec = CommandSpec {
    form: TextForm::Words,
    data: &[ValueSpec::new("VERTEX", Kind::Text, "a corner: a vertex")],
    ..PANEL_SPEC
};
static BY_COORDINATES: CommandSpec = CommandSpec {
    form: TextForm::Words,
    data: &[
        number("X", Dim::Length, "x of a corner"),
        number("Y", Dim::Length, "y of a corner"),
        number("Z", Dim::Length, "z of a corner"),
    ],
    repeat: 3,
    ..PANEL_SPEC
};

fn panel(job: &mut Job, call: &Call) -> Outcome<Effect> {
    let [command, rest @ ..] = call.words else { return Ok(Effect::Done) };
    let vertices = match job.menu() {
        Menu::Mesh(vertices) if !vertices.is_empty() => Some(vertices),
        _ => None,
    };
    let by_points = vertices.is_some() || rest.first().is_some_and(|w| w.kind == Lex::Point);
    let spec = match (vertices, by_points) {
        (Some(_), _) => &BY_VERTICES,
        (None, true) => &BY_POINTS,
        (None, false) => &BY_COORDINATES,
    };
    let args = args::read(spec, command.span, rest, job.units)?;
    let name = job.model.current_piece.clone().ok_or_else(|| {
        Diagnostic::error("a panel belongs to a piece, and none is described", command.span)
            .help("&DESCRIBE PIECE NAME describes one")
    })?;
    if let Menu::Block(planes) = job.menu()
        && planes.has_sections()
    {
        return Err(Diagnostic::error(format!("piece {name} is given by sections already"), command.span));
    }
    let found = job.model.piece(&name).filter(|(_, piece)| matches!(piece.shape, Shape::Panels(_)));
    let Some((part, _)) = found else {
        return Err(Diagnostic::error(format!("piece {name} is not made of panels"), command.span));
    };
    let corners: Vec<Position> = if let Some(vertices) = vertices {
        let named = |value: &Value| {
            let word = value.word().unwrap_or_default();
            vertices.get(&word.to_ascii_uppercase()).copied().ok_or_else(|| {
                let mut error = Diagnostic::error(format!("unknown vertex {word}"), value.span);
                error.help.extend(did_you_mean(word, vertices.keys().map(String::as_str)));
                error.help("the panels of a MESH with VERTEX records name its vertices")
            })
        };
        args.data.iter().map(named).collect::<Outcome<_>>()?
    } else if by_points {
        let points = args.data.iter().filter_map(|v| Some((v.word()?, v.span)));
        points.map(|(word, span)| point_in_part(&job.model, word, part, span)).collect::<Outcome<_>>()?
    } else {
        let corner = const { BY_COORDINATES.numbers(["X", "Y", "Z"]) };
        args.groups_from(const { BY_COORDINATES.number("X") }).map(|group| group.numbers_or_zero(corner)).collect()
    };
    if corners.len() < 3 {
        return Err(Diagnostic::error("a panel has three or more corners", command.span)
            .label(format!("this one has {}", corners.len())));
    }
    if area(&corners) == 0.0 {
        return Err(Diagnostic::error("the panel has no area", command.span).label("its corners lie on one line"));
    }
    if let Some(Piece { shape: Shape::Panels(panels), .. }) = job.model.piece_mut(&name) {
        panels.push(corners);
    }
    Ok(Effect::Done)
}

/// Area of a polygon, of one that is not plane that of its projection along its mean normal (m2); zero where rounding is all
/// there is.
pub fn area(corners: &[Position]) -> f64 {
    let Some(first) = corners.first().map(|at| Vector3::from(*at)) else { return 0.0 };
    let arms: Vec<Vector3<f64>> = corners.iter().map(|at| Vector3::from(*at) - first).collect();
    let normal: Vector3<f64> = arms.windows(2).map(|w| w[0].cross(&w[1])).sum();
    let size = arms.iter().map(|a| a.norm_squared()).fold(0.0, f64::max);
    if normal.norm() <= 1e-12 * size { 0.0 } else { 0.5 * normal.norm() }
}

/// Where a point stands in a part (m).
///
/// # Errors
/// An unknown point, or one of another body.
pub fn point_in_part(model: &Model, name: &str, part: &Part, span: Span) -> Outcome<Position> {
    let point = find(&model.points, name, "point", span)?;
    let loose = part.name == LOOSE_SURFACES && Model::key(&point.part) == GROUND;
    if loose || Model::key(&point.part) == Model::key(&part.name) {
        return Ok(point.at);
    }
    let own = model.parts.get(&Model::key(&point.part)).filter(|p| Model::key(&p.body) == Model::key(&part.body));
    let own = own.ok_or_else(|| {
        Diagnostic::error(format!("{} is not a point of body {}", point.name, part.body), span)
            .label(format!("it belongs to {}", model.body_of(point).map_or("the ground", |b| &b.name)))
            .other(point.span, "defined here")
    })?;
    let in_body = Vector3::from(own.position.apply(point.at));
    Ok((part.position.rotation().inverse() * (in_body - Vector3::from(part.position.shift))).into())
}

/// The first of PIECE1, PIECE2 .. that nothing is called.
pub fn free_piece_name(model: &Model) -> String {
    free_name_from(model, "PIECE", 1)
}

/// The first of a word with the numbers from one on that nothing is called.
pub fn free_name_from(model: &Model, word: &str, first: usize) -> String {
    let taken = |name: &str| model.piece(name).is_some() || model.free_name(name, &[], Span::default()).is_err();
    (first..).map(|n| format!("{word}{n}")).find(|name| !taken(name)).unwrap_or_default()
}

/// The part described last.
///
/// # Errors
/// None is described yet.
pub fn current_part(model: &Model, span: Span) -> Outcome<&Part> {
    let part = model.current_part.as_ref().and_then(|name| model.parts.get(&Model::key(name)));
    part.ok_or_else(|| {
        Diagnostic::error("a piece belongs to a body, and none is described yet", span)
            .help("&DESCRIBE BODY describes one")
    })
}

/// What an option of a piece would change that no solver computes; none of what is for pictures alone.
fn unmodelled_effect(given: &Given, piece: &str, units: UnitSystem) -> Option<UnmodelledEffect> {
    let (matters_to, effect) = match given.option.effect {
        _ if given.is(&DIFTYPE) => (SolveKind::Motions, "strip theory of waves"),
        _ if given.is(&DD_MULT) => (SolveKind::Motions, "factors by ratio; a factor alone acts"),
        OptionEffect::Stops(kind, effect) => (kind, effect),
        OptionEffect::Acts | OptionEffect::Noted => return None,
    };
    let record = format!("{} of piece {piece}", option_as_written(given, units));
    Some(UnmodelledEffect { record, effect: effect.into(), matters_to, span: given.span })
}

/// A new piece of the part described last, with the options of its record; it is not yet in the model.
///
/// # Errors
/// A name that is taken, no part, an unknown curve.
pub fn begin_piece(job: &mut Job, args: &Args, name: &str, span: Span, shape: Shape) -> Outcome<Piece> {
    rule::check(name, None, "piece", span)?;
    let model = &job.model;
    if !job.menus.iter().any(|menu| matches!(menu, Menu::Surface)) {
        current_part(model, span)?;
    }
    if let Some((_, old)) = model.piece(name) {
        return Err(Diagnostic::error(format!("piece {} exists already", old.name), span)
            .other(old.span, "defined here")
            .help(format!("DELETE {} first, or use another name", old.name)));
    }
    model.free_name(name, &[EntityKind::Body, EntityKind::Part, EntityKind::Compartment], span)?;
    let own = args.options.iter().filter(|given| given.is_any(&OPTIONS));
    for value in own.clone().flat_map(|g| g.names(Noun::Curve)) {
        if let Some(word) = value.word() {
            find(&model.curves, word, "curve", value.span)?;
        }
    }
    let acting = [PERMEABILITY, CS_WIND, CS_CURRENT, DIFTYPE, OWN_PANELS, DD_MULT, TANAKA];
    let by_ratio = |given: &Given| given.is(&DD_MULT) && given.numbers().len() > 1;
    let chosen = args.option_choice(&DIFTYPE, const { DIFTYPE.choice("TYPE") });
    let is_strip = chosen == Some(DiffractionType::Strip);
    let kept: Vec<_> = own
        .filter(|given| !given.is_any(&acting) || (is_strip && given.is(&DIFTYPE)) || by_ratio(given))
        .cloned()
        .collect();
    let unmodelled: Vec<_> = kept.iter().filter_map(|given| unmodelled_effect(given, name, job.units)).collect();
    for effect in &unmodelled {
        job.remark(format!("not computed: {}; solves it matters to will stop", effect.sentence()), effect.span);
    }
    let compartment = job.model.current_compartment.clone();
    let in_tank = compartment.is_some();
    if let Some(given) = args.option(&DIFTYPE).filter(|_| in_tank && chosen != Some(DiffractionType::None)) {
        return Err(Diagnostic::error("waves do nothing to a compartment: its pieces have -DIFTYPE NONE", given.span));
    }
    let is_obstacle = args.has(&OBSTACLE);
    let permeability =
        if is_obstacle { 0.0 } else { args.option_number(&PERMEABILITY).unwrap_or(if in_tank { -1.0 } else { 1.0 }) };
    let member = (matches!(shape, Shape::Tube { .. }) && !in_tank)
        .then(|| member::coefficients(args, permeability, &job.model.parameters))
        .transpose()?;
    let category = member.is_some().then(|| weight::category_of(args));
    let waves = match chosen {
        Some(DiffractionType::Database) => WaveAction::Database,
        Some(DiffractionType::FroudeKrylov) if member.is_none() => WaveAction::Pressure,
        Some(DiffractionType::None) if member.is_none() => WaveAction::Nothing,
        Some(DiffractionType::FroudeKrylov | DiffractionType::Strip | DiffractionType::None) | None => {
            WaveAction::ByForm
        }
    };
    let usual = if permeability > 0.0 && !in_tank { [1.0; 3] } else { [0.0; 3] };
    let tube_wind =
        job.model.parameters.tube_wind.filter(|_| member.is_some() && permeability > 0.0 && !args.has(&CS_WIND));
    // a member's drag is its own, unless -CS_CURRENT says other
    let by_area = member.is_none() || args.has(&CS_CURRENT);
    let mut factors = |option: &OptionSpec| {
        let given = args.option(option).map(|given| {
            (given.span, const { CS_WIND.numbers(["X", "Y", "Z"]) }.map(|key| given.number(key).unwrap_or(1.0)))
        });
        if let Some((at, _)) = given.filter(|(_, cs)| (permeability < 0.0 || in_tank) && *cs != [0.0; 3]) {
            job.remark(format!("an interior takes no wind and no current: {} of {name} is 0 0 0", option.name), at);
            return usual;
        }
        given.map_or(usual, |(_, cs)| cs)
    };
    Ok(Piece {
        name: name.to_string(),
        permeability,
        shape,
        cs_wind: tube_wind.map_or_else(|| factors(&CS_WIND), |cs| [cs; 3]),
        cs_current: if by_area { factors(&CS_CURRENT) } else { [0.0; 3] },
        member,
        element: None,
        category,
        waves,
        own_panels: args.has(&OWN_PANELS),
        eddy_damping: args.option_number(&TANAKA).unwrap_or(0.0),
        drift_damping: args.option(&DD_MULT).filter(|given| !by_ratio(given)).and_then(|given| given.first_number()),
        kept,
        unmodelled,
        compartment,
        span,
    })
}

/// Puts a piece into the part described last; `complete` when nothing more is to come, so that it is checked.
pub fn add(job: &mut Job, piece: Piece, complete: bool) {
    finish_piece(job);
    let (name, span) = (piece.name.clone(), piece.span);
    let part = job.model.current_part.as_ref().map_or_else(|| LOOSE_SURFACES.to_string(), |p| Model::key(p));
    if part == LOOSE_SURFACES {
        let loose = Part::new(LOOSE_SURFACES, "", Place::default(), span);
        job.model.parts.entry(part.clone()).or_insert(loose);
    }
    if let Some(part) = job.model.parts.get_mut(&part) {
        part.pieces.push(piece);
    }
    job.note_name(&name, span);
    job.model.current_piece = Some(name);
    if complete {
        finish_piece(job);
    }
}

/// A record begins something else: the piece whose panels were being given is complete. Its faults are warned of.
pub fn finish_piece(job: &mut Job) {
    let found = complete_piece(job, None);
    job.notices.extend(found);
}

/// The piece whose panels were being given is complete: what is wrong with it, at the record that completes it, else at its name. In `&SURFACE`, where a record to
/// come may make one piece of two, it is held against the others at the end of the menu.
pub fn complete_piece(job: &mut Job, at: Option<Span>) -> Vec<Diagnostic> {
    let Some((name, mut found)) = take_current(job, at) else { return Vec::new() };
    if job.menus.iter().any(|menu| matches!(menu, Menu::Surface)) {
        await_comparison(job, name);
    } else {
        found.extend(overlaps(job, &name, &[], at));
    }
    found
}

/// The end of `&SURFACE`: its last piece is complete, and those that it made are held against the others of their bodies, each pair once.
pub fn finish_surface(job: &mut Job, at: Option<Span>) -> Vec<Diagnostic> {
    let mut found = Vec::new();
    if let Some((name, own)) = take_current(job, at) {
        await_comparison(job, name);
        found = own;
    }
    let names = std::mem::take(&mut job.uncompared_pieces);
    let mut later = names.as_slice();
    while let [name, rest @ ..] = later {
        found.extend(overlaps(job, name, rest, None));
        later = rest;
    }
    found
}

/// The piece of a body whose panels were being given, which is given no longer, and what is wrong with it by itself.
fn take_current(job: &mut Job, at: Option<Span>) -> Option<(String, Vec<Diagnostic>)> {
    let name = job.model.current_piece.take()?;
    let (part, piece) = job.model.piece(&name)?;
    job.model.bodies.get(&Model::key(&part.body))?;
    let faults = hydro::piece_faults(part, piece);
    let found = faults.iter().map(|fault| piece_diagnostic(job, fault, piece, at)).collect();
    Some((name, found))
}

fn await_comparison(job: &mut Job, name: String) {
    if !job.uncompared_pieces.contains(&name) {
        job.uncompared_pieces.push(name);
    }
}

/// Where a piece overlaps others of its body, but for those to come.
fn overlaps(job: &Job, name: &str, later: &[String], at: Option<Span>) -> Vec<Diagnostic> {
    let Some((part, piece)) = job.model.piece(name) else { return Vec::new() };
    let Some(body) = job.model.bodies.get(&Model::key(&part.body)) else { return Vec::new() };
    let is_later = |other: &str| later.iter().any(|name| name == other);
    let faults = hydro::piece_overlaps(&job.model, body, part, piece, is_later);
    faults.iter().map(|fault| piece_diagnostic(job, fault, piece, at)).collect()
}

fn piece_diagnostic(job: &Job, fault: &hydro::PieceFault, piece: &Piece, at: Option<Span>) -> Diagnostic {
    let (text, span) = (fault.error.text(job.units), at.unwrap_or(piece.span));
    let diagnostic = if fault.remark { Diagnostic::remark(text, span) } else { Diagnostic::warning(text, span) };
    *if at.is_some() { diagnostic.other(piece.span, "the piece") } else { diagnostic }
}
