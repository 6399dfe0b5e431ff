//! `PGEN` and `PLANE`: a hull of sections.
//!
//! No source gives the form of these records; the reading is ours and stands in their help.

use crate::commands::menu;
use crate::commands::model::piece::{self, OPTIONS};
use crate::commands::{Call, Command, Effect, Job, Menu};
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::geometry::Position;
use windlass_base::span::Span;
use windlass_base::units::Dim;
use windlass_base::values::Noun;
use windlass_base::values::Value;
use windlass_language::spec::{CommandSpec, DatumKey, Kind, Opens, OptionSpec, ValueSpec};
use windlass_model::{Piece, Shape};

/// PGEN.
pub static PGEN: Command = Command { spec: &PGEN_SPEC, edits: false, run: pgen };
/// PLANE.
pub static PLANE: Command = Command { spec: &PLANE_SPEC, edits: false, run: plane };

const fn number(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Length), help)
}

static PGEN_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::INMODEL, &menu::MEDIT],
    opens: Opens::Menu(&menu::PGEN),
    data: &[ValueSpec::new("NAME", Kind::Name(Noun::New), "name of the piece")
        .or("the piece described last, which has no panels yet")],
    options: &OPTIONS,
    detail: "Opens a menu of PLANE records, up to END PGEN or END_PGEN, which makes the panels of the piece: each section is mirrored \
             to -y, neighbouring sections are joined point by point where they have the same number of points, else by \
             triangles, and the first and the last section close the ends. &HELP PLANE has the form of a section.",
    example: "MEDIT\n&DESCRIBE BODY TBRG\nPGEN HULL -PERM 1 -CS_WIND 1 1 1\nPLANE 0 400 -RECTANGLE 0 20 100\nEND PGEN\nEND\n\
              &STATUS PIECES",
    ..CommandSpec::new("PGEN", "makes a piece of sections, up to END")
};

const RECTANGLE: OptionSpec = OptionSpec::new(
    "-RECTANGLE",
    &[number("ZBOT", "bottom"), number("ZTOP", "top"), number("BEAM", "whole breadth").positive()],
    "a rectangular section, at every X given",
);
const CARTESIAN: OptionSpec = OptionSpec::new(
    "-CARTESIAN",
    &[number("Y", "half-breadth").not_negative(), number("Z", "height")],
    "points of the section, at every X given",
)
.repeating(2);

static PLANE_SPEC: CommandSpec = CommandSpec {
    menus: &[&menu::PGEN],
    data: &[number("X", "where the section is; without an option its points follow: Y1 Z1 Y2 Z2 ..")],
    repeat: 1,
    options: &[RECTANGLE, CARTESIAN],
    detail: "PLANE X Y1 Z1 Y2 Z2 .. is the section at X by points of its half with y >= 0, from the keel up; PLANE X1 X2 .. \
             -CARTESIAN Y1 Z1 .. and -RECTANGLE give the same section at several X. X grows, or falls, from section to \
             section. Where the first point lies beside y = 0 the bottom is flat from there to its mirror image, and the deck \
             above the last point likewise. A section may be a line at y = 0, as a stem is. The reading is ours: no source gives \
             the form.",
    example: "MEDIT\n&DESCRIBE BODY SHIP\nPGEN HULL\nPLANE 0 0 0 0 30\nPLANE 60 30 0 40 8 40 30\nPLANE 300 380 -CART 30 0 40 8 40 30\n\
              END PGEN\nEND\n&STATUS PIECES",
    ..CommandSpec::new("PLANE", "a section of a hull")
};

/// A section: its x and the points of its half with y >= 0, from the keel up (m).
type HullSection = (f64, Vec<[f64; 2]>);

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
    span: Span,
}

fn pgen(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const NAME: DatumKey<str> = PGEN_SPEC.word("NAME");
    let args = &call.args;
    let piece = match args.word(NAME) {
        Some(name) => {
            let begun = piece::begin_piece(job, args, name, args.place(NAME), Shape::Panels(Vec::new()))?;
            PieceOfSections::New(Box::new(begun))
        }
        None => {
            let described = job.model.current_piece.as_ref().and_then(|name| job.model.piece(name));
            let empty = described.filter(|(_, p)| matches!(&p.shape, Shape::Panels(panels) if panels.is_empty()));
            let name = empty.map(|(_, p)| p.name.clone()).ok_or_else(|| {
                Diagnostic::error("PGEN lacks the name of the piece", args.span)
                    .help("form: PGEN NAME -OPTIONS, or &DESCRIBE PIECE NAME -OPTIONS and then PGEN")
            })?;
            if let Some(given) = args.options.first() {
                return Err(Diagnostic::error(
                    format!("{} belongs to &DESCRIBE PIECE {name}", given.name()),
                    given.span,
                ));
            }
            PieceOfSections::Described(name)
        }
    };
    job.menus.push(Menu::Planes(Box::new(Planes { piece, sections: Vec::new(), span: args.span })));
    Ok(Effect::Done)
}

fn plane(job: &mut Job, call: &Call) -> Outcome<Effect> {
    const X: DatumKey<f64> = PLANE_SPEC.number("X");
    let args = &call.args;
    let numbers: Vec<f64> = args.data.iter().filter_map(Value::number).collect();
    let pairs = |list: &[f64]| list.chunks_exact(2).map(|c| [c[0], c[1]]).collect::<Vec<_>>();
    let (at, outline): (Vec<(f64, Span)>, Vec<[f64; 2]>) = match args.options.as_slice() {
        [] => {
            let [x, rest @ ..] = numbers.as_slice() else { return Ok(Effect::Done) };
            if rest.len() < 4 || rest.len() % 2 != 0 {
                return Err(Diagnostic::error("a section has two or more points", args.place(X))
                    .label(format!("{} numbers follow this X", rest.len()))
                    .help("form: PLANE X Y1 Z1 Y2 Z2 .., or PLANE X1 X2 .. -CARTESIAN Y1 Z1 .."));
            }
            (vec![(*x, args.place(X))], pairs(rest))
        }
        [one] => {
            let at = args.data.iter().filter_map(|v| Some((v.number()?, v.span))).collect();
            let given = one.numbers();
            let outline = match given.as_slice() {
                [bottom, top, beam] if one.is(&RECTANGLE) && bottom < top => {
                    vec![[0.5 * beam, *bottom], [0.5 * beam, *top]]
                }
                _ if one.is(&RECTANGLE) => return Err(Diagnostic::error("ZTOP must be greater than ZBOT", one.span)),
                _ => pairs(&given),
            };
            (at, outline)
        }
        [_, second, ..] => {
            return Err(Diagnostic::error("a section is given by -RECTANGLE or by -CARTESIAN", second.span));
        }
    };
    if let Some(value) =
        args.data_after(X).iter().step_by(2).find(|v| args.options.is_empty() && v.number().is_some_and(|y| y < 0.0))
    {
        return Err(Diagnostic::error("a half-breadth must be zero or more", value.span));
    }
    if outline.len() < 2 {
        return Err(Diagnostic::error("a section has two or more points", args.span));
    }
    let Some(Menu::Planes(planes)) = job.menus.last_mut() else { return Ok(Effect::Done) };
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

/// The end of PGEN: makes the panels.
///
/// # Errors
/// Fewer than two sections, or sections that enclose nothing.
pub fn build(job: &mut Job, planes: Planes, at: Option<Span>) -> Outcome<()> {
    let span = at.unwrap_or(planes.span);
    if planes.sections.len() < 2 {
        return Err(Diagnostic::error("a hull needs two or more sections", span).other(planes.span, "begun here"));
    }
    let flat = planes.sections.iter().all(|(_, outline)| outline.iter().all(|[y, _]| *y == 0.0));
    let panels = panels(planes.sections);
    if flat || panels.is_empty() {
        return Err(Diagnostic::error("the sections enclose nothing", span).other(planes.span, "begun here"));
    }
    match planes.piece {
        PieceOfSections::New(piece) => piece::add(job, Piece { shape: Shape::Panels(panels), ..*piece }, false),
        PieceOfSections::Described(name) => {
            if let Some(piece) = job.model.piece_mut(&name) {
                piece.shape = Shape::Panels(panels);
            }
            job.model.current_piece = Some(name);
        }
    }
    let notices = piece::complete_piece(job, at);
    job.notices.extend(notices);
    Ok(())
}

/// The panels of a hull, their corners counterclockwise from outside; panels without area are left out.
fn panels(mut sections: Vec<HullSection>) -> Vec<Vec<Position>> {
    if sections.first().zip(sections.last()).is_some_and(|(a, b)| a.0 > b.0) {
        sections.reverse();
    }
    let mut list: Vec<Vec<Position>> = Vec::new();
    let mirror = |[x, y, z]: Position| [x, -y, z];
    let both = |corners: Vec<Position>, list: &mut Vec<Vec<Position>>| {
        list.push(corners.iter().rev().map(|at| mirror(*at)).collect());
        list.push(corners);
    };
    let placed = |(x, outline): &HullSection| outline.iter().map(|[y, z]| [*x, *y, *z]).collect::<Vec<Position>>();
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
    for corners in &mut list {
        corners.dedup();
        while corners.len() > 1 && corners.first() == corners.last() {
            corners.pop();
        }
    }
    list.retain(|corners| corners.len() > 2 && piece::area(corners) > 0.0);
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
}
