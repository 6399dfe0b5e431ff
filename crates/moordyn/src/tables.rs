//! The tables of a deck: types of lines and rods, bodies, rods, points, lines.

use crate::layout::{Column, Dialect, Layout, column, newer, optional};
use crate::map;
use crate::options;
use crate::row::{Row, Word, count, number, numbers, size};
use crate::section::{Section, SectionKind};
use crate::{Deck, Given};
use windlass_base::diagnostic::{Diagnostic, Outcome, suggest};
use windlass_base::span::Span;

/// Axial stiffness of a line type.
#[derive(Clone, Debug, PartialEq)]
pub enum AxialStiffness {
    /// EA (N).
    Linear(f64),
    /// Name of a file with strain (-) and tension (N), beside the deck.
    Table(String),
}

/// A row of LINE TYPES.
#[derive(Clone, Debug, PartialEq)]
pub struct LineType {
    /// Name.
    pub name: Given<String>,
    /// Volume-equivalent diameter (m).
    pub diameter: Given<f64>,
    /// Mass in air (kg/m).
    pub mass: Given<f64>,
    /// Axial stiffness.
    pub stiffness: Given<AxialStiffness>,
    /// Axial damping (N s); negative: minus the share of critical damping of one segment.
    pub damping: Given<f64>,
    /// Bending stiffness (N m2).
    pub bending: Given<f64>,
    /// Normal drag coefficient, on the diameter.
    pub cd_normal: Given<f64>,
    /// Normal added-mass coefficient, on the displaced mass.
    pub ca_normal: Given<f64>,
    /// Axial drag coefficient, on pi times the diameter.
    pub cd_axial: Given<f64>,
    /// Axial added-mass coefficient, on the displaced mass.
    pub ca_axial: Given<f64>,
    /// CB: friction on the seabed, in files of MAP++.
    pub friction: Option<Given<f64>>,
}

/// A row of ROD TYPES.
#[derive(Clone, Debug, PartialEq)]
pub struct RodType {
    /// Name.
    pub name: Given<String>,
    /// Diameter (m).
    pub diameter: Given<f64>,
    /// Mass in air (kg/m).
    pub mass: Given<f64>,
    /// Normal drag and added-mass coefficients.
    pub normal: [Given<f64>; 2],
    /// Drag and added-mass coefficients of the ends.
    pub end: [Given<f64>; 2],
}

/// How a body, rod or point is held.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Attachment {
    /// Held in space.
    Fixed,
    /// Moved by the caller.
    Coupled,
    /// Its position moved by the caller, its rotation free.
    CoupledPinned,
    /// Free.
    Free,
    /// Held in space at end A, rotation free.
    Pinned,
    /// Moves with the body of this id.
    Body(usize),
    /// End A moves with the body of this id, rotation free.
    BodyPinned(usize),
}

/// A row of BODIES.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// Id.
    pub id: Given<usize>,
    /// How it is held.
    pub attachment: Given<Attachment>,
    /// X, Y, Z (m), roll, pitch, yaw (deg).
    pub place: [f64; 6],
    /// Mass (kg).
    pub mass: Given<f64>,
    /// Centre of gravity: Z alone, or X, Y, Z (m).
    pub centre: Given<Vec<f64>>,
    /// Moments of inertia about the centre of gravity: one for all axes, or three (kg m2).
    pub inertia: Given<Vec<f64>>,
    /// Volume (m3), constant.
    pub volume: Given<f64>,
    /// Drag coefficient times area: 1, 2, 3 or 6 values (m2).
    pub drag_area: Given<Vec<f64>>,
    /// Added-mass coefficients: 1 or 3 values.
    pub added_mass: Given<Vec<f64>>,
}

/// A row of RODS.
#[derive(Clone, Debug, PartialEq)]
pub struct Rod {
    /// Id.
    pub id: Given<usize>,
    /// Name of the rod type.
    pub rod_type: Given<String>,
    /// How it is held.
    pub attachment: Given<Attachment>,
    /// Ends A and B (m).
    pub ends: [[f64; 3]; 2],
    /// Segments; 0: a joint without length.
    pub segments: Given<usize>,
}

/// Height of a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Height {
    /// Z (m).
    Given(f64),
    /// On the seabed, as MoorPy's `seabed` and MAP++'s `depth`.
    Seabed,
}

/// A row of POINTS.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Id.
    pub id: Given<usize>,
    /// How it is held.
    pub attachment: Given<Attachment>,
    /// X and Y (m); of points of a body, in its axes.
    pub horizontal: [f64; 2],
    /// Z.
    pub height: Given<Height>,
    /// Mass (kg).
    pub mass: Given<f64>,
    /// Volume (m3).
    pub volume: Given<f64>,
    /// Constant force (N), on the axes of space.
    pub force: [f64; 3],
    /// Drag coefficient times area (m2).
    pub drag_area: Given<f64>,
    /// Added-mass coefficient.
    pub added_mass: Given<f64>,
}

/// What an end of a line is held by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LineEnd {
    /// The point of this id.
    Point(usize),
    /// End A of the rod of this id.
    RodA(usize),
    /// End B of the rod of this id.
    RodB(usize),
}

/// A row of LINES.
#[derive(Clone, Debug, PartialEq)]
pub struct Line {
    /// Id.
    pub id: Given<usize>,
    /// Name of the line type.
    pub line_type: Given<String>,
    /// Ends A (MoorDyn's anchor) and B (fairlead).
    pub ends: [Given<LineEnd>; 2],
    /// Unstretched length (m).
    pub length: Given<f64>,
    /// Segments; 0 in files of MAP++, which have none.
    pub segments: Given<usize>,
    /// Letters of its own output file, as written; `-` for none.
    pub outputs: Given<String>,
    /// Whether the seabed bears it: false with OMIT_CONTACT of MAP++.
    pub has_contact: bool,
}

const LINE_TYPES: [Column; 13] = [
    column(&["TypeName", "LineType", "Name"]),
    column(&["Diam", "Diameter"]),
    column(&["Mass/m", "MassDenInAir", "MassDen"]),
    column(&["EA"]),
    column(&["BA/-zeta", "BA", "CIntDamp"]),
    column(&["EI"]),
    column(&["Cd", "Cdn"]),
    column(&["Ca", "Can"]),
    column(&["CdAx", "CdA", "Cdt"]),
    column(&["CaAx", "CaA", "Cat"]),
    optional(&["Cl"]),
    optional(&["dF"]),
    optional(&["cF"]),
];

/// Version 1 has no bending stiffness, and MoorPy reads tables that end behind EA.
const OLD_LINE_TYPES: [Column; 10] = [
    column(&["TypeName", "LineType", "Name"]),
    column(&["Diam", "Diameter"]),
    column(&["Mass/m", "MassDenInAir", "MassDen"]),
    column(&["EA"]),
    newer(&["BA/-zeta", "BA", "CIntDamp"]),
    newer(&["EI"]),
    newer(&["Cd", "Cdn"]),
    newer(&["Ca", "Can"]),
    newer(&["CdAx", "CdA", "Cdt"]),
    newer(&["CaAx", "CaA", "Cat"]),
];

const ROD_TYPES: [Column; 7] = [
    column(&["TypeName", "RodType", "Name"]),
    column(&["Diam", "Diameter"]),
    column(&["Mass/m", "MassDen"]),
    column(&["Cd"]),
    column(&["Ca"]),
    column(&["CdEnd"]),
    column(&["CaEnd"]),
];

const BODIES: [Column; 14] = [
    column(&["ID", "Number", "Body"]),
    column(&["Attachment", "Type"]),
    column(&["X0", "X"]),
    column(&["Y0", "Y"]),
    column(&["Z0", "Z"]),
    column(&["r0", "roll"]),
    column(&["p0", "pitch"]),
    column(&["y0", "yaw"]),
    column(&["Mass", "M"]),
    column(&["CG"]),
    column(&["I"]),
    column(&["Volume", "Vol", "V"]),
    column(&["CdA"]),
    column(&["Ca"]),
];

const RODS: [Column; 11] = [
    column(&["ID", "Number", "Rod"]),
    column(&["RodType", "Type"]),
    column(&["Attachment"]),
    column(&["Xa"]),
    column(&["Ya"]),
    column(&["Za"]),
    column(&["Xb"]),
    column(&["Yb"]),
    column(&["Zb"]),
    column(&["NumSegs"]),
    optional(&["Outputs", "RodOutputs"]),
];

const POINTS: [Column; 9] = [
    column(&["ID", "Number", "Node", "Point"]),
    column(&["Attachment", "Type"]),
    column(&["X"]),
    column(&["Y"]),
    column(&["Z"]),
    column(&["Mass", "M"]),
    column(&["Volume", "Vol", "V"]),
    column(&["CdA"]),
    column(&["Ca"]),
];

const POINTS_WITH_FORCES: [Column; 12] = [
    column(&["ID", "Number", "Node", "Point"]),
    column(&["Attachment", "Type"]),
    column(&["X"]),
    column(&["Y"]),
    column(&["Z"]),
    column(&["Mass", "M"]),
    column(&["Volume", "Vol", "V"]),
    column(&["FX"]),
    column(&["FY"]),
    column(&["FZ"]),
    column(&["CdA"]),
    column(&["Ca"]),
];

const LINES: [Column; 7] = [
    column(&["ID", "Number", "Line"]),
    column(&["LineType", "Type"]),
    column(&["AttachA", "NodeAnch", "NodeA", "EndA"]),
    column(&["AttachB", "NodeFair", "NodeB", "EndB"]),
    column(&["UnstrLen", "Length"]),
    column(&["NumSegs"]),
    optional(&["Outputs", "LineOutputs", "Flags/Outputs", "Flags"]),
];

/// The thickest line that is not warned of (m): no rope, chain or riser comes near it, and one in mm is beyond it.
const LARGEST_DIAMETER_M: f64 = 5.0;

/// Reads a section into the deck.
pub(crate) fn read(section: &Section<'_>, deck: &mut Deck, messages: &mut Vec<Diagnostic>) {
    if deck.map.is_some() {
        map::read(section, deck, messages);
        return;
    }
    let has = |name: &str| section.columns.words.iter().any(|word| word.value.eq_ignore_ascii_case(name));
    match section.kind {
        SectionKind::LineTypes => {
            let is_old = !has("EI") && has("EA");
            let columns: &'static [Column] = if is_old { &OLD_LINE_TYPES } else { &LINE_TYPES };
            let first = deck.line_types.len();
            rows(section, columns, line_type, &mut deck.line_types, messages);
            for kind in deck.line_types.iter().skip(first).filter(|kind| kind.diameter.value > LARGEST_DIAMETER_M) {
                let text = format!("line type {} is {} m thick", kind.name.value, kind.diameter.value);
                let warning = Diagnostic::warning(text, kind.diameter.span).label("read in m");
                messages.push(*warning.help("a diameter in mm is divided by 1000"));
            }
        }
        SectionKind::RodTypes => rows(section, &ROD_TYPES, rod_type, &mut deck.rod_types, messages),
        SectionKind::Bodies => rows(section, &BODIES, body, &mut deck.bodies, messages),
        SectionKind::Rods => rows(section, &RODS, rod, &mut deck.rods, messages),
        SectionKind::Points if has("FX") => {
            rows(section, &POINTS_WITH_FORCES, point_with_force, &mut deck.points, messages)
        }
        SectionKind::Points => rows(section, &POINTS, point, &mut deck.points, messages),
        SectionKind::Lines => rows(section, &LINES, line, &mut deck.lines, messages),
        SectionKind::Options => options::read(&section.rows, &mut deck.options, messages),
        SectionKind::Outputs => {
            let words = section.rows.iter().flat_map(|row| &row.words);
            deck.outputs.extend(words.map(|word| Given { value: word.value.to_string(), span: word.span }));
        }
        SectionKind::Refused => {}
    }
}

/// Units in which the numbers of a deck are not.
const OTHER_UNITS: [&str; 16] =
    ["kN", "MN", "GN", "mm", "cm", "km", "in", "ft", "t", "te", "Te", "tonne", "lb", "lbf", "kip", "kips"];

type Reader<T> = fn(&Cells<'_>) -> Outcome<T>;

fn rows<T>(
    section: &Section<'_>,
    columns: &'static [Column],
    reader: Reader<T>,
    list: &mut Vec<T>,
    messages: &mut Vec<Diagnostic>,
) {
    let layout = Layout::new(section, columns, Dialect::MoorDyn, messages);
    let is_other = |word: &&Word<'_>| OTHER_UNITS.contains(&word.value.trim_matches(['(', ')', '[', ']']));
    if let Some(word) = section.units.words.iter().find(is_other) {
        let text = format!(
            "the line of units has {}, and MoorDyn takes all numbers in N, m, kg and s: so they are taken",
            word.value
        );
        messages.push(*Diagnostic::warning(text, word.span));
    }
    for row in &section.rows {
        let read = layout.place(row).and_then(|words| reader(&Cells::new(words, row, columns)));
        match read {
            Ok(value) => list.push(value),
            Err(error) => messages.push(*error),
        }
    }
    if section.rows.is_empty() {
        messages.push(*Diagnostic::remark("the section has no rows", section.head));
    }
}

/// The words of one row by column; a column that the row does not have reads as the word beside its use.
pub(crate) struct Cells<'a> {
    words: Vec<Option<Word<'a>>>,
    columns: &'static [Column],
    pub(crate) span: Span,
}

impl<'a> Cells<'a> {
    pub(crate) fn new(words: Vec<Option<Word<'a>>>, row: &Row<'a>, columns: &'static [Column]) -> Self {
        Cells { words, columns, span: row.span }
    }

    pub(crate) fn word_or(&self, index: usize, absent: &'static str) -> Word<'a> {
        self.words.get(index).cloned().flatten().unwrap_or(Given { value: absent, span: self.span })
    }

    fn name(&self, index: usize) -> &'static str {
        self.columns.get(index).and_then(|c| c.names.first().copied()).unwrap_or_default()
    }

    pub(crate) fn text(&self, index: usize) -> Given<String> {
        let word = self.word_or(index, "-");
        Given { value: word.value.to_string(), span: word.span }
    }

    fn number(&self, index: usize) -> Outcome<Given<f64>> {
        number(&self.word_or(index, "0"), self.name(index))
    }

    pub(crate) fn size(&self, index: usize, is_positive: bool) -> Outcome<Given<f64>> {
        size(&self.word_or(index, "0"), self.name(index), is_positive)
    }

    fn numbers(&self, index: usize, counts: &[usize]) -> Outcome<Given<Vec<f64>>> {
        numbers(&self.word_or(index, "0"), self.name(index), counts)
    }

    /// Numbers none of which is negative.
    fn sizes(&self, index: usize, counts: &[usize]) -> Outcome<Given<Vec<f64>>> {
        let given = self.numbers(index, counts)?;
        match given.value.iter().find(|value| **value < 0.0) {
            Some(value) => {
                Err(Diagnostic::error(format!("{} is {value}", self.name(index)), given.span)
                    .label("must be 0 or more"))
            }
            None => Ok(given),
        }
    }

    pub(crate) fn count(&self, index: usize, least: usize) -> Outcome<Given<usize>> {
        count(&self.word_or(index, "0"), self.name(index), least)
    }

    fn array<const N: usize>(&self, first: usize) -> Outcome<[f64; N]> {
        let mut values = [0.0; N];
        for (index, value) in values.iter_mut().enumerate() {
            *value = self.number(first + index)?.value;
        }
        Ok(values)
    }
}

fn line_type(cells: &Cells<'_>) -> Outcome<LineType> {
    let lift = cells.size(10, false)?;
    if lift.value > 0.0 {
        let error = Diagnostic::error("vortex-induced vibration is not computed: its loads would be lost", lift.span);
        return Err(error.label("Cl must be 0"));
    }
    let ei = cells.word_or(5, "0");
    if ei.value.parse::<f64>().is_err() && ei.value.contains('.') {
        let error = Diagnostic::error(format!("a table of bending stiffness is not read: {}", ei.value), ei.span);
        return Err(error.label("expected EI (N m2)"));
    }
    let damping = cells.word_or(4, "0");
    if damping.value.contains('|') {
        return Err(viscoelastic(&damping));
    }
    Ok(LineType {
        name: cells.text(0),
        diameter: cells.size(1, true)?,
        mass: cells.size(2, true)?,
        stiffness: stiffness(&cells.word_or(3, "-"))?,
        damping: number(&damping, cells.name(4))?,
        bending: cells.size(5, false)?,
        cd_normal: cells.size(6, false)?,
        ca_normal: cells.size(7, false)?,
        cd_axial: cells.size(8, false)?,
        ca_axial: cells.size(9, false)?,
        friction: None,
    })
}

fn viscoelastic(word: &Word<'_>) -> Box<Diagnostic> {
    let error = Diagnostic::error(format!("a viscoelastic rope is not read: {}", word.value), word.span);
    error.label("expected one number").help("give one stiffness and one damping for the loads of interest")
}

fn stiffness(word: &Word<'_>) -> Outcome<Given<AxialStiffness>> {
    if word.value.to_ascii_uppercase().starts_with("SYROPE") {
        let error = Diagnostic::error("the Syrope model of polyester ropes is not computed", word.span);
        return Err(error.label("expected EA (N), or the file of a table"));
    }
    if word.value.contains('|') {
        return Err(viscoelastic(word));
    }
    let plain = word.value.trim_matches(['"', '\'']);
    let begins_as_number = plain.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
    if begins_as_number || !plain.contains('.') {
        let given = size(word, "EA", true)
            .map_err(|error| error.help("the name of a table's file has an ending, such as rope.txt"))?;
        return Ok(Given { value: AxialStiffness::Linear(given.value), span: given.span });
    }
    Ok(Given { value: AxialStiffness::Table(plain.to_string()), span: word.span })
}

fn rod_type(cells: &Cells<'_>) -> Outcome<RodType> {
    Ok(RodType {
        name: cells.text(0),
        diameter: cells.size(1, false)?,
        mass: cells.size(2, false)?,
        normal: [cells.size(3, false)?, cells.size(4, false)?],
        end: [cells.size(5, false)?, cells.size(6, false)?],
    })
}

/// Which table a word of attachment stands in: they differ in what may be written.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Holder {
    Body,
    Rod,
    Point,
}

const ATTACHMENTS: [(&str, Attachment); 18] = [
    ("Fixed", Attachment::Fixed),
    ("Fix", Attachment::Fixed),
    ("Anchor", Attachment::Fixed),
    ("Coupled", Attachment::Coupled),
    ("Cpld", Attachment::Coupled),
    ("Vessel", Attachment::Coupled),
    ("Ves", Attachment::Coupled),
    ("Fairlead", Attachment::Coupled),
    ("CoupledPinned", Attachment::CoupledPinned),
    ("CpldPin", Attachment::CoupledPinned),
    ("VesselPinned", Attachment::CoupledPinned),
    ("VesPin", Attachment::CoupledPinned),
    ("Free", Attachment::Free),
    ("Connect", Attachment::Free),
    ("Con", Attachment::Free),
    ("Point", Attachment::Free),
    ("Pinned", Attachment::Pinned),
    ("Pin", Attachment::Pinned),
];

fn attachment(word: &Word<'_>, holder: Holder) -> Outcome<Given<Attachment>> {
    let upper = word.value.to_ascii_uppercase();
    let of_body = upper.strip_prefix("BODY").filter(|_| holder != Holder::Body).and_then(|rest| {
        let digits = rest.trim_end_matches(|c: char| !c.is_ascii_digit());
        let id = digits.parse::<usize>().ok().filter(|id| *id > 0)?;
        match &rest[digits.len()..] {
            "" => Some(Attachment::Body(id)),
            "PINNED" | "PIN" if holder == Holder::Rod => Some(Attachment::BodyPinned(id)),
            _ => None,
        }
    });
    let fits = |kind: Attachment| match kind {
        Attachment::Pinned => holder == Holder::Rod,
        Attachment::CoupledPinned => holder != Holder::Point,
        _ => true,
    };
    let known = || ATTACHMENTS.iter().filter(|(_, kind)| fits(*kind));
    let found =
        of_body.or_else(|| known().find(|(name, _)| name.eq_ignore_ascii_case(word.value)).map(|(_, kind)| *kind));
    found.map(|value| Given { value, span: word.span }).ok_or_else(|| {
        let error = Diagnostic::error(format!("attachment {} is not known", word.value), word.span);
        match suggest(word.value, known().map(|(name, _)| *name)) {
            Some(help) => error.help(help),
            None => error,
        }
    })
}

fn body(cells: &Cells<'_>) -> Outcome<Body> {
    Ok(Body {
        id: cells.count(0, 1)?,
        attachment: attachment(&cells.word_or(1, "-"), Holder::Body)?,
        place: cells.array(2)?,
        mass: cells.size(8, false)?,
        centre: cells.numbers(9, &[1, 3])?,
        inertia: cells.sizes(10, &[1, 3])?,
        volume: cells.size(11, false)?,
        drag_area: cells.sizes(12, &[1, 2, 3, 6])?,
        added_mass: cells.sizes(13, &[1, 3])?,
    })
}

fn rod(cells: &Cells<'_>) -> Outcome<Rod> {
    let (ends, segments): ([[f64; 3]; 2], _) = ([cells.array(3)?, cells.array(6)?], cells.count(9, 0)?);
    let apart = ends[0].iter().zip(ends[1]).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    if segments.value == 0 && apart > 0.0 {
        let text = format!("NumSegs is 0, which makes a rod without length, and its ends are {apart} m apart");
        let error = Diagnostic::error(text, segments.span).label("expected 1 or more");
        return Err(error.help("a rod without length has both ends at one place"));
    }
    Ok(Rod {
        id: cells.count(0, 1)?,
        rod_type: cells.text(1),
        attachment: attachment(&cells.word_or(2, "-"), Holder::Rod)?,
        ends,
        segments,
    })
}

fn point(cells: &Cells<'_>) -> Outcome<Point> {
    point_of(cells, [0.0; 3], 7)
}

fn point_with_force(cells: &Cells<'_>) -> Outcome<Point> {
    point_of(cells, cells.array(7)?, 10)
}

fn point_of(cells: &Cells<'_>, force: [f64; 3], drag: usize) -> Outcome<Point> {
    let z = cells.word_or(4, "-");
    let is_seabed = ["seabed", "depth"].iter().any(|name| name.eq_ignore_ascii_case(z.value));
    let height = if is_seabed { Height::Seabed } else { Height::Given(number(&z, "Z")?.value) };
    Ok(Point {
        id: cells.count(0, 1)?,
        attachment: attachment(&cells.word_or(1, "-"), Holder::Point)?,
        horizontal: cells.array(2)?,
        height: Given { value: height, span: z.span },
        mass: cells.size(5, false)?,
        volume: cells.size(6, false)?,
        force,
        drag_area: cells.size(drag, false)?,
        added_mass: cells.size(drag + 1, false)?,
    })
}

fn line(cells: &Cells<'_>) -> Outcome<Line> {
    Ok(Line {
        id: cells.count(0, 1)?,
        line_type: cells.text(1),
        ends: [line_end(&cells.word_or(2, "-"))?, line_end(&cells.word_or(3, "-"))?],
        length: cells.size(4, true)?,
        segments: cells.count(5, 1)?,
        outputs: cells.text(6),
        has_contact: true,
    })
}

/// `5`, `P5`, `Point5`, `C5`, `Con5`, `R1A`, `Rod1B`.
pub(crate) fn line_end(word: &Word<'_>) -> Outcome<Given<LineEnd>> {
    let upper = word.value.to_ascii_uppercase();
    let digits = upper.trim_start_matches(|c: char| c.is_ascii_alphabetic());
    let prefix = &upper[..upper.len() - digits.len()];
    let id_of = |text: &str| text.parse::<usize>().ok().filter(|id| *id > 0);
    let value = match prefix {
        "" | "P" | "POINT" | "C" | "CON" => id_of(digits).map(LineEnd::Point),
        "R" | "ROD" => match (digits.strip_suffix('A'), digits.strip_suffix('B')) {
            (Some(id), _) => id_of(id).map(LineEnd::RodA),
            (_, Some(id)) => id_of(id).map(LineEnd::RodB),
            _ => None,
        },
        _ => None,
    };
    value.map(|value| Given { value, span: word.span }).ok_or_else(|| {
        let error = Diagnostic::error(format!("{} is no end of a line", word.value), word.span);
        error.label("expected a point, such as 5 or P5, or the end of a rod, such as R1A")
    })
}
