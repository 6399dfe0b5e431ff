//! Classes of structural members: TUBE, CONE, BOX, WBOX, PRI, IBEAM, G_IBEAM, TEE, CHANNEL, ANGLE, D_ANGLE, LLEG, PLATE.
//!
//! Source: [MOSES-REF cls_str, cls_shp, cls]: the names, the number of dimensions, the units, the attached plate that is not in the axial
//! area. Which dimension is which stands in figures that are not public: the order is our reading and each help says it.

use super::options as o;
use std::f64::consts::FRAC_PI_4;
use std::sync::Arc;
use windlass_base::choices;
use windlass_base::diagnostic::{Diagnostic, Outcome};
use windlass_base::table::{Digits, Table};
use windlass_base::units::Dim;
use windlass_base::values::{Args, Noun};
use windlass_language::spec::{CommandSpec, Kind, OptionSpec, ValueSpec, count_options, join_lists, join_options};
use windlass_model::{
    ClassError, ClassRecord, Connection, Connector, ConnectorClass, ConnectorElement, MemberSection, SectionOutline,
    SolveKind, Surroundings,
};

/// A type of section that a `~NAME TYPE ...` record can name for BEAM or PLATE.
pub struct SectionKind {
    /// The record's form behind the class name; its name is the type.
    pub spec: &'static CommandSpec,
    /// Reads one record.
    pub read: fn(&ClassRecord) -> Outcome<MemberSection>,
}

impl PartialEq for SectionKind {
    /// A type of section is its spec.
    fn eq(&self, other: &Self) -> bool {
        std::ptr::eq(self.spec, other.spec)
    }
}

const fn size(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Section), help).positive()
}
const fn sizes(name: &'static str, help: &'static str) -> ValueSpec {
    ValueSpec::new(name, Kind::Number(Dim::Section), help).or("0").not_negative()
}
const PT: ValueSpec = sizes("PT", "thickness of an attached plate, which acts in a stress analysis alone");
const PW: ValueSpec = sizes("PW", "its width");
const A_DEPTH: ValueSpec = size("A", "depth, along local z");
const B_WIDTH: ValueSpec = size("B", "width, along local y");

choices! {
    /// Where a section has its nodes.
    enum Reference {
        /// In the middle of its upper side.
        Top = "TOP",
        /// In the middle of its lower side.
        Bottom = "BOTTOM",
    }
}

const REFERENCE: OptionSpec = OptionSpec::new(
    "-REFERENCE",
    &[ValueSpec::choice::<Reference>("WHERE", "TOP or BOTTOM")],
    "the nodes are in the middle of the upper or lower side; half the depth away from the axis",
)
.default("on the axis");
const SECTION: OptionSpec = OptionSpec::new(
    "-SECTION",
    &[
        ValueSpec::new("AREA", Kind::Number(Dim::SectionArea), "area of the metal").positive(),
        ValueSpec::new("V", Kind::Number(Dim::None), "IY IZ J ALPHAY ALPHAZ, which act in a stress analysis alone")
            .or("none"),
    ],
    "area of the metal, in place of that of the dimensions",
)
.repeating(1);
/// Values of an option that are read and not used.
const ANY: &[ValueSpec] = &[ValueSpec::new("V", Kind::Item, "a value").or("none")];
/// An option of a stress analysis or a code check.
const fn stress(name: &'static str) -> OptionSpec {
    OptionSpec::new(name, ANY, "of a stress analysis or a code check").repeating(1).without_effect()
}
/// What stiffeners are given by.
const STIFFENER: &[ValueSpec] = &[
    ValueSpec::new("SPACE", Kind::Number(Dim::None), "their distance or number"),
    ValueSpec::new("~CLASS", Kind::Name(Noun::Class), "their section").or("none"),
    ValueSpec::new("WHERE", Kind::Text, "where they are").or("everywhere"),
];
/// An option of stiffeners, whose weight is not computed.
const fn stiffener(name: &'static str) -> OptionSpec {
    OptionSpec::new(name, STIFFENER, "stiffeners").stops(SolveKind::Statics, "the weight of stiffeners")
}
const STIFFENERS: [OptionSpec; 4] =
    [stiffener("-T_STIFF"), stiffener("-L_STIFF"), stiffener("-TN_STIFF"), stiffener("-LN_STIFF")];

const LISTS: &[&[OptionSpec]] = &[
    &[o::LEN],
    &o::MATERIAL,
    &[stress("-SN"), o::WTPLEN, o::DISPLEN],
    &o::DIAMETERS,
    &[
        SECTION,
        REFERENCE,
        stress("-POINTS"),
        stress("-P_FY"),
        stress("-M_P"),
        stress("-P_N"),
        stress("-ETA"),
        stress("-F_TYPE"),
    ],
    &STIFFENERS,
];
const OPTIONS: &[OptionSpec] = &join_lists::<{ count_options(LISTS) }>(LISTS);

const DETAIL: &str = "A section of structural members, for BEAM. Dimensions in inches or mm; which is which is our reading. The weight is the area of the metal \
     times -DENSITY, or -WTPLEN; an attached plate PT PW is not in it [MOSES-REF cls_str]. -SECTION AREA stands for the area of the dimensions. A \
     closed section displaces what its walls enclose, unless the BEAM has -FLOOD YES; an open one its metal. -BUOYDIAMETER displaces a circle \
     instead, and -DISPLEN a weight of water per length beside. -DRAGDIAMETER, -WINDDIAMETER and -AMASDIAMETER stand for what flow meets. A repeated name \
     adds the next segment of the member, with -LEN; one segment may leave it out and takes what is left.";

/// The spec of a type of section.
const fn section_spec(
    name: &'static str,
    data: &'static [ValueSpec],
    help: &'static str,
    example: &'static str,
) -> CommandSpec {
    CommandSpec { data, options: OPTIONS, detail: DETAIL, example, ..CommandSpec::new(name, help) }
}

/// An example with one member of a section.
macro_rules! example {
    ($record:literal) => {
        concat!(
            "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY DECK\n*A 0 0 5\n*B 12 0 5\n~S ",
            $record,
            "\nBEAM ~S *A *B\nEND\n&STATUS CLASS ~S\n&STATUS WEIGHT"
        )
    };
}

static TUBE_SPEC: CommandSpec = section_spec(
    "TUBE",
    &[
        size("A", "outer diameter"),
        size("B", "wall thickness").or("A/2: a solid bar"),
        sizes("C", "is not known and stops the next solve"),
        sizes("D", "is not known and stops the next solve"),
    ],
    "tube of BEAM",
    example!("TUBE 900 25"),
);
static CONE_SPEC: CommandSpec = section_spec(
    "CONE",
    &[
        size("A", "outer diameter at the first end"),
        size("B", "outer diameter at the second end"),
        size("C", "wall thickness"),
        PT,
        PW,
    ],
    "cone of BEAM",
    example!("CONE 1200 900 25"),
);
static BOX_SPEC: CommandSpec = section_spec(
    "BOX",
    &[
        A_DEPTH,
        B_WIDTH,
        size("C", "thickness of the vertical sides"),
        size("D", "thickness of top and bottom").or("C"),
        PT,
        PW,
    ],
    "closed box of BEAM",
    example!("BOX 600 400 20 15"),
);
static WBOX_SPEC: CommandSpec = section_spec(
    "WBOX",
    &[
        A_DEPTH,
        B_WIDTH,
        size("C", "thickness of the webs"),
        size("D", "thickness of the flanges"),
        size("E", "clear distance of the webs"),
        PT,
        PW,
    ],
    "welded box of BEAM, its flanges wider than its webs stand",
    example!("WBOX 900 500 15 25 350"),
);
static PRI_SPEC: CommandSpec =
    section_spec("PRI", &[A_DEPTH, B_WIDTH.or("A"), PT, PW], "solid rectangle of BEAM", example!("PRI 300 200"));
static IBEAM_SPEC: CommandSpec = section_spec(
    "IBEAM",
    &[A_DEPTH, B_WIDTH, size("C", "thickness of the web"), size("D", "thickness of the flanges"), PT, PW],
    "I section of BEAM",
    example!("IBEAM 900 300 16 28"),
);
static TEE_SPEC: CommandSpec = section_spec(
    "TEE",
    &[A_DEPTH, B_WIDTH, size("C", "thickness of the web"), size("D", "thickness of the flange"), PT, PW],
    "T section of BEAM",
    example!("TEE 400 200 12 20"),
);
static CHANNEL_SPEC: CommandSpec = section_spec(
    "CHANNEL",
    &[A_DEPTH, B_WIDTH, size("C", "thickness of the web"), size("D", "thickness of the flanges"), PT, PW],
    "channel of BEAM",
    example!("CHANNEL 300 100 10 16"),
);
static ANGLE_SPEC: CommandSpec = section_spec(
    "ANGLE",
    &[
        A_DEPTH,
        B_WIDTH,
        size("C", "thickness of the leg along z"),
        size("D", "thickness of the leg along y").or("C"),
        PT,
        PW,
    ],
    "angle of BEAM",
    example!("ANGLE 150 100 12"),
);
static D_ANGLE_SPEC: CommandSpec = section_spec(
    "D_ANGLE",
    &[
        A_DEPTH,
        size("B", "width of one angle"),
        size("C", "thickness of all legs"),
        sizes("D", "distance of the two angles"),
        PT,
        PW,
    ],
    "two angles back to back of BEAM",
    example!("D_ANGLE 150 100 12 10"),
);
/// Dimensions of a section whose figure is not public: the depth and seven more.
const EIGHT: &[ValueSpec] = &[
    A_DEPTH,
    B_WIDTH,
    sizes("C", "a dimension"),
    sizes("D", "a dimension"),
    sizes("E", "a dimension"),
    sizes("F", "a dimension"),
    sizes("G", "a dimension"),
    sizes("H", "a dimension"),
    PT,
    PW,
];
/// The same of a launch leg.
const LAUNCH_LEG: &[ValueSpec] = &[
    size("A", "outer diameter of the tube"),
    size("B", "its wall thickness"),
    EIGHT[2],
    EIGHT[3],
    EIGHT[4],
    EIGHT[5],
    EIGHT[6],
    EIGHT[7],
    PT,
    PW,
];
static G_IBEAM_SPEC: CommandSpec = section_spec(
    "G_IBEAM",
    EIGHT,
    "I section of unlike flanges of BEAM; -SECTION gives its area",
    example!("G_IBEAM 900 300 16 28 250 20 0 0 -SECTION 26640"),
);
static LLEG_SPEC: CommandSpec = section_spec(
    "LLEG",
    LAUNCH_LEG,
    "launch leg of BEAM: a tube on a runner; -SECTION gives the area of both",
    example!("LLEG 1500 40 600 30 500 25 0 0 -SECTION 230000"),
);
static PLATE_OPTIONS: [OptionSpec; o::MATERIAL.len() + STIFFENERS.len()] = join_options(&o::MATERIAL, &STIFFENERS);
static PLATE_SPEC: CommandSpec = CommandSpec {
    detail: "A plate, for PLATE. Its weight is thickness times density times area, its displacement that of its metal. B C D would be a corrugation and stop the \
             next solve. -SECTION, -WTPLEN and diameters are for beams.",
    example: "&DIMEN -DIMEN METERS M-TONS\nMEDIT\n&DESCRIBE BODY DECK\n*A 0 0 5\n*B 12 0 5\n*C 12 6 5\n*D 0 6 5\n~S PLATE 12\n\
              PLATE ~S *A *B *C *D\nEND\n&STATUS CLASS ~S\n&STATUS WEIGHT",
    options: &PLATE_OPTIONS,
    data: &[
        size("A", "thickness"),
        sizes("B", "of a corrugation"),
        sizes("C", "of a corrugation"),
        sizes("D", "of a corrugation"),
    ],
    ..CommandSpec::new("PLATE", "plate of PLATE")
};

/// The record of a class that names a shape instead of a type.
pub static SHAPE_SPEC: CommandSpec =
    section_spec("a shape", &[PT, PW], "section by the name of a shape", example!("PRI 300 200"));

/// All types of sections, in the order of the manual.
pub static SECTIONS: &[&SectionKind] = &[
    &SectionKind { spec: &TUBE_SPEC, read: read_tube },
    &SectionKind { spec: &CONE_SPEC, read: read_cone },
    &SectionKind { spec: &BOX_SPEC, read: read_box },
    &SectionKind { spec: &WBOX_SPEC, read: read_welded_box },
    &SectionKind { spec: &PRI_SPEC, read: read_prism },
    &SectionKind { spec: &IBEAM_SPEC, read: read_i_beam },
    &SectionKind { spec: &G_IBEAM_SPEC, read: read_general_i_beam },
    &SectionKind { spec: &TEE_SPEC, read: read_tee },
    &SectionKind { spec: &CHANNEL_SPEC, read: read_channel },
    &SectionKind { spec: &ANGLE_SPEC, read: read_angle },
    &SectionKind { spec: &D_ANGLE_SPEC, read: read_double_angle },
    &SectionKind { spec: &LLEG_SPEC, read: read_launch_leg },
    &SectionKind { spec: &PLATE_SPEC, read: read_plate },
];

/// What the walls of a section close in.
#[derive(Clone, Copy)]
enum Walls {
    /// Nothing: it is open.
    Open,
    /// The area within their outer faces at both ends (m2).
    Outer([f64; 2]),
    /// The area within their inner faces at both ends (m2).
    Inner([f64; 2]),
}

/// What the dimensions of a section say.
struct Form {
    outline: SectionOutline,
    /// Area of the metal at both ends (m2); none: -SECTION has to give it.
    metal: Option<[f64; 2]>,
    /// What its walls close in at both ends.
    walls: Walls,
    unread: Option<&'static str>,
}

impl Form {
    fn of_bar(width: f64, depth: f64, metal: f64) -> Form {
        let outline = SectionOutline::Bar { width, depth };
        Form { outline, metal: Some([metal; 2]), walls: Walls::Open, unread: None }
    }
}

/// Refuses dimensions that make no section: each pair is a size that has to be less than another.
fn check_sizes(args: &Args, kind: &str, pairs: &[(f64, f64, &str)]) -> Outcome<()> {
    match pairs.iter().find(|(small, large, _)| small > large) {
        None => Ok(()),
        Some((.., what)) => Err(Diagnostic::error(format!("the dimensions make no {kind}: {what}"), args.span)
            .help(format!("&HELP {kind} says which dimension is which"))),
    }
}

/// Makes a section of a record and what its dimensions say.
fn finish(record: &ClassRecord, kind: &'static str, form: Form) -> Outcome<MemberSection> {
    let args = &record.args;
    let number = |option: &OptionSpec| args.number_if_declared(option);
    let given = args.option_if_declared(&SECTION).and_then(|given| given.first_number());
    let metal = given.map(|area| [area; 2]).or(form.metal).ok_or_else(|| {
        Diagnostic::error(format!("the area of a {kind} does not follow from its dimensions"), args.span)
            .label("the figure that says which is which is not public")
            .help("give it: -SECTION AREA")
    })?;
    let density = number(&o::DENSITY).or(number(&o::SPGRAVITY).map(|s| s * 1000.0));
    let weighs = density.unwrap_or(record.defaults.material.density) * record.defaults.gravity;
    let weight = number(&o::WTPLEN).map_or(metal.map(|area| area * weighs), |given| [given; 2]);
    let reference = const { REFERENCE.choice::<Reference>("WHERE") };
    let depth = match form.outline {
        SectionOutline::Round([a, b]) => a.max(b),
        SectionOutline::Bar { depth, .. } => depth,
        SectionOutline::Plate(_) => 0.0,
    };
    let shift = match args.option_if_declared(&REFERENCE).and_then(|given| given.choice(reference)) {
        Some(Reference::Top) => -0.5 * depth,
        Some(Reference::Bottom) => 0.5 * depth,
        None => 0.0,
    };
    let stiffened = STIFFENERS.iter().any(|option| args.option_if_declared(option).is_some());
    Ok(MemberSection {
        kind,
        outline: form.outline,
        length: number(&o::LEN),
        metal,
        enclosed: match form.walls {
            Walls::Open => metal,
            Walls::Outer(area) => area,
            Walls::Inner(area) => [metal[0] + area[0], metal[1] + area[1]],
        },
        weight,
        displacement: number(&o::DISPLEN).unwrap_or(0.0),
        buoyancy_diameter: number(&o::BUOYDIAMETER),
        drag_diameter: number(&o::DRAGDIAMETER),
        wind_diameter: number(&o::WINDDIAMETER),
        added_mass_diameter: number(&o::AMASDIAMETER),
        shift,
        unread: form.unread.or(stiffened.then_some("the weight of its stiffeners")),
    })
}

/// The area of a circle (m2).
fn circle(diameter: f64) -> f64 {
    FRAC_PI_4 * diameter * diameter
}

/// A round section of outer diameters at both ends and a wall.
fn round(
    record: &ClassRecord,
    kind: &'static str,
    diameters: [f64; 2],
    wall: f64,
    unread: Option<&'static str>,
) -> Outcome<MemberSection> {
    let least = diameters[0].min(diameters[1]);
    // half the diameter in user's units may be more by rounding
    check_sizes(
        &record.args,
        kind,
        &[(2.0 * wall, least * (1.0 + 1e-12), "the wall is thicker than half of the diameter")],
    )?;
    let hollow = diameters.map(|d| circle((d - 2.0 * wall).max(0.0)));
    let metal = [circle(diameters[0]) - hollow[0], circle(diameters[1]) - hollow[1]];
    let walls = if hollow == [0.0; 2] { Walls::Open } else { Walls::Outer(diameters.map(circle)) };
    finish(record, kind, Form { outline: SectionOutline::Round(diameters), metal: Some(metal), walls, unread })
}

fn read_tube(record: &ClassRecord) -> Outcome<MemberSection> {
    let [diameter, wall, c, d] = record.args.numbers_or_zero(const { TUBE_SPEC.numbers(["A", "B", "C", "D"]) });
    let wall = if wall > 0.0 { wall } else { 0.5 * diameter };
    let unread = (c > 0.0 || d > 0.0).then_some("what C and D of a TUBE do");
    round(record, "TUBE", [diameter; 2], wall, unread)
}

fn read_cone(record: &ClassRecord) -> Outcome<MemberSection> {
    let [first, second, wall] = record.args.numbers_or_zero(const { CONE_SPEC.numbers(["A", "B", "C"]) });
    round(record, "CONE", [first, second], wall, None)
}

fn read_box(record: &ClassRecord) -> Outcome<MemberSection> {
    let [depth, width, side, lid] = record.args.numbers_or_zero(const { BOX_SPEC.numbers(["A", "B", "C", "D"]) });
    let lid = if lid > 0.0 { lid } else { side };
    let pairs = [
        (2.0 * lid, depth, "top and bottom are thicker than its depth"),
        (2.0 * side, width, "the sides are thicker than its width"),
    ];
    check_sizes(&record.args, "BOX", &pairs)?;
    let hollow = (depth - 2.0 * lid) * (width - 2.0 * side);
    let form = Form::of_bar(width, depth, depth * width - hollow);
    finish(record, "BOX", Form { walls: Walls::Outer([depth * width; 2]), ..form })
}

fn read_welded_box(record: &ClassRecord) -> Outcome<MemberSection> {
    let [depth, width, web, flange, between] =
        record.args.numbers_or_zero(const { WBOX_SPEC.numbers(["A", "B", "C", "D", "E"]) });
    let pairs = [
        (2.0 * flange, depth, "the flanges are thicker than its depth"),
        (between + 2.0 * web, width, "the webs stand beyond the flanges"),
    ];
    check_sizes(&record.args, "WBOX", &pairs)?;
    let high = depth - 2.0 * flange;
    let form = Form::of_bar(width, depth, 2.0 * width * flange + 2.0 * high * web);
    finish(record, "WBOX", Form { walls: Walls::Inner([high * between; 2]), ..form })
}

fn read_prism(record: &ClassRecord) -> Outcome<MemberSection> {
    let [depth, width] = record.args.numbers_or_zero(const { PRI_SPEC.numbers(["A", "B"]) });
    let width = if width > 0.0 { width } else { depth };
    finish(record, "PRI", Form::of_bar(width, depth, width * depth))
}

/// A section of a web and flanges of one thickness each. IBEAM, CHANNEL and TEE name their dimensions alike.
fn read_flanged(record: &ClassRecord, kind: &'static str, flanges: f64) -> Outcome<MemberSection> {
    let [depth, width, web, flange] = record.args.numbers_or_zero(const { IBEAM_SPEC.numbers(["A", "B", "C", "D"]) });
    let pairs = [
        (flanges * flange, depth, "the flanges are thicker than its depth"),
        (web, width, "the web is thicker than the flanges are wide"),
    ];
    check_sizes(&record.args, kind, &pairs)?;
    finish(record, kind, Form::of_bar(width, depth, flanges * width * flange + (depth - flanges * flange) * web))
}

fn read_i_beam(record: &ClassRecord) -> Outcome<MemberSection> {
    read_flanged(record, "IBEAM", 2.0)
}

fn read_channel(record: &ClassRecord) -> Outcome<MemberSection> {
    read_flanged(record, "CHANNEL", 2.0)
}

fn read_tee(record: &ClassRecord) -> Outcome<MemberSection> {
    read_flanged(record, "TEE", 1.0)
}

/// The area of one angle (m2).
fn angle_area(args: &Args, kind: &str, [depth, width, upright, level]: [f64; 4]) -> Outcome<f64> {
    let pairs =
        [(level, depth, "a leg is thicker than its depth"), (upright, width, "a leg is thicker than its width")];
    check_sizes(args, kind, &pairs)?;
    Ok(depth * upright + (width - upright) * level)
}

fn read_angle(record: &ClassRecord) -> Outcome<MemberSection> {
    let [depth, width, upright, level] =
        record.args.numbers_or_zero(const { ANGLE_SPEC.numbers(["A", "B", "C", "D"]) });
    let level = if level > 0.0 { level } else { upright };
    let area = angle_area(&record.args, "ANGLE", [depth, width, upright, level])?;
    finish(record, "ANGLE", Form::of_bar(width, depth, area))
}

fn read_double_angle(record: &ClassRecord) -> Outcome<MemberSection> {
    let [depth, width, leg, between] =
        record.args.numbers_or_zero(const { D_ANGLE_SPEC.numbers(["A", "B", "C", "D"]) });
    let area = angle_area(&record.args, "D_ANGLE", [depth, width, leg, leg])?;
    finish(record, "D_ANGLE", Form::of_bar(2.0 * width + between, depth, 2.0 * area))
}

fn read_general_i_beam(record: &ClassRecord) -> Outcome<MemberSection> {
    let [depth, width] = record.args.numbers_or_zero(const { G_IBEAM_SPEC.numbers(["A", "B"]) });
    finish(record, "G_IBEAM", Form { metal: None, ..Form::of_bar(width, depth, 0.0) })
}

fn read_launch_leg(record: &ClassRecord) -> Outcome<MemberSection> {
    let [diameter, wall] = record.args.numbers_or_zero(const { LLEG_SPEC.numbers(["A", "B"]) });
    let pairs = [(2.0 * wall, diameter, "the wall is thicker than half of the diameter")];
    check_sizes(&record.args, "LLEG", &pairs)?;
    let walls = Walls::Inner([circle(diameter - 2.0 * wall); 2]);
    finish(record, "LLEG", Form { outline: SectionOutline::Round([diameter; 2]), metal: None, walls, unread: None })
}

fn read_plate(record: &ClassRecord) -> Outcome<MemberSection> {
    let [thickness, b, c, d] = record.args.numbers_or_zero(const { PLATE_SPEC.numbers(["A", "B", "C", "D"]) });
    let unread = (b + c + d > 0.0).then_some("a corrugation of PLATE");
    let outline = SectionOutline::Plate(thickness);
    finish(record, "PLATE", Form { outline, metal: Some([thickness; 2]), walls: Walls::Open, unread })
}

/// The sections of one class of structural members.
#[derive(Debug)]
struct MemberClass(Vec<MemberSection>);

/// A class of sections, from the first end.
pub fn member_class(sections: Vec<MemberSection>) -> Arc<dyn ConnectorClass> {
    Arc::new(MemberClass(sections))
}

/// Whether data of a section are all there: of a class of several, one at most leaves its length out.
///
/// # Errors
/// A plate with other sections; a second section without length.
pub fn check_sections(sections: &[MemberSection], span: windlass_base::span::Span) -> Outcome<()> {
    let plate = |s: &MemberSection| matches!(s.outline, SectionOutline::Plate(_));
    if sections.len() > 1 && sections.iter().any(plate) {
        return Err(Diagnostic::error("a PLATE has one section", span));
    }
    if sections.iter().filter(|s| s.length.is_none()).count() > 1 {
        return Err(Diagnostic::error("of the segments of a member one alone may leave -LEN out", span));
    }
    Ok(())
}

impl ConnectorClass for MemberClass {
    fn kind(&self) -> &'static str {
        self.0.first().map_or("TUBE", |section| section.kind)
    }

    fn check_ends(&self, connector: &Connector, _: usize) -> Outcome<()> {
        let text = format!("class type {} is a section of structural members, and makes no connector", self.kind());
        Err(Diagnostic::error(text, connector.span).help("BEAM and PLATE take it"))
    }

    fn properties(&self, name: &str, surroundings: &Surroundings) -> Table {
        let sections: Vec<(usize, &MemberSection)> = self.0.iter().enumerate().collect();
        let diameter = |s: &MemberSection, end: usize| match s.outline {
            SectionOutline::Round(of) => of.get(end).copied(),
            _ => None,
        };
        let sides = |s: &MemberSection| match s.outline {
            SectionOutline::Bar { width, depth } => [Some(depth), Some(width)],
            SectionOutline::Plate(thickness) => [Some(thickness), None],
            SectionOutline::Round(_) => [None; 2],
        };
        let is_plate = self.0.iter().any(|s| matches!(s.outline, SectionOutline::Plate(_)));
        let table = Table::new(format!("Class {name}"))
            .with_rows(&sections)
            .column("", "Segment", Dim::None, Digits::Usual, |(index, _)| index + 1)
            .text("Type", |(_, s)| s.kind)
            .column("", "Length", Dim::Length, Digits::Usual, |(_, s)| s.length)
            .columns("OD at End", ["1", "2"], Dim::Section, Digits::Usual, |(_, s)| [diameter(s, 0), diameter(s, 1)])
            .columns("Outline", ["Depth", "Width"], Dim::Section, Digits::Usual, |(_, s)| sides(s));
        if is_plate {
            return table.build();
        }
        let mean = |of: [f64; 2]| 0.5 * (of[0] + of[1]);
        table
            .column("Mean", "Area", Dim::SectionArea, Digits::Usual, |(_, s)| mean(s.metal))
            .column("Mean", "Weight / L", Dim::ForcePerLength, Digits::Usual, |(_, s)| mean(s.weight))
            .column("Buoyancy / L", "Whole", Dim::ForcePerLength, Digits::Usual, |(_, s)| {
                mean(s.displaced_areas(false)) * surroundings.water_weight() + s.displacement
            })
            .column("Buoyancy / L", "Flooded", Dim::ForcePerLength, Digits::Usual, |(_, s)| {
                mean(s.displaced_areas(true)) * surroundings.water_weight() + s.displacement
            })
            .build()
    }

    fn element(&self, _: &Connection) -> Result<Box<dyn ConnectorElement>, ClassError> {
        Err(ClassError::new(format!("class type {} makes no connector", self.kind())))
    }

    fn as_members(&self) -> Option<&[MemberSection]> {
        Some(&self.0)
    }
}

/// The specs of all class types: of connectors, then of structural members.
pub fn class_specs() -> impl Iterator<Item = &'static CommandSpec> + Clone {
    super::CLASSES.iter().map(|kind| kind.spec).chain(SECTIONS.iter().map(|kind| kind.spec))
}
