//! `PGEN` and `PLANE`: a hull or a tank of sections.
//!
//! Source: [MOSES-REF pieces, surface] for the names; `PLANE 0 91.5 -RECT 0 6.10 27.50` as in [MOSES-RUNS ves_mod/b_tutorial]. What no
//! source says is our reading and stands in the help.

use crate::commands::menu;
use crate::commands::model::describe::PLACE;
use crate::commands::model::piece::{self, OPTIONS};
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::{Place, Position, unit_vector};
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::{Args, Given, Value};
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec, join_options};
use windlass_model::{Model, Piece, Shape, SolveKind, UnmodelledEffect, bar_panels, box_panels};

/// PGEN.
pub static PGEN: Command = Command { spec: &PGEN_SPEC, edits: false, run: pgen };
/// PLANE.
pub static PLANE: Command = Command { spec: &PLANE_SPEC, edits: false, run: plane };

const fn number(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Length), help)
}

const LOCATION: OptionSpec = OptionSpec::new(
    "-LOCATION",
    &PLACE,
    "places the piece in its part: it is turned by yaw, pitch and roll, then shifted",
);
const STBD: OptionSpec =
    OptionSpec::new("-STBD", &[], "the sections are the whole piece, as given: to starboard, y > 0");
const PORT: OptionSpec = OptionSpec::new("-PORT", &[], "the sections mirrored to -y are the whole piece");
const BOTH: OptionSpec =
    OptionSpec::new("-BOTH", &[], "two pieces: the sections as given, and mirrored under the name with a P after it");

/// Where a piece of sections or panels stands, and on which side.
pub const PLACING: [OptionSpec; 4] = [LOCATION, STBD, PORT, BOTH];
static PGEN_OPTIONS: [OptionSpec; OPTIONS.len() + PLACING.len()] = join_options(&OPTIONS, &PLACING);

/// What -LOCATION, -STBD, -PORT and -BOTH mean, for help.
pub const PLACING_HELP: &str = "Without -STBD, -PORT and -BOTH the points of a section with y >= 0 are half of it, from the keel up, and are \
     mirrored to -y. With one of them, in a compartment (&DESCRIBE COMPARTMENT), or where a point of -CARTESIAN has y < 0, the points \
     run once round the whole section, whose last point is joined to its first; -RECTANGLE is then the half with y >= 0 under -STBD, -PORT \
     and -BOTH and the whole without. -PORT and -BOTH mirror in the system of the points; -LOCATION follows. This is our reading.";

static PGEN_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    opens: Opens::Menu(&menu::PGEN),
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the piece")
        .or("the piece described last, where it has no panels yet; else PIECE1, PIECE2 ..")],
    options: &PGEN_OPTIONS,
    detail: "Opens a menu of PLANE records, up to END PGEN or END_PGEN, which makes the panels of the piece: \
             neighbouring sections are joined point by point where they have the same number of points, else by \
             triangles by the share of the outline, and the first and the last section close the ends. &HELP PLANE has the form of a section.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\nPGEN HULL -PERM 1 -CS_WIND 1 1 1\nPLANE 0 400 -RECTANGLE 0 20 100\nEND PGEN\nEND\n\
              &STATUS PIECES\nMEDIT\nPGEN\nPLANE 0 20 -CIRC 0 -30 10 17\nEND\nEND\n&STATUS PIECES",
    ..CommandSpec::new("PGEN", "makes a piece of sections, up to END")
};

const RECTANGLE: OptionSpec = OptionSpec::new(
    "-RECTANGLE",
    &[
        number("ZBOT", "bottom"),
        number("ZTOP", "top"),
        number("BEAM", "whole breadth").positive(),
        ValueSpec::new(
            "NPTS",
            Kind::Integer,
            "points of the half section; further ones divide its edges and change no volume",
        )
        .in_range(2.0, MAX_POINTS)
        .or("its corners"),
    ],
    "a rectangular section, at every X given",
)
.aliases(&["-RECTANGULAR"]);
const CARTESIAN: OptionSpec = OptionSpec::new(
    "-CARTESIAN",
    &[number("Y", "y"), number("Z", "height")],
    "points of the section, at every X given",
)
.repeating(2);
const CIRCULAR: OptionSpec = OptionSpec::new(
    "-CIRCULAR",
    &[
        number("Y", "y of the centre"),
        number("Z", "height of the centre"),
        number("RADIUS", "radius").positive(),
        ValueSpec::new(
            "NPTS",
            Kind::Integer,
            "points on it; of a whole circle the last is the first, so that 9 points make 8 sides",
        )
        .in_range(2.0, MAX_POINTS),
        ValueSpec::new("THETA", Kind::Number(Dim::Angle), "angle of the first point, from +y toward +z")
            .or("-90: the lowest"),
        ValueSpec::new("DTHETA", Kind::Number(Dim::Angle), "angle from point to point")
            .or("360 over NPTS - 1: the whole circle"),
    ],
    "a section of points on a circle, or on an arc of it, at every X given",
);
/// Most points of a section.
const MAX_POINTS: f64 = 1000.0;

static PLANE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::PGEN, &menu::BLOCK],
    data: &[number("X", "where the section is; without an option its points follow: Y1 Z1 Y2 Z2 ..")],
    repeat: 1,
    options: &[RECTANGLE, CARTESIAN, CIRCULAR],
    detail: "PLANE X Y1 Z1 Y2 Z2 .. is the section at X by points of its half with y >= 0, from the keel up; PLANE X1 X2 .. \
             -CARTESIAN Y1 Z1 .., -RECTANGLE and -CIRCULAR give the same section at several X. X grows, or falls, from section to \
             section. Where the first point of a half lies beside y = 0 the bottom is flat from there to its mirror image, and the deck \
             above the last point likewise. A half section may be a line at y = 0, as a stem is. A whole circle is the polygon of its points, \
             within the circle: of 17 points its area is 0.974 of the circle's. The readings are ours: no source gives the number of sides \
             of -CIRCULAR and the order of its values. &HELP PGEN says when points are half a section.",
    example: "MEDIT\n&DESCRIBE BODY SHIP\nPGEN HULL\nPLANE 0 0 0 0 30\nPLANE 60 30 0 40 8 40 30\nPLANE 300 380 -CART 30 0 40 8 40 30\n\
              END PGEN\nPGEN WING -PERM -1 -STBD\nPLANE 320 360 -CART 30 10 39 10 39 28 30 28\nEND PGEN\nEND\n&STATUS PIECES",
    ..CommandSpec::new("PLANE", "a section of a hull")
};

/// A section as its record gives it.
#[derive(Clone, Debug)]
enum HullOutline {
    /// Points with their y and z (m).
    Points(Vec<[f64; 2]>),
    /// A rectangle about y = 0, with the points of its half with y >= 0 from the keel up.
    Rectangle(Vec<[f64; 2]>),
    /// A whole circle, its points once round.
    Circle(Vec<[f64; 2]>),
}

impl HullOutline {
    fn points(&self) -> &[[f64; 2]] {
        match self {
            HullOutline::Points(list) | HullOutline::Rectangle(list) | HullOutline::Circle(list) => list,
        }
    }
}

/// A section: its x and its outline (m).
type HullSection = (f64, HullOutline);
/// A section: its x and points of its half, or all round it (m).
type SectionPoints = (f64, Vec<[f64; 2]>);

/// Which side of the ship sections stand on.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
enum ShipSide {
    /// Half sections are mirrored.
    #[default]
    Mirrored,
    Starboard,
    Port,
    Both,
}

/// Where a piece stands in its part.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Placing {
    position: Option<Place>,
    side: ShipSide,
}

impl Placing {
    /// That of a record.
    ///
    /// # Errors
    /// Two of -STBD, -PORT and -BOTH.
    pub fn from_args(args: &Args) -> Outcome<Placing> {
        let sides = [(STBD, ShipSide::Starboard), (PORT, ShipSide::Port), (BOTH, ShipSide::Both)];
        let mut given = sides.iter().filter_map(|(option, side)| args.option(option).map(|given| (given, *side)));
        let first = given.next();
        if let (Some((first, _)), Some((second, _))) = (first, given.next()) {
            return Err(Diagnostic::error(
                format!("{} and {} contradict each other", first.name(), second.name()),
                second.span,
            ));
        }
        let position = args.option(&LOCATION).map(|given| {
            Place::new(given.numbers_or_zero(const { LOCATION.numbers(["X", "Y", "Z", "RX", "RY", "RZ"]) }))
        });
        Ok(Placing { position, side: first.map_or(ShipSide::Mirrored, |(_, side)| side) })
    }

    /// The pieces that panels make: as they are, mirrored, or both.
    fn sides(&self, panels: Vec<Vec<Position>>) -> Vec<Vec<Vec<Position>>> {
        let mirrored = || panels.iter().map(|p| p.iter().rev().map(|[x, y, z]| [*x, -y, *z]).collect()).collect();
        let sides = match self.side {
            ShipSide::Mirrored | ShipSide::Starboard => vec![panels],
            ShipSide::Port => vec![mirrored()],
            ShipSide::Both => vec![panels.clone(), mirrored()],
        };
        let Some(position) = self.position else { return sides };
        let placed = |panels: Vec<Vec<Position>>| -> Vec<Vec<Position>> {
            panels.into_iter().map(|p| p.into_iter().map(|at| position.apply(at)).collect()).collect()
        };
        sides.into_iter().map(placed).collect()
    }
}

/// What sections are to make.
#[derive(Clone, Debug)]
enum PieceOfSections {
    /// A piece of its own.
    New(Box<Piece>),
    /// The panels of the piece of this name, which is described already.
    Described(String),
}

/// Sections on their way to a piece.
#[derive(Clone, Debug)]
pub struct Planes {
    piece: PieceOfSections,
    sections: Vec<HullSection>,
    placing: Placing,
    span: Span,
    /// A record of it was refused: it makes no surface, and its end says nothing more.
    is_refused: bool,
}

impl Planes {
    /// Those of a piece whose sections or panels follow in a menu of BLOCK.
    pub fn of_block(piece: &str, placing: Placing, span: Span) -> Planes {
        Planes {
            piece: PieceOfSections::Described(piece.to_string()),
            sections: Vec::new(),
            placing,
            span,
            is_refused: false,
        }
    }

    /// Remembers that one of its records was refused.
    pub fn refuse(&mut self) {
        self.is_refused = true;
    }

    /// Whether a section has been given.
    pub fn has_sections(&self) -> bool {
        !self.sections.is_empty()
    }
}

fn pgen(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = PGEN_SPEC.word("NAME");
    let args = &call.args;
    let placing = Placing::from_args(args)?;
    let described = job.model.current_piece.as_ref().and_then(|name| job.model.piece(name));
    let empty = described.filter(|(_, p)| matches!(&p.shape, Shape::Panels(panels) if panels.is_empty()));
    let piece = match (args.word(NAME), empty) {
        (None, Some((_, empty))) => {
            if let Some(given) = args.options.iter().find(|given| !given.is_any(&PLACING)) {
                return Err(Diagnostic::error(
                    format!("{} belongs to &DESCRIBE PIECE {}", given.name(), empty.name),
                    given.span,
                ));
            }
            PieceOfSections::Described(empty.name.clone())
        }
        (name, _) => {
            let name = name.map_or_else(|| piece::free_piece_name(&job.model), str::to_string);
            let begun = piece::begin_piece(job, args, &name, args.position(NAME), Shape::Panels(Vec::new()))?;
            PieceOfSections::New(Box::new(begun))
        }
    };
    job.menus.push(Menu::Planes(Box::new(Planes {
        piece,
        sections: Vec::new(),
        placing,
        span: args.span,
        is_refused: false,
    })));
    Ok(Effect::Done)
}

fn plane(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const X: DatumKey<f64> = PLANE_SPEC.number("X");
    let args = &call.args;
    let numbers: Vec<f64> = args.data.iter().filter_map(Value::number).collect();
    let pairs = |list: &[f64]| list.chunks_exact(2).map(|c| [c[0], c[1]]).collect::<Vec<_>>();
    let (at, outline): (Vec<(f64, Span)>, HullOutline) = match args.options.as_slice() {
        [] => {
            let [x, rest @ ..] = numbers.as_slice() else { return Ok(Effect::Done) };
            if rest.len() < 4 || rest.len() % 2 != 0 {
                return Err(Diagnostic::error("a section has two or more points", args.position(X))
                    .label(format!("{} numbers follow this X", rest.len()))
                    .help("form: PLANE X Y1 Z1 Y2 Z2 .., or PLANE X1 X2 .. -CARTESIAN Y1 Z1 .."));
            }
            (vec![(*x, args.position(X))], HullOutline::Points(pairs(rest)))
        }
        [one] => {
            let at = args.data.iter().filter_map(|v| Some((v.number()?, v.span))).collect();
            let outline = match one {
                _ if one.is(&RECTANGLE) => rectangle(one)?,
                _ if one.is(&CIRCULAR) => circle(one)?,
                _ => HullOutline::Points(pairs(&one.numbers())),
            };
            (at, outline)
        }
        [_, second, ..] => {
            return Err(Diagnostic::error(
                "a section is given by one of -RECTANGLE, -CARTESIAN and -CIRCULAR",
                second.span,
            ));
        }
    };
    if let Some(value) =
        args.data_after(X).iter().step_by(2).find(|v| args.options.is_empty() && v.number().is_some_and(|y| y < 0.0))
    {
        return Err(Diagnostic::error("a half-breadth must be zero or more", value.span)
            .help("PLANE X1 .. -CARTESIAN Y1 Z1 .. takes points all round a section"));
    }
    if outline.points().len() < 2 {
        return Err(Diagnostic::error("a section has two or more points", args.span));
    }
    if let Some(Menu::Block(_)) = job.menus.last()
        && let Some((_, piece)) = job.model.current_piece.as_ref().and_then(|name| job.model.piece(name))
        && piece.shape != Shape::Panels(Vec::new())
    {
        return Err(Diagnostic::error(format!("piece {} is given by panels already", piece.name), args.span));
    }
    let Some(Menu::Planes(planes) | Menu::Block(planes)) = job.menus.last_mut() else { return Ok(Effect::Done) };
    let mut sections = planes.sections.clone();
    for (x, span) in at {
        let ends = [sections.first(), sections.get(1), sections.last()].map(|s| s.map(|(x, _)| *x));
        let follows = match ends {
            [Some(first), Some(second), Some(last)] => (second - first) * (x - last) > 0.0,
            [Some(first), ..] => x != first,
            _ => true,
        };
        if !follows {
            return Err(Diagnostic::error("X of the sections must grow, or fall, from one to the next", span));
        }
        sections.push((x, outline.clone()));
    }
    planes.sections = sections;
    Ok(Effect::Done)
}

/// A rectangle by the points of its half with y >= 0.
fn rectangle(given: &Given) -> Outcome<HullOutline> {
    let [bottom, top, beam] = given.numbers_or_zero(const { RECTANGLE.numbers(["ZBOT", "ZTOP", "BEAM"]) });
    if bottom >= top {
        return Err(Diagnostic::error("ZTOP must be greater than ZBOT", given.span));
    }
    let (half, count) = (0.5 * beam, given.integer(const { RECTANGLE.integer("NPTS") }).unwrap_or(2).max(2) as usize);
    let mut points = vec![[half, bottom], [half, top]];
    if count > 3 {
        points.insert(0, [0.0, bottom]);
        points.push([0.0, top]);
    }
    // the longest edge is halved until there are as many
    while points.len() < count {
        let long = |n: &usize| match (points.get(*n), points.get(n + 1)) {
            (Some([y, z]), Some([v, w])) => (v - y).hypot(w - z),
            _ => 0.0,
        };
        let edge = (0..points.len() - 1).max_by(|m, n| long(m).total_cmp(&long(n)).then(n.cmp(m)));
        let Some(n) = edge else { break };
        if let (Some([y, z]), Some([v, w])) = (points.get(n).copied(), points.get(n + 1).copied()) {
            points.insert(n + 1, [0.5 * (y + v), 0.5 * (z + w)]);
        }
    }
    Ok(HullOutline::Rectangle(points))
}

/// Points on a circle.
fn circle(given: &Given) -> Outcome<HullOutline> {
    const NPTS: windlass_base::spec::ValueKey<i64> = CIRCULAR.integer("NPTS");
    let [y, z, radius] = given.numbers_or_zero(const { CIRCULAR.numbers(["Y", "Z", "RADIUS"]) });
    let count = given.integer(NPTS).unwrap_or(2).max(2);
    let from = given.number(const { CIRCULAR.number("THETA") }).unwrap_or(-std::f64::consts::FRAC_PI_2);
    let step = given.number(const { CIRCULAR.number("DTHETA") });
    let turn = std::f64::consts::TAU;
    let by = step.unwrap_or(turn / (count - 1) as f64);
    let whole = ((count - 1) as f64 * by.abs() - turn).abs() < 1e-9 * turn;
    let points = |count: i64| -> Vec<[f64; 2]> {
        let at = |n: i64| unit_vector(from + by * n as f64);
        (0..count).map(at).map(|(cos, sin)| [y + radius * cos, z + radius * sin].map(snap(radius))).collect()
    };
    if !whole {
        return if (count - 1) as f64 * by.abs() > turn {
            Err(Diagnostic::error("the arc goes more than once round its circle", given.span))
        } else {
            Ok(HullOutline::Points(points(count)))
        };
    }
    if count < 4 {
        return Err(Diagnostic::error("a whole circle needs four or more points", given.position(NPTS))
            .help("the last of them is the first: 9 points make 8 sides"));
    }
    Ok(HullOutline::Circle(points(count - 1)))
}

/// Zero for what rounding leaves of a coordinate that is zero.
fn snap(size: f64) -> impl Fn(f64) -> f64 {
    move |x| if x.abs() < 1e-12 * size { 0.0 } else { x }
}

/// Takes away the piece of sections of which one was refused.
fn drop_refused(job: &mut Job, planes: &Planes) {
    let PieceOfSections::Described(name) = &planes.piece else { return };
    for part in job.model.parts.values_mut() {
        part.pieces.retain(|piece| Model::key(&piece.name) != Model::key(name));
    }
    job.model.current_piece = None;
}

/// What a refused record of a surface leaves in a script: hydrostatics and solves stop, without the errors that a hull or a compartment without
/// its surface would give.
pub fn keep_refused(job: &mut Job, record: &str, span: Span) {
    let model = &job.model;
    let Some(part) = model.current_part.as_ref().and_then(|name| model.parts.get(&Model::key(name))) else { return };
    if !model.bodies.contains_key(&Model::key(&part.body)) {
        return;
    }
    let of = model.current_compartment.as_ref().map_or(part.name.clone(), |name| format!("compartment {name}"));
    let record = format!("{record} of {of}");
    if model.unmodelled.iter().all(|kept| kept.record != record) {
        let effect = "a surface, whose record was refused".to_string();
        job.model.keep_unmodelled(UnmodelledEffect { record, effect, matters_to: SolveKind::Hydrostatics, span });
    }
}

/// The end of PGEN: makes the panels.
///
/// # Errors
/// Fewer than two sections, or sections that enclose nothing.
pub fn build(job: &mut Job, planes: Planes, at: Option<Span>) -> Outcome<()> {
    if planes.is_refused {
        drop_refused(job, &planes);
        return Ok(());
    }
    let is_described = matches!(planes.piece, PieceOfSections::Described(_));
    let made = build_pieces(job, planes, at);
    if made.is_err() && is_described {
        job.model.current_piece = None;
    }
    made
}

fn build_pieces(job: &mut Job, planes: Planes, at: Option<Span>) -> Outcome<()> {
    let span = at.unwrap_or(planes.span);
    if planes.sections.len() < 2 {
        return Err(Diagnostic::error("a hull needs two or more sections", span).other(planes.span, "begun here"));
    }
    let is_tank = match &planes.piece {
        PieceOfSections::New(piece) => piece.compartment.is_some(),
        PieceOfSections::Described(name) => job.model.piece(name).is_some_and(|(_, p)| p.compartment.is_some()),
    };
    let as_given = is_tank || planes.placing.side != ShipSide::Mirrored;
    let beyond =
        |outline: &HullOutline| matches!(outline, HullOutline::Points(list) if list.iter().any(|[y, _]| *y < 0.0));
    let crosses = planes.sections.iter().any(|(_, outline)| beyond(outline));
    let has_circle = planes.sections.iter().any(|(_, outline)| matches!(outline, HullOutline::Circle(_)));
    let panels = if as_given || crosses || has_circle {
        let half_rectangle = planes.placing.side != ShipSide::Mirrored;
        let round = |(x, outline): HullSection| (x, loop_of(outline, half_rectangle, as_given || crosses));
        loft(planes.sections.into_iter().map(round).collect())
    } else {
        panels(planes.sections.into_iter().map(|(x, outline)| (x, outline.points().to_vec())).collect())
    };
    let flat = panels.iter().flatten().all(|[_, y, _]| *y == 0.0);
    if flat || panels.is_empty() {
        return Err(Diagnostic::error("the sections enclose nothing", span).other(planes.span, "begun here"));
    }
    place_panels(job, planes.piece, planes.placing, panels, at)
}

/// Puts panels into a piece, mirrored and placed as its record says, and into a second piece under -BOTH.
fn place_panels(
    job: &mut Job,
    piece: PieceOfSections,
    placing: Placing,
    panels: Vec<Vec<Position>>,
    at: Option<Span>,
) -> Outcome<()> {
    let mut sides = placing.sides(panels).into_iter();
    let first = Shape::Panels(sides.next().unwrap_or_default());
    let name = match piece {
        PieceOfSections::New(piece) => {
            let name = piece.name.clone();
            piece::add(job, Piece { shape: first, ..*piece }, false);
            name
        }
        PieceOfSections::Described(name) => {
            if let Some(piece) = job.model.piece_mut(&name) {
                piece.shape = first;
            }
            job.model.current_piece = Some(name.clone());
            name
        }
    };
    let original = job.model.piece(&name).map(|(_, piece)| piece.clone());
    let notices = piece::complete_piece(job, at);
    job.notices.extend(notices);
    if let (Some(panels), Some(original)) = (sides.next(), original) {
        let other = format!("{name}P");
        if let Some((_, taken)) = job.model.piece(&other) {
            return Err(Diagnostic::error(
                format!("-BOTH makes a piece {other}, which exists already"),
                at.unwrap_or(original.span),
            )
            .other(taken.span, "defined here"));
        }
        piece::add(job, Piece { name: other, shape: Shape::Panels(panels), ..original }, false);
        let notices = piece::complete_piece(job, at);
        job.notices.extend(notices);
    }
    Ok(())
}

/// Puts a box into the part described last, mirrored and placed as its record says.
///
/// # Errors
/// A name that the second piece of -BOTH would have and that is taken.
pub fn add_placed(job: &mut Job, piece: Piece, placing: Placing) -> Outcome<()> {
    let panels = match &piece.shape {
        Shape::Block { low, high } => box_panels(*low, *high),
        Shape::Panels(panels) => panels.clone(),
        Shape::Bar { ends, sides } => bar_panels(ends, sides),
        Shape::Tube { .. } => Vec::new(),
    };
    place_panels(job, PieceOfSections::New(Box::new(piece)), placing, panels, None)
}

/// The end of a menu of BLOCK: its sections or panels are complete.
///
/// # Errors
/// As [`build`].
pub fn finish_block(job: &mut Job, planes: Planes, at: Option<Span>) -> Outcome<()> {
    if planes.is_refused || planes.has_sections() {
        return build(job, planes, at);
    }
    let given = job.model.current_piece.as_ref().and_then(|name| job.model.piece(name));
    let Some(Shape::Panels(panels)) =
        given.map(|(_, piece)| piece.shape.clone()).filter(|shape| shape.extent().is_some())
    else {
        let notices = piece::complete_piece(job, at);
        job.notices.extend(notices);
        return Ok(());
    };
    place_panels(job, planes.piece, planes.placing, panels, at)
}

/// The points once round a section: of a rectangle its whole, or its half with y >= 0; of points what is given, or what they are with
/// their mirror images.
fn loop_of(outline: HullOutline, half_rectangle: bool, as_given: bool) -> Vec<[f64; 2]> {
    let mirror =
        |list: &[[f64; 2]]| list.iter().rev().filter(|[y, _]| *y != 0.0).map(|[y, z]| [-y, *z]).collect::<Vec<_>>();
    // loops begin on the plane of symmetry, so that those of unequal number of points match
    let from_keel = |list: Vec<[f64; 2]>| match list.first() {
        Some([y, z]) if *y != 0.0 => std::iter::once([0.0, *z]).chain(list.iter().copied()).collect(),
        _ => list,
    };
    match outline {
        HullOutline::Circle(list) => list,
        HullOutline::Points(list) if as_given => list,
        HullOutline::Rectangle(list) if half_rectangle => {
            let ends = [list.first(), list.last()].map(|end| end.map(|[_, z]| [0.0, *z]));
            let [bottom, top] = ends;
            let mut made: Vec<[f64; 2]> = bottom.into_iter().chain(list).chain(top).collect();
            made.dedup();
            made
        }
        HullOutline::Points(list) | HullOutline::Rectangle(list) => {
            let port = mirror(&list);
            from_keel(list).into_iter().chain(port).collect()
        }
    }
}

/// The panels of a solid between whole sections, each given by the points once round it.
fn loft(mut sections: Vec<SectionPoints>) -> Vec<Vec<Position>> {
    if sections.first().zip(sections.last()).is_some_and(|(a, b)| a.0 > b.0) {
        sections.reverse();
    }
    let round = |(x, points): &SectionPoints| {
        let mut points = points.clone();
        if points.len() > 1 && points.first() == points.last() {
            points.pop();
        }
        let next = points.iter().cycle().skip(1);
        let area: f64 = points.iter().zip(next).map(|([y, z], [v, w])| y * w - v * z).sum();
        // once round from +y toward +z, from the same first point
        if area < 0.0 {
            points.get_mut(1..).into_iter().for_each(<[_]>::reverse);
        }
        points.iter().map(|[y, z]| [*x, *y, *z]).collect::<Vec<Position>>()
    };
    let rings: Vec<Vec<Position>> = sections.iter().map(round).collect();
    let closed = |ring: &[Position]| ring.iter().chain(ring.first()).copied().collect::<Vec<Position>>();
    let mut list: Vec<Vec<Position>> = Vec::new();
    for pair in rings.windows(2) {
        let [a, b] = pair else { continue };
        list.extend(strip(&closed(a), &closed(b)));
    }
    list.extend(rings.first().map(|ring| ring.iter().rev().copied().collect()));
    list.extend(rings.last().cloned());
    clean(&mut list);
    list
}

/// Leaves out corners that coincide with the one before, and panels without area.
fn clean(list: &mut Vec<Vec<Position>>) {
    for corners in list.iter_mut() {
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
    }
    list.retain(|corners| corners.len() > 2 && piece::area(corners) > 0.0);
}

/// The panels of a hull, their corners counterclockwise from outside; panels without area are left out.
fn panels(mut sections: Vec<SectionPoints>) -> Vec<Vec<Position>> {
    if sections.first().zip(sections.last()).is_some_and(|(a, b)| a.0 > b.0) {
        sections.reverse();
    }
    let mut list: Vec<Vec<Position>> = Vec::new();
    let mirror = |[x, y, z]: Position| [x, -y, z];
    let both = |corners: Vec<Position>, list: &mut Vec<Vec<Position>>| {
        list.push(corners.iter().rev().map(|at| mirror(*at)).collect());
        list.push(corners);
    };
    let placed = |(x, outline): &SectionPoints| outline.iter().map(|[y, z]| [*x, *y, *z]).collect::<Vec<Position>>();
    let halves: Vec<Vec<Position>> = sections.iter().map(placed).collect();
    for pair in halves.windows(2) {
        let [a, b] = pair else { continue };
        strip(a, b).into_iter().for_each(|panel| both(panel, &mut list));
        if let (Some(a0), Some(b0), Some(a1), Some(b1)) = (a.first(), b.first(), a.last(), b.last()) {
            list.push(vec![*a0, *b0, mirror(*b0), mirror(*a0)]);
            list.push(vec![*a1, mirror(*a1), mirror(*b1), *b1]);
        }
    }
    for (end, reversed) in [(halves.first(), false), (halves.last(), true)] {
        for mut corners in end.into_iter().flat_map(|half| close_section(half)) {
            if reversed {
                corners.reverse();
            }
            list.push(corners);
        }
    }
    clean(&mut list);
    list
}

/// The polygons of a whole section seen toward -x, one between each two points at y = 0 that lie apart along its outline.
fn close_section(half: &[Position]) -> Vec<Vec<Position>> {
    let mut runs: Vec<Vec<Position>> = vec![Vec::new()];
    for at in half {
        let run = runs.last_mut();
        if let Some(run) = run {
            run.push(*at);
            if at[1] == 0.0 && run.len() > 1 {
                runs.push(vec![*at]);
            }
        }
    }
    let whole = |run: Vec<Position>| {
        let port = run.iter().filter(|at| at[1] > 0.0).map(|[x, y, z]| [*x, -y, *z]);
        let starboard_down = run.iter().rev().copied();
        port.chain(starboard_down).collect::<Vec<Position>>()
    };
    runs.into_iter().map(whole).collect()
}

/// The panels between two half sections: quadrilaterals where they have as many points, else triangles that take the nearer
/// next point by the share of the outline behind it.
fn strip(a: &[Position], b: &[Position]) -> Vec<Vec<Position>> {
    let pairs = |list: &[Position]| list.windows(2).map(|w| [w[0], w[1]]).collect::<Vec<_>>();
    if a.len() == b.len() {
        let both = pairs(a).into_iter().zip(pairs(b));
        return both.map(|([a0, a1], [b0, b1])| vec![a0, a1, b1, b0]).collect();
    }
    let shares = |list: &[Position]| {
        let lengths = list.windows(2).scan(0.0, |sum, w| {
            *sum += (nalgebra::Vector3::from(w[1]) - nalgebra::Vector3::from(w[0])).norm();
            Some(*sum)
        });
        let lengths: Vec<f64> = lengths.collect();
        let whole = lengths.last().copied().unwrap_or(0.0).max(f64::MIN_POSITIVE);
        lengths.into_iter().map(|l| l / whole).collect::<Vec<f64>>()
    };
    let (of_a, of_b, mut i, mut j) = (shares(a), shares(b), 0, 0);
    let mut list = Vec::new();
    while let (Some(at), Some(bt)) = (a.get(i), b.get(j)) {
        match (of_a.get(i), of_b.get(j)) {
            (Some(next), other) if other.is_none_or(|o| next <= o) => {
                list.extend(a.get(i + 1).map(|up| vec![*at, *up, *bt]));
                i += 1;
            }
            (_, Some(_)) => {
                list.extend(b.get(j + 1).map(|up| vec![*at, *up, *bt]));
                j += 1;
            }
            _ => break,
        }
    }
    list
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::Vector3;

    /// Volume within the panels by the divergence theorem, and the sum of their areas as vectors, zero of a closed surface.
    fn volume(panels: &[Vec<Position>]) -> (f64, f64) {
        let (mut volume, mut open) = (0.0, Vector3::zeros());
        for panel in panels {
            let at: Vec<Vector3<f64>> = panel.iter().map(|p| Vector3::from(*p)).collect();
            for pair in at[1..].windows(2) {
                volume += at[0].dot(&pair[0].cross(&pair[1])) / 6.0;
                open += (pair[0] - at[0]).cross(&(pair[1] - at[0])) * 0.5;
            }
        }
        (volume, open.norm())
    }

    #[test]
    fn two_rectangles_enclose_box_in_either_order() {
        for x in [[0.0, 400.0], [400.0, 0.0]] {
            let sections = x.map(|x| (x, vec![[50.0, 0.0], [50.0, 20.0]])).to_vec();
            let (found, open) = volume(&panels(sections));
            assert!((found - 800_000.0).abs() < 1e-6 && open < 1e-9, "{found} {open}");
        }
    }

    #[test]
    fn wedge_has_half_volume_of_its_box() {
        let sections = vec![(0.0, vec![[0.0, 0.0], [0.0, 20.0]]), (100.0, vec![[30.0, 0.0], [30.0, 20.0]])];
        let (found, open) = volume(&panels(sections));
        assert!((found - 60_000.0).abs() < 1e-6 && open < 1e-9, "{found} {open}");
    }

    #[test]
    fn sections_with_different_point_counts_form_a_closed_hull() {
        // the same rectangle, once with a point more on its side
        let sections = vec![(0.0, vec![[5.0, 0.0], [5.0, 4.0]]), (10.0, vec![[5.0, 0.0], [5.0, 1.0], [5.0, 4.0]])];
        let (found, open) = volume(&panels(sections));
        assert!((found - 400.0).abs() < 1e-9 && open < 1e-9, "{found} {open}");
    }

    #[test]
    fn prism_over_octagon_has_area_of_inscribed_polygon() {
        // 8 sides within a circle of radius 31.5: 8/2 R^2 sin(45 deg) = 2806.5; given either way round
        let octagon: Vec<[f64; 2]> = (0..8)
            .map(|n| (f64::from(n) * std::f64::consts::FRAC_PI_4).sin_cos())
            .map(|(sin, cos)| [31.5 * cos, 31.5 * sin])
            .collect();
        let turned: Vec<[f64; 2]> = octagon.iter().rev().copied().collect();
        for section in [octagon, turned] {
            let (found, open) = volume(&loft(vec![(0.0, section.clone()), (2.0, section)]));
            assert!((found / 2.0 - 2806.5).abs() < 0.05 && open < 1e-9, "{found} {open}");
        }
    }
}
