//! The options that make a TUBE a member in waves and current, and the table of members.

use crate::commands::model::{piece, weight};
use crate::commands::status::body_tables::round_to_zero;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Cell, Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::Args;
use windlass_hydro::morison;
use windlass_language::select::Owner;
use windlass_language::spec::{Kind, OptionSpec, ValueSpec};
use windlass_model::{ClassError, Member, Model, Parameters, Part, Piece, Shape, WaveAction};

const fn factor(
    name: &'static str,
    value: &'static [ValueSpec],
    help: &'static str,
    usual: &'static str,
) -> OptionSpec {
    OptionSpec::new(name, value, help).owner(Owner::Ours).default(usual)
}
const fn value(help: &'static str) -> [ValueSpec; 1] {
    [ValueSpec::new("C", Kind::Number(Dim::None), help).not_negative()]
}
const CD: [ValueSpec; 1] = value("drag across the axis, on the diameter");
const CDA: [ValueSpec; 1] = value("friction along the axis, on the skin");
const CA: [ValueSpec; 1] = value("added mass across the axis, on the displaced mass; Cm is 1 + CA");
const CAA: [ValueSpec; 2] = [
    ValueSpec::new(
        "C1",
        Kind::Number(Dim::None),
        "added mass along the axis at the first end, on the half sphere over it",
    )
    .not_negative(),
    ValueSpec::new("C2", Kind::Number(Dim::None), "the same at the second end; 0 where it joins another piece")
        .or("C1")
        .not_negative(),
];

const CD_OPTION: OptionSpec = factor(
    "-CD",
    &CD,
    "drag coefficient",
    "1, or that of &PARAMETER -DRGTUB; 0 with -CS_CURRENT, and of what displaces no water",
);
const CDA_OPTION: OptionSpec = factor("-CDA", &CDA, "coefficient of skin friction", "0.016; 0 where CD is 0");
const CA_OPTION: OptionSpec =
    factor("-CA", &CA, "coefficient of added mass", "1, or that of &PARAMETER -AMCTUB; 0 of what displaces no water");
const CAA_OPTION: OptionSpec = factor("-CAA", &CAA, "coefficient of added mass of the ends", "0");

/// The load category of a TUBE.
pub const CATEGORY: OptionSpec = OptionSpec { owner: Owner::Ours, ..weight::CATEGORY };

/// The coefficients of a TUBE.
const COEFFICIENTS: [OptionSpec; 4] = [CD_OPTION, CDA_OPTION, CA_OPTION, CAA_OPTION];

/// What a TUBE takes besides what every piece takes.
pub const OPTIONS: [OptionSpec; 5] = [CD_OPTION, CDA_OPTION, CA_OPTION, CAA_OPTION, CATEGORY];

/// What the help of TUBE says.
pub const TUBE_HELP: &str = "A round member with flat ends between two points of the body; it displaces the water of its whole section. \
     Members that run into each other at a joint are each counted up to their point. In current, in waves and where it moves it is a member by Morison's formula. A length of it feels \
     1/2 rho CD OD |u| u across its axis and 1/2 rho CDA pi OD |u| u along it, u being the velocity of waves and current less its own; \
     (1 + CA) rho pi/4 OD^2 times the acceleration of the water across its axis; the pressure of the waves on its ends; and hydrostatic \
     pressure up to the surface where it is at the time. CA is also added to the inertia of the body, as is CAA rho pi/12 OD^3 along the axis \
     at each end in the water: 0.64 is half a disc (DNV-RP-C205), for an end that is free; an end that joins another piece has none: \
     -CAA 0.64 0. &STATUS PIECES prints the added mass of all members of a body. 0.016 for CDA is what AQWA has. In \
     equilibrium the drag of the current is left, under the mean level. -CS_CURRENT instead gives the drag of the areas along the axes of \
     the part, as of other pieces; with CD it contradicts. -DIFTYPE 3DDIF says that a hydrodynamic database has the tube in its hull: of the \
     formula drag alone is left. Slamming and the drag of flat ends are not counted. &APPLY multiplies what it does by the attributes #BUOY, #WIND, #DRAG and #AMASS of its \
     category and by its part.";

/// The coefficients of a TUBE; those that its record leaves out are the usual ones.
///
/// # Errors
/// Two sorts of drag; coefficients of an interior.
pub fn coefficients(args: &Args, permeability: f64, usual: &Parameters) -> Outcome<Member> {
    let given = |option: &OptionSpec| args.option_number(option);
    let own = COEFFICIENTS
        .iter()
        .find_map(|option| args.option(option).filter(|g| g.first_number().is_some_and(|c| c != 0.0)));
    if let Some(own) = own.filter(|_| permeability < 0.0) {
        return Err(Diagnostic::error(
            format!("{} is of what stands in the water, and an interior does not", own.name()),
            own.span,
        ));
    }
    let areas = args.option(&piece::CS_CURRENT);
    if let (Some(areas), Some(drag)) = (areas, args.option(&CD_OPTION).or(args.option(&CDA_OPTION))) {
        let text = format!("-CS_CURRENT and {} are both the drag of the tube", drag.name());
        return Err(Diagnostic::error(text, drag.span)
            .other(areas.span, "given here too")
            .help("leave one of them out"));
    }
    let wet = permeability > 0.0;
    let usual = [usual.tube_drag.filter(|_| areas.is_none()), usual.tube_added_mass].map(|c| c.unwrap_or(1.0));
    let drag = if wet && areas.is_none() { usual[0] } else { 0.0 };
    let added = if wet { usual[1] } else { 0.0 };
    let cd = given(&CD_OPTION).unwrap_or(drag);
    let friction = if cd > 0.0 { 0.016 } else { 0.0 };
    Ok(Member {
        drag: cd,
        friction: given(&CDA_OPTION).unwrap_or(friction),
        added: given(&CA_OPTION).unwrap_or(added),
        end_added: [
            given(&CAA_OPTION),
            args.option(&CAA_OPTION)
                .and_then(|given| given.number(const { CAA_OPTION.number("C2") }))
                .or(given(&CAA_OPTION)),
        ]
        .map(|caa| caa.unwrap_or(0.0)),
        breadths: None,
    })
}

/// Members with their coefficients; `None` without any.
pub fn members(model: &Model, fits: &dyn Fn(&str) -> bool) -> Option<Table> {
    let all = model.parts.values().flat_map(|part| part.pieces.iter().map(move |piece| (part, piece)));
    let chosen = all.filter(|(part, p)| fits(&p.name) || fits(&part.name) || fits(&part.body));
    let rows: Vec<MemberRow> = chosen
        .filter_map(|(part, piece)| {
            let member = piece.member.as_ref()?;
            let ([a, b], diameter, sides) = match &piece.shape {
                Shape::Tube { ends, diameter } => (ends, Some(*diameter), [None; 2]),
                Shape::Bar { ends, sides } => {
                    let long = |side: &[f64; 3]| Some(side.iter().map(|x| x * x).sum::<f64>().sqrt());
                    (ends, None, [long(&sides[1]), long(&sides[0])])
                }
                Shape::Panels(_) | Shape::Block { .. } => return None,
            };
            let length = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum::<f64>().sqrt();
            Some(MemberRow { part, piece, member, diameter, sides, length })
        })
        .collect();
    let added = |row: &MemberRow, c: f64| match row.piece.waves {
        WaveAction::Database => Cell::from("database"),
        _ => Cell::from(c),
    };
    let has_bars = rows.iter().any(|row| row.diameter.is_none());
    let mut table = Table::new("Members")
        .with_rows(&rows)
        .text("Body", |row| &row.part.body)
        .text("Part", |row| &row.part.name)
        .text("Piece", |row| &row.piece.name)
        .column("", "OD", Dim::Section, Digits::Usual, |row| row.diameter);
    if has_bars {
        table = table.columns("Outline", ["Depth", "Width"], Dim::Section, Digits::Usual, |row| row.sides);
    }
    let mut table = table
        .column("", "Length", Dim::Length, Digits::Usual, |row| row.length)
        .column("Across", "CD", Dim::None, Digits::Usual, |row| row.member.drag)
        .column("Along", "CDA", Dim::None, Digits::Usual, |row| row.member.friction)
        .column("Across", "CA", Dim::None, Digits::Usual, |row| added(row, row.member.added))
        .columns("CAA of End", ["1", "2"], Dim::None, Digits::Usual, |row| row.member.end_added.map(|c| added(row, c)))
        .build();
    table.note(if has_bars {
        "By Morison's formula: CD and CA on the diameter, of a bar on the breadth seen along its depth or width, CDA on the skin, CAA on the half sphere over an end"
    } else {
        "By Morison's formula: CD and CA on the diameter, CDA on the skin, CAA on the half sphere over an end"
    });
    (!rows.is_empty()).then_some(table)
}

/// A tube with the coefficients of Morison's formula.
struct MemberRow<'m> {
    part: &'m Part,
    piece: &'m Piece,
    member: &'m Member,
    /// Outer diameter (m); none of a bar.
    diameter: Option<f64>,
    /// Depth and width of a bar (m).
    sides: [Option<f64>; 2],
    /// Between the ends (m).
    length: f64,
}

/// The added mass of the members of each body under the mean level where it stands, about its origin in its own axes.
///
/// # Errors
/// An environment that cannot be computed.
pub fn added_mass(model: &Model, fits: &dyn Fn(&str) -> bool) -> Result<Vec<Table>, ClassError> {
    let power = |length: i8| Dim::Derived { force: 1, length, seconds: 2 };
    let names = ["X", "Y", "Z", "RX", "RY", "RZ"];
    let mut halves: [Vec<(&str, &str, [f64; 6])>; 2] = [Vec::new(), Vec::new()];
    for body in model.bodies.values().filter(|b| fits(&b.name)) {
        let (_, added) = morison::build_members(model, body, None)?;
        let whole = added.amax();
        if whole == 0.0 {
            continue;
        }
        for (half, first) in halves.iter_mut().zip([0, 3]) {
            half.extend(names.into_iter().enumerate().skip(first).take(3).map(|(n, name)| {
                (body.name.as_str(), name, [0, 1, 2, 3, 4, 5].map(|i| round_to_zero(added[(n, i)], whole)))
            }));
        }
    }
    let [masses, inertias] = halves;
    let table = |title: &str, rows: &[(&str, &str, [f64; 6])], [by_shift, by_turn]: [i8; 2]| {
        Table::new(title)
            .with_rows(rows)
            .text("Body", |(body, ..)| *body)
            .text("DF", |(_, name, _)| *name)
            .columns("By Acceleration", ["X", "Y", "Z"], power(by_shift), Digits::Scientific(5), |(.., m)| {
                [m[0], m[1], m[2]]
            })
            .columns("By Angular Acceleration", ["RX", "RY", "RZ"], power(by_turn), Digits::Scientific(5), |(.., m)| {
                [m[3], m[4], m[5]]
            })
            .build()
    };
    let mut last = table("Added Moment of Inertia of Members", &inertias, [0, 1]);
    last.note("about the body's origin, in its axes, under the mean level where it stands");
    let tables = [table("Added Mass of Members", &masses, [-1, 0]), last];
    Ok(tables.into_iter().filter(|table| table.rows() > 0).collect())
}
